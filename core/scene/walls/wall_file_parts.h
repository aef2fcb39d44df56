/* What the readers of plans share. */
#ifndef JOX_SCENE_WALL_FILE_PARTS_H
#define JOX_SCENE_WALL_FILE_PARTS_H

#include "scene/walls/wall_file.h"

/* Points of a file; points of a ring that is tested against itself (every edge with every other).
 */
enum { JOX_PLAN_MOST_POINTS = 200000, JOX_PLAN_MOST_TESTED = 2000 };
static const double JOX_PLAN_FAR = 10000.0; /* m: floats still resolve a millimetre */
static const float JOX_PLAN_NEAR = 0.001f;  /* m: points that are one */

bool jox_wall_file_read_wkt(const char *path, const char *text, size_t length,
                            const JoxWallFileOptions *options, JoxWalls *walls,
                            JoxDiagnostics *diagnostics);
bool jox_wall_file_read_xml(const char *path, const char *text, size_t length,
                            const JoxWallFileOptions *options, JoxWalls *walls,
                            JoxDiagnostics *diagnostics);

#endif
