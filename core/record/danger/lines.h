/* Lines that people pass, such as doors: flow, level of service, stop-and-go and queue growth. What
   walls leave of a line is measured: about its middle, and between two walls, as of a line of
   gates; the length of all of it is the clear width. Read at each sample of danger, of what
   happened in the ten seconds before:

   - flow: people who passed, either way, per second and metre of the clear width; who stepped back
     within the time did not pass
   - density before the line, on the side that most came from: the mean, over the people there
   within 2 m, of the density where they stand, which is that of the map of danger
   - growth of the queue, 1/s, inflow less outflow: how much the number of people grew who are in
   sight of the middle of one of the openings within 10 m of it on that side

   Stop-and-go: the flow is below 0.8 per m s while the density before the line is 3.5 per m2 or
   more. Congestion is not judged at lines (congestion.h). */
#ifndef JOX_RECORD_DANGER_LINES_H
#define JOX_RECORD_DANGER_LINES_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/json_writer.h"
#include "base/sections.h"
#include "base/vec.h"
#include "record/danger/levels.h"
#include "record/track.h"

#define JOX_STOP_FLOW 0.8 /* 1/(m s) */
extern const char jox_stop_and_go_source[];

/* How long something lasted in all, and when it began for the first time. */
typedef struct JoxDangerSpell {
    double seconds, first; /* s; NAN: never */
} JoxDangerSpell;

typedef struct JoxDangerLineRow {
    double time;  /* s */
    double width; /* m: clear */
    uint32_t forward,
        back;            /* who crossed it so far: from its right to its left, and the other way */
    uint32_t waiting[2]; /* in sight within 10 m: on its right, on its left */
    int side;            /* the one before it: 0 its right, 1 its left */
    /* NAN where they are not known: in the first ten seconds; where nobody is. */
    double flow, density, growth; /* 1/(m s), 1/m2, 1/s */
    int level;                    /* -1 in the first ten seconds */
    uint8_t stop_and_go;          /* as it is read back from a checkpoint: any byte */
} JoxDangerLineRow;

typedef struct JoxDangerLine {
    char *name;
    JoxV2 given[2]; /* m: as it was added */
    JoxV2 a, b;     /* m: what walls leave of it */
    double width;   /* m: from a to b */
    JoxDangerLineRow *rows;
    uint32_t row_count, row_capacity;
    double flow_most, flow_most_time;     /* NAN: not measured */
    double growth_most, growth_most_time; /* likewise */
    double level_s[JOX_LEVELS];
    int worst; /* level; -1: not measured */
    JoxDangerSpell stop_and_go;
    /* Crossings of the last ten seconds, ascending in time. */
    struct JoxDangerCrossing {
        double time;
        uint32_t key;
        int direction;
    } * crossings;
    uint32_t crossing_count, crossing_capacity;
    uint32_t forward, back;
} JoxDangerLine;

typedef struct JoxDangerLines {
    JoxDangerLine *items;
    uint32_t count, capacity;
    JoxTrack track; /* from frame to frame */
} JoxDangerLines;

/* One that is there already, or that has no length, is passed over. */
void jox_danger_lines_add(JoxDangerLines *lines, const char *name, JoxV2 a, JoxV2 b);
/* Every frame: who crosses. */
void jox_danger_lines_cross(JoxDangerLines *lines, const JoxFrame *frame);
/* At a sample, `duration` after the last: `density[i]` where person i stands, NAN outside of what
   is measured. */
void jox_danger_lines_sample(JoxDangerLines *lines, const JoxFrame *frame, const float *density,
                             double duration);
/* Adds "lines": {...}; null without any. What was measured began and ended then, s. */
void jox_danger_lines_json(const JoxDangerLines *lines, double begun, double end, JoxJson *json);
void jox_danger_lines_sections(JoxDangerLines *lines, JoxSections *sections);
void jox_danger_lines_free(JoxDangerLines *lines);

#endif
