/* Tests of lifts in crowds: cars keep their capacity, doors do not stand open for long, and who is
 * pushed into a car gets out again. */
#include "unit/scene_loader.h"

/* Runs people who ride down and up again between two storeys; returns the longest time for which
   the door stood open, s. The car is never over its capacity and load. */
static double shuttle(const char *lift, const char *people, int seed, double seconds) {
    char text[4096], behaviour[1024];
    snprintf(text, sizeof text,
             "jostle: 1\n"
             "seed: %d\n"
             "storeys: {ground: {height: 0}, first: {height: 4}}\n"
             "lifts: {east: {%s}}\n"
             "walls: [{line: [[0, 0], [16, 0], [16, 12], [0, 12]], closed: true,\n"
             "         storey: [ground, first]}]\n"
             "places: {low: {polygon: [[1, 1], [7, 1], [7, 7], [1, 7]]},\n"
             "         high: {polygon: [[1, 1], [7, 1], [7, 7], [1, 7]], storey: first}}\n"
             "groups: {down: {%s, in: high, behaviour: own.lua},\n"
             "         up: {%s, in: low, behaviour: own.lua}}\n",
             seed, lift, people, people);
    snprintf(
        behaviour, sizeof behaviour,
        MACHINE_START
        "\"Choose\", states = {\n"
        "  Choose = { steer = hold, { to = \"Down\", when = distance \"high\":below(1) },\n"
        "    { to = \"Up\", when = distance \"low\":below(1) } },\n"
        "  Down = { steer = ride \"east.ground\", { to = \"Low\", when = rode } },\n"
        "  Low = { steer = field \"low\", { to = \"Up\", when = inside \"low\" } },\n"
        "  Up = { steer = ride \"east.first\", { to = \"High\", when = rode } },\n"
        "  High = { steer = field \"high\", { to = \"Down\", when = inside \"high\" } } } }\n");
    JoScene *scene = load_scene_text(text, behaviour);
    const JoxLift *of = &scene->world->model.lifts[0];
    uint32_t open = 0, longest = 0;
    for (int n = 0; n < (int)(seconds * 20.0); n++) {
        step_scene(scene, 1);
        const JoxLiftCar *car = &scene->world->state.lifts.cars[0];
        const bool moves = car->door == JOX_DOOR_SHUT;
        if (moves && (car->people > of->capacity || car->mass > of->load))
            fail_msg("%u people, %g kg leave at %g s", car->people, (double)car->mass, n * 0.05);
        open = moves ? 0 : open + 1;
        longest = open > longest ? open : longest;
    }
    const JoxLiftFigures *f = &scene->world->state.lifts.figures[0];
    assert_true(f->carried >= f->let_out && f->carried - f->let_out <= of->capacity);
    jo_scene_free(scene);
    return longest * 0.05;
}

static void crowds_before_small_cars_are_carried(void **state) {
    (void)state;
    const struct {
        const char *lift, *people;
    } CASES[] = {
        {"area: [[10, 5], [11.6, 6.8]], door: [[10.35, 5], [11.25, 5]], capacity: 1", "count: 50"},
        {"area: [[10, 5], [11.6, 6.8]], door: [[10.35, 5], [11.25, 5]], capacity: 4", "count: 30"},
        {"area: [[10, 5], [12, 7]], door: [[10.5, 5], [11.5, 5]], capacity: 6", "count: 12"},
        {"area: [[10, 5], [11.6, 6.8]], door: [[10.35, 5], [11.25, 5]]", "count: 30"},
        {"area: [[10, 5], [11.6, 6.8]], door: [[10.35, 5], [11.25, 5]], load: 250",
         "count: 30, set: {mass: 'uniform(40, 120)'}"},
        {"area: [[10, 5], [11.6, 6.8]], door: [[10.3, 5], [11.3, 5]], capacity: 2",
         "count: 8, set: {radius: 0.35}"},
        {"area: [[10, 5], [11.6, 6.8]], doors: {ground: [[10.3, 5], [11.3, 5]], first: [[10.3, "
         "6.8], [11.3, 6.8]]}",
         "count: 20"},
        {"area: [[10, 5], [14, 8]], door: [[11, 5], [13, 5]], capacity: 26", "count: 60"},
    };
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; k++)
        assert_true(shuttle(CASES[k].lift, CASES[k].people, (int)k + 1, 200.0) < 60.0);
}

/* The near lift bears 90 kg, and its door is narrow; the far one is slow. */
static void people_take_a_lift_that_bears_them(void **state) {
    (void)state;
    const struct {
        const char *people;
        uint32_t carried[2]; /* by the near lift, by the far one */
    } CASES[] = {{"mass: 70", {1, 0}}, {"mass: 105", {0, 1}}, {"mass: 70, radius: 0.6", {0, 1}}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; k++) {
        char text[2048];
        snprintf(text, sizeof text,
                 "jostle: 1\n"
                 "storeys: {ground: {height: 0}, first: {height: 4}}\n"
                 "lifts:\n"
                 "  near: {load: 90, area: [[10, 5], [11.8, 6.8]], door: [[10.5, 5], [11.3, 5]]}\n"
                 "  far: {speed: 0.3, area: [[20, 5], [22, 7]], door: [[20.3, 5], [21.7, 5]]}\n"
                 "walls: [{line: [[0, 0], [26, 0], [26, 10], [0, 10]], closed: true, storey: "
                 "[ground, first]}]\n"
                 "places: {low: {point: [2, 2], radius: 1}}\n"
                 "groups: {people: {at: [[9, 2]], storey: first, journey: [{to: low}], set: "
                 "{lifts: only, %s}}}\n",
                 CASES[k].people);
        JoScene *scene = load_scene_file(write_test_file("scene.yaml", text), NULL, 0);
        step_scene_seconds(scene, 90);
        for (int l = 0; l < 2; l++)
            if (scene->world->state.lifts.figures[l].carried != CASES[k].carried[l])
                fail_msg("%s: lift %d carried %u", CASES[k].people, l,
                         (unsigned)scene->world->state.lifts.figures[l].carried);
        jo_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crowds_before_small_cars_are_carried),
        cmocka_unit_test(people_take_a_lift_that_bears_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
