/* Walls: no agent passes one, however fast; agents get around corners; head-on agents both give
   way. Also: the neighbours found are the nearest ones, and the linear program is optimal. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "base/number/random.h"
#include "geom/polygon.h"
#include "nav/orca/solve.h"

typedef struct Fixture {
    JoxAgents agents;
    JoxNeighbours neighbours;
    JoxWalls walls;
    JoxNav *nav;
    uint64_t tick;
} Fixture;

static void open_walls(Fixture *f) {
    *f = (Fixture){.nav = jox_nav_create(NULL)};
}

static void close_walls(Fixture *f) {
    jox_nav_free(f->nav);
    jox_agents_free(&f->agents);
    jox_walls_free(&f->walls);
    jox_neighbours_free(&f->neighbours);
}

static uint32_t add_standing_agent(Fixture *f, float x, float y) {
    uint32_t i = jox_agents_add(&f->agents);
    f->agents.x[i] = f->agents.prev_x[i] = x;
    f->agents.y[i] = f->agents.prev_y[i] = y;
    return f->agents.id[i];
}

/* Runs a step in which each agent wants to go to the goal of its id. */
static void run_walls_step(Fixture *f, const JoxV2 *goals, float speed, double dt, JoxPool *pool) {
    JoxAgents *a = &f->agents;
    jox_nav_sort(f->nav, a, f->tick);
    jox_nav_perceive(f->nav, a, &f->neighbours, pool);
    for (uint32_t i = 0; i < a->count; i++) {
        JoxV2 way = jox_unit((JoxV2){goals[a->id[i]].x - a->x[i], goals[a->id[i]].y - a->y[i]});
        a->pref_x[i] = way.x * speed;
        a->pref_y[i] = way.y * speed;
        a->speed_limit[i] = jox_maxf(jox_param(a, JOX_PARAM_max_speed, i), speed);
        a->contact_radius[i] = jox_param(a, JOX_PARAM_radius, i);
    }
    JoxStep step = {
        .timing = jox_timing_at_once(dt), .agents = a, .neighbours = &f->neighbours, .pool = pool};
    step.timing.seed = 1;
    jox_nav_solve(f->nav, &step);
    jox_nav_move(f->nav, &step);
    f->tick++;
}

static void neighbours_are_exactly_the_nearest(void **state) {
    (void)state;
    for (uint32_t trial = 0; trial < 30; trial++) {
        Fixture f;
        open_walls(&f);
        JoxV2 goals[400];
        uint32_t count = trial == 0 ? 1 : 100 + trial * 10;
        float side = trial % 3 == 0 ? 4.0f : 20.0f;
        for (uint32_t i = 0; i < count; i++) {
            float x = side * (float)jox_random_unit(trial, i, 0, JOX_DRAW_FILL, 0);
            float y = side * (float)jox_random_unit(trial, i, 0, JOX_DRAW_FILL, 1);
            if (i % 17 == 3) /* some at the same point */
                x = y = 1.0f;
            add_standing_agent(&f, x, y);
            jox_param_set(&f.agents, JOX_PARAM_perception, i, 0.5f + (float)(i % 7) * 0.7f);
            jox_param_set(&f.agents, JOX_PARAM_neighbours, i, (float)(i % 13));
            goals[i] = (JoxV2){side - x, side - y};
        }
        for (int s = 0; s < 7; s++) { /* some just sorted, some drifted */
            run_walls_step(&f, goals, 1.3f, 0.1, NULL);
            JoxAgents *a = &f.agents;
            jox_nav_sort(f.nav, a, f.tick);
            jox_nav_perceive(f.nav, a, &f.neighbours, NULL);
            for (uint32_t i = 0; i < count; i++) {
                float reach = jox_param(a, JOX_PARAM_perception, i);
                uint32_t most = (uint32_t)jox_param(a, JOX_PARAM_neighbours, i), n = 0;
                uint32_t best[16];
                float d2s[16];
                for (uint32_t j = 0; j < count && most > 0; j++) {
                    float dx = a->x[j] - a->x[i], dy = a->y[j] - a->y[i], d2 = dx * dx + dy * dy;
                    if (j == i || d2 > reach * reach)
                        continue;
                    uint32_t at = n < most ? n++ : most;
                    if (at == most && (d2 > d2s[most - 1] ||
                                       (d2 == d2s[most - 1] && a->id[j] > a->id[best[most - 1]])))
                        continue;
                    at = at == most ? most - 1 : at;
                    for (; at > 0 && (d2 < d2s[at - 1] ||
                                      (d2 == d2s[at - 1] && a->id[j] < a->id[best[at - 1]]));
                         at--) {
                        d2s[at] = d2s[at - 1];
                        best[at] = best[at - 1];
                    }
                    d2s[at] = d2;
                    best[at] = j;
                }
                assert_int_equal(f.neighbours.count[i], n);
                for (uint32_t k = 0; k < n; k++)
                    assert_int_equal(f.neighbours.index[jox_neighbour_at(&f.neighbours, i, k)],
                                     best[k]);
            }
        }
        close_walls(&f);
    }
}

