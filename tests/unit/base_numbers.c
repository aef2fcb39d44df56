/* Elementary functions against libm, random numbers, hashes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/hash.h"
#include "base/number/distribution.h"
#include "base/number/elementary.h"

static void check_relative(double got, double want, double tolerance) {
    double scale = fabs(want) > 1.0 ? fabs(want) : 1.0;
    if (!(fabs(got - want) <= tolerance * scale))
        fail_msg("got %.17g, want %.17g", got, want);
}

static void elementary_functions_match_libm(void **state) {
    (void)state;
    for (int i = -4000; i <= 4000; i++) {
        double x = i * 0.0137;
        check_relative(jox_sin(x), sin(x), 1e-12);
        check_relative(jox_cos(x), cos(x), 1e-12);
        check_relative(jox_exp(x * 0.1), exp(x * 0.1), 1e-12);
        check_relative(jox_log(fabs(x) + 1e-9), log(fabs(x) + 1e-9), 1e-12);
        check_relative(jox_atan2(x, 1.7), atan2(x, 1.7), 1e-12);
        check_relative(jox_atan2(0.3 - x, x), atan2(0.3 - x, x), 1e-12);
        check_relative(jox_pow(fabs(x), 0.37), pow(fabs(x), 0.37), 1e-11);
    }
    check_relative(jox_sin(1e6), sin(1e6), 1e-9);
    check_relative(jox_pow(-2.0, 3.0), -8.0, 1e-15);
}

static void elementary_functions_at_the_edges(void **state) {
    (void)state;
    assert_true(isnan(jox_sin(INFINITY)));
    assert_true(isinf(jox_exp(1e4)) && jox_exp(-1e4) == 0.0);
    assert_true(isnan(jox_log(-1.0)) && jox_log(0.0) == -INFINITY);
    assert_true(isnan(jox_pow(-2.0, 0.5)));
    assert_true(jox_atan2(0.0, 0.0) == 0.0);
    check_relative(jox_atan2(0.0, -1.0), M_PI, 1e-15);
    check_relative(jox_atan2(-1.0, 0.0), -M_PI / 2, 1e-15);
}

static void draws_depend_on_every_argument(void **state) {
    (void)state;
    uint64_t a = jox_random_bits(1, 2, 3, JOX_DRAW_OWN, 4);
    assert_true(a == jox_random_bits(1, 2, 3, JOX_DRAW_OWN, 4));
    assert_true(a != jox_random_bits(2, 2, 3, JOX_DRAW_OWN, 4));
    assert_true(a != jox_random_bits(1, 3, 3, JOX_DRAW_OWN, 4));
    assert_true(a != jox_random_bits(1, 2, 4, JOX_DRAW_OWN, 4));
    assert_true(a != jox_random_bits(1, 2, 3, JOX_DRAW_CHANCE, 4));
    assert_true(a != jox_random_bits(1, 2, 3, JOX_DRAW_OWN, 5));
}

static void distributions_have_their_moments(void **state) {
    (void)state;
    JoxDist normal = {.kind = JOX_DIST_NORMAL, .a = 1.0, .b = 0.15, .lo = 0.5, .hi = 2.0};
    JoxDist uniform = {.kind = JOX_DIST_UNIFORM, .a = 2.0, .b = 5.0};
    JoxDist choose = {.kind = JOX_DIST_CHOOSE, .values = {1, 4, 9}, .choices = 3};
    double sum = 0, square = 0, flat = 0;
    int nines = 0, n = 20000;
    for (int i = 0; i < n; i++) {
        double v = jox_dist_draw(&normal, 7, (uint32_t)i, 0, JOX_DRAW_OWN, 0);
        assert_true(v >= 0.5 && v <= 2.0);
        sum += v;
        square += v * v;
        double u = jox_dist_draw(&uniform, 7, (uint32_t)i, 0, JOX_DRAW_OWN, 1);
        assert_true(u >= 2.0 && u < 5.0);
        flat += u;
        nines += jox_dist_draw(&choose, 7, (uint32_t)i, 0, JOX_DRAW_OWN, 2) == 9.0;
    }
    check_relative(sum / n, 1.0, 0.005);
    check_relative(sqrt(square / n - sum / n * sum / n), 0.15, 0.005);
    check_relative(flat / n, 3.5, 0.02);
    check_relative((double)nines / n, 1.0 / 3, 0.02);
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double normal_share(double x, const double *p) {
    return 0.5 * erfc((p[0] - x) / (p[1] * sqrt(2.0)));
}
static double lognormal_share(double x, const double *p) {
    return normal_share(log(x), p);
}
static double weibull_share(double x, const double *p) {
    return 1.0 - exp(-pow(x / p[1], p[0]));
}
/* The series of the lower incomplete gamma function. */
static double gamma_share(double x, const double *p) {
    const double shape = p[0], at = x / p[1];
    double term = 1.0 / shape, sum = term;
    for (int n = 1; n < 1000; n++)
        sum += term *= at / (shape + n);
    return sum * exp(shape * log(at) - at - lgamma(shape));
}

