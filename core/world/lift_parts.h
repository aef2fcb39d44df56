/* Declarations shared by lifts.c, lift_list.c, lift_riders.c and lift_cars.c, and by nothing else.
 */
#ifndef JOX_WORLD_LIFT_PARTS_H
#define JOX_WORLD_LIFT_PARTS_H

#include "world/world.h"

/* A lift in a step. */
typedef struct JoxLiftTurn {
    JoWorld *world;
    uint32_t number;
    const JoxLift *lift;
    JoxLiftCar *car;
    JoxLiftFigures *figures;
    bool blocked; /* somebody stands in the doorway */
} JoxLiftTurn;

/* lift_list.c: brings the list of agents that ride up to date. */
void jox_lifts_list_riders(JoWorld *world);
/* lift_riders.c: counts who is in a car and in its doorway, while the door is not shut. */
void jox_lift_count_people(JoxLiftTurn *turn);
/* Sets the phases of the riders of a lift by where they are, and admits those who wait. */
void jox_lift_update_riders(JoxLiftTurn *turn);
/* Writes the positions that riders of a lift go to. */
void jox_lift_place_riders(JoxLiftTurn *turn);
/* Moves all agents in a car from the storey of one stop to that of another. */
void jox_lift_shift_people(JoxLiftTurn *turn, uint32_t from, uint32_t to);

/* lift_cars.c: runs doors and motion of a car for one step. */
void jox_lift_run_car(JoxLiftTurn *turn);

#endif
