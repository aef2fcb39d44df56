/* Loads of people at rest, between forces and against walls: rows, columns, slanted walls, wedges,
   pyramids. Contacts have no friction; the circumference of a person is 2 pi 0.2 m = 1.2566 m. */
#include "unit/load_at_rest.h"

/* Makes a row of n people along `angle` (rad), centred at the origin, between two forces. */
static Setup make_row(uint32_t n, double newtons, double angle) {
    Setup s = {.disc_count = n, .loose_x = 0.01, .loose_y = 0.01};
    double c = cos(angle), sine = sin(angle);
    for (uint32_t i = 0; i < n; i++) {
        double at = 2.0 * RADIUS * (i - 0.5 * (n - 1));
        s.discs[i] = (Disc){.x = at * c, .y = at * sine};
    }
    s.discs[0].force_x = newtons * c;
    s.discs[0].force_y = newtons * sine;
    s.discs[n - 1].force_x = -newtons * c;
    s.discs[n - 1].force_y = -newtons * sine;
    return s;
}

/* Each bears 600 N; compression is 600 N / 1.2566 m = 477.5 N/m at the ends and twice that in
   between. */
static void compute_row_figures(uint32_t n, Figures *hand) {
    for (uint32_t i = 0; i < n; i++)
        hand[i] = (Figures){600.0, i == 0 || i + 1 == n ? 477.46 : 954.93};
}

static void check_people_row(uint32_t n) {
    Setup s = make_row(n, 600.0, 0.0);
    Figures hand[MOST_DISCS];
    compute_row_figures(n, hand);
    check_setup(&s, hand);
}

static void row_of_two_between_forces(void **state) {
    (void)state;
    check_people_row(2);
}

static void row_of_five_between_forces(void **state) {
    (void)state;
    check_people_row(5);
}

static void row_of_twelve_between_forces(void **state) {
    (void)state;
    check_people_row(12);
}

/* A row of discs buckles, so a channel with a clearance of 1 mm holds it: offsets of at most 2 mm
   over 400 mm transfer 3 N of 600 N to the walls. */
static void a_turned_row_in_a_channel(void **state) {
    (void)state;
    double angle = 37.0 * PI / 180.0, c = cos(angle), sine = sin(angle), half = RADIUS + 0.001;
    for (uint32_t n = 2; n <= 5; n += 3) {
        Setup s = make_row(n, 600.0, angle);
        s.wall_count = 2;
        for (int side = 0; side < 2; side++) {
            double out = side ? half : -half;
            s.walls[side] = (Wall){.xy = {-3 * c - out * sine, -3 * sine + out * c,
                                          3 * c - out * sine, 3 * sine + out * c},
                                   .corners = 2};
        }
        Figures hand[MOST_DISCS];
        compute_row_figures(n, hand);
        check_setup(&s, hand);
    }
}

/* Makes a column of n people, pressed against a wall at x = 0 by 1,000 N on the last. */
static Setup make_column(uint32_t n, bool solid) {
    Setup s = {.disc_count = n, .wall_count = 1, .loose_x = 0.01};
    for (uint32_t i = 0; i < n; i++)
        s.discs[i] = (Disc){.x = -RADIUS - 2.0 * RADIUS * i};
    s.discs[n - 1].force_x = 1000.0;
    s.walls[0] =
        solid ? (Wall){{0, -2, 1, -2, 1, 2, 0, 2}, 4, true} : (Wall){{0, -2, 0, 2}, 2, false};
    return s;
}

/* 1,000 N / 1.2566 m = 795.8 N/m. */
static void one_against_a_wall(void **state) {
    (void)state;
    const Figures hand[] = {{1000.0, 795.77}};
    for (int solid = 0; solid < 2; solid++) {
        Setup s = make_column(1, solid);
        check_setup(&s, hand);
    }
}

static void three_against_a_wall(void **state) {
    (void)state;
    const Figures hand[] = {{1000.0, 1591.55}, {1000.0, 1591.55}, {1000.0, 795.77}};
    for (int solid = 0; solid < 2; solid++) {
        Setup s = make_column(3, solid);
        check_setup(&s, hand);
    }
}

/* Makes the walls of a valley with its bottom at the origin; the angles are those of its sides. */
static Wall make_valley(double left, double right) {
    return (Wall){.xy = {-3 * cos(left), 3 * sin(left), 0, 0, 3 * cos(right), 3 * sin(right)},
                  .corners = 3};
}

