/* Tests what agents keep when a reload replaces their behaviour, and which reloads are refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "unit/scene_loader.h"

static const char GREET[] =
    "local mine = memory { met = 0, left = 0 }\n" MACHINE_START "\"Enter\", states = {\n"
    "  Enter = { steer = hold, { to = \"Greet\", when = after(0.1) } },\n"
    "  Greet = { steer = hold, on_enter = function(me) me.met = me.met + 1 end,\n"
    "    on_exit = function(me) me.left = me.left + 1 end } } }\n";
static const char ISTILAM[] =
    "local mine = memory { met = 0, left = 0 }\n" MACHINE_START
    "\"Enter\", renamed = { Greet = \"Istilam\" }, states = {\n"
    "  Enter = { steer = hold, { to = \"Istilam\", when = after(0.1) } },\n"
    "  Other = { steer = hold, { to = \"Enter\", when = after(9) } },\n"
    "  Istilam = { steer = hold, on_enter = function(me) me.met = me.met + 1 end,\n"
    "    on_exit = function(me) me.left = me.left + 1 end, { to = \"Other\", when = after(0.5) } } "
    "} }\n";

static double read_memory_value(const JoScene *scene, uint32_t agent, const char *name) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxMachine *m = scene->world->model.machines.items[a->machine[agent]];
    for (uint32_t s = 0; s < m->memory_count; s++)
        if (strcmp(m->memory[s].name, name) == 0)
            return a->memory[(size_t)agent * a->memory_stride + s];
    fail_msg("no memory '%s'", name);
    return 0.0;
}

static const char *read_state_name(const JoScene *scene, uint32_t agent) {
    const JoxAgents *a = &scene->world->state.agents;
    return scene->world->model.machines.items[a->machine[agent]]->states[a->state[agent]].name;
}

static void renamed_state_keeps_its_people_and_time(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(5), GREET);
    step_scene(scene, 8); /* 0.1 s in Enter, and some 0.25 s in Greet */
    assert_string_equal(read_state_name(scene, 0), "Greet");
    uint32_t entered = scene->world->state.agents.entered[0];
    assert_true(reload_behaviour(scene, 0, ISTILAM));
    assert_string_equal(read_state_name(scene, 0), "Istilam");
    assert_int_equal(scene->world->state.agents.entered[0], entered);
    int steps = 0;
    for (; strcmp(read_state_name(scene, 0), "Istilam") == 0 && steps < 100; steps++)
        step_scene(scene, 1);
    assert_in_range(steps, 3, 8); /* its time counts from when Greet was entered */
    for (uint32_t i = 0; i < 5; i++) {
        assert_true(read_memory_value(scene, i, "met") == 1.0); /* on_enter did not run again */
        assert_true(read_memory_value(scene, i, "left") == 1.0);
    }
    jo_scene_free(scene);
}

/* People lie on while their behaviour is replaced, and get up by the new one's `rise`. */
static void fallen_people_lie_on(void **state) {
    (void)state;
#define FALLING(rise)                                                                              \
    MACHINE_START "\"Up\", defaults = { balance = 0.5, rise = " rise " }, states = {\n"            \
                  "  Up = { steer = hold, { to = \"Down\", when = fallen } },\n"                   \
                  "  Down = { steer = hold, { to = \"Up\", when = ~fallen } } } }\n"
    JoScene *scene =
        load_scene_text("jostle: 1\nstep: 0.05\n"
                        "groups: {people: {behaviour: own.lua, at: [[0, 0], [0, 3]]}}\n",
                        FALLING("60"));
    JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    const uint32_t i = jox_agents_find(a, 0);
    for (int n = 0; n < 10; n++) {
        jo_agent_apply_force(world, jo_world_agent_of(world, 0), n < 2 ? 2000.0 : 0.0, 0.0);
        step_scene(scene, 1);
    }
    const float lain = a->fallen[i];
    assert_true(lain > 0.0f && a->fallen[1 - i] == 0.0f);
    assert_string_equal(read_state_name(scene, i), "Down");
    assert_true(reload_behaviour(scene, 0, FALLING("1")));
    assert_true(a->fallen[i] == lain);
    assert_string_equal(read_state_name(scene, i), "Down");
    step_scene(scene, 4);
    assert_true(a->fallen[i] > lain);
    step_scene(scene, 20);
    assert_true(a->fallen[i] == 0.0f);
    assert_string_equal(read_state_name(scene, i), "Up");
    jo_scene_free(scene);
#undef FALLING
}

