/* Exchange of momentum between agents and bodies in a step: impulses of pushes, contacts and kicks
   on bodies, hits of fast bodies on agents, and force limits of driven bodies. The stage bodies
   calls jox_stage_step_bodies. */
#include <math.h>

#include "agents/torso.h"
#include "base/assert.h"
#include "base/mem.h"
#include "world/stages.h"
#include "world/world.h"

static const double ROUNDING = 2e-6; /* relative error of momenta in single precision */

static void check_discs(const JoxDiscList *list, uint32_t count) {
    for (uint32_t n = 0; n < count; n++) {
        JOX_ASSERT(list->agents[n] < count);
        JOX_ASSERT(n == 0 || list->discs[n - 1].id < list->discs[n].id);
        JOX_ASSERT(list->discs[n].radius > 0.0f && list->discs[n].mass > 0.0f);
    }
}

/* Lists agents as discs that fast bodies may hit, in ascending id; returns how many. */
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
                                   .parting = a->parting[i],
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

/* Returns the momentum, N s, of bodies and agents in hits, to which rounding errors are relative.
 */
static double sum_hit_momentum(const JoxBodyStage *s, const JoxBodiesReport *report) {
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

/* Applies hits of fast bodies to agents: changes their velocity, and adds a contact force to their
   columns. */
static void apply_hits(const JoxBodyStage *s, const JoxBodiesReport *report) {
    JoxAgents *a = s->agents;
    float dt = (float)s->substep->step.timing.dt;
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
        const JoxTorso torso = {a->contact_radius[i], jox_torso_half(a, i)};
        a->compression[i] += force / jox_torso_circumference(torso);
        a->load[i] += force;
        a->contacts[i] += a->contacts[i] < 255;
        if (!a->struck[i])
            a->struck[i] = jox_reference((int32_t)hit->object);
    }
    JOX_ASSERT(!(report->hit_residual >
                 0.01 + 1e-3 * report->hit_impulse + ROUNDING * sum_hit_momentum(s, report)));
    JoxExchange *exchange = &s->statistics->exchange;
    exchange->contacts += report->hit_count;
    exchange->impulse += report->hit_impulse;
    exchange->residual += report->hit_residual;
    exchange->body_change += report->hit_body_change;
    exchange->person_change += report->hit_person_change;
    s->statistics->hits += report->hit_count;
}

/* Returns the sum of the magnitudes of momentum of all moving bodies, N s. */
static double sum_momentum(const JoxBodyStage *s) {
    double sum = 0.0;
    for (uint32_t row = 0; row < s->objects->count; row++) {
        const JoxObject *body = &s->objects->rows[row];
        const JoxV3 v = body->velocity;
        if (body->live && body->inverse_mass > 0.0f)
            sum += sqrt((double)(v.x * v.x + v.y * v.y + v.z * v.z)) / (double)body->inverse_mass;
    }
    return sum;
}

/* Applies impulses of agents' pushes and contacts to bodies, and checks that contacts give bodies
   the momentum that they take from agents. */
static void apply_impulses(const JoxBodyStage *s, const JoxImpulse *impulses, uint32_t count) {
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
    /* Both are equal except for clamped impulses and for rounding, which is relative to the
       momentum of heavy bodies. */
    JOX_ASSERT(refused > 0 || !(sqrt(x * x + y * y) >
                                0.1 + 1e-3 * totals.touched + ROUNDING * count * sum_momentum(s)));
    exchange->contacts += totals.touches;
    exchange->impulse += totals.touched;
    exchange->residual += sqrt(x * x + y * y);
}

/* Holds up driven bodies that met their force limits, and notes the greatest force of one. */
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

JoxBodiesReport jox_stage_step_bodies(const JoxBodyStage *s) {
    uint32_t count;
    float dt = (float)s->substep->step.timing.dt;
    const JoxImpulse *impulses = jox_force_impulses(s->forces_of, &count);
    apply_impulses(s, impulses, count);
    hold_up_driven(s);
    if (s->substep->first) {
        jox_mem_fill(s->agents->struck, 0, s->agents->count * sizeof *s->agents->struck);
        jox_bodies_impulses(s->bodies, s->machines->kicks, s->machines->kick_count);
    }
    bool fast = s->forces && jox_bodies_any_fast(s->bodies, dt);
    uint32_t discs = fast ? list_discs(s->agents, s->discs) : 0;
    JoxBodiesReport report = jox_bodies_step(s->bodies, dt, fast ? s->discs->discs : NULL, discs);
    apply_hits(s, &report);
    return report;
}
