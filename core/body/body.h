/* Rigid bodies: a C face over Bullet. Metres, kilograms, seconds, radians; z up, ground at z = 0.
   Agents stay outside: they read JoxObjects, give impulses, and meet fast bodies as discs. In a
   build without Bullet adding a body fails with a text that says so, and all else does nothing.
   Single-threaded; the same calls in the same order give the same bits. */
#ifndef JOX_BODY_BODY_H
#define JOX_BODY_BODY_H

#include <stdbool.h>
#include <stdint.h>

#include "base/sections.h"
#include "base/text.h"
#include "body/path.h"
#include "geom/objects.h"
#include "geom/walls.h"
#include "jostle.h"

#define JOX_NO_BODY UINT32_MAX

/* N: at a load of this, one person is estimated to die within 15 s (Hopkins et al. 1993, in Lee and
   Hughes 2006); what would press harder than that on all before it, has to say so. */
#define JOX_DRIVE_FORCE 6227.0

typedef struct JoxBodies JoxBodies;
typedef struct JoxBodyPart JoxBodyPart;

typedef enum JoxShapeKind {
    JOX_SHAPE_BOX,      /* size: lengths along x, y, z */
    JOX_SHAPE_SPHERE,   /* size[0]: radius */
    JOX_SHAPE_CYLINDER, /* size[0]: radius, size[1]: height; the axis is z */
    JOX_SHAPE_HULL,     /* convex hull of 4 to 256 points: x0, y0, z0, x1, ... */
    JOX_SHAPE_COMPOUND, /* 1 to 4096 parts, none of them a compound */
    JOX_SHAPE_BLOCKS    /* size: of one block; count of them along x, y, z: bonded, see bonds.h */
} JoxShapeKind;

typedef struct JoxShape {
    JoxShapeKind kind;
    double size[3]; /* m */
    const double *points;
    uint32_t point_count;
    const JoxBodyPart *parts;
    uint32_t part_count;
    uint32_t count[3]; /* blocks: at most 4096 in all; of a part none */
    double bond;       /* N: what breaks the bond between two blocks */
} JoxShape;

struct JoxBodyPart {
    JoxShape shape;
    double position[3];   /* of the part's frame in the body's, m */
    double turn[4];       /* quaternion x, y, z, w; all zero is no turn */
    double mass, density; /* kg, or kg/m3 where mass is 0; in a static body neither is read */
};

/* Everything is copied. Start from jox_body_def. */
typedef struct JoxBodyDef {
    JoxShape shape;
    double position[3];          /* of the shape's own frame (not the centre of mass), m */
    double turn[4];              /* quaternion x, y, z, w; all zero is no turn */
    double velocity[3], spin[3]; /* of the centre of mass, m/s; rad/s */
    double mass;                 /* kg; with density 0 too, the body is static */
    double density;              /* kg/m3; read where mass is 0 */
    bool still;                  /* static whatever the mass */
    bool kinematic; /* whatever the mass: it moves by its velocity and spin, or along its path, and
                       nothing turns it aside */
    JoxBodyPath path;   /* of the shape's own frame; its first point is `position`. Without points:
                           none */
    double force_limit; /* N: what a kinematic body presses people with at most, all of them
                           together, where it moves towards them: then it goes as fast as they give
                           way; 0: no limit */
    bool ends_run;      /* where that is reached the world ends */
    double friction, restitution; /* multiplied with those of the other; ground and walls have 1 */
    double damping, spin_damping; /* share of velocity lost in a second, 0 to 1 */
    uint64_t tags;
    const char *name; /* or NULL */
} JoxBodyDef;
/* A box of 1 m, 10 kg, friction 0.6, restitution 0, no damping; a force limit of
   JOX_DRIVE_FORCE. */
JoxBodyDef jox_body_def(void);

typedef struct JoxBodiesDef {
    double gravity;         /* m/s2, downwards */
    bool ground;            /* a plane at z = 0 */
    double kill_height;     /* m; a body whose centre is below is lost */
    JoLost lost;            /* what becomes of it; JO_LOST_END: it is taken out */
    double most_change;     /* m/s; an impulse is clamped to change a velocity by no more */
    double person_height;   /* m, of the discs of jox_bodies_step */
    double person_hardness; /* a body's restitution is multiplied by it when it hits a person */
} JoxBodiesDef;
/* 9.81, ground, -50 m, 500 m/s, 1.75 m, 0.5. */
JoxBodiesDef jox_bodies_def(void);

/* Never NULL. Bullet's own world is made with the first body. */
JoxBodies *jox_bodies_create(const JoxBodiesDef *def);
void jox_bodies_free(JoxBodies *bodies);
/* Static walls from the ground to their height, or to `height` where theirs is not finite. Thin
   ones are 4 cm thick. Each call replaces the walls before, and wakes bodies that rest. */
void jox_bodies_set_walls(JoxBodies *bodies, const JoxWalls *walls, float height);

