/* Declarations shared by lifts.c, lift_list.c, lift_ways.c, lift_riders.c, lift_spots.c and
   lift_cars.c, and by nothing else. */
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
    bool blocked;     /* somebody stands in the doorway */
    uint32_t others;  /* people in the car who are no riders of this lift; and their mass, kg; */
    float other_mass; /* both are counted while the door is not shut */
} JoxLiftTurn;

#define JOX_LIFT_LOYAL 8.0 /* s: that another lift than the chosen one has to save */

/* lift_ways.c: returns the time that a lift may take an agent from a stop to another, waiting and
   riding, s. */
double jox_lift_estimate_ride(const JoWorld *world, uint32_t lift, uint32_t from, uint32_t stop,
                              const JoxRider *rider);
/* Finds the lift that comes first on an agent's way to the place `rider->goal`, and its stops, if a
   way by lifts takes less time than walking; false: none does. `has`: the rider has a lift. Only
   writes `lift`, `from` and `to`. */
bool jox_lift_find_on_way(const JoWorld *world, uint32_t agent, const JoxRider *rider, bool has,
                          JoxRider *found);

/* Chooses the stop at which an agent in the car of `rider->lift` gets out on its way to the place
   `rider->goal`, and writes `to`; false: none leads there, as far as is known. */
bool jox_lift_choose_stop(const JoWorld *world, uint32_t agent, JoxRider *rider);

/* lift_list.c: brings the list of agents that ride up to date. */
void jox_lifts_list_riders(JoWorld *world);
/* lift_riders.c: counts who is in a car and in its doorway, while the door is not shut. */
void jox_lift_count_people(JoxLiftTurn *turn);
/* Sets the phases of the riders of a lift by where they are, and admits those who wait. */
void jox_lift_update_riders(JoxLiftTurn *turn);
/* Returns whether an agent is no heavier than a lift's load, and passes its doors at two stops: who
   does not can never ride, and must not keep others from it. */
bool jox_lift_suits(const JoWorld *world, uint32_t agent, const JoxLift *lift, uint32_t from,
                    uint32_t to);
/* Makes a rider, in the car or on its way in, wait at the car's stop for the next one. */
void jox_lift_turn_away(JoxLiftTurn *turn, JoxRider *rider);
/* Makes a rider step out if more people, or a greater mass, are in the car than it takes; false if
   they are not. */
bool jox_lift_shed_load(JoxLiftTurn *turn);
/* Moves all agents in a car from the storey of one stop to that of another. */
void jox_lift_shift_people(JoxLiftTurn *turn, uint32_t from, uint32_t to);

/* lift_spots.c: returns an agent's point of the plan. */
JoxV2 jox_lift_plan_of(const JoWorld *world, uint32_t agent);
/* Returns whether an agent stands in the car. */
bool jox_lift_holds(const JoxLiftTurn *turn, uint32_t agent);
/* Returns how far beside the middle of a door (x), and before it (y), a point of the plan is, m. */
JoxV2 jox_lift_before_door(const JoxLiftStop *stop, JoxV2 plan);
/* Returns the point of the plan that is so far beside the middle of a door, and before it, m. */
JoxV2 jox_lift_point_at_door(const JoxLiftStop *stop, float beside, float before);
/* Gives a rider that waits a spot before the door; -1: none is free. */
void jox_lift_take_lobby_spot(JoxLiftTurn *turn, JoxRider *rider);
/* Gives riders in the car spots, such that none has to pass others. */
void jox_lift_arrange_inside(JoxLiftTurn *turn);
/* Writes the positions that riders of a lift go to. */
void jox_lift_place_riders(JoxLiftTurn *turn);

/* lift_cars.c: runs doors and motion of a car for one step. */
void jox_lift_run_car(JoxLiftTurn *turn);

#endif
