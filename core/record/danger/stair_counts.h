/* People on stairs between storeys: how many went up and down, the flow, how many were on each at a
   time, and how dense it was there. danger.c owns and feeds them. Values are read at each sample of
   danger:

   - flow: people who left the stair at the other end within the ten seconds before, in either
     direction, per second and metre of its width
   - density: mean, over the people on it, of the density where they stand
   - level of service: Fruin's for stairs, of a ramp his for walkways. Escalators have none */
#ifndef JOX_RECORD_DANGER_STAIR_COUNTS_H
#define JOX_RECORD_DANGER_STAIR_COUNTS_H

#include "base/format/json_writer.h"
#include "base/sections.h"
#include "record/danger/levels.h"
#include "record/frame.h"

/* Least people who passed a stair for its flow and levels to be judged: with fewer, one person more
   or less changes the greatest flow by more than a tenth. */
enum { JOX_STAIR_FEW = 10 };

typedef struct JoxDangerStairRow {
    double time;       /* s */
    uint32_t up, down; /* people who went up and down so far */
    uint32_t people;   /* on it */
    int level;         /* level of service; -1 in the first ten seconds and on escalators */
    /* 1/(m s), NAN in the first ten seconds; 1/m2, NAN where nobody is */
    double flow, density;
} JoxDangerStairRow;

typedef struct JoxDangerStair {
    uint32_t up, down; /* people who left it at the head, at the foot, not where they came from */
    uint32_t people_most;                   /* on it at a time */
    int worst;                              /* worst level; -1: none */
    double width;                           /* m: clear width, to a tenth of a millimetre */
    double used;                            /* s: time in which somebody was on it */
    double first, last;                     /* s: first and last time of that; NAN: never */
    double flow_most, flow_most_time;       /* 1/(m s), s; NAN: not measured */
    double mean_most, mean_most_time;       /* 1/m2, s: greatest mean density; NAN: nobody */
    double density_most, density_most_time; /* 1/m2, s: greatest where one of them stood */
    double over; /* s: time with a mean density of the lowest limit of danger, or more */
    double level_s[JOX_LEVELS];
    JoxDangerStairRow *rows;
    uint32_t row_count, row_capacity;
} JoxDangerStair;

typedef struct JoxDangerStairs {
    JoxDangerStair *items; /* by stair; those of slopes stay empty */
    uint32_t count;
    double limit; /* 1/m2: lowest limit of density */
    double last;  /* s: time of the last frame; NAN: none */
    double begun; /* s: time of the first sample; NAN: none */
    /* By key: 1 + the stair that the person is on, 0 on a storey; and the sheet that it came from,
       UINT32_MAX if it came in on the stair; on a storey 1 + its sheet, 0 if not seen before. */
    struct JoxOnStair {
        uint32_t stair, from;
    } * people;
    uint32_t people_capacity;
    struct JoxStairPassage {
        double time;
        uint32_t stair, up; /* up: 1, down: 0 */
    } * passages;           /* of the last ten seconds, in ascending order of time */
    uint32_t passage_count, passage_capacity;
    uint32_t by_lift[2];       /* changes of storeys without a stair: down, up */
    const JoxStoreys *storeys; /* storeys of the last frame */
} JoxDangerStairs;

/* Returns stairs for which a mean density of `limit`, 1/m2, is dangerous. */
JoxDangerStairs jox_danger_stairs_create(double limit);
/* Takes a frame; every frame. Does nothing in a world without storeys. */
void jox_danger_stairs_frame(JoxDangerStairs *stairs, const JoxFrame *frame);
/* Takes a sample of the density at each person, 1/m2, after the frame, `duration` seconds after the
   last. */
void jox_danger_stairs_sample(JoxDangerStairs *stairs, const JoxFrame *frame, const float *density,
                              double duration);
/* Returns whether enough people passed a stair for flow and levels to be judged. */
static inline bool jox_danger_stair_is_judged(const JoxDangerStair *stair) {
    return stair->up + stair->down >= JOX_STAIR_FEW;
}
/* Returns the number of stairs between storeys. */
uint32_t jox_danger_stairs_joining(const JoxDangerStairs *stairs);
/* Writes "stairs": {NAME: {...}}, if there are any, and "by_lift": {...}. */
void jox_danger_stairs_json(const JoxDangerStairs *stairs, const JoxStoreys *storeys,
                            JoxJson *json);
void jox_danger_stairs_sections(JoxDangerStairs *stairs, JoxSections *sections);
void jox_danger_stairs_free(JoxDangerStairs *stairs);

#endif
