/* The kernel of the walking law (core/walking.md). A lane is an agent, a packet is JOX_WIDTH of
   them: whom each minds stands in rows, one of each lane in a row, as seen along its aim, and the
   directions are judged straight on first, then to the left and right at once, each for all lanes.
   One lane at a time are done people's tempers, whoever may stand behind a wall, and walls
   (walk_walls_wide.c). */
#include <math.h>

#include "agents/param_lanes.h"
#include "geom/wall_grid_lanes.h"
#include "nav/kernels.h"
#include "nav/walk_lanes.h"

static const float AS_FREE = 0.98f;  /* of the wanted speed: who gets that far goes straight on */
static const float WORST = -0.2f;    /* m/s: no direction is judged worse */
static const float NO_LIMIT = 64.0f; /* wanted speeds: what nobody ahead allows */

/* Directions, offsets and velocities of those minded are seen from each lane's agent: x along its
   aim, y to the left of it. */

/* One of those ahead, for each lane. Lanes without one have somebody behind, who allows all. */
typedef struct Ahead {
    JoxVector offset, foreseen; /* m: how far they are, and get in the time that is foreseen */
    JoxFloats distance2;        /* m2 */
    JoxFloats per_width2;       /* 1/m2, of the way */
    JoxFloats length;           /* m, that they take up along it */
} Ahead;

/* One of those who cross, for each lane. */
typedef struct Crossing {
    JoxMask there;
    JoxVector offset, velocity; /* m; m/s */
    JoxFloats width2, apart2;   /* m2, of the distance kept; left of it */
} Crossing;

typedef struct Packet {
    const JoxWalk *w;
    uint32_t first, lanes; /* agent of lane 0; bits of those who walk and want to get on */
    uint32_t near_walls;   /* of those, who may be behind or before a wall, */
    uint32_t at_walls;     /* and who may come to one soon */
    uint32_t ahead_count, crossing_count;
    JoxVector aim;
    JoxFloats speed, gap, eager, radius; /* m/s wanted; time gap, s */
    JoxFloats clear2;                    /* m2: no wall hides who is nearer */
    JoxFloats beside2;  /* weight of the square of the distance aside, beside the way, less 1 */
    JoxFloats per_time; /* 1/s: of the room behind those ahead */
    JoxFloats per_cross, meeting; /* 1/s; m/s2: worth of a way for each s until they would meet */
    Ahead ahead[JOX_MOST_NEIGHBOURS];
    Crossing crossing[JOX_MOST_NEIGHBOURS];
} Packet;

/* What a direction allows, and what it is worth, m/s. */
typedef struct Judgement {
    JoxFloats allowed, worth;
} Judgement;

static inline JoxFloats root(JoxFloats a) { /* 0 below 0 */
    return jf_sqrt(jf_max(a, jf_set(0.0f)));
}

static inline JoxFloats squared(JoxFloats a) {
    return a * a;
}

/* ---- whom one minds ---- */

/* Whom lanes mind: a bit for each of their neighbours, the nearest first. */
typedef struct Minded {
    JoxInts ahead, crossing;
} Minded;

/* From each lane's agent to another. */
static inline __attribute__((always_inline)) JoxVector
offset_of(const Packet *p, const JoxFloats *record, const bool periodic) {
    const JoxAgents *a = p->w->agents;
    JoxVector offset = jv_sub((JoxVector){record[0], record[1]}, jv_load(a->x, a->y, p->first));
    if (periodic) {
        offset.x = jf_wrap(offset.x, a->period.x);
        offset.y = jf_wrap(offset.y, a->period.y);
    }
    return offset;
}

/* Of `lanes`, those that pass their neighbour over: they ignore it, or a wall hides it. */
static uint32_t passed_over(const Packet *p, uint32_t lanes, JoxInts others, JoxVector offset) {
    const JoxAgents *a = p->w->agents;
    uint32_t index[JOX_WIDTH], passed = 0;
    float x[JOX_WIDTH], y[JOX_WIDTH];
    ji_store(index, others);
    jv_store(x, y, 0, offset);
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(lanes), i = p->first + lane;
        if ((a->tags[index[lane]] & a->ignore[i]) || jox_is_close_to(a, i, index[lane]) ||
            ((p->near_walls >> lane & 1) &&
             jox_nav_is_behind_wall(p->w->nav, (JoxV2){a->x[i], a->y[i]},
                                    (JoxV2){x[lane], y[lane]})))
            passed |= 1u << lane;
    }
    return passed;
}

