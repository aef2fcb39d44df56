/* Opens recordings, and records a scene whose people and bodies come and leave, and keeps the run's
   own frames to compare the recording with. */
#ifndef JOX_TESTS_UNIT_LIVE_RECORDING_H
#define JOX_TESTS_UNIT_LIVE_RECORDING_H

#include <sqlite3.h>

#include "live_bytes.h"

#include "live/replay.h"

enum { MOST_PEOPLE = 300, MOST_FRAMES = 200 };

/* The frames of the run that were recorded. */
static struct Recorded {
    double time;
    uint32_t count, bodies;
    struct {
        uint32_t id;
        float x, y;
        char state[32];
    } people[MOST_PEOPLE];
    JoxV3 body[4];
} recorded[MOST_FRAMES];
static uint32_t recorded_count;
static char path[300];

#define ROOM                                                                                       \
    "jostle: 1\n"                                                                                  \
    "places:\n"                                                                                    \
    "  west: {polygon: [[0, 0], [4, 0], [4, 12], [0, 12]]}\n"                                      \
    "  gone: {polygon: [[12, -5], [30, -5], [30, 17], [12, 17]]}\n"                                \
    "walls:\n"                                                                                     \
    "  - {line: [[-2, -2], [14, -2]]}\n"                                                           \
    "  - {solid: [[6, 13], [7, 13], [7, 14], [6, 14]]}\n"                                          \
    "  - {line: [[-10, 20], [-9, 20], [-9, 21], [-10, 21]], closed: true, height: 1.5, name: "     \
    "gate}\n"                                                                                      \
    "bodies:\n"                                                                                    \
    "  - {name: ball, shape: {sphere: {radius: 0.3}}, mass: 3, at: [6, 6, 0.3], velocity: [1, 0, " \
    "3], damping: 0.2}\n"                                                                          \
    "  - {shape: {compound: [{shape: {box: {size: [1.5, 1, 0.5]}}}, {shape: {cylinder: {radius: "  \
    "0.2, height: 0.8}}, at: [0.5, 0.3, 0.65]}]}, mass: 9, at: [40, 6, 0.25]}\n"                   \
    "  - {shape: {hull: {points: [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, "         \
    "1.5]]}}, mass: 80, at: [50, 0, 0.1]}\n"                                                       \
    "groups:\n"                                                                                    \
    "  people: {behaviour: own.lua, count: 40, fill: random, in: west}\n"                          \
    "  more: {behaviour: own.lua, count: 5, fill: random, in: west}\n"                             \
    "sources: [{at: west, like: people, rate: 6}]\n"                                               \
    "sinks: [{at: gone}]\n"
#define WALKERS                                                                                    \
    MACHINE_START                                                                                  \
    "\"A\", states = { A = { steer = drift(1, 0), speed = uniform(1, 3), lasts = uniform(1, "      \
    "3), { to = \"B\", when = lasted } }, B = { steer = hold, lasts = 1, { to = \"A\", when "      \
    "= lasted } } } }\n"

static inline void note_frame(const JoScene *scene) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    assert_true(recorded_count < MOST_FRAMES);
    struct Recorded *f = &recorded[recorded_count++];
    *f = (struct Recorded){.time = jo_world_time(world)};
    for (uint32_t id = 0; id < a->next_id; id++) {
        const uint32_t i = jox_agents_find(a, id);
        if (i == JOX_NO_INDEX)
            continue;
        assert_true(f->count < MOST_PEOPLE);
        f->people[f->count].id = id;
        f->people[f->count].x = a->x[i];
        f->people[f->count].y = a->y[i];
        snprintf(f->people[f->count++].state, 32, "%s",
                 world->model.machines.items[a->machine[i]]->states[a->state[i]].name);
    }
    for (uint32_t row = 0; row < jox_bodies_rows(world->state.bodies) && f->bodies < 4; row++) {
        JoxPose pose;
        if (jox_bodies_pose(world->state.bodies, row, &pose))
            f->body[f->bodies++] = pose.position;
    }
}

/* Runs and records the scene; it has no bodies if the build is without Bullet. */
static inline void record_room(void) {
    JoScene *scene = load_scene_text(ROOM, WALKERS);
    JoError error = {0};
    recorded_count = 0;
    snprintf(path, sizeof path, "%s/room.sqlite", test_folder);
    if (!jo_scene_record(scene, path, 0.0, &error))
        fail_msg("%s", error.text);
    for (int t = 0; t < 200; t++) {
        step_scene(scene, 1);
        if (scene->world->state.tick % 2 == 0)
            note_frame(scene);
    }
    assert_true(jo_scene_finish(scene, &error));
    jo_scene_free(scene);
}

static inline JoxReplay *open_replay(const char *file, const char *scene, double fps) {
    JoxDiagnostics diagnostics = {0};
    const JoxReplayDef def = {.recording = file, .scene = scene, .options = {.fps = fps}};
    JoxReplay *replay = jox_replay_open(&def, &diagnostics);
    if (!replay)
        fail_msg("%s", diagnostics.items[0].message);
    jox_diag_free(&diagnostics);
    return replay;
}

static inline void run_sql(const char *file, const char *sql) {
    sqlite3 *db;
    char *wrong = NULL;
    assert_int_equal(sqlite3_open(file, &db), SQLITE_OK);
    if (sqlite3_exec(db, sql, NULL, NULL, &wrong) != SQLITE_OK)
        fail_msg("%s", wrong);
    sqlite3_close(db);
}

#endif
