/* Tests of jostle_tell.h, which returns results of a run, mods, settings and hints as structs. */
#include <math.h>

#include "jostle_tools.h"
#include "messages.h"
#include "unit/test_folder.h"

static const char SCENE[] =
    "jostle: 1\n"
    "duration: 4\n"
    "places: {goal: {point: [5, 0], radius: 1}}\n"
    "groups: {people: {behaviour: walk.lua, at: [[0, 0], [1, 2]], set: {speed: 1.5}}}\n"
    "probes:\n"
    "  line: {flow: [[2, 5], [2, -5]]}\n"
    "  log: {log: true}\n";
static const char WALK[] =
    "return machine { name = \"walk\", version = 1, start = \"Go\", defaults = { speed = 1 },\n"
    "  states = { Go = { steer = seek \"goal\", on_enter = function(me) local x = nil + 1 end,\n"
    "    { to = \"Stop\", when = inside \"goal\" } }, Stop = { steer = hold } } }\n";

static int write_scene_and_mod(void **state) {
    if (make_test_folder(state) != 0)
        return -1;
    write_test_file("a.yaml", SCENE);
    write_test_file("walk.lua", WALK);
    write_test_file("mods/fast/mod.yaml",
                    "name: fast\nversion: 1.2\ntitle: Fast\napi: 1\n"
                    "settings: {pace: {value: 2, least: 1, greatest: 3, unit: m/s, meaning: how "
                    "fast}}\n");
    write_test_file("mods/fast/patches/walk.lua",
                    "return patch \"walk\" { defaults = { speed = settings.pace } }\n");
    return 0;
}

static JoSceneDef define_modded_scene(void) {
    JoSceneDef def = jo_default_scene_def();
    def.path = test_path("a.yaml");
    def.message = ignore_message;
    return def;
}

static JoScene *run_steps(uint32_t steps) {
    JoSceneDef def = define_modded_scene();
    JoError error = {0};
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene)
        fail_msg("%s", error.text);
    for (uint32_t s = 0; s < steps; s++)
        assert_true(jo_scene_step(scene, &error));
    return scene;
}

static const JoFigure *find_figure_at(const JoFigures *figures, const char *path) {
    for (uint32_t k = 0; k < figures->count; k++)
        if (strcmp(figures->items[k].path, path) == 0)
            return &figures->items[k];
    fail_msg("there is no figure %s", path);
    return NULL;
}

static void figures_equal_those_of_the_summary(void **state) {
    (void)state;
    JoScene *scene = run_steps(80);
    char *file = jo_scene_summary(scene), hash[24];
    JoFigures *figures = jo_scene_figures(scene);
    snprintf(hash, sizeof hash, "%016llx",
             (unsigned long long)jo_world_hash(jo_scene_world(scene)));
    jo_scene_free(scene); /* the figures outlive the scene */
    assert_float_equal(jo_figure(figures, "agents"), 2, 0);
    assert_float_equal(jo_figure(figures, "simulated_s"), 4, 1e-9);
    assert_true(isnan(jo_figure(figures, "no.such")));
    assert_true(isnan(jo_figure(figures, "hash")));
    assert_string_equal(find_figure_at(figures, "hash")->text, hash);
    const JoFigure *events = find_figure_at(figures, "events"),
                   *hits = find_figure_at(figures, "events.hits");
    assert_int_equal(events->kind, JO_FIGURE_TABLE);
    assert_int_equal(events->depth, 1);
    assert_int_equal(hits->depth, 2);
    assert_string_equal(hits->name, "hits");
    assert_int_equal(find_figure_at(figures, "inputs")->kind, JO_FIGURE_LIST);
    assert_null(find_figure_at(figures, "inputs.0")->name);
    assert_string_equal(find_figure_at(figures, "inputs.0.path")->name, "path");
    assert_non_null(strstr(file, hash));
    jo_free(figures);
    jo_free(file);
}

