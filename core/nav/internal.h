/* What the files of nav share. */
#ifndef JOX_NAV_INTERNAL_H
#define JOX_NAV_INTERNAL_H

#include "base/assert.h"
#include "geom/wall_grid.h"
#include "nav/nav.h"
#include "nav/spots/spots.h"
#include "simd/isa.h"

/* n . v >= offset, n a unit vector: the velocities that a constraint allows, m/s. */
typedef struct JoxHalfPlane {
    JoxV2 normal;
    float offset;
} JoxHalfPlane;

enum { JOX_MOST_STRAYS = 64 };

/* How an agent heads, by the walking law: its aim, and what of its way is left to where it is
   bound. */
typedef struct JoxHeading {
    float aim_x, aim_y, way; /* m */
    int32_t bound;
} JoxHeading;

/* What the time gaps of agents are drawn by who stand side by side, each from -1 to 1: their own,
   and that of the knots before and after now. It is kept for as long as they are the same agents.
 */
typedef struct JoxGapDraws {
    uint32_t of[JOX_LANES]; /* ids; JOX_NO_INDEX: not drawn */
    double own[JOX_LANES], from[JOX_LANES], to[JOX_LANES];
} JoxGapDraws;

/* How agents have moved, m: the farthest that any of them has, and within which bounds along each
   axis: few where all go the same way. */
typedef struct JoxDrift {
    float farthest;
    JoxV2 least, most;
} JoxDrift;

/* Where it is not known: whoever looks for others looks everywhere, until the agents are sorted. */
static inline JoxDrift jox_drift_unknown(void) {
    return (JoxDrift){INFINITY, {-INFINITY, -INFINITY}, {INFINITY, INFINITY}};
}

static inline JoxDrift jox_drift_of_both(JoxDrift a, JoxDrift b) {
    return (JoxDrift){jox_maxf(a.farthest, b.farthest),
                      {jox_minf(a.least.x, b.least.x), jox_minf(a.least.y, b.least.y)},
                      {jox_maxf(a.most.x, b.most.x), jox_maxf(a.most.y, b.most.y)}};
}

struct JoxNav {
    /* Grid of agents: cells, row by row, each with its agents one after the other. */
    JoxV2 low;       /* m, corner of the first cell */
    JoxV2 per_metre; /* cells along each axis */
    uint32_t rows, columns, cell_capacity;
    uint32_t *cell_first; /* rows * columns + 1 */
    uint32_t sorted_count, sorted_next_id;
    JoxDrift drift; /* since */
    float search;   /* m, what people searched on average when they were sorted */
    /* Who went over a periodic edge since: far from where their cells are, and looked at by all who
       see an edge. More than there is room for: the agents are sorted. */
    uint32_t strays[JOX_MOST_STRAYS + JOX_LANES], stray_count;
    float stray_x[JOX_MOST_STRAYS + JOX_LANES], stray_y[JOX_MOST_STRAYS + JOX_LANES]; /* m */
    uint32_t capacity;
    JoxDrift *chunk_drift; /* in a step, per chunk of move */
    uint32_t *chunk_relaxed;
    JoxHeading *headings;   /* of walk, and of solve where somebody walks */
    float *chunk_reach;     /* m: of walk; below 0 where nobody walks */
    float *clear2;          /* m2: jox_wall_grid_clear2 of each, by walk, or by solve */
    float clear_reach;      /* m: of the grid by which clear2 is known; -1: it is not */
    JoxGapDraws *gap_draws; /* of walk; of so many agents, by this stream and for these knots */
    uint32_t gap_room;
    uint64_t gap_stream, gap_knots[2];
    JoxWallGrid grid;
    JoxSpots spots;                     /* between two steps, of births */
    JoxStageMemory *memory, own_memory; /* own: where it was given none */
    bool literal;
    JoIsa isa;              /* of the kernels */
    const JoxWalkLaw *walk; /* the model's */
};

void jox_nav_reserve(JoxNav *nav, uint32_t agents);
/* Once all have moved: where those are who went over periodic edges since they were sorted. */
void jox_nav_place_strays(JoxNav *nav, const JoxAgents *agents);
/* Whether a wall, as far as the grid reaches, stands between a point and what is at `offset`. */
static inline bool jox_nav_is_behind_wall(const JoxNav *nav, JoxV2 at, JoxV2 offset) {
    return nav->grid.first && jox_wall_grid_separates(&nav->grid, at, jox_add(at, offset));
}

/* Grain of every loop over agents: fixed, so that chunks are the same for any number of threads. */
enum { JOX_NAV_GRAIN = 256 };

