/* Tests of people who wait in areas that walls and bodies divide: they reach their spots by open
 * ways, stand apart and come to rest, also if there is no room for all. */
#include <math.h>

#include "unit/gate_ball_scene.h"

typedef struct Rest {
    uint32_t inside;  /* people in the place 'front' */
    uint32_t densest; /* most people within 0.56 m of a person, that one included: people per m2 */
    uint32_t moved;   /* people who moved by more than 0.25 m in the last 5 s */
} Rest;

enum { MOST_PEOPLE = 200 };

static uint32_t count_about(const JoxAgents *a, uint32_t i) {
    uint32_t count = 0;
    for (uint32_t j = 0; j < a->count; j++)
        count += hypotf(a->x[j] - a->x[i], a->y[j] - a->y[i]) < 0.564f;
    return count;
}

/* Runs for `seconds`, measures 5 s more, and frees the scene. */
static Rest measure_rest(JoScene *scene, double seconds) {
    const JoxAgents *a = &scene->world->state.agents;
    JoxV2 before[MOST_PEOPLE];
    Rest rest = {0};
    step_scene_seconds(scene, seconds);
    assert_in_range(a->count, 1, MOST_PEOPLE);
    const uint32_t first = a->next_id - a->count; /* nobody left */
    for (uint32_t i = 0; i < a->count; i++)
        before[a->id[i] - first] = jox_v2(a->x[i], a->y[i]);
    step_scene_seconds(scene, 5);
    for (uint32_t i = 0; i < a->count; i++) {
        const JoxV2 at = {a->x[i], a->y[i]};
        const uint32_t about = count_about(a, i);
        rest.inside += jox_place_contains(scene->world->model.places, 0, at);
        rest.densest = about > rest.densest ? about : rest.densest;
        rest.moved += jox_length(jox_sub(at, before[a->id[i] - first])) > 0.25f;
    }
    jo_scene_free(scene);
    return rest;
}

/* Loads a scene whose place `front` has index 0. */
static JoScene *load_room(const char *front, const char *walls, const char *people,
                          const char *more) {
    char text[2000];
    snprintf(text, sizeof text,
             "jostle: 1\nplaces:\n  front: {polygon: %s}\n  out: {point: [-50, -50]}\n%s\n"
             "walls:\n%s\nevents: [{at: 900, signal: end}]\n%s",
             front, people, walls, more);
    return load_scene_text(text, "");
}

#define JOURNEY "journey: [{to: front, until: end}, {exit: out}]}"

/* Straight ways to many of the spots lead through walls. A regression: 6 people stood on a square
 * metre. */
static void people_go_round_walls_to_their_spots(void **state) {
    (void)state;
    const Rest rest = measure_rest(
        load_room("[[4, 0], [8, 0], [8, 4], [12, 4], [12, 8], [8, 8], [8, 12], [4, 12], [4, 8],"
                  " [0, 8], [0, 4], [4, 4]]",
                  "  - {line: [[5, 0], [4, 0], [4, 4], [0, 4], [0, 8], [4, 8], [4, 12], [8, 12],"
                  " [8, 8], [12, 8], [12, 4], [8, 4], [8, 0], [6.4, 0]]}",
                  "  yard: {polygon: [[0, -8], [12, -8], [12, -1], [0, -1]]}",
                  "groups: {a: {count: 130, in: yard, " JOURNEY "}"),
        75);
    assert_true(rest.inside >= 128);
    assert_in_range(rest.densest, 1, 4);
    assert_in_range(rest.moved, 0, 3);
}

static void people_go_round_pillars_to_their_spots(void **state) {
    (void)state;
    const Rest rest = measure_rest(
        load_room("[[0, 0], [12, 0], [12, 12], [8, 12], [8, 4], [4, 4], [4, 12], [0, 12]]",
                  "  - {line: [[0, 0.5], [0, 12], [4, 12], [4, 4], [8, 4], [8, 12], [12, 12],"
                  " [12, 0], [0.6, 0]]}\n"
                  "  - {solid: [[1.5, 9], [2.1, 9], [2.1, 9.6], [1.5, 9.6]]}\n"
                  "  - {solid: [[9.5, 7], [10.1, 7], [10.1, 7.6], [9.5, 7.6]]}",
                  "  arm: {polygon: [[0.5, 6], [3.5, 6], [3.5, 8.5], [0.5, 8.5]]}\n"
                  "  stage: {point: [10, 11.5]}",
                  "groups: {a: {count: 60, in: arm, journey: [{to: front, front: stage,"
                  " until: end}, {exit: out}]}}"),
        60);
    assert_int_equal(rest.inside, 60);
    assert_in_range(rest.densest, 1, 4);
    assert_in_range(rest.moved, 0, 2);
}

/* A regression: all spots were on one side of the wall, and on the other 8 people stood on a square
 * metre. */
