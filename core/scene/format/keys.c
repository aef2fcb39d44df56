/* Looks up rows of a table of keys, and reads maps of YAML into structs by them. */
#include "scene/format/keys.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "agents/parameters.h"
#include "base/assert.h"
#include "base/format/plurals.h"

enum { MOST_KEYS = 64 }; /* keys of an owner */

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

void jox_choices_print(const char *choices, JoxText *out) {
    char name[64], next[64];
    for (int i = 0; jox_choice_name(choices, i, name, sizeof name); i++) {
        bool last = !jox_choice_name(choices, i + 1, next, sizeof next);
        jox_text_printf(out, "%s%s", i == 0 ? "" : last ? " or " : ", ", name);
    }
}

void jox_owner_list_kinds(const JoxFormat *format, const char *owner, JoxText *out) {
    for (size_t i = 0; i < format->key_count; i++)
        if (format->keys[i].selected_kind && !strcmp(format->keys[i].owner, owner))
            jox_text_printf(out, "%s%s", out->length ? "|" : "", format->keys[i].name);
}

/* ---- the keys of a map ---- */

bool jox_owner_check_keys(const JoxReader *reader, const JoxYaml *map, const char *owner) {
    if (!map || map->kind != JOX_YAML_MAP) {
        if (map)
            jox_scene_error(reader, map, "bad-type", NULL, "%s %s is a map of keys",
                            jox_article(owner), owner);
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
        if (key->default_text[0] == '!' && !jox_yaml_get(map, key->name))
            jox_scene_error(reader, map, "missing-key", key->meaning, "this %s lacks '%s'", owner,
                            key->name);
    }
    JOX_ASSERT(count > 0);
    for (uint32_t k = 0; k < map->count; k++)
        if (!jox_key_find(reader->format, owner, map->keys[k])) {
            const char *successor = jox_parameter_successor(map->keys[k]);
            const char *hint = jox_scene_suggest(reader, map->keys[k], names, count);
            jox_diag_error(reader->diagnostics, map->key_positions[k], "unknown-key",
                           successor ? successor : hint, "unknown key '%s' of %s %s", map->keys[k],
                           jox_article(owner), owner);
        }
    return true;
}

