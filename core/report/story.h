/* Moments of a crowd that a report shows: who stood where, and the density then. */
#ifndef JOX_REPORT_STORY_H
#define JOX_REPORT_STORY_H

#include <stdbool.h>

#include "base/sections.h"
#include "picture/draw.h"

typedef enum JoxMomentKind {
    JOX_MOMENT_START,
    JOX_MOMENT_DENSEST, /* of the greatest density anywhere */
    JOX_MOMENT_HALF,    /* half of those who came so far have left */
    JOX_MOMENT_LAST,    /* the last in which anybody was there */
    JOX_MOMENTS
} JoxMomentKind;

typedef struct JoxMomentPerson {
    uint32_t key;
    float x, y, radius; /* m; radius 0: not known */
} JoxMomentPerson;

typedef struct JoxMoment {
    bool taken;
    double time;   /* s */
    uint64_t left; /* so far */
    JoxMomentPerson *people;
    size_t count, capacity;
    float *field; /* density by cell, 1/m2 */
    size_t cells, cell_capacity;
    uint8_t *open; /* by ring of the walls: whether it was */
    size_t rings, ring_capacity;
    JoxDrawnBodies bodies; /* without names */
} JoxMoment;

typedef struct JoxStory {
    JoxMoment moments[JOX_MOMENTS];
    float most; /* 1/m2: so far */
    bool half;  /* had left at the last sample */
} JoxStory;

/* A moment as it is shown to a story. */
typedef struct JoxStorySample {
    const JoxFrame *frame;
    const JoxDensity *grid;    /* whose `now` is that of the frame */
    const JoxWalls *walls;     /* all of them */
    uint64_t left;             /* people, so far */
    const JoxBodies *bodies;   /* of a run; or NULL */
    JoxTrajectoryReader *reel; /* of a recording with bodies; or NULL */
} JoxStorySample;
void jox_story_sample(JoxStory *story, const JoxStorySample *sample);
void jox_story_sections(JoxStory *story, JoxSections *sections);
void jox_story_free(JoxStory *story);

#endif
