#include "world/ways.h"

#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "task/worker.h"
#include "world/obstacles.h"
#include "world/world.h"

enum { MOST_FIELDS = 64 };
/* m: the smallest that gives few enough cells to be done within DELAY; the largest still shows
   doors of half a metre. */
static const float CELLS[] = {0.125f, 0.18f, 0.25f, 0.3f};
static const float MOST_CELLS = 400000.0f;
static const float CLEARANCE = 0.15f; /* m: half of a person who turns sideways */
static const float MARGIN = 3.0f;     /* m about all walls and agents */
static const double DELAY = 0.5;      /* s from asking to use */
static const double PAUSE = 2.0;      /* s between renewals for bodies that move */
static const double LOOK = 0.25;      /* s between looks at bodies */

/* One field to be made, with copies of all that it is made of. */
typedef struct Making {
    JoxWorkItem item; /* first */
    JoxWalls walls;
    JoxPlace *places; /* the place, and behind it its members */
    uint32_t place_count;
    JoxV2 low, high;
    float cell; /* m */
    JoxField *field;
} Making;

typedef struct Way {
    Making *making;            /* or NULL */
    uint64_t asked, due;       /* ticks: when the last making began, when its field is used */
    uint32_t walls, obstacles; /* versions of what it was made of */
} Way;

struct JoxWays {
    JoxWorker *worker;
    JoxObstacles obstacles;
    uint32_t walls; /* version, as a Way's */
    uint32_t seen;  /* world->walls_version */
    bool begun;
    uint32_t capacity; /* places */
    /* By place and kind of field, as the mind sees them: [place * JOX_WAY_KINDS + kind]. */
    JoxField **fields;
    Way *items;
    uint8_t *wanted; /* by place */
    uint32_t count;  /* fields that are there or under way */
};

JoxWays *jox_ways_create(void) {
    JoxWays *ways = jox_alloc(1, sizeof *ways);
    ways->worker = jox_worker_create();
    return ways;
}

/* ---- making one ---- */

static void free_making(Making *making) {
    for (uint32_t p = 0; p < making->place_count; p++) {
        jox_free(making->places[p].points);
        jox_free(making->places[p].members);
    }
    jox_free(making->places);
    jox_walls_free(&making->walls);
    jox_field_free(making->field);
    jox_free(making);
}

static void make(JoxWorkItem *item) {
    Making *m = (Making *)item;
    m->field = jox_field_create(&m->walls, m->places, 0, m->low, m->high, m->cell, CLEARANCE);
}

static void make_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    Making **makings = context;
    for (uint32_t i = begin; i < end; i++)
        make(&makings[i]->item);
}

static void copy_place(JoxPlace *to, const JoxPlace *from) {
    *to = *from;
    to->name = NULL;
    to->points = jox_alloc(from->count + 1, sizeof *to->points);
    to->members = jox_alloc(from->member_count + 1, sizeof *to->members);
    if (from->count)
        memcpy(to->points, from->points, from->count * sizeof *to->points);
}

static void copy_places(const JoWorld *w, uint32_t place, Making *making) {
    const JoxPlace *from = &w->places[place];
    making->place_count = 1 + from->member_count;
    making->places = jox_alloc(making->place_count, sizeof *making->places);
    copy_place(&making->places[0], from);
    for (uint32_t m = 0; m < from->member_count; m++) {
        copy_place(&making->places[m + 1], &w->places[from->members[m]]);
        making->places[0].members[m] = (int32_t)m + 1;
    }
}

/* The box about all walls, open ones too, and agents. Its corner lies on the grid of cells, so that
   fields that are made anew judge narrow gaps alike. */
static void lay_out(const JoWorld *w, Making *making) {
    const JoxWalls *walls = &w->all_walls;
    JoxV2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < walls->count + w->agents.count; i++) {
        JoxV2 p = i < walls->count
                      ? walls->vertices[i].point
                      : (JoxV2){w->agents.x[i - walls->count], w->agents.y[i - walls->count]};
        low = (JoxV2){jox_minf(low.x, p.x), jox_minf(low.y, p.y)};
        high = (JoxV2){jox_maxf(high.x, p.x), jox_maxf(high.y, p.y)};
    }
    low = jox_sub(low, (JoxV2){MARGIN, MARGIN});
    high = jox_add(high, (JoxV2){MARGIN, MARGIN});
    int c = 0;
    while (c < 3 && (high.x - low.x) * (high.y - low.y) > MOST_CELLS * CELLS[c] * CELLS[c])
        c++;
    float cell = CELLS[c];
    making->cell = cell;
    making->low = (JoxV2){floorf(low.x / cell) * cell, floorf(low.y / cell) * cell};
    making->high = high;
}

/* Begins to make a field from what stands where now. */
static Making *begin(JoWorld *w, uint32_t place, JoxWayKind kind, double delay) {
    JoxWays *ways = w->ways;
    Way *way = &ways->items[place * JOX_WAY_KINDS + kind];
    Making *making = jox_alloc(1, sizeof *making);
    making->item.run = make;
    jox_walls_standing(&making->walls, &w->all_walls, kind == JOX_WAY_NOW);
    jox_obstacles_add(&ways->obstacles, kind == JOX_WAY_NOW, &making->walls);
    copy_places(w, place, making);
    lay_out(w, making);
    *way = (Way){.making = making,
                 .asked = w->tick,
                 .due = w->tick + (uint64_t)ceil(delay / w->def.dt - 1e-9),
                 .walls = ways->walls,
                 .obstacles = ways->obstacles.version};
    return making;
}

