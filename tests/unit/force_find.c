/* The kernel that finds contacts against the plain path of one agent (contact_near.c), by every
   instruction set that the machine runs: over random crowds and hard ones, packed into heaps,
   coincident, on a lattice of touching discs, far apart, among walls, with periodic edges. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/number/random.h"
#include "force/kernels.h"
#include "nav/nav.h"

enum { CROWDS = 42, MOST_PEOPLE = 400 };

typedef enum Kind { RANDOM, PACKED, COINCIDENT, LATTICE, FAR, WALLED, KINDS } Kind;

typedef struct Crowd {
    uint32_t number, drawn;
    Kind kind;
    JoxAgents agents;
    JoxNeighbours neighbours;
    JoxWalls walls;
    JoxNav *nav;
    JoxForces *forces;
} Crowd;

/* What the crowds were good for. */
typedef struct Seen {
    uint32_t pairs, walls, alone, cut, overlaps;
} Seen;

static float draw(Crowd *c, double from, double to) {
    double unit = jox_random_unit(11, c->number, 0, JOX_DRAW_FILL, c->drawn++);
    return (float)(from + (to - from) * unit);
}

static void add(Crowd *c, uint32_t k) {
    JoxAgents *a = &c->agents;
    const float size = c->kind == PACKED ? 0.9f : c->kind == FAR ? 300.0f : 6.0f;
    uint32_t i = jox_agents_add(a);
    a->x[i] = draw(c, 0.0, size);
    a->y[i] = draw(c, 0.0, size);
    jox_param_set(a, JOX_PARAM_radius, i, draw(c, 0.15, 0.3));
    if (c->kind == LATTICE) { /* neighbours touch in a point */
        a->x[i] = 0.5f * (float)(k % 19);
        a->y[i] = 0.5f * (float)(k / 19);
        jox_param_set(a, JOX_PARAM_radius, i, 0.25f);
    }
    if (c->kind == COINCIDENT) {
        a->x[i] = 0.5f * (float)(k % 9);
        a->y[i] = 0.25f * (float)(k % 5);
    }
    a->vx[i] = draw(c, -1.5, 1.5);
    a->vy[i] = draw(c, -1.5, 1.5);
    a->pref_x[i] = draw(c, -1.0, 1.0);
    jox_param_set(a, JOX_PARAM_mass, i, draw(c, 40.0, 110.0));
    jox_param_set(a, JOX_PARAM_restitution, i, draw(c, -0.5, 0.5));
    if (c->number / KINDS % 2) {
        jox_param_set(a, JOX_PARAM_neighbours, i, floorf(draw(c, 0.0, 16.999)));
        jox_param_set(a, JOX_PARAM_perception, i, draw(c, 0.2, 4.0));
    }
}

static void begin(Crowd *c, JoIsa isa, uint32_t number) {
    *c = (Crowd){.number = number, .kind = (Kind)(number % KINDS)};
    const uint32_t people = 1 + (uint32_t)draw(c, 0.0, MOST_PEOPLE - 1);
    c->nav = jox_nav_create(NULL);
    if (number % 7 == 3)
        c->agents.period = (JoxV2){6.0f, number % 2 ? 6.0f : 0.0f};
    for (uint32_t k = 0; k < people; k++)
        add(c, k);
    for (uint32_t k = 0; k < (c->kind == WALLED ? 25 : 0); k++) {
        JoxV2 from = {draw(c, 0.0, 6.0), draw(c, 0.0, 6.0)};
        JoxV2 ends[2] = {from, {from.x + draw(c, -2.0, 2.0), from.y + draw(c, 0.1, 2.0)}};
        jox_walls_add_polyline(&c->walls, ends, 2, false, INFINITY);
    }
    if (c->walls.count)
        jox_nav_set_walls(c->nav, &c->walls);
    jox_nav_sort(c->nav, &c->agents, 0);
    jox_nav_perceive(c->nav, &c->agents, &c->neighbours, NULL);
    JoxForceStep step = {.agents = &c->agents,
                         .neighbours = &c->neighbours,
                         .walls = jox_nav_touching_walls(c->nav, &c->neighbours, &c->agents, 0.6f),
                         .seed = 3,
                         .turning = number % 3 != 0,
                         .dt = number % 2 ? 0.05 : 0.01,
                         .time = 7.3};
    c->forces = jox_forces_create(NULL);
    jox_forces_set_isa(c->forces, isa);
    jox_force_begin(c->forces, &step);
    jox_contacts_find(c->forces);
}

