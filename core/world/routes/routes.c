#include "world/routes/routes.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "task/worker.h"
#include "world/routes/body_obstacles.h"
#include "world/routes/joined_edges.h"

enum { MOST_FIELDS = 64 };
/* m: the smallest that gives few enough cells to be done within DELAY; the largest still shows
   doors of half a metre. */
static const float CELLS[] = {0.125f, 0.18f, 0.25f, 0.3f};
static const float MOST_CELLS = 400000.0f;
/* Of a field that goes by where the crowd is, which has moved on by the time it is used; it is made
   anew every CROWD_PAUSE. */
static const float MOST_CROWD_CELLS = 100000.0f;
static const float CLEARANCE = 0.15f;  /* m: half of a person who turns sideways */
static const float MOST_ROOM = 1.5f;   /* times the box that would be laid out */
static const float SPARE = 3.0f;       /* m more, once people have gone beyond the box before */
static const float MARGIN = 3.0f;      /* m about all walls and agents */
static const double DELAY = 0.5;       /* s from asking to use */
static const double PAUSE = 2.0;       /* s between renewals for bodies that move */
static const double LOOK = 0.25;       /* s between looks at bodies and crowds */
static const double CROWD_PAUSE = 1.0; /* s between renewals for a crowd, */
static const float CROWD_CELLS = 150000.0f; /* and for so many cells 1 s at least */
enum { HELD = 256, FEW_HELD = 5 * HELD };   /* one person held up; fewer make no crowd */

/* One field to be made, with copies of all that it is made of. */
typedef struct Making {
    JoxWorkItem item; /* first */
    JoxWalls walls;
    JoxPlace *places; /* the place, and behind it its members */
    uint32_t place_count;
    JoxV2 low, high;
    float cell, clearance; /* m */
    JoxFieldCrowd crowd;
    bool keeps_marks;
    JoxFieldMarks *marks; /* of the route's field before, then of this one; NULL: none */
    JoxField *field;
} Making;

typedef struct Route {
    Making *making;            /* or NULL */
    uint64_t asked, due;       /* ticks: when the last making began, when its field is used */
    uint32_t walls, obstacles; /* versions of what it was made of */
    JoxFieldMarks *marks;      /* of crowds: what its walls do, as it is made again and again */
} Route;

struct JoxRoutes {
    JoxWorker *worker;
    JoxObstacles obstacles;
    uint32_t walls; /* version, as a Route's */
    uint32_t seen;  /* world->state.walls_version */
    bool begun;
    uint32_t capacity; /* places */
    /* By place and kind of field, as the mind sees them: [place * JOX_ROUTE_KINDS + kind]. */
    JoxField **fields;
    Route *items;
    uint8_t *wanted; /* by place */
    uint32_t *held;  /* by place: people bound there who are held up, in 1 / HELD; scratch */
    uint32_t count;  /* fields that are there or under way */
};

JoxRoutes *jox_routes_create(void) {
    JoxRoutes *routes = jox_alloc(1, sizeof *routes);
    routes->worker = jox_worker_create();
    return routes;
}

/* Only fields that are there or under way are counted, and none was asked for in the future. */
static const char *fault(const JoxRouteStage *w) {
    const JoxRoutes *routes = w->routes;
    uint32_t count = 0;
    for (uint32_t at = 0; at < routes->capacity * JOX_ROUTE_KINDS; at++) {
        const Route *route = &routes->items[at];
        count += routes->fields[at] || route->making;
        JOX_MUST(route->asked <= w->tick && route->asked <= route->due);
        JOX_MUST(route->walls <= routes->walls);
        JOX_MUST(route->obstacles <= routes->obstacles.version);
    }
    JOX_MUST(count == routes->count && count <= MOST_FIELDS);
    JOX_MUST(count == 0 || routes->begun);
    JOX_MUST(routes->capacity >= w->place_count);
    return NULL;
}

/* ---- making one ---- */

static void free_making(Making *making) {
    jox_routes_free_goal(making->places, making->place_count);
    jox_walls_free(&making->walls);
    jox_free(making->crowd.at);
    jox_free(making->crowd.held);
    jox_field_free(making->field);
    jox_field_marks_free(making->marks);
    jox_free(making);
}

static void make(JoxWorkItem *item) {
    Making *m = (Making *)item;
    m->field = jox_field_create(&m->walls, m->places, 0, m->low, m->high, m->cell, m->clearance,
                                &m->crowd, m->keeps_marks ? &m->marks : NULL);
}

