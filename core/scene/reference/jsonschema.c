/* JSON Schemas for editors, made of the table of keys. Stricter than loading in one way only: a
   text that stands for a plain number must be written as a number. */
#include <stdlib.h>
#include <string.h>

#include "agents/parameters.h"
#include "base/format/json_writer.h"
#include "scene/format/schema.h"
#include "scene/reference/jsonschema_parts.h"
#include "scene/scene.h"

#define DECIMAL "[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?"
#define LIST_OF_DECIMALS(least, most) " *" DECIMAL "( *,? *" DECIMAL "){" #least "," #most "} *"
static const char DRAWN[] = "^(normal\\(" LIST_OF_DECIMALS(1, 3) "\\)|uniform\\(" LIST_OF_DECIMALS(
    1, 1) "\\)|choose\\(" LIST_OF_DECIMALS(0, 7) "\\))$";

/* "unit_m_per_s": the definition of numbers with such a unit. */
static void unit_name(const char *kind, JoxText *out) {
    jox_text_add(out, "unit_");
    for (const char *c = kind; *c; c++) {
        if (*c == '/')
            jox_text_add(out, "_per_");
        else
            jox_text_append(out, c, 1);
    }
}

static void reference(JoxJson *json, const char *definition, int length) {
    jox_json_format(json, "$ref", "#/definitions/%.*s", length, definition);
}

static void type(JoxJson *json, const char *name) {
    jox_json_string(json, "type", name);
}

static void one_of_types(JoxJson *json, const char *const types[2]) {
    jox_json_array(json, "type");
    jox_json_string(json, NULL, types[0]);
    jox_json_string(json, NULL, types[1]);
    jox_json_end(json);
}

/* A text that matches a pattern: of the key, or in an array where `key` is NULL. */
static void matching(JoxJson *json, const char *key, const char *pattern) {
    jox_json_object(json, key);
    type(json, "string");
    jox_json_string(json, "pattern", pattern);
    jox_json_end(json);
}

/* Numbers with a unit of a kind; of any unit where `kind` is NULL. */
static void with_unit(JoxJson *json, const char *key, const char *kind) {
    JoxText pattern = {0};
    int count = 0;
    jox_text_add(&pattern, "^" DECIMAL " *(");
    for (size_t u = 0; u < jox_scene_unit_count; u++)
        if (!kind || !strcmp(jox_scene_units[u].kind, kind))
            jox_text_printf(&pattern, "%s%s", count++ ? "|" : "", jox_scene_units[u].name);
    jox_text_add(&pattern, ")?$");
    matching(json, key, pattern.data);
    jox_text_free(&pattern);
}

static void range(double least, double greatest, JoxJson *json) {
    if (least < greatest || least != 0) { /* both 0: none is given */
        jox_json_number(json, "minimum", least);
        jox_json_number(json, "maximum", greatest);
    }
}

static void quantity(const JoxKey *key, JoxJson *json) {
    if (!*key->unit) {
        type(json, "number");
        range(key->least, key->greatest, json);
        return;
    }
    JoxText unit = {0};
    unit_name(key->unit, &unit);
    jox_json_array(json, "anyOf");
    jox_json_object(json, NULL);
    type(json, "number");
    range(key->least, key->greatest, json);
    jox_json_end(json);
    jox_json_object(json, NULL);
    reference(json, unit.data, (int)unit.length);
    jox_json_end(json);
    jox_json_end(json);
    jox_text_free(&unit);
}

static void vector(const JoxKey *key, int count, JoxJson *json) {
    type(json, "array");
    jox_json_object(json, "items");
    quantity(key, json);
    jox_json_end(json);
    jox_json_integer(json, "minItems", count);
    jox_json_integer(json, "maxItems", count);
}

static bool has_units(const char *kind) {
    for (size_t u = 0; u < jox_scene_unit_count; u++)
        if (strcmp(jox_scene_units[u].kind, kind) == 0)
            return true;
    return false;
}

