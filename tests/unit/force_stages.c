/* The stages of force over columns: which agents they reach, what they write, and that the order
   never matters. */
#include "unit/force_crowd.h"

static void push_is_shared_by_agents_ahead(void **state) {
    (void)state;
    Crowd c;
    open_crowd(&c, 0.05);
    add_agent(&c, 0, 0, 0, 0);
    add_agent(&c, 0.45f, 0.1f, 0, 0);
    add_agent(&c, 0.45f, -0.1f, 0, 0);
    add_agent(&c, -0.45f, 0, 0, 0); /* behind */
    add_agent(&c, 0.8f, 0, 0, 0);   /* out of reach */
    set_param(&c, 0, JOX_PARAM_push, 100);
    c.agents.pref_x[0] = 1;
    begin_crowd_step(&c);
    jox_force_push(c.forces);
    const float *x = c.agents.push_x, *y = c.agents.push_y;
    assert_near(hypotf(x[1], y[1]), 50, 1e-3);
    assert_true(x[1] > 40 && y[1] > 0 && x[2] == x[1] && y[2] == -y[1]);
    assert_true(x[0] == 0 && x[3] == 0 && x[4] == 0);
    JoxForceTotals totals = jox_force_totals(c.forces);
    assert_int_equal(totals.pushers, 1);
    assert_near(totals.ground_x, (x[1] + x[2]) * 0.05, 1e-4);
    jox_force_contact(c.forces); /* the pushed agents and the pusher bear it */
    assert_true(c.agents.compression[1] > 50 / (6.283185 * 0.2)); /* they overlap too */
    assert_near(c.agents.load[0], 2 * 50 * 0.45 / hypot(0.45, 0.1), 1e-2);

    uint8_t nearest[5] = {1, 1, 1, 1, 1}, off[5 + JOX_AGENTS_PADDING] = {0};
    c.in.push_nearest = nearest;
    begin_crowd_step(&c);
    jox_force_push(c.forces);
    assert_near(hypotf(x[1], y[1]), 100, 1e-3); /* the lesser id of two equally near ones */
    assert_true(x[2] == 0);
    c.in.push_on = off;
    begin_crowd_step(&c);
    jox_force_push(c.forces);
    assert_true(x[1] == 0 && jox_force_totals(c.forces).pushers == 0);
    close_crowd(&c);
}

static void pushes_keep_to_tags_and_may_react(void **state) {
    (void)state;
    Crowd c;
    open_crowd(&c, 0.05);
    add_agent(&c, 0, 0, 0, 0);
    add_agent(&c, 0.45f, 0, 0, 0);
    add_agent(&c, 0, 0.45f, 0, 0);
    set_param(&c, 0, JOX_PARAM_push, 80);
    set_param(&c, 0, JOX_PARAM_push_angle, 180);
    c.agents.push_only[0] = 4;
    c.agents.tags[2] = 6;
    float toward_x[3 + JOX_AGENTS_PADDING] = {1}, toward_y[3 + JOX_AGENTS_PADDING] = {0};
    c.in.push_toward_x = toward_x;
    c.in.push_toward_y = toward_y;
    JoxForceOptions options = jox_force_default_options();
    options.react = true;
    jox_forces_set_options(c.forces, &options);
    begin_crowd_step(&c);
    jox_force_push(c.forces);
    assert_true(c.agents.push_x[1] == 0 && c.agents.push_y[2] == 80);
    assert_true(c.agents.push_y[0] == -80 && jox_force_totals(c.forces).ground_y == 0);
    close_crowd(&c);
}

static void a_printed_push_reverses_at_speed(void **state) {
    (void)state;
    Crowd c;
    open_crowd(&c, 0.3);
    add_agent(&c, 0, 0, 2, 0);
    add_agent(&c, 0.45f, 0, 0, 0);
    set_param(&c, 0, JOX_PARAM_push, 80);
    c.agents.pref_x[0] = 1;
    begin_crowd_step(&c);
    jox_force_push(c.forces);
    assert_true(c.agents.push_x[1] == 80);
    set_literal(&c);
    begin_crowd_step(&c);
    jox_force_push(c.forces);
    assert_true(c.agents.push_x[1] == -80);
    close_crowd(&c);
}

