#include "run/storey_checks.h"

#include <stdio.h>

#include "base/format/plurals.h"
#include "base/mem.h"
#include "machine/lifts.h"
#include "run/run.h"
#include "world/routes/hindrance.h"

enum { MOST_GOALS = 64 }; /* goals of an agent that are looked at */

/* People of one group who may ride in one lift. */
typedef struct Riders {
    uint32_t count, heavy, broad;
    float mass, radius; /* kg, m: greatest of those who cannot */
    uint32_t stop;      /* with the door that the first of them does not pass */
} Riders;

/* Returns whether a place is a lift's, or a set that has one of its places. */
static bool is_place_of(const JoWorld *w, int32_t place, uint32_t lift) {
    const JoxPlace *of = &w->model.places[place];
    const bool set = jox_place_is_set(of);
    for (uint32_t m = 0; m < (set ? of->member_count : 1); m++) {
        uint32_t found, stop;
        if (jox_lift_find_place(w->machines.lifts, set ? of->members[m] : place, &found, &stop) &&
            found == lift)
            return true;
    }
    return false;
}

/* Returns whether an agent rides in a lift in some state of its machine. */
static bool rides_in(const JoWorld *w, const JoxMachine *machine, uint32_t lift) {
    for (uint32_t s = 0; s < machine->state_count; s++) {
        const JoxSteerTerm *term = jox_ride_term(&machine->states[s]);
        const JoxTarget *target = term ? &machine->targets[term->target] : NULL;
        if (target && target->kind == JOX_TARGET_PLACE && target->arg >= 0 &&
            is_place_of(w, target->arg, lift))
            return true;
    }
    return false;
}

/* Returns whether a goal of an agent is on another storey. */
static bool leaves_storey(const JoWorld *w, uint32_t agent) {
    const JoxAgents *a = &w->state.agents;
    const JoxStoreys *storeys = &w->model.storeys;
    const uint32_t storey = jox_storey_at(storeys, jox_v2(a->x[agent], a->y[agent]));
    int32_t goals[MOST_GOALS];
    const uint32_t count = jox_machines_goals(&w->machines, agent, goals, MOST_GOALS);
    for (uint32_t g = 0; g < count; g++) {
        const JoxPlace *place = &w->model.places[goals[g]];
        if (!jox_place_is_set(place) && jox_storey_at(storeys, place->centre) != storey)
            return true;
    }
    return false;
}

/* Returns whether an agent may take a lift by itself. */
static bool may_take(const JoWorld *w, uint32_t agent, uint32_t lift) {
    const JoxAgents *a = &w->state.agents;
    const uint32_t storey = jox_storey_at(&w->model.storeys, jox_v2(a->x[agent], a->y[agent]));
    return jox_param(a, JOX_PARAM_lifts, agent) > JOX_LIFTS_NEVER &&
           jox_lift_stop_at(&w->model.lifts[lift], storey) >= 0 && leaves_storey(w, agent);
}

/* Counts an agent among those who may ride, and whether it cannot. */
static void count_rider(const JoWorld *w, uint32_t agent, const JoxLift *lift, Riders *riders) {
    const float mass = jox_param(&w->state.agents, JOX_PARAM_mass, agent);
    const float radius = jox_param(&w->state.agents, JOX_PARAM_radius, agent);
    uint32_t stop = 0;
    riders->count++;
    if (mass > lift->load) {
        riders->heavy++;
        riders->mass = jox_maxf(riders->mass, mass);
        return;
    }
    while (stop < lift->stop_count &&
           2.0f * lift->stops[stop].half >= jox_hindrance_narrowest(radius))
        stop++;
    if (stop == lift->stop_count)
        return;
    if (riders->broad++ == 0)
        riders->stop = stop;
    riders->radius = jox_maxf(riders->radius, radius);
}

/* Writes "nobody of group 'a' can", or "3 of the 5 people of group 'a' cannot". */
static void write_people(char *out, size_t size, uint32_t count, uint32_t all, const char *group) {
    char people[JOX_NOUN];
    if (count == all)
        snprintf(out, size, "nobody of group '%.60s' can", group);
    else
        snprintf(out, size, "%u of the %s of group '%.60s' cannot", count,
                 jox_noun(people, all, "person|people"), group);
}

