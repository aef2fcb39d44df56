/* Frames of a running scene: positions, states and flags of its people by slot, and its bodies. The
   listener JoxLive is made here. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "live/live_parts.h"
#include "run/figure_listeners.h"
#include "run/listener.h"
#include "run/present_frame.h"

static const float MARGIN = 2.0f; /* m around everything that a scene names */
static const double LEAN_TIME =
    0.3; /* s, time constant of the averaged push that people lean under */

const float jox_live_leans[JOX_LIVE_LEANS] = {60.0f, 150.0f, 300.0f};

static void cover_points(JoxLiveArea *area, const JoxV2 *points, uint32_t count, float more) {
    JoxV2 edge = {more, more};
    for (uint32_t i = 0; i < count; i++)
        jox_live_cover(area, jox_sub(points[i], edge), jox_add(points[i], edge));
}

/* Extends the area to hold all that the scene names (walls, places, positions) and all its people
   and bodies. */
static void cover_scene(JoxLiveArea *area, const JoScene *scene) {
    const JoxSceneSpec *spec = scene->spec;
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    JoxLiveArea all = {.storeys = area->storeys};
    if (spec->bounded)
        jox_live_cover(&all, spec->low, spec->high);
    for (uint32_t v = 0; v < world->model.all_walls.count; v++)
        cover_points(&all, &world->model.all_walls.vertices[v].point, 1, 0.0f);
    for (uint32_t p = 0; p < scene->world->model.scene_places && p < world->model.place_count; p++)
        cover_points(&all, world->model.places[p].points, world->model.places[p].count,
                     jox_place_radius(&world->model.places[p]));
    for (uint32_t g = 0; g < spec->group_count; g++)
        cover_points(&all, spec->groups[g].positions, spec->groups[g].count, 0.0f);
    for (uint32_t s = 0; s < world->model.start_count; s++)
        cover_points(&all, &world->model.starts[s].at, 1, 0.0f);
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

static bool begin_live_listener(void *self, JoScene *scene, const void *options, JoError *error) {
    JoxLive *live = self;
    (void)options, (void)error;
    live->area.storeys = jox_live_storeys(scene);
    cover_scene(&live->area, scene);
    live->wall = jox_clock_wall();
    live->time = jo_world_time(scene->world);
    return true;
}

static bool count_transitions(void *self, JoScene *scene, JoError *error) {
    (void)error;
    jox_live_count_transitions(self, scene);
    return true;
}

static void release_live_listener(void *self) {
    JoxLive *live = self;
    for (uint32_t m = 0; m < live->machine_count; m++)
        jox_free(live->state_begins[m]);
    jox_live_free_grid(&live->grid);
    jox_free(live->taken);
    jox_free(live->fired);
    jox_free(live->people);
    jox_free(live->seen);
    jox_free(live->state);
    jox_free(live->flags);
    jox_free(live->force);
    jox_text_free(&live->news);
}

static const JoxListenerKind LIVE = {.name = "live page",
                                     .size = sizeof(JoxLive),
                                     .begin = begin_live_listener,
                                     .frame = count_transitions,
                                     .reloaded = jox_live_note_reload,
                                     .release = release_live_listener};

JoxLive *jox_live_attach(JoScene *scene) {
    JoxLive *live = jox_run_find_listener(scene, &LIVE);
    return live ? live : jox_run_attach_listener(scene, &LIVE, NULL, NULL);
}

const JoxStoreys *jox_live_storeys(const JoScene *scene) {
    const JoxStoreys *storeys = &scene->world->model.storeys;
    return jox_has_storeys(storeys) ? storeys : NULL;
}

uint32_t jox_live_player_id(const JoScene *scene) {
    const JoxSceneSpec *spec = scene->spec;
    if (spec->player_group < 0)
        return JOX_NO_INDEX;
    uint32_t id = spec->player_agent; /* ids begin with the agents of the groups, in their order */
    for (int32_t g = 0; g < spec->player_group; g++)
        id += spec->groups[g].count;
    return id;
}

/* Writes the bodies; rows of bodies that are gone get a place far below the floor. */
static void pack_scene_bodies(const JoScene *scene, uint32_t slots, JoxBytes *out) {
    static const float STRAIGHT[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    static const JoxV3 NOWHERE = {0.0f, 0.0f, -1000.0f};
    for (uint32_t o = 0; o < jox_bodies_rows(scene->world->state.bodies); o++) {
        JoxPose pose;
        bool live = jox_bodies_pose(scene->world->state.bodies, o, &pose);
        jox_live_put_body(out, slots, o, live ? pose.position : NOWHERE,
                          live ? pose.turn : STRAIGHT);
    }
}

/* Flips the slot's parity if the agent crossed a periodic edge, so that the page does not draw a
   movement across the whole world. */
static void flip_parity_at_edge(struct JoxLiveSeen *seen, JoxV2 now, JoxV2 period) {
    const JoxV2 way = jox_sub(now, seen->at);
    if ((period.x > 0.0f && fabsf(way.x) > 0.5f * period.x) ||
        (period.y > 0.0f && fabsf(way.y) > 0.5f * period.y))
        seen->flips ^= JOX_LIVE_PARITY;
}

/* Notes position and averaged push of all agents as of this frame, once per tick. The average
   decays by exp(-time / LEAN_TIME); a new agent in a slot begins anew. */
static void note_people(JoxLive *live, const JoWorld *world) {
    const JoxAgents *a = &world->state.agents;
    const double passed = jo_world_time(world) - live->seen_time;
    const float kept = passed >= 0.0 ? expf((float)(-passed / LEAN_TIME)) : 0.0f;
    if (live->seen_tick == world->state.tick + 1)
        return;
    live->seen_tick = world->state.tick + 1;
    live->seen_time = jo_world_time(world);
    JOX_RESERVE_ZEROED(live->seen, live->seen_capacity, a->slot_count);
    for (uint32_t i = 0; i < a->count; i++) {
        struct JoxLiveSeen *seen = &live->seen[a->slot[i]];
        const uint32_t generation = a->slot_generation[a->slot[i]];
        const JoxV2 now = {a->x[i], a->y[i]};
        const JoxV2 pushed = {a->push_x[i] + a->contact_x[i], a->push_y[i] + a->contact_y[i]};
        const float old = seen->generation == generation ? kept : 0.0f;
        JOX_ASSERT(a->slot[i] < a->slot_count && isfinite(now.x) && isfinite(now.y));
        if (seen->generation == generation)
            flip_parity_at_edge(seen, now, a->period);
        seen->pushed = jox_add(jox_scale(seen->pushed, old), jox_scale(pushed, 1.0f - old));
        seen->at = now;
        seen->generation = generation;
    }
}

/* Returns the lean bits of the flags for an averaged push (N): one of eight directions, counted
   from the east, and one of three levels; 0 below the first level. */
static uint32_t encode_lean(JoxV2 pushed) {
    static const uint8_t WAYS[3][3] = {{5, 6, 7}, {4, 0, 0}, {3, 2, 1}}; /* [y + 1][x + 1] */
    static const float DIAGONAL = 0.41421356f; /* tangent of 22.5 degrees */
    const float force = jox_length(pushed), across = fabsf(pushed.x), up = fabsf(pushed.y);
    uint32_t step = 0;
    while (step < JOX_LIVE_LEANS && force >= jox_live_leans[step])
        step++;
    if (step == 0)
        return 0;
    const int x = across < DIAGONAL * up ? 0 : pushed.x < 0.0f ? -1 : 1;
    const int y = up < DIAGONAL * across ? 0 : pushed.y < 0.0f ? -1 : 1;
    return (1 + WAYS[y + 1][x + 1] + 8 * (step - 1)) << JOX_LIVE_LEAN_SHIFT;
}

/* Fills the columns of states, as indices in the scene message, and of flags. */
static void fill_states(JoxLive *live, const JoScene *scene) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    const uint32_t player = jox_live_player_id(scene);
    uint32_t first[JOX_MOST_MACHINES + 1] = {0};
    for (uint32_t m = 0; m < world->model.machines.count; m++)
        first[m + 1] = first[m] + world->model.machines.items[m]->state_count;
    JOX_RESERVE(live->state, live->state_capacity, a->count + 1);
    JOX_RESERVE(live->flags, live->flag_capacity, a->count + 1);
    for (uint32_t i = 0; i < a->count; i++) {
        const uint32_t slot = a->slot[i];
        const uint32_t state = a->machine[i] == JOX_NO_MACHINE ? JOX_LIVE_OTHER_STATE
                                                               : first[a->machine[i]] + a->state[i];
        const struct JoxLiveSeen *seen = &live->seen[slot];
        const bool lies = a->fallen[i] > 0.0f ||
                          (a->machine[i] != JOX_NO_MACHINE &&
                           world->model.machines.items[a->machine[i]]->states[a->state[i]].lies);
        JOX_ASSERT(a->slot_index[slot] == i);
        live->state[i] = (uint8_t)(state < JOX_LIVE_OTHER_STATE ? state : JOX_LIVE_OTHER_STATE);
        live->flags[i] = (uint8_t)(((a->slot_generation[slot] ^ seen->flips) & JOX_LIVE_PARITY) |
                                   (lies            ? JOX_LIVE_LIES
                                    : a->grasped[i] ? JOX_LIVE_HOLDS
                                                    : encode_lean(seen->pushed)) |
                                   (a->failed[i] ? JOX_LIVE_FAILED : 0u) |
                                   (a->id[i] == player ? JOX_LIVE_PLAYER : 0u));
    }
}

/* Marks the agents that carry bodies, unless they lie. */
static void mark_carriers(JoxLive *live, const JoWorld *world) {
    const JoxObjects *objects = &world->scratch.objects;
    for (uint32_t o = 0; o < objects->count; o++) {
        if (!objects->rows[o].live || !objects->rows[o].held)
            continue;
        const uint32_t i = jox_agents_find(&world->state.agents, objects->rows[o].holder);
        const uint8_t below = (1u << JOX_LIVE_LEAN_SHIFT) - 1u;
        if (i < world->state.agents.count && (live->flags[i] & ~below) != JOX_LIVE_LIES)
            live->flags[i] = (uint8_t)((live->flags[i] & below) | JOX_LIVE_CARRIES);
    }
}

static const float *fill_forces(JoxLive *live, const JoxAgents *a) {
    JOX_RESERVE(live->force, live->force_capacity, a->count + 1);
    for (uint32_t i = 0; i < a->count; i++)
        live->force[i] = sqrtf(a->force_x[i] * a->force_x[i] + a->force_y[i] * a->force_y[i]);
    return live->force;
}

/* Returns the scene's people as columns; states, flags, values and torsos are still NULL. */
static JoxLiveCrowd list_scene_crowd(const JoScene *scene) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    return (JoxLiveCrowd){.count = a->count,
                          .slots = a->slot_count,
                          .slot = a->slot,
                          .x = a->x,
                          .y = a->y,
                          .vx = a->vx,
                          .vy = a->vy,
                          .face_x = a->face_x,
                          .face_y = a->face_y,
                          .radius = a->param[JOX_PARAM_radius].cells,
                          .one_radius = !a->param[JOX_PARAM_radius].mask,
                          .group = a->group,
                          .period = a->period,
                          .walls = &world->scratch.walls,
                          .storeys = jox_live_storeys(scene),
                          .lifts = world->model.lifts};
}

