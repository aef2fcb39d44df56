/* Bodies: impulses off the centre, bounces, walls, inertia, footprints, the kill plane, equal runs.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "body/body.h"
#include "body/footprint.h"

static void skip_without_bullet(void) {
    if (!jox_bodies_available())
        skip();
}

static JoxBodies *create_bodies_in_free_space(void) { /* no gravity, no ground */
    JoxBodiesDef def = jox_bodies_def();
    def.gravity = 0.0;
    def.ground = false;
    return jox_bodies_create(&def);
}

static JoxBodyDef make_sphere_def(double radius, double mass, double x, double y, double z) {
    JoxBodyDef def = jox_body_def();
    def.shape.kind = JOX_SHAPE_SPHERE;
    def.shape.size[0] = radius;
    def.mass = mass;
    def.position[0] = x, def.position[1] = y, def.position[2] = z;
    return def;
}

static uint32_t add_shape_test_body(JoxBodies *bodies, const JoxBodyDef *def) {
    JoxText why = {0};
    uint32_t row = jox_bodies_add(bodies, def, &why);
    if (row == JOX_NO_BODY)
        fail_msg("%s", why.data);
    jox_text_free(&why);
    return row;
}

static JoxPose get_shape_test_pose(const JoxBodies *bodies, uint32_t row) {
    JoxPose pose;
    assert_true(jox_bodies_pose(bodies, row, &pose));
    return pose;
}

static void expect_close_to(double got, double want, double tolerance) {
    if (!(fabs(got - want) <= tolerance))
        fail_msg("got %g, wanted %g +- %g", got, want, tolerance);
}

static void off_centre_impulse_moves_and_turns(void **state) {
    (void)state;
    skip_without_bullet();
    JoxBodies *bodies = create_bodies_in_free_space();
    JoxBodyDef def = jox_body_def();
    def.shape.kind = JOX_SHAPE_BOX;
    memcpy(def.shape.size, (double[]){2, 1, 0.5}, sizeof def.shape.size);
    def.mass = 12.0;
    uint32_t row = add_shape_test_body(bodies, &def);
    JoxPose before = get_shape_test_pose(bodies, row);
    double about_z = 12.0 * (2 * 2 + 1 * 1) / 12.0; /* inertia of a box: m (a2 + b2) / 12 */
    expect_close_to(before.inertia.z, about_z, 0.02 * about_z);
    JoxImpulse push = {
        row, {0, 6, 0}, {(float)before.centre.x + 0.8f, before.centre.y, before.centre.z}, 0};
    jox_bodies_impulses(bodies, &push, 1);
    JoxPose after = get_shape_test_pose(bodies, row);
    expect_close_to(after.velocity.y, 6.0 / 12.0, 1e-4);
    expect_close_to(after.spin.z, 0.8 * 6.0 / about_z, 0.02);
    jox_bodies_free(bodies);
}

