/* Shared by bullet*.cc alone. */
#ifndef JOX_BODY_BULLET_H
#define JOX_BODY_BULLET_H

#include <cmath>
#include <math.h>
#include <stdint.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <btBulletDynamicsCommon.h>
#pragma GCC diagnostic pop

extern "C" {
#include "base/assert.h"
#include "base/clock.h"
#include "base/mem.h"
#include "base/sort.h"
#include "body/body.h"
#include "body/bonds.h"
#include "body/footprint.h"
#include "body/image.h"
#include "body/sweep.h"
#include "geom/wall_grid.h"
}

static_assert(sizeof(btScalar) == sizeof(float), "Bullet of single precision");

/* One convex part in the frame of the body's centre of mass and principal axes. */
struct JoxConvexPart {
    JoxShapeKind kind;
    float radius; /* sphere, cylinder */
    btTransform frame;
    JoxV3 *corners; /* of a polytope; a cylinder as a prism; none for a sphere */
    uint32_t corner_count;
    uint32_t *edges;
    uint32_t edge_count;
};

/* What a definition comes to: the shape for Bullet, the parts for footprints, and the mass. */
struct JoxBodyShape {
    btCollisionShape *collision; /* a compound owns nothing: `children` are freed one by one */
    btCollisionShape **children;
    uint32_t child_count;
    JoxConvexPart *parts;
    uint32_t part_count;
    btTransform frame = btTransform::getIdentity(); /* of the centre of mass and principal axes in
                                                       the shape's own frame */
    float mass;
    btVector3 inertia = btVector3(0, 0, 0); /* principal moments */
    float inner, bound; /* smallest half extent; bounding radius about the centre of mass */
    bool still;
    JoxBodyPartRecord *source; /* of each part: what it was made of, to make it again */
    double *source_points;     /* of all hulls among them */
    uint32_t source_point_count, source_point_capacity; /* numbers */
};

/* False, with a sentence in `error`, where the definition makes no sense. */
bool jox_body_shape_make(const JoxBodyDef *def, bool still, JoxBodyShape *out, JoxText *error);
void jox_body_shape_free(JoxBodyShape *shape);

/* What a body is made of beside its shape. */
struct JoxMaterial {
    float friction, restitution, damping, spin_damping;
};

/* Everything of a live row but `shape`, `body` and `activation` is state; see image.h. */
struct JoxRow {
    bool live;
    uint32_t id;
    char *name;
    uint64_t tags;
    JoxBodyShape shape;
    JoxMaterial material;
    btRigidBody *body;
    JoxV3 force;                 /* over the next step, N */
    JoxV3 lasting, lasting_turn; /* impulse and angular impulse spread over the step that is next:
                                    scratch, N s and N m s */
    double given[6]; /* scratch: what impulses came to since it was last asked to begin anew, N s,
                        and about the centre of mass, N m s */
    bool grounded, swept;
    int activation;      /* scratch: Bullet's state of sleep */
    JoxBondGraph *bonds; /* of blocks that can come apart, or NULL; its frame is the shape's own */
    JoxV3 pushed;        /* scratch: the force of the last substep, N */
    btTransformFloatData before; /* scratch: where the substep began */
    bool kinematic;              /* no mass, and moved by its velocity, or along its path */
    JoxBodyPath path;            /* of the centre of mass; its points are owned */
    double path_time;            /* s, since it began: how far along it is */
    bool goes_back;              /* along the path, to where its leg began */
    float force_limit;           /* N: of a kinematic one; 0: none */
    bool ends_run;               /* where it meets that */
    float held_up;               /* share of its way that it did not go in the last step, 0 to 1 */
    bool met;                    /* its limit, in the last step */
    bool meets;                  /* scratch: in the step that is next; then so much of its way is */
    float goes;                  /* left */
    JoxV3 drive, drive_spin;     /* scratch: how it goes in this step if nothing holds it up */
    bool held;                   /* by an agent */
    uint32_t holder;
    bool placed; /* scratch: held where its carrier put it for this step, at `carried`, m, with the
                    velocity `carried_along`, m/s */
    JoxV3 carried, carried_along;
    /* Scratch: whether its object was written since it has this shape, where it lay then (origin,
       m, and rows of its rotation), and whether people could reach it there. */
    bool shown, shown_in_band;
    float shown_at[12];
};

