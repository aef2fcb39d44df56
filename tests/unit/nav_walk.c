/* The walking law: who minds whom, and how a few people walk by it. The constants are given where a
   figure depends on them; elsewhere what is claimed holds for any that make sense. */
#define JOX_ISA_scalar
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/number/bits.h"
#include "base/number/elementary.h"
#include "base/number/random.h"
#include "geom/polygon.h"
#include "nav/walk_lanes.h"
#include "world/world.h"

static const double TURN = 37.0 / 180.0 * 3.14159265358979323846;

/* ---- who minds whom ---- */

typedef enum Minds { MINDS_NOT, MINDS_AHEAD, MINDS_CROSSING } Minds;

/* How agent i minds the other. The second agent is at `offset` from the first. */
static Minds find_minds(const JoxAgents *a, uint32_t i, JoxV2 offset) {
    const uint32_t j = 1 - i;
    const float side = i == 0 ? 1.0f : -1.0f;
    const JoxFloats heading[4] = {a->aim_x[j], a->aim_y[j], a->way[j], jox_float_of(a->bound[j])};
    const JoxMindsLanes minds =
        jox_minds_lanes(a, i, (JoxInts)j, heading, (JoxVector){side * offset.x, side * offset.y});
    assert_false(minds.ahead && minds.crossing);
    return minds.ahead ? MINDS_AHEAD : minds.crossing ? MINDS_CROSSING : MINDS_NOT;
}

static void heads(JoxAgents *a, uint32_t i, double degrees) {
    double angle = degrees / 180.0 * 3.14159265358979323846;
    a->aim_x[i] = (float)jox_cos(angle);
    a->aim_y[i] = (float)jox_sin(angle);
}

static void set_up_pair(JoxAgents *a) {
    *a = (JoxAgents){0};
    for (int i = 0; i < 2; i++) {
        jox_agents_add(a);
        heads(a, (uint32_t)i, 0.0);
    }
}

static void of_those_bound_for_one_place_who_is_nearer_goes_first(void **state) {
    (void)state;
    JoxAgents a;
    set_up_pair(&a);
    const JoxV2 behind = {-1.0f, 0.2f}; /* what counts is the way, not who is ahead */
    a.bound[0] = a.bound[1] = 4;
    a.way[0] = 5.0f;
    a.way[1] = 4.0f;
    assert_int_equal(find_minds(&a, 0, behind), MINDS_AHEAD);
    assert_int_equal(find_minds(&a, 1, behind), MINDS_NOT);
    a.way[1] = 5.0f; /* a tie: the older goes first */
    assert_int_equal(find_minds(&a, 0, behind), MINDS_NOT);
    assert_int_equal(find_minds(&a, 1, behind), MINDS_AHEAD);
    heads(&a, 1, 180.0); /* round a corner they may head against each other */
    assert_int_equal(find_minds(&a, 0, behind), MINDS_NOT);
    assert_int_equal(find_minds(&a, 1, behind), MINDS_AHEAD);
    a.bound[1] = 3; /* elsewhere: then headings decide */
    assert_int_equal(find_minds(&a, 0, behind), MINDS_CROSSING);
    a.bound[0] = a.bound[1] = 0; /* nowhere is no common place */
    assert_int_equal(find_minds(&a, 1, behind), MINDS_CROSSING);
    jox_agents_free(&a);
}

static void headings_decide_for_the_others(void **state) {
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
        heads(&a, 1, cases[c].degrees);
        assert_int_equal(find_minds(&a, 0, ahead), cases[c].first);
        assert_int_equal(find_minds(&a, 1, ahead), cases[c].second);
    }
    /* Side by side on ways that part, each has the other ahead or beside: nobody follows both. */
    heads(&a, 1, 0.0);
    assert_int_equal(find_minds(&a, 0, (JoxV2){0.0f, 1.0f}), MINDS_NOT);
    assert_int_equal(find_minds(&a, 1, (JoxV2){0.0f, 1.0f}), MINDS_NOT);
    jox_agents_free(&a);
}

static void who_stands_is_passed(void **state) {
    (void)state;
    JoxAgents a;
    set_up_pair(&a);
    a.aim_x[1] = a.aim_y[1] = 0.0f;
    assert_int_equal(find_minds(&a, 0, (JoxV2){2.0f, 0.0f}), MINDS_CROSSING);
    assert_int_equal(find_minds(&a, 0, (JoxV2){-2.0f, 0.0f}), MINDS_CROSSING);
    a.bound[0] = a.bound[1] = 2; /* also of those bound for the same place */
    a.way[0] = 9.0f;
    a.way[1] = 3.0f;
    assert_int_equal(find_minds(&a, 0, (JoxV2){2.0f, 0.0f}), MINDS_CROSSING);
    jox_agents_free(&a);
}