static void end(Crowd *c) {
    jox_forces_free(c->forces);
    jox_nav_free(c->nav);
    jox_agents_free(&c->agents);
    jox_neighbours_free(&c->neighbours);
    jox_walls_free(&c->walls);
}

static bool same_pair(const JoxFoundPair *a, const JoxFoundPair *b) {
    return a->other == b->other && a->other_id == b->other_id && a->normal.x == b->normal.x &&
           a->normal.y == b->normal.y && a->squeeze == b->squeeze && a->target == b->target &&
           a->mass == b->mass;
}

static void compare_agent(Crowd *c, uint32_t i, Seen *seen) {
    JoxForces *f = c->forces;
    const JoxAgents *a = &c->agents;
    JoxFoundPair pairs[JOX_MOST_NEIGHBOURS];
    JoxFoundWall walls[JOX_CONTACT_MOST_WALLS];
    uint32_t edges = 0, count = 0;
    if (f->step.walls)
        jox_wall_grid_at(f->step.walls, jox_v2(a->x[i], a->y[i]), &edges);
    const JoxFoundPair *found = (const JoxFoundPair *)f->found.items + f->found_first[i];
    assert_int_equal(f->found_number[i], jox_contacts_of(f, i, edges > 0, pairs));
    for (uint32_t k = 0; k < f->found_number[i]; k++)
        assert_true(same_pair(&found[k], &pairs[k]));
    const JoxFoundWall *wall = (const JoxFoundWall *)f->found_walls.items + f->wall_first[i];
    if (edges)
        count = jox_contacts_walls_of(f, i, walls);
    assert_int_equal(f->wall_number[i], count);
    for (uint32_t k = 0; k < count; k++)
        assert_true(wall[k].edge == walls[k].edge && wall[k].gap == walls[k].gap);
    seen->pairs += f->found_number[i];
    seen->walls += count;
    seen->alone += c->neighbours.touch_count[i] != JOX_TOUCH_IS_SEEN;
}

static void compare_crowd(JoIsa isa, uint32_t number, Seen *seen) {
    Crowd c;
    begin(&c, isa, number);
    const uint32_t overlaps = c.forces->totals.pairs;
    for (uint32_t k = 0; k < c.forces->chunks; k++)
        c.forces->chunk[k].overlaps = 0;
    for (uint32_t i = 0; i < c.agents.count; i++)
        compare_agent(&c, i, seen);
    uint32_t again = 0;
    for (uint32_t k = 0; k < c.forces->chunks; k++)
        again += c.forces->chunk[k].overlaps;
    assert_int_equal(overlaps, again);
    seen->overlaps += overlaps;
    seen->cut += c.forces->cut;
    end(&c);
}

static void test_contacts(void **state) {
    (void)state;
    for (JoIsa isa = JO_ISA_SCALAR; isa <= JO_ISA_NEON; isa++) {
        Seen seen = {0};
        for (uint32_t number = 0; jox_isa_runs(isa) && number < CROWDS; number++)
            compare_crowd(isa, number, &seen);
        if (!jox_isa_runs(isa))
            continue;
        assert_true(seen.pairs > 1000 && seen.overlaps > 1000 && seen.walls > 20);
        assert_true(seen.alone > 100 && seen.cut > 1 && seen.cut < CROWDS / 2);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_contacts)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
