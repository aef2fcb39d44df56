/* Samples density, flow and crowd pressure of frames every half second. The velocity in flow and
   pressure is that between samples. */
#include "record/local_samples.h"

#include <math.h>

#include "base/mem.h"

static const float COARSE = 0.4f; /* m: largest cell */
static const float FEW = 1e5f;    /* areas of more cells than this get larger cells */

JoxDensity *jox_local_grid(JoxV2 low, JoxV2 high, const JoxStoreys *storeys) {
    const float depth = jox_density_depth(storeys, low, high);
    const float cell = sqrtf((high.x - low.x) * depth / FEW);
    return jox_density_create_on_storeys(low, high, jox_clampf(cell, JOX_DENSITY_CELL, COARSE),
                                         JOX_DENSITY_KERNEL, storeys);
}

JoxLocal *jox_local_create(JoxV2 low, JoxV2 high, const JoxStoreys *storeys) {
    JoxLocal *l = jox_alloc(1, sizeof *l);
    l->grid = jox_local_grid(low, high, storeys);
    l->time = NAN;
    l->half_second = INT64_MIN;
    return l;
}

/* Tells crowd pressure which rows are those of one storey: others lie between two. */
static void set_pressure_blocks(JoxLocal *l) {
    const uint32_t rows = l->grid->rows;
    uint32_t *first = jox_alloc(2 * (size_t)rows + 1, sizeof *first), *end = first + rows;
    for (uint32_t r = 0, begun = 0; r < rows; r++) {
        const bool between = isnan(jox_density_middle(l->grid, (size_t)r * l->grid->columns).y);
        first[r] = begun;
        end[r] = r + 1;
        for (uint32_t k = begun; k < r && !between; k++)
            end[k] = r + 1;
        if (between)
            begun = r + 1;
    }
    jox_pressure_set_blocks(l->pressure, first, end);
    jox_free(first);
}

void jox_local_enable_pressure(JoxLocal *l) {
    size_t cells = (size_t)l->grid->columns * l->grid->rows;
    if (l->pressure)
        return;
    l->flow_x = jox_alloc(cells, sizeof *l->flow_x);
    l->flow_y = jox_alloc(cells, sizeof *l->flow_y);
    l->pressure = jox_pressure_create(l->grid->columns, l->grid->rows, l->grid->cell);
    if (jox_density_storeys_of(l->grid))
        set_pressure_blocks(l);
}

/* Returns the velocity of person i over the time since the last sample. The velocity of a single
   step shakes with its contact forces. */
static JoxV2 measure_velocity(JoxLocal *l, const JoxFrame *frame, uint32_t i) {
    JoxStretch way;
    if (!jox_track_step(&l->track, frame, i, &way) ||
        !(way.ended > way.begun && way.ended - way.begun <= 2.0 * JOX_PRESSURE_PACE))
        return (JoxV2){frame->vx[i], frame->vy[i]};
    return jox_scale(way.by, (float)(1.0 / (way.ended - way.begun)));
}

/* Sets vx and vy for the selected people. */
static void measure_velocities_of_crowd(JoxLocal *l, const JoxFrame *frame, const uint8_t *seen) {
    jox_track_reserve(&l->track, frame);
    if (frame->count > l->people) {
        l->people = frame->count;
        l->vx = jox_realloc(l->vx, l->people, sizeof *l->vx);
        l->vy = jox_realloc(l->vy, l->people, sizeof *l->vy);
    }
    for (uint32_t i = 0; i < frame->count; i++) {
        if (seen && !seen[i])
            continue;
        const JoxV2 v = measure_velocity(l, frame, i);
        l->vx[i] = v.x;
        l->vy[i] = v.y;
    }
}

/* Returns the number of the half second that t lies in. Times are sums of steps and may fall short
   of a multiple by rounding. */
static int64_t find_half_second(double t) {
    return (int64_t)floor(t / JOX_PRESSURE_PACE + 1e-6);
}

bool jox_local_is_due(const JoxLocal *l, double t) {
    return find_half_second(t) != l->half_second;
}

bool jox_local_frame(JoxLocal *l, const JoxFrame *frame, const uint8_t *seen) {
    if (!jox_local_is_due(l, frame->time))
        return false;
    l->half_second = find_half_second(frame->time);
    l->time = frame->time;
    l->samples++;
    if (l->pressure)
        measure_velocities_of_crowd(l, frame, seen);
    const JoxDensityCrowd crowd = {.count = frame->count,
                                   .x = frame->x,
                                   .y = frame->y,
                                   .period = frame->period,
                                   .seen = seen,
                                   .weights = {NULL, l->vx, l->vy}};
    jox_density_storeys(l->grid, frame->storeys);
    jox_density_walls(l->grid, jox_frame_dividing_walls(frame));
    jox_density_sample(l->grid, &crowd, l->pressure ? 3 : 1,
                       (float *[]){l->grid->now, l->flow_x, l->flow_y});
    jox_density_update_statistics(l->grid, frame->time, frame->time >= l->mean_from - 1e-9);
    if (l->tracked) /* in the first sample, velocities since the last are unknown */
        jox_pressure_add(l->pressure, frame->time, l->grid->now, l->flow_x, l->flow_y);
    l->tracked = l->pressure != NULL;
    return true;
}

float jox_local_pressure(const JoxLocal *l, size_t cell) {
    return l->pressure ? jox_pressure_now(l->pressure)[cell] : NAN;
}

void jox_local_sections(JoxLocal *l, JoxSections *s) {
    jox_density_sections(l->grid, s);
    JOX_SECTION(s, "time", l->time);
    JOX_SECTION(s, "samples", l->samples);
    JOX_SECTION(s, "stretch", l->half_second);
    if (jox_section_count(s, "pressure", l->pressure != NULL, 1) == 0)
        return;
    jox_local_enable_pressure(l);
    JOX_SECTION(s, "tracked_last", l->tracked);
    jox_track_sections(&l->track, s);
    jox_pressure_sections(l->pressure, s);
}

void jox_local_free(JoxLocal *l) {
    if (!l)
        return;
    jox_density_free(l->grid);
    jox_pressure_free(l->pressure);
    jox_free(l->flow_x);
    jox_free(l->flow_y);
    jox_free(l->vx);
    jox_free(l->vy);
    jox_free(l->track.items);
    jox_free(l);
}
