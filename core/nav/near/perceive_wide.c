/* The kernel of perceive. A lane is an agent; a packet is JOX_WIDTH consecutive agents in the order
   of the grid. Each lane has a list of candidates: the agents of the cells within reach are tested
   packet by packet, and those within the radius are appended to the list. Then the lists of all
   lanes are sorted at once (near_lanes.h). Lanes whose lists overflow search again one at a time
   (nearest.c). */
#include <math.h>
#include <string.h>

#include "agents/param_lanes.h"
#include "agents/torso_lanes.h"
#include "nav/near/near_lanes.h"
#include "nav/near/reach_lanes.h"
#include "nav/near/seam_lanes.h"

/* The data of one lane that searches, broadcast to all lanes, and its list. */
typedef struct Seeker {
    JoxFloats x, y, radius2; /* m, m2 */
    JoxInts self;
    float *distance2;
    uint32_t *index;
} Seeker;

static inline Seeker make_seeker(Packet *packet, const Reach *reach, uint32_t lane) {
    return (Seeker){jf_set(reach->x[lane]),
                    jf_set(reach->y[lane]),
                    jf_set(reach->radius2[lane]),
                    ji_set((int32_t)(packet->first + lane)),
                    packet->distance2 + (size_t)lane * LIST,
                    packet->index + (size_t)lane * LIST};
}

/* Appends the agents of a packet that exist (`there`) and lie within the radius to a list of `n`.
   Returns how many. */
static inline uint32_t append_packet(const Seeker *seeker, size_t n, JoxVector at, JoxInts others,
                                     JoxMask there) {
    const JoxFloats dx = at.x - seeker->x, dy = at.y - seeker->y;
    const JoxFloats d2 = dx * dx + dy * dy;
    const JoxMask near = jm_without(jf_le(d2, seeker->radius2), ji_equal(others, seeker->self));
    const uint32_t bits = jm_bits(jm_and(near, there));
    jf_store_packed(seeker->distance2 + n, d2, bits);
    ji_store_packed(seeker->index + n, others, bits);
    return jm_count(bits);
}

static inline size_t greater_size(size_t a, size_t b) {
    return a > b ? a : b;
}

/* Appends the candidates of `seekers` lanes (1 or 2), from `lane` on, out of `cells` to their
   lists. Returns true if one of two lists overflows, which may cut the other; then both lists are
   left as they were. */
static inline __attribute__((always_inline)) bool
list_candidates(Packet *packet, const Reach *reach, const uint32_t lane, const uint32_t seekers,
                const Cells *cells) {
    const JoxNav *nav = packet->p->nav;
    const float *x = packet->p->agents->x, *y = packet->p->agents->y;
    const size_t columns = nav->columns, left = cells->left[lane], right = cells->right[lane] + 1;
    const uint32_t *row = nav->cell_first + cells->low[lane] * columns;
    const uint32_t *last = nav->cell_first + cells->high[lane] * columns;
    Seeker seeker[2];
    size_t n[2] = {0, 0};
    for (uint32_t s = 0; s < seekers; s++) {
        seeker[s] = make_seeker(packet, reach, lane + s);
        n[s] = packet->count[lane + s];
    }
    for (; row <= last; row += columns) {
        const size_t begin = row[left], end = row[right];
        if (greater_size(n[0], n[1]) + (end - begin) > ROOM) {
            n[0] = n[1] = PLACES + 1; /* counts as an overflow */
            break;
        }
        const JoxInts ends = ji_set((int32_t)end);
        JoxInts others = ji_add(ji_set((int32_t)begin), ji_lane());
        for (size_t j = begin; j < end; j += JOX_WIDTH) {
            const JoxVector at = {jf_load(x + j), jf_load(y + j)};
            const JoxMask there = ji_less(others, ends);
            for (uint32_t s = 0; s < seekers; s++)
                n[s] += append_packet(&seeker[s], n[s], at, others, there);
            others = ji_add(others, ji_set(JOX_WIDTH));
        }
    }
    if (seekers > 1 && (n[0] > PLACES || n[1] > PLACES))
        return true;
    for (uint32_t s = 0; s < seekers; s++)
        packet->count[lane + s] = (uint32_t)n[s];
    return false;
}

/* The agents that crossed a periodic edge since the sort (strays) and may be near a packet. They
   are not in the cells where they stand, so that the search of the cells misses them there. */
typedef struct Strays {
    float x[JOX_MOST_STRAYS + JOX_LANES], y[JOX_MOST_STRAYS + JOX_LANES]; /* m */
    uint32_t index[JOX_MOST_STRAYS + JOX_LANES], count;
} Strays;

