/* Bodies that agents pick up, carry along and throw. */
#include "base/assert.h"
#include "world/world.h"

static const float APART = 0.02f; /* m: gap between a carrier and its body */
static const float ABOUT =
    0.05f; /* m: more than geom/hand_reach.c enlarges the outline of a body by */

/* Finds where agent i can hold the body in a row: in front, clear of its disc, or as near to that
   as walls and fixed bodies allow. Returns false if there is no room. */
static bool find_hold(const JoxBodyStage *s, uint32_t i, uint32_t row, JoxV2 way, bool around,
                      JoxV3 *at) {
    const JoxAgents *a = s->agents;
    const JoxObject *object = &s->objects->rows[row];
    const JoxV2 from = {a->x[i], a->y[i]};
    const float gap = jox_param(a, JOX_PARAM_radius, i) + object->disc + APART;
    JoxV2 found;
    jox_hands_look(s->hands, s->machines->walls, s->machines->wall_images, s->objects, row, from,
                   gap + object->disc + ABOUT);
    if (!jox_hands_find(s->hands, from, way, gap, around, &found))
        return false;
    *at = (JoxV3){found.x, found.y, jox_maxf(JOX_HAND_HEIGHT, object->below)};
    return true;
}

/* Returns whether carrier i can still hold a body where it is, and writes where. */
static bool keep_hold(const JoxBodyStage *s, uint32_t i, uint32_t row, JoxV3 *at) {
    JoxPose pose;
    if (!jox_bodies_pose(s->bodies, row, &pose))
        return false;
    *at = pose.centre;
    return jox_hands_can_hold(s->hands, jox_v2(s->agents->x[i], s->agents->y[i]),
                              jox_v2(at->x, at->y));
}

static void move_carried(const JoxBodyStage *s) {
    const JoxAgents *a = s->agents;
    JoxV3 at;
    for (uint32_t o = 0; o < s->objects->count; o++) {
        const JoxObject *object = &s->objects->rows[o];
        if (!object->live || !object->held)
            continue;
        JOX_ASSERT(object->holder < a->next_id && object->moves);
        uint32_t i = jox_agents_find(a, object->holder);
        if (i == JOX_NO_INDEX || a->removed[i]) { /* the carrier left: it falls */
            jox_bodies_end_carrying(s->bodies, o, (JoxV3){0.0f, 0.0f, 0.0f});
            continue;
        }
        if (find_hold(s, i, o, jox_v2(a->face_x[i], a->face_y[i]), true, &at) ||
            keep_hold(s, i, o, &at)) {
            jox_bodies_carry(s->bodies, o, at, (JoxV3){a->vx[i], a->vy[i], 0.0f});
        } else { /* no room to carry it: it falls where it was */
            jox_bodies_end_carrying(s->bodies, o, (JoxV3){0.0f, 0.0f, 0.0f});
            s->statistics->dropped++;
        }
    }
}

void jox_stage_carry_bodies(const JoxBodyStage *s) {
    const JoxAgents *a = s->agents;
    move_carried(s);
    for (uint32_t g = 0; s->substep->first && g < s->machines->grip_count; g++) {
        const JoxGrip *grip = &s->machines->grips[g];
        uint32_t i = jox_agents_find(a, grip->agent_id);
        if (i == JOX_NO_INDEX)
            continue;
        JOX_ASSERT(grip->object < s->objects->count);
        JOX_ASSERT(g == 0 || s->machines->grips[g - 1].agent_id <= grip->agent_id);
        const JoxV2 face = {a->face_x[i], a->face_y[i]};
        JoxV3 at;
        if (grip->takes) { /* only if there is room to carry it */
            if (find_hold(s, i, grip->object, face, true, &at) &&
                jox_bodies_set_carrier(s->bodies, grip->object, grip->agent_id)) {
                jox_bodies_carry(s->bodies, grip->object, at, (JoxV3){a->vx[i], a->vy[i], 0.0f});
                s->statistics->pickups++;
            }
            continue;
        }
        const JoxV2 way = jox_unit((JoxV2){grip->velocity.x, grip->velocity.y});
        if (find_hold(s, i, grip->object, way, false,
                      &at)) /* else thrown from where it is carried */
            jox_bodies_carry(s->bodies, grip->object, at, grip->velocity);
        jox_bodies_end_carrying(s->bodies, grip->object, grip->velocity);
        s->statistics->throws++;
    }
}

bool jox_world_throw(JoWorld *w, uint32_t row, const double from[3], const double velocity[3],
                     const double spin[3]) {
    JoxPose pose;
    if (!jox_bodies_pose(w->state.bodies, row, &pose) ||
        !jox_bodies_set_carrier(w->state.bodies, row, 0))
        return false;
    JoxV3 v = {(float)velocity[0], (float)velocity[1], (float)velocity[2]};
    JoxV3 turn = {(float)spin[0], (float)spin[1], (float)spin[2]}, at = pose.centre;
    if (from)
        at = (JoxV3){(float)from[0] + pose.centre.x - pose.position.x,
                     (float)from[1] + pose.centre.y - pose.position.y,
                     (float)from[2] + pose.centre.z - pose.position.z};
    jox_bodies_carry(w->state.bodies, row, at, v);
    jox_bodies_end_carrying(w->state.bodies, row, v);
    jox_bodies_set_velocity(w->state.bodies, row, v, turn);
    w->state.statistics.throws++;
    return true;
}
