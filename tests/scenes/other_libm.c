/* Stands for another C library: loaded before it (LD_PRELOAD), changes the last bit of what its
   functions return. IEEE 754 defines sqrt exactly, but none of these. At exit, prints to stderr how
   many results were changed, if any. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>

static atomic_ulong changed;

#define FUNCTION(type, name, parameters, arguments, next)                                          \
    type name parameters {                                                                         \
        static type(*of_libm) parameters;                                                          \
        if (!of_libm)                                                                              \
            of_libm = (type(*) parameters)dlsym(RTLD_NEXT, #name);                                 \
        const type result = of_libm arguments;                                                     \
        if (result == 0)                                                                           \
            return result;                                                                         \
        atomic_fetch_add(&changed, 1);                                                             \
        return next(result, 0);                                                                    \
    }
#define OF_ONE(name)                                                                               \
    FUNCTION(double, name, (double x), (x), nextafter)                                             \
    FUNCTION(float, name##f, (float x), (x), nextafterf)
#define OF_TWO(name)                                                                               \
    FUNCTION(double, name, (double x, double y), (x, y), nextafter)                                \
    FUNCTION(float, name##f, (float x, float y), (x, y), nextafterf)
OF_ONE(sin)
OF_ONE(cos)
OF_ONE(tan)
OF_ONE(asin)
OF_ONE(acos)
OF_ONE(atan)
OF_ONE(exp)
OF_ONE(log)
OF_TWO(atan2)
OF_TWO(pow)
OF_TWO(hypot)

void sincos(double x, double *sine, double *cosine) {
    *sine = sin(x);
    *cosine = cos(x);
}
void sincosf(float x, float *sine, float *cosine) {
    *sine = sinf(x);
    *cosine = cosf(x);
}

__attribute__((destructor)) static void tell(void) {
    if (atomic_load(&changed))
        fprintf(stderr, "other libm: %lu results changed\n", atomic_load(&changed));
}
