#include "world/routes/hindrance.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "geom/wall_way.h"

static const float THIN = 0.05f;   /* m: clearance of a way that only walls block */
static const float SQUEEZE = 0.7f; /* clearance in radii: blocks gaps below 1.2 radii */
static const float CLASS = 0.02f;  /* m: step between classes of radii */
static const float STRIDE = 0.1f;  /* m */
enum { CLASSES = 64, MOST_STRIDES = 100000, WAYS = JOX_WAYS_STEPLESS + 1 };

/* Obstacles of a field; each layer includes those before it. */
typedef enum Layer {
    WALLS,   /* walls that never open */
    BODIES,  /* bodies that nothing moves */
    LASTING, /* closed gates that nothing opens */
    LIFTS,   /* gates and bodies as they are, all lifts in use */
    ALL,     /* gates, bodies and lifts as they are */
    LAYERS
} Layer;

struct JoxHindrances {
    const JoxRouteStage *stage;
    JoxRouteStage later;  /* the stage for layer LASTING: gates that something opens are open */
    JoxWalls later_walls; /* shares all but its rings with all_walls */
    uint32_t place, gate; /* gate: ring of the closed gate on the place, or UINT32_MAX */
    JoxField *thin[WAYS]; /* layer WALLS with clearance THIN */
    JoxField *fields[WAYS][CLASSES][LAYERS]; /* by class of radius */
};

uint32_t jox_hindrance_find_gate(const JoxRouteStage *stage, uint32_t index) {
    const JoxPlace *place = &stage->places[index];
    const JoxWalls *walls = stage->all_walls;
    const float on = 0.01f; /* m */
    const bool thin = jox_place_is_spot(place) || jox_place_form(place) == JOX_FORM_LINE;
    for (uint32_t r = 0; thin && r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t v = ring->first; ring->name && !ring->open && v < ring->first + ring->count;
             v++) {
            const JoxV2 a = walls->vertices[v].point,
                        b = walls->vertices[walls->vertices[v].next].point;
            if (jox_length(jox_sub(jox_segment_nearest(a, b, place->centre), place->centre)) < on)
                return r;
        }
    }
    return UINT32_MAX;
}

JoxHindrances *jox_hindrances_create(const JoxRouteStage *stage, uint32_t place,
                                     const bool *opening) {
    const JoxWalls *walls = stage->all_walls;
    JoxHindrances *h = jox_alloc(1, sizeof *h);
    *h = (JoxHindrances){.stage = stage,
                         .later = *stage,
                         .later_walls = *walls,
                         .place = place,
                         .gate = jox_hindrance_find_gate(stage, place)};
    h->later.all_walls = &h->later_walls;
    h->later_walls.rings = jox_alloc((size_t)walls->ring_count + 1, sizeof *walls->rings);
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        h->later_walls.rings[r] = walls->rings[r];
        h->later_walls.rings[r].open |= opening && opening[r];
    }
    return h;
}

float jox_hindrance_narrowest(float radius) {
    return 2.0f * SQUEEZE * radius;
}

void jox_hindrances_free(JoxHindrances *h) {
    for (int ways = 0; ways < WAYS; ways++) {
        jox_field_free(h->thin[ways]);
        for (int c = 0; c < CLASSES; c++)
            for (int layer = 0; layer < LAYERS; layer++)
                jox_field_free(h->fields[ways][c][layer]);
    }
    jox_free(h->later_walls.rings);
    jox_free(h);
}

JoxKept jox_hindrance_of_agent(const JoxAgents *a, uint32_t i) {
    return (JoxKept){{a->x[i], a->y[i]}, jox_param(a, JOX_PARAM_radius, i), jox_agent_ways(a, i)};
}

