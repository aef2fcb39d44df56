/* Walls from files: well-known text (OGC 06-103r4, section 7), the geometry of JuPedSim as XML and
   that of recordings. */
#ifndef JOX_SCENE_WALL_FILE_H
#define JOX_SCENE_WALL_FILE_H

#include <stdbool.h>

#include "base/format/diag.h"
#include "geom/walls.h"

typedef struct JoxWallFileOptions {
    double unit;               /* m, of the file's lengths */
    double origin_x, origin_y; /* of the file, in its lengths: becomes 0, 0 */
    float height;              /* m, of every wall */
} JoxWallFileOptions;

/* Adds the walls of a text to `walls`. A POLYGON is what can be walked: its outer ring is a thin
   closed wall, its holes are solid. MULTIPOLYGON and GEOMETRYCOLLECTION are several of them, a
   LINESTRING or MULTILINESTRING thin walls. XML is the geometry of JuPedSim: polygons of subrooms
   are thin walls, obstacles are solid, transitions are walls named `door-ID` that are open at
   first. False, and some walls, with an error at its line and column in `path`. */
bool jox_wall_file_read(const char *path, const char *text, size_t length,
                        const JoxWallFileOptions *options, JoxWalls *walls,
                        JoxDiagnostics *diagnostics);
/* The text in the table `geometry` of a recording (JuPedSim's SQLite format); NULL with an error.
   To be freed by jox_free. */
char *jox_wall_file_recorded(const char *path, JoxDiagnostics *diagnostics);

#endif
