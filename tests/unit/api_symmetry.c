/* Crowds that meet in a symmetric arrangement pass each other: rings, squares, files and crossings,
   by ORCA, as set up by a C program. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "jostle.h"

enum { MOST_PEOPLE = 48 };
static const double PI = 3.141592653589793;

typedef struct Way {
    double x, y, goal_x, goal_y; /* m */
} Way;

typedef struct Crowd {
    JoWorldDef def;
    int count, walls;
    Way ways[MOST_PEOPLE];
    double lines[12][4]; /* m, walls */
} Crowd;

/* Results of a run. */
typedef struct Outcome {
    int arrived;
    double time; /* s */
    uint64_t hash;
    double x, y; /* m, sums of all positions on the way */
} Outcome;

static void add_way(Crowd *crowd, double x, double y, double goal_x, double goal_y) {
    assert_true(crowd->count < MOST_PEOPLE);
    crowd->ways[crowd->count++] = (Way){x, y, goal_x, goal_y};
}

static void add_wall(Crowd *crowd, double x0, double y0, double x1, double y1) {
    double *line = crowd->lines[crowd->walls++];
    line[0] = x0, line[1] = y0, line[2] = x1, line[3] = y1;
}

static Crowd make_crowd(uint64_t seed) {
    Crowd crowd = {.def = jo_default_world_def()};
    crowd.def.seed = seed;
    return crowd;
}

static Crowd make_ring(int count, uint64_t seed) {
    Crowd crowd = make_crowd(seed);
    for (int i = 0; i < count; i++) {
        const double x = 6 * cos(2 * PI * i / count), y = 6 * sin(2 * PI * i / count);
        add_way(&crowd, x, y, -x, -y);
    }
    return crowd;
}

/* From `distance` m before a crossing to as far behind it, on each of the four ways, `aside` m to
   the right of the middle. */
static void add_four(Crowd *crowd, double distance, double aside) {
    add_way(crowd, -distance, -aside, distance, -aside);
    add_way(crowd, distance, aside, -distance, aside);
    add_way(crowd, aside, -distance, aside, distance);
    add_way(crowd, -aside, distance, -aside, -distance);
}

static void add_people(const Crowd *crowd, JoWorld *world, JoAgent *people) {
    for (int k = 0; k < crowd->walls; k++)
        assert_true(jo_world_add_line(world, crowd->lines[k], 2, NULL));
    for (int i = 0; i < crowd->count; i++) {
        JoAgentDef person = jo_default_agent_def();
        person.x = crowd->ways[i].x;
        person.y = crowd->ways[i].y;
        people[i] = jo_world_add_agent(world, &person, NULL);
    }
}

/* Until all are within 0.3 m of their goals, where they stay, or for `most` seconds. */
static Outcome run_crowd(const Crowd *crowd, double most) {
    JoAgent people[MOST_PEOPLE];
    Outcome out = {0};
    JoWorld *world = jo_world_create(&crowd->def, NULL);
    assert_non_null(world);
    add_people(crowd, world, people);
    while (out.arrived < crowd->count && jo_world_time(world) < most) {
        out.arrived = 0;
        for (int i = 0; i < crowd->count; i++) {
            const JoAgentState now = jo_agent_state(world, people[i]);
            const double x = crowd->ways[i].goal_x - now.x, y = crowd->ways[i].goal_y - now.y;
            const double left = hypot(x, y), speed = left < 0.3 ? 0.0 : 1.3;
            out.arrived += left < 0.3;
            out.x += now.x;
            out.y += now.y;
            jo_agent_set_preferred(world, people[i], x / left * speed, y / left * speed);
        }
        jo_world_step(world, 1);
    }
    out.time = jo_world_time(world);
    out.hash = jo_world_hash(world);
    jo_world_free(world);
    return out;
}

static void check_all_arrive(const Crowd *crowd, double most) {
    const Outcome out = run_crowd(crowd, most);
    if (out.arrived < crowd->count)
        print_error("%d of %d arrived within %.0f s\n", out.arrived, crowd->count, most);
    assert_int_equal(out.arrived, crowd->count);
}

