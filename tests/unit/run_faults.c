/* Tests of faults that a run must survive or report: numbers that are not finite, agents without a
 * machine, lost changes of memory, and many sources. */
#include <math.h>

#include "jostle_tools.h"
#include "unit/scene_loader.h"

/* ---- numbers that are not finite ---- */

#define CROWD                                                                                      \
    YARD_SCENE("groups:\n"                                                                         \
               "  people: {behaviour: " JOX_DATADIR                                                \
               "/behaviours/stander.lua, count: 100, fill: grid, "                                 \
               "in: yard}\n"                                                                       \
               "  odd: {behaviour: own.lua, at: [[20, 20], [20.1, 20.1]], team: a}\n")

static bool has_finite_agents(const JoScene *scene) {
    const JoxAgents *a = &scene->world->state.agents;
    for (uint32_t i = 0; i < a->count; i++)
        if (!isfinite(a->x[i]) || !isfinite(a->y[i]) || !isfinite(a->vx[i]) ||
            !isfinite(a->vy[i]) || !isfinite(a->pref_x[i]) || !isfinite(a->pref_y[i]))
            return false;
    return true;
}

/* Returns whether a scene loads whose behaviour has this steering; else `refusal` has the first
 * error. */
static bool load_steering(const char *steer) {
    char sheet[600];
    snprintf(sheet, sizeof sheet, MACHINE_START "\"A\", states = { A = { steer = %s } } }\n",
             steer);
    write_test_file("own.lua", sheet);
    const JoSceneDef def = define_scene(write_test_file("scene.yaml", CROWD));
    JoError error = {0};
    JoScene *scene = jo_scene_load(&def, &error);
    snprintf(refusal, sizeof refusal, "%.250s", error.text);
    jo_scene_free(scene);
    return scene != NULL;
}

static void steering_numbers_out_of_range_are_refused(void **state) {
    (void)state;
    const char *const wrong[] = {"together(-5)",
                                 "together(1e39)",
                                 "drift(1e39, 0)",
                                 "drift(0, -101)",
                                 "follow(nearest \"anyone\", 1e39)",
                                 "follow(nearest \"anyone\", -1)",
                                 "orbit(\"yard\", { far = 0 })",
                                 "orbit(\"yard\", { inward = 1e5 })",
                                 "1e7 * drift(1, 0)",
                                 "(0 / 0) * drift(1, 0)"};
    for (size_t n = 0; n < sizeof wrong / sizeof *wrong; n++) {
        if (load_steering(wrong[n]))
            fail_msg("%s was accepted", wrong[n]);
        if (!strstr(refusal, " must be from "))
            fail_msg("%s: %s", wrong[n], refusal);
    }
    assert_true(
        load_steering("100 * drift(100, -100) + together(0) + follow(nearest \"anyone\", 1000)"));
}

/* Computed weights and parameters become infinite, or NaN. */
static void computed_weights_never_make_positions_infinite(void **state) {
    (void)state;
    const char *const sheets[] = {
        "steer = together(0)",
        "steer = (distance(nearest \"opponents\")) * drift(1, 0)",
        "steer = (distance(nearest \"opponents\") - distance(nearest \"opponents\")) * drift(1, 0) "
        "+ together(0)",
        "steer = 1e6 * drift(100, 0) + -1e6 * drift(100, 1e-30)",
        "steer = drift(1, 0), speed = distance(nearest \"opponents\"), "
        "push = distance(nearest \"opponents\") - distance(nearest \"opponents\")",
        "steer = drift(1, 0), lasts = distance(nearest \"opponents\") * 0, { to = \"A\", when = "
        "lasted }"};
    for (size_t n = 0; n < sizeof sheets / sizeof *sheets; n++) {
        char sheet[600];
        snprintf(sheet, sizeof sheet, MACHINE_START "\"A\", states = { A = { %s } } }\n",
                 sheets[n]);
        JoScene *scene = load_scene_text(CROWD, sheet);
        step_scene(scene, 40);
        if (!has_finite_agents(scene))
            fail_msg("%s", sheets[n]);
        jo_scene_free(scene);
    }
}

