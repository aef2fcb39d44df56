#include "record/danger/danger.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/elementary.h"
#include "base/mem.h"
#include "record/danger/danger_parts.h"

static const double PACE = 0.5;                /* s between samples of the fields */
static const double HOLD = 1.0;                /* s: time constant of a person's compression */
static const double START = 5.0;               /* s at first whose velocities are left out, */
static const double CALM = 10.0;               /* s: time constant of means at a place */
static const float FINE = 0.2f, COARSE = 0.4f; /* m: of cells */
static const float FEW = 1e5f;                 /* cells: areas of more have coarser ones */
static const float KERNEL = 0.70710678f;       /* m: R / sqrt 2, R = 1 m, of exp(-d2 / R2) */
static const float LEAST = 0.02f; /* 1/m2: below this nobody is there to have a velocity */

const char *const jox_danger_names[] = {"density", "pressure", "compression"};
const char *const jox_danger_units[] = {"1/m2", "1/s2", "N/m"};

/* N/m on somebody who is held between a load of so many newtons and what bears against it: felt on
   two sides, over the circumference of the default radius. */
#define HELD_BY(newtons) (2.0 * (newtons) / (2.0 * 3.14159265358979323846 * 0.20))
const char jox_danger_conversion[] =
    "Published loads are forces in newtons on somebody held between the load and what bears "
    "against it. The engine adds the magnitudes of all contact forces and divides by the "
    "circumference, so "
    "that a load F reads as 2 F over 2 pi 0.20 m = 1.26 m: 1000 N are 1592 N/m.";

const JoxDangerLimit jox_danger_limits[JOX_DANGER_LIMITS] = {
    {"density_5", JOX_DANGER_DENSITY, 5.0,
     "anything more crowded can become dangerous; dangerous crowd forces begin at 5.55",
     "G. K. Still, in the press, 30 October 2022; Fruin, in Wirz et al., EPJ Data Science 2, 5, "
     "2013"},
    {"density_7", JOX_DANGER_DENSITY, 7.0,
     "the crowd becomes almost a fluid mass; shock waves run through it",
     "J. J. Fruin, The causes and prevention of crowd disasters, 1993"},
    {"pressure_002", JOX_DANGER_PRESSURE, 0.02, "crowd turbulence sets in",
     "Helbing, Johansson, Al-Abideen, Phys. Rev. E 75, 046109, 2007"},
    /* Men pushed against a flat bar 100 mm wide; 800 N where they could brace themselves. */
    {"load_623", JOX_DANGER_COMPRESSION, HELD_BY(623.0),
     "623 N: the most that men bore against a bar 100 mm wide; women bore less",
     "Evans and Hayden 1971, in Lee and Hughes, Accid. Anal. Prev. 38, 2006, 712-722"},
    {"load_1112", JOX_DANGER_COMPRESSION, HELD_BY(1112.0),
     "1112 N: death estimated within 4 to 6 minutes",
     "Hopkins et al. 1993, in Lee and Hughes, Accid. Anal. Prev. 38, 2006, 712-722"},
    /* A force on a rail, not on one chest: what bent steel railings after disasters tell. */
    {"load_4500", JOX_DANGER_COMPRESSION, HELD_BY(4500.0),
     "4500 N: steel railings bent in fatal crowds: on a rail, not on one chest",
     "J. J. Fruin, The causes and prevention of crowd disasters, 1993"},
    {"load_6227", JOX_DANGER_COMPRESSION, HELD_BY(6227.0),
     "6227 N: death estimated within 15 seconds",
     "Hopkins et al. 1993, in Lee and Hughes, Accid. Anal. Prev. 38, 2006, 712-722"},
};

/* ---- exits ---- */

double jox_exits_clearance(const JoxExits *exits, uint32_t inside) {
    return exits->left && inside == 0 ? exits->last : NAN;
}

