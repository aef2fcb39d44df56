/* Fields over storeys: the rows of all sheets follow each other in one grid, with a gap between
   them, so that points are looked up where their sheet lies in it; and cells near a seam that
   repeat cells of the other side. Only field*.c include this. */
#ifndef JOX_GEOM_FIELD_SHEETS_H
#define JOX_GEOM_FIELD_SHEETS_H

#include "geom/field/field_parts.h"

/* Two cells at the same point of the plan, on both sides of a seam: the way from `copy`, which lies
   beyond the seam, is that of `of`. */
typedef struct JoxFieldTwin {
    int of, copy;
} JoxFieldTwin;
typedef struct JoxFieldTwins {
    JoxFieldTwin *items; /* by `of` */
    uint32_t count;
} JoxFieldTwins;

/* Lays the sheets out in the grid of a field, whose cells have a size; sets its rows. */
void jox_field_lay_sheets(JoxField *field, const JoxStoreys *storeys);
/* Copies the standing walls, the goal, or the crowd of a field, moved to where their sheets lie in
   the grid. */
void jox_field_pack_walls(const JoxField *field, const JoxWalls *walls, JoxWalls *out);
JoxPlace *jox_field_pack_goal(const JoxField *field, const JoxPlace *places, uint32_t place,
                              uint32_t *count);
void jox_field_pack_crowd(const JoxField *field, const JoxFieldCrowd *crowd, JoxFieldCrowd *out);
/* Narrows a range of rows to the sheet in whose rows y lies, m in the grid. */
void jox_field_keep_to_sheet(const JoxField *field, float y, int *first, int *last);
/* Blocks the nodes of cells that are not floor: between sheets, in the footprints of stairs on
   storeys, and round stairs, but for cells that repeat floor beyond a seam. */
void jox_field_block_beyond_floor(JoxFieldWork *work);
/* Slows the floor of stairs down. */
void jox_field_slow_stairs(JoxFieldWork *work);
/* Lists the cells that repeat others over seams; `crossed`: over seams that may be crossed. The
   caller frees the items. */
JoxFieldTwins jox_field_list_twins(const JoxFieldWork *work, bool crossed);

#endif
