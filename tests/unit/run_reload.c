/* Tests of reloads: of every prefix of every behaviour, of unchanged texts, of saved files, and
 * their use of memory. */
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

#include "run/scene_machines.h"
#include "unit/effort.h"
#include "unit/shipped_scenes.h"

enum { STEPS = 24, LONG_FILE = 1500, LARGEST = 1 << 18 };

static char *read_behaviour(const JoScene *scene, uint32_t index, size_t *length) {
    char *text = jox_read_file(scene->world->model.machines.items[index]->path, LARGEST, length);
    assert_non_null(text);
    return text;
}

/* Returns whether a behaviour is generated from a journey of the scene, and thus is no file. */
static bool is_made(const JoScene *scene, uint32_t index) {
    return jox_run_journey_text(scene->spec, scene->world->model.machines.items[index]->path) !=
           NULL;
}

/* ---- the scenes that are shipped, each with few people, and one with nested machines ---- */

static void visit_all_scenes(void (*visit)(const char *path)) {
    visit_shipped_scenes(visit);
    visit("tests/data/nested.yaml");
}

/* Returns the hash of a scene after `steps` steps without reloads; each scene is run once for it.
 */
static uint64_t hash_alone(const char *path) {
    enum { MOST = 256 };
    static char paths[MOST][200];
    static uint64_t hashes[MOST];
    static size_t count;
    for (size_t p = 0; p < count; p++)
        if (!strcmp(paths[p], path))
            return hashes[p];
    assert_true(count < MOST && strlen(path) < sizeof *paths);
    JoScene *scene = load_small_scene(path);
    step_scene(scene, STEPS);
    strcpy(paths[count], path);
    hashes[count] = jo_world_hash(scene->world);
    jo_scene_free(scene);
    return hashes[count++];
}

/* ---- every prefix of a file, saved during a run ---- */

/* Returns where the next prefix ends: after each byte with JOSTLE_ALL_PREFIXES, else after some, as
   each costs a load. A behaviour that an earlier scene has tried is cut at fewer places: other
   people are there, but the text is the same. */
static size_t next_cut(size_t n, size_t length, bool known) {
    const size_t some = known ? 61 : length > LONG_FILE && n >= 400 ? 11 : 3;
    const size_t next = n + (getenv("JOSTLE_ALL_PREFIXES") ? 1 : some * EFFORT_EACH);
    return next > length && n < length ? length : next; /* the whole text is always the last */
}

static size_t count_cuts(size_t length, bool known) {
    size_t count = 0;
    for (size_t n = 0; n <= length; n = next_cut(n, length, known))
        count++;
    return count;
}

/* Returns whether an earlier scene has this file. */
static bool is_known(const char *path) {
    enum { MOST = 256 };
    static char *paths[MOST];
    static size_t count;
    char *real = realpath(path, NULL);
    assert_non_null(real);
    for (size_t p = 0; p < count; p++)
        if (!strcmp(paths[p], real)) {
            free(real);
            return true;
        }
    assert_true(count < MOST);
    paths[count++] = real;
    return false;
}

static size_t tried, lived;

/* A behaviour of a scene, and its prefixes: the next has n bytes, and `done` of all were tried. */
typedef struct Saved {
    char *text;
    size_t length, n, done, all;
    bool known;
} Saved;

static void save_prefix(JoScene *scene, uint32_t m, Saved *s) {
    /* a block of exactly this size, so that a read beyond it is seen */
    char *prefix = jox_alloc(s->n + 1, 1);
    memcpy(prefix, s->text, s->n);
    bool live = replace_behaviour_text(scene, m, prefix, s->n);
    const char *path = scene->world->model.machines.items[m]->path;
    if (live && s->n + 1 < s->length)
        fail_msg("the first %zu bytes of %s are a machine", s->n, path);
    if (!live && s->n == s->length)
        fail_msg("%s: %s", path, refusal);
    jox_free(prefix);
    lived += live;
    tried++;
    s->done++;
    s->n = next_cut(s->n, s->length, s->known);
}

/* Saves the prefixes of all behaviours of a scene, of each in turn, during a run. */
static void try_prefixes(const char *path) {
    enum { MOST = 64 };
    Saved saved[MOST] = {0};
    JoScene *scene = load_small_scene(path);
    uint32_t machines = scene->world->model.machines.count;
    assert_true(machines <= MOST);
    for (uint32_t m = 0; m < machines; m++) {
        Saved *s = &saved[m];
        if (is_made(scene, m))
            continue;
        s->text = read_behaviour(scene, m, &s->length);
        s->known = is_known(scene->world->model.machines.items[m]->path);
        s->all = count_cuts(s->length, s->known);
    }
    for (int n = 1; n <= STEPS; n++) {
        for (uint32_t m = 0; m < machines; m++)
            while (saved[m].done < saved[m].all * (size_t)n / STEPS)
                save_prefix(scene, m, &saved[m]);
        step_scene(scene, 1);
    }
    for (uint32_t m = 0; m < machines; m++)
        jox_free(saved[m].text);
    if (jo_world_hash(scene->world) != hash_alone(path))
        fail_msg("%s: beginnings of its behaviours change the hash", path);
    jo_scene_free(scene);
}

static void reload_of_any_prefix_of_a_behaviour_keeps_the_hash(void **state) {
    (void)state;
    visit_all_scenes(try_prefixes);
    assert_true(lived >= 5 && tried > 1000); /* the whole files went live */
}

