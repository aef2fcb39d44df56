/* Tests of people who wait in an area: they fill it from its front, spread, come to rest, and leave
 * at a signal. People without room stand behind it. */
#include <math.h>

#include "unit/gate_ball_scene.h"

typedef struct Area {
    float x0, y0, x1, y1; /* m */
} Area;

/* Measures of the people in an area. */
typedef struct Stand {
    int inside, rear, front; /* people inside; in its quarters of least and of greatest y */
    double density, uneven;  /* 1/m2: the mean, and the coefficient of variation over 2 m cells */
    double densest;          /* 1/m2: greatest of a cell */
    double speed;            /* m/s, mean */
    double nearest;          /* m: mean distance to the nearest other */
} Stand;

enum { MOST_CELLS = 20 };

static double find_nearest_distance(const JoxAgents *a, uint32_t i) {
    double least = INFINITY;
    for (uint32_t j = 0; j < a->count; j++)
        if (j != i)
            least = fmin(least, hypot((double)(a->x[j] - a->x[i]), (double)(a->y[j] - a->y[i])));
    return least;
}

static Stand measure_stand(const JoScene *scene, Area area) {
    const JoxAgents *a = &scene->world->state.agents;
    const int columns = (int)((area.x1 - area.x0) / 2), rows = (int)((area.y1 - area.y0) / 2);
    int cells[MOST_CELLS][MOST_CELLS] = {{0}};
    Stand s = {0};
    assert_true(columns <= MOST_CELLS && rows <= MOST_CELLS);
    for (uint32_t i = 0; i < a->count; i++) {
        if (!(a->x[i] > area.x0 && a->x[i] < area.x1 && a->y[i] > area.y0 &&
              a->y[i] < area.y1 + 0.02f)) /* spots lie on the front edge */
            continue;
        const float share = (a->y[i] - area.y0) / (area.y1 - area.y0);
        s.inside++;
        s.rear += share < 0.25f;
        s.front += share > 0.75f;
        s.speed += hypot((double)a->vx[i], (double)a->vy[i]);
        s.nearest += find_nearest_distance(a, i);
        cells[(int)((a->y[i] - area.y0) / 2)][(int)((a->x[i] - area.x0) / 2)]++;
    }
    s.speed /= fmax(1, s.inside);
    s.nearest /= fmax(1, s.inside);
    s.density = 0.25 * s.inside / (rows * columns);
    double sum2 = 0.0;
    for (int k = 0; k < rows * columns; k++) {
        const double density = 0.25 * cells[k / columns][k % columns];
        s.densest = fmax(s.densest, density);
        sum2 += (density - s.density) * (density - s.density);
    }
    s.uneven = s.density > 0.0 ? sqrt(sum2 / (rows * columns)) / s.density : 0.0;
    return s;
}

/* A hall 24 m wide with an area for the audience before its stage, 12 x 8 m. */
static const Area FRONT = {6, 10, 18, 18};
static JoScene *load_hall(int people) {
    char text[1200];
    snprintf(text, sizeof text,
             "jostle: 1\n"
             "places:\n"
             "  foyer: {polygon: [[1, 1], [23, 1], [23, 8], [1, 8]]}\n"
             "  front: {polygon: [[6, 10], [18, 10], [18, 18], [6, 18]]}\n"
             "  out: {polygon: [[-4, 2], [-2, 2], [-2, 6], [-4, 6]]}\n"
             "walls: [{line: [[0, 2], [0, 0], [24, 0], [24, 20], [0, 20], [0, 6]]}]\n"
             "groups: {audience: {count: %d, in: foyer,"
             " journey: [{to: front, until: alarm}, {exit: out}]}}\n"
             "events: [{at: 60, signal: alarm}]\n",
             people);
    return load_scene_text(text, "");
}

static void few_people_stand_in_front_and_apart(void **state) {
    (void)state;
    JoScene *scene = load_hall(50);
    step_scene_seconds(scene, 59);
    const Stand s = measure_stand(scene, FRONT);
    assert_true(s.inside >= 49);
    assert_int_equal(s.rear, 0);
    assert_true(s.front > s.inside / 2);
    assert_true(s.nearest > 0.65 && s.densest < 2.3);
    assert_true(s.speed > 0.001 && s.speed < 0.06);
    jo_scene_free(scene);
}

/* A regression: this many people once stood at the entrance, 45 % in the rear quarter, at up to 7
 * per m2. */
