/* Complete state of the bodies as flat arrays of plain cells without padding, which are hashed,
   saved and compared. bullet_image.cc captures Bullet's objects into an image and rebuilds them
   from one. Rows of removed bodies, walls and the ground are not in it. */
#ifndef JOX_BODY_IMAGE_H
#define JOX_BODY_IMAGE_H

#include "base/sections.h"
#include "base/text.h"
#include "body/body.h"
#include "body/bonds.h"

enum { JOX_BODY_MOTION = 36, JOX_BODY_STATIC = 1, JOX_BODY_KINEMATIC = 2 };

/* One live body. Its name, parts, blocks, bonds and path points are in the arrays below, in the
   order of the bodies. */
typedef struct JoxBodyRecord {
    uint32_t row, id;
    uint32_t tags[2]; /* low and high 32 bits */
    uint32_t still;   /* 0 for a dynamic body, JOX_BODY_STATIC or JOX_BODY_KINEMATIC */
    uint32_t held, holder;
    uint32_t grounded, swept;
    uint32_t activation;     /* Bullet's activation state (awake, asleep, ...) */
    float deactivation_time; /* s */
    float material[4];       /* friction, restitution, damping, spin damping */
    float force[3];          /* force during the next step, N */
    /* Motion of the centre of mass: transform (basis by rows, origin), the interpolated
       transform, velocity, spin, and both interpolated. */
    float motion[JOX_BODY_MOTION];
    uint32_t name_length, part_count;
    uint32_t block_count, bond_count; /* 0 for a body without bonds */
    uint32_t low[3], range[3];        /* these and the following as in JoxBondGraph */
    double block_size[3], origin[3], block_mass, peak_load;
    uint32_t path_count, path_end; /* number of points, 0 for no path; JoPathEnd */
    double path_speed, path_after, path_wait, path_time;
    double force_limit, held_up; /* N; share of its way that it did not move in the last step */
    uint32_t drive, path_back;   /* JoxDriveFlag; 1 while it moves back along its path */
} JoxBodyRecord;

/* Flags of a kinematic body: its path reopens; the world ends when it reaches its force limit;
   it reached the limit in the last step. */
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

/* Contact point, and the impulses with which the solver starts there. */
typedef struct JoxContactRecord {
    int32_t ids[4]; /* ids of both bodies (negative: ground and walls), the lower first; then index
                       of the touching part of each */
    float points[2][3]; /* contact point in the frame of each body, m */
    float normal[3];    /* surface normal of the second body, unit */
    float impulse[3];   /* along the normal and along two tangents, N s */
} JoxContactRecord;

/* Image of all bodies. Zero-initialise for an empty one; it owns its arrays. */
typedef struct JoxBodiesImage {
    struct {
        uint32_t next_id, row_count, reserved;
        float last_dt; /* s */
    } counters;
    JoxBodyRecord *bodies; /* ascending by id */
    uint32_t body_count, body_capacity;
    JoxBodyPartRecord *parts;
    uint32_t part_count, part_capacity;
    double *points; /* points of hulls, three numbers each */
    uint32_t point_count, point_capacity;
    char *names; /* concatenated, without terminating zeros */
    uint32_t name_count, name_capacity;
    double *path_points; /* path points of the centres of mass, three numbers each */
    uint32_t path_point_count, path_point_capacity;
    JoxBlockRecord *blocks;
    uint32_t block_count, block_capacity;
    JoxBondRecord *bonds;
    uint32_t bond_count, bond_capacity;
    JoxContactRecord *contacts; /* ascending by `ids` */
    uint32_t contact_count, contact_capacity;
} JoxBodiesImage;

void jox_bodies_image_free(JoxBodiesImage *image);
/* Lists the arrays as sections of the module "bodies". */
void jox_bodies_image_sections(JoxBodiesImage *image, JoxSections *sections);
/* Whether bodies can be rebuilt from an image, which may come from a file that was changed.
   False with a sentence in `error`. */
bool jox_bodies_image_check(const JoxBodiesImage *image, JoxText *error);
/* Writes the state of all bodies to an image, replacing its contents. */
void jox_bodies_capture(const JoxBodies *bodies, JoxBodiesImage *image);
/* Replaces all bodies by those of the image; walls stay. False, and nothing changed, with a
   sentence in `error` (which may be NULL) if the image is not valid. */
bool jox_bodies_rebuild(JoxBodies *bodies, const JoxBodiesImage *image, JoxText *error);
/* Appends the blocks and bonds of a graph to the image, and writes its numbers to the record. */
void jox_bodies_image_add_bonds(JoxBodiesImage *image, JoxBodyRecord *record,
                                const JoxBondGraph *graph);
/* Creates the graph of a record whose blocks and bonds start at these indices. */
JoxBondGraph *jox_bodies_image_bonds(const JoxBodiesImage *image, const JoxBodyRecord *record,
                                     uint32_t first_block, uint32_t first_bond);

#endif
