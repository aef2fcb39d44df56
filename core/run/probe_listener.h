/* The listener that runs the scene's probes. */
#ifndef JOX_RUN_PROBE_LISTENER_H
#define JOX_RUN_PROBE_LISTENER_H

#include "base/format/json_writer.h"
#include "jostle.h"
#include "record/probes/probe.h"

/* Attaches the listener, if the scene has probes. */
void jox_run_collect_probes(JoScene *scene);
/* The n-th probe; NULL past the last. */
const JoxProbe *jox_run_probe(const JoScene *scene, uint32_t n);
/* Adds ,"probes": {...} to a summary. */
void jox_run_add_probes(const JoScene *scene, JoxJson *json);

#endif
