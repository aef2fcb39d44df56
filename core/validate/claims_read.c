/* Reads the table of a claim file into a JoxClaim: runs, figures, pictures. claims.c runs the
   file, which calls read_claim. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/path.h"
#include "base/mem.h"
#include "base/sort.h"
#include "validate/claims_parts.h"
#include "validate/verdict.h"

enum { FIRST_SEED = 101, FEW_SEEDS = 3 }; /* default seeds of a run */

static bool read_bool_field(lua_State *L, const char *key) {
    const int type = lua_getfield(L, -1, key);
    if (type != LUA_TNIL && type != LUA_TBOOLEAN)
        luaL_error(L, "%s is true or false", key);
    bool value = lua_toboolean(L, -1);
    lua_pop(L, 1);
    return value;
}

/* Lists the keys of the table on top, which must be texts, in ascending order. The texts belong to
   the table; the list is left below it on the stack, so that Lua frees it even after an error. */
static const char **list_text_keys(lua_State *L, uint32_t *count) {
    uint32_t most = 0;
    *count = 0;
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1))
        most++;
    const char **keys = lua_newuserdatauv(L, (most + 1) * sizeof *keys, 0);
    lua_insert(L, -2);
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING)
            luaL_error(L, "settings, runs and pictures are given by name: [\"PATH\"] = VALUE");
        keys[(*count)++] = lua_tostring(L, -2);
    }
    if (*count)
        jox_sort_texts(keys, *count);
    return keys;
}

/* Adds a setting "PATH=VALUE" to a run, in place of one of the same path. They stay in order, so
   that runs with equal settings are one job, wherever the settings were given. */
static void put_set(JoxClaimRun *run, char *set) {
    const size_t length = strcspn(set, "=") + 1;
    uint32_t at = 0;
    while (at < run->set_count && strncmp(run->sets[at], set, length) < 0)
        at++;
    if (at < run->set_count && strncmp(run->sets[at], set, length) == 0) {
        jox_free(run->sets[at]);
    } else {
        memmove(run->sets + at + 1, run->sets + at, (run->set_count - at) * sizeof *run->sets);
        run->set_count++;
    }
    run->sets[at] = set;
}

/* Reads `set` of the run on top: a table of PATH = VALUE, which are put to those of `base`. */
static void read_sets(lua_State *L, const JoxClaimRun *base, JoxClaimRun *run) {
    int top = lua_gettop(L), type = lua_getfield(L, -1, "set");
    if (type != LUA_TTABLE && type != LUA_TNIL)
        luaL_error(L, "run '%s': set = { [\"groups.people.count\"] = 100 }", run->name);
    uint32_t count = 0;
    const char **keys = type == LUA_TTABLE ? list_text_keys(L, &count) : NULL;
    const uint32_t base_count = base ? base->set_count : 0;
    run->sets = jox_alloc(base_count + count + 1, sizeof *run->sets);
    for (uint32_t s = 0; s < base_count; s++)
        put_set(run, jox_strdup(base->sets[s]));
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
        put_set(run, text.data);
        lua_pop(L, 1);
    }
    lua_settop(L, top);
}

/* Reads `seeds` of the table on top: a range "101-110", or a number of seeds from FIRST_SEED on. */
static void read_seeds(lua_State *L, const char *what, const JoxClaimRun *base, JoxClaimRun *run) {
    int type = lua_getfield(L, -1, "seeds");
    double number = lua_tonumber(L, -1);
    run->first_seed = base ? base->first_seed : FIRST_SEED;
    run->seeds = base ? base->seeds : FEW_SEEDS;
    if (type == LUA_TNUMBER && number >= 1 && number <= 1000 && number == floor(number))
        run->seeds = (uint32_t)number;
    else if (type != LUA_TNIL &&
             (type != LUA_TSTRING ||
              !jox_seeds_read(lua_tostring(L, -1), &run->first_seed, &run->seeds)))
        luaL_error(L, "%s: seeds = \"101-110\", or 1 to 1000: so many from 101 on", what);
    lua_pop(L, 1);
}

/* Reads the run on top of the stack. For a run of `quick` or `null`, `base` supplies what it
   leaves out, and settings of other paths; else NULL. */
