/* Claim files: reading the table, and calling measure on what the runs left. */
#include "lua/claims.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/json.h"
#include "base/mem.h"
#include "lua/internal.h"

static const uint64_t BUDGET = 200000000; /* instructions of a measure */
enum { MOST_BYTES = 64 << 20 };           /* of a file that a run left */

struct JoxClaimCode {
    JoxLua *lua;
    JoxVm *vm;
    int measure; /* registry reference */
};

/* ---- reading the table ---- */

static void unknown_key(lua_State *L, const char *what, const char *const *known, size_t count) {
    lua_pushnil(L);
    while (lua_next(L, -2)) {
        const char *key = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : NULL;
        bool fine = key == NULL;
        for (size_t k = 0; key && k < count; k++)
            fine |= strcmp(key, known[k]) == 0;
        if (!fine) {
            const char *near = jox_suggest(key, known, count);
            luaL_error(L, "%s has no '%s'%s%s%s", what, key, near ? "; did you mean '" : "",
                       near ? near : "", near ? "'?" : "");
        }
        lua_pop(L, 1);
    }
}

/* A text of the table on top; "" where it is absent and not needed. */
static char *text_of(lua_State *L, const char *what, const char *key, bool needed) {
    int type = lua_getfield(L, -1, key);
    if (type != LUA_TSTRING && (needed || type != LUA_TNIL))
        luaL_error(L, "%s needs %s = \"...\"", what, key);
    char *text = jox_strdup(type == LUA_TNIL ? "" : lua_tostring(L, -1));
    lua_pop(L, 1);
    return text;
}

static double number_of(lua_State *L, const char *what, const char *key, double otherwise) {
    int type = lua_getfield(L, -1, key);
    double value = type == LUA_TNIL ? otherwise : lua_tonumber(L, -1);
    if (type != LUA_TNIL && (type != LUA_TNUMBER || !isfinite(value)))
        luaL_error(L, "%s: %s is a number", what, key);
    lua_pop(L, 1);
    return value;
}

static bool bool_of(lua_State *L, const char *key) {
    lua_getfield(L, -1, key);
    bool value = lua_toboolean(L, -1);
    lua_pop(L, 1);
    return value;
}

static int ascending(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Keys of the table on top in ascending order. They are the table's own; their list is left below
   it on the stack, so that Lua frees it whatever happens. */
static const char **keys_of(lua_State *L, uint32_t *count) {
    uint32_t most = 0;
    *count = 0;
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1))
        most++;
    const char **keys = lua_newuserdatauv(L, (most + 1) * sizeof *keys, 0);
    lua_insert(L, -2);
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1))
        if (lua_type(L, -2) == LUA_TSTRING)
            keys[(*count)++] = lua_tostring(L, -2);
    if (*count)
        qsort(keys, *count, sizeof *keys, ascending);
    return keys;
}

static void read_sets(lua_State *L, JoxClaimRun *run) {
    int top = lua_gettop(L), type = lua_getfield(L, -1, "set");
    if (type != LUA_TTABLE && type != LUA_TNIL)
        luaL_error(L, "run '%s': set = { [\"groups.people.count\"] = 100 }", run->name);
    uint32_t count = 0;
    const char **keys = type == LUA_TTABLE ? keys_of(L, &count) : NULL;
    run->sets = jox_alloc(count + 1, sizeof *run->sets);
    for (uint32_t k = 0; k < count; k++) {
        int kind = lua_getfield(L, -1, keys[k]);
        if (kind != LUA_TBOOLEAN && kind != LUA_TNUMBER && kind != LUA_TSTRING)
            luaL_error(L, "run '%s': '%s' is set to a %s; it takes a number, a text, true or false",
                       run->name, keys[k], lua_typename(L, kind));
        JoxText text = {0};
        const char *value = kind != LUA_TBOOLEAN   ? lua_tostring(L, -1)
                            : lua_toboolean(L, -1) ? "true"
                                                   : "false";
        jox_text_printf(&text, "%s=%s", keys[k], value);
        run->sets[run->set_count++] = text.data;
        lua_pop(L, 1);
    }
    lua_settop(L, top);
}

