/* How a thread reads, writes and computes numbers.

   In all that the engine does, text is read and written as in C, whatever the program's locale:
   where that has decimal commas, `1.5` would be read as 1. And numbers nearer to zero than the
   least normal one (floats: 1.2e-38, doubles: 2.2e-308) count as zero. What decays, as the part of
   a velocity across the way does, becomes so small and stays it; processors take a hundred cycles
   and more for each operation on such numbers.

   Both belong to the thread. What the program had is set again before it goes on, and while it is
   called back. */
#ifndef JOX_BASE_NUMBER_NUMERIC_H
#define JOX_BASE_NUMBER_NUMERIC_H

#include <locale.h>
#include <stdint.h>

typedef struct JoxNumeric {
    locale_t locale;
    uint64_t mode; /* the processor's, as jox_numeric_use reads it */
} JoxNumeric;

/* What the engine uses. Where memory is out, its locale is 0, which leaves a thread's as it is. */
JoxNumeric jox_numeric_plain(void);
/* The calling thread uses it from here on; returns what it used before, which is to be put back. */
JoxNumeric jox_numeric_use(JoxNumeric numeric);

#endif
