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

struct JoxCriteria {
    const JoxCriterion *defs;
    uint32_t count;
    const JoxPlace *places;
    CriterionSamples *samples;
    uint8_t **within; /* by criterion: which cells lie in its place; NULL: all, or not yet known */
};

JoxCriteria *jox_criteria_create(const JoxCriterion *defs, uint32_t count, const JoxPlace *places) {
    JoxCriteria *c = jox_alloc(1, sizeof *c);
    *c = (JoxCriteria){.defs = defs, .count = count, .places = places};
    c->samples = jox_alloc(count + 1, sizeof *c->samples);
    c->within = jox_alloc(count + 1, sizeof *c->within);
    for (uint32_t k = 0; k < count; k++)
        c->samples[k] = (CriterionSamples){.greatest = NAN, .at = NAN, .last = NAN};
    return c;
}

void jox_criteria_free(JoxCriteria *c) {
    if (!c)
        return;
    for (uint32_t k = 0; k < c->count; k++)
        jox_free(c->within[k]);
    jox_free(c->within);
    jox_free(c->samples);
    jox_free(c);
}

/* Returns which cells of the grid have their middle in the criterion's place. */
static const uint8_t *find_cells_within(JoxCriteria *c, uint32_t k, const JoxDensity *grid) {
    const JoxPlace *place = &c->places[c->defs[k].place];
    const size_t cells = (size_t)grid->columns * grid->rows;
    if (c->within[k])
        return c->within[k];
    c->within[k] = jox_alloc(cells + 1, 1);
    for (size_t cell = 0; cell < cells; cell++)
        c->within[k][cell] =
            jox_place_kinds[place->kind].contains(c->places, place, jox_density_middle(grid, cell));
    return c->within[k];
}

static void sample_density(JoxCriteria *c, uint32_t k, const JoxDensity *grid, double time) {
    CriterionSamples *s = &c->samples[k];
    const uint8_t *within = c->defs[k].place >= 0 ? find_cells_within(c, k, grid) : NULL;
    double most = 0.0;
    for (size_t cell = 0; cell < (size_t)grid->columns * grid->rows; cell++)
        if ((!within || within[cell]) && (double)grid->now[cell] > most)
            most = (double)grid->now[cell];
    if (most > c->defs[k].limits[JOX_CRITERION_DENSITY] && isfinite(s->last))
        s->seconds += time - s->last;
    if (!(most <= s->greatest)) {
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
    snprintf(v->how, sizeof v->how,
             "density (Gaussian, R = 1 m, sampled each 0.5 s) anywhere %s%.60s: greatest %.3g at "
             "%.1f s; above %.3g per m\xc2\xb2 for %.1f s in all",
             def->place >= 0 ? "in " : "on the floor",
             def->place >= 0 ? c->places[def->place].name : "", s->greatest, s->at, limit,
             s->seconds);
}

static void judge_flow(const JoxCriterionEvidence *e, JoxVerdict *v) {
    const int32_t probe = v->criterion->probe;
    const char *name =
        probe >= 0 && (uint32_t)probe < e->probe_count ? jox_probe_def(e->probes[probe])->name : "";
    const JoxDangerLines *lines = &e->danger->lines;
    v->unit = "1/(m s)";
    for (uint32_t l = 0; l < lines->count; l++)
        if (strcmp(lines->items[l].name, name) == 0) {
            v->figure = lines->items[l].flow_most;
            snprintf(v->how, sizeof v->how,
                     "greatest flow over %.60s in ten seconds, both directions, per metre of its "
                     "clear width of %.2f m",
                     name, lines->items[l].width);
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
