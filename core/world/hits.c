/* What people and bodies do to each other in a step: impulses of pushes, contacts and kicks on
   bodies, fast bodies that hit people, and bodies that they pick up, carry along and throw. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/pi.h"
#include "world/stages.h"
#include "world/world.h"

static const double ROUNDING = 2e-6; /* of single precision, with what follows from it */

static void check_discs(const JoxDiscList *list, uint32_t count) {
    for (uint32_t n = 0; n < count; n++) {
        JOX_ASSERT(list->agents[n] < count);
        JOX_ASSERT(n == 0 || list->discs[n - 1].id < list->discs[n].id);
        JOX_ASSERT(list->discs[n].radius > 0.0f && list->discs[n].mass > 0.0f);
    }
}

/* People as fast bodies meet them, in ascending id: where they were and how they moved. */
static uint32_t list_discs(const JoxAgents *a, JoxDiscList *list) {
    if (a->count > list->capacity) {
        list->capacity = a->count + a->count / 4 + 16;
        list->discs = jox_realloc(list->discs, list->capacity, sizeof *list->discs);
        list->agents = jox_realloc(list->agents, list->capacity, sizeof *list->agents);
    }
    jox_agents_by_id(a, list->agents);
    for (uint32_t n = 0; n < a->count; n++) {
        uint32_t i = list->agents[n];
        list->discs[n] = (JoxDisc){.id = a->id[i],
                                   .x = a->prev_x[i],
                                   .y = a->prev_y[i],
                                   .move_x = a->x[i] - a->prev_x[i],
                                   .move_y = a->y[i] - a->prev_y[i],
                                   .radius = jox_param(a, JOX_PARAM_radius, i),
                                   .mass = jox_param(a, JOX_PARAM_mass, i),
                                   .vx = a->vx[i],
                                   .vy = a->vy[i]};
    }
    JOX_CHECK(check_discs(list, a->count));
    return a->count;
}

/* Momentum that hits are rounded by as parts of, N s: of the bodies and of those who are hit. */
static double hit_momentum(const JoxBodyStage *s, const JoxBodiesReport *report) {
    double sum = 0.0;
    for (uint32_t h = 0; h < report->hit_count; h++) {
        const JoxObject *body = &s->objects->rows[report->hits[h].object];
        const JoxDisc *disc = &s->discs->discs[report->hits[h].disc];
        const JoxV3 v = body->velocity;
        const double speed = sqrt((double)(v.x * v.x + v.y * v.y + v.z * v.z));
        sum += body->inverse_mass > 0.0f ? speed / (double)body->inverse_mass : 0.0;
        sum += (double)(disc->mass * jox_length(jox_v2(disc->vx, disc->vy)));
    }
    return sum;
}

/* What fast bodies did to people: a change of velocity now, a contact force in the columns. */
static void take_hits(const JoxBodyStage *s, const JoxBodiesReport *report) {
    JoxAgents *a = s->agents;
    float dt = (float)s->substep->dt;
    for (uint32_t h = 0; h < report->hit_count; h++) {
        const JoxDiscHit *hit = &report->hits[h];
        JOX_ASSERT(hit->disc < a->count);
        uint32_t i = s->discs->agents[hit->disc];
        JOX_ASSERT(a->id[i] == s->discs->discs[hit->disc].id);
        JOX_ASSERT(hit->object < s->objects->count && isfinite(jox_length(hit->impulse)));
        float mass = jox_param(a, JOX_PARAM_mass, i);
        a->vx[i] += hit->impulse.x / mass;
        a->vy[i] += hit->impulse.y / mass;
        a->force_x[i] += hit->impulse.x / dt;
        a->force_y[i] += hit->impulse.y / dt;
        float force = jox_length(hit->impulse) / dt;
        a->compression[i] += force / ((float)JOX_TURN * jox_param(a, JOX_PARAM_radius, i));
        a->load[i] += force;
        a->contacts[i] += a->contacts[i] < 255;
        if (!a->struck[i])
            a->struck[i] = jox_reference((int32_t)hit->object);
    }
    JOX_ASSERT(!(report->hit_residual >
                 0.01 + 1e-3 * report->hit_impulse + ROUNDING * hit_momentum(s, report)));
    JoxExchange *exchange = &s->statistics->exchange;
    exchange->contacts += report->hit_count;
    exchange->impulse += report->hit_impulse;
    exchange->residual += report->hit_residual;
    s->statistics->hits += report->hit_count;
}

/* Sum of the sizes of the momenta of all that moves, N s. */
static double all_momentum(const JoxBodyStage *s) {
    double sum = 0.0;
    for (uint32_t row = 0; row < s->objects->count; row++) {
        const JoxObject *body = &s->objects->rows[row];
        const JoxV3 v = body->velocity;
        if (body->live && body->inverse_mass > 0.0f)
            sum += sqrt((double)(v.x * v.x + v.y * v.y + v.z * v.z)) / (double)body->inverse_mass;
    }
    return sum;
}

/* People's pushes and contacts, and whether contacts give bodies what they take from people. */
static void give_impulses(const JoxBodyStage *s, const JoxImpulse *impulses, uint32_t count) {
    JoxExchange *exchange = &s->statistics->exchange;
    JoxForceTotals totals = jox_force_totals(s->forces_of);
    double before[3], after[3];
    if (count == 0)
        return;
    jox_bodies_momentum(s->bodies, before);
    const uint32_t refused = jox_bodies_impulses(s->bodies, impulses, count);
    jox_bodies_momentum(s->bodies, after);
    double x = totals.touched_x + (after[0] - before[0] - totals.pushed_x);
    double y = totals.touched_y + (after[1] - before[1] - totals.pushed_y);
    /* What people take bodies give, but for what was clamped, and for what each impulse is rounded
       by as a part of what a heavy body has. */
    JOX_ASSERT(refused > 0 || !(sqrt(x * x + y * y) >
                                0.1 + 1e-3 * totals.touched + ROUNDING * count * all_momentum(s)));
    exchange->contacts += totals.touches;
    exchange->impulse += totals.touched;
    exchange->residual += sqrt(x * x + y * y);
}

