/* Rigid bodies: C interface to Bullet, called by world/ and run/. Metres, kilograms, seconds,
   radians; z up, ground at z = 0.

   Order of calls in a step of the world: jox_bodies_objects tells agents what they see;
   jox_bodies_impulses applies what agents did; jox_bodies_step moves the bodies and returns what
   happened. A body is addressed by its row, which may be reused after its removal, or by its id,
   which is not. `JoxBodies` owns all memory, also that of results, unless a comment says
   otherwise. Agents are not in Bullet's world: they read JoxObjects, give impulses, and meet
   fast bodies as discs. In a build without Bullet adding a body fails with a text that says so,
   and all else does nothing. Single-threaded; the same calls in the same order give the same
   bits. */
#ifndef JOX_BODY_BODY_H
#define JOX_BODY_BODY_H

#include <stdbool.h>
#include <stdint.h>

#include "base/sections.h"
#include "base/text.h"
#include "body/drive_path.h"
#include "geom/objects.h"
#include "geom/walls.h"
#include "jostle.h"

#define JOX_NO_BODY UINT32_MAX

/* N: default force limit of kinematic bodies, the load at which one person is estimated to die
   within 15 s (Hopkins et al. 1993, in Lee and Hughes 2006). A body that may press people harder
   must be defined so. */
#define JOX_DRIVE_FORCE 6227.0

typedef struct JoxBodies JoxBodies;
typedef struct JoxBodyPart JoxBodyPart;

typedef enum JoxShapeKind {
    JOX_SHAPE_BOX,      /* size: lengths along x, y, z */
    JOX_SHAPE_SPHERE,   /* size[0]: radius */
    JOX_SHAPE_CYLINDER, /* size[0]: radius, size[1]: height; the axis is z */
    JOX_SHAPE_HULL,     /* convex hull of 4 to 256 points: x0, y0, z0, x1, ... */
    JOX_SHAPE_COMPOUND, /* 1 to 4096 parts, none of them a compound */
    JOX_SHAPE_BLOCKS    /* size: lengths of one block; `count` blocks along x, y, z, bonded: see
                           bonds.h */
} JoxShapeKind;

typedef struct JoxShape {
    JoxShapeKind kind;
    double size[3]; /* m */
    const double *points;
    uint32_t point_count;
    const JoxBodyPart *parts;
    uint32_t part_count;
    uint32_t count[3]; /* number of blocks along x, y, z, at most 4096 in all; not for a part of a
                          compound */
    double bond;       /* strength of the bond between two blocks, N */
} JoxShape;

struct JoxBodyPart {
    JoxShape shape;
    double position[3];   /* origin of the part's frame in the body's, m */
    double turn[4];       /* quaternion x, y, z, w; all zero is no turn */
    double mass, density; /* kg; kg/m3, read if mass is 0; neither is read in a static body */
};

/* Definition of a body; jox_bodies_add copies everything. Start from jox_body_def. */
typedef struct JoxBodyDef {
    JoxShape shape;
    double position[3];          /* origin of the shape's own frame (not the centre of mass), m */
    double turn[4];              /* quaternion x, y, z, w; all zero is no turn */
    double velocity[3], spin[3]; /* velocity of the centre of mass, m/s; angular velocity, rad/s */
    double mass;                 /* kg; if density is 0 too, the body is static */
    double density;              /* kg/m3; read if mass is 0 */
    bool still;                  /* static whatever the mass */
    bool kinematic; /* moves, whatever its mass, by its velocity and spin, or along its path, and
                       nothing deflects it */
    /* path of the shape's own frame; its first point is `position`. No points: no path */
    JoxBodyPath path;
    /* N: greatest total force with which a kinematic body presses the people in its way; at the
       limit it moves only as fast as they give way; 0: no limit */
    double force_limit;
    bool ends_run; /* the world ends when the force limit is reached */
    /* multiplied with those of the other body; ground and walls have 1 */
    double friction, restitution;
    double damping, spin_damping; /* share of velocity lost in a second, 0 to 1 */
    uint64_t tags;
    const char *name; /* or NULL */
} JoxBodyDef;
/* Returns a definition with defaults: a box of 1 m, 10 kg, friction 0.6, restitution 0, no
   damping; a force limit of JOX_DRIVE_FORCE. */