static void read_run(lua_State *L, const JoxClaim *claim, const JoxClaimRun *base,
                     JoxClaimRun *run) {
    static const char *const KEYS[] = {"scene", "seeds", "duration", "dt", "set", "first"};
    char what[128];
    snprintf(what, sizeof what, "run '%.80s'", run->name);
    if (!lua_istable(L, -1))
        luaL_error(L, "%s is a table", what);
    jox_claim_check_keys(L, what, KEYS, sizeof KEYS / sizeof *KEYS);
    char *scene = jox_claim_read_text(L, what, "scene", !base);
    char path[JOX_LONGEST_PATH];
    if (!jox_path_beside(claim->path, scene, path))
        luaL_error(L, "the path of the scene of %s is too long", what);
    run->scene = jox_strdup(*scene || !base ? path : base->scene);
    jox_free(scene);
    jox_path_clean(run->scene);
    read_seeds(L, what, base, run);
    run->duration = jox_claim_read_number(L, what, "duration", base ? base->duration : 0.0);
    run->dt = jox_claim_read_number(L, what, "dt", base ? base->dt : 0.0);
    run->first = read_bool_field(L, "first") || (base && base->first);
    if (run->duration < 0.0 || run->dt < 0.0)
        luaL_error(L, "%s: duration and dt are not negative", what);
    read_sets(L, base, run);
}

void jox_claim_free_run(JoxClaimRun *run) {
    for (uint32_t s = 0; s < run->set_count; s++)
        jox_free(run->sets[s]);
    jox_free(run->sets);
    jox_free(run->scene);
}

