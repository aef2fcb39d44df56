/* Forces that agents give each other within a stage ("transfers"): chunks of agents collect them in
   parallel; they are then sorted by receiver and summed in ascending id of the giver. The stages
   push and infer use the same memory in turn. */
#ifndef JOX_FORCE_TRANSFERS_H
#define JOX_FORCE_TRANSFERS_H

#include "base/vec.h"
#include "force/chunk_list.h"

struct JoxForces;

typedef struct JoxTransfer {
    uint32_t to, from_id;
    float x, y; /* N */
} JoxTransfer;

/* A transfer once it is sorted: its place tells the receiver. */
typedef struct JoxReceivedForce {
    uint32_t from_id;
    float x, y; /* N */
} JoxReceivedForce;

/* Zero-initialise; it owns its arrays. */
typedef struct JoxTransfers {
    JoxChunkList list;
    uint32_t *starts; /* per receiver, plus one: first of its transfers in `sorted` */
    JoxReceivedForce *sorted;
    size_t start_capacity, sorted_capacity;
} JoxTransfers;

/* Makes room for the transfers of a stage, until they are sorted. */
void jox_transfers_reserve(struct JoxForces *forces, JoxChunkMemory *memory);
/* Adds a force, N, that agent i of a chunk gives agent `to`. */
void jox_transfers_add(struct JoxForces *forces, uint32_t chunk, uint32_t i, uint32_t to,
                       JoxV2 force);
/* Sorts the transfers by receiver: those of agent i become sorted[starts[i]] to sorted[starts[i +
   1]]. Returns how many there are; with none nothing is written. */
uint32_t jox_transfers_sort(struct JoxForces *forces);
/* Adds each agent's transfers to two columns, in ascending id of the giver. */
void jox_transfers_sum(struct JoxForces *forces, float *x, float *y);
void jox_transfers_free(JoxTransfers *transfers);

#endif
