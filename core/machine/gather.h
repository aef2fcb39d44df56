/* Shared by gather_ground.c, steering/gather.c and steering/gather_move.c: agents that wait in
   areas, the ground of these areas, and the spots on it. */
#ifndef JOX_MACHINE_GATHER_H
#define JOX_MACHINE_GATHER_H

#include "geom/ground/lattice.h"
#include "machine/internal.h"

/* One agent that gathers. */
typedef struct JoxGathering {
    uint32_t agent, id;
    int32_t place;
    float front;   /* deg */
    uint32_t part; /* part of the ground; 0: the agent still has to come */
    uint32_t turn;
    bool outside; /* true: not in the place */
    float across; /* m: coordinate to the left of the direction to the front */
    bool has_spot;
    uint32_t row;
    JoxV2 spot; /* m */
    float way;  /* m: to walk to the spot */
    JoxV2 next; /* m: where the way leads first */
} JoxGathering;

/* The ground in and about a place. Kept from step to step; depends on the model, the walls and the
   fixed bodies alone. */
typedef struct JoxGatherGround {
    int32_t place;
    uint64_t from; /* hash of its inputs */
    bool checked;  /* in this step */
    JoxStandable cells;
} JoxGatherGround;

/* The spots of one part of a place, filled towards one front. */
typedef struct JoxGatherPlace {
    int32_t place;
    float front; /* deg */
    uint32_t part;
    uint64_t from; /* as of the ground */
    uint32_t need; /* spots asked for when they were laid; 0: not laid yet */
    float least;   /* m: spacing, as asked for then */
    JoxV2 ahead;
    float spacing; /* m */
    JoxLattice spots;
} JoxGatherPlace;

/* gather_ground.c: the ground of a place, laid anew where walls or fixed bodies changed. */
JoxGatherGround *jox_gather_ground(JoxMachineRun *run, int32_t place);
/* The spots of a part for `need` agents: as far apart as is comfortable where there is room for all
   of them, else closer, but `least` m at least. */
JoxGatherPlace *jox_gather_place(JoxMachineRun *run, const JoxGathering *entry, uint32_t need,
                                 float least);

/* steering/gather_move.c: finds the way of an agent to its spot. */
void jox_gather_find_way(const JoxMachineRun *run, JoxStandable *ground, JoxGathering *entry);
/* Swaps the turns of agents that are hindered with those of neighbours, where this shortens ways.
 */
void jox_gather_exchange(JoxMachineRun *run, JoxStandable *ground, JoxGathering *entries,
                         uint32_t count, float spacing);
/* Returns the point that an agent heads for: on the way to its spot, or near where it stands. */
JoxV2 jox_gather_point(const JoxMachineRun *run, const JoxGathering *entry, float spacing);
/* Returns the point that an agent heads for that still has to come to the place. */
JoxV2 jox_gather_approach(const JoxMachineRun *run, const JoxGathering *entry);

#endif
