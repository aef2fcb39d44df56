/* Draws the plan of each side, with the greatest density at each place as a mean over the side's
   runs, and its difference to that of the base. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/plurals.h"
#include "base/mem.h"
#include "picture/html.h"
#include "report/maps.h"
#include "sweep/compare/compare.h"

/* Returns the time, s, at which the longest curve ends. */
static double get_end_time(const JoxSide *side) {
    double end = 0;
    for (uint32_t k = 0; k < side->curve_count; k++)
        if (side->curves[k].count)
            end = fmax(end, side->curves[k].points[side->curves[k].count - 1].time);
    return end;
}

/* Collects the names of exits from the paths of figures: "danger.exits.NAME.people". */
static void list_exits(const JoxSide *side, JoxExits *exits) {
    static const char FROM[] = "danger.exits.", TO[] = ".people";
    for (uint32_t f = 0; f < side->figure_count; f++) {
        const char *name = side->figures[f].name;
        const size_t length = strlen(name), ends = sizeof FROM + sizeof TO - 2;
        char exit[128];
        if (length <= ends || strncmp(name, FROM, sizeof FROM - 1) != 0 ||
            strcmp(name + length - (sizeof TO - 1), TO) != 0)
            continue;
        snprintf(exit, sizeof exit, "%.*s", (int)(length - ends), name + sizeof FROM - 1);
        jox_exits_get(exits, exit);
    }
}

/* Returns the geometry of a side's maps; with storeys, that of the plan's storeys. */
static JoxDensity *make_grid(const JoxSidePlan *p, const JoxSweepField *f) {
    const float cell = f->values ? (float)f->cell : 1.0f;
    if (jox_has_storeys(&p->storeys))
        return jox_density_create_on_storeys(p->low, p->high, cell, JOX_DENSITY_KERNEL,
                                             &p->storeys);
    JoxDensity *grid = jox_alloc(1, sizeof *grid);
    *grid = (JoxDensity){.low = p->low, .cell = cell};
    grid->columns = (uint32_t)ceilf(p->high.x - p->low.x);
    grid->rows = (uint32_t)ceilf(p->high.y - p->low.y);
    if (f->values)
        *grid = (JoxDensity){.low = {(float)f->low_x, (float)f->low_y},
                             .cell = cell,
                             .columns = f->columns,
                             .rows = f->rows};
    return grid;
}

bool jox_side_draw_begin(JoxSideDrawn *drawn, const JoxSide *side, const char *folder) {
    const JoxSweepField *f = &side->fields[JOX_FIELD_GREATEST];
    *drawn = (JoxSideDrawn){0};
    if (!side->plan || !jox_side_plan_read(&drawn->plan, side->plan))
        return false;
    const JoxSidePlan *p = &drawn->plan;
    drawn->grid = make_grid(p, f);
    drawn->fields = f->values && drawn->grid->columns == f->columns && drawn->grid->rows == f->rows;
    list_exits(side, &drawn->exits);
    drawn->subject = (JoxSubject){.title = side->title && *side->title ? side->title : side->name,
                                  .folder = folder,
                                  .grid = drawn->grid,
                                  .storeys = jox_has_storeys(&p->storeys) ? &p->storeys : NULL,
                                  .exits = &drawn->exits,
                                  .walls = &p->walls,
                                  .places = p->places,
                                  .place_count = p->place_count,
                                  .probes = (const JoxProbe *const *)p->probes,
                                  .probe_count = p->probe_count,
                                  .bodies = &p->bodies,
                                  .until = get_end_time(side),
                                  .simulated = !side->recorded};
    return true;
}

void jox_side_draw_end(JoxSideDrawn *drawn) {
    jox_exits_free(&drawn->exits);
    jox_density_free(drawn->grid);
    jox_side_plan_free(&drawn->plan);
}

double jox_side_field_max(const JoxSide *side, JoxSideFieldKind kind) {
    const JoxSweepField *f = &side->fields[kind];
    double most = 0;
    for (size_t k = 0; f->values && k < (size_t)f->columns * f->rows; k++)
        if ((double)f->values[k] > most && f->values[k] < 1000)
            most = (double)f->values[k];
    return most;
}

static bool draw_side_plan(const JoxComparison *c, uint32_t s, double most, JoxText *why) {
    const JoxSide *side = &c->sides.items[s];
    JoxSideDrawn drawn;
    char file[40], when[80], runs[JOX_NOUN];
    bool good = true;
    snprintf(file, sizeof file, "plan-%u", s + 1);
    if (jox_side_draw_begin(&drawn, side, c->def->out)) {
        snprintf(when, sizeof when, side->runs > 1 ? "0 to %.4g s, mean of %s" : "0 to %.4g s",
                 drawn.subject.until, jox_noun(runs, side->runs, "run"));
        good = jox_maps_draw_field(
            &drawn.subject,
            &(JoxMapField){.file = file,
                           .title = side->name,
                           .when = when,
                           .legend = "most people per m\xc2\xb2 " JOX_DENSITY_BY,
                           .show = JOX_SHOW_DENSITY,
                           .values = drawn.fields ? side->fields[JOX_FIELD_GREATEST].values : NULL,
                           .most = most},
            why);
    }
    jox_side_draw_end(&drawn);
    return good;
}

