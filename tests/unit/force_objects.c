/* Agents against bodies: footprints, momentum, angular momentum, energy, supports. */
#include "geom/objects.h"
#include "unit/force_crowd.h"

/* A box at rest about the origin, 2 by 1 m and 2 m high, its inertia scaled by `thin`. */
static JoxObject make_light_box(float mass, float thin) {
    JoxObject box = {.live = true, .in_band = true, .moves = true};
    box.position.z = 1.0f;
    box.disc = 1.2f;
    box.inverse_mass = 1.0f / mass;
    box.inverse_inertia[0] = 12.0f / (mass * 5.0f * thin);
    box.inverse_inertia[4] = 12.0f / (mass * 8.0f * thin);
    box.inverse_inertia[8] = 12.0f / (mass * 5.0f * thin);
    const JoxV2 ring[] = {{-1, -0.5f}, {1, -0.5f}, {1, 0.5f}, {-1, 0.5f}};
    memcpy(box.footprint, ring, sizeof ring);
    box.footprint_count = 4;
    box.high = 2.0f;
    return box;
}

static void put_bodies(Crowd *c, JoxObjects *objects, JoxObject *rows, uint32_t count) {
    *objects = (JoxObjects){.rows = rows, .count = count, .capacity = count};
    c->step.objects = objects;
}

/* Starts a step once the bodies are laid out. */
static void begin_with(Crowd *c, JoxObjects *objects) {
    jox_objects_lay(objects);
    begin_crowd_step(c);
}

static void close_with(Crowd *c, JoxObjects *objects) {
    jox_objects_free_grid(objects);
    close_crowd(c);
}

static JoxV3 turn_box(const JoxObject *box, const JoxImpulse *impulse) {
    JoxV3 arm = {impulse->point.x - box->position.x, impulse->point.y - box->position.y,
                 impulse->point.z - box->position.z};
    return jox_transform3(box->inverse_inertia, jox_cross3(arm, impulse->impulse));
}

/* Returns the energy after a contact over that before; the box is at rest. */
static double energy_share(bool literal, float mass, float thin, float restitution) {
    Crowd c;
    open_crowd(&c, 0.05);
    if (literal)
        set_literal(&c);
    JoxObject box = make_light_box(mass, thin);
    box.restitution = restitution;
    JoxObjects objects;
    put_bodies(&c, &objects, &box, 1);
    add_agent(&c, 0.8f, 0.65f, 0.3f, -2);
    set_param(&c, 0, JOX_PARAM_restitution, restitution);
    begin_with(&c, &objects);
    jox_force_contact(c.forces);
    uint32_t count;
    const JoxImpulse *pending = jox_force_impulses(c.forces, &count);
    assert_int_equal(count, 1);
    double j = -pending[0].impulse.y;
    assert_true(j > 0 && pending[0].impulse.x == 0 && pending[0].impulse.z == 0);
    /* Equal and opposite, at the point of contact. */
    assert_near(c.agents.contact_y[0] * 0.05, j, 1e-5 * j);
    assert_near(pending[0].point.x, 0.8, 1e-6);
    assert_near(pending[0].point.y, 0.5, 1e-6);
    assert_near(pending[0].point.z, 1.1, 1e-6);
    assert_int_equal(c.agents.contacts[0], 1);
    JoxV3 spin = turn_box(&box, &pending[0]);
    double vy = -2 + j / 70, by = -j / mass;
    /* Angular momentum about the vertical through the origin, where the box is, is kept. */
    double before = 70 * 0.8 * -2, after = 70 * 0.8 * vy + spin.z / box.inverse_inertia[8];
    assert_near(after, before, 1e-3 * fabs(before));
    double rotation = 0;
    const float w[3] = {spin.x, spin.y, spin.z};
    for (int k = 0; k < 3; k++)
        rotation += w[k] * w[k] / box.inverse_inertia[4 * k];
    if (!literal) { /* restitution reverses the relative velocity at the point */
        double point = by + spin.z * 0.8 - spin.x * 0.1;
        assert_near(vy - point, 2 * restitution, 1e-4);
    }
    close_with(&c, &objects);
    return (70 * vy * vy + mass * by * by + rotation) / (70 * 4);
}

