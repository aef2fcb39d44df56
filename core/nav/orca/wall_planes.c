/* The half-planes of walls (van den Berg et al. 2011), for one agent; half_planes.c calls it. */
#include <math.h>

#include "base/assert.h"
#include "geom/polygon.h"
#include "nav/orca/solve.h"

static const JoxWallVertex *find_edge_end(const JoxWalls *walls, uint32_t edge) {
    return &walls->vertices[walls->vertices[edge].next];
}

/* Tangent directions from the origin to the disc of `radius` about p, with distance^2 d2 >
   radius^2: left_leg passes the disc on its left, right_leg on its right. */
static JoxV2 left_leg(JoxV2 p, float radius, float d2) {
    JOX_ASSERT(!(d2 < radius * radius));
    float leg = sqrtf(d2 - radius * radius);
    return jox_scale((JoxV2){p.x * leg - p.y * radius, p.x * radius + p.y * leg}, 1.0f / d2);
}

static JoxV2 right_leg(JoxV2 p, float radius, float d2) {
    JOX_ASSERT(!(d2 < radius * radius));
    float leg = sqrtf(d2 - radius * radius);
    return jox_scale((JoxV2){p.x * leg + p.y * radius, -p.x * radius + p.y * leg}, 1.0f / d2);
}

/* Makes the half-plane that keeps out of the disc of `radius` about `centre`, tangent at its point
   nearest to v. */
static JoxHalfPlane make_round_plane(JoxV2 v, JoxV2 centre, float radius) {
    JoxV2 normal = jox_unit(jox_sub(v, centre));
    return (JoxHalfPlane){normal, jox_dot(normal, centre) + radius};
}

/* Makes the half-plane `radius` to the left of the line through `point` along `direction`. */
static JoxHalfPlane make_straight_plane(JoxV2 point, JoxV2 direction, float radius) {
    JoxV2 normal = jox_left(direction);
    return (JoxHalfPlane){normal, jox_dot(normal, point) + radius};
}

/* An edge as seen from the agent: its two ends, which coincide where it is seen along its
   length. */
typedef struct View {
    const JoxWallVertex *left, *right; /* the edge runs from left to right */
    JoxV2 left_point, right_point;     /* relative to the agent */
    JoxV2 left_leg, right_leg;
} View;

/* Makes the half-plane of an edge within the radius, which allows zero velocity; returns whether
   the edge is done with that. *made: it has a half-plane. */
static bool make_touching_plane(const JoxWallVertex *a, const JoxWallVertex *b, JoxV2 p1, JoxV2 p2,
                                float s, float line2, float r2, JoxHalfPlane *half_plane,
                                bool *made) {
    *made = false;
    if (s < 0.0f && jox_length2(p1) <= r2) {
        *made = a->convex && jox_length2(p1) > 0.0f;
        *half_plane = (JoxHalfPlane){jox_unit(jox_scale(p1, -1.0f)), 0.0f};
        return true;
    }
    if (s > 1.0f && jox_length2(p2) <= r2) {
        /* The next edge makes it unless the agent is past its start. */
        *made = b->convex && jox_det(p2, b->direction) >= 0.0f && jox_length2(p2) > 0.0f;
        *half_plane = (JoxHalfPlane){jox_unit(jox_scale(p2, -1.0f)), 0.0f};
        return true;
    }
    if (s >= 0.0f && s <= 1.0f && line2 <= r2) {
        *made = true;
        *half_plane = (JoxHalfPlane){jox_left(jox_scale(a->direction, -1.0f)), 0.0f};
        return true;
    }
    return false;
}

/* Finds the tangents to an edge; returns false if, at a concave corner, the neighbouring edge makes
   the half-plane. */
