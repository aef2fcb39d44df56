/* Visibility and filters: which points walls and bodies hide from each other, and which agents
   match a target. */
#include <math.h>

#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "geom/polygon.h"
#include "geom/wall_grid.h"
#include "machine/machine_parts.h"
#include "machine/way_between.h"

/* Returns whether the bounding box of a segment and that of an edge are disjoint. */
static bool misses_box(JoxV2 from, JoxV2 to, JoxV2 a, JoxV2 b) {
    return jox_maxf(a.x, b.x) < jox_minf(from.x, to.x) ||
           jox_minf(a.x, b.x) > jox_maxf(from.x, to.x) ||
           jox_maxf(a.y, b.y) < jox_minf(from.y, to.y) ||
           jox_minf(a.y, b.y) > jox_maxf(from.y, to.y);
}

/* Returns the first edge that a segment crosses, of a closed wall of another ring than `but` and at
   least `least_height` m high: its vertex, or -1. */
static int64_t stopping_edge(const JoxWalls *walls, uint32_t but, JoxV2 from, JoxV2 to,
                             float least_height) {
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        if (r == but || ring->open || ring->height < least_height)
            continue;
        for (uint32_t v = ring->first; v < ring->first + ring->count; v++) {
            const JoxV2 a = walls->vertices[v].point,
                        b = walls->vertices[walls->vertices[v].next].point;
            if (!misses_box(from, to, a, b) && !walls->vertices[v].absent &&
                jox_segments_cross(from, to, a, b))
                return v;
        }
    }
    return -1;
}

bool jox_is_hidden_by(const JoxMachineRun *run, uint32_t but, JoxV2 from, JoxV2 to, bool touched) {
    const float least_height = touched ? 0.0f : JOX_EYE_LEVEL;
    return (run->walls && stopping_edge(run->walls, but, from, to, least_height) >= 0) ||
           (run->wall_images &&
            stopping_edge(run->wall_images, UINT32_MAX, from, to, least_height) >= 0);
}

/* Returns an edge of the walls or of their images that stops a touch; none: its walls are NULL. */
static JoxHidingEdge find_stopping_edge(const JoxMachineRun *run, JoxV2 from, JoxV2 to) {
    const JoxWalls *lists[] = {run->walls, run->wall_images};
    for (int k = 0; k < 2; k++) {
        const int64_t edge = lists[k] ? stopping_edge(lists[k], UINT32_MAX, from, to, 0.0f) : -1;
        if (edge >= 0)
            return (JoxHidingEdge){lists[k], (uint32_t)edge};
    }
    return (JoxHidingEdge){NULL, 0};
}

bool jox_is_reach_hidden(const JoxMachineRun *run, JoxV2 from, JoxV2 to, JoxHidingEdge *last) {
    if (last->walls) {
        const JoxWallVertex *v = &last->walls->vertices[last->edge];
        if (jox_segments_cross(from, to, v->point, last->walls->vertices[v->next].point))
            return true;
    }
    const JoxHidingEdge found = find_stopping_edge(run, from, to);
    if (found.walls)
        *last = found;
    return found.walls;
}

bool jox_is_hidden(const JoxMachineRun *run, JoxV2 from, JoxV2 to, bool touched) {
    return jox_is_hidden_by(run, UINT32_MAX, from, to, touched);
}

bool jox_meets_wall(const JoxMachineRun *run, JoxV2 from, JoxV2 to, JoxV2 *normal) {
    const JoxHidingEdge found = find_stopping_edge(run, from, to);
    if (found.walls)
        *normal = jox_left(found.walls->vertices[found.edge].direction);
    return found.walls;
}

/* ---- bodies ---- */

static bool blocks_line(const JoxObject *body, JoxV2 from, JoxV2 to) {
    if (jox_footprint_nearest(body, from).gap <= 0.0f ||
        jox_footprint_nearest(body, to).gap <= 0.0f)
        return false;
    const JoxV2 centre = {body->position.x, body->position.y};
    if (body->footprint_count == 0)
        return jox_length(jox_sub(jox_segment_nearest(from, to, centre), centre)) < body->round;
    for (uint32_t k = 0; k < body->footprint_count; k++)
        if (jox_segments_cross(from, to, body->footprint[k],
                               body->footprint[(k + 1) % body->footprint_count]))
            return true;
    return false;
}