static void two_agents_that_meet_stop(void **state) {
    (void)state;
    for (int literal = 0; literal < 2; literal++) {
        Crowd c;
        open_crowd(&c, 0.05);
        if (literal)
            set_literal(&c);
        add_agent(&c, 0, 0, 1, 0);
        add_agent(&c, 0.3f, 0, -1, 0);
        add_agent(&c, 5, 0, 1, 0); /* no agent near */
        set_param(&c, 1, JOX_PARAM_mass, 35);
        begin_crowd_step(&c);
        jox_force_contact(c.forces);
        double j = 2.0 / (1 / 70.0 + 1 / 35.0);
        assert_near(c.agents.contact_x[0] * 0.05, -j, 1e-3);
        assert_true(c.agents.contact_x[1] == -c.agents.contact_x[0]);
        assert_near(c.agents.compression[0], j / 0.05 / (6.283185 * 0.2), 1e-2);
        assert_int_equal(c.agents.contacts[0], 1);
        assert_true(c.agents.contact_x[2] == 0 && c.agents.contacts[2] == 0);
        c.agents.vx[0] = -1; /* moves apart */
        c.agents.vx[1] = 1;
        begin_crowd_step(&c);
        jox_force_contact(c.forces);
        assert_true(c.agents.contact_x[0] == 0 && c.agents.contacts[0] == 1);
        close_crowd(&c);
    }
}

static void a_row_is_hit_as_one(void **state) {
    (void)state;
    /* One agent runs into a packed row of four at rest: solved together, all move off at a fifth of
       its speed. Independent pairs would only involve the first two. */
    Crowd c;
    open_crowd(&c, 0.05);
    JoxForceOptions options = jox_force_default_options();
    options.iterations = 400;
    jox_forces_set_options(c.forces, &options);
    for (int i = 0; i < 5; i++)
        add_agent(&c, 0.39f * (float)i, 0, i == 0 ? 2.0f : 0.0f, 0);
    begin_crowd_step(&c);
    jox_force_contact(c.forces);
    double sum = 0;
    for (int i = 0; i < 5; i++) {
        double dv = c.agents.contact_x[i] * 0.05 / 70;
        sum += dv;
        assert_near(c.agents.vx[i] + dv, 0.4, 0.01);
    }
    assert_near(sum, 0, 1e-5);
    /* Agents in the middle feel both sides: little net force, much compression. */
    assert_true(c.agents.compression[1] * 6.283185 * 0.2 > 2 * fabsf(c.agents.contact_x[1]));
    set_literal(&c);
    begin_crowd_step(&c);
    jox_force_contact(c.forces);
    assert_true(c.agents.contact_x[2] == 0 && c.agents.contact_x[1] > 0);
    close_crowd(&c);
}

static void the_plane_asks_for_the_forced_velocity(void **state) {
    (void)state;
    Crowd c;
    open_crowd(&c, 0.1);
    add_agent(&c, 0, 0, 1, 0);
    add_agent(&c, 5, 0, 1, 0);
    add_agent(&c, 9, 0, 1, 0);
    JoxAgents *a = &c.agents;
    begin_crowd_step(&c);
    a->ext_y[0] = 70;          /* 1 m/s2 */
    a->ext_y[1] = 70 * 0.049f; /* too little to count */
    a->contact_x[2] = 70 * 30; /* 3 m/s in a step */
    jox_force_sum(c.forces);
    assert_true(a->half_plane_x[0] == 0 && a->half_plane_y[0] == 1);
    assert_near(a->half_plane_offset[0], 0.1, 1e-6);
    assert_true(a->half_plane_x[1] == 0 && a->half_plane_y[1] == 0);
    assert_near(a->half_plane_offset[2], exp(-0.25) + 3, 1e-5);
    assert_true(a->speed_limit[0] == jox_param(a, JOX_PARAM_max_speed, 0));
    assert_near(a->speed_limit[2], 1 + 3, 1e-5);
    a->ext_x[2] = a->contact_x[2]; /* by other means the speed is capped */
    a->contact_x[2] = 0;
    jox_force_sum(c.forces);
    assert_true(a->speed_limit[2] == jox_param(a, JOX_PARAM_max_speed, 2));
    close_crowd(&c);
}

