#include "base/guard.h"

#include <stdarg.h>
#include <stdio.h>
#if defined(__x86_64__) || defined(__i386__)
#include <xmmintrin.h>
#endif

static _Thread_local JoxGuard *innermost; /* the thread's innermost open guard, or NULL */

void jox_memory_error(JoError *error) {
    if (!error)
        return;
    *error = (JoError){.code = JO_FAILED};
    snprintf(error->text, sizeof error->text, "out of memory");
}

/* ---- subnormal numbers ---- */

#if defined(__x86_64__) || defined(__i386__)
/* Bits FTZ and DAZ of the SSE control register: subnormal results and operands become zero. All
   other bits, exception flags among them, are kept. */
enum { FLUSH = 0x8000 | 0x0040 };

static uint64_t read_mode(void) {
    return _mm_getcsr() & FLUSH;
}

/* Sets or clears the bits that flush subnormal numbers, and no others. */
static void set_mode(uint64_t mode) {
    const uint64_t now = _mm_getcsr();
    if ((now & FLUSH) != mode) /* writing the register is slower than reading it */
        _mm_setcsr((uint32_t)((now & ~(uint64_t)FLUSH) | mode));
}
#elif defined(__aarch64__)
static const uint64_t FLUSH = 1u << 24; /* bit FZ of the floating-point control register */

static uint64_t read_control_register(void) {
    uint64_t value;
    __asm__ volatile("mrs %0, fpcr" : "=r"(value));
    return value;
}

static uint64_t read_mode(void) {
    return read_control_register() & FLUSH;
}

static void set_mode(uint64_t mode) {
    const uint64_t now = read_control_register();
    if ((now & FLUSH) != mode)
        __asm__ volatile("msr fpcr, %0" : : "r"((now & ~FLUSH) | mode));
}
#else
static uint64_t read_mode(void) {
    return 0;
}

static void set_mode(uint64_t mode) {
    (void)mode;
}
#endif

/* Returns the C locale, made at the first call and never freed; 0 if memory is out. */
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
    return (JoxNumeric){plain_locale(), 0};
}

JoxNumeric jox_numeric_use(JoxNumeric numeric) {
    const JoxNumeric before = {uselocale((locale_t)0), read_mode()};
    if (before.locale != numeric.locale)
        uselocale(numeric.locale);
    if (before.mode != numeric.mode)
        set_mode(numeric.mode);
    return before;
}

/* ---- guards ---- */

void jox_guard_open(JoxGuard *guard, JoxHeap *heap, JoError *error) {
    guard->error = error;
    if (!heap)
        jox_heap_begin(&guard->own);
    guard->heap = heap ? heap : &guard->own;
    guard->heap_before = jox_heap_use(guard->heap);
    guard->overlay_before = jox_overlay_use(NULL);
    jox_overlay_use(guard->overlay_before);
    guard->numeric_before = jox_numeric_use(jox_numeric_plain());
    guard->outer = innermost;
    innermost = guard;
    jox_recovery_push(&guard->recovery);
    guard->failed = jox_heap_has_failed(guard->heap);
    if (guard->failed)
        jox_guard_fail(guard);
}

void jox_guard_fail(JoxGuard *guard) {
    guard->failed = true;
    jox_heap_fail(guard->heap);
    jox_memory_error(guard->error);
    jox_heap_use(guard->heap_before);
    jox_overlay_use(guard->overlay_before);
    jox_numeric_use(guard->numeric_before);
    innermost = guard->outer;
    jox_recovery_pop(&guard->recovery);
    if (guard->heap == guard->heap_before) /* a call within a call with the same heap: both fail */
        jox_out_of_memory(0);
}

void jox_guard_close(JoxGuard *guard) {
    jox_recovery_pop(&guard->recovery);
    if (innermost == guard)
        innermost = guard->outer;
    jox_heap_use(guard->heap_before);
    jox_numeric_use(guard->numeric_before);
    if (guard->heap == &guard->own)
        jox_heap_end(&guard->own);
}

JoxOutside jox_guard_leave(void) {
    JoxGuard *outermost = innermost;
    while (outermost && outermost->outer)
        outermost = outermost->outer;
    const JoxOutside outside = {innermost, jox_heap_used(), jox_numeric_use(jox_numeric_plain())};
    if (outermost)
        jox_numeric_use(outermost->numeric_before);
    jox_heap_use(outermost ? outermost->heap_before : NULL);
    innermost = NULL;
    return outside;
}

void jox_guard_return(JoxOutside outside) {
    innermost = outside.guard;
    jox_heap_use(outside.heap);
    jox_numeric_use(outside.numeric);
}

void jox_error(JoError *error, JoCode code, const char *format, ...) {
    if (!error)
        return;
    *error = (JoError){.code = code};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
}
