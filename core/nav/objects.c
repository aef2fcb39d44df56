/* Half-planes of rigid bodies: equation 4. */
#include "base/assert.h"
#include "nav/internal.h"

/* A body that an agent minds. Its nearest point is looked for once, where somebody asks for it. */
typedef struct Minded {
    const JoxObject *body;
    JoxV2 at; /* the agent's centre */
    bool known;
    JoxFootprintPoint side;
} Minded;

static const JoxFootprintPoint *side_of(Minded *m) {
    if (!m->known)
        m->side = jox_footprint_nearest(m->body, m->at);
    m->known = true;
    return &m->side;
}

/* A body: its bounding disc from outside; within that disc, the nearest side of its true footprint,
   so that one can walk along a long wall. Bodies never reciprocate: share 1. */
static JoxHalfPlane half_plane_of(const JoxAgents *a, uint32_t i, Minded *m, float planning_time,
                                  float tau) {
    const JoxObject *o = m->body;
    JoxV2 own = {a->vx[i], a->vy[i]};
    JoxV2 p = {o->position.x - m->at.x, o->position.y - m->at.y};
    JoxV2 moving = {o->velocity.x, o->velocity.y}, v = jox_sub(own, moving);
    float radius = jox_param(a, JOX_PARAM_radius, i), sum = radius + o->disc;
    if (jox_length2(p) > sum * sum || o->footprint_count == 0) {
        float disc = o->footprint_count == 0 ? o->round : o->disc;
        return jox_orca_half_plane(p, v, radius + disc, tau, planning_time, own, 1.0f,
                                   (JoxV2){1.0f, 0.0f});
    }
    const JoxFootprintPoint *side = side_of(m);
    float gap = side->gap - radius, time = gap < 0.0f ? planning_time : tau;
    moving = jox_object_velocity_at(o, side->point);
    return (JoxHalfPlane){side->normal, jox_dot(moving, side->normal) - gap / time};
}

/* As printed: the disc of the body's bounding sphere, from outside and from within. */
static JoxHalfPlane half_plane_of_sphere(const JoxAgents *a, uint32_t i, const JoxObject *o,
                                         float planning_time, float tau) {
    JoxV2 own = {a->vx[i], a->vy[i]};
    return jox_orca_half_plane(jox_v2(o->position.x - a->x[i], o->position.y - a->y[i]),
                               jox_sub(own, jox_v2(o->velocity.x, o->velocity.y)),
                               jox_param(a, JOX_PARAM_radius, i) + o->sphere, tau, planning_time,
                               own, 1.0f, jox_v2(1.0f, 0.0f));
}

/* Whether agent i minds the body of a row: its footprint must be within perception, and, where that
   is given, may be `among` the nearest. A body that it approaches counts even where its kind is
   ignored. */
static bool minds(const JoxAgents *a, uint32_t i, const JoxObjects *objects, uint32_t row,
                  const JoxNearest *among) {
    const JoxObject *o = &objects->rows[row];
    JoxV2 at = {a->x[i], a->y[i]};
    float sight = jox_param(a, JOX_PARAM_perception, i);
    float away = jox_length(jox_v2(o->position.x - at.x, o->position.y - at.y));
    float apart = away - jox_maxf(o->disc, o->round); /* the least gap that there can be */
    if (apart > sight || (among && !jox_nearest_takes(among, apart)))
        return false;
    if (o->tags & a->ignore[i] && jox_referred(a->approach[i]) != (int32_t)row)
        return false;
    return away <= sight || jox_footprint_nearest(o, at).gap <= sight;
}

/* Whether agent i has to keep clear of a body by its feet: not of one that it touches, whose
   contact plane stands for it, nor, where contacts are looked for, of one that reaches into it
   without that: a fast one, which is swept, and one behind a wall. Feet would part them at once,
   and throw people. */
static bool is_clear(const JoxContactPlanes *touched, const JoxAgents *a, uint32_t i, uint32_t row,
                     Minded *m) {
    if (!touched)
        return true;
    const JoxContactPlane *planes = touched->planes + touched->starts[i] + touched->people[i];
    for (uint32_t k = 0; k < touched->bodies[i]; k++)
        if (planes[k].other == row)
            return false;
    float radius = a->breadth[i];
    return !jox_object_reaches(m->body, m->at, radius) || side_of(m)->gap >= radius;
}

/* Orders by how far off they are those who were minded in the order of the walk. */
static void measure(JoxNearest *nearest, const JoxObjects *objects, JoxV2 at) {
    const JoxNearest all = *nearest;
    nearest->count = 0;
    for (uint32_t k = 0; k < all.count; k++)
        jox_nearest_offer(nearest, jox_footprint_nearest(&objects->rows[all.rows[k]], at).gap,
                          all.rows[k]);
}

/* Rows of the bodies that agent i minds, ascending; of more than `most` the nearest. */
static uint32_t rows_of(const JoxAgents *a, uint32_t i, const JoxObjects *objects,
                        JoxNearest *nearest) {
    JoxV2 at = {a->x[i], a->y[i]};
    JoxObjectWalk walk = jox_objects_near(objects, at, jox_param(a, JOX_PARAM_perception, i));
    uint32_t row;
    bool many = false; /* only then their gaps matter */
    while (jox_objects_next(&walk, &row)) {
        if (!minds(a, i, objects, row, many ? nearest : NULL))
            continue;
        if (nearest->count < nearest->most && !many) {
            nearest->rows[nearest->count++] = row;
            continue;
        }
        if (!many)
            measure(nearest, objects, at);
        many = true;
        jox_nearest_offer(nearest, jox_footprint_nearest(&objects->rows[row], at).gap, row);
    }
    jox_nearest_by_row(nearest);
    return nearest->count;
}

uint32_t jox_orca_objects(const JoxNav *nav, const JoxAgents *a, uint32_t i,
                          const JoxObjects *objects, const JoxContactPlanes *touched,
                          float planning_time, JoxHalfPlane *out, uint32_t most) {
    JOX_ASSERT(most <= JOX_MOST_NEAREST);
    JoxNearest nearest;
    jox_nearest_begin(&nearest, most);
    uint32_t count = rows_of(a, i, objects, &nearest), made = 0;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t row = nearest.rows[k];
        Minded minded = {.body = &objects->rows[row], .at = {a->x[i], a->y[i]}};
        if (!is_clear(touched, a, i, row, &minded))
            continue;
        bool approached = jox_referred(a->approach[i]) == (int32_t)row;
        float tau = approached ? planning_time : jox_param(a, JOX_PARAM_horizon, i);
        out[made++] = nav->literal ? half_plane_of_sphere(a, i, minded.body, planning_time, tau)
                                   : half_plane_of(a, i, &minded, planning_time, tau);
    }
    return made;
}
