/* The kernel of solve. A lane is an agent, a packet is JOX_WIDTH of them. packet_lanes.h makes the
   half-planes, and both programs (program_lanes.h) run for all lanes in lock step. Agents that the
   first program does not finish wait until a packet of such agents is full (rest_lanes.h). Lanes
   whose hard half-planes contradict each other, which is rare, go to solve_one.c one at a time. */
#include "base/assert.h"
#include "nav/orca/packet_lanes.h"
#include "nav/orca/wish_lanes.h"
#include "nav/step_back_lanes.h"

/* ---- wanted velocities, and the solution ---- */

/* Returns the lanes (bits) whose wanted velocity a half-plane of contacts or neighbours forbids. */
static uint32_t find_kept_off(const JoxPacket *p, const JoxWish *wish) {
    JoxMask kept = jm_of_bits(0);
    for (uint32_t row = p->contacts; row < p->objects; row++)
        kept = jm_or(kept, jox_is_kept_off(wish, jox_row_normal(&p->rows[row]),
                                           jf_load(p->rows[row].offset)));
    return jm_bits(kept);
}

/* Returns how far each of `lanes` (bits) turns aside, 0 to 1; 0 in the other lanes. */
static JoxFloats find_turns(const JoxPacket *p, uint32_t lanes) {
    float turn[JOX_WIDTH] = {0.0f};
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(lanes);
        turn[lane] = jox_turn_aside(p->s, p->first + lane);
    }
    return jf_load(turn);
}

/* Returns the wanted velocities: preferred ones, some of them turned aside, which is noted; those
   of walkers were chosen by jox_nav_walk; agents that stand step back. */
static JoxVector find_wanted_lanes(const JoxPacket *p) {
    const JoxAgents *a = p->s->step.agents;
    const JoxWish wish = jox_wish_of(p->s, p->first);
    JoxVector wanted = wish.preferred;
    uint32_t aside = p->lanes & jm_bits(wish.may_turn);
    if (aside)
        aside &= find_kept_off(p, &wish);
    if (aside) {
        const JoxFloats turns = find_turns(p, aside & ~jm_bits(wish.gets_on));
        wanted = jv_select(jm_of_bits(aside), jox_turn_wish(wanted, turns), wanted);
    }
    for (uint32_t lanes = aside & ~p->walkers; lanes; lanes &= lanes - 1)
        a->plan_notes[p->first + (uint32_t)__builtin_ctz(lanes)] |= JOX_NOTE_TURNED_ASIDE;
    if (p->walkers)
        wanted = jv_select(jm_of_bits(p->walkers), jv_load(a->walk_x, a->walk_y, p->first), wanted);
    return jox_add_steps_lanes(a, p->first, wanted);
}

