/* The walking law in crowds: turned and mirrored crowds behave the same, agents without a time gap
   choose by ORCA as ever, threads change nothing, and all values stay finite. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/number/elementary.h"
#include "base/number/random.h"
#include "nav/nav_state.h"
#include "world/world.h"

enum { PEOPLE = 400 };
static const double PI = 3.14159265358979323846;

static float draw_walk(uint32_t k, uint32_t sub) {
    return (float)jox_random_unit(5, k, 0, JOX_DRAW_FILL, sub);
}

/* Transformation of a crowd: mirrored at the x axis, then turned. */
typedef struct Frame {
    double angle;
    bool mirrored;
} Frame;

static JoxV2 transform(Frame f, JoxV2 p) {
    double c = jox_cos(f.angle), s = jox_sin(f.angle), y = f.mirrored ? -(double)p.y : (double)p.y;
    return (JoxV2){(float)(c * (double)p.x - s * y), (float)(s * (double)p.x + c * y)};
}

typedef struct Crowd {
    JoxAgents agents;
    JoxNeighbours neighbours;
    JoxWalls walls;
    JoxNav *nav;
    Frame frame;
} Crowd;

static void free_walk_crowd(Crowd *c) {
    jox_nav_free(c->nav);
    jox_agents_free(&c->agents);
    jox_walls_free(&c->walls);
    jox_neighbours_free(&c->neighbours);
}

/* Returns the direction in which agent k heads and moves, a unit vector. */
static JoxV2 draw_heading(uint32_t k) {
    double angle = floor(4.0 * (double)draw_walk(k, 2)) * PI / 2 + 0.3 * (double)draw_walk(k, 3);
    return (JoxV2){(float)jox_cos(angle), (float)jox_sin(angle)};
}

/* Adds agents in a square, with several directions and velocities. */
static void add_crowd(Crowd *c, float side) {
    JoxAgents *a = &c->agents;
    for (uint32_t k = 0; k < PEOPLE; k++) {
        uint32_t i = jox_agents_add(a);
        JoxV2 at = transform(c->frame, (JoxV2){side * draw_walk(k, 0), side * draw_walk(k, 1)});
        JoxV2 v = transform(c->frame, jox_scale(draw_heading(k), 1.3f * draw_walk(k, 5)));
        a->x[i] = a->prev_x[i] = at.x;
        a->y[i] = a->prev_y[i] = at.y;
        a->vx[i] = v.x;
        a->vy[i] = v.y;
        a->bound[i] = k % 2 ? 1 : 0;
        jox_param_set(a, JOX_PARAM_time_gap, i, 1.0f);
        jox_param_set(a, JOX_PARAM_haste, i, draw_walk(k, 8));
    }
}

/* Writes the preferred velocities, ways and places of a step; called after the sort, which discards
   these columns. Half of the agents are bound for the same place. */
static void set_wishes(Crowd *c) {
    JoxAgents *a = &c->agents;
    for (uint32_t i = 0; i < a->count; i++) {
        const uint32_t k = a->id[i];
        JoxV2 pref = transform(c->frame, jox_scale(draw_heading(k), 0.3f + 1.4f * draw_walk(k, 4)));
        a->pref_x[i] = draw_walk(k, 6) < 0.1f ? 0.0f : pref.x;
        a->pref_y[i] = draw_walk(k, 6) < 0.1f ? 0.0f : pref.y;
        a->way_left[i] = 20.0f * draw_walk(k, 7);
        a->speed_limit[i] = 3.0f;
        a->contact_radius[i] = jox_param(a, JOX_PARAM_radius, i);
    }
}

static void make_walk_crowd(Crowd *c, Frame f, const JoxWalkLaw *law, float side) {
    *c = (Crowd){.nav = jox_nav_create(law), .frame = f};
    for (uint32_t k = 0; k < 12; k++) {
        JoxV2 from = {side * draw_walk(k, 20), side * draw_walk(k, 21)};
        JoxV2 to = {from.x + 4.0f * draw_walk(k, 22) - 2.0f,
                    from.y + 4.0f * draw_walk(k, 23) - 2.0f};
        jox_walls_add_polyline(&c->walls, (JoxV2[]){transform(f, from), transform(f, to)}, 2, false,
                               INFINITY);
    }
    jox_nav_set_walls(c->nav, &c->walls);
    add_crowd(c, side);
}

