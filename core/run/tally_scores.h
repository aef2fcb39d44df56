/* Scores that a scene counts of its agents (`tally` in its file). */
#ifndef JOX_RUN_TALLY_SCORES_H
#define JOX_RUN_TALLY_SCORES_H

#include "base/format/diag.h"
#include "base/format/json_writer.h"
#include "base/text.h"
#include "jostle.h"
#include "scene/scene.h"

/* Returns a score as it is now; NAN: a mean, least or greatest of nobody. */
double jox_run_count_tally(const JoScene *scene, const JoxTally *tally);
/* Adds ,"tally": {...} to a summary. */
void jox_run_add_tally(const JoScene *scene, JoxJson *json);
/* Appends the sentence of a run's last lines: each score, and who is ahead. */
void jox_run_say_tally(const JoScene *scene, JoxText *out);
/* Warns of states and memory that tallies name and no behaviour of the scene has. */
void jox_run_check_tally(const JoScene *scene, JoxDiagnostics *diagnostics);

#endif
