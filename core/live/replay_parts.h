/* State of an open recording, shared by replay.c (frames), replay_slots.c (slots of people) and
   replay_messages.c (JSON). */
#ifndef JOX_LIVE_REPLAY_PARTS_H
#define JOX_LIVE_REPLAY_PARTS_H

#include "live/live_parts.h"
#include "live/replay.h"
#include "record/local_samples.h"
#include "record/trajectory_reader.h"
#include "scene/scene_look.h"

/* No frame, no slot, no row of a body. */
#define JOX_REPLAY_NOBODY UINT32_MAX

/* Machines and states by name. The recording lists those of a machine again each time it was
   reloaded in the run; here each name stands once. */
typedef struct JoxReplayNames {
    const char **machines;
    JoxLiveNamed *states;
    bool *lies;         /* by index in `states` */
    uint32_t *state_of; /* index in `states`, by the recording's number of a state */
    uint32_t machine_count, state_count;
} JoxReplayNames;

struct JoxReplay {
    char *path;
    JoxTrajectoryReader *reader;
    JoxTrajectoryReaderInfo info;
    JoxSceneSpec *spec; /* the scene file that was given, or NULL */
    JoxSceneLook look;  /* that of this scene, else the recorded one */
    JoxBodies *bodies;  /* bodies of that scene, or NULL */
    JoxReplayNames names;
    JoxV2 period; /* m, size of a periodic world; 0 along an axis without periodic edges */
    JoxLiveArea area;
    JoxLiveGrid grid;
    uint32_t shown;  /* index of the shown frame, or JOX_REPLAY_NOBODY */
    bool spread;     /* `grid` has the density of the shown frame */
    JoxLocal *local; /* samples of crowd pressure; NULL until it is first shown */
    uint32_t *key;   /* scratch: keys of people for `local` */
    size_t key_capacity;
    bool timed; /* speeds are known: a frame shortly before the shown one was read too */
    JoxTrajectoryReaderFrame frame;
    /* Columns of the people shown, in order of id, and ids and slots of the frame before. */
    int64_t *id, *old_id;
    uint32_t *slot, *old_slot;
    float *vx, *vy, *x, *y; /* m/s, m */
    float *density;         /* scratch of packing: 1/m2 */
    uint8_t *state, *flags; /* scratch of packing */
    uint32_t count;
    size_t capacity;
    uint8_t *parity;        /* JOX_LIVE_PARITY or 0, by slot */
    float *last_x, *last_y; /* last position, m, by slot */
    uint32_t *spare;        /* a stack of free slots */
    uint32_t slot_count, spare_count;
    size_t slot_capacity;
    /* Bodies have a row each, in the order in which their ids first appeared. */
    uint32_t *row_of;  /* row by id, or JOX_REPLAY_NOBODY */
    uint32_t *body_id; /* id by row */
    uint32_t row_count;
    size_t row_of_capacity, body_capacity;
    uint32_t *people; /* scratch: number of people by state */
};

/* Walls of the shown frame, open gates among them: the recording's, else the scene's. */
const JoxWalls *jox_replay_walls(const JoxReplay *replay);
/* Index of a person's state in the scene message's list; UINT32_MAX: none is recorded. */
uint32_t jox_replay_state(const JoxReplay *replay, uint32_t person);
/* Mean speed of all people, m/s; NAN if no frame before is known. */
double jox_replay_speed(const JoxReplay *replay);
/* replay_slots.c: makes room for `need` people. */
void jox_replay_reserve(JoxReplay *replay, uint32_t need);
/* Gives each person of a frame a slot, the one of the frame before if the person was in it (both
   frames ascend by id), and computes velocities. `spent`: time between the frames, s; 0 if they are
   too far apart for that. */
void jox_replay_give_slots(JoxReplay *replay, const JoxTrajectoryReaderFrame *frame, double spent);
/* Computes the density of the shown frame, once per frame. */
void jox_replay_spread(JoxReplay *replay);

#endif
