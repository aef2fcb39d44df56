/* Reads a mod: its mod.yaml, and the files of its folders. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/mem.h"
#include "base/overlay.h"
#include "base/zip.h"
#include "scene/mods_enabled.h"
#include "scene/mods_parts.h"
#include "scene/scene_draft.h"

enum { MOST_FILES = 256, LARGEST_FILE = 1 << 20 };

int32_t jox_mods_index(const JoxMods *mods, const char *name) {
    for (uint32_t m = 0; m < mods->found_count; m++)
        if (strcmp(mods->found[m].name, name) == 0)
            return (int32_t)m;
    return -1;
}

bool jox_mods_is_archive(const char *path) {
    const char *inside;
    return jox_zip_split(path, &inside) > 0 && !*inside;
}

bool jox_mods_is_place(const char *path) {
    return jox_is_folder(path) || jox_mods_is_archive(path);
}

char *jox_mods_join(JoxArena *arena, const char *folder, const char *name) {
    char *path = jox_arena_take(arena, strlen(folder) + strlen(name) + 2, 1);
    sprintf(path, "%s/%s", folder, name);
    return path;
}

/* ---- parts of a mod ---- */

/* Reads a key with names of other mods, which may have a least version if `versions`. */
static uint32_t read_mod_names(const JoxReader *r, const JoxYaml *root, const char *key,
                               bool versions, const JoxYaml *const **names) {
    uint32_t count = jox_read_names(r, jox_yaml_get(root, key), names);
    for (uint32_t k = 0; k < count; k++) {
        const char *text = (*names)[k]->text, *rest = text + strcspn(text, " >=<");
        rest += strspn(rest, " ");
        bool asks = versions && strncmp(rest, ">=", 2) == 0;
        rest += asks ? 2 + strspn(rest + 2, " ") : 0;
        size_t digits = asks ? strspn(rest, "0123456789.") : 0;
        if (*text && strcspn(text, " >=<") < 64 && rest[digits] == 0 &&
            (!asks || (digits && *rest != '.')))
            continue;
        jox_scene_error(r, (*names)[k], "bad-value",
                        versions ? "Example: 'gentle-queue >= 1.2'" : "Example: gentle-queue",
                        "%s: '%.60s' is no name of a mod", key, text);
    }
    return count;
}

static bool is_mod_name(const char *name) {
    size_t n = strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789-_");
    return n > 0 && n <= 60 && !name[n];
}

static bool has_ending(const char *path, const char *ending) {
    size_t n = strlen(path), m = strlen(ending);
    return n >= m && strcmp(path + n - m, ending) == 0;
}

/* Reads the target of a patch of a scene: its top-level key `patch` or `replace`. */
static void read_target(JoxModsFind *f, JoxModPatch *patch) {
    JoxYamlFiles *files = jox_arena_take(f->reader.arena, 1, sizeof *files);
    files->untrusted = true;
    files->role = JOX_YAML_PATCH;
    JoxYaml *root =
        jox_yaml_read(f->reader.arena, patch->path, NULL, 0, files, f->reader.diagnostics);
    const JoxYaml *target = jox_yaml_get(root, "patch");
    patch->replaces = !target;
    target = target ? target : jox_yaml_get(root, "replace");
    if (root && (!target || target->kind != JOX_YAML_SCALAR)) {
        jox_diag_error(f->reader.diagnostics, root->position, "no-patch", "patch: NAME",
                       "this file must say which scene it changes");
        return;
    }
    if (target) {
        patch->target = jox_arena_text(f->reader.arena, target->text);
        patch->position = target->position;
    }
}

/* Whether a path is a plain file, not too large; reports what is neither that nor a folder. */
static bool check_mod_file(JoxModsFind *f, const char *path, JoxPosition from) {
    struct stat info;
    if (lstat(path, &info) != 0 && errno == ENOTDIR) /* in an archive, which is checked */
        return jox_zip_is_file(path);
    const char *wrong = lstat(path, &info) != 0       ? "it cannot be read"
                        : S_ISLNK(info.st_mode)       ? "symbolic links are not followed"
                        : S_ISDIR(info.st_mode)       ? "" /* not an error */
                        : !S_ISREG(info.st_mode)      ? "it is no plain file"
                        : info.st_size > LARGEST_FILE ? "it is over 1 MB"
                                                      : NULL;
    if (wrong && *wrong)
        jox_diag_error(f->reader.diagnostics, from, "bad-mod", NULL, "cannot use '%s': %s", path,
                       wrong);
    return !wrong;
}

/* Checks all files of one of a mod's folders, and appends those of patches/ to its patches. */
static void read_mod_subfolder(JoxModsFind *f, JoxMod *mod, const char *name, JoxPosition from) {
    char *folder = jox_mods_join(f->reader.arena, mod->folder, name);
    bool patches = strcmp(name, "patches") == 0;
    struct stat info;
    if (lstat(folder, &info) == 0 && S_ISLNK(info.st_mode)) {
        check_mod_file(f, folder, from);
        return;
    }
    char **names = jox_is_folder(folder) ? jox_folder_names(folder, false) : NULL;
    int count = 0;
    while (names && names[count])
        count++;
    if (count > MOST_FILES)
        jox_diag_error(f->reader.diagnostics, from, "bad-mod", NULL, "'%s' has more than %d files",
                       folder, MOST_FILES);
    if (patches && count > 0)
        mod->patches = jox_arena_take(f->reader.arena, (size_t)count, sizeof *mod->patches);
    for (int e = 0; e < count; e++) {
        char *path = jox_mods_join(f->reader.arena, folder, names[e]);
        bool lua = has_ending(path, ".lua"), yaml = has_ending(path, ".yaml");
        if (check_mod_file(f, path, from) && patches && (lua || yaml)) {
            JoxModPatch *patch = &mod->patches[mod->patch_count++];
            *patch = (JoxModPatch){.path = path, .lua = lua};
            if (yaml)
                read_target(f, patch);
        }
    }
    jox_free(names);
}