static JoxField *make_field(const JoxHindrances *h, JoxAgentWays ways, Layer layer,
                            float clearance) {
    const JoxRouteFieldOptions look = {
        .gates = layer >= LASTING,
        .bodies = layer == WALLS   ? 0
                  : layer >= LIFTS ? JOX_OBSTACLES_ALL
                                   : 1u << JOX_OBSTACLE_FIXED,
        .clearance = clearance,
        .stepless = ways == JOX_WAYS_STEPLESS,
        .lifts = ways != JOX_WAYS_STAIRS,
        .all_lifts = layer != ALL,
    };
    return jox_routes_make_field(layer == LASTING ? &h->later : h->stage, h->place, &look);
}

static int get_class(float radius) {
    const int class = (int)floorf(radius / CLASS + 1e-3f);
    return class < 1 ? 1 : class < CLASSES ? class : CLASSES - 1;
}

/* Returns the ways that count for an agent: all are the same on one plane, and those by lifts
   where there are none. */
static JoxAgentWays get_ways(const JoxHindrances *h, JoxAgentWays ways) {
    if (!h->stage->agents->storeys)
        return JOX_WAYS_STAIRS;
    return ways == JOX_WAYS_EITHER && !h->stage->machines->lifts ? JOX_WAYS_STAIRS : ways;
}

static const JoxField *get_field(JoxHindrances *h, const JoxKept *kept, Layer layer) {
    const JoxAgentWays ways = get_ways(h, kept->ways);
    const int class = get_class(kept->radius);
    JoxField **field = &h->fields[ways][class][layer];
    if (!*field)
        *field = make_field(h, ways, layer, jox_maxf(THIN, SQUEEZE * CLASS * (float)class));
    return *field;
}

static const JoxField *get_thin(JoxHindrances *h, JoxAgentWays ways) {
    ways = get_ways(h, ways);
    if (!h->thin[ways])
        h->thin[ways] = make_field(h, ways, WALLS, THIN);
    return h->thin[ways];
}

static bool leads_from(const JoxField *field, JoxV2 from) {
    return jox_field_distance(field, from) < INFINITY;
}

/* ---- where a way is cut ---- */

/* Returns the distance of a point to a body's outline, m; 0 inside. */
static float measure_gap(const JoxObstacle *body, JoxV2 p) {
    if (jox_polygon_contains(body->ring, body->count, p))
        return 0.0f;
    return jox_polygon_distance(body->ring, body->count, p, false);
}

static JoxV2 get_middle(const JoxObstacle *body) {
    JoxV2 sum = {0.0f, 0.0f};
    for (uint32_t k = 0; k < body->count; k++)
        sum = jox_add(sum, body->ring[k]);
    return jox_scale(sum, 1.0f / (float)body->count);
}

/* Returns whether a stride crosses an edge or one of its images beyond joined edges. */
static bool is_passed(const JoxHindrances *h, JoxV2 from, JoxV2 to, JoxV2 p, JoxV2 q) {
    const JoxV2 period = h->stage->agents->period;
    const int across = period.x > 0.0f, up = period.y > 0.0f;
    for (int i = -across; i <= across; i++)
        for (int j = -up; j <= up; j++) {
            const JoxV2 by = {(float)i * period.x, (float)j * period.y};
            if (jox_edge_lies_between(from, to, jox_add(p, by), jox_add(q, by)))
                return true;
        }
    return false;
}

/* Finds the closed gate of a layer that a stride crosses, or the body nearer than `clear` m. */
static bool find_cut(const JoxHindrances *h, JoxV2 p, JoxV2 q, Layer layer, float clear,
                     JoxHindrance *out) {
    const JoxWalls *walls = layer == LASTING ? &h->later_walls : h->stage->all_walls;
    const JoxObstacles *bodies = jox_routes_obstacles(h->stage->routes);
    for (uint32_t r = 0; layer >= LASTING && r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t v = ring->first;
             jox_wall_is_shut_gate(walls, r) && v < ring->first + ring->count; v++) {
            const JoxV2 from = walls->vertices[v].point,
                        to = walls->vertices[walls->vertices[v].next].point;
            if (!is_passed(h, from, to, p, q))
                continue;
            *out = (JoxHindrance){JOX_HINDRANCE_GATE, r, jox_scale(jox_add(from, to), 0.5f)};
            return true;
        }
    }
    for (uint32_t b = 0; layer != LASTING && b < bodies->count; b++) {
        const JoxObstacle *body = &bodies->items[b];
        if ((body->kind == JOX_OBSTACLE_FIXED) != (layer == BODIES) || body->count < 3 ||
            measure_gap(body, q) >= clear)
            continue;
        const JoxHindranceKind kind = layer == BODIES ? JOX_HINDRANCE_FILLED : JOX_HINDRANCE_BODY;
        *out = (JoxHindrance){kind, body->id, get_middle(body)};
        return true;
    }
    return false;
}

