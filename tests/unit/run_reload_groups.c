/* Tests of edits of a scene's groups while it runs: their behaviours, and the types of the values
 * that they set. */
#include "record/trajectory_reader.h"
#include "run/criteria_listener.h"
#include "run/reload.h"
#include "unit/scene_loader.h"

#define GROUPS(second)                                                                             \
    "jostle: 1\n"                                                                                  \
    "places: {door: {point: [0, 0], radius: 3}, goal: {point: [20, 0]}}\n"                         \
    "groups:\n"                                                                                    \
    "  first: {behaviour: own.lua, at: [[30, 0]]}\n"                                               \
    "  second: {" second "}\n"                                                                     \
    "sources: [{at: door, like: second, rate: 2}]\n"
#define NAMED(name, more)                                                                          \
    "return machine { name = \"" name "\", start = \"A\", " more                                   \
    "states = { A = { steer = hold } } }\n"

/* Name of the machine of the agent that was made last. */
static const char *newest_machine(const JoScene *scene) {
    const JoxAgents *a = &scene->world->state.agents;
    uint32_t newest = 0;
    for (uint32_t i = 0; i < a->count; i++)
        if (a->id[i] > a->id[newest])
            newest = i;
    return scene->world->model.machines.items[a->machine[newest]]->name;
}

static JoScene *load_groups(const char *second) {
    write_test_file("second.lua", NAMED("second", ""));
    write_test_file("third.lua", NAMED("third", ""));
    JoScene *scene = load_scene_text(second, NAMED("first", ""));
    step_scene(scene, 40);
    assert_string_equal(newest_machine(scene), "second");
    return scene;
}

static void people_come_with_the_old_behaviour_after(const char *edited, const char *said) {
    JoScene *scene = load_groups(GROUPS("behaviour: second.lua, count: 0"));
    const uint32_t before = scene->world->state.agents.count;
    edit_scene(scene, edited);
    assert_non_null(scene_messages.data);
    assert_non_null(strstr(scene_messages.data, said));
    step_scene(scene, 60);
    assert_true(scene->world->state.agents.count > before);
    assert_string_equal(newest_machine(scene), "second");
    /* The edit still waits at the next one, and no longer once it is undone. */
    edit_scene(scene, edited);
    assert_non_null(strstr(scene_messages.data, said));
    edit_scene(scene, GROUPS("behaviour: second.lua, count: 0"));
    assert_true(!scene_messages.data || !strstr(scene_messages.data, said));
    jo_scene_free(scene);
}

static void edited_behaviours_of_groups_wait_for_the_next_start(void **state) {
    (void)state;
    static const char SAID[] = "behaviours of groups: takes effect at the next start";
    people_come_with_the_old_behaviour_after(GROUPS("behaviour: third.lua, count: 0"), SAID);
    people_come_with_the_old_behaviour_after(GROUPS("behaviour: own.lua, count: 0"), SAID);
    people_come_with_the_old_behaviour_after(GROUPS("mix: {third.lua: 8, second.lua: 1}, count: 0"),
                                             SAID);
    people_come_with_the_old_behaviour_after(GROUPS("journey: [{to: goal}, {wait: 5}], count: 0"),
                                             SAID);
}

static void edited_weights_of_a_mix_are_live(void **state) {
    (void)state;
    JoScene *scene =
        load_groups(GROUPS("mix: {second.lua: 1000000, third.lua: 0.000001}, count: 0"));
    edit_scene(scene, GROUPS("mix: {second.lua: 0.000001, third.lua: 1000000}, count: 0"));
    step_scene(scene, 60);
    assert_string_equal(newest_machine(scene), "third");
    jo_scene_free(scene);
}

/* ---- types of values ---- */

#define AIMING(goal, steer)                                                                        \
    "return machine { name = \"second\", start = \"A\", own = { goal = " goal                      \
    " }, states = { A = { steer = " steer " } } }\n"

/* Reloads a file of the test folder as a run does for its watch or input log. */
static bool swap_file(JoScene *scene, const char *name, const char *text) {
    char path[300];
    JoError error = {0};
    snprintf(path, sizeof path, "%s", test_path(name));
    JoxInputFile file = {.path = path, .text = (char *)text, .length = strlen(text)};
    JoxInputEntry entry = {.number = 1, .files = &file};
    jox_text_free(&scene_messages);
    jox_overlay_put(&scene->overlay, path, text, file.length);
    const JoxOverlay *before = jox_overlay_use(&scene->overlay);
    const bool live = jox_run_reload_files(scene, &entry, &error);
    jox_overlay_use(before);
    return live;
}

#define AIMED(more) GROUPS("behaviour: second.lua, count: 0, " more)
static void check_refusal(JoScene *scene, const char *yaml, const char *why) {
    const uint64_t before = jo_world_hash(scene->world);
    assert_false(swap_file(scene, "scene.yaml", yaml));
    assert_non_null(strstr(scene_messages.data, why));
    assert_true(jo_world_hash(scene->world) == before);
}

