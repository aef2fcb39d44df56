/* Prints the table of keys as JSON Schemas, for editors. They are stricter than the reader of
   scenes in one way: a number without a unit must not be quoted. */
#include <stdlib.h>
#include <string.h>

#include "agents/parameters.h"
#include "base/format/json_writer.h"
#include "scene/format/keys.h"
#include "scene/reference/json_schema_parts.h"
#include "scene/scene.h"

#define DECIMAL "[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?"
#define LIST_OF_DECIMALS(least, most) " *" DECIMAL "( *,? *" DECIMAL "){" #least "," #most "} *"
static const char DRAWN[] = "^(normal\\(" LIST_OF_DECIMALS(1, 3) "\\)|uniform\\(" LIST_OF_DECIMALS(
    1, 1) "\\)|choose\\(" LIST_OF_DECIMALS(0, 7) "\\))$";

/* Prints the name of the definition of numbers with a unit: "unit_m_per_s". */
static void print_unit_name(const char *kind, JoxText *out) {
    jox_text_add(out, "unit_");
    for (const char *c = kind; *c; c++) {
        if (*c == '/')
            jox_text_add(out, "_per_");
        else
            jox_text_append(out, c, 1);
    }
}

static void write_reference(JoxJson *json, const char *definition, int length) {
    jox_json_format(json, "$ref", "#/definitions/%.*s", length, definition);
}

static void write_type(JoxJson *json, const char *name) {
    jox_json_string(json, "type", name);
}

static void write_types(JoxJson *json, const char *const types[2]) {
    jox_json_array(json, "type");
    jox_json_string(json, NULL, types[0]);
    jox_json_string(json, NULL, types[1]);
    jox_json_end(json);
}

/* Writes the schema of a text that matches a pattern, as member `key`; NULL: as an item of an
   array. */
static void write_pattern(JoxJson *json, const char *key, const char *pattern) {
    jox_json_object(json, key);
    write_type(json, "string");
    jox_json_string(json, "pattern", pattern);
    jox_json_end(json);
}

/* Writes the schema of texts that are a number with a unit of a dimension; NULL: with any unit. */
static void write_number_with_unit(JoxJson *json, const char *key, const char *kind) {
    JoxText pattern = {0};
    int count = 0;
    jox_text_add(&pattern, "^" DECIMAL " *(");
    for (size_t u = 0; u < jox_scene_unit_count; u++)
        if (!kind || !strcmp(jox_scene_units[u].kind, kind))
            jox_text_printf(&pattern, "%s%s", count++ ? "|" : "", jox_scene_units[u].name);
    jox_text_add(&pattern, ")?$");
    write_pattern(json, key, pattern.data);
    jox_text_free(&pattern);
}

static void write_range(double least, double greatest, JoxJson *json) {
    if (least < greatest || least != 0) { /* both 0: no range */
        jox_json_number(json, "minimum", least);
        jox_json_number(json, "maximum", greatest);
    }
}

static void write_quantity(const JoxKey *key, JoxJson *json) {
    if (!*key->unit) {
        write_type(json, "number");
        write_range(key->least, key->greatest, json);
        return;
    }
    JoxText unit = {0};
    print_unit_name(key->unit, &unit);
    jox_json_array(json, "anyOf");
    jox_json_object(json, NULL);
    write_type(json, "number");
    write_range(key->least, key->greatest, json);
    jox_json_end(json);
    jox_json_object(json, NULL);
    write_reference(json, unit.data, (int)unit.length);
    jox_json_end(json);
    jox_json_end(json);
    jox_text_free(&unit);
}

