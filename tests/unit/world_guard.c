/* Agents and bodies with numbers that are not finite or too large: the message names the first; it
   is removed or put back, and agents beside it continue. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "world/world.h"

static JoWorld *make(JoLost people, JoLost bodies) {
    JoWorldDef def = jo_default_world_def();
    def.lost_people = people;
    def.lost_bodies = bodies;
    JoWorld *world = jo_world_create(&def, NULL);
    assert_non_null(world);
    return world;
}

static JoAgent add(JoWorld *world, double x, double y) {
    JoAgentDef agent = jo_default_agent_def();
    agent.x = x;
    agent.y = y;
    JoAgent added = jo_world_add_agent(world, &agent, NULL);
    assert_true(jo_agent_is_live(world, added));
    return added;
}

/* Ten in a row, shoulder to shoulder. */
static void add_row(JoWorld *world, JoAgent row[10]) {
    for (int n = 0; n < 10; n++)
        row[n] = add(world, 0.4 * n, 0.0);
}

static const char *news(const JoWorld *world) {
    return world->scratch.messages.data ? world->scratch.messages.data : "";
}

static void nobody_passes_a_wall_at_any_speed(void **state) {
    (void)state;
    JoWorld *world = make(JO_LOST_END, JO_LOST_END);
    const double wall[] = {5, -2000, 5, 2000};
    JoAgent runner = add(world, 2.0, 0.0);
    assert_true(jo_world_add_line(world, wall, 2, NULL));
    jo_world_step(world, 1);
    for (int n = 0; n < 20; n++) {
        jo_agent_apply_force(world, runner, 1e6, 3e4 * n);
        jo_world_step(world, 1);
        const JoAgentState now = jo_agent_state(world, runner);
        if (!(now.x < 5.0))
            fail_msg("after %d steps at %g m with %g m/s", n, now.x, now.vx);
    }
    jo_world_free(world);
}

/* Number n of a row gets a number that is wrong, and the world does a step. */
static void spoil(JoWorld *world, JoAgent agent, float *column, float value) {
    const uint32_t i = jox_world_find_agent(world, agent);
    assert_int_not_equal(i, JOX_NO_INDEX);
    column[i] = value;
    jo_world_step(world, 1);
}

static void all_are_sound(const JoWorld *world) {
    const JoxAgents *a = &world->state.agents;
    for (uint32_t i = 0; i < a->count; i++)
        if (!(fabsf(a->x[i]) < 100.0f && fabsf(a->y[i]) < 100.0f && fabsf(a->vx[i]) < 10.0f &&
              fabsf(a->vy[i]) < 10.0f && fabsf(a->pref_x[i]) < 10.0f && isfinite(a->prev_x[i]) &&
              isfinite(a->force_x[i]) && isfinite(a->next_x[i]) && isfinite(a->eager[i])))
            fail_msg("agent %u at (%g, %g)", a->id[i], (double)a->x[i], (double)a->y[i]);
}

static void lost_agent_is_named_and_removed(void **state) {
    (void)state;
    const float wrong[] = {NAN, INFINITY, -INFINITY};
    for (int n = 0; n < 9; n++) {
        JoWorld *world = make(JO_LOST_REMOVE, JO_LOST_END);
        JoAgent row[10];
        char who[40];
        add_row(world, row);
        jo_world_step(world, 2);
        JoxAgents *a = &world->state.agents;
        snprintf(who, sizeof who, "step 2, t = 0.10 s: the ");
        spoil(world, row[n], n % 2 ? a->pref_x : a->pref_y, wrong[n % 3]);
        assert_null(jo_world_failure(world));
        assert_non_null(strstr(news(world), who));
        snprintf(who, sizeof who, "preferred velocity of agent %d is", n);
        assert_non_null(strstr(news(world), who));
        assert_non_null(strstr(news(world), "; forces, N: resistance ("));
        assert_non_null(strstr(news(world), "; removed\n"));
        assert_int_equal(world->state.statistics.people_lost, 1);
        assert_int_equal(jo_world_agent_count(world), 9);
        assert_false(jo_agent_is_live(world, row[n]));
        all_are_sound(world);
        jo_world_step(world, 50);
        assert_int_equal(jo_world_agent_count(world), 9);
        all_are_sound(world);
        jo_world_free(world);
    }
}

