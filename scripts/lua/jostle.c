/* require "jostle": scenes that are loaded, stepped and read by a program in Lua 5.4, as a tool or
   a test does. It is another Lua than that of the behaviours, which run in one of their own.

   A scene is a userdata. What goes wrong is a Lua error, whose text has file and line where they
   are known. */
#include <lauxlib.h>
#include <lua.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figures.h"
#include "jostle.h"

static const char TYPE[] = "jostle.scene";
enum { MOST_SETS = 256, MOST_SAID = 1 << 16 };

typedef struct Scene {
    JoScene *scene; /* NULL: closed */
    char *said;     /* what the library said since it was last asked, MOST_SAID bytes at most */
    size_t said_length;
    bool recorded; /* or was */
} Scene;
/* Its user value is the function that texts for people are given to, or nil: not in the registry,
   from which one that knows the scene would never be collected. */

/* ---- messages and errors ---- */

/* The library may say something within a call, where no Lua error may pass: it is kept. */
static void hear(void *context, const char *text) {
    Scene *s = context;
    const size_t length = strlen(text);
    if (s->said_length + length + 1 > MOST_SAID)
        return;
    char *said = realloc(s->said, s->said_length + length + 1);
    if (!said)
        return;
    memcpy(said + s->said_length, text, length + 1);
    s->said = said;
    s->said_length += length;
}

/* Gives what was said by the scene at `at` of the stack to `message`, which may do anything with
   the scene, or to stderr. */
static void tell(lua_State *L, Scene *s, int at) {
    if (!s->said_length)
        return;
    if (lua_getiuservalue(L, at, 1) != LUA_TFUNCTION) {
        lua_pop(L, 1);
        fputs(s->said, stderr);
        s->said_length = 0;
        return;
    }
    lua_pushlstring(L, s->said, s->said_length);
    s->said_length = 0;
    lua_call(L, 1, 0);
}

static int fail(lua_State *L, const JoError *error) {
    const char *text = *error->text ? error->text : "it failed";
    if (*error->file && error->line)
        return luaL_error(L, "%s:%d:%d: %s", error->file, error->line, error->column, text);
    return *error->file ? luaL_error(L, "%s: %s", error->file, text) : luaL_error(L, "%s", text);
}

/* An argument that is a text for C, which would end at a zero byte. */
static const char *text_at(lua_State *L, int at) {
    size_t length;
    const char *text = luaL_checklstring(L, at, &length);
    if (strlen(text) != length)
        luaL_error(L, "a text with a zero byte names nothing: '%s...'", text);
    return text;
}

static Scene *scene_at(lua_State *L) {
    Scene *s = luaL_checkudata(L, 1, TYPE);
    luaL_argcheck(L, s->scene, 1, "the scene is closed");
    return s;
}

static JoWorld *world_at(lua_State *L) {
    return jo_scene_world(scene_at(L)->scene);
}

static int done(lua_State *L, Scene *s, bool good, const JoError *error) {
    tell(L, s, 1);
    if (!good)
        return fail(L, error);
    lua_settop(L, 1); /* the scene, for the next call */
    return 1;
}

/* ---- loading ---- */

