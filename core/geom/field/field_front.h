/* The front of a march: the cells that were reached and are not finished, each finished in the
   order of its time; of equal times the lesser cell first, so that there is one order. For
   field_front.c and field_march.c alone.
   Reached cells wait in no order until the front comes near them: all that the next stretch of time
   holds are sorted at once. The few that are reached within the stretch, or sooner than was known
   when it was sorted, stand in a heap beside it. */
#ifndef JOX_GEOM_FIELD_FRONT_H
#define JOX_GEOM_FIELD_FRONT_H

#include "base/number/bits.h"
#include "geom/field/field_parts.h"

enum { JOX_FRONT_GOAL = 8 }; /* instead of a neighbour on the ring */

/* What a march knows of a cell's node, side by side in memory. */
typedef struct JoxFrontNode {
    float at[2];            /* m */
    float slowness;         /* s/m */
    float time;             /* of the soonest way so far, s */
    float length;           /* of the soonest way, once it is finished, m */
    float share;            /* of the way from ends[0] to ends[1] */
    uint8_t links, corners; /* as of JoxFieldWalled */
    uint8_t finished;       /* bits: neighbours on the ring that are linked to it and finished */
    /* The soonest way so far leads to a point between these neighbours on the ring, or straight to
       one that is both; or to the goal. */
    uint16_t ends;
    bool even; /* its node and all of its neighbours' are in the middles of their cells */
    bool reached, is_done; /* put to the front; finished */
} JoxFrontNode;

typedef struct JoxFront {
    JoxFrontNode *nodes; /* of each cell */
    float stretch;       /* s */
    int *waiting;        /* cells, and such as were finished meanwhile; room for all */
    size_t waiting_count;
    /* Keys of the stretch, which ends at `end`, in order; from `at` on they are still to come. */
    uint64_t *next;
    size_t at, next_count, next_room;
    float end; /* s */
    uint64_t *heap;
    size_t heap_count, heap_room;
    uint64_t *keys; /* scratch */
    uint32_t *bins;
    size_t keys_room, bins_room;
} JoxFront;

/* Time, which is not negative, and cell, in order. */
static inline uint64_t jox_front_key(const JoxFront *front, int cell) {
    return (uint64_t)jox_float_bits(front->nodes[cell].time) << 32 | (uint32_t)cell;
}

/* For as many cells as there are nodes, which are the front's from then on. */
void jox_front_begin(JoxFront *front, JoxFrontNode *nodes, int count, float stretch);
void jox_front_end(JoxFront *front);
void jox_front_push(JoxFront *front, int cell);
/* Puts a cell to the front whose node was given a time, or a lesser one. */
static inline void jox_front_reach(JoxFront *front, int cell) {
    JoxFrontNode *node = &front->nodes[cell];
    if (!node->reached)
        front->waiting[front->waiting_count++] = cell;
    node->reached = true;
    if (node->time < front->end)
        jox_front_push(front, cell);
}
/* The next cell to be finished; -1 once there is none. */
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
