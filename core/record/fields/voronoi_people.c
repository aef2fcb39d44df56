/* Voronoi density of each person in a dense crowd, between the walls near the person. */
#include "record/fields/voronoi_people.h"

#include <math.h>

#include "base/mem.h"

/* Adds everybody, and the images across periodic edges that may shape a cell. */
static void gather_crowd_sites(JoxVoronoiPeople *v, const JoxDensityCrowd *crowd) {
    const float reach = 2.0f * (float)JOX_VORONOI_CUTOFF;
    JoxV2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    jox_sites_clear(&v->sites);
    v->sites.storeys = crowd->storeys;
    for (uint32_t i = 0; i < crowd->count; i++) {
        const JoxV2 p = {crowd->x[i], crowd->y[i]};
        jox_sites_add(&v->sites, p, i);
        low = (JoxV2){jox_minf(low.x, p.x), jox_minf(low.y, p.y)};
        high = (JoxV2){jox_maxf(high.x, p.x), jox_maxf(high.y, p.y)};
    }
    const int across = crowd->period.x > 0.0f, up = crowd->period.y > 0.0f;
    for (uint32_t i = 0; (across || up) && i < crowd->count; i++)
        for (int c = -across; c <= across; c++)
            for (int r = -up; r <= up; r++) {
                const JoxV2 p = {crowd->x[i] + (float)c * crowd->period.x,
                                 crowd->y[i] + (float)r * crowd->period.y};
                if ((c || r) && p.x > low.x - reach && p.x < high.x + reach &&
                    p.y > low.y - reach && p.y < high.y + reach)
                    jox_sites_add(&v->sites, p, i);
            }
    for (uint32_t i = 0; crowd->storeys && i < crowd->count; i++)
        jox_seam_images_add(&v->sites, crowd->storeys, (JoxV2){crowd->x[i], crowd->y[i]}, i, reach);
    jox_sites_sort(&v->sites, JOX_VORONOI_CUTOFF);
}

/* Collects the walls that may hide a neighbour of a person at a point. */
static void gather_walls_near_point(JoxVoronoiPeople *v, JoxV2 at) {
    uint32_t count;
    const uint32_t *edges = jox_wall_grid_at(&v->walls, at, &count);
    v->near.count = 0;
    for (uint32_t e = 0; e < count; e++) {
        const JoxWallVertex *vertex = &v->walls.walls->vertices[edges[e]];
        JOX_RESERVE(v->near.items, v->near.capacity, v->near.count + 1);
        v->near.items[v->near.count++] =
            (struct JoxBar){vertex->point, v->walls.walls->vertices[vertex->next].point};
    }
}

void jox_voronoi_people_measure(JoxVoronoiPeople *v, const JoxDensityCrowd *crowd,
                                const JoxWalls *walls, uint64_t walls_hash, const float *here,
                                float *out) {
    bool any = false;
    for (uint32_t i = 0; i < crowd->count; i++) {
        out[i] = NAN;
        any |= here[i] >= JOX_VORONOI_LEAST;
    }
    if (!any)
        return;
    const bool same = v->walls.walls && v->walls_hash == walls_hash;
    v->walls.walls = jox_seam_walls_of(&v->seam_walls, walls, crowd->storeys);
    if (!same)
        jox_wall_grid_reset(&v->walls, 2.0f * (float)JOX_VORONOI_CUTOFF);
    v->walls_hash = walls_hash;
    gather_crowd_sites(v, crowd);
    for (uint32_t i = 0; i < crowd->count; i++) {
        JoxCell cell;
        double area, within;
        if (!(here[i] >= JOX_VORONOI_LEAST))
            continue;
        gather_walls_near_point(v, v->sites.points[i]);
        v->sites.bars = v->near.count ? &v->near : NULL;
        jox_sites_cell(&v->sites, i, JOX_VORONOI_CUTOFF, &cell);
        jox_cell_visible_area(&cell, v->sites.points[i], &v->near, NULL, 0, &area, &within);
        if (area > 0.0)
            out[i] = (float)(1.0 / area);
    }
}

void jox_voronoi_people_free(JoxVoronoiPeople *v) {
    jox_sites_free(&v->sites);
    jox_free(v->near.items);
    jox_wall_grid_free(&v->walls);
    jox_seam_walls_free(&v->seam_walls);
    *v = (JoxVoronoiPeople){0};
}
