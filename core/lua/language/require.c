/* require: runs another file once and returns its result. The file is beside the one that requires
   it, beside the behaviour, in a mod or in the library. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/format/installed.h"
#include "base/format/path.h"
#include "base/mem.h"
#include "base/overlay.h"
#include "lua/language/script.h"

enum { MOST_FILES = 64, MOST_REQUIRED = 1000 };

/* Returns whether a name stays within the folder it is looked up in: no "..", no absolute path. */
static bool is_safe_name(const char *name) {
    if (!*name || *name == '/' || *name == '.' || strlen(name) > 100 || strstr(name, ".."))
        return false;
    for (const char *c = name; *c; c++)
        if (!((*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9') ||
              *c == '_' || *c == '-' || *c == '/' || *c == '.' || *c == ':'))
            return false;
    return true;
}

/* Returns whether a module's file exists within its folder, with its path. Symbolic links are
   refused when it is read. */
static bool is_module(JoxScript *script, const char *folder, const char *name, char path[1024]) {
    struct stat info;
    snprintf(path, 1024, "%.511s/%.400s.lua", folder, name);
    jox_vm_note_path(&script->vm, path);
    return jox_overlay_file(path) || (lstat(path, &info) == 0 && S_ISLNK(info.st_mode)) ||
           jox_path_below(path, folder);
}

/* Finds the file of a module: "mod:name" in a mod; else beside the file that requires it, beside
   the behaviour, or in the library. */
static bool find_module(lua_State *L, const char *name, char path[1024]) {
    JoxScript *script = jox_script_of(L);
    JoxPosition from = jox_vm_place(L);
    const char *colon = strchr(name, ':');
    const char *asking = from.file ? from.file : script->vm.sources[0]->path,
               *own = script->vm.sources[0]->path;
    char folder[JOX_LONGEST_PATH];
    for (uint32_t m = 0; colon && m < script->scope->mod_count; m++) {
        const JoxMod *mod = &script->scope->mods[m];
        snprintf(folder, sizeof folder, "%.480s/behaviours", mod->folder);
        if (!strncmp(mod->name, name, (size_t)(colon - name)) && !mod->name[colon - name])
            return is_module(script, folder, colon + 1, path);
    }
    if (colon)
        return false;
    const char *const files[] = {asking, own};
    for (int i = 0; i < 2; i++) {
        const char *slash = strrchr(files[i], '/');
        snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - files[i]) : 1,
                 slash ? files[i] : ".");
        if (is_module(script, folder, name, path))
            return true;
    }
    const char *slash = strrchr(own, '/');
    snprintf(folder, sizeof folder, "%.*s/../scripts", slash ? (int)(slash - own) : 1,
             slash ? own : ".");
    if (is_module(script, folder, name, path))
        return true;
    snprintf(folder, sizeof folder, "%s/scripts", jox_data_folder());
    return is_module(script, folder, name, path);
}

static uint32_t find_source_number(const JoxScript *script, const char *path) {
    uint32_t number = 0;
    while (number < script->vm.source_count && strcmp(script->vm.sources[number]->path, path) != 0)
        number++;
    return number;
}

/* Records which file a name refers to in the file that requires it. */
static void record_required(JoxScript *script, const char *asking, const char *name,
                            const char *path) {
    const uint32_t from = asking ? find_source_number(script, asking) : 0,
                   given = find_source_number(script, path);
    if (given == script->vm.source_count || script->required_count == MOST_REQUIRED)
        return;
    JOX_RESERVE(script->required, script->required_capacity, script->required_count + 1);
    script->required[script->required_count++] =
        (JoxRequired){from, given, jox_vm_intern(&script->vm, name)};
}

int jox_require(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    const char *name = luaL_checkstring(L, 1);
    char path[1024];
    jox_vm_charge(L, 500); /* for looking up files in the file system */
    if (!script->vm.loading)
        return luaL_error(L, "require works at the top of a file, not in functions");
    if (!is_safe_name(name))
        return jox_word_error(L, name, "bad-require", "Names are relative to this file's folder",
                              "cannot require '%s': not a plain name", name);
    if (!find_module(L, name, path) || script->vm.source_count >= MOST_FILES)
        return jox_word_error(
            L, name, "missing-file", NULL,
            "cannot require '%s': there is no such file beside this one or in the "
            "library",
            name);
    luaL_getsubtable(L, LUA_REGISTRYINDEX, "jostle loaded");
    if (lua_getfield(L, -1, path) == LUA_TLIGHTUSERDATA)
        return jox_word_error(L, name, "require-circle", "Put what both need into a third file",
                              "cannot require '%s': it is being loaded, and leads back to itself",
                              name);
    if (!lua_isnil(L, -1)) {
        record_required(script, jox_vm_place(L).file, name, path);
        return 1;
    }
    JoxPosition from = jox_word_position(L, name);
    size_t number = script->vm.source_count;
    JoxSource *source = jox_script_read(script, path, NULL, 0, from);
    if (!source)
        return jox_node_push_error(L);
    jox_vm_charge(L, source->length / 4);
    lua_pushlightuserdata(L, script); /* marks a file that is being loaded */
    lua_setfield(L, 2, path);
    if (!jox_vm_compile(&script->vm, number))
        return lua_error(L);
    lua_call(L, 0, 1);
    lua_pushvalue(L, -1);
    lua_setfield(L, 2, path);
    record_required(script, jox_vm_place(L).file, name, path);
    return 1;
}
