/* The functions of tests that concern scenes: `scene` and `refused`, and the methods of a scene,
   which step it, read it and assert. Scenes are reached through the driver (test_file.h). */
#include "luatest/luatest_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/clock.h"
#include "lua/test_words.h"
#include "luatest/history.h"

static const char SCENE[] = "jostle scene";
static const double MOST_STEPPING = 60.0; /* processor time for the steps of a test, s */
static const double WITHIN = 60.0;        /* default of the option `within`, simulated s */

/* The userdata of a scene. */
typedef struct Scene {
    void *scene; /* the driver's handle; NULL once freed */
    JoxTestHistory history;
} Scene;

/* Returns the scene that argument 1 is. */
static Scene *check_scene_handle(lua_State *L) {
    Scene *t = luaL_checkudata(L, 1, SCENE);
    if (!t->scene)
        luaL_error(L, "this scene has been freed");
    return t;
}

static const JoxMachineRun *find_test_machines(lua_State *L, const Scene *t) {
    const JoxTestDriver *driver = jox_test_run_of(L)->driver;
    return driver->machines(driver->context, t->scene);
}

/* Simulated time, s. */
static double read_test_time(lua_State *L, const Scene *t) {
    const JoxTestDriver *driver = jox_test_run_of(L)->driver;
    return driver->time(driver->context, t->scene);
}

/* Makes a step and records states. Raises an error in Lua if the step fails, or if the test has
   used up its time. */
static void step_test_scene(lua_State *L, Scene *t) {
    JoxTestRun *run = jox_test_run_of(L);
    const JoxTestDriver *driver = run->driver;
    JoxText why = {0};
    run->last = t->scene;
    double begun = jox_clock_thread();
    bool good = driver->step(driver->context, t->scene, &why);
    run->stepping += jox_clock_thread() - begun;
    const JoxMachineRun *machines = find_test_machines(L, t);
    run->simulated += machines->dt;
    jox_test_history_note(&t->history, machines);
    if (!good) {
        lua_pushfstring(L, "%s", why.data ? why.data : "the step failed");
        jox_text_free(&why);
        luaL_error(L, "%s", lua_tostring(L, -1));
    }
    if (run->stepping > MOST_STEPPING)
        luaL_error(L, "this test has stepped for over %d s of processor time", (int)MOST_STEPPING);
}

/* ---- options ---- */

/* Returns the index of the group that the option `agents` names; -1, for all, if it is absent. */
static int32_t read_group_option(lua_State *L, const Scene *t, int index) {
    if (lua_type(L, index) != LUA_TTABLE)
        return -1;
    lua_pushstring(L, "agents");
    if (lua_rawget(L, index) == LUA_TNIL) {
        lua_pop(L, 1);
        return -1;
    }
    const JoxTestDriver *driver = jox_test_run_of(L)->driver;
    const char *name = luaL_checkstring(L, -1);
    int32_t group = driver->group(driver->context, t->scene, name);
    if (group < 0)
        luaL_error(L, "the scene has no group '%s'", name);
    lua_pop(L, 1);
    return group;
}

/* ---- reading ---- */

/* s:count([state [, { agents = "group" }]]): the number of agents. */
static int scene_count(lua_State *L) {
    Scene *t = check_scene_handle(L);
    const char *state =
        lua_isnoneornil(L, 2) ? NULL : jox_test_check_state(L, find_test_machines(L, t), 2);
    lua_pushinteger(
        L, jox_test_count_in_state(find_test_machines(L, t), state, read_group_option(L, t, 3)));
    return 1;
}

/* s:entered(state [, { agents = "group" }]): the number of agents that have been in a state. */
static int scene_entered(lua_State *L) {
    Scene *t = check_scene_handle(L);
    const char *state = jox_test_check_state(L, find_test_machines(L, t), 2);
    lua_pushinteger(L, jox_test_history_been(&t->history, state, read_group_option(L, t, 3), NULL));
    return 1;
}

