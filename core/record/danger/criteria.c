#include "record/danger/criteria.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "record/danger/danger_parts.h"

const char *const jox_verdict_names[] = {"not decided", "met", "not met"};

/* Result of the density samples for one criterion. */
typedef struct CriterionSamples {
    double seconds;            /* s: above the limit */
    double greatest, at, last; /* 1/m2; s: its time, time of the last sample; NAN: none */
} CriterionSamples;

/* Where the density of one criterion is read. Found at the first sample, from the plan alone. */
typedef struct CriterionFloor {
    bool found;
    uint8_t *within; /* by cell: 1 if its middle lies in the place; NULL: everywhere */
    uint32_t within_count;
    /* m: points of the place in cells whose middle lies outside it; their cell is looked up at each
       sample, as it depends on the walls that stand */
    JoxV2 *edge;
    uint32_t edge_count;
    size_t edge_capacity;
    bool cut; /* a part of the place lies outside the measured area */
} CriterionFloor;

/* The definitions and places are copies, since a reload replaces those of the scene. */
struct JoxCriteria {
    JoxCriterion *defs;
    uint32_t count, place_count;
    JoxPlace *places;
    CriterionSamples *samples;
    CriterionFloor *floors;
};

JoxCriteria *jox_criteria_create(const JoxCriterion *defs, uint32_t count, const JoxPlace *places,
                                 uint32_t place_count) {
    JoxCriteria *c = jox_alloc(1, sizeof *c);
    *c = (JoxCriteria){.count = count, .place_count = place_count};
    c->defs = jox_alloc(count + 1, sizeof *c->defs);
    c->places = jox_alloc(place_count + 1, sizeof *c->places);
    c->samples = jox_alloc(count + 1, sizeof *c->samples);
    c->floors = jox_alloc(count + 1, sizeof *c->floors);
    for (uint32_t k = 0; k < count; k++) {
        c->defs[k] = defs[k];
        c->defs[k].name = jox_strdup(defs[k].name);
        c->samples[k] = (CriterionSamples){.greatest = NAN, .at = NAN, .last = NAN};
    }
    for (uint32_t p = 0; p < place_count; p++)
        jox_place_copy(&c->places[p], &places[p]);
    return c;
}

void jox_criteria_free(JoxCriteria *c) {
    if (!c)
        return;
    for (uint32_t k = 0; k < c->count; k++) {
        jox_free(c->defs[k].name);
        jox_free(c->floors[k].within);
        jox_free(c->floors[k].edge);
    }
    for (uint32_t p = 0; p < c->place_count; p++)
        jox_place_free(&c->places[p]);
    jox_free(c->defs);
    jox_free(c->places);
    jox_free(c->samples);
    jox_free(c->floors);
    jox_free(c);
}

/* ---- where density is read ---- */

void jox_criteria_extend_area(const JoxCriterion *defs, uint32_t count, const JoxPlace *places,
                              JoxV2 *low, JoxV2 *high) {
    for (uint32_t k = 0; k < count; k++) {
        if (defs[k].kind != JOX_CRITERION_DENSITY || defs[k].place < 0)
            continue;
        const JoxPlace *place = &places[defs[k].place];
        *low = jox_v2(jox_minf(low->x, place->low.x), jox_minf(low->y, place->low.y));
        *high = jox_v2(jox_maxf(high->x, place->high.x), jox_maxf(high->y, place->high.y));
    }
}

/* Finds the cells in a place: those with their middle in it, and a point in each other cell that
   the place reaches, so that a place smaller than a cell is read, too. */
static void find_criterion_floor(JoxCriteria *c, uint32_t k, const JoxDensity *grid) {
    CriterionFloor *floor = &c->floors[k];
    const uint32_t number = (uint32_t)c->defs[k].place;
    const JoxPlace *place = &c->places[number];
    const float cell_half = grid->cell / 2.0f;
    const JoxV2 high = jox_add(
        grid->low, jox_v2((float)grid->columns * grid->cell, (float)grid->rows * grid->cell));
    const size_t cells = (size_t)grid->columns * grid->rows;
    floor->found = true;
    floor->within = jox_alloc(cells + 1, 1);
    /* A grid on storeys has all of their floor. */
    floor->cut =
        !jox_density_storeys_of(grid) &&
        (place->low.x < grid->low.x - cell_half || place->low.y < grid->low.y - cell_half ||
         place->high.x > high.x + cell_half || place->high.y > high.y + cell_half);
    for (size_t cell = 0; cell < cells; cell++) {
        const JoxV2 middle = jox_density_middle(grid, cell);
        floor->within[cell] = jox_place_contains(c->places, number, middle);
        floor->within_count += floor->within[cell];
        if (floor->within[cell] || middle.x < place->low.x - grid->cell ||
            middle.y < place->low.y - grid->cell || middle.x > place->high.x + grid->cell ||
            middle.y > place->high.y + grid->cell)
            continue;
        const JoxV2 point = jox_place_nearest(c->places, number, middle);
        if (fabsf(point.x - middle.x) > cell_half || fabsf(point.y - middle.y) > cell_half)
            continue;
        JOX_RESERVE(floor->edge, floor->edge_capacity, (size_t)floor->edge_count + 1);
        floor->edge[floor->edge_count++] = point;
    }
}

