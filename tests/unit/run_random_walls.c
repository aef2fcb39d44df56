/* Checks that no person passes a wall, in random scenes with gates, doors, added walls, sources,
 * births and reloads, a third of them with joined edges. JOSTLE_PASSAGES: count of scenes. */
#include <math.h>

#include "base/number/random.h"
#include "geom/polygon.h"
#include "geom/wall_way.h"
#include "unit/effort.h"
#include "unit/gate_ball_scene.h"

enum { SCENES = 250 / EFFORT_EACH, MOST_PEOPLE = 512, MOST_RINGS = 256 };

/* A hall of 12 x 8 m, sealed at edges that are not joined; no walls at x < 3 m, except at joined
 * edges. */
static const JoxV2 SIZE = {12, 8};
static const double FAR = 3.5; /* m: a longer step over joined edges has an ambiguous direction */
static const double STEPS[] = {0.01, 0.02, 0.05, 0.1, 0.2};

typedef struct Passage {
    uint64_t number;
    uint32_t drawn;
    JoxText yaml, lua;
    JoScene *scene;
    double dt;
    JoxV2 period;
    uint32_t made; /* walls added during the run */
    /* State of agents before the step, by id. */
    struct Before {
        bool there;
        JoxV2 at;
        bool inside[MOST_RINGS]; /* whether it was inside each solid of the step */
    } before[MOST_PEOPLE];
    uint64_t crossings, checked;
} Passage;

static double draw_number(Passage *p, double low, double high) {
    return low + (high - low) * jox_random_unit(p->number, p->drawn++, 0, JOX_DRAW_FILL, 0);
}

static bool draw_whether(Passage *p, double share) {
    return draw_number(p, 0.0, 1.0) < share;
}

/* ---- scenes ---- */

/* Adds a thin wall of two or three points, or a solid quadrangle. */
static void add_random_wall(Passage *p, const char *more) {
    const double x = draw_number(p, 3.5, 11.0), y = draw_number(p, 0.5, 7.5);
    if (draw_whether(p, 0.6)) {
        jox_text_printf(&p->yaml, "  - {line: [[%.3f, %.3f], [%.3f, %.3f]", x, y,
                        draw_number(p, 3.2, 11.8), draw_number(p, 0.0, 8.0));
        if (draw_whether(p, 0.5))
            jox_text_printf(&p->yaml, ", [%.3f, %.3f]", draw_number(p, 3.2, 11.8),
                            draw_number(p, 0.0, 8.0));
        jox_text_printf(&p->yaml, "]%s}\n", more);
        return;
    }
    const double w = draw_number(p, 0.1, 1.5), h = draw_number(p, 0.1, 1.5),
                 slant = draw_number(p, -0.3, 0.3);
    jox_text_printf(
        &p->yaml, "  - {solid: [[%.3f, %.3f], [%.3f, %.3f], [%.3f, %.3f], [%.3f, %.3f]]%s}\n", x, y,
        x + w, y + slant * w, x + w - slant * h, y + slant * w + h, x - slant * h, y + h, more);
}

/* Adds a line or solid at a joined edge or across it. */
static void add_wall_at_edges(Passage *p, bool x, const char *more) {
    static const double OFF[] = {0.0, 0.0, 0.2, -0.4};
    const double edge = (x ? SIZE.x : SIZE.y) * (draw_whether(p, 0.5) ? 1.0 : 0.0);
    const double from = edge + OFF[(int)draw_number(p, 0.0, 4.0)], other = x ? SIZE.y : SIZE.x;
    const double a = draw_number(p, 0.0, other), b = draw_number(p, 0.0, other),
                 slant = draw_number(p, -0.5, 0.5);
    const int kind = (int)draw_number(p, 0.0, 3.0);
    const double along[4] = {from, kind == 1 ? from : from + 0.7 + slant, from + 0.6, from};
    const double across[4] = {a, b, b, b + (a > b ? -0.8 : 0.8)};
    const int count = kind == 2 ? 4 : 2;
    jox_text_printf(&p->yaml, "  - {%s: [", count == 4 ? "solid" : "line");
    for (int k = 0; k < count; k++) {
        const double at[2] = {x ? along[k] : across[k], x ? across[k] : along[k]};
        jox_text_printf(&p->yaml, "%s[%.3f, %.3f]", k ? ", " : "", at[0], at[1]);
    }
    jox_text_printf(&p->yaml, "]%s}\n", more);
}

