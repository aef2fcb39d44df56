/* Tests the kernels of prefer against scalar references, on every instruction set of the machine:
   random and special batches, with agents on an axis and at the same place, and weights and
   velocities that are NaN or infinite. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/number/random.h"
#include "machine/kernels.h"

enum { PEOPLE = JOX_BATCH, CASES = 40 };
static const double ORBIT[] = {0.4, 7.0, 2.0, 30.0, 36.0};

typedef struct Draws {
    uint32_t number, drawn;
} Draws;

static float draw_steering_number(Draws *d, double from, double to) {
    double unit = jox_random_unit(33, d->number, 0, JOX_DRAW_FILL, d->drawn++);
    return (float)(from + (to - from) * unit);
}

static void add_random_agents(JoxAgents *a, Draws *d) {
    for (uint32_t k = 0; k < PEOPLE; k++) {
        const uint32_t i = jox_agents_add(a);
        const float kind = draw_steering_number(d, 0.0, 1.0);
        a->x[i] = kind < 0.1f ? 0.0f : draw_steering_number(d, -50.0, 50.0);
        a->y[i] = kind < 0.05f ? 0.0f : draw_steering_number(d, -50.0, 50.0);
        a->vx[i] = kind < 0.3f ? 0.0f : draw_steering_number(d, -1.5, 1.5);
        a->vy[i] = kind < 0.35f ? 0.0f : draw_steering_number(d, -1.5, 1.5);
        a->density[i] = draw_steering_number(d, 0.0, 9.0);
        a->face_x[i] = 1.0f;
        a->face_y[i] = 0.0f;
        jox_param_set(a, JOX_PARAM_speed, i, draw_steering_number(d, 0.0, 2.0));
        jox_param_set(a, JOX_PARAM_max_speed, i, draw_steering_number(d, 0.2, 3.0));
    }
}

/* Fills a batch with some of the agents, in ascending order, with gaps. */
static void pick_random_batch(JoxSteer *s, JoxAgents *a, Draws *d) {
    *s = (JoxSteer){.agents = a, .args = ORBIT};
    for (uint32_t i = 0; i < a->count; i++)
        if (d->number == 0 || draw_steering_number(d, 0.0, 1.0) < 0.7f)
            s->index[s->count++] = i;
    assert_true(s->count > 0);
    for (uint32_t n = s->count; n < JOX_BATCH; n++)
        s->index[n] = s->index[s->count - 1];
}

/* ---- references ---- */

static JoxV2 find_orbit_way(const JoxAgents *a, const JoxPlace *place, uint32_t i) {
    JoxV2 p = {a->x[i], a->y[i]}, ab = jox_sub(place->axis_b, place->axis_a), axis = place->axis_a;
    if (jox_length2(ab) > 0.0f) {
        float t = jox_clampf(jox_dot(jox_sub(p, axis), ab) / jox_length2(ab), 0.0f, 1.0f);
        axis = jox_add(axis, jox_scale(ab, t));
    }
    JoxV2 out = jox_sub(p, axis), normal = jox_unit(out);
    float distance = jox_length(out) - place->axis_radius;
    float near = (float)ORBIT[JOX_ORBIT_DENSITY_NEAR], far = (float)ORBIT[JOX_ORBIT_DENSITY_FAR];
    float share = jox_clampf(distance / (float)ORBIT[JOX_ORBIT_FAR], 0.0f, 1.0f);
    float lacks = jox_clampf(near + (far - near) * share - a->density[i], -0.1f, 1.0f);
    float inward =
        distance > (float)ORBIT[JOX_ORBIT_RETURN] ? 0.6f : (float)ORBIT[JOX_ORBIT_INWARD] * lacks;
    return jox_unit(jox_sub(jox_left(normal), jox_scale(normal, inward)));
}

static JoxV2 add_weighted_way(JoxV2 sum, JoxV2 way, float by) {
    if (!jox_weight_counts(by))
        return sum;
    if (!(jox_length2(way) <= 1e12f))
        way = (JoxV2){0.0f, 0.0f};
    return jox_add(sum, jox_scale(way, by));
}

static JoxV2 find_preferred_velocity(const JoxAgents *a, JoxV2 sum, uint32_t i) {
    float speed = jox_minf(jox_param(a, JOX_PARAM_speed, i), jox_param(a, JOX_PARAM_max_speed, i));
    return jox_scale(jox_length2(sum) > 1.0f ? jox_unit(sum) : sum, speed);
}

/* ---- comparisons ---- */

static void assert_same_vector(JoxV2 is, JoxV2 wanted) {
    assert_memory_equal(&is, &wanted, sizeof is);
}

