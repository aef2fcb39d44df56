/* Loads claim files and calls their function `measure` on what the runs left. */
#include "validate/claims_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/format/json.h"
#include "base/mem.h"

static const uint64_t BUDGET = 200000000; /* Lua instructions of one call */
enum { MOST_BYTES = 64 << 20 };           /* greatest size of a file that measure reads */

/* ---- what the runs left ---- */

/* Sets t.a.b.c = value in the table on top of the stack, for the path "a.b.c". */
static void set_summary_number(void *context, const char *path, double value) {
    lua_State *L = context;
    int top = lua_gettop(L);
    luaL_checkstack(L, 8, "a summary");
    lua_pushvalue(L, -1);
    for (const char *dot; (dot = strchr(path, '.')) != NULL; path = dot + 1) {
        lua_pushlstring(L, path, (size_t)(dot - path));
        lua_pushvalue(L, -1);
        if (lua_rawget(L, -3) != LUA_TTABLE) {
            lua_pop(L, 1);
            lua_newtable(L);
            lua_pushvalue(L, -2);
            lua_pushvalue(L, -2);
            lua_rawset(L, -5);
        }
        lua_remove(L, -2);
        lua_remove(L, -2);
    }
    lua_pushnumber(L, value);
    lua_setfield(L, -2, path);
    lua_settop(L, top);
}

