/* The torsos of people who are there when a scene starts: see starting_torsos.c. */
#ifndef JOX_RUN_STARTING_TORSOS_H
#define JOX_RUN_STARTING_TORSOS_H

#include "base/format/diag.h"
#include "jostle.h"

/* Turns the chests of people who would begin in others. Adds notes, at most one of a kind for each
   group: their torso is deeper than broad, so it is a disc; the disc for which they keep room is
   far from half their breadth; they begin deep in others all the same. */
void jox_run_start_torsos(JoScene *scene, JoxDiagnostics *diagnostics);

#endif
