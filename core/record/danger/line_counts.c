/* Counts crossings of lines in each frame, and samples flow, queue and level of service. */
#include "record/danger/line_counts.h"

#include <math.h>

#include "base/mem.h"
#include "base/sort.h"
#include "geom/polygon.h"

static const double WINDOW = 10.0; /* s: flow and growth are taken over this time */
static const float NEAR = 2.0f;    /* m: density before a line is measured within this distance */
static const float FAR = 10.0f;    /* m: people within this distance may be waiting */
static const double DENSE = 3.5;   /* 1/m2: density of stop-and-go */
static const double HAIR = 1e-6;   /* s: tolerance, as times are sums of steps */

const char jox_stop_and_go_source[] =
    "outflow below 0.8 per m and s: Helbing, Johansson, Al-Abideen, Phys. Rev. E 75, 046109, 2007; "
    "the "
    "density, 3.5 per m\xc2\xb2, is that of IMO's simplified method";

void jox_danger_lines_add(JoxDangerLines *lines, const char *name, JoxV2 a, JoxV2 b) {
    const double length = (double)jox_length(jox_sub(b, a));
    for (uint32_t l = 0; l < lines->count; l++)
        if (jox_length(jox_sub(lines->items[l].given[0], a)) == 0.0f &&
            jox_length(jox_sub(lines->items[l].given[1], b)) == 0.0f)
            return;
    if (length <= 0.0)
        return;
    JOX_RESERVE(lines->items, lines->capacity, lines->count + 1);
    lines->items[lines->count++] = (JoxDangerLine){.name = jox_strdup(name),
                                                   .given = {a, b},
                                                   .a = a,
                                                   .b = b,
                                                   .width = length,
                                                   .flow_most = NAN,
                                                   .flow_most_time = NAN,
                                                   .growth_most = NAN,
                                                   .growth_most_time = NAN,
                                                   .worst = -1,
                                                   .stop_and_go.first = NAN};
}

static void add_line_crossing(JoxDangerLine *line, double time, uint32_t key, int direction) {
    JOX_RESERVE(line->crossings, line->crossing_capacity, line->crossing_count + 1);
    line->crossings[line->crossing_count++] = (struct JoxDangerCrossing){time, key, direction};
    line->forward += direction > 0;
    line->back += direction < 0;
}

void jox_danger_lines_add_crossings(JoxDangerLines *lines, const JoxFrame *frame) {
    if (lines->count == 0)
        return;
    jox_track_reserve(&lines->track, frame);
    for (uint32_t i = 0; i < frame->count; i++) {
        JoxStretch stretch;
        double time;
        if (!jox_track_step(&lines->track, frame, i, &stretch))
            continue;
        for (uint32_t l = 0; l < lines->count; l++) {
            const int direction =
                jox_stretch_crosses(&stretch, lines->items[l].a, lines->items[l].b, &time);
            if (direction)
                add_line_crossing(&lines->items[l], time, frame->key[i], direction);
        }
    }
}

static int compare_crossing_keys(const void *a, const void *b, const void *context) {
    const struct JoxDangerCrossing *x = a, *y = b;
    (void)context;
    return (x->key > y->key) - (x->key < y->key);
}

/* Counts the people who passed the line since a time, in each direction. A person who crosses
   several times counts by the sum of the directions. Drops older crossings. */
static void count_passed_people(JoxDangerLine *line, double since, uint32_t *forward,
                                uint32_t *back) {
    uint32_t kept = 0;
    for (uint32_t c = 0; c < line->crossing_count; c++)
        if (line->crossings[c].time > since + HAIR)
            line->crossings[kept++] = line->crossings[c];
    line->crossing_count = kept;
    *forward = *back = 0;
    if (kept == 0)
        return;
    struct JoxDangerCrossing *sorted = jox_alloc(kept, sizeof *sorted);
    for (uint32_t c = 0; c < kept; c++)
        sorted[c] = line->crossings[c];
    jox_sort(sorted, kept, sizeof *sorted, compare_crossing_keys, NULL, NULL);
    for (uint32_t c = 0; c < kept;) {
        const uint32_t key = sorted[c].key;
        int net = 0;
        for (; c < kept && sorted[c].key == key; c++)
            net += sorted[c].direction;
        *forward += net > 0;
        *back += net < 0;
    }
    jox_free(sorted);
}

/* Returns whether a wall stands between two points. */
static bool is_behind_wall(const JoxWalls *walls, JoxV2 from, JoxV2 to) {
    for (uint32_t r = 0; walls && r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t v = ring->first; !ring->open && v < ring->first + ring->count; v++) {
            const JoxWallVertex *vertex = &walls->vertices[v];
            if (jox_segment_crossing(vertex->point, walls->vertices[vertex->next].point, from, to))
                return true;
        }
    }
    return false;
}

/* Restricts the line to the part between walls, from its first opening to its last, and sets its
   clear width. */
