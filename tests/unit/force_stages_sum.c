/* The kernels of equations 10 to 12 and of equations 8 and 9 against the plain paths for one agent
   (force_one.h), on every instruction set that the machine runs: over random columns and hard ones,
   without any force, with faint, huge and infinite ones, for agents that stand and walk, in contact
   or not. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/number/random.h"
#include "force/push/pass_on.h"
#include "force/stages/kernels.h"
#include "unit/force_one.h"

enum { PEOPLE = 4 * JOX_LANES - 5, CROWDS = 30 }; /* the last packet is not full */

typedef struct Draws {
    uint32_t number, drawn;
} Draws;

static float draw_sum(Draws *d, double from, double to) {
    double unit = jox_random_unit(21, d->number, 0, JOX_DRAW_FILL, d->drawn++);
    return (float)(from + (to - from) * unit);
}

/* Draws a number up to `most`, often 0, sometimes faint or huge. */
static float draw_uneven(Draws *d, float most) {
    float kind = draw_sum(d, 0.0, 1.0), size = draw_sum(d, -most, most);
    if (kind < 0.3f)
        return kind < 0.1f ? -0.0f : 0.0f;
    return kind < 0.4f ? 1e-7f * size : kind > 0.99f ? 1e37f * size : size;
}

static void fill_sum_columns(JoxAgents *a, Draws *d) {
    for (uint32_t k = 0; k < PEOPLE; k++) {
        uint32_t i = jox_agents_add(a);
        a->vx[i] = draw_uneven(d, 2.0f);
        a->vy[i] = draw_uneven(d, 2.0f);
        a->pref_x[i] = draw_sum(d, -0.3, 0.3); /* some stand */
        a->pref_y[i] = draw_sum(d, -0.1, 0.1);
        a->ext_x[i] = draw_uneven(d, 50.0f);
        a->inferred_x[i] = draw_uneven(d, 300.0f);
        a->inferred_y[i] = draw_uneven(d, 300.0f);
        a->push_y[i] = draw_uneven(d, 300.0f);
        a->contact_x[i] = draw_sum(d, 0.0, 1.0) < 0.5f ? 0.0f : draw_uneven(d, 900.0f);
        a->contact_y[i] = a->contact_x[i] == 0.0f ? 0.0f : draw_uneven(d, 900.0f);
        a->feet_y[i] = draw_sum(d, 0.0, 1.0) < 0.7f ? 0.0f : draw_uneven(d, 60.0f);
        jox_param_set(a, JOX_PARAM_mass, i, draw_sum(d, 40.0, 120.0));
        jox_param_set(a, JOX_PARAM_damping, i, d->number % 2 ? draw_sum(d, 1.0, 4.0) : 2.5f);
        jox_param_set(a, JOX_PARAM_brace, i, draw_sum(d, 0.0, 400.0));
        if (d->number % 3 == 0 && k / JOX_LANES % 2) /* whole packets without any force */
            a->ext_x[i] = a->inferred_x[i] = a->inferred_y[i] = a->push_y[i] = a->contact_x[i] =
                a->contact_y[i] = a->feet_y[i] = 0.0f;
    }
}

static bool are_same_bits(const float *a, const float *b) {
    return memcmp(a, b, PEOPLE * sizeof *a) == 0;
}

/* Lists the columns that sum writes. */
enum { COLUMNS = 8 };
static void list_sum_columns(JoxForces *f, float *out[COLUMNS]) {
    JoxAgents *a = f->step.agents;
    float *columns[COLUMNS] = {a->force_x,           a->force_y,      a->forced_x,
                               a->forced_y,          a->half_plane_x, a->half_plane_y,
                               a->half_plane_offset, a->speed_limit};
    memcpy(out, columns, sizeof columns);
}

/* Moves agents after a plan was made: some keep to it, some fall short, some stop. */
static void move_as_planned(JoxAgents *a, JoxForces *f, Draws *d) {
    for (uint32_t i = 0; i < PEOPLE; i++) {
        const float kept = draw_sum(d, -0.2, 1.2);
        a->next_x[i] = kept * a->forced_x[i];
        a->next_y[i] = draw_sum(d, 0.0, 1.0) < 0.2f ? draw_uneven(d, 1.0f) : kept * a->forced_y[i];
        a->vx[i] = draw_sum(d, 0.0, 1.0) < 0.1f ? 0.0f : a->next_x[i];
        a->vy[i] = a->next_y[i];
        jox_param_set(a, JOX_PARAM_absorb, i,
                      draw_sum(d, 0.0, 1.0) < 0.1f ? 0.0f : draw_sum(d, 0.1, 0.9));
        jox_param_set(a, JOX_PARAM_brace_angle, i, draw_sum(d, -0.2, 1.0));
        if (draw_sum(d, 0.0, 1.0) < 0.3f)
            a->half_plane_x[i] = a->half_plane_y[i] = 0.0f;
        if (draw_sum(d, 0.0, 1.0) < 0.1f)
            f->step.neighbours->motions[i].vx = f->step.neighbours->motions[i].vy = 0.0f;
    }
}

static void compare_passing(JoxInferKernel *kernel, JoxForces *f, uint32_t counts[3]) {
    JoxPassing passing;
    JoxDecay decay = {-1.0f, 0.0f, 0.0f};
    kernel(f, 0, PEOPLE, &passing);
    for (uint32_t i = 0; i < PEOPLE; i++) {
        float shortfall;
        const JoxPassKind kind = plain_pass_kind(f, i, &decay, &shortfall);
        assert_int_equal(passing.kind[i], kind);
        counts[kind]++;
        if (kind == JOX_PASSES_RESISTANCE)
            assert_memory_equal(&passing.shortfall[i], &shortfall, sizeof shortfall);
    }
}

