/* Tests polygons, crossings, places and walls. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "geom/place.h"
#include "geom/place_kinds.h"
#include "geom/walls.h"

static const JoxV2 SQUARE[] = {{0, 0}, {4, 0}, {4, 2}, {0, 2}};

static void polygons_have_area_centroid_and_distance(void **state) {
    (void)state;
    assert_true(jox_polygon_area(SQUARE, 4) == 8.0);
    JoxV2 c = jox_polygon_centroid(SQUARE, 4);
    assert_true(c.x == 2.0f && c.y == 1.0f);
    assert_true(jox_polygon_contains(SQUARE, 4, (JoxV2){1, 1}));
    assert_false(jox_polygon_contains(SQUARE, 4, (JoxV2){5, 1}));
    assert_true(jox_polygon_distance(SQUARE, 4, (JoxV2){7, 6}, true) == 5.0f);
    assert_true(jox_polygon_distance(SQUARE, 4, (JoxV2){1, 1}, true) == 0.0f);
    assert_true(jox_polygon_distance(SQUARE, 4, (JoxV2){1, 0.5f}, false) == 0.5f);
}

static void self_crossing_is_found_with_its_edges(void **state) {
    (void)state;
    const JoxV2 bow[] = {{0, 0}, {2, 2}, {2, 0}, {0, 2}};
    const JoxV2 spike[] = {{0, 0}, {4, 0}, {2, 0}, {0, 4}};
    uint32_t a, b;
    assert_true(jox_polygon_self_crosses(bow, 4, &a, &b));
    assert_int_equal(a, 0);
    assert_int_equal(b, 2);
    assert_true(jox_polygon_self_crosses(spike, 4, &a, &b));
    assert_false(jox_polygon_self_crosses(SQUARE, 4, &a, &b));
}

static void a_crossing_is_directed_and_counted_once(void **state) {
    (void)state;
    JoxV2 a = {0, 0}, b = {10, 0};
    assert_int_equal(jox_segment_crossing(a, b, (JoxV2){5, -1}, (JoxV2){5, 1}), 1);
    assert_int_equal(jox_segment_crossing(a, b, (JoxV2){5, 1}, (JoxV2){5, -1}), -1);
    assert_int_equal(jox_segment_crossing(a, b, (JoxV2){11, -1}, (JoxV2){11, 1}), 0);
    /* A move that stops exactly on the line crosses it once, and moving back undoes that. */
    int split = jox_segment_crossing(a, b, (JoxV2){5, -1}, (JoxV2){5, 0}) +
                jox_segment_crossing(a, b, (JoxV2){5, 0}, (JoxV2){5, 1});
    assert_int_equal(split, 1);
    int back = jox_segment_crossing(a, b, (JoxV2){5, -1}, (JoxV2){5, 0}) +
               jox_segment_crossing(a, b, (JoxV2){5, 0}, (JoxV2){5, -1});
    assert_int_equal(back, 0);
}

static void places_contain_points_by_kind(void **state) {
    (void)state;
    JoxV2 point = {10, 0}, line[] = {{0, 5}, {4, 5}}, queue[] = {{0, 0}, {0, -2}, {3, -2}};
    int32_t members[] = {1, 2};
    JoxPlace places[] = {
        {.name = "yard", .kind = JOX_PLACE_POLYGON, .points = (JoxV2 *)SQUARE, .count = 4},
        {.name = "post", .kind = JOX_PLACE_POINT, .points = &point, .count = 1, .radius = 1},
        {.name = "gate", .kind = JOX_PLACE_LINE, .points = line, .count = 2},
        {.name = "row", .kind = JOX_PLACE_QUEUE, .points = queue, .count = 3, .spacing = 0.5f},
        {.name = "both", .kind = JOX_PLACE_SET, .members = members, .member_count = 2},
    };
    for (int i = 0; i < 5; i++)
        jox_place_finish(&places[i]);
    assert_true(jox_place_contains(places, 0, (JoxV2){1, 1}));
    assert_true(jox_place_contains(places, 4, (JoxV2){10.5f, 0}));
    assert_true(jox_place_contains(places, 4, (JoxV2){2, 5.2f}));
    assert_false(jox_place_contains(places, 4, (JoxV2){5, 1}));
    assert_true(jox_place_distance(places, 2, (JoxV2){2, 9}) == 4.0f);
    JoxV2 q = jox_place_queue_point(&places[3], 3.0f);
    assert_true(q.x == 1.0f && q.y == -2.0f);
    q = jox_place_queue_point(&places[3], 7.0f);
    assert_true(q.x == 5.0f && q.y == -2.0f);
    assert_int_equal(jox_place_find(places, 5, "row"), 3);
    assert_int_equal(jox_place_find(places, 5, "tower"), -1);
    /* The stadium around a 4 x 2 rectangle: its axis runs along x from 1 to 3, half width 1. */
    float low = fminf(places[0].axis_a.x, places[0].axis_b.x);
    float high = fmaxf(places[0].axis_a.x, places[0].axis_b.x);
    assert_true(fabsf(low - 1) < 1e-5f && fabsf(high - 3) < 1e-5f);
    assert_true(fabsf(places[0].axis_radius - 1) < 1e-5f);
}

