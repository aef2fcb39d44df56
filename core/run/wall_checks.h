/* Checks whether walls, gates and bodies keep people from coming in by sources or from reaching
   their goals. */
#ifndef JOX_RUN_WALL_CHECKS_H
#define JOX_RUN_WALL_CHECKS_H

#include "base/format/diag.h"
#include "base/text.h"
#include "jostle.h"
#include "world/routes/hindrance.h"

/* Adds an error for each source that lies in walls, and a warning for one of which a part does. */
void jox_run_check_sources(const JoScene *scene, JoxDiagnostics *diagnostics);
/* Warns of steps of journeys whose places lie in walls. */
void jox_run_check_journeys(const JoScene *scene, JoxDiagnostics *diagnostics);
/* Warns of goals that people as broad as they are cannot reach: walls, fixed bodies or a gate that
   nothing opens lie between. Adds a person for each source: the scene must not be stepped after. */
void jox_run_check_goals(JoScene *scene, JoxDiagnostics *diagnostics);

/* Returns whether a hindrance is a fault of the scene: doors, gates and lifts that something moves
   or puts in use are none. */
bool jox_run_is_fault(const JoScene *scene, const JoxHindrance *hindrance);
/* Returns whether somebody who cannot use stairs is kept by stairs or a lift alone, and has a
   refuge on its storey: it waits there. */
bool jox_run_waits_in_refuge(const JoScene *scene, const JoxKept *kept, JoxHindranceKind kind);
/* Returns the name of the lift that keeps people from a place, "" if none is known. */
const char *jox_run_name_of_lift(const JoScene *scene, const JoxHindrance *hindrance);
/* Appends what keeps people from a place: "the body 'crate' fills the way at (3.0, 4.0) m". */
void jox_run_say_hindrance(const JoScene *scene, const JoxHindrance *hindrance, JoxText *out);
/* Whether an event or a line of the input log opens the walls named `gate`, or a person or program
   has set them while no event closes them. */
bool jox_run_has_gate_opener(const JoScene *scene, const char *gate);
/* Returns the same for each ring of the world's walls; freed by jox_free. */
bool *jox_run_list_gates_with_opener(const JoScene *scene);

#endif
