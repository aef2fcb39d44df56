/* Driven bodies stop at their force limits: what presses on one that stands is that force, and it
   goes on when people give way. */
#include "unit/world_meeting.h"

#include "agents/torso.h"

/* A lane along x, closed by a wall at x = 6 m, with people before the wall, and a piston that fills
   the lane and comes from x = -1 m. */
typedef struct Lane {
    JoWorld *world;
    JoBody piston;
    double dt;
} Lane;

static Lane make_lane(double width, uint32_t columns, uint32_t rows, JoBodyDef piston) {
    Lane lane = {.world = create_world(), .dt = jo_default_world_def().dt};
    const double half = width / 2;
    const double walls[] = {-3, half, 6, half, 6, -half, -3, -half};
    add_wall(lane.world, walls, 4);
    for (uint32_t n = 0; n < columns * rows; n++)
        add_person(lane.world, 5.75 - 0.45 * (n / rows), (n % rows + 0.5) * (width / rows) - half,
                   jo_default_agent_def().push);
    piston.size[0] = 0.5;
    piston.size[1] = width - 0.1;
    piston.size[2] = 2;
    piston.x = -1;
    piston.z = 1;
    piston.kinematic = true;
    lane.piston = add_body(lane.world, &piston);
    return lane;
}

static JoBodyDef pushing(double speed, double limit) {
    JoBodyDef piston = jo_default_body_def();
    piston.vx = speed;
    piston.force_limit = limit;
    return piston;
}

static double load_of(const Lane *lane) {
    double impulse[3];
    assert_true(jo_body_pushed(lane->world, lane->piston, impulse, NULL));
    return -impulse[0] / lane->dt;
}

static double place_of(const Lane *lane) {
    return jo_body_state(lane->world, lane->piston).x;
}

static const double DEEPEST = 0.02; /* m */

/* Returns the greatest overlap of two torsos, m. */
static double overlap_in(const JoWorld *world) {
    const JoxAgents *a = &world->state.agents;
    float most = 0.0f;
    for (uint32_t i = 0; i < a->count; i++)
        for (uint32_t j = 0; j < i; j++)
            most = fmaxf(most, -jox_torso_gap(a, i, j));
    return (double)most;
}

/* Steps until the piston has stood for 2 s; checks then for 3 s what it presses with. */
static void presses_with(const char *what, Lane lane, double force) {
    double last = place_of(&lane), least = INFINITY, most = 0, deepest = 0;
    int stood = 0, steps = 0;
    for (; stood * lane.dt < 2 && steps < 2000; steps++) {
        jo_world_step(lane.world, 1);
        stood = fabs(place_of(&lane) - last) < 1e-3 ? stood + 1 : 0;
        last = place_of(&lane);
    }
    assert_true(steps < 2000);
    for (int n = 0; n * lane.dt < 3; n++) {
        jo_world_step(lane.world, 1);
        least = fmin(least, load_of(&lane));
        most = fmax(most, load_of(&lane));
        deepest = fmax(deepest, overlap_in(lane.world));
    }
    print_message("  %s: %.0f to %.0f N of %.0f N, at %.2f m, overlap %.4f m\n", what, least, most,
                  force, place_of(&lane), deepest);
    assert_true(least > 0.9 * force && most < 1.1 * force);
    assert_true(deepest < DEEPEST);
    const JoxDriveStatistics *told = &lane.world->state.statistics.drives;
    assert_true(told->held_up > 0 && told->inside == 0);
    assert_float_equal(told->force, force, 0.01 * force);
    jo_world_free(lane.world);
}

static void blocked_piston_presses_with_its_limit(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    presses_with("a row", make_lane(0.5, 5, 1, pushing(0.3, 800)), 800);
    presses_with("a crowd", make_lane(3, 8, 6, pushing(0.3, 3000)), 3000);
    presses_with("a crowd, fast", make_lane(3, 8, 6, pushing(3, 3000)), 3000);
    presses_with("a crowd, by default", make_lane(3, 8, 6, pushing(0.5, JOX_DRIVE_FORCE)),
                 JOX_DRIVE_FORCE);
}

