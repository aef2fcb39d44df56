#include "scene/mods.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/file.h"
#include "base/mem.h"
#include "scene/mods_on.h"
#include "scene/schema.h"

enum { MOST_FILES = 256, LARGEST_FILE = 1 << 20, API = 1 };

/* What a mod.yaml says of others, until the order is known. */
typedef struct Needs {
    const JoxYaml *root;
    const JoxYaml *const *depends, *const *optional, *const *conflicts, *const *load_after;
    uint32_t depend_count, optional_count, conflict_count, after_count;
    bool wanted, broken;
    enum { UNSEEN, ON_THE_WAY, SOUND } link; /* of what it depends on */
    int depth;
    uint64_t before; /* bits of `found` that come before it */
} Needs;

typedef struct Find {
    const JoxModsDef *def;
    JoxMods *mods;
    Needs needs[JOX_MOST_MODS];
    JoxReader reader;
    char *on; /* the list of mods that are turned on */
} Find;

int32_t jox_mods_index(const JoxMods *mods, const char *name) {
    for (uint32_t m = 0; m < mods->found_count; m++)
        if (strcmp(mods->found[m].name, name) == 0)
            return (int32_t)m;
    return -1;
}

static bool is_folder(const char *path) {
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

static bool same_folder(const char *a, const char *b) {
    struct stat x, y;
    return stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

static char *join(JoxArena *arena, const char *folder, const char *name) {
    char *path = jox_arena_take(arena, strlen(folder) + strlen(name) + 2, 1);
    sprintf(path, "%s/%s", folder, name);
    return path;
}

/* ---- reading one ---- */

/* Names of other mods, with a version where `versions`. */
static uint32_t read_others(const JoxReader *r, const JoxYaml *root, const char *key, bool versions,
                            const JoxYaml *const **names) {
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

static bool plain_name(const char *name) {
    size_t n = strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789-_");
    return n > 0 && n <= 60 && !name[n];
}

static void read_settings(Find *f, JoxMod *mod, const JoxYaml *map) {
    const JoxReader *r = &f->reader;
    if (map->kind != JOX_YAML_MAP || map->count > 64) {
        jox_scene_error(r, map, "bad-type", "settings: {weight: {value: 80}}",
                        "settings maps at most 64 names to settings");
        return;
    }
    mod->settings = jox_arena_take(r->arena, map->count, sizeof *mod->settings);
    for (uint32_t s = 0; s < map->count; s++) {
        if (!jox_keys_check(r, map->items[s], "setting"))
            continue;
        JoxModSetting *setting = &mod->settings[mod->setting_count++];
        const char *unit = jox_key_text(r, map->items[s], "setting", "unit");
        const char *meaning = jox_key_text(r, map->items[s], "setting", "meaning");
        *setting = (JoxModSetting){
            .name = jox_arena_text(r->arena, map->keys[s]),
            .unit = jox_arena_text(r->arena, unit ? unit : ""),
            .meaning = jox_arena_text(r->arena, meaning ? meaning : ""),
            .value = jox_key_number(r, map->items[s], "setting", "value"),
            .least = jox_key_number(r, map->items[s], "setting", "least"),
            .greatest = jox_key_number(r, map->items[s], "setting", "greatest"),
            .position = map->key_positions[s],
        };
        if (!(setting->value >= setting->least && setting->value <= setting->greatest))
            jox_scene_error(r, map->items[s], "out-of-range", NULL,
                            "setting '%s' must be from %g to %g", setting->name, setting->least,
                            setting->greatest);
    }
}

static bool ends_with(const char *path, const char *ending) {
    size_t n = strlen(path), m = strlen(ending);
    return n >= m && strcmp(path + n - m, ending) == 0;
}

/* The target of a scene's patch: the top-level key `patch` or `replace`. */
static void read_target(Find *f, JoxModPatch *patch) {
    JoxYamlFiles *files = jox_arena_take(f->reader.arena, 1, sizeof *files);
    files->plain = true;
    JoxYaml *root =
        jox_yaml_load(f->reader.arena, patch->path, NULL, 0, files, f->reader.diagnostics);
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

/* Files of a mod are plain files of its own, and not too large. */
static bool is_sound(Find *f, const char *path, JoxPosition from) {
    struct stat info;
    const char *wrong = lstat(path, &info) != 0       ? "it cannot be read"
                        : S_ISLNK(info.st_mode)       ? "symbolic links are not followed"
                        : S_ISDIR(info.st_mode)       ? "" /* looked into elsewhere */
                        : !S_ISREG(info.st_mode)      ? "it is no plain file"
                        : info.st_size > LARGEST_FILE ? "it is over 1 MB"
                                                      : NULL;
    if (wrong && *wrong)
        jox_diag_error(f->reader.diagnostics, from, "bad-mod", NULL, "cannot use '%s': %s", path,
                       wrong);
    return !wrong;
}

/* Looks at all files of one of a mod's folders; those of patches/ become patches. */
static void read_folder(Find *f, JoxMod *mod, const char *name, JoxPosition from) {
    char *folder = join(f->reader.arena, mod->folder, name);
    bool patches = strcmp(name, "patches") == 0;
    struct stat info;
    if (lstat(folder, &info) == 0 && S_ISLNK(info.st_mode)) {
        is_sound(f, folder, from);
        return;
    }
    char **names = is_folder(folder) ? jox_folder_names(folder) : NULL;
    int count = 0;
    while (names && names[count])
        count++;
    if (count > MOST_FILES)
        jox_diag_error(f->reader.diagnostics, from, "bad-mod", NULL, "'%s' has more than %d files",
                       folder, MOST_FILES);
    if (patches && count > 0)
        mod->patches = jox_arena_take(f->reader.arena, (size_t)count, sizeof *mod->patches);
    for (int e = 0; e < count; e++) {
        char *path = join(f->reader.arena, folder, names[e]);
        bool lua = ends_with(path, ".lua"), yaml = ends_with(path, ".yaml");
        if (is_sound(f, path, from) && patches && (lua || yaml)) {
            JoxModPatch *patch = &mod->patches[mod->patch_count++];
            *patch = (JoxModPatch){.path = path, .lua = lua};
            if (yaml)
                read_target(f, patch);
        }
    }
    jox_free(names);
}

static void read_mod(Find *f, const char *folder, bool wanted) {
    JoxMods *mods = f->mods;
    const JoxReader *r = &f->reader;
    for (uint32_t m = 0; m < mods->found_count; m++)
        if (same_folder(mods->found[m].folder, folder)) {
            f->needs[m].wanted |= wanted;
            return;
        }
    char *path = join(r->arena, folder, "mod.yaml");
    JoxYamlFiles *files = jox_arena_take(r->arena, 1, sizeof *files);
    files->plain = true;
    size_t errors = r->diagnostics->errors;
    JoxYaml *root = is_sound(f, path, (JoxPosition){path, 0, 0, 0})
                        ? jox_yaml_load(r->arena, path, NULL, 0, files, r->diagnostics)
                        : NULL;
    if (root && mods->found_count == JOX_MOST_MODS) {
        jox_diag_error(r->diagnostics, root->position, "too-many", "Take some out of the folder",
                       "there are over %d mods: this is not looked at", JOX_MOST_MODS);
        return;
    }
    if (root && jox_yaml_get(root, "enabled"))
        jox_scene_error(r, jox_yaml_get(root, "enabled"), "unknown-key",
                        "Take the line out. A person turns a mod on: jostle mod enable NAME",
                        "'enabled' is no key of a mod: none turns itself on");
    else if (!root || !jox_keys_check(r, root, "mod"))
        return;
    const char *name = jox_key_text(r, root, "mod", "name");
    const char *title = jox_key_text(r, root, "mod", "title");
    const char *version = jox_key_text(r, root, "mod", "version");
    JoxPosition at = name ? jox_yaml_get(root, "name")->position : root->position;
    if (name && !plain_name(name))
        jox_diag_error(r->diagnostics, at, "bad-mod", "Example: gentle-queue",
                       "a mod's name has lower-case letters, digits, - and _ only");
    int32_t same = name ? jox_mods_index(mods, name) : -1;
    if (same >= 0) {
        jox_diag_error(r->diagnostics, at, "bad-mod", NULL,
                       "there is another mod '%s' in %s, which is taken", name,
                       mods->found[same].folder);
        return;
    }
    JoxMod *mod = &mods->found[mods->found_count];
    *mod = (JoxMod){.name = jox_arena_text(r->arena, name ? name : folder),
                    .title = jox_arena_text(r->arena, title ? title : ""),
                    .version = jox_arena_text(r->arena, version ? version : "0"),
                    .folder = jox_arena_text(r->arena, folder),
                    .on = jox_mods_on_look(f->on, name ? name : "", folder)};
    jox_key_number(r, root, "mod", "api"); /* its range is its check */
    Needs *needs = &f->needs[mods->found_count++];
    *needs = (Needs){.root = root, .wanted = wanted};
    needs->depend_count = read_others(r, root, "depends", true, &needs->depends);
    needs->optional_count = read_others(r, root, "optional", true, &needs->optional);
    needs->conflict_count = read_others(r, root, "conflicts", false, &needs->conflicts);
    needs->after_count = read_others(r, root, "load_after", true, &needs->load_after);
    if (jox_yaml_get(root, "settings"))
        read_settings(f, mod, jox_yaml_get(root, "settings"));
    read_folder(f, mod, "behaviours", at);
    read_folder(f, mod, "scenes", at);
    read_folder(f, mod, "patches", at);
    needs->broken = r->diagnostics->errors > errors;
    for (uint32_t i = 0; i < files->count; i++)
        jox_diag_attach_source(r->diagnostics, files->items[i].path, files->items[i].text,
                               files->items[i].length);
}

/* ---- which ---- */

static void look_into(Find *f, const char *folder) {
    char **names = is_folder(folder) ? jox_folder_names(folder) : NULL;
    int count = 0;
    while (names && names[count])
        count++;
    for (int e = 0; e < count; e++) {
        char *path = join(f->reader.arena, folder, names[e]);
        struct stat info;
        char *sheet = join(f->reader.arena, path, "mod.yaml");
        bool link = lstat(path, &info) == 0 && S_ISLNK(info.st_mode);
        if (!link && stat(sheet, &info) == 0)
            read_mod(f, path, false);
    }
    jox_free(names);
}

static void look_everywhere(Find *f) {
    const char *scene = f->def->scene, *slash = scene ? strrchr(scene, '/') : NULL;
    const char *home = getenv("XDG_DATA_HOME"), *user = getenv("HOME");
    char folder[1024];
    for (uint32_t n = 0; n < f->def->named_count; n++) /* first, so that they win */
        if (is_folder(f->def->named[n])) {
            snprintf(folder, sizeof folder, "%s", f->def->named[n]);
            for (size_t k = strlen(folder); k > 1 && folder[k - 1] == '/'; k--)
                folder[k - 1] = 0;
            read_mod(f, folder, true);
        }
    if (scene) {
        snprintf(folder, sizeof folder, "%.*s/mods", slash ? (int)(slash - scene) : 1,
                 slash ? scene : ".");
        look_into(f, folder);
    }
    if (home && *home)
        snprintf(folder, sizeof folder, "%.900s/jostle/mods", home);
    else
        snprintf(folder, sizeof folder, "%.900s/.local/share/jostle/mods", user ? user : "");
    if ((home && *home) || user)
        look_into(f, folder);
}

static void missing(Find *f, JoxPosition at, const char *name, const char *whose) {
    const char *names[JOX_MOST_MODS];
    for (uint32_t m = 0; m < f->mods->found_count; m++)
        names[m] = f->mods->found[m].name;
    jox_diag_error(f->reader.diagnostics, at, "missing-mod",
                   jox_scene_suggest(&f->reader, name, names, f->mods->found_count),
                   "there is no mod '%.60s'%s%s", name, *whose ? ", which is needed by " : "",
                   whose);
}

/* Those that a person turned on. */
static void choose_on(Find *f) {
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

/* Those that are named, by the command line or the scene. */
static void choose(Find *f) {
    JoxMods *mods = f->mods;
    for (uint32_t n = 0; n < f->def->named_count; n++) {
        int32_t m = is_folder(f->def->named[n]) ? -2 : jox_mods_index(mods, f->def->named[n]);
        if (m >= 0)
            f->needs[m].wanted = true;
        else if (m == -1)
            missing(f, (JoxPosition){"--mod", 0, 0, 0}, f->def->named[n], "");
    }
    if (!f->def->scene)
        return;
    JoxYamlFiles *files = jox_arena_take(f->reader.arena, 1, sizeof *files);
    JoxDiagnostics later = {0}; /* the scene's own errors are for its loader */
    JoxYaml *root = jox_yaml_load(f->reader.arena, f->def->scene, NULL, 0, files, &later);
    const JoxYaml *map = jox_yaml_get(root, "mods");
    jox_diag_free(&later);
    if (map && map->kind != JOX_YAML_MAP)
        jox_scene_error(&f->reader, map, "bad-type", "mods: {NAME: {}}",
                        "mods maps names of mods to their settings");
    for (uint32_t k = 0; map && map->kind == JOX_YAML_MAP && k < map->count; k++) {
        int32_t m = jox_mods_index(mods, map->keys[k]);
        if (m < 0) {
            missing(f, map->key_positions[k], map->keys[k], "the scene");
            continue;
        }
        f->needs[m].wanted = true;
        const JoxYaml *values = map->items[k];
        if (values->kind != JOX_YAML_MAP && !(values->kind == JOX_YAML_SCALAR && !*values->text))
            jox_scene_error(&f->reader, values, "bad-type", "mods: {NAME: {SETTING: 3}}",
                            "the settings of a mod are a map");
        for (uint32_t v = 0; values->kind == JOX_YAML_MAP && v < values->count; v++) {
            double number;
            JoxModSetting *found = NULL;
            for (uint32_t s = 0; s < mods->found[m].setting_count; s++)
                if (strcmp(mods->found[m].settings[s].name, values->keys[v]) == 0)
                    found = &mods->found[m].settings[s];
            if (!found)
                jox_diag_error(f->reader.diagnostics, values->key_positions[v], "unknown-setting",
                               NULL, "mod %s has no setting '%.60s'", mods->found[m].name,
                               values->keys[v]);
            else if (jox_read_number(&f->reader, values->items[v], found->unit, &number)) {
                found->value = number;
                found->position = values->items[v]->position;
            }
        }
    }
    for (uint32_t i = 0; i < files->count; i++)
        jox_diag_attach_source(f->reader.diagnostics, files->items[i].path, files->items[i].text,
                               files->items[i].length);
}

/* "mods.NAME.SETTING=VALUE" of the command line; values are checked against their ranges. */
static void set_settings(Find *f) {
    for (uint32_t s = 0; s < f->def->set_count; s++) {
        const char *set = f->def->sets[s], *equals = strchr(set, '=');
        if (strncmp(set, "mods.", 5) != 0 || !equals)
            continue;
        JoxPosition at = {"--set", 1, 1, (int)strlen(set) + 1};
        bool found = false;
        char *end;
        double value = strtod(equals + 1, &end);
        for (uint32_t m = 0; m < f->mods->found_count; m++) {
            JoxMod *mod = &f->mods->found[m];
            size_t n = strlen(mod->name);
            for (uint32_t k = 0; k < mod->setting_count; k++) {
                const char *name = mod->settings[k].name;
                if (strncmp(set + 5, mod->name, n) != 0 || set[5 + n] != '.' ||
                    strlen(name) != (size_t)(equals - set) - 6 - n ||
                    strncmp(set + 6 + n, name, strlen(name)) != 0)
                    continue;
                found = true;
                mod->settings[k].value = value;
                mod->settings[k].position = at;
            }
        }
        if (!found || end == equals + 1 || *end)
            jox_diag_error(f->reader.diagnostics, at, "bad-override",
                           "Example: mods.gentle-queue.weight=80",
                           "'%.100s' names no setting of a mod, or gives it no number", set);
    }
    for (uint32_t m = 0; m < f->mods->found_count; m++)
        for (uint32_t k = 0; k < f->mods->found[m].setting_count; k++) {
            const JoxModSetting *s = &f->mods->found[m].settings[k];
            if (s->value >= s->least && s->value <= s->greatest)
                continue;
            jox_diag_error(f->reader.diagnostics, s->position, "out-of-range", NULL,
                           "setting '%s' of mod %s must be from %g to %g, not %g", s->name,
                           f->mods->found[m].name, s->least, s->greatest, s->value);
            f->needs[m].broken = true;
        }
}

/* ---- order ---- */

/* Follows what a mod depends on; false with an error if that is missing, too old, or a circle. */
static bool link_mod(Find *f, uint32_t m) {
    JoxMods *mods = f->mods;
    Needs *n = &f->needs[m];
    bool good = !n->broken;
    if (n->link == SOUND)
        return good;
    n->link = ON_THE_WAY;
    for (uint32_t d = 0; d < n->depend_count && good; d++) {
        char name[64];
        const char *version;
        jox_mod_need(n->depends[d]->text, name, &version);
        int32_t other = jox_mods_index(mods, name);
        if (other < 0) {
            missing(f, n->depends[d]->position, name, mods->found[m].name);
            good = false;
        } else if (!f->needs[other].wanted && !f->def->needed_too) {
            jox_diag_error(f->reader.diagnostics, n->depends[d]->position, "mod-off",
                           "Turn it on: jostle mod enable; or name it for one run: --mod",
                           "mod %s needs mod %s, which is off", mods->found[m].name, name);
            good = false;
        } else if (version && jox_mod_compare(mods->found[other].version, version) < 0) {
            jox_diag_error(f->reader.diagnostics, n->depends[d]->position, "old-mod", NULL,
                           "mod %s needs %s %s or later; %s is there", mods->found[m].name, name,
                           version, mods->found[other].version);
            good = false;
        } else if (f->needs[other].link == ON_THE_WAY) {
            jox_diag_error(f->reader.diagnostics, n->depends[d]->position, "mod-circle", NULL,
                           "mods %s and %s depend on each other", mods->found[m].name, name);
            good = false;
        } else {
            good = link_mod(f, (uint32_t)other);
            n->before |= (uint64_t)1 << other;
        }
    }
    n->broken |= !good;
    n->link = SOUND; /* or broken: once is enough */
    return good;
}

/* Whether mod `m` comes after mod `other` by what is known so far, through others too. */
static bool comes_after(const Find *f, uint32_t m, uint32_t other) {
    uint64_t before = f->needs[m].before;
    for (uint64_t known = 0; known != before;) {
        known = before;
        for (uint32_t k = 0; k < f->mods->found_count; k++)
            if (known >> k & 1)
                before |= f->needs[k].before;
    }
    return before >> other & 1;
}

/* Optional ones and load_after count where the other is taken too, and does not itself come after
   this one. */
static void link_wishes(Find *f, uint32_t m) {
    Needs *n = &f->needs[m];
    for (uint32_t k = 0; k < n->optional_count + n->after_count; k++) {
        const JoxYaml *name =
            k < n->optional_count ? n->optional[k] : n->load_after[k - n->optional_count];
        char plain[64];
        const char *version;
        jox_mod_need(name->text, plain, &version);
        int32_t other = jox_mods_index(f->mods, plain);
        if (other < 0 || !f->needs[other].wanted || f->needs[other].broken || !n->wanted ||
            n->broken)
            continue;
        if (other == (int32_t)m || comes_after(f, (uint32_t)other, m))
            jox_diag_warn(f->reader.diagnostics, name->position, "mod-circle", NULL,
                          "mod %s would come after %s, which comes after it: not heeded",
                          f->mods->found[m].name, f->mods->found[other].name);
        else
            n->before |= (uint64_t)1 << other;
    }
}

static void want_all(Find *f) {
    for (bool more = true; more;) {
        more = false;
        for (uint32_t m = 0; m < f->mods->found_count; m++)
            for (uint32_t d = 0;
                 f->needs[m].wanted && !f->needs[m].broken && d < f->needs[m].depend_count; d++) {
                char name[64];
                const char *version;
                jox_mod_need(f->needs[m].depends[d]->text, name, &version);
                int32_t other = jox_mods_index(f->mods, name);
                if (other >= 0 && !f->needs[other].wanted)
                    f->needs[other].wanted = more = true;
            }
    }
}

static void exclude(Find *f) {
    JoxMods *mods = f->mods;
    for (uint32_t m = 0; m < mods->found_count; m++) {
        if (f->def->without >> m & 1)
            f->needs[m].broken = true;
        for (uint32_t c = 0; f->needs[m].wanted && c < f->needs[m].conflict_count; c++) {
            const JoxYaml *name = f->needs[m].conflicts[c];
            int32_t other = jox_mods_index(mods, name->text);
            if (other < 0 || !f->needs[other].wanted || f->needs[other].broken ||
                f->needs[m].broken)
                continue;
            jox_diag_error(f->reader.diagnostics, name->position, "mods-exclude",
                           "Take one of them away", "mod %s does not go together with %s",
                           mods->found[m].name, name->text);
            f->needs[m].broken = true;
        }
    }
    for (bool more = true; more;) { /* who needs what is left out is left out too */
        more = false;
        for (uint32_t m = 0; m < mods->found_count; m++)
            for (uint32_t d = 0; !f->needs[m].broken && d < f->needs[m].depend_count; d++) {
                char name[64];
                const char *version;
                jox_mod_need(f->needs[m].depends[d]->text, name, &version);
                int32_t other = jox_mods_index(mods, name);
                if (other < 0 || f->needs[other].broken)
                    f->needs[m].broken = more = true;
            }
    }
}

/* Longest chain of mods that come before each. There are no circles. */
static void measure_depths(Find *f) {
    uint32_t count = f->mods->found_count;
    for (uint32_t round = 0; round < count; round++)
        for (uint32_t m = 0; m < count; m++)
            for (uint32_t o = 0; o < count; o++)
                if (o != m && (f->needs[m].before >> o & 1) &&
                    f->needs[m].depth <= f->needs[o].depth)
                    f->needs[m].depth = f->needs[o].depth + 1;
}

static bool comes_before(const Find *f, uint32_t a, uint32_t b) {
    if (f->needs[a].depth != f->needs[b].depth)
        return f->needs[a].depth < f->needs[b].depth;
    return strcmp(f->mods->found[a].name, f->mods->found[b].name) < 0;
}

static void order(Find *f) {
    JoxMods *mods = f->mods;
    uint32_t list[JOX_MOST_MODS], count = 0;
    measure_depths(f);
    for (uint32_t m = 0; m < mods->found_count; m++) {
        if (!f->needs[m].wanted || f->needs[m].broken)
            continue;
        uint32_t at = count++;
        for (; at > 0 && comes_before(f, m, list[at - 1]); at--)
            list[at] = list[at - 1];
        list[at] = m;
    }
    mods->items = jox_arena_take(f->reader.arena, count + 1, sizeof *mods->items);
    mods->number = jox_arena_take(f->reader.arena, count + 1, sizeof *mods->number);
    mods->count = count;
    for (uint32_t k = 0; k < count; k++) {
        mods->number[k] = list[k];
        mods->items[k] = mods->found[list[k]];
        for (uint32_t o = 0; o < k; o++)
            if (f->needs[list[k]].before >> list[o] & 1)
                mods->items[k].after |= (uint64_t)1 << o | mods->items[o].after;
    }
}

JoxMods *jox_mods_find(const JoxModsDef *def, JoxDiagnostics *diagnostics) {
    JoxMods *mods = jox_alloc(1, sizeof *mods);
    Find *f = jox_alloc(1, sizeof *f);
    mods->memory = jox_arena_create();
    mods->found = jox_arena_take(mods->memory, JOX_MOST_MODS, sizeof *mods->found);
    f->def = def;
    f->mods = mods;
    f->on = jox_mods_on_read();
    f->reader = (JoxReader){mods->memory, diagnostics};
    look_everywhere(f);
    choose(f);
    choose_on(f);
    set_settings(f);
    for (uint32_t m = 0; m < mods->found_count; m++)
        if (f->needs[m].wanted)
            link_mod(f, m);
    want_all(f);
    exclude(f);
    for (uint32_t m = 0; m < mods->found_count; m++)
        link_wishes(f, m);
    order(f);
    jox_free(f->on);
    jox_free(f);
    return mods;
}

void jox_mods_free(JoxMods *mods) {
    if (!mods)
        return;
    for (uint32_t m = 0; m < mods->count; m++)
        for (uint32_t p = 0; p < mods->items[m].patch_count; p++)
            if (mods->items[m].patches[p].lua) /* named by who reads Lua, the rest by the arena */
                jox_free(mods->items[m].patches[p].target);
    jox_arena_free(mods->memory);
    jox_free(mods);
}
