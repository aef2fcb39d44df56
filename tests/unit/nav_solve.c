/* The kernel of solve, and the path for one agent, against plain references (nav_plain.h):
   half-planes of neighbours, wanted velocities, linear programs. On every instruction set that the
   machine runs, over random crowds and hard ones: packed, coincident, far apart, on a lattice,
   among many walls, under contacts that leave no velocity, under forces, with walkers. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "base/number/random.h"
#include "nav/near/perceive.h"
#include "nav/orca/solve.h"
#include "nav/walk/walk.h"
#include "unit/nav_plain.h"

enum { CROWDS = 48, MOST_PEOPLE = 300, MOST_PLANES = 4 };

typedef enum Kind { RANDOM, PACKED, COINCIDENT, LATTICE, FAR, WALLED, KINDS } Kind;

typedef struct Crowd {
    uint32_t number, drawn;
    Kind kind;
    JoxAgents agents;
    JoxNeighbours neighbours;
    JoxWalls walls;
    JoxWalkLaw law;
    JoxNav *nav;
    JoxContactPlanes touched;
} Crowd;

static float draw_solve(Crowd *c, double from, double to) {
    double unit = jox_random_unit(6, c->number, 0, JOX_DRAW_FILL, c->drawn++);
    return (float)(from + (to - from) * unit);
}

static bool draw_chance(Crowd *c, double share) {
    return draw_solve(c, 0.0, 1.0) < (float)share;
}

static JoxV2 direction(Crowd *c) {
    JoxV2 d = {draw_solve(c, -1.0, 1.0), draw_solve(c, -1.0, 1.0)};
    return jox_length2(d) > 1e-4f ? jox_unit(d) : (JoxV2){1.0f, 0.0f};
}

static JoxV2 place_agent(Crowd *c, uint32_t k) {
    double size = c->kind == PACKED ? 3.0 : c->kind == FAR ? 300.0 : 9.0;
    if (c->kind == LATTICE)
        return (JoxV2){0.45f * (float)(k % 17), 0.45f * (float)(k / 17)};
    if (c->kind == COINCIDENT)
        return (JoxV2){0.5f * (float)(k % 7), 0.25f * (float)(k % 3)};
    return (JoxV2){draw_solve(c, 0.0, size), draw_solve(c, 0.0, size)};
}

/* Adds agent k. `mixed`: some walk by the law, some ignore others, and perception and neighbours
   differ. */
static void add_solve_agent(Crowd *c, uint32_t k, bool mixed) {
    JoxAgents *a = &c->agents;
    uint32_t i = jox_agents_add(a);
    JoxV2 at = place_agent(c, k), wants = jox_scale(direction(c), draw_solve(c, 0.0, 1.6));
    float stands = draw_chance(c, 0.1) ? 0.0f : 1.0f, share = draw_solve(c, -0.2, 1.2);
    a->x[i] = at.x;
    a->y[i] = at.y;
    a->pref_x[i] = stands * wants.x;
    a->pref_y[i] = stands * wants.y;
    a->vx[i] = share * wants.x + draw_solve(c, -0.3, 0.3);
    a->vy[i] = share * wants.y + draw_solve(c, -0.3, 0.3);
    if (c->kind == COINCIDENT &&
        draw_chance(c, 0.5)) /* agents that move alike part by their ids alone */
        a->vx[i] = a->vy[i] = 0.25f;
    a->walk_x[i] = 0.7f * wants.x;
    a->walk_y[i] = 0.7f * wants.y;
    a->still[i] = draw_solve(c, 0.0, 8.0);
    const float radius = c->number % 3 == 1 ? 0.22f : draw_solve(c, 0.15, 0.3);
    jox_param_set(a, JOX_PARAM_radius, i, radius);
    jox_param_set(a, JOX_PARAM_breadth, i, 2.0f * radius);
    jox_param_set(a, JOX_PARAM_depth, i, 2.0f * radius);
    jox_param_set(a, JOX_PARAM_push, i, draw_chance(c, 0.5) ? 100.0f : 0.0f);
    a->tags[i] = draw_chance(c, 0.5);
    if (!mixed)
        return;
    jox_param_set(a, JOX_PARAM_neighbours, i, floorf(draw_solve(c, 0.0, 16.999)));
    jox_param_set(a, JOX_PARAM_perception, i, draw_solve(c, 0.5, 4.0));
    jox_param_set(a, JOX_PARAM_time_gap, i, draw_chance(c, 0.3) ? 0.8f : 0.0f);
    a->ignore[i] = draw_chance(c, 0.2);
}

