/* State of a running scene's messages, and parts of messages that recordings have too. Shared by
   the files live_*.c and replay*.c. */
#ifndef JOX_LIVE_LIVE_PARTS_H
#define JOX_LIVE_LIVE_PARTS_H

#include "base/hash.h"
#include "live/live.h"
#include "run/run.h"

/* A transition that an agent took. */
typedef struct JoxLiveTaken {
    uint64_t tick;
    uint32_t transition; /* its number: transitions of all machines are numbered in one sequence */
} JoxLiveTaken;

struct JoxLive {
    JoxLiveArea area;
    JoxLiveGrid grid;
    uint64_t spread_tick; /* 1 + the tick whose crowd is in the grid; 0: none */
    /* Transitions taken in the last second: a ring buffer whose oldest item is at `first`. */
    JoxLiveTaken *taken;
    uint32_t first, count, capacity;
    /* Numbers of transitions: those of machine m begin at begins[m], those of its state s at
       state_begins[m][s]. `machines`: the ones that were numbered. */
    const JoxMachine *machines[JOX_MOST_MACHINES];
    uint32_t machine_count, begins[JOX_MOST_MACHINES + 1];
    uint32_t *state_begins[JOX_MOST_MACHINES];
    uint32_t *fired;       /* by number: how often it was taken in the last second */
    uint64_t counted_tick; /* the tick up to which transitions were counted */
    /* Figures as of the last status: wall time and simulated time, s; time of each stage, s; failed
       solves; steps of agents. */
    double wall, time, stage_s[JO_STAGE_COUNT];
    uint64_t failures, agent_steps;
    /* People as of the last frame, by slot: position, push averaged over LEAN_TIME (N), generation
       of the slot, and a bit that flips when the agent crosses a periodic edge. */
    struct JoxLiveSeen {
        JoxV2 at, pushed;
        uint32_t generation;
        uint8_t flips;
    } * seen;
    size_t seen_capacity;
    uint64_t seen_tick; /* 1 + the tick of that frame; 0: none */
    double seen_time;   /* simulated time of that frame, s */
    /* What reloads changed and was not sent yet: objects, joined by commas. `telling`: the same is
       being sent as text. */
    JoxText news;
    bool telling;
    /* Scratch: number of people by state; states, flags and forces (N) of a frame's people. */
    uint32_t *people;
    uint8_t *state, *flags;
    float *force;
    size_t people_capacity, state_capacity, flag_capacity, force_capacity;
};

/* Returns the scene's listener; the first call attaches it. */
JoxLive *jox_live_attach(JoScene *scene);
/* live_transitions.c: numbers the transitions again if the machines were replaced. */
void jox_live_number_transitions(JoxLive *live, const JoxMachineRun *machines);
/* Counts the transitions of a step, and drops those that are older than a second. Called after each
   step. */
void jox_live_count_transitions(JoxLive *live, const JoScene *scene);
/* live_game.c: each adds the member "game", null for a scene without one: of the scene message, the
   rules; of a status, round and match as they stand. */
void jox_live_add_rules(const JoScene *scene, JoxJson *json);
void jox_live_add_match(const JoScene *scene, const JoxLiveMatch *match, JoxJson *json);
/* Whether all rounds of the match are played, or one side can no longer be reached. */
bool jox_live_is_match_over(const JoxGame *game, const JoxLiveMatch *match);
/* Storeys of the scene; NULL: one plane. */
const JoxStoreys *jox_live_storeys(const JoScene *scene);
/* Id of the agent that the scene's player drives; JOX_NO_INDEX: none. */
uint32_t jox_live_player_id(const JoScene *scene);
/* Computes the density of the present crowd, once per tick. */
void jox_live_spread_crowd(JoScene *scene);

/* Mean speed of all agents, m/s. */
double jox_live_speed(const JoScene *scene);

/* live_scene.c: the first members of a scene message, of a running scene or of a recording. */
typedef struct JoxLiveSceneHead {
    const char *session, *title, *about, *file; /* session: "live" or "replay" */
    double dt, duration;                        /* s */
    uint64_t seed;
    JoxLiveArea area;
    bool restarts; /* pages may begin the run anew */
} JoxLiveSceneHead;
/* Each adds members of a scene message to an open object. */
/* "name", null for NULL and "". */
void jox_live_add_optional_name(JoxJson *json, const char *name);
void jox_live_add_head(const JoxLiveSceneHead *head, JoxJson *json);
void jox_live_add_places(const JoxPlace *places, uint32_t count, JoxJson *json);
void jox_live_add_regions(const JoxSceneRegion *regions, uint32_t count, JoxJson *json);
/* live_scenery.c: adds a member of "clothes": those of a group by its name, but for casual ones. */
void jox_live_add_clothes(const char *group, uint32_t clothes, JoxJson *json);
/* Adds floor, scenery and clothes to a hash, which tells whether a scene message has changed. */
void jox_live_hash_scenery(const JoxSceneSpec *spec, JoxHash *hash);
/* `given`: the scene names the colour. */
void jox_live_add_view(JoxLiveColour colour, JoxLiveField field, bool given, JoxJson *json);
/* A group, or a state of a machine. */
typedef struct JoxLiveNamed {
    const char *name;
    JoxColour given;  /* 0: none */
    uint32_t machine; /* index of the state's machine; JOX_NO_INDEX: a group */
    const char *pose; /* that people take in the state; NULL: none of their own */
} JoxLiveNamed;
/* Adds an array of {"name": ..., "colour": "#rrggbb"}; states have "machine" besides. Items without
   a given colour get one by picture/palette.h, as in pictures. */
void jox_live_add_named(const char *key, const JoxLiveNamed *items, uint32_t count, JoxJson *json);
/* Each adds an object to an open array: one part of a body; one body, {"name": ..., "mass": ...,
   "parts": [...]}, without parts if the row's body is gone. */
void jox_live_add_part(const JoxBodyLook *look, JoxJson *json);
void jox_live_add_body(const JoxBodies *bodies, uint32_t row, JoxJson *json);
/* live_end.c: returns why the run is over, also where the loop has not ended it; adds the member
   "end" of a status, null while the run goes on. */
JoxLiveEnd jox_live_find_end(const JoScene *scene, const JoxLiveSession *session);
void jox_live_add_end(const JoScene *scene, const JoxLiveSession *session, JoxJson *json);
/* live_news.c: what reloads changed, as JoxListenerKind.reloaded. */
void jox_live_note_reload(void *live, JoScene *scene, const JoxReloadNews *news);
/* live_status.c: adds type, time and the session's members to a status. */
void jox_live_add_session(uint64_t tick, double time, const JoxLiveSession *session, JoxJson *json);

#endif
