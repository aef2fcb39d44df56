/* Loads scenes from files and from texts in the test, steps them, and replaces their behaviours
   while they run. Shared by tests of runs and of the live page. */
#ifndef JOX_TESTS_SCENE_LOADER_H
#define JOX_TESTS_SCENE_LOADER_H

#include "base/mem.h"
#include "messages.h"
#include "run/read_scene.h"
#include "run/reload.h"
#include "run/run.h"
#include "run/scene_machines.h"
#include "unit/test_folder.h"

/* Messages of the scenes since the last load. */
static JoxText scene_messages;
/* Reason of the last refusal of a behaviour's text. */
static char refusal[256];

/* Definition of a scene whose messages are collected, without mods of the user's. */
static inline JoSceneDef define_scene(const char *path) {
    JoSceneDef def = jo_default_scene_def();
    def.path = path;
    def.message = append_message;
    def.message_context = &scene_messages;
    def.named_mods_only = true;
    jox_text_free(&scene_messages);
    return def;
}

static inline JoScene *load_defined_scene(const JoSceneDef *def) {
    JoError error = {0};
    JoScene *scene = jo_scene_load(def, &error);
    if (!scene)
        fail_msg("%s: %s", def->path, error.text);
    return scene;
}

/* Loads a file with values in place of some of its own (`jostle run --set`), without densities. */
static inline JoScene *load_scene_file(const char *path, const char *const *sets, size_t count) {
    JoSceneDef def = define_scene(path);
    def.overrides = sets;
    def.override_count = count;
    def.no_density = true;
    return load_defined_scene(&def);
}

/* Loads a scene from the text of a scene and of its behaviour own.lua. */
static inline JoScene *load_scene_text(const char *scene, const char *behaviour) {
    write_test_file("own.lua", behaviour);
    return load_scene_file(write_test_file("scene.yaml", scene), NULL, 0);
}

static inline void step_scene(JoScene *scene, int steps) {
    JoError error = {0};
    for (int i = 0; i < steps; i++)
        if (!jo_scene_step(scene, &error))
            fail_msg("%s", error.text);
}

/* Steps by the whole number of steps that is nearest to `seconds`. */
static inline void step_scene_seconds(JoScene *scene, double seconds) {
    step_scene(scene, (int)(seconds / scene->world->model.def.dt + 0.5));
}

static inline JoxPose find_body_pose(const JoScene *scene, const char *name) {
    const JoxBodies *bodies = scene->world->state.bodies;
    JoxPose pose;
    assert_true(jox_bodies_pose(bodies, jox_bodies_find_name(bodies, name), &pose));
    return pose;
}

/* Writes another text of the scene's file, and applies it to the running scene as a reload does. */
static inline void edit_scene(JoScene *scene, const char *text) {
    JoxDiagnostics diagnostics = {0};
    write_test_file("scene.yaml", text);
    JoxSceneSpec *spec = jox_run_load_spec(&scene->def, scene->mods, 0, &diagnostics);
    assert_non_null(spec);
    jox_text_free(&scene_messages);
    jox_run_reload_scene(scene, &spec, 0.0);
    jox_scene_free(spec);
    jox_diag_free(&diagnostics);
}

/* Replaces a machine by a new text of its behaviour, as the watching thread and the step do
   together. False with the reason in `refusal` if the text is refused. */
static inline bool replace_behaviour_text(JoScene *scene, uint32_t index, const char *text,
                                          size_t length) {
    JoxMachineRun *machines = &scene->world->machines;
    const JoxMachine *now = machines->set->items[index];
    JoxDiagnostics diagnostics = {0};
    JoxLoaded *loaded =
        jox_lua_prepare(scene->lua, now->path, text, length, &scene->scope, &diagnostics);
    JoxMachine *next = jox_loaded_machine(loaded);
    snprintf(refusal, sizeof refusal, "%s",
             diagnostics.count && !next ? diagnostics.items[0].message : "");
    assert_int_equal(next == NULL, diagnostics.errors > 0); /* each failure has an error */
    jox_diag_free(&diagnostics);
    bool live = false;
    if (next) {
        JoxReplacement *replacement = jox_replacement_prepare(
            now, next, scene->world->model.def.seed, scene->world->state.agents.next_id);
        live = !jox_machines_refuses(machines, index, replacement, refusal, sizeof refusal);
        if (live) {
            JoxMachine *old = jox_machines_replace(machines, index, replacement);
            JoxLoaded *retired = jox_lua_retire(scene->lua, old);
            jox_lua_adopt(scene->lua, loaded);
            assert_true(jox_run_link_becomes(scene, next, &diagnostics));
            jox_replacement_free(replacement);
            jox_loaded_free(retired);
        } else {
            jox_replacement_free(replacement);
        }
    }
    jox_loaded_free(loaded);
    return live;
}

static inline bool reload_behaviour(JoScene *scene, uint32_t index, const char *text) {
    return replace_behaviour_text(scene, index, text, strlen(text));
}

/* Text of a scene with a yard of 40 x 40 m; the same with people of own.lua on a grid; and the text
   of a behaviour up to the name of its start state. */
#define YARD_SCENE(groups)                                                                         \
    "jostle: 1\n"                                                                                  \
    "places: {yard: {polygon: [[0, 0], [40, 0], [40, 40], [0, 40]]}}\n" groups
#define YARD_WITH_PEOPLE(count)                                                                    \
    YARD_SCENE("groups: {people: {behaviour: own.lua, count: " #count ", fill: grid, in: "         \
               "yard}}\n")
#define MACHINE_START "return machine { name = \"m\", start = "

/* Wanted speed of the agent at an index, m/s. */
static inline double read_wanted_speed(const JoScene *scene, uint32_t agent) {
    return (double)jox_param(&scene->world->state.agents, JOX_PARAM_speed, agent);
}

/* Behaviour with one state that stands; its wanted speed, and more keys of the state. */
#define STANDING_AT_SPEED(speed, more)                                                             \
    MACHINE_START "\"A\", defaults = { speed = " speed " }, states = { A = { steer = hold" more    \
                  " } } }\n"

/* Teardown of tests that load scenes. */
static inline int remove_scene_folder(void **state) {
    jox_text_free(&scene_messages);
    return remove_test_folder(state);
}

#endif
