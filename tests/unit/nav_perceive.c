/* The kernel of perceive against a plain reference, which tests all agents, on every instruction
   set that the machine runs. Random crowds, and hard ones: coincident, on a lattice where distances
   tie, packed closer than lists have room for, far apart, across periodic edges, at one edge, of
   mixed parameters, and moved since the sort. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "agents/torso.h"
#include "base/mem.h"
#include "base/number/random.h"
#include "nav/near/perceive.h"

enum { CROWDS = 35, MOST_PEOPLE = 700 };

static double draw_near(uint32_t crowd, uint32_t *drawn, double from, double to) {
    return from + (to - from) * jox_random_unit(4, crowd, 0, JOX_DRAW_FILL, (*drawn)++);
}

typedef enum Kind { RANDOM, LATTICE, COINCIDENT, PACKED, FAR, LINE, EDGE, KINDS } Kind;

static JoxV2 place_near_crowd(Kind kind, uint32_t i, uint32_t crowd, uint32_t *drawn) {
    float size = kind == PACKED ? 2.0f : kind == FAR ? 4000.0f : 14.0f;
    switch (kind) {
    case LATTICE:
        return (JoxV2){0.5f * (float)(i % 23), 0.5f * (float)(i / 23)};
    case COINCIDENT:
        return (JoxV2){0.25f * (float)(i % 9), 0.0f};
    case LINE:
        return (JoxV2){(float)draw_near(crowd, drawn, 0.0, 300.0), 1.0f};
    case EDGE: /* one column of cells holds all agents, so that all searches share it */
        return (JoxV2){(float)draw_near(crowd, drawn, 14.8, 14.99),
                       (float)draw_near(crowd, drawn, 0.0, 3.0)};
    default:
        return (JoxV2){(float)draw_near(crowd, drawn, 0.0, (double)size),
                       (float)draw_near(crowd, drawn, 0.0, (double)size)};
    }
}

/* Returns the period of a crowd, m; 0 for none. With 5 m, a search that sees an edge reaches cells
   at the opposite edge. */
static float choose_period(uint32_t crowd) {
    const uint32_t round = crowd / KINDS;
    return round % 3 != 1 ? 0.0f : round == 1 ? 15.0f : 5.0f;
}

/* A building of two storeys with two stairs beside each other, whose foot and head are 6 m apart.
 */
static JoxStorey storeys[] = {{"ground", 0.0f}, {"first", 3.5f}};
static JoxV2 paths[2][2] = {{{12, 5}, {18, 5}}, {{18, 8}, {12, 8}}};
static JoxStair stairs[] = {
    {.name = "one", .upper = 1, .path = paths[0], .path_count = 2, .width = 2.0f},
    {.name = "two", .upper = 1, .path = paths[1], .path_count = 2, .width = 1.2f}};
static JoxStoreys building = {
    .storeys = storeys, .storey_count = 2, .stairs = stairs, .stair_count = 2};

static void free_building(void) {
    jox_free(building.sheets);
    jox_free(building.sheet_stairs);
    jox_free(building.seams);
    jox_free(building.flights);
    for (int k = 0; k < 2; k++)
        jox_free(stairs[k].outline);
}

/* Fills the floor around the stairs, and the stairs. */
static void fill_building(JoxAgents *a, uint32_t crowd) {
    uint32_t drawn = 0;
    a->storeys = &building;
    a->pitch = building.pitch;
    for (uint32_t k = 0; k < MOST_PEOPLE; k++) {
        const JoxV2 plan = {(float)draw_near(crowd, &drawn, 8.0, 22.0),
                            (float)draw_near(crowd, &drawn, 2.0, 11.0)};
        const uint32_t sheet = (uint32_t)draw_near(crowd, &drawn, 0.0, building.sheet_count);
        if (!jox_is_floor_of(&building, sheet, plan))
            continue;
        const uint32_t i = jox_agents_add(a);
        a->x[i] = plan.x;
        a->y[i] = jox_on_sheet(&building, sheet, plan).y;
        jox_param_set(a, JOX_PARAM_radius, i, (float)draw_near(crowd, &drawn, 0.1, 0.3));
        if (crowd % 2)
            jox_param_set(a, JOX_PARAM_neighbours, i,
                          floorf((float)draw_near(crowd, &drawn, 0.0, 16.999)));
        if (crowd % 2)
            jox_param_set(a, JOX_PARAM_perception, i, (float)draw_near(crowd, &drawn, 0.0, 5.0));
    }
}