static bool make_view(const JoxWallVertex *a, const JoxWallVertex *b, JoxV2 p1, JoxV2 p2, float s,
                      float line2, float radius, View *view) {
    float r2 = radius * radius, d1 = jox_length2(p1), d2 = jox_length2(p2);
    *view = (View){.left = a, .right = b, .left_point = p1, .right_point = p2};
    if (s < 0.0f && line2 <= r2) { /* seen along its length: the near end stands for the edge */
        view->right = a;
        view->right_point = p1;
        view->left_leg = left_leg(p1, radius, d1);
        view->right_leg = right_leg(p1, radius, d1);
        return a->convex;
    }
    if (s > 1.0f && line2 <= r2) {
        view->left = b;
        view->left_point = p2;
        view->left_leg = left_leg(p2, radius, d2);
        view->right_leg = right_leg(p2, radius, d2);
        return b->convex;
    }
    view->left_leg = a->convex ? left_leg(p1, radius, d1) : jox_scale(a->direction, -1.0f);
    view->right_leg = b->convex ? right_leg(p2, radius, d2) : a->direction;
    return true;
}

/* Makes the half-plane of the part of the velocity obstacle nearest to v; returns false if that
   part belongs to another edge. */
static bool make_view_plane(const JoxWalls *walls, View *w, JoxV2 v, float inverse, float radius,
                            JoxHalfPlane *half_plane) {
    /* A leg that points into a neighbouring edge is cut off by that edge, which has its own
       half-plane. */
    JoxV2 before = jox_scale(walls->vertices[w->left->previous].direction, -1.0f);
    bool foreign_left = w->left->convex && jox_det(w->left_leg, before) >= 0.0f;
    bool foreign_right = w->right->convex && jox_det(w->right_leg, w->right->direction) <= 0.0f;
    if (foreign_left)
        w->left_leg = before;
    if (foreign_right)
        w->right_leg = w->right->direction;
    bool point = w->left == w->right;
    JoxV2 left = jox_scale(w->left_point, inverse), right = jox_scale(w->right_point, inverse);
    JoxV2 span = jox_sub(right, left), from_left = jox_sub(v, left), from_right = jox_sub(v, right);
    float t = point ? 0.5f : jox_dot(from_left, span) / jox_length2(span);
    float t_left = jox_dot(from_left, w->left_leg), t_right = jox_dot(from_right, w->right_leg);
    if ((t < 0.0f && t_left < 0.0f) || (point && t_left < 0.0f && t_right < 0.0f)) {
        *half_plane = make_round_plane(v, left, radius * inverse);
        return true;
    }
    if (t > 1.0f && t_right < 0.0f) {
        *half_plane = make_round_plane(v, right, radius * inverse);
        return true;
    }
    JoxV2 on_cut = jox_add(left, jox_scale(span, t));
    JoxV2 on_left = jox_add(left, jox_scale(w->left_leg, t_left));
    JoxV2 on_right = jox_add(right, jox_scale(w->right_leg, t_right));
    float to_cut = t < 0.0f || t > 1.0f || point ? INFINITY : jox_length2(jox_sub(v, on_cut));
    float to_left = t_left < 0.0f ? INFINITY : jox_length2(jox_sub(v, on_left));
    float to_right = t_right < 0.0f ? INFINITY : jox_length2(jox_sub(v, on_right));
    if (to_cut <= to_left && to_cut <= to_right) {
        *half_plane =
            make_straight_plane(left, jox_scale(w->left->direction, -1.0f), radius * inverse);
        return true;
    }
    bool use_left = to_left <= to_right;
    *half_plane =
        use_left ? make_straight_plane(left, w->left_leg, radius * inverse)
                 : make_straight_plane(right, jox_scale(w->right_leg, -1.0f), radius * inverse);
    return use_left ? !foreign_left : !foreign_right;
}

/* Returns whether half-planes of nearer edges already keep clear of this whole edge. */
static bool is_covered(const JoxHalfPlane *half_planes, uint32_t count, JoxV2 p1, JoxV2 p2,
                       float inverse, float radius) {
    for (uint32_t i = 0; i < count; i++) {
        float need = half_planes[i].offset - radius * inverse + 1e-5f;
        if (jox_dot(half_planes[i].normal, p1) * inverse <= need &&
            jox_dot(half_planes[i].normal, p2) * inverse <= need)
            return true;
    }
    return false;
}

