/* Values set from the command line, in the tree before it is read. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/internal.h"

static bool is_called(const JoxYaml *item, const char *name) {
    const JoxYaml *own = item->kind == JOX_YAML_MAP ? jox_yaml_get(item, "name") : NULL;
    return own && own->kind == JOX_YAML_SCALAR && strcmp(own->text, name) == 0;
}

JoxYaml **jox_load_slot(const JoxYaml *node, const char *key) {
    if (node->kind == JOX_YAML_LIST) {
        bool digits = *key && strlen(key) < 9 && key[strspn(key, "0123456789")] == 0;
        unsigned long i = digits ? strtoul(key, NULL, 10) : node->count;
        for (uint32_t n = 0; !digits && n < node->count && i == node->count; n++)
            i = is_called(node->items[n], key) ? n : i;
        return i < node->count ? &node->items[i] : NULL;
    }
    for (uint32_t i = 0; i < node->count; i++)
        if (!strcmp(node->keys[i], key))
            return &node->items[i];
    return NULL;
}

/* Where a path stands in the table of keys: whose keys come next, or, of "group*", names. */
typedef struct Owner {
    char name[32];
    bool items; /* the next part is the name or number of an item */
} Owner;

/* Goes on by one part; whether that is a table that may be left out, and so be made. */
static bool follow(const JoxFormat *format, Owner *owner, const char *part) {
    const JoxKey *key = owner->items ? NULL : jox_key_find(format, owner->name, part);
    const bool was_item = owner->items;
    owner->items = false;
    if (was_item)
        return false;
    const char *of = key && key->of ? key->of : "";
    const size_t plain = strcspn(of, "*[");
    snprintf(owner->name, sizeof owner->name, "%.*s", (int)plain, of);
    owner->items = of[plain] != 0;
    return key && (key->type == JOX_TYPE_TABLE || of[plain] == '*');
}

/* Sets PATH=VALUE in the tree; the path must exist or be a key of the format. */
void jox_load_override(const JoxLoad *l, JoxYaml *root, const char *set) {
    JoxPosition at = {JOX_LOAD_OVERRIDE, 1, 1, (int)strlen(set) + 1};
    const char *equals = strchr(set, '=');
    JoxYaml *map = root;
    if (!equals || equals == set) {
        jox_diag_error(l->reader.diagnostics, at, "bad-override",
                       "Example: groups.pilgrims.count=500", "'%.100s' is not PATH=VALUE", set);
        return;
    }
    const char *part = set;
    Owner owner = {"scene", false};
    for (JoxYaml **slot;;) {
        size_t n = strcspn(part, ".=");
        char *key = jox_arena_take(l->reader.arena, n + 1, 1);
        memcpy(key, part, n);
        part += n;
        if (*part == '=') {
            JoxYaml *value = jox_arena_take(l->reader.arena, 1, sizeof *value);
            *value = (JoxYaml){.kind = JOX_YAML_SCALAR,
                               .text = jox_arena_text(l->reader.arena, equals + 1),
                               .position = at};
            if (map->kind == JOX_YAML_MAP)
                jox_yaml_set(l->reader.arena, map, key, value);
            else if ((slot = jox_load_slot(map, key)))
                *slot = value;
            else
                jox_diag_error(l->reader.diagnostics, at, "bad-override", NULL,
                               "the scene has no '%.*s'", (int)(part - set), set);
            return;
        }
        slot = jox_load_slot(map, key);
        JoxYaml *next = slot ? *slot : NULL;
        if (follow(l->reader.format, &owner, key) && !next && map->kind == JOX_YAML_MAP) {
            /* A table left at its defaults. */
            next = jox_arena_take(l->reader.arena, 1, sizeof *next);
            *next = (JoxYaml){.kind = JOX_YAML_MAP, .position = at};
            jox_yaml_set(l->reader.arena, map, key, next);
            slot = jox_load_slot(map, key);
        }
        if (!next || next->kind == JOX_YAML_SCALAR) {
            jox_diag_error(l->reader.diagnostics, at, "bad-override",
                           map->kind == JOX_YAML_MAP
                               ? jox_scene_suggest(&l->reader, key, map->keys, map->count)
                               : NULL,
                           "the scene has no '%.*s'", (int)(part - set), set);
            return;
        }
        map = *slot = jox_yaml_copy(l->reader.arena, next); /* aliases of it stay as they are */
        part++;
    }
}
