/* Numbers of the tags and teams of a scene, and what a checkpoint keeps of them. */
#ifndef JOX_RUN_TAGS_AND_TEAMS_H
#define JOX_RUN_TAGS_AND_TEAMS_H

#include "base/format/diag.h"
#include "base/text.h"
#include "jostle.h"
#include "lua/loader.h"
#include "machine/machine.h"

/* Lets behaviours that are loaded from here on use the tags and teams that the world has now. */
void jox_run_refresh_tags_and_teams(JoScene *scene);
/* Gives the tags and teams of a machine that joins the scene their numbers in it; new names get new
   numbers. */
void jox_run_number_tags_and_teams(JoScene *scene, JoxMachine *machine);
/* Returns the bits of tags by their numbers, and numbers those that are new. Adds an error if there
   are more than 64, unless `diagnostics` is NULL; the tags beyond are left out. */
uint64_t jox_run_number_tags(JoScene *scene, char *const *tags, uint32_t count,
                             JoxPosition position, JoxDiagnostics *diagnostics);
/* Checks the tags and teams that a machine names. A tag that it asks for must be on a body or group
   of the scene, or be set by one of `machines`, which include this one. `files` are the machine's.
 */
void jox_run_check_tags_and_teams(const JoScene *scene, const JoxMachine *machine,
                                  const JoxLuaFile *files, uint32_t file_count,
                                  const JoxMachine *const *machines, uint32_t count,
                                  JoxDiagnostics *diagnostics);

/* Name under which a checkpoint holds the text that jox_run_write_kept_names writes. */
extern const char jox_run_kept_names_path[];
/* Writes, for a checkpoint, the tags and teams in the order of their numbers, and what machines
   keep of earlier versions of their behaviours: dormant memory, own values. */
void jox_run_write_kept_names(const JoScene *scene, JoxText *out);
/* Gives the tags and teams of the checkpoint that is being loaded, if any, their numbers again. */
void jox_run_restore_tags_and_teams(JoScene *scene);
/* Adds to a loaded machine what the checkpoint says that it keeps of earlier versions. */
void jox_run_restore_kept_slots(JoxMachine *machine);

#endif
