/* One agent of a running scene, and the scene's state machines, as JSON. The live page sends them
   to browsers; jo_scene_inspect returns an agent to programs. */
#ifndef JOX_LIVE_INSPECT_H
#define JOX_LIVE_INSPECT_H

#include "base/format/json_writer.h"
#include "run/run.h"

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
