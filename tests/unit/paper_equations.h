/* Equations (1) to (12) of the paper, written in plain double arithmetic from the paper's text,
   without a line of the engine: world_literal_reference.c compares steps of worlds with them. m, s,
   kg, N. */
#ifndef JOX_TESTS_PAPER_EQUATIONS_H
#define JOX_TESTS_PAPER_EQUATIONS_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

enum { MOST_PEOPLE = 28, MOST_BODIES = 3, MOST_WALLS = 3, MOST_PLANES = 96 };

typedef struct V {
    double x, y;
} V;

static inline V add(V a, V b) {
    return (V){a.x + b.x, a.y + b.y};
}
static inline V sub(V a, V b) {
    return (V){a.x - b.x, a.y - b.y};
}
static inline V times(V a, double k) {
    return (V){a.x * k, a.y * k};
}
static inline double dot(V a, V b) {
    return a.x * b.x + a.y * b.y;
}
static inline double cross(V a, V b) {
    return a.x * b.y - a.y * b.x;
}
static inline double length(V a) {
    return sqrt(dot(a, a));
}
static inline V unit(V a) {
    const double size = length(a);
    return size > 0.0 ? times(a, 1.0 / size) : (V){0.0, 0.0};
}

typedef struct Person {
    V at, velocity, preferred, external, passed_on;
    double mass, radius, restitution, push, push_cosine, push_reach, absorb, cone_cosine;
    double horizon, perception, max_speed;
    uint32_t neighbours;
} Person;

/* A body of glued blocks, `blocks` of them along its own axes; half: half lengths of the whole
   along these; sphere: radius of the bounding sphere of one block. */
typedef struct Box {
    V at, velocity, half;
    uint32_t blocks[2];
    double turn, spin, inverse_mass, sphere, restitution;
} Box;

typedef struct Wall {
    V from, to;
} Wall;

typedef struct Case {
    double dt;
    Person people[MOST_PEOPLE];
    Box boxes[MOST_BODIES];
    Wall walls[MOST_WALLS];
    uint32_t person_count, box_count, wall_count;
    uint32_t part_count; /* number of parts, over all boxes */
} Case;

/* A half-plane of permitted velocities: normal . v >= offset. */
typedef struct Plane {
    V normal;
    double offset;
} Plane;

/* ---- geometry ---- */

static inline bool walls_hide(const Case *c, V a, V b) {
    for (uint32_t k = 0; k < c->wall_count; k++) {
        const V p = c->walls[k].from, q = c->walls[k].to, d = sub(b, a), e = sub(q, p);
        const double turn = cross(d, e);
        if (turn == 0.0)
            continue;
        const double s = cross(sub(p, a), e) / turn, t = cross(sub(p, a), d) / turn;
        if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)
            return true;
    }
    return false;
}

/* The point of a box's outline that is nearest to a point, the unit vector from the box to the
   point, and the gap, negative within. */
typedef struct Side {
    V point, normal;
    double gap;
} Side;

static inline Side nearest_side(const Box *box, V at) {
    const V along = {cos(box->turn), sin(box->turn)}, left = {-along.y, along.x};
    const V d = sub(at, box->at), local = {dot(d, along), dot(d, left)};
    const double over_x = fabs(local.x) - box->half.x, over_y = fabs(local.y) - box->half.y;
    V near = {fmax(-box->half.x, fmin(box->half.x, local.x)),
              fmax(-box->half.y, fmin(box->half.y, local.y))};
    const bool within = over_x <= 0.0 && over_y <= 0.0;
    if (within && over_x > over_y)
        near.x = copysign(box->half.x, local.x);
    else if (within)
        near.y = copysign(box->half.y, local.y);
    const V point = add(box->at, add(times(along, near.x), times(left, near.y)));
    const V away = sub(at, point);
    return (Side){point, unit(within ? times(away, -1.0) : away),
                  within ? -length(away) : length(away)};
}

/* The neighbours of person i: the nearest of those within perception. Returns how many. */
static inline uint32_t find_neighbours(const Case *c, uint32_t i, uint32_t out[MOST_PEOPLE]) {
    const Person *own = &c->people[i];
    uint32_t count = 0;
    for (uint32_t j = 0; j < c->person_count; j++) {
        const double d = length(sub(c->people[j].at, own->at));
        if (j == i || d > own->perception)
            continue;
        uint32_t k = count++;
        for (; k > 0 && length(sub(c->people[out[k - 1]].at, own->at)) > d; k--)
            out[k] = out[k - 1];
        out[k] = j;
    }
    return count < own->neighbours ? count : own->neighbours;
}

