/* All that the future of bodies depends on, as flat arrays of plain cells without padding: what is
   hashed, saved and compared. Bullet's objects are captured into an image and rebuilt from one
   (bullet_image.cc). Rows of dead bodies, walls and the ground are not in it. */
#ifndef JOX_BODY_IMAGE_H
#define JOX_BODY_IMAGE_H

#include "base/sections.h"
#include "base/text.h"
#include "body/body.h"
#include "body/bonds.h"

enum { JOX_BODY_MOTION = 36, JOX_BODY_STATIC = 1, JOX_BODY_KINEMATIC = 2 };

/* One live body. What it has of names, parts, blocks, bonds and points of its path follows in the
   arrays of these in the order of the bodies. */
typedef struct JoxBodyRecord {
    uint32_t row, id;
    uint32_t tags[2]; /* low and high half */
    uint32_t still;   /* 0: it can be pushed; or JOX_BODY_STATIC, JOX_BODY_KINEMATIC */
    uint32_t held, holder;
    uint32_t grounded, swept;
    uint32_t activation;     /* Bullet's state of sleep */
    float deactivation_time; /* s */
    float material[4];       /* friction, restitution, damping, spin damping */
    float force[3];          /* pending for the next step, N */
    /* Of the centre of mass: transform (basis by rows, origin), the same interpolated, velocity,
       spin, and both interpolated. */
    float motion[JOX_BODY_MOTION];
    uint32_t name_length, part_count;
    uint32_t block_count, bond_count; /* 0: it cannot come apart */
    uint32_t low[3], range[3];        /* the rest as of JoxBondGraph */
    double block_size[3], origin[3], block_mass, peak_load;
    uint32_t path_count, path_end; /* points; 0: no path */
    double path_speed, path_after, path_wait, path_time;
    double force_limit, held_up; /* N; share of its way that it did not go */
    uint32_t drive, path_back;   /* JoxDriveFlag; whether it goes back along its path */
} JoxBodyRecord;

/* Of a kinematic body: its path reopens; the world ends where it meets its limit; it just did. */
typedef enum { JOX_DRIVE_REOPENS = 1, JOX_DRIVE_ENDS = 2, JOX_DRIVE_MET = 4 } JoxDriveFlag;

typedef struct JoxBodyPartRecord {
    uint32_t kind, point_count; /* JoxShapeKind; points of a hull */
    double size[3], position[3], turn[4], mass, density;
} JoxBodyPartRecord;

typedef struct JoxBlockRecord {
    uint32_t cell[3], reserved;
    double impulse[3], load[3], displacement[3];
} JoxBlockRecord;

typedef struct JoxBondRecord {
    uint32_t a, b, axis, reserved;
    double strength;
} JoxBondRecord;

/* A point of contact, and what the solver begins from there. */
typedef struct JoxContactRecord {
    int32_t who[4];     /* ids of both bodies (negative: ground and walls), the lower first; of each
                           the part that touches */
    float points[2][3]; /* in the frame of either, m */
    float normal[3];    /* of the second body's surface */
    float impulse[3];   /* along the normal, and across it twice, N s */
} JoxContactRecord;

/* Zero-initialised is empty; the arrays are owned. */
typedef struct JoxBodiesImage {
    struct {
        uint32_t next_id, row_count, reserved;
        float last_dt; /* s */
    } counters;
    JoxBodyRecord *bodies; /* ascending by id */
    uint32_t body_count, body_capacity;
    JoxBodyPartRecord *parts;
    uint32_t part_count, part_capacity;
    double *points; /* three numbers each */
    uint32_t point_count, point_capacity;
    char *names; /* without their ends */
    uint32_t name_count, name_capacity;
    double *path_points; /* of the centre of mass, three numbers each */
    uint32_t path_point_count, path_point_capacity;
    JoxBlockRecord *blocks;
    uint32_t block_count, block_capacity;
    JoxBondRecord *bonds;
    uint32_t bond_count, bond_capacity;
    JoxContactRecord *contacts; /* ascending by `who` */
    uint32_t contact_count, contact_capacity;
} JoxBodiesImage;

void jox_bodies_image_free(JoxBodiesImage *image);
/* Lists the arrays as sections of the module "bodies". */
void jox_bodies_image_sections(JoxBodiesImage *image, JoxSections *sections);
/* Whether an image can be rebuilt: it may come from a file that somebody changed. False with a
   sentence in `error`. */
bool jox_bodies_image_check(const JoxBodiesImage *image, JoxText *error);
/* Writes all there is to an image, in place of what it held. */
void jox_bodies_capture(const JoxBodies *bodies, JoxBodiesImage *image);
/* Makes the bodies those of the image, whatever there were before; walls stay. False, and nothing
   changed, with a sentence in `error` (which may be NULL) where the image makes no sense. */
bool jox_bodies_rebuild(JoxBodies *bodies, const JoxBodiesImage *image, JoxText *error);
/* Appends a graph's blocks and bonds, and writes its numbers to the record. */
void jox_bodies_image_add_bonds(JoxBodiesImage *image, JoxBodyRecord *record,
                                const JoxBondGraph *graph);
/* The graph of a record whose blocks and bonds begin at these indices. */
JoxBondGraph *jox_bodies_image_bonds(const JoxBodiesImage *image, const JoxBodyRecord *record,
                                     uint32_t first_block, uint32_t first_bond);

#endif
