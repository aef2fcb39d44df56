/* The kernel of perceive. A lane is an agent; a packet is JOX_WIDTH consecutive agents of the
   sorted order. Packets are cut into stretches of neighbours in one row; whoever is near any agent
   of a stretch is a candidate of all of its lanes, and sinks into the sorted keys of each without a
   branch.

   A key is a float that is never computed with: its bits are the squared distance as a fixed-point
   number of 23 bits (a share of the squared radius) above the number of the candidate, so that
   min and max sort both at once. Lanes of which two keys have the same distance by these bits
   choose anew among the candidates, and packets with more candidates than numbers search anew, one
   by one (nearest.c), which orders exactly, and by id. So neighbours are exact, whatever the width.
 */
#include <math.h>
#include <string.h>

#include "nav/kernels.h"
#include "simd/lanes.h"

enum {
    NUMBER_BITS = 8,
    MOST_CANDIDATES = 1 << NUMBER_BITS,
    WIDTH_BITS = JOX_WIDTH == 16  ? 4
                 : JOX_WIDTH == 8 ? 3
                 : JOX_WIDTH == 4 ? 2
                                  : 0,
    FEW = 10, /* neighbours of which the keys fit into the registers of most instruction sets */
    NORMAL = 0x8000 << NUMBER_BITS, /* bits of the least float that is not denormal */
    NO_KEY = 0x7f800000             /* bits of INFINITY */
};
static const float FARTHEST_SHARE = 8.3e6f; /* of a squared radius: keys stay less than INFINITY */

typedef struct Packet {
    const JoxPerceive *p;
    uint32_t first;  /* agent of lane 0 */
    uint32_t lanes;  /* bits of those that are there */
    uint32_t row;    /* of the first agent, and of the last one seen */
    uint32_t levels; /* keys that are kept: one more than the most neighbours of any lane */
    uint32_t candidates;
    bool overflow; /* more of them than there is room for */
    uint32_t hints[JOX_ROW_HINTS];
    JoxFloats x, y;    /* m, shifted to the image that is looked at */
    JoxFloats within2; /* squared radius, m2; less than 0 for lanes that take no part */
    JoxFloats scale;   /* from squared distances to fixed point, 1/m2 */
    float radius[JOX_LANES], at_x[JOX_LANES], at_y[JOX_LANES]; /* m */
    JoxFloats keys[JOX_MOST_NEIGHBOURS + 1];
    uint32_t index[MOST_CANDIDATES];
    float distance2[MOST_CANDIDATES * JOX_WIDTH]; /* m2; INFINITY: none of the lane's */
} Packet;

/* Sinks agents [begin, end) into the keys of the lanes that take part. */
static inline __attribute__((always_inline)) void sink(Packet *packet, uint32_t begin, uint32_t end,
                                                       const uint32_t levels) {
    const float *x = packet->p->agents->x, *y = packet->p->agents->y;
    const JoxInts self = ji_add(ji_set((int32_t)packet->first), ji_lane());
    const JoxFloats none = jf_set(INFINITY), farthest = jf_set(FARTHEST_SHARE);
    JoxFloats keys[JOX_MOST_NEIGHBOURS + 1];
    uint32_t number = packet->candidates;
    JOX_UNROLL
    for (uint32_t k = 0; k < levels; k++)
        keys[k] = packet->keys[k];
    for (uint32_t j = begin; j < end; j++) {
        JoxFloats dx = jf_sub(jf_set(x[j]), packet->x), dy = jf_sub(jf_set(y[j]), packet->y);
        JoxFloats d2 = jf_add(jf_mul(dx, dx), jf_mul(dy, dy));
        JoxMask near = jm_without(jf_le(d2, packet->within2), ji_equal(self, ji_set((int32_t)j)));
        if (!jm_bits(near))
            continue;
        if (number == MOST_CANDIDATES) {
            packet->overflow = true;
            break;
        }
        packet->index[number] = j;
        jf_store(packet->distance2 + (size_t)number * JOX_WIDTH, jf_select(near, d2, none));
        JoxInts share = jf_to_ints(jf_min(jf_mul(d2, packet->scale), farthest));
        JoxFloats key = ji_as_floats(
            ji_add(ji_shift_left(share, NUMBER_BITS), ji_set((int32_t)(NORMAL + number))));
        key = jf_select(near, key, none);
        number++;
        JOX_UNROLL
        for (uint32_t k = 0; k < levels; k++) {
            JoxFloats farther = jf_max(keys[k], key);
            keys[k] = jf_min(keys[k], key);
            key = farther;
        }
    }
    JOX_UNROLL
    for (uint32_t k = 0; k < levels; k++)
        packet->keys[k] = keys[k];
    packet->candidates = number;
}

