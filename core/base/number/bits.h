/* Conversion between floating-point numbers and the bits that store them (IEEE 754). The bits of
   non-negative numbers, as integers, have the same order as the numbers. */
#ifndef JOX_BASE_NUMBER_BITS_H
#define JOX_BASE_NUMBER_BITS_H

#include <stdint.h>
#include <string.h>

static inline uint32_t jox_float_bits(float number) {
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    return bits;
}

static inline float jox_float_of(uint32_t bits) {
    float number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static inline uint64_t jox_double_bits(double number) {
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    return bits;
}

static inline double jox_double_of(uint64_t bits) {
    double number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

#endif
