/* Lays storeys and stairs out on sheets, and finds the stair, flight or seam at a position. */
#include "geom/storeys.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/polygon.h"

static const float TURN = 0.85f;         /* cosine: sharper turns of a path are landings */
static const float LEAST_FLIGHT = 0.05f; /* m: shorter flights are flat */
static const float BETWEEN = 20.0f;      /* m: between the plans of two sheets at least */
static const float PITCH_UNIT = 9.0f;    /* m: whole cells of fields for most sizes of cells */
static const float MOST_WIDTH = 100.0f;  /* m: of a stair */
static const float FARTHEST = 1e5f;      /* m: of its points from the origin */

static JoxV2 point_at(const JoxStair *stair, uint32_t at, float aside) {
    const JoxV2 *path = stair->path;
    const uint32_t last = stair->path_count - 1;
    const JoxV2 in = jox_unit(jox_sub(path[at ? at : 1], path[at ? at - 1 : 0]));
    const JoxV2 out =
        jox_unit(jox_sub(path[at < last ? at + 1 : last], path[at < last ? at : last - 1]));
    const JoxV2 both = jox_add(jox_left(in), jox_left(out));
    /* A mitre: as far along the mean of both normals as puts it `aside` from both lines. */
    const float scale = 2.0f * aside / jox_maxf(jox_length2(both), 0.1f);
    return jox_add(path[at], jox_scale(both, scale));
}

float jox_stair_length(const JoxStair *stair) {
    float length = 0.0f;
    for (uint32_t k = 1; k < stair->path_count; k++)
        length += jox_length(jox_sub(stair->path[k], stair->path[k - 1]));
    return length;
}

/* ---- outlines and flights ---- */

/* Makes the outline: the right side from foot to head, then the left side back. */
static void make_outline(const JoxStair *stair, JoxV2 *outline) {
    const uint32_t n = stair->path_count;
    const float half = 0.5f * stair->width;
    for (uint32_t k = 0; k < n; k++) {
        outline[k] = point_at(stair, k, -half);
        outline[2 * n - 1 - k] = point_at(stair, k, half);
    }
}

bool jox_stair_is_sound(const JoxStair *stair) {
    bool sound = stair->path_count >= 2 && stair->width > 0.0f && stair->width <= MOST_WIDTH;
    for (uint32_t k = 1; sound && k < stair->path_count; k++)
        sound = jox_length(jox_sub(stair->path[k], stair->path[k - 1])) >= LEAST_FLIGHT;
    for (uint32_t k = 0; sound && k < stair->path_count; k++) /* false of NAN, too */
        sound = fabsf(stair->path[k].x) <= FARTHEST && fabsf(stair->path[k].y) <= FARTHEST;
    if (!sound)
        return false;
    JoxV2 *outline = jox_alloc(2 * (size_t)stair->path_count, sizeof *outline);
    make_outline(stair, outline);
    sound = jox_polygon_area(outline, 2 * stair->path_count) > 0.0;
    jox_free(outline);
    return sound;
}

static void lay_outline(JoxStair *stair) {
    const uint32_t n = stair->path_count;
    stair->outline = jox_realloc(stair->outline, 2 * (size_t)n, sizeof *stair->outline);
    make_outline(stair, stair->outline);
    jox_bounds(stair->outline, 2 * n, &stair->low, &stair->high);
}

/* Returns whether a path turns sharply at one of its points. */
static bool turns_at(const JoxStair *stair, uint32_t at) {
    if (at == 0 || at == stair->path_count - 1)
        return false;
    const JoxV2 in = jox_unit(jox_sub(stair->path[at], stair->path[at - 1]));
    const JoxV2 out = jox_unit(jox_sub(stair->path[at + 1], stair->path[at]));
    return jox_dot(in, out) < TURN;
}

/* Appends the flight between two distances from the start of a segment of the path. */
static void append_flight(JoxStoreys *s, uint32_t stair, uint32_t segment, float from, float to) {
    const JoxV2 *path = s->stairs[stair].path;
    const JoxV2 along = jox_unit(jox_sub(path[segment + 1], path[segment]));
    if (to - from < LEAST_FLIGHT)
        return;
    s->flights = jox_realloc(s->flights, (size_t)s->flight_count + 1, sizeof *s->flights);
    s->flights[s->flight_count++] =
        (JoxFlight){.stair = stair,
                    .from = jox_add(path[segment], jox_scale(along, from)),
                    .along = along,
                    .run = to - from,
                    .slowness = {1.0f, 1.0f}};
}

