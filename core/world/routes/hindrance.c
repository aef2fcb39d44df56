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
enum { CLASSES = 64, MOST_STRIDES = 100000 };

/* Obstacles of a field; each layer includes those before it. */
typedef enum Layer {
    WALLS,   /* walls that never open */
    BODIES,  /* bodies that nothing moves */
    LASTING, /* closed gates that nothing opens */
    ALL,     /* gates and bodies as they are */
    LAYERS
} Layer;

struct JoxHindrances {
    const JoxRouteStage *stage;
    JoxRouteStage later;  /* the stage for layer LASTING: gates that something opens are open */
    JoxWalls later_walls; /* shares all but its rings with all_walls */
    uint32_t place, gate; /* gate: ring of the closed gate on the place, or UINT32_MAX */
    JoxField *thin;       /* layer WALLS with clearance THIN */
    JoxField *fields[CLASSES][LAYERS]; /* by class of radius */
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
    jox_field_free(h->thin);
    for (int c = 0; c < CLASSES; c++)
        for (int layer = 0; layer < LAYERS; layer++)
            jox_field_free(h->fields[c][layer]);
    jox_free(h->later_walls.rings);
    jox_free(h);
}

static JoxField *make_field(const JoxHindrances *h, Layer layer, float clearance) {
    const JoxRouteFieldOptions look = {
        .gates = layer >= LASTING,
        .bodies = layer == WALLS ? 0
                  : layer == ALL ? JOX_OBSTACLES_ALL
                                 : 1u << JOX_OBSTACLE_FIXED,
        .clearance = clearance,
    };
    return jox_routes_make_field(layer == LASTING ? &h->later : h->stage, h->place, &look);
}

static int get_class(float radius) {
    const int class = (int)floorf(radius / CLASS + 1e-3f);
    return class < 1 ? 1 : class < CLASSES ? class : CLASSES - 1;
}

static const JoxField *get_field(JoxHindrances *h, int class, Layer layer) {
    JoxField **field = &h->fields[class][layer];
    if (!*field)
        *field = make_field(h, layer, jox_maxf(THIN, SQUEEZE * CLASS * (float)class));
    return *field;
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
        for (uint32_t v = ring->first; ring->name && !ring->open && v < ring->first + ring->count;
             v++) {
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

/* Follows the way of the field `open` until something of a layer blocks it. */
static JoxHindrance trace_cut(const JoxHindrances *h, const JoxField *open, JoxV2 from, Layer layer,
                              float clear) {
    JoxHindrance cut = {layer == ALL ? JOX_HINDRANCE_BODY : JOX_HINDRANCE_FILLED, UINT32_MAX, from};
    for (int n = 0; n < MOST_STRIDES; n++) {
        const JoxV2 way = jox_field_direction(open, from),
                    to = jox_add(from, jox_scale(way, STRIDE));
        if (jox_length2(way) == 0.0f || find_cut(h, from, to, layer, clear, &cut))
            break;
        from = to;
    }
    return cut;
}

/* Finds what blocks the way: a gate that nothing opens if every way has one, else the first gate or
   body on a way that opens later. */
static JoxHindrance trace_shut(JoxHindrances *h, int class, JoxV2 from, float clear) {
    const JoxField *lasting = get_field(h, class, LASTING);
    if (leads_from(lasting, from))
        return trace_cut(h, lasting, from, ALL, clear);
    const JoxField *bodies = get_field(h, class, BODIES);
    const JoxHindrance cut = trace_cut(h, bodies, from, LASTING, clear);
    return cut.by != UINT32_MAX ? cut : trace_cut(h, bodies, from, ALL, clear);
}

/* Returns the first point on the way of `thin` from which the field `broad` leads on: the narrow
   spot. */
static JoxV2 trace_narrow(const JoxField *thin, const JoxField *broad, JoxV2 from) {
    for (int n = 0; n < MOST_STRIDES && !leads_from(broad, from); n++) {
        const JoxV2 way = jox_field_direction(thin, from);
        if (jox_length2(way) == 0.0f)
            break;
        from = jox_add(from, jox_scale(way, STRIDE));
    }
    return from;
}

JoxHindranceKind jox_hindrances_kind(JoxHindrances *h, JoxV2 from, float radius) {
    const int class = get_class(radius);
    JOX_ASSERT(h->place < h->stage->place_count);
    if (leads_from(get_field(h, class, ALL), from))
        return h->gate == UINT32_MAX ? JOX_HINDRANCE_NONE : JOX_HINDRANCE_GATE;
    if (!h->thin)
        h->thin = make_field(h, WALLS, THIN);
    if (!leads_from(h->thin, from))
        return JOX_HINDRANCE_WALL;
    if (!leads_from(get_field(h, class, WALLS), from))
        return JOX_HINDRANCE_NARROW;
    return leads_from(get_field(h, class, BODIES), from) ? JOX_HINDRANCE_GATE
                                                         : JOX_HINDRANCE_FILLED;
}

JoxHindrance jox_hindrances_find(JoxHindrances *h, JoxV2 from, float radius) {
    const int class = get_class(radius);
    const float clear = SQUEEZE * CLASS * (float)class;
    const JoxHindranceKind kind = jox_hindrances_kind(h, from, radius);
    switch (kind) {
    case JOX_HINDRANCE_NARROW:
        return (JoxHindrance){kind, UINT32_MAX,
                              trace_narrow(h->thin, get_field(h, class, WALLS), from)};
    case JOX_HINDRANCE_FILLED:
        return trace_cut(h, get_field(h, class, WALLS), from, BODIES, clear);
    case JOX_HINDRANCE_GATE:
        if (h->gate != UINT32_MAX)
            return (JoxHindrance){kind, h->gate, h->stage->places[h->place].centre};
        return trace_shut(h, class, from, clear);
    default:
        return (JoxHindrance){kind, UINT32_MAX, from};
    }
}
