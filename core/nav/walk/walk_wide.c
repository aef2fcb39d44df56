/* The kernel of the walking law (core/walking.md). A lane is an agent, a packet is JOX_WIDTH of
   them. The neighbours that each lane minds stand in rows, one of each lane per row, in the frame
   of the lane's aim. Directions are judged for all lanes at once: straight on first, then left and
   right together. Tempers, walls (walk_walls_wide.c) and neighbours that may be behind a wall are
   handled one lane at a time. */
#include <math.h>

#include "agents/param_lanes.h"
#include "agents/torso_lanes.h"
#include "geom/wall_grid_lanes.h"
#include "nav/walk/walk.h"
#include "nav/walk/walk_lanes.h"

static const float AS_FREE = 0.98f;  /* share of the wanted speed that needs no turning aside */
static const float WORST = -0.2f;    /* m/s: worth of a direction is at least this */
static const float NO_LIMIT = 64.0f; /* speed limit without agents ahead, in wanted speeds */

/* Directions, offsets and velocities of neighbours are in the frame of each lane's agent: x along
   its aim, y to its left. */

/* One neighbour ahead per lane. Lanes without one have a neighbour behind, which limits nothing. */
typedef struct Ahead {
    JoxVector offset, foreseen; /* m; foreseen: displacement within the foreseen time */
    JoxFloats distance2;        /* m2 */
    JoxFloats per_width2;       /* 1/m2: inverse square of the way's width */
    JoxFloats length;           /* m: length that the neighbour takes up along the way */
} Ahead;

/* One crossing neighbour per lane. */
typedef struct Crossing {
    JoxMask there;
    JoxVector offset, velocity; /* m; m/s */
    JoxFloats width2, apart2;   /* m2: square of the kept distance; squared distance minus that */
} Crossing;

typedef struct Packet {
    const JoxWalk *w;
    uint32_t first, lanes; /* agent of lane 0; bits of walkers that want to get on */
    uint32_t near_walls;   /* walkers that may have a wall between them and a neighbour */
    uint32_t at_walls;     /* walkers that may reach a wall soon */
    uint32_t ahead_count, crossing_count;
    JoxVector aim;
    JoxFloats speed, gap, eager, radius; /* wanted speed, m/s; time gap, s; eagerness; radius, m */
    JoxFloats unhidden2; /* m2: no wall hides neighbours within this squared distance */
    JoxFloats beside2;   /* weight of the squared lateral distance beside the way, minus 1 */
    JoxFloats cross;     /* width of ways that cross, as a share of the sum of both radii */
    JoxFloats per_time;  /* 1/s: speed per metre of room behind an agent ahead */
    JoxFloats per_cross; /* 1/s: speed per metre of free path */
    JoxFloats meeting;   /* m/s2: worth of a direction per second until a meeting in it */
    Ahead ahead[JOX_MOST_NEIGHBOURS];
    Crossing crossing[JOX_MOST_NEIGHBOURS];
} Packet;

/* The speed that a direction allows, and its worth, m/s. */
typedef struct Judgement {
    JoxFloats allowed, worth;
} Judgement;

static inline JoxFloats clamped_root(JoxFloats a) { /* 0 for negative values */
    return jf_sqrt(jf_max(a, jf_set(0.0f)));
}

static inline JoxFloats squared(JoxFloats a) {
    return a * a;
}

/* ---- neighbours that count ---- */

/* Neighbours that lanes mind: bit k for neighbour k, in the order of distance. */
typedef struct Minded {
    JoxInts ahead, crossing;
} Minded;

/* Returns the offset from each lane's agent to a neighbour, m. */
static inline __attribute__((always_inline)) JoxVector
find_offset(const Packet *p, const JoxFloats *record, const bool periodic) {
    const JoxAgents *a = p->w->step.agents;
    JoxVector offset = jv_sub((JoxVector){record[0], record[1]}, jv_load(a->x, a->y, p->first));
    return periodic ? jox_fold_lanes(a, offset) : offset;
}

/* Returns the `lanes` (bits) that ignore their neighbour, mean to touch it, or have a wall before
   it. */
