/* A game's loop with a scene: a player spawns, is sent about, and is told what happened. */
#include <stdio.h>

#include <jostle.h>

static int fail(const JoError *error) {
    fprintf(stderr, "%s:%d: %s\n", error->file, error->line, error->text);
    return 1;
}

int main(int argc, char **argv) {
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    def.path = argc > 1 ? argv[1] : "scenes/evacuation.yaml";
    const char *group = argc > 2 ? argv[2] : "hall";
    def.threads = 1;
    def.no_density = true;
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene)
        return fail(&error);
    JoWorld *world = jo_scene_world(scene);

    unsigned long long transitions = 0, touches = 0, left = 0;
    const uint32_t before = jo_world_agent_count(world);
    JoColumn x = jo_world_column(world, "x"), y = jo_world_column(world, "y");
    const float at_x = *(const float *)x.data, at_y = *(const float *)y.data;
    JoAgent player = jo_world_spawn(world, group, at_x, at_y, &error); /* beside somebody */
    if (!player.generation)
        return fail(&error);

    for (int frame = 0; frame < 100; frame++) {
        if (frame % 20 == 10) /* pushed about */
            jo_agent_apply_force(world, player, 300, 0);
        if (!jo_scene_step(scene, &error))
            return fail(&error);
        const JoEvents events = jo_world_events(world);
        transitions += events.transition_count;
        left += events.left_count;
        for (uint32_t k = 0; k < events.touch_count; k++)
            touches += events.touches[k].began && events.touches[k].kind == JO_TOUCHED_AGENT;
    }
    uint32_t nearest[4];
    float away[4];
    const JoAgentState me = jo_agent_state(world, player);
    const uint32_t about = jo_world_neighbours(world, me.x, me.y, 2, nearest, away, 4);
    printf("t = %.1f s: player %u at (%.2f, %.2f), '%s', %u within 2 m, %.1f people/m2\n",
           jo_world_time(world), me.id, me.x, me.y, me.state, about,
           jo_world_density(world, me.x, me.y));
    printf("%llu transitions, %llu touches between people, %llu left; hash %016llx\n", transitions,
           touches, left, (unsigned long long)jo_world_hash(world));
    const int good = jo_world_agent_count(world) + left == before + 1;
    jo_scene_free(scene);
    return good ? 0 : 1;
}
