/* Tests of lifts: people who wait, ride and leave; capacity, doors, calls in the direction of
 * travel, modes, checkpoints in the middle of a ride, and figures. */
#include <math.h>

#include "run/results/lift_figures.h"
#include "unit/assert_near.h"
#include "unit/scene_loader.h"

/* Three storeys of 16 x 8 m with a lift whose car holds eight. */
#define TOWER(lift, rest)                                                                          \
    "jostle: 1\n"                                                                                  \
    "storeys: {ground: {height: 0}, first: {height: 4}, second: {height: 8}}\n"                    \
    "lifts:\n"                                                                                     \
    "  east: {area: [[10, 5], [11.6, 6.8]], door: [[10.35, 5], [11.25, 5]]" lift "}\n"             \
    "walls:\n"                                                                                     \
    "  - {line: [[0, 0], [16, 0], [16, 8], [0, 8]], closed: true,\n"                               \
    "     storey: [ground, first, second]}\n"                                                      \
    "places:\n"                                                                                    \
    "  low: {polygon: [[1, 1], [7, 1], [7, 7], [1, 7]]}\n"                                         \
    "  middle: {polygon: [[1, 1], [7, 1], [7, 7], [1, 7]], storey: first}\n"                       \
    "  high: {polygon: [[1, 1], [7, 1], [7, 7], [1, 7]], storey: second}\n" rest
#define RIDER(place)                                                                               \
    MACHINE_START "\"Ride\", states = {\n"                                                         \
                  "  Ride = { steer = ride \"" place "\", { to = \"Off\", when = rode } },\n"      \
                  "  Off = { steer = seek \"low\", { to = \"Stay\", when = after(6) } },\n"        \
                  "  Stay = { steer = hold } } }\n"

static const JoxLiftCar *get_car(const JoScene *scene) {
    return &scene->world->state.lifts.cars[0];
}

static const JoxLiftFigures *get_figures(const JoScene *scene) {
    return &scene->world->state.lifts.figures[0];
}

/* Returns how many agents stand on a storey. */
static uint32_t count_on_storey(const JoScene *scene, uint32_t storey) {
    const JoWorld *w = scene->world;
    uint32_t count = 0;
    for (uint32_t i = 0; i < w->state.agents.count; i++)
        count += jox_storey_at(&w->model.storeys,
                               (JoxV2){w->state.agents.x[i], w->state.agents.y[i]}) == storey;
    return count;
}

/* Checks that nobody stands in the shaft on another storey than the car's, and that the car is not
   over its capacity. */
static void check_shaft(const JoScene *scene) {
    const JoWorld *w = scene->world;
    const JoxLift *lift = &w->model.lifts[0];
    const JoxLiftCar *car = get_car(scene);
    for (uint32_t i = 0; i < w->state.agents.count; i++) {
        const JoxV2 at = {w->state.agents.x[i], w->state.agents.y[i]};
        if (jox_lift_contains(lift, jox_in_plan(&w->model.storeys, at)))
            assert_int_equal(jox_storey_at(&w->model.storeys, at), lift->stops[car->stop].storey);
    }
    assert_true(car->people <= lift->capacity);
    assert_true(car->height >= 0.0 && car->height <= 8.0);
}

static void people_ride_down_and_walk_on(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(TOWER("", "groups: {people: {behaviour: own.lua, count: 20, in: high}}\n"),
                        RIDER("east.ground"));
    for (int n = 0; n < 2600 && count_on_storey(scene, 0) < 20; n++) {
        step_scene(scene, 1);
        check_shaft(scene);
    }
    step_scene(scene, 200);
    assert_int_equal(count_on_storey(scene, 0), 20);
    const JoxLiftFigures *f = get_figures(scene);
    assert_int_equal(f->carried, 20);
    assert_int_equal(f->let_out, 20);
    assert_int_equal(f->trips, 3); /* 8, 8 and 4 */
    assert_int_equal(f->full_trips, 2);
    assert_int_equal(f->wait_count, 20);
    assert_true(f->left_behind >= 12);
    assert_true(fabs(f->metres - 6 * 8.0) < 0.1);
    jo_scene_free(scene);
}

