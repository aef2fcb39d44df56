/* The listener that records trajectories to an SQLite file (record/recorder.h). jo_scene_record
   attaches it. */
#include <math.h>
#include <string.h>

#include "agents/torso.h"
#include "base/assert.h"
#include "base/guard.h"
#include "base/hash.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "record/recorder.h"
#include "record/recorder_schema.h"
#include "run/present_frame.h"
#include "run/run.h"
#include "scene/scene_look.h"

static const double DEFAULT_INTERVAL = 0.1; /* s between recorded frames, unless given */

typedef struct Recording {
    JoxRecorder *recorder;
    uint32_t every;                   /* ticks */
    uint32_t base[JOX_MOST_MACHINES]; /* by machine: number of its first state in the recording */
    uint32_t next;                    /* the first number that no machine has */
    uint32_t *shapes;                 /* by body id: 1 + the blocks of the shape recorded last */
    size_t shape_capacity;
    struct Wall { /* by number of the wall: as recorded last */
        uint64_t shape;
        uint32_t open, there;
    } * walls;
    size_t wall_capacity;
    JoxCarLook *cars;   /* by lift: as recorded last */
    uint32_t car_count; /* 0 before the first frame */
    size_t car_capacity;
    /* By agent's slot: sums over the steps since the last recorded frame. */
    struct BorneForces {
        float compression, load;
        uint32_t steps, id;
    } * borne;
    size_t borne_capacity;
} Recording;

static const JoxListenerKind RECORDING;

/* Returns the number of an agent's state in the table jostle_state. */
static uint32_t find_state_number(const Recording *r, const JoxAgents *a, uint32_t i) {
    return a->machine[i] == JOX_NO_MACHINE ? UINT32_MAX : r->base[a->machine[i]] + a->state[i];
}

/* Names the states of a machine as its present version does. */
static void name_machine_states(const Recording *r, const JoScene *scene, uint32_t index) {
    const JoxMachine *machine = scene->world->model.machines.items[index];
    for (uint32_t s = 0; s < machine->state_count; s++) {
        const JoxState *state = &machine->states[s];
        jox_recorder_state(r->recorder, r->base[index] + s, machine->name, state->name,
                           state->colour, state->lies ? JOX_RECORDED_LIES : jox_poses[state->pose]);
    }
}

/* Gives the states of a machine new numbers: a new version may have other states. */
static void record_machine_states(void *self, JoScene *scene, uint32_t index) {
    Recording *r = self;
    r->base[index] = r->next;
    r->next += 1000;
    name_machine_states(r, scene, index);
}

/* Records groups, and what the scene shows besides, as its present specification has them. */
static void record_look(const Recording *r, const JoScene *scene) {
    const JoxSceneSpec *spec = scene->spec;
    const JoxSceneLook look = jox_scene_look(spec);
    JoxText text = {0};
    for (uint32_t g = 0; g < spec->group_count; g++)
        jox_recorder_group(r->recorder, g, spec->groups[g].name, spec->groups[g].colour,
                           jox_clothes_names[spec->groups[g].clothes]);
    jox_scene_write_look(&look, &text);
    jox_recorder_look(r->recorder, text.data);
    jox_text_free(&text);
}

/* Records what a reload may have changed without new states: colours, poses, clothes, scenery. */
static void record_reload(void *self, JoScene *scene, const JoxReloadNews *news) {
    const Recording *r = self;
    const JoxMachineSet *machines = &scene->world->model.machines;
    if (!r->recorder)
        return;
    if (!news) /* all is told, and the new specification in place */
        record_look(r, scene);
    for (uint32_t m = 0; news && news->next && m < machines->count; m++)
        if (machines->items[m] == news->next)
            name_machine_states(r, scene, m);
}

/* Writes the walkable area as WKT: that of the plan from which the walls were read if all people
   are, come in and start within it; else the box round everything. With storeys it is the box round
   all of them in plan: readers know one plane, on which the walls of one storey would stand in the
   way of another. */