/* ---- (3), (4): half-planes of avoidance ---- */

/* Returns the point of the boundary of a velocity obstacle that is nearest to the relative velocity
   v, and the obstacle's outward normal there. p: relative position; r: sum of radii; tau: horizon.
   The obstacle is the set of velocities that bring the centres within r in at most tau: a disc
   where they are within r already, to be left in dt, and else a disc with the two tangents from the
   origin beyond it. */
static inline V nearest_of_obstacle(V p, double r, double tau, double dt, V v, V *outward) {
    const double d = length(p);
    if (d <= r)
        tau = dt;
    const V centre = times(p, 1.0 / tau), w = sub(v, centre);
    *outward = unit(w);
    V best = add(centre, times(*outward, r / tau));
    if (d <= r)
        return best;
    const double sine = r / d, cosine = sqrt(1.0 - sine * sine);
    /* The front of the disc lies between the points where the tangents touch it. */
    const bool front = dot(*outward, unit(p)) < -sine;
    double nearest = front ? length(sub(v, best)) : INFINITY;
    for (int side = -1; side <= 1; side += 2) {
        const V e = unit(p),
                leg = {e.x * cosine - side * e.y * sine, e.y * cosine + side * e.x * sine};
        const V out = {-side * leg.y, side * leg.x};
        const double along = fmax(dot(v, leg), d * cosine / tau);
        const V foot = times(leg, along);
        if (length(sub(v, foot)) < nearest) {
            nearest = length(sub(v, foot));
            best = foot;
            *outward = out;
        }
    }
    return best;
}

static inline Plane avoid(V p, double r, double tau, double dt, V own, V other, double share) {
    V outward;
    const V v = sub(own, other), u = sub(nearest_of_obstacle(p, r, tau, dt, v, &outward), v);
    return (Plane){outward, dot(outward, add(own, times(u, share)))};
}

/* ---- (5) to (7), (10): forces ---- */

/* (5) Adds the pushes of person i. */
static inline void add_pushes(const Case *c, uint32_t i, V force[MOST_PEOPLE]) {
    const Person *own = &c->people[i];
    uint32_t near[MOST_PEOPLE], pushed[MOST_PEOPLE], n = 0, bodies = 0;
    V towards[MOST_PEOPLE];
    const V aim = unit(own->preferred);
    if (!(own->push > 0.0) || (aim.x == 0.0 && aim.y == 0.0))
        return;
    const V will_be = add(own->at, times(own->velocity, c->dt));
    const uint32_t count = find_neighbours(c, i, near);
    for (uint32_t k = 0; k < count; k++) {
        const Person *other = &c->people[near[k]];
        const V offset = sub(other->at, own->at);
        if (length(offset) < own->radius + other->radius + own->push_reach &&
            dot(unit(offset), aim) >= own->push_cosine && !walls_hide(c, own->at, other->at)) {
            towards[n] = unit(sub(other->at, will_be));
            pushed[n++] = near[k];
        }
    }
    for (uint32_t b = 0; b < c->box_count; b++) {
        const Side side = nearest_side(&c->boxes[b], own->at);
        bodies += side.gap < own->radius + own->push_reach &&
                  -dot(side.normal, aim) >= own->push_cosine && !walls_hide(c, own->at, side.point);
    }
    for (uint32_t k = 0; k < n; k++)
        force[pushed[k]] = add(force[pushed[k]], times(towards[k], own->push / (n + bodies)));
}

/* (6) Adds the contact forces of a pair. */
static inline void add_contact(const Case *c, uint32_t i, uint32_t k, V force[MOST_PEOPLE]) {
    const Person *a = &c->people[i], *b = &c->people[k];
    const V n = unit(sub(a->at, b->at));
    const double closing = dot(sub(a->velocity, b->velocity), n);
    if (!(length(sub(a->at, b->at)) < a->radius + b->radius) || !(closing < 0.0) ||
        walls_hide(c, a->at, b->at))
        return;
    const double e = fmin(a->restitution, b->restitution);
    const V f = times(n, -(1.0 + e) * closing / (1.0 / a->mass + 1.0 / b->mass) / c->dt);
    force[i] = add(force[i], f);
    force[k] = sub(force[k], f);
}

