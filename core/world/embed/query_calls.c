/* Public calls of jostle_read.h that ask what is where: each examines all agents, bodies or edges.
 */
#include <math.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "geom/wall_grid.h"
#include "geom/wall_images.h"
#include "world/world.h"

/* ---- neighbours and density of a point ---- */

/* Inserts an agent among the nearest so far, of which `room` are kept. */
static void insert_nearest(uint32_t *ids, float *distances, uint32_t *kept, uint32_t room,
                           uint32_t id, float distance) {
    uint32_t at = *kept;
    while (at > 0 &&
           (distance < distances[at - 1] || (distance == distances[at - 1] && id < ids[at - 1])))
        at--;
    if (at == room)
        return;
    if (*kept < room)
        ++*kept;
    for (uint32_t k = *kept - 1; k > at; k--) {
        ids[k] = ids[k - 1];
        distances[k] = distances[k - 1];
    }
    ids[at] = id;
    distances[at] = distance;
}

/* Finds the way from a point to an agent, m, over the shorter way where edges are joined and over
   seams where there are storeys; false if the agent is on another storey, out of sight. */
static bool find_way(const JoWorld *world, JoxV2 from, uint32_t i, JoxV2 *way) {
    const JoxAgents *a = &world->state.agents;
    const JoxV2 at = {a->x[i], a->y[i]};
    if (a->storeys)
        return jox_plan_offset(a->storeys, from, at, way);
    *way = jox_wrap(a, jox_sub(at, from));
    return true;
}

uint32_t jo_world_neighbours(const JoWorld *world, double x, double y, double radius, uint32_t *ids,
                             float *distances, uint32_t capacity) {
    enum { MOST = 1024 };
    JOX_REQUIRE(world && isfinite(x) && isfinite(y) && radius >= 0.0, 0);
    const JoxAgents *a = &world->state.agents;
    uint32_t nearest[MOST], kept = 0, found = 0;
    float away[MOST];
    const uint32_t room = capacity < MOST ? capacity : MOST;
    if (jox_heap_has_failed(world->heap))
        return 0;
    for (uint32_t i = 0; i < a->count; i++) {
        JoxV2 d;
        if (!find_way(world, (JoxV2){(float)x, (float)y}, i, &d))
            continue;
        const float distance = jox_length(d);
        if (!((double)distance <= radius))
            continue;
        found++;
        insert_nearest(nearest, away, &kept, room, a->id[i], distance);
    }
    for (uint32_t k = 0; k < kept; k++) {
        if (ids)
            ids[k] = nearest[k];
        if (distances)
            distances[k] = away[k];
    }
    return found;
}

/* Shift of the images of walls beyond joined edges, in periods. */
typedef struct Turns {
    int x, y, most_x, most_y;
} Turns;

static Turns first_turns(const JoWorld *world) {
    const JoxV2 period = world->state.agents.period;
    const int x = jox_wall_images_turns(period.x), y = jox_wall_images_turns(period.y);
    return (Turns){-x, -y, x, y};
}

/* Advances to the next shift; false after the last. */
static bool next_turns(Turns *t) {
    if (t->x++ < t->most_x)
        return true;
    t->x = -t->most_x;
    return t->y++ < t->most_y;
}

/* m */
static JoxV2 shift_of_turns(const JoWorld *world, const Turns *t) {
    const JoxV2 period = world->state.agents.period;
    return (JoxV2){(float)t->x * period.x, (float)t->y * period.y};
}

/* Returns whether a standing wall lies between two points. */
static bool is_walled_off(const JoWorld *world, JoxV2 from, JoxV2 to) {
    const JoxWalls *walls = &world->model.all_walls;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t k = 0; !ring->open && k < ring->count; k++) {
            const JoxWallVertex *v = &walls->vertices[ring->first + k];
            if (jox_segments_cross(from, to, v->point, walls->vertices[v->next].point))
                return true;
        }
    }
    return false;
}

/* Returns whether a standing wall or an image of one lies between two points. */
static bool is_behind_wall(const JoWorld *world, JoxV2 from, JoxV2 to) {
    Turns turns = first_turns(world);
    do {
        const JoxV2 shift = shift_of_turns(world, &turns);
        if (is_walled_off(world, jox_sub(from, shift), jox_sub(to, shift)))
            return true;
    } while (next_turns(&turns));
    return false;
}

