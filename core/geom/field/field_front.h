/* The front of the marching: cells that were reached and are not finished. They are finished in
   order of time, ties by cell, so that the order is unique. Only field_front.c and field_march.c
   include this. Reached cells wait unsorted until the front comes near; then all cells of the next
   stretch of time are sorted at once. The few that are reached within that stretch, or earlier than
   known when it was sorted, go to a heap beside it. */
#ifndef JOX_GEOM_FIELD_FRONT_H
#define JOX_GEOM_FIELD_FRONT_H

#include "base/number/bits.h"
#include "geom/field/field_parts.h"

enum { JOX_FRONT_GOAL = 8 }; /* in place of a number of a neighbour on the ring */

/* Everything that the marching reads of a cell's node, adjacent in memory. */
typedef struct JoxFrontNode {
    float at[2];            /* m */
    float slowness;         /* s/m */
    float time;             /* time of the quickest way so far, s */
    float length;           /* length of the quickest way, m, once the node is finished */
    float share;            /* position between ends[0] and ends[1], 0 to 1 */
    uint8_t links, corners; /* see JoxFieldWalled */
    uint8_t finished;       /* bits: linked neighbours on the ring that are finished */
    /* The quickest way so far leads to a point between these two neighbours on the ring, or
       straight to one if they are equal; or to the goal (JOX_FRONT_GOAL). */
    uint16_t ends;
    bool even; /* the nodes of this cell and its neighbours are at their cells' centres */
    bool reached, is_done; /* added to the front; finished */
    bool is_copied;        /* cells over a seam repeat this one */
    bool repeats;          /* repeats a cell over a seam, and is finished with it */
    bool has_stop;         /* the way in or out of a lift leads through it */
} JoxFrontNode;

typedef struct JoxFront {
    JoxFrontNode *nodes; /* by cell */
    float stretch;       /* s */
    int *waiting;        /* cells that wait, some finished meanwhile; room for all cells */
    size_t waiting_count;
    /* Sorted keys of the present stretch, which ends at time `end`; those from `at` on are still to
       come. */
    uint64_t *next;
    size_t at, next_count, next_room;
    float end; /* s */
    uint64_t *heap;
    size_t heap_count, heap_room;
    uint64_t *keys; /* scratch */
    uint32_t *bins;
    size_t keys_room, bins_room;
} JoxFront;

/* Returns a key that sorts by time, which is never negative, then by cell. */
static inline uint64_t jox_front_key(const JoxFront *front, int cell) {
    return (uint64_t)jox_float_bits(front->nodes[cell].time) << 32 | (uint32_t)cell;
}

/* Starts a front for `count` nodes, which it owns from then on. */
void jox_front_begin(JoxFront *front, JoxFrontNode *nodes, int count, float stretch);
void jox_front_end(JoxFront *front);
void jox_front_push(JoxFront *front, int cell);
/* Adds a cell whose node got a first or an earlier time. */
static inline void jox_front_reach(JoxFront *front, int cell) {
    JoxFrontNode *node = &front->nodes[cell];
    if (!node->reached)
        front->waiting[front->waiting_count++] = cell;
    node->reached = true;
    if (node->time < front->end)
        jox_front_push(front, cell);
}
/* Returns the next cell to finish, -1 if there is none. jox_front_take is the inline fast path. */
int jox_front_seek(JoxFront *front);
static inline int jox_front_take(JoxFront *front) {
    if (front->heap_count == 0 && front->at < front->next_count) {
        const uint64_t key = front->next[front->at];
        const int cell = (int)(uint32_t)key;
        if (jox_front_key(front, cell) == key) {
            front->at++;
            front->nodes[cell].is_done = true;
            return cell;
        }
    }
    return jox_front_seek(front);
}

#endif
