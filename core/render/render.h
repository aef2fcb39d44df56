/* A crowd for pictures, run as a scene or read from a recording, moment by moment. Shared by
   render.c, which writes the files, and render_crowd.c, which implements these functions but for
   trails; private to this folder. */
#ifndef JOX_RENDER_RENDER_H
#define JOX_RENDER_RENDER_H

#include "jostle_tools.h"
#include "picture/draw.h"
#include "record/trajectories.h"
#include "record/trajectory_reader.h"
#include "run/figure_listeners.h"
#include "run/run.h"
#include "scene/scene_look.h"

/* Exactly one of `scene` and `crowd` is set. jox_render_free frees all that it owns. */
typedef struct JoxRender {
    const JoRenderDef *def;
    JoScene *scene;         /* a scene that is run, or NULL */
    JoxTrajectories *crowd; /* a recording, or NULL */
    JoxSceneSpec *spec; /* with a recording: the scene whose walls and places are drawn, or NULL */
    JoxSceneLook look;  /* floor and scenery: of the scene, else of the recording */
    uint32_t at;        /* index of the recording's current frame */
    double first, last; /* s: range of times; `last` of a scene is infinite */
    double interval;    /* s: between two frames */

    JoxFrame frame; /* the current frame */
    JoxPicture picture;
    char title[256];
    JoxDensity *grid;  /* grid of density, if density is shown; else NULL */
    JoxDanger *danger; /* for crowd pressure of a recording; else NULL */
    float *density;    /* 1/m2, per person of the frame */
    size_t density_capacity;
    JoxTrajectoryReader *reader; /* for the bodies of a recording; NULL if it has none */
    JoxDrawnBodies bodies;       /* in the current frame */
    /* names of a scene's states by row, with the machine's name if there are several */
    char **states;
    uint32_t state_count;

    JoxTrail *trails;
    uint32_t trail_count, trail_capacity;
    uint32_t trail_stride; /* people whose key is a multiple of it get a trail */
    uint32_t *trail_of;    /* per key: index of the trail plus 1, or 0 */
    uint32_t trail_keys;   /* length of trail_of */
} JoxRender;

/* Loads the scene or recording that the def names, up to its first frame. Returns false with
   `error`. */
bool jox_render_load(JoxRender *render, JoError *error);
/* Advances to the frame nearest to a time, s, by running or reading. Times must not descend.
   Returns false with `error`. */
bool jox_render_advance(JoxRender *render, double time, JoError *error);
/* Returns the time of the current frame, s. */
double jox_render_time(const JoxRender *render);
/* Widens the area shown so that it includes the people of the current frame, except those far
   away. No effect if the def gives an area. */
void jox_render_widen_area(JoxRender *render);
/* Returns the picture of the current frame, which holds until the next call on the render. */
const JoxPicture *jox_render_picture(JoxRender *render);
void jox_render_free(JoxRender *render);

/* trails.c: extend the trails by the people, and by a scene's bodies, of the current frame. */
void jox_render_extend_people_trails(JoxRender *render);
void jox_render_extend_body_trails(JoxRender *render);

#endif
