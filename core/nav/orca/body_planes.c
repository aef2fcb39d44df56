/* Half-planes of rigid bodies: equation 4. half_planes.c calls jox_orca_objects for one agent at a
   time. */
#include "agents/torso.h"
#include "base/assert.h"
#include "nav/orca/solve.h"

/* A body that an agent avoids. The nearest point of its footprint is computed at its first use. */
typedef struct Minded {
    const JoxObject *body;
    JoxV2 at; /* centre of the agent, m */
    bool known;
    JoxFootprintPoint side;
} Minded;

static const JoxFootprintPoint *find_side(Minded *m) {
    if (!m->known)
        m->side = jox_footprint_nearest(m->body, m->at);
    m->known = true;
    return &m->side;
}

/* Makes the half-plane of a body: outside of its bounding disc for that disc; within it for the
   nearest side of the true footprint, so that agents can walk along a long wall. Bodies never
   reciprocate, so the share is 1. */
static JoxHalfPlane make_body_plane(const JoxAgents *a, uint32_t i, Minded *m, float planning_time,
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
    const JoxFootprintPoint *side = find_side(m);
    if (a->axis_x[i] != 0.0f || a->axis_y[i] != 0.0f)
        radius = jox_torso_reach(a, i, side->normal);
    float gap = side->gap - radius, time = gap < 0.0f ? planning_time : tau;
    moving = jox_object_velocity_at(o, side->point);
    return (JoxHalfPlane){side->normal, jox_dot(moving, side->normal) - gap / time};
}

/* Returns whether agent i avoids the body of a row: the footprint must be within perception and,
   where `among` is given, may be one of the nearest. A body that the agent approaches counts even
   where it ignores bodies of this kind, and one that it just kicked never. */
static bool is_body_avoided(const JoxAgents *a, uint32_t i, const JoxObjects *objects, uint32_t row,
                            const JoxNearest *among) {
    const JoxObject *o = &objects->rows[row];
    JoxV2 at = {a->x[i], a->y[i]};
    float sight = jox_param(a, JOX_PARAM_perception, i);
    float away = jox_length(jox_v2(o->position.x - at.x, o->position.y - at.y));
    float apart = away - jox_maxf(o->disc, o->round); /* lower bound of the gap, m */
    if (apart > sight || (among && !jox_nearest_takes(among, apart)))
        return false;
    if (jox_referred(a->parting[i]) == (int32_t)row)
        return false;
    if (o->tags & a->ignore[i] && jox_referred(a->approach[i]) != (int32_t)row)
        return false;
    return away <= sight || jox_footprint_nearest(o, at).gap <= sight;
}

/* Returns whether agent i has to avoid a body by its own motion. It need not avoid one that it
   touches, whose contact plane replaces this; nor, where contacts are searched for, one that
   overlaps it without a contact (a fast, swept body, or one behind a wall): avoidance would
   separate them at once and throw the agent. */
static bool needs_avoidance(const JoxContactPlanes *touched, const JoxAgents *a, uint32_t i,
                            uint32_t row, Minded *m) {
    if (!touched)
        return true;
    const JoxContactPlane *planes = touched->planes + touched->starts[i] + touched->people[i];
    for (uint32_t k = 0; k < touched->bodies[i]; k++)
        if (planes[k].other == row)
            return false;
    float radius = a->contact_radius[i];
    return !jox_object_reaches(m->body, m->at, radius) || find_side(m)->gap >= radius;
}

/* Sorts the rows listed so far by their gaps to the point `at`. */
static void sort_by_gap(JoxNearest *nearest, const JoxObjects *objects, JoxV2 at) {
    const JoxNearest all = *nearest;
    nearest->count = 0;
    for (uint32_t k = 0; k < all.count; k++)
        jox_nearest_offer(nearest, jox_footprint_nearest(&objects->rows[all.rows[k]], at).gap,
                          all.rows[k]);
}

/* Lists the rows of the bodies that agent i avoids, ascending; the nearest ones if there are more
   than `most`. Returns how many. */
static uint32_t list_rows(const JoxAgents *a, uint32_t i, const JoxObjects *objects,
                          JoxNearest *nearest) {
    JoxV2 at = {a->x[i], a->y[i]};
    JoxObjectWalk walk = jox_objects_near(objects, at, jox_param(a, JOX_PARAM_perception, i));
    uint32_t row;
    bool many = false; /* more bodies than room: the gaps decide */
    while (jox_objects_next(&walk, &row)) {
        if (!is_body_avoided(a, i, objects, row, many ? nearest : NULL))
            continue;
        if (nearest->count < nearest->most && !many) {
            nearest->rows[nearest->count++] = row;
            continue;
        }
        if (!many)
            sort_by_gap(nearest, objects, at);
        many = true;
        jox_nearest_offer(nearest, jox_footprint_nearest(&objects->rows[row], at).gap, row);
    }
    jox_nearest_by_row(nearest);
    return nearest->count;
}

/* Returns the horizon, s, of an agent for a body. */
static float find_body_horizon(const JoxSolve *s, uint32_t i, uint32_t row) {
    const JoxAgents *a = s->step.agents;
    const bool approached = jox_referred(a->approach[i]) == (int32_t)row;
    return approached ? (float)s->step.timing.planning_time : jox_param(a, JOX_PARAM_horizon, i);
}

/* ---- literal mode ---- */

