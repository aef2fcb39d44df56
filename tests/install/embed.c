/* A program of its own that uses the installed library: two people meet head on. */
#include <math.h>
#include <stdio.h>

#include <jostle.h>

int main(void) {
    JoError error = {0};
    JoWorldDef def = jo_default_world_def();
    def.dt = 0.1;
    JoWorld *world = jo_world_create(&def, &error);
    if (!world) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    const double wall[] = {-5, 2, 5, 2};
    jo_world_add_line(world, wall, 2, &error);

    JoAgent people[2];
    for (int i = 0; i < 2; i++) {
        JoAgentDef agent = jo_default_agent_def();
        agent.x = i ? 4 : -4;
        agent.y = i ? 0.05 : 0;
        people[i] = jo_world_add_agent(world, &agent, &error);
        jo_agent_set_preferred(world, people[i], i ? -1.3 : 1.3, 0);
    }
    double nearest = INFINITY;
    for (int step = 0; step < 80; step++) {
        jo_world_step(world, 1);
        JoAgentState a = jo_agent_state(world, people[0]), b = jo_agent_state(world, people[1]);
        nearest = fmin(nearest, hypot(a.x - b.x, a.y - b.y));
    }
    JoAgentState a = jo_agent_state(world, people[0]);
    printf("after %.1f s: x = %.2f m, nearest %.2f m, hash %016llx\n", jo_world_time(world), a.x,
           nearest, (unsigned long long)jo_world_hash(world));
    jo_world_free(world);
    return a.x > 3 && nearest > 0.35 ? 0 : 1;
}