/* (6), (7) Adds the contact force of a body on person i. */
static inline void add_body_contact(const Case *c, uint32_t i, const Box *box,
                                    V force[MOST_PEOPLE]) {
    const Person *a = &c->people[i];
    const Side side = nearest_side(box, a->at);
    const V arm = sub(side.point, box->at);
    const V moves = add(box->velocity, times((V){-arm.y, arm.x}, box->spin));
    const double closing = dot(sub(a->velocity, moves), side.normal);
    if (!(side.gap < a->radius) || !(closing < 0.0) ||
        (side.gap > 0.0 && walls_hide(c, a->at, side.point)))
        return;
    const double e = fmin(a->restitution, box->restitution);
    const double impulse = -(1.0 + e) * closing / (1.0 / a->mass + box->inverse_mass);
    force[i] = add(force[i], times(side.normal, impulse / c->dt));
}

static inline void sum_forces(const Case *c, V force[MOST_PEOPLE]) {
    for (uint32_t i = 0; i < c->person_count; i++)
        force[i] = add(c->people[i].external, c->people[i].passed_on);
    for (uint32_t i = 0; i < c->person_count; i++) {
        add_pushes(c, i, force);
        for (uint32_t k = i + 1; k < c->person_count; k++)
            add_contact(c, i, k, force);
        for (uint32_t b = 0; b < c->box_count; b++)
            add_body_contact(c, i, &c->boxes[b], force);
    }
}

/* ---- (1), (2): the velocity ---- */

/* Finds the velocity within the speed limit that meets all planes and is nearest to `wanted`.
   Returns false if there is none. */
static inline bool find_nearest(const Plane *planes, uint32_t count, double limit, V wanted,
                                V *best) {
    *best = length(wanted) > limit ? times(unit(wanted), limit) : wanted;
    for (uint32_t k = 0; k < count; k++) {
        const V n = planes[k].normal, along = {n.y, -n.x};
        if (dot(n, *best) >= planes[k].offset)
            continue;
        double low = limit * limit - planes[k].offset * planes[k].offset, high;
        if (low < 0.0)
            return false;
        high = sqrt(low);
        low = -high;
        const V foot = times(n, planes[k].offset);
        for (uint32_t j = 0; j < k; j++) {
            const double slope = dot(planes[j].normal, along);
            const double lacks = planes[j].offset - dot(planes[j].normal, foot);
            if (fabs(slope) < 1e-12 && lacks > 0.0)
                return false;
            if (slope > 1e-12)
                low = fmax(low, lacks / slope);
            else if (slope < -1e-12)
                high = fmin(high, lacks / slope);
        }
        if (low > high)
            return false;
        *best = add(foot, times(along, fmax(low, fmin(high, dot(along, wanted)))));
    }
    return true;
}

static inline double greatest_violation(const Plane *planes, uint32_t count, V velocity) {
    double most = 0.0;
    for (uint32_t k = 0; k < count; k++)
        most = fmax(most, planes[k].offset - dot(planes[k].normal, velocity));
    return most;
}

/* As find_nearest; where nothing is permitted, the velocity whose greatest violation of the planes
   after the first `hard` is least. Returns false if the hard ones contradict each other. */
static inline bool find_velocity(const Plane *planes, uint32_t count, uint32_t hard, double limit,
                                 V wanted, V *best) {
    Plane eased[MOST_PLANES];
    double low = 0.0, high = 64.0;
    if (find_nearest(planes, count, limit, wanted, best))
        return true;
    for (int turn = 0; turn < 60; turn++) {
        const double ease = turn == 0 ? high : 0.5 * (low + high);
        V found;
        for (uint32_t k = 0; k < count; k++)
            eased[k] = (Plane){planes[k].normal, planes[k].offset - (k < hard ? 0.0 : ease)};
        if (find_nearest(eased, count, limit, wanted, &found)) {
            high = ease;
            *best = found;
        } else if (turn == 0) {
            return false;
        } else {
            low = ease;
        }
    }
    return true;
}

