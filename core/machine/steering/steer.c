/* Steering terms that are computed agent by agent. prefer.c calls them through jox_steer_word. */
#include <math.h>

#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "machine/kernels.h"

JoxV2 jox_steer_arrive(JoxV2 from, JoxV2 to, float speed) {
    JoxV2 way = jox_sub(to, from);
    float distance = jox_length(way);
    if (distance < 1e-4f)
        return (JoxV2){0.0f, 0.0f};
    float share = speed > 0.0f ? jox_minf(1.0f, distance / (speed * JOX_SLOWING)) : 1.0f;
    return jox_scale(way, share / distance);
}

/* Returns the point of a place that an agent aims at: on a line a random point of its own, else the
   nearest one. */
static JoxV2 find_aim(const JoxMachineRun *run, uint32_t i, const JoxSpot *spot) {
    const JoxPlace *place = &run->places[spot->place];
    if (!jox_place_is_line(place))
        return (JoxV2){spot->x, spot->y};
    double u =
        jox_random_unit(run->seed, run->agents->id[i], (uint64_t)spot->place, JOX_DRAW_AIM, 0);
    float t = 0.1f + 0.8f * (float)u;
    return jox_add(place->points[0], jox_scale(jox_sub(place->points[1], place->points[0]), t));
}

JoxV2 jox_steer_seek(const JoxMachineRun *run, uint32_t i, int32_t target) {
    const JoxAgents *a = run->agents;
    JoxV2 from = {a->x[i], a->y[i]};
    const int32_t index = jox_target_place(run, i, target);
    if (index >= 0 && jox_place_is_spot(&run->places[index]))
        return jox_steer_arrive(from, run->places[index].centre, jox_param(a, JOX_PARAM_speed, i));
    JoxSpot spot = jox_target_find(run, i, target);
    if (!spot.found)
        return (JoxV2){0.0f, 0.0f};
    if (spot.place < 0 && spot.agent == JOX_NO_INDEX && spot.object < 0) /* the agent's own post */
        return jox_steer_arrive(from, (JoxV2){spot.x, spot.y}, jox_param(a, JOX_PARAM_speed, i));
    if (spot.place < 0) /* moving targets are run at without slowing down */
        return jox_unit(jox_sub((JoxV2){spot.x, spot.y}, from));
    const JoxPlace *place = &run->places[spot.place];
    JoxV2 to = find_aim(run, i, &spot);
    if (jox_place_is_line(place)) /* lines are crossed, not stopped at */
        return jox_unit(jox_sub(to, from));
    if (jox_place_is_arrival(run->places, (uint32_t)spot.place, run->walls, from))
        return (JoxV2){0.0f, 0.0f};
    return jox_place_is_area(place) ? jox_unit(jox_sub(to, from))
                                    : jox_steer_arrive(from, to, jox_param(a, JOX_PARAM_speed, i));
}

/* Finds the point of a queue that an agent heads for: the spot `behind` m behind its head, or, if a
   wall hides that, the first point farther back that it sees. Returns whether it is the spot. */
static bool find_queue_point(const JoxMachineRun *run, JoxV2 at, const JoxPlace *queue,
                             float behind, JoxV2 *to) {
    JoxHidingEdge last = {0};
    JoxV2 from = queue->points[0], along = {0.0f, 0.0f}; /* of a part, from its point `k` - 1 */
    float length = 0.0f, on = behind, begin = 0.0f, end = 0.0f; /* m behind the head */
    for (uint32_t k = 0; k + 1 < queue->count; k++)
        length += jox_length(jox_sub(queue->points[k + 1], queue->points[k]));
    *to = jox_place_queue_point(queue, on);
    for (uint32_t k = 0; on < length && jox_is_reach_hidden(run, at, *to, &last);) {
        on = jox_minf(on + queue->spacing, length);
        for (; k + 1 < queue->count && (k == 0 || on > end); k++) {
            from = queue->points[k];
            along = jox_unit(jox_sub(queue->points[k + 1], from));
            begin = end;
            end += jox_length(jox_sub(queue->points[k + 1], from));
        }
        *to = jox_add(from, jox_scale(along, on - begin));
    }
    return on == behind;
}

/* Returns the way to the agent's place in the queue; before it has a rank, towards the queue. */
static JoxV2 steer_queue(const JoxMachineRun *run, uint32_t i, const JoxSteerTerm *term) {
    const JoxAgents *a = run->agents;
    int32_t index = jox_target_place(run, i, term->target);
    uint32_t rank = run->scratch->rank[i];
    if (index < 0 || rank == UINT32_MAX || !jox_place_is_queue(&run->places[index]))
        return jox_steer_seek(run, i, term->target);
    const JoxPlace *place = &run->places[index];
    const JoxV2 at = {a->x[i], a->y[i]};
    JoxV2 to;
    return find_queue_point(run, at, place, (float)rank * place->spacing, &to)
               ? jox_steer_arrive(at, to, jox_param(a, JOX_PARAM_speed, i))
               : jox_unit(jox_sub(to, at));
}