static void piston_goes_on_when_people_give_way(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    Lane lane = make_lane(0.5, 5, 1, pushing(0.3, 800));
    jo_world_step(lane.world, 600);
    const double stood = place_of(&lane);
    assert_float_equal(jo_body_state(lane.world, lane.piston).vx, 0, 1e-3);
    JoAgent people[5];
    const uint32_t count = jo_world_agents(lane.world, people, 5);
    for (uint32_t n = 0; n < count; n++)
        jo_world_remove_agent(lane.world, people[n]);
    jo_world_step(lane.world, 40);
    assert_float_equal(place_of(&lane), stood + 0.3 * 40 * lane.dt, 0.02);
    assert_float_equal(jo_body_state(lane.world, lane.piston).vx, 0.3, 1e-6);
    jo_world_free(lane.world);
}

/* A path is followed from where it was left: what is lost is not made up for. */
static void blocked_path_ends_later_by_the_time_lost(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    const double points[] = {5, 0, 1};
    JoBodyDef piston = jo_default_body_def();
    piston.force_limit = 800;
    piston.path = (JoPath){.points = points, .count = 1, .speed = 0.5};
    Lane lane = make_lane(0.5, 5, 1, piston);
    jo_world_step(lane.world, 800);
    const double stood = place_of(&lane);
    assert_true(stood < 4.5);
    JoAgent people[5];
    const uint32_t count = jo_world_agents(lane.world, people, 5);
    for (uint32_t n = 0; n < count; n++)
        jo_world_remove_agent(lane.world, people[n]);
    jo_world_step(lane.world, 20);
    assert_float_equal(place_of(&lane), stood + 0.5 * 20 * lane.dt, 0.03);
    jo_world_step(lane.world, 200);
    assert_float_equal(place_of(&lane), 5, 1e-3);
    jo_world_free(lane.world);
}

static void world_ends_at_a_limit_and_names_agent(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoBodyDef piston = pushing(0.3, 800);
    piston.ends_world = true;
    Lane lane = make_lane(0.5, 5, 1, piston);
    jo_world_step(lane.world, 800);
    const char *failure = jo_world_failure(lane.world);
    assert_non_null(failure);
    print_message("  %s\n", failure);
    assert_non_null(strstr(failure, "presses 1 person with 800 N, its limit"));
    assert_non_null(strstr(failure, "agent 4 bears most of it, 800 N"));
    jo_world_free(lane.world);
}

/* A bar that turns presses with its limit, too. */
static void turning_bar_stops_at_its_limit(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoError error = {0};
    JoWorld *world = create_world();
    const double niche[] = {0.75, 0.6, 0.75, 1, 1.25, 1, 1.25, 0.6};
    add_wall(world, niche, 4);
    const JoAgent person = add_person(world, 1, 0.78, jo_default_agent_def().push);
    JoBodyDef bar = jo_default_body_def();
    bar.size[0] = 4;
    bar.size[1] = 0.2;
    bar.kinematic = true;
    bar.force_limit = 500;
    const JoBody body = add_body(world, &bar);
    const double still[3] = {0}, spin[3] = {0, 0, 0.3};
    assert_true(jo_body_set_velocity(world, body, still, spin, &error));
    double most = 0;
    for (int n = 0; n < 200; n++) {
        jo_world_step(world, 1);
        most = fmax(most, jo_agent_state(world, person).load);
    }
    const JoAgentState p = jo_agent_state(world, person);
    print_message("  at (%.2f, %.2f) m, most %.0f N\n", p.x, p.y, most);
    assert_true(most > 450 && most < 700);
    assert_true(p.x > 0.75 && p.x < 1.25 && p.y < 1);
    assert_true(world->state.statistics.drives.inside == 0);
    jo_world_free(world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocked_piston_presses_with_its_limit),
        cmocka_unit_test(piston_goes_on_when_people_give_way),
        cmocka_unit_test(blocked_path_ends_later_by_the_time_lost),
        cmocka_unit_test(world_ends_at_a_limit_and_names_agent),
        cmocka_unit_test(turning_bar_stops_at_its_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
