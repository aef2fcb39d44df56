#include "base/number/elementary.h"

#include <math.h>

#include "base/number/exponential.h"
#include "base/number/pi.h"

/* Taylor series on [-pi/4, pi/4]: `odd` 1 is the sine, 0 the cosine. */
static double sum_trig_series(double r, int odd) {
    double term = odd ? r : 1.0, sum = term, r2 = r * r;
    for (int k = odd ? 2 : 1; k < 20; k += 2) {
        term = -term * r2 / ((double)k * (k + 1));
        sum += term;
    }
    return sum;
}

static double compute_sine_or_cosine(double x, int quarter) {
    if (!isfinite(x))
        return NAN;
    /* pi/2 is subtracted in three parts, so that r is exact for |x| up to about 1e9. */
    double n = floor(x * (2.0 / JOX_PI) + 0.5);
    double r = ((x - n * 1.57079632673412561417) - n * 6.07710050630396597660e-11) -
               n * 2.02226624879595063154e-21;
    int q = (int)(fmod(n, 4.0) + 4.0 + quarter) & 3;
    double value = sum_trig_series(r, !(q & 1));
    return q & 2 ? -value : value;
}

double jox_sin(double x) {
    return compute_sine_or_cosine(x, 0);
}

double jox_cos(double x) {
    return compute_sine_or_cosine(x, 1);
}

/* Arctangent on [0, 1]: halves the angle twice, then sums the series. */
static double compute_atan_unit(double t) {
    t = t / (1.0 + sqrt(1.0 + t * t));
    t = t / (1.0 + sqrt(1.0 + t * t));
    double t2 = t * t, sum = 0.0;
    for (int k = 27; k >= 1; k -= 2)
        sum = 1.0 / k - t2 * sum;
    return 4.0 * t * sum;
}

double jox_atan2(double y, double x) {
    double ax = fabs(x), ay = fabs(y);
    if (ax == 0.0 && ay == 0.0)
        return 0.0;
    double a = ax >= ay ? compute_atan_unit(ay / ax) : JOX_PI / 2 - compute_atan_unit(ax / ay);
    if (x < 0.0)
        a = JOX_PI - a;
    return y < 0.0 ? -a : a;
}

double jox_exp(double x) {
    if (x != x)
        return x;
    if (x > 709.0)
        return INFINITY;
    if (x < -708.0)
        return 0.0;
    return jox_exp_within(x);
}

double jox_log(double x) {
    if (!(x > 0.0))
        return x == 0.0 ? -INFINITY : NAN;
    if (isinf(x))
        return x;
    int e;
    double m = frexp(x, &e); /* exact */
    if (m < 0.70710678118654752) {
        m *= 2.0;
        e--;
    }
    double s = (m - 1.0) / (m + 1.0), s2 = s * s, sum = 0.0;
    for (int k = 31; k >= 1; k -= 2)
        sum = 1.0 / k + s2 * sum;
    return e * 6.93147180559945286227e-01 + 2.0 * s * sum;
}

double jox_pow(double base, double exponent) {
    if (exponent == 0.0)
        return 1.0;
    double whole = floor(exponent);
    if (whole == exponent && fabs(exponent) <= 64.0) {
        double result = 1.0;
        for (int i = 0; i < (int)fabs(exponent); i++)
            result *= base;
        return exponent < 0.0 ? 1.0 / result : result;
    }
    if (base == 0.0)
        return exponent > 0.0 ? 0.0 : INFINITY;
    if (base < 0.0) {
        if (whole != exponent)
            return NAN;
        double value = jox_exp(exponent * jox_log(-base));
        return fmod(whole, 2.0) != 0.0 ? -value : value;
    }
    return jox_exp(exponent * jox_log(base));
}
