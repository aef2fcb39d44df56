/* The legend: to the right of the map, written from top to bottom, or a strip below a panel's
   map. jox_draw calls jox_draw_legend last. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/plurals.h"
#include "picture/draw_parts.h"
#include "record/danger/levels.h"

static const float ROW = 19, TEXT = 13, BAR = 160; /* units: row height, font size, bar length */
enum { MOST_SHOWN = 10 }; /* above this many classes, empty ones are left out */

/* Where the next row of the legend goes. */
typedef struct Legend {
    JoxDrawing *d;
    float x, y, right, end; /* px: left edge, top of the next row, right edge, bottom */
    float bar;              /* units: length of colour bars */
} Legend;

static void write_legend_text(const Legend *l, float x, JoxAnchor anchor, bool bold,
                              const char *text) {
    float u = l->d->unit;
    jox_canvas_text(l->d->canvas, jox_v2(x, l->y + 13 * u), TEXT * u, anchor, bold, text);
}

static void write_legend_heading(Legend *l, const char *text) {
    l->y += 8 * l->d->unit;
    char fit[128];
    jox_draw_fit_text(fit, sizeof fit, text, TEXT * l->d->unit, true, l->right - l->x);
    write_legend_text(l, l->x, JOX_ANCHOR_START, true, fit);
    l->y += ROW * l->d->unit;
}

/* Writes a row: room for a symbol on the left, text, and on the right a number unless `count` is
   "". */
static void write_legend_row(Legend *l, const char *text, const char *count) {
    char fit[128];
    float u = l->d->unit, wide = l->right - l->x - 26 * u;
    wide -= *count ? jox_draw_text_width(count, TEXT * u, false) + 6 * u : 0;
    jox_draw_fit_text(fit, sizeof fit, text, TEXT * u, false, wide);
    write_legend_text(l, l->x + 26 * u, JOX_ANCHOR_START, false, fit);
    if (*count)
        write_legend_text(l, l->right, JOX_ANCHOR_END, false, count);
    l->y += ROW * u;
}

static JoxV2 find_symbol_centre(const Legend *l) {
    return jox_v2(l->x + 9 * l->d->unit, l->y + 8.5f * l->d->unit);
}

static void draw_disc_symbol(const Legend *l, JoxStyle style) {
    style.width = style.line.a > 0.0f ? l->d->unit : 0.0f;
    jox_canvas_open(l->d->canvas, NULL, "sign", style);
    jox_canvas_disc(l->d->canvas, find_symbol_centre(l), 6 * l->d->unit, NULL);
    jox_canvas_close(l->d->canvas);
}

static void draw_line_symbol(const Legend *l, JoxStyle style) {
    JoxV2 at = find_symbol_centre(l),
          ends[2] = {{at.x - 9 * l->d->unit, at.y}, {at.x + 9 * l->d->unit, at.y}};
    jox_canvas_open(l->d->canvas, NULL, "sign", style);
    jox_canvas_line(l->d->canvas, ends, 2, false, NULL);
    jox_canvas_close(l->d->canvas);
}

static void draw_box_symbol(const Legend *l, JoxStyle style) {
    float u = l->d->unit;
    JoxV2 a = find_symbol_centre(l);
    JoxV2 box[4] = {{a.x - 8 * u, a.y - 5 * u},
                    {a.x + 8 * u, a.y - 5 * u},
                    {a.x + 8 * u, a.y + 5 * u},
                    {a.x - 8 * u, a.y + 5 * u}};
    jox_canvas_open(l->d->canvas, NULL, "sign", style);
    jox_canvas_line(l->d->canvas, box, 4, true, NULL);
    jox_canvas_close(l->d->canvas);
}

/* Writes a row per class with its colour and number of people; classes that do not fit are
   summed up in a last row. */
static void write_class_rows(Legend *l) {
    const JoxDrawing *d = l->d;
    const JoxPicture *p = d->picture;
    uint32_t left = 0, hidden = 0, rest = 0;
    /* The class without a state or named group gets a row only if somebody is in it. */
    bool all = d->classes <= MOST_SHOWN;
    float room = l->end - l->y - ROW * d->unit;
    for (uint32_t k = 0; k < d->classes; k++) {
        const char *name;
        char count[JOX_NOUN];
        JoxInk ink = jox_draw_class_ink(d, k, &name);
        bool none = k == (p->colour == JOX_SHOW_STATE ? 0 : p->frame->group_count);
        if (d->people[k] == 0 && (!all || none))
            continue;
        if ((float)(left + 2) * ROW * d->unit > room) {
            hidden++;
            rest += d->people[k];
            continue;
        }
        left++;
        jox_number_text(count, d->people[k]);
        draw_disc_symbol(l, (JoxStyle){.fill = ink, .line = {0x20, 0x20, 0x20, 0.55f}});
        write_legend_row(l, name, count);
    }
    if (hidden) {
        char text[64], count[JOX_NOUN];
        snprintf(text, sizeof text, "and %u more", hidden);
        jox_number_text(count, rest);
        write_legend_row(l, text, count);
    }
}

