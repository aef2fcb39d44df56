/* Tests of what a program can provide to the engine: files in memory, threads, an allocator. */
#include "jostle_host.h"
#include "unit/scene_loader.h"

#define HALL "jostle: 1\ngroups: {some: {behaviour: walk.lua, at: [[0, 0], [2, 0]]}}\n"
#define WALK_ON                                                                                    \
    "local pace = require 'pace'\n"                                                                \
    "return machine { name = 'walk', start = 'Walk', defaults = { speed = pace }, states = {\n"    \
    "  Walk = { steer = drift(1, 0) } } }\n"
#define FILE_OF(path, text)                                                                        \
    { path, text, sizeof text - 1 }

static JoScene *load_files(const JoFile *files, size_t count, bool only, JoError *error) {
    JoSceneDef def = jo_default_scene_def();
    *error = (JoError){0};
    def.path = "nowhere/scenes/hall.yaml";
    def.files = files;
    def.file_count = count;
    def.files_only = only;
    def.threads = 1;
    def.message = ignore_message;
    return jo_scene_load(&def, error);
}

static void scenes_are_read_from_memory(void **state) {
    (void)state;
    const JoFile files[] = {FILE_OF("nowhere/scenes/hall.yaml", HALL),
                            FILE_OF("nowhere/behaviours/walk.lua", WALK_ON),
                            FILE_OF("nowhere/behaviours/pace.lua", "return 1.5\n")};
    JoError error;
    for (int only = 0; only < 2; only++) {
        JoScene *scene = load_files(files, 3, only, &error);
        if (!scene)
            fail_msg("%s:%d: %s", error.file, error.line, error.text);
        step_scene(scene, 20);
        assert_float_equal(scene->world->state.agents.vx[0], 1.5, 0.01);
        jo_scene_free(scene);
    }
}

static void missing_file_is_reported(void **state) {
    (void)state;
    const JoFile files[] = {FILE_OF("nowhere/scenes/hall.yaml", HALL),
                            FILE_OF("nowhere/behaviours/walk.lua", WALK_ON)};
    JoError error;
    assert_null(load_files(files, 2, true, &error));
    assert_non_null(strstr(error.text, "pace"));
    assert_string_equal(error.file, "nowhere/behaviours/walk.lua");
    assert_null(load_files(files, 1, true, &error));
    assert_non_null(strstr(error.text, "walk"));
    assert_null(load_files(NULL, 0, true, &error));
    assert_non_null(strstr(error.text, "hall.yaml"));
}

/* With `files_only` no file is read from the disk. */
static void files_only_reads_nothing_from_the_disk(void **state) {
    (void)state;
    JoError error;
    JoSceneDef def = jo_default_scene_def();
    write_test_file("own.lua", MACHINE_START "\"A\", states = { A = { steer = hold } } }\n");
    def.path = write_test_file("scene.yaml",
                               "jostle: 1\ngroups: {one: {behaviour: own.lua, at: [[0, 0]]}}\n");
    def.message = ignore_message;
    JoScene *scene = jo_scene_load(&def, &error);
    assert_non_null(scene);
    jo_scene_free(scene);
    def.files_only = true;
    assert_null(jo_scene_load(&def, &error));
}

