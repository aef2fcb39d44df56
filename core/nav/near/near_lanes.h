/* Sorts the candidate lists of all lanes of a packet by distance, at once. Part of the kernel
   perceive_wide.c.

   A key is a float that no arithmetic is done with: min and max of floats sort distances and list
   places together. The upper bits hold the number of the squared distance among all floats, counted
   from a floor on (the bits of positive floats ascend with their values); the lower bits hold the
   place in the list. Candidates nearer than the floor, a fifteenth of the radius, count as at the
   floor. Keys of equal distance are then sorted by id, and keys at the floor by their exact
   distance first: so the neighbours are exact at any width. */
#ifndef JOX_NAV_NEAR_LANES_H
#define JOX_NAV_NEAR_LANES_H

#include <math.h>

#include "base/assert.h"
#include "nav/near/perceive.h"
#include "simd/order.h"
#include "simd/vectors.h"

enum {
    PLACE_BITS = 5,
    PLACES = 1 << PLACE_BITS, /* places of a list that a key can name; a longer list overflows */
    LIST = 64,                /* places of a list in memory */
    ROOM = LIST - JOX_LANES,  /* places up to which a whole packet may still be appended */
    SPARSE = 4,               /* places of lists that the short network sorts */
    ORDERED = 16, /* places that the long network sorts; later ones are inserted one at a time */
    FEW = 10,     /* neighbours whose keys fit into the registers of most instruction sets */
    NO_KEY = 0x7f800000, /* bits of INFINITY */
    NORMAL = 0x00800000  /* bits of the least normal float */
};
/* The floor as a share of the squared radius. Between the two lie at most 7.86 x 2^23 floats; more
   would make keys of INFINITY and beyond. */
static const float FLOOR_SHARE = 1.0f / 224.0f;

typedef struct Packet {
    const JoxPerceive *p;
    uint32_t first;  /* agent of lane 0 */
    uint32_t lanes;  /* bits of the lanes that have an agent */
    uint32_t levels; /* keys that are kept: 1 + the most neighbours wanted by any lane */
    float radius[JOX_LANES], at_x[JOX_LANES], at_y[JOX_LANES]; /* m */
    float floor2[JOX_LANES];           /* m2: lesser squared distances count as this */
    uint32_t count[JOX_LANES];         /* candidates within the radius */
    uint32_t index[JOX_WIDTH * LIST];  /* lists, one lane after the other */
    float distance2[JOX_WIDTH * LIST]; /* m2 */
    JoxFloats keys[JOX_MOST_NEIGHBOURS + 1];
} Packet;

/* Returns the lanes (bits) whose lists have more than `places` places. */
static inline uint32_t find_longer_lists(const Packet *packet, uint32_t places) {
    return jm_bits(ji_less(ji_set((int32_t)places), ji_load(packet->count)));
}

/* Returns the addend that makes a key at place 0 of the shifted bits of a distance; 1 more for each
   further place. */
static inline JoxInts make_first_key(JoxFloats floor2) {
    return ji_sub(ji_set(NORMAL), ji_shift_left(jf_bits(floor2), PLACE_BITS));
}

/* Returns the bits of keys; `place` holds that addend plus the place. */
static inline JoxInts make_lane_key(JoxFloats distance2, JoxFloats floor2, JoxInts place) {
    return ji_add(ji_shift_left(jf_bits(jf_max(distance2, floor2)), PLACE_BITS), place);
}

/* State of reading all lists, place by place: places left in each list, and the addend of the next
   key. It is counted up, as a constant for each place would take three instructions. */
typedef struct Reading {
    JoxInts left;
    JoxFloats floor2;
    JoxInts place, one;
} Reading;

static inline Reading begin_key_reading(JoxInts count, JoxFloats floor2) {
    return (Reading){count, floor2, make_first_key(floor2), ji_opaque(ji_set(1))};
}

/* Makes the keys of the next four places; INFINITY behind the end of a list. */
static inline void read_places(const Packet *packet, Reading *r, uint32_t from, JoxFloats keys[4]) {
    const JoxInts none = ji_set(0);
    JoxFloats distance2[4];
    jf_fours(packet->distance2 + from, LIST, distance2);
    JOX_UNROLL
    for (uint32_t k = 0; k < 4; k++) {
        const JoxFloats key = ji_as_floats(make_lane_key(distance2[k], r->floor2, r->place));
        keys[k] = jf_select(ji_less(none, r->left), key, jf_set(INFINITY));
        r->left = ji_sub(r->left, r->one);
        r->place = ji_add(r->place, r->one);
    }
}

