/* The torsos of the people who are there when a scene starts: turns the chests of those who begin
   in each other, and notes what is left, and measures that hardly anybody wants. build_scene.c
   calls it. */
#include "run/starting_torsos.h"

#include <math.h>

#include "agents/torso.h"
#include "base/format/plurals.h"
#include "base/mem.h"
#include "run/run.h"
#include "world/turn_chests.h"

/* Ratio of the radius to half of the breadth, or of that to the radius, above which one of them is
   taken for a mistake. */
static const float FAR = 1.5f;

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

/* Notes a radius that is far from half of a given breadth, unless it is the least there is. Returns
   whether it does. */
static bool note_far_radius(const JoxAgents *a, uint32_t i, const JoxGroup *group,
                            JoxDiagnostics *diagnostics) {
    const float half = 0.5f * jox_param(a, JOX_PARAM_breadth, i),
                radius = jox_param(a, JOX_PARAM_radius, i),
                least = (float)jox_parameters[JOX_PARAM_radius].least;
    char text[200], hint[80];
    if (!(half > 0.0f && (radius > jox_maxf(FAR * half, least) || half > FAR * radius)))
        return false;
    snprintf(text, sizeof text,
             "people of group '%.60s' keep room for a disc of %.2f m in radius as they walk, and "
             "their shoulders reach %.2f m",
             group->name, (double)radius, (double)half);
    snprintf(hint, sizeof hint, "radius: %.2g goes with a breadth of %.2g",
             (double)jox_maxf(0.9f * half, least), 2.0 * (double)half);
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

/* `depths`: how deep each agent's torso is in another, m. */
static void note_overlaps(const JoScene *scene, const JoxTorsos *torsos, const float *depths,
                          JoxDiagnostics *diagnostics) {
    const JoxAgents *a = &scene->world->state.agents;
    for (uint32_t g = 0; g < scene->spec->group_count; g++) {
        const JoxGroup *group = &scene->spec->groups[g];
        uint32_t count = 0, people = 0;
        float deepest = 0.0f;
        for (uint32_t i = 0; i < a->count; i++) {
            const bool deep = jox_torso_is_deep(torsos, i, depths[i]);
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
        float *depths = jox_chests_turn(&scene->world->state.agents, &torsos, 0);
        note_overlaps(scene, &torsos, depths, diagnostics);
        jox_free(depths);
    }
    jox_torsos_free(&torsos);
}
