/* What the files of danger share. */
#ifndef JOX_RECORD_DANGER_PARTS_H
#define JOX_RECORD_DANGER_PARTS_H

#include "record/danger/areas.h"
#include "record/danger/congestion.h"
#include "record/danger/danger.h"
#include "record/danger/leaving.h"
#include "record/danger/lines.h"
#include "record/danger/walls.h"
#include "record/fields/voronoi_people.h"
#include "record/local.h"

enum {
    JOX_DANGER_EXITS = JOX_LEAVING_EXITS, /* that have a column of their own over time */
    /* What people bear: of each person, every frame. */
    JOX_DANGER_FIRST_BORNE = JOX_DANGER_COMPRESSION,
    JOX_DANGER_LAST_BORNE = JOX_DANGER_DOSE
};
/* N: loads after which death is estimated within 300 s and 15 s. */
#define JOX_DOSE_LOW 1112.0
#define JOX_DOSE_HIGH 6227.0
/* 1/s: share of a dose that a load gives in a second. */
double jox_danger_dose_rate(double load);

typedef struct JoxDangerPerson {
    float compression, load; /* N/m, N: means of the last second */
    double dose;
    double seconds[JOX_DANGER_LIMITS]; /* over each limit */
    float most;                        /* N: greatest load */
    double most_time;
    JoxV2 most_at;
    uint16_t over; /* bits of the limits that were ever passed */
} JoxDangerPerson;

/* One line of danger.csv: a sample, and what was borne until the next. */
typedef struct JoxDangerRow {
    double time; /* s */
    uint32_t people;
    float most[JOX_DANGER_MEASURES]; /* NAN: not read */
    uint32_t over[JOX_DANGER_LIMITS];
    uint32_t levels[JOX_LEVELS]; /* people at each level of service */
    float wall_most;             /* N: of any piece of a wall; NAN: not known */
    uint32_t left, exits[JOX_DANGER_EXITS];
} JoxDangerRow;

struct JoxDanger {
    JoxLocal *local; /* density and pressure */
    bool owns_local;
    /* By cell, for the map: sum over samples (of pressure those that measured it; what is borne:
       over people) and greatest. */
    double *sum[JOX_DANGER_MAPPED];
    float *greatest[JOX_DANGER_MAPPED];
    uint32_t *measured; /* samples that measured pressure */
    uint32_t *stood;    /* people whose compression and load were summed */
    uint32_t samples;

    JoxDangerPerson *people; /* by key */
    uint32_t people_capacity;
    uint8_t *bears; /* by key: 0 for who bears nothing and has no dose; follows from `people` */
    uint32_t bears_capacity;
    uint32_t *bearing; /* indices of those in the frame who do bear something */
    uint32_t bearing_count, bearing_capacity;
    double least[JOX_DANGER_MEASURES]; /* limit of each measure; INFINITY: it has none */
    bool has_compression, has_load;

    JoxCongestion congestion;
    JoxDangerLines lines;
    JoxDangerAreas areas;
    JoxLeaving leaving;
    JoxDangerWalls walls;
    double level_s[JOX_LEVELS]; /* person-seconds at each level of service */
    /* By person of a sample: density, by the Gaussian (NAN outside of the area) and by Voronoi
       cells (NAN where that was not measured). */
    float *here, *room;
    uint32_t here_capacity, room_capacity;
    JoxVoronoiPeople voronoi;

    double begun, last_frame, last_sample; /* s */
    JoxDangerCount counts[JOX_DANGER_LIMITS];
    JoxDangerMost most[JOX_DANGER_MEASURES];
    JoxDangerRow *rows;
    uint32_t row_count, row_capacity;
    char *exit_names[JOX_DANGER_EXITS];
    uint32_t exit_count;
};

#endif
