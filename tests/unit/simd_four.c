/* Tests of four floats at once: the greatest of many numbers, and records made of four columns. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "simd/four.h"

enum { MOST = 37 };

/* The greatest number is found at any index, in whole fours and after them; 0 if all are below
   0. */
static void greatest_is_found_at_any_index(void **state) {
    (void)state;
    float numbers[MOST];
    for (size_t count = 0; count <= MOST; count++)
        for (size_t at = 0; at < count; at++) {
            for (size_t i = 0; i < count; i++)
                numbers[i] = -(float)(i + 1);
            assert_true(jox_greatest(numbers, count) == 0.0f);
            numbers[at] = 0.25f;
            assert_true(jox_greatest(numbers, count) == 0.25f);
        }
}

/* Records get the words of the columns bit for bit, whatever they are as floats; nothing is written
   after the last record. */
static void columns_are_interleaved_bit_for_bit(void **state) {
    (void)state;
    uint32_t columns[4][MOST], records[MOST + 1][4];
    for (uint32_t c = 0; c < 4; c++)
        for (uint32_t i = 0; i < MOST; i++)
            columns[c][i] = 0x7f800001u + c * 0x01000000u + i; /* signalling NaNs too */
    for (size_t count = 0; count <= MOST; count++) {
        memset(records, 0xab, sizeof records);
        jox_interleave(records, columns[0], columns[1], columns[2], columns[3], count);
        for (size_t i = 0; i < count; i++)
            for (size_t c = 0; c < 4; c++)
                assert_int_equal(records[i][c], columns[c][i]);
        for (size_t c = 0; c < 4; c++)
            assert_int_equal(records[count][c], 0xababababu);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(greatest_is_found_at_any_index),
        cmocka_unit_test(columns_are_interleaved_bit_for_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
