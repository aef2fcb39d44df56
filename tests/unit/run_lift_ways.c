/* Tests of ways that lead by several lifts, stairs and ramps: people find them, choose among them
 * by time, and change their mind on the way. */
#include <math.h>

#include "base/file.h"
#include "jostle_tools.h"
#include "unit/scene_loader.h"

/* Four storeys of 30 x 10 m, 4 m high each. A stair or ramp joins ground and first, lift `low`
   first and second, lift `high` second and third; lift `tall` serves all storeys. */
enum { STAIR = 1, RAMP = 2, LOW = 4, HIGH = 8, TALL = 16, SLOW = 32 };
static JoScene *load_tower(int parts, const char *lifts, const char *rest) {
    JoxText text = {0};
    jox_text_add(&text,
                 "jostle: 1\n"
                 "storeys: {ground: {height: 0}, first: {height: 4}, second: {height: 8}, third: "
                 "{height: 12}}\n");
    if (parts & (STAIR | RAMP))
        jox_text_printf(&text,
                        "stairs: {way: {from: ground, to: first, path: [[2, 8], [%d, 8]], width: "
                        "1.5, kind: %s}}\n",
                        parts & STAIR ? 10 : 28, parts & STAIR ? "stairs" : "ramp");
    jox_text_add(&text, "lifts:\n");
    if (parts & LOW)
        jox_text_printf(&text,
                        "  low: {area: [[20, 4], [21.8, 5.8]], door: [[20.4, 4], [21.4, 4]], "
                        "storeys: [first, second]%s}\n",
                        lifts);
    if (parts & HIGH)
        jox_text_add(&text, "  high: {area: [[24, 4], [25.8, 5.8]], door: [[24.4, 4], [25.4, 4]], "
                            "storeys: [second, third]}\n");
    if (parts & TALL)
        jox_text_printf(&text,
                        "  tall: {area: [[27, 4], [28.8, 5.8]], door: [[27.4, 4], [28.4, 4]], "
                        "speed: %g}\n",
                        parts & SLOW ? 0.05 : 0.8);
    jox_text_printf(&text,
                    "walls: [{line: [[0, 0], [30, 0], [30, 10], [0, 10]], closed: true, storey: "
                    "[ground, first, second, third]}]\n"
                    "places:\n"
                    "  bottom: {point: [5, 1.5], radius: 1}\n"
                    "  top: {point: [5, 1.5], radius: 1, storey: third}\n"
                    "  upper: {point: [5, 1.5], radius: 1, storey: second}\n%s",
                    rest);
    JoScene *scene = load_scene_file(write_test_file("scene.yaml", text.data), NULL, 0);
    jox_text_free(&text);
    return scene;
}

/* Runs until an agent is in a place, at most `seconds`; returns the time, INFINITY: it is not. */
static double wait_for_place(JoScene *scene, uint32_t id, const char *place, double seconds) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxPlace *places = scene->world->model.places;
    const int at = jox_place_find(places, scene->world->model.place_count, place);
    assert_true(at >= 0);
    for (int n = 0; n < (int)(seconds * 20.0); n++) {
        for (uint32_t i = 0; i < a->count; i++)
            if (a->id[i] == id &&
                jox_place_contains(places, (uint32_t)at, (JoxV2){a->x[i], a->y[i]}))
                return jo_world_time(scene->world);
        step_scene(scene, 1);
    }
    return INFINITY;
}

static uint64_t get_carried(const JoScene *scene, uint32_t lift) {
    return scene->world->state.lifts.figures[lift].carried;
}

#define GROUP(at, rest) "groups: {people: {at: [" at "], " rest "}}\n"

