/* A plot of the paths of people and bodies, drawn by gnuplot, for scenes small enough to tell
   them apart. run_report.c collects the points during a run. */
#ifndef JOX_PICTURE_PATHS_H
#define JOX_PICTURE_PATHS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/colour.h"
#include "base/sections.h"
#include "base/text.h"
#include "geom/storeys.h"
#include "geom/walls.h"

enum { JOX_MOST_PATHS = 200 };

typedef struct JoxPathPoint {
    float t, x, y; /* t in s, x and y in m */
} JoxPathPoint;

/* Path of one agent or body. `series` selects the colour: the agent's group; unused for bodies,
   which share one. */
typedef struct JoxWalkedPath {
    uint32_t id, series;
    bool body;
    JoxPathPoint *points;
    uint32_t count, capacity;
} JoxWalkedPath;

typedef struct JoxPaths {
    JoxWalkedPath *items;
    uint32_t count, capacity;
} JoxPaths;

/* Creates an empty set of paths; jox_paths_free releases it. */
JoxPaths *jox_paths_create(void);
/* Appends a point (s, m) to the path of an agent or body. Once there are JOX_MOST_PATHS paths,
   no new ones begin. */
void jox_paths_add(JoxPaths *paths, uint32_t id, bool body, uint32_t series, float t, float x,
                   float y);
/* Lists the paths as sections of state, so that a resumed run goes on with them. */
void jox_paths_sections(JoxPaths *paths, JoxSections *sections);
/* Writes paths.csv, paths.plt and paths.png: per path a line, a dot at its start, a circle at
   its end. `names` and `colours` (NULL: none given) are of the agents' groups, indexed by
   `series`; `low` and `high` are the area shown, m, in plan. With storeys each is drawn in a panel
   of its own, as on maps. Returns false with a sentence in `error`. */
bool jox_plot_paths(const char *folder, const JoxPaths *paths, const char *const *names,
                    const JoxColour *colours, uint32_t name_count, const JoxWalls *walls,
                    const JoxStoreys *storeys, JoxV2 low, JoxV2 high, const char *title,
                    JoxText *error);
void jox_paths_free(JoxPaths *paths);

#endif