/* Returns a step in which all agents plan, at a time in seconds. */
static JoxStep make_step(Crowd *c, uint64_t seed, double time, JoxPool *pool) {
    JoxStep step = {.timing = jox_timing_at_once(0.05),
                    .agents = &c->agents,
                    .neighbours = &c->neighbours,
                    .pool = pool};
    step.timing.seed = seed;
    step.timing.time = time;
    return step;
}

static void plan_walks(Crowd *c, JoxPool *pool, bool walks) {
    jox_nav_sort(c->nav, &c->agents, 0);
    set_wishes(c);
    jox_nav_perceive(c->nav, &c->agents, &c->neighbours, pool);
    const JoxStep step = make_step(c, 3, 1.7, pool);
    if (walks)
        jox_nav_walk(c->nav, &step);
    jox_nav_solve(c->nav, &step);
}

/* Returns how many agents want another velocity in the frame than outside of it: rounding decides
   between directions of nearly equal worth. */
static uint32_t count_differing(Frame f, const JoxWalkLaw *law, float side) {
    Crowd plain, other;
    uint32_t differ = 0;
    make_walk_crowd(&plain, (Frame){0}, law, side);
    make_walk_crowd(&other, f, law, side);
    plan_walks(&plain, NULL, true);
    plan_walks(&other, NULL, true);
    for (uint32_t id = 0; id < PEOPLE; id++) {
        uint32_t i = jox_agents_find(&plain.agents, id), j = jox_agents_find(&other.agents, id);
        JoxV2 v = transform(f, (JoxV2){plain.agents.walk_x[i], plain.agents.walk_y[i]});
        JoxV2 u = {other.agents.walk_x[j], other.agents.walk_y[j]};
        differ += jox_length(jox_sub(u, v)) > 1e-3f;
    }
    free_walk_crowd(&plain);
    free_walk_crowd(&other);
    return differ;
}

static void turned_crowd_chooses_the_same(void **state) {
    (void)state;
    const JoxWalkLaw law = jox_walk_law();
    for (int k = 0; k < 3; k++)
        assert_true(count_differing((Frame){.angle = 37.0 / 180.0 * PI}, &law,
                                    6.0f + 6.0f * (float)k) <= PEOPLE / 50);
}

/* An agent that finds both sides equally good takes the left one in either frame; this is rare. */
static void mirrored_crowd_differs_only_in_passing_on_the_right(void **state) {
    (void)state;
    const uint32_t few = PEOPLE / 16;
    JoxWalkLaw law = jox_walk_law();
    law.right = 0.0;
    for (int k = 0; k < 3; k++)
        assert_true(count_differing((Frame){.mirrored = true}, &law, 12.0f + 6.0f * (float)k) <=
                    few);
    law.right = 0.5;
    assert_true(count_differing((Frame){.mirrored = true}, &law, 12.0f) > 2 * few);
}

/* The velocity that the law wants is finite, and exceeds the wanted speed by no more than what is
   left of the present velocity; eagerness stays within 0 and 1. */
static void expect_sane(const JoxAgents *a) {
    for (uint32_t i = 0; i < a->count; i++) {
        float most = jox_maxf(jox_length((JoxV2){a->pref_x[i], a->pref_y[i]}),
                              jox_length((JoxV2){a->vx[i], a->vy[i]}));
        assert_true(isfinite(a->walk_x[i]) && isfinite(a->walk_y[i]));
        assert_true(jox_length((JoxV2){a->walk_x[i], a->walk_y[i]}) <= 1.5f * most + 1e-3f);
        assert_true(isfinite(a->next_x[i]) && isfinite(a->next_y[i]));
        assert_true(a->eager[i] >= 0.0f && a->eager[i] <= 1.0f);
        float course = jox_length((JoxV2){a->course_x[i], a->course_y[i]});
        assert_true(course == 0.0f || fabsf(course - 1.0f) < 1e-4f);
    }
}

