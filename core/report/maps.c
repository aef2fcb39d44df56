/* The plan of a report and its maps of density, load and crowd pressure, and the page's figures
   of them. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "picture/html.h"
#include "record/danger/danger_parts.h"
#include "report/danger_output_parts.h"
#include "report/maps.h"

enum { MOST_AS_SVG = 5000 /* people; pictures with more have no SVG */ };
static const float MARGIN = 1.0f; /* m: margin of the plan */

/* ---- common parts ---- */

float jox_maps_scale_end(double most) {
    static const float ENDS[] = {1, 2, 3, 4, 5, 6, 8, 10};
    if (!(most > 0.0))
        return 1.0f;
    const float power = powf(10.0f, floorf(log10f((float)most)));
    size_t e = 0;
    while (e < sizeof ENDS / sizeof *ENDS - 1 && (double)(ENDS[e] * power) < most * 0.999)
        e++;
    return ENDS[e] * power;
}

JoxPicture jox_maps_new_picture(const JoxSubject *s, const JoxFrame *frame) {
    const JoxDensity *g = s->grid;
    const JoxDrawnBodies *bodies = s->bodies;
    const bool storeys = jox_has_storeys(s->storeys);
    const float width = (float)g->columns * g->cell, height = (float)g->rows * g->cell;
    return (JoxPicture){.title = s->title,
                        .frame = frame,
                        .when = "",
                        .walls = s->walls,
                        .places = s->places,
                        .place_count = s->place_count,
                        .bodies = bodies ? bodies->items : NULL,
                        .body_count = bodies ? (uint32_t)bodies->count : 0,
                        .radius = 0.2f,
                        .storeys = s->storeys,
                        .lifts = s->lifts,
                        .lift_count = s->lift_count,
                        .low = {g->low.x, storeys ? s->storeys->low : g->low.y},
                        .high = {g->low.x + width, storeys ? s->storeys->high : g->low.y + height}};
}

/* Returns the names of the subject's exits in an array that the caller frees. */
static const char **list_exit_names(const JoxSubject *s) {
    const char **names = jox_alloc(s->exits->count + 1, sizeof *names);
    for (uint32_t e = 0; e < s->exits->count; e++)
        names[e] = s->exits->items[e].name;
    return names;
}

bool jox_maps_write_picture(const JoxSubject *s, const JoxPicture *picture, const char *name,
                            JoxText *error) {
    const bool images = jox_canvas_has_images();
    uint32_t width, height;
    bool good = true;
    if (picture->panel)
        jox_draw_panel_size(picture, &width, &height);
    else
        jox_draw_size(picture, &width, &height);
    for (int image = 0; good && image < 2; image++) {
        if (image ? !images : images && picture->frame->count > MOST_AS_SVG)
            continue;
        JoxText path = {0};
        JoxCanvas *canvas = image ? jox_canvas_image(width, height) : jox_canvas_svg(width, height);
        jox_text_printf(&path, "%s/%s.%s", s->folder, name, image ? "png" : "svg");
        jox_draw(canvas, picture);
        good = jox_canvas_write(canvas, path.data, error);
        jox_canvas_free(canvas);
        jox_text_free(&path);
    }
    return good;
}

/* ---- the plan ---- */

/* Finds the bounding box of positions, m in plan. */
static void find_plan_bounds(const JoxSubject *s, const JoxV2 *points, uint32_t count, JoxV2 *low,
                             JoxV2 *high) {
    jox_bounds(points, count, low, high);
    *low = jox_in_plan(s->storeys, *low);
    *high = jox_in_plan(s->storeys, *high);
}

/* Widens the area of a plan by a box, m, and a margin. */
static void widen_plan_area(JoxPicture *p, JoxV2 low, JoxV2 high) {
    p->low = (JoxV2){jox_minf(p->low.x, low.x - MARGIN), jox_minf(p->low.y, low.y - MARGIN)};
    p->high = (JoxV2){jox_maxf(p->high.x, high.x + MARGIN), jox_maxf(p->high.y, high.y + MARGIN)};
}

/* Returns the lines and areas of probes that measure somewhere, in an array that the caller
   frees. */
