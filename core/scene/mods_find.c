/* Finds mods in folders, and chooses mods that are named or enabled. */
#include "scene/mods.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/file.h"
#include "base/format/path.h"
#include "base/mem.h"
#include "base/overlay.h"
#include "base/zip.h"
#include "scene/mods_enabled.h"
#include "scene/mods_parts.h"

/* Reads the mods in the folders of a folder; links are not followed. */
static void search_folder(JoxModsFind *f, const char *folder) {
    char **names = jox_is_folder(folder) ? jox_folder_names(folder, false) : NULL;
    int count = 0;
    while (names && names[count])
        count++;
    for (int e = 0; e < count; e++) {
        char *path = jox_mods_join(f->reader.arena, folder, names[e]);
        struct stat info;
        char *sheet = jox_mods_join(f->reader.arena, path, "mod.yaml");
        bool link = lstat(path, &info) == 0 && S_ISLNK(info.st_mode);
        if (!link && (jox_is_file(sheet) || jox_mods_is_archive(path)))
            jox_mods_read_folder(f, path, false);
    }
    jox_free(names);
}

/* Reads the mods that are named by their folders, then those of the scene and of the user. */
static void search_folders(JoxModsFind *f) {
    const char *scene = f->def->scene, *slash = scene ? strrchr(scene, '/') : NULL;
    const char *home = getenv("XDG_DATA_HOME"), *user = getenv("HOME");
    char folder[1024];
    for (uint32_t n = 0; n < f->def->named_count;
         n++) /* first: of two mods with one name the first wins */
        if (jox_mods_is_place(f->def->named[n])) {
            snprintf(folder, sizeof folder, "%s", f->def->named[n]);
            for (size_t k = strlen(folder); k > 1 && folder[k - 1] == '/'; k--)
                folder[k - 1] = 0;
            jox_mods_read_folder(f, folder, true);
        }
    if (scene) {
        snprintf(folder, sizeof folder, "%.*s/mods", slash ? (int)(slash - scene) : 1,
                 slash ? scene : ".");
        search_folder(f, folder);
    }
    if (home && *home)
        snprintf(folder, sizeof folder, "%.900s/jostle/mods", home);
    else
        snprintf(folder, sizeof folder, "%.900s/.local/share/jostle/mods", user ? user : "");
    if ((home && *home) || user)
        search_folder(f, folder);
}

/* Returns the length of the folder of the first `length` bytes of a path, with its last '/'. */
static size_t get_folder_length(const char *path, size_t length) {
    while (length > 0 && path[length - 1] != '/')
        length--;
    return length;
}

/* Reads the mod `name` beside the folder of another one; whether it is there. */
static bool search_beside(JoxModsFind *f, const char *folder, const char *name) {
    static const char *const ENDINGS[] = {"", ".zip"};
    const char *inside;
    const size_t archive = jox_zip_split(folder, &inside); /* beside the archive, not within */
    char path[1200], sheet[1300];
    for (size_t e = 0; e < sizeof ENDINGS / sizeof *ENDINGS; e++) {
        snprintf(path, sizeof path, "%.*s%s/%.80s%s",
                 archive ? (int)get_folder_length(folder, archive) : (int)strlen(folder), folder,
                 archive ? "." : "/..", name, ENDINGS[e]);
        snprintf(sheet, sizeof sheet, "%s/mod.yaml", path);
        if (!jox_is_file(sheet) && !jox_mods_is_archive(path))
            continue;
        jox_path_clean(path);
        jox_mods_read_folder(f, path, false);
        return jox_mods_index(f->mods, name) >= 0;
    }
    return false;
}

/* Searches mods that are named or depended on, but not found yet: beside the mod that the scene
   belongs to, beside named mods, and beside the mod that depends on them. */
static void search_missing_mods(JoxModsFind *f) {
    const JoxMods *mods = f->mods;
    char own[1024] = "";
    if (f->def->scene) { /* a mod's scenes lie in a folder of the mod */
        char sheet[1200];
        snprintf(own, sizeof own, "%.*s..", (int)jox_path_folder(f->def->scene), f->def->scene);
        snprintf(sheet, sizeof sheet, "%s/mod.yaml", own);
        own[jox_is_file(sheet) ? strlen(own) : 0] = 0;
    }
    for (uint32_t n = 0; n < f->def->named_count; n++) {
        const char *name = f->def->named[n];
        bool found =
            strchr(name, '/') || jox_mods_is_place(name) || jox_mods_index(mods, name) >= 0;
        found = found || (*own && search_beside(f, own, name));
        for (uint32_t k = 0; k < f->def->named_count && !found; k++)
            found = jox_mods_is_place(f->def->named[k]) && search_beside(f, f->def->named[k], name);
    }
    for (uint32_t m = 0; m < mods->found_count; m++) /* also over mods that this loop finds */
        for (uint32_t d = 0; d < f->needs[m].depend_count; d++) {
            char name[64];
            const char *version;
            jox_mod_split_dependency(f->needs[m].depends[d]->text, name, &version);
            if (jox_mods_index(mods, name) < 0)
                search_beside(f, mods->found[m].folder, name);
        }
}

