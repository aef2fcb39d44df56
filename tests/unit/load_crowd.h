/* Moving crowds of 150 people, whose mean load must not depend on the time step: people pressing
   towards a door, a stream in a periodic corridor, people milling about in a closed room. Preferred
   velocities depend on time, position and the person's number, not on the number of steps. */
#ifndef TESTS_UNIT_LOAD_CROWD_H
#define TESTS_UNIT_LOAD_CROWD_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number/random.h"
#include "world/world.h"

enum { CROWD_PEOPLE = 150, CROWD_SCENES = 3 };
static const char *const crowd_scenes[CROWD_SCENES] = {"door", "stream", "milling"};
static const double CROWD_FROM = 5.0, CROWD_UNTIL = 20.0; /* s: period that means are taken over */
static const double ROOM = 6.547;                         /* m, side: gives 3.5 people per m2 */

typedef struct MovingCrowd {
    JoWorld *world;
    JoAgent people[CROWD_PEOPLE];
    int scene;
    uint64_t seed;
    uint32_t drawn; /* people who have come back, numbers their draws */
} MovingCrowd;

/* Means over people and time. */
typedef struct CrowdMeans {
    double load;        /* N; NAN if the engine has no such column */
    double compression; /* N/m */
    double overlap;     /* m, depth of a person's deepest overlap with another */
    double speed;       /* m/s */
} CrowdMeans;

/* Returns a number in [0, 1), the same for the same person and number. */
static inline double crowd_draw(const MovingCrowd *c, uint32_t person, uint64_t number) {
    return jox_random_unit(c->seed, person, number, JOX_DRAW_AIM, 0);
}