static void capacity_and_load_are_kept(void **state) {
    (void)state;
    const char *const lifts[] = {", capacity: 3", ", load: 260"}; /* people of 70 kg */
    for (int k = 0; k < 2; k++) {
        char text[4096];
        snprintf(text, sizeof text,
                 TOWER("%s", "groups: {people: {behaviour: own.lua, count: 7, in: high}}\n"),
                 lifts[k]);
        JoScene *scene = load_scene_text(text, RIDER("east.ground"));
        uint32_t most = 0;
        for (int n = 0; n < 2400; n++) {
            step_scene(scene, 1);
            most = get_car(scene)->people > most ? get_car(scene)->people : most;
        }
        assert_int_equal(most, 3);
        assert_int_equal(get_figures(scene)->trips, 3);
        assert_int_equal(count_on_storey(scene, 0), 7);
        jo_scene_free(scene);
    }
}

/* People who are heavier than the load, or broader than the door, never ride, and keep nobody from
   it. */
static void who_is_too_heavy_or_broad_holds_up_nobody(void **state) {
    (void)state;
    const char *const kinds[] = {"mass: 300", "radius: 0.7"};
    for (int k = 0; k < 2; k++) {
        char text[4096];
        snprintf(text, sizeof text,
                 TOWER(", load: 260", "groups:\n"
                                      "  first: {behaviour: own.lua, at: [[10.8, 4]], storey: "
                                      "second, set: {%s}}\n"
                                      "  people: {behaviour: own.lua, count: 3, in: high}\n"),
                 kinds[k]);
        JoScene *scene = load_scene_text(text, RIDER("east.ground"));
        step_scene_seconds(scene, 60);
        assert_int_equal(count_on_storey(scene, 0), 3);
        assert_int_equal(count_on_storey(scene, 2), 1);
        assert_int_equal(get_car(scene)->door, JOX_DOOR_SHUT);
        jo_scene_free(scene);
    }
}

/* The car needs the time of its speed and acceleration from standing to standing. */
static void car_travels_for_the_time_of_its_speed(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(TOWER(", speed: 2, acceleration: 1, returns: false",
                              "groups: {people: {behaviour: own.lua, at: [[8, 4]]}}\n"),
                        RIDER("east.second"));
    int steps = 0;
    for (int n = 0; n < 1200; n++) {
        step_scene(scene, 1);
        steps += get_car(scene)->target >= 0;
    }
    const double time = jox_lift_travel_time(&scene->world->model.lifts[0], 8.0);
    assert_true(fabs(time - 6.0) < 1e-6); /* 8 / 2 + 2 / 1 */
    assert_true(fabs(steps * 0.05 - time) < 0.2);
    assert_int_equal(count_on_storey(scene, 2), 1);
    jo_scene_free(scene);
}

/* A car on its way up takes who goes up, and leaves who goes down for the way back. */
static void calls_are_served_in_the_direction_of_travel(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        TOWER(
            ", speed: 0.5",
            "groups:\n"
            "  up: {behaviour: own.lua, at: [[9, 4]], set: {to: east.second}}\n"
            "  also up: {behaviour: own.lua, at: [[9, 4]], storey: first, set: {to: east.second}}\n"
            "  down: {behaviour: own.lua, at: [[9, 2]], storey: first, set: {to: east.ground}}\n"),
        MACHINE_START "\"Ride\", own = { to = \"east.ground\" }, states = {\n"
                      "  Ride = { steer = ride(own.to), { to = \"Off\", when = rode } },\n"
                      "  Off = { steer = drift(0, -1), { to = \"Stay\", when = after(3) } },\n"
                      "  Stay = { steer = hold } } }\n");
    bool both = false;
    for (int n = 0; n < 1200 && count_on_storey(scene, 2) < 2; n++) {
        step_scene(scene, 1);
        both |= get_car(scene)->people == 2;
    }
    step_scene(scene, 100);
    assert_true(both);
    assert_int_equal(count_on_storey(scene, 2), 2);
    assert_int_equal(count_on_storey(scene, 1), 1);
    step_scene_seconds(scene, 60);
    assert_int_equal(count_on_storey(scene, 0), 1);
    assert_int_equal(get_figures(scene)->trips, 3);
    jo_scene_free(scene);
}

/* ---- doors ---- */

