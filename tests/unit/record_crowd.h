/* A crowd for tests of probes, its frames, and figures of a probe. */
#ifndef JOSTLE_TESTS_RECORD_CROWD_H
#define JOSTLE_TESTS_RECORD_CROWD_H

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

#include "base/mem.h"
#include "picture/probe_files.h"
#include "record/probes/probe.h"

enum { MOST = 1000 };

/* The crowd; tests set its columns and show it to a probe frame by frame. */
static struct {
    uint32_t count, key[MOST];
    float x[MOST], y[MOST], vx[MOST], vy[MOST], compression[MOST], load[MOST];
    uint8_t failed[MOST];
    uint16_t group[MOST];
    uint32_t state[MOST];
    const uint32_t *kicked, *struck;
    const JoxObjects *objects;
    JoxV2 period;
    JoxWalls walls;
} crowd;

static inline void reset_crowd(uint32_t count) {
    memset(&crowd, 0, sizeof crowd);
    crowd.count = count;
    for (uint32_t i = 0; i < count; i++)
        crowd.key[i] = i;
}

static const char *const STATES[] = {"Walk", "Wait", "Served"};

static inline void show_crowd(JoxProbe *probe, double t) {
    const JoxFrame frame = {.time = t,
                            .count = crowd.count,
                            .period = crowd.period,
                            .keys = crowd.count,
                            .key = crowd.key,
                            .x = crowd.x,
                            .y = crowd.y,
                            .vx = crowd.vx,
                            .vy = crowd.vy,
                            .compression = crowd.compression,
                            .load = crowd.load,
                            .failed = crowd.failed,
                            .group = crowd.group,
                            .state = crowd.state,
                            .states = STATES,
                            .state_count = 3,
                            .kicked = crowd.kicked,
                            .struck = crowd.struck,
                            .objects = crowd.objects,
                            .walls = &crowd.walls};
    jox_probe_frame(probe, &frame);
}

static inline double figure_value(const JoxProbe *probe, const char *name) {
    JoxFigures figures = jox_probe_figures(probe);
    for (uint32_t f = 0; f < figures.count; f++)
        if (!strcmp(figures.items[f].name, name))
            return figures.items[f].value;
    fail_msg("there is no figure %s", name);
    return NAN;
}

#define assert_near(value, wanted, within)                                                         \
    do {                                                                                           \
        double was = (value), right = (wanted);                                                    \
        if (!(fabs(was - right) <= (within)))                                                      \
            fail_msg("%s is %.9g, not %.9g", #value, was, right);                                  \
    } while (0)

static inline JoxProbeDef default_probe_def(JoxProbeKind kind, const JoxV2 *points,
                                            uint32_t count) {
    return (JoxProbeDef){.name = "probe",
                         .kind = kind,
                         .until = INFINITY,
                         .points = points,
                         .count = count,
                         .states = {"Wait", "Served"},
                         .every = 1,
                         .cutoff = 1,
                         .onset = 0.05,
                         .low = {-5, -5},
                         .high = {5, 5},
                         .cell = 0.1,
                         .kernel = 0.5,
                         .rows = 0.4};
}

/* Writes a probe's CSV file to `text`, cut to its size. */
static inline void read_probe_csv(const JoxProbe *probe, char *text, size_t size) {
    FILE *file = tmpfile();
    assert_non_null(file);
    jox_probe_csv(probe, file);
    rewind(file);
    const size_t length = fread(text, 1, size - 1, file);
    assert_true(length > 0);
    text[length] = 0;
    fclose(file);
}

#endif