/* Moves agents that are beyond a seam to its other side, as strays. */
static void send_over_seams(JoxNav *nav, JoxAgents *a) {
    for (uint32_t i = 0; i < a->count && nav->stray_count < JOX_MOST_STRAYS; i++) {
        const JoxV2 at = {a->x[i], a->y[i]};
        const JoxSeam *seam = jox_find_crossed_seam(&building, at);
        if (!seam || jox_det(seam->along, jox_sub(jox_in_plan(&building, at), seam->a)) > 0.4f)
            continue; /* not from the floor before it */
        a->y[i] += seam->shift;
        jox_nav_list_stray(nav, i);
    }
}

static void fill_crowd(JoxAgents *a, uint32_t crowd) {
    if (crowd >= CROWDS) {
        fill_building(a, crowd);
        return;
    }
    uint32_t drawn = 0;
    const Kind kind = (Kind)(crowd % KINDS);
    const uint32_t people = 1 + (uint32_t)draw_near(crowd, &drawn, 0.0, MOST_PEOPLE - 1);
    const bool mixed = crowd / KINDS % 2;
    const float period = choose_period(crowd);
    a->period = (JoxV2){period, crowd % 2 ? period : 0.0f};
    for (uint32_t k = 0; k < people; k++) {
        uint32_t i = jox_agents_add(a);
        JoxV2 at = place_near_crowd(kind, k, crowd, &drawn);
        a->x[i] = period > 0.0f ? fmodf(at.x, period) : at.x;
        a->y[i] = period > 0.0f ? fmodf(at.y, period) : at.y;
        jox_param_set(a, JOX_PARAM_radius, i, (float)draw_near(crowd, &drawn, 0.1, 0.3));
        if (!mixed)
            continue;
        jox_param_set(a, JOX_PARAM_neighbours, i,
                      floorf((float)draw_near(crowd, &drawn, 0.0, 16.999)));
        jox_param_set(a, JOX_PARAM_perception, i, (float)draw_near(crowd, &drawn, 0.0, 5.0));
    }
}

/* Moves agents away from where they were sorted, with a known drift. */
static void stir(JoxNav *nav, JoxAgents *a, uint32_t crowd) {
    const JoxV2 least = {crowd % 2 ? 0.05f : -0.2f, -0.3f},
                most = {0.35f, crowd % 3 ? 0.1f : -0.1f};
    uint32_t drawn = 100000;
    bool stays = false;
    for (uint32_t i = 0; i < a->count; i++) {
        const float x = a->x[i] + (float)draw_near(crowd, &drawn, (double)least.x, (double)most.x);
        const float y = a->y[i] + (float)draw_near(crowd, &drawn, (double)least.y, (double)most.y);
        const bool out = (a->period.x > 0.0f && (x < 0.0f || x >= a->period.x)) ||
                         (a->period.y > 0.0f && (y < 0.0f || y >= a->period.y));
        stays |= out;
        a->x[i] = out ? a->x[i] : x;
        a->y[i] = out ? a->y[i] : y;
    }
    const JoxV2 slack = {1e-4f, 1e-4f}, none = {0.0f, 0.0f};
    const JoxDrift bounds = {0.5f, jox_sub(least, slack), jox_add(most, slack)};
    JoxDrift *drift = &nav->drift;
    const JoxDrift way = stays ? jox_drift_of_both(bounds, (JoxDrift){0.0f, none, none}) : bounds;
    drift->farthest += way.farthest;
    drift->least = jox_add(drift->least, way.least);
    drift->most = jox_add(drift->most, way.most);
}

