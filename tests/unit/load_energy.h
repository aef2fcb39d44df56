/* Follows the energy and momentum of a small world, for tests that contacts add none. */
#ifndef TESTS_UNIT_LOAD_ENERGY_H
#define TESTS_UNIT_LOAD_ENERGY_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/number/random.h"
#include "world/world.h"

enum { MOST_PEOPLE = 40 };
/* Growth of energy allowed, relative to the energy at the start or 1 J; and in a step in which
   Bullet may lift a tipping body. */
static const double GROWS = 1e-4, TIPS = 1e-3;
static const double SINKS =
    1e-3; /* m, depth that Bullet lets rocking bodies sink into the ground */
static const double FILTER = 0.13; /* s, time constant by which transferred forces arrive */
static const double TURN = 6.28318530717958648;
static const double STEPS[] = {0.1, 0.05, 0.025, 0.0125}; /* s */

typedef struct Encounter {
    JoWorld *world;
    JoAgent people[MOST_PEOPLE];
    uint32_t count;
    bool coasting, rough; /* rough: Bullet may store energy and return some of it */
    bool later;           /* transferred forces arrive after the giver has slowed down */
} Encounter;

typedef struct Growth {
    bool things;      /* there are bodies */
    double energy;    /* J at the start, at least 1 */
    double step, all; /* greatest growth in a step, and above the start, relative to `energy` */
    double momentum;  /* greatest drift, relative to all momenta at the start */
} Growth;

static inline double draw_unit(uint64_t number, uint32_t what) {
    return jox_random_unit(number, what, 0, JOX_DRAW_AIM, 1);
}
static inline double draw_between(uint64_t number, uint32_t what, double low, double high) {
    return low + (high - low) * draw_unit(number, what);
}

/* ---- energy and momentum of a world ---- */

