/* Lua states: the cap on memory, the budget of instructions, the one protected call. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "lua/internal.h"

enum { CHECK_EVERY = 1000 };

JoxLuaLimits jox_lua_default_limits(void) {
    return (JoxLuaLimits){20000000, 100000, 32u << 20, 2u << 20, 256u << 10};
}

static void count_hook(lua_State *L, lua_Debug *debug);

static void *allocate(void *context, void *memory, size_t old, size_t size) {
    JoxVm *vm = context;
    if (!memory)
        old = 0; /* Lua then passes a type here */
    if (size == 0) {
        vm->used -= old;
        free(memory);
        return NULL;
    }
    const JoxLuaLimits *limits = &vm->owner->limits;
    if (size > old && (size > limits->block || vm->used - old + size > limits->memory)) {
        vm->out_of_memory = true;
        return NULL;
    }
    void *result = realloc(memory, size);
    if (result)
        vm->used += size - old;
    if (size > old) { /* bytes cost too: a few instructions can copy megabytes */
        uint64_t cost = (size - old) >> 2;
        vm->left = vm->left > cost ? vm->left - cost : 0;
        if (vm->left == 0 && vm->running) /* do not wait for the next thousand instructions */
            lua_sethook(vm->L, count_hook, LUA_MASKCOUNT, 1);
    }
    return result;
}

/* Counts instructions. Once over, every instruction trips, so that nothing can swallow it. */
static void count_hook(lua_State *L, lua_Debug *debug) {
    JoxVm *vm = jox_vm_of(L);
    if (!vm->over && vm->left > CHECK_EVERY) {
        vm->left -= CHECK_EVERY;
        return;
    }
    if (!vm->over) {
        vm->over = true;
        lua_sethook(L, count_hook, LUA_MASKCOUNT, 1);
    }
    lua_getinfo(L, "Sl", debug);
    lua_pushfstring(L,
                    "%s:%d: it ran for too long (over its budget of instructions) and was stopped",
                    debug->short_src, debug->currentline);
    lua_error(L);
}

JoxVm *jox_vm_of(lua_State *L) {
    return *(JoxVm **)lua_getextraspace(L);
}

static int open_all(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    jox_nodes_open(vm);
    jox_words_open(vm);
    jox_me_open(vm);
    jox_sandbox_open(vm);
    return 0;
}

JoxVm *jox_vm_create(JoxLua *lua) {
    JoxVm *vm = jox_alloc(1, sizeof *vm);
    vm->owner = lua;
    vm->L = lua_newstate(allocate, vm);
    if (!vm->L) {
        jox_free(vm);
        return NULL;
    }
    *(JoxVm **)lua_getextraspace(vm->L) = vm;
    lua_pushcfunction(vm->L, open_all);
    if (lua_pcall(vm->L, 0, 0, 0) != LUA_OK) {
        jox_vm_free(vm);
        return NULL;
    }
    return vm;
}

void jox_vm_free(JoxVm *vm) {
    if (!vm)
        return;
    lua_close(vm->L);
    for (size_t i = 0; i < vm->node_count; i++)
        jox_free(vm->nodes[i]);
    for (size_t i = 0; i < vm->name_count; i++)
        jox_free(vm->names[i]);
    for (size_t i = 0; i < vm->source_count; i++)
        jox_source_free(&vm->sources[i]);
    for (uint32_t i = 0; i < vm->file_count; i++)
        jox_free(vm->files[i].path);
    for (uint32_t i = 0; i < vm->memory_count; i++)
        jox_free(vm->memory[i].name);
    for (size_t o = 0; o < vm->origin_count; o++) {
        jox_free(vm->origins[o].path);
        jox_free(vm->origins[o].from);
    }
    jox_free(vm->origins);
    jox_free(vm->nodes);
    jox_free(vm->names);
    jox_free(vm->sources);
    jox_free(vm->files);
    jox_free(vm->memory);
    for (uint32_t h = 0; h < vm->hook_count; h++) {
        jox_free(vm->hooks[h].where);
        jox_free(vm->hooks[h].complaint);
    }
    jox_free(vm->hooks);
    jox_free(vm);
}

const char *jox_vm_intern(JoxVm *vm, const char *name) {
    for (size_t i = 0; i < vm->name_count; i++)
        if (strcmp(vm->names[i], name) == 0)
            return vm->names[i];
    JOX_RESERVE(vm->names, vm->name_capacity, vm->name_count + 1);
    return vm->names[vm->name_count++] = jox_strdup(name);
}

