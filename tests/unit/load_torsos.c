/* Torsos that are pressed against walls, corners and bodies do not sink in, and symmetric presses
   turn nobody; rows between two forces; heaps give the same hash on every instruction set, number
   of threads, and after a restore. */
#include "unit/load_torso.h"

#include "agents/torso.h"
#include "body/footprint.h"

enum { PRESSES = 60 };
/* m: overlap allowed, of which most comes from turning by up to 0.3 rad in a step. */
static const double SUNK = 0.018;

/* Returns the distance of a point from the segment between two others. */
static double find_distance(double x, double y, const double *a, const double *b) {
    const double ux = b[0] - a[0], uy = b[1] - a[1];
    const double t = ((x - a[0]) * ux + (y - a[1]) * uy) / (ux * ux + uy * uy);
    const double s = fmax(0.0, fmin(1.0, t));
    return hypot(x - a[0] - s * ux, y - a[1] - s * uy);
}

/* Returns how deep a torso is in a convex polygon given counterclockwise, m: over points of its
   axis, within the polygon by the distance from it, negative where it is outside. */
static double find_depth(const JoxAgents *a, uint32_t i, const double *xy, uint32_t corners) {
    double deepest = -INFINITY;
    const double half = hypot((double)a->axis_x[i], (double)a->axis_y[i]); /* of the last step */
    for (int k = -50; k <= 50; k++) {
        const double x = (double)a->x[i] - 0.02 * k * half * (double)a->chest_y[i];
        const double y = (double)a->y[i] + 0.02 * k * half * (double)a->chest_x[i];
        double near = INFINITY;
        bool inside = true;
        for (uint32_t c = 0; c < corners; c++) {
            const double *from = xy + (size_t)2 * c, *to = xy + (size_t)2 * ((c + 1) % corners);
            near = fmin(near, find_distance(x, y, from, to));
            inside &= (to[0] - from[0]) * (y - from[1]) - (to[1] - from[1]) * (x - from[0]) > 0.0;
        }
        deepest = fmax(deepest, (inside ? near : -near) + (double)a->contact_radius[i]);
    }
    return deepest;
}

typedef enum Thing { WALL, BOX, POLE, THINGS } Thing;

/* Corners of what torsos are pressed against, counterclockwise: 8 of a pole. */
static uint32_t list_corners(Thing thing, double *xy) {
    const double half = thing == POLE ? 0.04 : 0.5;
    const uint32_t count = 4;
    for (uint32_t c = 0; c < count; c++) {
        xy[2 * c] = (c == 0 || c == 3 ? -1.0 : 1.0) * half;
        xy[2 * c + 1] = (c < 2 ? -1.0 : 1.0) * half;
    }
    return count;
}

static void add_thing(JoWorld *w, Thing thing, const double *xy, uint32_t corners) {
    JoError error;
    if (thing == WALL) {
        assert_true(jo_world_add_solid(w, xy, corners, &error));
        return;
    }
    JoBodyDef def = jo_default_body_def();
    def.shape = JO_BOX;
    def.size[0] = def.size[1] = xy[2] - xy[0];
    def.size[2] = 1.5;
    def.z = 0.75;
    def.mass = 0.0;
    if (!jo_world_add_body(w, &def, &error).generation)
        fail_msg("%s", error.text);
}

/* Presses a torso towards the origin with 600 N from a random side, at random angles. Returns how
   deep it was in the thing at the end of any step after the first half second. */
