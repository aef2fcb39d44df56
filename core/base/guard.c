#include "base/guard.h"

#include <stdarg.h>
#include <stdio.h>

static _Thread_local JoxGuard *innermost;

void jox_memory_error(JoError *error) {
    if (!error)
        return;
    *error = (JoError){.code = JO_FAILED};
    snprintf(error->text, sizeof error->text, "out of memory");
}

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
    if (guard->heap == guard->heap_before) /* a call within a call on the same thing: both fail */
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
    JoxGuard *guard = innermost;
    innermost = guard ? guard->outer : NULL;
    const JoxNumeric now = jox_numeric_use(jox_numeric_plain());
    if (guard)
        jox_numeric_use(guard->numeric_before);
    return (JoxOutside){guard, jox_heap_use(guard ? guard->heap_before : NULL), now};
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