/* A contact of a bonded body. */
struct JoxContactLoad {
    uint32_t block;
    btVector3 point, impulse, normal;
};

/* Those of one of Bullet's manifolds; `key` orders them by body, then by what it touches. */
struct JoxContactRun {
    uint64_t key;
    uint32_t first, count; /* among the contacts, at least one */
};

/* Has Bullet allocate so that it meets no null pointer. */
void jox_bullet_use_memory();
/* Frees what Bullet allocated while the heap was in use. */
void jox_bullet_free_heap(const JoxHeap *heap);
/* Whether bodies meet in so many pairs that they must begin in each other. A pair takes about 2 KB
   as soon as they touch; those of what is stacked are some ten for each body.
   `error` may be NULL. */
bool jox_bodies_are_heaped(const JoxBodies *bodies, JoxText *error);

/* Bullet's world, without what it does in vain of bodies that sleep or are slow. Contacts that it
   foresees of fast bodies are not those of its pairs: they stay until the next step, and have to be
   taken out with what they are of. */
struct JoxBulletWorld : btDiscreteDynamicsWorld {
    using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;
    void remove(btRigidBody *body);
    void release_predictions(); /* of all bodies, which then are in no contact that is foreseen */
    void performDiscreteCollisionDetection() override;

  protected:
    void saveKinematicState(btScalar dt) override;
    void predictUnconstraintMotion(btScalar dt) override;
    void createPredictiveContacts(btScalar dt) override;
    void integrateTransforms(btScalar dt) override;
};

