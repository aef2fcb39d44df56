#include "scene/format/schema.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/noun.h"

enum { MOST_KEYS = 64 }; /* of an owner */

/* ---- the table ---- */

const JoxKey *jox_key_find(const JoxFormat *format, const char *owner, const char *name) {
    for (size_t i = 0; i < format->key_count; i++)
        if (!strcmp(format->keys[i].owner, owner) && !strcmp(format->keys[i].name, name))
            return &format->keys[i];
    return NULL;
}

const JoxOwner *jox_owner_find(const JoxFormat *format, const char *name, size_t length) {
    for (size_t i = 0; i < format->owner_count; i++)
        if (strlen(format->owners[i].name) == length &&
            !strncmp(format->owners[i].name, name, length))
            return &format->owners[i];
    return NULL;
}

bool jox_choice_name(const char *choices, int n, char *out, size_t size) {
    for (; n > 0 && choices; n--)
        choices = strchr(choices, '|') ? strchr(choices, '|') + 1 : NULL;
    if (choices)
        snprintf(out, size, "%.*s", (int)strcspn(choices, "|"), choices);
    return choices != NULL;
}

int jox_choice_find(const char *choices, const char *word) {
    char name[64];
    for (int i = 0; jox_choice_name(choices, i, name, sizeof name); i++)
        if (!strcmp(name, word))
            return i;
    return -1;
}

void jox_choices_text(const char *choices, JoxText *out) {
    char name[64], next[64];
    for (int i = 0; jox_choice_name(choices, i, name, sizeof name); i++) {
        bool last = !jox_choice_name(choices, i + 1, next, sizeof next);
        jox_text_printf(out, "%s%s", i == 0 ? "" : last ? " or " : ", ", name);
    }
}

void jox_owner_kinds(const JoxFormat *format, const char *owner, JoxText *out) {
    for (size_t i = 0; i < format->key_count; i++)
        if (format->keys[i].kind && !strcmp(format->keys[i].owner, owner))
            jox_text_printf(out, "%s%s", out->length ? "|" : "", format->keys[i].name);
}

static const char *article(const char *noun) {
    return strchr("aeiou", *noun) ? "an" : "a";
}

/* ---- which keys there are ---- */

bool jox_keys_check(const JoxReader *reader, const JoxYaml *map, const char *owner) {
    if (!map || map->kind != JOX_YAML_MAP) {
        if (map)
            jox_scene_error(reader, map, "bad-type", NULL, "%s %s is a map of keys", article(owner),
                            owner);
        return false;
    }
    const char *names[MOST_KEYS];
    size_t count = 0;
    for (size_t i = 0; i < reader->format->key_count; i++) {
        const JoxKey *key = &reader->format->keys[i];
        if (strcmp(key->owner, owner) != 0)
            continue;
        JOX_ASSERT(count < MOST_KEYS);
        names[count++] = key->name;
        if (key->standard[0] == '!' && !jox_yaml_get(map, key->name))
            jox_scene_error(reader, map, "missing-key", key->meaning, "this %s lacks '%s'", owner,
                            key->name);
    }
    JOX_ASSERT(count > 0);
    for (uint32_t k = 0; k < map->count; k++)
        if (!jox_key_find(reader->format, owner, map->keys[k])) {
            const char *hint = jox_scene_suggest(reader, map->keys[k], names, count);
            jox_diag_error(reader->diagnostics, map->key_positions[k], "unknown-key", hint,
                           "unknown key '%s' of %s %s", map->keys[k], article(owner), owner);
        }
    return true;
}

