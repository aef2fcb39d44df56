/* The walking law: precedence, and how a few walkers behave. Constants are given where a figure
   depends on them; elsewhere the claims hold for any sensible constants. */
#define JOX_ISA_scalar
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "agents/stair_law.h"
#include "base/number/bits.h"
#include "base/number/elementary.h"
#include "base/number/random.h"
#include "geom/polygon.h"
#include "nav/walk/walk_lanes.h"
#include "world/world.h"

static const double TURN = 37.0 / 180.0 * 3.14159265358979323846;

/* ---- precedence ---- */

typedef enum Minds { MINDS_NOT, MINDS_AHEAD, MINDS_CROSSING } Minds;

/* Returns how agent i minds the other. The second agent is at `offset` from the first. */
static Minds find_minds(const JoxAgents *a, uint32_t i, JoxV2 offset) {
    const uint32_t j = 1 - i;
    const float side = i == 0 ? 1.0f : -1.0f;
    const JoxFloats heading[4] = {a->aim_x[j], a->aim_y[j], a->way_left[j],
                                  jox_float_of(a->bound[j])};
    const JoxMindsLanes minds =
        jox_minds_lanes(a, i, (JoxInts)j, heading, (JoxVector){side * offset.x, side * offset.y});
    assert_false(minds.ahead && minds.crossing);
    return minds.ahead ? MINDS_AHEAD : minds.crossing ? MINDS_CROSSING : MINDS_NOT;
}

static void set_heading(JoxAgents *a, uint32_t i, double degrees) {
    double angle = degrees / 180.0 * 3.14159265358979323846;
    a->aim_x[i] = (float)jox_cos(angle);
    a->aim_y[i] = (float)jox_sin(angle);
}

static void set_up_pair(JoxAgents *a) {
    *a = (JoxAgents){0};
    for (int i = 0; i < 2; i++) {
        jox_agents_add(a);
        set_heading(a, (uint32_t)i, 0.0);
    }
}

static void nearer_to_shared_goal_goes_first(void **state) {
    (void)state;
    JoxAgents a;
    set_up_pair(&a);
    const JoxV2 behind = {-1.0f, 0.2f}; /* the way left counts, not the position */
    a.bound[0] = a.bound[1] = 4;
    a.way_left[0] = 5.0f;
    a.way_left[1] = 4.0f;
    assert_int_equal(find_minds(&a, 0, behind), MINDS_AHEAD);
    assert_int_equal(find_minds(&a, 1, behind), MINDS_NOT);
    a.way_left[1] = 5.0f; /* a tie: the older goes first */
    assert_int_equal(find_minds(&a, 0, behind), MINDS_NOT);
    assert_int_equal(find_minds(&a, 1, behind), MINDS_AHEAD);
    set_heading(&a, 1, 180.0); /* around a corner, their headings may be opposite */
    assert_int_equal(find_minds(&a, 0, behind), MINDS_NOT);
    assert_int_equal(find_minds(&a, 1, behind), MINDS_AHEAD);
    a.bound[1] = 3; /* different places: headings decide */
    assert_int_equal(find_minds(&a, 0, behind), MINDS_CROSSING);
    a.bound[0] = a.bound[1] = 0; /* 0 is no place, so not a common one */
    assert_int_equal(find_minds(&a, 1, behind), MINDS_CROSSING);
    jox_agents_free(&a);
}

static void headings_decide_without_a_shared_goal(void **state) {
    (void)state;
    JoxAgents a;
    set_up_pair(&a);
    const JoxV2 ahead = {1.0f, 0.3f};
    const struct {
        double degrees;
        Minds first, second;
    } cases[] = {{0, MINDS_AHEAD, MINDS_NOT},          {55, MINDS_AHEAD, MINDS_NOT},
                 {-55, MINDS_AHEAD, MINDS_NOT},        {65, MINDS_CROSSING, MINDS_CROSSING},
                 {90, MINDS_CROSSING, MINDS_CROSSING}, {180, MINDS_CROSSING, MINDS_CROSSING}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        set_heading(&a, 1, cases[c].degrees);
        assert_int_equal(find_minds(&a, 0, ahead), cases[c].first);
        assert_int_equal(find_minds(&a, 1, ahead), cases[c].second);
    }
    /* Side by side on diverging ways, each has the other ahead or beside: neither follows. */
    set_heading(&a, 1, 0.0);
    assert_int_equal(find_minds(&a, 0, (JoxV2){0.0f, 1.0f}), MINDS_NOT);
    assert_int_equal(find_minds(&a, 1, (JoxV2){0.0f, 1.0f}), MINDS_NOT);
    jox_agents_free(&a);
}

