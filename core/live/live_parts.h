/* What the files live_*.c keep of a running scene. */
#ifndef JOX_LIVE_LIVE_PARTS_H
#define JOX_LIVE_LIVE_PARTS_H

#include "live/live.h"
#include "run/run.h"

/* A transition that somebody took. */
typedef struct JoxLiveTaken {
    uint64_t tick;
    uint32_t which; /* of all transitions of all machines */
} JoxLiveTaken;

struct JoxLive {
    JoxLiveArea area;
    JoxLiveGrid grid;
    uint64_t spread; /* tick of the crowd in the grid, plus 1 */
    /* Transitions of the last second: a ring, the oldest at `first`. Those of machine m begin with
       number `begins[m]`; of state s of it with state_begins[m][s]. */
    JoxLiveTaken *taken;
    uint32_t first, count, capacity;
    const JoxMachine *machines[JOX_MOST_MACHINES];
    uint32_t machine_count, begins[JOX_MOST_MACHINES + 1];
    uint32_t *state_begins[JOX_MOST_MACHINES];
    uint32_t *fired; /* by number: how many in the last second */
    uint64_t noted;  /* tick after the last step that was counted */
    /* As of the last status. */
    double wall, time, stage_s[JO_STAGE_COUNT];
    uint64_t failures, agent_steps;
    /* People as of the last frame, by slot: where they were, the mean push that they bore of late
       (N), and a parity that changes whenever they came round a periodic edge. */
    struct JoxLiveSeen {
        JoxV2 at, pushed;
        uint32_t generation;
        uint8_t flips;
    } * seen;
    size_t seen_capacity;
    uint64_t seen_tick; /* of that frame, plus 1 */
    double seen_time;   /* s */
    /* Scratch: people by state; states, flags and forces of a frame's people. */
    uint32_t *people;
    uint8_t *state, *flags;
    float *force;
    size_t people_capacity, state_capacity, flag_capacity, force_capacity;
};

/* Attached to the scene on first use. */
JoxLive *jox_live_of(JoScene *scene);
/* live_transitions.c: numbers the transitions anew where machines have changed. */
void jox_live_renumber(JoxLive *live, const JoxMachineRun *machines);
/* After each step: counts the transitions that were taken. */
void jox_live_count(JoxLive *live, const JoScene *scene);
/* Agent that the scene's player drives, by id; JOX_NO_INDEX: none. */
uint32_t jox_live_player(const JoScene *scene);
/* Brings the grid up to date. */
void jox_live_spread_crowd(JoScene *scene);

/* m/s, of everybody. */
double jox_live_speed(const JoScene *scene);

/* live_scene.c. What a live scene and a recording begin with. */
typedef struct JoxLiveSceneHead {
    const char *session, *title, *about, *file;
    double dt, duration; /* s */
    uint64_t seed;
    JoxLiveArea area;
} JoxLiveSceneHead;
/* Each adds members to an open object. */
void jox_live_add_head(const JoxLiveSceneHead *head, JoxJson *json);
void jox_live_add_places(const JoxPlace *places, uint32_t count, JoxJson *json);
void jox_live_add_regions(const JoxSceneRegion *regions, uint32_t count, JoxJson *json);
/* NULL: none. */
void jox_live_add_camera(const JoxSceneSpec *spec, JoxJson *json);
void jox_live_add_view(JoxLiveColour colour, JoxLiveField field, JoxJson *json);
/* A group, or a state of a machine. */
typedef struct JoxLiveNamed {
    const char *name;
    JoxColour given;  /* 0: none */
    uint32_t machine; /* of a state; JOX_NO_INDEX: of a group */
} JoxLiveNamed;
/* An array of {"name": ..., "colour": "#rrggbb"}, of states with their machine's number: the
   colours that they were given, else such as pictures take. */
void jox_live_add_named(const char *key, const JoxLiveNamed *items, uint32_t count, JoxJson *json);
/* Each adds an object to an open array: one part of a body; one body, {"name": ..., "mass": ...,
   "parts": [...]}, without parts where there is none in the row. */
void jox_live_add_part(const JoxBodyLook *look, JoxJson *json);
void jox_live_add_body(const JoxBodies *bodies, uint32_t row, JoxJson *json);
/* live_status.c: the state of the session. */
void jox_live_add_session(uint64_t tick, double time, const JoxLiveSession *session, JoxJson *json);

#endif
