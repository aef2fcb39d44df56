/* Frames of worlds with storeys: positions on sheets in, figures as of one plane out. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "base/mem.h"
#include "geom/storeys.h"
#include "record/frame_track.h"

/* Lays out two storeys, 3 m apart, on a plan of 20 m x 10 m. A stair leads from x = 8 up to x = 14,
   about y = 5, 2 m wide. */
static JoxStoreys lay_out_two_storeys(void) {
    JoxStoreys s = {.storey_count = 2, .stair_count = 1};
    s.storeys = jox_alloc(2, sizeof *s.storeys);
    s.storeys[0] = (JoxStorey){jox_strdup("ground"), 0.0f};
    s.storeys[1] = (JoxStorey){jox_strdup("first"), 3.0f};
    s.stairs = jox_alloc(1, sizeof *s.stairs);
    s.stairs[0] = (JoxStair){.name = jox_strdup("north"), .upper = 1, .width = 2.0f};
    s.stairs[0].path = jox_alloc(2, sizeof *s.stairs[0].path);
    s.stairs[0].path[0] = jox_v2(8, 5);
    s.stairs[0].path[1] = jox_v2(14, 5);
    s.stairs[0].path_count = 2;
    jox_storeys_lay_out(&s, jox_v2(0, 0), jox_v2(20, 10));
    return s;
}

/* ---- tracks ---- */

static void agent_over_a_seam_walks_on_and_crosses_each_line_once(void **state) {
    (void)state;
    JoxStoreys storeys = lay_out_two_storeys();
    const uint32_t stair = storeys.stairs[0].sheet, key[1] = {0};
    const JoxV2 at[] = {jox_v2(7.95f, 5.2f), jox_on_sheet(&storeys, stair, jox_v2(8.1f, 5.1f))};
    const JoxV2 below[2] = {jox_v2(7.97f, 6), jox_v2(7.97f, 4)};
    const JoxV2 above[2] = {jox_on_sheet(&storeys, stair, jox_v2(8.02f, 6)),
                            jox_on_sheet(&storeys, stair, jox_v2(8.02f, 4))};
    JoxTrack track = {0};
    JoxStretch way;
    for (int k = 0; k < 2; k++) {
        const JoxFrame frame = {.time = 0.1 * k,
                                .count = 1,
                                .keys = 1,
                                .key = key,
                                .x = &at[k].x,
                                .y = &at[k].y,
                                .storeys = &storeys};
        jox_track_reserve(&track, &frame);
        assert_int_equal(jox_track_step(&track, &frame, 0, &way), k);
    }
    assert_near(way.by.x, 0.15, 1e-5);
    assert_near(way.by.y, -0.1, 1e-4);
    double time = 0.0;
    assert_int_equal(jox_stretch_crosses(&way, below[0], below[1], &time), 1);
    assert_near(time, 0.1 * 0.02 / 0.15, 1e-4);
    assert_int_equal(jox_stretch_crosses(&way, above[0], above[1], &time), 1);
    assert_near(time, 0.1 * 0.07 / 0.15, 1e-4);
    jox_free(track.items);
    jox_storeys_free(&storeys);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agent_over_a_seam_walks_on_and_crosses_each_line_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
