/* Who stands in a row, and where: what group.c reserves and rows.c fills. */
#ifndef JOX_MACHINE_ROWS_H
#define JOX_MACHINE_ROWS_H

#include "machine/internal.h"

/* One who stands in a row. */
typedef struct JoxRowEntry {
    uint64_t row;   /* the line's place, or the one before it: equal in a row */
    float along;    /* how far along the row it is, m */
    uint32_t agent; /* index */
    uint32_t id;
    float spacing;        /* m */
    JoxV2 middle, across; /* of the row: its middle, and its direction */
} JoxRowEntry;

#endif
