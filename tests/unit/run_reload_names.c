/* Tests of reloads by versions with other names: tags and teams that no group of the scene has, and
 * memory that a version lacks. */
#include "machine/lists.h"
#include "run/reload.h"
#include "unit/scene_loader.h"

#define TWO                                                                                        \
    "jostle: 1\ngroups: {p: {behaviour: own.lua, at: [[0, 0], [2, 0]], team: red, tags: "          \
    "[folk]}}\n"
/* A machine whose agents change state and run an action on a condition. */
#define TURNS(when, set)                                                                           \
    MACHINE_START "\"A\", states = { A = { steer = hold, { to = \"B\", when = " when               \
                  ", set = { " set " } } }, B = { steer = hold } } }\n"

/* Reloads the behaviour as a run does for its watch or input log. */
static bool swap_behaviour(JoScene *scene, const char *text, JoError *error) {
    char path[300]; /* a copy, as the machine frees its own */
    snprintf(path, sizeof path, "%s", scene->world->model.machines.items[0]->path);
    JoxInputFile file = {.path = path, .text = (char *)text, .length = strlen(text)};
    JoxInputEntry entry = {.number = 1, .files = &file};
    jox_overlay_put(&scene->overlay, path, text, file.length);
    const JoxOverlay *before = jox_overlay_use(&scene->overlay);
    const bool live = jox_run_reload_files(scene, &entry, error);
    jox_overlay_use(before);
    return live;
}

static JoScene *load_resumable(const char *behaviour) {
    write_test_file("own.lua", behaviour);
    JoSceneDef def = define_scene(write_test_file("scene.yaml", TWO));
    def.resumable = true;
    return load_defined_scene(&def);
}

/* Writes a checkpoint of a scene and resumes it as another scene. */
static JoScene *resume_latest(JoScene *scene) {
    char *note = NULL;
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    def.message = append_message;
    def.message_context = &scene_messages;
    step_scene(scene, 1); /* a checkpoint is due in this step */
    JoScene *next =
        jo_scene_resume(&def, test_path("checkpoints/latest.checkpoint"), &note, &error);
    if (!next)
        fail_msg("%s", error.text);
    jo_free(note);
    return next;
}

static void keep_checkpoints(JoScene *scene) {
    JoError error = {0};
    if (!jo_scene_checkpoint(scene, test_path("checkpoints"), 0.05, "", &error))
        fail_msg("%s", error.text);
}

static const char *find_tag_name(const JoScene *scene, uint32_t agent) {
    const uint64_t tags = scene->world->state.agents.tags[agent];
    for (uint32_t t = 0; t < scene->world->model.tag_count; t++)
        if (tags >> t & 1)
            return scene->world->model.tags[t];
    return "";
}

static void tag_and_team_that_a_state_sets_are_known(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(TWO, TURNS("sees(nearest \"folk\") & ~sees(nearest \"ill\")",
                                                "tags = { \"ill\", \"folk\" }, team = \"undead\""));
    const JoxAgents *a = &scene->world->state.agents;
    step_scene(scene, 2);
    assert_int_equal(a->state[0], 1);
    assert_int_equal(a->tags[0], 3);
    assert_int_equal(a->team[0], JOX_FIRST_SET_TEAM);
    assert_true(a->team[0] == a->team[1]);
    jo_scene_free(scene);
}

static void tag_that_nothing_has_or_sets_is_refused(void **state) {
    (void)state;
    JoError error = {0};
    write_test_file("own.lua", TURNS("sees(nearest \"il\")", "tags = \"ill\""));
    const JoSceneDef def = define_scene(write_test_file("scene.yaml", TWO));
    assert_null(jo_scene_load(&def, &error));
    assert_non_null(strstr(error.text, "'il'"));
    JoScene *scene = load_scene_text(TWO, TURNS("after(9)", "tags = \"folk\""));
    assert_false(swap_behaviour(scene, TURNS("sees(nearest \"il\")", "tags = \"folk\""), &error));
    assert_int_equal(scene->world->model.tag_count, 1);
    jo_scene_free(scene);
}

