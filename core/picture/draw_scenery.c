/* The floor's material and the scenery of a picture, from above, beneath people: in the colours of
   the live page, paler, so that people stay what is seen first. */
#include <math.h>

#include "picture/draw_parts.h"

/* Colours of floors as the live page's shaders have them (draw/ground_shaders.js), in the order of
   JOX_FLOORS. */
static const JoxInk FLOORS[] = {{0xf8, 0xf8, 0xf6, 1}, {0xe2, 0xdf, 0xd9, 1}, {0x99, 0x9c, 0xa1, 1},
                                {0xc9, 0xc8, 0xc4, 1}, {0x86, 0x9f, 0x61, 1}, {0xcc, 0xad, 0x85, 1},
                                {0xa8, 0xbd, 0xb8, 1}, {0xe0, 0xcf, 0xab, 1}, {0xc7, 0xc1, 0xb6, 1},
                                {0xad, 0xb5, 0xbd, 1}};

#define X(floor, name) +1
_Static_assert(sizeof FLOORS / sizeof *FLOORS == 0 JOX_FLOORS(X), "each floor has a colour");
#undef X

/* How a kind is drawn. */
typedef enum Outline {
    BOX,  /* its footprint */
    DISC, /* as wide as its size along x */
    HOOP, /* a circle without a fill */
    BAND, /* a line through points */
    PATCH /* a polygon through points */
} Outline;

static const struct Sketch {
    Outline outline;
    uint32_t colour; /* rrggbb, unless the item has one */
} SKETCHES[JOX_SCENERY_KIND_COUNT] = {
    [JOX_SCENERY_KIND_LINE] = {BAND, 0xf7f6f1},    [JOX_SCENERY_KIND_RING] = {HOOP, 0xf7f6f1},
    [JOX_SCENERY_KIND_AREA] = {PATCH, 0xb9c4a8},   [JOX_SCENERY_KIND_BLOCK] = {BOX, 0xb9b3a6},
    [JOX_SCENERY_KIND_PARAPET] = {BAND, 0xddd8cd}, [JOX_SCENERY_KIND_FENCE] = {BAND, 0x6d747c},
    [JOX_SCENERY_KIND_HEDGE] = {BAND, 0x4f8048},   [JOX_SCENERY_KIND_PILLAR] = {DISC, 0xcfc8ba},
    [JOX_SCENERY_KIND_ARCADE] = {BOX, 0xe6dcc6},   [JOX_SCENERY_KIND_MINARET] = {BOX, 0xe6dcc6},
    [JOX_SCENERY_KIND_HOUSE] = {BOX, 0xb5694c},    [JOX_SCENERY_KIND_TREE] = {DISC, 0x6f9d4f},
    [JOX_SCENERY_KIND_BUSH] = {DISC, 0x5f8f4a},    [JOX_SCENERY_KIND_LAMP] = {DISC, 0x2e333a},
    [JOX_SCENERY_KIND_BENCH] = {BOX, 0xa9825a},    [JOX_SCENERY_KIND_SEATS] = {BOX, 0x4a7db5},
    [JOX_SCENERY_KIND_STALL] = {BOX, 0xc1443c},    [JOX_SCENERY_KIND_STAGE] = {BOX, 0x4a3f38},
    [JOX_SCENERY_KIND_GOAL] = {BOX, 0xf2f1ec},     [JOX_SCENERY_KIND_POSTS] = {BOX, 0xf2f1ec},
    [JOX_SCENERY_KIND_SIGN] = {BOX, 0x00855a},     [JOX_SCENERY_KIND_TURNSTILE] = {BOX, 0x3b4650},
    [JOX_SCENERY_KIND_KIOSK] = {BOX, 0x3f6f8f},    [JOX_SCENERY_KIND_TRAIN] = {BOX, 0xc2c7cc},
    [JOX_SCENERY_KIND_KAABA] = {BOX, 0x1a1816},    [JOX_SCENERY_KIND_MAQAM] = {DISC, 0xc9a24a},
};

/* Shares of its own colour that a fill, also of what nobody walks on, an outline and the ground
   have; the rest is the bare floor's. */
static const float FILL = 0.45f, SOLID = 0.6f, LINE = 0.75f, GROUND = 0.4f;
static const JoxInk BARE = {0xf8, 0xf8, 0xf6, 1};

/* Returns a colour made paler: a share of it over the bare floor. */
static JoxInk make_paler(JoxInk ink, float share) {
    const float bare = 1.0f - share;
    return (JoxInk){(uint8_t)(share * ink.r + bare * BARE.r + 0.5f),
                    (uint8_t)(share * ink.g + bare * BARE.g + 0.5f),
                    (uint8_t)(share * ink.b + bare * BARE.b + 0.5f), 1.0f};
}

