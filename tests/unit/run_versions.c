/* New versions of behaviours that bring names with them: tags and teams that no group of the scene
 * has. */
#include "unit/live_page.h"

#define TWO                                                                                        \
    "jostle: 1\ngroups: {p: {behaviour: own.lua, at: [[0, 0], [2, 0]], team: red, tags: "          \
    "[folk]}}\n"
/* A machine of which everybody does what an action says after a fifth of a second. */
#define TURNS(when, set)                                                                           \
    HEAD "\"A\", states = { A = { steer = hold, { to = \"B\", when = " when ", set = { " set       \
         " } } }, B = { steer = hold } } }\n"

/* As an input log, or the watch, swaps the file: the way that a run takes it. */
static bool save(JoScene *scene, const char *text, JoError *error) {
    const char *path = scene->world->model.machines.items[0]->path;
    JoxInputFile file = {.path = (char *)path, .text = (char *)text, .length = strlen(text)};
    JoxInputEntry entry = {.number = 1, .files = &file};
    jox_overlay_put(&scene->overlay, path, text, file.length);
    const JoxOverlay *before = jox_overlay_use(&scene->overlay);
    const bool live = jox_run_reload_now(scene, &entry, error);
    jox_overlay_use(before);
    return live;
}

static JoScene *load_resumable(const char *behaviour) {
    char path[300];
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    write_file("own.lua", behaviour);
    write_file("scene.yaml", TWO);
    snprintf(path, sizeof path, "%s/scene.yaml", folder);
    def.path = path;
    def.message = hear;
    def.named_mods_only = def.resumable = true;
    jox_text_free(&said);
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene)
        fail_msg("%s", error.text);
    return scene;
}

/* A checkpoint of a scene, gone on from in another one. */
static JoScene *resume(JoScene *scene) {
    char target[320];
    char *note = NULL;
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    def.message = hear;
    snprintf(target, sizeof target, "%s/checkpoints/latest.checkpoint", folder);
    step(scene, 1); /* at which one is due */
    JoScene *next = jo_scene_resume(&def, target, &note, &error);
    if (!next)
        fail_msg("%s", error.text);
    jo_free(note);
    return next;
}

static void keep_checkpoints(JoScene *scene) {
    char target[320];
    JoError error = {0};
    snprintf(target, sizeof target, "%s/checkpoints", folder);
    if (!jo_scene_checkpoint(scene, target, 0.05, "", &error))
        fail_msg("%s", error.text);
}

static const char *tag_of(const JoScene *scene, uint32_t agent) {
    const uint64_t tags = scene->world->state.agents.tags[agent];
    for (uint32_t t = 0; t < scene->world->model.tag_count; t++)
        if (tags >> t & 1)
            return scene->world->model.tags[t];
    return "";
}

static void tag_and_team_that_a_state_sets_are_known(void **state) {
    (void)state;
    JoScene *scene = load_own(TWO, TURNS("sees(nearest \"folk\") & ~sees(nearest \"ill\")",
                                         "tags = { \"ill\", \"folk\" }, team = \"undead\""));
    const JoxAgents *a = &scene->world->state.agents;
    step(scene, 2);
    assert_int_equal(a->state[0], 1);
    assert_int_equal(a->tags[0], 3);
    assert_int_equal(a->team[0], JOX_FIRST_SET_TEAM);
    assert_true(a->team[0] == a->team[1]);
    jo_scene_free(scene);
}

static void tag_that_nobody_bears_or_sets_is_refused(void **state) {
    (void)state;
    char path[300];
    JoError error = {0};
    write_file("own.lua", TURNS("sees(nearest \"il\")", "tags = \"ill\""));
    write_file("scene.yaml", TWO);
    snprintf(path, sizeof path, "%s/scene.yaml", folder);
    JoSceneDef def = jo_default_scene_def();
    def.path = path;
    def.message = hear;
    def.named_mods_only = true;
    assert_null(jo_scene_load(&def, &error));
    assert_non_null(strstr(error.text, "'il'"));
    JoScene *scene = load_own(TWO, TURNS("after(9)", "tags = \"folk\""));
    assert_false(save(scene, TURNS("sees(nearest \"il\")", "tags = \"folk\""), &error));
    assert_int_equal(scene->world->model.tag_count, 1);
    jo_scene_free(scene);
}

static void misspelt_tag_and_team_are_warned_of(void **state) {
    (void)state;
    JoScene *scene =
        load_own(TWO, TURNS("sees(nearest \"folk\")", "tags = \"fol\", team = \"rde\""));
    assert_non_null(strstr(said.data, "nothing asks for the tag 'fol'"));
    assert_non_null(strstr(said.data, "no group of the scene has the team 'rde'"));
    assert_non_null(strstr(said.data, "Did you mean 'red'?"));
    jo_scene_free(scene);
}

/* Numbers of tags follow from all versions that ran, and not from the last one alone. */
static void run_with_new_tags_resumes_exactly(void **state) {
    (void)state;
    JoError error = {0};
    JoScene *scene = load_resumable(TURNS("after(9)", "tags = \"ill\", team = \"one\""));
    keep_checkpoints(scene);
    step(scene, 3);
    assert_true(save(scene, TURNS("after(0.1)", "tags = \"well\", team = \"two\""), &error));
    step(scene, 5);
    assert_string_equal(tag_of(scene, 0), "well");
    JoScene *next = resume(scene);
    assert_string_equal(tag_of(next, 0), "well");
    assert_int_equal(next->world->state.agents.team[0], JOX_FIRST_SET_TEAM + 1);
    assert_true(jo_world_hash(next->world) == jo_world_hash(scene->world));
    assert_true(
        save(scene, TURNS("sees(nearest \"well\")", "tags = { \"ill\", \"well\" }"), &error));
    assert_true(
        save(next, TURNS("sees(nearest \"well\")", "tags = { \"ill\", \"well\" }"), &error));
    step(scene, 9);
    step(next, 9);
    assert_true(jo_world_hash(next->world) == jo_world_hash(scene->world));
    jo_scene_free(next);
    jo_scene_free(scene);
}

static int remove_all(void **state) {
    static const char *const NAMES[] = {"latest.checkpoint", "before.checkpoint"};
    char path[340];
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/checkpoints/%s", folder, NAMES[i]);
        unlink(path);
    }
    snprintf(path, sizeof path, "%s/checkpoints", folder);
    rmdir(path);
    return remove_folder(state);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tag_and_team_that_a_state_sets_are_known),
        cmocka_unit_test(tag_that_nobody_bears_or_sets_is_refused),
        cmocka_unit_test(misspelt_tag_and_team_are_warned_of),
        cmocka_unit_test(run_with_new_tags_resumes_exactly),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_all);
}
