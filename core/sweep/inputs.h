/* What the runs of a sweep are loaded from, kept so that all of them have the same. */
#ifndef JOX_SWEEP_INPUTS_H
#define JOX_SWEEP_INPUTS_H

#include "sweep/store.h"

/* The scene of one run: that of the def, with what the variant sets besides. */
JoSceneDef jox_sweep_scene(const JoSweepDef *def, const JoxSweepVariant *variant, uint64_t seed);
/* Reads and compiles every variant that is to be run; `files` are then all that was read, and
   sealed. `names` are those of the variants. Why one does not load goes to its place in `refused`,
   to be freed. False with `error` where none does; all that is wrong was told. */
bool jox_sweep_load_inputs(const JoSweepDef *def, const JoxSweepPlan *plan,
                           const char *const *names, JoxOverlay *files, char **refused,
                           JoError *error);
/* Notes what all runs share, and compares it with what was noted before. */
bool jox_sweep_note_inputs(const JoxSweepStore *store, const JoSweepDef *def,
                           const JoxOverlay *files, JoxText *differences, JoError *error);

#endif
