/* The half-planes of contacts, from the velocities that forces give all agents by the end of the
   step. Along the normal, two agents in contact may move as their mean does, so that neither plans
   to move into the other. An agent that is pushed may brake with its feet; an agent that follows a
   receding one need not. */
#include <math.h>
#include <string.h>

#include "agents/torso.h"
#include "base/mem.h"
#include "force/contact/contacts.h"

/* m/s: residuals of the contact solve must not make planes contradict each other */
static const float SLACK = 1e-3f;

/* Returns how much of a speed the feet can take away by the end of the step, m/s; for a longer plan
   more, of which the step does a share. */
static inline float find_braking(const JoxStep *step, uint32_t i, float speed, JoxDecay decays[2]) {
    const bool each_step = jox_stands_pressed(step->agents, i);
    const JoxPlanning plan = jox_planning(&step->timing, each_step);
    const float damping = jox_param(step->agents, JOX_PARAM_damping, i);
    const float lost = 1.0f - jox_decay(&decays[each_step], damping, plan.interval);
    return speed * jox_minf(1.0f, lost / plan.response);
}

/* Returns the least normal speed of agent i, away from j, where both together move at `speed`, m/s.
   An agent that is pushed may brake; one that follows an agent that wants to be slower leaves room
   for that. */
static float find_least_speed(const JoxStep *step, uint32_t i, uint32_t j, JoxV2 normal,
                              float speed, JoxDecay decays[2]) {
    const JoxAgents *a = step->agents;
    if (speed > 0.0f)
        return speed - find_braking(step, i, speed, decays);
    float wanted = -jox_dot((JoxV2){a->pref_x[j], a->pref_y[j]}, normal);
    float brakes = jox_clampf(-speed - wanted, 0.0f, find_braking(step, j, -speed, decays));
    return speed + brakes;
}

/* Returns the speed at which the torsos of a pair part by turning, m/s. */
static float find_turning(const JoxContactMotion *motions, const JoxPair *p) {
    return motions[p->first].spin * p->at.levers[0] - motions[p->second].spin * p->at.levers[1];
}

/* Makes the planes of the agents that press on agent i or overlap it. Returns how many. */
static uint32_t make_people_planes(const JoxForces *f, uint32_t i, JoxContactPlane *out,
                                   JoxDecay decays[2]) {
    const JoxAgents *a = f->step.agents;
    const JoxPairs *pairs = &f->contacts->pairs;
    const float time = (float)f->step.timing.planning_time;
    uint32_t n = 0;
    for (uint32_t k = pairs->end_starts[i]; k < pairs->end_starts[i + 1]; k++) {
        const JoxPair *p = &pairs->items[pairs->ends[k].pair];
        const uint32_t j = pairs->ends[k].other;
        if (p->again || !(p->impulse > 0.0f || p->at.target >= 0.0f) || n == JOX_MOST_TOUCHED)
            continue;
        float sign = p->first == i ? 1.0f : -1.0f;
        JoxV2 normal = {sign * p->at.normal.x, sign * p->at.normal.y};
        JoxV2 mean = {0.5f * (a->forced_x[i] + a->forced_x[j]),
                      0.5f * (a->forced_y[i] + a->forced_y[j])};
        float gap = p->at.target < 0.0f ? -p->at.target * (float)f->step.timing.dt : 0.0f;
        float own = jox_dot((JoxV2){a->forced_x[i], a->forced_y[i]}, normal);
        float both = jox_minf(jox_dot(mean, normal), own);
        float least = find_least_speed(&f->step, i, j, normal, both, decays) - SLACK;
        const float apart = jox_dot(jox_offset(a, j, i), normal) - p->at.gap;
        const float turning = 0.5f * jox_maxf(0.0f, -find_turning(f->contacts->solve.motions, p));
        out[n++] = (JoxContactPlane){normal, least + turning - 0.5f * gap / time, j, apart};
    }
    return n;
}

/* Makes the planes of the bodies that press on agent i or overlap it. Returns how many. */
static uint32_t make_body_planes(const JoxForces *f, uint32_t i, JoxContactPlane *out,
                                 JoxDecay decays[2]) {
    const JoxTouches *touches = &f->contacts->touches;
    const float time = (float)f->step.timing.planning_time;
    uint32_t n = 0;
    for (uint32_t k = 0; k < jox_touch_number_of(touches, i); k++) {
        const JoxTouch *t = &touches->items[touches->first[i] + k];
        if (!(t->impulse > 0.0f || t->gap <= 0.0f))
            continue;
        JoxV2 forced = {f->step.agents->forced_x[i], f->step.agents->forced_y[i]};
        float speed = jox_minf(jox_touch_speed_after(f, t), jox_dot(forced, t->normal));
        float least = speed;
        if (speed > 0.0f &&
            f->step.objects->rows[t->object].moves) /* a fixed body does not brake */
            least -= find_braking(&f->step, i, speed, decays);
        least -= jox_maxf(t->gap, 0.0f) / time + SLACK;
        out[n++] = (JoxContactPlane){t->normal, least, t->object, 0.0f};
    }
    return n;
}

static void make_chunk_planes(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    JoxContactPlanes *planes = &f->contacts->planes;
    JoxDecay decays[2] = {f->decay, f->decay};
    for (uint32_t i = begin; i < end; i += JOX_LANES) {
        const uint32_t last = end - i < JOX_LANES ? end : i + JOX_LANES;
        if (jox_have_no_contacts(f->contacts, i, last)) {
            memset(planes->people + i, 0, last - i);
            memset(planes->bodies + i, 0, last - i);
            continue;
        }
        for (uint32_t k = i; k < last; k++) {
            JoxContactPlane *own = planes->planes + planes->starts[k];
            planes->people[k] = (uint8_t)make_people_planes(f, k, own, decays);
            planes->bodies[k] = (uint8_t)make_body_planes(f, k, own + planes->people[k], decays);
        }
    }
}

void jox_contact_planes_make(JoxForces *f) {
    const JoxTouches *touches = &f->contacts->touches;
    JoxPairs *pairs = &f->contacts->pairs;
    uint32_t n = f->step.agents->count;
    JoxContactPlanes *planes = &f->contacts->planes;
    planes->agents = 0;
    if (!f->contacts->known || f->options.literal || n == 0)
        return;
    JOX_RESERVE(planes->people, planes->people_capacity, n + JOX_LANES);
    JOX_RESERVE(planes->bodies, planes->bodies_capacity, n + JOX_LANES);
    uint32_t most = pairs->end_starts[n];
    planes->starts = pairs->end_starts;
    if (touches->count) { /* adds room for contacts with bodies */
        JOX_RESERVE(planes->own_starts, planes->starts_capacity, n);
        planes->starts = planes->own_starts;
        for (uint32_t i = 0, room = 0; i < n; i++) {
            planes->starts[i] = pairs->end_starts[i] + room;
            room += touches->number[i];
            most += touches->number[i];
        }
    }
    const size_t room = most > 8 * n ? most : 8 * n; /* a steady step never allocates */
    jox_chunk_memory_reserve(&f->found_memory, room * sizeof *planes->planes);
    planes->planes = f->found_memory.bytes;
    planes->agents = n;
    jox_parallel_for(f->step.pool, n, JOX_FORCE_GRAIN, make_chunk_planes, f);
}

const JoxContactPlanes *jox_force_contact_planes(const JoxForces *f) {
    return &f->contacts->planes;
}