JoxInk jox_draw_ground_ink(const JoxPicture *p) {
    /* a field's colours are read on a bare floor */
    return p->grid || p->ground >= sizeof FLOORS / sizeof *FLOORS
               ? BARE
               : make_paler(FLOORS[p->ground], GROUND);
}

static JoxInk choose_scenery_ink(const JoxScenery *scenery) {
    const uint32_t rgb =
        scenery->colour ? scenery->colour & 0xffffff : SKETCHES[scenery->kind].colour;
    return (JoxInk){(uint8_t)(rgb >> 16), (uint8_t)(rgb >> 8), (uint8_t)rgb, 1.0f};
}

/* Draws one copy of an item that stands at a point. */
static void draw_copy(const JoxDrawing *d, const JoxScenery *scenery, uint32_t copy,
                      Outline outline) {
    JoxV2 corners[4];
    if (outline == BOX) {
        jox_scenery_footprint(scenery, copy, corners);
        jox_draw_plan_line(d, corners, 4, true, NULL);
        return;
    }
    const JoxV2 at = jox_draw_to_pixels(d, scenery->at[copy]);
    jox_canvas_disc(d->canvas, at, jox_maxf(0.5f * (float)scenery->size[0] * d->scale, d->unit),
                    NULL);
}

/* Returns whether nobody walks on what is drawn: people pass under the crown of a tree. */
static bool is_solid(const JoxScenery *scenery) {
    return jox_scenery_kinds[scenery->kind].form == JOX_SCENERY_SOLID &&
           scenery->kind != JOX_SCENERY_KIND_TREE;
}

/* Returns how an item is painted: over a field, outlines alone. */
static JoxStyle choose_scenery_style(const JoxDrawing *d, const JoxScenery *scenery) {
    const Outline outline = SKETCHES[scenery->kind].outline;
    const JoxInk ink = choose_scenery_ink(scenery);
    JoxStyle style = {.line = make_paler(ink, LINE), .width = 0.8f * d->unit};
    if (outline == BAND)
        style.width = jox_maxf((float)scenery->size[1] * d->scale, d->unit);
    if (outline == HOOP)
        style.width = jox_maxf(0.08f * d->scale, d->unit);
    if (outline != BAND && outline != HOOP && !d->picture->grid)
        style.fill = make_paler(ink, is_solid(scenery) ? SOLID : FILL);
    return style;
}

static void draw_scenery_item(const JoxDrawing *d, const JoxScenery *scenery) {
    const Outline outline = SKETCHES[scenery->kind].outline;
    jox_canvas_open(d->canvas, NULL, jox_scenery_kinds[scenery->kind].name,
                    choose_scenery_style(d, scenery));
    if (scenery->through_count)
        jox_draw_plan_line(d, scenery->through, scenery->through_count, outline == PATCH, NULL);
    for (uint32_t k = 0; k < scenery->at_count; k++)
        draw_copy(d, scenery, k, outline);
    jox_canvas_close(d->canvas);
}

/* Returns whether an item lies flat on the floor: what stands is drawn over it. */
static bool lies_flat(const JoxScenery *scenery) {
    return scenery->kind == JOX_SCENERY_KIND_LINE || scenery->kind == JOX_SCENERY_KIND_RING ||
           scenery->kind == JOX_SCENERY_KIND_AREA;
}

bool jox_draw_fills_wall(const JoxPicture *p, const struct JoxWallRing *ring) {
    JoxV2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (uint32_t v = ring->first; v < ring->first + ring->count; v++) {
        const JoxV2 at = p->walls->vertices[v].point;
        low = jox_v2(jox_minf(low.x, at.x), jox_minf(low.y, at.y));
        high = jox_v2(jox_maxf(high.x, at.x), jox_maxf(high.y, at.y));
    }
    for (uint32_t i = 0; i < p->scenery_count; i++) {
        const JoxScenery *s = &p->scenery[i];
        const double covered = s->size[0] * s->size[1];
        if (jox_scenery_kinds[s->kind].form != JOX_SCENERY_SOLID || s->body ||
            2.0 * covered < (double)((high.x - low.x) * (high.y - low.y)))
            continue;
        for (uint32_t k = 0; k < s->at_count; k++)
            if (s->at[k].x > low.x && s->at[k].x < high.x && s->at[k].y > low.y &&
                s->at[k].y < high.y)
                return true;
    }
    return false;
}

void jox_draw_scenery(const JoxDrawing *d) {
    const JoxPicture *p = d->picture;
    if (p->scenery_count == 0)
        return;
    jox_canvas_open(d->canvas, "scenery", NULL, (JoxStyle){0});
    for (int standing = 0; standing < 2; standing++)
        for (uint32_t i = 0; i < p->scenery_count; i++) /* a body that carries it is drawn itself */
            if (!p->scenery[i].body && lies_flat(&p->scenery[i]) == !standing)
                draw_scenery_item(d, &p->scenery[i]);
    jox_canvas_close(d->canvas);
}
