/* Random buildings: storeys of a plan with inner walls, joined by straight and dog-leg stairs at
   any angle, escalators, and lifts with riders, some in a row. Everybody stays on floor, passes no
   wall, and gets out; runs on several threads and instruction sets have one hash, and go on from a
   saved state to the same one. JOSTLE_BUILDINGS says how many buildings are tried (default 4),
   JOSTLE_BUILDING which is the first. */
#include "base/number/random.h"
#include "geom/polygon.h"
#include "geom/wall_way.h"
#include "unit/effort.h"
#include "unit/scene_loader.h"

typedef struct Draw {
    uint32_t building, count;
} Draw;

static double draw_number(Draw *d, double from, double to) {
    return from + (to - from) * jox_random_unit(77, d->building, 0, JOX_DRAW_FILL, d->count++);
}

static uint32_t draw_whole(Draw *d, uint32_t below) {
    return (uint32_t)draw_number(d, 0.0, (double)below);
}

enum { WIDTH = 40, DEPTH = 24, LONGEST = 400 /* s */ };

/* Appends the path of a stair about a centre, turned by an angle. */
static void add_path(Draw *d, double x, double y, double width, JoxText *out) {
    static const double STRAIGHT[][2] = {{-3.2, 0.0}, {3.2, 0.0}};
    const double fold = 0.5 * width + 0.15;
    const double dog_leg[][2] = {{-2.6, -fold}, {2.2, -fold}, {2.2, fold}, {-2.6, fold}};
    const bool folded = draw_whole(d, 2);
    const double angle =
        draw_whole(d, 3) ? 1.5707963 * draw_whole(d, 4) : draw_number(d, 0.0, 6.28);
    const int points = folded ? 4 : 2;
    jox_text_add(out, "path: [");
    for (int k = 0; k < points; k++) {
        const double *p = folded ? dog_leg[k] : STRAIGHT[k];
        jox_text_printf(out, "%s[%.3f, %.3f]", k ? ", " : "",
                        x + cos(angle) * p[0] - sin(angle) * p[1],
                        y + sin(angle) * p[0] + cos(angle) * p[1]);
    }
    jox_text_add(out, "]");
}

/* Appends the storeys that a lift serves. */
static void add_served(uint32_t from, uint32_t to, JoxText *out) {
    jox_text_add(out, ", storeys: [");
    for (uint32_t k = from; k <= to; k++)
        jox_text_printf(out, "%ss%u", k > from ? ", " : "", k);
    jox_text_add(out, "]");
}

/* Appends lifts beside the stairs, none to two; returns how many. They serve all storeys, or the
   first those up to `lobby` and the second those from there on. */
static uint32_t add_lifts(Draw *d, uint32_t storeys, uint32_t *lobby, JoxText *out) {
    const uint32_t lifts = draw_whole(d, 3);
    Draw of_chain = {d->building, 2000}; /* leaves the other draws alone */
    const bool chain = lifts == 2 && storeys > 2 && draw_whole(&of_chain, 3);
    *lobby = chain ? 1 + draw_whole(&of_chain, storeys - 2) : storeys - 1;
    if (lifts)
        jox_text_add(out, "lifts:\n");
    for (uint32_t l = 0; l < lifts; l++) {
        const double x = l ? 0.6 : 37.6, y = l ? 19.0 : draw_number(d, 10.0, 13.0);
        const double door = draw_number(d, 0.25, 0.6);
        const double side = l ? x + 1.7 : x; /* towards the middle of the building */
        jox_text_printf(out,
                        "  l%u: {area: [[%g, %.3f], [%g, %.3f]], door: [[%g, %.3f], [%g, %.3f]], "
                        "capacity: %u, speed: %.2f, dwell: %.1f, returns: %s",
                        l, x, y, x + 1.7, y + 1.9, side, y + door, side, y + door + 1.0,
                        1 + draw_whole(d, 8), draw_number(d, 0.6, 2.5), draw_number(d, 0.0, 5.0),
                        draw_whole(d, 2) ? "true" : "false");
        if (chain)
            add_served(l ? *lobby : 0, l ? storeys - 1 : *lobby, out);
        jox_text_add(out, "}\n");
    }
    return lifts;
}

