/* Builds a scene from its files. */
#ifndef JOX_RUN_BUILD_SCENE_H
#define JOX_RUN_BUILD_SCENE_H

#include "base/format/diag.h"
#include "jostle.h"

/* Builds the specification and the world of `scene`, whose mods are found, with the first
   `mod_count` of them. Appends what is wrong to `diagnostics`; the scene is then freed, unless
   there are no errors. With def->dry it checks, and makes no people. */
void jox_run_build(JoScene *scene, const JoSceneDef *def, uint32_t mod_count,
                   JoxDiagnostics *diagnostics);

#endif