static int scene_time(lua_State *L) {
    lua_pushnumber(L, read_test_time(L, check_scene_handle(L)));
    return 1;
}

static int scene_hash(lua_State *L) {
    const JoxTestDriver *driver = jox_test_run_of(L)->driver;
    char text[24];
    snprintf(text, sizeof text, "%016llx",
             (unsigned long long)driver->hash(driver->context, check_scene_handle(L)->scene));
    lua_pushstring(L, text);
    return 1;
}

/* s:agents(["group"]): a list of agents in order of id. */
static int scene_agents(lua_State *L) {
    Scene *t = check_scene_handle(L);
    const JoxMachineRun *machines = find_test_machines(L, t);
    const JoxTestDriver *driver = jox_test_run_of(L)->driver;
    int32_t group = -1;
    if (!lua_isnoneornil(L, 2) &&
        (group = driver->group(driver->context, t->scene, luaL_checkstring(L, 2))) < 0)
        return luaL_error(L, "the scene has no group '%s'", lua_tostring(L, 2));
    lua_newtable(L);
    lua_Integer n = 0;
    for (uint32_t rank = 0; rank < machines->agents->count; rank++) {
        uint32_t i = machines->agents->by_rank[rank];
        if (group >= 0 && machines->agents->group[i] != group)
            continue;
        jox_test_push_agent(L, driver, t->scene, i);
        lua_rawseti(L, -2, ++n);
    }
    return 1;
}

/* s:agent(id): the agent, or nil if it has left. */
static int scene_agent(lua_State *L) {
    const Scene *t = check_scene_handle(L);
    const JoxMachineRun *machines = find_test_machines(L, t);
    lua_Integer id = luaL_checkinteger(L, 2);
    uint32_t i = id < 0 || id >= machines->agents->next_id
                     ? JOX_NO_INDEX
                     : jox_agents_find(machines->agents, (uint32_t)id);
    if (i == JOX_NO_INDEX)
        lua_pushnil(L);
    else
        jox_test_push_agent(L, jox_test_run_of(L)->driver, t->scene, i);
    return 1;
}

/* s:body("name"): a table with position, m, and velocity, m/s. */
static int scene_body(lua_State *L) {
    static const char *const NAMES[] = {"x", "y", "z", "vx", "vy", "vz"};
    Scene *t = check_scene_handle(L);
    const JoxTestDriver *driver = jox_test_run_of(L)->driver;
    double pose[6];
    if (!driver->body(driver->context, t->scene, luaL_checkstring(L, 2), pose))
        return luaL_error(L, "the scene has no body '%s'", lua_tostring(L, 2));
    lua_newtable(L);
    for (int k = 0; k < 6; k++)
        jox_test_set_number(L, NAMES[k], pose[k]);
    return 1;
}

/* ---- stepping ---- */

static int scene_step(lua_State *L) {
    Scene *t = check_scene_handle(L);
    for (lua_Integer n = luaL_optinteger(L, 2, 1); n > 0; n--)
        step_test_scene(L, t);
    return 0;
}

/* s:run(seconds) */
static int scene_run(lua_State *L) {
    Scene *t = check_scene_handle(L);
    const JoxMachineRun *machines = find_test_machines(L, t);
    double steps = luaL_checknumber(L, 2) / machines->dt;
    for (double n = 0.5; n < steps; n += 1.0)
        step_test_scene(L, t);
    return 0;
}

