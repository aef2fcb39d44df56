/* Samples density, number of people and level of service in each area, and writes the table and
   the figures. */
#include "record/danger/areas.h"

#include <math.h>
#include <string.h>

#include "base/format/quote.h"
#include "base/mem.h"
#include "geom/polygon.h"

static bool has_area(const JoxDangerAreas *areas, const JoxV2 *points, uint32_t count) {
    for (uint32_t a = 0; a < areas->count; a++)
        if (areas->items[a].count == count &&
            memcmp(areas->items[a].points, points, count * sizeof *points) == 0)
            return true;
    return false;
}

/* Adds an area, unless there are too many or it has the outline of another. */
static void add_danger_area(JoxDangerAreas *areas, const char *name, const JoxV2 *points,
                            uint32_t count) {
    if (areas->count == JOX_DANGER_AREAS || count < 3 || has_area(areas, points, count))
        return;
    JOX_RESERVE(areas->items, areas->capacity, areas->count + 1);
    JoxDangerArea *area = &areas->items[areas->count++];
    *area = (JoxDangerArea){.name = jox_strdup(name), .count = count, .most = NAN, .worst = -1};
    area->most_time = NAN;
    area->points = jox_alloc(count, sizeof *points);
    memcpy(area->points, points, count * sizeof *points);
    area->surface = fabs((double)jox_polygon_area(points, count));
    jox_bounds(points, count, &area->low, &area->high);
}

void jox_danger_areas_add(JoxDangerAreas *areas, const JoxPlace *places, uint32_t place_count,
                          const JoxProbeDef *probes, uint32_t probe_count) {
    for (uint32_t p = 0; p < place_count; p++)
        if (jox_place_is_area(&places[p]) && places[p].name)
            add_danger_area(areas, places[p].name, places[p].points, places[p].count);
    for (uint32_t p = 0; p < probe_count; p++)
        if (probes[p].kind == JOX_PROBE_MEASURE)
            add_danger_area(areas, probes[p].name, probes[p].points, probes[p].count);
}

/* Counts the people in an area and adds the row of this sample. */
static void sample_area(JoxDangerArea *area, const JoxFrame *frame, const float *density,
                        double duration) {
    JoxDangerAreaRow row = {.time = frame->time, .density = NAN, .level = -1};
    double sum = 0.0;
    uint32_t known = 0;
    for (uint32_t i = 0; i < frame->count; i++) {
        const JoxV2 at = {frame->x[i], frame->y[i]};
        if (at.x < area->low.x || at.x > area->high.x || at.y < area->low.y ||
            at.y > area->high.y || !jox_polygon_contains(area->points, area->count, at))
            continue;
        row.people++;
        if (isnan(density[i])) /* outside the measured area */
            continue;
        sum += (double)density[i];
        area->person_s[jox_level_of_queue((double)density[i])] += duration;
        known++;
    }
    if (known) {
        row.density = (float)(sum / known);
        row.level = jox_level_of_queue((double)row.density);
        area->level_s[row.level] += duration;
        area->worst = row.level > area->worst ? row.level : area->worst;
        if (!(area->most >= row.density)) {
            area->most = row.density;
            area->most_time = row.time;
        }
    }
    area->most_people = row.people > area->most_people ? row.people : area->most_people;
    JOX_RESERVE(area->rows, area->row_capacity, area->row_count + 1);
    area->rows[area->row_count++] = row;
}

void jox_danger_areas_sample(JoxDangerAreas *areas, const JoxFrame *frame, const float *density,
                             double duration) {
    for (uint32_t a = 0; a < areas->count; a++)
        sample_area(&areas->items[a], frame, density, duration);
}

void jox_danger_areas_json(const JoxDangerAreas *areas, JoxJson *json) {
    if (areas->count == 0) {
        jox_json_null(json, "areas");
        return;
    }
    jox_json_object(json, "areas");
    for (uint32_t a = 0; a < areas->count; a++) {
        const JoxDangerArea *area = &areas->items[a];
        jox_json_object(json, area->name);
        jox_json_whole(json, "people_max", area->most_people);
        jox_json_number(json, "density_max", (double)area->most);
        jox_json_number(json, "density_max_s", area->most_time);
        if (area->worst < 0)
            jox_json_null(json, "worst_level");
        else
            jox_json_string(json, "worst_level", jox_levels[area->worst].name);
        jox_json_object(json, "level_s");
        for (int k = 0; k < JOX_LEVELS; k++)
            jox_json_number(json, jox_levels[k].name, area->level_s[k]);
        jox_json_end(json);
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_danger_areas_csv(const JoxDangerAreas *areas, FILE *out) {
    fputs("area,time [s],people,density [1/m2],level\n", out);
    for (uint32_t a = 0; a < areas->count; a++)
        for (uint32_t r = 0; r < areas->items[a].row_count; r++) {
            const JoxDangerAreaRow *row = &areas->items[a].rows[r];
            jox_quote_put(out, jox_quote_csv, areas->items[a].name);
            fprintf(out, ",%.9g,%u,", row->time, row->people);
            if (row->level >= 0)
                fprintf(out, "%.9g", (double)row->density);
            fprintf(out, ",%s\n", row->level < 0 ? "" : jox_levels[row->level].name);
        }
}

static bool are_area_rows_valid(const JoxDangerArea *area) {
    for (uint32_t r = 0; r < area->row_count; r++)
        if (area->rows[r].level < -1 || area->rows[r].level >= JOX_LEVELS)
            return false;
    return area->worst >= -1 && area->worst < JOX_LEVELS;
}

void jox_danger_areas_sections(JoxDangerAreas *areas, JoxSections *s) {
    for (uint32_t a = 0; a < areas->count; a++) {
        JoxDangerArea *area = &areas->items[a];
        JOX_SECTION_ARRAY(s, "rows", area->rows, area->row_count, area->row_capacity);
        JOX_SECTION(s, "level_s", area->level_s);
        JOX_SECTION(s, "person_s", area->person_s);
        JOX_SECTION(s, "most_people", area->most_people);
        JOX_SECTION(s, "most", area->most);
        JOX_SECTION(s, "most_time", area->most_time);
        JOX_SECTION(s, "worst", area->worst);
        if (!s->failed && !are_area_rows_valid(area))
            jox_sections_fail(s, "rows", "a level is out of range");
        if (s->failed) {
            area->row_count = 0;
            area->worst = -1;
        }
    }
}

void jox_danger_areas_free(JoxDangerAreas *areas) {
    for (uint32_t a = 0; a < areas->count; a++) {
        jox_free(areas->items[a].name);
        jox_free(areas->items[a].points);
        jox_free(areas->items[a].rows);
    }
    jox_free(areas->items);
}
