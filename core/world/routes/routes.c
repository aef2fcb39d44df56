#include "world/routes/routes.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "machine/lifts.h"
#include "task/worker.h"
#include "world/routes/body_obstacles.h"
#include "world/routes/held_up.h"
#include "world/routes/joined_edges.h"
#include "world/routes/route_making.h"

enum { MOST_FIELDS = 512, FEW_HELD = 5 * JOX_HELD }; /* fewer agents held up are no crowd */
/* Fields round crowds are made anew every CROWD_PAUSE. */
static const float MOST_CROWD_CELLS = 100000.0f;
static const float CLEARANCE = 0.15f;  /* m: half the width of a person turned sideways */
static const double DELAY = 0.5;       /* s: from the request of a field to its use */
static const double PAUSE = 2.0;       /* s: between fields made anew for moving bodies */
static const double LOOK = 0.25;       /* s: interval at which bodies and crowds are examined */
static const double CROWD_PAUSE = 1.0; /* s: between fields made anew for a crowd */
static const float CROWD_CELLS = 150000.0f; /* cells; larger fields wait longer in proportion */

typedef struct Route {
    JoxRouteMaking *making;    /* or NULL */
    uint64_t asked, due;       /* ticks: of the last request, and of the first use of its field */
    uint32_t walls, obstacles; /* versions that the field was made of */
    JoxFieldMarks *marks;      /* fields round crowds: marks of walls, kept from field to field */
} Route;

struct JoxRoutes {
    JoxWorker *worker;
    JoxObstacles obstacles;
    uint32_t walls;    /* version of walls */
    uint32_t lifts;    /* how often a lift came into another use */
    uint32_t seen;     /* world->state.walls_version */
    bool begun, full;  /* full: it was told that some places get no field */
    uint32_t capacity; /* places */
    /* By place and kind, as machines read them: [place * JOX_ROUTE_KINDS + kind]. */
    JoxField **fields;
    Route *items;
    uint8_t *wanted; /* by place: a bit for each kind that agents asked for */
    uint32_t *held;  /* by place: agents held up on the way there, in 1 / JOX_HELD; scratch */
    uint32_t count;  /* fields in use or being made */
};

JoxRoutes *jox_routes_create(void) {
    JoxRoutes *routes = jox_alloc(1, sizeof *routes);
    routes->worker = jox_worker_create();
    return routes;
}

static bool is_by_lifts(JoxRouteKind kind) {
    return kind == JOX_ROUTE_LIFTS || kind == JOX_ROUTE_STEPLESS_LIFTS;
}

/* Returns the version of walls, and of lifts if they count, that fields of a kind are made of. */
static uint32_t get_version(const JoxRoutes *routes, JoxRouteKind kind) {
    return routes->walls + (is_by_lifts(kind) ? routes->lifts : 0);
}

/* Returns the first invariant that does not hold, or NULL. */
static const char *find_fault(const JoxRouteStage *w) {
    const JoxRoutes *routes = w->routes;
    uint32_t count = 0;
    for (uint32_t at = 0; at < routes->capacity * JOX_ROUTE_KINDS; at++) {
        const Route *route = &routes->items[at];
        count += routes->fields[at] || route->making;
        JOX_MUST(route->asked <= w->tick && route->asked <= route->due);
        JOX_MUST(route->walls <= get_version(routes, at % JOX_ROUTE_KINDS));
        JOX_MUST(route->obstacles <= routes->obstacles.version);
    }
    JOX_MUST(count == routes->count && count <= MOST_FIELDS);
    JOX_MUST(count == 0 || routes->begun);
    JOX_MUST(routes->capacity >= w->place_count);
    return NULL;
}

/* ---- making one ---- */

static void make_fields(void *context, uint32_t begin_route, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxRouteMaking **makings = context;
    for (uint32_t i = begin_route; i < end; i++)
        jox_route_making_run(&makings[i]->item);
}

/* Returns the time between fields round a crowd, s: longer for many cells. */
static double get_crowd_pause(const JoxField *field) {
    double cells = field ? (double)jox_field_cells(field) : 0.0;
    return cells > CROWD_CELLS ? CROWD_PAUSE * cells / (double)CROWD_CELLS : CROWD_PAUSE;
}

void jox_routes_update_bodies(const JoxRouteStage *w) {
    jox_obstacles_update(&w->routes->obstacles, w->objects);
}

const JoxObstacles *jox_routes_obstacles(const JoxRoutes *routes) {
    return &routes->obstacles;
}

JoxField *jox_routes_make_field(const JoxRouteStage *w, uint32_t place,
                                const JoxRouteFieldOptions *look) {
    JoxRouteMaking *making =
        jox_route_making_prepare(w, &w->routes->obstacles, place, look, JOX_ROUTE_CELLS, NULL);
    jox_route_making_run(&making->item);
    JoxField *field = making->field;
    making->field = NULL;
    jox_route_making_free(making);
    return field;
}

