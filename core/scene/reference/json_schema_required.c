/* Writes the part of JSON Schemas that says what must be there: required keys and alternatives.
   Called by json_schema.c. */
#include <string.h>

#include "scene/reference/json_schema_parts.h"
#include "scene/scene.h"

/* Writes {"required": [...]} of one key, or of two if `other` is not NULL. */
static void write_required_keys(JoxJson *json, const char *one, const char *other) {
    jox_json_object(json, NULL);
    jox_json_array(json, "required");
    jox_json_string(json, NULL, one);
    if (other)
        jox_json_string(json, NULL, other);
    jox_json_end(json);
    jox_json_end(json);
}

/* Writes the schema of a rule on alternative keys. */
static void write_alternative(const JoxAlternative *a, JoxJson *json) {
    char one[64], other[64];
    jox_json_object(json, NULL);
    if (a->rule != JOX_AT_MOST_ONE) {
        jox_json_array(json, a->rule == JOX_EXACTLY_ONE ? "oneOf" : "anyOf");
        for (int i = 0; jox_choice_name(a->keys, i, one, sizeof one); i++)
            write_required_keys(json, one, NULL);
        jox_json_end(json);
    } else {
        jox_json_object(json, "not");
        jox_json_array(json, "anyOf");
        for (int i = 0; jox_choice_name(a->keys, i, one, sizeof one); i++)
            for (int k = 0; k < i && jox_choice_name(a->keys, k, other, sizeof other); k++)
                write_required_keys(json, other, one);
        jox_json_end(json);
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_schema_write_required(const char *owner, JoxJson *json) {
    bool any = false;
    for (size_t i = 0; i < jox_scene_format.key_count; i++) {
        const JoxKey *key = &jox_scene_format.keys[i];
        if (strcmp(key->owner, owner) != 0 || *key->default_text != '!')
            continue;
        if (!any)
            jox_json_array(json, "required");
        any = true;
        jox_json_string(json, NULL, key->name);
    }
    if (any)
        jox_json_end(json);
    JoxText kinds = {0};
    jox_owner_list_kinds(&jox_scene_format, owner, &kinds);
    any = kinds.length > 0;
    if (any) {
        jox_json_array(json, "allOf");
        write_alternative(&(JoxAlternative){owner, kinds.data, JOX_EXACTLY_ONE}, json);
    }
    jox_text_free(&kinds);
    for (size_t i = 0; i < jox_scene_alternative_count; i++) {
        if (strcmp(jox_scene_alternatives[i].owner, owner) != 0)
            continue;
        if (!any)
            jox_json_array(json, "allOf");
        any = true;
        write_alternative(&jox_scene_alternatives[i], json);
    }
    if (any)
        jox_json_end(json);
}

/* Writes {"additionalProperties": {...}}: what each item of a map must have. */
static void write_required_of_items(JoxJson *json, const char *key, const char *owner) {
    jox_json_object(json, key);
    jox_json_object(json, "additionalProperties");
    jox_schema_write_required(owner, json);
    jox_json_end(json);
    jox_json_end(json);
}

void jox_schema_write_required_of_scene(JoxJson *json) {
    jox_json_object(json, "if");
    jox_json_array(json, "anyOf");
    write_required_keys(json, "include", NULL);
    write_required_keys(json, "patch", NULL);
    jox_json_end(json);
    jox_json_end(json);
    jox_json_object(json, "then");
    jox_json_end(json);
    jox_json_object(json, "else");
    jox_schema_write_required("scene", json);
    jox_json_object(json, "properties");
    write_required_of_items(json, "places", "place");
    write_required_of_items(json, "groups", "group");
    jox_json_end(json);
    jox_json_end(json);
}
