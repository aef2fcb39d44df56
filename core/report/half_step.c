/* jo_scene_half_step: loads a scene once more at half its time step, so that a report can show
   how much its figures depend on the step. */
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "jostle_tools.h"
#include "run/figure_listeners.h"
#include "run/run.h"

static void discard_message(void *context, const char *text) {
    (void)context;
    (void)text;
}

/* Returns whether two scenes were loaded from the same files, compared by SHA-256. */
static bool has_same_files(const JoScene *a, const JoScene *b) {
    bool same = a->spec->file_count == b->spec->file_count &&
                a->world->model.machines.count == b->world->model.machines.count;
    for (uint32_t f = 0; same && f < a->spec->file_count; f++)
        same = strcmp(a->spec->files[f].sha256, b->spec->files[f].sha256) == 0;
    for (uint32_t m = 0; same && m < a->world->model.machines.count; m++) {
        uint32_t count, others;
        const JoxLuaFile *files = jox_lua_files(a->lua, a->world->model.machines.items[m], &count);
        const JoxLuaFile *other = jox_lua_files(b->lua, b->world->model.machines.items[m], &others);
        same = count == others;
        for (uint32_t f = 0; same && f < count; f++)
            same = strcmp(files[f].sha256, other[f].sha256) == 0;
    }
    return same;
}

static bool start_danger_collection(JoScene *scene, JoError *error) {
    JOX_GUARD (scene->heap, error)
        return false;
    return jox_run_collect_danger(scene, error);
}

/* Returns the scene loaded at half the step and collecting danger, ready to run; NULL with an
   error if people acted on the first run or files were edited. */
JoScene *jo_scene_half_step(const JoSceneDef *def, const JoScene *scene, JoError *error) {
    JOX_REQUIRE(def && scene && !scene->def.dry, NULL);
    if (scene->input_path || scene->acted_on) {
        jox_error(error, JO_INPUT, "people acted on it in steps of its own length");
        return NULL;
    }
    /* A resumed scene is loaded from the texts in its checkpoint, even if the files on disk have
       changed. */
    const bool resumed = scene->resumed.length > 0;
    JoSceneDef half = resumed ? scene->def : *def;
    half.has_dt = half.has_seed = true;
    half.dt = scene->world->model.def.dt / 2;
    half.seed = scene->world->model.def.seed;
    half.message = discard_message; /* the first scene has reported all messages */
    const JoxOverlay *before = resumed ? jox_overlay_use(&scene->overlay) : NULL;
    JoScene *other = scene->swap_seconds > 0.0 ? NULL : jo_scene_load(&half, error);
    if (resumed)
        jox_overlay_use(before);
    if (scene->swap_seconds > 0.0 || (other && !has_same_files(scene, other))) {
        jox_error(error, JO_INPUT, "its files were edited meanwhile");
        jo_scene_free(other);
        return NULL;
    }
    if (!other || start_danger_collection(other, error))
        return other;
    jo_scene_free(other);
    return NULL;
}