static void write_walkable_area(const JoScene *scene, JoxText *wkt) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    const uint32_t sources = scene->spec->source_count, starts = world->model.start_count;
    uint32_t count = 0;
    JoxV2 low, high;
    if (jox_run_find_plan_area(scene, &low, &high)) {
        jox_wkt(&(JoxWalls){0}, low, high, wkt);
        return;
    }
    JoxV2 *points = jox_alloc((size_t)a->count + sources + starts + 1, sizeof *points);
    for (uint32_t i = 0; i < a->count; i++)
        points[count++] = (JoxV2){a->x[i], a->y[i]};
    for (uint32_t s = 0; s < sources; s++)
        points[count++] = world->model.places[scene->spec->sources[s].place].centre;
    for (uint32_t s = 0; s < starts; s++)
        points[count++] = world->model.starts[s].at;
    jox_run_find_shown_area(scene, &low, &high);
    if (jox_walls_outline_all(&world->scratch.walls, points, count))
        jox_wkt_outlines(&world->scratch.walls, wkt);
    else
        jox_wkt(&world->scratch.walls, low, high, wkt);
    jox_free(points);
}

static uint64_t hash_wall_shape(const JoxWalls *walls, uint32_t r) {
    const struct JoxWallRing *ring = &walls->rings[r];
    const uint32_t what[2] = {ring->count, ring->solid};
    JoxHash hash = jox_hash_begin();
    jox_hash_add(&hash, what, sizeof what);
    jox_hash_add(&hash, &ring->height, sizeof ring->height);
    jox_hash_add(&hash, &ring->drawn, sizeof ring->drawn);
    if (ring->name)
        jox_hash_add(&hash, ring->name, strlen(ring->name));
    for (uint32_t v = ring->first; v < ring->first + ring->count; v++)
        jox_hash_add(&hash, &walls->vertices[v].point, sizeof walls->vertices[v].point);
    return jox_hash_end(&hash);
}

/* Records walls that opened, closed, were made, replaced or removed since the last frame. */
static void record_walls(Recording *r, const JoxWalls *walls, uint32_t frame) {
    size_t number = 0;
    for (uint32_t at = 0; at < walls->ring_count; at++, number++) {
        bool closed, twin;
        jox_walls_given(walls, at, &closed, &twin);
        JOX_RESERVE_ZEROED(r->walls, r->wall_capacity, number + 1);
        struct Wall *wall = &r->walls[number];
        const uint64_t shape = hash_wall_shape(walls, at);
        const bool same = wall->there && wall->shape == shape;
        if (!same || wall->open != walls->rings[at].open)
            jox_recorder_wall(r->recorder, frame, (uint32_t)number, walls, at, !same);
        *wall = (struct Wall){shape, walls->rings[at].open, true};
        at += twin;
    }
    for (; number < r->wall_capacity; number++) {
        if (r->walls[number].there)
            jox_recorder_wall(r->recorder, frame, (uint32_t)number, NULL, 0, true);
        r->walls[number].there = false;
    }
}

/* The file of a recording: a new one, or one to continue. */
typedef struct Target {
    const char *path;
    double every; /* s; a step where that is longer */
    bool goes_on;
} Target;

static bool begin_recording(void *self, JoScene *scene, const void *options, JoError *error) {
    Recording *r = self;
    const Target *target = options;
    const char *path = target->path;
    JoxText wkt = {0}, why = {0};
    double dt = scene->world->model.def.dt;
    if (target->goes_on) {
        if (!jox_run_restore_listener(scene, &RECORDING, self, error))
            return false;
        r->recorder = jox_recorder_continue(path, (uint32_t)(scene->world->state.tick / r->every),
                                            &scene->world->model.storeys, &why);
        return r->recorder || jox_run_fill_error(error, &why);
    }
    r->every = dt >= target->every ? 1 : (uint32_t)(target->every / dt + 0.5);
    write_walkable_area(scene, &wkt);
    r->recorder = jox_recorder_open(path, 1.0 / (dt * r->every), wkt.data,
                                    &scene->world->model.storeys, &why);
    jox_text_free(&wkt);
    if (!r->recorder)
        return jox_run_fill_error(error, &why);
    JoxV2 low, high;
    jox_run_find_plan_area(scene, &low, &high);
    if (scene->world->model.storeys.storey_count) {
        jox_recorder_describe_storeys(r->recorder, &scene->world->model.all_walls, low, high);
        jox_recorder_describe_lifts(r->recorder, scene->world->model.lifts,
                                    scene->world->model.lift_count);
    }
    record_walls(r, &scene->world->model.all_walls,
                 (uint32_t)((scene->world->state.tick + r->every - 1) / r->every));
    const JoxMachineRun *machines = &scene->world->machines;
    for (uint32_t m = 0; m < machines->set->count; m++)
        record_machine_states(r, scene, m);
    record_look(r, scene);
    return true;
}

