/* Reads a scene's file into a JoxSceneSpec: reads the tree of YAML, merges the patches of mods and
   the values of the command line into it, then fills the spec by the table of keys (key_table.c).
   Reports all errors, not only the first. Called by run/, and by tools that need no world. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "scene/scene_draft.h"

/* Whether a key has content, be it right or wrong. */
static bool has_content(const JoxYaml *node) {
    return node && (node->kind == JOX_YAML_SCALAR || node->count > 0);
}

/* Finds the extent in plan of all points of a scene with storeys, by which storeys are laid out:
   reads the scene once with all storeys in one plane, and drops what is wrong, which is reported
   when it is read for good. */
static void measure_plan(JoxSceneDraft *draft, const JoxYaml *root) {
    JoxDiagnostics dropped = {.limit = 1};
    JoxSceneSpec spec = {.path = draft->scene->path};
    JoxSceneDraft once = {.scene = &spec,
                          .options = draft->options,
                          .datadir = draft->datadir,
                          .files = draft->files,
                          .root = root,
                          .measuring = true};
    const uint32_t files = draft->files->count;
    once.reader = draft->reader;
    once.reader.arena = spec.memory = jox_arena_create();
    once.reader.diagnostics = &dropped;
    once.reader.draft = &once;
    jox_owner_read(&once.reader, root, "scene", &spec);
    draft->files->count = files; /* files of walls are read again */
    jox_walls_free(&spec.walls);
    jox_arena_free(spec.memory);
    jox_diag_free(&dropped);
}

static void read_scene_keys(JoxSceneDraft *draft, const JoxYaml *root) {
    draft->root = root;
    if (has_content(jox_yaml_get(root, "storeys")))
        measure_plan(draft, root);
    const size_t errors = draft->reader.diagnostics->errors;
    jox_owner_read(&draft->reader, root, "scene", draft->scene);
    if (draft->reader.diagnostics->errors == errors)
        jox_scene_check_storeys(&draft->reader);
    if (!has_content(jox_yaml_get(root, "groups")) && !has_content(jox_yaml_get(root, "bodies")) &&
        !has_content(jox_yaml_get(root, "probes"))) /* probes alone measure a recording */
        jox_scene_error(&draft->reader, root, "empty-scene", "See scenes/circle.yaml",
                        "a scene needs a group or a body");
}

JoxSceneSpec *jox_scene_read_text(const char *name, const char *text, size_t length,
                                  const JoxSceneOptions *options, JoxDiagnostics *diagnostics) {
    JoxArena *arena = jox_arena_create();
    JoxYamlFiles *files = jox_arena_take(arena, 1, sizeof *files);
    JoxSceneDraft draft = {
        .reader = {.arena = arena, .diagnostics = diagnostics, .format = &jox_scene_format},
        .scene = jox_alloc(1, sizeof(JoxSceneSpec)),
        .options = options,
        .files = files};
    JoxPlacing plan = {.low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}};
    const size_t errors = diagnostics->errors;
    draft.reader.draft = &draft;
    draft.reader.placing = &plan;
    draft.scene->memory = arena;
    draft.datadir = options ? options->datadir : NULL;
    draft.scene->path = jox_arena_text(arena, name);
    JoxYaml *root = jox_yaml_read(arena, draft.scene->path, text, length, files, diagnostics);
    /* Patches copy what they change; jox_scene_set_value changes the root in place. */
    draft.scene->own_tree =
        root && options && options->set_count ? jox_yaml_copy(arena, root) : root;
    if (root && options)
        root = jox_mods_patch_scene(&draft, root, files);
    for (uint32_t i = 0; root && options && i < options->set_count; i++)
        if (strncmp(options->sets[i], "mods.", 5) !=
            0) /* settings of mods: mods_find.c has read them */
            jox_scene_set_value(&draft, root, options->sets[i]);
    if (root)
        read_scene_keys(&draft, root);
    jox_yaml_attach_sources(files, diagnostics);
    draft.scene->tree = root;
    if (diagnostics->errors > errors) {
        jox_scene_free(draft.scene);
        return NULL;
    }
    draft.scene->files = jox_arena_take(arena, files->count, sizeof *draft.scene->files);
    draft.scene->file_count = files->count;
    for (uint32_t i = 0; i < files->count; i++) {
        draft.scene->files[i].path = files->items[i].path;
        draft.scene->files[i].text = files->items[i].text;
        draft.scene->files[i].length = files->items[i].length;
        memcpy(draft.scene->files[i].sha256, files->items[i].sha256, 65);
    }
    return draft.scene;
}

JoxSceneSpec *jox_scene_read(const char *path, const JoxSceneOptions *options,
                             JoxDiagnostics *diagnostics) {
    return jox_scene_read_text(path, NULL, 0, options, diagnostics);
}

void jox_scene_free(JoxSceneSpec *scene) {
    if (!scene)
        return;
    jox_walls_free(&scene->walls);
    jox_storeys_free(&scene->storeys);
    jox_patch_changes_free(&scene->changes);
    jox_arena_free(scene->memory);
    jox_free(scene);
}

bool jox_scene_differs(const JoxSceneSpec *a, const JoxSceneSpec *b, const char *key) {
    JOX_ASSERT(jox_key_find(&jox_scene_format, "scene", key));
    return !jox_yaml_same(jox_yaml_get(a->tree, key), jox_yaml_get(b->tree, key));
}

void jox_scene_list_restart_keys(const JoxSceneSpec *a, const JoxSceneSpec *b, JoxText *out) {
    for (size_t k = 0; k < jox_scene_format.key_count; k++) {
        const JoxKey *key = &jox_scene_format.keys[k];
        if (key->restart_reason && !strcmp(key->owner, "scene") &&
            jox_scene_differs(a, b, key->name))
            jox_text_printf(out, "%s%s (%s)", out->length ? ", " : "", key->name,
                            key->restart_reason);
    }
}

void jox_scene_list_live_keys(const JoxSceneSpec *a, const JoxSceneSpec *b,
                              const char *const *apart, JoxText *out) {
    for (size_t k = 0; k < jox_scene_format.key_count; k++) {
        const JoxKey *key = &jox_scene_format.keys[k];
        bool listed = !key->restart_reason && !strcmp(key->owner, "scene");
        for (const char *const *name = apart; listed && *name; name++)
            listed = strcmp(*name, key->name) != 0;
        if (listed && jox_scene_differs(a, b, key->name))
            jox_text_printf(out, "%s%s", out->length ? ", " : "", key->name);
    }
}