/* Returns the greatest density of a sample in the criterion's place, 1/m2; NAN if no part of the
   place is measured. */
static double find_greatest_density(const CriterionFloor *floor, const JoxDensity *grid) {
    double most = !floor->within || floor->within_count || floor->edge_count ? 0.0 : NAN;
    size_t cell;
    for (cell = 0; cell < (size_t)grid->columns * grid->rows; cell++)
        if ((!floor->within || floor->within[cell]) && (double)grid->now[cell] > most)
            most = (double)grid->now[cell];
    for (uint32_t e = 0; e < floor->edge_count; e++)
        if (jox_density_cell_of(grid, floor->edge[e].x, floor->edge[e].y, &cell) &&
            (double)grid->now[cell] > most)
            most = (double)grid->now[cell];
    return most;
}

static void sample_density(JoxCriteria *c, uint32_t k, const JoxDensity *grid, double time) {
    CriterionSamples *s = &c->samples[k];
    if (c->defs[k].place >= 0 && !c->floors[k].found)
        find_criterion_floor(c, k, grid);
    const double most = find_greatest_density(&c->floors[k], grid);
    if (most > c->defs[k].limits[JOX_CRITERION_DENSITY] && isfinite(s->last))
        s->seconds += time - s->last;
    if (most > s->greatest || (isfinite(most) && isnan(s->greatest))) {
        s->greatest = most;
        s->at = time;
    }
    s->last = time;
}

void jox_criteria_sample(JoxCriteria *c, const JoxDanger *danger) {
    const JoxLocal *local = jox_danger_local(danger);
    for (uint32_t k = 0; k < c->count; k++)
        if (c->defs[k].kind == JOX_CRITERION_DENSITY && isfinite(local->time) &&
            local->time != c->samples[k].last)
            sample_density(c, k, local->grid, local->time);
}

void jox_criteria_sections(JoxCriteria *c, JoxSections *s) {
    for (uint32_t k = 0; k < c->count; k++)
        JOX_SECTION(s, "samples", c->samples[k]);
}

/* ---- verdicts ---- */

static JoxVerdictKind compare_with_limit(double figure, double limit) {
    return !isfinite(figure) ? JOX_VERDICT_OPEN
           : figure <= limit ? JOX_VERDICT_MET
                             : JOX_VERDICT_FAILED;
}

static void judge_cleared(const JoxCriterionEvidence *e, JoxVerdict *v) {
    const double margin = v->criterion->margin, last = jox_exits_clearance(e->exits, e->inside);
    v->figure = margin * last;
    v->kind = compare_with_limit(v->figure, v->limit);
    if (isfinite(last))
        snprintf(v->how, sizeof v->how,
                 "time required: the last person left at %.2f s, times the margin %.3g; the limit "
                 "is the time available",
                 last, margin);
    else
        snprintf(v->how, sizeof v->how, "%u people were still inside at %.2f s", e->inside,
                 e->until);
    if (e->inside && margin * e->until >= v->limit)
        v->kind = JOX_VERDICT_FAILED;
    if (v->kind == JOX_VERDICT_MET && e->to_come) {
        v->kind = JOX_VERDICT_OPEN;
        snprintf(v->how, sizeof v->how,
                 "nobody was inside from %.2f s on, but more people were to come in at %.2f s, the "
                 "end of the run",
                 last, e->until);
    }
}

static void judge_density(const JoxCriteria *c, uint32_t k, JoxVerdict *v) {
    const CriterionSamples *s = &c->samples[k];
    const JoxCriterion *def = v->criterion;
    const double limit = v->limit;
    const bool anyhow = !(def->lasting > 0.0); /* the limit must not be exceeded at all */
    const bool known = isfinite(s->greatest);
    v->figure = !known ? NAN : anyhow ? s->greatest : s->seconds;
    v->limit = anyhow ? limit : def->lasting;
    v->unit = anyhow ? "1/m2" : "s";
    v->kind = compare_with_limit(v->figure, v->limit);
    if (!known) {
        snprintf(v->how, sizeof v->how, "not measured: no part of %.60s lies in the measured area",
                 def->place >= 0 ? c->places[def->place].name : "the floor");
        return;
    }
    snprintf(v->how, sizeof v->how,
             "density (Gaussian, R = 1 m, sampled each 0.5 s) anywhere %s%.60s: greatest %.3g at "
             "%.1f s; above %.3g per m\xc2\xb2 for %.1f s in all",
             def->place >= 0 ? "in " : "on the floor",
             def->place >= 0 ? c->places[def->place].name : "", s->greatest, s->at, limit,
             s->seconds);
    if (c->floors[k].cut) {
        const size_t length = strlen(v->how);
        snprintf(v->how + length, sizeof v->how - length,
                 "; a part of %.60s lies outside the measured area", c->places[def->place].name);
        if (v->kind == JOX_VERDICT_MET)
            v->kind = JOX_VERDICT_OPEN;
    }
}

