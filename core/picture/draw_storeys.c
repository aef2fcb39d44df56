/* Plans of several storeys in one picture: a panel for each storey, side by side, lowest first; and
   the stairs between them. People on a stair are in the panel of the storey from which it rises. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "geom/polygon.h"
#include "picture/draw_parts.h"

static const float GAP = 0.04f,
                   HEAD = 0.07f;  /* shares of a panel's longer side: beside it; above it */
static const float WANTED = 1.4f; /* width over height of all panels together */
static const float TREAD = 0.6f;  /* m between the lines across a flight */

/* Returns the size of a panel and what is around it, m. */
static JoxV2 find_step(const JoxPicture *p) {
    const JoxV2 size = jox_sub(p->high, p->low);
    const float longer = jox_maxf(size.x, size.y);
    return (JoxV2){size.x + GAP * longer, size.y + HEAD * longer};
}

static uint32_t count_rows(uint32_t panels, uint32_t columns) {
    return (panels + columns - 1) / columns;
}

/* Returns in how many columns panels come nearest to the wanted shape. */
static uint32_t choose_columns(uint32_t panels, JoxV2 step) {
    uint32_t best = 1;
    float least = INFINITY;
    for (uint32_t c = 1; c <= panels; c++) {
        const float shape = (float)c * step.x / ((float)count_rows(panels, c) * step.y);
        const float off = fabsf(logf(shape / WANTED));
        if (off < least) {
            least = off;
            best = c;
        }
    }
    return best;
}

JoxPanels jox_draw_lay_panels(const JoxPicture *p) {
    JoxPanels panels = {.low = p->low, .high = p->high};
    if (!jox_has_storeys(p->storeys))
        return panels;
    const uint32_t count = p->storeys->storey_count;
    panels.storeys = p->storeys;
    panels.step = find_step(p);
    panels.columns = choose_columns(count, panels.step);
    panels.rows = count_rows(count, panels.columns);
    panels.plan_low = p->low;
    panels.plan_high = p->high;
    panels.low = (JoxV2){0.0f, 0.0f};
    panels.high =
        (JoxV2){(float)panels.columns * panels.step.x, (float)panels.rows * panels.step.y};
    return panels;
}

uint32_t jox_draw_panel_of(const JoxPanels *panels, JoxV2 at) {
    const int32_t stair = jox_stair_at(panels->storeys, at);
    return stair < 0 ? jox_sheet_of(panels->storeys, at.y) : panels->storeys->stairs[stair].lower;
}

JoxV2 jox_draw_in_panel(const JoxPanels *panels, uint32_t panel, JoxV2 plan) {
    const float column = (float)(panel % panels->columns);
    const float row = (float)(panels->rows - 1 - panel / panels->columns);
    const JoxV2 corner = {(column + 0.5f) * panels->step.x -
                              0.5f * (panels->plan_high.x - panels->plan_low.x),
                          row * panels->step.y};
    return jox_add(corner, jox_sub(plan, panels->plan_low));
}

JoxV2 jox_draw_in_panels(const JoxPanels *panels, JoxV2 at) {
    return jox_draw_in_panel(panels, jox_draw_panel_of(panels, at),
                             jox_in_plan(panels->storeys, at));
}

/* Returns the pixels of a point of the plan in a panel. */
JoxV2 jox_draw_plan_pixels(const JoxDrawing *d, uint32_t panel, JoxV2 plan) {
    return jox_draw_panel_pixels(d, jox_draw_in_panel(&d->panels, panel, plan));
}