/* Splits "b12:34: message" into line and message; the number is that of the source. */
static const char *split_message(JoxVm *vm, const char *message, int *line) {
    int source, used = 0;
    *line = 0;
    vm->failed_source = 0;
    if (sscanf(message, "b%d:%d: %n", &source, line, &used) == 2 && used > 0) {
        vm->failed_source = source > 0 && (size_t)source < vm->source_count ? (size_t)source : 0;
        return message + used;
    }
    *line = 0;
    return message;
}

/* Where a failure came from, in the behaviour's own files: the innermost first. */
static int keep_traceback(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    size_t used = 0;
    int shown = 0;
    vm->traceback[0] = 0;
    lua_Debug debug;
    for (int level = 1; shown < 10 && lua_getstack(L, level, &debug); level++) {
        int number;
        lua_getinfo(L, "Sln", &debug);
        if (debug.currentline < 1 || sscanf(debug.short_src, "b%d", &number) != 1 ||
            (size_t)number >= vm->source_count)
            continue;
        used += (size_t)snprintf(vm->traceback + used, sizeof vm->traceback - used,
                                 "   at %.200s:%d%s%.40s%s\n", vm->sources[number].path,
                                 debug.currentline, debug.name ? " in '" : "",
                                 debug.name ? debug.name : "", debug.name ? "'" : "");
        shown++;
        if (used >= sizeof vm->traceback)
            break;
    }
    if (shown < 2) /* the message names the only place */
        vm->traceback[0] = 0;
    return 1;
}

bool jox_vm_call(JoxVm *vm, int arguments, int results, uint64_t instructions, const char **why,
                 int *line) {
    vm->left = instructions;
    vm->over = vm->out_of_memory = false;
    vm->failed_source = 0;
    lua_sethook(vm->L, count_hook, LUA_MASKCOUNT, CHECK_EVERY);
    int handler = lua_gettop(vm->L) - arguments;
    lua_pushcfunction(vm->L, keep_traceback);
    lua_insert(vm->L, handler);
    vm->running = true;
    int status = lua_pcall(vm->L, arguments, results, handler);
    vm->running = false;
    lua_sethook(vm->L, NULL, 0, 0);
    if (status == LUA_OK) {
        lua_remove(vm->L, handler);
        return true;
    }
    static _Thread_local char text[512];
    *line = 0;
    *why = text;
    /* A foreign error object is never asked for its text: that would run foreign code. */
    if (status == LUA_ERRMEM || vm->out_of_memory)
        snprintf(text, sizeof text, "it asked for too much memory and was stopped");
    else if (lua_type(vm->L, -1) == LUA_TSTRING)
        snprintf(text, sizeof text, "%s", split_message(vm, lua_tostring(vm->L, -1), line));
    else
        snprintf(text, sizeof text, "it raised an error that is a %s, not a text",
                 lua_typename(vm->L, lua_type(vm->L, -1)));
    lua_settop(vm->L, 0);
    return false;
}

JoxLua *jox_lua_create(const JoxLuaLimits *limits) {
    JoxLua *lua = jox_alloc(1, sizeof *lua);
    lua->limits = limits ? *limits : jox_lua_default_limits();
    return lua;
}

void jox_lua_free(JoxLua *lua) {
    if (!lua)
        return;
    for (uint32_t i = 0; i < lua->vm_count; i++)
        jox_vm_free(lua->vms[i]);
    jox_free(lua->vms);
    jox_free(lua->before_state);
    jox_free(lua->before_memory);
    jox_free(lua->writes);
    jox_free(lua);
}

void jox_lua_release(JoxLua *lua, const JoxMachine *machine) {
    if (!machine || machine->vm < 0 || (uint32_t)machine->vm >= lua->vm_count)
        return;
    jox_vm_free(lua->vms[machine->vm]);
    lua->vms[machine->vm] = NULL;
}

const JoxLuaFile *jox_lua_files(const JoxLua *lua, const JoxMachine *machine, uint32_t *count) {
    *count = 0;
    if (machine->vm < 0 || !lua->vms[machine->vm])
        return NULL;
    *count = lua->vms[machine->vm]->file_count;
    return lua->vms[machine->vm]->files;
}