static uint32_t find_passed_over(const Packet *p, uint32_t lanes, JoxInts others,
                                 JoxVector offset) {
    const JoxAgents *a = p->w->step.agents;
    uint32_t index[JOX_WIDTH], passed = 0;
    float x[JOX_WIDTH], y[JOX_WIDTH];
    ji_store(index, others);
    jv_store(x, y, 0, offset);
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(lanes), i = p->first + lane;
        if ((a->tags[index[lane]] & a->ignore[i]) || jox_approaches_or_holds(a, i, index[lane]) ||
            ((p->near_walls >> lane & 1) &&
             jox_nav_is_behind_wall(p->w->nav, (JoxV2){a->x[i], a->y[i]},
                                    (JoxV2){x[lane], y[lane]})))
            passed |= 1u << lane;
    }
    return passed;
}

/* Finds which neighbours each lane minds, and how. */
static inline __attribute__((always_inline)) Minded find_minded(const Packet *p,
                                                                const bool periodic) {
    const JoxAgents *a = p->w->step.agents;
    const JoxNeighbours *n = p->w->step.neighbours;
    const JoxInts none = ji_set(0);
    const uint32_t i = p->first;
    const JoxMask wants = jm_of_bits(p->lanes);
    const JoxInts counts = ji_select(wants, ji_load_bytes(n->count + i), none);
    const uint32_t scalar_tested = jox_scalar_test_lanes(a, i);
    Minded minded = {none, none};
    JoxMask there;
    for (uint32_t k = 0; jm_bits(there = ji_less(ji_set((int32_t)k), counts)); k++) {
        const JoxInts others =
            ji_select(there, ji_load(n->index + jox_neighbour_at(n, i, k)), none);
        JoxFloats record[4];
        jf_records(&n->motions[0].x, others, record);
        const JoxVector offset = find_offset(p, record, periodic);
        JoxFloats heading[4];
        jf_records(&p->w->nav->headings[0].aim_x, others, heading);
        const JoxMindsLanes how = jox_minds_lanes(a, i, others, heading, offset);
        const JoxMask hidden = jf_le(p->unhidden2, jv_dot(offset, offset));
        JoxMask minds = jm_and(there, jm_or(how.ahead, how.crossing));
        const uint32_t doubtful = jm_bits(minds) & (scalar_tested | jm_bits(hidden));
        if (doubtful)
            minds = jm_without(minds, jm_of_bits(find_passed_over(p, doubtful, others, offset)));
        const JoxInts bit = ji_set((int32_t)(1u << k));
        minded.ahead = ji_or(minded.ahead, ji_select(jm_and(minds, how.ahead), bit, none));
        minded.crossing = ji_or(minded.crossing, ji_select(jm_and(minds, how.crossing), bit, none));
    }
    return minded;
}

/* One neighbour of each lane. */
typedef struct Next {
    JoxMask there; /* else agent 0 stands in */
    JoxVector offset, velocity;
    JoxFloats radii; /* sum of both radii, m */
} Next;

/* Rotates a vector into the frame of the aims. */
static JoxVector rotate_to_aim(const Packet *p, JoxVector v) {
    const JoxVector aim = p->aim;
    return (JoxVector){jv_dot(v, aim), aim.x * v.y - aim.y * v.x};
}

/* Takes the nearest neighbour of each lane out of `left`; returns false when no lane has one
   left. */
static inline __attribute__((always_inline)) bool take_nearest(const Packet *p, JoxInts *left,
                                                               Next *next, const bool periodic) {
    const JoxAgents *a = p->w->step.agents;
    const JoxNeighbours *n = p->w->step.neighbours;
    const JoxInts none = ji_set(0), one = ji_set(1);
    next->there = ji_less(none, *left);
    if (!jm_bits(next->there))
        return false;
    const JoxInts lowest = ji_select(next->there, ji_and(*left, ji_sub(none, *left)), one);
    const JoxInts rank = /* a power of 2: the exponent of a float */
        ji_sub(ji_shift_right(jf_bits(ji_to_floats(lowest)), 23), ji_set(127));
    const JoxInts at = ji_add(ji_shift_left(rank, 4), ji_lane());
    _Static_assert(JOX_LANES == 1 << 4, "a row of neighbours has as many entries");
    *left = ji_and(*left, ji_sub(*left, one));
    const JoxInts others =
        ji_select(next->there, ji_pick(n->index + jox_neighbour_at(n, p->first, 0), at), none);
    JoxFloats record[4];
    jf_records(&n->motions[0].x, others, record);
    next->offset = rotate_to_aim(p, find_offset(p, record, periodic));
    JoxVector velocity = {record[2], record[3]};
    if (n->has_belts) /* as seen from the agent's own belt */
        velocity = jv_sub(velocity, jv_load(n->belt_x, n->belt_y, p->first));
    next->velocity = rotate_to_aim(p, velocity);
    next->radii = p->radius + jox_param_pick(a->param[JOX_PARAM_radius], others);
    return true;
}

