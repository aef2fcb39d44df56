#include "world/lifts.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "world/lift_parts.h"

/* Makes the machines see the present state. */
static void show_lifts(JoWorld *w) {
    w->scratch.lifts.view = (JoxLiftView){.storeys = &w->model.storeys,
                                          .lifts = w->model.lifts,
                                          .cars = w->state.lifts.cars,
                                          .lift_count = w->model.lift_count,
                                          .riders = w->state.lifts.riders,
                                          .rider_count = w->state.lifts.rider_count};
    w->machines.lifts = w->model.lift_count ? &w->scratch.lifts.view : NULL;
}

void jox_world_set_lifts(JoWorld *w, const JoxLift *lifts, uint32_t count) {
    JOX_ASSERT(w->state.tick == 0 && w->model.lift_count == 0 && count <= JOX_MOST_LIFTS);
    if (!count)
        return;
    JOX_ASSERT(jox_has_storeys(&w->model.storeys));
    w->model.lifts = jox_alloc(count, sizeof *w->model.lifts);
    w->model.lift_count = count;
    w->state.lifts.cars = jox_alloc(count, sizeof *w->state.lifts.cars);
    w->state.lifts.figures = jox_alloc(count, sizeof *w->state.lifts.figures);
    for (uint32_t l = 0; l < count; l++) {
        jox_lift_copy(&w->model.lifts[l], &lifts[l]);
        jox_lift_lay_out(&w->model.lifts[l], &w->model.storeys);
        const JoxLift *lift = &w->model.lifts[l];
        if (lift->stop_count > w->scratch.lifts.stride)
            w->scratch.lifts.stride = lift->stop_count;
        w->state.lifts.cars[l] = (JoxLiftCar){.height = (double)lift->stops[lift->home].height,
                                              .mode = lift->mode,
                                              .stop = lift->home,
                                              .target = -1};
    }
    w->scratch.lifts.lobbies =
        jox_alloc((size_t)count * w->scratch.lifts.stride, sizeof *w->scratch.lifts.lobbies);
    show_lifts(w);
}

/* Keeps the longest queue before the doors of a lift, and when it stood there. */
static void measure_queue(const JoxLiftTurn *t) {
    const uint32_t waiting = jox_world_lift_waiting(t->world, t->number);
    if (waiting <= t->figures->queue_most)
        return;
    t->figures->queue_most = waiting;
    t->figures->queue_tick = (uint32_t)t->world->state.tick;
}

void jox_world_run_lifts(JoWorld *w) {
    if (!w->model.lift_count)
        return;
    jox_world_apply_walls(w); /* lobbies are laid by the standing walls */
    jox_lifts_list_riders(w);
    show_lifts(w);
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        JoxLiftTurn turn = {.world = w,
                            .number = l,
                            .lift = &w->model.lifts[l],
                            .car = &w->state.lifts.cars[l],
                            .figures = &w->state.lifts.figures[l]};
        jox_lift_count_people(&turn);
        jox_lift_update_riders(&turn);
        jox_lift_run_car(&turn);
        jox_lift_place_riders(&turn);
        measure_queue(&turn);
    }
}

/* Returns the share of a car's door that is open, 0 to 1. */
static float compute_door_share(const JoxLift *lift, const JoxLiftCar *car) {
    const float left = (float)car->left;
    switch ((JoxLiftDoor)car->door) {
    case JOX_DOOR_OPENING:
        return jox_clampf(1.0f - left / jox_maxf(lift->opening, 1e-3f), 0.0f, 1.0f);
    case JOX_DOOR_CLOSING:
        return jox_clampf(left / jox_maxf(lift->closing, 1e-3f), 0.0f, 1.0f);
    default:
        return car->door == JOX_DOOR_OPEN ? 1.0f : 0.0f;
    }
}

JoxCarLook jox_world_car_look(const JoWorld *w, uint32_t lift) {
    const JoxLiftCar *car = &w->state.lifts.cars[lift];
    return (JoxCarLook){.height = (float)car->height,
                        .open = compute_door_share(&w->model.lifts[lift], car),
                        .stop = car->stop,
                        .people = car->people,
                        .mode = car->mode};
}

int32_t jox_world_find_lift(const JoWorld *w, const char *name) {
    for (uint32_t l = 0; l < w->model.lift_count; l++)
        if (strcmp(w->model.lifts[l].name, name) == 0)
            return (int32_t)l;
    return -1;
}

void jox_world_set_lift_mode(JoWorld *w, int32_t lift, JoxLiftMode mode) {
    for (uint32_t l = 0; l < w->model.lift_count; l++)
        if (lift < 0 || (uint32_t)lift == l) {
            if (w->state.lifts.cars[l].mode != mode)
                jox_routes_note_lifts(w->state.routes);
            w->state.lifts.cars[l].mode = mode;
            w->state.lifts.cars[l].direction = 0;
        }
}

uint32_t jox_world_lift_waiting(const JoWorld *w, uint32_t lift) {
    uint32_t count = 0;
    for (uint32_t r = 0; r < w->state.lifts.rider_count; r++)
        count += w->state.lifts.riders[r].lift == lift &&
                 (w->state.lifts.riders[r].phase == JOX_RIDE_WAIT ||
                  w->state.lifts.riders[r].phase == JOX_RIDE_BOARD);
    return count;
}

