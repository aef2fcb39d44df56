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

static void need_bullet(void) {
    if (!jox_bodies_available())
        skip();
}

static JoxBodies *space(void) { /* no gravity, no ground */
    JoxBodiesDef def = jox_bodies_def();
    def.gravity = 0.0;
    def.ground = false;
    return jox_bodies_create(&def);
}

static JoxBodyDef sphere(double radius, double mass, double x, double y, double z) {
    JoxBodyDef def = jox_body_def();
    def.shape.kind = JOX_SHAPE_SPHERE;
    def.shape.size[0] = radius;
    def.mass = mass;
    def.position[0] = x, def.position[1] = y, def.position[2] = z;
    return def;
}

static uint32_t add(JoxBodies *bodies, const JoxBodyDef *def) {
    JoxText why = {0};
    uint32_t row = jox_bodies_add(bodies, def, &why);
    if (row == JOX_NO_BODY)
        fail_msg("%s", why.data);
    jox_text_free(&why);
    return row;
}

static JoxPose pose_of(const JoxBodies *bodies, uint32_t row) {
    JoxPose pose;
    assert_true(jox_bodies_pose(bodies, row, &pose));
    return pose;
}

static void near_to(double got, double want, double tolerance) {
    if (!(fabs(got - want) <= tolerance))
        fail_msg("got %g, wanted %g +- %g", got, want, tolerance);
}

static void an_impulse_off_the_centre_moves_and_turns(void **state) {
    (void)state;
    need_bullet();
    JoxBodies *bodies = space();
    JoxBodyDef def = jox_body_def();
    def.shape.kind = JOX_SHAPE_BOX;
    memcpy(def.shape.size, (double[]){2, 1, 0.5}, sizeof def.shape.size);
    def.mass = 12.0;
    uint32_t row = add(bodies, &def);
    JoxPose before = pose_of(bodies, row);
    double about_z = 12.0 * (2 * 2 + 1 * 1) / 12.0; /* m (a2 + b2) / 12 */
    near_to(before.inertia.z, about_z, 0.02 * about_z);
    JoxImpulse push = {
        row, {0, 6, 0}, {(float)before.centre.x + 0.8f, before.centre.y, before.centre.z}, 0};
    jox_bodies_impulses(bodies, &push, 1);
    JoxPose after = pose_of(bodies, row);
    near_to(after.velocity.y, 6.0 / 12.0, 1e-4);
    near_to(after.spin.z, 0.8 * 6.0 / about_z, 0.02);
    jox_bodies_free(bodies);
}

