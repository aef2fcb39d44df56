#include "world/turn_chests.h"

#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "base/sort.h"
#include "world/world.h"

/* Share of its depth by which a torso may begin in another; discs may so, too. */
static const float DEEP = 0.25f;
static const float SKIN = 1e-3f; /* m: lesser overlaps, and gains by turning, count as none */
static const double TURN = 15.0; /* degrees */
enum { MOST_TURNS = 6, SWEEPS = 2 };

/* The agents near enough for their torsos to overlap with that of agent i, from `from` on:
   other[first[i - from]] to other[first[i - from + 1] - 1]. */
typedef struct Pairs {
    uint32_t from, *first, *other;
} Pairs;

/* The agents from some index on, in rows along x that are as high as two of them reach at most;
   within a row by x. */
typedef struct Rows {
    const JoxAgents *agents;
    uint32_t *order;   /* indices of agents */
    uint32_t *first;   /* by row: where it begins in `order`, and the number of agents at the end */
    uint32_t count;    /* of rows */
    float low, height; /* m */
    float widest;      /* m: greatest reach of any torso */
} Rows;

/* Returns the row of a height y, m; those beyond the last row are in it. */
static uint32_t find_row(const Rows *rows, float y) {
    const float row = floorf((y - rows->low) / rows->height);
    return row > 0.0f ? (uint32_t)jox_minf(row, (float)(rows->count - 1)) : 0;
}

static int compare_in_rows(const void *left, const void *right, const void *context) {
    const Rows *rows = context;
    const uint32_t i = *(const uint32_t *)left, j = *(const uint32_t *)right;
    const uint32_t a = find_row(rows, rows->agents->y[i]), b = find_row(rows, rows->agents->y[j]);
    const float x = rows->agents->x[i], other = rows->agents->x[j];
    return a != b ? (a < b ? -1 : 1) : x < other ? -1 : x > other;
}

/* Returns how far a torso reaches from its centre at most, m. */
static float find_outer_reach(const JoxTorsos *t, uint32_t i) {
    return t->radius[i] + jox_length((JoxV2){t->axis_x[i], t->axis_y[i]});
}

/* Puts the agents from `from` on into rows. */
static Rows lay_rows(const JoxAgents *a, uint32_t from) {
    const uint32_t count = a->count - from;
    Rows rows = {.agents = a,
                 .order = jox_alloc((size_t)count + 1, sizeof *rows.order),
                 .widest = jox_agents_widest(a, false)};
    float low = INFINITY, high = -INFINITY;
    for (uint32_t n = 0; n < count; n++) {
        rows.order[n] = from + n;
        low = jox_minf(low, a->y[from + n]);
        high = jox_maxf(high, a->y[from + n]);
    }
    rows.low = low;
    rows.height = jox_maxf(2.0f * rows.widest, (high - low) / (float)(count + 1));
    rows.count = 1;
    if (rows.height > 0.0f && high > low)
        rows.count += (uint32_t)jox_minf((high - low) / rows.height, (float)count);
    rows.height = rows.height > 0.0f ? rows.height : 1.0f;
    jox_sort(rows.order, count, sizeof *rows.order, compare_in_rows, &rows, NULL);
    rows.first = jox_alloc((size_t)rows.count + 1, sizeof *rows.first);
    for (uint32_t n = 0; n < count; n++)
        rows.first[find_row(&rows, a->y[rows.order[n]]) + 1]++;
    for (uint32_t r = 0; r < rows.count; r++)
        rows.first[r + 1] += rows.first[r];
    return rows;
}

