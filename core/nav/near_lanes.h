/* The lists of those who are near the agents of a packet, put in order: the keys that say who comes
   first. For kernels: part of perceive_wide.c.

   A key is a float that is never computed with, so that min and max sort distances and places in
   the list at once. Its upper bits tell which float the squared distance is, counted from a floor
   on (the bits of floats ascend with them); its lower bits are the place. Whoever is nearer than
   the floor, a fifteenth of the radius, counts as at the floor. Two keys of the same distance are
   put in the order of the ids, those at the floor in their exact order first: so neighbours are
   exact, whatever the width. */
#ifndef JOX_NAV_NEAR_LANES_H
#define JOX_NAV_NEAR_LANES_H

#include <math.h>

#include "base/assert.h"
#include "nav/kernels.h"
#include "simd/order.h"
#include "simd/vectors.h"

enum {
    PLACE_BITS = 5,
    PLACES = 1 << PLACE_BITS, /* of a list, that keys can tell; of more it is full */
    LIST = 64,                /* places that there is room for */
    ROOM = LIST - JOX_LANES,  /* a whole packet may be written behind so many */
    SPARSE = 4,               /* places of lists of which the rest needs no order */
    ORDERED = 16,             /* places that are ordered by a network; more sink in */
    FEW = 10, /* neighbours of which the keys fit into the registers of most instruction sets */
    NO_KEY = 0x7f800000, /* bits of INFINITY */
    NORMAL = 0x00800000  /* bits of the least float that is not denormal */
};
/* Of a squared radius. From there up to it are at most 7.86 * 2^23 floats, more than which would
   make keys of INFINITY and beyond. */
static const float FLOOR_SHARE = 1.0f / 224.0f;

typedef struct Packet {
    const JoxPerceive *p;
    uint32_t first;  /* agent of lane 0 */
    uint32_t lanes;  /* bits of those that are there */
    uint32_t levels; /* keys that are kept: one more than the most neighbours of any lane */
    float radius[JOX_LANES], at_x[JOX_LANES], at_y[JOX_LANES]; /* m */
    float floor2[JOX_LANES];                                   /* m2 */
    uint32_t count[JOX_LANES];                                 /* within the radius */
    uint32_t index[JOX_WIDTH * LIST];                          /* lists, lane after lane */
    float distance2[JOX_WIDTH * LIST];                         /* m2 */
    JoxFloats keys[JOX_MOST_NEIGHBOURS + 1];
} Packet;

/* The lanes of which lists have more than so many places. */
static inline uint32_t lists_beyond(const Packet *packet, uint32_t places) {
    return jm_bits(ji_less(ji_set((int32_t)places), ji_load(packet->count)));
}

/* What the bits of distances are added to, to give keys of place 0; of the next place, 1 more. */
static inline JoxInts first_key(JoxFloats floor2) {
    return ji_sub(ji_set(NORMAL), ji_shift_left(jf_bits(floor2), PLACE_BITS));
}

/* The bits of keys, at a place. */
static inline JoxInts key_of(JoxFloats distance2, JoxFloats floor2, JoxInts place) {
    return ji_add(ji_shift_left(jf_bits(jf_max(distance2, floor2)), PLACE_BITS), place);
}

/* How all lists are read, place by place: of each, the places that are left, and the next of them.
   These are counted on: a constant for each place would take three instructions to make. */
typedef struct Reading {
    JoxInts left;
    JoxFloats floor2;
    JoxInts place, one;
} Reading;

static inline Reading reading_of(JoxInts count, JoxFloats floor2) {
    return (Reading){count, floor2, first_key(floor2), ji_opaque(ji_set(1))};
}

/* The keys of the next four places. */
static inline void read_places(const Packet *packet, Reading *r, uint32_t from, JoxFloats keys[4]) {
    const JoxInts none = ji_set(0);
    JoxFloats distance2[4];
    jf_fours(packet->distance2 + from, LIST, distance2);
    JOX_UNROLL
    for (uint32_t k = 0; k < 4; k++) {
        const JoxFloats key = ji_as_floats(key_of(distance2[k], r->floor2, r->place));
        keys[k] = jf_select(ji_less(none, r->left), key, jf_set(INFINITY));
        r->left = ji_sub(r->left, r->one);
        r->place = ji_add(r->place, r->one);
    }
}

