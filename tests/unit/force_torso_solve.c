/* The solve of contacts between torsos: it keeps momentum and angular momentum and adds no energy,
   over random heaps; symmetric hits turn nobody; mirrored and turned heaps get mirrored and turned
   forces. */
#include "unit/force_crowd.h"

#include "agents/torso.h"
#include "force/contact/contacts.h"

enum { HEAPS = 200, MOST = 60 };

/* Momentum, angular momentum about the origin, and energy of a crowd, and the sums of magnitudes by
   which their rounding goes. */
typedef struct Motion {
    double x, y, turning, energy, momenta, turnings;
} Motion;

static float draw_heap(uint32_t heap, uint32_t *drawn, double from, double to) {
    return (float)(from + (to - from) * jox_random_unit(17, heap, 0, JOX_DRAW_FILL, (*drawn)++));
}

/* Adds torsos and discs that move and turn, within a square of 1.6 m. */
static void add_heap(Crowd *c, uint32_t heap) {
    uint32_t drawn = 0;
    const uint32_t count = 2 + (uint32_t)draw_heap(heap, &drawn, 0.0, MOST - 2);
    open_crowd(c, heap % 2 ? 0.05 : 0.0125);
    JoxForceOptions options = jox_force_default_options();
    options.iterations = 2000;
    options.tolerance = 0.01f;
    options.friction = heap % 3 ? 0.5f : 0.0f;
    jox_forces_set_options(c->forces, &options);
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i =
            add_agent(c, draw_heap(heap, &drawn, -0.8, 0.8), draw_heap(heap, &drawn, -0.8, 0.8),
                      draw_heap(heap, &drawn, -2.0, 2.0), draw_heap(heap, &drawn, -2.0, 2.0));
        const float angle = draw_heap(heap, &drawn, -3.2, 3.2);
        JoxAgents *a = &c->agents;
        a->chest_x[i] = cosf(angle);
        a->chest_y[i] = sinf(angle);
        a->spin[i] = draw_heap(heap, &drawn, -4.0, 4.0);
        set_param(c, i, JOX_PARAM_perception, 10.0);
        set_param(c, i, JOX_PARAM_neighbours, JOX_MOST_NEIGHBOURS);
        set_param(c, i, JOX_PARAM_mass, draw_heap(heap, &drawn, 40.0, 110.0));
        set_param(c, i, JOX_PARAM_breadth, draw_heap(heap, &drawn, 0.3, 0.6));
        set_param(c, i, JOX_PARAM_depth, k % 5 ? draw_heap(heap, &drawn, 0.1, 0.3) : 0.6);
        if (k % 5 == 0)
            a->spin[i] = 0.0f; /* a disc */
    }
}

/* Measures the motion of the crowd: at the start, or, `after`, as the contacts leave it. */
static Motion measure_motion(const Crowd *c, bool after) {
    const JoxAgents *a = &c->agents;
    const double dt = c->step.timing.dt;
    Motion m = {0};
    for (uint32_t i = 0; i < a->count; i++) {
        const double mass = (double)jox_param(a, JOX_PARAM_mass, i);
        const double half = hypot((double)a->axis_x[i], (double)a->axis_y[i]);
        const double inertia =
            half > 0.0
                ? mass * (double)jox_torso_gyration2((JoxTorso){a->contact_radius[i], (float)half})
                : 0.0;
        const double vx = (double)a->vx[i] + (after ? (double)a->contact_x[i] * dt / mass : 0.0);
        const double vy = (double)a->vy[i] + (after ? (double)a->contact_y[i] * dt / mass : 0.0);
        const double spin = (double)a->spin[i];
        m.x += mass * vx;
        m.y += mass * vy;
        m.turning += mass * ((double)a->x[i] * vy - (double)a->y[i] * vx) + inertia * spin;
        m.energy += 0.5 * (mass * (vx * vx + vy * vy) + inertia * spin * spin);
        m.momenta += mass * hypot(vx, vy);
        m.turnings += mass * hypot(vx, vy) + inertia * fabs(spin);
    }
    return m;
}

