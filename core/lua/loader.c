/* Loads behaviours: runs the file in a new Lua state, lets mods change its table, builds the
   machine, and keeps the state while the machine's functions may be called. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/loader.h"
#include "lua/read_table.h"

/* Returns the token of this text on a line at which Lua's parser stopped; NULL if none or too many
   have the text. */
static const JoxToken *find_stop(JoxScript *script, int line, const char *name) {
    enum { MOST_ALIKE = 16 };
    const JoxSource *source = script->vm.sources[script->vm.failed_source];
    const JoxToken *alike[MOST_ALIKE];
    size_t count = 0;
    for (size_t n = 0; n < source->token_count && source->tokens[n].line <= line; n++) {
        const JoxToken *t = &source->tokens[n];
        if (t->line < line || !jox_token_says(t, name))
            continue;
        if (count == MOST_ALIKE)
            return NULL;
        alike[count++] = t;
    }
    for (size_t k = 0; k + 1 < count; k++) {
        const size_t end = (size_t)(alike[k]->text - source->text) + alike[k]->length;
        if (jox_vm_stops_within(&script->vm, script->vm.failed_source, end))
            return alike[k];
    }
    return count > 0 ? alike[count - 1] : NULL;
}

/* Reports a failure of the file. Lua's parser gives the line and mostly the token "near" which it
   stopped. */
static void report_failure(JoxScript *script, const char *why, int line) {
    JoxSource *source = script->vm.sources[script->vm.failed_source];
    JoxPosition position = {source->path, line, 0, 0};
    const char *near = strstr(why, " near '"), *hint = NULL;
    char missing[112];
    if (near) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(near + 7, "'"), near + 7);
        const JoxToken *t = find_stop(script, line, name);
        if (t)
            position = (JoxPosition){source->path, line, t->column, t->end_column};
        const bool item = strncmp(why, "'}' expected", 12) == 0;
        if (item && t && (t->kind == JOX_TOKEN_NAME || *name == '{' || *name == '[')) {
            snprintf(missing, sizeof missing, "Is a comma missing before '%s'?", name);
            hint = missing;
        }
    }
    jox_diag_error(script->diagnostics, position, "lua-error", hint, "%s", why);
}

/* JoxFreezeFunction: records the upvalues of a function and refuses assignments to them, which
   would be lost at a reload and differ after a resume. Assignments that the source does not show
   are found after a call. */
static void check_upvalues(lua_State *L, int index, void *context) {
    JOX_ASSERT(lua_type(L, index) == LUA_TFUNCTION && !lua_iscfunction(L, index));
    enum { MOST_UPVALUES = 256 };
    JoxScript *script = context;
    const char *names[MOST_UPVALUES];
    int count = 0, number = 0;
    lua_Debug about;
    lua_pushvalue(L, index);
    lua_getinfo(L, ">S", &about);
    while (count < MOST_UPVALUES && (names[count] = lua_getupvalue(L, index, count + 1)) != NULL) {
        lua_pop(L, 1);
        count++;
    }
    jox_upvalues_add(L, index, &script->upvalues, script->hooks[script->hook_walked].first_upvalue);
    bool *may_assign = &script->hooks[script->hook_walked].may_assign;
    if (sscanf(about.short_src, "b%d", &number) != 1 || (size_t)number >= script->vm.source_count) {
        *may_assign = true;
        return;
    }
    JoxSource *source = script->vm.sources[number];
    *may_assign |= count > 0 && jox_outline_assigns_shared(source);
    const JoxToken *t = jox_outline_assigned(source, about.linedefined, about.lastlinedefined,
                                             names, (size_t)count);
    if (t)
        jox_diag_error(
            script->diagnostics, ((JoxPosition){source->path, t->line, t->column, t->end_column}),
            "assigned-upvalue", "Declare it: local mine = memory { ... }, and write me.NAME",
            "a function cannot change '%.*s': what an agent remembers belongs in memory",
            (int)t->length, t->text);
}

/* Builds the machine, as a protected call. */
static int build_protected(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    if (!jox_patch_behaviour(script))
        return 0;
    jox_build(script, script->vm.sources[0]);
    if (script->built)
        jox_fields_add_memory(script, script->built);
    for (uint32_t h = 0; h < script->hook_count; h++) { /* and freezes everything that they reach */
        script->hook_walked = h;
        script->hooks[h].first_upvalue = script->upvalues.count;
        lua_rawgeti(L, LUA_REGISTRYINDEX, script->hooks[h].ref);
        jox_freeze(L, lua_gettop(L), check_upvalues, script);
        script->hooks[h].upvalue_count = script->upvalues.count - script->hooks[h].first_upvalue;
        lua_pop(L, 1);
    }
    return 0;
}