double jo_world_density(const JoWorld *world, double x, double y) {
    JOX_REQUIRE(world && isfinite(x) && isfinite(y), 0.0);
    const JoxAgents *a = &world->state.agents;
    double sum = 0.0;
    if (jox_heap_has_failed(world->heap))
        return 0.0;
    for (uint32_t r = 0; r < a->count; r++) { /* in ascending id: the sum has one order */
        const uint32_t i = a->by_rank[r];
        const JoxV2 from = {(float)x, (float)y}, at = {a->x[i], a->y[i]};
        JoxV2 d;
        if (!find_way(world, from, i, &d))
            continue;
        const double d2 = (double)jox_length2(d);
        if (d2 > 16.0) /* m2: the kernel is below 1e-7 there */
            continue;
        const JoxV2 to = jox_add(from, d);
        if (a->storeys && is_walled_off(world, jox_sub(at, d), at))
            continue; /* a wall beyond the seam */
        sum += is_behind_wall(world, from, to) ? 0.0 : jox_exp(-d2) / JOX_PI;
    }
    return sum;
}

/* ---- casts of a disc ---- */

/* The way of a disc's centre, and the first hit on it. */
typedef struct Sweep {
    JoxV2 from, way; /* m */
    float radius;    /* m */
    JoCast first;
} Sweep;

static void note_hit(Sweep *s, float share, JoTouched kind, uint32_t what, JoxV2 normal) {
    const double at = (double)share;
    if (s->first.hit &&
        (at > s->first.share ||
         (at == s->first.share &&
          (kind > s->first.kind || (kind == s->first.kind && what > s->first.what)))))
        return;
    s->first = (JoCast){.hit = true,
                        .kind = kind,
                        .what = what,
                        .share = at,
                        .nx = (double)normal.x,
                        .ny = (double)normal.y};
}

/* Finds the share of the way after which the centre is within `reach` of a point; false: never. */
static bool reaches_point(const Sweep *s, JoxV2 point, float reach, float *share) {
    const JoxV2 d = jox_sub(s->from, point);
    const float a = jox_length2(s->way), b = jox_dot(d, s->way), c = jox_length2(d) - reach * reach;
    *share = 0.0f;
    if (c <= 0.0f)
        return true;
    const float root = b * b - a * c;
    if (!(b < 0.0f) || root < 0.0f)
        return false;
    *share = (-b - sqrtf(root)) / a;
    return *share <= 1.0f;
}

static void test_disc(Sweep *s, JoxV2 centre, float reach, JoTouched kind, uint32_t what) {
    float share;
    if (reaches_point(s, centre, reach, &share))
        note_hit(s, share, kind, what,
                 jox_unit(jox_sub(jox_add(s->from, jox_scale(s->way, share)), centre)));
}

/* Tests a segment from both sides, and its ends. */
static void test_segment(Sweep *s, JoxV2 a, JoxV2 b, JoTouched kind, uint32_t what) {
    const JoxV2 along = jox_unit(jox_sub(b, a));
    const float length = jox_length(jox_sub(b, a));
    JoxV2 normal = {-along.y, along.x};
    float height = jox_dot(jox_sub(s->from, a), normal), speed = jox_dot(s->way, normal);
    if (height < 0.0f) { /* seen from its other side */
        normal = jox_scale(normal, -1.0f);
        height = -height;
        speed = -speed;
    }
    float share = 0.0f;
    bool beside = height <= s->radius;
    if (!beside && speed < 0.0f) {
        share = (s->radius - height) / speed;
        beside = share <= 1.0f;
    }
    if (beside) {
        const JoxV2 at = jox_add(s->from, jox_scale(s->way, share));
        const float place = jox_dot(jox_sub(at, a), along);
        if (place >= 0.0f && place <= length) {
            note_hit(s, share, kind, what, normal);
            return;
        }
    }
    test_disc(s, a, s->radius, kind, what);
    test_disc(s, b, s->radius, kind, what);
}

static void test_bodies(const JoWorld *world, Sweep *s) {
    const JoxObjects *objects = &world->scratch.objects;
    for (uint32_t row = 0; row < objects->count; row++) {
        const JoxObject *body = &objects->rows[row];
        if (!body->live || !body->in_band || body->held)
            continue;
        const JoxV2 centre = {body->position.x, body->position.y};
        if (!body->footprint_count) {
            test_disc(s, centre, s->radius + body->round, JO_TOUCHED_BODY, row);
            continue;
        }
        const JoxFootprintPoint near = jox_footprint_nearest(body, s->from);
        if (near.gap <= s->radius)
            note_hit(s, 0.0f, JO_TOUCHED_BODY, row, near.normal);
        for (uint32_t k = 0; k < body->footprint_count; k++)
            test_segment(s, body->footprint[k], body->footprint[(k + 1) % body->footprint_count],
                         JO_TOUCHED_BODY, row);
    }
}

