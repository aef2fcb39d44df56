/* Follows one agent through a run, so that its last transition and the draws of its chances are
   known when somebody asks why it stays (jo_scene_follow): a listener that keeps the agent watched.
 */
#include "base/assert.h"
#include "base/guard.h"
#include "jostle_tools.h"
#include "run/run.h"

typedef struct Follow {
    uint32_t id;
} Follow;

static bool watch_followed(void *self, JoScene *scene, JoError *error) {
    const Follow *follow = self;
    const JoxAgents *a = &scene->world->state.agents;
    const uint32_t i = follow->id < a->next_id ? jox_agents_find(a, follow->id) : JOX_NO_INDEX;
    const JoxWatched *watched;
    (void)error;
    if (i != JOX_NO_INDEX)
        jox_world_inspect(scene->world, a->slot[i], &watched);
    return true;
}

static bool begin_following(void *self, JoScene *scene, const void *options, JoError *error) {
    *(Follow *)self = *(const Follow *)options;
    return watch_followed(self, scene, error);
}

static const JoxListenerKind FOLLOW = {
    .name = "follow", .size = sizeof(Follow), .begin = begin_following, .frame = watch_followed};

void jo_scene_follow(JoScene *scene, uint32_t agent) {
    JOX_REQUIRE(scene && !scene->def.dry && !scene->world->busy, );
    JOX_GUARD (scene->heap, NULL)
        return;
    Follow *follow = jox_run_find_listener(scene, &FOLLOW);
    if (follow)
        follow->id = agent;
    else
        jox_run_attach_listener(scene, &FOLLOW, &(Follow){agent}, NULL);
}
