/* The walls of a recording of ours over time. Its table jostle_wall has a row for each wall, by its
   number, as it is from a frame on: for all of them in the first frame, later for those that were
   opened, closed, made or replaced. A row without points keeps those of the row before it; a row
   whose points are "" takes its wall away. Older recordings have walls of one time alone. */
#ifndef JOX_RECORD_WALL_HISTORY_H
#define JOX_RECORD_WALL_HISTORY_H

#include <stdbool.h>
#include <stdint.h>

#include "geom/walls.h"

struct JoxDatabase;
typedef struct JoxWallHistory JoxWallHistory;

/* NULL where the recording has none, as those of other programs. */
JoxWallHistory *jox_wall_history_read(struct JoxDatabase *db);
/* Walls as they are in the first frame, for the caller to free. */
void jox_wall_history_first(JoxWallHistory *history, JoxWalls *out);
/* Walls as they are in a frame of this number, gates that are open among them; hold until the next
   call. Rings have the same numbers in all frames until walls are made or replaced. */
const JoxWalls *jox_wall_history_at(JoxWallHistory *history, int64_t frame);
/* Those of them that stand, likewise. */
const JoxWalls *jox_wall_history_standing(JoxWallHistory *history, int64_t frame);
/* How often walls had been made or replaced by a frame. */
uint32_t jox_wall_history_changes(const JoxWallHistory *history, int64_t frame);
void jox_wall_history_free(JoxWallHistory *history);

#endif