static void misspelt_tag_and_team_are_warned_of(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(TWO, TURNS("sees(nearest \"folk\")", "tags = \"fol\", team = \"rde\""));
    assert_non_null(strstr(scene_messages.data, "nothing asks for the tag 'fol'"));
    assert_non_null(strstr(scene_messages.data, "no group of the scene has the team 'rde'"));
    assert_non_null(strstr(scene_messages.data, "Did you mean 'red'?"));
    jo_scene_free(scene);
}

/* The numbers of tags depend on all versions that ran, not on the last one alone. */
static void run_with_new_tags_resumes_exactly(void **state) {
    (void)state;
    JoError error = {0};
    JoScene *scene = load_resumable(TURNS("after(9)", "tags = \"ill\", team = \"one\""));
    keep_checkpoints(scene);
    step_scene(scene, 3);
    assert_true(
        swap_behaviour(scene, TURNS("after(0.1)", "tags = \"well\", team = \"two\""), &error));
    step_scene(scene, 5);
    assert_string_equal(find_tag_name(scene, 0), "well");
    JoScene *next = resume_latest(scene);
    assert_string_equal(find_tag_name(next, 0), "well");
    assert_int_equal(next->world->state.agents.team[0], JOX_FIRST_SET_TEAM + 1);
    assert_true(jo_world_hash(next->world) == jo_world_hash(scene->world));
    assert_true(swap_behaviour(
        scene, TURNS("sees(nearest \"well\")", "tags = { \"ill\", \"well\" }"), &error));
    assert_true(swap_behaviour(
        next, TURNS("sees(nearest \"well\")", "tags = { \"ill\", \"well\" }"), &error));
    step_scene(scene, 9);
    step_scene(next, 9);
    assert_true(jo_world_hash(next->world) == jo_world_hash(scene->world));
    jo_scene_free(next);
    jo_scene_free(scene);
}

/* ---- memory that a version lacks ---- */

#define LAPS "local mine = memory { laps = 0, met = false }\n"
#define COUNTING                                                                                   \
    LAPS MACHINE_START                                                                             \
        "\"A\", own = { luck = uniform(0, 1) }, states = { A = { steer = hold, "                   \
        "{ to = \"A\", when = after(0.1), set = { laps = mine.laps + 1, met = true } } } } }\n"
#define RESTING MACHINE_START "\"A\", states = { A = { steer = hold } } }\n"

static double read_named_memory(const JoScene *scene, uint32_t agent, const char *name) {
    const JoxMachine *m = scene->world->machines.set->items[0];
    const int32_t slot = jox_machine_memory(m, name);
    const JoxAgents *a = &scene->world->state.agents;
    return slot < 0 ? -1.0 : a->memory[(size_t)agent * a->memory_stride + (uint32_t)slot];
}

static void swap_behaviour_live(JoScene *scene, const char *text) {
    JoError error = {0};
    jox_text_free(&scene_messages);
    if (!swap_behaviour(scene, text, &error))
        fail_msg("%s: %s", error.text, scene_messages.data);
}

static void memory_that_a_version_lacks_is_kept_and_reported(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(TWO, COUNTING);
    step_scene(scene, 40);
    const double laps = read_named_memory(scene, 1, "laps");
    assert_true(laps >= 8.0 && read_named_memory(scene, 1, "met") == 1.0);
    swap_behaviour_live(scene, RESTING);
    assert_non_null(strstr(scene_messages.data, "memory 'laps' of 2 people is kept until"));
    assert_true(read_named_memory(scene, 1, "laps") == -1.0);
    step_scene(scene, 5);
    swap_behaviour_live(scene, STANDING_AT_SPEED("1", ""));
    assert_null(strstr(scene_messages.data, "laps")); /* reported once */
    step_scene(scene, 5);
    swap_behaviour_live(scene, COUNTING);
    assert_non_null(strstr(scene_messages.data, "memory 'laps' of 2 people has the value again"));
    assert_true(read_named_memory(scene, 1, "laps") == laps &&
                read_named_memory(scene, 1, "met") == 1.0);
    jo_scene_free(scene);
}