JoxStranded jox_world_count_stranded(const JoWorld *w, int32_t storey) {
    const JoxAgents *a = &w->state.agents;
    JoxStranded stranded = {0};
    for (uint32_t i = 0; a->storeys && w->machines.fields && i < a->count; i++) {
        const JoxV2 at = {a->x[i], a->y[i]};
        if (!(jox_param(a, JOX_PARAM_lifts, i) > JOX_LIFTS_ONLY) ||
            jox_rider_find(w->machines.lifts, a->id[i]) ||
            (storey >= 0 && jox_storey_at(a->storeys, at) != (uint32_t)storey))
            continue;
        const int32_t goal = jox_machines_walk_goal(&w->machines, i);
        const JoxField *const *ways =
            (const JoxField *const *)w->machines.fields + (goal < 0 ? 0 : goal * JOX_ROUTE_KINDS);
        const JoxField *by_lifts = ways[JOX_ROUTE_STEPLESS_LIFTS];
        if (goal < 0 || !ways[JOX_ROUTE_STEPLESS] ||
            jox_field_distance(ways[JOX_ROUTE_STEPLESS], at) < INFINITY ||
            (by_lifts && jox_field_distance(by_lifts, at) < INFINITY))
            continue;
        if (jox_sheet_of(a->storeys, at.y) >= a->storeys->storey_count)
            stranded.on_stairs++;
        else if (jox_find_refuge(&w->machines, at) >= 0)
            stranded.in_refuge++;
        else
            stranded.nowhere++;
    }
    return stranded;
}

/* Refuses cars and riders that no run can have. */
static void check_restored(JoWorld *w, JoxSections *s) {
    bool good = true;
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        const JoxLiftCar *car = &w->state.lifts.cars[l];
        const uint32_t stops = w->model.lifts[l].stop_count;
        good &= car->stop < stops && car->target < (int32_t)stops && car->target >= -1 &&
                car->door <= JOX_DOOR_CLOSING && car->mode <= JOX_LIFT_FIREMEN &&
                car->direction >= -1 && car->direction <= 1;
    }
    for (uint32_t r = 0; r < w->state.lifts.rider_count && good; r++) {
        const JoxRider *rider = &w->state.lifts.riders[r];
        good &= rider->lift < w->model.lift_count && rider->phase <= JOX_RIDE_OVER &&
                (!r || rider->id > rider[-1].id);
        good = good && rider->from < w->model.lifts[rider->lift].stop_count &&
               rider->to < w->model.lifts[rider->lift].stop_count;
    }
    if (good)
        return;
    w->state.lifts.rider_count = 0;
    for (uint32_t l = 0; l < w->model.lift_count; l++)
        w->state.lifts.cars[l] = (JoxLiftCar){.target = -1};
    jox_sections_fail(s, "cars", "a lift's car or rider makes no sense");
}

void jox_lifts_sections(JoWorld *w, JoxSections *s) {
    if (!w->model.lift_count)
        return;
    jox_sections_module(s, "lifts");
    const size_t cars = jox_section_count(s, "lifts", w->model.lift_count, sizeof(JoxLiftCar));
    if (cars != w->model.lift_count) {
        jox_sections_fail(s, "lifts", "the number of lifts differs");
        return;
    }
    jox_section(s, "cars", w->state.lifts.cars, sizeof *w->state.lifts.cars, cars);
    JOX_SECTION_ARRAY(s, "riders", w->state.lifts.riders, w->state.lifts.rider_count,
                      w->state.lifts.rider_capacity);
    if (s->mode == JOX_SECTIONS_RESTORE) {
        check_restored(w, s);
        show_lifts(w);
    }
}

void jox_lift_figures_sections(JoWorld *w, JoxSections *s) {
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        JoxLiftFigures *f = &w->state.lifts.figures[l];
        JOX_SECTION(s, "trips", f->trips);
        JOX_SECTION(s, "full_trips", f->full_trips);
        JOX_SECTION(s, "carried", f->carried);
        JOX_SECTION(s, "let_out", f->let_out);
        JOX_SECTION(s, "left_behind", f->left_behind);
        JOX_SECTION(s, "turned_away", f->turned_away);
        JOX_SECTION(s, "reopened", f->reopened);
        JOX_SECTION(s, "filled", f->filled);
        JOX_SECTION(s, "ride_s", f->ride_s);
        JOX_SECTION(s, "metres", f->metres);
        JOX_SECTION(s, "open_now", f->open_now);
        JOX_SECTION(s, "open_most", f->open_most);
        JOX_SECTION(s, "queue_most", f->queue_most);
        JOX_SECTION(s, "queue_tick", f->queue_tick);
        JOX_SECTION_ARRAY(s, "waits", f->waits, f->wait_count, f->wait_capacity);
    }
}

void jox_lifts_free(JoWorld *w) {
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        jox_lift_free(&w->model.lifts[l]);
        jox_free(w->state.lifts.figures[l].waits);
    }
    jox_free(w->model.lifts);
    jox_free(w->state.lifts.cars);
    jox_free(w->state.lifts.figures);
    jox_free(w->state.lifts.riders);
    jox_free(w->scratch.lifts.next);
    jox_free(w->scratch.lifts.index);
    jox_free(w->scratch.lifts.lobbies);
}
