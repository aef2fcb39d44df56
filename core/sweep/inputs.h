/* Reads all files that the runs of a sweep need before the first run starts, and keeps their texts,
   so that all runs load the same inputs even if files are edited meanwhile. sweep.c calls these in
   order. */
#ifndef JOX_SWEEP_INPUTS_H
#define JOX_SWEEP_INPUTS_H

#include "base/overlay.h"
#include "sweep/store.h"

/* Returns the scene of one run: that of `def`, with the variant's settings and the seed. The caller
   frees `overrides`. */
JoSceneDef jox_sweep_scene_def(const JoSweepDef *def, const JoxSweepVariant *variant,
                               uint64_t seed);
/* Reads and compiles every variant that is to be run. Afterwards `files` holds all texts that were
   read, and is sealed: nothing else can be read. `names` are those of the variants. If a variant
   does not load, the reason goes to its slot in `refused`, to be freed. Returns false with `error`
   if none loads; problems are reported as messages. */
bool jox_sweep_load_inputs(const JoSweepDef *def, const JoxSweepPlan *plan,
                           const char *const *names, JoxOverlay *files, char **refused,
                           JoError *error);
/* Stores the settings that all runs share, or compares them with those in the file. */
bool jox_sweep_note_settings(const JoxSweepStore *store, const JoSweepDef *def,
                             JoxText *differences, JoError *error);
/* Does the same for these settings and all inputs. */
bool jox_sweep_note_inputs(const JoxSweepStore *store, const JoSweepDef *def,
                           const JoxOverlay *files, JoxText *differences, JoError *error);

#endif