static void ways_lead_over_any_chain_of_stairs_and_lifts(void **state) {
    (void)state;
    const struct {
        int parts;
        const char *people, *goal;
    } CASES[] = {
        {STAIR | LOW, GROUP("[20, 2]", "journey: [{to: upper}]"), "upper"},
        {STAIR | LOW | HIGH, GROUP("[20, 2]", "journey: [{to: top}]"), "top"},
        {STAIR | LOW | HIGH, GROUP("[20, 2]", "storey: third, journey: [{to: bottom}]"), "bottom"},
        {RAMP | LOW, GROUP("[20, 2]", "set: {lifts: only}, journey: [{to: upper}]"), "upper"},
        {RAMP | LOW | HIGH, GROUP("[20, 2]", "set: {lifts: only}, journey: [{to: top}]"), "top"},
        {RAMP | LOW | HIGH,
         GROUP("[20, 2]", "storey: third, set: {lifts: only}, journey: [{to: bottom}]"), "bottom"},
        {LOW | HIGH, GROUP("[20, 2]", "storey: first, journey: [{to: top}]"), "top"},
        /* the lift of a ride, by another lift */
        {STAIR | LOW | HIGH, GROUP("[20, 2]", "journey: [{ride: high.third}, {to: top}]"), "top"},
    };
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; k++) {
        JoScene *scene = load_tower(CASES[k].parts, "", CASES[k].people);
        if (!(wait_for_place(scene, 0, CASES[k].goal, 200) < INFINITY))
            fail_msg("case %zu: the person is not at '%s'", k, CASES[k].goal);
        assert_int_equal(scene->world->state.statistics.people_lost, 0);
        jo_scene_free(scene);
    }
}

/* People take a chain of stair and lifts rather than a slow lift that serves all storeys; who
   cannot use the stair takes the slow lift in its place alone. */
static void ways_are_chosen_by_time(void **state) {
    (void)state;
    static const char *const USES[] = {"either", "only", "never"};
    for (int k = 0; k < 3; k++) {
        char people[256];
        snprintf(people, sizeof people, GROUP("[20, 2]", "set: {lifts: %s}, journey: [{to: top}]"),
                 USES[k]);
        JoScene *scene = load_tower(STAIR | LOW | HIGH | TALL | SLOW, "", people);
        const double time = wait_for_place(scene, 0, "top", 400);
        assert_int_equal(get_carried(scene, 0), k != 2);
        assert_int_equal(get_carried(scene, 1), k != 2);
        assert_int_equal(get_carried(scene, 2), k == 1);
        assert_true(k == 2 ? !(time < INFINITY) : time < (k ? 200 : 120));
        jo_scene_free(scene);
    }
}

static void lift_on_the_way_that_goes_out_of_use_is_told(void **state) {
    (void)state;
    JoScene *scene =
        load_tower(STAIR | LOW | HIGH, "", GROUP("[20, 2], [21, 2]", "journey: [{to: top}]"));
    jox_world_set_lift_mode(scene->world, 1, JOX_LIFT_OUT_OF_USE);
    step_scene_seconds(scene, 40);
    JoTroubles *troubles = jo_scene_troubles(scene);
    assert_int_equal(get_carried(scene, 0), 0);
    assert_int_equal(troubles->count, 1);
    assert_string_equal(troubles->items[0].text,
                        "nobody can reach 'top': lift 'high' is out of use at (24.9, 3.4) m on "
                        "second; 2 people of group 'people'");
    jo_free(troubles);
    jox_world_set_lift_mode(scene->world, 1, JOX_LIFT_IN_USE);
    assert_true(wait_for_place(scene, 1, "top", 200) < INFINITY);
    jo_scene_free(scene);
}

/* ---- who changes its mind in a car ---- */

static void passenger_that_goes_elsewhere_is_not_shut_in(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) { /* in a car on its way up; in one whose door has just shut */
        JoScene *scene = load_tower(
            STAIR | TALL, "",
            GROUP("[27.9, 2]", "set: {lifts: only}, journey: [{to: top, until: alarm}, {to: "
                               "bottom}]"));
        const JoxLiftCar *car = &scene->world->state.lifts.cars[0];
        JoError error = {0};
        while (!(car->people == 1 && (k ? car->door == JOX_DOOR_SHUT : car->height > 1.0)))
            step_scene(scene, 1);
        assert_true(jo_scene_input(scene, "signal alarm", &error));
        const double since = jo_world_time(scene->world);
        assert_true(wait_for_place(scene, 0, "bottom", 120) < since + 120);
        assert_int_equal(get_carried(scene, 0), 1);
        jo_scene_free(scene);
    }
}

