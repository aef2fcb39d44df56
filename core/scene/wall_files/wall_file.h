/* Reads walls from the text of a file: well-known text (OGC 06-103r4, section 7), the XML geometry
   of JuPedSim, or well-known text in a recording. Called for walls of a scene that name a file. */
#ifndef JOX_SCENE_WALL_FILE_H
#define JOX_SCENE_WALL_FILE_H

#include <stdbool.h>

#include "base/format/diag.h"
#include "geom/walls.h"

typedef struct JoxWallFileOptions {
    double unit;               /* m, of the file's lengths */
    double origin_x, origin_y; /* the file's point, in its lengths, that becomes 0, 0 */
    float height;              /* height of walls that have none of their own, m */
} JoxWallFileOptions;

/* Adds the walls of a text to `walls`. A POLYGON is floor that can be walked on: its outer ring
   becomes a thin closed wall, its holes become solid. MULTIPOLYGON and GEOMETRYCOLLECTION are
   several geometries; LINESTRING and MULTILINESTRING become thin walls. XML is a geometry of
   JuPedSim: polygons of subrooms become thin walls, obstacles become solid, transitions become
   walls named `door-ID` that are open at first. False with an error at its line and column in
   `path`; `walls` may have got some walls. */
bool jox_wall_file_read(const char *path, const char *text, size_t length,
                        const JoxWallFileOptions *options, JoxWalls *walls,
                        JoxDiagnostics *diagnostics);
/* Returns the text in the table `geometry` of a recording (SQLite, JuPedSim's format), to be freed
   by jox_free; NULL with an error. */
char *jox_wall_file_read_recorded(const char *path, JoxDiagnostics *diagnostics);

#endif
