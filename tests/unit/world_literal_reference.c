/* Steps of random worlds in literal mode against the equations of the paper (paper_equations.h):
   people, walls and bodies of glued blocks, in crowds from sparse to overlapping. What the paper
   does not print is taken from the world: the half-planes of walls, and that walls hide people from
   pushes and contacts. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "base/number/random.h"
#include "nav/orca/solve.h"
#include "paper_equations.h"
#include "world/world.h"

/* ---- random worlds ---- */

static uint64_t draws;

static double draw(double low, double high) {
    return low + (high - low) * jox_random_share(jox_random_mix(++draws));
}

static V draw_vector(double most, double share_of_zeros) {
    const double size = draw(0.0, 1.0) < share_of_zeros ? 0.0 : draw(0.0, most);
    const double angle = draw(-3.14159, 3.14159);
    return (V){size * cos(angle), size * sin(angle)};
}

static uint32_t find_row(const JoWorld *w, uint32_t id) {
    return jox_agents_find(&w->state.agents, id);
}

static void draw_parameters(JoWorld *w, uint32_t id) {
    const struct {
        JoxParameter parameter;
        double low, high;
    } ranges[] = {
        {JOX_PARAM_mass, 35.0, 100.0},       {JOX_PARAM_radius, 0.15, 0.3},
        {JOX_PARAM_restitution, 0.0, 1.0},   {JOX_PARAM_push, -100.0, 200.0},
        {JOX_PARAM_push_angle, 10.0, 120.0}, {JOX_PARAM_push_reach, 0.0, 0.3},
        {JOX_PARAM_absorb, 0.0, 1.0},        {JOX_PARAM_brace_angle, 10.0, 120.0},
        {JOX_PARAM_horizon, 0.3, 3.0},       {JOX_PARAM_perception, 1.0, 4.0},
        {JOX_PARAM_neighbours, 0.0, 16.9},   {JOX_PARAM_max_speed, 1.0, 2.5},
        {JOX_PARAM_yield, 0.0, 1.0},         {JOX_PARAM_brace, 0.0, 400.0},
        {JOX_PARAM_damping, 0.0, 5.0},       {JOX_PARAM_time_gap, 0.0, 2.0},
        {JOX_PARAM_haste, 0.0, 1.0},
    };
    JoxAgents *a = &w->state.agents;
    for (size_t k = 0; k < sizeof ranges / sizeof *ranges; k++) {
        const double value = fmax(0.0, draw(ranges[k].low, ranges[k].high));
        jox_param_set(a, ranges[k].parameter, find_row(w, id),
                      jox_parameter_store(ranges[k].parameter, value));
    }
}

/* Places a person of the world at random, and reads what the equations need. */
static void draw_person(JoWorld *w, Case *c, uint32_t id, double side) {
    JoxAgents *a = &w->state.agents;
    const uint32_t i = find_row(w, id);
    const V velocity = draw_vector(2.0, 0.2), preferred = draw_vector(1.6, 0.1);
    const V external = draw_vector(600.0, 0.7), passed_on = draw_vector(300.0, 0.5);
    draw_parameters(w, id);
    a->x[i] = a->prev_x[i] = (float)draw(0.0, side);
    a->y[i] = a->prev_y[i] = (float)draw(0.0, side);
    a->vx[i] = (float)velocity.x, a->vy[i] = (float)velocity.y;
    a->pref_x[i] = (float)preferred.x, a->pref_y[i] = (float)preferred.y;
    a->ext_x[i] = (float)external.x, a->ext_y[i] = (float)external.y;
    a->inferred_x[i] = (float)passed_on.x, a->inferred_y[i] = (float)passed_on.y;
    c->people[id] = (Person){
        .at = {a->x[i], a->y[i]},
        .velocity = {a->vx[i], a->vy[i]},
        .preferred = {a->pref_x[i], a->pref_y[i]},
        .external = {a->ext_x[i], a->ext_y[i]},
        .passed_on = {a->inferred_x[i], a->inferred_y[i]},
        .mass = jox_param(a, JOX_PARAM_mass, i),
        .radius = jox_param(a, JOX_PARAM_radius, i),
        .restitution = jox_param(a, JOX_PARAM_restitution, i),
        .push = jox_param(a, JOX_PARAM_push, i),
        .push_cosine = jox_param(a, JOX_PARAM_push_angle, i),
        .push_reach = jox_param(a, JOX_PARAM_push_reach, i),
        .absorb = jox_param(a, JOX_PARAM_absorb, i),
        .cone_cosine = jox_param(a, JOX_PARAM_brace_angle, i),
        .horizon = jox_param(a, JOX_PARAM_horizon, i),
        .perception = jox_param(a, JOX_PARAM_perception, i),
        .max_speed = jox_param(a, JOX_PARAM_max_speed, i),
        .neighbours = (uint32_t)jox_param(a, JOX_PARAM_neighbours, i),
    };
}

