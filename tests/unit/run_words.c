/* Every example of the page of words runs: each is written out as a behaviour, or as a mod's patch
   of one, and lived by three agents in a yard. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/text.h"
#include "lua/reference.h"
#include "run/run.h"

static const char YARD[] =
    "jostle: 1\n"
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

static char folder[64], said[8192];

static void keep(void *context, const char *text) {
    (void)context;
    if (strlen(said) + strlen(text) < sizeof said)
        strcat(said, text);
}

static void write_file(const char *name, const char *text) {
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

/* Loads the yard and steps it for three seconds; whether nothing went wrong. */
static bool lives(const char *mod) {
    char path[256];
    snprintf(path, sizeof path, "%s/scene.yaml", folder);
    JoSceneDef def = jo_default_scene_def();
    JoError error;
    def.path = path;
    def.message = keep;
    def.named_mods_only = true;
    def.mods = &mod;
    def.mod_count = mod != NULL;
    said[0] = 0;
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

static void every_example_of_the_page_runs(void **state) {
    (void)state;
    char mod[256];
    int failed = 0;
    snprintf(mod, sizeof mod, "%s/mod", folder);
    for (size_t n = 0;; n++) {
        JoxText name = {0}, text = {0};
        bool of_mod;
        if (!jox_lua_example(n, &name, &text, &of_mod))
            break;
        write_file(of_mod ? "mod/patches/stander.lua" : "example.lua", text.data);
        if (of_mod)
            write_file("example.lua",
                       "return machine { name = \"m\", start = \"A\", states = { A = {} } }\n");
        if (!lives(of_mod ? mod : NULL)) {
            printf("%s:\n%s%s\n", name.data, text.data, said);
            failed++;
        }
        jox_text_free(&name);
        jox_text_free(&text);
    }
    assert_int_equal(failed, 0);
}

static void a_wrong_example_would_be_noticed(void **state) {
    (void)state;
    write_file("example.lua", "return machine { name = \"m\", start = \"A\", states = { A = { "
                              "on_enter = function(me) me.nothing = 1 end } } }\n");
    assert_false(lives(NULL));
    write_file("example.lua",
               "return machine { name = \"m\", start = \"A\", states = { A = 3 } }\n");
    assert_false(lives(NULL));
}

int main(void) {
    char path[128];
    strcpy(folder, "/tmp/jostle-words-XXXXXX");
    if (!mkdtemp(folder))
        return 1;
    snprintf(path, sizeof path, "%s/mod", folder);
    mkdir(path, 0777);
    strcat(path, "/patches");
    mkdir(path, 0777);
    write_file("scene.yaml", YARD);
    write_file("mod/mod.yaml",
               "name: trial\nversion: 1.0\napi: 1\nsettings:\n  reach: {value: 3}\n");
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_example_of_the_page_runs),
                                       cmocka_unit_test(a_wrong_example_would_be_noticed)};
    int status = cmocka_run_group_tests(tests, NULL, NULL);
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command) == 0 ? status : 1;
}
