/* Parts of a field, and of the work of making one; only the files field*.c include this. A cell
   away from walls has one direction, at its centre, and points between four centres interpolate. A
   cell near a wall has a patch of 3 x 3 samples instead. What each sample sees is found when the
   field is made, so that lookups need no test of sight. While a field is made, every walkable cell
   has a node: the sample (the centre, if that keeps the clearance) at which fast marching computes
   the time to the goal. */
#ifndef JOX_GEOM_FIELD_PARTS_H
#define JOX_GEOM_FIELD_PARTS_H

#include "geom/field/field.h"

enum { JOX_FIELD_SIDE = 3, JOX_FIELD_SAMPLES = 9, JOX_FIELD_MIDDLE = 4 };
enum { JOX_FIELD_CLEAR = -1, JOX_FIELD_PLAIN = -2 }; /* in place of a patch: interpolate; do not */
enum { JOX_FIELD_BLOCKED = 9 };                      /* in place of a node */

typedef struct JoxFieldCell {
    float length; /* length of the way from the node, m; INFINITY: no way */
    float x, y;   /* direction of the way; shorter than 1 within JOX_FIELD_CLOSE of the goal */
    int32_t patch;
} JoxFieldCell;

typedef struct JoxFieldPatch {
    float x[JOX_FIELD_SAMPLES], y[JOX_FIELD_SAMPLES], length[JOX_FIELD_SAMPLES];
    uint32_t first, count; /* range in refs: edges near the cell */
    uint16_t cut;          /* bits: samples whose ninth of the cell an edge crosses */
    uint16_t on_edge;      /* bits: samples on an edge, on neither of its sides; not used */
} JoxFieldPatch;

/* Visibility from a sample of a patch past walls: the bits below, one value per sample. */
typedef uint32_t JoxFieldSight;
enum {
    JOX_SIGHT_NODES = 0x000f,   /* bits: which of the four surrounding nodes it sees */
    JOX_SIGHT_OPEN = 0x0010,    /* no edge is near enough to block the way ahead */
    JOX_SIGHT_BY_WALL = 0x0020, /* an edge is within the clearance; the patch holds the direction
                                   off it */
    JOX_SIGHT_SOLID = 0x0040,   /* inside a solid near its edge; the patch holds the direction
                                   out */
    JOX_SIGHT_DEEP = 0x0080,    /* inside a solid, with no edge near */
    /* One bit each for the cell's own node and those of its ring: whether visibility is known, and
       whether the sample sees the node. Found on demand. */
    JOX_SIGHT_KNOWN = 1 << 8,
    JOX_SIGHT_SEEN = 1 << 17
};

typedef struct JoxFieldEdge {
    JoxV2 a, b;
    uint32_t solid; /* 1: solid matter on the left */
} JoxFieldEdge;

/* Where a sheet lies in the grid of a field over storeys. A point of the plan is moved by `shift`
   along y. */
typedef struct JoxFieldSheet {
    float low, high; /* m in plan, along y */
    float shift;     /* m */
    int first_row, rows;
    int to_row; /* rows by which it is moved: shift / size */
} JoxFieldSheet;
#define JOX_FIELD_SEAM_REACH 3.0f /* m: walls this near to a seam are seen from its other side */

struct JoxField {
    JoxV2 low;
    float size, clearance; /* m */
    int columns, rows;
    JoxFieldCell *cells;
    JoxFieldPatch *patches;
    uint32_t patch_count, patch_capacity;
    JoxFieldEdge *edges;
    uint32_t edge_count;
    uint32_t *refs; /* edges near each cell, cell by cell */
    uint32_t ref_count;
    const JoxStoreys *storeys; /* borrowed; NULL: one plane */
    JoxFieldSheet *sheets;     /* one per sheet; NULL: one plane */
    /* By cell: 1 + the number of the stop at which the way takes its first lift, counted over all
       lifts; 0: by none. NULL: made without lifts. */
    uint16_t *first_stops;
};

/* Returns where a point lies in the grid. */
static inline JoxV2 jox_field_pack(const JoxField *f, JoxV2 at) {
    if (!f->sheets)
        return at;
    const uint32_t k = jox_sheet_of(f->storeys, at.y);
    const JoxFieldSheet *sheet = &f->sheets[k];
    const float plan = at.y - (float)k * f->storeys->pitch;
    return (JoxV2){at.x, jox_clampf(plan, sheet->low, sheet->high) + sheet->shift};
}

