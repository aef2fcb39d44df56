/* What the files of density share. Cells are counted with the edge about what is read. */
#ifndef JOX_RECORD_FIELDS_DENSITY_PARTS_H
#define JOX_RECORD_FIELDS_DENSITY_PARTS_H

#include "record/fields/density.h"

/* Each cell is a point of the floor, its node. Who stands between nodes is shared among those
   around, and what is shared goes from node to node in steps. */
struct JoxDensityFloor {
    uint64_t hash; /* of the walls */
    JoxV2 *node;   /* m: the middle, or a point of the cell that can be walked on */
    float *open_x; /* 1 where one can go from a node to the next along x, else 0 */
    float *open_y;
    uint8_t *near; /* walls may stand between the cell's people and the nodes around */
    float *area;   /* of the floor that belongs to a node, in cells */
    float *per;    /* by which a node's mass is a density: 1 / (its area, spread like people, m2) */
    /* Stretches of walls, and by cell those that pass through it. */
    struct JoxDensityBar {
        double ax, ay, bx, by;
    } * bars;
    uint32_t bar_count, bar_capacity;
    uint32_t *first, *passing, passing_capacity;
};

/* The nodes that share somebody at (x, y), with their shares. 0: nowhere near the area. */
int jox_density_share(const JoxDensity *density, float x, float y, uint32_t nodes[4],
                      float shares[4]);
/* density_walls.c: whether a wall stands between two points that are at most two cells apart. */
bool jox_density_hidden(const JoxDensity *density, JoxV2 a, JoxV2 b);
void jox_density_free_floor(JoxDensityFloor *floor);
/* density_spread.c: spreads a field's masses by the kernel, in place. */
void jox_density_spread(JoxDensity *density, int field);

#endif