/* A rider hears a signal for which it waits after the ride, and does not wait for it any more. */
static void signal_in_a_ride_is_taken_after_it(void **state) {
    (void)state;
    static const char *const STEPS[] = {"{until: alarm}", "{to: upper, until: alarm}"};
    for (int k = 0; k < 4; k++) { /* with the signal, and without it */
        char people[256];
        snprintf(people, sizeof people,
                 GROUP("[27.9, 2]", "journey: [{ride: tall.second}, %s, {to: top}]"), STEPS[k / 2]);
        JoScene *scene = load_tower(TALL, "", people);
        JoError error = {0};
        while (!(scene->world->state.lifts.cars[0].height > 1.0))
            step_scene(scene, 1);
        if (k % 2)
            assert_true(jo_scene_input(scene, "signal alarm", &error));
        assert_int_equal(wait_for_place(scene, 0, "top", 150) < INFINITY, k % 2);
        jo_scene_free(scene);
    }
}

/* ---- goals that are a lift's ---- */

/* People who walk to the place of a lift arrive before its door, of a set too, call no lift, and
   go on with their journey. */
static void who_walks_to_a_lift_arrives_before_the_door(void **state) {
    (void)state;
    static const char *const GOALS[] = {"tall.ground", "tall.second", "lifts"};
    for (int k = 0; k < 3; k++) {
        char people[400];
        snprintf(people, sizeof people,
                 "  lifts: {set: [tall.ground, tall.first]}\n" GROUP(
                     "[20, 2]", "journey: [{to: %s}, {wait: 5}, {to: %s}]"),
                 GOALS[k], k == 1 ? "upper" : "bottom");
        JoScene *scene = load_tower(TALL, "", people);
        assert_true(wait_for_place(scene, 0, k == 1 ? "upper" : "bottom", 120) < INFINITY);
        assert_int_equal(get_carried(scene, 0), k == 1);
        jo_scene_free(scene);
    }
}

/* ---- edits ---- */

/* An edit of lifts, whose shafts are walls, waits whole for the next start. A run goes on with its
   riders, and from a checkpoint. */
static void edits_of_lifts_wait(void **state) {
    (void)state;
    static const char *const EDITS[][2] = {{"[24, 4], [25.8, 5.8]", "[24, 4], [25.9, 5.8]"},
                                           {"  high:", "  tall:"},
                                           {"[second, third]}\n", "[ first, third]}\n"}};
    for (size_t k = 0; k < sizeof EDITS / sizeof *EDITS; k++) {
        JoScene *scene =
            load_tower(STAIR | LOW | HIGH, "",
                       GROUP("[24, 2]", "storey: second, journey: [{to: top}]") "floor: wood\n");
        jo_scene_free(scene);
        JoSceneDef def = define_scene(test_path("scene.yaml"));
        JoError error = {0};
        JoxText text = {0};
        bool written = false;
        char *note = NULL;
        def.resumable = true;
        scene = load_defined_scene(&def);
        text.data = jox_read_file(def.path, 1 << 20, &text.length);
        while (scene->world->state.lifts.cars[1].people == 0)
            step_scene(scene, 1);
        const uint32_t walls = scene->world->state.walls_version;
        memcpy(strstr(text.data, EDITS[k][0]), EDITS[k][1], strlen(EDITS[k][1]));
        memcpy(strstr(text.data, "wood"), "sand", 4);
        edit_scene(scene, text.data);
        assert_non_null(strstr(scene_messages.data, "as lifts are built anew"));
        assert_int_equal(scene->world->state.walls_version, walls);
        assert_true(jo_scene_checkpoint(scene, test_path("points"), 1, "", &error));
        assert_true(jo_scene_checkpoint_now(scene, &written, &error));
        assert_true(wait_for_place(scene, 0, "top", 90) < INFINITY);
        jo_scene_free(scene);
        def = jo_default_scene_def();
        def.message = ignore_message;
        scene = jo_scene_resume(&def, test_path("points"), &note, &error);
        if (!scene)
            fail_msg("%s", error.text);
        assert_true(wait_for_place(scene, 0, "top", 90) < INFINITY);
        jo_free(note);
        jo_scene_free(scene);
        jox_text_free(&text);
    }
}

/* ---- what checks say ---- */

