#include "run/results/lift_figures.h"

#include <math.h>

#include "base/format/plurals.h"
#include "base/mem.h"
#include "base/sort.h"

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

/* Sets the mean, the value that 90 % stay below, and the greatest of the waits. */
static void set_waits(JoxLiftResult *r) {
    const uint32_t count = r->count.wait_count;
    if (!count)
        return;
    double *sorted = jox_alloc(count, sizeof *sorted), sum = 0.0;
    for (uint32_t k = 0; k < count; k++) {
        sorted[k] = (double)r->count.waits[k];
        sum += sorted[k];
    }
    jox_sort_doubles(sorted, count);
    r->wait_mean = sum / count;
    r->wait_p90 = sorted[(uint32_t)ceil(0.9 * count) - 1];
    r->wait_most = sorted[count - 1];
    jox_free(sorted);
}

JoxLiftResult jox_run_lift_result(const JoWorld *w, uint32_t lift) {
    const JoxLiftFigures *f = &w->state.lifts.figures[lift];
    JoxLiftResult r = {.name = w->model.lifts[lift].name,
                       .capacity = w->model.lifts[lift].capacity,
                       .count = *f,
                       .wait_mean = NAN,
                       .wait_p90 = NAN,
                       .wait_most = NAN,
                       .ride_mean = f->let_out ? f->ride_s / (double)f->let_out : NAN,
                       .filled = f->trips ? f->filled / (double)f->trips : 0.0,
                       .queue_most_time =
                           f->queue_most ? (double)f->queue_tick * w->model.def.dt : NAN,
                       .waiting = jox_world_lift_waiting(w, lift),
                       .waiting_longest = find_longest_waiting(w, lift)};
    set_waits(&r);
    return r;
}

bool jox_run_is_anybody_stranded(const JoxStranded *stranded) {
    return stranded->in_refuge + stranded->nowhere + stranded->on_stairs > 0;
}

static void add_stranded_members(const JoxStranded *stranded, JoxJson *json) {
    jox_json_whole(json, "in_refuge", stranded->in_refuge);
    jox_json_whole(json, "without_refuge", stranded->nowhere);
    jox_json_whole(json, "on_stairs", stranded->on_stairs);
}

/* Adds how many people who cannot use stairs stay, in all and on each storey where some do. */
static void add_stranded(const JoWorld *w, JoxJson *json) {
    const JoxStranded all = jox_world_count_stranded(w, -1);
    jox_json_object(json, "cannot_use_stairs");
    add_stranded_members(&all, json);
    jox_json_object(json, "storeys");
    for (uint32_t k = 0; k < w->model.storeys.storey_count; k++) {
        const JoxStranded here = jox_world_count_stranded(w, (int32_t)k);
        if (!jox_run_is_anybody_stranded(&here))
            continue;
        jox_json_object(json, w->model.storeys.storeys[k].name);
        add_stranded_members(&here, json);
        jox_json_end(json);
    }
    jox_json_end(json);
    jox_json_end(json);
}

void jox_run_add_lifts(const JoScene *scene, JoxJson *json) {
    const JoWorld *w = scene->world;
    if (jox_has_storeys(&w->model.storeys))
        add_stranded(w, json);
    if (!w->model.lift_count)
        return;
    jox_json_object(json, "lifts");
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        const JoxLift *lift = &w->model.lifts[l];
        const JoxLiftCar *car = &w->state.lifts.cars[l];
        const JoxLiftResult r = jox_run_lift_result(w, l);
        jox_json_object(json, r.name);
        jox_json_string(json, "mode", jox_lift_mode_names[car->mode]);
        jox_json_string(json, "storey",
                        w->model.storeys.storeys[lift->stops[car->stop].storey].name);
        jox_json_whole(json, "carried", r.count.carried);
        jox_json_whole(json, "let_out", r.count.let_out);
        jox_json_whole(json, "trips", r.count.trips);
        jox_json_whole(json, "full_trips", r.count.full_trips);
        jox_json_number(json, "filled", r.filled);
        jox_json_number(json, "wait_mean_s", r.wait_mean);
        jox_json_number(json, "wait_p90_s", r.wait_p90);
        jox_json_number(json, "wait_max_s", r.wait_most);
        jox_json_number(json, "ride_mean_s", r.ride_mean);
        jox_json_whole(json, "left_behind", r.count.left_behind);
        jox_json_whole(json, "turned_away", r.count.turned_away);
        jox_json_whole(json, "reopened", r.count.reopened);
        jox_json_whole(json, "queue_max", r.count.queue_most);
        jox_json_number(json, "queue_max_s", r.queue_most_time);
        jox_json_whole(json, "waiting", r.waiting);
        jox_json_number(json, "waiting_longest_s", r.waiting_longest);
        jox_json_number(json, "door_open_max_s", r.count.open_most);
        jox_json_number(json, "metres", r.count.metres);
        jox_json_end(json);
    }
    jox_json_end(json);
}

/* Appends a sentence on people who cannot use stairs; nothing for nobody. */
static void say_stranded(uint32_t people, const char *where, JoxText *out) {
    if (!people)
        return;
    jox_text_add(out, " ");
    jox_text_noun(out, people, "person who cannot use stairs|people who cannot use stairs");
    jox_text_printf(out, " %s.", where);
}

void jox_run_say_lifts(const JoScene *scene, JoxText *out) {
    const JoWorld *w = scene->world;
    const JoxStranded stranded = jox_world_count_stranded(w, -1);
    say_stranded(stranded.in_refuge, "found no lift that takes them and stayed in a refuge", out);
    say_stranded(stranded.nowhere,
                 "found neither a lift that takes them nor a refuge on their storey: give a place "
                 "`refuge: true`, or a lift that is in use or left to firemen",
                 out);
    say_stranded(stranded.on_stairs, "stayed on a stair or ramp with no way on", out);
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        const JoxLiftResult r = jox_run_lift_result(w, l);
        jox_text_printf(out, " Lift %.60s carried ", r.name);
        jox_text_noun(out, r.count.carried, "person|people");
        jox_text_add(out, " in ");
        jox_text_noun(out, r.count.trips, "trip|trips");
        if (r.count.trips)
            jox_text_printf(out, ", %.0f %% full", 100.0 * r.filled);
        if (r.count.wait_count)
            jox_text_printf(
                out, "; they waited %.0f s on average, 90 %% of them up to %.0f s, at most %.0f s",
                r.wait_mean, r.wait_p90, r.wait_most);
        if (r.waiting) {
            jox_text_add(out, "; ");
            jox_text_noun(out, r.waiting, "person waits|people wait");
            jox_text_printf(out, " before it, for up to %.0f s", r.waiting_longest);
        }
        if (r.count.open_most > JOX_LONG_OPEN)
            jox_text_printf(out, "; its door stood open for up to %.0f s, held by people in it",
                            r.count.open_most);
        jox_text_add(out, ".");
    }
}
