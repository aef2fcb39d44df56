/* A scene's file, read with what the caller sets besides; and all that a scene was read from. */
#include <stdio.h>

#include "base/mem.h"
#include "run/run.h"

/* The def's overrides, with seed and step as two more. */
JoxSceneSpec *jox_run_load_spec(const JoSceneDef *def, const JoxMods *mods, uint32_t mod_count,
                                JoxDiagnostics *diagnostics) {
    char seed[32], step[48];
    const char **sets = jox_alloc(def->override_count + 2, sizeof *sets);
    uint32_t count = 0;
    for (size_t i = 0; i < def->override_count; i++)
        sets[count++] = def->overrides[i];
    if (def->has_seed) {
        snprintf(seed, sizeof seed, "seed=%llu", (unsigned long long)def->seed);
        sets[count++] = seed;
    }
    if (def->has_dt) {
        snprintf(step, sizeof step, "step=%.9g", def->dt);
        sets[count++] = step;
    }
    JoxSceneOptions options = {
        .sets = sets, .set_count = count, .mods = mods->items, .mod_count = mod_count};
    JoxSceneSpec *spec =
        jox_scene_load_text(def->path, def->text, def->text_length, &options, diagnostics);
    jox_free(sets);
    return spec;
}

static void add_overlay(JoxOverlay *all, const JoxOverlay *some) {
    for (size_t f = 0; f < some->count; f++)
        jox_overlay_put(all, some->files[f].path, some->files[f].text, some->files[f].length);
}

void jox_run_texts(const JoScene *scene, JoxOverlay *out) {
    add_overlay(out, &scene->overlay);
    add_overlay(out, &scene->tape);
    for (uint32_t f = 0; f < scene->spec->file_count; f++)
        jox_overlay_put(out, scene->spec->files[f].path, scene->spec->files[f].text,
                        scene->spec->files[f].length);
    const JoxMachineSet *machines = &scene->world->model.machines;
    for (uint32_t m = 0; m < machines->count; m++) {
        uint32_t count;
        const JoxLuaFile *files = jox_lua_files(scene->lua, machines->items[m], &count);
        for (uint32_t f = 0; f < count; f++) {
            size_t length;
            const char *text = jox_lua_text(scene->lua, machines->items[m], f, &length);
            jox_overlay_put(out, files[f].path, text, length);
        }
    }
}
