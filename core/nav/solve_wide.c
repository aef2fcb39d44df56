/* The kernel of solve. A lane is an agent, a packet is JOX_WIDTH of them; their half-planes are
   made by packet_lanes.h, and the two programs (program_lanes.h) are done for all lanes in lock
   step. Who is not done by the first program waits until a packet of such agents is full
   (rest_lanes.h). Lanes of which a hard half-plane has to give, which is rare, are left to
   solve_one.c, one at a time. */
#include "base/assert.h"
#include "nav/packet_lanes.h"
#include "nav/wish_lanes.h"

/* ---- what is wanted, and the velocity ---- */

/* The lanes (bits) that a half-plane of contacts or neighbours keeps from the velocity wanted. */
static uint32_t find_kept_off(const JoxPacket *p, const JoxWish *wish) {
    JoxMask kept = jm_of_bits(0);
    for (uint32_t row = p->contacts; row < p->objects; row++)
        kept = jm_or(kept, jox_is_kept_off(wish, jox_row_normal(&p->rows[row]),
                                           jf_load(p->rows[row].offset)));
    return jm_bits(kept);
}

/* How far each of `lanes` (bits) turns aside, 0 to 1; 0 in the others. */
static JoxFloats find_turns(const JoxPacket *p, uint32_t lanes) {
    float turn[JOX_WIDTH] = {0.0f};
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(lanes);
        turn[lane] = jox_turn_aside(p->s, p->first + lane);
    }
    return jf_load(turn);
}

/* The velocities wanted: preferred ones, some of them turned aside. Walkers have chosen already. */
static JoxVector find_wanted(const JoxPacket *p) {
    const JoxAgents *a = p->s->agents;
    const JoxWish wish = jox_wish_of(a, p->first);
    JoxVector wanted = wish.preferred;
    uint32_t aside = p->lanes & jm_bits(wish.may_turn);
    if (aside)
        aside &= find_kept_off(p, &wish);
    if (aside) {
        const JoxFloats turns = find_turns(p, aside & ~jm_bits(wish.gets_on));
        wanted = jv_select(jm_of_bits(aside), jox_turn_wish(wanted, turns), wanted);
    }
    if (p->walkers)
        wanted = jv_select(jm_of_bits(p->walkers), jv_load(a->walk_x, a->walk_y, p->first), wanted);
    return wanted;
}

/* The half-planes of a lane, one after the other. */
static JoxHalfPlaneCounts list_of(const JoxPacket *p, uint32_t lane, JoxHalfPlane *list) {
    JoxHalfPlaneCounts made = p->made[lane];
    uint32_t n = 0;
    made.agents = 0;
    for (uint32_t row = 0; row < p->count; row++) {
        JoxV2 normal = {p->rows[row].x[lane], p->rows[row].y[lane]};
        if (normal.x == 0.0f && normal.y == 0.0f)
            continue;
        list[n++] = (JoxHalfPlane){normal, p->rows[row].offset[lane]};
        made.agents += row >= p->hard && row < p->objects;
    }
    return made;
}

/* For JOX_CHECK: half-planes of all lanes, and the velocities of those that meet them all. */
static void check_lanes(JoxPacket *p, uint32_t met, JoxFloats limit, JoxVector velocity) {
    float limits[JOX_WIDTH], x[JOX_WIDTH], y[JOX_WIDTH];
    jf_store(limits, limit);
    jf_store(x, velocity.x);
    jf_store(y, velocity.y);
    for (uint32_t lane = 0; p->lanes >> lane; lane++) {
        if (!(p->lanes >> lane & 1))
            continue;
        JoxHalfPlaneCounts made = list_of(p, lane, p->list);
        uint32_t count = jox_count_of(&made);
        jox_half_planes_check(p->list, count);
        if (met >> lane & 1)
            jox_linear_program_check(p->list, count, limits[lane], (JoxV2){x[lane], y[lane]});
    }
}

/* What the first program left of a packet. */
typedef struct Plan {
    float wanted_x[JOX_WIDTH], wanted_y[JOX_WIDTH];
    float velocity_x[JOX_WIDTH], velocity_y[JOX_WIDTH];
    uint32_t failed_at[JOX_WIDTH]; /* row, of those that failed */
    uint32_t failed;               /* lanes */
} Plan;

/* What is known of a lane that waits as number `at`, its rows aside. */
static void note_waiting(JoxRest *r, uint32_t at, const JoxPacket *p, uint32_t lane,
                         const Plan *plan) {
    const uint32_t first = JOX_REST_HARD - p->hard; /* row of the packet's first */
    r->agent[at] = p->first + lane;
    r->failed[at] = plan->failed >> lane & 1;
    r->failed_at[at] = first + plan->failed_at[lane];
    r->wanted_x[at] = plan->wanted_x[lane];
    r->wanted_y[at] = plan->wanted_y[lane];
    r->velocity_x[at] = plan->velocity_x[lane];
    r->velocity_y[at] = plan->velocity_y[lane];
    r->made[at] = p->made[lane];
    r->contacts[at] = first + p->contacts;
    r->force[at] = first + p->count - 1;
}

/* Puts lanes (bits) of a packet behind those that wait. Returns those for whom there is no room. */
static uint32_t wait_in(JoxRest *r, const JoxPacket *p, uint32_t lanes, const Plan *plan) {
    jox_rest_open(r, p->hard, p->count - p->hard);
    for (uint32_t lane = 0; lanes >> lane && r->count < JOX_WIDTH; lane++) {
        if (!(lanes >> lane & 1))
            continue;
        const uint32_t at = r->count++;
        note_waiting(r, at, p, lane, plan);
        JoxRow *to = &r->rows[JOX_REST_HARD - p->hard];
        for (uint32_t row = 0; row < p->count; row++, to++) {
            to->x[at] = p->rows[row].x[lane];
            to->y[at] = p->rows[row].y[lane];
            to->offset[at] = p->rows[row].offset[lane];
        }
        lanes &= ~(1u << lane);
    }
    return lanes;
}

