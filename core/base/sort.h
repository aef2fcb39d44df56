/* The engine's one sort: a stable merge sort with spare room for half the items; O(n log n) for any
   order of the items, O(n) if they are sorted. */
#ifndef JOX_BASE_SORT_H
#define JOX_BASE_SORT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns a number below 0 if `a` comes first, above 0 if `b` does, 0 if they keep their order. */
typedef int JoxCompare(const void *a, const void *b, const void *context);

/* Number of items that the spare room needs for sorting `count` items. */
#define JOX_SORT_SPARE(count) ((count) / 2 + 1)

/* Sorts `count` items of `size` bytes. `spare`: room for JOX_SORT_SPARE(count) items; NULL: it is
   allocated, which is not allowed within a step. */
void jox_sort(void *items, size_t count, size_t size, JoxCompare *compare, const void *context,
              void *spare);
/* Sorts numbers in ascending order, NAN last. */
void jox_sort_doubles(double *values, size_t count);
/* Sorts texts by bytes (strcmp). */
void jox_sort_texts(const char **texts, size_t count);

#ifdef __cplusplus
}
#endif

#endif