static void energy_never_grows_off_centre(void **state) {
    (void)state;
    const float masses[] = {5, 40, 400}, thins[] = {1, 0.1f}, bounces[] = {0, 0.5f, 1};
    for (int m = 0; m < 3; m++)
        for (int t = 0; t < 2; t++)
            for (int b = 0; b < 3; b++)
                assert_true(energy_share(false, masses[m], thins[t], bounces[b]) < 1.0001);
    assert_near(energy_share(false, 40, 1, 1), 1.0, 1e-4);
}

static void as_printed_energy_grows(void **state) {
    (void)state;
    assert_true(energy_share(true, 40, 0.1f, 0) > 1.1);
    assert_true(energy_share(true, 40, 1, 1) > 1.1);
}

static void footprints_have_sides_corners_and_insides(void **state) {
    (void)state;
    const struct {
        JoxV2 at;
        bool hit;
        JoxV2 normal;
    } cases[] = {
        {{0, 0.65f}, true, {0, 1}},   {{0, -0.65f}, true, {0, -1}},
        {{1.15f, 0}, true, {1, 0}},   {{0, 0.71f}, false, {0, 0}},
        {{1.1f, 0.6f}, true, {1, 1}}, {{1.15f, 0.65f}, false, {0, 0}},
        {{0.9f, 0}, true, {1, 0}},    {{0.2f, -0.4f}, true, {0, -1}},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        Crowd c;
        open_crowd(&c, 0.05);
        JoxObject box = make_light_box(40, 1);
        JoxObjects objects;
        put_bodies(&c, &objects, &box, 1);
        add_agent(&c, cases[k].at.x, cases[k].at.y, -cases[k].normal.x, -cases[k].normal.y);
        begin_with(&c, &objects);
        jox_force_contact(c.forces);
        JoxV2 f = jox_unit(jox_v2(c.agents.contact_x[0], c.agents.contact_y[0]));
        JoxV2 wanted = jox_unit(cases[k].normal);
        assert_int_equal(c.agents.contacts[0], cases[k].hit);
        assert_near(f.x, wanted.x, 1e-5);
        assert_near(f.y, wanted.y, 1e-5);
        close_with(&c, &objects);
    }
}

static void a_ball_and_the_height_of_contact(void **state) {
    (void)state;
    Crowd c;
    open_crowd(&c, 0.05);
    JoxObject balls[3] = {make_light_box(1, 1), make_light_box(1, 1), make_light_box(1, 1)};
    JoxObjects objects;
    put_bodies(&c, &objects, balls, 3);
    for (int k = 0; k < 3; k++) {
        balls[k].footprint_count = 0;
        balls[k].round = 0.3f;
        balls[k].position = (JoxV3){4.0f * (float)k, 0, 0.3f};
        balls[k].velocity.x = 10;
        balls[k].low = 0;
        balls[k].high = 0.6f;
        add_agent(&c, 4.0f * (float)k + 0.45f, 0, 0, 0);
    }
    balls[1].in_band = false;
    balls[2].live = false;
    begin_with(&c, &objects);
    jox_force_contact(c.forces);
    uint32_t count;
    const JoxImpulse *pending = jox_force_impulses(c.forces, &count);
    assert_int_equal(count, 1);
    assert_true(pending[0].impulse.x < 0 && c.agents.contact_x[0] > 0);
    assert_near(pending[0].point.z, 0.6, 1e-6);
    assert_near(pending[0].point.x, 0.3, 1e-6);
    assert_true(c.agents.contact_x[1] == 0 && c.agents.contact_x[2] == 0);
    close_with(&c, &objects);
}

