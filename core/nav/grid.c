/* Sorted grid: rows of fixed height, agents sorted along x within a row, the rows one after the
   other in memory. Between sorts agents drift, so ranges are widened by the greatest drift. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "nav/internal.h"

static const float ROW_HEIGHT = 0.8f; /* m: about the distance of the tenth neighbour */
static const float SLACK = 0.03f;     /* m: growth of the last search radius that is tried first */
enum { SORT_EVERY = 4, MOST_ROWS = 1 << 15 };

/* Bits of a float in an order that unsigned comparison understands. */
static uint32_t ordered_bits(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

/* Stable radix sort of keys[0] / order[0] by the low 48 bits; six passes end where they began. */
static void radix_sort(JoxNav *nav, uint32_t count) {
    for (int pass = 0; pass < 6; pass++) {
        uint64_t *from = nav->keys[pass & 1], *to = nav->keys[~pass & 1];
        uint32_t *order = nav->order[pass & 1], *sorted = nav->order[~pass & 1];
        uint32_t start[256] = {0};
        for (uint32_t i = 0; i < count; i++)
            start[from[i] >> (8 * pass) & 255]++;
        for (uint32_t digit = 0, sum = 0; digit < 256; digit++) {
            uint32_t here = start[digit];
            start[digit] = sum;
            sum += here;
        }
        for (uint32_t i = 0; i < count; i++) {
            uint32_t at = start[from[i] >> (8 * pass) & 255]++;
            to[at] = from[i];
            sorted[at] = order[i];
        }
    }
}

static uint32_t row_of(const JoxNav *nav, float y) {
    float row = floorf((y - nav->low.y) / nav->height);
    return row <= 0.0f ? 0 : row >= (float)(nav->rows - 1) ? nav->rows - 1 : (uint32_t)row;
}

static void fit_rows(JoxNav *nav, const JoxAgents *a) {
    JoxV2 high = {-INFINITY, -INFINITY};
    nav->low = (JoxV2){INFINITY, INFINITY};
    for (uint32_t i = 0; i < a->count; i++) {
        nav->low.x = jox_minf(nav->low.x, a->x[i]);
        nav->low.y = jox_minf(nav->low.y, a->y[i]);
        high.y = jox_maxf(high.y, a->y[i]);
    }
    nav->height = jox_maxf(ROW_HEIGHT, (high.y - nav->low.y) / (MOST_ROWS - 1));
    nav->rows = (uint32_t)((high.y - nav->low.y) / nav->height) + 1;
    if (nav->rows + 1 > nav->row_capacity) {
        nav->row_capacity = nav->rows + nav->rows / 4 + 64;
        nav->row_first = jox_realloc(nav->row_first, nav->row_capacity, sizeof(uint32_t));
    }
}

void jox_nav_sort(JoxNav *nav, JoxAgents *a, uint64_t tick) {
    bool same =
        nav->sorted_count == a->count && nav->sorted_next_id == a->next_id && isfinite(nav->drift);
    if ((same && tick % SORT_EVERY != 0) || a->count == 0) {
        nav->sorted_count = a->count;
        return;
    }
    jox_nav_reserve(nav, a->count);
    fit_rows(nav, a);
    jox_agents_by_id(a, nav->order[0]); /* a stable sort from here breaks ties by id */
    for (uint32_t i = 0; i < a->count; i++) {
        uint32_t at = nav->order[0][i];
        nav->keys[0][i] = (uint64_t)row_of(nav, a->y[at]) << 32 | ordered_bits(a->x[at]);
    }
    radix_sort(nav, a->count);
    uint32_t row = 0;
    for (uint32_t i = 0; i < a->count; i++)
        for (uint32_t here = (uint32_t)(nav->keys[0][i] >> 32); row <= here; row++)
            nav->row_first[row] = i;
    for (; row <= nav->rows; row++)
        nav->row_first[row] = a->count;
    jox_agents_permute(a, nav->order[0]);
    memcpy(nav->sorted_x, a->x, a->count * sizeof(float));
    nav->sorted_count = a->count;
    nav->sorted_next_id = a->next_id;
    nav->drift = 0.0f;
    JOX_CHECK(jox_nav_rows_check(nav, a));
}

/* A candidate as one number that sorts by distance, then id: bits of the squared distance (which is
   not negative) above the rank, in which agents have the order of their ids. */
static inline uint64_t key_of(float d2, uint32_t rank) {
    uint32_t bits;
    memcpy(&bits, &d2, sizeof bits);
    return (uint64_t)bits << 32 | rank;
}

static inline float distance2_of(uint64_t key) {
    uint32_t bits = (uint32_t)(key >> 32);
    float d2;
    memcpy(&d2, &bits, sizeof d2);
    return d2;
}

enum { BUFFER = 64 };

/* The `most` nearest so far, ascending, the rest UINT64_MAX; and candidates not yet sorted in. */
typedef struct Nearest {
    uint64_t keys[JOX_MOST_NEIGHBOURS];
    uint64_t waiting[BUFFER];
    uint32_t count, most, waits;
} Nearest;

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

/* First agent of a row whose x when sorted is at least `x`. Walks from a hint: neighbours in memory
   ask for nearly the same place, and the answer does not depend on the hint. */
static inline uint32_t row_from(const JoxNav *nav, uint32_t row, float x, uint32_t hint) {
    JOX_ASSERT(row < nav->rows);
    uint32_t first = nav->row_first[row], end = nav->row_first[row + 1];
    const float *sx = nav->sorted_x;
    if (hint < first || hint > end || (hint > first + 32 && sx[hint - 32] >= x) ||
        (hint + 32 < end && sx[hint + 32] < x)) {
        uint32_t low = first, high = end;
        while (low < high) {
            uint32_t middle = (low + high) / 2;
            if (sx[middle] < x)
                low = middle + 1;
            else
                high = middle;
        }
        return low;
    }
    while (hint > first && sx[hint - 1] >= x)
        hint--;
    while (hint < end && sx[hint] < x)
        hint++;
    return hint;
}

typedef struct Perceive {
    JoxNav *nav;
    JoxAgents *agents;
    JoxNeighbours *out;
} Perceive;

enum { HINTS = 16 };

/* Adds the agents within `radius` of a point, but not agent i. */
static void search_about(const JoxNav *nav, const JoxAgents *a, uint32_t i, JoxV2 point,
                         float radius, Nearest *found, uint32_t hints[HINTS]) {
    const float x = point.x, y = point.y, r2 = radius * radius;
    const float *ax = a->x, *ay = a->y;
    const uint32_t *rank = a->rank;
    float wide = radius + nav->drift;
    uint32_t low = row_of(nav, y - wide), high = row_of(nav, y + wide);
    JOX_ASSERT(low <= high && high < nav->rows);
    for (uint32_t row = low; row <= high; row++) {
        uint32_t end = nav->row_first[row + 1], *hint = &hints[row % HINTS];
        uint32_t j = *hint = row_from(nav, row, x - wide, *hint);
        for (float stop = x + wide; j < end && nav->sorted_x[j] <= stop; j++) {
            float dx = ax[j] - x, dy = ay[j] - y, d2 = dx * dx + dy * dy;
            found->waiting[found->waits] = key_of(d2, rank[j]);
            found->waits += (d2 <= r2) & (j != i); /* kept or written over, without a branch */
            if (found->waits == BUFFER)
                sort_in(found);
        }
    }
}

/* Shifts to the images of a point along one axis, of which those beyond a periodic edge matter
   where the edge is within `wide`. Returns how many. */
static uint32_t images(float at, float origin, float period, float wide, float shifts[3]) {
    uint32_t count = 0;
    shifts[count++] = 0.0f;
    if (period > 0.0f && at - wide < origin)
        shifts[count++] = period;
    if (period > 0.0f && at + wide >= origin + period)
        shifts[count++] = -period;
    return count;
}

/* How far one sees: less than half a period, so that nobody is seen from two sides. */
static float sight(const JoxAgents *a, float perception) {
    float most = a->period.x > 0.0f ? 0.49f * a->period.x : INFINITY;
    most = a->period.y > 0.0f ? jox_minf(most, 0.49f * a->period.y) : most;
    return jox_minf(perception, most);
}

/* Finds the nearest agents within `radius` of agent i. */
static void search(const JoxNav *nav, const JoxAgents *a, uint32_t i, float radius, Nearest *found,
                   uint32_t hints[HINTS]) {
    JoxV2 point = {a->x[i], a->y[i]};
    float wide = radius + nav->drift, along[3], across[3];
    uint32_t columns = images(point.x, a->origin.x, a->period.x, wide, along);
    uint32_t rows = images(point.y, a->origin.y, a->period.y, wide, across);
    found->count = found->waits = 0;
    for (uint32_t k = 0; k < found->most; k++)
        found->keys[k] = UINT64_MAX;
    for (uint32_t row = 0; row < rows; row++)
        for (uint32_t column = 0; column < columns; column++)
            search_about(nav, a, i, jox_add(point, (JoxV2){along[column], across[row]}), radius,
                         found, hints);
    sort_in(found);
    found->count = found->count < found->most ? found->count : found->most;
}

/* Those within touching range, where the neighbours that agent i perceives up to `reach` may lack
   some. */
static void find_touching(const Perceive *p, uint32_t i, float reach, uint32_t hints[HINTS]) {
    const JoxAgents *a = p->agents;
    JoxNeighbours *out = p->out;
    float range = sight(a, jox_touch_reach(out, a->param[JOX_PARAM_radius][i]));
    out->touch_count[i] = JOX_TOUCH_IS_SEEN;
    if (reach >= range)
        return;
    Nearest found = {.most = JOX_MOST_NEIGHBOURS};
    search(p->nav, a, i, range, &found, hints);
    out->touch_count[i] = (uint8_t)found.count;
    for (uint32_t k = 0; k < found.count; k++)
        out->touch_index[(size_t)i * JOX_MOST_NEIGHBOURS + k] = a->by_rank[(uint32_t)found.keys[k]];
}

static void perceive_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    Perceive *p = context;
    JoxAgents *a = p->agents;
    uint32_t hints[HINTS] = {0};
    for (uint32_t i = begin; i < end; i++) {
        float perception = sight(a, a->param[JOX_PARAM_perception][i]);
        Nearest found = {.most = (uint32_t)a->param[JOX_PARAM_neighbours][i]};
        float radius = a->search[i] > 0.0f ? a->search[i] + SLACK : perception * 0.5f;
        for (bool again = found.most > 0; again;) {
            radius = jox_minf(radius, perception);
            search(p->nav, a, i, radius, &found, hints);
            again = found.count < found.most && radius < perception;
            radius *= 1.5f;
        }
        bool full = found.most > 0 && found.count == found.most;
        float reach = full ? sqrtf(distance2_of(found.keys[found.count - 1])) : perception;
        a->search[i] = jox_maxf(reach, 0.01f);
        find_touching(p, i, found.most > 0 ? reach : 0.0f, hints);
        /* people per square metre of the disc that holds the neighbours kept */
        float area = 3.14159265f * jox_maxf(reach * reach, 0.0025f);
        a->density[i] = (float)found.count / area;
        p->out->count[i] = (uint8_t)found.count;
        for (uint32_t k = 0; k < found.count; k++) {
            size_t at = jox_neighbour_at(p->out, i, k);
            p->out->index[at] = a->by_rank[(uint32_t)found.keys[k]];
            p->out->distance2[at] = distance2_of(found.keys[k]);
        }
    }
}

static void reserve_neighbours(JoxNeighbours *out, const JoxAgents *a) {
    uint32_t stride = 1;
    out->widest = 0.0f;
    for (uint32_t i = 0; i < a->count; i++) {
        if ((uint32_t)a->param[JOX_PARAM_neighbours][i] > stride)
            stride = (uint32_t)a->param[JOX_PARAM_neighbours][i];
        out->widest = jox_maxf(out->widest, a->param[JOX_PARAM_radius][i]);
    }
    jox_neighbours_reserve(out, a->count, stride);
}

void jox_nav_perceive(JoxNav *nav, JoxAgents *agents, JoxNeighbours *out, JoxPool *pool) {
    reserve_neighbours(out, agents);
    Perceive perceive = {nav, agents, out};
    jox_parallel_for(pool, agents->count, JOX_NAV_GRAIN, perceive_range, &perceive);
    JOX_CHECK(jox_neighbours_check(out, agents));
}
