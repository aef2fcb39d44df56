/* Congestion by IMO MSC.1/Circ.1533, advanced method: a region whose local density
   (fields/density.h) exceeds 4 per m2 for longer than 10 % of the time until everybody has left. A
   cell counts the total time during which it exceeds the density; adjacent cells above the share of
   time, diagonals included, form a region.

   While people are present, as in an unfinished or stopped run or a periodic scene, the time
   measured so far takes the place of the time until everybody has left. Below 10 s there is no
   result. danger.c owns and feeds it; reports list the regions. */
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
#define JOX_CONGESTION_SHARE 0.1    /* share of the time */
#define JOX_CONGESTION_LEAST 10.0   /* s: shortest time with a result while people are present */
extern const char jox_congestion_source[];

typedef struct JoxCongestionCell {
    float seconds;     /* s: total time above the density */
    float first, last; /* s: times of the first and last sample above the density */
    float most;        /* 1/m2: greatest density */
} JoxCongestionCell;

typedef struct JoxCongestion {
    JoxCongestionCell *cells;
    size_t count;
    /* s: times of the first frame, the last frame, and since when the floor is empty; NAN: not
       empty */
    double begun, last, emptied;
} JoxCongestion;

typedef struct JoxCongestionRegion {
    JoxV2 at;           /* m: centre of the cell that was above longest */
    double seconds;     /* s: total time of that cell */
    double first, last; /* s: first and last time of any of its cells */
    double area;        /* m2 */
    double most;        /* 1/m2: greatest density */
    JoxV2 low, high;    /* m: bounding box */
} JoxCongestionRegion;

typedef struct JoxCongestionFound {
    double time;  /* s: time that the share refers to */
    bool cleared; /* `time` lasts until everybody had left; else it is the time measured so far */
    bool known;   /* `time` is long enough for a result */
    /* s: longest total time of any cell and first time of any cell, in regions or not; `first`
       is NAN if there was none */
    double longest, first;
    JoxV2 longest_at;
    JoxCongestionRegion *regions; /* congested regions, in descending order of `seconds` */
    uint32_t count;
} JoxCongestionFound;

JoxCongestion jox_congestion_create(const JoxDensity *grid);
/* Counts the people in a frame at a time, s. Call it in every frame. */
void jox_congestion_frame(JoxCongestion *congestion, uint32_t people, double time);
/* Adds the current sample of the grid, taken `duration` seconds after the last. */
void jox_congestion_sample(JoxCongestion *congestion, const JoxDensity *grid, double time,
                           double duration);
/* Finds the regions. Free the result by jox_congestion_found_free. */
JoxCongestionFound jox_congestion_find(const JoxCongestion *congestion, const JoxDensity *grid);
void jox_congestion_found_free(JoxCongestionFound *found);
/* Writes "congestion": {...}. */
void jox_congestion_json(const JoxCongestion *congestion, const JoxDensity *grid, JoxJson *json);
/* Writes a table of the regions. */
void jox_congestion_csv(const JoxCongestion *congestion, const JoxDensity *grid, FILE *out);
void jox_congestion_sections(JoxCongestion *congestion, JoxSections *sections);
void jox_congestion_free(JoxCongestion *congestion);

#endif
