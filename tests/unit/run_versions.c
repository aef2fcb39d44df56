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
    char path[300]; /* its own: that of the machine goes with the machine */
    snprintf(path, sizeof path, "%s", scene->world->model.machines.items[0]->path);
    JoxInputFile file = {.path = path, .text = (char *)text, .length = strlen(text)};
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
    def.message = collect_message;
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
    def.message = collect_message;
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
    def.message = collect_message;
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

/* ---- names that a version lacks ---- */

#define LAPS "local mine = memory { laps = 0, met = false }\n"
#define COUNTING                                                                                   \
    LAPS HEAD                                                                                      \
        "\"A\", own = { luck = uniform(0, 1) }, states = { A = { steer = hold, "                   \
        "{ to = \"A\", when = after(0.1), set = { laps = mine.laps + 1, met = true } } } } }\n"
#define RESTING HEAD "\"A\", states = { A = { steer = hold } } }\n"

static double remembered(const JoScene *scene, uint32_t agent, const char *name) {
    const JoxMachine *m = scene->world->machines.set->items[0];
    const int32_t slot = jox_machine_memory(m, name);
    const JoxAgents *a = &scene->world->state.agents;
    return slot < 0 ? -1.0 : a->memory[(size_t)agent * a->memory_stride + (uint32_t)slot];
}

static void save_live(JoScene *scene, const char *text) {
    JoError error = {0};
    jox_text_free(&said);
    if (!save(scene, text, &error))
        fail_msg("%s: %s", error.text, said.data);
}

static void memory_that_a_version_lacks_is_kept_and_told(void **state) {
    (void)state;
    JoScene *scene = load_own(TWO, COUNTING);
    step(scene, 40);
    const double laps = remembered(scene, 1, "laps");
    assert_true(laps >= 8.0 && remembered(scene, 1, "met") == 1.0);
    save_live(scene, RESTING);
    assert_non_null(strstr(said.data, "memory 'laps' of 2 people is kept until"));
    assert_true(remembered(scene, 1, "laps") == -1.0);
    step(scene, 5);
    save_live(scene, FAST("1", ""));
    assert_null(strstr(said.data, "laps")); /* told once */
    step(scene, 5);
    save_live(scene, COUNTING);
    assert_non_null(strstr(said.data, "memory 'laps' of 2 people has the value again"));
    assert_true(remembered(scene, 1, "laps") == laps && remembered(scene, 1, "met") == 1.0);
    jo_scene_free(scene);
}

static void memory_of_another_type_is_told_and_comes_back(void **state) {
    (void)state;
    JoScene *scene = load_own(TWO, COUNTING);
    step(scene, 40);
    const double laps = remembered(scene, 0, "laps");
    save_live(scene, "memory { laps = false, met = false }\n" RESTING);
    assert_non_null(strstr(said.data, "memory 'laps' was a number and is true or false now"));
    assert_true(remembered(scene, 0, "laps") == 0.0 && remembered(scene, 0, "met") == 1.0);
    save_live(scene, LAPS RESTING);
    assert_true(remembered(scene, 0, "laps") == laps);
    jo_scene_free(scene);
}

#define RING                                                                                       \
    "jostle: 1\nplaces: {hub: {point: [0, 0]}}\n"                                                  \
    "groups: {p: {behaviour: own.lua, at: [[3, 0]], facing: 90}}\n"
#define ORBIT(counts, more)                                                                        \
    "local mine = memory { laps = 0 }\nreturn machine { name = \"m\", start = \"A\", " counts      \
    "states = { A = { steer = orbit \"hub\"" more " } } }\n"

/* What a counter has turned so far goes on with it, and is nobody's post meanwhile. */
static void counter_goes_on_where_it_was(void **state) {
    (void)state;
    JoScene *scene = load_own(RING, ORBIT("counts = { laps = circuits \"hub\" }, ", ""));
    step(scene, 150);
    const JoxAgents *a = &scene->world->state.agents;
    const JoxMachine *m = scene->world->machines.set->items[0];
    const double angle = a->memory[m->counters[0].angle];
    assert_true(angle > 1.0);
    save_live(scene, ORBIT("", ", face = home"));
    m = scene->world->machines.set->items[0];
    assert_true(a->memory[m->home - 1] == (double)a->x[0]); /* set now, and no angle of a counter */
    save_live(scene, ORBIT("counts = { laps = circuits \"hub\" }, ", ""));
    m = scene->world->machines.set->items[0];
    assert_true(a->memory[m->counters[0].angle] == angle);
    jo_scene_free(scene);
}

