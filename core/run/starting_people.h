/* Makes the people who are there when a scene starts, and checks that their step is not too long.
 */
#ifndef JOX_RUN_STARTING_PEOPLE_H
#define JOX_RUN_STARTING_PEOPLE_H

#include "base/format/diag.h"
#include "jostle.h"

/* Checks the values that groups set, and places the people of all groups; says of which groups how
   many were shifted and how far, and how many do not fit. */
void jox_run_place_groups(JoScene *scene, JoxDiagnostics *diagnostics);
/* Gives the world the spec's groups, sources, sinks and events. `anew`: sources count their people
   from now. */
void jox_run_set_schedule(JoScene *scene, bool anew);
/* Warns of speeds and pushes that take a person past another within a step. */
void jox_run_check_step_length(const JoScene *scene, JoxDiagnostics *diagnostics);

#endif
