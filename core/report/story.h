/* The moments of a crowd that a report shows: where people stood, and the density. Runs and
   reports add a sample at each measurement of density; snapshots.c draws the moments kept. */
#ifndef JOX_REPORT_STORY_H
#define JOX_REPORT_STORY_H

#include <stdbool.h>

#include "base/sections.h"
#include "picture/draw.h"

typedef enum JoxMomentKind {
    JOX_MOMENT_START,   /* the first with anybody inside */
    JOX_MOMENT_DENSEST, /* the one with the greatest density anywhere so far */
    JOX_MOMENT_HALF,    /* at least as many people have left as are inside */
    JOX_MOMENT_LAST,    /* the last with anybody inside */
    JOX_MOMENTS
} JoxMomentKind;

typedef struct JoxMomentPerson {
    uint32_t key;
    float x, y, radius;                   /* m; radius 0: not known */
    float axis_x, axis_y, contact_radius; /* m: the torso, as in JoxFrame; no axis: a disc */
} JoxMomentPerson;

typedef struct JoxMoment {
    bool taken;    /* the moment has occurred; else all else is unset */
    double time;   /* s */
    uint64_t left; /* people who have left by then */
    JoxMomentPerson *people;
    size_t count, capacity;
    float *field; /* 1/m2: density per cell */
    size_t cells, cell_capacity;
    uint8_t *open; /* per ring of the walls: the gate was open */
    size_t rings, ring_capacity;
    JoxDrawnBodies bodies; /* outlines without names */
    JoxCarLook *cars;      /* of the lifts */
    size_t car_count, car_capacity;
} JoxMoment;

typedef struct JoxStory {
    JoxMoment moments[JOX_MOMENTS];
    float most; /* 1/m2: greatest density so far */
    bool half;  /* at the last sample, half had left */
} JoxStory;

/* A sample of the crowd; all pointers are borrowed for the call. */
typedef struct JoxStorySample {
    const JoxFrame *frame;
    const JoxDensity *grid;           /* its `now` is the density of the frame */
    const JoxWalls *walls;            /* with the open gates */
    uint64_t left;                    /* people who have left so far */
    const JoxBodies *bodies;          /* bodies of a run, or NULL */
    JoxTrajectoryReader *body_reader; /* reader of a recording with bodies, or NULL */
} JoxStorySample;
/* Stores the sample as each of the moments that it is. */
void jox_story_add_sample(JoxStory *story, const JoxStorySample *sample);
/* Lists the moments as sections of state, so that a resumed run keeps them. */
void jox_story_sections(JoxStory *story, JoxSections *sections);
void jox_story_free(JoxStory *story);

#endif
