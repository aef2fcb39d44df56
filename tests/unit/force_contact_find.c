/* The kernel that finds contacts against plain C for one agent, on every instruction set that the
   machine runs: over random crowds and hard ones, packed into heaps, coincident, on a lattice of
   touching discs, far apart, among walls, with periodic edges. Torsos are compared with
   jox_find_contacts_alone; force_torso_points.c has their geometry in plain C. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "agents/torso.h"
#include "base/assert.h"
#include "base/number/random.h"
#include "force/contact/contacts.h"
#include "nav/nav.h"

enum { CROWDS = 63, MOST_PEOPLE = 400 };

typedef enum Kind {
    RANDOM,
    PACKED,
    COINCIDENT,
    LATTICE,
    FAR,
    WALLED,
    TORSOS,
    PACKED_TORSOS,
    WALLED_TORSOS,
    KINDS
} Kind;

typedef struct Crowd {
    uint32_t number, drawn;
    Kind kind;
    JoxAgents agents;
    JoxNeighbours neighbours;
    JoxWalls walls;
    JoxNav *nav;
    JoxForces *forces;
} Crowd;

/* Numbers of cases that the crowds covered. */
typedef struct Seen {
    uint32_t pairs, walls, alone, cut, overlaps, second;
} Seen;

static float draw_find(Crowd *c, double from, double to) {
    double unit = jox_random_unit(11, c->number, 0, JOX_DRAW_FILL, c->drawn++);
    return (float)(from + (to - from) * unit);
}

static bool has_torsos(const Crowd *c) {
    return c->kind >= TORSOS;
}

/* Gives agent i a torso, or the disc of its radius: to all in crowds of discs, else to one in four.
 */
static void shape_find_agent(Crowd *c, uint32_t i) {
    JoxAgents *a = &c->agents;
    const float whole = 2.0f * jox_param(a, JOX_PARAM_radius, i);
    const bool disc = !has_torsos(c) || draw_find(c, 0.0, 1.0) < 0.25f;
    jox_param_set(a, JOX_PARAM_breadth, i, disc ? whole : whole * draw_find(c, 0.8, 1.6));
    jox_param_set(a, JOX_PARAM_depth, i, disc ? whole : whole * draw_find(c, 0.3, 1.0));
    if (!has_torsos(c))
        return;
    const float angle = draw_find(c, -3.2, 3.2);
    a->chest_x[i] = cosf(angle);
    a->chest_y[i] = sinf(angle);
}

static void add_find_agent(Crowd *c, uint32_t k) {
    JoxAgents *a = &c->agents;
    const bool packed = c->kind == PACKED || c->kind == PACKED_TORSOS;
    const float size = packed ? 0.9f : c->kind == FAR ? 300.0f : 6.0f;
    uint32_t i = jox_agents_add(a);
    a->x[i] = draw_find(c, 0.0, size);
    a->y[i] = draw_find(c, 0.0, size);
    jox_param_set(a, JOX_PARAM_radius, i, draw_find(c, 0.15, 0.3));
    if (c->kind == LATTICE) { /* neighbours touch in one point */
        a->x[i] = 0.5f * (float)(k % 19);
        a->y[i] = 0.5f * (float)(k / 19);
        jox_param_set(a, JOX_PARAM_radius, i, 0.25f);
    }
    if (c->kind == COINCIDENT) {
        a->x[i] = 0.5f * (float)(k % 9);
        a->y[i] = 0.25f * (float)(k % 5);
    }
    shape_find_agent(c, i);
    a->vx[i] = draw_find(c, -1.5, 1.5);
    a->vy[i] = draw_find(c, -1.5, 1.5);
    a->pref_x[i] = draw_find(c, -1.0, 1.0);
    jox_param_set(a, JOX_PARAM_mass, i, draw_find(c, 40.0, 110.0));
    jox_param_set(a, JOX_PARAM_restitution, i, draw_find(c, -0.5, 0.5));
    if (c->number / KINDS % 2) {
        jox_param_set(a, JOX_PARAM_neighbours, i, floorf(draw_find(c, 0.0, 16.999)));
        jox_param_set(a, JOX_PARAM_perception, i, draw_find(c, 0.2, 4.0));
    }
}