static void agents_on_one_body_are_solved_together(void **state) {
    (void)state;
    /* Four agents walk into a light box together: solved together, none is thrown back, and
       momentum is kept. Independent impulses would send the box off at several times their
       speed. */
    Crowd c;
    open_crowd(&c, 0.05);
    JoxForceOptions options = jox_force_default_options();
    options.iterations = 200;
    jox_forces_set_options(c.forces, &options);
    JoxObject box = make_light_box(10, 1);
    JoxObjects objects;
    put_bodies(&c, &objects, &box, 1);
    for (int k = 0; k < 4; k++)
        add_agent(&c, -0.75f + 0.5f * (float)k, -0.65f, 0, 1);
    begin_with(&c, &objects);
    jox_force_contact(c.forces);
    uint32_t count;
    const JoxImpulse *pending = jox_force_impulses(c.forces, &count);
    assert_int_equal(count, 4);
    double sum = 0, given = 0;
    for (uint32_t k = 0; k < 4; k++) {
        sum += pending[k].impulse.y;
        given += c.agents.contact_y[k] * 0.05;
        assert_near(pending[k].point.x, -0.75 + 0.5 * k, 1e-6); /* in ascending id */
        assert_true(1 + c.agents.contact_y[k] * 0.05 / 70 > 0.5);
    }
    assert_near(sum, -given, 1e-5 * sum);
    assert_true(sum / 10 > 0.5 && sum / 10 < 1.001);
    close_with(&c, &objects);
}

static void the_nearest_bodies_are_touched_and_pushed(void **state) {
    (void)state;
    /* Nine balls within reach of one agent, the farthest in the first row. */
    Crowd c;
    open_crowd(&c, 0.05);
    JoxObject balls[9];
    for (int k = 0; k < 9; k++) {
        float away = 0.29f - 0.01f * (float)k, angle = 0.1f * (float)(k - 4);
        balls[k] = make_light_box(1, 1);
        balls[k].footprint_count = 0;
        balls[k].disc = balls[k].round = 0.1f;
        balls[k].position = (JoxV3){away * cosf(angle), away * sinf(angle), 1.0f};
        balls[k].velocity.x = -1;
    }
    balls[8].position.x *= -1; /* the nearest one is behind the agent */
    JoxObjects objects;
    put_bodies(&c, &objects, balls, 9);
    add_agent(&c, 0, 0, 0, 0);
    set_param(&c, 0, JOX_PARAM_push, 100);
    c.agents.pref_x[0] = 1;
    begin_with(&c, &objects);
    jox_force_push(c.forces);
    uint32_t count;
    const JoxImpulse *pending = jox_force_impulses(c.forces, &count);
    assert_int_equal(count, 4);
    for (uint32_t k = 0; k < 4; k++)
        assert_int_equal(pending[k].object, 4 + k);
    begin_with(&c, &objects);
    jox_force_contact(c.forces);
    pending = jox_force_impulses(c.forces, &count);
    uint32_t hit = 0;
    for (uint32_t k = 0; k < count; k++)
        hit |= 1u << pending[k].object;
    assert_int_equal(hit & 0xe0, 0xe0); /* the nearest of the approaching ones */
    assert_true(c.agents.contacts[0] >= 4);
    close_with(&c, &objects);
}

static void static_bodies_stop_people_and_receive_nothing(void **state) {
    (void)state;
    Crowd c;
    open_crowd(&c, 0.05);
    JoxObject box = make_light_box(40, 1);
    box.inverse_mass = 0;
    memset(box.inverse_inertia, 0, sizeof box.inverse_inertia);
    JoxObjects objects;
    put_bodies(&c, &objects, &box, 1);
    add_agent(&c, 0.8f, 0.65f, 0, -2);
    begin_with(&c, &objects);
    jox_force_contact(c.forces);
    uint32_t count;
    jox_force_impulses(c.forces, &count);
    assert_int_equal(count, 0);
    assert_near(c.agents.contact_y[0] * 0.05, 140, 1e-3);
    close_with(&c, &objects);
}

/* Makes contacts at four points of a face of the box: the far side from the agents, or the
   bottom. */
