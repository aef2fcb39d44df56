/* Claims: what `measure` gets from a run's folder, written by hand here, and which of its
   results are accepted. */
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
#include "unit/test_folder.h"
#include "validate/claims.h"

/* Measures figures x, y and z by a function with the given body. Returns false with a sentence
   in `why`. */
static bool measure_body(const char *body, double values[3], JoxText *why) {
    JoxText text = {0};
    JoxDiagnostics diagnostics = {0};
    jox_text_printf(&text,
                    "return claim { id = 'T', title = 't', source = 's',\n"
                    "  runs = { one = { scene = 'x.yaml' } }, measure = function(run)\n%s\nend,\n"
                    "  expect = { { 'x', band = { 1, 2 } }, { 'y', reported = true },\n"
                    "    { 'z', reported = true } } }\n",
                    body);
    write_test_file("claim.lua", text.data);
    jox_text_free(&text);
    JoxClaim *claim = jox_claim_load(test_path("claim.lua"), false, &diagnostics);
    assert_non_null(claim);
    assert_int_equal(claim->run_count, 1);
    assert_int_equal(claim->figure_count, 3);
    bool good = jox_claim_measure(claim, (const char *const[]){test_folder}, true, values, why);
    jox_claim_free(claim);
    jox_diag_free(&diagnostics);
    return good;
}

static void expect_figures(const char *body, double x, double y, double z) {
    double values[3];
    JoxText why = {0};
    if (!measure_body(body, values, &why))
        fail_msg("%s", why.data);
    double wanted[] = {x, y, z};
    for (int f = 0; f < 3; f++)
        if (isnan(wanted[f]))
            assert_true(isnan(values[f]));
        else
            assert_float_equal((float)values[f], (float)wanted[f], 1e-6f);
    jox_text_free(&why);
}

static void expect_refusal(const char *body, const char *text) {
    double values[3];
    JoxText why = {0};
    assert_false(measure_body(body, values, &why));
    if (!why.data || !strstr(why.data, text))
        fail_msg("'%s' does not say '%s'", why.data ? why.data : "", text);
    jox_text_free(&why);
}

static void measure_reads_numbers_of_summary(void **state) {
    (void)state;
    write_test_file("summary.json",
                    "{\"agents\": 3, \"list\": [1.5, -2e3], \"probes\": {\"door\": "
                    "{\"flow\": 1.25, \"none\": null, \"name\": \"a\\\"b\"}}, \"done\": true}");
    expect_figures("local s = run.one.summary return { x = s.agents, y = s.probes.door.flow, "
                   "z = s.probes.door.none }",
                   3, 1.25, NAN);
    expect_refusal("return { x = run.one.summary.probes.gate.flow }", "claim.lua:3: ");
    expect_refusal("return { y = 1 }", "measure returned no number 'x'");
    expect_refusal("return { x = '7' }", "measure returned no number 'x'");
    expect_refusal("return 1", "measure returned no table");
    write_test_file("summary.json", "{\"agents\": 3");
    expect_refusal("return { x = 1 }", "is not JSON");
    unlink(test_path("summary.json"));
    expect_refusal("return { x = 1 }", "the run left no summary.json");
}

static void measure_reads_columns_of_csv(void **state) {
    (void)state;
    write_test_file("summary.json", "{}");
    write_test_file("a.csv", "time [s],who,last value [m]\n1.5,7,\n2.5,,-3\nnan,9,1e2\n");
    expect_figures("local a = run.one.csv('a') return { x = a.n, y = a.time[1], z = a.who[1] }", 3,
                   1.5, 7);
    /* A missing value is nil; the next line's is not taken for it. */
    expect_figures(
        "local a = run.one.csv('a') return { x = a.who[3], y = a.who[2], z = a['last value'][1] }",
        9, NAN, NAN);
    expect_figures(
        "local a = run.one.csv('a') return { x = a['last value'][2], y = a['last value'][3], "
        "z = a.time[3] }",
        -3, 100, NAN);
    write_test_file("b.csv", "time [s]\n");
    expect_figures("local b = run.one.csv('b') return { x = b.n, y = #b.time, z = 1 }", 0, 0, 1);
    write_test_file("c.csv", "x,y\r\n1,2\n3");
    expect_figures("local c = run.one.csv('c') return { x = c.n, y = c.x[2], z = c.x[1] }", 2, 3,
                   1);
    write_test_file("d.csv", "");
    expect_figures("return { x = run.one.csv('d').n }", 0, NAN, NAN);
    expect_refusal("return { x = run.one.csv('absent').n }", "the run left no absent.csv");
    expect_refusal("return { x = run.one.csv('../a').n }", "csv takes the name of a probe");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(measure_reads_numbers_of_summary),
                                       cmocka_unit_test(measure_reads_columns_of_csv)};
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