static void inertia_and_mass_of_the_shapes(void **state) {
    (void)state;
    need_bullet();
    JoxBodies *bodies = space();
    JoxBodyDef def = sphere(0.5, 10, 0, 0, 0);
    near_to(pose_of(bodies, add(bodies, &def)).inertia.x, 0.4 * 10 * 0.25, 0.02);
    def = jox_body_def();
    def.shape.kind = JOX_SHAPE_CYLINDER;
    def.shape.size[0] = 0.5, def.shape.size[1] = 1.0;
    def.mass = 8.0;
    def.position[0] = 5;
    JoxPose pose = pose_of(bodies, add(bodies, &def));
    near_to(pose.inertia.z, 0.5 * 8 * 0.25, 0.05);
    const double cube[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    def = jox_body_def();
    def.shape.kind = JOX_SHAPE_HULL;
    def.shape.points = cube;
    def.shape.point_count = 8;
    def.mass = 0.0;
    def.density = 6.0;
    def.position[0] = 10;
    pose = pose_of(bodies, add(bodies, &def));
    near_to(pose.mass, 6.0, 0.2); /* a cubic metre */
    near_to(pose.centre.x, 10.5, 0.02);
    near_to(pose.centre.z, 0.5, 0.02);
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
    pose = pose_of(bodies, add(bodies, &def));
    near_to(pose.mass, 4.0, 1e-4);
    near_to(pose.centre.x, 21.0, 1e-3); /* where the masses balance */
    near_to(pose.position.x, 20.0, 1e-3);
    double most = fmax(pose.inertia.x, fmax(pose.inertia.y, pose.inertia.z));
    near_to(most, 3.0 * 1 + 1.0 * 9 + 0.4 * 4 * 0.01, 0.05);
    jox_bodies_free(bodies);
}

static void a_ball_bounces_off_walls_and_does_not_pass_them(void **state) {
    (void)state;
    need_bullet();
    for (int speed = 5; speed <= 40; speed += 35) {
        JoxBodies *bodies = space();
        JoxWalls walls = {0};
        const JoxV2 line[] = {{3, -5}, {3, 5}};
        jox_walls_add_polyline(&walls, line, 2, false, 3);
        jox_bodies_set_walls(bodies, &walls, 3);
        JoxBodyDef def = sphere(0.11, 0.4, 0, 0, 1);
        def.restitution = 0.7;
        def.velocity[0] = speed;
        uint32_t row = add(bodies, &def);
        for (int i = 0; i < 30; i++) {
            jox_bodies_step(bodies, 0.05f, NULL, 0);
            assert_true(pose_of(bodies, row).centre.x < 3.0f);
        }
        near_to(pose_of(bodies, row).velocity.x, -0.7 * speed, 0.15 * speed);
        jox_bodies_free(bodies);
        jox_walls_free(&walls);
    }
}

/* How many of 40 speeds carry a cube of 4 cm through a plate of 2 cm. */
static uint32_t passages_of(const JoxShape *cube) {
    uint32_t passed = 0;
    for (int speed = 1; speed <= 40; speed++) {
        JoxBodies *bodies = space();
        JoxBodyDef plate = jox_body_def(), chip = sphere(0.02, 0.05, 0, 0, 1);
        plate.still = true;
        plate.shape.size[0] = 0.02;
        plate.shape.size[1] = plate.shape.size[2] = 2;
        plate.position[0] = 1, plate.position[2] = 1;
        add(bodies, &plate);
        chip.shape = *cube;
        chip.velocity[0] = speed;
        const uint32_t row = add(bodies, &chip);
        for (int i = 0; i < 40; i++)
            jox_bodies_step(bodies, 0.05f, NULL, 0);
        passed += pose_of(bodies, row).centre.x > 1.0f;
        jox_bodies_free(bodies);
    }
    return passed;
}

static void a_small_hull_passes_no_more_plates_than_a_box(void **state) {
    (void)state;
    need_bullet();
    JoxShape box = {.kind = JOX_SHAPE_BOX, .size = {0.04, 0.04, 0.04}};
    double corners[24];
    for (int k = 0; k < 24; k++)
        corners[k] = k / 3 >> k % 3 & 1 ? 0.02 : -0.02;
    JoxShape hull = {.kind = JOX_SHAPE_HULL, .points = corners, .point_count = 8};
    assert_true(passages_of(&hull) <= passages_of(&box));
}

static void footprints_follow_the_shape(void **state) {
    (void)state;
    need_bullet();
    JoxBodies *bodies = space();
    JoxBodyDef def = jox_body_def();
    def.shape.kind = JOX_SHAPE_BOX;
    memcpy(def.shape.size, (double[]){2, 1, 1}, sizeof def.shape.size);
    def.position[2] = 0.5;
    def.turn[2] = sin(0.5 * 3.14159265 / 2); /* a quarter turn about z */
    def.turn[3] = cos(0.5 * 3.14159265 / 2);
    uint32_t box = add(bodies, &def);
    def = sphere(0.3, 1, 5, 5, 0.3);
    uint32_t ball = add(bodies, &def);
    def = sphere(0.3, 1, 9, 9, 5.0);
    uint32_t high = add(bodies, &def);
    JoxObjects objects = {0};
    jox_bodies_objects(bodies, &objects);
    const JoxObject *o = &objects.rows[box];
    assert_true(o->live && o->in_band && o->moves && o->footprint_count >= 4);
    for (uint32_t i = 0; i < o->footprint_count; i++) {
        near_to(fabs(o->footprint[i].x), 0.5, 0.01); /* long side along y now */
        near_to(fabs(o->footprint[i].y), 1.0, 0.01);
    }
    assert_int_equal(objects.rows[ball].footprint_count, 0);
    near_to(objects.rows[ball].round, 0.3, 0.01);
    assert_false(objects.rows[high].in_band);
    jox_bodies_free(bodies);
}

static bool has_corner(const JoxObject *o, float x, float y) {
    for (uint32_t i = 0; i < o->footprint_count; i++)
        if (fabsf(o->footprint[i].x - x) < 1e-3f && fabsf(o->footprint[i].y - y) < 1e-3f)
            return true;
    return false;
}

/* The upper and lower corners of an upright box lie within a millionth of a metre of each other, in
   whatever order that puts them along x: no corner is lost. */
static void a_hair_of_tilt_costs_no_corner(void **state) {
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
            assert_true(has_corner(&o, k & 1 ? 0.2f : -0.2f, k & 2 ? 0.3f : -0.3f));
        jox_footprint_free(&footprint);
    }
}

