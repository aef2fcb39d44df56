/* Draws the plan of each side, with the greatest density at each place as a mean over the side's
   runs. */
#include <math.h>
#include <stdio.h>
#include <string.h>

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

bool jox_side_draw_begin(JoxSideDrawn *drawn, const JoxSide *side, const char *folder) {
    const JoxSweepField *f = &side->fields[JOX_FIELD_GREATEST];
    *drawn = (JoxSideDrawn){0};
    if (!side->plan || !jox_side_plan_read(&drawn->plan, side->plan))
        return false;
    const JoxSidePlan *p = &drawn->plan;
    drawn->grid = (JoxDensity){.low = p->low, .cell = 1.0f};
    drawn->grid.columns = (uint32_t)ceilf(p->high.x - p->low.x);
    drawn->grid.rows = (uint32_t)ceilf(p->high.y - p->low.y);
    if (f->values)
        drawn->grid = (JoxDensity){.low = {(float)f->low_x, (float)f->low_y},
                                   .cell = (float)f->cell,
                                   .columns = f->columns,
                                   .rows = f->rows};
    list_exits(side, &drawn->exits);
    drawn->subject = (JoxSubject){.title = side->title && *side->title ? side->title : side->name,
                                  .folder = folder,
                                  .grid = &drawn->grid,
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
    char file[40], when[48];
    bool good = true;
    snprintf(file, sizeof file, "plan-%u", s + 1);
    if (jox_side_draw_begin(&drawn, side, c->def->out)) {
        snprintf(when, sizeof when, "0 to %.4g s", drawn.subject.until);
        good = jox_maps_draw_field(
            &drawn.subject,
            &(JoxMapField){.file = file,
                           .title = side->name,
                           .when = when,
                           .legend = side->runs > 1 ? "people per m\xc2\xb2 " JOX_DENSITY_BY
                                                      ", greatest of all times, mean of runs"
                                                    : "people per m\xc2\xb2 " JOX_DENSITY_BY
                                                      ", greatest of all times",
                           .show = JOX_SHOW_DENSITY,
                           .values = side->fields[JOX_FIELD_GREATEST].values,
                           .most = most},
            why);
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
        good = draw_side_plan(c, s, most, why);
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
        jox_html_panels_end(out);
    }
    jox_side_draw_end(&drawn);
}
