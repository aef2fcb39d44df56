/* jo_check: finds errors in scenes, behaviours, claims and mods without running them. `jostle
   check` is the caller. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/format/installed.h"
#include "base/format/path.h"
#include "base/format/plurals.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/zip.h"
#include "jostle_tools.h"
#include "run/load_scene.h"
#include "run/orca_flow_note.h"
#include "run/read_scene.h"
#include "run/run.h"
#include "run/scenery_checks.h"
#include "run/storey_checks.h"
#include "run/wall_checks.h"
#include "validate/claims.h"

enum { DEEPEST = 8, MOST_ERRORS = 10000 }; /* greatest depth of nested folders */

static bool has_file_ending(const char *path, const char *ending) {
    size_t n = strlen(path), m = strlen(ending);
    return n >= m && strcmp(path + n - m, ending) == 0;
}

static void drop_message(void *context, const char *text) {
    (void)context;
    (void)text;
}

/* Loads a scene with its behaviours into a world that never steps, and keeps all diagnostics.
   `mod` is the folder of a mod to apply, or NULL. */
static void check_scene(const char *path, const char *mod, JoxDiagnostics *all) {
    JoSceneDef def = jo_default_scene_def();
    def.path = path;
    def.message = drop_message;
    def.mods = &mod;
    def.mod_count = mod != NULL;
    def.named_mods_only = def.needed_mods_too = mod != NULL;
    JoScene *scene = jox_run_load(&def, all);
    if (scene) {
        jox_run_note_orca_flow(scene, all);
        jox_run_check_goals(scene, all);
        jox_run_check_storeys(scene, all); /* after goals, which adds a person for each source */
        jox_run_check_scenery(scene, all);
        jox_diag_move(all, &scene->mod_problems);
    }
    jo_scene_free(scene);
}

/* Returns whether a Lua text requires a module by its name in quotes. */
static bool requires_module(const char *text, const char *module) {
    const size_t n = strlen(module);
    for (const char *at = text; (at = strstr(at, "require"));) {
        at += strlen("require");
        at += strspn(at, " (");
        if ((*at == '"' || *at == '\'') && !strncmp(at + 1, module, n) && at[n + 1] == *at)
            return true;
    }
    return false;
}

/* Returns whether a Lua file in a folder, other than `but`, requires a module. */
static bool is_required_in(const char *folder, const char *module, const char *but) {
    char **names = jox_folder_names(folder, false);
    bool found = false;
    for (char **name = names; name && *name && !found; name++) {
        char path[2048];
        size_t length;
        snprintf(path, sizeof path, "%s/%s", folder, *name);
        char *text = has_file_ending(*name, ".lua") && !jox_path_same(path, but)
                         ? jox_read_file(path, (size_t)1 << 20, &length)
                         : NULL;
        found = text && requires_module(text, module);
        jox_free(text);
    }
    jox_free(names);
    return found;
}

/* Returns whether a file in the same folder, or the one above, requires this file. */
static bool is_required(const char *path) {
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *folder_name;
    char folder[1024], above[1100], module[600];
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path) : 1, slash ? path : ".");
    snprintf(module, sizeof module, "%.*s", (int)(strlen(base) - strlen(".lua")), base);
    if (is_required_in(folder, module, path))
        return true;
    folder_name = strrchr(folder, '/') ? strrchr(folder, '/') + 1 : folder;
    snprintf(above, sizeof above, "%s/..", folder);
    snprintf(module, sizeof module, "%.200s/%.*s", folder_name,
             (int)(strlen(base) - strlen(".lua")), base);
    return is_required_in(above, module, path);
}

/* Turns the error "no-machine" into a note if the file is a library for others to require: it
   returns functions, or a table that is not a machine's, or another file requires it. */