/* Texts replace files of a running scene at once, all that belong together or none. */
static void texts_replace_files_of_a_running_scene(void **state) {
    (void)state;
    const JoFile files[] = {FILE_OF("nowhere/scenes/hall.yaml", HALL),
                            FILE_OF("nowhere/behaviours/walk.lua", WALK_ON),
                            FILE_OF("nowhere/behaviours/pace.lua", "return 1.5\n")};
    const JoFile slower = FILE_OF("nowhere/behaviours/pace.lua", "return 0.5\n");
    const JoFile wrong = FILE_OF("nowhere/behaviours/pace.lua", "return 0.5 +\n");
    const JoFile turned[] = {FILE_OF("nowhere/behaviours/walk.lua", MACHINE_START
                                     "\"Walk\", defaults = { speed = require 'pace' }, "
                                     "states = { Walk = { steer = drift(-1, 0) } } }\n")};
    JoError error;
    JoScene *scene = load_files(files, 3, true, &error);
    assert_non_null(scene);
    step_scene(scene, 20);
    assert_false(jo_scene_reload(scene, &wrong, 1, &error));
    assert_string_equal(error.file, "nowhere/behaviours/pace.lua");
    assert_int_equal(error.line, 2);
    step_scene(scene, 20);
    assert_float_equal(scene->world->state.agents.vx[0], 1.5, 0.01); /* goes on */
    assert_true(jo_scene_reload(scene, &slower, 1, &error));
    step_scene(scene, 40);
    assert_float_equal(scene->world->state.agents.vx[0], 0.5, 0.01);
    /* the text that was refused is forgotten: the next reload reads the last good one */
    assert_false(jo_scene_reload(scene, &wrong, 1, &error));
    assert_true(jo_scene_reload(scene, turned, 1, &error));
    step_scene(scene, 40);
    assert_float_equal(scene->world->state.agents.vx[0], -0.5, 0.01);
    /* The last of two texts for one path counts; both are forgotten if it is refused. */
    const JoFile twice[] = {wrong, FILE_OF("nowhere/behaviours/pace.lua", "return 0.5 -\n"),
                            slower};
    assert_false(jo_scene_reload(scene, twice, 2, &error));
    assert_true(jo_scene_reload(scene, turned, 1, &error));
    assert_true(jo_scene_reload(scene, twice, 3, &error));
    jo_scene_free(scene);
}

/* A file that nothing reads is named as an error, and kept for a version that reads it. */
static void reload_names_files_that_nothing_reads(void **state) {
    (void)state;
    const JoFile files[] = {FILE_OF("nowhere/scenes/hall.yaml", HALL),
                            FILE_OF("nowhere/behaviours/walk.lua", WALK_ON),
                            FILE_OF("nowhere/behaviours/pace.lua", "return 1.5\n")};
    const JoFile both[] = {FILE_OF("nowhere/behaviours/pace.lua", "return 0.5\n"),
                           FILE_OF("nowhere/behaviours/rush.lua", "return 1\n")};
    const JoFile reader = FILE_OF("nowhere/behaviours/walk.lua",
                                  MACHINE_START "\"Walk\", defaults = { speed = require 'rush' }, "
                                                "states = { Walk = { steer = drift(1, 0) } } }\n");
    JoError error;
    JoScene *scene = load_files(files, 3, true, &error);
    assert_non_null(scene);
    assert_false(jo_scene_reload(scene, both, 2, &error));
    assert_string_equal(error.file, "nowhere/behaviours/rush.lua");
    assert_non_null(strstr(error.text, "no behaviour or scene of this run reads"));
    step_scene(scene, 40);
    assert_float_equal(scene->world->state.agents.vx[0], 0.5, 0.01); /* the other one is live */
    assert_true(jo_scene_reload(scene, &reader, 1, &error));
    step_scene(scene, 40);
    assert_float_equal(scene->world->state.agents.vx[0], 1, 0.01);
    jo_scene_free(scene);
}

static int misuses;

static void count_misuse(const char *condition, const char *file, int line) {
    (void)condition, (void)file, (void)line;
    misuses++;
}

static void reload_in_message(void *context, const char *text) {
    (void)text;
    const JoFile slower = FILE_OF("nowhere/behaviours/pace.lua", "return 0.5\n");
    JoError error;
    assert_false(jo_scene_reload(*(JoScene **)context, &slower, 1, &error));
}