static void probe_tables_have_the_measured_columns(void **state) {
    (void)state;
    JoScene *scene = run_steps(80);
    assert_string_equal(jo_scene_probe_name(scene, 0), "line");
    assert_null(jo_scene_probe_name(scene, 2));
    assert_null(jo_scene_probe_table(scene, 2));
    JoTable *line = jo_scene_probe_table(scene, 0), *log = jo_scene_probe_table(scene, 1);
    jo_scene_free(scene);
    assert_int_equal(line->column_count, 5);
    assert_int_equal(line->row_count, 2);
    assert_string_equal(line->columns[0].name, "time");
    assert_string_equal(line->columns[0].unit, "s");
    assert_string_equal(line->columns[3].name, "passages");
    assert_string_equal(line->columns[3].unit, "");
    assert_float_equal(line->columns[3].numbers[1], 2, 0);
    assert_true(isnan(line->columns[4].numbers[0])); /* no one before the first */
    assert_null(line->columns[0].texts);
    assert_string_equal(log->columns[1].name, "what");
    assert_non_null(log->columns[1].texts);
    assert_true(log->row_count > 0 && *log->columns[1].texts[0]);
    assert_string_equal(log->columns[3].texts[0], "people");
    jo_free(line);
    jo_free(log);
}

/* One function fails once for each of two agents. */
static void failing_function_is_a_cost_and_a_trouble(void **state) {
    (void)state;
    JoScene *scene = run_steps(4);
    JoLuaCosts *costs = jo_scene_lua_costs(scene);
    JoTroubles *troubles = jo_scene_troubles(scene);
    assert_int_equal(costs->count, 1);
    assert_string_equal(costs->items[0].behaviour, "walk");
    assert_non_null(strstr(costs->items[0].file, "/walk.lua"));
    assert_non_null(strstr(costs->items[0].where, "on_enter"));
    assert_int_equal(costs->items[0].calls, 2);
    assert_int_equal(costs->items[0].failures, 2);
    assert_false(costs->items[0].suspended);
    assert_true(costs->stepping > 0.0);
    assert_int_equal(troubles->count, 1);
    assert_int_equal(troubles->items[0].kind, JO_TROUBLE_FAILED);
    assert_int_equal(troubles->items[0].count, 2);
    assert_non_null(strstr(troubles->items[0].text, "state Go > on_enter, in 2 of 2 calls"));
    jo_free(costs);
    jo_free(troubles);
    jo_scene_free(scene);
}

static void suspended_function_is_a_trouble(void **state) {
    (void)state;
    write_test_file("walk.lua",
                    "return machine { name = \"walk\", version = 1, start = \"Go\", states = {\n"
                    "  Go = { steer = function(me) return nil + 1, 0 end } } }\n");
    JoScene *scene = run_steps(0);
    JoError error;
    for (int k = 0; k < 10; k++)
        assert_int_not_equal(
            jo_world_spawn(jo_scene_world(scene), "people", 0, 3 + k, &error).generation, 0);
    for (int s = 0; s < 40; s++)
        assert_true(jo_scene_step(scene, &error));
    JoTroubles *troubles = jo_scene_troubles(scene);
    jo_scene_free(scene);
    assert_int_equal(troubles->count, 1);
    assert_int_equal(troubles->items[0].kind, JO_TROUBLE_SUSPENDED);
    assert_int_equal(troubles->items[0].count, 100);
    assert_non_null(strstr(troubles->items[0].text, "was suspended: state Go > steer"));
    assert_non_null(strstr(troubles->items[0].file, "walk.lua"));
    jo_free(troubles);
    write_test_file("walk.lua", WALK);
}