static void a_fast_agent_does_not_pass_a_thin_wall(void **state) {
    (void)state;
    const float speeds[] = {1.0f, 5.0f, 15.0f, 30.0f};
    for (int s = 0; s < 4; s++)
        for (int from = 0; from < 20; from++) {
            Fixture f;
            open_walls(&f);
            const JoxV2 line[] = {{0, -50}, {0, 50}};
            jox_walls_add_polyline(&f.walls, line, 2, false, 3);
            jox_nav_set_walls(f.nav, &f.walls);
            add_standing_agent(&f, -10.0f - 0.13f * (float)from, 0.3f * (float)from);
            JoxV2 goal = {30, -5};
            for (int i = 0; i < 60; i++) {
                run_walls_step(&f, &goal, speeds[s], 0.2, NULL);
                assert_true(f.agents.x[0] < 0.0f);
            }
            close_walls(&f);
        }
}

static void agents_get_around_a_convex_corner_and_never_inside(void **state) {
    (void)state;
    Fixture f;
    open_walls(&f);
    const JoxV2 block[] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    jox_walls_add_solid(&f.walls, block, 4, 3);
    jox_nav_set_walls(f.nav, &f.walls);
    add_standing_agent(&f, -2.0f, 3.6f); /* the way to the goal just cuts the corner at (0, 4) */
    JoxV2 goal = {6.0f, 5.4f};
    for (int i = 0; i < 400; i++) {
        run_walls_step(&f, &goal, 1.3f, 0.05, NULL);
        assert_false(jox_polygon_contains(block, 4, (JoxV2){f.agents.x[0], f.agents.y[0]}));
    }
    assert_true(fabsf(f.agents.x[0] - goal.x) < 0.3f && fabsf(f.agents.y[0] - goal.y) < 0.3f);
    close_walls(&f);
}

static void a_crowd_in_a_concave_corner_stays_in_the_room(void **state) {
    (void)state;
    Fixture f;
    open_walls(&f);
    const JoxV2 room[] = {{0, 0}, {6, 0}, {6, 6}, {0, 6}};
    jox_walls_add_polyline(&f.walls, room, 4, true, 3);
    jox_nav_set_walls(f.nav, &f.walls);
    JoxV2 goals[40];
    for (uint32_t i = 0; i < 40; i++) {
        add_standing_agent(&f, 1.0f + (float)(i % 8) * 0.6f, 1.0f + (float)(i / 8) * 0.6f);
        goals[i] = (JoxV2){9.0f, 9.0f}; /* beyond the corner */
    }
    for (int i = 0; i < 1200; i++) {
        run_walls_step(&f, goals, 1.5f, 0.05, NULL);
        for (uint32_t k = 0; k < 40; k++)
            assert_true(f.agents.x[k] > 0 && f.agents.x[k] < 6 && f.agents.y[k] > 0 &&
                        f.agents.y[k] < 6);
    }
    close_walls(&f);
}

static void head_on_agents_give_way_equally(void **state) {
    (void)state;
    Fixture f;
    open_walls(&f);
    add_standing_agent(&f, -4, 0.02f);
    add_standing_agent(&f, 4, -0.02f);
    const JoxV2 goals[] = {{4, 0}, {-4, 0}};
    float aside[2] = {0, 0}, nearest = INFINITY;
    for (int i = 0; i < 140; i++) {
        run_walls_step(&f, goals, 1.3f, 0.05, NULL);
        for (uint32_t k = 0; k < 2; k++)
            aside[k] = jox_maxf(aside[k], fabsf(f.agents.y[jox_agents_find(&f.agents, k)]));
        nearest = jox_minf(nearest, jox_length((JoxV2){f.agents.x[0] - f.agents.x[1],
                                                       f.agents.y[0] - f.agents.y[1]}));
    }
    assert_true(nearest > 0.39f);
    assert_true(aside[0] > 0.1f && fabsf(aside[0] - aside[1]) < 0.02f);
    assert_true(f.agents.x[jox_agents_find(&f.agents, 0)] > 3.0f);
    close_walls(&f);
}