JoxBodyDef jox_body_def(void);

typedef struct JoxBodiesDef {
    double gravity;     /* m/s2, downwards */
    bool ground;        /* a plane at z = 0 */
    double kill_height; /* m; a body whose centre is below is lost */
    /* reaction to a lost body; JO_LOST_END removes it, and the caller ends the world */
    JoLost lost;
    /* m/s: largest change of a velocity by one impulse, which is clamped to it */
    double most_change;
    double person_height;   /* m, of the discs of jox_bodies_step */
    double person_hardness; /* factor on a body's restitution when it hits a person */
} JoxBodiesDef;
/* Returns a definition with defaults: 9.81, ground, -50 m, 500 m/s, 1.75 m, 0.5. */
JoxBodiesDef jox_bodies_def(void);

/* Creates an empty set of bodies, never NULL; free it with jox_bodies_free. Bullet's own world
   is made with the first body. */
JoxBodies *jox_bodies_create(const JoxBodiesDef *def);
void jox_bodies_free(JoxBodies *bodies);
/* Sets the static walls, from the ground to their height, or to `height`, m, if theirs is not
   finite. Thin ones are 4 cm thick. Each call replaces the earlier walls, and wakes sleeping
   bodies. */
void jox_bodies_set_walls(JoxBodies *bodies, const JoxWalls *walls, float height);
/* Sets the sheets along y that bodies must not leave: where the first begins, and the pitch, m. */
void jox_bodies_set_sheets(JoxBodies *bodies, float origin, float pitch);

/* Adds a body. Returns its row, or JOX_NO_BODY with a sentence in `error` (which may be NULL).
   Rows of removed bodies are reused; ids are not. */
uint32_t jox_bodies_add(JoxBodies *bodies, const JoxBodyDef *def, JoxText *error);
/* Removes a body; false if there is none in that row. */
bool jox_bodies_remove(JoxBodies *bodies, uint32_t row);
uint32_t jox_bodies_count(const JoxBodies *bodies);
/* Number of rows, including those of removed bodies. */
uint32_t jox_bodies_rows(const JoxBodies *bodies);
/* Row of the live body with this id or name, or JOX_NO_BODY. */
uint32_t jox_bodies_find(const JoxBodies *bodies, uint32_t id);
uint32_t jox_bodies_find_name(const JoxBodies *bodies, const char *name);
/* Id of the live body in a row, or JOX_NO_BODY. */
uint32_t jox_bodies_id(const JoxBodies *bodies, uint32_t row);
/* Name of the body in a row, "" if it has none. Valid while the body lives. */
const char *jox_bodies_name(const JoxBodies *bodies, uint32_t row);

typedef struct JoxPose {
    JoxV3 position; /* origin of the shape's own frame, m */
    float turn[4];  /* quaternion x, y, z, w */
    JoxV3 centre;   /* centre of mass, m */
    JoxV3 velocity; /* velocity of the centre of mass, m/s */
    JoxV3 spin;     /* rad/s */
    float mass;     /* kg; 0 for a static or kinematic body */
    JoxV3 inertia;  /* principal moments, kg m2; 0 for a static or kinematic body */
    bool kinematic;
} JoxPose;
/* Writes the pose and motion of a body. False, and `pose` zero, if there is none in that row. */
bool jox_bodies_pose(const JoxBodies *bodies, uint32_t row, JoxPose *pose);
/* One convex part of a body, for drawing. */
typedef struct JoxBodyLook {
    JoxShapeKind kind;    /* box, sphere, cylinder or hull */
    float size[3];        /* m, as of JoxShape */
    JoxV3 at;             /* origin of the part's frame in the shape's own, m */
    float turn[4];        /* quaternion x, y, z, w */
    const JoxV3 *corners; /* corners of a hull in the part's frame, m; valid until the next call */
    uint32_t corner_count;
} JoxBodyLook;
/* Writes part number `part` of a body; false if it has no such part. Pieces that broke off are
   bodies of their own. */
bool jox_bodies_describe_part(const JoxBodies *bodies, uint32_t row, uint32_t part,
                              JoxBodyLook *out);