/* Returns where people leave a lift that they take on the way of a field. */
static JoxV2 find_way_out(const JoxHindrances *h, const JoxField *field, uint32_t l,
                          uint32_t from) {
    const JoxLiftView *view = h->stage->machines->lifts;
    const JoxLift *lift = &view->lifts[l];
    JoxV2 best = jox_lift_outside(lift, from, view->storeys);
    double least = INFINITY;
    for (uint32_t to = 0; to < lift->stop_count; to++) {
        const JoxV2 outside = jox_lift_outside(lift, to, view->storeys);
        const double way = (double)jox_field_distance(field, outside) +
                           (double)JOX_LIFT_PACE * jox_lift_usual_time(lift, from, to);
        if (to == from || !(way < least))
            continue;
        least = way;
        best = outside;
    }
    return best;
}

/* Returns the point a stride farther on the way of a field, over a seam or by a lift too; `from`
   itself at its end. */
static JoxV2 advance_along(const JoxHindrances *h, const JoxField *field, JoxV2 from) {
    const JoxStoreys *storeys = h->stage->agents->storeys;
    const JoxLiftView *view = h->stage->machines->lifts;
    uint32_t lift, stop;
    JoxV2 to = jox_add(from, jox_scale(jox_field_direction(field, from), STRIDE));
    const JoxSeam *seam = storeys ? jox_find_crossed_seam(storeys, to) : NULL;
    to.y += seam ? seam->shift : 0.0f;
    if (view && jox_field_first_lift(field, view->lifts, view->lift_count, from, &lift, &stop) &&
        view->lifts[lift].stops[stop].storey == jox_sheet_of(storeys, from.y) &&
        jox_lift_contains(&view->lifts[lift], jox_in_plan(storeys, from)))
        return find_way_out(h, field, lift, stop);
    return to;
}

/* Follows the way of the field `open` until something of a layer blocks it. */
static JoxHindrance trace_cut(const JoxHindrances *h, const JoxField *open, JoxV2 from, Layer layer,
                              float clear) {
    JoxHindrance cut = {layer == LIFTS ? JOX_HINDRANCE_BODY : JOX_HINDRANCE_FILLED, UINT32_MAX,
                        from};
    for (int n = 0; n < MOST_STRIDES; n++) {
        const JoxV2 to = advance_along(h, open, from);
        if ((to.x == from.x && to.y == from.y) || find_cut(h, from, to, layer, clear, &cut))
            break;
        from = to;
    }
    return cut;
}

/* Finds what blocks the way: a gate that nothing opens if every way has one, else the first gate or
   body on a way that opens later. */
static JoxHindrance trace_shut(JoxHindrances *h, const JoxKept *kept, float clear) {
    const JoxField *lasting = get_field(h, kept, LASTING);
    if (leads_from(lasting, kept->at))
        return trace_cut(h, lasting, kept->at, LIFTS, clear);
    const JoxField *bodies = get_field(h, kept, BODIES);
    const JoxHindrance cut = trace_cut(h, bodies, kept->at, LASTING, clear);
    return cut.by != UINT32_MAX ? cut : trace_cut(h, bodies, kept->at, LIFTS, clear);
}