static void standing_agent_is_passed(void **state) {
    (void)state;
    JoxAgents a;
    set_up_pair(&a);
    a.aim_x[1] = a.aim_y[1] = 0.0f;
    assert_int_equal(find_minds(&a, 0, (JoxV2){2.0f, 0.0f}), MINDS_CROSSING);
    assert_int_equal(find_minds(&a, 0, (JoxV2){-2.0f, 0.0f}), MINDS_CROSSING);
    a.bound[0] = a.bound[1] = 2; /* also for agents bound for the same place */
    a.way_left[0] = 9.0f;
    a.way_left[1] = 3.0f;
    assert_int_equal(find_minds(&a, 0, (JoxV2){2.0f, 0.0f}), MINDS_CROSSING);
    jox_agents_free(&a);
}

/* Where both agents mind each other as going the same way, exactly one follows: else they would
   wait for each other, or collide. */
static void exactly_one_of_two_follows(void **state) {
    (void)state;
    JoxAgents a;
    set_up_pair(&a);
    a.bound[0] = a.bound[1] = 1;
    for (uint32_t k = 0; k < 1000; k++) {
        double u[5];
        for (uint32_t n = 0; n < 5; n++)
            u[n] = jox_random_unit(11, k, 0, JOX_DRAW_FILL, n);
        set_heading(&a, 0, 360.0 * u[0]);
        set_heading(&a, 1, 360.0 * u[1]);
        a.way_left[0] = (float)floor(4.0 * u[2]);
        a.way_left[1] = (float)floor(4.0 * u[3]);
        const JoxV2 offset = {(float)jox_cos(7.0 * u[4]), (float)jox_sin(7.0 * u[4])};
        assert_int_equal((find_minds(&a, 0, offset) == MINDS_AHEAD) +
                             (find_minds(&a, 1, offset) == MINDS_AHEAD),
                         1);
    }
    jox_agents_free(&a);
}

/* ---- a few walkers ---- */

enum { MOST = 64 };

typedef struct Crowd {
    JoWorld *world;
    JoAgent people[MOST];
    JoxV2 goals[MOST];
    double speeds[MOST];
    int count;
    double angle; /* rotation of the whole scene */
} Crowd;

static JoxV2 rotate_point(JoxV2 p, double angle) {
    double c = jox_cos(angle), s = jox_sin(angle);
    return (JoxV2){(float)(c * p.x - s * p.y), (float)(s * p.x + c * p.y)};
}

/* Returns a law under which agents do not differ, their time gaps do not wander, and they turn
   aside only where the way is shut. */
static JoxWalkLaw make_uniform_law(void) {
    JoxWalkLaw law = jox_walk_law();
    law.gap_spread = law.gap_noise = law.right = 0.0;
    law.turn_cost = 5.0;
    return law;
}

static Crowd open_walk_crowd(const JoxWalkLaw *law, double angle) {
    JoWorldDef def = jo_default_world_def();
    def.dt = 0.05;
    Crowd c = {.world = jo_world_create(&def, NULL), .angle = angle};
    jox_world_set_walking(c.world, law);
    return c;
}

static JoAgentDef person(void) {
    JoAgentDef def = jo_default_agent_def();
    def.time_gap = 1.0;
    def.max_speed = 3.0;
    return def;
}

/* Adds an agent that walks to a point, in the frame before the rotation; at speed 0 it stands. */
static int add_walker(Crowd *c, JoAgentDef def, JoxV2 at, JoxV2 goal, double speed) {
    JoxV2 p = rotate_point(at, c->angle);
    def.x = (double)p.x;
    def.y = (double)p.y;
    c->people[c->count] = jo_world_add_agent(c->world, &def, NULL);
    c->goals[c->count] = goal;
    c->speeds[c->count] = speed;
    return c->count++;
}

static void add_walk_wall(Crowd *c, JoxV2 from, JoxV2 to) {
    JoxV2 p = rotate_point(from, c->angle), q = rotate_point(to, c->angle);
    assert_true(jo_world_add_line(
        c->world, (const double[]){(double)p.x, (double)p.y, (double)q.x, (double)q.y}, 2, NULL));
}

static JoxV2 read_position(const Crowd *c, int n) {
    JoAgentState s = jo_agent_state(c->world, c->people[n]);
    return rotate_point((JoxV2){(float)s.x, (float)s.y}, -c->angle);
}