/* Returns the column of floats of this name, or NULL. */
static inline const float *agent_column(const JoWorld *w, const char *name) {
#define STATE(type, column) AGENT_COLUMN_##type(column)
#define RARE(type, column) STATE(type, column)
#define SCRATCH(type, column) AGENT_COLUMN_##type(column)
#define INDEX(type, column)
#define HINT(type, column) SCRATCH(type, column)
#define AGENT_COLUMN_float(column)                                                                 \
    if (strcmp(name, #column) == 0)                                                                \
        return w->state.agents.column;
#define AGENT_COLUMN_uint8_t(column)
#define AGENT_COLUMN_uint16_t(column)
#define AGENT_COLUMN_uint32_t(column)
#define AGENT_COLUMN_int32_t(column)
#define AGENT_COLUMN_uint64_t(column)
#define X(keep, type, column) keep(type, column)
    JOX_AGENT_COLUMNS(X)
#undef X
#undef STATE
#undef RARE
#undef SCRATCH
#undef INDEX
#undef HINT
    return NULL;
}

static inline JoAgent crowd_add(MovingCrowd *c, double x, double y) {
    JoAgentDef def = jo_default_agent_def();
    def.x = x;
    def.y = y;
    def.push = c->scene == 2 ? 0.0 : 100.0;
    JoError error;
    JoAgent one = jo_world_add_agent(c->world, &def, &error);
    if (!one.generation) {
        fprintf(stderr, "%s\n", error.text);
        exit(1);
    }
    return one;
}

/* Makes a scene's world: its walls, and people on a grid that the seed perturbs. */
static inline MovingCrowd crowd_open(int scene, uint64_t seed, double dt) {
    static const double door[][6] = {{0, 0.5, 0, 4, -12, 4}, {0, -0.5, 0, -4, -12, -4}};
    static const double sides[][4] = {{-1, 0, 16, 0}, {-1, 2.5, 16, 2.5}};
    const double room[] = {0, 0, ROOM, 0, ROOM, ROOM, 0, ROOM, 0, 0};
    const struct {
        double x, y, width, height;
        int columns;
    } at[CROWD_SCENES] = {{-9, -3.7, 8.7, 7.4, 15}, {0, 0.2, 15, 2.1, 25}, {0, 0, ROOM, ROOM, 13}};
    MovingCrowd c = {.scene = scene, .seed = seed};
    JoWorldDef def = jo_default_world_def();
    def.dt = dt;
    def.seed = seed;
    c.world = jo_world_create(&def, NULL);
    for (int side = 0; side < 2 && scene < 2; side++)
        jo_world_add_line(c.world, scene == 0 ? door[side] : sides[side], scene == 0 ? 3 : 2, NULL);
    if (scene == 1)
        c.world->state.agents.period = (JoxV2){15.0f, 0.0f};
    if (scene == 2)
        jo_world_add_line(c.world, room, 5, NULL);
    int rows = (CROWD_PEOPLE + at[scene].columns - 1) / at[scene].columns;
    double dx = at[scene].width / at[scene].columns, dy = at[scene].height / rows;
    for (int i = 0; i < CROWD_PEOPLE; i++) {
        double shift_x = 0.1 * (crowd_draw(&c, (uint32_t)i, 0) - 0.5);
        double shift_y = 0.05 * (crowd_draw(&c, (uint32_t)i, 1) - 0.5);
        c.people[i] =
            crowd_add(&c, at[scene].x + (i % at[scene].columns + 0.5) * dx + shift_x,
                      at[scene].y + ((double)(i / at[scene].columns) + 0.5) * dy + shift_y);
    }
    return c;
}

static inline void crowd_close(MovingCrowd *c) {
    jo_world_free(c->world);
}

/* Sets a person's preferred velocity. A person who has passed the door comes back behind the
   crowd. */
static inline void crowd_wish(MovingCrowd *c, int i) {
    JoAgentState s = jo_agent_state(c->world, c->people[i]);
    uint32_t person = (uint32_t)i;
    double own = 1.3 * (0.7 + 0.6 * crowd_draw(c, person, 2)); /* m/s */
    double x = own, y = 0.0;
    if (c->scene == 0) {
        if (s.x > 2.0) {
            jo_world_remove_agent(c->world, c->people[i]);
            c->people[i] = crowd_add(c, -10.0 - crowd_draw(c, 1000 + c->drawn, 3),
                                     7.0 * (crowd_draw(c, 1000 + c->drawn, 4) - 0.5));
            c->drawn++;
            s = jo_agent_state(c->world, c->people[i]);
        }
        double aim = 0.6 * (crowd_draw(c, person, 5) - 0.5);
        x = s.x < 0.0 ? -s.x + 0.2 : 1.0;
        y = s.x < 0.0 ? aim - s.y : 0.0;
    } else if (c->scene == 2) {
        /* A new goal every 3 s, at times that differ between people. */
        double when = jo_world_time(c->world) + 3.0 * crowd_draw(c, person, 6);
        uint64_t number = (uint64_t)floor(when / 3.0 + 1e-6);
        x = 0.3 + (ROOM - 0.6) * crowd_draw(c, person, 16 + 2 * number) - s.x;
        y = 0.3 + (ROOM - 0.6) * crowd_draw(c, person, 17 + 2 * number) - s.y;
    }
    double away = hypot(x, y);
    double speed = c->scene == 2 ? fmin(own, away) : own;
    if (away > 0.0)
        jo_agent_set_preferred(c->world, c->people[i], x / away * speed, y / away * speed);
}

static inline double deepest_overlap(const JoxAgents *a, uint32_t i) {
    double deepest = 0.0;
    for (uint32_t k = 0; k < a->count; k++) {
        if (k == i)
            continue;
        JoxV2 d = jox_offset(a, i, k);
        if (fabsf(d.x) < 0.4f && fabsf(d.y) < 0.4f)
            deepest = fmax(deepest, 0.4 - (double)jox_length(d));
    }
    return deepest;
}

static inline CrowdMeans crowd_means(int scene, uint64_t seed, double dt) {
    MovingCrowd c = crowd_open(scene, seed, dt);
    CrowdMeans sum = {0};
    uint64_t steps = (uint64_t)(CROWD_UNTIL / dt + 0.5), first = (uint64_t)(CROWD_FROM / dt + 0.5);
    uint64_t every = (uint64_t)(0.5 / dt + 0.5), samples = 0, looks = 0;
    for (uint64_t step = 0; step < steps; step++) {
        for (int i = 0; i < CROWD_PEOPLE; i++)
            crowd_wish(&c, i);
        jo_world_step(c.world, 1);
        if (step < first)
            continue;
        const JoxAgents *a = &c.world->state.agents;
        const float *load = agent_column(c.world, "load");
        for (uint32_t i = 0; i < a->count; i++) {
            sum.load += load ? (double)load[i] : NAN;
            sum.compression += (double)a->compression[i];
            sum.speed += hypot((double)a->vx[i], (double)a->vy[i]);
            samples++;
        }
        for (uint32_t i = 0; step % every == 0 && i < a->count; i++, looks++)
            sum.overlap += deepest_overlap(a, i);
    }
    if (jo_world_failure(c.world))
        fprintf(stderr, "%s\n", jo_world_failure(c.world));
    crowd_close(&c);
    double n = (double)samples;
    return (CrowdMeans){sum.load / n, sum.compression / n, sum.overlap / (double)looks,
                        sum.speed / n};
}

#endif
