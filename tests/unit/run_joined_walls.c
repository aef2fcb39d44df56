/* Tests of walls at joined (periodic) edges of a world: they act on both sides. */
#include <math.h>

#include "machine/machine_parts.h"
#include "unit/gate_ball_scene.h"

#define EAST                                                                                       \
    MACHINE_START "\"A\", defaults = { speed = 1.3 }, states = { A = { steer = drift(1, 0) } } "   \
                  "}\n"
#define WEST                                                                                       \
    MACHINE_START "\"A\", defaults = { speed = 1.3 }, states = { A = { steer = drift(-1, 0) } } "  \
                  "}\n"
#define STAY MACHINE_START "\"A\", states = { A = { steer = hold } } }\n"

/* A corridor of 10 x 4 m whose ends are joined. */
#define RING                                                                                       \
    "jostle: 1\n"                                                                                  \
    "bounds: [[0, 0], [10, 4]]\n"                                                                  \
    "periodic: x\n"                                                                                \
    "walls:\n"                                                                                     \
    "  - {line: [[0, 0], [10, 0]]}\n"                                                              \
    "  - {line: [[0, 4], [10, 4]]}\n"
#define TWELVE                                                                                     \
    "groups:\n"                                                                                    \
    "  people: {behaviour: own.lua, at: [[4, 0.6], [4, 1.3], [4, 2], [4, 2.7], [4, 3.4], "         \
    "[5, 0.6], [5, 1.3], [5, 2], [5, 2.7], [5, 3.4], [6, 1.3], [6, 2.7]]}\n"

static const JoxAgents *agents_of(const JoScene *scene) {
    return &scene->world->state.agents;
}

/* Steps, and counts crossings of the joined edges. */
static int count_laps(JoScene *scene, int steps) {
    const JoxAgents *a = agents_of(scene);
    float before[64];
    int laps = 0;
    assert_true(a->count <= 64);
    for (int n = 0; n < steps; n++) {
        for (uint32_t i = 0; i < a->count; i++)
            before[a->id[i]] = a->x[i];
        step_scene(scene, 1);
        for (uint32_t i = 0; i < a->count; i++)
            laps += fabsf(a->x[i] - before[a->id[i]]) > 5.0f;
    }
    return laps;
}

/* ---- no crossing ---- */

static void gate_at_joined_edges_is_passed_only_while_it_is_open(void **state) {
    static const char *const GATES[] = {
        RING "  - {line: [[0, 0], [0, 4]], name: gate}\n" TWELVE,
        RING "  - {line: [[10, 4], [10, 0]], name: gate}\n" TWELVE,
        RING "  - {solid: [[9.8, 0], [10.3, 0], [10.3, 4], [9.8, 4]], name: gate}\n" TWELVE,
        RING "  - {solid: [[-0.3, 0], [0, 0], [0, 4], [-0.3, 4]], name: gate}\n" TWELVE,
    };
    (void)state;
    for (size_t k = 0; k < 2 * sizeof GATES / sizeof *GATES; k++) {
        JoScene *scene = load_scene_text(GATES[k / 2], k % 2 ? EAST : WEST);
        assert_int_equal(count_laps(scene, 300), 0);
        apply_input(scene, "open gate");
        assert_true(count_laps(scene, 300) >= 12);
        apply_input(scene, "close gate");
        assert_int_equal(count_laps(scene, 300), 0);
        jo_scene_free(scene);
    }
}

static void one_step_over_joined_edges_ends_at_a_wall(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\nbounds: [[0, 0], [10, 4]]\nperiodic: both\n"
        "walls: [{line: [[2, 1], [2, 3]], name: gate}, {line: [[4, 0], [6, 0]]}]\n"
        "groups: {people: {behaviour: own.lua, at: [[5, 2], [5, 3.5]]}}\n",
        MACHINE_START "\"A\", defaults = { mass = 1 }, states = { A = { steer = hold } } }\n");
    const JoxAgents *a = agents_of(scene);
    apply_input(scene, "push 0 10000 0"); /* some 25 m in a step */
    apply_input(scene, "push 1 0 10000");
    step_scene(scene, 1);
    assert_true(a->x[0] > 1.5f && a->x[0] < 2.0f);
    assert_true(a->y[1] > 3.5f && a->y[1] < 4.0f);
    apply_input(scene, "open gate");
    apply_input(scene, "push 0 10000 0");
    step_scene(scene, 1);
    assert_true(a->x[0] - a->prev_x[0] > 10.0f);
    jo_scene_free(scene);
}

