/* Lifts of a recording, and their cars over time. Table jostle_car has a row for each car in the
   first frame, and later one for each car that has changed; it holds from its frame on.
   Trajectories and the trajectory reader own one. */
#ifndef JOX_RECORD_LIFT_HISTORY_H
#define JOX_RECORD_LIFT_HISTORY_H

#include "base/text.h"
#include "geom/lifts.h"

struct JoxDatabase;
typedef struct JoxLiftHistory JoxLiftHistory;

/* Reads the lifts; `storeys` are those of the recording, laid out. Returns NULL where there are
   none, or with a sentence in `why` that names the table, row and column if they are damaged. */
JoxLiftHistory *jox_lift_history_read(struct JoxDatabase *db, const JoxStoreys *storeys,
                                      JoxText *why);
/* Returns the lifts, laid out, and sets their number; NULL and 0 for NULL. */
const JoxLift *jox_lift_history_lifts(const JoxLiftHistory *history, uint32_t *count);
/* Returns the cars in a frame, one for each lift, valid until the next call; NULL for NULL. */
const JoxCarLook *jox_lift_history_cars(JoxLiftHistory *history, int64_t frame);
void jox_lift_history_free(JoxLiftHistory *history);

#endif
