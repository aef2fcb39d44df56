/* Storeys and stairs of scenes: errors, positions on sheets, and walls of stairs. */
#include "geom/polygon.h"
#include "geom/storey_text.h"
#include "unit/scene_texts.h"

#define STOREYS "storeys: {ground: {height: 0}, first: {height: 3.5}}\n"
#define STAIR(keys) STOREYS "stairs: {n: {" keys "}}\n" GROUP
#define BOUND(keys) STAIR("from: ground, to: first, " keys)
#define PLAIN "path: [[4, 0], [9, 0]]"

#define LIFT(keys) STOREYS "lifts: {e: {" keys "}}\n" GROUP
#define SHAFT "area: [[10, 5], [11.6, 6.8]]"
#define DOOR "door: [[10.3, 5], [11.2, 5]]"
#define IN_LIFT STOREYS "lifts: {e: {" SHAFT ", " DOOR "}}\n"

static const JoxErrorCase CASES[] = {
    {"lifts: @{e: {" SHAFT ", " DOOR "}}\n" GROUP, "missing-key", "storeys: {"},
    {LIFT(SHAFT ", " DOOR ", capacity: @0"), "out-of-range", NULL},
    {LIFT(SHAFT ", " DOOR ", capacity: @30"), "bad-lift", NULL},
    {LIFT(SHAFT ", " DOOR ", opening: @-1"), "out-of-range", NULL},
    {LIFT(SHAFT ", " DOOR ", speed: @0"), "out-of-range", NULL},
    {LIFT(SHAFT ", " DOOR ", home: @frist"), "unknown-storey", "Did you mean 'first'?"},
    {LIFT(SHAFT ", " DOOR ", storeys: [ground, @second]"), "unknown-storey", NULL},
    {STOREYS "lifts: {e: @{" SHAFT ", " DOOR ", storeys: [first]}}\n" GROUP, "bad-lift",
     "storeys: ["},
    {LIFT(SHAFT ", " DOOR ", mode: @broken"), "bad-value", NULL},
    {STOREYS "lifts: {e: @{" SHAFT "}}\n" GROUP, "bad-lift", "door: ["},
    {STOREYS "lifts: {e: @{" SHAFT ", door: [[10.3, 4], [11.2, 4]]}}\n" GROUP, "bad-lift",
     "one side"},
    {STOREYS "lifts: {e: @{" SHAFT ", door: [[10.3, 5], [10.6, 5]]}}\n" GROUP, "bad-lift",
     "0.8 to 1.1 m"},
    {STOREYS "lifts: {e: {" SHAFT ", " DOOR "}, w: @{area: [[11, 5], [13, 7]], door: [[11.2, 5], "
             "[12.2, 5]]}}\n" GROUP,
     "bad-lift", "Move"},
    {STOREYS "lifts: {e: @{" SHAFT ", " DOOR "}}\nstairs: {n: {from: ground, to: first, path: [[6, "
             "6], [12, 6]]}}\n" GROUP,
     "bad-lift", "Move"},
    {STOREYS "lifts: {e: {" SHAFT ", " DOOR
             "}}\nevents: [{at: 5, lift: @w, mode: firemen}]\n" GROUP,
     "unknown-lift", NULL},
    {STOREYS "lifts: {e: {" SHAFT ", " DOOR "}}\n"
             "groups: {g: {at: [[0, 0]], journey: [{ride: @e.frist}]}}\n",
     "unknown-place", "Did you mean 'e.first'?"},
    {STOREYS "lifts: {e: @{" SHAFT ", door: [[10.3, 5], [10.89, 5]]}}\n" GROUP, "bad-lift",
     "0.8 to 1.1 m"},
    {STOREYS "lifts: {e: {" SHAFT ", " DOOR ", storeys: [ground, first, @ground]}}\n" GROUP,
     "duplicate-name", "Keep one"},
    {STOREYS "walls: [{line: [[0, 0], [9, 0]], storey: [first, @first]}]\n" GROUP, "duplicate-name",
     "Keep one"},
    /* The one error is that of the lift: its places and its name are not missed. */
    {STOREYS "lifts: {e: @{" SHAFT ", door: [[10.3, 4], [11.2, 4]]}}\n"
             "events: [{at: 5, lift: e, mode: firemen}, {at: 6, open: e.first}]\n"
             "groups: {g: {at: [[0, 0]], journey: [{ride: e.first}]}}\n",
     "bad-lift", "one side"},
    {IN_LIFT "groups: {g: @{behaviour: stander, at: [[11, 6]], storey: first}}\n", "no-floor",
     "`home`"},
    {IN_LIFT "groups: {g: @{behaviour: stander, starts: [[3, 11, 6]]}}\n", "no-floor",
     "out of the shaft"},
    {IN_LIFT "groups: {g: @{behaviour: stander, count: 1, in: e.first}}\n", "no-floor", "`home`"},
    {IN_LIFT "bodies: [@{shape: {sphere: {radius: 0.2}}, mass: 9, at: [11, 6, 1]}]\n", "no-floor",
     "out of the shaft"},
    {IN_LIFT GROUP "sources: [@{like: g, at: e.ground, rate: 1}]\n", "no-floor", "outside"},
    {IN_LIFT "places: {a: {polygon: [[9.9, 4.9], [11.7, 4.9], [11.7, 6.9], [9.9, 6.9]]}}\n" GROUP
             "sources: [@{like: g, at: a, rate: 1}]\n",
     "no-floor", "outside"},
    {STOREYS "stairs: {n: {from: ground, to: first, " PLAIN "}}\n"
             "bodies: [@{shape: {sphere: {radius: 0.2}}, mass: 9, at: [6, 0, 1]}]\n",
     "no-floor", "name of the stair"},
    {STOREYS "groups: {g: {behaviour: stander, at: [[0, 0]], set: {lifts: @sometimes}}}\n",
     "bad-value", "never, either, only, or a number from 0 to 1"},
    {STOREYS "places: {a: {point: [0, 0], storey: @frist}}\n" GROUP, "unknown-storey",
     "Did you mean 'first'?"},
    {"walls: [{line: [[0, 0], [9, 0]], storey: [@first]}]\n" GROUP, "unknown-storey", "storeys: {"},
    {"storeys: {a: {height: 3}, b: {height: @3}}\n" GROUP, "bad-storey", "from the lowest up"},
    {"storeys: {a: @{}}\n" GROUP, "missing-key", NULL},
    {STOREYS "bounds: [[0, 0], [9, 9]]\nperiodic: @both\n" GROUP, "bad-value", "periodic: x"},
    {STOREYS "stairs: {@a/b: {from: ground, to: first, " PLAIN "}}\n" GROUP, "bad-name", NULL},
    {STOREYS "stairs: {first: @{from: ground, to: first, " PLAIN "}}\n" GROUP, "bad-name", NULL},
    {"stairs: @{n: {from: a, to: a, rise: 1, " PLAIN "}}\n" GROUP, "missing-key", "storeys: {"},
    {STAIR("from: ground, to: @fist, " PLAIN), "unknown-storey", "Did you mean 'first'?"},
    {STAIR("from: first, to: @ground, " PLAIN), "bad-stair", "Exchange"},
    {STOREYS "stairs: {n: @{from: ground, to: ground, " PLAIN "}}\n" GROUP, "missing-key",
     "rise: 1.2"},
    {BOUND(PLAIN ", rise: @2"), "bad-stair", "Leave it out"},
    {BOUND("path: @[[4, 0], [6, 0]]"), "bad-stair", "longer"},
    {BOUND("path: [[4, 0], @[9, 0], [4, 0.5]]"), "bad-stair", "Turn twice"},
    {BOUND("path: [[4, 0], [9, 0], @[9, 0.5], [4, 0.5]]"), "bad-stair", "narrower"},
    {BOUND("path: @[[4, 0], [9, 0], [9, 1.2], [4, 1.2]]"), "bad-stair", "farther apart"},
    {BOUND("path: [[4, 0], [9, 0], @[9, 0.01]]"), "bad-stair", "Leave it out"},
    {BOUND(PLAIN ", landings: [[1, 2], @[1.5, 3]]"), "bad-stair", "landings: ["},
    {BOUND(PLAIN ", landings: [@[4, 6]]"), "bad-stair", NULL},
    {BOUND("landings: [[0, 5]], path: @[[4, 0], [9, 0]]"), "bad-stair", "longer"},
    {BOUND("path: @[[4, 0], [900, 0]]"), "too-large", "millimetres"},
    {BOUND(PLAIN ", width: @0.3"), "out-of-range", NULL},
    {BOUND(PLAIN ", speed: @0.5"), "bad-stair", "escalator"},
    {STOREYS "stairs: {n: @{from: ground, to: first, kind: escalator, " PLAIN "}}\n" GROUP,
     "bad-stair", "way: up"},
    {STOREYS "stairs: {n: @{from: ground, to: first, " PLAIN "}}\n"
             "walls: [{line: [[3.7, -3], [3.7, 3]]}]\n" GROUP,
     "bad-stair", "turn the stair round"},
    {STOREYS "stairs: {n: {from: ground, to: first, " PLAIN "}, "
             "m: @{from: ground, to: first, path: [[6, -3], [6, 2]]}}\n" GROUP,
     "bad-stair", "one above the other"},
    {STOREYS "stairs: {n: {from: ground, to: first, " PLAIN "}}\n"
             "places: {a: @{point: [6, 0], storey: first}}\n" GROUP,
     "no-floor", "name of the stair"},
    {STOREYS "stairs: {n: {from: ground, to: first, " PLAIN "}}\n"
             "places: {a: @{point: [6, 2], storey: n}}\n" GROUP,
     "no-floor", "onto the stair"},
    {STOREYS "stairs: {n: {from: ground, to: first, " PLAIN "}}\n"
             "groups: {g: @{behaviour: stander, at: [[0, 0], [6, 0]], storey: first}}\n",
     "no-floor", "Move it"},
    {STOREYS SQUARE "groups: {g: {behaviour: stander, count: 1, in: box, storey: @first}}\n",
     "bad-group", "places of `in`"},
    {STOREYS "stairs: {north: {from: ground, to: first, " PLAIN "}}\nevents: [{at: 5, close: "
             "@norht}]\n" GROUP,
     "unknown-wall", "Did you mean 'north'?"},
    {STOREYS CRATE "events: [{at: 5, throw: crate, velocity: [1, 0, 0], storey: @first}]\n",
     "bad-event", "from: ["},
    {STOREYS CRATE "scenery: [{kind: bench, at: [0, 0], body: crate, storey: @first}]\n",
     "bad-scenery", "Leave it out"},
    {"storeys: {a: {height: 0}, b: {height: 3}, c: {height: 6}, d: {height: 9}}\n"
     "stairs: @{n: {from: a, to: d, path: [[0, 0], [20, 0]]}}\n"
     "walls: [{line: [[0, -900], [0, 900]]}]\n" GROUP,
     "too-large", "less deep"},
};