struct JoxBodies {
    JoxHeap *heap; /* in use where it was made */
    JoxBodiesDef def;
    btDefaultCollisionConfiguration *configuration;
    btCollisionDispatcher *dispatcher;
    btDbvtBroadphase *broadphase;
    btSequentialImpulseConstraintSolver *solver;
    JoxBulletWorld *world; /* NULL until the first body or wall */
    btCollisionShape *ground_shape;
    btRigidBody *ground;
    btRigidBody **walls;
    uint32_t wall_count, wall_capacity;
    bool walls_raised;     /* they are there; not before a body is */
    JoxWalls standing;     /* of which these are made */
    JoxWallGrid wall_grid; /* over them, for the guard; empty until something moves */
    float wall_height;     /* m: where none is given */
    JoxRow *rows;
    uint32_t count, capacity;
    uint32_t *order; /* live rows in order of id */
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
    double hit_impulse, hit_residual; /* N s, of the step */
    JoxBodyGone *gone;
    uint32_t gone_count, gone_capacity;
    JoxContactLoad *contact_loads; /* contacts of bonded bodies in a substep */
    uint32_t contact_load_count, contact_load_capacity;
    JoxContactRun *contact_runs; /* of them, sorted */
    uint32_t contact_run_count, contact_run_capacity;
    JoxBondContact *contacts; /* of one of them with one other body */
    uint32_t contact_capacity;
    JoxBodyBreak *breaks;
    uint32_t break_count, break_capacity;
    uint32_t bonded; /* bodies that can come apart */
    /* What the solver begins from after the next re-insertion: noted there, or, `restored`, from a
       saved state. */
    JoxContactRecord *kept;
    uint32_t kept_count, kept_capacity;
    bool restored;
    JoxBodiesImage *visited; /* while a test changes its cells: then it is what is hashed */
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

/* Before a body is added: makes Bullet's world, with the walls, if it is not there yet. */
void jox_bodies_ensure(JoxBodies *bodies);
/* bullet_place.cc, after a step: what is carried is where it was put, whatever Bullet made of it.
 */
void jox_bodies_keep_carried(JoxBodies *bodies);
void jox_bodies_drop(JoxBodies *bodies, uint32_t row);
/* bullet_memory.cc: before many bodies leave Bullet's world. */
void jox_bodies_remove_pairs(JoxBodies *bodies);
/* bullet_guard.cc, before and after each substep: lists bodies that are lost, and takes them out or
   puts them back. */
void jox_bodies_guard_begin(JoxBodies *bodies);
void jox_bodies_guard(JoxBodies *bodies);
/* Takes `shape` over as a new body in a free row; the caller fills name, tags, and velocity. */
uint32_t jox_row_add(JoxBodies *bodies, const JoxBodyShape *shape, const btTransform &frame,
                     const JoxMaterial &material, bool kinematic);
/* Bullet's body of a row whose shape is there: `frame` is that of the shape. */
void jox_row_create_body(JoxBodies *bodies, uint32_t row, const btTransform &frame,
                         const JoxMaterial &material);
/* bullet_drive.cc. Makes a still body of a row one that moves by its velocity; sets it upon the
   path of its definition, gives it a copy of a path of its centre of mass, or takes that away. */
void jox_row_make_kinematic(JoxRow *row);
void jox_row_begin_path(JoxRow *row, const JoxBodyDef *def);
void jox_row_set_path(JoxRow *row, const JoxBodyPath *path);
void jox_row_leave_path(JoxRow *row);
/* Before a step: how far driven bodies go in it. Before a substep: the velocities that lead them
   there. After a step: those with which they go on if nothing holds them up. */
void jox_bodies_begin_drive(JoxBodies *bodies);
void jox_bodies_drive(JoxBodies *bodies, float dt);
void jox_bodies_driven(JoxBodies *bodies);
/* The shape of bonded blocks; NULL with a sentence in `error`. */
JoxBondGraph *jox_row_bonds(const JoxBodyDef *def, JoxText *error);
bool jox_body_shape_of_blocks(const JoxBondGraph *bonds, bool still, JoxBodyShape *out,
                              JoxText *error);
/* A live row, or NULL. */
static inline JoxRow *jox_row_of(const JoxBodies *b, uint32_t row) {
    return row < b->count && b->rows[row].live ? &b->rows[row] : nullptr;
}
/* The shape's own frame in the world. */
static inline btTransform jox_row_frame(const JoxRow *row) {
    return row->body->getWorldTransform() * row->shape.frame.inverse();
}
/* Counts an impulse at an arm from the centre of mass among those that a body was given. */
void jox_row_count_impulse(JoxRow *row, const btVector3 &impulse, const btVector3 &arm);
/* An impulse upon a bonded body, at a point of the world. */
void jox_row_add_impulse(JoxRow *row, const btVector3 &point, const btVector3 &impulse);
/* After a substep: what ground, walls and bodies did to bonded ones. After a step: what broke. */
void jox_bodies_gather_contacts(JoxBodies *bodies);
void jox_bodies_break(JoxBodies *bodies, float dt);
void jox_bodies_raise_walls(JoxBodies *bodies);
void jox_bodies_drop_walls(JoxBodies *bodies);
/* What never moves. Its user index is negative and its own: -1 the ground, then the walls. */
btRigidBody *jox_static_make(btCollisionShape *shape, const btTransform &at, int index);
void jox_static_drop(JoxBodies *bodies, btRigidBody *body);
/* bullet_contacts.cc. Writes what the solver would begin from, and says how many; gives it to the
   contacts that are found in a world into which everything was just put. */
uint32_t jox_bodies_note_contacts(const JoxBodies *bodies, JoxContactRecord *&contacts,
                                  uint32_t &capacity);
void jox_bodies_renew_contacts(JoxBodies *bodies, const JoxContactRecord *contacts, uint32_t count);
/* Lists the contacts of moving bodies as others see them; `bodies`: JoxBodies. */
JoxObjectContacts jox_bodies_list_contacts(void *bodies);
/* Whether a body at this speed is to be swept in a step of dt. */
bool jox_row_fast(const JoxRow *row, float dt);

/* bullet_check.cc: a shape that was just made; rows against Bullet's world; what a step hands out;
   the sorted contacts of bonded bodies. */
void jox_body_shape_check(const JoxBodyShape *shape);
void jox_bodies_check(const JoxBodies *bodies);
void jox_bodies_report_check(const JoxBodies *bodies, uint32_t disc_count);
void jox_contact_loads_check(const JoxBodies *bodies);

#endif