/* Appends people who cannot use stairs, people who ride to a storey, and modes of the lifts. */
static void add_riders(Draw *d, uint32_t storeys, uint32_t lobby, JoxText *out) {
    for (uint32_t k = 1; k < storeys; k++) {
        jox_text_printf(out,
                        "  wheels%u: {count: %u, in: f%u, set: {lifts: only}, journey: [{exit: "
                        "out}]}\n",
                        k, 1 + draw_whole(d, 3), k);
        jox_text_printf(
            out, "  riders%u: {count: %u, in: f%u, journey: [{ride: l0.s%u}, {exit: out}]}\n", k,
            1 + draw_whole(d, 3), k, k > lobby ? lobby : draw_whole(d, k));
    }
    jox_text_printf(
        out,
        "  visitors: {count: 3, in: f0, journey: [{to: f%u}, {exit: out}]}\n"
        "  wheels up: {count: 2, in: f0, set: {lifts: only}, journey: [{to: f%u}, {exit: "
        "out}]}\n",
        storeys - 1, storeys - 1);
    const uint32_t from = 5 + draw_whole(d, 30);
    jox_text_printf(out,
                    "events:\n  - {at: %u, lift: all, mode: %s}\n  - {at: %u, lift: all, mode: "
                    "in_use}\n",
                    from, draw_whole(d, 2) ? "firemen" : "out_of_use",
                    from + 5 + draw_whole(d, 20));
}

/* Writes a building; every storey has a stair to the next one that leads both ways. */
static void write_building(uint32_t building, JoxText *out) {
    Draw d = {building, 0};
    const uint32_t storeys = 2 + draw_whole(&d, 4);
    jox_text_add(out, "jostle: 1\nstep: 0.05\nstoreys:\n");
    for (uint32_t k = 0; k < storeys; k++)
        jox_text_printf(out, "  s%u: {height: %g}\n", k, 3.0 * k);
    jox_text_add(out, "stairs:\n");
    for (uint32_t k = 0; k + 1 < storeys; k++)
        for (uint32_t n = 0; n < 1 + draw_whole(&d, 2); n++) {
            const double width = draw_number(&d, 1.2, 2.0);
            jox_text_printf(out, "  w%u_%u: {from: s%u, to: s%u, width: %.3f, ", k, n, k, k + 1,
                            width);
            add_path(&d, (n ? 32.0 : 8.0) + draw_number(&d, -1.0, 1.0),
                     (k % 2 ? 18.0 : 6.0) + draw_number(&d, -1.0, 1.0), width, out);
            const bool escalator = n && draw_whole(&d, 2);
            jox_text_add(out, escalator ? draw_whole(&d, 2) ? ", kind: escalator, way: up}\n"
                                                            : ", kind: escalator, way: down}\n"
                                        : "}\n");
        }
    Draw of_lifts = {building, 1000}; /* leaves the draws of the rest alone */
    uint32_t lobby;
    const uint32_t lifts = add_lifts(&of_lifts, storeys, &lobby, out);
    jox_text_add(out, "walls:\n");
    for (uint32_t k = 0; k < storeys; k++) {
        jox_text_printf(
            out, "  - {line: [[0, 0], [%d, 0], [%d, %d], [0, %d]], closed: true, storey: s%u}\n",
            WIDTH, WIDTH, DEPTH, DEPTH, k);
        for (uint32_t n = 0; n < draw_whole(&d, 3); n++) { /* between the stairs */
            const double x = (n ? 25.5 : 14.5) + draw_number(&d, -0.5, 0.5);
            const double from = draw_number(&d, 0.0, 16.0);
            jox_text_printf(out, "  - {line: [[%.3f, %.3f], [%.3f, %.3f]], storey: s%u}\n", x, from,
                            x + draw_number(&d, -0.5, 0.5), from + draw_number(&d, 2.0, 8.0), k);
        }
    }
    jox_text_printf(out, "places:\n  out: {polygon: [[0.3, 9], [1.3, 9], [1.3, 15], [0.3, 15]]}\n");
    for (uint32_t k = 0; k < storeys; k++)
        jox_text_printf(
            out, "  f%u: {polygon: [[17, 2], [23, 2], [23, 22], [17, 22]], storey: s%u}\n", k, k);
    jox_text_add(out, "groups:\n");
    for (uint32_t k = 0; k < storeys; k++)
        jox_text_printf(out, "  g%u: {count: %u, in: f%u, journey: [{exit: out}]}\n", k,
                        5 + draw_whole(&d, 20), k);
    if (lifts)
        add_riders(&of_lifts, storeys, lobby, out);
}

