/* Numbers of the signals that the events of a scene give. */
#ifndef JOX_RUN_EVENT_SIGNALS_H
#define JOX_RUN_EVENT_SIGNALS_H

#include "base/format/diag.h"
#include "jostle.h"

/* Numbers the signals of the scene's events, so that a step finds them; warns of those that no
   machine hears. `diagnostics` may be NULL. */
void jox_run_number_event_signals(JoScene *scene, JoxDiagnostics *diagnostics);

#endif