/* Places a disc in a valley so that it touches both sides. */
static Disc place_in_valley(double left, double right, double radius) {
    /* sin(left) x + cos(left) y = r; -sin(right) x + cos(right) y = r. */
    double det = sin(left) * cos(right) + cos(left) * sin(right);
    return (Disc){.x = radius * (cos(right) - cos(left)) / det,
                  .y = radius * (sin(left) + sin(right)) / det,
                  .radius = radius};
}

/* 1,000 N down between walls that rise at 30 and 60 degrees. Across: N sin 30 = M sin 60; up:
   N cos 30 + M cos 60 = 1,000 N. So N = 866.0 N and M = 500 N, at right angles: the load is that of
   their sum, 1,000 N; (866.0 N + 500 N) / 1.2566 m = 1087.0 N/m. */
static void between_slanted_walls(void **state) {
    (void)state;
    const Figures hand[] = {{1000.0, 1087.05}};
    Setup s = {.disc_count = 1, .wall_count = 1, .loose_x = 0.02, .loose_y = 0.02};
    s.discs[0] = place_in_valley(PI / 6, PI / 3, RADIUS);
    s.discs[0].force_y = -1000.0;
    s.walls[0] = make_valley(PI / 6, PI / 3);
    check_setup(&s, hand);
}

/* Walls at 50 and 35 degrees hold two people; the upper one leans on the lower one and on the right
   wall. Equilibrium is solved from the contacts. */
static void two_between_slanted_walls(void **state) {
    (void)state;
    double left = 50.0 * PI / 180.0, right = 35.0 * PI / 180.0;
    Setup s = {.disc_count = 2, .wall_count = 1, .loose_x = 0.01, .loose_y = 0.01};
    s.discs[0] = place_in_valley(left, right, RADIUS);
    s.discs[1] = (Disc){.x = s.discs[0].x + 0.4 * cos(right),
                        .y = s.discs[0].y + 0.4 * sin(right),
                        .force_y = -700.0};
    s.discs[0].force_y = -400.0;
    s.walls[0] = make_valley(left, right);
    check_setup(&s, NULL);
}

/* Makes a trough with a flat bottom at y = 0 and sides at x = +-half. */
static Wall make_trough(double half) {
    return (Wall){.xy = {-half, 3, -half, 0, half, 0, half, 3}, .corners = 4};
}

/* A person is pressed by 600 N between two people with a gap of 0.2 m, each in a corner of a
   trough. The upper contacts lean by a = asin(0.3 m / 0.4 m): cos a = 0.6614, tan a = 1.1339. Each
   takes 300 N / cos a = 453.6 N, which the floor balances with 300 N and the side with 300 N tan a
   = 340.2 N. The upper person: 907.1 N / 1.2566 m = 721.9 N/m, load 600 N. The lower ones: (453.6 +
   300 + 340.2) N / 1.2566 m = 870.4 N/m, load 453.6 N. */
static void a_wedge_of_three(void **state) {
    (void)state;
    const Figures hand[] = {{453.56, 870.41}, {453.56, 870.41}, {600.0, 721.87}};
    Setup s = {.disc_count = 3, .wall_count = 1, .loose_y = 0.01};
    s.discs[0] = (Disc){.x = -0.3, .y = RADIUS};
    s.discs[1] = (Disc){.x = 0.3, .y = RADIUS};
    s.discs[2] = (Disc){.x = 0.0, .y = RADIUS + sqrt(0.16 - 0.09), .force_y = -600.0};
    s.walls[0] = make_trough(0.5);
    check_setup(&s, hand);
}

/* The same with unequal people, of radius 0.25 m and 0.15 m, 100 kg and 40 kg, and a slanted
   force. */
static void a_wedge_of_unequal_people(void **state) {
    (void)state;
    Setup s = {.disc_count = 3, .wall_count = 1, .loose_y = 0.01};
    s.discs[0] = (Disc){.x = -0.25, .y = 0.25, .radius = 0.25, .mass = 100.0};
    s.discs[1] = (Disc){.x = 0.35, .y = 0.15, .radius = 0.15, .mass = 40.0};
    /* The third is 0.45 m from the first and 0.35 m from the second, which are c apart: along the
       line between them (0.45^2 - 0.35^2 + c^2) / 2 c from the first, and above it. */
    double dx = 0.6, dy = -0.1, c = hypot(dx, dy);
    double along = (0.45 * 0.45 - 0.35 * 0.35 + c * c) / (2.0 * c);
    double up = sqrt(0.45 * 0.45 - along * along);
    s.discs[2] = (Disc){.x = -0.25 + (along * dx - up * dy) / c,
                        .y = 0.25 + (along * dy + up * dx) / c,
                        .force_x = 60.0,
                        .force_y = -500.0};
    s.walls[0] = make_trough(0.5);
    check_setup(&s, NULL);
}

