/* Whole worlds through the public interface: memory, size, momentum, birth in impossible spots. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "jostle_tools.h"
#include "unit/effort.h"

static void quiet(void *context, const char *text) {
    (void)context;
    (void)text;
}

static JoScene *load(const char *path, const char *const *sets, size_t count, uint32_t threads) {
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    def.path = path;
    def.overrides = sets;
    def.override_count = count;
    def.threads = threads;
    def.message = quiet;
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene)
        fail_msg("%s: %s", path, error.text);
    return scene;
}

static void a_steady_step_allocates_nothing(void **state) {
    (void)state;
    const char *const tawaf[] = {EFFORT_EACH > 1 ? "groups.pilgrims.count=600"
                                                 : "groups.pilgrims.count=3000",
                                 "sources.0.keep=1"};
    const struct {
        const char *path;
        size_t sets;
    } scenes[] = {
        {"scenes/tawaf.yaml", 2}, {"scenes/running-through.yaml", 0}, {"scenes/dodgeball.yaml", 0}};
    for (int s = 0; s < 3; s++) {
        JoScene *scene = load(scenes[s].path, tawaf, scenes[s].sets, 2);
        jo_world_step(jo_scene_world(scene), 900); /* until the peaks have been seen */
        uint64_t before = jox_alloc_count();
        jo_world_step(jo_scene_world(scene), 50);
        assert_int_equal(jox_alloc_count() - before, 0);
        jo_scene_free(scene);
    }
}

static void large_world_runs(void **state) {
    (void)state;
    enum { PEOPLE = 200000 / EFFORT_EACH };
    JoWorldDef def = jo_default_world_def();
    def.threads = 2;
    JoWorld *world = jo_world_create(&def, NULL);
    for (int i = 0; i < PEOPLE; i++) {
        JoAgentDef agent = jo_default_agent_def();
        agent.x = i % 500 * 0.6;
        agent.y = i / 500 * 0.6;
        JoAgent handle = jo_world_add_agent(world, &agent, NULL);
        jo_agent_set_preferred(world, handle, 1.0, 0.3);
    }
    jo_world_step(world, 3);
    assert_int_equal(jo_world_agent_count(world), PEOPLE);
    JoAgent first;
    assert_int_equal(jo_world_agents(world, &first, 1), 1);
    JoAgentState s = jo_agent_state(world, first);
    assert_true(s.id == 0 && isfinite(s.x) && s.vx * s.vx + s.vy * s.vy < 4.0);
    jo_world_free(world);
}

/* The push of one person's run into a row goes on to the next; nobody's momentum comes from
   nowhere: what the crowd gains is what the external force gave, less what the feet took. */
static void momentum_never_exceeds_what_was_given(void **state) {
    (void)state;
    JoWorldDef def = jo_default_world_def();
    def.dt = 0.02;
    JoWorld *world = jo_world_create(&def, NULL);
    JoAgent row[5];
    for (int i = 0; i < 5; i++) {
        JoAgentDef agent = jo_default_agent_def();
        agent.x = i * 0.41;
        agent.speed = 0;
        row[i] = jo_world_add_agent(world, &agent, NULL);
    }
    double given = 0.0, most = 0.0;
    for (int step = 0; step < 100; step++) {
        if (step < 25) {
            jo_agent_apply_force(world, row[0], 300, 0);
            given += 300 * def.dt;
        }
        jo_world_step(world, 1);
        double momentum = 0.0;
        for (int i = 0; i < 5; i++)
            momentum += 70 * jo_agent_state(world, row[i]).vx;
        assert_true(momentum <= given * 1.05 + 1.0);
        most = momentum > most ? momentum : most;
    }
    assert_true(most > 0.2 * given);                            /* something was passed on */
    assert_true(jo_agent_state(world, row[2]).x > 0.82 + 0.05); /* beyond whom the first touched */
    assert_true(jo_agent_state(world, row[3]).x > 1.23 + 0.05);
    jo_world_free(world);
}

static void births_in_a_solid_are_refused_and_others_keep_apart(void **state) {
    (void)state;
    JoWorldDef def = jo_default_world_def();
    JoWorld *world = jo_world_create(&def, NULL);
    const double block[] = {-2, -2, 2, -2, 2, 2, -2, 2};
    assert_true(jo_world_add_solid(world, block, 4, NULL));
    JoAgent agents[40];
    for (int i = 0; i < 40; i++) {
        JoAgentDef agent = jo_default_agent_def();
        agent.x = i % 2 ? 0.0 : 5.0; /* all in two points, one of them inside the block */
        JoError error = {0};
        agents[i] = jo_world_add_agent(world, &agent, &error);
        assert_int_equal(jo_agent_is_live(world, agents[i]), i % 2 == 0);
        if (i % 2)
            assert_string_equal(error.text, "the agent is not added: (0, 0) lies in a wall");
    }
    assert_int_equal(jo_world_stats(world).not_placed, 20);
    assert_int_equal(jo_world_stats(world).shifted_at_birth, 19);
    jo_world_step(world, 40);
    assert_int_equal(jo_world_agent_count(world), 20);
    for (int i = 0; i < 40; i += 2) {
        JoAgentState a = jo_agent_state(world, agents[i]);
        assert_true(isfinite(a.x) && isfinite(a.y));
        assert_false(fabs(a.x) < 2.0 && fabs(a.y) < 2.0);
        for (int k = 0; k < i; k += 2) {
            JoAgentState b = jo_agent_state(world, agents[k]);
            assert_true(hypot(a.x - b.x, a.y - b.y) > 0.2);
        }
    }
    jo_world_free(world);
}

static void a_stray_agent_far_away_does_no_harm(void **state) {
    (void)state;
    JoWorldDef def = jo_default_world_def();
    JoWorld *world = jo_world_create(&def, NULL);
    for (int i = 0; i < 3; i++) {
        JoAgentDef agent = jo_default_agent_def();
        agent.x = i == 2 ? 9999 : i * 3;
        agent.y = i == 2 ? -9999 : 0;
        JoAgent handle = jo_world_add_agent(world, &agent, NULL);
        jo_agent_set_preferred(world, handle, i ? -1.0 : 1.0, 0);
    }
    jo_world_step(world, 200);
    JoAgent all[3];
    jo_world_agents(world, all, 3);
    assert_true(jo_agent_state(world, all[0]).x > 3.0 && jo_agent_state(world, all[1]).x < 0.0);
    jo_world_free(world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_steady_step_allocates_nothing),
        cmocka_unit_test(large_world_runs),
        cmocka_unit_test(momentum_never_exceeds_what_was_given),
        cmocka_unit_test(births_in_a_solid_are_refused_and_others_keep_apart),
        cmocka_unit_test(a_stray_agent_far_away_does_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