static void stand_at(JoxObjectContact out[4], bool ground, float friction) {
    for (int k = 0; k < 4; k++) {
        float x = k & 1 ? 1.0f : -1.0f, other = k & 2 ? 1.0f : -1.0f;
        out[k] = (JoxObjectContact){.second = JOX_NO_OBJECT, .friction = friction};
        out[k].point = ground ? (JoxV3){x, 0.5f * other, 0} : (JoxV3){x, -0.5f, 1 + other};
        out[k].normal = ground ? (JoxV3){0, 0, 1} : (JoxV3){0, 1, 0};
    }
}

/* An agent walks at 2 m/s into the middle of the 40 kg box's long side. Returns the impulse on the
   box. */
static JoxImpulse walk_into(const JoxObjectContact *contacts, uint32_t count, float gravity) {
    Crowd c;
    open_crowd(&c, 0.05);
    JoxObject box = make_light_box(40, 1);
    JoxObjects objects;
    put_bodies(&c, &objects, &box, 1);
    objects.contacts = (JoxObjectContacts){contacts, count};
    objects.gravity = gravity;
    add_agent(&c, 0, 0.69f, 0, -2);
    begin_with(&c, &objects);
    jox_force_contact(c.forces);
    uint32_t given;
    JoxImpulse impulse = jox_force_impulses(c.forces, &given)[0];
    assert_int_equal(given, 1);
    assert_near(c.agents.contact_y[0] * 0.05, -impulse.impulse.y, 1e-3);
    close_with(&c, &objects);
    return impulse;
}

static void supports_are_felt_at_once(void **state) {
    (void)state;
    JoxObjectContact contacts[8];
    JoxImpulse free = walk_into(NULL, 0, 0);
    /* 1.1 m up is 0.1 m above the middle: inverse mass 1/40 + 0.1^2 12 / 200. */
    assert_near(-free.impulse.y, 2 / (1 / 70.0 + 1 / 40.0 + 0.01 * 12 / 200), 0.01);
    assert_near(free.lasting, 0, 1e-5);
    /* At a wall the box stops the agent, and all that it gives lasts as long as it presses. */
    stand_at(contacts, false, 0);
    JoxImpulse wall = walk_into(contacts, 4, 0);
    assert_near(-wall.impulse.y, 140, 0.7);
    assert_near(wall.lasting, 1, 0.01);
    /* On the ground, which presses with 40 kg times 200 m/s2 times 0.05 s, 400 N s, friction of 0.5
       takes all of it. */
    stand_at(contacts, true, 0.5f);
    JoxImpulse rough = walk_into(contacts, 4, 200.0f);
    assert_near(-rough.impulse.y, 140, 0.7);
    /* Friction takes its limit, 0.1 times 19.62 N s; 70 and 40 kg share the rest, 140 - 1.962. */
    stand_at(contacts, true, 0.1f);
    JoxImpulse slips = walk_into(contacts, 4, 9.81f);
    assert_true(-slips.impulse.y > -free.impulse.y + 0.5);
    assert_near(-slips.impulse.y, 140 - 70 * (140 - 1.962) / 110, 0.5);
    double free_gain = 1 / 40.0 + 0.01 * 12 / 200; /* share held, by work, of a body free to turn */
    assert_near(slips.lasting, 1 - 1.2549 / (52.16 * free_gain), 0.005);
    /* A wall that is out of reach within the step changes nothing. */
    stand_at(contacts, false, 0);
    for (int k = 0; k < 4; k++)
        contacts[k].gap = 0.2f;
    assert_near(walk_into(contacts, 4, 0).impulse.y, free.impulse.y, 1e-3);
}

