/* The list of mods that the user has enabled: the file jostle/mods-on in the user's configuration
   ($XDG_CONFIG_HOME, else ~/.config). A line holds the hash of the mod's files when it was enabled,
   its name and its folder, so that a mod whose files have changed is off until it is enabled
   again. */
#ifndef JOX_SCENE_MODS_ENABLED_H
#define JOX_SCENE_MODS_ENABLED_H

#include <stdbool.h>

#include "base/format/mod.h"
#include "base/text.h"

/* Returns the text of the list, to be freed by jox_free; NULL if there is none. */
char *jox_mods_read_enabled(void);
/* Looks a mod up in `list`, the text of the list or NULL. On: a line has its name and its hash,
   whatever the folder. Changed: a line has its name and its folder, but another hash. */
JoxModSwitch jox_mods_look_up_enabled(const char *list, const char *name, const char *folder);
/* Enables or disables a mod, in the file. False with a sentence in `error`. */
bool jox_mods_set_enabled(const char *name, const char *folder, bool on, JoxText *error);

#endif