static void sink_few(Packet *packet, uint32_t begin, uint32_t end) {
    sink(packet, begin, end, FEW + 1);
}

static void sink_many(Packet *packet, uint32_t begin, uint32_t end) {
    sink(packet, begin, end, JOX_MOST_NEIGHBOURS + 1);
}

/* Where the lanes of a stretch are, at the image that is looked at, and how far they search, m. */
typedef struct Stretch {
    JoxV2 low, high;
    float radius;
} Stretch;

/* Of agents [begin, end) of a row, the first that lies beyond x. */
static uint32_t row_past(const JoxNav *nav, uint32_t begin, uint32_t end, float x) {
    uint32_t past = begin, few = JOX_WIDTH;
    for (; past < end && few == JOX_WIDTH; past += few) {
        const uint32_t within = jm_bits(jf_le(jf_load(nav->sorted_x + past), jf_set(x)));
        few = (uint32_t)__builtin_ctz(~within); /* ascending: those within come first */
    }
    return past < end ? past : end; /* beyond the end lies the next row */
}

/* Candidates of a stretch: row by row those within the greatest radius of where its lanes are. */
static void sink_stretch(Packet *packet, const Stretch *s) {
    const JoxNav *nav = packet->p->nav;
    float wide = s->radius + nav->drift;
    uint32_t low = jox_row_of(nav, s->low.y - wide), high = jox_row_of(nav, s->high.y + wide);
    for (uint32_t row = low; row <= high; row++) {
        float bottom = nav->low.y + (float)row * nav->height;
        float below = s->low.y - (bottom + nav->height) - nav->drift;
        float above = bottom - s->high.y - nav->drift;
        float across = jox_maxf(0.0f, jox_maxf(below, above));
        float half2 = jox_maxf(0.0f, s->radius * s->radius - across * across);
        float along = sqrtf(half2) + nav->drift;
        uint32_t *hint = &packet->hints[row % JOX_ROW_HINTS], end = nav->row_first[row + 1];
        uint32_t begin = *hint = jox_row_from(nav, row, s->low.x - along, *hint);
        (packet->levels <= FEW + 1 ? sink_few : sink_many)(
            packet, begin, row_past(nav, begin, end, s->high.x + along));
    }
}

static void take_in(Stretch *s, JoxV2 at, float radius) {
    s->low = (JoxV2){jox_minf(s->low.x, at.x), jox_minf(s->low.y, at.y)};
    s->high = (JoxV2){jox_maxf(s->high.x, at.x), jox_maxf(s->high.y, at.y)};
    s->radius = jox_maxf(s->radius, radius);
}

/* Searches for some lanes (bits), of which each has its own radius, at one image of theirs. */
static void search_image(Packet *packet, uint32_t lanes, JoxV2 shift) {
    const JoxNav *nav = packet->p->nav;
    const JoxFloats radius = jf_load(packet->radius), none = jf_set(-1.0f);
    packet->x = jf_add(jf_load(packet->at_x), jf_set(shift.x));
    packet->y = jf_add(jf_load(packet->at_y), jf_set(shift.y));
    uint32_t row = packet->row;
    for (uint32_t lane = 0; lane < JOX_WIDTH && lanes >> lane;) {
        Stretch s = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}, 0.0f};
        uint32_t bits = 0;
        while (nav->row_first[row + 1] <= packet->first + lane)
            row++;
        uint32_t end = nav->row_first[row + 1] - packet->first;
        for (; lane < JOX_WIDTH && lane < end; lane++) {
            if (!(lanes >> lane & 1))
                continue;
            JoxV2 at = {packet->at_x[lane] + shift.x, packet->at_y[lane] + shift.y};
            float reach = packet->radius[lane] + nav->drift;
            if (bits && at.x - reach > s.high.x + s.radius + nav->drift)
                break; /* their ranges do not meet: a stretch of its own */
            take_in(&s, at, packet->radius[lane]);
            bits |= 1u << lane;
        }
        if (!bits)
            continue;
        packet->within2 = jf_select(jm_of_bits(bits), jf_mul(radius, radius), none);
        sink_stretch(packet, &s);
    }
}

