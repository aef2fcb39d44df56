/* jo_test: runs test files and prints or writes their results. Implements the driver by which tests
   load and step scenes (test_file.h). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/format/json_writer.h"
#include "base/format/path.h"
#include "base/guard.h"
#include "base/mem.h"
#include "jostle_tools.h"
#include "luatest/test_file.h"
#include "run/load_scene.h"
#include "run/run.h"

typedef struct Tests {
    JoMessage *message;
    void *context;
    bool json;
    JoxText results;  /* with `json`: the results, a JSON array, */
    JoxJson array;    /* and its writer */
    const char *only; /* runs tests whose names contain it; NULL: all */
    size_t passed, failed;
    bool broken;     /* a file could not be read or run, or there are no tests */
    char folder[96]; /* temporary folder of behaviours that tests contain; "" until needed */
    char **kept;     /* paths of their files */
    size_t kept_count, kept_capacity;
    JoxText said; /* messages of the loaded scene */
} Tests;

enum { MOST_KEPT = 200, LARGEST_KEPT = 256 << 10 };

/* ---- the driver ---- */

static void keep_message(void *context, const char *text) {
    Tests *tests = context;
    if (tests->said.length < 100000)
        jox_text_add(&tests->said, text);
}

/* Finds a scene's file: relative to the test's folder, or to ../scenes/ or ../../scenes/ from
   there; or relative to the working folder, or in its scenes/. The caller frees the path. */
static char *find_scene(const JoxTestScene *scene, const char *test) {
    static const char *const FOLDERS[] = {"", "../scenes/", "../../scenes/", NULL};
    static const char *const TREE[] = {"scenes/", NULL};
    char path[JOX_LONGEST_PATH];
    const bool found = jox_path_find(test, scene->path, "", FOLDERS, path) ||
                       jox_path_find("", scene->path, "", TREE, path);
    return jox_strdup(found ? path : scene->path);
}

typedef struct TestContext {
    Tests *tests;
    const char *path; /* the test's file */
} TestContext;

/* Loads a scene for a test, with the mods that the test names and no others; NULL with the
   errors. */
static void *load_driven_scene(void *context, const JoxTestScene *wanted, JoxText *why) {
    const TestContext *c = context;
    JoSceneDef def = jo_default_scene_def();
    char *path = wanted->text ? jox_strdup(wanted->path) : find_scene(wanted, c->path);
    JoxDiagnostics diagnostics = {0};
    def.path = path;
    def.text = wanted->text;
    def.text_length = wanted->length;
    def.overrides = wanted->sets;
    def.override_count = wanted->set_count;
    def.mods = wanted->mods;
    def.mod_count = wanted->mod_count;
    def.named_mods_only = true;
    def.no_density = true;
    def.has_seed = wanted->has_seed;
    def.seed = wanted->seed;
    def.has_dt = wanted->has_dt;
    def.dt = wanted->dt;
    def.threads = wanted->threads;
    def.message = keep_message;
    def.message_context = c->tests;
    c->tests->said.length = 0;
    JoScene *scene = jox_run_load(&def, &diagnostics);
    for (size_t d = 0; d < diagnostics.count && !scene; d++) {
        const JoxDiagnostic *item = &diagnostics.items[d];
        bool generated = wanted->text && item->file && !strcmp(item->file, wanted->path);
        if (!generated && item->file) /* positions in generated text mean nothing to the user */
            jox_text_printf(why, "%s:%d:%d: ", item->file, item->line, item->column);
        jox_text_printf(why, "%s%s%s\n", item->message, item->hint ? ". " : "",
                        item->hint ? item->hint : "");
    }
    jox_diag_free(&diagnostics);
    if (scene && scene->mod_problems.errors) { /* all mods that a test names must apply */
        jox_text_add(why, scene->mod_problems.items[0].message);
        jo_scene_free(scene);
        scene = NULL;
    }
    jox_free(path);
    return scene;
}

static void free_driven_scene(void *context, void *scene) {
    (void)context;
    jo_scene_free(scene);
}

/* Steps a scene. A failed Lua function of a behaviour fails the test, though in a run it would only
   leave its agents unchanged. */
static bool step_driven_scene(void *context, void *scene, JoxText *why) {
    Tests *tests = ((TestContext *)context)->tests;
    const JoxMachineState *machines = ((JoScene *)scene)->world->machines.state;
    const uint64_t failures = machines->hook_failures;
    JoError error = {0};
    if (!jo_scene_step(scene, &error)) {
        jox_text_add(why, error.text);
        return false;
    }
    if (machines->hook_failures == failures)
        return true;
    jox_text_printf(why, "a function of a behaviour failed:\n%s",
                    tests->said.data ? tests->said.data : "");
    return false;
}