/* The run on top of the stack; `base` gives what it leaves out (of `quick`), or is NULL. */
static void read_run(lua_State *L, const JoxClaim *claim, const JoxClaimRun *base,
                     JoxClaimRun *run) {
    static const char *const KEYS[] = {"scene", "seeds", "duration", "dt", "set", "first"};
    char what[128];
    snprintf(what, sizeof what, "run '%.80s'", run->name);
    if (!lua_istable(L, -1))
        luaL_error(L, "%s is a table", what);
    unknown_key(L, what, KEYS, sizeof KEYS / sizeof *KEYS);
    char *scene = text_of(L, what, "scene", !base);
    const char *slash = strrchr(claim->path, '/');
    JoxText path = {0};
    jox_text_printf(&path, "%.*s%s", slash && *scene != '/' ? (int)(slash - claim->path) + 1 : 0,
                    claim->path, scene);
    run->scene = *scene || !base ? path.data : jox_strdup(base->scene);
    if (run->scene != path.data)
        jox_text_free(&path);
    jox_free(scene);
    jox_path_clean(run->scene);
    run->seeds = (uint32_t)number_of(L, what, "seeds", base ? base->seeds : 3);
    run->duration = number_of(L, what, "duration", base ? base->duration : 0.0);
    run->dt = number_of(L, what, "dt", base ? base->dt : 0.0);
    run->first = bool_of(L, "first") || (base && base->first);
    if (run->seeds < 1 || run->seeds > 1000 || run->duration < 0.0 || run->dt < 0.0)
        luaL_error(L, "%s: seeds is 1 to 1000, duration and dt are not negative", what);
    read_sets(L, run);
    if (!base || run->set_count || !base->set_count)
        return;
    run->sets = jox_realloc(run->sets, base->set_count, sizeof *run->sets);
    for (uint32_t s = 0; s < base->set_count; s++)
        run->sets[run->set_count++] = jox_strdup(base->sets[s]);
}

static void free_run(JoxClaimRun *run) {
    for (uint32_t s = 0; s < run->set_count; s++)
        jox_free(run->sets[s]);
    jox_free(run->sets);
    jox_free(run->scene);
}

static void read_runs(lua_State *L, JoxClaim *claim) {
    int top = lua_gettop(L);
    if (lua_getfield(L, -1, "runs") != LUA_TTABLE)
        luaL_error(L, "a claim needs runs = { name = { scene = \"../x.yaml\" } }");
    uint32_t count;
    const char **names = keys_of(L, &count);
    if (count == 0)
        luaL_error(L, "a claim needs at least one run");
    claim->runs = jox_alloc(count, sizeof *claim->runs);
    for (uint32_t r = 0; r < count; r++) {
        claim->runs[r].name = jox_strdup(names[r]);
        claim->run_count++;
        lua_getfield(L, -1, names[r]);
        read_run(L, claim, NULL, &claim->runs[r]);
        lua_pop(L, 1);
    }
    lua_settop(L, top);
}

static JoxClaimRun *find_run(lua_State *L, const JoxClaim *claim, const char *what,
                             const char *name) {
    for (uint32_t r = 0; r < claim->run_count; r++)
        if (strcmp(claim->runs[r].name, name) == 0)
            return &claim->runs[r];
    luaL_error(L, "%s: there is no run '%s'", what, name);
    return NULL;
}

/* Of each run that it names, what it says in place of what `runs` said; false: there is nothing
   smaller that would show it. */