/* The words that stand for values of a parameter, if there are any. */
static void levels(JoxParameter parameter, JoxJson *json) {
    if (!jox_parameter_word(parameter, 0))
        return;
    jox_json_object(json, NULL);
    jox_json_array(json, "enum");
    for (uint32_t n = 0; jox_parameter_word(parameter, n); n++)
        jox_json_string(json, NULL, jox_parameter_word(parameter, n));
    jox_json_end(json);
    jox_json_end(json);
}

/* Values that a group sets: the parameters by name, else numbers, distributions and places. */
static void parameters(JoxJson *json) {
    jox_json_object(json, "properties");
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxParameterInfo *info = &jox_parameters[p];
        jox_json_object(json, info->name);
        jox_json_format(json, "description", "%s%s%s; %.9g to %.9g, default %.9g", info->meaning,
                        *info->unit ? ", in " : "", info->unit, info->least, info->greatest,
                        info->value);
        jox_json_array(json, "anyOf");
        jox_json_object(json, NULL);
        type(json, "number");
        range(info->least, info->greatest, json);
        jox_json_end(json);
        jox_json_object(json, NULL);
        reference(json, "drawn", 5);
        jox_json_end(json);
        if (has_units(info->unit)) {
            JoxText unit = {0};
            unit_name(info->unit, &unit);
            jox_json_object(json, NULL);
            reference(json, unit.data, (int)unit.length);
            jox_json_end(json);
            jox_text_free(&unit);
        }
        levels((JoxParameter)p, json);
        jox_json_end(json);
        jox_json_end(json);
    }
    jox_json_end(json);
}

/* Whether what is listed has names. */
static bool has_names(const char *owner, size_t length) {
    for (size_t k = 0; k < jox_scene_format.key_count; k++) {
        const JoxKey *key = &jox_scene_format.keys[k];
        if (strlen(key->owner) == length && !strncmp(key->owner, owner, length) &&
            !strcmp(key->name, "name"))
            return true;
    }
    return false;
}

/* What `of` says of the key, from its last suffix to its base; `length` of it is read. */
static void contents(const JoxKey *key, size_t length, JoxJson *json) {
    const char *of = key->of;
    if (length && of[length - 1] == '*') {
        if (length < strlen(of)) /* "mod:" alone takes a mod as it is */
            one_of_types(json, (const char *const[]){"object", "null"});
        else
            type(json, "object");
        if (!strcmp(of, "value*"))
            parameters(json);
        jox_json_object(json, "additionalProperties");
        contents(key, length - 1, json);
        jox_json_end(json);
    } else if (length && of[length - 1] == ']') {
        size_t open = length - 1;
        while (of[open] != '[')
            open--;
        if (has_names(of, open)) /* a map changes those that an included scene has */
            one_of_types(json, (const char *const[]){"array", "object"});
        else
            type(json, "array");
        if (open + 2 < length)
            jox_json_integer(json, "minItems", strtol(of + open + 1, NULL, 10));
        jox_json_object(json, "items");
        contents(key, open, json);
        jox_json_end(json);
    } else if (length == 2 && !strncmp(of, "xy", 2)) {
        const JoxKey metres = {.unit = "m", .least = -JOX_FARTHEST, .greatest = JOX_FARTHEST};
        vector(key->type == JOX_TYPE_POINTS ? key : &metres, 2, json);
    } else if (length == 3 && !strncmp(of, "xyz", 3)) {
        vector(key, 3, json);
    } else if (length == 5 && !strncmp(of, "start", 5)) {
        type(json, "array");
        jox_json_object(json, "items");
        reference(json, "quantity", 8);
        jox_json_end(json);
        jox_json_integer(json, "minItems", 3);
        jox_json_integer(json, "maxItems", 5);
    } else if (length == 6 && !strncmp(of, "weight", 6)) {
        type(json, "number");
        jox_json_integer(json, "exclusiveMinimum", 0);
        jox_json_integer(json, "maximum", 1000000);
    } else {
        reference(json, of, (int)length);
    }
}