static void door_does_not_shut_on_somebody(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        TOWER("", "groups: {people: {behaviour: own.lua, at: [[10.8, 4]]}}\n"),
        MACHINE_START "\"Ride\", states = {\n"
                      "  Ride = { steer = ride \"east.first\",\n"
                      "    { to = \"Halt\", when = distance \"east.ground\":below(0.25) } },\n"
                      "  Halt = { steer = hold, lasts = 30, { to = \"Again\", when = lasted } },\n"
                      "  Again = { steer = ride \"east.first\", { to = \"Off\", when = rode } },\n"
                      "  Off = { steer = hold } } }\n");
    step_scene_seconds(scene, 25);
    assert_int_equal(get_car(scene)->door, JOX_DOOR_OPEN);
    assert_true(get_figures(scene)->reopened >= 3);
    step_scene_seconds(scene, 60);
    assert_int_equal(count_on_storey(scene, 1), 1);
    jo_scene_free(scene);
}

static void gate_of_a_lift_cannot_be_opened_by_hand(void **state) {
    (void)state;
    JoxText why = {0};
    JoScene *scene = load_scene_text(
        TOWER("", "groups: {people: {behaviour: own.lua, at: [[2, 2]]}}\n"), RIDER("east.first"));
    assert_false(jox_event_open(scene->world, "east.ground", true, &why));
    assert_non_null(strstr(why.data, "the door of a lift"));
    jox_text_free(&why);
    jo_scene_free(scene);
}

/* Doors on all four sides, given from either end, with a side of their own on one storey. */
static void doors_may_be_on_any_side(void **state) {
    (void)state;
    static const char *const DOORS[] = {"[[10.35, 5], [11.25, 5]]", "[[11.25, 5], [10.35, 5]]",
                                        "[[11.6, 5.4], [11.6, 6.4]]", "[[10, 5.4], [10, 6.4]]",
                                        "[[10.35, 6.8], [11.25, 6.8]]"};
    for (size_t k = 0; k < sizeof DOORS / sizeof *DOORS; k++) {
        char text[2048];
        snprintf(text, sizeof text,
                 "jostle: 1\n"
                 "storeys: {ground: {height: 0}, first: {height: 4}}\n"
                 "lifts:\n"
                 "  east: {area: [[10, 5], [11.6, 6.8]], door: %s, doors: {ground: [[10.35, 5], "
                 "[11.25, 5]]}}\n"
                 "walls: [{line: [[0, 0], [16, 0], [16, 12], [0, 12]], closed: true, storey: "
                 "[ground, first]}]\n"
                 "places: {low: {polygon: [[1, 1], [7, 1], [7, 7], [1, 7]]}}\n"
                 "groups: {people: {behaviour: own.lua, at: [[8, 3], [13, 9]], storey: first}}\n",
                 DOORS[k]);
        JoScene *scene = load_scene_text(text, RIDER("east.ground"));
        step_scene_seconds(scene, 60);
        assert_int_equal(count_on_storey(scene, 0), 2);
        jo_scene_free(scene);
    }
}

/* ---- modes ---- */

static void lift_out_of_use_lets_riders_out_and_takes_nobody(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        TOWER("", "groups: {people: {behaviour: own.lua, count: 12, in: high}}\n"
                  "events: [{at: 35, lift: east, mode: out_of_use}]\n"),
        MACHINE_START "\"Ride\", states = {\n"
                      "  Ride = { steer = ride \"east.ground\",\n"
                      "    { to = \"Off\", when = rode },\n"
                      "    { to = \"Stairs\", when = ~in_use \"east.ground\" & ~riding } },\n"
                      "  Off = { steer = hold }, Stairs = { steer = hold } } }\n");
    for (int n = 0; n < 4000 && !(get_car(scene)->speed < -1.0); n++)
        step_scene(scene, 1);
    assert_int_equal(get_car(scene)->people, 8);
    jox_world_set_lift_mode(scene->world, -1, JOX_LIFT_OUT_OF_USE);
    step_scene_seconds(scene, 60);
    const JoxMachineRun *machines = &scene->world->machines;
    uint32_t people[4] = {0};
    jox_machines_people(machines, 0, people);
    const JoxMachine *machine = machines->set->items[0];
    assert_int_equal(people[jox_machine_state(machine, "Off")], 8);
    assert_int_equal(people[jox_machine_state(machine, "Stairs")], 4);
    assert_int_equal(count_on_storey(scene, 2), 4);
    assert_int_equal(get_car(scene)->people, 0);
    assert_int_equal(get_car(scene)->door, JOX_DOOR_SHUT);
    assert_int_equal(get_figures(scene)->trips, 1);
    jo_scene_free(scene);
}

