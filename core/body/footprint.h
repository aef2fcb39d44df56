/* Footprint of a body: the convex hull, seen from above, of its part within the height band of
   people. bullet_step.cc calls it for each body that moved. */
#ifndef JOX_BODY_FOOTPRINT_H
#define JOX_BODY_FOOTPRINT_H

#include "geom/objects.h"

/* Height band of people, m. */
#define JOX_BAND_LOW 0.1f
#define JOX_BAND_HIGH 1.8f

/* Points gathered for a footprint, and the body's height range. Zero-initialise; keeps its
   memory from body to body. */
typedef struct JoxFootprint {
    JoxV2 *points;
    uint32_t count, capacity;
    float low, high; /* heights of the whole body, not cut to the band, m */
    bool has_circle;
    JoxV2 circle[JOX_FOOTPRINT_POINTS]; /* corners of the polygon in place of a unit circle */
} JoxFootprint;

void jox_footprint_begin(JoxFootprint *footprint);
/* Adds a polytope: its corners in world coordinates, m, and its edges as pairs of indices. */
void jox_footprint_add(JoxFootprint *footprint, const JoxV3 *corners, uint32_t corner_count,
                       const uint32_t *edges, uint32_t edge_count);
void jox_footprint_add_sphere(JoxFootprint *footprint, JoxV3 centre, float radius);
/* Writes footprint, footprint_count, low, high and in_band of an object. From a ring of more
   than JOX_FOOTPRINT_POINTS corners those that span the least area are removed. */
void jox_footprint_end(JoxFootprint *footprint, JoxObject *object);
/* Returns the radius of the widest section of a sphere within the band, m, 0 if it is outside. */
float jox_footprint_sphere(float z, float radius);
void jox_footprint_free(JoxFootprint *footprint);
/* Assertions on a footprint after jox_footprint_end; in body_checks.c. */
void jox_footprint_check(const JoxObject *object);

#endif