static void mods_and_settings_of_paths_are_listed(void **state) {
    (void)state;
    JoSceneDef def = define_modded_scene();
    JoMods *mods = jo_mods_list(&def);
    assert_int_equal(mods->taken, 0);
    assert_int_equal(mods->count, 1);
    assert_false(mods->items[0].taken);
    assert_int_equal(mods->items[0].on, JO_MOD_OFF);
    jo_free(mods);
    const char *fast = "fast";
    def.mods = &fast;
    def.mod_count = 1;
    mods = jo_mods_list(&def);
    assert_int_equal(mods->taken, 1);
    const JoMod *mod = &mods->items[0];
    assert_string_equal(mod->name, "fast");
    assert_string_equal(mod->title, "Fast");
    assert_int_equal(mod->patch_count, 1);
    assert_string_equal(mod->patches[0].target, "walk");
    assert_true(mod->patches[0].behaviour && !mod->patches[0].replaces);
    assert_int_equal(mod->setting_count, 1);
    assert_string_equal(mod->settings[0].unit, "m/s");
    assert_float_equal(mod->settings[0].greatest, 3, 0);
    jo_free(mods);

    JoError error = {0};
    JoSettings *why = jo_mods_why(&def, "walk.defaults.speed", &error);
    assert_non_null(why);
    assert_int_equal(why->count, 2);
    assert_int_equal(why->items[0].by, JO_SET_BEHAVIOUR);
    assert_string_equal(why->items[0].value, "1");
    assert_int_equal(why->items[0].line, 1);
    assert_int_equal(why->items[1].by, JO_SET_MOD);
    assert_string_equal(why->items[1].mod, "fast");
    assert_string_equal(why->items[1].version, "1.2");
    jo_free(why);
    why = jo_mods_why(&def, "walk.Go.push_reach", &error);
    assert_int_equal(why->count, 1);
    assert_int_equal(why->items[0].by, JO_SET_DEFAULT);
    assert_string_equal(why->items[0].value, "0.1");
    assert_string_equal(why->items[0].unit, "m");
    jo_free(why);
    why = jo_mods_why(&def, "groups.people.set.speed", &error);
    assert_int_equal(why->items[0].by, JO_SET_SCENE);
    assert_int_equal(why->items[0].line, 4);
    assert_string_equal(why->items[0].mod, "");
    jo_free(why);
    assert_null(jo_mods_why(&def, "groups.peple", &error));
    assert_int_equal(error.code, JO_INPUT);
}

/* A scene for behaviours with parts that have no effect. */
static const char HINTS[] =
    "jostle: 1\n"
    "duration: 30\n"
    "places: {goal: {point: [8, 0], radius: 1}, cell: {point: [20, 20], radius: 0.5}}\n"
    "walls: [{line: [[18, 18], [22, 18], [22, 22], [18, 22]], closed: true}]\n"
    "groups: {people: {behaviour: hint.lua, at: [[0, 0], [1, 2]], set: {perception: 2}}}\n";

/* ---- present values and their settings ---- */

static const char NOW[] = "local mine = memory { n = 0, m = 0 }\n"
                          "return machine { name = \"hint\", version = 1, start = \"A\", defaults "
                          "= { speed = 1 }, states = {\n"
                          "  A = { steer = hold, { to = \"B\", when = after(0.5),\n"
                          "    set = { n = 4 } } },\n"
                          "  B = { steer = hold, perception = 7,\n"
                          "    on_enter = function(me)\n"
                          "      me.m = 2\n"
                          "    end } } }\n";

static JoScene *shown;
static JoAgent agent;
static double value;

static JoSettings *find_settings_now(const char *name) {
    JoError error = {0};
    JoSettings *why = jo_agent_why(shown, agent, name, &value, &error);
    if (!why)
        fail_msg("%s", error.text);
    return why;
}

/* Checks the last setting of a value, which is in effect. */
static void assert_last_set(const char *name, double is, JoSetBy by, int line, const char *where) {
    JoSettings *why = find_settings_now(name);
    const JoSetting *last = &why->items[why->count - 1];
    assert_float_equal(value, is, 1e-6);
    assert_int_equal(last->by, by);
    assert_int_equal(last->line, line);
    assert_string_equal(last->where, where);
    jo_free(why);
}

static void step_shown(int steps) {
    JoError error = {0};
    for (int s = 0; s < steps; s++)
        assert_true(jo_scene_step(shown, &error));
}

