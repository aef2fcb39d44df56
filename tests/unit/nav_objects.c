/* Half-planes of bodies: the nearest bodies have one each, whatever their rows. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/mem.h"
#include "nav/orca/solve.h"

enum { PILLARS = 40 };

static void nearest_of_many_bodies_are_avoided(void **state) {
    (void)state;
    /* Pillars 0.5 to 2.45 m away all around, the farthest first; two are ignored, one does not
       exist. */
    JoxObject rows[PILLARS];
    for (int k = 0; k < PILLARS; k++) {
        float away = 0.5f + 0.05f * (float)(PILLARS - 1 - k), angle = 2.4f * (float)k;
        rows[k] = (JoxObject){.live = k != 37, .in_band = true, .disc = 0.1f, .round = 0.1f};
        rows[k].position = (JoxV3){away * cosf(angle), away * sinf(angle), 1.0f};
        rows[k].tags = k == 33 || k == 38 ? 2 : 1;
    }
    JoxObjects objects = {.rows = rows, .count = PILLARS};
    jox_objects_lay(&objects);
    JoxAgents agents = {0};
    JoxNav *nav = jox_nav_create(NULL);
    uint32_t i = jox_agents_add(&agents);
    agents.ignore[i] = 2;
    JoxHalfPlane planes[JOX_MOST_NEAREST];
    const JoxSolve solve = {
        .nav = nav,
        .step = {.timing = jox_timing_at_once(0.05), .agents = &agents, .objects = &objects}};
    for (uint32_t most = 1; most <= JOX_MOST_NEAREST; most++) {
        uint32_t made = jox_orca_objects(&solve, i, planes, most), at = most;
        assert_int_equal(made, most);
        for (int k = PILLARS - 1; at > 0; k--) { /* the nearest ones, which come last */
            if (k == 33 || k == 37 || k == 38)
                continue;
            /* The pillars rest: the agent may approach no faster than closes the gap within the
               horizon. */
            float away = jox_length(jox_v2(rows[k].position.x, rows[k].position.y));
            const JoxHalfPlane *plane = &planes[--at];
            assert_true(fabsf(plane->normal.x + rows[k].position.x / away) < 1e-5f);
            assert_true(fabsf(plane->normal.y + rows[k].position.y / away) < 1e-5f);
            assert_true(fabsf(plane->offset + (away - 0.3f) / 0.5f) < 1e-4f);
        }
    }
    jox_objects_free_grid(&objects);
    jox_agents_free(&agents);
    jox_nav_free(nav);
}

static void approached_body_counts_even_if_its_kind_is_ignored(void **state) {
    (void)state;
    /* Two balls at 1 m. The second is approached: it is not anticipated, but not run over within
       the planning time either (0.6 m in 0.05 s). */
    JoxObject rows[2];
    for (int k = 0; k < 2; k++) {
        rows[k] = (JoxObject){.live = true, .in_band = true, .disc = 0.2f, .round = 0.2f};
        rows[k].position = (JoxV3){0.0f, k ? 1.0f : -1.0f, 0.2f};
        rows[k].tags = 2;
    }
    JoxObjects objects = {.rows = rows, .count = 2};
    jox_objects_lay(&objects);
    JoxAgents agents = {0};
    JoxNav *nav = jox_nav_create(NULL);
    uint32_t i = jox_agents_add(&agents);
    agents.ignore[i] = 2;
    agents.approach[i] = 0;
    JoxHalfPlane planes[JOX_MOST_NEAREST];
    const JoxSolve solve = {
        .nav = nav,
        .step = {.timing = jox_timing_at_once(0.05), .agents = &agents, .objects = &objects}};
    assert_int_equal(jox_orca_objects(&solve, i, planes, 24), 0);
    agents.approach[i] = jox_reference(1);
    assert_int_equal(jox_orca_objects(&solve, i, planes, 24), 1);
    assert_true(fabsf(planes[0].normal.y + 1.0f) < 1e-5f);
    assert_true(fabsf(planes[0].offset + 0.6f / 0.05f) < 1e-3f);
    jox_objects_free_grid(&objects);
    jox_agents_free(&agents);
    jox_nav_free(nav);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_of_many_bodies_are_avoided),
        cmocka_unit_test(approached_body_counts_even_if_its_kind_is_ignored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