/* Computes the bounding box of all points that `lanes` (bits) see, widened beyond rounding. */
static inline void bound_lanes(const Packet *packet, const Reach *reach, uint32_t lanes, JoxV2 *low,
                               JoxV2 *high) {
    *low = (JoxV2){INFINITY, INFINITY};
    *high = (JoxV2){-INFINITY, -INFINITY};
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(lanes);
        const float wide = packet->radius[lane] + packet->p->nav->drift.farthest;
        low->x = jox_minf(low->x, reach->x[lane] - wide);
        low->y = jox_minf(low->y, reach->y[lane] - wide);
        high->x = jox_maxf(high->x, reach->x[lane] + wide);
        high->y = jox_maxf(high->y, reach->y[lane] + wide);
    }
}

/* Finds the strays in the bounding box of what `lanes` (bits) see. */
static inline void find_strays(const Packet *packet, const Reach *reach, uint32_t lanes,
                               Strays *out) {
    const JoxNav *nav = packet->p->nav;
    JoxV2 low, high;
    bound_lanes(packet, reach, lanes, &low, &high);
    out->count = 0;
    for (uint32_t k = 0; k < nav->stray_count; k += JOX_WIDTH) {
        const JoxVector at = jv_load(nav->stray_x, nav->stray_y, k);
        const JoxMask along = jm_and(jf_le(jf_set(low.x), at.x), jf_le(at.x, jf_set(high.x)));
        const JoxMask across = jm_and(jf_le(jf_set(low.y), at.y), jf_le(at.y, jf_set(high.y)));
        const JoxMask there =
            ji_less(ji_add(ji_set((int32_t)k), ji_lane()), ji_set((int32_t)nav->stray_count));
        const uint32_t bits = jm_bits(jm_and(there, jm_and(along, across)));
        jf_store_packed(out->x + out->count, at.x, bits);
        jf_store_packed(out->y + out->count, at.y, bits);
        ji_store_packed(out->index + out->count, ji_load(nav->strays + k), bits);
        out->count += jm_count(bits);
    }
}

/* Drops agents from the places `from` to `count` of a lane's list that stand in an earlier place.
   Returns how many places are left. */
static inline uint32_t drop_listed(Packet *packet, uint32_t lane, uint32_t from, uint32_t count) {
    uint32_t *index = packet->index + (size_t)lane * LIST;
    float *distance2 = packet->distance2 + (size_t)lane * LIST;
    uint32_t kept = from;
    for (uint32_t place = from; place < count; place++) {
        uint32_t same = 0;
        while (same < from && index[same] != index[place])
            same++;
        index[kept] = index[place];
        distance2[kept] = distance2[place];
        kept += same == from;
    }
    return kept;
}

/* Appends the strays within the radius to the list of one lane. A stray whose cell was searched is
   listed already: its cell and its position are both within reach where edges are close to each
   other, or where few cells hold all agents. */
static inline void list_strays(Packet *packet, const Reach *reach, uint32_t lane,
                               const Strays *strays) {
    const Seeker seeker = make_seeker(packet, reach, lane);
    const uint32_t from = packet->count[lane];
    uint32_t n = from;
    for (uint32_t k = 0; k < strays->count && n <= PLACES; k += JOX_WIDTH) {
        const JoxInts at = ji_add(ji_set((int32_t)k), ji_lane());
        n += append_packet(&seeker, n, jv_load(strays->x, strays->y, k), ji_load(strays->index + k),
                           ji_less(at, ji_set((int32_t)strays->count)));
    }
    packet->count[lane] = n > PLACES ? n : drop_listed(packet, lane, from, n);
}

/* Adds the candidates that `lanes` (bits) see from one of their periodic images to the lists. Not
   inline, so that the data of its loops stays in registers. */
static __attribute__((noinline)) void list_image(Packet *packet, uint32_t lanes, JoxV2 shift,
                                                 bool strays) {
    Reach reach;
    find_reach(packet, shift, &reach);
    const uint32_t pairs = reach.pairs & lanes & lanes >> 1;
    for (uint32_t left = lanes; left;) {
        const uint32_t lane = (uint32_t)__builtin_ctz(left);
        left &= left - 1;
        if (JOX_WIDTH > 1 && (pairs >> lane & 1) &&
            !list_candidates(packet, &reach, lane, 2, &reach.both))
            left &= left - 1;
        else
            list_candidates(packet, &reach, lane, 1, &reach.own);
    }
    if (!strays)
        return;
    Strays near;
    find_strays(packet, &reach, lanes, &near);
    for (uint32_t left = near.count ? lanes : 0; left; left &= left - 1)
        list_strays(packet, &reach, (uint32_t)__builtin_ctz(left), &near);
}