/* Adds the torsos of the scene's people, unless all are discs. */
static void add_torsos(JoScene *scene, JoxLiveCrowd *crowd) {
    const JoxFrame *frame = jox_run_present_frame(scene, JOX_FRAME_TORSOS);
    crowd->axis_x = frame->axis_x;
    crowd->axis_y = frame->axis_y;
    crowd->contact_radius = frame->contact_radius;
}

void jox_live_frame(JoScene *scene, JoxLiveColour colour, JoxLiveScales *scales, JoxBytes *out) {
    JoxLive *live = jox_live_attach(scene);
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    JoxLiveCrowd crowd = list_scene_crowd(scene);
    jox_live_cover_crowd(&live->area, &crowd);
    note_people(live, world);
    fill_states(live, scene);
    mark_carriers(live, world);
    add_torsos(scene, &crowd);
    crowd.state = live->state;
    crowd.flags = live->flags;
    crowd.value = colour == JOX_LIVE_COLOUR_force         ? fill_forces(live, a)
                  : colour == JOX_LIVE_COLOUR_compression ? a->compression
                  : colour == JOX_LIVE_COLOUR_load        ? a->load
                  : colour == JOX_LIVE_COLOUR_density     ? a->density
                  : colour == JOX_LIVE_COLOUR_service     ? a->density
                                                          : NULL;
    const JoxLiveHead head = {.tick = (uint32_t)world->state.tick,
                              .time = jo_world_time(world),
                              .bodies = jox_bodies_rows(world->state.bodies),
                              .area = &live->area,
                              .scales = scales};
    const JoxFrame *frame = jox_run_present_frame(scene, 0);
    crowd.cars = frame->cars;
    crowd.lift_count = frame->lift_count;
    jox_live_pack_frame(&head, &crowd, colour, out);
    pack_scene_bodies(scene, a->slot_count, out);
    jox_live_add_cars(out, frame->cars, frame->lift_count);
}

