/* Statistics against numbers that textbooks and papers print. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/number/statistics.h"

static void check_within(double value, double wanted, double within) {
    if (!(fabs(value - wanted) <= within))
        fail_msg("%.9g is not %.9g", value, wanted);
}

/* Two-sided points of Student's distribution, as in the tables of Fisher and Yates, "Statistical
   Tables for Biological, Agricultural and Medical Research", table III. */
static void student_t_matches_tables(void **state) {
    (void)state;
    static const struct {
        double degrees, share, t;
    } TABLE[] = {{1, 0.95, 12.706}, {2, 0.95, 4.303},  {4, 0.95, 2.776},   {9, 0.95, 2.262},
                 {30, 0.95, 2.042}, {60, 0.95, 2.000}, {120, 0.95, 1.980}, {1e6, 0.95, 1.960},
                 {1, 0.99, 63.657}, {10, 0.99, 3.169}, {120, 0.99, 2.617}, {1, 0.9, 6.314},
                 {20, 0.9, 1.725},  {5, 0.999, 6.869}, {1, 0.5, 1.000},    {40, 0.5, 0.681}};
    for (size_t k = 0; k < sizeof TABLE / sizeof *TABLE; k++) {
        check_within(jox_student_t(TABLE[k].degrees, TABLE[k].share), TABLE[k].t, 5.1e-4);
        check_within(
            jox_student_tail(jox_student_t(TABLE[k].degrees, TABLE[k].share), TABLE[k].degrees),
            1 - TABLE[k].share, 1e-9);
    }
    for (double n = 1; n < 999; n++)
        assert_true(jox_student_t(n + 1, 0.95) < jox_student_t(n, 0.95));
    check_within(jox_student_tail(0, 5), 1, 1e-12);
    check_within(jox_student_tail(-2.262, 9), jox_student_tail(2.262, 9), 1e-12);
}

/* Hours of sleep gained by ten patients on two drugs: Student, "The probable error of a mean",
   Biometrika 6, 1908. The results are those of R, ?sleep and t.test. */
