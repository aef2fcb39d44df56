/* Boxes that people at the live page threw in, and bodies that they drag: state of a world, written
   by the verbs box, grab, drag and release. */
#ifndef JOX_WORLD_DRAGGED_BODIES_H
#define JOX_WORLD_DRAGGED_BODIES_H

#include "base/sections.h"
#include "base/vec.h"

enum { JOX_MOST_BOXES = 200, JOX_MOST_GRABS = 64 };

/* Zero-initialised is empty. */
typedef struct JoxDrags {
    uint32_t boxes[JOX_MOST_BOXES]; /* ids of the bodies, oldest first */
    uint32_t box_count;
    struct JoxGrab {
        uint32_t row, id; /* row and id of the body */
        JoxV3 to;         /* m: point that its centre of mass is pulled to */
    } grabs[JOX_MOST_GRABS];
    uint32_t grab_count;
} JoxDrags;

/* Lists boxes and grabs as state. */
void jox_drags_sections(JoxDrags *drags, JoxSections *sections);

#endif
