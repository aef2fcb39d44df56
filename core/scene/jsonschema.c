/* JSON Schemas for editors, made of the table of keys. Stricter than loading in one way only: a
   text that stands for a plain number must be written as a number. */
#include <string.h>

#include "agents/parameters.h"
#include "scene/scene.h"
#include "scene/schema.h"

#define DECIMAL "[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?"
#define LIST_OF_DECIMALS(least, most) " *" DECIMAL "( *,? *" DECIMAL "){" #least "," #most "} *"
static const char DRAWN[] = "^(normal\\(" LIST_OF_DECIMALS(1, 3) "\\)|uniform\\(" LIST_OF_DECIMALS(
    1, 1) "\\)|choose\\(" LIST_OF_DECIMALS(0, 7) "\\))$";

/* "unit_m_per_s": the definition of numbers with such a unit. */
static void unit_reference(const char *kind, JoxText *out) {
    jox_text_add(out, "unit_");
    for (const char *c = kind; *c; c++) {
        if (*c == '/')
            jox_text_add(out, "_per_");
        else
            jox_text_append(out, c, 1);
    }
}

/* The pattern of numbers with a unit of a kind; of any unit where `kind` is NULL. */
static void unit_pattern(const char *kind, JoxText *out) {
    JoxText pattern = {0};
    int count = 0;
    jox_text_add(&pattern, "^" DECIMAL " *(");
    for (size_t u = 0; u < jox_scene_unit_count; u++)
        if (!kind || !strcmp(jox_scene_units[u].kind, kind))
            jox_text_printf(&pattern, "%s%s", count++ ? "|" : "", jox_scene_units[u].name);
    jox_text_add(&pattern, ")?$");
    jox_text_add(out, "{\"type\": \"string\", \"pattern\": ");
    jox_text_json(out, pattern.data);
    jox_text_add(out, "}");
    jox_text_free(&pattern);
}

static void range(double least, double greatest, JoxText *out) {
    if (least < greatest || least != 0) /* both 0: none is given */
        jox_text_printf(out, ", \"minimum\": %.9g, \"maximum\": %.9g", least, greatest);
}

static void quantity(const JoxKey *key, JoxText *out) {
    jox_text_add(out, *key->unit ? "\"anyOf\": [{\"type\": \"number\"" : "\"type\": \"number\"");
    range(key->least, key->greatest, out);
    if (!*key->unit)
        return;
    jox_text_add(out, "}, {\"$ref\": \"#/definitions/");
    unit_reference(key->unit, out);
    jox_text_add(out, "\"}]");
}

static void vector(const JoxKey *key, int count, JoxText *out) {
    jox_text_add(out, "\"type\": \"array\", \"items\": {");
    quantity(key, out);
    jox_text_printf(out, "}, \"minItems\": %d, \"maxItems\": %d", count, count);
}

/* Values that a group sets: the parameters by name, else numbers, distributions and places. */
static void parameters(JoxText *out) {
    jox_text_add(out, ", \"properties\": {");
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxParameterInfo *info = &jox_parameters[p];
        JoxText meaning = {0};
        jox_text_printf(&meaning, "%s%s%s; %.9g to %.9g, default %.9g", info->meaning,
                        *info->unit ? ", in " : "", info->unit, info->least, info->greatest,
                        info->value);
        jox_text_printf(out, "%s\n    \"%s\": {\"description\": ", p ? "," : "", info->name);
        jox_text_json(out, meaning.data);
        jox_text_add(out, ", \"anyOf\": [{\"type\": \"number\"");
        range(info->least, info->greatest, out);
        jox_text_add(out, "}, {\"$ref\": \"#/definitions/drawn\"}]}");
        jox_text_free(&meaning);
    }
    jox_text_add(out, "}");
}

/* What `of` says of the key, from its last suffix to its base; `length` of it is read. */
static void contents(const JoxKey *key, size_t length, JoxText *out) {
    const char *of = key->of;
    if (length && of[length - 1] == '*') {
        bool inner = length < strlen(of); /* "mod:" alone takes a mod as it is */
        jox_text_add(out, inner ? "\"type\": [\"object\", \"null\"]" : "\"type\": \"object\"");
        if (!strcmp(of, "value*"))
            parameters(out);
        jox_text_add(out, ", \"additionalProperties\": {");
        contents(key, length - 1, out);
        jox_text_add(out, "}");
    } else if (length && of[length - 1] == ']') {
        size_t open = length - 1;
        while (of[open] != '[')
            open--;
        jox_text_add(out, "\"type\": \"array\"");
        if (open + 2 < length)
            jox_text_printf(out, ", \"minItems\": %.*s", (int)(length - open - 2), of + open + 1);
        jox_text_add(out, ", \"items\": {");
        contents(key, open, out);
        jox_text_add(out, "}");
    } else if (length == 2 && !strncmp(of, "xy", 2)) {
        const JoxKey metres = {.unit = "m", .least = -JOX_FARTHEST, .greatest = JOX_FARTHEST};
        vector(key->type == JOX_TYPE_POINTS ? key : &metres, 2, out);
    } else if (length == 3 && !strncmp(of, "xyz", 3)) {
        vector(key, 3, out);
    } else if (length == 6 && !strncmp(of, "weight", 6)) {
        jox_text_add(out, "\"type\": \"number\", \"exclusiveMinimum\": 0, \"maximum\": 1000000");
    } else {
        jox_text_printf(out, "\"$ref\": \"#/definitions/%.*s\"", (int)length, of);
    }
}