/* The lanes, of some, that see over the edges that one of the nine images lies beyond. */
static uint32_t lanes_of_image(const Packet *packet, uint32_t lanes, int column, int row,
                               JoxV2 *shift) {
    const JoxAgents *a = packet->p->agents;
    const float drift = packet->p->nav->drift;
    uint32_t bits = 0;
    *shift = (JoxV2){(float)column * a->period.x, (float)row * a->period.y};
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++) {
        float wide = packet->radius[lane] + drift;
        if ((lanes >> lane & 1) &&
            jox_sees_image(packet->at_x[lane], a->origin.x, a->period.x, wide, column) &&
            jox_sees_image(packet->at_y[lane], a->origin.y, a->period.y, wide, row))
            bits |= 1u << lane;
    }
    return bits;
}

/* Whether no lane, of some, sees over an edge. */
static bool all_within(const Packet *packet, uint32_t lanes) {
    const JoxAgents *a = packet->p->agents;
    const JoxFloats wide = jf_add(jf_load(packet->radius), jf_set(packet->p->nav->drift));
    const JoxFloats x = jf_load(packet->at_x), y = jf_load(packet->at_y);
    JoxMask over = jf_lt(wide, jf_set(-INFINITY)); /* nobody */
    if (a->period.x > 0.0f)
        over = jm_or(jf_le(jf_sub(x, wide), jf_set(a->origin.x)),
                     jf_le(jf_set(a->origin.x + a->period.x), jf_add(x, wide)));
    if (a->period.y > 0.0f)
        over = jm_or(over, jm_or(jf_le(jf_sub(y, wide), jf_set(a->origin.y)),
                                 jf_le(jf_set(a->origin.y + a->period.y), jf_add(y, wide))));
    return !(jm_bits(over) & lanes);
}

/* The keys of some lanes, anew. */
static void search(Packet *packet, uint32_t lanes) {
    const JoxFloats radius = jf_load(packet->radius);
    packet->scale = jf_div(jf_set(FARTHEST_SHARE), jf_max(jf_mul(radius, radius), jf_set(1e-12f)));
    packet->candidates = 0;
    packet->overflow = false;
    for (uint32_t k = 0; k <= JOX_MOST_NEIGHBOURS; k++)
        packet->keys[k] = jf_set(INFINITY);
    if (all_within(packet, lanes)) {
        search_image(packet, lanes, (JoxV2){0.0f, 0.0f});
        return;
    }
    for (int row = -1; row <= 1; row++)
        for (int column = -1; column <= 1; column++) {
            JoxV2 shift;
            uint32_t seeing = lanes_of_image(packet, lanes, column, row, &shift);
            if (seeing)
                search_image(packet, seeing, shift);
        }
}

/* What the keys of a packet say, lane by lane. */
typedef struct Found {
    JoxMask full, tied, cut; /* cut: the last wanted and the next are tied */
    JoxInts most, count;     /* neighbours wanted, and found */
    JoxFloats farthest2;     /* where full: of the last wanted, m2 */
} Found;

static inline JoxFloats distance2_at(const Packet *packet, JoxInts numbers) {
    return jf_pick(packet->distance2, ji_add(ji_lane(), ji_shift_left(numbers, WIDTH_BITS)));
}

static Found read_keys(const Packet *packet, JoxInts most) {
    const JoxFloats none = jf_set(INFINITY);
    const JoxInts number_of = ji_set(MOST_CANDIDATES - 1);
    const JoxMask nobody = jf_lt(none, none);
    Found f = {nobody, nobody, nobody, most, ji_set(0), none};
    JoxInts farthest = ji_set(0); /* number of the last wanted */
    for (uint32_t k = 0; k + 1 < packet->levels; k++) {
        const JoxFloats key = packet->keys[k], next = packet->keys[k + 1];
        const JoxMask wanted = ji_less(ji_set((int32_t)k), most), there = jf_lt(key, none);
        f.count = ji_select(jm_and(wanted, there), ji_set((int32_t)k + 1), f.count);
        JoxMask last = jm_and(ji_equal(most, ji_set((int32_t)k + 1)), there);
        f.full = jm_or(f.full, last);
        farthest = ji_select(last, ji_and(jf_bits(key), number_of), farthest);
        JoxMask same = ji_equal(ji_shift_right(jf_bits(key), NUMBER_BITS),
                                ji_shift_right(jf_bits(next), NUMBER_BITS));
        const JoxMask tied = jm_and(same, jm_and(wanted, jf_lt(next, none)));
        f.tied = jm_or(f.tied, tied);
        f.cut = jm_or(f.cut, jm_and(tied, last));
    }
    if (jm_bits(f.full))
        f.farthest2 = jf_select(f.full, distance2_at(packet, farthest), none);
    return f;
}