/* Sets the velocity of the centre of mass, m/s, and the spin, rad/s. False, and nothing done,
   for a static body or a number that is not finite. A kinematic body keeps this velocity, and
   leaves its path. */
bool jox_bodies_set_velocity(JoxBodies *bodies, uint32_t row, JoxV3 velocity, JoxV3 spin);
/* Moves a body, also a static one: puts its shape's own frame at a position, m, turned by a
   quaternion x, y, z, w (NULL: its turn is kept), at rest. Its carrier loses it, and it leaves
   its path. False if there is no such body. */
bool jox_bodies_place(JoxBodies *bodies, uint32_t row, const double position[3],
                      const double turn[4]);
/* Makes an agent carry the body, which then touches nothing until it is let go. False for a
   static body. */
bool jox_bodies_set_carrier(JoxBodies *bodies, uint32_t row, uint32_t agent_id);
/* Moves a carried body: centre of mass, m, and velocity, m/s. */
void jox_bodies_carry(JoxBodies *bodies, uint32_t row, JoxV3 centre, JoxV3 velocity);
void jox_bodies_end_carrying(JoxBodies *bodies, uint32_t row, JoxV3 velocity);
/* Adds a force, N, that acts at the centre of mass throughout the next step. False for a body
   that is not dynamic or a force that is not finite. */
bool jox_bodies_force(JoxBodies *bodies, uint32_t row, JoxV3 force);
/* Applies impulses in the order given. Those on a kinematic body are only counted
   (jox_bodies_impulse_sum). Impulses on removed or static bodies or with numbers that are not
   finite are skipped. Returns how many were skipped or clamped. */
uint32_t jox_bodies_impulses(JoxBodies *bodies, const JoxImpulse *impulses, uint32_t count);

/* Reads the sum of these impulses and of hits on people for a body since the last
   jox_bodies_reset_impulse_sums: impulse, N s, and angular impulse about its centre of mass, N m s;
   zeros for a body that nothing pushed. False if there is no such body. */
bool jox_bodies_impulse_sum(const JoxBodies *bodies, uint32_t row, double impulse[3],
                            double turn[3]);
/* Resets those sums to zero for all bodies. */
void jox_bodies_reset_impulse_sums(JoxBodies *bodies);

/* Limits a kinematic body that reached its force limit to the part `share`, 0 to 1, of its way
   in the next step; on a path that reopens it goes back from there. True if it did not reach the
   limit in the step before. */
bool jox_bodies_hold_up(JoxBodies *bodies, uint32_t row, float share);
/* Whether the world ends when this body reaches its force limit. */
bool jox_bodies_ends_run(const JoxBodies *bodies, uint32_t row);

/* Total momentum of all dynamic bodies, kg m/s, including impulses that the next step is still
   to apply. */
void jox_bodies_momentum(const JoxBodies *bodies, double out[3]);

/* Person in the sweep of fast bodies: an upright cylinder that moves evenly during the step. */
typedef struct JoxDisc {
    uint32_t id;          /* decides between hits at the same time: the lower id is hit */
    uint32_t parting;     /* 1 + row of a body that passes it without a hit; 0: none */
    float x, y;           /* at the step's start, m */
    float move_x, move_y; /* displacement during the step, m */
    float radius, mass;   /* m, kg */
    float vx, vy;         /* m/s; changed by a hit */
} JoxDisc;

/* A fast body hit a disc: impulse on the disc, N s; the opposite was given to the body. */
typedef struct JoxDiscHit {
    uint32_t disc;   /* index in the array given */
    uint32_t object; /* row */
    JoxV3 point;     /* m */
    JoxV2 impulse;
} JoxDiscHit;

/* Reason why a body is lost: below the ground, a number that is not finite, 10 km from the
   origin, through a wall. */
typedef enum {
    JOX_BODY_FELL,
    JOX_BODY_NOT_FINITE,
    JOX_BODY_LEFT,
    JOX_BODY_PASSED_WALL,
    JOX_BODY_LEFT_STOREY
} JoxBodyEnd;
typedef struct JoxBodyGone {
    uint32_t row, id;
    JoxBodyEnd why;
    char name[64];
    JoxV3 at, before, velocity; /* position, m; position before the substep, m; velocity, m/s */
    JoxV3 force;                /* force of people on it, N */
} JoxBodyGone;