static double read_own_number(const JoScene *scene, uint32_t agent, const char *name) {
    const JoxMachine *m =
        scene->world->model.machines.items[scene->world->state.agents.machine[agent]];
    for (uint32_t s = 0; s < m->own_count; s++)
        if (strcmp(m->own[s].name, name) == 0)
            return jox_own(&scene->world->state.agents, agent, s);
    fail_msg("no own value '%s'", name);
    return 0.0;
}

static void renamed_memory_and_own_values_keep_their_numbers(void **state) {
    (void)state;
    static const char BEFORE[] =
        "local mine = memory { met = 0, other = 7 }\n" MACHINE_START
        "\"A\", own = { courage = uniform(2, 3), calm = 5 }, states = { A = { steer = hold,\n"
        "  on_enter = function(me) me.met = me.id + 1 end } } }\n";
    static const char AFTER[] = "local mine = memory { other = 7, seen = 0 }\n" MACHINE_START
                                "\"A\", own = { calm = 5, bravery = uniform(2, 3) },\n"
                                "  renamed = { courage = \"bravery\", met = \"seen\" }, states = { "
                                "A = { steer = hold } } }\n";
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(4), BEFORE);
    step_scene(scene, 2);
    double courage[4];
    for (uint32_t i = 0; i < 4; i++)
        courage[i] = read_own_number(scene, i, "courage");
    assert_true(courage[0] != courage[1]);
    assert_true(reload_behaviour(scene, 0, AFTER));
    for (uint32_t i = 0; i < 4; i++) {
        assert_true(read_own_number(scene, i, "bravery") == courage[i]);
        assert_true(read_own_number(scene, i, "calm") == 5.0);
        assert_true(read_memory_value(scene, i, "seen") == i + 1.0);
        assert_true(read_memory_value(scene, i, "other") == 7.0);
    }
    jo_scene_free(scene);
}

static void removing_a_state_with_people_is_refused(void **state) {
    (void)state;
    static const char WITHOUT[] =
        MACHINE_START "\"Enter\", states = { Enter = { steer = hold }, Istilam = { steer = hold, "
                      "{ to = \"Enter\", when = after(1) } } } }\n";
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(312), GREET);
    assert_true(reload_behaviour(scene, 0, GREET));
    step_scene(scene, 8);
    uint64_t before = jo_world_hash(scene->world);
    assert_false(reload_behaviour(scene, 0, WITHOUT));
    assert_non_null(strstr(refusal, "312 agents are in 'Greet', which this version lacks"));
    assert_non_null(strstr(refusal, "renamed"));
    assert_int_equal(jo_world_hash(scene->world), before);
    assert_int_equal(scene->world->model.machines.items[0]->reloads, 1);
    step_scene(scene, 8);
    assert_string_equal(read_state_name(scene, 311), "Greet");
    jo_scene_free(scene);
    scene = load_scene_text(YARD_WITH_PEOPLE(312), GREET); /* nobody has got there yet */
    assert_true(reload_behaviour(scene, 0, WITHOUT));
    jo_scene_free(scene);
}

