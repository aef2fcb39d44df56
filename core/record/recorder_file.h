/* The file that a recording is written to: a new one, or one of ours that is replaced. */
#ifndef JOX_RECORD_RECORDER_FILE_H
#define JOX_RECORD_RECORDER_FILE_H

#include <stdbool.h>
#include <stdio.h>

#include "base/database.h"
#include "base/text.h"

/* Whether an existing file is a recording of ours, which may be replaced: another program's is not.
 */
bool jox_is_recording(const char *path);
/* A new, empty file for one run alone; NULL with an error. A recording of an earlier run makes room
   for it. */
FILE *jox_claim_recording(const char *path, JoxText *error);
/* Removes a recording and what lies beside it. */
void jox_recording_remove(const char *path);
/* Whether the file that is written still has its name. */
bool jox_recording_has_name(FILE *claimed, const JoxDatabase *db);
/* Makes a recording one file, with nothing beside it, once all is committed. While another program
   has the file open this cannot be: as much as that program allows goes into the file, the rest
   stays whole beside it, and `message` says so. False where SQLite says why. */
bool jox_recording_fold(JoxDatabase *db, JoxText *message);

/* Names of the tables that a recording may have, those of older versions too, up to a NULL. */
extern const char *const jox_recording_tables[];

/* The rows of a recording of ours, as the format has them: jostle_row holds whole numbers. */
#define JOX_RECORDED_BEFORE_RADII JOX_RECORDED_WITH("")
#define JOX_RECORDED_ROWS JOX_RECORDED_WITH("radius / 1e4 AS radius, ")
#define JOX_RECORDED_WITH(more)                                                                    \
    "SELECT frame, id, x / 1e4 AS pos_x, y / 1e4 AS pos_y, facing_x / 1e3 AS ori_x, facing_y / "   \
    "1e3 AS ori_y, force / 10.0 AS force, compression / 10.0 AS compression, load / 10.0 AS "      \
    "load, " more "state, member FROM jostle_row"

/* What makes an empty file a recording, up to the first rows; it leaves a transaction open. */
extern const char jox_recording_schema[];

#endif
