/* Tests the kernel of field lookups against single lookups, bitwise, on every instruction set of
   the machine: on open floor, at walls, in solids, at the goal, outside the box, at borders of
   cells, and for NaN and infinity. */
#include "geom_walk.h"

#define X(name, isa) [isa] = jox_field_look_##name,
static JoxFieldKernel *const LOOK[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

enum { ROUNDS = 40 };
static const float HALF = 6.0f; /* m: half the side of the box */

static float draw_between(uint32_t k, uint32_t sub, float from, float to) {
    return from + (to - from) * (float)draw_walk_number(k, sub);
}

/* Makes a room with a door, a slanted wall and a block in it. */
static JoxWalls make_room_plan(double angle) {
    JoxWalls walls = {0};
    add_turned_line(&walls, (JoxV2[]){{-4, -3}, {-4, 3}, {4, 3}, {4, -3}, {0.7f, -3}}, 5, angle);
    add_turned_line(&walls, (JoxV2[]){{-0.4f, -3}, {-4, -3}}, 2, angle);
    add_turned_line(&walls, (JoxV2[]){{-2, -1}, {-1, 2}}, 2, angle);
    add_turned_solid(&walls, (JoxV2[]){{1, -1}, {3, -1}, {3, 1}, {1, 1}}, 4, angle);
    return walls;
}

/* Returns a point anywhere, at the goal, on a border of cells or on a wall, far outside, or NaN. */
static JoxV2 draw_lookup_point(uint32_t k, const JoxField *field, JoxV2 goal, double angle) {
    JoxV2 low, high;
    float size;
    jox_field_box(field, &low, &high, &size);
    const float cell = floorf(draw_between(k, 3, 0, (high.x - low.x) / size));
    switch ((int)(10.0 * draw_walk_number(k, 2))) {
    case 0:
        return jox_add(goal,
                       (JoxV2){draw_between(k, 0, -0.4f, 0.4f), draw_between(k, 1, -0.4f, 0.4f)});
    case 1:
        return (JoxV2){low.x + size * cell, low.y + size * (cell + 0.5f)};
    case 2:
        return turn_point((JoxV2){draw_between(k, 0, -4, 4), 3}, angle);
    case 3:
        return (JoxV2){draw_between(k, 0, -9, 9), draw_between(k, 1, -9, 9)};
    case 4:
        return (JoxV2){k % 3 ? INFINITY : NAN, k % 2 ? -1e30f : 0.0f};
    case 5:
        return turn_point((JoxV2){draw_between(k, 0, 0.9f, 3.1f), draw_between(k, 1, -1.1f, 1.1f)},
                          angle);
    default:
        return (JoxV2){draw_between(k, 0, low.x, high.x), draw_between(k, 1, low.y, high.y)};
    }
}

static void assert_same_float(const void *is, const void *wanted, JoxV2 p) {
    if (memcmp(is, wanted, sizeof(float)))
        fail_msg("at %g %g: %g, not %g", (double)p.x, (double)p.y, (double)*(const float *)is,
                 (double)*(const float *)wanted);
}

static void compare_lookups(const JoxField *field, JoxFieldKernel *look, uint32_t number,
                            JoxV2 goal, double angle) {
    static JoxFieldPoints points;
    points.count =
        number % 5 == 0 ? JOX_FIELD_POINTS : 1 + (uint32_t)(255 * draw_walk_number(number, 9));
    for (uint32_t k = 0; k < JOX_FIELD_POINTS; k++) {
        const JoxV2 p = draw_lookup_point(number * JOX_FIELD_POINTS + k, field, goal, angle);
        points.x[k] = p.x;
        points.y[k] = p.y;
    }
    look(field, &points);
    for (uint32_t k = 0; k < points.count; k++) {
        const JoxV2 p = {points.x[k], points.y[k]}, way = jox_field_direction(field, p);
        const float length = jox_field_distance(field, p);
        assert_same_float(&points.way_x[k], &way.x, p);
        assert_same_float(&points.way_y[k], &way.y, p);
        assert_same_float(&points.length[k], &length, p);
    }
}

static void lookups_in_lanes_equal_single_lookups(void **state) {
    (void)state;
    static const float CELLS[] = {0.125f, 0.3f, 0.8f};
    for (uint32_t number = 0; number < ROUNDS; number++) {
        const double angle = number % 4 == 0 ? 0.0 : 0.3 * number;
        const JoxV2 goal = turn_point(number % 3 ? (JoxV2){0, -5} : (JoxV2){-3, 2.5f}, angle);
        JoxWalls walls = make_room_plan(angle);
        if (number % 8 == 7) /* no walls: no cell has a patch */
            jox_walls_free(&walls);
        JoxField *field = make_field_to_point(&walls, goal, HALF, CELLS[number % 3], 0.15f);
        for (JoIsa isa = JO_ISA_SCALAR; isa < (JoIsa)JOX_ISA_ROOM; isa++)
            if (LOOK[isa] && jox_isa_runs(isa))
                compare_lookups(field, LOOK[isa], number, goal, angle);
        jox_field_free(field);
        jox_walls_free(&walls);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(lookups_in_lanes_equal_single_lookups)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
