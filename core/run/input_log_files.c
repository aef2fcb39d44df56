/* Writes to an input log which files a run is made of, and the texts of reloaded files; on a
   replay, compares these with the run. reload_swap.c, build_scene.c and load_scene.c call it. */
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/guard.h"
#include "base/mem.h"
#include "run/input_log.h"
#include "run/run.h"

/* ---- what a run is made of ---- */

static void log_file_hash(JoScene *scene, JoxFiles *told, const char *path, const char *sha256) {
    uint32_t before = told->count;
    jox_files_add(told, path);
    JoxInputEntry entry = {.verb = JOX_INPUT_MADE, .names = {(char *)path, (char *)sha256}};
    if (told->count > before && strlen(path) <= JOX_INPUT_PATH)
        jox_run_log_entry(scene, &entry);
}

static void log_origin(JoScene *scene) {
    const JoWorld *world = scene->world;
    JoxFiles told = {0};
    char seed[32];
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)world->model.def.seed);
    JoxInputEntry began = {.verb = JOX_INPUT_BEGAN, .names = {seed}, .given = 1};
    began.numbers[0] = world->model.def.dt;
    jox_run_log_entry(scene, &began);
    for (uint32_t f = 0; f < scene->spec->file_count; f++)
        log_file_hash(scene, &told, scene->spec->files[f].path, scene->spec->files[f].sha256);
    for (uint32_t m = 0; m < world->model.machines.count; m++) {
        uint32_t count;
        const JoxLuaFile *files = jox_lua_files(scene->lua, world->model.machines.items[m], &count);
        for (uint32_t f = 0; f < count; f++)
            log_file_hash(scene, &told, files[f].path, files[f].sha256);
    }
    jox_files_free(&told);
}

bool jo_scene_log_on(JoScene *scene, const char *path, JoError *error) {
    JOX_REQUIRE(scene && !scene->world->busy && path && !scene->log && !scene->finished, false);
    JOX_GUARD (scene->heap, error)
        return false;
    struct stat info;
    const bool there = stat(path, &info) == 0 && (uint64_t)info.st_size >= scene->log_length;
    scene->log = there ? jox_file_open(path, "a") : NULL;
    if (!scene->log || ftruncate(fileno(scene->log), (off_t)scene->log_length) != 0) {
        jox_error(error, JO_FAILED, "cannot go on with the input log '%.200s': %s", path,
                  there ? jox_file_error_text(errno) : "it is not there, or shorter than it was");
        return false;
    }
    scene->log_path = jox_strdup(path);
    return true;
}

bool jo_scene_log_input(JoScene *scene, const char *path, JoError *error) {
    JOX_REQUIRE(scene && !scene->world->busy && path && !scene->log && !scene->finished, false);
    JOX_GUARD (scene->heap, error)
        return false;
    const JoWorld *world = scene->world;
    if (scene->input_path && strcmp(path, scene->input_path) == 0) {
        jox_error(error, JO_INPUT,
                  "'%.200s' is the input log that is played; write the new one to another file",
                  path);
        return false;
    }
    scene->log = jox_file_open(path, "w");
    if (!scene->log) {
        jox_error(error, JO_FAILED, "cannot write the input log '%.200s': %s", path,
                  jox_file_error_text(errno));
        return false;
    }
    scene->log_path = jox_strdup(path);
    fprintf(scene->log, "# input log of jostle %s: scene %s, seed %llu, dt %.9g s%s\n",
            jo_version(), scene->def.path, (unsigned long long)world->model.def.seed,
            world->model.def.dt, world->state.tick ? ", begun in mid-run" : "");
    log_origin(scene);
    return jox_run_check_log_written(scene, error);
}

/* ---- writing ---- */

static void add_entry_file(JoxInputEntry *entry, const char *path, const char *text,
                           size_t length) {
    for (uint32_t f = 0; f < entry->number; f++)
        if (strcmp(entry->files[f].path, path) == 0)
            return;
    if (entry->number == JOX_INPUT_FILE_COUNT)
        return;
    entry->files = jox_realloc(entry->files, entry->number + 1, sizeof *entry->files);
    entry->files[entry->number++] =
        (JoxInputFile){jox_strdup(path), jox_strndup(text, length), length};
}

