/* People do not touch through a wall: two people, one on either side of a thin wall. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "world/world.h"

static const double STEPS[] = {0.1, 0.05, 0.025, 0.0125, 0.00625};
enum { STEP_COUNT = 5 };
static const double GIRTH = 6.28318530717958648 * 0.2; /* m */

/* A thin wall along x = 0 from y = low to high (none if they are equal), and a person on either
 * side. */
typedef struct Sides {
    JoWorld *world;
    JoAgent left, right;
} Sides;

static Sides open_sides(double dt, double low, double high, double gap, double perception) {
    Sides s;
    JoWorldDef def = jo_default_world_def();
    def.dt = dt;
    s.world = jo_world_create(&def, NULL);
    const double line[] = {0.0, low, 0.0, high};
    if (low < high)
        assert_true(jo_world_add_line(s.world, line, 2, NULL));
    JoAgentDef person = jo_default_agent_def();
    person.perception = perception;
    person.x = -0.2 - gap;
    s.left = jo_world_add_agent(s.world, &person, NULL);
    person.x = 0.2 + gap;
    s.right = jo_world_add_agent(s.world, &person, NULL);
    for (int k = 0; k < 2; k++) { /* discs */
        const JoAgent one = k ? s.right : s.left;
        jo_agent_set_parameter(s.world, one, "breadth", 2.0 * person.radius, NULL);
        jo_agent_set_parameter(s.world, one, "depth", 2.0 * person.radius, NULL);
    }
    return s;
}

static void press_sides(Sides *s, double seconds, double left, double right) {
    double dt = s->world->model.def.dt;
    for (int step = 0; step < (int)(seconds / dt + 0.5); step++) {
        jo_agent_apply_force(s->world, s->left, left, 0.0);
        jo_agent_apply_force(s->world, s->right, -right, 0.0);
        jo_world_step(s->world, 1);
    }
    assert_null(jo_world_failure(s->world));
}

static void check_load(const Sides *s, JoAgent who, double newtons, const char *what) {
    JoAgentState a = jo_agent_state(s->world, who);
    double off = fmax(fabs(a.load - newtons), fabs(a.compression * GIRTH - newtons));
    if (!(off <= 0.03 * newtons + 1.0))
        fail_msg("%s, at dt %g: %s bears %.0f N and %.0f N/m, not %.0f N and %.0f N/m", what,
                 s->world->model.def.dt,
                 who.slot == s->left.slot ? "the left one" : "the right one", a.load, a.compression,
                 newtons, newtons / GIRTH);
}

/* Two people 1 cm from the wall are pressed together by 600 N each: each bears the wall's 600 N,
   477 N/m, and no force of the other. */
static void each_bears_the_wall_alone(void **state) {
    (void)state;
    for (int k = 0; k < 2 * STEP_COUNT; k++) {
        Sides s = open_sides(STEPS[k % STEP_COUNT], -2.0, 2.0, 0.01, k < STEP_COUNT ? 3.0 : 0.0);
        press_sides(&s, 3.0, 600.0, 600.0);
        check_load(&s, s.left, 600.0, "pressed together");
        check_load(&s, s.right, 600.0, "pressed together");
        assert_true(jo_agent_state(s.world, s.left).x < -0.19);
        assert_true(jo_agent_state(s.world, s.right).x > 0.19);
        jo_world_free(s.world);
    }
}

/* A person who stands beside the wall bears no force from a person pressed to its other side, and
   stays where they are. */
static void standing_person_feels_nothing_through_wall(void **state) {
    (void)state;
    for (int k = 0; k < 2 * STEP_COUNT; k++)
        for (int near = 0; near < 3; near++) {
            double gap = near == 0 ? 0.0 : near == 1 ? 0.001 : 0.05;
            Sides s = open_sides(STEPS[k % STEP_COUNT], -2.0, 2.0, gap, k < STEP_COUNT ? 3.0 : 0.0);
            const JoxAgents *a = &s.world->state.agents;
            for (int part = 0; part < 30; part++) {
                press_sides(&s, 0.1, 1000.0, 0.0);
                uint32_t right = jox_world_find_agent(s.world, s.right);
                if (a->inferred_x[right] != 0.0f || a->contact_x[right] != 0.0f)
                    fail_msg("at dt %g the one behind the wall gets %g N passed on and %g N by "
                             "contact",
                             s.world->model.def.dt, (double)a->inferred_x[right],
                             (double)a->contact_x[right]);
            }
            check_load(&s, s.left, 1000.0, "one pressed");
            check_load(&s, s.right, 0.0, "one standing");
            assert_true(fabs(jo_agent_state(s.world, s.right).x - 0.2 - gap) < 0.005);
            jo_world_free(s.world);
        }
}

