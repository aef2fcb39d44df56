/* For instruction sets that cannot pack lanes by themselves (see jf_store_packed). */
#ifndef JOX_SIMD_PACKED_H
#define JOX_SIMD_PACKED_H

#include <stdint.h>

/* For each mask of eight lanes: byte k is the number of the k-th lane of the mask; the bytes after
   the last are 0. */
extern const uint64_t jox_packed_order[256];

static inline uint32_t jox_count_of_four(uint32_t bits) {
    return (uint32_t)(UINT64_C(0x4332322132212110) >> 4 * bits & 15);
}

#endif
