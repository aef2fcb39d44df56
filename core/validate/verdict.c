#include "validate/verdict.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/assert.h"
#include "base/mem.h"

enum { MOST_SEEDS = 1000 };

double jox_student_t(uint32_t degrees_of_freedom) {
    static const double TABLE[] = {12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060,
                                   2.2622,  2.2281, 2.2010, 2.1788, 2.1604, 2.1448, 2.1314, 2.1199,
                                   2.1098,  2.1009, 2.0930, 2.0860, 2.0796, 2.0739, 2.0687, 2.0639,
                                   2.0595,  2.0555, 2.0518, 2.0484, 2.0452, 2.0423};
    JOX_ASSERT(degrees_of_freedom > 0);
    if (degrees_of_freedom <= sizeof TABLE / sizeof *TABLE)
        return TABLE[degrees_of_freedom - 1];
    /* Fisher's expansion about the normal distribution's 1.96. */
    const double z = 1.959964, n = degrees_of_freedom;
    return z + (z * z * z + z) / (4 * n) + (5 * pow(z, 5) + 16 * z * z * z + 3 * z) / (96 * n * n);
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The value that a share of all lie below, linear between ranks; NAN where one is none. */
static double quantile(const double *values, uint32_t count, double share) {
    double *sorted = jox_alloc(count, sizeof *sorted);
    double result = NAN;
    bool all = true;
    for (uint32_t s = 0; s < count; s++) {
        sorted[s] = values[s];
        all &= !isnan(values[s]);
    }
    if (all) {
        qsort(sorted, count, sizeof *sorted, ascending);
        const double at = share * (count - 1);
        const uint32_t low = (uint32_t)at, high = low + 1 < count ? low + 1 : low;
        result = sorted[low] + (at - low) * (sorted[high] - sorted[low]);
    }
    jox_free(sorted);
    return result;
}

JoxVerdict jox_verdict(const double *values, uint32_t count, double low, double high) {
    JoxVerdict v = {.least = INFINITY, .most = -INFINITY, .bound = NAN, .seeds = count};
    double sum = 0, squares = 0;
    JOX_ASSERT(count > 0);
    for (uint32_t s = 0; s < count; s++) {
        sum += values[s]; /* NAN stays */
        v.least = fmin(v.least, values[s]);
        v.most = fmax(v.most, values[s]);
    }
    v.mean = sum / count;
    if (v.least == v.most && !isnan(sum)) /* equal ones have their own value, without rounding */
        v.mean = v.least;
    for (uint32_t s = 0; s < count; s++)
        squares += (values[s] - v.mean) * (values[s] - v.mean);
    if (count > 1)
        v.bound = jox_student_t(count - 1) * sqrt(squares / (count - 1) / count);
    v.p95 = quantile(values, count, 0.95);
    v.inside = v.mean >= low && v.mean <= high;
    v.thin = (v.mean - v.bound < low && v.mean + v.bound > low) ||
             (v.mean - v.bound < high && v.mean + v.bound > high);
    return v;
}

void jox_bound_write(char out[JOX_BOUND_SIZE], double bound) {
    *out = 0;
    if (isfinite(bound))
        snprintf(out, JOX_BOUND_SIZE, bound < 99.5 ? "+- %.2g" : "+- %.0f", fmin(bound, 1e15));
}

bool jox_seeds_read(const char *text, uint64_t *first, uint32_t *count) {
    char *end;
    if (!isdigit((unsigned char)*text))
        return false;
    const double from = strtod(text, &end);
    double to = from;
    if (*end == '-' && isdigit((unsigned char)end[1]))
        to = strtod(end + 1, &end);
    if (*end || from != floor(from) || to != floor(to) || !(from <= 9e15) || !(to >= from) ||
        !(to - from < MOST_SEEDS))
        return false;
    *first = (uint64_t)from;
    *count = (uint32_t)(to - from) + 1;
    return true;
}
