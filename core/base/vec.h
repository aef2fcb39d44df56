/* Vectors in the plane, in m (or m/s, N): x east, y north. Float arithmetic without fused
   operations, so that results have the same bits on every machine. */
#ifndef JOX_BASE_VEC_H
#define JOX_BASE_VEC_H

#include <math.h>
#include <stdbool.h>

typedef struct JoxV2 {
    float x, y;
} JoxV2;
typedef struct JoxV3 {
    float x, y, z;
} JoxV3;

static inline JoxV2 jox_v2(float x, float y) {
    return (JoxV2){x, y};
}
static inline JoxV2 jox_add(JoxV2 a, JoxV2 b) {
    return (JoxV2){a.x + b.x, a.y + b.y};
}
static inline JoxV2 jox_sub(JoxV2 a, JoxV2 b) {
    return (JoxV2){a.x - b.x, a.y - b.y};
}
static inline JoxV2 jox_scale(JoxV2 a, float s) {
    return (JoxV2){a.x * s, a.y * s};
}
static inline float jox_dot(JoxV2 a, JoxV2 b) {
    return a.x * b.x + a.y * b.y;
}
/* z of the cross product: positive where b lies to the left of a. */
static inline float jox_det(JoxV2 a, JoxV2 b) {
    return a.x * b.y - a.y * b.x;
}
static inline float jox_length2(JoxV2 a) {
    return a.x * a.x + a.y * a.y;
}
static inline float jox_length(JoxV2 a) {
    return sqrtf(jox_length2(a));
}
static inline JoxV2 jox_left(JoxV2 a) {
    return (JoxV2){-a.y, a.x};
}
/* Unit vector; zero stays zero. */
static inline JoxV2 jox_unit(JoxV2 a) {
    float l = jox_length(a);
    return l > 0.0f ? jox_scale(a, 1.0f / l) : (JoxV2){0.0f, 0.0f};
}
/* For assertions: whether a vector has length 1, within rounding. NAN passes: the check for NAN
   elsewhere names the agent and its behaviour, which is more help. */
static inline bool jox_is_unit(JoxV2 a) {
    return !(fabsf(jox_length2(a) - 1.0f) > 1e-3f);
}
static inline float jox_minf(float a, float b) {
    return a < b ? a : b;
}
static inline float jox_maxf(float a, float b) {
    return a > b ? a : b;
}
static inline float jox_clampf(float x, float lo, float hi) {
    return x < lo ? lo : x > hi ? hi : x;
}

#endif
