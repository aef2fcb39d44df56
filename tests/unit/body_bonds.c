/* Bonds: compares loads with hand calculations, and tests which bonds break and how bodies
   split. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "body/body.h"
#include "body/bonds.h"

static const double STILL[3] = {0, 0, 0};

static JoxBondGraph *make_block_row(uint32_t n, double strength) {
    return jox_bonds_create((uint32_t[]){n, 1, 1}, (double[]){1, 1, 1}, 10, strength);
}

/* Applies a steady force, N, to one block for some seconds or until a bond breaks; returns how
   many broke. 3 s are long enough for the low-pass filter. */
static uint32_t apply_steady_force(JoxBondGraph *g, uint32_t block, double fx, double fy,
                                   double seconds) {
    uint32_t cut = 0;
    double p[3];
    jox_bonds_block_centre(g, block, p);
    for (int step = 0; step < (int)(seconds / 0.05 + 0.5) && !cut; step++) {
        jox_bonds_add_impulse(g, p, (double[]){fx * 0.05, fy * 0.05, 0});
        cut = jox_bonds_step(g, 0.05, STILL);
    }
    return cut;
}

/* Pulled at one end by F, five equal blocks accelerate as one: the bond next to the puller moves
   four blocks of five and carries 4/5 F, the next 3/5 F. */
static void pulled_chain_breaks_next_to_the_puller(void **state) {
    (void)state;
    JoxBondGraph *g = make_block_row(5, 400);
    assert_int_equal(g->bond_count, 4);
    assert_int_equal(apply_steady_force(g, 4, 495, 0, 3), 0); /* load 4/5 of that: 396 N */
    assert_int_equal(apply_steady_force(g, 4, 505, 0, 3), 1); /* load 404 N */
    assert_int_equal(jox_bonds_label_pieces(g), 2);
    assert_int_equal(g->label[3], 0);
    assert_int_equal(g->label[4], 1);
    jox_bonds_free(g);
}

/* A push at the same end compresses all bonds. */
static void compression_breaks_nothing(void **state) {
    (void)state;
    JoxBondGraph *g = make_block_row(5, 400);
    assert_int_equal(apply_steady_force(g, 0, 1e6, 0, 3), 0);
    jox_bonds_free(g);
}

/* A weak bond in the middle carries 2/5 of the force, the first bond 4/5. */
static void bond_with_greatest_load_ratio_breaks(void **state) {
    (void)state;
    JoxBondGraph *g = make_block_row(5, 400);
    g->bonds[1].strength = 100;
    assert_int_equal(apply_steady_force(g, 4, 245, 0, 3), 0);
    assert_int_equal(apply_steady_force(g, 4, 255, 0, 3), 1);
    jox_bonds_label_pieces(g);
    assert_int_equal(g->label[1], 0);
    assert_int_equal(g->label[2], 1);
    jox_bonds_free(g);
    g = make_block_row(5, 400);
    g->bonds[1].strength = 5e-324; /* the smallest number: the load ratio overflows */
    assert_int_equal(apply_steady_force(g, 4, 245, 0, 3), 1);
    jox_bonds_free(g);
}

/* A force F across a free beam in its middle: each bond beside it accelerates two of the
   five blocks and carries 2/5 F in shear. */
static void shear_breaks_a_free_beam(void **state) {
    (void)state;
    JoxBondGraph *g = make_block_row(5, 400);
    assert_int_equal(apply_steady_force(g, 2, 0, 990, 3), 0);
    assert_float_equal(g->peak_load, 396.0 / 400.0, 1e-3);
    assert_int_equal(apply_steady_force(g, 2, 0, 1010, 3),
                     2); /* both at once: the middle block is driven out */
    assert_int_equal(jox_bonds_label_pieces(g), 3);
    jox_bonds_free(g);
}

static void uniform_push_breaks_nothing(void **state) {
    (void)state;
    JoxBondGraph *g = jox_bonds_create((uint32_t[]){20, 1, 10}, (double[]){0.4, 0.2, 0.2}, 5, 10);
    for (int step = 0; step < 100; step++) {
        for (uint32_t n = 0; n < g->count; n++) {
            double p[3];
            jox_bonds_block_centre(g, n, p);
            jox_bonds_add_impulse(g, p, (double[]){0, 500 * 0.05, 0});
        }
        assert_int_equal(jox_bonds_step(g, 0.05, STILL), 0);
    }
    jox_bonds_free(g);
}

