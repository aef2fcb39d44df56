/* Compression and load of agents: what contacts press them with; stage.c calls it once the contacts
   are solved.

   Compression is the sum of |f.n| over all contacts of an agent, with agents, walls and bodies,
   divided by the circumference of its torso, N/m. Load is the greatest, over all directions d, of
   the sum of the positive parts of f.d: the force that the agent bears from one side, N. An agent
   held between two forces of 600 N has a load of 600 N. Pushes received and given count as
   contacts; external forces, and forces passed on (equations 8 and 9), do not. */
#include <math.h>
#include <string.h>

#include "agents/torso.h"
#include "base/assert.h"
#include "force/contact/contacts.h"
#include "force/push/pushes.h"

#define X(name, isa) [isa] = jox_greatest_push_##name,
static JoxGreatestPushKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

enum { MOST_FORCES = 64 };

/* Forces that press on one agent, N, padded with zeros to whole packets. */
typedef struct Pressing {
    uint32_t count;
    float x[MOST_FORCES + JOX_LANES], y[MOST_FORCES + JOX_LANES];
} Pressing;

static inline JoxV2 get_force(const Pressing *p, uint32_t k) {
    return (JoxV2){p->x[k], p->y[k]};
}

/* Returns whether another force fits; more than MOST_FORCES are dropped. */
static inline bool has_room(const Pressing *p) {
    return p->count < MOST_FORCES;
}

/* Returns the greatest length, over half-planes, of the sum of the forces within, which equals the
   greatest sum of positive parts over directions. Only borders along a force matter; it may lie
   within or outside of the half-plane. */
static float find_greatest_push(const JoxForces *f, const Pressing *p) {
    const JoxV2 one = get_force(p, 0), other = get_force(p, 1);
    if (p->count == 0)
        return 0.0f;
    if (p->count == 1)
        return jox_length(one);
    if (p->count == 2)
        return sqrtf(jox_maxf(jox_length2(jox_add(one, other)),
                              jox_maxf(jox_length2(one), jox_length2(other))));
    return KERNELS[f->isa](p->x, p->y, p->count);
}

/* Adds a force if it counts; without a branch, which would be mispredicted. */
static inline void add_force_if(Pressing *p, JoxV2 force, bool counts) {
    p->x[p->count] = force.x;
    p->y[p->count] = force.y;
    p->count += counts;
}

/* Lists all forces that press on agent i. */
static void list_pressing(const JoxForces *f, uint32_t i, Pressing *out) {
    const JoxTransfers *pushed = &f->transfers;
    const JoxV2 reaction = f->pushes->reactions[i];
    const JoxTouches *touches = &f->contacts->touches;
    const JoxFoundContacts *found = &f->contacts->found;
    const JoxPairs *pairs = &f->contacts->pairs;
    const float per_second = 1.0f / (float)f->step.timing.dt;
    out->count = 0;
    for (uint32_t k = pairs->end_starts[i]; k < pairs->end_starts[i + 1] && has_room(out); k++) {
        const JoxPair *p = &pairs->items[pairs->ends[k].pair];
        const JoxV2 impulse = jox_pair_impulse(p);
        add_force_if(out, jox_scale(impulse, p->first == i ? per_second : -per_second),
                     p->impulse > 0.0f);
    }
    for (uint32_t k = 0; k < jox_touch_number_of(touches, i) && has_room(out); k++) {
        const JoxTouch *t = &touches->items[touches->first[i] + k];
        add_force_if(out, jox_scale(t->normal, t->impulse * per_second), t->impulse > 0.0f);
    }
    for (uint32_t k = 0; k < found->wall_count[i] && has_room(out); k++) {
        const JoxWallContact *w = &f->contacts->walls.items[found->first_wall[i] + k];
        add_force_if(out, jox_scale(jox_wall_impulse(w), per_second), w->impulse > 0.0f);
    }
    for (uint32_t k = f->pushes->any ? pushed->starts[i] : 0;
         f->pushes->any && k < pushed->starts[i + 1] && has_room(out); k++)
        add_force_if(out, jox_v2(pushed->sorted[k].x, pushed->sorted[k].y),
                     pushed->sorted[k].from_id != f->step.agents->id[i]);
    if ((reaction.x != 0.0f || reaction.y != 0.0f) && has_room(out))
        add_force_if(out, reaction, true);
    memset(out->x + out->count, 0, JOX_LANES * sizeof *out->x);
    memset(out->y + out->count, 0, JOX_LANES * sizeof *out->y);
}

bool jox_have_no_loads(const JoxForces *f, uint32_t begin, uint32_t end) {
    const JoxPushes *pushes = f->pushes;
    uint32_t loads = pushes->any ? f->transfers.starts[end] - f->transfers.starts[begin] : 0;
    float reactions = 0.0f;
    for (uint32_t i = begin; i < end; i++) {
        loads |= f->contacts->found.wall_count[i];
        reactions += fabsf(pushes->reactions[i].x) + fabsf(pushes->reactions[i].y);
    }
    return loads == 0 && reactions == 0.0f;
}

void jox_load_measure(JoxForces *f, uint32_t i) {
    JoxAgents *a = f->step.agents;
    Pressing pressing; /* only the entries in use are initialised */
    list_pressing(f, i, &pressing);
    float sum = 0.0f;
    if (pressing.count == 0) {
        a->compression[i] = a->load[i] = 0.0f;
        return;
    }
    for (uint32_t k = 0; k < pressing.count; k++)
        sum += jox_length(get_force(&pressing, k));
    a->compression[i] = sum / jox_torso_circumference(jox_agent_torso(a, i, f->options.literal));
    a->load[i] = find_greatest_push(f, &pressing);
    JOX_ASSERT(!(a->load[i] > sum * 1.001f + 1e-3f));
}