/* Boxes of a set's members change no result, however many there are. */
static void a_set_contains_what_its_members_contain(void **state) {
    (void)state;
    enum { MOST = 9 };
    for (uint32_t round = 0; round < 60; round++) {
        const uint32_t count = 1 + round % MOST;
        JoxV2 points[MOST][4], *corners = points[0];
        int32_t members[MOST];
        JoxPlace places[MOST + 2] = {{0}};
        JoxPlaceBoxes boxes[JOX_PLACE_FOURS(MOST)];
        for (uint32_t m = 0; m < count; m++) {
            const JoxV2 at = {(float)(m * 7 % 5), (float)(m * 3 % 4)};
            const JoxPlaceKind kinds[] = {JOX_PLACE_POLYGON, JOX_PLACE_POINT, JOX_PLACE_LINE,
                                          JOX_PLACE_QUEUE};
            const JoxPlaceKind kind = kinds[(round + m) % 4];
            const uint32_t of = kind == JOX_PLACE_POLYGON ? 4 : kind == JOX_PLACE_POINT ? 1 : 2;
            for (int k = 0; k < 4; k++)
                points[m][k] = jox_add(at, jox_scale(SQUARE[k], 0.2f));
            places[m] = (JoxPlace){.kind = kind, .points = corners + 4 * (size_t)m, .count = of};
            places[m].radius = places[m].spacing = 0.7f;
            jox_place_finish(&places[m]);
            members[m] = (int32_t)m;
        }
        for (int s = 0; s < 2; s++)
            places[count + s] =
                (JoxPlace){.kind = JOX_PLACE_SET, .members = members, .member_count = count};
        jox_place_finish_set(places, &places[count + 1], boxes);
        for (uint32_t n = 0; n < 400; n++) {
            const JoxV2 p = {(float)(n % 20) * 0.35f - 1.0f, (float)(n / 20) * 0.3f - 1.0f};
            bool held = false;
            for (uint32_t m = 0; m < count; m++)
                held |= jox_place_contains(places, m, p);
            assert_int_equal(jox_place_contains(places, count, p), held);
            assert_int_equal(jox_place_contains(places, count + 1, p), held);
        }
    }
}

static void walls_are_linked_rings(void **state) {
    (void)state;
    JoxWalls walls = {0};
    const JoxV2 clockwise[] = {{0, 2}, {4, 2}, {4, 0}, {0, 0}};
    jox_walls_add_solid(&walls, clockwise, 4, INFINITY);
    assert_int_equal(walls.count, 4);
    for (uint32_t i = 0; i < 4; i++) {
        const JoxWallVertex *v = &walls.vertices[i];
        assert_true(v->convex);
        assert_int_equal(walls.vertices[v->next].previous, i);
        JoxV2 inward = jox_left(v->direction);
        JoxV2 middle = jox_add(v->point, jox_scale(v->direction, 0.5f));
        assert_true(jox_polygon_contains(SQUARE, 4, jox_add(middle, jox_scale(inward, 0.1f))));
    }
    const JoxV2 bend[] = {{10, 0}, {12, 0}, {12, 2}};
    jox_walls_add_polyline(&walls, bend, 3, false, INFINITY);
    assert_int_equal(walls.count, 8);
    int concave = 0;
    for (uint32_t i = 4; i < 8; i++)
        concave += !walls.vertices[i].convex;
    assert_int_equal(concave, 1); /* the bend, seen from its inner side */
    jox_walls_add_polyline(&walls, clockwise, 4, true, 1.0f);
    assert_int_equal(walls.ring_count, 4);
    for (uint32_t i = 8; i < 12; i++) /* one ring faces out, the other in */
        assert_true(walls.vertices[i].convex != walls.vertices[i + 4].convex);
    jox_walls_free(&walls);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_have_area_centroid_and_distance),
        cmocka_unit_test(self_crossing_is_found_with_its_edges),
        cmocka_unit_test(a_crossing_is_directed_and_counted_once),
        cmocka_unit_test(places_contain_points_by_kind),
        cmocka_unit_test(a_set_contains_what_its_members_contain),
        cmocka_unit_test(walls_are_linked_rings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