static JoError error;

static JoScene *load_building(const JoxText *text, JoIsa isa, uint32_t threads) {
    JoSceneDef def = define_scene(write_test_file("scene.yaml", text->data));
    def.no_density = true;
    def.isa = isa;
    def.threads = threads;
    return jo_scene_load(&def, &error);
}

/* Returns whether a position is floor, or lies on the line of a seam. */
static bool is_on_floor(const JoxStoreys *s, JoxV2 at) {
    const JoxSheet *on = &s->sheets[jox_sheet_of(s, at.y)];
    const JoxV2 plan = jox_in_plan(s, at);
    bool floor = jox_is_floor(s, at);
    for (uint32_t k = on->first_seam; k < on->first_seam + on->seam_count && !floor; k++) {
        const JoxV2 nearest = jox_segment_nearest(s->seams[k].a, s->seams[k].b, plan);
        floor = jox_length(jox_sub(nearest, plan)) < 1e-3f;
    }
    return floor;
}

/* Fails if somebody is off the floor, or stepped over a wall of the building. */
static void check_people(const JoScene *scene, uint32_t building, const JoxText *text) {
    const JoWorld *w = scene->world;
    const JoxAgents *a = &w->state.agents;
    for (uint32_t i = 0; i < a->count; i++) {
        const JoxV2 at = {a->x[i], a->y[i]}, before = {a->prev_x[i], a->prev_y[i]};
        const JoxV2 plan = jox_in_plan(a->storeys, at);
        const bool inside = plan.x > 0.0f && plan.x < WIDTH && plan.y > 0.0f && plan.y < DEPTH;
        if (!inside || !is_on_floor(a->storeys, at) ||
            jox_walls_lie_between(jox_world_walls(w), before, at, NULL))
            fail_msg("building %u at %g s: agent %u at (%g, %g)\n%s", building, jo_world_time(w),
                     a->id[i], (double)at.x, (double)at.y, text->data);
    }
}

static void everybody_gets_out_of_random_buildings(void **state) {
    (void)state;
    const char *asked = getenv("JOSTLE_BUILDINGS");
    const char *from = getenv("JOSTLE_BUILDING");
    const bool all = EFFORT_EACH == 1; /* else one of two storeys, with a lift */
    const uint32_t first = from  ? (uint32_t)atoi(from)
                           : all ? 0
                                 : 3,
                   count = asked ? (uint32_t)atoi(asked)
                           : all ? 4
                                 : 1;
    uint32_t refused = 0;
    for (uint32_t b = first; b < first + count; b++) {
        JoxText text = {0};
        write_building(b, &text);
        JoScene *one = load_building(&text, JO_ISA_SCALAR, 1),
                *other = one ? load_building(&text, JO_ISA_WIDEST, 2) : NULL;
        if (!one) { /* stairs in each other's way */
            refused++;
            print_message("%s\n", error.text);
            jox_text_free(&text);
            continue;
        }
        for (int n = 0; one->world->state.agents.count && n < LONGEST * 20; n++) {
            JoxText saved = {0};
            step_scene(one, 1);
            step_scene(other, 1);
            check_people(one, b, &text);
            if (n % 97 == 0) {
                assert_true(jox_world_snapshot(other->world, &saved, &error));
                assert_true(jox_world_restore(other->world, saved.data, saved.length, &error));
                assert_true(jox_world_hash(one->world) == jox_world_hash(other->world));
            }
            jox_text_free(&saved);
        }
        if (one->world->state.agents.count)
            fail_msg("building %u: %u people are still inside\n%s", b,
                     one->world->state.agents.count, text.data);
        assert_true(jox_world_hash(one->world) == jox_world_hash(other->world));
        jo_scene_free(one);
        jo_scene_free(other);
        jox_text_free(&text);
    }
    assert_true(2 * refused <= count);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(everybody_gets_out_of_random_buildings)};
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