/* The lanes that search from their images shifted along one axis by -1, 0 and 1 periods
   (jox_sees_image says when). A lane that sees an edge may also see strays. */
typedef struct Seeing {
    uint32_t lanes[3];
} Seeing;

static inline Seeing find_seeing_lanes(const float *along, JoxFloats wide, float origin,
                                       float period) {
    Seeing s = {{0, JOX_ALL_LANES, 0}};
    if (period > 0.0f) {
        const JoxFloats at = jf_load(along);
        s.lanes[0] = jm_bits(jf_le(jf_set(origin + period), at + wide));
        s.lanes[2] = jm_bits(jf_le(at - wide, jf_set(origin)));
    }
    return s;
}

/* Keeps of the candidates of a lane from place `from` on those that it sees through a seam. */
static void keep_seen_through(Packet *packet, uint32_t lane, uint32_t from, const JoxSeam *seam) {
    const JoxAgents *a = packet->p->agents;
    const JoxStoreys *s = a->storeys;
    uint32_t *index = packet->index + (size_t)lane * LIST;
    float *distance2 = packet->distance2 + (size_t)lane * LIST;
    const JoxV2 own = {packet->at_x[lane], packet->at_y[lane] - (float)seam->here * s->pitch};
    uint32_t kept = from;
    for (uint32_t place = from; place < packet->count[lane]; place++) {
        const uint32_t j = index[place];
        const JoxV2 other = {a->x[j], a->y[j] - (float)seam->there * s->pitch};
        index[kept] = j;
        distance2[kept] = distance2[place];
        kept += jox_seam_lets_see(seam, own, other);
    }
    packet->count[lane] = kept;
}

/* Adds the candidates that `lanes` (bits) see through seams. Lists that overflow stay as they are:
   their lanes search again one at a time. */
static __attribute__((noinline)) void list_through_seams(Packet *packet, uint32_t lanes,
                                                         JoxFloats wide) {
    const JoxStoreys *s = packet->p->agents->storeys;
    const JoxVector at = {jf_load(packet->at_x), jf_load(packet->at_y)};
    uint32_t first, last;
    jox_find_seams(s, packet->at_y, lanes, &first, &last);
    for (uint32_t k = first; k < last; k++) {
        const JoxSeam *seam = &s->seams[k];
        uint32_t before[JOX_WIDTH], seeing = lanes & jox_find_near_seam(s, seam, at, wide);
        for (uint32_t left = seeing; left; left &= left - 1) {
            const uint32_t lane = (uint32_t)__builtin_ctz(left);
            before[lane] = packet->count[lane];
            if (before[lane] > PLACES)
                seeing &= ~(1u << lane);
        }
        if (!seeing)
            continue;
        list_image(packet, seeing, (JoxV2){0.0f, seam->shift}, true);
        for (uint32_t left = seeing; left; left &= left - 1) {
            const uint32_t lane = (uint32_t)__builtin_ctz(left);
            if (packet->count[lane] <= PLACES)
                keep_seen_through(packet, lane, before[lane], seam);
        }
    }
}

/* Returns whether any of `lanes` (bits) may see a seam. */
static bool see_seams(const Packet *packet, uint32_t lanes, JoxFloats wide) {
    const JoxStoreys *s = packet->p->agents->storeys;
    const JoxVector at = {jf_load(packet->at_x), jf_load(packet->at_y)};
    uint32_t first, last, seeing = 0;
    jox_find_seams(s, packet->at_y, lanes, &first, &last);
    for (uint32_t k = first; k < last && !seeing; k++)
        seeing = lanes & jox_find_near_seam(s, &s->seams[k], at, wide);
    return seeing != 0;
}

/* Makes the lists of `lanes` (bits) anew; those of the other lanes get empty. */
static void list_lanes(Packet *packet, uint32_t lanes) {
    const JoxAgents *a = packet->p->agents;
    const JoxFloats wide = jf_load(packet->radius) + packet->p->nav->drift.farthest;
    const Seeing x = find_seeing_lanes(packet->at_x, wide, a->origin.x, a->period.x);
    const Seeing y = find_seeing_lanes(packet->at_y, wide, a->origin.y, a->period.y);
    memset(packet->count, 0, sizeof packet->count);
    const bool seams = a->storeys && see_seams(packet, lanes, wide);
    const bool strays = (lanes & (x.lanes[0] | x.lanes[2] | y.lanes[0] | y.lanes[2])) != 0 || seams;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) {
            const uint32_t seeing = lanes & x.lanes[column] & y.lanes[row];
            const JoxV2 shift = {(float)(column - 1) * a->period.x, (float)(row - 1) * a->period.y};
            if (seeing)
                list_image(packet, seeing, shift, strays);
        }
    if (seams)
        list_through_seams(packet, lanes, wide);
}