static void make_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    Making **makings = context;
    for (uint32_t i = begin; i < end; i++)
        make(&makings[i]->item);
}

/* ---- crowds ---- */

/* How far an agent is held up on its way, in 1 / HELD. */
static uint32_t held_up(const JoxAgents *a, uint32_t i) {
    JoxV2 preferred = {a->pref_x[i], a->pref_y[i]}, velocity = {a->vx[i], a->vy[i]};
    float speed2 = jox_length2(preferred);
    if (!(speed2 > 0.0f))
        return 0;
    float share = 1.0f - jox_dot(velocity, preferred) / speed2;
    return (uint32_t)(jox_clampf(share, 0.0f, 1.0f) * (float)HELD);
}

/* Whole numbers, so that the order of the agents does not matter. */
static void count_held(const JoxRouteStage *w) {
    JoxRoutes *routes = w->routes;
    const JoxAgents *a = w->agents;
    if (routes->capacity)
        memset(routes->held, 0, routes->capacity * sizeof *routes->held);
    for (uint32_t i = 0; i < a->count; i++)
        if (a->bound[i] && a->bound[i] <= routes->capacity)
            routes->held[jox_referred(a->bound[i])] += held_up(a, i);
}

static void copy_crowd(const JoxRouteStage *w, uint32_t place, JoxFieldCrowd *crowd) {
    const JoxAgents *a = w->agents;
    crowd->slowing = (float)w->crowd_slowing;
    crowd->isa = w->isa;
    crowd->at = jox_alloc(a->count + 1, sizeof *crowd->at);
    crowd->held = jox_alloc(a->count + 1, sizeof *crowd->held);
    for (uint32_t rank = 0; rank < a->count; rank++) { /* in ascending id */
        uint32_t i = a->by_rank[rank],
                 held = jox_referred(a->bound[i]) == (int32_t)place ? held_up(a, i) : 0;
        if (held == 0)
            continue;
        crowd->at[crowd->count] = (JoxV2){a->x[i], a->y[i]};
        crowd->held[crowd->count++] = (float)held / (float)HELD;
    }
}

/* s: fields of many cells are renewed less often. */
static double crowd_pause(const JoxField *field) {
    double cells = field ? (double)jox_field_cells(field) : 0.0;
    return cells > CROWD_CELLS ? CROWD_PAUSE * cells / (double)CROWD_CELLS : CROWD_PAUSE;
}

/* Whether the field before serves for the box low..high too, and has not many more cells than one
   that is laid out for it now. */
static bool is_room(const JoxField *before, JoxV2 low, JoxV2 high, float cell) {
    JoxV2 from, to;
    float size;
    if (!before)
        return false;
    jox_field_box(before, &from, &to, &size);
    const float width = high.x - low.x + 2.0f * SPARE, height = high.y - low.y + 2.0f * SPARE;
    return size == cell && jox_is_within(low, from, to) && jox_is_within(high, from, to) &&
           (to.x - from.x) * (to.y - from.y) < MOST_ROOM * width * height;
}

/* The box about all walls, open ones too, and agents. Its corner lies on the grid of cells; where
   it can be, it is that of the field before: so those that are made anew judge narrow gaps alike,
   and what walls do to them needs no second look. */
static void lay_out(const JoxRouteStage *w, const JoxField *before, float most_cells,
                    Making *making) {
    const JoxWalls *walls = w->all_walls;
    JoxV2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < walls->count + w->agents->count; i++) {
        JoxV2 p = i < walls->count
                      ? walls->vertices[i].point
                      : (JoxV2){w->agents->x[i - walls->count], w->agents->y[i - walls->count]};
        low = (JoxV2){jox_minf(low.x, p.x), jox_minf(low.y, p.y)};
        high = (JoxV2){jox_maxf(high.x, p.x), jox_maxf(high.y, p.y)};
    }
    low = jox_sub(low, (JoxV2){MARGIN, MARGIN});
    high = jox_add(high, (JoxV2){MARGIN, MARGIN});
    const bool over_edges = jox_routes_lead_over_edges(w->agents, walls);
    if (over_edges)
        jox_routes_box_over_edges(w->agents, 0.0f, &low, &high);
    int c = 0;
    while (c < 3 && (high.x - low.x) * (high.y - low.y) > most_cells * CELLS[c] * CELLS[c])
        c++;
    float cell = CELLS[c];
    if (over_edges)
        jox_routes_box_over_edges(w->agents, cell, &low, &high);
    JOX_ASSERT(low.x < high.x && low.y < high.y); /* there are walls or agents */
    if (is_room(before, low, high, cell)) {
        jox_field_box(before, &making->low, &making->high, &making->cell);
        return;
    }
    const float spare = before ? SPARE : 0.0f;
    low = jox_sub(low, (JoxV2){spare, spare});
    high = jox_add(high, (JoxV2){spare, spare});
    if (over_edges)
        jox_routes_box_over_edges(w->agents, cell, &low, &high);
    making->cell = cell;
    making->low = (JoxV2){floorf(low.x / cell) * cell, floorf(low.y / cell) * cell};
    making->high = high;
}