/* Writes walls that seal the hall along edges that are not joined, and walls at joined edges. */
static void write_edges(Passage *p) {
    const bool x = p->period.x > 0.0f, y = p->period.y > 0.0f;
    if (!x && !y)
        jox_text_add(&p->yaml, "  - {line: [[0, 0], [12, 0], [12, 8], [0, 8]], closed: true}\n");
    else if (!y)
        jox_text_add(&p->yaml, "  - {line: [[0, 0], [12, 0]]}\n"
                               "  - {line: [[-1, 8], [13, 8]]}\n");
    else if (!x)
        jox_text_add(&p->yaml, "  - {line: [[0, -2], [0, 8]]}\n"
                               "  - {line: [[12, 0], [12, 8]]}\n");
    for (int k = 0; k < 2 && x; k++)
        add_wall_at_edges(p, true, k ? ", name: gate" : "");
    for (int k = 0; k < 2 && y; k++)
        add_wall_at_edges(p, false, k ? ", name: door, open: true" : "");
}

/* Adds the same walls for the same `seed`, except the last `others`, which differ in each version.
 */
static void write_walls(Passage *p, uint32_t seed, uint32_t count, uint32_t others) {
    const uint32_t drawn = p->drawn;
    jox_text_add(&p->yaml, "walls:\n");
    p->drawn = seed + 2000;
    write_edges(p);
    p->drawn = seed;
    for (uint32_t w = 0; w < count; w++) {
        if (w == count - others)
            p->drawn = drawn;
        add_random_wall(p, "");
    }
    p->drawn = seed + 1000;
    add_random_wall(p, ", name: gate, open: true");
    add_random_wall(p, ", name: gate");
    add_random_wall(p, ", name: door, open: true");
    p->drawn = drawn + 100;
}

static void write_passage_scene(Passage *p, uint32_t walls, uint32_t others) {
    const uint32_t people = 12 + (uint32_t)(p->number % 17);
    p->yaml.length = 0;
    jox_text_printf(&p->yaml,
                    "jostle: 1\nstep: %g\nguard: {people: stop}\n"
                    "places:\n"
                    "  west: {polygon: [[0.3, 0.3], [2.7, 0.3], [2.7, 7.7], [0.3, 7.7]]}\n"
                    "  east: {point: [11, 4], radius: 0.5}\n",
                    p->dt);
    if (p->period.x > 0.0f || p->period.y > 0.0f)
        jox_text_printf(&p->yaml, "bounds: [[0, 0], [12, 8]]\nperiodic: %s\n",
                        p->period.y == 0.0f   ? "x"
                        : p->period.x == 0.0f ? "y"
                                              : "both");
    write_walls(p, 5000, walls, others);
    if (jox_bodies_available())
        jox_text_add(&p->yaml,
                     "bodies:\n"
                     "  - {name: leaf, shape: {box: {size: [0.8, 0.1, 2]}}, kinematic: true, at: "
                     "[6, 4, 1], path: {through: [[8, 4, 1], [6, 4, 1]], speed: 2, wait: 0.1}}\n"
                     "  - {name: ball, shape: {sphere: {radius: 0.3}}, mass: 40, at: [2, 4, 0.3], "
                     "velocity: [9, 0, 0]}\n");
    p->drawn = 9000;
    jox_text_add(&p->yaml,
                 "groups:\n  people: {behaviour: own.lua, set: {goal: east}, at: [[1, 1]");
    for (uint32_t n = 1; n < people; n++)
        jox_text_printf(&p->yaml, ", [%.3f, %.3f]", draw_number(p, 0.3, 11.7),
                        draw_number(p, 0.3, 7.7));
    jox_text_printf(&p->yaml,
                    "]}\n"
                    "sources: [{at: west, like: people, rate: %.2f}]\n"
                    "sinks: [{at: east}]\n"
                    "events:\n"
                    "  - {at: %.2f, every: %.2f, open: gate}\n"
                    "  - {at: %.2f, every: %.2f, close: gate}\n"
                    "  - {at: %.2f, every: 0.9, close: door}\n"
                    "  - {at: %.2f, every: 0.7, open: door}\n",
                    draw_number(p, 0.5, 6.0), draw_number(p, 0.0, 0.5), draw_number(p, 0.3, 0.9),
                    draw_number(p, 0.1, 0.6), draw_number(p, 0.3, 0.9), draw_number(p, 0.0, 0.9),
                    draw_number(p, 0.0, 0.7));
}

