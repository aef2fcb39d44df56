/* Loading, restarting and ending the scene of a live page. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/guard.h"
#include "base/mem.h"
#include "base/overlay.h"
#include "live/scene_page.h"
#include "run/load_scene.h"
#include "run/messages.h"

void jox_scene_page_forward(void *context, const char *text) {
    JoxScenePage *s = context;
    const JoSceneDef *def = &s->def->scene;
    jox_run_send_message(def->message, def->message_context, text);
    if (s->reported || (s->scene && jox_live_is_telling(s->scene)))
        return;
    size_t n = strlen(text);
    char *line = jox_strndup(text, n && text[n - 1] == '\n' ? n - 1 : n);
    jox_live_say(&s->page, strstr(text, "warning: ") ? "warning" : "info", line);
    jox_free(line);
}

bool jox_scene_page_end(JoxScenePage *s, JoError *error) {
    bool good = !s->scene || jo_scene_finish(s->scene, error);
    jo_scene_free(s->scene);
    s->scene = NULL;
    return good;
}

static bool set_breakpoints(JoxScenePage *s, JoError *error) {
    bool good = true;
    for (size_t b = 0; good && b < s->def->break_count; b++)
        good = jo_scene_break(s->scene, s->def->breaks[b], error);
    return good;
}

char *jox_scene_page_path(const JoxScenePage *s, const char *path) {
    JoxText out = {0};
    if (!path)
        return NULL;
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    const size_t stem = dot && dot > name ? (size_t)(dot - path) : strlen(path);
    jox_text_append(&out, path, stem);
    if (s->files > 1)
        jox_text_printf(&out, "-%u", s->files);
    jox_text_add(&out, path + stem);
    return out.data;
}

/* Returns whether a file of the present number is there already. */
static bool is_file_taken(const JoxScenePage *s, const char *path) {
    char *numbered = jox_scene_page_path(s, path);
    const bool taken = numbered && access(numbered, F_OK) == 0;
    jox_free(numbered);
    return taken;
}

/* Numbers the files of the run that begins: the first run has the names that the caller gave, each
   later one the next number of which no file is there. */
static void number_files(JoxScenePage *s) {
    s->files++;
    while (s->files > 1 &&
           (is_file_taken(s, s->def->record) || is_file_taken(s, s->def->log_input)))
        s->files++;
}

bool jox_scene_page_add_files(const JoxScenePage *s, JoxText *out) {
    char *record = jox_scene_page_path(s, s->def->record);
    char *log = jox_scene_page_path(s, s->def->log_input);
    const bool any = record || log;
    if (any)
        jox_text_printf(out, "; written to %.200s%s%.200s", record ? record : "",
                        record && log ? " and " : "", log ? log : "");
    jox_free(record);
    jox_free(log);
    return any;
}

/* Tells the program which files the run that begins writes; either may be NULL. */
static void tell_files(const JoViewDef *def, const char *record, const char *log) {
    const JoxOutside outside = jox_guard_leave();
    if (def->writes)
        def->writes(def->begun_context, record, log);
    jox_guard_return(outside);
}

/* Starts what `def` asks for: recording, input log, watch of files; then calls `begun`. */
static bool begin_outputs(JoxScenePage *s, JoError *error) {
    const JoViewDef *def = s->def;
    number_files(s);
    char *record = jox_scene_page_path(s, def->record),
         *log = jox_scene_page_path(s, def->log_input);
    tell_files(def, record, log);
    const bool good = (!record || jo_scene_record(s->scene, record, def->record_every, error)) &&
                      (!log || jo_scene_log_input(s->scene, log, error)) &&
                      (!def->watch || jo_scene_watch(s->scene, error)) &&
                      set_breakpoints(s, error) &&
                      (!def->begun || def->begun(def->begun_context, s->scene, error));
    jox_free(record);
    jox_free(log);
    return good;
}

static void put_overlay_file(void *context, const char *path, const char *text, size_t length) {
    jox_overlay_put(context, path, text, length);
}

/* Loads the scene from the disk again. If the caller has a vetter, it reads the files first, in a
   confined process, and the scene is loaded from what it read. */
static JoScene *reload_scene(JoxScenePage *s, JoError *error) {
    const JoVetter *vetter = s->def->vetter;
    JoxOverlay files = {.sealed = true};
    JoVetting what = {.whole = true, .stop = -1, .read = put_overlay_file, .read_context = &files};
    JoScene *scene = NULL;
    if (!vetter || vetter->vet(vetter->context, &what)) {
        jox_overlay_use(vetter ? &files : NULL);
        scene = jox_run_load_and_report(&s->scene_def, jox_scene_page_diagnosed, s, error);
        jox_overlay_use(NULL);
    } else {
        jox_error(error, JO_INPUT, "%s: %s", what.file, what.why);
    }
    jox_overlay_free(&files);
    return scene;
}

void jox_scene_page_fail(JoxScenePage *s, const JoError *error) {
    s->failed = s->page.session.paused = true;
    snprintf(s->failure, sizeof s->failure, "%s", error->text);
    s->page.session.end = JOX_LIVE_FAILED_RUN;
    s->page.session.failure = s->failure;
    s->page.last_status = 0.0;
}

bool jox_scene_page_load(JoxScenePage *s, JoError *error) {
    s->scene_def.message = jox_scene_page_forward;
    s->scene_def.message_context = s;
    /* the first time the caller's overlay is in use, with the files that it had read */
    JoScene *next =
        s->scene ? reload_scene(s, error)
                 : jox_run_load_and_report(&s->scene_def, jox_scene_page_diagnosed, s, error);
    jox_overlay_use(NULL);
    if (!next)
        return false;
    JoError ending = {0};
    if (!jox_scene_page_end(s, &ending))
        jox_live_say(&s->page, "error", ending.text);
    s->scene = next;
    jo_scene_vet(next, s->def->vetter);
    s->failed = s->have_left = s->page.session.paused = false;
    s->page.session.end = JOX_LIVE_GOES_ON;
    s->page.session.broke = NULL;
    if (!begin_outputs(s, error)) {
        jox_scene_page_fail(s, error);
        jox_live_say(&s->page, "error", error->text);
    }
    s->steps = 0;
    s->until = s->def->seconds > 0.0      ? s->def->seconds
               : s->page.session.match.on ? (double)INFINITY /* until the round is over */
                                          : jo_scene_duration(next);
    s->began = 0.0;
    memset(s->inspectors, 0, sizeof s->inspectors);
    s->push_count = 0;
    jox_live_page_begin(&s->page);
    return !s->failed;
}
