/* Tests ground on which people can stand: its parts, and ways over it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geom/ground/standable.h"
#include "geom/place_kinds.h"

static JoxV2 CORNERS[] = {{0, 0}, {10, 0}, {10, 6}, {0, 6}};
static const JoxPlace HALL = {
    .kind = JOX_PLACE_POLYGON, .points = CORNERS, .count = 4, .high = {10, 6}};

static JoxStandable lay_with_wall(const JoxV2 *points, uint32_t count) {
    JoxWalls walls = {0};
    JoxStandable ground = {0};
    jox_walls_add_polyline(&walls, points, count, false, INFINITY);
    jox_standable_lay(&ground, &HALL, 3, 262144.0f, &walls, NULL, NULL);
    jox_walls_free(&walls);
    return ground;
}

static uint32_t find_part_at(const JoxStandable *ground, float x, float y) {
    return jox_standable_part(ground, jox_standable_cell(ground, jox_v2(x, y)));
}

static void ways_on_ground_lead_round_walls(void **state) {
    (void)state;
    const JoxV2 wall[] = {{5, -1}, {5, 4}};
    JoxStandable ground = lay_with_wall(wall, 2);
    JoxV2 next;
    const float way = jox_standable_way(&ground, jox_v2(4, 1), jox_v2(6, 1), &next);
    assert_true(way > 4 && way < 7); /* round the lower or the upper end of the wall */
    assert_true(next.y < -1 || next.y > 4);
    assert_float_equal(jox_standable_way(&ground, jox_v2(4, 5), jox_v2(6, 5), &next), 2, 1e-6);
    assert_float_equal(next.x, 6, 1e-6);
    assert_int_equal(find_part_at(&ground, 4, 1), find_part_at(&ground, 6, 1));
    jox_standable_free(&ground);
}

static void walls_divide_the_place_into_parts(void **state) {
    (void)state;
    const JoxV2 wall[] = {{5, -1}, {5, 7}};
    JoxStandable ground = lay_with_wall(wall, 2);
    JoxV2 next;
    assert_int_equal(ground.part_count, 2);
    assert_int_not_equal(find_part_at(&ground, 4.9f, 3), find_part_at(&ground, 5.1f, 3));
    assert_int_equal(find_part_at(&ground, 4.9f, 3), find_part_at(&ground, -2, 8));
    assert_int_equal(find_part_at(&ground, 5.1f, 3), find_part_at(&ground, 12, 8));
    assert_true(isinf(jox_standable_way(&ground, jox_v2(4, 3), jox_v2(6, 3), &next)));
    jox_standable_free(&ground);
}

static void ground_behind_walls_belongs_to_no_part(void **state) {
    (void)state;
    const JoxV2 wall[] = {{-9, -1}, {20, -1}};
    JoxStandable ground = lay_with_wall(wall, 2);
    assert_int_equal(ground.part_count, 1);
    assert_int_equal(find_part_at(&ground, 5, -0.5f), 1);
    assert_int_equal(find_part_at(&ground, 5, -2), 0);
    assert_int_equal(find_part_at(&ground, 50, 50), 0);
    jox_standable_free(&ground);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ways_on_ground_lead_round_walls),
        cmocka_unit_test(walls_divide_the_place_into_parts),
        cmocka_unit_test(ground_behind_walls_belongs_to_no_part),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