static void every_error_has_position_and_hint(void **state) {
    (void)state;
    assert_int_equal(count_wrong_cases(CASES, sizeof CASES / sizeof *CASES), 0);
}

static void unjoined_storeys_and_steep_ramps_are_warnings(void **state) {
    (void)state;
    JoxDiagnostics d = {0};
    JoxSceneSpec *scene =
        read_scene_text("jostle: 1\nstoreys: {a: {height: 0}, b: {height: 1}, c: {height: 9}}\n"
                        "stairs: {r: {kind: ramp, from: a, to: b, path: [[4, 0], [8, 0]]}}\n" GROUP,
                        NULL, 0, &d);
    if (d.count != 2)
        print_diagnostics(&d, "two warnings are due");
    assert_non_null(scene);
    assert_int_equal(d.count, 2);
    assert_true(is_diagnostic(&d.items[0], "steep-ramp", 3, 48, "kind: stairs"));
    assert_true(is_diagnostic(&d.items[1], "storey-alone", 2, 43, "stairs: {"));
    jox_scene_free(scene);
    jox_diag_free(&d);
}

static void walls_in_stairs_and_shafts_are_warnings(void **state) {
    (void)state;
    JoxDiagnostics d = {0};
    JoxSceneSpec *scene = read_scene_text(
        "jostle: 1\n" IN_LIFT "stairs: {n: {from: ground, to: first, " PLAIN "}}\n"
        "walls:\n"
        "  - {line: [[6, -3], [6, 3]], storey: first}\n"        /* across the stair */
        "  - {solid: [[9, 6], [12, 6], [12, 6.2], [9, 6.2]]}\n" /* through the shaft */
        "  - {line: [[3, 0.6], [9, 0.6]], storey: first}\n"     /* along the stair's edge */
        "  - {line: [[9.95, 4], [9.95, 7]]}\n"                  /* along the shaft */
        "  - {line: [[6, -3], [6, -1]], storey: n}\n" GROUP,    /* on the stair's sheet */
        NULL, 0, &d);
    if (d.count != 2)
        print_diagnostics(&d, "two warnings are due");
    assert_non_null(scene);
    assert_int_equal(d.count, 2);
    assert_true(is_diagnostic(&d.items[0], "wall-without-effect", 6, 5, "End it at the stair"));
    assert_true(is_diagnostic(&d.items[1], "wall-without-effect", 7, 5, "End it at the shaft"));
    jox_scene_free(scene);
    jox_diag_free(&d);
}

