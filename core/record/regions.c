/* Sums and means of speeds in regions. */
#include "record/regions.h"

#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "geom/polygon.h"

JoxRegions *jox_regions_create(void) {
    return jox_alloc(1, sizeof(JoxRegions));
}

void jox_regions_add(JoxRegions *r, const char *name, const JoxV2 *points, uint32_t count) {
    r->items = jox_realloc(r->items, r->count + 1, sizeof *r->items);
    JoxRegion *region = &r->items[r->count++];
    *region = (JoxRegion){
        .name = jox_strdup(name), .points = jox_alloc(count, sizeof *points), .count = count};
    memcpy(region->points, points, count * sizeof *points);
}

void jox_regions_frame(JoxRegions *r, const float *x, const float *y, const float *before_x,
                       const float *before_y, uint32_t count, double dt) {
    for (uint32_t k = 0; k < r->count; k++) {
        JoxRegion *region = &r->items[k];
        double sum = 0.0;
        uint64_t people = 0;
        for (uint32_t i = 0; i < count; i++) {
            if (!jox_polygon_contains(region->points, region->count, (JoxV2){x[i], y[i]}))
                continue;
            double dx = x[i] - before_x[i], dy = y[i] - before_y[i];
            sum += sqrt(dx * dx + dy * dy) / dt;
            people++;
        }
        if (people == 0)
            continue;
        region->speed_sum += sum / (double)people;
        region->people += people;
        region->frames++;
    }
}

double jox_region_speed(const JoxRegion *region) {
    return region->frames ? region->speed_sum / (double)region->frames : (double)NAN;
}

void jox_regions_sections(JoxRegions *r, JoxSections *s) {
    for (uint32_t k = 0; k < r->count; k++) {
        JOX_SECTION(s, "speed_sum", r->items[k].speed_sum);
        JOX_SECTION(s, "frames", r->items[k].frames);
        JOX_SECTION(s, "people", r->items[k].people);
    }
}

void jox_regions_free(JoxRegions *r) {
    for (uint32_t k = 0; r && k < r->count; k++) {
        jox_free(r->items[k].name);
        jox_free(r->items[k].points);
    }
    if (r)
        jox_free(r->items);
    jox_free(r);
}
