/* Pauses a thread for one turn of a loop that waits for another thread, so that the processor
   core's other thread runs faster. */
#ifndef JOX_SIMD_PAUSE_H
#define JOX_SIMD_PAUSE_H

#if defined __x86_64__
#include <emmintrin.h>
#endif

/* On AArch64 the hint `yield` takes no time on most processors; `isb` takes about as long as
   x86-64's pause. */
static inline void jox_pause(void) {
#if defined __x86_64__
    _mm_pause();
#elif defined __aarch64__
    __asm__ volatile("isb");
#endif
}

#endif