/* Along one axis, a sample's coordinate, and the two cell centres around it: index of the first,
   and the weight of each. */
typedef struct JoxFieldAxis {
    float at; /* m */
    int first;
    float share[2];
} JoxFieldAxis;

/* The effect of walls on each cell, which is cached from field to field. */
typedef struct JoxFieldWalled {
    uint32_t *first;  /* range of cell i in refs: first[i] to first[i + 1] */
    uint16_t *solid;  /* bits: samples inside solids */
    uint8_t *node;    /* sample, or JOX_FIELD_BLOCKED */
    float *x, *y;     /* position of the node, m; of the centre if blocked */
    uint8_t *links;   /* bits: ring neighbours whose node is visible from this one */
    uint8_t *corners; /* bit t: no wall in the triangle with ring neighbours t and t + 1 */
    bool *even;       /* the nodes of this cell and its neighbours are at their cells' centres */
    /* Cells with patches, in the order of f->patches, and the visibility from their samples. */
    int32_t *patched;
    JoxFieldSight *sight;
    JoxFieldAxis *columns, *rows; /* JOX_FIELD_SIDE entries per column or row */
} JoxFieldWalled;

typedef struct JoxFieldWork {
    JoxField *f;
    int count;       /* number of cells */
    bool exact;      /* cell sizes are equal but for negligible rounding */
    float *near;     /* while marking: lower bound of each node's distance from walls, m */
    float *time;     /* time of the way from the node, s, at 1 m/s on free floor */
    float *slowness; /* s/m at the node */
    const JoxFieldLifts *lifts; /* NULL: ways lead by none */
    JoxFieldWalled walled;
} JoxFieldWork;

/* In cells: nearer to the goal than this, direction vectors of nodes have a length proportional to
   the distance, so that interpolation yields the exact way, and zero at the goal. More than a
   cell's diagonal. */
#define JOX_FIELD_CLOSE 1.5f
/* Interpolated vectors this short lie within a tenth of a cell of the goal. */
#define JOX_FIELD_ARRIVED (0.1f / JOX_FIELD_CLOSE)

/* Offsets of the ring of eight neighbours, counter-clockwise from the east. */
extern const int JOX_FIELD_RING[8][2];

static inline JoxV2 jox_field_sample(const JoxField *f, int cell, int sample) {
    float x = (float)(cell % f->columns) + ((float)(sample % JOX_FIELD_SIDE) + 0.5f) / 3.0f;
    float y = (float)(cell / f->columns) + ((float)(sample / JOX_FIELD_SIDE) + 0.5f) / 3.0f;
    return (JoxV2){f->low.x + x * f->size, f->low.y + y * f->size};
}
static inline JoxV2 jox_field_node(const JoxFieldWork *w, int cell) {
    return (JoxV2){w->walled.x[cell], w->walled.y[cell]};
}
/* Returns the neighbour on the ring, -1 beyond the border. */
static inline int jox_field_next_to(const JoxField *f, int column, int row, int ring) {
    int c = column + JOX_FIELD_RING[ring][0], r = row + JOX_FIELD_RING[ring][1];
    return c < 0 || r < 0 || c >= f->columns || r >= f->rows ? -1 : r * f->columns + c;
}
static inline int jox_field_next(const JoxField *f, int cell, int ring) {
    return jox_field_next_to(f, cell % f->columns, cell / f->columns, ring);
}
static inline bool jox_field_has_edges(const JoxFieldWork *w, int cell) {
    return w->walled.first[cell] != w->walled.first[cell + 1];
}

/* Returns by how much the way is shorter `off` from a node than at it, by the slope there, m. */
static inline float jox_field_slope(const JoxFieldCell *cell, JoxV2 off) {
    return jox_dot(jox_unit((JoxV2){cell->x, cell->y}), off);
}

/* Finds the first and last column or row that an interval touches, clamped to the grid; first >
   last if none. */
void jox_field_span(float from, float to, float low, float size, int most, int *first, int *last);
/* Returns the distance of a point to the nearest of the edges refs[first .. last - 1], m, INFINITY
   for none; `at` and `edge`, unless NULL, receive the nearest point and edge. */
float jox_field_nearest(const JoxField *f, uint32_t first, uint32_t last, JoxV2 p, JoxV2 *at,
                        uint32_t *edge);
/* Returns whether the segment p-q keeps `least` m from every edge; from edges closer than that to
   p, nine tenths of p's distance. With least = 0 it only must not cross an edge. */