static void people_in_the_way_of_a_gate_are_moved_within_the_bounds(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(RING "  - {line: [[0, 0], [0, 4]], name: gate, open: true}\n"
                             "  - {solid: [[9, 0], [11, 0], [11, 1], [9, 1]], name: block, "
                             "open: true}\n"
                             "groups: {people: {behaviour: own.lua, at: [[9.95, 2], "
                             "[0.05, 3], [0.5, 0.5], [9.5, 0.5]]}}\n",
                        STAY);
    const JoxAgents *a = agents_of(scene);
    apply_input(scene, "close gate");
    apply_input(scene, "close block");
    step_scene(scene, 1);
    assert_int_equal(scene->world->state.statistics.moved_out, 4);
    for (uint32_t i = 0; i < a->count; i++) {
        const float x = a->x[i], y = a->y[i];
        assert_true(x >= 0.0f && x < 10.0f);
        assert_false(y < 1.0f && (x < 1.0f || x > 9.0f));
        if (a->id[i] < 2)
            assert_true((x > 5.0f) == (a->id[i] == 0));
    }
    jo_scene_free(scene);
}

static void people_are_born_beside_walls_beyond_joined_edges(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(RING "  - {solid: [[9, 0], [11, 0], [11, 4], [9, 4]]}\n"
                                          "groups: {people: {behaviour: own.lua, at: [[5, 2]]}}\n",
                                     STAY);
    JoError error = {0};
    assert_false(jo_scene_input(scene, "spawn people 0.5 2", &error));
    apply_input(scene, "spawn people 1.05 2");
    const JoxAgents *a = agents_of(scene);
    assert_int_equal(a->count, 2);
    for (uint32_t i = 0; i < a->count; i++)
        assert_true(a->x[i] > 1.15f && a->x[i] < 9.0f);
    jo_scene_free(scene);
}

static void people_fill_places_beside_walls_beyond_joined_edges(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\nbounds: [[0, 0], [10, 4]]\nperiodic: both\n"
        "walls: [{solid: [[9, 0], [11, 0], [11, 4], [9, 4]]}]\n"
        "places: {all: {polygon: [[0, 0], [10, 0], [10, 4], [0, 4]]}}\n"
        "groups: {people: {behaviour: own.lua, density: 1, in: all, fill: random}}\n",
        STAY);
    const JoxAgents *a = agents_of(scene);
    assert_in_range(a->count, 29, 32); /* on 8 m x 4 m, without the surroundings of the solid */
    for (uint32_t i = 0; i < a->count; i++)
        assert_true(a->x[i] > 1.15f && a->x[i] < 8.85f);
    jo_scene_free(scene);
}

/* ---- ends of walls at joined edges ---- */

/* Runs one crowd with walls that end at the joined edges, that extend beyond them, and that are
 * drawn in pieces that meet there. */
