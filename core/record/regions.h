/* Mean speed in each region of a scene, over the steps of a run: displacement over a step, averaged
   over the people inside in each frame, then over the frames with people. run/ adds the regions and
   gives the frames; summaries read the means. */
#ifndef JOX_RECORD_REGIONS_H
#define JOX_RECORD_REGIONS_H

#include <stdint.h>

#include "base/sections.h"
#include "base/vec.h"

typedef struct JoxRegion {
    char *name;
    JoxV2 *points;
    uint32_t count;
    double speed_sum;        /* m/s: sum of the means of frames */
    uint64_t frames, people; /* frames with people; people summed over frames */
} JoxRegion;

typedef struct JoxRegions {
    JoxRegion *items;
    uint32_t count;
} JoxRegions;

JoxRegions *jox_regions_create(void);
void jox_regions_add(JoxRegions *regions, const char *name, const JoxV2 *points, uint32_t count);
/* Adds a frame: positions of `count` people after and before a step of dt seconds. */
void jox_regions_frame(JoxRegions *regions, const float *x, const float *y, const float *before_x,
                       const float *before_y, uint32_t count, double dt);
/* Returns the mean speed, m/s; NAN where the region was never occupied. */
double jox_region_speed(const JoxRegion *region);
void jox_regions_sections(JoxRegions *regions, JoxSections *sections);
void jox_regions_free(JoxRegions *regions);

#endif