void jox_exits_json(const JoxExits *exits, uint32_t inside, JoxJson *json) {
    jox_json_whole(json, "left", exits->left);
    jox_json_whole(json, "inside", inside);
    jox_json_number(json, "last_left_s", exits->left ? exits->last : NAN);
    jox_json_number(json, "clearance_s", jox_exits_clearance(exits, inside));
    jox_json_object(json, "exits");
    for (uint32_t e = 0; e < exits->count; e++) {
        jox_json_object(json, exits->items[e].name);
        jox_json_whole(json, "people", exits->items[e].people);
        jox_json_number(json, "last_s", exits->items[e].last);
        jox_json_end(json);
    }
    jox_json_end(json);
}

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
    for (int m = 0; m < JOX_DANGER_MEASURES; m++) {
        d->sum[m] = jox_alloc(cells, sizeof(double));
        d->greatest[m] = jox_alloc(cells, sizeof(float));
        d->most[m] = (JoxDangerMost){.value = NAN, .time = NAN};
    }
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
    if (value > (isnan(most->value) ? 0.0 : most->value))
        *most = (JoxDangerMost){value, frame->time, at};
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        JoxDangerCount *count = &d->counts[l];
        if (jox_danger_limits[l].measure != measure || value < jox_danger_limits[l].value)
            continue;
        count->person_s += duration;
        if (isnan(count->first)) {
            count->first = frame->time;
            count->first_at = at;
        }
        count->people += !(d->over[frame->key[i]] >> l & 1);
        d->over[frame->key[i]] |= (uint8_t)(1 << l);
    }
}

/* Every frame: who is held how hard. */
static void press(JoxDanger *d, const JoxFrame *frame) {
    double duration = isnan(d->last_frame) ? 0.0 : frame->time - d->last_frame;
    float share = (float)(1.0 - jox_exp(-duration / HOLD));
    d->last_frame = frame->time;
    d->has_compression |= frame->compression != NULL;
    for (uint32_t i = 0; frame->compression && i < frame->count; i++) {
        float *held = &d->held[frame->key[i]];
        *held += share * (frame->compression[i] - *held);
        judge(d, frame, i, JOX_DANGER_COMPRESSION, *held, duration);
    }
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
    for (uint32_t i = 0; frame->compression && i < frame->count; i++)
        if (cell_of(d->grid, frame->x[i], frame->y[i], &cell)) {
            float held = d->held[frame->key[i]], *most = &d->greatest[JOX_DANGER_COMPRESSION][cell];
            d->sum[JOX_DANGER_COMPRESSION][cell] += held;
            d->stood[cell]++;
            *most = jox_maxf(*most, held);
        }
    d->samples++;
}

/* The sample's line of danger.csv. */
static void note(JoxDanger *d, const JoxFrame *frame, const JoxExits *exits) {
    JOX_RESERVE(d->rows, d->row_capacity, d->row_count + 1);
    JoxDangerRow *row = &d->rows[d->row_count++];
    *row = (JoxDangerRow){.time = frame->time, .people = frame->count, .most = {0, 0, 0}};
    for (uint32_t i = 0; i < frame->count; i++) {
        size_t cell;
        bool inside = cell_of(d->grid, frame->x[i], frame->y[i], &cell);
        float values[] = {inside ? d->density[cell] : 0.0f, inside ? d->pressure[cell] : 0.0f,
                          d->held[frame->key[i]]};
        for (int m = 0; m < JOX_DANGER_MEASURES; m++)
            row->most[m] = jox_maxf(row->most[m], values[m]);
        for (int l = 0; l < JOX_DANGER_LIMITS; l++)
            row->over[l] += values[jox_danger_limits[l].measure] >= jox_danger_limits[l].value;
    }
    if (!frame->compression)
        row->most[JOX_DANGER_COMPRESSION] = NAN;
    row->left = exits ? (uint32_t)exits->left : 0;
    for (uint32_t e = 0; exits && e < exits->count && e < JOX_DANGER_EXITS; e++) {
        if (e >= d->exit_count)
            d->exit_names[d->exit_count++] = jox_strdup(exits->items[e].name);
        row->exits[e] = exits->items[e].people;
    }
}

