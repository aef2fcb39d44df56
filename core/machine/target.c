/* Resolves targets: the place, body, agent or point that a target means for one agent at
   present. */
#include <math.h>

#include "agents/torso.h"
#include "base/assert.h"
#include "machine/lifts.h"
#include "machine/machine_parts.h"
#include "machine/way_between.h"

/* Returns the index of a place if it is valid, else -1. */
static inline int32_t keep_valid_place(const JoxMachineRun *run, int32_t place) {
    return place >= 0 && (uint32_t)place < run->place_count ? place : -1;
}

/* Returns whom a target that is memory holds. */
static inline double get_remembered(const JoxMachineRun *run, const JoxTarget *target,
                                    uint32_t agent) {
    const JoxAgents *a = run->agents;
    return a->memory[(size_t)agent * a->memory_stride + (uint32_t)target->arg];
}

/* Returns the place that a target is for one agent, or -1. */
static inline int32_t resolve_place(const JoxMachineRun *run, const JoxTarget *target,
                                    uint32_t agent) {
    int32_t place = -1;
    if (target->kind == JOX_TARGET_PLACE || target->kind == JOX_TARGET_BEST_PLACE)
        place = target->arg;
    else if (target->kind == JOX_TARGET_OWN_PLACE || target->kind == JOX_TARGET_BEST_OWN)
        place = (int32_t)jox_own(run->agents, agent, (uint32_t)target->arg);
    else if (target->kind == JOX_TARGET_GOAL || target->kind == JOX_TARGET_ONE_OF ||
             target->kind == JOX_TARGET_ONE_OF_OWN)
        place = run->agents->goal[agent];
    else if (target->kind == JOX_TARGET_MEMORY)
        place = jox_who_place(run, get_remembered(run, target, agent));
    else if (target->kind == JOX_TARGET_OTHER && jox_target_considered())
        place = jox_target_considered()->place;
    place = keep_valid_place(run, place);
    const bool best = target->kind == JOX_TARGET_BEST_PLACE || target->kind == JOX_TARGET_BEST_OWN;
    return best && place >= 0 ? jox_find_best_place(run, agent, target, place) : place;
}

int32_t jox_target_draw_place(const JoxMachineRun *run, uint32_t i, const JoxTarget *target,
                              uint32_t number) {
    const bool own = target->kind == JOX_TARGET_ONE_OF_OWN;
    if (!own && target->kind != JOX_TARGET_ONE_OF)
        return -1;
    const int32_t set = keep_valid_place(
        run, own ? (int32_t)jox_own(run->agents, i, (uint32_t)target->arg) : target->arg);
    const JoxPlace *place = set < 0 ? NULL : &run->places[set];
    if (!place || !place->member_count)
        return -1;
    const double u =
        jox_random_unit(run->seed, run->agents->id[i], run->tick, JOX_DRAW_ONE_OF, number);
    return place->members[(uint32_t)(u * place->member_count)];
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
    const int32_t first = target && same ? resolve_place(run, target, agents[0]) : -1;
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
        float d2 = jox_length2(jox_way_between(a, i, j));
        if (j == i || d2 > least || !jox_is_wanted(run, target, i, j))
            continue;
        if (d2 < least || best == JOX_NO_INDEX || a->id[j] < a->id[best]) {
            least = d2;
            best = j;
        }
    }
    return best;
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
        if (d2 < *distance2 && jox_is_wanted_body(run, target, i, object) &&
            jox_sees_body(run, i, o)) {
            *distance2 = d2;
            best = (int32_t)o;
        }
    }
    return best;
}

/* Returns the spot of a point. */
static JoxSpot make_point_spot(double x, double y) {
    return (JoxSpot){true, (float)x, (float)y, 0, 0, 0, 0, -1, -1, JOX_NO_INDEX};
}

static double find_spot_who(const JoxMachineRun *run, const JoxSpot *spot) {
    if (spot->agent != JOX_NO_INDEX)
        return 1.0 + run->agents->id[spot->agent];
    if (spot->object >= 0)
        return JOX_WHO_BODY + run->objects->rows[spot->object].id;
    return spot->place >= 0 ? JOX_WHO_PLACE + spot->place : JOX_NOBODY;
}