/* Each weighs 500 N. The upper person exerts 250 N tan a outwards and 250 N down on each lower one,
   as in the wedge, with tan a = 1.1339; the floor bears 750 N below each. */
static void a_pyramid_of_two_and_one(void **state) {
    (void)state;
    Setup s = {.disc_count = 3, .wall_count = 1, .loose_y = 0.01};
    s.discs[0] = (Disc){.x = -0.3, .y = RADIUS};
    s.discs[1] = (Disc){.x = 0.3, .y = RADIUS};
    s.discs[2] = (Disc){.x = 0.0, .y = RADIUS + sqrt(0.16 - 0.09)};
    for (int i = 0; i < 3; i++)
        s.discs[i].force_y = -500.0;
    s.walls[0] = make_trough(0.5);
    /* Contact 250 N / cos a = 377.96 N, side 283.47 N, floor 750 N. Along d at the angle t from
       the vertical, floor and side give 750 cos t + 283.47 sin t, at most hypot = 801.8 N. */
    const Figures hand[] = {{801.78, 1123.18}, {801.78, 1123.18}, {500.0, 601.55}};
    check_setup(&s, hand);
}

/* Three people stand in notches of the floor (on a flat floor the middle one could roll aside), two
   on them, one on top; each weighs W = 300 N. Contacts lean by a = asin(0.23 m / 0.4 m). The top
   person exerts W / 2 cos a on either side. Horizontally and vertically, one of the second row has
   L - R = W / 2 cos a, L + R = 1.5 W / cos a: outwards L = W / cos a, inwards R = W / 2 cos a. So
   each of the three below bears 2 W down, the outer ones W tan a outwards as well, and each side of
   their notch (2 W +- W tan a) / sqrt 2. */
static void a_pyramid_of_three_two_and_one(void **state) {
    (void)state;
    const double pitch = 0.46, step = sqrt(0.16 - 0.25 * 0.46 * 0.46), low = RADIUS * sqrt(2.0);
    Setup s = {.disc_count = 6, .wall_count = 1, .loose_y = 0.01};
    for (int i = 0; i < 3; i++)
        s.discs[i] = (Disc){.x = (i - 1) * pitch, .y = low};
    for (int i = 0; i < 2; i++)
        s.discs[3 + i] = (Disc){.x = (i - 0.5) * pitch, .y = low + step};
    s.discs[5] = (Disc){.x = 0.0, .y = low + 2.0 * step};
    for (int i = 0; i < 6; i++)
        s.discs[i].force_y = -300.0;
    s.walls[0].corners = 9;
    for (int i = 0; i < 9; i++) {
        double x = 0.5 * pitch * (i - 4); /* notches at even points: two beyond the three */
        s.walls[0].xy[2 * i] = x;
        s.walls[0].xy[2 * i + 1] = i % 2 ? 0.5 * pitch : 0.0;
    }
    s.walls[0].xy[1] = s.walls[0].xy[17] = 2.0; /* the outer ones become sides */
    s.walls[0].xy[0] = -1.5 * pitch - 0.5;
    s.walls[0].xy[16] = 1.5 * pitch + 0.5;
    double lean = asin(0.575), out = 300.0 * tan(lean), girth = 2.0 * PI * RADIUS;
    Contact contacts[MOST_CONTACTS];
    Figures hand[MOST_DISCS];
    assert_int_equal(solve_balance(&s, contacts), 12);
    solve_figures(&s, hand);
    double below = 2.0 * 600.0 / sqrt(2.0) + 300.0 / cos(lean);
    assert_true(out < 600.0 && fabs(hand[0].compression - below / girth) < 0.1);
    assert_true(fabs(hand[1].compression - below / girth) < 0.1); /* its own: 2 R = W / cos a */
    assert_true(fabs(hand[3].compression - 2.0 * 300.0 / cos(lean) / girth) < 0.1);
    check_figures(&s, hand);
}