static void value_of_another_type_is_refused(void **state) {
    (void)state;
    write_test_file("second.lua", AIMING("\"goal\"", "seek(own.goal)"));
    JoScene *scene = load_scene_text(AIMED("set: {goal: goal}"), NAMED("first", ""));
    step_scene(scene, 20);
    check_refusal(scene, AIMED("set: {goal: 1}"), "'goal' of behaviour second is a place");
    check_refusal(scene, AIMED("set: {speed: goal}"), "'speed' of behaviour second is a number");
    check_refusal(scene, AIMED("profiles: {tall: {share: 1, set: {goal: 1}}}"),
                  "'goal' of behaviour second is a place");
    jo_scene_free(scene);
}

/* First the behaviour is saved, which has no use for the scene's value, then the scene. */
static void value_changes_its_type_in_two_edits(void **state) {
    (void)state;
    write_test_file("second.lua", AIMING("\"goal\"", "seek(own.goal)"));
    JoScene *scene = load_scene_text(AIMED("set: {goal: goal}"), NAMED("first", ""));
    step_scene(scene, 20);
    assert_true(swap_file(scene, "second.lua", AIMING("0", "drift(own.goal, 0)")));
    assert_non_null(strstr(scene_messages.data,
                           "'goal' of behaviour second is a number: nobody is given this value"));
    step_scene(scene, 20);
    assert_true(swap_file(scene, "scene.yaml", AIMED("set: {goal: -1}")));
    step_scene(scene, 20);
    jo_scene_free(scene);
}

/* The behaviour that goes on has the name of a value as another type than the edited one. */
static void value_of_a_behaviour_that_waits_is_not_given(void **state) {
    (void)state;
    write_test_file("second.lua", AIMING("\"goal\"", "seek(own.goal)"));
    write_test_file("third.lua", AIMING("1", "drift(own.goal, 0)"));
    JoScene *scene =
        load_scene_text(GROUPS("behaviour: second.lua, at: [[10, 0]]"), NAMED("first", ""));
    edit_scene(scene, GROUPS("behaviour: third.lua, at: [[10, 0]], set: {goal: 0}"));
    const JoxAgents *a = &scene->world->state.agents;
    step_scene(scene, 20);
    assert_true(a->x[jox_agents_find(a, 1)] > 10.0f);
    jo_scene_free(scene);
}

/* ---- criteria ---- */

/* A reload frees the specification that named the criteria and their places. */
static void criteria_hold_after_a_reload(void **state) {
    (void)state;
    static const char CRITERIA[] =
        "criteria: {crowded: {density: 0.01, at: door}, pressed: {load: 6000}}\n";
    char before[1000], after[1000];
    snprintf(before, sizeof before, "%s%s", GROUPS("behaviour: second.lua, count: 0"), CRITERIA);
    snprintf(after, sizeof after, "%s%s",
             GROUPS("behaviour: second.lua, count: 0, set: {speed: 1}"), CRITERIA);
    JoScene *scene = load_groups(before);
    edit_scene(scene, after);
    step_scene(scene, 60);
    assert_int_equal(jox_run_count_criteria(scene), 2);
    const JoxVerdict crowded = jox_run_judge(scene, 0), pressed = jox_run_judge(scene, 1);
    assert_string_equal(crowded.criterion->name, "crowded");
    assert_int_equal(crowded.kind, JOX_VERDICT_FAILED);
    assert_non_null(strstr(crowded.how, "anywhere in door"));
    assert_int_equal(pressed.kind, JOX_VERDICT_MET);
    jo_scene_free(scene);
}

/* ---- recordings ---- */

static void recording_has_the_look_of_the_last_reload(void **state) {
    (void)state;
    char grass[1000], file[320];
    JoError error = {0};
    snprintf(grass, sizeof grass, "%sfloor: grass\n", GROUPS("behaviour: second.lua, count: 0"));
    JoScene *scene = load_groups(GROUPS("behaviour: second.lua, count: 0"));
    snprintf(file, sizeof file, "%s", test_path("look.sqlite"));
    assert_true(jo_scene_record(scene, file, 0.1, &error));
    step_scene(scene, 5);
    edit_scene(scene, grass);
    step_scene(scene, 5);
    jo_scene_free(scene);
    static const JoxTrajectoryOptions OPTIONS = {0};
    JoxDiagnostics diagnostics = {0};
    JoxTrajectoryReader *reader = jox_trajectory_reader_open(file, &OPTIONS, &diagnostics);
    assert_non_null(reader);
    const JoxTrajectoryReaderInfo info = jox_trajectory_reader_info(reader);
    assert_non_null(strstr(info.look, "\"grass\""));
    jox_trajectory_reader_close(reader);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(recording_has_the_look_of_the_last_reload),
        cmocka_unit_test(edited_behaviours_of_groups_wait_for_the_next_start),
        cmocka_unit_test(criteria_hold_after_a_reload),
        cmocka_unit_test(edited_weights_of_a_mix_are_live),
        cmocka_unit_test(value_of_another_type_is_refused),
        cmocka_unit_test(value_changes_its_type_in_two_edits),
        cmocka_unit_test(value_of_a_behaviour_that_waits_is_not_given),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