void jox_danger_frame(JoxDanger *d, const JoxFrame *frame, const JoxExits *exits) {
    JOX_RESERVE_ZEROED(d->held, d->held_capacity, frame->keys);
    JOX_RESERVE_ZEROED(d->over, d->over_capacity, frame->keys);
    press(d, frame);
    /* Times are multiples of a step, whose sum may fall short of them by a hair. */
    int64_t stretch = (int64_t)floor(frame->time / PACE + 1e-6);
    if (stretch == d->stretch)
        return;
    d->stretch = stretch;
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
        judge(d, frame, i, JOX_DANGER_DENSITY, d->density[cell], duration);
        judge(d, frame, i, JOX_DANGER_PRESSURE, d->pressure[cell], duration);
    }
    chart(d, frame);
    note(d, frame, exits);
}

/* ---- figures ---- */

const float *jox_danger_field(const JoxDanger *d, JoxDangerMeasure measure,
                              const JoxDensity **grid) {
    *grid = d->grid;
    return measure == JOX_DANGER_PRESSURE ? d->pressure : d->density;
}

JoxDangerCount jox_danger_count(const JoxDanger *d, int limit) {
    return d->counts[limit];
}

JoxDangerMost jox_danger_most(const JoxDanger *d, JoxDangerMeasure measure) {
    JoxDangerMost most = d->most[measure];
    bool read = (measure == JOX_DANGER_PRESSURE ? d->pressure_samples : d->samples) > 0 &&
                (measure != JOX_DANGER_COMPRESSION || d->has_compression);
    if (isnan(most.value) && read) /* nobody was ever pressed, say */
        most.value = 0.0;
    return most;
}

bool jox_danger_reads(const JoxDanger *d, JoxDangerMeasure measure) {
    return isfinite(jox_danger_most(d, measure).value);
}

/* "NAMESUFFIX": VALUE */
static void add(JoxJson *json, const char *name, const char *suffix, double value) {
    char key[64];
    snprintf(key, sizeof key, "%s%s", name, suffix);
    jox_json_number(json, key, value);
}

void jox_danger_json(const JoxDanger *d, JoxJson *json) {
    jox_json_whole(json, "samples", d->samples);
    for (int m = 0; m < JOX_DANGER_MEASURES; m++) {
        JoxDangerMost most = jox_danger_most(d, (JoxDangerMeasure)m);
        bool read = isfinite(most.time);
        add(json, jox_danger_names[m], "_max", most.value);
        add(json, jox_danger_names[m], "_max_s", most.time);
        add(json, jox_danger_names[m], "_max_x", read ? most.at.x : NAN);
        add(json, jox_danger_names[m], "_max_y", read ? most.at.y : NAN);
    }
    jox_json_object(json, "limits");
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        const JoxDangerCount *count = &d->counts[l];
        bool seen = isfinite(count->first);
        bool read = jox_danger_reads(d, jox_danger_limits[l].measure);
        jox_json_object(json, jox_danger_limits[l].key);
        jox_json_number(json, "people", read ? count->people : NAN);
        jox_json_number(json, "limit", jox_danger_limits[l].value);
        jox_json_number(json, "person_s", read ? count->person_s : NAN);
        jox_json_number(json, "first_s", count->first);
        jox_json_number(json, "first_x", seen ? count->first_at.x : NAN);
        jox_json_number(json, "first_y", seen ? count->first_at.y : NAN);
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_danger_free(JoxDanger *d) {
    if (!d)
        return;
    jox_density_free(d->grid);
    jox_free(d->track.items);
    void *fields[] = {d->density, d->flow_x,      d->flow_y, d->mean_density, d->mean_vx,
                      d->mean_vy, d->mean_square, d->weight, d->pressure,     d->stood,
                      d->held,    d->over,        d->rows};
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++)
        jox_free(fields[f]);
    for (int m = 0; m < JOX_DANGER_MEASURES; m++) {
        jox_free(d->sum[m]);
        jox_free(d->greatest[m]);
    }
    for (uint32_t e = 0; e < d->exit_count; e++)
        jox_free(d->exit_names[e]);
    jox_free(d);
}
