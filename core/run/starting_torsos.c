/* The torsos of the people who are there when a scene starts. Spots are searched for discs, so
   broader torsos may begin in each other: their chests turn as far as they must, as people do who
   stand close. What is left is noted, and measures that hardly anybody wants. build_scene.c calls
   it. */
#include "run/starting_torsos.h"

#include <math.h>
#include <string.h>

#include "agents/torso.h"
#include "base/format/plurals.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "base/sort.h"
#include "run/run.h"

/* Ratio of the radius to half of the breadth, or of that to the radius, above which one of them is
   taken for a mistake. */
static const float FAR = 1.5f;
/* Share of its depth by which a torso may be in another at the start; discs may so, too. */
static const float DEEP = 0.25f;
static const float SKIN = 1e-3f; /* m: lesser overlaps, and gains by turning, count as none */
static const double TURN = 15.0; /* degrees */
enum { MOST_TURNS = 6, SWEEPS = 2 };

static void note_at_group(const JoxGroup *group, const char *code, const char *hint,
                          const char *text, JoxDiagnostics *diagnostics) {
    jox_diag_add(diagnostics, JOX_SEVERITY_NOTE, group->position, code, hint, NULL, NULL, "%s",
                 text);
}

/* Notes a torso that is deeper than broad, also where one of both is not given. Returns whether it
   is. */
static bool note_deep_torso(const JoxAgents *a, uint32_t i, const JoxGroup *group,
                            JoxDiagnostics *diagnostics) {
    const float radius = jox_param(a, JOX_PARAM_radius, i);
    const float breadth = jox_torso_breadth(jox_param(a, JOX_PARAM_breadth, i), radius),
                depth = jox_torso_depth(jox_param(a, JOX_PARAM_depth, i), radius);
    char text[200];
    if (!(depth > breadth))
        return false;
    snprintf(text, sizeof text,
             "people of group '%.60s' have a breadth of %.2f m and a depth of %.2f m: who is not "
             "broader than deep is a disc as wide as the breadth",
             group->name, (double)breadth, (double)depth);
    note_at_group(group, "deep-torso", "Are breadth and depth exchanged?", text, diagnostics);
    return true;
}

/* Notes a radius that is far from half of a given breadth. Returns whether it is. */
static bool note_far_radius(const JoxAgents *a, uint32_t i, const JoxGroup *group,
                            JoxDiagnostics *diagnostics) {
    const float half = 0.5f * jox_param(a, JOX_PARAM_breadth, i),
                radius = jox_param(a, JOX_PARAM_radius, i);
    char text[200], hint[80];
    if (!(half > 0.0f && (radius > FAR * half || half > FAR * radius)))
        return false;
    snprintf(text, sizeof text,
             "people of group '%.60s' keep room for a disc of %.2f m in radius as they walk, and "
             "their shoulders reach %.2f m",
             group->name, (double)radius, (double)half);
    snprintf(hint, sizeof hint, "radius: %.2g goes with a breadth of %.2g", 0.9 * (double)half,
             2.0 * (double)half);
    note_at_group(group, "torso-and-radius", hint, text, diagnostics);
    return true;
}

static void note_measures(const JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoxAgents *a = &scene->world->state.agents;
    const uint32_t groups = scene->spec->group_count;
    bool *deep = jox_alloc(groups + 1, sizeof *deep), *far = jox_alloc(groups + 1, sizeof *far);
    for (uint32_t i = 0; i < a->count; i++) {
        const uint32_t g = a->group[i];
        if (g >= groups)
            continue;
        deep[g] = deep[g] || note_deep_torso(a, i, &scene->spec->groups[g], diagnostics);
        far[g] = far[g] || note_far_radius(a, i, &scene->spec->groups[g], diagnostics);
    }
    jox_free(deep);
    jox_free(far);
}

/* ---- overlaps ---- */

/* The agents near enough for their torsos to overlap with that of agent i: other[first[i]] to
   other[first[i + 1] - 1]. */
