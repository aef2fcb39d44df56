/* Checks whether people fit the stairs and lifts of a scene. `jostle check` calls it
   (validate/check.c). */
#ifndef JOX_RUN_STOREY_CHECKS_H
#define JOX_RUN_STOREY_CHECKS_H

#include "base/format/diag.h"
#include "jostle.h"

/* Warns of people who ride to a place of a lift, or may take it or a stair on their way, and
   cannot: one of them alone is heavier than the lift's load, or broader than a door or the stair.
 */
void jox_run_check_storeys(const JoScene *scene, JoxDiagnostics *diagnostics);

#endif
