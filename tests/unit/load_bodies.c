/* Loads of people at rest against bodies: static ones, which act like walls, and free boxes that
   stand against something or transfer a force. */
#include "unit/load_at_rest.h"

/* Makes a static box as high as a wall, with its centre at (x, y). */
static JoBodyDef make_block(double x, double y, double length, double width, double turn) {
    JoBodyDef b = jo_default_body_def();
    b.size[0] = length;
    b.size[1] = width;
    b.size[2] = 3.0;
    b.mass = 0.0;
    b.x = x;
    b.y = y;
    b.z = 1.5;
    b.turn = turn;
    return b;
}

/* Checks a column of n people pressed by 1,000 N against a static box whose face is at x = 0. */
static void check_column(uint32_t n, const Figures *hand) {
    Setup s = {.disc_count = n, .body_count = 1, .loose_x = 0.01};
    for (uint32_t i = 0; i < n; i++)
        s.discs[i] = (Disc){.x = -RADIUS - 2.0 * RADIUS * i};
    s.discs[n - 1].force_x = 1000.0;
    s.bodies[0] = make_block(0.5, 0.0, 1.0, 4.0, 0.0);
    check_setup(&s, hand);
}

static void a_column_against_a_static_body(void **state) {
    (void)state;
    const Figures one[] = {{1000.0, 795.77}};
    const Figures three[] = {{1000.0, 1591.55}, {1000.0, 1591.55}, {1000.0, 795.77}};
    check_column(1, one);
    check_column(3, three);
}

/* Makes a box whose upper face rises to the right at `angle` (rad), through the origin. */
static JoBodyDef make_slope(double angle) {
    return make_block(0.5 * sin(angle), -0.5 * cos(angle), 4.0, 1.0, angle);
}

/* 1,000 N down between static boxes whose faces rise at 30 and 60 degrees: 866.0 N and 500 N. */
static void between_slanted_bodies(void **state) {
    (void)state;
    const Figures hand[] = {{1000.0, 1087.05}};
    Setup s = {.disc_count = 1, .body_count = 2, .loose_x = 0.02, .loose_y = 0.02};
    double n = RADIUS * sqrt(2.0), turn = PI / 4 - PI / 6; /* the normals are at right angles */
    s.discs[0] = (Disc){.x = -n * sin(turn), .y = n * cos(turn), .force_y = -1000.0};
    s.bodies[0] = make_slope(PI / 3);
    s.bodies[1] = make_slope(-PI / 6);
    check_setup(&s, hand);
}

/* Three people in a trough of static boxes, as between walls: contacts lean by a = asin(0.3 /
   0.4). */
static void a_wedge_between_bodies(void **state) {
    (void)state;
    const Figures hand[] = {{453.56, 870.41}, {453.56, 870.41}, {600.0, 721.87}};
    Setup s = {.disc_count = 3, .body_count = 3, .loose_y = 0.01};
    s.discs[0] = (Disc){.x = -0.3, .y = RADIUS};
    s.discs[1] = (Disc){.x = 0.3, .y = RADIUS};
    s.discs[2] = (Disc){.x = 0.0, .y = RADIUS + sqrt(0.16 - 0.09), .force_y = -600.0};
    s.bodies[0] = make_block(0.0, -0.5, 3.0, 1.0, 0.0);
    s.bodies[1] = make_block(-1.0, 1.0, 1.0, 2.0, 0.0);
    s.bodies[2] = make_block(1.0, 1.0, 1.0, 2.0, 0.0);
    check_setup(&s, hand);
}

/* Makes a free box of 20 kg, 0.4 m x 0.6 m x 1.2 m high, with its centre at x. */
static JoBodyDef make_box(double x, double friction) {
    JoBodyDef b = jo_default_body_def();
    b.size[0] = 0.4;
    b.size[1] = 0.6;
    b.size[2] = 1.2;
    b.mass = 20.0;
    b.x = x;
    b.z = 0.6;
    b.friction = friction;
    return b;
}

/* One person presses a box with friction by 600 N against a wall or a static box at x = 0: whatever
   part of it the floor takes, the person bears 600 N, 477.5 N/m. */
