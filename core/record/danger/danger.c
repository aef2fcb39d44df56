#include "record/danger/danger.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/elementary.h"
#include "base/mem.h"
#include "record/danger/danger_parts.h"

static const double PACE = 0.5;                /* s between samples of the fields */
static const double HOLD = 1.0;                /* s: time constant of what a person bears */
static const double START = 5.0;               /* s at first whose velocities are left out, */
static const double CALM = 10.0;               /* s: time constant of means at a place */
static const float FINE = 0.2f, COARSE = 0.4f; /* m: of cells */
static const float FEW = 1e5f;                 /* cells: areas of more have coarser ones */
static const float KERNEL = 0.70710678f;       /* m: R / sqrt 2, R = 1 m, of exp(-d2 / R2) */
static const float LEAST = 0.02f; /* 1/m2: below this nobody is there to have a velocity */

/* ---- measuring ---- */

JoxDanger *jox_danger_create(JoxV2 low, JoxV2 high) {
    JoxDanger *d = jox_alloc(1, sizeof *d);
    float cell = sqrtf((high.x - low.x) * (high.y - low.y) / FEW);
    d->grid = jox_density_create(low, high, jox_clampf(cell, FINE, COARSE), KERNEL);
    size_t cells = (size_t)d->grid->columns * d->grid->rows;
    float **fields[] = {&d->density, &d->flow_x,      &d->flow_y, &d->mean_density, &d->mean_vx,
                        &d->mean_vy, &d->mean_square, &d->weight, &d->pressure};
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++)
        *fields[f] = jox_alloc(cells, sizeof(float));
    for (int m = 0; m < JOX_DANGER_MAPPED; m++) {
        d->sum[m] = jox_alloc(cells, sizeof(double));
        d->greatest[m] = jox_alloc(cells, sizeof(float));
    }
    for (int m = 0; m < JOX_DANGER_MEASURES; m++)
        d->most[m] = (JoxDangerMost){.value = NAN, .time = NAN};
    d->stood = jox_alloc(cells, sizeof *d->stood);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++)
        d->counts[l].first = NAN;
    d->last_frame = d->last_sample = NAN;
    d->stretch = INT64_MIN;
    return d;
}

/* The cell of a point; false outside the area. */
static bool cell_of(const JoxDensity *g, float x, float y, size_t *cell) {
    float column = floorf((x - g->low.x) / g->cell), row = floorf((y - g->low.y) / g->cell);
    if (!(column >= 0.0f && column < (float)g->columns && row >= 0.0f && row < (float)g->rows))
        return false;
    *cell = (size_t)row * g->columns + (size_t)column;
    return true;
}

/* Person i has `value` for `duration` seconds; marks the limits passed. */
static void judge(JoxDanger *d, const JoxFrame *frame, uint32_t i, JoxDangerMeasure measure,
                  double value, double duration) {
    JoxV2 at = {frame->x[i], frame->y[i]};
    JoxDangerMost *most = &d->most[measure];
    JoxDangerPerson *person = &d->people[frame->key[i]];
    if (value > (isnan(most->value) ? 0.0 : most->value))
        *most = (JoxDangerMost){value, frame->time, at};
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        JoxDangerCount *count = &d->counts[l];
        if (jox_danger_limits[l].measure != measure || value < jox_danger_limits[l].value)
            continue;
        count->person_s += duration;
        person->seconds[l] += duration;
        count->longest = fmax(count->longest, person->seconds[l]);
        if (isnan(count->first)) {
            count->first = frame->time;
            count->first_at = at;
        }
        count->people += !(person->over >> l & 1);
        person->over |= (uint8_t)(1 << l);
    }
}

/* Every frame: what person i bears now, and the dose of it until now. */
static void bear(JoxDanger *d, const JoxFrame *frame, uint32_t i, double duration, float share) {
    JoxDangerPerson *p = &d->people[frame->key[i]];
    if (frame->compression) {
        p->compression += share * (frame->compression[i] - p->compression);
        judge(d, frame, i, JOX_DANGER_COMPRESSION, p->compression, duration);
    }
    if (!frame->load)
        return;
    p->load += share * (frame->load[i] - p->load);
    p->dose += duration * jox_danger_dose_rate(p->load);
    if (p->load > p->most) {
        p->most = p->load;
        p->most_time = frame->time;
        p->most_at = (JoxV2){frame->x[i], frame->y[i]};
    }
    judge(d, frame, i, JOX_DANGER_LOAD, p->load, duration);
    judge(d, frame, i, JOX_DANGER_DOSE, p->dose, duration);
}

static void press(JoxDanger *d, const JoxFrame *frame) {
    double duration = isnan(d->last_frame) ? 0.0 : frame->time - d->last_frame;
    float share = (float)(1.0 - jox_exp(-duration / HOLD));
    d->last_frame = frame->time;
    d->has_compression |= frame->compression != NULL;
    d->has_load |= frame->load != NULL;
    for (uint32_t i = 0; (frame->compression || frame->load) && i < frame->count; i++)
        bear(d, frame, i, duration, share);
}