static inline __attribute__((always_inline)) Minded minded_of(const Packet *p,
                                                              const bool periodic) {
    const JoxAgents *a = p->w->agents;
    const JoxNeighbours *n = p->w->neighbours;
    const JoxInts none = ji_set(0);
    const uint32_t i = p->first;
    const JoxMask wants = jm_of_bits(p->lanes);
    const JoxInts counts = ji_select(wants, ji_load_bytes(n->count + i), none);
    const uint32_t picky = jox_picky_lanes(a, i);
    Minded minded = {none, none};
    JoxMask there;
    for (uint32_t k = 0; jm_bits(there = ji_less(ji_set((int32_t)k), counts)); k++) {
        const JoxInts others =
            ji_select(there, ji_load(n->index + jox_neighbour_at(n, i, k)), none);
        JoxFloats record[4];
        jf_records(&n->motions[0].x, others, record);
        const JoxVector offset = offset_of(p, record, periodic);
        JoxFloats heading[4];
        jf_records(&p->w->nav->headings[0].aim_x, others, heading);
        const JoxMindsLanes how = jox_minds_lanes(a, i, others, heading, offset);
        const JoxMask hidden = jf_le(p->clear2, jv_dot(offset, offset));
        JoxMask minds = jm_and(there, jm_or(how.ahead, how.crossing));
        const uint32_t doubtful = jm_bits(minds) & (picky | jm_bits(hidden));
        if (doubtful)
            minds = jm_without(minds, jm_of_bits(passed_over(p, doubtful, others, offset)));
        const JoxInts bit = ji_set((int32_t)(1u << k));
        minded.ahead = ji_or(minded.ahead, ji_select(jm_and(minds, how.ahead), bit, none));
        minded.crossing = ji_or(minded.crossing, ji_select(jm_and(minds, how.crossing), bit, none));
    }
    return minded;
}

/* One neighbour of each lane. */
typedef struct Next {
    JoxMask there; /* else agent 0 stands for it */
    JoxVector offset, velocity;
    JoxFloats radii; /* sum of both, m */
} Next;

/* A vector, as seen along the aims. */
static JoxVector as_seen(const Packet *p, JoxVector v) {
    const JoxVector aim = p->aim;
    return (JoxVector){jv_dot(v, aim), aim.x * v.y - aim.y * v.x};
}

/* Takes the nearest out of those left; false where nobody is left of any lane. */
static inline __attribute__((always_inline)) bool take(const Packet *p, JoxInts *left, Next *next,
                                                       const bool periodic) {
    const JoxAgents *a = p->w->agents;
    const JoxNeighbours *n = p->w->neighbours;
    const JoxInts none = ji_set(0), one = ji_set(1);
    next->there = ji_less(none, *left);
    if (!jm_bits(next->there))
        return false;
    const JoxInts lowest = ji_select(next->there, ji_and(*left, ji_sub(none, *left)), one);
    const JoxInts rank = /* a power of 2, as the exponent of a float */
        ji_sub(ji_shift_right(jf_bits(ji_to_floats(lowest)), 23), ji_set(127));
    const JoxInts at = ji_add(ji_shift_left(rank, 4), ji_lane());
    _Static_assert(JOX_LANES == 1 << 4, "a row of neighbours has as many entries");
    *left = ji_and(*left, ji_sub(*left, one));
    const JoxInts others =
        ji_select(next->there, ji_pick(n->index + jox_neighbour_at(n, p->first, 0), at), none);
    JoxFloats record[4];
    jf_records(&n->motions[0].x, others, record);
    next->offset = as_seen(p, offset_of(p, record, periodic));
    next->velocity = as_seen(p, (JoxVector){record[2], record[3]});
    next->radii = p->radius + jox_param_pick(a->param[JOX_PARAM_radius], others);
    return true;
}

