/* People and bodies that move by velocities of their own: who is pushed, who makes way, and what
   programs can do to such a body. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "body/body.h"
#include "jostle.h"
#include "jostle_act.h"
#include "jostle_read.h"

typedef struct Meeting {
    JoWorld *world;
    JoAgent person;
    JoBody gate;
} Meeting;

/* A barrier 1 m high and 4 m long whose front is at x = 0.25 m, and somebody at (2, 0) who wants to
   stay. */
static Meeting meet(bool forces, double speed) {
    JoError error = {0};
    JoWorldDef def = jo_default_world_def();
    def.forces = forces;
    Meeting m = {.world = jo_world_create(&def, &error)};
    JoAgentDef agent = jo_default_agent_def();
    agent.x = 2;
    m.person = jo_world_add_agent(m.world, &agent, &error);
    jo_agent_set_parameter(m.world, m.person, "breadth", 2.0 * agent.radius, NULL); /* a disc */
    jo_agent_set_parameter(m.world, m.person, "depth", 2.0 * agent.radius, NULL);
    JoBodyDef gate = jo_default_body_def();
    gate.size[0] = 0.5;
    gate.size[1] = 4;
    gate.kinematic = true;
    gate.vx = speed;
    m.gate = jo_world_add_body(m.world, &gate, &error);
    if (error.text[0])
        fail_msg("%s", error.text);
    return m;
}

/* m, between the barrier's front and the person. */
static double gap(const Meeting *m) {
    const JoAgentState person = jo_agent_state(m->world, m->person);
    return person.x - person.radius - jo_body_state(m->world, m->gate).x - 0.25;
}

static void standing_agent_is_pushed_along(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    Meeting m = meet(true, 0.6);
    double least = 9, load = 0;
    for (int step = 0; step < 200; step++) {
        jo_world_step(m.world, 1);
        least = fmin(least, gap(&m));
        load = fmax(load, jo_agent_state(m.world, m.person).load);
    }
    print_message("  %.0f N and %.1f mm deep at most, at the end at %.2f m\n", load,
                  fmax(0, -1e3 * least), jo_agent_state(m.world, m.person).x);
    assert_float_equal(jo_body_state(m.world, m.gate).x, 6.0, 1e-3); /* it was not held up */
    assert_true(jo_agent_state(m.world, m.person).x > 6.4);
    assert_true(least > -0.005);
    jo_world_free(m.world);
}

/* Without forces nobody is pushed: they make way before it comes. */
static void people_make_way(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    Meeting m = meet(false, 0.6);
    double least = 9;
    for (int step = 0; step < 200; step++) {
        jo_world_step(m.world, 1);
        least = fmin(least, gap(&m));
    }
    assert_true(jo_agent_state(m.world, m.person).x > 6.4 ||
                fabs(jo_agent_state(m.world, m.person).y) > 2);
    assert_true(least > -0.01);
    jo_world_free(m.world);
}

static void turning_bar_sweeps_people_along(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    Meeting m = meet(true, 0.0);
    JoError error = {0};
    const double still[3] = {0}, spin[3] = {0, 0, 0.4};
    const double at[3] = {1, 1.2, 0.5};
    assert_true(jo_body_place(m.world, m.gate, at, NULL, &error));
    assert_true(jo_body_set_velocity(m.world, m.gate, still, spin, &error));
    double least = 9; /* m, from the bar's middle line */
    for (int step = 0; step < 300; step++) {
        jo_world_step(m.world, 1);
        const JoAgentState p = jo_agent_state(m.world, m.person);
        const JoBodyState b = jo_body_state(m.world, m.gate);
        const double turn = 2 * atan2(b.qz, b.qw), x = p.x - b.x, y = p.y - b.y;
        const double across = x * cos(turn) + y * sin(turn), along = y * cos(turn) - x * sin(turn);
        if (fabs(along) < 2)
            least = fmin(least, fabs(across) - 0.25 - p.radius);
    }
    print_message("  %.1f mm deep at most\n", fmax(0, -1e3 * least));
    assert_true(least > -0.005 && least < 0.05);
    jo_world_free(m.world);
}

static void programs_drive_it(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    Meeting m = meet(true, 0.0);
    JoError error = {0};
    const double velocity[3] = {0, 1, 0}, impulse[3] = {1e4, 0, 0};
    jo_world_step(m.world, 20);
    assert_float_equal(jo_body_state(m.world, m.gate).y, 0.0, 0.0);
    assert_true(jo_body_set_velocity(m.world, m.gate, velocity, NULL, &error));
    assert_false(jo_body_impulse(m.world, m.gate, impulse, NULL, &error));
    assert_non_null(strstr(error.text, "kinematic"));
    jo_world_step(m.world, 40);
    assert_float_equal(jo_body_state(m.world, m.gate).x, 0.0, 0.0);
    assert_float_equal(jo_body_state(m.world, m.gate).y, 2.0, 1e-4);
    assert_float_equal(jo_body_state(m.world, m.gate).vy, 1.0, 0.0);
    jo_world_free(m.world);
}