/* Adds bodies of up to 4 x 2 x 2 glued blocks, too far from each other to collide and tilt; blocks
   one above the other have the same disc. */
static void draw_boxes(JoWorld *w, Case *c, double side) {
    for (uint32_t b = 0; b < c->box_count; b++) {
        JoxBodyDef box = jox_body_def();
        const bool is_static = draw(0.0, 1.0) < 0.5;
        const V velocity = is_static ? (V){0.0, 0.0} : draw_vector(1.0, 0.3);
        const V half = {draw(0.1, 0.75), draw(0.1, 0.75)};
        const double height = draw(1.0, 1.8), turn = draw(-3.0, 3.0);
        const uint32_t layers = 1 + (uint32_t)draw(0.0, 1.99);
        const uint32_t blocks[] = {1 + (uint32_t)draw(0.0, 3.99), 1 + (uint32_t)draw(0.0, 1.99)};
        box.shape.kind = JOX_SHAPE_BLOCKS;
        box.shape.count[0] = blocks[0], box.shape.count[1] = blocks[1], box.shape.count[2] = layers;
        box.shape.size[0] = 2.0 * half.x / blocks[0], box.shape.size[1] = 2.0 * half.y / blocks[1];
        box.shape.size[2] = height / layers;
        box.shape.bond = 1e9;
        box.mass = is_static ? 0.0 : draw(5.0, 200.0);
        box.position[0] = draw(0.0, fmin(side, 2.0)) + 4.0 * b, box.position[1] = draw(0.0, side);
        box.position[2] = 0.5 * height;
        box.turn[2] = sin(0.5 * turn), box.turn[3] = cos(0.5 * turn);
        box.velocity[0] = velocity.x, box.velocity[1] = velocity.y;
        box.spin[2] = is_static ? 0.0 : draw(-1.0, 1.0);
        box.restitution = draw(0.0, 1.0);
        assert_int_equal(jox_bodies_add(w->state.bodies, &box, NULL), b);
        c->part_count += blocks[0] * blocks[1] * layers;
        const double *size = box.shape.size;
        c->boxes[b] =
            (Box){.half = half,
                  .blocks = {blocks[0], blocks[1]},
                  .sphere = 0.5 * sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]),
                  .inverse_mass = is_static ? 0.0 : 1.0 / box.mass,
                  .restitution = box.restitution};
    }
}

/* Reads where the boxes are at the beginning of a step. */
static void read_boxes(const JoWorld *w, Case *c) {
    for (uint32_t b = 0; b < c->box_count; b++) {
        JoxPose pose;
        assert_true(jox_bodies_pose(w->state.bodies, b, &pose));
        c->boxes[b].at = (V){pose.centre.x, pose.centre.y};
        c->boxes[b].velocity = (V){pose.velocity.x, pose.velocity.y};
        c->boxes[b].turn = 2.0 * atan2(pose.turn[2], pose.turn[3]);
        c->boxes[b].spin = pose.spin.z;
    }
}

static void draw_walls(JoWorld *w, Case *c, double side) {
    for (uint32_t k = 0; k < c->wall_count; k++) {
        const double line[] = {draw(0.0, side), draw(0.0, side), draw(0.0, side), draw(0.0, side)};
        assert_true(jo_world_add_line(w, line, 2, NULL));
        c->walls[k] = (Wall){{line[0], line[1]}, {line[2], line[3]}};
    }
}

