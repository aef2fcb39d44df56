/* An assertion on numbers that differ by rounding or by a tolerance. */
#ifndef JOX_TESTS_ASSERT_NEAR_H
#define JOX_TESTS_ASSERT_NEAR_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Fails for NaN, too. */
#define assert_near(value, wanted, within)                                                         \
    do {                                                                                           \
        const double near_v = (double)(value), near_w = (double)(wanted);                          \
        if (!(fabs(near_v - near_w) <= (within)))                                                  \
            fail_msg("%s is %.9g, not %.9g", #value, near_v, near_w);                              \
    } while (0)

#endif
