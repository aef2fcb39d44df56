/* Where people and bodies went: their paths as a picture, for scenes small enough to tell them
 * apart. */
#ifndef JOX_PICTURE_PATHS_H
#define JOX_PICTURE_PATHS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/colour.h"
#include "base/sections.h"
#include "base/text.h"
#include "geom/walls.h"

enum { JOX_MOST_PATHS = 200 };

typedef struct JoxPathPoint {
    float t, x, y; /* s, m */
} JoxPathPoint;

/* Of one agent or body: `series` numbers the colour, a group of agents or all bodies. */
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

JoxPaths *jox_paths_create(void);
/* Adds a point to the path of an agent or body; beyond JOX_MOST_PATHS new ones are passed over. */
void jox_paths_add(JoxPaths *paths, uint32_t id, bool body, uint32_t series, float t, float x,
                   float y);
void jox_paths_sections(JoxPaths *paths, JoxSections *sections);
/* paths.png: a line for each, a dot where it began, a circle where it ended. `names` of the series
   of agents, which come first, and the colours that these were given (NULL: none). False with a
   sentence in `error`. */
bool jox_plot_paths(const char *folder, const JoxPaths *paths, const char *const *names,
                    const JoxColour *colours, uint32_t name_count, const JoxWalls *walls, JoxV2 low,
                    JoxV2 high, const char *title, JoxText *error);
void jox_paths_free(JoxPaths *paths);

#endif
