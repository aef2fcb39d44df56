/* Feet that hold: rows of people with torsos of 0.45 by 0.25 m, chest to back, between two forces
   along x and with nothing beside them. Such a row keeps still as long as nobody has to hold more
   than its feet do, m g stance / l; without feet it buckles. */
#include "unit/load_torso.h"

enum { LONGEST = 10 };
static const double DEPTH = 0.25, BREADTH = 0.45, STANCE = 0.0825, NEWTONS = 600.0; /* m, N */
static const double HOLDS = 70.0 * 9.81 * 0.0825;                                   /* N */
static const double SECONDS = 10.0;
static const double STAYS = 0.01; /* m: how far people of a row that holds are moved aside */

typedef struct Row {
    int people;
    double breadth; /* m */
    double stance;  /* m */
    double zigzag;  /* m: every other person stands that far to the left, the rest to the right */
    double slope;   /* of the row, out of the line of the forces */
    double dt;      /* s */
} Row;

static double find_y(const Row *r, int i) {
    return (i % 2 ? -r->zigzag : r->zigzag) + r->slope * DEPTH * (i - 0.5 * (r->people - 1));
}

/* Returns how far a person was moved aside at most, m. */
static double press_row(const Row *r) {
    JoWorld *w = open_world(r->dt);
    JoAgent people[LONGEST];
    double most = 0.0;
    const int last = r->people - 1;
    for (int i = 0; i <= last; i++) {
        people[i] = add_torso(w, DEPTH * i, find_y(r, i), 0.0, r->breadth, DEPTH);
        jo_agent_set_parameter(w, people[i], "stance", r->stance, NULL);
    }
    for (double t = 0.0; t < SECONDS - 1e-6 && most < 0.1; t += r->dt) {
        jo_agent_apply_force(w, people[0], NEWTONS, 0.0);
        jo_agent_apply_force(w, people[last], -NEWTONS, 0.0);
        jo_world_step(w, 1);
        for (int i = 0; i <= last; i++)
            most = fmax(most, fabs(jo_agent_state(w, people[i]).y - find_y(r, i)));
    }
    assert_null(jo_world_failure(w));
    jo_world_free(w);
    return most;
}

static bool holds(const Row *r) {
    const double moved = press_row(r);
    print_message(
        "  %d people %g m broad, stance %g m, zigzag %g mm, slope %.3f, dt %g s: %.1f mm\n",
        r->people, r->breadth, r->stance, 1e3 * r->zigzag, r->slope, r->dt, 1e3 * moved);
    return moved < STAYS;
}

static void feet_hold_uneven_rows(void **state) {
    (void)state;
    const double zigzags[] = {0.001, 0.005, 0.02}, steps[] = {0.05, 0.0125};
    for (int k = 0; k < 12; k++)
        assert_true(holds(&(Row){.people = k % 2 ? 5 : 10,
                                 .breadth = BREADTH,
                                 .stance = STANCE,
                                 .zigzag = zigzags[k / 2 % 3],
                                 .dt = steps[k / 6]}));
}

/* The null. */
static void without_feet_rows_buckle(void **state) {
    (void)state;
    const double steps[] = {0.05, 0.0125};
    for (int k = 0; k < 4; k++)
        assert_false(holds(&(Row){
            .people = k % 2 ? 5 : 10, .breadth = BREADTH, .zigzag = 0.001, .dt = steps[k / 2]}));
}

/* The two at the ends of a row that lies askew to the forces have to hold the part of their force
   across it. */
static void rows_askew_hold_up_to_the_hold_of_one_over_the_force(void **state) {
    (void)state;
    const double steps[] = {0.05, 0.0125}, limit = HOLDS / NEWTONS;
    for (int k = 0; k < 4; k++) {
        Row r = {
            .people = k % 2 ? 5 : 10, .breadth = BREADTH, .stance = STANCE, .dt = steps[k / 2]};
        r.slope = 0.8 * limit;
        assert_true(holds(&r));
        r.slope = 1.15 * limit;
        assert_false(holds(&r));
        r.slope = 0.8 * limit;
        r.stance = 0.5 * STANCE;
        assert_false(holds(&r));
    }
}

/* Discs touch at a point: the middle one of three in a zigzag has to hold twice the force, times
   twice the zigzag over the distance of two. */
static void discs_hold_less(void **state) {
    (void)state;
    const double limit = HOLDS * DEPTH / (4.0 * NEWTONS);
    Row r = {.people = 3, .breadth = DEPTH, .stance = STANCE, .zigzag = 0.9 * limit, .dt = 0.05};
    assert_true(holds(&r));
    r.zigzag = 1.1 * limit;
    assert_false(holds(&r));
}

/* Returns how fast a person is after 0.5 s of a force of 50 N, m/s. */
static double push_person(double angle, double stance) {
    JoWorld *w = open_world(0.05);
    const JoAgent one = add_torso(w, 0.0, 0.0, angle, BREADTH, DEPTH);
    jo_agent_set_parameter(w, one, "stance", stance, NULL);
    for (int step = 0; step < 10; step++) {
        jo_agent_apply_force(w, one, 50.0, 0.0);
        jo_world_step(w, 1);
    }
    const double speed = jo_agent_state(w, one).vx;
    jo_world_free(w);
    return speed;
}

static void feet_hold_sideways_alone(void **state) {
    (void)state;
    const double quarter = 1.5707963267948966;
    assert_true(push_person(0.0, STANCE) > 0.1);
    assert_true(push_person(0.0, STANCE) == push_person(0.0, 0.0));
    assert_true(push_person(quarter, 0.0) > 0.1);
    assert_true(push_person(quarter, STANCE) < 1e-4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(feet_hold_uneven_rows),
        cmocka_unit_test(without_feet_rows_buckle),
        cmocka_unit_test(rows_askew_hold_up_to_the_hold_of_one_over_the_force),
        cmocka_unit_test(discs_hold_less),
        cmocka_unit_test(feet_hold_sideways_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