/* The one key of a map that says of what kind it is; NULL with an error. */
static const JoxKey *kind_key(const JoxReader *reader, const JoxYaml *map, const JoxOwner *owner) {
    const JoxKey *found = NULL;
    int count = 0;
    for (uint32_t k = 0; k < map->count; k++) {
        const JoxKey *key = jox_key_find(reader->format, owner->name, map->keys[k]);
        if (key && key->kind) {
            found = key;
            count++;
        }
    }
    if (count == 1)
        return found;
    JOX_ASSERT(owner->wrong_kind);
    JoxText kinds = {0}, list = {0};
    jox_owner_kinds(reader->format, owner->name, &kinds);
    jox_choices_text(kinds.data, &list);
    jox_scene_error(reader, map, owner->wrong_kind, owner->hint, "%s %s has one of %s, not %s",
                    article(owner->name), owner->name, list.data, count ? "several" : "none");
    jox_text_free(&kinds);
    jox_text_free(&list);
    return NULL;
}

/* ---- single values ---- */

static bool check_range(const JoxReader *reader, const JoxYaml *node, const JoxKey *key,
                        double value) {
    if (value >= key->least && value <= key->greatest)
        return true;
    jox_scene_error(reader, node, "out-of-range", NULL, "%s must be from %g to %g%s%s, not %g",
                    key->name, key->least, key->greatest, *key->unit ? " " : "", key->unit, value);
    return false;
}

static bool has_standard(const JoxKey *key) {
    return *key->standard && *key->standard != '!';
}

double jox_key_number(const JoxReader *reader, const JoxKey *key, const JoxYaml *node) {
    double standard = has_standard(key) ? strtod(key->standard, NULL) : NAN;
    double value;
    if (!node || !jox_read_number(reader, node, key->unit, &value) ||
        !check_range(reader, node, key, value))
        return standard;
    if (key->type == JOX_TYPE_WHOLE && value != floor(value)) {
        jox_scene_error(reader, node, "bad-type", NULL, "%s must be a whole number", key->name);
        return standard;
    }
    return value;
}

static bool read_bool(const JoxReader *reader, const JoxKey *key, const JoxYaml *node) {
    const char *text = node && node->kind == JOX_YAML_SCALAR ? node->text : NULL;
    if (node && (!text || (strcmp(text, "true") && strcmp(text, "false"))))
        jox_scene_error(reader, node, "bad-type", NULL, "%s must be true or false", key->name);
    return !strcmp(text ? text : key->standard, "true");
}

static const char *read_text(const JoxReader *reader, const JoxKey *key, const JoxYaml *node) {
    if (node && node->kind != JOX_YAML_SCALAR) {
        jox_scene_error(reader, node, "bad-type", NULL, "%s must be a text", key->name);
        node = NULL;
    }
    return node ? node->text : has_standard(key) ? key->standard : NULL;
}

/* What a text is, in place of one of the key's choices. */
static void refuse_choice(const JoxReader *reader, const JoxKey *key, const JoxYaml *node) {
    char names[16][64];
    const char *list[16];
    size_t count = 0;
    JoxText known = {0};
    for (; count < 16 && jox_choice_name(key->choices, (int)count, names[count], 64); count++)
        list[count] = names[count];
    jox_choices_text(key->choices, &known);
    jox_scene_error(reader, node, "bad-value", jox_scene_suggest(reader, node->text, list, count),
                    key->type == JOX_TYPE_NAMES ? "each of %s is %s" : "%s is %s", key->name,
                    known.data);
    jox_text_free(&known);
}

/* Which of the choices the text is; the default, or the first, where it is missing or wrong. */
static uint32_t read_choice(const JoxReader *reader, const JoxKey *key, const JoxYaml *node) {
    const char *text = read_text(reader, key, node);
    int choice = text ? jox_choice_find(key->choices, text) : 0;
    if (choice < 0) {
        refuse_choice(reader, key, node);
        choice = has_standard(key) ? jox_choice_find(key->choices, key->standard) : 0;
    }
    JOX_ASSERT(choice >= 0); /* the default is one of the choices */
    return (uint32_t)choice;
}