/* The key's fixed values. */
static void choices(const JoxKey *key, JoxText *out) {
    char name[64];
    jox_text_add(out, "\"enum\": [");
    for (int i = 0; jox_choice_name(key->choices, i, name, sizeof name); i++)
        jox_text_printf(out, "%s\"%s\"", i ? ", " : "", name);
    jox_text_add(out, "]");
}

static void type_of(const JoxKey *key, JoxText *out) {
    if (key->of) {
        contents(key, strlen(key->of), out);
        return;
    }
    switch (key->type) {
    case JOX_TYPE_NUMBER:
        quantity(key, out);
        return;
    case JOX_TYPE_WHOLE:
        jox_text_add(out, "\"type\": \"integer\"");
        range(key->least, key->greatest, out);
        return;
    case JOX_TYPE_BOOL:
        jox_text_add(out, "\"type\": \"boolean\"");
        return;
    case JOX_TYPE_POINT:
    case JOX_TYPE_POINT3:
        vector(key, key->type == JOX_TYPE_POINT ? 2 : 3, out);
        return;
    case JOX_TYPE_NAMES:
        if (key->choices) {
            jox_text_add(out, "\"anyOf\": [{");
            choices(key, out);
            jox_text_add(out, "}, {\"type\": \"array\", \"items\": {");
            choices(key, out);
            jox_text_add(out, "}}]");
            return;
        }
        jox_text_add(out, "\"anyOf\": [{\"$ref\": \"#/definitions/name\"}, "
                          "{\"type\": \"array\", \"items\": {\"$ref\": \"#/definitions/name\"}}]");
        return;
    default:
        break;
    }
    if (!key->choices) {
        jox_text_add(out, "\"type\": [\"string\", \"number\"]"); /* a title may be 1984 */
        return;
    }
    choices(key, out);
}

static void property(const JoxKey *key, JoxText *out) {
    JoxText meaning = {0};
    bool number = key->type == JOX_TYPE_NUMBER || key->type == JOX_TYPE_WHOLE;
    bool ranged = number && (key->least != 0 || key->greatest != 0);
    jox_text_add(&meaning, key->meaning);
    if (*key->unit)
        jox_text_printf(&meaning, ", in %s", key->unit);
    if (ranged)
        jox_text_printf(&meaning, "; %.9g to %.9g", key->least, key->greatest);
    if (*key->standard && *key->standard != '!')
        jox_text_printf(&meaning, "%s default %s", ranged ? "," : ";", key->standard);
    jox_text_printf(out, "\"%s\": {\"description\": ", key->name);
    jox_text_json(out, meaning.data);
    jox_text_free(&meaning);
    jox_text_add(out, ", ");
    if (*key->standard && *key->standard != '!') {
        bool text = key->type == JOX_TYPE_TEXT;
        jox_text_printf(out, text ? "\"default\": \"%s\", " : "\"default\": %s, ", key->standard);
    }
    if (key->of && strchr("*]", key->of[strlen(key->of) - 1]) == NULL) {
        jox_text_add(out, "\"allOf\": [{"); /* what stands beside a $ref is not read */
        type_of(key, out);
        jox_text_add(out, "}]}");
        return;
    }
    type_of(key, out);
    jox_text_add(out, "}");
}

/* "anyOf": each of the alternatives' keys is required; prefixed by a comma. */
static void alternative(const JoxAlternative *a, JoxText *out) {
    char one[64], other[64];
    bool some = a->rule != JOX_AT_MOST_ONE;
    jox_text_add(out, some ? (a->rule == JOX_EXACTLY_ONE ? "{\"oneOf\": [" : "{\"anyOf\": [")
                           : "{\"not\": {\"anyOf\": [");
    int count = 0;
    for (int i = 0; jox_choice_name(a->keys, i, one, sizeof one); i++) {
        if (some)
            jox_text_printf(out, "%s{\"required\": [\"%s\"]}", count++ ? ", " : "", one);
        for (int k = 0; !some && k < i && jox_choice_name(a->keys, k, other, sizeof other); k++)
            jox_text_printf(out, "%s{\"required\": [\"%s\", \"%s\"]}", count++ ? ", " : "", other,
                            one);
    }
    jox_text_add(out, some ? "]}" : "]}}");
}