/* An array of the texts of "this|that". */
static void listed(JoxJson *json, const char *key, const char *texts) {
    char name[64];
    jox_json_array(json, key);
    for (int i = 0; jox_choice_name(texts, i, name, sizeof name); i++)
        jox_json_string(json, NULL, name);
    jox_json_end(json);
}

/* The key's fixed values. */
static void choices(const JoxKey *key, JoxJson *json) {
    listed(json, "enum", key->choices);
}

/* One of the choices, or one name; or a list of them. */
static void names(const JoxKey *key, JoxJson *json) {
    jox_json_array(json, "anyOf");
    for (int list = 0; list < 2; list++) {
        jox_json_object(json, NULL);
        if (list) {
            type(json, "array");
            jox_json_object(json, "items");
        }
        if (key->choices)
            choices(key, json);
        else
            reference(json, "name", 4);
        if (list)
            jox_json_end(json);
        jox_json_end(json);
    }
    jox_json_end(json);
}

static void type_of(const JoxKey *key, JoxJson *json) {
    if (key->of) {
        contents(key, strlen(key->of), json);
        return;
    }
    switch (key->type) {
    case JOX_TYPE_NUMBER:
        quantity(key, json);
        return;
    case JOX_TYPE_WHOLE:
        type(json, "integer");
        range(key->least, key->greatest, json);
        return;
    case JOX_TYPE_BOOL:
        type(json, "boolean");
        return;
    case JOX_TYPE_POINT:
    case JOX_TYPE_POINT3:
        vector(key, key->type == JOX_TYPE_POINT ? 2 : 3, json);
        return;
    case JOX_TYPE_NAMES:
        names(key, json);
        return;
    default:
        break;
    }
    if (key->choices)
        choices(key, json);
    else
        one_of_types(json, (const char *const[]){"string", "number"}); /* a title may be 1984 */
}

/* The default of a key, as its type has it. */
static void standard(const JoxKey *key, JoxJson *json) {
    char *end;
    const double number = strtod(key->standard, &end);
    if (key->type == JOX_TYPE_BOOL)
        jox_json_bool(json, "default", !strcmp(key->standard, "true"));
    else if (key->type != JOX_TYPE_TEXT && end != key->standard && !*end)
        jox_json_number(json, "default", number);
    else if (key->type == JOX_TYPE_NAMES)
        listed(json, "default", key->standard);
    else
        jox_json_string(json, "default", key->standard);
}

static void property(const JoxKey *key, JoxJson *json) {
    const bool number = key->type == JOX_TYPE_NUMBER || key->type == JOX_TYPE_WHOLE;
    const bool ranged = number && (key->least != 0 || key->greatest != 0);
    const bool has_standard = *key->standard && *key->standard != '!';
    JoxText meaning = {0};
    jox_text_add(&meaning, key->meaning);
    if (*key->unit)
        jox_text_printf(&meaning, ", in %s", key->unit);
    if (ranged)
        jox_text_printf(&meaning, "; %.9g to %.9g", key->least, key->greatest);
    if (has_standard)
        jox_text_printf(&meaning, "%s default %s", ranged ? "," : ";", key->standard);
    for (size_t i = 0; key->type == JOX_TYPE_NAMES && has_standard && i < meaning.length; i++)
        meaning.data[i] = meaning.data[i] == '|' ? ' ' : meaning.data[i];
    jox_json_object(json, key->name);
    jox_json_string(json, "description", meaning.data);
    jox_text_free(&meaning);
    if (has_standard)
        standard(key, json);
    if (key->of && strchr("*]", key->of[strlen(key->of) - 1]) == NULL) {
        jox_json_array(json, "allOf"); /* what stands beside a $ref is not read */
        jox_json_object(json, NULL);
        type_of(key, json);
        jox_json_end(json);
        jox_json_end(json);
    } else {
        type_of(key, json);
    }
    jox_json_end(json);
}