/* Sets the floor by the radius. */
static inline JoxFloats choose_floor(Packet *packet) {
    const JoxFloats radius = jf_load(packet->radius);
    const JoxFloats radius2 = jf_max(radius * radius, jf_set(1e-12f));
    const JoxFloats floor2 = radius2 * FLOOR_SHARE;
    jf_store(packet->floor2, floor2);
    return floor2;
}

/* The least keys of the lists, as many as there are levels; of lists that the network orders, all.
 */
static inline __attribute__((always_inline)) void order_lists(Packet *packet,
                                                              const uint32_t levels) {
    Reading reading = reading_of(ji_load(packet->count), choose_floor(packet));
    JoxFloats keys[JOX_MOST_NEIGHBOURS + 1];
    JOX_UNROLL
    for (uint32_t from = 0; from < ORDERED; from += 4)
        read_places(packet, &reading, from, keys + from);
    keys[ORDERED] = jf_set(INFINITY);
    jox_order_16(keys);
    for (uint32_t from = ORDERED; from < PLACES && lists_beyond(packet, from); from += 4) {
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

/* The same where no list has more than SPARSE places. */
static void order_sparse(Packet *packet) {
    JoxFloats *keys = packet->keys;
    Reading reading = reading_of(ji_load(packet->count), choose_floor(packet));
    read_places(packet, &reading, 0, keys);
    jox_order_4(keys);
    for (uint32_t k = SPARSE; k < ORDERED || k < packet->levels; k++)
        keys[k] = jf_set(INFINITY);
}

static inline void order(Packet *packet) {
    if (!lists_beyond(packet, SPARSE))
        order_sparse(packet);
    else if (packet->levels <= FEW + 1)
        order_few(packet);
    else
        order_many(packet);
}

/* What the keys of a packet say, lane by lane. */
typedef struct Found {
    JoxMask full, tied;  /* as many as wanted; two of the same distance by the bits of their keys */
    JoxInts most, count; /* neighbours wanted, and found */
    bool whole;          /* all lanes want as many as the packet has levels for, and are full */
} Found;

/* Where in the lists the places stand that keys of all lanes name. */
static inline JoxInts listed_at(JoxFloats keys) {
    const JoxInts lists = jf_to_ints(ji_to_floats(ji_lane()) * (float)LIST);
    return ji_add(ji_and(jf_bits(keys), ji_set(PLACES - 1)), lists);
}

/* The bits of keys that are of distances; FLOOR: of those at the floor. */
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
    /* Of a tie, the first is wanted and the second is there. */
    const JoxInts ties = ji_select(ji_less(most, listed), most, ji_sub(listed, ji_set(1)));
    JoxInts here = distance_bits(packet->keys[0]);
    for (uint32_t k = 0; k + 1 < packet->levels; k++) {
        const JoxInts at = ji_set((int32_t)k), next = distance_bits(packet->keys[k + 1]);
        JoxMask same = ji_equal(here, next);
        if (!f.whole) {
            if (!jm_bits(ji_less(at, f.count)))
                break; /* of a sparse crowd */
            same = jm_and(same, ji_less(at, ties));
        }
        f.tied = jm_or(f.tied, same);
        here = next;
    }
    return f;
}

/* The squared distance of the last neighbour wanted, m2, of lanes that are full. */
static JoxFloats farthest_of(const Packet *packet, const Found *f) {
    JoxFloats key = packet->keys[f->whole ? packet->levels - 2 : 0];
    for (uint32_t k = 1; !f->whole && k + 1 < packet->levels; k++)
        key = jf_select(ji_equal(f->most, ji_set((int32_t)k + 1)), packet->keys[k], key);
    return jf_pick(packet->distance2, listed_at(key));
}

/* Whether who stands at one place of a list comes before who stands at another. */
static bool is_before(const Packet *packet, size_t one, size_t other) {
    const uint32_t *rank = packet->p->agents->rank;
    if (packet->distance2[one] != packet->distance2[other])
        return packet->distance2[one] < packet->distance2[other];
    return rank[packet->index[one]] < rank[packet->index[other]];
}

/* The keys of one lane, the nearest first: those of a packet stand JOX_WIDTH apart. */
static inline uint32_t *key_at(uint32_t *keys, uint32_t k) {
    return keys + (size_t)k * JOX_WIDTH;
}

/* Puts a key behind those from `from` on, up to place `at`, that it does not come before. */
static void sink_in(const Packet *packet, uint32_t lane, uint32_t *keys, uint32_t from, uint32_t at,
                    uint32_t key) {
    const size_t list = (size_t)lane * LIST;
    for (;
         at > from && is_before(packet, list + key % PLACES, list + *key_at(keys, at - 1) % PLACES);
         at--)
        *key_at(keys, at) = *key_at(keys, at - 1);
    *key_at(keys, at) = key;
}

/* The last keys that are kept, from `from` on, have one distance, as others that are not kept may:
   the first of all of these in their exact order. */
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
            sink_in(packet, lane, keys, from, n++, key);
        else if (is_before(packet, list + place, list + *key_at(keys, n - 1) % PLACES))
            sink_in(packet, lane, keys, from, n - 1, key);
    }
    JOX_ASSERT(n == packet->levels);
}

