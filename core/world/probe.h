/* Definitions of probes, as plain data: scene reads them, record makes probes of them. */
#ifndef JOX_WORLD_PROBE_H
#define JOX_WORLD_PROBE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

/* The kinds, a row each: enumerator; key in a scene, and jox_probe_KEY of record/probes; how its
   value is written (a LINE, two LINES, a RING, a POINT, FLAG: true, SECONDS, two STATES, or a TABLE
   whose keys stand under this name in scene/key_table.c); the keys that it takes besides those of
   all probes; a line of an example; what it measures. */
/* clang-format off */
#define JOX_PROBES(X)                                                                               \
    X(FLOW, flow, LINE, "", "door:    {flow: [[4, -2], [4, 2]], from: 2, until: 60}",               \
      "a line of two points: passages from its right to its left, their number over time, intervals "  \
      "between them; in reports also its level of service, stop-and-go and queue growth")                               \
    X(MEASURE, measure, RING, "every|cutoff|during",                                                \
      "front:   {measure: [[0, 0], [2, 0], [2, 2], [0, 2]], every: 0.5, cutoff: 1.5, during: [[2, 0], [2, 2]]}", \
      "a polygon: people, classical and Voronoi density, mean speed and specific flow in it")       \
    X(TRANSIT, transit, LINES, "",                                                                  \
      "passage: {transit: [[[0, -2], [0, 2]], [[3, -2], [3, 2]]], group: runner}",                  \
      "two lines: time that each person takes from the first to the second")                          \
    X(DISPLACEMENT, displacement, FLAG, "onset|rest|along",                                         \
      "block:   {displacement: true, group: standing, onset: 5 cm, rest: 0.2, along: [1, 0]}",      \
      "true: distance of each person from its first position, and speed at which a push travels")            \
    X(BODIES, bodies, FLAG, "onset", "pieces:  {bodies: true, onset: 25 cm}",                        \
      "true: distance of each body from its first position, its turn about the vertical and its tilt; bodies that are fixed or driven are left out") \
    X(MAP, map, TABLE, "every", "fields:  {map: {}, every: 2}",                                     \
      "fields: density, speed, crowd pressure, compression")                                        \
    X(WINDING, winding, POINT, "", "laps:    {winding: [0, 0]}",                                    \
      "number of anti-clockwise turns of each person about this point")                                      \
    X(FAILURES, failures, SECONDS, "", "solved:  {failures: 1}",                                    \
      "share of agent-steps whose 2-D linear program had no solution, in intervals of this length")                      \
    X(LANES, lanes, TABLE, "every", "order:   {lanes: {area: [[-2, -2], [4, 2]]}}",                 \
      "order parameter of lanes of people who walk in opposite directions")                                             \
    X(OSCILLATION, oscillation, TABLE, "every", "swirl:   {oscillation: {area: [[-2, -2], [4, 2]], span: 4}, every: 0.1}", \
      "whether a dense crowd oscillates as a whole: spectra of directions and speeds in windows of an area") \
    X(VISIT, visit, STATES, "", "arrival: {visit: [Run, Arrived]}",                                 \
      "two states: time that people take from entering the first to entering the second, and whether they keep their order") \
    X(LOG, log, FLAG, "", "actions: {log: true}",                                                    \
      "true: a row for each time that a person enters a state, kicks or throws a body, or is hit by one, and for the highest point (peaks) and the end (lands) of the flight of a body that it kicked or threw, with both positions at the beginning of that step, and how near to the person a body in the air passes")
/* clang-format on */

typedef enum JoxProbeKind {
#define X(kind, name, form, options, example, meaning) JOX_PROBE_##kind,
    JOX_PROBES(X)
#undef X
        JOX_PROBE_KINDS
} JoxProbeKind;

typedef struct JoxProbeDef {
    const char *name; /* files are named so */
    JoxProbeKind kind;
    const uint16_t *groups; /* indices of the scene's groups that are measured */
    uint32_t group_count;   /* 0: everyone */
    double from, until;     /* s; INFINITY unless given */
    const JoxV2 *points;    /* m: corners of a line, two lines or a polygon; winding: the point;
                               displacement: the direction, if one is given */
    uint32_t count;
    const JoxV2 *during;   /* measure: two ends of a line, or NULL */
    uint32_t during_count; /* 2, or 0 */
    double
        every; /* s: measure, lanes, oscillation: interval; map: between samples; failures: bin */
    double cutoff; /* m: greatest reach of a Voronoi cell */
    double rest;   /* s: displacement is from the mean place of this time */
    double onset;  /* m: displacement from which a person or body counts as moved */
    JoxV2 low,
        high; /* map, lanes, oscillation: the area; a map with low.x > high.x takes the scene's */
    double cell, kernel;   /* m: width of a map's cells, standard deviation of its Gaussian */
    bool through_walls;    /* map: its Gaussian heeds no walls */
    double rows;           /* m: width of the rows that lanes are looked for in */
    bool along_y;          /* lanes run along y, not x */
    double window;         /* m: width of the windows of an oscillation */
    double span;           /* s: stretches whose spectra are averaged */
    const char *states[2]; /* visit: names of states, of whatever machine */
    /* Storeys, which outlive the probe; NULL: one plane. Tables have positions in plan then, with a
       column for the storey. */
    const struct JoxStoreys *storeys;
    bool all_storeys; /* map: the area is in plan, and all storeys are measured */
} JoxProbeDef;

#endif
