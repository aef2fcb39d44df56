/* Members of JoxDanger and constants that danger.c and danger_limits.c share, and report/ for its
   tables. */
#ifndef JOX_RECORD_DANGER_PARTS_H
#define JOX_RECORD_DANGER_PARTS_H

#include "record/danger/areas.h"
#include "record/danger/congestion.h"
#include "record/danger/danger.h"
#include "record/danger/leaving.h"
#include "record/danger/line_counts.h"
#include "record/danger/stair_counts.h"
#include "record/danger/wall_loads.h"
#include "record/fields/voronoi_people.h"
#include "record/local_samples.h"

enum {
    JOX_DANGER_EXITS = JOX_LEAVING_EXITS, /* exits with a column of their own over time */
    /* measures of each person that change in every frame */
    JOX_DANGER_FIRST_BORNE = JOX_DANGER_COMPRESSION,
    JOX_DANGER_LAST_BORNE = JOX_DANGER_DOSE
};
/* N: loads at which death is estimated after 300 s and after 15 s. */
#define JOX_DOSE_LOW 1112.0
#define JOX_DOSE_HIGH 6227.0
/* Returns the dose that a load, N, adds per second, 1/s. */
double jox_danger_dose_rate(double load);

typedef struct JoxDangerPerson {
    float compression, load; /* N/m, N: exponential means over 1 s */
    double dose;
    double seconds[JOX_DANGER_LIMITS]; /* s over each limit */
    float most;                        /* N: greatest load */
    double most_time;
    JoxV2 most_at;
    uint16_t over; /* bit l: limit l was reached at any time */
} JoxDangerPerson;

/* Row of danger.csv: a sample, with the maxima until the next. */
typedef struct JoxDangerRow {
    double time; /* s */
    uint32_t people;
    float most[JOX_DANGER_MEASURES];        /* greatest of each measure; NAN: not read */
    uint32_t over[JOX_DANGER_LIMITS];       /* people over each limit */
    uint32_t levels[JOX_LEVELS];            /* number of people at each level of service */
    float wall_most;                        /* N: greatest load of any wall piece; NAN: unknown */
    uint32_t left, exits[JOX_DANGER_EXITS]; /* people who left so far, in all and by exit */
} JoxDangerRow;

struct JoxDanger {
    JoxLocal *local; /* local density and pressure */
    bool owns_local;
    /* Map, by cell: sum and greatest. The sum is over samples, for pressure over those that
       measured it, and for compression and load over people and samples. */
    double *sum[JOX_DANGER_MAPPED];
    float *greatest[JOX_DANGER_MAPPED];
    uint32_t *measured; /* by cell: samples that measured pressure */
    uint32_t *stood;    /* by cell: people whose compression and load were added */
    uint32_t samples;

    JoxDangerPerson *people; /* by key */
    uint32_t people_capacity;
    /* by key: 0 for people without compression, load and dose; derived from `people` */
    uint8_t *has_load_left;
    uint32_t has_load_capacity;
    uint32_t *loaded; /* indices of the people in the frame for whom it is 1 */
    uint32_t loaded_count, loaded_capacity;
    double least[JOX_DANGER_MEASURES]; /* lowest limit of each measure; INFINITY: no limit */
    bool has_compression, has_load;    /* a frame had these columns */

    JoxCongestion congestion;
    JoxDangerLines lines;
    JoxDangerAreas areas;
    JoxLeaving leaving;
    JoxDangerWalls walls;
    JoxDangerStairs stairs;
    double level_s[JOX_LEVELS]; /* person-seconds at each level of service */
    /* Density of each person at the last sample: Gaussian (NAN outside the area) and Voronoi (NAN
       where it was not measured). */
    float *gaussian_density, *voronoi_density;
    uint32_t gaussian_capacity, voronoi_capacity;
    JoxVoronoiPeople voronoi;

    /* s: times of the first sample, the last frame and the last sample */
    double begun, last_frame, last_sample;
    JoxDangerCount counts[JOX_DANGER_LIMITS];
    JoxDangerMost most[JOX_DANGER_MEASURES];
    JoxDangerRow *rows;
    uint32_t row_count, row_capacity;
    char *exit_names[JOX_DANGER_EXITS];
    uint32_t exit_count;
};

#endif