/* What a field is made of: what stands where now. `before`: the field that it replaces, or NULL. */
static Making *prepare(const JoxRouteStage *w, uint32_t place, const JoxRouteFieldOptions *look,
                       float most_cells, const JoxField *before) {
    Making *making = jox_alloc(1, sizeof *making);
    making->item.run = make;
    making->clearance = look->clearance;
    jox_walls_standing(&making->walls, w->all_walls, look->gates);
    jox_obstacles_add(&w->routes->obstacles, look->bodies, &making->walls);
    making->places = jox_routes_copy_goal(w->places, place, &making->place_count);
    if (jox_routes_lead_over_edges(w->agents, w->all_walls)) {
        jox_routes_add_wall_images(w->agents, &making->walls);
        jox_routes_add_goal_images(w->agents, &making->places, &making->place_count);
    }
    lay_out(w, before, most_cells, making);
    return making;
}

void jox_routes_update_bodies(const JoxRouteStage *w) {
    jox_obstacles_update(&w->routes->obstacles, w->objects);
}

const JoxObstacles *jox_routes_obstacles(const JoxRoutes *routes) {
    return &routes->obstacles;
}

JoxField *jox_routes_make_field(const JoxRouteStage *w, uint32_t place,
                                const JoxRouteFieldOptions *look) {
    Making *making = prepare(w, place, look, MOST_CELLS, NULL);
    make(&making->item);
    JoxField *field = making->field;
    making->field = NULL;
    free_making(making);
    return field;
}

/* Begins to make a field. */
static Making *begin(const JoxRouteStage *w, uint32_t place, JoxRouteKind kind, double delay) {
    JoxRoutes *routes = w->routes;
    Route *route = &routes->items[place * JOX_ROUTE_KINDS + kind];
    JOX_ASSERT(!route->making); /* it would be lost */
    const bool open = kind == JOX_ROUTE_OPEN, crowd = kind == JOX_ROUTE_CROWD;
    const JoxRouteFieldOptions look = {!open, open ? 1u << JOX_OBSTACLE_FIXED : JOX_OBSTACLES_ALL,
                                       CLEARANCE};
    Making *making = prepare(w, place, &look, crowd ? MOST_CROWD_CELLS : MOST_CELLS,
                             routes->fields[place * JOX_ROUTE_KINDS + kind]);
    if (crowd) {
        copy_crowd(w, place, &making->crowd);
        if (jox_routes_lead_over_edges(w->agents, w->all_walls))
            jox_routes_add_crowd_images(w->agents, &making->crowd);
        making->keeps_marks = true;
        making->marks = route->marks;
    }
    *route = (Route){.making = making,
                     .asked = w->tick,
                     .due = w->tick + (uint64_t)ceil(delay / w->dt - 1e-9),
                     .walls = routes->walls,
                     .obstacles = routes->obstacles.version};
    return making;
}

/* The field that was made comes into use. */
static void take(JoxRoutes *routes, uint32_t at) {
    Making *making = routes->items[at].making;
    jox_field_free(routes->fields[at]);
    JOX_ASSERT(making->field);
    routes->fields[at] = making->field;
    routes->items[at].marks = making->marks;
    making->field = NULL;
    making->marks = NULL;
    free_making(making);
    routes->items[at].making = NULL;
}

/* ---- which ones ---- */

/* Whether routes could lead elsewhere if what can go away were not there. */
static bool is_shut(const JoxRouteStage *w) {
    for (uint32_t r = 0; r < w->all_walls->ring_count; r++)
        if (w->all_walls->rings[r].name && !w->all_walls->rings[r].open)
            return true;
    for (uint32_t o = 0; o < w->routes->obstacles.count; o++)
        if (w->routes->obstacles.items[o].kind != JOX_OBSTACLE_FIXED)
            return true;
    return false;
}

