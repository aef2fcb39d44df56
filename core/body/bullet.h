/* Types and functions that the files bullet*.cc share; no other file includes this header.

   Calls within a step (bullet_step.cc): begin_drive, then for each substep store_poses,
   drive, Bullet's step, gather_contacts, handle_lost; then end_drive, keep_carried, break. */
#ifndef JOX_BODY_BULLET_H
#define JOX_BODY_BULLET_H

#include <cmath>
#include <math.h>
#include <stdint.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <btBulletDynamicsCommon.h>

#include <BulletCollision/CollisionDispatch/btBoxBoxCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btConvexPlaneCollisionAlgorithm.h>
#pragma GCC diagnostic pop

extern "C" {
#include "base/assert.h"
#include "base/clock.h"
#include "base/mem.h"
#include "base/sort.h"
#include "body/ball_hits.h"
#include "body/body.h"
#include "body/bonds.h"
#include "body/footprint.h"
#include "body/image.h"
#include "geom/wall_grid.h"
}

static_assert(sizeof(btScalar) == sizeof(float), "Bullet of single precision");

/* One convex part in the frame of the body's centre of mass and principal axes. */
struct JoxConvexPart {
    JoxShapeKind kind;
    float radius; /* sphere, cylinder */
    btTransform frame;
    JoxV3 *corners; /* corners of a polytope; of a prism for a cylinder; none for a sphere */
    uint32_t corner_count;
    uint32_t *edges;
    uint32_t edge_count;
    JoxV3 middle; /* centre of its bounding box in its own frame, here in the body's */
    float sphere; /* radius of the bounding sphere about it, m */
};

/* Shape made from a definition: Bullet's collision shape, the parts for footprints, and the mass
   properties. */
struct JoxBodyShape {
    /* Bullet's compound does not own `children`, which are freed one by one */
    btCollisionShape *collision;
    btCollisionShape **children;
    uint32_t child_count;
    JoxConvexPart *parts;
    uint32_t part_count;
    btTransform frame = btTransform::getIdentity(); /* frame of the centre of mass and principal
                                                       axes in the shape's own frame */
    float mass;
    btVector3 inertia = btVector3(0, 0, 0); /* principal moments */
    float inner, bound; /* smallest half extent; bounding radius about the centre of mass */
    bool still;
    JoxBodyPartRecord *source; /* definition of each part, from which a saved body is made again */
    double *source_points;     /* points of all hulls in `source` */
    uint32_t source_point_count, source_point_capacity; /* numbers */
};

/* False, with a sentence in `error`, where the definition makes no sense. */
bool jox_body_shape_make(const JoxBodyDef *def, bool still, JoxBodyShape *out, JoxText *error);
void jox_body_shape_free(JoxBodyShape *shape);

/* Material of a body. */
struct JoxMaterial {
    float friction, restitution, damping, spin_damping;
};

/* One body. Every member but `shape`, `body` and those marked scratch is state; see image.h. */
struct JoxRow {
    bool live;
    uint32_t id;
    char *name;
    uint64_t tags;
    JoxBodyShape shape;
    JoxMaterial material;
    btRigidBody *body;
    JoxV3 force;                 /* force during the next step, N */
    JoxV3 lasting, lasting_turn; /* scratch: impulse, N s, and angular impulse, N m s, spread over
                                    the next step */
    double impulse_sums[6]; /* scratch: sum of impulses since jox_bodies_reset_impulse_sums, N s,
                        and of angular impulses about the centre of mass, N m s */
    bool grounded, swept;
    int activation; /* scratch: Bullet's state of sleep */
    /* bonds of a body of blocks, in the shape's own frame; NULL for other bodies */
    JoxBondGraph *bonds;
    JoxV3 pushed;                /* scratch: the force of the last substep, N */
    btTransformFloatData before; /* scratch: pose at the start of the substep */
    bool kinematic;              /* has no mass, and moves by its velocity, or along its path */
    JoxBodyPath path;            /* path of the centre of mass; its points are owned */
    double path_time;        /* s since its start, without time held up: the position along it */
    bool goes_back;          /* moves back along the path to the start of its leg */
    float force_limit;       /* N: force limit of a kinematic body; 0: none */
    bool ends_run;           /* the world ends when that limit is reached */
    float held_up;           /* share of its way that it did not move in the last step, 0 to 1 */
    bool reached_limit;      /* the limit was reached in the last step */
    bool reaches_limit;      /* scratch: the limit will be reached in the next step */
    float way_share;         /* scratch: share of its way that the body moves in that step */
    JoxV3 drive, drive_spin; /* scratch: velocity and spin in this step if nothing holds it up */
    bool held;               /* carried by an agent */
    uint32_t holder;
    bool placed; /* scratch: its carrier moved it in this step to `carried`, m, with the velocity
                    `carried_along`, m/s */
    JoxV3 carried, carried_along;
    /* Scratch: whether its object was written since it got this shape, its pose then (origin, m,
       and rows of its rotation), and whether that was within people's height band. */
    bool shown, shown_in_band;
    float shown_at[12];
};

