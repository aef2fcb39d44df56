/* Measures what people bear in each frame and what the fields show at samples. danger_limits.c has
   the limits and writes the figures. */
#include "record/danger/danger.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "record/danger/danger_parts.h"

static const double HOLD = 1.0; /* s: time constant of the mean of compression and load */

/* ---- measuring ---- */

JoxDanger *jox_danger_create_on(JoxLocal *local) {
    JoxDanger *d = jox_alloc(1, sizeof *d);
    size_t cells = (size_t)local->grid->columns * local->grid->rows;
    d->local = local;
    jox_local_enable_pressure(local);
    jox_density_want_mean(local->grid);
    for (int m = 0; m < JOX_DANGER_MAPPED; m++) {
        d->sum[m] = jox_alloc(cells, sizeof(double));
        d->greatest[m] = jox_alloc(cells, sizeof(float));
    }
    for (int m = 0; m < JOX_DANGER_MEASURES; m++)
        d->most[m] = (JoxDangerMost){.value = NAN, .time = NAN};
    d->congestion = jox_congestion_create(local->grid);
    d->measured = jox_alloc(cells, sizeof *d->measured);
    d->stood = jox_alloc(cells, sizeof *d->stood);
    for (int m = 0; m < JOX_DANGER_MEASURES; m++)
        d->least[m] = INFINITY;
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        double *least = &d->least[jox_danger_limits[l].measure];
        /* People without load must not count as over a limit. */
        JOX_ASSERT(jox_danger_limits[l].value > 0.0);
        *least = fmin(*least, jox_danger_limits[l].value);
        d->counts[l].first = NAN;
    }
    d->stairs = jox_danger_stairs_create(d->least[JOX_DANGER_DENSITY]);
    d->last_frame = d->last_sample = NAN;
    return d;
}

JoxDanger *jox_danger_create(JoxV2 low, JoxV2 high, const JoxStoreys *storeys) {
    JoxDanger *d = jox_danger_create_on(jox_local_create(low, high, storeys));
    d->owns_local = true;
    return d;
}

/* Keeps the greatest value of a measure, with its time, place and person; UINT32_MAX: a value of
   the field, of no person. */
static void keep_greatest(JoxDanger *d, JoxDangerMeasure measure, double value, double time,
                          JoxV2 at, uint32_t person) {
    JoxDangerMost *most = &d->most[measure];
    if (value > (isnan(most->value) ? 0.0 : most->value))
        *most = (JoxDangerMost){value, time, person, at};
}

/* Counts `duration` seconds of person i at `value` for each limit of the measure that it
   reaches. */
static void count_over_limits(JoxDanger *d, const JoxFrame *frame, uint32_t i,
                              JoxDangerMeasure measure, double value, double duration) {
    JoxV2 at = {frame->x[i], frame->y[i]};
    JoxDangerPerson *person = &d->people[frame->key[i]];
    if (measure > JOX_DANGER_PRESSURE) /* density and pressure: taken from the field instead */
        keep_greatest(d, measure, value, frame->time, at, frame->key[i]);
    if (!(value >= d->least[measure]))
        return;
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        JoxDangerCount *count = &d->counts[l];
        if (jox_danger_limits[l].measure != measure || !(value >= jox_danger_limits[l].value))
            continue;
        count->person_s += duration;
        person->seconds[l] += duration;
        count->longest = fmax(count->longest, person->seconds[l]);
        if (isnan(count->first)) {
            count->first = frame->time;
            count->first_at = at;
        }
        count->people += !(person->over >> l & 1);
        person->over |= (uint16_t)(1 << l);
    }
}

