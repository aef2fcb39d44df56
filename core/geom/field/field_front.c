/* The front of a march: see field_front.h. */
#include "geom/field/field_front.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"

enum { MANY = 8 }; /* moves of a key that is inserted, on average */

static int cell_of(uint64_t key) {
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

static uint64_t pop(JoxFront *f) {
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

/* ---- stretches ---- */

/* Keys of all that wait and are not finished; returns the least time. */
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

/* Leaves the keys of the stretch; the others' cells go on waiting. */
static size_t part(JoxFront *f, size_t count) {
    const uint32_t end = jox_float_bits(f->end);
    uint64_t *keys = f->keys;
    int *waiting = f->waiting;
    size_t chosen = 0, left = 0;
    for (size_t k = 0; k < count; k++) {
        const uint64_t key = keys[k];
        const bool now = key >> 32 < end;
        waiting[left] = cell_of(key);
        keys[chosen] = key;
        left += !now;
        chosen += now;
    }
    f->waiting_count = left;
    return chosen;
}

static int by_key(const void *a, const void *b, const void *context) {
    (void)context;
    const uint64_t *one = a, *two = b;
    return (*one > *two) - (*one < *two);
}

/* Keys that are nearly in order. */
static void insert_each(uint64_t *keys, size_t count) {
    size_t moves = 0;
    for (size_t k = 1; k < count; k++) {
        const uint64_t key = keys[k];
        size_t at = k;
        for (; at > 0 && keys[at - 1] > key; at--)
            keys[at] = keys[at - 1];
        keys[at] = key;
        moves += k - at;
        if (moves > MANY * count) { /* they are not */
            jox_sort(keys, count, sizeof *keys, by_key, NULL, NULL);
            return;
        }
    }
}

/* Sorts `count` keys into `next`: by bins of time, of which most hold a few, then one by one. */
static void sort(JoxFront *f, size_t count, float least) {
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
    insert_each(f->next, count);
}

static bool advance(JoxFront *f) {
    size_t count;
    const float least = list_keys(f, &count);
    if (count == 0)
        return false;
    f->end = jox_maxf(least + f->stretch, nextafterf(least, INFINITY));
    const size_t chosen = part(f, count);
    JOX_ASSERT(chosen > 0);
    sort(f, chosen, least);
    f->at = 0;
    f->next_count = chosen;
    return true;
}

int jox_front_seek(JoxFront *f) {
    for (;;) {
        if (f->at == f->next_count && f->heap_count == 0 && !advance(f))
            return -1;
        const bool by_heap =
            f->heap_count > 0 && (f->at == f->next_count || f->heap[0] < f->next[f->at]);
        const uint64_t key = by_heap ? pop(f) : f->next[f->at++];
        const int cell = cell_of(key);
        if (jox_front_key(f, cell) != key)
            continue; /* it was reached sooner since, and stands in the heap too */
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