/* Contact point of a bonded body, with the impulse on it, N s. */
struct JoxContactLoad {
    uint32_t block;
    btVector3 point, impulse, normal;
};

/* Contacts from one of Bullet's manifolds; `key` orders runs by body, then by the other body. */
struct JoxContactRun {
    uint64_t key;
    uint32_t first, count; /* range of `contact_loads`, not empty */
};

/* Replaces Bullet's memory functions so that it never gets a null pointer. Later calls do nothing.
 */
void jox_bullet_use_memory();
/* Frees all memory that Bullet allocated while the heap was in use. */
void jox_bullet_free_heap(const JoxHeap *heap);
/* Whether bodies overlap in so many pairs that they must have been put into each other. A pair
   takes about 2 KB as soon as the bodies touch; a stack has some ten pairs per body. `error` may
   be NULL. */
bool jox_bodies_are_heaped(const JoxBodies *bodies, JoxText *error);

/* Makers of the algorithms of bullet_collide.cc, which find contacts without the C library's
 * functions. */
struct JoxBoxContactsMaker : btCollisionAlgorithmCreateFunc {
    btCollisionAlgorithm *CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo &info,
                                                   const btCollisionObjectWrapper *one,
                                                   const btCollisionObjectWrapper *two) override;
};
struct JoxGroundContactsMaker : btCollisionAlgorithmCreateFunc {
    btCollisionAlgorithm *CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo &info,
                                                   const btCollisionObjectWrapper *one,
                                                   const btCollisionObjectWrapper *two) override;
};
/* Chooses the algorithm for each pair of kinds of shapes. */
struct JoxBulletConfiguration : btDefaultCollisionConfiguration {
    JoxBoxContactsMaker boxes;
    JoxGroundContactsMaker ground, ground_first;
    explicit JoxBulletConfiguration(const btDefaultCollisionConstructionInfo &info);
    btCollisionAlgorithmCreateFunc *getCollisionAlgorithmCreateFunc(int one, int two) override;
};

/* Bullet's world and solver, without work on sleeping and slow bodies that changes nothing, and
   without the C library's functions. Bullet predicts contacts of fast bodies apart from its pairs:
   these stay until the next step, and must be removed together with the body. */
struct JoxBulletWorld : btDiscreteDynamicsWorld {
    using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;
    void remove(btRigidBody *body);
    void release_predictions(); /* removes all predicted contacts */
    void performDiscreteCollisionDetection() override;

  protected:
    void saveKinematicState(btScalar dt) override;
    void predictUnconstraintMotion(btScalar dt) override;
    void createPredictiveContacts(btScalar dt) override;
    void integrateTransforms(btScalar dt) override;

  private:
    void integrate_fast(btRigidBody *body, btScalar dt);
};
struct JoxBulletSolver : btSequentialImpulseConstraintSolver {
    btScalar solveGroupCacheFriendlyFinish(btCollisionObject **bodies, int count,
                                           const btContactSolverInfo &info) override;
};

