/* Probability distributions: their names and arguments in scenes and behaviours, and how numbers
   are drawn from them. */
#ifndef JOX_BASE_DISTRIBUTION_H
#define JOX_BASE_DISTRIBUTION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/number/random.h"
#include "base/text.h"

enum { JOX_DIST_CHOICES = 8 };

#define JOX_DIST_BOUNDED " [, least, greatest]"
/* X(KIND, name, arguments, meaning, example). Those with JOX_DIST_BOUNDED have two optional
   bounds. */
#define JOX_DISTS(X)                                                                               \
    X(NORMAL, normal, "mean, deviation" JOX_DIST_BOUNDED, "a normal distribution",                 \
      "normal(1, 0.1, 0.5, 1.5)")                                                                  \
    X(LOGNORMAL, lognormal, "mean, deviation" JOX_DIST_BOUNDED,                                    \
      "a number whose logarithm has a normal distribution of this mean and deviation",             \
      "lognormal(4.6, 0.97, 0, 600)")                                                              \
    X(GAMMA, gamma, "shape, scale" JOX_DIST_BOUNDED,                                               \
      "a gamma distribution; its mean is shape times scale", "gamma(1.3, 100, 0, 600)")            \
    X(WEIBULL, weibull, "shape, scale" JOX_DIST_BOUNDED, "a Weibull distribution",                 \
      "weibull(1.2, 140, 0, 600)")                                                                 \
    X(UNIFORM, uniform, "least, greatest", "a uniform distribution between two bounds",            \
      "uniform(0.8, 1.2)")                                                                         \
    X(CHOOSE, choose, "a, b, ...", "one of up to 8 values, with equal probability",                \
      "choose(0.8, 1, 1.2)")

typedef enum JoxDistKind {
    JOX_DIST_CONSTANT,
#define X(kind, ...) JOX_DIST_##kind,
    JOX_DISTS(X)
#undef X
        JOX_DIST_KINDS
} JoxDistKind;

/* A distribution with its arguments. */
typedef struct JoxDist {
    JoxDistKind kind;
    double a, b;   /* the first two arguments; a: the value of a constant */
    double lo, hi; /* bounds, infinite without: numbers beyond are drawn again, at last clamped */
    double values[JOX_DIST_CHOICES]; /* the arguments of choose */
    int choices;
} JoxDist;

/* All distributions with their arguments, separated by commas; for errors. */
extern const char jox_dist_usage[];
/* Returns the kind that has a name of `length` bytes; JOX_DIST_KINDS if none has. */
JoxDistKind jox_dist_named(const char *name, size_t length);

JoxDist jox_dist_constant(double value);
/* Makes a distribution of `count` arguments; false if the kind does not accept them. */
bool jox_dist_make(JoxDistKind kind, const double *arguments, int count, JoxDist *out);
bool jox_dist_same(const JoxDist *a, const JoxDist *b);
/* Returns a typical value, without regard to bounds: the mean; lognormal: the median; choose: the
   first value. */
double jox_dist_middle(const JoxDist *dist);
/* Appends the distribution as a scene writes it; a constant as its number. */
void jox_dist_print(const JoxDist *dist, JoxText *out);

/* Draws a number, a pure function of all arguments (random.h). */
double jox_dist_draw(const JoxDist *dist, uint64_t seed, uint32_t agent, uint64_t tick,
                     JoxDraw purpose, uint32_t sub);

#endif
