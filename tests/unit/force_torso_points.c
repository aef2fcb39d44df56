/* The points at which torsos touch, against the distance of two segments in double, over random
   pairs and hard ones: crossing, parallel, end to end, over periodic edges. Levers are compared
   with the change of the gap as a torso turns. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "agents/torso.h"
#include "base/number/random.h"
#include "force/contact/contacts.h"
#include "nav/nav.h"

enum { ACROSS = 60, PAIRS = ACROSS * ACROSS };
static const double CELL = 4.0;    /* m: each pair has a cell of its own */
static const double REACH = 0.17;  /* m: gap at which fast pairs are found */
static const double ROUNDS = 4e-5; /* m: rounding of coordinates of up to 240 m */

typedef enum Kind { FREE, CROSSING, PARALLEL, END_TO_END, WITH_DISC, KINDS } Kind;

typedef struct V {
    double x, y;
} V;

static V add(V a, V b) {
    return (V){a.x + b.x, a.y + b.y};
}
static V scale(V a, double by) {
    return (V){a.x * by, a.y * by};
}
static V sub(V a, V b) {
    return (V){a.x - b.x, a.y - b.y};
}
static double dot(V a, V b) {
    return a.x * b.x + a.y * b.y;
}
static double det(V a, V b) {
    return a.x * b.y - a.y * b.x;
}

/* A torso about `centre`; the axis points to its left end. */
typedef struct Plain {
    V centre, axis;
    double radius;
} Plain;

static double find_far(V point, const Plain *t) {
    const V from = sub(point, t->centre);
    const double half2 = dot(t->axis, t->axis);
    const double along = half2 > 0.0 ? fmax(-1.0, fmin(1.0, dot(from, t->axis) / half2)) : 0.0;
    return sqrt(fmax(0.0, dot(sub(from, scale(t->axis, along)), sub(from, scale(t->axis, along)))));
}

/* Returns the distance of both axes by ternary search along the first: it is convex there. */
static double find_distance(const Plain *a, const Plain *b) {
    double low = -1.0, high = 1.0;
    for (int k = 0; k < 100; k++) {
        const double one = low + (high - low) / 3.0, other = high - (high - low) / 3.0;
        if (find_far(add(a->centre, scale(a->axis, one)), b) <
            find_far(add(a->centre, scale(a->axis, other)), b))
            high = other;
        else
            low = one;
    }
    return find_far(add(a->centre, scale(a->axis, 0.5 * (low + high))), b);
}

static double find_gap(const Plain *a, const Plain *b) {
    return find_distance(a, b) - a->radius - b->radius;
}

static bool do_axes_cross(const Plain *a, const Plain *b) {
    const V between = sub(b->centre, a->centre);
    const double turn = det(a->axis, b->axis);
    const double own = det(between, b->axis) / turn, other = det(between, a->axis) / turn;
    return turn != 0.0 && fabs(own) < 1.0 && fabs(other) < 1.0;
}

static Plain turn_plain(Plain t, double angle) {
    const double c = cos(angle), s = sin(angle);
    t.axis = (V){c * t.axis.x - s * t.axis.y, s * t.axis.x + c * t.axis.y};
    return t;
}

typedef struct Pairs {
    JoxAgents agents;
    JoxNeighbours neighbours;
    JoxNav *nav;
    JoxForces *forces;
    Kind kinds[PAIRS];
    uint32_t drawn;
} Pairs;

static float draw_torso(Pairs *p, double from, double to) {
    return (float)(from + (to - from) * jox_random_unit(5, 0, 0, JOX_DRAW_FILL, p->drawn++));
}

/* Adds an agent at a point of the period. */
static void add_torso(Pairs *p, double x, double y, double angle, bool disc) {
    JoxAgents *a = &p->agents;
    const uint32_t i = jox_agents_add(a);
    const float breadth = draw_torso(p, 0.2, 1.2);
    jox_param_set(a, JOX_PARAM_breadth, i, breadth);
    jox_param_set(a, JOX_PARAM_depth, i, disc ? breadth : breadth * draw_torso(p, 0.05, 1.1));
    jox_param_set(a, JOX_PARAM_mass, i, draw_torso(p, 40.0, 110.0));
    a->chest_x[i] = (float)cos(angle);
    a->chest_y[i] = (float)sin(angle);
    a->x[i] = (float)x;
    a->y[i] = (float)y;
    a->vx[i] = i % 2 ? 10.0f : 0.0f; /* so that gaps up to the greatest are contacts */
    jox_agents_wrap(a, i);
}

/* Adds a pair near the lower left corner of cell k, so that pairs of the first row and column lie
   across the edges. */
