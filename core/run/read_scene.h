/* Reads what a scene is made of: its specification, its mods, and the texts of all its files. */
#ifndef JOX_RUN_READ_SCENE_H
#define JOX_RUN_READ_SCENE_H

#include "base/format/diag.h"
#include "base/overlay.h"
#include "jostle.h"
#include "scene/mods.h"
#include "scene/scene.h"

/* Whether the lists of a def, and the threads that it lends, are complete. */
bool jox_run_is_def_whole(const JoSceneDef *def);
/* Finds the mods of a scene, and which files each of their patches changes. `without`: bits of
   found mods to leave out. Mods with a patch that names no target are left out too. */
JoxMods *jox_run_find_mods(const JoSceneDef *def, uint64_t without, JoxDiagnostics *diagnostics);
/* Reads the scene's files with the def's overrides, seed and step, patched by the first `mod_count`
   mods. Returns NULL if there are errors; freed by jox_scene_free. */
JoxSceneSpec *jox_run_load_spec(const JoSceneDef *def, const JoxMods *mods, uint32_t mod_count,
                                JoxDiagnostics *diagnostics);
/* Adds the texts of all files of a scene to `out`: those read at the load if the scene is
   resumable, then those live now. */
void jox_run_collect_texts(const JoScene *scene, JoxOverlay *out);

#endif
