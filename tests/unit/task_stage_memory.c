/* Memory that stages share: what one stage takes lies side by side, and the next one has it again.
 */
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

static size_t bytes_of(int stage) {
    size_t bytes = 0;
    for (int k = 0; k < TAKEN; k++)
        bytes += jox_stage_memory_bytes(COUNTS[stage][k], SIZES[k]);
    return bytes;
}

/* Fills what each stage takes; what it took before is still as it was filled. */
static void what_is_taken_is_apart(void **state) {
    (void)state;
    JoxStageMemory memory = {0};
    for (int round = 0; round < 2; round++)
        for (int stage = 0; stage < STAGES; stage++) {
            unsigned char *taken[TAKEN];
            jox_stage_memory_begin(&memory, bytes_of(stage));
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

/* Once it has grown to the greediest stage, it neither allocates nor moves. */
static void it_grows_to_the_greediest(void **state) {
    (void)state;
    JoxStageMemory memory = {0};
    for (int stage = 0; stage < STAGES; stage++)
        jox_stage_memory_begin(&memory, bytes_of(stage));
    const uint64_t before = jox_alloc_count();
    const char *block = memory.block;
    for (int stage = 0; stage < STAGES; stage++) {
        jox_stage_memory_begin(&memory, bytes_of(stage));
        assert_ptr_equal(jox_stage_memory_take(&memory, 1, 1), block);
    }
    assert_int_equal(jox_alloc_count(), before);
    assert_true(memory.capacity >= bytes_of(1) && memory.capacity < 2 * bytes_of(1));
    jox_stage_memory_free(&memory);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_taken_is_apart),
        cmocka_unit_test(it_grows_to_the_greediest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
