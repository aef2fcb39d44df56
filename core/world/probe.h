/* What a probe measures, as plain data: a scene says it, record/ makes a probe of it. */
#ifndef JOX_WORLD_PROBE_H
#define JOX_WORLD_PROBE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

typedef enum JoxProbeKind {
    JOX_PROBE_FLOW,         /* crossings of a line: points[0..1], + from its right to its left */
    JOX_PROBE_MEASURE,      /* people, density, speed and flow within a polygon */
    JOX_PROBE_TRANSIT,      /* time from the line points[0..1] to the line points[2..3] */
    JOX_PROBE_DISPLACEMENT, /* from where first seen; along points[0], if given */
    JOX_PROBE_MAP,          /* fields on a grid between low and high */
    JOX_PROBE_WINDING,      /* turns of each person about points[0] */
    JOX_PROBE_FAILURES,     /* share of agent-steps whose 2-D program failed */
    JOX_PROBE_LANES,        /* order parameter of lanes between low and high */
    JOX_PROBE_VISIT,        /* time from entering states[0] to entering states[1] */
    JOX_PROBE_KINDS
} JoxProbeKind;

typedef struct JoxProbeDef {
    const char *name; /* files are named so */
    JoxProbeKind kind;
    const uint16_t *groups; /* indices of the scene's groups that are measured */
    uint32_t group_count;   /* 0: everyone */
    double from, until;     /* s; INFINITY unless given */
    const JoxV2 *points;    /* m */
    uint32_t count;
    const JoxV2
        *walkable; /* measure: cells end at this polygon's edge; NULL: at the cutoff alone */
    uint32_t walkable_count;
    double every;          /* s: measure, lanes: interval; map: between samples; failures: bin */
    double cutoff;         /* m: greatest reach of a Voronoi cell */
    double rest;           /* s: displacement is from the mean place of this time */
    double onset;          /* m: displacement from which a person counts as moved */
    JoxV2 low, high;       /* map, lanes: the area; a map with low.x > high.x takes the scene's */
    double cell, kernel;   /* m: width of a map's cells, R of its Gaussian */
    double rows;           /* m: width of the rows that lanes are looked for in */
    bool along_y;          /* lanes run along y, not x */
    const char *states[2]; /* visit: names of states, of whatever machine */
} JoxProbeDef;

#endif
