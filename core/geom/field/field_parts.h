/* The parts of a field and of the work of making one; for the files field*.c alone.
   A cell away from walls has one direction, at its centre; points between four centres interpolate
   them. A cell near a wall has a patch of 3 x 3 samples instead. What each sample can see is found
   when the field is made, so that looking up a direction needs no test of sight. While a field is
   made, every cell that can be walked has a node: the sample (its centre, if that keeps the
   clearance) at which fast marching computes the time to the goal. */
#ifndef JOX_GEOM_FIELD_PARTS_H
#define JOX_GEOM_FIELD_PARTS_H

#include "geom/field/field.h"

enum { JOX_FIELD_SIDE = 3, JOX_FIELD_SAMPLES = 9, JOX_FIELD_MIDDLE = 4 };
enum { JOX_FIELD_CLEAR = -1, JOX_FIELD_PLAIN = -2 }; /* instead of a patch: blend; do not */
enum { JOX_FIELD_BLOCKED = 9 };                      /* instead of a node */

typedef struct JoxFieldCell {
    float length; /* of the way from the node, m; INFINITY: none */
    float x, y;   /* the way's direction there; shorter than 1 within JOX_FIELD_CLOSE of the goal */
    int32_t patch;
} JoxFieldCell;

typedef struct JoxFieldPatch {
    float x[JOX_FIELD_SAMPLES], y[JOX_FIELD_SAMPLES], length[JOX_FIELD_SAMPLES];
    uint32_t first, count; /* edges about the cell, in refs */
    uint16_t cut;          /* bits: samples whose ninth of the cell an edge passes */
    uint16_t on_edge;      /* bits: samples on an edge, on neither side of it, which are not used */
} JoxFieldPatch;

/* What walls let the samples of patches see: bits of JoxFieldSight, sample by sample. */
typedef uint32_t JoxFieldSight;
enum {
    JOX_SIGHT_NODES = 0x000f,   /* of the four nodes about the sample */
    JOX_SIGHT_OPEN = 0x0010,    /* no edge is near enough to stand in the way ahead */
    JOX_SIGHT_BY_WALL = 0x0020, /* an edge is within the clearance; its patch has the way off it */
    JOX_SIGHT_SOLID = 0x0040,   /* within matter that an edge bounds; its patch has the way out */
    JOX_SIGHT_DEEP = 0x0080,    /* within matter that no near edge bounds */
    /* The cell's node, and those of its ring, one after the other: whether it is known, and whether
       the sample sees it. Found once a field needs it. */
    JOX_SIGHT_KNOWN = 1 << 8,
    JOX_SIGHT_SEEN = 1 << 17
};

typedef struct JoxFieldEdge {
    JoxV2 a, b;
    uint32_t solid; /* 1: matter on the left */
} JoxFieldEdge;

struct JoxField {
    JoxV2 low;
    float size, clearance; /* m */
    int columns, rows;
    JoxFieldCell *cells;
    JoxFieldPatch *patches;
    uint32_t patch_count, patch_capacity;
    JoxFieldEdge *edges;
    uint32_t edge_count;
    uint32_t *refs; /* edges about each cell, cell by cell */
    uint32_t ref_count;
};

/* Along one axis: where the samples of a column (of a row) lie, and the first of the two whose
   middles they are between, with the share of each. */
typedef struct JoxFieldAxis {
    float at; /* m */
    int first;
    float share[2];
} JoxFieldAxis;

/* What walls do to each cell, which is kept from field to field. */
typedef struct JoxFieldWalled {
    uint32_t *first;  /* refs of cell i: first[i] to first[i + 1] */
    uint16_t *solid;  /* bits: samples inside solids */
    uint8_t *node;    /* sample, or JOX_FIELD_BLOCKED */
    float *x, *y;     /* of the node, m; of the cell's middle where it is blocked */
    uint8_t *links;   /* bits: neighbours on the ring whose node is seen from here */
    uint8_t *corners; /* bit t: no wall in the triangle with neighbours t and t + 1 */
    bool *even;       /* its node and those of its neighbours are in the middles of their cells */
    /* The cells that have patches, in the order of f->patches, and what their samples see. */
    int32_t *patched;
    JoxFieldSight *sight;
    JoxFieldAxis *columns, *rows; /* JOX_FIELD_SIDE for each */
} JoxFieldWalled;

typedef struct JoxFieldWork {
    JoxField *f;
    int count;       /* cells */
    bool exact;      /* cells are as wide as each other, but for rounding that is far less */
    float *near;     /* while marking: each node is so far from walls at least, m */
    float *time;     /* of the way from the node at 1 m/s in the open, s */
    float *slowness; /* s/m at the node */
    JoxFieldWalled walled;
} JoxFieldWork;