static int compare_texts(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* "PATH=VALUE" of the table at the top, in the order of the paths, kept on the stack by `keep`. */
static size_t read_sets(lua_State *L, int keep, const char *sets[MOST_SETS]) {
    size_t count = 0;
    lua_pushnil(L);
    while (lua_next(L, -2)) {
        if (lua_type(L, -2) != LUA_TSTRING)
            luaL_error(L, "set maps paths to values: set = {[\"groups.people.count\"] = 50}");
        if (count == MOST_SETS)
            luaL_error(L, "at most %d values can be set", MOST_SETS);
        luaL_tolstring(L, -1, NULL);
        const char *path = text_at(L, -3), *value = text_at(L, -1);
        sets[count] = lua_pushfstring(L, "%s=%s", path, value);
        lua_rawseti(L, keep, (lua_Integer)++count);
        lua_pop(L, 2); /* the text of the value, and it */
    }
    qsort(sets, count, sizeof *sets, compare_texts);
    return count;
}

static size_t read_list(lua_State *L, const char *items[MOST_SETS]) {
    const size_t count = lua_rawlen(L, -1);
    if (count > MOST_SETS)
        luaL_error(L, "at most %d mods can be named", MOST_SETS);
    for (size_t i = 0; i < count; i++) {
        lua_rawgeti(L, -1, (lua_Integer)i + 1);
        if (lua_type(L, -1) != LUA_TSTRING)
            luaL_error(L, "mods is a list of names or folders");
        items[i] = text_at(L, -1); /* the list keeps it */
        lua_pop(L, 1);
    }
    return count;
}

/* Pushes an option, and whether it is there and of that type. */
static bool option(lua_State *L, const char *name, int type) {
    const int found = lua_getfield(L, 2, name);
    if (found != LUA_TNIL && found != type)
        luaL_error(L, "%s must be a %s, not a %s", name, lua_typename(L, type),
                   lua_typename(L, found));
    return found == type;
}

static void refuse_others(lua_State *L) {
    static const char *const NAMES[] = {"seed", "step", "threads", "isa", "set", "mods", "message"};
    lua_pushnil(L);
    while (lua_next(L, 2)) {
        bool known = false;
        for (size_t n = 0; n < sizeof NAMES / sizeof *NAMES; n++)
            known |= lua_type(L, -2) == LUA_TSTRING && strcmp(lua_tostring(L, -2), NAMES[n]) == 0;
        if (!known)
            luaL_error(L, "no option '%s'; there are seed, step, threads, isa, set, mods, message",
                       luaL_tolstring(L, -2, NULL));
        lua_pop(L, 1);
    }
}

/* An option that is a whole number, at the top of the stack. */
static lua_Integer whole(lua_State *L, const char *name) {
    int good = 0;
    const lua_Integer number = lua_tointegerx(L, -1, &good);
    if (!good)
        luaL_error(L, "%s must be a whole number", name);
    return number;
}

/* jostle.scene(PATH [, {seed = 1, step = 0.05, threads = 1, isa = "avx2", mods = {...},
   set = {["groups.people.count"] = 50}, message = function(text) end}]) */
static int load(lua_State *L) {
    JoSceneDef def = jo_default_scene_def();
    JoError error = {0};
    const char *sets[MOST_SETS], *mods[MOST_SETS];
    def.path = text_at(L, 1);
    lua_settop(L, 2);
    if (lua_isnil(L, 2)) {
        lua_newtable(L);
        lua_replace(L, 2);
    }
    luaL_checktype(L, 2, LUA_TTABLE);
    refuse_others(L);
    lua_newtable(L); /* 3: keeps the texts of sets */
    if ((def.has_seed = option(L, "seed", LUA_TNUMBER))) {
        const lua_Integer seed = whole(L, "seed");
        luaL_argcheck(L, seed >= 0, 2, "a seed is 0 or more");
        def.seed = (uint64_t)seed;
    }
    if ((def.has_dt = option(L, "step", LUA_TNUMBER)))
        def.dt = lua_tonumber(L, -1);
    if (option(L, "threads", LUA_TNUMBER)) {
        const lua_Integer threads = whole(L, "threads");
        luaL_argcheck(L, threads >= 1 && threads <= 64, 2, "threads are 1 to 64");
        def.threads = (uint32_t)threads;
    }
    if (option(L, "isa", LUA_TSTRING) && !jo_isa_find(lua_tostring(L, -1), &def.isa, &error))
        return fail(L, &error);
    def.overrides = sets;
    if (option(L, "set", LUA_TTABLE))
        def.override_count = read_sets(L, 3, sets);
    def.mods = mods;
    if (option(L, "mods", LUA_TTABLE))
        def.mod_count = read_list(L, mods);
    Scene *s = lua_newuserdatauv(L, sizeof *s, 1);
    *s = (Scene){0};
    luaL_setmetatable(L, TYPE);
    option(L, "message", LUA_TFUNCTION);
    lua_setiuservalue(L, -2, 1);
    def.message = hear;
    def.message_context = s;
    s->scene = jo_scene_load(&def, &error);
    if (!s->scene && s->said_length) { /* all that is wrong, with lines of source */
        while (s->said_length && s->said[s->said_length - 1] == '\n')
            s->said_length--;
        lua_pushlstring(L, s->said, s->said_length);
        return lua_error(L);
    }
    if (!s->scene)
        return fail(L, &error);
    tell(L, s, lua_gettop(L));
    return 1;
}

static void release(Scene *s) {
    JoScene *scene = s->scene;
    s->scene = NULL;
    jo_scene_free(scene);
    free(s->said);
    *s = (Scene){0};
}

/* scene:close() ends its recording, too, and says what went wrong with that. */
static int close(lua_State *L) {
    Scene *s = luaL_checkudata(L, 1, TYPE);
    JoError error = {0};
    const bool good = !s->scene || jo_scene_finish(s->scene, &error);
    tell(L, s, 1);
    release(s);
    return good ? 0 : fail(L, &error);
}

static int collect(lua_State *L) {
    release(luaL_checkudata(L, 1, TYPE));
    return 0;
}

static int describe(lua_State *L) {
    const Scene *s = luaL_checkudata(L, 1, TYPE);
    if (!s->scene)
        lua_pushliteral(L, "jostle.scene (closed)");
    else
        lua_pushfstring(L, "jostle.scene (%f s, %d agents)",
                        jo_world_time(jo_scene_world(s->scene)),
                        (int)jo_world_agent_count(jo_scene_world(s->scene)));
    return 1;
}

/* ---- stepping ---- */

static int advance(lua_State *L, Scene *s, uint64_t steps) {
    JoError error = {0};
    bool good = true;
    for (uint64_t k = 0; k < steps && good; k++) {
        good = jo_scene_step(s->scene, &error);
        tell(L, s, 1);
        luaL_argcheck(L, s->scene, 1, "the scene was closed while it was stepped");
        const char *failure = jo_world_failure(jo_scene_world(s->scene));
        if (good && failure)
            return luaL_error(L, "%s", failure);
    }
    return done(L, s, good, &error);
}

static int step(lua_State *L) {
    const lua_Integer steps = luaL_optinteger(L, 2, 1);
    luaL_argcheck(L, steps >= 0, 2, "steps are 0 or more");
    return advance(L, scene_at(L), (uint64_t)steps);
}

/* scene:run([SECONDS]): for so long, or to the end that the scene gives. */
static int run(lua_State *L) {
    Scene *s = scene_at(L);
    const double now = jo_world_time(jo_scene_world(s->scene)),
                 left = fmax(jo_scene_duration(s->scene) - now, 0.0),
                 seconds = luaL_optnumber(L, 2, left),
                 steps = ceil(seconds / jo_scene_stats(s->scene).dt - 1e-6);
    luaL_argcheck(L, seconds >= 0.0 && seconds <= 1e9, 2, "seconds are 0 to 1e9");
    return advance(L, s, steps > 0 ? (uint64_t)steps : 0);
}

static int input(lua_State *L) {
    JoError error = {0};
    Scene *s = scene_at(L);
    const bool good = jo_scene_input(s->scene, text_at(L, 2), &error);
    return done(L, s, good, &error);
}

static int signal(lua_State *L) {
    JoError error = {0};
    Scene *s = scene_at(L);
    const bool good = jo_scene_signal(s->scene, text_at(L, 2), &error);
    return done(L, s, good, &error);
}

/* Names of modes, in the order of JoLiftMode. */
static const char *const LIFT_MODES[] = {"in_use", "out_of_use", "firemen", NULL};

static int open_wall(lua_State *L) {
    JoError error = {0};
    Scene *s = scene_at(L);
    const bool open = lua_isnoneornil(L, 3) || lua_toboolean(L, 3),
               good = jo_scene_open_wall(s->scene, text_at(L, 2), open, &error);
    return done(L, s, good, &error);
}

/* scene:lift(name) returns a table, or nil if there is no such lift; scene:lift(name, mode) sets
   its mode. */
static int lift(lua_State *L) {
    JoError error = {0};
    Scene *s = scene_at(L);
    JoWorld *world = jo_scene_world(s->scene);
    const char *name = text_at(L, 2);
    if (!lua_isnoneornil(L, 3)) {
        const JoLiftMode mode = (JoLiftMode)luaL_checkoption(L, 3, NULL, LIFT_MODES);
        const bool good = jo_world_set_lift_mode(world, name, mode, &error);
        return done(L, s, good, &error);
    }
    for (uint32_t n = 0; n < jo_world_lift_count(world); n++) {
        const JoLiftState at = jo_world_lift(world, n);
        if (strcmp(at.name, name) != 0)
            continue;
        lua_createtable(L, 0, 8);
        lua_pushstring(L, LIFT_MODES[at.mode]), lua_setfield(L, -2, "mode");
        lua_pushinteger(L, at.capacity), lua_setfield(L, -2, "capacity");
        lua_pushinteger(L, at.people), lua_setfield(L, -2, "people");
        lua_pushinteger(L, at.waiting), lua_setfield(L, -2, "waiting");
        lua_pushstring(L, jo_world_storey_name(world, at.storey)), lua_setfield(L, -2, "storey");
        lua_pushboolean(L, at.moves), lua_setfield(L, -2, "moves");
        lua_pushnumber(L, at.height), lua_setfield(L, -2, "height");
        lua_pushnumber(L, at.open), lua_setfield(L, -2, "open");
        return 1;
    }
    lua_pushnil(L);
    return 1;
}

static int record(lua_State *L) {
    JoError error = {0};
    Scene *s = scene_at(L);
    const double every = luaL_optnumber(L, 3, 0);
    const char *path = text_at(L, 2);
    luaL_argcheck(L, every >= 0 && every <= 1e6, 3, "a frame each so many seconds, 0 to 1e6");
    luaL_argcheck(L, !s->recorded, 1, "the scene is recorded already");
    const bool good = s->recorded = jo_scene_record(s->scene, path, every, &error);
    return done(L, s, good, &error);
}

/* ---- reading ---- */

static int time_now(lua_State *L) {
    lua_pushnumber(L, jo_world_time(world_at(L)));
    return 1;
}

static int duration(lua_State *L) {
    lua_pushnumber(L, jo_scene_duration(scene_at(L)->scene));
    return 1;
}

static int count(lua_State *L) {
    lua_pushinteger(L, jo_world_agent_count(world_at(L)));
    return 1;
}

static int hash(lua_State *L) {
    char text[17];
    snprintf(text, sizeof text, "%016llx", (unsigned long long)jo_world_hash(world_at(L)));
    lua_pushstring(L, text);
    return 1;
}

static void push_number(lua_State *L, const JoColumn *column, uint32_t agent) {
    const char *at = (const char *)column->data + column->stride * agent;
    switch (column->type) {
    case JO_U8:
        lua_pushinteger(L, *(const uint8_t *)at);
        break;
    case JO_U16:
        lua_pushinteger(L, *(const uint16_t *)at);
        break;
    case JO_U32:
        lua_pushinteger(L, *(const uint32_t *)at);
        break;
    case JO_I32:
        lua_pushinteger(L, *(const int32_t *)at);
        break;
    case JO_U64:
        lua_pushinteger(L, (lua_Integer) * (const uint64_t *)at);
        break;
    case JO_F32:
        lua_pushnumber(L, (double)*(const float *)at);
        break;
    case JO_F64:
        lua_pushnumber(L, *(const double *)at);
        break;
    }
}

/* scene:column(NAME): an array of numbers, as of jo_world_column; those of `id` have its order. */
static int column(lua_State *L) {
    const char *name = text_at(L, 2);
    const uint32_t room = jo_world_agent_count(world_at(L));
    lua_createtable(L, (int)room, 0); /* may close the scene: by what is collected then */
    const JoColumn found = jo_world_column(world_at(L), name);
    bool known = found.data != NULL;
    for (uint32_t n = 0; !known && jo_column_name(n); n++)
        known = strcmp(jo_column_name(n), name) == 0;
    if (!known)
        return luaL_error(L, "there is no column '%s'", name);
    for (uint32_t i = 0; found.data && i < found.count; i++) {
        push_number(L, &found, i);
        lua_rawseti(L, -2, (lua_Integer)i + 1);
    }
    return 1;
}

/* scene:agents(): a table for each, in ascending id. */
static int agents(lua_State *L) {
    const uint32_t n = jo_world_agent_count(world_at(L));
    JoAgent *handles = lua_newuserdatauv(L, (n + 1) * sizeof *handles, 0);
    const uint32_t have = jo_world_agents(world_at(L), handles, n);
    lua_createtable(L, (int)have, 0);
    for (uint32_t i = 0; i < have; i++) {
        lua_createtable(L, 0, 7);
        /* What is collected may close or step the scene: it is asked for after each table. */
        const JoAgentState a = jo_agent_state(world_at(L), handles[i]);
        lua_pushstring(L, a.state);
        lua_setfield(L, -2, "state");
        const struct {
            const char *name;
            double value;
        } numbers[] = {{"x", a.x}, {"y", a.y}, {"vx", a.vx}, {"vy", a.vy}, {"load", a.load}};
        lua_pushinteger(L, a.id);
        lua_setfield(L, -2, "id");
        for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
            lua_pushnumber(L, numbers[k].value);
            lua_setfield(L, -2, numbers[k].name);
        }
        lua_rawseti(L, -2, (lua_Integer)i + 1);
    }
    return 1;
}

