/* A crowd whose neighbours are found by brute force, for the tests of forces. */
#ifndef TESTS_UNIT_FORCE_CROWD_H
#define TESTS_UNIT_FORCE_CROWD_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "agents/agents.h"
#include "agents/neighbours.h"
#include "agents/torso.h"
#include "base/mem.h"
#include "base/number/random.h"
#include "force/equations.h"
#include "force/force.h"
#include "unit/assert_near.h"

typedef struct Crowd {
    JoxAgents agents;
    JoxNeighbours near;
    JoxForces *forces;
    JoxStep step;
    JoxForceInputs in;
} Crowd;

/* Adds an agent, a disc of 0.2 m. */
static inline uint32_t add_agent(Crowd *c, float x, float y, float vx, float vy) {
    JoxAgents *a = &c->agents;
    uint32_t i = jox_agents_add(a);
    jox_param_set(a, JOX_PARAM_breadth, i, 2.0f * jox_param(a, JOX_PARAM_radius, i));
    jox_param_set(a, JOX_PARAM_depth, i, 2.0f * jox_param(a, JOX_PARAM_radius, i));
    a->x[i] = x;
    a->y[i] = y;
    a->vx[i] = vx;
    a->vy[i] = vy;
    return i;
}

/* Finds the k nearest within perception, nearest first, ties by id. */
static inline void find_crowd_neighbours(Crowd *c) {
    JoxAgents *a = &c->agents;
    JoxNeighbours *n = &c->near;
    float distance2[JOX_MOST_NEIGHBOURS];
    uint32_t room = (a->count + JOX_LANES - 1) / JOX_LANES * JOX_LANES;
    if (room > n->agents) {
        n->agents = room;
        n->stride = JOX_MOST_NEIGHBOURS;
        jox_free(n->index); /* entries beyond a count must be indices too: zeros */
        n->index = jox_alloc((size_t)room * n->stride, sizeof *n->index);
        n->count = jox_realloc(n->count, room, 1);
        n->close = jox_realloc(n->close, room, 1);
        jox_free(n->motions);
        n->motions = jox_alloc(room, sizeof *n->motions);
        jox_free(n->shapes);
        n->shapes = jox_alloc(room, sizeof *n->shapes);
    }
    for (uint32_t i = 0; i < a->count; i++)
        n->motions[i] = (JoxMotion){a->x[i], a->y[i], a->vx[i], a->vy[i]};
    for (uint32_t i = 0; i < a->count; i++) {
        uint32_t most = (uint32_t)jox_param(a, JOX_PARAM_neighbours, i), count = 0;
        float sight = jox_param(a, JOX_PARAM_perception, i);
        for (uint32_t k = 0; k < a->count; k++) {
            float dx = a->x[k] - a->x[i], dy = a->y[k] - a->y[i], d2 = dx * dx + dy * dy;
            if (k == i || d2 > sight * sight)
                continue;
            uint32_t at = count;
            for (; at > 0; at--) {
                size_t before = jox_neighbour_at(n, i, at - 1);
                float e2 = distance2[at - 1];
                if (e2 < d2 || (e2 == d2 && a->id[n->index[before]] < a->id[k]))
                    break;
                if (at < most) {
                    size_t here = jox_neighbour_at(n, i, at);
                    n->index[here] = n->index[before];
                    distance2[at] = e2;
                }
            }
            if (at < most) {
                n->index[jox_neighbour_at(n, i, at)] = k;
                distance2[at] = d2;
            }
            count += count < most;
        }
        n->count[i] = n->close[i] = (uint8_t)count;
    }
}

/* Computes the shapes of all agents. */
static inline void shape_crowd(Crowd *c) {
    JoxAgents *a = &c->agents;
    for (uint32_t i = 0; i < a->count; i++) {
        const float radius = jox_param(a, JOX_PARAM_radius, i);
        const JoxTorso torso = jox_torso_of(jox_param(a, JOX_PARAM_breadth, i),
                                            jox_param(a, JOX_PARAM_depth, i), radius);
        const float half = torso.half;
        a->contact_radius[i] = torso.radius;
        a->axis_x[i] = -a->chest_y[i] * half;
        a->axis_y[i] = a->chest_x[i] * half;
        c->near.shapes[i] = (JoxTorsoShape){a->axis_x[i], a->axis_y[i], torso.radius,
                                            half > 0.0f ? 1.0f / (half * half) : 0.0f};
    }
    c->near.widest = jox_agents_widest(a, false);
    c->near.has_torsos = jox_agents_have_torsos(a);
}

static inline void open_crowd(Crowd *c, double dt) {
    *c = (Crowd){0};
    c->forces = jox_forces_create(NULL);
    c->step =
        (JoxStep){.timing = jox_timing_at_once(dt), .agents = &c->agents, .neighbours = &c->near};
}

static inline void set_literal(Crowd *c) {
    JoxForceOptions options = jox_force_default_options();
    options.literal = true;
    jox_forces_set_options(c->forces, &options);
}

static inline void begin_crowd_step(Crowd *c) {
    find_crowd_neighbours(c);
    shape_crowd(c);
    jox_force_begin(c->forces, &c->step, &c->in);
}

static inline void close_crowd(Crowd *c) {
    jox_forces_free(c->forces);
    jox_agents_free(&c->agents);
    jox_free(c->near.index);
    jox_free(c->near.count);
    jox_free(c->near.close);
    jox_free(c->near.motions);
    jox_free(c->near.shapes);
}

static inline void set_param(Crowd *c, uint32_t i, JoxParameter p, double value) {
    jox_param_set(&c->agents, p, i, jox_parameter_store(p, value));
}

#endif