static inline void store_floats(float *to, JoxMask m, JoxFloats a) {
    jf_store(to, jf_select(m, a, jf_load(to)));
}

/* Writes what was found for some lanes. */
static void write(const Packet *packet, const Found *f, uint32_t lanes, JoxFloats perception) {
    const JoxPerceive *p = packet->p;
    const JoxMask mask = jm_of_bits(lanes);
    const JoxInts number_of = ji_set(MOST_CANDIDATES - 1);
    JoxFloats reach = jf_select(f->full, jf_sqrt(f->farthest2), perception);
    JoxFloats area = jf_max(jf_mul(reach, reach), jf_set(JOX_DENSITY_LEAST));
    store_floats(p->agents->search + packet->first, mask, jf_max(reach, jf_set(JOX_SEARCH_LEAST)));
    store_floats(p->agents->density + packet->first, mask,
                 jf_div(ji_to_floats(f->count), jf_mul(jf_set(JOX_PI), area)));
    uint32_t counts[JOX_WIDTH];
    ji_store(counts, f->count);
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        if (lanes >> lane & 1)
            p->out->count[packet->first + lane] = (uint8_t)counts[lane];
    for (uint32_t k = 0; k + 1 < packet->levels; k++) {
        const JoxMask kept = jm_and(mask, ji_less(ji_set((int32_t)k), f->count));
        const size_t at = jox_neighbour_at(p->out, packet->first, k);
        const JoxInts number = ji_and(jf_bits(packet->keys[k]), number_of);
        store_floats(p->out->distance2 + at, kept, distance2_at(packet, number));
        ji_store(p->out->index + at,
                 ji_select(kept, ji_pick(packet->index, number), ji_load(p->out->index + at)));
    }
}

/* Those who may touch, of the lanes whose neighbours may lack some. */
static void find_touching(const Packet *packet, JoxMask sees) {
    const JoxPerceive *p = packet->p;
    const JoxFloats radius = jf_load(p->agents->param[JOX_PARAM_radius] + packet->first);
    JoxFloats range = jf_add(jf_add(radius, jf_set(p->out->widest)), jf_set(JOX_TOUCH_LEAST));
    range = jf_min(jf_add(range, jf_set(JOX_TOUCH_MOST)), jf_set(p->sight));
    JoxFloats reach = jf_select(sees, jf_load(p->agents->search + packet->first), jf_set(0.0f));
    const uint32_t lacking = jm_bits(jf_lt(reach, range));
    float ranges[JOX_WIDTH];
    jf_store(ranges, range);
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        if (packet->lanes >> lane & lacking >> lane & 1)
            jox_perceive_touching(p, packet->first + lane, ranges[lane]);
        else if (packet->lanes >> lane & 1)
            p->out->touch_count[packet->first + lane] = JOX_TOUCH_IS_SEEN;
}

/* For each lane, numbers of candidates. */
typedef struct Likely {
    uint8_t numbers[JOX_WIDTH][MOST_CANDIDATES];
    uint32_t count[JOX_WIDTH];
} Likely;

/* Who may be among the nearest of some lanes: those of the keys; of lanes that are `cut`, also who
   is as far as the last key by its bits, but numbered higher, so that no key is left of them. */