static void write_vector(const JoxKey *key, int count, JoxJson *json) {
    write_type(json, "array");
    jox_json_object(json, "items");
    write_quantity(key, json);
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

/* Writes the words that stand for values of a parameter, if it has any. */
static void write_parameter_words(JoxParameter parameter, JoxJson *json) {
    if (!jox_parameter_word(parameter, 0))
        return;
    jox_json_object(json, NULL);
    jox_json_array(json, "enum");
    for (uint32_t n = 0; jox_parameter_word(parameter, n); n++)
        jox_json_string(json, NULL, jox_parameter_word(parameter, n));
    jox_json_end(json);
    jox_json_end(json);
}

/* Writes the properties of `set` of a group: a schema for each parameter. */
static void write_parameters(JoxJson *json) {
    jox_json_object(json, "properties");
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxParameterInfo *info = &jox_parameters[p];
        jox_json_object(json, info->name);
        jox_json_format(json, "description", "%s%s%s; %.9g to %.9g, default %.9g", info->meaning,
                        *info->unit ? ", in " : "", info->unit, info->least, info->greatest,
                        info->value);
        jox_json_array(json, "anyOf");
        jox_json_object(json, NULL);
        write_type(json, "number");
        write_range(info->least, info->greatest, json);
        jox_json_end(json);
        jox_json_object(json, NULL);
        write_reference(json, "drawn", 5);
        jox_json_end(json);
        if (has_units(info->unit)) {
            JoxText unit = {0};
            print_unit_name(info->unit, &unit);
            jox_json_object(json, NULL);
            write_reference(json, unit.data, (int)unit.length);
            jox_json_end(json);
            jox_text_free(&unit);
        }
        write_parameter_words((JoxParameter)p, json);
        jox_json_end(json);
        jox_json_end(json);
    }
    jox_json_end(json);
}

/* Whether items of an owner have names: whether it has a key `name`. */
static bool owner_has_name(const char *owner, size_t length) {
    for (size_t k = 0; k < jox_scene_format.key_count; k++) {
        const JoxKey *key = &jox_scene_format.keys[k];
        if (strlen(key->owner) == length && !strncmp(key->owner, owner, length) &&
            !strcmp(key->name, "name"))
            return true;
    }
    return false;
}

/* Writes the schema of the first `length` bytes of the key's content: its last suffix, then the
   rest recursively. */
static void write_content(const JoxKey *key, size_t length, JoxJson *json) {
    const char *content = key->content;
    if (length && content[length - 1] == '*') {
        if (length < strlen(content)) /* "mod:" without settings is null */
            write_types(json, (const char *const[]){"object", "null"});
        else
            write_type(json, "object");
        if (!strcmp(content, "value*"))
            write_parameters(json);
        jox_json_object(json, "additionalProperties");
        write_content(key, length - 1, json);
        jox_json_end(json);
    } else if (length && content[length - 1] == ']') {
        size_t open = length - 1;
        while (content[open] != '[')
            open--;
        if (owner_has_name(content, open)) /* a map changes items of an included scene by name */
            write_types(json, (const char *const[]){"array", "object"});
        else
            write_type(json, "array");
        if (open + 2 < length)
            jox_json_integer(json, "minItems", strtol(content + open + 1, NULL, 10));
        jox_json_object(json, "items");
        write_content(key, open, json);
        jox_json_end(json);
    } else if (length == 2 && !strncmp(content, "xy", 2)) {
        const JoxKey metres = {.unit = "m", .least = -JOX_FARTHEST, .greatest = JOX_FARTHEST};
        write_vector(key->type == JOX_TYPE_POINTS ? key : &metres, 2, json);
    } else if (length == 3 && !strncmp(content, "xyz", 3)) {
        write_vector(key, 3, json);
    } else if (length == 5 && !strncmp(content, "spots", 5)) {
        jox_json_array(json, "anyOf");
        jox_json_object(json, NULL);
        write_vector(key, 2, json);
        jox_json_end(json);
        jox_json_object(json, NULL);
        write_type(json, "array");
        jox_json_object(json, "items");
        write_vector(key, 2, json);
        jox_json_end(json);
        jox_json_integer(json, "minItems", 1);
        jox_json_end(json);
        jox_json_end(json);
    } else if (length == 5 && !strncmp(content, "start", 5)) {
        write_type(json, "array");
        jox_json_object(json, "items");
        write_reference(json, "quantity", 8);
        jox_json_end(json);
        jox_json_integer(json, "minItems", 3);
        jox_json_integer(json, "maxItems", 5);
    } else if (length == 6 && !strncmp(content, "weight", 6)) {
        write_type(json, "number");
        jox_json_integer(json, "exclusiveMinimum", 0);
        jox_json_integer(json, "maximum", 1000000);
    } else {
        write_reference(json, content, (int)length);
    }
}