/* Chooses the mods that the user has enabled. */
static void choose_enabled(JoxModsFind *f) {
    JoxMods *mods = f->mods;
    for (uint32_t m = 0; m < mods->found_count && !f->def->named_only; m++) {
        const JoxMod *mod = &mods->found[m];
        if (mod->on == JOX_MOD_CHANGED && !f->needs[m].wanted)
            jox_diag_warn(f->reader.diagnostics, ((JoxPosition){mod->folder, 0, 0, 0}),
                          "mod-changed", "See what it holds, then: jostle mod enable",
                          "mod %s has changed since it was turned on: it is off", mod->name);
        f->needs[m].wanted |= mod->on == JOX_MOD_ON;
    }
}

/* Chooses the mods that the command line and the scene name, and reads the scene's values of their
   settings. */
static void choose_named(JoxModsFind *f) {
    JoxMods *mods = f->mods;
    for (uint32_t n = 0; n < f->def->named_count; n++) {
        int32_t m =
            jox_mods_is_place(f->def->named[n]) ? -2 : jox_mods_index(mods, f->def->named[n]);
        if (m >= 0)
            f->needs[m].wanted = true;
        else if (m == -1)
            jox_mods_report_missing(f, (JoxPosition){"--mod", 0, 0, 0}, f->def->named[n], "");
    }
    if (!f->def->scene)
        return;
    JoxYamlFiles *files = jox_arena_take(f->reader.arena, 1, sizeof *files);
    JoxDiagnostics ignored = {0}; /* jox_scene_read reports errors of the scene */
    JoxYaml *root = jox_yaml_read(f->reader.arena, f->def->scene, NULL, 0, files, &ignored);
    const JoxYaml *map = jox_yaml_get(root, "mods");
    jox_diag_free(&ignored);
    if (map && map->kind != JOX_YAML_MAP)
        jox_scene_error(&f->reader, map, "bad-type", "mods: {NAME: {}}",
                        "mods maps names of mods to their settings");
    for (uint32_t k = 0; map && map->kind == JOX_YAML_MAP && k < map->count; k++) {
        int32_t m = jox_mods_index(mods, map->keys[k]);
        if (m < 0) {
            jox_mods_report_missing(f, map->key_positions[k], map->keys[k], "the scene");
            continue;
        }
        f->needs[m].wanted = true;
        jox_mods_read_values(f, (uint32_t)m, map->items[k]);
    }
    jox_yaml_attach_sources(files, f->reader.diagnostics);
}

JoxMods *jox_mods_find(const JoxModsDef *def, JoxDiagnostics *diagnostics) {
    JoxMods *mods = jox_alloc(1, sizeof *mods);
    JoxModsFind *f = jox_alloc(1, sizeof *f);
    mods->memory = jox_arena_create();
    mods->found = jox_arena_take(mods->memory, JOX_MOST_MODS, sizeof *mods->found);
    f->def = def;
    f->mods = mods;
    f->enabled = jox_mods_read_enabled();
    f->reader =
        (JoxReader){.arena = mods->memory, .diagnostics = diagnostics, .format = &jox_scene_format};
    search_folders(f);
    search_missing_mods(f);
    choose_named(f);
    choose_enabled(f);
    jox_mods_apply_overrides(f);
    jox_mods_order(f);
    jox_free(f->enabled);
    jox_free(f);
    return mods;
}

void jox_mods_free(JoxMods *mods) {
    if (!mods)
        return;
    for (uint32_t m = 0; m < mods->count; m++)
        for (uint32_t p = 0; p < mods->items[m].patch_count; p++)
            if (mods->items[m]
                    .patches[p]
                    .lua) /* set by the reader of Lua; the arena owns the others */
                jox_free(mods->items[m].patches[p].target);
    jox_arena_free(mods->memory);
    jox_free(mods);
}
