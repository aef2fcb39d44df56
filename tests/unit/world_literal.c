/* The paper's equations, one by one, in steps of a world in the mode `literal`, against numbers
   that were worked by hand: each is in the comment above its case. Steps are 0.1 s, people have 70
   kg, a radius of 0.2 m, a horizon of 1 s, k = 0.8 and cones of 60 degrees to either side, unless
   said. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/mem.h"
#include "world/world.h"

static const double TOLERANCE = 1e-4;

static void near_to(double value, double wanted) {
    if (!(fabs(value - wanted) <= TOLERANCE * fmax(1.0, fabs(wanted))))
        fail_msg("%.9g is not %.9g", value, wanted);
}

/* A world of `count` people, at first far from each other; bodies and walls may be added before
   begin. */
static JoWorld *make(bool literal, double dt, uint32_t count) {
    JoWorldDef def = jo_default_world_def();
    def.dt = dt;
    def.literal = literal;
    def.gravity = 0.0;
    JoWorld *w = jo_world_create(&def, NULL);
    for (uint32_t i = 0; i < count; i++) {
        JoAgentDef a = jo_default_agent_def();
        a.x = 50.0 + 10.0 * i;
        a.y = 50.0;
        a.horizon = 1.0;
        jo_world_add_agent(w, &a, NULL);
    }
    return w;
}

static uint32_t at(const JoWorld *w, uint32_t id) {
    return jox_agents_find(&w->state.agents, id);
}

static void place(JoWorld *w, uint32_t id, double x, double y, double vx, double vy) {
    JoxAgents *a = &w->state.agents;
    uint32_t i = at(w, id);
    a->x[i] = a->prev_x[i] = (float)x;
    a->y[i] = a->prev_y[i] = (float)y;
    a->vx[i] = (float)vx;
    a->vy[i] = (float)vy;
    jox_nav_invalidate_order(w->scratch.nav);
}

static void want(JoWorld *w, uint32_t id, double x, double y) {
    w->state.agents.pref_x[at(w, id)] = (float)x;
    w->state.agents.pref_y[at(w, id)] = (float)y;
}

static void set(JoWorld *w, uint32_t id, JoxParameter parameter, double value) {
    jox_param_set(&w->state.agents, parameter, at(w, id), jox_parameter_store(parameter, value));
}

static void force(JoWorld *w, uint32_t id, double x, double y) {
    w->state.agents.ext_x[at(w, id)] = (float)x;
    w->state.agents.ext_y[at(w, id)] = (float)y;
}

static void moves(const JoWorld *w, uint32_t id, double vx, double vy) {
    near_to(w->state.agents.vx[at(w, id)], vx);
    near_to(w->state.agents.vy[at(w, id)], vy);
}

/* Checks the force that an agent inherits in the next step from those passed on in this one. */
static void inherits(const JoWorld *w, uint32_t id, double x, double y) {
    near_to(w->state.agents.inferred_x[at(w, id)], x);
    near_to(w->state.agents.inferred_y[at(w, id)], y);
}

/* Two people 0.5 m apart, radii together 0.4: the legs of the velocity obstacle go along (0.6,
   +-0.8). A has (1, 0.25), B the opposite, so v = (2, 0.5) lies within. Foot on the left leg: (2 *
   0.6 + 0.5 * 0.8) (0.6, 0.8) = (0.96, 1.28), u = (-1.04, 0.78), u_hat = (-0.8, 0.6). A's border
   goes through (1, 0.25) + u / 2 = (0.48, 0.64). */
static JoWorld *two_who_would_meet(bool literal, double dt) {
    JoWorld *w = make(literal, dt, 2);
    jo_world_step(w, 1);
    place(w, 0, 0.0, 0.0, 1.0, 0.25);
    place(w, 1, 0.5, 0.0, -1.0, -0.25);
    want(w, 0, 1.0, 0.25);
    want(w, 1, -1.0, -0.25);
    return w;
}

/* (1) And a force of 700 N along y: v_f = (1, 0.25 + 1), so vy >= 1.25. Both half-planes at once:
   -0.8 vx + 0.6 vy >= 0 gives vx <= 0.9375. Their union, of which the text speaks, would allow
   (1, 0.25) itself. */