static void read_claim_runs(lua_State *L, JoxClaim *claim) {
    int top = lua_gettop(L);
    if (lua_getfield(L, -1, "runs") != LUA_TTABLE)
        luaL_error(L, "a claim needs runs = { name = { scene = \"../x.yaml\" } }");
    uint32_t count;
    const char **names = list_text_keys(L, &count);
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

/* Returns the run of a name, or fails with an error that names `what`. */
static JoxClaimRun *find_run(lua_State *L, const JoxClaim *claim, const char *what,
                             const char *name) {
    for (uint32_t r = 0; r < claim->run_count; r++)
        if (strcmp(claim->runs[r].name, name) == 0)
            return &claim->runs[r];
    luaL_error(L, "%s: there is no run '%s'", what, name);
    return NULL;
}

/* Returns whether a run is among the names. */
static bool is_named(const JoxClaimRun *run, const char *const *names, uint32_t count) {
    for (uint32_t n = 0; n < count; n++)
        if (strcmp(run->name, names[n]) == 0)
            return true;
    return false;
}

/* Reads `quick`: smaller settings per run, which with `quick` replace the full ones; runs then have
   one seed unless it gives them more. False means that no smaller run would show the result. */
static void read_quick(lua_State *L, JoxClaim *claim, bool quick) {
    int top = lua_gettop(L), type = lua_getfield(L, -1, "quick");
    claim->too_long = type == LUA_TBOOLEAN && !lua_toboolean(L, -1);
    if (!claim->too_long && type != LUA_TNIL && type != LUA_TTABLE)
        luaL_error(L, "quick = { name = { duration = 10, seeds = 1 } }, by the names of runs; or "
                      "false");
    uint32_t count = 0;
    const char **names = type == LUA_TTABLE ? list_text_keys(L, &count) : NULL;
    for (uint32_t n = 0; n < count; n++) {
        JoxClaimRun *run = find_run(L, claim, "quick", names[n]), base = *run;
        base.seeds = 1; /* unless it says more */
        claim->spare = (JoxClaimRun){.name = run->name};
        lua_getfield(L, -1, names[n]);
        read_run(L, claim, &base, &claim->spare);
        lua_pop(L, 1);
        if (quick) {
            JoxClaimRun full = *run;
            *run = claim->spare;
            claim->spare = full;
        }
        jox_claim_free_run(&claim->spare);
        claim->spare = (JoxClaimRun){0};
    }
    for (uint32_t r = 0; quick && r < claim->run_count; r++) {
        JoxClaimRun *run = &claim->runs[r];
        const bool named = is_named(run, names, count);
        claim->cut |= named || run->seeds > 1;
        if (!named)
            run->seeds = 1;
    }
    lua_settop(L, top);
}

/* Reads the null's version of a run: with what `runs` of the table `null` on top says of it, else
   with the table's own `set`. */
static void read_null_run(lua_State *L, const JoxClaim *claim, const JoxClaimRun *run,
                          JoxClaimRun *null) {
    int top = lua_gettop(L);
    null->name = run->name;
    if (lua_getfield(L, top, "runs") != LUA_TTABLE ||
        lua_getfield(L, -1, run->name) != LUA_TTABLE) {
        lua_newtable(L);
        lua_getfield(L, top, "set");
        lua_setfield(L, -2, "set");
    }
    read_run(L, claim, run, null);
    lua_settop(L, top);
}

/* Checks that the table `null` on top has either `set` or `runs`, and that `runs` has tables by
   names of the claim's runs. */
static void check_null(lua_State *L, const JoxClaim *claim) {
    int top = lua_gettop(L);
    uint32_t count = 0;
    const bool sets = lua_getfield(L, top, "set") != LUA_TNIL;
    const int type = lua_getfield(L, top, "runs");
    if (sets && type != LUA_TNIL)
        luaL_error(L, "null has either set, which holds for all runs, or runs, not both");
    if (type != LUA_TNIL && type != LUA_TTABLE)
        luaL_error(L, "null: runs = { name = { set = { ... } } }, by the names of runs");
    const char **names = type == LUA_TTABLE ? list_text_keys(L, &count) : NULL;
    for (uint32_t n = 0; n < count; n++) {
        find_run(L, claim, "null", names[n]);
        if (lua_getfield(L, -1, names[n]) != LUA_TTABLE)
            luaL_error(L, "null: run '%s' is a table", names[n]);
        lua_pop(L, 1);
    }
    lua_settop(L, top);
}

/* Reads `null`: what each run is without the cause of the result; or `no_null`: why there is none.
 */
static void read_null(lua_State *L, JoxClaim *claim, bool quick) {
    static const char *const KEYS[] = {"text", "set", "runs", "seeds"};
    claim->no_null = jox_claim_read_text(L, "a claim", "no_null", false);
    int top = lua_gettop(L), type = lua_getfield(L, -1, "null");
    if (type != LUA_TNIL && *claim->no_null)
        luaL_error(L, "a claim has a null, or no_null = \"why there is none\", not both");
    if (type == LUA_TNIL) {
        lua_settop(L, top);
        return;
    }
    if (type != LUA_TTABLE)
        luaL_error(L, "null = { text = \"forces off\", set = { [\"forces.enabled\"] = false } }");
    jox_claim_check_keys(L, "null", KEYS, sizeof KEYS / sizeof *KEYS);
    claim->null_text = jox_claim_read_text(L, "null", "text", true);
    const double seeds = jox_claim_read_number(L, "null", "seeds", FEW_SEEDS);
    claim->null_runs = jox_alloc(claim->run_count, sizeof *claim->null_runs);
    if (seeds < 1.0 || seeds != floor(seeds))
        luaL_error(L, "null: seeds is a whole number from 1 on");
    check_null(L, claim);
    for (uint32_t r = 0; r < claim->run_count; r++) {
        JoxClaimRun *null = &claim->null_runs[r];
        read_null_run(L, claim, &claim->runs[r], null);
        if (quick || null->seeds > seeds)
            null->seeds = quick ? 1 : (uint32_t)seeds;
    }
    lua_settop(L, top);
}

/* Reads an element of `expect` on top of the stack. */
static void read_figure(lua_State *L, JoxClaimFigure *figure) {
    static const char *const KEYS[] = {"unit", "source", "band", "what", "reported", "sure"};
    if (!lua_istable(L, -1) || lua_rawgeti(L, -1, 1) != LUA_TSTRING)
        luaL_error(L, "each of expect is { \"name\", unit = ..., band = { least, greatest } }");
    figure->name = jox_strdup(lua_tostring(L, -1));
    lua_pop(L, 1);
    jox_claim_check_keys(L, "a figure", KEYS, sizeof KEYS / sizeof *KEYS);
    figure->unit = jox_claim_read_text(L, "a figure", "unit", false);
    figure->what = jox_claim_read_text(L, "a figure", "what", false);
    lua_getfield(L, -1, "source");
    figure->expected = jox_strdup(lua_tostring(L, -1) ? lua_tostring(L, -1) : "");
    lua_pop(L, 1);
    figure->reported = read_bool_field(L, "reported");
    figure->sure = read_bool_field(L, "sure");
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

static void read_claim_figures(lua_State *L, JoxClaim *claim) {
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

/* Reads `pictures`: per run, a list of file names in its report. */
static void read_pictures(lua_State *L, JoxClaim *claim) {
    int top = lua_gettop(L), type = lua_getfield(L, -1, "pictures");
    size_t capacity = 0;
    if (type != LUA_TNIL && type != LUA_TTABLE)
        luaL_error(L, "pictures = { name = { \"paths.png\" } }, by the names of runs");
    uint32_t count = 0;
    const char **names = type == LUA_TTABLE ? list_text_keys(L, &count) : NULL;
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

static void read_tried(lua_State *L, JoxClaim *claim) {
    int type = lua_getfield(L, -1, "tried");
    if (type != LUA_TNIL && type != LUA_TTABLE)
        luaL_error(L, "tried = { \"what was tried, and what came of it\", ... }");
    lua_Integer count = type == LUA_TTABLE ? luaL_len(L, -1) : 0;
    claim->tried = jox_alloc((size_t)count + 1, sizeof *claim->tried);
    for (lua_Integer t = 1; t <= count; t++) {
        if (lua_rawgeti(L, -1, t) != LUA_TSTRING)
            luaL_error(L, "each of tried is a text");
        claim->tried[claim->tried_count++] = jox_strdup(lua_tostring(L, -1));
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
}

/* Reads the haste of the claim's people, and which data its constants were chosen with. */
static void read_level_and_calibration(lua_State *L, JoxClaim *claim) {
    static const char *const LEVELS[] = {"", "calm", "normal", "keen"};
    bool known = false;
    claim->level = jox_claim_read_text(L, "a claim", "level", false);
    claim->calibrated = jox_claim_read_text(L, "a claim", "calibrated", false);
    claim->held_out = jox_claim_read_text(L, "a claim", "held_out", false);
    for (size_t l = 0; l < sizeof LEVELS / sizeof *LEVELS; l++)
        known |= strcmp(claim->level, LEVELS[l]) == 0;
    if (!known)
        luaL_error(L, "level is calm, normal or keen, not '%s'", claim->level);
    if (*claim->calibrated && *claim->held_out)
        luaL_error(L, "a claim is calibrated, or held_out, not both");
}

/* The Lua function claim { ... }: reads the table and keeps only the function `measure`. */
static int read_claim(lua_State *L) {
    static const char *const KEYS[] = {
        "id",    "also", "title",   "source",  "text",   "level", "calibrated", "held_out", "runs",
        "quick", "null", "no_null", "measure", "expect", "plots", "pictures",   "tried"};
    lua_getfield(L, LUA_REGISTRYINDEX, "jostle claim");
    JoxClaim *claim = lua_touserdata(L, -1);
    lua_getfield(L, LUA_REGISTRYINDEX, "jostle quick");
    bool quick = lua_toboolean(L, -1);
    lua_pop(L, 2);
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_settop(L, 1);
    if (claim->id)
        return luaL_error(L, "a file has one claim");
    jox_claim_check_keys(L, "a claim", KEYS, sizeof KEYS / sizeof *KEYS);
    claim->id = jox_claim_read_text(L, "a claim", "id", true);
    claim->also = jox_claim_read_text(L, "a claim", "also", false);
    claim->title = jox_claim_read_text(L, "a claim", "title", true);
    claim->source = jox_claim_read_text(L, "a claim", "source", true);
    claim->text = jox_claim_read_text(L, "a claim", "text", false);
    read_level_and_calibration(L, claim);
    read_claim_runs(L, claim);
    read_quick(L, claim, quick);
    read_null(L, claim, quick);
    read_claim_figures(L, claim);
    jox_claim_read_plots(L, claim);
    read_pictures(L, claim);
    read_tried(L, claim);
    if (lua_getfield(L, -1, "measure") != LUA_TFUNCTION)
        return luaL_error(L, "a claim needs measure = function(run) return { figure = 1 } end");
    claim->code->measure = luaL_ref(L, LUA_REGISTRYINDEX);
    lua_pushnil(L); /* hides the expected values from measure */
    lua_setfield(L, 1, "expect");
    lua_pushboolean(L, 1);
    return 1;
}

int jox_claim_set_words(lua_State *L) {
    lua_newtable(L);
    lua_pushcfunction(L, read_claim);
    lua_setfield(L, -2, "claim");
    jox_script_set_words(L);
    return 0;
}
