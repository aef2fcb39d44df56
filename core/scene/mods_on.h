/* Which mods a person has turned on: lines of the file jostle/mods-on in the user's configuration
   ($XDG_CONFIG_HOME, else ~/.config), each with a hash of what the mod held when it was turned on,
   its name and its folder. A mod that holds something else is off until it is turned on again. */
#ifndef JOX_SCENE_MODS_ON_H
#define JOX_SCENE_MODS_ON_H

#include <stdbool.h>

#include "base/format/mod.h"
#include "base/text.h"

/* The file's text; NULL where there is none. To be freed. */
char *jox_mods_on_read(void);
/* What `list`, the file's text, says of a mod in `folder`: it is on where a line has its name and
   its hash, wherever it lies; changed where the line of its folder has another hash. */
JoxModSwitch jox_mods_on_look(const char *list, const char *name, const char *folder);
/* Turns a mod on or off, in the file. False with a sentence in `error`. */
bool jox_mods_on_set(const char *name, const char *folder, bool on, JoxText *error);
/* SHA-256 over paths and contents of all files of a mod, as 64 hexadecimal digits. False with a
   sentence in `error` where one is no plain file or cannot be read, or where they are too many. */
bool jox_mods_on_hash(const char *folder, char out[65], JoxText *error);

#endif