/* Each place in the file is reported once, for the first agent, with its line. */
static void invalid_computed_parameters_are_reported(void **state) {
    (void)state;
    const struct {
        const char *sheet, *text;
    } cases[] = {
        {"radius =\n distance(nearest \"opponents\") * 0",
         ": radius of agent 0 (machine m, state A) "},
        {"mass =\n 5 - 10 * now.speed - 20", "came out as -15; 1 kg is taken."},
        {"speed =\n distance(nearest \"opponents\")", "came out as inf; 20 m/s is taken."},
        {"push =\n 5 - distance(nearest \"opponents\")", "came out as -inf; 0 N is taken."},
        {"radius =\n normal(-1, 0.1)", "; 0.02 m is taken."},
        {"breadth =\n 0 * now.speed", "came out as 0; 2.25 times the radius is taken, as where"},
        {"depth =\n now.speed - 20", "came out as -20; "},
        {"depth =\n normal(-1, 0.1)", " times the radius is taken, "}};
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        char sheet[600];
        snprintf(sheet, sizeof sheet,
                 MACHINE_START "\"A\", states = { A = {\n steer = hold, %s } } }\n",
                 cases[n].sheet);
        JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(4), sheet);
        step_scene(scene, 40);
        const char *line =
            scene_messages.data ? strstr(scene_messages.data, "own.lua:3: t = 0.00 s: ") : NULL;
        line = line                  ? line
               : scene_messages.data ? strstr(scene_messages.data, "own.lua:2: t = 0.00 s: ")
                                     : NULL;
        if (!line || !strstr(line, cases[n].text) || strstr(line + 1, "own.lua:"))
            fail_msg("%s: %s", cases[n].sheet,
                     scene_messages.data ? scene_messages.data : "no message");
        assert_null(jo_world_failure(scene->world));
        jo_scene_free(scene);
    }
}

#define FAR "distance(nearest \"opponents\")" /* nobody is one: infinite */

static void invalid_numbers_of_actions_are_reported(void **state) {
    (void)state;
    const struct {
        const char *action, *text;
    } cases[] = {
        {"kick = { nearest \"ball\", impulse = 5,\n lift = 0 * " FAR " }",
         "own.lua:3: t = 0.00 s: lift of the kick of agent 0 (machine m, state A) came out as "},
        {"kick = { nearest \"ball\",\n impulse = " FAR " }",
         "own.lua:3: t = 0.00 s: impulse of the kick of agent 0 (machine m, state A) came out as "
         "inf; 50 m/s is taken."},
        {"kick = { nearest \"ball\",\n impulse = " FAR " - " FAR " }", "nan; 0 m/s is taken."},
        {"kick = { nearest \"ball\",\n speed = " FAR " }",
         "own.lua:3: t = 0.00 s: speed of the kick of agent 0 (machine m, state A) came out as "
         "inf; 50 m/s is taken."},
        {"grasp = nearest \"anyone\",\n grip = " FAR " - " FAR, "grip of agent 0 "},
        {"\nlasts = 0 * " FAR, "lasts of agent 0 (machine m, state A) came out as "},
        {"set = {\n far = " FAR " }",
         "far of agent 0 (machine m, state A) came out as inf; it keeps "
         "its value\n"}};
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        char sheet[600];
        snprintf(sheet, sizeof sheet,
                 "memory { far = 0 } " MACHINE_START
                 "\"A\", states = { A = {\n steer = hold, %s } } }\n",
                 cases[n].action);
        JoScene *scene =
            load_scene_text("jostle: 1\ngroups: {people: {behaviour: own.lua, at: [[0, 0], "
                            "[0.5, 0]]}}\nbodies: [{shape: {sphere: {radius: 0.11}}, mass: 0.4, "
                            "at: [0, 0.36, 0.11], tags: [ball]}]\n",
                            sheet);
        step_scene(scene, 10);
        const char *line = scene_messages.data ? strstr(scene_messages.data, cases[n].text) : NULL;
        if (!line || strstr(line, "\n/"))
            fail_msg("%s: %s", cases[n].action,
                     scene_messages.data ? scene_messages.data : "no message");
        jo_scene_free(scene);
    }
}

