/* The kernels of move against plain loops, on every instruction set that the
   machine runs: agents with random velocities and plans, in the open, around walls, over periodic
   edges, and with NaN. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/number/random.h"
#include "geom/wall_way.h"
#include "nav/move/move.h"
#include "nav/near/perceive.h"
#include "nav/orca/solve.h"
#include "nav/walk/walk.h"

enum { PEOPLE = 61, CROWDS = 12, COLUMNS = 11 }; /* not a whole number of packets */

static float draw_move(uint32_t crowd, uint32_t *drawn, double from, double to) {
    double unit = jox_random_unit(7, crowd, 0, JOX_DRAW_FILL, (*drawn)++);
    return (float)(from + (to - from) * unit);
}

typedef struct Crowd {
    JoxAgents agents;
    JoxNav *nav;
    JoxNeighbours neighbours;
    JoxWalls walls;
    JoxMove move;
    JoxV2 at[PEOPLE + JOX_LANES];
} Crowd;

static void open_move_crowd(Crowd *c, uint32_t number) {
    static const JoxV2 bar[] = {{2.0f, -1.0f}, {4.0f, 6.0f}, {7.0f, 3.0f}};
    JoxAgents *a = &c->agents;
    uint32_t drawn = 0;
    memset(c, 0, sizeof *c);
    c->nav = jox_nav_create(NULL);
    for (uint32_t k = 0; k < PEOPLE; k++) {
        uint32_t i = jox_agents_add(a);
        a->x[i] = draw_move(number, &drawn, 0.0, 10.0);
        a->y[i] = draw_move(number, &drawn, 0.0, 7.0);
    }
    if (number % 3 == 1) {
        jox_walls_add_polyline(&c->walls, bar, 3, false, INFINITY);
        jox_nav_set_walls(c->nav, &c->walls);
        jox_wall_grid_fit(&c->nav->grid, 0.8f);
    } else if (number % 3 == 2) {
        a->period = (JoxV2){10.0f, number % 2 ? 7.0f : 0.0f};
        a->origin = (JoxV2){0.0f, -0.5f};
    }
    jox_nav_sort(c->nav, a, 0);
    for (uint32_t i = 0; i < PEOPLE; i++) {
        const float hurry = draw_move(number, &drawn, 0.0, 1.0) < 0.1f ? 40.0f : 2.0f;
        a->forced_x[i] = draw_move(number, &drawn, -2.0, 2.0);
        a->forced_y[i] = draw_move(number, &drawn, -2.0, 2.0);
        a->next_x[i] = draw_move(number, &drawn, -1.0, 1.0) * hurry;
        a->next_y[i] = number == 11 && i == 30 ? NAN : draw_move(number, &drawn, -1.0, 1.0) * hurry;
        a->still_x[i] = a->x[i] + draw_move(number, &drawn, -0.3, 0.3);
        a->still_y[i] = a->y[i];
        a->still[i] = draw_move(number, &drawn, 0.0, 5.0);
        a->contact_radius[i] = 0.2f;
        a->chest_x[i] = 0.6f;
        a->chest_y[i] = 0.8f;
        a->spin[i] = draw_move(number, &drawn, -20.0, 20.0);
    }
    jox_neighbours_reserve(&c->neighbours, PEOPLE, 1);
    for (uint32_t i = 0; i < PEOPLE; i++)
        c->neighbours.motions[i] = (JoxMotion){a->x[i], a->y[i], a->vx[i], a->vy[i]};
    c->neighbours.has_torsos = number % 2;
    c->move = (JoxMove){.nav = c->nav,
                        .step = {.timing = {.dt = 0.05, .response = 0.6, .on_the_way = 0.35},
                                 .agents = a,
                                 .neighbours = &c->neighbours},
                        .position = {c->at}};
}

static void close_move_crowd(Crowd *c) {
    jox_nav_free(c->nav);
    jox_neighbours_free(&c->neighbours);
    jox_agents_free(&c->agents);
    jox_walls_free(&c->walls);
}

/* Turns the chest of agent i by 2 atan(spin dt / 2). */
static void turn_by_loops(JoxAgents *a, uint32_t i, float dt) {
    const float half = a->spin[i] * (0.5f * dt), by = 1.0f / (1.0f + half * half);
    const float c = (1.0f - half * half) * by, s = (half + half) * by;
    const JoxV2 chest = {c * a->chest_x[i] - s * a->chest_y[i],
                         s * a->chest_x[i] + c * a->chest_y[i]};
    const float inverse = 1.0f / jox_length(chest);
    a->chest_x[i] = chest.x * inverse;
    a->chest_y[i] = chest.y * inverse;
    assert_true(jox_is_unit(chest));
}

