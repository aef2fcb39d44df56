/* Tests of child processes: results of any size, failures, and children that are killed with their
   set. */
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/mem.h"
#include "task/children.h"

enum { JOBS = 7, LONG = 3 << 20 };

static void run_test_job(void *context, uint64_t job, JoxText *result) {
    static const char LINE[] = "spoken\n";
    switch (job) {
    case 1:
        abort();
    case 2:
        _exit(7);
    case 3:
        jox_out_of_memory(0);
    case 4:
        while (result->length < LONG)
            jox_text_append(result, "abcdefgh", 8);
        return;
    case 5:
        if (write(2, LINE, sizeof LINE - 1) > 0)
            _exit(9);
        return;
    default:
        jox_text_printf(result, "%s %llu", (const char *)context, (unsigned long long)job);
    }
}

static void child_ends_are_reported(void **state) {
    (void)state;
    char word[] = "job";
    JoxChildren *children = jox_children_create(3);
    bool seen[JOBS] = {false};
    uint64_t next = 0;
    for (uint32_t ended = 0; ended < JOBS;) {
        if (next < JOBS && jox_children_has_room(children)) {
            assert_true(jox_children_start(children, next++, run_test_job, word));
            continue;
        }
        assert_in_range(jox_children_count(children), 1, 3);
        JoxChildEnd end;
        if (!jox_children_wait(children, &end))
            continue;
        ended++;
        assert_false(seen[end.job]);
        seen[end.job] = true;
        assert_true(end.good == (end.job == 0 || end.job == 4 || end.job == 6));
        static const char *const WHY[] = {NULL, "signal 6", "status 7", "out of memory",
                                          NULL, "spoken"};
        if (!end.good && !strstr(end.why, WHY[end.job]))
            fail_msg("%s", end.why);
        if (end.job == 6)
            assert_string_equal(end.result.data, "job 6");
        if (end.job == 4)
            assert_int_equal(end.result.length, LONG);
        jox_text_free(&end.result);
    }
    jox_children_free(children);
}

static void sleep_forever(void *context, uint64_t job, JoxText *result) {
    (void)context, (void)job, (void)result;
    for (;;)
        pause();
}

static void running_children_are_killed_with_their_set(void **state) {
    (void)state;
    JoxChildren *children = jox_children_create(2);
    JoxChildEnd end;
    assert_true(jox_children_start(children, 0, sleep_forever, NULL));
    assert_true(jox_children_start(children, 1, sleep_forever, NULL));
    assert_false(jox_children_has_room(children));
    assert_false(jox_children_wait(children, &end));
    jox_children_free(children);
    assert_true(waitpid(-1, NULL, WNOHANG) < 0 && errno == ECHILD);
}

static void write_or_abort(void *context, uint64_t job, JoxText *result) {
    (void)job;
    if (!context)
        abort();
    jox_text_add(result, context);
}

static void single_child_is_waited_for(void **state) {
    (void)state;
    JoxText result = {0}, why = {0};
    char word[] = "done";
    assert_true(jox_children_do(write_or_abort, word, &result, &why));
    assert_string_equal(result.data, "done");
    assert_int_equal(why.length, 0);
    assert_false(jox_children_do(write_or_abort, NULL, &result, &why));
    assert_string_equal(result.data, "done");
    assert_non_null(strstr(why.data, "signal 6"));
    jox_text_free(&result);
    jox_text_free(&why);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(child_ends_are_reported),
                                       cmocka_unit_test(running_children_are_killed_with_their_set),
                                       cmocka_unit_test(single_child_is_waited_for)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
