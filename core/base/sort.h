/* The one sort: a merge sort, stable, in place but for spare room; O(n log n) whatever the order of
   the items, O(n) where they are in order already. */
#ifndef JOX_BASE_SORT_H
#define JOX_BASE_SORT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Below 0: `a` comes first; above 0: `b`; 0: they keep their order. */
typedef int JoxCompare(const void *a, const void *b, const void *context);

/* Items of a spare room that suffices for `count` of them. */
#define JOX_SORT_SPARE(count) ((count) / 2 + 1)

/* `spare`: room for JOX_SORT_SPARE(count) items; NULL: it is allocated here, which a step of the
   simulation may not do. */
void jox_sort(void *items, size_t count, size_t size, JoxCompare *compare, const void *context,
              void *spare);
/* Ascending; numbers that are no numbers last. */
void jox_sort_doubles(double *values, size_t count);
/* Ascending by bytes. */
void jox_sort_texts(const char **texts, size_t count);

#ifdef __cplusplus
}
#endif

#endif