/* Returns the live text of a file that a machine or the scene is made of; NULL: no such file. */
static const char *find_live_text(const JoScene *scene, const char *path, const char **sha256,
                                  size_t *length) {
    const JoxMachineRun *machines = &scene->world->machines;
    for (uint32_t m = 0; m < machines->set->count; m++) {
        uint32_t count;
        const JoxLuaFile *files = jox_lua_files(scene->lua, machines->set->items[m], &count);
        for (uint32_t f = 0; f < count; f++)
            if (strcmp(files[f].path, path) == 0) {
                *sha256 = files[f].sha256;
                return jox_lua_text(scene->lua, machines->set->items[m], f, length);
            }
    }
    for (uint32_t f = 0; f < scene->spec->file_count; f++)
        if (strcmp(scene->spec->files[f].path, path) == 0) {
            *sha256 = scene->spec->files[f].sha256;
            *length = scene->spec->files[f].length;
            return scene->spec->files[f].text;
        }
    return NULL;
}

void jox_run_note_file(JoScene *scene, JoxReloadedFiles *reloaded, const char *path,
                       const char *sha256, const char *text, size_t length) {
    const char *known;
    size_t live_length;
    const char *live = find_live_text(scene, path, &known, &live_length);
    if (live && strcmp(known, sha256) == 0)
        return;
    if (length > JOX_INPUT_LARGEST || strlen(path) > JOX_INPUT_PATH) {
        jox_run_say(scene,
                    "%s is over 16 MB: the input log does without, and a replay reads it "
                    "from the disk\n",
                    path);
        return;
    }
    add_entry_file(&reloaded->files, path, text, length);
    bool first = true;
    for (uint32_t f = 0; f < scene->logged_files.count; f++)
        first &= strcmp(scene->logged_files.paths[f], path) != 0;
    if (live && first)
        add_entry_file(&reloaded->before, path, live, live_length);
}

void jox_run_log_files(JoScene *scene, JoxReloadedFiles *reloaded) {
    JoxInputEntry *const entries[] = {&reloaded->before, &reloaded->files};
    reloaded->before.verb = JOX_INPUT_BEFORE;
    reloaded->files.verb = JOX_INPUT_FILES;
    for (int e = 0; e < 2; e++) {
        if (entries[e]->number)
            jox_run_log_entry(scene, entries[e]);
        for (uint32_t f = 0; f < entries[e]->number; f++)
            jox_files_add(&scene->logged_files, entries[e]->files[f].path);
        jox_input_entry_free(entries[e]);
    }
}

bool jox_run_is_text_live(const JoScene *scene, const JoxInputFile *file) {
    const char *sha256;
    size_t length;
    const char *live = find_live_text(scene, file->path, &sha256, &length);
    return live && length == file->length && memcmp(live, file->text, length) == 0;
}

/* ---- playing ---- */

static void compare_beginning(const JoScene *scene, const JoxInputEntry *entry) {
    const JoWorldDef *def = &scene->world->model.def;
    char seed[32];
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)def->seed);
    if (strcmp(seed, entry->names[0]) != 0 || def->dt != entry->numbers[0])
        jox_run_say(scene,
                    "%s:%d: the log was written with seed %s and steps of %g s, not %s and %g s: "
                    "the run goes another way (--seed %s --dt %g)\n",
                    scene->input_path, entry->line, entry->names[0], entry->numbers[0], seed,
                    def->dt, entry->names[0], entry->numbers[0]);
    if (entry->tick > 0)
        jox_run_say(scene,
                    "%s:%d: the log was begun %u steps into the run: it does not tell all that "
                    "was done\n",
                    scene->input_path, entry->line, entry->tick);
}

void jox_run_compare_with_log(const JoScene *scene) {
    const JoxInputLog *log = &scene->world->state.input;
    for (size_t e = 0; e < log->count; e++) {
        const JoxInputEntry *entry = &log->entries[e];
        const char *sha256;
        size_t length;
        if (entry->verb == JOX_INPUT_BEGAN)
            compare_beginning(scene, entry);
        if (entry->verb == JOX_INPUT_MADE &&
            find_live_text(scene, entry->names[0], &sha256, &length) &&
            strcmp(sha256, entry->names[1]) != 0)
            jox_run_say(scene,
                        "%s:%d: %s has changed since the log was written: the run may go another "
                        "way\n",
                        scene->input_path, entry->line, entry->names[0]);
    }
}

void jox_run_restore_logged_texts(JoxOverlay *overlay, const JoxInputLog *log) {
    for (size_t e = 0; e < log->count; e++)
        for (uint32_t f = 0; log->entries[e].verb == JOX_INPUT_BEFORE && f < log->entries[e].number;
             f++) {
            const JoxInputFile *file = &log->entries[e].files[f];
            if (!jox_overlay_find(overlay, file->path))
                jox_overlay_put(overlay, file->path, file->text, file->length);
        }
}