static void present_value_and_its_settings_are_listed(void **state) {
    (void)state;
    JoSceneDef def = define_modded_scene();
    JoError error = {0};
    write_test_file("hint.lua", NOW);
    def.text = HINTS;
    def.text_length = sizeof HINTS - 1;
    shown = jo_scene_load(&def, &error);
    assert_non_null(shown);
    agent = jo_world_agent_of(jo_scene_world(shown), 1);
    const uint64_t hash = jo_world_hash(jo_scene_world(shown));
    assert_last_set("speed", 1, JO_SET_BEHAVIOUR, 2, "defaults");
    assert_last_set("push_reach", 0.1, JO_SET_DEFAULT, 0, "defaults");
    assert_last_set("perception", 2, JO_SET_SCENE, 5, "groups.people");
    assert_last_set("n", 0, JO_SET_BEHAVIOUR, 1, "memory");
    assert_true(jo_world_hash(jo_scene_world(shown)) == hash);
    step_shown(12);
    assert_last_set("n", 4, JO_SET_BEHAVIOUR, 4, "to B");
    assert_last_set("m", 2, JO_SET_FUNCTION, 7, "");
    assert_last_set("perception", 7, JO_SET_BEHAVIOUR, 5, "state B");
    JoSettings *why = find_settings_now("n");
    assert_float_equal(why->items[why->count - 1].time, 0.5, 0.051);
    assert_int_equal(why->count, 2);
    jo_free(why);
    assert_true(jo_agent_set_memory(jo_scene_world(shown), agent, "n", 9, &error));
    assert_true(jo_agent_set_parameter(jo_scene_world(shown), agent, "speed", 2, &error));
    step_shown(1);
    assert_last_set("n", 9, JO_SET_PROGRAM, 0, "");
    assert_last_set("speed", 2, JO_SET_PROGRAM, 0, "");
    assert_null(jo_agent_why(shown, agent, "spede", &value, &error));
    assert_non_null(strstr(error.text, "did you mean speed"));
    jo_world_remove_agent(jo_scene_world(shown), agent);
    assert_null(jo_agent_why(shown, agent, "speed", &value, &error));
    jo_scene_free(shown);
}

/* A value that a function computed, and one written before the agent was watched. */
static void unseen_writes_are_marked_as_unseen(void **state) {
    (void)state;
    JoSceneDef def = define_modded_scene();
    JoError error = {0};
    write_test_file("hint.lua", "local function keen(state) state.perception = 7 return state end\n"
                                "return machine { name = \"hint\", version = 1, start = \"A\",\n"
                                "  defaults = { perception = 3 }, states = {\n"
                                "    A = keen { steer = hold } } }\n");
    def.text = HINTS;
    def.text_length = sizeof HINTS - 1;
    shown = jo_scene_load(&def, &error);
    assert_non_null(shown);
    agent = jo_world_agent_of(jo_scene_world(shown), 1);
    assert_true(jo_agent_set_parameter(jo_scene_world(shown), agent, "push_reach", 0.3, &error));
    assert_last_set("perception", 7, JO_SET_BEHAVIOUR, 4, "state A");
    assert_last_set("push_reach", 0.3, JO_SET_UNSEEN, 0, "");
    char *json = jo_scene_inspect(shown, agent.slot);
    assert_non_null(strstr(json, "/hint.lua:4\""));
    assert_non_null(
        strstr(json, "\"value\": 0.3, \"unit\": \"m\", \"set\": \"function or program\""));
    jo_free(json);
    jo_scene_free(shown);
}

/* ---- hints ---- */

static JoHints *run_for_hints(const char *behaviour, double seconds) {
    JoSceneDef def = define_modded_scene();
    JoError error = {0};
    write_test_file("hint.lua", behaviour);
    def.text = HINTS;
    def.text_length = sizeof HINTS - 1;
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene)
        fail_msg("%s", error.text);
    while (jo_world_time(jo_scene_world(scene)) < seconds)
        assert_true(jo_scene_step(scene, &error));
    JoHints *hints = jo_scene_hints(scene);
    jo_scene_free(scene);
    assert_non_null(hints);
    return hints;
}

static void assert_hint(const JoHints *hints, uint32_t n, JoHintKind kind, int line,
                        const char *text) {
    if (n >= hints->count)
        fail_msg("%u hints alone, not '%s'", hints->count, text);
    assert_int_equal(hints->items[n].kind, kind);
    assert_int_equal(hints->items[n].line, line);
    if (!strstr(hints->items[n].text, text))
        fail_msg("'%s' lacks '%s'", hints->items[n].text, text);
    assert_non_null(strstr(hints->items[n].file, "/hint.lua"));
    assert_true(*hints->items[n].way_out != 0);
}

#define BEGIN                                                                                      \
    "local mine = memory { n = 0 }\nreturn machine { name = \"hint\", version = 1, start = "       \
    "\"A\", "