static void rings_of_any_number_change_sides(void **state) {
    (void)state;
    for (int count = 2; count <= 40; count += count < 13 ? 1 : 3)
        for (uint64_t seed = 1; seed <= 2; seed++) {
            const Crowd ring = make_ring(count, seed);
            check_all_arrive(&ring, 45.0);
        }
}

static void rings_change_sides_without_forces(void **state) {
    (void)state;
    for (int count = 3; count <= 24; count += 7) {
        Crowd ring = make_ring(count, 1);
        ring.def.forces = false;
        check_all_arrive(&ring, 45.0);
    }
}

static void sides_of_a_square_change_places(void **state) {
    (void)state;
    for (int abreast = 1; abreast <= 4; abreast++) {
        Crowd square = make_crowd(1);
        for (int k = 0; k < abreast; k++)
            add_four(&square, 3.0 + 0.4 * abreast, 0.8 * (k - 0.5 * (abreast - 1)));
        check_all_arrive(&square, 45.0);
    }
}

static void streams_cross_between_corners(void **state) {
    (void)state;
    for (int people = 1; people <= 4; people++) {
        Crowd crossing = make_crowd(1);
        for (int side = -1; side <= 1; side += 2)
            for (int end = -1; end <= 1; end += 2) {
                add_wall(&crossing, end * 8.0, side, end, side);
                add_wall(&crossing, side, end * 8.0, side, end);
            }
        for (int k = 0; k < people; k++)
            add_four(&crossing, 2.5 + 0.8 * (k / 2), k % 2 ? 0.4 : -0.4);
        check_all_arrive(&crossing, 60.0);
    }
}

static void two_abreast_pass_two_in_a_corridor(void **state) {
    (void)state;
    for (double width = 1.0; width < 2.0; width += 0.2) {
        Crowd corridor = make_crowd(1);
        for (int side = -1; side <= 1; side += 2) {
            add_wall(&corridor, -8, 0.5 * side * width, 8, 0.5 * side * width);
            add_way(&corridor, -5, 0.25 * side, 6, 0.25 * side);
            add_way(&corridor, 5, 0.25 * side, -6, 0.25 * side);
        }
        check_all_arrive(&corridor, 60.0);
    }
}

static void turning_aside_depends_on_the_seed_alone(void **state) {
    (void)state;
    Crowd ring = make_ring(24, 1);
    ring.def.isa = JO_ISA_SCALAR;
    const Outcome once = run_crowd(&ring, 45.0);
    for (JoIsa isa = JO_ISA_WIDEST; isa <= JO_ISA_NEON; isa++) {
        ring.def.isa = isa;
        ring.def.threads = 1 + isa % 2;
        JoWorld *world = jo_world_create(&ring.def, NULL);
        if (!world)
            continue; /* not an instruction set of this machine */
        jo_world_free(world);
        const Outcome again = run_crowd(&ring, 45.0);
        assert_true(again.hash == once.hash && again.time == once.time);
    }
    ring.def.seed = 2;
    ring.def.isa = JO_ISA_WIDEST;
    assert_true(run_crowd(&ring, 45.0).x != once.x);
}

/* The paper has no random numbers. */
static void as_printed_no_seed_changes_a_run(void **state) {
    (void)state;
    Crowd ring = make_ring(8, 1);
    ring.def.literal = true;
    const Outcome one = run_crowd(&ring, 30.0);
    ring.def.seed = 2;
    const Outcome other = run_crowd(&ring, 30.0);
    assert_true(one.x == other.x && one.y == other.y && one.time == other.time);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rings_of_any_number_change_sides),
        cmocka_unit_test(rings_change_sides_without_forces),
        cmocka_unit_test(sides_of_a_square_change_places),
        cmocka_unit_test(streams_cross_between_corners),
        cmocka_unit_test(two_abreast_pass_two_in_a_corridor),
        cmocka_unit_test(turning_aside_depends_on_the_seed_alone),
        cmocka_unit_test(as_printed_no_seed_changes_a_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