static void add_pair(Pairs *p, uint32_t k) {
    const Kind kind = (Kind)(k % KINDS);
    const double x = CELL * (k % ACROSS), y = CELL * (k / (uint32_t)ACROSS);
    const double angle = draw_torso(p, -3.2, 3.2), far = kind == CROSSING ? 0.2 : 1.0;
    double other = draw_torso(p, -3.2, 3.2);
    double dx = draw_torso(p, -far, far), dy = draw_torso(p, -far, far);
    if (kind == PARALLEL || kind == END_TO_END)
        other = angle + (k % 2 ? 3.14159265358979 : 0.0);
    if (kind == END_TO_END) {
        const double apart = draw_torso(p, 0.1, 1.2);
        dx = -sin(angle) * apart;
        dy = cos(angle) * apart;
    }
    p->kinds[k] = kind;
    add_torso(p, x, y, angle, false);
    add_torso(p, x + dx, y + dy, other, kind == WITH_DISC);
}

static void open_pairs(Pairs *p, JoIsa isa) {
    *p = (Pairs){.nav = jox_nav_create(NULL)};
    p->agents.period = (JoxV2){(float)(CELL * ACROSS), (float)(CELL * ACROSS)};
    p->agents.origin = (JoxV2){-0.01f, 0.0f};
    for (uint32_t k = 0; k < PAIRS; k++)
        add_pair(p, k);
    jox_nav_sort(p->nav, &p->agents, 0);
    jox_nav_perceive(p->nav, &p->agents, &p->neighbours, NULL);
    const JoxStep step = {
        .timing = jox_timing_at_once(0.05), .agents = &p->agents, .neighbours = &p->neighbours};
    p->forces = jox_forces_create(NULL);
    jox_forces_set_isa(p->forces, isa);
    jox_force_begin(p->forces, &step, &(JoxForceInputs){0});
    jox_contacts_find(p->forces);
}

static void close_pairs(Pairs *p) {
    jox_forces_free(p->forces);
    jox_nav_free(p->nav);
    jox_agents_free(&p->agents);
    jox_neighbours_free(&p->neighbours);
}

/* Returns agent i as a plain torso, relative to agent `to`. */
static Plain get_plain(const JoxAgents *a, uint32_t i, uint32_t to) {
    const JoxV2 offset = jox_offset(a, to, i);
    return (Plain){{(double)offset.x, (double)offset.y},
                   {(double)a->axis_x[i], (double)a->axis_y[i]},
                   (double)a->contact_radius[i]};
}

static double get_gyration(const JoxAgents *a, uint32_t i) {
    const double half = hypot((double)a->axis_x[i], (double)a->axis_y[i]);
    const double radius = (double)a->contact_radius[i], side = half + radius;
    return 0.5 * sqrt(side * side + radius * radius);
}

/* Checks what holds of each point: it is as far from both torsos as its gap says, and its mass is
   that of its levers. */
static void check_point(const JoxAgents *a, uint32_t i, uint32_t j, const JoxContactPoint *at) {
    const Plain one = get_plain(a, i, i), other = get_plain(a, j, i);
    const double m[2] = {(double)jox_param(a, JOX_PARAM_mass, i),
                         (double)jox_param(a, JOX_PARAM_mass, j)};
    const double l[2] = {(double)at->levers[0], (double)at->levers[1]};
    const double mass = 1.0 / ((1.0 + l[0] * l[0]) / m[0] + (1.0 + l[1] * l[1]) / m[1]);
    assert_true(jox_is_unit(at->normal));
    assert_true(fabs((double)at->mass - mass) < 1e-4 * mass);
    assert_true((double)at->gap >= find_gap(&one, &other) - ROUNDS);
    assert_true(at->levers[0] * at->levers[0] + at->slips[0] * at->slips[0] < 16.0f);
}

/* Checks levers against the change of the gap as either torso turns. */
static void check_levers(const JoxAgents *a, uint32_t i, uint32_t j, const JoxContactPoint *at) {
    const double step = 1e-6;
    for (int k = 0; k < 2; k++) {
        const uint32_t turned = k ? j : i, rests = k ? i : j;
        const Plain own = get_plain(a, turned, turned), other = get_plain(a, rests, turned);
        if (own.axis.x == 0.0 && own.axis.y == 0.0) {
            assert_true(at->levers[k] == 0.0f && at->slips[k] == 0.0f);
            continue;
        }
        const Plain left = turn_plain(own, step), right = turn_plain(own, -step);
        const double slope = (find_gap(&left, &other) - find_gap(&right, &other)) / (2.0 * step);
        const double lever = (k ? -1.0 : 1.0) * (double)at->levers[k] * get_gyration(a, turned);
        const double half = hypot(own.axis.x, own.axis.y);
        if (fabs(slope - lever) > 1e-3 + 1e-3 * half)
            fail_msg("agents %u and %u: gap changes by %.6f m/rad, lever %.6f", i, j, slope, lever);
    }
}