static void bracing_and_slowing_agents_pass_forces_on(void **state) {
    (void)state;
    Crowd c;
    open_crowd(&c, 0.05);
    add_agent(&c, 0, 0, 0, 0);
    add_agent(&c, 0.5f, 0, 0, 0);
    add_agent(&c, -0.5f, 0, 0, 0);
    add_agent(&c, 9, 9, 2, 0); /* no agent near */
    JoxAgents *a = &c.agents;
    a->pref_x[3] = 1;           /* it wants to walk on */
    add_agent(&c, -9, 9, 2, 0); /* no agent near, and it wants to stand */
    double share = 0.05 / 0.13;
    begin_crowd_step(&c);
    a->ext_x[0] = 700;
    jox_force_sum(c.forces);
    a->vx[3] = a->vx[4] = 1;
    jox_force_infer(c.forces); /* agent 0 did not move: its shortfall is 0.5 m/s */
    assert_near(a->inferred_x[1], share * 0.8 * 700, 0.1);
    assert_true(a->inferred_x[2] == 0 && a->inferred_x[0] == 0);
    assert_near(a->inferred_x[3], share * 0.8 * 70 * 1 / 0.05, 0.1);
    assert_true(a->inferred_x[4] == 0);
    assert_int_equal(jox_force_totals(c.forces).passed, 2);
    /* The rest arrives later, to the same impulse. */
    double sum = a->inferred_x[1] * 0.05;
    a->ext_x[0] = 0;
    for (int i = 0; i < 200; i++) {
        a->inferred_x[0] = a->inferred_x[2] = a->inferred_x[3] = 0;
        for (int k = 0; k < 4; k++)
            a->vx[k] = 0;
        begin_crowd_step(&c);
        jox_force_sum(c.forces);
        a->vx[1] = 100; /* it moves on: no shortfall */
        jox_force_infer(c.forces);
        sum += a->inferred_x[1] * 0.05;
    }
    assert_near(sum, 0.8 * 700 * 0.05, 1e-2);
    assert_true(a->inferred_x[1] == 0); /* fades to zero, not to denormal numbers */
    close_crowd(&c);
}

static void printed_deceleration_pulls_back(void **state) {
    (void)state;
    for (int literal = 0; literal < 2; literal++) {
        Crowd c;
        open_crowd(&c, 0.05);
        if (literal)
            set_literal(&c);
        add_agent(&c, 0, 0, 2, 0);
        add_agent(&c, 0.6f, 0, 0, 0);
        begin_crowd_step(&c);
        jox_force_sum(c.forces);
        c.agents.vx[0] = 0.5f;
        jox_force_infer(c.forces);
        double wanted = 0.8 * 70 * 1.5 / 0.05;
        if (literal)
            assert_near(c.agents.inferred_x[1], -wanted, 0.1);
        else
            assert_near(c.agents.inferred_x[1], wanted * (0.05 / 0.13), 0.1);
        assert_true(c.agents.inferred_x[0] == 0);
        close_crowd(&c);
    }
}

/* An agent changes its velocity from (1, 0) to (x, y). Returns the force along x, N, on the agent
   ahead, or on itself if alone. */
static double measure_thrown(bool literal, bool alone, float x, float y) {
    Crowd c;
    open_crowd(&c, 0.05);
    if (literal)
        set_literal(&c);
    add_agent(&c, 0, 0, 1, 0);
    c.agents.pref_x[0] = alone ? 1.0f : 0.0f; /* an agent that wants to stand is not carried on */
    if (!alone)
        add_agent(&c, 0.6f, 0, 0, 0);
    begin_crowd_step(&c);
    jox_force_sum(c.forces);
    c.agents.vx[0] = x;
    c.agents.vy[0] = y;
    jox_force_infer(c.forces);
    double force = c.agents.inferred_x[alone ? 0 : 1];
    assert_true(alone || c.agents.inferred_x[0] == 0);
    close_crowd(&c);
    return force;
}