static double press_on(Thing thing, uint64_t number, double dt) {
    double xy[16], deepest = -INFINITY;
    const uint32_t corners = list_corners(thing, xy);
    JoWorld *w = open_world(dt);
    add_thing(w, thing, xy, corners);
    const double side = TURN * draw_unit(number, 1), breadth = draw_between(number, 2, 0.4, 0.7);
    const double aside = draw_between(number, 3, -0.3, 0.3);
    const double fx = -600.0 * cos(side), fy = -600.0 * sin(side);
    const JoAgent one =
        add_torso(w, 1.2 * cos(side) - aside * sin(side), 1.2 * sin(side) + aside * cos(side),
                  TURN * draw_unit(number, 4), breadth, draw_between(number, 5, 0.15, 0.3));
    for (double t = 0.0; t < 3.0; t += dt) {
        jo_agent_apply_force(w, one, fx, fy);
        jo_world_step(w, 1);
        deepest = fmax(deepest, find_depth(&w->state.agents, 0, xy, corners));
    }
    assert_null(jo_world_failure(w));
    jo_world_free(w);
    return deepest;
}

static void torsos_do_not_sink_into(Thing thing, const char *name) {
    uint32_t sunk = 0;
    double most = 0.0;
    uint64_t worst = 0;
    for (uint64_t number = 0; number < PRESSES; number++) {
        const double depth = press_on(thing, number, number % 2 ? 0.05 : 0.0125);
        sunk += depth > SUNK;
        worst = depth > most ? number : worst;
        most = fmax(most, depth);
    }
    print_message("  %s: %u of %u sink in, by at most %.1f mm (number %u)\n", name, sunk, PRESSES,
                  1e3 * most, (unsigned)worst);
    assert_int_equal(sunk, 0);
}

static void torsos_do_not_sink_into_walls(void **state) {
    (void)state;
    torsos_do_not_sink_into(WALL, "walls");
}

static void torsos_do_not_sink_into_boxes(void **state) {
    (void)state;
    if (jox_bodies_available())
        torsos_do_not_sink_into(BOX, "boxes");
}

static void torsos_do_not_sink_into_poles(void **state) {
    (void)state;
    if (jox_bodies_available())
        torsos_do_not_sink_into(POLE, "poles");
}

/* ---- slots ---- */

/* Walks a torso of 0.45 by 0.25 m for 10 s along x towards a slot between two walls that begin at
   x = 0. Returns how far it comes, m. */
static double walk_through_slot(double width, bool solid) {
    const double half = 0.5 * width;
    const double left[] = {0, 3, 0, half, 3, half, 3, 3};
    const double right[] = {0, -3, 0, -half, 3, -half, 3, -3};
    JoWorld *w = open_world(0.05);
    bool (*add)(JoWorld *, const double *, size_t, JoError *) =
        solid ? jo_world_add_solid : jo_world_add_line;
    assert_true(add(w, left, 4, NULL) && add(w, right, 4, NULL));
    const JoAgent one = add_torso(w, -1.0, 0.03, 0.0, 0.45, 0.25);
    jo_agent_set_parameter(w, one, "radius", 0.2, NULL);
    for (int n = 0; n < 200; n++) {
        jo_agent_set_preferred(w, one, 1.0, 0.0);
        jo_world_step(w, 1);
    }
    const double x = jo_agent_state(w, one).x;
    assert_null(jo_world_failure(w));
    jo_world_free(w);
    return x;
}

static void torsos_turn_to_pass_slots(void **state) {
    (void)state;
    const double widths[] = {0.34, 0.38, 0.42, 0.46, 0.6};
    for (int k = 0; k < 10; k++) {
        const double x = walk_through_slot(widths[k / 2], k % 2);
        if (x < 6.0)
            fail_msg("a slot of %g m is passed as far as %g m", widths[k / 2], x);
        assert_true(walk_through_slot(0.22, k % 2) < 0.1);
    }
}

/* ---- standing before a wall ---- */

/* Lets a torso stand in a niche 0.8 m wide, whose end is at x = 0, for 8 s; it wants to go on along
   x at `speed`, and is pressed that way. Returns the greatest angle of its chest to the way, rad,
   after it stood for 3 s; *early: the same before it stood for 1 s. */