/* Returns the body's row, or JOX_NO_BODY with a sentence in `error` (which may be NULL). Rows of
   dead bodies are used again; ids are not. */
uint32_t jox_bodies_add(JoxBodies *bodies, const JoxBodyDef *def, JoxText *error);
/* False where there is no such body. */
bool jox_bodies_remove(JoxBodies *bodies, uint32_t row);
uint32_t jox_bodies_count(const JoxBodies *bodies);
/* Rows so far, those of dead bodies among them. */
uint32_t jox_bodies_rows(const JoxBodies *bodies);
/* Row of the live body with this id or name, or JOX_NO_BODY. */
uint32_t jox_bodies_find(const JoxBodies *bodies, uint32_t id);
uint32_t jox_bodies_find_name(const JoxBodies *bodies, const char *name);
/* Id of the live body in a row, or JOX_NO_BODY. */
uint32_t jox_bodies_id(const JoxBodies *bodies, uint32_t row);
/* "" where it has none. Valid while the body lives. */
const char *jox_bodies_name(const JoxBodies *bodies, uint32_t row);

typedef struct JoxPose {
    JoxV3 position; /* of the shape's own frame, m */
    float turn[4];  /* quaternion x, y, z, w */
    JoxV3 centre;   /* of mass, m */
    JoxV3 velocity; /* of the centre of mass, m/s */
    JoxV3 spin;     /* rad/s */
    float mass;     /* kg; 0 static or kinematic */
    JoxV3 inertia;  /* principal moments, kg m2; 0 likewise */
    bool kinematic;
} JoxPose;
/* False, and `pose` zero, where there is no such body. */
bool jox_bodies_pose(const JoxBodies *bodies, uint32_t row, JoxPose *pose);
/* One convex part of a body as it is drawn. */
typedef struct JoxBodyLook {
    JoxShapeKind kind;    /* box, sphere, cylinder or hull */
    float size[3];        /* m, as of JoxShape */
    JoxV3 at;             /* of the part's frame in the shape's own, m */
    float turn[4];        /* quaternion x, y, z, w */
    const JoxV3 *corners; /* of a hull, in the part's frame, m; valid until the next call */
    uint32_t corner_count;
} JoxBodyLook;
/* Part `part` of a body; false where it has none of that number. Parts that broke off are bodies of
   their own. */
bool jox_bodies_look(const JoxBodies *bodies, uint32_t row, uint32_t part, JoxBodyLook *out);
/* False, and nothing done, for a static body or a number that is not finite. A kinematic body keeps
   this velocity, and leaves its path. */
bool jox_bodies_set_velocity(JoxBodies *bodies, uint32_t row, JoxV3 velocity, JoxV3 spin);
/* Puts the shape's own frame at a position, m, turned by a quaternion x, y, z, w (NULL: as it is),
   at rest; static bodies too. Nobody carries it from here on, and it leaves its path. False where
   there is no such body. */
bool jox_bodies_place(JoxBodies *bodies, uint32_t row, const double position[3],
                      const double turn[4]);
/* From here on an agent carries the body: it touches nothing until it is let go. False for a static
   body. */
bool jox_bodies_hold(JoxBodies *bodies, uint32_t row, uint32_t agent_id);
/* Where the carried body is, centre of mass, and how it moves. */
void jox_bodies_carry(JoxBodies *bodies, uint32_t row, JoxV3 centre, JoxV3 velocity);
void jox_bodies_let_go(JoxBodies *bodies, uint32_t row, JoxV3 velocity);
/* Acts at the centre of mass throughout the next step, N; adds to what was given before. */
bool jox_bodies_force(JoxBodies *bodies, uint32_t row, JoxV3 force);
/* Applied in the order given; a kinematic body feels them, and does not move by them. Rows that are
   dead or static and impulses that are not finite are passed over. Returns how many were passed
   over or clamped. */
uint32_t jox_bodies_impulses(JoxBodies *bodies, const JoxImpulse *impulses, uint32_t count);

/* What these impulses and the hits of a step came to for a body since the last
   jox_bodies_count_impulses: impulse, N s, and angular impulse about its centre of mass, N m s; of
   a body that nothing pushes zeros. False where there is no such body. */
bool jox_bodies_given(const JoxBodies *bodies, uint32_t row, double impulse[3], double turn[3]);
/* They are counted from zero from here on. */
void jox_bodies_count_impulses(JoxBodies *bodies);

/* In the next step a kinematic body that met its force limit goes `share` of its way, 0 to 1; one
   on a path that reopens goes back from there. True if it met nothing in the step before. */
bool jox_bodies_hold_up(JoxBodies *bodies, uint32_t row, float share);
/* Whether the world ends where a body meets its force limit. */
bool jox_bodies_ends_run(const JoxBodies *bodies, uint32_t row);

/* Momentum of all moving bodies, with what the next step is still to give them, kg m/s. */
void jox_bodies_momentum(const JoxBodies *bodies, double out[3]);

