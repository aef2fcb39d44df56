/* The kernel of the walking law (core/walking.md). A lane is an agent, a packet is JOX_WIDTH of
   them: whom each minds stands in rows, one of each lane in a row, and the directions are judged
   straight on first, then two by two, each for all lanes. One lane at a time are done people's
   tempers, whoever may stand behind a wall, and walls (walk_walls_wide.c). */
#include <math.h>

#include "agents/param_lanes.h"
#include "geom/wall_grid_lanes.h"
#include "nav/kernels.h"
#include "nav/walk_lanes.h"

static const float AS_FREE = 0.98f;  /* of the wanted speed: who gets that far goes straight on */
static const float WORST = -0.2f;    /* m/s: no direction is judged worse */
static const float NO_LIMIT = 64.0f; /* wanted speeds: what nobody ahead allows */

/* Whom each lane minds: one that goes first, or one that crosses, or nobody. */
typedef struct Row {
    JoxVector offset, velocity;  /* m; m/s */
    JoxFloats per_width, length; /* of one ahead: 1/m, of the way; m, that they take up along it */
    JoxFloats width2, apart2;    /* m2, of one who crosses: of the distance kept; left of it */
    JoxMask ahead, crossing;
} Row;

typedef struct Packet {
    const JoxWalk *w;
    uint32_t first, lanes; /* agent of lane 0; bits of those who walk and want to get on */
    uint32_t near_walls;   /* of those, who may be behind or before a wall, */
    uint32_t at_walls;     /* and who may come to one soon */
    uint32_t rows;
    bool any_crosses; /* somebody in some row */
    JoxVector aim;
    JoxFloats speed, gap, eager, radius; /* m/s wanted; time gap, s */
    JoxFloats clear2;                    /* m2: no wall hides who is nearer */
    JoxFloats per_cross, meeting; /* 1/s; m/s2: worth of a way for each s until they would meet */
    Row row[JOX_MOST_NEIGHBOURS];
} Packet;

/* What a direction allows, and what it is worth, m/s. */
typedef struct Judgement {
    JoxFloats allowed, worth;
} Judgement;

static inline JoxFloats root(JoxFloats a) { /* 0 below 0 */
    return jf_sqrt(jf_max(a, jf_set(0.0f)));
}

static inline JoxFloats squared(JoxFloats a) {
    return jf_mul(a, a);
}

/* ---- whom one minds ---- */

/* Those whom lanes mind, each lane's one after the other: indices with what is told by two bits. */
typedef uint32_t Minded[(JOX_MOST_NEIGHBOURS + 1) * JOX_WIDTH]; /* a row more: behind full lists */
#define AHEAD (1u << 31)
#define CROSSING (1u << 30) /* there are less agents */

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

/* Lists whom lanes mind; returns how many rows that makes. Neighbours come row by row, and who is
   minded goes to the end of its lane's list: of others, what follows takes the place. */
static inline __attribute__((always_inline)) uint32_t list_minded(const Packet *p, Minded minded,
                                                                  const bool periodic) {
    const JoxAgents *a = p->w->agents;
    const JoxNeighbours *n = p->w->neighbours;
    const uint32_t i = p->first;
    uint32_t counts[JOX_WIDTH], lanes[JOX_WIDTH], ends[JOX_WIDTH], entries[JOX_WIDTH];
    uint32_t most = 0, picky = 0, rows = 0;
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++) {
        lanes[lane] = lane;
        counts[lane] = p->lanes >> lane & 1 ? n->count[i + lane] : 0;
        most = counts[lane] > most ? counts[lane] : most;
        if ((p->lanes >> lane & 1) && (a->ignore[i + lane] || jox_is_close_to_some(a, i + lane)))
            picky |= 1u << lane;
    }
    JoxInts end = ji_load(lanes);
    for (uint32_t k = 0; k < most; k++) {
        const JoxMask there = ji_less(ji_set((int32_t)k), ji_load(counts));
        const JoxInts none = ji_set(0);
        const JoxInts others =
            ji_select(there, ji_load(n->index + jox_neighbour_at(n, i, k)), none);
        JoxFloats record[4];
        jf_records(&p->w->neighbours->motions[0].x, others, record);
        const JoxVector offset = offset_of(p, record, periodic);
        const JoxMindsLanes how = jox_minds_lanes(p->w->nav, a, i, others, offset);
        uint32_t minds = jm_bits(there) & jm_bits(jm_or(how.ahead, how.crossing));
        const JoxMask hidden = jf_le(p->clear2, jv_dot(offset, offset));
        const uint32_t doubtful = minds & (picky | jm_bits(hidden));
        if (doubtful)
            minds &= ~passed_over(p, doubtful, others, offset);
        const JoxMask listed = jm_of_bits(minds);
        const JoxInts ahead = ji_select(how.ahead, ji_set((int32_t)AHEAD), none);
        const JoxInts crossing = ji_select(how.crossing, ji_set((int32_t)CROSSING), none);
        const JoxInts told = ji_select(listed, ji_or(ahead, crossing), none);
        ji_store(entries, ji_or(others, told));
        ji_store(ends, end);
        for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
            minded[ends[lane]] = entries[lane];
        end = ji_select(listed, ji_add(end, ji_set(JOX_WIDTH)), end);
    }
    ji_store(ends, end);
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        rows = ends[lane] / JOX_WIDTH > rows ? ends[lane] / JOX_WIDTH : rows;
    return rows;
}

