/* Finds the seams near a person, and lays walls beyond seams. */
#include "record/fields/seam_images.h"

#include "base/hash.h"
#include "geom/polygon.h"

void jox_seam_images_add(JoxSites *sites, const JoxStoreys *s, JoxV2 at, uint32_t person,
                         float reach) {
    if (!jox_has_storeys(s))
        return;
    const uint32_t sheet = jox_sheet_of(s, at.y);
    const JoxV2 plan = jox_in_plan(s, at);
    for (uint32_t k = 0; k < s->sheets[sheet].seam_count; k++) {
        const uint32_t number = s->sheets[sheet].first_seam + k;
        const JoxSeam *seam = &s->seams[number];
        const JoxV2 to = jox_sub(jox_segment_nearest(seam->a, seam->b, plan), plan);
        if (jox_length2(to) < reach * reach)
            jox_sites_add_image(sites, jox_v2(at.x, at.y + seam->shift), person, number);
    }
}

static uint64_t hash_standing_walls(const JoxWalls *walls) {
    JoxHash hash = jox_hash_begin();
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        const uint32_t what[2] = {ring->count, ring->open};
        jox_hash_add(&hash, what, sizeof what);
        for (uint32_t v = ring->first; v < ring->first + ring->count; v++)
            jox_hash_add(&hash, &walls->vertices[v].point, sizeof walls->vertices[v].point);
    }
    return jox_hash_end(&hash);
}

const JoxWalls *jox_seam_walls_of(JoxSeamWalls *w, const JoxWalls *walls, const JoxStoreys *s) {
    if (!walls || !jox_has_storeys(s))
        return walls;
    const uint64_t hash = hash_standing_walls(walls);
    if (!w->laid || w->hash != hash) {
        const JoxV2 none = {0.0f, 0.0f};
        jox_wall_images_lay(&w->images, walls, none, none);
        jox_wall_images_lay_seams(&w->images, s, JOX_SEAM_REACH);
        w->laid = true;
        w->hash = hash;
    }
    return &w->images.walls;
}

void jox_seam_walls_free(JoxSeamWalls *w) {
    jox_wall_images_free(&w->images);
}
