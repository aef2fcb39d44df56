/* Notes what a scene in literal mode sets in vain. */
#ifndef JOX_RUN_LITERAL_NOTES_H
#define JOX_RUN_LITERAL_NOTES_H

#include "base/format/diag.h"
#include "jostle.h"

/* Adds a note for each parameter that has no effect in literal mode and that a behaviour or the
   scene sets, where that is done first. Nothing in other modes. */
void jox_run_note_literal(const JoScene *scene, JoxDiagnostics *diagnostics);

#endif
