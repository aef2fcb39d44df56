/* Writes positions as users read them: in plan, with the storey or stair. Scene, record, run and
   reports call it for their messages. */
#ifndef JOX_GEOM_STOREY_TEXT_H
#define JOX_GEOM_STOREY_TEXT_H

#include "base/text.h"
#include "geom/storeys.h"

/* Appends a position as "(3.5, 2.0) m"; in a world with storeys as "(3.5, 2.0) m on first", or
   "(3.5, 2.0) m on the stair north". `decimals`: of the numbers; below 0: as few as they need.
   `storeys` may be NULL. */
void jox_text_position(JoxText *out, const JoxStoreys *storeys, JoxV2 at, int decimals);
/* Returns the name of the storey, or of the stair, at a position; "" in a world without storeys. */
const char *jox_storey_name_at(const JoxStoreys *storeys, JoxV2 at);
/* Appends " on first" or " on the stair north"; nothing in a world without storeys. */
void jox_text_storey(JoxText *out, const JoxStoreys *storeys, JoxV2 at);

#endif