/* Lists the half-planes of one lane; returns their counts. */
static JoxHalfPlaneCounts list_lane_planes(const JoxPacket *p, uint32_t lane, JoxHalfPlane *list) {
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

/* For JOX_CHECK: checks the half-planes of all lanes, and the velocities of the lanes in `met`
   (bits). */
static void check_lanes(JoxPacket *p, uint32_t met, JoxFloats limit, JoxVector velocity) {
    float limits[JOX_WIDTH], x[JOX_WIDTH], y[JOX_WIDTH];
    jf_store(limits, limit);
    jf_store(x, velocity.x);
    jf_store(y, velocity.y);
    for (uint32_t lane = 0; p->lanes >> lane; lane++) {
        if (!(p->lanes >> lane & 1))
            continue;
        JoxHalfPlaneCounts made = list_lane_planes(p, lane, p->list);
        uint32_t count = jox_count_of(&made);
        jox_half_planes_check(p->list, count);
        if (met >> lane & 1)
            jox_linear_program_check(p->list, count, limits[lane], (JoxV2){x[lane], y[lane]});
    }
}

/* Results of the first program for a packet, by lane. */
typedef struct Plan {
    float wanted_x[JOX_WIDTH], wanted_y[JOX_WIDTH];
    float velocity_x[JOX_WIDTH], velocity_y[JOX_WIDTH];
    uint32_t failed_at[JOX_WIDTH]; /* row that failed, in lanes that failed */
    uint32_t failed;               /* bits of lanes */
} Plan;

/* Fills entry `at` of the waiting agents from a lane, except its rows. */
static void fill_waiting(JoxRest *r, uint32_t at, const JoxPacket *p, uint32_t lane,
                         const Plan *plan) {
    const uint32_t first = JOX_REST_HARD - p->hard; /* row of the packet's first row */
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

/* Appends lanes (bits) of a packet to the waiting agents. Returns the lanes for which there is no
   room. */
static uint32_t queue_lanes(JoxRest *r, const JoxPacket *p, uint32_t lanes, const Plan *plan) {
    const JoxPlacing placing = jox_rest_place(r, lanes);
    for (uint32_t at = placing.first; at < placing.end; at++)
        fill_waiting(r, at, p, placing.from[at], plan);
    jox_rest_copy_rows(r, &placing, p->rows, p->hard, p->count - p->hard);
    return placing.left;
}

/* Hands lanes (bits) that the first program did not finish to the next stages: `hard` to
   solve_one.c at once, `soft` and `far` to the waiting agents. Returns how many had a hard
   half-plane relaxed. */
static uint32_t queue_unsolved(JoxPacket *p, const Plan *plan, uint32_t soft, uint32_t hard,
                               uint32_t far) {
    uint32_t relaxed = 0;
    for (uint32_t lane = 0; hard >> lane; lane++) {
        if (!(hard >> lane & 1))
            continue;
        JoxHalfPlaneCounts made = list_lane_planes(p, lane, p->list);
        relaxed += jox_solve_one(p->s, p->first + lane, &made, p->list,
                                 jox_v2(plan->wanted_x[lane], plan->wanted_y[lane]));
    }
    while (soft) {
        soft = queue_lanes(p->unmet, p, soft, plan);
        if (p->unmet->count == JOX_WIDTH)
            relaxed += jox_rest_solve_unmet(p->s, p->unmet, p->far);
    }
    while (far) {
        far = queue_lanes(p->far, p, far, plan);
        if (p->far->count == JOX_WIDTH)
            relaxed += jox_rest_solve_far(p->s, p->far);
    }
    return relaxed;
}

/* Solves one packet; returns how many agents had a hard half-plane relaxed. */
static uint32_t solve_packet(JoxPacket *p) {
    JoxAgents *a = p->s->step.agents;
    const uint32_t i = p->first;
    jox_put_half_planes(p);
    const JoxPressed pressed = {
        find_wanted_lanes(p),
        {jf_load(a->forced_x + i), jf_load(a->forced_y + i)},
        {jf_load(a->half_plane_x + i), jf_load(a->half_plane_y + i),
         jf_load(a->half_plane_offset + i)},
        jm_of_bits(p->touching),
        jm_of_bits(p->pressed),
        p->s->nav->literal ? jm_of_bits(0) : jox_stands_lanes(a, i),
    };
    const JoxFloats limit = jf_load(a->speed_limit + i);
    JoxInts failed_at;
    JoxVector velocity;
    const JoxMask failed = jox_program_lanes(p->rows, p->count, jm_of_bits(p->lanes), limit,
                                             pressed.wanted, NULL, &velocity, &failed_at);
    JOX_CHECK(check_lanes(p, p->lanes & ~jm_bits(failed), limit, velocity));
    const JoxMask hard = jm_and(failed, ji_less(failed_at, ji_set((int32_t)p->hard)));
    const JoxMask far = jm_without(jox_out_of_reach_lanes(&pressed, velocity), failed);
    const JoxVector planned = jox_snap_to_forced_lanes(&pressed, velocity);
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
    return queue_unsolved(p, &plan, rest & jm_bits(jm_without(failed, hard)), rest & jm_bits(hard),
                          rest & jm_bits(far));
}

/* Finds the lanes of a packet that plan in this step, and which of them walk, are near walls or
   touch something. */
static void begin_solve_packet(JoxPacket *p, uint32_t first, uint32_t end) {
    const JoxSolve *s = p->s;
    const JoxAgents *a = s->step.agents;
    const JoxContactPlanes *t = s->step.touched;
    const uint32_t there = jox_first_lanes(end - first);
    const JoxMask walks = jf_lt(jf_set(0.0f), jox_param_lanes(a, JOX_PARAM_time_gap, first));
    p->first = first;
    p->lanes = there;
    for (uint32_t lane = 0; !s->step.timing.plans && there >> lane; lane++)
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
    JoxPacket packet; /* large: only the rows in use are initialised */
    packet.s = s;
    packet.counted = JOX_ALL_LANES;
    packet.unmet = &unmet;
    packet.far = &far;
    uint32_t relaxed = 0;
    jox_rest_clear(&unmet);
    jox_rest_clear(&far);
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        begin_solve_packet(&packet, i, end);
        if (packet.lanes)
            relaxed += solve_packet(&packet);
    }
    relaxed += jox_rest_solve_unmet(s, &unmet, &far);
    return relaxed + jox_rest_solve_far(s, &far);
}