static void each_shape_has_its_mass_and_inertia(void **state) {
    (void)state;
    skip_without_bullet();
    JoxBodies *bodies = create_bodies_in_free_space();
    JoxBodyDef def = make_sphere_def(0.5, 10, 0, 0, 0);
    expect_close_to(get_shape_test_pose(bodies, add_shape_test_body(bodies, &def)).inertia.x,
                    0.4 * 10 * 0.25, 0.02);
    def = jox_body_def();
    def.shape.kind = JOX_SHAPE_CYLINDER;
    def.shape.size[0] = 0.5, def.shape.size[1] = 1.0;
    def.mass = 8.0;
    def.position[0] = 5;
    JoxPose pose = get_shape_test_pose(bodies, add_shape_test_body(bodies, &def));
    expect_close_to(pose.inertia.z, 0.5 * 8 * 0.25, 0.05);
    const double cube[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    def = jox_body_def();
    def.shape.kind = JOX_SHAPE_HULL;
    def.shape.points = cube;
    def.shape.point_count = 8;
    def.mass = 0.0;
    def.density = 6.0;
    def.position[0] = 10;
    pose = get_shape_test_pose(bodies, add_shape_test_body(bodies, &def));
    expect_close_to(pose.mass, 6.0, 0.2); /* volume 1 m3 */
    expect_close_to(pose.centre.x, 10.5, 0.02);
    expect_close_to(pose.centre.z, 0.5, 0.02);
    JoxBodyPart parts[2] = {{.mass = 3.0, .position = {0, 0, 0}},
                            {.mass = 1.0, .position = {4, 0, 0}}};
    for (int i = 0; i < 2; i++) {
        parts[i].shape.kind = JOX_SHAPE_SPHERE;
        parts[i].shape.size[0] = 0.1;
    }
    def = jox_body_def();
    def.shape.kind = JOX_SHAPE_COMPOUND;
    def.shape.parts = parts;
    def.shape.part_count = 2;
    def.mass = 0.0;
    def.position[0] = 20;
    pose = get_shape_test_pose(bodies, add_shape_test_body(bodies, &def));
    expect_close_to(pose.mass, 4.0, 1e-4);
    expect_close_to(pose.centre.x, 21.0, 1e-3); /* the common centre of mass */
    expect_close_to(pose.position.x, 20.0, 1e-3);
    double most = fmax(pose.inertia.x, fmax(pose.inertia.y, pose.inertia.z));
    expect_close_to(most, 3.0 * 1 + 1.0 * 9 + 0.4 * 4 * 0.01, 0.05);
    jox_bodies_free(bodies);
}

static void ball_bounces_off_walls(void **state) {
    (void)state;
    skip_without_bullet();
    for (int speed = 5; speed <= 40; speed += 35) {
        JoxBodies *bodies = create_bodies_in_free_space();
        JoxWalls walls = {0};
        const JoxV2 line[] = {{3, -5}, {3, 5}};
        jox_walls_add_polyline(&walls, line, 2, false, 3);
        jox_bodies_set_walls(bodies, &walls, 3);
        JoxBodyDef def = make_sphere_def(0.11, 0.4, 0, 0, 1);
        def.restitution = 0.7;
        def.velocity[0] = speed;
        uint32_t row = add_shape_test_body(bodies, &def);
        for (int i = 0; i < 30; i++) {
            jox_bodies_step(bodies, 0.05f, NULL, 0);
            assert_true(get_shape_test_pose(bodies, row).centre.x < 3.0f);
        }
        expect_close_to(get_shape_test_pose(bodies, row).velocity.x, -0.7 * speed, 0.15 * speed);
        jox_bodies_free(bodies);
        jox_walls_free(&walls);
    }
}

/* Counts at how many of 40 speeds a cube of 4 cm passes through a plate of 2 cm. */
static uint32_t count_passed_plates(const JoxShape *cube) {
    uint32_t passed = 0;
    for (int speed = 1; speed <= 40; speed++) {
        JoxBodies *bodies = create_bodies_in_free_space();
        JoxBodyDef plate = jox_body_def(), chip = make_sphere_def(0.02, 0.05, 0, 0, 1);
        plate.still = true;
        plate.shape.size[0] = 0.02;
        plate.shape.size[1] = plate.shape.size[2] = 2;
        plate.position[0] = 1, plate.position[2] = 1;
        add_shape_test_body(bodies, &plate);
        chip.shape = *cube;
        chip.velocity[0] = speed;
        const uint32_t row = add_shape_test_body(bodies, &chip);
        for (int i = 0; i < 40; i++)
            jox_bodies_step(bodies, 0.05f, NULL, 0);
        passed += get_shape_test_pose(bodies, row).centre.x > 1.0f;
        jox_bodies_free(bodies);
    }
    return passed;
}

static void small_hull_passes_no_more_plates_than_a_box(void **state) {
    (void)state;
    skip_without_bullet();
    JoxShape box = {.kind = JOX_SHAPE_BOX, .size = {0.04, 0.04, 0.04}};
    double corners[24];
    for (int k = 0; k < 24; k++)
        corners[k] = k / 3 >> k % 3 & 1 ? 0.02 : -0.02;
    JoxShape hull = {.kind = JOX_SHAPE_HULL, .points = corners, .point_count = 8};
    assert_true(count_passed_plates(&hull) <= count_passed_plates(&box));
}

static void footprints_follow_the_shape(void **state) {
    (void)state;
    skip_without_bullet();
    JoxBodies *bodies = create_bodies_in_free_space();
    JoxBodyDef def = jox_body_def();
    def.shape.kind = JOX_SHAPE_BOX;
    memcpy(def.shape.size, (double[]){2, 1, 1}, sizeof def.shape.size);
    def.position[2] = 0.5;
    def.turn[2] = sin(0.5 * 3.14159265 / 2); /* a quarter turn about z */
    def.turn[3] = cos(0.5 * 3.14159265 / 2);
    uint32_t box = add_shape_test_body(bodies, &def);
    def = make_sphere_def(0.3, 1, 5, 5, 0.3);
    uint32_t ball = add_shape_test_body(bodies, &def);
    def = make_sphere_def(0.3, 1, 9, 9, 5.0);
    uint32_t high = add_shape_test_body(bodies, &def);
    JoxObjects objects = {0};
    jox_bodies_objects(bodies, &objects);
    const JoxObject *o = &objects.rows[box];
    assert_true(o->live && o->in_band && o->moves && o->footprint_count >= 4);
    for (uint32_t i = 0; i < o->footprint_count; i++) {
        expect_close_to(fabs(o->footprint[i].x), 0.5, 0.01); /* the long side is along y */
        expect_close_to(fabs(o->footprint[i].y), 1.0, 0.01);
    }
    assert_int_equal(objects.rows[ball].footprint_count, 0);
    expect_close_to(objects.rows[ball].round, 0.3, 0.01);
    assert_false(objects.rows[high].in_band);
    jox_bodies_free(bodies);
}

static bool has_footprint_corner(const JoxObject *o, float x, float y) {
    for (uint32_t i = 0; i < o->footprint_count; i++)
        if (fabsf(o->footprint[i].x - x) < 1e-3f && fabsf(o->footprint[i].y - y) < 1e-3f)
            return true;
    return false;
}

/* The upper and lower corners of an almost upright box, seen from above, are within a millionth
   of a metre of each other, in either order of x: no corner is lost. */
static void tiny_tilt_keeps_all_footprint_corners(void **state) {
    (void)state;
    const uint32_t no_edges[2] = {0};
    for (uint32_t order = 0; order < 256; order++) {
        JoxV3 corners[8];
        for (uint32_t k = 0; k < 8; k++)
            corners[k] = (JoxV3){(k & 1 ? 0.2f : -0.2f) + 1e-6f * (float)(order >> k / 2 * 2 & 3),
                                 k & 2 ? 0.3f : -0.3f, k & 4 ? 1.2f : 0.2f};
        JoxFootprint footprint = {0};
        JoxObject o = {0};
        jox_footprint_begin(&footprint);
        jox_footprint_add(&footprint, corners, 8, no_edges, 0);
        jox_footprint_end(&footprint, &o);
        for (uint32_t k = 0; k < 4; k++)
            assert_true(has_footprint_corner(&o, k & 1 ? 0.2f : -0.2f, k & 2 ? 0.3f : -0.3f));
        jox_footprint_free(&footprint);
    }
}

/* Random corners, few and many: all lie within the ring, which turns left throughout. */
static void footprint_ring_encloses_all_corners(void **state) {
    (void)state;
    const uint32_t no_edges[2] = {0};
    JoxFootprint footprint = {0};
    for (uint32_t count = 3; count < 200; count++) {
        JoxV3 corners[200];
        JoxObject o = {0};
        for (uint32_t k = 0; k < count;
             k++) /* some share x; some lie on an ellipse, others within */
            corners[k] = (JoxV3){floorf(8.0f * cosf((float)k)), sinf((float)(k * k)) * 3.0f, 1.0f};
        corners[0].z = 0.5f;
        jox_footprint_begin(&footprint);
        jox_footprint_add(&footprint, corners, count, no_edges, 0);
        jox_footprint_end(&footprint, &o);
        assert_in_range(o.footprint_count, 3, JOX_FOOTPRINT_POINTS);
        for (uint32_t i = 0; i < o.footprint_count; i++) {
            const JoxV2 a = o.footprint[i], b = o.footprint[(i + 1) % o.footprint_count];
            for (uint32_t k = 0; k < count; k++) {
                const JoxV2 p = {corners[k].x, corners[k].y};
                assert_true(jox_det(jox_sub(b, a), jox_sub(p, a)) >
                            -0.5f); /* m2: tolerance for removed corners */
            }
        }
    }
    jox_footprint_free(&footprint);
}

static void body_below_kill_height_is_removed(void **state) {
    (void)state;
    skip_without_bullet();
    JoxBodiesDef world = jox_bodies_def();
    world.ground = false;
    JoxBodies *bodies = jox_bodies_create(&world);
    JoxBodyDef def = make_sphere_def(0.2, 1, 0, 0, 0);
    add_shape_test_body(bodies, &def);
    uint32_t gone = 0;
    for (int i = 0; i < 100 && gone == 0; i++) {
        JoxBodiesReport report = jox_bodies_step(bodies, 0.05f, NULL, 0);
        gone = report.gone_count;
        if (gone)
            assert_int_equal(report.gone[0].why, JOX_BODY_FELL);
    }
    assert_int_equal(gone, 1);
    assert_int_equal(jox_bodies_count(bodies), 0);
    jox_bodies_free(bodies);
}

static uint64_t hash_after_run(double offset) {
    JoxBodiesDef world = jox_bodies_def();
    JoxBodies *bodies = jox_bodies_create(&world);
    for (int i = 0; i < 12; i++) {
        JoxBodyDef def =
            i % 2 ? make_sphere_def(0.2, 2, 0.1 * i, 0, 0.5 + 0.5 * i) : jox_body_def();
        def.position[0] = 0.1 * i + offset;
        def.position[2] = 0.5 + 1.1 * i;
        add_shape_test_body(bodies, &def);
    }
    for (int i = 0; i < 100; i++)
        jox_bodies_step(bodies, 0.05f, NULL, 0);
    JoxHash hash = jox_hash_begin();
    jox_bodies_hash(bodies, &hash);
    jox_bodies_free(bodies);
    return jox_hash_end(&hash);
}

static void equal_runs_have_equal_hashes(void **state) {
    (void)state;
    skip_without_bullet();
    uint64_t first = hash_after_run(0.0);
    assert_true(first == hash_after_run(0.0));
    assert_true(first != hash_after_run(0.01));
}

/* A needle has a volume, but rounding loses its smallest moment of inertia beside the others: it
   cannot turn, so it must be static. */
static void needle_must_be_static(void **state) {
    (void)state;
    skip_without_bullet();
    static const double NEEDLE[] = {6.96,  3.48, 0.696, 0.08,  0.08, 0.024, 0.16, 0.12,
                                    0.032, 0.08, 0.08,  0.024, 0.32, 0.2,   0.048};
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxBodyDef d = jox_body_def();
    JoxText why = {0};
    d.shape.kind = JOX_SHAPE_HULL;
    d.shape.points = NEEDLE;
    d.shape.point_count = 5;
    assert_int_equal(jox_bodies_add(b, &d, &why), JOX_NO_BODY);
    assert_non_null(strstr(why.data, "too thin"));
    d.still = true;
    assert_int_not_equal(jox_bodies_add(b, &d, NULL), JOX_NO_BODY);
    jox_text_free(&why);
    jox_bodies_free(b);
}

static void static_bodies_stay_and_impulses_are_clamped(void **state) {
    (void)state;
    skip_without_bullet();
    JoxBodies *bodies = create_bodies_in_free_space();
    JoxBodyDef def = jox_body_def();
    def.still = true;
    uint32_t row = add_shape_test_body(bodies, &def);
    def = make_sphere_def(0.2, 1, 5, 0, 0);
    uint32_t ball = add_shape_test_body(bodies, &def);
    JoxImpulse pushes[] = {{row, {1e6f, 0, 0}, {0, 0, 0}, 0},
                           {ball, {1e9f, 0, 0}, {5, 0, 0}, 0},
                           {ball, {NAN, 0, 0}, {5, 0, 0}, 0},
                           {12345, {1, 0, 0}, {0, 0, 0}, 0}};
    assert_int_equal(jox_bodies_impulses(bodies, pushes, 4), 4);
    assert_true(get_shape_test_pose(bodies, row).velocity.x == 0.0f);
    expect_close_to(get_shape_test_pose(bodies, ball).velocity.x, jox_bodies_def().most_change,
                    1.0);
    jox_bodies_step(bodies, 0.05f, NULL, 0);
    expect_close_to(get_shape_test_pose(bodies, row).centre.x, 0.0, 1e-6);
    jox_bodies_free(bodies);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(off_centre_impulse_moves_and_turns),
        cmocka_unit_test(each_shape_has_its_mass_and_inertia),
        cmocka_unit_test(ball_bounces_off_walls),
        cmocka_unit_test(small_hull_passes_no_more_plates_than_a_box),
        cmocka_unit_test(footprints_follow_the_shape),
        cmocka_unit_test(tiny_tilt_keeps_all_footprint_corners),
        cmocka_unit_test(footprint_ring_encloses_all_corners),
        cmocka_unit_test(body_below_kill_height_is_removed),
        cmocka_unit_test(equal_runs_have_equal_hashes),
        cmocka_unit_test(needle_must_be_static),
        cmocka_unit_test(static_bodies_stay_and_impulses_are_clamped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