/* Returns how many agents feel a force. */
static uint32_t compare_sum_crowd(JoIsa isa, JoxSumKernel *kernel, JoxInferKernel *infer,
                                  uint32_t number, uint32_t passed[3]) {
    static float by_kernel[COLUMNS][PEOPLE];
    Draws d = {.number = number};
    JoxAgents a = {0};
    fill_sum_columns(&a, &d);
    JoxNeighbours near = {0};
    jox_neighbours_reserve(&near, PEOPLE, 1);
    for (uint32_t i = 0; i < PEOPLE; i++)
        near.motions[i] = (JoxMotion){a.x[i], a.y[i], a.vx[i], a.vy[i]};
    const JoxStep step = {.timing = {.dt = number % 3 ? 0.05 : 0.01,
                                     .planning_time = 0.05,
                                     .response = 0.6,
                                     .interval = 0.05,
                                     .interval_response = 0.7,
                                     .interval_forced = 0.04},
                          .agents = &a,
                          .neighbours = &near};
    JoxForces *f = jox_forces_create(NULL);
    float *columns[COLUMNS], saved[4][PEOPLE];
    uint32_t felt = 0;
    jox_forces_set_isa(f, isa);
    /* begin zeroes the forces of the step */
    memcpy(saved[0], a.push_y, sizeof saved[0]);
    memcpy(saved[1], a.contact_x, sizeof saved[1]);
    memcpy(saved[2], a.contact_y, sizeof saved[2]);
    memcpy(saved[3], a.feet_y, sizeof saved[3]);
    jox_force_begin(f, &step, &(JoxForceInputs){0});
    memcpy(a.push_y, saved[0], sizeof saved[0]);
    memcpy(a.contact_x, saved[1], sizeof saved[1]);
    memcpy(a.contact_y, saved[2], sizeof saved[2]);
    memcpy(a.feet_y, saved[3], sizeof saved[3]);
    list_sum_columns(f, columns);
    for (uint32_t k = 0; k < COLUMNS; k++) /* left from the last step */
        for (uint32_t i = 0; i < PEOPLE; i++)
            columns[k][i] = draw_uneven(&d, 100.0f);
    kernel(f, 0, PEOPLE);
    for (uint32_t k = 0; k < COLUMNS; k++) {
        memcpy(by_kernel[k], columns[k], sizeof by_kernel[k]);
        memset(columns[k], 0xff, sizeof by_kernel[k]);
    }
    JoxDecay decay = {-1.0f, 0.0f, 0.0f};
    for (uint32_t i = 0; i < PEOPLE; i++) {
        plain_sum_one(f, i, &decay);
        felt += a.half_plane_x[i] != 0.0f || a.half_plane_y[i] != 0.0f;
    }
    for (uint32_t k = 0; k < COLUMNS; k++)
        assert_true(are_same_bits(by_kernel[k], columns[k]));
    move_as_planned(&a, f, &d);
    compare_passing(infer, f, passed);
    jox_forces_free(f);
    jox_agents_free(&a);
    jox_neighbours_free(&near);
    return felt;
}

static void test_sum(void **state) {
#define X(name, isa) [isa] = jox_sum_packets_##name,
    static JoxSumKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X
#define X(name, isa) [isa] = jox_infer_packets_##name,
    static JoxInferKernel *const INFER[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X
    (void)state;
    for (JoIsa isa = JO_ISA_SCALAR; isa <= JO_ISA_NEON; isa++) {
        uint32_t felt = 0, passed[3] = {0};
        for (uint32_t number = 0; jox_isa_runs(isa) && number < CROWDS; number++)
            felt += compare_sum_crowd(isa, KERNELS[isa], INFER[isa], number, passed);
        assert_true(!jox_isa_runs(isa) ||
                    (felt > CROWDS * PEOPLE / 4 && felt < CROWDS * PEOPLE * 99 / 100));
        for (uint32_t kind = 0; jox_isa_runs(isa) && kind < 3; kind++)
            assert_true(passed[kind] > CROWDS * PEOPLE / 50);
    }
}

static void slowing_differs_from_turning(void **state) {
    (void)state;
    /* Half-angle 60: from (1, 0) to 0.9 at 90 degrees the change is (-1, 0.9), the mean (0.5,
       0.45): the cosine between them is -0.095 / (1.3454 * 0.6727) = -0.105. */
    JoxV2 before = {1.0f, 0.0f};
    float cosine = jox_parameter_store(JOX_PARAM_brace_angle, 60);
    assert_false(does_slow_down(before, jox_v2(0.0f, 0.9f), cosine));
    assert_true(does_slow_down(before, jox_v2(0.0f, 0.0f), cosine));
    assert_true(does_slow_down(before, jox_v2(0.5f, 0.0f), cosine));
    assert_true(does_slow_down(before, jox_v2(-0.5f, 0.0f), cosine));
    assert_false(does_slow_down(before, jox_v2(1.0f, 0.0f), cosine));
    assert_false(does_slow_down(before, jox_v2(1.1f, 0.0f), cosine));
    /* To 0.5 at 90 degrees: -0.75 / (1.1180 * 1.1180) = -0.6, within 60 degrees, not within 50. */
    assert_true(does_slow_down(before, jox_v2(0.0f, 0.5f), cosine));
    assert_false(does_slow_down(before, jox_v2(0.0f, 0.5f), 0.6428f));
    /* a cone of more than a half turn */
    assert_true(does_slow_down(before, jox_v2(0.0f, 0.9f), -0.5f));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_sum),
                                       cmocka_unit_test(slowing_differs_from_turning)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