static inline __attribute__((always_inline)) void put_rows(Packet *p, const bool periodic) {
    const JoxAgents *a = p->w->agents;
    const JoxWalkLaw *law = p->w->law;
    const JoxFloats one = jf_set(1.0f);
    const JoxFloats room = jf_sub(one, jf_mul(jf_set((float)law->room_eager), p->eager));
    const JoxFloats width = jf_mul(jf_set((float)law->width), room);
    const JoxFloats length = jf_mul(jf_set((float)law->length), room);
    Minded minded = {0};
    JoxMask crossing = jm_of_bits(0);
    p->rows = list_minded(p, minded, periodic);
    for (uint32_t k = 0; k < p->rows; k++) {
        const JoxInts entry = ji_load(minded + k * JOX_WIDTH);
        const JoxInts others = ji_and(entry, ji_set((int32_t)(CROSSING - 1)));
        Row *row = &p->row[k];
        JoxFloats record[4];
        jf_records(&p->w->neighbours->motions[0].x, others, record);
        row->offset = offset_of(p, record, periodic);
        row->velocity = (JoxVector){record[2], record[3]};
        const JoxFloats radii =
            jf_add(p->radius, jox_param_pick(a->param[JOX_PARAM_radius], others));
        const JoxFloats d2 = jv_dot(row->offset, row->offset);
        row->per_width = jf_div(one, jf_mul(width, radii));
        row->length = jf_mul(length, radii);
        row->width2 = squared(jf_mul(jf_set((float)law->width_cross), radii));
        row->apart2 = jf_max(jf_sub(d2, row->width2), jf_set(0.0f));
        row->ahead = ji_less(entry, ji_set(0));
        row->crossing = ji_less(ji_shift_left(entry, 1), ji_set(0));
        crossing = jm_or(crossing, row->crossing);
    }
    p->any_crosses = jm_bits(crossing) != 0;
}

static void put_rows_bounded(Packet *p) {
    put_rows(p, false);
}

static void put_rows_periodic(Packet *p) {
    put_rows(p, true);
}

/* ---- what a direction allows ---- */

/* What of an agent counts for all of those ahead of it. */
typedef struct Follow {
    JoxFloats flank;    /* weight of the distance aside of those beside the way */
    JoxFloats foreseen; /* s for which their motion is foreseen */
    JoxFloats per_time; /* 1/s */
} Follow;

static Follow follow_of(const Packet *p) {
    const JoxWalkLaw *law = p->w->law;
    const JoxFloats one = jf_set(1.0f), foreseen = jf_mul(jf_set((float)law->ahead_share), p->gap);
    const JoxFloats minded = jf_sub(one, jf_mul(jf_set((float)law->flank_eager), p->eager));
    return (Follow){jf_div(jf_set((float)law->flank), minded), foreseen,
                    jf_div(one, jf_add(p->gap, foreseen))};
}

/* Speed along `e` that keeps the time gap to those ahead. In the way they take up their length,
   less towards their sides. Beside it, within 60 degrees ahead, the distance counts in which aside
   weighs more. Their own speed along the direction is foreseen for a share of the time gap. */
