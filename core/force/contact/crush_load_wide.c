/* The kernel of the load of an agent, which crush_load.c calls. A lane is one of the forces on the
   agent, as a border between two sides; no sum goes over lanes. */
#include <math.h>

#include "force/contact/contacts.h"
#include "simd/vectors.h"

/* Adds a force to the sums of the marked lanes. */
static inline void add_where(JoxVector *sums, JoxMask marks, JoxVector force) {
    *sums = jv_add(*sums, jv_select(marks, force, (JoxVector){jf_set(0.0f), jf_set(0.0f)}));
}

static inline JoxFloats keep_greater_length2(JoxFloats most2, JoxVector sums) {
    return jf_max(most2, jv_dot(sums, sums));
}

/* Returns the greatest squared length of the sums of forces on either side of borders, each along
   one force; forces on a border are tried on the left, on the right and on neither side. */
static JoxFloats find_border_pushes(JoxVector border, const float *x, const float *y,
                                    uint32_t count, JoxFloats most2) {
    const JoxFloats zero = jf_set(0.0f);
    JoxVector left = {zero, zero}, right = left, along = left;
    for (uint32_t m = 0; m < count; m++) {
        const JoxVector here = {jf_set(x[m]), jf_set(y[m])};
        const JoxFloats side = border.x * here.y - border.y * here.x;
        const JoxMask is_left = jf_lt(zero, side), is_right = jf_lt(side, zero);
        const JoxMask ahead = jf_lt(zero, jv_dot(border, here));
        add_where(&left, is_left, here);
        add_where(&right, is_right, here);
        add_where(&along, jm_without(ahead, jm_or(is_left, is_right)), here);
    }
    most2 = keep_greater_length2(keep_greater_length2(most2, left), right);
    return keep_greater_length2(keep_greater_length2(most2, jv_add(left, along)),
                                jv_add(right, along));
}

float JOX_WIDE(jox_greatest_push)(const float *x, const float *y, uint32_t count) {
    JoxFloats most2 = jf_set(0.0f);
    float by_lane[JOX_WIDTH], greatest2 = 0.0f;
    for (uint32_t k = 0; k < count; k += JOX_WIDTH)
        most2 = find_border_pushes(jv_load(x, y, k), x, y, count, most2);
    jf_store(by_lane, most2);
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        greatest2 = by_lane[lane] > greatest2 ? by_lane[lane] : greatest2;
    return sqrtf(greatest2);
}