/* s:reaches(state, { within = s, agents = "group", count = n, any = true }) */
static int scene_reaches(lua_State *L) {
    static const char *const OPTIONS[] = {"within", "agents", "count", "any"};
    Scene *t = check_scene_handle(L);
    const char *state = jox_test_check_state(L, find_test_machines(L, t), 2);
    jox_test_check_options(L, 3, OPTIONS, 4);
    int32_t group = read_group_option(L, t, 3);
    double within = jox_test_number_option(L, 3, "within", WITHIN);
    uint32_t all = 0;
    for (uint32_t id = 0; id < t->history.known; id++)
        all += group < 0 || t->history.group[id] == group;
    uint32_t wanted = (uint32_t)jox_test_number_option(L, 3, "count", all);
    if (wanted == 0)
        return luaL_error(L, "the scene has no agents that could reach a state");
    if (lua_type(L, 3) == LUA_TTABLE) {
        lua_pushstring(L, "any");
        lua_rawget(L, 3);
        wanted = lua_toboolean(L, -1) ? 1 : wanted;
        lua_pop(L, 1);
    }
    jox_test_run_of(L)->assertions++;
    const JoxMachineRun *machines = find_test_machines(L, t);
    double until = read_test_time(L, t) + within - 0.5 * machines->dt;
    while (jox_test_history_been(&t->history, state, group, NULL) < wanted &&
           read_test_time(L, t) < until)
        step_test_scene(L, t);
    uint32_t been = jox_test_history_been(&t->history, state, group, NULL);
    if (been >= wanted) {
        lua_pushnumber(L, read_test_time(L, t));
        return 1;
    }
    jox_test_run_of(L)->wanted = state;
    jox_test_run_of(L)->wanted_group = group;
    jox_test_push_counts(L, machines, group);
    const uint32_t without = jox_test_count_without(machines, state, group);
    lua_pushfstring(L,
                    "; the machine of %d of them has no such state: { agents = \"group\" } chooses",
                    (int)without);
    return luaL_error(L, "%d of %d agents reached '%s' within %f s; now at t = %f s: %s%s",
                      (int)been, (int)wanted, state, within, read_test_time(L, t),
                      lua_tostring(L, -2), without && wanted == all ? lua_tostring(L, -1) : "");
}

/* s:never(state, { during = s, agents = "group" }); counts the time before the call too. */
static int scene_never(lua_State *L) {
    static const char *const OPTIONS[] = {"during", "agents"};
    Scene *t = check_scene_handle(L);
    const char *state = jox_test_check_state(L, find_test_machines(L, t), 2);
    jox_test_check_options(L, 3, OPTIONS, 2);
    int32_t group = read_group_option(L, t, 3);
    const JoxMachineRun *machines = find_test_machines(L, t);
    double until =
        read_test_time(L, t) + jox_test_number_option(L, 3, "during", 0.0) - 0.5 * machines->dt;
    jox_test_run_of(L)->assertions++;
    for (;;) {
        int32_t id;
        if (jox_test_history_been(&t->history, state, group, &id))
            return luaL_error(L, "agent %d has been in '%s', by t = %f s", (int)id, state,
                              read_test_time(L, t));
        if (read_test_time(L, t) >= until)
            return 0;
        step_test_scene(L, t);
    }
}

/* Steps for `during` s and computes the mean speed of the agents of a group (-1: all). Raises an
   error if an agent is faster than `most`, m/s. */
static void watch_speed(lua_State *L, Scene *t, double during, int32_t group, double most,
                        double *mean) {
    const JoxMachineRun *machines = find_test_machines(L, t);
    const JoxAgents *a = machines->agents;
    double until = read_test_time(L, t) + during - 0.5 * machines->dt, sum = 0.0;
    uint64_t count = 0;
    do {
        step_test_scene(L, t);
        for (uint32_t i = 0; i < a->count; i++) {
            if (group >= 0 && a->group[i] != group)
                continue;
            double speed = jox_test_speed(a, i);
            sum += speed;
            count++;
            if (speed > most)
                luaL_error(L, "agent %d moves at %f m/s at t = %f s, faster than %f", (int)a->id[i],
                           speed, read_test_time(L, t), most);
        }
    } while (read_test_time(L, t) < until);
    if (count == 0)
        luaL_error(L, "there are no agents whose speed could be measured");
    *mean = count ? sum / (double)count : 0.0;
}

