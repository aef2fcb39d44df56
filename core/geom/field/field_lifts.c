#include "geom/field/field_lifts.h"

#include "base/mem.h"

static const float BEHIND_DOOR[] = {0.3f, 0.5f, 0.7f, 1.0f}; /* m: where a cell is tried */

/* Returns the first open cell in the car behind a door, -1: there is none. */
static int find_cell_in_car(const JoxFieldWork *w, const JoxLift *lift, const JoxLiftStop *stop) {
    const JoxField *f = w->f;
    for (size_t k = 0; k < sizeof BEHIND_DOOR / sizeof *BEHIND_DOOR; k++) {
        const JoxV2 plan = jox_sub(stop->middle, jox_scale(stop->out, BEHIND_DOOR[k]));
        const JoxV2 at = jox_field_pack(f, jox_on_sheet(f->storeys, stop->storey, plan));
        const int column = (int)floorf((at.x - f->low.x) / f->size);
        const int row = (int)floorf((at.y - f->low.y) / f->size);
        if (!jox_lift_contains(lift, plan) || column < 0 || row < 0 || column >= f->columns ||
            row >= f->rows)
            continue;
        const int cell = row * f->columns + column;
        if (w->walled.node[cell] != JOX_FIELD_BLOCKED)
            return cell;
    }
    return -1;
}

/* Returns whether people of the field may take a lift in its mode. */
static bool may_take(const JoxFieldLifts *of, uint32_t lift) {
    return of->modes[lift] == JOX_LIFT_IN_USE ||
           (of->stepless && of->modes[lift] == JOX_LIFT_FIREMEN);
}

JoxFieldStops jox_field_list_stops(const JoxFieldWork *w) {
    JoxFieldStops stops = {NULL, 0};
    size_t capacity = 0;
    uint32_t number = 0;
    for (uint32_t l = 0; w->lifts && l < w->lifts->count; l++) {
        const JoxLift *lift = &w->lifts->lifts[l];
        for (uint32_t s = 0; s < lift->stop_count; s++) {
            const uint16_t label = (uint16_t)++number;
            const int cell =
                may_take(w->lifts, l) ? find_cell_in_car(w, lift, &lift->stops[s]) : -1;
            if (cell < 0)
                continue;
            JOX_RESERVE(stops.items, capacity, (size_t)stops.count + 1);
            stops.items[stops.count++] = (JoxFieldStop){cell, l, s, label};
        }
    }
    return stops;
}

bool jox_field_next_ride(const JoxFieldWork *w, const JoxFieldStops *stops, JoxFieldRide *ride) {
    for (; ride->next < stops->count; ride->next++, ride->other = 0) {
        const JoxFieldStop *out = &stops->items[ride->next];
        const JoxLift *lift = &w->lifts->lifts[out->lift];
        const bool fetched = w->lifts->modes[out->lift] == JOX_LIFT_FIREMEN;
        if (out->cell != ride->from || (fetched && out->stop != lift->home))
            continue;
        while (ride->other < stops->count) {
            const JoxFieldStop *in = &stops->items[ride->other++];
            if (in->lift != out->lift || in->stop == out->stop)
                continue;
            ride->to = in->cell;
            ride->label = in->label;
            ride->in = jox_scale(lift->stops[in->stop].out, -1.0f);
            ride->length = JOX_LIFT_PACE * (float)jox_lift_usual_time(lift, in->stop, out->stop);
            return true;
        }
    }
    return false;
}
