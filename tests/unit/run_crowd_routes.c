/* Tests of routes round a crowd in a running scene: their fields are made, renewed and dropped, for
 * agents of the walking law alone, and are equal for any number of threads and after a restore. */
#include "unit/gate_ball_scene.h"

/* A room with a narrow door (about y = 2) and a wide one (about y = 9) to the goal. */
#define ROOM(slowing)                                                                              \
    "jostle: 1\nwalking: {crowd_slowing: " slowing "}\n"                                           \
    "places:\n"                                                                                    \
    "  front: {polygon: [[2, 0.5], [5.5, 0.5], [5.5, 5], [2, 5]]}\n"                               \
    "  goal: {polygon: [[9, 0], [11, 0], [11, 4], [9, 4]]}\n"                                      \
    "walls:\n"                                                                                     \
    "  - {line: [[12, 0], [0, 0], [0, 11], [12, 11]]}\n"                                           \
    "  - {line: [[6, 0], [6, 1.6]]}\n"                                                             \
    "  - {line: [[6, 2.4], [6, 8]]}\n"                                                             \
    "  - {line: [[6, 10], [6, 11]]}\n"                                                             \
    "groups: {people: {behaviour: own.lua, count: 60, fill: random, in: front}}\n"
#define GOES(gap)                                                                                  \
    MACHINE_START "\"Go\", defaults = { time_gap = " gap ", speed = 1.3 }, states = {\n"           \
                  "Go = { steer = field \"goal\", { to = \"Gone\", when = inside \"goal\" } },\n"  \
                  "Gone = { removes = true } } }\n"

static const JoxField *find_crowd_field(const JoScene *scene) {
    uint32_t goal = 1; /* in the order of the scene */
    return scene->world->machines.fields[goal * JOX_ROUTE_KINDS + JOX_ROUTE_CROWD];
}

/* Counts the people who left through the wide door. */
static int run_until_empty(JoScene *scene, int *seen, int *steps) {
    int wide = 0;
    const JoxAgents *a = &scene->world->state.agents;
    *seen = 0;
    for (*steps = 0; *steps < 2400 && a->count > 0; ++*steps) {
        step_scene(scene, 1);
        *seen += find_crowd_field(scene) != NULL;
        for (uint32_t i = 0; i < a->count; i++)
            wide += a->prev_x[i] < 6.0f && a->x[i] >= 6.0f && a->y[i] > 5.0f;
    }
    return wide;
}

static void crowd_field_is_made_renewed_and_dropped(void **state) {
    (void)state;
    int seen, steps;
    JoScene *scene = load_scene_text(ROOM("2"), GOES("1"));
    step_scene(scene, 1);
    assert_null(find_crowd_field(scene)); /* nobody is held up yet */
    assert_true(run_until_empty(scene, &seen, &steps) > 5);
    assert_int_equal(scene->world->state.agents.count, 0);
    assert_true(seen > 60 && seen < steps - 10); /* it was dropped before the last had left */
    jo_scene_free(scene);
}

static void agents_without_time_gap_request_no_crowd_field(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(ROOM("2"), GOES("0"));
    for (int n = 0; n < 200; n++) {
        step_scene(scene, 1);
        assert_null(find_crowd_field(scene));
    }
    for (uint32_t i = 0; i < scene->world->state.agents.count; i++)
        assert_int_equal(scene->world->state.agents.bound[i], 0);
    jo_scene_free(scene);
}

/* A crowd that slows nobody down is not avoided. */
static void crowd_that_slows_nobody_is_not_avoided(void **state) {
    (void)state;
    int seen, steps;
    JoScene *scene = load_scene_text(ROOM("0"), GOES("1"));
    assert_int_equal(run_until_empty(scene, &seen, &steps), 0);
    assert_int_equal(scene->world->state.agents.count, 0);
    jo_scene_free(scene);
}

/* Records the hashes of steps with one field in use and the next being made. */
enum { STEPS = 200 };

static void record_step_hashes(JoScene *scene, uint64_t hashes[STEPS]) {
    for (int n = 0; n < STEPS; n++) {
        step_scene(scene, 1);
        hashes[n] = jo_world_hash(scene->world);
    }
}