static void threads_do_not_change_a_bit(void **state) {
    (void)state;
    uint64_t sums[3];
    for (uint32_t threads = 1; threads <= 3; threads++) {
        Fixture f;
        open_walls(&f);
        JoxPool *pool = jox_pool_create(threads);
        static JoxV2 goals[1500];
        for (uint32_t i = 0; i < 1500; i++) {
            float x = (float)(i % 40) * 0.5f, y = (float)(i / 40) * 0.5f;
            add_standing_agent(&f, x, y);
            goals[i] = (JoxV2){20 - x, 18 - y};
        }
        for (int s = 0; s < 30; s++)
            run_walls_step(&f, goals, 1.3f, 0.05, pool);
        sums[threads - 1] = 0;
        for (uint32_t i = 0; i < 1500; i++) {
            uint32_t bits[2];
            memcpy(&bits[0], &f.agents.x[jox_agents_find(&f.agents, i)], 4);
            memcpy(&bits[1], &f.agents.y[jox_agents_find(&f.agents, i)], 4);
            sums[threads - 1] = (sums[threads - 1] * 31 + bits[0]) * 31 + bits[1];
        }
        jox_pool_free(pool);
        close_walls(&f);
    }
    assert_true(sums[0] == sums[1] && sums[0] == sums[2]);
}

/* The program against all candidate points: intersections of two borders, of a border with the
   disc, feet of the wanted point. */
static void the_program_finds_the_nearest_velocity(void **state) {
    (void)state;
    int feasible = 0;
    for (uint32_t trial = 0; trial < 800; trial++) {
        JoxHalfPlane half_planes[8];
        uint32_t count = 1 + trial % 8;
        for (uint32_t k = 0; k < count; k++) {
            double angle = 6.283185 * jox_random_unit(trial, k, 1, JOX_DRAW_FILL, 0);
            half_planes[k] =
                (JoxHalfPlane){{(float)cos(angle), (float)sin(angle)},
                               (float)(1.6 * jox_random_unit(trial, k, 1, JOX_DRAW_FILL, 1) - 1.2)};
        }
        JoxV2 wanted = {(float)(3 * jox_random_unit(trial, 9, 1, JOX_DRAW_FILL, 0) - 1.5),
                        (float)(3 * jox_random_unit(trial, 9, 1, JOX_DRAW_FILL, 1) - 1.5)};
        const float disc = 1.4f;
        double best = INFINITY, least = INFINITY; /* least distance; least greatest violation */
        for (int iy = -140; iy <= 140; iy++)
            for (int ix = -140; ix <= 140; ix++) {
                double x = ix * 0.01, y = iy * 0.01, worst = 0;
                if (x * x + y * y > disc * disc)
                    continue;
                for (uint32_t k = 0; k < count; k++)
                    worst = fmax(worst, half_planes[k].offset - half_planes[k].normal.x * x -
                                            half_planes[k].normal.y * y);
                least = fmin(least, worst);
                if (worst <= 0)
                    best = fmin(best, hypot(x - wanted.x, y - wanted.y));
            }
        JoxV2 v;
        bool relaxed;
        bool found =
            jox_linear_program_solve(half_planes, count, 0, disc, wanted, false, &v, &relaxed);
        double worst = 0;
        for (uint32_t k = 0; k < count; k++)
            worst = fmax(worst, half_planes[k].offset - jox_dot(half_planes[k].normal, v));
        assert_true(jox_length(v) <= disc + 1e-4f);
        if (found) {
            feasible++;
            assert_true(worst < 1e-4);
            assert_true(hypot(v.x - wanted.x, v.y - wanted.y) <= best + 1e-4);
        } else {
            assert_true(isinf(best));           /* the lattice finds nothing either, */
            assert_true(worst <= least + 1e-3); /* and no lesser violation */
        }
    }
    assert_true(feasible > 150 && feasible < 780); /* both kinds were tried */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbours_are_exactly_the_nearest),
        cmocka_unit_test(a_fast_agent_does_not_pass_a_thin_wall),
        cmocka_unit_test(agents_get_around_a_convex_corner_and_never_inside),
        cmocka_unit_test(a_crowd_in_a_concave_corner_stays_in_the_room),
        cmocka_unit_test(head_on_agents_give_way_equally),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(the_program_finds_the_nearest_velocity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
