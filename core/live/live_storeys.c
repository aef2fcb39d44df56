/* Storeys and stairs in the messages of the live page: what they are, in the scene message,
   and where people stand, in frames. The page draws each storey, and each stair between storeys, as
   a deck of its own: storeys from the lowest up, then the stairs. */
#include "geom/polygon.h"
#include "live/live.h"

enum { DIGITS = 7 }; /* significant digits of positions and sizes, which are floats */

/* ---- where people stand ---- */

/* Returns the car that a person rides in who is at a point of the plan, on a storey; NULL: none. */
static const JoxCarLook *find_car(const JoxLiveCrowd *crowd, uint32_t storey, JoxV2 plan) {
    for (uint32_t l = 0; l < crowd->lift_count; l++) {
        const JoxLift *lift = &crowd->lifts[l];
        const JoxCarLook *car = &crowd->cars[l];
        if (lift->stops[car->stop].storey == storey && jox_is_within(plan, lift->low, lift->high) &&
            jox_lift_contains(lift, plan))
            return car;
    }
    return NULL;
}

JoxLiveStand jox_live_find_stand(const JoxLiveCrowd *crowd, JoxV2 at) {
    const JoxStoreys *s = crowd->storeys;
    const int32_t stair = jox_stair_at(s, at);
    const uint32_t storey = jox_sheet_of(s, at.y);
    const JoxCarLook *car = stair < 0 ? find_car(crowd, storey, jox_in_plan(s, at)) : NULL;
    return (JoxLiveStand){.deck =
                              (uint16_t)(stair < 0 ? storey : s->storey_count + (uint32_t)stair),
                          .height = car ? car->height : jox_floor_height(s, at)};
}

void jox_live_find_heights(const JoxStoreys *s, float *low, float *high) {
    *low = s->storeys[0].height;
    *high = s->storeys[s->storey_count - 1].height;
    for (uint32_t f = 0; f < s->flight_count; f++) {
        const float from = s->flights[f].low, to = from + s->flights[f].run * s->flights[f].slope;
        *low = jox_minf(*low, jox_minf(from, to));
        *high = jox_maxf(*high, jox_maxf(from, to));
    }
}

/* ---- the scene message ---- */

static void add_point(JoxJson *json, const char *key, JoxV2 p) {
    jox_json_numbers_of(json, key, (double[]){(double)p.x, (double)p.y}, 2, DIGITS);
}

static void add_outline(JoxJson *json, const JoxV2 *points, uint32_t count) {
    jox_json_array(json, "outline");
    for (uint32_t i = 0; i < count; i++)
        add_point(json, NULL, points[i]);
    jox_json_end(json);
}

static void add_stair(JoxJson *json, const JoxStoreys *s, const JoxStair *stair) {
    static const char *const KINDS[] = {[JOX_STAIR_STEPS] = "stairs",
                                        [JOX_STAIR_RAMP] = "ramp",
                                        [JOX_STAIR_ESCALATOR] = "escalator"};
    static const char *const WAYS[] = {
        [JOX_STAIR_BOTH_WAYS] = "both", [JOX_STAIR_UP] = "up", [JOX_STAIR_DOWN] = "down"};
    jox_json_object(json, NULL);
    jox_json_string(json, "name", stair->name);
    jox_json_string(json, "kind", KINDS[stair->kind]);
    jox_json_string(json, "way", WAYS[stair->way]);
    jox_json_whole(json, "lower", stair->lower);
    jox_json_whole(json, "upper", stair->upper);
    jox_json_whole(json, "sheet", stair->sheet);
    jox_json_digits(json, "width", (double)stair->width, DIGITS);
    add_outline(json, stair->outline, 2 * stair->path_count);
    jox_json_array(json, "path");
    for (uint32_t i = 0; i < stair->path_count; i++)
        add_point(json, NULL, stair->path[i]);
    jox_json_end(json);
    jox_json_array(json, "flights");
    for (uint32_t f = stair->first_flight; f < stair->first_flight + stair->flight_count; f++) {
        const JoxFlight *flight = &s->flights[f];
        jox_json_object(json, NULL);
        add_point(json, "from", flight->from);
        add_point(json, "along", flight->along);
        jox_json_digits(json, "run", (double)flight->run, DIGITS);
        jox_json_digits(json, "low", (double)flight->low, DIGITS);
        jox_json_digits(json, "slope", (double)flight->slope, DIGITS);
        jox_json_end(json);
    }
    jox_json_end(json);
    jox_json_end(json);
}

void jox_live_add_storeys(const JoxStoreys *s, JoxJson *json) {
    if (!jox_has_storeys(s)) {
        jox_json_null(json, "storeys");
        return;
    }
    jox_json_object(json, "storeys");
    jox_json_digits(json, "pitch", (double)s->pitch, DIGITS);
    jox_json_digits(json, "origin", (double)s->origin, DIGITS);
    jox_json_array(json, "list");
    for (uint32_t k = 0; k < s->storey_count; k++) {
        jox_json_object(json, NULL);
        jox_json_string(json, "name", s->storeys[k].name);
        jox_json_digits(json, "height", (double)s->storeys[k].height, DIGITS);
        jox_json_end(json);
    }
    jox_json_end(json);
    jox_json_array(json, "stairs");
    for (uint32_t k = 0; k < s->stair_count; k++)
        add_stair(json, s, &s->stairs[k]);
    jox_json_end(json);
    jox_json_end(json);
}