/* Puts those of one lane whose keys have the same distance in their exact order. */
static void settle_ties(const Packet *packet, uint32_t lane, uint32_t *keys) {
    uint32_t from = 0; /* the first of the distance at hand */
    for (uint32_t k = 1; k < packet->levels && *key_at(keys, k) < NO_KEY; k++) {
        const uint32_t key = *key_at(keys, k);
        if (*key_at(keys, k - 1) >> PLACE_BITS != key >> PLACE_BITS)
            from = k;
        else if (k + 1 < packet->levels)
            sink_in(packet, lane, keys, from, k, key);
        else
            settle_last(packet, lane, keys, from);
    }
}

/* Settles the ties of some lanes whose last keys may have the distance of others that are not kept,
   one by one. */
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

/* The ranks by id of those at the places that keys name. */
static inline JoxInts rank_of(const Packet *packet, JoxMask lanes, JoxFloats key) {
    const JoxInts none = ji_set(0);
    const JoxMask there = jm_and(lanes, jf_lt(key, jf_set(INFINITY)));
    const JoxInts at = ji_select(there, listed_at(key), none);
    return ji_pick(packet->p->agents->rank, ji_select(there, ji_pick(packet->index, at), none));
}

/* Lets two keys of each lane, of which the second follows the first, change places where they are
   tied and stand in the wrong order. Returns where they did. */
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

/* Settles the ties of some lanes in lock step: all keys are there that have these distances, and
   none is at the floor but one. Those of `all` lanes have `count` keys to settle, the others as
   many as are kept. */
static void settle_together(Packet *packet, JoxMask lanes, JoxMask all, uint32_t count) {
    JoxMask tied[JOX_MOST_NEIGHBOURS + 1]; /* each with the next */
    JoxInts ranks[JOX_MOST_NEIGHBOURS + 1];
    uint32_t last = 0; /* tied */
    for (uint32_t k = 0; k + 1 < count; k++) {
        const JoxFloats *keys = packet->keys + k;
        const JoxMask there =
            jm_and(k + 1 < packet->levels ? lanes : all, jf_lt(keys[1], jf_set(INFINITY)));
        tied[k] = jm_and(there, ji_equal(distance_bits(keys[0]), distance_bits(keys[1])));
        if (!jm_bits(tied[k]))
            continue;
        if (k == 0 || last < k)
            ranks[k] = rank_of(packet, lanes, keys[0]);
        ranks[k + 1] = rank_of(packet, lanes, keys[1]);
        last = k + 1;
    }
    for (uint32_t changed = last; changed;) {
        changed = 0;
        for (uint32_t k = 0; k < last; k++)
            if (jm_bits(tied[k]))
                changed |= jm_bits(settle_pair(packet->keys + k, ranks + k, tied[k]));
    }
}

/* Settles the ties of some lanes: in lock step of those of which all keys are there that have these
   distances, which behind the last level are those of short lists alone. Keys at the floor do not
   tell which is nearer. */
static void settle_lanes(Packet *packet, uint32_t lanes) {
    JOX_ASSERT(packet->levels > 1); /* else there are no ties */
    const uint32_t last = packet->levels - 1;
    const JoxMask cut =
        ji_equal(distance_bits(packet->keys[last]), distance_bits(packet->keys[last - 1]));
    const JoxMask floored = ji_equal(distance_bits(packet->keys[1]), ji_set(FLOOR));
    const uint32_t over = lanes & jm_bits(cut) & lists_beyond(packet, packet->levels);
    const uint32_t alone = (over & lists_beyond(packet, ORDERED)) | (lanes & jm_bits(floored));
    if (alone)
        settle_alone(packet, alone);
    if (lanes & ~alone)
        settle_together(packet, jm_of_bits(lanes & ~alone), jm_of_bits(over & ~alone),
                        over & ~alone ? ORDERED : packet->levels);
}

#endif
