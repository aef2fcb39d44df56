/* Loads the machines of a scene's groups, and links each state that becomes another machine to it.
 */
#ifndef JOX_RUN_SCENE_MACHINES_H
#define JOX_RUN_SCENE_MACHINES_H

#include "base/format/diag.h"
#include "jostle.h"
#include "lua/loader.h"
#include "machine/machine.h"
#include "scene/scene.h"

/* Loads the machines of all groups, and those that they may become. False if one does not load. */
bool jox_run_load_machines(JoScene *scene, JoxDiagnostics *diagnostics);
/* Gives a machine that no set has yet own values for the rare parameters that groups who run it
   set. */
void jox_run_own_set_parameters(const JoxSceneSpec *spec, JoxMachine *machine);
/* Returns the index of the machine that was loaded from a path, or -1. */
int32_t jox_run_find_machine(const JoScene *scene, const char *path);
/* Text of a behaviour that the scene made of a journey, by its path; NULL: the path is a file's. */
const char *jox_run_journey_text(const JoxSceneSpec *spec, const char *path);
/* Finds the file of the machine that a state becomes; false with diagnostics. */
bool jox_run_find_become(const JoScene *scene, const JoxMachine *machine, uint32_t state,
                         char path[1024], JoxDiagnostics *diagnostics);
/* Links the states of a machine to the machines that they become, and loads those that are not
   there yet; false with diagnostics. */
bool jox_run_link_becomes(JoScene *scene, JoxMachine *machine, JoxDiagnostics *diagnostics);
/* Attaches the texts of behaviours to diagnostics of them, so that these show the lines. */
void jox_run_attach_sources(const JoxLuaFile *files, uint32_t count, JoxDiagnostics *diagnostics);

#endif
