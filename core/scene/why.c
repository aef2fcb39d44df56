/* Where a value of a scene is written: `mod why`. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "scene/internal.h"

enum { LONGEST_SHOWN = 60 };

/* The item of a map by its key; of a list by its number, or by the `name` that it gives. */
static const JoxYaml *item_of(const JoxYaml *node, const char *key, size_t length) {
    for (uint32_t i = 0; node->kind == JOX_YAML_MAP && i < node->count; i++)
        if (strlen(node->keys[i]) == length && strncmp(node->keys[i], key, length) == 0)
            return node->items[i];
    for (uint32_t i = 0; node->kind == JOX_YAML_LIST && i < node->count; i++) {
        char number[16];
        snprintf(number, sizeof number, "%u", i);
        const JoxYaml *item = node->items[i];
        const JoxYaml *name = item->kind == JOX_YAML_MAP ? jox_yaml_get(item, "name") : NULL;
        const char *called = name && name->kind == JOX_YAML_SCALAR ? name->text : number;
        if ((strlen(called) == length && strncmp(called, key, length) == 0) ||
            (strlen(number) == length && strncmp(number, key, length) == 0))
            return item;
    }
    return NULL;
}

static const JoxYaml *find(const JoxYaml *node, const char *path) {
    while (node && *path) {
        const size_t length = strcspn(path, ".");
        node = item_of(node, path, length);
        path += length + (path[length] == '.');
    }
    return node;
}

static void tell(const JoxYaml *node, JoxText *out) {
    jox_text_printf(out, "  %s:%d:%d: ", node->position.file, node->position.line,
                    node->position.column);
    if (node->kind == JOX_YAML_SCALAR)
        jox_text_printf(out, "%.*s\n", LONGEST_SHOWN, node->text);
    else
        jox_text_printf(out, "%s of %u\n", node->kind == JOX_YAML_MAP ? "a table" : "a list",
                        node->count);
}

bool jox_scene_why(const JoxSceneSpec *spec, const char *path, JoxText *out) {
    const JoxYaml *node = spec->own ? find(spec->own, path) : NULL;
    if (node)
        tell(node, out);
    return node != NULL;
}

bool jox_scene_why_set(const JoxSceneSpec *spec, const char *path, JoxText *out) {
    const JoxYaml *node = spec->tree ? find(spec->tree, path) : NULL;
    if (!node || strcmp(node->position.file, JOX_LOAD_OVERRIDE) != 0)
        return false;
    tell(node, out);
    return true;
}

static bool tell_default(const JoxKey *key, JoxText *out) {
    if (!*key->standard || *key->standard == '!')
        return false;
    jox_text_printf(out, "  the default: %s%s%s\n", key->standard, *key->unit ? " " : "",
                    key->unit);
    return true;
}

/* Follows the table of keys along the path: in "group*" and "event[]" one part is a name or a
   number, which must be there; a table may be absent. */
bool jox_scene_why_default(const JoxSceneSpec *spec, const char *path, JoxText *out) {
    char owner[32] = "scene", name[64];
    const JoxYaml *node = spec->tree;
    for (;;) {
        size_t length = strcspn(path, ".");
        snprintf(name, sizeof name, "%.*s", (int)(length < 63 ? length : 63), path);
        const JoxKey *key = jox_key_find(&jox_scene_format, owner, name);
        if (!key || !path[length])
            return key && tell_default(key, out);
        if (!key->of)
            return false;
        node = node ? item_of(node, path, length) : NULL;
        path += length + 1;
        const size_t plain = strcspn(key->of, "*[");
        if (key->of[plain]) {
            length = strcspn(path, ".");
            node = node ? item_of(node, path, length) : NULL;
            if (!node)
                return false;
            path += length + (path[length] == '.');
        }
        snprintf(owner, sizeof owner, "%.*s", (int)plain, key->of);
    }
}
