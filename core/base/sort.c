#include "base/sort.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"

enum { SHORT = 8 }; /* the most items that are sorted by insertion */

typedef struct Sort {
    size_t size;
    JoxCompare *compare;
    const void *context;
    char *spare;
} Sort;

static void sort_by_insertion(const Sort *s, char *items, size_t count) {
    for (size_t k = 1; k < count; k++) {
        char *item = items + k * s->size;
        size_t at = k;
        while (at > 0 && s->compare(items + (at - 1) * s->size, item, s->context) > 0)
            at--;
        if (at == k)
            continue;
        memcpy(s->spare, item, s->size);
        memmove(items + (at + 1) * s->size, items + at * s->size, (k - at) * s->size);
        memcpy(items + at * s->size, s->spare, s->size);
    }
}

/* Merges two sorted halves; copies the first one to the spare room before. */
static void merge_halves(const Sort *s, char *items, size_t first, size_t count) {
    const char *left = s->spare, *left_end = left + first * s->size;
    const char *right = items + first * s->size, *right_end = items + count * s->size;
    memcpy(s->spare, items, first * s->size);
    for (char *to = items; left < left_end; to += s->size) {
        bool from_left = right == right_end || s->compare(left, right, s->context) <= 0;
        memcpy(to, from_left ? left : right, s->size);
        *(from_left ? &left : &right) += s->size;
    }
}

static void sort_part(const Sort *s, char *items, size_t count) {
    const size_t first = count / 2;
    if (count <= SHORT) {
        sort_by_insertion(s, items, count);
        return;
    }
    sort_part(s, items, first);
    sort_part(s, items + first * s->size, count - first);
    const char *middle = items + first * s->size;
    if (s->compare(middle - s->size, middle, s->context) > 0)
        merge_halves(s, items, first, count);
}

void jox_sort(void *items, size_t count, size_t size, JoxCompare *compare, const void *context,
              void *spare) {
    JOX_ASSERT(items || count == 0);
    if (count < 2)
        return;
    Sort sort = {size, compare, context, spare};
    if (!spare)
        sort.spare = jox_alloc(JOX_SORT_SPARE(count), size);
    sort_part(&sort, items, count);
    if (!spare)
        jox_free(sort.spare);
}

static int compare_doubles(const void *a, const void *b, const void *context) {
    const double x = *(const double *)a, y = *(const double *)b;
    (void)context;
    if (isnan(x) || isnan(y))
        return (isnan(x) != 0) - (isnan(y) != 0);
    return (x > y) - (x < y);
}

void jox_sort_doubles(double *values, size_t count) {
    jox_sort(values, count, sizeof *values, compare_doubles, NULL, NULL);
}

static int compare_texts(const void *a, const void *b, const void *context) {
    (void)context;
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

void jox_sort_texts(const char **texts, size_t count) {
    jox_sort(texts, count, sizeof *texts, compare_texts, NULL, NULL);
}
