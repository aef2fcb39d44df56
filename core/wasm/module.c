/* The functions of the WebAssembly module that open, run and reload scenes; scripts/wasm/engine.mjs
   calls them. Files are read from the module's file system, whose current folder the host sets to
   that of the scene. A function that fails returns 0, NULL or a negative number, and the last
   answer is then {"errors": [{"file", "line", "column", "end", "severity", "code", "message",
   "hint"}, ...]}. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/guard.h"
#include "base/mem.h"
#include "live/live_parts.h"
#include "live/scene_page.h"
#include "run/input_log.h"
#include "run/reload.h"
#include "view/worker.h"
#include "wasm/module_scene.h"
#include "wasm/module_threads.h"

/* ---- messages ---- */

/* Keeps what a scene says. Memory of the C library, as the engine is on its way out of a call; a
   text for which there is none is lost. */
static void keep_said(void *context, const char *text) {
    JoxModuleScene *s = context;
    const size_t had = s->said ? strlen(s->said) : 0, more = strlen(text);
    char *longer = realloc(s->said, had + more + 1);
    if (!longer)
        return;
    memcpy(longer + had, text, more + 1);
    s->said = longer;
}

/* Makes what the scene has said since the last call the last answer; false if that is nothing. */
JOX_MODULE_CALL bool jostle_take_said(JoxModuleScene *s) {
    JOX_GUARD (NULL, NULL)
        return false;
    JoxText text = {0};
    if (s->said)
        jox_text_add(&text, s->said);
    free(s->said);
    s->said = NULL;
    const bool any = text.length > 0;
    jox_module_answer(&text);
    return any;
}

/* ---- opening and closing ---- */

/* Returns the texts of a block, one behind the other with a zero byte each, as an array. */
static const char **list_texts(const char *block, size_t count) {
    const char **texts = jox_alloc(count + 1, sizeof *texts);
    for (size_t t = 0; t < count; t++, block += strlen(block) + 1)
        texts[t] = jox_strdup(block);
    return texts;
}

static void free_texts(const char **texts, size_t count) {
    for (size_t t = 0; texts && t < count; t++)
        jox_free((char *)texts[t]);
    jox_free(texts);
}

/* What a scene is opened with: texts as of list_texts; NAN: as the scene says. */
typedef struct JoxModuleOpening {
    const char *path, *sets, *mods;
    size_t set_count, mod_count;
    double seed, dt;
    bool has_page;
} JoxModuleOpening;

static JoViewDef make_def(JoxModuleScene *s, const JoxModuleOpening *opening) {
    JoViewDef def = jo_default_view_def();
    def.watch = false;
    def.scene.path = s->path = jox_strdup(opening->path);
    def.scene.overrides = s->sets = list_texts(opening->sets, opening->set_count);
    def.scene.override_count = opening->set_count;
    def.scene.mods = s->mods = list_texts(opening->mods, opening->mod_count);
    def.scene.mod_count = opening->mod_count;
    def.scene.named_mods_only = true;
    def.scene.has_seed = !isnan(opening->seed);
    def.scene.seed = def.scene.has_seed ? (uint64_t)opening->seed : 0;
    def.scene.has_dt = !isnan(opening->dt);
    def.scene.dt = def.scene.has_dt ? opening->dt : 0.0;
    def.scene.threads = jox_module_threads();
    def.scene.jobs = jox_module_jobs();
    def.scene.message = keep_said;
    def.scene.message_context = s;
    return def;
}

/* Makes the errors that the page keeps of the load the last answer. False if it has none. */
static bool answer_kept_errors(const JoxScenePage *page) {
    JoxText text = {0};
    size_t count = 0;
    jox_text_add(&text, "{\"errors\": ");
    for (size_t e = 0; e < page->error_count && !count; e++) {
        count = page->errors[e].errors.count;
        if (count)
            jox_diag_json(&page->errors[e].errors, &text);
    }
    jox_text_add(&text, "}");
    if (count)
        jox_module_answer(&text);
    jox_text_free(&text);
    return count > 0;
}

