/* Mean speed per region: displacement over a step, averaged over the people inside, frame by frame,
   then over the frames that had anyone. */
#ifndef JOX_RECORD_REGIONS_H
#define JOX_RECORD_REGIONS_H

#include <stdint.h>

#include "base/sections.h"
#include "base/vec.h"

typedef struct JoxRegion {
    char *name;
    JoxV2 *points;
    uint32_t count;
    double speed_sum; /* of frames' means, m/s */
    uint64_t frames, people;
} JoxRegion;

typedef struct JoxRegions {
    JoxRegion *items;
    uint32_t count;
} JoxRegions;

JoxRegions *jox_regions_create(void);
void jox_regions_add(JoxRegions *regions, const char *name, const JoxV2 *points, uint32_t count);
/* A frame: positions before and after a step of dt seconds. */
void jox_regions_frame(JoxRegions *regions, const float *x, const float *y, const float *before_x,
                       const float *before_y, uint32_t count, double dt);
/* m/s; 0 where nobody was. */
double jox_region_speed(const JoxRegion *region);
void jox_regions_sections(JoxRegions *regions, JoxSections *sections);
void jox_regions_free(JoxRegions *regions);

#endif