/* Half-planes of an agent for the parts of bodies. */
typedef struct PartPlanes {
    JoxHalfPlane *planes;
    uint32_t count, most;
    float speed_limit;               /* m/s */
    bool replaces[JOX_MOST_NEAREST]; /* a similar plane was dropped for this one */
    bool left_out;                   /* one was dropped that might matter */
} PartPlanes;

/* Returns whether no velocity within the speed limit violates `plane` by more than 1 cm/s beyond
   what it violates `by`. */
static bool is_replaced(const PartPlanes *p, const JoxHalfPlane *plane, const JoxHalfPlane *by) {
    const float slack = 0.01f; /* m/s */
    const float turn = jox_length(jox_sub(plane->normal, by->normal));
    return plane->offset - by->offset + p->speed_limit * turn <= slack;
}

/* Returns the index of a half-plane that replaces a given one, which is number `but` or not listed;
   else their number. */
static uint32_t find_replacement(const PartPlanes *p, const JoxHalfPlane *plane, uint32_t but) {
    uint32_t j = 0;
    while (j < p->count && (j == but || !is_replaced(p, plane, &p->planes[j])))
        j++;
    return j;
}

/* Drops half-planes that others replace, as blocks one above the other have nearly the same; but
   none that replaces another, so that errors do not add up. */
static void drop_replaced(PartPlanes *p) {
    for (uint32_t k = 0; k < p->count;) {
        const uint32_t by = p->replaces[k] ? p->count : find_replacement(p, &p->planes[k], k);
        if (by == p->count) {
            k++;
            continue;
        }
        p->replaces[by] = true;
        p->count--;
        p->planes[k] = p->planes[p->count];
        p->replaces[k] = p->replaces[p->count];
    }
}

/* Returns where a half-plane goes for which there is no room: in place of the least restrictive one
   for an agent at rest, or nowhere. */
static uint32_t find_least_plane(const PartPlanes *p, const JoxHalfPlane *plane) {
    uint32_t least = 0;
    for (uint32_t k = 1; k < p->count; k++)
        if (p->planes[k].offset < p->planes[least].offset)
            least = k;
    return plane->offset > p->planes[least].offset ? least : p->count;
}

/* Adds a half-plane unless every velocity within the speed limit meets it. */
static void add_part_plane(PartPlanes *p, JoxHalfPlane plane) {
    if (plane.offset <= -p->speed_limit)
        return;
    if (p->count == p->most)
        drop_replaced(p);
    uint32_t at = p->count;
    if (at == p->most) {
        const uint32_t by = find_replacement(p, &plane, p->count);
        if (by < p->count) {
            p->replaces[by] = true;
            return;
        }
        p->left_out = true;
        at = find_least_plane(p, &plane);
        if (at == p->count)
            return;
    } else {
        p->count++;
    }
    p->planes[at] = plane;
    p->replaces[at] = false;
}

/* Makes the half-planes that the paper prints: for the disc of the bounding sphere of each part,
   outside and inside of it. */
static uint32_t make_part_planes(const JoxSolve *s, uint32_t i, JoxHalfPlane *out, uint32_t most) {
    JoxAgents *a = s->step.agents;
    const JoxObjects *objects = s->step.objects;
    const JoxV2 at = {a->x[i], a->y[i]}, own = {a->vx[i], a->vy[i]};
    const float sight = jox_param(a, JOX_PARAM_perception, i);
    PartPlanes kept = {.planes = out, .most = most, .speed_limit = a->speed_limit[i]};
    JoxObjectWalk walk = jox_objects_near(objects, at, sight);
    uint32_t row;
    while (jox_objects_next(&walk, &row)) {
        if (!is_body_avoided(a, i, objects, row, NULL))
            continue;
        JoxPartWalk parts = {.row = row, .point = at, .reach = sight};
        JoxObjectPart part;
        while (objects->next_part(objects->bodies, &parts, &part))
            add_part_plane(&kept,
                           jox_orca_half_plane(jox_sub(part.at, at), jox_sub(own, part.velocity),
                                               jox_param(a, JOX_PARAM_radius, i) + part.radius,
                                               find_body_horizon(s, i, row),
                                               (float)s->step.timing.planning_time, own, 1.0f,
                                               jox_v2(1.0f, 0.0f)));
    }
    if (kept.left_out)
        a->plan_notes[i] |= JOX_NOTE_PARTS_LEFT_OUT;
    return kept.count;
}

uint32_t jox_orca_objects(const JoxSolve *s, uint32_t i, JoxHalfPlane *out, uint32_t most) {
    const JoxAgents *a = s->step.agents;
    const JoxObjects *objects = s->step.objects;
    const float planning_time = (float)s->step.timing.planning_time;
    JOX_ASSERT(most <= JOX_MOST_NEAREST);
    if (s->nav->literal)
        return make_part_planes(s, i, out, most);
    JoxNearest nearest;
    jox_nearest_begin(&nearest, most);
    uint32_t count = list_rows(a, i, objects, &nearest), made = 0;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t row = nearest.rows[k];
        Minded minded = {.body = &objects->rows[row], .at = {a->x[i], a->y[i]}};
        if (!needs_avoidance(s->step.touched, a, i, row, &minded))
            continue;
        out[made++] = make_body_plane(a, i, &minded, planning_time, find_body_horizon(s, i, row));
    }
    return made;
}