static void read_quick(lua_State *L, JoxClaim *claim, bool quick) {
    int top = lua_gettop(L), type = lua_getfield(L, -1, "quick");
    if (type == LUA_TBOOLEAN && !lua_toboolean(L, -1)) {
        claim->too_long = true;
        lua_settop(L, top);
        return;
    }
    if (type != LUA_TNIL && type != LUA_TTABLE)
        luaL_error(L, "quick = { name = { duration = 10, seeds = 1 } }, by the names of runs; or "
                      "false");
    uint32_t count = 0;
    const char **names = type == LUA_TTABLE ? keys_of(L, &count) : NULL;
    for (uint32_t n = 0; n < count; n++) {
        JoxClaimRun *run = find_run(L, claim, "quick", names[n]);
        claim->spare = (JoxClaimRun){.name = run->name};
        lua_getfield(L, -1, names[n]);
        read_run(L, claim, run, &claim->spare);
        lua_pop(L, 1);
        if (quick) {
            JoxClaimRun full = *run;
            *run = claim->spare;
            claim->spare = full;
        }
        free_run(&claim->spare);
        claim->spare = (JoxClaimRun){0};
    }
    lua_settop(L, top);
}

static void read_figure(lua_State *L, JoxClaimFigure *figure) {
    static const char *const KEYS[] = {"unit", "source", "band", "what", "reported"};
    if (!lua_istable(L, -1) || lua_rawgeti(L, -1, 1) != LUA_TSTRING)
        luaL_error(L, "each of expect is { \"name\", unit = ..., band = { least, greatest } }");
    figure->name = jox_strdup(lua_tostring(L, -1));
    lua_pop(L, 1);
    unknown_key(L, "a figure", KEYS, sizeof KEYS / sizeof *KEYS);
    figure->unit = text_of(L, "a figure", "unit", false);
    figure->what = text_of(L, "a figure", "what", false);
    lua_getfield(L, -1, "source");
    figure->expected = jox_strdup(lua_tostring(L, -1) ? lua_tostring(L, -1) : "");
    lua_pop(L, 1);
    figure->reported = bool_of(L, "reported");
    figure->low = -INFINITY;
    figure->high = INFINITY;
    int type = lua_getfield(L, -1, "band");
    if (type == LUA_TTABLE) {
        if (lua_rawgeti(L, -1, 1) == LUA_TNUMBER)
            figure->low = lua_tonumber(L, -1);
        if (lua_rawgeti(L, -2, 2) == LUA_TNUMBER)
            figure->high = lua_tonumber(L, -1);
        lua_pop(L, 2);
    }
    lua_pop(L, 1);
    bool open = figure->low == -INFINITY && figure->high == INFINITY;
    if (!figure->reported && (open || !(figure->low <= figure->high)))
        luaL_error(L, "'%s' needs band = { least, greatest }, or reported = true", figure->name);
}