typedef struct Kernels {
    JoxSteerKernel *orbit, *add, *finish, *face;
} Kernels;

/* Orbits for a range of the batch; nothing else may be written. */
static void compare_orbit(const Kernels *k, JoxSteer *s, const JoxPlace *place, Draws *d) {
    s->begin = (uint32_t)draw_steering_number(d, 0.0, s->count * 0.5);
    s->end = d->number == 0 ? s->count
                            : s->begin + 1 + (uint32_t)draw_steering_number(d, 0.0, s->count * 0.4);
    s->place = d->number % 7 == 6 ? NULL : place;
    for (uint32_t n = 0; n < JOX_BATCH; n++)
        s->way_x[n] = s->way_y[n] = 77.0f;
    k->orbit(s);
    for (uint32_t n = 0; n < s->count; n++) {
        JoxV2 wanted = {77.0f, 77.0f};
        if (n >= s->begin && n < s->end)
            wanted = s->place ? find_orbit_way(s->agents, place, s->index[n]) : (JoxV2){0.0f, 0.0f};
        assert_same_vector((JoxV2){s->way_x[n], s->way_y[n]}, wanted);
    }
}

static void compare_sums(const Kernels *k, JoxSteer *s, Draws *d) {
    static const float HARD[] = {0.0f, -0.0f, INFINITY, -INFINITY, NAN, 1e30f, 2e6f, -1e6f};
    JoxV2 sums[JOX_BATCH] = {{0}};
    for (uint32_t term = 0; term < 3; term++) {
        for (uint32_t n = 0; n < s->count; n++) {
            const uint32_t kind = (uint32_t)draw_steering_number(d, 0.0, 40.0);
            s->way_x[n] = kind < 8 ? HARD[kind] : draw_steering_number(d, -1.0, 1.0);
            s->way_y[n] = draw_steering_number(d, -1.0, 1.0);
            s->by[n] = kind >= 32 ? HARD[kind - 32] : draw_steering_number(d, -2.0, 2.0);
            sums[n] = add_weighted_way(sums[n], (JoxV2){s->way_x[n], s->way_y[n]}, s->by[n]);
        }
        k->add(s);
    }
    for (uint32_t n = 0; n < s->count; n++)
        assert_same_vector((JoxV2){s->sum_x[n], s->sum_y[n]}, sums[n]);
    k->finish(s);
    for (uint32_t n = 0; n < s->count; n++) {
        const uint32_t i = s->index[n];
        assert_same_vector((JoxV2){s->agents->pref_x[i], s->agents->pref_y[i]},
                           find_preferred_velocity(s->agents, sums[n], i));
    }
}

static void compare_faces(const Kernels *k, JoxSteer *s) {
    const JoxAgents *a = s->agents;
    uint32_t turned = 0;
    k->face(s);
    for (uint32_t n = 0; n < s->count; n++) {
        const uint32_t i = s->index[n];
        const JoxV2 v = {a->vx[i], a->vy[i]};
        const bool moves = jox_length2(v) > 0.0025f && !jox_stands(a, i);
        assert_same_vector((JoxV2){a->face_x[i], a->face_y[i]},
                           moves ? jox_unit(v) : jox_v2(1.0f, 0.0f));
        turned += moves;
    }
    assert_true(turned > s->count / 4 && turned < s->count);
}

static void kernels_agree_with_scalar_references(void **state) {
#define X(name, isa)                                                                               \
    [isa] = {jox_steer_orbit_##name, jox_steer_add_##name, jox_steer_finish_##name,                \
             jox_steer_face_##name},
    static const Kernels KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X
    static const JoxPlace PLACES[2] = {
        {.axis_a = {-3.0f, 1.0f}, .axis_b = {4.0f, -2.0f}, .axis_radius = 6.0f},
        {.axis_radius = 2.0f}}; /* an axis of length 0 */
    static JoxSteer steer;
    (void)state;
    for (JoIsa isa = JO_ISA_SCALAR; isa <= JO_ISA_AVX512; isa++)
        for (uint32_t number = 0; jox_isa_runs(isa) && number < CASES; number++) {
            Draws draws = {.number = number};
            JoxAgents agents = {0};
            add_random_agents(&agents, &draws);
            pick_random_batch(&steer, &agents, &draws);
            compare_orbit(&KERNELS[isa], &steer, &PLACES[number % 2], &draws);
            compare_sums(&KERNELS[isa], &steer, &draws);
            compare_faces(&KERNELS[isa], &steer);
            jox_agents_free(&agents);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(kernels_agree_with_scalar_references)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
