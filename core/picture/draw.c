/* Layout of a picture and all map layers except people and names; jox_draw is the entry point. */
#include "picture/draw.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "picture/draw_parts.h"

/* px at the usual size: height of the title line, width of the legend, margin around the map */
static const float HEAD = 46, LEGEND = 206, EDGE = 16;
static const float WIDE = 1280, LOW = 480; /* px: usual width, least height */

void jox_draw_size(const JoxPicture *picture, uint32_t *width, uint32_t *height) {
    const JoxPanels area = jox_draw_lay_panels(picture);
    const JoxV2 low = area.low, high = area.high;
    float wide = WIDE - LEGEND - 2 * EDGE;
    float tall = wide * (high.y - low.y) / (high.x - low.x);
    if (tall > 960.0f) { /* a tall area makes a narrow picture */
        wide = jox_maxf(wide * 960.0f / tall, 420.0f);
        tall = 960.0f;
    }
    tall = jox_maxf(tall, LOW - HEAD - EDGE);
    *width = (uint32_t)(wide + LEGEND + 2 * EDGE + 1.0f) / 2 * 2;
    *height = (uint32_t)(tall + HEAD + EDGE + 1.0f) / 2 * 2;
}

/* Returns `unit` of a panel; a wide one is shown smaller on the page, so its unit is greater. */
static float panel_unit(float wide) {
    return wide > 1500 ? 2.6f : 2.0f;
}

bool jox_draw_panel_size(const JoxPicture *picture, uint32_t *width, uint32_t *height) {
    /* width of half a line, px; least and greatest height over width */
    static const float HALF = 1140, FLAT = 0.4f, HIGH = 1.25f;
    const JoxPanels area = jox_draw_lay_panels(picture);
    const float aspect = (area.high.y - area.low.y) / (area.high.x - area.low.x);
    const bool whole = aspect < FLAT;
    const float u = panel_unit(whole ? 2 * HALF : HALF);
    const float wide = whole ? 2 * HALF : HALF;
    const float map = (wide - 2 * EDGE * u) * jox_clampf(aspect, 0.05f, HIGH);
    *width = (uint32_t)wide;
    *height = (uint32_t)(map + (HEAD + JOX_DRAW_STRIP) * u + 1.0f) / 2 * 2;
    return whole;
}

/* ---- map ---- */

/* Sets the unit, the scale and the map's box, centred in the room that title and legend leave. */
static void lay_out_map(JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    float wide = (float)d->canvas->width, tall = (float)d->canvas->height;
    d->unit = jox_clampf(jox_minf(wide / WIDE, tall / LOW), 0.75f, 6.0f);
    if (wide < WIDE) /* a narrow picture of a tall area */
        d->unit = jox_clampf(tall / 800.0f, 0.75f, jox_maxf(0.75f, wide / 640.0f));
    if (p->panel)
        d->unit = panel_unit(wide);
    float u = d->unit;
    d->legend_left = wide - (p->panel ? 0 : LEGEND * u);
    JoxV2 low = {EDGE * u, HEAD * u};
    JoxV2 high = {d->legend_left - EDGE * u, tall - (p->panel ? JOX_DRAW_STRIP : EDGE) * u};
    JoxV2 size = jox_sub(d->panels.high, d->panels.low);
    d->scale = jox_minf((high.x - low.x) / size.x, (high.y - low.y) / size.y);
    JoxV2 spare = jox_scale(jox_sub(jox_sub(high, low), jox_scale(size, d->scale)), 0.5f);
    d->low = jox_v2(low.x + spare.x, low.y + spare.y);
    d->high = jox_v2(high.x - spare.x, high.y - spare.y);
}

/* Draws the outlines of places; exits in a style of their own. */
static void draw_places(JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    JoxCanvas *c = d->canvas;
    float u = d->unit;
    JoxStyle line = {.line = jox_ink_with(jox_ink_place, 0.8f), .width = 1.2f * u, .dash = 5 * u};
    /* no fill over a field, which would change its colours */
    JoxStyle area = {.fill = jox_ink_with(jox_ink_place, p->grid ? 0.0f : 0.08f),
                     .line = jox_ink_with(jox_ink_place, 0.6f),
                     .width = 0.8f * u};
    JoxStyle exit = {
        .fill = jox_ink_with(jox_ink_exit, 0.14f), .line = jox_ink_exit, .width = 1.6f * u};
    JoxStyle exit_line = {.line = jox_ink_exit, .width = 2.0f * u, .dash = 5 * u};
    jox_canvas_open(c, "places", NULL, area);
    for (uint32_t i = 0; i < p->place_count; i++) {
        const JoxPlace *place = &p->places[i];
        const JoxPlaceOutline outline = jox_place_outline(place);
        bool open = outline == JOX_OUTLINE_OPEN;
        if (place->count == 0 || outline == JOX_OUTLINE_NONE)
            continue;
        if (jox_draw_is_exit(p, place->name))
            jox_canvas_open(c, NULL, "exit", open ? exit_line : exit);
        else if (open)
            jox_canvas_open(c, NULL, "line", line);
        if (outline == JOX_OUTLINE_CIRCLE)
            jox_canvas_disc(c, jox_draw_to_pixels(d, place->points[0]),
                            jox_maxf(place->radius * d->scale, 3 * u), NULL);
        else
            jox_draw_plan_line(d, place->points, place->count, !open, place->name);
        if (open || jox_draw_is_exit(p, place->name))
            jox_canvas_close(c);
    }
    jox_canvas_close(c);
}