/* Draws the floor of each panel, and its name and height above it. */
void jox_draw_panel_floors(JoxDrawing *d, JoxInk ground) {
    const JoxPanels *p = &d->panels;
    const JoxStyle floor = {
        .fill = ground, .line = jox_ink_with(jox_ink_faint, 0.5f), .width = d->unit};
    jox_canvas_open(d->canvas, "storeys", NULL, (JoxStyle){0});
    for (uint32_t k = 0; k < p->storeys->storey_count; k++) {
        const JoxV2 low = jox_draw_plan_pixels(d, k, p->plan_low),
                    high = jox_draw_plan_pixels(d, k, p->plan_high);
        const JoxV2 box[4] = {low, {high.x, low.y}, high, {low.x, high.y}};
        const float size = jox_minf(
            14.0f * d->unit, 0.55f * (p->step.y - (p->plan_high.y - p->plan_low.y)) * d->scale);
        char name[160];
        snprintf(name, sizeof name, "%s, %.3g m", p->storeys->storeys[k].name,
                 (double)p->storeys->storeys[k].height);
        jox_canvas_open(d->canvas, NULL, "storey", floor);
        jox_canvas_line(d->canvas, box, 4, true, name);
        jox_canvas_close(d->canvas);
        if (d->label_count < JOX_DRAW_LABELS) { /* no other name is written there */
            d->labels[d->label_count].low = jox_v2(low.x, high.y - 1.2f * size);
            d->labels[d->label_count++].high =
                jox_v2(low.x + jox_draw_text_width(name, size, true), high.y);
        }
        jox_canvas_open(d->canvas, NULL, "storey-name", (JoxStyle){.fill = jox_ink_text});
        jox_canvas_text(d->canvas, jox_v2(low.x, high.y - 0.35f * size), size, JOX_ANCHOR_START,
                        true, name);
        jox_canvas_close(d->canvas);
    }
    jox_canvas_close(d->canvas);
}

/* Draws the treads of a stair's flights. */
static void draw_flights(const JoxDrawing *d, const JoxStair *stair) {
    const JoxStoreys *s = d->panels.storeys;
    for (uint32_t f = stair->first_flight; f < stair->first_flight + stair->flight_count; f++) {
        const JoxFlight *flight = &s->flights[f];
        const JoxV2 aside = jox_scale(jox_left(flight->along), 0.5f * stair->width);
        for (float at = 0.0f; at <= flight->run + 0.01f; at += TREAD) {
            const JoxV2 middle = jox_add(flight->from, jox_scale(flight->along, at));
            const JoxV2 ends[2] = {jox_draw_plan_pixels(d, stair->lower, jox_sub(middle, aside)),
                                   jox_draw_plan_pixels(d, stair->lower, jox_add(middle, aside))};
            jox_canvas_line(d->canvas, ends, 2, false, NULL);
        }
    }
}

/* Draws an arrow along a stair's path: upwards, or the way that it is walked. */
static void draw_arrow(const JoxDrawing *d, const JoxStair *stair) {
    const uint32_t n = stair->path_count;
    const bool down = stair->way == JOX_STAIR_DOWN;
    for (uint32_t k = 0; k + 1 < n; k++) {
        const JoxV2 ends[2] = {jox_draw_plan_pixels(d, stair->lower, stair->path[k]),
                               jox_draw_plan_pixels(d, stair->lower, stair->path[k + 1])};
        jox_canvas_line(d->canvas, ends, 2, false, NULL);
    }
    const JoxV2 tip = stair->path[down ? 0 : n - 1], before = stair->path[down ? 1 : n - 2];
    const JoxV2 back =
        jox_scale(jox_unit(jox_sub(before, tip)), jox_minf(0.5f, 0.4f * stair->width));
    const JoxV2 side = jox_scale(jox_left(back), 0.6f);
    const JoxV2 head[3] = {
        jox_draw_plan_pixels(d, stair->lower, jox_add(tip, jox_add(back, side))),
        jox_draw_plan_pixels(d, stair->lower, tip),
        jox_draw_plan_pixels(d, stair->lower, jox_add(tip, jox_sub(back, side)))};
    jox_canvas_line(d->canvas, head, 3, false, NULL);
}

/* Draws the hole of a stair in a storey above its foot: crossed by its diagonals. */
static void draw_hole(const JoxDrawing *d, const JoxStair *stair, uint32_t storey) {
    const JoxV2 low = stair->low, high = stair->high;
    const JoxV2 one[2] = {jox_draw_plan_pixels(d, storey, low),
                          jox_draw_plan_pixels(d, storey, high)};
    const JoxV2 two[2] = {jox_draw_plan_pixels(d, storey, jox_v2(low.x, high.y)),
                          jox_draw_plan_pixels(d, storey, jox_v2(high.x, low.y))};
    jox_canvas_line(d->canvas, one, 2, false, stair->name);
    jox_canvas_line(d->canvas, two, 2, false, stair->name);
}