/* Draws a colour bar labelled at its ends and middle; `most` is the value at its upper end,
   `floor` selects the floor's colours. */
static void draw_colour_bar(Legend *l, float most, bool floor) {
    const JoxDrawing *d = l->d;
    const uint32_t thick = d->picture->panel ? 1 : 3; /* thickness in cells */
    float u = d->unit, size = l->bar * u / JOX_DRAW_BINS;
    uint8_t levels[3 * JOX_DRAW_BINS];
    JoxInk ink[JOX_DRAW_BINS + 1] = {{0, 0, 0, 0}};
    char text[32];
    for (int k = 0; k < JOX_DRAW_BINS; k++) {
        ink[k + 1] = floor ? jox_draw_floor_ink(d->picture, (uint32_t)k)
                           : jox_draw_value_ink(d->picture, (uint32_t)k);
        levels[k] = levels[JOX_DRAW_BINS + k] = levels[2 * JOX_DRAW_BINS + k] = (uint8_t)(k + 1);
    }
    JoxCells cells = {{l->x, l->y}, size, JOX_DRAW_BINS, thick, levels, ink, JOX_DRAW_BINS + 1};
    jox_canvas_open(d->canvas, NULL, "bar", (JoxStyle){.fill = jox_ink_text});
    jox_canvas_cells(d->canvas, &cells);
    l->y += (float)thick * size + 2 * u;
    if (!floor && d->picture->colour == JOX_SHOW_DIRECTION) {
        static const char *const NAMES[] = {"E", "N", "W", "S", "E"};
        for (int k = 0; k < 5; k++)
            write_legend_text(l, l->x + 0.25f * (float)k * l->bar * u,
                              k == 0   ? JOX_ANCHOR_START
                              : k == 4 ? JOX_ANCHOR_END
                                       : JOX_ANCHOR_MIDDLE,
                              false, NAMES[k]);
        jox_canvas_close(d->canvas);
        l->y += ROW * u;
        return;
    }
    const bool change = floor && d->picture->change;
    snprintf(text, sizeof text, change ? "\xe2\x89\xa4 %.4g" : "0", -(double)most);
    write_legend_text(l, l->x, JOX_ANCHOR_START, false, text);
    snprintf(text, sizeof text, "%.4g", change ? 0.0 : (double)most / 2);
    write_legend_text(l, l->x + 0.5f * l->bar * u, JOX_ANCHOR_MIDDLE, false, text);
    snprintf(text, sizeof text, "\xe2\x89\xa5 %.4g", (double)most);
    write_legend_text(l, l->x + l->bar * u, JOX_ANCHOR_END, false, text);
    jox_canvas_close(d->canvas);
    l->y += ROW * u;
}

/* Writes the names of Fruin's levels of service for queues below a density bar, each where it
   begins. */
static void write_service_levels(Legend *l, float most) {
    const float u = l->d->unit, apart = 12 * u;
    jox_canvas_open(l->d->canvas, NULL, "levels", (JoxStyle){.fill = jox_ink_text});
    for (int k = 0; k < JOX_LEVELS; k++) {
        const float from = k ? l->bar * u / (float)jox_levels[k - 1].queue_area / most : 0.0f;
        const float next = l->bar * u / (float)jox_levels[k].queue_area / most;
        if (from <= l->bar * u && (k == JOX_LEVELS - 1 || next - from >= apart))
            write_legend_text(l, l->x + from, JOX_ANCHOR_START, false, jox_levels[k].name);
    }
    jox_canvas_close(l->d->canvas);
    if (l->d->picture->panel) /* the page explains the letters */
        return;
    l->y += ROW * u;
    write_legend_text(l, l->x, JOX_ANCHOR_START, false, "Fruin's levels for queues");
    l->y += ROW * u;
}

