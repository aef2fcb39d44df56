/* Places the people of groups when a scene starts, and reports who was shifted or does not fit.
   build_scene.c calls it; reload_scene.c, to pass an edited schedule to the world. */
#include <math.h>
#include <string.h>

#include "agents/torso.h"
#include "base/format/plurals.h"
#include "base/mem.h"
#include "nav/spots/spots.h"
#include "run/group_links.h"
#include "run/run.h"
#include "run/starting_people.h"

void jox_run_set_schedule(JoScene *scene, bool anew) {
    const JoxSceneSpec *spec = scene->spec;
    jox_world_set_groups(scene->world, spec->groups, spec->group_count);
    jox_world_set_sources(scene->world, spec->sources, spec->source_count, anew);
    jox_world_set_sinks(scene->world, spec->sinks, spec->sink_count);
    jox_world_set_events(scene->world, spec->events, spec->event_count);
}

/* ---- a step that is too long ---- */

/* Returns the greatest or least value of a parameter among agents that run the machine; NAN if
   it is computed in each step. `value`: where it is set. */
static double find_extreme(const JoScene *scene, uint32_t number, const JoxState *state,
                           int parameter, bool greatest, const JoxValue **value) {
    const JoxMachine *machine = scene->world->machines.set->items[number];
    const JoxAgents *a = &scene->world->state.agents;
    *value = &state->param[parameter];
    if ((*value)->kind == JOX_VALUE_UNSET)
        *value = &machine->defaults[parameter];
    if ((*value)->kind == JOX_VALUE_UNSET)
        return jox_parameters[parameter].value;
    if ((*value)->kind != JOX_VALUE_OWN)
        return (*value)->kind == JOX_VALUE_CONST ? (*value)->number : NAN;
    double most = NAN;
    for (uint32_t i = 0; i < a->count; i++) {
        if (a->machine[i] != number)
            continue;
        const double own = jox_own(a, i, (uint32_t)(*value)->index);
        most = isnan(most) || (greatest ? own > most : own < most) ? own : most;
    }
    return most;
}

static JoxPosition get_position(const JoxMachine *machine, const JoxState *state,
                                const JoxValue *value) {
    return value->line > 0
               ? (JoxPosition){jox_machine_file(machine, value->source), value->line, 0, 0}
               : (JoxPosition){jox_machine_file(machine, state->source), state->line, 0, 0};
}

/* Returns the least measure of people in a state, m: the depth of their torsos, or of discs the
   diameter. */
static double find_least_depth(const JoScene *scene, uint32_t number, const JoxState *state) {
    const JoxValue *unused;
    const double radius = find_extreme(scene, number, state, JOX_PARAM_radius, false, &unused);
    if (scene->spec->literal)
        return 2.0 * radius;
    const double breadth = find_extreme(scene, number, state, JOX_PARAM_breadth, false, &unused),
                 depth = find_extreme(scene, number, state, JOX_PARAM_depth, false, &unused);
    return 2.0 * (double)jox_torso_of((float)breadth, (float)depth, (float)radius).radius;
}

/* Warns if agents in a state walk past a person, or are pushed past one, within a step. Returns
   whether it did. */
static bool check_state_step(const JoScene *scene, uint32_t number, const JoxState *state,
                             double step, JoxDiagnostics *diagnostics) {
    const JoxMachine *machine = scene->world->machines.set->items[number];
    const JoxValue *at, *unused;
    const double depth = find_least_depth(scene, number, state);
    const double mass = find_extreme(scene, number, state, JOX_PARAM_mass, false, &unused);
    const double speed = find_extreme(scene, number, state, JOX_PARAM_max_speed, true, &at);
    char hint[80];
    if (speed * step > depth) {
        snprintf(hint, sizeof hint, "step: %.2g", depth / speed);
        jox_diag_warn(
            diagnostics, get_position(machine, state, at), "coarse-step", hint,
            "in state %.60s of %.60s people may go at %g m/s, %.3g m in a step of %.3g s: "
            "they pass others, who are %.3g m deep, without meeting them",
            state->name, machine->name, speed, speed * step, step, depth);
        return true;
    }
    const double push = find_extreme(scene, number, state, JOX_PARAM_push, true, &at);
    const double way = push / mass * step * step;
    if (!(way > depth))
        return false;
    snprintf(hint, sizeof hint, "step: %.2g", sqrt(depth * mass / push));
    jox_diag_warn(
        diagnostics, get_position(machine, state, at), "coarse-step", hint,
        "in state %.60s of %.60s people may push with %g N: that moves %g kg by %.3g m in "
        "a step of %.3g s, through others, who are %.3g m deep",
        state->name, machine->name, push, mass, way, step, depth);
    return true;
}