static void run_with_dormant_memory_resumes_exactly(void **state) {
    (void)state;
    JoScene *scene = load_resumable(COUNTING);
    keep_checkpoints(scene);
    step(scene, 40);
    const double laps = remembered(scene, 1, "laps");
    save_live(scene, RESTING);
    step(scene, 5);
    JoScene *next = resume(scene);
    assert_true(jo_world_hash(next->world) == jo_world_hash(scene->world));
    save_live(scene, COUNTING);
    save_live(next, COUNTING);
    assert_true(remembered(next, 1, "laps") == laps);
    step(scene, 20);
    step(next, 20);
    assert_true(jo_world_hash(next->world) == jo_world_hash(scene->world));
    jo_scene_free(next);
    jo_scene_free(scene);
}

static void oldest_of_too_many_names_is_dropped_and_told(void **state) {
    (void)state;
    JoScene *scene = load_own(TWO, LAPS RESTING);
    JoxText text = {0};
    for (int n = 0; n <= JOX_MOST_DORMANT; n++) {
        text.length = 0;
        jox_text_printf(&text, "memory { name%d = %d }\n" RESTING, n, n);
        save_live(scene, text.data);
        assert_true((n < JOX_MOST_DORMANT - 1) == !strstr(said.data, "is dropped"));
    }
    assert_non_null(strstr(said.data, "memory 'met', which no version named for long, is dropped"));
    save_live(scene, "memory { name0 = 9 }\n" RESTING);
    assert_true(remembered(scene, 0, "name0") == 0.0);
    jox_text_free(&text);
    jo_scene_free(scene);
}

/* A version whose memory of the name `laps` is what it says. */
#define NAMES(memory, keys) "memory { " memory " }\n" HEAD "\"A\", " keys STEER_ALONE
#define STEER_ALONE "states = { A = { steer = hold } } }\n"

static void memory_that_is_back_is_not_told_to_begin(void **state) {
    (void)state;
    JoScene *scene = load_own(TWO, NAMES("laps = 5", ""));
    save_live(scene, NAMES("laps = false", ""));
    assert_non_null(strstr(said.data, "'laps' was a number and is true or false now: 2 people "
                                      "start with its initial value, and their old values"));
    save_live(scene, NAMES("laps = 0", ""));
    assert_true(remembered(scene, 0, "laps") == 5.0);
    assert_non_null(strstr(
        said.data, "'laps' of 2 people has the value again that it had when it was last named"));
    assert_non_null(strstr(said.data, "'laps' was true or false and is a number now: their old "
                                      "values are kept until it is true or false again"));
    assert_null(strstr(said.data, "begins with"));
    jo_scene_free(scene);
}

static void renamed_memory_comes_in_place_of_what_was_kept(void **state) {
    (void)state;
    JoScene *scene = load_own(TWO, NAMES("loops = 3", ""));
    save_live(scene, NAMES("laps = 5", ""));
    save_live(scene, NAMES("loops = 0", "renamed = { laps = \"loops\" }, "));
    assert_true(remembered(scene, 0, "loops") == 5.0);
    assert_non_null(strstr(said.data, "memory 'loops' that was kept is dropped: "
                                      "'laps' is renamed to it"));
    assert_null(strstr(said.data, "at most"));
    save_live(scene, RESTING);
    assert_null(strstr(said.data, "dropped")); /* nothing is kept twice */
    save_live(scene, NAMES("loops = 0", ""));
    assert_true(remembered(scene, 0, "loops") == 5.0);
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
        cmocka_unit_test(memory_that_a_version_lacks_is_kept_and_told),
        cmocka_unit_test(memory_of_another_type_is_told_and_comes_back),
        cmocka_unit_test(counter_goes_on_where_it_was),
        cmocka_unit_test(run_with_dormant_memory_resumes_exactly),
        cmocka_unit_test(oldest_of_too_many_names_is_dropped_and_told),
        cmocka_unit_test(memory_that_is_back_is_not_told_to_begin),
        cmocka_unit_test(renamed_memory_comes_in_place_of_what_was_kept),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_all);
}