static void write_passage_behaviour(Passage *p) {
    static const double FAST[] = {1.5, 1.5, 5.0, 16.0};
    const double speed = FAST[p->number % 4];
    p->lua.length = 0;
    jox_text_printf(
        &p->lua,
        MACHINE_START "\"A\",\n  defaults = { speed = %g, max_speed = %g, push = %g, "
                      "radius = uniform(0.12, 0.3), perception = 2, time_gap = %g },\n"
                      "  states = { A = { steer = %s } }, own = { goal = \"east\" } }\n",
        speed, 1.2 * speed, draw_whether(p, 0.5) ? 800.0 : 0.0, draw_whether(p, 0.5) ? 1.0 : 0.0,
        p->period.y > 0.0f   ? "drift(-1, -0.7)"
        : p->period.x > 0.0f ? "drift(1, 0.1)"
                             : "seek(own.goal)");
}

/* ---- inputs and edits ---- */

static void edit_walls(Passage *p, uint32_t walls) {
    JoxDiagnostics diagnostics = {0};
    write_passage_scene(p, walls, 2);
    write_test_file("scene.yaml", p->yaml.data);
    JoxSceneSpec *spec = jox_run_load_spec(&p->scene->def, p->scene->mods, 0, &diagnostics);
    if (spec) { /* a wall may cross itself */
        jox_run_reload_scene(p->scene, &spec, 0.0);
        jox_scene_free(spec);
    }
    jox_diag_free(&diagnostics);
}

/* Applies a random line of input, which may be refused. */
static void apply_random_line(Passage *p) {
    char line[200];
    JoError error = {0};
    const double x = draw_number(p, 3.5, 11.0), y = draw_number(p, 0.5, 7.0);
    switch ((int)draw_number(p, 0.0, 7.0)) {
    case 0:
        snprintf(line, sizeof line, "wall w%u %.3f %.3f %.3f %.3f", p->made++, x, y,
                 draw_number(p, 3.2, 11.8), draw_number(p, 0.0, 8.0));
        break;
    case 1: {
        const double w = draw_number(p, 0.3, 2.0), h = draw_number(p, 0.3, 2.0);
        snprintf(line, sizeof line, "wall w%u %.3f %.3f %.3f %.3f %.3f %.3f %.3f %.3f", p->made++,
                 x, y, x + w, y, x + w, y + h, x, y + h);
        break;
    }
    case 2:
        snprintf(line, sizeof line, "unwall w%d", (int)draw_number(p, 0.0, p->made + 1.0));
        break;
    case 3:
        snprintf(line, sizeof line, "spawn people %.3f %.3f", draw_number(p, 0.2, 11.8), y);
        break;
    case 4:
        snprintf(line, sizeof line, "%s gate", draw_whether(p, 0.5) ? "open" : "close");
        break;
    default:
        snprintf(line, sizeof line, "push %d %.0f %.0f", (int)draw_number(p, 0.0, 20.0),
                 draw_number(p, -10000.0, 10000.0), draw_number(p, -10000.0, 10000.0));
    }
    jo_scene_input(p->scene, line, &error);
}