typedef struct NearEdge {
    float distance2;
    uint32_t edge;
} NearEdge;

static bool is_nearer(NearEdge a, NearEdge b) {
    return a.distance2 < b.distance2 || (a.distance2 == b.distance2 && a.edge < b.edge);
}

/* Lists the edges within range whose outer side the agent is on, nearest first, ties by number.
   Returns how many. */
static uint32_t list_near_edges(const JoxWallGrid *grid, JoxV2 position, float range, NearEdge *out,
                                uint32_t most) {
    uint32_t count, n = 0;
    const JoxNearEdge *nearest = jox_wall_grid_nearest(grid, position, &count);
    for (uint32_t i = 0; i < count && nearest[i].away <= range; i++) {
        const uint32_t edge = nearest[i].edge;
        JOX_ASSERT(edge < grid->walls->count);
        const JoxWallVertex *a = &grid->walls->vertices[edge];
        JoxV2 b = find_edge_end(grid->walls, edge)->point;
        if (jox_det(a->direction, jox_sub(position, a->point)) >= 0.0f)
            continue;
        float d2 = jox_length2(jox_sub(position, jox_segment_nearest(a->point, b, position)));
        if (d2 > range * range)
            continue;
        const NearEdge own = {d2, edge};
        uint32_t at = n < most ? n++ : n;
        if (at == most) {
            if (!is_nearer(own, out[most - 1]))
                continue;
            at--;
        }
        for (; at > 0 && is_nearer(own, out[at - 1]); at--)
            out[at] = out[at - 1];
        out[at] = own;
    }
    return n;
}

/* Returns how far a torso reaches towards an edge from p1 to p2, relative to its centre, m. */
static float find_reach(JoxV2 p1, JoxV2 p2, const JoxWallShape *s) {
    if (s->axis.x == 0.0f && s->axis.y == 0.0f)
        return s->radius;
    const JoxV2 to = jox_segment_nearest(p1, p2, (JoxV2){0.0f, 0.0f});
    const float kept = jox_maxf(s->radius, jox_minf(s->keeps, jox_length(to)));
    /* An end is passed by another side of the torso than the one that points to it now. */
    if ((to.x == p1.x && to.y == p1.y) || (to.x == p2.x && to.y == p2.y))
        return kept;
    return jox_maxf(kept, s->radius + fabsf(jox_dot(s->axis, jox_unit(to))));
}

uint32_t jox_orca_walls(const JoxWallGrid *grid, JoxV2 position, JoxV2 velocity,
                        const JoxWallShape *shape, float tau, float range, JoxHalfPlane *out,
                        uint32_t most) {
    JOX_ASSERT(tau > 0.0f && shape->radius > 0.0f);
    NearEdge near[16];
    uint32_t edges = list_near_edges(grid, position, range, near, 16), made = 0;
    float inverse = 1.0f / tau;
    for (uint32_t i = 0; i < edges && made < most; i++) {
        const JoxWallVertex *a = &grid->walls->vertices[near[i].edge];
        const JoxWallVertex *b = find_edge_end(grid->walls, near[i].edge);
        JoxV2 p1 = jox_sub(a->point, position), p2 = jox_sub(b->point, position);
        const float radius = find_reach(p1, p2, shape), r2 = radius * radius;
        if (is_covered(out, made, p1, p2, inverse, radius))
            continue;
        JoxV2 edge = jox_sub(p2, p1);
        float s = -jox_dot(p1, edge) / jox_maxf(jox_length2(edge), 1e-12f);
        float line2 = jox_length2(jox_add(p1, jox_scale(edge, s)));
        bool add;
        View view;
        if (make_touching_plane(a, b, p1, p2, s, line2, r2, &out[made], &add))
            made += add;
        else if (make_view(a, b, p1, p2, s, line2, radius, &view))
            made += make_view_plane(grid->walls, &view, velocity, inverse, radius, &out[made]);
    }
    return made;
}