/* Moves half of the agents to the places of others, with an unknown drift. */
static void scatter(JoxNav *nav, JoxAgents *a) {
    for (uint32_t i = 0; i < a->count / 2; i++) {
        const uint32_t j = a->count - 1 - i;
        const JoxV2 at = {a->x[i], a->y[i]};
        a->x[i] = a->x[j];
        a->y[i] = a->y[j];
        a->x[j] = at.x;
        a->y[j] = at.y;
    }
    nav->stray_count = 0;
    jox_nav_invalidate_order(nav);
}

/* Moves agents over periodic edges, and lists them as strays. */
static void send_over_edges(JoxNav *nav, JoxAgents *a) {
    const float period = a->period.x;
    for (uint32_t i = 0; i < a->count && nav->stray_count < JOX_MOST_STRAYS; i++) {
        const float shift = a->x[i] < 0.1f ? period : a->x[i] > period - 0.1f ? -period : 0.0f;
        if (period <= 0.0f || shift == 0.0f)
            continue;
        a->x[i] = fminf(fmaxf(a->x[i] + shift, 0.0f), period - 0.01f);
        jox_nav_list_stray(nav, i);
    }
    jox_nav_place_strays(nav, a);
}

/* Removes a few agents; the next sort, which sorts nothing, takes them out of the grid. */
static void remove_some(JoxNav *nav, JoxAgents *a, uint32_t tick) {
    for (uint32_t i = 0; i < a->count; i++)
        a->removed[i] = a->id[i] % 13 == tick;
    jox_agents_compact(a);
    jox_nav_sort(nav, a, tick);
}

typedef struct Other {
    float d2;
    uint32_t id, index;
} Other;

static int by_distance(const void *one, const void *two) {
    const Other *a = one, *b = two;
    if (a->d2 != b->d2)
        return a->d2 < b->d2 ? -1 : 1;
    return a->id < b->id ? -1 : 1;
}

/* Returns the squared distance of agent j through the seams through which agent i sees it, m2. */
static float measure_through_seams(const JoxAgents *a, uint32_t i, uint32_t j) {
    const JoxStoreys *s = a->storeys;
    const uint32_t here = jox_sheet_of(s, a->y[i]), there = jox_sheet_of(s, a->y[j]);
    const JoxV2 from = {a->x[i], a->y[i] - (float)here * s->pitch};
    const JoxV2 to = {a->x[j], a->y[j] - (float)there * s->pitch};
    float least = INFINITY;
    for (uint32_t k = 0; k < s->seam_count; k++) {
        const JoxSeam *seam = &s->seams[k];
        const float dx = a->x[j] - a->x[i], dy = a->y[j] - (a->y[i] + seam->shift);
        if (seam->here == here && seam->there == there && jox_seam_lets_see(seam, from, to))
            least = jox_minf(least, dx * dx + dy * dy);
    }
    return least;
}

/* Lists all agents within a radius, nearest first, ties by id; an agent seen from two sides counts
   on the nearer one. The distance is computed from the image of the agent that looks. */
static uint32_t list_reference(const JoxAgents *a, uint32_t i, float radius, Other *out) {
    uint32_t count = 0;
    for (uint32_t j = 0; j < a->count; j++) {
        float least = INFINITY;
        for (int row = -1; row <= 1 && j != i; row++)
            for (int column = -1; column <= 1; column++) {
                float x = a->x[i] + (float)column * a->period.x;
                float y = a->y[i] + (float)row * a->period.y;
                float dx = a->x[j] - x, dy = a->y[j] - y;
                least = jox_minf(least, dx * dx + dy * dy);
            }
        if (a->storeys && j != i)
            least = jox_minf(least, measure_through_seams(a, i, j));
        if (least <= radius * radius)
            out[count++] = (Other){least, a->id[j], j};
    }
    qsort(out, count, sizeof *out, by_distance);
    return count;
}