static void warn_of_riders(const JoScene *scene, const JoxGroup *group, const JoxLift *lift,
                           const Riders *riders, JoxDiagnostics *diagnostics) {
    char who[160], hint[JOX_HINT];
    if (riders->heavy) {
        write_people(who, sizeof who, riders->heavy, riders->count, group->name);
        snprintf(hint, sizeof hint, "Give the lift load: %g, or lower their mass",
                 (double)riders->mass);
        jox_diag_warn(diagnostics, group->position, "too-heavy", hint,
                      "%s ride in '%.60s': they weigh up to %g kg, and its load is %g kg", who,
                      lift->name, (double)riders->mass, (double)lift->load);
    }
    if (riders->broad) {
        const JoxLiftStop *stop = &lift->stops[riders->stop];
        write_people(who, sizeof who, riders->broad, riders->count, group->name);
        snprintf(hint, sizeof hint, "Make the door %.2f m wide at least, or lower the radius",
                 2.0 * (double)riders->radius);
        jox_diag_warn(diagnostics, group->position, "no-way", hint,
                      "%s ride in '%.60s': its door on %.60s is %.2f m wide, and their radius is "
                      "up to %.2f m",
                      who, lift->name, scene->world->model.storeys.storeys[stop->storey].name,
                      2.0 * (double)stop->half, (double)riders->radius);
    }
}

/* Warns of people of a group whom a stair, or ramp, is too narrow for. */
static void check_stair(const JoScene *scene, const JoxStair *stair, uint32_t g,
                        JoxDiagnostics *diagnostics) {
    const JoWorld *w = scene->world;
    const JoxAgents *a = &w->state.agents;
    const JoxGroup *group = &scene->spec->groups[g];
    char who[160], hint[JOX_HINT];
    uint32_t count = 0, broad = 0;
    float radius = 0.0f;
    for (uint32_t i = 0; i < a->count; i++) {
        const float own = jox_param(a, JOX_PARAM_radius, i);
        const bool takes =
            stair->kind == JOX_STAIR_RAMP || jox_param(a, JOX_PARAM_lifts, i) <= JOX_LIFTS_ONLY;
        if (a->group[i] != g || a->machine[i] == JOX_NO_MACHINE || !takes || !leaves_storey(w, i))
            continue;
        count++;
        if (stair->width >= jox_hindrance_narrowest(own))
            continue;
        broad++;
        radius = jox_maxf(radius, own);
    }
    if (broad == 0)
        return;
    write_people(who, sizeof who, broad, count, group->name);
    snprintf(hint, sizeof hint, "Make it %.2f m wide at least, or lower the radius",
             2.0 * (double)radius);
    jox_diag_warn(diagnostics, group->position, "no-way", hint,
                  "%s pass the %s '%.60s': it is %.2f m wide, and their radius is up to %.2f m",
                  who, stair->kind == JOX_STAIR_RAMP ? "ramp" : "stair", stair->name,
                  (double)stair->width, (double)radius);
}

void jox_run_check_storeys(const JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoWorld *w = scene->world;
    const JoxAgents *a = &w->state.agents;
    const JoxStoreys *storeys = &w->model.storeys;
    const uint32_t groups = scene->spec->group_count;
    for (uint32_t k = 0; k < storeys->stair_count; k++)
        for (uint32_t g = 0; jox_stair_joins(&storeys->stairs[k]) && g < groups; g++)
            check_stair(scene, &storeys->stairs[k], g, diagnostics);
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        Riders *riders = jox_alloc((size_t)groups + 1, sizeof *riders);
        for (uint32_t i = 0; i < a->count; i++) {
            const JoxMachine *machine =
                a->machine[i] == JOX_NO_MACHINE ? NULL : w->machines.set->items[a->machine[i]];
            if (machine && a->group[i] < groups && (rides_in(w, machine, l) || may_take(w, i, l)))
                count_rider(w, i, &w->model.lifts[l], &riders[a->group[i]]);
        }
        for (uint32_t g = 0; g < groups; g++)
            warn_of_riders(scene, &scene->spec->groups[g], &w->model.lifts[l], &riders[g],
                           diagnostics);
        jox_free(riders);
    }
}