static void memory_of_another_type_is_reported_and_comes_back(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(TWO, COUNTING);
    step_scene(scene, 40);
    const double laps = read_named_memory(scene, 0, "laps");
    swap_behaviour_live(scene, "memory { laps = false, met = false }\n" RESTING);
    assert_non_null(
        strstr(scene_messages.data, "memory 'laps' was a number and is true or false now"));
    assert_true(read_named_memory(scene, 0, "laps") == 0.0 &&
                read_named_memory(scene, 0, "met") == 1.0);
    swap_behaviour_live(scene, LAPS RESTING);
    assert_true(read_named_memory(scene, 0, "laps") == laps);
    jo_scene_free(scene);
}

#define RING                                                                                       \
    "jostle: 1\nplaces: {hub: {point: [0, 0]}}\n"                                                  \
    "groups: {p: {behaviour: own.lua, at: [[3, 0]], facing: 90}}\n"
#define ORBIT(counts, more)                                                                        \
    "local mine = memory { laps = 0 }\nreturn machine { name = \"m\", start = \"A\", " counts      \
    "states = { A = { steer = orbit \"hub\"" more " } } }\n"

/* A counter keeps the angle turned so far, and its slot is not used for a home in between. */
static void counter_continues_after_a_version_without_it(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(RING, ORBIT("counts = { laps = circuits \"hub\" }, ", ""));
    step_scene(scene, 150);
    const JoxAgents *a = &scene->world->state.agents;
    const JoxMachine *m = scene->world->machines.set->items[0];
    const double angle = a->memory[m->counters[0].angle];
    assert_true(angle > 1.0);
    swap_behaviour_live(scene, ORBIT("", ", face = home"));
    m = scene->world->machines.set->items[0];
    assert_true(a->memory[m->home - 1] ==
                (double)a->x[0]); /* set now, not the angle of the counter */
    swap_behaviour_live(scene, ORBIT("counts = { laps = circuits \"hub\" }, ", ""));
    m = scene->world->machines.set->items[0];
    assert_true(a->memory[m->counters[0].angle] == angle);
    jo_scene_free(scene);
}

static void run_with_dormant_memory_resumes_exactly(void **state) {
    (void)state;
    JoScene *scene = load_resumable(COUNTING);
    keep_checkpoints(scene);
    step_scene(scene, 40);
    const double laps = read_named_memory(scene, 1, "laps");
    swap_behaviour_live(scene, RESTING);
    step_scene(scene, 5);
    JoScene *next = resume_latest(scene);
    assert_true(jo_world_hash(next->world) == jo_world_hash(scene->world));
    swap_behaviour_live(scene, COUNTING);
    swap_behaviour_live(next, COUNTING);
    assert_true(read_named_memory(next, 1, "laps") == laps);
    step_scene(scene, 20);
    step_scene(next, 20);
    assert_true(jo_world_hash(next->world) == jo_world_hash(scene->world));
    jo_scene_free(next);
    jo_scene_free(scene);
}

static void oldest_of_too_many_kept_names_is_dropped_and_reported(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(TWO, LAPS RESTING);
    JoxText text = {0};
    for (int n = 0; n <= JOX_MOST_DORMANT; n++) {
        text.length = 0;
        jox_text_printf(&text, "memory { name%d = %d }\n" RESTING, n, n);
        swap_behaviour_live(scene, text.data);
        assert_true((n < JOX_MOST_DORMANT - 1) == !strstr(scene_messages.data, "is dropped"));
    }
    assert_non_null(
        strstr(scene_messages.data, "memory 'met', which no version named for long, is dropped"));
    swap_behaviour_live(scene, "memory { name0 = 9 }\n" RESTING);
    assert_true(read_named_memory(scene, 0, "name0") == 0.0);
    jox_text_free(&text);
    jo_scene_free(scene);
}

/* A version with the given memory and keys. */
#define NAMES(memory, keys) "memory { " memory " }\n" MACHINE_START "\"A\", " keys STEER_ALONE
#define STEER_ALONE "states = { A = { steer = hold } } }\n"