static void memory_is_kept_by_name_and_type(void **state) {
    (void)state;
    static const char BEFORE[] =
        "local mine = memory { laps = 0, seen = 0, tired = false, gone = 3 }\n" MACHINE_START
        "\"A\", states = { A = { steer = hold,\n"
        "  on_enter = function(me) me.laps = 5; me.seen = 7; me.tired = true end } } }\n";
    static const char AFTER[] =
        "local mine = memory { fresh = 11, tired = 4, laps = 0, seen = true }\n" MACHINE_START
        "\"A\", states = { A = { steer = hold, on_enter = function(me) me.laps = 99 end } } }\n";
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(5), BEFORE);
    step_scene(scene, 2);
    assert_true(read_memory_value(scene, 4, "seen") == 7.0 &&
                read_memory_value(scene, 4, "tired") == 1.0);
    assert_true(reload_behaviour(scene, 0, AFTER));
    for (uint32_t i = 0; i < 5; i++) {
        assert_true(read_memory_value(scene, i, "laps") == 5.0);  /* kept; on_enter has not run */
        assert_true(read_memory_value(scene, i, "tired") == 4.0); /* was a boolean */
        assert_true(read_memory_value(scene, i, "seen") == 1.0);  /* was a number */
        assert_true(read_memory_value(scene, i, "fresh") == 11.0);
    }
    step_scene(scene, 2);
    assert_true(read_memory_value(scene, 4, "laps") == 5.0);
    jo_scene_free(scene);
}

/* Lists, whom memory holds, and where it was seen last; the memory moves, and a list is renamed. */
static void lists_and_people_are_kept(void **state) {
    (void)state;
    static const char BEFORE[] =
        "local mine = memory { times = list(3), met = list(2, nobody), prey = nobody, ok = 0 "
        "}\n" MACHINE_START "\"A\", defaults = { perception = 20 }, states = {\n"
        "  A = { steer = hold + seek(last_seen(mine.prey)), { to = \"B\", when = after(0.1), set = "
        "{\n"
        "    times = mine.times:push(5), met = mine.met:push(nearest \"anyone\"),\n"
        "    prey = nearest \"anyone\" } } },\n"
        "  B = { steer = hold, { to = \"C\", when = after(0.1),\n"
        "    set = { times = mine.times:push(7) } } }, C = { steer = hold } } }\n";
    static const char AFTER[] =
        "local mine = memory { first = 1, hours = list(3), met = list(2, nobody), ok = 0,\n"
        "  prey = nobody }\n" MACHINE_START
        "\"A\", renamed = { times = \"hours\" }, defaults = { perception = 20 }, states = {\n"
        "  A = { steer = seek(last_seen(mine.prey)) }, B = { steer = hold },\n"
        "  C = { steer = hold, { when = mine.hours.size:is(2) & mine.hours.first:is(5)\n"
        "    & mine.hours.last:is(7) & exists(mine.met.first) & same(mine.met.first, mine.prey)\n"
        "    & distance(last_seen(mine.prey)):above(0), set = { ok = 1 } } } } }\n";
    static const char WITHOUT[] = /* dormant meanwhile */
        "local mine = memory { ok = 0 }\n" MACHINE_START
        "\"A\", states = { A = {}, B = {}, C = { steer = hold, { every = 1, set = { ok = mine.ok } "
        "} } } }\n";
    static const char AGAIN[] =
        "local mine = memory { hours = list(3), met = list(2, nobody), ok = 0 }\n" MACHINE_START
        "\"A\", states = { A = {}, B = {}, C = { steer = hold,\n"
        "  { when = mine.hours.size:is(2) & mine.hours.first:is(5) & mine.met.size:is(1),\n"
        "    set = { ok = 2 } } } } }\n";
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(5), BEFORE);
    step_scene(scene, 8);
    assert_true(reload_behaviour(scene, 0, AFTER));
    step_scene(scene, 2);
    for (uint32_t i = 0; i < 5; i++)
        assert_true(read_memory_value(scene, i, "ok") == 1.0);
    for (int k = 0; k < 2; k++) {
        assert_true(reload_behaviour(scene, 0, WITHOUT));
        step_scene(scene, 2);
        assert_true(reload_behaviour(scene, 0, AGAIN));
        step_scene(scene, 2);
    }
    for (uint32_t i = 0; i < 5; i++)
        assert_true(read_memory_value(scene, i, "ok") == 2.0);
    jo_scene_free(scene);
}

static const char TWO_GROUPS[] =
    YARD_SCENE("groups:\n"
               "  free: {behaviour: own.lua, count: 50, fill: grid, in: yard}\n"
               "  set: {behaviour: own.lua, count: 50, fill: grid, in: yard, set: {speed: 0.7}}\n");