static void clip_line_to_openings(JoxDangerLine *line, const JoxWalls *walls,
                                  JoxWallOpenings *openings) {
    jox_walls_openings(walls, line->given, openings);
    line->a = openings->ends[0][0];
    line->b = openings->ends[openings->count - 1][1];
    line->width = (double)openings->width;
}

/* Returns whether the middle of an opening is visible from a point. */
static bool sees_opening(const JoxWalls *walls, const JoxWallOpenings *openings, JoxV2 from) {
    for (uint32_t o = 0; o < openings->count; o++) {
        const JoxV2 *ends = openings->ends[o];
        if (!is_behind_wall(walls, jox_scale(jox_add(ends[0], ends[1]), 0.5f), from))
            return true;
    }
    return false;
}

static float measure_line_distance(const JoxDangerLine *line, JoxV2 point) {
    const JoxV2 along = jox_sub(line->b, line->a), from = jox_sub(point, line->a);
    const float t = jox_clampf(jox_dot(from, along) / jox_dot(along, along), 0.0f, 1.0f);
    return jox_length(jox_sub(from, jox_scale(along, t)));
}

/* Sets the position of person i as seen from the line: moved over a seam, if it stands beyond one.
   Returns false if it is on another storey. */
static bool place_beside_line(const JoxDangerLine *line, const JoxFrame *frame, uint32_t i,
                              JoxV2 *at) {
    const JoxV2 middle = jox_scale(jox_add(line->a, line->b), 0.5f);
    JoxV2 way;
    *at = (JoxV2){frame->x[i], frame->y[i]};
    if (!frame->storeys)
        return true;
    const bool seen = jox_plan_offset(frame->storeys, middle, *at, &way);
    *at = jox_add(middle, way);
    return seen;
}

/* Counts the people waiting on each side and the mean densities close to the line. */
static void measure_queues(const JoxDangerLine *line, const JoxWallOpenings *openings,
                           const JoxFrame *frame, const float *density, uint32_t waiting[2],
                           double mean[2]) {
    double sum[2] = {0.0, 0.0};
    uint32_t near[2] = {0, 0};
    waiting[0] = waiting[1] = 0;
    for (uint32_t i = 0; i < frame->count; i++) {
        JoxV2 at;
        if (!place_beside_line(line, frame, i, &at))
            continue;
        const float away = measure_line_distance(line, at);
        if (away > FAR || !sees_opening(frame->walls, openings, at))
            continue;
        const int side = jox_det(jox_sub(line->b, line->a), jox_sub(at, line->a)) > 0.0f;
        waiting[side]++;
        if (away > NEAR || isnan(density[i]))
            continue;
        sum[side] += (double)density[i];
        near[side]++;
    }
    for (int side = 0; side < 2; side++)
        mean[side] = near[side] ? sum[side] / near[side] : NAN;
}

/* Returns the row from WINDOW seconds ago; NULL if there is none yet. */
static const JoxDangerLineRow *find_row_before_window(const JoxDangerLine *line, double now) {
    const JoxDangerLineRow *found = NULL;
    for (uint32_t r = line->row_count; r-- > 0 && !found;)
        if (line->rows[r].time <= now - WINDOW + HAIR)
            found = &line->rows[r];
    return found;
}

static void extend_spell(JoxDangerSpell *spell, bool now, double time, double duration) {
    if (!now)
        return;
    spell->seconds += duration;
    if (isnan(spell->first))
        spell->first = time;
}

/* Sets level and stop-and-go of a row, and updates the maxima and times of the line. */
static void update_line_figures(JoxDangerLine *line, JoxDangerLineRow *row, double duration) {
    const bool dense = row->density >= DENSE;
    row->level = jox_level_of_walkway(row->flow, row->density);
    row->stop_and_go = dense && row->flow < JOX_STOP_FLOW;
    line->level_s[row->level] += duration;
    line->worst = row->level > line->worst ? row->level : line->worst;
    if (!(line->flow_most >= row->flow)) {
        line->flow_most = row->flow;
        line->flow_most_time = row->time;
    }
    if (!(line->growth_most >= row->growth)) {
        line->growth_most = row->growth;
        line->growth_most_time = row->time;
    }
    extend_spell(&line->stop_and_go, row->stop_and_go, row->time, duration);
}

/* Adds the row of this sample. The first rows have no flow, until there is a row from WINDOW
   seconds ago. */
static void sample_line(JoxDangerLine *line, const JoxFrame *frame, const float *density,
                        double duration) {
    uint32_t forward, back;
    double mean[2];
    JoxWallOpenings openings;
    clip_line_to_openings(line, frame->walls, &openings);
    JoxDangerLineRow row = {.time = frame->time,
                            .width = line->width,
                            .forward = line->forward,
                            .back = line->back,
                            .flow = NAN,
                            .growth = NAN,
                            .level = -1};
    count_passed_people(line, frame->time - WINDOW, &forward, &back);
    measure_queues(line, &openings, frame, density, row.waiting, mean);
    /* The side before the line is the one that most people come from: of late, else since the
       beginning; without passages, the side with more people. */
    int from = (forward > back) - (forward < back);
    if (from == 0)
        from = (line->forward > line->back) - (line->forward < line->back);
    if (from == 0)
        from = row.waiting[0] >= row.waiting[1] ? 1 : -1;
    row.side = from < 0;
    row.density = mean[row.side];
    const JoxDangerLineRow *before = find_row_before_window(line, frame->time);
    if (before) {
        row.flow = (forward + back) / (WINDOW * line->width);
        row.growth =
            ((double)row.waiting[row.side] - before->waiting[row.side]) / (row.time - before->time);
        update_line_figures(line, &row, duration);
    }
    JOX_RESERVE(line->rows, line->row_capacity, line->row_count + 1);
    line->rows[line->row_count++] = row;
}