/* Firemen fetch the highest storey first, or the one that is given. */
static void firemen_fetch_storey_by_storey(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        char text[4096];
        snprintf(text, sizeof text,
                 TOWER(", capacity: 4, mode: firemen%s",
                       "groups:\n"
                       "  high: {behaviour: own.lua, count: 4, in: high}\n"
                       "  middle: {behaviour: own.lua, count: 4, in: middle}\n"),
                 k ? ", first: first" : "");
        JoScene *scene = load_scene_text(text, RIDER("east.ground"));
        for (int n = 0; n < 4000 && get_figures(scene)->trips < 1; n++)
            step_scene(scene, 1);
        assert_int_equal(count_on_storey(scene, k ? 2 : 1), 4); /* they still wait */
        step_scene_seconds(scene, 150);
        assert_int_equal(count_on_storey(scene, 0), 8);
        jo_scene_free(scene);
    }
}

/* ---- figures ---- */

static void longest_queue_is_the_most_who_wait_in_any_step(void **state) {
    (void)state;
    uint32_t most = 0;
    double at = 0.0;
    JoScene *scene =
        load_scene_text(TOWER("", "groups: {people: {behaviour: own.lua, count: 20, in: high}}\n"),
                        RIDER("east.ground"));
    for (int n = 0; n < 2400; n++) {
        const double before = jo_world_time(scene->world);
        step_scene(scene, 1);
        const uint32_t waiting = jox_world_lift_waiting(scene->world, 0);
        if (waiting > most) {
            most = waiting;
            at = before;
        }
    }
    const JoxLiftResult result = jox_run_lift_result(scene->world, 0);
    assert_in_range(most, 12, 20);
    assert_int_equal(result.count.queue_most, most);
    assert_near(result.queue_most_time, at, 1e-9);
    assert_int_equal(result.count.carried, 20);
    assert_true(result.wait_mean > 0.0 && result.wait_mean < result.wait_most);
    assert_int_equal(result.waiting, 0);
    jo_scene_free(scene);
}

/* ---- state ---- */

static void snapshot_in_the_middle_of_a_ride_continues_exactly(void **state) {
    (void)state;
    JoxText text = {0};
    JoError error = {0};
    JoScene *scene =
        load_scene_text(TOWER("", "groups: {people: {behaviour: own.lua, count: 20, in: high}}\n"),
                        RIDER("east.ground"));
    for (int n = 0; n < 4000 && !(get_car(scene)->speed < -1.0); n++)
        step_scene(scene, 1);
    assert_int_equal(get_car(scene)->people, 8);
    assert_true(jox_world_snapshot(scene->world, &text, &error));
    step_scene(scene, 900);
    const uint64_t went_on = jox_world_hash(scene->world);
    const uint32_t waits = get_figures(scene)->wait_count;
    assert_true(jox_world_restore(scene->world, text.data, text.length, &error));
    assert_int_equal(get_car(scene)->people, 8);
    step_scene(scene, 900);
    assert_true(jox_world_hash(scene->world) == went_on);
    assert_int_equal(get_figures(scene)->wait_count, waits);
    jox_text_free(&text);
    jo_scene_free(scene);
}