static void both_sides_of_a_wall_are_filled(void **state) {
    (void)state;
    const Rest rest =
        measure_rest(load_room("[[1, 6], [15, 6], [15, 12], [1, 12]]",
                               "  - {line: [[0, 0.5], [0, 14], [16, 14], [16, 0], [0.6, 0]]}\n"
                               "  - {line: [[9, 4], [9, 14]]}",
                               "  left: {polygon: [[1, 1], [7, 1], [7, 3], [1, 3]]}\n"
                               "  right: {polygon: [[10, 1], [15, 1], [15, 3], [10, 3]]}",
                               "groups:\n  a: {count: 60, in: left, " JOURNEY "\n"
                               "  b: {count: 60, in: right, " JOURNEY),
                     45);
    assert_true(rest.inside >= 115); /* some stand on the edge */
    assert_in_range(rest.densest, 1, 4);
    assert_in_range(rest.moved, 0, 3);
}

/* Four times as many people as the place has room for. A regression: they drifted round it for
 * ever. */
static void people_without_room_stand_still_round_the_area(void **state) {
    (void)state;
    JoScene *scene = load_room("[[5, 9], [7, 9], [7, 11], [5, 11]]",
                               "  - {line: [[0, 0.5], [0, 12], [12, 12], [12, 0], [0.6, 0]]}",
                               "  hall: {polygon: [[1, 1], [11, 1], [11, 7], [1, 7]]}",
                               "groups: {a: {count: 80, in: hall, " JOURNEY "}");
    step_scene_seconds(scene, 40);
    JoxV2 before[MOST_PEOPLE];
    const JoxAgents *a = &scene->world->state.agents;
    for (uint32_t i = 0; i < a->count; i++)
        before[a->id[i]] = jox_v2(a->x[i], a->y[i]);
    step_scene_seconds(scene, 30);
    uint32_t drifted = 0, inside = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        const JoxV2 at = {a->x[i], a->y[i]};
        drifted += jox_length(jox_sub(at, before[a->id[i]])) > 0.2f;
        inside += jox_place_contains(scene->world->model.places, 0, at);
    }
    assert_int_equal(a->count, 80);
    JoFigures *told = jo_scene_figures(scene);
    assert_float_equal(jo_figure(told, "events.most_without_spot"), 66, 6);
    jo_free(told);
    assert_in_range(inside, 16, 26);
    assert_in_range(drifted, 0, 12);
    jo_scene_free(scene);
}

static void spots_keep_clear_of_fixed_bodies(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene =
        load_room("[[3, 9], [17, 9], [17, 15], [3, 15]]",
                  "  - {line: [[0, 0.5], [0, 18], [20, 18], [20, 0], [0.6, 0]]}",
                  "  hall: {polygon: [[0.5, 0.5], [19.5, 0.5], [19.5, 6], [0.5, 6]]}",
                  "groups: {a: {count: 100, in: hall, " JOURNEY "}\n"
                  "bodies: [{shape: {box: {size: [5, 2, 1.2]}}, mass: 0, at: [10, 12, 0.6]}]");
    const JoxAgents *a = &scene->world->state.agents;
    step_scene_seconds(scene, 45);
    uint32_t pressed = 0;
    for (uint32_t i = 0; i < a->count; i++) /* within a radius and 2 cm of the box */
        pressed += fabsf(a->x[i] - 10) < 2.71f && fabsf(a->y[i] - 12) < 1.21f;
    assert_in_range(pressed, 0, 2);
    const Rest rest = measure_rest(scene, 1);
    assert_true(rest.inside >= 95);
    assert_in_range(rest.moved, 0, 4);
}

/* `gather` leads to the area also from far away and from behind a wall. */
static void distant_people_come_by_routes(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\nplaces:\n"
        "  front: {polygon: [[0, 0], [6, 0], [6, 4], [0, 4]]}\n"
        "  far: {polygon: [[0, -14], [6, -14], [6, -11], [0, -11]]}\n"
        "walls: [{line: [[-8, 2], [-8, -6], [14, -6], [14, 6]]}]\n"
        "groups: {a: {behaviour: own.lua, count: 20, in: far}}\n",
        MACHINE_START "\"Wait\", defaults = { speed = 1.3, time_gap = 0.5, perception = 3 },"
                      " states = { Wait = { steer = gather(\"front\", 90) } } }\n");
    const Rest rest = measure_rest(scene, 50);
    assert_true(rest.inside >= 19); /* people in front move a little on its edge */
    assert_in_range(rest.moved, 0, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(people_go_round_walls_to_their_spots),
        cmocka_unit_test(people_go_round_pillars_to_their_spots),
        cmocka_unit_test(both_sides_of_a_wall_are_filled),
        cmocka_unit_test(people_without_room_stand_still_round_the_area),
        cmocka_unit_test(spots_keep_clear_of_fixed_bodies),
        cmocka_unit_test(distant_people_come_by_routes),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
