/* What happens where memory is out: the thread returns to its innermost recovery point.
 *
 *     JoxRecovery recovery;
 *     jox_recovery_push(&recovery);
 *     if (setjmp(recovery.jump) != 0) {
 *         ... memory is out: the point is gone already ...
 *     } else {
 *         ... work ...
 *         jox_recovery_pop(&recovery);
 *     }
 *
 * What the work allocated and opened until then belongs to a heap (mem.h), which releases it. Code
 * between a recovery point and an allocation must hold no lock. Public calls use guard.h. */
#ifndef JOX_BASE_RECOVERY_H
#define JOX_BASE_RECOVERY_H

#include <setjmp.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct JoxRecovery {
    jmp_buf jump;
    struct JoxRecovery *outer;
} JoxRecovery;

/* Of the calling thread. `recovery` stays in the caller's frame until it is popped or reached. */
void jox_recovery_push(JoxRecovery *recovery);
/* Takes the innermost point away; does nothing where it was reached and is gone. */
void jox_recovery_pop(JoxRecovery *recovery);
/* Whether the calling thread has a recovery point. */
bool jox_recovery_exists(void);

/* Goes to the innermost recovery point of the thread. Without one the program ends with a message:
   only our own programs and tests call the engine that way. `bytes` were wanted; 0 is unknown. */
_Noreturn void jox_out_of_memory(size_t bytes);

#endif