/* A message of a reload cannot begin another one, which would swap what the first still holds. */
static void reload_refuses_another_one_in_its_messages(void **state) {
    (void)state;
    const JoFile files[] = {FILE_OF("nowhere/scenes/hall.yaml", HALL),
                            FILE_OF("nowhere/behaviours/walk.lua", WALK_ON),
                            FILE_OF("nowhere/behaviours/pace.lua", "return 1.5\n")};
    const JoFile other = FILE_OF("nowhere/behaviours/pace.lua", "return 1\n");
    JoError error;
    JoScene *scene = load_files(files, 3, true, &error);
    assert_non_null(scene);
    scene->message = reload_in_message;
    scene->message_context = &scene;
    jo_set_assert_handler(count_misuse);
    assert_true(jo_scene_reload(scene, &other, 1, &error));
    jo_set_assert_handler(NULL);
    assert_true(misuses > 0);
    scene->message = ignore_message;
    step_scene(scene, 40);
    assert_float_equal(scene->world->state.agents.vx[0], 1, 0.01);
    jo_scene_free(scene);
}

/* ---- threads ---- */

static uint32_t rounds, most;

/* Runs jobs one after another, from the last to the first, as no job may wait for another. */
static void run_jobs_in_turn(void *context, uint32_t count, void (*job)(void *, uint32_t),
                             void *data) {
    assert_ptr_equal(context, &rounds);
    rounds++;
    most = count > most ? count : most;
    while (count-- > 0)
        job(data, count);
}

static void loops_run_on_the_threads_of_the_program(void **state) {
    (void)state;
    const JoJobs jobs = {run_jobs_in_turn, &rounds};
    uint64_t hashes[2];
    for (int own = 0; own < 2; own++) {
        JoWorldDef def = jo_default_world_def();
        def.threads = 3;
        def.jobs = own ? &jobs : NULL;
        JoWorld *world = jo_world_create(&def, NULL);
        JoAgentDef agent = jo_default_agent_def();
        for (int n = 0; n < 1600; n++) {
            agent.x = n % 40;
            agent.y = (double)(n / 40);
            jo_agent_set_preferred(world, jo_world_add_agent(world, &agent, NULL), 1, 0.2 * n);
        }
        jo_world_step(world, 10);
        hashes[own] = jo_world_hash(world);
        jo_world_free(world);
    }
    assert_true(hashes[0] == hashes[1]);
    assert_true(rounds > 10);
    assert_int_equal(most, 3);
}

/* ---- memory ---- */

static void *fail_allocation(void *context, size_t bytes) {
    (void)context;
    (void)bytes;
    return NULL;
}
static void *fail_reallocation(void *context, void *memory, size_t bytes) {
    (void)context;
    (void)memory;
    (void)bytes;
    return NULL;
}
static void fail_release(void *context, void *memory) {
    (void)context;
    (void)memory;
    fail();
}

/* tests/install/host.c tests an allocator that is set first. */
static void allocator_must_be_set_before_other_calls(void **state) {
    (void)state;
    const JoAllocator late = {fail_allocation, fail_reallocation, fail_release, NULL};
    JoError error = {0};
    JoWorldDef def = jo_default_world_def();
    jo_world_free(jo_world_create(&def, NULL));
    assert_false(jo_set_allocator(&late, &error));
    assert_int_equal(error.code, JO_USAGE);
    assert_non_null(strstr(error.text, "before all else"));
    JoWorld *world = jo_world_create(&def, NULL);
    assert_non_null(world); /* the first allocator stays */
    jo_world_free(world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_are_read_from_memory),
        cmocka_unit_test(missing_file_is_reported),
        cmocka_unit_test(files_only_reads_nothing_from_the_disk),
        cmocka_unit_test(texts_replace_files_of_a_running_scene),
        cmocka_unit_test(reload_names_files_that_nothing_reads),
        cmocka_unit_test(reload_refuses_another_one_in_its_messages),
        cmocka_unit_test(loops_run_on_the_threads_of_the_program),
        cmocka_unit_test(allocator_must_be_set_before_other_calls),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