/* Writes the heading and colour bar of the field on the floor. */
static void write_field_legend(Legend *l) {
    const JoxPicture *p = l->d->picture;
    write_legend_heading(l, p->field_legend ? p->field_legend
                            : p->floor == JOX_SHOW_DENSITY
                                ? "Floor: density, 1/m\xc2\xb2 (Gaussian, R = 1 m)"
                                : "Floor: pressure, 1/s\xc2\xb2");
    draw_colour_bar(l, p->floor_most, true);
    if (p->floor == JOX_SHOW_DENSITY && !p->change)
        write_service_levels(l, p->floor_most);
}

/* Writes a row for each kind of line and box that the picture contains. */
static void write_symbol_rows(Legend *l) {
    const JoxPicture *p = l->d->picture;
    float u = l->d->unit;
    bool solid = false, wall = false, closed = false, open = false, above = false, lying = false;
    for (uint32_t r = 0; p->walls && r < p->walls->ring_count; r++) {
        const struct JoxWallRing *ring = &p->walls->rings[r];
        closed |= ring->name && !ring->open;
        open |= ring->name && ring->open;
        solid |= !ring->name && ring->solid;
        wall |= !ring->name && !ring->solid;
    }
    for (uint32_t b = 0; b < p->body_count; b++) {
        above |= p->bodies[b].high;
        lying |= !p->bodies[b].high;
    }
    l->y += 8 * u;
    if (l->d->headings) {
        draw_disc_symbol(l, (JoxStyle){.line = {0x20, 0x20, 0x20, 0.55f}});
        JoxV2 at = find_symbol_centre(l), ends[2] = {at, {at.x + 6 * u, at.y}};
        jox_canvas_open(l->d->canvas, NULL, "sign",
                        (JoxStyle){.line = {0x10, 0x10, 0x10, 0.85f}, .width = 1.4f * u});
        jox_canvas_line(l->d->canvas, ends, 2, false, NULL);
        jox_canvas_close(l->d->canvas);
        write_legend_row(l, "where they look", "");
    }
    if (l->d->fallen) {
        const JoxV2 at = find_symbol_centre(l);
        const float r = 5 * u;
        const JoxV2 ends[4] = {
            {at.x - r, at.y - r}, {at.x + r, at.y + r}, {at.x - r, at.y + r}, {at.x + r, at.y - r}};
        jox_canvas_open(l->d->canvas, NULL, "sign",
                        (JoxStyle){.line = {0x10, 0x10, 0x10, 1.0f}, .width = 1.4f * u});
        jox_canvas_segments(l->d->canvas, ends, 4);
        jox_canvas_close(l->d->canvas);
        write_legend_row(l, "fallen", "");
    }
    if (wall || solid) {
        if (solid)
            draw_box_symbol(l, (JoxStyle){jox_ink_solid, jox_ink_wall, 1.5f * u, 0});
        else
            draw_line_symbol(l, (JoxStyle){.line = jox_ink_wall, .width = 2.5f * u});
        write_legend_row(l, "wall", "");
    }
    if (closed) {
        draw_line_symbol(l, (JoxStyle){.line = jox_ink_gate, .width = 3 * u});
        write_legend_row(l, "gate, closed", "");
    }
    if (open) {
        draw_line_symbol(
            l,
            (JoxStyle){.line = jox_ink_with(jox_ink_gate, 0.7f), .width = 1.6f * u, .dash = 4 * u});
        write_legend_row(l, "gate, open", "");
    }
    if (p->place_count) {
        draw_box_symbol(l, (JoxStyle){jox_ink_with(jox_ink_place, 0.08f),
                                      jox_ink_with(jox_ink_place, 0.6f), 0.8f * u, 0});
        write_legend_row(l, "place", "");
    }
    if (p->lift_count && p->cars) {
        draw_box_symbol(l, (JoxStyle){jox_ink_with(jox_ink_place, 0.18f),
                                      jox_ink_with(jox_ink_place, 0.9f), 1.2f * u, 0});
        write_legend_row(l, "car of a lift", "");
    }
    if (p->exit_count) {
        draw_box_symbol(l,
                        (JoxStyle){jox_ink_with(jox_ink_exit, 0.14f), jox_ink_exit, 1.6f * u, 0});
        write_legend_row(l, "exit", "");
    }
    if (p->probe_count) {
        draw_line_symbol(l, (JoxStyle){.line = jox_ink_probe, .width = 1.8f * u, .dash = 4 * u});
        write_legend_row(l, "measured here", "");
    }
    if (lying) {
        draw_box_symbol(l, (JoxStyle){jox_ink_body, jox_ink_body_line, 1.2f * u, 0});
        write_legend_row(l, "body", "");
    }
    if (above) {
        draw_box_symbol(
            l, (JoxStyle){jox_ink_with(jox_ink_body, 0.6f), jox_ink_body_line, 1.2f * u, 3 * u});
        write_legend_row(l, "body out of reach", "");
    }
    if (p->trail_count) {
        char text[JOX_NOUN + 16], count[JOX_NOUN];
        jox_number_text(count, p->trail_people);
        snprintf(text, sizeof text, "paths of %s", count);
        draw_line_symbol(l, (JoxStyle){.line = jox_ink_path, .width = 1.2f * u});
        write_legend_row(l, text, "");
    }
}

