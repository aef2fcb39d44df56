/* One agent of a running scene, and the scene's state machines, as JSON. The live page sends them
   to browsers; jo_scene_inspect returns an agent to programs. */
#ifndef JOX_LIVE_INSPECT_H
#define JOX_LIVE_INSPECT_H

#include "base/format/json_writer.h"
#include "run/run.h"

/* inspect_graph.c: the value of a parameter and the place that set it. */
typedef struct JoxLiveSetBy {
    /* "state Circle behaviours/tawaf.lua:21", "mod calm ...", "program or page", "engine" */
    JoxText where;
    JoxText text;  /* the value as its file writes it */
    double number; /* the value; NAN if it differs between agents or over time */
    int line; /* in the file that sets it; 0: the engine's value, JOX_LINE_LIVE: set at run time */
} JoxLiveSetBy;
/* Looks up a parameter (an index of jox_parameters) of a state, or of the machine's defaults where
   `state` is NULL or does not set it. The caller frees the result. */
JoxLiveSetBy jox_live_set_by(const JoScene *scene, const JoxMachine *machine, const JoxState *state,
                             int parameter);
void jox_live_set_by_free(JoxLiveSetBy *by);
/* Adds the member `key`, an array of the scene's machines: name, path, version, reloads, start;
   defaults and states with their parameters; transitions with their conditions as written. */
void jox_live_add_machines(const JoScene *scene, JoxJson *json, const char *key);
/* Adds the members that jo_scene_inspect documents to an open object. The first call for a slot
   starts the recording of that agent's steps. Returns false, with "agent" null, for an empty
   slot. */
bool jox_live_inspect(JoScene *scene, uint32_t slot, JoxJson *json);
/* Appends a line of Lua that sets a parameter to `value`, with a comment that names the file and
   line to paste it at. Returns false with the reason in `out` if the scene has no such
   parameter. */
bool jox_live_lua_line(const JoScene *scene, const char *machine, const char *state,
                       const char *parameter, double value, JoxText *out);

#endif
