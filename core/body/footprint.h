/* A body cut by the heights at which people touch things: a convex ring in the plane. */
#ifndef JOX_BODY_FOOTPRINT_H
#define JOX_BODY_FOOTPRINT_H

#include "geom/objects.h"

/* Agents' height band, m. */
#define JOX_BAND_LOW 0.1f
#define JOX_BAND_HIGH 1.8f

/* Points gathered so far, and the heights that they cover. Zero-initialise; keeps its memory. */
typedef struct JoxFootprint {
    JoxV2 *points;
    uint32_t count, capacity;
    float low, high; /* of the whole body, not yet cut to the band */
    bool has_circle;
    JoxV2
        circle[JOX_FOOTPRINT_POINTS]; /* unit vectors to the corners of what stands for a circle */
} JoxFootprint;

void jox_footprint_begin(JoxFootprint *footprint);
/* Adds a polytope: its corners in world coordinates, and its edges as pairs of indices. */
void jox_footprint_add(JoxFootprint *footprint, const JoxV3 *corners, uint32_t corner_count,
                       const uint32_t *edges, uint32_t edge_count);
void jox_footprint_add_sphere(JoxFootprint *footprint, JoxV3 centre, float radius);
/* Fills footprint, footprint_count, low, high and in_band. A ring of more than
   JOX_FOOTPRINT_POINTS corners loses those that take least area with them. */
void jox_footprint_end(JoxFootprint *footprint, JoxObject *object);
/* The radius at which a sphere is cut widest within the band, 0 where it is outside. */
float jox_footprint_sphere(float z, float radius);
void jox_footprint_free(JoxFootprint *footprint);
/* body_checks.c: what jox_footprint_end wrote. */
void jox_footprint_check(const JoxObject *object);

#endif