/* Returns where in `order` the first agent of a row is that is not before x (m). */
static uint32_t find_first_from(const Rows *rows, uint32_t row, float x) {
    uint32_t low = rows->first[row], high = rows->first[row + 1];
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (rows->agents->x[rows->order[middle]] < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Visits the agents of `rows` that are near agent j, whose place is seen as (x, y); see
   visit_pairs. */
static void visit_near(const Rows *rows, const JoxTorsos *t, Pairs *pairs, uint32_t j, float x,
                       float y) {
    const JoxAgents *a = rows->agents;
    const float own = find_outer_reach(t, j), most = own + rows->widest;
    const uint32_t last = find_row(rows, y + most);
    for (uint32_t row = find_row(rows, y - most); row <= last; row++)
        for (uint32_t n = find_first_from(rows, row, x - most);
             n < rows->first[row + 1] && a->x[rows->order[n]] < x + most; n++) {
            const uint32_t i = rows->order[n];
            const float reach = own + find_outer_reach(t, i);
            if (i == j || jox_length2(jox_offset(a, i, j)) > reach * reach)
                continue;
            if (pairs->other)
                pairs->other[pairs->first[i - pairs->from]++] = j;
            else
                pairs->first[i - pairs->from + 1]++;
        }
}

/* Counts the pairs of each agent of `rows` in first[i - from + 1]; or, where `other` is there,
   lists them from first[i - from] on, which it raises. Images are those over joined edges. */
static void visit_pairs(const Rows *rows, const JoxTorsos *t, Pairs *pairs) {
    const JoxAgents *a = rows->agents;
    const int across = a->period.x > 0.0f, along = a->period.y > 0.0f; /* images to either side */
    for (uint32_t j = 0; j < a->count; j++)
        for (int right = -across; right <= across; right++)
            for (int up = -along; up <= along; up++)
                visit_near(rows, t, pairs, j, a->x[j] + (float)right * a->period.x,
                           a->y[j] + (float)up * a->period.y);
}

static Pairs list_pairs(const JoxAgents *a, const JoxTorsos *t, uint32_t from) {
    const uint32_t count = a->count - from;
    Rows rows = lay_rows(a, from);
    Pairs pairs = {.from = from, .first = jox_alloc((size_t)count + 2, sizeof *pairs.first)};
    visit_pairs(&rows, t, &pairs);
    for (uint32_t n = 0; n < count; n++)
        pairs.first[n + 1] += pairs.first[n];
    pairs.other = jox_alloc((size_t)pairs.first[count] + 1, sizeof *pairs.other);
    visit_pairs(&rows, t, &pairs);
    memmove(pairs.first + 1, pairs.first, count * sizeof *pairs.first); /* as before listing */
    pairs.first[0] = 0;
    jox_free(rows.order);
    jox_free(rows.first);
    return pairs;
}

/* Returns how deep the torso of agent i is in another, m. */
static float find_depth(const JoxAgents *a, const JoxTorsos *t, const Pairs *pairs, uint32_t i) {
    float most = 0.0f;
    const uint32_t *range = pairs->first + (i - pairs->from);
    for (uint32_t k = range[0]; k < range[1]; k++)
        most = jox_maxf(most, -jox_torsos_gap(t, a, i, pairs->other[k]));
    return most;
}

static void turn_chest(JoxAgents *a, JoxTorsos *t, uint32_t i, JoxV2 chest) {
    const float half = jox_length((JoxV2){t->axis_x[i], t->axis_y[i]});
    a->chest_x[i] = chest.x;
    a->chest_y[i] = chest.y;
    t->axis_x[i] = -chest.y * half;
    t->axis_y[i] = chest.x * half;
}

/* Turns the chest of agent i to where its torso is least deep in others: by the least of the angles
   that serve as well, up to a quarter of a turn to either side. */
static void turn_out_of_others(JoxAgents *a, JoxTorsos *t, const Pairs *pairs, uint32_t i) {
    const JoxV2 chest = {a->chest_x[i], a->chest_y[i]};
    float least = find_depth(a, t, pairs, i);
    JoxV2 best = chest;
    if (least <= SKIN)
        return;
    for (int k = 2; k <= 2 * MOST_TURNS + 1 && least > SKIN; k++) {
        const double angle = (k % 2 ? -1 : 1) * (k / 2) * TURN * JOX_DEGREE;
        const JoxV2 along = {(float)jox_cos(angle), (float)jox_sin(angle)};
        turn_chest(
            a, t, i,
            (JoxV2){chest.x * along.x - chest.y * along.y, chest.x * along.y + chest.y * along.x});
        const float depth = find_depth(a, t, pairs, i);
        if (depth >= least - SKIN)
            continue;
        least = depth;
        best = (JoxV2){a->chest_x[i], a->chest_y[i]};
    }
    turn_chest(a, t, i, jox_unit(best));
}

float *jox_chests_turn(JoxAgents *a, JoxTorsos *t, uint32_t from) {
    float *depths = jox_alloc((size_t)(a->count - from) + 1, sizeof *depths);
    Pairs pairs = list_pairs(a, t, from);
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (uint32_t i = from; i < a->count; i++)
            if (jox_length2((JoxV2){t->axis_x[i], t->axis_y[i]}) > 0.0f)
                turn_out_of_others(a, t, &pairs, i);
    for (uint32_t i = from; i < a->count; i++)
        depths[i - from] = find_depth(a, t, &pairs, i);
    jox_free(pairs.first);
    jox_free(pairs.other);
    return depths;
}

bool jox_torso_is_deep(const JoxTorsos *t, uint32_t i, float depth) {
    return depth > 2.0f * DEEP * t->radius[i];
}

void jox_world_turn_newcomers(JoWorld *world, uint32_t from) {
    JoxAgents *a = &world->state.agents;
    JoxStatistics *s = &world->state.statistics;
    JoxTorsos torsos = {0};
    if (from == a->count || !jox_torsos_list(&torsos, a, world->model.def.literal))
        return;
    float *depths = jox_chests_turn(a, &torsos, from);
    for (uint32_t i = from; i < a->count; i++) {
        if (!jox_torso_is_deep(&torsos, i, depths[i - from]))
            continue;
        s->born_in_others++;
        s->deepest_birth = fmax(s->deepest_birth, (double)depths[i - from]);
    }
    jox_free(depths);
    jox_torsos_free(&torsos);
}
