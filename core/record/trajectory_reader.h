/* Reads single frames of a recording, in any order: for replays, pictures and comparisons. An
   SQLite file is read on demand, by its index or, without one, by the row at which each frame
   begins, so it need not fit into memory; if its rows are unsorted, SQLite sorts a copy. Text is
   read whole (trajectories.h). */
#ifndef JOX_RECORD_TRAJECTORY_READER_H
#define JOX_RECORD_TRAJECTORY_READER_H

#include "record/recorder.h"
#include "record/trajectories.h"

typedef struct JoxTrajectoryReader JoxTrajectoryReader;

/* One frame; a column is NULL where the recording lacks it. */
typedef struct JoxTrajectoryReaderFrame {
    double time; /* s */
    uint32_t count;
    const int64_t *id;            /* in ascending order; a person has the same id in every frame */
    const float *x, *y;           /* m: positions on sheets, if there are storeys */
    const float *face_x, *face_y; /* unit vectors along which people look */
    /* index in `states` of JoxTrajectoryReaderInfo, or JOX_NO_RECORDED_STATE */
    const uint32_t *state;
    const float *force, *compression, *load; /* N, N/m, N */
    const float *radius;                     /* m */
    /* The torso: from its centre to the left end of its axis, and the distance of its surface from
       the axis, m. A disc has no axis; NULL, too, where all are discs. */
    const float *axis_x, *axis_y, *contact_radius;
    const float *fallen; /* s: time since the person fell; 0: it stands */
    const uint16_t *group;
    uint32_t body_count;
    const JoxRecordBody *bodies; /* in ascending order of ids */
} JoxTrajectoryReaderFrame;
#define JOX_NO_RECORDED_STATE UINT32_MAX

/* Properties of the whole recording. The arrays belong to the reader. */
typedef struct JoxTrajectoryReaderInfo {
    double fps;
    uint32_t frames;
    bool bounded;
    JoxV2 low, high;           /* m; valid if `bounded` */
    const JoxWalls *walls;     /* walls in the first frame */
    const JoxStoreys *storeys; /* NULL: none are recorded */
    const JoxLift *lifts;      /* laid out; NULL: none are recorded */
    uint32_t lift_count;
    const char *const *groups;
    uint32_t group_count;
    const JoxColour *group_colours;
    const uint32_t *group_clothes; /* indices of jox_clothes_names; NULL: none is recorded */
    const char *look; /* JSON of scene/scene_look.h, which it may not be; NULL: none is recorded */
    const struct JoxTrajectoryReaderState {
        char *machine, *name;
        int64_t number; /* number in the file */
        JoxColour colour;
        uint32_t pose; /* index of jox_poses; 0: none */
        bool lies;     /* people in it are drawn lying down */
    } * states;
    uint32_t state_count;
    bool whole;                            /* the recording was read into memory */
    bool has_force, has_bodies, has_walls; /* has_walls: it has walls over time */
} JoxTrajectoryReaderInfo;

/* Opens a recording. Returns NULL with errors in `diagnostics`. */
JoxTrajectoryReader *jox_trajectory_reader_open(const char *path,
                                                const JoxTrajectoryOptions *options,
                                                JoxDiagnostics *diagnostics);
JoxTrajectoryReaderInfo jox_trajectory_reader_info(const JoxTrajectoryReader *reader);
/* Returns the time of a frame, s; `frame` must be below `frames`. */
double jox_trajectory_reader_time(const JoxTrajectoryReader *reader, uint32_t frame);
/* Returns the last frame at or before a time, s; the first frame if there is none. */
uint32_t jox_trajectory_reader_find(const JoxTrajectoryReader *reader, double time);
/* Reads a frame; `out` is valid until the next call. Returns false with a sentence in `why` if the
   file is damaged. */
bool jox_trajectory_reader_read(JoxTrajectoryReader *reader, uint32_t frame,
                                JoxTrajectoryReaderFrame *out, JoxText *why);
/* Return, for a frame: all walls, the walls without open gates, and how many times walls had been
   made or replaced by then. Walls are valid until the next call. */
const JoxWalls *jox_trajectory_reader_walls(const JoxTrajectoryReader *reader, uint32_t frame);
const JoxWalls *jox_trajectory_reader_standing(const JoxTrajectoryReader *reader, uint32_t frame);
uint32_t jox_trajectory_reader_wall_changes(const JoxTrajectoryReader *reader, uint32_t frame);
/* Returns the cars of the lifts in a frame, valid until the next call; NULL: it has no lifts. */
const JoxCarLook *jox_trajectory_reader_cars(const JoxTrajectoryReader *reader, uint32_t frame);
/* Shapes of bodies: jox_trajectory_reader_changes returns how many times any shape had changed by a
   frame; jox_trajectory_reader_part sets `out` to a part of a body in that frame, valid until the
   next call, and returns false after the last part. */
uint32_t jox_trajectory_reader_changes(const JoxTrajectoryReader *reader, uint32_t frame);
bool jox_trajectory_reader_part(JoxTrajectoryReader *reader, uint32_t frame, uint32_t body,
                                uint32_t part, JoxBodyLook *out);
/* Returns the name of a body with recorded parts, valid until the next call; NULL: none. */
const char *jox_trajectory_reader_body_name(JoxTrajectoryReader *reader, uint32_t frame,
                                            uint32_t body);
void jox_trajectory_reader_close(JoxTrajectoryReader *reader);

#endif
