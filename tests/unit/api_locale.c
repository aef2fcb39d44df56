/* A program whose numbers have a decimal comma: scenes are read, run and told of as in any other,
   and its own callbacks have its own locale. */
#include <locale.h>
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

#include "jostle_tell.h"
#include "jostle_tools.h"

static char folder[] = "/tmp/jostle-locale-XXXXXX";
static uint32_t heard;

static bool has_comma(void) {
    char text[16];
    snprintf(text, sizeof text, "%.1f", 1.5);
    return strcmp(text, "1,5") == 0;
}

/* Makes a locale of C but for the comma, as few machines have any; false where that cannot be. */
static bool make_locale(void) {
    static const char *const COPIED[] = {"CTYPE", "COLLATE", "MONETARY", "TIME", "MESSAGES"};
    char path[200], command[600];
    snprintf(path, sizeof path, "%s/comma", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("comment_char %\nescape_char /\n", file);
    fputs("LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\ngrouping 3\nEND LC_NUMERIC\n",
          file);
    for (size_t c = 0; c < sizeof COPIED / sizeof *COPIED; c++)
        fprintf(file, "LC_%s\ncopy \"POSIX\"\nEND LC_%s\n", COPIED[c], COPIED[c]);
    assert_int_equal(fclose(file), 0);
    snprintf(command, sizeof command,
             "localedef -c -i %s -f ANSI_X3.4-1968 %s/comma_XX >%s/said 2>&1", path, folder,
             folder);
    return system(command) <= 1 << 8; /* 1: with warnings */
}

static int begin(void **state) {
    (void)state;
    return mkdtemp(folder) && setenv("LOCPATH", folder, 1) == 0 ? 0 : -1;
}

static int end(void **state) {
    (void)state;
    char command[100];
    setlocale(LC_ALL, "C");
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static void hear(void *context, const char *text) {
    (void)text;
    heard++;
    if (*(const bool *)context != has_comma())
        fail_msg("a callback has another locale than the program");
}

typedef struct Told {
    char *summary;
    JoTable *table;
} Told;

static Told run(const char *recording) {
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    bool comma = has_comma();
    const char *const sets[] = {"groups.people.set.speed=1.25"};
    def.path = "scenes/bottleneck.yaml";
    def.overrides = sets;
    def.override_count = 1;
    def.threads = 2;
    def.message = hear;
    def.message_context = &comma;
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene)
        fail_msg("%s:%d: %s", error.file, error.line, error.text);
    assert_true(jo_scene_record(scene, recording, 0.25, &error));
    for (int k = 0; k < 300; k++)
        assert_true(jo_scene_step(scene, &error));
    assert_true(jo_scene_finish(scene, &error));
    const Told told = {jo_scene_summary(scene), jo_scene_probe_table(scene, 0)};
    jo_scene_free(scene);
    assert_int_equal(has_comma(), comma); /* as before */
    return told;
}

/* Figures begin behind the times that it took, which no two runs have in common. */
static void assert_same_figures(const char *a, const char *b) {
    static const char FIRST[] = "\"lp_failure_share\"";
    const char *one = strstr(a, FIRST), *other = strstr(b, FIRST);
    assert_true(one && other);
    assert_string_equal(one, other);
    for (const char *at = b; at < other; at++)
        assert_false(at[0] == ',' && at[1] >= '0' && at[1] <= '9');
}

static void decimal_commas_change_nothing(void **state) {
    (void)state;
    char one[200], other[200], command[900];
    if (!make_locale())
        skip();
    snprintf(one, sizeof one, "%s/one.sqlite", folder);
    snprintf(other, sizeof other, "%s/other.sqlite", folder);
    assert_non_null(setlocale(LC_ALL, "C"));
    const Told plain = run(one);
    if (!setlocale(LC_ALL, "comma_XX"))
        skip();
    assert_true(has_comma());
    const Told comma = run(other);
    assert_same_figures(plain.summary, comma.summary);
    assert_int_equal(plain.table->row_count, comma.table->row_count);
    assert_true(plain.table->row_count > 0);
    for (uint32_t c = 0; c < plain.table->column_count; c++)
        for (uint32_t r = 0; r < plain.table->row_count; r++) {
            const double x = plain.table->columns[c].numbers[r];
            const double y = comma.table->columns[c].numbers[r];
            assert_true(x == y || (isnan(x) && isnan(y)));
        }
    snprintf(command, sizeof command,
             "sqlite3 %s .dump >%s/a && sqlite3 %s .dump >%s/b && cmp -s %s/a %s/b", one, folder,
             other, folder, folder, folder);
    assert_int_equal(system(command), 0);
    jo_free(plain.summary);
    jo_free(comma.summary);
    jo_free(plain.table);
    jo_free(comma.table);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(decimal_commas_change_nothing)};
    return cmocka_run_group_tests(tests, begin, end);
}
