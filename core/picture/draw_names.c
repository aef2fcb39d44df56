/* Probes on the map, and the names of gates, places, exits and probes, placed so that none
   covers another. */
#include <math.h>
#include <string.h>

#include "picture/draw_parts.h"

static const JoxInk WHITE = {0xff, 0xff, 0xff, 1};

bool jox_draw_is_exit(const JoxPicture *p, const char *name) {
    for (uint32_t e = 0; name && e < p->exit_count; e++)
        if (strcmp(p->exits[e], name) == 0)
            return true;
    return false;
}

/* Reserves a box (px) for a name. Returns false if it leaves the map, overlaps a reserved one,
   or the list is full. */
static bool reserve_label_box(JoxDrawing *d, JoxV2 low, JoxV2 high) {
    if (low.x < d->low.x || low.y < d->low.y || high.x > d->high.x || high.y > d->high.y ||
        d->label_count == JOX_DRAW_LABELS)
        return false;
    for (uint32_t i = 0; i < d->label_count; i++)
        if (low.x < d->labels[i].high.x && d->labels[i].low.x < high.x &&
            low.y < d->labels[i].high.y && d->labels[i].low.y < high.y)
            return false;
    d->labels[d->label_count].low = low;
    d->labels[d->label_count++].high = high;
    return true;
}

/* Draws a line from a point to the box of the name beside it. */
static void draw_leader_line(JoxDrawing *d, JoxV2 from, JoxV2 low, JoxV2 high, JoxInk ink) {
    const JoxV2 to = {jox_clampf(from.x, low.x, high.x), jox_clampf(from.y, low.y, high.y)};
    const JoxStyle style = {.line = jox_ink_with(ink, 0.7f), .width = 0.8f * d->unit};
    jox_canvas_open(d->canvas, NULL, "lead", style);
    jox_canvas_line(d->canvas, (const JoxV2[]){from, to}, 2, false, NULL);
    jox_canvas_close(d->canvas);
}

/* Writes a name at a point of the plan (m). If another name is there, it goes a line above or
   below, else farther away in one of eight directions with a leader line. If all spots are
   taken, it is left out. */
static void write_map_name(JoxDrawing *d, JoxV2 at, const char *text, bool bold, JoxInk ink) {
    static const JoxV2 sides[] = {{1, 0},       {-1, 0},       {0.8f, -0.6f}, {-0.8f, -0.6f},
                                  {0.8f, 0.6f}, {-0.8f, 0.6f}, {0, -1},       {0, 1}};
    enum { SIDES = sizeof sides / sizeof *sides, NEAR = 3, RINGS = 5 };
    /* Maps of several storeys in one picture are smaller. */
    const float size = 12 * d->unit * (d->panels.columns > 1 ? 0.7f : 1.0f);
    char fit[128];
    jox_draw_fit_text(fit, sizeof fit, text, size, bold, 240 * d->unit);
    const float half = 0.5f * jox_draw_text_width(fit, size, bold) + 2 * d->unit;
    const JoxV2 point = jox_draw_to_pixels(d, at);
    if (point.x < d->low.x || point.x > d->high.x || point.y < d->low.y || point.y > d->high.y)
        return;
    /* Names at an edge move inwards. */
    const JoxV2 on = {
        jox_clampf(point.x, jox_minf(d->low.x + half, d->high.x - half), d->high.x - half),
        jox_clampf(point.y, d->low.y + size, d->high.y - size)};
    for (int t = 0; t < NEAR + RINGS * SIDES; t++) {
        JoxV2 here = on;
        if (t < NEAR) {
            here.y += (float)((t == 2) - (t == 1)) * 1.3f * size;
        } else {
            const JoxV2 side = sides[(t - NEAR) % SIDES];
            const float away = (1.6f + 1.4f * (float)((t - NEAR) / SIDES)) * size;
            here.x += side.x * away + (float)((side.x > 0) - (side.x < 0)) * half;
            here.y += side.y * away;
        }
        const JoxV2 low = {here.x - half, here.y - 0.6f * size},
                    high = {here.x + half, here.y + 0.6f * size};
        if (!reserve_label_box(d, low, high))
            continue;
        if (t >= NEAR)
            draw_leader_line(d, point, low, high, ink);
        jox_canvas_text(d->canvas, jox_v2(here.x, here.y + 0.35f * size), size, JOX_ANCHOR_MIDDLE,
                        bold, fit);
        return;
    }
}