static void coincident_agents_stay_finite(void **state) {
    (void)state;
    const JoxWalkLaw law = jox_walk_law();
    const float sides[] = {0.0f, 1e-6f, 0.5f, 3.0f, 40.0f};
    for (int k = 0; k < 5; k++) {
        Crowd c;
        make_walk_crowd(&c, (Frame){0}, &law, sides[k]);
        for (int n = 0; n < 3; n++)
            plan_walks(&c, NULL, true);
        expect_sane(&c.agents);
        free_walk_crowd(&c);
    }
}

/* Agents without a time gap choose by ORCA, equal to the bit for any constants of the law. */
static void without_a_time_gap_orca_is_unchanged(void **state) {
    (void)state;
    JoxWalkLaw law = jox_walk_law();
    law.turn_cost = 0.0;
    law.close = 3.0;
    Crowd with, without;
    make_walk_crowd(&with, (Frame){0}, &law, 10.0f);
    make_walk_crowd(&without, (Frame){0}, &law, 10.0f);
    for (uint32_t i = 0; i < PEOPLE; i++) {
        jox_param_set(&with.agents, JOX_PARAM_time_gap, i, 0.0f);
        jox_param_set(&without.agents, JOX_PARAM_time_gap, i, 0.0f);
    }
    plan_walks(&with, NULL, true);
    plan_walks(&without, NULL, false);
    assert_memory_equal(with.agents.next_x, without.agents.next_x, PEOPLE * sizeof(float));
    assert_memory_equal(with.agents.next_y, without.agents.next_y, PEOPLE * sizeof(float));
    /* The same agents with a time gap choose otherwise. */
    for (uint32_t i = 0; i < PEOPLE; i++)
        jox_param_set(&with.agents, JOX_PARAM_time_gap, i, 1.0f);
    plan_walks(&with, NULL, true);
    assert_memory_not_equal(with.agents.next_x, without.agents.next_x, PEOPLE * sizeof(float));
    free_walk_crowd(&with);
    free_walk_crowd(&without);
}

/* Returns the hash of a world of agents that walk to and fro, after some seconds. */
static uint64_t hash_walking_world(int threads, double time_gap) {
    JoWorldDef def = jo_default_world_def();
    def.threads = threads;
    JoWorld *world = jo_world_create(&def, NULL);
    assert_true(jo_world_add_line(world, (double[]){0, 9, 12, 9}, 2, NULL));
    JoAgent people[3 * PEOPLE];
    for (uint32_t k = 0; k < 3 * PEOPLE; k++) {
        JoAgentDef person = jo_default_agent_def();
        person.x = 24.0 * (double)draw_walk(k, 30);
        person.y = 24.0 * (double)draw_walk(k, 31);
        person.time_gap = time_gap;
        person.haste = (double)draw_walk(k, 32);
        people[k] = jo_world_add_agent(world, &person, NULL);
        assert_true(people[k].generation > 0);
        jo_agent_set_preferred(world, people[k], k % 3 == 0 ? 1.2 : -0.9, k % 3 == 1 ? 0.8 : 0.0);
    }
    jo_world_step(world, 100);
    assert_null(jo_world_failure(world));
    uint64_t result = jo_world_hash(world);
    jo_world_free(world);
    return result;
}

static void walking_is_equal_on_any_number_of_threads(void **state) {
    (void)state;
    uint64_t one = hash_walking_world(1, 1.0);
    assert_true(hash_walking_world(2, 1.0) == one && hash_walking_world(4, 1.0) == one);
    assert_true(hash_walking_world(1, 0.0) != one);
}

/* Moves agents to new places, so that their order changes, and walks them with the draws of a seed
   and a time; `anew`: by a nav that has drawn nothing yet. */
static void walk_from(Crowd *c, uint32_t step, uint64_t seed, double time, bool anew) {
    for (uint32_t i = 0; i < c->agents.count; i++) {
        c->agents.x[i] = 8.0f * draw_walk(c->agents.id[i], 30 + step);
        c->agents.prev_x[i] = c->agents.x[i];
    }
    if (anew) {
        const JoxWalkLaw *law = c->nav->walk;
        jox_nav_free(c->nav);
        c->nav = jox_nav_create(law);
        jox_nav_set_walls(c->nav, &c->walls);
    }
    jox_nav_sort(c->nav, &c->agents, 0);
    set_wishes(c);
    jox_nav_perceive(c->nav, &c->agents, &c->neighbours, NULL);
    const JoxStep inputs = make_step(c, seed, time, NULL);
    jox_nav_walk(c->nav, &inputs);
}

