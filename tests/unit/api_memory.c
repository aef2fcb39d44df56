/* Memory that runs out at each allocation in turn: calls return their error, what they left can be
   freed, nothing leaks, and the same calls succeed once there is memory. The heaps' own assertion
   (debug builds) and LeakSanitizer (asan) find what leaks. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/mem.h"
#include "jostle_tools.h"

static const char SCENE[] =
    "jostle: 1\n"
    "duration: 5\n"
    "places:\n"
    "  hall: {polygon: [[0, 0], [5, 0], [5, 3], [0, 3]]}\n"
    "  east: {polygon: [[4, 0], [5, 0], [5, 3], [4, 3]]}\n"
    "  west: {polygon: [[0, 0], [1, 0], [1, 3], [0, 3]]}\n"
    "walls:\n"
    "  - {line: [[0, 0], [5, 0], [5, 3], [0, 3]], closed: true}\n"
    "groups:\n"
    "  walkers: {behaviour: behaviours/pedestrian.lua, count: 8, in: hall, spacing: 0.7,\n"
    "            set: {goal: east, home: west}}\n";

static char told[4096]; /* by the last call */

static void keep(void *context, const char *text) {
    (void)context;
    snprintf(told, sizeof told, "%.4000s", text);
}

/* A public call with what depends on it. Returns true on success; else `error` says why. */
typedef bool Attempt(JoError *error);

/* Lets the n-th allocation fail, and all after it, for n = 0, stride, 2 stride, ..., until the
   attempt needs no more. */
static void sweep(const char *name, Attempt *attempt, uint64_t all, uint64_t stride) {
    JoError error = {0};
    if (!attempt(&error))
        fail_msg("%s: %s, told '%s'", name, error.text, told);
    uint64_t n = 0, failures = 0;
    for (bool good = false; !good; n += n < all ? 1 : stride) {
        error = (JoError){0};
        jox_alloc_fail_after(n);
        good = attempt(&error);
        jox_alloc_fail_after(UINT64_MAX);
        failures += !good;
        if (!good && (error.code != JO_FAILED || !strstr(error.text, "out of memory")))
            fail_msg("%s: allocation %llu: code %d, '%s', told '%s'", name, (unsigned long long)n,
                     (int)error.code, error.text, told);
    }
    print_message("%s: %llu times out of memory, up to allocation %llu\n", name,
                  (unsigned long long)failures, (unsigned long long)n);
    assert_true(failures > 0);
    error = (JoError){0};
    assert_true(attempt(&error));
}

static bool no_memory(JoError *error) {
    error->code = JO_FAILED;
    snprintf(error->text, sizeof error->text, "out of memory");
    return false;
}

static bool run_by_hand(JoWorld *world, JoError *error) {
    const double wall[] = {0, 0, 10, 0}, block[] = {4, 4, 5, 4, 5, 5, 4, 5};
    if (!jo_world_add_line(world, wall, 2, error) || !jo_world_add_solid(world, block, 4, error))
        return false;
    for (int i = 0; i < 70; i++) {
        JoAgentDef agent = jo_default_agent_def();
        agent.x = 1 + i % 10;
        agent.y = 6 + i / 10;
        if (jo_world_add_agent(world, &agent, error).generation == 0)
            return false;
    }
    JoBodyDef box = jo_default_body_def();
    box.x = 8, box.y = 2;
    if (jo_world_add_body(world, &box, error).generation == 0)
        return false;
    jo_world_step(world, 3);
    if (jo_world_failure(world)) {
        assert_int_equal(jo_world_hash(world), 0);
        assert_int_equal(jo_world_agents(world, NULL, 0), 0);
        return no_memory(error);
    }
    return jo_world_hash(world) != 0 || no_memory(error);
}