/* A bit for each of the choices that a list names. The default is written like the choices. */
static uint32_t read_bits(const JoxReader *reader, const JoxKey *key, const JoxYaml *node) {
    const JoxYaml *const *names;
    const uint32_t count = jox_read_names(reader, node, &names);
    uint32_t bits = 0;
    char name[64];
    for (int i = 0; !node && jox_choice_name(key->standard, i, name, sizeof name); i++)
        if (*name)
            bits |= 1u << jox_choice_find(key->choices, name);
    for (uint32_t n = 0; n < count; n++) {
        int choice = jox_choice_find(key->choices, names[n]->text);
        if (choice >= 0)
            bits |= 1u << choice;
        else
            refuse_choice(reader, key, names[n]);
    }
    return bits;
}

bool jox_key_vector(const JoxReader *reader, const JoxKey *key, const JoxYaml *node, double *out,
                    int count) {
    if (!node)
        return false;
    if (node->kind != JOX_YAML_LIST || node->count != (uint32_t)count) {
        jox_scene_error(reader, node, "bad-type", count == 2 ? "[x, y]" : "[x, y, z]",
                        "%s must be a list of %d numbers", key->name, count);
        return false;
    }
    for (int i = 0; i < count; i++)
        if (!jox_read_number(reader, node->items[i], key->unit, &out[i]) ||
            !check_range(reader, node->items[i], key, out[i]))
            return false;
    return true;
}

/* ---- from the map into the struct ---- */

static void fill_uint32(const JoxReader *reader, const JoxKey *key, const JoxYaml *node,
                        uint32_t *out) {
    if (key->type == JOX_TYPE_NAMES) {
        *out = read_bits(reader, key, node);
    } else if (key->choices) {
        *out = read_choice(reader, key, node);
    } else {
        double value = jox_key_number(reader, key, node);
        *out = isfinite(value) ? (uint32_t)value : 0;
    }
}

static void fill_key(const JoxReader *reader, const JoxKey *key, const JoxYaml *node, void *item) {
    double value;
    item = key->aside ? (void *)reader->load : item;
    switch (key->store) {
    case JOX_STORE_READ:
        key->read(reader, key, node, item);
        return;
    case JOX_STORE_ITEMS:
        jox_items_fill(reader, key, node, item);
        return;
    case JOX_STORE_STRUCT:
        jox_keys_fill(reader, node, key->of, JOX_MEMBER(char, item, key->offset));
        return;
    case JOX_STORE_CHECKED:
        jox_key_number(reader, key, node);
        return;
    case JOX_STORE_EARLIER:
        return;
    case JOX_STORE_BOOL:
        *JOX_MEMBER(bool, item, key->offset) =
            key->choices ? read_choice(reader, key, node) == 1 : read_bool(reader, key, node);
        return;
    case JOX_STORE_FLOAT:
        *JOX_MEMBER(float, item, key->offset) = (float)jox_key_number(reader, key, node);
        return;
    case JOX_STORE_DOUBLE:
        *JOX_MEMBER(double, item, key->offset) = jox_key_number(reader, key, node);
        return;
    case JOX_STORE_UINT32:
        fill_uint32(reader, key, node, JOX_MEMBER(uint32_t, item, key->offset));
        return;
    case JOX_STORE_UINT64:
        value = jox_key_number(reader, key, node);
        *JOX_MEMBER(uint64_t, item, key->offset) = isfinite(value) ? (uint64_t)value : 0;
        return;
    case JOX_STORE_TEXT:
        *JOX_MEMBER(char *, item, key->offset) =
            jox_arena_text(reader->arena, read_text(reader, key, node));
        return;
    case JOX_STORE_DOUBLES2:
    case JOX_STORE_DOUBLES3:
        jox_key_vector(reader, key, node, JOX_MEMBER(double, item, key->offset),
                       key->store == JOX_STORE_DOUBLES2 ? 2 : 3);
        return;
    case JOX_STORE_UNSET:
        break;
    }
    JOX_ASSERT(false); /* a row without a destination */
}

