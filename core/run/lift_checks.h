/* Checks whether people may use the lifts of a scene. `jostle check` calls it (validate/check.c).
 */
#ifndef JOX_RUN_LIFT_CHECKS_H
#define JOX_RUN_LIFT_CHECKS_H

#include "base/format/diag.h"
#include "jostle.h"

/* Warns of people who ride to a place of a lift, or may take it on their way, and cannot: one of
   them alone is heavier than its load, or broader than one of its doors. */
void jox_run_check_lifts(const JoScene *scene, JoxDiagnostics *diagnostics);

#endif
