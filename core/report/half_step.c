/* A scene once more at half its step, to show what the step makes of its figures. */
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "jostle_tools.h"
#include "run/run.h"

static void to_nobody(void *context, const char *text) {
    (void)context;
    (void)text;
}

/* Whether both were made of the same files, byte by byte. */
static bool same_files(const JoScene *a, const JoScene *b) {
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

static bool begin_report(JoScene *scene, JoError *error) {
    JOX_GUARD (scene->heap, error)
        return false;
    return jox_run_collect_danger(scene, error);
}

JoScene *jo_scene_half_step(const JoSceneDef *def, const JoScene *scene, JoError *error) {
    JOX_REQUIRE(def && scene && !scene->def.dry, NULL);
    if (scene->input_path || scene->acted_on) {
        jox_error(error, JO_INPUT, "people acted on it in steps of its own length");
        return NULL;
    }
    /* Of a resumed scene the files are those that it was loaded from, whatever lies there by now.
     */
    const bool resumed = scene->resumed.length > 0;
    JoSceneDef half = resumed ? scene->def : *def;
    half.has_dt = half.has_seed = true;
    half.dt = scene->world->model.def.dt / 2;
    half.seed = scene->world->model.def.seed;
    half.message = to_nobody; /* all has been said once */
    const JoxOverlay *before = resumed ? jox_overlay_use(&scene->overlay) : NULL;
    JoScene *other = scene->swap_seconds > 0.0 ? NULL : jo_scene_load(&half, error);
    if (resumed)
        jox_overlay_use(before);
    if (scene->swap_seconds > 0.0 || (other && !same_files(scene, other))) {
        jox_error(error, JO_INPUT, "its files were edited meanwhile");
        jo_scene_free(other);
        return NULL;
    }
    if (!other || begin_report(other, error))
        return other;
    jo_scene_free(other);
    return NULL;
}