/* Fills the rows of neighbours ahead and crossing. */
static inline __attribute__((always_inline)) void put_rows(Packet *p, const bool periodic) {
    const JoxWalkLaw *law = p->w->law;
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxFloats room = one - (float)law->room_eager * p->eager;
    const JoxFloats width = (float)law->width * room;
    const JoxFloats length = (float)law->length * room;
    const JoxFloats foreseen = (float)law->ahead_share * p->gap;
    const JoxVector behind = {jf_set(-1.0f), zero};
    Minded left = find_minded(p, periodic);
    Next next;
    for (p->ahead_count = 0; take_nearest(p, &left.ahead, &next, periodic); p->ahead_count++) {
        p->ahead[p->ahead_count] = (Ahead){.offset = jv_select(next.there, next.offset, behind),
                                           .foreseen = jv_scale(next.velocity, foreseen),
                                           .distance2 = jv_dot(next.offset, next.offset),
                                           .per_width2 = squared(one / (width * next.radii)),
                                           .length = length * next.radii};
    }
    for (p->crossing_count = 0; take_nearest(p, &left.crossing, &next, periodic);
         p->crossing_count++) {
        const JoxFloats width2 = squared(p->cross * next.radii);
        const JoxFloats apart2 = jv_dot(next.offset, next.offset) - width2;
        p->crossing[p->crossing_count] =
            (Crossing){next.there, next.offset, next.velocity, width2, jf_max(apart2, zero)};
    }
}

static void put_rows_bounded(Packet *p) {
    put_rows(p, false);
}

static void put_rows_periodic(Packet *p) {
    put_rows(p, true);
}

/* ---- what a direction allows ---- */

/* Returns the room, m, that an agent ahead leaves at the offset (`along`, `aside`), `foreseen`
   being its displacement along the direction within the foreseen time. In the way, the agent takes
   up its length, less towards its sides. Beside the way, within 60 degrees ahead, the distance
   counts, with a greater weight on the lateral part. */
static inline JoxFloats measure_room(const Packet *p, const Ahead *o, JoxFloats along,
                                     JoxFloats aside, JoxFloats foreseen) {
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxFloats slope = jf_set(1.7320508f); /* tangent of 60 degrees */
    const JoxFloats aside2 = squared(aside), q2 = aside2 * o->per_width2;
    const JoxMask in_way = jf_lt(q2, one);
    const JoxFloats beside = o->distance2 + p->beside2 * aside2;
    const JoxFloats round = one - squared(q2) * q2; /* not negative in the way */
    const JoxFloats length = jf_sqrt(jf_select(in_way, round, beside));
    const JoxFloats gap = jf_select(in_way, along - o->length * length, length - o->length);
    const JoxMask minded =
        jm_or(jm_and(in_way, jf_lt(zero, along)), jf_lt(jf_abs(aside), slope * along));
    return jf_select(minded, gap + jf_max(foreseen, zero), jf_set(INFINITY));
}

/* Eases the speed from the wanted one to what agents ahead allow, so that walkers slow down
   gradually. */
static inline JoxFloats ease_speed(const Packet *p, JoxFloats allowed) {
    const JoxFloats one = jf_set(1.0f);
    JoxFloats most = jf_min(allowed, NO_LIMIT * p->speed);
    JoxFloats share = (float)p->w->law->ease * most / p->speed;
    JoxFloats eased = most / jf_sqrt(jf_sqrt(one + squared(squared(share))));
    return jf_select(jf_lt(jf_set(0.0f), most), eased, most);
}

/* Limits a direction by the free path to a crossing agent, and lowers its worth where the two would
   meet soon. */
