/* jo_scene_half_step: loads the same scene at half the step, and refuses if its files changed. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "jostle_tools.h"

static char folder[] = "/tmp/jostle-half-XXXXXX", path[64];

static void write_stander_scene(const char *people) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file,
            "jostle: 1\nstep: 0.1\nseed: 7\nduration: 1\n"
            "groups: {g: {behaviour: stander, at: [%s]}}\n",
            people);
    fclose(file);
}

static void discard_text(void *context, const char *text) {
    (void)context;
    (void)text;
}

static JoSceneDef make_scene_def(void) {
    JoSceneDef def = jo_default_scene_def();
    def.path = path;
    def.message = discard_text;
    def.named_mods_only = true;
    return def;
}

static void half_step_run_keeps_scene_and_seed(void **state) {
    (void)state;
    JoError error = {0};
    write_stander_scene("[0, 0], [1, 0]");
    JoSceneDef def = make_scene_def();
    def.has_seed = true;
    def.seed = 9;
    JoScene *scene = jo_scene_load(&def, &error);
    assert_non_null(scene);
    assert_true(jo_scene_report(scene, folder, &error));
    JoScene *half = jo_scene_half_step(&def, scene, &error);
    assert_non_null(half);
    assert_float_equal(jo_scene_stats(half).dt, 0.05, 1e-12);
    char *summary = jo_scene_summary(half);
    assert_non_null(strstr(summary, "\"seed\": 9,"));
    jo_free(summary);
    assert_true(jo_scene_step(half, &error));
    assert_true(jo_scene_finish(half, &error));
    jo_scene_free(half);
    jo_scene_free(scene);
}

static void edited_files_refuse_half_step_run(void **state) {
    (void)state;
    JoError error = {0};
    write_stander_scene("[0, 0], [1, 0]");
    JoSceneDef def = make_scene_def();
    JoScene *scene = jo_scene_load(&def, &error);
    assert_non_null(scene);
    write_stander_scene("[0, 0], [1, 0], [2, 0]");
    assert_null(jo_scene_half_step(&def, scene, &error));
    assert_non_null(strstr(error.text, "edited meanwhile"));
    jo_scene_free(scene);
}

static int make_half_step_folder(void **state) {
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/scene.yaml", folder);
    return 0;
}

static int remove_half_step_folder(void **state) {
    (void)state;
    char command[96];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_step_run_keeps_scene_and_seed),
        cmocka_unit_test(edited_files_refuse_half_step_run),
    };
    return cmocka_run_group_tests(tests, make_half_step_folder, remove_half_step_folder);
}