static void equation_1_permits_what_all_permit(void **state) {
    (void)state;
    JoWorld *w = two_who_would_meet(true, 0.1);
    force(w, 0, 0.0, 700.0);
    jo_world_step(w, 1);
    moves(w, 0, 0.9375, 1.25);
    moves(w, 1, -0.48, -0.64);
    jo_world_free(w);
}

/* (2) Of vy >= 0.5 (350 N from rest) the velocity nearest to a preferred (0.7, -0.3) is (0.7, 0.5);
   to (0.7, 0.9) it is that itself. */
static void equation_2_takes_the_nearest(void **state) {
    (void)state;
    JoWorld *w = make(true, 0.1, 1);
    jo_world_step(w, 1);
    force(w, 0, 0.0, 350.0);
    want(w, 0, 0.7, -0.3);
    jo_world_step(w, 1);
    moves(w, 0, 0.7, 0.5);
    place(w, 0, 0.0, 0.0, 0.0, 0.0);
    w->state.agents.inferred_x[at(w, 0)] = w->state.agents.inferred_y[at(w, 0)] = 0.0f;
    force(w, 0, 0.0, 350.0);
    want(w, 0, 0.7, 0.9);
    jo_world_step(w, 1);
    moves(w, 0, 0.7, 0.9);
    jo_world_free(w);
}

/* (3) Each takes u / 2, as printed, whatever `yield` says; in the physical mode who yields wholly
   goes to v_A + u = (1, 0.25) + (-1.04, 0.78). */
static void equation_3_halves_the_change(void **state) {
    (void)state;
    JoWorld *w = two_who_would_meet(true, 0.1);
    set(w, 0, JOX_PARAM_yield, 1.0);
    jo_world_step(w, 1);
    moves(w, 0, 0.48, 0.64);
    moves(w, 1, -0.48, -0.64);
    jo_world_free(w);
    w = two_who_would_meet(false, 0.05);
    set(w, 0, JOX_PARAM_yield, 1.0);
    jo_world_step(w, 1);
    near_to(w->state.agents.next_x[at(w, 0)],
            -0.04); /* the plan; the velocity follows it with a delay */
    near_to(w->state.agents.next_y[at(w, 0)], 1.03);
    jo_world_free(w);
}

/* (4) A box of 0.4 x 0.2 x 0.4 m: its bounding sphere has the radius sqrt(.04 + .01 + .04) = 0.3,
   and with the person's 0.2 that makes 0.5. At 0.625 m the legs are as above; u = (-0.52, 0.39) is
   taken whole: (1, 0.25) + u = (0.48, 0.64). */
static void equation_4_leaves_all_of_it_to_people(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    for (int within = 0; within < 2; within++) {
        JoWorld *w = make(true, 0.1, 1), *physical = make(false, 0.05, 1);
        JoBodyDef box = jo_default_body_def();
        box.shape = JO_BOX;
        box.size[0] = 0.4, box.size[1] = 0.2, box.size[2] = 0.4;
        box.mass = 0.0;
        box.z = 1.0;
        jo_world_add_body(w, &box, NULL);
        jo_world_add_body(physical, &box, NULL);
        jo_world_step(w, 1);
        jo_world_step(physical, 1);
        if (within) {
            /* At 0.4 m from the middle one stands within the disc, though 0.1 m from the box: out
               of the disc within the step, 0.1 m in 0.1 s. By the footprint nothing need be done.
             */
            place(w, 0, 0.0, -0.4, 0.0, 0.0);
            place(physical, 0, 0.0, -0.4, 0.0, 0.0);
            jo_world_step(w, 1);
            jo_world_step(physical, 1);
            moves(w, 0, 0.0, -1.0);
            moves(physical, 0, 0.0, 0.0);
        } else {
            place(w, 0, -0.625, 0.0, 1.0, 0.25);
            want(w, 0, 1.0, 0.25);
            jo_world_step(w, 1);
            moves(w, 0, 0.48, 0.64);
        }
        jo_world_free(w);
        jo_world_free(physical);
    }
}

