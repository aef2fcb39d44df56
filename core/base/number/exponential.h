/* The exponential function of elementary.h without branches, for loops that compilers vectorise. */
#ifndef JOX_BASE_EXPONENTIAL_H
#define JOX_BASE_EXPONENTIAL_H

#include <math.h>

#include "base/number/bits.h"

/* Returns jox_exp(x), to the bit, for x from -708 to 709. */
static inline double jox_exp_within(double x) {
    double n = floor(x * 1.4426950408889634 + 0.5);
    double r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
    /* 1 / k! for k from 14 down: |r| is at most ln(2) / 2, so that the next term is below 1e-19. */
    double sum = 1.1470745597729725e-11;
    sum = sum * r + 1.6059043836821613e-10;
    sum = sum * r + 2.0876756987868099e-9;
    sum = sum * r + 2.5052108385441719e-8;
    sum = sum * r + 2.7557319223985891e-7;
    sum = sum * r + 2.7557319223985891e-6;
    sum = sum * r + 2.4801587301587302e-5;
    sum = sum * r + 1.9841269841269841e-4;
    sum = sum * r + 1.3888888888888889e-3;
    sum = sum * r + 8.3333333333333332e-3;
    sum = sum * r + 4.1666666666666664e-2;
    sum = sum * r + 1.6666666666666666e-1;
    sum = sum * r + 0.5;
    sum = sum * r + 1.0;
    sum = sum * r + 1.0;
    return sum * jox_double_of((uint64_t)((int64_t)(int32_t)n + 1023) << 52);
}

#endif
