/* Resolves targets: the place, body, agent or point that a target means for one agent at
   present. */
#include <math.h>

#include "agents/torso.h"
#include "base/assert.h"
#include "machine/machine_parts.h"

/* Returns the index of a place if it is valid, else -1. */
static inline int32_t keep_valid_place(const JoxMachineRun *run, int32_t place) {
    return place >= 0 && (uint32_t)place < run->place_count ? place : -1;
}

/* Returns the place that a target is for one agent, or -1. */
static inline int32_t resolve_place(const JoxMachineRun *run, const JoxTarget *target,
                                    uint32_t agent) {
    int32_t place = -1;
    if (target->kind == JOX_TARGET_PLACE)
        place = target->arg;
    else if (target->kind == JOX_TARGET_OWN_PLACE)
        place = (int32_t)jox_own(run->agents, agent, (uint32_t)target->arg);
    else if (target->kind == JOX_TARGET_GOAL || target->kind == JOX_TARGET_ONE_OF ||
             target->kind == JOX_TARGET_ONE_OF_OWN)
        place = run->agents->goal[agent];
    return keep_valid_place(run, place);
}

int32_t jox_target_place(const JoxMachineRun *run, uint32_t agent, int32_t index) {
    int32_t place;
    jox_target_places(run, jox_machine_of(run, agent), index, &agent, 1, &place);
    return place;
}

void jox_target_places(const JoxMachineRun *run, const JoxMachine *machine, int32_t index,
                       const uint32_t *agents, uint32_t count, int32_t *places) {
    JOX_ASSERT(index < 0 || (uint32_t)index < machine->target_count);
    const JoxTarget *target = index < 0 ? NULL : &machine->targets[index];
    const JoxOwnColumn *own =
        target && target->kind == JOX_TARGET_OWN_PLACE ? &run->agents->own[target->arg] : NULL;
    const bool same = own ? !own->mask : !target || target->kind == JOX_TARGET_PLACE;
    const int32_t first = target ? resolve_place(run, target, agents[0]) : -1;
    if (same)
        for (uint32_t n = 0; n < count; n++)
            places[n] = first;
    else if (own)
        for (uint32_t n = 0; n < count; n++)
            places[n] = keep_valid_place(run, (int32_t)own->cells[agents[n]]);
    else
        for (uint32_t n = 0; n < count; n++)
            places[n] = resolve_place(run, target, agents[n]);
}

/* Returns agent `other` as agent i sees it: across a periodic edge if that is nearer. */
static JoxSpot make_agent_spot(const JoxMachineRun *run, uint32_t i, uint32_t other) {
    const JoxAgents *a = run->agents;
    JoxV2 offset = jox_offset(a, i, other);
    return (JoxSpot){.found = true,
                     .x = a->x[i] + offset.x,
                     .y = a->y[i] + offset.y,
                     .vx = a->vx[other],
                     .vy = a->vy[other],
                     .radius = jox_param(a, JOX_PARAM_radius, other),
                     .place = -1,
                     .object = -1,
                     .agent = other};
}

static JoxSpot make_object_spot(const JoxObject *o, int32_t row) {
    return (JoxSpot){.found = true,
                     .x = o->position.x,
                     .y = o->position.y,
                     .z = o->position.z,
                     .vx = o->velocity.x,
                     .vy = o->velocity.y,
                     .radius = o->footprint_count ? o->disc : o->round,
                     .place = -1,
                     .object = row,
                     .agent = JOX_NO_INDEX};
}

/* Returns the first agent that jox_machines_seen would list for a target: from the neighbours,
   nearest first, then, in a small crowd, from all within perception. JOX_NO_INDEX: none. */
static uint32_t find_nearest_agent(const JoxMachineRun *run, const JoxTarget *target, uint32_t i) {
    const JoxAgents *a = run->agents;
    const JoxNeighbours *n = run->neighbours;
    for (uint32_t k = 0; k < n->count[i]; k++) {
        uint32_t j = n->index[jox_neighbour_at(n, i, k)];
        if (jox_is_wanted(run, target, i, j))
            return j;
    }
    uint32_t best = JOX_NO_INDEX;
    float reach = jox_param(a, JOX_PARAM_perception, i), least = reach * reach;
    for (uint32_t j = 0; a->count <= JOX_SMALL_CROWD && j < a->count; j++) {
        float d2 = jox_length2(jox_offset(a, i, j));
        if (j == i || d2 > least || !jox_is_wanted(run, target, i, j))
            continue;
        if (d2 < least || best == JOX_NO_INDEX || a->id[j] < a->id[best]) {
            least = d2;
            best = j;
        }
    }
    return best;
}

/* Returns whether a wall or another body hides a body; a body in the air is seen above lower
   ones. */
static bool is_out_of_sight(const JoxMachineRun *run, uint32_t i, const JoxObject *object) {
    const JoxV2 from = {run->agents->x[i], run->agents->y[i]};
    const JoxV2 to = {object->position.x, object->position.y};
    return object->in_band &&
           (jox_is_hidden(run, from, to, false) ||
            jox_is_behind_body(run, from, to, (int32_t)(object - run->objects->rows)));
}

/* Returns whether a body bears the tag of a target and passes its filter. */
static bool is_wanted_body(const JoxTarget *target, const JoxObject *object, JoxV2 offset) {
    const JoxAgentFilter *filter = &target->filter;
    return object->live && (object->tags >> target->arg & 1) &&
           (!filter->flies || jox_object_flies(object)) &&
           (filter->comes == 0.0f ||
            jox_pass_distance(offset, jox_v2(object->velocity.x, object->velocity.y)) <
                filter->comes);
}