static void crowd_fields_are_equal_for_any_thread_count(void **state) {
    (void)state;
    uint64_t one[STEPS], more[STEPS];
    for (int threads = 1; threads <= 4; threads *= 2) {
        JoScene *scene = load_scene_text(ROOM("2"), GOES("1"));
        jox_pool_free(scene->world->scratch.pool);
        scene->world->scratch.pool = jox_pool_create(threads);
        record_step_hashes(scene, threads == 1 ? one : more);
        assert_non_null(find_crowd_field(scene));
        if (threads > 1)
            assert_memory_equal(one, more, sizeof one);
        jo_scene_free(scene);
    }
}

static void restored_crowd_field_continues_exactly(void **state) {
    (void)state;
    for (int before = 60; before <= 72; before += 3) { /* between renewals, and while one is made */
        JoScene *scene = load_scene_text(ROOM("2"), GOES("1"));
        JoxText saved = {0};
        JoError error = {0};
        uint64_t first[STEPS], second[STEPS];
        step_scene(scene, before);
        assert_true(jox_world_snapshot(scene->world, &saved, &error));
        JoxAgents *a = &scene->world->state.agents;
        uint32_t one = jox_agents_find(a, 7); /* the order of the columns is no state */
        uint32_t bound = a->bound[one];
        float eager = a->eager[one];
        JoxV2 course = {a->course_x[one], a->course_y[one]};
        assert_int_equal(bound, jox_reference(1));
        assert_true(eager > 0.0f && fabsf(jox_length(course) - 1.0f) < 1e-4f);
        record_step_hashes(scene, first);
        assert_true(jox_world_restore(scene->world, saved.data, saved.length, &error));
        one = jox_agents_find(a, 7);
        assert_int_equal(a->bound[one], bound);
        assert_true(a->eager[one] == eager);
        assert_true(a->course_x[one] == course.x && a->course_y[one] == course.y);
        record_step_hashes(scene, second);
        assert_memory_equal(first, second, sizeof first);
        /* Each of these values is hashed, as future steps depend on it. */
        uint64_t now = jo_world_hash(scene->world);
        a->eager[0] += 0.25f;
        assert_true(jo_world_hash(scene->world) != now);
        a->eager[0] -= 0.25f;
        a->course_x[0] += 0.25f;
        assert_true(jo_world_hash(scene->world) != now);
        a->course_x[0] -= 0.25f;
        a->bound[0] = 0;
        assert_true(jo_world_hash(scene->world) != now);
        jox_text_free(&saved);
        jo_scene_free(scene);
    }
}

static void places_beyond_the_most_fields_are_told(void **state) {
    (void)state;
    JoxText text = {0};
    jox_text_add(&text, "jostle: 1\nplaces:\n");
    for (int p = 0; p < 514; p++)
        jox_text_printf(&text, "  p%d: {point: [%g, %g], radius: 0.1}\n", p, 0.4 * (p % 20),
                        0.4 * (p / 20));
    jox_text_add(&text, "groups:\n");
    for (int p = 0; p < 514; p++)
        jox_text_printf(
            &text, "  g%d: {behaviour: own.lua, at: [[%g, %g]], set: {goal: p%d, radius: 0.1}}\n",
            p, 0.4 * (p % 20) + 0.2, 0.4 * (p / 20), p);
    JoScene *scene = load_scene_text(text.data, MACHINE_START
                                     "\"Go\", states = { Go = { steer = field(own.goal) } } }\n");
    step_scene(scene, 3);
    assert_non_null(scene_messages.data);
    const char *said = strstr(scene_messages.data, "ways lead to 512 places at most");
    assert_non_null(said);
    assert_null(strstr(said + 1, "ways lead to 512 places at most")); /* once */
    jox_text_free(&text);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crowd_field_is_made_renewed_and_dropped),
        cmocka_unit_test(crowd_that_slows_nobody_is_not_avoided),
        cmocka_unit_test(agents_without_time_gap_request_no_crowd_field),
        cmocka_unit_test(crowd_fields_are_equal_for_any_thread_count),
        cmocka_unit_test(restored_crowd_field_continues_exactly),
        cmocka_unit_test(places_beyond_the_most_fields_are_told),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