/* In a valley of 45 degrees one person lies at the bottom, two on them and the walls, one on top: a
   square standing on its corner, whose contacts equilibrium determines. */
static void a_pile_in_a_valley(void **state) {
    (void)state;
    Setup s = {.disc_count = 4, .wall_count = 1, .loose_y = 0.01};
    double low = RADIUS * sqrt(2.0);
    s.discs[0] = (Disc){.x = 0.0, .y = low};
    s.discs[1] = (Disc){.x = -low, .y = 2.0 * low};
    s.discs[2] = (Disc){.x = low, .y = 2.0 * low};
    s.discs[3] = (Disc){.x = 0.0, .y = 3.0 * low};
    for (int i = 0; i < 4; i++)
        s.discs[i].force_y = -400.0;
    s.walls[0] = make_valley(PI / 4, PI / 4);
    check_setup(&s, NULL);
}

/* 24 people press on a large one, more than an agent perceives, with 100 N each: compression 2,400
   N / 2 pi 1.5 m; load 100 N / sin(7.5 degrees), the sum of the components of half of them. */
static void many_press_on_one(void **state) {
    (void)state;
    Setup s = {.disc_count = 25, .loose_x = 0.005, .loose_y = 0.005, .central = true};
    Figures hand[MOST_DISCS] = {{100.0 / sin(PI / 24), 2400.0 / (2.0 * PI * 1.5)}};
    s.discs[0] = (Disc){.radius = 1.5, .mass = 3000.0};
    for (int i = 0; i < 24; i++) {
        double c = cos(2 * PI * (i + 0.5) / 24), sine = sin(2 * PI * (i + 0.5) / 24);
        s.discs[i + 1] = (Disc){1.65 * c, 1.65 * sine, -100.0 * c, -100.0 * sine, 0.15, MASS};
        hand[i + 1] = (Figures){100.0, 100.0 / (2.0 * PI * 0.15)};
    }
    check_setup(&s, hand);
}

/* Two torsos of 0.45 m by 0.25 m, chest to back, between forces of 600 N: each bears 600 N over its
   circumference, 2 pi 0.125 m + 4 * 0.1 m = 1.1854 m. */
static void compression_is_over_circumference_of_torso(void **state) {
    (void)state;
    const double dt = 0.05;
    JoError error = {0};
    JoWorldDef def = jo_default_world_def();
    def.dt = dt;
    JoWorld *world = jo_world_create(&def, &error);
    JoAgent people[2];
    for (int i = 0; i < 2; i++) {
        JoAgentDef agent = jo_default_agent_def();
        agent.x = 0.35 * i; /* the forces bring them together */
        people[i] = jo_world_add_agent(world, &agent, &error);
        jo_agent_set_parameter(world, people[i], "breadth", 0.45, NULL);
        jo_agent_set_parameter(world, people[i], "depth", 0.25, NULL);
    }
    for (int step = 0; step < (int)(1.0 / dt); step++) { /* later it buckles */
        for (int i = 0; i < 2; i++)
            jo_agent_apply_force(world, people[i], i ? -600.0 : 600.0, 0.0);
        jo_world_step(world, 1);
    }
    for (int i = 0; i < 2; i++) {
        const JoAgentState a = jo_agent_state(world, people[i]);
        assert_float_equal(a.load, 600.0, 600.0 * WITHIN);
        assert_float_equal(a.compression, 600.0 / 1.1854, 600.0 / 1.1854 * WITHIN);
    }
    jo_world_free(world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(row_of_two_between_forces),
        cmocka_unit_test(row_of_five_between_forces),
        cmocka_unit_test(row_of_twelve_between_forces),
        cmocka_unit_test(a_turned_row_in_a_channel),
        cmocka_unit_test(one_against_a_wall),
        cmocka_unit_test(three_against_a_wall),
        cmocka_unit_test(between_slanted_walls),
        cmocka_unit_test(two_between_slanted_walls),
        cmocka_unit_test(a_wedge_of_three),
        cmocka_unit_test(a_wedge_of_unequal_people),
        cmocka_unit_test(a_pyramid_of_two_and_one),
        cmocka_unit_test(a_pyramid_of_three_two_and_one),
        cmocka_unit_test(a_pile_in_a_valley),
        cmocka_unit_test(many_press_on_one),
        cmocka_unit_test(compression_is_over_circumference_of_torso),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