/* Corners anywhere, few and many: all lie within the ring, which turns left throughout. */
static void a_ring_goes_round_all_corners(void **state) {
    (void)state;
    const uint32_t no_edges[2] = {0};
    JoxFootprint footprint = {0};
    for (uint32_t count = 3; count < 200; count++) {
        JoxV3 corners[200];
        JoxObject o = {0};
        for (uint32_t k = 0; k < count; k++) /* of some, x is the same; on an ellipse, and within */
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
                assert_true(jox_det(jox_sub(b, a), jox_sub(p, a)) > -0.5f); /* thinned: m2 */
            }
        }
    }
    jox_footprint_free(&footprint);
}

static void what_falls_for_ever_is_taken_out(void **state) {
    (void)state;
    need_bullet();
    JoxBodiesDef world = jox_bodies_def();
    world.ground = false;
    JoxBodies *bodies = jox_bodies_create(&world);
    JoxBodyDef def = sphere(0.2, 1, 0, 0, 0);
    add(bodies, &def);
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

static uint64_t hash_of_a_run(double offset) {
    JoxBodiesDef world = jox_bodies_def();
    JoxBodies *bodies = jox_bodies_create(&world);
    for (int i = 0; i < 12; i++) {
        JoxBodyDef def = i % 2 ? sphere(0.2, 2, 0.1 * i, 0, 0.5 + 0.5 * i) : jox_body_def();
        def.position[0] = 0.1 * i + offset;
        def.position[2] = 0.5 + 1.1 * i;
        add(bodies, &def);
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
    need_bullet();
    uint64_t first = hash_of_a_run(0.0);
    assert_true(first == hash_of_a_run(0.0));
    assert_true(first != hash_of_a_run(0.01));
}

/* A needle has a volume, and a least moment of inertia that is lost beside the others: it cannot
   turn, but it can stand. */
static void what_is_too_thin_cannot_move(void **state) {
    (void)state;
    need_bullet();
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
    need_bullet();
    JoxBodies *bodies = space();
    JoxBodyDef def = jox_body_def();
    def.still = true;
    uint32_t row = add(bodies, &def);
    def = sphere(0.2, 1, 5, 0, 0);
    uint32_t ball = add(bodies, &def);
    JoxImpulse pushes[] = {{row, {1e6f, 0, 0}, {0, 0, 0}, 0},
                           {ball, {1e9f, 0, 0}, {5, 0, 0}, 0},
                           {ball, {NAN, 0, 0}, {5, 0, 0}, 0},
                           {12345, {1, 0, 0}, {0, 0, 0}, 0}};
    assert_int_equal(jox_bodies_impulses(bodies, pushes, 4), 4);
    assert_true(pose_of(bodies, row).velocity.x == 0.0f);
    near_to(pose_of(bodies, ball).velocity.x, jox_bodies_def().most_change, 1.0);
    jox_bodies_step(bodies, 0.05f, NULL, 0);
    near_to(pose_of(bodies, row).centre.x, 0.0, 1e-6);
    jox_bodies_free(bodies);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_impulse_off_the_centre_moves_and_turns),
        cmocka_unit_test(inertia_and_mass_of_the_shapes),
        cmocka_unit_test(a_ball_bounces_off_walls_and_does_not_pass_them),
        cmocka_unit_test(a_small_hull_passes_no_more_plates_than_a_box),
        cmocka_unit_test(footprints_follow_the_shape),
        cmocka_unit_test(a_hair_of_tilt_costs_no_corner),
        cmocka_unit_test(a_ring_goes_round_all_corners),
        cmocka_unit_test(what_falls_for_ever_is_taken_out),
        cmocka_unit_test(equal_runs_have_equal_hashes),
        cmocka_unit_test(what_is_too_thin_cannot_move),
        cmocka_unit_test(static_bodies_stay_and_impulses_are_clamped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