/* ---- checks ---- */

static void note_before(Passage *p) {
    const JoxAgents *a = &p->scene->world->state.agents;
    memset(p->before, 0, sizeof p->before);
    for (uint32_t i = 0; i < a->count; i++)
        if (a->id[i] < MOST_PEOPLE)
            p->before[a->id[i]] = (struct Before){.there = true, .at = {a->x[i], a->y[i]}};
}

/* Returns the shift of the n-th of nine images of the walls, m; zero along an axis that is not
 * joined. */
static JoxV2 shift_of(const Passage *p, int n) {
    return (JoxV2){(float)(n % 3 - 1) * p->period.x, (float)(n / 3 - 1) * p->period.y};
}

/* Notes the solids that contain a point: an agent may leave a solid that was put over it. */
static void note_solids(const Passage *p, const JoxWalls *walls, JoxV2 at,
                        bool inside[MOST_RINGS]) {
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        inside[r] = false;
        for (int n = 0; n < 9 && walls->rings[r].solid; n++)
            inside[r] |= jox_walls_ring_holds(walls, r, jox_sub(at, shift_of(p, n)));
    }
}

/* Returns the length of the way from one point to another round the end of an edge, m. */
static double measure_detour(const JoxWallVertex *v, JoxV2 from, JoxV2 to) {
    return (double)(jox_length(jox_sub(v->point, from)) + jox_length(jox_sub(to, v->point)));
}

/* Returns whether a step longer than 0.05 s, which is done in parts, may have led round the end of
 * a wall. */
static bool may_bend_round(const Passage *p, const JoxWalls *walls, uint32_t ring, JoxV2 from,
                           JoxV2 to, double most) {
    const struct JoxWallRing *r = &walls->rings[ring];
    for (uint32_t i = 0; p->dt > 0.05 && i < r->count; i++)
        if (measure_detour(&walls->vertices[r->first + i], from, to) < most)
            return true;
    return false;
}

/* Checks a way against the walls as drawn; false if it leads through one. */
static bool check_way_as_drawn(Passage *p, const JoxWalls *walls, uint32_t id, JoxV2 from, JoxV2 to,
                               double most, const char *what) {
    const bool *inside = p->before[id].inside;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t i = 0; i < ring->count && !inside[r]; i++) {
            const JoxWallVertex *v = &walls->vertices[ring->first + i];
            const JoxV2 end = walls->vertices[v->next].point;
            if (!jox_edge_lies_between(v->point, end, from, to) ||
                may_bend_round(p, walls, r, from, to, most))
                continue;
            p->crossings++;
            print_message("scene %llu, step %llu of %g s: agent %u %s from (%.9g, %.9g) to (%.9g, "
                          "%.9g) through (%.9g, %.9g) - (%.9g, %.9g) of ring %u%s\n",
                          (unsigned long long)p->number,
                          (unsigned long long)p->scene->world->state.tick, p->dt, id, what,
                          (double)from.x, (double)from.y, (double)to.x, (double)to.y,
                          (double)v->point.x, (double)v->point.y, (double)end.x, (double)end.y, r,
                          ring->solid ? ", solid" : "");
            return false;
        }
    }
    return true;
}

/* Checks the shorter way between two points against the walls and their images. */
static void check_shorter_way(Passage *p, const JoxWalls *walls, uint32_t id, JoxV2 from, JoxV2 to,
                              double most, const char *what) {
    const JoxV2 way = jox_wrap(&p->scene->world->state.agents, jox_sub(to, from));
    const bool joined = p->period.x > 0.0f || p->period.y > 0.0f;
    if (joined && (double)jox_length(way) > FAR)
        return;
    p->checked++;
    if (!joined) {
        check_way_as_drawn(p, walls, id, from, to, most, what);
        return;
    }
    bool clear = true;
    for (int n = 0; n < 9 && clear; n++) {
        const JoxV2 start = jox_sub(from, shift_of(p, n));
        clear = check_way_as_drawn(p, walls, id, start, jox_add(start, way), most, what);
    }
}

