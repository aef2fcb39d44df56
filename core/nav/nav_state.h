/* The state of navigation, its grid of cells, and the checks that the sub-folders of nav share; no
   other folder includes it. */
#ifndef JOX_NAV_NAV_STATE_H
#define JOX_NAV_NAV_STATE_H

#include <math.h>

#include "base/assert.h"
#include "base/number/random.h"
#include "geom/storeys.h"
#include "geom/wall_grid.h"
#include "nav/nav.h"
#include "nav/spots/spots.h"
#include "simd/isa.h"

/* The velocities v, m/s, that a constraint allows: normal . v >= offset; the normal is a unit
   vector. */
typedef struct JoxHalfPlane {
    JoxV2 normal;
    float offset;
} JoxHalfPlane;

enum { JOX_MOST_STRAYS = 64 };

/* Where an agent heads, as others look it up: its aim (unit vector; 0 while it stands), the rest of
   its way, m, and the reference to the place that it is bound for (0: none). */
typedef struct JoxHeading {
    float aim_x, aim_y, way_left;
    int32_t bound;
} JoxHeading;

/* Draws of the time gaps of JOX_LANES consecutive agents, each from -1 to 1: the agent's own, and
   those of the knots before and after the present time. Kept while the agents stay the same. */
typedef struct JoxGapDraws {
    uint32_t id[JOX_LANES]; /* ids of the agents; JOX_NO_INDEX: not drawn yet */
    double own[JOX_LANES], from[JOX_LANES], to[JOX_LANES];
} JoxGapDraws;

/* How far agents have moved, m: the greatest displacement, and its bounds along each axis, which
   are narrow where all go the same way. */
typedef struct JoxDrift {
    float farthest;
    JoxV2 least, most;
} JoxDrift;

/* Returns the drift that says nothing: searches then look everywhere until the agents are
   sorted. */
static inline JoxDrift jox_drift_unknown(void) {
    return (JoxDrift){INFINITY, {-INFINITY, -INFINITY}, {INFINITY, INFINITY}};
}

static inline JoxDrift jox_drift_of_both(JoxDrift a, JoxDrift b) {
    return (JoxDrift){jox_maxf(a.farthest, b.farthest),
                      {jox_minf(a.least.x, b.least.x), jox_minf(a.least.y, b.least.y)},
                      {jox_maxf(a.most.x, b.most.x), jox_maxf(a.most.y, b.most.y)}};
}

/* Rows of the grid that one sheet has. */
typedef struct JoxNavBand {
    float low; /* m: y of the lower edge of the first */
    uint32_t first, rows;
} JoxNavBand;

struct JoxNav {
    /* Grid of agents: cells row by row, each with its agents in consecutive order. */
    JoxV2 low;       /* m: lower corner of the first cell */
    JoxV2 per_metre; /* cells along each axis */
    uint32_t rows, columns, cell_capacity;
    uint32_t *cell_first; /* rows * columns + 1 entries */
    /* Rows of each sheet, where a world has storeys: those of all sheets follow each other, without
       rows for what lies between. NULL: one plane. */
    JoxNavBand *bands;
    const struct JoxStoreys *storeys; /* of the agents that were sorted, or NULL */
    uint32_t sorted_count, sorted_next_id;
    JoxDrift drift;      /* since the agents were sorted */
    float search_radius; /* m: mean over agents, when they were sorted */
    /* Strays: agents that crossed a periodic edge since the sort. They stand far from their cells,
       so every search that sees an edge looks at all of them. If they exceed the room, the agents
       are sorted again. */
    uint32_t strays[JOX_MOST_STRAYS + JOX_LANES], stray_count;
    uint32_t stray_ids[JOX_MOST_STRAYS]; /* their ids, by which they are found after others left */
    float stray_x[JOX_MOST_STRAYS + JOX_LANES], stray_y[JOX_MOST_STRAYS + JOX_LANES]; /* m */
    uint32_t capacity;
    JoxDrift *chunk_drift; /* per chunk of move, within a step */
    uint32_t *chunk_relaxed;
    /* Filled by walk, and read by solve where agents walk by the law: in walker_headings, of
       heading_room agents. Where none walk so, in stage memory. */
    JoxHeading *headings, *walker_headings;
    uint32_t heading_room;
    float *chunk_reach;   /* m: per chunk of walk; below 0 without walkers */
    float *unhidden2;     /* m2: jox_wall_grid_unhidden_distance2 of each agent, of
                             jox_nav_find_unhidden */
    float unhidden_reach; /* m: reach of the wall grid when unhidden2 was filled; -1: it was not */
    JoxGapDraws *gap_draws; /* draws of walk, for gap_room agents, gap_stream and gap_knots */
    uint32_t gap_room;
    uint64_t gap_stream, gap_knots[2];
    JoxWallGrid grid;
    JoxSpots spots;                     /* table of births, between two steps */
    JoxStageMemory *memory, own_memory; /* own_memory: used where none was given */
    bool literal;
    JoIsa isa;              /* instruction set of the kernels */
    const JoxWalkLaw *walk; /* belongs to the model */
};

/* Returns a step whose contact planes are NULL where contacts were not searched for. */
static inline JoxStep jox_nav_step(const JoxStep *step) {
    JoxStep own = *step;
    if (own.touched && !own.touched->agents)
        own.touched = NULL;
    return own;
}

