/* Walls over time, read from one of our recordings. Table jostle_wall has a row for each wall
   number in the first frame, and later a row for each wall that is opened, closed, made or
   replaced; it holds from its frame on. A row whose points are NULL keeps the points of the row
   before; a row with empty points removes the wall. Older recordings have walls without frames.
   Trajectories and the trajectory reader own one. */
#ifndef JOX_RECORD_WALL_HISTORY_H
#define JOX_RECORD_WALL_HISTORY_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"
#include "geom/lifts.h"
#include "geom/storeys.h"
#include "geom/walls.h"

struct JoxDatabase;
typedef struct JoxWallHistory JoxWallHistory;

/* Reads the table; storeys and lifts are those of the recording. Returns NULL where the recording
   has none, as in files of other programs, or with a sentence in `why` if a wall is on a storey
   that the recording lacks. */
JoxWallHistory *jox_wall_history_read(struct JoxDatabase *db, const JoxStoreys *storeys,
                                      const JoxLift *lifts, uint32_t lift_count, JoxText *why);
/* Sets `out` to the walls of the first frame; the caller frees them. */
void jox_wall_history_first(JoxWallHistory *history, JoxWalls *out);
/* Returns the walls in a frame, open gates included, valid until the next call. Ring numbers are
   the same in all frames until walls are made or replaced. */
const JoxWalls *jox_wall_history_at(JoxWallHistory *history, int64_t frame);
/* Returns the walls in a frame without open gates, valid until the next call. */
const JoxWalls *jox_wall_history_standing(JoxWallHistory *history, int64_t frame);
/* Returns the walls in a frame that divide the floor: also the open doors of lifts. Valid until the
   next call; NULL without lifts. */
const JoxWalls *jox_wall_history_dividing(JoxWallHistory *history, int64_t frame);
/* Returns how many times walls had been made or replaced by a frame. */
uint32_t jox_wall_history_changes(const JoxWallHistory *history, int64_t frame);
void jox_wall_history_free(JoxWallHistory *history);

#endif