static void list_likely(const Packet *packet, uint32_t lanes, uint32_t cut, Likely *likely) {
    const JoxFloats farthest = jf_set(FARTHEST_SHARE), last = packet->keys[packet->levels - 1];
    const JoxInts last_share = ji_shift_right(jf_bits(last), NUMBER_BITS);
    const JoxInts last_number = ji_and(jf_bits(last), ji_set(MOST_CANDIDATES - 1));
    uint32_t bits[(JOX_MOST_NEIGHBOURS + 1) * JOX_WIDTH];
    for (uint32_t k = 0; k < packet->levels; k++)
        ji_store(bits + k * JOX_WIDTH, jf_bits(packet->keys[k]));
    for (uint32_t left = lanes; left; left &= left - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(left), *key = bits + lane;
        uint32_t n = 0;
        for (; n < packet->levels && key[n * JOX_WIDTH] < NO_KEY; n++)
            likely->numbers[lane][n] = (uint8_t)key[n * JOX_WIDTH];
        likely->count[lane] = n;
    }
    for (uint32_t n = 0; cut && n < packet->candidates; n++) {
        const JoxFloats d2 = jf_load(packet->distance2 + (size_t)n * JOX_WIDTH);
        const JoxInts share = jf_to_ints(jf_min(jf_mul(d2, packet->scale), farthest));
        const JoxInts shifted = ji_add(share, ji_set(NORMAL >> NUMBER_BITS));
        const JoxMask higher = ji_less(last_number, ji_set((int32_t)n));
        uint32_t as_far = jm_bits(jm_and(ji_equal(shifted, last_share), higher)) & cut;
        for (; as_far; as_far &= as_far - 1) {
            const uint32_t lane = (uint32_t)__builtin_ctz(as_far);
            if (packet->distance2[n * JOX_WIDTH + lane] < INFINITY)
                likely->numbers[lane][likely->count[lane]++] = (uint8_t)n;
        }
    }
}

/* Of some lanes whose keys do not tell: one by one. */
static void choose_anew(const Packet *packet, uint32_t lanes, JoxMask cut) {
    if (packet->overflow) {
        for (; lanes; lanes &= lanes - 1) {
            const uint32_t lane = (uint32_t)__builtin_ctz(lanes);
            jox_perceive_one(packet->p, packet->first + lane, packet->radius[lane]);
        }
        return;
    }
    Likely likely;
    list_likely(packet, lanes, jm_bits(cut) & lanes, &likely);
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(lanes);
        const JoxCandidates among = {likely.numbers[lane], packet->index, packet->distance2 + lane,
                                     likely.count[lane], JOX_WIDTH};
        jox_perceive_among(packet->p, packet->first + lane, &among);
    }
}

static void perceive_packet(Packet *packet) {
    const JoxPerceive *p = packet->p;
    const JoxAgents *a = p->agents;
    const uint32_t i = packet->first;
    const JoxFloats perception =
        jf_min(jf_load(a->param[JOX_PARAM_perception] + i), jf_set(p->sight));
    const JoxFloats last = jf_load(a->search + i), zero = jf_set(0.0f);
    const JoxInts most = jf_to_ints(jf_load(a->param[JOX_PARAM_neighbours] + i));
    JoxFloats radius = jf_select(jf_lt(zero, last), jf_add(last, jf_set(JOX_SEARCH_SLACK)),
                                 jf_mul(perception, jf_set(0.5f)));
    jf_store(packet->at_x, jf_load(a->x + i));
    jf_store(packet->at_y, jf_load(a->y + i));
    const JoxMask sees = ji_less(ji_set(0), most);
    for (uint32_t left = packet->lanes; left;) {
        radius = jf_min(radius, perception);
        jf_store(packet->radius, radius);
        search(packet, left);
        const Found f = read_keys(packet, most);
        const JoxMask short_of = jm_and(sees, jm_without(jf_lt(radius, perception), f.full));
        const uint32_t done = packet->overflow ? left : left & ~jm_bits(short_of);
        const uint32_t tied = packet->overflow ? left : done & jm_bits(f.tied);
        write(packet, &f, done & ~tied, perception);
        if (tied)
            choose_anew(packet, tied, f.cut);
        left &= ~done;
        radius = jf_mul(radius, jf_set(JOX_SEARCH_GROWTH));
    }
    find_touching(packet, sees);
}

void JOX_WIDE(jox_perceive_packets)(const JoxPerceive *p, uint32_t begin, uint32_t end) {
    Packet packet; /* large: what is written before it is read is left as it is */
    packet.p = p;
    packet.row = 0;
    memset(packet.hints, 0, sizeof packet.hints);
    const float *most = p->agents->param[JOX_PARAM_neighbours];
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        uint32_t count = end - i < JOX_WIDTH ? end - i : JOX_WIDTH;
        packet.first = i;
        packet.lanes = (1u << count) - 1;
        packet.levels = 1;
        for (uint32_t lane = 0; lane < count; lane++)
            if ((uint32_t)most[i + lane] + 1 > packet.levels)
                packet.levels = (uint32_t)most[i + lane] + 1;
        while (p->nav->row_first[packet.row + 1] <= i)
            packet.row++;
        perceive_packet(&packet);
    }
}
