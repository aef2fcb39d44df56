/* Operations on trees of YAML, and the arena that they live in. */
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/path.h"
#include "base/mem.h"
#include "scene/format/yaml.h"

enum { DEEPEST = JOX_YAML_DEEPEST };

/* ---- memory ---- */

struct JoxArena {
    void **blocks;
    size_t count, capacity;
};

JoxArena *jox_arena_create(void) {
    return jox_alloc(1, sizeof(JoxArena));
}
void *jox_arena_take(JoxArena *h, size_t count, size_t size) {
    JOX_RESERVE(h->blocks, h->capacity, h->count + 1);
    return h->blocks[h->count++] = jox_alloc(count ? count : 1, size);
}
char *jox_arena_text(JoxArena *h, const char *text) {
    return text ? strcpy(jox_arena_take(h, strlen(text) + 1, 1), text) : NULL;
}
void jox_arena_free(JoxArena *h) {
    for (size_t i = 0; h && i < h->count; i++)
        jox_free(h->blocks[i]);
    if (h)
        jox_free(h->blocks);
    jox_free(h);
}

char *jox_arena_beside(JoxArena *arena, const char *file, const char *name) {
    char path[JOX_LONGEST_PATH];
    jox_path_beside(file, name, path); /* truncated if too long: then reading it fails */
    return jox_arena_text(arena, path);
}

/* ---- trees ---- */

bool jox_yaml_same(const JoxYaml *a, const JoxYaml *b) {
    if (a == b || !a || !b)
        return a == b;
    bool same = a->kind == b->kind && a->count == b->count && a->quoted == b->quoted &&
                (a->kind != JOX_YAML_SCALAR || strcmp(a->text, b->text) == 0);
    for (uint32_t i = 0; same && a->kind != JOX_YAML_SCALAR && i < a->count; i++)
        same = (a->kind == JOX_YAML_LIST || strcmp(a->keys[i], b->keys[i]) == 0) &&
               jox_yaml_same(a->items[i], b->items[i]);
    return same;
}

JoxYaml *jox_yaml_get(const JoxYaml *map, const char *key) {
    for (uint32_t i = 0; map && map->kind == JOX_YAML_MAP && i < map->count; i++)
        if (strcmp(map->keys[i], key) == 0)
            return map->items[i];
    return NULL;
}

const char *jox_yaml_name(const JoxYaml *node) {
    const JoxYaml *name = jox_yaml_get(node, "name");
    return name && name->kind == JOX_YAML_SCALAR ? name->text : NULL;
}

JoxYaml **jox_yaml_slot(const JoxYaml *node, const char *key) {
    if (node->kind == JOX_YAML_LIST) {
        const bool is_number = *key && strlen(key) < 9 && key[strspn(key, "0123456789")] == 0;
        unsigned long i = is_number ? strtoul(key, NULL, 10) : node->count;
        for (uint32_t n = 0; !is_number && n < node->count && i == node->count; n++) {
            const char *name = jox_yaml_name(node->items[n]);
            i = name && strcmp(name, key) == 0 ? n : i;
        }
        return i < node->count ? &node->items[i] : NULL;
    }
    for (uint32_t i = 0; i < node->count; i++)
        if (!strcmp(node->keys[i], key))
            return &node->items[i];
    return NULL;
}

void jox_yaml_add(JoxArena *arena, JoxYaml *node, const char *key, JoxPosition at, JoxYaml *value) {
    if (node->count ==
        node->capacity) { /* the arena cannot grow a block: the old ones stay in it */
        uint32_t wider = node->capacity ? 2 * node->capacity : 4;
        JoxYaml **items = jox_arena_take(arena, wider, sizeof *items);
        if (node->count)
            memcpy(items, node->items, node->count * sizeof *items);
        node->items = items;
        if (node->kind == JOX_YAML_MAP) {
            const char **keys = jox_arena_take(arena, wider, sizeof *keys);
            JoxPosition *positions = jox_arena_take(arena, wider, sizeof *positions);
            if (node->count) {
                memcpy(keys, node->keys, node->count * sizeof *keys);
                memcpy(positions, node->key_positions, node->count * sizeof *positions);
            }
            node->keys = keys;
            node->key_positions = positions;
        }
        node->capacity = wider;
    }
    node->items[node->count] = value;
    if (node->kind == JOX_YAML_MAP) {
        node->keys[node->count] = key;
        node->key_positions[node->count] = at;
    }
    node->count++;
}