/* Finds the first lift out of use on the way. */
static JoxHindrance trace_lift(JoxHindrances *h, const JoxKept *kept) {
    const JoxField *field = get_field(h, kept, LIFTS);
    const JoxLiftView *view = h->stage->machines->lifts;
    JoxHindrance found = {JOX_HINDRANCE_LIFT, UINT32_MAX, kept->at};
    uint32_t lift, stop;
    for (uint32_t n = 0;
         n < view->lift_count && found.by == UINT32_MAX &&
         jox_field_first_lift(field, view->lifts, view->lift_count, found.at, &lift, &stop);
         n++) {
        const bool used = view->cars[lift].mode == JOX_LIFT_IN_USE;
        found.at = used ? find_way_out(h, field, lift, stop)
                        : jox_lift_outside(&view->lifts[lift], stop, view->storeys);
        found.by = used ? UINT32_MAX : lift;
    }
    return found;
}

/* Returns the first point on the way of `thin` from which the field `broad` leads on: the narrow
   spot. */
static JoxV2 trace_narrow(const JoxHindrances *h, const JoxField *thin, const JoxField *broad,
                          JoxV2 from) {
    for (int n = 0; n < MOST_STRIDES && !leads_from(broad, from); n++) {
        const JoxV2 to = advance_along(h, thin, from);
        if (to.x == from.x && to.y == from.y)
            break;
        from = to;
    }
    return from;
}

/* Returns why not even a slim agent gets there: walls, or the way is one that it does not take. */
static JoxHindranceKind find_lasting(JoxHindrances *h, const JoxKept *kept) {
    if (kept->ways == JOX_WAYS_EITHER || !h->stage->agents->storeys ||
        !leads_from(get_thin(h, JOX_WAYS_EITHER), kept->at))
        return JOX_HINDRANCE_WALL;
    return kept->ways == JOX_WAYS_STEPLESS ? JOX_HINDRANCE_STAIRS : JOX_HINDRANCE_NO_LIFTS;
}

JoxHindranceKind jox_hindrances_kind(JoxHindrances *h, const JoxKept *kept) {
    const JoxV2 from = kept->at;
    JOX_ASSERT(h->place < h->stage->place_count);
    if (leads_from(get_field(h, kept, ALL), from))
        return h->gate == UINT32_MAX ? JOX_HINDRANCE_NONE : JOX_HINDRANCE_GATE;
    if (!leads_from(get_thin(h, kept->ways), from))
        return find_lasting(h, kept);
    if (!leads_from(get_field(h, kept, WALLS), from))
        return JOX_HINDRANCE_NARROW;
    if (!leads_from(get_field(h, kept, BODIES), from))
        return JOX_HINDRANCE_FILLED;
    return h->stage->machines->lifts && leads_from(get_field(h, kept, LIFTS), from)
               ? JOX_HINDRANCE_LIFT
               : JOX_HINDRANCE_GATE;
}

JoxHindrance jox_hindrances_find(JoxHindrances *h, const JoxKept *kept) {
    const float clear = SQUEEZE * CLASS * (float)get_class(kept->radius);
    const JoxHindranceKind kind = jox_hindrances_kind(h, kept);
    switch (kind) {
    case JOX_HINDRANCE_NARROW:
        return (JoxHindrance){
            kind, UINT32_MAX,
            trace_narrow(h, get_thin(h, kept->ways), get_field(h, kept, WALLS), kept->at)};
    case JOX_HINDRANCE_FILLED:
        return trace_cut(h, get_field(h, kept, WALLS), kept->at, BODIES, clear);
    case JOX_HINDRANCE_GATE:
        if (h->gate != UINT32_MAX)
            return (JoxHindrance){kind, h->gate, h->stage->places[h->place].centre};
        return trace_shut(h, kept, clear);
    case JOX_HINDRANCE_LIFT:
        return trace_lift(h, kept);
    default:
        return (JoxHindrance){kind, UINT32_MAX, kept->at};
    }
}
