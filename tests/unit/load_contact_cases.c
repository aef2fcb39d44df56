/* Contacts add no energy in a few encounters made by hand. */
#include "unit/load_energy.h"

/* A box of 20 kg at 1 m/s has 10 J; a person of 70 kg that it hits gets at most 2 x 20 / 90 m/s.
   The person does not see the box, or sees it too late: it starts overlapping them. A person who
   then walks ahead of it does muscle work, so growth counts only while they touch. */
static void unseen_box_adds_no_energy(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    for (int k = 0; k < 8; k++) {
        Encounter e = {0};
        JoWorldDef def = jo_default_world_def();
        def.dt = STEPS[k % 4];
        def.gravity = 0.0;
        e.world = jo_world_create(&def, NULL);
        JoBodyDef box = jo_default_body_def();
        box.size[0] = box.size[1] = 0.5;
        box.size[2] = 1.0;
        box.mass = 20.0;
        box.friction = 0.0;
        box.x = k < 4 ? -0.8 : -0.35; /* or overlapping the person by 10 cm */
        box.vx = 1.0;
        jo_world_add_body(e.world, &box, NULL);
        JoAgentDef person = jo_default_agent_def();
        person.perception = k < 4 ? 0.0 : 3.0;
        JoAgent one = add_person(&e, person, 0.0, 0.0);
        double fastest = 0.0;
        for (int step = 0; step < (int)(2.0 / def.dt); step++) {
            Growth g = watch_energy(&e, def.dt, false);
            JoAgentState s = jo_agent_state(e.world, one);
            fastest = fmax(fastest, hypot(s.vx, s.vy));
            bool touches = e.world->state.agents.contacts[jox_world_find_agent(e.world, one)] > 0;
            if (g.step > TIPS && (touches || k < 4))
                fail_msg("at dt %g, perception %g: %.3g of 10 J is added at %.3f s; the person "
                         "goes at %.3f m/s",
                         def.dt, person.perception, g.step * g.energy / 10.0,
                         jo_world_time(e.world), hypot(s.vx, s.vy));
        }
        if (fastest > 0.45 || fastest < 0.05)
            fail_msg("at dt %g the person goes at %.3f m/s", def.dt, fastest);
        jo_world_free(e.world);
    }
}

/* Two people who perceive nothing run into each other: they do not pass through, and soon part. */
static void contact_needs_no_perception(void **state) {
    (void)state;
    for (int k = 0; k < 4; k++) {
        Encounter e = {.coasting = true};
        JoWorldDef world = jo_default_world_def();
        world.dt = STEPS[k];
        e.world = jo_world_create(&world, NULL);
        JoAgentDef def = jo_default_agent_def();
        def.perception = 0.0;
        def.x = -1.0;
        JoAgent a = add_person(&e, def, 1.5, 0.0);
        def.x = 1.0;
        JoAgent b = add_person(&e, def, -1.5, 0.0);
        double gap = 2.0;
        for (int step = 0; step < (int)(3.0 / world.dt); step++) {
            watch_energy(&e, world.dt, false);
            gap = jo_agent_state(e.world, b).x - jo_agent_state(e.world, a).x;
            if (gap < 0.2)
                fail_msg("at dt %g they are %.3f m apart at %.2f s", world.dt, gap,
                         jo_world_time(e.world));
        }
        if (gap < 0.95 * 0.4)
            fail_msg("at dt %g they stay in each other, %.3f m apart", world.dt, gap);
        jo_world_free(e.world);
    }
}

/* People who see each other and a body, all at rest, some overlapping: there is nothing to avoid,
   and contact and overlap move nobody. */
static void people_at_rest_stay_at_rest(void **state) {
    (void)state;
    for (uint64_t number = 0; number < 200; number++) {
        Encounter e = {0};
        JoWorldDef world = jo_default_world_def();
        world.dt = STEPS[number % 4];
        world.gravity = 0.0;
        e.world = jo_world_create(&world, NULL);
        if (jox_bodies_available()) {
            JoBodyDef box = jo_default_body_def();
            box.size[0] = box.size[1] = 0.4;
            box.size[2] = 1.0;
            box.mass = draw_between(number, 1, 1.0, 200.0);
            box.x = 0.6;
            jo_world_add_body(e.world, &box, NULL);
        }
        for (uint32_t i = 0; i < 4; i++) {
            JoAgentDef def = jo_default_agent_def();
            def.x = 2.0 * i;
            add_person(&e, def, 0.0, 0.0);
        }
        JoxAgents *a = &e.world->state.agents;
        for (uint32_t i = 0; i < 4; i++) {
            a->x[i] = (float)draw_between(number, 10 + i, -0.5, 0.5);
            a->y[i] = (float)draw_between(number, 20 + i, -0.5, 0.5);
        }
        jox_nav_invalidate_order(e.world->scratch.nav);
        Growth g = watch_energy(&e, 2.0, false);
        if (g.step > GROWS || g.all > GROWS)
            fail_msg("number %u, at dt %g: a step adds %.3g J, and %.3g J in all", (unsigned)number,
                     world.dt, g.step, g.all);
        jo_world_free(e.world);
    }
}

/* 36 people who prefer to stand, and take no steps back, start at 1.5 m/s in a closed room: they
   only slow down. */
static void crowd_that_prefers_rest_only_slows(void **state) {
    (void)state;
    for (int k = 0; k < 8; k++) {
        Encounter e = {0};
        JoWorldDef world = jo_default_world_def();
        world.dt = STEPS[k % 4];
        e.world = jo_world_create(&world, NULL);
        const double room[] = {0, 0, 3, 0, 3, 3, 0, 3, 0, 0};
        jo_world_add_line(e.world, room, 5, NULL);
        for (uint32_t i = 0; i < 36; i++) {
            JoAgentDef def = jo_default_agent_def();
            def.perception = k < 4 ? 0.0 : 3.0;
            def.x = 0.3 + 0.48 * (i % 6);
            def.y = 0.3 + 0.48 * (i / 6);
            double way = TURN * draw_unit(77, i);
            add_person(&e, def, 1.5 * cos(way), 1.5 * sin(way));
        }
        Growth g = watch_energy(&e, 4.0, false);
        if (g.step > GROWS || g.all > GROWS)
            fail_msg("at dt %g, perception %g: a step adds %.3g of the first %.0f J, and it passes "
                     "the start by %.3g",
                     world.dt, k < 4 ? 0.0 : 3.0, g.step, g.energy, g.all);
        jo_world_free(e.world);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contact_needs_no_perception),
        cmocka_unit_test(unseen_box_adds_no_energy),
        cmocka_unit_test(crowd_that_prefers_rest_only_slows),
        cmocka_unit_test(people_at_rest_stay_at_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