static inline JoxFloats follow(const Follow *f, const Row *row, JoxVector e) {
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxFloats slope = jf_set(1.7320508f); /* tangent of 60 degrees */
    const JoxFloats along = jv_dot(row->offset, e);
    const JoxFloats aside = jf_abs(jf_sub(jf_mul(e.x, row->offset.y), jf_mul(e.y, row->offset.x)));
    const JoxFloats q = jf_mul(aside, row->per_width), q2 = squared(q);
    const JoxMask in_way = jf_lt(q, one);
    const JoxFloats beside = jf_add(squared(along), squared(jf_mul(f->flank, aside)));
    const JoxFloats round = jf_sub(one, jf_mul(squared(q2), q2)); /* in the way at least 0 */
    const JoxFloats length = jf_sqrt(jf_select(in_way, round, beside));
    const JoxFloats gap =
        jf_select(in_way, jf_sub(along, jf_mul(row->length, length)), jf_sub(length, row->length));
    const JoxFloats speed = jf_max(jv_dot(row->velocity, e), zero);
    const JoxFloats allowed = jf_mul(jf_add(gap, jf_mul(f->foreseen, speed)), f->per_time);
    JoxMask minded = jm_or(in_way, jf_lt(aside, jf_mul(slope, along)));
    minded = jm_and(jm_and(minded, jf_lt(zero, along)), row->ahead);
    return jf_select(minded, allowed, jf_set(INFINITY));
}

/* People come down gradually from the wanted speed to what those ahead allow. */
static inline JoxFloats ease(const Packet *p, JoxFloats allowed) {
    const JoxFloats one = jf_set(1.0f);
    JoxFloats most = jf_min(allowed, jf_mul(jf_set(NO_LIMIT), p->speed));
    JoxFloats share = jf_div(jf_mul(jf_set((float)p->w->law->ease), most), p->speed);
    JoxFloats eased = jf_div(most, jf_sqrt(jf_sqrt(jf_add(one, squared(squared(share))))));
    return jf_select(jf_lt(jf_set(0.0f), most), eased, most);
}

/* Who crosses leaves a free path, and a direction in which the two would meet soon is worth less.
 */
static inline void cross(const Packet *p, const Row *row, JoxVector e, Judgement *j) {
    const JoxFloats zero = jf_set(0.0f), none = jf_set(INFINITY);
    const JoxFloats along = jv_dot(row->offset, e);
    const JoxFloats aside = jf_sub(jf_mul(e.x, row->offset.y), jf_mul(e.y, row->offset.x));
    const JoxFloats rest = jf_sub(row->width2, squared(aside));
    const JoxMask in_way = jm_and(jm_and(jf_lt(zero, rest), jf_lt(zero, along)), row->crossing);
    const JoxFloats path = jf_mul(jf_sub(along, root(rest)), p->per_cross);
    j->allowed = jf_min(j->allowed, jf_select(in_way, path, none));
    /* When their discs meet, at the wanted speed and the other's present velocity. */
    const JoxVector u = {jf_sub(jf_mul(p->speed, e.x), row->velocity.x),
                         jf_sub(jf_mul(p->speed, e.y), row->velocity.y)};
    const JoxFloats closing = jv_dot(row->offset, u), u2 = jv_dot(u, u);
    const JoxFloats meets = jf_sub(squared(closing), jf_mul(u2, row->apart2));
    const JoxFloats time = jf_div(jf_sub(closing, root(meets)), jf_max(u2, jf_set(1e-6f)));
    const JoxMask soon = jm_and(jm_and(jf_lt(zero, meets), jf_lt(zero, closing)), row->crossing);
    j->worth = jf_min(j->worth, jf_select(soon, jf_mul(p->meeting, time), none));
}

/* Of a direction in which those ahead allow the speed `followed`. */
static Judgement judgement(const Packet *p, JoxFloats followed, JoxVector e) {
    Judgement j = {p->speed, p->speed};
    for (uint32_t k = 0; k < p->rows && p->any_crosses; k++)
        if (jm_bits(p->row[k].crossing))
            cross(p, &p->row[k], e, &j);
    j.allowed = jf_min(j.allowed, ease(p, followed));
    j.worth = jf_min(j.worth, j.allowed);
    return j;
}