static inline void store_floats(float *to, JoxMask m, JoxFloats a) {
    jf_store(to, jf_select(m, a, jf_load(to)));
}

static inline void store_bytes(uint8_t *to, JoxMask m, JoxInts a) {
    ji_store_bytes(to, ji_select(m, a, ji_load_bytes(to)));
}

/* Writes the first `count` neighbours of `lanes` into `index`: one row of JOX_LANES entries per
   rank. */
static inline void write_neighbours(const Packet *packet, JoxMask lanes, JoxInts count,
                                    uint32_t *index) {
    for (uint32_t k = 0; k + 1 < packet->levels; k++) {
        const JoxMask kept = jm_and(lanes, ji_less(ji_set((int32_t)k), count));
        const uint32_t bits = jm_bits(kept);
        if (!bits)
            return;
        JoxInts picked = ji_pick(packet->index, find_listed(packet->keys[k]));
        if (bits != JOX_ALL_LANES)
            picked = ji_select(kept, picked, ji_load(index));
        ji_store(index, picked);
        index += JOX_LANES;
    }
}

/* Writes the neighbours of lanes that all have as many as there are levels. */
static inline void write_full_lists(const Packet *packet, uint32_t *index) {
    for (uint32_t k = 0; k + 1 < packet->levels; k++, index += JOX_LANES)
        ji_store(index, ji_pick(packet->index, find_listed(packet->keys[k])));
}

/* Returns how many of the `count` neighbours of each lane are within touch range, by the bits of
   their keys, or slightly more. */
static inline JoxInts count_close(const Packet *packet, JoxInts count) {
    const float touch = jox_touch_most(packet->p->out);
    const JoxFloats radius = jf_load(packet->radius);
    const JoxFloats farthest2 = jf_min(jf_set(touch * touch), radius * radius);
    const JoxFloats floor2 = jf_load(packet->floor2);
    const JoxInts key = make_lane_key(farthest2, floor2, make_first_key(floor2));
    const JoxFloats beyond =
        ji_as_floats(ji_add(key, ji_set(PLACES))); /* key of the next greater distance */
    JoxInts close = ji_set(0);
    for (uint32_t k = 0; k + 1 < packet->levels; k++) {
        const JoxMask near = jm_and(jf_lt(packet->keys[k], beyond), ji_less(close, count));
        if (!jm_bits(near))
            break;
        close = ji_select(near, ji_set((int32_t)k + 1), close);
    }
    return close;
}

/* Stores the squared distance, m2, of the neighbour of rank JOX_CROWD_RANK for the lanes that have
   one. */
static inline void store_crowding(const Packet *packet, JoxMask lanes, JoxInts count) {
    const JoxMask has = jm_and(lanes, ji_less(ji_set(JOX_CROWD_RANK), count));
    if (jm_bits(has))
        store_floats(packet->p->out->crowding2 + packet->first, has,
                     jf_pick(packet->distance2, find_listed(packet->keys[JOX_CROWD_RANK])));
}

/* Writes what was found for `lanes` (bits): neighbours, search, density and counts. */
static void write_found(const Packet *packet, const Found *f, uint32_t lanes,
                        JoxFloats perception) {
    const JoxPerceive *p = packet->p;
    const JoxMask mask = jm_of_bits(lanes);
    JoxFloats reach = perception;
    if (jm_bits(f->full))
        reach = jf_select(f->full, jf_sqrt(pick_farthest2(packet, f)), perception);
    JoxFloats area = jf_max(reach * reach, jf_set(JOX_DENSITY_LEAST));
    store_floats(p->agents->search_radius + packet->first, mask,
                 jf_max(reach, jf_set(JOX_SEARCH_LEAST)));
    store_floats(p->agents->density + packet->first, mask,
                 ji_to_floats(f->count) / ((float)JOX_PI * area));
    store_bytes(p->out->count + packet->first, mask, f->count);
    store_bytes(p->out->close + packet->first, mask, count_close(packet, f->count));
    store_crowding(packet, mask, f->count);
    uint32_t *index = p->out->index + jox_neighbour_at(p->out, packet->first, 0);
    if (f->whole && lanes == JOX_ALL_LANES)
        write_full_lists(packet, index);
    else
        write_neighbours(packet, mask, f->count, index);
}

