/* Reload: every beginning of every behaviour, what agents keep, what is refused, memory. */
#include <glob.h>
#include <malloc.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/mem.h"
#include "host/host.h"

enum { STEPS = 40, MOST_PEOPLE = 200, LONG_FILE = 1500, LARGEST = 1 << 18 };

/* What the last scene said. */
static JoxText said;
static char why[256];
static char folder[] = "/tmp/jostle-reload-XXXXXX";

static void listen(void *context, const char *text) {
    (void)context;
    jox_text_add(&said, text);
}

static JoScene *load(const char *path, const char *const *sets, size_t count) {
    JoSceneDef def = jo_default_scene_def();
    def.path = path;
    def.overrides = sets;
    def.override_count = count;
    def.message = listen;
    def.named_mods_only = true;
    JoError error = {0};
    jox_text_free(&said);
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene)
        fail_msg("%s: %s", path, error.text);
    return scene;
}

static void write_file(const char *name, const char *text) {
    char path[300];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/* A scene of the test's own, from a text and one behaviour. */
static JoScene *load_own(const char *scene, const char *behaviour) {
    char path[300];
    write_file("own.lua", behaviour);
    write_file("scene.yaml", scene);
    snprintf(path, sizeof path, "%s/scene.yaml", folder);
    return load(path, NULL, 0);
}

static void step(JoScene *scene, int steps) {
    JoError error = {0};
    for (int i = 0; i < steps; i++)
        if (!jo_scene_step(scene, &error))
            fail_msg("%s", error.text);
}

/* What the watching thread and the step do with a file, in one go: true if the text is live. `why`
   then says nothing, else why it is not. */
static bool reload(JoScene *scene, uint32_t index, const char *text, size_t length) {
    JoxMind *mind = &scene->world->mind;
    const JoxMachine *now = mind->machines[index];
    JoxDiagnostics diagnostics = {0};
    JoxLoaded *loaded =
        jox_lua_prepare(scene->lua, now->path, text, length, &scene->scope, &diagnostics);
    JoxMachine *next = jox_loaded_machine(loaded);
    snprintf(why, sizeof why, "%s", diagnostics.count && !next ? diagnostics.items[0].message : "");
    assert_int_equal(next == NULL, diagnostics.errors > 0); /* nothing fails in silence */
    jox_diag_free(&diagnostics);
    bool live = false;
    if (next) {
        JoxReplacement *replacement = jox_replacement_prepare(now, next, scene->world->def.seed,
                                                              scene->world->agents.next_id);
        live = !jox_mind_refuses(mind, index, replacement, why, sizeof why);
        if (live) {
            JoxMachine *old = jox_mind_replace(mind, index, replacement);
            JoxLoaded *retired = jox_lua_retire(scene->lua, old);
            jox_lua_adopt(scene->lua, loaded);
            assert_true(jox_host_link(scene, next, &diagnostics));
            jox_replacement_free(replacement);
            jox_loaded_free(retired);
        } else {
            jox_replacement_free(replacement);
        }
    }
    jox_loaded_free(loaded);
    return live;
}

static bool reload_text(JoScene *scene, uint32_t index, const char *text) {
    return reload(scene, index, text, strlen(text));
}

static char *read_behaviour(const JoScene *scene, uint32_t index, size_t *length) {
    char *text = jox_read_file(scene->world->mind.machines[index]->path, LARGEST, length);
    assert_non_null(text);
    return text;
}

/* ---- the scenes that are shipped, each with few people ---- */

static JoScene *load_small(const char *path) {
    enum { MOST = 64 };
    static char texts[MOST][160];
    const char *sets[MOST];
    size_t count = 0;
    JoxDiagnostics diagnostics = {0};
    JoxScene *plan = jox_scene_load(path, NULL, &diagnostics);
    jox_diag_free(&diagnostics);
    assert_non_null(plan);
    for (uint32_t g = 0; g < plan->group_count && count < MOST; g++)
        if (plan->groups[g].count > MOST_PEOPLE && plan->groups[g].fill != JOX_FILL_AT) {
            snprintf(texts[count], sizeof *texts, "groups.%s.count=%d", plan->groups[g].name,
                     MOST_PEOPLE);
            sets[count] = texts[count];
            count++;
        }
    for (uint32_t s = 0; s < plan->source_count && count < MOST; s++)
        if (plan->sources[s].keep > MOST_PEOPLE) {
            snprintf(texts[count], sizeof *texts, "sources.%u.keep=%d", s, MOST_PEOPLE);
            sets[count] = texts[count];
            count++;
        }
    jox_scene_free(plan);
    return load(path, sets, count);
}

static void each_scene(void (*visit)(const char *path)) {
    glob_t scenes;
    assert_int_equal(glob("scenes/*.yaml", 0, NULL, &scenes), 0);
    for (size_t s = 0; s < scenes.gl_pathc; s++)
        visit(scenes.gl_pathv[s]);
    globfree(&scenes);
}

static uint64_t hash_alone(const char *path) {
    JoScene *scene = load_small(path);
    step(scene, STEPS);
    uint64_t hash = jo_world_hash(scene->world);
    jo_scene_free(scene);
    return hash;
}

/* ---- every beginning of a file, saved while the crowd runs ---- */

static size_t next_prefix(size_t n, size_t length) {
    size_t next = length > LONG_FILE && n >= 400 ? n + 5 : n + 1;
    return next > length && n < length ? length : next; /* the whole is always the last */
}

static size_t prefixes_of(size_t length) {
    size_t count = 0;
    for (size_t n = 0; n <= length; n = next_prefix(n, length))
        count++;
    return count;
}

static size_t tried, lived;

static void try_prefixes(const char *path) {
    uint64_t alone = hash_alone(path);
    JoScene *scene = load_small(path);
    for (uint32_t m = 0; m < scene->world->mind.machine_count; m++) {
        size_t length, n = 0;
        char *text = read_behaviour(scene, m, &length);
        size_t all = prefixes_of(length), done = 0;
        jo_scene_free(scene);
        scene = load_small(path);
        for (int s = 0; s < STEPS; s++) {
            for (; done < all * ((size_t)s + 1) / STEPS; done++, n = next_prefix(n, length)) {
                /* a block of exactly this size, so that a read beyond it is seen */
                char *prefix = jox_alloc(n + 1, 1);
                memcpy(prefix, text, n);
                bool live = reload(scene, m, prefix, n);
                if (live && n + 1 < length)
                    fail_msg("the first %zu bytes of %s are a machine", n,
                             scene->world->mind.machines[m]->path);
                if (!live && n == length)
                    fail_msg("%s: %s", scene->world->mind.machines[m]->path, why);
                jox_free(prefix);
                lived += live;
                tried++;
            }
            step(scene, 1);
        }
        if (jo_world_hash(scene->world) != alone)
            fail_msg("%s: beginnings of %s change the hash", path,
                     scene->world->mind.machines[m]->path);
        jox_free(text);
    }
    jo_scene_free(scene);
}

static void every_beginning_of_a_behaviour_leaves_the_hash(void **state) {
    (void)state;
    each_scene(try_prefixes);
    assert_true(lived >= 5 && tried > 1000); /* the whole files did go live */
}

/* Behaviours that no scene uses, without people. */
static void every_beginning_of_a_behaviour_is_refused_but_the_last(void **state) {
    (void)state;
    glob_t files;
    assert_int_equal(glob("behaviours/*.lua", 0, NULL, &files), 0);
    JoxLua *lua = jox_lua_create(NULL);
    for (size_t f = 0; f < files.gl_pathc; f++) {
        size_t length, complete = 0;
        char *text = jox_read_file(files.gl_pathv[f], LARGEST, &length);
        for (size_t n = 0; n <= length; n = next_prefix(n, length)) {
            JoxDiagnostics diagnostics = {0};
            JoxMachine *machine =
                jox_lua_load_text(lua, files.gl_pathv[f], text, n, NULL, &diagnostics);
            if (!machine && !diagnostics.errors)
                fail_msg("%s: %zu bytes fail in silence", files.gl_pathv[f], n);
            complete += machine != NULL;
            jox_lua_release(lua, machine);
            jox_machine_free(machine);
            jox_diag_free(&diagnostics);
        }
        if (complete < 1 || complete > 2)
            fail_msg("%zu beginnings of %s are machines", complete, files.gl_pathv[f]);
        jox_free(text);
    }
    jox_lua_free(lua);
    globfree(&files);
}

/* ---- a reload that changes nothing ---- */

static void reload_all_the_time(const char *path) {
    uint64_t alone = hash_alone(path);
    JoScene *scene = load_small(path);
    uint32_t machines = scene->world->mind.machine_count;
    for (int s = 0; s < STEPS; s++) {
        for (uint32_t m = 0; m < machines && s % 2 == 0; m++) {
            size_t length;
            char *text = read_behaviour(scene, m, &length);
            if (!reload(scene, m, text, length))
                fail_msg("%s: %s", scene->world->mind.machines[m]->path, why);
            jox_free(text);
        }
        step(scene, 1);
    }
    for (uint32_t m = 0; m < machines; m++)
        assert_int_equal(scene->world->mind.machines[m]->version, 1 + STEPS / 2);
    if (jo_world_hash(scene->world) != alone)
        fail_msg("%s: reloads that change nothing change the hash", path);
    jo_scene_free(scene);
}

static void a_reload_that_changes_nothing_leaves_the_hash(void **state) {
    (void)state;
    each_scene(reload_all_the_time);
}

static void watch_alone(const char *path) {
    uint64_t alone = hash_alone(path);
    JoScene *scene = load_small(path);
    JoError error = {0};
    assert_true(jo_scene_watch(scene, &error));
    step(scene, STEPS);
    if (jo_world_hash(scene->world) != alone)
        fail_msg("%s: being watched changes the hash", path);
    jo_scene_free(scene);
}

static void being_watched_leaves_the_hash(void **state) {
    (void)state;
    each_scene(watch_alone);
}

/* ---- what agents keep ---- */

#define SCENE(groups)                                                                              \
    "jostle: 1\n"                                                                                  \
    "places: {yard: {polygon: [[0, 0], [40, 0], [40, 40], [0, 40]]}}\n" groups
#define PEOPLE(count)                                                                              \
    SCENE("groups: {people: {behaviour: own.lua, count: " #count ", fill: grid, in: yard}}\n")
#define HEAD "return machine { name = \"m\", start = "

static const char GREET[] =
    "local mine = memory { met = 0, left = 0 }\n" HEAD "\"Enter\", states = {\n"
    "  Enter = { steer = hold, { to = \"Greet\", when = after(0.1) } },\n"
    "  Greet = { steer = hold, on_enter = function(me) me.met = me.met + 1 end,\n"
    "    on_exit = function(me) me.left = me.left + 1 end } } }\n";
static const char ISTILAM[] =
    "local mine = memory { met = 0, left = 0 }\n" HEAD
    "\"Enter\", renamed = { Greet = \"Istilam\" }, states = {\n"
    "  Enter = { steer = hold, { to = \"Istilam\", when = after(0.1) } },\n"
    "  Other = { steer = hold, { to = \"Enter\", when = after(9) } },\n"
    "  Istilam = { steer = hold, on_enter = function(me) me.met = me.met + 1 end,\n"
    "    on_exit = function(me) me.left = me.left + 1 end, { to = \"Other\", when = after(0.5) } } "
    "} }\n";

static double memory_of(const JoScene *scene, uint32_t agent, const char *name) {
    const JoxAgents *a = &scene->world->agents;
    const JoxMachine *m = scene->world->mind.machines[a->machine[agent]];
    for (uint32_t s = 0; s < m->memory_count; s++)
        if (strcmp(m->memory[s].name, name) == 0)
            return a->memory[(size_t)agent * a->memory_stride + s];
    fail_msg("no memory '%s'", name);
    return 0.0;
}

static const char *state_of(const JoScene *scene, uint32_t agent) {
    const JoxAgents *a = &scene->world->agents;
    return scene->world->mind.machines[a->machine[agent]]->states[a->state[agent]].name;
}

static void a_renamed_state_goes_on_where_it_was(void **state) {
    (void)state;
    JoScene *scene = load_own(PEOPLE(5), GREET);
    step(scene, 8); /* 0.1 s in Enter, and some 0.25 s in Greet */
    assert_string_equal(state_of(scene, 0), "Greet");
    uint32_t entered = scene->world->agents.entered[0];
    assert_true(reload_text(scene, 0, ISTILAM));
    assert_string_equal(state_of(scene, 0), "Istilam");
    assert_int_equal(scene->world->agents.entered[0], entered);
    int steps = 0;
    for (; strcmp(state_of(scene, 0), "Istilam") == 0 && steps < 100; steps++)
        step(scene, 1);
    assert_in_range(steps, 3, 8); /* its time counts from when Greet was entered */
    for (uint32_t i = 0; i < 5; i++) {
        assert_true(memory_of(scene, i, "met") == 1.0); /* not entered again */
        assert_true(memory_of(scene, i, "left") == 1.0);
    }
    jo_scene_free(scene);
}

static void a_state_with_people_cannot_disappear(void **state) {
    (void)state;
    static const char WITHOUT[] =
        HEAD "\"Enter\", states = { Enter = { steer = hold }, Istilam = { steer = hold, "
             "{ to = \"Enter\", when = after(1) } } } }\n";
    JoScene *scene = load_own(PEOPLE(312), GREET);
    assert_true(reload_text(scene, 0, GREET));
    step(scene, 8);
    uint64_t before = jo_world_hash(scene->world);
    assert_false(reload_text(scene, 0, WITHOUT));
    assert_non_null(strstr(why, "312 agents are in 'Greet', which this version lacks"));
    assert_non_null(strstr(why, "renamed"));
    assert_int_equal(jo_world_hash(scene->world), before);
    assert_int_equal(scene->world->mind.machines[0]->version, 2);
    step(scene, 8);
    assert_string_equal(state_of(scene, 311), "Greet");
    jo_scene_free(scene);
    scene = load_own(PEOPLE(312), GREET); /* nobody has got there yet */
    assert_true(reload_text(scene, 0, WITHOUT));
    jo_scene_free(scene);
}

static void memory_is_kept_by_name_and_type(void **state) {
    (void)state;
    static const char BEFORE[] =
        "local mine = memory { laps = 0, seen = 0, tired = false, gone = 3 }\n" HEAD
        "\"A\", states = { A = { steer = hold,\n"
        "  on_enter = function(me) me.laps = 5; me.seen = 7; me.tired = true end } } }\n";
    static const char AFTER[] =
        "local mine = memory { fresh = 11, tired = 4, laps = 0, seen = true }\n" HEAD
        "\"A\", states = { A = { steer = hold, on_enter = function(me) me.laps = 99 end } } }\n";
    JoScene *scene = load_own(PEOPLE(5), BEFORE);
    step(scene, 2);
    assert_true(memory_of(scene, 4, "seen") == 7.0 && memory_of(scene, 4, "tired") == 1.0);
    assert_true(reload_text(scene, 0, AFTER));
    for (uint32_t i = 0; i < 5; i++) {
        assert_true(memory_of(scene, i, "laps") == 5.0);  /* kept; on_enter has not run */
        assert_true(memory_of(scene, i, "tired") == 4.0); /* was a boolean */
        assert_true(memory_of(scene, i, "seen") == 1.0);  /* was a number */
        assert_true(memory_of(scene, i, "fresh") == 11.0);
    }
    step(scene, 2);
    assert_true(memory_of(scene, 4, "laps") == 5.0);
    jo_scene_free(scene);
}

#define FAST(speed, more)                                                                          \
    HEAD "\"A\", defaults = { speed = " speed " }, states = { A = { steer = hold" more " } } }\n"
static const char TWO_GROUPS[] =
    SCENE("groups:\n"
          "  free: {behaviour: own.lua, count: 50, fill: grid, in: yard}\n"
          "  set: {behaviour: own.lua, count: 50, fill: grid, in: yard, set: {speed: 0.7}}\n");

static double speed_of(const JoScene *scene, uint32_t agent) {
    return (double)scene->world->agents.param[JOX_PARAM_speed][agent];
}

static void another_distribution_reaches_the_living(void **state) {
    (void)state;
    JoScene *scene = load_own(TWO_GROUPS, FAST("uniform(1, 1.2)", ""));
    step(scene, 3);
    uint64_t before = jo_world_hash(scene->world);
    const JoxAgents *a = &scene->world->agents;
    assert_true(reload_text(scene, 0, FAST("uniform(1.4, 1.6)", "")));
    double low = 9, high = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        double speed = speed_of(scene, i);
        if (a->group[i] == 1) {
            assert_true(speed == (double)0.7f); /* what the scene sets stays */
            continue;
        }
        assert_true(speed >= 1.4 && speed <= 1.6);
        low = speed < low ? speed : low;
        high = speed > high ? speed : high;
    }
    assert_true(low < 1.45 && high > 1.55); /* each has its own */
    assert_true(reload_text(scene, 0, FAST("2", "")));
    for (uint32_t i = 0; i < a->count; i++)
        assert_true(speed_of(scene, i) == (a->group[i] ? (double)0.7f : 2.0));
    assert_true(reload_text(scene, 0, FAST("uniform(1, 1.2)", "")));
    assert_int_equal(jo_world_hash(scene->world), before); /* and back: the same random numbers */
    assert_true(reload_text(scene, 0, FAST("uniform(1, 1.2)", ", speed = 1.9")));
    for (uint32_t i = 0; i < a->count; i++)
        assert_true(speed_of(scene, i) == (double)1.9f); /* a state's value goes before both */
    jo_scene_free(scene);
}

static void own_values_are_kept_by_name(void **state) {
    (void)state;
    static const char BEFORE[] =
        HEAD "\"A\", defaults = { speed = uniform(1, 2), horizon = uniform(0.3, 0.6) },\n"
             "  states = { A = { steer = hold, push = 100 * own.horizon } } }\n";
    static const char AFTER[] =
        HEAD "\"A\", defaults = { perception = uniform(5, 6), mass = normal(70, 5, 50, 90),\n"
             "  horizon = uniform(0.3, 0.6), speed = uniform(1, 2) }, states = {\n"
             "  A = { steer = hold, max_speed = uniform(2, 3), push = own.perception + 100 * "
             "own.horizon } } }\n";
    JoScene *scene = load_own(PEOPLE(40), BEFORE);
    step(scene, 2);
    double speed[40], push[40];
    const JoxAgents *a = &scene->world->agents;
    for (uint32_t i = 0; i < 40; i++) {
        speed[a->id[i]] = speed_of(scene, i);
        push[a->id[i]] = (double)a->param[JOX_PARAM_push][i];
    }
    assert_true(reload_text(scene, 0, AFTER));
    step(scene, 1);
    for (uint32_t i = 0; i < 40; i++) {
        double more = (double)a->param[JOX_PARAM_push][i] - push[a->id[i]];
        assert_true(speed_of(scene, i) == speed[a->id[i]]);
        assert_true(more > 4.99 && more < 6.01);
        assert_true(a->param[JOX_PARAM_max_speed][i] >= 2.0f);
    }
    jo_scene_free(scene);
}

/* A condition that has been true is not rolled for again, though the transitions stand elsewhere.
 */
static void chances_are_not_rolled_again(void **state) {
    (void)state;
#define ROLL(before)                                                                               \
    HEAD "\"A\", states = { A = { steer = hold, " before                                           \
         "{ to = \"B\", when = after(0.1), chance = 0.5 } }, B = { steer = hold }, "               \
         "C = { steer = hold } } }\n"
    JoScene *scene = load_own(PEOPLE(200), ROLL(""));
    step(scene, 8);
    uint32_t people[3];
    jox_mind_census(&scene->world->mind, 0, people);
    assert_in_range(people[0], 60, 140);
    uint32_t waiting = people[0];
    for (int i = 0; i < 10; i++) {
        const char *text = i % 2
                               ? ROLL("")
                               : ROLL("{ to = \"C\", when = after(50) }, { to = \"C\", id = \"x\", "
                                      "when = after(60) }, ");
        assert_true(reload_text(scene, 0, text));
        step(scene, 2);
    }
    jox_mind_census(&scene->world->mind, 0, people);
    assert_int_equal(people[0], waiting);
    jo_scene_free(scene);
}

/* Parameters that a new version no longer sets fall back to what holds without it. */
static void a_parameter_taken_out_falls_back(void **state) {
    (void)state;
    JoScene *scene = load_own(PEOPLE(5), FAST("1.5", ", push = 80, ignore = {}"));
    step(scene, 2);
    float push = jox_parameter_store(JOX_PARAM_push, jox_parameters[JOX_PARAM_push].value);
    assert_true(scene->world->agents.param[JOX_PARAM_push][2] == 80.0f);
    assert_true(reload_text(scene, 0, FAST("1.5", "")));
    assert_true(scene->world->agents.param[JOX_PARAM_push][2] == push);
    jo_scene_free(scene);
}

/* ---- memory ---- */

static void ten_thousand_reloads_keep_nothing(void **state) {
    (void)state;
    static const char EVEN[] =
        "local mine = memory { laps = 0, seen = false }\n" HEAD
        "\"A\", defaults = { speed = uniform(1, 2), horizon = normal(1, 0.2, 0.2, 2) }, states = "
        "{\n"
        "  A = { steer = hold, push = 20 * own.horizon, { to = \"B\", when = after(0.2) } },\n"
        "  B = { steer = hold, on_enter = function(me) me.laps = me.laps + 1 end,\n"
        "    { to = \"A\", when = after(0.1) | stuck(1) } } } }\n";
    static const char ODD[] =
        "local mine = memory { seen = false, more = 1, laps = 0 }\n" HEAD
        "\"B\", defaults = { speed = uniform(0.5, 1), perception = 3 }, states = {\n"
        "  B = { steer = spread, { to = \"A\", when = function(me) return me.laps > 2 end } },\n"
        "  C = { steer = hold }, A = { steer = hold, speed = own.perception / 3,\n"
        "    { to = \"B\", when = after(0.1) } } } }\n";
    JoScene *scene = load_own(PEOPLE(30), EVEN);
    size_t before = 0;
    for (int i = 0; i < 10200; i++) {
        if (i == 200)
            before = mallinfo2().uordblks;
        if (!reload_text(scene, 0,
                         i % 3 == 2 ? "return machine { name = "
                         : i % 2    ? ODD
                                    : EVEN) &&
            i % 3 != 2)
            fail_msg("%s", why);
        if (i % 10 == 0)
            step(scene, 1);
    }
    size_t after = mallinfo2().uordblks; /* zero under the sanitizers, which look for leaks */
    if (after > before + 1000000)
        fail_msg("%zu bytes more", after - before);
    assert_int_equal(scene->world->mind.machines[0]->version, 1 + 6800);
    jo_scene_free(scene);
}

/* ---- a file saved while the crowd runs ---- */

static double wall(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* Steps until the scene has said it, for at most ten seconds. */
static bool says(JoScene *scene, const char *text) {
    for (double begun = wall(); wall() - begun < 10.0;) {
        step(scene, 1);
        if (said.data && strstr(said.data, text))
            return true;
        usleep(500);
    }
    return false;
}

static void a_saved_file_goes_live(void **state) {
    (void)state;
    JoScene *scene = load_own(PEOPLE(20), FAST("1.5", ""));
    JoError error = {0};
    assert_true(jo_scene_watch(scene, &error));
    step(scene, 5);
    write_file("own.lua", FAST("0.5", ""));
    assert_true(says(scene, "version 2 is live"));
    assert_true(speed_of(scene, 3) == 0.5);
    write_file("own.lua", "return machine {");
    assert_true(says(scene, "Version 2 keeps running"));
    for (int i = 0; i < 30; i++) { /* saved again and again while the crowd runs */
        char text[200];
        snprintf(text, sizeof text, FAST("1.%02d", ""), i);
        write_file("own.lua", text);
        step(scene, 3);
    }
    write_file("own.lua", FAST("1.9", ""));
    for (double begun = wall(); speed_of(scene, 3) != (double)1.9f && wall() - begun < 10.0;)
        step(scene, 1), usleep(500);
    assert_true(speed_of(scene, 3) == (double)1.9f);
    write_file("own.lua", FAST("1.1", "")); /* freed while something is being loaded */
    usleep(40000);
    jo_scene_free(scene);
}

static int make_folder(void **state) {
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state) {
    (void)state;
    const char *const names[] = {"own.lua", "scene.yaml"};
    for (int i = 0; i < 2; i++) {
        char path[300];
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    jox_text_free(&said);
    return rmdir(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_beginning_of_a_behaviour_leaves_the_hash),
        cmocka_unit_test(every_beginning_of_a_behaviour_is_refused_but_the_last),
        cmocka_unit_test(a_reload_that_changes_nothing_leaves_the_hash),
        cmocka_unit_test(being_watched_leaves_the_hash),
        cmocka_unit_test(a_renamed_state_goes_on_where_it_was),
        cmocka_unit_test(a_state_with_people_cannot_disappear),
        cmocka_unit_test(memory_is_kept_by_name_and_type),
        cmocka_unit_test(another_distribution_reaches_the_living),
        cmocka_unit_test(own_values_are_kept_by_name),
        cmocka_unit_test(chances_are_not_rolled_again),
        cmocka_unit_test(a_parameter_taken_out_falls_back),
        cmocka_unit_test(ten_thousand_reloads_keep_nothing),
        cmocka_unit_test(a_saved_file_goes_live),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
