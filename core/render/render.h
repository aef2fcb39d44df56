/* What pictures are made of: a crowd that is run or read, moment by moment. For render*.c alone. */
#ifndef JOX_RENDER_RENDER_H
#define JOX_RENDER_RENDER_H

#include "jostle_tools.h"
#include "picture/draw.h"
#include "record/trajectories.h"
#include "record/trajectory_reader.h"
#include "run/run.h"

typedef struct JoxRender {
    const JoRenderDef *def;
    JoScene *scene; /* that is run, or */
    JoxTrajectories *crowd;
    JoxSceneSpec *spec; /* with a recording: whose walls and places are drawn, or NULL */
    uint32_t at;        /* frame of the recording */
    double first, last; /* s: times that there are; of a scene without end */
    double pace;        /* s between two of them */

    JoxFrame frame; /* of now */
    JoxPicture picture;
    char title[256];
    JoxShow colour, floor;
    JoxDensity *grid;  /* for density; NULL where it is not asked for */
    JoxDanger *danger; /* of a recording, for pressure */
    float *density;    /* of each person */
    size_t density_capacity;
    JoxTrajectoryReader *reader; /* of a recording that has bodies, for these; else NULL */
    JoxDrawnBodies bodies;
    const char **states; /* of a scene: with their machines' names where there are several */
    char **state_texts;
    uint32_t state_count;

    JoxTrail *trails;
    uint32_t trail_count, trail_capacity, trail_stride;
    uint32_t *trail_of; /* by key: number of the trail, plus 1 */
    uint32_t trail_keys;
} JoxRender;

/* render_crowd.c: loads what the def names; false with `error`. */
bool jox_render_load(JoxRender *render, JoError *error);
/* Goes on to the moment nearest to a time; times ascend. */
bool jox_render_advance(JoxRender *render, double time, JoError *error);
/* Time of the present moment, s. */
double jox_render_time(const JoxRender *render);
/* Widens what is shown, unless the def says it, by everyone who is outside now. */
void jox_render_widen(JoxRender *render);
/* The picture of now. */
const JoxPicture *jox_render_picture(JoxRender *render);
void jox_render_free(JoxRender *render);
/* What colours can tell of this crowd; false with `error`. */
bool jox_render_choose(JoxRender *render, JoError *error);

#endif
