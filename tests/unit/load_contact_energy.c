/* Contacts add no energy and no momentum in 10,000 random encounters of people, boxes and balls.
   With the number of an encounter as its argument the program prints the energy at every step of
   that encounter; with a second argument, of its bodies without its people. */
#include "unit/effort.h"
#include "unit/load_energy.h"

enum { ENCOUNTERS = 10000, KINDS = 4 };
static const double DRIFTS = 1e-5; /* drift allowed, relative to the sum of all |momenta| */
/* The same where plans press on bodies, which bear within the tolerance of the solve, without
   feeling it. */
static const double BORNE = 1e-3;
static const double SECONDS = 1.2;

/* Coasting people prefer the velocity that they have, so that their muscles do no work. That holds
   at time steps of 0.05 s; at finer ones people keep a plan that is up to 0.05 s old, which is
   muscle work, so there only the changes that contacts and bodies make are counted. Seeing people
   transfer forces to others (equations 8 and 9), but avoid nobody, which would be muscle work;
   avoidance is tested in load_contact_cases.c. */
typedef enum Kind { COASTING, BLIND, BLIND_IN_ROOM, SEEING } Kind;
static const char *const kind_names[KINDS] = {
    "coasting, perception 0, no damping", "at rest by wish, perception 0", "the same between walls",
    "at rest by wish, perception 3, avoiding nobody, between walls"};

static void avoid_nobody(Encounter *e, JoAgent who) {
    JoxAgents *a = &e->world->state.agents;
    uint32_t i = jox_world_find_agent(e->world, who);
    a->tags[i] = a->ignore[i] = 1;
}

/* Adds people near the centre, most of whom move towards it; some overlap others deeply. */
static void add_people(Encounter *e, uint64_t number, Kind kind) {
    uint32_t count = 2 + (uint32_t)(3.0 * draw_unit(number, 1));
    double within = draw_unit(number, 2) < 0.5 ? 0.35 : 0.9;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t own = 100 + 20 * i;
        double angle = TURN * draw_unit(number, own),
               far = within * sqrt(draw_unit(number, own + 1));
        double speed = draw_between(number, own + 2, 0.0, 2.5) * (draw_unit(number, own + 3) < 0.8);
        speed *= draw_unit(number, 22) > 0.15; /* else all rest, overlapping each other */
        double way = angle + TURN / 2 + draw_between(number, own + 4, -1.0, 1.0);
        JoAgentDef def = jo_default_agent_def();
        def.x = far * cos(angle);
        def.y = far * sin(angle);
        def.radius = draw_between(number, own + 5, 0.15, 0.3);
        def.mass = draw_between(number, own + 6, 40.0, 100.0);
        def.max_speed = 20.0;
        def.perception = kind == SEEING ? 3.0 : 0.0;
        JoAgent one = add_person(e, def, speed * cos(way), speed * sin(way));
        if (kind == SEEING)
            avoid_nobody(e, one);
    }
    if (draw_unit(number, 3) < 0.75)
        return;
    JoxAgents *a = &e->world->state.agents;
    for (uint32_t i = 1; i < a->count; i++) {
        a->x[i] += (a->x[0] - a->x[i]) * (float)draw_between(number, 100 + 20 * i + 7, 0.0, 0.9);
        a->y[i] += (a->y[0] - a->y[i]) * (float)draw_between(number, 100 + 20 * i + 8, 0.0, 0.9);
    }
    jox_nav_invalidate_order(e->world->scratch.nav);
}

/* Adds up to two bodies, one on either side, so that they do not overlap. */
static void add_things(Encounter *e, uint64_t number, Kind kind) {
    uint32_t count = (uint32_t)(3.0 * draw_unit(number, 10));
    for (uint32_t i = 0; i < count; i++) {
        uint32_t own = 200 + 20 * i;
        double side = i ? 1.0 : -1.0, way = TURN * draw_unit(number, own);
        double speed = draw_between(number, own + 1, 0.0, 2.0) * (draw_unit(number, own + 2) < 0.8);
        speed *= draw_unit(number, 22) > 0.15;
        JoBodyDef def = jo_default_body_def();
        def.shape = (JoShape)(3.0 * draw_unit(number, own + 3));
        def.size[0] = draw_between(number, own + 4, 0.1, 0.3);
        def.size[1] = def.size[2] = draw_between(number, own + 5, 0.4, 1.4);
        if (def.shape == JO_BOX) {
            def.size[0] *= 2.0;
            def.size[1] = draw_between(number, own + 6, 0.2, 0.6);
        }
        def.z = def.shape == JO_SPHERE ? def.size[0] : 0.5 * def.size[2];
        def.mass = pow(200.0, draw_unit(number, own + 7));
        def.x = side * draw_between(number, own + 8, 0.45, 0.8);
        def.y = draw_between(number, own + 9, -0.3, 0.3);
        def.turn = TURN * draw_unit(number, own + 10);
        def.vx = speed * cos(way);
        def.vy = speed * sin(way);
        def.friction = kind != COASTING && draw_unit(number, own + 11) < 0.5 ? 0.6 : 0.0;
        JoError error;
        JoBody body = jo_world_add_body(e->world, &def, &error);
        if (!body.generation)
            fail_msg("%s", error.text);
        JoxV3 spin = {0.0f, 0.0f, (float)draw_between(number, own + 12, -3.0, 3.0)};
        if (draw_unit(number, 22) > 0.15 && draw_unit(number, own + 13) < 0.5)
            jox_bodies_set_velocity(e->world->state.bodies, body.slot,
                                    (JoxV3){(float)def.vx, (float)def.vy, 0.0f}, spin);
    }
}