static double stand_in_niche(double speed, double newtons, double *early) {
    const double niche[] = {-2.0, -0.4, 0.0, -0.4, 0.0, 0.4, -2.0, 0.4};
    JoWorld *w = open_world(0.05);
    double late = 0.0;
    assert_true(jo_world_add_line(w, niche, 4, NULL));
    const JoAgent one = add_torso(w, -0.13, 0.0, 0.0, 0.45, 0.25);
    *early = 0.0;
    for (int n = 0; n < 160; n++) {
        jo_agent_set_preferred(w, one, speed, 0.0);
        jo_agent_apply_force(w, one, newtons, 0.0);
        jo_world_step(w, 1);
        const JoxAgents *a = &w->state.agents;
        const double angle = fabs(atan2((double)a->chest_y[0], (double)a->chest_x[0]));
        double *most = n < 20 ? early : &late;
        if (n < 20 || n >= 60)
            *most = fmax(*most, angle);
    }
    jo_world_free(w);
    return late;
}

/* Torsos that are pressed and get nowhere turn a shoulder after a second; the nulls, one that is
   not pressed and one that wants to stand, do not. */
static void pressed_torsos_that_get_nowhere_turn(void **state) {
    (void)state;
    double early;
    assert_true(stand_in_niche(1.0, 100.0, &early) > 0.5 && early < 0.05);
    assert_true(stand_in_niche(1.0, 0.0, &early) < 0.05 && early < 0.05);
    assert_true(stand_in_niche(0.0, 100.0, &early) < 0.05 && early < 0.05);
}

/* ---- statics ---- */

enum { ROW = 5 };

/* A row in a channel, chest to back, between two forces of 600 N: each bears 600 N, over a
   circumference of 2 pi 0.125 + 4 0.1 = 1.1854 m, at one side or both. The channel leaves 1 mm. */
static void a_row_of_torsos_bears_a_force(void **state) {
    (void)state;
    const double steps[] = {0.05, 0.0125};
    for (int k = 0; k < 2; k++) {
        JoWorld *w = open_world(steps[k]);
        const double left[] = {-2.0, 0.226, 2.0, 0.226}, right[] = {-2.0, -0.226, 2.0, -0.226};
        JoAgent people[ROW];
        assert_true(jo_world_add_line(w, left, 2, NULL) && jo_world_add_line(w, right, 2, NULL));
        for (int i = 0; i < ROW; i++)
            people[i] = add_torso(w, 0.251 * (i - 2), 0.0, i % 2 ? TURN / 2.0 : 0.0, 0.45, 0.25);
        for (double t = 0.0; t < 5.0; t += steps[k]) {
            jo_agent_apply_force(w, people[0], 600.0, 0.0);
            jo_agent_apply_force(w, people[ROW - 1], -600.0, 0.0);
            jo_world_step(w, 1);
        }
        for (int i = 0; i < ROW; i++) {
            const JoAgentState now = jo_agent_state(w, people[i]);
            const double wanted = (i == 0 || i == ROW - 1 ? 600.0 : 1200.0) / 1.1854;
            if (fabs(now.load - 600.0) > 18.0 || fabs(now.compression - wanted) > 0.03 * wanted)
                fail_msg("dt %g, person %d: %g N and %g N/m, not 600 N and %g N/m", steps[k], i,
                         now.load, now.compression, wanted);
        }
        jo_world_free(w);
    }
}

/* ---- heaps ---- */

enum { HEAP = 120, HEAP_STEPS = 60 };

