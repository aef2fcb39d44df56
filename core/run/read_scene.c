/* Reads the specification of a scene with the caller's overrides, finds mods, and collects the
   texts of all files. load_scene.c, build_scene.c and reload_batch.c call it. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "run/read_scene.h"
#include "run/run.h"

static bool has_all_texts(const char *const *texts, size_t count) {
    for (size_t t = 0; t < count; t++)
        if (!texts || !texts[t])
            return false;
    return true;
}

bool jox_run_is_def_whole(const JoSceneDef *def) {
    for (size_t f = 0; f < def->file_count; f++)
        if (!def->files || !def->files[f].path || (!def->files[f].text && def->files[f].length))
            return false;
    if (def->word_count && !def->words)
        return false;
    return (!def->jobs || def->jobs->run) && has_all_texts(def->overrides, def->override_count) &&
           has_all_texts(def->mods, def->mod_count);
}

/* Passes seed and step as two more overrides. */
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
        jox_scene_read_text(def->path, def->text, def->text_length, &options, diagnostics);
    jox_free(sets);
    return spec;
}

static void add_overlay_files(JoxOverlay *all, const JoxOverlay *some) {
    for (size_t f = 0; f < some->count; f++)
        jox_overlay_put(all, some->files[f].path, some->files[f].text, some->files[f].length);
}

void jox_run_collect_texts(const JoScene *scene, JoxOverlay *out) {
    add_overlay_files(out, &scene->overlay);
    add_overlay_files(out, &scene->tape);
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

/* ---- mods ---- */

enum { LARGEST_PATCH = 256 << 10 };

/* Finds which behaviour a mod's Lua file changes; only lua/ reads that language. False with an
   error if it names none. */
static bool find_patch_target(JoxModPatch *patch, JoxDiagnostics *diagnostics) {
    size_t length;
    char *text = jox_read_file(patch->path, LARGEST_PATCH, &length);
    char target[128];
    int line = 0, column = 0;
    if (text && jox_lua_patch_target(text, length, target, &patch->replaces, &line, &column)) {
        patch->target = jox_strdup(target);
        patch->position =
            (JoxPosition){patch->path, line, column, column + (int)strlen(target) + 2};
    } else {
        jox_diag_error(diagnostics, ((JoxPosition){patch->path, 0, 0, 0}), "no-patch",
                       "End the file with: return patch \"NAME\" { ... }",
                       text ? "this file names no behaviour that it changes"
                            : "this file cannot be read, or is over 256 KB");
    }
    jox_free(text);
    return patch->target != NULL;
}

JoxMods *jox_run_find_mods(const JoSceneDef *def, uint64_t without, JoxDiagnostics *diagnostics) {
    JoxModsDef find = {.named = def->mods,
                       .named_count = (uint32_t)def->mod_count,
                       .scene = def->path,
                       .sets = def->overrides,
                       .set_count = (uint32_t)def->override_count,
                       .named_only = def->named_mods_only,
                       .needed_too = def->needed_mods_too,
                       .without = without};
    for (JoxDiagnostics targets = {0};;) {
        JoxDiagnostics found = {0};
        JoxMods *mods = jox_mods_find(&find, &found);
        uint64_t broken = 0;
        for (uint32_t m = 0; m < mods->count; m++)
            for (uint32_t p = 0; p < mods->items[m].patch_count; p++)
                if (mods->items[m].patches[p].lua &&
                    !find_patch_target(&mods->items[m].patches[p], &targets))
                    broken |= (uint64_t)1 << mods->found_index[m];
        if (!broken) {
            jox_diag_move(diagnostics, &found);
            jox_diag_move(diagnostics, &targets);
            return mods;
        }
        jox_diag_free(&found);
        jox_mods_free(mods);
        find.without |= broken; /* the next search leaves out mods that need it too */
    }
}