/* ORCA (van den Berg et al. 2011): the half-plane for an agent at relative position p (m) of the
   other, relative velocity v = own - other (m/s), summed radii R (m), horizon tau (s), own velocity
   and the share of the correction taken. Overlapping discs are to part within dt. `away` is the
   direction taken where the centres coincide. */
JoxHalfPlane jox_orca_half_plane(JoxV2 p, JoxV2 v, float radius, float tau, float dt, JoxV2 own,
                                 float share, JoxV2 away);
/* Half-planes of the wall edges near an agent; returns how many, at most `most`. */
uint32_t jox_orca_walls(const JoxWallGrid *grid, JoxV2 position, JoxV2 velocity, float radius,
                        float tau, float range, JoxHalfPlane *out, uint32_t most);
/* Half-planes of the bodies that agent i sees, but for those that it touches (NULL: none); returns
   how many, at most `most`. */
uint32_t jox_orca_objects(const JoxNav *nav, const JoxAgents *a, uint32_t i,
                          const JoxObjects *objects, const JoxContactPlanes *touched,
                          float planning_time, JoxHalfPlane *out, uint32_t most);

/* perceive.c: how far anybody sees at most, m: less than half a period, so that nobody is seen from
   two sides; INFINITY without. */
float jox_nav_sight(const JoxAgents *agents);

/* Shares of the preferred velocity of an agent that stands before others: at first it wants that
   much more to its right. Where it has not moved for some seconds, up to JOX_ASIDE_RIGHT in
   addition, and up to JOX_ASIDE_BACK less of its way: symmetric crowds lock in an arch that all
   agents have to leave by different angles. */
#define JOX_RIGHT_SHARE 0.25f
#define JOX_ASIDE_RIGHT 1.0f
#define JOX_ASIDE_BACK 1.2f

/* The velocity of at most `speed_limit` nearest to `wanted` that meets all half-planes. The first
   `hard` half-planes are walls. Returns true if there is one; otherwise *velocity minimises the
   greatest violation of the others with the walls kept, and *relaxed tells if even the walls had to
   give. */
bool jox_linear_program_solve(const JoxHalfPlane *half_planes, uint32_t count, uint32_t hard,
                              float speed_limit, JoxV2 wanted, JoxV2 *velocity, bool *relaxed);

/* Assertions about the cells of the grid, the neighbours (each agent's ascend by
   distance, then id, are within its perception, and it is none of them), half-planes (normals are
   unit vectors), and a solution of the linear program. */
void jox_nav_cells_check(const JoxNav *nav, const JoxAgents *agents);
void jox_neighbours_check(const JoxNeighbours *neighbours, const JoxAgents *agents);
/* Nobody has moved since they were perceived. */
void jox_motions_check(const JoxNeighbours *neighbours, const JoxAgents *agents);
void jox_half_planes_check(const JoxHalfPlane *half_planes, uint32_t count);
void jox_linear_program_check(const JoxHalfPlane *half_planes, uint32_t count, float speed_limit,
                              JoxV2 velocity);

/* Notes that an agent went over a periodic edge; by any thread. */
static inline void jox_nav_stray(JoxNav *nav, uint32_t agent) {
    const uint32_t k = __atomic_fetch_add(&nav->stray_count, 1, __ATOMIC_RELAXED);
    if (k < JOX_MOST_STRAYS)
        nav->strays[k] = agent;
}

/* ---- cells of the grid, for those who search it ---- */

/* Rows and columns never fall as y and x grow. What lies outside counts to the nearest cell. */
static inline uint32_t jox_cell_along(float from_low, float per_metre, uint32_t cells) {
    float at = jox_minf(jox_maxf(0.0f, from_low * per_metre), (float)(cells - 1));
    return (uint32_t)at;
}

static inline uint32_t jox_row_of(const JoxNav *nav, float y) {
    return jox_cell_along(y - nav->low.y, nav->per_metre.y, nav->rows);
}

static inline uint32_t jox_column_of(const JoxNav *nav, float x) {
    return jox_cell_along(x - nav->low.x, nav->per_metre.x, nav->columns);
}

/* Whether the image of a point that is shifted along one axis by `side` (-1, 0, 1) periods has to
   be looked at: it lies beyond a periodic edge, which is within `wide`. */
static inline bool jox_sees_image(float at, float origin, float period, float wide, int side) {
    if (side == 0)
        return true;
    return period > 0.0f && (side > 0 ? at - wide < origin : at + wide >= origin + period);
}

#endif
