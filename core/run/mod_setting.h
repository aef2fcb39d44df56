/* Settings of mods that are changed while a scene runs: the behaviours that the mod's patches
   change are loaded with the new value and swapped in, as if the patches had been saved. */
#ifndef JOX_RUN_MOD_SETTING_H
#define JOX_RUN_MOD_SETTING_H

#include "run/reload_batch.h"

/* Changes a setting, given as in an input log. While files are watched, the loading thread does it
   in the background; else it is done at once. False with `error`. */
bool jox_run_set_mod_setting(JoScene *scene, const char *mod, const char *setting,
                             const char *value, JoError *error);
/* Loads the behaviours that a change of a setting concerns; a batch, possibly empty, of which the
   change is a part. */
JoxBatch *jox_setting_prepare(JoxReload *reload, const JoxSettingChange *change);
/* Notes, on the stepping thread, that a batch with a change has gone live: tells and logs it. */
void jox_setting_went_live(JoScene *scene, const JoxSettingChange *change);
/* Takes back the change of a batch that was refused, on the thread that loads. */
void jox_setting_revert(JoxReload *reload, const JoxSettingChange *change);

#endif