/* Writes an array of the texts of "this|that". */
static void write_texts(JoxJson *json, const char *key, const char *texts) {
    char name[64];
    jox_json_array(json, key);
    for (int i = 0; jox_choice_name(texts, i, name, sizeof name); i++)
        jox_json_string(json, NULL, name);
    jox_json_end(json);
}

/* Writes the key's allowed values. */
static void write_choices(const JoxKey *key, JoxJson *json) {
    write_texts(json, "enum", key->choices);
}

/* Writes the schema of one name or choice, or a list of them. */
static void write_names_schema(const JoxKey *key, JoxJson *json) {
    jox_json_array(json, "anyOf");
    for (int list = 0; list < 2; list++) {
        jox_json_object(json, NULL);
        if (list) {
            write_type(json, "array");
            jox_json_object(json, "items");
        }
        if (key->choices)
            write_choices(key, json);
        else
            write_reference(json, "name", 4);
        if (list)
            jox_json_end(json);
        jox_json_end(json);
    }
    jox_json_end(json);
}

static void write_key_type(const JoxKey *key, JoxJson *json) {
    if (key->content) {
        write_content(key, strlen(key->content), json);
        return;
    }
    switch (key->type) {
    case JOX_TYPE_NUMBER:
        write_quantity(key, json);
        return;
    case JOX_TYPE_WHOLE:
        write_type(json, "integer");
        write_range(key->least, key->greatest, json);
        return;
    case JOX_TYPE_BOOL:
        write_type(json, "boolean");
        return;
    case JOX_TYPE_POINT:
    case JOX_TYPE_POINT3:
        write_vector(key, key->type == JOX_TYPE_POINT ? 2 : 3, json);
        return;
    case JOX_TYPE_NAMES:
        write_names_schema(key, json);
        return;
    default:
        break;
    }
    if (key->choices)
        write_choices(key, json);
    else
        write_types(json, (const char *const[]){"string", "number"}); /* a title may be 1984 */
}

/* Writes the default of a key, by its type. */
static void write_default(const JoxKey *key, JoxJson *json) {
    char *end;
    const double number = strtod(key->default_text, &end);
    if (key->type == JOX_TYPE_BOOL)
        jox_json_bool(json, "default", !strcmp(key->default_text, "true"));
    else if (key->type != JOX_TYPE_TEXT && end != key->default_text && !*end)
        jox_json_number(json, "default", number);
    else if (key->type == JOX_TYPE_NAMES)
        write_texts(json, "default", key->default_text);
    else
        jox_json_string(json, "default", key->default_text);
}

static void write_property(const JoxKey *key, JoxJson *json) {
    const bool number = key->type == JOX_TYPE_NUMBER || key->type == JOX_TYPE_WHOLE;
    const bool ranged = number && (key->least != 0 || key->greatest != 0);
    const bool has_standard = *key->default_text && *key->default_text != '!';
    JoxText meaning = {0};
    jox_text_add(&meaning, key->meaning);
    if (*key->unit)
        jox_text_printf(&meaning, ", in %s", key->unit);
    if (ranged)
        jox_text_printf(&meaning, "; %.9g to %.9g", key->least, key->greatest);
    if (has_standard)
        jox_text_printf(&meaning, "%s default %s", ranged ? "," : ";", key->default_text);
    for (size_t i = 0; key->type == JOX_TYPE_NAMES && has_standard && i < meaning.length; i++)
        meaning.data[i] = meaning.data[i] == '|' ? ' ' : meaning.data[i];
    jox_json_object(json, key->name);
    jox_json_string(json, "description", meaning.data);
    jox_text_free(&meaning);
    if (has_standard)
        write_default(key, json);
    if (key->content && strchr("*]", key->content[strlen(key->content) - 1]) == NULL) {
        jox_json_array(json, "allOf"); /* members beside a $ref are ignored */
        jox_json_object(json, NULL);
        write_key_type(key, json);
        jox_json_end(json);
        jox_json_end(json);
    } else {
        write_key_type(key, json);
    }
    jox_json_end(json);
}

