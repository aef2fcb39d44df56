/* The reader of each format of wall files, and the limits that they share. */
#ifndef JOX_SCENE_WALL_FILE_PARTS_H
#define JOX_SCENE_WALL_FILE_PARTS_H

#include "scene/wall_files/wall_file.h"

enum {
    JOX_PLAN_MOST_POINTS = 200000, /* points of a file */
    JOX_PLAN_MOST_TESTED = 2000    /* points of a ring whose edges are tested against each other */
};
static const double JOX_PLAN_FAR = 10000.0; /* m, of a coordinate: floats resolve a millimetre */
static const float JOX_PLAN_NEAR = 0.001f;  /* m: points nearer than this are one point */

/* Read well-known text, and JuPedSim's XML: see jox_wall_file_read. */
bool jox_wall_file_read_wkt(const char *path, const char *text, size_t length,
                            const JoxWallFileOptions *options, JoxWalls *walls,
                            JoxDiagnostics *diagnostics);
bool jox_wall_file_read_jupedsim(const char *path, const char *text, size_t length,
                                 const JoxWallFileOptions *options, JoxWalls *walls,
                                 JoxDiagnostics *diagnostics);

#endif
