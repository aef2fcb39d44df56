/* Settings of mods that are changed while a scene runs: the behaviours that the mod's patches
   change are loaded with the new value and swapped in, as if the patches had been saved. */
#ifndef JOX_RUN_MOD_SETTING_H
#define JOX_RUN_MOD_SETTING_H

#include "run/run.h"

/* Changes a setting, given as in an input log. While files are watched, the loading thread does it
   in the background; else it is done at once. False with `error`. */
bool jox_run_set_mod_setting(JoScene *scene, const char *mod, const char *setting,
                             const char *value, JoError *error);

#endif
