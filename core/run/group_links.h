/* Links the groups of a specification to the machines, teams and tags of a scene, so that agents
   are made without comparing names. */
#ifndef JOX_RUN_GROUP_LINKS_H
#define JOX_RUN_GROUP_LINKS_H

#include "base/format/diag.h"
#include "jostle.h"
#include "scene/scene.h"

/* Fills in the links of the groups and sources of `spec`: machines of mixes, slots of values that
   are set, teams and tags. Must be called again when machines have been added or replaced. Adds an
   error for each value that a machine of the group's mix has no slot for, unless `diagnostics` is
   NULL. */
void jox_run_link_groups(JoScene *scene, JoxSceneSpec *spec, JoxDiagnostics *diagnostics);
/* Reports each value that groups set and that one of the machines of their mix has as another type,
   a place for a number or the reverse. Machines are found by path; those that are missing are
   passed over. */
void jox_run_check_value_types(const JoxSceneSpec *spec, const JoxMachine *const *machines,
                               uint32_t count, JoxSeverity severity, JoxDiagnostics *diagnostics);

#endif