/* Holds up the driven bodies that met their force limits, and counts what such bodies press with.
 */
static void hold_up_driven(const JoxBodyStage *s) {
    uint32_t count;
    const JoxDriveLoad *loads = jox_force_drive_loads(s->forces_of, &count);
    JoxDriveStatistics *told = &s->statistics->drives;
    const uint32_t inside = jox_force_totals(s->forces_of).inside;
    told->inside = inside > told->inside ? inside : told->inside;
    for (uint32_t k = 0; k < count; k++) {
        const JoxDriveLoad *load = &loads[k];
        if ((double)load->force > told->force) {
            told->force = (double)load->force;
            told->at_s = s->substep->end;
            told->body = s->objects->rows[load->row].id;
            told->people = load->people;
            told->hardest = (double)load->hardest;
        }
        if (!load->met)
            continue;
        told->held_up += jox_bodies_hold_up(s->bodies, load->row, load->share);
        if (s->overload->row == JOX_NO_BODY && jox_bodies_ends_run(s->bodies, load->row))
            *s->overload = *load;
    }
}

JoxBodiesReport jox_bodies_advance(const JoxBodyStage *s) {
    uint32_t count;
    float dt = (float)s->substep->dt;
    const JoxImpulse *impulses = jox_force_impulses(s->forces_of, &count);
    give_impulses(s, impulses, count);
    hold_up_driven(s);
    if (s->substep->first) {
        jox_mem_fill(s->agents->struck, 0, s->agents->count * sizeof *s->agents->struck);
        jox_bodies_impulses(s->bodies, s->machines->kicks, s->machines->kick_count);
    }
    bool fast = s->forces && jox_bodies_any_fast(s->bodies, dt);
    uint32_t discs = fast ? list_discs(s->agents, s->discs) : 0;
    JoxBodiesReport report = jox_bodies_step(s->bodies, dt, fast ? s->discs->discs : NULL, discs);
    take_hits(s, &report);
    return report;
}

/* ---- bodies that are carried ---- */

static const float APART = 0.02f; /* m between a carrier and what it carries */
static const float ABOUT = 0.05f; /* m: more than a body is widened by, see geom/hands.c */

/* Where agent i holds a body whose row it is: in front, clear of its disc, or as near to that as
   walls and bodies that stand fast let it. False where there is no room. */
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

/* Where a carried body is, if its carrier i can still hold it there. */
static bool keep_hold(const JoxBodyStage *s, uint32_t i, uint32_t row, JoxV3 *at) {
    JoxPose pose;
    if (!jox_bodies_pose(s->bodies, row, &pose))
        return false;
    *at = pose.centre;
    return jox_hands_hold(s->hands, jox_v2(s->agents->x[i], s->agents->y[i]), jox_v2(at->x, at->y));
}

static void carry_along(const JoxBodyStage *s) {
    const JoxAgents *a = s->agents;
    JoxV3 at;
    for (uint32_t o = 0; o < s->objects->count; o++) {
        const JoxObject *object = &s->objects->rows[o];
        if (!object->live || !object->held)
            continue;
        JOX_ASSERT(object->holder < a->next_id && object->moves);
        uint32_t i = jox_agents_find(a, object->holder);
        if (i == JOX_NO_INDEX || a->removed[i]) { /* who left lets it fall */
            jox_bodies_end_carrying(s->bodies, o, (JoxV3){0.0f, 0.0f, 0.0f});
            continue;
        }
        if (find_hold(s, i, o, jox_v2(a->face_x[i], a->face_y[i]), true, &at) ||
            keep_hold(s, i, o, &at)) {
            jox_bodies_carry(s->bodies, o, at, (JoxV3){a->vx[i], a->vy[i], 0.0f});
        } else { /* no room for it: it falls where it was */
            jox_bodies_end_carrying(s->bodies, o, (JoxV3){0.0f, 0.0f, 0.0f});
            s->statistics->dropped++;
        }
    }
}

void jox_bodies_carried(const JoxBodyStage *s) {
    const JoxAgents *a = s->agents;
    carry_along(s);
    for (uint32_t g = 0; s->substep->first && g < s->machines->grip_count; g++) {
        const JoxGrip *grip = &s->machines->grips[g];
        uint32_t i = jox_agents_find(a, grip->agent_id);
        if (i == JOX_NO_INDEX)
            continue;
        JOX_ASSERT(grip->object < s->objects->count);
        JOX_ASSERT(g == 0 || s->machines->grips[g - 1].agent_id <= grip->agent_id);
        const JoxV2 face = {a->face_x[i], a->face_y[i]};
        JoxV3 at;
        if (grip->takes) { /* not what there is no room to carry */
            if (find_hold(s, i, grip->object, face, true, &at) &&
                jox_bodies_set_carrier(s->bodies, grip->object, grip->agent_id)) {
                jox_bodies_carry(s->bodies, grip->object, at, (JoxV3){a->vx[i], a->vy[i], 0.0f});
                s->statistics->pickups++;
            }
            continue;
        }
        const JoxV2 way = jox_unit((JoxV2){grip->velocity.x, grip->velocity.y});
        if (find_hold(s, i, grip->object, way, false, &at)) /* else from where it is carried */
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