static void note_library(const char *path, JoxDiagnostics *own) {
    static const JoxScope ANY = {0};
    size_t lacks = 0;
    while (lacks < own->count && strcmp(own->items[lacks].code, "no-machine") != 0)
        lacks++;
    if (lacks == own->count)
        return;
    JoxLua *lua = jox_lua_create(NULL);
    JoxDiagnostics unread = {0};
    uint32_t count;
    char *about;
    JoxLuaExport *exports = jox_lua_exports(lua, path, &ANY, &count, &about, &unread);
    const bool single = count == 1 && !*exports[0].name;
    bool library = !single || strcmp(exports[0].kind, "function") == 0 ||
                   (strcmp(exports[0].kind, "nil") != 0 && is_required(path));
    /* a table of states that was not made a machine is an error */
    for (uint32_t e = 0; e < count; e++)
        library &= strcmp(exports[e].name, "states") != 0;
    library &= unread.errors == 0;
    if (library) {
        char names[JOX_NOUN];
        JoxText text = {0};
        JoxDiagnostic *d = &own->items[lacks];
        jox_text_printf(&text, "no machine, but a library of %s for other files to require",
                        jox_noun(names, single ? 1 : count, "value"));
        jox_free(d->message);
        jox_free(d->hint);
        d->severity = JOX_SEVERITY_NOTE;
        d->code = "library";
        d->message = text.data;
        d->hint = NULL;
        own->errors--;
        own->kept_errors--;
    }
    jox_lua_exports_free(exports, count);
    jox_free(about);
    jox_diag_free(&unread);
    jox_lua_free(lua);
}

/* Loads a behaviour and keeps its diagnostics. `scope` says which mods change it, or is NULL. */
static void check_behaviour(const char *path, const JoxScope *scope, JoxDiagnostics *all) {
    JoxLua *lua = jox_lua_create(NULL);
    JoxDiagnostics own = {0};
    jox_machine_free(jox_lua_load(lua, path, scope, &own));
    note_library(path, &own);
    jox_diag_move(all, &own);
    jox_lua_free(lua);
}

static bool is_file(const char *path) {
    struct stat info;
    return stat(path, &info) == 0 ? S_ISREG(info.st_mode) : jox_zip_is_file(path);
}

/* Returns whether a Lua file is a claim: a line begins with "return claim". */
static bool is_claim(const char *path) {
    size_t length;
    char *text = jox_read_file(path, (size_t)1 << 20, &length);
    const char *at = text ? strstr(text, "return claim") : NULL;
    bool claim = at && (at == text || at[-1] == '\n');
    jox_free(text);
    return claim;
}

/* Returns whether a Lua file only has definitions for editors. */
static bool is_definition(const char *path) {
    size_t length;
    char *text = jox_read_file(path, (size_t)1 << 20, &length);
    const bool definition = text && strncmp(text, "---@meta", 8) == 0;
    jox_free(text);
    return definition;
}

/* Loads a claim and checks that the scenes of its runs exist. */
static void check_claim(const char *path, JoxDiagnostics *all) {
    JoxClaim *claim = jox_claim_load(path, false, all);
    for (uint32_t r = 0; claim && r < claim->run_count; r++)
        if (!is_file(claim->runs[r].scene))
            jox_diag_error(all, ((JoxPosition){path, 0, 0, 0}), "missing-file", NULL,
                           "run '%s': there is no scene %s", claim->runs[r].name,
                           claim->runs[r].scene);
    jox_claim_free(claim);
}

/* ---- mods ---- */

/* Searches the file that a patch changes: in a mod for "mod:name"; else in the tree that
   contains the mods, then in the library. Returns false if there is none. */
static bool search_patched_file(const JoxMods *mods, const JoxMod *mod, const JoxModPatch *patch,
                                char path[1024]) {
    const char *kind = patch->lua ? "behaviours" : "scenes", *end = patch->lua ? "lua" : "yaml";
    const char *colon = strchr(patch->target, ':');
    for (uint32_t m = 0; colon && m < mods->found_count; m++) {
        const JoxMod *owner = &mods->found[m];
        if (strncmp(owner->name, patch->target, (size_t)(colon - patch->target)) ||
            owner->name[colon - patch->target])
            continue;
        snprintf(path, 1024, "%.500s/%s/%.200s.%s", owner->folder, kind, colon + 1, end);
        return is_file(path);
    }
    const char *const forms[] = {"%.500s/../../%.20s/%.200s.%s", "%.500s/../../../%.20s/%.200s.%s"};
    for (int f = 0; f < 2; f++) {
        snprintf(path, 1024, forms[f], mod->folder, kind, patch->target, end);
        if (is_file(path))
            return true;
    }
    snprintf(path, 1024, "%.500s/../../%.200s.%s", mod->folder, patch->target, end);
    if (is_file(path))
        return true;
    snprintf(path, 1024, "%s/%s/%.200s.%s", jox_data_folder(), kind, patch->target, end);
    return is_file(path);
}

static bool find_patched_file(const JoxMods *mods, const JoxMod *mod, const JoxModPatch *patch,
                              char path[1024]) {
    const bool found = search_patched_file(mods, mod, patch, path);
    jox_path_clean(path);
    return found;
}