static inline double compute_body_energy(const JoxPose *p) {
    double v2 = (double)p->velocity.x * p->velocity.x + (double)p->velocity.y * p->velocity.y +
                (double)p->velocity.z * p->velocity.z;
    /* The spin in the body's own axes: turned back by the quaternion. */
    double x = p->turn[0], y = p->turn[1], z = p->turn[2], w = p->turn[3];
    double rows[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                         {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                         {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
    const double inertia[3] = {p->inertia.x, p->inertia.y, p->inertia.z};
    double spin2 = 0.0;
    for (int k = 0; k < 3; k++) {
        double own = rows[k][0] * p->spin.x + rows[k][1] * p->spin.y + rows[k][2] * p->spin.z;
        spin2 += inertia[k] * own * own;
    }
    return 0.5 * (p->mass * v2 + spin2);
}

typedef struct Figures {
    double kinetic;            /* J, of motion and spin */
    double momentum[2], sizes; /* N s; sum of the magnitudes of momenta */
    double height, weight;     /* J, potential energy of the bodies; N, sum of their weights */
} Figures;

/* Returns the figures of a world at the end of a step; `by_forces`: with the velocities that the
   step's forces and contacts gave people, before their muscles changed them. */
static inline Figures compute_figures(const JoWorld *w, bool by_forces) {
    const JoxAgents *a = &w->state.agents;
    Figures f = {0};
    for (uint32_t i = 0; i < a->count; i++) {
        double m = (double)jox_param(a, JOX_PARAM_mass, i);
        double vx = (double)(by_forces ? a->forced_x[i] : a->vx[i]);
        double vy = (double)(by_forces ? a->forced_y[i] : a->vy[i]);
        f.kinetic += 0.5 * m * (vx * vx + vy * vy);
        f.momentum[0] += m * vx;
        f.momentum[1] += m * vy;
        f.sizes += m * hypot(vx, vy);
    }
    for (uint32_t row = 0; row < jox_bodies_rows(w->state.bodies); row++) {
        JoxPose p;
        if (!jox_bodies_pose(w->state.bodies, row, &p) || !(p.mass > 0.0f))
            continue;
        f.kinetic += compute_body_energy(&p);
        f.momentum[0] += (double)p.mass * (double)p.velocity.x;
        f.momentum[1] += (double)p.mass * (double)p.velocity.y;
        f.sizes += (double)p.mass * hypot((double)p.velocity.x, (double)p.velocity.y);
        f.weight += (double)p.mass * w->model.def.gravity;
        f.height += (double)p.mass * w->model.def.gravity * (double)p.centre.z;
    }
    return f;
}

static inline void add_change(Figures *sum, const Figures *from, Figures to) {
    sum->kinetic += to.kinetic - from->kinetic;
    sum->height += to.height - from->height;
    for (int k = 0; k < 2; k++)
        sum->momentum[k] += to.momentum[k] - from->momentum[k];
}

/* Steps the world for `seconds` and returns the greatest growth of its energy. Transferred forces
   arrive as 1 - exp(-t / FILTER) and their energy as the square of that: of the energy that givers
   have lost, at most 2 exp(-t / FILTER) may still arrive. Rocking and tipping bodies exchange
   height for motion, and Bullet separates bodies that sank into each other, into walls or the
   ground; if that can happen, the energy is compared with the start only, not with the step
   before. */
static inline Growth watch_energy(Encounter *e, double seconds, bool print) {
    const Figures first = compute_figures(e->world, false);
    Figures last = first, contact = first; /* contact: the start and what contacts added */
    double so_far = first.kinetic;
    Growth g = {.things = jo_world_body_count(e->world) > 0, .energy = fmax(1.0, first.kinetic)};
    double dt = e->world->model.def.dt, on_its_way = 0.0;
    int steps = (int)(seconds / dt + 0.5);
    bool plans_rest = e->coasting && dt < 0.049;
    for (int step = 0; step < steps; step++) {
        for (uint32_t i = 0; e->coasting && i < e->count; i++) {
            JoAgentState s = jo_agent_state(e->world, e->people[i]);
            jo_agent_set_preferred(e->world, e->people[i], s.vx, s.vy);
        }
        jo_world_step(e->world, 1);
        const Figures end = compute_figures(e->world, false);
        add_change(&contact, &last, plans_rest ? compute_figures(e->world, true) : end);
        const Figures now = contact;
        double gain = now.kinetic - so_far, unpaid = gain;
        so_far = now.kinetic;
        if (e->later) {
            unpaid = fmin(gain, fmax(0.0, gain - on_its_way));
            on_its_way = (on_its_way + 2.0 * fmax(0.0, -gain)) * exp(-dt / FILTER);
        }
        double above = now.kinetic - first.kinetic + now.height - first.height;
        double drift =
            hypot(now.momentum[0] - first.momentum[0], now.momentum[1] - first.momentum[1]);
        if (!e->rough)
            g.step = fmax(g.step, unpaid / g.energy);
        g.all = fmax(g.all, (above - SINKS * first.weight) / g.energy);
        g.momentum = fmax(g.momentum, drift / fmax(1.0, first.sizes));
        if (print)
            printf("%8.4f s %10.4f J moving %+10.4f J, %+10.4f J since the start; momentum off "
                   "by %.2e\n",
                   jo_world_time(e->world), now.kinetic, gain, above,
                   drift / fmax(1.0, first.sizes));
        last = end;
    }
    if (jo_world_failure(e->world))
        fail_msg("%s", jo_world_failure(e->world));
    return g;
}

/* Adds a person who is a disc. */
static inline JoAgent add_person(Encounter *e, JoAgentDef def, double vx, double vy) {
    JoError error;
    JoAgent one = jo_world_add_agent(e->world, &def, &error);
    if (!one.generation)
        fail_msg("%s", error.text);
    uint32_t i = jox_world_find_agent(e->world, one);
    e->world->state.agents.vx[i] = (float)vx;
    e->world->state.agents.vy[i] = (float)vy;
    /* Steps back take energy from the agent's own feet. */
    jo_agent_set_parameter(e->world, one, "step_back", 0.0, NULL);
    jo_agent_set_parameter(e->world, one, "breadth", 2.0 * def.radius, NULL);
    jo_agent_set_parameter(e->world, one, "depth", 2.0 * def.radius, NULL);
    if (e->coasting) {
        jo_agent_set_parameter(e->world, one, "damping", 0.0, NULL);
        jo_agent_set_parameter(e->world, one, "absorb", 0.0, NULL);
    }
    e->people[e->count++] = one;
    return one;
}

#endif
