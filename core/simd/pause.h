/* What a thread does in each turn of a loop that waits for another: it leaves the processor's other
   thread more room. */
#ifndef JOX_SIMD_PAUSE_H
#define JOX_SIMD_PAUSE_H

#if defined __x86_64__
#include <emmintrin.h>
#endif

/* AArch64's own hint for it costs no time at all on most processors; `isb` costs about as much as
   x86-64's pause. */
static inline void jox_pause(void) {
#if defined __x86_64__
    _mm_pause();
#elif defined __aarch64__
    __asm__ volatile("isb");
#endif
}

#endif