/* Returns who told the message that a target names, or whom a value of it means. */
static double find_message_who(const JoxMachineRun *run, const JoxTarget *target, uint32_t i) {
    const JoxName *names = jox_machine_of(run, i)->names;
    const JoxMessage *message = jox_message_find(run, i, names[target->arg].number);
    if (!message)
        return JOX_NOBODY;
    return target->field < 0 ? 1.0 + message->from
                             : jox_message_value(message, names[target->field].number, true);
}

double jox_target_named_who(const JoxMachineRun *run, const JoxTarget *target, uint32_t i) {
    switch (target->kind) {
    case JOX_TARGET_MEMORY:
        return get_remembered(run, target, i);
    case JOX_TARGET_HOLDING:
        return jox_who_is_held(run, i);
    case JOX_TARGET_STRIKER:
        return jox_who_struck(run, i);
    case JOX_TARGET_ITEM:
        return jox_list_end(run, jox_machine_of(run, i),
                            run->agents->memory + (size_t)i * run->agents->memory_stride,
                            target->arg, target->field != 0);
    case JOX_TARGET_MESSAGE:
        return find_message_who(run, target, i);
    case JOX_TARGET_OTHER:
        return jox_target_considered() ? find_spot_who(run, jox_target_considered()) : JOX_NOBODY;
    default:
        return JOX_NOBODY;
    }
}

/* Returns the spot of somebody whom a target names, if the agent sees it and the filter accepts it.
   What an agent holds it knows unseen. */
static JoxSpot find_named_spot(const JoxMachineRun *run, const JoxTarget *target, uint32_t i) {
    const JoxAgentFilter *filter = &target->filter;
    const JoxSpot spot = jox_who_spot(run, i, jox_target_named_who(run, target, i));
    const bool feels = target->kind == JOX_TARGET_HOLDING;
    if (!spot.found || spot.place >= 0)
        return spot;
    if (spot.agent != JOX_NO_INDEX)
        return !filter->flies && (feels || jox_sees_agent(run, i, spot.agent)) &&
                       jox_passes_filter(run, filter, i, spot.agent)
                   ? spot
                   : JOX_NO_SPOT;
    const JoxV2 offset = {spot.x - run->agents->x[i], spot.y - run->agents->y[i]};
    return !filter->some &&
                   (!filter->flies || jox_object_flies(&run->objects->rows[spot.object])) &&
                   jox_passes_view(run, filter, i, offset, jox_v2(spot.vx, spot.vy)) &&
                   (feels || jox_sees_body(run, i, (uint32_t)spot.object))
               ? spot
               : JOX_NO_SPOT;
}

/* Returns the nearest of those that an agent sees and that match a target. */
static JoxSpot find_nearest_spot(const JoxMachineRun *run, const JoxTarget *target, uint32_t i) {
    float object_d2 = INFINITY;
    const int32_t object = target->kind == JOX_TARGET_NEAREST && !target->filter.some
                               ? find_nearest_object(run, target, i, &object_d2)
                               : -1;
    const uint32_t other = target->filter.flies ? JOX_NO_INDEX : find_nearest_agent(run, target, i);
    if (other != JOX_NO_INDEX &&
        (object < 0 || jox_length2(jox_way_between(run->agents, i, other)) < object_d2))
        return jox_spot_agent(run, i, other);
    return object >= 0 ? jox_spot_body(&run->objects->rows[object], object) : JOX_NO_SPOT;
}

/* Returns the point where an agent last saw what it remembers. */
static JoxSpot find_last_seen(const JoxMachineRun *run, const JoxTarget *target, uint32_t i) {
    const JoxAgents *a = run->agents;
    const double *memory = a->memory + (size_t)i * a->memory_stride;
    const JoxSighting *sighting = &jox_machine_of(run, i)->sightings[target->arg];
    if (memory[sighting->who] == JOX_NOBODY || memory[sighting->who] != memory[sighting->memory])
        return JOX_NO_SPOT;
    const JoxV2 own = {a->x[i], a->y[i]}, seen = jox_v2(memory[sighting->x], memory[sighting->y]);
    const JoxV2 nearest = jox_add(own, jox_wrap(a, jox_sub(seen, own))); /* across joined edges */
    return make_point_spot(nearest.x, nearest.y);
}

