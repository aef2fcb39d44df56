/* One agent of a running scene, and its machines, as JSON for who looks at them. */
#ifndef JOX_LIVE_INSPECT_H
#define JOX_LIVE_INSPECT_H

#include "run/run.h"

/* inspect_graph.c: who set a parameter of a state (NULL: of the defaults), and to what. */
typedef struct JoxLiveSetBy {
    /* "state Circle behaviours/tawaf.lua:21", "mod calm ...", "program or page", "engine" */
    JoxText where;
    JoxText text;  /* the value as written */
    double number; /* NAN where it differs between agents or in time */
    int line;
} JoxLiveSetBy;
JoxLiveSetBy jox_live_set_by(const JoScene *scene, const JoxMachine *machine, const JoxState *state,
                             int parameter);
void jox_live_set_by_free(JoxLiveSetBy *by);
/* Writes the scene's machines, an array: name, path, version, reloads, start; defaults and states
   with their parameters; transitions with their conditions as written. */
void jox_live_graph(const JoScene *scene, JoxJson *json, const char *key);
/* Adds what jo_scene_inspect tells of an agent to an open object; false if there is nobody. */
bool jox_live_inspect(JoScene *scene, uint32_t slot, JoxJson *json);
/* Appends the line of Lua that would set a parameter for good, and where it belongs; false with
   why not. */
bool jox_live_lua_line(const JoScene *scene, const char *machine, const char *state,
                       const char *parameter, double value, JoxText *out);

#endif
