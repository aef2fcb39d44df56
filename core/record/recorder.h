/* Trajectories as an SQLite file in the JuPedSim format, version 2, which PedPy reads; with tables
   of our own for states, forces and bodies. Written by a thread of its own in transactions (one a
   second at the latest), so that the file is whole after a crash up to the last of them. */
#ifndef JOX_RECORD_RECORDER_H
#define JOX_RECORD_RECORDER_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/colour.h"
#include "base/text.h"
#include "body/body.h"
#include "geom/walls.h"

typedef struct JoxRecorder JoxRecorder;

typedef struct JoxRecordRow {
    uint32_t id;
    float x, y;         /* m */
    float ori_x, ori_y; /* unit vector the agent looks along */
    uint32_t state;     /* number in jostle_state */
    float force;        /* N */
    float compression;  /* N/m: mean since the frame before */
    float load;         /* N: likewise */
    uint16_t group;     /* number in jostle_group */
    float radius;       /* m */
} JoxRecordRow;
typedef struct JoxRecordBody {
    uint32_t id;
    float x, y, z, qx, qy, qz, qw;
} JoxRecordBody;

/* Replaces an earlier recording; refuses any other file. `wkt`: the walkable area. NULL with a
   sentence in `error`. */
JoxRecorder *jox_recorder_open(const char *path, double fps, const char *wkt, JoxText *error);
/* Goes on with a recording of ours behind a frame; later ones are taken out. NULL with a sentence
   in `error`. */
JoxRecorder *jox_recorder_go_on(const char *path, uint32_t last, JoxText *error);
/* Has all frames given so far committed. False with a sentence in `error`. */
bool jox_recorder_settle(JoxRecorder *recorder, JoxText *error);
/* Names a state number; once per number, before frames that use it. `colour`: 0, or given to it. */
void jox_recorder_state(JoxRecorder *recorder, uint32_t number, const char *machine,
                        const char *state, JoxColour colour);
/* Names a group of agents; before the first frame. */
void jox_recorder_group(JoxRecorder *recorder, uint32_t number, const char *name, JoxColour colour);
/* A wall with its name and height, which the walkable area cannot tell, as it is from a frame on:
   ring `ring` of `walls`, or none (NULL) where it is gone. Without `points` these are as before
   (wall_history.h). */
void jox_recorder_wall(JoxRecorder *recorder, uint32_t frame, uint32_t number,
                       const JoxWalls *walls, uint32_t ring, bool points);
/* A part of a body as it is from a frame on: all its parts are given again whenever one changes. */
void jox_recorder_part(JoxRecorder *recorder, uint32_t frame, uint32_t body, uint32_t part,
                       const JoxBodyLook *look);
/* Room for a frame of so many rows, to be filled and given back by jox_recorder_put. Waits while
   the writer is more than a few frames behind: nothing is dropped. */
JoxRecordRow *jox_recorder_take(JoxRecorder *recorder, uint32_t rows, uint32_t bodies,
                                JoxRecordBody **body_rows);
/* False, with a sentence in `error`, once writing has failed. */
bool jox_recorder_put(JoxRecorder *recorder, uint32_t frame, JoxText *error);
/* Writes what is left and closes. False with a sentence in `message` if anything was lost; true
   with one where another program has the file open, so that there is a file beside it. */
bool jox_recorder_close(JoxRecorder *recorder, JoxText *message);

/* The walkable area as well-known text: one POLYGON, the box about everything (or `low`, `high`),
   with a hole for each solid. */
void jox_wkt(const JoxWalls *walls, JoxV2 low, JoxV2 high, JoxText *out);
/* Of walls with outlines: a POLYGON or MULTIPOLYGON of these, with a hole for each solid that lies
   within one. */
void jox_wkt_outlines(const JoxWalls *walls, JoxText *out);

#endif