static JoxDrawnProbe *list_drawn_probes(const JoxSubject *s, uint32_t *count) {
    JoxDrawnProbe *probes = jox_alloc(s->probe_count + 1, sizeof *probes);
    *count = 0;
    for (uint32_t p = 0; p < s->probe_count; p++) {
        const JoxProbeDef *def = jox_probe_def(s->probes[p]);
        const bool area = def->kind == JOX_PROBE_MEASURE;
        if (area || def->kind == JOX_PROBE_FLOW || def->kind == JOX_PROBE_TRANSIT)
            probes[(*count)++] = (JoxDrawnProbe){def->name, def->points, def->count, area};
    }
    return probes;
}

bool jox_maps_draw_plan(const JoxSubject *s, JoxText *error) {
    const JoxFrame nobody = {.time = s->until};
    JoxPicture p = jox_maps_new_picture(s, &nobody);
    const JoxV2 size = jox_sub(p.high, p.low);
    const JoxV2 least = jox_sub(p.low, size), most = jox_add(p.high, size);
    const char **exits = list_exit_names(s);
    uint32_t probe_count;
    JoxDrawnProbe *probes = list_drawn_probes(s, &probe_count);
    for (uint32_t i = 0; i < s->place_count; i++) {
        JoxV2 low, high;
        if (jox_place_is_set(&s->places[i]) || s->places[i].count == 0)
            continue;
        find_plan_bounds(s, s->places[i].points, s->places[i].count, &low, &high);
        if (jox_is_within(low, least, most) && jox_is_within(high, least, most))
            widen_plan_area(&p, low, high);
    }
    for (uint32_t i = 0; i < probe_count; i++) {
        JoxV2 low, high;
        find_plan_bounds(s, probes[i].points, probes[i].count, &low, &high);
        if (jox_is_within(low, least, most) && jox_is_within(high, least, most))
            widen_plan_area(&p, low, high);
    }
    p.when = "plan";
    p.panel = true;
    p.exits = exits;
    p.exit_count = s->exits->count;
    p.probes = probes;
    p.probe_count = probe_count;
    const bool good = jox_maps_write_picture(s, &p, "plan", error);
    jox_free(exits);
    jox_free(probes);
    return good;
}

void jox_write_plan_html(FILE *out, const JoxSubject *s) {
    fputs("<div class=plan>", out);
    jox_html_figure(out, s->folder, "plan",
                    "The plan, in metres. Green: exits by which people left; blue: places; violet "
                    "and broken: lines and areas in which something is measured.",
                    true);
    fputs("</div>\n", out);
}

/* ---- maps over time ---- */

static const struct Map {
    const char *file;
    JoxDangerMeasure measure;
    bool greatest;
    const char *title, *legend;
} MAPS[] = {
    {"density", JOX_DANGER_DENSITY, false, "Mean density", "people per m\xc2\xb2 " JOX_DENSITY_BY},
    {"density-greatest", JOX_DANGER_DENSITY, true, "Greatest density",
     "people per m\xc2\xb2 " JOX_DENSITY_BY},
    {"load-greatest", JOX_DANGER_LOAD, true, "Greatest load", "load from one side, N"},
    {"pressure-greatest", JOX_DANGER_PRESSURE, true, "Greatest crowd pressure", "per s\xc2\xb2"},
};
enum { MAP_COUNT = sizeof MAPS / sizeof *MAPS };

/* Returns a map's value in a cell: the greatest of all times, or the mean density. */
static float read_map_value(const JoxSubject *s, const struct Map *map, size_t cell) {
    const uint32_t columns = s->grid->columns;
    return map->greatest ? (float)jox_danger_cell_greatest(s->danger, (int)map->measure, cell)
                         : (float)jox_density_mean(s->grid, (uint32_t)(cell % columns),
                                                   (uint32_t)(cell / columns));
}

/* Returns the greatest load of each wall piece, in an array that the caller frees, and raises
   `most` to the greatest of them, N. */
static JoxDrawnLoad *list_wall_loads(const JoxSubject *s, double *most, uint32_t *count) {
    const JoxDangerWalls *walls = &s->danger->walls;
    JoxDrawnLoad *loads = jox_alloc(walls->count + 1, sizeof *loads);
    *count = walls->known ? walls->count : 0;
    for (uint32_t p = 0; p < *count; p++) {
        const JoxDangerPiece *piece = &walls->items[p];
        loads[p] = (JoxDrawnLoad){{piece->from, piece->to}, piece->most};
        *most = fmax(*most, (double)piece->most);
    }
    return loads;
}