JoxSpot jox_target_find(const JoxMachineRun *run, uint32_t i, int32_t index) {
    if (index < 0)
        return jox_spot_agent(run, i, i);
    JOX_ASSERT((uint32_t)index < jox_machine_of(run, i)->target_count);
    const JoxTarget *target = &jox_machine_of(run, i)->targets[index];
    if (target->kind == JOX_TARGET_OTHER && resolve_place(run, target, i) >= 0)
        return *jox_target_considered();
    if (jox_target_kind_chooses(target->kind))
        return target->score ? jox_find_best(run, i, target) : find_nearest_spot(run, target, i);
    if (jox_target_kind_moves(target->kind))
        return find_named_spot(run, target, i);
    if (target->kind == JOX_TARGET_LAST_SEEN)
        return find_last_seen(run, target, i);
    if (target->kind == JOX_TARGET_HOME)
        return make_point_spot(jox_home_position(run, i)[0], jox_home_position(run, i)[1]);
    return jox_spot_place(run, i, jox_target_place(run, i, index));
}

static bool has_filter(const JoxAgentFilter *filter) {
    return filter->some || filter->flies || filter->comes > 0.0f || filter->within > 0.0f ||
           filter->ahead > 0.0f;
}

double jox_target_draw_who(const JoxMachineRun *run, uint32_t i, int32_t index, uint32_t number) {
    const JoxTarget *target = index < 0 ? NULL : &jox_machine_of(run, i)->targets[index];
    const int32_t drawn = target ? jox_target_draw_place(run, i, target, number) : -1;
    return drawn >= 0 ? JOX_WHO_PLACE + drawn : jox_target_who(run, i, index);
}

double jox_target_who(const JoxMachineRun *run, uint32_t i, int32_t index) {
    const JoxTarget *target = index < 0 ? NULL : &jox_machine_of(run, i)->targets[index];
    if (target && jox_target_kind_moves(target->kind) && !jox_target_kind_chooses(target->kind) &&
        !has_filter(&target->filter)) {
        const double who = jox_target_named_who(run, target, i);
        return jox_who_exists(run, who) ? who : JOX_NOBODY;
    }
    const JoxSpot spot = jox_target_find(run, i, index);
    return spot.found ? find_spot_who(run, &spot) : JOX_NOBODY;
}

bool jox_target_exists(const JoxMachineRun *run, uint32_t i, int32_t index) {
    const JoxTarget *target = index < 0 ? NULL : &jox_machine_of(run, i)->targets[index];
    return target && (target->kind == JOX_TARGET_HOME || target->kind == JOX_TARGET_LAST_SEEN)
               ? jox_target_find(run, i, index).found
               : jox_target_who(run, i, index) != JOX_NOBODY;
}

/* Updates where an agent last saw whom it remembers. */
static void note_sighting(const JoxMachineRun *run, const JoxSighting *sighting, uint32_t i) {
    const JoxAgents *a = run->agents;
    double *memory = a->memory + (size_t)i * a->memory_stride;
    const double who = memory[sighting->memory];
    if (who == JOX_NOBODY)
        return;
    const JoxSpot spot = jox_who_spot(run, i, who);
    if (!spot.found || (spot.agent != JOX_NO_INDEX && !jox_sees_agent(run, i, spot.agent)) ||
        (spot.object >= 0 && !jox_sees_body(run, i, (uint32_t)spot.object)))
        return;
    memory[sighting->who] = who;
    memory[sighting->x] = spot.x;
    memory[sighting->y] = spot.y;
}

void jox_sightings_note_agent(const JoxMachineRun *run, uint32_t i) {
    const JoxMachine *machine = jox_machine_of(run, i);
    for (uint32_t k = 0; k < machine->sighting_count; k++)
        note_sighting(run, &machine->sightings[k], i);
}