/* Places and groups may come in part from another file: what they lack is looked at from the root.
 */
static bool joined(const char *owner) {
    return !strcmp(owner, "scene") || !strcmp(owner, "place") || !strcmp(owner, "group");
}

static void object(const char *owner, JoxJson *json) {
    type(json, "object");
    jox_json_bool(json, "additionalProperties", false);
    if (!joined(owner))
        jox_schema_demands(owner, json);
    const int lines = json->lines;
    json->lines = json->depth + 1; /* a line for each property */
    jox_json_object(json, "properties");
    for (size_t i = 0; i < jox_scene_format.key_count; i++)
        if (!strcmp(jox_scene_format.keys[i].owner, owner))
            property(&jox_scene_format.keys[i], json);
    jox_json_end(json);
    json->lines = lines;
}

static void any_of_types(JoxJson *json, const char *key, const char *const types[2]) {
    jox_json_object(json, key);
    jox_json_array(json, "anyOf");
    jox_json_object(json, NULL);
    if (types[1])
        one_of_types(json, types);
    else
        type(json, types[0]);
    jox_json_end(json);
}

static void shared_definitions(JoxJson *json) {
    jox_json_object(json, "name");
    one_of_types(json, (const char *const[]){"string", "number"});
    jox_json_end(json);
    any_of_types(json, "quantity", (const char *const[]){"number", NULL});
    with_unit(json, NULL, NULL);
    jox_json_end(json);
    jox_json_end(json);
    matching(json, "drawn", DRAWN);
    any_of_types(json, "draw", (const char *const[]){"number", "boolean"});
    jox_json_object(json, NULL);
    reference(json, "drawn", 5);
    jox_json_end(json);
    jox_json_end(json);
    jox_json_end(json);
    jox_json_object(json, "value");
    jox_json_array(json, "anyOf");
    jox_json_object(json, NULL);
    reference(json, "draw", 4);
    jox_json_end(json);
    matching(json, NULL, "^[^(]*$");
    jox_json_end(json);
    jox_json_end(json);
    for (size_t u = 0; u < jox_scene_unit_count; u++) {
        const char *kind = jox_scene_units[u].kind;
        bool known = false;
        for (size_t k = 0; k < u; k++)
            known |= !strcmp(jox_scene_units[k].kind, kind);
        if (known)
            continue;
        JoxText name = {0};
        unit_name(kind, &name);
        with_unit(json, name.data, kind);
        jox_text_free(&name);
    }
}

/* Whether the owner is described in the schema of this root. */
static bool belongs(const char *owner, const char *root) {
    bool mod = !strcmp(owner, "mod") || !strcmp(owner, "setting");
    return strcmp(owner, root) != 0 && mod == !strcmp(root, "mod");
}

void jox_scene_json_schema(const char *root_owner, JoxText *out) {
    bool scene = !strcmp(root_owner, "scene");
    JoxJson json = jox_json_begin(out, 1);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "$schema", "http://json-schema.org/draft-07/schema#");
    jox_json_string(&json, "title",
                    scene ? "A scene of Jostle" : "The mod.yaml of a mod for Jostle");
    object(root_owner, &json);
    if (scene)
        jox_schema_demands_of_scene(&json);
    json.lines = 2;
    jox_json_object(&json, "definitions");
    shared_definitions(&json);
    for (size_t i = 0; i < jox_scene_format.owner_count; i++) {
        if (!belongs(jox_scene_format.owners[i].name, root_owner))
            continue;
        jox_json_object(&json, jox_scene_format.owners[i].name);
        object(jox_scene_format.owners[i].name, &json);
        jox_json_end(&json);
    }
    jox_json_end(&json);
    jox_json_end(&json);
    jox_text_append(out, "\n", 1);
}