/* Sets the floor from the radius; returns it, m2. */
static inline JoxFloats choose_floor(Packet *packet) {
    const JoxFloats radius = jf_load(packet->radius);
    const JoxFloats radius2 = jf_max(radius * radius, jf_set(1e-12f));
    const JoxFloats floor2 = radius2 * FLOOR_SHARE;
    jf_store(packet->floor2, floor2);
    return floor2;
}

/* Sorts the least `levels` keys of all lists; lists within the network are sorted whole. */
static inline __attribute__((always_inline)) void order_lists(Packet *packet,
                                                              const uint32_t levels) {
    Reading reading = begin_key_reading(ji_load(packet->count), choose_floor(packet));
    JoxFloats keys[JOX_MOST_NEIGHBOURS + 1];
    JOX_UNROLL
    for (uint32_t from = 0; from < ORDERED; from += 4)
        read_places(packet, &reading, from, keys + from);
    keys[ORDERED] = jf_set(INFINITY);
    jox_order_16(keys);
    for (uint32_t from = ORDERED; from < PLACES && find_longer_lists(packet, from); from += 4) {
        JoxFloats more[4];
        read_places(packet, &reading, from, more);
        for (uint32_t m = 0; m < 4; m++) {
            JoxFloats key = more[m];
            JOX_UNROLL
            for (uint32_t k = 0; k < levels; k++) {
                const JoxFloats farther = jf_max(keys[k], key);
                keys[k] = jf_min(keys[k], key);
                key = farther;
            }
        }
    }
    JOX_UNROLL
    for (uint32_t k = 0; k < (levels > ORDERED ? levels : ORDERED); k++)
        packet->keys[k] = keys[k];
}

static void order_few(Packet *packet) {
    order_lists(packet, FEW + 1);
}

static void order_many(Packet *packet) {
    order_lists(packet, JOX_MOST_NEIGHBOURS + 1);
}

/* Sorts lists that all have at most SPARSE places. */
static void order_sparse(Packet *packet) {
    JoxFloats *keys = packet->keys;
    Reading reading = begin_key_reading(ji_load(packet->count), choose_floor(packet));
    read_places(packet, &reading, 0, keys);
    jox_order_4(keys);
    for (uint32_t k = SPARSE; k < ORDERED || k < packet->levels; k++)
        keys[k] = jf_set(INFINITY);
}

static inline void order_packet(Packet *packet) {
    if (!find_longer_lists(packet, SPARSE))
        order_sparse(packet);
    else if (packet->levels <= FEW + 1)
        order_few(packet);
    else
        order_many(packet);
}

/* Result of reading the keys of a packet, by lane. */
typedef struct Found {
    JoxMask full, tied;  /* full: as many found as wanted; tied: two keys of equal distance */
    JoxInts most, count; /* neighbours wanted; found */
    bool whole;          /* all lanes want levels - 1 neighbours, and are full */
} Found;

/* Returns the indices into `index` and `distance2` of the places that keys name. */
static inline JoxInts find_listed(JoxFloats keys) {
    const JoxInts lists = jf_to_ints(ji_to_floats(ji_lane()) * (float)LIST);
    return ji_add(ji_and(jf_bits(keys), ji_set(PLACES - 1)), lists);
}

/* Bits of the distance in keys; FLOOR: those at the floor. */
enum { FLOOR = NORMAL >> PLACE_BITS };
static inline JoxInts distance_bits(JoxFloats keys) {
    return ji_shift_right(jf_bits(keys), PLACE_BITS);
}