static bool is_due(const JoxRouteStage *w, uint32_t place, JoxRouteKind kind) {
    const JoxRoutes *routes = w->routes;
    uint32_t at = place * JOX_ROUTE_KINDS + kind;
    const Route *route = &routes->items[at];
    if (!(routes->wanted[place] >> kind & 1) || route->making)
        return false;
    if (kind == JOX_ROUTE_CROWD)
        return routes->held[place] >= FEW_HELD &&
               (routes->fields[at] || routes->count < MOST_FIELDS) &&
               (double)(w->tick - route->asked) * w->dt >= crowd_pause(routes->fields[at]) - 1e-9;
    if (!routes->fields[at])
        return routes->count < MOST_FIELDS && (kind == JOX_ROUTE_NOW || is_shut(w));
    if (route->walls != routes->walls)
        return true;
    return kind == JOX_ROUTE_NOW && route->obstacles != routes->obstacles.version &&
           (double)(w->tick - route->asked) * w->dt >= PAUSE - 1e-9;
}

static void make_room(const JoxRouteStage *w) {
    JoxRoutes *routes = w->routes;
    if (w->place_count > routes->capacity) {
        uint32_t had = routes->capacity, has = w->place_count;
        routes->fields = jox_realloc(routes->fields, has * JOX_ROUTE_KINDS, sizeof *routes->fields);
        routes->items = jox_realloc(routes->items, has * JOX_ROUTE_KINDS, sizeof *routes->items);
        routes->wanted = jox_realloc(routes->wanted, has, 1);
        routes->held = jox_realloc(routes->held, has, sizeof *routes->held);
        for (uint32_t at = had * JOX_ROUTE_KINDS; at < has * JOX_ROUTE_KINDS; at++) {
            routes->fields[at] = NULL;
            routes->items[at] = (Route){0};
        }
        memset(routes->wanted + had, 0, has - had);
        memset(routes->held + had, 0, (has - had) * sizeof *routes->held);
        routes->capacity = has;
    }
    w->machines->fields = routes->fields;
    w->machines->wanted = routes->wanted;
}

/* What is asked for in the first step, at once and on all threads. */
static void make_first(const JoxRouteStage *w) {
    JoxRoutes *routes = w->routes;
    for (JoxRouteKind kind = JOX_ROUTE_NOW; kind < JOX_ROUTE_KINDS; kind++) {
        Making *makings[MOST_FIELDS];
        uint32_t count = 0, at[MOST_FIELDS];
        jox_machines_ask_routes(w->machines); /* who finds no route asks for the other kind */
        for (uint32_t p = 0; p < routes->capacity; p++) {
            if (!is_due(w, p, kind))
                continue;
            JOX_ASSERT(count < MOST_FIELDS);
            at[count] = p * JOX_ROUTE_KINDS + kind;
            makings[count++] = begin(w, p, kind, 0.0);
            routes->count++;
        }
        jox_parallel_for(w->pool, count, 1, make_range, makings);
        for (uint32_t n = 0; n < count; n++)
            take(routes, at[n]);
    }
}

/* Where the crowd has gone, the way as all stands is as good. */
static void drop_idle(JoxRoutes *routes) {
    for (uint32_t p = 0; p < routes->capacity; p++) {
        uint32_t at = p * JOX_ROUTE_KINDS + JOX_ROUTE_CROWD;
        if (!routes->fields[at] || routes->items[at].making || routes->held[p] >= FEW_HELD)
            continue;
        jox_field_free(routes->fields[at]);
        jox_field_marks_free(routes->items[at].marks);
        routes->fields[at] = NULL;
        routes->items[at].marks = NULL;
        routes->count--;
    }
}

