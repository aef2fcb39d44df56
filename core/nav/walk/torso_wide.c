/* The kernel by which agents turn their torsos; a lane is an agent. Whoever wants to get on faces
   its way, and turns a shoulder ahead where others or walls leave less room than the shoulders
   need, or where it is pressed and gets nowhere; whoever stands faces where it looks. */
#include "agents/fold_lanes.h"
#include "agents/torso_lanes.h"
#include "nav/walk/walk.h"
#include "simd/vectors.h"

#define LOOK_AHEAD 0.9f  /* m: room is needed as far ahead as this */
#define LOOK_BESIDE 0.1f /* m: and as far back */
#define SAME_WAY                                                                                   \
    0.5f /* cosine: people whose ways differ less go together; they leave each other room */
#define CLEARANCE 0.02f   /* m: room that is left beside the torso */
#define LEAST_COSINE 0.2f /* of the angle to the way; people turn no farther */
/* s: time without getting anywhere in which people try it by a shoulder; where it does not help,
   nothing gives way. */
#define TRIES_FROM 1.0f
#define TRIES_TO 8.0f
#define PRESSED 50.0f        /* N: load of people who turn a shoulder where they get nowhere */
#define WALK_STIFFNESS 36.0f /* 1/s2: of the turn to the wanted angle */
#define STAND_STIFFNESS 4.0f /* 1/s2: of people who stand */
#define DAMPING 10.0f        /* 1/s */
#define MOST_TORQUE 20.0f    /* N m */

/* A packet of agents that turn, and the room that they see. */
typedef struct Packet {
    const JoxWalk *w;
    uint32_t first;
    JoxVector at, way;     /* m; unit vector of the way */
    JoxFloats radius;      /* of the torso, m */
    JoxFloats left, right; /* free room on both sides of the way, m */
} Packet;

/* Narrows the room of a packet by one neighbour of each of `lanes`. */
static inline void mind_neighbour(Packet *p, const uint32_t *others, JoxMask lanes) {
    const JoxNeighbours *near = p->w->step.neighbours;
    const JoxAgents *a = p->w->step.agents;
    const JoxFloats zero = jf_set(0.0f);
    JoxFloats motion[4], shape[4];
    jf_records_at(&near->motions[0].x, others, motion);
    JoxVector offset = {motion[0] - p->at.x, motion[1] - p->at.y};
    if (jox_folds(a))
        offset = jox_fold_lanes(a, offset);
    const JoxFloats along = jv_dot(offset, p->way), across = jv_det(p->way, offset);
    const JoxFloats aside = jf_abs(across);
    JoxMask counts = jm_and(jf_lt(jf_set(-LOOK_BESIDE), along), jf_lt(along, jf_set(LOOK_AHEAD)));
    counts = jm_and(jm_and(counts, lanes), jf_lt(p->radius, aside));
    if (!jm_bits(counts))
        return;
    JoxFloats heading[4];
    jf_records_at(&p->w->nav->headings[0].aim_x, others, heading);
    const JoxFloats same = jv_dot(p->way, (JoxVector){heading[0], heading[1]});
    counts = jm_and(counts, jf_lt(same, jf_set(SAME_WAY)));
    jf_records_at(&near->shapes[0].axis_x, others, shape);
    const JoxFloats reach = shape[2] + jf_abs(jv_det(p->way, (JoxVector){shape[0], shape[1]}));
    const JoxFloats room = aside - reach;
    const JoxMask is_left = jf_lt(zero, across);
    const JoxMask on_right = jm_without(counts, is_left), on_left = jm_and(counts, is_left);
    p->left = jf_select(on_left, jf_min(p->left, room), p->left);
    p->right = jf_select(on_right, jf_min(p->right, room), p->right);
}

/* Narrows the room of one agent by the walls near it. */
static void mind_walls(Packet *p, uint32_t lane, float room[2]) {
    const JoxWallGrid *grid = &p->w->nav->grid;
    const JoxAgents *a = p->w->step.agents;
    const uint32_t i = p->first + lane;
    const JoxV2 at = {a->x[i], a->y[i]};
    float way[2][JOX_WIDTH];
    jv_store(way[0], way[1], 0, p->way);
    const JoxV2 e = {way[0][lane], way[1][lane]};
    uint32_t count;
    const JoxNearEdge *near = jox_wall_grid_nearest(grid, at, &count);
    for (uint32_t k = 0; k < count && near[k].away <= LOOK_AHEAD; k++) {
        JoxV2 ends[2] = {jox_sub(near[k].start, at), jox_sub(near[k].end, at)};
        float along[2] = {jox_dot(e, ends[0]), jox_dot(e, ends[1])};
        float across[2] = {jox_det(e, ends[0]), jox_det(e, ends[1])};
        const float low = -LOOK_BESIDE, high = LOOK_AHEAD;
        if (jox_maxf(along[0], along[1]) < low || jox_minf(along[0], along[1]) > high)
            continue;
        for (int n = 0; n < 2; n++) { /* cuts the edge to what lies ahead */
            const float bound = jox_clampf(along[n], low, high), span = along[1 - n] - along[n];
            if (bound != along[n])
                across[n] += (bound - along[n]) / span * (across[1 - n] - across[n]);
            if (bound != along[n])
                along[n] = bound;
        }
        if ((across[0] > 0.0f) != (across[1] > 0.0f))
            continue; /* it stands across the way */
        const float aside = jox_minf(fabsf(across[0]), fabsf(across[1]));
        float *side = &room[across[0] > 0.0f ? 0 : 1];
        *side = jox_minf(*side, aside);
    }
}

