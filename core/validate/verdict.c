#include "validate/verdict.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/statistics.h"

enum { MOST_SEEDS = 1000 };

static const double SURE = 0.95;

JoxVerdict jox_verdict(const double *values, uint32_t count, double low, double high) {
    JOX_ASSERT(count > 0);
    const JoxMoments moments = jox_moments(values, count);
    JoxVerdict v = {.mean = moments.mean,
                    .least = INFINITY,
                    .most = -INFINITY,
                    .bound = jox_mean_bound(&moments, SURE),
                    .seeds = count,
                    .most_seeds = count};
    double *sorted = jox_alloc(count, sizeof *sorted);
    for (uint32_t s = 0; s < count; s++) {
        v.least = fmin(v.least, values[s]);
        v.most = fmax(v.most, values[s]);
        sorted[s] = values[s];
    }
    v.p95 = jox_quantile(sorted, count, 0.95);
    jox_free(sorted);
    v.inside = v.mean >= low && v.mean <= high;
    v.thin = (v.mean - v.bound < low && v.mean + v.bound > low) ||
             (v.mean - v.bound < high && v.mean + v.bound > high);
    return v;
}

bool jox_verdict_misses(const JoxVerdict *verdict) {
    return isfinite(verdict->mean) && !verdict->inside;
}

void jox_bound_write(char out[JOX_BOUND_SIZE], double bound) {
    *out = 0;
    if (isfinite(bound))
        snprintf(out, JOX_BOUND_SIZE, bound < 99.5 ? "+- %.2g" : "+- %.0f", fmin(bound, 1e15));
}

const char *jox_seeds_write(char out[JOX_SEEDS_SIZE], uint32_t fewest, uint32_t most) {
    if (fewest < most)
        snprintf(out, JOX_SEEDS_SIZE, "%u to %u", fewest, most);
    else
        snprintf(out, JOX_SEEDS_SIZE, "%u", most);
    return out;
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