static void ends_of_walls_at_joined_edges_are_not_felt(void **state) {
    static const char *const WALLS[] = {
        "[{line: [[-15, 0], [25, 0]]}, {line: [[-15, 1.5], [25, 1.5]]}]",
        "[{line: [[0, 0], [10, 0]]}, {line: [[10, 1.5], [0, 1.5]]}]",
        "[{line: [[-1, 0], [11, 0]]}, {line: [[3, 1.5], [13, 1.5]]}]",
        ("[{solid: [[0, -1], [10, -1], [10, 0], [0, 0]]}, "
         "{solid: [[-2, 1.5], [13, 1.5], [13, 3], [-2, 3]]}]"),
    };
    JoxV2 first[40];
    (void)state;
    for (size_t k = 0; k < sizeof WALLS / sizeof *WALLS; k++) {
        char scene_text[600];
        snprintf(scene_text, sizeof scene_text,
                 "jostle: 1\nbounds: [[0, -3], [10, 5]]\nperiodic: x\nwalls: %s\n"
                 "places: {hall: {polygon: [[0, 0.2], [10, 0.2], [10, 1.3], [0, 1.3]]}}\n"
                 "groups: {people: {behaviour: own.lua, count: 40, in: hall, fill: random}}\n",
                 WALLS[k]);
        JoScene *scene =
            load_scene_text(scene_text, MACHINE_START
                            "\"A\", defaults = { speed = uniform(0.8, 1.6), push = 300, "
                            "radius = 0.2 }, states = { A = { steer = drift(1, 0.3) } } }\n");
        const JoxAgents *a = agents_of(scene);
        assert_true(count_laps(scene, 16) > 0);
        for (uint32_t i = 0; i < a->count; i++) {
            const JoxV2 at = {a->x[i], a->y[i]};
            if (k == 0)
                first[a->id[i]] = at;
            const JoxV2 off = jox_wrap(a, jox_sub(at, first[a->id[i]]));
            if (jox_length(off) > 0.006f) /* sums of floats differ */
                fail_msg("walls %zu: agent %u at (%g, %g), not (%g, %g)", k, a->id[i], (double)at.x,
                         (double)at.y, (double)first[a->id[i]].x, (double)first[a->id[i]].y);
        }
        jo_scene_free(scene);
    }
}

/* ---- sight, loads, densities ---- */

static void walls_beyond_joined_edges_hide_bear_loads_and_are_reported_once(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(RING "  - {line: [[0, 0], [0, 4]], name: gate}\n" TWELVE, MACHINE_START
                        "\"A\", defaults = { speed = 1.3, push = 600 }, states = { A = { "
                        "steer = drift(1, 0) } } }\n");
    const double from[] = {9, 2}, to[] = {11, 2}, back[] = {8, 2};
    const JoWorld *world = scene->world;
    double edges[4 * 16];
    uint32_t count;
    step_scene(scene, 300);
    assert_true(jox_is_hidden(&scene->world->machines, jox_v2(9.5f, 2), jox_v2(10.5f, 2), false));
    assert_false(jox_is_hidden(&scene->world->machines, jox_v2(9.5f, 2), jox_v2(9.9f, 2), false));
    const JoCast cast = jo_world_cast(world, from, to, 0.1, JO_CAST_WALLS);
    assert_true(cast.hit && fabs(cast.x - 9.9) < 1e-5 && cast.what >= 4 && cast.what < 6);
    assert_false(jo_world_cast(world, from, back, 0.1, JO_CAST_WALLS).hit);
    assert_int_equal(jo_world_walls(world, edges, 16), 6);
    const JoxWallLoad *loads = jox_force_wall_loads(world->scratch.forces, &count);
    float borne = 0.0f;
    for (uint32_t k = 0; k < count; k++) {
        assert_true(loads[k].edge < 6 && loads[k].from.x >= 0.0f && loads[k].from.x <= 10.0f);
        borne += loads[k].edge >= 4 ? loads[k].load : 0.0f;
    }
    assert_int_equal(count, 4 * 10 + 2 * 4);
    assert_true(borne > 100.0f);
    apply_input(scene, "open gate");
    assert_false(jo_world_cast(world, from, to, 0.1, JO_CAST_WALLS).hit);
    step_scene(scene, 1);
    assert_false(jox_is_hidden(&scene->world->machines, jox_v2(9.5f, 2), jox_v2(10.5f, 2), false));
    jo_scene_free(scene);
}

static void people_beyond_a_wall_at_joined_edges_do_not_count_in_densities(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(RING "  - {line: [[0, 0], [0, 4]], name: gate}\n"
                             "groups: {people: {behaviour: own.lua, at: [[0.3, 2]]}}\n",
                        STAY);
    assert_true(jo_world_density(scene->world, 9.7, 2) == 0.0);
    apply_input(scene, "open gate");
    assert_true(jo_world_density(scene->world, 9.7, 2) > 0.1);
    jo_scene_free(scene);
}

/* ---- routes ---- */

#define GO(at, goal)                                                                               \
    "places: {goal: {point: " goal ", radius: 0.4}}\n"                                             \
    "groups: {people: {behaviour: own.lua, at: [" at "], set: {goal: goal}}}\n"
