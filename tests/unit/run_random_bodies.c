/* Runs random small scenes of people and bodies of any mass, size and speed that definitions allow:
 * no assertion fails, and all numbers stay finite. JOSTLE_MASSES: count of scenes;
 * JOSTLE_MASSES_FROM: number of the first one. */
#include <math.h>

#include "base/number/random.h"
#include "body/body.h"
#include "unit/scene_loader.h"

enum { SCENES = 40, STEPS = 200, MOST_BODIES = 9 };

typedef struct Mix {
    uint64_t number;
    uint32_t drawn;
    JoxText yaml, lua;
} Mix;

/* Number of the running scene, for the message of a failed assertion. */
static uint64_t running;

static double draw_uniform_number(Mix *m, double low, double high) {
    return low + (high - low) * jox_random_unit(m->number, m->drawn++, 0, JOX_DRAW_FILL, 0);
}

/* Draws a number whose logarithm is uniform between two bounds. */
static double draw_magnitude(Mix *m, double low, double high) {
    return exp(draw_uniform_number(m, log(low), log(high)));
}

static bool draw_outcome(Mix *m, double share) {
    return draw_uniform_number(m, 0.0, 1.0) < share;
}

/* ---- scenes ---- */

/* Draws a speed along an axis, m/s: mostly up to that of throws and vehicles, sometimes the
 * greatest. */
static double draw_speed(Mix *m) {
    const double most = draw_outcome(m, 0.2) ? 100.0 : draw_outcome(m, 0.5) ? 10.0 : 1.0;
    return draw_uniform_number(m, -most, most);
}

/* Draws a length, m: from a tenth of a size to `most` times it. */
static double draw_length(Mix *m, double size, double most) {
    return fmax(0.02, size * draw_magnitude(m, 0.1, most));
}

/* Adds one number; one a call, as compilers choose the order in which arguments are evaluated. */
static void add_drawn_number(Mix *m, const char *format, double number) {
    jox_text_printf(&m->yaml, format, number);
}

static void write_solid(Mix *m, double size) {
    switch ((int)draw_uniform_number(m, 0.0, 4.0)) {
    case 0:
        add_drawn_number(m, "{sphere: {radius: %.4g}}", size / 2.0);
        break;
    case 1:
        add_drawn_number(m, "{cylinder: {radius: %.4g, ", size / 2.0);
        add_drawn_number(m, "height: %.4g}}", draw_length(m, size, 3.0));
        break;
    case 2:
        add_drawn_number(m, "{hull: {points: [[-%.4g, 0, 0], ", size);
        add_drawn_number(m, "[%.4g, 0.01, 0], ", size);
        add_drawn_number(m, "[0, %.4g, 0], ", draw_length(m, size, 2.0));
        add_drawn_number(m, "[0, 0, %.4g]]}}", draw_length(m, size, 2.0));
        break;
    default:
        add_drawn_number(m, "{box: {size: [%.4g, ", size);
        add_drawn_number(m, "%.4g, ", draw_length(m, size, 10.0));
        add_drawn_number(m, "%.4g]}}", draw_length(m, size, 3.0));
    }
}

static void write_shape(Mix *m, double size) {
    const double kind = draw_uniform_number(m, 0.0, 1.0);
    jox_text_add(&m->yaml, "shape: ");
    if (kind < 0.2) {
        add_drawn_number(m, "{blocks: {size: [%.4g, ", size);
        add_drawn_number(m, "%.4g, ", size);
        add_drawn_number(m, "%.4g], ", draw_length(m, size, 1.0));
        add_drawn_number(m, "count: [%.0f, 1, 3], ", ceil(draw_uniform_number(m, 0.0, 4.0)));
        add_drawn_number(m, "bond: %.4g}}", draw_magnitude(m, 1e-3, 1e9));
    } else if (kind < 0.3) {
        jox_text_add(&m->yaml, "{compound: [{shape: ");
        write_solid(m, size);
        add_drawn_number(m, ", mass: %.4g}, ", draw_magnitude(m, 1e-3, 1e7));
        add_drawn_number(m, "{at: [%.4g, 0, 0.1], shape: ", size);
        write_solid(m, size / 2.0);
        jox_text_add(&m->yaml, "}]}");
    } else {
        write_solid(m, size);
    }
}

