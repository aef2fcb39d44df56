#include "base/number/numeric.h"

#include <stdbool.h>

/* ---- subnormal numbers ---- */

#if defined(__x86_64__) || defined(__i386__)
#include <xmmintrin.h>

/* Of the control and status register of SSE: results that are subnormal are zero, and so is what is
   read. The other bits of control stay as they are, and exceptions that were noted too. */
enum { FLUSH = 0x8000 | 0x0040 };

static uint64_t mode_of_thread(void) {
    return _mm_getcsr() & FLUSH;
}

static void set_mode(uint64_t mode) {
    const uint64_t now = _mm_getcsr();
    if ((now & FLUSH) != mode) /* to write it takes longer than to read it */
        _mm_setcsr((uint32_t)((now & ~(uint64_t)FLUSH) | mode));
}
#elif defined(__aarch64__)
static const uint64_t FLUSH = 1u << 24; /* of the floating-point control register */

static uint64_t register_of_thread(void) {
    uint64_t value;
    __asm__ volatile("mrs %0, fpcr" : "=r"(value));
    return value;
}

static uint64_t mode_of_thread(void) {
    return register_of_thread() & FLUSH;
}

static void set_mode(uint64_t mode) {
    const uint64_t now = register_of_thread();
    if ((now & FLUSH) != mode)
        __asm__ volatile("msr fpcr, %0" : : "r"((now & ~FLUSH) | mode));
}
#else
enum { FLUSH = 0 };

static uint64_t mode_of_thread(void) {
    return 0;
}

static void set_mode(uint64_t mode) {
    (void)mode;
}
#endif

/* ---- the locale ---- */

/* Made once, and never freed. */
static locale_t plain_locale(void) {
    static locale_t plain;
    locale_t seen = __atomic_load_n(&plain, __ATOMIC_ACQUIRE);
    if (!seen) {
        locale_t made = newlocale(LC_ALL_MASK, "C", (locale_t)0);
        if (__atomic_compare_exchange_n(&plain, &seen, made, false, __ATOMIC_ACQ_REL,
                                        __ATOMIC_ACQUIRE))
            seen = made;
        else
            freelocale(made);
    }
    return seen;
}

JoxNumeric jox_numeric_plain(void) {
    return (JoxNumeric){plain_locale(), FLUSH};
}

JoxNumeric jox_numeric_use(JoxNumeric numeric) {
    const JoxNumeric before = {uselocale(numeric.locale), mode_of_thread()};
    set_mode(numeric.mode);
    return before;
}