static void find_room(Packet *p, uint32_t moving) {
    const JoxNeighbours *near = p->w->step.neighbours;
    const JoxInts counts = ji_load_bytes(near->count + p->first);
    const uint32_t *others = near->index + jox_neighbour_at(near, p->first, 0);
    p->left = p->right = jf_set(LOOK_AHEAD);
    for (uint32_t k = 0; k < near->stride; k++, others += JOX_LANES) {
        const JoxMask has = jm_and(jm_of_bits(moving), ji_less(ji_set((int32_t)k), counts));
        if (!jm_bits(has))
            break;
        mind_neighbour(p, others, has);
    }
    if (!p->w->nav->grid.first)
        return;
    float left[JOX_WIDTH], right[JOX_WIDTH];
    jf_store(left, p->left);
    jf_store(right, p->right);
    for (uint32_t lane = 0; moving >> lane; lane++) {
        if (!(moving >> lane & 1))
            continue;
        float room[2] = {left[lane], right[lane]};
        mind_walls(p, lane, room);
        left[lane] = room[0];
        right[lane] = room[1];
    }
    p->left = jf_load(left);
    p->right = jf_load(right);
}

/* Returns how far those of a packet's `moving` lanes (bits) that are pressed and get nowhere turn a
   shoulder, as they draw each second: -1 to 1, the left or the right one ahead; 0 in all other
   lanes. */
static JoxFloats find_stuck_turns(const JoxWalk *w, const JoxStuckDraw *draw, uint32_t first,
                                  uint32_t moving) {
    const JoxAgents *a = w->step.agents;
    const JoxFloats still = jf_load(a->still + first), load = jf_load(a->load + first);
    const JoxMask pressed = jf_lt(jf_set(PRESSED), load);
    float turned[JOX_WIDTH] = {0.0f};
    const JoxMask tries = jm_and(jf_lt(jf_set(TRIES_FROM), still), jf_lt(still, jf_set(TRIES_TO)));
    uint32_t stuck = moving & jm_bits(jm_and(pressed, tries));
    for (; stuck; stuck &= stuck - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(stuck);
        turned[lane] = jox_draw_of_stuck(draw, a->id[first + lane], a->still[first + lane], -1.0f);
    }
    return jf_load(turned);
}

void JOX_WIDE(jox_torso_packets)(const JoxWalk *w, uint32_t begin, uint32_t end) {
    JoxAgents *a = w->step.agents;
    const JoxFloats zero = jf_set(0.0f), one = jf_set(1.0f), dt = jf_set((float)w->step.timing.dt);
    const JoxStuckDraw draw = jox_stuck_draw_of(&w->step.timing, JOX_DRAW_SHOULDER);
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        const JoxTorsoLanes torso = jox_torso_lanes(a, i);
        const JoxMask is_long = jf_lt(zero, torso.half);
        if (!jm_bits(is_long))
            continue;
        const JoxVector preferred = jv_load(a->pref_x, a->pref_y, i);
        const JoxFloats speed = jf_sqrt(jv_dot(preferred, preferred));
        const JoxMask stands = jf_lt(speed, jf_set(JOX_STANDS));
        Packet packet = {.w = w, .first = i, .at = jv_load(a->x, a->y, i), .radius = torso.radius};
        packet.way =
            jv_select(stands, jv_load(a->face_x, a->face_y, i), jv_scale(preferred, one / speed));
        const uint32_t moving = jm_bits(jm_without(is_long, stands)) & jox_first_lanes(end - i);
        find_room(&packet, moving);
        const JoxFloats free = packet.left + packet.right - CLEARANCE;
        const JoxFloats wanted = (free - 2.0f * torso.radius) / (2.0f * torso.half);
        const JoxFloats stuck = find_stuck_turns(w, &draw, i, moving);
        const JoxFloats most_cosine = one - jf_abs(stuck) * (1.0f - LEAST_COSINE);
        JoxFloats cosine = jf_min(most_cosine, jf_max(jf_set(LEAST_COSINE), wanted));
        cosine = jf_select(stands, one, cosine);
        const JoxFloats sine = jf_sqrt(one - cosine * cosine);
        const JoxVector chest = jv_load(a->chest_x, a->chest_y, i);
        const JoxFloats s = jv_det(packet.way, chest), c = jv_dot(packet.way, chest);
        const JoxFloats side = jf_select(jf_lt(zero, jf_abs(stuck)), stuck, s);
        const JoxFloats wanted_sine = jf_select(jf_lt(side, zero), -sine, sine);
        const JoxFloats turn = wanted_sine * c - cosine * s; /* sine of the angle that is left */
        const JoxMask behind = jf_lt(cosine * c + wanted_sine * s, zero);
        const JoxFloats most = jf_select(jf_lt(turn, zero), jf_set(-1.0f), one);
        const JoxFloats error = jf_select(behind, most, turn);
        const JoxFloats spin = jf_load(a->spin + i);
        const JoxFloats stiffness =
            jf_select(stands, jf_set(STAND_STIFFNESS), jf_set(WALK_STIFFNESS));
        const JoxFloats gyration = jox_gyration_lanes(a, i);
        const JoxFloats bound =
            MOST_TORQUE / (jox_param_lanes(a, JOX_PARAM_mass, i) * gyration * gyration);
        const JoxFloats torque = stiffness * error - DAMPING * spin;
        const JoxFloats within = jf_max(-bound, jf_min(bound, torque));
        float out[JOX_WIDTH];
        jf_store(out, jf_end_decay(jf_select(is_long, spin + dt * within, spin)));
        for (uint32_t lane = 0; lane < JOX_WIDTH && i + lane < end; lane++)
            a->spin[i + lane] = out[lane];
    }
}