static const JoxMachineRun *find_driven_machines(void *context, void *scene) {
    (void)context;
    return &((JoScene *)scene)->world->machines;
}

static double read_driven_time(void *context, void *scene) {
    (void)context;
    return jo_world_time(((JoScene *)scene)->world);
}

static uint64_t hash_driven_scene(void *context, void *scene) {
    (void)context;
    return jox_world_hash(((JoScene *)scene)->world);
}

static int32_t find_driven_group(void *context, void *scene, const char *name) {
    (void)context;
    const JoxSceneSpec *spec = ((JoScene *)scene)->spec;
    for (uint32_t g = 0; g < spec->group_count; g++)
        if (strcmp(spec->groups[g].name, name) == 0)
            return (int32_t)g;
    return -1;
}

static bool find_driven_body(void *context, void *scene, const char *name, double out[6]) {
    (void)context;
    const JoxBodies *bodies = ((JoScene *)scene)->world->state.bodies;
    JoxPose pose;
    uint32_t row = jox_bodies_find_name(bodies, name);
    if (row == JOX_NO_BODY || !jox_bodies_pose(bodies, row, &pose))
        return false;
    const double numbers[6] = {pose.centre.x,   pose.centre.y,   pose.centre.z,
                               pose.velocity.x, pose.velocity.y, pose.velocity.z};
    memcpy(out, numbers, sizeof numbers);
    return true;
}

static bool explain_driven_scene(void *context, void *scene, const JoxTestQuestion *question,
                                 JoxText *out) {
    (void)context;
    JoWhyDef def = jo_default_why_def();
    JoError error = {0};
    def.has_agent = question->agent >= 0;
    def.agent = question->agent > UINT32_MAX ? UINT32_MAX : (uint32_t)question->agent;
    def.group = question->group;
    def.state = question->state;
    def.to = question->to;
    char *text = jo_scene_why(scene, &def, &error);
    jox_text_add(out, text ? text : error.text);
    jo_free(text);
    return text != NULL;
}

static const char *name_driven_group(void *context, void *scene, int32_t group) {
    (void)context;
    const JoxSceneSpec *spec = ((JoScene *)scene)->spec;
    return group < 0 || (uint32_t)group >= spec->group_count ? NULL : spec->groups[group].name;
}

static const char *name_driven_team(void *context, void *scene, uint16_t team) {
    const JoScene *of = scene;
    (void)context;
    if (team >= JOX_FIRST_SET_TEAM)
        return of->world->model.set_teams[team - JOX_FIRST_SET_TEAM];
    return team > 0 && team <= of->spec->group_count ? of->spec->groups[team - 1].team : NULL;
}

/* Writes a behaviour that a test contains to a temporary file, since scenes refer to files. */
static const char *keep_behaviour(void *context, const char *text, size_t length) {
    Tests *tests = ((TestContext *)context)->tests;
    char path[160];
    if (tests->kept_count >= MOST_KEPT || length > LARGEST_KEPT)
        return NULL;
    if (!*tests->folder) {
        const char *usual = getenv("TMPDIR");
        snprintf(tests->folder, sizeof tests->folder, "%.60s/jostle-test-XXXXXX",
                 usual && *usual == '/' && strlen(usual) <= 60 ? usual : "/tmp");
        bool made = mkdtemp(tests->folder) != NULL;
        snprintf(path, sizeof path, "%s/behaviours", tests->folder); /* its parent has no scenes */
        if (!made || mkdir(path, 0700) != 0) {
            *tests->folder = 0;
            return NULL;
        }
    }
    snprintf(path, sizeof path, "%s/behaviours/inline-%zu.lua", tests->folder,
             tests->kept_count + 1);
    FILE *file = jox_file_replace(path);
    bool good = file && fwrite(text, 1, length, file) == length;
    if (!file || jox_file_close(file) != 0 || !good)
        return NULL;
    JOX_RESERVE(tests->kept, tests->kept_capacity, tests->kept_count + 1);
    return tests->kept[tests->kept_count++] = jox_strdup(path);
}

/* ---- results ---- */

