/* Computes at compile time, for each mask of eight lanes, the order that puts the lanes of the mask
   first. Used by all lanes but those of AVX-512. */
#include "simd/packed.h"

#define BIT(mask, lane) ((uint64_t)((mask) >> (lane)&1))
/* Counts the lanes of the mask below `lane`: its place in the packed order. */
#define BELOW(mask, lane)                                                                          \
    (((lane) > 0) * BIT(mask, 0) + ((lane) > 1) * BIT(mask, 1) + ((lane) > 2) * BIT(mask, 2) +     \
     ((lane) > 3) * BIT(mask, 3) + ((lane) > 4) * BIT(mask, 4) + ((lane) > 5) * BIT(mask, 5) +     \
     ((lane) > 6) * BIT(mask, 6))
#define PLACED(mask, lane) (BIT(mask, lane) * (lane) << 8 * BELOW(mask, lane))
#define ORDER(mask)                                                                                \
    (PLACED(mask, 1) | PLACED(mask, 2) | PLACED(mask, 3) | PLACED(mask, 4) | PLACED(mask, 5) |     \
     PLACED(mask, 6) | PLACED(mask, 7))
#define ORDERS_4(mask) ORDER(mask), ORDER((mask) + 1), ORDER((mask) + 2), ORDER((mask) + 3)
#define ORDERS_16(mask)                                                                            \
    ORDERS_4(mask), ORDERS_4((mask) + 4), ORDERS_4((mask) + 8), ORDERS_4((mask) + 12)
#define ORDERS_64(mask)                                                                            \
    ORDERS_16(mask), ORDERS_16((mask) + 16), ORDERS_16((mask) + 32), ORDERS_16((mask) + 48)

const uint64_t jox_packed_order[256] = {ORDERS_64(0), ORDERS_64(64), ORDERS_64(128),
                                        ORDERS_64(192)};
