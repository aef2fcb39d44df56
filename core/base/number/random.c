#include "base/number/random.h"

double jox_random_unit(uint64_t seed, uint32_t agent, uint64_t tick, JoxDraw purpose,
                       uint32_t sub) {
    return jox_random_share(jox_random_bits(seed, agent, tick, purpose, sub));
}
