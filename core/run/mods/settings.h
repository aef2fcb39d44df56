/* Lists of the places that set a value (JoSettings), in the order in which they take effect: the
   last one wins. */
#ifndef JOX_RUN_MODS_SETTINGS_H
#define JOX_RUN_MODS_SETTINGS_H

#include "base/result_block.h"
#include "run/run.h"

/* Begins an empty list in a pack, which owns it until the end. */
JoSettings *jox_settings_begin(JoxPack *pack);
/* Stores the present value, as text. */
void jox_settings_set_value(JoxPack *pack, JoSettings *head, const char *text);
/* Adds a copy of a place. A JoSetVisit, whose context is the pack. */
void jox_settings_add(void *pack, const JoSetting *setting);
/* Returns the list in a block of its own, to be freed with jox_free. */
JoSettings *jox_settings_end(JoxPack *pack);

/* Lists what set a parameter of the agent at an index, which must have a behaviour; `watched` are
   the writes to it that were recorded. At least one place, as jo_agent_why returns; to be freed
   with jox_free. */
JoSettings *jox_run_parameter_settings(JoScene *scene, uint32_t i, const JoxWatched *watched,
                                       int parameter);

#endif