/* Frees a scene; false with `error` if its end failed. */
static bool close_scene(JoxModuleScene *s, JoError *error) {
    JOX_GUARD (s->heap, error)
        return false;
    const bool good = jox_scene_page_close(&s->page, error);
    jox_free(s->path);
    free_texts(s->sets, s->def.scene.override_count);
    free_texts(s->mods, s->def.scene.mod_count);
    return good;
}

static void free_scene(JoxModuleScene *s, JoError *error) {
    close_scene(s, error);
    jox_heap_free(s->heap);
    free(s->said);
    free(s);
}

static bool open_scene(JoxModuleScene *s, const JoxModuleOpening *opening, JoError *error) {
    JOX_GUARD (s->heap, error)
        return false;
    s->def = make_def(s, opening);
    if (!jox_scene_page_open(&s->page, &s->def, error))
        return false;
    if (opening->has_page)
        jox_worker_join(s->page.page.server);
    if (jox_scene_page_load(&s->page, error))
        return true;
    s->reported = answer_kept_errors(&s->page);
    return false;
}

/* Opens a scene; NULL if it does not load. */
JOX_MODULE_CALL JoxModuleScene *jostle_open(const char *path, const char *sets, size_t set_count,
                                            const char *mods, size_t mod_count, double seed,
                                            double dt, bool has_page) {
    const JoxModuleOpening opening = {path, sets, mods, set_count, mod_count, seed, dt, has_page};
    JoError error = {.code = JO_FAILED, .text = "out of memory"};
    JoxModuleScene *s = calloc(1, sizeof *s);
    if (s)
        s->heap = jox_heap_create();
    if (s && s->heap && open_scene(s, &opening, &error))
        return s;
    if (!s || !s->reported)
        jox_module_answer_error(&error);
    if (s && s->heap)
        free_scene(s, NULL);
    else
        free(s);
    return NULL;
}

/* Ends a scene and frees it. */
JOX_MODULE_CALL void jostle_close(JoxModuleScene *s) {
    free_scene(s, NULL);
}

/* ---- turns, steps, messages ---- */

static double make_turn(JoxModuleScene *s, JoError *error) {
    JOX_GUARD (s->heap, error)
        return -1.0;
    return jox_live_page_turn(&s->page.page);
}

/* Does one turn of the page's loop: commands, a step if one is due, messages. Returns the time
   until the next turn is due, s; negative if memory is out. */
JOX_MODULE_CALL double jostle_turn(JoxModuleScene *s) {
    JoError error = {0};
    const double wait = make_turn(s, &error);
    if (wait < 0.0)
        jox_module_answer_error(&error);
    return wait;
}

/* Makes up to `count` steps at once; returns how many were made. With less than `count` the last
   answer says why. */
JOX_MODULE_CALL uint32_t jostle_step(JoxModuleScene *s, uint32_t count) {
    JoError error = {0};
    uint32_t made = 0;
    while (made < count && jo_scene_step(s->page.scene, &error))
        made++;
    if (made < count)
        jox_module_answer_error(&error);
    s->page.page.changed = true;
    return made;
}

static bool receive_command(JoxModuleScene *s, const char *json) {
    JOX_GUARD (s->heap, NULL)
        return false;
    jox_worker_receive(s->page.page.server, json, strlen(json));
    return true;
}

/* Takes a command of the page, JSON as core/live/README.md says; the next turn carries it out. */
JOX_MODULE_CALL bool jostle_command(JoxModuleScene *s, const char *json) {
    return receive_command(s, json);
}

/* Returns the next message for the page, valid until the next call; NULL if there is none. */
JOX_MODULE_CALL const JoxWorkerMessage *jostle_next_message(JoxModuleScene *s) {
    JOX_GUARD (s->heap, NULL)
        return NULL;
    return jox_worker_next(s->page.page.server, &s->message) ? &s->message : NULL;
}

/* Carries out a line of an input log, without its tick. */
JOX_MODULE_CALL bool jostle_input(JoxModuleScene *s, const char *line) {
    JoError error = {0};
    const bool good = jo_scene_input(s->page.scene, line, &error);
    if (!good)
        jox_module_answer_error(&error);
    s->page.page.changed = true;
    return good;
}

/* ---- reloads ---- */

