/* Tests the effect of walls on a field against a search of every edge nearby. */
#include "base/mem.h"
#include "geom/field/field_parts.h"
#include "unit/geom_walk.h"

enum { COLUMNS = 64, ROWS = 52, CELLS = COLUMNS * ROWS };

typedef struct Marked {
    JoxField f;
    JoxFieldWork w;
    JoxFieldMarks *marks;
} Marked;

static void make_marked(Marked *m, const JoxWalls *walls, JoxV2 low, float size, float clearance) {
    *m = (Marked){.f = {.low = low,
                        .size = size,
                        .clearance = clearance,
                        .columns = COLUMNS,
                        .rows = ROWS,
                        .cells = jox_alloc(CELLS, sizeof(JoxFieldCell))}};
    m->w = (JoxFieldWork){.f = &m->f,
                          .count = CELLS,
                          .time = jox_alloc(CELLS, sizeof(float)),
                          .slowness = jox_alloc(CELLS, sizeof(float))};
    jox_field_mark(&m->w, walls, &m->marks);
}

static void free_marked(Marked *m) {
    jox_field_marks_free(m->marks);
    jox_free(m->f.cells);
    jox_free(m->f.patches);
    jox_free(m->f.edges);
    jox_free(m->f.refs);
    jox_free(m->w.time);
    jox_free(m->w.slowness);
}

static bool are_nodes_linked(const JoxFieldWork *w, int cell, int k) {
    const int other = jox_field_next(w->f, cell, k);
    if (other < 0 || w->walled.node[cell] == JOX_FIELD_BLOCKED ||
        w->walled.node[other] == JOX_FIELD_BLOCKED)
        return false;
    if (k >= 4) /* as seen from the other node */
        return are_nodes_linked(w, other, k - 4);
    return (!jox_field_has_edges(w, cell) && !jox_field_has_edges(w, other)) ||
           jox_field_sees(w, jox_field_node(w, cell), jox_field_node(w, other),
                          0.85f * w->f->clearance);
}

static bool is_corner_free(const JoxFieldWork *w, int cell, int t) {
    const int one = jox_field_next(w->f, cell, t), two = jox_field_next(w->f, cell, (t + 1) & 7);
    if (!are_nodes_linked(w, cell, t) || !are_nodes_linked(w, cell, (t + 1) & 7) ||
        !are_nodes_linked(w, one, (t + (t & 1 ? 3 : 2)) & 7))
        return false;
    const JoxV2 at[3] = {jox_field_node(w, cell), jox_field_node(w, one), jox_field_node(w, two)};
    for (uint32_t k = w->walled.first[cell]; k < w->walled.first[cell + 1]; k++) {
        const JoxV2 a = w->f->edges[w->f->refs[k]].a;
        bool within = true;
        for (int s = 0; s < 3; s++)
            within = within && jox_det(jox_sub(at[(s + 1) % 3], at[s]), jox_sub(a, at[s])) >= 0.0f;
        if (within)
            return false;
    }
    return true;
}

static bool is_node_at_centre(const JoxFieldWork *w, int cell) {
    return w->walled.node[cell] == JOX_FIELD_MIDDLE;
}

static bool is_cell_interpolated(const JoxFieldWork *w, int cell) {
    bool clear = is_node_at_centre(w, cell);
    for (int k = 0; k < 8; k++) {
        const int other = jox_field_next(w->f, cell, k);
        const int after = jox_field_next(w->f, cell, (k + 1) & 7);
        clear =
            clear && (other < 0 || (are_nodes_linked(w, cell, k) && is_node_at_centre(w, other)));
        clear = clear && (other < 0 || after < 0 || is_corner_free(w, cell, k));
    }
    return clear;
}

