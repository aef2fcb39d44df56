/* Guards of public calls: a call in which memory runs out returns its error.
 *
 *     bool jo_scene_signal(JoScene *scene, const char *name, JoError *error) {
 *         JOX_GUARD(scene->heap, error) return false;
 *         return signal_everybody(scene, name, error);
 *     }
 *
 * Within it numbers are read, written and computed as the engine does (JoxNumeric, below).
 *
 * The statement behind JOX_GUARD is what the call does where memory is out, now or in an earlier
 * call with the same heap. The guard ends with the block in which it stands. It may stand once in a
 * function, which should do little but call: a local variable that changes below the guard has no
 * certain value in that statement. */
#ifndef JOX_BASE_GUARD_H
#define JOX_BASE_GUARD_H

#include <locale.h>
#include <stdint.h>

#include "base/mem.h"
#include "base/overlay.h"
#include "jostle.h"

/* ---- numbers ---- */

/* How a thread reads, writes and computes numbers.

   In all that the engine does, text is read and written as in C, whatever the program's locale:
   where that has decimal commas, `1.5` would be read as 1. And numbers nearer to zero than the
   least normal one (floats: 1.2e-38, doubles: 2.2e-308) count as zero. What decays, as the part of
   a velocity across the way does, becomes so small and stays it; processors take a hundred cycles
   and more for each operation on such numbers.

   Both belong to the thread. What the program had is set again before it goes on, and while it is
   called back. */
typedef struct JoxNumeric {
    locale_t locale;
    uint64_t mode; /* the processor's, as jox_numeric_use reads it */
} JoxNumeric;

/* What the engine uses. Where memory is out, its locale is 0, which leaves a thread's as it is. */
JoxNumeric jox_numeric_plain(void);
/* The calling thread uses it from here on; returns what it used before, which is to be put back. */
JoxNumeric jox_numeric_use(JoxNumeric numeric);

/* ---- guards ---- */

typedef struct JoxGuard {
    JoxRecovery recovery;
    JoxHeap own; /* of the call, where it was given no heap */
    JoxHeap *heap, *heap_before;
    const JoxOverlay *overlay_before;
    JoxNumeric numeric_before;
    struct JoxGuard *outer;
    JoError *error;
    bool failed;
} JoxGuard;

/* `heap`: that of the object which the call changes, and which fails with it. NULL: of the call
   alone, for calls that leave nothing behind; what they return is disowned (mem.h). `error` may be
   NULL. */
#define JOX_GUARD(heap_, error_)                                                                   \
    __attribute__((cleanup(jox_guard_close))) JoxGuard jox_guard;                                  \
    jox_guard_open(&jox_guard, (heap_), (error_));                                                 \
    if (setjmp(jox_guard.recovery.jump) != 0)                                                      \
        jox_guard_fail(&jox_guard);                                                                \
    if (jox_guard.failed)

void jox_guard_open(JoxGuard *guard, JoxHeap *heap, JoError *error);
void jox_guard_fail(JoxGuard *guard);
void jox_guard_close(JoxGuard *guard);

/* Around a call back into the program, which runs as outside the innermost public call: with the
   heap and the numeric settings that were in use where that was made. A callback that stands in a
   public call itself may leave that one too. */
typedef struct JoxOutside {
    JoxGuard *guard;
    JoxHeap *heap;
    JoxNumeric numeric;
} JoxOutside;
JoxOutside jox_guard_leave(void);
void jox_guard_return(JoxOutside outside);

/* Fills an error, which may be NULL, with a formatted text. */
void jox_error(JoError *error, JoCode code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Fills `error`, unless NULL, with JO_FAILED and "out of memory". */
void jox_memory_error(JoError *error);

#endif