bool jox_maps_draw_field(const JoxSubject *s, const JoxMapField *map, JoxText *error) {
    const JoxFrame nobody = {.time = s->until};
    JoxPicture p = jox_maps_new_picture(s, &nobody);
    p.title = map->title;
    p.when = map->when;
    p.panel = true;
    p.grid = map->values ? s->grid : NULL;
    p.field = map->values;
    p.field_legend = map->legend;
    p.floor = map->show;
    p.floor_most = jox_maps_scale_end(map->most);
    p.change = map->change;
    p.wall_loads = map->wall_loads;
    p.wall_load_count = map->wall_load_count;
    return jox_maps_write_picture(s, &p, map->file, error);
}

/* Draws a map over time. Both maps of density have the same scale. */
static bool draw_field_map(const JoxSubject *s, const struct Map *map, JoxText *error) {
    const size_t cells = (size_t)s->grid->columns * s->grid->rows;
    float *field = jox_alloc(cells + 1, sizeof *field);
    double most = map->measure == JOX_DANGER_DENSITY ? (double)s->grid->most : 0.0;
    JoxDrawnLoad *loads = NULL;
    uint32_t load_count = 0;
    char when[64];
    for (size_t c = 0; c < cells; c++) {
        field[c] = read_map_value(s, map, c);
        most = fmax(most, isnan(field[c]) ? 0.0 : (double)field[c]);
    }
    if (map->measure == JOX_DANGER_LOAD)
        loads = list_wall_loads(s, &most, &load_count);
    snprintf(when, sizeof when, "%.4g to %.4g s",
             map->greatest ? s->from : fmax(s->from, s->mean_from), s->until);
    const bool good = jox_maps_draw_field(
        s,
        &(JoxMapField){.file = map->file,
                       .title = map->title,
                       .when = when,
                       .legend = map->legend,
                       .show = map->measure == JOX_DANGER_DENSITY    ? JOX_SHOW_DENSITY
                               : map->measure == JOX_DANGER_PRESSURE ? JOX_SHOW_PRESSURE
                                                                     : JOX_SHOW_LOAD,
                       .values = field,
                       .most = most,
                       .wall_loads = loads,
                       .wall_load_count = load_count},
        error);
    jox_free(field);
    jox_free(loads);
    return good;
}

/* Returns whether a map is drawn: those of loads and crowd pressure only if there were any. */
static bool is_map_drawn(const JoxSubject *s, const struct Map *map) {
    return map->measure == JOX_DANGER_DENSITY ||
           jox_danger_most(s->danger, map->measure).value > 0.0;
}

void jox_maps_panels(FILE *out, const JoxSubject *s) {
    uint32_t width, height;
    const JoxPicture p = jox_maps_new_picture(s, NULL);
    jox_html_panels(out, jox_draw_panel_size(&p, &width, &height));
}

void jox_write_maps_html(FILE *out, const JoxSubject *s) {
    jox_maps_panels(out, s);
    for (size_t m = 0; m < MAP_COUNT; m++)
        if (is_map_drawn(s, &MAPS[m])) {
            char caption[200];
            if (MAPS[m].measure == JOX_DANGER_DENSITY)
                snprintf(caption, sizeof caption, "%s " JOX_DENSITY_BY ", cells of %.3g m, %s",
                         MAPS[m].title, (double)s->grid->cell,
                         MAPS[m].greatest ? "greatest of all samples" : "mean of all samples");
            else
                snprintf(caption, sizeof caption, "%s, %s", MAPS[m].title,
                         MAPS[m].measure == JOX_DANGER_LOAD
                             ? "N: of people, from one side, and of walls, held for 1 s"
                             : "per s\xc2\xb2, of all samples");
            jox_html_figure(out, s->folder, MAPS[m].file, caption, false);
        }
    jox_html_panels_end(out);
}

bool jox_draw_maps(const JoxSubject *s, JoxText *error) {
    bool good = jox_maps_draw_plan(s, error);
    for (size_t m = 0; good && m < MAP_COUNT; m++)
        good = !is_map_drawn(s, &MAPS[m]) || draw_field_map(s, &MAPS[m], error);
    return good;
}
