/* The nearest neighbours of one agent at a time, in plain C. The kernel of perceive calls it for
   agents with too many candidates for its lists, and for agents whose neighbour lists do not cover
   touch range; jox_nav_plan calls it between two steps. */
#include <math.h>

#include "agents/torso.h"
#include "base/number/bits.h"
#include "base/number/pi.h"
#include "geom/polygon.h"
#include "nav/near/perceive.h"

/* Returns the key of a candidate, which sorts by distance, then id: the bits of the squared
   distance (never negative) above the rank, which ascends with the id. */
static inline uint64_t make_sort_key(float d2, uint32_t rank) {
    return (uint64_t)jox_float_bits(d2) << 32 | rank;
}

static inline float read_distance2(uint64_t key) {
    return jox_float_of((uint32_t)(key >> 32));
}

enum { BUFFER = 64 };

/* The `most` nearest candidates so far, in ascending order, padded with UINT64_MAX; and a buffer of
   candidates still to be sorted in. */
typedef struct Nearest {
    uint64_t keys[JOX_MOST_NEIGHBOURS];
    uint64_t waiting[BUFFER];
    uint32_t count, most, waits;
    /* By reach: candidates are as near as the farthest of their surface may be, at most `beyond` m;
       else as their centres are. */
    bool by_reach, discs; /* discs: all are, as in literal mode */
    float beyond;
    const JoxSeam *seam; /* candidates count if they are seen through it; NULL: all do */
    JoxV2 before;        /* m, in plan: from where */
} Nearest;

static void clear_nearest(Nearest *n) {
    n->count = n->waits = 0;
    for (uint32_t k = 0; k < n->most; k++)
        n->keys[k] = UINT64_MAX;
}

/* Sorts the buffered candidates in, without branches: each key is compared with all slots, and the
   greater one goes on. */