static void people_choose_the_lift_that_takes_least_time(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text("jostle: 1\n"
                        "storeys: {ground: {height: 0}, first: {height: 4}}\n"
                        "lifts:\n"
                        "  west: {area: [[8, 5], [9.6, 6.8]], door: [[8.35, 5], [9.25, 5]]}\n"
                        "  east: {area: [[10, 5], [11.6, 6.8]], door: [[10.35, 5], [11.25, 5]]}\n"
                        "walls: [{line: [[0, 0], [16, 0], [16, 8], [0, 8]], closed: true, storey: "
                        "[ground, first]}]\n"
                        "places:\n"
                        "  hall: {polygon: [[1, 1], [7, 1], [7, 7], [1, 7]], storey: first}\n"
                        "  down: {set: [west.ground, east.ground]}\n"
                        "  low: {polygon: [[1, 1], [7, 1], [7, 7], [1, 7]]}\n"
                        "groups: {people: {behaviour: own.lua, count: 16, in: hall}}\n",
                        RIDER("down"));
    step_scene_seconds(scene, 60);
    assert_int_equal(count_on_storey(scene, 0), 16);
    assert_in_range(scene->world->state.lifts.figures[0].carried, 6, 10);
    assert_in_range(scene->world->state.lifts.figures[1].carried, 6, 10);
    jo_scene_free(scene);
}

/* ---- ways over storeys ---- */

/* Two storeys, 8 m apart, with a stair at x = 2 to 15 and a lift at x = 20; people upstairs at
   `x` go to `goal` downstairs. */
static JoScene *load_two_ways(const char *x, float goal, const char *lift, const char *people,
                              const char *rest) {
    static char text[4096];
    snprintf(text, sizeof text,
             "jostle: 1\n"
             "storeys: {ground: {height: 0}, first: {height: 8}}\n"
             "stairs: {stair: {from: ground, to: first, path: [[2, 8], [15, 8]], width: 1.5}}\n"
             "lifts: {lift: {area: [[20, 5], [21.8, 6.8]], door: [[20.4, 5], [21.4, 5]]%s}}\n"
             "walls: [{line: [[0, 0], [26, 0], [26, 10], [0, 10]], closed: true, storey: [ground, "
             "first]}]\n"
             "places: {low: {point: [%g, 1.5], radius: 1}, lobby: "
             "{polygon: [[23, 1], [25, 1], [25, 3], [23, 3]], storey: first%s}}\n"
             "groups: {people: {at: [[%s, 3]], storey: first%s, journey: [{to: low}]}}\n",
             lift, (double)goal, rest, x, people);
    return load_scene_file(write_test_file("scene.yaml", text), NULL, 0);
}

/* Runs until somebody is on a storey, at most `seconds`; returns whether they are. */
static bool wait_for_storey(JoScene *scene, uint32_t storey, double seconds) {
    for (int n = 0; n < (int)(seconds * 20.0); n++) {
        step_scene(scene, 1);
        if (count_on_storey(scene, storey))
            return true;
    }
    return false;
}

static void people_take_lift_or_stair_by_time(void **state) {
    (void)state;
    const struct {
        const char *x;
        float goal;
        const char *lift, *people;
        uint32_t carried;
    } CASES[] = {
        {"20.5", 24.0f, "", "", 1},                   /* the lift is near */
        {"15.8", 1.5f, "", "", 0},                    /* the stair is */
        {"20.5", 24.0f, ", speed: 0.1", "", 0},       /* a slow lift */
        {"20.5", 24.0f, ", mode: out_of_use", "", 0}, /* none */
        {"20.5", 24.0f, ", mode: firemen", "", 0},    /* not for those who can walk */
        {"20.5", 24.0f, "", ", set: {lifts: never}", 0},
        {"15.8", 1.5f, "", ", set: {lifts: only}", 1}, /* they cannot use the stair */
        {"15.8", 1.5f, ", mode: firemen", ", set: {lifts: only}", 1},
    };
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; k++) {
        JoScene *scene =
            load_two_ways(CASES[k].x, CASES[k].goal, CASES[k].lift, CASES[k].people, "");
        if (!wait_for_storey(scene, 0, 90) || get_figures(scene)->carried != CASES[k].carried)
            fail_msg("case %zu: %u carried", k, (unsigned)get_figures(scene)->carried);
        step_scene_seconds(scene, 40);
        const JoxAgents *a = &scene->world->state.agents; /* they walk on to the place */
        assert_true(fabsf(a->x[0] - CASES[k].goal) < 1.5f && a->y[0] < 3.0f);
        jo_scene_free(scene);
    }
}

