/* Elementary functions with the same results, to the bit, on every machine: made of + - * / and
   sqrt, which IEEE 754 defines exactly, unlike those of the C library. Relative error below 1e-12
   in the ranges of a simulation; angles in radians. */
#ifndef JOX_BASE_ELEMENTARY_H
#define JOX_BASE_ELEMENTARY_H

double jox_sin(double x);
double jox_cos(double x);
double jox_atan2(double y, double x);
double jox_exp(double x);
double jox_log(double x);                     /* -inf at 0, NaN below */
double jox_pow(double base, double exponent); /* NaN for a negative base with a fraction */

#endif
