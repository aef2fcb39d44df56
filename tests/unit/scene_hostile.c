/* Reading a scene ends soon, with a scene or with errors, whatever bytes its file holds. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "base/mem.h"
#include "scene/scene.h"
#include "unit/effort.h"

/* LARGE: bytes of the largest file that is read. PIECES_LARGE: enough to show work that grows with
   the square of the size, which would take minutes, in a tenth of LARGE's time; with sanitizers a
   part of it. */
enum { LARGE = 10 << 20, PIECES_LARGE = (1 << 20) / EFFORT_EACH, MUTATIONS = 300 / EFFORT_EACH };
static const double SLOWEST = 20; /* s of processor time, for builds with sanitizers */

static double read_cpu_clock(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Reads a text, which must end in time and, unless `code` is NULL, report that error. Returns
   whether the text is a scene. */
static bool try_scene(const char *text, size_t length, const char *code) {
    const char *sets[] = {"groups.pilgrims.count=50", "groups.pilgrims.spacing=1"};
    JoxSceneOptions options = {.sets = sets, .set_count = strstr(text, "pilgrims:") ? 2 : 0};
    JoxDiagnostics d = {0};
    double began = read_cpu_clock();
    JoxSceneSpec *scene = jox_scene_read_text("scenes/hostile.yaml", text, length, &options, &d);
    assert_true(read_cpu_clock() - began < SLOWEST);
    assert_int_equal(scene != NULL, d.errors == 0);
    bool found = false;
    for (size_t i = 0; i < d.count; i++) {
        assert_true(d.items[i].message && *d.items[i].message && d.items[i].code);
        found |= code && !strcmp(d.items[i].code, code);
    }
    if (code && !found)
        print_message("no %s but %s\n", code, d.count ? d.items[0].code : "nothing");
    assert_true(!code || found);
    JoxText out = {0};
    jox_diag_print(&d, &out);
    jox_diag_json(&d, &out);
    jox_text_free(&out);
    jox_scene_free(scene);
    jox_diag_free(&d);
    return scene != NULL;
}

static uint64_t dice;
static uint32_t roll(uint32_t sides) {
    dice = dice * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(dice >> 33) % sides;
}

static void garbage_of_ten_megabytes_is_refused(void **state) {
    (void)state;
    char *text = malloc(LARGE + 2);
    assert_non_null(text);
    dice = 1;
    for (int i = 0; i < LARGE; i++)
        text[i] = (char)roll(256);
    text[LARGE] = text[LARGE + 1] = 0;
    try_scene(text, LARGE, "bad-text");
    for (int i = 0; i < LARGE; i++)
        text[i] = (char)(32 + roll(95));
    try_scene(text, LARGE, "bad-yaml");
    try_scene(text, LARGE + 1, "unreadable-file");
    static const char *const PIECES[] = {
        "[",     "{", "- ",  "? ", "a: ", "a\n",     "\n",       "!a ",      "a: 1\n",
        "- a\n", "'", "[],", "#",  "%",   "a: {}\n", "x: [a]\n", "&a [*a, ", "<<: {}\n"};
    for (size_t p = 0; p < sizeof PIECES / sizeof *PIECES; p++) {
        size_t n = strlen(PIECES[p]);
        for (size_t i = 0; i < PIECES_LARGE; i++)
            text[i] = PIECES[p][i % n];
        text[PIECES_LARGE] = 0;
        assert_false(try_scene(text, PIECES_LARGE, NULL));
    }
    free(text);
}

static void many_keys_and_names_are_refused(void **state) {
    (void)state;
    JoxText text = {0};
    jox_text_add(&text, "jostle: 1\n");
    for (int i = 0; i < 200000; i++)
        jox_text_printf(&text, "k%d: 1\n", i);
    try_scene(text.data, text.length, "too-large");
    jox_text_free(&text);
    jox_text_add(&text, "jostle: 1\nplaces:\n");
    for (int i = 0; i < 1000; i++)
        jox_text_printf(&text, "  place_%d: {point: [0, 0]}\n", i);
    jox_text_add(&text, "  all: {set: [");
    for (int i = 0; i < 100000; i++)
        jox_text_printf(&text, "plaze_%d, ", i);
    jox_text_add(&text, "]}\ngroups: {g: {behaviour: stander, at: [[0, 0]]}}\n");
    try_scene(text.data, text.length, "unknown-place");
    jox_text_free(&text);
}

static void nested_aliases_are_refused(void **state) {
    (void)state;
    JoxText text = {0};
    jox_text_add(&text, "jostle: 1\ntitle:\n - &a0 [x, x]\n");
    for (int i = 1; i < 200; i++)
        jox_text_printf(&text, " - &a%d [*a%d, *a%d]\n", i, i - 1, i - 1);
    try_scene(text.data, text.length, "too-large");
    jox_text_free(&text);
    jox_text_add(&text, "jostle: 1\ntitle:\n - &a0 {k: {k: 1}}\n");
    for (int i = 1; i < 200; i++) /* maps merged into maps */
        jox_text_printf(&text, " - &a%d {<<: *a%d, k%d: *a%d, k: {<<: *a%d}}\n", i, i - 1, i, i - 1,
                        i - 1);
    try_scene(text.data, text.length, "too-large");
    jox_text_free(&text);
    jox_text_add(&text, "jostle: 1\ntitle:\n - &a0 [x]\n");
    for (int i = 1; i < 250; i++) /* not large, but deep */
        jox_text_printf(&text, " - &a%d [[[[[[[[*a%d]]]]]]]]\n", i, i - 1);
    try_scene(text.data, text.length, "bad-type");
    jox_text_free(&text);
    jox_text_add(&text, "jostle: 1\nplaces: {p: {point: [0, 0], radius: 900}}\ngroups:\n"
                        "  g0: &g {behaviour: stander, count: 100000, fill: circle, in: p}\n");
    for (int i = 1; i < 1000; i++)
        jox_text_printf(&text, "  g%d: *g\n", i);
    try_scene(text.data, text.length, "too-many");
    jox_text_free(&text);
}

static void deep_nesting_is_refused(void **state) {
    (void)state;
    static const char *const OPEN[] = {"[", "{a: ", "- ", "? "};
    for (int o = 0; o < 4; o++) {
        JoxText text = {0};
        jox_text_add(&text, o < 2 ? "jostle: 1\ntitle: " : "jostle: 1\ntitle:\n  ");
        for (int i = 0; i < 10000; i++)
            jox_text_add(&text, OPEN[o]);
        jox_text_add(&text, "x");
        for (int i = 0; i < 10000 && o < 2; i++)
            jox_text_add(&text, o ? "}" : "]");
        try_scene(text.data, text.length, o < 3 ? "too-large" : NULL);
        jox_text_free(&text);
    }
}

static void near_empty_files_are_refused(void **state) {
    (void)state;
    static const char *const TEXTS[] = {"",
                                        "\n",
                                        "~",
                                        "---\n",
                                        "- a\n",
                                        "jostle: 1",
                                        "\xef\xbb\xbf",
                                        "\xff\xfe",
                                        "x: 1\n--- \ny: 1\n",
                                        "[a, b]: 1",
                                        "a: [",
                                        "a: *a",
                                        "&a a: *a"};
    for (size_t i = 0; i < sizeof TEXTS / sizeof *TEXTS; i++)
        assert_false(try_scene(TEXTS[i], strlen(TEXTS[i]), NULL));
    assert_false(try_scene("jostle: 1\0\0\0", 12, NULL));
}

static void mutate_text(char *text, size_t *length, size_t room) {
    static const char SPICE[] = "[]{}:,-&*!|>'\"#%@` \n\t0123456789eE.+~<x\x00\x80\xff";
    uint32_t at = roll((uint32_t)*length), n = 1 + roll(12);
    char spice = SPICE[roll(sizeof SPICE - 1)];
    switch (roll(5)) {
    case 0:
        text[at] = (char)roll(256);
        break;
    case 1:
        text[at] = spice;
        break;
    case 2:
        if (*length + 1 < room) {
            memmove(text + at + 1, text + at, *length - at);
            text[at] = spice;
            (*length)++;
        }
        break;
    case 3:
        n = n < *length - at ? n : (uint32_t)(*length - at);
        if (*length > n + 1) {
            memmove(text + at, text + at + n, *length - at - n);
            *length -= n;
        }
        break;
    default: /* copy a piece of the text over another */
        for (uint32_t k = 0, from = roll((uint32_t)*length); k < n; k++)
            if (at + k < *length && from + k < *length)
                text[at + k] = text[from + k];
    }
}

static void mutated_scenes_are_read_or_refused(void **state) {
    (void)state;
    static const char *const SCENES[] = {"circle", "dodgeball", "running-through", "tawaf"};
    dice = 20;
    for (int s = 0; s < 4; s++) {
        char path[64];
        snprintf(path, sizeof path, "scenes/%s.yaml", SCENES[s]);
        size_t whole;
        char *original = jox_read_file(path, LARGE, &whole);
        assert_non_null(original);
        size_t room = whole + 64;
        char *text = calloc(1, room + 1);
        assert_true(try_scene(original, whole, NULL));
        double slowest = 0;
        int scenes = 0;
        for (int m = 0; m < MUTATIONS; m++) {
            size_t length = whole;
            memset(text, 0, room + 1);
            memcpy(text, original, whole);
            for (uint32_t k = 1 + roll(4); k > 0; k--)
                mutate_text(text, &length, room);
            text[length] = 0;
            double began = read_cpu_clock();
            scenes += try_scene(text, length, NULL);
            slowest = read_cpu_clock() - began > slowest ? read_cpu_clock() - began : slowest;
        }
        print_message("%s: %d of %d are scenes still, the slowest took %.3f s\n", SCENES[s], scenes,
                      MUTATIONS, slowest);
        assert_true(scenes > 0 && scenes < MUTATIONS);
        free(text);
        jox_free(original);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(garbage_of_ten_megabytes_is_refused),
                                       cmocka_unit_test(many_keys_and_names_are_refused),
                                       cmocka_unit_test(nested_aliases_are_refused),
                                       cmocka_unit_test(deep_nesting_is_refused),
                                       cmocka_unit_test(near_empty_files_are_refused),
                                       cmocka_unit_test(mutated_scenes_are_read_or_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
