/* Random numbers as a pure function of (seed, agent, tick, purpose, sub). There is no generator
   state, so that results do not depend on the order of draws or on the number of threads. */
#ifndef JOX_BASE_RANDOM_H
#define JOX_BASE_RANDOM_H

#include <stdint.h>

/* The purposes of draws. Numbers for different purposes are independent. The values are part of
   every run's result and never change. */
typedef enum {
    JOX_DRAW_FILL = 1, /* start position of an agent */
    JOX_DRAW_OWN,      /* per-agent distributions (one per slot) */
    JOX_DRAW_MEMORY,   /* initial memory */
    JOX_DRAW_CHANCE,   /* a transition's chance */
    JOX_DRAW_LASTS,    /* a state's duration */
    JOX_DRAW_ONE_OF,   /* one_of a set of places */
    JOX_DRAW_SOURCE,   /* where an agent of a source appears */
    JOX_DRAW_AIM,      /* where in a place to aim */
    JOX_DRAW_LUA,      /* math.random in hooks */
    JOX_DRAW_MIX,      /* which behaviour of a mix */
    JOX_DRAW_GAP = 12, /* a walker's time gap */
    JOX_DRAW_WANDER,   /* the direction that a wandering agent turns to */
    JOX_DRAW_PROFILE,  /* which profile of a group */
    JOX_DRAW_DOOR,     /* the place of a set that an agent of a source enters by */
    JOX_DRAW_ARRIVAL,  /* time between two agents of a source */
    JOX_DRAW_ASIDE,    /* how far an agent that blocks others steps aside */
    JOX_DRAW_SWAY,     /* movement of waiting agents around their spots */
    JOX_DRAW_SHOULDER, /* how far an agent that gets nowhere turns a shoulder */
    JOX_DRAW_ESCALATOR /* whether an agent walks on an escalator */
} JoxDraw;

/* The finaliser of a 64-bit mixing hash (constants of David Stafford's variant 13). */
static inline uint64_t jox_random_mix(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}
/* The parts of jox_random_bits that do not depend on the agent, for loops over agents to compute
   once: jox_random_of(jox_random_stream(seed), agent, sub, jox_random_moment(tick, purpose)). */
static inline uint64_t jox_random_stream(uint64_t seed) {
    return jox_random_mix(seed + 0x9e3779b97f4a7c15u);
}
static inline uint64_t jox_random_moment(uint64_t tick, JoxDraw purpose) {
    return jox_random_mix(tick * 64 + (uint64_t)purpose);
}
static inline uint64_t jox_random_of(uint64_t stream, uint32_t agent, uint32_t sub,
                                     uint64_t moment) {
    return jox_random_mix(jox_random_mix(stream ^ ((uint64_t)agent << 32 | sub)) ^ moment);
}
/* Returns 64 random bits. `sub` numbers the draws of one agent and purpose within a tick. */
static inline uint64_t jox_random_bits(uint64_t seed, uint32_t agent, uint64_t tick,
                                       JoxDraw purpose, uint32_t sub) {
    return jox_random_of(jox_random_stream(seed), agent, sub, jox_random_moment(tick, purpose));
}
/* Converts random bits to a number uniform in [0, 1), by 53 of them. */
static inline double jox_random_share(uint64_t bits) {
    return (double)(bits >> 11) * 0x1p-53;
}
/* Returns a number uniform in [0, 1). */
double jox_random_unit(uint64_t seed, uint32_t agent, uint64_t tick, JoxDraw purpose, uint32_t sub);

#endif
