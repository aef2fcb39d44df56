/* Four floats at once: of columns, the greatest number, and records made of four of them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "simd/four.h"

enum { MOST = 37 };

/* Wherever it stands, in whole fours and behind them; all below 0: 0. */
static void the_greatest_is_found(void **state) {
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

/* A record has its word of each column, to the bit, whatever that says as a float; what stands
   behind the last stays. */
static void columns_become_records(void **state) {
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
        cmocka_unit_test(the_greatest_is_found),
        cmocka_unit_test(columns_become_records),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
