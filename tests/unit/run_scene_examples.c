/* Tests that every example of the scene reference runs, and that errors found after a scene was
 * parsed name its line. The scenes are written beside links to the shipped behaviours. */
#include "jostle_tools.h"
#include "messages.h"
#include "run/load_scene.h"
#include "run/run.h"
#include "unit/test_folder.h"

static const char *const COPIED[] = {"tawaf.yaml", "running-through.yaml", "dodgeball.input",
                                     "hall.wkt"};

static void link_file(const char *from, const char *to) {
    char *whole = realpath(from, NULL);
    assert_non_null(whole);
    assert_int_equal(symlink(whole, test_path(to)), 0);
    free(whole);
}

/* Includes must lie in the folder of the scene after links are resolved, so that these are copies.
 */
static void copy_file(const char *name) {
    char bytes[4096];
    FILE *from = fopen(name, "r"), *to = fopen(test_path(name), "w");
    assert_true(from && to);
    for (size_t size; (size = fread(bytes, 1, sizeof bytes, from)) > 0;)
        assert_int_equal(fwrite(bytes, 1, size, to), size);
    assert_int_equal(fclose(from), 0);
    assert_int_equal(fclose(to), 0);
}

static int lay_out_folder(void **state) {
    char from[256];
    if (make_test_folder(state) != 0 || mkdir(test_path("scenes"), 0700) != 0)
        return -1;
    link_file("behaviours", "behaviours");
    link_file("scripts", "scripts");
    for (size_t i = 0; i < sizeof COPIED / sizeof *COPIED; i++) {
        snprintf(from, sizeof from, "scenes/%s", COPIED[i]);
        copy_file(from);
    }
    return 0;
}

static JoScene *load_example(const char *name, JoxText *said) {
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    def.path = test_path(name);
    def.message = append_message;
    def.message_context = said;
    JoScene *scene = jo_scene_load(&def, &error);
    if (scene)
        assert_int_equal(error.code, JO_OK);
    return scene;
}

static void every_example_runs(void **state) {
    (void)state;
    for (size_t e = 0; e < jox_scene_example_count; e++) {
        const JoxExample *example = &jox_scene_examples[e];
        JoxText said = {0};
        JoError error = {0};
        if (strncmp(example->yaml, "jostle:", 7) != 0 ||
            (!JOX_BULLET && strstr(example->yaml, "bodies:")))
            continue; /* a mod's file, or bodies in a build without Bullet */
        write_test_file("scenes/example.yaml", example->yaml);
        JoScene *scene = load_example("scenes/example.yaml", &said);
        bool ran = scene != NULL;
        for (int step = 0; ran && step < 20; step++)
            ran = jo_scene_step(scene, &error);
        if (!ran)
            fail_msg("the example of %s: %s %s", example->owner, said.data ? said.data : "",
                     error.text);
        double time = jo_world_time(jo_scene_world(scene));
        assert_true(time > 0.99 && time < 1.01);
        jo_scene_free(scene);
        jox_text_free(&said);
    }
}

/* A scene with an error; an `@`, which is removed, marks where the error must be reported. */
typedef struct Case {
    const char *text, *code, *hint;
} Case;

#define STANDER(x) "groups: {g: {behaviour: stander.lua, " x "}}\n"
static const Case CASES[] = {
    {STANDER("at: [[0, 0]], set: {@sped: 1}"), "unknown-value", "Did you mean 'speed'?"},
    {STANDER("at: [[0, 0]], memory: {@laps: 1}"), "unknown-value", NULL},
    {"groups: {g: {behaviour: walker.lua, at: [[0, 0]], set: {@goal: 3}}}\n", "bad-type", NULL},
    {"places: {a: {point: [9, 9]}}\n" STANDER("at: [[0, 0]], set: {@speed: a}"), "bad-type", NULL},
    {"places: {a: {point: [9, 9]}}\nsources:\n  - {at: a, like: g, rate: 1, memory: {@laps: "
     "1}}\n" STANDER("at: [[0, 0]]"),
     "unknown-value", NULL},
#if JOX_BULLET
    {"bodies:\n  - @{shape: {hull: {points: [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]]}}, at: "
     "[0, 0, 1]}\n",
     "bad-body", NULL},
#else
    {"bodies:\n  - @{shape: {sphere: {radius: 1}}, at: [0, 0, 1]}\n", "bad-body", NULL},
#endif
};

/* Removes the mark from `text`, and returns its line, its column and the text of the line. */
static void find_mark(char *text, int *line, int *column, char *source) {
    char *at = strchr(text, '@'), *begin = text;
    assert_non_null(at);
    *line = 1;
    for (char *k = text; k < at; k++)
        if (*k == '\n') {
            (*line)++;
            begin = k + 1;
        }
    *column = (int)(at - begin) + 1;
    memmove(at, at + 1, strlen(at));
    snprintf(source, 512, "%.*s", (int)strcspn(begin, "\n"), begin);
}

static int compare_diagnostic(const JoxDiagnostics *d, const Case *wanted, const char *name,
                              int line, int column, const char *source) {
    const JoxDiagnostic *item = d->items;
    if (d->errors == 1 && !strcmp(item->code, wanted->code) && item->line == line &&
        item->column == column && strstr(item->file, name) && item->source &&
        !strcmp(item->source, source) &&
        (!wanted->hint || (item->hint && strstr(item->hint, wanted->hint))))
        return 0;
    JoxText text = {0};
    jox_diag_print(d, &text);
    print_message("wanted one %s at %d:%d\n%s\n", wanted->code, line, column,
                  text.data ? text.data : "(none)");
    jox_text_free(&text);
    return 1;
}