/* A force of one step acts like its impulse spread over 0.1 s, whatever the step. */
static void one_step_force_counts_by_its_impulse(void **state) {
    (void)state;
    double greatest[2];
    for (int k = 0; k < 2; k++) {
        double dt = k ? 0.05 : 0.005, p[3];
        JoxBondGraph *g = make_block_row(2, 1e6);
        jox_bonds_block_centre(g, 1, p);
        jox_bonds_add_impulse(g, p, (double[]){100, 0, 0});
        jox_bonds_step(g, dt, STILL);
        greatest[k] = 0.5 * g->load[1][0];
        jox_bonds_free(g);
    }
    /* 100 N s over 0.1 s: at most 1000 N, half of it on the bond. */
    assert_float_equal(greatest[0], 500, 20);
    assert_float_equal(greatest[1], 500, 120);
}

/* Centrifugal load: two blocks 1 m apart at angular velocity w load their bond by m w^2 / 2. */
static void spin_loads_bonds(void **state) {
    (void)state;
    JoxBondGraph *g = make_block_row(2, 100);
    assert_int_equal(jox_bonds_step(g, 0.05, (double[]){0, 0, 4.4}), 0); /* 96.8 N */
    assert_float_equal(g->peak_load, 0.0, 1e-9); /* below the threshold of solving */
    assert_int_equal(jox_bonds_step(g, 0.05, (double[]){0, 0, 4.6}), 1); /* 105.8 N */
    jox_bonds_free(g);
}

/* An uneven division of contact impulses is replaced by an even one; a moment makes it linear,
   and no block pulls. */
static void contact_impulses_vary_linearly(void **state) {
    (void)state;
    JoxBondGraph *g = make_block_row(4, 1e9);
    JoxBondContact c[5];
    for (uint32_t k = 0; k < 5; k++) /* the last block touches at two points */
        c[k] = (JoxBondContact){
            k < 4 ? k : 3, {k < 4 ? k - 1.9 : 1.9, 0, -0.5}, {0, 0, k == 1 || k == 2 ? 20 : 0}};
    c[2].point[0] = 0.9; /* 20 N s at equal distances on both sides of the centre */
    c[1].point[0] = -0.9;
    jox_bonds_add_contacts(g, c, 5, (double[]){0, 0, 1});
    for (uint32_t n = 0; n < 4; n++)
        assert_float_equal(g->impulse[n][2], 10, 1e-3);
    for (uint32_t k = 0; k < 4; k++)
        c[k] = (JoxBondContact){k, {k - 1.5, 0, -0.5}, {0, 0, k == 2 ? 40 : 0}};
    jox_bonds_add_contacts(g, c, 4, (double[]){0, 0, 1}); /* 0.5 m from the centre: 4, 8, 12, 16 */
    for (uint32_t n = 0; n < 4; n++)
        assert_float_equal(g->impulse[n][2] - 10, 4.0 + 4.0 * n, 1e-3);
    for (uint32_t k = 0; k < 4; k++)
        c[k] = (JoxBondContact){k, {k - 1.5, 0, -0.5}, {0, 0, k == 3 ? 40 : 0}};
    jox_bonds_add_contacts(
        g, c, 4, (double[]){0, 0, 1}); /* at the edge: the far blocks would have to pull */
    double sum = 0;
    for (uint32_t n = 0; n < 4; n++) {
        assert_true(g->impulse[n][2] >= 14 + 4.0 * n - 1e-3);
        sum += g->impulse[n][2];
    }
    assert_float_equal(sum, 120, 1e-3);
    assert_float_equal(g->impulse[0][2], 14, 1e-3);
    jox_bonds_free(g);
}

static void block_at_a_point_is_found(void **state) {
    (void)state;
    JoxBondGraph *g = jox_bonds_create((uint32_t[]){3, 2, 2}, (double[]){1, 1, 1}, 1, 1);
    assert_int_equal(jox_bonds_block_at(g, (double[]){-1.2, -0.9, -0.1}), 0);
    assert_int_equal(jox_bonds_block_at(g, (double[]){1.4, 0.9, 0.1}), 11);
    assert_int_equal(jox_bonds_block_at(g, (double[]){99, -99, 99}), 8);
    for (uint32_t n = 0; n < g->count; n++)
        g->label[n] = n == 4; /* a block inside */
    double centre[3];
    JoxBondGraph *rest = jox_bonds_extract(g, 0, false, centre),
                 *one = jox_bonds_extract(g, 1, true, centre);
    assert_int_equal(rest->count, 11);
    assert_int_equal(rest->bond_count, g->bond_count - 4);
    assert_int_equal(one->bond_count, 0);
    assert_float_equal(centre[0], 0, 1e-12);
    assert_float_equal(centre[1], 0.5, 1e-12);
    assert_int_equal(jox_bonds_block_at(rest, (double[]){1.2, 0.5, -0.5}),
                     4); /* block 5 of the whole */
    double p[3];
    jox_bonds_block_centre(rest, jox_bonds_block_at(rest, (double[]){0.1, 0.5, -0.5}),
                           p); /* the missing block */
    assert_float_equal(fabs(p[0]) + fabs(p[1] - 0.5) + fabs(p[2] + 0.5), 1, 1e-9);
    jox_bonds_free(rest);
    jox_bonds_free(one);
    jox_bonds_free(g);
    assert_null(jox_bonds_create((uint32_t[]){5000, 1, 1}, (double[]){1, 1, 1}, 1, 1));
    assert_null(jox_bonds_create((uint32_t[]){1, 0, 1}, (double[]){1, 1, 1}, 1, 1));
    assert_null(jox_bonds_create((uint32_t[]){1, 1, 1}, (double[]){1, -1, 1}, 1, 1));
    assert_null(jox_bonds_create((uint32_t[]){1, 1, 1}, (double[]){1, 1, 1}, 1, NAN));
}

