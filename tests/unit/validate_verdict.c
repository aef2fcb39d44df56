/* Verdicts: means over seeds, their confidence bounds, and whether they are in a band. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "validate/verdict.h"

static void expect_near(double value, double wanted, double within) {
    if (!(fabs(value - wanted) <= within))
        fail_msg("%.9g is not %.9g", value, wanted);
}

/* 8 9 10 11 12: mean 10, deviation sqrt(2.5), error of the mean .7071, t(4) = 2.776. */
static void mean_has_confidence_bound(void **state) {
    (void)state;
    const double values[] = {12, 8, 11, 9, 10};
    JoxVerdict v = jox_verdict(values, 5, 9, 11);
    expect_near(v.mean, 10, 1e-12);
    expect_near(v.least, 8, 0);
    expect_near(v.most, 12, 0);
    expect_near(v.bound, 1.9632, 1e-3);
    assert_int_equal(v.seeds, 5);
    assert_true(v.inside && v.thin);
}

/* The mean decides; a band edge within the bound makes either verdict thin. */
static void band_edge_within_bound_makes_verdict_thin(void **state) {
    (void)state;
    static const struct {
        double low, high;
        bool inside, thin;
    } CASES[] = {{8, 12, true, false},       {8.1, 12, true, true},
                 {8, 11.9, true, true},      {10.5, 20, false, true},
                 {1, 9, false, true},        {12.1, 20, false, false},
                 {1, 7.9, false, false},     {-INFINITY, 12, true, false},
                 {8, INFINITY, true, false}, {-INFINITY, INFINITY, true, false},
                 {9.9, INFINITY, true, true}};
    const double values[] = {12, 8, 11, 9, 10};
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) {
        JoxVerdict v = jox_verdict(values, 5, CASES[c].low, CASES[c].high);
        if (v.inside != CASES[c].inside || v.thin != CASES[c].thin)
            fail_msg("%g to %g: inside %d, thin %d", CASES[c].low, CASES[c].high, v.inside, v.thin);
    }
}

/* A band of a single value contains the mean of any number of equal values: rounding must not
   move it. */
static void mean_of_equal_values_is_exact(void **state) {
    (void)state;
    double values[30];
    for (uint32_t count = 1; count <= 30; count++)
        for (int k = 0; k < 3; k++) {
            const double value = (const double[]){8, 0.1, 1e9 / 3}[k];
            for (uint32_t s = 0; s < count; s++)
                values[s] = value;
            JoxVerdict v = jox_verdict(values, count, value, value);
            assert_true(v.inside && v.mean == value);
        }
}

static void single_seed_has_no_bound(void **state) {
    (void)state;
    JoxVerdict v = jox_verdict((const double[]){3}, 1, 2, 3);
    assert_true(isnan(v.bound) && v.inside && !v.thin);
    v = jox_verdict((const double[]){3, 3, 3}, 3, 3, 3);
    expect_near(v.bound, 0, 0);
    assert_true(v.inside && !v.thin);
}

static void unmeasured_value_is_not_in_band(void **state) {
    (void)state;
    JoxVerdict v = jox_verdict((const double[]){3, NAN, 3}, 3, 2, 4);
    assert_true(isnan(v.mean) && isnan(v.bound) && !v.inside && !v.thin);
}

static void seeds_parse_as_one_or_a_range(void **state) {
    (void)state;
    uint64_t first;
    uint32_t count;
    assert_true(jox_seeds_read("101", &first, &count));
    assert_true(first == 101 && count == 1);
    assert_true(jox_seeds_read("101-110", &first, &count));
    assert_true(first == 101 && count == 10);
    assert_true(jox_seeds_read("0-999", &first, &count));
    assert_int_equal(count, 1000);
    static const char *const WRONG[] = {"",       "a",     "-3",    "3-",   "3-2",
                                        "1-1001", "1.5",   "1-2.5", "1-2x", "1--2",
                                        "1 - 2",  "1-2-3", " 1",    "1e99"};
    for (size_t w = 0; w < sizeof WRONG / sizeof *WRONG; w++)
        if (jox_seeds_read(WRONG[w], &first, &count))
            fail_msg("'%s' is taken for seeds", WRONG[w]);
}

static void bounds_print_two_digits_without_exponent(void **state) {
    (void)state;
    static const struct {
        double bound;
        const char *text;
    } CASES[] = {{0.4712, "+- 0.47"}, {12.4, "+- 12"}, {99.4, "+- 99"}, {99.6, "+- 100"},
                 {881.2, "+- 881"},   {0.0, "+- 0"},   {NAN, ""},       {INFINITY, ""}};
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) {
        char text[JOX_BOUND_SIZE];
        jox_bound_write(text, CASES[c].bound);
        assert_string_equal(text, CASES[c].text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(mean_has_confidence_bound),
                                       cmocka_unit_test(band_edge_within_bound_makes_verdict_thin),
                                       cmocka_unit_test(mean_of_equal_values_is_exact),
                                       cmocka_unit_test(single_seed_has_no_bound),
                                       cmocka_unit_test(unmeasured_value_is_not_in_band),
                                       cmocka_unit_test(seeds_parse_as_one_or_a_range),
                                       cmocka_unit_test(bounds_print_two_digits_without_exponent)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