/* The field that was made comes into use. */
static void take(JoxWays *ways, uint32_t at) {
    Making *making = ways->items[at].making;
    jox_field_free(ways->fields[at]);
    ways->fields[at] = making->field;
    making->field = NULL;
    free_making(making);
    ways->items[at].making = NULL;
}

/* ---- which ones ---- */

/* Whether ways could lead elsewhere if what can go away were not there. */
static bool is_shut(const JoWorld *w) {
    for (uint32_t r = 0; r < w->all_walls.ring_count; r++)
        if (w->all_walls.rings[r].name && !w->all_walls.rings[r].open)
            return true;
    for (uint32_t o = 0; o < w->ways->obstacles.count; o++)
        if (w->ways->obstacles.items[o].movable)
            return true;
    return false;
}

static bool is_due(const JoWorld *w, uint32_t place, JoxWayKind kind) {
    const JoxWays *ways = w->ways;
    uint32_t at = place * JOX_WAY_KINDS + kind;
    const Way *way = &ways->items[at];
    if (!(ways->wanted[place] >> kind & 1) || way->making)
        return false;
    if (!ways->fields[at])
        return ways->count < MOST_FIELDS && (kind == JOX_WAY_NOW || is_shut(w));
    if (way->walls != ways->walls)
        return true;
    return kind == JOX_WAY_NOW && way->obstacles != ways->obstacles.version &&
           (double)(w->tick - way->asked) * w->def.dt >= PAUSE - 1e-9;
}

static void make_room(JoWorld *w) {
    JoxWays *ways = w->ways;
    if (w->place_count > ways->capacity) {
        uint32_t had = ways->capacity, has = w->place_count;
        ways->fields = jox_realloc(ways->fields, has * JOX_WAY_KINDS, sizeof *ways->fields);
        ways->items = jox_realloc(ways->items, has * JOX_WAY_KINDS, sizeof *ways->items);
        ways->wanted = jox_realloc(ways->wanted, has, 1);
        for (uint32_t at = had * JOX_WAY_KINDS; at < has * JOX_WAY_KINDS; at++) {
            ways->fields[at] = NULL;
            ways->items[at] = (Way){0};
        }
        memset(ways->wanted + had, 0, has - had);
        ways->capacity = has;
    }
    w->mind.fields = ways->fields;
    w->mind.wanted = ways->wanted;
}

/* What is asked for in the first step, at once and on all threads. */
static void make_first(JoWorld *w) {
    JoxWays *ways = w->ways;
    for (JoxWayKind kind = JOX_WAY_NOW; kind < JOX_WAY_KINDS; kind++) {
        Making *makings[MOST_FIELDS];
        uint32_t count = 0, at[MOST_FIELDS];
        jox_mind_ask_ways(&w->mind); /* who finds no way asks for the other kind */
        for (uint32_t p = 0; p < ways->capacity; p++) {
            if (!is_due(w, p, kind))
                continue;
            at[count] = p * JOX_WAY_KINDS + kind;
            makings[count++] = begin(w, p, kind, 0.0);
            ways->count++;
        }
        jox_parallel_for(w->pool, count, 1, make_range, makings);
        for (uint32_t n = 0; n < count; n++)
            take(ways, at[n]);
    }
}

void jox_world_ways(JoWorld *w) {
    JoxWays *ways = w->ways;
    uint64_t every = (uint64_t)jox_maxf(1.0f, (float)floor(LOOK / w->def.dt + 0.5));
    make_room(w);
    if (ways->seen != w->walls_version) {
        ways->seen = w->walls_version;
        ways->walls++;
    }
    bool any = false;
    for (uint32_t p = 0; p < ways->capacity; p++)
        any |= ways->wanted[p] != 0;
    if (!ways->begun || (ways->count > 0 ? w->tick % every == 0 : any))
        jox_obstacles_update(&ways->obstacles, &w->objects);
    if (!ways->begun) {
        make_first(w);
        if (ways->capacity)
            memset(ways->wanted, 0, ways->capacity);
    }
    ways->begun = true;
    for (uint32_t at = 0; at < ways->capacity * JOX_WAY_KINDS && ways->count > 0; at++) {
        if (!ways->items[at].making || ways->items[at].due > w->tick)
            continue;
        jox_worker_wait(ways->worker, &ways->items[at].making->item);
        take(ways, at);
    }
    for (uint32_t p = 0; any && p < ways->capacity; p++) {
        for (JoxWayKind kind = JOX_WAY_NOW; ways->wanted[p] && kind < JOX_WAY_KINDS; kind++) {
            if (!is_due(w, p, kind))
                continue;
            ways->count += !ways->fields[p * JOX_WAY_KINDS + kind];
            jox_worker_give(ways->worker, &begin(w, p, kind, DELAY)->item);
        }
        ways->wanted[p] = 0;
    }
}

void jox_world_renew_ways(JoWorld *w) {
    w->ways->walls++;
}

void jox_ways_free(JoxWays *ways) {
    if (!ways)
        return;
    jox_worker_free(ways->worker);
    for (uint32_t at = 0; at < ways->capacity * JOX_WAY_KINDS; at++) {
        jox_field_free(ways->fields[at]);
        if (ways->items[at].making)
            free_making(ways->items[at].making);
    }
    jox_obstacles_free(&ways->obstacles);
    jox_free(ways->fields);
    jox_free(ways->items);
    jox_free(ways->wanted);
    jox_free(ways);
}
