/* What a JSON Schema says must be there: required keys, and alternatives of which one is. */
#include <stdio.h>
#include <string.h>

#include "scene/reference/jsonschema_parts.h"
#include "scene/scene.h"

/* {"required": [...]} of one key, or of two. */
static void requires(JoxJson *json, const char *one, const char *other) {
    jox_json_object(json, NULL);
    jox_json_array(json, "required");
    jox_json_string(json, NULL, one);
    if (other)
        jox_json_string(json, NULL, other);
    jox_json_end(json);
    jox_json_end(json);
}

/* Which of the alternatives' keys are required. */
static void alternative(const JoxAlternative *a, JoxJson *json) {
    char one[64], other[64];
    jox_json_object(json, NULL);
    if (a->rule != JOX_AT_MOST_ONE) {
        jox_json_array(json, a->rule == JOX_EXACTLY_ONE ? "oneOf" : "anyOf");
        for (int i = 0; jox_choice_name(a->keys, i, one, sizeof one); i++)
        requires(json, one, NULL);
        jox_json_end(json);
    } else {
        jox_json_object(json, "not");
        jox_json_array(json, "anyOf");
        for (int i = 0; jox_choice_name(a->keys, i, one, sizeof one); i++)
            for (int k = 0; k < i && jox_choice_name(a->keys, k, other, sizeof other); k++)
        requires(json, other, one);
        jox_json_end(json);
        jox_json_end(json);
    }
    jox_json_end(json);
}

/* What must be there: the members "required" and "allOf". */
void jox_schema_demands(const char *owner, JoxJson *json) {
    bool any = false;
    for (size_t i = 0; i < jox_scene_format.key_count; i++) {
        const JoxKey *key = &jox_scene_format.keys[i];
        if (strcmp(key->owner, owner) != 0 || *key->standard != '!')
            continue;
        if (!any)
            jox_json_array(json, "required");
        any = true;
        jox_json_string(json, NULL, key->name);
    }
    if (any)
        jox_json_end(json);
    JoxText kinds = {0};
    jox_owner_kinds(&jox_scene_format, owner, &kinds);
    any = kinds.length > 0;
    if (any) {
        jox_json_array(json, "allOf");
        alternative(&(JoxAlternative){owner, kinds.data, JOX_EXACTLY_ONE}, json);
    }
    jox_text_free(&kinds);
    for (size_t i = 0; i < jox_scene_alternative_count; i++) {
        if (strcmp(jox_scene_alternatives[i].owner, owner) != 0)
            continue;
        if (!any)
            jox_json_array(json, "allOf");
        any = true;
        alternative(&jox_scene_alternatives[i], json);
    }
    if (any)
        jox_json_end(json);
}

/* {"additionalProperties": {what the owner must have}} */
static void demands_of_all(JoxJson *json, const char *key, const char *owner) {
    jox_json_object(json, key);
    jox_json_object(json, "additionalProperties");
    jox_schema_demands(owner, json);
    jox_json_end(json);
    jox_json_end(json);
}

/* What a scene must have unless it is joined from several files. */
void jox_schema_demands_of_scene(JoxJson *json) {
    jox_json_object(json, "if");
    jox_json_array(json, "anyOf");
    requires(json, "include", NULL);
    requires(json, "patch", NULL);
    jox_json_end(json);
    jox_json_end(json);
    jox_json_object(json, "then");
    jox_json_end(json);
    jox_json_object(json, "else");
    jox_schema_demands("scene", json);
    jox_json_object(json, "properties");
    demands_of_all(json, "places", "place");
    demands_of_all(json, "groups", "group");
    jox_json_end(json);
    jox_json_end(json);
}
