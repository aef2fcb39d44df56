/* What the files of density share. Cells are counted with the edge about what is read. */
#ifndef JOX_RECORD_FIELDS_DENSITY_PARTS_H
#define JOX_RECORD_FIELDS_DENSITY_PARTS_H

#include "record/fields/density.h"

/* Of the difference of two nodes' densities, most that goes over a whole side in a step; more than
   1/4 would overshoot. */
#define JOX_DENSITY_SHARE 0.2f
enum { JOX_DENSITY_MOST_REACH = 511 }; /* cells that the kernel reaches over, and edges are wider */

/* Each cell is a point of the floor, its node. Who stands between nodes is shared among those
   around, and what is shared goes from node to node in steps. */
struct JoxDensityFloor {
    uint64_t hash; /* of the walls */
    JoxV2 *node;   /* m: by `first`, of cells that have walls in them: see jox_density_node_at */
    uint32_t node_capacity;
    float *open_x; /* how wide the way is from a node to the next along x, in cells; 0: none */
    float *open_y;
    struct JoxDensitySlant { /* ways to others, over floor that lies in cells between */
        uint32_t a, b;
        float open;
    } * slants;
    uint32_t slant_count, slant_capacity;
    uint8_t *near; /* walls may stand between the cell's people and the nodes around */
    float *area;   /* of the floor that belongs to a node, in cells */
    float *per;    /* 1 / area; 0: no node, nobody can stand there */
    /* By row, the cells that have nodes: from..to - 1, which are open on all sides if `plain`. */
    struct JoxDensityRun {
        int from, to;
        bool plain;
    } * runs;
    uint32_t run_count, run_capacity, *run_first;
    uint64_t *right, *up; /* cells as bits: whether there is a way to the next along x, along y */
    /* Stretches of walls, and by cell those that pass through it. */
    struct JoxDensityBar {
        double ax, ay, bx, by;
    } * bars;
    uint32_t bar_count, bar_capacity;
    uint32_t *first, *passing, passing_capacity;
};

static inline bool jox_density_has_wall(const JoxDensityFloor *floor, size_t cell) {
    return floor->first[cell] < floor->first[cell + 1];
}
/* density_put.c: makes room for the given rows, in which there is nobody then; puts a crowd there.
   Within walls a strip is all there is. */
void jox_density_strip(JoxDensity *density, int fields, int first, int end);
void jox_density_put(JoxDensity *density, const JoxDensityCrowd *crowd);
/* density_nodes.c: the lowest corner of all cells; a whole number within 0..most. */
JoxV2 jox_density_corner(const JoxDensity *density);
int jox_density_clamped(double value, int most);
/* The cell that (x, y) lies in, if there are cells around it too. */
bool jox_density_locate(const JoxDensity *density, float x, float y, int *column, int *row);
/* Whether a wall stands between two points that are at most two cells apart. */
bool jox_density_hidden(const JoxDensity *density, JoxV2 a, JoxV2 b);
/* From the cell of (x, y) to that of the node which holds for there: its own, if it is seen from
   there, or else the nearest that is, or if none is, as within a wall, the nearest of any floor. */
typedef enum { JOX_DENSITY_NO_NODE, JOX_DENSITY_HIDDEN, JOX_DENSITY_SEEN } JoxDensityNode;
JoxDensityNode jox_density_node(const JoxDensity *density, float x, float y, int *column, int *row);
/* Where the node of a cell is: in the middle, or at a point of the cell that can be walked on. */
JoxV2 jox_density_node_at(const JoxDensity *density, int column, int row);
/* The nodes that share somebody at (x, y), with their shares. 0: nowhere near the area. */
int jox_density_share(const JoxDensity *density, float x, float y, uint32_t nodes[4],
                      float shares[4]);
/* density_solids.c: the solids that stand among walls, so that one can ask what lies within, as
   often as need be. */
typedef struct JoxDensitySolids JoxDensitySolids;
JoxDensitySolids *jox_density_solids_create(const JoxDensity *density, const JoxWalls *walls);
bool jox_density_within(JoxDensitySolids *solids, JoxV2 point);
void jox_density_solids_free(JoxDensitySolids *solids);
/* density_walls.c */
void jox_density_free_floor(JoxDensityFloor *floor);
/* Cells as bits, in whole words for each row. */
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
/* density_diffuse.c: lists the runs and ways of a floor; makes a field's masses densities, in
   1/cell, by the kernel. */
void jox_density_list_floor(JoxDensity *density);
void jox_density_diffuse(JoxDensity *density, int field);
/* A number of each cell, for work of the moment. */
float *jox_density_spare(JoxDensity *density);
/* density_spread.c: what the kernel has left to add, cells2, as sharing somebody among the nodes
   around has added 1/6 already, in the mean over where one can stand; a sample without walls. */
float jox_density_variance(const JoxDensity *density);
void jox_density_spread(JoxDensity *density, const JoxDensityCrowd *crowd, int fields,
                        float *const *out);

#endif