/* Keeps the diagnostics of a reload, and hands them on to the page. */
static void keep_diagnostics(void *context, const bool *parts, const JoxDiagnostics *diagnostics) {
    JoxModuleScene *s = context;
    for (size_t d = 0; diagnostics && d < diagnostics->count; d++) {
        const JoxDiagnostic *found = &diagnostics->items[d];
        const JoxPosition at = {found->file, found->line, found->column, found->end_column};
        jox_diag_add(&s->errors, found->severity, at, found->code, found->hint, found->context,
                     found->source, "%s", found->message);
    }
    jox_scene_page_diagnosed(&s->page, parts, diagnostics);
}

/* Adds "taken", the paths of the files whose texts are live. */
static void add_taken(const JoScene *scene, const JoFile *files, size_t count, JoxText *text) {
    bool any = false;
    jox_text_add(text, ", \"taken\": [");
    for (size_t f = 0; f < count; f++) {
        const JoxInputFile file = {(char *)files[f].path, (char *)files[f].text, files[f].length};
        if (!jox_run_is_text_live(scene, &file))
            continue;
        jox_text_add(text, any ? ", " : "");
        jox_text_json(text, file.path);
        any = true;
    }
    jox_text_add(text, "]");
}

/* Adds "unread", the paths of the files that no behaviour and no scene reads, to the answer, and a
   warning of each to the diagnostics. Returns whether there are any. */
static bool add_unread(JoxModuleScene *s, const JoFile *files, size_t count, JoxText *text) {
    bool any = false;
    jox_text_add(text, "\"unread\": [");
    for (size_t f = 0; f < count && !s->errors.errors; f++) {
        if (jox_run_reads_file(s->page.scene, files[f].path))
            continue;
        jox_diag_warn(&s->errors, ((JoxPosition){files[f].path, 0, 0, 0}), "unread-file", NULL,
                      "no behaviour or scene of this run reads this file: it has no effect until "
                      "one does");
        jox_text_add(text, any ? ", " : "");
        jox_text_json(text, files[f].path);
        any = true;
    }
    jox_text_add(text, "], ");
    return any;
}

/* Answers {"live", "errors", "taken", "unread", "news"}; the news go to the page besides. */
static void answer_reload(JoxModuleScene *s, const JoFile *files, size_t count, bool live,
                          const JoError *error) {
    JoxText text = {0}, news = {0};
    if (jox_live_news(s->page.scene, &news))
        jox_view_send(s->page.page.server, JOX_VIEW_ALL, news.data);
    jox_text_printf(&text, "{\"live\": %s, ", live ? "true" : "false");
    const bool any_unread = add_unread(s, files, count, &text);
    if (!live && !any_unread && !s->errors.errors)
        jox_diag_error(&s->errors,
                       ((JoxPosition){error->file, error->line, error->column, error->column}),
                       "not-taken", NULL, "%s", error->text);
    jox_text_add(&text, "\"errors\": ");
    jox_diag_json(&s->errors, &text);
    add_taken(s->page.scene, files, count, &text);
    jox_text_printf(&text, ", \"news\": %s}", news.data ? news.data : "null");
    jox_module_answer(&text);
    jox_text_free(&news);
    jox_diag_free(&s->errors);
    s->page.page.changed = true;
}

static bool reload_files(JoxModuleScene *s, const JoFile *files, size_t count, bool *live) {
    JOX_GUARD (s->heap, NULL)
        return false;
    JoError error = {0};
    JoScene *scene = s->page.scene;
    jox_live_attach(scene); /* notes the news */
    scene->diagnosed = keep_diagnostics;
    scene->diagnosed_context = s;
    *live = jo_scene_reload(scene, files, count, &error);
    scene->diagnosed = jox_scene_page_diagnosed;
    scene->diagnosed_context = &s->page;
    answer_reload(s, files, count, *live, &error);
    return true;
}

/* Replaces files of the running scene at once; answers as answer_reload says. */
JOX_MODULE_CALL bool jostle_reload(JoxModuleScene *s, const JoFile *files, size_t count) {
    bool live = false;
    if (!reload_files(s, files, count, &live))
        jox_module_answer_error(&(JoError){.code = JO_FAILED, .text = "out of memory"});
    return live;
}