/* Returns where a place's name goes, m: within an area at its upper edge, so that it hides few
   people. */
static JoxV2 find_place_name_spot(const JoxDrawing *d, const JoxPlace *place) {
    JoxV2 low, high;
    float line = 10 * d->unit / d->scale; /* m: from an edge to the middle of a line of text */
    if (jox_place_outline(place) != JOX_OUTLINE_RING)
        return place->centre;
    jox_bounds(place->points, place->count, &low, &high);
    JoxV2 at = {place->centre.x, high.y - line};
    bool roomy = high.y - low.y > 4 * line && jox_polygon_contains(place->points, place->count, at);
    return roomy ? at : place->centre;
}

/* Returns where a gate's name goes, m: beside the gate, on the side away from the middle of the
   map. */
static JoxV2 find_gate_name_spot(const JoxDrawing *d, const struct JoxWallRing *ring) {
    const JoxPicture *p = d->picture;
    const JoxWallVertex *first = &p->walls->vertices[ring->first];
    JoxV2 sum = {0, 0};
    for (uint32_t i = 0; i < ring->count; i++)
        sum = jox_add(sum, first[i].point);
    JoxV2 middle = jox_scale(sum, 1.0f / (float)ring->count);
    JoxV2 out = jox_sub(middle, jox_scale(jox_add(p->low, p->high), 0.5f));
    JoxV2 normal = jox_left(first->direction);
    normal = jox_dot(normal, out) < 0.0f ? jox_scale(normal, -1.0f) : normal;
    float size = 12 * d->unit, half = 0.5f * jox_draw_text_width(ring->name, size, false);
    float away = (fabsf(normal.x) * half + fabsf(normal.y) * 0.6f * size + 5 * d->unit) / d->scale;
    return jox_add(middle, jox_scale(normal, away));
}

/* Returns where a probe's name goes, m: beside the middle of a line, or within an area at its
   lower edge. */
static JoxV2 find_probe_name_spot(const JoxDrawing *d, const JoxDrawnProbe *probe) {
    JoxV2 low, high;
    float line = 10 * d->unit / d->scale;
    jox_bounds(probe->points, probe->count, &low, &high);
    if (probe->closed)
        return jox_v2(0.5f * (low.x + high.x), high.y - low.y > 4 * line ? low.y + line : low.y);
    JoxV2 a = probe->points[0], b = probe->points[1], along = jox_unit(jox_sub(b, a));
    JoxV2 middle = jox_scale(jox_add(a, b), 0.5f), normal = jox_left(along);
    float size = 12 * d->unit, half = 0.5f * jox_draw_text_width(probe->name, size, false);
    float away = (fabsf(normal.x) * half + fabsf(normal.y) * 0.6f * size + 6 * d->unit) / d->scale;
    return jox_add(middle, jox_scale(normal, away));
}

/* Draws the lines and areas of probes. */
void jox_draw_probes(JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    if (p->probe_count == 0)
        return;
    JoxStyle style = {.line = jox_ink_probe, .width = 1.8f * d->unit, .dash = 4 * d->unit};
    jox_canvas_open(d->canvas, "probes", NULL, style);
    for (uint32_t i = 0; i < p->probe_count; i++) {
        const JoxDrawnProbe *probe = &p->probes[i];
        const bool two = !probe->closed && probe->count == 4; /* a pair of lines, two points each */
        for (uint32_t at = 0; at < probe->count; at += two ? 2 : probe->count)
            jox_draw_plan_line(d, probe->points + at, two ? 2 : probe->count, probe->closed,
                               probe->name);
    }
    jox_canvas_close(d->canvas);
}

