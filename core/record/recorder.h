/* Writes the trajectories of a run to an SQLite file in the JuPedSim format, version 2, which PedPy
   reads, with tables of our own for states, forces, bodies and walls (README.md). The listener
   run/recording_listener.c calls it. A thread of its own writes the frames and commits at least
   once a second, so that after a crash the file is valid up to the last commit. The caller opens a
   recorder, names states and groups, gives walls and body parts whenever they change, and each
   frame by jox_recorder_begin_frame and jox_recorder_submit_frame; jox_recorder_close frees it. */
#ifndef JOX_RECORD_RECORDER_H
#define JOX_RECORD_RECORDER_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/colour.h"
#include "base/text.h"
#include "body/body.h"
#include "geom/lifts.h"
#include "geom/walls.h"

typedef struct JoxRecorder JoxRecorder;

/* A person in a frame. */
typedef struct JoxRecordRow {
    uint32_t id;
    float x, y;         /* m; with storeys a position on a sheet, which is written in plan */
    float ori_x, ori_y; /* unit vector along which the person looks */
    uint32_t state;     /* number in jostle_state */
    float force;        /* N */
    float compression;  /* N/m: mean since the previous frame */
    float load;         /* N: mean since the previous frame */
    uint16_t group;     /* number in jostle_group */
    float radius;       /* m */
    /* The torso, NAN of a disc: the angle to which the chest points, anticlockwise from +x, rad;
       breadth and depth, m. */
    float chest, breadth, depth;
    float fallen; /* s: time since it fell; 0: it stands */
} JoxRecordRow;
/* A body in a frame. */
typedef struct JoxRecordBody {
    uint32_t id;
    float x, y, z;        /* m */
    float qx, qy, qz, qw; /* rotation as a quaternion */
} JoxRecordBody;

/* A lift's car as it is from a frame on. */
typedef struct JoxRecordCar {
    uint32_t lift, storey; /* storey: that of the stop in `look` */
    JoxCarLook look;
} JoxRecordCar;

/* Creates a recording; an earlier recording at that path is replaced, any other file is refused.
   `wkt` is the walkable area, `storeys` NULL for one plane. Returns NULL with a sentence in `error`
   on failure. */
JoxRecorder *jox_recorder_open(const char *path, double fps, const char *wkt,
                               const JoxStoreys *storeys, JoxText *error);
/* Describes the storeys of a new recording, before its first frame: with the walkable area of each
   within `low` to `high`, m in plan. */
void jox_recorder_describe_storeys(JoxRecorder *recorder, const JoxWalls *walls, JoxV2 low,
                                   JoxV2 high);
/* Describes the lifts of a new recording, after its storeys. */
void jox_recorder_describe_lifts(JoxRecorder *recorder, const JoxLift *lifts, uint32_t count);
/* Continues one of our recordings after frame `last`; later frames are deleted. Returns NULL with a
   sentence in `error` on failure. */
JoxRecorder *jox_recorder_continue(const char *path, uint32_t last, const JoxStoreys *storeys,
                                   JoxText *error);
/* Commits all frames given so far. Returns false with a sentence in `error` on failure. */
bool jox_recorder_commit(JoxRecorder *recorder, JoxText *error);
/* Names a state number before the first frame that uses it, or again with another colour or pose.
   `colour` is 0 and `pose` NULL where there is none. */
void jox_recorder_state(JoxRecorder *recorder, uint32_t number, const char *machine,
                        const char *state, JoxColour colour, const char *pose);
/* Names a group number, likewise. */
void jox_recorder_group(JoxRecorder *recorder, uint32_t number, const char *name, JoxColour colour,
                        const char *clothes);
/* Records what the scene shows besides people, walls and bodies, a text of JSON, in place of that
   of the last call. */
void jox_recorder_look(JoxRecorder *recorder, const char *look);
/* Records wall `number` as it is from a frame on: its name and heights, which the walkable area
   lacks, and ring `ring` of `walls`; `walls` is NULL where the wall was removed. Without `points`
   its points stay those of the last call (wall_history.h). */
void jox_recorder_wall(JoxRecorder *recorder, uint32_t frame, uint32_t number,
                       const JoxWalls *walls, uint32_t ring, bool points);
/* Records one part of a body as it is from a frame on. Whenever one part changes, give all parts of
   the body, with its name, which may be NULL. */
void jox_recorder_part(JoxRecorder *recorder, uint32_t frame, uint32_t body, uint32_t part,
                       const char *name, const JoxBodyLook *look);
/* Returns rows for a frame, and rows for its bodies in `body_rows`, for the caller to fill and
   submit by jox_recorder_submit_frame. Waits while the writer is four frames behind: no frame is
   dropped. */
JoxRecordRow *jox_recorder_begin_frame(JoxRecorder *recorder, uint32_t rows, uint32_t bodies,
                                       JoxRecordBody **body_rows);
/* Returns rows for the cars that have changed since the last frame, for the caller to fill, between
   the last jox_recorder_begin_frame and jox_recorder_submit_frame. */
JoxRecordCar *jox_recorder_add_cars(JoxRecorder *recorder, uint32_t count);
/* Submits the rows of the last jox_recorder_begin_frame. Returns false with a sentence in `error`
   once writing has failed. */
bool jox_recorder_submit_frame(JoxRecorder *recorder, uint32_t frame, JoxText *error);
/* Writes the frames left, closes the file and frees the recorder. Returns false with a sentence in
   `message` if anything was lost. Returns true with a sentence if another program has the file
   open, so that part of the recording stays in a file beside it. */
bool jox_recorder_close(JoxRecorder *recorder, JoxText *message);

/* Appends the walkable area as well-known text: one POLYGON, the box from `low` to `high`, with a
   hole for each solid wall. */
void jox_wkt(const JoxWalls *walls, JoxV2 low, JoxV2 high, JoxText *out);
/* Appends the walkable area of walls that have outlines: a POLYGON or MULTIPOLYGON of these, with a
   hole for each solid wall inside one. */
void jox_wkt_outlines(const JoxWalls *walls, JoxText *out);

#endif
