/* Guards of public calls: a call in which memory runs out returns its error.
 *
 *     bool jo_scene_signal(JoScene *scene, const char *name, JoError *error) {
 *         JOX_GUARD(scene->heap, error) return false;
 *         return signal_everybody(scene, name, error);
 *     }
 *
 * Within the guard, the thread has the engine's numeric settings (JoxNumeric, below).
 *
 * The statement behind JOX_GUARD runs if memory is out, in this call or in an earlier call with the
 * same heap. The guard ends with its block. A function may have one guard and should do little else
 * than call another function: by the rules of setjmp, a local variable that changes below the guard
 * has an undefined value in that statement. */
#ifndef JOX_BASE_GUARD_H
#define JOX_BASE_GUARD_H

#include <locale.h>
#include <stdint.h>

#include "base/mem.h"
#include "base/overlay.h"
#include "jostle.h"

/* ---- numbers ---- */

/* Numeric settings of a thread.

   The engine reads and writes text in the C locale, whatever the program's: with decimal commas,
   `1.5` would be read as 1. It computes with subnormal numbers (below 1.2e-38 in floats, 2.2e-308
   in doubles) as IEEE 754 says, whatever the program does: not every machine can flush them to
   zero, and results must be the same on all. As they are slow, kernels set to zero what decays
   (jf_end_decay of simd/vectors.h).

   Both settings belong to the thread. The program's are restored at the end of a public call, and
   while a callback of the program runs. */
typedef struct JoxNumeric {
    locale_t locale;
    uint64_t mode; /* bits of the floating-point control register that flush subnormal numbers */
} JoxNumeric;

/* The engine's settings. If memory is out, the locale is 0, which uselocale ignores. */
JoxNumeric jox_numeric_plain(void);
/* Sets the calling thread's settings; returns the ones before, for the caller to restore. */
JoxNumeric jox_numeric_use(JoxNumeric numeric);

/* ---- guards ---- */

typedef struct JoxGuard {
    JoxRecovery recovery;
    JoxHeap own;                      /* heap of a call that was given none */
    JoxHeap *heap, *heap_before;      /* in use within the guard; before it */
    const JoxOverlay *overlay_before; /* settings to restore at the end */
    JoxNumeric numeric_before;
    struct JoxGuard *outer; /* the thread's next guard outwards, or NULL */
    JoError *error;         /* filled if memory runs out; or NULL */
    bool failed;
} JoxGuard;

/* Opens a guard. `heap`: that of the object that the call changes, and that fails with it. NULL: a
   heap of the call alone, for calls that leave nothing behind; memory that they return must be
   disowned (jox_disown). `error` may be NULL. */
#define JOX_GUARD(heap_, error_)                                                                   \
    __attribute__((cleanup(jox_guard_close))) JoxGuard jox_guard;                                  \
    jox_guard_open(&jox_guard, (heap_), (error_));                                                 \
    if (setjmp(jox_guard.recovery.jump) != 0)                                                      \
        jox_guard_fail(&jox_guard);                                                                \
    if (jox_guard.failed)

void jox_guard_open(JoxGuard *guard, JoxHeap *heap, JoError *error);
void jox_guard_fail(JoxGuard *guard);
void jox_guard_close(JoxGuard *guard);

/* Enclose a callback of the program: jox_guard_leave restores the heap and the numeric settings
   that were in use outside the public call of the program, which may have made others within it;
   jox_guard_return puts those of the call back. They may be nested: a callback may make a public
   call that calls back. */
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
