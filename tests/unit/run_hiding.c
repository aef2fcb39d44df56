/* Tests of the obstacles that hide people from each other, and of those that stop signals. */
#include "unit/scene_loader.h"

#define PAIR(more) "jostle: 1\ngroups: {people: {behaviour: own.lua, at: [[0, 0], [3, 0]]}}\n" more
#define LOOKS                                                                                      \
    MACHINE_START "\"A\", defaults = { perception = 10 }, states = {\n"                            \
                  "  A = { steer = hold, { to = \"Seen\", when = sees(nearest \"anyone\") } },\n"  \
                  "  Seen = { steer = hold } } }\n"
#define CALLS                                                                                      \
    MACHINE_START "\"A\", defaults = { perception = 10 }, states = {\n"                            \
                  "  A = { steer = hold, signal = { \"call\", every = 0.1 },\n"                    \
                  "    { to = \"Heard\", when = heard \"call\" } },\n"                             \
                  "  Heard = { steer = hold } } }\n"
#define CRATE(size, at, more) "bodies: [{shape: {box: {size: " size "}}, at: " at more "}]\n"

/* Returns whether two agents notice each other within 0.5 s; checks that both do, or neither. */
static bool notice_each_other(const char *text, const char *behaviour) {
    JoScene *scene = load_scene_text(text, behaviour);
    step_scene(scene, 10);
    const bool first = scene->world->state.agents.state[0] > 0;
    assert_int_equal(first, scene->world->state.agents.state[1] > 0);
    jo_scene_free(scene);
    return first;
}

static void tall_wide_bodies_hide_people(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    assert_true(notice_each_other(PAIR(""), LOOKS));
    assert_false(notice_each_other(PAIR(CRATE("[1, 1, 3]", "[1.5, 0, 1.5]", ", mass: 0")), LOOKS));
    assert_false(
        notice_each_other(PAIR(CRATE("[1, 1, 3]", "[1.5, 0, 1.5]", ", mass: 500")), LOOKS));
    assert_false(
        notice_each_other(PAIR("bodies: [{shape: {cylinder: {radius: 0.4, height: 2}}, mass: 0, "
                               "at: [1.5, 0.1, 1]}]\n"),
                          LOOKS));
    assert_true(notice_each_other(PAIR(CRATE("[1, 1, 1]", "[1.5, 0, 0.5]", ", mass: 0")), LOOKS));
    assert_true(
        notice_each_other(PAIR(CRATE("[0.1, 0.1, 3]", "[1.5, 0, 1.5]", ", mass: 0")), LOOKS));
    assert_true(notice_each_other(PAIR(CRATE("[1, 1, 3]", "[1.5, 2, 1.5]", ", mass: 0")), LOOKS));
    assert_true(notice_each_other(PAIR(CRATE("[1, 1, 1]", "[1.5, 0, 2.5]", ", mass: 0")), LOOKS));
}

static void only_tall_walls_stop_signals(void **state) {
    (void)state;
    assert_true(notice_each_other(PAIR(""), CALLS));
    assert_false(notice_each_other(PAIR("walls: [{line: [[1.5, -9], [1.5, 9]]}]\n"), CALLS));
    assert_true(
        notice_each_other(PAIR("walls: [{line: [[1.5, -9], [1.5, 9]], height: 1.2}]\n"), CALLS));
    if (jox_bodies_available())
        assert_true(
            notice_each_other(PAIR(CRATE("[1, 1, 3]", "[1.5, 0, 1.5]", ", mass: 0")), CALLS));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tall_wide_bodies_hide_people),
        cmocka_unit_test(only_tall_walls_stop_signals),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