/* Returns whether a place or gate is a lift's: the lift's own name stands for both. */
static bool is_of_lift(const JoxPicture *p, const char *name) {
    for (uint32_t l = 0; l < p->lift_count; l++)
        for (uint32_t s = 0; s < p->lifts[l].stop_count; s++)
            if (p->lifts[l].stops[s].name && strcmp(p->lifts[l].stops[s].name, name) == 0)
                return true;
    return false;
}

/* Returns where a lift's name goes on a storey, m: beside the shaft, opposite to its door. */
static JoxV2 find_lift_name_spot(const JoxDrawing *d, const JoxLift *lift,
                                 const JoxLiftStop *stop) {
    const JoxV2 size = jox_sub(lift->high, lift->low);
    const JoxV2 middle = jox_scale(jox_add(lift->low, lift->high), 0.5f);
    const float text = 12 * d->unit, half = 0.5f * jox_draw_text_width(lift->name, text, false);
    const float away = (fabsf(stop->out.x) * half + fabsf(stop->out.y) * 0.6f * text) / d->scale +
                       0.5f * (fabsf(stop->out.x) * size.x + fabsf(stop->out.y) * size.y);
    return jox_on_sheet(d->picture->storeys, stop->storey,
                        jox_sub(middle, jox_scale(stop->out, away)));
}

/* Writes the name of each lift on the storeys that it serves. */
static void write_lift_names(JoxDrawing *d, JoxInk ink) {
    const JoxPicture *p = d->picture;
    for (uint32_t l = 0; p->storeys && l < p->lift_count; l++)
        for (uint32_t s = 0; s < p->lifts[l].stop_count; s++)
            write_map_name(d, find_lift_name_spot(d, &p->lifts[l], &p->lifts[l].stops[s]),
                           p->lifts[l].name, false, ink);
}

void jox_draw_names(JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    JoxStyle style = {
        .fill = jox_ink_gate, .line = jox_ink_with(WHITE, 0.9f), .width = 3 * d->unit};
    jox_canvas_open(d->canvas, "names", NULL, style);
    jox_canvas_open(d->canvas, NULL, "gates", style);
    bool closed;
    for (uint32_t r = 0; p->walls && r < p->walls->ring_count; r++)
        if (p->walls->rings[r].name && !is_of_lift(p, p->walls->rings[r].name) &&
            jox_draw_ring_points(p->walls, r, &closed))
            write_map_name(d, find_gate_name_spot(d, &p->walls->rings[r]), p->walls->rings[r].name,
                           false, jox_ink_gate);
    jox_canvas_close(d->canvas);
    /* exits first: if names compete for a spot, the exit's wins */
    for (int exits = 1; exits >= 0; exits--) {
        style.fill = exits ? jox_ink_exit : (JoxInk){0x24, 0x45, 0x69, 1};
        jox_canvas_open(d->canvas, NULL, exits ? "exits" : "places", style);
        for (uint32_t i = 0; i < p->place_count; i++) {
            const JoxPlace *place = &p->places[i];
            if (place->count && place->name && !is_of_lift(p, place->name) &&
                jox_draw_is_exit(p, place->name) == exits)
                write_map_name(d, find_place_name_spot(d, place), place->name, exits, style.fill);
        }
        jox_canvas_close(d->canvas);
    }
    jox_canvas_open(d->canvas, NULL, "lifts", style); /* in the colour of places */
    write_lift_names(d, style.fill);
    jox_canvas_close(d->canvas);
    style.fill = jox_ink_probe;
    jox_canvas_open(d->canvas, NULL, "probes", style);
    for (uint32_t i = 0; i < p->probe_count; i++)
        if (p->probes[i].count)
            write_map_name(d, find_probe_name_spot(d, &p->probes[i]), p->probes[i].name, false,
                           jox_ink_probe);
    jox_canvas_close(d->canvas);
    jox_canvas_close(d->canvas);
}