static Judgement judge(const Packet *p, const Follow *f, JoxVector e) {
    JoxFloats followed = jf_set(INFINITY);
    for (uint32_t k = 0; k < p->rows; k++) {
        const Row *row = &p->row[k];
        if (jm_bits(row->ahead))
            followed = jf_min(followed, follow(f, row, e));
    }
    return judgement(p, followed, e);
}

/* Two directions at once: neither waits for the other. */
static void judge_both(const Packet *p, const Follow *f, const JoxVector e[2], Judgement out[2]) {
    JoxFloats one = jf_set(INFINITY), other = one;
    for (uint32_t k = 0; k < p->rows; k++) {
        const Row *row = &p->row[k];
        if (!jm_bits(row->ahead))
            continue;
        one = jf_min(one, follow(f, row, e[0]));
        other = jf_min(other, follow(f, row, e[1]));
    }
    out[0] = judgement(p, one, e[0]);
    out[1] = judgement(p, other, e[1]);
}

/* ---- the choice ---- */

/* A direction and what it allows. */
typedef struct Choice {
    JoxVector e;
    JoxFloats allowed;
} Choice;

static JoxVector turned(JoxVector aim, uint32_t k) {
    const JoxFloats cosine = jf_set(jox_walk_cosine[k]), sine = jf_set(jox_walk_sine[k]);
    return (JoxVector){jf_sub(jf_mul(cosine, aim.x), jf_mul(sine, aim.y)),
                       jf_add(jf_mul(cosine, aim.y), jf_mul(sine, aim.x))};
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
    return (Taste){{jf_load(a->course_x + p->first), jf_load(a->course_y + p->first)},
                   jf_mul(jf_set((float)law->turn_cost), p->speed),
                   jf_mul(jf_set((float)law->right), p->speed)};
}

