/* Filling of memory: all bytes are set, none beyond, and equal bytes are not written. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>

#include <cmocka.h>

#include "base/mem.h"

enum { MOST = 70, PAGE = 4096 };

static void fill_sets_all_bytes(void **state) {
    (void)state;
    unsigned char bytes[MOST + 2];
    for (size_t size = 0; size <= MOST; size++)
        for (size_t at = 0; at < size || at == 0; at++) {
            memset(bytes, 0, sizeof bytes);
            bytes[0] = bytes[1 + size] = 7; /* bytes before and behind the range */
            if (size)
                bytes[1 + at] = 1;
            assert_int_equal(jox_mem_is(bytes + 1, 0, size), size == 0);
            jox_mem_fill(bytes + 1, 0, size);
            assert_true(jox_mem_is(bytes + 1, 0, size));
            for (size_t i = 0; i < size; i++)
                assert_int_equal(bytes[1 + i], 0);
            assert_int_equal(bytes[0], 7);
            assert_int_equal(bytes[1 + size], 7);
        }
}

static void fill_does_not_write_equal_bytes(void **state) {
    (void)state;
    void *page = mmap(NULL, PAGE, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(page != MAP_FAILED);
    jox_mem_fill(page, 0, PAGE); /* a write would end the program */
    assert_int_equal(munmap(page, PAGE), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(fill_sets_all_bytes),
                                       cmocka_unit_test(fill_does_not_write_equal_bytes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
