/* A live scene's beginning and end, and what is wrong with its files meanwhile. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "live/view_parts.h"

/* ---- mistakes ---- */

static void add_error(JoxJson *json, const JoxDiagnostic *d) {
    jox_json_object(json, NULL);
    jox_json_string(json, "file", d->file ? d->file : "");
    jox_json_integer(json, "line", d->line);
    jox_json_integer(json, "column", d->column);
    jox_json_integer(json, "end", d->end_column);
    jox_json_string(json, "text", d->message);
    jox_json_string(json, "source", d->source ? d->source : "");
    jox_json_string(json, "hint", d->hint ? d->hint : "");
    jox_json_string(json, "context", d->context ? d->context : "");
    jox_json_end(json);
}

void jox_viewing_tell_mistakes(JoxViewing *v, uint32_t client) {
    v->text.length = 0;
    JoxJson json = jox_json_begin(&v->text, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "type", "errors");
    jox_json_array(&json, "errors");
    for (size_t m = 0; m < v->mistake_count; m++)
        for (size_t i = 0; i < v->mistakes[m].errors.count; i++)
            add_error(&json, &v->mistakes[m].errors.items[i]);
    jox_json_end(&json);
    jox_json_end(&json);
    jox_view_send(v->view, client, v->text.data);
}

void jox_viewing_forget_mistakes(JoxViewing *v) {
    for (size_t m = 0; m < v->mistake_count; m++)
        jox_diag_free(&v->mistakes[m].errors);
    v->mistake_count = 0;
}

/* What was wrong with the same files, or with a beginning, counts no more. */
static void drop_mistakes(JoxViewing *v, const bool *parts) {
    for (size_t m = v->mistake_count; m-- > 0;) {
        bool shared = false, beginning = true;
        for (uint32_t p = 0; p < JOX_PARTS; p++) {
            shared |= parts && parts[p] && v->mistakes[m].parts[p];
            beginning &= !v->mistakes[m].parts[p];
        }
        if (!shared && !beginning)
            continue;
        jox_diag_free(&v->mistakes[m].errors);
        v->mistakes[m] = v->mistakes[--v->mistake_count];
    }
}

static void keep_errors(const JoxDiagnostics *diagnostics, JoxDiagnostics *kept) {
    for (size_t i = 0; i < diagnostics->count; i++) {
        const JoxDiagnostic *d = &diagnostics->items[i];
        const JoxPosition position = {d->file, d->line, d->column, d->end_column};
        if (d->severity == JOX_SEVERITY_ERROR)
            jox_diag_add(kept, d->severity, position, d->code, d->hint, d->context, d->source, "%s",
                         d->message);
    }
}

/* The scene's own: files were loaded, or (without diagnostics) what is wrong has been printed. */
static void diagnosed(void *context, const bool *parts, const JoxDiagnostics *diagnostics) {
    JoxViewing *v = context;
    v->told = diagnostics && diagnostics->errors;
    if (!diagnostics)
        return;
    if (parts || diagnostics->errors)
        drop_mistakes(v, parts);
    else
        jox_viewing_forget_mistakes(v);
    if (diagnostics->errors &&
        (parts || !v->mistake_count)) { /* files that are watched are known */
        JOX_RESERVE(v->mistakes, v->mistake_capacity, v->mistake_count + 1);
        JoxMistake *mistake = &v->mistakes[v->mistake_count++];
        *mistake = (JoxMistake){.errors = {0}};
        if (parts)
            memcpy(mistake->parts, parts, sizeof mistake->parts);
        keep_errors(diagnostics, &mistake->errors);
    }
    jox_viewing_tell_mistakes(v, JOX_VIEW_ALL);
}

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
    JoScene *next = jox_run_load_told(&v->scene_def, diagnosed, v, error);
    if (!next)
        return false;
    JoError ending = {0};
    if (!jox_viewing_end(v, &ending))
        jox_view_say(v->view, JOX_VIEW_ALL, "error", ending.text);
    v->scene = next;
    v->failed = false;
    v->session.paused = v->failed = !begin(v, error);
    if (v->failed)
        jox_view_say(v->view, JOX_VIEW_ALL, "error", error->text);
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
