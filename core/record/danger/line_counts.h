/* Lines that people pass, such as doors: flow, level of service, stop-and-go and growth of the
   queue. Only the part of a line that walls leave open is measured: the opening about its middle,
   or several openings in a row of gates. Their total length is the clear width. danger.c owns the
   lines; values are read at each sample of danger, over the ten seconds before:

   - flow: people who passed, in either direction, per second and metre of clear width. A person who
     steps back within that time did not pass
   - density before the line, on the side that most people came from: mean, over the people within 2
     m, of the density where they stand, as on the map of danger
   - growth of the queue, 1/s: change of the number of people on that side within 10 m who see the
     middle of an opening

   Stop-and-go: the flow is below 0.8 per m s while the density before the line is 3.5 per m2 or
   more. Congestion is measured elsewhere (congestion.h). */
#ifndef JOX_RECORD_DANGER_LINE_COUNTS_H
#define JOX_RECORD_DANGER_LINE_COUNTS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/json_writer.h"
#include "base/sections.h"
#include "base/vec.h"
#include "record/danger/levels.h"
#include "record/frame_track.h"

#define JOX_STOP_FLOW 0.8 /* 1/(m s) */
extern const char jox_stop_and_go_source[];

/* Total duration of a condition, and when it was first met. */
typedef struct JoxDangerSpell {
    double seconds, first; /* s; NAN: never */
} JoxDangerSpell;

typedef struct JoxDangerLineRow {
    double time;            /* s */
    double width;           /* m: clear width */
    uint32_t forward, back; /* crossings so far: from the right of the line to its left, and back */
    uint32_t waiting[2];    /* people in sight within 10 m: on the right, on the left */
    int side;               /* side before the line: 0 right, 1 left */
    /* NAN where unknown: in the first ten seconds, or where there is nobody. */
    double flow, density, growth; /* 1/(m s), 1/m2, 1/s */
    int level;                    /* level of service; -1 in the first ten seconds */
    uint8_t stop_and_go;          /* 0 or 1; not a bool, since a checkpoint may hold any byte */
} JoxDangerLineRow;

typedef struct JoxDangerLine {
    char *name;
    JoxV2 given[2]; /* m: end points as added */
    JoxV2 a, b;     /* m: end points between walls */
    double width;   /* m: clear width */
    JoxDangerLineRow *rows;
    uint32_t row_count, row_capacity;
    /* greatest flow, 1/(m s), and its time, s; NAN: not measured */
    double flow_most, flow_most_time;
    /* greatest growth, 1/s, and its time, s; NAN: not measured */
    double growth_most, growth_most_time;
    double level_s[JOX_LEVELS];
    int worst; /* worst level; -1: not measured */
    JoxDangerSpell stop_and_go;
    /* Crossings of the last ten seconds, in ascending order of time. */
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
    JoxTrack track; /* positions in the last frame */
} JoxDangerLines;

/* Adds a line. A line that exists already or has no length is ignored. */
void jox_danger_lines_add(JoxDangerLines *lines, const char *name, JoxV2 a, JoxV2 b);
/* Adds the crossings of a frame; call it in every frame. */
void jox_danger_lines_add_crossings(JoxDangerLines *lines, const JoxFrame *frame);
/* Takes a sample, `duration` seconds after the last. `density[i]` is the density where person i
   stands, 1/m2; NAN outside the measured area. */
void jox_danger_lines_sample(JoxDangerLines *lines, const JoxFrame *frame, const float *density,
                             double duration);
/* Writes "lines": {...}, or null if there are none. The measurement lasted from `begun` to `end`,
   s. */
void jox_danger_lines_json(const JoxDangerLines *lines, double begun, double end, JoxJson *json);
void jox_danger_lines_sections(JoxDangerLines *lines, JoxSections *sections);
void jox_danger_lines_free(JoxDangerLines *lines);

#endif