bool jox_is_behind_body(const JoxMachineRun *run, JoxV2 from, JoxV2 to, int32_t but) {
    if (!run->objects || run->objects->grid.columns == 0 || !run->objects->grid.hides_people)
        return false;
    const JoxV2 middle = jox_scale(jox_add(from, to), 0.5f);
    JoxObjectWalk walk =
        jox_objects_near(run->objects, middle, 0.5f * jox_length(jox_sub(to, from)));
    uint32_t row;
    while (jox_objects_next(&walk, &row))
        if ((int32_t)row != but && jox_object_hides_people(&run->objects->rows[row]) &&
            blocks_line(&run->objects->rows[row], from, to))
            return true;
    return false;
}

/* ---- other agents ---- */

double jox_public_memory(const JoxMachineRun *run, uint32_t agent, uint32_t name) {
    const JoxAgents *a = run->agents;
    if (a->machine[agent] == JOX_NO_MACHINE)
        return NAN;
    const JoxMachine *machine = jox_machine_of(run, agent);
    for (uint32_t s = 0; s < machine->memory_count; s++)
        if (machine->memory[s].is_public && machine->memory[s].name_number == name)
            return a->memory[(size_t)agent * a->memory_stride + s];
    return NAN;
}

/* Returns whether a state has the name with this number, or is within an outer state that has it.
 */
static bool has_name(const JoxState *state, uint32_t number) {
    bool also = false;
    for (uint32_t n = 0; n < state->also_count; n++)
        also |= state->also[n] == number;
    return also || state->name_number == number;
}

/* Names are those of agent i's machine. */
static bool passes_names(const JoxMachineRun *run, const JoxAgentFilter *filter, uint32_t i,
                         uint32_t j) {
    const JoxAgents *a = run->agents;
    const JoxName *names = jox_machine_of(run, i)->names;
    if ((filter->group >= 0 && a->group[j] != filter->group) ||
        (filter->fallen && !(a->fallen[j] > 0.0f)))
        return false;
    if (filter->state < 0 && filter->machine < 0 && filter->memory < 0)
        return true;
    if (a->machine[j] == JOX_NO_MACHINE)
        return false;
    const JoxMachine *machine = jox_machine_of(run, j);
    if (filter->machine >= 0 && machine->name_number != names[filter->machine].number)
        return false;
    if (filter->state >= 0 && !has_name(&machine->states[a->state[j]], names[filter->state].number))
        return false;
    if (filter->memory < 0)
        return true;
    const double value = jox_public_memory(run, j, names[filter->memory].number);
    return value >= filter->least && value <= filter->greatest;
}

bool jox_is_of_kind(const JoxAgents *a, const JoxTarget *target, uint32_t i, uint32_t j) {
    switch (target->kind) { /* team 0 means no team: neither teammate nor opponent */
    case JOX_TARGET_NEAREST:
        return (a->tags[j] >> target->arg & 1) != 0;
    case JOX_TARGET_OPPONENT:
        return a->team[i] != a->team[j] && a->team[i] && a->team[j];
    case JOX_TARGET_ANYONE:
        return true;
    case JOX_TARGET_TEAMMATE:
        return a->team[i] == a->team[j] && a->team[i];
    default:
        return false;
    }
}

bool jox_passes_view(const JoxMachineRun *run, const JoxAgentFilter *filter, uint32_t i,
                     JoxV2 offset, JoxV2 velocity) {
    if (filter->comes > 0.0f && !(jox_pass_distance(offset, velocity) < filter->comes))
        return false;
    if (filter->within > 0.0f && !(jox_length2(offset) < filter->within * filter->within))
        return false;
    if (filter->ahead == 0.0f)
        return true;
    const JoxV2 looks = {run->agents->face_x[i], run->agents->face_y[i]};
    const float least = (float)jox_cos((double)filter->ahead * JOX_DEGREE);
    return jox_dot(looks, offset) >= least * jox_length(offset);
}

bool jox_passes_filter(const JoxMachineRun *run, const JoxAgentFilter *filter, uint32_t i,
                       uint32_t j) {
    const JoxAgents *a = run->agents;
    return (!filter->some || passes_names(run, filter, i, j)) &&
           jox_passes_view(run, filter, i, jox_way_between(a, i, j), jox_v2(a->vx[j], a->vy[j]));
}

/* Returns whether agent i sees agent j, however far away it is. */
static bool has_in_sight(const JoxMachineRun *run, uint32_t i, uint32_t j) {
    const JoxV2 from = {run->agents->x[i], run->agents->y[i]},
                to = jox_add(from, jox_way_between(run->agents, i, j));
    return !jox_is_hidden(run, from, to, false) && !jox_is_behind_body(run, from, to, -1);
}

