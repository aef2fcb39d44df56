/* Notes on torsos that hardly anybody wants: see torso_notes.c. */
#ifndef JOX_RUN_TORSO_NOTES_H
#define JOX_RUN_TORSO_NOTES_H

#include "base/format/diag.h"
#include "jostle.h"

/* Adds notes, at most one of a kind for each group, on the people who are there at the start: their
   torso is deeper than broad, so it is a disc; the disc for which they keep room is far from half
   their breadth; they begin deep in others. */
void jox_run_note_torsos(const JoScene *scene, JoxDiagnostics *diagnostics);

#endif
