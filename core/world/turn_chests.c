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

static int compare_x(const void *left, const void *right, const void *context) {
    const float *x = ((const JoxAgents *)context)->x;
    const float a = x[*(const uint32_t *)left], b = x[*(const uint32_t *)right];
    return a < b ? -1 : a > b;
}

/* Returns how far a torso reaches from its centre at most, m. */
static float find_outer_reach(const JoxTorsos *t, uint32_t i) {
    return t->radius[i] + jox_length((JoxV2){t->axis_x[i], t->axis_y[i]});
}

/* Returns the index of the first of `count` agents, ordered by x, that is not before x (m). */
static uint32_t find_first_from(const JoxAgents *a, const uint32_t *order, uint32_t count,
                                float x) {
    uint32_t low = 0, high = count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (a->x[order[middle]] < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Counts the pairs of each agent from `from` on in first[i - from + 1]; or, where `other` is there,
   lists them from first[i - from] on, which it raises. `order`: those agents by x. */
static void visit_pairs(const JoxAgents *a, const JoxTorsos *t, const uint32_t *order,
                        Pairs *pairs) {
    const uint32_t from = pairs->from, count = a->count - from;
    const float widest = jox_agents_widest(a, false);
    const int images = a->period.x > 0.0f; /* to either side */
    for (uint32_t j = 0; j < a->count; j++) {
        const float own = find_outer_reach(t, j);
        for (int image = -images; image <= images; image++) {
            const float x = a->x[j] + (float)image * a->period.x;
            for (uint32_t n = find_first_from(a, order, count, x - own - widest);
                 n < count && a->x[order[n]] < x + own + widest; n++) {
                const uint32_t i = order[n];
                const float reach = own + find_outer_reach(t, i);
                if (i == j || jox_length2(jox_offset(a, i, j)) > reach * reach)
                    continue;
                if (pairs->other)
                    pairs->other[pairs->first[i - from]++] = j;
                else
                    pairs->first[i - from + 1]++;
            }
        }
    }
}

static Pairs list_pairs(const JoxAgents *a, const JoxTorsos *t, uint32_t from) {
    const uint32_t count = a->count - from;
    uint32_t *order = jox_alloc((size_t)count + 1, sizeof *order);
    Pairs pairs = {.from = from, .first = jox_alloc((size_t)count + 2, sizeof *pairs.first)};
    for (uint32_t n = 0; n < count; n++)
        order[n] = from + n;
    jox_sort(order, count, sizeof *order, compare_x, a, NULL);
    visit_pairs(a, t, order, &pairs);
    for (uint32_t n = 0; n < count; n++)
        pairs.first[n + 1] += pairs.first[n];
    pairs.other = jox_alloc((size_t)pairs.first[count] + 1, sizeof *pairs.other);
    visit_pairs(a, t, order, &pairs);
    memmove(pairs.first + 1, pairs.first, count * sizeof *pairs.first); /* as before listing */
    pairs.first[0] = 0;
    jox_free(order);
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