static void write_driven(Mix *m) {
    add_drawn_number(m, ", kinematic: true, force_limit: %.4g, path: {through: [",
                     draw_magnitude(m, 1.0, 1e6));
    add_drawn_number(m, "[%.3f, ", draw_uniform_number(m, -4.0, 4.0));
    add_drawn_number(m, "%.3f, 1], [0, 0, 1]], end: round, ", draw_uniform_number(m, -4.0, 4.0));
    add_drawn_number(m, "speed: %.4g, ", draw_magnitude(m, 1e-2, 100.0));
    jox_text_printf(&m->yaml, "reopens: %s}", draw_outcome(m, 0.3) ? "true" : "false");
}

static void write_free(Mix *m) {
    add_drawn_number(m, ", mass: %.4g",
                     draw_magnitude(m, 2e-8, 1e7)); /* shared by up to 12 blocks */
    add_drawn_number(m, ", velocity: [%.4g, ", draw_speed(m));
    add_drawn_number(m, "%.4g, ", draw_speed(m));
    add_drawn_number(m, "%.4g], ", draw_speed(m) / 4.0);
    add_drawn_number(m, "spin: [0, %.4g, ", draw_speed(m));
    add_drawn_number(m, "%.4g]", draw_speed(m));
}

/* Places bodies in cells of their own, so that none overlaps another at the start. */
static void write_body(Mix *m, int cell) {
    jox_text_printf(&m->yaml, "  - {name: b%d, tags: [thing], at: [%d, %d, 1.2], ", cell,
                    3 * (cell % 3) - 3, 3 * (cell / 3) - 3);
    write_shape(m, draw_magnitude(m, 0.041, 0.6));
    add_drawn_number(m, ", friction: %.3g", draw_uniform_number(m, 0.0, 3.0));
    add_drawn_number(m, ", restitution: %.3g",
                     draw_outcome(m, 0.5) ? 0.0 : draw_uniform_number(m, 0.0, 1.0));
    if (draw_outcome(m, 0.2))
        write_driven(m);
    else
        write_free(m);
    jox_text_add(&m->yaml, "}\n");
}

static void write_mix_scene(Mix *m) {
    static const double TIMES[] = {0.01, 0.05, 0.1};
    m->yaml.length = 0;
    jox_text_printf(&m->yaml,
                    "jostle: 1\nstep: %g\nguard: {people: remove, bodies: remove}\n"
                    "places: {out: {point: [0, 0], radius: 0.5}}\n"
                    "walls: [{line: [[-5, -5], [5, -5], [5, 5], [-5, 5]], closed: true}]\n"
                    "bodies:\n",
                    TIMES[m->number % 3]);
    const int count = 1 + (int)draw_uniform_number(m, 0.0, MOST_BODIES);
    for (int cell = 0; cell < count; cell++)
        write_body(m, cell);
    jox_text_add(&m->yaml, "groups: {people: {behaviour: own.lua, at: [[-4.5, -4.5]");
    for (int n = 0; n < 16; n++)
        jox_text_printf(&m->yaml, ", [%.2f, %.2f]", 1.1 * (n % 8) - 4.0, n < 8 ? -1.5 : 1.5);
    jox_text_add(&m->yaml, "]}}\n");
}

/* Writes a behaviour that takes and throws bodies in reach, and sometimes holds other agents. */
static void write_mix_behaviour(Mix *m) {
    const double speed = draw_uniform_number(m, 0.5, 8.0), push = draw_magnitude(m, 1.0, 5e3);
    const double spread = draw_uniform_number(m, 0.0, 1.5),
                 kick = draw_uniform_number(m, 0.0, 30.0),
                 thrown = draw_uniform_number(m, 0.1, 40.0);
    m->lua.length = 0;
    jox_text_printf(
        &m->lua,
        "local thing, other = nearest \"thing\", nearest \"anyone\"\n" MACHINE_START "\"Fetch\",\n"
        "  defaults = { speed = %.3g, max_speed = %.3g, perception = 6, push = %.4g,\n"
        "    radius = uniform(0.05, 0.35), mass = lognormal(4.2, %.3g, 1, 10000) },\n"
        "  states = {\n"
        "    Fetch = { steer = seek(thing), approach = thing, take = thing,\n"
        "      kick = { thing, at = \"out\", impulse = %.4g },\n"
        "      { to = \"Throw\", when = has(thing) & after(0.5) },\n"
        "      { to = \"Hold\", when = after(4) } },\n"
        "    Throw = { steer = hold, throw = { thing, at = \"out\", speed = %.4g },\n"
        "      { to = \"Fetch\", when = after(0.2) } },\n"
        "    Hold = { steer = seek \"out\", grasp = other, { to = \"Fetch\", when = after(2) } } } "
        "}\n",
        speed, 1.2 * speed, push, spread, kick, thrown);
}