static void expect_cell(const JoxFieldWork *w, int cell) {
    bool even = is_node_at_centre(w, cell);
    for (int k = 0; k < 8; k++) {
        const int other = jox_field_next(w->f, cell, k);
        even = even && (other < 0 || is_node_at_centre(w, other));
        assert_int_equal(w->walled.links[cell] >> k & 1, are_nodes_linked(w, cell, k));
        assert_int_equal(w->walled.corners[cell] >> k & 1, is_corner_free(w, cell, k));
    }
    assert_int_equal(w->walled.even[cell], even);
    assert_int_equal(w->f->cells[cell].patch == JOX_FIELD_CLEAR, is_cell_interpolated(w, cell));
}

/* Checks which surrounding nodes a sample sees, and that only its own cell's edges can hide those
   of the ring. */
static void expect_sample(const JoxFieldWork *w, int cell, int s) {
    const JoxFieldSight sight = w->walled.sight[w->f->cells[cell].patch * JOX_FIELD_SAMPLES + s];
    const JoxFieldSpot spot = jox_field_spot(w, cell, s);
    const JoxV2 p = jox_field_spot_at(&spot);
    const float least = JOX_FIELD_KEEP * w->f->clearance;
    for (int k = 0; k < 8; k++) {
        const int other = jox_field_next(w->f, cell, k);
        if (other < 0)
            continue;
        const JoxV2 node = jox_field_node(w, other);
        assert_int_equal(jox_field_sees_near(w, cell, p, node, least),
                         jox_field_sees(w, p, node, least));
    }
    if (sight & (JOX_SIGHT_SOLID | JOX_SIGHT_DEEP) ||
        w->f->patches[w->f->cells[cell].patch].on_edge >> s & 1)
        return;
    for (int k = 0; k < 4; k++) {
        const int node = jox_field_about(w, &spot, k).cell;
        assert_int_equal(sight >> k & 1,
                         node >= 0 && jox_field_sees(w, p, jox_field_node(w, node), least));
    }
}

static JoxWalls make_walls_around(JoxV2 middle, double angle) {
    static const JoxV2 parts[][4] = {{{1, -3}, {3, -3.5f}, {2, -1}, {1.2f, -1.3f}},
                                     {{-5, -2}, {-1, -3.3f}, {-0.9f, -3}, {-1.5f, -2}},
                                     {{-6, 1}, {-2, 5}, {-2.5f, 5.2f}, {-2, 6}},
                                     {{2, 1}, {2.3f, 1.2f}, {5, 2.9f}, {5.1f, 3}},
                                     {{0.2f, 0.2f}, {0.3f, 0.2f}, {0.3f, 0.35f}, {0.2f, 0.3f}}};
    JoxWalls walls = {0};
    for (int k = 0; k < 5; k++) {
        JoxV2 at[4];
        for (int i = 0; i < 4; i++)
            at[i] = jox_add(middle, turn_point(parts[k][i], angle));
        if (k % 2 == 0)
            jox_walls_add_solid(&walls, at, 4, INFINITY);
        else
            jox_walls_add_polyline(&walls, at, 4, false, INFINITY);
    }
    return walls;
}

static void marks_agree_with_a_search_of_all_edges(void **state) {
    (void)state;
    const JoxV2 middles[] = {{0, 0}, {-3001.7f, 411}, {120000, 250000}};
    const float sizes[] = {0.125f, 0.25f, 0.4f}, clearances[] = {0.05f, 0.15f, 0.4f};
    for (int m = 0; m < 3; m++)
        for (int s = 0; s < 3; s++)
            for (int t = 0; t < 3; t++) {
                JoxWalls walls = make_walls_around(middles[m], 0.31 * t);
                const JoxV2 half = {0.5f * sizes[s] * COLUMNS, 0.5f * sizes[s] * ROWS};
                Marked marked;
                make_marked(&marked, &walls, jox_sub(middles[m], half), sizes[s],
                            clearances[(s + t) % 3]);
                for (int i = 0; i < CELLS; i++) {
                    expect_cell(&marked.w, i);
                    for (int k = 0; marked.f.cells[i].patch >= 0 && k < JOX_FIELD_SAMPLES; k++)
                        expect_sample(&marked.w, i, k);
                }
                free_marked(&marked);
                jox_walls_free(&walls);
            }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(marks_agree_with_a_search_of_all_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