typedef struct Pairs {
    uint32_t *first, *other;
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

/* Counts the pairs of each agent in first[i + 1]; or, where `other` is there, lists them from
   first[i] on, which it raises. */
static void visit_pairs(const JoxAgents *a, const JoxTorsos *t, const uint32_t *order,
                        uint32_t *first, uint32_t *other) {
    const float widest = jox_agents_widest(a, false);
    for (uint32_t m = 0; m < a->count; m++) {
        const uint32_t i = order[m];
        const float own = find_outer_reach(t, i);
        const uint32_t end = a->period.x > 0.0f ? m + a->count : a->count; /* on over the edge */
        for (uint32_t n = m + 1; n < end; n++) {
            const uint32_t j = order[n % a->count];
            const float reach = own + find_outer_reach(t, j);
            if (a->x[j] + (n < a->count ? 0.0f : a->period.x) - a->x[i] >= own + widest)
                break;
            if (jox_length2(jox_offset(a, i, j)) > reach * reach)
                continue;
            if (other) {
                other[first[i]++] = j;
                other[first[j]++] = i;
            } else {
                first[i + 1]++;
                first[j + 1]++;
            }
        }
    }
}

static Pairs list_pairs(const JoxAgents *a, const JoxTorsos *t) {
    uint32_t *order = jox_alloc((size_t)a->count + 1, sizeof *order);
    Pairs pairs = {.first = jox_alloc((size_t)a->count + 2, sizeof *pairs.first)};
    for (uint32_t i = 0; i < a->count; i++)
        order[i] = i;
    jox_sort(order, a->count, sizeof *order, compare_x, a, NULL);
    visit_pairs(a, t, order, pairs.first, NULL);
    for (uint32_t i = 0; i < a->count; i++)
        pairs.first[i + 1] += pairs.first[i];
    pairs.other = jox_alloc((size_t)pairs.first[a->count] + 1, sizeof *pairs.other);
    visit_pairs(a, t, order, pairs.first, pairs.other);
    memmove(pairs.first + 1, pairs.first, a->count * sizeof *pairs.first); /* as before listing */
    pairs.first[0] = 0;
    jox_free(order);
    return pairs;
}

/* Returns how deep the torso of agent i is in another, m. */
static float find_depth(const JoxAgents *a, const JoxTorsos *t, const Pairs *pairs, uint32_t i) {
    float most = 0.0f;
    for (uint32_t k = pairs->first[i]; k < pairs->first[i + 1]; k++)
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

/* Turns chests; returns how deep each agent's torso still is in another, m. */
static float *turn_chests(JoxAgents *a, JoxTorsos *t) {
    float *depths = jox_alloc((size_t)a->count + 1, sizeof *depths);
    Pairs pairs = list_pairs(a, t);
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (uint32_t i = 0; i < a->count; i++)
            if (jox_length2((JoxV2){t->axis_x[i], t->axis_y[i]}) > 0.0f)
                turn_out_of_others(a, t, &pairs, i);
    for (uint32_t i = 0; i < a->count; i++)
        depths[i] = find_depth(a, t, &pairs, i);
    jox_free(pairs.first);
    jox_free(pairs.other);
    return depths;
}

/* `depths`: how deep each agent's torso is in another, m. */
static void note_overlaps(const JoScene *scene, const JoxTorsos *torsos, const float *depths,
                          JoxDiagnostics *diagnostics) {
    const JoxAgents *a = &scene->world->state.agents;
    for (uint32_t g = 0; g < scene->spec->group_count; g++) {
        const JoxGroup *group = &scene->spec->groups[g];
        uint32_t count = 0, people = 0;
        float deepest = 0.0f;
        for (uint32_t i = 0; i < a->count; i++) {
            const bool deep = depths[i] > 2.0f * DEEP * torsos->radius[i];
            people += a->group[i] == g;
            count += a->group[i] == g && deep;
            deepest = a->group[i] == g ? jox_maxf(deepest, depths[i]) : deepest;
        }
        char text[200], noun[JOX_NOUN];
        snprintf(text, sizeof text,
                 "the torsos of %u of the %s of group '%.60s' begin in others, up to %.2f m deep, "
                 "however their chests turn",
                 count, jox_noun(noun, people, "person|people"), group->name, (double)deepest);
        if (count)
            note_at_group(group, "torsos-in-others", "Widen `spacing`", text, diagnostics);
    }
}

void jox_run_start_torsos(JoScene *scene, JoxDiagnostics *diagnostics) {
    JoxTorsos torsos = {0};
    if (scene->spec->literal)
        return;
    note_measures(scene, diagnostics);
    if (jox_torsos_list(&torsos, &scene->world->state.agents, false)) {
        float *depths = turn_chests(&scene->world->state.agents, &torsos);
        note_overlaps(scene, &torsos, depths, diagnostics);
        jox_free(depths);
    }
    jox_torsos_free(&torsos);
}
