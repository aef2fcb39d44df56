/* Waiting areas: agents that gather in a place, the ground of the place, and the spots on it.
   Shared by gather_ground.c, steering/gather.c and steering/gather_move.c. */
#ifndef JOX_MACHINE_GATHER_H
#define JOX_MACHINE_GATHER_H

#include "geom/ground/lattice.h"
#include "machine/machine_parts.h"

/* One agent that gathers in a place. */
typedef struct JoxGathering {
    uint32_t agent, id;
    int32_t place;
    float front;   /* direction of the place's front, degrees */
    bool spreads;  /* over the whole place */
    uint32_t part; /* part of the ground; 0: the agent is still on its way to it */
    uint32_t turn;
    bool outside; /* outside the place */
    float across; /* m: position along the row, to the left as seen towards the front */
    bool has_spot;
    uint32_t row;
    JoxV2 spot; /* m */
    float way;  /* m: length of the way to the spot */
    JoxV2 next; /* m: next point of the way */
} JoxGathering;

enum { JOX_WHOLE_FLOOR = -1 }; /* in place of a place: the box of all walls and fixed bodies */

/* The ground in and around a place. Kept from step to step; depends on the model, the walls and
   fixed bodies alone. */
typedef struct JoxGatherGround {
    int32_t place;
    uint64_t from; /* hash of its inputs */
    bool checked;  /* up to date in this step */
    JoxStandable cells;
} JoxGatherGround;

/* The spots of one part of a place, filled towards one front. */
typedef struct JoxGatherPlace {
    int32_t place;
    float front; /* direction of the front, degrees */
    bool spreads;
    uint32_t part;
    uint64_t from; /* hash of the ground's inputs */
    uint32_t need; /* number of spots that were needed; 0: not laid yet */
    float least;   /* m: least spacing that was allowed */
    JoxV2 ahead;
    float spacing; /* m */
    JoxLattice spots;
} JoxGatherPlace;

/* gather_ground.c: returns the ground of a place, laid anew if walls or fixed bodies changed. The
   whole floor has no cells where there are neither. */
JoxGatherGround *jox_gather_ground(JoxMachineRun *run, int32_t place);
/* Returns the spots of a part for `need` agents: at a comfortable spacing if there is room for all
   of them, or over the whole part if they spread; else closer, but not below `least`, m. */
JoxGatherPlace *jox_gather_place(JoxMachineRun *run, const JoxGathering *entry, uint32_t need,
                                 float least);

/* steering/gather_move.c: finds the way of an agent to its spot. */
void jox_gather_find_way(const JoxMachineRun *run, JoxStandable *ground, JoxGathering *entry);
/* Swaps turns between agents that are hindered on their way and neighbours, where this shortens
   ways. */
void jox_gather_exchange(JoxMachineRun *run, JoxStandable *ground, JoxGathering *entries,
                         uint32_t count, float spacing);
/* Returns the point that an agent heads for: on the way to its spot, or near where it stands. */
JoxV2 jox_gather_point(const JoxMachineRun *run, const JoxGathering *entry, float spacing);
/* Returns the point that an agent heads for that still has to come to the place. */
JoxV2 jox_gather_approach(const JoxMachineRun *run, const JoxGathering *entry);

#endif
