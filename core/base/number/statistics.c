#include "base/number/statistics.h"

#include <math.h>
#include <stdbool.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/random.h"
#include "base/sort.h"

double jox_quantile(double *values, size_t count, double q) {
    if (count == 0)
        return NAN;
    jox_sort_doubles(values, count); /* NAN comes last */
    if (isnan(values[count - 1]))
        return NAN;
    const double at = q * (double)(count - 1);
    const size_t low = (size_t)at, high = low + 1 < count ? low + 1 : low;
    return values[low] + (at - (double)low) * (values[high] - values[low]);
}

/* ---- Student's distribution ---- */

/* The continued fraction of the incomplete beta function (Abramowitz and Stegun 26.5.8) by Lentz's
   method; for x below (a + 1) / (a + b + 2). */
static double compute_beta_fraction(double a, double b, double x) {
    enum { MOST = 1000 };
    static const double TINY = 1e-300;
    double c = 1, d = 1 - (a + b) * x / (a + 1);
    d = 1 / (fabs(d) < TINY ? TINY : d);
    double value = d;
    for (int m = 1; m < MOST; m++) {
        const double two = 2 * m, before = value;
        const double terms[2] = {m * (b - m) * x / ((a + two - 1) * (a + two)),
                                 -(a + m) * (a + b + m) * x / ((a + two) * (a + two + 1))};
        for (int k = 0; k < 2; k++) {
            d = 1 + terms[k] * d;
            d = 1 / (fabs(d) < TINY ? TINY : d);
            c = 1 + terms[k] / c;
            c = fabs(c) < TINY ? TINY : c;
            value *= c * d;
        }
        if (fabs(value - before) <= 1e-15 * fabs(value))
            break;
    }
    return value;
}

/* The regularised incomplete beta function I_x(a, b). */
static double compute_beta_share(double a, double b, double x) {
    if (!(x > 0))
        return isnan(x) ? NAN : 0;
    if (x >= 1)
        return 1;
    const double front = exp(lgamma(a + b) - lgamma(a) - lgamma(b) + a * log(x) + b * log1p(-x));
    if (x < (a + 1) / (a + b + 2))
        return front * compute_beta_fraction(a, b, x) / a;
    return 1 - front * compute_beta_fraction(b, a, 1 - x) / b;
}

double jox_student_tail(double t, double degrees) {
    return compute_beta_share(degrees / 2, 0.5, degrees / (degrees + t * t));
}

double jox_student_t(double degrees, double share) {
    JOX_ASSERT(degrees > 0 && share >= 0 && share < 1);
    double low = 0, high = 1;
    while (jox_student_tail(high, degrees) > 1 - share && high < 1e300)
        high *= 2;
    for (int k = 0; k < 200 && high - low > 1e-12 * high; k++) {
        const double middle = low + (high - low) / 2;
        if (jox_student_tail(middle, degrees) > 1 - share)
            low = middle;
        else
            high = middle;
    }
    return low + (high - low) / 2;
}

/* ---- means ---- */

JoxMoments jox_moments(const double *values, size_t count) {
    JoxMoments m = {NAN, NAN, count};
    double sum = 0, squares = 0;
    bool equal = true;
    for (size_t k = 0; k < count; k++) {
        sum += values[k]; /* one NAN makes the mean NAN */
        equal &= values[k] == values[0];
    }
    if (count == 0)
        return m;
    m.mean = equal ? values[0] : sum / (double)count; /* exact if all values are equal */
    for (size_t k = 0; k < count; k++)
        squares += (values[k] - m.mean) * (values[k] - m.mean);
    if (count > 1)
        m.deviation = sqrt(squares / (double)(count - 1));
    return m;
}

double jox_mean_bound(const JoxMoments *m, double share) {
    if (m->count < 2)
        return NAN;
    return jox_student_t((double)(m->count - 1), share) * m->deviation / sqrt((double)m->count);
}

/* ---- differences ---- */

/* Sets interval and p-value from the standard error of the difference. */
static void set_interval(JoxEffect *e, double error, double share) {
    if (!isfinite(error) || !isfinite(e->degrees))
        return;
    const double bound = jox_student_t(e->degrees, share) * error;
    e->low = e->difference - bound;
    e->high = e->difference + bound;
    e->p = error > 0            ? jox_student_tail(e->difference / error, e->degrees)
           : e->difference == 0 ? 1
                                : 0;
}

JoxEffect jox_effect_paired(const double *a, const double *b, size_t count, double share) {
    JoxEffect e = {NAN, NAN, NAN, NAN, NAN, NAN, count, count, count};
    double *differences = jox_alloc(count + 1, sizeof *differences);
    for (size_t k = 0; k < count; k++)
        differences[k] = b[k] - a[k];
    const JoxMoments m = jox_moments(differences, count);
    jox_free(differences);
    e.difference = m.mean;
    e.deviation = m.deviation;
    if (count > 1) {
        e.degrees = (double)(count - 1);
        set_interval(&e, m.deviation / sqrt((double)count), share);
    }
    return e;
}