/* Runs the script and builds its machine; NULL with diagnostics. */
static JoxMachine *run_script(JoxScript *script) {
    const char *why = NULL;
    int line = 0;
    lua_State *L = script->vm.L;
    const size_t errors = script->diagnostics->errors;
    if (!jox_vm_compile(&script->vm, 0)) {
        const char *text = lua_tostring(L, -1);
        if (text)
            text = jox_vm_split(&script->vm, text, &line, &script->vm.failed_source);
        report_failure(script, text ? text : "not enough memory", line);
        return NULL;
    }
    if (!jox_vm_call(&script->vm, 0, 1, script->owner->group.limits.load_instructions, &why,
                     &line)) {
        /* A failure after a reported error follows from it. */
        if (script->diagnostics->errors == errors)
            report_failure(script, why, line);
        return NULL;
    }
    /* Building reads and pushes values and may run out of memory, so it is a protected call too. */
    lua_pushcfunction(L, build_protected);
    lua_insert(L, 1);
    if (!jox_vm_call(&script->vm, 1, 0, script->owner->group.limits.load_instructions, &why,
                     &line) &&
        script->diagnostics->errors == errors)
        report_failure(script, why, line);
    lua_settop(L, 0);
    JoxMachine *machine = script->built;
    script->built = NULL;
    if (script->diagnostics->errors > errors) {
        jox_machine_free(machine);
        return NULL;
    }
    return machine;
}

/* Notes what the functions of a script may do, as far as the text of its files tells: look at
   others, ask for messages, tell them. */
static void note_what_functions_may(const JoxScript *script, JoxMachine *machine) {
    for (size_t s = 0; script->hook_count && s < script->vm.source_count; s++) {
        const char *text = script->vm.sources[s]->text;
        machine->hears_functions |= strstr(text, "told") != NULL;
        machine->tells_functions |= strstr(text, "tell") != NULL;
        machine->views |= strstr(text, "neighbours") || strstr(text, "told") ||
                          strstr(text, "holding") || strstr(text, "striker");
    }
    for (uint32_t m = 0; script->hook_count && m < machine->memory_count; m++)
        machine->views |= machine->memory[m].kind >= JOX_MEMORY_SOMEBODY;
}

struct JoxLoaded {
    JoxMachine *machine; /* NULL if the load failed */
    JoxScript *script;   /* kept after a failure too, as it lists the files that were looked for */
};

JoxLoaded *jox_lua_prepare(JoxLua *lua, const char *path, const char *text, size_t length,
                           const JoxScope *scope, JoxDiagnostics *diagnostics) {
    static const JoxScope OPEN = {0};
    JoxLoaded *loaded = jox_alloc(1, sizeof *loaded);
    JoxScript *script = loaded->script = jox_script_create(lua);
    if (!script) {
        jox_diag_error(diagnostics, ((JoxPosition){path, 0, 0, 0}), "lua-error", NULL,
                       "no memory for a Lua state");
        return loaded;
    }
    script->scope = scope ? scope : &OPEN;
    script->diagnostics = diagnostics;
    script->vm.loading = true;
    jox_vm_note_path(&script->vm, path);
    JoxSource *source = jox_script_read(script, path, text, length, (JoxPosition){0});
    JoxMachine *machine = loaded->machine = source ? run_script(script) : NULL;
    for (size_t i = 0; i < script->vm.source_count; i++)
        jox_outline_contexts(script->vm.sources[i], diagnostics);
    for (size_t i = 0; i < script->vm.source_count; i++)
        jox_diag_attach_source(diagnostics, script->vm.sources[i]->path,
                               script->vm.sources[i]->text, script->vm.sources[i]->length);
    script->vm.loading = false;
    script->scope = NULL;
    script->diagnostics = NULL;
    if (machine)
        note_what_functions_may(script, machine);
    return loaded;
}

JoxMachine *jox_loaded_machine(const JoxLoaded *loaded) {
    return loaded->machine;
}

char *const *jox_loaded_paths_tried(const JoxLoaded *loaded, uint32_t *count) {
    *count = loaded->script ? loaded->script->vm.tried_count : 0;
    return loaded->script ? loaded->script->vm.tried : NULL;
}

char *const *jox_lua_paths_tried(const JoxLua *lua, const JoxMachine *machine, uint32_t *count) {
    const JoxScript *script = jox_lua_script(lua, machine);
    *count = script ? script->vm.tried_count : 0;
    return script ? script->vm.tried : NULL;
}

const JoxLuaFile *jox_loaded_files(const JoxLoaded *loaded, uint32_t *count) {
    *count = loaded->script ? loaded->script->vm.file_count : 0;
    return loaded->script ? loaded->script->vm.files : NULL;
}