bool jox_keys_fill(const JoxReader *reader, const JoxYaml *map, const char *name, void *item) {
    const size_t errors = reader->diagnostics->errors;
    const JoxOwner *owner = jox_owner_find(reader->format, name, strlen(name));
    const JoxKey *kind = NULL;
    JOX_ASSERT(owner && item);
    bool good = !map || jox_keys_check(reader, map, name);
    map = good ? map : NULL;
    if (map && owner->kind && !(kind = kind_key(reader, map, owner)))
        good = false;
    for (size_t i = 0; i < reader->format->key_count; i++) {
        const JoxKey *key = &reader->format->keys[i];
        if (!key->kind && !strcmp(key->owner, name))
            fill_key(reader, key, map ? jox_yaml_get(map, key->name) : NULL, item);
    }
    if (kind) { /* last: it may read what the others say */
        *JOX_MEMBER(int, item, owner->kind - 1) = kind->kind - 1;
        fill_key(reader, kind, jox_yaml_get(map, kind->name), item);
    }
    good = good && reader->diagnostics->errors == errors;
    return map && owner->finish ? owner->finish(reader, map, item, good) : good;
}

/* The least number of items of a list, from "wall[2]". */
static uint32_t least_items(const JoxKey *key) {
    const char *open = strchr(key->of, '[');
    return open ? (uint32_t)strtoul(open + 1, NULL, 10) : 0;
}

/* Whether a node is the map or list that the key holds; false with an error, or where it is NULL.
 */
static bool holds_items(const JoxReader *reader, const JoxKey *key, const JoxYaml *node,
                        const JoxOwner *owner, bool map) {
    char items[JOX_NOUN];
    if (!node)
        return false;
    if (node->kind != (map ? JOX_YAML_MAP : JOX_YAML_LIST)) {
        jox_scene_error(reader, node, "bad-type", key->example,
                        map ? "%s maps names to %s" : "%s is a list", key->name,
                        jox_noun_alone(items, 2, owner->name));
        return false;
    }
    if (node->count >= least_items(key))
        return true;
    jox_scene_error(reader, node, "bad-type", key->example, "%s is a list of at least %s",
                    key->name, jox_noun(items, least_items(key), owner->name));
    return false;
}

static void check_name(const JoxReader *reader, const JoxOwner *owner, JoxPosition at,
                       const char *name) {
    if (jox_scene_name(reader, at, owner->name, name) && owner->taken &&
        jox_choice_find(owner->taken, name) >= 0)
        jox_diag_error(reader->diagnostics, at, "bad-name", "Choose another",
                       "'%.60s' is the name of something else already", name);
}

void jox_items_fill(const JoxReader *reader, const JoxKey *key, const JoxYaml *node, void *item) {
    size_t length = strcspn(key->of, "*[");
    const JoxOwner *owner = jox_owner_find(reader->format, key->of, length);
    JOX_ASSERT(owner && owner->size);
    const bool map = key->of[length] == '*';
    uint32_t *count = JOX_MEMBER(uint32_t, item, key->counter);
    *count = 0;
    if (!holds_items(reader, key, node, owner, map))
        return;
    char *items = jox_arena_take(reader->arena, node->count, owner->size);
    const JoxYaml **from = jox_arena_take(reader->arena, node->count, sizeof *from);
    *JOX_MEMBER(void *, item, key->offset) = items;
    for (uint32_t i = 0; i < node->count; i++) {
        char *one = items + *count * owner->size;
        memset(one, 0, owner->size); /* one before it may not have been kept */
        if (map && owner->name_at) {
            *JOX_MEMBER(char *, one, owner->name_at - 1) =
                jox_arena_text(reader->arena, node->keys[i]);
            check_name(reader, owner, node->key_positions[i], node->keys[i]);
        }
        if (owner->place_at)
            *JOX_MEMBER(JoxPosition, one, owner->place_at - 1) =
                map ? node->key_positions[i] : node->items[i]->position;
        from[*count] = node->items[i];
        *count += jox_keys_fill(reader, node->items[i], owner->name, one);
    }
    JOX_ASSERT(*count <= node->count);
    for (uint32_t i = 0; owner->link && i < *count; i++)
        owner->link(reader, from[i], items + i * owner->size);
}
