/* The nearest of one agent at a time, in plain C: for those whom packets of lanes leave over, and
   for those within touching range where the neighbours may lack some. */
#include <math.h>

#include "base/number/bits.h"
#include "base/number/pi.h"
#include "nav/kernels.h"

/* A candidate as one number that sorts by distance, then id: bits of the squared distance (which is
   not negative) above the rank, in which agents have the order of their ids. */
static inline uint64_t key_of(float d2, uint32_t rank) {
    return (uint64_t)jox_float_bits(d2) << 32 | rank;
}

static inline float distance2_of(uint64_t key) {
    return jox_float_of((uint32_t)(key >> 32));
}

enum { BUFFER = 64 };

/* The `most` nearest so far, ascending, the rest UINT64_MAX; and candidates not yet sorted in. */
typedef struct Nearest {
    uint64_t keys[JOX_MOST_NEIGHBOURS];
    uint64_t waiting[BUFFER];
    uint32_t count, most, waits;
} Nearest;

static void clear(Nearest *n) {
    n->count = n->waits = 0;
    for (uint32_t k = 0; k < n->most; k++)
        n->keys[k] = UINT64_MAX;
}

/* Sorts the waiting in. Without branches: each key sinks through all slots, the greater goes on. */
static void sort_in(Nearest *n) {
    JOX_ASSERT(n->waits <= BUFFER && n->most <= JOX_MOST_NEIGHBOURS);
    for (uint32_t w = 0; w < n->waits; w++) {
        uint64_t key = n->waiting[w];
        for (uint32_t k = 0; k < n->most; k++) {
            uint64_t here = n->keys[k];
            n->keys[k] = key < here ? key : here;
            key = key < here ? here : key;
        }
    }
    n->count += n->waits;
    n->waits = 0;
}

/* Adds agent j if it is within a radius of a point, and not agent i. */
static inline void consider(const JoxAgents *a, uint32_t i, uint32_t j, JoxV2 point, float radius2,
                            Nearest *found) {
    const float dx = a->x[j] - point.x, dy = a->y[j] - point.y, d2 = dx * dx + dy * dy;
    found->waiting[found->waits] = key_of(d2, a->rank[j]);
    found->waits += (d2 <= radius2) & (j != i); /* kept or written over, without a branch */
    if (found->waits == BUFFER)
        sort_in(found);
}

/* Adds the agents within `radius` of a point, but not agent i. */
static void search_about(const JoxNav *nav, const JoxAgents *a, uint32_t i, JoxV2 point,
                         float radius, Nearest *found) {
    const float x = point.x, y = point.y, r2 = radius * radius;
    const JoxV2 least = nav->drift.least, most = nav->drift.most;
    const uint32_t left = jox_column_of(nav, x - radius - most.x);
    const uint32_t right = jox_column_of(nav, x + radius - least.x);
    const uint32_t low = jox_row_of(nav, y - radius - most.y);
    const uint32_t high = jox_row_of(nav, y + radius - least.y);
    JOX_ASSERT(low <= high && high < nav->rows && left <= right && right < nav->columns);
    for (uint32_t row = low; row <= high; row++) {
        const uint32_t *first = nav->cell_first + (size_t)row * nav->columns;
        for (uint32_t j = first[left]; j < first[right + 1]; j++)
            consider(a, i, j, point, r2, found);
    }
    for (uint32_t k = 0; k < nav->stray_count; k++) /* far from where their cells are */
        consider(a, i, nav->strays[k], point, r2, found);
}

/* Finds the nearest agents within `radius` of agent i. */
static void search(const JoxNav *nav, const JoxAgents *a, uint32_t i, float radius,
                   Nearest *found) {
    JoxV2 point = {a->x[i], a->y[i]};
    float wide = radius + nav->drift.farthest;
    clear(found);
    for (int row = -1; row <= 1; row++)
        for (int column = -1; column <= 1; column++)
            if (jox_sees_image(point.x, a->origin.x, a->period.x, wide, column) &&
                jox_sees_image(point.y, a->origin.y, a->period.y, wide, row))
                search_about(
                    nav, a, i,
                    jox_add(point, (JoxV2){(float)column * a->period.x, (float)row * a->period.y}),
                    radius, found);
    sort_in(found);
    found->count = found->count < found->most ? found->count : found->most;
}

void jox_perceive_touching(const JoxPerceive *p, uint32_t i, float range) {
    const JoxAgents *a = p->agents;
    JoxNeighbours *out = p->out;
    Nearest found = {.most = JOX_MOST_NEIGHBOURS};
    search(p->nav, a, i, range, &found);
    out->touch_count[i] = (uint8_t)found.count;
    for (uint32_t k = 0; k < found.count; k++)
        out->touch_index[(size_t)i * JOX_MOST_NEIGHBOURS + k] = a->by_rank[(uint32_t)found.keys[k]];
}

/* Writes what was found of agent i. */
static void keep(const JoxPerceive *p, uint32_t i, float perception, const Nearest *found) {
    const JoxAgents *a = p->agents;
    bool full = found->most > 0 && found->count == found->most;
    float reach = full ? sqrtf(distance2_of(found->keys[found->count - 1])) : perception;
    a->search[i] = jox_maxf(reach, JOX_SEARCH_LEAST);
    a->density[i] =
        (float)found->count / ((float)JOX_PI * jox_maxf(reach * reach, JOX_DENSITY_LEAST));
    const float touch = jox_touch_most(p->out);
    uint32_t close = 0;
    for (uint32_t k = 0; k < found->count; k++) {
        p->out->index[jox_neighbour_at(p->out, i, k)] = a->by_rank[(uint32_t)found->keys[k]];
        close += distance2_of(found->keys[k]) <= touch * touch;
    }
    p->out->count[i] = (uint8_t)found->count;
    p->out->close[i] = (uint8_t)close;
    if (found->count > JOX_CROWD_RANK)
        p->out->crowding2[i] = distance2_of(found->keys[JOX_CROWD_RANK]);
}

void jox_perceive_one(const JoxPerceive *p, uint32_t i, float radius) {
    const JoxAgents *a = p->agents;
    const float perception = jox_minf(jox_param(a, JOX_PARAM_perception, i), p->sight);
    Nearest found;
    found.most = (uint32_t)jox_param(a, JOX_PARAM_neighbours, i);
    clear(&found);
    for (bool again = found.most > 0; again;) {
        radius = jox_minf(radius, perception);
        search(p->nav, a, i, radius, &found);
        again = found.count < found.most && radius < perception;
        radius *= JOX_SEARCH_GROWTH;
    }
    keep(p, i, perception, &found);
}