/* To and fro between two points, with a stop at each. */
static void programs_give_it_a_path(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    Meeting m = meet(true, 0.0);
    JoError error = {0};
    const double points[] = {20, 2, 0.5, 20, 2, 3};
    JoBodyDef lift = jo_default_body_def();
    lift.x = 20;
    lift.kinematic = true;
    lift.path = (JoPath){
        .points = points, .count = 2, .end = JO_PATH_BACK, .speed = 0.5, .after = 1, .wait = 1};
    const JoBody body = jo_world_add_body(m.world, &lift, &error);
    assert_true(body.generation > 0);
    jo_world_step(m.world, 60); /* 3 s */
    assert_float_equal(jo_body_state(m.world, body).y, 1.0, 1e-4);
    assert_float_equal(jo_body_state(m.world, body).vy, 0.5, 1e-6);
    jo_world_step(m.world, 160); /* 11 s: at the top from then on for a second */
    assert_float_equal(jo_body_state(m.world, body).z, 3.0, 1e-4);
    jo_world_step(m.world, 60); /* 14 s: on its way down since 12 s */
    assert_float_equal(jo_body_state(m.world, body).z, 2.0, 1e-4);
    lift.kinematic = false;
    assert_int_equal(jo_world_add_body(m.world, &lift, &error).generation, 0);
    assert_non_null(strstr(error.text, "kinematic"));
    lift.kinematic = true;
    for (uint32_t count = 0; count < 2; count++) { /* none, and more than there may be */
        lift.path.count = count ? UINT32_MAX : 0;
        assert_int_equal(jo_world_add_body(m.world, &lift, &error).generation, 0);
        assert_non_null(strstr(error.text, "points"));
    }
    jo_world_free(m.world);
}

/* A leaf of a door that shuts upon somebody who stands before a wall: what it presses with at most,
   N; where it is in the end, and farthest. */
typedef struct Squeeze {
    double most, farthest, last;
} Squeeze;

static Squeeze squeeze(double limit, bool reopens) {
    JoError error = {0};
    JoWorldDef def = jo_default_world_def();
    JoWorld *world = jo_world_create(&def, &error);
    const double wall[] = {1.2, -0.5, 1.2, 0.5, 1.4, 0.5, 1.4, -0.5}, through[] = {0.7, 0, 1};
    assert_true(jo_world_add_solid(world, wall, 4, &error));
    JoAgentDef person = jo_default_agent_def();
    person.x = 0.5;
    const JoAgent one = jo_world_add_agent(world, &person, &error);
    jo_agent_set_parameter(world, one, "breadth", 2.0 * person.radius, NULL); /* a disc */
    jo_agent_set_parameter(world, one, "depth", 2.0 * person.radius, NULL);
    JoBodyDef leaf = jo_default_body_def();
    leaf.size[0] = 1;
    leaf.size[1] = 0.1;
    leaf.size[2] = 2;
    leaf.x = -0.7;
    leaf.z = 1;
    leaf.kinematic = true;
    leaf.force_limit = 0;
    leaf.path = (JoPath){.points = through,
                         .count = 1,
                         .speed = 0.5,
                         .wait = 1,
                         .force_limit = limit,
                         .reopens = reopens};
    const JoBody body = jo_world_add_body(world, &leaf, &error);
    if (!body.generation)
        fail_msg("%s", error.text);
    Squeeze s = {0, -9, 0};
    for (int step = 0; step < 90; step++) {
        double impulse[3];
        jo_world_step(world, 1);
        assert_true(jo_body_pushed(world, body, impulse, NULL));
        s.most = fmax(s.most, -impulse[0] / def.dt);
        s.last = jo_body_state(world, body).x;
        s.farthest = fmax(s.farthest, s.last);
    }
    jo_world_free(world);
    return s;
}

static void a_door_feels_whom_it_squeezes(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    const Squeeze blind = squeeze(0, false), stands = squeeze(150, false),
                  reopens = squeeze(150, true);
    print_message("  blind %.0f N; with a limit %.0f N and %.0f N, and back from %.2f at %.2f m\n",
                  blind.most, stands.most, reopens.most, reopens.farthest, reopens.last);
    assert_true(blind.most > 1000.0);
    assert_float_equal(blind.last, 0.7, 1e-3); /* shut, whoever stands there */
    assert_true(stands.most > 140.0 && stands.most < 150.1);
    assert_float_equal(stands.last, 0.3,
                       0.03); /* it stands at the person, who stands at the wall */
    assert_true(reopens.most > 140.0 && reopens.most < 150.1);
    assert_true(reopens.farthest > 0.1 && reopens.farthest < 0.35);
    assert_true(reopens.last < -0.3);
    JoError error = {0};
    JoWorldDef def = jo_default_world_def();
    JoWorld *world = jo_world_create(&def, &error);
    JoBodyDef wrong = jo_default_body_def();
    wrong.kinematic = true;
    wrong.force_limit = 0;
    wrong.path = (JoPath){.points = (double[]){5, 0, 0}, .count = 1, .speed = 1, .reopens = true};
    assert_int_equal(jo_world_add_body(world, &wrong, &error).generation, 0);
    assert_non_null(strstr(error.text, "limit"));
    jo_world_free(world);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(standing_agent_is_pushed_along),
                                       cmocka_unit_test(people_make_way),
                                       cmocka_unit_test(turning_bar_sweeps_people_along),
                                       cmocka_unit_test(programs_drive_it),
                                       cmocka_unit_test(programs_give_it_a_path),
                                       cmocka_unit_test(a_door_feels_whom_it_squeezes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