/* Records the shapes of bodies that are new or have broken. */
static void record_body_shapes(Recording *r, const JoScene *scene, uint32_t frame) {
    const JoxBodies *bodies = scene->world->state.bodies;
    for (uint32_t row = 0; row < jox_bodies_rows(bodies); row++) {
        const uint32_t id = jox_bodies_id(bodies, row);
        const size_t had = r->shape_capacity;
        JoxBodyBonds bonds;
        JoxBodyLook look;
        if (id == JOX_NO_BODY)
            continue;
        jox_bodies_bonds(bodies, row, &bonds);
        JOX_RESERVE(r->shapes, r->shape_capacity, (size_t)id + 1);
        for (size_t n = had; n < r->shape_capacity; n++)
            r->shapes[n] = 0;
        if (r->shapes[id] == bonds.blocks + 1)
            continue;
        r->shapes[id] = bonds.blocks + 1;
        for (uint32_t part = 0; jox_bodies_describe_part(bodies, row, part, &look); part++)
            jox_recorder_part(r->recorder, frame, id, part, jox_bodies_name(bodies, row), &look);
    }
}

/* Adds up the forces that people bear in each step: frames hold their mean since the last one,
   so that peaks between frames count. */
static void add_borne_forces(Recording *r, const JoxAgents *a) {
    JOX_RESERVE_ZEROED(r->borne, r->borne_capacity, a->slot_count);
    for (uint32_t i = 0; i < a->count; i++) {
        struct BorneForces *b = &r->borne[a->slot[i]];
        if (b->id != a->id[i])
            *b = (struct BorneForces){.id = a->id[i]};
        b->compression += a->compression[i];
        b->load += a->load[i];
        b->steps++;
    }
}

static struct BorneForces take_mean_borne(Recording *r, uint32_t slot) {
    const struct BorneForces b = r->borne[slot];
    r->borne[slot] = (struct BorneForces){.id = b.id};
    return (struct BorneForces){b.compression / (float)b.steps, b.load / (float)b.steps, b.steps,
                                b.id};
}

/* Adds the torso of an agent to its row, unless it is a disc. */
static void add_torso(const JoxAgents *a, uint32_t i, JoxRecordRow *row) {
    const JoxTorso torso = jox_agent_torso(a, i, false);
    if (!(torso.half > 0.0f))
        return;
    row->chest = (float)jox_atan2((double)a->chest_y[i], (double)a->chest_x[i]);
    row->breadth = 2.0f * (torso.half + torso.radius);
    row->depth = 2.0f * torso.radius;
}

/* Adds the cars that have changed since the last frame. */
static void record_cars(Recording *r, const JoxFrame *frame) {
    const bool first = r->car_count < frame->lift_count;
    uint32_t count = 0;
    if (!frame->lift_count)
        return;
    JOX_RESERVE_ZEROED(r->cars, r->car_capacity, frame->lift_count);
    r->car_count = frame->lift_count;
    JoxRecordCar *rows = jox_recorder_add_cars(r->recorder, frame->lift_count);
    for (uint32_t l = 0; l < frame->lift_count; l++) {
        const JoxCarLook *look = &frame->cars[l];
        if (!first && memcmp(look, &r->cars[l], sizeof *look) == 0)
            continue;
        r->cars[l] = *look;
        rows[count++] = (JoxRecordCar){l, frame->lifts[l].stops[look->stop].storey, *look};
    }
    jox_recorder_add_cars(r->recorder, count);
}