static void sort_in_waiting(Nearest *n) {
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

/* Returns the square of how far a point is from what agent j may reach, m2; d2: from its centre. */
static inline float find_reached2(const JoxAgents *a, uint32_t j, float d2, bool discs) {
    const JoxTorso torso = jox_agent_torso(a, j, discs);
    const float beyond = jox_maxf(0.0f, sqrtf(d2) - (torso.radius + torso.half));
    return beyond * beyond;
}

/* Returns whether agent j is seen through the seam. */
static bool sees_through(const JoxAgents *a, uint32_t j, const Nearest *found) {
    const JoxV2 at = {a->x[j], a->y[j] - (float)found->seam->there * a->pitch};
    return jox_sheet_of(a->storeys, a->y[j]) == found->seam->there &&
           jox_seam_lets_see(found->seam, found->before, at);
}

/* Buffers agent j as a candidate if it is not agent i and lies within the radius of a point. */
static inline void buffer_candidate(const JoxAgents *a, uint32_t i, uint32_t j, JoxV2 point,
                                    float radius2, Nearest *found) {
    const float dx = a->x[j] - point.x, dy = a->y[j] - point.y, d2 = dx * dx + dy * dy;
    const float near2 = found->by_reach ? find_reached2(a, j, d2, found->discs) : d2;
    const float most2 = found->by_reach ? found->beyond * found->beyond : radius2;
    if (found->seam && !sees_through(a, j, found))
        return;
    found->waiting[found->waits] = make_sort_key(near2, a->rank[j]);
    found->waits +=
        (d2 <= radius2) & (near2 <= most2) &
        (j != i); /* overwritten by the next candidate if it does not count; no branch */
    if (found->waits == BUFFER)
        sort_in_waiting(found);
}

/* Buffers the agents within `radius` (m) of a point, except agent i, among all agents. */
static void search_all(const JoxAgents *a, uint32_t i, JoxV2 point, float radius, Nearest *found) {
    for (uint32_t j = 0; j < a->count; j++)
        buffer_candidate(a, i, j, point, radius * radius, found);
}

/* Does the same by the cells of the grid. */
static void search_cells(const JoxNav *nav, const JoxAgents *a, uint32_t i, JoxV2 point,
                         float radius, Nearest *found) {
    const float x = point.x, y = point.y, r2 = radius * radius;
    const JoxV2 least = nav->drift.least, most = nav->drift.most;
    const uint32_t left = jox_column_of(nav, x - radius - most.x);
    const uint32_t right = jox_column_of(nav, x + radius - least.x);
    const uint32_t low = jox_row_about(nav, y, y - radius - most.y);
    const uint32_t high = jox_row_about(nav, y, y + radius - least.y);
    JOX_ASSERT(low <= high && high < nav->rows && left <= right && right < nav->columns);
    for (uint32_t row = low; row <= high; row++) {
        const uint32_t *first = nav->cell_first + (size_t)row * nav->columns;
        for (uint32_t j = first[left]; j < first[right + 1]; j++)
            buffer_candidate(a, i, j, point, r2, found);
    }
    for (uint32_t k = 0; k < nav->stray_count; k++) { /* strays stand outside of their cells */
        const uint32_t stray = nav->strays[k];
        const uint32_t row = a->cell[stray] / nav->columns, column = a->cell[stray] % nav->columns;
        if (row < low || row > high || column < left || column > right) /* else buffered above */
            buffer_candidate(a, i, stray, point, r2, found);
    }
}

/* Buffers the agents within `radius` (m) of agent i that it sees through the seams of its sheet. */
static void search_through_seams(const JoxNav *nav, const JoxAgents *a, uint32_t i, float radius,
                                 Nearest *found) {
    const JoxStoreys *s = a->storeys;
    const JoxV2 point = {a->x[i], a->y[i]};
    const JoxSheet *sheet = &s->sheets[jox_sheet_of(s, point.y)];
    for (uint32_t k = sheet->first_seam; k < sheet->first_seam + sheet->seam_count; k++) {
        found->seam = &s->seams[k];
        found->before = jox_in_plan(s, point);
        const JoxV2 image = {point.x, point.y + found->seam->shift};
        const JoxV2 nearest = jox_segment_nearest(found->seam->a, found->seam->b, found->before);
        const float wide = radius + (nav ? nav->drift.farthest : 0.0f);
        if (jox_length2(jox_sub(nearest, found->before)) > wide * wide)
            continue;
        if (nav)
            search_cells(nav, a, i, image, radius, found);
        else
            search_all(a, i, image, radius, found);
    }
    found->seam = NULL;
}

/* Finds the agents nearest to agent i within `radius` (m), over periodic edges and seams too.
   Without `nav` all agents are candidates: between two steps the grid may be out of date. */
static void search_nearest(const JoxNav *nav, const JoxAgents *a, uint32_t i, float radius,
                           Nearest *found) {
    JoxV2 point = {a->x[i], a->y[i]};
    float wide = radius + (nav ? nav->drift.farthest : 0.0f);
    clear_nearest(found);
    for (int row = -1; row <= 1; row++)
        for (int column = -1; column <= 1; column++)
            if (jox_sees_image(point.x, a->origin.x, a->period.x, wide, column) &&
                jox_sees_image(point.y, a->origin.y, a->period.y, wide, row)) {
                const JoxV2 image =
                    jox_add(point, (JoxV2){(float)column * a->period.x, (float)row * a->period.y});
                if (nav)
                    search_cells(nav, a, i, image, radius, found);
                else
                    search_all(a, i, image, radius, found);
            }
    if (a->storeys)
        search_through_seams(nav, a, i, radius, found);
    sort_in_waiting(found);
    found->count = found->count < found->most ? found->count : found->most;
}

void jox_perceive_touching(const JoxPerceive *p, uint32_t i, float range) {
    const JoxAgents *a = p->agents;
    JoxNeighbours *out = p->out;
    const JoxTorso own = jox_agent_torso(a, i, p->nav->literal);
    Nearest found = {.most = JOX_MOST_NEIGHBOURS,
                     .by_reach = true,
                     .discs = p->nav->literal,
                     .beyond = own.radius + own.half + JOX_TOUCH_LEAST + JOX_TOUCH_MOST};
    search_nearest(p->nav, a, i, range, &found);
    out->touch_count[i] = (uint8_t)found.count;
    for (uint32_t k = 0; k < found.count; k++)
        out->touch_index[(size_t)i * JOX_MOST_NEIGHBOURS + k] = a->by_rank[(uint32_t)found.keys[k]];
}

/* Lists the neighbours found for agent i. */
static void list_nearest(const JoxAgents *a, uint32_t i, const Nearest *found, JoxNeighbours *out) {
    const float touch = jox_touch_most(out);
    uint32_t close = 0;
    for (uint32_t k = 0; k < found->count; k++) {
        out->index[jox_neighbour_at(out, i, k)] = a->by_rank[(uint32_t)found->keys[k]];
        close += read_distance2(found->keys[k]) <= touch * touch;
    }
    out->count[i] = (uint8_t)found->count;
    out->close[i] = (uint8_t)close;
    if (found->count > JOX_CROWD_RANK)
        out->crowding2[i] = read_distance2(found->keys[JOX_CROWD_RANK]);
}

/* Writes the neighbours found for agent i, and its columns. */
static void write_nearest(const JoxPerceive *p, uint32_t i, float perception,
                          const Nearest *found) {
    const JoxAgents *a = p->agents;
    bool full = found->most > 0 && found->count == found->most;
    float reach = full ? sqrtf(read_distance2(found->keys[found->count - 1])) : perception;
    a->search_radius[i] = jox_maxf(reach, JOX_SEARCH_LEAST);
    a->density[i] =
        (float)found->count / ((float)JOX_PI * jox_maxf(reach * reach, JOX_DENSITY_LEAST));
    list_nearest(a, i, found, p->out);
}

void jox_perceive_one(const JoxPerceive *p, uint32_t i, float radius) {
    const JoxAgents *a = p->agents;
    const float perception = jox_minf(jox_param(a, JOX_PARAM_perception, i), p->sight);
    Nearest found;
    found.most = (uint32_t)jox_param(a, JOX_PARAM_neighbours, i);
    found.by_reach = false;
    found.seam = NULL;
    clear_nearest(&found);
    for (bool again = found.most > 0; again;) {
        radius = jox_minf(radius, perception);
        search_nearest(p->nav, a, i, radius, &found);
        again = found.count < found.most && radius < perception;
        radius *= JOX_SEARCH_GROWTH;
    }
    write_nearest(p, i, perception, &found);
}

float jox_nav_sight(const JoxAgents *a) {
    float most = a->period.x > 0.0f ? 0.49f * a->period.x : INFINITY;
    const float along = a->pitch > 0.0f ? a->pitch : a->period.y;
    return along > 0.0f ? jox_minf(most, 0.49f * along) : most;
}

/* Returns the torso of agent i as shape_wide.c computes it. */
static JoxTorsoShape find_shape(const JoxAgents *a, uint32_t i, bool discs) {
    const JoxTorso torso = jox_agent_torso(a, i, discs);
    const bool is_long = torso.half > 0.0f;
    return (JoxTorsoShape){-a->chest_y[i] * torso.half, a->chest_x[i] * torso.half, torso.radius,
                           is_long ? 1.0f / (torso.half * torso.half) : 0.0f};
}

void jox_perceive_alone(const JoxAgents *a, uint32_t i, bool discs, JoxNeighbours *out) {
    Nearest found = {.most = (uint32_t)jox_param(a, JOX_PARAM_neighbours, i)};
    jox_neighbours_reserve(out, a->count, found.most > 0 ? found.most : 1);
    out->widest = jox_agents_widest(a, discs);
    out->has_torsos = !discs && jox_agents_have_torsos(a);
    search_nearest(NULL, a, i, jox_minf(jox_param(a, JOX_PARAM_perception, i), jox_nav_sight(a)),
                   &found);
    list_nearest(a, i, &found, out);
    out->shapes[i] = find_shape(a, i, discs);
    for (uint32_t n = 0; n < found.count; n++) {
        const uint32_t j = out->index[jox_neighbour_at(out, i, n)];
        out->shapes[j] = find_shape(a, j, discs);
    }
}
