/* Lifts: shafts that pass several storeys, with a door on each storey that they serve and one car.
   The car's floor is the shaft's area on the storey where the car stands, so a lift needs no sheet
   of its own. scene reads lifts, world runs them, machine asks about them. Points are in plan. */
#ifndef JOX_GEOM_LIFTS_H
#define JOX_GEOM_LIFTS_H

#include "geom/storeys.h"

enum { JOX_MOST_LIFTS = 100, JOX_MOST_CAPACITY = 200 };
/* Room for the spots in a car of this capacity. */
#define JOX_CAR_SPOTS(capacity) (4 * (capacity) + 64)
#define JOX_LIFT_PACE 1.3f /* m/s: at which people walk, where ways by lifts are compared */

/* The use of a lift. */
typedef enum JoxLiftMode {
    JOX_LIFT_IN_USE,     /* serves calls in the direction of travel */
    JOX_LIFT_OUT_OF_USE, /* lets riders out at the next storey, and stands */
    JOX_LIFT_FIREMEN     /* fetches people storey by storey, and takes them to its home storey */
} JoxLiftMode;

/* A storey that a lift serves. */
typedef struct JoxLiftStop {
    uint32_t storey;
    JoxV2 door[2]; /* m: ends of the door, on the outline of the shaft */
    int32_t place; /* index of the place that is the car's floor on this storey */
    char *name;    /* name of that place, and of the gate that is the door */
    /* Laid out: */
    JoxV2 middle, out; /* m: middle of the door; unit vector out of the car */
    float half;        /* m: half of the door's width */
    float height;      /* m: elevation of the storey */
} JoxLiftStop;

typedef struct JoxLift {
    char *name;
    JoxV2 *outline; /* m: the shaft, counter-clockwise */
    uint32_t point_count;
    JoxLiftStop *stops; /* from the lowest storey up */
    uint32_t stop_count;
    uint32_t capacity;         /* people */
    float load;                /* kg: greatest mass of the people in it */
    float speed, acceleration; /* m/s, m/s2 */
    float opening, closing;    /* s: times of the door */
    float dwell;               /* s: for which the door stays open at least */
    uint32_t home;             /* stop where the car stands at first, and the one that firemen take
                                  people to */
    bool returns;              /* an idle car goes home */
    uint32_t mode;             /* JoxLiftMode at the start */
    int32_t first;             /* stop that firemen fetch first; -1: the highest */
    /* Laid out: */
    JoxV2 low, high; /* m: corners of the bounding box of the outline */
    JoxV2 *spots;    /* m: where riders stand, the farthest from the first stop's door first */
    uint32_t spot_count;
} JoxLift;

/* A car at one moment, of a run or a recording. */
typedef struct JoxCarLook {
    float height;    /* m: elevation of its floor */
    float open;      /* share of the door's width that is open, 0 to 1 */
    uint32_t stop;   /* stop on whose storey its riders are: where it stands, or which it left */
    uint32_t people; /* in the car */
    uint32_t mode;   /* JoxLiftMode */
} JoxCarLook;

/* Names of modes in scenes and messages, by JoxLiftMode: "in_use", ... */
extern const char *const jox_lift_mode_names[];
enum { JOX_LIFT_MODES = 3 };

/* Lays a lift out for storeys that are laid out: doors, heights and spots, at least as many as the
   capacity. Call it once all members above "Laid out" are set. */
void jox_lift_lay_out(JoxLift *lift, const JoxStoreys *storeys);
/* Appends the walls of a lift, laid out or not: the shaft's on each storey from the lowest to the
   highest stop, and a closed gate for each door. */
void jox_lift_add_walls(const JoxLift *lift, const JoxStoreys *storeys, JoxWalls *walls);
/* Returns whether a point of the plan is in the shaft. */
bool jox_lift_contains(const JoxLift *lift, JoxV2 plan);
/* Returns the point of the plan so far before the middle of a stop's door, m; of a lift that is
   laid out or not. */
JoxV2 jox_lift_point_outside(const JoxLift *lift, uint32_t stop, float metres);
/* Returns the position before a lift's door at a stop where an agent has left the car. */
JoxV2 jox_lift_outside(const JoxLift *lift, uint32_t stop, const JoxStoreys *storeys);
/* Returns the time for a way from standing to standing, s. */
double jox_lift_travel_time(const JoxLift *lift, double metres);
/* Returns the time that people need from before the door at one stop until they are out at another,
   s, if nobody else rides: with the wait for a car that comes from half the height. */
double jox_lift_usual_time(const JoxLift *lift, uint32_t from, uint32_t to);
/* Returns the stop at a storey, or -1. */
int32_t jox_lift_stop_at(const JoxLift *lift, uint32_t storey);
/* Returns the name of a stop, "LIFT.STOREY", which the caller frees. */
char *jox_lift_stop_name(const char *lift, const char *storey);
/* Copies a lift that is not laid out into memory of its own; frees one. */
void jox_lift_copy(JoxLift *to, const JoxLift *from);
void jox_lift_free(JoxLift *lift);

#endif