/* Returns whether another stair rises from a storey over the footprint of this one. */
static bool is_built_over(const JoxStoreys *s, const JoxStair *stair, uint32_t storey) {
    for (uint32_t k = 0; k < s->stair_count; k++)
        if (s->stairs[k].lower == storey && &s->stairs[k] != stair &&
            jox_boxes_meet(stair->low, stair->high, s->stairs[k].low, s->stairs[k].high))
            return true;
    return false;
}

void jox_draw_stairs(JoxDrawing *d) {
    const JoxStoreys *s = d->panels.storeys;
    const JoxStyle treads = {.line = jox_ink_with(jox_ink_wall, 0.35f), .width = 0.8f * d->unit};
    const JoxStyle arrow = {.line = jox_ink_with(jox_ink_wall, 0.7f), .width = 1.2f * d->unit};
    const JoxStyle hole = {
        .line = jox_ink_with(jox_ink_faint, 0.6f), .width = 0.8f * d->unit, .dash = 4 * d->unit};
    jox_canvas_open(d->canvas, "stairs", NULL, (JoxStyle){0});
    for (uint32_t k = 0; k < s->stair_count; k++) {
        const JoxStair *stair = &s->stairs[k];
        jox_canvas_open(d->canvas, NULL, "treads", treads);
        if (stair->kind != JOX_STAIR_RAMP)
            draw_flights(d, stair);
        jox_canvas_close(d->canvas);
        jox_canvas_open(d->canvas, NULL, "stair", arrow);
        draw_arrow(d, stair);
        jox_canvas_close(d->canvas);
        jox_canvas_open(d->canvas, NULL, "hole", hole);
        for (uint32_t storey = stair->lower + 1; storey <= stair->upper; storey++)
            if (!is_built_over(s, stair, storey))
                draw_hole(d, stair, storey);
        jox_canvas_close(d->canvas);
    }
    jox_canvas_close(d->canvas);
}

/* Draws the cells of a field that lie in one panel. */
static void draw_panel_field(JoxDrawing *d, uint32_t panel, const uint8_t *levels,
                             const JoxInk *ink) {
    const JoxPanels *p = &d->panels;
    const JoxDensity *grid = d->picture->grid;
    const uint32_t columns = (uint32_t)ceilf((p->plan_high.x - p->plan_low.x) / grid->cell) + 1;
    const uint32_t rows = (uint32_t)ceilf((p->plan_high.y - p->plan_low.y) / grid->cell) + 1;
    uint8_t *here = jox_alloc((size_t)columns * rows, 1);
    memset(here, 0, (size_t)columns * rows);
    for (size_t cell = 0; cell < (size_t)grid->columns * grid->rows; cell++) {
        const JoxV2 at = jox_density_middle(grid, cell);
        if (!levels[cell] || !isfinite(at.y) || jox_draw_panel_of(p, at) != panel)
            continue;
        const JoxV2 plan = jox_sub(jox_in_plan(p->storeys, at), p->plan_low);
        const float c = plan.x / grid->cell, r = plan.y / grid->cell;
        if (c >= 0.0f && r >= 0.0f && c < (float)columns && r < (float)rows)
            here[(size_t)(rows - 1 - (uint32_t)r) * columns + (uint32_t)c] = levels[cell];
    }
    const JoxV2 top = {p->plan_low.x, p->plan_low.y + (float)rows * grid->cell};
    const JoxCells cells = {jox_draw_plan_pixels(d, panel, top),
                            grid->cell * d->scale,
                            columns,
                            rows,
                            here,
                            ink,
                            JOX_DRAW_BINS + 1};
    jox_canvas_cells(d->canvas, &cells);
    jox_free(here);
}

void jox_draw_panel_fields(JoxDrawing *d, const uint8_t *levels, const JoxInk *ink) {
    for (uint32_t k = 0; k < d->panels.storeys->storey_count; k++)
        draw_panel_field(d, k, levels, ink);
}
