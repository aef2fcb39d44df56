/* The stage contact, equations 6 and 7: finds the contacts, solves all of them together, and writes
   the agents' contact forces. world/step.c calls it after push. */
#include "base/assert.h"
#include "base/mem.h"
#include "force/contact/contacts.h"

#define X(name, isa) [isa] = jox_end_motions_##name,
static JoxMotionKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

/* Returns the sum of the impulses that agent i received, N s; adds the number of its contacts that
   press or touch to *contacts. */
static JoxV2 sum_received(const JoxForces *f, uint32_t i, uint32_t *contacts) {
    const JoxTouches *touches = &f->contacts->touches;
    const JoxPairs *pairs = &f->contacts->pairs;
    JoxV2 sum = {0.0f, 0.0f};
    for (uint32_t k = pairs->end_starts[i]; k < pairs->end_starts[i + 1]; k++) {
        const JoxPair *p = &pairs->items[pairs->ends[k].pair];
        const JoxV2 impulse = jox_pair_impulse(p);
        sum = p->first == i ? jox_add(sum, impulse) : jox_sub(sum, impulse);
        *contacts += !p->again && (p->impulse > 0.0f || p->at.target >= 0.0f);
    }
    for (uint32_t k = 0; k < jox_touch_number_of(touches, i); k++) {
        const JoxTouch *touch = &touches->items[touches->first[i] + k];
        sum = jox_add(sum, jox_scale(touch->normal, touch->impulse));
        *contacts += touch->impulse > 0.0f || touch->gap <= 0.0f;
    }
    return sum;
}

/* Writes the contact force and the number of contacts of agent i, and measures its load. */
static void write_contact_force(JoxForces *f, uint32_t i) {
    JoxAgents *a = f->step.agents;
    const float per_second = 1.0f / (float)f->step.timing.dt;
    uint32_t contacts = 0;
    JoxV2 sum = sum_received(f, i, &contacts);
    a->contacts[i] = (uint8_t)(contacts < UINT8_MAX ? contacts : UINT8_MAX);
    a->contact_x[i] = sum.x * per_second;
    a->contact_y[i] = sum.y * per_second;
    jox_load_measure(f, i);
}

static void write_contact_forces(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    for (uint32_t i = begin; i < end; i += JOX_LANES) {
        const uint32_t last = end - i < JOX_LANES ? end : i + JOX_LANES;
        if (jox_have_no_contacts(f->contacts, i, last) && jox_have_no_loads(f, i, last))
            continue; /* the columns are zero since the stage began */
        for (uint32_t k = i; k < last; k++)
            write_contact_force(f, k);
    }
}

/* Writes the spins that contacts give to agents [begin, end). */
static void write_spins(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    KERNELS[f->isa](f, begin, end);
}

/* Adds the forces of walls, which have a list of their own. */
static void add_wall_forces(JoxForces *f) {
    JoxWallContacts *walls = &f->contacts->walls;
    JoxAgents *a = f->step.agents;
    float per_second = 1.0f / (float)f->step.timing.dt;
    for (uint32_t k = 0; k < walls->count; k++) {
        const JoxWallContact *w = &walls->items[k];
        const JoxV2 impulse = jox_wall_impulse(w);
        a->contact_x[w->agent] += impulse.x * per_second;
        a->contact_y[w->agent] += impulse.y * per_second;
    }
}

/* Solves all contacts in physical mode, and writes the spins that they give. */
static void solve_contacts(JoxForces *f) {
    jox_contacts_solve(f);
    if (f->step.neighbours->has_torsos)
        jox_parallel_for(f->step.pool, f->step.agents->count, JOX_FORCE_GRAIN, write_spins, f);
}

void jox_force_contact(JoxForces *f) {
    JoxAgents *a = f->step.agents;
    const JoxContacts *found = f->contacts;
    jox_contacts_find(f);
    jox_contacts_lay_out(f);
    if (f->has_bodies)
        jox_touches_sort(f);
    jox_feet_list(f);
    f->contacts->known = true;
    if (f->options.literal)
        jox_literal_contacts(f);
    else if (found->pairs.count || found->walls.count || found->touches.count || found->feet.count)
        solve_contacts(f);
    jox_parallel_for(f->step.pool, a->count, JOX_FORCE_GRAIN, write_contact_forces, f);
    jox_feet_write_forces(f);
    add_wall_forces(f); /* in literal mode walls do not press */
    JOX_CHECK(jox_contacts_check(f));
    jox_contacts_keep_impulses(f);
    jox_touches_give_impulses(f);
    jox_wall_loads_measure(f);
}

void jox_contacts_free(JoxContacts *c) {
    void *owned[] = {c->walls.items,
                     c->walls.groups,
                     c->feet.items,
                     c->solve.residuals,
                     c->planes.own_starts,
                     c->planes.people,
                     c->planes.bodies,
                     c->kept[JOX_KEPT_PAIRS].items,
                     c->kept[JOX_KEPT_WALLS].items,
                     c->kept[JOX_KEPT_TOUCHES].items};
    jox_found_contacts_free(&c->found);
    jox_pairs_free(&c->pairs);
    jox_touches_free(&c->touches, &c->drives);
    jox_wall_loads_free(&c->wall_loads);
    for (size_t i = 0; i < sizeof owned / sizeof *owned; i++)
        jox_free(owned[i]);
    jox_free(c);
}
