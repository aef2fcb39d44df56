/* Tests the marching against a plain implementation, which searches all open nodes for the next one
   and tries every way through its neighbours. */
#include "base/mem.h"
#include "geom/field/field_parts.h"
#include "geom/place_kinds.h"
#include "unit/geom_walk.h"

enum { SIDE = 56, CELLS = SIDE * SIDE };
static const float SIZE = 0.25f;

/* Quickest way to a node so far. */
typedef struct Reached {
    float time, length;
    JoxV2 way;
    bool finished;
} Reached;

static void offer_way(Reached *to, float time, float length, JoxV2 way) {
    if (time < to->time)
        *to = (Reached){time, length, jox_scale(way, 1.0f / jox_length(way)), false};
}

static void offer_way_by_side(const JoxFieldWork *w, Reached *all, int cell, int a, int b) {
    const JoxV2 p = jox_field_node(w, cell), from = jox_field_node(w, a);
    const JoxV2 side = jox_sub(jox_field_node(w, b), from), out = jox_sub(p, from);
    const float slowness = w->slowness[cell], rise = all[b].time - all[a].time;
    const float long2 = jox_length2(side), rest2 = slowness * slowness * long2 - rise * rise;
    if (!(rest2 > 0.0f))
        return;
    const float along = jox_dot(out, side) - fabsf(jox_det(out, side)) * rise / sqrtf(rest2);
    const float t = along / long2;
    if (!(along > 0.0f && along < long2 && t > 0.0f && t < 1.0f))
        return;
    const JoxV2 way = jox_sub(jox_add(from, jox_scale(side, t)), p);
    const float far = jox_length(way);
    offer_way(&all[cell], all[a].time + t * rise + slowness * far,
              all[a].length + t * (all[b].length - all[a].length) + far, way);
}

static int find_next_node(const JoxFieldWork *w, const Reached *all) {
    int next = -1;
    for (int i = 0; i < w->count; i++)
        if (!all[i].finished && all[i].time < INFINITY &&
            (next < 0 || all[i].time < all[next].time))
            next = i;
    return next;
}

/* For a goal on open floor, with no wall within 4.5 cells. */
static void march_plainly(const JoxFieldWork *w, JoxV2 goal, Reached *all) {
    for (int i = 0; i < w->count; i++) {
        const JoxV2 way = jox_sub(goal, jox_field_node(w, i));
        const float far = jox_length(way);
        all[i] = (Reached){.time = INFINITY};
        if (w->walled.node[i] == JOX_FIELD_BLOCKED || far > 4.5f * SIZE)
            continue;
        const float close = jox_maxf(far, JOX_FIELD_CLOSE * SIZE);
        all[i] = (Reached){far * w->slowness[i], far, jox_scale(way, 1.0f / close), false};
    }
    for (int i = find_next_node(w, all); i >= 0; i = find_next_node(w, all)) {
        all[i].finished = true;
        for (int k = 0; k < 8; k++) {
            const int j = jox_field_next(w->f, i, k);
            if (!(w->walled.links[i] >> k & 1) || all[j].finished)
                continue;
            const JoxV2 way = jox_sub(jox_field_node(w, i), jox_field_node(w, j));
            const float far = jox_length(way);
            offer_way(&all[j], all[i].time + w->slowness[j] * far, all[i].length + far, way);
            const int back = (k + 4) & 7, left = (back + 1) & 7, right = (back + 7) & 7;
            const int one = jox_field_next(w->f, j, left), two = jox_field_next(w->f, j, right);
            if (w->walled.corners[j] >> back & 1 && all[one].finished)
                offer_way_by_side(w, all, j, i, one);
            if (w->walled.corners[j] >> right & 1 && all[two].finished)
                offer_way_by_side(w, all, j, i, two);
        }
    }
}

/* Compares fields around `origin` with some walls; `rough`: how much slowness varies between
   cells. */
static void expect_same_times(const JoxWalls *walls, JoxV2 origin, JoxV2 goal, float rough) {
    static Reached all[CELLS];
    const float half = 0.5f * SIZE * SIDE;
    JoxField f = {.low = jox_sub(origin, (JoxV2){half, half}),
                  .size = SIZE,
                  .clearance = 0.15f,
                  .columns = SIDE,
                  .rows = SIDE,
                  .cells = jox_alloc(CELLS, sizeof(JoxFieldCell))};
    JoxFieldWork w = {.f = &f,
                      .count = CELLS,
                      .time = jox_alloc(CELLS, sizeof(float)),
                      .slowness = jox_alloc(CELLS, sizeof(float))};
    JoxFieldMarks *marks = NULL;
    JoxPlace place = {.kind = JOX_PLACE_POINT, .points = &goal, .count = 1, .radius = 0.1f};
    jox_place_finish(&place);
    jox_field_mark(&w, walls, &marks);
    for (int i = 0; i < CELLS; i++)
        w.slowness[i] += rough * (float)draw_walk_number((uint32_t)i, 3);
    march_plainly(&w, goal, all);
    jox_field_march(&w, &place, 0);
    for (int i = 0; i < CELLS; i++) {
        assert_true(w.time[i] == all[i].time);
        if (!(w.time[i] < INFINITY))
            continue;
        assert_true(f.cells[i].length == all[i].length);
        if (jox_field_has_edges(&w, i)) /* others are smoothed afterwards */
            assert_true(f.cells[i].x == all[i].way.x && f.cells[i].y == all[i].way.y);
    }
    jox_field_marks_free(marks);
    jox_free(f.cells);
    jox_free(f.patches);
    jox_free(f.edges);
    jox_free(f.refs);
    jox_free(w.time);
    jox_free(w.slowness);
}

/* Nodes on open floor, for which fewer ways are tried; nodes at walls; and nodes so far from the
   origin that cell sizes differ by rounding. */
static void marching_finds_the_quickest_of_all_ways(void **state) {
    (void)state;
    static const JoxV2 block[] = {{1, -3}, {3, -3.5f}, {2, -1}}, line[] = {{-5, -2}, {-1, -3.3f}},
                       hook[] = {{-6, 1}, {-2, 5}, {-2.5f, 5.2f}, {-2, 6}};
    const JoxV2 origins[] = {{0, 0}, {7003.1f, -3}, {120000, 250000}};
    const float rough[] = {0.0f, 0.2f, 4.0f, 40.0f};
    for (int o = 0; o < 3; o++)
        for (int r = 0; r < 4; r++)
            for (int t = 0; t < 3; t++) {
                const JoxV2 goal = jox_add(origins[o], (JoxV2){3.05f, 2.0f + (float)t});
                JoxWalls walls = {0};
                JoxV2 at[3][4];
                for (int k = 0; k < 4; k++) {
                    at[0][k] = jox_add(origins[o], turn_point(block[k % 3], 0.2 * t));
                    at[1][k] = jox_add(origins[o], turn_point(line[k % 2], 0.2 * t));
                    at[2][k] = jox_add(origins[o], turn_point(hook[k], 0.2 * t));
                }
                if (t > 0) {
                    jox_walls_add_solid(&walls, at[0], 3, INFINITY);
                    jox_walls_add_polyline(&walls, at[1], 2, false, INFINITY);
                    jox_walls_add_polyline(&walls, at[2], 4, false, INFINITY);
                }
                expect_same_times(&walls, origins[o], goal, rough[r]);
                jox_walls_free(&walls);
            }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(marching_finds_the_quickest_of_all_ways),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