/* Checks the files that a mod's patches change, as they are after the change. */
static void check_patches(const JoxMods *mods, const JoxMod *mod, JoxDiagnostics *all) {
    for (uint32_t p = 0; p < mod->patch_count; p++) {
        const JoxModPatch *patch = &mod->patches[p];
        char path[1024];
        if (!patch->target)
            continue;
        if (!find_patched_file(mods, mod, patch, path)) {
            jox_diag_error(all, patch->position, "unknown-target",
                           "A file of behaviours/ or scenes/ by its name, or mod:name of a mod",
                           "there is no %s '%s' to change", patch->lua ? "behaviour" : "scene",
                           patch->target);
        } else if (patch->lua) {
            JoxScope scope = {.mods = mods->items, .mod_count = mods->count};
            check_behaviour(path, &scope, all);
        } else {
            check_scene(path, mod->folder, all);
        }
    }
}

/* Loads a mod with the mods that it needs, and checks the files that its patches change. */
static void check_mod(const char *folder, JoxDiagnostics *all) {
    char beside[1024];
    /* a path in the tree of the other mods, to find them */
    snprintf(beside, sizeof beside, "%.900s/../../scene", folder);
    JoSceneDef def = jo_default_scene_def();
    def.path = beside;
    def.mods = &folder;
    def.mod_count = 1;
    def.named_mods_only = def.needed_mods_too = true;
    JoxMods *mods = jox_run_find_mods(&def, 0, all);
    for (uint32_t m = 0; m < mods->count; m++)
        if (jox_path_same(mods->items[m].folder, folder))
            check_patches(mods, &mods->items[m], all);
    jox_mods_free(mods);
}

/* ---- paths ---- */

/* Checks a file; `named`: it was given itself, not found in a folder. `mod` is as in check_path. */
static void check_file(const char *path, bool named, const char *mod, JoxDiagnostics *own) {
    if (strcmp(jox_path_name(path), "mod.yaml") == 0) {
        char folder[1024];
        const size_t length = jox_path_folder(path);
        snprintf(folder, sizeof folder, "%.*s", length ? (int)length : 1, length ? path : ".");
        if (named)
            check_mod(folder, own);
    } else if (has_file_ending(path, ".yaml") || has_file_ending(path, ".yml")) {
        check_scene(path, mod, own);
    } else if (has_file_ending(path, ".lua") && !has_file_ending(path, "_test.lua")) {
        if (is_claim(path))
            check_claim(path, own);
        else if (!is_definition(path))
            check_behaviour(path, NULL, own);
    } else if (named && !has_file_ending(path, ".lua")) {
        jox_diag_error(own, ((JoxPosition){path, 0, 0, 0}), "unknown-kind", NULL,
                       "only scenes (.yaml) and behaviours (.lua) can be checked");
    }
}

/* Lists the names in a folder, for the caller to free; NULL with a diagnostic if it is too deep
   or cannot be read. */
static char **list_folder(const char *path, int depth, JoxDiagnostics *own) {
    static const char *const HINT = "Give its path, too, to have it checked";
    const JoxPosition at = {path, 0, 0, 0};
    if (depth >= DEEPEST) {
        jox_diag_warn(own, at, "unread-folder", HINT,
                      "folders are checked %d levels deep, so not this one", DEEPEST);
        return NULL;
    }
    char **names = jox_folder_names(path, false);
    if (!names)
        jox_diag_error(own, at, "unread-folder", depth ? HINT : NULL,
                       "the folder cannot be read: %s", strerror(errno));
    return names;
}

/* Checks a file or folder; `mod` is the folder of the mod that contains it, or NULL. */
static void check_path(const char *path, bool named, int depth, const char *mod,
                       JoxDiagnostics *all) {
    struct stat info;
    JoxDiagnostics own = {0};
    char **names = NULL;
    char *fault = jox_zip_fault(path);
    if (fault) {
        jox_diag_error(&own, ((JoxPosition){path, 0, 0, 0}), "bad-mod", NULL,
                       "cannot use the archive: %s", fault);
        jox_free(fault);
    } else if (stat(path, &info) != 0 && errno != ENOTDIR) {
        jox_diag_error(&own, ((JoxPosition){path, 0, 0, 0}), "unreadable-file", NULL, "%s",
                       errno == ENOENT ? "there is no such file" : strerror(errno));
    } else if (!jox_is_folder(path)) {
        check_file(path, named, mod, &own);
    } else {
        char sheet[1024];
        names = list_folder(path, depth, &own);
        snprintf(sheet, sizeof sheet, "%.900s/mod.yaml", path);
        if (names && !mod && is_file(sheet)) {
            mod = path;
            check_mod(path, &own);
        }
    }
    for (char **name = names; name && *name; name++) {
        char inner[1024];
        snprintf(inner, sizeof inner, "%s/%s", path, *name);
        jox_path_clean(inner);                               /* as scenes refer to it */
        bool patches = mod && strcmp(*name, "patches") == 0; /* check_mod has checked them */
        if (!patches)
            check_path(inner, false, depth + 1, mod, all);
    }
    jox_free(names);
    jox_diag_move(all, &own);
}

