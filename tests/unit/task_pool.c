/* Tests of the thread pool: every chunk runs exactly once. Also of the number of processors. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>

#include <cmocka.h>

#include "task/pool.h"
#include "task/processors.h"

enum { ITEMS = 1000, ROUNDS = 3000, MOST = 8 };

typedef struct Loop {
    atomic_uint done[ITEMS];
    atomic_uint inside[MOST]; /* chunks that run now, by worker: two would share scratch memory */
    atomic_uint clashes, chunks;
    uint32_t slow; /* first iteration of a slow chunk; UINT32_MAX: none */
} Loop;

static void sleep_us(long us) {
    nanosleep(&(struct timespec){0, us * 1000}, NULL);
}

static void count_iterations(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    Loop *loop = context;
    if (worker >= MOST || atomic_fetch_add(&loop->inside[worker], 1) != 0)
        atomic_fetch_add(&loop->clashes, 1);
    if (begin == loop->slow)
        sleep_us(300);
    for (uint32_t i = begin; i < end; i++)
        atomic_fetch_add(&loop->done[i], 1);
    atomic_fetch_add(&loop->chunks, 1);
    if (worker < MOST)
        atomic_fetch_sub(&loop->inside[worker], 1);
}

/* Runs loops of many lengths in succession, with pauses in which workers fall asleep. */
static void every_iteration_runs_once(void **state) {
    (void)state;
    static Loop loop;
    for (uint32_t threads = 1; threads <= 5; threads += 2) {
        JoxPool *pool = jox_pool_create(threads);
        assert_int_equal(jox_pool_threads(pool), threads);
        for (uint32_t round = 0; round < ROUNDS; round++) {
            const uint32_t count = round * 37 % (ITEMS + 1), grain = 1 + round % 60;
            for (uint32_t i = 0; i < ITEMS; i++)
                atomic_store(&loop.done[i], 0);
            atomic_store(&loop.chunks, 0);
            loop.slow = round % 100 == 50 ? 0 : UINT32_MAX;
            if (round % 150 == 75)
                sleep_us(2000);
            jox_parallel_for(pool, count, grain, count_iterations, &loop);
            assert_int_equal(atomic_load(&loop.chunks), (count + grain - 1) / grain);
            for (uint32_t i = 0; i < ITEMS; i++)
                assert_int_equal(atomic_load(&loop.done[i]), i < count);
            if (round % 5 == 0) /* pretends that now one thread is faster, now several */
                jox_pool_note_duration(pool, 0.001 * (1 + round % 17));
        }
        jox_pool_free(pool);
        assert_int_equal(atomic_load(&loop.clashes), 0);
    }
}

static void pool_without_work_can_be_freed(void **state) {
    (void)state;
    JoxPool *pool = jox_pool_create(4);
    assert_int_equal(jox_pool_threads(pool), 4);
    jox_pool_free(pool);
}

static void write_group_file(const char *folder, const char *name, const char *text) {
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void control_group_quotas_limit_processors(void **state) {
    (void)state;
    char root[] = "/tmp/jostle-cgroup-XXXXXX", list[64], inner[64], outer[64], first[64], one[64];
    assert_non_null(mkdtemp(root));
    snprintf(list, sizeof list, "%s/list", root);
    snprintf(outer, sizeof outer, "%s/outer", root);
    snprintf(inner, sizeof inner, "%s/outer/inner", root);
    snprintf(first, sizeof first, "%s/cpu", root);
    snprintf(one, sizeof one, "%s/cpu/one", root);
    mkdir(outer, 0700);
    mkdir(inner, 0700);
    mkdir(first, 0700);
    mkdir(one, 0700);
    assert_true(jox_processors_quota(list, root) == UINT32_MAX);
    write_group_file(root, "list", "0::/outer/inner\n");
    assert_true(jox_processors_quota(list, root) == UINT32_MAX);
    write_group_file(inner, "cpu.max", "max 100000\n");
    assert_true(jox_processors_quota(list, root) == UINT32_MAX);
    write_group_file(inner, "cpu.max", "350000 100000\n");
    assert_int_equal(jox_processors_quota(list, root), 4);
    write_group_file(outer, "cpu.max",
                     "50000 100000\n"); /* the quota of the outer group limits, too */
    assert_int_equal(jox_processors_quota(list, root), 1);
    write_group_file(root, "list", "3:memory:/one\n4:cpu,cpuacct:/one\n");
    assert_true(jox_processors_quota(list, root) == UINT32_MAX);
    write_group_file(one, "cpu.cfs_quota_us", "-1\n");
    write_group_file(one, "cpu.cfs_period_us", "100000\n");
    assert_true(jox_processors_quota(list, root) == UINT32_MAX);
    write_group_file(one, "cpu.cfs_quota_us", "200000\n");
    assert_int_equal(jox_processors_quota(list, root), 2);
    write_group_file(root, "list", "0::/elsewhere\n"); /* a path outside the container */
    write_group_file(root, "cpu.max", "300000 100000\n");
    assert_int_equal(jox_processors_quota(list, root), 3);
}

static void processors_are_1_to_64(void **state) {
    (void)state;
    assert_true(jox_count_processors() >= 1 && jox_count_processors() <= 64);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_iteration_runs_once),
        cmocka_unit_test(pool_without_work_can_be_freed),
        cmocka_unit_test(control_group_quotas_limit_processors),
        cmocka_unit_test(processors_are_1_to_64),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
