/* Blocks on a lattice, bonded face to face to one rigid body, and the loads of their bonds. Plain C
   without Bullet. All vectors are in the body's own frame, whose axes are the lattice's; m, kg, s,
   N.

   The model. Of a rigid body one knows how each block moves, and with that the net force upon it:
   m_i a_i, where a_i is the acceleration of the rigid whole at the block. What acts on the block
   from outside (people, ground, other bodies) is a different force; the bonds carry the difference
   ("inertial relief"). Gravity and whatever else acts in proportion to mass cancels. Those
   self-equilibrated loads f are spread over the bonds as over springs between the centres, of
   stiffness 1 along the bond and 0.4 across (G/E of a solid of Poisson ratio 0.25):

       sum over the bonds of i: W (u_j - u_i) = -f_i        (three weighted graph Laplacians)

   solved by conjugate gradients, begun where the last step ended: under a steady load that costs
   one look. A bond's force is W (u_j - u_i). It breaks where sqrt(tension^2 + shear^2) exceeds its
   strength; compression does not break it. Blocks do not turn against each other, so that bending
   shows as shear: a plank breaks where the shear force of a beam is greatest, and a strength is
   that of a joint, in newtons, not of a material.

   Why so: a constraint per bond in the solver of bodies collapses under its own weight and gives
   forces that depend on the order of its passes. Here bonds that hold cost no accuracy of the body
   at all, and the loads are those of equilibrium, whatever the step.

   Loads are low-pass filtered with JOX_BONDS_LOAD_TIME: a contact solver hands out the impulse of a
   collision in one step, whose length must not decide what breaks. Nothing is solved while half the
   sum of all loads is below the weakest bond's strength: no single bond can carry more. */
#ifndef JOX_BODY_BONDS_H
#define JOX_BODY_BONDS_H

#include <stdbool.h>
#include <stdint.h>

#define JOX_BONDS_LOAD_TIME 0.1 /* s: time constant of the loads' filter */
enum { JOX_BONDS_MOST_BLOCKS = 4096 };

typedef struct JoxBond {
    uint32_t a, b; /* blocks; b lies beyond a along the axis */
    uint32_t axis; /* 0 x, 1 y, 2 z */
    double strength;
} JoxBond;

typedef struct JoxBondGraph {
    double size[3];      /* of a block, m */
    double origin[3];    /* the lattice's corner of least x, y, z in the body's own frame, m */
    double block_mass;   /* kg */
    double centre[3];    /* of mass, m */
    uint32_t low[3];     /* the range of cells that is filled: */
    uint32_t range[3];   /* from low to low + range - 1 */
    uint32_t *at;        /* block in each cell of the range, or UINT32_MAX */
    uint32_t count;      /* blocks */
    uint32_t (*cell)[3]; /* of each block, ascending by z, y, x */
    JoxBond *bonds;      /* what holds still, ascending by a, then axis */
    uint32_t bond_count;
    double inertia[9];         /* about the centre, kg m2 */
    double inverse[9];         /* of it */
    double (*impulse)[3];      /* from outside since the last step, N s */
    double (*load)[3];         /* the same as filtered force, N */
    double (*displacement)[3]; /* u: what the springs give way, in N (stiffness 1) */
    double (*scratch)[3];      /* 4 * count: residual, direction, product, relieved load */
    uint32_t *label;           /* of each block: the piece it is in, counted by its least block */
    double peak_load; /* load of the bond nearest to breaking in the last step, over strength */
} JoxBondGraph;

/* A full lattice about the frame's origin. NULL unless there are 1 to JOX_BONDS_MOST_BLOCKS blocks
   and every number is finite and above 0. */
JoxBondGraph *jox_bonds_create(const uint32_t count[3], const double size[3], double block_mass,
                               double strength);
/* For a graph that is put together from what was saved: `count` blocks within that range of cells,
   all zero. Once size, origin, block mass, cells and bonds are written, jox_bonds_index fills in
   what follows from them. */
JoxBondGraph *jox_bonds_allocate(const uint32_t low[3], const uint32_t range[3], uint32_t count);
void jox_bonds_index(JoxBondGraph *bonds);
void jox_bonds_free(JoxBondGraph *bonds);
/* Middle of a block, m. */
void jox_bonds_block_centre(const JoxBondGraph *bonds, uint32_t block, double out[3]);
/* The block at a point, or the nearest to it. */
uint32_t jox_bonds_block_at(const JoxBondGraph *bonds, const double point[3]);
/* An impulse from outside upon the block at this point. */
void jox_bonds_add_impulse(JoxBondGraph *bonds, const double point[3], const double impulse[3]);

typedef struct JoxBondContact {
    uint32_t block; /* that touches */
    double point[3], impulse[3];
} JoxBondContact;
/* The contacts with one other body. What a solver hands to each of many touching points is one of
   countless ways to come to the same force and moment, and an odd one: most of a wall's weight may
   stand on two of its forty feet. In its place the smoothest is taken (least squares over the
   touching blocks: under a wall, pressure that varies linearly along its foot), without blocks that
   would have to pull against `normal`, the unit direction in which the other body pushes; their
   force is kept and of their moment what the rest can take. `contacts` is changed. */
void jox_bonds_add_contacts(JoxBondGraph *bonds, JoxBondContact *contacts, uint32_t count,
                            const double normal[3]);
/* Takes in the impulses of a step of dt seconds during which the body turned at `spin`, and cuts
   the bonds that are loaded over their strength, in rounds, the most overloaded first, until the
   rest holds or the body is in pieces. Returns how many were cut. Allocates nothing. */
uint32_t jox_bonds_step(JoxBondGraph *bonds, double dt, const double spin[3]);
/* Writes `label` and returns the number of pieces. */
uint32_t jox_bonds_label_pieces(JoxBondGraph *bonds);
/* The blocks with this label as a graph of their own, with their bonds and loads. With `own_frame`
   the frame's origin is moved to their centre of mass; where that was, is returned in `centre`. */
JoxBondGraph *jox_bonds_extract(const JoxBondGraph *bonds, uint32_t label, bool own_frame,
                                double centre[3]);

/* body_checks.c: the graph with its loads; labels that were just written; loads relieved of the
   motion of the rigid whole, whose sum is zero; contacts whose impulses come to `force`. */
void jox_bonds_check(const JoxBondGraph *bonds);
void jox_bonds_pieces_check(const JoxBondGraph *bonds, uint32_t pieces);
void jox_bonds_relieved_check(const JoxBondGraph *bonds, const double (*loads)[3]);
void jox_bonds_contacts_check(const JoxBondGraph *bonds, const JoxBondContact *contacts,
                              uint32_t count, const double force[3]);

#endif