static void read_figures(lua_State *L, JoxClaim *claim) {
    if (lua_getfield(L, -1, "expect") != LUA_TTABLE || luaL_len(L, -1) < 1)
        luaL_error(L, "a claim needs expect = { { \"figure\", band = { 1, 2 } } }");
    claim->figure_count = (uint32_t)luaL_len(L, -1);
    claim->figures = jox_alloc(claim->figure_count, sizeof *claim->figures);
    for (uint32_t f = 0; f < claim->figure_count; f++) {
        lua_rawgeti(L, -1, (lua_Integer)f + 1);
        read_figure(L, &claim->figures[f]);
        for (uint32_t other = 0; other < f; other++)
            if (strcmp(claim->figures[other].name, claim->figures[f].name) == 0)
                luaL_error(L, "'%s' is expected twice", claim->figures[f].name);
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
}

static void read_pictures(lua_State *L, JoxClaim *claim) {
    int top = lua_gettop(L), type = lua_getfield(L, -1, "pictures");
    size_t capacity = 0;
    if (type != LUA_TNIL && type != LUA_TTABLE)
        luaL_error(L, "pictures = { name = { \"paths.png\" } }, by the names of runs");
    uint32_t count = 0;
    const char **names = type == LUA_TTABLE ? keys_of(L, &count) : NULL;
    for (uint32_t n = 0; n < count; n++) {
        find_run(L, claim, "pictures", names[n]);
        if (lua_getfield(L, -1, names[n]) != LUA_TTABLE)
            luaL_error(L, "pictures of run '%s' are a list of files", names[n]);
        for (lua_Integer p = 1; lua_rawgeti(L, -1, p) != LUA_TNIL; p++) {
            const char *file = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
            if (!file || strchr(file, '/'))
                luaL_error(L, "pictures of run '%s' are names of files in its report", names[n]);
            JOX_RESERVE(claim->pictures, capacity, claim->picture_count + 1);
            claim->pictures[claim->picture_count++] =
                (JoxClaimPicture){jox_strdup(names[n]), jox_strdup(file)};
            lua_pop(L, 1);
        }
        lua_pop(L, 2);
    }
    lua_settop(L, top);
}

/* claim { ... }: reads everything and keeps measure alone. */
static int word_claim(lua_State *L) {
    static const char *const KEYS[] = {"id",    "title",   "source", "text",    "runs",
                                       "quick", "measure", "expect", "pictures"};
    lua_getfield(L, LUA_REGISTRYINDEX, "jostle claim");
    JoxClaim *claim = lua_touserdata(L, -1);
    lua_getfield(L, LUA_REGISTRYINDEX, "jostle quick");
    bool quick = lua_toboolean(L, -1);
    lua_pop(L, 2);
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_settop(L, 1);
    if (claim->id)
        return luaL_error(L, "a file has one claim");
    unknown_key(L, "a claim", KEYS, sizeof KEYS / sizeof *KEYS);
    claim->id = text_of(L, "a claim", "id", true);
    claim->title = text_of(L, "a claim", "title", true);
    claim->source = text_of(L, "a claim", "source", true);
    claim->text = text_of(L, "a claim", "text", false);
    read_runs(L, claim);
    read_quick(L, claim, quick);
    read_figures(L, claim);
    read_pictures(L, claim);
    if (lua_getfield(L, -1, "measure") != LUA_TFUNCTION)
        return luaL_error(L, "a claim needs measure = function(run) return { figure = 1 } end");
    claim->code->measure = luaL_ref(L, LUA_REGISTRYINDEX);
    lua_pushnil(L); /* nothing that is expected stays within reach of measure */
    lua_setfield(L, 1, "expect");
    lua_pushboolean(L, 1);
    return 1;
}

static int open_words(lua_State *L) {
    lua_newtable(L);
    lua_pushcfunction(L, word_claim);
    lua_setfield(L, -2, "claim");
    lua_setfield(L, LUA_REGISTRYINDEX, "jostle words");
    return 0;
}

/* ---- what the runs left ---- */

/* Sets table.a.b.c = value, for the path "a.b.c". */
static void keep_number(void *context, const char *path, double value) {
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

static char *read_beside(lua_State *L, const char *folder, const char *name, size_t *length) {
    char path[1200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    char *text = jox_read_file(path, MOST_BYTES, length);
    if (!text)
        luaL_error(L, "the run left no %s", name);
    return text;
}

/* csv(name): { column = { values } } by the names before " [unit]", and their number in `n`. */
static int word_csv(lua_State *L) {
    const char *folder = lua_tostring(L, lua_upvalueindex(1));
    char file[256];
    size_t length;
    snprintf(file, sizeof file, "%.200s.csv", luaL_checkstring(L, 1));
    if (strchr(file, '/'))
        return luaL_error(L, "csv takes the name of a probe");
    char *text = read_beside(L, folder, file, &length), *at = text;
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
            char *end = ++at; /* strtod would pass over an empty value into the next line */
            double value = strchr(",\n", *at) ? 0.0 : strtod(at, &end);
            if (end != at) {
                lua_pushnumber(L, value);
                lua_rawseti(L, table + 1 + c, row);
            }
            at += strcspn(at, ",\n");
        }
        at += strcspn(at, "\n");
    }
    jox_free(text);
    lua_pushinteger(L, row);
    lua_setfield(L, table, "n");
    lua_settop(L, table);
    return 1;
}

/* { name = { summary = {...}, csv = function } } of all runs. */
static int push_runs(lua_State *L) {
    const JoxClaim *claim = lua_touserdata(L, 1);
    const char *const *folders = lua_touserdata(L, 2);
    lua_settop(L, 0);
    lua_rawgeti(L, LUA_REGISTRYINDEX, claim->code->measure);
    lua_newtable(L);
    for (uint32_t r = 0; r < claim->run_count; r++) {
        size_t length;
        lua_newtable(L);
        char *text = read_beside(L, folders[r], "summary.json", &length);
        lua_newtable(L);
        bool good = jox_json_numbers(text, keep_number, L);
        jox_free(text);
        if (!good)
            return luaL_error(L, "the summary of run '%s' is not JSON", claim->runs[r].name);
        lua_setfield(L, -2, "summary");
        lua_pushstring(L, folders[r]);
        lua_pushcclosure(L, word_csv, 1);
        lua_setfield(L, -2, "csv");
        lua_setfield(L, -2, claim->runs[r].name);
    }
    return 2;
}

bool jox_claim_measure(const JoxClaim *claim, const char *const *folders, double *values,
                       JoxText *why) {
    JoxVm *vm = claim->code->vm;
    lua_State *L = vm->L;
    const char *message = NULL;
    int line = 0;
    lua_settop(L, 0);
    lua_pushcfunction(L, push_runs);
    lua_pushlightuserdata(L, (void *)(uintptr_t)claim);
    lua_pushlightuserdata(L, (void *)(uintptr_t)folders);
    bool good = jox_vm_call(vm, 2, 2, BUDGET, &message, &line) &&
                jox_vm_call(vm, 1, 1, BUDGET, &message, &line);
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
        else if (!claim->figures[f].reported)
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

static bool run_file(JoxClaim *claim, bool quick, JoxDiagnostics *diagnostics) {
    JoxVm *vm = claim->code->vm;
    const char *why = NULL;
    int line = 0;
    vm->untimed = true;
    vm->diagnostics = diagnostics;
    if (!jox_vm_read(vm, claim->path, NULL, 0, (JoxPosition){0}))
        return false;
    lua_pushlightuserdata(vm->L, claim);
    lua_setfield(vm->L, LUA_REGISTRYINDEX, "jostle claim");
    lua_pushboolean(vm->L, quick);
    lua_setfield(vm->L, LUA_REGISTRYINDEX, "jostle quick");
    lua_pushcfunction(vm->L, open_words);
    bool good = jox_vm_call(vm, 0, 0, BUDGET, &why, &line) && jox_source_compile(vm, 0);
    if (!good && !why) {
        int used = 0, number;
        why = lua_tostring(vm->L, -1);
        if (why && sscanf(why, "b%d:%d: %n", &number, &line, &used) == 2)
            why += used;
    } else if (good) {
        static const JoxScope NO_SCOPE = {0};
        vm->scope = &NO_SCOPE;
        vm->loading = true; /* require works */
        good = jox_vm_call(vm, 0, 0, BUDGET, &why, &line);
        vm->loading = false;
        if (good && !claim->id) {
            good = false;
            why = "the file has no claim { id = ..., ... }";
        }
    }
    vm->diagnostics = NULL;
    if (!good) {
        jox_diag_error(diagnostics, ((JoxPosition){claim->path, line, 0, 0}), "bad-claim", NULL,
                       "%s", why ? why : "not enough memory");
        jox_diag_attach_source(diagnostics, claim->path, vm->sources[0].text,
                               vm->sources[0].length);
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
    claim->code->vm = jox_vm_create(claim->code->lua);
    if (claim->code->vm && run_file(claim, quick, diagnostics))
        return claim;
    jox_claim_free(claim);
    return NULL;
}

void jox_claim_free(JoxClaim *claim) {
    if (!claim)
        return;
    for (uint32_t r = 0; r < claim->run_count; r++) {
        jox_free(claim->runs[r].name);
        free_run(&claim->runs[r]);
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
    free_run(&claim->spare);
    void *owned[] = {claim->runs, claim->figures, claim->pictures, claim->path,
                     claim->id,   claim->title,   claim->source,   claim->text};
    for (size_t k = 0; k < sizeof owned / sizeof *owned; k++)
        jox_free(owned[k]);
    jox_vm_free(claim->code->vm);
    jox_lua_free(claim->code->lua);
    jox_free(claim->code);
    jox_free(claim);
}
