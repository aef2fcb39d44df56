#include "base/assert.h"

#include <stdio.h>
#include <stdlib.h>

static void print_and_abort(const char *condition, const char *file, int line) {
    fprintf(stderr, "jostle: %s:%d: expected: %s\n", file, line, condition);
#ifndef NDEBUG
    abort();
#endif
}

static JoxAssertHandler *handler_now = print_and_abort;

void jox_assert_set_handler(JoxAssertHandler *handler) {
    handler_now = handler ? handler : print_and_abort;
}

void jox_assert_failed(const char *condition, const char *file, int line) {
    handler_now(condition, file, line);
}

void jox_assert_no_fault(const char *condition, const char *file, int line) {
    if (condition)
        jox_assert_failed(condition, file, line);
}