/* Returns whether a force is more than rounding. */
static inline bool is_forced(const Case *c, uint32_t i, V force) {
    return length(force) * c->dt / c->people[i].mass > 1e-5;
}

/* (11) Returns the velocity that the force alone would give. */
static inline V find_forced(const Case *c, uint32_t i, V force) {
    return add(c->people[i].velocity, times(force, c->dt / c->people[i].mass));
}

/* (4) Lists the half-planes of person i for the blocks of a body, after the first `n`. Returns how
   many there are. */
static inline uint32_t list_block_planes(const Case *c, uint32_t i, const Box *box, Plane *planes,
                                         uint32_t n) {
    const Person *own = &c->people[i];
    const V along = {cos(box->turn), sin(box->turn)}, left = {-along.y, along.x};
    if (length(sub(box->at, own->at)) > own->perception &&
        nearest_side(box, own->at).gap > own->perception)
        return n;
    for (uint32_t b = 0; b < box->blocks[0] * box->blocks[1]; b++) {
        const double x = (2 * (b % box->blocks[0]) + 1.0) / box->blocks[0] - 1.0;
        const double y = (2 * (b / box->blocks[0]) + 1.0) / box->blocks[1] - 1.0;
        const V arm = add(times(along, x * box->half.x), times(left, y * box->half.y));
        const V p = sub(add(box->at, arm), own->at);
        const V moves = add(box->velocity, times((V){-arm.y, arm.x}, box->spin));
        if (length(p) - box->sphere <= own->perception)
            planes[n++] =
                avoid(p, own->radius + box->sphere, own->horizon, c->dt, own->velocity, moves, 1.0);
    }
    return n;
}

/* Lists the half-planes of person i after the first `n`, which are walls': of people (3), bodies
   (4) and force (12). Returns how many there are. */
static inline uint32_t list_planes(const Case *c, uint32_t i, V force, Plane *planes, uint32_t n) {
    const Person *own = &c->people[i];
    uint32_t near[MOST_PEOPLE];
    const uint32_t count = find_neighbours(c, i, near);
    for (uint32_t k = 0; k < count; k++) {
        const Person *other = &c->people[near[k]];
        planes[n++] = avoid(sub(other->at, own->at), own->radius + other->radius, own->horizon,
                            c->dt, own->velocity, other->velocity, 0.5);
    }
    for (uint32_t b = 0; b < c->box_count; b++)
        n = list_block_planes(c, i, &c->boxes[b], planes, n);
    if (is_forced(c, i, force))
        planes[n++] = (Plane){unit(force), dot(unit(force), find_forced(c, i, force))};
    return n;
}

/* (8), (9) Returns what person i passes on in all, and the axis of the cone that gets it. */
static inline V find_passed(const Case *c, uint32_t i, V force, V after, V *axis) {
    const Person *own = &c->people[i];
    const double size = own->absorb * own->mass / c->dt;
    const bool forced = is_forced(c, i, force);
    *axis = forced ? find_forced(c, i, force) : own->velocity;
    const V change = sub(after, *axis);
    if (forced)
        return axis->x != 0.0 || axis->y != 0.0 ? times(change, size) : (V){0.0, 0.0};
    const bool slows = dot(unit(change), unit(after)) < -own->cone_cosine;
    return slows ? times(change, size) : (V){0.0, 0.0};
}

/* Adds what person i passes on once all have moved, to `moved`: the cone holds those of its
   neighbours that it holds then. */
static inline void add_passed(const Case *c, uint32_t i, V force, V after,
                              const V moved[MOST_PEOPLE], V passed[MOST_PEOPLE]) {
    const Person *own = &c->people[i];
    V axis;
    const V f = find_passed(c, i, force, after, &axis);
    uint32_t near[MOST_PEOPLE], n = 0;
    const uint32_t count = find_neighbours(c, i, near);
    for (uint32_t k = 0; k < count; k++)
        if (dot(unit(sub(moved[near[k]], moved[i])), unit(axis)) >= own->cone_cosine)
            near[n++] = near[k];
    for (uint32_t k = 0; k < n; k++)
        passed[near[k]] = add(passed[near[k]], times(f, 1.0 / n));
    if (!n)
        passed[i] = add(passed[i], f);
}

#endif