/* Whether a map may be completed by another file: then the root says what it must have
   (jox_schema_write_required_of_scene). */
static bool is_joined(const char *owner) {
    return !strcmp(owner, "scene") || !strcmp(owner, "place") || !strcmp(owner, "group");
}

static void write_owner_schema(const char *owner, JoxJson *json) {
    write_type(json, "object");
    jox_json_bool(json, "additionalProperties", false);
    if (!is_joined(owner))
        jox_schema_write_required(owner, json);
    const int lines = json->lines;
    json->lines = json->depth + 1; /* a line for each property */
    jox_json_object(json, "properties");
    for (size_t i = 0; i < jox_scene_format.key_count; i++)
        if (!strcmp(jox_scene_format.keys[i].owner, owner))
            write_property(&jox_scene_format.keys[i], json);
    jox_json_end(json);
    json->lines = lines;
}

static void open_any_of(JoxJson *json, const char *key, const char *const types[2]) {
    jox_json_object(json, key);
    jox_json_array(json, "anyOf");
    jox_json_object(json, NULL);
    if (types[1])
        write_types(json, types);
    else
        write_type(json, types[0]);
    jox_json_end(json);
}

static void write_shared_definitions(JoxJson *json) {
    static const char *const PLAIN[] = {"number", "boolean", "string"};
    jox_json_object(json, "name");
    write_types(json, (const char *const[]){"string", "number"});
    jox_json_end(json);
    open_any_of(json, "quantity", (const char *const[]){"number", NULL});
    write_number_with_unit(json, NULL, NULL);
    jox_json_end(json);
    jox_json_end(json);
    write_pattern(json, "drawn", DRAWN);
    open_any_of(json, "draw", (const char *const[]){"number", "boolean"});
    jox_json_object(json, NULL);
    write_reference(json, "drawn", 5);
    jox_json_end(json);
    jox_json_end(json);
    jox_json_end(json);
    jox_json_object(json, "plain");
    jox_json_array(json, "type");
    for (size_t t = 0; t < sizeof PLAIN / sizeof *PLAIN; t++)
        jox_json_string(json, NULL, PLAIN[t]);
    jox_json_end(json);
    jox_json_end(json);
    jox_json_object(json, "value");
    jox_json_array(json, "anyOf");
    jox_json_object(json, NULL);
    write_reference(json, "draw", 4);
    jox_json_end(json);
    write_pattern(json, NULL, "^[^(]*$");
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
        print_unit_name(kind, &name);
        write_number_with_unit(json, name.data, kind);
        jox_text_free(&name);
    }
}

/* Whether the schema of a root defines an owner. */
static bool belongs_to_root(const char *owner, const char *root) {
    bool mod = !strcmp(owner, "mod") || !strcmp(owner, "setting");
    return strcmp(owner, root) != 0 && mod == !strcmp(root, "mod");
}

void jox_scene_print_json_schema(const char *root_owner, JoxText *out) {
    bool scene = !strcmp(root_owner, "scene");
    JoxJson json = jox_json_begin(out, 1);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "$schema", "http://json-schema.org/draft-07/schema#");
    jox_json_string(&json, "title",
                    scene ? "A scene of Jostle" : "The mod.yaml of a mod for Jostle");
    write_owner_schema(root_owner, &json);
    if (scene)
        jox_schema_write_required_of_scene(&json);
    json.lines = 2;
    jox_json_object(&json, "definitions");
    write_shared_definitions(&json);
    for (size_t i = 0; i < jox_scene_format.owner_count; i++) {
        if (!belongs_to_root(jox_scene_format.owners[i].name, root_owner))
            continue;
        jox_json_object(&json, jox_scene_format.owners[i].name);
        write_owner_schema(jox_scene_format.owners[i].name, &json);
        jox_json_end(&json);
    }
    jox_json_end(&json);
    jox_json_end(&json);
    jox_text_append(out, "\n", 1);
}