/* Appends the flights of one segment, which begins `begun` m from the foot: what landings leave. */
static void lay_segment(JoxStoreys *s, uint32_t stair, uint32_t segment, float begun) {
    const JoxStair *st = &s->stairs[stair];
    const float length = jox_length(jox_sub(st->path[segment + 1], st->path[segment]));
    const float half = 0.5f * st->width;
    const float end = turns_at(st, segment + 1) ? length - half : length;
    float from = turns_at(st, segment) ? half : 0.0f;
    for (uint32_t k = 0; k < st->landing_count; k++) { /* in order */
        const float low = st->landings[k].from - begun, high = st->landings[k].to - begun;
        if (high <= from || low >= end)
            continue;
        append_flight(s, stair, segment, from, low);
        from = high;
    }
    append_flight(s, stair, segment, from, end);
}

static void lay_flights(JoxStoreys *s, uint32_t stair) {
    JoxStair *st = &s->stairs[stair];
    float begun = 0.0f, run = 0.0f;
    st->first_flight = s->flight_count;
    for (uint32_t k = 0; k + 1 < st->path_count; k++) {
        lay_segment(s, stair, k, begun);
        begun += jox_length(jox_sub(st->path[k + 1], st->path[k]));
    }
    st->flight_count = s->flight_count - st->first_flight;
    for (uint32_t f = st->first_flight; f < s->flight_count; f++)
        run += s->flights[f].run;
    float height = s->storeys[st->lower].height;
    for (uint32_t f = st->first_flight; f < s->flight_count; f++) {
        s->flights[f].low = height;
        s->flights[f].slope = st->rise / run;
        height += s->flights[f].run * s->flights[f].slope;
    }
}

/* ---- sheets ---- */

/* Finds the box around a stair whose floor and walls its sheet has. */
static void find_claim(const JoxStair *stair, JoxV2 *low, JoxV2 *high) {
    const float margin = JOX_SEAM_REACH + 1.0f;
    *low = jox_sub(stair->low, jox_v2(margin, margin));
    *high = jox_add(stair->high, jox_v2(margin, margin));
}

static bool claims_meet(const JoxStair *a, const JoxStair *b) {
    JoxV2 low, high, low_b, high_b;
    find_claim(a, &low, &high);
    find_claim(b, &low_b, &high_b);
    return jox_boxes_meet(low, high, low_b, high_b);
}

/* Gives a stair the first sheet beyond the storeys on which no stair before it is in its way. */
static void choose_sheet(JoxStoreys *s, uint32_t stair) {
    JoxStair *st = &s->stairs[stair];
    st->sheet = st->lower;
    if (!jox_stair_joins(st))
        return;
    bool taken = true;
    for (st->sheet = s->storey_count; taken; st->sheet += taken) {
        taken = false;
        for (uint32_t k = 0; k < stair && !taken; k++)
            taken = jox_stair_joins(&s->stairs[k]) && s->stairs[k].sheet == st->sheet &&
                    claims_meet(&s->stairs[k], st);
    }
    if (st->sheet >= s->sheet_count)
        s->sheet_count = st->sheet + 1;
}

/* Lists the stairs of each sheet. */
static void list_stairs(JoxStoreys *s) {
    uint32_t n = 0;
    s->sheet_stairs =
        jox_realloc(s->sheet_stairs, (size_t)s->stair_count + 1, sizeof *s->sheet_stairs);
    for (uint32_t sheet = 0; sheet < s->sheet_count; sheet++) {
        s->sheets[sheet].first_stair = n;
        for (uint32_t k = 0; k < s->stair_count; k++)
            if (s->stairs[k].sheet == sheet)
                s->sheet_stairs[n++] = k;
        s->sheets[sheet].stair_count = n - s->sheets[sheet].first_stair;
    }
    JOX_ASSERT(n == s->stair_count);
}

/* Returns the seam at the foot or head of a stair, seen from the storey or from the stair. */
static JoxSeam make_seam(const JoxStoreys *s, uint32_t stair, bool at_head, bool enters) {
    const JoxStair *st = &s->stairs[stair];
    const uint32_t n = st->path_count, storey = at_head ? st->upper : st->lower;
    const JoxV2 right = st->outline[at_head ? n - 1 : 0],
                left = st->outline[at_head ? n : 2 * n - 1];
    const bool up = at_head != enters; /* crossing it leads up */
    JoxSeam seam = {.here = enters ? storey : st->sheet,
                    .there = enters ? st->sheet : storey,
                    .stair = stair,
                    .enters = enters,
                    .at_head = at_head,
                    .a = up ? left : right,
                    .b = up ? right : left};
    seam.along = jox_unit(jox_sub(seam.b, seam.a));
    seam.length = jox_length(jox_sub(seam.b, seam.a));
    seam.shift = ((float)seam.there - (float)seam.here) * s->pitch;
    return seam;
}

