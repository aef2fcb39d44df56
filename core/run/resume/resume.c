/* Resumes a run from a checkpoint (jo_scene_resume): loads the scene from the texts in the file,
   and restores the state. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/guard.h"
#include "base/mem.h"
#include "run/resume/checkpoint.h"

static const size_t LARGEST_CHECKPOINT = (size_t)4 << 30; /* bytes */

/* A checkpoint that was read; its texts point into `file`. */
typedef struct ReadCheckpoint {
    JoxText file;
    JoxCheckpointNumbers numbers;
    const char *path, *input, *note;
    const char **sets, **mods;
    size_t set_count, set_capacity, mod_count, mod_capacity;
    JoxOverlay files;
    JoxPiece state;
} ReadCheckpoint;

/* ---- reading ---- */

static void append_piece_text(const char ***list, size_t *count, size_t *capacity,
                              const char *text) {
    JOX_RESERVE(*list, *capacity, *count + 1);
    (*list)[(*count)++] = text;
}

static void take_piece(ReadCheckpoint *r, const JoxPiece *piece) {
    const char *name = piece->name, *data = piece->data;
    const size_t head = strlen(data) + 1; /* a zero follows each piece */
    if (strcmp(name, JOX_PIECE_NUMBERS) == 0 && piece->length == sizeof r->numbers)
        memcpy(&r->numbers, data, sizeof r->numbers);
    else if (strcmp(name, JOX_PIECE_PATH) == 0)
        r->path = data;
    else if (strcmp(name, JOX_PIECE_INPUT) == 0)
        r->input = data;
    else if (strcmp(name, JOX_PIECE_NOTE) == 0)
        r->note = data;
    else if (strcmp(name, JOX_PIECE_SET) == 0)
        append_piece_text(&r->sets, &r->set_count, &r->set_capacity, data);
    else if (strcmp(name, JOX_PIECE_MOD) == 0)
        append_piece_text(&r->mods, &r->mod_count, &r->mod_capacity, data);
    else if (strcmp(name, JOX_PIECE_STATE) == 0)
        r->state = *piece;
    else if (strcmp(name, JOX_PIECE_FILE) == 0 && head <= piece->length)
        jox_overlay_put(&r->files, data, data + head, piece->length - head);
}

static void free_checkpoint_read(ReadCheckpoint *r) {
    jox_text_free(&r->file);
    jox_free(r->sets);
    jox_free(r->mods);
    jox_overlay_free(&r->files);
    *r = (ReadCheckpoint){0};
}

/* Reads a checkpoint; its checksums are verified before anything of it is used. */
static bool read_checkpoint(ReadCheckpoint *r, const char *path, JoError *error) {
    char why[200] = "";
    r->file.data = jox_read_file(path, LARGEST_CHECKPOINT, &r->file.length);
    if (!r->file.data) {
        jox_error(error, JO_INPUT, "cannot read the checkpoint '%.300s': %s", path,
                  jox_file_error_text(errno));
        return false;
    }
    JoxPiece piece;
    for (size_t at = 0; jox_pieces_next(&r->file, &at, &piece, why);)
        take_piece(r, &piece);
    if (!*why && (!r->path || !r->state.data))
        snprintf(why, sizeof why, "it lacks the scene or the state");
    if (*why)
        jox_error(error, JO_INPUT, "'%.250s' cannot be resumed: %s", path, why);
    return !*why;
}

/* Reads a checkpoint from a file, or the newest undamaged one of a folder. */
static bool find_checkpoint(ReadCheckpoint *r, const JoSceneDef *def, const char *path,
                            JoError *error) {
    static const char *const NAMES[] = {JOX_CHECKPOINT_LATEST, JOX_CHECKPOINT_BEFORE};
    struct stat info;
    if (stat(path, &info) != 0 || !S_ISDIR(info.st_mode))
        return read_checkpoint(r, path, error);
    JoError first = {0};
    for (int n = 0; n < 2; n++) {
        JoxText full = {0};
        JoError wrong = {0};
        jox_text_printf(&full, "%s/%s", path, NAMES[n]);
        const bool good = read_checkpoint(r, full.data, &wrong);
        jox_text_free(&full);
        if (good && first.code) {
            JoxText said = {0};
            jox_text_printf(&said, "%s; the one before it is taken\n", first.text);
            jox_run_send_message(def->message, def->message_context, said.data);
            jox_text_free(&said);
        }
        if (good)
            return true;
        free_checkpoint_read(r);
        first = n ? first : wrong;
    }
    if (error)
        *error = first;
    return false;
}

/* ---- state ---- */

/* Restores the world and checks its hash, then gives the listeners their state. */
static bool restore_from_checkpoint(JoScene *scene, const ReadCheckpoint *r, JoError *error) {
    JOX_GUARD (scene->heap, error)
        return false;
    if (!jox_world_restore(scene->world, r->state.data, r->state.length, error))
        return false;
    if (jo_world_hash(scene->world) != r->numbers.hash) {
        JoxSections compared = jox_sections_compare(r->state.data, r->state.length);
        jox_world_sections(scene->world, &compared);
        jox_sections_end(&compared);
        jox_error(error, JO_INPUT, "the state that was restored has another hash than it had: %s",
                  *compared.wrong ? compared.wrong : "what was saved is as it was");
        return false;
    }
    scene->resumed_tick = r->numbers.tick;
    scene->log_length = r->numbers.log_length;
    jox_text_append(&scene->resumed, r->file.data, r->file.length);
    return jox_run_restore_listeners(scene, error);
}

/* Loads the scene from the texts of the checkpoint alone, with its definition, and restores it. */
static JoScene *load_from_texts(const JoSceneDef *def, const ReadCheckpoint *r, JoError *error) {
    JoSceneDef own = *def;
    own.path = r->path;
    own.overrides = r->sets;
    own.override_count = r->set_count;
    own.mods = r->mods;
    own.mod_count = r->mod_count;
    own.named_mods_only = own.needed_mods_too = own.resumable = true;
    own.input_log = r->input;
    own.has_seed = r->numbers.has_seed;
    own.seed = r->numbers.seed;
    own.has_dt = r->numbers.has_dt;
    own.dt = r->numbers.dt;
    own.no_density = r->numbers.no_density;
    const JoxOverlay *before = jox_overlay_use(&r->files);
    JoScene *scene = jo_scene_load(&own, error);
    jox_overlay_use(before);
    if (scene && !restore_from_checkpoint(scene, r, error)) {
        jo_scene_free(scene);
        scene = NULL;
    }
    if (scene)
        jox_heap_unregister(scene); /* the caller's from here on */
    return scene;
}

JoScene *jo_scene_resume(const JoSceneDef *def, const char *path, char **note, JoError *error) {
    JOX_REQUIRE(def && path && note, NULL);
    JOX_GUARD (NULL, error)
        return NULL;
    ReadCheckpoint read = {0};
    JoScene *scene =
        find_checkpoint(&read, def, path, error) ? load_from_texts(def, &read, error) : NULL;
    *note = scene && read.note ? jox_disown(jox_strdup(read.note)) : NULL;
    free_checkpoint_read(&read);
    return scene;
}