/* Draws ring r of the walls, unless it is the second side of a thin wall. */
static void draw_wall_ring(const JoxDrawing *d, uint32_t r) {
    const JoxWalls *walls = d->picture->walls;
    const struct JoxWallRing *ring = &walls->rings[r];
    bool closed;
    uint32_t count = jox_draw_ring_points(walls, r, &closed);
    JoxV2 *points = jox_alloc(count + 1, sizeof *points);
    for (uint32_t i = 0; i < count; i++)
        points[i] = walls->vertices[ring->first + i].point;
    if (count)
        jox_draw_plan_line(d, points, count, closed, ring->name);
    jox_free(points);
}

/* Returns the group of a wall: solids, thin walls, closed gates, open gates. A solid in whose place
   scenery is drawn is outlined as a thin wall. */
static int find_wall_group(const JoxPicture *p, const struct JoxWallRing *ring) {
    return ring->name ? 2 + ring->open : !ring->solid || jox_draw_fills_wall(p, ring);
}

/* Draws walls in four groups. */
static void draw_walls(JoxDrawing *d) {
    const JoxWalls *walls = d->picture->walls;
    float u = d->unit;
    const JoxStyle styles[] = {
        {.fill = jox_ink_solid, .line = jox_ink_wall, .width = 1.5f * u},
        {.line = jox_ink_wall, .width = 2.5f * u},
        {.line = jox_ink_gate, .width = 3.0f * u},
        {.line = jox_ink_with(jox_ink_gate, 0.7f), .width = 1.6f * u, .dash = 4 * u}};
    static const char *const kinds[] = {"solid", "wall", "gate closed", "gate open"};
    jox_canvas_open(d->canvas, "walls", NULL, (JoxStyle){0});
    for (int kind = 0; kind < 4; kind++) {
        bool any = false;
        for (uint32_t r = 0; walls && r < walls->ring_count; r++) {
            const struct JoxWallRing *ring = &walls->rings[r];
            if (find_wall_group(d->picture, ring) != kind)
                continue;
            if (!any)
                jox_canvas_open(d->canvas, NULL, kinds[kind], styles[kind]);
            any = true;
            draw_wall_ring(d, r);
        }
        if (any)
            jox_canvas_close(d->canvas);
    }
    jox_canvas_close(d->canvas);
}

/* Draws pieces of walls in the colour of their load's bin. Pieces in the lowest bin stay as
   walls. */
static void draw_wall_loads(JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    for (uint32_t k = 1; k < JOX_DRAW_BINS && p->wall_load_count; k++) {
        JoxStyle style = {.line = jox_draw_floor_ink(p, k), .width = 5 * d->unit};
        jox_canvas_open(d->canvas, NULL, "load", style);
        for (uint32_t i = 0; i < p->wall_load_count; i++) {
            const float share = p->wall_loads[i].value / p->floor_most;
            if ((uint32_t)jox_minf(share * JOX_DRAW_BINS, JOX_DRAW_BINS - 1) == k)
                jox_draw_plan_line(d, p->wall_loads[i].ends, 2, false, NULL);
        }
        jox_canvas_close(d->canvas);
    }
}

/* Draws the bodies that people touch, or with `high` those out of reach, which go above people. */
static void draw_body_layer(JoxDrawing *d, bool high) {
    const JoxPicture *p = d->picture;
    float u = d->unit;
    JoxStyle style = {.fill = jox_ink_with(jox_ink_body, high ? 0.6f : 1.0f),
                      .line = jox_ink_body_line,
                      .width = 1.2f * u,
                      .dash = high ? 3 * u : 0};
    jox_canvas_open(d->canvas, high ? "bodies-above" : "bodies", NULL, style);
    for (uint32_t b = 0; b < p->body_count; b++) {
        const JoxDrawnBody *body = &p->bodies[b];
        if (body->high != high)
            continue;
        if (body->count)
            jox_draw_plan_line(d, body->ring, body->count, true, body->name);
        else
            jox_canvas_disc(d->canvas, jox_draw_to_pixels(d, body->at),
                            jox_maxf(body->radius * d->scale, 2 * u), NULL);
    }
    jox_canvas_close(d->canvas);
}