static const double DRUG_1[10] = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
static const double DRUG_2[10] = {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

static void paired_effect_matches_student_1908(void **state) {
    (void)state;
    const JoxEffect e = jox_effect_paired(DRUG_1, DRUG_2, 10, 0.95);
    check_within(e.difference, 1.58, 1e-9);
    check_within(e.low, 0.7001142, 1e-6);
    check_within(e.high, 2.4598858, 1e-6);
    check_within(e.p, 0.002833, 1e-6);
    check_within(e.deviation, 1.229995, 1e-5);
    assert_true(e.degrees == 9 && e.pairs == 10);
}

static void unpaired_effect_matches_welch(void **state) {
    (void)state;
    const JoxEffect e = jox_effect_apart(DRUG_1, 10, DRUG_2, 10, 0.95);
    check_within(e.difference, 1.58, 1e-9);
    check_within(e.low, -0.2054832, 1e-6);
    check_within(e.high, 3.3654832, 1e-6);
    check_within(e.p, 0.07939, 1e-5);
    check_within(e.degrees, 17.776, 1e-3);
    assert_int_equal(e.pairs, 0);
}

/* Survival of mice, days: Efron and Tibshirani, "An Introduction to the Bootstrap", 1993, chapter
   2: the mean of the treated has a bootstrap standard error of 23.36 and a difference of 30.63. The
   percentile interval of a mean is close to mean +- 1.96 such errors. */
static void bootstrap_matches_efron(void **state) {
    (void)state;
    static const double TREATED[7] = {94, 197, 16, 38, 99, 141, 23};
    static const double CONTROL[9] = {52, 104, 146, 10, 51, 30, 40, 27, 46};
    static const double NOTHING[7] = {0};
    JoxEffect e = jox_effect_paired(NOTHING, TREATED, 7, 0.95);
    check_within(e.difference, 86.857, 1e-3);
    jox_effect_bootstrap(&e, NOTHING, TREATED, 20000, 0.6827); /* one deviation to either side */
    check_within((e.high - e.low) / 2, 23.36, 0.6);
    e = jox_effect_apart(CONTROL, 9, TREATED, 7, 0.95);
    check_within(e.difference, 30.635, 1e-3);
    jox_effect_bootstrap(&e, CONTROL, TREATED, 20000, 0.6827);
    check_within((e.high - e.low) / 2, sqrt(23.36 * 23.36 + 13.33 * 13.33), 0.8);
    const JoxEffect again = e;
    jox_effect_bootstrap(&e, CONTROL, TREATED, 20000, 0.6827);
    assert_true(e.low == again.low && e.high == again.high);
    jox_effect_bootstrap(&e, CONTROL, TREATED, 20000, 0.95);
    assert_true(e.low < 0 && e.high > 60);
}

/* Effects of half a deviation at 5 % and a power of 80 %: J. Cohen, "Statistical Power Analysis for
   the Behavioral Sciences", 2nd ed. 1988, table 2.4.1: 64 of each sample; of 0.8 deviations 26, of
   0.2 393. Pairs: 34 (G*Power 3, manual: matched pairs). */
static void number_of_runs_matches_cohen(void **state) {
    (void)state;
    JoxEffect e = {.difference = 0.5, .deviation = 1};
    assert_int_equal(jox_effect_runs(&e, 0.95, 0.8), 64);
    e.difference = -0.8;
    assert_int_equal(jox_effect_runs(&e, 0.95, 0.8), 26);
    e.difference = 0.2;
    assert_in_range(jox_effect_runs(&e, 0.95, 0.8), 393, 394);
    e = (JoxEffect){.difference = 5, .deviation = 10, .pairs = 3};
    assert_int_equal(jox_effect_runs(&e, 0.95, 0.8), 34);
    e.deviation = 0;
    assert_int_equal(jox_effect_runs(&e, 0.95, 0.8), 2);
    e.difference = 0;
    assert_int_equal(jox_effect_runs(&e, 0.95, 0.8), 0);
    e = (JoxEffect){.difference = 1, .deviation = NAN};
    assert_int_equal(jox_effect_runs(&e, 0.95, 0.8), 0);
}

static void few_values_have_no_interval(void **state) {
    (void)state;
    const double one[] = {3}, two[] = {3, 4}, same[] = {5, 5, 5}, other[] = {6, 6, 6};
    JoxEffect e = jox_effect_paired(one, two, 1, 0.95);
    assert_true(e.difference == 0 && isnan(e.low) && isnan(e.high) && isnan(e.p));
    e = jox_effect_apart(one, 1, two, 2, 0.95);
    assert_true(e.difference == 0.5 && isnan(e.low) && isnan(e.deviation));
    jox_effect_bootstrap(&e, one, two, 100, 0.95);
    assert_true(isnan(e.low));
    e = jox_effect_paired(same, same, 3, 0.95);
    assert_true(e.low == 0 && e.high == 0 && e.p == 1);
    e = jox_effect_apart(same, 3, other, 3, 0.95);
    assert_true(e.difference == 1 && e.low == 1 && e.high == 1 && e.p == 0);
    e = jox_effect_paired(same, (const double[]){5, NAN, 5}, 3, 0.95);
    assert_true(isnan(e.difference) && isnan(e.low));
}

/* S. S. Wilks 1941: 59 values are the least of which the greatest bounds the 95 % value with 95 %;
   with 93 the second greatest does, with 124 the third. 90 %: 22 with 90 %. */
static void ranks_bound_quantiles(void **state) {
    (void)state;
    assert_int_equal(jox_rank_runs(0.95, 0.95), 59);
    assert_int_equal(jox_rank_runs(0.90, 0.90), 22);
    assert_int_equal(jox_rank_runs(0.99, 0.99), 459);
    assert_int_equal(jox_rank_bound(58, 0.95, 0.95), 0);
    assert_int_equal(jox_rank_bound(59, 0.95, 0.95), 59);
    assert_int_equal(jox_rank_bound(92, 0.95, 0.95), 92);
    assert_int_equal(jox_rank_bound(93, 0.95, 0.95), 92);
    assert_int_equal(jox_rank_bound(123, 0.95, 0.95), 122);
    assert_int_equal(jox_rank_bound(124, 0.95, 0.95), 122);
    /* MSC.1/Circ.1533: ranked, the one of which 95 % of all are lower. */
    assert_int_equal(jox_rank_above(500, 0.95), 476);
    assert_int_equal(jox_rank_above(50, 0.95), 49);
    assert_int_equal(jox_rank_above(20, 0.95), 20);
    assert_int_equal(jox_rank_above(19, 0.95), 0);
    assert_int_equal(jox_rank_above(1, 0.0), 1);
}

/* Hyndman and Fan 1996, type 7, as R's quantile(c(15, 20, 35, 40, 50)). */
static void quantiles_are_linear_between_ranks(void **state) {
    (void)state;
    double values[] = {50, 15, 40, 20, 35};
    check_within(jox_quantile(values, 5, 0.4), 29, 1e-12);
    check_within(jox_quantile(values, 5, 0.95), 48, 1e-12);
    check_within(jox_quantile(values, 5, 0), 15, 0);
    check_within(jox_quantile(values, 5, 1), 50, 0);
    assert_true(isnan(jox_quantile(values, 0, 0.5)));
    double holes[] = {1, NAN, 3};
    assert_true(isnan(jox_quantile(holes, 3, 0.5)));
}

/* Mean 10, deviation sqrt(2.5), error of the mean .7071, t(4) = 2.776. */
static void mean_bound_matches_student_t(void **state) {
    (void)state;
    const double values[] = {12, 8, 11, 9, 10};
    const JoxMoments m = jox_moments(values, 5), one = jox_moments(values, 1);
    check_within(m.mean, 10, 1e-12);
    check_within(m.deviation, sqrt(2.5), 1e-12);
    check_within(jox_mean_bound(&m, 0.95), 1.9632, 1e-4);
    assert_true(isnan(one.deviation) && isnan(jox_mean_bound(&one, 0.95)) && one.mean == 12);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(student_t_matches_tables),
                                       cmocka_unit_test(paired_effect_matches_student_1908),
                                       cmocka_unit_test(unpaired_effect_matches_welch),
                                       cmocka_unit_test(bootstrap_matches_efron),
                                       cmocka_unit_test(number_of_runs_matches_cohen),
                                       cmocka_unit_test(few_values_have_no_interval),
                                       cmocka_unit_test(ranks_bound_quantiles),
                                       cmocka_unit_test(quantiles_are_linear_between_ranks),
                                       cmocka_unit_test(mean_bound_matches_student_t)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
