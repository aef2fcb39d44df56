/* Writes checkpoints of a run (jo_scene_checkpoint): a listener that writes a file every few
   seconds of simulated time, after a step at which all state can be saved exactly. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/guard.h"
#include "base/mem.h"
#include "jostle_tools.h"
#include "run/read_scene.h"
#include "run/resume/checkpoint.h"
#include "run/tags_and_teams.h"

typedef struct Checkpoint {
    char *folder, *note;
    FILE *claim;    /* lock of the folder, against other runs */
    uint64_t every; /* ticks */
    uint64_t due;   /* first tick at which the next one may be written */
} Checkpoint;

/* ---- content ---- */

static void add_text_unless_null(JoxText *out, const char *name, const char *text) {
    if (text)
        jox_pieces_add(out, name, text, strlen(text));
}

/* Adds the texts of all files of the scene, as they are live. */
static void add_scene_files(JoxText *out, const JoScene *scene) {
    JoxOverlay all = {0};
    jox_run_collect_texts(scene, &all);
    JoxText piece = {0};
    for (size_t f = 0; f < all.count; f++) {
        piece.length = 0;
        jox_text_append(&piece, all.files[f].path, strlen(all.files[f].path) + 1);
        jox_text_append(&piece, all.files[f].text, all.files[f].length);
        jox_pieces_add(out, JOX_PIECE_FILE, piece.data, piece.length);
    }
    jox_text_free(&piece);
    jox_overlay_free(&all);
}

/* Adds the numbers of tags and teams, as these depend on all versions of the behaviours that ran.
 */
static void add_names(JoxText *out, const JoScene *scene) {
    JoxText piece = {0};
    jox_text_append(&piece, jox_run_kept_names_path, strlen(jox_run_kept_names_path) + 1);
    jox_run_write_kept_names(scene, &piece);
    jox_pieces_add(out, JOX_PIECE_FILE, piece.data, piece.length);
    jox_text_free(&piece);
}

/* Adds the sections of listeners that go on in a resumed run. */
static void add_listeners(JoxText *out, const JoScene *scene) {
    JoxText piece = {0};
    for (uint32_t l = 0; l < scene->listeners.count; l++) {
        const JoxListener *listener = &scene->listeners.items[l];
        if (!listener->kind->sections)
            continue;
        piece.length = 0;
        jox_text_append(&piece, listener->kind->name, strlen(listener->kind->name) + 1);
        JoxSections s = jox_sections_save(&piece);
        listener->kind->sections(listener->self, &s);
        jox_sections_end(&s);
        jox_pieces_add(out, JOX_PIECE_LISTENER, piece.data, piece.length);
    }
    jox_text_free(&piece);
}

/* Adds the definition with which the scene was loaded, its tick and its hash. */
static void add_def(JoxText *out, const JoScene *scene) {
    const JoSceneDef *def = &scene->def;
    const JoxCheckpointNumbers numbers = {.tick = scene->world->state.tick,
                                          .hash = jo_world_hash(scene->world),
                                          .seed = def->seed,
                                          .dt = def->dt,
                                          .log_length =
                                              scene->log ? (uint64_t)ftell(scene->log) : 0,
                                          .has_seed = def->has_seed,
                                          .has_dt = def->has_dt,
                                          .no_density = def->no_density};
    jox_pieces_add(out, JOX_PIECE_NUMBERS, &numbers, sizeof numbers);
    add_text_unless_null(out, JOX_PIECE_PATH, def->path);
    add_text_unless_null(out, JOX_PIECE_INPUT, def->input_log);
    for (size_t o = 0; o < def->override_count; o++)
        add_text_unless_null(out, JOX_PIECE_SET, def->overrides[o]);
    for (uint32_t m = 0; m < scene->mods->count; m++) {
        const char *folder = scene->mods->items[m].folder;
        JoxText path = {0}; /* a name without / would be searched in other folders */
        jox_text_printf(&path, "%s%s", strchr(folder, '/') ? "" : "./", folder);
        add_text_unless_null(out, JOX_PIECE_MOD, path.data);
        jox_text_free(&path);
    }
}

/* ---- the file ---- */

/* Flushes the names in the folder to the disk. */
static bool sync_folder(const Checkpoint *c) {
    return fsync(fileno(c->claim)) == 0;
}

/* Writes a file under a temporary name, flushes it, and renames it to the latest checkpoint, so
   that a crash leaves a whole one; the one before gets the other name. */