static void who_cannot_use_stairs_waits_in_a_refuge(void **state) {
    (void)state;
    for (int refuge = 0; refuge < 2; refuge++) {
        JoScene *scene = load_two_ways("15.8", 1.5f, ", mode: out_of_use", ", set: {lifts: only}",
                                       refuge ? ", refuge: true" : "");
        step_scene_seconds(scene, 40);
        const JoxAgents *a = &scene->world->state.agents;
        const JoxV2 plan = jox_in_plan(a->storeys, (JoxV2){a->x[0], a->y[0]});
        const JoxStranded stranded = jox_world_count_stranded(scene->world, 1);
        assert_int_equal(count_on_storey(scene, 1), 1);
        assert_int_equal(stranded.in_refuge, refuge);
        assert_int_equal(stranded.nowhere, !refuge);
        assert_int_equal(plan.x > 22.5f, refuge);
        JoxText lines = {0};
        jox_run_say_lifts(scene, &lines);
        assert_non_null(strstr(lines.data, refuge ? "stayed in a refuge" : "found neither a lift"));
        jox_text_free(&lines);
        jox_world_set_lift_mode(scene->world, -1, JOX_LIFT_FIREMEN); /* firemen fetch them */
        assert_true(wait_for_storey(scene, 0, 90));
        assert_int_equal(jox_world_count_stranded(scene->world, -1).nowhere, 0);
        jo_scene_free(scene);
    }
}

/* ---- calls of programs ---- */

static void programs_set_modes_and_see_cars(void **state) {
    (void)state;
    JoError error = {0};
    JoScene *scene =
        load_scene_text(TOWER("", "groups: {people: {behaviour: own.lua, count: 3, in: high}}\n"),
                        RIDER("east.ground"));
    JoWorld *world = jo_scene_world(scene);
    assert_int_equal(jo_world_lift_count(world), 1);
    assert_string_equal(jo_world_lift(world, 1).name, "");
    step_scene_seconds(scene, 12);
    JoLiftState lift = jo_world_lift(world, 0);
    assert_string_equal(lift.name, "east");
    assert_int_equal(lift.capacity, 8);
    assert_int_equal(lift.waiting + lift.people, 3);
    assert_true(jo_world_set_lift_mode(world, "east", JO_LIFT_OUT_OF_USE, &error));
    step_scene_seconds(scene, 40);
    lift = jo_world_lift(world, 0);
    assert_int_equal(lift.mode, JO_LIFT_OUT_OF_USE);
    assert_false(lift.moves);
    assert_int_equal(lift.people, 0);
    assert_true(jo_world_set_lift_mode(world, "all", JO_LIFT_IN_USE, &error));
    assert_true(jo_scene_input(scene, "lift east firemen", &error));
    assert_int_equal(jo_world_lift(world, 0).mode, JO_LIFT_FIREMEN);
    assert_false(jo_world_set_lift_mode(world, "eats", JO_LIFT_IN_USE, &error));
    assert_non_null(strstr(error.text, "Did you mean 'east'?"));
    assert_false(jo_scene_input(scene, "lift east broken", &error));
    assert_non_null(strstr(error.text, "in_use, out_of_use or firemen"));
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(people_ride_down_and_walk_on),
        cmocka_unit_test(capacity_and_load_are_kept),
        cmocka_unit_test(who_is_too_heavy_or_broad_holds_up_nobody),
        cmocka_unit_test(car_travels_for_the_time_of_its_speed),
        cmocka_unit_test(calls_are_served_in_the_direction_of_travel),
        cmocka_unit_test(door_does_not_shut_on_somebody),
        cmocka_unit_test(doors_may_be_on_any_side),
        cmocka_unit_test(gate_of_a_lift_cannot_be_opened_by_hand),
        cmocka_unit_test(lift_out_of_use_lets_riders_out_and_takes_nobody),
        cmocka_unit_test(firemen_fetch_storey_by_storey),
        cmocka_unit_test(longest_queue_is_the_most_who_wait_in_any_step),
        cmocka_unit_test(snapshot_in_the_middle_of_a_ride_continues_exactly),
        cmocka_unit_test(people_choose_the_lift_that_takes_least_time),
        cmocka_unit_test(people_take_lift_or_stair_by_time),
        cmocka_unit_test(who_cannot_use_stairs_waits_in_a_refuge),
        cmocka_unit_test(programs_set_modes_and_see_cars),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