static inline void judge_crossing(const Packet *p, const Crossing *o, JoxVector e, Judgement *j) {
    const JoxFloats zero = jf_set(0.0f), none = jf_set(INFINITY);
    const JoxFloats along = jv_dot(o->offset, e);
    const JoxFloats aside = e.x * o->offset.y - e.y * o->offset.x;
    const JoxFloats rest = o->width2 - squared(aside);
    const JoxMask in_way = jm_and(jm_and(jf_lt(zero, rest), jf_lt(zero, along)), o->there);
    const JoxFloats path = (along - clamped_root(rest)) * p->per_cross;
    j->allowed = jf_min(j->allowed, jf_select(in_way, path, none));
    /* Time until the discs meet, at the wanted speed and the other's present velocity. */
    const JoxVector u = {p->speed * e.x - o->velocity.x, p->speed * e.y - o->velocity.y};
    const JoxFloats closing = jv_dot(o->offset, u), u2 = jv_dot(u, u);
    const JoxFloats meets = squared(closing) - u2 * o->apart2;
    const JoxFloats time = (closing - clamped_root(meets)) / jf_max(u2, jf_set(1e-6f));
    const JoxMask soon = jm_and(jm_and(jf_lt(zero, meets), jf_lt(zero, closing)), o->there);
    j->worth = jf_min(j->worth, jf_select(soon, p->meeting * time, none));
}

/* Judges a direction in which agents ahead leave `room` metres: the speed that keeps the time
   gap. */
static Judgement judge_room(const Packet *p, JoxFloats room, JoxVector e) {
    Judgement j = {p->speed, p->speed};
    for (uint32_t k = 0; k < p->crossing_count; k++)
        judge_crossing(p, &p->crossing[k], e, &j);
    j.allowed = jf_min(j.allowed, ease_speed(p, room * p->per_time));
    j.worth = jf_min(j.worth, j.allowed);
    return j;
}

/* Judges one direction for all lanes. */
static Judgement judge_direction(const Packet *p, JoxVector e) {
    JoxFloats room = jf_set(INFINITY);
    for (uint32_t k = 0; k < p->ahead_count; k++) {
        const Ahead *o = &p->ahead[k];
        const JoxFloats aside = e.x * o->offset.y - e.y * o->offset.x;
        room =
            jf_min(room, measure_room(p, o, jv_dot(e, o->offset), aside, jv_dot(e, o->foreseen)));
    }
    return judge_room(p, room, e);
}

/* Judges the two directions at the same angle to the left and right, which share most of the
   work. */
static void judge_both(const Packet *p, const JoxVector e[2], Judgement out[2]) {
    const JoxFloats cosine = e[0].x, sine = e[0].y;
    JoxFloats left = jf_set(INFINITY), right = left;
    for (uint32_t k = 0; k < p->ahead_count; k++) {
        const Ahead *o = &p->ahead[k];
        const JoxVector ahead = jv_scale(o->offset, cosine), turned = jv_scale(o->offset, sine);
        const JoxFloats moves = cosine * o->foreseen.x, turns = sine * o->foreseen.y;
        left =
            jf_min(left, measure_room(p, o, ahead.x + turned.y, ahead.y - turned.x, moves + turns));
        right = jf_min(right,
                       measure_room(p, o, ahead.x - turned.y, ahead.y + turned.x, moves - turns));
    }
    out[0] = judge_room(p, left, e[0]);
    out[1] = judge_room(p, right, e[1]);
}

/* ---- the choice ---- */

/* A direction and the speed that it allows. */
typedef struct Choice {
    JoxVector e;
    JoxFloats allowed;
} Choice;

static JoxVector walk_direction(uint32_t k) {
    return (JoxVector){jf_set(jox_walk_cosine[k]), jf_set(jox_walk_sine[k])};
}

/* Weights for comparing directions: progress along the way minus the cost of turning from the
   course. */
typedef struct Taste {
    JoxVector course;
    JoxFloats turn, right; /* m/s: cost of turning; bonus of the right side */
} Taste;

static Taste make_taste(const Packet *p) {
    const JoxWalkLaw *law = p->w->law;
    const JoxAgents *a = p->w->step.agents;
    return (Taste){rotate_to_aim(p, jv_load(a->course_x, a->course_y, p->first)),
                   (float)law->turn_cost * p->speed, (float)law->right * p->speed};
}