/* A person who pushes towards a wall, or runs into it, exerts no force on a person behind it. */
static void pushes_and_runs_end_at_wall(void **state) {
    (void)state;
    for (int k = 0; k < STEP_COUNT; k++)
        for (int run = 0; run < 2; run++) {
            Sides s = open_sides(STEPS[k], -2.0, 2.0, 0.02, 3.0);
            JoxAgents *a = &s.world->state.agents;
            if (run) {
                uint32_t left = jox_world_find_agent(s.world, s.left);
                a->vx[left] = 2.0f;
            } else {
                jo_agent_set_parameter(s.world, s.left, "push", 300.0, NULL);
                jo_agent_set_preferred(s.world, s.left, 1.3, 0.0);
            }
            for (int step = 0; step < (int)(2.0 / STEPS[k]); step++) {
                jo_world_step(s.world, 1);
                uint32_t right = jox_world_find_agent(s.world, s.right);
                if (a->push_x[right] != 0.0f || a->inferred_x[right] != 0.0f)
                    fail_msg("at dt %g the one behind the wall is pushed by %g N and gets %g N "
                             "passed on",
                             STEPS[k], (double)a->push_x[right], (double)a->inferred_x[right]);
            }
            check_load(&s, s.right, 0.0, "behind the wall");
            assert_true(fabs(jo_agent_state(s.world, s.right).x - 0.22) < 0.005);
            jo_world_free(s.world);
        }
}

/* Without the wall, or beyond its end, the same people touch: this proves that the tests above can
   fail. */
static void people_touch_beyond_end_of_wall(void **state) {
    (void)state;
    for (int k = 0; k < STEP_COUNT; k++)
        for (int end = 0; end < 2; end++) {
            Sides s = open_sides(STEPS[k], end ? -3.0 : 0.0, end ? -1.0 : 0.0, 0.01, 3.0);
            press_sides(&s, 3.0, 600.0, 600.0);
            check_load(&s, s.left, 600.0, "without a wall between");
            check_load(&s, s.right, 600.0, "without a wall between");
            jo_world_free(s.world);
            s = open_sides(STEPS[k], end ? -3.0 : 0.0, end ? -1.0 : 0.0, 0.02, 3.0);
            jo_agent_set_parameter(s.world, s.left, "push", 300.0, NULL);
            jo_agent_set_preferred(s.world, s.left, 1.3, 0.0);
            jo_world_step(s.world, 1);
            assert_true(s.world->state.agents.push_x[jox_world_find_agent(s.world, s.right)] >
                        299.0f);
            jo_world_free(s.world);
        }
}

/* A box that moves towards a wall, or lies against it, and a person pressed to the other side exert
   no force on each other; without the wall the box hits the person, who pushes it away. */
static void box_and_person_do_not_touch_through_wall(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    for (int k = 0; k < 4 * STEP_COUNT; k++) {
        bool wall = k / STEP_COUNT % 2 == 0, runs = k >= 2 * STEP_COUNT;
        Sides s = open_sides(STEPS[k % STEP_COUNT], wall ? -2.0 : 0.0, wall ? 2.0 : 0.0, 0.0, 0.0);
        jo_world_remove_agent(s.world, s.right);
        JoBodyDef def = jo_default_body_def();
        def.size[0] = def.size[1] = def.size[2] = 1.2;
        def.x = runs ? 0.8 : 0.622;
        def.z = 0.6;
        def.vx = runs ? -1.0 : 0.0;
        def.mass = 10.0;
        def.friction = 0.0;
        JoBody box = jo_world_add_body(s.world, &def, NULL);
        double fastest = 0.0, pressed = runs ? 0.0 : 600.0;
        for (int step = 0; step < (int)(1.0 / STEPS[k % STEP_COUNT] + 0.5); step++) {
            jo_agent_apply_force(s.world, s.left, pressed, 0.0);
            jo_world_step(s.world, 1);
            fastest = fmax(fastest, fabs(jo_agent_state(s.world, s.left).vx));
        }
        double moved = jo_body_state(s.world, box).x - def.x;
        if (wall && runs && fastest > 1e-6)
            fail_msg("at dt %g a box throws someone behind a wall at %g m/s", STEPS[k % STEP_COUNT],
                     fastest);
        if (wall && !runs && fabs(moved) > 0.005)
            fail_msg("at dt %g a box is pushed %g m through a wall", STEPS[k % STEP_COUNT], moved);
        if (wall && !runs)
            check_load(&s, s.left, 600.0, "beside the box");
        assert_true(wall || (runs ? fastest > 0.1 : moved > 0.1));
        jo_world_free(s.world);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_bears_the_wall_alone),
        cmocka_unit_test(standing_person_feels_nothing_through_wall),
        cmocka_unit_test(pushes_and_runs_end_at_wall),
        cmocka_unit_test(people_touch_beyond_end_of_wall),
        cmocka_unit_test(box_and_person_do_not_touch_through_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