void jox_run_check_step_length(const JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoxMachineSet *set = scene->world->machines.set;
    const double step = jox_world_substep_length(scene->world);
    for (uint32_t m = 0; m < set->count; m++)
        for (uint32_t s = 0; s < set->items[m]->state_count; s++)
            if (check_state_step(scene, m, &set->items[m]->states[s], step, diagnostics))
                break; /* one warning a machine is enough */
}

/* ---- people in walls and in each other ---- */

static const double FAR_SHIFT = 0.5; /* m: a smaller shift is noted, not warned of */

static void report_shifted(const JoxGroup *group, const JoxPlaced *placed,
                           JoxDiagnostics *diagnostics) {
    const bool far = (double)placed->farthest > FAR_SHIFT;
    char people[JOX_NOUN];
    jox_diag_add(diagnostics, far ? JOX_SEVERITY_WARNING : JOX_SEVERITY_NOTE, group->position,
                 "placed-in-others",
                 far ? "Widen the place, lower the count, or give other points" : NULL, NULL, NULL,
                 "%u of the %s of group '%.60s' %s placed at a wall or deep in others; they begin "
                 "up to %.2f m away",
                 placed->shifted, jox_noun(people, group->count, "person|people"), group->name,
                 placed->shifted == 1 ? "was" : "were", (double)placed->farthest);
}

/* Warns of people who do not fit. Adds an error if nobody fits or, where the group gives a
   count, fewer than half do: figures of so few would be those of another scene. */
static void report_not_placed(const JoxStoreys *storeys, const JoxGroup *group,
                              const JoxPlaced *placed, JoxDiagnostics *diagnostics) {
    const bool given = group->fill == JOX_FILL_AT || group->starts;
    const uint32_t fit = group->count - placed->not_placed;
    const bool refused = fit == 0 || (!given && placed->not_placed > fit);
    const JoxV2 first = group->positions[placed->first];
    char people[JOX_NOUN], hint[100];
    JoxText why = {0};
    if (placed->in_solid == placed->not_placed)
        jox_world_explain_unplaced(storeys, JOX_BIRTH_IN_SOLID, first, &why);
    else if (group->in_count)
        jox_text_add(&why, "no spot of its place is free");
    else
        jox_world_explain_unplaced(storeys, JOX_BIRTH_NO_ROOM, first, &why);
    if (placed->not_found)
        jox_text_printf(&why,
                        "; for %u of them the search was ended, as %d spots had been looked at",
                        placed->not_found, JOX_SPOTS_MOST);
    snprintf(hint, sizeof hint, "Lower the count to %u, widen the place, or lower the radius", fit);
    jox_diag_add(diagnostics, refused ? JOX_SEVERITY_ERROR : JOX_SEVERITY_WARNING, group->position,
                 "not-placed", given ? "Give other points" : hint, NULL, NULL,
                 "%u of the %s of group '%.60s' %s not placed: %s", placed->not_placed,
                 jox_noun(people, group->count, "person|people"), group->name,
                 placed->not_placed == 1 ? "is" : "are", why.data);
    jox_text_free(&why);
}

static void place_groups(JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoxSceneSpec *spec = scene->spec;
    JoxPlaced *placed = jox_alloc((size_t)spec->group_count + 1, sizeof *placed);
    jox_world_populate(scene->world, placed);
    for (uint32_t g = 0; g < spec->group_count; g++) {
        if (placed[g].shifted)
            report_shifted(&spec->groups[g], &placed[g], diagnostics);
        if (placed[g].not_placed)
            report_not_placed(&spec->storeys, &spec->groups[g], &placed[g], diagnostics);
    }
    jox_free(placed);
}

/* ---- all of it ---- */

void jox_run_place_groups(JoScene *scene, JoxDiagnostics *diagnostics) {
    jox_run_link_groups(scene, scene->spec, diagnostics);
    if (diagnostics->errors)
        return;
    jox_run_set_schedule(scene, true);
    place_groups(scene, diagnostics);
}
