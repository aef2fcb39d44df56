#include "base/random.h"

#include <math.h>

#include "base/elementary.h"

double jox_random_unit(uint64_t seed, uint32_t agent, uint64_t tick, JoxDraw purpose,
                       uint32_t sub) {
    return jox_random_share(jox_random_bits(seed, agent, tick, purpose, sub));
}

JoxDist jox_dist_constant(double value) {
    return (JoxDist){.kind = JOX_DIST_CONSTANT, .a = value, .lo = -INFINITY, .hi = INFINITY};
}

static double draw_normal(const JoxDist *dist, uint64_t seed, uint32_t agent, uint64_t tick,
                          JoxDraw purpose, uint32_t sub) {
    double value = dist->a;
    for (uint32_t attempt = 0; attempt < 16; attempt++) {
        uint32_t stream = sub * 64 + attempt * 2;
        double u = 1.0 - jox_random_unit(seed, agent, tick, purpose, stream + 0x10000);
        double v = jox_random_unit(seed, agent, tick, purpose, stream + 0x10001);
        value = dist->a + dist->b * sqrt(-2.0 * jox_log(u)) * jox_cos(6.283185307179586 * v);
        if (value >= dist->lo && value <= dist->hi)
            return value;
    }
    return value < dist->lo ? dist->lo : value > dist->hi ? dist->hi : value;
}

double jox_dist_draw(const JoxDist *dist, uint64_t seed, uint32_t agent, uint64_t tick,
                     JoxDraw purpose, uint32_t sub) {
    switch (dist->kind) {
    case JOX_DIST_CONSTANT:
        return dist->a;
    case JOX_DIST_UNIFORM:
        return dist->a + (dist->b - dist->a) * jox_random_unit(seed, agent, tick, purpose, sub);
    case JOX_DIST_NORMAL:
        return draw_normal(dist, seed, agent, tick, purpose, sub);
    case JOX_DIST_CHOOSE:
        return dist
            ->values[(int)(jox_random_unit(seed, agent, tick, purpose, sub) * dist->choices)];
    }
    return dist->a;
}
