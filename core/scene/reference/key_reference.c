/* Prints the table of keys as a reference: as plain text for a terminal, and as a page of
   Markdown. */
#include <string.h>

#include "scene/format/keys.h"
#include "scene/scene.h"

static bool has_range(const JoxKey *key) {
    return key->least != key->greatest || key->least != 0;
}

/* Prints "this|that" as "this, that", between two texts. */
static void print_texts(JoxText *out, const char *before, const char *texts, const char *after) {
    jox_text_add(out, before);
    for (; *texts; texts++)
        jox_text_append(out, *texts == '|' ? ", " : texts, *texts == '|' ? 2 : 1);
    jox_text_add(out, after);
}

void jox_scene_print_reference(JoxText *out) {
    static const char *const TYPES[] = {"number", "whole number", "true/false",    "text",
                                        "[x, y]", "[x, y, z]",    "[[x, y], ...]", "name or names",
                                        "map",    "list",         "map of values"};
    const char *owner = "";
    for (size_t i = 0; i < jox_scene_format.key_count; i++) {
        const JoxKey *k = &jox_scene_format.keys[i];
        if (strcmp(owner, k->owner) != 0)
            jox_text_printf(out, "%s%s\n", i ? "\n" : "", k->owner);
        owner = k->owner;
        jox_text_printf(out, "  %-12s %-14s %-6s ", k->name, TYPES[k->type], k->unit);
        if (has_range(k) && k->type <= JOX_TYPE_WHOLE)
            jox_text_printf(out, "%.9g to %.9g; ", k->least, k->greatest);
        if (*k->default_text == '!')
            jox_text_add(out, "required; ");
        else if (*k->default_text)
            print_texts(out, "default ", k->default_text, "; ");
        if (k->choices) {
            jox_choices_print(k->choices, out);
            jox_text_add(out, "; ");
        }
        jox_text_printf(out, "%s\n", k->meaning);
    }
}

/* ---- Markdown ---- */

static void print_type(const JoxKey *key, JoxText *out) {
    static const char *const TYPES[] = {"number", "whole number", "true or false",  "text",
                                        "[x, y]", "[x, y, z]",    "list of [x, y]", "name or names",
                                        "map",    "list",         "map of values"};
    static const char *const CONTENTS[][2] = {
        {"value*", "map: name to number, distribution or place"},
        {"draw*", "map: name to number or distribution"},
        {"weight*", "map: Lua file to weight"},
        {"xy[3]*", "map: name to list of [x, y]"},
        {"xyz[4]", "list of [x, y, z]"},
        {"draw", "number or distribution"},
        {"plain", "number, true or false, or text"},
        {"quantity[1]", "list of numbers"},
        {"quantity[2][2]", "list of [s, 1/s]"},
        {"spots", "[x, y], or list of these"},
        {"start[1]", "list of [s, x, y] or [s, x, y, vx, vy]"},
        {"xy[2][2]", "two lists of [x, y]"},
        {"quantity**", "map: mod to map of values"}};
    const char *content = key->content ? key->content : "";
    char name[32];
    for (size_t i = 0; i < sizeof CONTENTS / sizeof *CONTENTS; i++)
        if (!strcmp(CONTENTS[i][0], content)) {
            jox_text_add(out, CONTENTS[i][1]);
            return;
        }
    if (key->choices) {
        for (int i = 0; jox_choice_name(key->choices, i, name, sizeof name); i++)
            jox_text_printf(out, "%s`%s`", i ? ", " : "", name);
        return;
    }
    size_t base = strcspn(content, "*[");
    for (size_t i = 0; i < jox_scene_format.owner_count; i++) {
        const JoxOwner *owner = &jox_scene_format.owners[i];
        if (strlen(owner->name) != base || strncmp(content, owner->name, base) != 0)
            continue;
        jox_text_add(out, content[base] == '*' ? "map: name to ["
                          : content[base]      ? "list of ["
                                               : "[");
        jox_text_printf(out, "%s](#", owner->name);
        for (const char *c = owner->heading; *c;
             c++) /* the anchor that Markdown makes of a heading */
            jox_text_printf(out, "%c", *c == ' ' ? '-' : *c >= 'A' && *c <= 'Z' ? *c + 32 : *c);
        jox_text_add(out, ")");
        return;
    }
    jox_text_add(out, TYPES[key->type]);
}