static void new_distribution_applies_to_present_agents(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(TWO_GROUPS, STANDING_AT_SPEED("uniform(1, 1.2)", ""));
    step_scene(scene, 3);
    uint64_t before = jo_world_hash(scene->world);
    const JoxAgents *a = &scene->world->state.agents;
    assert_true(reload_behaviour(scene, 0, STANDING_AT_SPEED("uniform(1.4, 1.6)", "")));
    double low = 9, high = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        double speed = read_wanted_speed(scene, i);
        if (a->group[i] == 1) {
            assert_true(speed == (double)0.7f); /* the scene's value stays */
            continue;
        }
        assert_true(speed >= 1.4 && speed <= 1.6);
        low = speed < low ? speed : low;
        high = speed > high ? speed : high;
    }
    assert_true(low < 1.45 && high > 1.55); /* each agent draws its own */
    assert_true(reload_behaviour(scene, 0, STANDING_AT_SPEED("2", "")));
    for (uint32_t i = 0; i < a->count; i++)
        assert_true(read_wanted_speed(scene, i) == (a->group[i] ? (double)0.7f : 2.0));
    assert_true(reload_behaviour(scene, 0, STANDING_AT_SPEED("uniform(1, 1.2)", "")));
    assert_int_equal(jo_world_hash(scene->world), before); /* back again: the same random numbers */
    assert_true(reload_behaviour(scene, 0, STANDING_AT_SPEED("uniform(1, 1.2)", ", speed = 1.9")));
    for (uint32_t i = 0; i < a->count; i++)
        assert_true(read_wanted_speed(scene, i) ==
                    (double)1.9f); /* the state's value overrides both */
    jo_scene_free(scene);
}

static void own_values_are_kept_by_name(void **state) {
    (void)state;
    static const char BEFORE[] =
        MACHINE_START "\"A\", defaults = { speed = uniform(1, 2), horizon = uniform(0.3, 0.6) },\n"
                      "  states = { A = { steer = hold, push = 100 * own.horizon } } }\n";
    static const char AFTER[] = MACHINE_START
        "\"A\", defaults = { perception = uniform(5, 6), mass = normal(70, 5, 50, 90),\n"
        "  horizon = uniform(0.3, 0.6), speed = uniform(1, 2) }, states = {\n"
        "  A = { steer = hold, max_speed = uniform(2, 3), push = own.perception + 100 * "
        "own.horizon } } }\n";
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(40), BEFORE);
    step_scene(scene, 2);
    double speed[40], push[40];
    const JoxAgents *a = &scene->world->state.agents;
    for (uint32_t i = 0; i < 40; i++) {
        speed[a->id[i]] = read_wanted_speed(scene, i);
        push[a->id[i]] = (double)jox_param(a, JOX_PARAM_push, i);
    }
    assert_true(reload_behaviour(scene, 0, AFTER));
    step_scene(scene, 1);
    for (uint32_t i = 0; i < 40; i++) {
        double more = (double)jox_param(a, JOX_PARAM_push, i) - push[a->id[i]];
        assert_true(read_wanted_speed(scene, i) == speed[a->id[i]]);
        assert_true(more > 4.99 && more < 6.01);
        assert_true(jox_param(a, JOX_PARAM_max_speed, i) >= 2.0f);
    }
    jo_scene_free(scene);
}

