/* Scenes put together from several sources: values set by options, anchors, included files. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "scene_texts.h"
#include "unit/test_folder.h"

static const JoxGroupValue *find_set(const JoxGroup *group, const char *name) {
    for (uint32_t i = 0; i < group->set_count; i++)
        if (!strcmp(group->set[i].name, name))
            return &group->set[i];
    return NULL;
}

static void overrides_change_only_their_path(void **state) {
    (void)state;
    const char *text = "jostle: 1\n"
                       "places: {a: {point: [0, 0], radius: 50}}\n"
                       "walls: [{line: [[90, 0], [91, 0]], height: 1}, "
                       "{line: [[90, 5], [91, 5]], name: gate, height: 1}]\n"
                       "groups:\n"
                       "  g: {behaviour: stander, count: 5, in: a, set: &s {mass: 60}}\n"
                       "  h: {behaviour: stander, count: 5, in: a, set: *s}\n";
    const char *good[] = {
        "groups.g.count=7",    "groups.g.set.mass=80",          "walls.0.height=2",
        "walls.gate.height=3", "groups.h.behaviour=walker.lua", "seed=12",
        "forces.enabled=false"};
    JoxDiagnostics d = {0};
    JoxSceneSpec *scene = read_scene_text(text, good, 7, &d);
    if (!scene)
        print_diagnostics(&d, text);
    assert_non_null(scene);
    assert_int_equal(scene->groups[0].count, 7);
    assert_int_equal(scene->groups[1].count, 5);
    assert_true(find_set(&scene->groups[0], "mass")->dist.a == 80);
    assert_true(find_set(&scene->groups[1], "mass")->dist.a == 60);
    assert_non_null(strstr(scene->groups[1].mix[0].behaviour, "walker.lua"));
    assert_true(scene->walls.rings[0].height == 2);
    assert_true(scene->walls.rings[1].height == 3); /* by its name */
    assert_int_equal(scene->seed, 12);
    assert_false(scene->forces); /* in a table that the scene's file lacks */
    jox_scene_free(scene);
    static const struct {
        const char *set, *code, *hint;
    } BAD[] = {{"groups.gs.count=3", "bad-override", "Did you mean 'g'?"},
               {"nonsense", "bad-override", "Example"},
               {"=3", "bad-override", "Example"},
               {"walls.7.height=2", "bad-override", NULL},
               {"walls..height=2", "bad-override", NULL},
               {"walls.x=2", "bad-override", NULL},
               {"walls.0=5", "bad-type", NULL},
               {"seed.deep=1", "bad-override", NULL},
               {"groups.g.cuont=3", "unknown-key", "Did you mean 'count'?"},
               {"step=0", "out-of-range", NULL},
               {"groups.g.behaviour=gone", "missing-file", NULL}};
    for (size_t b = 0; b < sizeof BAD / sizeof *BAD; b++) {
        assert_null(read_scene_text(text, &BAD[b].set, 1, &d));
        if (d.errors != 1 || !is_diagnostic(&d.items[0], BAD[b].code, 1, 1, BAD[b].hint))
            print_diagnostics(&d, BAD[b].set);
        assert_int_equal(d.errors, 1);
        assert_true(is_diagnostic(&d.items[0], BAD[b].code, 1, 1, BAD[b].hint));
        assert_string_equal(d.items[0].file, "--set");
        jox_diag_free(&d);
    }
}

static void anchors_and_merge_keys(void **state) {
    (void)state;
    const char *text =
        "jostle: 1\n"
        "groups:\n"
        "  a: &a {behaviour: stander, at: [[0, 0]], set: &s {mass: 60, speed: 1}}\n"
        "  b: &b {<<: *a, at: [[3, 0]], team: red, set: {mass: 90}}\n"
        "  c: {<<: [{team: blue}, *b], at: [[6, 0], [7, 0]]}\n"
        "  d: {<<: {set: {radius: 0.3}}, behaviour: stander, at: [[9, 0]], set: *s}\n";
    JoxDiagnostics d = {0};
    JoxSceneSpec *scene = read_scene_text(text, NULL, 0, &d);
    if (!scene)
        print_diagnostics(&d, text);
    assert_non_null(scene);
    const JoxGroup *g = scene->groups;
    assert_int_equal(scene->group_count, 4);
    assert_int_equal(g[0].set_count, 2); /* unchanged by d, which merges into the same map */
    assert_true(find_set(&g[0], "mass")->dist.a == 60);
    assert_true(find_set(&g[1], "mass")->dist.a == 90 && find_set(&g[1], "speed")->dist.a == 1);
    assert_true(g[1].positions[0].x == 3);
    assert_string_equal(g[2].team, "blue"); /* the first of the list wins */
    assert_int_equal(g[2].count, 2);
    assert_true(find_set(&g[2], "mass")->dist.a == 90);
    assert_int_equal(g[3].set_count, 3);
    jox_scene_free(scene);
}