void jox_danger_lines_sample(JoxDangerLines *lines, const JoxFrame *frame, const float *density,
                             double duration) {
    for (uint32_t l = 0; l < lines->count; l++)
        sample_line(&lines->items[l], frame, density, duration);
}

/* ---- figures ---- */

static void write_spell(JoxJson *json, const char *name, const JoxDangerSpell *spell, bool known,
                        double end) {
    jox_json_object(json, name);
    jox_json_number(json, "seconds", known ? spell->seconds : NAN);
    jox_json_number(json, "first_s", spell->first);
    jox_json_number(json, "since_min", (end - spell->first) / 60.0);
    jox_json_end(json);
}

static void write_line_figures(const JoxDangerLine *line, double begun, double end, JoxJson *json) {
    const bool known = line->worst >= 0;
    jox_json_object(json, line->name);
    jox_json_number(json, "width", line->width);
    jox_json_number(json, "from_s", begun);
    jox_json_whole(json, "forward", line->forward);
    jox_json_whole(json, "back", line->back);
    jox_json_number(json, "flow_max", line->flow_most);
    jox_json_number(json, "flow_max_s", line->flow_most_time);
    jox_json_number(json, "queue_growth_max", line->growth_most);
    jox_json_number(json, "queue_growth_max_s", line->growth_most_time);
    if (known)
        jox_json_string(json, "worst_level", jox_levels[line->worst].name);
    else
        jox_json_null(json, "worst_level");
    jox_json_object(json, "level_s");
    for (int k = 0; k < JOX_LEVELS; k++)
        jox_json_number(json, jox_levels[k].name, known ? line->level_s[k] : NAN);
    jox_json_end(json);
    write_spell(json, "stop_and_go", &line->stop_and_go, known, end);
    jox_json_end(json);
}

void jox_danger_lines_json(const JoxDangerLines *lines, double begun, double end, JoxJson *json) {
    if (lines->count == 0) {
        jox_json_null(json, "lines");
        return;
    }
    jox_json_object(json, "lines");
    for (uint32_t l = 0; l < lines->count; l++)
        write_line_figures(&lines->items[l], begun, end, json);
    jox_json_end(json);
}

static bool are_line_rows_valid(const JoxDangerLine *line) {
    for (uint32_t r = 0; r < line->row_count; r++)
        if (line->rows[r].side < 0 || line->rows[r].side > 1 || line->rows[r].level < -1 ||
            line->rows[r].level >= JOX_LEVELS)
            return false;
    return line->worst >= -1 && line->worst < JOX_LEVELS;
}

static void list_line_sections(JoxDangerLine *line, JoxSections *s) {
    JOX_SECTION(s, "from", line->a);
    JOX_SECTION(s, "to", line->b);
    JOX_SECTION(s, "width", line->width);
    JOX_SECTION_ARRAY(s, "rows", line->rows, line->row_count, line->row_capacity);
    JOX_SECTION(s, "flow_most", line->flow_most);
    JOX_SECTION(s, "flow_most_time", line->flow_most_time);
    JOX_SECTION(s, "level_s", line->level_s);
    JOX_SECTION(s, "worst", line->worst);
    JOX_SECTION(s, "stop_and_go", line->stop_and_go);
    JOX_SECTION(s, "growth_most", line->growth_most);
    JOX_SECTION(s, "growth_most_time", line->growth_most_time);
    JOX_SECTION_ARRAY(s, "crossings", line->crossings, line->crossing_count,
                      line->crossing_capacity);
    JOX_SECTION(s, "forward", line->forward);
    JOX_SECTION(s, "back", line->back);
    if (!s->failed && !are_line_rows_valid(line))
        jox_sections_fail(s, "rows", "a side or level is out of range");
    if (s->failed) {
        line->row_count = 0;
        line->worst = -1;
    }
}

void jox_danger_lines_sections(JoxDangerLines *lines, JoxSections *s) {
    jox_track_sections(&lines->track, s);
    for (uint32_t l = 0; l < lines->count; l++)
        list_line_sections(&lines->items[l], s);
}

void jox_danger_lines_free(JoxDangerLines *lines) {
    for (uint32_t l = 0; l < lines->count; l++) {
        jox_free(lines->items[l].name);
        jox_free(lines->items[l].rows);
        jox_free(lines->items[l].crossings);
    }
    jox_free(lines->items);
    jox_free(lines->track.items);
}
