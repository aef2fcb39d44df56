/* The file on disk that a recording is written to: claiming its path, the schema, and closing it.
   recorder.c calls it; readers use the list of tables and the queries. */
#ifndef JOX_RECORD_RECORDER_SCHEMA_H
#define JOX_RECORD_RECORDER_SCHEMA_H

#include <stdbool.h>
#include <stdio.h>

#include "base/database.h"
#include "base/text.h"

/* Returns whether a file is one of our recordings, which may be replaced; other files may not. */
bool jox_is_recording(const char *path);
/* Creates the file of a new recording and returns it open and empty, with a lock against other
   runs; an earlier recording at that path is removed. Returns NULL with a sentence in `error` on
   failure. */
FILE *jox_recording_claim(const char *path, JoxText *error);
/* Removes a recording and the journal files of SQLite beside it. */
void jox_recording_remove(const char *path);
/* Returns whether the file being written still has its path: it may have been removed or
   replaced. */
bool jox_recording_has_name(FILE *claimed, const JoxDatabase *db);
/* Moves the write-ahead log into the recording, so that one file is left; call it after the last
   commit. While another program has the file open, part of the log stays in a file beside it and
   `message` says so. Returns false on an error of SQLite, which sqlite3_errmsg explains. */
bool jox_recording_merge_log(JoxDatabase *db, JoxText *message);

/* Names of all tables of recordings, including older versions; ends with NULL. */
extern const char *const jox_recording_tables[];

/* Pose of a state that is drawn as lying down. */
#define JOX_RECORDED_LIES "lies"
/* Key of the table metadata: what the scene shows besides, as JSON. */
#define JOX_RECORDED_LOOK "jostle_look"

/* Query for the rows of one of our recordings in the units of the JuPedSim format: jostle_row
   stores scaled integers. Older recordings have no falls, still older ones no torsos, then no
   radii. */
#define JOX_RECORDED_BEFORE_RADII JOX_RECORDED_WITH("")
#define JOX_RECORDED_BEFORE_TORSOS JOX_RECORDED_WITH("radius / 1e4 AS radius, ")
#define JOX_RECORDED_TORSOS                                                                        \
    "radius / 1e4 AS radius, chest / 1e3 AS chest, breadth / 1e4 AS breadth, depth / 1e4 AS "      \
    "depth, "
#define JOX_RECORDED_BEFORE_FALLS JOX_RECORDED_WITH(JOX_RECORDED_TORSOS)
#define JOX_RECORDED_ROWS JOX_RECORDED_WITH(JOX_RECORDED_TORSOS "fallen / 10.0 AS fallen, ")
/* Recordings of storeys have two more columns. */
#define JOX_RECORDED_STOREY_ROWS                                                                   \
    JOX_RECORDED_WITH(JOX_RECORDED_TORSOS "fallen / 10.0 AS fallen, storey, stair, ")
#define JOX_RECORDED_WITH(more)                                                                    \
    "SELECT frame, id, x / 1e4 AS pos_x, y / 1e4 AS pos_y, facing_x / 1e3 AS ori_x, facing_y / "   \
    "1e3 AS ori_y, force / 10.0 AS force, compression / 10.0 AS compression, load / 10.0 AS "      \
    "load, " more "state, member FROM jostle_row"

/* Statements that create the tables in an empty file. The transaction that they begin is left open
   for the first rows. */
extern const char jox_recording_schema[];
/* The same for a recording of storeys: people, bodies and walls have the number of their storey and
   1 + that of their stair, 0 on a storey. */
extern const char jox_recording_storey_schema[];
/* Keys of the table metadata: position along y at which sheets of storeys begin, and the distance
   from one to the next, m. Only jostle_look has positions. */
#define JOX_RECORDED_ORIGIN "jostle_origin"
#define JOX_RECORDED_PITCH "jostle_pitch"

#endif
