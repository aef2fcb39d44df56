/* Loads of walls, by piece of an edge; stage.c measures them once the contacts are solved. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "force/contact/contacts.h"

static const float PIECE = 1.0f; /* m: greatest length of a piece */

static float measure_edge(const JoxWalls *walls, uint32_t edge) {
    const JoxWallVertex *v = &walls->vertices[edge];
    return jox_length(jox_sub(walls->vertices[v->next].point, v->point));
}

void jox_forces_set_walls(JoxForces *f, const JoxWalls *walls, const JoxWallImages *images) {
    JoxWallLoads *loads = &f->contacts->wall_loads;
    loads->walls = walls;
    loads->images = images;
    uint32_t edges = walls ? walls->count : 0, pieces = 0;
    JOX_RESERVE(loads->first_piece, loads->first_piece_capacity, (size_t)edges + 1);
    for (uint32_t e = 0; e < edges; e++) {
        loads->first_piece[e] = pieces;
        pieces += (uint32_t)ceilf(jox_maxf(measure_edge(walls, e) / PIECE - 1e-3f, 1e-3f));
    }
    loads->first_piece[edges] = pieces;
    JOX_RESERVE(loads->items, loads->capacity, pieces);
    loads->count = pieces;
    for (uint32_t e = 0; e < edges; e++) {
        const JoxWallVertex *v = &walls->vertices[e];
        uint32_t n = loads->first_piece[e + 1] - loads->first_piece[e];
        float length = measure_edge(walls, e) / (float)n;
        for (uint32_t k = 0; k < n; k++)
            loads->items[loads->first_piece[e] + k] = (JoxWallLoad){
                .edge = e,
                .from = jox_add(v->point, jox_scale(v->direction, (float)k * length)),
                .to = jox_add(v->point, jox_scale(v->direction, (float)(k + 1) * length))};
    }
}

void jox_wall_loads_measure(JoxForces *f) {
    JoxWallLoads *loads = &f->contacts->wall_loads;
    JoxWallContacts *walls = &f->contacts->walls;
    for (uint32_t k = 0; k < loads->count; k++)
        loads->items[k].load = 0.0f;
    for (uint32_t k = 0; k < walls->count && loads->walls; k++) {
        const JoxWallContact *w = &walls->items[k];
        uint32_t first = loads->first_piece[w->edge], n = loads->first_piece[w->edge + 1] - first;
        float length = measure_edge(loads->walls, w->edge) / (float)n;
        uint32_t piece = length > 0.0f ? (uint32_t)(w->along / length) : 0;
        JOX_ASSERT(w->edge < loads->walls->count && n > 0);
        loads->items[first + (piece < n ? piece : n - 1)].load +=
            w->impulse / (float)f->step.timing.dt;
    }
}

const JoxWallLoad *jox_force_wall_loads(const JoxForces *f, uint32_t *count) {
    const JoxWallLoads *loads = &f->contacts->wall_loads;
    *count = loads->count;
    return loads->items;
}

void jox_wall_loads_free(JoxWallLoads *loads) {
    jox_free(loads->items);
    jox_free(loads->first_piece);
}