bool jox_field_sees(const JoxFieldWork *w, JoxV2 p, JoxV2 q, float least);
/* Does the same for a sample or node p of a cell and a point no farther away than adjacent nodes:
   only the cell's own edges can block it. `least` must not exceed the clearance. */
bool jox_field_sees_near(const JoxFieldWork *w, int cell, JoxV2 p, JoxV2 q, float least);
/* Returns whether p and q see each other for sure, being this far from the nearest walls. */
static inline bool jox_field_surely_sees(const JoxFieldWork *w, float p_near, float q_near, JoxV2 p,
                                         JoxV2 q, float least) {
    const float spare = 0.02f * w->f->size; /* margin for rounding */
    return w->exact && p_near + q_near > jox_length(jox_sub(q, p)) + 2.0f * least + spare;
}

/* Computes edges by cell, solids, nodes, links, slowness near walls, and visibility of patches. */
void jox_field_mark(JoxFieldWork *work, const JoxWalls *walls, JoxFieldMarks **marks);
/* One of the nine samples of a cell, with its position on both axes. */
typedef struct JoxFieldSpot {
    int cell, column, row, sample;
    const JoxFieldAxis *x, *y;
} JoxFieldSpot;
static inline JoxFieldSpot jox_field_spot(const JoxFieldWork *w, int cell, int sample) {
    const int column = cell % w->f->columns, row = cell / w->f->columns;
    return (JoxFieldSpot){.cell = cell,
                          .column = column,
                          .row = row,
                          .sample = sample,
                          .x =
                              &w->walled.columns[column * JOX_FIELD_SIDE + sample % JOX_FIELD_SIDE],
                          .y = &w->walled.rows[row * JOX_FIELD_SIDE + sample / JOX_FIELD_SIDE]};
}
/* Returns jox_field_sample of a spot. */
static inline JoxV2 jox_field_spot_at(const JoxFieldSpot *spot) {
    return (JoxV2){spot->x->at, spot->y->at};
}
/* One of the four nodes around a sample, -1 if missing or without weight, and its weight. */
typedef struct JoxFieldAbout {
    int cell;
    float weight;
} JoxFieldAbout;
static inline JoxFieldAbout jox_field_about(const JoxFieldWork *w, const JoxFieldSpot *spot,
                                            int k) {
    const JoxField *f = w->f;
    const int c = spot->x->first + (k & 1), r = spot->y->first + (k >> 1),
              cell = r * f->columns + c;
    const float weight = spot->x->share[k & 1] * spot->y->share[k >> 1];
    const bool within = c >= 0 && r >= 0 && c < f->columns && r < f->rows;
    const bool counts = within && w->walled.node[cell] != JOX_FIELD_BLOCKED && weight > 1e-4f;
    return (JoxFieldAbout){counts ? cell : -1, weight};
}
/* field_sight.c: decides which cells are interpolated or have a patch, and computes all of patches
   that does not depend on the goal: visibility from samples, and directions out of solids. */
void jox_field_look_about(JoxFieldWork *work);
/* field_walls_cache.c: recall uses the cache if it is of the same edges and grid, else returns
   false. Remember fills it; the cache then owns w->walled. */
bool jox_field_recall(JoxFieldWork *work, const JoxFieldMarks *marks);
void jox_field_remember(const JoxFieldWork *work, JoxFieldMarks **marks);
/* Adds slowness where people are held up; NULL: nobody is. */
void jox_field_crowd(JoxFieldWork *work, const JoxFieldCrowd *crowd);
/* Kernel of jox_field_crowd. `open`: 1 for walkable cells, else 0. */
typedef void JoxFieldSpreadKernel(JoxFieldWork *work, const JoxFieldCrowd *crowd,
                                  const float *open);
#define X(name, isa) JoxFieldSpreadKernel jox_field_spread_##name;
JOX_ISAS(X)
#undef X
/* Computes times, lengths and directions of all nodes. */
void jox_field_march(JoxFieldWork *work, const JoxPlace *places, uint32_t place);
/* Share of the clearance that ways from samples to nodes keep, as between nodes. */
#define JOX_FIELD_KEEP 0.85f
/* In cells: how far ahead a sample checks its way. */
#define JOX_FIELD_AHEAD 0.75f
/* Computes the ways from samples of patches. */
void jox_field_patch(JoxFieldWork *work);

#endif