static void list_seams(JoxStoreys *s) {
    s->seams = jox_realloc(s->seams, 4 * (size_t)s->stair_count + 1, sizeof *s->seams);
    s->seam_count = 0;
    for (uint32_t sheet = 0; sheet < s->sheet_count; sheet++) {
        s->sheets[sheet].first_seam = s->seam_count;
        for (uint32_t k = 0; k < 4 * s->stair_count; k++) {
            if (!jox_stair_joins(&s->stairs[k / 4]))
                continue;
            const JoxSeam seam = make_seam(s, k / 4, k & 1, k & 2);
            if (seam.here == sheet)
                s->seams[s->seam_count++] = seam;
        }
        s->sheets[sheet].seam_count = s->seam_count - s->sheets[sheet].first_seam;
    }
}

/* Lays all stairs out and gives them sheets. */
static void lay_stairs(JoxStoreys *s) {
    s->flight_count = 0;
    s->sheet_count = s->storey_count;
    for (uint32_t k = 0; k < s->stair_count; k++) {
        JoxStair *st = &s->stairs[k];
        JOX_ASSERT(st->path_count >= 2 && st->lower <= st->upper && st->upper < s->storey_count);
        if (jox_stair_joins(st))
            st->rise = s->storeys[st->upper].height - s->storeys[st->lower].height;
        lay_outline(st);
        lay_flights(s, k);
        choose_sheet(s, k);
    }
    s->sheets = jox_realloc(s->sheets, s->sheet_count, sizeof *s->sheets);
    list_stairs(s);
}

void jox_storeys_lay_out_again(JoxStoreys *s, float origin, float pitch) {
    lay_stairs(s);
    s->origin = origin;
    s->pitch = pitch;
    s->low = origin + 0.5f * BETWEEN;
    s->high = jox_maxf(s->low, origin + pitch - 0.5f * BETWEEN);
    list_seams(s);
}

void jox_storeys_lay_out(JoxStoreys *s, JoxV2 low, JoxV2 high) {
    lay_stairs(s);
    for (uint32_t k = 0; k < s->stair_count; k++) {
        low = jox_v2(jox_minf(low.x, s->stairs[k].low.x), jox_minf(low.y, s->stairs[k].low.y));
        high = jox_v2(jox_maxf(high.x, s->stairs[k].high.x), jox_maxf(high.y, s->stairs[k].high.y));
    }
    const float depth = jox_maxf(high.y - low.y, 0.0f) + BETWEEN;
    s->pitch = jox_maxf(ceilf(depth / PITCH_UNIT) * PITCH_UNIT, JOX_LEAST_PITCH);
    s->low = low.y;
    s->high = jox_maxf(high.y, low.y);
    s->origin = s->low - 0.5f * BETWEEN;
    list_seams(s);
}

/* ---- memory ---- */

void jox_storeys_copy(JoxStoreys *to, const JoxStoreys *from) {
    *to = *from;
    to->storeys = jox_copy_array(from->storeys, from->storey_count, sizeof *from->storeys);
    to->stairs = jox_copy_array(from->stairs, from->stair_count, sizeof *from->stairs);
    to->sheets = jox_copy_array(from->sheets, from->sheet_count, sizeof *from->sheets);
    to->sheet_stairs =
        jox_copy_array(from->sheet_stairs, from->sheets ? from->stair_count : 0, sizeof(uint32_t));
    to->seams = jox_copy_array(from->seams, from->seam_count, sizeof *from->seams);
    to->flights = jox_copy_array(from->flights, from->flight_count, sizeof *from->flights);
    for (uint32_t k = 0; k < to->storey_count; k++)
        to->storeys[k].name = jox_strdup(from->storeys[k].name);
    for (uint32_t k = 0; k < to->stair_count; k++) {
        const JoxStair *st = &from->stairs[k];
        to->stairs[k].name = jox_strdup(st->name);
        to->stairs[k].path = jox_copy_array(st->path, st->path_count, sizeof *st->path);
        to->stairs[k].landings =
            jox_copy_array(st->landings, st->landing_count, sizeof *st->landings);
        to->stairs[k].outline =
            jox_copy_array(st->outline, st->outline ? 2 * st->path_count : 0, sizeof *st->outline);
    }
}

