/* The layers of people and of the field on the floor, and the colours of classes and values. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "base/number/pi.h"
#include "picture/draw_parts.h"

/* px at the usual size: least radius of a disc as drawn, least radius with a heading, least
   radius with an outline */
static const float LEAST = 1.2f, HEADED = 3.5f, EDGED = 2.5f;

bool jox_draw_is_class(JoxShow show) {
    return show == JOX_SHOW_STATE || show == JOX_SHOW_GROUP;
}

JoxInk jox_draw_value_ink(const JoxPicture *p, uint32_t n) {
    const float share = ((float)n + 0.5f) / JOX_DRAW_BINS;
    return p->colour == JOX_SHOW_SPEED       ? jox_palette_calm(share)
           : p->colour == JOX_SHOW_DIRECTION ? jox_palette_way((float)n / JOX_DRAW_BINS)
                                             : jox_palette_value(share);
}

JoxInk jox_draw_floor_ink(const JoxPicture *p, uint32_t n) {
    float share = ((float)n + 0.5f) / JOX_DRAW_BINS;
    uint8_t grey = (uint8_t)(235.0f - 195.0f * share);
    if (p->change)
        return share < 0.5f ? jox_palette_calm(1.0f - 2.0f * share)
                            : jox_palette_value(2.0f * share - 1.0f);
    return p->colour == JOX_SHOW_NOTHING || jox_draw_is_class(p->colour)
               ? jox_palette_value(share)
               : (JoxInk){grey, grey, grey, 1.0f};
}

JoxInk jox_draw_class_ink(const JoxDrawing *d, uint32_t n, const char **name) {
    const JoxPicture *p = d->picture;
    const JoxFrame *frame = p->frame;
    if (p->colour == JOX_SHOW_GROUP && n >= frame->group_count)
        *name = ""; /* the recording does not name this group */
    else
        *name = p->colour == JOX_SHOW_STATE ? frame->states[n] : frame->groups[n];
    if (!**name)
        *name = "none";
    return d->inks[n];
}

/* Returns a person's direction, in turns counter-clockwise from half a bin before the east, so
   that the east is in the middle of the first bin. People who stand have the direction of
   looking. */
static float direction_in_turns(const JoxPicture *p, uint32_t i) {
    const JoxFrame *frame = p->frame;
    const bool walks = frame->vx[i] != 0.0f || frame->vy[i] != 0.0f;
    const float x = walks || !p->face_x ? frame->vx[i] : p->face_x[i];
    const float y = walks || !p->face_y ? frame->vy[i] : p->face_y[i];
    const float turn = atan2f(y, x) / (float)JOX_TURN + 0.5f / JOX_DRAW_BINS;
    return turn - floorf(turn);
}

/* Returns where a person's value lies on the colour bar, 0 to 1. */
static float find_bar_share(const JoxPicture *p, uint32_t i) {
    const JoxFrame *frame = p->frame;
    float value = 0.0f;
    switch (p->colour) {
    case JOX_SHOW_DIRECTION:
        return direction_in_turns(p, i);
    case JOX_SHOW_SPEED:
        value = jox_length(jox_v2(frame->vx[i], frame->vy[i]));
        break;
    case JOX_SHOW_FORCE:
        value = frame->force[i];
        break;
    case JOX_SHOW_COMPRESSION:
        value = frame->compression[i];
        break;
    case JOX_SHOW_LOAD:
        value = frame->load[i];
        break;
    case JOX_SHOW_DENSITY:
        value = p->density[i];
        break;
    default:
        break;
    }
    return jox_clampf(value / p->colour_most, 0.0f, 1.0f);
}

static uint32_t find_colour_class(const JoxPicture *p, uint32_t i) {
    if (p->colour == JOX_SHOW_NOTHING)
        return 0;
    if (p->colour == JOX_SHOW_STATE)
        return p->frame->state[i];
    if (p->colour == JOX_SHOW_GROUP)
        return p->frame->group[i] < p->frame->group_count ? p->frame->group[i]
                                                          : p->frame->group_count;
    uint32_t bin = (uint32_t)(find_bar_share(p, i) * JOX_DRAW_BINS);
    return bin < JOX_DRAW_BINS ? bin : JOX_DRAW_BINS - 1;
}

