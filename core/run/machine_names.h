/* Checks that the names which machines use of each other and of the scene exist: signals, states,
   memory, own values, gates; and that mods are used. */
#ifndef JOX_RUN_MACHINE_NAMES_H
#define JOX_RUN_MACHINE_NAMES_H

#include "base/format/diag.h"
#include "jostle.h"
#include "lua/loader.h"
#include "machine/machine.h"
#include "scene/mods.h"

/* Checks the names that all machines of a loaded scene use, and those of its tallies. */
void jox_run_check_machine_names(const JoScene *scene, JoxDiagnostics *diagnostics);
/* Checks the own values that a machine reads: parameters, declared, or set by a group that runs it.
   `files` are the machine's. */
void jox_run_check_own_values(const JoScene *scene, const JoxMachine *machine,
                              const JoxLuaFile *files, uint32_t count, JoxDiagnostics *diagnostics);
/* Warns if no file of a mod is part of the scene: its patches change nothing there. */
void jox_run_check_mod_use(const JoScene *scene, const JoxMod *mod, JoxDiagnostics *diagnostics);

#endif