static void time_gaps_depend_on_no_earlier_draw(void **state) {
    (void)state;
    const JoxWalkLaw law = jox_walk_law();
    const struct {
        uint64_t seed;
        double time;
    } steps[] = {{3, 1.7}, {3, 1.75}, {3, 1.8}, {3, 2.1}, {4, 2.1}, {3, 2.1}, {3, 1.7}};
    Crowd kept, anew;
    make_walk_crowd(&kept, (Frame){0}, &law, 8.0f);
    make_walk_crowd(&anew, (Frame){0}, &law, 8.0f);
    for (uint32_t k = 0; k < sizeof steps / sizeof *steps; k++) {
        walk_from(&kept, k, steps[k].seed, steps[k].time, false);
        walk_from(&anew, k, steps[k].seed, steps[k].time, true);
        const size_t size = PEOPLE * sizeof(float);
        assert_memory_equal(kept.agents.id, anew.agents.id, size);
        assert_memory_equal(kept.agents.walk_x, anew.agents.walk_x, size);
        assert_memory_equal(kept.agents.walk_y, anew.agents.walk_y, size);
    }
    free_walk_crowd(&kept);
    free_walk_crowd(&anew);
}

/* Returns the eagerness of the middle one of 49 calm agents, 0.45 m apart, all bound for one place,
   after a step in which it rises at once. Their ways turn by `turn` (1/m) towards the middle. */
static float measure_eagerness(double turn) {
    enum { ACROSS = 7, ALL = ACROSS * ACROSS };
    JoxWalkLaw law = jox_walk_law();
    law.eager_rise = 1e-3;
    Crowd c = {.nav = jox_nav_create(&law)};
    JoxAgents *a = &c.agents;
    for (uint32_t k = 0; k < ALL; k++) {
        const uint32_t i = jox_agents_add(a);
        a->x[i] = a->prev_x[i] = 0.45f * (float)(k / ACROSS);
        a->y[i] = a->prev_y[i] = 0.45f * ((float)(k % ACROSS) - 3.0f);
        a->bound[i] = 1;
        jox_param_set(a, JOX_PARAM_time_gap, i, 1.0f);
        jox_param_set(a, JOX_PARAM_haste, i, 0.0f);
    }
    jox_nav_sort(c.nav, a, 0);
    for (uint32_t i = 0; i < ALL; i++) {
        const double angle = -turn * (double)a->y[i];
        a->pref_x[i] = (float)jox_cos(angle);
        a->pref_y[i] = (float)jox_sin(angle);
        a->way_left[i] = 10.0f - a->x[i];
        a->contact_radius[i] = jox_param(a, JOX_PARAM_radius, i);
    }
    jox_nav_perceive(c.nav, a, &c.neighbours, NULL);
    const JoxStep step = make_step(&c, 3, 1.7, NULL);
    jox_nav_walk(c.nav, &step);
    const float eager = a->eager[jox_agents_find(a, ALL / 2)];
    free_walk_crowd(&c);
    return eager;
}

/* Six of the eight nearest neighbours stand to either side; the other two are straight ahead and
   behind. */
static void converging_ways_make_calm_people_keen(void **state) {
    (void)state;
    const float most = (float)jox_walk_law().eager_most, side_by_side = measure_eagerness(0.0);
    assert_true(fabsf(side_by_side - most) < 1e-4f);
    assert_true(fabsf(measure_eagerness(-0.5) - most) < 1e-4f);
    assert_true(measure_eagerness(0.5) > most + 0.05f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(converging_ways_make_calm_people_keen),
        cmocka_unit_test(turned_crowd_chooses_the_same),
        cmocka_unit_test(mirrored_crowd_differs_only_in_passing_on_the_right),
        cmocka_unit_test(coincident_agents_stay_finite),
        cmocka_unit_test(without_a_time_gap_orca_is_unchanged),
        cmocka_unit_test(time_gaps_depend_on_no_earlier_draw),
        cmocka_unit_test(walking_is_equal_on_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