static uint32_t count_colour_classes(const JoxPicture *p) {
    return p->colour == JOX_SHOW_NOTHING ? 1
           : p->colour == JOX_SHOW_STATE ? p->frame->state_count
           : p->colour == JOX_SHOW_GROUP ? p->frame->group_count + 1
                                         : JOX_DRAW_BINS;
}

/* People without a state or named group are grey. Their class is the first of the states, but
   the last of the groups. */
void jox_draw_choose_classes(JoxDrawing *d) {
    static const JoxInk NONE = {0x77, 0x77, 0x77, 1.0f};
    const JoxPicture *p = d->picture;
    const JoxFrame *frame = p->frame;
    d->classes = count_colour_classes(p);
    if (!jox_draw_is_class(p->colour))
        return;
    d->inks = jox_alloc(d->classes + 1, sizeof *d->inks);
    if (p->colour == JOX_SHOW_GROUP) {
        jox_palette_classes(frame->group_colours, frame->group_count, d->inks);
        d->inks[frame->group_count] = NONE;
        return;
    }
    for (uint32_t s = 0; s < frame->state_count; s++)
        d->inks[s] = NONE;
    if (frame->state_count > 1)
        jox_palette_classes(frame->state_colours ? frame->state_colours + 1 : NULL,
                            frame->state_count - 1, d->inks + 1);
}

/* Returns the radius of a person's disc as drawn, px. */
static float find_disc_radius(const JoxDrawing *d, uint32_t i) {
    const JoxPicture *p = d->picture;
    float radius = jox_frame_radius(p->frame, i, p->radius);
    return jox_maxf(radius * d->scale, LEAST * d->unit);
}

/* Returns the indices of people in the order of their classes, for the caller to free, and fills
   in d->people. */
static uint32_t *sort_people_by_class(JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    uint32_t count = p->frame->count;
    d->people = jox_alloc(d->classes + 1, sizeof *d->people);
    uint32_t *order = jox_alloc(count + 1, sizeof *order);
    uint32_t *next = jox_alloc(d->classes + 1, sizeof *next);
    for (uint32_t i = 0; i < count; i++)
        d->people[find_colour_class(p, i)]++;
    for (uint32_t k = 1; k < d->classes; k++)
        next[k] = next[k - 1] + d->people[k - 1];
    for (uint32_t i = 0; i < count; i++)
        order[next[find_colour_class(p, i)]++] = i;
    jox_free(next);
    return order;
}

/* Returns the style of class k for discs of a radius (px), and its SVG class name in `kind`. */
static JoxStyle choose_class_style(const JoxDrawing *d, uint32_t k, float radius, char kind[96]) {
    const JoxPicture *p = d->picture;
    const char *name;
    JoxStyle style = {.width = 0.7f * d->unit};
    if (radius >= EDGED * d->unit)
        style.line = (JoxInk){0x20, 0x20, 0x20, 0.55f};
    if (p->colour == JOX_SHOW_NOTHING) {
        /* small discs are many: thin rings leave the floor visible */
        bool small = radius < HEADED * d->unit;
        style.line = (JoxInk){0x10, 0x10, 0x10, small ? 0.5f : 0.85f};
        style.width = small ? 0.4f * d->unit : 0.8f * d->unit;
        snprintf(kind, 96, "person");
    } else if (jox_draw_is_class(p->colour)) {
        style.fill = jox_draw_class_ink(d, k, &name);
        snprintf(kind, 96, "%s-%.80s", jox_shown[p->colour].name, name);
        /* SVG reads a space as the start of another class */
        for (char *c = kind; (c = strchr(c, ' ')) != NULL;)
            *c = '-';
    } else {
        style.fill = jox_draw_value_ink(p, k);
        snprintf(kind, 96, "%s-%u", jox_shown[p->colour].name, k);
    }
    return style;
}