static int check_case(const Case *wanted, const char *text, const char *name) {
    char marked[2048], source[512];
    int line, column;
    snprintf(marked, sizeof marked, "%s", text);
    find_mark(marked, &line, &column, source);
    write_test_file(name, marked);
    JoxText said = {0};
    JoSceneDef def = jo_default_scene_def();
    JoxDiagnostics d = {0};
    def.path = test_path("scenes/example.yaml");
    def.message = append_message;
    def.message_context = &said;
    JoScene *scene = jox_run_load(&def, &d);
    int wrong = compare_diagnostic(&d, wanted, name, line, column, source);
    jo_scene_free(scene);
    jox_diag_free(&d);
    jox_text_free(&said);
    return wrong;
}

static void errors_after_reading_show_their_line(void **state) {
    (void)state;
    int wrong = 0;
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) {
        char text[2048];
        snprintf(text, sizeof text, "jostle: 1\n%s", CASES[c].text);
        wrong += check_case(&CASES[c], text, "scenes/example.yaml");
    }
    /* 63 tags and two more: the second of them is one too many. */
    JoxText many = {0};
    jox_text_add(&many, "jostle: 1\ngroups:\n  a: {behaviour: stander.lua, at: [[0, 0]], tags: [");
    for (int t = 0; t < 64; t++)
        jox_text_printf(&many, "t%d, ", t);
    jox_text_add(&many, "]}\n  @b: {behaviour: stander.lua, at: [[2, 0]], tags: [another]}\n");
    wrong += check_case(&(Case){NULL, "too-many-tags", NULL}, many.data, "scenes/example.yaml");
    jox_text_free(&many);
    assert_int_equal(wrong, 0);
}

static void errors_of_other_files_show_their_line(void **state) {
    (void)state;
    static const Case LINES[] = {
        {"0 player 0 1 0\n3 @piano 0 1 0\n", "bad-input",
         "One of player, throw, box, grab, drag, release, push, open, close, signal, set, files"},
        {"3 player@\n", "bad-input", "Example: player 0 1.5 0"},
        {"@-1 player 0 1 0\n", "bad-input", NULL},
        {"1 player 0 @99 0\n", "bad-input", NULL},
        {"5 player 0 1 0\n# back\n@4 player 0 0 0\n", "bad-input", NULL}};
    const Case value = {NULL, "unknown-value", "Did you mean 'speed'?"};
    write_test_file("scenes/example.yaml",
                    "jostle: 1\ninput: broken.input\n" STANDER("at: [[0, 0]]") "player: g\n");
    int wrong = 0;
    for (size_t i = 0; i < sizeof LINES / sizeof *LINES; i++)
        wrong += check_case(&LINES[i], LINES[i].text, "scenes/broken.input");
    write_test_file("scenes/example.yaml", "jostle: 1\ninclude: part.yaml\n");
    wrong += check_case(&value, STANDER("at: [[0, 0]],\n  set: {@sped: 1}"), "scenes/part.yaml");
    assert_int_equal(wrong, 0);
}

/* ---- many files ---- */

static size_t check_files(const char *name, bool json, JoxText *said) {
    const char *paths[] = {test_path(name)};
    return jo_check(paths, 1, json, append_message, said, NULL);
}

static int count_word(const char *text, const char *word) {
    int count = 0;
    for (const char *at = strstr(text, word); at; at = strstr(at + 1, word))
        count++;
    return count;
}

static void check_limits_errors_for_each_file(void **state) {
    (void)state;
    JoxText said = {0}, text = {0};
    jox_text_add(&text, "jostle: 1\n" STANDER("at: [[0, 0]]"));
    for (int k = 0; k < 30; k++)
        jox_text_printf(&text, "key_%d: 1\n", k);
    write_test_file("scenes/example.yaml", text.data);
    write_test_file("scenes/part.yaml", text.data);
    assert_int_equal(check_files("scenes", true, &said), 60);
    assert_int_equal(count_word(said.data, "example.yaml\""), 20);
    assert_int_equal(count_word(said.data, "part.yaml\""), 20);
    jox_text_free(&said);
    assert_int_equal(check_files("scenes", false, &said), 60);
    assert_int_equal(count_word(said.data, "unknown key"), 40);
    assert_non_null(strstr(said.data, "... and 20 more errors\n"));
    jox_text_free(&said);
    jox_text_free(&text);
    write_test_file("scenes/notes.txt", "text\n");
    assert_int_equal(check_files("scenes/notes.txt", true, &said), 1);
    assert_non_null(strstr(said.data, "\"unknown-kind\""));
    jox_text_free(&said);
    assert_int_equal(check_files("scenes/nothing.yaml", true, &said), 1);
    assert_non_null(strstr(said.data, "\"unreadable-file\""));
    jox_text_free(&said);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_example_runs),
        cmocka_unit_test(errors_after_reading_show_their_line),
        cmocka_unit_test(errors_of_other_files_show_their_line),
        cmocka_unit_test(check_limits_errors_for_each_file),
    };
    return cmocka_run_group_tests(tests, lay_out_folder, remove_test_folder);
}
