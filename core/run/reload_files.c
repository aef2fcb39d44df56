/* jo_scene_reload: puts texts of a program in place of the files that a running scene is made of.
 */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "run/input_log.h"
#include "run/reload.h"
#include "run/run.h"

/* The first error of a reload, and who else is told of its diagnostics. */
typedef struct FirstError {
    JoError *error;
    JoxDiagnosed *told;
    void *context;
} FirstError;

static void note_first_error(void *context, const bool *parts, const JoxDiagnostics *diagnostics) {
    FirstError *first = context;
    for (size_t d = 0; diagnostics && d < diagnostics->count && !first->error->code; d++) {
        const JoxDiagnostic *found = &diagnostics->items[d];
        if (found->severity != JOX_SEVERITY_ERROR)
            continue;
        jox_error(first->error, JO_INPUT, "%s%s%s", found->message, found->hint ? ". " : "",
                  found->hint ? found->hint : "");
        snprintf(first->error->file, sizeof first->error->file, "%s",
                 found->file ? found->file : "");
        first->error->line = found->line;
        first->error->column = found->column;
    }
    jox_run_call_diagnosed(first->told, first->context, parts, diagnostics);
}

/* Swaps the files of an entry in, and has the errors noted. */
static bool swap_files(JoScene *scene, const JoxInputEntry *entry, JoError *error) {
    JoError other = {0};
    FirstError first = {error, scene->diagnosed, scene->diagnosed_context};
    scene->diagnosed = note_first_error;
    scene->diagnosed_context = &first;
    const bool live = jox_run_reload_files(scene, entry, &other);
    scene->diagnosed = first.told;
    scene->diagnosed_context = first.context;
    if (!live && !error->code)
        *error = other;
    return live;
}

/* Puts the texts into the scene's overlay. Returns the overlay as it was at their paths. */
static JoxOverlay put_texts(JoScene *scene, const JoxInputEntry *entry) {
    JoxOverlay before = {0};
    for (uint32_t f = 0; f < entry->number; f++) {
        const JoxInputFile *file = &entry->files[f];
        const JoxOverlayFile *old = jox_overlay_find(&scene->overlay, file->path);
        if (old)
            jox_overlay_put(&before, file->path, old->text, old->length);
        jox_overlay_put(&scene->overlay, file->path, file->text, file->length);
    }
    return before;
}

/* Takes back the texts that did not go live: a later reload reads the files as they were. */
static void take_back_texts(JoScene *scene, const JoxInputEntry *entry, const JoxOverlay *before) {
    for (uint32_t f = 0; f < entry->number; f++) {
        const JoxInputFile *file = &entry->files[f];
        const JoxOverlayFile *old = jox_overlay_find(before, file->path);
        if (jox_run_is_text_live(scene, file))
            continue;
        if (old)
            jox_overlay_put(&scene->overlay, file->path, old->text, old->length);
        else
            jox_overlay_remove(&scene->overlay, file->path);
    }
}

/* Whether a later text of the list has the path of text `f`. */
static bool has_later_text(const JoFile *files, size_t count, size_t f) {
    for (size_t later = f + 1; later < count; later++)
        if (strcmp(files[later].path, files[f].path) == 0)
            return true;
    return false;
}

/* False with `error` if no behaviour and no scene reads one of the files. */
static bool check_files_are_read(const JoScene *scene, const JoxInputEntry *entry, JoError *error) {
    for (uint32_t f = 0; f < entry->number; f++) {
        const char *path = entry->files[f].path;
        if (jox_run_reads_file(scene, path))
            continue;
        jox_error(error, JO_INPUT,
                  "no behaviour or scene of this run reads '%.200s': its text has no effect until "
                  "one does",
                  path);
        if (error)
            snprintf(error->file, sizeof error->file, "%s", path);
        return false;
    }
    return true;
}

/* Copies the texts into an entry: of several for one path the last. */
static JoxInputEntry copy_texts(const JoFile *files, size_t count) {
    JoxInputEntry entry = {.verb = JOX_INPUT_FILES};
    entry.files = jox_alloc(count + 1, sizeof *entry.files);
    for (size_t f = 0; f < count; f++)
        if (!has_later_text(files, count, f))
            entry.files[entry.number++] =
                (JoxInputFile){jox_strdup(files[f].path),
                               jox_strndup(files[f].text, files[f].length), files[f].length};
    return entry;
}

static bool reload_texts(JoScene *scene, const JoFile *files, size_t count, JoError *error) {
    JoxInputEntry entry = copy_texts(files, count);
    JoError ignored = {0};
    JoxOverlay texts = put_texts(scene, &entry);
    const JoxOverlay *before = jox_overlay_use(&scene->overlay);
    if (error)
        *error = (JoError){0};
    const bool live = swap_files(scene, &entry, error ? error : &ignored);
    jox_overlay_use(before);
    if (live)
        scene->acted_on = true;
    else
        take_back_texts(scene, &entry, &texts);
    const bool good = live && check_files_are_read(scene, &entry, error);
    jox_overlay_free(&texts);
    jox_input_entry_free(&entry);
    return good;
}

bool jo_scene_reload(JoScene *scene, const JoFile *files, size_t count, JoError *error) {
    JOX_REQUIRE(scene && !scene->world->busy && !scene->finished && !scene->def.dry &&
                    (files || !count) && count <= JOX_INPUT_FILE_COUNT,
                false);
    for (size_t f = 0; f < count; f++)
        JOX_REQUIRE(files[f].path && files[f].text, false);
    JOX_GUARD (scene->heap, error) {
        scene->world->busy = false;
        return false;
    }
    scene->world->busy = true; /* a callback must not change what is being swapped */
    const bool live = reload_texts(scene, files, count, error);
    scene->world->busy = false;
    return live;
}
