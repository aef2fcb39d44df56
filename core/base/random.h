/* Random numbers as a pure function of (seed, agent, tick, purpose): no state, no order. */
#ifndef JOX_BASE_RANDOM_H
#define JOX_BASE_RANDOM_H

#include <stdint.h>

/* What a number is drawn for: keeps the streams of different uses apart. */
typedef enum {
    JOX_DRAW_FILL = 1, /* scene: where an agent is put */
    JOX_DRAW_OWN,      /* per-agent distributions (one per slot) */
    JOX_DRAW_MEMORY,   /* initial memory */
    JOX_DRAW_CHANCE,   /* a transition's chance */
    JOX_DRAW_LASTS,    /* a state's duration */
    JOX_DRAW_ONE_OF,   /* one_of a set of places */
    JOX_DRAW_SOURCE,   /* sources */
    JOX_DRAW_AIM,      /* where in a place to aim */
    JOX_DRAW_LUA,      /* math.random in hooks */
    JOX_DRAW_MIX,      /* which behaviour of a mix */
    JOX_DRAW_TURN,     /* how far a shoulder is turned */
    JOX_DRAW_GAP       /* a walker's time gap */
} JoxDraw;

/* 64 independent bits. `sub` numbers the draws of one purpose. */
uint64_t jox_random_bits(uint64_t seed, uint32_t agent, uint64_t tick, JoxDraw purpose,
                         uint32_t sub);
/* Uniform in [0, 1), 53 bits. */
double jox_random_unit(uint64_t seed, uint32_t agent, uint64_t tick, JoxDraw purpose, uint32_t sub);

typedef enum { JOX_DIST_CONSTANT, JOX_DIST_UNIFORM, JOX_DIST_NORMAL, JOX_DIST_CHOOSE } JoxDistKind;
enum { JOX_DIST_CHOICES = 8 };

/* A distribution: constant a; uniform [a, b); normal mean a, deviation b, kept within [lo, hi] (by
   redrawing, then clamping); choose among `choices` values with equal weight. */
typedef struct JoxDist {
    JoxDistKind kind;
    double a, b, lo, hi;
    double values[JOX_DIST_CHOICES];
    int choices;
} JoxDist;

JoxDist jox_dist_constant(double value);
/* Draws with the stream (seed, agent, tick, purpose, sub). */
double jox_dist_draw(const JoxDist *dist, uint64_t seed, uint32_t agent, uint64_t tick,
                     JoxDraw purpose, uint32_t sub);

#endif
