/* What people at the page do to bodies: boxes that they threw in, and bodies that they drag. State
   of a world that is carried from step to step. */
#ifndef JOX_WORLD_DRAG_H
#define JOX_WORLD_DRAG_H

#include "base/sections.h"
#include "base/vec.h"

enum { JOX_MOST_BOXES = 200, JOX_MOST_GRABS = 64 };

/* Zero-initialised is empty. */
typedef struct JoxDrags {
    uint32_t boxes[JOX_MOST_BOXES]; /* ids of their bodies, the oldest first */
    uint32_t box_count;
    struct JoxGrab {
        uint32_t row, id; /* of the body */
        JoxV3 to;         /* where its centre of mass is to be, m */
    } grabs[JOX_MOST_GRABS];
    uint32_t grab_count;
} JoxDrags;

/* Lists them as state. */
void jox_drags_sections(JoxDrags *drags, JoxSections *sections);

#endif
