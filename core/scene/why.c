/* Where a value of a scene is written: `mod why`. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "scene/internal.h"

/* Takes the first part off a path of "groups.red.count". */
static const char *take(const char **path, char part[64]) {
    const size_t length = strcspn(*path, ".");
    snprintf(part, 64, "%.*s", (int)(length < 63 ? length : 63), *path);
    *path += length + ((*path)[length] == '.');
    return part;
}

static const JoxYaml *item_of(const JoxYaml *node, const char *key) {
    JoxYaml **slot = node ? jox_load_slot(node, key) : NULL;
    return slot ? *slot : NULL;
}

static const JoxYaml *find(const JoxYaml *node, const char *path) {
    char part[64];
    while (node && *path)
        node = item_of(node, take(&path, part));
    return node;
}

enum { LONGEST = 400 }; /* bytes of a value that are told */

/* Appends a value as it is written, on one line. */
static void print(const JoxYaml *node, JoxText *out) {
    const bool map = node->kind == JOX_YAML_MAP;
    if (node->kind == JOX_YAML_SCALAR) {
        jox_text_add(out, node->text);
        return;
    }
    jox_text_add(out, map ? "{" : "[");
    for (uint32_t k = 0; k < node->count && out->length < LONGEST; k++) {
        jox_text_printf(out, "%s%s%s", k ? ", " : "", map ? node->keys[k] : "", map ? ": " : "");
        print(node->items[k], out);
    }
    jox_text_add(out, map ? "}" : "]");
}

bool jox_scene_why_change(const JoxPatchChange *change, const char *rest, JoxText *out) {
    const JoxYaml *node = find(change->value, rest);
    if (node)
        print(node, out);
    return node != NULL;
}

static void tell(const JoxYaml *node, JoSetBy by, JoSetVisit *visit, void *context) {
    JoxText value = {0};
    print(node, &value);
    visit(context, &(JoSetting){.by = by,
                                .value = value.data,
                                .file = node->position.file,
                                .line = node->position.line,
                                .column = node->position.column});
    jox_text_free(&value);
}

bool jox_scene_why(const JoxSceneSpec *spec, const char *path, JoSetVisit *visit, void *context) {
    const JoxYaml *node = find(spec->own, path);
    if (node)
        tell(node, JO_SET_SCENE, visit, context);
    return node != NULL;
}

bool jox_scene_why_set(const JoxSceneSpec *spec, const char *path, JoSetVisit *visit,
                       void *context) {
    const JoxYaml *node = find(spec->tree, path);
    if (!node || strcmp(node->position.file, JOX_LOAD_OVERRIDE) != 0)
        return false;
    tell(node, JO_SET_OVERRIDE, visit, context);
    return true;
}

static bool tell_default(const JoxKey *key, JoSetVisit *visit, void *context) {
    if (!*key->standard || *key->standard == '!')
        return false;
    visit(context, &(JoSetting){.by = JO_SET_DEFAULT, .value = key->standard, .unit = key->unit});
    return true;
}

/* Follows the table of keys along the path: in "group*" and "event[]" one part is a name or a
   number, which must be there; a table may be absent. */
bool jox_scene_why_default(const JoxSceneSpec *spec, const char *path, JoSetVisit *visit,
                           void *context) {
    char owner[32] = "scene", part[64];
    const JoxYaml *node = spec->tree;
    for (;;) {
        const JoxKey *key = jox_key_find(&jox_scene_format, owner, take(&path, part));
        if (!key || !*path)
            return key && tell_default(key, visit, context);
        if (!key->of)
            return false;
        node = item_of(node, part);
        const size_t plain = strcspn(key->of, "*[");
        if (key->of[plain] && !(node = item_of(node, take(&path, part))))
            return false;
        snprintf(owner, sizeof owner, "%.*s", (int)plain, key->of);
    }
}