static void open_find_crowd(Crowd *c, JoIsa isa, uint32_t number) {
    *c = (Crowd){.number = number, .kind = (Kind)(number % KINDS)};
    const uint32_t people = 1 + (uint32_t)draw_find(c, 0.0, MOST_PEOPLE - 1);
    c->nav = jox_nav_create(NULL);
    if (number % 7 == 3)
        c->agents.period = (JoxV2){6.0f, number % 2 ? 6.0f : 0.0f};
    for (uint32_t k = 0; k < people; k++)
        add_find_agent(c, k);
    for (uint32_t k = 0; k < (c->kind == WALLED || c->kind == WALLED_TORSOS ? 25 : 0); k++) {
        JoxV2 from = {draw_find(c, 0.0, 6.0), draw_find(c, 0.0, 6.0)};
        JoxV2 ends[2] = {from, {from.x + draw_find(c, -2.0, 2.0), from.y + draw_find(c, 0.1, 2.0)}};
        jox_walls_add_polyline(&c->walls, ends, 2, false, INFINITY);
    }
    if (c->walls.count)
        jox_nav_set_walls(c->nav, &c->walls);
    jox_nav_sort(c->nav, &c->agents, 0);
    jox_nav_perceive(c->nav, &c->agents, &c->neighbours, NULL);
    JoxStep step = {.timing = jox_timing_at_once(number % 2 ? 0.05 : 0.01),
                    .agents = &c->agents,
                    .neighbours = &c->neighbours};
    step.timing.seed = 3;
    step.timing.time = 7.3;
    const JoxForceInputs inputs = {
        .walls = jox_nav_touching_walls(c->nav, &step, 0.8f),
        .unhidden2 = number % 4 ? jox_nav_unhidden2(c->nav) : NULL,
    };
    c->forces = jox_forces_create(NULL);
    jox_forces_set_isa(c->forces, isa);
    jox_force_begin(c->forces, &step, &inputs);
    jox_contacts_find(c->forces);
}

static void close_find_crowd(Crowd *c) {
    jox_forces_free(c->forces);
    jox_nav_free(c->nav);
    jox_agents_free(&c->agents);
    jox_neighbours_free(&c->neighbours);
    jox_walls_free(&c->walls);
}

/* ---- contacts of one agent in plain C ---- */

/* Returns the contact of agents i and j over a gap (m); a normal of (0, 0): both at the same
   point. */
static JoxFoundPair make_plain_pair(const JoxForces *f, uint32_t i, uint32_t j, JoxV2 normal,
                                    float gap) {
    const JoxAgents *a = f->step.agents;
    const JoxParameterColumn mass = a->param[JOX_PARAM_mass];
    const JoxParameterColumn e = a->param[JOX_PARAM_restitution];
    if (normal.x == 0.0f && normal.y == 0.0f)
        normal.x = 1.0f; /* agents at the same point part along x */
    float speed = (a->vx[i] - a->vx[j]) * normal.x + (a->vy[i] - a->vy[j]) * normal.y;
    JOX_ASSERT(jox_is_unit(normal));
    return (JoxFoundPair){
        .other = j,
        .other_id = a->id[j],
        .at = {.normal = normal,
               .gap = gap,
               .target = jox_contact_target(gap, speed, jox_minf(jox_at(e, i), jox_at(e, j)),
                                            (float)f->step.timing.dt),
               .mass = 1.0f / (1.0f / jox_at(mass, i) + 1.0f / jox_at(mass, j))}};
}

static bool is_in_plain_list(const JoxNeighbours *near, uint32_t i, uint32_t other) {
    const uint32_t *index = near->touch_index + (size_t)i * JOX_MOST_NEIGHBOURS;
    for (uint32_t k = 0; k < near->touch_count[i]; k++)
        if (index[k] == other)
            return true;
    return false;
}

/* Returns whether an agent's list of agents within touch range is full, so that it may lack
   some. */
static bool is_plain_list_full(const JoxNeighbours *near, uint32_t i) {
    return near->touch_count && near->touch_count[i] == JOX_MOST_NEIGHBOURS;
}

/* Finds the contact of two agents; false if the gap between them cannot close within the step. */
static bool find_plain_touch(JoxForces *f, uint32_t i, uint32_t other, bool walls,
                             JoxFoundPair *out) {
    const JoxAgents *a = f->step.agents;
    JoxV2 offset = jox_offset(a, other, i);
    float distance2 = jox_length2(offset);
    float sum = a->contact_radius[i] + a->contact_radius[other];
    float most = sum + JOX_TOUCH_LEAST + JOX_TOUCH_MOST;
    if (!(distance2 < most * most))
        return false;
    float gap = sqrtf(distance2) - sum;
    if (gap > JOX_TOUCH_LEAST) {
        JoxV2 towards = {a->vx[other] - a->vx[i], a->vy[other] - a->vy[i]};
        float closing = jox_length(towards) * (float)f->step.timing.dt;
        if (gap > JOX_TOUCH_LEAST + jox_minf(JOX_TOUCH_MOST, closing))
            return false;
    }
    JoxV2 at = {a->x[i], a->y[i]};
    if (walls && jox_wall_grid_has_wall_between(f->in.walls, at, jox_sub(at, offset)))
        return false;
    f->contacts->found.overlaps[i / JOX_FORCE_GRAIN] += gap < 0.0f;
    *out = make_plain_pair(f, i, other, jox_unit(offset), gap);
    return true;
}

