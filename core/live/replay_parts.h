/* What the files replay*.c share. */
#ifndef JOX_LIVE_REPLAY_PARTS_H
#define JOX_LIVE_REPLAY_PARTS_H

#include "live/live_parts.h"
#include "live/replay.h"
#include "record/trajectory_reader.h"

#define JOX_REPLAY_NOBODY UINT32_MAX

/* Machines and states under one number each, though a machine that was loaded anew in the run has
   more in the file. */
typedef struct JoxReplayNames {
    const char **machines;
    JoxLiveNamed *states;
    uint32_t *state_of; /* by row of the reader's states */
    uint32_t machine_count, state_count;
} JoxReplayNames;

struct JoxReplay {
    char *path;
    JoxTrajectoryReader *reader;
    JoxTrajectoryReaderInfo info;
    JoxSceneSpec *spec; /* or NULL */
    JoxBodies *bodies;  /* of the scene, or NULL */
    JoxReplayNames names;
    JoxV2 period; /* m: of periodic edges; 0 without */
    JoxLiveArea area;
    JoxLiveGrid grid;
    uint32_t shown; /* frame, or JOX_REPLAY_NOBODY */
    bool spread;
    JoxLocal *local; /* for crowd pressure, from when it is first shown */
    uint32_t *key;   /* scratch */
    size_t key_capacity;
    bool timed; /* speeds are known: the frame before was read, too */
    JoxTrajectoryReaderFrame frame;
    /* Slots of the people shown, in their order; and of those in the frame before. */
    int64_t *id, *old_id;
    uint32_t *slot, *old_slot;
    float *vx, *vy, *x, *y;
    float *density;         /* these three are scratch of a frame that is packed */
    uint8_t *state, *flags; /* likewise */
    uint32_t count;
    size_t capacity;
    uint8_t *parity;        /* by slot */
    float *last_x, *last_y; /* by slot: where its person was */
    uint32_t *spare;        /* free slots */
    uint32_t slot_count, spare_count;
    size_t slot_capacity;
    /* Bodies: rows in the order in which their ids came. */
    uint32_t *row_of; /* by id */
    uint32_t *body_id;
    uint32_t row_count;
    size_t row_of_capacity, body_capacity;
    uint32_t *people; /* scratch: by state */
};

/* Those that the recording has in the frame that is shown, open gates among them; of the scene
   where the recording has none over time. */
const JoxWalls *jox_replay_walls(const JoxReplay *replay);
/* Number of a person's state in the scene message's list; UINT32_MAX: it has none. */
uint32_t jox_replay_state(const JoxReplay *replay, uint32_t person);
/* m/s, of everybody; NAN where the frame before is not known. */
double jox_replay_speed(const JoxReplay *replay);
/* replay_slots.c: makes room for so many people; gives everybody of the frame a slot: that of the
   frame before, of which both lists ascend by id. `spent`: s since then; 0 where the frames are not
   neighbours. */
void jox_replay_widen(JoxReplay *replay, uint32_t need);
void jox_replay_give_slots(JoxReplay *replay, const JoxTrajectoryReaderFrame *frame, double spent);
/* Brings the grid up to date. */
void jox_replay_spread(JoxReplay *replay);

#endif
