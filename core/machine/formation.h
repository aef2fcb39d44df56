/* Agents that stand in rows (steering term JOX_STEER_FORMATION): batches.c reserves the entries,
   steering/formation.c fills them. */
#ifndef JOX_MACHINE_FORMATION_H
#define JOX_MACHINE_FORMATION_H

#include "machine/machine_parts.h"

/* One agent in a row. */
typedef struct JoxRowEntry {
    uint64_t row;   /* key of the row: index of the line's place, or 2^32 + id of the agent in
                       front */
    float along;    /* m: position along the row */
    uint32_t agent; /* index */
    uint32_t id;
    float spacing;        /* m */
    JoxV2 middle, across; /* middle of the row, m, and its unit direction */
} JoxRowEntry;

#endif
