/* Shafts of lifts, crossed by diagonals on each storey that they pass but that of the car, and cars
   as rectangles. A car between two storeys is drawn dashed, on the storey where its riders are. */
#include <math.h>
#include <stdio.h>

#include "base/format/plurals.h"
#include "picture/draw_parts.h"

static const float AT_STOREY = 0.01f; /* m: a car nearer to a storey stands there */

/* Draws a ring of points of the plan on a storey, scaled about its middle. */
static void draw_plan_ring(const JoxDrawing *d, const JoxLift *lift, uint32_t storey, float scale,
                           const char *name) {
    const JoxV2 middle = jox_scale(jox_add(lift->low, lift->high), 0.5f);
    JoxV2 ring[JOX_OUTLINE_POINTS];
    uint32_t count = 0;
    for (; count < lift->point_count && count < JOX_OUTLINE_POINTS; count++)
        ring[count] = jox_draw_plan_pixels(
            d, storey, jox_add(middle, jox_scale(jox_sub(lift->outline[count], middle), scale)));
    jox_canvas_line(d->canvas, ring, count, true, name);
}

/* Draws a line between two opposite corners of a shaft's outline. */
static void draw_diagonal(const JoxDrawing *d, const JoxLift *lift, uint32_t storey,
                          uint32_t corner) {
    const uint32_t n = lift->point_count;
    const JoxV2 ends[2] = {jox_draw_plan_pixels(d, storey, lift->outline[corner]),
                           jox_draw_plan_pixels(d, storey, lift->outline[(corner + n / 2) % n])};
    jox_canvas_line(d->canvas, ends, 2, false, lift->name);
}

static void draw_shaft(const JoxDrawing *d, const JoxLift *lift, uint32_t storey) {
    const JoxStyle style = {.line = jox_ink_with(jox_ink_faint, 0.6f), .width = 0.8f * d->unit};
    jox_canvas_open(d->canvas, NULL, "shaft", style);
    draw_diagonal(d, lift, storey, 0);
    draw_diagonal(d, lift, storey, 1);
    jox_canvas_close(d->canvas);
}

static void draw_car(const JoxDrawing *d, const JoxLift *lift, const JoxCarLook *car) {
    static const char *const MODES[JOX_LIFT_MODES] = {"in use", "out of use", "left to firemen"};
    const JoxLiftStop *stop = &lift->stops[car->stop];
    const bool moves = fabsf(car->height - stop->height) > AT_STOREY;
    const JoxInk ink = car->mode == JOX_LIFT_IN_USE ? jox_ink_place : jox_ink_gate;
    const JoxStyle style = {.fill = jox_ink_with(ink, 0.18f),
                            .line = jox_ink_with(ink, 0.9f),
                            .width = 1.2f * d->unit,
                            .dash = moves ? 3 * d->unit : 0};
    char people[JOX_NOUN], name[320];
    snprintf(name, sizeof name, "%.200s, %s: at %.1f m, %s", lift->name, MODES[car->mode],
             (double)car->height, jox_noun(people, car->people, "person|people"));
    jox_canvas_open(d->canvas, NULL, "car", style);
    draw_plan_ring(d, lift, stop->storey, 0.88f, name);
    jox_canvas_close(d->canvas);
}

void jox_draw_lifts(JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    if (!p->lift_count || !d->panels.storeys)
        return;
    jox_canvas_open(d->canvas, "lifts", NULL, (JoxStyle){0});
    for (uint32_t l = 0; l < p->lift_count; l++) {
        const JoxLift *lift = &p->lifts[l];
        const uint32_t last = lift->stops[lift->stop_count - 1].storey;
        const JoxCarLook *car = p->cars ? &p->cars[l] : NULL;
        for (uint32_t storey = lift->stops[0].storey; storey <= last; storey++)
            if (!car || lift->stops[car->stop].storey != storey)
                draw_shaft(d, lift, storey);
        if (car)
            draw_car(d, lift, car);
    }
    jox_canvas_close(d->canvas);
}