static bool is_same_line(const JoxV2 a[2], const JoxV2 b[2]) {
    return a[0].x == b[0].x && a[0].y == b[0].y && a[1].x == b[1].x && a[1].y == b[1].y;
}

static void judge_flow(const JoxCriterionEvidence *e, JoxVerdict *v) {
    const int32_t probe = v->criterion->probe;
    const JoxDangerLines *lines = &e->danger->lines;
    v->unit = "1/(m s)";
    if (probe < 0 || (uint32_t)probe >= e->probe_count)
        return;
    const JoxProbeDef *def = jox_probe_def(e->probes[probe]);
    for (uint32_t l = 0; l < lines->count; l++)
        if (is_same_line(lines->items[l].given, def->points)) {
            v->figure = lines->items[l].flow_most;
            snprintf(v->how, sizeof v->how,
                     "greatest flow over %.60s in ten seconds, both directions, per metre of its "
                     "clear width of %.2f m",
                     def->name, lines->items[l].width);
        }
    v->kind = compare_with_limit(v->figure, v->limit);
}

static void judge_waiting(const JoxCriterionEvidence *e, JoxVerdict *v) {
    const int32_t number = v->criterion->probe;
    if (number < 0 || (uint32_t)number >= e->probe_count)
        return;
    const JoxFigures figures = jox_probe_figures(e->probes[number]);
    double passages = 0.0, under_way = 0.0;
    for (uint32_t f = 0; f < figures.count; f++) {
        if (strcmp(figures.items[f].name, "greatest") == 0)
            v->figure = figures.items[f].value;
        if (strcmp(figures.items[f].name, "passages") == 0)
            passages = figures.items[f].value;
        if (strcmp(figures.items[f].name, "under_way") == 0)
            under_way = figures.items[f].value;
    }
    v->kind = compare_with_limit(v->figure, v->limit);
    snprintf(v->how, sizeof v->how,
             "longest time of %.0f people in the probe %.60s; %.0f more were still under way at "
             "the end, and are not counted",
             passages, jox_probe_def(e->probes[number])->name, under_way);
    if (v->kind == JOX_VERDICT_MET && under_way > 0.0)
        v->kind = JOX_VERDICT_OPEN;
}

uint32_t jox_criteria_count(const JoxCriteria *c) {
    return c ? c->count : 0;
}

JoxVerdict jox_criteria_judge(const JoxCriteria *c, uint32_t k, const JoxCriterionEvidence *e) {
    static const char *const UNITS[] = {
#define X(kind, name, unit, greatest, example, meaning) unit,
        JOX_CRITERION_KINDS(X)
#undef X
    };
    const JoxCriterion *def = &c->defs[k];
    JoxVerdict v = {.criterion = def,
                    .figure = NAN,
                    .limit = def->limits[def->kind],
                    .unit = UNITS[def->kind],
                    .how = "not measured"};
    JOX_ASSERT(k < c->count);
    switch (def->kind) {
    case JOX_CRITERION_CLEARED:
        judge_cleared(e, &v);
        break;
    case JOX_CRITERION_DENSITY:
        judge_density(c, k, &v);
        break;
    case JOX_CRITERION_FLOW:
        judge_flow(e, &v);
        break;
    case JOX_CRITERION_WAITING:
        judge_waiting(e, &v);
        break;
    default:
        v.figure = jox_danger_most(e->danger, JOX_DANGER_LOAD).value;
        v.kind = compare_with_limit(v.figure, v.limit);
        snprintf(v.how, sizeof v.how, "greatest load of a person from one side, mean over 1 s");
    }
    return v;
}

void jox_criteria_json(const JoxCriteria *c, const JoxCriterionEvidence *e, JoxJson *json) {
    if (jox_criteria_count(c) == 0)
        return;
    jox_json_object(json, "criteria");
    for (uint32_t k = 0; k < c->count; k++) {
        const JoxVerdict v = jox_criteria_judge(c, k, e);
        jox_json_object(json, v.criterion->name);
        jox_json_number(json, "figure", v.figure);
        jox_json_number(json, "limit", v.limit);
        jox_json_string(json, "unit", v.unit);
        jox_json_number(json, "met",
                        v.kind == JOX_VERDICT_OPEN  ? NAN
                        : v.kind == JOX_VERDICT_MET ? 1.0
                                                    : 0.0);
        jox_json_end(json);
    }
    jox_json_end(json);
}