/* Writes what forces leave behind; called after the sort, as these columns are scratch. */
static void press_agents(Crowd *c, bool pressed) {
    JoxAgents *a = &c->agents;
    JoxContactPlanes *t = &c->touched;
    t->starts = jox_alloc(a->count, sizeof *t->starts);
    t->people = jox_alloc(a->count + JOX_LANES, sizeof *t->people);
    t->bodies = jox_alloc(a->count + JOX_LANES, sizeof *t->bodies);
    t->planes = jox_alloc((size_t)a->count * MOST_PLANES, sizeof *t->planes);
    t->agents = pressed ? a->count : 0;
    for (uint32_t i = 0; i < a->count; i++) {
        a->contact_radius[i] = jox_param(a, JOX_PARAM_radius, i);
        a->speed_limit[i] = draw_solve(c, 0.8, 2.5);
        a->forced_x[i] = a->vx[i] + draw_solve(c, -0.2, 0.2);
        a->forced_y[i] = a->vy[i] + draw_solve(c, -0.2, 0.2);
        if (draw_chance(c, 0.2)) { /* carried where they want to go, but for rounding */
            a->forced_x[i] = a->pref_x[i] + 1e-5f;
            a->forced_y[i] = a->pref_y[i];
        }
        t->starts[i] = i * MOST_PLANES;
        if (!pressed)
            continue;
        JoxV2 push = direction(c);
        if (draw_chance(c, 0.4)) {
            a->half_plane_x[i] = push.x;
            a->half_plane_y[i] = push.y;
            a->half_plane_offset[i] = draw_solve(c, -1.0, 1.0);
        }
        uint32_t most = c->neighbours.count[i] < MOST_PLANES ? c->neighbours.count[i] : MOST_PLANES;
        t->people[i] = (uint8_t)draw_solve(c, 0.0, (double)most + 0.999);
        for (uint32_t k = 0; k < t->people[i]; k++)
            t->planes[t->starts[i] + k] = (JoxContactPlane){
                direction(c), draw_solve(c, -1.0, 0.6),
                c->neighbours.index[jox_neighbour_at(&c->neighbours, i, k)], 0.3f};
    }
}

static void open_solve_crowd(Crowd *c, JoIsa isa, uint32_t number) {
    *c = (Crowd){.number = number, .kind = (Kind)(number % KINDS), .law = jox_walk_law()};
    const bool mixed = number / KINDS % 2, pressed = number / KINDS / 2 % 2;
    const uint32_t people = 1 + (uint32_t)draw_solve(c, 0.0, MOST_PEOPLE - 1);
    c->nav = jox_nav_create(&c->law);
    jox_nav_set_isa(c->nav, isa);
    jox_nav_set_literal(c->nav, number % 5 == 4);
    if (number % 7 == 3)
        c->agents.period = (JoxV2){9.0f, number % 2 ? 9.0f : 0.0f};
    for (uint32_t k = 0; k < people; k++)
        add_solve_agent(c, k, mixed);
    for (uint32_t k = 0; k < (c->kind == WALLED ? 30 : 0); k++) {
        JoxV2 ends[2] = {{draw_solve(c, 0.0, 9.0), draw_solve(c, 0.0, 9.0)}, {0.0f, 0.0f}};
        ends[1] = jox_add(ends[0], jox_scale(direction(c), draw_solve(c, 0.2, 3.0)));
        jox_walls_add_polyline(&c->walls, ends, 2, false, INFINITY);
    }
    if (c->walls.count)
        jox_nav_set_walls(c->nav, &c->walls);
    jox_nav_sort(c->nav, &c->agents, 0);
    jox_nav_perceive(c->nav, &c->agents, &c->neighbours, NULL);
    c->nav->headings = c->nav->walker_headings = jox_alloc(
        c->agents.count + JOX_LANES, sizeof *c->nav->headings); /* nobody heads anywhere */
    press_agents(c, pressed);
}

static void close_solve_crowd(Crowd *c) {
    jox_nav_free(c->nav);
    jox_agents_free(&c->agents);
    jox_neighbours_free(&c->neighbours);
    jox_walls_free(&c->walls);
    jox_free(c->touched.starts);
    jox_free(c->touched.people);
    jox_free(c->touched.bodies);
    jox_free(c->touched.planes);
}

static JoxV2 turn_right(JoxV2 wanted, float turn) {
    const float right = JOX_ASIDE_RIGHT_FIRST + JOX_ASIDE_RIGHT_STUCK * turn;
    const float on = 1.0f - JOX_ASIDE_BACK_STUCK * turn;
    return jox_v2(on * wanted.x + right * wanted.y, on * wanted.y - right * wanted.x);
}

/* Lists all half-planes of an agent, those of neighbours by the reference, and checks that core's
   are the same. */
