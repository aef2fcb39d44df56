/* The kernel of the contact solve: a lane is a contact between two agents. All contacts that a call
   is given belong to one colour, so that no agent is in two lanes. solve.c calls it. */
#include "force/contact/contacts.h"
#include "simd/vectors.h"

/* The rows of four numbers of which a JoxPair consists, and what is in them. */
enum { IMPULSES, NORMALS, MASSES, SLIPS, ROWS };
_Static_assert(sizeof(JoxPair) == 4 * ROWS * sizeof(float), "a pair is so many rows");
_Static_assert(offsetof(JoxPair, at.normal) == 4 * NORMALS * sizeof(float), "normal, levers");
_Static_assert(offsetof(JoxPair, at.target) == 4 * MASSES * sizeof(float), "target, masses, gap");
_Static_assert(offsetof(JoxPair, at.slips) == 4 * SLIPS * sizeof(float), "slips");

/* Contacts of a packet, with the motions of both agents of each. */
typedef struct Packet {
    float *pairs[JOX_WIDTH];
    float *ends[2][JOX_WIDTH];
    JoxFloats impulses[4], motions[2][4]; /* x, y, spin, inverse mass */
} Packet;

/* Loads `count` contacts. Lanes beyond these solve an empty one. */
static inline void load_packet(Packet *p, JoxPair *pairs, uint32_t count, JoxContactMotion *motions,
                               JoxPair *empty, JoxContactMotion *rest) {
    JOX_UNROLL
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++) {
        JoxPair *pair = lane < count ? &pairs[lane] : empty;
        p->pairs[lane] = (float *)pair;
        p->ends[0][lane] = lane < count ? &motions[pair->first].x : &rest->x;
        p->ends[1][lane] = lane < count ? &motions[pair->second].x : &rest->x;
    }
    jf_rows((const float *const *)p->pairs, p->impulses);
    for (int end = 0; end < 2; end++)
        jf_rows((const float *const *)p->ends[end], p->motions[end]);
}

/* Loads a row of all contacts of a packet. */
static inline void load_row(const Packet *p, int row, JoxFloats out[4]) {
    const float *rows[JOX_WIDTH];
    JOX_UNROLL
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        rows[lane] = p->pairs[lane] + 4 * row;
    jf_rows(rows, out);
}

/* As jox_speed_along. */
static inline JoxFloats find_speed(const JoxFloats m[4], JoxVector direction, JoxFloats lever) {
    return m[0] * direction.x + m[1] * direction.y + m[2] * lever;
}

/* As jox_add_impulse. */
static inline void add_impulse(JoxFloats m[4], JoxVector direction, JoxFloats lever,
                               JoxFloats impulse) {
    const JoxFloats change = impulse * m[3];
    m[0] = m[0] + direction.x * change;
    m[1] = m[1] + direction.y * change;
    m[2] = m[2] + lever * change;
}

/* Makes friction stop the tangential motion as far as the impulses allow; returns by how much slips
   changed. */
static inline JoxFloats solve_slips(Packet *p, JoxVector normal, JoxFloats slip_mass,
                                    float friction) {
    JoxFloats slips[4];
    load_row(p, SLIPS, slips);
    const JoxVector tangent = {-normal.y, normal.x};
    const JoxFloats speed =
        find_speed(p->motions[0], tangent, slips[0]) - find_speed(p->motions[1], tangent, slips[1]);
    const JoxFloats bound = friction * p->impulses[2], before = p->impulses[3];
    const JoxFloats wanted = before - speed * slip_mass;
    const JoxFloats most = jf_select(jf_lt(bound, wanted), bound, wanted);
    const JoxFloats after = jf_select(jf_lt(wanted, -bound), -bound, most);
    const JoxFloats change = after - before;
    p->impulses[3] = after;
    add_impulse(p->motions[0], tangent, slips[0], change);
    add_impulse(p->motions[1], tangent, slips[1], -change);
    return jf_abs(change);
}

/* Solves the contacts of a packet once: each impulse becomes what its target asks for at the
   present velocities, but never pulls. Returns by how much impulses changed. */
static inline JoxFloats solve_packet(Packet *p, float friction, float relaxation) {
    const JoxFloats zero = jf_set(0.0f);
    JoxFloats normals[4], masses[4];
    load_row(p, NORMALS, normals);
    load_row(p, MASSES, masses);
    const JoxVector normal = {normals[0], normals[1]};
    const JoxFloats speed = find_speed(p->motions[0], normal, normals[2]) -
                            find_speed(p->motions[1], normal, normals[3]);
    const JoxFloats before = p->impulses[2];
    const JoxFloats after = jf_max(zero, before + relaxation * (masses[0] - speed) * masses[1]);
    const JoxFloats change = after - before;
    p->impulses[2] = after;
    add_impulse(p->motions[0], normal, normals[2], change);
    add_impulse(p->motions[1], normal, normals[3], -change);
    if (!(friction > 0.0f && jm_bits(jf_lt(zero, masses[2]))))
        return jf_abs(change);
    return jf_max(jf_abs(change), solve_slips(p, normal, masses[2], friction));
}

float JOX_WIDE(jox_solve_pairs)(JoxPair *pairs, uint32_t count, JoxContactMotion *motions,
                                float friction, float relaxation) {
    JoxPair empty = {0};
    JoxContactMotion rest = {0};
    JoxFloats most = jf_set(0.0f);
    for (uint32_t k = 0; k < count; k += JOX_WIDTH) {
        Packet p;
        if (count - k < JOX_WIDTH)
            load_packet(&p, pairs + k, count - k, motions, &empty, &rest);
        else
            load_packet(&p, pairs + k, JOX_WIDTH, motions, &empty, &rest);
        most = jf_max(most, solve_packet(&p, friction, relaxation));
        jf_put_rows(p.pairs, p.impulses);
        for (int end = 0; end < 2; end++)
            jf_put_rows(p.ends[end], p.motions[end]);
    }
    float lanes[JOX_WIDTH], greatest = 0.0f;
    jf_store(lanes, most);
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        greatest = jox_maxf(greatest, lanes[lane]);
    return greatest;
}
