/* Ranges of the values that people and the floor are coloured by: chosen so that a scene's own
   figures fill the scale, in round numbers that rarely change. Called by live_pack.c and
   live_field.c. */
#include <math.h>
#include <stdlib.h>

#include "base/assert.h"
#include "base/vec.h"
#include "live/live.h"

static const double PACE = 0.25;   /* s between looks at the values */
static const double PATIENCE = 10; /* s for which values must be small before a range shrinks */
static const float ROBUST = 0.98f; /* share of the values that a range has to hold */
static const float SMALL = 0.35f;  /* share of a range below which values are small */
static const float SLACK = 1.1f;   /* share of a range up to which values do not widen it */
static const float TRACE = 0.02f;  /* share of the least range below which values count as none */

static int compare_values(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Rounds up to 1, 2 or 5 times a power of ten. */
static float round_up_range(float value) {
    const float unit = powf(10.0f, floorf(log10f(value)));
    const float of = value / unit;
    return unit * (of <= 1.001f ? 1.0f : of <= 2.001f ? 2.0f : of <= 5.001f ? 5.0f : 10.0f);
}

/* Returns the value that a share of sorted values does not exceed. */
static float find_quantile(const float *values, uint32_t count, float share) {
    return values[(uint32_t)(share * (float)(count - 1) + 0.5f)];
}

/* Returns the robust greatest value of a sample: 98 % do not exceed it, and it is no outlier, that
   is, not above Q3 + 3 (Q3 - Q1), Tukey's outer fence. 0 if there are no values. */
static float find_robust_most(const JoxLiveSample *sample, float least) {
    float values[JOX_LIVE_SAMPLE];
    uint32_t count = 0;
    for (uint32_t i = 0; i < sample->count; i++)
        if (sample->values[i] > TRACE * least) /* NAN is left out too */
            values[count++] = sample->values[i];
    if (count == 0)
        return 0.0f;
    qsort(values, count, sizeof *values, compare_values);
    const float low = find_quantile(values, count, 0.25f),
                high = find_quantile(values, count, 0.75f);
    return jox_minf(find_quantile(values, count, ROBUST), high + 3.0f * (high - low));
}

void jox_live_sample_value(JoxLiveSample *sample, uint32_t stride, uint32_t i, float value) {
    if (i % stride == 0 && sample->count < JOX_LIVE_SAMPLE)
        sample->values[sample->count++] = value;
}

bool jox_live_scale_is_due(const JoxLiveScale *scale, double now) {
    return scale->most == 0.0f || now - scale->looked >= PACE || now < scale->looked;
}

void jox_live_adapt_scale(JoxLiveScale *scale, const JoxLiveSample *sample, float least,
                          double now) {
    JOX_ASSERT(least > 0.0f);
    const float seen = find_robust_most(sample, least);
    const float wanted = round_up_range(seen > least ? seen : least);
    scale->looked = now;
    if (seen >= SMALL * scale->most)
        scale->small_since = now;
    if (scale->most == 0.0f || seen > SLACK * scale->most ||
        (wanted < scale->most && now - scale->small_since >= PATIENCE)) {
        scale->most = wanted;
        scale->small_since = now;
    }
}