static uint32_t plain_contacts(JoxForces *f, uint32_t i, bool walls, JoxFoundPair *out) {
    const JoxAgents *a = f->step.agents;
    const JoxNeighbours *near = f->step.neighbours;
    bool seen = !near->touch_count || near->touch_count[i] == JOX_TOUCH_AMONG_NEIGHBOURS;
    uint32_t count = seen ? jox_touch_candidate_counts(near, f->widest)[i] : near->touch_count[i],
             found = 0;
    for (uint32_t k = 0; k < count; k++) {
        uint32_t other = seen ? near->index[jox_neighbour_at(near, i, k)]
                              : near->touch_index[(size_t)i * JOX_MOST_NEIGHBOURS + k];
        if (a->id[other] < a->id[i] &&
            (!is_plain_list_full(near, other) || is_in_plain_list(near, other, i)))
            continue;
        JoxFoundPair pair;
        if (find_plain_touch(f, i, other, walls, &pair))
            jox_insert_pair(out, found++, &pair);
    }
    JOX_ASSERT(found <= JOX_CONTACT_MOST_FOUND);
    return found;
}

static bool same_pair(const JoxFoundPair *a, const JoxFoundPair *b) {
    const JoxContactPoint *p = &a->at, *q = &b->at;
    return a->other == b->other && a->other_id == b->other_id && p->normal.x == q->normal.x &&
           p->normal.y == q->normal.y && p->gap == q->gap && p->target == q->target &&
           p->mass == q->mass && p->slip_mass == q->slip_mass && p->levers[0] == q->levers[0] &&
           p->levers[1] == q->levers[1] && p->slips[0] == q->slips[0] &&
           p->slips[1] == q->slips[1] && a->again == b->again;
}

static void compare_agent(Crowd *c, uint32_t i, Seen *seen) {
    JoxForces *f = c->forces;
    const JoxAgents *a = &c->agents;
    JoxFoundPair pairs[JOX_CONTACT_MOST_FOUND];
    JoxFoundWall walls[JOX_CONTACT_MOST_WALLS];
    const JoxAgentRecord *record = &f->records[i];
    uint32_t edges = 0, count = 0;
    assert_true(record->radius == a->contact_radius[i] && record->id == a->id[i] &&
                record->outer == a->contact_radius[i] + jox_torso_half(a, i) &&
                record->mass == jox_param(a, JOX_PARAM_mass, i));
    if (f->in.walls)
        jox_wall_grid_at(f->in.walls, jox_v2(a->x[i], a->y[i]), &edges);
    const JoxFoundPair *found =
        (const JoxFoundPair *)f->contacts->found.pairs.items + f->contacts->found.first_pair[i];
    const uint32_t plain = has_torsos(c) ? jox_find_contacts_alone(f, i, edges > 0, pairs)
                                         : plain_contacts(f, i, edges > 0, pairs);
    assert_int_equal(f->contacts->found.pair_count[i], plain);
    for (uint32_t k = 0; k < plain; k++) {
        assert_true(same_pair(&found[k], &pairs[k]));
        seen->second += pairs[k].again;
    }
    const JoxFoundWall *wall =
        (const JoxFoundWall *)f->contacts->found.walls.items + f->contacts->found.first_wall[i];
    if (edges)
        count = jox_find_wall_contacts(f, i, walls);
    assert_int_equal(f->contacts->found.wall_count[i], count);
    for (uint32_t k = 0; k < count; k++)
        assert_true(wall[k].edge == walls[k].edge && wall[k].gap == walls[k].gap);
    seen->pairs += f->contacts->found.pair_count[i];
    seen->walls += count;
    seen->alone += c->neighbours.touch_count[i] != JOX_TOUCH_AMONG_NEIGHBOURS;
}

static void compare_find_crowd(JoIsa isa, uint32_t number, Seen *seen) {
    Crowd c;
    open_find_crowd(&c, isa, number);
    const uint32_t overlaps = c.forces->totals.pairs;
    for (uint32_t k = 0; k < c.forces->chunks; k++)
        c.forces->contacts->found.overlaps[k] = 0;
    for (uint32_t i = 0; i < c.agents.count; i++)
        compare_agent(&c, i, seen);
    uint32_t again = 0;
    for (uint32_t k = 0; k < c.forces->chunks; k++)
        again += c.forces->contacts->found.overlaps[k];
    assert_int_equal(overlaps, again);
    seen->overlaps += overlaps;
    seen->cut += c.forces->contacts->found.has_full_list;
    close_find_crowd(&c);
}

static void test_contacts(void **state) {
    (void)state;
    for (JoIsa isa = JO_ISA_SCALAR; isa <= JO_ISA_NEON; isa++) {
        Seen seen = {0};
        for (uint32_t number = 0; jox_isa_runs(isa) && number < CROWDS; number++)
            compare_find_crowd(isa, number, &seen);
        if (!jox_isa_runs(isa))
            continue;
        assert_true(seen.pairs > 1000 && seen.overlaps > 1000 && seen.walls > 20);
        assert_true(seen.second > 1000);
        assert_true(seen.alone > 100 && seen.cut > 1 && seen.cut < 2 * CROWDS / 3);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_contacts)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
