#include "base/number/distribution.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"

const char jox_dist_usage[] =
#define X(kind, name, arguments, meaning, example) #name "(" arguments "), "
    JOX_DISTS(X)
#undef X
        "choose with at most 8";

static const char *const NAMES[JOX_DIST_KINDS] = {
#define X(kind, name, ...) [JOX_DIST_##kind] = #name,
    JOX_DISTS(X)
#undef X
};

JoxDistKind jox_dist_named(const char *name, size_t length) {
    for (int kind = JOX_DIST_CONSTANT + 1; kind < JOX_DIST_KINDS; kind++)
        if (strlen(NAMES[kind]) == length && strncmp(name, NAMES[kind], length) == 0)
            return (JoxDistKind)kind;
    return JOX_DIST_KINDS;
}

JoxDist jox_dist_constant(double value) {
    return (JoxDist){.kind = JOX_DIST_CONSTANT, .a = value, .lo = -INFINITY, .hi = INFINITY};
}

/* Whether a kind accepts `count` arguments of these values: bounds must be in order, deviations not
   negative, shapes and scales positive. */
static bool accepts_arguments(JoxDistKind kind, const double *v, int count) {
    const bool bounded = (count == 2 || count == 4) && (count < 4 || v[2] < v[3]);
    switch (kind) {
    case JOX_DIST_CONSTANT:
        return count == 1;
    case JOX_DIST_UNIFORM:
        return count == 2 && v[0] <= v[1];
    case JOX_DIST_NORMAL:
    case JOX_DIST_LOGNORMAL:
        return bounded && v[1] >= 0.0;
    case JOX_DIST_GAMMA:
    case JOX_DIST_WEIBULL:
        return bounded && v[0] > 0.0 && v[1] > 0.0;
    case JOX_DIST_CHOOSE:
        return count >= 1 && count <= JOX_DIST_CHOICES;
    case JOX_DIST_KINDS:
        break;
    }
    return false;
}

bool jox_dist_make(JoxDistKind kind, const double *arguments, int count, JoxDist *out) {
    if (!accepts_arguments(kind, arguments, count))
        return false;
    const bool bounded = kind != JOX_DIST_CHOOSE && count == 4;
    *out = (JoxDist){.kind = kind,
                     .a = arguments[0],
                     .b = count > 1 ? arguments[1] : 0.0,
                     .lo = bounded ? arguments[2] : -INFINITY,
                     .hi = bounded ? arguments[3] : INFINITY,
                     .choices = count};
    memcpy(out->values, arguments, (size_t)count * sizeof *arguments);
    return true;
}

bool jox_dist_same(const JoxDist *a, const JoxDist *b) {
    if (a->kind != b->kind || a->a != b->a)
        return false;
    if (a->kind == JOX_DIST_CONSTANT)
        return true;
    if (a->kind == JOX_DIST_CHOOSE)
        return a->choices == b->choices &&
               !memcmp(a->values, b->values, (size_t)a->choices * sizeof *a->values);
    return a->b == b->b && a->lo == b->lo && a->hi == b->hi;
}

double jox_dist_middle(const JoxDist *dist) {
    double middle = dist->a;
    if (dist->kind == JOX_DIST_UNIFORM)
        middle = 0.5 * (dist->a + dist->b);
    if (dist->kind == JOX_DIST_LOGNORMAL)
        middle = jox_exp(dist->a);
    if (dist->kind == JOX_DIST_GAMMA)
        middle = dist->a * dist->b;
    if (dist->kind == JOX_DIST_WEIBULL)
        middle = dist->b * tgamma(1.0 + 1.0 / dist->a);
    return middle;
}

void jox_dist_print(const JoxDist *dist, JoxText *out) {
    JOX_ASSERT(dist->kind < JOX_DIST_KINDS);
    if (dist->kind == JOX_DIST_CONSTANT) {
        jox_text_printf(out, "%g", dist->a);
        return;
    }
    jox_text_printf(out, "%s(", NAMES[dist->kind]);
    for (int k = 0; dist->kind == JOX_DIST_CHOOSE && k < dist->choices; k++)
        jox_text_printf(out, "%s%g", k ? ", " : "", dist->values[k]);
    if (dist->kind != JOX_DIST_CHOOSE)
        jox_text_printf(out, "%g, %g", dist->a, dist->b);
    if (isfinite(dist->lo))
        jox_text_printf(out, ", %g, %g", dist->lo, dist->hi);
    jox_text_add(out, ")");
}