/* s:slower_than(speed [, options]): no agent is faster at any time. */
static int scene_slower_than(lua_State *L) {
    static const char *const OPTIONS[] = {"during", "agents"};
    Scene *t = check_scene_handle(L);
    double mean;
    jox_test_check_options(L, 3, OPTIONS, 2);
    jox_test_run_of(L)->assertions++;
    watch_speed(L, t, jox_test_number_option(L, 3, "during", 1.0), read_group_option(L, t, 3),
                luaL_checknumber(L, 2), &mean);
    return 0;
}

/* s:faster_than(speed [, options]): the mean speed is greater; returns it. */
static int scene_faster_than(lua_State *L) {
    static const char *const OPTIONS[] = {"during", "agents"};
    Scene *t = check_scene_handle(L);
    double mean, least = luaL_checknumber(L, 2);
    jox_test_check_options(L, 3, OPTIONS, 2);
    jox_test_run_of(L)->assertions++;
    watch_speed(L, t, jox_test_number_option(L, 3, "during", 1.0), read_group_option(L, t, 3),
                INFINITY, &mean);
    if (!(mean > least))
        return luaL_error(L, "agents move at %f m/s on the average, not faster than %f", mean,
                          least);
    lua_pushnumber(L, mean);
    return 1;
}

/* s:why(id), s:why({ agents = "group", state = "Walk", to = "Rest" }): the text of `jostle why`. */
static int scene_why(lua_State *L) {
    static const char *const OPTIONS[] = {"agents", "state", "to"};
    const Scene *t = check_scene_handle(L);
    const JoxTestDriver *driver = jox_test_run_of(L)->driver;
    JoxTestQuestion question = {.agent = -1};
    JoxText text = {0};
    if (lua_type(L, 2) == LUA_TNUMBER) {
        question.agent = luaL_checkinteger(L, 2);
    } else if (!lua_isnoneornil(L, 2)) {
        jox_test_check_options(L, 2, OPTIONS, 3);
        question.group = jox_test_text_option(L, 2, "agents");
        question.state = jox_test_text_option(L, 2, "state");
        question.to = jox_test_text_option(L, 2, "to");
    }
    const bool good = driver->why(driver->context, t->scene, &question, &text);
    lua_pushlstring(L, text.data ? text.data : "", text.length);
    jox_text_free(&text);
    return good ? 1 : luaL_error(L, "%s", lua_tostring(L, -1));
}

/* ---- making scenes ---- */

static void free_test_scene(lua_State *L, Scene *t) {
    if (t->scene) {
        const JoxTestDriver *driver = jox_test_run_of(L)->driver;
        if (jox_test_run_of(L)->last == t->scene)
            jox_test_run_of(L)->last = NULL;
        driver->free(driver->context, t->scene);
    }
    jox_test_history_free(&t->history);
    *t = (Scene){0};
}

static int scene_gc(lua_State *L) {
    if (jox_vm_of(L)) /* if not, memory ran out, and the heap releases the scene */
        free_test_scene(L, luaL_checkudata(L, 1, SCENE));
    return 0;
}

/* Loads the scene that arguments 1 (table or path) and 2 (options) describe; NULL with the reason
   in `why`. */
static void *load_test_scene(lua_State *L, JoxText *why) {
    static const char *const OPTIONS[] = {"set", "mods", "seed", "dt", "threads"};
    JoxTestRun *run = jox_test_run_of(L);
    const char *sets[64], *mods[64];
    lua_settop(L, 2);
    jox_test_check_options(L, 2, OPTIONS, 5);
    JoxTestScene scene = {.path = run->path, .threads = 1, .sets = sets, .mods = mods};
    scene.threads = (uint32_t)jox_test_number_option(L, 2, "threads", 1);
    scene.dt = jox_test_number_option(L, 2, "dt", 0.0);
    scene.seed = (uint64_t)jox_test_number_option(L, 2, "seed", 0);
    scene.has_dt = scene.dt > 0.0;
    scene.has_seed = lua_type(L, 2) == LUA_TTABLE && jox_test_number_option(L, 2, "seed", -1) >= 0;
    scene.set_count = jox_test_read_texts(L, 2, "set", true, sets);
    scene.mod_count = jox_test_read_texts(L, 2, "mods", false, mods);
    if (lua_type(L, 1) == LUA_TTABLE) {
        run->yaml.length = 0;
        jox_test_scene_yaml(L, run, 1, &run->yaml);
        scene.text = run->yaml.data;
        scene.length = run->yaml.length;
    } else { /* a file, which the driver searches from the test's folder */
        scene.path = luaL_checkstring(L, 1);
    }
    void *loaded = run->driver->load(run->driver->context, &scene, why);
    return loaded; // cppcheck-suppress returnDanglingLifetime
}