struct JoxBodies {
    JoxHeap *heap; /* heap in use when it was created */
    JoxBodiesDef def;
    JoxBulletConfiguration *configuration;
    btCollisionDispatcher *dispatcher;
    btDbvtBroadphase *broadphase;
    JoxBulletSolver *solver;
    JoxBulletWorld *world; /* NULL until the first body or wall */
    btCollisionShape *ground_shape;
    btRigidBody *ground;
    btRigidBody **walls;
    uint32_t wall_count, wall_capacity;
    bool walls_raised;     /* `walls` are in Bullet's world; false until there is a body */
    JoxWalls standing;     /* closed walls of the scene, from which `walls` are made */
    JoxWallGrid wall_grid; /* grid over `standing`, for the guard; empty until a body moves */
    float wall_height;     /* m: height of walls without one */
    float origin, pitch;   /* m along y: sheets, which bodies must not leave; pitch 0: one plane */
    JoxRow *rows;
    uint32_t count, capacity;
    uint32_t *order; /* rows of live bodies in order of id */
    uint32_t live, order_capacity;
    uint32_t next_id;
    float last_dt;
    bool timed;
    JoxObject *objects;
    uint32_t object_capacity;
    JoxObjectContact *object_contacts;
    uint32_t object_contact_capacity;
    JoxDiscHit *hits;
    uint32_t hit_count, hit_capacity;
    double hit_impulse, hit_residual;          /* totals of the step, N s */
    double hit_body_change, hit_person_change; /* likewise, m/s */
    JoxBodyGone *gone;
    uint32_t gone_count, gone_capacity;
    JoxContactLoad *contact_loads; /* contacts of bonded bodies in a substep */
    uint32_t contact_load_count, contact_load_capacity;
    JoxContactRun *contact_runs; /* runs of `contact_loads`, sorted by key */
    uint32_t contact_run_count, contact_run_capacity;
    JoxBondContact *contacts; /* scratch: contacts of one bonded body with one other body */
    uint32_t contact_capacity;
    JoxBodyBreak *breaks;
    uint32_t break_count, break_capacity;
    uint32_t bonded; /* number of bodies with bonds */
    /* Contacts with which the solver starts after the next re-insertion: noted there, or read
       from a saved state if `restored`. */
    JoxContactRecord *saved_contacts;
    uint32_t saved_contact_count, saved_contact_capacity;
    bool restored;
    /* image that is hashed in place of the bodies while a test changes its cells */
    JoxBodiesImage *visited;
    JoxDiscGrid grid;
    JoxFootprint footprint;
    JoxV3 *corners; /* scratch: a part's corners in world coordinates */
    uint32_t corner_capacity;
};

template <class T> static inline void jox_reserve(T *&array, uint32_t &capacity, uint32_t need) {
    if (need <= capacity)
        return;
    uint32_t c = capacity ? 2 * capacity : 8;
    capacity = c < need ? need : c;
    array = static_cast<T *>(jox_realloc(array, capacity, sizeof(T)));
}