/* Reads a file that a run left, for the caller to free; an error of Lua if there is none. */
static char *read_run_file(lua_State *L, const char *folder, const char *name, size_t *length) {
    char path[1200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    char *text = jox_read_file(path, MOST_BYTES, length);
    if (!text)
        luaL_error(L, "the run left no %s", name);
    return text;
}

/* The Lua function csv(name): returns { column = { values } }, with columns named without their
   " [unit]", and the number of rows in `n`. Values that are not numbers are texts. */
static int push_csv_table(lua_State *L) {
    const char *folder = lua_tostring(L, lua_upvalueindex(1));
    char file[256];
    size_t length;
    snprintf(file, sizeof file, "%.200s.csv", luaL_checkstring(L, 1));
    if (strchr(file, '/'))
        return luaL_error(L, "csv takes the name of a probe");
    char *text = read_run_file(L, folder, file, &length), *at = text;
    int columns = 0;
    lua_newtable(L);
    int table = lua_gettop(L);
    luaL_checkstack(L, 64, "columns");
    for (bool more = *at && *at != '\n'; more && columns < 48; columns++) { /* the header */
        size_t size = strcspn(at, ",\n"), name = strcspn(at, "[,\n");
        while (name > 0 && at[name - 1] == ' ')
            name--;
        lua_newtable(L);
        lua_pushlstring(L, at, name);
        lua_pushvalue(L, -2);
        lua_rawset(L, table);
        more = at[size] == ',';
        at += size + more;
    }
    lua_Integer row = 0;
    while (*at == '\n' && at[1]) {
        row++;
        for (int c = 0; c < columns && (c == 0 || *at == ','); c++) {
            char *end = ++at; /* strtod would skip an empty value and read on in the next line */
            double value = strchr(",\n", *at) ? 0.0 : strtod(at, &end);
            const size_t size = strcspn(at, ",\n");
            if (size > 0 && end == at + size)
                lua_pushnumber(L, value);
            else if (size > 0)
                lua_pushlstring(L, at, size);
            if (size > 0)
                lua_rawseti(L, table + 1 + c, row);
            at += size;
        }
        at += strcspn(at, "\n");
    }
    jox_free(text);
    lua_pushinteger(L, row);
    lua_setfield(L, table, "n");
    lua_settop(L, table);
    return 1;
}

/* Pushes `measure` and its argument: a table { name = { summary = {...}, csv = function } } of
   all runs. */
static int push_runs(lua_State *L) {
    const JoxClaim *claim = lua_touserdata(L, 1);
    const char *const *folders = lua_touserdata(L, 2);
    lua_settop(L, 0);
    lua_rawgeti(L, LUA_REGISTRYINDEX, claim->code->measure);
    lua_newtable(L);
    for (uint32_t r = 0; r < claim->run_count; r++) {
        size_t length;
        lua_newtable(L);
        char *text = read_run_file(L, folders[r], "summary.json", &length);
        lua_newtable(L);
        bool good = jox_json_numbers(text, set_summary_number, L);
        jox_free(text);
        if (!good)
            return luaL_error(L, "the summary of run '%s' is not JSON", claim->runs[r].name);
        lua_setfield(L, -2, "summary");
        lua_pushstring(L, folders[r]);
        lua_pushcclosure(L, push_csv_table, 1);
        lua_setfield(L, -2, "csv");
        lua_setfield(L, -2, claim->runs[r].name);
    }
    return 2;
}

bool jox_claim_measure(const JoxClaim *claim, const char *const *folders, bool whole,
                       double *values, JoxText *why) {
    JoxScript *script = claim->code->script;
    lua_State *L = script->vm.L;
    const char *message = NULL;
    int line = 0;
    lua_settop(L, 0);
    lua_pushcfunction(L, push_runs);
    lua_pushlightuserdata(L, (void *)(uintptr_t)claim);
    lua_pushlightuserdata(L, (void *)(uintptr_t)folders);
    bool good = jox_vm_call(&script->vm, 2, 2, BUDGET, &message, &line) &&
                jox_vm_call(&script->vm, 1, 1, BUDGET, &message, &line);
    for (uint32_t f = 0; f < claim->figure_count; f++)
        values[f] = NAN;
    if (good && !lua_istable(L, -1)) {
        good = false;
        message = "measure returned no table";
    }
    for (uint32_t f = 0; good && f < claim->figure_count; f++) {
        lua_pushstring(L, claim->figures[f].name);
        if (lua_rawget(L, -2) == LUA_TNUMBER)
            values[f] = lua_tonumber(L, -1);
        else if (whole && !claim->figures[f].reported)
            jox_text_printf(why, "%s%s: measure returned no number '%s'", why->length ? "\n" : "",
                            claim->path, claim->figures[f].name);
        lua_pop(L, 1);
    }
    if (!good)
        jox_text_printf(why, "%s:%d: %s", claim->path, line, message);
    good = good && why->length == 0;
    lua_settop(L, 0);
    return good;
}

/* ---- the file ---- */

/* Compiles and runs a claim file, which fills in the claim. Returns false with a diagnostic. */
static bool run_claim_file(JoxClaim *claim, bool quick, JoxDiagnostics *diagnostics) {
    JoxScript *script = claim->code->script;
    const char *why = NULL;
    int line = 0;
    script->vm.untimed = true;
    script->diagnostics = diagnostics;
    if (!jox_script_read(script, claim->path, NULL, 0, (JoxPosition){0}))
        return false;
    lua_pushlightuserdata(script->vm.L, claim);
    lua_setfield(script->vm.L, LUA_REGISTRYINDEX, "jostle claim");
    lua_pushboolean(script->vm.L, quick);
    lua_setfield(script->vm.L, LUA_REGISTRYINDEX, "jostle quick");
    lua_pushcfunction(script->vm.L, jox_claim_set_words);
    bool good =
        jox_vm_call(&script->vm, 0, 0, BUDGET, &why, &line) && jox_vm_compile(&script->vm, 0);
    if (!good && !why) {
        size_t source;
        why = lua_tostring(script->vm.L, -1);
        if (why)
            why = jox_vm_split(&script->vm, why, &line, &source);
    } else if (good) {
        static const JoxScope NO_SCOPE = {0};
        script->scope = &NO_SCOPE;
        script->vm.loading = true; /* require works */
        good = jox_vm_call(&script->vm, 0, 0, BUDGET, &why, &line);
        script->vm.loading = false;
        if (good && !claim->id) {
            good = false;
            why = "the file has no claim { id = ..., ... }";
        }
    }
    script->diagnostics = NULL;
    if (!good) {
        jox_diag_error(diagnostics, ((JoxPosition){claim->path, line, 0, 0}), "bad-claim", NULL,
                       "%s", why ? why : "not enough memory");
        jox_diag_attach_source(diagnostics, claim->path, script->vm.sources[0]->text,
                               script->vm.sources[0]->length);
    }
    return good;
}

JoxClaim *jox_claim_load(const char *path, bool quick, JoxDiagnostics *diagnostics) {
    JoxClaim *claim = jox_alloc(1, sizeof *claim);
    JoxLuaLimits limits = jox_lua_default_limits();
    limits.memory = (size_t)1 << 30; /* the CSV files of long runs */
    limits.block = (size_t)256 << 20;
    claim->path = jox_strdup(path);
    claim->code = jox_alloc(1, sizeof *claim->code);
    claim->code->lua = jox_lua_create(&limits);
    claim->code->script = jox_script_create(claim->code->lua);
    if (claim->code->script && run_claim_file(claim, quick, diagnostics))
        return claim;
    jox_claim_free(claim);
    return NULL;
}

/* Returns whether the first `count` settings of a run set the path of `set` to another value than
   `base` does. */
static bool has_other_value(const JoxClaimRun *run, uint32_t count, const JoxClaimRun *base,
                            const char *set) {
    const size_t length = strcspn(set, "=") + 1;
    for (uint32_t s = 0; s < count; s++) {
        bool same = strncmp(run->sets[s], set, length) != 0;
        for (uint32_t b = 0; b < base->set_count && !same; b++)
            same = strcmp(run->sets[s], base->sets[b]) == 0;
        if (!same)
            return true;
    }
    return false;
}

/* Adds settings to a run, but not in place of those by which it differs from `base`. */
static void add_run_sets(JoxClaimRun *run, const JoxClaimRun *base, const char *const *sets,
                         size_t count) {
    const uint32_t before = run->set_count;
    run->sets = jox_realloc(run->sets, before + count, sizeof *run->sets);
    for (size_t s = 0; s < count; s++)
        if (!has_other_value(run, before, base, sets[s]))
            run->sets[run->set_count++] = jox_strdup(sets[s]);
}

void jox_claim_add_sets(JoxClaim *claim, const char *const *sets, size_t count) {
    for (uint32_t r = 0; r < claim->run_count && count > 0; r++) {
        if (claim->null_runs)
            add_run_sets(&claim->null_runs[r], &claim->runs[r], sets, count);
        add_run_sets(&claim->runs[r], &claim->runs[r], sets, count);
    }
}

void jox_claim_free(JoxClaim *claim) {
    if (!claim)
        return;
    for (uint32_t r = 0; r < claim->run_count; r++) {
        jox_free(claim->runs[r].name);
        jox_claim_free_run(&claim->runs[r]);
        if (claim->null_runs)
            jox_claim_free_run(&claim->null_runs[r]);
    }
    for (uint32_t f = 0; f < claim->figure_count; f++) {
        jox_free(claim->figures[f].name);
        jox_free(claim->figures[f].unit);
        jox_free(claim->figures[f].what);
        jox_free(claim->figures[f].expected);
    }
    for (uint32_t p = 0; p < claim->picture_count; p++) {
        jox_free(claim->pictures[p].run);
        jox_free(claim->pictures[p].file);
    }
    for (uint32_t t = 0; t < claim->tried_count; t++)
        jox_free(claim->tried[t]);
    jox_claim_free_plots(claim);
    jox_claim_free_run(&claim->spare);
    void *owned[] = {claim->null_runs, claim->null_text, claim->no_null, claim->runs,
                     claim->figures,   claim->pictures,  claim->path,    claim->id,
                     claim->also,      claim->title,     claim->level,   claim->calibrated,
                     claim->held_out,  claim->source,    claim->text,    claim->tried};
    for (size_t k = 0; k < sizeof owned / sizeof *owned; k++)
        jox_free(owned[k]);
    jox_script_free(claim->code->script);
    jox_lua_free(claim->code->lua);
    jox_free(claim->code);
    jox_free(claim);
}
