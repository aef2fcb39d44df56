/* Notes where a scene measures flow of people who walk by ORCA, which is not fit for capacities. */
#ifndef JOX_RUN_ORCA_FLOW_NOTE_H
#define JOX_RUN_ORCA_FLOW_NOTE_H

#include "base/format/diag.h"
#include "jostle.h"

/* Adds a note if a probe measures flow and a group walks by ORCA in place of the walking law, for
   the first such group. False: there is none. */
bool jox_run_note_orca_flow(const JoScene *scene, JoxDiagnostics *diagnostics);

/* Returns whether people of a group walk somewhere, in some state, by ORCA, or (`orca` false) by
   the walking law. */
bool jox_run_group_walks_by(const JoScene *scene, uint32_t group, bool orca);

#endif