void jox_yaml_set(JoxArena *arena, JoxYaml *map, const char *key, JoxYaml *value) {
    JOX_ASSERT(map->kind == JOX_YAML_MAP && value);
    for (uint32_t i = 0; i < map->count; i++)
        if (strcmp(map->keys[i], key) == 0) {
            map->items[i] = value;
            return;
        }
    jox_yaml_add(arena, map, jox_arena_text(arena, key), value->position, value);
}

void jox_yaml_set_at(JoxArena *arena, JoxYaml *map, const char *key, JoxPosition at,
                     JoxYaml *value) {
    JOX_ASSERT(map->kind == JOX_YAML_MAP && value);
    jox_yaml_set(arena, map, key, value);
    for (uint32_t i = 0; i < map->count; i++)
        if (strcmp(map->keys[i], key) == 0)
            map->key_positions[i] = at;
}

void jox_yaml_remove(JoxYaml *map, const char *key) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < map->count; i++) {
        if (strcmp(map->keys[i], key) == 0)
            continue;
        map->keys[kept] = map->keys[i];
        map->key_positions[kept] = map->key_positions[i];
        map->items[kept++] = map->items[i];
    }
    map->count = kept;
}

void jox_yaml_append(JoxArena *arena, JoxYaml *list, JoxYaml *item) {
    JOX_ASSERT(list->kind == JOX_YAML_LIST && item);
    jox_yaml_add(arena, list, NULL, item->position, item);
}

JoxYaml *jox_yaml_copy(JoxArena *arena, const JoxYaml *node) {
    JOX_ASSERT(node);
    JoxYaml *copy = jox_arena_take(arena, 1, sizeof *copy);
    *copy = *node;
    copy->items = NULL, copy->keys = NULL, copy->key_positions = NULL;
    copy->count = copy->capacity = 0;
    for (uint32_t i = 0; i < node->count; i++) {
        bool map = node->kind == JOX_YAML_MAP;
        jox_yaml_add(arena, copy, map ? node->keys[i] : NULL,
                     map ? node->key_positions[i] : node->position, node->items[i]);
    }
    return copy;
}

static void merge_maps(JoxArena *arena, JoxYaml *map, const JoxYaml *base, int depth);

/* Returns a copy of `list` in which the items that `change` maps by their `name` are changed; NULL
   if the list lacks one of them. */
static JoxYaml *merge_list_items(JoxArena *arena, const JoxYaml *change, const JoxYaml *list,
                                 int depth) {
    JoxYaml *result = jox_yaml_copy(arena, list);
    for (uint32_t k = 0; k < change->count; k++) {
        uint32_t i = 0;
        for (; i < list->count; i++) {
            const char *name = jox_yaml_name(list->items[i]);
            if (name && strcmp(name, change->keys[k]) == 0)
                break;
        }
        if (i == list->count || change->items[k]->kind != JOX_YAML_MAP)
            return NULL;
        result->items[i] = jox_yaml_copy(arena, change->items[k]);
        merge_maps(arena, result->items[i], list->items[i], depth + 1);
    }
    return result;
}

/* Adds to the map the keys of `base` that it lacks; see jox_yaml_merge. */
static void merge_maps(JoxArena *arena, JoxYaml *map, const JoxYaml *base, int depth) {
    for (uint32_t i = 0; i < base->count && depth < DEEPEST; i++) {
        JoxYaml *own = jox_yaml_get(map, base->keys[i]);
        if (!own) {
            jox_yaml_add(arena, map, base->keys[i], base->key_positions[i], base->items[i]);
        } else if (own->kind == JOX_YAML_MAP && base->items[i]->kind == JOX_YAML_MAP &&
                   own != base->items[i]) {
            own = jox_yaml_copy(arena, own); /* an alias may share it */
            merge_maps(arena, own, base->items[i], depth + 1);
            jox_yaml_set(arena, map, base->keys[i], own);
        } else if (own->kind == JOX_YAML_MAP && base->items[i]->kind == JOX_YAML_LIST) {
            JoxYaml *list = merge_list_items(arena, own, base->items[i], depth);
            if (list)
                jox_yaml_set(arena, map, base->keys[i], list);
        }
    }
}

void jox_yaml_merge(JoxArena *arena, JoxYaml *map, const JoxYaml *base) {
    merge_maps(arena, map, base, 0);
}