/* scene { ... } or scene("file.yaml" [, options]) */
static int word_scene(lua_State *L) {
    JoxText why = {0};
    if (!jox_test_run_of(L)->running)
        return luaL_error(L, "a scene can only be made within a test");
    void *scene = load_test_scene(L, &why);
    if (!scene) {
        lua_pushfstring(L, "the scene is refused: %s", why.data ? why.data : "?");
        jox_text_free(&why);
        return luaL_error(L, "%s", lua_tostring(L, -1));
    }
    jox_text_free(&why);
    Scene *t = lua_newuserdatauv(L, sizeof *t, 0);
    *t = (Scene){.scene = scene};
    jox_test_run_of(L)->last = scene;
    luaL_setmetatable(L, SCENE);
    jox_test_history_note(&t->history, find_test_machines(L, t));
    return 1;
}

/* refused({ ... }, "text"): asserts that loading the scene fails with an error that has this
   text. */
static int word_refused(lua_State *L) {
    JoxText why = {0};
    char wanted[256];
    JoxTestRun *run = jox_test_run_of(L);
    snprintf(wanted, sizeof wanted, "%s", luaL_checkstring(L, 2));
    run->assertions++;
    lua_settop(L, 1);
    void *scene = load_test_scene(L, &why);
    if (scene) {
        run->driver->free(run->driver->context, scene);
        jox_text_free(&why);
        return luaL_error(L, "the scene loads, and should not");
    }
    bool found = why.data && strstr(why.data, wanted);
    lua_pushfstring(L, "the scene is refused, but not for '%s': %s", wanted,
                    why.data ? why.data : "?");
    jox_text_free(&why);
    return found ? 0 : luaL_error(L, "%s", lua_tostring(L, -1));
}

/* Asserts that functions are described for the reference page and for editors. */
static void check_described(const char *prefix, const luaL_Reg *functions) {
    char name[64];
    for (; functions->name; functions++) {
        snprintf(name, sizeof name, "%s%s", prefix, functions->name);
        JOX_ASSERT(jox_test_word_is_known(name));
    }
}

void jox_test_scene_words(lua_State *L) {
    static const luaL_Reg WORDS[] = {
        {"scene", word_scene}, {"refused", word_refused}, {NULL, NULL}};
    static const luaL_Reg METHODS[] = {
        {"run", scene_run},         {"step", scene_step},       {"time", scene_time},
        {"count", scene_count},     {"entered", scene_entered}, {"hash", scene_hash},
        {"reaches", scene_reaches}, {"never", scene_never},     {"slower_than", scene_slower_than},
        {"agents", scene_agents},   {"agent", scene_agent},     {"faster_than", scene_faster_than},
        {"body", scene_body},       {"why", scene_why},         {NULL, NULL}};
    check_described("", WORDS);
    check_described("", jox_test_assertions);
    check_described(":", METHODS);
    luaL_setfuncs(L, WORDS, 0);
    luaL_setfuncs(L, jox_test_assertions, 0);
    luaL_newmetatable(L, SCENE);
    lua_newtable(L);
    luaL_setfuncs(L, METHODS, 0);
    lua_setfield(L, -2, "__index");
    lua_pushcfunction(L, scene_gc);
    lua_setfield(L, -2, "__gc");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_pop(L, 1);
}
