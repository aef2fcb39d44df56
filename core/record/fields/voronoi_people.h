/* The Voronoi density of single people, 1/m2: one over the area of the cell of each, which is cut
   off at JOX_VORONOI_CUTOFF and ends at walls (voronoi.h). It is the individual density of PedPy;
   it tells how much room one person has, where the Gaussian of density.h tells the mean over some
   3 m2. Only where that is at least JOX_VORONOI_LEAST are cells made: nobody who stands in less has
   a cell of less than 0.2 m2, but where bodies overlap. */
#ifndef JOX_RECORD_VORONOI_PEOPLE_H
#define JOX_RECORD_VORONOI_PEOPLE_H

#include <stdint.h>

#include "geom/wall_grid.h"
#include "record/fields/density.h"
#include "record/fields/voronoi.h"

#define JOX_VORONOI_CUTOFF 1.0 /* m */
#define JOX_VORONOI_LEAST 1.0f /* 1/m2, by the Gaussian */

/* Zero-initialise, keep for the next sample. */
typedef struct JoxVoronoiPeople {
    JoxSites sites;
    JoxBars near; /* walls about one person */
    JoxWallGrid walls;
    uint64_t walls_hash;
} JoxVoronoiPeople;

/* `here`: of each person, by the Gaussian. `out`: NAN of those who are not measured. `walls_hash`:
   another one where the walls are others. */
void jox_voronoi_people(JoxVoronoiPeople *voronoi, const JoxDensityCrowd *crowd,
                        const JoxWalls *walls, uint64_t walls_hash, const float *here, float *out);
void jox_voronoi_people_free(JoxVoronoiPeople *voronoi);

#endif