JoxEffect jox_effect_apart(const double *a, size_t a_count, const double *b, size_t b_count,
                           double share) {
    JoxEffect e = {NAN, NAN, NAN, NAN, NAN, NAN, 0, a_count, b_count};
    const JoxMoments one = jox_moments(a, a_count), other = jox_moments(b, b_count);
    e.difference = other.mean - one.mean;
    if (a_count < 2 || b_count < 2)
        return e;
    const double u = one.deviation * one.deviation / (double)a_count;
    const double v = other.deviation * other.deviation / (double)b_count;
    e.deviation = sqrt((one.deviation * one.deviation + other.deviation * other.deviation) / 2);
    e.degrees = u + v > 0 ? (u + v) * (u + v) /
                                (u * u / (double)(a_count - 1) + v * v / (double)(b_count - 1))
                          : (double)(a_count + b_count - 2);
    set_interval(&e, sqrt(u + v), share);
    return e;
}

/* Returns the mean of `count` values of `a` (or, if `b` is not NULL, of differences b - a) drawn
   with replacement. */
static double draw_bootstrap_mean(const double *a, const double *b, size_t count, uint32_t draw,
                                  uint32_t stream) {
    double sum = 0;
    for (size_t k = 0; k < count; k++) {
        const double u =
            jox_random_share(jox_random_bits(stream, draw, (uint64_t)k, JOX_DRAW_CHANCE, 0));
        const size_t at = (size_t)(u * (double)count);
        sum += b ? b[at] - a[at] : a[at];
    }
    return sum / (double)count;
}

void jox_effect_bootstrap(JoxEffect *e, const double *a, const double *b, uint32_t resamples,
                          double share) {
    JOX_ASSERT(resamples > 0);
    if (e->a < 2 || e->b < 2 || !isfinite(e->difference))
        return;
    double *drawn = jox_alloc(resamples, sizeof *drawn);
    for (uint32_t r = 0; r < resamples; r++)
        drawn[r] = e->pairs ? draw_bootstrap_mean(a, b, e->pairs, r, 1)
                            : draw_bootstrap_mean(b, NULL, e->b, r, 2) -
                                  draw_bootstrap_mean(a, NULL, e->a, r, 1);
    e->low = jox_quantile(drawn, resamples, (1 - share) / 2);
    e->high = jox_quantile(drawn, resamples, (1 + share) / 2);
    jox_free(drawn);
}

/* Whether n runs per side suffice to find an effect of `size` standard deviations. `samples`: 1 if
   the runs are paired, else 2. */
static bool is_effect_found(double n, double size, double samples, double share, double power) {
    const double degrees = samples * (n - 1);
    /* P(T < t) = power is the same as P(|T| < t) = 2 power - 1 */
    return size * sqrt(n / samples) >=
           jox_student_t(degrees, share) + jox_student_t(degrees, 2 * power - 1);
}

size_t jox_effect_runs(const JoxEffect *e, double share, double power) {
    static const size_t MOST = 1000000;
    const double samples = e->pairs ? 1 : 2, size = fabs(e->difference) / e->deviation;
    JOX_ASSERT(power >= 0.5 && power < 1);
    if (!(fabs(e->difference) > 0) || !(e->deviation >= 0))
        return 0;
    size_t low = 1, high = 2; /* too few; enough */
    while (high < MOST && !is_effect_found((double)high, size, samples, share, power)) {
        low = high;
        high *= 2;
    }
    if (high >= MOST)
        return 0;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (is_effect_found((double)middle, size, samples, share, power))
            high = middle;
        else
            low = middle;
    }
    return high;
}

/* ---- ranks ---- */

size_t jox_rank_above(size_t count, double q) {
    const double below = ceil(q * (double)count - 1e-9 * (double)count);
    return below < (double)count ? (size_t)below + 1 : 0;
}

/* Returns the probability of at most k successes in n trials, each of probability q. */
static double compute_binomial_share(size_t k, size_t n, double q) {
    return k >= n ? 1 : compute_beta_share((double)(n - k), (double)k + 1, 1 - q);
}

size_t jox_rank_bound(size_t count, double q, double share) {
    /* The value of rank r is an upper bound if at most r - 1 values lie below the quantile. */
    for (size_t r = 1; r <= count; r++)
        if (compute_binomial_share(r - 1, count, q) >= share)
            return r;
    return 0;
}

size_t jox_rank_runs(double q, double share) {
    return (size_t)ceil(log1p(-share) / log(q) - 1e-9);
}