static void lost_agent_is_put_back_at_rest(void **state) {
    (void)state;
    JoWorld *world = make(JO_LOST_STOP, JO_LOST_END);
    JoAgent row[10], runner = add(world, 9999.0, 50.0);
    add_row(world, row);
    jo_world_step(world, 2);
    jo_agent_apply_force(world, runner, 1e6, 0.0);
    jo_world_step(world, 1);
    assert_non_null(strstr(news(world), "the position of agent 0 is more than 10 km from the "));
    assert_non_null(strstr(news(world), "; put back, at rest\n"));
    JoAgentState back = jo_agent_state(world, runner);
    assert_true(fabs(back.x - 9999.0) < 0.2 && back.vx == 0.0);
    spoil(world, row[4], world->state.agents.vy, NAN);
    back = jo_agent_state(world, row[4]);
    if (!(fabs(back.x - 1.6) < 0.2 && fabs(back.y) < 0.2 && back.vx == 0.0 && back.vy == 0.0))
        fail_msg("at (%g, %g) with (%g, %g): %s", back.x, back.y, back.vx, back.vy, news(world));
    assert_int_equal(world->state.statistics.people_lost, 2);
    jo_world_step(world, 50);
    assert_int_equal(world->state.statistics.people_lost, 2);
    assert_int_equal(jo_world_agent_count(world), 11);
    jo_world_free(world);
}

/* An agent without a finite previous position cannot be put back, and is removed. */
static void agent_without_previous_position_is_removed(void **state) {
    (void)state;
    JoWorld *world = make(JO_LOST_STOP, JO_LOST_END);
    JoAgent row[10];
    add_row(world, row);
    jo_world_step(world, 2);
    spoil(world, row[4], world->state.agents.x, NAN);
    assert_false(jo_agent_is_live(world, row[4]));
    assert_int_equal(jo_world_agent_count(world), 9);
    all_are_sound(world);
    jo_world_free(world);
}

static void set_torsos(JoWorld *world) {
    JoxAgents *a = &world->state.agents;
    for (uint32_t i = 0; i < a->count; i++) {
        jox_param_set(a, JOX_PARAM_breadth, i, 0.5f);
        jox_param_set(a, JOX_PARAM_depth, i, 0.4f);
    }
}

static void wrong_torso_is_named_and_spoils_no_other(void **state) {
    (void)state;
    const float wrong[] = {NAN, INFINITY, -INFINITY};
    for (int n = 0; n < 9; n++) {
        JoWorld *world = make(JO_LOST_STOP, JO_LOST_END);
        JoAgent row[10];
        char who[40];
        add_row(world, row);
        set_torsos(world);
        jo_world_step(world, 2);
        JoxAgents *a = &world->state.agents;
        float *const columns[] = {a->chest_x, a->chest_y, a->spin};
        spoil(world, row[n], columns[n / 3], n < 6 ? NAN : wrong[n % 3]); /* chests are checked */
        snprintf(who, sizeof who, "the chest of agent %d is not finite", n);
        if (!strstr(news(world), who))
            fail_msg("%s, not %s", news(world), who);
        assert_int_equal(world->state.statistics.people_lost, 1);
        for (uint32_t i = 0; i < a->count; i++)
            assert_true(jox_is_unit(jox_v2(a->chest_x[i], a->chest_y[i])) && isfinite(a->spin[i]));
        all_are_sound(world);
        jo_world_step(world, 50);
        assert_int_equal(world->state.statistics.people_lost, 1);
        all_are_sound(world);
        jo_world_free(world);
    }
}

