/* Builds and frees sides: lists of figures, curves and notes. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "sweep/compare/compare.h"

JoxSide *jox_sides_add(JoxSides *sides, const char *source) {
    JOX_RESERVE(sides->items, sides->capacity, sides->count + 1);
    JoxSide *side = &sides->items[sides->count++];
    *side = (JoxSide){.source = jox_strdup(source)};
    return side;
}

static void free_notes(JoxSideNotes *notes) {
    for (uint32_t n = 0; n < notes->count; n++) {
        jox_free(notes->items[n].key);
        jox_free(notes->items[n].value);
    }
    jox_free(notes->items);
}

void jox_sides_free(JoxSides *sides) {
    for (uint32_t s = 0; s < sides->count; s++) {
        JoxSide *side = &sides->items[s];
        for (uint32_t f = 0; f < side->figure_count; f++) {
            jox_free(side->figures[f].name);
            jox_free(side->figures[f].values);
        }
        for (uint32_t k = 0; k < side->curve_count; k++) {
            jox_free(side->curves[k].name);
            jox_free(side->curves[k].unit);
            jox_free(side->curves[k].points);
        }
        for (int k = 0; k < JOX_FIELDS; k++)
            jox_sweep_free_field(&side->fields[k]);
        for (uint32_t r = 0; r < side->all_count; r++) {
            jox_free(side->all[r].reason);
            jox_free(side->all[r].hash);
        }
        jox_free(side->all);
        free_notes(&side->notes);
        free_notes(&side->inputs);
        jox_free(side->figures);
        jox_free(side->curves);
        jox_free(side->seeds);
        jox_free(side->name);
        jox_free(side->source);
        jox_free(side->settings);
        jox_free(side->plan);
        jox_free(side->title);
    }
    jox_free(sides->items);
    *sides = (JoxSides){0};
}

const char *jox_side_find_note(const JoxSide *side, const char *key) {
    for (uint32_t n = 0; n < side->notes.count; n++)
        if (strcmp(side->notes.items[n].key, key) == 0)
            return side->notes.items[n].value;
    return "";
}

const JoxSideFigure *jox_side_find_figure(const JoxSide *side, const char *name) {
    for (uint32_t f = 0; f < side->figure_count; f++)
        if (strcmp(side->figures[f].name, name) == 0)
            return &side->figures[f];
    return NULL;
}

JoxSideFigure *jox_side_add_figure(JoxSide *side, const char *name) {
    JoxSideFigure *figure = (JoxSideFigure *)(uintptr_t)jox_side_find_figure(side, name);
    if (figure)
        return figure;
    JOX_RESERVE(side->figures, side->figure_capacity, side->figure_count + 1);
    figure = &side->figures[side->figure_count++];
    *figure = (JoxSideFigure){jox_strdup(name), jox_alloc(side->runs + 1, sizeof(double))};
    for (uint32_t r = 0; r < side->runs; r++)
        figure->values[r] = NAN;
    return figure;
}

JoxSideCurve *jox_side_add_curve(JoxSide *side, const char *name, const char *unit) {
    JOX_RESERVE(side->curves, side->curve_capacity, side->curve_count + 1);
    side->curves[side->curve_count] =
        (JoxSideCurve){.name = jox_strdup(name ? name : ""), .unit = jox_strdup(unit ? unit : "")};
    return &side->curves[side->curve_count++];
}

void jox_side_add_point(JoxSideCurve *curve, double time, double *values, size_t count) {
    const JoxMoments m = jox_moments(values, count);
    JOX_RESERVE(curve->points, curve->capacity, curve->count + 1);
    curve->points[curve->count++] =
        (struct JoxSidePoint){.time = time,
                              .mean = m.mean,
                              .low = jox_quantile(values, count, 0.05),
                              .high = jox_quantile(values, count, 0.95),
                              .median = jox_quantile(values, count, 0.5),
                              .least = jox_quantile(values, count, 0.0),
                              .most = jox_quantile(values, count, 1.0)};
}
