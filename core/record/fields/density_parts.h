/* The floor of a density, and functions that density*.c share. Columns and rows are those of the
   working grid, with the edge. */
#ifndef JOX_RECORD_FIELDS_DENSITY_PARTS_H
#define JOX_RECORD_FIELDS_DENSITY_PARTS_H

#include "record/fields/density.h"

/* Share l of a step of diffusion: the flow over a fully open side is l times the difference of the
   two densities. Above 1/4 a step would overshoot. */
#define JOX_DENSITY_SHARE 0.2f
enum { JOX_DENSITY_MOST_REACH = 511 }; /* cells: greatest reach of the kernel; edges are wider */

/* The walkable floor. Each cell has at most one node, a point of the floor. A person between nodes
   is shared among the nodes around, and steps of diffusion move mass from node to node. */
struct JoxDensityFloor {
    uint64_t hash; /* hash of the walls */
    bool walled;   /* with storeys: the outlines of stairs are walls, too */
    /* m: nodes of the cells with walls, at `first` of the cell (jox_density_node_at) */
    JoxV2 *node;
    uint32_t node_capacity;
    /* cells: width of the way from a node to the next along x, and along y; 0: closed */
    float *open_x;
    float *open_y;
    struct JoxDensitySlant { /* ways between nodes that are not next to each other along x or y */
        uint32_t a, b;
        float open;
    } * slants;
    uint32_t slant_count, slant_capacity;
    uint8_t *near; /* 1: a wall or solid may lie between a point of the cell and the nodes around */
    float *area;   /* cells: area of the floor that belongs to a node */
    float *per;    /* 1 / area; 0: the cell has no node, since nobody can stand there */
    /* Runs of cells with nodes, row by row: cells from..to - 1; `plain` if all ways are fully
       open. */
    struct JoxDensityRun {
        int from, to;
        bool plain;
    } * runs;
    uint32_t run_count, run_capacity, *run_first;
    uint64_t *right, *up; /* bits of the cells with a way to the next along x, and along y */
    /* Edges of walls; `passing` lists those through each cell, from `first` of the cell to `first`
       of the next. */
    struct JoxDensityBar {
        double ax, ay, bx, by;
    } * bars;
    uint32_t bar_count, bar_capacity;
    uint32_t *first, *passing, passing_capacity;
};

static inline bool jox_density_has_wall(const JoxDensityFloor *floor, size_t cell) {
    return floor->first[cell] < floor->first[cell + 1];
}
/* density_put.c: makes rows first..end - 1 the strip and clears it; adds a crowd to it. Within
   walls the strip must be the whole grid. */
void jox_density_clear_strip(JoxDensity *density, int fields, int first, int end);
void jox_density_put_crowd(JoxDensity *density, const JoxDensityCrowd *crowd);
/* density_nodes.c: returns the lower left corner of the working grid, m; returns a value rounded
   down and limited to 0..most. */
JoxV2 jox_density_corner(const JoxDensity *density);
int jox_density_clamp_index(double value, int most);
/* Sets the cell of (x, y). Returns false unless it has cells on all sides. */
bool jox_density_locate(const JoxDensity *density, float x, float y, int *column, int *row);
bool jox_density_holds(const JoxDensity *density, JoxV2 at); /* returns whether it does */
/* Adds an edge of a wall. */
void jox_density_add_bar(JoxDensity *density, JoxV2 a, JoxV2 b);
/* Returns whether a wall lies between two points that are at most two cells apart. */
bool jox_density_is_hidden(const JoxDensity *density, JoxV2 a, JoxV2 b);
/* Moves from the cell of (x, y) to the cell of the node that applies there: its own if visible,
   else the nearest visible one, else (inside a wall) the nearest one. */
typedef enum { JOX_DENSITY_NO_NODE, JOX_DENSITY_HIDDEN, JOX_DENSITY_SEEN } JoxDensityNode;
JoxDensityNode jox_density_find_node(const JoxDensity *density, float x, float y, int *column,
                                     int *row);
/* Returns the position of a cell's node, m: the middle of the cell, or a walkable point in it. */
JoxV2 jox_density_node_at(const JoxDensity *density, int column, int row);
/* Sets the nodes that share a person at (x, y), and their shares. Returns their number; 0 outside
   the grid. */
int jox_density_share_person(const JoxDensity *density, float x, float y, uint32_t nodes[4],
                             float shares[4]);
/* density_solids.c: tests points against the solid walls that stand. Made for many queries. */
typedef struct JoxDensitySolids JoxDensitySolids;
JoxDensitySolids *jox_density_solids_create(const JoxDensity *density, const JoxWalls *walls);
bool jox_density_is_within_solid(JoxDensitySolids *solids, JoxV2 point);
void jox_density_solids_free(JoxDensitySolids *solids);
/* density_walls.c: frees a floor. */
void jox_density_free_floor(JoxDensityFloor *floor);
/* density_sheets.c: makes the blocks of a density on storeys, for an area in plan, and returns the
   number of rows that are read. */
int jox_density_add_sheets(JoxDensity *density, const JoxStoreys *storeys, JoxV2 low, JoxV2 high);
void jox_density_free_sheets(JoxDensitySheets *sheets);
/* Convert a position along y into the working grid, and back; NAN where there is no row for it. */
float jox_density_pack(const JoxDensity *density, float y);
float jox_density_unpack(const JoxDensity *density, float packed);
/* Returns whether there is no floor of storeys and stairs at a point of the working grid. */
bool jox_density_is_off_floor(const JoxDensity *density, JoxV2 packed);
/* Return or add what a density with storeys works on: its crowd, valid until the next call; edges
   of walls, outlines of stairs and seams, of which only seams without `walls`; solid walls. */
JoxDensityCrowd jox_density_pack_crowd(JoxDensity *density, const JoxDensityCrowd *crowd);
void jox_density_add_packed_bars(JoxDensity *density, const JoxWalls *walls);
void jox_density_pack_solids(const JoxDensity *density, const JoxWalls *walls, JoxWalls *out);
/* Sets of cells are bits in whole words for each row: words per row, the word of a cell, the bit of
   a column. */
static inline size_t jox_density_words(const JoxDensity *density) {
    return (size_t)density->wide / 64 + 1;
}
static inline uint64_t *jox_density_word(const JoxDensity *density, uint64_t *bits, int column,
                                         int row) {
    return bits + (size_t)row * jox_density_words(density) + column / 64;
}
static inline uint64_t jox_density_bit(int column) {
    return UINT64_C(1) << (column % 64);
}
/* density_diffuse.c: lists runs and ways of the floor; turns the masses of a field into densities,
   in 1/cell, by the kernel. */
void jox_density_list_floor(JoxDensity *density);
void jox_density_diffuse(JoxDensity *density, int field);
/* Returns scratch of one number for each cell. */
float *jox_density_scratch(JoxDensity *density);
/* density_spread.c: returns the variance that the kernel has yet to add, cells2. Sharing a person
   among the nodes around has added 1/6 already, averaged over positions. jox_density_spread samples
   a crowd without walls. */
float jox_density_variance(const JoxDensity *density);
void jox_density_spread(JoxDensity *density, const JoxDensityCrowd *crowd, int fields,
                        float *const *out);

#endif