static bool record_frame(void *self, JoScene *scene, JoError *error) {
    Recording *r = self;
    add_borne_forces(r, &scene->world->state.agents);
    if (scene->world->state.tick % r->every != 0)
        return true;
    const JoxAgents *a = &scene->world->state.agents;
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    const JoxObjects *objects = &scene->world->scratch.objects;
    JoxRecordBody *bodies;
    uint32_t count = jox_bodies_count(scene->world->state.bodies), n = 0;
    const uint32_t frame = (uint32_t)(scene->world->state.tick / r->every);
    record_body_shapes(r, scene, frame);
    record_walls(r, &scene->world->model.all_walls, frame);
    JoxRecordRow *rows = jox_recorder_begin_frame(r->recorder, a->count, count, &bodies);
    for (uint32_t rank = 0; rank < a->count; rank++) { /* by rank: the order in memory may differ */
        const uint32_t i = a->by_rank[rank], id = a->id[i];
        const struct BorneForces borne = take_mean_borne(r, a->slot[i]);
        float force = sqrtf(a->force_x[i] * a->force_x[i] + a->force_y[i] * a->force_y[i]);
        rows[n++] = (JoxRecordRow){id,
                                   a->x[i],
                                   a->y[i],
                                   a->face_x[i],
                                   a->face_y[i],
                                   find_state_number(r, a, i),
                                   force,
                                   borne.compression,
                                   borne.load,
                                   a->group[i],
                                   radius.cells[i & radius.mask],
                                   NAN,
                                   NAN,
                                   NAN,
                                   a->fallen[i]};
        if (!scene->world->model.def.literal)
            add_torso(a, i, &rows[n - 1]);
    }
    n = 0;
    for (uint32_t o = 0; o < objects->count && n < count; o++) {
        JoxPose pose;
        if (objects->rows[o].live && jox_bodies_pose(scene->world->state.bodies, o, &pose))
            bodies[n++] = (JoxRecordBody){objects->rows[o].id, pose.position.x, pose.position.y,
                                          pose.position.z,     pose.turn[0],    pose.turn[1],
                                          pose.turn[2],        pose.turn[3]};
    }
    record_cars(r, jox_run_present_frame(scene, 0));
    JoxText why = {0};
    return jox_recorder_submit_frame(r->recorder, frame, &why) || jox_run_fill_error(error, &why);
}

static bool end_recording(void *self, JoScene *scene, JoError *error) {
    Recording *r = self;
    JoxText message = {0};
    const bool good = jox_recorder_close(r->recorder, &message);
    r->recorder = NULL;
    if (!good)
        return jox_run_fill_error(error, &message);
    if (message.length)
        jox_run_say(scene, "%s", message.data);
    jox_text_free(&message);
    return true;
}

static void free_recording(void *self) {
    Recording *r = self;
    JOX_ASSERT(!r->recorder);
    jox_free(r->shapes);
    jox_free(r->walls);
    jox_free(r->borne);
    jox_free(r->cars);
}

static bool settle_recording(void *self, JoError *error) {
    JoxText why = {0};
    return jox_recorder_commit(((Recording *)self)->recorder, &why) ||
           jox_run_fill_error(error, &why);
}

static void list_recording_sections(void *self, JoxSections *s) {
    Recording *r = self;
    size_t shapes = r->shape_capacity, borne = r->borne_capacity;
    JOX_SECTION(s, "every", r->every);
    if (r->every == 0)
        jox_sections_fail(s, "every", "frames are a step apart at least");
    JOX_SECTION(s, "base", r->base);
    JOX_SECTION(s, "next", r->next);
    JOX_SECTION_ARRAY(s, "shapes", r->shapes, shapes, r->shape_capacity);
    JOX_SECTION_ROOM(s, "walls", r->walls, r->wall_capacity);
    JOX_SECTION_ARRAY(s, "borne", r->borne, borne, r->borne_capacity);
    JOX_SECTION_ARRAY(s, "cars", r->cars, r->car_count, r->car_capacity);
}

static const JoxListenerKind RECORDING = {.name = "recording",
                                          .size = sizeof(Recording),
                                          .begin = begin_recording,
                                          .frame = record_frame,
                                          .replaced = record_machine_states,
                                          .reloaded = record_reload,
                                          .sections = list_recording_sections,
                                          .settle = settle_recording,
                                          .end = end_recording,
                                          .release = free_recording};

static bool attach_recording(JoScene *scene, const Target *target, JoError *error) {
    JOX_GUARD (scene->heap, error)
        return false;
    return jox_run_attach_listener(scene, &RECORDING, target, error) != NULL;
}

bool jo_scene_record(JoScene *scene, const char *path, double every, JoError *error) {
    JOX_REQUIRE(scene && !scene->world->busy && path && every >= 0.0 && every <= 1e6 &&
                    !jox_run_find_listener(scene, &RECORDING),
                false);
    return attach_recording(scene, &(Target){path, every > 0.0 ? every : DEFAULT_INTERVAL, false},
                            error);
}

bool jo_scene_record_on(JoScene *scene, const char *path, JoError *error) {
    JOX_REQUIRE(scene && !scene->world->busy && path && !jox_run_find_listener(scene, &RECORDING),
                false);
    return attach_recording(scene, &(Target){path, 0.0, true}, error);
}