/* Adds bodies heavier than scenes allow, by calls. */
static void add_heavy_bodies(Mix *m, JoWorld *world) {
    const int count = (int)draw_uniform_number(m, 0.0, 4.0);
    for (int n = 0; n < count; n++) {
        JoError error = {0};
        JoBodyDef def = jo_default_body_def();
        def.shape = (JoShape)draw_uniform_number(m, 0.0, 3.0);
        for (int k = 0; k < 3; k++)
            def.size[k] = draw_magnitude(m, 0.02, 0.8);
        def.mass =
            draw_outcome(m, 0.5) ? draw_magnitude(m, 1e7, 1e9) : draw_magnitude(m, 1e-9, 1e-3);
        def.x = 2.0 * n - 3.0;
        def.y = n % 2 ? 4.2 : -4.2;
        def.z = 0.5;
        def.vx = draw_speed(m);
        def.vy = draw_speed(m);
        jo_world_add_body(world, &def, &error); /* refused if moments of inertia overflow a float */
    }
}

/* ---- runs ---- */

static void end_at_assertion(const char *condition, const char *file, int line) {
    print_message("scene %llu: %s:%d: %s\n", (unsigned long long)running, file, line, condition);
    abort();
}

static void check_body_motion(const Mix *m, const JoWorld *world) {
    for (uint32_t slot = 0; slot < jo_world_body_count(world); slot++) {
        const JoBodyState b = jo_body_state(world, jo_world_body_at(world, slot));
        if (!isfinite(b.x + b.y + b.z) || !isfinite(b.vx + b.vy + b.vz))
            fail_msg("scene %llu: body %u has a number that is not finite",
                     (unsigned long long)m->number, slot);
    }
}

/* Sums over all scenes. */
typedef struct Sums {
    uint64_t contacts, throws, kicks, broken, held_up, people_lost, bodies_lost;
} Sums;

static void add_figures(Sums *all, const JoxStatistics *s) {
    all->contacts += s->exchange.contacts;
    all->throws += s->throws;
    all->kicks += s->kicks;
    all->broken += s->bonds.broken;
    all->held_up += s->drives.held_up;
    all->people_lost += s->people_lost;
    all->bodies_lost += s->bodies_lost;
}

static void run_mix(Mix *m, Sums *all) {
    running = m->number;
    m->drawn = 0;
    write_mix_scene(m);
    write_mix_behaviour(m);
    JoScene *scene = load_scene_text(m->yaml.data, m->lua.data);
    add_heavy_bodies(m, scene->world);
    for (int n = 0; n < STEPS; n++) {
        step_scene(scene, 1);
        const char *fault = jox_world_find_fault(scene->world);
        if (fault)
            fail_msg("scene %llu, step %d: %s", (unsigned long long)m->number, n, fault);
        check_body_motion(m, scene->world);
    }
    add_figures(all, &scene->world->state.statistics);
    jo_scene_free(scene);
}

static void bodies_of_any_mass_meet_people(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    const char *wanted = getenv("JOSTLE_MASSES"), *from = getenv("JOSTLE_MASSES_FROM");
    const uint64_t scenes = wanted ? strtoull(wanted, NULL, 10) : SCENES;
    const uint64_t first = from ? strtoull(from, NULL, 10) : 0;
    Mix *m = jox_alloc(1, sizeof *m);
    Sums all = {0};
    jo_set_assert_handler(end_at_assertion);
    for (m->number = first; m->number < first + scenes; m->number++)
        run_mix(m, &all);
    jo_set_assert_handler(NULL);
    print_message(
        "  contacts %llu, throws %llu, kicks %llu, bonds broken %llu, drives held up %llu, "
        "lost: people %llu, bodies %llu\n",
        (unsigned long long)all.contacts, (unsigned long long)all.throws,
        (unsigned long long)all.kicks, (unsigned long long)all.broken,
        (unsigned long long)all.held_up, (unsigned long long)all.people_lost,
        (unsigned long long)all.bodies_lost);
    assert_true(all.contacts > 10 * scenes && all.throws > scenes && all.kicks > scenes);
    assert_true(all.broken > scenes / 4 && all.held_up > scenes / 4);
    jox_text_free(&m->yaml);
    jox_text_free(&m->lua);
    jox_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_of_any_mass_meet_people),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
