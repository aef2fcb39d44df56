/* Tests that people reach exits, queues and places by open ways alone, and not through walls and
 * closed gates, also where the way winds. */
#include "unit/gate_ball_scene.h"

/* A hall of 24 x 8 m, which a wall may divide at x = 20. */
#define HALL(wall, place, more)                                                                    \
    "jostle: 1\nwalls:\n"                                                                          \
    "  - {line: [[0, 0], [24, 0], [24, 8], [0, 8]], closed: true}\n  - {" wall "}\n"               \
    "places:\n  out: {" place "}\n  far: {line: [[30, 0], [30, 8]]}\n"                             \
    "  outs: {set: [far, out]}\n  here: {polygon: [[1, 1], [19, 1], [19, 7], [1, 7]]}\n"           \
    "groups: {people: {at: [[18, 3], [18, 4], [18, 5]], " more "\n"
#define WALL "line: [[20, 0], [20, 8]]"
#define GATE "line: [[20, 0], [20, 8]], name: gate"
#define BLOCK "solid: [[20, 0], [24, 0], [24, 8], [20, 8]]"
#define LEAVES "journey: [{exit: out}]}}"
#define QUEUES "journey: [{queue: [out], service: 0.1}, {exit: here}]}}"
#define OWN "behaviour: own.lua}}"
#define BEHIND "line: [[20.2, 2], [20.2, 6]]"
#define AT_WALL "line: [[20, 2], [20, 6]]"
#define POINT "point: [20.4, 4], radius: 2"
#define QUEUE "queue: [[20.3, 4], [17, 4]]"
#define EAST MACHINE_START "\"Go\", states = { Go = { steer = drift(1, 0) } } }\n"
#define EAST_UNTIL(when)                                                                           \
    MACHINE_START "\"Go\", states = { Go = { steer = drift(1, 0), { to = \"Gone\", when = " when   \
                  " } },\n"                                                                        \
                  "  Gone = { removes = true } } }\n"

/* Counts how many of three people leave within 20 s, and how many have left 20 s after `gate` was
 * opened. */
typedef struct Arrival {
    const char *name, *yaml, *behaviour;
    uint32_t first, later;
} Arrival;

static const Arrival ARRIVALS[] = {
    {"a line behind a wall", HALL(WALL, BEHIND, LEAVES), "", 0, 0},
    {"a line behind a gate", HALL(GATE, BEHIND, LEAVES), "", 0, 3},
    {"a line on a gate", HALL(GATE, AT_WALL, LEAVES), "", 0, 3},
    {"a line at a wall", HALL(WALL, AT_WALL, LEAVES), "", 3, 3},
    {"a line at a solid", HALL(BLOCK, AT_WALL, LEAVES), "", 3, 3},
    {"a point behind a wall", HALL(WALL, POINT, LEAVES), "", 0, 0},
    {"a point behind a gate", HALL(GATE, POINT, LEAVES), "", 0, 3},
    {"a point within a solid", HALL(BLOCK, POINT, LEAVES), "", 3, 3},
    {"a queue behind a wall", HALL(WALL, QUEUE, QUEUES), "", 0, 0},
    {"a queue behind a gate", HALL(GATE, QUEUE, QUEUES), "", 0, 3},
    {"a step behind a wall", HALL(WALL, BEHIND, "journey: [{to: out}, {exit: here}]}}"), "", 0, 0},
    {"a step on a gate that opens",
     HALL(GATE, AT_WALL, "journey: [{to: out, open: gate}, {exit: here}]}}"), "", 0, 3},
    {"a sink behind a wall", HALL(WALL, BEHIND, OWN "\nsinks: [{at: out}]"), EAST, 0, 0},
    {"a sink behind a gate", HALL(GATE, BEHIND, OWN "\nsinks: [{at: out}]"), EAST, 0, 3},
    {"a sink of a set behind a wall", HALL(WALL, POINT, OWN "\nsinks: [{at: outs}]"), EAST, 0, 0},
    {"a sink of a set behind a gate", HALL(GATE, POINT, OWN "\nsinks: [{at: outs}]"), EAST, 0, 3},
    {"near, behind a wall", HALL(WALL, POINT, OWN), EAST_UNTIL("near(\"out\", 2)"), 0, 0},
    {"near, within a solid", HALL(BLOCK, POINT, OWN), EAST_UNTIL("near(\"out\", 2)"), 3, 3},
    {"near, on a gate", HALL(GATE, AT_WALL, OWN), EAST_UNTIL("near(\"out\", 0.5)"), 3, 3},
    {"near one of a set, behind a wall", HALL(WALL, POINT, OWN), EAST_UNTIL("near(\"outs\", 2)"), 0,
     0},
    {"inside, behind a gate", HALL(GATE, POINT, OWN), EAST_UNTIL("inside \"out\""), 0, 3},
    {"inside, on a gate", HALL(GATE, AT_WALL, OWN), EAST_UNTIL("inside \"out\""), 0, 3},
};