static JoWorld *make_world(Case *c, double side) {
    JoWorldDef def = jo_default_world_def();
    def.dt = c->dt = 0.1;
    def.literal = true;
    def.gravity = 0.0;
    JoWorld *w = jo_world_create(&def, NULL);
    for (uint32_t i = 0; i < c->person_count; i++) {
        JoAgentDef a = jo_default_agent_def();
        a.x = 100.0 + 10.0 * i;
        a.y = 100.0;
        jo_world_add_agent(w, &a, NULL);
    }
    draw_boxes(w, c, side);
    draw_walls(w, c, side);
    jo_world_step(w, 1);
    read_boxes(w, c);
    for (uint32_t i = 0; i < c->person_count; i++)
        draw_person(w, c, i, side);
    jox_nav_invalidate_order(w->scratch.nav);
    return w;
}

/* ---- comparison ---- */

/* How far steps and equations are apart, over all people of all worlds. */
typedef struct Tally {
    uint32_t people, forced, failed; /* failed: no velocity meets all half-planes */
    uint32_t forces, velocities, passed_on, violations; /* that differ by more than their bounds */
    uint32_t contradictory; /* walls contradict each other; not compared */
} Tally;

static uint32_t list_wall_planes(JoWorld *w, uint32_t id, Plane *planes) {
    JoxNav *nav = w->scratch.nav;
    const JoxAgents *a = &w->state.agents;
    const uint32_t i = find_row(w, id);
    JoxHalfPlane walls[JOX_MOST_WALLS];
    const float tau = jox_param(a, JOX_PARAM_wall_horizon, i);
    const JoxWallShape disc = {.radius = jox_param(a, JOX_PARAM_radius, i)};
    const float range = tau * jox_param(a, JOX_PARAM_max_speed, i) + disc.radius;
    if (!nav->grid.walls || !nav->grid.walls->count)
        return 0;
    jox_wall_grid_fit(&nav->grid, 10.0f);
    const uint32_t count =
        jox_orca_walls(&nav->grid, (JoxV2){a->x[i], a->y[i]}, (JoxV2){a->vx[i], a->vy[i]}, &disc,
                       tau, range, walls, JOX_MOST_WALLS);
    for (uint32_t k = 0; k < count; k++)
        planes[k] = (Plane){{walls[k].normal.x, walls[k].normal.y}, walls[k].offset};
    return count;
}

static V read_pair(const float *x, const float *y, uint32_t row) {
    return (V){x[row], y[row]};
}

static bool is_far(V a, V b, double bound) {
    return length(sub(a, b)) > bound;
}

/* Compares the velocity of person i with that of the equations. Where there are more parts of
   bodies than half-planes for them, it may violate one by 1 cm/s more. */
static void compare_velocity(const Case *c, uint32_t i, V force, V made, Plane *planes,
                             uint32_t hard, Tally *tally) {
    const uint32_t count = list_planes(c, i, force, planes, hard);
    const double speed = is_forced(c, i, force) ? length(find_forced(c, i, force)) : 0.0;
    const Person *own = &c->people[i];
    V best;
    if (!find_velocity(planes, count, hard, fmax(own->max_speed, speed), own->preferred, &best)) {
        tally->contradictory++;
        return;
    }
    const double least = greatest_violation(planes + hard, count - hard, best);
    tally->failed += least > 1e-6;
    const double slack = c->part_count > JOX_MOST_OBJECTS ? 1e-2 : 1e-4; /* m/s */
    tally->violations += greatest_violation(planes + hard, count - hard, made) > least + slack;
    tally->velocities += is_far(made, best, 2e-3);
}

/* Makes a world of a case, steps it once and compares everybody's net force, velocity, and what
   was passed on to them. */
static void compare_world(Case *c, double side, Tally *tally) {
    static Plane planes[MOST_PEOPLE][MOST_PLANES];
    uint32_t hard[MOST_PEOPLE];
    V force[MOST_PEOPLE], passed[MOST_PEOPLE] = {{0.0, 0.0}}, moved[MOST_PEOPLE];
    JoWorld *w = make_world(c, side);
    const JoxAgents *a = &w->state.agents;
    for (uint32_t i = 0; i < c->person_count; i++)
        hard[i] = list_wall_planes(w, i, planes[i]);
    sum_forces(c, force);
    jo_world_step(w, 1);
    for (uint32_t i = 0; i < c->person_count; i++) {
        const uint32_t row = find_row(w, i);
        const V felt = read_pair(a->force_x, a->force_y, row);
        moved[i] = read_pair(a->x, a->y, row);
        tally->people++;
        tally->forced += is_forced(c, i, force[i]);
        tally->forces +=
            is_far(felt, force[i], c->box_count ? 1e-3 + 2e-5 * length(force[i]) : 1e-3);
        compare_velocity(c, i, force[i], read_pair(a->next_x, a->next_y, row), planes[i], hard[i],
                         tally);
    }
    for (uint32_t i = 0; i < c->person_count; i++)
        add_passed(c, i, force[i], read_pair(a->vx, a->vy, find_row(w, i)), moved, passed);
    for (uint32_t i = 0; i < c->person_count; i++) {
        const V got = read_pair(a->inferred_x, a->inferred_y, find_row(w, i));
        tally->passed_on += is_far(got, passed[i], 0.05 + 1e-4 * length(passed[i]));
    }
    jo_world_free(w);
}