/* Velocity of person i over the last sample interval: that of one step shakes with its contacts. */
static JoxV2 velocity(JoxDanger *d, const JoxFrame *frame, uint32_t i) {
    JoxStretch way;
    if (!jox_track_step(&d->track, frame, i, &way) || way.ended - way.begun > 2.0 * PACE)
        return (JoxV2){frame->vx[i], frame->vy[i]};
    return jox_scale(way.by, (float)(1.0 / (way.ended - way.begun)));
}

/* The fields of this sample; images over periodic edges count too. */
static void spread(JoxDanger *d, const JoxFrame *frame) {
    const JoxDensity *g = d->grid;
    size_t cells = (size_t)g->columns * g->rows;
    float *fields[3] = {d->density, d->flow_x, d->flow_y};
    for (int f = 0; f < 3; f++)
        memset(fields[f], 0, cells * sizeof(float));
    int across = frame->period.x > 0.0f, up = frame->period.y > 0.0f;
    float reach = ((float)g->reach + 1.0f) * g->cell;
    jox_track_reserve(&d->track, frame->keys);
    for (uint32_t i = 0; i < frame->count; i++) {
        JoxV2 v = velocity(d, frame, i);
        for (int c = -across; c <= across; c++)
            for (int r = -up; r <= up; r++) {
                float x = frame->x[i] + (float)c * frame->period.x;
                float y = frame->y[i] + (float)r * frame->period.y;
                if (x - g->low.x > -reach && y - g->low.y > -reach &&
                    x - g->low.x < (float)g->columns * g->cell + reach &&
                    y - g->low.y < (float)g->rows * g->cell + reach)
                    jox_density_spread(g, fields, (float[3]){1.0f, v.x, v.y}, 3, x, y);
            }
    }
}

/* Crowd pressure of each cell, from means over time in which this sample has its share. */
static void agitate(JoxDanger *d, double now, double duration) {
    bool moving = now - d->begun >= START - 1e-6;
    float enough = (float)(1.0 - jox_exp(-START / CALM)) * 0.999f;
    d->pressure_samples += now - d->begun >= 2.0 * START - 1e-6;
    size_t cells = (size_t)d->grid->columns * d->grid->rows;
    float share = (float)(1.0 - jox_exp(-duration / CALM)), stay = 1.0f - share;
    d->density_weight = stay * d->density_weight + share;
    float dense = (float)(jox_danger_limits[0].value * d->density_weight);
    for (size_t c = 0; c < cells; c++) {
        float density = d->density[c];
        d->mean_density[c] = stay * d->mean_density[c] + share * density;
        d->pressure[c] = 0.0f;
        if (density >= LEAST && moving) {
            float vx = d->flow_x[c] / density, vy = d->flow_y[c] / density;
            d->mean_vx[c] = stay * d->mean_vx[c] + share * vx;
            d->mean_vy[c] = stay * d->mean_vy[c] + share * vy;
            d->mean_square[c] = stay * d->mean_square[c] + share * (vx * vx + vy * vy);
            d->weight[c] = stay * d->weight[c] + share;
        }
        if (!(d->mean_density[c] >= dense && d->weight[c] >= enough))
            continue;
        float ux = d->mean_vx[c] / d->weight[c], uy = d->mean_vy[c] / d->weight[c];
        float variance = d->mean_square[c] / d->weight[c] - ux * ux - uy * uy;
        d->pressure[c] = d->mean_density[c] / (float)d->density_weight * jox_maxf(variance, 0.0f);
    }
}

/* Adds the sample to the maps. */
static void chart(JoxDanger *d, const JoxFrame *frame) {
    size_t cells = (size_t)d->grid->columns * d->grid->rows, cell;
    const float *fields[2] = {d->density, d->pressure};
    for (int m = 0; m < 2; m++)
        for (size_t c = 0; c < cells; c++) {
            d->sum[m][c] += fields[m][c];
            d->greatest[m][c] = jox_maxf(d->greatest[m][c], fields[m][c]);
        }
    for (uint32_t i = 0; (frame->compression || frame->load) && i < frame->count; i++)
        if (cell_of(d->grid, frame->x[i], frame->y[i], &cell)) {
            const JoxDangerPerson *p = &d->people[frame->key[i]];
            d->sum[JOX_DANGER_COMPRESSION][cell] += p->compression;
            d->sum[JOX_DANGER_LOAD][cell] += p->load;
            d->stood[cell]++;
        }
    d->samples++;
}

