/* Somebody as a number (JOX_WHO_BODY in target_kinds.h): which agent, body or place it means, whom
   an agent holds, who struck it, and where somebody is. Targets are resolved in target.c. */
#include <math.h>

#include "agents/torso.h"
#include "base/mem.h"
#include "machine/machine_parts.h"
#include "machine/way_between.h"

/* Returns whether a number is a whole one from `first` on, and 32 bits hold its distance from that.
 */
static bool is_within_ids(double who, double first) {
    return who >= first && who <= first + UINT32_MAX && who == floor(who);
}

uint32_t jox_who_agent(const JoxMachineRun *run, double who) {
    if (!is_within_ids(who, 1.0))
        return JOX_NO_INDEX;
    const uint32_t i = jox_agents_find(run->agents, (uint32_t)(who - 1.0));
    return i == JOX_NO_INDEX || run->agents->removed[i] ? JOX_NO_INDEX : i;
}

int32_t jox_who_row(const JoxMachineRun *run, double who) {
    if (!is_within_ids(who, JOX_WHO_BODY) || !run->objects)
        return -1;
    const uint32_t id = (uint32_t)(who - JOX_WHO_BODY);
    for (uint32_t o = 0; o < run->objects->count; o++)
        if (run->objects->rows[o].id == id && run->objects->rows[o].live)
            return (int32_t)o;
    return -1;
}

int32_t jox_who_place(const JoxMachineRun *run, double who) {
    return is_within_ids(who, JOX_WHO_PLACE) && who < JOX_WHO_PLACE + run->place_count
               ? (int32_t)(who - JOX_WHO_PLACE)
               : -1;
}

bool jox_who_exists(const JoxMachineRun *run, double who) {
    return jox_who_agent(run, who) != JOX_NO_INDEX || jox_who_row(run, who) >= 0 ||
           jox_who_place(run, who) >= 0;
}

void jox_who_print(const JoxMachineRun *run, double who, JoxText *out) {
    const uint32_t i = jox_who_agent(run, who);
    const int32_t row = jox_who_row(run, who), place = jox_who_place(run, who);
    if (i != JOX_NO_INDEX)
        jox_text_printf(out, "agent %u", run->agents->id[i]);
    else if (row >= 0 && *run->objects->rows[row].name)
        jox_text_printf(out, "body '%s'", run->objects->rows[row].name);
    else if (row >= 0)
        jox_text_printf(out, "body %u", run->objects->rows[row].id);
    else if (place >= 0)
        jox_text_printf(out, "place '%s'", run->places[place].name);
    else
        jox_text_add(out, "nobody");
}

/* Returns the row of a body that the agent carries, or -1. */
static int32_t find_carried_row(const JoxMachineRun *run, uint32_t i) {
    for (uint32_t o = 0; run->objects && o < run->objects->count; o++) {
        const JoxObject *object = &run->objects->rows[o];
        if (object->live && object->held && object->holder == run->agents->id[i])
            return (int32_t)o;
    }
    return -1;
}

double jox_who_is_held(const JoxMachineRun *run, uint32_t i) {
    const int32_t row = find_carried_row(run, i);
    return row >= 0 ? JOX_WHO_BODY + run->objects->rows[row].id : run->agents->grasped[i];
}

/* ---- spots ---- */

JoxSpot jox_spot_agent(const JoxMachineRun *run, uint32_t i, uint32_t other) {
    const JoxAgents *a = run->agents;
    const JoxV2 offset = jox_way_between(a, i, other);
    if (!(fabsf(offset.y) < JOX_OUT_OF_SIGHT))
        return JOX_NO_SPOT;
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

JoxSpot jox_spot_body(const JoxObject *o, int32_t row) {
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

JoxSpot jox_spot_place(const JoxMachineRun *run, uint32_t i, int32_t place) {
    if (place < 0)
        return JOX_NO_SPOT;
    const JoxV2 own = {run->agents->x[i], run->agents->y[i]};
    const JoxV2 p = jox_place_nearest(run->places, (uint32_t)place, own);
    return (JoxSpot){true, p.x, p.y, 0, 0, 0, 0, place, -1, JOX_NO_INDEX};
}

JoxSpot jox_who_spot(const JoxMachineRun *run, uint32_t i, double who) {
    const uint32_t agent = jox_who_agent(run, who);
    if (agent != JOX_NO_INDEX)
        return jox_spot_agent(run, i, agent);
    const int32_t row = jox_who_row(run, who);
    return row >= 0 ? jox_spot_body(&run->objects->rows[row], row)
                    : jox_spot_place(run, i, jox_who_place(run, who));
}

/* The candidate that `other` means in this thread while a score is computed. */
static _Thread_local const JoxSpot *considered;

void jox_target_consider(const JoxSpot *candidate) {
    considered = candidate;
}

const JoxSpot *jox_target_considered(void) {
    return considered;
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

/* ---- who struck an agent ---- */

void jox_throwers_note(JoxMachineRun *run, uint32_t body, uint32_t agent) {
    JoxMachineState *state = run->state;
    uint32_t kept = 0;
    for (uint32_t n = 0; n < state->thrown_count; n++) /* forgets bodies that are gone */
        if (state->thrown[n].body != body &&
            jox_who_row(run, JOX_WHO_BODY + state->thrown[n].body) >= 0)
            state->thrown[kept++] = state->thrown[n];
    JOX_RESERVE(state->thrown, state->thrown_capacity, kept + 1);
    state->thrown[kept] = (JoxThrown){body, agent};
    state->thrown_count = kept + 1;
}

/* Returns the row of the body that hits an agent, as the word hit_by sees it: the one that struck
   it in the last step, else the nearest that is faster than 1 m/s and touches it; -1: none. */
static int32_t find_striking_row(const JoxMachineRun *run, uint32_t i) {
    const JoxV2 own = {run->agents->x[i], run->agents->y[i]};
    int32_t row = jox_referred(run->agents->struck[i]);
    if (!run->objects)
        return -1;
    if (row >= 0 && (uint32_t)row < run->objects->count && run->objects->rows[row].live)
        return row;
    float least = JOX_HIT_GAP;
    row = -1;
    for (uint32_t o = 0; o < run->objects->count; o++) {
        const JoxObject *body = &run->objects->rows[o];
        const JoxV2 velocity = {body->velocity.x, body->velocity.y};
        if (!body->live || body->held || !(jox_length2(velocity) > 1.0f))
            continue;
        const JoxSpot spot = jox_spot_body(body, (int32_t)o);
        const float gap = jox_spot_gap(run, i, &spot);
        if (gap < least && !jox_is_hidden(run, own, (JoxV2){spot.x, spot.y}, true)) {
            least = gap;
            row = (int32_t)o;
        }
    }
    return row;
}

double jox_who_struck(const JoxMachineRun *run, uint32_t i) {
    const int32_t row = find_striking_row(run, i);
    if (row < 0)
        return JOX_NOBODY;
    const uint32_t body = run->objects->rows[row].id;
    for (uint32_t n = 0; n < run->state->thrown_count; n++) {
        const JoxThrown *thrown = &run->state->thrown[n];
        if (thrown->body == body && thrown->agent != run->agents->id[i] &&
            jox_who_agent(run, 1.0 + thrown->agent) != JOX_NO_INDEX)
            return 1.0 + thrown->agent;
    }
    return JOX_WHO_BODY + body;
}