/* Prepares the field of a route, to be used after `delay` s. */
static JoxRouteMaking *begin_route(const JoxRouteStage *w, uint32_t place, JoxRouteKind kind,
                                   double delay) {
    JoxRoutes *routes = w->routes;
    Route *route = &routes->items[place * JOX_ROUTE_KINDS + kind];
    JOX_ASSERT(!route->making); /* a running one would be lost */
    const bool open = kind == JOX_ROUTE_OPEN, crowd = kind == JOX_ROUTE_CROWD;
    const JoxRouteFieldOptions look = {
        .gates = !open,
        .bodies = open ? 1u << JOX_OBSTACLE_FIXED : JOX_OBSTACLES_ALL,
        .clearance = CLEARANCE,
        .stepless = kind == JOX_ROUTE_STEPLESS || kind == JOX_ROUTE_STEPLESS_LIFTS,
        .lifts = is_by_lifts(kind)};
    JoxRouteMaking *making = jox_route_making_prepare(
        w, &w->routes->obstacles, place, &look, crowd ? MOST_CROWD_CELLS : JOX_ROUTE_CELLS,
        routes->fields[place * JOX_ROUTE_KINDS + kind]);
    if (crowd) {
        making->crowd = jox_held_up_list(w->agents, place, (float)w->crowd_slowing, w->isa);
        if (jox_routes_lead_over_edges(w->agents, w->all_walls))
            jox_routes_add_crowd_images(w->agents, &making->crowd);
        making->keeps_marks = true;
        making->marks = route->marks;
    }
    *route = (Route){.making = making,
                     .asked = w->tick,
                     .due = w->tick + (uint64_t)ceil(delay / w->dt - 1e-9),
                     .walls = get_version(routes, kind),
                     .obstacles = routes->obstacles.version};
    return making;
}

/* Puts a finished field into use. */
static void take_field(JoxRoutes *routes, uint32_t at) {
    JoxRouteMaking *making = routes->items[at].making;
    jox_field_free(routes->fields[at]);
    JOX_ASSERT(making->field);
    routes->fields[at] = making->field;
    routes->items[at].marks = making->marks;
    making->field = NULL;
    making->marks = NULL;
    jox_route_making_free(making);
    routes->items[at].making = NULL;
}

/* ---- which ones ---- */

/* Returns whether a closed gate or a movable body may block ways. */
static bool can_be_blocked(const JoxRouteStage *w) {
    bool can = jox_obstacles_may_move(&w->routes->obstacles);
    for (uint32_t r = 0; !can && r < w->all_walls->ring_count; r++)
        can = jox_wall_is_shut_gate(w->all_walls, r);
    return can;
}

/* Tells, once, that a place gets no field. */
static void tell_full(const JoxRouteStage *w, uint32_t place) {
    if (!w->routes->full)
        jox_text_printf(&w->machines->notes,
                        "t = %.2f s: ways lead to %d places at most; people find none to '%s'\n",
                        (double)w->tick * w->dt, MOST_FIELDS, w->places[place].name);
    w->routes->full = true;
}

static bool is_due(const JoxRouteStage *w, uint32_t place, JoxRouteKind kind) {
    const JoxRoutes *routes = w->routes;
    const uint32_t at = place * JOX_ROUTE_KINDS + kind;
    const Route *route = &routes->items[at];
    const bool has = routes->fields[at], room = has || routes->count < MOST_FIELDS;
    if (!(routes->wanted[place] >> kind & 1) || route->making)
        return false;
    const double since = (double)(w->tick - route->asked) * w->dt;
    if (kind == JOX_ROUTE_CROWD)
        return routes->held[place] >= FEW_HELD && room &&
               since >= get_crowd_pause(routes->fields[at]) - 1e-9;
    if (!has && kind == JOX_ROUTE_OPEN && !can_be_blocked(w))
        return false;
    if (!room)
        tell_full(w, place);
    if (!has || route->walls != get_version(routes, kind))
        return room;
    return kind != JOX_ROUTE_OPEN && route->obstacles != routes->obstacles.version &&
           since >= PAUSE - 1e-9;
}