static JoxHalfPlaneCounts list_half_planes(const JoxSolve *s, uint32_t i, JoxHalfPlane *out) {
    JoxHalfPlane neighbours[JOX_MOST_NEIGHBOURS];
    const JoxHalfPlaneCounts made = jox_solve_half_planes(s, i, out);
    const uint32_t first = made.walls + made.contacts;
    assert_int_equal(plain_neighbours(s, i, neighbours), made.agents);
    assert_memory_equal(neighbours, out + first, made.agents * sizeof *neighbours);
    return made;
}

/* Returns the preferred velocity, turned to the right (and noted) for an agent that stands before
   others or pushes one straight ahead, except in literal mode. */
static JoxV2 find_plain_wish(const JoxSolve *s, uint32_t i, const JoxHalfPlane *others,
                             uint32_t count) {
    JoxAgents *a = s->step.agents;
    JoxV2 wanted = {a->pref_x[i], a->pref_y[i]}, velocity = {a->vx[i], a->vy[i]};
    if (jox_solve_walks(s, i))
        return (JoxV2){a->walk_x[i], a->walk_y[i]};
    bool gets_on = jox_dot(velocity, wanted) > 0.2f * jox_length2(wanted);
    if (s->nav->literal || jox_stands(a, i) ||
        (gets_on && !(jox_param(a, JOX_PARAM_push, i) > 0.0f)))
        return wanted;
    for (uint32_t k = 0; k < count; k++) {
        float against = -jox_dot(others[k].normal, wanted);
        bool head_on = against > 0.0f && fabsf(jox_det(others[k].normal, wanted)) < 0.02f * against;
        if (-against < others[k].offset && (!gets_on || head_on)) {
            a->plan_notes[i] |= JOX_NOTE_TURNED_ASIDE;
            return turn_right(wanted, gets_on ? 0.0f : jox_turn_aside(s, i));
        }
    }
    return wanted;
}

/* Returns how many agents of a crowd the programs could not satisfy. */
static uint32_t compare_solve_crowd(JoIsa isa, uint32_t number, bool plans) {
    static float next_x[MOST_PEOPLE], next_y[MOST_PEOPLE];
    static uint8_t failed[MOST_PEOPLE], notes[MOST_PEOPLE];
    Crowd c;
    open_solve_crowd(&c, isa, number);
    JoxAgents *a = &c.agents;
    JoxStep step = {
        .timing = {.seed = 6, .time = 2.5, .dt = 0.05, .planning_time = 0.05, .plans = plans},
        .agents = a,
        .neighbours = &c.neighbours,
        .touched = &c.touched};
    uint32_t relaxed = jox_nav_solve(c.nav, &step);
    memcpy(next_x, a->next_x, a->count * sizeof *next_x);
    memcpy(next_y, a->next_y, a->count * sizeof *next_y);
    memcpy(failed, a->failed, a->count);
    memcpy(notes, a->plan_notes, a->count);
    memset(a->next_x, 0, a->count * sizeof *next_x);
    memset(a->next_y, 0, a->count * sizeof *next_y);
    memset(a->failed, 0, a->count);
    memset(a->plan_notes, 0, a->count);
    if (!c.touched.agents)
        step.touched = NULL;
    const JoxSolve s = {.nav = c.nav,
                        .step = step,
                        .aside = {jox_random_stream(6), jox_random_moment(2, JOX_DRAW_ASIDE)}};
    uint32_t failures = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        JoxHalfPlane list[JOX_MOST_CONSTRAINTS];
        if (plans || (!jox_solve_walks(&s, i) && jox_stands_pressed(a, i))) {
            JoxHalfPlaneCounts made = list_half_planes(&s, i, list);
            JoxV2 wanted = find_plain_wish(&s, i, list + made.walls, made.contacts + made.agents);
            relaxed -= plain_solve_one(&s, i, &made, list, wanted);
        }
        assert_true(next_x[i] == a->next_x[i] && next_y[i] == a->next_y[i]);
        assert_int_equal(failed[i], a->failed[i]);
        assert_int_equal(notes[i], a->plan_notes[i]);
        failures += failed[i];
    }
    assert_int_equal(relaxed, 0);
    close_solve_crowd(&c);
    return failures;
}

static void test_velocities(void **state) {
    (void)state;
    for (JoIsa isa = JO_ISA_SCALAR; isa <= JO_ISA_NEON; isa++) {
        uint32_t failures = 0;
        for (uint32_t number = 0; jox_isa_runs(isa) && number < CROWDS; number++)
            failures += compare_solve_crowd(isa, number, number % 4 != 1);
        assert_true(failures > 100 || !jox_isa_runs(isa)); /* the program in three dimensions */
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_velocities)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