void jox_routes_update(const JoxRouteStage *w) {
    JoxRoutes *routes = w->routes;
    uint64_t every = (uint64_t)jox_maxf(1.0f, (float)floor(LOOK / w->dt + 0.5));
    make_room(w);
    if (routes->seen != w->walls_version) {
        routes->seen = w->walls_version;
        routes->walls++;
    }
    bool any = false;
    for (uint32_t p = 0; p < routes->capacity; p++)
        any |= routes->wanted[p] != 0;
    if (!routes->begun || (routes->count > 0 ? w->tick % every == 0 : any))
        jox_obstacles_update(&routes->obstacles, w->objects);
    if (!routes->begun) {
        make_first(w);
        if (routes->capacity)
            memset(routes->wanted, 0, routes->capacity);
    }
    routes->begun = true;
    for (uint32_t at = 0; at < routes->capacity * JOX_ROUTE_KINDS && routes->count > 0; at++) {
        if (!routes->items[at].making || routes->items[at].due > w->tick)
            continue;
        jox_worker_wait(routes->worker, &routes->items[at].making->item);
        take(routes, at);
    }
    bool looks = w->tick % every == 0;
    if (looks && routes->count > 0) {
        count_held(w);
        drop_idle(routes);
    }
    for (uint32_t p = 0; any && p < routes->capacity; p++) {
        for (JoxRouteKind kind = JOX_ROUTE_NOW; routes->wanted[p] && kind < JOX_ROUTE_KINDS;
             kind++) {
            if ((kind == JOX_ROUTE_CROWD && !looks) || !is_due(w, p, kind))
                continue;
            routes->count += !routes->fields[p * JOX_ROUTE_KINDS + kind];
            jox_worker_enqueue(routes->worker, &begin(w, p, kind, DELAY)->item);
        }
        routes->wanted[p] = 0;
    }
    JOX_CHECK(JOX_NO_FAULT(fault(w)));
}

void jox_routes_renew(JoxRoutes *routes) {
    routes->walls++;
}

/* ---- state ---- */

/* Fields under way are finished first: what they will be does not depend on when. */
static void finish(JoxRoutes *routes) {
    for (uint32_t at = 0; at < routes->capacity * JOX_ROUTE_KINDS; at++)
        if (routes->items[at].making)
            jox_worker_wait(routes->worker, &routes->items[at].making->item);
}

static void clear(JoxRoutes *routes) {
    for (uint32_t at = 0; at < routes->capacity * JOX_ROUTE_KINDS; at++) {
        jox_field_free(routes->fields[at]);
        routes->fields[at] = NULL;
        if (routes->items[at].making)
            free_making(routes->items[at].making);
        jox_field_marks_free(routes->items[at].marks);
        routes->items[at] = (Route){0};
    }
}

/* When a route was asked for and comes into use; the field in use, and the one that will be. */
static void list_route(JoxRoutes *routes, uint32_t at, JoxSections *s) {
    Route *route = &routes->items[at];
    bool used = jox_section_count(s, "used", routes->fields[at] != NULL, 1) > 0;
    bool made = jox_section_count(s, "made", route->making != NULL, 1) > 0;
    JOX_SECTION(s, "asked", route->asked);
    JOX_SECTION(s, "due", route->due);
    JOX_SECTION(s, "of_walls", route->walls);
    JOX_SECTION(s, "of_obstacles", route->obstacles);
    if (s->mode == JOX_SECTIONS_RESTORE && made) {
        route->making = jox_alloc(1, sizeof *route->making);
        route->making->item.done = true;
    }
    if (used)
        jox_field_sections(&routes->fields[at], s);
    if (made)
        jox_field_sections(&route->making->field, s);
}

void jox_routes_sections(const JoxRouteStage *w, JoxSections *s) {
    JoxRoutes *routes = w->routes;
    make_room(w);
    finish(routes);
    jox_sections_module(s, "routes");
    if (s->mode == JOX_SECTIONS_RESTORE)
        clear(routes);
    jox_obstacles_sections(&routes->obstacles, s);
    jox_section_model(s, "places", routes->capacity);
    JOX_SECTION(s, "walls", routes->walls);
    JOX_SECTION(s, "seen", routes->seen);
    JOX_SECTION(s, "begun", routes->begun);
    JOX_SECTION(s, "count", routes->count);
    jox_section(s, "wanted", routes->wanted, 1, routes->capacity);
    for (uint32_t at = 0; at < routes->capacity * JOX_ROUTE_KINDS; at++)
        list_route(routes, at, s);
    if (s->mode == JOX_SECTIONS_RESTORE && fault(w))
        jox_sections_fail(s, "routes", fault(w));
}

void jox_routes_free(JoxRoutes *routes) {
    if (!routes)
        return;
    jox_worker_free(routes->worker);
    clear(routes);
    jox_obstacles_free(&routes->obstacles);
    jox_free(routes->fields);
    jox_free(routes->items);
    jox_free(routes->wanted);
    jox_free(routes->held);
    jox_free(routes);
}
