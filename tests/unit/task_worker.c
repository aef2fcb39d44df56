/* Tests of the worker thread: the order of items, waiting, and items that nobody waits for. */
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
    JoxWorkItem item; /* must be first: the item is cast to its Work */
    int number;
    int turn; /* 1 + number of items that ran before it */
} Work;

static atomic_int turns, held;

static void sleep_1_ms(void) {
    nanosleep(&(struct timespec){0, 1000000}, NULL);
}

static void record_turn(JoxWorkItem *item) {
    ((Work *)item)->turn = atomic_fetch_add(&turns, 1) + 1;
}

/* Occupies the worker's thread until `held` changes. */
static void occupy_thread(JoxWorkItem *item) {
    ((Work *)item)->turn = atomic_fetch_add(&turns, 1) + 1;
    atomic_store(&held, 1);
    while (atomic_load(&held) == 1)
        sleep_1_ms();
}

static void items_run_once_and_in_order(void **state) {
    (void)state;
    static Work work[COUNT];
    JoxWorker *worker = jox_worker_create();
    atomic_store(&turns, 0);
    for (int i = 0; i < COUNT; i++) {
        work[i] = (Work){.item.run = record_turn, .number = i};
        jox_worker_enqueue(worker, &work[i].item);
    }
    while (atomic_load(&turns) < COUNT) /* not jox_worker_wait: it would run items itself */
        sleep_1_ms();
    for (int i = 0; i < COUNT; i++) {
        jox_worker_wait(worker, &work[i].item);
        jox_worker_wait(worker, &work[i].item); /* a second wait returns at once */
        assert_int_equal(work[i].turn, i + 1);
    }
    jox_worker_free(worker);
}

static void waiting_caller_runs_item_that_has_not_begun(void **state) {
    (void)state;
    Work first = {.item.run = occupy_thread}, second = {.item.run = record_turn};
    JoxWorker *worker = jox_worker_create();
    atomic_store(&held, 0);
    jox_worker_enqueue(worker, &first.item);
    while (atomic_load(&held) == 0)
        sleep_1_ms();
    jox_worker_enqueue(worker, &second.item);
    jox_worker_wait(worker, &second.item); /* returns although the thread is occupied */
    assert_true(second.turn > 0);
    atomic_store(&held, 2);
    jox_worker_wait(worker, &first.item);
    jox_worker_free(worker);
}

static void freeing_worker_drops_items_that_have_not_begun(void **state) {
    (void)state;
    Work first = {.item.run = occupy_thread}, second = {.item.run = record_turn};
    JoxWorker *worker = jox_worker_create();
    atomic_store(&held, 0);
    jox_worker_enqueue(worker, &first.item);
    while (atomic_load(&held) == 0)
        sleep_1_ms();
    jox_worker_enqueue(worker, &second.item);
    atomic_store(&held, 2);
    jox_worker_free(worker); /* waits for the first item, which runs */
    assert_true(first.turn > 0);
    jox_worker_free(jox_worker_create());
    jox_worker_free(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(items_run_once_and_in_order),
        cmocka_unit_test(waiting_caller_runs_item_that_has_not_begun),
        cmocka_unit_test(freeing_worker_drops_items_that_have_not_begun),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
