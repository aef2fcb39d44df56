#include "geom/field/field_sheets.h"

#include <math.h>
#include <stdlib.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "geom/polygon.h"
#include "geom/wall_images.h"

static const float GAP = 2.0f;    /* m between sheets */
static const float REPEAT = 2.0f; /* m beyond a seam that repeats the other side */
static const float MARGIN = 1.0f; /* m round the plan of a storey */
static const float HAIR = 1e-3f;  /* m: more than the rounding of positions on sheets */

/* ---- the layout ---- */

/* Finds the extent in plan, along y, of what is on a sheet, m. */
static void find_extent(const JoxStoreys *s, uint32_t sheet, float *low, float *high) {
    const JoxSheet *on = &s->sheets[sheet];
    *low = s->low - MARGIN;
    *high = s->high + MARGIN;
    if (sheet < s->storey_count)
        return;
    *low = INFINITY;
    *high = -INFINITY;
    for (uint32_t k = on->first_stair; k < on->first_stair + on->stair_count; k++) {
        const JoxStair *st = &s->stairs[s->sheet_stairs[k]];
        *low = jox_minf(*low, st->low.y - JOX_FIELD_SEAM_REACH);
        *high = jox_maxf(*high, st->high.y + JOX_FIELD_SEAM_REACH);
    }
}

void jox_field_lay_sheets(JoxField *f, const JoxStoreys *s) {
    const int gap = (int)ceilf(GAP / f->size);
    int row = 0;
    f->storeys = s;
    f->sheets = jox_realloc(f->sheets, s->sheet_count, sizeof *f->sheets);
    for (uint32_t k = 0; k < s->sheet_count; k++) {
        JoxFieldSheet *sheet = &f->sheets[k];
        float low, high;
        find_extent(s, k, &low, &high);
        const float first = floorf(low / f->size), last = ceilf(high / f->size);
        sheet->low = first * f->size;
        sheet->high = last * f->size;
        sheet->first_row = row;
        sheet->rows = (int)(last - first);
        sheet->to_row = row - (int)first;
        sheet->shift = (float)sheet->to_row * f->size;
        row += sheet->rows + gap;
    }
    f->low.y = 0.0f;
    f->rows = row - gap;
}

float jox_field_height_of_sheets(const JoxStoreys *s, float cell) {
    float sum = -GAP;
    for (uint32_t k = 0; k < s->sheet_count; k++) {
        float low, high;
        find_extent(s, k, &low, &high);
        sum += high - low + GAP + 3.0f * cell;
    }
    return sum;
}

void jox_field_keep_to_sheet(const JoxField *f, float y, int *first, int *last) {
    const int row = (int)floorf((y - f->low.y) / f->size);
    for (uint32_t k = 0; f->sheets && k < f->storeys->sheet_count; k++) {
        const JoxFieldSheet *sheet = &f->sheets[k];
        const int end = sheet->first_row + sheet->rows;
        if (row < sheet->first_row || row > end)
            continue;
        *first = *first > sheet->first_row ? *first : sheet->first_row;
        *last = *last < end - 1 ? *last : end - 1;
        return;
    }
}

/* ---- what is moved into it ---- */

void jox_field_pack_walls(const JoxField *f, const JoxWalls *walls, JoxWalls *out) {
    jox_walls_standing(out, walls, true);
    jox_wall_images_add_seams(out, f->storeys, JOX_FIELD_SEAM_REACH);
    for (uint32_t v = 0; v < out->count; v++)
        out->vertices[v].point = jox_field_pack(f, out->vertices[v].point);
}

JoxPlace *jox_field_pack_goal(const JoxField *f, const JoxPlace *places, uint32_t place,
                              uint32_t *count) {
    JoxPlace *goal = jox_places_copy_goal(places, place, count);
    for (uint32_t k = 0; k < *count; k++) {
        for (uint32_t p = 0; p < goal[k].count; p++)
            goal[k].points[p] = jox_field_pack(f, goal[k].points[p]);
        if (goal[k].count)
            jox_place_finish(&goal[k]);
    }
    return goal;
}

void jox_field_pack_crowd(const JoxField *f, const JoxFieldCrowd *crowd, JoxFieldCrowd *out) {
    *out = *crowd;
    out->at = jox_alloc((size_t)crowd->count + 1, sizeof *out->at);
    for (uint32_t n = 0; n < crowd->count; n++)
        out->at[n] = jox_field_pack(f, crowd->at[n]);
}

/* ---- cells ---- */

/* A cell's node relative to a seam, in plan: m along it, and beyond it. */
typedef struct AtSeam {
    float along, beyond;
} AtSeam;

static AtSeam place_at_seam(const JoxSeam *seam, JoxV2 plan) {
    const JoxV2 from = jox_sub(plan, seam->a);
    return (AtSeam){jox_dot(seam->along, from), jox_det(seam->along, from)};
}

/* Returns whether a point beyond a seam repeats floor of the other side. What lies on the seam's
   line belongs to the storey. */
static bool repeats_floor(const JoxSeam *seam, JoxV2 plan) {
    const AtSeam at = place_at_seam(seam, plan);
    return at.beyond > (seam->enters ? HAIR : -HAIR) && at.beyond <= REPEAT && at.along >= 0.0f &&
           at.along <= seam->length;
}

static bool lies_on_line(const JoxSeam *seam, JoxV2 plan) {
    const AtSeam at = place_at_seam(seam, plan);
    return fabsf(at.beyond) <= HAIR && at.along >= 0.0f && at.along <= seam->length;
}

