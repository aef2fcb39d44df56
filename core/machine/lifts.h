/* Lifts as behaviours know them: the state of each car, and of each agent that rides or is about
   to. world/lifts.c keeps both from step to step; the steering term `ride` and the words `rode` and
   `in_use` read them. */
#ifndef JOX_MACHINE_LIFTS_H
#define JOX_MACHINE_LIFTS_H

#include <stdbool.h>
#include <stdint.h>

#include "agents/agents.h"
#include "geom/lifts.h"
#include "machine/machine.h"

typedef enum JoxLiftDoor {
    JOX_DOOR_SHUT,
    JOX_DOOR_OPENING,
    JOX_DOOR_OPEN,
    JOX_DOOR_CLOSING
} JoxLiftDoor;

/* State of a car. Sections hold no padding. */
typedef struct JoxLiftCar {
    double height;     /* m: elevation of its floor */
    double speed;      /* m/s, positive upwards */
    double left;       /* s until the door's present phase is over */
    double quiet;      /* s since an agent passed the open door */
    double idle;       /* s for which nobody has called it */
    uint32_t mode;     /* JoxLiftMode */
    uint32_t door;     /* JoxLiftDoor */
    uint32_t stop;     /* stop where it stands, or which it left: its riders' storey */
    int32_t target;    /* stop that it moves to; -1: it stands */
    int32_t direction; /* 1 up, -1 down, 0 none */
    uint32_t people;   /* in the car; counted while the door is not shut */
    float mass;        /* kg: of these */
    uint32_t refuses;  /* 1: nobody boards until the door shuts, as one found no room, or was too
                         heavy */
} JoxLiftCar;

/* Progress of an agent that rides. */
typedef enum JoxRidePhase {
    JOX_RIDE_APPROACH, /* on the way to the door */
    JOX_RIDE_WAIT,     /* before the door: it has called the lift */
    JOX_RIDE_BOARD,    /* it goes in */
    JOX_RIDE_INSIDE,   /* in the car */
    JOX_RIDE_ASIDE,    /* it stepped out to let others out, and keeps its room in the car */
    JOX_RIDE_LEAVE,    /* it goes out */
    JOX_RIDE_OVER      /* it is on a storey where it was let out, or that it rides to */
} JoxRidePhase;

/* An agent whose state steers by `ride`, or that takes a lift on its way. Sections hold no padding.
 */
typedef struct JoxRider {
    uint32_t id;  /* of the agent */
    int32_t goal; /* place, or set of places, that it rides to */
    uint32_t lift;
    uint32_t from, to; /* stops */
    uint32_t phase;    /* JoxRidePhase */
    uint32_t since;    /* tick: when it called */
    uint32_t boarded;  /* tick: when it came in */
    uint32_t carried;  /* 1: the car has departed with it */
    int32_t spot;      /* index of its spot before the door or in the car; -1: none */
    float x, y;        /* m: position that it goes to, unless it approaches */
    uint32_t stray;    /* 1: it got in without wanting to, and is let out; `goal` is -1 */
    uint32_t itself;   /* 1: it walks to `goal`, on another storey, and chose the lift by itself */
} JoxRider;

/* The parameter `lifts`: an agent takes lifts by itself above the first, cannot use stairs above
   the second. */
#define JOX_LIFTS_NEVER 0.25f
#define JOX_LIFTS_ONLY 0.75f

/* How an agent gets from storey to storey. */
typedef enum JoxAgentWays { JOX_WAYS_STAIRS, JOX_WAYS_EITHER, JOX_WAYS_STEPLESS } JoxAgentWays;
static inline JoxAgentWays jox_agent_ways(const JoxAgents *agents, uint32_t i) {
    const float lifts = jox_param(agents, JOX_PARAM_lifts, i);
    return lifts > JOX_LIFTS_ONLY    ? JOX_WAYS_STEPLESS
           : lifts > JOX_LIFTS_NEVER ? JOX_WAYS_EITHER
                                     : JOX_WAYS_STAIRS;
}

/* Lifts as the machines see them. */
typedef struct JoxLiftView {
    const JoxStoreys *storeys;
    const JoxLift *lifts;
    const JoxLiftCar *cars;
    uint32_t lift_count;
    const JoxRider *riders; /* by ascending id */
    uint32_t rider_count;
} JoxLiftView;

typedef struct JoxMachineRun JoxMachineRun;

/* Finds the lift and the stop that a place is the car's floor of; false if it is none. */
bool jox_lift_find_place(const JoxLiftView *view, int32_t place, uint32_t *lift, uint32_t *stop);
/* Returns the entry of an agent that rides, by its id; NULL if it is new or does not ride. */
const JoxRider *jox_rider_find(const JoxLiftView *view, uint32_t id);
/* Returns the stop of a lift where an agent at a position calls it: that on its storey, else that
   on the nearest one. */
uint32_t jox_lift_near_stop(const JoxLiftView *view, uint32_t lift, JoxV2 at);
/* Returns the place that an agent's state rides to, -1: its state does not ride. */
int32_t jox_machines_ride_goal(const JoxMachineRun *run, uint32_t agent);
/* Returns the place that an agent's state walks to (`field`, `seek`), -1: it walks to none. */
int32_t jox_machines_walk_goal(const JoxMachineRun *run, uint32_t agent);
/* Returns the place to which an agent walks that rides to `goal`, at the door of a lift; -1: it
   does not walk there by a field. */
int32_t jox_ride_approach(const JoxMachineRun *run, uint32_t agent, int32_t goal);
/* Returns the refuge nearest to a position on its storey, -1: there is none. */
int32_t jox_find_refuge(const JoxMachineRun *run, JoxV2 at);

/* Returns the lift in whose car an agent stands, -1: in none. */
int32_t jox_machines_car(const JoxMachineRun *run, uint32_t agent);
/* Returns the elevation of what an agent stands on, m: the floor, or that of a car. */
float jox_machines_height(const JoxMachineRun *run, uint32_t agent);
/* Returns how an agent uses a lift: JOX_RIDE_APPROACH, JOX_RIDE_WAIT also while it goes in,
   JOX_RIDE_INSIDE also while it goes out or stepped aside, JOX_RIDE_OVER if it uses none; and sets
   its entry, NULL without one. */
JoxRidePhase jox_machines_ride(const JoxMachineRun *run, uint32_t agent, const JoxRider **rider);

/* Functions for this folder alone. */
/* Returns the term by which agents in a state ride, or NULL. */
const JoxSteerTerm *jox_ride_term(const JoxState *state);
/* Return whether an agent's ride is over; whether it rides, in the car; whether the lift of a
   place, or one of a set, is in use. */
bool jox_has_ridden(const JoxMachineRun *run, uint32_t agent);
bool jox_is_riding(const JoxMachineRun *run, uint32_t agent);
bool jox_is_lift_in_use(const JoxMachineRun *run, int32_t place);

#endif