/* Meets the standing walls, moved by `shift` m. */
static void test_walls_at(const JoWorld *world, Sweep *s, JoxV2 shift) {
    const JoxWalls *walls = &world->model.all_walls;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t k = 0; !ring->open && k < ring->count; k++) {
            const JoxWallVertex *v = &walls->vertices[ring->first + k];
            test_segment(s, jox_add(v->point, shift),
                         jox_add(walls->vertices[v->next].point, shift), JO_TOUCHED_WALL,
                         ring->first + k);
        }
    }
}

static void test_walls(const JoWorld *world, Sweep *s) {
    Turns turns = first_turns(world);
    do
        test_walls_at(world, s, shift_of_turns(world, &turns));
    while (next_turns(&turns));
}

JoCast jo_world_cast(const JoWorld *world, const double from[2], const double to[2], double radius,
                     uint32_t kinds) {
    JOX_REQUIRE(world && from && to && radius >= 0.0 && radius <= 100.0, (JoCast){0});
    JOX_REQUIRE((kinds & ~(uint32_t)JO_CAST_ALL) == 0, (JoCast){0});
    for (int k = 0; k < 2; k++)
        JOX_REQUIRE(fabs(from[k]) <= 1e4 && fabs(to[k]) <= 1e4, (JoCast){0});
    const JoxAgents *a = &world->state.agents;
    Sweep s = {.from = {(float)from[0], (float)from[1]}, .radius = (float)radius};
    s.way = jox_sub((JoxV2){(float)to[0], (float)to[1]}, s.from);
    if (jox_heap_has_failed(world->heap))
        return (JoCast){0};
    for (uint32_t i = 0; kinds & JO_CAST_AGENTS && i < a->count; i++) {
        JoxV2 way;
        if (!find_way(world, s.from, i, &way))
            continue;
        const JoxV2 at = jox_add(s.from, way);
        test_disc(&s, at, s.radius + jox_param(a, JOX_PARAM_radius, i), JO_TOUCHED_AGENT, a->id[i]);
    }
    if (kinds & JO_CAST_BODIES)
        test_bodies(world, &s);
    if (kinds & JO_CAST_WALLS)
        test_walls(world, &s);
    if (!s.first.hit)
        s.first.share = 1.0;
    s.first.x = from[0] + s.first.share * (to[0] - from[0]);
    s.first.y = from[1] + s.first.share * (to[1] - from[1]);
    return s.first;
}

/* ---- walls and bodies ---- */

uint32_t jo_world_walls(const JoWorld *world, double *out, uint32_t capacity) {
    JOX_REQUIRE(world && (out || capacity == 0), 0);
    const JoxWalls *walls = &world->model.all_walls;
    uint32_t n = 0;
    if (jox_heap_has_failed(world->heap))
        return 0;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t k = 0; !ring->open && k < ring->count; k++, n++) {
            const JoxWallVertex *v = &walls->vertices[ring->first + k];
            const JoxV2 to = walls->vertices[v->next].point;
            const double edge[4] = {(double)v->point.x, (double)v->point.y, (double)to.x,
                                    (double)to.y};
            for (int c = 0; n < capacity && c < 4; c++)
                out[4 * (size_t)n + (size_t)c] = edge[c];
        }
    }
    return n;
}

uint32_t jo_body_outline(const JoWorld *world, JoBody body, double *xy, uint32_t capacity) {
    enum { ROUND = 24 };
    JOX_REQUIRE(world && (xy || capacity == 0), 0);
    const uint32_t row = jox_world_find_body(world, body);
    const JoxObjects *objects = &world->scratch.objects;
    if (row == JOX_NO_BODY || row >= objects->count || !objects->rows[row].in_band)
        return 0;
    const JoxObject *object = &objects->rows[row];
    const uint32_t count = object->footprint_count ? object->footprint_count : ROUND;
    for (uint32_t k = 0; k < count && k < capacity; k++) {
        const double angle = 2.0 * JOX_PI * k / ROUND;
        xy[2 * (size_t)k] =
            object->footprint_count
                ? (double)object->footprint[k].x
                : (double)(object->position.x + object->round * (float)jox_cos(angle));
        xy[2 * (size_t)k + 1] =
            object->footprint_count
                ? (double)object->footprint[k].y
                : (double)(object->position.y + object->round * (float)jox_sin(angle));
    }
    return count;
}

bool jo_body_pushed(const JoWorld *world, JoBody body, double impulse[3], double turn[3]) {
    JOX_REQUIRE(world, false);
    double given[3], turned[3];
    const uint32_t row = jox_world_find_body(world, body);
    const bool found = jox_bodies_impulse_sum(world->state.bodies, row, given, turned);
    for (int k = 0; k < 3; k++) {
        if (impulse)
            impulse[k] = given[k];
        if (turn)
            turn[k] = turned[k];
    }
    return found;
}