static void divided_step_recovers_too(void **state) {
    (void)state;
    JoWorldDef def = jo_default_world_def();
    def.dt = 0.2; /* four substeps */
    def.lost_people = JO_LOST_REMOVE;
    JoWorld *world = jo_world_create(&def, NULL);
    JoAgent row[10];
    add_row(world, row);
    jo_world_step(world, 2);
    spoil(world, row[3], world->state.agents.pref_x, NAN);
    assert_int_equal(jo_world_agent_count(world), 9);
    all_are_sound(world);
    jo_world_step(world, 10);
    all_are_sound(world);
    jo_world_free(world);
}

/* ---- bodies ---- */

static JoBody throw_ball(JoWorld *world, double x, double z, double vx, double vz) {
    JoBodyDef def = jo_default_body_def();
    def.shape = JO_SPHERE;
    def.size[0] = 0.1;
    def.mass = 0.5;
    def.x = x;
    def.z = z;
    def.vx = vx;
    def.vz = vz;
    JoError error;
    JoBody ball = jo_world_add_body(world, &def, &error);
    if (ball.generation == 0)
        fail_msg("%s", error.text);
    return ball;
}

static void body_that_leaves_is_named(void **state) {
    (void)state;
    const JoLost ways[] = {JO_LOST_END, JO_LOST_REMOVE, JO_LOST_STOP};
    for (int n = 0; n < 3; n++) {
        JoWorld *world = make(JO_LOST_END, ways[n]);
        JoBody ball = throw_ball(world, 9990, 1, 400, 0);
        jo_world_step(world, 1);
        const char *said = n ? news(world) : jo_world_failure(world);
        assert_non_null(said);
        if (!strstr(said,
                    "step 0, t = 0.00 s: body 0 is more than 10 km from the origin, at (1000"))
            fail_msg("%s", said);
        assert_int_equal(jo_world_body_count(world), n == 2);
        assert_int_equal(world->state.statistics.bodies_lost, 1);
        if (n == 2)
            assert_true(jo_body_state(world, ball).x < 10000.0);
        jo_world_step(world, 5);
        assert_int_equal(jo_world_tick(world), n ? 6 : 1);
        jo_world_free(world);
    }
}

/* A pole is forced against a wall, harder and harder: over it, or not at all. */
static void no_body_passes_a_wall(void **state) {
    (void)state;
    const double wall[] = {5, -500, 5, 500};
    uint64_t lost = 0;
    for (int n = 0; n < 35; n++) {
        JoWorld *world = make(JO_LOST_END, JO_LOST_STOP);
        JoBodyDef def = jo_default_body_def();
        memcpy(def.size, (const double[3]){2.0, 0.02, 0.02}, sizeof def.size);
        def.mass = 5.0;
        def.x = 2.0;
        def.z = 1.2;
        def.turn = 0.1 * n;
        assert_true(jo_world_add_line(world, wall, 2, NULL));
        const JoBody pole = jo_world_add_body(world, &def, NULL);
        for (int k = 0; k < 40; k++) {
            jox_bodies_force(world->state.bodies, pole.slot,
                             (JoxV3){1e3f * powf(1.25f, (float)n), 0.0f, 0.0f});
            jo_world_step(world, 1);
            const JoBodyState now = jo_body_state(world, pole);
            if (now.z > 2.5)
                break; /* higher than the wall before long */
            if (!(now.x < 5.0))
                fail_msg("pushed by %g N", 1e3 * pow(1.25, n));
        }
        if (world->state.statistics.bodies_lost)
            assert_non_null(strstr(news(world), ": body 0 passed a wall, at ("));
        lost += world->state.statistics.bodies_lost;
        jo_world_free(world);
    }
    assert_true(lost > 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lost_agent_is_named_and_removed),
        cmocka_unit_test(lost_agent_is_put_back_at_rest),
        cmocka_unit_test(agent_without_previous_position_is_removed),
        cmocka_unit_test(wrong_torso_is_named_and_spoils_no_other),
        cmocka_unit_test(divided_step_recovers_too),
        cmocka_unit_test(body_that_leaves_is_named),
        cmocka_unit_test(no_body_passes_a_wall),
        cmocka_unit_test(nobody_passes_a_wall_at_any_speed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
