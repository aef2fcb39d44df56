/* Rides in lifts as ways of a field: who goes into a car on one storey comes out of it on another.
   Only field_march.c and field_lifts.c include this. */
#ifndef JOX_GEOM_FIELD_LIFTS_H
#define JOX_GEOM_FIELD_LIFTS_H

#include "geom/field/field_parts.h"

/* A stop of a lift that may be used, and the cell in its car, behind the door. */
typedef struct JoxFieldStop {
    int cell;
    uint32_t lift, stop;
    uint16_t label; /* as in first_stops */
} JoxFieldStop;
typedef struct JoxFieldStops {
    JoxFieldStop *items; /* lift by lift */
    uint32_t count;
} JoxFieldStops;

/* A ride to the stop in cell `from`, from where the way on is known, from the one in cell `to`. */
typedef struct JoxFieldRide {
    int from, to;
    uint16_t label;       /* of the stop where people get in */
    JoxV2 in;             /* unit vector of the way into the car */
    float length;         /* m: what people walk in its time */
    uint32_t next, other; /* where the search goes on */
} JoxFieldRide;

/* Lists the stops that people as broad as the clearance get to; none of a field without lifts. The
   caller frees the items. */
JoxFieldStops jox_field_list_stops(const JoxFieldWork *work);
/* Finds the next ride; false if there is none. Begin with only `from` set. */
bool jox_field_next_ride(const JoxFieldWork *work, const JoxFieldStops *stops, JoxFieldRide *ride);

#endif