/* Returns whether a trail goes on from a point to the next one, in the same panel. */
static bool goes_on(const JoxDrawing *d, const JoxTrail *trail, uint32_t to) {
    return !d->panels.storeys || jox_draw_panel_of(&d->panels, trail->points[to]) ==
                                     jox_draw_panel_of(&d->panels, trail->points[to - 1]);
}

/* Draws the trails of people and bodies, interrupted at points that are not finite, and where they
   change the storey. */
static void draw_trails(JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    float u = d->unit;
    jox_canvas_open(d->canvas, "paths", NULL, (JoxStyle){0});
    for (uint32_t t = 0; t < p->trail_count; t++) {
        const JoxTrail *trail = &p->trails[t];
        JoxStyle style = {.line = jox_ink_path, .width = 1.2f * u};
        if (p->colour == JOX_SHOW_GROUP && !trail->body)
            style.line =
                jox_ink_with(d->inks[trail->group < p->frame->group_count ? trail->group
                                                                          : p->frame->group_count],
                             0.7f);
        if (trail->body)
            style = (JoxStyle){.line = jox_ink_body_line, .width = 1.2f * u, .dash = 4 * u};
        jox_canvas_open(d->canvas, NULL, trail->body ? "body" : "person", style);
        for (uint32_t from = 0, to; from < trail->count; from = to) {
            for (to = from; to < trail->count && isfinite(trail->points[to].x) &&
                            (to == from || goes_on(d, trail, to));)
                to++;
            if (to - from > 1)
                jox_draw_plan_line(d, trail->points + from, to - from, false, NULL);
            to += to == from;
        }
        jox_canvas_close(d->canvas);
    }
    jox_canvas_close(d->canvas);
}

/* Writes the title, shortened to fit, and the time at its right. */
static void draw_title_line(const JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    char fit[256], time[64];
    float u = d->unit, wide = (float)d->canvas->width;
    if (p->when)
        snprintf(time, sizeof time, "%s", p->when);
    else
        snprintf(time, sizeof time, "t = %.2f s", p->frame->time);
    float room = wide - 3 * EDGE * u - jox_draw_text_width(time, 17 * u, true);
    jox_draw_fit_text(fit, sizeof fit, p->title, 19 * u, true, room);
    jox_canvas_open(d->canvas, "head", NULL, (JoxStyle){.fill = jox_ink_text});
    jox_canvas_text(d->canvas, jox_v2(EDGE * u, 30 * u), 19 * u, JOX_ANCHOR_START, true, fit);
    jox_canvas_open(d->canvas, "time", NULL, (JoxStyle){.fill = jox_ink_text});
    jox_canvas_text(d->canvas, jox_v2(wide - EDGE * u, 30 * u), 17 * u, JOX_ANCHOR_END, true, time);
    jox_canvas_close(d->canvas);
    jox_canvas_close(d->canvas);
}

static void draw_map_box(const JoxDrawing *d, const char *id, JoxStyle style) {
    JoxV2 box[4] = {d->low, {d->high.x, d->low.y}, d->high, {d->low.x, d->high.y}};
    jox_canvas_open(d->canvas, id, NULL, style);
    jox_canvas_line(d->canvas, box, 4, true, NULL);
    jox_canvas_close(d->canvas);
}

void jox_draw(JoxCanvas *canvas, const JoxPicture *picture) {
    JoxDrawing *d = jox_alloc(1, sizeof *d);
    d->canvas = canvas;
    d->picture = picture;
    d->panels = jox_draw_lay_panels(picture);
    jox_canvas_begin(canvas, picture->title);
    lay_out_map(d);
    jox_draw_choose_classes(d);
    draw_title_line(d);
    if (d->panels.storeys)
        jox_draw_panel_floors(d, jox_draw_ground_ink(picture));
    else
        draw_map_box(d, "floor", (JoxStyle){.fill = jox_draw_ground_ink(picture)});
    jox_canvas_clip(canvas, d->low, d->high);
    jox_draw_scenery(d);
    jox_draw_field(d);
    if (d->panels.storeys)
        jox_draw_stairs(d);
    jox_draw_lifts(d);
    draw_places(d);
    draw_trails(d);
    draw_walls(d);
    draw_wall_loads(d);
    jox_draw_probes(d);
    draw_body_layer(d, false);
    jox_draw_people(d);
    draw_body_layer(d, true);
    jox_draw_names(d);
    jox_canvas_close(canvas);
    if (!d->panels.storeys)
        draw_map_box(d, "frame",
                     (JoxStyle){.line = jox_ink_with(jox_ink_faint, 0.5f), .width = d->unit});
    jox_draw_legend(d);
    jox_free(d->people);
    jox_free(d->inks);
    jox_free(d);
}
