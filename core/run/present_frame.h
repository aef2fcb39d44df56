/* The frame of a running scene's present step, and the area that pictures and recordings show. */
#ifndef JOX_RUN_PRESENT_FRAME_H
#define JOX_RUN_PRESENT_FRAME_H

#include "base/vec.h"
#include "jostle.h"
#include "record/frame.h"

/* Columns that the world does not hold in a frame's form, and which are made when asked for. */
enum {
    JOX_FRAME_VELOCITIES = 1,
    JOX_FRAME_FORCES = 2,
    JOX_FRAME_STATES = 4,
    JOX_FRAME_TORSOS = 8,
    JOX_FRAME_MEASURED = 7, /* the columns of probes */
    JOX_FRAME_WHOLE = 15
};

/* Returns the frame of the present step, made once a step; valid until the next step. `parts`: bits
   of the columns that are needed; those that nobody needs in a step may be NULL. */
const JoxFrame *jox_run_present_frame(JoScene *scene, uint32_t parts);
void jox_run_free_frame(JoScene *scene);

/* Writes the corners of the area that pictures and recordings show, m: the heat map's, else the
   scene's bounds, else a box round all walls and people. */
void jox_run_find_shown_area(const JoScene *scene, JoxV2 *low, JoxV2 *high);
/* As jox_run_find_shown_area, in plan, and returns the scene's storeys, NULL without any: the area
   on which local densities are measured. */
const JoxStoreys *jox_run_find_plan_area(const JoScene *scene, JoxV2 *low, JoxV2 *high);

#endif