static void nobody_is_placed_in_a_shaft_without_a_car(void **state) {
    (void)state;
    JoxDiagnostics d = {0};
    JoxSceneSpec *scene = read_scene_text(
        "jostle: 1\n" STOREYS "lifts: {e: {" SHAFT
        ", door: [[10.3, 5], [10.9, 5]]}}\n" /* as narrow as doors may be */
        "places: {a: {polygon: [[9, 4], [13, 4], [13, 8], [9, 8]], storey: first}}\n"
        "groups: {g: {behaviour: stander, count: 60, fill: random, in: a}, "
        "h: {behaviour: stander, count: 4, in: e.ground}}\n",
        NULL, 0, &d);
    if (!scene || d.count)
        print_diagnostics(&d, "nothing is wrong");
    assert_non_null(scene);
    for (uint32_t g = 0; g < 2; g++)
        for (uint32_t i = 0; i < scene->groups[g].count; i++)
            assert_int_equal(
                jox_polygon_contains(scene->lifts[0].outline, 4,
                                     jox_in_plan(&scene->storeys, scene->groups[g].positions[i])),
                g);
    jox_scene_free(scene);
    jox_diag_free(&d);
}

#define PLACED                                                                                     \
    "jostle: 1\n" STOREYS "stairs: {n: {from: ground, to: first, " PLAIN "}}\n"                    \
    "places: {low: {point: [20, 7]}, high: {point: [20, 7], storey: first}, "                      \
    "stair: {polygon: [[5, -0.5], [6, -0.5], [6, 0.5], [5, 0.5]], storey: n}}\n"                   \
    "walls: [{line: [[-30, 9], [30, 9]], storey: [ground, first], name: far}]\n"                   \
    "bodies: [{shape: {box: {size: [1, 1, 1]}}, mass: 9, at: [15, 5, 1], storey: first}]\n"        \
    "probes: {p: {flow: [[0, 5], [0, 6]], storey: first}, d: {displacement: true, along: [0, 1]}}" \
    "\n"                                                                                           \
    "heatmap: {area: [[0, 0], [9, 9]], storey: first}\n"                                           \
    "groups: {g: {behaviour: stander, at: [[20, 5]], storey: first}, "                             \
    "s: {behaviour: stander, starts: [[3, 20, 6]], storey: first}}\n"