/* Returns the score of a direction; it never falls as `worth` grows. */
static inline JoxFloats score_direction(const Taste *t, uint32_t k, JoxVector e, JoxFloats worth) {
    const JoxFloats turning = 1.0f - jv_dot(e, t->course);
    worth = jf_max(worth, jf_set(WORST)) * jox_walk_cosine[k];
    worth -= t->turn * turning;
    if (jox_walk_sine[k] < 0.0f)
        worth += t->right;
    return worth;
}

/* The best direction so far, and its score. */
typedef struct Best {
    Choice choice;
    JoxFloats taste;
} Best;

static inline void offer_direction(Best *best, const Taste *t, uint32_t k, JoxVector e,
                                   Judgement j) {
    const JoxFloats worth = score_direction(t, k, e, j.worth);
    const JoxMask better = jf_lt(best->taste, worth);
    best->taste = jf_select(better, worth, best->taste);
    best->choice.e = jv_select(better, e, best->choice.e);
    best->choice.allowed = jf_select(better, j.allowed, best->choice.allowed);
}

/* Tries directions k and k + 1, one on either side. A direction that cannot be better for any of
   `lanes`, however much room neighbours leave, is not judged. */
static void try_sides(const Packet *p, uint32_t lanes, const JoxWalkTable *walls, const Taste *t,
                      uint32_t k, Best *best) {
    const JoxVector e[2] = {walk_direction(k), walk_direction(k + 1)};
    JoxFloats wall[2];
    uint32_t tried = 0;
    for (uint32_t d = 0; d < 2; d++) {
        wall[d] = walls ? jf_load(walls->allowed[k + d]) : jf_set(INFINITY);
        const JoxFloats most = score_direction(t, k + d, e[d], jf_min(p->speed, wall[d]));
        tried |= (uint32_t)((lanes & ~jm_bits(jf_le(most, best->taste))) != 0) << d;
    }
    Judgement j[2];
    if (tried == 3)
        judge_both(p, e, j);
    else if (tried)
        j[tried - 1] = judge_direction(p, e[tried - 1]);
    for (uint32_t d = 0; d < 2; d++)
        if (tried >> d & 1)
            offer_direction(
                best, t, k + d, e[d],
                (Judgement){jf_min(j[d].allowed, wall[d]), jf_min(j[d].worth, wall[d])});
}

/* Returns the best of all directions for `lanes`; `ahead` is the judgement of the first. */
static Choice choose_any(const Packet *p, uint32_t lanes, Judgement ahead,
                         const JoxWalkTable *walls) {
    const Taste t = make_taste(p);
    const JoxVector e = walk_direction(0);
    Best best = {{e, ahead.allowed}, score_direction(&t, 0, e, ahead.worth)};
    for (uint32_t k = 1; k < JOX_WALK_DIRECTIONS; k += 2)
        try_sides(p, lanes, walls, &t, k, &best);
    return best.choice;
}

/* Fills the table of speeds that walls allow; returns whether any of `lanes` is near a wall. */
static bool fill_wall_table(const Packet *p, uint32_t lanes, JoxWalkTable *table) {
    if (!lanes)
        return false;
    for (uint32_t k = 0; k < JOX_WALK_DIRECTIONS; k++)
        jf_store(table->allowed[k], jf_set(INFINITY));
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(lanes);
        JOX_WIDE(jox_walk_mind_walls)(p->w, p->first + lane, lane, table);
    }
    return true;
}

/* Takes straight on where it is nearly free, else the best of all directions. */
static Choice choose_direction(const Packet *p) {
    const JoxVector aim = walk_direction(0);
    const Judgement ahead = judge_direction(p, aim);
    const JoxMask straight = jf_le(AS_FREE * p->speed, ahead.worth);
    const uint32_t seek = p->lanes & ~jm_bits(straight);
    if (!seek)
        return (Choice){aim, ahead.allowed};
    JoxWalkTable table;
    const bool walls = fill_wall_table(p, seek & p->at_walls, &table);
    Choice best = choose_any(p, seek, ahead, walls ? &table : NULL);
    best.e = jv_select(straight, aim, best.e);
    best.allowed = jf_select(straight, ahead.allowed, best.allowed);
    return best;
}

/* ---- packets ---- */