/* Returns the direction away from the neighbours' centroid. */
static JoxV2 steer_spread(const JoxMachineRun *run, uint32_t i) {
    const JoxAgents *a = run->agents;
    JoxV2 sum = {0.0f, 0.0f};
    uint32_t count = run->neighbours->count[i];
    for (uint32_t k = 0; k < count; k++) {
        uint32_t j = run->neighbours->index[jox_neighbour_at(run->neighbours, i, k)];
        sum = jox_add(sum, jox_offset(a, j, i));
    }
    return jox_unit(sum);
}

/* People who meet pass on the right by custom (measured by Moussaid et al. 2009), and give way to
   agents on their right. Nearer agents count more. The headings are those of the last step, so that
   the order of agents does not matter. */
JoxV2 jox_steer_evade(const JoxMachineRun *run, uint32_t i, JoxV2 ahead) {
    const JoxAgents *a = run->agents;
    const JoxNeighbours *n = run->neighbours;
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    JoxV2 right = jox_scale(jox_left(ahead), -1.0f);
    float sum = 0.0f, reach = jox_param(a, JOX_PARAM_perception, i);
    for (uint32_t k = 0; k < n->count[i]; k++) {
        uint32_t j = n->index[jox_neighbour_at(n, i, k)];
        JoxV2 d = jox_offset(a, i, j);
        float along = jox_dot(d, ahead), aside = jox_dot(d, right),
              wide = jox_at(radius, i) + jox_at(radius, j);
        if (along <= 0.0f || jox_dot(jox_heading_of(run, j), ahead) >= 0.0f ||
            fabsf(aside) > 2.0f * wide)
            continue;
        float nearness = jox_maxf(0.0f, 1.0f - along / reach);
        sum += aside > 0.5f * wide ? -nearness : nearness;
    }
    return jox_scale(right, jox_clampf(sum, -1.0f, 1.0f));
}

/* Returns the way towards the centroid of visible teammates, once it is farther than args[0] m. */
static JoxV2 steer_together(const JoxMachineRun *run, uint32_t i, const JoxSteerTerm *term) {
    const JoxAgents *a = run->agents;
    const JoxNeighbours *n = run->neighbours;
    JoxV2 sum = {0.0f, 0.0f};
    uint32_t mates = 0;
    for (uint32_t k = 0; a->team[i] && k < n->count[i]; k++) {
        uint32_t j = n->index[jox_neighbour_at(n, i, k)];
        if (a->team[j] != a->team[i])
            continue;
        sum = jox_add(sum, jox_offset(a, i, j));
        mates++;
    }
    JoxV2 to = jox_scale(sum, mates ? 1.0f / (float)mates : 0.0f);
    float distance = jox_length(to), ease = (float)term->args[0];
    if (distance == 0.0f || distance <= ease)
        return (JoxV2){0.0f, 0.0f};
    return jox_scale(to, jox_minf(1.0f, distance - ease) / distance);
}

/* Returns the direction out of the line on which the target comes nearer, until that is args[0] m
   away: to the side of the line on which the agent is (right of the target's motion if it is on
   the line), or to the other one if only there no wall is in the way. */
static JoxV2 steer_dodge(const JoxMachineRun *run, uint32_t i, const JoxSteerTerm *term) {
    const JoxAgents *a = run->agents;
    const JoxSpot spot = jox_target_find(run, i, term->target);
    const JoxV2 at = {a->x[i], a->y[i]}, from = jox_sub(at, (JoxV2){spot.x, spot.y});
    const JoxV2 motion = {spot.vx, spot.vy}, left = jox_left(jox_unit(motion));
    const float aside = jox_dot(from, left), side = aside > 0.0f ? 1.0f : -1.0f;
    const float clear = (float)term->args[0];
    if (!spot.found || !(jox_dot(from, motion) > 0.0f) || fabsf(aside) >= clear)
        return (JoxV2){0.0f, 0.0f};
    const JoxV2 near = jox_scale(left, side), far = jox_scale(left, -side);
    JoxV2 normal;
    const bool turns =
        jox_meets_wall(run, at, jox_add(at, jox_scale(near, clear - fabsf(aside))), &normal) &&
        !jox_meets_wall(run, at, jox_add(at, jox_scale(far, clear + fabsf(aside))), &normal);
    return turns ? far : near;
}

/* Returns the way to a point args[0] m from the target, on the agent's side. */
static JoxV2 steer_follow(const JoxMachineRun *run, uint32_t i, const JoxSteerTerm *term) {
    const JoxAgents *a = run->agents;
    JoxSpot spot = jox_target_find(run, i, term->target);
    JoxV2 from = {a->x[i], a->y[i]}, to = {spot.x, spot.y};
    if (!spot.found)
        return (JoxV2){0.0f, 0.0f};
    JoxV2 behind = jox_scale(jox_unit(jox_sub(from, to)), (float)term->args[0]);
    return jox_steer_arrive(from, jox_add(to, behind), jox_param(a, JOX_PARAM_speed, i));
}

