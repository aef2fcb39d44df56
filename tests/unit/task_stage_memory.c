/* Tests of the memory that stages share: arrays of a stage do not overlap, and the block is
   reused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "task/stage_memory.h"

enum { STAGES = 3, TAKEN = 4 };
static const size_t COUNTS[STAGES][TAKEN] = {{100, 1, 0, 7}, {1000, 3, 17, 1}, {5, 5, 5, 5}};
static const size_t SIZES[TAKEN] = {4, 64, 8, 1};

static size_t count_stage_bytes(int stage) {
    size_t bytes = 0;
    for (int k = 0; k < TAKEN; k++)
        bytes += jox_stage_memory_bytes(COUNTS[stage][k], SIZES[k]);
    return bytes;
}

/* Fills each array that a stage takes and checks that the earlier ones keep their contents. */
static void arrays_of_a_stage_do_not_overlap(void **state) {
    (void)state;
    JoxStageMemory memory = {0};
    for (int round = 0; round < 2; round++)
        for (int stage = 0; stage < STAGES; stage++) {
            unsigned char *taken[TAKEN];
            jox_stage_memory_begin(&memory, count_stage_bytes(stage));
            for (int k = 0; k < TAKEN; k++) {
                taken[k] = jox_stage_memory_take(&memory, COUNTS[stage][k], SIZES[k]);
                assert_int_equal((uintptr_t)taken[k] % 64, 0);
                memset(taken[k], k + 1, COUNTS[stage][k] * SIZES[k]);
            }
            for (int k = 0; k < TAKEN; k++)
                assert_true(jox_mem_is(taken[k], (uint8_t)(k + 1), COUNTS[stage][k] * SIZES[k]));
        }
    jox_stage_memory_free(&memory);
}

/* Once it has grown to the largest stage, the block is neither allocated again nor moved. */
static void block_grows_to_the_largest_stage(void **state) {
    (void)state;
    JoxStageMemory memory = {0};
    for (int stage = 0; stage < STAGES; stage++)
        jox_stage_memory_begin(&memory, count_stage_bytes(stage));
    const uint64_t before = jox_alloc_count();
    const char *block = memory.block;
    for (int stage = 0; stage < STAGES; stage++) {
        jox_stage_memory_begin(&memory, count_stage_bytes(stage));
        assert_ptr_equal(jox_stage_memory_take(&memory, 1, 1), block);
    }
    assert_int_equal(jox_alloc_count(), before);
    assert_true(memory.capacity >= count_stage_bytes(1) &&
                memory.capacity < 2 * count_stage_bytes(1));
    jox_stage_memory_free(&memory);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arrays_of_a_stage_do_not_overlap),
        cmocka_unit_test(block_grows_to_the_largest_stage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