/* The sample's line of danger.csv. */
static void note(JoxDanger *d, const JoxFrame *frame, const JoxExits *exits) {
    JOX_RESERVE(d->rows, d->row_capacity, d->row_count + 1);
    JoxDangerRow *row = &d->rows[d->row_count++];
    *row = (JoxDangerRow){.time = frame->time, .people = frame->count};
    for (uint32_t i = 0; i < frame->count; i++) {
        size_t cell;
        const JoxDangerPerson *p = &d->people[frame->key[i]];
        bool inside = cell_of(d->grid, frame->x[i], frame->y[i], &cell);
        const float values[JOX_DANGER_MEASURES] = {inside ? d->density[cell] : 0.0f,
                                                   inside ? d->pressure[cell] : 0.0f,
                                                   p->compression, p->load, (float)p->dose};
        for (int m = 0; m < JOX_DANGER_FIRST_BORNE; m++)
            row->most[m] = jox_maxf(row->most[m], values[m]);
        for (int l = 0; l < JOX_DANGER_LIMITS; l++)
            row->over[l] +=
                (double)values[jox_danger_limits[l].measure] >= jox_danger_limits[l].value;
    }
    row->left = exits ? (uint32_t)exits->left : 0;
    for (uint32_t e = 0; exits && e < exits->count && e < JOX_DANGER_EXITS; e++) {
        if (e >= d->exit_count)
            d->exit_names[d->exit_count++] = jox_strdup(exits->items[e].name);
        row->exits[e] = exits->items[e].people;
    }
}

/* Every frame: what is borne most, in the line of the sample that it follows and in the cells. The
   greatest of the lines and of the cells are so the greatest of all. */
static void keep_most(JoxDanger *d, const JoxFrame *frame) {
    JoxDangerRow *row = &d->rows[d->row_count - 1];
    for (uint32_t i = 0; (frame->compression || frame->load) && i < frame->count; i++) {
        size_t cell;
        const JoxDangerPerson *p = &d->people[frame->key[i]];
        const float values[] = {p->compression, p->load, (float)p->dose};
        const bool inside = cell_of(d->grid, frame->x[i], frame->y[i], &cell);
        for (int m = JOX_DANGER_FIRST_BORNE; m < JOX_DANGER_MEASURES; m++) {
            const float value = values[m - JOX_DANGER_FIRST_BORNE];
            row->most[m] = jox_maxf(row->most[m], value);
            if (inside && m < JOX_DANGER_MAPPED)
                d->greatest[m][cell] = jox_maxf(d->greatest[m][cell], value);
        }
    }
    if (!frame->compression)
        row->most[JOX_DANGER_COMPRESSION] = NAN;
    if (!frame->load)
        row->most[JOX_DANGER_LOAD] = row->most[JOX_DANGER_DOSE] = NAN;
}

/* Every PACE: fields, and who stands where they are over a limit. */
static void sample(JoxDanger *d, const JoxFrame *frame, const JoxExits *exits) {
    if (isnan(d->last_sample))
        d->begun = frame->time;
    double duration = isnan(d->last_sample) ? 0.0 : frame->time - d->last_sample;
    d->last_sample = frame->time;
    spread(d, frame);
    agitate(d, frame->time, duration > 0.0 ? duration : PACE);
    for (uint32_t i = 0; i < frame->count; i++) {
        size_t cell;
        if (!cell_of(d->grid, frame->x[i], frame->y[i], &cell))
            continue;
        judge(d, frame, i, JOX_DANGER_DENSITY, (double)d->density[cell], duration);
        judge(d, frame, i, JOX_DANGER_PRESSURE, (double)d->pressure[cell], duration);
    }
    chart(d, frame);
    note(d, frame, exits);
}

void jox_danger_frame(JoxDanger *d, const JoxFrame *frame, const JoxExits *exits) {
    JOX_RESERVE_ZEROED(d->people, d->people_capacity, frame->keys);
    press(d, frame);
    /* Times are multiples of a step, whose sum may fall short of them by a hair. */
    int64_t stretch = (int64_t)floor(frame->time / PACE + 1e-6);
    if (stretch != d->stretch)
        sample(d, frame, exits);
    d->stretch = stretch;
    keep_most(d, frame);
}

const float *jox_danger_field(const JoxDanger *d, JoxDangerMeasure measure,
                              const JoxDensity **grid) {
    *grid = d->grid;
    return measure == JOX_DANGER_PRESSURE ? d->pressure : d->density;
}

void jox_danger_free(JoxDanger *d) {
    if (!d)
        return;
    jox_density_free(d->grid);
    jox_free(d->track.items);
    void *fields[] = {d->density,  d->flow_x,  d->flow_y,      d->mean_density,
                      d->mean_vx,  d->mean_vy, d->mean_square, d->weight,
                      d->pressure, d->stood,   d->people,      d->rows};
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++)
        jox_free(fields[f]);
    for (int m = 0; m < JOX_DANGER_MAPPED; m++) {
        jox_free(d->sum[m]);
        jox_free(d->greatest[m]);
    }
    for (uint32_t e = 0; e < d->exit_count; e++)
        jox_free(d->exit_names[e]);
    jox_free(d);
}