static void heaps_keep_momenta_and_gain_no_energy(void **state) {
    (void)state;
    double lost = 0.0, kept = 0.0;
    for (uint32_t heap = 0; heap < HEAPS; heap++) {
        Crowd c;
        add_heap(&c, heap);
        begin_crowd_step(&c);
        const Motion first = measure_motion(&c, false);
        jox_force_contact(c.forces);
        const Motion last = measure_motion(&c, true);
        const double drift = hypot(last.x - first.x, last.y - first.y);
        if (drift > 1e-5 * first.momenta)
            fail_msg("heap %u: momentum changes by %g of %g kg m/s", heap, drift, first.momenta);
        if (fabs(last.turning - first.turning) > 1e-5 * first.turnings)
            fail_msg("heap %u: angular momentum changes by %g of %g kg m2/s", heap,
                     last.turning - first.turning, first.turnings);
        if (last.energy > first.energy * (1.0 + 1e-6))
            fail_msg("heap %u: energy grows from %g to %g J", heap, first.energy, last.energy);
        lost += first.energy - last.energy;
        kept += last.energy;
        close_crowd(&c);
    }
    assert_true(lost > 0.1 * kept);
}

/* Two torsos that meet face to face, shoulder to shoulder, or one in the middle of another's chest:
   neither turns. */
static void symmetric_hits_turn_nobody(void **state) {
    (void)state;
    static const double chests[3][2] = {
        {0.0, 3.14159265358979}, {1.570796, 1.570796}, {0.0, 1.570796}};
    for (int k = 0; k < 3; k++)
        for (int n = 0; n < 12; n++) {
            Crowd c;
            const double way = 0.5235987755982988 * n, size = k == 1 ? 0.25 : k ? 0.2 : 0.125;
            open_crowd(&c, 0.05);
            for (int side = 0; side < 2; side++) {
                const double sign = side ? 1.0 : -1.0, x = sign * cos(way), y = sign * sin(way);
                const uint32_t i =
                    add_agent(&c, (float)(size * x), (float)(size * y), (float)-x, (float)-y);
                set_param(&c, i, JOX_PARAM_breadth, 0.5);
                set_param(&c, i, JOX_PARAM_depth, 0.25);
                c.agents.chest_x[i] = (float)cos(way + chests[k][side]);
                c.agents.chest_y[i] = (float)sin(way + chests[k][side]);
            }
            begin_crowd_step(&c);
            jox_force_contact(c.forces);
            for (uint32_t i = 0; i < 2; i++) {
                assert_true(hypot((double)c.agents.contact_x[i], (double)c.agents.contact_y[i]) >
                            500.0);
                if (fabsf(c.agents.spin[i]) > 1e-3f)
                    fail_msg("hit %d at %d degrees: agent %u turns by %g rad/s", k, 30 * n, i,
                             (double)c.agents.spin[i]);
            }
            close_crowd(&c);
        }
}

/* Turns a heap by an angle, after mirroring it at the x axis if `mirror`. */
static void map_heap(Crowd *c, double angle, bool mirror) {
    JoxAgents *a = &c->agents;
    const float co = (float)cos(angle), si = (float)sin(angle), sign = mirror ? -1.0f : 1.0f;
    float *const vectors[3][2] = {{a->x, a->y}, {a->vx, a->vy}, {a->chest_x, a->chest_y}};
    for (uint32_t i = 0; i < a->count; i++) {
        a->spin[i] *= sign;
        for (int k = 0; k < 3; k++) {
            const float x = vectors[k][0][i], y = sign * vectors[k][1][i];
            vectors[k][0][i] = co * x - si * y;
            vectors[k][1][i] = si * x + co * y;
        }
    }
}

static void mirrored_and_turned_heaps_move_alike(void **state) {
    (void)state;
    uint32_t off = 0, count = 0;
    for (uint32_t heap = 0; heap < HEAPS; heap++) {
        Crowd c, other;
        const double angle = 0.7 * heap;
        const float co = (float)cos(angle), si = (float)sin(angle), sign = heap % 2 ? -1.0f : 1.0f;
        add_heap(&c, heap);
        add_heap(&other, heap);
        map_heap(&other, angle, heap % 2);
        begin_crowd_step(&c);
        begin_crowd_step(&other);
        jox_force_contact(c.forces);
        jox_force_contact(other.forces);
        for (uint32_t i = 0; i < c.agents.count; i++, count++) {
            const float x = c.agents.contact_x[i], y = sign * c.agents.contact_y[i];
            const float dx = other.agents.contact_x[i] - (co * x - si * y);
            const float dy = other.agents.contact_y[i] - (si * x + co * y);
            off += hypotf(dx, dy) > 0.01f * hypotf(x, y) + 5.0f;
        }
        close_crowd(&c);
        close_crowd(&other);
    }
    print_message("  of %u forces %u differ\n", count, off);
    assert_true(off < count / 50);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heaps_keep_momenta_and_gain_no_energy),
        cmocka_unit_test(symmetric_hits_turn_nobody),
        cmocka_unit_test(mirrored_and_turned_heaps_move_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
