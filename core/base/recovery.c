#include "base/recovery.h"

#include <stdio.h>
#include <stdlib.h>

static _Thread_local JoxRecovery *innermost;

void jox_recovery_push(JoxRecovery *recovery) {
    recovery->outer = innermost;
    innermost = recovery;
}

void jox_recovery_pop(JoxRecovery *recovery) {
    if (innermost == recovery)
        innermost = recovery->outer;
}

bool jox_recovery_exists(void) {
    return innermost != NULL;
}

void jox_out_of_memory(size_t bytes) {
    JoxRecovery *recovery = innermost;
    if (!recovery) {
        fprintf(stderr, "jostle: out of memory (%zu bytes wanted)\n", bytes);
        abort();
    }
    innermost = recovery->outer;
    longjmp(recovery->jump, 1);
}