/* Returns whether a point of a sheet is floor, or repeats floor. */
static bool is_floor_or_repeats(const JoxStoreys *s, uint32_t sheet, JoxV2 plan) {
    const JoxSheet *on = &s->sheets[sheet];
    if (jox_is_floor_of(s, sheet, plan))
        return true;
    for (uint32_t k = on->first_seam; k < on->first_seam + on->seam_count; k++)
        if (repeats_floor(&s->seams[k], plan) ||
            (s->seams[k].enters && lies_on_line(&s->seams[k], plan)))
            return true;
    return false;
}

static JoxV2 unpack(const JoxFieldSheet *sheet, JoxV2 packed) {
    return (JoxV2){packed.x, packed.y - sheet->shift};
}

static JoxV2 find_node(const JoxFieldWork *w, int cell) {
    return jox_field_sample(w->f, cell, w->walled.node[cell]);
}

void jox_field_block_beyond_floor(JoxFieldWork *w) {
    const JoxField *f = w->f;
    const JoxStoreys *s = f->storeys;
    int cell = 0;
    for (uint32_t k = 0; k < s->sheet_count; k++) {
        const JoxFieldSheet *sheet = &f->sheets[k];
        for (; cell < sheet->first_row * f->columns; cell++)
            w->walled.node[cell] = JOX_FIELD_BLOCKED;
        for (; cell < (sheet->first_row + sheet->rows) * f->columns; cell++)
            if (w->walled.node[cell] != JOX_FIELD_BLOCKED &&
                !is_floor_or_repeats(s, k, unpack(sheet, find_node(w, cell))))
                w->walled.node[cell] = JOX_FIELD_BLOCKED;
    }
    JOX_ASSERT(cell == w->count);
}

/* Returns the time per metre on a stair's flights, in that on level floor: in its one direction,
   or the mean of both. */
static float get_slowness(const JoxStair *stair, const JoxFlight *flight) {
    if (stair->way == JOX_STAIR_BOTH_WAYS)
        return 0.5f * (flight->slowness[0] + flight->slowness[1]);
    return flight->slowness[stair->way == JOX_STAIR_DOWN];
}

void jox_field_slow_stairs(JoxFieldWork *w) {
    const JoxField *f = w->f;
    const JoxStoreys *s = f->storeys;
    for (uint32_t k = 0; k < s->sheet_count; k++) {
        const JoxFieldSheet *sheet = &f->sheets[k];
        for (int cell = sheet->first_row * f->columns;
             s->sheets[k].stair_count && cell < (sheet->first_row + sheet->rows) * f->columns;
             cell++) {
            if (w->walled.node[cell] == JOX_FIELD_BLOCKED)
                continue;
            const JoxV2 at = jox_on_sheet(s, k, unpack(sheet, find_node(w, cell)));
            const JoxFlight *flight = jox_flight_at(s, at);
            if (flight)
                w->slowness[cell] *= get_slowness(&s->stairs[flight->stair], flight);
        }
    }
}

/* ---- cells that repeat others ---- */

/* Returns whether people may set out over a seam. */
static bool may_be_crossed(const JoxStoreys *s, const JoxSeam *seam) {
    const JoxStair *st = &s->stairs[seam->stair];
    const bool up = seam->enters != seam->at_head;
    if (seam->enters && st->closed)
        return false;
    return st->way == JOX_STAIR_BOTH_WAYS || (st->way == JOX_STAIR_UP) == up;
}

static int compare_twins(const void *a, const void *b, const void *context) {
    const JoxFieldTwin *x = a, *y = b;
    (void)context;
    return x->of != y->of ? (x->of > y->of) - (x->of < y->of)
                          : (x->copy > y->copy) - (x->copy < y->copy);
}

/* Appends the cells on one side of a seam that repeat the other side. */
static void list_twins_of(const JoxFieldWork *w, const JoxSeam *seam, JoxFieldTwins *out,
                          size_t *capacity) {
    const JoxField *f = w->f;
    const JoxFieldSheet *here = &f->sheets[seam->here], *there = &f->sheets[seam->there];
    const JoxV2 wide = {REPEAT + f->size, REPEAT + f->size};
    JoxV2 low, high, ends[2] = {seam->a, seam->b};
    int c0, c1, r0, r1;
    jox_bounds(ends, 2, &low, &high);
    low = jox_sub(low, wide);
    high = jox_add(high, wide);
    jox_field_span(low.x, high.x, f->low.x, f->size, f->columns, &c0, &c1);
    jox_field_span(low.y + here->shift, high.y + here->shift, f->low.y, f->size, f->rows, &r0, &r1);
    for (int r = r0; r <= r1; r++)
        for (int c = c0; c <= c1; c++) {
            const int copy = r * f->columns + c, row = r - here->to_row + there->to_row;
            const int of = row * f->columns + c;
            if (row < there->first_row || row >= there->first_row + there->rows ||
                w->walled.node[copy] == JOX_FIELD_BLOCKED ||
                w->walled.node[of] == JOX_FIELD_BLOCKED ||
                !repeats_floor(seam, unpack(here, find_node(w, copy))))
                continue;
            JOX_RESERVE(out->items, *capacity, (size_t)out->count + 1);
            out->items[out->count++] = (JoxFieldTwin){of, copy};
        }
}

JoxFieldTwins jox_field_list_twins(const JoxFieldWork *w, bool crossed) {
    JoxFieldTwins twins = {NULL, 0};
    size_t capacity = 0;
    const JoxStoreys *s = w->f->storeys;
    for (uint32_t k = 0; s && k < s->seam_count; k++)
        if (!crossed || may_be_crossed(s, &s->seams[k]))
            list_twins_of(w, &s->seams[k], &twins, &capacity);
    if (twins.count)
        jox_sort(twins.items, twins.count, sizeof *twins.items, compare_twins, NULL, NULL);
    return twins;
}
