/* Work in child processes: results of any size, failures, and nothing left behind. */
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

static void work(void *context, uint64_t job, JoxText *result) {
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

static void each_ends_in_its_own_way(void **state) {
    (void)state;
    char word[] = "job";
    JoxChildren *children = jox_children_create(3);
    bool seen[JOBS] = {false};
    uint64_t next = 0;
    for (uint32_t ended = 0; ended < JOBS;) {
        if (next < JOBS && jox_children_has_room(children)) {
            assert_true(jox_children_start(children, next++, work, word));
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

static void sleep_on(void *context, uint64_t job, JoxText *result) {
    (void)context, (void)job, (void)result;
    for (;;)
        pause();
}

static void those_that_run_are_ended(void **state) {
    (void)state;
    JoxChildren *children = jox_children_create(2);
    JoxChildEnd end;
    assert_true(jox_children_start(children, 0, sleep_on, NULL));
    assert_true(jox_children_start(children, 1, sleep_on, NULL));
    assert_false(jox_children_has_room(children));
    assert_false(jox_children_wait(children, &end));
    jox_children_free(children);
    assert_true(waitpid(-1, NULL, WNOHANG) < 0 && errno == ECHILD);
}

static void say_or_end(void *context, uint64_t job, JoxText *result) {
    (void)job;
    if (!context)
        abort();
    jox_text_add(result, context);
}

static void one_is_waited_for(void **state) {
    (void)state;
    JoxText result = {0}, why = {0};
    char word[] = "done";
    assert_true(jox_children_do(say_or_end, word, &result, &why));
    assert_string_equal(result.data, "done");
    assert_int_equal(why.length, 0);
    assert_false(jox_children_do(say_or_end, NULL, &result, &why));
    assert_string_equal(result.data, "done");
    assert_non_null(strstr(why.data, "signal 6"));
    jox_text_free(&result);
    jox_text_free(&why);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_ends_in_its_own_way),
                                       cmocka_unit_test(those_that_run_are_ended),
                                       cmocka_unit_test(one_is_waited_for)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