static float find_sight(const JoxAgents *a, float reach) {
    if (a->period.x > 0.0f)
        reach = jox_minf(reach, 0.49f * a->period.x);
    if (a->pitch > 0.0f)
        reach = jox_minf(reach, 0.49f * a->pitch);
    return a->period.y > 0.0f ? jox_minf(reach, 0.49f * a->period.y) : reach;
}

/* Keeps those of `count` others that may touch agent i, by how near they may reach to its centre;
   returns how many it lists. */
static uint32_t list_reaching(const JoxAgents *a, uint32_t i, uint32_t count, Other *all) {
    const JoxTorso own = jox_agent_torso(a, i, false);
    const float most = own.radius + own.half + JOX_TOUCH_LEAST + JOX_TOUCH_MOST;
    uint32_t kept = 0;
    for (uint32_t k = 0; k < count; k++) {
        const JoxTorso torso = jox_agent_torso(a, all[k].index, false);
        const float near = jox_maxf(0.0f, sqrtf(all[k].d2) - (torso.radius + torso.half));
        if (near * near <= most * most)
            all[kept++] = (Other){near * near, all[k].id, all[k].index};
    }
    qsort(all, kept, sizeof *all, by_distance);
    return kept < JOX_MOST_NEIGHBOURS ? kept : JOX_MOST_NEIGHBOURS;
}

static void compare_touching(const JoxAgents *a, const JoxNeighbours *n, uint32_t i, float seen,
                             Other *all) {
    float range =
        find_sight(a, jox_touch_reach(n, a->contact_radius[i] +
                                             jox_length(jox_v2(a->axis_x[i], a->axis_y[i]))));
    assert_int_equal(n->touch_count[i] == JOX_TOUCH_AMONG_NEIGHBOURS, seen >= range);
    if (n->touch_count[i] == JOX_TOUCH_AMONG_NEIGHBOURS)
        return;
    const uint32_t count = list_reaching(a, i, list_reference(a, i, range, all), all);
    assert_int_equal(n->touch_count[i], count);
    for (uint32_t k = 0; k < count; k++)
        assert_int_equal(n->touch_index[(size_t)i * JOX_MOST_NEIGHBOURS + k], all[k].index);
}

static void compare_agent_neighbours(const JoxAgents *a, const JoxNeighbours *n) {
    static Other all[MOST_PEOPLE];
    for (uint32_t i = 0; i < a->count; i++) {
        const uint32_t most = (uint32_t)jox_param(a, JOX_PARAM_neighbours, i);
        const float perception = find_sight(a, jox_param(a, JOX_PARAM_perception, i));
        uint32_t count = list_reference(a, i, perception, all);
        count = count < most ? count : most;
        assert_int_equal(n->count[i], count);
        const float touch = jox_touch_most(n);
        uint32_t close = 0, perhaps = 0; /* within touch range; slightly beyond it too */
        for (uint32_t k = 0; k < count; k++) {
            assert_int_equal(n->index[jox_neighbour_at(n, i, k)], all[k].index);
            close += all[k].d2 <= touch * touch;
            perhaps += all[k].d2 <= 1.0001f * touch * touch;
        }
        assert_in_range(n->close[i], close, perhaps);
        if (count > JOX_CROWD_RANK)
            assert_true(n->crowding2[i] == all[JOX_CROWD_RANK].d2);
        float reach = most && count == most ? sqrtf(all[count - 1].d2) : perception;
        float area = 3.14159265f * jox_maxf(reach * reach, 0.0025f);
        assert_true(a->search_radius[i] == jox_maxf(reach, 0.01f));
        assert_true(a->density[i] == (float)count / area);
        compare_touching(a, n, i, most ? reach : 0.0f, all);
    }
}