static JoxV2 velocity(const Crowd *c, int n) {
    JoAgentState s = jo_agent_state(c->world, c->people[n]);
    return rotate_point((JoxV2){(float)s.vx, (float)s.vy}, -c->angle);
}

static void run_walk_step(Crowd *c) {
    for (int n = 0; n < c->count; n++) {
        JoxV2 way = rotate_point(jox_unit(jox_sub(c->goals[n], read_position(c, n))), c->angle);
        jo_agent_set_preferred(c->world, c->people[n], (double)way.x * c->speeds[n],
                               (double)way.y * c->speeds[n]);
    }
    jo_world_step(c->world, 1);
    assert_null(jo_world_failure(c->world));
}

static void lone_walker_goes_straight_at_its_speed(void **state) {
    (void)state;
    const double angles[] = {0.0, TURN};
    for (int k = 0; k < 2; k++) {
        const JoxWalkLaw law = jox_walk_law();
        Crowd c = open_walk_crowd(&law, angles[k]);
        add_walker(&c, person(), (JoxV2){0, 0}, (JoxV2){100, 0}, 1.4);
        add_walk_wall(&c, (JoxV2){-2, 2}, (JoxV2){60, 2}); /* far enough not to matter */
        float before = 0.0f;
        for (int n = 0; n < 400; n++) {
            run_walk_step(&c);
            float speed = jox_length(velocity(&c, 0));
            assert_true(fabsf(read_position(&c, 0).y) < 1e-3f);
            assert_true(speed > before - 1e-4f && speed < 1.4f + 1e-3f);
            before = speed;
        }
        assert_true(fabsf(before - 1.4f) < 0.02f);
        jo_world_free(c.world);
    }
}

/* Walks behind a slower agent in a passage too narrow to overtake. Returns the final distance of
   the two, m. */
static float measure_following(const JoxWalkLaw *law, double gap, double haste, float slow,
                               float least) {
    Crowd c = open_walk_crowd(law, 0.0);
    JoAgentDef def = person();
    def.time_gap = gap;
    def.haste = haste;
    int leader = add_walker(&c, def, (JoxV2){5, 0}, (JoxV2){1000, 0}, (double)slow);
    int other = add_walker(&c, def, (JoxV2){0, 0}, (JoxV2){1000, 0}, 1.6);
    add_walk_wall(&c, (JoxV2){-3, 0.22f}, (JoxV2){200, 0.22f});
    add_walk_wall(&c, (JoxV2){-3, -0.22f}, (JoxV2){200, -0.22f});
    for (int n = 0; n < 800; n++) {
        run_walk_step(&c);
        assert_true(read_position(&c, leader).x - read_position(&c, other).x >= least);
    }
    assert_true(fabsf(velocity(&c, leader).x - slow) < 0.01f);
    assert_true(fabsf(velocity(&c, other).x - slow) < 0.02f);
    float apart = read_position(&c, leader).x - read_position(&c, other).x;
    jo_world_free(c.world);
    return apart;
}

/* The gap is measured from where the agent ahead begins. */
static void follower_keeps_the_time_gap(void **state) {
    (void)state;
    JoxWalkLaw law = make_uniform_law();
    law.gap_eager = law.room_eager = 0.0;
    const float slow[] = {0.4f, 0.8f, 1.2f};
    for (int k = 0; k < 3; k++)
        for (double gap = 0.6; gap < 1.5; gap += 0.4) {
            float length = (float)law.length * 0.4f, kept = (float)gap * slow[k];
            float apart = measure_following(&law, gap, 0.5, slow[k], length + 0.5f * kept);
            assert_true(fabsf(apart - length - kept) < 0.05f * kept + 0.02f);
        }
}

static void haste_shortens_the_time_gap(void **state) {
    (void)state;
    JoxWalkLaw law = make_uniform_law();
    law.gap_eager = 0.6;
    law.eager_normal = 0.4;
    law.crowded = 20.0; /* only haste makes agents eager here */
    float calm = measure_following(&law, 1.0, 0.0, 0.8f, 0.4f);
    float normal = measure_following(&law, 1.0, 0.5, 0.8f, 0.4f);
    float keen = measure_following(&law, 1.0, 1.0, 0.8f, 0.4f);
    assert_true(calm > normal + 0.1f && normal > keen + 0.1f);
    /* Values of haste in between give gaps in between. */
    float hasty = measure_following(&law, 1.0, 0.75, 0.8f, 0.4f);
    assert_true(normal > hasty + 0.02f && hasty > keen + 0.02f);
}