/* Returns whether any part of a disc (px) is on the map. */
static bool is_disc_on_map(const JoxDrawing *d, JoxV2 at, float radius) {
    return at.x + radius > d->low.x && at.x - radius < d->high.x && at.y + radius > d->low.y &&
           at.y - radius < d->high.y;
}

static bool has_torso(const JoxDrawing *d, uint32_t i) {
    const JoxFrame *f = d->picture->frame;
    return f->axis_x && (f->axis_x[i] != 0.0f || f->axis_y[i] != 0.0f) &&
           find_disc_radius(d, i) >= EDGED * d->unit;
}

/* Draws a torso: two half circles about the ends of its axis, and the lines between. */
static void draw_torso(JoxDrawing *d, uint32_t i, JoxV2 at, const char *id) {
    enum { HALF = 9 };
    const JoxFrame *f = d->picture->frame;
    const JoxV2 axis = {f->axis_x[i] * d->scale, -f->axis_y[i] * d->scale}, along = jox_unit(axis);
    const float radius = f->contact_radius[i] * d->scale;
    JoxV2 points[2 * HALF];
    for (int k = 0; k < 2 * HALF; k++) {
        const float end = k < HALF ? 1.0f : -1.0f;
        const float angle = (float)JOX_PI * ((float)(k % HALF) / (HALF - 1) - 0.5f);
        const float c = cosf(angle) * end * radius, s = sinf(angle) * end * radius;
        const JoxV2 out = {along.x * c - along.y * s, along.y * c + along.x * s};
        points[k] = jox_add(at, jox_add(jox_scale(axis, end), out));
    }
    jox_canvas_line(d->canvas, points, 2 * HALF, true, id);
}

/* Draws each person's heading: a mark from the centre to the rim in the direction of looking. */
static void draw_headings(JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    const JoxFrame *frame = p->frame;
    JoxV2 *ends = jox_alloc(2 * (size_t)frame->count + 1, sizeof *ends);
    uint32_t count = 0;
    float widest = 0.0f;
    for (uint32_t i = 0; i < frame->count; i++) {
        const float radius =
            has_torso(d, i) ? frame->contact_radius[i] * d->scale : find_disc_radius(d, i);
        JoxV2 along = p->face_x ? jox_v2(p->face_x[i], p->face_y[i])
                                : jox_unit(jox_v2(frame->vx[i], frame->vy[i]));
        JoxV2 at = jox_draw_to_pixels(d, jox_v2(frame->x[i], frame->y[i]));
        if (radius < HEADED * d->unit || !(jox_length2(along) > 0.0f) ||
            !is_disc_on_map(d, at, radius))
            continue;
        ends[count++] = at;
        ends[count++] = jox_add(at, jox_v2(along.x * radius, -along.y * radius));
        widest = jox_maxf(widest, radius);
    }
    d->headings = count > 0;
    JoxStyle style = {.line = {0x10, 0x10, 0x10, 0.85f},
                      .width = jox_clampf(0.22f * widest, 0.8f * d->unit, 3 * d->unit)};
    jox_canvas_open(d->canvas, "headings", NULL, style);
    jox_canvas_segments(d->canvas, ends, count);
    jox_canvas_close(d->canvas);
    jox_free(ends);
}

/* Crosses out the people who have fallen. */
static void draw_fallen(JoxDrawing *d) {
    const JoxFrame *frame = d->picture->frame;
    JoxV2 *ends = jox_alloc(4 * (size_t)frame->count + 1, sizeof *ends);
    uint32_t count = 0;
    for (uint32_t i = 0; frame->fallen && i < frame->count; i++) {
        const float radius = jox_maxf(find_disc_radius(d, i), HEADED * d->unit);
        const JoxV2 at = jox_draw_to_pixels(d, jox_v2(frame->x[i], frame->y[i]));
        if (!(frame->fallen[i] > 0.0f) || !is_disc_on_map(d, at, radius))
            continue;
        for (int k = 0; k < 4; k++) {
            const float x = k % 2 ? radius : -radius, y = k < 2 ? x : -x;
            ends[count++] = jox_add(at, jox_v2(x, y));
        }
    }
    d->fallen = count > 0;
    if (count) {
        const JoxStyle style = {.line = {0x10, 0x10, 0x10, 1.0f}, .width = 1.4f * d->unit};
        jox_canvas_open(d->canvas, "fallen", NULL, style);
        jox_canvas_segments(d->canvas, ends, count);
        jox_canvas_close(d->canvas);
    }
    jox_free(ends);
}

