/* A run at half the step, for the page of a report: of the same scene, or none. */
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

static void write_scene(const char *people) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file,
            "jostle: 1\nstep: 0.1\nseed: 7\nduration: 1\n"
            "groups: {g: {behaviour: stander, at: [%s]}}\n",
            people);
    fclose(file);
}

static void quiet(void *context, const char *text) {
    (void)context;
    (void)text;
}

static JoSceneDef def_of_scene(void) {
    JoSceneDef def = jo_default_scene_def();
    def.path = path;
    def.message = quiet;
    def.named_mods_only = true;
    return def;
}

static void half_the_step_of_the_same_scene(void **state) {
    (void)state;
    JoError error = {0};
    write_scene("[0, 0], [1, 0]");
    JoSceneDef def = def_of_scene();
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

static void files_that_were_edited_meanwhile_are_another_scene(void **state) {
    (void)state;
    JoError error = {0};
    write_scene("[0, 0], [1, 0]");
    JoSceneDef def = def_of_scene();
    JoScene *scene = jo_scene_load(&def, &error);
    assert_non_null(scene);
    write_scene("[0, 0], [1, 0], [2, 0]");
    assert_null(jo_scene_half_step(&def, scene, &error));
    assert_non_null(strstr(error.text, "edited meanwhile"));
    jo_scene_free(scene);
}

static int make_folder(void **state) {
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/scene.yaml", folder);
    return 0;
}

static int remove_folder(void **state) {
    (void)state;
    char command[96];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_the_step_of_the_same_scene),
        cmocka_unit_test(files_that_were_edited_meanwhile_are_another_scene),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
