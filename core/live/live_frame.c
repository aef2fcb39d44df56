/* Frames of a running scene: who is where, by slot. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "live/live_parts.h"

static const float MARGIN = 2.0f; /* m about everything that a scene names */

static void cover_points(JoxLiveArea *area, const JoxV2 *points, uint32_t count, float more) {
    JoxV2 edge = {more, more};
    for (uint32_t i = 0; i < count; i++)
        jox_live_cover(area, jox_sub(points[i], edge), jox_add(points[i], edge));
}

/* Where anybody can be as far as the scene tells: what it names, and who is there. */
static void cover_scene(JoxLiveArea *area, const JoScene *scene) {
    const JoxSceneSpec *spec = scene->spec;
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    JoxLiveArea all = {0};
    if (spec->bounded)
        jox_live_cover(&all, spec->low, spec->high);
    for (uint32_t v = 0; v < world->model.all_walls.count; v++)
        cover_points(&all, &world->model.all_walls.vertices[v].point, 1, 0.0f);
    for (uint32_t p = 0; p < scene->first_antipode && p < world->model.place_count; p++)
        cover_points(&all, world->model.places[p].points, world->model.places[p].count,
                     jox_place_radius(&world->model.places[p]));
    for (uint32_t g = 0; g < spec->group_count; g++)
        cover_points(&all, spec->groups[g].positions, spec->groups[g].count, 0.0f);
    for (uint32_t i = 0; i < a->count; i++)
        cover_points(&all, &(JoxV2){a->x[i], a->y[i]}, 1, 0.0f);
    for (uint32_t o = 0; o < jox_bodies_rows(world->state.bodies); o++) {
        JoxPose pose;
        if (jox_bodies_pose(world->state.bodies, o, &pose))
            cover_points(&all, &(JoxV2){pose.centre.x, pose.centre.y}, 1, 1.0f);
    }
    cover_points(&all, &(JoxV2){0.0f, 0.0f}, all.known ? 0 : 1, 1.0f);
    cover_points(area, (JoxV2[]){all.low, all.high}, 2, MARGIN);
}

static bool begin(void *self, JoScene *scene, const void *options, JoError *error) {
    JoxLive *live = self;
    (void)options, (void)error;
    cover_scene(&live->area, scene);
    live->wall = jox_clock_wall();
    live->time = jo_world_time(scene->world);
    return true;
}

static bool count_transitions(void *self, JoScene *scene, JoError *error) {
    (void)error;
    jox_live_count(self, scene);
    return true;
}

static void release(void *self) {
    JoxLive *live = self;
    for (uint32_t m = 0; m < live->machine_count; m++)
        jox_free(live->state_begins[m]);
    jox_live_free_grid(&live->grid);
    jox_free(live->taken);
    jox_free(live->fired);
    jox_free(live->people);
    jox_free(live->rounds);
}

static const JoxListenerKind LIVE = {.name = "live page",
                                     .size = sizeof(JoxLive),
                                     .begin = begin,
                                     .frame = count_transitions,
                                     .release = release};

JoxLive *jox_live_of(JoScene *scene) {
    JoxLive *live = jox_run_listener(scene, &LIVE);
    return live ? live : jox_run_listen(scene, &LIVE, NULL, NULL);
}

/* Who went beyond the area makes it grow. */
static void cover_people(JoxLiveArea *area, const JoxAgents *a) {
    JoxV2 low = area->low, high = area->high;
    for (uint32_t i = 0; i < a->count; i++) {
        low.x = jox_minf(low.x, a->x[i]);
        low.y = jox_minf(low.y, a->y[i]);
        high.x = jox_maxf(high.x, a->x[i]);
        high.y = jox_maxf(high.y, a->y[i]);
    }
    jox_live_cover(area, low, high);
}

uint32_t jox_live_player(const JoScene *scene) {
    const JoxSceneSpec *spec = scene->spec;
    if (spec->player_group < 0)
        return JOX_NO_INDEX;
    uint32_t id = spec->player_agent; /* agents of the groups come first, in their order */
    for (int32_t g = 0; g < spec->player_group; g++)
        id += spec->groups[g].count;
    return id;
}

static inline float colour_of(const JoxAgents *a, uint32_t i, JoxLiveColour colour) {
    switch (colour) {
    case JOX_LIVE_COLOUR_speed:
        return sqrtf(a->vx[i] * a->vx[i] + a->vy[i] * a->vy[i]);
    case JOX_LIVE_COLOUR_force:
        return sqrtf(a->force_x[i] * a->force_x[i] + a->force_y[i] * a->force_y[i]);
    case JOX_LIVE_COLOUR_compression:
        return a->compression[i];
    case JOX_LIVE_COLOUR_density:
        return a->density[i];
    case JOX_LIVE_COLOUR_group:
        return a->group[i];
    default:
        return 0.0f;
    }
}

