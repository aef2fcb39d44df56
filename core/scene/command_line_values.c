/* Sets values of the command line (--set PATH=VALUE) in a scene's tree, before it is read. Called
   by read_specification.c. */
#include <stdio.h>
#include <string.h>

#include "scene/scene_draft.h"

/* The owner in the table that the next part of a path is a key of. */
typedef struct PathOwner {
    char name[32];
    bool items; /* the next part is the name or number of one of several such owners */
} PathOwner;

/* Follows the path by one part. Whether the part is a table that may be missing, and so be made. */
static bool follow_path(const JoxFormat *format, PathOwner *owner, const char *part) {
    const JoxKey *key = owner->items ? NULL : jox_key_find(format, owner->name, part);
    const bool was_item = owner->items;
    owner->items = false;
    if (was_item)
        return false;
    const char *content = key && key->content ? key->content : "";
    const size_t length = strcspn(content, "*[");
    snprintf(owner->name, sizeof owner->name, "%.*s", (int)length, content);
    owner->items = content[length] != 0;
    return key && (key->type == JOX_TYPE_TABLE || content[length] == '*');
}

void jox_scene_set_value(const JoxSceneDraft *draft, JoxYaml *root, const char *set) {
    JoxPosition at = {JOX_SET_OPTION, 1, 1, (int)strlen(set) + 1};
    const char *equals = strchr(set, '=');
    JoxYaml *map = root;
    if (!equals || equals == set) {
        jox_diag_error(draft->reader.diagnostics, at, "bad-override",
                       "Example: groups.pilgrims.count=500", "'%.100s' is not PATH=VALUE", set);
        return;
    }
    const char *part = set;
    PathOwner owner = {"scene", false};
    for (JoxYaml **slot;;) {
        size_t n = strcspn(part, ".=");
        char *key = jox_arena_take(draft->reader.arena, n + 1, 1);
        memcpy(key, part, n);
        part += n;
        if (*part == '=') {
            JoxYaml *value = jox_arena_take(draft->reader.arena, 1, sizeof *value);
            *value = (JoxYaml){.kind = JOX_YAML_SCALAR,
                               .text = jox_arena_text(draft->reader.arena, equals + 1),
                               .position = at};
            if (map->kind == JOX_YAML_MAP)
                jox_yaml_set(draft->reader.arena, map, key, value);
            else if ((slot = jox_yaml_slot(map, key)))
                *slot = value;
            else
                jox_diag_error(draft->reader.diagnostics, at, "bad-override", NULL,
                               "the scene has no '%.*s'", (int)(part - set), set);
            return;
        }
        slot = jox_yaml_slot(map, key);
        JoxYaml *next = slot ? *slot : NULL;
        if (follow_path(draft->reader.format, &owner, key) && !next && map->kind == JOX_YAML_MAP) {
            /* Make the table that the file leaves at its defaults. */
            next = jox_arena_take(draft->reader.arena, 1, sizeof *next);
            *next = (JoxYaml){.kind = JOX_YAML_MAP, .position = at};
            jox_yaml_set(draft->reader.arena, map, key, next);
            slot = jox_yaml_slot(map, key);
        }
        if (!next || next->kind == JOX_YAML_SCALAR) {
            jox_diag_error(draft->reader.diagnostics, at, "bad-override",
                           map->kind == JOX_YAML_MAP
                               ? jox_scene_suggest(&draft->reader, key, map->keys, map->count)
                               : NULL,
                           "the scene has no '%.*s'", (int)(part - set), set);
            return;
        }
        map = *slot = jox_yaml_copy(draft->reader.arena, next); /* its aliases stay unchanged */
        part++;
    }
}