static inline __attribute__((always_inline)) void put_rows(Packet *p, const bool periodic) {
    const JoxWalkLaw *law = p->w->law;
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxFloats room = one - (float)law->room_eager * p->eager;
    const JoxFloats width = (float)law->width * room;
    const JoxFloats length = (float)law->length * room;
    const JoxFloats foreseen = (float)law->ahead_share * p->gap;
    const JoxVector behind = {jf_set(-1.0f), zero};
    Minded left = minded_of(p, periodic);
    Next next;
    for (p->ahead_count = 0; take(p, &left.ahead, &next, periodic); p->ahead_count++) {
        p->ahead[p->ahead_count] = (Ahead){.offset = jv_select(next.there, next.offset, behind),
                                           .foreseen = jv_scale(next.velocity, foreseen),
                                           .distance2 = jv_dot(next.offset, next.offset),
                                           .per_width2 = squared(one / (width * next.radii)),
                                           .length = length * next.radii};
    }
    for (p->crossing_count = 0; take(p, &left.crossing, &next, periodic); p->crossing_count++) {
        const JoxFloats width2 = squared((float)law->width_cross * next.radii);
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

/* What somebody ahead leaves free, m, who is so far along a direction and aside of it, and gets so
   far along it in the time that is foreseen. In the way they take up their length, less towards
   their sides. Beside it, within 60 degrees ahead, the distance counts in which aside weighs more.
 */
static inline JoxFloats room_behind(const Packet *p, const Ahead *o, JoxFloats along,
                                    JoxFloats aside, JoxFloats foreseen) {
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxFloats slope = jf_set(1.7320508f); /* tangent of 60 degrees */
    const JoxFloats aside2 = squared(aside), q2 = aside2 * o->per_width2;
    const JoxMask in_way = jf_lt(q2, one);
    const JoxFloats beside = o->distance2 + p->beside2 * aside2;
    const JoxFloats round = one - squared(q2) * q2; /* in the way at least 0 */
    const JoxFloats length = jf_sqrt(jf_select(in_way, round, beside));
    const JoxFloats gap = jf_select(in_way, along - o->length * length, length - o->length);
    const JoxMask minded =
        jm_or(jm_and(in_way, jf_lt(zero, along)), jf_lt(jf_abs(aside), slope * along));
    return jf_select(minded, gap + jf_max(foreseen, zero), jf_set(INFINITY));
}

/* People come down gradually from the wanted speed to what those ahead allow. */
static inline JoxFloats ease(const Packet *p, JoxFloats allowed) {
    const JoxFloats one = jf_set(1.0f);
    JoxFloats most = jf_min(allowed, NO_LIMIT * p->speed);
    JoxFloats share = (float)p->w->law->ease * most / p->speed;
    JoxFloats eased = most / jf_sqrt(jf_sqrt(one + squared(squared(share))));
    return jf_select(jf_lt(jf_set(0.0f), most), eased, most);
}

/* Who crosses leaves a free path, and a direction in which the two would meet soon is worth less.
 */
static inline void cross(const Packet *p, const Crossing *o, JoxVector e, Judgement *j) {
    const JoxFloats zero = jf_set(0.0f), none = jf_set(INFINITY);
    const JoxFloats along = jv_dot(o->offset, e);
    const JoxFloats aside = e.x * o->offset.y - e.y * o->offset.x;
    const JoxFloats rest = o->width2 - squared(aside);
    const JoxMask in_way = jm_and(jm_and(jf_lt(zero, rest), jf_lt(zero, along)), o->there);
    const JoxFloats path = (along - root(rest)) * p->per_cross;
    j->allowed = jf_min(j->allowed, jf_select(in_way, path, none));
    /* When their discs meet, at the wanted speed and the other's present velocity. */
    const JoxVector u = {p->speed * e.x - o->velocity.x, p->speed * e.y - o->velocity.y};
    const JoxFloats closing = jv_dot(o->offset, u), u2 = jv_dot(u, u);
    const JoxFloats meets = squared(closing) - u2 * o->apart2;
    const JoxFloats time = (closing - root(meets)) / jf_max(u2, jf_set(1e-6f));
    const JoxMask soon = jm_and(jm_and(jf_lt(zero, meets), jf_lt(zero, closing)), o->there);
    j->worth = jf_min(j->worth, jf_select(soon, p->meeting * time, none));
}

/* Of a direction in which those ahead leave so much room, m: the speed that keeps the time gap. */
static Judgement judgement(const Packet *p, JoxFloats room, JoxVector e) {
    Judgement j = {p->speed, p->speed};
    for (uint32_t k = 0; k < p->crossing_count; k++)
        cross(p, &p->crossing[k], e, &j);
    j.allowed = jf_min(j.allowed, ease(p, room * p->per_time));
    j.worth = jf_min(j.worth, j.allowed);
    return j;
}

static Judgement judge(const Packet *p, JoxVector e) {
    JoxFloats room = jf_set(INFINITY);
    for (uint32_t k = 0; k < p->ahead_count; k++) {
        const Ahead *o = &p->ahead[k];
        const JoxFloats aside = e.x * o->offset.y - e.y * o->offset.x;
        room = jf_min(room, room_behind(p, o, jv_dot(e, o->offset), aside, jv_dot(e, o->foreseen)));
    }
    return judgement(p, room, e);
}

/* Directions as far to the left and to the right: they share what they are judged by. */
static void judge_both(const Packet *p, const JoxVector e[2], Judgement out[2]) {
    const JoxFloats cosine = e[0].x, sine = e[0].y;
    JoxFloats left = jf_set(INFINITY), right = left;
    for (uint32_t k = 0; k < p->ahead_count; k++) {
        const Ahead *o = &p->ahead[k];
        const JoxVector ahead = jv_scale(o->offset, cosine), turned = jv_scale(o->offset, sine);
        const JoxFloats moves = cosine * o->foreseen.x, turns = sine * o->foreseen.y;
        left =
            jf_min(left, room_behind(p, o, ahead.x + turned.y, ahead.y - turned.x, moves + turns));
        right =
            jf_min(right, room_behind(p, o, ahead.x - turned.y, ahead.y + turned.x, moves - turns));
    }
    out[0] = judgement(p, left, e[0]);
    out[1] = judgement(p, right, e[1]);
}

/* ---- the choice ---- */

/* A direction and what it allows. */
typedef struct Choice {
    JoxVector e;
    JoxFloats allowed;
} Choice;

static JoxVector direction(uint32_t k) {
    return (JoxVector){jf_set(jox_walk_cosine[k]), jf_set(jox_walk_sine[k])};
}

/* What directions are compared by: how one gets on along the way, less what turning from the course
   costs. */
typedef struct Taste {
    JoxVector course;
    JoxFloats turn, right; /* m/s: cost of turning, worth of the right */
} Taste;

static Taste taste_of(const Packet *p) {
    const JoxWalkLaw *law = p->w->law;
    const JoxAgents *a = p->w->agents;
    return (Taste){as_seen(p, jv_load(a->course_x, a->course_y, p->first)),
                   (float)law->turn_cost * p->speed, (float)law->right * p->speed};
}

/* Never falls as `worth` grows. */
static inline JoxFloats taste(const Taste *t, uint32_t k, JoxVector e, JoxFloats worth) {
    const JoxFloats turning = 1.0f - jv_dot(e, t->course);
    worth = jf_max(worth, jf_set(WORST)) * jox_walk_cosine[k];
    worth -= t->turn * turning;
    if (jox_walk_sine[k] < 0.0f)
        worth += t->right;
    return worth;
}

/* The best so far. */
typedef struct Best {
    Choice choice;
    JoxFloats taste;
} Best;

static inline void offer(Best *best, const Taste *t, uint32_t k, JoxVector e, Judgement j) {
    const JoxFloats worth = taste(t, k, e, j.worth);
    const JoxMask better = jf_lt(best->taste, worth);
    best->taste = jf_select(better, worth, best->taste);
    best->choice.e = jv_select(better, e, best->choice.e);
    best->choice.allowed = jf_select(better, j.allowed, best->choice.allowed);
}

/* Directions k and k + 1, to either side. One that is no better for any of `lanes`, whatever people
   leave of it, is not judged. */
static void try_sides(const Packet *p, uint32_t lanes, const JoxWalkTable *walls, const Taste *t,
                      uint32_t k, Best *best) {
    const JoxVector e[2] = {direction(k), direction(k + 1)};
    JoxFloats wall[2];
    uint32_t asked = 0;
    for (uint32_t d = 0; d < 2; d++) {
        wall[d] = walls ? jf_load(walls->allowed[k + d]) : jf_set(INFINITY);
        const JoxFloats most = taste(t, k + d, e[d], jf_min(p->speed, wall[d]));
        asked |= (uint32_t)((lanes & ~jm_bits(jf_le(most, best->taste))) != 0) << d;
    }
    Judgement j[2];
    if (asked == 3)
        judge_both(p, e, j);
    else if (asked)
        j[asked - 1] = judge(p, e[asked - 1]);
    for (uint32_t d = 0; d < 2; d++)
        if (asked >> d & 1)
            offer(best, t, k + d, e[d],
                  (Judgement){jf_min(j[d].allowed, wall[d]), jf_min(j[d].worth, wall[d])});
}

/* The best of all directions, for `lanes`; what the first is worth is known. */
static Choice best_of(const Packet *p, uint32_t lanes, Judgement ahead, const JoxWalkTable *walls) {
    const Taste t = taste_of(p);
    const JoxVector e = direction(0);
    Best best = {{e, ahead.allowed}, taste(&t, 0, e, ahead.worth)};
    for (uint32_t k = 1; k < JOX_WALK_DIRECTIONS; k += 2)
        try_sides(p, lanes, walls, &t, k, &best);
    return best.choice;
}

/* Whether walls are about any of `lanes`, and what they allow. */
static bool mind_walls(const Packet *p, uint32_t lanes, JoxWalkTable *table) {
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

/* Straight on where that is as good as free, else the best of all directions. */
static Choice choose(const Packet *p) {
    const JoxVector aim = direction(0);
    const Judgement ahead = judge(p, aim);
    const JoxMask straight = jf_le(AS_FREE * p->speed, ahead.worth);
    const uint32_t seek = p->lanes & ~jm_bits(straight);
    if (!seek)
        return (Choice){aim, ahead.allowed};
    JoxWalkTable table;
    const bool walls = mind_walls(p, seek & p->at_walls, &table);
    Choice best = best_of(p, seek, ahead, walls ? &table : NULL);
    best.e = jv_select(straight, aim, best.e);
    best.allowed = jf_select(straight, ahead.allowed, best.allowed);
    return best;
}

/* ---- packets ---- */

static void walk_packet(Packet *p) {
    JoxAgents *a = p->w->agents;
    const uint32_t i = p->first;
    p->aim = (JoxVector){jf_load(a->aim_x + i), jf_load(a->aim_y + i)};
    p->radius = jox_param_lanes(a, JOX_PARAM_radius, i);
    (a->period.x > 0.0f || a->period.y > 0.0f ? put_rows_periodic : put_rows_bounded)(p);
    const Choice to = choose(p);
    const JoxVector aim = p->aim;
    const JoxVector e = {to.e.x * aim.x - to.e.y * aim.y, to.e.x * aim.y + to.e.y * aim.x};
    const JoxVector velocity = jox_approach(p->w, i, e, to.allowed);
    const JoxVector course = jox_turn_course(p->w, i, e);
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

/* Who of the packet walks and wants to get on, with what temper; who only stands wants nothing. */
static void begin_packet(Packet *p, uint32_t first, uint32_t end) {
    JoxAgents *a = p->w->agents;
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
    p->eager = jox_eagerness(p->w, first);
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
    p->clear2 = jf_load(p->w->nav->clear2 + first);
    p->near_walls = p->lanes & jm_bits(jf_lt(p->clear2, jf_set(INFINITY)));
    const JoxFloats keep =
        (float)p->w->law->wall_radius * jox_param_lanes(a, JOX_PARAM_radius, first);
    const JoxFloats reach = keep + p->speed * (float)p->w->law->wall_time;
    p->at_walls =
        p->near_walls & ~jm_bits(jox_wall_grid_clear_lanes(p->w->nav->clear2, first, reach));
    const JoxFloats foreseen = (float)law->ahead_share * p->gap;
    const JoxFloats flank = (float)law->flank / (one - (float)law->flank_eager * p->eager);
    p->beside2 = squared(flank) - one;
    p->per_time = one / (p->gap + foreseen);
    p->per_cross = jf_set(1.0f / (float)law->cross_time);
    p->meeting = p->speed * (1.0f / (float)law->contact_time);
}

void JOX_WIDE(jox_walk_packets)(const JoxWalk *w, uint32_t begin, uint32_t end) {
    Packet packet = {.w = w};
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        begin_packet(&packet, i, end);
        if (packet.lanes)
            walk_packet(&packet);
    }
}