static void reserve_places(const JoxRouteStage *w) {
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

/* Makes the fields asked for in the first step at once, on all threads. */
static void make_first(const JoxRouteStage *w) {
    JoxRoutes *routes = w->routes;
    for (JoxRouteKind kind = JOX_ROUTE_NOW; kind < JOX_ROUTE_KINDS; kind++) {
        JoxRouteMaking *makings[MOST_FIELDS];
        uint32_t count = 0, at[MOST_FIELDS];
        jox_machines_ask_routes(w->machines); /* agents without a route ask for the other kind */
        for (uint32_t p = 0; p < routes->capacity; p++) {
            if (!is_due(w, p, kind))
                continue;
            JOX_ASSERT(count < MOST_FIELDS);
            at[count] = p * JOX_ROUTE_KINDS + kind;
            makings[count++] = begin_route(w, p, kind, 0.0);
            routes->count++;
        }
        jox_parallel_for(w->pool, count, 1, make_fields, makings);
        for (uint32_t n = 0; n < count; n++)
            take_field(routes, at[n]);
    }
}

/* Frees fields round crowds that are gone. */
static void free_crowd_fields(JoxRoutes *routes) {
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
    reserve_places(w);
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
        take_field(routes, at);
    }
    bool looks = w->tick % every == 0;
    if (looks && routes->count > 0) {
        jox_held_up_sum(w->agents, routes->held, routes->capacity);
        free_crowd_fields(routes);
    }
    for (uint32_t p = 0; any && p < routes->capacity; p++) {
        for (JoxRouteKind kind = JOX_ROUTE_NOW; routes->wanted[p] && kind < JOX_ROUTE_KINDS;
             kind++) {
            if ((kind == JOX_ROUTE_CROWD && !looks) || !is_due(w, p, kind))
                continue;
            routes->count += !routes->fields[p * JOX_ROUTE_KINDS + kind];
            jox_worker_enqueue(routes->worker, &begin_route(w, p, kind, DELAY)->item);
        }
        routes->wanted[p] = 0;
    }
    JOX_CHECK(JOX_NO_FAULT(find_fault(w)));
}

void jox_routes_note_lifts(JoxRoutes *routes) {
    routes->lifts++;
}

void jox_routes_renew(JoxRoutes *routes) {
    routes->walls++;
}

/* ---- state ---- */

/* Waits for fields being made; their result does not depend on when they are made. */
static void wait_for_fields(JoxRoutes *routes) {
    for (uint32_t at = 0; at < routes->capacity * JOX_ROUTE_KINDS; at++)
        if (routes->items[at].making)
            jox_worker_wait(routes->worker, &routes->items[at].making->item);
}

static void clear_routes(JoxRoutes *routes) {
    for (uint32_t at = 0; at < routes->capacity * JOX_ROUTE_KINDS; at++) {
        jox_field_free(routes->fields[at]);
        routes->fields[at] = NULL;
        if (routes->items[at].making)
            jox_route_making_free(routes->items[at].making);
        jox_field_marks_free(routes->items[at].marks);
        routes->items[at] = (Route){0};
    }
}

/* Lists a route: its times and versions, the field in use, and the one being made. */
static void list_route(JoxRoutes *routes, const JoxStoreys *storeys, uint32_t at, JoxSections *s) {
    Route *route = &routes->items[at];
    const bool by_lifts = is_by_lifts(at % JOX_ROUTE_KINDS);
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
        jox_field_sections(&routes->fields[at], by_lifts, s);
    if (made)
        jox_field_sections(&route->making->field, by_lifts, s);
    if (s->mode == JOX_SECTIONS_RESTORE && !s->failed) {
        jox_field_set_storeys(routes->fields[at], storeys);
        jox_field_set_storeys(made ? route->making->field : NULL, storeys);
        if (made)
            route->making->storeys = storeys;
    }
}

/* Returns whether a world has fields of a kind. */
static bool has_kind(const JoxRouteStage *w, JoxRouteKind kind) {
    return is_by_lifts(kind) ? w->machines->lifts != NULL
                             : kind != JOX_ROUTE_STEPLESS || w->agents->storeys;
}

void jox_routes_sections(const JoxRouteStage *w, JoxSections *s) {
    JoxRoutes *routes = w->routes;
    reserve_places(w);
    wait_for_fields(routes);
    jox_sections_module(s, "routes");
    if (s->mode == JOX_SECTIONS_RESTORE)
        clear_routes(routes);
    jox_obstacles_sections(&routes->obstacles, s);
    jox_section_model(s, "places", routes->capacity);
    JOX_SECTION(s, "walls", routes->walls);
    JOX_SECTION(s, "seen", routes->seen);
    JOX_SECTION(s, "begun", routes->begun);
    JOX_SECTION(s, "count", routes->count);
    jox_section(s, "wanted", routes->wanted, 1, routes->capacity);
    if (w->machines->lifts)
        JOX_SECTION(s, "lifts", routes->lifts);
    for (uint32_t at = 0; at < routes->capacity * JOX_ROUTE_KINDS; at++)
        if (has_kind(w, at % JOX_ROUTE_KINDS))
            list_route(routes, w->agents->storeys, at, s);
    if (s->mode == JOX_SECTIONS_RESTORE && find_fault(w))
        jox_sections_fail(s, "routes", find_fault(w));
}

void jox_routes_free(JoxRoutes *routes) {
    if (!routes)
        return;
    jox_worker_free(routes->worker);
    clear_routes(routes);
    jox_obstacles_free(&routes->obstacles);
    jox_free(routes->fields);
    jox_free(routes->items);
    jox_free(routes->wanted);
    jox_free(routes->held);
    jox_free(routes);
}