/* Behaviours that no scene above uses, without people. */
static void every_proper_prefix_of_a_behaviour_is_refused(void **state) {
    (void)state;
    glob_t files;
    assert_int_equal(glob("behaviours/*.lua", 0, NULL, &files), 0);
    JoxLua *lua = jox_lua_create(NULL);
    for (size_t f = 0; f < files.gl_pathc; f++) {
        size_t length, complete = 0;
        if (is_known(files.gl_pathv[f]))
            continue;
        char *text = jox_read_file(files.gl_pathv[f], LARGEST, &length);
        for (size_t n = 0; n <= length; n = next_cut(n, length, false)) {
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

/* With sanitizers visits one of EFFORT_EACH scenes. */
static void reload_all_the_time(const char *path) {
    static int visited;
    if (visited++ % EFFORT_EACH > 0)
        return;
    JoScene *scene = load_small_scene(path);
    JoError error = {0};
    assert_true(jo_scene_watch(scene, &error));
    uint32_t machines = scene->world->model.machines.count;
    for (int s = 0; s < STEPS; s++) {
        for (uint32_t m = 0; m < machines && s % 2 == 0; m++) {
            size_t length;
            if (is_made(scene, m))
                continue;
            char *text = read_behaviour(scene, m, &length);
            if (!replace_behaviour_text(scene, m, text, length))
                fail_msg("%s: %s", scene->world->model.machines.items[m]->path, refusal);
            jox_free(text);
        }
        step_scene(scene, 1);
    }
    for (uint32_t m = 0; m < machines; m++)
        assert_int_equal(scene->world->model.machines.items[m]->reloads,
                         is_made(scene, m) ? 0 : STEPS / 2);
    if (jo_world_hash(scene->world) != hash_alone(path))
        fail_msg("%s: being watched, or reloads that change nothing, change the hash", path);
    jo_scene_free(scene);
}

static void watching_and_reloads_of_the_same_text_keep_the_hash(void **state) {
    (void)state;
    visit_all_scenes(reload_all_the_time);
}

/* ---- memory ---- */

static void three_thousand_reloads_leak_no_memory(void **state) {
    (void)state;
    static const char EVEN[] =
        "local mine = memory { laps = 0, seen = false }\n" MACHINE_START
        "\"A\", defaults = { speed = uniform(1, 2), horizon = normal(1, 0.2, 0.2, 2) }, states = "
        "{\n"
        "  A = { steer = hold, push = 20 * own.horizon, { to = \"B\", when = after(0.2) } },\n"
        "  B = { steer = hold, on_enter = function(me) me.laps = me.laps + 1 end,\n"
        "    { to = \"A\", when = after(0.1) | stuck(1) } } } }\n";
    static const char ODD[] =
        "local mine = memory { seen = false, more = 1, laps = 0 }\n" MACHINE_START
        "\"B\", defaults = { speed = uniform(0.5, 1), perception = 3 }, states = {\n"
        "  B = { steer = spread, { to = \"A\", when = function(me) return me.laps > 2 end } },\n"
        "  C = { steer = hold }, A = { steer = hold, speed = own.perception / 3,\n"
        "    { to = \"B\", when = after(0.1) } } } }\n";
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(30), EVEN);
    size_t before = 0;
    for (int i = 0; i < 3200; i++) {
        if (i == 200)
            before = mallinfo2().uordblks;
        if (!reload_behaviour(scene, 0,
                              i % 3 == 2 ? "return machine { name = "
                              : i % 2    ? ODD
                                         : EVEN) &&
            i % 3 != 2)
            fail_msg("%s", refusal);
        if (i % 10 == 0)
            step_scene(scene, 1);
    }
    size_t after = mallinfo2().uordblks; /* zero under the sanitizers, which look for leaks */
    if (after > before + 300000)
        fail_msg("%zu bytes more", after - before);
    assert_int_equal(scene->world->model.machines.items[0]->reloads, 2134);
    jo_scene_free(scene);
}

/* ---- files saved during a run ---- */

static double read_wall_clock(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* Steps until the scene has sent a message with the text, for 10 s at most. */
static bool step_until_message(JoScene *scene, const char *text) {
    for (double begun = read_wall_clock(); read_wall_clock() - begun < 10.0;) {
        step_scene(scene, 1);
        if (scene_messages.data && strstr(scene_messages.data, text))
            return true;
        usleep(500);
    }
    return false;
}

static void saved_file_goes_live(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(20), STANDING_AT_SPEED("1.5", ""));
    JoError error = {0};
    assert_true(jo_scene_watch(scene, &error));
    step_scene(scene, 5);
    write_test_file("own.lua", STANDING_AT_SPEED("0.5", ""));
    assert_true(step_until_message(scene, "reload 1 is live"));
    assert_true(read_wanted_speed(scene, 3) == 0.5);
    write_test_file("own.lua", "return machine {");
    assert_true(step_until_message(scene, "Reload 1 keeps running"));
    for (int i = 0; i < 30; i++) { /* saved repeatedly during the run */
        char text[200];
        snprintf(text, sizeof text, STANDING_AT_SPEED("1.%02d", ""), i);
        write_test_file("own.lua", text);
        step_scene(scene, 3);
    }
    write_test_file("own.lua", STANDING_AT_SPEED("1.9", ""));
    for (double begun = read_wall_clock();
         read_wanted_speed(scene, 3) != (double)1.9f && read_wall_clock() - begun < 10.0;)
        step_scene(scene, 1), usleep(500);
    assert_true(read_wanted_speed(scene, 3) == (double)1.9f);
    write_test_file("own.lua", STANDING_AT_SPEED(
                                   "1.1", "")); /* the scene is freed while this is being loaded */
    usleep(40000);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reload_of_any_prefix_of_a_behaviour_keeps_the_hash),
        cmocka_unit_test(every_proper_prefix_of_a_behaviour_is_refused),
        cmocka_unit_test(watching_and_reloads_of_the_same_text_keep_the_hash),
        cmocka_unit_test(three_thousand_reloads_leak_no_memory),
        cmocka_unit_test(saved_file_goes_live),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
