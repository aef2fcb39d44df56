/* Loading: a fresh Lua state per behaviour, kept as long as its hooks may be called. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "lua/internal.h"

/* Where Lua's parser stopped: it names the line and, mostly, the token "near" it. */
static void report_failure(JoxVm *vm, const char *why, int line) {
    JoxSource *source = &vm->sources[vm->failed_source];
    JoxPosition position = {source->path, line, 0, 0};
    const char *near = strstr(why, " near '");
    if (near) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(near + 7, "'"), near + 7);
        const JoxToken *t = jox_source_find(source, line, name);
        if (t)
            position = (JoxPosition){source->path, line, t->column, t->end_column};
    }
    jox_diag_error(vm->diagnostics, position, "lua-error", NULL, "%s", why);
}

/* What a function remembers outside memory would be lost at a reload, and run apart at a resume.
   What the source does not show of it is found when the function runs. */
static void check_upvalues(lua_State *L, int index, void *context) {
    enum { MOST_UPVALUES = 256 };
    JoxVm *vm = context;
    const char *names[MOST_UPVALUES];
    int count = 0, number = 0;
    lua_Debug about;
    lua_pushvalue(L, index);
    lua_getinfo(L, ">S", &about);
    while (count < MOST_UPVALUES && (names[count] = lua_getupvalue(L, index, count + 1)) != NULL) {
        lua_pop(L, 1);
        count++;
    }
    jox_upvalues_add(L, index, &vm->upvalues, vm->hooks[vm->hook_walked].first_upvalue);
    if (sscanf(about.short_src, "b%d", &number) != 1 || (size_t)number >= vm->source_count)
        return;
    JoxSource *source = &vm->sources[number];
    const JoxToken *t =
        jox_source_assigned(source, about.linedefined, about.lastlinedefined, names, (size_t)count);
    if (t)
        jox_diag_error(
            vm->diagnostics, ((JoxPosition){source->path, t->line, t->column, t->end_column}),
            "assigned-upvalue", "Declare it: local mine = memory { ... }, and write me.NAME",
            "a function cannot change '%.*s': what an agent remembers belongs in memory",
            (int)t->length, t->text);
}

static int build_protected(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    if (!jox_patch_apply(vm))
        return 0;
    jox_build(vm, &vm->sources[0]);
    for (uint32_t h = 0; h < vm->hook_count; h++) { /* and nothing it reaches changes any more */
        vm->hook_walked = h;
        vm->hooks[h].first_upvalue = vm->upvalues.count;
        lua_rawgeti(L, LUA_REGISTRYINDEX, vm->hooks[h].ref);
        jox_freeze(L, lua_gettop(L), check_upvalues, vm);
        vm->hooks[h].upvalue_count = vm->upvalues.count - vm->hooks[h].first_upvalue;
        lua_pop(L, 1);
    }
    return 0;
}

static JoxMachine *run(JoxVm *vm) {
    const char *why = NULL;
    int line = 0;
    lua_State *L = vm->L;
    const size_t errors = vm->diagnostics->errors;
    if (!jox_source_compile(vm, 0)) {
        int used = 0, number;
        const char *text = lua_tostring(L, -1);
        if (text && sscanf(text, "b%d:%d: %n", &number, &line, &used) == 2)
            text += used;
        report_failure(vm, text ? text : "not enough memory", line);
        return NULL;
    }
    if (!jox_vm_call(vm, 0, 1, vm->owner->limits.load_instructions, &why, &line)) {
        /* What follows an error already reported is only its echo. */
        if (vm->diagnostics->errors == errors)
            report_failure(vm, why, line);
        return NULL;
    }
    /* Building reads and pushes, which may fail for want of memory: it too runs protected. */
    lua_pushcfunction(L, build_protected);
    lua_insert(L, 1);
    if (!jox_vm_call(vm, 1, 0, vm->owner->limits.load_instructions, &why, &line) &&
        vm->diagnostics->errors == errors)
        report_failure(vm, why, line);
    lua_settop(L, 0);
    JoxMachine *machine = vm->built;
    vm->built = NULL;
    if (vm->diagnostics->errors > errors) {
        jox_machine_free(machine);
        return NULL;
    }
    return machine;
}

struct JoxLoaded {
    JoxMachine *machine; /* NULL where it failed */
    JoxVm *vm;           /* kept in either case: it knows which files were tried */
};

