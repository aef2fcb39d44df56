/* Means over seeds, how sure they are, and what that says about a band. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "validate/verdict.h"

static void near_to(double value, double wanted, double within) {
    if (!(fabs(value - wanted) <= within))
        fail_msg("%.9g is not %.9g", value, wanted);
}

/* 8 9 10 11 12: mean 10, deviation sqrt(2.5), error of the mean .7071, t(4) = 2.776. */
static void a_mean_has_a_bound(void **state) {
    (void)state;
    const double values[] = {12, 8, 11, 9, 10};
    JoxVerdict v = jox_verdict(values, 5, 9, 11);
    near_to(v.mean, 10, 1e-12);
    near_to(v.least, 8, 0);
    near_to(v.most, 12, 0);
    near_to(v.bound, 1.9632, 1e-3);
    assert_int_equal(v.seeds, 5);
    assert_true(v.inside && v.thin);
}

/* The mean decides; an edge within the bound about it makes either verdict thin. */
static void an_edge_within_the_bound_is_thin(void **state) {
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

/* A band of one value is met by any number of equal ones: no rounding comes in. */
static void equal_values_have_their_own_mean(void **state) {
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

static void one_seed_has_no_bound(void **state) {
    (void)state;
    JoxVerdict v = jox_verdict((const double[]){3}, 1, 2, 3);
    assert_true(isnan(v.bound) && v.inside && !v.thin);
    v = jox_verdict((const double[]){3, 3, 3}, 3, 3, 3);
    near_to(v.bound, 0, 0);
    assert_true(v.inside && !v.thin);
}

static void what_was_not_measured_is_not_inside(void **state) {
    (void)state;
    JoxVerdict v = jox_verdict((const double[]){3, NAN, 3}, 3, 2, 4);
    assert_true(isnan(v.mean) && isnan(v.bound) && !v.inside && !v.thin);
}

static void seeds_are_one_or_a_range(void **state) {
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

static void bounds_have_two_digits_and_no_exponents(void **state) {
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
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_mean_has_a_bound),
                                       cmocka_unit_test(an_edge_within_the_bound_is_thin),
                                       cmocka_unit_test(equal_values_have_their_own_mean),
                                       cmocka_unit_test(one_seed_has_no_bound),
                                       cmocka_unit_test(what_was_not_measured_is_not_inside),
                                       cmocka_unit_test(seeds_are_one_or_a_range),
                                       cmocka_unit_test(bounds_have_two_digits_and_no_exponents)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