static bool by_hand(uint32_t threads, JoError *error) {
    JoWorldDef def = jo_default_world_def();
    def.threads = threads;
    JoWorld *world = jo_world_create(&def, error);
    bool good = world && run_by_hand(world, error);
    if (world && !good) { /* it has failed for good, and says so without harm */
        JoAgentDef agent = jo_default_agent_def();
        JoError again = {0};
        jox_alloc_fail_after(UINT64_MAX);
        assert_string_equal(jo_world_failure(world), "out of memory");
        assert_int_equal(jo_world_add_agent(world, &agent, &again).generation, 0);
        assert_string_equal(again.text, "out of memory");
    }
    jo_world_free(world);
    return good;
}

static bool world_alone(JoError *error) {
    return by_hand(1, error);
}

static bool world_of_threads(JoError *error) {
    return by_hand(3, error);
}

static bool use_scene(JoScene *scene, JoError *error) {
    for (int i = 0; i < 3; i++)
        if (!jo_scene_step(scene, error))
            return false;
    if (!jo_scene_signal(scene, "hello", error))
        return false;
    char *summary = jo_scene_summary(scene);
    if (!summary)
        return no_memory(error);
    jo_free(summary);
    JoFigures *figures = jo_scene_figures(scene);
    JoTroubles *troubles = figures ? jo_scene_troubles(scene) : NULL;
    JoLuaCosts *costs = troubles ? jo_scene_lua_costs(scene) : NULL;
    const bool complete = figures && troubles && costs;
    jo_free(figures);
    jo_free(troubles);
    jo_free(costs);
    if (!complete)
        return no_memory(error);
    char *seen = jo_scene_inspect(scene, 0);
    if (!seen)
        return no_memory(error);
    jo_free(seen);
    return jo_scene_finish(scene, error);
}

static bool scene(JoError *error) {
    JoSceneDef def = jo_default_scene_def();
    def.path = "memory.yaml";
    def.text = SCENE;
    def.text_length = sizeof SCENE - 1;
    def.message = keep;
    JoScene *scene = jo_scene_load(&def, error);
    bool good = scene && use_scene(scene, error);
    jo_scene_free(scene);
    return good;
}

static char folder[] = "/tmp/jostle-memory-XXXXXX";
static char recording[64];

static bool recorded(JoError *error) {
    JoSceneDef def = jo_default_scene_def();
    def.path = "memory.yaml";
    def.text = SCENE;
    def.text_length = sizeof SCENE - 1;
    def.message = keep;
    JoScene *scene = jo_scene_load(&def, error);
    bool good = scene && jo_scene_record(scene, recording, 0.0, error) &&
                jo_scene_data(scene, folder, error) && use_scene(scene, error);
    jo_scene_free(scene);
    return good;
}

static bool report(JoError *error) {
    JoReportDef def = jo_default_report_def();
    def.recording = recording;
    def.message = keep;
    char *text = jo_report(&def, error);
    jo_free(text);
    return text != NULL;
}

static bool check(JoError *error) {
    const char *paths[] = {"behaviours/pedestrian.lua", "scenes/circle.yaml"};
    *told = 0;
    return jo_check(paths, 2, false, keep, NULL, error) == 0;
}

static bool pages(JoError *error) {
    char *page = jo_reference("scenes");
    jo_free(page);
    return page || no_memory(error);
}

static void worlds(void **state) {
    (void)state;
    sweep("a world", world_alone, UINT64_MAX, 1);
    sweep("a world of three threads", world_of_threads, 20, 7);
}

static void scenes(void **state) {
    (void)state;
    sweep("a scene", scene, UINT64_MAX, 1);
}

static void recordings(void **state) {
    (void)state;
    sweep("a recording", recorded, 0, 23);
    sweep("a report", report, UINT64_MAX, 1);
}

static void checks(void **state) {
    (void)state;
    sweep("a check", check, 200, 19);
    sweep("a reference", pages, UINT64_MAX, 1);
}

int main(void) {
    assert_non_null(mkdtemp(folder));
    snprintf(recording, sizeof recording, "%s/run.sqlite", folder);
    const struct CMUnitTest tests[] = {cmocka_unit_test(worlds), cmocka_unit_test(scenes),
                                       cmocka_unit_test(recordings), cmocka_unit_test(checks)};
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    char command[128];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command) == 0 ? failed : 1;
}
