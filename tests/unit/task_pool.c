/* Loops on several threads: each chunk once, whatever threads do; and how many processors there
   are. */
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
    atomic_uint inside[MOST]; /* by worker: two at a time would share its scratch space */
    atomic_uint clashes, chunks;
    uint32_t slow; /* a chunk that takes a while; UINT32_MAX: none */
} Loop;

static void nap(long us) {
    nanosleep(&(struct timespec){0, us * 1000}, NULL);
}

static void work(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    Loop *loop = context;
    if (worker >= MOST || atomic_fetch_add(&loop->inside[worker], 1) != 0)
        atomic_fetch_add(&loop->clashes, 1);
    if (begin == loop->slow)
        nap(300);
    for (uint32_t i = begin; i < end; i++)
        atomic_fetch_add(&loop->done[i], 1);
    atomic_fetch_add(&loop->chunks, 1);
    if (worker < MOST)
        atomic_fetch_sub(&loop->inside[worker], 1);
}

/* Loops of any length, one behind the other and after pauses in which workers fall asleep. */
static void each_item_is_done_once(void **state) {
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
                nap(2000);
            jox_parallel_for(pool, count, grain, work, &loop);
            assert_int_equal(atomic_load(&loop.chunks), (count + grain - 1) / grain);
            for (uint32_t i = 0; i < ITEMS; i++)
                assert_int_equal(atomic_load(&loop.done[i]), i < count);
            if (round % 5 == 0) /* now one thread is the quicker, now several */
                jox_pool_lap(pool, 0.001 * (1 + round % 17));
        }
        jox_pool_free(pool);
        assert_int_equal(atomic_load(&loop.clashes), 0);
    }
}

static void a_pool_that_had_no_work_ends(void **state) {
    (void)state;
    JoxPool *pool = jox_pool_create(4);
    assert_int_equal(jox_pool_threads(pool), 4);
    jox_pool_free(pool);
}

static void write_file(const char *folder, const char *name, const char *text) {
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void quotas_of_control_groups_count(void **state) {
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
    write_file(root, "list", "0::/outer/inner\n");
    assert_true(jox_processors_quota(list, root) == UINT32_MAX);
    write_file(inner, "cpu.max", "max 100000\n");
    assert_true(jox_processors_quota(list, root) == UINT32_MAX);
    write_file(inner, "cpu.max", "350000 100000\n");
    assert_int_equal(jox_processors_quota(list, root), 4);
    write_file(outer, "cpu.max", "50000 100000\n"); /* the one above holds, too */
    assert_int_equal(jox_processors_quota(list, root), 1);
    write_file(root, "list", "3:memory:/one\n4:cpu,cpuacct:/one\n");
    assert_true(jox_processors_quota(list, root) == UINT32_MAX);
    write_file(one, "cpu.cfs_quota_us", "-1\n");
    write_file(one, "cpu.cfs_period_us", "100000\n");
    assert_true(jox_processors_quota(list, root) == UINT32_MAX);
    write_file(one, "cpu.cfs_quota_us", "200000\n");
    assert_int_equal(jox_processors_quota(list, root), 2);
    write_file(root, "list", "0::/elsewhere\n"); /* of the system about a container */
    write_file(root, "cpu.max", "300000 100000\n");
    assert_int_equal(jox_processors_quota(list, root), 3);
}

static void there_is_a_processor(void **state) {
    (void)state;
    assert_true(jox_processors() >= 1 && jox_processors() <= 64);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_item_is_done_once),
        cmocka_unit_test(a_pool_that_had_no_work_ends),
        cmocka_unit_test(quotas_of_control_groups_count),
        cmocka_unit_test(there_is_a_processor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
