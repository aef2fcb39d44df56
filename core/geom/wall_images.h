/* Images of walls beyond joined (periodic) edges and beyond seams between sheets: copies that are
   moved by whole periods, or pitches. The world lays them whenever its walls change, so that grids
   over walls find the walls of both sides. */
#ifndef JOX_GEOM_WALL_IMAGES_H
#define JOX_GEOM_WALL_IMAGES_H

#include <stddef.h>

#include "geom/storeys.h"
#include "geom/walls.h"

typedef struct JoxWallImages {
    /* The standing walls first, with unchanged numbers of rings and vertices; then the images. */
    JoxWalls walls;
    uint32_t own_rings, own_vertices; /* number of rings and vertices before the images */
    /* Origin of each vertex of an image: the own vertex whose edge it repeats, and the distance
       from the start of that edge to the start of the repeated part, m. */
    struct JoxWallOrigin {
        uint32_t edge;
        float from;
    } * origins;
    size_t origin_capacity;
} JoxWallImages;

/* Returns how far images reach beyond joined edges, m: half a period, as far as neighbours are
   seen, and at least 5 m; the lesser of both axes. INFINITY if no edges are joined (period 0). */
float jox_wall_images_reach(JoxV2 period);
/* Returns by how many periods images are moved at most along one axis; 0 if it is not joined. */
int jox_wall_images_turns(float period);
/* Lays the images of `standing`. The bounds begin at `low` and measure `period` m, 0 along an axis
   that is not joined. Marks an edge of an image as `covered` where an edge that faces the same side
   lies there already, for instance of a wall that is drawn at both joined edges. Marks a vertex as
   `continued` where a wall and an image go on in one line. Keeps its memory. */
void jox_wall_images_lay(JoxWallImages *images, const JoxWalls *standing, JoxV2 low, JoxV2 period);
/* Lays the images of walls within `reach` m beyond seams after the others, of own walls alone. */
void jox_wall_images_lay_seams(JoxWallImages *images, const JoxStoreys *storeys, float reach);
/* Adds them to standing walls, for callers that need no origins. */
void jox_wall_images_add_seams(JoxWalls *walls, const JoxStoreys *storeys, float reach);
/* Adds the images to standing walls, as far as jox_wall_images_lay does and at least `reach` m
   beyond joined edges; does nothing if no edges are joined. For callers that need no origins. */
void jox_wall_images_add(JoxWalls *walls, JoxV2 low, JoxV2 period, JoxV2 reach);
/* Returns the images alone, as walls that share the memory of `images` and must not be freed. */
JoxWalls jox_wall_images_only(const JoxWallImages *images);
/* Returns the own edge that an edge is or repeats; adds to *along (m) where the edge begins on it.
 */
uint32_t jox_wall_images_origin(const JoxWallImages *images, uint32_t edge, float *along);
void jox_wall_images_free(JoxWallImages *images);

#endif
