/* Congestion by IMO MSC.1/Circ.1533, as its advanced method tells it from a simulation: a region in
   which the local density is above 4 per m2, and stays so for longer than 10 % of the time that
   everybody takes to leave. Local density is that of fields/density.h. A cell counts the time in
   all that it was above; cells above for long enough form a region with those that touch them.

   The time is that until nobody was there any more; while people are there, as in a run that has
   not ended, in one that was stopped, or in a periodic scene, the time measured so far. Of less
   than 10 s nothing is known. */
#ifndef JOX_RECORD_DANGER_CONGESTION_H
#define JOX_RECORD_DANGER_CONGESTION_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/format/json_writer.h"
#include "base/sections.h"
#include "base/vec.h"
#include "record/fields/density.h"

#define JOX_CONGESTION_DENSITY 4.0f /* 1/m2 */
#define JOX_CONGESTION_SHARE 0.1    /* of the time */
#define JOX_CONGESTION_LEAST 10.0   /* s: of people who are still there */
extern const char jox_congestion_source[];

typedef struct JoxCongestionCell {
    float seconds;     /* s: above, in all */
    float first, last; /* s: above since, and until */
    float most;        /* 1/m2 */
} JoxCongestionCell;

typedef struct JoxCongestion {
    JoxCongestionCell *cells;
    size_t count;
    double begun, last, emptied; /* s: first and last frame; since when nobody is there, or NAN */
} JoxCongestion;

typedef struct JoxCongestionRegion {
    JoxV2 at;           /* m: where it lasted longest */
    double seconds;     /* s: how long it did there, in all */
    double first, last; /* s: first and last time that any of its cells was above */
    double area;        /* m2 */
    double most;        /* 1/m2 */
    JoxV2 low, high;    /* m: the box about it */
} JoxCongestionRegion;

typedef struct JoxCongestionFound {
    double time;  /* s: that the share is of */
    bool cleared; /* it is the time until nobody was there; else the time measured so far */
    bool known;   /* it is long enough to tell */
    double longest, first; /* s: at any one place, significant or not; NAN where never */
    JoxV2 longest_at;
    JoxCongestionRegion *regions; /* significant; the longest first */
    uint32_t count;
} JoxCongestionFound;

JoxCongestion jox_congestion_create(const JoxDensity *grid);
/* Every frame: how many people are there. */
void jox_congestion_frame(JoxCongestion *congestion, uint32_t people, double time);
/* The grid's sample of now, `duration` after the one before. */
void jox_congestion_sample(JoxCongestion *congestion, const JoxDensity *grid, double time,
                           double duration);
/* Free with jox_congestion_found_free. */
JoxCongestionFound jox_congestion_find(const JoxCongestion *congestion, const JoxDensity *grid);
void jox_congestion_found_free(JoxCongestionFound *found);
/* Adds "congestion": {...}. */
void jox_congestion_json(const JoxCongestion *congestion, const JoxDensity *grid, JoxJson *json);
/* A table of the regions. */
void jox_congestion_csv(const JoxCongestion *congestion, const JoxDensity *grid, FILE *out);
void jox_congestion_sections(JoxCongestion *congestion, JoxSections *sections);
void jox_congestion_free(JoxCongestion *congestion);

#endif
