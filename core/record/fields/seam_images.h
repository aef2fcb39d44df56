/* Images of people and walls beyond seams, for what looks from a storey over the seam of a stair,
   or from the stair: moved by the seam's shift, they lie where one plane would have them. Voronoi
   cells and the probe `measure` use them; densities have ways through seams instead
   (density_sheets.c). */
#ifndef JOX_RECORD_FIELDS_SEAM_IMAGES_H
#define JOX_RECORD_FIELDS_SEAM_IMAGES_H

#include <stdint.h>

#include "geom/storeys.h"
#include "geom/wall_images.h"
#include "record/fields/voronoi.h"

/* Adds to `sites` the image of person `person` at `at` beyond each seam within `reach` m. Those who
   look at it do so through that seam. Without storeys it adds nothing. */
void jox_seam_images_add(JoxSites *sites, const JoxStoreys *storeys, JoxV2 at, uint32_t person,
                         float reach);

/* Walls and their images beyond seams. Initialise to zero and keep for later frames. */
typedef struct JoxSeamWalls {
    JoxWallImages images;
    uint64_t hash;
    bool laid;
} JoxSeamWalls;

/* Returns the walls with their images, laid anew if walls have changed; without storeys the walls
   as they are. Edges marked as covered are none. */
const JoxWalls *jox_seam_walls_of(JoxSeamWalls *seam_walls, const JoxWalls *walls,
                                  const JoxStoreys *storeys);
void jox_seam_walls_free(JoxSeamWalls *seam_walls);

#endif
