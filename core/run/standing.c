/* Who stood the longest though they wanted to get on: each person is looked at once a second. */
#include <math.h>

#include "base/mem.h"
#include "run/run.h"

static const float MOVED = 0.25f; /* m: who has come so far does not stand */

typedef struct Stand {
    JoxV2 at;
    double since; /* s; NAN: did not want to get on when last seen */
    uint32_t id;
} Stand;

typedef struct Standing {
    Stand *people; /* by slot */
    size_t capacity;
    uint32_t seen; /* slots that were ever looked at */
    JoxStood longest;
} Standing;

/* Slots are used again: who is new in one has not stood yet. */
static Stand *stand_of(Standing *s, const JoxAgents *a, uint32_t i) {
    JOX_RESERVE(s->people, s->capacity, a->slot_count);
    for (; s->seen < a->slot_count; s->seen++)
        s->people[s->seen] = (Stand){.since = NAN};
    Stand *stand = &s->people[a->slot[i]];
    if (stand->id != a->id[i])
        *stand = (Stand){.since = NAN, .id = a->id[i]};
    return stand;
}

static void look(Standing *s, const JoWorld *world, uint32_t i) {
    const JoxAgents *a = &world->state.agents;
    double now = jo_world_time(world);
    JoxV2 at = {a->x[i], a->y[i]};
    Stand *stand = stand_of(s, a, i);
    if (jox_stands(a, i)) {
        stand->since = NAN;
        return;
    }
    JoxV2 moved = jox_wrap(a, jox_sub(at, stand->at));
    if (isnan(stand->since) || jox_length2(moved) > MOVED * MOVED) {
        stand->at = at;
        stand->since = now;
    }
    if (now - stand->since > s->longest.seconds)
        s->longest = (JoxStood){now - stand->since, now, stand->at, a->id[i]};
}

static bool standing_begin(void *self, JoScene *scene, const void *options, JoError *error) {
    Standing *s = self;
    (void)scene, (void)options, (void)error;
    s->longest.id = JOX_NO_INDEX;
    return true;
}

static bool standing_frame(void *self, JoScene *scene, JoError *error) {
    const JoWorld *world = scene->world;
    uint64_t every = (uint64_t)jox_maxf(1.0f, (float)(1.0 / world->model.def.dt + 0.5));
    (void)error;
    if (world->state.tick % every == 0)
        for (uint32_t i = 0; i < world->state.agents.count; i++)
            look(self, world, i);
    return true;
}

static void standing_release(void *self) {
    jox_free(((Standing *)self)->people);
}

static const JoxListenerKind STANDING = {.name = "who stood the longest",
                                         .size = sizeof(Standing),
                                         .begin = standing_begin,
                                         .frame = standing_frame,
                                         .release = standing_release};

void jox_run_collect_standing(JoScene *scene) {
    jox_run_listen(scene, &STANDING, NULL, NULL);
}

const JoxStood *jox_run_stood_longest(const JoScene *scene) {
    const Standing *s = jox_run_listener(scene, &STANDING);
    return s ? &s->longest : NULL;
}