/* Moves the agents by plain loops. Returns their drift. */
static JoxDrift move_by_loops(Crowd *c) {
    const JoxTiming *t = &c->move.step.timing;
    const float dt = (float)t->dt, response = (float)t->response;
    const float on_the_way = (float)t->on_the_way;
    JoxAgents *a = &c->agents;
    JoxDrift drift = {0.0f, {INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint32_t i = 0; i < PEOPLE; i++) {
        const JoxV2 from = {a->x[i], a->y[i]}, forced = {a->forced_x[i], a->forced_y[i]};
        const JoxV2 rest = jox_sub((JoxV2){a->next_x[i], a->next_y[i]}, forced);
        JoxV2 to = jox_add(from, jox_scale(jox_add(forced, jox_scale(rest, on_the_way)), dt));
        a->prev_x[i] = from.x;
        a->prev_y[i] = from.y;
        a->vx[i] = forced.x + rest.x * response;
        a->vy[i] = forced.y + rest.y * response;
        if (c->neighbours.has_torsos)
            turn_by_loops(a, i, dt);
        if (c->nav->grid.first)
            to = jox_way_by_walls(&c->nav->grid, from, to, a->contact_radius[i]);
        a->x[i] = to.x;
        a->y[i] = to.y;
        const JoxV2 way = jox_sub(to, from);
        drift = jox_drift_of_both(drift, (JoxDrift){jox_length(way), way, way});
        if (jox_agents_wrap(a, i)) {
            if (isfinite(a->x[i]) && isfinite(a->y[i]))
                jox_nav_list_stray(c->nav, i);
            else
                drift.farthest = INFINITY;
        }
        const JoxV2 rests = {a->x[i] - a->still_x[i], a->y[i] - a->still_y[i]};
        a->still[i] += dt;
        if (jox_length2(rests) > JOX_STILL_REACH * JOX_STILL_REACH) {
            a->still[i] = 0.0f;
            a->still_x[i] = a->x[i];
            a->still_y[i] = a->y[i];
        }
    }
    return drift;
}

static void list_move_columns(const JoxAgents *a, float *out[COLUMNS]) {
    float *columns[COLUMNS] = {a->x,     a->y,       a->prev_x,  a->prev_y,  a->vx,     a->vy,
                               a->still, a->still_x, a->still_y, a->chest_x, a->chest_y};
    memcpy(out, columns, sizeof columns);
}

static void test_move(void **state) {
#define X(name, isa) [isa] = jox_move_integrate_##name,
    static JoxMoveKernel *const INTEGRATE[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X
#define X(name, isa) [isa] = jox_move_settle_##name,
    static JoxSettleKernel *const SETTLE[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X
    (void)state;
    uint32_t over = 0, moved = 0;
    for (uint32_t number = 0; number < CROWDS; number++)
        for (JoIsa isa = JO_ISA_SCALAR; isa <= JO_ISA_NEON; isa++) {
            if (!jox_isa_runs(isa))
                continue;
            Crowd plain, wide;
            float *expected[COLUMNS], *got[COLUMNS];
            open_move_crowd(&plain, number);
            open_move_crowd(&wide, number);
            const JoxDrift by_one = move_by_loops(&plain);
            INTEGRATE[isa](&wide.move, 0, PEOPLE);
            const JoxDrift drift = SETTLE[isa](&wide.move, 0, PEOPLE);
            assert_true(memcmp(&drift, &by_one, sizeof drift) == 0 || number == 11);
            list_move_columns(&plain.agents, expected);
            list_move_columns(&wide.agents, got);
            for (uint32_t k = 0; k < COLUMNS; k++)
                assert_memory_equal(expected[k], got[k], PEOPLE * sizeof(float));
            assert_int_equal(plain.nav->stray_count, wide.nav->stray_count);
            assert_memory_equal(plain.nav->strays, wide.nav->strays, sizeof wide.nav->strays);
            over += wide.nav->stray_count;
            for (uint32_t i = 0; i < PEOPLE; i++)
                moved += wide.agents.still[i] == 0.0f;
            close_move_crowd(&plain);
            close_move_crowd(&wide);
        }
    assert_true(over > 0 && moved > 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_move)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
