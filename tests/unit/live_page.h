/* Loads scenes from files and from texts in the test, steps them, and reloads their behaviours
   while they run. Shared by tests of runs and of the live page. */
#ifndef JOX_TESTS_HOST_LIVE_H
#define JOX_TESTS_HOST_LIVE_H

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
#include "run/run.h"

/* Messages of the scene that was loaded last. */
static JoxText said;
static char why[256];
static char folder[] = "/tmp/jostle-reload-XXXXXX";

static void collect_message(void *context, const char *text) {
    (void)context;
    jox_text_add(&said, text);
}

static JoScene *load(const char *path, const char *const *sets, size_t count) {
    JoSceneDef def = jo_default_scene_def();
    def.path = path;
    def.overrides = sets;
    def.override_count = count;
    def.message = collect_message;
    def.named_mods_only = true;
    def.no_density = true;
    JoError error = {0};
    jox_text_free(&said);
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene)
        fail_msg("%s: %s", path, error.text);
    return scene;
}

static inline void write_file(const char *name, const char *text) {
    char path[300];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/* Loads a scene from the text of a scene and of its behaviour own.lua. */
static inline JoScene *load_own(const char *scene, const char *behaviour) {
    char path[300];
    write_file("own.lua", behaviour);
    write_file("scene.yaml", scene);
    snprintf(path, sizeof path, "%s/scene.yaml", folder);
    return load(path, NULL, 0);
}

static void step(JoScene *scene, int steps) {
    JoError error = {0};
    for (int i = 0; i < steps; i++)
        if (!jo_scene_step(scene, &error))
            fail_msg("%s", error.text);
}

/* Replaces a machine by a new text of its behaviour, as the watching thread and the step do
   together. False with the reason in `why` if the text is refused. */
static bool replace_behaviour_text(JoScene *scene, uint32_t index, const char *text,
                                   size_t length) {
    JoxMachineRun *machines = &scene->world->machines;
    const JoxMachine *now = machines->set->items[index];
    JoxDiagnostics diagnostics = {0};
    JoxLoaded *loaded =
        jox_lua_prepare(scene->lua, now->path, text, length, &scene->scope, &diagnostics);
    JoxMachine *next = jox_loaded_machine(loaded);
    snprintf(why, sizeof why, "%s", diagnostics.count && !next ? diagnostics.items[0].message : "");
    assert_int_equal(next == NULL, diagnostics.errors > 0); /* each failure has an error */
    jox_diag_free(&diagnostics);
    bool live = false;
    if (next) {
        JoxReplacement *replacement = jox_replacement_prepare(
            now, next, scene->world->model.def.seed, scene->world->state.agents.next_id);
        live = !jox_machines_refuses(machines, index, replacement, why, sizeof why);
        if (live) {
            JoxMachine *old = jox_machines_replace(machines, index, replacement);
            JoxLoaded *retired = jox_lua_retire(scene->lua, old);
            jox_lua_adopt(scene->lua, loaded);
            assert_true(jox_run_link(scene, next, &diagnostics));
            jox_replacement_free(replacement);
            jox_loaded_free(retired);
        } else {
            jox_replacement_free(replacement);
        }
    }
    jox_loaded_free(loaded);
    return live;
}

static inline bool reload_text(JoScene *scene, uint32_t index, const char *text) {
    return replace_behaviour_text(scene, index, text, strlen(text));
}

#define SCENE(groups)                                                                              \
    "jostle: 1\n"                                                                                  \
    "places: {yard: {polygon: [[0, 0], [40, 0], [40, 40], [0, 40]]}}\n" groups
#define PEOPLE(count)                                                                              \
    SCENE("groups: {people: {behaviour: own.lua, count: " #count ", fill: grid, in: yard}}\n")
#define HEAD "return machine { name = \"m\", start = "

/* Wanted speed of the agent at an index, m/s. */
static inline double read_wanted_speed(const JoScene *scene, uint32_t agent) {
    return (double)jox_param(&scene->world->state.agents, JOX_PARAM_speed, agent);
}

/* Behaviour of one state with a wanted speed and further members `more`. */
#define FAST(speed, more)                                                                          \
    HEAD "\"A\", defaults = { speed = " speed " }, states = { A = { steer = hold" more " } } }\n"

static int make_folder(void **state) {
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state) {
    (void)state;
    const char *const names[] = {"own.lua", "scene.yaml"};
    for (int i = 0; i < 2; i++) {
        char path[300];
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    jox_text_free(&said);
    return rmdir(folder);
}

#endif
