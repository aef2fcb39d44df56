/* Tables for packing lanes in instruction sets without an instruction for it (see
   jf_store_packed). */
#ifndef JOX_SIMD_PACKED_H
#define JOX_SIMD_PACKED_H

#include <stdint.h>

/* For each mask of eight lanes, byte k is the index of the k-th lane in the mask; bytes after the
   last are 0. */
extern const uint64_t jox_packed_order[256];

/* Returns how many of four bits are set, from a table of 16 digits. */
static inline uint32_t jox_count_of_four(uint32_t bits) {
    return (uint32_t)(UINT64_C(0x4332322132212110) >> 4 * bits & 15);
}

#endif
