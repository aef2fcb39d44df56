/* From a scene's file to a JoxSceneSpec: the tree is read and patched, then the table of keys.c is
   walked. Everything wrong is reported, not only the first. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "scene/internal.h"

/* Whether a key holds something, right or wrong: what is wrong is reported where it is read. */
static bool is_filled(const JoxYaml *node) {
    return node && (node->kind == JOX_YAML_SCALAR || node->count > 0);
}

static void read_scene(JoxLoad *l, const JoxYaml *root) {
    l->root = root;
    jox_keys_fill(&l->reader, root, "scene", l->scene);
    if (!is_filled(jox_yaml_get(root, "groups")) && !is_filled(jox_yaml_get(root, "bodies")) &&
        !is_filled(jox_yaml_get(root, "probes"))) /* of a recording: those alone */
        jox_scene_error(&l->reader, root, "empty-scene", "See scenes/circle.yaml",
                        "a scene needs a group or a body");
}

JoxSceneSpec *jox_scene_load_text(const char *name, const char *text, size_t length,
                                  const JoxSceneOptions *options, JoxDiagnostics *diagnostics) {
    JoxArena *arena = jox_arena_create();
    JoxYamlFiles *files = jox_arena_take(arena, 1, sizeof *files);
    JoxLoad load = {
        .reader = {.arena = arena, .diagnostics = diagnostics, .format = &jox_scene_format},
        .scene = jox_alloc(1, sizeof(JoxSceneSpec)),
        .options = options,
        .files = files};
    const size_t errors = diagnostics->errors;
    load.reader.load = &load;
    load.scene->memory = arena;
    load.datadir = options ? options->datadir : NULL;
    load.scene->path = jox_arena_text(arena, name);
    JoxYaml *root = jox_yaml_load(arena, load.scene->path, text, length, files, diagnostics);
    /* Patches make a copy of what they change; what is set for the run is changed in place. */
    load.scene->own = root && options && options->set_count ? jox_yaml_copy(arena, root) : root;
    if (root && options)
        root = jox_load_patches(&load, root, files);
    for (uint32_t i = 0; root && options && i < options->set_count; i++)
        if (strncmp(options->sets[i], "mods.", 5) != 0) /* settings of mods, read before */
            jox_load_override(&load, root, options->sets[i]);
    if (root)
        read_scene(&load, root);
    for (uint32_t i = 0; i < files->count; i++)
        jox_diag_attach_source(diagnostics, files->items[i].path, files->items[i].text,
                               files->items[i].length);
    load.scene->tree = root;
    if (diagnostics->errors > errors) {
        jox_scene_free(load.scene);
        return NULL;
    }
    load.scene->files = jox_arena_take(arena, files->count, sizeof *load.scene->files);
    load.scene->file_count = files->count;
    for (uint32_t i = 0; i < files->count; i++) {
        load.scene->files[i].path = files->items[i].path;
        load.scene->files[i].text = files->items[i].text;
        load.scene->files[i].length = files->items[i].length;
        memcpy(load.scene->files[i].sha256, files->items[i].sha256, 65);
    }
    return load.scene;
}

JoxSceneSpec *jox_scene_load(const char *path, const JoxSceneOptions *options,
                             JoxDiagnostics *diagnostics) {
    return jox_scene_load_text(path, NULL, 0, options, diagnostics);
}

void jox_scene_free(JoxSceneSpec *scene) {
    if (!scene)
        return;
    jox_walls_free(&scene->walls);
    jox_patch_changes_free(&scene->changes);
    jox_arena_free(scene->memory);
    jox_free(scene);
}

bool jox_scene_differs(const JoxSceneSpec *a, const JoxSceneSpec *b, const char *key) {
    JOX_ASSERT(jox_key_find(&jox_scene_format, "scene", key));
    return !jox_yaml_same(jox_yaml_get(a->tree, key), jox_yaml_get(b->tree, key));
}

void jox_scene_later(const JoxSceneSpec *a, const JoxSceneSpec *b, JoxText *out) {
    for (size_t k = 0; k < jox_scene_format.key_count; k++) {
        const JoxKey *key = &jox_scene_format.keys[k];
        if (key->later && !strcmp(key->owner, "scene") && jox_scene_differs(a, b, key->name))
            jox_text_printf(out, "%s%s (%s)", out->length ? ", " : "", key->name, key->later);
    }
}