JoxLoaded *jox_lua_prepare(JoxLua *lua, const char *path, const char *text, size_t length,
                           const JoxScope *scope, JoxDiagnostics *diagnostics) {
    static const JoxScope OPEN = {0};
    JoxLoaded *loaded = jox_alloc(1, sizeof *loaded);
    JoxVm *vm = loaded->vm = jox_vm_create(lua);
    if (!vm) {
        jox_diag_error(diagnostics, ((JoxPosition){path, 0, 0, 0}), "lua-error", NULL,
                       "no memory for a Lua state");
        return loaded;
    }
    vm->scope = scope ? scope : &OPEN;
    vm->diagnostics = diagnostics;
    vm->loading = true;
    jox_vm_tried(vm, path);
    JoxSource *source = jox_vm_read(vm, path, text, length, (JoxPosition){0});
    JoxMachine *machine = loaded->machine = source ? run(vm) : NULL;
    for (size_t i = 0; i < vm->source_count; i++)
        jox_source_contexts(&vm->sources[i], diagnostics);
    for (size_t i = 0; i < vm->source_count; i++)
        jox_diag_attach_source(diagnostics, vm->sources[i].path, vm->sources[i].text,
                               vm->sources[i].length);
    vm->loading = false;
    vm->scope = NULL;
    vm->diagnostics = NULL;
    for (size_t s = 0; machine && s < vm->source_count; s++) /* some function may look at others */
        machine->views |= vm->hook_count && strstr(vm->sources[s].text, "neighbours");
    return loaded;
}

JoxMachine *jox_loaded_machine(const JoxLoaded *loaded) {
    return loaded->machine;
}

char *const *jox_loaded_tried(const JoxLoaded *loaded, uint32_t *count) {
    *count = loaded->vm ? loaded->vm->tried_count : 0;
    return loaded->vm ? loaded->vm->tried : NULL;
}

char *const *jox_lua_tried(const JoxLua *lua, const JoxMachine *machine, uint32_t *count) {
    const JoxVm *vm = machine->vm >= 0 ? lua->vms[machine->vm] : NULL;
    *count = vm ? vm->tried_count : 0;
    return vm ? vm->tried : NULL;
}

const JoxLuaFile *jox_loaded_files(const JoxLoaded *loaded, uint32_t *count) {
    *count = loaded->vm ? loaded->vm->file_count : 0;
    return loaded->vm ? loaded->vm->files : NULL;
}

/* Files and sources are added together. */
static const char *text_of(const JoxVm *vm, uint32_t file, size_t *length) {
    *length = vm && file < vm->source_count ? vm->sources[file].length : 0;
    return *length ? vm->sources[file].text : "";
}

const char *jox_loaded_text(const JoxLoaded *loaded, uint32_t file, size_t *length) {
    return text_of(loaded->vm, file, length);
}

const char *jox_lua_text(const JoxLua *lua, const JoxMachine *machine, uint32_t file,
                         size_t *length) {
    return text_of(machine->vm >= 0 ? lua->vms[machine->vm] : NULL, file, length);
}

const char *jox_loaded_said(const JoxLoaded *loaded) {
    return loaded->vm && loaded->vm->printed_text.data ? loaded->vm->printed_text.data : "";
}

void jox_lua_adopt(JoxLua *lua, JoxLoaded *loaded) {
    JoxVm *vm = loaded->vm;
    int32_t place = -1;
    loaded->vm = NULL;
    for (uint32_t i = 0; i < lua->vm_count && place < 0; i++)
        if (!lua->vms[i])
            place = (int32_t)i;
    if (place < 0) {
        JOX_RESERVE(lua->vms, lua->vm_capacity, lua->vm_count + 1);
        place = (int32_t)lua->vm_count++;
    }
    lua->vms[place] = vm;
    loaded->machine->vm = place;
    loaded->machine = NULL;
}

JoxLoaded *jox_lua_retire(JoxLua *lua, JoxMachine *machine) {
    JoxLoaded *loaded = jox_alloc(1, sizeof *loaded);
    loaded->machine = machine;
    loaded->vm = jox_vm_detach(lua, machine);
    return loaded;
}

void jox_loaded_free(JoxLoaded *loaded) {
    if (!loaded)
        return;
    jox_machine_free(loaded->machine);
    jox_vm_free(loaded->vm);
    jox_free(loaded);
}

JoxMachine *jox_lua_load_text(JoxLua *lua, const char *path, const char *text, size_t length,
                              const JoxScope *scope, JoxDiagnostics *diagnostics) {
    JoxLoaded *loaded = jox_lua_prepare(lua, path, text, length, scope, diagnostics);
    JoxMachine *machine = loaded->machine;
    const char *said = jox_loaded_said(loaded);
    if (*said && lua->complain)
        lua->complain(lua->complain_context, said);
    if (machine)
        jox_lua_adopt(lua, loaded);
    jox_loaded_free(loaded);
    return machine;
}

JoxMachine *jox_lua_load(JoxLua *lua, const char *path, const JoxScope *scope,
                         JoxDiagnostics *diagnostics) {
    return jox_lua_load_text(lua, path, NULL, 0, scope, diagnostics);
}
