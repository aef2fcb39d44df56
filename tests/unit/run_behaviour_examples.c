/* Tests that every example of the behaviour reference runs, as a behaviour or as a mod's patch,
 * with three agents in a yard. */
#include "base/text.h"
#include "lua/behaviour_reference.h"
#include "messages.h"
#include "run/run.h"
#include "unit/test_folder.h"

static const char YARD[] =
    "jostle: 1\n"
    "storeys: {ground: {height: 0}, first: {height: 3}}\n"
    "lifts: {east: {area: [[2, 16], [4, 18]], door: [[2.5, 16], [3.5, 16]]}}\n"
    "places:\n"
    "  yard: {polygon: [[0, 0], [20, 0], [20, 20], [0, 20]]}\n"
    "  mid: {line: [[10, 0], [10, 20]]}\n"
    "  post: {point: [5, 10]}\n"
    "  far: {point: [18, 18], radius: 1}\n"
    "  ends: {set: [post, far]}\n"
    "  row: {queue: [[15, 10], [15, 5]], spacing: 0.6}\n"
    "walls: [{line: [[19, 19], [20, 19]], name: gate}]\n"
    "bodies:\n"
    "  - {shape: {sphere: {radius: 0.11}}, mass: 0.4, at: [11.6, 9, 0.11], tags: [ball]}\n"
    "groups:\n"
    "  people: {behaviour: example.lua, at: [[12, 8], [12, 10], [12, 12]], tags: [people], team: "
    "a}\n"
    "  other: {behaviour: stander.lua, at: [[14, 9]], team: b}\n";

static JoxText messages;

/* Loads the yard and steps it for 3 s. Returns whether nothing failed. */
static bool run_yard(const char *mod) {
    JoSceneDef def = jo_default_scene_def();
    JoError error;
    def.path = test_path("scene.yaml");
    def.message = append_message;
    def.message_context = &messages;
    def.named_mods_only = true;
    def.mods = &mod;
    def.mod_count = mod != NULL;
    jox_text_free(&messages);
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene)
        return false;
    bool good = !mod || scene->mods->count == 1;
    for (int i = 0; i < 60 && good; i++)
        good = jo_scene_step(scene, &error);
    good = good && scene->world->machines.state->hook_failures == 0;
    jo_scene_free(scene);
    return good;
}

static void every_example_of_the_reference_runs(void **state) {
    (void)state;
    int failed = 0;
    for (size_t n = 0;; n++) {
        JoxText name = {0}, text = {0};
        bool of_mod;
        if (!jox_lua_example(n, &name, &text, &of_mod))
            break;
        write_test_file(of_mod ? "mod/patches/stander.lua" : "example.lua", text.data);
        if (of_mod)
            write_test_file(
                "example.lua",
                "return machine { name = \"m\", start = \"A\", states = { A = {} } }\n");
        if (!run_yard(of_mod ? test_path("mod") : NULL)) {
            printf("%s:\n%s%s\n", name.data, text.data, messages.data ? messages.data : "");
            failed++;
        }
        jox_text_free(&name);
        jox_text_free(&text);
    }
    assert_int_equal(failed, 0);
}

static void wrong_example_fails(void **state) {
    (void)state;
    write_test_file("example.lua", "return machine { name = \"m\", start = \"A\", states = { A = { "
                                   "on_enter = function(me) me.nothing = 1 end } } }\n");
    assert_false(run_yard(NULL));
    write_test_file("example.lua",
                    "return machine { name = \"m\", start = \"A\", states = { A = 3 } }\n");
    assert_false(run_yard(NULL));
}

static int write_yard_and_mod(void **state) {
    if (make_test_folder(state) != 0)
        return -1;
    write_test_file("scene.yaml", YARD);
    write_test_file("mod/mod.yaml",
                    "name: trial\nversion: 1.0\napi: 1\nsettings:\n  reach: {value: 3}\n");
    return 0;
}

static int remove_yard_and_mod(void **state) {
    jox_text_free(&messages);
    return remove_test_folder(state);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_example_of_the_reference_runs),
                                       cmocka_unit_test(wrong_example_fails)};
    return cmocka_run_group_tests(tests, write_yard_and_mod, remove_yard_and_mod);
}