static void nobody_arrives_through_a_wall(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof ARRIVALS / sizeof *ARRIVALS; n++) {
        const Arrival *a = &ARRIVALS[n];
        JoScene *scene = load_scene_text(a->yaml, a->behaviour);
        step_scene(scene, 400);
        if (scene->world->state.exits.left != a->first)
            fail_msg("%s: %d of 3 left", a->name, (int)scene->world->state.exits.left);
        if (strstr(a->yaml, "name: gate"))
            apply_input(scene, "open gate");
        step_scene(scene, 400);
        if (scene->world->state.exits.left != a->later)
            fail_msg("%s: %d of 3 left in the end", a->name, (int)scene->world->state.exits.left);
        jo_scene_free(scene);
    }
}

/* A queue that winds through five lanes between walls, and ends before them. */
#define WINDING                                                                                    \
    "jostle: 1\nplaces:\n"                                                                         \
    "  counter: {queue: [[0, 0], [6, 0], [6, 1.2], [0, 1.2], [0, 2.4], [6, 2.4], [6, 3.6], "       \
    "[0, 3.6], [0, 4.8], [9, 4.8]], spacing: 0.5}\n"                                               \
    "  hall: {polygon: [[8, 0], [14, 0], [14, 8], [8, 8]]}\n"                                      \
    "walls:\n"                                                                                     \
    "  - {line: [[6.8, 4.2], [6.8, -0.6], [-0.8, -0.6], [-0.8, 5.4], [6.8, 5.4]]}\n"               \
    "  - {line: [[-0.8, 0.6], [5.4, 0.6]]}\n  - {line: [[0.6, 1.8], [6.8, 1.8]]}\n"                \
    "  - {line: [[-0.8, 3], [5.4, 3]]}\n  - {line: [[0.6, 4.2], [6.8, 4.2]]}\n"                    \
    "groups: {people: {behaviour: own.lua, count: 50, in: hall, spacing: 0.6}}\n"                  \
    "probes: {served: {visit: [Queue, Service]}}\n"
#define CUSTOMER                                                                                   \
    MACHINE_START                                                                                  \
    "\"Come\", states = {\n"                                                                       \
    "  Come = { steer = queue \"counter\", { to = \"Queue\", when = joined "                       \
    "\"counter\" } },\n"                                                                           \
    "  Queue = { steer = queue \"counter\",\n    { to = \"Service\", when = first_in "             \
    "\"counter\" & near(\"counter\", 0.5) } },\n"                                                  \
    "  Service = { steer = queue \"counter\", lasts = 1, { to = \"Gone\", when = "                 \
    "lasted } },\n  Gone = { removes = true } } }\n"

static void queue_that_winds_behind_walls_is_served_in_order(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(WINDING, CUSTOMER);
    step_scene(scene, 2400);
    JoFigures *told = jo_scene_figures(scene);
    const double served = jo_figure(told, "probes.served.passages"),
                 inversions = jo_figure(told, "probes.served.inversions");
    print_message("  served %g of 50, share of pairs out of order %g\n", served, inversions);
    assert_true(served >= 45);
    assert_true(inversions <= 0.02);
    jo_free(told);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nobody_arrives_through_a_wall),
        cmocka_unit_test(queue_that_winds_behind_walls_is_served_in_order)};
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