/* ---- a whole mod ---- */

/* Returns the folder of a mod in an archive: the archive itself or, if that has no mod.yaml, the
   one folder that it holds. NULL with an error if the archive is refused. */
static const char *open_mod_archive(JoxModsFind *f, const char *path) {
    char *fault = jox_zip_fault(path);
    if (fault) {
        jox_diag_error(f->reader.diagnostics,
                       ((JoxPosition){jox_arena_text(f->reader.arena, path), 0, 0, 0}), "bad-mod",
                       NULL, "cannot use '%s': %s", path, fault);
        jox_free(fault);
        return NULL;
    }
    const char *folder = path;
    char *sheet = jox_mods_join(f->reader.arena, path, "mod.yaml");
    char **names = jox_is_file(sheet) ? NULL : jox_folder_names(path, false);
    for (size_t n = 0; names && names[n]; n++) {
        char *inner = jox_mods_join(f->reader.arena, path, names[n]);
        if (jox_is_file(jox_mods_join(f->reader.arena, inner, "mod.yaml")))
            folder = inner;
    }
    jox_free(names);
    return folder;
}

void jox_mods_read_folder(JoxModsFind *f, const char *folder, bool wanted) {
    JoxMods *mods = f->mods;
    const JoxReader *r = &f->reader;
    folder = jox_mods_is_archive(folder) ? open_mod_archive(f, folder) : folder;
    if (!folder)
        return;
    for (uint32_t m = 0; m < mods->found_count; m++)
        if (jox_path_same(mods->found[m].folder, folder)) {
            f->needs[m].wanted |= wanted;
            return;
        }
    char *path = jox_mods_join(r->arena, folder, "mod.yaml");
    JoxYamlFiles *files = jox_arena_take(r->arena, 1, sizeof *files);
    files->untrusted = true;
    files->role = JOX_YAML_MOD;
    size_t errors = r->diagnostics->errors;
    JoxYaml *root = check_mod_file(f, path, (JoxPosition){path, 0, 0, 0})
                        ? jox_yaml_read(r->arena, path, NULL, 0, files, r->diagnostics)
                        : NULL;
    if (root && mods->found_count == JOX_MOST_MODS) {
        jox_diag_error(r->diagnostics, root->position, "too-many", "Take some out of the folder",
                       "there are over %d mods: this is not looked at", JOX_MOST_MODS);
        return;
    }
    if (!root || root->kind != JOX_YAML_MAP) {
        if (root)
            jox_owner_check_keys(r, root, "mod"); /* reports that it is no map */
        return;
    }
    if (jox_yaml_get(root, "enabled")) {
        jox_scene_error(r, jox_yaml_get(root, "enabled"), "unknown-key",
                        "Take the line out. A person turns a mod on: jostle mod enable NAME",
                        "'enabled' is no key of a mod: none turns itself on");
        jox_yaml_remove(root, "enabled");
    }
    JoxMod *mod = &mods->found[mods->found_count];
    *mod = (JoxMod){0};
    jox_owner_read(r, root, "mod", mod);
    const char *name = mod->name;
    JoxPosition at = name ? jox_yaml_get(root, "name")->position : root->position;
    if (name && !is_mod_name(name))
        jox_diag_error(r->diagnostics, at, "bad-mod", "Example: gentle-queue",
                       "a mod's name has lower-case letters, digits, - and _ only");
    int32_t same = name ? jox_mods_index(mods, name) : -1;
    if (same >= 0) {
        jox_diag_error(r->diagnostics, at, "bad-mod", NULL,
                       "there is another mod '%s' in %s, which is taken", name,
                       mods->found[same].folder);
        return;
    }
    mod->name = name ? mod->name : jox_arena_text(r->arena, folder);
    mod->title = mod->title ? mod->title : jox_arena_text(r->arena, "");
    mod->version = mod->version ? mod->version : jox_arena_text(r->arena, "0");
    mod->folder = jox_arena_text(r->arena, folder);
    mod->on = jox_mods_look_up_enabled(f->enabled, name ? name : "", folder);
    JoxModNeeds *needs = &f->needs[mods->found_count++];
    *needs = (JoxModNeeds){.root = root, .wanted = wanted};
    needs->depend_count = read_mod_names(r, root, "depends", true, &needs->depends);
    needs->optional_count = read_mod_names(r, root, "optional", true, &needs->optional);
    needs->conflict_count = read_mod_names(r, root, "conflicts", false, &needs->conflicts);
    needs->after_count = read_mod_names(r, root, "load_after", true, &needs->load_after);
    read_mod_subfolder(f, mod, "behaviours", at);
    read_mod_subfolder(f, mod, "scenes", at);
    read_mod_subfolder(f, mod, "patches", at);
    needs->broken = r->diagnostics->errors > errors;
    jox_yaml_attach_sources(files, r->diagnostics);
}

void jox_mods_report_missing(JoxModsFind *f, JoxPosition at, const char *name,
                             const char *needed_by) {
    const char *names[JOX_MOST_MODS];
    for (uint32_t m = 0; m < f->mods->found_count; m++)
        names[m] = f->mods->found[m].name;
    const char *hint = jox_scene_suggest(&f->reader, name, names, f->mods->found_count);
    jox_diag_error(f->reader.diagnostics, at, "missing-mod",
                   hint ? hint
                        : "Mods are found by name in the mods/ beside the scene; give the "
                          "folder of another: --mod DIR",
                   "there is no mod '%.60s'%s%s", name, *needed_by ? ", which is needed by " : "",
                   needed_by);
}