static void print_key_table(const char *owner, JoxText *out) {
    jox_text_add(out, "| key | type | unit | range | default | meaning |\n"
                      "|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < jox_scene_format.key_count; i++) {
        const JoxKey *key = &jox_scene_format.keys[i];
        if (strcmp(key->owner, owner) != 0)
            continue;
        jox_text_printf(out, "| `%s` | ", key->name);
        print_type(key, out);
        jox_text_printf(out, " | %s | ", key->unit);
        if (has_range(key))
            jox_text_printf(out, "%.9g to %.9g", key->least, key->greatest);
        if (*key->default_text == '!')
            jox_text_add(out, " | required");
        else if (*key->default_text)
            print_texts(out, " | `", key->default_text, "`");
        else
            jox_text_add(out, " | ");
        jox_text_printf(out, " | %s", key->meaning);
        if (key->restart_reason)
            jox_text_printf(out, "; an edit during a run takes effect at the next start (%s)",
                            key->restart_reason);
        jox_text_add(out, " |\n");
    }
}

/* Prints "this|that|those" as "`this`, `that` and `those`". */
static void print_quoted(const char *keys, JoxText *out) {
    char name[64], next[64];
    for (int i = 0; jox_choice_name(keys, i, name, sizeof name); i++) {
        bool last = !jox_choice_name(keys, i + 1, next, sizeof next);
        jox_text_printf(out, "%s`%s`", i == 0 ? "" : last ? " and " : ", ", name);
    }
}

static void print_alternatives(const char *owner, JoxText *out) {
    static const char *const RULES[] = {"Exactly one of ", "At most one of ", "At least one of "};
    JoxText kinds = {0};
    bool any = false;
    jox_owner_list_kinds(&jox_scene_format, owner, &kinds);
    if (kinds.length) {
        jox_text_printf(out, "\n%s", RULES[JOX_EXACTLY_ONE]);
        print_quoted(kinds.data, out);
        jox_text_add(out, " is given.");
        any = true;
    }
    for (size_t a = 0; a < jox_scene_alternative_count; a++) {
        const JoxAlternative *rule = &jox_scene_alternatives[a];
        if (strcmp(rule->owner, owner) != 0)
            continue;
        jox_text_printf(out, "%s%s", any ? " " : "\n", RULES[rule->rule]);
        print_quoted(rule->keys, out);
        jox_text_add(out, " is given.");
        any = true;
    }
    if (any)
        jox_text_add(out, "\n");
    jox_text_free(&kinds);
}

static void print_units(JoxText *out) {
    const char *kind = NULL;
    jox_text_add(out,
                 "Numbers are in SI units, angles in degrees; a number may also carry its unit "
                 "(`11 cm`, `5 min`):");
    for (size_t u = 0; u < jox_scene_unit_count; u++) {
        bool first = !kind || strcmp(kind, jox_scene_units[u].kind) != 0;
        kind = jox_scene_units[u].kind;
        jox_text_printf(out, "%s `%s`", u == 0 ? "" : first ? ";" : ",", jox_scene_units[u].name);
    }
    jox_text_add(
        out, ".\n\nWhere a distribution is possible, a number is drawn anew for each agent by\n");
#define X(kind, name, arguments, meaning, example)                                                 \
    jox_text_add(out, "- `" #name "(" arguments ")`: " meaning "\n");
    JOX_DISTS(X)
#undef X
}

void jox_scene_print_markdown(JoxText *out) {
    for (size_t i = 0; i < jox_scene_format.owner_count; i++) {
        const JoxOwner *owner = &jox_scene_format.owners[i];
        bool inner = owner->heading[0] >= 'a' && owner->heading[0] <= 'z';
        jox_text_printf(out, "%s %s\n\n", inner ? "###" : "##", owner->heading);
        if (*owner->description)
            jox_text_printf(out, "%s\n\n", owner->description);
        if (!strcmp(owner->name, "scene")) {
            print_units(out);
            jox_text_add(out, "\n");
        }
        for (int p = 0; !strcmp(owner->name, "place") && p < (int)jox_place_kind_count; p++)
            jox_text_printf(out, "- `%s`: %s%s", jox_place_kinds[p].name,
                            jox_place_kinds[p].meaning,
                            p + 1 < (int)jox_place_kind_count ? "\n" : "\n\n");
        print_key_table(owner->name, out);
        print_alternatives(owner->name, out);
        for (size_t e = 0; e < jox_scene_example_count; e++)
            if (!strcmp(jox_scene_examples[e].owner, owner->name))
                jox_text_printf(out, "\n```yaml\n%s```\n", jox_scene_examples[e].yaml);
        if (i + 1 < jox_scene_format.owner_count)
            jox_text_add(out, "\n");
    }
}
