/* Distributions of numbers: what they are called, what they take, and how they are drawn. */
#ifndef JOX_BASE_DISTRIBUTION_H
#define JOX_BASE_DISTRIBUTION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/number/random.h"
#include "base/text.h"

enum { JOX_DIST_CHOICES = 8 };

#define JOX_DIST_BOUNDED " [, least, greatest]"
/* X(KIND, name, arguments, meaning, example). Those that may be bounded take two arguments more. */
#define JOX_DISTS(X)                                                                               \
    X(NORMAL, normal, "mean, deviation" JOX_DIST_BOUNDED, "a normal distribution",                 \
      "normal(1, 0.1, 0.5, 1.5)")                                                                  \
    X(LOGNORMAL, lognormal, "mean, deviation" JOX_DIST_BOUNDED,                                    \
      "a number whose logarithm has a normal distribution of this mean and deviation",             \
      "lognormal(4.6, 0.97, 0, 600)")                                                              \
    X(GAMMA, gamma, "shape, scale" JOX_DIST_BOUNDED,                                               \
      "a gamma distribution, of mean shape times scale", "gamma(1.3, 100, 0, 600)")                \
    X(WEIBULL, weibull, "shape, scale" JOX_DIST_BOUNDED, "a Weibull distribution",                 \
      "weibull(1.2, 140, 0, 600)")                                                                 \
    X(UNIFORM, uniform, "least, greatest", "even between two bounds", "uniform(0.8, 1.2)")         \
    X(CHOOSE, choose, "a, b, ...", "one of up to 8 values, all alike", "choose(0.8, 1, 1.2)")

typedef enum JoxDistKind {
    JOX_DIST_CONSTANT,
#define X(kind, ...) JOX_DIST_##kind,
    JOX_DISTS(X)
#undef X
        JOX_DIST_KINDS
} JoxDistKind;

/* a, b: the first two arguments; of a constant, a is its value. What is drawn of those that may be
   bounded is kept within [lo, hi], by redrawing, then by taking the nearer of them. */
typedef struct JoxDist {
    JoxDistKind kind;
    double a, b, lo, hi;
    double values[JOX_DIST_CHOICES];
    int choices;
} JoxDist;

/* All that can be written, with commas between; for errors. */
extern const char jox_dist_usage[];
/* The kind of a name of `length` bytes; JOX_DIST_KINDS if it is none. */
JoxDistKind jox_dist_named(const char *name, size_t length);

JoxDist jox_dist_constant(double value);
/* The distribution of a kind with so many arguments; false where it does not take these. */
bool jox_dist_make(JoxDistKind kind, const double *arguments, int count, JoxDist *out);
bool jox_dist_same(const JoxDist *a, const JoxDist *b);
/* The mean, of a lognormal one the median, before bounds; of a constant its value. */
double jox_dist_middle(const JoxDist *dist);
/* As it is written; of a constant the number. */
void jox_dist_print(const JoxDist *dist, JoxText *out);

/* Draws with the stream (seed, agent, tick, purpose, sub). Gamma: G. Marsaglia and W. W. Tsang, "A
   simple method for generating gamma variables", ACM TOMS 26(3), 2000. */
double jox_dist_draw(const JoxDist *dist, uint64_t seed, uint32_t agent, uint64_t tick,
                     JoxDraw purpose, uint32_t sub);

#endif