void jox_draw_people(JoxDrawing *d) {
    const JoxFrame *frame = d->picture->frame;
    uint32_t *order = sort_people_by_class(d), at = 0;
    jox_canvas_open(d->canvas, "people", NULL, (JoxStyle){0});
    for (uint32_t k = 0; k < d->classes; k++) {
        char kind[96];
        if (d->people[k] == 0)
            continue;
        jox_canvas_open(d->canvas, NULL, kind,
                        choose_class_style(d, k, find_disc_radius(d, order[at]), kind));
        for (uint32_t n = 0; n < d->people[k]; n++) {
            uint32_t i = order[at++];
            char id[16];
            JoxV2 here = jox_draw_to_pixels(d, jox_v2(frame->x[i], frame->y[i]));
            snprintf(id, sizeof id, "p%u", frame->key[i]);
            if (!is_disc_on_map(d, here, find_disc_radius(d, i)))
                d->outside = true;
            else if (has_torso(d, i))
                draw_torso(d, i, here, id);
            else
                jox_canvas_disc(d->canvas, here, find_disc_radius(d, i), id);
        }
        jox_canvas_close(d->canvas);
    }
    jox_canvas_close(d->canvas);
    draw_headings(d);
    draw_fallen(d);
    jox_free(order);
}

/* Returns 1 + the bin of a value of the field; 0 where there is nothing to draw: not measured
   (NAN), or about 0. */
static uint8_t find_field_level(const JoxPicture *p, float value) {
    const float share = value / p->floor_most;
    const float part = p->change ? 0.5f * (jox_clampf(share, -1.0f, 1.0f) + 1.0f) * JOX_DRAW_BINS
                                 : jox_minf(share, 1.0f) * JOX_DRAW_BINS;
    if (isnan(share) || !(p->change ? fabsf(share) * JOX_DRAW_BINS >= 1.0f : part >= 0.5f))
        return 0;
    return (uint8_t)(1 + (uint32_t)jox_minf(part, JOX_DRAW_BINS - 1));
}

void jox_draw_field(JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    const JoxDensity *grid = p->grid;
    if (!grid)
        return;
    uint8_t *levels = jox_alloc((size_t)grid->columns * grid->rows, 1);
    JoxInk ink[JOX_DRAW_BINS + 1] = {{0, 0, 0, 0}};
    for (int k = 0; k < JOX_DRAW_BINS; k++)
        ink[k + 1] = jox_draw_floor_ink(p, (uint32_t)k);
    for (uint32_t r = 0; r < grid->rows; r++) /* from the top; in panels, from the lowest row */
        for (uint32_t c = 0; c < grid->columns; c++) {
            const uint32_t row = d->panels.storeys ? r : grid->rows - 1 - r;
            float value = p->field[(size_t)row * grid->columns + c];
            levels[(size_t)r * grid->columns + c] = find_field_level(p, value);
        }
    JoxV2 top = {grid->low.x, grid->low.y + (float)grid->rows * grid->cell};
    jox_canvas_open(d->canvas, "field", jox_shown[p->floor].name, (JoxStyle){0});
    if (d->panels.storeys) {
        jox_draw_panel_fields(d, levels, ink);
    } else {
        JoxCells cells = {jox_draw_to_pixels(d, top),
                          grid->cell * d->scale,
                          grid->columns,
                          grid->rows,
                          levels,
                          ink,
                          JOX_DRAW_BINS + 1};
        jox_canvas_cells(d->canvas, &cells);
    }
    jox_canvas_close(d->canvas);
    jox_free(levels);
}
