/* Places that set a value, as they are told (JoSettings). */
#ifndef JOX_RUN_MODS_SETTINGS_H
#define JOX_RUN_MODS_SETTINGS_H

#include "base/result_block.h"
#include "run/run.h"

/* Begins the list in a pack; and what the value is now, as text. */
JoSettings *jox_settings_begin(JoxPack *pack);
void jox_settings_now(JoxPack *pack, JoSettings *head, const char *text);
/* Adds one (a JoSetVisit; the context is the pack). */
void jox_settings_add(void *pack, const JoSetting *setting);
/* Ends it; the caller's. */
JoSettings *jox_settings_end(JoxPack *pack);

/* What set a parameter of the agent at an index, whom `watched` is of and who has a behaviour: as
   jo_agent_why, at least one. The caller's. */
JoSettings *jox_run_parameter_why(JoScene *scene, uint32_t i, const JoxWatched *watched,
                                  int parameter);

#endif
