/* Notes on the torsos of the people who are there when a scene starts. Spots are searched for
   discs, so torsos that are broader may begin in each other. build_scene.c calls it. */
#include "run/torso_notes.h"

#include <math.h>

#include "agents/torso.h"
#include "base/format/plurals.h"
#include "base/mem.h"
#include "base/sort.h"
#include "run/run.h"

/* Ratio of the radius to half of the breadth, or of that to the radius, above which one of them is
   taken for a mistake. */
static const float FAR = 1.5f;
/* Share of the smaller depth by which torsos may overlap at the start; discs may so, too. */
static const float DEEP = 0.25f;

static void note_at_group(const JoxGroup *group, const char *code, const char *hint,
                          const char *text, JoxDiagnostics *diagnostics) {
    jox_diag_add(diagnostics, JOX_SEVERITY_NOTE, group->position, code, hint, NULL, NULL, "%s",
                 text);
}

/* Notes a torso that is deeper than broad. Returns whether it is. */
static bool note_deep_torso(const JoxAgents *a, uint32_t i, const JoxGroup *group,
                            JoxDiagnostics *diagnostics) {
    const float breadth = jox_param(a, JOX_PARAM_breadth, i),
                depth = jox_param(a, JOX_PARAM_depth, i);
    char text[200];
    if (!(breadth > 0.0f && depth > breadth))
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

static int compare_x(const void *left, const void *right, const void *context) {
    const float *x = ((const JoxAgents *)context)->x;
    const float a = x[*(const uint32_t *)left], b = x[*(const uint32_t *)right];
    return a < b ? -1 : a > b;
}

/* Finds the greatest overlap of each agent's torso with another's, m, where it is deep. */
static float *find_deep_overlaps(const JoxAgents *a, const JoxTorsos *torsos) {
    float *most = jox_alloc((size_t)a->count + 1, sizeof *most);
    uint32_t *order = jox_alloc((size_t)a->count + 1, sizeof *order);
    const float reach = 2.0f * jox_agents_widest(a, false);
    for (uint32_t i = 0; i < a->count; i++)
        order[i] = i;
    jox_sort(order, a->count, sizeof *order, compare_x, a, NULL);
    for (uint32_t m = 0; m < a->count; m++)
        for (uint32_t n = m + 1; n < a->count && a->x[order[n]] - a->x[order[m]] < reach; n++) {
            const uint32_t i = order[m], j = order[n];
            if (fabsf(a->y[i] - a->y[j]) > reach)
                continue;
            const float overlap = -jox_torsos_gap(torsos, a, i, j);
            if (overlap < 2.0f * DEEP * jox_minf(torsos->radius[i], torsos->radius[j]))
                continue;
            most[i] = jox_maxf(most[i], overlap);
            most[j] = jox_maxf(most[j], overlap);
        }
    jox_free(order);
    return most;
}

static void note_overlaps(const JoScene *scene, const JoxTorsos *torsos,
                          JoxDiagnostics *diagnostics) {
    const JoxAgents *a = &scene->world->state.agents;
    float *most = find_deep_overlaps(a, torsos);
    for (uint32_t g = 0; g < scene->spec->group_count; g++) {
        const JoxGroup *group = &scene->spec->groups[g];
        uint32_t count = 0, people = 0;
        float deepest = 0.0f;
        for (uint32_t i = 0; i < a->count; i++) {
            people += a->group[i] == g;
            count += a->group[i] == g && most[i] > 0.0f;
            deepest = a->group[i] == g ? jox_maxf(deepest, most[i]) : deepest;
        }
        char text[200], noun[JOX_NOUN];
        snprintf(text, sizeof text,
                 "the torsos of %u of the %s of group '%.60s' begin in others, up to %.2f m deep: "
                 "spots are searched for discs of their radius",
                 count, jox_noun(noun, people, "person|people"), group->name, (double)deepest);
        if (count)
            note_at_group(group, "torsos-in-others",
                          "Widen `spacing` to the breadth, or let them face another way (`facing`)",
                          text, diagnostics);
    }
    jox_free(most);
}

void jox_run_note_torsos(const JoScene *scene, JoxDiagnostics *diagnostics) {
    JoxTorsos torsos = {0};
    if (scene->spec->literal)
        return;
    note_measures(scene, diagnostics);
    if (jox_torsos_list(&torsos, &scene->world->state.agents, false))
        note_overlaps(scene, &torsos, diagnostics);
    jox_torsos_free(&torsos);
}