bool jox_sees_agent(const JoxMachineRun *run, uint32_t i, uint32_t j) {
    const float reach = jox_param(run->agents, JOX_PARAM_perception, i);
    return jox_length2(jox_way_between(run->agents, i, j)) <= reach * reach &&
           has_in_sight(run, i, j);
}

bool jox_sees_body(const JoxMachineRun *run, uint32_t i, uint32_t row) {
    const JoxAgents *a = run->agents;
    const JoxObject *body = &run->objects->rows[row];
    const JoxV2 from = {a->x[i], a->y[i]}, to = {body->position.x, body->position.y};
    const float reach = jox_param(a, JOX_PARAM_perception, i);
    if (!(jox_length2(jox_sub(to, from)) < reach * reach))
        return false;
    return !body->in_band || (!jox_is_hidden(run, from, to, false) &&
                              !jox_is_behind_body(run, from, to, (int32_t)row));
}

bool jox_is_wanted(const JoxMachineRun *run, const JoxTarget *target, uint32_t i, uint32_t j) {
    return jox_is_of_kind(run->agents, target, i, j) &&
           jox_passes_filter(run, &target->filter, i, j) && has_in_sight(run, i, j);
}

bool jox_is_wanted_body(const JoxMachineRun *run, const JoxTarget *target, uint32_t i,
                        const JoxObject *object) {
    const JoxAgents *a = run->agents;
    const JoxV2 offset = {object->position.x - a->x[i], object->position.y - a->y[i]};
    return target->kind == JOX_TARGET_NEAREST && !target->filter.some && object->live &&
           (object->tags >> target->arg & 1) &&
           (!target->filter.flies || jox_object_flies(object)) &&
           jox_passes_view(run, &target->filter, i, offset,
                           jox_v2(object->velocity.x, object->velocity.y));
}

/* In a small crowd, adds the agents within perception that are not among the neighbours of agent i,
   by distance, then id. Returns the new count. */
static uint32_t add_others(const JoxMachineRun *run, const JoxTarget *target, uint32_t i,
                           uint32_t *found, uint32_t count) {
    const JoxAgents *a = run->agents;
    const JoxNeighbours *n = run->neighbours;
    const float reach = jox_param(a, JOX_PARAM_perception, i);
    const uint32_t first = count;
    float away[JOX_SMALL_CROWD];
    for (uint32_t j = 0; a->count <= JOX_SMALL_CROWD && j < a->count; j++) {
        const float d2 = jox_length2(jox_way_between(a, i, j));
        bool known = j == i;
        for (uint32_t k = 0; k < n->count[i] && !known; k++)
            known = n->index[jox_neighbour_at(n, i, k)] == j;
        if (known || d2 > reach * reach || !jox_is_wanted(run, target, i, j))
            continue;
        uint32_t at = count++;
        for (; at > first &&
               (away[at - 1] > d2 || (away[at - 1] == d2 && a->id[found[at - 1]] > a->id[j]));
             at--) {
            away[at] = away[at - 1];
            found[at] = found[at - 1];
        }
        away[at] = d2;
        found[at] = j;
    }
    return count;
}

uint32_t jox_list_wanted(const JoxMachineRun *run, const JoxTarget *target, uint32_t i,
                         uint32_t found[JOX_SMALL_CROWD]) {
    const JoxNeighbours *n = run->neighbours;
    uint32_t count = 0;
    for (uint32_t k = 0; k < n->count[i]; k++) {
        const uint32_t j = n->index[jox_neighbour_at(n, i, k)];
        if (jox_is_wanted(run, target, i, j))
            found[count++] = j;
    }
    return add_others(run, target, i, found, count);
}

uint32_t jox_machines_seen(const JoxMachineRun *run, uint32_t agent,
                           uint32_t seen[JOX_SMALL_CROWD]) {
    const JoxTarget anyone = {.kind = JOX_TARGET_ANYONE};
    return jox_list_wanted(run, &anyone, agent, seen);
}

uint32_t jox_neighbours_of(const JoxMachineRun *run, uint32_t i, int32_t target) {
    uint32_t found[JOX_SMALL_CROWD];
    return jox_list_wanted(run, &jox_machine_of(run, i)->targets[target], i, found);
}