/* Appends the diagnostics and a line with their numbers. */
static void print_findings(const JoxDiagnostics *all, JoxText *out) {
    size_t notes = 0;
    for (size_t d = 0; d < all->count; d++)
        notes += all->items[d].severity == JOX_SEVERITY_NOTE;
    jox_diag_print(all, out);
    if (all->errors || all->warnings)
        jox_text_noun(out, all->errors, "error");
    else
        jox_text_add(out, "nothing wrong");
    if (all->warnings) {
        jox_text_add(out, ", ");
        jox_text_noun(out, all->warnings, "warning");
    }
    if (notes) {
        jox_text_add(out, ", ");
        jox_text_noun(out, notes, "note");
    }
    jox_text_add(out, "\n");
}

/* Finds the folder of the mod that contains a path, which is not the mod itself; "" if there is
   none. */
static void find_mod(const char *path, char folder[1024]) {
    static const char *const UP[] = {"", "/..", "/../.."};
    char above[1024];
    snprintf(above, sizeof above, "%.900s", path);
    *folder = 0;
    struct stat info;
    const bool is_folder = stat(path, &info) == 0 && S_ISDIR(info.st_mode);
    char *const slash = strrchr(above, '/');
    if (!is_folder && slash)
        slash[1] = 0;
    else if (!is_folder)
        snprintf(above, sizeof above, ".");
    for (int up = is_folder; up <= 2; up++) {
        char sheet[1024];
        snprintf(folder, 1024, "%.900s%s", above, UP[up]);
        snprintf(sheet, sizeof sheet, "%.900s/mod.yaml", folder);
        if (is_file(sheet))
            return;
    }
    *folder = 0;
}

/* Checks a given path. A path inside a mod is checked as a part of the mod; for a patch, the
   whole mod is. */
static void check_named(const char *path, JoxDiagnostics *all) {
    char mod[1024], sheet[1024], patches[1024];
    struct stat info, other;
    find_mod(path, mod);
    snprintf(sheet, sizeof sheet, "%.900s/mod.yaml", path);
    if (!*mod || is_file(sheet) || strcmp(jox_path_name(path), "mod.yaml") == 0) {
        check_path(path, true, 0, NULL, all);
        return;
    }
    const size_t folder = jox_path_folder(path);
    char above[1024];
    snprintf(above, sizeof above, "%.*s.", (int)folder, path);
    snprintf(patches, sizeof patches, "%.900s/patches", mod);
    const bool is_patch =
        stat(patches, &info) == 0 &&
        ((stat(path, &other) == 0 && info.st_dev == other.st_dev && info.st_ino == other.st_ino) ||
         (stat(above, &other) == 0 && info.st_dev == other.st_dev && info.st_ino == other.st_ino));
    if (is_patch)
        check_mod(mod, all);
    else
        check_path(path, true, 0, mod, all);
}

/* Checks the paths, reports the diagnostics as text or JSON, and returns the number of errors. */
static size_t check_all(const char *const *paths, size_t count, bool json, JoMessage *message,
                        void *context) {
    JoxDiagnostics all = {.limit = MOST_ERRORS}; /* each file keeps its first 20 */
    JoxText text = {0};
    for (size_t p = 0; p < count; p++)
        check_named(paths[p], &all);
    if (json)
        jox_diag_json(&all, &text);
    else
        print_findings(&all, &text);
    if (text.length)
        jox_run_send_message(message, context, text.data);
    size_t errors = all.errors;
    jox_text_free(&text);
    jox_diag_free(&all);
    return errors;
}

size_t jo_check(const char *const *paths, size_t count, bool json, JoMessage *message,
                void *context, JoError *error) {
    JOX_REQUIRE(paths && message, 0);
    JOX_GUARD (NULL, error)
        return SIZE_MAX;
    return check_all(paths, count, json, message, context);
}