/* (4) A wall of 8 m made of 20 blocks of 0.4 x 0.2 x 0.4 m: the sphere of each is that of the box
   above, where one sphere for the whole has a radius of 4 m. From rest, 0.625 m before the middle
   of a block, one may go at 0.125 m in 1 s to the edge of its disc; 0.55 m beyond the middle of the
   last one, outside of all discs, one may stand. */
static void equation_4_takes_the_sphere_of_each_part(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoWorld *w = make(true, 0.1, 2);
    JoxBodyDef wall = jox_body_def();
    wall.shape.kind = JOX_SHAPE_BLOCKS;
    wall.shape.size[0] = 0.4, wall.shape.size[1] = 0.2, wall.shape.size[2] = 0.4;
    wall.shape.count[0] = 20, wall.shape.count[1] = wall.shape.count[2] = 1;
    wall.shape.bond = 1e9;
    wall.position[2] = 1.0;
    assert_int_equal(jox_bodies_add(w->state.bodies, &wall, NULL), 0);
    jo_world_step(w, 1);
    place(w, 0, 0.2, -0.625, 0.0, 0.0);
    want(w, 0, 0.0, 1.0);
    place(w, 1, 4.35, 0.0, 0.0, 0.0);
    jo_world_step(w, 1);
    moves(w, 0, 0.0, 0.125);
    moves(w, 1, 0.0, 0.0);
    jo_world_free(w);
}

/* (5) A walks at (1, 0) and pushes with 100 N. It will be at (0.1, 0); B and C at (0.42, +-0.24)
   are then off by (0.32, +-0.24): of length 0.4, direction (0.8, +-0.6). Each gets 50 N. */
static void equation_5_pushes_from_where_one_will_be(void **state) {
    (void)state;
    JoWorld *w = make(true, 0.1, 3);
    jo_world_step(w, 1);
    place(w, 0, 0.0, 0.0, 1.0, 0.0);
    place(w, 1, 0.42, 0.24, 0.0, 0.0);
    place(w, 2, 0.42, -0.24, 0.0, 0.0);
    want(w, 0, 1.0, 0.0);
    set(w, 0, JOX_PARAM_push, 100.0);
    jo_world_step(w, 1);
    const JoxAgents *a = &w->state.agents;
    near_to(a->push_x[at(w, 1)], 40.0);
    near_to(a->push_y[at(w, 1)], 30.0);
    near_to(a->push_x[at(w, 2)], 40.0);
    near_to(a->push_y[at(w, 2)], -30.0);
    near_to(a->push_x[at(w, 0)], 0.0);
    /* On the next step's own terms, B was moved by 40 N: v_f = 40 / 70 * 0.1 along x at least. */
    assert_true(a->vx[at(w, 1)] > 0.05f);
    jo_world_free(w);
}

/* (6) A (70 kg, 1 m/s), B (35 kg, -0.5 m/s) and C (70 kg, -1 m/s) in a row, each overlapping the
   next, e = 0.2. A and B: 1.2 * 1.5 / (1/70 + 1/35) = 42 N s, 420 N. B and C: 1.2 * 0.5 * 70/3 = 14
   N s, 140 N. Each pair by itself. */
static void equation_6_counts_each_pair_by_itself(void **state) {
    (void)state;
    JoWorld *w = make(true, 0.1, 3);
    jo_world_step(w, 1);
    const double velocity[] = {1.0, -0.5, -1.0};
    for (uint32_t id = 0; id < 3; id++) {
        place(w, id, 0.3 * id, 0.0, velocity[id], 0.0);
        set(w, id, JOX_PARAM_restitution, 0.2);
    }
    set(w, 1, JOX_PARAM_mass, 35.0);
    jo_world_step(w, 1);
    const JoxAgents *a = &w->state.agents;
    near_to(a->contact_x[at(w, 0)], -420.0);
    near_to(a->contact_x[at(w, 1)], 280.0);
    near_to(a->contact_x[at(w, 2)], 140.0);
    jo_world_free(w);
}

/* (7) Against a box of 2 x 1 x 2 m and 40 kg at rest, at (0.8, 0.5) from its middle, at 1.1 m where
   that is at 1: speed 2, so J = 2 / (1/70 + 1/40) = 560/11 N s along -y on the box, whatever
   turning does. Its moment r x J has 0.8 * -J about z, with 40 (4 + 1) / 12 kg m2: -0.048 J rad/s.
   About x it is 0.1 J over the same inertia. */