/* Those of whom the first program was not the last. */
static uint32_t leave_to_rest(JoxPacket *p, const Plan *plan, uint32_t soft, uint32_t hard,
                              uint32_t far) {
    uint32_t relaxed = 0;
    for (uint32_t lane = 0; hard >> lane; lane++) {
        if (!(hard >> lane & 1))
            continue;
        JoxHalfPlaneCounts made = list_of(p, lane, p->list);
        relaxed += jox_solve_one(p->s, p->first + lane, &made, p->list,
                                 jox_v2(plan->wanted_x[lane], plan->wanted_y[lane]));
    }
    while (soft) {
        soft = wait_in(p->unmet, p, soft, plan);
        if (p->unmet->count == JOX_WIDTH)
            relaxed += jox_rest_violate_least(p->s, p->unmet, p->far);
    }
    while (far) {
        far = wait_in(p->far, p, far, plan);
        if (p->far->count == JOX_WIDTH)
            relaxed += jox_rest_pull_in(p->s, p->far);
    }
    return relaxed;
}

static uint32_t solve_packet(JoxPacket *p) {
    JoxAgents *a = p->s->agents;
    const uint32_t i = p->first;
    jox_put_half_planes(p);
    const JoxPressed pressed = {
        find_wanted(p),
        {jf_load(a->forced_x + i), jf_load(a->forced_y + i)},
        {jf_load(a->half_plane_x + i), jf_load(a->half_plane_y + i),
         jf_load(a->half_plane_offset + i)},
        jm_of_bits(p->touching),
        jm_of_bits(p->pressed),
    };
    const JoxFloats limit = jf_load(a->speed_limit + i);
    JoxInts failed_at;
    JoxVector velocity;
    const JoxMask failed = jox_program_lanes(p->rows, p->count, jm_of_bits(p->lanes), limit,
                                             pressed.wanted, NULL, &velocity, &failed_at);
    JOX_CHECK(check_lanes(p, p->lanes & ~jm_bits(failed), limit, velocity));
    const JoxMask hard = jm_and(failed, ji_less(failed_at, ji_set((int32_t)p->hard)));
    const JoxMask far = jm_without(jox_out_of_reach_lanes(&pressed, velocity), failed);
    const JoxVector planned = jox_as_forced_lanes(&pressed, velocity);
    const uint32_t rest = p->lanes & jm_bits(jm_or(failed, far));
    const JoxMask planned_now = jm_of_bits(p->lanes & ~rest);
    if (!rest && p->lanes == JOX_ALL_LANES) {
        jv_store(a->next_x, a->next_y, i, planned);
        return 0;
    }
    jv_store(a->next_x, a->next_y, i,
             jv_select(planned_now, planned, jv_load(a->next_x, a->next_y, i)));
    if (!rest)
        return 0;
    Plan plan;
    plan.failed = jm_bits(failed);
    jf_store(plan.wanted_x, pressed.wanted.x);
    jf_store(plan.wanted_y, pressed.wanted.y);
    jf_store(plan.velocity_x, velocity.x);
    jf_store(plan.velocity_y, velocity.y);
    ji_store(plan.failed_at, failed_at);
    return leave_to_rest(p, &plan, rest & jm_bits(jm_without(failed, hard)), rest & jm_bits(hard),
                         rest & jm_bits(far));
}

/* Who plans in this step, and what is about them. */
static void begin_packet(JoxPacket *p, uint32_t first, uint32_t end) {
    const JoxSolve *s = p->s;
    const JoxAgents *a = s->agents;
    const JoxContactPlanes *t = s->touched;
    const uint32_t there = jox_first_lanes(end - first);
    const JoxMask walks = jf_lt(jf_set(0.0f), jox_param_lanes(a, JOX_PARAM_time_gap, first));
    p->first = first;
    p->lanes = there;
    for (uint32_t lane = 0; !s->plans && there >> lane; lane++)
        if (jox_solve_walks(s, first + lane) || !jox_stands_pressed(a, first + lane))
            p->lanes &= ~(1u << lane);
    p->walkers = s->nav->literal ? 0 : p->lanes & jm_bits(walks);
    p->near_walls = p->lanes & jm_bits(jox_wall_grid_near_lanes(
                                   &s->nav->grid, jf_load(a->x + first), jf_load(a->y + first)));
    p->touching = 0;
    if (t) {
        const JoxInts count =
            ji_or(ji_load_bytes(t->people + first), ji_load_bytes(t->bodies + first));
        p->touching = p->lanes & jm_bits(ji_less(ji_set(0), count));
    }
}

uint32_t JOX_WIDE(jox_solve_packets)(const JoxSolve *s, uint32_t begin, uint32_t end) {
    JoxRest unmet, far;
    JoxPacket packet; /* large: each packet of agents begins its rows anew */
    packet.s = s;
    packet.counted = JOX_ALL_LANES;
    packet.unmet = &unmet;
    packet.far = &far;
    uint32_t relaxed = 0;
    jox_rest_clear(&unmet);
    jox_rest_clear(&far);
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        begin_packet(&packet, i, end);
        if (packet.lanes)
            relaxed += solve_packet(&packet);
    }
    relaxed += jox_rest_violate_least(s, &unmet, &far);
    return relaxed + jox_rest_pull_in(s, &far);
}