/* Updates the means and the dose of person i. `share` is the weight of this frame in the means. */
static void update_person_load(JoxDanger *d, const JoxFrame *frame, uint32_t i, double duration,
                               float share) {
    JoxDangerPerson *p = &d->people[frame->key[i]];
    if (frame->compression) {
        p->compression += share * (frame->compression[i] - p->compression);
        count_over_limits(d, frame, i, JOX_DANGER_COMPRESSION, p->compression, duration);
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
    count_over_limits(d, frame, i, JOX_DANGER_LOAD, p->load, duration);
    count_over_limits(d, frame, i, JOX_DANGER_DOSE, p->dose, duration);
}

static bool has_any_load(const JoxDangerPerson *p) {
    return p->compression != 0.0f || p->load != 0.0f || p->dose != 0.0;
}

static void reserve_danger_people(JoxDanger *d, const JoxFrame *frame) {
    JOX_RESERVE_ZEROED(d->people, d->people_capacity, frame->keys);
    JOX_RESERVE(d->loaded, d->loaded_capacity, frame->count);
    const uint32_t had = d->has_load_capacity;
    JOX_RESERVE_ZEROED(d->has_load_left, d->has_load_capacity, d->people_capacity);
    for (uint32_t k = had; k < d->people_capacity; k++)
        d->has_load_left[k] = has_any_load(&d->people[k]);
}

/* Updates what people and walls bear; every frame. In a crowd that does not push, most people have
   no force and no memory of one, and are skipped. */
static void update_all_loads(JoxDanger *d, const JoxFrame *frame) {
    double duration = isnan(d->last_frame) ? 0.0 : frame->time - d->last_frame;
    float share = (float)(1.0 - jox_exp(-duration / HOLD));
    d->last_frame = frame->time;
    d->has_compression |= frame->compression != NULL;
    d->has_load |= frame->load != NULL;
    d->loaded_count = 0;
    for (uint32_t i = 0; (frame->compression || frame->load) && i < frame->count; i++) {
        const uint32_t key = frame->key[i];
        const bool pressed = (frame->compression && frame->compression[i] != 0.0f) ||
                             (frame->load && frame->load[i] != 0.0f);
        if (!pressed && !d->has_load_left[key])
            continue;
        update_person_load(d, frame, i, duration, share);
        d->has_load_left[key] = has_any_load(&d->people[key]);
        d->loaded[d->loaded_count++] = i;
    }
    jox_danger_walls_frame(&d->walls, frame, duration, share);
}

/* Adds a sample of density or pressure to the map and returns its greatest value; NAN where it was
   not measured anywhere. */
static float map_field(JoxDanger *d, JoxDangerMeasure measure, const float *field, double time) {
    const JoxDensity *g = d->local->grid;
    float most = NAN;
    for (size_t c = 0; c < (size_t)g->columns * g->rows; c++) {
        if (isnan(field[c]))
            continue;
        d->sum[measure][c] += field[c];
        d->measured[c] += measure == JOX_DANGER_PRESSURE;
        d->greatest[measure][c] = jox_maxf(d->greatest[measure][c], field[c]);
        if (field[c] <= most)
            continue;
        most = field[c];
        keep_greatest(d, measure, most, time, jox_density_middle(g, c), UINT32_MAX);
    }
    if (!isnan(most) && isnan(d->most[measure].value)) /* measured, and 0 everywhere */
        d->most[measure].value = 0.0;
    return most;
}

/* Adds compression and load of everybody in the frame to the map. */
static void map_borne_loads(JoxDanger *d, const JoxFrame *frame) {
    size_t cell;
    for (uint32_t i = 0; (frame->compression || frame->load) && i < frame->count; i++)
        if (jox_density_cell_of(d->local->grid, frame->x[i], frame->y[i], &cell)) {
            const JoxDangerPerson *p = &d->people[frame->key[i]];
            d->sum[JOX_DANGER_COMPRESSION][cell] += p->compression;
            d->sum[JOX_DANGER_LOAD][cell] += p->load;
            d->stood[cell]++;
        }
    d->samples++;
}

/* Returns the greatest Voronoi density of a sample; NAN if it was measured for nobody. */
static float find_greatest_voronoi(const JoxDanger *d, uint32_t count) {
    float most = NAN;
    for (uint32_t i = 0; i < count; i++)
        if (!(d->voronoi_density[i] <= most))
            most = isnan(d->voronoi_density[i]) ? most : d->voronoi_density[i];
    return most;
}

/* Adds the row of danger.csv for this sample. */
static void add_danger_row(JoxDanger *d, const JoxFrame *frame, const JoxExits *exits) {
    JOX_RESERVE(d->rows, d->row_capacity, d->row_count + 1);
    JoxDangerRow *row = &d->rows[d->row_count++];
    *row = (JoxDangerRow){.time = frame->time, .people = frame->count};
    for (int m = 0; m < JOX_DANGER_FIRST_BORNE; m++) {
        const JoxDensity *grid;
        const float *field = jox_danger_field(d, (JoxDangerMeasure)m, &grid);
        row->most[m] = map_field(d, (JoxDangerMeasure)m, field, frame->time);
    }
    for (uint32_t i = 0; i < frame->count; i++)
        if (!isnan(d->gaussian_density[i]))
            row->levels[jox_level_of_queue((double)d->gaussian_density[i])]++;
    for (uint32_t i = 0; i < frame->count; i++) {
        size_t cell;
        const JoxDangerPerson *p = &d->people[frame->key[i]];
        bool inside = jox_density_cell_of(d->local->grid, frame->x[i], frame->y[i], &cell);
        const float values[JOX_DANGER_MEASURES] = {inside ? d->local->grid->now[cell] : 0.0f,
                                                   inside ? jox_local_pressure(d->local, cell)
                                                          : NAN,
                                                   p->compression,
                                                   p->load,
                                                   (float)p->dose,
                                                   d->voronoi_density[i]};
        for (int l = 0; l < JOX_DANGER_LIMITS; l++)
            row->over[l] +=
                (double)values[jox_danger_limits[l].measure] >= jox_danger_limits[l].value;
    }
    row->most[JOX_DANGER_VORONOI] = find_greatest_voronoi(d, frame->count);
    row->left = exits ? (uint32_t)exits->left : 0;
    for (uint32_t e = 0; exits && e < exits->count && e < JOX_DANGER_EXITS; e++) {
        if (e >= d->exit_count)
            d->exit_names[d->exit_count++] = jox_strdup(exits->items[e].name);
        row->exits[e] = exits->items[e].people;
    }
}

/* Raises the maxima of the row of the last sample, and of the cells, to compression, load and dose
   of this frame; every frame. So the maximum over rows or cells is the maximum over all frames. */
static void update_maxima(JoxDanger *d, const JoxFrame *frame) {
    JoxDangerRow *row = &d->rows[d->row_count - 1];
    /* At least 0: people who bear nothing were measured, too. */
    for (int m = JOX_DANGER_FIRST_BORNE; m <= JOX_DANGER_LAST_BORNE && frame->count; m++)
        row->most[m] = jox_maxf(row->most[m], 0.0f);
    for (uint32_t k = 0; k < d->loaded_count; k++) {
        const uint32_t i = d->loaded[k];
        size_t cell;
        const JoxDangerPerson *p = &d->people[frame->key[i]];
        const float values[] = {p->compression, p->load, (float)p->dose};
        const bool inside = jox_density_cell_of(d->local->grid, frame->x[i], frame->y[i], &cell);
        for (int m = JOX_DANGER_FIRST_BORNE; m <= JOX_DANGER_LAST_BORNE; m++) {
            const float value = values[m - JOX_DANGER_FIRST_BORNE];
            row->most[m] = jox_maxf(row->most[m], value);
            if (inside && m < JOX_DANGER_MAPPED)
                d->greatest[m][cell] = jox_maxf(d->greatest[m][cell], value);
        }
    }
    row->wall_most = fmaxf(row->wall_most, (float)jox_danger_walls_greatest_load(&d->walls));
    if (!d->walls.known)
        row->wall_most = NAN;
    if (!frame->compression)
        row->most[JOX_DANGER_COMPRESSION] = NAN;
    if (!frame->load)
        row->most[JOX_DANGER_LOAD] = row->most[JOX_DANGER_DOSE] = NAN;
}

/* Sets the Voronoi density of each person in a sample. */
static void measure_voronoi(JoxDanger *d, const JoxFrame *frame) {
    const JoxDensityCrowd crowd = {.count = frame->count,
                                   .x = frame->x,
                                   .y = frame->y,
                                   .period = frame->period,
                                   .storeys = frame->storeys};
    jox_voronoi_people_measure(&d->voronoi, &crowd, frame->walls,
                               jox_density_walls_hash(d->local->grid), d->gaussian_density,
                               d->voronoi_density);
}

/* Takes a sample of the fields and counts the people over the limits of density and pressure. */
static void sample_danger(JoxDanger *d, const JoxFrame *frame, const JoxExits *exits) {
    if (isnan(d->last_sample))
        d->begun = frame->time;
    double duration = isnan(d->last_sample) ? 0.0 : frame->time - d->last_sample;
    d->last_sample = frame->time;
    JOX_RESERVE(d->gaussian_density, d->gaussian_capacity, frame->count);
    JOX_RESERVE(d->voronoi_density, d->voronoi_capacity, frame->count);
    for (uint32_t i = 0; i < frame->count; i++) {
        size_t cell;
        const bool inside = jox_density_cell_of(d->local->grid, frame->x[i], frame->y[i], &cell);
        d->gaussian_density[i] = inside ? d->local->grid->now[cell] : NAN;
    }
    measure_voronoi(d, frame);
    for (uint32_t i = 0; i < frame->count; i++) {
        size_t cell;
        if (!jox_density_cell_of(d->local->grid, frame->x[i], frame->y[i], &cell))
            continue;
        count_over_limits(d, frame, i, JOX_DANGER_VORONOI, (double)d->voronoi_density[i], duration);
        d->level_s[jox_level_of_queue((double)d->gaussian_density[i])] += duration;
        count_over_limits(d, frame, i, JOX_DANGER_DENSITY, (double)d->gaussian_density[i],
                          duration);
        count_over_limits(d, frame, i, JOX_DANGER_PRESSURE,
                          (double)jox_local_pressure(d->local, cell), duration);
    }
    map_borne_loads(d, frame);
    add_danger_row(d, frame, exits);
    jox_congestion_sample(&d->congestion, d->local->grid, frame->time, duration);
    jox_danger_lines_sample(&d->lines, frame, d->gaussian_density, duration);
    jox_danger_areas_sample(&d->areas, frame, d->gaussian_density, duration);
    jox_danger_stairs_sample(&d->stairs, frame, d->gaussian_density, duration);
}

void jox_danger_add_line(JoxDanger *d, const char *name, JoxV2 a, JoxV2 b) {
    JOX_ASSERT(isnan(d->last_frame) && name);
    jox_danger_lines_add(&d->lines, name, a, b);
}

void jox_danger_add_plan(JoxDanger *d, const JoxPlace *places, uint32_t place_count,
                         const JoxProbeDef *probes, uint32_t probe_count) {
    JOX_ASSERT(isnan(d->last_frame));
    for (uint32_t p = 0; p < probe_count; p++)
        if (probes[p].kind == JOX_PROBE_FLOW)
            jox_danger_add_line(d, probes[p].name, probes[p].points[0], probes[p].points[1]);
    jox_danger_areas_add(&d->areas, places, place_count, probes, probe_count);
}

void jox_danger_frame(JoxDanger *d, const JoxFrame *frame, const JoxExits *exits) {
    reserve_danger_people(d, frame);
    /* Cells of people near walls are needed between samples, too. */
    jox_density_storeys(d->local->grid, frame->storeys);
    jox_density_walls(d->local->grid, jox_frame_dividing_walls(frame));
    update_all_loads(d, frame);
    jox_congestion_frame(&d->congestion, frame->count, frame->time);
    jox_danger_lines_add_crossings(&d->lines, frame);
    jox_danger_stairs_frame(&d->stairs, frame);
    if (exits)
        jox_leaving_update(&d->leaving, exits, frame->time);
    if (d->owns_local)
        jox_local_frame(d->local, frame, NULL);
    if (d->local->time == frame->time && d->last_sample != frame->time)
        sample_danger(d, frame, exits);
    update_maxima(d, frame);
}

const JoxLocal *jox_danger_local(const JoxDanger *d) {
    return d->local;
}

const float *jox_danger_field(const JoxDanger *d, JoxDangerMeasure measure,
                              const JoxDensity **grid) {
    *grid = d->local->grid;
    return measure == JOX_DANGER_PRESSURE ? jox_pressure_now(d->local->pressure)
                                          : d->local->grid->now;
}

static void list_exit_name_sections(JoxDanger *d, JoxSections *s) {
    uint32_t count = (uint32_t)jox_section_count(s, "exits", d->exit_count, 1);
    if (count > JOX_DANGER_EXITS) {
        jox_sections_fail(s, "exits", "there are too many");
        return;
    }
    for (d->exit_count = 0; d->exit_count < count; d->exit_count++) {
        char **name = &d->exit_names[d->exit_count];
        jox_section_string(s, "exit", name);
        if (!*name)
            *name = jox_strdup("");
    }
}

void jox_danger_sections(JoxDanger *d, JoxSections *s) {
    const size_t cells = (size_t)d->local->grid->columns * d->local->grid->rows;
    if (d->owns_local)
        jox_local_sections(d->local, s);
    for (int m = 0; m < JOX_DANGER_MAPPED; m++) {
        jox_section(s, "sum", d->sum[m], sizeof *d->sum[m], cells);
        jox_section(s, "greatest", d->greatest[m], sizeof *d->greatest[m], cells);
    }
    jox_section(s, "measured", d->measured, sizeof *d->measured, cells);
    jox_section(s, "stood", d->stood, sizeof *d->stood, cells);
    JOX_SECTION(s, "samples", d->samples);
    JOX_SECTION_ROOM(s, "people", d->people, d->people_capacity);
    if (s->mode == JOX_SECTIONS_RESTORE)
        d->has_load_capacity = 0;
    JOX_SECTION(s, "has_compression", d->has_compression);
    JOX_SECTION(s, "has_load", d->has_load);
    jox_congestion_sections(&d->congestion, s);
    jox_danger_lines_sections(&d->lines, s);
    jox_danger_areas_sections(&d->areas, s);
    jox_leaving_sections(&d->leaving, s);
    jox_danger_walls_sections(&d->walls, s);
    jox_danger_stairs_sections(&d->stairs, s);
    JOX_SECTION(s, "level_s", d->level_s);
    JOX_SECTION(s, "begun", d->begun);
    JOX_SECTION(s, "last_frame", d->last_frame);
    JOX_SECTION(s, "last_sample", d->last_sample);
    JOX_SECTION(s, "counts", d->counts);
    JOX_SECTION(s, "most", d->most);
    JOX_SECTION_ARRAY(s, "rows", d->rows, d->row_count, d->row_capacity);
    list_exit_name_sections(d, s);
}

void jox_danger_free(JoxDanger *d) {
    if (!d)
        return;
    if (d->owns_local)
        jox_local_free(d->local);
    void *arrays[] = {d->measured,         d->stood,           d->people,        d->rows,
                      d->gaussian_density, d->voronoi_density, d->has_load_left, d->loaded};
    for (size_t a = 0; a < sizeof arrays / sizeof *arrays; a++)
        jox_free(arrays[a]);
    for (int m = 0; m < JOX_DANGER_MAPPED; m++) {
        jox_free(d->sum[m]);
        jox_free(d->greatest[m]);
    }
    for (uint32_t e = 0; e < d->exit_count; e++)
        jox_free(d->exit_names[e]);
    jox_congestion_free(&d->congestion);
    jox_voronoi_people_free(&d->voronoi);
    jox_danger_lines_free(&d->lines);
    jox_danger_areas_free(&d->areas);
    jox_leaving_free(&d->leaving);
    jox_danger_walls_free(&d->walls);
    jox_danger_stairs_free(&d->stairs);
    jox_free(d);
}