static void equation_7_turns_the_body_by_the_moment_at_the_point(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoWorld *w = make(true, 0.1, 1);
    JoBodyDef box = jo_default_body_def();
    box.shape = JO_BOX;
    box.size[0] = 2.0, box.size[1] = 1.0, box.size[2] = 2.0;
    box.mass = 40.0;
    box.z = 1.3; /* clear of the ground, which would take part */
    box.friction = 0.0;
    jo_world_add_body(w, &box, NULL);
    jo_world_step(w, 1);
    place(w, 0, 0.8, 0.65, 0.0, -2.0);
    jo_world_step(w, 1);
    double j = 560.0 / 11.0;
    near_to(w->state.agents.contact_y[at(w, 0)], j / 0.1);
    JoxPose pose;
    assert_true(jox_bodies_pose(w->state.bodies, 0, &pose));
    near_to(pose.spin.z, -0.048 * j);
    near_to(pose.velocity.y, -j / 40.0);
    jo_world_free(w);
}

/* (8) From 1 to 0.5 m/s with nobody's force on it: k m dv / dt = 0.8 * 70 * -0.5 / 0.1 = -280 N, to
   the two ahead -140 each: they are pulled back. In the next step -140 N make them go at -0.2. */
static void equation_8_pulls_those_ahead_back(void **state) {
    (void)state;
    JoWorld *w = make(true, 0.1, 4);
    jo_world_step(w, 1);
    place(w, 0, 0.0, 0.0, 1.0, 0.0);
    place(w, 1, 2.4, 0.3, 0.0, 0.0);
    place(w, 2, 2.4, -0.3, 0.0, 0.0);
    place(w, 3, -2.4, 0.0, 0.0, 0.0);
    want(w, 0, 0.5, 0.0);
    jo_world_step(w, 1);
    moves(w, 0, 0.5, 0.0);
    inherits(w, 1, -140.0, 0.0);
    inherits(w, 2, -140.0, 0.0);
    inherits(w, 3, 0.0, 0.0);
    inherits(w, 0, 0.0, 0.0);
    jo_world_step(w, 1);
    moves(w, 1, -0.2, 0.0);
    inherits(w, 0, 0.0, 0.0);
    jo_world_free(w);
}

/* (8) Nobody there: -280 N upon oneself; from 0.5 m/s that makes v_f = 0.1, and v <= 0.1. */
static void equation_8_falls_back_on_oneself(void **state) {
    (void)state;
    JoWorld *w = make(true, 0.1, 1);
    jo_world_step(w, 1);
    place(w, 0, 0.0, 0.0, 1.0, 0.0);
    want(w, 0, 0.5, 0.0);
    jo_world_step(w, 1);
    inherits(w, 0, -280.0, 0.0);
    jo_world_step(w, 1);
    moves(w, 0, 0.1, 0.0);
    jo_world_free(w);
}

/* (8) Its cone is about the old velocity (1, 0). To 0.5 m/s 20 degrees to the left: dv =
   (0.5 cos 20 - 1, 0.5 sin 20) = (-0.530154, 0.171010), against the new direction by a cosine of
   0.789. 560 dv = (-296.886, 95.766) goes to B, 55 degrees to the right of the old and 75 of the
   new velocity; C, 65 to the left of the old and 45 of the new one, gets nothing. */
static void equation_8_has_its_cone_about_the_old_velocity(void **state) {
    (void)state;
    JoWorld *w = make(true, 0.1, 3);
    jo_world_step(w, 1);
    place(w, 0, 0.0, 0.0, 1.0, 0.0);
    place(w, 1, 2.4 * cos(-0.959931), 2.4 * sin(-0.959931), 0.0, 0.0);
    place(w, 2, 2.4 * cos(1.134464), 2.4 * sin(1.134464), 0.0, 0.0);
    want(w, 0, 0.469846, 0.171010);
    jo_world_step(w, 1);
    inherits(w, 1, -296.886, 95.766);
    inherits(w, 2, 0.0, 0.0);
    jo_world_free(w);
}