/* Kolmogorov and Smirnov: the greatest distance of the shares, times the root of their number, is
   above 1.63 in one of a hundred samples that are of the distribution. */
static void draws_match_their_distribution(void **state) {
    (void)state;
    enum { DRAWS = 5000 };
    static double draws[DRAWS];
    static const struct {
        JoxDistKind kind;
        double arguments[2];
        double (*share)(double, const double *);
    } CASES[] = {{JOX_DIST_NORMAL, {1.34, 0.26}, normal_share},
                 {JOX_DIST_LOGNORMAL, {4.586, 0.967}, lognormal_share},
                 {JOX_DIST_GAMMA, {1.291, 103.901}, gamma_share},
                 {JOX_DIST_GAMMA, {0.4, 2.0}, gamma_share},
                 {JOX_DIST_GAMMA, {9.0, 0.5}, gamma_share},
                 {JOX_DIST_WEIBULL, {1.195, 139.285}, weibull_share},
                 {JOX_DIST_WEIBULL, {0.7, 1.0}, weibull_share}};
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) {
        JoxDist dist;
        double farthest = 0.0;
        assert_true(jox_dist_make(CASES[c].kind, CASES[c].arguments, 2, &dist));
        for (uint32_t i = 0; i < DRAWS; i++)
            draws[i] = jox_dist_draw(&dist, 7, i, 0, JOX_DRAW_OWN, (uint32_t)c);
        qsort(draws, DRAWS, sizeof *draws, ascending);
        for (uint32_t i = 0; i < DRAWS; i++) {
            const double share = CASES[c].share(draws[i], CASES[c].arguments);
            farthest = fmax(farthest, fmax(share - (double)i / DRAWS, (i + 1.0) / DRAWS - share));
        }
        assert_true(farthest * sqrt(DRAWS) < 1.63);
    }
}

static void wrong_arguments_make_no_distribution(void **state) {
    (void)state;
    const double v[] = {1.0, -1.0, 5.0, 3.0};
    const double zero[] = {0.0, 1.0};
    JoxDist dist;
    assert_false(jox_dist_make(JOX_DIST_NORMAL, v, 2, &dist));
    assert_false(jox_dist_make(JOX_DIST_LOGNORMAL, v, 4, &dist));
    assert_false(jox_dist_make(JOX_DIST_GAMMA, zero, 2, &dist));
    assert_false(jox_dist_make(JOX_DIST_WEIBULL, zero, 2, &dist));
    assert_false(jox_dist_make(JOX_DIST_UNIFORM, v, 2, &dist));
    assert_false(jox_dist_make(JOX_DIST_CHOOSE, v, 0, &dist));
    assert_true(jox_dist_make(JOX_DIST_UNIFORM, zero, 2, &dist));
    assert_int_equal(jox_dist_named("gamma(1, 2)", 5), JOX_DIST_GAMMA);
    assert_int_equal(jox_dist_named("norm", 4), JOX_DIST_KINDS);
}

static void sha256_of_the_standard_vectors(void **state) {
    (void)state;
    char out[65];
    jox_sha256_hex("abc", 3, out);
    assert_string_equal(out, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    jox_sha256_hex("", 0, out);
    assert_string_equal(out, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    jox_sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", 56, out);
    assert_string_equal(out, "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

static void state_hash_sees_every_byte_and_the_order(void **state) {
    (void)state;
    unsigned char data[37] = {0};
    JoxHash clean = jox_hash_begin();
    jox_hash_add(&clean, data, sizeof data);
    for (size_t i = 0; i < sizeof data; i++) {
        data[i] = 1;
        JoxHash other = jox_hash_begin();
        jox_hash_add(&other, data, sizeof data);
        assert_true(jox_hash_end(&other) != jox_hash_end(&clean));
        data[i] = 0;
    }
    JoxHash ab = jox_hash_begin(), ba = jox_hash_begin();
    jox_hash_add(&ab, "a", 1), jox_hash_add(&ab, "b", 1);
    jox_hash_add(&ba, "b", 1), jox_hash_add(&ba, "a", 1);
    assert_true(jox_hash_end(&ab) != jox_hash_end(&ba));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elementary_functions_match_libm),
        cmocka_unit_test(elementary_functions_at_the_edges),
        cmocka_unit_test(draws_depend_on_every_argument),
        cmocka_unit_test(distributions_have_their_moments),
        cmocka_unit_test(draws_match_their_distribution),
        cmocka_unit_test(wrong_arguments_make_no_distribution),
        cmocka_unit_test(sha256_of_the_standard_vectors),
        cmocka_unit_test(state_hash_sees_every_byte_and_the_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