#define WALK                                                                                       \
    MACHINE_START                                                                                  \
    "\"A\", states = { A = { steer = field(own.goal) } }, own = { goal = \"goal\" } }\n"

static void routes_cross_joined_edges_where_that_is_shorter(void **state) {
    static const struct {
        const char *scene;
        bool over;
    } CASES[] = {
        {RING "  - {line: [[5, 0], [5, 4]]}\n" GO("[4, 2]", "[6, 2]"), true},
        {RING "  - {line: [[5, 0], [5, 4]]}\n" GO("[7, 2]", "[3, 2]"), true},
        {RING "  - {line: [[8.5, 0], [8.5, 4]]}\n" GO("[9.2, 2]", "[7.8, 2]"), true},
        {RING "  - {line: [[0, 0], [0, 4]]}\n" GO("[2, 2]", "[9, 2]"), false},
        {RING "  - {solid: [[10, 1], [13, 1], [13, 3], [10, 3]]}\n" GO("[2.4, 0.5]", "[2.4, 3.5]"),
         false},
        {RING "  - {solid: [[10, 1], [13, 1], [13, 3], [10, 3]]}\n" GO("[0.6, 0.5]", "[0.6, 3.5]"),
         true},
    };
    (void)state;
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; k++) {
        JoScene *scene = load_scene_text(CASES[k].scene, WALK);
        const JoxPlace *goal = &scene->world->model.places[0];
        const JoxAgents *a = agents_of(scene);
        double points[200], length;
        const JoxV2 start = {a->x[0], a->y[0]};
        assert_true(jo_world_path(scene->world, (double)start.x, (double)start.y, "goal", points,
                                  100, &length) > 2);
        assert_true(length < 12.0);
        const bool over = count_laps(scene, 300) > 0;
        if (over != CASES[k].over ||
            jox_length(jox_sub(goal->centre, jox_v2(a->x[0], a->y[0]))) > 0.5f)
            fail_msg("case %zu: at (%g, %g), %s edges", k, (double)a->x[0], (double)a->y[0],
                     over ? "over" : "not over");
        jo_scene_free(scene);
    }
}

static void unreachable_goals_at_joined_edges_are_reported(void **state) {
    static const char *const SCENES[] = {
        RING
        "  - {line: [[5, 0], [5, 4]]}\n  - {line: [[10, 0], [10, 4]]}\n" GO("[4, 2]", "[6, 2]"),
        RING "  - {line: [[0, 2], [10, 2]]}\n" GO("[9, 1]", "[9, 3]"),
        RING "  - {line: [[4, 2], [14, 2]]}\n" GO("[9, 1]", "[9, 3]"),
    };
    (void)state;
    for (size_t k = 0; k < sizeof SCENES / sizeof *SCENES; k++) {
        JoScene *scene = load_scene_text(SCENES[k], WALK);
        double length = 0.0;
        step_scene(scene, 100);
        assert_non_null(scene_messages.data);
        assert_non_null(strstr(scene_messages.data, "cannot reach"));
        assert_int_equal(jo_world_path(scene->world, 4, 1, "goal", NULL, 0, &length), 0);
        assert_false(isfinite(length));
        jo_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gate_at_joined_edges_is_passed_only_while_it_is_open),
        cmocka_unit_test(one_step_over_joined_edges_ends_at_a_wall),
        cmocka_unit_test(people_in_the_way_of_a_gate_are_moved_within_the_bounds),
        cmocka_unit_test(people_are_born_beside_walls_beyond_joined_edges),
        cmocka_unit_test(people_fill_places_beside_walls_beyond_joined_edges),
        cmocka_unit_test(ends_of_walls_at_joined_edges_are_not_felt),
        cmocka_unit_test(walls_beyond_joined_edges_hide_bear_loads_and_are_reported_once),
        cmocka_unit_test(routes_cross_joined_edges_where_that_is_shorter),
        cmocka_unit_test(unreachable_goals_at_joined_edges_are_reported),
        cmocka_unit_test(people_beyond_a_wall_at_joined_edges_do_not_count_in_densities),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