/* A quarter each of the worlds has walls, and bodies. Every bound is one of float rounding: of
   forces 1e-3 N (bodies' poses are rounded, too), of velocities 2 mm/s. */
static void steps_are_as_the_equations_say(void **state) {
    (void)state;
    Tally tally = {0};
    for (int k = 0; k < 2000; k++) {
        Case c = {.person_count = 2 + (uint32_t)draw(0.0, MOST_PEOPLE - 2)};
        const bool walls = k % 4 == 1, bodies = k % 4 == 2 && jox_bodies_available();
        c.wall_count = walls ? 1 + (uint32_t)draw(0.0, MOST_WALLS - 0.01) : 0;
        c.box_count = bodies ? 1 + (uint32_t)draw(0.0, MOST_BODIES - 0.01) : 0;
        compare_world(&c, sqrt(c.person_count / draw(0.3, 6.0)), &tally);
    }
    print_message("%u people, %u under force, %u without a permitted velocity; they differ in %u "
                  "forces, %u velocities, %u forces passed on, %u greatest violations\n",
                  tally.people, tally.forced, tally.failed, tally.forces, tally.velocities,
                  tally.passed_on, tally.violations);
    assert_in_range(tally.people, 20000, UINT32_MAX);
    assert_in_range(tally.forced, tally.people / 2, UINT32_MAX);
    assert_in_range(tally.failed, tally.people / 20, UINT32_MAX);
    assert_in_range(tally.forces, 0, tally.people / 2000); /* normals of gaps of 1 mm */
    assert_in_range(tally.velocities, 0, tally.people / 500);
    assert_in_range(tally.passed_on, 0, tally.people / 1000);
    assert_int_equal(tally.violations, 0);
    assert_in_range(tally.contradictory, 0, 20);
}

/* Steps a random world in which a parameter has one value for all; writes the positions by id. */
static void step_with(JoxParameter parameter, double value, uint32_t walls, V *out) {
    Case c = {.person_count = MOST_PEOPLE, .wall_count = walls};
    JoWorld *w = make_world(&c, 2.0);
    const JoxAgents *a = &w->state.agents;
    for (uint32_t i = 0; i < c.person_count; i++)
        jox_param_set(&w->state.agents, parameter, find_row(w, i),
                      jox_parameter_store(parameter, value));
    jo_world_step(w, 20);
    for (uint32_t i = 0; i < c.person_count; i++)
        out[i] = read_pair(a->x, a->y, find_row(w, i));
    jo_world_free(w);
}

static void parameters_that_no_equation_has_change_no_bit(void **state) {
    (void)state;
    static const struct {
        JoxParameter parameter;
        double value;
    } unused[] = {{JOX_PARAM_brace, 400.0},  {JOX_PARAM_damping, 5.0}, {JOX_PARAM_yield, 1.0},
                  {JOX_PARAM_time_gap, 2.0}, {JOX_PARAM_haste, 1.0},   {JOX_PARAM_breadth, 0.7},
                  {JOX_PARAM_depth, 0.2}};
    for (uint32_t k = 0; k < 4 * sizeof unused / sizeof *unused; k++) {
        V without[MOST_PEOPLE], with[MOST_PEOPLE];
        const uint64_t begin = draws;
        step_with(unused[k / 4].parameter, 0.0, k % 4, without);
        draws = begin;
        step_with(unused[k / 4].parameter, unused[k / 4].value, k % 4, with);
        assert_memory_equal(without, with, sizeof with);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_are_as_the_equations_say),
        cmocka_unit_test(parameters_that_no_equation_has_change_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