/* Returns the one key of a map that selects its kind; NULL with an error. */
static const JoxKey *find_selecting_key(const JoxReader *reader, const JoxYaml *map,
                                        const JoxOwner *owner) {
    const JoxKey *found = NULL;
    int count = 0;
    for (uint32_t k = 0; k < map->count; k++) {
        const JoxKey *key = jox_key_find(reader->format, owner->name, map->keys[k]);
        if (key && key->selected_kind) {
            found = key;
            count++;
        }
    }
    if (count == 1)
        return found;
    JOX_ASSERT(owner->kind_error);
    JoxText kinds = {0}, list = {0};
    jox_owner_list_kinds(reader->format, owner->name, &kinds);
    jox_choices_print(kinds.data, &list);
    jox_scene_error(reader, map, owner->kind_error, owner->hint, "%s %s has one of %s, not %s",
                    jox_article(owner->name), owner->name, list.data, count ? "several" : "none");
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

static bool has_default(const JoxKey *key) {
    return *key->default_text && *key->default_text != '!';
}

double jox_key_read_number(const JoxReader *reader, const JoxKey *key, const JoxYaml *node) {
    double standard = has_default(key) ? strtod(key->default_text, NULL) : NAN;
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
    return !strcmp(text ? text : key->default_text, "true");
}

const char *jox_key_read_scalar(const JoxReader *reader, const JoxKey *key, const JoxYaml *node,
                                const char *what) {
    const bool scalar = node && node->kind == JOX_YAML_SCALAR;
    if (node && !scalar)
        jox_scene_error(reader, node, "bad-type", NULL, "%s must be a %s", key->name, what);
    return scalar ? node->text : NULL;
}

static const char *read_text(const JoxReader *reader, const JoxKey *key, const JoxYaml *node) {
    const char *text = jox_key_read_scalar(reader, key, node, "text");
    return text ? text : has_default(key) ? key->default_text : NULL;
}

/* Reports a text that is none of the key's choices. */
static void report_unknown_choice(const JoxReader *reader, const JoxKey *key, const JoxYaml *node) {
    char names[16][64];
    const char *list[16];
    size_t count = 0;
    JoxText known = {0};
    for (; count < 16 && jox_choice_name(key->choices, (int)count, names[count], 64); count++)
        list[count] = names[count];
    jox_choices_print(key->choices, &known);
    jox_scene_error(reader, node, "bad-value", jox_scene_suggest(reader, node->text, list, count),
                    key->type == JOX_TYPE_NAMES ? "each of %s is %s" : "%s is %s", key->name,
                    known.data);
    jox_text_free(&known);
}

/* Returns the index of the choice; of the default, or 0, if the node is missing or wrong. */
static uint32_t read_choice(const JoxReader *reader, const JoxKey *key, const JoxYaml *node) {
    const char *text = read_text(reader, key, node);
    int choice = text ? jox_choice_find(key->choices, text) : 0;
    if (choice < 0) {
        report_unknown_choice(reader, key, node);
        choice = has_default(key) ? jox_choice_find(key->choices, key->default_text) : 0;
    }
    JOX_ASSERT(choice >= 0); /* the default is one of the choices */
    return (uint32_t)choice;
}

/* Returns the bit set of the choices that a list names. The default is written "this|that", too. */
static uint32_t read_bits(const JoxReader *reader, const JoxKey *key, const JoxYaml *node) {
    const JoxYaml *const *names;
    const uint32_t count = jox_read_names(reader, node, &names);
    uint32_t bits = 0;
    char name[64];
    for (int i = 0; !node && jox_choice_name(key->default_text, i, name, sizeof name); i++)
        if (*name)
            bits |= 1u << jox_choice_find(key->choices, name);
    for (uint32_t n = 0; n < count; n++) {
        int choice = jox_choice_find(key->choices, names[n]->text);
        if (choice >= 0)
            bits |= 1u << choice;
        else
            report_unknown_choice(reader, key, names[n]);
    }
    return bits;
}

bool jox_key_read_vector(const JoxReader *reader, const JoxKey *key, const JoxYaml *node,
                         double *out, int count) {
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
    if (key->placed && reader->placing) {
        jox_scene_position(reader, jox_v2((float)out[0], (float)out[1]));
        out[1] += (double)reader->placing->shift;
    }
    return true;
}

/* ---- storing values ---- */

static void store_uint32(const JoxReader *reader, const JoxKey *key, const JoxYaml *node,
                         uint32_t *out) {
    if (key->type == JOX_TYPE_NAMES) {
        *out = read_bits(reader, key, node);
    } else if (key->choices) {
        *out = read_choice(reader, key, node);
    } else {
        double value = jox_key_read_number(reader, key, node);
        *out = isfinite(value) ? (uint32_t)value : 0;
    }
}

static void store_value(const JoxReader *reader, const JoxKey *key, const JoxYaml *node,
                        void *item) {
    double value;
    item = key->in_draft ? (void *)reader->draft : item;
    switch (key->store) {
    case JOX_STORE_READ:
        key->read(reader, key, node, item);
        return;
    case JOX_STORE_ITEMS:
        jox_key_read_items(reader, key, node, item);
        return;
    case JOX_STORE_STRUCT:
        jox_owner_read(reader, node, key->content, JOX_MEMBER(char, item, key->offset));
        return;
    case JOX_STORE_CHECKED:
        jox_key_read_number(reader, key, node);
        return;
    case JOX_STORE_EARLIER:
        return;
    case JOX_STORE_BOOL:
        *JOX_MEMBER(bool, item, key->offset) =
            key->choices ? read_choice(reader, key, node) == 1 : read_bool(reader, key, node);
        return;
    case JOX_STORE_FLOAT:
        *JOX_MEMBER(float, item, key->offset) = (float)jox_key_read_number(reader, key, node);
        return;
    case JOX_STORE_DOUBLE:
        *JOX_MEMBER(double, item, key->offset) = jox_key_read_number(reader, key, node);
        return;
    case JOX_STORE_UINT32:
        store_uint32(reader, key, node, JOX_MEMBER(uint32_t, item, key->offset));
        return;
    case JOX_STORE_UINT64:
        value = jox_key_read_number(reader, key, node);
        *JOX_MEMBER(uint64_t, item, key->offset) = isfinite(value) ? (uint64_t)value : 0;
        return;
    case JOX_STORE_TEXT:
        *JOX_MEMBER(char *, item, key->offset) =
            jox_arena_text(reader->arena, read_text(reader, key, node));
        return;
    case JOX_STORE_DOUBLES2:
    case JOX_STORE_DOUBLES3:
        jox_key_read_vector(reader, key, node, JOX_MEMBER(double, item, key->offset),
                            key->store == JOX_STORE_DOUBLES2 ? 2 : 3);
        return;
    case JOX_STORE_UNSET:
        break;
    }
    JOX_ASSERT(false); /* the row does not say how to store the value */
}

/* Reads the keys of a map that select no kind: those that others depend on, or all others. */
static void read_keys(const JoxReader *reader, const JoxYaml *map, const char *owner, bool first,
                      void *item) {
    for (size_t i = 0; i < reader->format->key_count; i++) {
        const JoxKey *key = &reader->format->keys[i];
        if (key->first == first && !key->selected_kind && !strcmp(key->owner, owner))
            store_value(reader, key, map ? jox_yaml_get(map, key->name) : NULL, item);
    }
}

bool jox_owner_read(const JoxReader *reader, const JoxYaml *map, const char *name, void *item) {
    const size_t errors = reader->diagnostics->errors;
    const JoxOwner *owner = jox_owner_find(reader->format, name, strlen(name));
    const JoxKey *selecting = NULL;
    const float shift =
        reader->placing ? reader->placing->shift : 0.0f; /* a key `storey` changes it */
    JOX_ASSERT(owner && item);
    bool good = !map || jox_owner_check_keys(reader, map, name);
    map = good ? map : NULL;
    if (map && owner->kind_offset && !(selecting = find_selecting_key(reader, map, owner)))
        good = false;
    read_keys(reader, map, name, true, item);
    read_keys(reader, map, name, false, item);
    if (selecting) { /* last: its reader may use the values of the others */
        *JOX_MEMBER(int, item, owner->kind_offset - 1) = selecting->selected_kind - 1;
        store_value(reader, selecting, jox_yaml_get(map, selecting->name), item);
    }
    good = good && reader->diagnostics->errors == errors;
    good = map && owner->finish ? owner->finish(reader, map, item, good) : good;
    if (reader->placing)
        reader->placing->shift = shift;
    return good;
}

/* Returns the least number of items of a list: 2 for "wall[2]". */
static uint32_t get_least_count(const JoxKey *key) {
    const char *open = strchr(key->content, '[');
    return open ? (uint32_t)strtoul(open + 1, NULL, 10) : 0;
}

/* Whether a node is the map or list of items that the key needs; reports an error if it is not. */
static bool check_items_node(const JoxReader *reader, const JoxKey *key, const JoxYaml *node,
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
    if (node->count >= get_least_count(key))
        return true;
    jox_scene_error(reader, node, "bad-type", key->example, "%s is a list of at least %s",
                    key->name, jox_noun(items, get_least_count(key), owner->name));
    return false;
}

static void check_item_name(const JoxReader *reader, const JoxOwner *owner, JoxPosition at,
                            const char *name) {
    if (jox_scene_check_name(reader, at, owner->name, name) && owner->reserved_names &&
        jox_choice_find(owner->reserved_names, name) >= 0)
        jox_diag_error(reader->diagnostics, at, "bad-name", "Choose another",
                       "'%.60s' is the name of something else already", name);
}

uint32_t jox_owner_count_copies(const JoxFormat *format, const char *owner, const JoxYaml *map) {
    const JoxYaml *storey = map->kind == JOX_YAML_MAP ? jox_yaml_get(map, "storey") : NULL;
    const JoxKey *key = storey ? jox_key_find(format, owner, "storey") : NULL;
    const bool several = key && key->type == JOX_TYPE_NAMES && storey->kind == JOX_YAML_LIST;
    return several && storey->count ? storey->count : 1;
}

/* Stores name and position of an item, which are those of the parent's map or list. */
static void name_item(const JoxReader *reader, const JoxOwner *owner, bool map, const JoxYaml *node,
                      uint32_t index, char *item) {
    if (map && owner->name_offset) {
        *JOX_MEMBER(char *, item, owner->name_offset - 1) =
            jox_arena_text(reader->arena, node->keys[index]);
        check_item_name(reader, owner, node->key_positions[index], node->keys[index]);
    }
    if (owner->position_offset)
        *JOX_MEMBER(JoxPosition, item, owner->position_offset - 1) =
            map ? node->key_positions[index] : node->items[index]->position;
}

void jox_key_read_items(const JoxReader *reader, const JoxKey *key, const JoxYaml *node,
                        void *item) {
    size_t length = strcspn(key->content, "*[");
    const JoxOwner *owner = jox_owner_find(reader->format, key->content, length);
    JOX_ASSERT(owner && owner->struct_size);
    const bool map = key->content[length] == '*';
    uint32_t *count = JOX_MEMBER(uint32_t, item, key->count_offset);
    const uint32_t before = *count; /* made by keys that were read before */
    if (!check_items_node(reader, key, node, owner, map))
        return;
    uint32_t most = before;
    for (uint32_t i = 0; i < node->count; i++)
        most += jox_owner_count_copies(reader->format, owner->name, node->items[i]);
    char *items = jox_arena_take(reader->arena, most, owner->struct_size);
    if (before)
        memcpy(items, *JOX_MEMBER(void *, item, key->offset), before * owner->struct_size);
    const JoxYaml **from = jox_arena_take(reader->arena, most, sizeof *from);
    *JOX_MEMBER(void *, item, key->offset) = items;
    for (uint32_t i = 0; i < node->count; i++) {
        const size_t errors = reader->diagnostics->errors;
        const uint32_t copies = jox_owner_count_copies(reader->format, owner->name, node->items[i]);
        for (uint32_t copy = 0; copy < copies && reader->diagnostics->errors == errors; copy++) {
            char *one = items + *count * owner->struct_size;
            memset(one, 0, owner->struct_size); /* the last one may not have been kept */
            name_item(reader, owner, map, node, i, one);
            if (reader->placing)
                reader->placing->copy = copy;
            from[*count] = node->items[i];
            *count += jox_owner_read(reader, node->items[i], owner->name, one);
        }
    }
    JOX_ASSERT(*count <= most);
    for (uint32_t i = before; owner->resolve && i < *count; i++)
        owner->resolve(reader, from[i], items + i * owner->struct_size);
}
