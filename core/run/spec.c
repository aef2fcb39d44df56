/* A scene's file, read with what the caller sets besides. */
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