/* As a last defence, a number that is not finite ends the run, and the error names the agent. */
static void number_that_is_not_finite_ends_the_run(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(CROWD, MACHINE_START "\"Odd\", states = { Odd = { steer = hold } } }\n");
    JoxAgents *a = &scene->world->state.agents;
    JoError error = {0};
    step_scene(scene, 1);
    for (uint32_t i = 0; i < a->count; i++)
        if (a->id[i] == 101)
            a->vx[i] = NAN;
    assert_null(jo_world_failure(scene->world));
    assert_false(jo_scene_step(scene, &error));
    assert_int_equal(error.code, JO_FAILED);
    assert_string_equal(error.text, jo_world_failure(scene->world));
    assert_non_null(strstr(error.text, "of agent 101 is not finite (machine m, state Odd)"));
    uint64_t tick = jo_world_tick(scene->world);
    assert_false(jo_scene_step(scene, &error)); /* the world stays failed */
    jo_world_step(scene->world, 3);
    assert_int_equal(jo_world_tick(scene->world), tick);
    jo_scene_free(scene);
}

static void failed_world_names_agents_without_a_machine(void **state) {
    (void)state;
    JoWorldDef def = jo_default_world_def();
    JoWorld *world = jo_world_create(&def, NULL);
    JoAgentDef agent = jo_default_agent_def();
    jo_world_add_agent(world, &agent, NULL);
    jo_world_step(world, 1);
    world->state.agents.inferred_y[0] = INFINITY;
    jo_world_step(world, 5);
    assert_int_equal(jo_world_tick(world), 2);
    assert_non_null(strstr(jo_world_failure(world), "of agent 0 is not finite (no machine)"));
    jo_world_free(world);
}

/* ---- agents without a machine ---- */

static void lua_can_read_agents_without_a_machine(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(YARD_WITH_PEOPLE(4),
                        "local mine = memory { hits = 0, seen = 0 }\n" MACHINE_START
                        "\"A\", defaults = { perception = 60 }, states = { A = { steer = hold,\n"
                        "  { to = \"A\", when = function(me)\n"
                        "    me.seen = 0\n"
                        "    for _, n in ipairs(me.neighbours) do\n"
                        "      if n.machine == nil and n.state == nil and n.hits == nil then\n"
                        "        me.seen = me.seen + 1 end\n"
                        "    end\n"
                        "    return false\n"
                        "  end } } } }\n");
    JoAgentDef agent = jo_default_agent_def();
    agent.x = agent.y = 12.0;
    jo_world_add_agent(scene->world, &agent, NULL);
    step_scene(scene, 5);
    assert_int_equal(scene->world->machines.state->hook_failures, 0);
    const JoxAgents *a = &scene->world->state.agents;
    const JoxMachine *machine = scene->world->model.machines.items[0];
    uint32_t slot = strcmp(machine->memory[0].name, "seen") ? 1 : 0, looked = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        if (a->machine[i] == JOX_NO_MACHINE)
            continue;
        assert_true(a->memory[(size_t)i * a->memory_stride + slot] == 1.0);
        looked++;
    }
    assert_int_equal(looked, 4);
    jo_scene_free(scene);
}

/* ---- changes of others' memory ---- */

/* In each step, three people each add 1 to the hits of the other two, read before the step: of two
 * changes to one memory, one is lost. */