static Found read_keys(const Packet *packet, JoxInts most) {
    const JoxInts listed = ji_load(packet->count);
    const JoxMask few = ji_less(listed, most);
    Found f = {jm_without(ji_less(ji_set(0), most), few), jm_of_bits(0), most,
               ji_select(few, listed, most), false};
    const JoxMask whole = jm_and(f.full, ji_equal(most, ji_set((int32_t)packet->levels - 1)));
    f.whole = jm_bits(whole) == JOX_ALL_LANES;
    /* A tie matters if its first key is wanted and its second one exists. */
    const JoxInts ties = ji_select(ji_less(most, listed), most, ji_sub(listed, ji_set(1)));
    JoxInts here = distance_bits(packet->keys[0]);
    for (uint32_t k = 0; k + 1 < packet->levels; k++) {
        const JoxInts at = ji_set((int32_t)k), next = distance_bits(packet->keys[k + 1]);
        JoxMask same = ji_equal(here, next);
        if (!f.whole) {
            if (!jm_bits(ji_less(at, f.count)))
                break; /* a sparse crowd ends here */
            same = jm_and(same, ji_less(at, ties));
        }
        f.tied = jm_or(f.tied, same);
        here = next;
    }
    return f;
}

/* Returns the squared distance, m2, of the last neighbour wanted, for lanes that are full. */
static JoxFloats pick_farthest2(const Packet *packet, const Found *f) {
    JoxFloats key = packet->keys[f->whole ? packet->levels - 2 : 0];
    for (uint32_t k = 1; !f->whole && k + 1 < packet->levels; k++)
        key = jf_select(ji_equal(f->most, ji_set((int32_t)k + 1)), packet->keys[k], key);
    return jf_pick(packet->distance2, find_listed(key));
}

/* Returns whether the candidate at place `one` comes before that at `other`: by distance, then
   id. */
static bool is_listed_before(const Packet *packet, size_t one, size_t other) {
    const uint32_t *rank = packet->p->agents->rank;
    if (packet->distance2[one] != packet->distance2[other])
        return packet->distance2[one] < packet->distance2[other];
    return rank[packet->index[one]] < rank[packet->index[other]];
}

/* Returns key k of one lane; the keys of a lane stand JOX_WIDTH apart. */
static inline uint32_t *key_at(uint32_t *keys, uint32_t k) {
    return keys + (size_t)k * JOX_WIDTH;
}

/* Inserts a key into the sorted keys [from, at). */
static void insert_key(const Packet *packet, uint32_t lane, uint32_t *keys, uint32_t from,
                       uint32_t at, uint32_t key) {
    const size_t list = (size_t)lane * LIST;
    for (; at > from &&
           is_listed_before(packet, list + key % PLACES, list + *key_at(keys, at - 1) % PLACES);
         at--)
        *key_at(keys, at) = *key_at(keys, at - 1);
    *key_at(keys, at) = key;
}

/* Sorts the last keys, from `from` on, which all have one distance that dropped candidates may have
   too: keeps the first of all of these in exact order. */
static void settle_last(const Packet *packet, uint32_t lane, uint32_t *keys, uint32_t from) {
    const size_t list = (size_t)lane * LIST;
    const uint32_t first = *key_at(keys, from);
    const float least2 = packet->floor2[lane];
    const float one2 = jox_maxf(packet->distance2[list + first % PLACES], least2);
    uint32_t n = from;
    for (uint32_t place = 0; place < packet->count[lane]; place++) {
        const float distance2 = jox_maxf(packet->distance2[list + place], least2);
        if (distance2 < one2 || one2 < distance2)
            continue;
        const uint32_t key = first - first % PLACES + place;
        if (n < packet->levels)
            insert_key(packet, lane, keys, from, n++, key);
        else if (is_listed_before(packet, list + place, list + *key_at(keys, n - 1) % PLACES))
            insert_key(packet, lane, keys, from, n - 1, key);
    }
    JOX_ASSERT(n == packet->levels);
}

/* Sorts the keys of equal distance of one lane in exact order. */
static void settle_ties(const Packet *packet, uint32_t lane, uint32_t *keys) {
    uint32_t from = 0; /* first key of the current distance */
    for (uint32_t k = 1; k < packet->levels && *key_at(keys, k) < NO_KEY; k++) {
        const uint32_t key = *key_at(keys, k);
        if (*key_at(keys, k - 1) >> PLACE_BITS != key >> PLACE_BITS)
            from = k;
        else if (k + 1 < packet->levels)
            insert_key(packet, lane, keys, from, k, key);
        else
            settle_last(packet, lane, keys, from);
    }
}

/* Sorts ties of `lanes` (bits) one lane at a time, for lanes whose last keys may tie with dropped
   ones. */