/* In any crowd, eagerness stays within the bounds of haste. */
static void haste_bounds_eagerness(void **state) {
    (void)state;
    JoxWalkLaw law = make_uniform_law();
    law.eager_normal = 0.2;
    law.eager_most = 0.5;
    law.crowded = 1.0;
    const struct {
        double haste;
        float alone, among;
    } cases[] = {{0.0, 0.0f, 0.5f}, {0.5, 0.2f, 0.5f}, {1.0, 1.0f, 1.0f}};
    for (int k = 0; k < 3; k++) {
        Crowd c = open_walk_crowd(&law, 0.0);
        JoAgentDef def = person();
        def.haste = cases[k].haste;
        add_walker(&c, def, (JoxV2){-50, 0}, (JoxV2){1000, 0}, 1.2); /* no agent near */
        for (int n = 0; n < 25; n++)
            add_walker(&c, def, (JoxV2){0.45f * (float)(n % 5), 0.45f * (float)(n / 5)},
                       (JoxV2){0, 0}, 0.0);
        for (int n = 0; n < 20 * 20; n++)
            run_walk_step(&c);
        const JoxAgents *a = &c.world->state.agents;
        uint32_t lone = jox_world_find_agent(c.world, c.people[0]);
        uint32_t middle = jox_world_find_agent(c.world, c.people[13]);
        assert_true(fabsf(a->eager[lone] - cases[k].alone) < 0.02f);
        assert_true(fabsf(a->eager[middle] - cases[k].among) < 0.02f);
        jo_world_free(c.world);
    }
}

static void standing_agent_in_the_way_is_walked_around(void **state) {
    (void)state;
    const double angles[] = {0.0, TURN};
    for (int k = 0; k < 2; k++)
        for (int aside = -3; aside <= 3; aside++) {
            const JoxWalkLaw law = jox_walk_law();
            Crowd c = open_walk_crowd(&law, angles[k]);
            int stands =
                add_walker(&c, person(), (JoxV2){5, 0.1f * (float)aside}, (JoxV2){5, 0}, 0.0);
            int walks = add_walker(&c, person(), (JoxV2){0, 0}, (JoxV2){20, 0}, 1.3);
            float least = INFINITY;
            for (int n = 0; n < 20 * 16; n++) {
                run_walk_step(&c);
                least = jox_minf(least, jox_length(jox_sub(read_position(&c, walks),
                                                           read_position(&c, stands))));
            }
            assert_true(read_position(&c, walks).x > 10.0f);
            assert_true(least > 0.36f); /* hardly touched */
            assert_true(fabsf(read_position(&c, stands).x - 5.0f) < 0.1f);
            jo_world_free(c.world);
        }
}

static void agents_that_meet_pass_on_the_right(void **state) {
    (void)state;
    const double angles[] = {0.0, TURN};
    for (int k = 0; k < 2; k++) {
        const JoxWalkLaw law = jox_walk_law();
        Crowd c = open_walk_crowd(&law, angles[k]);
        int east = add_walker(&c, person(), (JoxV2){-6, 0}, (JoxV2){20, 0}, 1.3);
        int west = add_walker(&c, person(), (JoxV2){6, 0}, (JoxV2){-20, 0}, 1.3);
        while (read_position(&c, east).x < read_position(&c, west).x &&
               jo_world_time(c.world) < 20.0)
            run_walk_step(&c);
        assert_true(jo_world_time(c.world) < 20.0);
        assert_true(read_position(&c, east).y < -0.05f && read_position(&c, west).y > 0.05f);
        assert_true(jox_length(jox_sub(read_position(&c, east), read_position(&c, west))) > 0.38f);
        jo_world_free(c.world);
    }
}