/* Returns what `jostle check` says of the scene that was loaded last. */
static const char *check_file(void) {
    static JoxText said;
    const char *path = test_path("scene.yaml");
    JoError error = {0};
    jox_text_free(&said);
    said = (JoxText){0};
    jo_check(&path, 1, false, append_message, &said, &error);
    return said.data ? said.data : "";
}

static void checks_know_the_ways_of_the_run(void **state) {
    (void)state;
    const struct {
        int parts;
        const char *lifts, *rest, *says; /* NULL: nothing */
    } CASES[] = {
        {STAIR | LOW | HIGH, "", GROUP("[20, 2]", "journey: [{to: top}]"), NULL},
        {RAMP | LOW | HIGH, "", GROUP("[20, 2]", "set: {lifts: only}, journey: [{to: top}]"), NULL},
        {STAIR | LOW | HIGH, "", GROUP("[20, 2]", "set: {lifts: only}, journey: [{to: top}]"),
         "nobody of group 'people' can reach 'top': only stairs lead there, which they cannot use. "
         "Add a ramp or a lift, or a place with `refuge: true` to wait in"},
        {STAIR | LOW | HIGH, "", GROUP("[20, 2]", "set: {lifts: never}, journey: [{to: top}]"),
         "nobody of group 'people' can reach 'top': only lifts lead there, which they do not take"},
        {STAIR | LOW | HIGH, ", mode: out_of_use", GROUP("[20, 2]", "journey: [{to: top}]"),
         "nobody of group 'people' can reach 'top': lift 'low' is out of use at (20.9, 3.4) m on "
         "first. Add an event that puts it in use"},
        {STAIR | LOW | HIGH, ", mode: out_of_use",
         GROUP("[20, 2]", "journey: [{to: top}]") "events: [{at: 9, lift: low, mode: in_use}]\n",
         NULL},
        {STAIR | LOW, "", GROUP("[20, 2]", "journey: [{to: top}]"),
         "nobody of group 'people' can reach 'top': walls lie between"},
    };
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; k++) {
        jo_scene_free(load_tower(CASES[k].parts, CASES[k].lifts, CASES[k].rest));
        const char *said = check_file();
        if (CASES[k].says ? !strstr(said, CASES[k].says) : strstr(said, "can reach") != NULL)
            fail_msg("case %zu: %s", k, said);
    }
}

/* The last of many goals is looked at like the first. */
static void checks_look_at_every_goal(void **state) {
    (void)state;
    JoxText text = {0};
    enum { GOALS = 70 };
    jox_text_add(&text, "jostle: 1\nwalls: [{line: [[20, 0], [25, 0], [25, 5], [20, 5]], closed: "
                        "true}]\nplaces:\n");
    for (int k = 0; k < GOALS; k++)
        jox_text_printf(&text, "  p%d: {point: [%g, 2], radius: 0.2}\n", k,
                        k + 1 < GOALS ? 0.1 * k : 22.0);
    jox_text_add(&text, "groups: {people: {at: [[0, 0]], journey: [");
    for (int k = 0; k < 35; k++)
        jox_text_printf(&text, "{to: p%d}, ", k);
    jox_text_add(&text, "{to: p0}]}, others: {at: [[1, 0]], journey: [");
    for (int k = 35; k < GOALS; k++)
        jox_text_printf(&text, "{to: p%d}, ", k);
    jox_text_add(&text, "{to: p35}]}}\n");
    write_test_file("scene.yaml", text.data);
    assert_non_null(strstr(check_file(), "nobody of group 'others' can reach 'p69'"));
    jox_text_free(&text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ways_lead_over_any_chain_of_stairs_and_lifts),
        cmocka_unit_test(ways_are_chosen_by_time),
        cmocka_unit_test(lift_on_the_way_that_goes_out_of_use_is_told),
        cmocka_unit_test(passenger_that_goes_elsewhere_is_not_shut_in),
        cmocka_unit_test(signal_in_a_ride_is_taken_after_it),
        cmocka_unit_test(who_walks_to_a_lift_arrives_before_the_door),
        cmocka_unit_test(edits_of_lifts_wait),
        cmocka_unit_test(checks_know_the_ways_of_the_run),
        cmocka_unit_test(checks_look_at_every_goal),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
