/* Claims: what measure is given of a run's folder, written here by hand, and what is made of it. */
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

#include "base/mem.h"
#include "validate/claims.h"

static char folder[64];

static const char *in_folder(const char *name) {
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void put(const char *name, const char *text) {
    FILE *file = fopen(in_folder(name), "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/* Measures figures x, y and z by the body of a function; what went wrong is left in `why`. */
static bool measure(const char *body, double values[3], JoxText *why) {
    JoxText text = {0};
    JoxDiagnostics diagnostics = {0};
    jox_text_printf(&text,
                    "return claim { id = 'T', title = 't', source = 's',\n"
                    "  runs = { one = { scene = 'x.yaml' } }, measure = function(run)\n%s\nend,\n"
                    "  expect = { { 'x', band = { 1, 2 } }, { 'y', reported = true },\n"
                    "    { 'z', reported = true } } }\n",
                    body);
    put("claim.lua", text.data);
    jox_text_free(&text);
    JoxClaim *claim = jox_claim_load(in_folder("claim.lua"), false, &diagnostics);
    assert_non_null(claim);
    assert_int_equal(claim->run_count, 1);
    assert_int_equal(claim->figure_count, 3);
    bool good = jox_claim_measure(claim, (const char *const[]){folder}, values, why);
    jox_claim_free(claim);
    jox_diag_free(&diagnostics);
    return good;
}

static void gives(const char *body, double x, double y, double z) {
    double values[3];
    JoxText why = {0};
    if (!measure(body, values, &why))
        fail_msg("%s", why.data);
    double wanted[] = {x, y, z};
    for (int f = 0; f < 3; f++)
        if (isnan(wanted[f]))
            assert_true(isnan(values[f]));
        else
            assert_float_equal((float)values[f], (float)wanted[f], 1e-6f);
    jox_text_free(&why);
}

static void refuses(const char *body, const char *text) {
    double values[3];
    JoxText why = {0};
    assert_false(measure(body, values, &why));
    if (!why.data || !strstr(why.data, text))
        fail_msg("'%s' does not say '%s'", why.data ? why.data : "", text);
    jox_text_free(&why);
}

static void test_summary(void **state) {
    (void)state;
    put("summary.json", "{\"agents\": 3, \"list\": [1.5, -2e3], \"probes\": {\"door\": "
                        "{\"flow\": 1.25, \"none\": null, \"name\": \"a\\\"b\"}}, \"done\": true}");
    gives("local s = run.one.summary return { x = s.agents, y = s.probes.door.flow, "
          "z = s.probes.door.none }",
          3, 1.25, NAN);
    refuses("return { x = run.one.summary.probes.gate.flow }", "claim.lua:3: ");
    refuses("return { y = 1 }", "measure returned no number 'x'");
    refuses("return { x = '7' }", "measure returned no number 'x'");
    refuses("return 1", "measure returned no table");
    put("summary.json", "{\"agents\": 3");
    refuses("return { x = 1 }", "is not JSON");
    unlink(in_folder("summary.json"));
    refuses("return { x = 1 }", "the run left no summary.json");
}

static void test_csv(void **state) {
    (void)state;
    put("summary.json", "{}");
    put("a.csv", "time [s],who,last value [m]\n1.5,7,\n2.5,,-3\nnan,9,1e2\n");
    gives("local a = run.one.csv('a') return { x = a.n, y = a.time[1], z = a.who[1] }", 3, 1.5, 7);
    /* A value that is missing is missing, and not that of the next line. */
    gives(
        "local a = run.one.csv('a') return { x = a.who[3], y = a.who[2], z = a['last value'][1] }",
        9, NAN, NAN);
    gives("local a = run.one.csv('a') return { x = a['last value'][2], y = a['last value'][3], "
          "z = a.time[3] }",
          -3, 100, NAN);
    put("b.csv", "time [s]\n");
    gives("local b = run.one.csv('b') return { x = b.n, y = #b.time, z = 1 }", 0, 0, 1);
    put("c.csv", "x,y\r\n1,2\n3");
    gives("local c = run.one.csv('c') return { x = c.n, y = c.x[2], z = c.x[1] }", 2, 3, 1);
    put("d.csv", "");
    gives("return { x = run.one.csv('d').n }", 0, NAN, NAN);
    refuses("return { x = run.one.csv('absent').n }", "the run left no absent.csv");
    refuses("return { x = run.one.csv('../a').n }", "csv takes the name of a probe");
}

static int set_up(void **state) {
    (void)state;
    snprintf(folder, sizeof folder, "/tmp/jostle-claims-XXXXXX");
    return mkdtemp(folder) ? 0 : 1;
}

static int tear_down(void **state) {
    (void)state;
    const char *files[] = {"summary.json", "claim.lua", "a.csv", "b.csv", "c.csv", "d.csv"};
    for (size_t f = 0; f < sizeof files / sizeof *files; f++)
        unlink(in_folder(files[f]));
    return rmdir(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_summary), cmocka_unit_test(test_csv)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