static bool replace_latest(const Checkpoint *c, const JoxText *data, JoError *error) {
    JoxText latest = {0}, before = {0};
    jox_text_printf(&latest, "%s/%s", c->folder, JOX_CHECKPOINT_LATEST);
    jox_text_printf(&before, "%s/%s", c->folder, JOX_CHECKPOINT_BEFORE);
    FILE *file = jox_file_replace(latest.data);
    bool good = file && fwrite(data->data, 1, data->length, file) == data->length &&
                fflush(file) == 0 && fsync(fileno(file)) == 0 &&
                (rename(latest.data, before.data) == 0 || errno == ENOENT);
    if (file)
        good = (good ? jox_file_close(file) : jox_file_drop(file)) == 0 && good;
    good = good && sync_folder(c);
    if (!good)
        jox_error(error, JO_FAILED, "cannot write the checkpoint '%.300s': %s", latest.data,
                  jox_file_error_text(errno));
    jox_text_free(&latest);
    jox_text_free(&before);
    return good;
}

/* Flushes the files of listeners and the input log, which a resumed run continues. */
static bool flush_other_files(const JoScene *scene, JoError *error) {
    for (uint32_t l = 0; l < scene->listeners.count; l++) {
        const JoxListener *listener = &scene->listeners.items[l];
        if (listener->kind->settle && !listener->kind->settle(listener->self, error))
            return false;
    }
    if (!scene->log || (fflush(scene->log) == 0 && fsync(fileno(scene->log)) == 0))
        return true;
    jox_error(error, JO_FAILED, "cannot write the input log: %s", strerror(errno));
    return false;
}

static bool write_checkpoint_if_due(void *self, JoScene *scene, JoError *error) {
    Checkpoint *c = self;
    if (scene->world->state.tick < c->due || !jox_world_snapshot_is_exact(scene->world))
        return true;
    c->due = scene->world->state.tick + c->every;
    JoxText state = {0}, out = {0};
    bool good = flush_other_files(scene, error) && jox_world_snapshot(scene->world, &state, error);
    if (good) {
        jox_pieces_begin(&out);
        add_def(&out, scene);
        add_text_unless_null(&out, JOX_PIECE_NOTE, c->note);
        add_scene_files(&out, scene);
        /* behind the files: a resumed scene also has the names as a file, and the last one counts
         */
        add_names(&out, scene);
        jox_pieces_add(&out, JOX_PIECE_STATE, state.data, state.length);
        add_listeners(&out, scene);
        jox_pieces_end(&out);
        good = replace_latest(c, &out, error);
    }
    jox_text_free(&state);
    jox_text_free(&out);
    return good;
}

/* ---- the listener ---- */

static bool begin_checkpoints(void *self, JoScene *scene, const void *options, JoError *error) {
    Checkpoint *c = self;
    const JoxCheckpointDef *def = options;
    if (!scene->def.resumable || !(def->every > 0.0)) {
        jox_error(error, JO_USAGE,
                  "checkpoints are of scenes that were loaded as resumable, every few seconds");
        return false;
    }
    if (mkdir(def->folder, 0777) == 0 || errno == EEXIST)
        c->claim = jox_folder_claim(def->folder);
    if (!c->claim) {
        jox_error(error, JO_FAILED, "cannot write checkpoints into '%.300s': %s", def->folder,
                  errno == EEXIST ? "it is no folder" : jox_file_error_text(errno));
        return false;
    }
    c->folder = jox_strdup(def->folder);
    c->note = jox_strdup(def->note ? def->note : "");
    c->every = (uint64_t)fmax(1.0, def->every / scene->world->model.def.dt + 0.5);
    c->due = scene->world->state.tick + c->every;
    return true;
}

static void free_checkpoints(void *self) {
    Checkpoint *c = self;
    if (c->claim)
        jox_file_close(c->claim);
    jox_free(c->folder);
    jox_free(c->note);
}

static const JoxListenerKind CHECKPOINTS = {.name = "checkpoints",
                                            .size = sizeof(Checkpoint),
                                            .begin = begin_checkpoints,
                                            .frame = write_checkpoint_if_due,
                                            .release = free_checkpoints};

bool jo_scene_checkpoint(JoScene *scene, const char *directory, double every, const char *note,
                         JoError *error) {
    JOX_REQUIRE(scene && !scene->world->busy && directory &&
                    !jox_run_find_listener(scene, &CHECKPOINTS),
                false);
    JOX_GUARD (scene->heap, error)
        return false;
    return jox_run_attach_listener(scene, &CHECKPOINTS, &(JoxCheckpointDef){directory, note, every},
                                   error) != NULL;
}

bool jo_scene_checkpoint_now(JoScene *scene, bool *written, JoError *error) {
    JOX_REQUIRE(scene && !scene->world->busy && written, false);
    Checkpoint *c = jox_run_find_listener(scene, &CHECKPOINTS);
    JOX_REQUIRE(c, false);
    JOX_GUARD (scene->heap, error)
        return false;
    c->due = scene->world->state.tick;
    const bool good = write_checkpoint_if_due(c, scene, error);
    *written = good && c->due > scene->world->state.tick;
    return good;
}