/* Of two who mind each other as people who go the same way, exactly one follows: else they would
   wait for each other, or run into each other. */
static void of_two_bound_for_one_place_one_follows(void **state) {
    (void)state;
    JoxAgents a;
    set_up_pair(&a);
    a.bound[0] = a.bound[1] = 1;
    for (uint32_t k = 0; k < 1000; k++) {
        double u[5];
        for (uint32_t n = 0; n < 5; n++)
            u[n] = jox_random_unit(11, k, 0, JOX_DRAW_FILL, n);
        heads(&a, 0, 360.0 * u[0]);
        heads(&a, 1, 360.0 * u[1]);
        a.way[0] = (float)floor(4.0 * u[2]);
        a.way[1] = (float)floor(4.0 * u[3]);
        const JoxV2 offset = {(float)jox_cos(7.0 * u[4]), (float)jox_sin(7.0 * u[4])};
        assert_int_equal((find_minds(&a, 0, offset) == MINDS_AHEAD) +
                             (find_minds(&a, 1, offset) == MINDS_AHEAD),
                         1);
    }
    jox_agents_free(&a);
}

/* ---- a few people ---- */

enum { MOST = 64 };

typedef struct Crowd {
    JoWorld *world;
    JoAgent people[MOST];
    JoxV2 goals[MOST];
    double speeds[MOST];
    int count;
    double angle; /* by which all is turned */
} Crowd;

static JoxV2 turned(JoxV2 p, double angle) {
    double c = jox_cos(angle), s = jox_sin(angle);
    return (JoxV2){(float)(c * p.x - s * p.y), (float)(s * p.x + c * p.y)};
}

/* People who are all alike, whose time gaps do not wander, and who turn aside for nothing less than
   a way that is shut. */
static JoxWalkLaw alike(void) {
    JoxWalkLaw law = jox_walk_law();
    law.gap_spread = law.gap_noise = law.right = 0.0;
    law.turn_cost = 5.0;
    return law;
}