/* A person as a fast body meets it: an upright cylinder that moves evenly during the step. */
typedef struct JoxDisc {
    uint32_t id;          /* ties go to the lower */
    float x, y;           /* at the step's start, m */
    float move_x, move_y; /* way during the step, m */
    float radius, mass;   /* m, kg */
    float vx, vy;         /* m/s; changed by what hits it */
} JoxDisc;

/* A fast body hit a disc: impulse on the disc, N s; the opposite was given to the body. */
typedef struct JoxDiscHit {
    uint32_t disc;   /* index in the array given */
    uint32_t object; /* row */
    JoxV3 point;     /* m */
    JoxV2 impulse;
} JoxDiscHit;

/* A body that is lost: below the ground, no numbers, 10 km from the origin, through a wall. */
typedef enum { JOX_BODY_FELL, JOX_BODY_NOT_FINITE, JOX_BODY_LEFT, JOX_BODY_PASSED_WALL } JoxBodyEnd;
typedef struct JoxBodyGone {
    uint32_t row, id;
    JoxBodyEnd why;
    char name[64];
    JoxV3 at, before, velocity; /* m, m before the substep, m/s */
    JoxV3 force;                /* that people gave it, N */
} JoxBodyGone;

/* Bonds that broke in a step. The greatest piece goes on as the body that it was; the others are
   new bodies with its tags, in the order of their least block, and move as they did while whole. */
typedef struct JoxBodyBreak {
    uint32_t row, id;
    uint32_t bonds;  /* cut in this step */
    uint32_t pieces; /* that the body is in now; 1: still whole */
} JoxBodyBreak;

/* What a step did; the arrays are valid until the next call on `bodies`. */
typedef struct JoxBodiesReport {
    const JoxDiscHit *hits; /* in order of time, then body id */
    uint32_t hit_count;
    const JoxBodyGone *gone; /* bodies that were lost: put back at rest, by the def, or taken out */
    uint32_t gone_count;
    const JoxBodyBreak *breaks; /* in order of id */
    uint32_t break_count;
    double hit_impulse, hit_residual; /* sizes of the hits' impulses; of what bodies and discs, in
                                         the plane, were not given alike: N s */
    uint32_t substeps;
    double bullet_s; /* wall time of Bullet's own steps; 0 unless it was asked for */
} JoxBodiesReport;

/* Advances by dt seconds in equal substeps of at most 1/60 s, shorter (to 1/480 s) while a ball
   would move by more than its radius. Small bodies (bounding radius up to 0.75 m) that move more
   than 0.1 m in the step are swept against the discs, as spheres; those carry JoxObject.swept, and
   forces must leave them out. `discs` may be NULL. */
JoxBodiesReport jox_bodies_step(JoxBodies *bodies, float dt, JoxDisc *discs, uint32_t disc_count);
/* Whether steps tell how long Bullet took. At first they do not: reading clocks takes time. */
void jox_bodies_set_timed(JoxBodies *bodies, bool timed);
/* True if the next step would sweep any body: only then are discs needed. */
bool jox_bodies_any_fast(const JoxBodies *bodies, float dt);

/* Bullet keeps contacts, a search tree and counters from step to step, and what it computes depends
   on them. At fixed steps everything is taken out of Bullet's world and put back in order of id,
   with the contacts that there were: what is left is the bodies' own state (image.h), and a state
   that was saved just before goes on as the run itself does. Costs less than one step of these
   bodies. What stands moves by less than half a millimetre, but the order in which Bullet solves
   contacts changes, and with that how the load of a wall is spread over its feet. */
enum { JOX_BODIES_REINSERT_STEPS = 128 };
void jox_bodies_reinsert(JoxBodies *bodies);

/* Writes what agents see. Rows keep their index; `objects->rows` is owned by `bodies`. A compound
   shows the hull of all its parts as its footprint. Contacts are listed when somebody asks for
   them, which holds until bodies step or are changed. */
void jox_bodies_objects(JoxBodies *bodies, JoxObjects *objects);
/* What holds a body of blocks together; false, and all zero, for other bodies. */
typedef struct JoxBodyBonds {
    uint32_t blocks, bonds; /* still joined to this body; between them */
    double load_ratio; /* in the last step, of the bond nearest to breaking: force over strength */
} JoxBodyBonds;
bool jox_bodies_bonds(const JoxBodies *bodies, uint32_t row, JoxBodyBonds *bonds);
/* Lists all that the bodies' future depends on (image.h). Restoring replaces the bodies, whatever
   there were; the walls must be those of the saved state before, and stay. What Bullet keeps
   between two re-insertions is no part of it: only a state that is saved where the next step begins
   with one goes on to the bit. */
void jox_bodies_sections(JoxBodies *bodies, JoxSections *sections);
/* Adds the hash of these sections. */
void jox_bodies_hash(const JoxBodies *bodies, JoxHash *hash);
/* Whether this build has Bullet. */
bool jox_bodies_available(void);

#endif