static void settle_alone(Packet *packet, uint32_t lanes) {
    uint32_t keys[(JOX_MOST_NEIGHBOURS + 1) * JOX_WIDTH];
    for (uint32_t k = 0; k < packet->levels; k++)
        ji_store(key_at(keys, k), jf_bits(packet->keys[k]));
    for (uint32_t left = lanes; left; left &= left - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(left);
        settle_ties(packet, lane, keys + lane);
    }
    for (uint32_t k = 0; k < packet->levels; k++)
        packet->keys[k] = ji_as_floats(ji_load(key_at(keys, k)));
}

/* Returns the ranks by id of the candidates that keys name. */
static inline JoxInts pick_ranks(const Packet *packet, JoxMask lanes, JoxFloats key) {
    const JoxInts none = ji_set(0);
    const JoxMask there = jm_and(lanes, jf_lt(key, jf_set(INFINITY)));
    const JoxInts at = ji_select(there, find_listed(key), none);
    return ji_pick(packet->p->agents->rank, ji_select(there, ji_pick(packet->index, at), none));
}

/* Swaps two consecutive keys of each lane where they are tied and in the wrong order. Returns the
   lanes where it did. */
static inline JoxMask settle_pair(JoxFloats *keys, JoxInts *ranks, JoxMask tied) {
    const JoxFloats key = keys[0];
    const JoxInts rank = ranks[0];
    const JoxMask changes = jm_and(tied, ji_less(ranks[1], rank));
    keys[0] = jf_select(changes, keys[1], key);
    keys[1] = jf_select(changes, key, keys[1]);
    ranks[0] = ji_select(changes, ranks[1], rank);
    ranks[1] = ji_select(changes, rank, ranks[1]);
    return changes;
}

/* Sorts the ties of `lanes` in lock step; all keys of each tied distance are present, and at most
   one key is at the floor. Lanes of `all` have `count` keys to sort, the others `levels`. */
static void settle_together(Packet *packet, JoxMask lanes, JoxMask all, uint32_t count) {
    JoxMask tied[JOX_MOST_NEIGHBOURS + 1]; /* each key with the next */
    JoxInts ranks[JOX_MOST_NEIGHBOURS + 1];
    uint32_t last = 0; /* last tied key */
    for (uint32_t k = 0; k + 1 < count; k++) {
        const JoxFloats *keys = packet->keys + k;
        const JoxMask there =
            jm_and(k + 1 < packet->levels ? lanes : all, jf_lt(keys[1], jf_set(INFINITY)));
        tied[k] = jm_and(there, ji_equal(distance_bits(keys[0]), distance_bits(keys[1])));
        if (!jm_bits(tied[k]))
            continue;
        if (k == 0 || last < k)
            ranks[k] = pick_ranks(packet, lanes, keys[0]);
        ranks[k + 1] = pick_ranks(packet, lanes, keys[1]);
        last = k + 1;
    }
    for (uint32_t changed = last; changed;) {
        changed = 0;
        for (uint32_t k = 0; k < last; k++)
            if (jm_bits(tied[k]))
                changed |= jm_bits(settle_pair(packet->keys + k, ranks + k, tied[k]));
    }
}

/* Sorts the ties of `lanes` (bits): in lock step where all keys of a tied distance are present
   (behind the last level only short lists keep them), else one lane at a time, as for keys at the
   floor, which do not tell which is nearer. */
static void settle_lanes(Packet *packet, uint32_t lanes) {
    JOX_ASSERT(packet->levels > 1); /* with one level there are no ties */
    const uint32_t last = packet->levels - 1;
    const JoxMask cut =
        ji_equal(distance_bits(packet->keys[last]), distance_bits(packet->keys[last - 1]));
    const JoxMask floored = ji_equal(distance_bits(packet->keys[1]), ji_set(FLOOR));
    const uint32_t over = lanes & jm_bits(cut) & find_longer_lists(packet, packet->levels);
    const uint32_t alone = (over & find_longer_lists(packet, ORDERED)) | (lanes & jm_bits(floored));
    if (alone)
        settle_alone(packet, alone);
    if (lanes & ~alone)
        settle_together(packet, jm_of_bits(lanes & ~alone), jm_of_bits(over & ~alone),
                        over & ~alone ? ORDERED : packet->levels);
}

#endif