/* Returns whether a side's greatest densities can be compared with those of the base cell by cell:
   both have the same grid and storeys. */
static bool has_change(const JoxComparison *c, uint32_t s) {
    const JoxSide *side = &c->sides.items[s], *base = &c->sides.items[c->base];
    const JoxSweepField *f = &side->fields[JOX_FIELD_GREATEST];
    const JoxSweepField *g = &base->fields[JOX_FIELD_GREATEST];
    JoxSidePlan plans[2];
    if (s == c->base || !f->values || !g->values || f->columns != g->columns ||
        f->rows != g->rows || f->low_x != g->low_x || f->low_y != g->low_y || f->cell != g->cell ||
        !side->plan || !base->plan)
        return false;
    bool alike = jox_side_plan_read(&plans[0], side->plan);
    alike = jox_side_plan_read(&plans[1], base->plan) && alike &&
            plans[0].storeys.sheet_count == plans[1].storeys.sheet_count &&
            plans[0].storeys.pitch == plans[1].storeys.pitch &&
            plans[0].storeys.origin == plans[1].storeys.origin;
    jox_side_plan_free(&plans[0]);
    jox_side_plan_free(&plans[1]);
    return alike;
}

/* Returns the difference of a side's greatest densities to those of the base, by cell, in an array
   that the caller frees, and sets the greatest magnitude. */
static float *list_changes(const JoxComparison *c, uint32_t s, double *most) {
    const JoxSweepField *f = &c->sides.items[s].fields[JOX_FIELD_GREATEST];
    const float *base = c->sides.items[c->base].fields[JOX_FIELD_GREATEST].values;
    const size_t cells = (size_t)f->columns * f->rows;
    float *changes = jox_alloc(cells + 1, sizeof *changes);
    *most = 0;
    for (size_t k = 0; k < cells; k++) {
        changes[k] = f->values[k] - base[k];
        if (fabs((double)changes[k]) < 1000)
            *most = fmax(*most, fabs((double)changes[k]));
    }
    return changes;
}

static bool draw_side_change(const JoxComparison *c, uint32_t s, JoxText *why) {
    const JoxSide *side = &c->sides.items[s];
    JoxSideDrawn drawn;
    char file[40], title[240];
    bool good = true;
    snprintf(file, sizeof file, "change-%u", s + 1);
    snprintf(title, sizeof title, "%.100s minus %.100s", side->name, c->sides.items[c->base].name);
    if (jox_side_draw_begin(&drawn, side, c->def->out) && drawn.fields) {
        double most;
        float *changes = list_changes(c, s, &most);
        good = jox_maps_draw_field(&drawn.subject,
                                   &(JoxMapField){.file = file,
                                                  .title = title,
                                                  .when = "",
                                                  .legend = "change of most people per m\xc2\xb2",
                                                  .show = JOX_SHOW_DENSITY,
                                                  .values = changes,
                                                  .most = most,
                                                  .change = true},
                                   why);
        jox_free(changes);
    }
    jox_side_draw_end(&drawn);
    return good;
}

bool jox_compare_draw_plans(const JoxComparison *c, JoxText *why) {
    double most = 0; /* the same scale for all sides */
    bool good = true;
    for (uint32_t s = 0; s < c->sides.count; s++)
        most = fmax(most, jox_side_field_max(&c->sides.items[s], JOX_FIELD_GREATEST));
    for (uint32_t s = 0; good && s < c->sides.count; s++)
        good =
            draw_side_plan(c, s, most, why) && (!has_change(c, s) || draw_side_change(c, s, why));
    return good;
}

void jox_compare_put_plans(FILE *out, const JoxComparison *c) {
    JoxSideDrawn drawn;
    if (jox_side_draw_begin(&drawn, &c->sides.items[0], c->def->out)) {
        jox_maps_panels(out, &drawn.subject);
        for (uint32_t s = 0; s < c->sides.count; s++) {
            char file[40];
            snprintf(file, sizeof file, "plan-%u", s + 1);
            jox_html_figure(out, c->def->out, file, c->sides.items[s].name, false);
        }
        for (uint32_t s = 0; s < c->sides.count; s++) {
            char file[40], caption[300];
            snprintf(file, sizeof file, "change-%u", s + 1);
            snprintf(caption, sizeof caption,
                     "Change of the greatest density " JOX_DENSITY_BY ": %.100s minus %.100s",
                     c->sides.items[s].name, c->sides.items[c->base].name);
            jox_html_figure(out, c->def->out, file, caption, false);
        }
        jox_html_panels_end(out);
    }
    jox_side_draw_end(&drawn);
}
