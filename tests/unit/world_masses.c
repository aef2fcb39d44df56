/* Bodies as heavy, light and fast as definitions allow meet people: what is given and taken agrees
   within rounding, and no assertion is in the way. */
#include "unit/world_meeting.h"

/* Makes a world with a ball that hits an agent, and a box that an agent leans on. */
static JoWorld *meet(double mass, double speed) {
    JoWorld *world = create_world();
    for (int n = 0; n < 2; n++) {
        const JoAgent person = add_person(world, 3, 4 * n, n ? 300 : 0);
        jo_agent_set_preferred(world, person, -1, 0);
        JoBodyDef body = jo_default_body_def();
        body.shape = n ? JO_BOX : JO_SPHERE;
        body.size[0] = n ? 1 : 0.5;
        body.mass = mass;
        body.y = 4 * n;
        body.x = n ? 2.2 : -1;
        body.vx = n ? speed / 10 : speed;
        add_body(world, &body);
    }
    return world;
}

static void heavy_bodies_exchange_equal_impulses(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    const double masses[] = {1e-9, 1e-3, 1, 1e5, 1e6, 1e7, 1e9}, speeds[] = {0.1, 10, 30, 100};
    for (size_t m = 0; m < sizeof masses / sizeof *masses; m++)
        for (size_t s = 0; s < sizeof speeds / sizeof *speeds; s++) {
            JoWorld *world = meet(masses[m], speeds[s]);
            jo_world_step(world, 60);
            const JoxExchange *exchange = &world->state.statistics.exchange;
            const double rounding = 1e-5 * masses[m] * speeds[s] * (1 + exchange->contacts);
            assert_null(jo_world_failure(world));
            if (masses[m] >= 1 && /* lighter bodies get clamped impulses, which count as residual */
                !(exchange->residual <= 0.1 + 1e-3 * exchange->impulse + rounding))
                fail_msg("%g kg at %g m/s: %g of %g N s", masses[m], speeds[s], exchange->residual,
                         exchange->impulse);
            jo_world_free(world);
        }
}

static void too_light_bodies_are_refused(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoError error = {0};
    JoWorld *world = create_world();
    JoBodyDef body = jo_default_body_def();
    body.mass = 1e-30;
    assert_int_equal(jo_world_add_body(world, &body, &error).generation, 0);
    assert_non_null(strstr(error.text, "1e-9 kg and more"));
    jo_world_free(world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heavy_bodies_exchange_equal_impulses),
        cmocka_unit_test(too_light_bodies_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