/* (8) A turn of 90 degrees while slowing from 1 to 0.9: dv = (-1, 0.9) points along the new
   direction (0, 1), not against it: nothing, ahead or upon oneself. Nor from a full stop, whose
   velocity has no direction. */
static void equation_8_wants_the_change_against_the_velocity(void **state) {
    (void)state;
    for (int stop = 0; stop < 2; stop++) {
        JoWorld *w = make(true, 0.1, 2);
        jo_world_step(w, 1);
        place(w, 0, 0.0, 0.0, 1.0, 0.0);
        place(w, 1, 2.4, 0.0, 0.0, 0.0);
        want(w, 0, 0.0, stop ? 0.0 : 0.9);
        jo_world_step(w, 1);
        moves(w, 0, 0.0, stop ? 0.0 : 0.9);
        inherits(w, 0, 0.0, 0.0);
        inherits(w, 1, 0.0, 0.0);
        jo_world_free(w);
    }
}

/* (9) Pushed with 700 N against a wall that it touches: v_f = (1, 0), v = 0, so k m (v - v_f) / dt
   = -560 N, back to whoever is ahead, beyond the wall; with nobody there upon itself. The next step
   takes it to v_f = -0.8. Nothing is passed on for slowing down. */
static void equation_9_has_the_printed_sign(void **state) {
    (void)state;
    for (uint32_t others = 0; others < 2; others++) {
        JoWorld *w = make(true, 0.1, 1 + others);
        const double line[] = {0.2, -30.0, 0.2, 30.0};
        assert_true(jo_world_add_line(w, line, 2, NULL));
        jo_world_step(w, 1);
        place(w, 0, 0.0, 0.0, 0.0, 0.0);
        if (others)
            place(w, 1, 2.4, 0.0, 0.0, 0.0);
        force(w, 0, 700.0, 0.0);
        jo_world_step(w, 1);
        moves(w, 0, 0.0, 0.0);
        inherits(w, others, -560.0, 0.0);
        if (others)
            inherits(w, 0, 0.0, 0.0);
        jo_world_step(w, 1);
        moves(w, others, -0.8, 0.0);
        jo_world_free(w);
    }
}

/* (9) All of v - v_f, also what is beside the force: 700 N along x and a preferred (0, 0.5) give
   v_f = (1, 0), v = (1, 0.5): 560 (0, 0.5) = (0, 280). In the cone about v_f, not about the force:
   from (0, -1) with 700 N along x, v_f = (1, -1) points 45 degrees to the right. */
static void equation_9_passes_on_all_that_v_f_was_missed_by(void **state) {
    (void)state;
    JoWorld *w = make(true, 0.1, 3);
    jo_world_step(w, 1);
    place(w, 0, 0.0, 0.0, 0.0, 0.0);
    place(w, 1, 2.4, 0.0, 0.0, 0.0);
    place(w, 2, 0.0, -2.4, 0.0, 0.0);
    want(w, 0, 0.0, 0.5);
    force(w, 0, 700.0, 0.0);
    jo_world_step(w, 1);
    moves(w, 0, 1.0, 0.5);
    inherits(w, 1, 0.0, 280.0);
    inherits(w, 2, 0.0, 0.0);
    for (uint32_t id = 0; id < 3; id++)
        w->state.agents.inferred_x[at(w, id)] = w->state.agents.inferred_y[at(w, id)] = 0.0f;
    place(w, 0, 0.0, 0.0, 0.0, -1.0);
    place(w, 1, 2.8, 0.0, 0.0, 0.0); /* 45 degrees from v_f, as is the other */
    place(w, 2, 0.0, -2.8, 0.0, 0.0);
    want(w, 0, 1.0, -0.5);
    force(w, 0, 700.0, 0.0);
    jo_world_step(w, 1);
    moves(w, 0, 1.0, -0.5);
    inherits(w, 1, 0.0, 140.0); /* 560 (0, 0.5), in halves */
    inherits(w, 2, 0.0, 140.0);
    jo_world_free(w);
}

/* (10) On B: A's push of 100 N along x, C's contact of 35 N s (70 kg each, 1 m/s, e = 0) from
   ahead, that is -350 N, 70 N from outside along y, and (30, -10) N passed on before: (-220, 60).
 */