/* ---- bodies ---- */

static JoxBodyDef make_wall_of_blocks(double bond) {
    JoxBodyDef d = jox_body_def();
    d.shape.kind = JOX_SHAPE_BLOCKS;
    d.shape.size[0] = 0.4, d.shape.size[1] = 0.4, d.shape.size[2] = 0.25;
    d.shape.count[0] = 20, d.shape.count[1] = 2, d.shape.count[2] = 5;
    d.shape.bond = bond;
    d.mass = 2000;
    d.position[2] = 0.625;
    d.name = "wall";
    return d;
}

static uint64_t hash_bonded_bodies(const JoxBodies *b) {
    JoxHash h = jox_hash_begin();
    jox_bodies_hash(b, &h);
    return jox_hash_end(&h);
}

/* A wall of 200 blocks of 10 kg, with bonds of 60 N. */
static void wall_stands_for_a_minute(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxBodyDef d = make_wall_of_blocks(60);
    uint32_t row = jox_bodies_add(b, &d, NULL);
    JoxPose p;
    JoxBodyBonds bonds;
    for (int i = 0; i < 1200; i++) {
        /* keeps the wall from sleeping in Bullet */
        jox_bodies_set_velocity(b, row, (JoxV3){0, 0, 0}, (JoxV3){0, 0, 0});
        assert_int_equal(jox_bodies_step(b, 0.05f, NULL, 0).break_count, 0);
    }
    jox_bodies_pose(b, row, &p);
    assert_true(jox_bodies_bonds(b, row, &bonds));
    assert_int_equal(bonds.blocks, 200);
    assert_int_equal(bonds.bonds, 19 * 10 + 100 + 20 * 2 * 4);
    assert_float_equal(p.position.x, 0, 2e-3);
    assert_float_equal(p.position.y, 0, 2e-3);
    assert_float_equal(p.position.z, 0.625, 1e-2);
    jox_bodies_free(b);
}

typedef struct Momentum {
    double linear[3], angular[3], mass;
} Momentum;

/* Sums the momentum of all bodies about the origin. Inertia is about principal axes, so the
   rotation enters. */
static Momentum sum_momentum(JoxBodies *b) {
    Momentum sum = {0};
    JoxObjects o = {0};
    jox_bodies_objects(b, &o);
    for (uint32_t i = 0; i < o.count; i++) {
        JoxPose p;
        if (!jox_bodies_pose(b, i, &p))
            continue;
        double m = p.mass, v[3] = {p.velocity.x, p.velocity.y, p.velocity.z};
        double c[3] = {p.centre.x, p.centre.y, p.centre.z};
        double w[3] = {p.spin.x, p.spin.y, p.spin.z}, l[3];
        const float *k = o.rows[i].inverse_inertia; /* L from w = K L, by Cramer */
        double det = k[0] * (k[4] * (double)k[8] - k[5] * (double)k[7]) -
                     k[1] * (k[3] * (double)k[8] - k[5] * (double)k[6]) +
                     k[2] * (k[3] * (double)k[7] - k[4] * (double)k[6]);
        for (int j = 0; j < 3; j++) {
            double t[9];
            for (int e = 0; e < 9; e++)
                t[e] = e % 3 == j ? w[e / 3] : k[e];
            l[j] = (t[0] * (t[4] * t[8] - t[5] * t[7]) - t[1] * (t[3] * t[8] - t[5] * t[6]) +
                    t[2] * (t[3] * t[7] - t[4] * t[6])) /
                   det;
        }
        sum.mass += m;
        for (int j = 0; j < 3; j++) {
            sum.linear[j] += m * v[j];
            sum.angular[j] +=
                l[j] + m * (c[(j + 1) % 3] * v[(j + 2) % 3] - c[(j + 2) % 3] * v[(j + 1) % 3]);
        }
    }
    return sum;
}

/* A spinning wall in free flight breaks under impulses from two sides. The pieces have the
   momentum of the whole plus these impulses. */