/* Finds the agents within touch range for lanes whose neighbour lists do not cover it. */
static void find_touching(const Packet *packet, JoxMask sees) {
    const JoxPerceive *p = packet->p;
    JoxFloats range = jox_outer_lanes(p->agents, packet->first) + p->out->widest + JOX_TOUCH_LEAST;
    range = jf_min(range + JOX_TOUCH_MOST, jf_set(p->sight));
    JoxFloats reach =
        jf_select(sees, jf_load(p->agents->search_radius + packet->first), jf_set(0.0f));
    const uint32_t lacking = packet->lanes & jm_bits(jf_lt(reach, range));
    store_bytes(p->out->touch_count + packet->first, jm_of_bits(packet->lanes),
                ji_set(JOX_TOUCH_AMONG_NEIGHBOURS));
    if (!lacking)
        return;
    float ranges[JOX_WIDTH];
    jf_store(ranges, range);
    for (uint32_t left = lacking; left; left &= left - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(left);
        jox_perceive_touching(p, packet->first + lane, ranges[lane]);
    }
}

/* Searches for lanes (bits) whose lists overflowed, one at a time. */
static void search_singly(const Packet *packet, uint32_t lanes) {
    for (uint32_t left = lanes; left; left &= left - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(left);
        jox_perceive_one(packet->p, packet->first + lane, packet->radius[lane]);
    }
}

/* Searches for the lanes of a packet, with growing radii, until each has as many neighbours as it
   wants or has looked as far as it perceives. */
static void perceive_packet(Packet *packet) {
    const JoxPerceive *p = packet->p;
    const JoxAgents *a = p->agents;
    const uint32_t i = packet->first;
    const JoxFloats perception =
        jf_min(jox_param_lanes(a, JOX_PARAM_perception, i), jf_set(p->sight));
    const JoxFloats last = jf_load(a->search_radius + i), zero = jf_set(0.0f);
    const JoxInts most = jf_to_ints(jox_param_lanes(a, JOX_PARAM_neighbours, i));
    const JoxFloats first = jf_set(jox_maxf(p->nav->search_radius, JOX_SEARCH_LEAST));
    JoxFloats radius = jf_select(jf_lt(zero, last), last + JOX_SEARCH_SLACK, first);
    jf_store(packet->at_x, jf_load(a->x + i));
    jf_store(packet->at_y, jf_load(a->y + i));
    const JoxMask sees = ji_less(ji_set(0), most);
    for (uint32_t left = packet->lanes; left;) {
        radius = jf_min(radius, perception);
        jf_store(packet->radius, radius);
        list_lanes(packet, left);
        const uint32_t full = find_longer_lists(packet, PLACES);
        order_packet(packet);
        const Found f = read_keys(packet, most);
        const JoxMask short_of = jm_and(sees, jm_without(jf_lt(radius, perception), f.full));
        const uint32_t done = full | (left & ~jm_bits(short_of));
        const uint32_t tied = done & jm_bits(f.tied) & ~full;
        if (tied)
            settle_lanes(packet, tied);
        write_found(packet, &f, done & ~full, perception);
        if (full)
            search_singly(packet, full);
        left &= ~done;
        radius *= JOX_SEARCH_GROWTH;
    }
    find_touching(packet, sees);
}

/* Returns 1 plus the greatest number of neighbours wanted by `count` agents, which mostly all want
   the same. */
static uint32_t count_levels(const float *neighbours, uint32_t count) {
    float most = neighbours[0];
    const JoxMask other = jf_lt(jf_set(0.0f), jf_abs(jf_load(neighbours) - most));
    for (uint32_t lane = 1; jm_bits(other) && lane < count; lane++)
        most = jox_maxf(most, neighbours[lane]);
    return (uint32_t)most + 1;
}

void JOX_WIDE(jox_perceive_packets)(const JoxPerceive *p, uint32_t begin, uint32_t end) {
    Packet packet; /* large, and not initialised: entries behind the ends of lists are read and
                      ignored */
    packet.p = p;
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        uint32_t count = end - i < JOX_WIDTH ? end - i : JOX_WIDTH;
        packet.first = i;
        packet.lanes = jox_first_lanes(count);
        packet.levels = count_levels(jox_params(p->agents, JOX_PARAM_neighbours, i), count);
        perceive_packet(&packet);
    }
}