static void equation_10_adds_up(void **state) {
    (void)state;
    JoWorld *w = make(true, 0.1, 3);
    jo_world_step(w, 1);
    place(w, 0, -0.45, 0.0, 0.0, 0.0);
    place(w, 1, 0.0, 0.0, 0.0, 0.0);
    place(w, 2, 0.35, 0.0, -1.0, 0.0);
    want(w, 0, 1.0, 0.0);
    set(w, 0, JOX_PARAM_push, 100.0);
    force(w, 1, 0.0, 70.0);
    w->state.agents.inferred_x[at(w, 1)] = 30.0f;
    w->state.agents.inferred_y[at(w, 1)] = -10.0f;
    jo_world_step(w, 1);
    near_to(w->state.agents.force_x[at(w, 1)], -220.0);
    near_to(w->state.agents.force_y[at(w, 1)], 60.0);
    jo_world_free(w);
}

/* (11) 700 N on 70 kg for 0.05 s give 0.5 m/s, three times 1.5: no foot takes any of it. Ten steps
   give 5 m/s, beyond `max_speed`. In the physical mode exp(-0.125) is left of each: 0.5 (1 + .8825
   + .7788) = 1.33065. */
static void equation_11_is_not_damped(void **state) {
    (void)state;
    for (int literal = 0; literal < 2; literal++) {
        JoWorld *w = make(literal, 0.05, 1);
        jo_world_step(w, 1);
        for (int n = 1; n <= 10; n++) {
            force(w, 0, 700.0, 0.0);
            jo_world_step(w, 1);
            if (n == 3)
                moves(w, 0, literal ? 1.5 : 1.33065, 0.0);
        }
        if (literal)
            moves(w, 0, 5.0, 0.0);
        jo_world_free(w);
    }
}

/* (12) From (0.3, 0.1), 500 N along (0.6, 0.8): v_f = (0.3 + 3/7, 0.1 + 4/7), and v_f . f_hat =
   0.26 + 5/7 = 0.974286. A preferred (0.5, 0) has 0.3, so the foot is (0.5, 0) + 0.674286 (0.6,
   0.8) = (0.904571, 0.539429). A preferred (0.7, 0.9) has 1.14 and is free. */
static void equation_12_bounds_along_the_force(void **state) {
    (void)state;
    for (int beyond = 0; beyond < 2; beyond++) {
        JoWorld *w = make(true, 0.1, 1);
        jo_world_step(w, 1);
        place(w, 0, 0.0, 0.0, 0.3, 0.1);
        want(w, 0, beyond ? 0.7 : 0.5, beyond ? 0.9 : 0.0);
        force(w, 0, 300.0, 400.0);
        jo_world_step(w, 1);
        if (beyond)
            moves(w, 0, 0.7, 0.9);
        else
            moves(w, 0, 0.904571, 0.539429);
        jo_world_free(w);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equation_1_permits_what_all_permit),
        cmocka_unit_test(equation_2_takes_the_nearest),
        cmocka_unit_test(equation_3_halves_the_change),
        cmocka_unit_test(equation_4_leaves_all_of_it_to_people),
        cmocka_unit_test(equation_4_takes_the_sphere_of_each_part),
        cmocka_unit_test(equation_5_pushes_from_where_one_will_be),
        cmocka_unit_test(equation_6_counts_each_pair_by_itself),
        cmocka_unit_test(equation_7_turns_the_body_by_the_moment_at_the_point),
        cmocka_unit_test(equation_8_pulls_those_ahead_back),
        cmocka_unit_test(equation_8_falls_back_on_oneself),
        cmocka_unit_test(equation_8_has_its_cone_about_the_old_velocity),
        cmocka_unit_test(equation_8_wants_the_change_against_the_velocity),
        cmocka_unit_test(equation_9_has_the_printed_sign),
        cmocka_unit_test(equation_9_passes_on_all_that_v_f_was_missed_by),
        cmocka_unit_test(equation_10_adds_up),
        cmocka_unit_test(equation_11_is_not_damped),
        cmocka_unit_test(equation_12_bounds_along_the_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
