/* Lifts at work: the step calls jox_world_run_lifts before agents are sorted, which moves cars,
   opens and closes doors, admits agents that wait and carries those in a car from storey to storey.
   State is the cars and the agents that ride; a world without lifts has none. */
#ifndef JOX_WORLD_LIFTS_H
#define JOX_WORLD_LIFTS_H

#include "base/sections.h"
#include "machine/lifts.h"

typedef struct JoWorld JoWorld;

/* Figures of a lift; no step reads them. */
typedef struct JoxLiftFigures {
    uint64_t trips;      /* departures with people in the car */
    uint64_t full_trips; /* trips on which no room was left */
    uint64_t carried;    /* people who came in */
    uint64_t let_out;
    uint64_t left_behind; /* times that a person who waited found no room when the door closed */
    uint64_t turned_away; /* times that a person whose turn it was could not get in */
    uint64_t reopened;    /* times that the door opened again, as somebody stood in it */
    double filled;        /* sum over trips: share of the capacity */
    double ride_s;        /* sum over people let out: time in the car */
    double metres;        /* way of the car */
    double open_now;      /* s: for which the door has stood open, or last stood open */
    double open_most;     /* s: the longest of these */
    uint32_t queue_most;  /* most people who waited before its doors at a time */
    uint32_t queue_tick;  /* tick of that */
    float *waits;         /* s: of each person who came in, from the call to the way in */
    uint32_t wait_count;
    size_t wait_capacity;
} JoxLiftFigures;

typedef struct JoxLiftState {
    JoxLiftCar *cars; /* one for each lift */
    JoxRider *riders; /* by ascending id */
    uint32_t rider_count;
    size_t rider_capacity;
    JoxLiftFigures *figures; /* one for each lift */
} JoxLiftState;

/* A place before a door where people may wait: spots, the nearest to the door first. Scratch. */
enum { JOX_MOST_LOBBY_SPOTS = 64 };
typedef struct JoxLobby {
    JoxV2 spots[JOX_MOST_LOBBY_SPOTS]; /* m, positions */
    uint32_t count;
    bool laid;
    uint32_t walls_version; /* when it was laid */
} JoxLobby;
typedef struct JoxLiftScratch {
    JoxRider *next; /* the list of this step */
    size_t next_capacity;
    uint32_t *index; /* index of the agent of each rider */
    size_t index_capacity;
    JoxLobby *lobbies; /* by lift and stop: lift * stride + stop */
    uint32_t stride;
    JoxLiftView view;
} JoxLiftScratch;

/* Copies lifts and lays them out, before the first step and after storeys and places are set. Their
   walls are among the walls that are set. */
void jox_world_set_lifts(JoWorld *world, const JoxLift *lifts, uint32_t count);
/* Runs the lifts for a step. */
void jox_world_run_lifts(JoWorld *world);
/* Sets the mode of a lift; -1 for all lifts. */
void jox_world_set_lift_mode(JoWorld *world, int32_t lift, JoxLiftMode mode);
/* Returns how a lift's car is at present. */
JoxCarLook jox_world_car_look(const JoWorld *world, uint32_t lift);
/* Returns the index of a lift by its name, or -1. */
int32_t jox_world_find_lift(const JoWorld *world, const char *name);
/* Returns the number of agents that have called a lift and wait before a door. */
uint32_t jox_world_lift_waiting(const JoWorld *world, uint32_t lift);
/* People who cannot use stairs, whom no lift takes and no ramp leads to where they go. */
typedef struct JoxStranded {
    uint32_t in_refuge; /* they wait in a refuge, or go there */
    uint32_t nowhere;   /* there is no refuge on their storey */
    uint32_t on_stairs; /* they stand on a stair, put there by others */
} JoxStranded;
/* Counts them on a storey, of a stair that which is nearer in height; -1: on all. */
JoxStranded jox_world_count_stranded(const JoWorld *world, int32_t storey);
/* Lists the state; nothing in a world without lifts. */
void jox_lifts_sections(JoWorld *world, JoxSections *sections);
/* Lists the figures. */
void jox_lift_figures_sections(JoWorld *world, JoxSections *sections);
void jox_lifts_free(JoWorld *world);

#endif
