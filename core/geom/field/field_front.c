/* The front of the marching; see field_front.h. */
#include "geom/field/field_front.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"

enum { MANY = 8 }; /* greatest mean number of moves per inserted key */

static int get_cell_of_key(uint64_t key) {
    return (int)(uint32_t)key;
}

/* ---- the heap ---- */

void jox_front_push(JoxFront *f, int cell) {
    const uint64_t key = jox_front_key(f, cell);
    JOX_RESERVE(f->heap, f->heap_room, f->heap_count + 1);
    size_t at = f->heap_count++;
    for (; at > 0 && key < f->heap[(at - 1) / 2]; at = (at - 1) / 2)
        f->heap[at] = f->heap[(at - 1) / 2];
    f->heap[at] = key;
}

static uint64_t pop_key(JoxFront *f) {
    const uint64_t top = f->heap[0], last = f->heap[--f->heap_count];
    size_t at = 0;
    for (;;) {
        size_t child = 2 * at + 1;
        if (child >= f->heap_count)
            break;
        child += child + 1 < f->heap_count && f->heap[child + 1] < f->heap[child];
        if (last < f->heap[child])
            break;
        f->heap[at] = f->heap[child];
        at = child;
    }
    f->heap[at] = last;
    return top;
}

/* ---- the sorted stretch of time ---- */

/* Lists the keys of waiting cells that are not finished; returns their least time. */
static float list_keys(JoxFront *f, size_t *count) {
    float least = INFINITY;
    size_t listed = 0;
    JOX_RESERVE(f->keys, f->keys_room, f->waiting_count);
    uint64_t *keys = f->keys;
    for (size_t k = 0; k < f->waiting_count; k++) {
        const int cell = f->waiting[k];
        if (f->nodes[cell].is_done)
            continue;
        keys[listed++] = jox_front_key(f, cell);
        least = jox_minf(least, f->nodes[cell].time);
    }
    *count = listed;
    return least;
}

/* Splits the keys: those of the next stretch remain listed, the other cells go on waiting. */
static size_t split_keys(JoxFront *f, size_t count) {
    const uint32_t end = jox_float_bits(f->end);
    uint64_t *keys = f->keys;
    int *waiting = f->waiting;
    size_t chosen = 0, left = 0;
    for (size_t k = 0; k < count; k++) {
        const uint64_t key = keys[k];
        const bool now = key >> 32 < end;
        waiting[left] = get_cell_of_key(key);
        keys[chosen] = key;
        left += !now;
        chosen += now;
    }
    f->waiting_count = left;
    return chosen;
}

static int compare_front_keys(const void *a, const void *b, const void *context) {
    (void)context;
    const uint64_t *one = a, *two = b;
    return (*one > *two) - (*one < *two);
}

/* Sorts keys that are nearly in order, by insertion. */
static void insert_keys(uint64_t *keys, size_t count) {
    size_t moves = 0;
    for (size_t k = 1; k < count; k++) {
        const uint64_t key = keys[k];
        size_t at = k;
        for (; at > 0 && keys[at - 1] > key; at--)
            keys[at] = keys[at - 1];
        keys[at] = key;
        moves += k - at;
        if (moves > MANY * count) { /* they are not */
            jox_sort(keys, count, sizeof *keys, compare_front_keys, NULL, NULL);
            return;
        }
    }
}

/* Sorts `count` keys into `next`: into bins of time, most of which hold few keys, then by
   insertion. */
static void sort_stretch(JoxFront *f, size_t count, float least) {
    const uint64_t low = (uint64_t)jox_float_bits(least) << 32;
    const uint64_t high = (uint64_t)jox_float_bits(f->end) << 32;
    unsigned shift = 32;
    while ((high - low) >> shift > count)
        shift++;
    const size_t bin_count = (size_t)((high - low) >> shift) + 1;
    JOX_RESERVE(f->next, f->next_room, count);
    JOX_RESERVE(f->bins, f->bins_room, bin_count);
    uint32_t *bins = f->bins, first = 0;
    memset(bins, 0, bin_count * sizeof *bins);
    for (size_t k = 0; k < count; k++)
        bins[(f->keys[k] - low) >> shift]++;
    for (size_t b = 0; b < bin_count; b++) {
        const uint32_t has = bins[b];
        bins[b] = first;
        first += has;
    }
    for (size_t k = 0; k < count; k++)
        f->next[bins[(f->keys[k] - low) >> shift]++] = f->keys[k];
    insert_keys(f->next, count);
}

static bool advance_stretch(JoxFront *f) {
    size_t count;
    const float least = list_keys(f, &count);
    if (count == 0)
        return false;
    f->end = jox_maxf(least + f->stretch, nextafterf(least, INFINITY));
    const size_t chosen = split_keys(f, count);
    JOX_ASSERT(chosen > 0);
    sort_stretch(f, chosen, least);
    f->at = 0;
    f->next_count = chosen;
    return true;
}

int jox_front_seek(JoxFront *f) {
    for (;;) {
        if (f->at == f->next_count && f->heap_count == 0 && !advance_stretch(f))
            return -1;
        const bool by_heap =
            f->heap_count > 0 && (f->at == f->next_count || f->heap[0] < f->next[f->at]);
        const uint64_t key = by_heap ? pop_key(f) : f->next[f->at++];
        const int cell = get_cell_of_key(key);
        if (jox_front_key(f, cell) != key)
            continue; /* outdated: the cell was reached earlier since, with a new key in the heap */
        JOX_ASSERT(!f->nodes[cell].is_done);
        f->nodes[cell].is_done = true;
        return cell;
    }
}

void jox_front_begin(JoxFront *f, JoxFrontNode *nodes, int count, float stretch) {
    *f = (JoxFront){.nodes = nodes, .stretch = stretch};
    f->waiting = jox_realloc(NULL, (size_t)count, sizeof *f->waiting);
}

void jox_front_end(JoxFront *f) {
    jox_free(f->nodes);
    jox_free(f->waiting);
    jox_free(f->next);
    jox_free(f->heap);
    jox_free(f->keys);
    jox_free(f->bins);
}