static void turning_passes_nothing_on(void **state) {
    (void)state;
    double share = 0.05 / 0.13, whole = 0.8 * 70 / 0.05; /* for a change of 1 m/s */
    for (int alone = 0; alone < 2; alone++) {
        /* By 90 degrees, from 1 to 0.9. */
        assert_true(measure_thrown(false, alone, 0, 0.9f) == 0 &&
                    measure_thrown(true, alone, 0, 0.9f) == 0);
        assert_true(measure_thrown(false, alone, 0, -0.9f) == 0 &&
                    measure_thrown(true, alone, 0, -0.9f) == 0);
        /* By 20 degrees, from 1 to 0.5: slowing. */
        assert_near(measure_thrown(false, alone, 0.469846f, 0.171010f), whole * 0.530154 * share,
                    0.1);
        assert_near(measure_thrown(true, alone, 0.469846f, 0.171010f), -whole * 0.530154, 0.1);
    }
    /* After a full stop the printed angle has no direction to refer to. */
    assert_near(measure_thrown(false, false, 0, 0), whole * share, 0.1);
    assert_true(measure_thrown(true, false, 0, 0) == 0);
}

enum { MANY = 700, STEPS = 6 };

static void fill_force_crowd(Crowd *c) {
    open_crowd(c, 0.05);
    for (uint32_t i = 0; i < MANY; i++) {
        float u[4];
        for (uint32_t k = 0; k < 4; k++)
            u[k] = (float)jox_random_unit(7, i, 0, JOX_DRAW_FILL, k);
        add_agent(c, u[0] * 9, u[1] * 9, u[2] * 3 - 1.5f, u[3] * 3 - 1.5f);
        c->agents.pref_x[i] = u[2] - 0.5f;
        c->agents.pref_y[i] = u[3] - 0.5f;
        set_param(c, i, JOX_PARAM_push, i % 3 ? 0 : 150);
        set_param(c, i, JOX_PARAM_mass, 40 + i % 60);
        set_param(c, i, JOX_PARAM_perception, 0.3 + u[0]); /* perception is not always mutual */
    }
}

/* Runs a few steps with a crude solve; `shuffle` reorders the agents before each. */
static void advance_forces(Crowd *c, bool shuffle) {
    JoxAgents *a = &c->agents;
    for (uint32_t s = 0; s < STEPS; s++) {
        uint32_t order[MANY];
        for (uint32_t i = 0; i < MANY; i++)
            order[i] = (i * 11 + s * 5) % MANY;
        if (shuffle)
            jox_agents_permute(a, order, (uint64_t[MANY]){0});
        begin_crowd_step(c);
        jox_force_push(c->forces);
        jox_force_contact(c->forces);
        jox_force_sum(c->forces);
        for (uint32_t i = 0; i < MANY; i++) {
            a->vx[i] = a->vx[i] * 0.8f + a->force_x[i] * 0.0002f;
            a->vy[i] = a->vy[i] * 0.8f + a->force_y[i] * 0.0002f;
            a->x[i] += a->vx[i] * 0.05f;
            a->y[i] += a->vy[i] * 0.05f;
        }
        jox_force_infer(c->forces);
    }
}

static void assert_same_forces(const Crowd *c, const Crowd *d) {
    for (uint32_t id = 0; id < MANY; id++) {
        uint32_t i = jox_agents_find(&c->agents, id), k = jox_agents_find(&d->agents, id);
        const float left[] = {c->agents.x[i],          c->agents.vy[i],
                              c->agents.force_x[i],    c->agents.contact_y[i],
                              c->agents.inferred_x[i], c->agents.compression[i],
                              c->agents.push_x[i],     c->agents.half_plane_offset[i]};
        const float right[] = {d->agents.x[k],          d->agents.vy[k],
                               d->agents.force_x[k],    d->agents.contact_y[k],
                               d->agents.inferred_x[k], d->agents.compression[k],
                               d->agents.push_x[k],     d->agents.half_plane_offset[k]};
        assert_memory_equal(left, right, sizeof left);
        assert_true(isfinite(left[0]) && isfinite(left[2]) && isfinite(left[4]));
    }
    JoxForceTotals t = jox_force_totals(c->forces), u = jox_force_totals(d->forces);
    assert_true(t.pairs == u.pairs && t.ground_x == u.ground_x && t.passed == u.passed);
    assert_true(t.pairs > 100 && t.passed > 100 && t.pushers > 10);
}