/* Chooses direction and speed of one packet's walkers, and writes their columns. */
static void walk_packet(Packet *p) {
    JoxAgents *a = p->w->step.agents;
    const uint32_t i = p->first;
    p->aim = (JoxVector){jf_load(a->aim_x + i), jf_load(a->aim_y + i)};
    p->radius = jox_param_lanes(a, JOX_PARAM_radius, i);
    (jox_folds(a) ? put_rows_periodic : put_rows_bounded)(p);
    const Choice to = choose_direction(p);
    const JoxVector aim = p->aim;
    const JoxVector e = {to.e.x * aim.x - to.e.y * aim.y, to.e.x * aim.y + to.e.y * aim.x};
    const JoxVector velocity = jox_approach(p->w, i, e, to.allowed);
    const JoxVector course = jv_end_decay(jox_turn_course(p->w, i, e));
    float out[4][JOX_WIDTH];
    jf_store(out[0], velocity.x);
    jf_store(out[1], velocity.y);
    jf_store(out[2], course.x);
    jf_store(out[3], course.y);
    for (uint32_t lane = 0; p->lanes >> lane; lane++) {
        if (!(p->lanes >> lane & 1))
            continue;
        a->walk_x[i + lane] = out[0][lane];
        a->walk_y[i + lane] = out[1][lane];
        a->course_x[i + lane] = out[2][lane];
        a->course_y[i + lane] = out[3][lane];
    }
}

/* Finds the walkers of a packet that want to get on, and their tempers; walkers that only stand get
   velocity 0. */
static void begin_walk_packet(Packet *p, uint32_t first, uint32_t end) {
    JoxAgents *a = p->w->step.agents;
    const JoxWalkLaw *law = p->w->law;
    const JoxFloats zero = jf_set(0.0f), one = jf_set(1.0f);
    const JoxMask walk = jf_lt(zero, jox_param_lanes(a, JOX_PARAM_time_gap, first));
    const uint32_t walkers = jm_bits(walk) & jox_first_lanes(end - first);
    p->first = first;
    p->lanes = p->near_walls = p->at_walls = 0;
    if (!walkers)
        return;
    const JoxVector preferred = jv_load(a->pref_x, a->pref_y, first);
    const JoxFloats speed = jf_sqrt(jv_dot(preferred, preferred));
    float eager[JOX_WIDTH];
    const JoxFloats density = jox_density_lanes(p->w, first);
    p->eager = jox_eagerness(p->w, first, walkers, density);
    jf_store(eager, p->eager);
    p->lanes = walkers & ~jm_bits(jf_le(speed, zero));
    for (uint32_t lane = 0; walkers >> lane; lane++)
        if (walkers >> lane & 1) {
            a->eager[first + lane] = eager[lane];
            a->walk_x[first + lane] = a->walk_y[first + lane] = 0.0f;
        }
    if (!p->lanes)
        return;
    const JoxMask wants = jm_of_bits(p->lanes);
    p->gap = jf_select(wants, jox_time_gaps(p->w, first, p->lanes, p->eager), one);
    p->speed = jf_select(wants, speed, one);
    p->unhidden2 = jf_load(p->w->nav->unhidden2 + first);
    p->near_walls = p->lanes & jm_bits(jf_lt(p->unhidden2, jf_set(INFINITY)));
    const JoxFloats keep = (float)law->wall_reach * jox_outer_lanes(a, first);
    const JoxFloats reach = keep + p->speed * (float)p->w->law->wall_time;
    p->at_walls =
        p->near_walls & ~jm_bits(jox_wall_grid_clear_lanes(p->w->nav->unhidden2, first, reach));
    const JoxFloats foreseen = (float)law->ahead_share * p->gap;
    const JoxFloats flank = (float)law->flank / (one - (float)law->flank_eager * p->eager);
    p->beside2 = squared(flank) - one;
    p->cross = jox_cross_width(p->w, first, density);
    p->per_time = one / (p->gap + foreseen);
    p->per_cross = jf_set(1.0f / (float)law->cross_time);
    p->meeting = p->speed * (1.0f / (float)law->contact_time);
}

void JOX_WIDE(jox_walk_packets)(const JoxWalk *w, uint32_t begin, uint32_t end) {
    Packet packet = {.w = w};
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        begin_walk_packet(&packet, i, end);
        if (packet.lanes)
            walk_packet(&packet);
    }
}
