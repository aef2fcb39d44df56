/* Voronoi density of single people, 1/m2: one over the area of a person's cell, which is cut off at
   JOX_VORONOI_CUTOFF and ends at walls (voronoi.h). It is the individual density of PedPy, and
   measures the room of one person, where the Gaussian of density.h averages over some 3 m2. Cells
   are computed only where the Gaussian density is at least JOX_VORONOI_LEAST: at lower density
   nobody has a cell below 0.2 m2, unless bodies overlap. danger.c calls it at samples. */
#ifndef JOX_RECORD_VORONOI_PEOPLE_H
#define JOX_RECORD_VORONOI_PEOPLE_H

#include <stdint.h>

#include "geom/wall_grid.h"
#include "record/fields/density.h"
#include "record/fields/seam_images.h"
#include "record/fields/voronoi.h"

#define JOX_VORONOI_CUTOFF 1.0 /* m */
#define JOX_VORONOI_LEAST 1.0f /* 1/m2, Gaussian */

/* Initialise to zero and keep for later samples. */
typedef struct JoxVoronoiPeople {
    JoxSites sites;
    JoxBars near; /* walls near one person */
    JoxWallGrid walls;
    JoxSeamWalls seam_walls;
    uint64_t walls_hash;
} JoxVoronoiPeople;

/* Sets `out` to the density of each person, NAN where it is not measured. `here` is the Gaussian
   density of each person; `walls_hash` must change when the walls do. */
void jox_voronoi_people_measure(JoxVoronoiPeople *voronoi, const JoxDensityCrowd *crowd,
                                const JoxWalls *walls, uint64_t walls_hash, const float *here,
                                float *out);
void jox_voronoi_people_free(JoxVoronoiPeople *voronoi);

#endif