static void put_bodies(const JoScene *scene, uint32_t slots, JoxBytes *out) {
    static const float STRAIGHT[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    static const JoxV3 NOWHERE = {0.0f, 0.0f, -1000.0f};
    for (uint32_t o = 0; o < jox_bodies_rows(scene->world->state.bodies); o++) {
        JoxPose pose;
        bool live = jox_bodies_pose(scene->world->state.bodies, o, &pose);
        jox_live_put_body(out, slots, o, live ? pose.position : NOWHERE,
                          live ? pose.turn : STRAIGHT);
    }
}

static void note_edges(JoxLive *live, const JoWorld *world) {
    const JoxAgents *a = &world->state.agents;
    const size_t had = live->round_capacity;
    if ((a->period.x <= 0.0f && a->period.y <= 0.0f) || live->came_round == world->state.tick + 1)
        return;
    live->came_round = world->state.tick + 1;
    JOX_RESERVE(live->rounds, live->round_capacity, a->slot_count);
    if (live->round_capacity > had)
        memset(live->rounds + had, 0, (live->round_capacity - had) * sizeof *live->rounds);
    for (uint32_t i = 0; i < a->count; i++) {
        struct JoxLiveRound *r = &live->rounds[a->slot[i]];
        const uint32_t generation = a->slot_generation[a->slot[i]];
        const JoxV2 now = {a->x[i], a->y[i]}, way = jox_sub(now, r->at);
        const bool far = (a->period.x > 0.0f && fabsf(way.x) > 0.5f * a->period.x) ||
                         (a->period.y > 0.0f && fabsf(way.y) > 0.5f * a->period.y);
        if (far && r->generation == generation)
            r->flips ^= JOX_LIVE_PARITY;
        r->at = now;
        r->generation = generation;
    }
}

void jox_live_frame(JoScene *scene, JoxLiveColour colour, JoxBytes *out) {
    JoxLive *live = jox_live_of(scene);
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    uint32_t first[JOX_MOST_MACHINES + 1] = {0};
    for (uint32_t m = 0; m < world->model.machines.count; m++)
        first[m + 1] = first[m] + world->model.machines.items[m]->state_count;
    const uint32_t player = jox_live_player(scene);
    cover_people(&live->area, a);
    note_edges(live, world);
    JoxLiveHead head = {.tick = (uint32_t)world->state.tick,
                        .time = jo_world_time(world),
                        .slots = a->slot_count,
                        .bodies = jox_bodies_rows(world->state.bodies),
                        .area = &live->area,
                        .most = jox_live_colours[colour].most};
    jox_live_begin_frame(out, &head);
    float scale = head.most > 0.0f ? 1.0f / head.most : 0.0f;
    for (uint32_t i = 0; i < a->count; i++) {
        uint32_t state = a->machine[i] == JOX_NO_MACHINE ? JOX_LIVE_OTHER_STATE
                                                         : first[a->machine[i]] + a->state[i];
        uint32_t slot = a->slot[i];
        const uint32_t flips = slot < live->round_capacity ? live->rounds[slot].flips : 0;
        uint8_t flags = (uint8_t)(((a->slot_generation[slot] ^ flips) & JOX_LIVE_PARITY) |
                                  (a->failed[i] ? JOX_LIVE_FAILED : 0u) |
                                  (a->id[i] == player ? JOX_LIVE_PLAYER : 0u));
        jox_live_put_person(
            out, &live->area, slot,
            &(JoxLivePerson){
                a->x[i], a->y[i], a->face_x[i], a->face_y[i], colour_of(a, i, colour) * scale,
                (uint8_t)(state < JOX_LIVE_OTHER_STATE ? state : JOX_LIVE_OTHER_STATE), flags});
    }
    put_bodies(scene, a->slot_count, out);
}

bool jox_live_people(JoScene *scene, JoxBytes *out) {
    const JoxAgents *a = &scene->world->state.agents;
    bool differs = false;
    size_t before = out->length;
    jox_live_begin_people(out, a->slot_count);
    for (uint32_t i = 0; i < a->count; i++)
        differs |= jox_live_put_people(out, a->slot[i], a->param[JOX_PARAM_radius][i], a->group[i]);
    return differs || out->length != before;
}

void jox_live_spread_crowd(JoScene *scene, bool moves) {
    JoxLive *live = jox_live_of(scene);
    const JoxAgents *a = &scene->world->state.agents;
    if (live->spread == scene->world->state.tick + 1 && (live->moves || !moves))
        return;
    live->spread = scene->world->state.tick + 1;
    live->moves = moves;
    cover_people(&live->area, a);
    jox_live_spread(&live->grid, &live->area,
                    &(JoxLiveCrowd){a->count, a->x, a->y, a->vx, a->vy, a->period}, moves);
}

void jox_live_field(JoScene *scene, JoxLiveField field, JoxBytes *out) {
    jox_live_spread_crowd(scene, field == JOX_LIVE_PRESSURE);
    jox_live_pack_field(&jox_live_of(scene)->grid, field, out);
}
