/* A live scene's beginning and end. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "live/view_parts.h"

/* What the scene says goes to the terminal and, but for what is told otherwise, to the pages. */
static void message(void *context, const char *text) {
    JoxViewing *v = context;
    const JoSceneDef *def = &v->def->scene;
    (def->message ? def->message : jox_run_to_stderr)(def->message_context, text);
    if (v->told)
        return;
    size_t n = strlen(text);
    char *line = jox_strndup(text, n && text[n - 1] == '\n' ? n - 1 : n);
    jox_view_say(v->view, JOX_VIEW_ALL, strstr(text, "warning: ") ? "warning" : "info", line);
    jox_free(line);
}

/* ---- beginning and end ---- */

bool jox_viewing_end(JoxViewing *v, JoError *error) {
    bool good = !v->scene || jo_scene_finish(v->scene, error);
    jo_scene_free(v->scene);
    v->scene = NULL;
    return good;
}

/* Everything of a run that is written, and the files that are watched. */
static bool begin(JoxViewing *v, JoError *error) {
    const JoViewDef *def = v->def;
    return (!def->record || jo_scene_record(v->scene, def->record, error)) &&
           (!def->log_input || jo_scene_log_input(v->scene, def->log_input, error)) &&
           (!def->watch || jo_scene_watch(v->scene, error));
}

bool jox_viewing_load(JoxViewing *v, JoError *error) {
    v->scene_def.message = message;
    v->scene_def.message_context = v;
    JoScene *next = jox_run_load_told(&v->scene_def, jox_viewing_diagnosed, v, error);
    if (!next)
        return false;
    JoError ending = {0};
    if (!jox_viewing_end(v, &ending))
        jox_view_say(v->view, JOX_VIEW_ALL, "error", ending.text);
    v->scene = next;
    v->failed = false;
    v->session.paused = v->failed = !begin(v, error);
    if (v->failed) {
        snprintf(v->failure, sizeof v->failure, "%s", error->text);
        jox_view_say(v->view, JOX_VIEW_ALL, "error", error->text);
    }
    v->steps = 0;
    v->until = v->def->seconds > 0.0 ? v->def->seconds : jo_scene_duration(next);
    v->due = v->spoke = v->showed = 0.0;
    v->version = jox_live_version(next);
    v->inspector = 0;
    v->people.length = 0;
    jox_view_forget(v->view);
    if (jox_view_clients(v->view))
        jox_viewing_greet(v, JOX_VIEW_ALL);
    return !v->failed;
}