static void order_and_threads_change_no_bit(void **state) {
    (void)state;
    for (int literal = 0; literal < 2; literal++) {
        Crowd crowds[4]; /* unchanged; shuffled; on two threads; on four threads and shuffled */
        for (uint32_t k = 0; k < 4; k++) {
            fill_force_crowd(&crowds[k]);
            if (literal)
                set_literal(&crowds[k]);
            crowds[k].step.pool = k < 2 ? NULL : jox_pool_create(k == 2 ? 2 : 4);
            advance_forces(&crowds[k], k % 2);
            assert_same_forces(&crowds[0], &crowds[k]);
        }
        for (uint32_t k = 0; k < 4; k++) {
            jox_pool_free(crowds[k].step.pool);
            close_crowd(&crowds[k]);
        }
    }
}

static void contacts_keep_momentum(void **state) {
    (void)state;
    Crowd c;
    fill_force_crowd(&c);
    begin_crowd_step(&c);
    jox_force_contact(c.forces);
    double x = 0, y = 0, size = 0, before = 0, after = 0;
    for (uint32_t i = 0; i < MANY; i++) {
        JoxAgents *a = &c.agents;
        double m = jox_param(a, JOX_PARAM_mass, i);
        double vx = a->vx[i] + a->contact_x[i] * 0.05 / m;
        double vy = a->vy[i] + a->contact_y[i] * 0.05 / m;
        x += a->contact_x[i];
        y += a->contact_y[i];
        size += fabs(a->contact_x[i]);
        before += m * (a->vx[i] * a->vx[i] + a->vy[i] * a->vy[i]);
        after += m * (vx * vx + vy * vy);
    }
    assert_true(size > 0 && fabs(x) < 1e-5 * size && fabs(y) < 1e-5 * size);
    assert_true(after < before);
    close_crowd(&c);
}

static void steady_forces_allocate_nothing(void **state) {
    (void)state;
    Crowd c;
    fill_force_crowd(&c);
    advance_forces(&c, false);
    uint64_t allocations = jox_alloc_count();
    begin_crowd_step(&c);
    jox_force_push(c.forces);
    jox_force_contact(c.forces);
    jox_force_sum(c.forces);
    jox_force_infer(c.forces);
    assert_int_equal(jox_alloc_count(), allocations);
    close_crowd(&c);
}

static void extremes_stay_finite(void **state) {
    (void)state;
    Crowd c;
    open_crowd(&c, 0.05);
    begin_crowd_step(&c); /* an empty crowd */
    jox_force_push(c.forces);
    jox_force_contact(c.forces);
    jox_force_sum(c.forces);
    jox_force_infer(c.forces);
    for (int i = 0; i < 20; i++) { /* twenty at the same point */
        add_agent(&c, 1, 1, i % 2 ? 3.0f : -3.0f, 0);
        c.agents.pref_x[i] = 1;
        set_param(&c, (uint32_t)i, JOX_PARAM_push, 1e9);
    }
    for (int s = 0; s < 3; s++) {
        begin_crowd_step(&c);
        jox_force_push(c.forces);
        jox_force_contact(c.forces);
        jox_force_sum(c.forces);
        jox_force_infer(c.forces);
    }
    for (int i = 0; i < 20; i++) {
        assert_true(isfinite(c.agents.force_x[i]) && isfinite(c.agents.half_plane_offset[i]));
        assert_true(isfinite(c.agents.inferred_x[i]) && isfinite(c.agents.speed_limit[i]));
    }
    close_crowd(&c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(push_is_shared_by_agents_ahead),
        cmocka_unit_test(pushes_keep_to_tags_and_may_react),
        cmocka_unit_test(a_printed_push_reverses_at_speed),
        cmocka_unit_test(two_agents_that_meet_stop),
        cmocka_unit_test(a_row_is_hit_as_one),
        cmocka_unit_test(the_plane_asks_for_the_forced_velocity),
        cmocka_unit_test(bracing_and_slowing_agents_pass_forces_on),
        cmocka_unit_test(printed_deceleration_pulls_back),
        cmocka_unit_test(turning_passes_nothing_on),
        cmocka_unit_test(order_and_threads_change_no_bit),
        cmocka_unit_test(contacts_keep_momentum),
        cmocka_unit_test(steady_forces_allocate_nothing),
        cmocka_unit_test(extremes_stay_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
