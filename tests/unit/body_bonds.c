/* Bonds: loads that can be worked out by hand, what breaks, and how bodies come apart. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "body/body.h"
#include "body/bonds.h"

static const double STILL[3] = {0, 0, 0};

static JoxBondGraph *row_of(uint32_t n, double strength) {
    return jox_bonds_create((uint32_t[]){n, 1, 1}, (double[]){1, 1, 1}, 10, strength);
}

/* A steady force on one block, until the filter has let it through. */
static uint32_t hold(JoxBondGraph *g, uint32_t block, double fx, double fy, double seconds) {
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
static void chain_breaks_at_the_right_bond(void **state) {
    (void)state;
    JoxBondGraph *g = row_of(5, 400);
    assert_int_equal(g->bond_count, 4);
    assert_int_equal(hold(g, 4, 495, 0, 3), 0); /* 4/5 of it is 396 N */
    assert_int_equal(hold(g, 4, 505, 0, 3), 1); /* 404 N */
    assert_int_equal(jox_bonds_label_pieces(g), 2);
    assert_int_equal(g->label[3], 0);
    assert_int_equal(g->label[4], 1);
    jox_bonds_free(g);
}

/* Pushed at the same end, all is compressed, and nothing breaks whatever the force. */
static void compression_breaks_nothing(void **state) {
    (void)state;
    JoxBondGraph *g = row_of(5, 400);
    assert_int_equal(hold(g, 0, 1e6, 0, 3), 0);
    jox_bonds_free(g);
}

/* A weak bond in the middle: 2/5 of the force pass it, though the first carries twice that. */
static void the_weakest_for_its_load_breaks(void **state) {
    (void)state;
    JoxBondGraph *g = row_of(5, 400);
    g->bonds[1].strength = 100;
    assert_int_equal(hold(g, 4, 245, 0, 3), 0);
    assert_int_equal(hold(g, 4, 255, 0, 3), 1);
    jox_bonds_label_pieces(g);
    assert_int_equal(g->label[1], 0);
    assert_int_equal(g->label[2], 1);
    jox_bonds_free(g);
    g = row_of(5, 400);
    g->bonds[1].strength = 5e-324; /* the least number: its load is infinitely much of that */
    assert_int_equal(hold(g, 4, 245, 0, 3), 1);
    jox_bonds_free(g);
}

/* Across: a free beam under F in its middle. Two blocks of five on either side have to be moved
   along by the bonds beside the middle, each 2/5 F in shear. */
static void shear_breaks_too(void **state) {
    (void)state;
    JoxBondGraph *g = row_of(5, 400);
    assert_int_equal(hold(g, 2, 0, 990, 3), 0);
    assert_float_equal(g->peak_load, 396.0 / 400.0, 1e-3);
    assert_int_equal(hold(g, 2, 0, 1010, 3), 2); /* both at once: the middle is driven out */
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

/* One step of a great force is filtered to what its impulse is worth over 0.1 s. */
static void a_spike_is_an_impulse(void **state) {
    (void)state;
    double greatest[2];
    for (int k = 0; k < 2; k++) {
        double dt = k ? 0.05 : 0.005, p[3];
        JoxBondGraph *g = row_of(2, 1e6);
        jox_bonds_block_centre(g, 1, p);
        jox_bonds_add_impulse(g, p, (double[]){100, 0, 0});
        jox_bonds_step(g, dt, STILL);
        greatest[k] = 0;
        for (uint32_t i = 0; i < g->bond_count; i++)
            g->bonds[i].strength = 1; /* so that the solver is asked */
        greatest[k] = 0.5 * g->load[1][0];
        jox_bonds_free(g);
    }
    /* 100 N s over 0.1 s: at most 1000 N, half of it on the bond. */
    assert_float_equal(greatest[0], 500, 20);
    assert_float_equal(greatest[1], 500, 120);
}

/* Spinning, a ring of mass pulls outwards: two blocks 1 m apart at w carry m w^2 / 2. */
static void spin_pulls(void **state) {
    (void)state;
    JoxBondGraph *g = row_of(2, 100);
    assert_int_equal(jox_bonds_step(g, 0.05, (double[]){0, 0, 4.4}), 0); /* 96.8 N */
    assert_float_equal(g->peak_load, 0.0, 1e-9);                         /* too little to look */
    assert_int_equal(jox_bonds_step(g, 0.05, (double[]){0, 0, 4.6}), 1); /* 105.8 N */
    jox_bonds_free(g);
}

/* A load handed out unevenly by a solver is leant on evenly; a moment tilts it, and nothing
   pulls. */
static void leans_smoothly(void **state) {
    (void)state;
    JoxBondGraph *g = row_of(4, 1e9);
    JoxBondContact c[5];
    for (uint32_t k = 0; k < 5; k++) /* the last block touches at two points */
        c[k] = (JoxBondContact){
            k < 4 ? k : 3, {k < 4 ? k - 1.9 : 1.9, 0, -0.5}, {0, 0, k == 1 || k == 2 ? 20 : 0}};
    c[2].point[0] = 0.9; /* 20 N s on either side of the middle */
    c[1].point[0] = -0.9;
    jox_bonds_add_contacts(g, c, 5, (double[]){0, 0, 1});
    for (uint32_t n = 0; n < 4; n++)
        assert_float_equal(g->impulse[n][2], 10, 1e-3);
    for (uint32_t k = 0; k < 4; k++)
        c[k] = (JoxBondContact){k, {k - 1.5, 0, -0.5}, {0, 0, k == 2 ? 40 : 0}};
    jox_bonds_add_contacts(g, c, 4, (double[]){0, 0, 1}); /* half a metre off: 4, 8, 12, 16 */
    for (uint32_t n = 0; n < 4; n++)
        assert_float_equal(g->impulse[n][2] - 10, 4.0 + 4.0 * n, 1e-3);
    for (uint32_t k = 0; k < 4; k++)
        c[k] = (JoxBondContact){k, {k - 1.5, 0, -0.5}, {0, 0, k == 3 ? 40 : 0}};
    jox_bonds_add_contacts(g, c, 4,
                           (double[]){0, 0, 1}); /* at the edge: the far ones would have to pull */
    double sum = 0;
    for (uint32_t n = 0; n < 4; n++) {
        assert_true(g->impulse[n][2] >= 14 + 4.0 * n - 1e-3);
        sum += g->impulse[n][2];
    }
    assert_float_equal(sum, 120, 1e-3);
    assert_float_equal(g->impulse[0][2], 14, 1e-3);
    jox_bonds_free(g);
}

static void finds_blocks(void **state) {
    (void)state;
    JoxBondGraph *g = jox_bonds_create((uint32_t[]){3, 2, 2}, (double[]){1, 1, 1}, 1, 1);
    assert_int_equal(jox_bonds_block_at(g, (double[]){-1.2, -0.9, -0.1}), 0);
    assert_int_equal(jox_bonds_block_at(g, (double[]){1.4, 0.9, 0.1}), 11);
    assert_int_equal(jox_bonds_block_at(g, (double[]){99, -99, 99}), 8);
    for (uint32_t n = 0; n < g->count; n++)
        g->label[n] = n == 4; /* one from the middle */
    double centre[3];
    JoxBondGraph *rest = jox_bonds_extract(g, 0, false, centre),
                 *one = jox_bonds_extract(g, 1, true, centre);
    assert_int_equal(rest->count, 11);
    assert_int_equal(rest->bond_count, g->bond_count - 4);
    assert_int_equal(one->bond_count, 0);
    assert_float_equal(centre[0], 0, 1e-12);
    assert_float_equal(centre[1], 0.5, 1e-12);
    assert_int_equal(jox_bonds_block_at(rest, (double[]){1.2, 0.5, -0.5}), 4); /* was 5 */
    double p[3];
    jox_bonds_block_centre(rest, jox_bonds_block_at(rest, (double[]){0.1, 0.5, -0.5}),
                           p); /* the hole */
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

static JoxBodyDef wall(double bond) {
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

static uint64_t hash_of(const JoxBodies *b) {
    JoxHash h = jox_hash_begin();
    jox_bodies_hash(b, &h);
    return jox_hash_end(&h);
}

/* Two hundred blocks of 10 kg, bonds of 60 N: by themselves they stand for a minute. */
static void a_wall_stands(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxBodyDef d = wall(60);
    uint32_t row = jox_bodies_add(b, &d, NULL);
    JoxPose p;
    JoxBodyBonds bonds;
    for (int i = 0; i < 1200; i++) {
        /* A touch now and then keeps Bullet from putting it to sleep. */
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

/* Of all bodies, about the origin. Inertia is that of principal axes, so the turn comes in. */
static Momentum momentum_of(JoxBodies *b) {
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

/* In free flight, spinning; blows from two sides break it. What they gave is all that there is,
   before and after. */
static void pieces_keep_momentum(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodiesDef def = jox_bodies_def();
    def.gravity = 0;
    def.ground = false;
    JoxBodies *b = jox_bodies_create(&def);
    JoxBodyDef d = wall(400);
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
    Momentum before = momentum_of(b);
    for (int i = 0; i < 4; i++) {
        report = jox_bodies_step(b, 0.001f, NULL, 0);
        for (uint32_t k = 0; k < report.break_count; k++) {
            cut += report.breaks[k].bonds;
            pieces += report.breaks[k].pieces - 1;
        }
    }
    Momentum after = momentum_of(b);
    assert_true(cut > 0);
    assert_true(pieces > 1);
    assert_int_equal(jox_bodies_count(b), pieces);
    assert_float_equal(after.mass, 2000, 1e-2);
    for (int j = 0; j < 3; j++) {
        assert_float_equal(after.linear[j], before.linear[j], 0.05);  /* of 4400 N s */
        assert_float_equal(after.angular[j], before.angular[j], 2.0); /* of 440000 N m s */
    }
    JoxObjects o = {0};
    jox_bodies_objects(b, &o);
    for (uint32_t i = 0; i < o.count; i++)
        assert_int_equal(o.rows[i].tags, 5);
    assert_int_equal(jox_bodies_find_name(b, "wall"), row);
    jox_bodies_free(b);
}

/* Pushed in the middle on the ground until it breaks; twice the same, to the bit. */
static uint64_t broken(uint32_t *cut) {
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxBodyDef d = wall(300);
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
    uint64_t hash = hash_of(b);
    jox_bodies_free(b);
    return hash;
}

static void breaks_alike(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    uint32_t one, two;
    uint64_t first = broken(&one), second = broken(&two);
    assert_true(one > 0);
    assert_int_equal(one, two);
    assert_true(first == second);
}

static void refuses_nonsense(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxText error = {0};
    JoxBodyDef d = wall(0);
    assert_int_equal(jox_bodies_add(b, &d, &error), JOX_NO_BODY);
    d = wall(100);
    d.shape.count[1] = 4096;
    assert_int_equal(jox_bodies_add(b, &d, &error), JOX_NO_BODY);
    d = wall(100);
    d.shape.size[2] = NAN;
    assert_int_equal(jox_bodies_add(b, &d, &error), JOX_NO_BODY);
    assert_non_null(error.data);
    d = wall(100);
    d.mass = 0; /* stands for ever */
    uint32_t row = jox_bodies_add(b, &d, NULL);
    JoxBodyBonds bonds;
    assert_int_not_equal(row, JOX_NO_BODY);
    assert_false(jox_bodies_bonds(b, row, &bonds));
    jox_text_free(&error);
    jox_bodies_free(b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chain_breaks_at_the_right_bond),
        cmocka_unit_test(compression_breaks_nothing),
        cmocka_unit_test(the_weakest_for_its_load_breaks),
        cmocka_unit_test(shear_breaks_too),
        cmocka_unit_test(uniform_push_breaks_nothing),
        cmocka_unit_test(a_spike_is_an_impulse),
        cmocka_unit_test(spin_pulls),
        cmocka_unit_test(leans_smoothly),
        cmocka_unit_test(finds_blocks),
        cmocka_unit_test(a_wall_stands),
        cmocka_unit_test(pieces_keep_momentum),
        cmocka_unit_test(breaks_alike),
        cmocka_unit_test(refuses_nonsense),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