/* So close to the goal, in cells, the ways of nodes are as long as their share of it: four of them
   blend to exactly the way there, and to nothing at the goal. More than a cell's diagonal. */
#define JOX_FIELD_CLOSE 1.5f
/* Blends this short are of points within a tenth of a cell of the goal. */
#define JOX_FIELD_ARRIVED (0.1f / JOX_FIELD_CLOSE)

/* The ring of eight neighbours, counter-clockwise from the east. */
extern const int JOX_FIELD_RING[8][2];

static inline JoxV2 jox_field_sample(const JoxField *f, int cell, int sample) {
    float x = (float)(cell % f->columns) + ((float)(sample % JOX_FIELD_SIDE) + 0.5f) / 3.0f;
    float y = (float)(cell / f->columns) + ((float)(sample / JOX_FIELD_SIDE) + 0.5f) / 3.0f;
    return (JoxV2){f->low.x + x * f->size, f->low.y + y * f->size};
}
static inline JoxV2 jox_field_node(const JoxFieldWork *w, int cell) {
    return (JoxV2){w->walled.x[cell], w->walled.y[cell]};
}
/* The neighbour on the ring, or -1 beyond the border. */
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

/* How much shorter the way is `off` from a node than from it, by the slope there. */
static inline float jox_field_slope(const JoxFieldCell *cell, JoxV2 off) {
    return jox_dot(jox_unit((JoxV2){cell->x, cell->y}), off);
}

/* First and last column or row that an interval touches, within the grid; none: first > last. */
void jox_field_span(float from, float to, float low, float size, int most, int *first, int *last);
/* Distance of a point to the nearest of some edges, INFINITY for none; `at` is the point there. */
float jox_field_nearest(const JoxField *f, uint32_t first, uint32_t last, JoxV2 p, JoxV2 *at,
                        uint32_t *edge);
/* True if the way straight from p to q keeps `least` m from every edge, and from those that p
   itself is close to nine tenths of that. With least = 0 it must cross none. */
bool jox_field_sees(const JoxFieldWork *w, JoxV2 p, JoxV2 q, float least);
/* The same of a sample or a node of a cell and a point no farther than nodes next to the cell are:
   no edges but the cell's own are near enough to be in the way. `least` is at most the clearance.
 */
bool jox_field_sees_near(const JoxFieldWork *w, int cell, JoxV2 p, JoxV2 q, float least);
/* Whether it does in any case, both being so far from the nearest walls. */
static inline bool jox_field_surely_sees(const JoxFieldWork *w, float p_near, float q_near, JoxV2 p,
                                         JoxV2 q, float least) {
    const float spare = 0.02f * w->f->size; /* for rounding */
    return w->exact && p_near + q_near > jox_length(jox_sub(q, p)) + 2.0f * least + spare;
}

/* Edges by cell, solids, nodes, links, the slowness near walls, and what patches see. */
void jox_field_mark(JoxFieldWork *work, const JoxWalls *walls, JoxFieldMarks **marks);
/* One of the nine samples of a cell. */
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
/* jox_field_sample of it. */
static inline JoxV2 jox_field_spot_at(const JoxFieldSpot *spot) {
    return (JoxV2){spot->x->at, spot->y->at};
}
/* A node of the four about a sample, -1 where there is none or it counts for nothing, and its
   share. */
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
/* field_sight.c: which cells are blended or have a patch, and of patches all that does not depend
   on where the goal is: what their samples see, and the ways out of solids. */
void jox_field_look_about(JoxFieldWork *work);
/* field_marks.c: uses what was marked of the same edges over the same grid; false if it was not.
   Keeps it for the next time: from then on `marks` own what is walled. */
bool jox_field_recall(JoxFieldWork *work, const JoxFieldMarks *marks);
void jox_field_remember(const JoxFieldWork *work, JoxFieldMarks **marks);
/* Slowness where people are held up; NULL: nobody. */
void jox_field_crowd(JoxFieldWork *work, const JoxFieldCrowd *crowd);
/* Its kernel. `open`: 1 where a cell can be walked, else 0. */
typedef void JoxFieldSpreadKernel(JoxFieldWork *work, const JoxFieldCrowd *crowd,
                                  const float *open);
#define X(name, isa) JoxFieldSpreadKernel jox_field_spread_##name;
JOX_ISAS(X)
#undef X
/* Times, lengths and directions of all nodes. */
void jox_field_march(JoxFieldWork *work, const JoxPlace *places, uint32_t place);
/* So much of the clearance ways keep from samples to nodes, as between nodes. */
#define JOX_FIELD_KEEP 0.85f
/* Of a cell: a sample looks no farther ahead along its way. */
#define JOX_FIELD_AHEAD 0.75f
/* The ways of the samples of patches. */
void jox_field_patch(JoxFieldWork *work);

#endif
