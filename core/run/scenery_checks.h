/* Checks whether solid scenery stands where people can walk. */
#ifndef JOX_RUN_SCENERY_CHECKS_H
#define JOX_RUN_SCENERY_CHECKS_H

#include "base/format/diag.h"
#include "jostle.h"

/* Warns of scenery of a solid kind that stands on floor which the people of the start, or of
   sources, can walk to: on the page they would walk through it. */
void jox_run_check_scenery(const JoScene *scene, JoxDiagnostics *diagnostics);

#endif
