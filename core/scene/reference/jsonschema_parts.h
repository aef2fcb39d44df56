/* What the files of JSON Schemas share. */
#ifndef JOX_SCENE_JSONSCHEMA_PARTS_H
#define JOX_SCENE_JSONSCHEMA_PARTS_H

#include "base/format/json_writer.h"
#include "scene/format/schema.h"

/* jsonschema_demands.c: what an owner of keys must have, as the members "required" and "allOf";
   what a scene must have unless it is joined from several files. */
void jox_schema_demands(const char *owner, JoxJson *json);
void jox_schema_demands_of_scene(JoxJson *json);

#endif
