#include "run/results/lift_figures.h"

#include <math.h>

#include "base/format/plurals.h"
#include "base/mem.h"
#include "base/sort.h"

/* Waits of a lift, s; NAN where nobody came in. */
typedef struct Waits {
    double mean, p90, most;
} Waits;

static Waits sum_waits(const JoxLiftFigures *f) {
    Waits waits = {NAN, NAN, NAN};
    if (!f->wait_count)
        return waits;
    double *sorted = jox_alloc(f->wait_count, sizeof *sorted), sum = 0.0;
    for (uint32_t k = 0; k < f->wait_count; k++) {
        sorted[k] = (double)f->waits[k];
        sum += sorted[k];
    }
    jox_sort_doubles(sorted, f->wait_count);
    waits.mean = sum / f->wait_count;
    waits.p90 = sorted[(uint32_t)ceil(0.9 * f->wait_count) - 1];
    waits.most = sorted[f->wait_count - 1];
    jox_free(sorted);
    return waits;
}

/* Returns for how long the one waits who still waits longest, s; 0: nobody does. */
static double find_longest_waiting(const JoWorld *w, uint32_t lift) {
    double longest = 0.0;
    for (uint32_t r = 0; r < w->state.lifts.rider_count; r++) {
        const JoxRider *rider = &w->state.lifts.riders[r];
        if (rider->lift != lift ||
            (rider->phase != JOX_RIDE_WAIT && rider->phase != JOX_RIDE_BOARD))
            continue;
        const double waited = (double)(w->state.tick - rider->since) * w->model.def.dt;
        longest = waited > longest ? waited : longest;
    }
    return longest;
}

void jox_run_add_lifts(const JoScene *scene, JoxJson *json) {
    const JoWorld *w = scene->world;
    if (!w->model.lift_count)
        return;
    jox_json_object(json, "lifts");
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        const JoxLift *lift = &w->model.lifts[l];
        const JoxLiftFigures *f = &w->state.lifts.figures[l];
        const JoxLiftCar *car = &w->state.lifts.cars[l];
        const Waits waits = sum_waits(f);
        jox_json_object(json, lift->name);
        jox_json_string(json, "mode", jox_lift_mode_names[car->mode]);
        jox_json_string(json, "storey",
                        w->model.storeys.storeys[lift->stops[car->stop].storey].name);
        jox_json_whole(json, "carried", f->carried);
        jox_json_whole(json, "let_out", f->let_out);
        jox_json_whole(json, "trips", f->trips);
        jox_json_whole(json, "full_trips", f->full_trips);
        jox_json_number(json, "filled", f->trips ? f->filled / (double)f->trips : 0.0);
        jox_json_number(json, "wait_mean_s", waits.mean);
        jox_json_number(json, "wait_p90_s", waits.p90);
        jox_json_number(json, "wait_max_s", waits.most);
        jox_json_number(json, "ride_mean_s", f->let_out ? f->ride_s / (double)f->let_out : NAN);
        jox_json_whole(json, "left_behind", f->left_behind);
        jox_json_whole(json, "turned_away", f->turned_away);
        jox_json_whole(json, "reopened", f->reopened);
        jox_json_whole(json, "waiting", jox_world_lift_waiting(w, l));
        jox_json_number(json, "waiting_longest_s", find_longest_waiting(w, l));
        jox_json_number(json, "metres", f->metres);
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_run_say_lifts(const JoScene *scene, JoxText *out) {
    const JoWorld *w = scene->world;
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        const JoxLiftFigures *f = &w->state.lifts.figures[l];
        const Waits waits = sum_waits(f);
        const uint32_t waiting = jox_world_lift_waiting(w, l);
        jox_text_printf(out, " Lift %.60s carried ", w->model.lifts[l].name);
        jox_text_noun(out, f->carried, "person|people");
        jox_text_add(out, " in ");
        jox_text_noun(out, f->trips, "trip|trips");
        if (f->trips)
            jox_text_printf(out, ", %.0f %% full", 100.0 * f->filled / (double)f->trips);
        if (f->wait_count)
            jox_text_printf(
                out, "; they waited %.0f s on average, 90 %% of them up to %.0f s, at most %.0f s",
                waits.mean, waits.p90, waits.most);
        if (waiting) {
            jox_text_add(out, "; ");
            jox_text_noun(out, waiting, "person waits|people wait");
            jox_text_printf(out, " before it, for up to %.0f s", find_longest_waiting(w, l));
        }
        jox_text_add(out, ".");
    }
}