/* Returns the text of a file, which has the same index as its source. */
static const char *get_source_text(const JoxScript *script, uint32_t file, size_t *length) {
    JOX_ASSERT(!script || script->vm.source_count == script->vm.file_count);
    *length = script && file < script->vm.source_count ? script->vm.sources[file]->length : 0;
    return *length ? script->vm.sources[file]->text : "";
}

const char *jox_loaded_text(const JoxLoaded *loaded, uint32_t file, size_t *length) {
    return get_source_text(loaded->script, file, length);
}

const char *jox_lua_text(const JoxLua *lua, const JoxMachine *machine, uint32_t file,
                         size_t *length) {
    return get_source_text(jox_lua_script(lua, machine), file, length);
}

const char *jox_loaded_output(const JoxLoaded *loaded) {
    return loaded->script && loaded->script->vm.printed_text.data
               ? loaded->script->vm.printed_text.data
               : "";
}

void jox_lua_adopt(JoxLua *lua, JoxLoaded *loaded) {
    JOX_ASSERT(loaded->script && loaded->machine && loaded->machine->vm < 0);
    JoxScript *script = loaded->script;
    int32_t place = -1;
    loaded->script = NULL;
    for (uint32_t i = 0; i < lua->script_count && place < 0; i++)
        if (!lua->scripts[i])
            place = (int32_t)i;
    if (place < 0) {
        JOX_RESERVE(lua->scripts, lua->script_capacity, lua->script_count + 1);
        place = (int32_t)lua->script_count++;
    }
    lua->scripts[place] = script;
    loaded->machine->vm = place;
    loaded->machine = NULL;
}

JoxLoaded *jox_lua_retire(JoxLua *lua, JoxMachine *machine) {
    JoxLoaded *loaded = jox_alloc(1, sizeof *loaded);
    loaded->machine = machine;
    loaded->script = jox_script_detach(lua, machine);
    return loaded;
}

void jox_loaded_free(JoxLoaded *loaded) {
    if (!loaded)
        return;
    jox_machine_free(loaded->machine);
    jox_script_free(loaded->script);
    jox_free(loaded);
}

JoxMachine *jox_lua_load_text(JoxLua *lua, const char *path, const char *text, size_t length,
                              const JoxScope *scope, JoxDiagnostics *diagnostics) {
    JoxLoaded *loaded = jox_lua_prepare(lua, path, text, length, scope, diagnostics);
    JoxMachine *machine = loaded->machine;
    const char *said = jox_loaded_output(loaded);
    if (*said && lua->group.say)
        lua->group.say(lua->group.say_context, said);
    if (machine)
        jox_lua_adopt(lua, loaded);
    jox_loaded_free(loaded);
    return machine;
}

JoxMachine *jox_lua_load(JoxLua *lua, const char *path, const JoxScope *scope,
                         JoxDiagnostics *diagnostics) {
    return jox_lua_load_text(lua, path, NULL, 0, scope, diagnostics);
}

void jox_lua_release(JoxLua *lua, const JoxMachine *machine) {
    jox_script_free(jox_script_detach(lua, machine));
}

const char *jox_lua_stalled(const JoxLua *lua) {
    return lua->group.stalled[0] ? lua->group.stalled : NULL;
}

const JoxLuaFile *jox_lua_files(const JoxLua *lua, const JoxMachine *machine, uint32_t *count) {
    const JoxScript *script = jox_lua_script(lua, machine);
    *count = script ? script->vm.file_count : 0;
    return script ? script->vm.files : NULL;
}

/* Returns whether the token `signal` at `at` may begin a call that gives this signal:
   me.signal("NAME"), or with a computed name. As a key of a table the machine knows it. */
static bool may_give_signal(const JoxSource *source, size_t at, const char *name) {
    size_t next = at + 1;
    if (next < source->token_count && jox_token_is(&source->tokens[next], "="))
        return false;
    next += next < source->token_count && jox_token_is(&source->tokens[next], "(");
    const JoxToken *t = next < source->token_count ? &source->tokens[next] : NULL;
    return !t || t->kind != JOX_TOKEN_STRING || jox_token_says(t, name);
}

bool jox_lua_may_signal(const JoxLua *lua, const JoxMachine *machine, const char *name) {
    const JoxScript *script = jox_lua_script(lua, machine);
    for (size_t s = 0; script && s < script->vm.source_count; s++)
        for (size_t t = 0; t < script->vm.sources[s]->token_count; t++)
            if (jox_token_is(&script->vm.sources[s]->tokens[t], "signal") &&
                may_give_signal(script->vm.sources[s], t, name))
                return true;
    return false;
}