static void transition_that_never_fired_gives_a_hint(void **state) {
    (void)state;
    static const char NEVER[] =
        BEGIN "states = {\n"
              "  A = { steer = seek \"goal\",\n"
              "    { to = \"B\", when = mine.n:at_least(3) },\n"
              "    { to = \"A\", when = mine.n:at_least(5), set = { n = 0 } },\n"
              "    { to = \"B\", when = stuck(3) & near(\"cell\", 1) },\n"
              "    { to = \"B\", when = inside \"cell\", chance = 0.5 } },\n"
              "  B = { steer = hold } } }\n";
    JoHints *hints = run_for_hints(NEVER, 30);
    assert_hint(hints, 0, JO_HINT_STATE, 4, "nobody was ever in state 'B'");
    assert_hint(hints, 1, JO_HINT_TRANSITION, 5, "from 'A' to 'A' was never taken in 30 s");
    assert_int_equal(hints->count, 2);
    jo_free(hints);
    hints = run_for_hints(NEVER, 20); /* it may still happen */
    assert_int_equal(hints->count, 0);
    jo_free(hints);
    hints = run_for_hints(BEGIN "states = {\n"
                                "  A = { steer = seek \"goal\",\n"
                                "    { to = \"B\", when = near(\"goal\", 2), set = { n = 3 } } },\n"
                                "  B = { steer = hold, lasts = 1, { to = \"A\", "
                                "when = mine.n:at_least(3) & lasted, set = { n = 0 } } } } }\n",
                          30);
    assert_int_equal(hints->count, 0);
    jo_free(hints);
}

static void goal_that_nobody_reached_gives_a_hint(void **state) {
    (void)state;
    JoHints *hints = run_for_hints(BEGIN "states = {\n"
                                         "  A = { steer = seek \"cell\",\n"
                                         "    { to = \"B\", when = inside \"cell\" } },\n"
                                         "  B = { steer = hold } } }\n",
                                   30);
    assert_hint(hints, 0, JO_HINT_GOAL, 4, "nobody in state 'A' reached 'cell' in 30 s");
    assert_int_equal(hints->count, 1);
    jo_free(hints);
}

static void cycle_without_time_gives_a_hint(void **state) {
    (void)state;
    JoHints *hints =
        run_for_hints(BEGIN "states = {\n"
                            "  A = { steer = hold, { to = \"B\", when = mine.n:below(9) } },\n"
                            "  B = { steer = hold, { to = \"C\", when = mine.n:below(8) } },\n"
                            "  C = { steer = hold, { to = \"A\", when = mine.n:below(7) } } } }\n",
                      20);
    assert_hint(hints, 0, JO_HINT_CYCLE, 3, "people went round 'A' -> 'B' -> 'C' -> 'A'");
    assert_int_equal(hints->count, 1);
    jo_free(hints);
}

/* The scene sets a shorter perception than the behaviour needs. */
static void distance_beyond_sight_gives_a_hint(void **state) {
    (void)state;
    JoHints *hints = run_for_hints(
        BEGIN "defaults = { perception = 10 }, states = {\n"
              "  A = { steer = hold, { to = \"B\", when = near(nearest \"anyone\", 6) } },\n"
              "  B = { steer = hold, { to = \"A\", when = near(nearest \"anyone\", 1.5) } } } }\n",
        5);
    assert_hint(hints, 0, JO_HINT_SIGHT, 3,
                "asks for 6 m, and nobody there perceived farther than 2 m");
    assert_int_equal(hints->count, 1);
    jo_free(hints);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figures_equal_those_of_the_summary),
        cmocka_unit_test(probe_tables_have_the_measured_columns),
        cmocka_unit_test(failing_function_is_a_cost_and_a_trouble),
        cmocka_unit_test(suspended_function_is_a_trouble),
        cmocka_unit_test(mods_and_settings_of_paths_are_listed),
        cmocka_unit_test(present_value_and_its_settings_are_listed),
        cmocka_unit_test(unseen_writes_are_marked_as_unseen),
        cmocka_unit_test(transition_that_never_fired_gives_a_hint),
        cmocka_unit_test(goal_that_nobody_reached_gives_a_hint),
        cmocka_unit_test(cycle_without_time_gives_a_hint),
        cmocka_unit_test(distance_beyond_sight_gives_a_hint),
    };
    return cmocka_run_group_tests(tests, write_scene_and_mod, remove_test_folder);
}