/* Bonds of a body that broke in a step. The largest piece keeps the body's row and id; the
   others become new bodies with its tags, in the order of their least block. All pieces keep the
   motion that they had in the whole. */
typedef struct JoxBodyBreak {
    uint32_t row, id;
    uint32_t bonds;  /* bonds that broke in this step */
    uint32_t pieces; /* pieces of the body after it; 1: still whole */
} JoxBodyBreak;

/* Result of a step; the arrays are valid until the next call on `bodies`. */
typedef struct JoxBodiesReport {
    const JoxDiscHit *hits; /* in order of time, then body id */
    uint32_t hit_count;
    const JoxBodyGone *gone; /* lost bodies: put back at rest or removed, by JoxBodiesDef.lost */
    uint32_t gone_count;
    const JoxBodyBreak *breaks; /* in order of id */
    uint32_t break_count;
    double hit_impulse, hit_residual; /* N s: sum of the hits' impulses; momentum in the plane that
                                         body and disc did not exchange equally */
    double hit_body_change, hit_person_change; /* m/s: sums over the hits of the change of velocity
                                                  in the plane, of the body and of the disc */
    uint32_t substeps;
    double bullet_s; /* wall time of Bullet's own steps, s; 0 unless jox_bodies_set_timed */
} JoxBodiesReport;

/* Advances the bodies by dt seconds in equal substeps of at most 1/60 s, shorter (to 1/480 s)
   while a fast body would move by more than its smallest half extent. Small bodies (bounding
   radius up to 0.75 m) that move more than 0.1 m in the step are swept against the discs, as
   spheres; these have JoxObject.swept set, and contact forces must leave them out. `discs` may
   be NULL. */
JoxBodiesReport jox_bodies_step(JoxBodies *bodies, float dt, JoxDisc *discs, uint32_t disc_count);
/* Switches the timing of Bullet's steps on or off. At first it is off: reading clocks takes
   time. */
void jox_bodies_set_timed(JoxBodies *bodies, bool timed);
/* Whether the next step would sweep any body: only then are discs needed. */
bool jox_bodies_any_fast(const JoxBodies *bodies, float dt);

/* Takes all bodies, walls and the ground out of Bullet's world and puts them back in order of
   id, with their present contacts. Bullet keeps contacts, a search tree and counters from step
   to step, and its results depend on them; after a re-insertion only the bodies' own state
   (image.h) is left. So a state saved just before one goes on exactly as the run itself does.
   Costs less than one step of these bodies. Standing bodies move by less than half a millimetre,
   but the order in which Bullet solves contacts changes, and with that how the load of a wall is
   spread over its feet. */
enum { JOX_BODIES_REINSERT_STEPS = 128 };
void jox_bodies_reinsert(JoxBodies *bodies);

/* Writes the objects: the bodies as agents see them, one per row. `objects->rows` is owned by
   `bodies`. The footprint of a compound is the hull of all its parts. Contacts are listed on the
   first request, and stay valid until bodies step or are changed. */
void jox_bodies_objects(JoxBodies *bodies, JoxObjects *objects);
/* Bonds of a body of blocks. jox_bodies_bonds returns false, and all zero, for other bodies. */
typedef struct JoxBodyBonds {
    uint32_t blocks, bonds; /* blocks of this body; bonds between them */
} JoxBodyBonds;
bool jox_bodies_bonds(const JoxBodies *bodies, uint32_t row, JoxBodyBonds *bonds);
/* Visits the bodies' state (image.h) as sections, to hash, save, compare or restore it.
   Restoring replaces all bodies; the walls must already be those of the saved state, and stay.
   What Bullet keeps between two re-insertions is not included: a run goes on exactly only from a
   state saved when the next step begins with a re-insertion. */
void jox_bodies_sections(JoxBodies *bodies, JoxSections *sections);
/* Adds the hash of these sections. */
void jox_bodies_hash(const JoxBodies *bodies, JoxHash *hash);
/* Whether this build has Bullet. */
bool jox_bodies_available(void);

#endif