/* ---- what a run comes to ---- */

/* scene:summary(): the figures of the run so far, as tables. */
static int summary(lua_State *L) {
    return jol_push(L, jol_push_figures, jo_scene_figures(scene_at(L)->scene));
}

/* scene:probe(NAME): what it has measured, as lists by column. */
static int probe(lua_State *L) {
    const JoScene *scene = scene_at(L)->scene;
    const char *name = text_at(L, 2);
    for (uint32_t n = 0; jo_scene_probe_name(scene, n); n++)
        if (strcmp(jo_scene_probe_name(scene, n), name) == 0)
            return jol_push(L, jol_push_table, jo_scene_probe_table(scene, n));
    return luaL_error(L, "the scene has no probe '%s'", name);
}

static const luaL_Reg METHODS[] = {
    {"step", step},     {"run", run},       {"time", time_now},       {"duration", duration},
    {"count", count},   {"hash", hash},     {"column", column},       {"agents", agents},
    {"input", input},   {"signal", signal}, {"open", open_wall},      {"lift", lift},
    {"record", record}, {"probe", probe},   {"summary", summary},     {"close", close},
    {"__gc", collect},  {"__close", close}, {"__tostring", describe}, {NULL, NULL}};

__attribute__((visibility("default"))) int luaopen_jostle(lua_State *L);
int luaopen_jostle(lua_State *L) {
    luaL_newmetatable(L, TYPE);
    luaL_setfuncs(L, METHODS, 0);
    lua_pushvalue(L, -1);
    lua_setfield(L, -2, "__index");
    lua_newtable(L);
    lua_pushcfunction(L, load);
    lua_setfield(L, -2, "scene");
    lua_pushstring(L, jo_version());
    lua_setfield(L, -2, "version");
    return 1;
}
