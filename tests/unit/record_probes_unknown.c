/* Probes that see too little for a figure, and the reasons that they give. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "record_crowd.h"

static const JoxV2 DOOR[] = {{0, 1}, {0, -1}}; /* +x crosses it from right to left */

/* Returns the reason why a figure has no value; NULL if it has one, or no reason is given. */
static const char *read_reason(const JoxProbe *p, const char *name) {
    const JoxFigures figures = jox_probe_figures(p);
    for (uint32_t f = 0; f < figures.count; f++)
        if (strcmp(figures.items[f].name, name) == 0)
            return isfinite(figures.items[f].value) ? NULL : figures.items[f].why;
    fail_msg("no figure %s", name);
    return NULL;
}

/* People all move in the same frame, or at times unrelated to their positions. */
static void front_without_speed_gives_reason(void **state) {
    (void)state;
    static const double CHANCE[] = {0, 0.31, 0.05, 0.27, 0.11, 0.3, 0.02, 0.2};
    static const char *const SAID[] = {"fewer than three", "at once",
                                       "did not begin to move later"};
    for (int k = 0; k < 3; k++) {
        JoxProbeDef def = default_probe_def(JOX_PROBE_DISPLACEMENT, NULL, 0);
        JoxProbe *p = jox_probe_create(&def);
        reset_crowd(k ? 8 : 2);
        for (int step = 0; step <= 100; step++) {
            for (uint32_t i = 0; i < crowd.count; i++) {
                const double go = 0.0625 * step - 1 - (k == 2 ? CHANCE[i] : 1e-8 * i);
                crowd.x[i] = (float)(0.4 * i + fmax(go, 0) * (1 + 1e-7 * i));
            }
            show_crowd(p, 0.0625 * step);
        }
        assert_true(isnan(figure_value(p, "front_speed")));
        assert_non_null(strstr(read_reason(p, "front_speed"), SAID[k]));
        jox_probe_free(p);
    }
}

/* Two people passing side by side are not a flow of a thousand per second. */
static void flow_needs_a_second(void **state) {
    (void)state;
    JoxProbeDef def = default_probe_def(JOX_PROBE_FLOW, DOOR, 2);
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(2);
    for (int step = 0; step <= 40; step++) {
        crowd.x[0] = (float)(0.1 * step - 2);
        crowd.x[1] = (float)(0.1 * step - 2.001);
        show_crowd(p, 0.1 * step);
    }
    assert_near(figure_value(p, "passages"), 2, 0);
    assert_true(isnan(figure_value(p, "flow")) && isnan(figure_value(p, "flow_all")));
    assert_non_null(strstr(read_reason(p, "flow_all"), "within a second"));
    JoxText text = {0};
    JoxJson json = jox_json_begin(&text, 0);
    jox_probe_json(p, &json, NULL);
    assert_non_null(strstr(text.data, "\"flow\": null"));
    assert_non_null(strstr(text.data, "\"why\": {\"flow\": \"not known"));
    jox_text_free(&text);
    jox_probe_free(p);
}

/* With nobody, one person, one frame or hardly any time, each figure of each probe is NAN or of a
   sane size. */
static void little_input_gives_no_huge_figures(void **state) {
    (void)state;
    static const JoxV2 LINE[] = {{5, 6}, {5, 4}, {7, 6}, {7, 4}};
    static const JoxV2 RING[] = {{4, 4}, {6, 4}, {6, 6}, {4, 6}};
    for (int kind = 0; kind < JOX_PROBE_KINDS; kind++)
        for (uint32_t people = 0; people < 3; people++)
            for (int frames = 0; frames < 3; frames++) {
                const bool ring = kind == JOX_PROBE_MEASURE;
                JoxProbeDef def = default_probe_def((JoxProbeKind)kind, ring ? RING : LINE,
                                                    kind == JOX_PROBE_FLOW           ? 2
                                                    : kind == JOX_PROBE_WINDING      ? 1
                                                    : kind == JOX_PROBE_DISPLACEMENT ? 0
                                                                                     : 4);
                def.high = (JoxV2){10, 10};
                def.window = 5, def.span = 10;
                def.states[0] = "A", def.states[1] = "B";
                JoxProbe *p = jox_probe_create(&def);
                reset_crowd(people);
                for (int f = 0; f < frames; f++) {
                    for (uint32_t i = 0; i < people; i++) {
                        crowd.x[i] = 4.9f + 0.2f * (float)f;
                        crowd.y[i] = 5.0f + 0.5f * (float)i;
                    }
                    show_crowd(p, 1.0 + 1e-6 * f); /* hardly any time */
                }
                const JoxFigures figures = jox_probe_figures(p);
                for (uint32_t f = 0; f < figures.count; f++)
                    if (fabs(figures.items[f].value) > 100.0)
                        fail_msg("kind %d, %u people, %d frames: %s is %g", kind, people, frames,
                                 figures.items[f].name, figures.items[f].value);
                jox_probe_free(p);
            }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(front_without_speed_gives_reason),
        cmocka_unit_test(flow_needs_a_second),
        cmocka_unit_test(little_input_gives_no_huge_figures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