bool jox_live_people(JoScene *scene, JoxBytes *out) {
    JoxLiveCrowd crowd = list_scene_crowd(scene);
    add_torsos(scene, &crowd);
    return jox_live_pack_people(&crowd, out);
}

double jox_live_speed(const JoScene *scene) {
    const JoxLiveCrowd crowd = list_scene_crowd(scene);
    return jox_live_mean_speed(&crowd);
}

void jox_live_spread_crowd(JoScene *scene) {
    JoxLive *live = jox_live_attach(scene);
    const JoxLiveCrowd crowd = list_scene_crowd(scene);
    if (live->spread_tick == scene->world->state.tick + 1)
        return;
    live->spread_tick = scene->world->state.tick + 1;
    jox_live_spread(&live->grid, &live->area, &crowd);
}

void jox_live_field(JoScene *scene, JoxLiveField field, JoxLiveScales *scales, JoxBytes *out) {
    if (field == JOX_LIVE_PRESSURE) { /* the run samples it from the first time it is shown */
        const JoxLocal *local = jox_run_collect_pressure(scene);
        jox_live_pack_field(local->grid, jox_pressure_now(local->pressure), field, scales, out);
        return;
    }
    jox_live_spread_crowd(scene);
    const JoxDensity *grid = jox_live_attach(scene)->grid.grid;
    jox_live_pack_field(grid, grid->now, field, scales, out);
}