static const double TURNING = 8.0; /* s: time in which the direction of wandering may turn by two
                                      full turns */
static const float FEELS = 1.0f;   /* m: gap to a wall or the place's edge at which a wandering
                                      agent turns back */

/* Returns the direction of wandering, by value noise: the angle is interpolated smoothly between
   random values every TURNING seconds, with a phase of the agent's own. */
static JoxV2 find_wander_direction(const JoxMachineRun *run, uint32_t i) {
    const uint32_t id = run->agents->id[i];
    const double own = jox_random_unit(run->seed, id, 0, JOX_DRAW_WANDER, 1);
    const double time = run->tick * run->dt / TURNING + own, knot = floor(time);
    double angle[2];
    for (uint32_t k = 0; k < 2; k++)
        angle[k] =
            2.0 * JOX_TURN * jox_random_unit(run->seed, id, (uint64_t)knot + k, JOX_DRAW_WANDER, 0);
    const double t = time - knot, smooth = t * t * (3.0 - 2.0 * t);
    const double at = JOX_TURN * own + angle[0] + (angle[1] - angle[0]) * smooth;
    return (JoxV2){(float)jox_cos(at), (float)jox_sin(at)};
}

JoxV2 jox_steer_wander(const JoxMachineRun *run, uint32_t i, int32_t target) {
    const JoxAgents *a = run->agents;
    const JoxV2 at = {a->x[i], a->y[i]};
    const int32_t place = jox_target_place(run, i, target);
    JoxV2 way = find_wander_direction(run, i), normal;
    const float reach = FEELS + jox_param(a, JOX_PARAM_radius, i);
    const JoxV2 next = jox_add(at, jox_scale(way, reach));
    if (place >= 0 && !jox_place_contains(run->places, (uint32_t)place, next)) {
        const JoxV2 in = jox_place_contains(run->places, (uint32_t)place, at)
                             ? run->places[place].centre
                             : jox_place_nearest(run->places, (uint32_t)place, at);
        way = jox_unit(jox_add(jox_scale(jox_unit(jox_sub(in, at)), 1.5f), way));
    }
    if (jox_meets_wall(run, at, jox_add(at, jox_scale(way, reach)), &normal)) {
        const float into = jox_dot(way, normal);
        way = jox_sub(way, jox_scale(normal, 2.0f * into)); /* reflected as a ball is */
    }
    return way;
}

static JoxV2 steer_player(const JoxMachineRun *run, uint32_t i) {
    float speed = jox_maxf(jox_param(run->agents, JOX_PARAM_speed, i), 1e-3f);
    return jox_scale(jox_player_wants(run, i), 1.0f / speed);
}

JoxV2 jox_steer_word(const JoxMachineRun *run, uint32_t i, const JoxSteerTerm *term) {
    const JoxAgents *a = run->agents;
    switch (term->kind) {
    case JOX_STEER_AWAY_FROM: {
        JoxSpot spot = jox_target_find(run, i, term->target);
        return spot.found ? jox_unit((JoxV2){a->x[i] - spot.x, a->y[i] - spot.y})
                          : (JoxV2){0.0f, 0.0f};
    }
    case JOX_STEER_DODGE:
        return steer_dodge(run, i, term);
    case JOX_STEER_QUEUE:
        return steer_queue(run, i, term);
    case JOX_STEER_FOLLOW:
        return steer_follow(run, i, term);
    case JOX_STEER_WANDER:
        return jox_steer_wander(run, i, term->target);
    case JOX_STEER_FORMATION:
    case JOX_STEER_GATHER:
        return jox_steer_arrive((JoxV2){a->x[i], a->y[i]}, run->scratch->row[i],
                                jox_param(a, JOX_PARAM_speed, i));
    case JOX_STEER_SPREAD:
        return steer_spread(run, i);
    case JOX_STEER_TOGETHER:
        return steer_together(run, i, term);
    case JOX_STEER_PLAYER:
        return steer_player(run, i);
    case JOX_STEER_HOLD:
    case JOX_STEER_ORBIT: /* by a kernel */
    case JOX_STEER_SEEK:  /* by batch: steer_place.c */
    case JOX_STEER_ALONG:
    case JOX_STEER_DRIFT: /* by batch: prefer.c */
    case JOX_STEER_FIELD: /* by batch: steer_field.c */
    case JOX_STEER_RIDE:  /* by batch: ride.c */
    case JOX_STEER_EVADE: /* from the sum of the others: prefer.c */
    case JOX_STEER_FUNCTION:
        break;
    }
    return (JoxV2){0.0f, 0.0f};
}
