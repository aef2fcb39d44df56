/* The sort: order, stability, spare room. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "base/sort.h"

enum { MOST = 1000 };

typedef struct Item {
    uint32_t key, place;
} Item;

static int compare_sort_keys(const void *a, const void *b, const void *context) {
    const Item *x = a, *y = b;
    const int sign = *(const int *)context;
    return sign * ((x->key > y->key) - (x->key < y->key));
}

static void fill_sort_items(Item *items, uint32_t count, uint32_t form) {
    uint32_t random = 1;
    for (uint32_t i = 0; i < count; i++) {
        random = random * 1664525u + 1013904223u;
        const uint32_t keys[] = {random >> 28, i, count - i, 7, random >> 12};
        items[i] = (Item){keys[form], i};
    }
}

static void equal_items_keep_their_order(void **state) {
    (void)state;
    static Item items[MOST], spare[JOX_SORT_SPARE(MOST) + 1];
    for (uint32_t count = 0; count <= MOST; count += count < 40 ? 1 : 191)
        for (uint32_t form = 0; form < 5; form++)
            for (int sign = -1; sign <= 1; sign += 2) {
                fill_sort_items(items, count, form);
                spare[JOX_SORT_SPARE(count)] =
                    (Item){4711, 4712}; /* a guard behind the spare room */
                jox_sort(items, count, sizeof *items, compare_sort_keys, &sign,
                         form % 2 ? spare : NULL);
                for (uint32_t i = 1; i < count; i++) {
                    int order = compare_sort_keys(&items[i - 1], &items[i], &sign);
                    assert_true(order < 0 || (order == 0 && items[i - 1].place < items[i].place));
                }
                assert_int_equal(spare[JOX_SORT_SPARE(count)].place, 4712);
                uint64_t sum = 0; /* no item is lost or doubled */
                for (uint32_t i = 0; i < count; i++)
                    sum += (uint64_t)items[i].place * items[i].place;
                assert_true(count == 0 ||
                            sum == (uint64_t)(count - 1) * count * (2 * count - 1) / 6);
            }
}

static void spare_room_avoids_allocation(void **state) {
    (void)state;
    static Item items[MOST], spare[JOX_SORT_SPARE(MOST)];
    const int sign = 1;
    fill_sort_items(items, MOST, 4);
    uint64_t before = jox_alloc_count();
    jox_sort(items, MOST, sizeof *items, compare_sort_keys, &sign, spare);
    assert_true(jox_alloc_count() == before);
}

static void doubles_and_texts_are_sorted(void **state) {
    (void)state;
    double values[] = {NAN, 2, -INFINITY, NAN, 1, 0.5};
    const char *texts[] = {"b", "", "ab", "a"};
    jox_sort_doubles(values, 6);
    assert_true(values[0] < 0 && values[1] == 0.5 && values[2] == 1 && values[3] == 2);
    assert_true(isnan(values[4]) && isnan(values[5]));
    jox_sort_texts(texts, 4);
    assert_string_equal(texts[0], "");
    assert_string_equal(texts[1], "a");
    assert_string_equal(texts[2], "ab");
    assert_string_equal(texts[3], "b");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(equal_items_keep_their_order),
                                       cmocka_unit_test(spare_room_avoids_allocation),
                                       cmocka_unit_test(doubles_and_texts_are_sorted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
