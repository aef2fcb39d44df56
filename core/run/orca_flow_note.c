/* Tells by which law groups walk, and notes groups that walk by ORCA in scenes whose probes measure
   flow. `jostle check` and reports add the note. */
#include <string.h>

#include "run/orca_flow_note.h"
#include "run/run.h"
#include "run/scene_machines.h"

static const char HINT[] =
    "Where capacities matter: walker.lua, or time_gap = crowd.time_gap in the behaviour's defaults";

/* Returns the first probe that measures a flow, or NULL. */
static const JoxProbeDef *find_flow_probe(const JoxSceneSpec *spec) {
    for (uint32_t p = 0; p < spec->probe_count; p++)
        if (spec->probes[p].kind == JOX_PROBE_FLOW || spec->probes[p].kind == JOX_PROBE_MEASURE)
            return &spec->probes[p];
    return NULL;
}

static bool steers_toward_goal(const JoxState *state) {
    for (uint32_t t = 0; t < state->steer_count; t++)
        switch (state->steer[t].kind) {
        case JOX_STEER_SEEK:
        case JOX_STEER_ORBIT:
        case JOX_STEER_QUEUE:
        case JOX_STEER_FOLLOW:
        case JOX_STEER_FORMATION:
        case JOX_STEER_GATHER:
        case JOX_STEER_WANDER:
        case JOX_STEER_DRIFT:
        case JOX_STEER_ALONG:
        case JOX_STEER_FIELD:
        case JOX_STEER_RIDE:
            return true;
        default:
            break;
        }
    return false;
}

/* Whether agents in the state may keep a time gap, and so walk by the walking law. */
static bool keeps_time_gap(const JoxMachine *machine, const JoxState *state) {
    const JoxValue *gap = &state->param[JOX_PARAM_time_gap];
    if (gap->kind == JOX_VALUE_UNSET)
        gap = &machine->defaults[JOX_PARAM_time_gap];
    if (gap->kind == JOX_VALUE_OWN) {
        const JoxDist *dist = &machine->own[gap->index].dist;
        return dist->kind != JOX_DIST_CONSTANT || dist->a > 0.0;
    }
    return gap->kind == JOX_VALUE_EXPRESSION || gap->number > 0.0;
}

static bool sets_time_gap(const JoxGroup *group) {
    for (uint32_t s = 0; s < group->set_count; s++)
        if (strcmp(group->set[s].name, jox_parameters[JOX_PARAM_time_gap].name) == 0)
            return true;
    return false;
}

static const JoxState *find_orca_state(const JoxMachine *machine) {
    for (uint32_t s = 0; machine && s < machine->state_count; s++)
        if (steers_toward_goal(&machine->states[s]) &&
            !keeps_time_gap(machine, &machine->states[s]))
            return &machine->states[s];
    return NULL;
}

bool jox_run_group_walks_by(const JoScene *scene, uint32_t number, bool orca) {
    const JoxGroup *group = &scene->spec->groups[number];
    for (uint32_t s = 0; s < group->set_count; s++)
        if (strcmp(group->set[s].name, jox_parameters[JOX_PARAM_time_gap].name) == 0)
            return orca ==
                   !(group->set[s].dist.kind != JOX_DIST_CONSTANT || group->set[s].dist.a > 0.0);
    for (uint32_t m = 0; m < group->mix_count; m++) {
        const int32_t index = jox_run_find_machine(scene, group->mix[m].behaviour);
        const JoxMachine *machine = index < 0 ? NULL : scene->world->model.machines.items[index];
        for (uint32_t s = 0; machine && s < machine->state_count; s++)
            if (steers_toward_goal(&machine->states[s]) &&
                keeps_time_gap(machine, &machine->states[s]) != orca)
                return true;
    }
    return false;
}

bool jox_run_note_orca_flow(const JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoxProbeDef *probe = find_flow_probe(scene->spec);
    for (uint32_t g = 0; probe && g < scene->spec->group_count; g++) {
        const JoxGroup *group = &scene->spec->groups[g];
        for (uint32_t m = 0; m < group->mix_count && !sets_time_gap(group); m++) {
            const int32_t index = jox_run_find_machine(scene, group->mix[m].behaviour);
            const JoxMachine *machine =
                index < 0 ? NULL : scene->world->model.machines.items[index];
            const JoxState *state = find_orca_state(machine);
            if (!state)
                continue;
            jox_diag_add(diagnostics, JOX_SEVERITY_NOTE, group->mix[m].position, "orca-flow", HINT,
                         NULL, NULL,
                         "probe '%.60s' measures a flow, and in state %.60s of %.60s the people of "
                         "group '%.60s' choose velocities by ORCA, which is not fit for capacities",
                         probe->name, state->name, machine->name, group->name);
            return true;
        }
    }
    return false;
}