/* A heap of torsos and discs that all want to the middle, between walls; `body`: with a box. */
static JoWorld *open_heap(JoIsa isa, uint32_t threads, bool body) {
    const double wall[] = {-2.2, -2.0, -2.2, 2.0}, corner[] = {1.6, 0.4, 2.6, 0.0, 2.6, 1.4};
    JoWorldDef def = jo_default_world_def();
    def.isa = isa;
    def.threads = threads;
    JoWorld *w = jo_world_create(&def, NULL);
    assert_true(jo_world_add_line(w, wall, 2, NULL) && jo_world_add_solid(w, corner, 3, NULL));
    if (body && jox_bodies_available()) {
        JoBodyDef box = jo_default_body_def();
        box.shape = JO_BOX;
        box.size[0] = box.size[1] = box.size[2] = 0.5;
        box.mass = 40.0;
        box.x = 0.3;
        box.z = 0.25;
        assert_true(jo_world_add_body(w, &box, NULL).generation);
    }
    for (uint32_t k = 0; k < HEAP; k++)
        add_torso(w, 0.36 * (k % 11) - 1.9, 0.36 * (k / 11) - 1.9, TURN * draw_unit(k, 1),
                  draw_between(k, 2, 0.3, 0.5), k % 7 ? draw_between(k, 3, 0.15, 0.3) : 0.5);
    return w;
}

static void step_heap(JoWorld *w, int steps, uint64_t *hashes) {
    JoxAgents *a = &w->state.agents;
    for (int n = 0; n < steps; n++) {
        for (uint32_t i = 0; i < a->count; i++) {
            const JoxV2 way = jox_unit((JoxV2){-a->x[i], -a->y[i]});
            jo_agent_set_preferred(w, jox_world_agent_handle(w, i), 1.3 * (double)way.x,
                                   1.3 * (double)way.y);
        }
        jo_world_step(w, 1);
        hashes[n] = jo_world_hash(w);
    }
    assert_null(jo_world_failure(w));
}

static void heaps_are_the_same_on_all_instruction_sets_and_threads(void **state) {
    (void)state;
    static uint64_t first[HEAP_STEPS], hashes[HEAP_STEPS];
    JoWorld *w = open_heap(JO_ISA_SCALAR, 1, true);
    step_heap(w, HEAP_STEPS, first);
    const JoxAgents *a = &w->state.agents;
    uint32_t spins = 0, contacts = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        spins += fabsf(a->spin[i]) > 0.05f;
        contacts += a->contacts[i];
    }
    assert_true(spins > 10 && contacts > 30);
    jo_world_free(w);
    for (JoIsa isa = JO_ISA_SCALAR; isa <= JO_ISA_NEON; isa++)
        for (uint32_t threads = 1; threads <= 4; threads += 3) {
            if (!jox_isa_runs(isa))
                continue;
            w = open_heap(isa, threads, true);
            step_heap(w, HEAP_STEPS, hashes);
            jo_world_free(w);
            assert_memory_equal(first, hashes, sizeof hashes);
        }
}

static void a_restored_heap_goes_on_alike(void **state) {
    (void)state;
    enum { BEFORE = 25, AFTER = HEAP_STEPS - BEFORE };
    static uint64_t hashes[HEAP_STEPS], again[HEAP_STEPS];
    JoxText snapshot = {0};
    JoError error = {0};
    JoWorld *w = open_heap(JO_ISA_SCALAR, 1, false);
    step_heap(w, BEFORE, hashes);
    assert_true(jox_world_snapshot(w, &snapshot, &error));
    step_heap(w, AFTER, hashes);
    JoWorld *other = open_heap(JO_ISA_SCALAR, 1, false);
    if (!jox_world_restore(other, snapshot.data, snapshot.length, &error))
        fail_msg("%s", error.text);
    step_heap(other, AFTER, again);
    assert_memory_equal(hashes, again, AFTER * sizeof *hashes);
    jox_text_free(&snapshot);
    jo_world_free(other);
    jo_world_free(w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(torsos_do_not_sink_into_walls),
        cmocka_unit_test(torsos_do_not_sink_into_boxes),
        cmocka_unit_test(torsos_do_not_sink_into_poles),
        cmocka_unit_test(torsos_turn_to_pass_slots),
        cmocka_unit_test(pressed_torsos_that_get_nowhere_turn),
        cmocka_unit_test(a_row_of_torsos_bears_a_force),
        cmocka_unit_test(heaps_are_the_same_on_all_instruction_sets_and_threads),
        cmocka_unit_test(a_restored_heap_goes_on_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