static void many_people_fill_the_area_evenly(void **state) {
    (void)state;
    JoScene *scene = load_hall(300);
    step_scene_seconds(scene, 59);
    const Stand s = measure_stand(scene, FRONT);
    assert_true(s.inside >= 285);
    assert_true(s.rear < 0.3 * s.inside && s.front > 0.2 * s.inside);
    assert_true(s.uneven < 0.25 && s.densest < 5.0);
    assert_true(s.speed < 0.06);
    jo_scene_free(scene);
}

static void people_without_room_stand_behind_the_area(void **state) {
    (void)state;
    JoScene *scene = load_hall(460);
    step_scene_seconds(scene, 59);
    const Stand s = measure_stand(scene, FRONT);
    assert_in_range(s.inside, 370, 440);
    assert_true(s.density < 4.6 && s.densest < 6.0 && s.uneven < 0.25);
    assert_true(s.speed < 0.1);
    jo_scene_free(scene);
}

static void all_people_leave_at_the_signal(void **state) {
    (void)state;
    JoScene *scene = load_hall(150);
    step_scene_seconds(scene, 150);
    assert_int_equal(jo_world_agent_count(scene->world), 0);
    jo_scene_free(scene);
}

/* The front is where the scene sets it, and two groups fill the area together. */
static void people_gather_in_front_of_their_focus(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text("jostle: 1\n"
                        "places:\n"
                        "  west: {polygon: [[0, 0], [4, 0], [4, 6], [0, 6]]}\n"
                        "  east: {polygon: [[20, 0], [24, 0], [24, 6], [20, 6]]}\n"
                        "  square: {polygon: [[6, 8], [18, 8], [18, 18], [6, 18]]}\n"
                        "  screen: {point: [5, 13], radius: 0.5}\n"
                        "groups:\n"
                        "  a: {count: 25, in: west, journey: [{to: square, front: screen,"
                        " until: end}]}\n"
                        "  b: {count: 25, in: east, journey: [{to: square, front: screen,"
                        " until: end}]}\n"
                        "events: [{at: 100, signal: end}]\n",
                        "");
    const JoxAgents *a = &scene->world->state.agents;
    step_scene_seconds(scene, 60);
    for (uint32_t i = 0; i < a->count; i++) {
        assert_true(a->x[i] > 5.8f && a->x[i] < 12.0f && a->y[i] > 7.8f && a->y[i] < 18.2f);
        assert_true(a->face_x[i] < 0.0f);
    }
    jo_scene_free(scene);
}

/* No spot lies in a pillar, in a corner cut off by one, or behind a wall. */
static void spots_are_clear_of_walls(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text("jostle: 1\n"
                        "places:\n"
                        "  start: {polygon: [[1, 1], [13, 1], [13, 4], [1, 4]]}\n"
                        "  ell: {polygon: [[1, 6], [13, 6], [13, 10], [5, 10], [5, 20], [1, 20]]}\n"
                        "walls:\n"
                        "  - {solid: [[2, 8], [4, 8], [4, 9], [2, 9]]}\n"
                        "  - {line: [[0, 5], [0, 17], [14, 17], [14, 5]]}\n"
                        "groups: {a: {count: 60, in: start, journey: [{to: ell, until: end}]}}\n"
                        "events: [{at: 100, signal: end}]\n",
                        "");
    const JoxAgents *a = &scene->world->state.agents;
    step_scene_seconds(scene, 70);
    int front = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        assert_true(a->y[i] < 17.0f); /* the area continues behind the wall */
        front += a->y[i] > 13.0f;
        assert_true(hypotf(a->vx[i], a->vy[i]) < 0.5f);
    }
    assert_true(front > 15);
    jo_scene_free(scene);
}

/* The order of spots is state: a run saved while people arrive continues exactly. */
static void saved_gathering_continues_exactly(void **state) {
    (void)state;
    JoScene *scene = load_hall(120);
    step_scene_seconds(scene, 12);
    size_t size;
    void *saved = jo_world_snapshot(scene->world, &size, NULL);
    assert_non_null(saved);
    step_scene_seconds(scene, 20);
    const uint64_t hash = jo_world_hash(scene->world);
    assert_true(jo_world_restore(scene->world, saved, size, NULL));
    step_scene_seconds(scene, 20);
    assert_true(jo_world_hash(scene->world) == hash);
    jo_free(saved);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_people_stand_in_front_and_apart),
        cmocka_unit_test(many_people_fill_the_area_evenly),
        cmocka_unit_test(people_without_room_stand_behind_the_area),
        cmocka_unit_test(all_people_leave_at_the_signal),
        cmocka_unit_test(people_gather_in_front_of_their_focus),
        cmocka_unit_test(spots_are_clear_of_walls),
        cmocka_unit_test(saved_gathering_continues_exactly),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