static void a_box_against_something_static(void **state) {
    (void)state;
    const Figures hand[] = {{600.0, 477.46}};
    for (int wall = 0; wall < 2; wall++) {
        Setup s = {.disc_count = 1, .body_count = 1, .loose_x = 0.01, .trembles = true};
        s.discs[0] = (Disc){.x = -0.4 - RADIUS, .force_x = 600.0};
        s.bodies[0] = make_box(-0.2, 0.6);
        if (wall) {
            s.walls[s.wall_count++] = (Wall){{0, -2, 1, -2, 1, 2, 0, 2}, 4, true};
        } else {
            s.bodies[s.body_count++] = make_block(0.5, 0.0, 1.0, 4.0, 0.0);
        }
        check_figures(&s, hand);
    }
}

/* Two boxes in a row transfer the force to the wall. */
static void two_boxes_in_a_row(void **state) {
    (void)state;
    const Figures hand[] = {{600.0, 477.46}};
    for (int friction = 0; friction < 2; friction++) {
        Setup s = {.disc_count = 1, .body_count = 3, .loose_x = 0.01, .trembles = friction};
        s.discs[0] = (Disc){.x = -0.8 - RADIUS, .force_x = 600.0};
        s.bodies[0] = make_box(-0.2, friction ? 0.6 : 0.0);
        s.bodies[1] = make_box(-0.6, friction ? 0.6 : 0.0);
        s.bodies[2] = make_block(0.5, 0.0, 1.0, 4.0, 0.0);
        check_figures(&s, hand);
    }
}

/* Through a box without friction the second person bears 600 N from either side: 954.9 N/m. Disc,
   box and disc are a column that buckles: any small offset grows by a factor of e in sqrt(56 kg m /
   1200 N) = 0.22 s. Walls beside each person, 1 mm off, keep it straight and bear nothing. */
static void a_box_between_two_people(void **state) {
    (void)state;
    const Figures hand[] = {{600.0, 477.46}, {600.0, 954.93}};
    Setup s = {.disc_count = 2, .body_count = 1, .wall_count = 1, .loose_x = 0.005};
    s.discs[0] = (Disc){.x = -0.8 - RADIUS, .force_x = 600.0};
    s.discs[1] = (Disc){.x = -RADIUS};
    s.bodies[0] = make_box(-0.6 - 0.002, 0.0);
    s.walls[0] = (Wall){{0, -2, 1, -2, 1, 2, 0, 2}, 4, true};
    for (int side = -1; side <= 1; side += 2) {
        double y = side * (RADIUS + 0.001);
        s.walls[s.wall_count++] = (Wall){{-1.2, y, -0.84, y}, 2, false};
        s.walls[s.wall_count++] = (Wall){{-0.36, y, -0.02, y}, 2, false};
    }
    check_figures(&s, hand);
}

/* A heavy box with friction 0.6 on the floor stands against 600 N: 200 kg hold 1,177 N. */
static void a_box_that_friction_holds(void **state) {
    (void)state;
    const Figures hand[] = {{600.0, 477.46}};
    Setup s = {.disc_count = 1, .body_count = 1, .loose_x = 0.01};
    s.discs[0] = (Disc){.x = -0.5 - RADIUS, .force_x = 600.0};
    s.bodies[0] = make_box(0.0, 0.6);
    s.bodies[0].mass = 200.0;
    s.bodies[0].size[0] = s.bodies[0].size[1] = 1.0;
    s.bodies[0].size[2] = 0.8; /* it is too low to tip, 600 N x 0.8 m < 1962 N x 0.5 m */
    s.bodies[0].z = 0.4;
    check_figures(&s, hand);
}

int main(void) {
    JoError error;
    JoWorldDef def = jo_default_world_def();
    JoWorld *world = jo_world_create(&def, NULL);
    JoBodyDef any = jo_default_body_def();
    bool available = jo_world_add_body(world, &any, &error).generation != 0;
    jo_world_free(world);
    if (!available)
        return 0; /* a build without Bullet */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_column_against_a_static_body),
        cmocka_unit_test(between_slanted_bodies),
        cmocka_unit_test(a_wedge_between_bodies),
        cmocka_unit_test(a_box_against_something_static),
        cmocka_unit_test(two_boxes_in_a_row),
        cmocka_unit_test(a_box_between_two_people),
        cmocka_unit_test(a_box_that_friction_holds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
