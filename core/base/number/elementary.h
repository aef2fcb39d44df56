/* Elementary functions with the same bits on every machine: built of + - * / and sqrt alone.
   Relative error below 1e-12 over the ranges a crowd needs; angles in radians. */
#ifndef JOX_BASE_ELEMENTARY_H
#define JOX_BASE_ELEMENTARY_H

double jox_sin(double x);
double jox_cos(double x);
double jox_atan2(double y, double x);
double jox_exp(double x);
double jox_log(double x);                     /* -inf at 0, NaN below */
double jox_pow(double base, double exponent); /* NaN for a negative base with a fraction */

#endif
