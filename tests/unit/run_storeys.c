/* Runs of scenes with storeys: people find their way over stairs, also stairs one above the other.
 */
#include "unit/scene_loader.h"

#define TOWER                                                                                      \
    "jostle: 1\n"                                                                                  \
    "storeys: {ground: {height: 0}, first: {height: 3.5}, second: {height: 7}}\n"                  \
    "stairs:\n"                                                                                    \
    "  a: {from: ground, to: first, path: [[8, 2], [12, 2], [12, 3.6], [8, 3.6]], width: 1.4}\n"   \
    "  b: {from: first, to: second, path: [[8, 2], [12, 2], [12, 3.6], [8, 3.6]], width: 1.4}\n"   \
    "walls:\n"                                                                                     \
    "  - {line: [[0, 9], [0, 0], [20, 0], [20, 12], [0, 12], [0, 11]]}\n"                          \
    "  - {line: [[0, 0], [20, 0], [20, 12], [0, 12]], closed: true, storey: [first, second]}\n"    \
    "places:\n"                                                                                    \
    "  one: {polygon: [[2, 1], [18, 1], [18, 11], [2, 11]], storey: first}\n"                      \
    "  two: {polygon: [[2, 1], [18, 1], [18, 11], [2, 11]], storey: second}\n"                     \
    "  street: {line: [[-2, 8], [-2, 12]]}\n"                                                      \
    "groups: {people: {count: 30, in: [one, two], journey: [{exit: street}]}}\n"

static void stairs_one_above_the_other_empty_a_tower(void **state) {
    (void)state;
    JoScene *scene = load_scene_file(write_test_file("scene.yaml", TOWER), NULL, 0);
    const JoWorld *w = scene->world;
    assert_null(scene_messages.data);
    for (uint32_t i = 0; i < w->state.agents.count; i++) /* nobody starts below a stair */
        assert_true(
            jox_is_floor(&w->model.storeys, jox_v2(w->state.agents.x[i], w->state.agents.y[i])));
    step_scene_seconds(scene, 60);
    assert_int_equal(w->state.agents.count, 0);
    jo_scene_free(scene);
}

#define TWO_STAIRS                                                                                 \
    "jostle: 1\n"                                                                                  \
    "storeys: {ground: {height: 0}, first: {height: 3}}\n"                                         \
    "stairs:\n"                                                                                    \
    "  near: {from: ground, to: first, path: [[18, 3], [13, 3]], width: 1.4}\n"                    \
    "  far: {from: ground, to: first, path: [[18, 9], [13, 9]], width: 1.4}\n"                     \
    "walls: [{line: [[0, 0], [20, 0], [20, 12], [0, 12]], closed: true, storey: first}]\n"         \
    "places: {hall: {polygon: [[1, 1], [5, 1], [5, 5], [1, 5]], storey: first}, "                  \
    "street: {line: [[26, 5], [26, 1]]}}\n"                                                        \
    "groups: {people: {count: 12, in: hall, journey: [{exit: street}]}}\n"                         \
    "events: [{at: 1, close: near}, {at: 100, open: near}]\n"

static void nobody_sets_out_over_a_closed_stair(void **state) {
    (void)state;
    JoScene *scene = load_scene_file(write_test_file("scene.yaml", TWO_STAIRS), NULL, 0);
    JoWorld *w = scene->world;
    JoxText why = {0}, saved = {0};
    JoError error;
    uint32_t on_far = 0;
    for (int s = 0; s < 40; s++) {
        step_scene_seconds(scene, 1);
        for (uint32_t i = 0; i < w->state.agents.count; i++) {
            const int32_t stair =
                jox_stair_at(&w->model.storeys, jox_v2(w->state.agents.x[i], w->state.agents.y[i]));
            assert_true(stair != 0);
            on_far += stair == 1;
        }
    }
    assert_true(on_far > 0);
    assert_int_equal(w->state.agents.count, 0);
    assert_true(jox_world_snapshot(w, &saved, &error));
    assert_false(jox_event_open(w, "farr", true, &why));
    assert_non_null(strstr(why.data, "no wall or stair named 'farr'. Did you mean 'far'?"));
    assert_true(jox_event_open(w, "near", true, &why));
    assert_false(w->model.storeys.stairs[0].closed);
    assert_true(jox_world_restore(w, saved.data, saved.length, &error));
    assert_true(w->model.storeys.stairs[0].closed); /* part of the state */
    jox_text_free(&saved);
    jox_text_free(&why);
    jo_scene_free(scene);
}

/* Edits that change storeys, stairs or how deep the plan is wait for the next start, whole; others
   are taken over on their sheets. */
static void edits_that_move_sheets_wait(void **state) {
    (void)state;
    char text[2000];
    JoScene *scene = load_scene_file(write_test_file("scene.yaml", TWO_STAIRS), NULL, 0);
    const JoxPlace *street = &scene->world->model.places[1];
    step_scene_seconds(scene, 1);
    snprintf(text, sizeof text, "%s%s", TWO_STAIRS, "floor: wood\n");
    memcpy(strstr(text, "[26, 5]"), "[27, 5]", 7);
    edit_scene(scene, text);
    assert_non_null(strstr(scene_messages.data, "places, floor changed, live"));
    assert_true(street->points[0].x == 27.0f);
    memcpy(strstr(text, "[27, 5]"), "[27, 6]", 7);
    memcpy(strstr(text, "width: 1.4"), "width: 1.6", 10);
    edit_scene(scene, text);
    assert_non_null(strstr(scene_messages.data, "places, stairs (the world is made with them): "
                                                "takes effect at the next start"));
    assert_true(street->points[0].y == 5.0f);
    snprintf(text, sizeof text, "%s%s", TWO_STAIRS, "regions: {a: [[0, 90], [1, 90], [1, 91]]}\n");
    edit_scene(scene, text);
    assert_non_null(strstr(scene_messages.data, "as storeys are laid out anew"));
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stairs_one_above_the_other_empty_a_tower),
        cmocka_unit_test(nobody_sets_out_over_a_closed_stair),
        cmocka_unit_test(edits_that_move_sheets_wait),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
