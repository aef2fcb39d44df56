/* The part of a JSON Schema that says what a map must have; called by json_schema.c. */
#ifndef JOX_SCENE_JSON_SCHEMA_PARTS_H
#define JOX_SCENE_JSON_SCHEMA_PARTS_H

#include "base/format/json_writer.h"
#include "scene/format/keys.h"

/* Writes the members "required" and "allOf" of an owner's schema: its required keys and its
   alternatives. */
void jox_schema_write_required(const char *owner, JoxJson *json);
/* Writes the members "if", "then" and "else" of the schema of scenes: what a scene must have unless
   it includes or patches another. */
void jox_schema_write_required_of_scene(JoxJson *json);

#endif
