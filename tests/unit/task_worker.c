/* The worker beside the steps: order, waiting, and work that nobody waits for. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>

#include <cmocka.h>

#include "task/worker.h"

enum { COUNT = 200 };

typedef struct Work {
    JoxWorkItem item; /* first */
    int number;
    int turn; /* as which it was run, from 1 */
} Work;

static atomic_int turns, held;

static void nap(void) {
    nanosleep(&(struct timespec){0, 1000000}, NULL);
}

static void run(JoxWorkItem *item) {
    ((Work *)item)->turn = atomic_fetch_add(&turns, 1) + 1;
}

/* Keeps the thread until it is let go. */
static void hold(JoxWorkItem *item) {
    ((Work *)item)->turn = atomic_fetch_add(&turns, 1) + 1;
    atomic_store(&held, 1);
    while (atomic_load(&held) == 1)
        nap();
}

static void each_is_done_once_and_in_order(void **state) {
    (void)state;
    static Work work[COUNT];
    JoxWorker *worker = jox_worker_create();
    atomic_store(&turns, 0);
    for (int i = 0; i < COUNT; i++) {
        work[i] = (Work){.item.run = run, .number = i};
        jox_worker_give(worker, &work[i].item);
    }
    while (atomic_load(&turns) < COUNT) /* who waits would take part in it */
        nap();
    for (int i = 0; i < COUNT; i++) {
        jox_worker_wait(worker, &work[i].item);
        jox_worker_wait(worker, &work[i].item); /* once more returns at once */
        assert_int_equal(work[i].turn, i + 1);
    }
    jox_worker_free(worker);
}

static void who_waits_does_what_has_not_begun(void **state) {
    (void)state;
    Work first = {.item.run = hold}, second = {.item.run = run};
    JoxWorker *worker = jox_worker_create();
    atomic_store(&held, 0);
    jox_worker_give(worker, &first.item);
    while (atomic_load(&held) == 0)
        nap();
    jox_worker_give(worker, &second.item);
    jox_worker_wait(worker, &second.item); /* the thread is held: this returns all the same */
    assert_true(second.turn > 0);
    atomic_store(&held, 2);
    jox_worker_wait(worker, &first.item);
    jox_worker_free(worker);
}

static void what_nobody_waits_for_is_dropped(void **state) {
    (void)state;
    Work first = {.item.run = hold}, second = {.item.run = run};
    JoxWorker *worker = jox_worker_create();
    atomic_store(&held, 0);
    jox_worker_give(worker, &first.item);
    while (atomic_load(&held) == 0)
        nap();
    jox_worker_give(worker, &second.item);
    atomic_store(&held, 2);
    jox_worker_free(worker); /* ends the first, which is under way */
    assert_true(first.turn > 0);
    jox_worker_free(jox_worker_create());
    jox_worker_free(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_is_done_once_and_in_order),
        cmocka_unit_test(who_waits_does_what_has_not_begun),
        cmocka_unit_test(what_nobody_waits_for_is_dropped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