static void assert_moved(JoxV2 at, JoxV2 plan, const JoxStoreys *s, uint32_t sheet) {
    assert_true(jox_length(jox_sub(at, jox_on_sheet(s, sheet, plan))) < 1e-4f);
    assert_true(jox_length(jox_sub(jox_in_plan(s, at), plan)) < 1e-4f);
    assert_int_equal(jox_sheet_of(s, at.y), sheet);
}

static void points_are_positions_on_their_sheet(void **state) {
    (void)state;
    JoxDiagnostics d = {0};
    JoxSceneSpec *scene = read_scene_text(PLACED, NULL, 0, &d);
    if (!scene || d.count)
        print_diagnostics(&d, PLACED);
    assert_non_null(scene);
    const JoxStoreys *s = &scene->storeys;
    assert_int_equal(s->sheet_count, 3);
    assert_moved(scene->places[0].centre, jox_v2(20, 7), s, 0);
    assert_moved(scene->places[1].centre, jox_v2(20, 7), s, 1);
    assert_moved(scene->places[2].points[0], jox_v2(5, -0.5f), s, 2);
    const JoxBodyDef *body = &scene->bodies[0].def;
    assert_moved(jox_v2((float)body->position[0], (float)body->position[1]), jox_v2(15, 5), s, 1);
    assert_moved(scene->probes[0].points[0], jox_v2(0, 5), s, 1);
    assert_true(scene->probes[1].points[0].y == 1.0f); /* a direction */
    assert_moved(scene->heatmap_low, jox_v2(0, 0), s, 1);
    assert_moved(scene->groups[0].positions[0], jox_v2(20, 5), s, 1);
    assert_moved(scene->groups[1].starts[0].at, jox_v2(20, 6), s, 1);
    uint32_t far = 0;
    for (uint32_t r = 0; r < scene->walls.ring_count; r++)
        if (scene->walls.rings[r].name)
            assert_moved(scene->walls.vertices[scene->walls.rings[r].first].point, jox_v2(-30, 9),
                         s, far++);
    assert_int_equal(far, 2);
    jox_scene_free(scene);
    jox_diag_free(&d);
}

static void positions_are_told_with_their_storey(void **state) {
    (void)state;
    JoxDiagnostics d = {0};
    JoxText text = {0};
    JoxSceneSpec *scene = read_scene_text(PLACED, NULL, 0, &d);
    assert_non_null(scene);
    for (uint32_t p = 0; p < 3; p++) {
        jox_text_position(&text, &scene->storeys, scene->places[p].centre, 1);
        jox_text_add(&text, "; ");
    }
    jox_text_position(&text, NULL, jox_v2(1.25f, 3), -1);
    assert_string_equal(text.data, "(20.0, 7.0) m on ground; (20.0, 7.0) m on first; "
                                   "(5.5, 0.0) m on the stair n; (1.25, 3) m");
    jox_text_free(&text);
    jox_scene_free(scene);
    jox_diag_free(&d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_error_has_position_and_hint),
        cmocka_unit_test(unjoined_storeys_and_steep_ramps_are_warnings),
        cmocka_unit_test(walls_in_stairs_and_shafts_are_warnings),
        cmocka_unit_test(nobody_is_placed_in_a_shaft_without_a_car),
        cmocka_unit_test(points_are_positions_on_their_sheet),
        cmocka_unit_test(positions_are_told_with_their_storey),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