void jox_storeys_free(JoxStoreys *s) {
    for (uint32_t k = 0; k < s->storey_count; k++)
        jox_free(s->storeys[k].name);
    for (uint32_t k = 0; k < s->stair_count; k++) {
        jox_free(s->stairs[k].name);
        jox_free(s->stairs[k].path);
        jox_free(s->stairs[k].landings);
        jox_free(s->stairs[k].outline);
    }
    jox_free(s->storeys);
    jox_free(s->stairs);
    jox_free(s->sheets);
    jox_free(s->sheet_stairs);
    jox_free(s->seams);
    jox_free(s->flights);
    *s = (JoxStoreys){0};
}

/* ---- what is at a position ---- */

const JoxFlight *jox_flight_at(const JoxStoreys *s, JoxV2 at) {
    if (!s || s->flight_count == 0)
        return NULL;
    const uint32_t sheet = jox_sheet_of(s, at.y);
    const JoxSheet *on = &s->sheets[sheet];
    const JoxV2 plan = {at.x, at.y - (float)sheet * s->pitch};
    for (uint32_t k = on->first_stair; k < on->first_stair + on->stair_count; k++) {
        const JoxStair *st = &s->stairs[s->sheet_stairs[k]];
        for (uint32_t f = st->first_flight; f < st->first_flight + st->flight_count; f++) {
            const JoxFlight *flight = &s->flights[f];
            const JoxV2 from = jox_sub(plan, flight->from);
            const float along = jox_dot(flight->along, from);
            if (along >= 0.0f && along < flight->run &&
                fabsf(jox_det(flight->along, from)) <= 0.5f * st->width)
                return flight;
        }
    }
    return NULL;
}

bool jox_has_belts(const JoxStoreys *s) {
    for (uint32_t k = 0; s && k < s->stair_count; k++)
        if (s->stairs[k].belt != 0.0f)
            return true;
    return false;
}

JoxV2 jox_belt_at(const JoxStoreys *s, JoxV2 at) {
    const JoxFlight *flight = jox_flight_at(s, at);
    const float belt = flight ? s->stairs[flight->stair].belt : 0.0f;
    if (belt == 0.0f)
        return (JoxV2){0.0f, 0.0f};
    return jox_scale(flight->along, belt / sqrtf(1.0f + flight->slope * flight->slope));
}

int32_t jox_stair_at(const JoxStoreys *s, JoxV2 at) {
    if (!jox_has_storeys(s))
        return -1;
    const uint32_t sheet = jox_sheet_of(s, at.y);
    const JoxSheet *on = &s->sheets[sheet];
    const JoxV2 plan = {at.x, at.y - (float)sheet * s->pitch};
    int32_t nearest = -1;
    float least = INFINITY;
    if (sheet < s->storey_count)
        return -1;
    for (uint32_t k = on->first_stair; k < on->first_stair + on->stair_count; k++) {
        const JoxStair *st = &s->stairs[s->sheet_stairs[k]];
        const float far = jox_polygon_distance(st->outline, 2 * st->path_count, plan, true);
        if (far < least) {
            least = far;
            nearest = (int32_t)s->sheet_stairs[k];
        }
    }
    return nearest;
}

/* Returns the elevation on a stair, at the point of its flights that is nearest to a point. */
static float find_height_on(const JoxStoreys *s, const JoxStair *st, JoxV2 plan) {
    float height = s->storeys[st->lower].height, least = INFINITY;
    for (uint32_t f = st->first_flight; f < st->first_flight + st->flight_count; f++) {
        const JoxFlight *flight = &s->flights[f];
        const JoxV2 end = jox_add(flight->from, jox_scale(flight->along, flight->run));
        const JoxV2 nearest = jox_segment_nearest(flight->from, end, plan);
        const float far = jox_length2(jox_sub(plan, nearest));
        if (far < least) {
            least = far;
            height = flight->low + flight->slope * jox_length(jox_sub(nearest, flight->from));
        }
    }
    return height;
}

float jox_floor_height(const JoxStoreys *s, JoxV2 at) {
    if (!s || s->storey_count == 0)
        return 0.0f;
    const int32_t stair = jox_stair_at(s, at);
    const JoxV2 plan = jox_in_plan(s, at);
    if (stair >= 0)
        return find_height_on(s, &s->stairs[stair], plan);
    const JoxFlight *slope = jox_flight_at(s, at);
    if (slope)
        return slope->low + slope->slope * jox_dot(slope->along, jox_sub(plan, slope->from));
    return s->storeys[jox_sheet_of(s, at.y)].height;
}