static int32_t find_nearest_object(const JoxMachineRun *run, const JoxTarget *target, uint32_t i,
                                   float *distance2) {
    const JoxAgents *a = run->agents;
    float reach = jox_param(a, JOX_PARAM_perception, i);
    int32_t best = -1;
    *distance2 = reach * reach;
    for (uint32_t o = 0; run->objects && o < run->objects->count; o++) {
        const JoxObject *object = &run->objects->rows[o];
        const JoxV2 offset = {object->position.x - a->x[i], object->position.y - a->y[i]};
        const float d2 = jox_length2(offset);
        if (d2 < *distance2 && is_wanted_body(target, object, offset) &&
            !is_out_of_sight(run, i, object)) {
            *distance2 = d2;
            best = (int32_t)o;
        }
    }
    return best;
}

JoxSpot jox_target_find(const JoxMachineRun *run, uint32_t i, int32_t index) {
    JoxSpot none = {.place = -1, .object = -1, .agent = JOX_NO_INDEX};
    const JoxAgents *a = run->agents;
    if (index < 0)
        return make_agent_spot(run, i, i);
    JOX_ASSERT((uint32_t)index < jox_machine_of(run, i)->target_count);
    const JoxTarget *target = &jox_machine_of(run, i)->targets[index];
    if (target->kind < JOX_TARGET_NEAREST) {
        int32_t place = jox_target_place(run, i, index);
        if (place < 0)
            return none;
        JoxV2 p = jox_place_nearest(run->places, (uint32_t)place, (JoxV2){a->x[i], a->y[i]});
        return (JoxSpot){true, p.x, p.y, 0, 0, 0, 0, place, -1, JOX_NO_INDEX};
    }
    if (target->kind == JOX_TARGET_HOME) {
        const double *post = jox_home_position(run, i);
        return (JoxSpot){true, (float)post[0], (float)post[1], 0, 0, 0, 0, -1, -1, JOX_NO_INDEX};
    }
    float object_d2 = INFINITY;
    int32_t object = target->kind == JOX_TARGET_NEAREST && !target->filter.some
                         ? find_nearest_object(run, target, i, &object_d2)
                         : -1;
    const uint32_t other = target->filter.flies ? JOX_NO_INDEX : find_nearest_agent(run, target, i);
    if (other != JOX_NO_INDEX) {
        if (object < 0 || jox_length2(jox_offset(a, i, other)) < object_d2)
            return make_agent_spot(run, i, other);
    }
    return object >= 0 ? make_object_spot(&run->objects->rows[object], object) : none;
}

bool jox_target_means(const JoxMachineRun *run, uint32_t i, int32_t index, int32_t row) {
    if (index < 0 || row < 0 || !run->objects || (uint32_t)row >= run->objects->count)
        return false;
    const JoxTarget *target = &jox_machine_of(run, i)->targets[index];
    const JoxObject *object = &run->objects->rows[row];
    return target->kind == JOX_TARGET_NEAREST && object->live &&
           (object->tags >> target->arg & 1) != 0;
}

float jox_target_distance(const JoxMachineRun *run, uint32_t i, int32_t index) {
    JoxV2 p = {run->agents->x[i], run->agents->y[i]};
    int32_t place = jox_target_place(run, i, index);
    if (place >= 0)
        return jox_place_distance(run->places, (uint32_t)place, p);
    JoxSpot spot = jox_target_find(run, i, index);
    return spot.found ? jox_length((JoxV2){spot.x - p.x, spot.y - p.y}) : INFINITY;
}

float jox_spot_gap(const JoxMachineRun *run, uint32_t i, const JoxSpot *spot) {
    if (!spot->found)
        return INFINITY;
    const JoxAgents *a = run->agents;
    const JoxV2 at = {spot->x, spot->y};
    const float discs = jox_length(jox_sub(at, (JoxV2){a->x[i], a->y[i]})) - spot->radius -
                        jox_param(a, JOX_PARAM_radius, i);
    const float torsos = spot->agent != JOX_NO_INDEX ? jox_torso_gap(a, i, spot->agent)
                                                     : jox_torso_distance(a, i, at) - spot->radius;
    return jox_minf(discs, torsos); /* hands and feet reach to the edge of the disc */
}

JoxV2 jox_player_wants(const JoxMachineRun *run, uint32_t i) {
    for (uint32_t k = 0; k < run->input_count; k++)
        if (run->inputs[k].agent_id == run->agents->id[i])
            return (JoxV2){run->inputs[k].vx, run->inputs[k].vy};
    return (JoxV2){0.0f, 0.0f};
}

float jox_driven(const JoxMachineRun *run, uint32_t i) {
    return jox_length(jox_player_wants(run, i));
}

/* Ignores agents that head the other way, which are avoided, not followed: if people waited for
   each other, opposite streams would stop face to face. */
float jox_headway(const JoxMachineRun *run, uint32_t i) {
    const JoxAgents *a = run->agents;
    const JoxNeighbours *n = run->neighbours;
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    JoxV2 ahead = jox_unit((JoxV2){a->pref_x[i], a->pref_y[i]});
    if (jox_length2(ahead) == 0.0f)
        ahead = (JoxV2){a->face_x[i], a->face_y[i]};
    float best = jox_param(a, JOX_PARAM_perception, i);
    for (uint32_t k = 0; k < n->count[i]; k++) {
        uint32_t j = n->index[jox_neighbour_at(n, i, k)];
        JoxV2 d = jox_offset(a, i, j);
        float along = jox_dot(d, ahead), aside = fabsf(jox_det(d, ahead));
        float sum = jox_at(radius, i) + jox_at(radius, j);
        if (along > 0.0f && aside < sum / 2.0f && jox_dot(jox_heading_of(run, j), ahead) >= 0.0f)
            best = jox_minf(best, jox_maxf(along - sum, 0.0f));
    }
    return best;
}