static void bodies_are_pushed_where_they_are_touched(void **state) {
    (void)state;
    Crowd c;
    open_crowd(&c, 0.05);
    JoxObject box = make_light_box(40, 1);
    box.tags = 2;
    JoxObjects objects;
    put_bodies(&c, &objects, &box, 1);
    add_agent(&c, 0.8f, -0.75f, 0, 0); /* a gap of 5 cm */
    add_agent(&c, 0.0f, -0.85f, 0, 0); /* a gap of 15 cm */
    for (uint32_t i = 0; i < 2; i++) {
        set_param(&c, i, JOX_PARAM_push, 200);
        c.agents.pref_y[i] = 1;
    }
    begin_with(&c, &objects);
    jox_force_push(c.forces);
    jox_force_contact(c.forces);
    uint32_t count;
    const JoxImpulse *pending = jox_force_impulses(c.forces, &count);
    assert_int_equal(count, 1);
    assert_near(pending[0].impulse.y, 10, 1e-5);
    assert_near(pending[0].impulse.x, 0, 1e-5);
    assert_near(pending[0].point.x, 0.8, 1e-6);
    assert_true(c.agents.contact_y[0] == 0);
    c.agents.push_only[0] = 1; /* the box has another tag */
    begin_with(&c, &objects);
    jox_force_push(c.forces);
    jox_force_impulses(c.forces, &count);
    assert_int_equal(count, 0);
    close_with(&c, &objects);
}

static void a_printed_push_aims_at_the_middle(void **state) {
    (void)state;
    /* From (0.8, -0.75), for an agent that walks at (0, 1) and will be at (0.8, -0.7): the centre
       of the box is (-0.8, 0.7) off, sqrt(1.13) m. 200 N for 0.05 s are 10 N s. */
    Crowd c;
    open_crowd(&c, 0.05);
    set_literal(&c);
    JoxObject box = make_light_box(40, 1);
    JoxObjects objects;
    put_bodies(&c, &objects, &box, 1);
    add_agent(&c, 0.8f, -0.75f, 0, 1);
    set_param(&c, 0, JOX_PARAM_push, 200);
    c.agents.pref_y[0] = 1;
    begin_with(&c, &objects);
    jox_force_push(c.forces);
    uint32_t count;
    const JoxImpulse *pending = jox_force_impulses(c.forces, &count);
    assert_int_equal(count, 1);
    assert_near(pending[0].impulse.x, -10 * 0.8 / sqrt(1.13), 1e-4);
    assert_near(pending[0].impulse.y, 10 * 0.7 / sqrt(1.13), 1e-4);
    assert_near(pending[0].point.x, 0.8, 1e-6);
    close_with(&c, &objects);
}

static void far_and_broken_bodies_are_skipped(void **state) {
    (void)state;
    Crowd c;
    open_crowd(&c, 0.05);
    JoxObject boxes[4] = {make_light_box(40, 1), make_light_box(40, 1), make_light_box(40, 1),
                          make_light_box(40, 1)};
    for (int k = 0; k < 4; k++)
        boxes[0].footprint[k].x = NAN;
    for (int k = 0; k < 4; k++)
        boxes[1].footprint[k].y += 1e30f;
    for (int k = 0; k < 4; k++)
        boxes[2].footprint[k].x += 9e5f; /* far, yet within the grid */
    JoxObjects objects;
    put_bodies(&c, &objects, boxes, 4);
    add_agent(&c, 0.8f, 0.65f, 0, -2);
    add_agent(&c, -1e9f, NAN, 0, -2);
    begin_with(&c, &objects);
    jox_force_push(c.forces);
    jox_force_contact(c.forces);
    jox_force_sum(c.forces);
    jox_force_infer(c.forces);
    uint32_t count;
    const JoxImpulse *pending = jox_force_impulses(c.forces, &count);
    assert_int_equal(count, 1);
    assert_int_equal(pending[0].object, 3);
    close_with(&c, &objects);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energy_never_grows_off_centre),
        cmocka_unit_test(as_printed_energy_grows),
        cmocka_unit_test(footprints_have_sides_corners_and_insides),
        cmocka_unit_test(a_ball_and_the_height_of_contact),
        cmocka_unit_test(agents_on_one_body_are_solved_together),
        cmocka_unit_test(the_nearest_bodies_are_touched_and_pushed),
        cmocka_unit_test(static_bodies_stop_people_and_receive_nothing),
        cmocka_unit_test(supports_are_felt_at_once),
        cmocka_unit_test(bodies_are_pushed_where_they_are_touched),
        cmocka_unit_test(a_printed_push_aims_at_the_middle),
        cmocka_unit_test(far_and_broken_bodies_are_skipped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