static void pieces_keep_momentum(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodiesDef def = jox_bodies_def();
    def.gravity = 0;
    def.ground = false;
    JoxBodies *b = jox_bodies_create(&def);
    JoxBodyDef d = make_wall_of_blocks(400);
    d.position[2] = 100;
    d.velocity[1] = 2;
    d.spin[2] = 0.3;
    d.tags = 5;
    uint32_t row = jox_bodies_add(b, &d, NULL);
    JoxImpulse blows[2] = {{row, {0, 900, 0}, {1.1f, -0.4f, 100.2f}, 0},
                           {row, {0, -500, 0}, {-2.9f, 0.4f, 99.8f}, 0}};
    JoxBodiesReport report = {0};
    uint32_t cut = 0, pieces = 1;
    assert_int_equal(jox_bodies_impulses(b, blows, 2), 0);
    Momentum before = sum_momentum(b);
    for (int i = 0; i < 4; i++) {
        report = jox_bodies_step(b, 0.001f, NULL, 0);
        for (uint32_t k = 0; k < report.break_count; k++) {
            cut += report.breaks[k].bonds;
            pieces += report.breaks[k].pieces - 1;
        }
    }
    Momentum after = sum_momentum(b);
    assert_true(cut > 0);
    assert_true(pieces > 1);
    assert_int_equal(jox_bodies_count(b), pieces);
    assert_float_equal(after.mass, 2000, 1e-2);
    for (int j = 0; j < 3; j++) {
        assert_float_equal(after.linear[j], before.linear[j], 0.05);  /* total 4400 N s */
        assert_float_equal(after.angular[j], before.angular[j], 2.0); /* total 440000 N m s */
    }
    JoxObjects o = {0};
    jox_bodies_objects(b, &o);
    for (uint32_t i = 0; i < o.count; i++)
        assert_int_equal(o.rows[i].tags, 5);
    assert_int_equal(jox_bodies_find_name(b, "wall"), row);
    jox_bodies_free(b);
}

/* Pushes a wall on the ground in its middle until it breaks; returns the final hash, and the
   broken bonds in *cut. */
static uint64_t push_until_broken(uint32_t *cut) {
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxBodyDef d = make_wall_of_blocks(300);
    uint32_t row = jox_bodies_add(b, &d, NULL);
    *cut = 0;
    for (int i = 0; i < 100; i++) {
        JoxImpulse push = {row, {0, 400, 0}, {0.2f, -0.4f, 0.6f}, 0};
        JoxPose p;
        jox_bodies_pose(b, row, &p);
        push.point.x += p.centre.x;
        push.point.y += p.centre.y;
        jox_bodies_impulses(b, &push, 1);
        JoxBodiesReport report = jox_bodies_step(b, 0.05f, NULL, 0);
        for (uint32_t k = 0; k < report.break_count; k++)
            *cut += report.breaks[k].bonds;
    }
    uint64_t hash = hash_bonded_bodies(b);
    jox_bodies_free(b);
    return hash;
}

static void equal_pushes_break_equal_bonds(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    uint32_t one, two;
    uint64_t first = push_until_broken(&one), second = push_until_broken(&two);
    assert_true(one > 0);
    assert_int_equal(one, two);
    assert_true(first == second);
}

static void invalid_blocks_are_refused(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxText error = {0};
    JoxBodyDef d = make_wall_of_blocks(0);
    assert_int_equal(jox_bodies_add(b, &d, &error), JOX_NO_BODY);
    d = make_wall_of_blocks(100);
    d.shape.count[1] = 4096;
    assert_int_equal(jox_bodies_add(b, &d, &error), JOX_NO_BODY);
    d = make_wall_of_blocks(100);
    d.shape.size[2] = NAN;
    assert_int_equal(jox_bodies_add(b, &d, &error), JOX_NO_BODY);
    assert_non_null(error.data);
    d = make_wall_of_blocks(100);
    d.mass = 0; /* static */
    uint32_t row = jox_bodies_add(b, &d, NULL);
    JoxBodyBonds bonds;
    assert_int_not_equal(row, JOX_NO_BODY);
    assert_false(jox_bodies_bonds(b, row, &bonds));
    jox_text_free(&error);
    jox_bodies_free(b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pulled_chain_breaks_next_to_the_puller),
        cmocka_unit_test(compression_breaks_nothing),
        cmocka_unit_test(bond_with_greatest_load_ratio_breaks),
        cmocka_unit_test(shear_breaks_a_free_beam),
        cmocka_unit_test(uniform_push_breaks_nothing),
        cmocka_unit_test(one_step_force_counts_by_its_impulse),
        cmocka_unit_test(spin_loads_bonds),
        cmocka_unit_test(contact_impulses_vary_linearly),
        cmocka_unit_test(block_at_a_point_is_found),
        cmocka_unit_test(wall_stands_for_a_minute),
        cmocka_unit_test(pieces_keep_momentum),
        cmocka_unit_test(equal_pushes_break_equal_bonds),
        cmocka_unit_test(invalid_blocks_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