/* Draws the map's scale: a length of 1, 2 or 5 times a power of ten, m. */
static void draw_scale_bar(const Legend *l) {
    const JoxDrawing *d = l->d;
    float u = d->unit, most = BAR * u / d->scale, length = powf(10.0f, floorf(log10f(most)));
    length *= most >= 5 * length ? 5.0f : most >= 2 * length ? 2.0f : 1.0f;
    float y = (float)d->canvas->height - 24 * u, x = l->x, end = l->x + length * d->scale;
    JoxV2 bar[4] = {{x, y - 5 * u}, {x, y}, {end, y}, {end, y - 5 * u}};
    char text[32];
    jox_canvas_open(d->canvas, "scale", NULL, (JoxStyle){.line = jox_ink_text, .width = 2 * u});
    jox_canvas_line(d->canvas, bar, 4, false, NULL);
    jox_canvas_close(d->canvas);
    snprintf(text, sizeof text, "%g m", (double)length);
    jox_canvas_text(d->canvas, jox_v2(x, y - 9 * u), TEXT * u, JOX_ANCHOR_START, false, text);
}

/* Writes the number of people; nothing if the picture shows no single moment. */
static void write_people_count(Legend *l) {
    const JoxPicture *p = l->d->picture;
    char text[JOX_NOUN + 16];
    if (p->when && p->frame->count == 0)
        return;
    jox_noun(text, p->frame->count, "person|people");
    if (l->d->outside)
        strcat(text, " in all");
    write_legend_text(l, l->x, JOX_ANCHOR_START, true, text);
    l->y += ROW * l->d->unit;
}

/* Draws the legend of a panel below its map: people and scale on the left, then the field. */
static void draw_legend_strip(JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    const float u = d->unit, top = (float)d->canvas->height - (JOX_DRAW_STRIP - 6) * u;
    Legend l = {.d = d, .bar = 1.6f * BAR, .x = 16 * u, .y = top};
    l.right = (float)d->canvas->width - 16 * u;
    jox_canvas_open(d->canvas, "legend", NULL, (JoxStyle){.fill = jox_ink_text});
    write_people_count(&l);
    draw_scale_bar(&l);
    l.x = 180 * u;
    l.y = top - 8 * u; /* write_legend_heading adds this much */
    if (p->grid)
        write_field_legend(&l);
    jox_canvas_close(d->canvas);
}

void jox_draw_legend(JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    float u = d->unit;
    if (p->panel) {
        draw_legend_strip(d);
        return;
    }
    Legend l = {.d = d,
                .bar = BAR,
                .x = d->legend_left,
                .y = 46 * u,
                .right = (float)d->canvas->width - 16 * u,
                .end = (float)d->canvas->height - 180 * u};
    char text[64];
    jox_canvas_open(d->canvas, "legend", NULL, (JoxStyle){.fill = jox_ink_text});
    write_people_count(&l);
    if (!p->frame->radius && p->frame->count) {
        snprintf(text, sizeof text, "drawn %.2g m in radius", (double)p->radius);
        write_legend_text(&l, l.x, JOX_ANCHOR_START, false, text);
        l.y += ROW * u;
    }
    if (p->colour != JOX_SHOW_NOTHING) {
        write_legend_heading(&l, jox_shown[p->colour].legend);
        if (jox_draw_is_class(p->colour))
            write_class_rows(&l);
        else
            draw_colour_bar(&l, p->colour_most, false);
        if (p->colour == JOX_SHOW_DENSITY)
            write_service_levels(&l, p->colour_most);
    }
    if (p->grid)
        write_field_legend(&l);
    write_symbol_rows(&l);
    draw_scale_bar(&l);
    jox_canvas_close(d->canvas);
}