/* A fork of walls, with agents whose goals are behind it: none gets through a wall. */
static void no_walker_is_steered_through_a_wall(void **state) {
    (void)state;
    const JoxWalkLaw law = jox_walk_law();
    const JoxV2 walls[][2] = {{{-4, -4}, {4, -4}}, {{4, -4}, {4, 4}},  {{4, 4}, {-4, 4}},
                              {{-4, 4}, {-4, -4}}, {{0, -4}, {0, -1}}, {{0, 0.2f}, {0, 4}},
                              {{-3, -1}, {-1, 1}}, {{1, 0}, {3, 0}}};
    const size_t wall_count = sizeof walls / sizeof *walls;
    Crowd c = open_walk_crowd(&law, TURN);
    for (size_t k = 0; k < wall_count; k++)
        add_walk_wall(&c, walls[k][0], walls[k][1]);
    for (int n = 0; n < 48; n++) {
        JoxV2 from = {-3.6f + 0.5f * (float)(n % 6), -3.5f + 0.9f * (float)(n / 6)};
        JoxV2 to = {(n % 2 ? 5.0f : -5.0f), -4.0f + 8.0f * (float)(n * 7 % 48) / 48.0f};
        add_walker(&c, person(), from, to, 0.5 + 0.04 * (double)n);
    }
    jo_world_step(c.world, 1); /* an agent born in a wall is put beside it */
    JoxV2 before[MOST];
    for (int n = 0; n < c.count; n++)
        before[n] = read_position(&c, n);
    for (int t = 0; t < 400; t++) {
        run_walk_step(&c);
        for (int n = 0; n < c.count; n++) {
            JoxV2 p = read_position(&c, n);
            for (size_t k = 0; k < wall_count; k++)
                assert_int_equal(jox_segment_crossing(walls[k][0], walls[k][1], before[n], p), 0);
            before[n] = p;
        }
    }
    jo_world_free(c.world);
}

/* ---- stairs ---- */

/* Mean horizontal speeds of all people on two stairs, and level, in feet per minute (Fruin 1971,
   Table 3-B), and Weidmann's, m/s; a stair of 30 degrees lies between both surveys. */
static void speeds_on_stairs_lie_between_the_sources(void **state) {
    (void)state;
    const float level = 265.0f, slope = JOX_STAIR_SLOPE;
    const struct {
        float sign, gentle, steep, weidmann;
    } ways[] = {{1.0f, 113.0f, 100.0f, 0.610f}, {-1.0f, 152.0f, 132.0f, 0.694f}};
    for (int k = 0; k < 2; k++) {
        const float between = (slope - 0.5f) / (7.0f / 11.25f - 0.5f);
        const float fruin = (ways[k].gentle + (ways[k].steep - ways[k].gentle) * between) / level;
        const float both = 0.5f * (fruin + ways[k].weidmann / 1.34f);
        assert_float_equal(jox_slope_speed(ways[k].sign * slope), both, 0.005f);
        const float change =
            jox_slope_speed(ways[k].sign * 7.0f / 11.25f) - jox_slope_speed(ways[k].sign * 0.5f);
        assert_float_equal(change, (ways[k].steep - ways[k].gentle) / level, 0.005f);
        assert_float_equal(
            jox_stair_slowness(slope, k == 0) * jox_slope_speed(ways[k].sign * slope), 1.0f, 1e-5f);
    }
    assert_float_equal(jox_slope_speed(0.1f), 1.0f - 0.115f, 1e-6f); /* grades: Fruin, chapter 3 */
    assert_float_equal(jox_slope_speed(0.2f), 0.75f, 1e-6f);
}

static void steeper_floors_are_slower(void **state) {
    (void)state;
    const JoxWalkLaw law = jox_walk_law();
    for (int sign = -1; sign <= 1; sign += 2)
        for (int k = 0; k < 150; k++) {
            const float slope = (float)sign * 0.01f * (float)k, next = slope + 0.01f * (float)sign;
            assert_true(jox_slope_speed(next) <= jox_slope_speed(slope));
            assert_true(jox_slope_gap(&law, next) >= jox_slope_gap(&law, slope));
            assert_true(jox_slope_speed(next) > 0.2f);
        }
    assert_float_equal(jox_slope_gap(&law, 0.0f), 1.0f, 0.0f);
    assert_float_equal(jox_slope_gap(&law, JOX_STAIR_SLOPE), (float)law.stair_gap_up, 1e-5f);
    assert_float_equal(jox_slope_gap(&law, -JOX_STAIR_SLOPE), (float)law.stair_gap_down, 1e-5f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(speeds_on_stairs_lie_between_the_sources),
        cmocka_unit_test(steeper_floors_are_slower),
        cmocka_unit_test(nearer_to_shared_goal_goes_first),
        cmocka_unit_test(headings_decide_without_a_shared_goal),
        cmocka_unit_test(standing_agent_is_passed),
        cmocka_unit_test(exactly_one_of_two_follows),
        cmocka_unit_test(lone_walker_goes_straight_at_its_speed),
        cmocka_unit_test(follower_keeps_the_time_gap),
        cmocka_unit_test(haste_shortens_the_time_gap),
        cmocka_unit_test(haste_bounds_eagerness),
        cmocka_unit_test(standing_agent_in_the_way_is_walked_around),
        cmocka_unit_test(agents_that_meet_pass_on_the_right),
        cmocka_unit_test(no_walker_is_steered_through_a_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