typedef struct Seen {
    uint32_t one, two, crossing, none, over_edge;
} Seen;

/* Compares the points found of a pair that does not cross. */
static void check_apart(const JoxAgents *a, uint32_t i, uint32_t j, Kind kind,
                        const JoxFoundPair *found, uint32_t count, Seen *seen) {
    const Plain one = get_plain(a, i, i), other = get_plain(a, j, i);
    const double gap = find_gap(&one, &other);
    const uint32_t nearest = count == 2 && found[0].again ? 1 : 0;
    const JoxContactPoint *at = &found[nearest].at;
    if (fabs((double)at->gap - gap) > ROUNDS)
        fail_msg("pair %u, kind %d: gap %.6f, not %.6f", i / 2, (int)kind, (double)at->gap, gap);
    if (count == 1 && find_distance(&one, &other) > 1e-3 && fabs(det(one.axis, other.axis)) > 1e-3)
        check_levers(a, i, j, at);
    assert_false(kind == END_TO_END && find_distance(&one, &other) > 1e-3 && count == 2);
    seen->one += count == 1;
    seen->two += count == 2;
    if (count < 2)
        return;
    assert_true(found[1 - nearest].again && !found[nearest].again);
    assert_true(found[1 - nearest].at.gap >= at->gap - 1e-6f && found[1 - nearest].at.gap < 0.051f);
    assert_true(jox_dot(found[0].at.normal, found[1].at.normal) > 0.69f);
}

/* Axes that cross part along the line of the centres. */
static void check_crossing(const JoxAgents *a, uint32_t i, uint32_t j, const JoxFoundPair *found,
                           uint32_t count, Seen *seen) {
    const JoxV2 offset = jox_offset(a, j, i);
    assert_int_equal(count, 1);
    assert_true(jox_dot(offset, found->at.normal) > 0.9999f * jox_length(offset));
    assert_true(found->at.gap <= 1e-3f - a->contact_radius[i] - a->contact_radius[j]);
    seen->crossing++;
}

static void compare_pair(const Pairs *p, uint32_t k, const uint32_t *index, Seen *seen) {
    const JoxFoundContacts *lists = &p->forces->contacts->found;
    const JoxAgents *a = &p->agents;
    const uint32_t i = index[2 * k], j = index[2 * k + 1], count = lists->pair_count[i];
    const JoxFoundPair *found = (const JoxFoundPair *)lists->pairs.items + lists->first_pair[i];
    const Plain one = get_plain(a, i, i), other = get_plain(a, j, i);
    const double gap = find_gap(&one, &other);
    assert_int_equal(lists->pair_count[j], 0);
    seen->none += !count;
    if (fabs(gap - REACH) > ROUNDS && (count > 0) != (gap < REACH))
        fail_msg("pair %u, kind %d: a gap of %.4f m, %u points", k, (int)p->kinds[k], gap, count);
    for (uint32_t n = 0; n < count; n++) {
        assert_int_equal(found[n].other, j);
        check_point(a, i, j, &found[n].at);
    }
    seen->over_edge += count && fabsf(a->x[i] - a->x[j]) > 10.0f;
    if (count && do_axes_cross(&one, &other))
        check_crossing(a, i, j, found, count, seen);
    else if (count)
        check_apart(a, i, j, p->kinds[k], found, count, seen);
}

static void points_are_those_of_the_nearest_surfaces(void **state) {
    (void)state;
    static Pairs p;
    static uint32_t index[2 * PAIRS];
    for (JoIsa isa = JO_ISA_SCALAR; isa <= JO_ISA_NEON; isa++) {
        Seen seen = {0};
        if (!jox_isa_runs(isa))
            continue;
        open_pairs(&p, isa);
        assert_int_equal(p.agents.count, 2 * PAIRS);
        for (uint32_t i = 0; i < p.agents.count; i++)
            index[p.agents.id[i]] = i;
        for (uint32_t k = 0; k < PAIRS; k++)
            compare_pair(&p, k, index, &seen);
        close_pairs(&p);
        assert_true(seen.one > 500 && seen.two > 500 && seen.crossing > 100 && seen.none > 500);
        assert_true(seen.over_edge > 5);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(points_are_those_of_the_nearest_surfaces)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