/* The draw of agents that get nowhere, for one purpose: a random stream, and its moment, which
   changes each second. */
typedef struct JoxStuckDraw {
    uint64_t stream, moment;
} JoxStuckDraw;

static inline JoxStuckDraw jox_stuck_draw_of(const JoxTiming *timing, JoxDraw purpose) {
    return (JoxStuckDraw){jox_random_stream(timing->seed),
                          jox_random_moment((uint64_t)timing->time, purpose)};
}
/* Returns what an agent draws that has stood still for so many s: zero for the first second without
   moving JOX_STILL_REACH, then anew each second between `least` and 1, of which it takes a share
   that grows for four more seconds. */
static inline float jox_draw_of_stuck(const JoxStuckDraw *draw, uint32_t id, float still,
                                      float least) {
    const float stood = 0.25f * (still - 1.0f);
    if (!(stood > 0.0f))
        return 0.0f;
    const uint64_t bits = jox_random_of(draw->stream, id, 0, draw->moment);
    return jox_minf(stood, 1.0f) * (least + (1.0f - least) * (float)jox_random_share(bits));
}

void jox_nav_reserve(JoxNav *nav, uint32_t agents);
/* Fills `unhidden2`, unless it is known for the present positions and reach of the grid of
   walls. */
void jox_nav_find_unhidden(JoxNav *nav, const JoxStep *step);
/* Called once all agents have moved: reads the positions of the strays; drops them and the drift if
   there are too many. */
void jox_nav_place_strays(JoxNav *nav, const JoxAgents *agents);
/* Returns whether a wall stands between the point `at` and the point at `offset` from it, as far as
   the grid of walls reaches. */
static inline bool jox_nav_is_behind_wall(const JoxNav *nav, JoxV2 at, JoxV2 offset) {
    return nav->grid.first && jox_wall_grid_has_wall_between(&nav->grid, at, jox_add(at, offset));
}

/* Grain of all loops over agents. It is fixed, so that chunks are the same for any number of
   threads. */
enum { JOX_NAV_GRAIN = 256 };

/* Assertions about the cells of the grid; about the neighbours (ascending by distance, then id,
   within perception, each once, without the agent itself); about half-planes (unit normals); and
   about a solution of the linear program. */
void jox_nav_cells_check(const JoxNav *nav, const JoxAgents *agents);
void jox_neighbours_check(const JoxNeighbours *neighbours, const JoxAgents *agents);
/* Asserts that no agent has moved since the neighbours were found. */
void jox_motions_check(const JoxNeighbours *neighbours, const JoxAgents *agents);
void jox_half_planes_check(const JoxHalfPlane *half_planes, uint32_t count);
void jox_linear_program_check(const JoxHalfPlane *half_planes, uint32_t count, float speed_limit,
                              JoxV2 velocity);

/* Lists an agent that crossed a periodic edge. Any thread may call it. */
static inline void jox_nav_list_stray(JoxNav *nav, uint32_t agent) {
    const uint32_t k = __atomic_fetch_add(&nav->stray_count, 1, __ATOMIC_RELAXED);
    if (k < JOX_MOST_STRAYS)
        nav->strays[k] = agent;
}

/* ---- cells of the grid, for searches ---- */

/* Returns the row or column at a distance (m) from the grid's corner. It never falls as the
   distance grows; points outside belong to the nearest cell. */
static inline uint32_t jox_cell_along(float from_low, float per_metre, uint32_t cells) {
    float at = jox_minf(jox_maxf(0.0f, from_low * per_metre), (float)(cells - 1));
    return (uint32_t)at;
}

/* Returns the band of the sheet at y, m. */
static inline const JoxNavBand *jox_band_of(const JoxNav *nav, float y) {
    return &nav->bands[jox_sheet_of(nav->storeys, y)];
}
/* Returns the row at y, m, in a band; at an infinite y, the first or last row of all: agents may
   have gone anywhere. */
static inline uint32_t jox_row_in_band(const JoxNav *nav, const JoxNavBand *band, float y) {
    if (isinf(y))
        return y < 0.0f ? 0 : nav->rows - 1;
    return band->first + jox_cell_along(y - band->low, nav->per_metre.y, band->rows);
}
/* Returns the row at y, m, for a search about a point at `on`, m: in the band of its sheet. */
static inline uint32_t jox_row_about(const JoxNav *nav, float on, float y) {
    return nav->bands ? jox_row_in_band(nav, jox_band_of(nav, on), y)
                      : jox_cell_along(y - nav->low.y, nav->per_metre.y, nav->rows);
}
static inline uint32_t jox_row_of(const JoxNav *nav, float y) {
    return jox_row_about(nav, y, y);
}

static inline uint32_t jox_column_of(const JoxNav *nav, float x) {
    return jox_cell_along(x - nav->low.x, nav->per_metre.x, nav->columns);
}

/* Returns whether a search from the image of a point shifted along one axis by `side` (-1, 0, 1)
   periods is needed: a periodic edge lies within `wide` (m) of the point on that side. */
static inline bool jox_sees_image(float at, float origin, float period, float wide, int side) {
    if (side == 0)
        return true;
    return period > 0.0f && (side > 0 ? at - wide < origin : at + wide >= origin + period);
}

#endif