/* Compares the search of one agent without the grid for some agents. */
static void compare_alone(const JoxAgents *a, const JoxNeighbours *n) {
    JoxNeighbours alone = {0};
    for (uint32_t i = 0; i < a->count; i += 7) {
        jox_perceive_alone(a, i, false, &alone);
        assert_int_equal(alone.count[i], n->count[i]);
        assert_true(alone.has_torsos == n->has_torsos);
        for (uint32_t k = 0; k < n->count[i]; k++) {
            const uint32_t j = n->index[jox_neighbour_at(n, i, k)];
            assert_int_equal(alone.index[jox_neighbour_at(&alone, i, k)], j);
            if (n->has_torsos)
                assert_memory_equal(&alone.shapes[j], &n->shapes[j], sizeof *n->shapes);
        }
        if (n->has_torsos)
            assert_memory_equal(&alone.shapes[i], &n->shapes[i], sizeof *n->shapes);
    }
    jox_neighbours_free(&alone);
}

static void compare_near_crowd(JoIsa isa, uint32_t crowd) {
    JoxAgents agents = {0};
    JoxNeighbours neighbours = {0};
    JoxNav *nav = jox_nav_create(NULL);
    jox_nav_set_isa(nav, isa);
    fill_crowd(&agents, crowd);
    jox_nav_sort(nav, &agents, 0);
    for (uint32_t pass = 0; pass < 4; pass++) {
        jox_nav_perceive(nav, &agents, &neighbours, NULL);
        compare_agent_neighbours(&agents, &neighbours);
        compare_alone(&agents, &neighbours);
        remove_some(nav, &agents, pass + 1);
        stir(nav, &agents, crowd);
        if (pass == 0)
            send_over_edges(nav, &agents);
        if (pass == 0 && agents.storeys)
            send_over_seams(nav, &agents);
        if (pass == 2)
            scatter(nav, &agents);
        jox_nav_place_strays(nav, &agents);
    }
    jox_nav_free(nav);
    jox_agents_free(&agents);
    jox_neighbours_free(&neighbours);
}

static void test_neighbours(void **state) {
    (void)state;
    for (JoIsa isa = JO_ISA_SCALAR; isa <= JO_ISA_NEON; isa++)
        for (uint32_t crowd = 0; jox_isa_runs(isa) && crowd < CROWDS; crowd++)
            compare_near_crowd(isa, crowd);
}

static void neighbours_are_seen_over_stairs(void **state) {
    (void)state;
    jox_storeys_lay_out(&building, (JoxV2){0, 0}, (JoxV2){30, 12});
    assert_int_equal(building.seam_count, 8);
    for (JoIsa isa = JO_ISA_SCALAR; isa <= JO_ISA_NEON; isa++)
        for (uint32_t crowd = CROWDS; jox_isa_runs(isa) && crowd < CROWDS + 6; crowd++)
            compare_near_crowd(isa, crowd);
    free_building();
}

/* Names of instruction sets, and the error where a machine lacks one. */
static void test_instruction_sets(void **state) {
    (void)state;
    JoIsa isa = JO_ISA_WIDEST;
    JoError error = {0};
    assert_true(jo_isa_find("scalar", &isa, &error));
    assert_int_equal(isa, JO_ISA_SCALAR);
    assert_false(jo_isa_find("mmx", &isa, &error));
    assert_non_null(strstr(error.text, "scalar"));
    for (JoIsa each = JO_ISA_SCALAR; each <= JO_ISA_NEON; each++) {
        JoWorldDef def = jo_default_world_def();
        def.isa = each;
        JoWorld *world = jo_world_create(&def, &error);
        assert_int_equal(world != NULL, jox_isa_runs(each));
        if (!world)
            assert_non_null(strstr(error.text, jox_isa_name(each)));
        jo_world_free(world);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_neighbours),
        cmocka_unit_test(neighbours_are_seen_over_stairs),
        cmocka_unit_test(test_instruction_sets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