void jox_sightings_note(JoxMachineRun *run) {
    const JoxMachineScratch *s = run->scratch;
    for (uint32_t b = 0; b < s->batch_count; b++) {
        const JoxBatchRange *batch = &s->batches[b];
        const JoxMachine *machine = run->set->items[batch->machine];
        for (uint32_t n = 0; machine->sighting_count && n < batch->count; n++)
            jox_sightings_note_agent(run, s->grouped[batch->begin + n]);
    }
}

bool jox_target_means(const JoxMachineRun *run, uint32_t i, int32_t index, int32_t row) {
    if (index < 0 || row < 0 || !run->objects || (uint32_t)row >= run->objects->count)
        return false;
    const JoxTarget *target = &jox_machine_of(run, i)->targets[index];
    const JoxObject *object = &run->objects->rows[row];
    if (target->kind == JOX_TARGET_NEAREST)
        return object->live && (object->tags >> target->arg & 1) != 0;
    return object->live && jox_target_kind_moves(target->kind) &&
           jox_target_named_who(run, target, i) == JOX_WHO_BODY + object->id;
}

float jox_distance_to_place(const JoxMachineRun *run, uint32_t place, JoxV2 p) {
    const JoxStoreys *s = run->agents->storeys;
    const JoxV2 nearest = s ? jox_place_nearest(run->places, place, p) : p;
    if (!s || jox_sheet_of(s, nearest.y) == jox_sheet_of(s, p.y))
        return jox_place_distance(run->places, place, p);
    const JoxV2 above = jox_on_sheet(s, jox_sheet_of(s, nearest.y), jox_in_plan(s, p));
    return jox_distance_between(s, p, jox_place_nearest(run->places, place, above));
}

float jox_target_distance(const JoxMachineRun *run, uint32_t i, int32_t index) {
    const JoxV2 p = {run->agents->x[i], run->agents->y[i]};
    const int32_t place = jox_target_place(run, i, index);
    if (place >= 0)
        return jox_distance_to_place(run, (uint32_t)place, p);
    const JoxSpot spot = jox_target_find(run, i, index);
    return spot.found ? jox_distance_between(run->agents->storeys, p, jox_v2(spot.x, spot.y))
                      : INFINITY;
}

/* Returns one measured quantity of an agent. */
static double measure_agent(const JoxMachineRun *run, uint32_t i, JoxNow what) {
    const JoxAgents *a = run->agents;
    switch (what) {
#define X(name, word, unit, meaning, value)                                                        \
    case JOX_NOW_##name:                                                                           \
        return (value);
        JOX_MEASURED(X)
#undef X
    case JOX_NOW_COUNT:
        break;
    }
    return 0.0;
}

double jox_target_measure(const JoxMachineRun *run, uint32_t i, int32_t index, JoxNow what) {
    const JoxSpot spot = jox_target_find(run, i, index);
    if (!spot.found)
        return 0.0;
    if (what == JOX_NOW_x || what == JOX_NOW_y) /* across a joined edge if that is nearer */
        return what == JOX_NOW_x ? spot.x
                                 : jox_in_plan(run->agents->storeys, jox_v2(spot.x, spot.y)).y;
    if (spot.agent != JOX_NO_INDEX)
        return measure_agent(run, spot.agent, what);
    return what == JOX_NOW_speed ? jox_length((JoxV2){spot.vx, spot.vy}) : 0.0;
}

const struct JoxPlayerInput *jox_player_input(const JoxMachineRun *run, uint32_t i) {
    for (uint32_t k = 0; k < run->input_count; k++)
        if (run->inputs[k].agent_id == run->agents->id[i])
            return &run->inputs[k];
    return NULL;
}

JoxV2 jox_player_wants(const JoxMachineRun *run, uint32_t i) {
    const struct JoxPlayerInput *input = jox_player_input(run, i);
    return input ? (JoxV2){input->vx, input->vy} : (JoxV2){0.0f, 0.0f};
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
        JoxV2 d = jox_way_between(a, i, j);
        float along = jox_dot(d, ahead), aside = fabsf(jox_det(d, ahead));
        float sum = jox_at(radius, i) + jox_at(radius, j);
        if (along > 0.0f && aside < sum / 2.0f && jox_dot(jox_heading_of(run, j), ahead) >= 0.0f)
            best = jox_minf(best, jox_maxf(along - sum, 0.0f));
    }
    return best;
}
