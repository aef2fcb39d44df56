/* A recording frame by frame, in any order. SQLite files are read on demand, by their index or,
   where they have none, by the rows at which frames begin: they need not fit into memory. Where the
   rows are in no order, SQLite sorts a copy of them. Text is read whole (trajectories.h). */
#ifndef JOX_RECORD_TRAJECTORY_READER_H
#define JOX_RECORD_TRAJECTORY_READER_H

#include "record/recorder.h"
#include "record/trajectories.h"

typedef struct JoxTrajectoryReader JoxTrajectoryReader;

/* Columns that a recording lacks are NULL. */
typedef struct JoxTrajectoryReaderFrame {
    double time; /* s */
    uint32_t count;
    const int64_t *id;  /* ascending; the same person's in every frame */
    const float *x, *y; /* m */
    const float *face_x, *face_y;
    const uint32_t *state; /* row of jox_trajectory_reader_state, or JOX_NO_RECORDED_STATE */
    const float *force, *compression, *load; /* N, N/m, N */
    const float *radius;                     /* m */
    const uint16_t *group;
    uint32_t body_count;
    const JoxRecordBody *bodies; /* ascending ids */
} JoxTrajectoryReaderFrame;
#define JOX_NO_RECORDED_STATE UINT32_MAX

/* What a recording says of itself. */
typedef struct JoxTrajectoryReaderInfo {
    double fps;
    uint32_t frames;
    bool bounded;
    JoxV2 low, high;       /* m, if it is bounded */
    const JoxWalls *walls; /* as they are at first */
    const char *const *groups;
    uint32_t group_count;
    const JoxColour *group_colours;
    const struct JoxTrajectoryReaderState {
        char *machine, *name;
        int64_t number; /* in the file */
        JoxColour colour;
    } * states;
    uint32_t state_count;
    bool whole;                            /* it was read into memory */
    bool has_force, has_bodies, has_walls; /* has_walls: over time */
} JoxTrajectoryReaderInfo;

/* NULL with errors in `diagnostics`. */
JoxTrajectoryReader *jox_trajectory_reader_open(const char *path,
                                                const JoxTrajectoryOptions *options,
                                                JoxDiagnostics *diagnostics);
JoxTrajectoryReaderInfo jox_trajectory_reader_info(const JoxTrajectoryReader *reader);
/* s; of a frame below `frames`. */
double jox_trajectory_reader_time(const JoxTrajectoryReader *reader, uint32_t frame);
/* The last frame at or before a time; the first where there is none. */
uint32_t jox_trajectory_reader_find(const JoxTrajectoryReader *reader, double time);
/* Holds until the next call. False with a sentence in `why` where the file is damaged. */
bool jox_trajectory_reader_read(JoxTrajectoryReader *reader, uint32_t frame,
                                JoxTrajectoryReaderFrame *out, JoxText *why);
/* Walls in a frame: all, those that stand; how often any had been made or replaced. They hold until
   the next call. */
const JoxWalls *jox_trajectory_reader_walls(const JoxTrajectoryReader *reader, uint32_t frame);
const JoxWalls *jox_trajectory_reader_standing(const JoxTrajectoryReader *reader, uint32_t frame);
uint32_t jox_trajectory_reader_wall_changes(const JoxTrajectoryReader *reader, uint32_t frame);
/* Shapes that the recording has of its bodies: how often any had changed by a frame; part `part` of
   a body as it was then, valid until the next call; false behind the last. */
uint32_t jox_trajectory_reader_changes(const JoxTrajectoryReader *reader, uint32_t frame);
bool jox_trajectory_reader_part(JoxTrajectoryReader *reader, uint32_t frame, uint32_t body,
                                uint32_t part, JoxBodyLook *out);
void jox_trajectory_reader_close(JoxTrajectoryReader *reader);

#endif
