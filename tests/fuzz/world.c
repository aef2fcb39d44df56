/* Makes a scene by choosing among its keys (make_scene.c), and runs it for 50 steps with one thread
   and with two: all numbers are finite, nobody crosses the wall of the hall, and the hashes are
   equal. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/fuzz.h"
#include "support/make_scene.h"

enum { STEPS = 50, CAPACITY = 4096 };

/* By an agent's id: 1 + whether it was in the hall when first seen; 0: not seen yet. */
static uint8_t side[CAPACITY];

static void check_walkers(const JoWorld *world) {
    static JoAgent agents[CAPACITY];
    const uint32_t count = jo_world_agents(world, agents, CAPACITY);
    for (uint32_t i = 0; i < count && i < CAPACITY; i++) {
        const JoAgentState a = jo_agent_state(world, agents[i]);
        FUZZ_CHECK(isfinite(a.x) && isfinite(a.y) && isfinite(a.vx) && isfinite(a.vy));
        FUZZ_CHECK(isfinite(a.fx) && isfinite(a.fy) && a.compression >= 0 && a.load >= 0);
        if (a.id >= CAPACITY)
            continue;
        const bool inside = a.x > 0 && a.x < FUZZ_HALL_X && a.y > 0 && a.y < FUZZ_HALL_Y;
        FUZZ_CHECK(!side[a.id] || side[a.id] == 1 + inside);
        side[a.id] = (uint8_t)(1 + inside);
    }
}

static void check_bodies(const JoWorld *world) {
    for (uint32_t slot = 0; slot < jo_world_body_count(world); slot++) {
        const JoBodyState b = jo_body_state(world, (JoBody){slot, 1});
        FUZZ_CHECK(isfinite(b.x) && isfinite(b.y) && isfinite(b.z) && isfinite(b.vx));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    JoxText text = {0};
    JoError error = {0}, other = {0};
    fuzz_make_scene(data, size, &text);
    if (getenv("FUZZ_SHOW"))
        puts(text.data);
    memset(side, 0, sizeof side);
    JoScene *one = fuzz_load("tests/fuzz/fuzz.yaml", text.data, 1);
    JoScene *two = one ? fuzz_load("tests/fuzz/fuzz.yaml", text.data, 2) : NULL;
    FUZZ_CHECK(!one == !two);
    bool good = one != NULL;
    for (int s = 0; good && s < STEPS; s++) {
        good = jo_scene_step(one, &error);
        FUZZ_CHECK(good == jo_scene_step(two, &other));
        FUZZ_CHECK(jo_world_hash(jo_scene_world(one)) == jo_world_hash(jo_scene_world(two)));
        if (good) {
            check_walkers(jo_scene_world(one));
            check_bodies(jo_scene_world(one));
        }
    }
    fuzz_run(one, 0);
    fuzz_run(two, 0);
    jox_text_free(&text);
    return 0;
}