/* An own value that has another index in the next version, and a value from the scene. */
static void values_at_another_index_are_kept(void **state) {
    (void)state;
#define ZEAL(more)                                                                                 \
    MACHINE_START "\"A\", states = { A = { steer = hold, " more "push = 10 * own.zeal } } }\n"
    static const char *const TEXTS[] = {ZEAL("mass = 50 + own.zest, speed = own.pace, "), ZEAL(""),
                                        ZEAL("speed = own.pace, radius = uniform(0.2, 0.25), ")};
    JoScene *scene = load_scene_text(
        YARD_SCENE("groups: {people: {behaviour: own.lua, count: 40, fill: grid, "
                   "in: yard, set: {zeal: \"uniform(1, 5)\", zest: 3, pace: 1}}}\n"),
        TEXTS[0]);
    const JoxAgents *a = &scene->world->state.agents;
    double push[40];
    step_scene(scene, 2);
    for (uint32_t i = 0; i < 40; i++)
        push[a->id[i]] = (double)jox_param(a, JOX_PARAM_push, i);
    assert_true(push[3] != push[4]);
    static const int ORDER[] = {1, 0, 2, 0, 1, 2, 1};
    bool moved = false;
    uint32_t before = 0;
    for (size_t k = 0; k < sizeof ORDER / sizeof *ORDER; k++) {
        assert_true(reload_behaviour(scene, 0, TEXTS[ORDER[k]]));
        const JoxMachine *now = scene->world->model.machines.items[0];
        uint32_t slot = 0;
        while (strcmp(now->own[slot].name, "zeal") != 0)
            slot++;
        moved |= k > 0 && slot != before;
        before = slot;
        step_scene(scene, 1);
        for (uint32_t i = 0; i < 40; i++)
            assert_true((double)jox_param(a, JOX_PARAM_push, i) == push[a->id[i]]);
        for (uint32_t i = 0; i < 40 && ORDER[k] == 0;
             i++) /* as the scene gave it, after a version without it */
            assert_true(jox_param(a, JOX_PARAM_mass, i) == 53.0f);
    }
    assert_true(moved);
    jo_scene_free(scene);
}

/* A chance is rolled once while its condition stays true, also if a reload reorders the
 * transitions. */
static void condition_that_stays_true_rolls_no_new_chance(void **state) {
    (void)state;
#define ROLL(before)                                                                               \
    MACHINE_START "\"A\", states = { A = { steer = hold, " before                                  \
                  "{ to = \"B\", when = after(0.1), chance = 0.5 } }, B = { steer = hold }, "      \
                  "C = { steer = hold } } }\n"
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(200), ROLL(""));
    step_scene(scene, 8);
    uint32_t people[3];
    jox_machines_people(&scene->world->machines, 0, people);
    assert_in_range(people[0], 60, 140);
    uint32_t waiting = people[0];
    for (int i = 0; i < 10; i++) {
        const char *text = i % 2
                               ? ROLL("")
                               : ROLL("{ to = \"C\", when = after(50) }, { to = \"C\", id = \"x\", "
                                      "when = after(60) }, ");
        assert_true(reload_behaviour(scene, 0, text));
        step_scene(scene, 2);
    }
    jox_machines_people(&scene->world->machines, 0, people);
    assert_int_equal(people[0], waiting);
    jo_scene_free(scene);
}

/* A parameter that a new version no longer sets falls back to the defaults or the engine's value.
 */
static void removed_parameter_falls_back_to_its_default(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(YARD_WITH_PEOPLE(5), STANDING_AT_SPEED("1.5", ", push = 80, ignore = {}"));
    step_scene(scene, 2);
    float push = jox_parameter_store(JOX_PARAM_push, jox_parameters[JOX_PARAM_push].value);
    assert_true(jox_param(&scene->world->state.agents, JOX_PARAM_push, 2) == 80.0f);
    assert_true(reload_behaviour(scene, 0, STANDING_AT_SPEED("1.5", "")));
    assert_true(jox_param(&scene->world->state.agents, JOX_PARAM_push, 2) == push);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(renamed_state_keeps_its_people_and_time),
        cmocka_unit_test(fallen_people_lie_on),
        cmocka_unit_test(renamed_memory_and_own_values_keep_their_numbers),
        cmocka_unit_test(removing_a_state_with_people_is_refused),
        cmocka_unit_test(memory_is_kept_by_name_and_type),
        cmocka_unit_test(lists_and_people_are_kept),
        cmocka_unit_test(new_distribution_applies_to_present_agents),
        cmocka_unit_test(own_values_are_kept_by_name),
        cmocka_unit_test(values_at_another_index_are_kept),
        cmocka_unit_test(condition_that_stays_true_rolls_no_new_chance),
        cmocka_unit_test(removed_parameter_falls_back_to_its_default),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