/* ---- drawing ---- */

/* The random numbers for one draw: `next` is the `sub` of the next one. */
typedef struct Stream {
    uint64_t seed, tick;
    uint32_t agent, next;
    JoxDraw purpose;
} Stream;

static double draw_unit(Stream *s) {
    return jox_random_unit(s->seed, s->agent, s->tick, s->purpose, s->next++);
}

/* Draws a normal number of mean 0 by the Box-Muller transform. */
static double draw_normal(Stream *s, double deviation) {
    const double u = 1.0 - draw_unit(s);
    const double v = draw_unit(s);
    return deviation * sqrt(-2.0 * jox_log(u)) * jox_cos(JOX_TURN * v);
}

/* Draws a gamma number of scale 1: G. Marsaglia and W. W. Tsang, "A simple method for generating
   gamma variables", ACM TOMS 26(3), 2000. */
static double draw_gamma(Stream *s, double shape) {
    /* A shape below 1 is drawn with shape + 1, times a uniform number to the power 1 / shape. */
    const double power = shape < 1.0 ? jox_pow(1.0 - draw_unit(s), 1.0 / shape) : 1.0;
    const double d = (shape < 1.0 ? shape + 1.0 : shape) - 1.0 / 3.0, c = 1.0 / sqrt(9.0 * d);
    for (int attempt = 0; attempt < 32; attempt++) { /* each succeeds with a probability of 0.95 */
        const double x = draw_normal(s, 1.0), v = 1.0 + c * x, cube = v * v * v;
        const double u = 1.0 - draw_unit(s);
        if (v > 0.0 && jox_log(u) < 0.5 * x * x + d - d * cube + d * jox_log(cube))
            return d * cube * power;
    }
    return d * power;
}

/* Draws a number without regard to bounds. */
static double draw_value(const JoxDist *dist, Stream *s) {
    switch (dist->kind) {
    case JOX_DIST_NORMAL:
        return dist->a + draw_normal(s, dist->b);
    case JOX_DIST_LOGNORMAL:
        return jox_exp(dist->a + draw_normal(s, dist->b));
    case JOX_DIST_GAMMA:
        return dist->b * draw_gamma(s, dist->a);
    case JOX_DIST_WEIBULL:
        return dist->b * jox_pow(-jox_log(1.0 - draw_unit(s)), 1.0 / dist->a);
    case JOX_DIST_UNIFORM:
        return dist->a + (dist->b - dist->a) * draw_unit(s);
    case JOX_DIST_CHOOSE:
        return dist->values[(int)(draw_unit(s) * dist->choices)];
    case JOX_DIST_CONSTANT:
    case JOX_DIST_KINDS:
        break;
    }
    return dist->a;
}

double jox_dist_draw(const JoxDist *dist, uint64_t seed, uint32_t agent, uint64_t tick,
                     JoxDraw purpose, uint32_t sub) {
    const bool once = dist->kind == JOX_DIST_UNIFORM || dist->kind == JOX_DIST_CHOOSE;
    /* Each attempt has its own range of `sub`: 2 numbers for a normal one, up to 97 for a gamma
       one. There are 16 attempts, and ranges of different `sub` arguments do not overlap. */
    const uint32_t each = dist->kind == JOX_DIST_GAMMA ? 128 : 2, first = sub * 32 * each;
    double value = dist->a;
    if (dist->kind == JOX_DIST_CONSTANT)
        return value;
    for (uint32_t attempt = 0; attempt < 16; attempt++) {
        Stream s = {seed, tick, agent, once ? sub : 0x10000 + first + attempt * each, purpose};
        value = draw_value(dist, &s);
        if (once || (value >= dist->lo && value <= dist->hi))
            return value;
    }
    return value < dist->lo ? dist->lo : value > dist->hi ? dist->hi : value;
}
