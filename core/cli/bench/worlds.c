/* Times many small worlds, as a game would step them: in each, a few people run after a ball. The
   worlds are stepped in turn, first without clocks, for the whole time, then with them, for the
   stages. */
#include <math.h>

#include "base/clock.h"
#include "base/mem.h"
#include "cli/bench/bench.h"

static const double SPACING = 0.7; /* m: initial distance of people */
enum { STEPS_A_WAY = 10 };         /* steps until people turn again */

typedef struct Worlds {
    JoWorld **worlds;
    JoBody *balls;
    uint32_t count;
} Worlds;

static JoWorld *create_bench_world(const BenchWorlds *def, JoIsa isa, uint32_t number, JoBody *ball,
                                   JoError *error) {
    JoWorldDef world_def = jo_default_world_def();
    world_def.seed = number;
    world_def.isa = isa;
    JoWorld *world = jo_world_create(&world_def, error);
    if (!world)
        return NULL;
    JoBodyDef body = jo_default_body_def();
    body.shape = JO_SPHERE;
    body.size[0] = 0.11;
    body.mass = 0.4;
    body.x = -1.0;
    body.y = 0.1 * (number % 7);
    body.z = 0.11;
    body.restitution = 0.7;
    *ball = jo_world_add_body(world, &body, error);
    bool good = ball->generation != 0;
    for (uint32_t k = 0; good && k < def->people; k++) {
        JoAgentDef agent = jo_default_agent_def();
        agent.x = SPACING * (k % 5);
        agent.y = SPACING * (k / 5);
        good = jo_world_add_agent(world, &agent, error).generation != 0;
    }
    if (good)
        return world;
    jo_world_free(world);
    return NULL;
}

static void free_worlds(Worlds *w) {
    for (uint32_t k = 0; k < w->count; k++)
        jo_world_free(w->worlds[k]);
    jox_free(w->worlds);
    jox_free(w->balls);
}

/* Sets the preferred velocity of all people towards the ball. */
static void turn_to_ball(JoWorld *world, JoBody ball) {
    JoAgent agents[BENCH_MOST_PEOPLE];
    const JoBodyState at = jo_body_state(world, ball);
    const uint32_t count = jo_world_agents(world, agents, BENCH_MOST_PEOPLE);
    for (uint32_t k = 0; k < count; k++) {
        const JoAgentState a = jo_agent_state(world, agents[k]);
        const double away = 0.1 + fabs(at.x - a.x) + fabs(at.y - a.y);
        jo_agent_set_preferred(world, agents[k], 1.5 * (at.x - a.x) / away,
                               1.5 * (at.y - a.y) / away);
    }
}

/* Steps all worlds; adds the time of the steps, s, without that of turning. */
static void step_all_worlds(const Worlds *w, uint64_t steps, double *cpu, double *wall) {
    for (uint64_t done = 0; done < steps; done += STEPS_A_WAY) {
        for (uint32_t k = 0; k < w->count; k++)
            turn_to_ball(w->worlds[k], w->balls[k]);
        const double cpu_begun = jox_clock_cpu(), wall_begun = jox_clock_wall();
        for (uint64_t s = done; s < steps && s < done + STEPS_A_WAY; s++)
            for (uint32_t k = 0; k < w->count; k++)
                jo_world_step(w->worlds[k], 1);
        *cpu += jox_clock_cpu() - cpu_begun;
        *wall += jox_clock_wall() - wall_begun;
    }
}

/* Sums the statistics of all worlds; agents and bodies are those of one world. */
static JoStats sum_statistics(const Worlds *w) {
    JoStats sum = jo_world_stats(w->worlds[0]);
    for (uint32_t k = 1; k < w->count; k++) {
        const JoStats stats = jo_world_stats(w->worlds[k]);
        sum.steps += stats.steps;
        sum.agent_steps += stats.agent_steps;
        for (int s = 0; s < JO_STAGE_COUNT; s++)
            sum.stage_ns[s] += stats.stage_ns[s];
        sum.bullet_ns += stats.bullet_ns;
        sum.objects_ns += stats.objects_ns;
        sum.enter_ns += stats.enter_ns;
        sum.leave_ns += stats.leave_ns;
    }
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        sum.stage_ns[s] /= w->count;
    sum.bullet_ns /= w->count;
    sum.objects_ns /= w->count;
    sum.enter_ns /= w->count;
    sum.leave_ns /= w->count;
    return sum;
}

int bench_worlds(const BenchWorlds *def, const BenchGiven *given, BenchCase *c, JoError *error) {
    Worlds w = {.worlds = jox_alloc(def->worlds, sizeof *w.worlds),
                .balls = jox_alloc(def->worlds, sizeof *w.balls)};
    bool good = true;
    double cpu = 0.0, wall = 0.0, unused[2] = {0.0, 0.0};
    for (uint32_t k = 0; good && k < def->worlds; k++) {
        w.worlds[k] = create_bench_world(def, c->isa, k, &w.balls[k], error);
        good = w.worlds[k] != NULL;
        w.count += good;
    }
    if (good) {
        step_all_worlds(&w, given->warm_up, &unused[0], &unused[1]);
        step_all_worlds(&w, given->steps, &cpu, &wall);
        for (uint32_t k = 0; k < w.count; k++)
            jo_world_set_timed(w.worlds[k], true);
        JoStats from = sum_statistics(&w);
        step_all_worlds(&w, given->steps, &unused[0], &unused[1]);
        JoStats to = sum_statistics(&w);
        from.cpu_s = from.wall_s = 0.0;
        to.cpu_s = cpu;
        to.wall_s = wall;
        c->others[c->measured] = -1.0;
        bench_note(c, &from, &to, wall, cpu);
    }
    free_worlds(&w);
    return good ? JO_OK : (int)error->code;
}