/* Never falls as `worth` grows. */
static inline JoxFloats taste(const Taste *t, uint32_t k, JoxVector e, JoxFloats worth) {
    const JoxFloats turning = jf_sub(jf_set(1.0f), jv_dot(e, t->course));
    worth = jf_mul(jf_max(worth, jf_set(WORST)), jf_set(jox_walk_cosine[k]));
    worth = jf_sub(worth, jf_mul(t->turn, turning));
    return jox_walk_sine[k] < 0.0f ? jf_add(worth, t->right) : worth;
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
static void try_sides(const Packet *p, const Follow *f, uint32_t lanes, const JoxWalkTable *walls,
                      const Taste *t, uint32_t k, Best *best) {
    const JoxVector e[2] = {turned(p->aim, k), turned(p->aim, k + 1)};
    JoxFloats wall[2];
    uint32_t asked = 0;
    for (uint32_t d = 0; d < 2; d++) {
        wall[d] = walls ? jf_load(walls->allowed[k + d]) : jf_set(INFINITY);
        const JoxFloats most = taste(t, k + d, e[d], jf_min(p->speed, wall[d]));
        asked |= (uint32_t)((lanes & ~jm_bits(jf_le(most, best->taste))) != 0) << d;
    }
    Judgement j[2];
    if (asked == 3)
        judge_both(p, f, e, j);
    else if (asked)
        j[asked - 1] = judge(p, f, e[asked - 1]);
    for (uint32_t d = 0; d < 2; d++)
        if (asked >> d & 1)
            offer(best, t, k + d, e[d],
                  (Judgement){jf_min(j[d].allowed, wall[d]), jf_min(j[d].worth, wall[d])});
}

/* The best of all directions, for `lanes`; what the first is worth is known. */
static Choice best_of(const Packet *p, const Follow *f, uint32_t lanes, Judgement ahead,
                      const JoxWalkTable *walls) {
    const Taste t = taste_of(p);
    const JoxVector e = turned(p->aim, 0);
    Best best = {{e, ahead.allowed}, taste(&t, 0, e, ahead.worth)};
    for (uint32_t k = 1; k < JOX_WALK_DIRECTIONS; k += 2)
        try_sides(p, f, lanes, walls, &t, k, &best);
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
    const Follow f = follow_of(p);
    const Judgement ahead = judge(p, &f, p->aim);
    const JoxMask straight = jf_le(jf_mul(jf_set(AS_FREE), p->speed), ahead.worth);
    const uint32_t seek = p->lanes & ~jm_bits(straight);
    if (!seek)
        return (Choice){p->aim, ahead.allowed};
    JoxWalkTable table;
    const bool walls = mind_walls(p, seek & p->at_walls, &table);
    Choice best = best_of(p, &f, seek, ahead, walls ? &table : NULL);
    best.e = jv_select(straight, p->aim, best.e);
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
    const JoxVector velocity = jox_approach(p->w, i, to.e, to.allowed);
    const JoxVector course = jox_turn_course(p->w, i, to.e);
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

/* Agents of a packet, the lanes before `end`. */
static inline uint32_t lanes_before(uint32_t first, uint32_t end) {
    return end - first < JOX_WIDTH ? (1u << (end - first)) - 1 : ~0u >> (32 - JOX_WIDTH);
}

/* Who of the packet walks and wants to get on, with what temper; who only stands wants nothing. */
static void begin_packet(Packet *p, uint32_t first, uint32_t end) {
    JoxAgents *a = p->w->agents;
    const JoxFloats zero = jf_set(0.0f), one = jf_set(1.0f);
    const JoxMask walk = jf_lt(zero, jox_param_lanes(a, JOX_PARAM_time_gap, first));
    const uint32_t walkers = jm_bits(walk) & lanes_before(first, end);
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
    p->gap = jf_select(wants, jox_time_gaps(p->w, first, p->eager), one);
    p->speed = jf_select(wants, speed, one);
    p->clear2 = jf_load(p->w->nav->clear2 + first);
    p->near_walls = p->lanes & jm_bits(jf_lt(p->clear2, jf_set(INFINITY)));
    const JoxFloats keep =
        jf_mul(jf_set((float)p->w->law->wall_radius), jox_param_lanes(a, JOX_PARAM_radius, first));
    const JoxFloats reach = jf_add(keep, jf_mul(p->speed, jf_set((float)p->w->law->wall_time)));
    p->at_walls =
        p->near_walls & ~jm_bits(jox_wall_grid_clear_lanes(p->w->nav->clear2, first, reach));
    p->per_cross = jf_set(1.0f / (float)p->w->law->cross_time);
    p->meeting = jf_mul(p->speed, jf_set(1.0f / (float)p->w->law->contact_time));
}

void JOX_WIDE(jox_walk_packets)(const JoxWalk *w, uint32_t begin, uint32_t end) {
    Packet packet = {.w = w};
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        begin_packet(&packet, i, end);
        if (packet.lanes)
            walk_packet(&packet);
    }
}

/* ---- where everybody heads ---- */

float JOX_WIDE(jox_walk_aim)(const JoxWalk *w, uint32_t begin, uint32_t end) {
    JoxAgents *a = w->agents;
    const JoxFloats zero = jf_set(0.0f), none = jf_set(-1.0f);
    JoxFloats reach = none;
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        const uint32_t lanes = lanes_before(i, end);
        const JoxVector preferred = jv_load(a->pref_x, a->pref_y, i);
        const JoxFloats speed = jf_sqrt(jv_dot(preferred, preferred));
        const JoxVector unit = jv_scale(preferred, jf_div(jf_set(1.0f), speed));
        const JoxVector aim = jv_select(jf_lt(zero, speed), unit, (JoxVector){zero, zero});
        const JoxMask walks =
            jm_and(jf_lt(zero, jox_param_lanes(a, JOX_PARAM_time_gap, i)), jm_of_bits(lanes));
        const JoxFloats keep =
            jf_mul(jf_set((float)w->law->wall_radius), jox_param_lanes(a, JOX_PARAM_radius, i));
        const JoxFloats far = jf_add(keep, jf_mul(speed, jf_set((float)w->law->wall_time)));
        reach = jf_max(reach, jf_select(walks, far, none));
        float x[JOX_WIDTH], y[JOX_WIDTH];
        jv_store(x, y, 0, aim);
        for (uint32_t lane = 0; lanes >> lane & 1 && lane < JOX_WIDTH; lane++) {
            a->aim_x[i + lane] = x[lane];
            a->aim_y[i + lane] = y[lane];
        }
    }
    float reaches[JOX_WIDTH], most = -1.0f;
    jf_store(reaches, reach);
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        most = reaches[lane] > most ? reaches[lane] : most;
    return most;
}