static Crowd begin(const JoxWalkLaw *law, double angle) {
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

/* Somebody who walks to a point, in the frame that is not turned; at speed 0 stands. */
static int add(Crowd *c, JoAgentDef def, JoxV2 at, JoxV2 goal, double speed) {
    JoxV2 p = turned(at, c->angle);
    def.x = (double)p.x;
    def.y = (double)p.y;
    c->people[c->count] = jo_world_add_agent(c->world, &def, NULL);
    c->goals[c->count] = goal;
    c->speeds[c->count] = speed;
    return c->count++;
}

static void add_wall(Crowd *c, JoxV2 from, JoxV2 to) {
    JoxV2 p = turned(from, c->angle), q = turned(to, c->angle);
    assert_true(jo_world_add_line(
        c->world, (const double[]){(double)p.x, (double)p.y, (double)q.x, (double)q.y}, 2, NULL));
}

static JoxV2 at(const Crowd *c, int n) {
    JoAgentState s = jo_agent_state(c->world, c->people[n]);
    return turned((JoxV2){(float)s.x, (float)s.y}, -c->angle);
}

static JoxV2 velocity(const Crowd *c, int n) {
    JoAgentState s = jo_agent_state(c->world, c->people[n]);
    return turned((JoxV2){(float)s.vx, (float)s.vy}, -c->angle);
}

static void step(Crowd *c) {
    for (int n = 0; n < c->count; n++) {
        JoxV2 way = turned(jox_unit(jox_sub(c->goals[n], at(c, n))), c->angle);
        jo_agent_set_preferred(c->world, c->people[n], (double)way.x * c->speeds[n],
                               (double)way.y * c->speeds[n]);
    }
    jo_world_step(c->world, 1);
    assert_null(jo_world_failure(c->world));
}

static void one_alone_walks_straight_at_its_speed(void **state) {
    (void)state;
    const double angles[] = {0.0, TURN};
    for (int k = 0; k < 2; k++) {
        const JoxWalkLaw law = jox_walk_law();
        Crowd c = begin(&law, angles[k]);
        add(&c, person(), (JoxV2){0, 0}, (JoxV2){100, 0}, 1.4);
        add_wall(&c, (JoxV2){-2, 2}, (JoxV2){60, 2}); /* far enough to be no hindrance */
        float before = 0.0f;
        for (int n = 0; n < 400; n++) {
            step(&c);
            float speed = jox_length(velocity(&c, 0));
            assert_true(fabsf(at(&c, 0).y) < 1e-3f);
            assert_true(speed > before - 1e-4f && speed < 1.4f + 1e-3f);
            before = speed;
        }
        assert_true(fabsf(before - 1.4f) < 0.02f);
        jo_world_free(c.world);
    }
}

/* Behind a slower one in a passage in which nobody gets past. Returns the distance of the two at
   the end, m. */
static float follow(const JoxWalkLaw *law, double gap, double haste, float slow, float least) {
    Crowd c = begin(law, 0.0);
    JoAgentDef def = person();
    def.time_gap = gap;
    def.haste = haste;
    int leader = add(&c, def, (JoxV2){5, 0}, (JoxV2){1000, 0}, (double)slow);
    int other = add(&c, def, (JoxV2){0, 0}, (JoxV2){1000, 0}, 1.6);
    add_wall(&c, (JoxV2){-3, 0.22f}, (JoxV2){200, 0.22f});
    add_wall(&c, (JoxV2){-3, -0.22f}, (JoxV2){200, -0.22f});
    for (int n = 0; n < 800; n++) {
        step(&c);
        assert_true(at(&c, leader).x - at(&c, other).x >= least);
    }
    assert_true(fabsf(velocity(&c, leader).x - slow) < 0.01f);
    assert_true(fabsf(velocity(&c, other).x - slow) < 0.02f);
    float apart = at(&c, leader).x - at(&c, other).x;
    jo_world_free(c.world);
    return apart;
}

/* The gap is counted from where the one ahead begins. */
static void who_follows_keeps_the_time_gap(void **state) {
    (void)state;
    JoxWalkLaw law = alike();
    law.gap_eager = law.room_eager = 0.0;
    const float slow[] = {0.4f, 0.8f, 1.2f};
    for (int k = 0; k < 3; k++)
        for (double gap = 0.6; gap < 1.5; gap += 0.4) {
            float length = (float)law.length * 0.4f, kept = (float)gap * slow[k];
            float apart = follow(&law, gap, 0.5, slow[k], length + 0.5f * kept);
            assert_true(fabsf(apart - length - kept) < 0.05f * kept + 0.02f);
        }
}

static void the_hasty_follow_more_closely(void **state) {
    (void)state;
    JoxWalkLaw law = alike();
    law.gap_eager = 0.6;
    law.eager_normal = 0.4;
    law.crowded = 20.0; /* only haste makes people eager here */
    float calm = follow(&law, 1.0, 0.0, 0.8f, 0.4f);
    float normal = follow(&law, 1.0, 0.5, 0.8f, 0.4f);
    float keen = follow(&law, 1.0, 1.0, 0.8f, 0.4f);
    assert_true(calm > normal + 0.1f && normal > keen + 0.1f);
    /* Those between stand between. */
    float hasty = follow(&law, 1.0, 0.75, 0.8f, 0.4f);
    assert_true(normal > hasty + 0.02f && hasty > keen + 0.02f);
}

/* Whatever the crowd, eagerness keeps to the bounds of haste. */
static void haste_bounds_eagerness(void **state) {
    (void)state;
    JoxWalkLaw law = alike();
    law.eager_normal = 0.2;
    law.eager_most = 0.5;
    law.crowded = 1.0;
    const struct {
        double haste;
        float alone, among;
    } cases[] = {{0.0, 0.0f, 0.5f}, {0.5, 0.2f, 0.5f}, {1.0, 1.0f, 1.0f}};
    for (int k = 0; k < 3; k++) {
        Crowd c = begin(&law, 0.0);
        JoAgentDef def = person();
        def.haste = cases[k].haste;
        add(&c, def, (JoxV2){-50, 0}, (JoxV2){1000, 0}, 1.2); /* alone */
        for (int n = 0; n < 25; n++)
            add(&c, def, (JoxV2){0.45f * (float)(n % 5), 0.45f * (float)(n / 5)}, (JoxV2){0, 0},
                0.0);
        for (int n = 0; n < 20 * 20; n++)
            step(&c);
        const JoxAgents *a = &c.world->state.agents;
        uint32_t lone = jox_world_find(c.world, c.people[0]);
        uint32_t middle = jox_world_find(c.world, c.people[13]);
        assert_true(fabsf(a->eager[lone] - cases[k].alone) < 0.02f);
        assert_true(fabsf(a->eager[middle] - cases[k].among) < 0.02f);
        jo_world_free(c.world);
    }
}

static void who_stands_in_the_way_is_walked_round(void **state) {
    (void)state;
    const double angles[] = {0.0, TURN};
    for (int k = 0; k < 2; k++)
        for (int aside = -3; aside <= 3; aside++) {
            const JoxWalkLaw law = jox_walk_law();
            Crowd c = begin(&law, angles[k]);
            int stands = add(&c, person(), (JoxV2){5, 0.1f * (float)aside}, (JoxV2){5, 0}, 0.0);
            int walks = add(&c, person(), (JoxV2){0, 0}, (JoxV2){20, 0}, 1.3);
            float least = INFINITY;
            for (int n = 0; n < 20 * 16; n++) {
                step(&c);
                least = jox_minf(least, jox_length(jox_sub(at(&c, walks), at(&c, stands))));
            }
            assert_true(at(&c, walks).x > 10.0f);
            assert_true(least > 0.36f); /* hardly touched */
            assert_true(fabsf(at(&c, stands).x - 5.0f) < 0.1f);
            jo_world_free(c.world);
        }
}

static void who_meet_pass_on_the_right(void **state) {
    (void)state;
    const double angles[] = {0.0, TURN};
    for (int k = 0; k < 2; k++) {
        const JoxWalkLaw law = jox_walk_law();
        Crowd c = begin(&law, angles[k]);
        int east = add(&c, person(), (JoxV2){-6, 0}, (JoxV2){20, 0}, 1.3);
        int west = add(&c, person(), (JoxV2){6, 0}, (JoxV2){-20, 0}, 1.3);
        while (at(&c, east).x < at(&c, west).x && jo_world_time(c.world) < 20.0)
            step(&c);
        assert_true(jo_world_time(c.world) < 20.0);
        assert_true(at(&c, east).y < -0.05f && at(&c, west).y > 0.05f);
        assert_true(jox_length(jox_sub(at(&c, east), at(&c, west))) > 0.38f);
        jo_world_free(c.world);
    }
}

/* A fork of walls with people who want to get to points behind it: nobody gets through a wall. */
static void nobody_is_steered_through_a_wall(void **state) {
    (void)state;
    const JoxWalkLaw law = jox_walk_law();
    const JoxV2 walls[][2] = {{{-4, -4}, {4, -4}}, {{4, -4}, {4, 4}},  {{4, 4}, {-4, 4}},
                              {{-4, 4}, {-4, -4}}, {{0, -4}, {0, -1}}, {{0, 0.2f}, {0, 4}},
                              {{-3, -1}, {-1, 1}}, {{1, 0}, {3, 0}}};
    const size_t wall_count = sizeof walls / sizeof *walls;
    Crowd c = begin(&law, TURN);
    for (size_t k = 0; k < wall_count; k++)
        add_wall(&c, walls[k][0], walls[k][1]);
    for (int n = 0; n < 48; n++) {
        JoxV2 from = {-3.6f + 0.5f * (float)(n % 6), -3.5f + 0.9f * (float)(n / 6)};
        JoxV2 to = {(n % 2 ? 5.0f : -5.0f), -4.0f + 8.0f * (float)(n * 7 % 48) / 48.0f};
        add(&c, person(), from, to, 0.5 + 0.04 * (double)n);
    }
    jo_world_step(c.world, 1); /* who was born in a wall is put beside it */
    JoxV2 before[MOST];
    for (int n = 0; n < c.count; n++)
        before[n] = at(&c, n);
    for (int t = 0; t < 400; t++) {
        step(&c);
        for (int n = 0; n < c.count; n++) {
            JoxV2 p = at(&c, n);
            for (size_t k = 0; k < wall_count; k++)
                assert_int_equal(jox_segment_crossing(walls[k][0], walls[k][1], before[n], p), 0);
            before[n] = p;
        }
    }
    jo_world_free(c.world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_those_bound_for_one_place_who_is_nearer_goes_first),
        cmocka_unit_test(headings_decide_for_the_others),
        cmocka_unit_test(who_stands_is_passed),
        cmocka_unit_test(of_two_bound_for_one_place_one_follows),
        cmocka_unit_test(one_alone_walks_straight_at_its_speed),
        cmocka_unit_test(who_follows_keeps_the_time_gap),
        cmocka_unit_test(the_hasty_follow_more_closely),
        cmocka_unit_test(haste_bounds_eagerness),
        cmocka_unit_test(who_stands_in_the_way_is_walked_round),
        cmocka_unit_test(who_meet_pass_on_the_right),
        cmocka_unit_test(nobody_is_steered_through_a_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
