/* Finds where a value of a scene comes from: its own files, the command line or the default. Called
   by run/mods for `jostle mod why`, which adds the changes of mods. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "scene/scene_draft.h"

/* Splits the first part off a path, "groups" off "groups.red.count"; returns `part`. */
static const char *split_path(const char **path, char part[64]) {
    const size_t length = strcspn(*path, ".");
    snprintf(part, 64, "%.*s", (int)(length < 63 ? length : 63), *path);
    *path += length + ((*path)[length] == '.');
    return part;
}

static const JoxYaml *find_yaml_item(const JoxYaml *node, const char *key) {
    JoxYaml **slot = node ? jox_yaml_slot(node, key) : NULL;
    return slot ? *slot : NULL;
}

static const JoxYaml *find_node(const JoxYaml *node, const char *path) {
    char part[64];
    while (node && *path)
        node = find_yaml_item(node, split_path(&path, part));
    return node;
}

enum { LONGEST = 400 }; /* bytes of a value, beyond which no items are printed */

/* Appends a value as it is written, on one line. */
static void print_yaml_value(const JoxYaml *node, JoxText *out) {
    const bool map = node->kind == JOX_YAML_MAP;
    if (node->kind == JOX_YAML_SCALAR) {
        jox_text_add(out, node->text);
        return;
    }
    jox_text_add(out, map ? "{" : "[");
    for (uint32_t k = 0; k < node->count && out->length < LONGEST; k++) {
        jox_text_printf(out, "%s%s%s", k ? ", " : "", map ? node->keys[k] : "", map ? ": " : "");
        print_yaml_value(node->items[k], out);
    }
    jox_text_add(out, map ? "}" : "]");
}

bool jox_scene_print_changed_value(const JoxPatchChange *change, const char *rest, JoxText *out) {
    const JoxYaml *node = find_node(change->value, rest);
    if (node)
        print_yaml_value(node, out);
    return node != NULL;
}

static void visit_value(const JoxYaml *node, JoSetBy by, JoSetVisit *visit, void *context) {
    JoxText value = {0};
    print_yaml_value(node, &value);
    visit(context, &(JoSetting){.by = by,
                                .value = value.data,
                                .file = node->position.file,
                                .line = node->position.line,
                                .column = node->position.column});
    jox_text_free(&value);
}

bool jox_scene_visit_own_value(const JoxSceneSpec *spec, const char *path, JoSetVisit *visit,
                               void *context) {
    const JoxYaml *node = find_node(spec->own_tree, path);
    if (node)
        visit_value(node, JO_SET_SCENE, visit, context);
    return node != NULL;
}

bool jox_scene_visit_set_value(const JoxSceneSpec *spec, const char *path, JoSetVisit *visit,
                               void *context) {
    const JoxYaml *node = find_node(spec->tree, path);
    if (!node || strcmp(node->position.file, JOX_SET_OPTION) != 0)
        return false;
    visit_value(node, JO_SET_OVERRIDE, visit, context);
    return true;
}

static bool visit_default(const JoxKey *key, JoSetVisit *visit, void *context) {
    if (!*key->default_text || *key->default_text == '!')
        return false;
    visit(context,
          &(JoSetting){.by = JO_SET_DEFAULT, .value = key->default_text, .unit = key->unit});
    return true;
}

/* Follows the path through the table of keys. After a key with several items ("group*", "event[]")
   a part is the name or number of an item, which must exist; a table may be missing. */
bool jox_scene_visit_default(const JoxSceneSpec *spec, const char *path, JoSetVisit *visit,
                             void *context) {
    char owner[32] = "scene", part[64];
    const JoxYaml *node = spec->tree;
    for (;;) {
        const JoxKey *key = jox_key_find(&jox_scene_format, owner, split_path(&path, part));
        if (!key || !*path)
            return key && visit_default(key, visit, context);
        if (!key->content)
            return false;
        node = find_yaml_item(node, part);
        const size_t plain = strcspn(key->content, "*[");
        if (key->content[plain] && !(node = find_yaml_item(node, split_path(&path, part))))
            return false;
        snprintf(owner, sizeof owner, "%.*s", (int)plain, key->content);
    }
}