uint32_t jox_storey_at(const JoxStoreys *s, JoxV2 at) {
    const int32_t stair = jox_stair_at(s, at);
    if (!s || s->storey_count == 0)
        return 0;
    if (stair < 0)
        return jox_sheet_of(s, at.y);
    const JoxStair *st = &s->stairs[stair];
    const float height = jox_floor_height(s, at);
    uint32_t storey = st->lower;
    for (uint32_t k = st->lower; k <= st->upper; k++)
        if (fabsf(height - s->storeys[k].height) < fabsf(height - s->storeys[storey].height))
            storey = k;
    return storey;
}

bool jox_is_floor_of(const JoxStoreys *s, uint32_t sheet, JoxV2 plan) {
    const bool on_storey = sheet < s->storey_count;
    for (uint32_t k = 0; k < s->stair_count; k++) {
        const JoxStair *st = &s->stairs[k];
        const bool here = on_storey
                              ? jox_stair_joins(st) && st->lower <= sheet && sheet <= st->upper
                              : st->sheet == sheet;
        if (here && jox_is_within(plan, st->low, st->high) &&
            jox_polygon_contains(st->outline, 2 * st->path_count, plan))
            return !on_storey;
    }
    return on_storey;
}

bool jox_is_floor(const JoxStoreys *s, JoxV2 at) {
    return !jox_has_storeys(s) || jox_is_floor_of(s, jox_sheet_of(s, at.y), jox_in_plan(s, at));
}

const JoxSeam *jox_find_crossed_seam(const JoxStoreys *s, JoxV2 at) {
    const uint32_t sheet = jox_sheet_of(s, at.y);
    const JoxSheet *on = &s->sheets[sheet];
    const JoxV2 plan = {at.x, at.y - (float)sheet * s->pitch};
    for (uint32_t k = on->first_seam; k < on->first_seam + on->seam_count; k++) {
        const JoxSeam *seam = &s->seams[k];
        const JoxV2 from = jox_sub(plan, seam->a);
        const float beyond = jox_det(seam->along, from), along = jox_dot(seam->along, from);
        if (beyond > 0.0f && beyond <= JOX_SEAM_DEPTH && along >= 0.0f && along <= seam->length)
            return seam;
    }
    return NULL;
}

const JoxSeam *jox_find_seam_between(const JoxStoreys *s, JoxV2 from, JoxV2 to) {
    if (!jox_has_storeys(s))
        return NULL;
    const uint32_t here = jox_sheet_of(s, from.y), there = jox_sheet_of(s, to.y);
    const JoxSheet *on = &s->sheets[here];
    const JoxV2 from_plan = {from.x, from.y - (float)here * s->pitch};
    const JoxV2 to_plan = {to.x, to.y - (float)there * s->pitch};
    for (uint32_t k = on->first_seam; here != there && k < on->first_seam + on->seam_count; k++)
        if (s->seams[k].there == there && jox_seam_lets_see(&s->seams[k], from_plan, to_plan))
            return &s->seams[k];
    return NULL;
}

bool jox_leads_off_sheet(const JoxStoreys *s, JoxV2 from, JoxV2 to) {
    const uint32_t here = jox_sheet_of(s, from.y);
    const JoxSheet *on = &s->sheets[here];
    bool leaves = jox_sheet_of(s, to.y) != here;
    for (uint32_t k = on->first_seam; !leaves && k < on->first_seam + on->seam_count; k++)
        leaves = jox_seam_lets_see(&s->seams[k], jox_in_plan(s, from), jox_in_plan(s, to));
    return leaves;
}

bool jox_plan_offset(const JoxStoreys *s, JoxV2 from, JoxV2 to, JoxV2 *offset) {
    *offset = jox_sub(to, from);
    if (!jox_has_storeys(s) || jox_sheet_of(s, from.y) == jox_sheet_of(s, to.y))
        return true;
    const JoxSeam *seam = jox_find_seam_between(s, from, to);
    if (seam)
        offset->y -= seam->shift;
    return seam != NULL;
}

float jox_distance_between(const JoxStoreys *s, JoxV2 from, JoxV2 to) {
    if (!jox_has_storeys(s) || jox_sheet_of(s, from.y) == jox_sheet_of(s, to.y))
        return jox_length(jox_sub(to, from));
    const JoxV2 away = jox_sub(jox_in_plan(s, to), jox_in_plan(s, from));
    return jox_length(
        jox_v2(jox_length(away), jox_floor_height(s, to) - jox_floor_height(s, from)));
}