/* A compound's mass is shared by its parts in proportion to theirs; with mass 0 it is static. */
static void mass_of_compound_scales_parts(void **state) {
    (void)state;
    static const struct {
        const char *mass;
        double parts[2];
        bool still;
    } CASES[] = {{"", {6, 1}, false}, {"mass: 14, ", {12, 2}, false}, {"mass: 0, ", {6, 1}, true}};
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) {
        char text[400];
        snprintf(
            text, sizeof text,
            "jostle: 1\nbodies: [{%sat: [0, 0, 1], shape: {compound: [{shape: {sphere: {radius: "
            "1}}, mass: 6}, {shape: {sphere: {radius: 1}}, at: [1, 0, 0]}]}}]\n",
            CASES[c].mass);
        JoxDiagnostics d = {0};
        JoxSceneSpec *scene = jox_scene_read(write_test_file("main.yaml", text), NULL, &d);
        if (!scene)
            print_diagnostics(&d, text);
        assert_non_null(scene);
        const JoxBodyDef *def = &scene->bodies[0].def;
        assert_int_equal(def->still, CASES[c].still);
        for (int p = 0; p < 2; p++)
            assert_float_equal(def->shape.parts[p].mass, CASES[c].parts[p], 1e-12);
        jox_scene_free(scene);
        jox_diag_free(&d);
    }
}

static void included_files_give_missing_keys(void **state) {
    (void)state;
    char text[4400], *stander = realpath("behaviours/stander.lua", NULL);
    assert_non_null(stander);
    write_test_file("base.yaml", "title: Base\nseed: 9\nstep: 7\nplaces: {a: {point: [1, 2]}}\n");
    snprintf(text, sizeof text,
             "jostle: 1\ninclude: base.yaml\nseed: 2\nplaces: {b: {point: [3, 4]}}\n"
             "groups: {g: {behaviour: '%s', at: [[0, 0]]}}\n",
             stander);
    JoxDiagnostics d = {0};
    assert_null(jox_scene_read(write_test_file("main.yaml", text), NULL, &d));
    assert_int_equal(d.errors, 1); /* in the included file */
    assert_true(is_diagnostic(&d.items[0], "out-of-range", 3, 7, NULL));
    assert_non_null(strstr(d.items[0].file, "/base.yaml"));
    assert_string_equal(d.items[0].source, "step: 7");
    jox_diag_free(&d);
    write_test_file("base.yaml",
                    "title: Base\nseed: 9\nplaces: {a: {point: [1, 2]}}\nbodies:\n"
                    "  - {name: one, shape: {sphere: {radius: 1}}, mass: 3, at: [0, 0, 1]}\n"
                    "  - {name: two, shape: {sphere: {radius: 1}}, mass: 3, at: [5, 0, 1]}\n");
    strcat(text, "bodies: {two: {mass: 7}}\n");
    JoxSceneSpec *scene = jox_scene_read(write_test_file("main.yaml", text), NULL, &d);
    if (!scene)
        print_diagnostics(&d, text);
    assert_non_null(scene);
    assert_string_equal(scene->title, "Base");
    assert_int_equal(scene->seed, 2);
    assert_int_equal(scene->place_count, 2);
    assert_int_equal(scene->file_count, 2);
    assert_int_equal(scene->body_count, 2); /* the named one has changed and keeps its place */
    assert_float_equal(scene->bodies[0].def.mass, 3, 0);
    assert_float_equal(scene->bodies[1].def.mass, 7, 0);
    assert_float_equal(scene->bodies[1].def.position[0], 5, 0);
    jox_scene_free(scene);
    *strstr(text, "bodies:") = '\0';
    write_test_file("base.yaml", "title: Base\ninclude: [main.yaml]\n");
    assert_null(jox_scene_read(write_test_file("main.yaml", text), NULL, &d));
    assert_int_equal(d.errors, 1);
    assert_true(is_diagnostic(&d.items[0], "include-cycle", 2, 11, NULL));
    jox_diag_free(&d);
    unlink(write_test_file("base.yaml", ""));
    assert_null(jox_scene_read(write_test_file("main.yaml", text), NULL, &d));
    assert_true(is_diagnostic(&d.items[0], "unreadable-file", 2, 10, NULL));
    jox_diag_free(&d);
    free(stander);
    assert_null(jox_scene_read("/nowhere/at/all.yaml", NULL, &d));
    assert_string_equal(d.items[0].code, "unreadable-file");
    jox_diag_free(&d);
}

/* Keys whose edits a reload cannot apply are listed with the reason; other edited keys are not. */
static void edits_that_need_restart_are_listed(void **state) {
    (void)state;
    JoxDiagnostics d = {0};
    JoxText later = {0};
    JoxSceneSpec *a = read_scene_text(
        "jostle: 1\ntitle: one\nseed: 1\nregions: {r: [[0, 0], [1, 0], [0, 1]]}\n" GROUP, NULL, 0,
        &d);
    JoxSceneSpec *b =
        read_scene_text("jostle: 1\ntitle: two\n# moved\n\nregions: {r: [[0, 0], [1, 0], [0, 2]]}\n"
                        "seed: 2\n" GROUP,
                        NULL, 0, &d);
    if (!a)
        print_diagnostics(&d, "a");
    assert_non_null(a);
    assert_non_null(b);
    jox_scene_list_restart_keys(a, a, &later);
    assert_int_equal(later.length, 0);
    jox_scene_list_restart_keys(a, b, &later);
    assert_string_equal(later.data, "seed (all random numbers follow from it), regions (they are "
                                    "measured from the start on)");
    assert_true(jox_scene_differs(a, b, "title"));
    assert_false(jox_scene_differs(a, b, "groups"));
    jox_text_free(&later);
    jox_scene_free(a);
    jox_scene_free(b);
    jox_diag_free(&d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(overrides_change_only_their_path),
        cmocka_unit_test(anchors_and_merge_keys),
        cmocka_unit_test(edits_that_need_restart_are_listed),
        cmocka_unit_test(mass_of_compound_scales_parts),
        cmocka_unit_test(included_files_give_missing_keys),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