static void restored_memory_is_not_reported_as_new(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(TWO, NAMES("laps = 5", ""));
    swap_behaviour_live(scene, NAMES("laps = false", ""));
    assert_non_null(strstr(scene_messages.data,
                           "'laps' was a number and is true or false now: 2 people "
                           "start with its initial value, and their old values"));
    swap_behaviour_live(scene, NAMES("laps = 0", ""));
    assert_true(read_named_memory(scene, 0, "laps") == 5.0);
    assert_non_null(
        strstr(scene_messages.data,
               "'laps' of 2 people has the value again that it had when it was last named"));
    assert_non_null(strstr(scene_messages.data,
                           "'laps' was true or false and is a number now: their old "
                           "values are kept until it is true or false again"));
    assert_null(strstr(scene_messages.data, "begins with"));
    jo_scene_free(scene);
}

static void renamed_memory_replaces_kept_memory(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(TWO, NAMES("loops = 3", ""));
    swap_behaviour_live(scene, NAMES("laps = 5", ""));
    swap_behaviour_live(scene, NAMES("loops = 0", "renamed = { laps = \"loops\" }, "));
    assert_true(read_named_memory(scene, 0, "loops") == 5.0);
    assert_non_null(strstr(scene_messages.data, "memory 'loops' that was kept is dropped: "
                                                "'laps' is renamed to it"));
    assert_null(strstr(scene_messages.data, "at most"));
    swap_behaviour_live(scene, RESTING);
    assert_null(strstr(scene_messages.data, "dropped")); /* no name is kept twice */
    swap_behaviour_live(scene, NAMES("loops = 0", ""));
    assert_true(read_named_memory(scene, 0, "loops") == 5.0);
    jo_scene_free(scene);
}

#define LISTING(length)                                                                            \
    "local mine = memory { n = 0, times = list(" length ") }\n" MACHINE_START                      \
    "\"A\", states = { A = { steer = hold, { every = 0.1, when = mine.n:below(6), "                \
    "set = { n = mine.n + 1, times = mine.times:push(mine.n) } } } } }\n"

/* Returns an item of the list `times` of an agent, by its number from 0; -1 beyond its end. */
static double read_listed(const JoScene *scene, uint32_t agent, uint32_t item) {
    const JoxMachine *m = scene->world->machines.set->items[0];
    const JoxAgents *a = &scene->world->state.agents;
    double items[JOX_MOST_ITEMS];
    const uint32_t count =
        jox_list_read(&scene->world->machines, m, a->memory + (size_t)agent * a->memory_stride,
                      jox_machine_memory(m, "times"), items);
    return item < count ? items[item] : -1.0;
}

static void a_shorter_list_keeps_its_newest_items(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(TWO, LISTING("6"));
    step_scene(scene, 40);
    assert_true(read_listed(scene, 1, 0) == 0.0 && read_listed(scene, 1, 5) == 5.0);
    swap_behaviour_live(scene, LISTING("2"));
    assert_non_null(strstr(scene_messages.data, "the list 'times' holds at most 2 items now"));
    assert_null(strstr(scene_messages.data, "is kept until")); /* its hidden items are not named */
    assert_true(read_listed(scene, 1, 0) == 4.0 && read_listed(scene, 1, 1) == 5.0 &&
                read_listed(scene, 1, 2) == -1.0);
    swap_behaviour_live(scene, LISTING("6"));
    assert_true(read_listed(scene, 1, 0) == 4.0 && read_listed(scene, 1, 2) == -1.0);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tag_and_team_that_a_state_sets_are_known),
        cmocka_unit_test(tag_that_nothing_has_or_sets_is_refused),
        cmocka_unit_test(misspelt_tag_and_team_are_warned_of),
        cmocka_unit_test(run_with_new_tags_resumes_exactly),
        cmocka_unit_test(memory_that_a_version_lacks_is_kept_and_reported),
        cmocka_unit_test(memory_of_another_type_is_reported_and_comes_back),
        cmocka_unit_test(counter_continues_after_a_version_without_it),
        cmocka_unit_test(run_with_dormant_memory_resumes_exactly),
        cmocka_unit_test(oldest_of_too_many_kept_names_is_dropped_and_reported),
        cmocka_unit_test(restored_memory_is_not_reported_as_new),
        cmocka_unit_test(renamed_memory_replaces_kept_memory),
        cmocka_unit_test(a_shorter_list_keeps_its_newest_items),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
