/* Bodies that agents carry: picked up, carried along, thrown. */
#include <math.h>

#include "base/assert.h"
#include "world/stages.h"
#include "world/world.h"

static const float CARRY_HEIGHT = 1.2f; /* m: of the hand */

/* In front of the agent, clear of its disc. */
static JoxV3 before(const JoxAgents *a, uint32_t i, const JoxObject *object, JoxV2 way) {
    float gap = a->param[JOX_PARAM_radius][i] + object->disc + 0.02f;
    return (JoxV3){a->x[i] + way.x * gap, a->y[i] + way.y * gap, CARRY_HEIGHT};
}

static void carry_along(const JoxBodyStage *s) {
    const JoxAgents *a = s->agents;
    for (uint32_t o = 0; o < s->objects->count; o++) {
        const JoxObject *object = &s->objects->rows[o];
        if (!object->live || !object->held)
            continue;
        JOX_ASSERT(object->holder < a->next_id && object->moves);
        uint32_t i = jox_agents_find(a, object->holder);
        if (i == JOX_NO_INDEX || a->removed[i]) { /* who left lets it fall */
            jox_bodies_let_go(s->bodies, o, (JoxV3){0.0f, 0.0f, 0.0f});
            continue;
        }
        JoxV2 face = {a->face_x[i], a->face_y[i]};
        jox_bodies_carry(s->bodies, o, before(a, i, object, face),
                         (JoxV3){a->vx[i], a->vy[i], 0.0f});
    }
}

void jox_bodies_carried(const JoxBodyStage *s) {
    const JoxAgents *a = s->agents;
    carry_along(s);
    for (uint32_t g = 0; g < s->machines->grip_count; g++) {
        const JoxGrip *grip = &s->machines->grips[g];
        uint32_t i = jox_agents_find(a, grip->agent_id);
        if (i == JOX_NO_INDEX)
            continue;
        JOX_ASSERT(grip->object < s->objects->count);
        JOX_ASSERT(g == 0 || s->machines->grips[g - 1].agent_id <= grip->agent_id);
        const JoxObject *object = &s->objects->rows[grip->object];
        if (grip->takes) {
            s->statistics->pickups += jox_bodies_hold(s->bodies, grip->object, grip->agent_id);
            continue;
        }
        JoxV2 way = jox_unit((JoxV2){grip->velocity.x, grip->velocity.y});
        jox_bodies_carry(s->bodies, grip->object, before(a, i, object, way), grip->velocity);
        jox_bodies_let_go(s->bodies, grip->object, grip->velocity);
        s->statistics->throws++;
    }
}

bool jox_world_throw(JoWorld *w, uint32_t row, const double from[3], const double velocity[3],
                     const double spin[3]) {
    JoxPose pose;
    if (!jox_bodies_pose(w->state.bodies, row, &pose) || !jox_bodies_hold(w->state.bodies, row, 0))
        return false;
    JoxV3 v = {(float)velocity[0], (float)velocity[1], (float)velocity[2]};
    JoxV3 turn = {(float)spin[0], (float)spin[1], (float)spin[2]}, at = pose.centre;
    if (from)
        at = (JoxV3){(float)from[0] + pose.centre.x - pose.position.x,
                     (float)from[1] + pose.centre.y - pose.position.y,
                     (float)from[2] + pose.centre.z - pose.position.z};
    jox_bodies_carry(w->state.bodies, row, at, v);
    jox_bodies_let_go(w->state.bodies, row, v);
    jox_bodies_set_velocity(w->state.bodies, row, v, turn);
    w->state.statistics.throws++;
    return true;
}