static void check_step(Passage *p) {
    const JoxAgents *a = &p->scene->world->state.agents;
    const JoxWalls *walls = &p->scene->world->scratch.walls;
    assert_true(walls->ring_count <= MOST_RINGS);
    for (uint32_t i = 0; i < a->count; i++) {
        const uint32_t id = a->id[i];
        const JoxV2 now = {a->x[i], a->y[i]}, last = {a->prev_x[i], a->prev_y[i]};
        const bool in_hall = jox_is_within(now, jox_v2(0, 0), SIZE);
        if (!in_hall) {
            p->crossings++;
            print_message("scene %llu: agent %u outside, at (%g, %g)\n",
                          (unsigned long long)p->number, id, (double)now.x, (double)now.y);
        }
        if (id >= MOST_PEOPLE || !p->before[id].there)
            continue;
        const JoxV2 before = p->before[id].at;
        const double speed = hypot((double)a->vx[i], (double)a->vy[i]);
        note_solids(p, walls, before, p->before[id].inside);
        if (p->dt > 0.05) {
            check_shorter_way(p, walls, id, before, now, 2.0 * p->dt * fmax(speed, 30.0), "went");
            continue;
        }
        check_shorter_way(p, walls, id, before, last, 0.0, "was moved");
        note_solids(p, walls, last, p->before[id].inside);
        check_shorter_way(p, walls, id, last, now, 0.0, "went");
    }
}

/* ---- the test ---- */

static void run_passage(Passage *p) {
    const uint32_t walls = 1 + (uint32_t)(p->number % 4);
    JoError error = {0};
    p->drawn = p->made = 0;
    p->dt = STEPS[p->number % 5];
    p->period = jox_v2(p->number % 9 == 4 || p->number % 9 == 7 ? SIZE.x : 0.0f,
                       p->number % 9 == 1 || p->number % 9 == 7 ? SIZE.y : 0.0f);
    write_passage_behaviour(p);
    write_passage_scene(p, walls, 0);
    write_test_file("own.lua", p->lua.data);
    JoSceneDef def = define_scene(write_test_file("scene.yaml", p->yaml.data));
    def.no_density = true;
    p->scene = jo_scene_load(&def, &error);
    if (!p->scene) {
        fail_msg("scene %llu: %s\n%s", (unsigned long long)p->number, error.text, p->yaml.data);
        return;
    }
    for (int n = 0; n < 60; n++) {
        if (n % 20 == 13 && p->number % 3 == 0)
            edit_walls(p, walls + (n > 20));
        if (draw_whether(p, 0.3))
            apply_random_line(p);
        note_before(p);
        step_scene(p->scene, 1);
        check_step(p);
    }
    jo_scene_free(p->scene);
}

static void nobody_passes_a_wall_in_random_scenes(void **state) {
    (void)state;
    const char *wanted = getenv("JOSTLE_PASSAGES");
    const uint64_t scenes = wanted ? strtoull(wanted, NULL, 10) : SCENES;
    Passage *p = jox_alloc(1, sizeof *p);
    for (p->number = 0; p->number < scenes; p->number++)
        run_passage(p);
    assert_true(p->checked > 300 * scenes);
    if (p->crossings)
        fail_msg("%llu of %llu ways crossed a wall", (unsigned long long)p->crossings,
                 (unsigned long long)p->checked);
    jox_text_free(&p->yaml);
    jox_text_free(&p->lua);
    jox_free(p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nobody_passes_a_wall_in_random_scenes),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