static Encounter open_encounter(uint64_t number, bool people) {
    Kind kind = (Kind)(number % KINDS);
    Encounter e = {.coasting = kind == COASTING, .later = kind == SEEING};
    JoWorldDef def = jo_default_world_def();
    /* A step of 0.1 s is done in two: in the second, coasting people would prefer an old
       velocity. */
    def.dt = STEPS[(uint32_t)draw_between(number, 20, kind == COASTING ? 1.0 : 0.0, 4.0)];
    def.seed = number;
    def.gravity =
        draw_unit(number, 21) < 0.5 ? 0.0 : 9.81; /* without gravity all energy is kinetic */
    e.world = jo_world_create(&def, NULL);
    const double line[] = {-2.0, -1.2, 2.0, -1.2};
    const double block[] = {-2.0, 1.2, 2.0, 1.2, 2.0, 2.0, -2.0, 2.0};
    if (kind == BLIND_IN_ROOM || kind == SEEING) {
        jo_world_add_line(e.world, line, 2, NULL);
        jo_world_add_solid(e.world, block, 4, NULL);
    }
    if (jox_bodies_available() && kind != SEEING) /* seeing people avoid bodies */
        add_things(&e, number, kind);
    uint32_t things = jo_world_body_count(e.world);
    e.rough = things > 1 || (things > 0 && (def.gravity != 0.0 || kind >= BLIND_IN_ROOM));
    if (people)
        add_people(&e, number, kind);
    return e;
}

static Growth run_encounter(uint64_t number, bool people, bool print) {
    Encounter e = open_encounter(number, people);
    Growth g = watch_energy(&e, SECONDS, print);
    jo_world_free(e.world);
    return g;
}

/* Runs the encounters of one kind; prints how many gain energy or momentum, and the worst. */
static bool run_kind(Kind kind, bool people) {
    uint32_t count = 0, grow = 0, above = 0, drift = 0;
    uint64_t worst = 0, highest = 0, farthest = 0;
    Growth most = {0};
    for (uint64_t number = kind; number < ENCOUNTERS; number += KINDS * EFFORT_EACH, count++) {
        Growth g = run_encounter(number, people, false);
        grow += g.step > (g.things ? TIPS : GROWS);
        above += g.all > GROWS;
        drift += g.momentum > (g.things ? BORNE : DRIFTS);
        worst = g.step > most.step ? number : worst;
        highest = g.all > most.all ? number : highest;
        farthest = g.momentum > most.momentum ? number : farthest;
        most.step = fmax(most.step, g.step);
        most.all = fmax(most.all, g.all);
        most.momentum = fmax(most.momentum, g.momentum);
    }
    print_message("  %s: of %u, %u gain energy in a step (at most %.2g of the first, number %u), "
                  "%u end or pass above the start (at most %.2g, number %u)\n",
                  kind_names[kind], count, grow, most.step, (unsigned)worst, above, most.all,
                  (unsigned)highest);
    if (kind == COASTING)
        print_message("  %u lose or gain momentum (at most %.2g, number %u)\n", drift,
                      most.momentum, (unsigned)farthest);
    return !grow && !above && !(kind == COASTING && drift);
}

static void coasting_people_keep_momentum_and_gain_no_energy(void **state) {
    (void)state;
    assert_true(run_kind(COASTING, true));
}
static void blind_people_gain_no_energy(void **state) {
    (void)state;
    assert_true(run_kind(BLIND, true));
}
static void blind_people_between_walls_gain_no_energy(void **state) {
    (void)state;
    assert_true(run_kind(BLIND_IN_ROOM, true));
}
static void seeing_people_gain_no_energy(void **state) {
    (void)state;
    assert_true(run_kind(SEEING, true));
}
/* Bodies without people stay within the bounds, too: growth in the other tests comes from
   people. */
static void bodies_alone_gain_no_energy(void **state) {
    (void)state;
    bool good = true;
    for (int kind = 0; kind < KINDS; kind++)
        good &= run_kind((Kind)kind, false);
    assert_true(good);
}

int main(int argc, char **argv) {
    if (argc > 1) {
        Growth g = run_encounter(strtoull(argv[1], NULL, 10), argc == 2, true);
        printf("grows by %.3g in a step, %.3g in all; momentum drifts by %.3g\n", g.step, g.all,
               g.momentum);
        return 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_alone_gain_no_energy),
        cmocka_unit_test(coasting_people_keep_momentum_and_gain_no_energy),
        cmocka_unit_test(blind_people_gain_no_energy),
        cmocka_unit_test(blind_people_between_walls_gain_no_energy),
        cmocka_unit_test(seeing_people_gain_no_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