static inline btVector3 jox_bt(JoxV3 v) {
    return btVector3(v.x, v.y, v.z);
}
static inline JoxV3 jox_v3(const btVector3 &v) {
    return JoxV3{v.x(), v.y(), v.z()};
}
static inline bool jox_finite(const btVector3 &v) {
    return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

/* Creates Bullet's world, with the walls, unless it exists. Called before a body is added. */
void jox_bodies_ensure(JoxBodies *bodies);
/* Moves carried bodies back to where their carriers put them, whatever Bullet did. Called after
   a step; in bullet_place.cc. */
void jox_bodies_keep_carried(JoxBodies *bodies);
void jox_bodies_drop_row(JoxBodies *bodies, uint32_t row);
/* Removes all pairs. Called before many bodies leave Bullet's world; in bullet_memory.cc. */
void jox_bodies_remove_pairs(JoxBodies *bodies);
/* In bullet_guard.cc. Store the poses before a substep; find lost bodies after it, list them,
   and remove them or put them back. */
void jox_bodies_store_poses(JoxBodies *bodies);
void jox_bodies_handle_lost(JoxBodies *bodies);
/* Adds a body in a free row, which takes over `shape`; the caller sets name, tags, and velocity.
   Returns the row. */
uint32_t jox_row_add(JoxBodies *bodies, const JoxBodyShape *shape, const btTransform &frame,
                     const JoxMaterial &material, bool kinematic);
/* Creates Bullet's body for a row whose shape is set; `frame` is the pose of the shape's own
   frame. */
void jox_row_create_body(JoxBodies *bodies, uint32_t row, const btTransform &frame,
                         const JoxMaterial &material);
/* In bullet_drive.cc. Make a static body kinematic; start the path of its definition; copy a
   path of its centre of mass; remove its path. */
void jox_row_make_kinematic(JoxRow *row);
void jox_row_begin_path(JoxRow *row, const JoxBodyDef *def);
void jox_row_set_path(JoxRow *row, const JoxBodyPath *path);
void jox_row_leave_path(JoxRow *row);
/* Prepare driven bodies before a step; set their velocities before a substep of dt seconds;
   after the step restore the velocities with which they go on if nothing holds them up. */
void jox_bodies_begin_drive(JoxBodies *bodies);
void jox_bodies_drive(JoxBodies *bodies, float dt);
void jox_bodies_end_drive(JoxBodies *bodies);
/* Creates the bonds of a body of blocks, NULL with a sentence in `error`; and the shape of
   bonded blocks, false with a sentence in `error`. */
JoxBondGraph *jox_row_make_bonds(const JoxBodyDef *def, JoxText *error);
bool jox_body_shape_of_blocks(const JoxBondGraph *bonds, bool still, JoxBodyShape *out,
                              JoxText *error);
/* Returns the row of a live body, or NULL. */
static inline JoxRow *jox_live_row(const JoxBodies *b, uint32_t row) {
    return row < b->count && b->rows[row].live ? &b->rows[row] : nullptr;
}
/* Returns the shape's own frame in world coordinates. */
static inline btTransform jox_row_frame(const JoxRow *row) {
    return row->body->getWorldTransform() * row->shape.frame.inverse();
}
/* Adds an impulse, N s, with its arm from the centre of mass, m, to the sums of
   jox_bodies_impulse_sum. */
void jox_row_count_impulse(JoxRow *row, const btVector3 &impulse, const btVector3 &arm);
/* Adds an impulse, N s, at a point, m, in world coordinates to the loads of a bonded body. */
void jox_row_add_impulse(JoxRow *row, const btVector3 &point, const btVector3 &impulse);
/* Add the contacts with ground, walls and bodies to the loads of bonded bodies after a substep;
   break overloaded bonds after a step. */
void jox_bodies_gather_contacts(JoxBodies *bodies);
void jox_bodies_break(JoxBodies *bodies, float dt);
void jox_bodies_raise_walls(JoxBodies *bodies);
void jox_bodies_drop_walls(JoxBodies *bodies);
/* Creates a body that never moves. Its user index is negative and unique: -1 for the ground,
   then the walls. */
btRigidBody *jox_static_make(btCollisionShape *shape, const btTransform &at, int index);
void jox_static_drop(JoxBodies *bodies, btRigidBody *body);
/* In bullet_contacts.cc. Write the contacts with which the solver would start, and return their
   number; give these to the contacts that Bullet finds after a re-insertion. */
uint32_t jox_bodies_note_contacts(const JoxBodies *bodies, JoxContactRecord *&contacts,
                                  uint32_t &capacity);
void jox_bodies_renew_contacts(JoxBodies *bodies, const JoxContactRecord *contacts, uint32_t count);
/* Lists the contacts of dynamic bodies for JoxObjects; `bodies` is a JoxBodies. */
JoxObjectContacts jox_bodies_list_contacts(void *bodies);
/* In bullet_parts.cc. Set a part's bounding sphere, once its frame and corners are those of the
   body; advance to the next part for JoxObjects; `bodies` is a JoxBodies. */
void jox_part_set_sphere(JoxConvexPart *part, const btVector3 &middle);
bool jox_bodies_next_part(const void *bodies, JoxPartWalk *walk, JoxObjectPart *part);
/* Whether a body moves so fast that a step of dt seconds sweeps it against people. */
bool jox_row_is_fast(const JoxRow *row, float dt);

/* Assertions, in bullet_check.cc: on a new shape; on rows and Bullet's world; on the result of a
   step; on the sorted contacts of bonded bodies. */
void jox_body_shape_check(const JoxBodyShape *shape);
void jox_bodies_check(const JoxBodies *bodies);
void jox_bodies_report_check(const JoxBodies *bodies, uint32_t disc_count);
void jox_contact_loads_check(const JoxBodies *bodies);

#endif