static void report_test_result(void *context, const JoxTestResult *result) {
    Tests *tests = context;
    JoxText text = {0};
    *(result->passed ? &tests->passed : &tests->failed) += 1;
    if (tests->json) {
        JoxJson *json = &tests->array;
        jox_json_object(json, NULL);
        jox_json_string(json, "file", result->file);
        jox_json_integer(json, "line", result->line);
        jox_json_string(json, "name", result->name);
        jox_json_bool(json, "passed", result->passed);
        jox_json_digits(json, "simulated_s", result->simulated, 6);
        jox_json_string(json, "message", result->message);
        jox_json_end(json);
        return;
    }
    jox_text_printf(&text, "%s %s (%.1f s simulated in %.2f s)\n", result->passed ? "ok" : "not ok",
                    result->name, result->simulated, result->seconds);
    jox_text_add(&text, result->message);
    jox_run_send_message(tests->message, tests->context, text.data);
    jox_text_free(&text);
}

static void print_test_output(void *context, const char *text) {
    const Tests *tests = context;
    if (!tests->json)
        jox_run_send_message(tests->message, tests->context, text);
}

/* Removes the files of behaviours that the tests of a file contain. */
static void remove_kept(Tests *tests) {
    for (size_t k = 0; k < tests->kept_count; k++) {
        unlink(tests->kept[k]);
        jox_free(tests->kept[k]);
    }
    tests->kept_count = 0;
}

static void run_test_file(Tests *tests, const char *path) {
    TestContext context = {tests, path};
    const JoxTestDriver driver = {.load = load_driven_scene,
                                  .free = free_driven_scene,
                                  .step = step_driven_scene,
                                  .machines = find_driven_machines,
                                  .time = read_driven_time,
                                  .hash = hash_driven_scene,
                                  .group = find_driven_group,
                                  .body = find_driven_body,
                                  .why = explain_driven_scene,
                                  .group_name = name_driven_group,
                                  .team_name = name_driven_team,
                                  .keep = keep_behaviour,
                                  .context = &context};
    JoxDiagnostics diagnostics = {0};
    if (!jox_lua_test(path, tests->only, &driver, report_test_result, tests, print_test_output,
                      tests, &diagnostics))
        tests->broken = true;
    for (size_t d = 0; tests->json && d < diagnostics.count; d++) {
        const JoxDiagnostic *item = &diagnostics.items[d];
        JoxTestResult failed = {
            .file = path, .name = "", .message = item->message, .line = item->line};
        report_test_result(tests, &failed);
    }
    if (tests->json)
        jox_diag_free(&diagnostics);
    else
        jox_run_report_diagnostics(tests->message, tests->context, &diagnostics, NULL);
    remove_kept(tests);
}

static bool is_test_file(const char *name) {
    size_t n = strlen(name);
    return n > 9 && strcmp(name + n - 9, "_test.lua") == 0;
}

/* Runs a file, or all files of a folder that end with _test.lua. */
static void run_test_path(Tests *tests, const char *path) {
    struct stat info;
    if (stat(path, &info) != 0 || !S_ISDIR(info.st_mode)) {
        run_test_file(tests, path);
        return;
    }
    char **names = jox_folder_names(path, false);
    for (char **name = names; name && *name; name++) {
        char inner[1024];
        snprintf(inner, sizeof inner, "%s/%s", path, *name);
        if (is_test_file(*name))
            run_test_file(tests, inner);
    }
    jox_free(names);
}

static bool run_test_paths(const char *const *paths, size_t count, const char *only, bool json,
                           JoMessage *message, void *context, size_t *passed, size_t *failed) {
    Tests tests = {.message = message, .context = context, .json = json, .only = only};
    tests.array = jox_json_begin(&tests.results, 1);
    jox_json_array(&tests.array, NULL);
    for (size_t p = 0; p < count; p++)
        run_test_path(&tests, paths[p]);
    if (!json && tests.passed + tests.failed == 0 && !tests.broken) {
        jox_run_send_message(message, context,
                             "no tests found: files that end with _test.lua hold them\n");
        tests.broken = true;
    }
    if (json) {
        jox_json_end(&tests.array);
        jox_text_append(&tests.results, "\n", 1);
        jox_run_send_message(message, context, tests.results.data);
    }
    if (*tests.folder) {
        char inner[128];
        snprintf(inner, sizeof inner, "%s/behaviours", tests.folder);
        rmdir(inner);
        rmdir(tests.folder);
    }
    jox_free(tests.kept);
    jox_text_free(&tests.results);
    jox_text_free(&tests.said);
    *passed = tests.passed;
    *failed = tests.failed;
    return !tests.broken;
}

bool jo_test(const char *const *paths, size_t count, const char *only, bool json,
             JoMessage *message, void *context, size_t *passed, size_t *failed, JoError *error) {
    JOX_REQUIRE(paths && message && passed && failed, false);
    JOX_GUARD (NULL, error)
        return false;
    return run_test_paths(paths, count, only, json, message, context, passed, failed);
}