static void lost_changes_of_memory_are_counted(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(YARD_WITH_PEOPLE(3),
                        "local mine = memory { hits = 0 }\n" MACHINE_START
                        "\"A\", defaults = { perception = 60 }, states = { A = { steer = hold,\n"
                        "  { to = \"A\", when = function(me)\n"
                        "    for _, n in ipairs(me.neighbours) do n.hits = n.hits + 1 end\n"
                        "    return false\n"
                        "  end } } } }\n");
    step_scene(scene, 4);
    assert_non_null(strstr(scene_messages.data, "a change is lost"));
    assert_int_equal(scene->world->machines.state->changes_lost, 3 * 4);
    char *summary = jo_scene_summary(scene), *closing = jo_scene_closing(scene);
    assert_non_null(strstr(summary, "\"changes_lost\": 12"));
    assert_non_null(strstr(closing, "12 lost changes of others' memory"));
    JoxText kept = {0};
    assert_true(jox_world_snapshot(scene->world, &kept, NULL));
    step_scene(scene, 2);
    assert_int_equal(scene->world->machines.state->changes_lost, 3 * 6);
    assert_true(jox_world_restore(scene->world, kept.data, kept.length, NULL));
    assert_int_equal(scene->world->machines.state->changes_lost,
                     3 * 4); /* the count continues in a resumed run */
    jox_text_free(&kept);
    jo_free(summary);
    jo_free(closing);
    jo_scene_free(scene);
}

/* ---- the closing paragraph ---- */

static void lost_body_is_said_in_a_sentence(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(YARD_WITH_PEOPLE(1) "bodies: [{shape: {sphere: {radius: 0.2}}, at: [9999, "
                                            "0, 5], velocity: [50, 0, 0]}]\n",
                        MACHINE_START "\"A\", states = { A = { steer = hold } } }\n");
    step_scene(scene, 4);
    char *closing = jo_scene_closing(scene);
    assert_non_null(strstr(closing, " There was 1 body lost."));
    jo_free(closing);
    jo_scene_free(scene);
}

/* ---- sources ---- */

static void three_hundred_sources_count_separately(void **state) {
    (void)state;
    enum { SOURCES = 300 };
    JoxText text = {0};
    jox_text_add(&text, "jostle: 1\nplaces:\n");
    for (int s = 0; s < SOURCES; s++)
        jox_text_printf(&text, "  p%d: {point: [%d, %d], radius: 1.5}\n", s, s % 20 * 5,
                        s / 20 * 5);
    jox_text_add(&text, "groups: {people: {behaviour: own.lua, count: 0}}\nsources:\n");
    for (int s = 0; s < SOURCES; s++)
        jox_text_printf(&text, "  - {at: p%d, like: people, rate: %d, even: true}\n", s,
                        s == 44 ? 5 : 1);
    JoScene *scene =
        load_scene_text(text.data, MACHINE_START "\"A\", states = { A = { steer = hold } } }\n");
    jox_text_free(&text);
    assert_int_equal(jo_world_agent_count(scene->world), 0);
    step_scene(scene, 61); /* 3 s: three of each, and fifteen of one */
    uint32_t made[SOURCES] = {0};
    const JoxAgents *a = &scene->world->state.agents;
    for (uint32_t i = 0; i < a->count; i++) {
        int s = (int)(a->y[i] / 5 + 0.5f) * 20 + (int)(a->x[i] / 5 + 0.5f);
        assert_in_range(s, 0, SOURCES - 1);
        made[s]++;
    }
    for (int s = 0; s < SOURCES; s++)
        if (made[s] != (s == 44 ? 15 : 3))
            fail_msg("source %d made %u", s, made[s]);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steering_numbers_out_of_range_are_refused),
        cmocka_unit_test(computed_weights_never_make_positions_infinite),
        cmocka_unit_test(invalid_computed_parameters_are_reported),
        cmocka_unit_test(invalid_numbers_of_actions_are_reported),
        cmocka_unit_test(number_that_is_not_finite_ends_the_run),
        cmocka_unit_test(failed_world_names_agents_without_a_machine),
        cmocka_unit_test(lua_can_read_agents_without_a_machine),
        cmocka_unit_test(lost_changes_of_memory_are_counted),
        cmocka_unit_test(lost_body_is_said_in_a_sentence),
        cmocka_unit_test(three_hundred_sources_count_separately),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
