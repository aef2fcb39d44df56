/* Blocks on a lattice, bonded face to face to one rigid body, and the loads of their bonds. Plain C
   without Bullet; bullet_bonds.cc calls it. All vectors are in the body's own frame, whose axes are
   the lattice's; m, kg, s, N.

   The model. The motion of a rigid body gives the acceleration of each block, and with that the net
   force on it: m_i a_i, where a_i is the acceleration of the rigid whole at the block. The external
   force on the block (from people, ground, other bodies) is a different one; the bonds carry the
   difference ("inertial relief"). Gravity and other forces in proportion to mass cancel. These
   self-equilibrated loads f are spread over the bonds as over springs between the centres, of
   stiffness 1 along the bond and 0.4 across (G/E of a solid of Poisson ratio 0.25):

       sum over the bonds of i: W (u_j - u_i) = -f_i        (three weighted graph Laplacians)

   solved by conjugate gradients, started from the solution of the last step: under a steady load
   one evaluation of the residual suffices. The force of a bond is W (u_j - u_i). It breaks if
   sqrt(tension^2 + shear^2) exceeds its strength; compression does not break it. Blocks do not turn
   against each other, so bending appears as shear: a plank breaks where the shear force of a beam
   is greatest, and a strength is that of a joint, in newtons, not of a material.

   Reason: with one constraint per bond in the solver of bodies, a wall collapses under its own
   weight and forces depend on the order of the solver's passes. Here intact bonds cost no accuracy
   of the body at all, and the loads are those of equilibrium, whatever the step.

   Loads are low-pass filtered with JOX_BONDS_LOAD_TIME: a contact solver applies the impulse of
   a collision in one step, whose length must not decide what breaks. Nothing is solved while
   half the sum of all loads is below the weakest bond's strength: no single bond can carry more. */
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
    double size[3];      /* lengths of a block, m */
    double origin[3];    /* the lattice's corner of least x, y, z in the body's own frame, m */
    double block_mass;   /* kg */
    double centre[3];    /* centre of mass, m */
    uint32_t low[3];     /* the blocks lie in the cells */
    uint32_t range[3];   /* from low to low + range - 1 along each axis */
    uint32_t *at;        /* block in each cell of the range, UINT32_MAX if empty */
    uint32_t count;      /* blocks */
    uint32_t (*cell)[3]; /* cell of each block, ascending by z, y, x */
    JoxBond *bonds;      /* intact bonds, ascending by a, then axis */
    uint32_t bond_count;
    double inertia[9];         /* about the centre, kg m2 */
    double inverse[9];         /* inverse of `inertia` */
    double (*impulse)[3];      /* external impulse on each block since the last step, N s */
    double (*load)[3];         /* external force on each block, low-pass filtered, N */
    double (*displacement)[3]; /* u: displacement of each block in the spring model, in N (stiffness
                                  1) */
    double (*scratch)[3];      /* 4 * count: residual, direction, product, relieved load */
    uint32_t *label;           /* piece of each block; pieces are numbered by their least block */
    double peak_load; /* load of the bond nearest to breaking in the last step, over strength */
} JoxBondGraph;

/* Creates a full lattice, centred at the frame's origin. NULL unless there are 1 to
   JOX_BONDS_MOST_BLOCKS blocks and every number is finite and above 0. */
JoxBondGraph *jox_bonds_create(const uint32_t count[3], const double size[3], double block_mass,
                               double strength);
/* Allocates a graph that is restored from a saved state: `count` blocks within that range of
   cells, all zero. The caller writes size, origin, block mass, cells and bonds; jox_bonds_index
   then computes the members that follow from them. */
JoxBondGraph *jox_bonds_allocate(const uint32_t low[3], const uint32_t range[3], uint32_t count);
void jox_bonds_index(JoxBondGraph *bonds);
void jox_bonds_free(JoxBondGraph *bonds);
/* Writes the centre of a block, m. */
void jox_bonds_block_centre(const JoxBondGraph *bonds, uint32_t block, double out[3]);
/* Returns the block at a point, m, or the nearest one. */
uint32_t jox_bonds_block_at(const JoxBondGraph *bonds, const double point[3]);
/* Adds an external impulse, N s, to the block at a point, m. */
void jox_bonds_add_impulse(JoxBondGraph *bonds, const double point[3], const double impulse[3]);

typedef struct JoxBondContact {
    uint32_t block; /* touching block */
    double point[3], impulse[3];
} JoxBondContact;
/* Adds the impulses of the contacts with one other body. The contact solver's division among
   many touching points is one of countless ones with the same total force and moment, and an
   uneven one: most of a wall's weight may stand on two of its forty feet. It is replaced by the
   smoothest one (least squares over the touching blocks: under a wall, pressure that varies
   linearly along its foot). Blocks that would have to pull against `normal`, the unit direction
   in which the other body pushes, are left out: the others take all of the force, and of the
   moment what they can. `contacts` is changed. */
void jox_bonds_add_contacts(JoxBondGraph *bonds, JoxBondContact *contacts, uint32_t count,
                            const double normal[3]);
/* Filters the impulses of a step of dt seconds into loads and breaks overloaded bonds; `spin` is
   the body's angular velocity, rad/s. Bonds are cut in rounds, the most overloaded first, until
   the rest holds or the body is in pieces. Returns how many were cut. Allocates nothing. */
uint32_t jox_bonds_step(JoxBondGraph *bonds, double dt, const double spin[3]);
/* Finds the pieces: writes `label` and returns their number. */
uint32_t jox_bonds_label_pieces(JoxBondGraph *bonds);
/* Copies the blocks with a label into a graph of their own, with their bonds and loads. With
   `own_frame` the frame's origin is moved to their centre of mass, and `centre` is that point in
   the old frame, m; else `centre` is zero. */
JoxBondGraph *jox_bonds_extract(const JoxBondGraph *bonds, uint32_t label, bool own_frame,
                                double centre[3]);

/* Assertions, in body_checks.c: on a graph with its loads; on labels after jox_bonds_label_pieces;
   on loads without rigid motion, whose sum is zero; on contacts whose impulses sum to `force`. */
void jox_bonds_check(const JoxBondGraph *bonds);
void jox_bonds_pieces_check(const JoxBondGraph *bonds, uint32_t pieces);
void jox_bonds_relieved_check(const JoxBondGraph *bonds, const double (*loads)[3]);
void jox_bonds_contacts_check(const JoxBondGraph *bonds, const JoxBondContact *contacts,
                              uint32_t count, const double force[3]);

#endif
