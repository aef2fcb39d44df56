/* Bodies that ways lead round: which count, and when they have moved. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/number/elementary.h"
#include "world/routes/body_obstacles.h"

/* A box of 2 a by 2 b m about (x, y), turned. */
static JoxObject box(uint32_t id, float x, float y, float a, float b, double angle) {
    JoxObject o = {.id = id, .live = true, .in_band = true, .moves = true, .footprint_count = 4};
    const float corner[4][2] = {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
    float c = (float)jox_cos(angle), s = (float)jox_sin(angle);
    for (int k = 0; k < 4; k++)
        o.footprint[k] = (JoxV2){x + c * corner[k][0] - s * corner[k][1],
                                 y + s * corner[k][0] + c * corner[k][1]};
    o.position = (JoxV3){x, y, 0.5f};
    return o;
}

static uint32_t count_of(JoxObject object) {
    JoxObstacles obstacles = {0};
    JoxObjects objects = {.rows = &object, .count = 1};
    jox_obstacles_update(&obstacles, &objects);
    uint32_t count = obstacles.count;
    jox_obstacles_free(&obstacles);
    return count;
}

static void standing_and_large_bodies_are_obstacles(void **state) {
    (void)state;
    JoxObject wardrobe = box(1, 0, 0, 0.6f, 0.3f, 0.3), chair = box(2, 0, 0, 0.25f, 0.25f, 0.0);
    assert_int_equal(count_of(wardrobe), 1);
    assert_int_equal(count_of(chair), 0);
    chair.moves = false; /* bolted down */
    assert_int_equal(count_of(chair), 1);
    JoxObject other = wardrobe;
    other.velocity.x = 0.6f;
    assert_int_equal(count_of(other), 0);
    other = wardrobe;
    other.held = true;
    assert_int_equal(count_of(other), 0);
    other = wardrobe;
    other.swept = true;
    assert_int_equal(count_of(other), 0);
    other = wardrobe;
    other.in_band = false; /* a lamp above their heads */
    assert_int_equal(count_of(other), 0);
    JoxObject pillar = {.id = 3, .live = true, .in_band = true, .moves = true, .round = 0.6f};
    assert_int_equal(count_of(pillar), 1);
    pillar.round = 0.4f;
    assert_int_equal(count_of(pillar), 0);
}

static void body_counts_as_moved_beyond_0_3_m(void **state) {
    (void)state;
    JoxObject rows[2] = {box(1, 0, 0, 1.5f, 0.1f, 0.0), box(2, 5, 0, 1.0f, 1.0f, 0.0)};
    JoxObjects objects = {.rows = rows, .count = 2};
    JoxObstacles obstacles = {0};
    jox_obstacles_update(&obstacles, &objects);
    uint32_t first = obstacles.version;
    jox_obstacles_update(&obstacles, &objects);
    rows[0] = box(1, 0.28f, 0, 1.5f, 0.1f, 0.0);
    jox_obstacles_update(&obstacles, &objects);
    rows[0] = box(1, 0, 0, 1.5f, 0.1f, 0.15); /* an end by 0.22 m */
    jox_obstacles_update(&obstacles, &objects);
    assert_int_equal(obstacles.version, first);
    rows[0] = box(1, 0.32f, 0, 1.5f, 0.1f, 0.0); /* along itself */
    jox_obstacles_update(&obstacles, &objects);
    assert_int_equal(obstacles.version, first + 1);
    rows[0] = box(1, 0.32f, 0, 1.5f, 0.1f, 0.25); /* turned about its centre, which stays */
    jox_obstacles_update(&obstacles, &objects);
    assert_int_equal(obstacles.version, first + 2);
    rows[1].live = false;
    jox_obstacles_update(&obstacles, &objects);
    assert_int_equal(obstacles.version, first + 3);
    assert_int_equal(obstacles.count, 1);
    rows[1] = box(9, 5, 0, 1.0f, 1.0f, 0.0); /* another body in the same row */
    jox_obstacles_update(&obstacles, &objects);
    assert_int_equal(obstacles.count, 2);
    jox_obstacles_free(&obstacles);
}

static void obstacles_become_solids(void **state) {
    (void)state;
    JoxObject rows[2] = {box(1, 0, 0, 1.5f, 0.1f, 0.0),
                         {.id = 2, .live = true, .in_band = true, .round = 1.0f}};
    JoxObjects objects = {.rows = rows, .count = 2};
    JoxObstacles obstacles = {0};
    JoxWalls walls = {0};
    jox_obstacles_update(&obstacles, &objects);
    jox_obstacles_add(&obstacles, 1u << JOX_OBSTACLE_FIXED, &walls); /* the round one is static */
    assert_int_equal(walls.ring_count, 1);
    for (uint32_t i = 0; i < walls.count; i++) { /* the polygon holds the circle */
        JoxV2 a = walls.vertices[i].point, b = walls.vertices[walls.vertices[i].next].point;
        JoxV2 middle = {(a.x + b.x) / 2, (a.y + b.y) / 2};
        assert_true(jox_length(middle) > 0.999f && jox_length(a) < 1.05f);
    }
    jox_obstacles_add(&obstacles, JOX_OBSTACLES_ALL, &walls);
    assert_int_equal(walls.ring_count, 3);
    assert_true(walls.rings[1].solid && walls.rings[1].count == 4);
    jox_walls_free(&walls);
    jox_obstacles_free(&obstacles);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(standing_and_large_bodies_are_obstacles),
        cmocka_unit_test(body_counts_as_moved_beyond_0_3_m),
        cmocka_unit_test(obstacles_become_solids),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