/* What must be there; a separate list for owners whose maps are joined from several files. */
static void demands(const char *owner, JoxText *out) {
    int count = 0;
    for (size_t i = 0; i < jox_scene_key_count; i++) {
        const JoxKey *key = &jox_scene_keys[i];
        if (!strcmp(key->owner, owner) && *key->standard == '!')
            jox_text_printf(out, "%s\"%s\"", count++ ? ", " : "\"required\": [", key->name);
    }
    if (count)
        jox_text_add(out, "]");
    bool first = true;
    for (size_t i = 0; i < jox_scene_alternative_count; i++) {
        const JoxAlternative *a = &jox_scene_alternatives[i];
        if (strcmp(a->owner, owner) != 0)
            continue;
        jox_text_add(out, first ? (count ? ", \"allOf\": [" : "\"allOf\": [") : ", ");
        alternative(a, out);
        first = false;
    }
    if (!first)
        jox_text_add(out, "]");
}

/* Places and groups may come in part from another file: what they lack is looked at from the root.
 */
static bool joined(const char *owner) {
    return !strcmp(owner, "scene") || !strcmp(owner, "place") || !strcmp(owner, "group");
}

static void object(const char *owner, JoxText *out) {
    JoxText needed = {0};
    int count = 0;
    jox_text_add(out, "\"type\": \"object\", \"additionalProperties\": false, ");
    if (!joined(owner))
        demands(owner, &needed);
    if (needed.length)
        jox_text_printf(out, "%s, ", needed.data);
    jox_text_free(&needed);
    jox_text_add(out, "\"properties\": {");
    for (size_t i = 0; i < jox_scene_key_count; i++)
        if (!strcmp(jox_scene_keys[i].owner, owner)) {
            jox_text_add(out, count++ ? ",\n   " : "\n   ");
            property(&jox_scene_keys[i], out);
        }
    jox_text_add(out, "}");
}

static void shared_definitions(JoxText *out) {
    jox_text_add(out,
                 "  \"name\": {\"type\": [\"string\", \"number\"]},\n  \"quantity\": {\"anyOf\": "
                 "[{\"type\": \"number\"}, ");
    unit_pattern(NULL, out);
    jox_text_add(out, "]},\n  \"drawn\": {\"type\": \"string\", \"pattern\": ");
    jox_text_json(out, DRAWN);
    jox_text_add(out, "},\n  \"draw\": {\"anyOf\": [{\"type\": [\"number\", \"boolean\"]}, "
                      "{\"$ref\": \"#/definitions/drawn\"}]},\n"
                      "  \"value\": {\"anyOf\": [{\"$ref\": \"#/definitions/draw\"}, "
                      "{\"type\": \"string\", \"pattern\": \"^[^(]*$\"}]}");
    for (size_t u = 0; u < jox_scene_unit_count; u++) {
        const char *kind = jox_scene_units[u].kind;
        bool known = false;
        for (size_t k = 0; k < u; k++)
            known |= !strcmp(jox_scene_units[k].kind, kind);
        if (known)
            continue;
        jox_text_add(out, ",\n  \"");
        unit_reference(kind, out);
        jox_text_add(out, "\": ");
        unit_pattern(kind, out);
    }
}

/* Whether the owner is described in the schema of this root. */
static bool belongs(const char *owner, const char *root) {
    bool mod = !strcmp(owner, "mod") || !strcmp(owner, "setting");
    return strcmp(owner, root) != 0 && mod == !strcmp(root, "mod");
}

void jox_scene_json_schema(const char *root_owner, JoxText *out) {
    bool scene = !strcmp(root_owner, "scene");
    jox_text_printf(out,
                    "{\n\"$schema\": \"http://json-schema.org/draft-07/schema#\",\n"
                    "\"title\": \"%s\",\n",
                    scene ? "A scene of Jostle" : "The mod.yaml of a mod for Jostle");
    object(root_owner, out);
    if (scene) {
        jox_text_add(out, ",\n\"if\": {\"anyOf\": [{\"required\": [\"include\"]}, {\"required\": "
                          "[\"patch\"]}]},\n\"then\": {},\n\"else\": {");
        demands("scene", out);
        jox_text_add(out, ", \"properties\": {\n  \"places\": {\"additionalProperties\": {");
        demands("place", out);
        jox_text_add(out, "}},\n  \"groups\": {\"additionalProperties\": {");
        demands("group", out);
        jox_text_add(out, "}}}}");
    }
    jox_text_add(out, ",\n\"definitions\": {\n");
    shared_definitions(out);
    for (size_t i = 0; i < jox_scene_owner_count; i++) {
        if (!belongs(jox_scene_owners[i].name, root_owner))
            continue;
        jox_text_printf(out, ",\n  \"%s\": {", jox_scene_owners[i].name);
        object(jox_scene_owners[i].name, out);
        jox_text_add(out, "}");
    }
    jox_text_add(out, "\n}\n}\n");
}
