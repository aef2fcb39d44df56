/* Jostle: dense crowds that push, with bodies and behaviours. What a program that embeds it may
 * call.
 *
 * Units are SI throughout: metres, seconds, kilograms, newtons, radians; x east, y north, z up.
 * Plain C17, clean in C++. One world must not be used from two threads at once; different worlds
 * may. Misuse (a null or stale handle, a field out of range in a Def made by hand) is reported
 * through the assertion handler and answered with a null handle, zero or false; bad files and
 * values give a JoError. The library never exits, leaves signals as the program set them, and
 * blocks them in its own threads.
 *
 * Where memory is out, a call returns its error (JO_FAILED, "out of memory") or NULL, false or 0.
 * The world or scene that it was changing has then failed: later calls answer the same way,
 * jo_world_failure says why, and freeing it releases all that it held. Other worlds go on.
 */
#ifndef JOSTLE_H
#define JOSTLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define JO_API __attribute__((visibility("default")))
#else
#define JO_API
#endif

/* "0.1.0" */
JO_API const char *jo_version(void);

/* ---- errors ------------------------------------------------------------------------------ */

typedef enum JoCode {
    JO_OK = 0,
    JO_FAILED = 1, /* the run failed: a file could not be written, the disk is full */
    JO_USAGE = 2,  /* the caller's arguments make no sense */
    JO_INPUT = 3   /* a scene, behaviour or value is wrong */
} JoCode;

typedef struct JoError {
    JoCode code;
    int line, column; /* from 1; 0 unknown */
    char file[256];
    char text[1024]; /* with the way out, where one is known */
} JoError;

/* Called with each broken precondition; may return. NULL restores the default, which prints (and
   aborts in debug builds). Process-wide. */
typedef void JoAssertHandler(const char *condition, const char *file, int line);
JO_API void jo_set_assert_handler(JoAssertHandler *handler);

/* Frees what the library returned: a text, or a struct with all that it points to. NULL is fine. */
JO_API void jo_free(void *result);

/* ---- worlds built by hand ---------------------------------------------------------------- */

typedef struct JoWorld JoWorld;

/* Handles by value; generation 0 is null. A handle of something removed is stale: every function
   then answers as for null. */
typedef struct JoAgent {
    uint32_t slot, generation;
} JoAgent;
typedef struct JoBody {
    uint32_t slot, generation;
} JoBody;

/* The instruction set that the kernels use. It never changes a result. */
typedef enum JoIsa {
    JO_ISA_WIDEST, /* the widest that the machine runs */
    JO_ISA_SCALAR,
    JO_ISA_SSE2,
    JO_ISA_AVX2,
    JO_ISA_AVX512,
    JO_ISA_NEON
} JoIsa;
/* The one of a name, as "avx2". False, with an error that lists those that can be had, if there is
   no such set or this machine does not run it. */
JO_API bool jo_isa_find(const char *name, JoIsa *isa, JoError *error);
/* "avx2"; of JO_ISA_WIDEST the one that this machine uses. */
JO_API const char *jo_isa_name(JoIsa isa);

/* What becomes of a person or body that is lost: one of whose numbers is not finite, or that is
   farther than 10 km from the origin, or a body that falls through the ground or passes a wall. */
typedef enum JoLost {
    JO_LOST_END,    /* the world ends: jo_world_failure says why */
    JO_LOST_REMOVE, /* it is taken out, and the world goes on */
    JO_LOST_STOP    /* it is put back to where it was, at rest, and the world goes on */
} JoLost;

struct JoJobs; /* jostle_host.h */
struct JoFile;

typedef struct JoWorldDef {
    double dt;        /* s, 0.001 to 0.2; default 0.05 */
    uint64_t seed;    /* of all random numbers */
    uint32_t threads; /* 1 to 64, default 1; 0: all processors that the process may use. Never
                         changes a result; they are started when a step has work for them */
    JoIsa isa;        /* default: the widest */
    bool forces;      /* false: collision avoidance alone, no pushing, contact or inferred force */
    bool literal;     /* the paper's equations as printed, in place of the physical reading */
    double gravity;   /* m/s2 downwards, for bodies; default 9.81 */
    JoLost lost_people, lost_bodies; /* defaults: the world ends; the body is taken out */
    const struct JoJobs *jobs; /* runs the loops of a step in place of threads of the engine's own;
                                  stays the caller's while the world lives. NULL: the engine's */
    uint32_t cookie;           /* set by jo_default_world_def */
} JoWorldDef;
JO_API JoWorldDef jo_default_world_def(void);

/* NULL, with `error` filled (it may be NULL), if a field is out of range. */
JO_API JoWorld *jo_world_create(const JoWorldDef *def, JoError *error);
JO_API void jo_world_free(JoWorld *world);

/* Adds a static wall: `count` points x0, y0, x1, y1, ... of a solid polygon (no self-crossing,
   either direction) or of a thin polyline. Only before the first step. */
JO_API bool jo_world_add_solid(JoWorld *world, const double *xy, size_t count, JoError *error);
JO_API bool jo_world_add_line(JoWorld *world, const double *xy, size_t count, JoError *error);

typedef struct JoAgentDef {
    double x, y;             /* m, within 10 km of the origin */
    double radius;           /* m, 0.02 to 5; default 0.2 */
    double mass;             /* kg, 1 to 10,000; default 70 */
    double speed, max_speed; /* m/s; defaults 1.3 and 1.8 */
    double perception;       /* m; default 3 */
    double horizon;          /* s; default 0.5 */
    double push;             /* N; default 0 */
    double time_gap; /* s kept to those ahead, by the walking law; default 0: velocities are chosen
                        by ORCA, which is not fit for capacities */
    double haste;    /* 0 calm, 0.5 normal (the default), 1 keen: of those who keep a time gap */
    uint32_t cookie;
} JoAgentDef;
JO_API JoAgentDef jo_default_agent_def(void);
/* A null handle, with `error` filled (JO_INPUT), if a field is out of range, if the point lies in a
   solid, or if there is no free spot. Where it would lie nearer than 0.99 radii to a wall, or
   overlap another agent by more than a quarter of the smaller diameter, it begins on the nearest
   free spot within 25 m with no wall between. All searches between two steps look at 5 million
   spots, half a radius apart, and those that come after at 1,000 each. */
JO_API JoAgent jo_world_add_agent(JoWorld *world, const JoAgentDef *def, JoError *error);
/* Takes an agent out, at once; what it carries falls. Recorded in the world of a scene, as all that
   jostle_act.h has. Nothing for a stale handle. */
JO_API void jo_world_remove_agent(JoWorld *world, JoAgent agent);
JO_API bool jo_agent_is_live(const JoWorld *world, JoAgent agent);

typedef struct JoAgentState {
    uint32_t id;        /* counts up from 0, never reused */
    double x, y;        /* m */
    double vx, vy;      /* m/s */
    double fx, fy;      /* net force of the last step, N */
    double compression; /* sum of the contact forces' magnitudes over the circumference, N/m */
    double load;        /* greatest push borne from any one direction, N: over directions d, the
                           greatest sum of the positive parts of f.d over the contacts f */
    double radius;      /* m */
    const char *state;  /* of its machine; "" without one; valid until the next call on the world */
} JoAgentState;
/* All zero for a null or stale handle. */
JO_API JoAgentState jo_agent_state(const JoWorld *world, JoAgent agent);
/* Wanted velocity, m/s, for agents without a machine; holds until set again. At most 1e6 along each
   axis. */
JO_API void jo_agent_set_preferred(JoWorld *world, JoAgent agent, double vx, double vy);
/* An external force in newtons that acts during the next step; forces add up. Up to 1e6 along each
   axis in a world made by hand; in that of a scene, where it is recorded, up to 10,000. */
JO_API void jo_agent_apply_force(JoWorld *world, JoAgent agent, double fx, double fy);

typedef enum JoShape { JO_SPHERE, JO_BOX, JO_CYLINDER } JoShape;
/* What a body does that has come to the last point of its path: it stays, returns the way it came
   and goes to and fro, or goes on to the first and round. */
typedef enum JoPathEnd { JO_PATH_STAY, JO_PATH_BACK, JO_PATH_ROUND } JoPathEnd;
/* From where a body begins straight through points, x, y, z each, m: 1 to 255. */
typedef struct JoPath {
    const double *points; /* NULL: no path */
    uint32_t count;
    JoPathEnd end;
    double speed;       /* m/s, 0.001 to 100 */
    double after, wait; /* s: until it starts; at each point that it comes to */
    double force_limit; /* N, in place of the body's; 0: that counts */
    bool reopens;       /* where people bear the limit, it goes back to where its leg began, waits
                           and sets out again; else it goes on as they give way, and all that follows
                           on the path comes so much later */
} JoPath;
typedef struct JoBodyDef {
    JoShape shape;
    double size[3];    /* m: sphere radius; box lengths x, y, z; cylinder radius, height */
    double mass;       /* kg; 0 is static */
    double x, y, z;    /* of the centre, m */
    double turn;       /* about z, rad */
    double vx, vy, vz; /* m/s */
    double friction, restitution;
    bool kinematic;     /* whatever the mass: it moves by its velocity, as a door or a train does,
                           pushes people and bodies, and nothing pushes it; see jo_body_set_velocity */
    JoPath path;        /* of a kinematic body, in place of a velocity; copied */
    double force_limit; /* N, up to 1e6: what a kinematic body presses people with at most, all of
                           them together, where it moves towards them. There it goes as fast as they
                           give way, or stands, and presses with it. 0: no limit; default 6,227, the
                           load of which one person is estimated to die within 15 s (Hopkins et al.
                           1993, in Lee and Hughes 2006) */
    bool ends_world;    /* where that is reached the world fails, and jo_world_failure says whom it
                           presses */
    uint32_t cookie;
} JoBodyDef;
JO_API JoBodyDef jo_default_body_def(void);
/* Needs a build with Bullet; `error` says so otherwise. */
JO_API JoBody jo_world_add_body(JoWorld *world, const JoBodyDef *def, JoError *error);
typedef struct JoBodyState {
    double x, y, z;        /* centre of mass, m */
    double qx, qy, qz, qw; /* orientation */
    double vx, vy, vz;     /* m/s */
} JoBodyState;
JO_API JoBodyState jo_body_state(const JoWorld *world, JoBody body);

/* Advances by `steps` steps of dt. Where a number of an agent is not finite after a step, the world
   has failed: from then on this does nothing, and jo_world_failure says why. */
JO_API void jo_world_step(JoWorld *world, uint32_t steps);
/* NULL, or why the world has failed: the agent, its machine and its state. Valid while the world
 * is.
 */
JO_API const char *jo_world_failure(const JoWorld *world);
JO_API double jo_world_time(const JoWorld *world);   /* s */
JO_API uint64_t jo_world_tick(const JoWorld *world); /* steps done */
JO_API uint32_t jo_world_agent_count(const JoWorld *world);
JO_API uint32_t jo_world_body_count(const JoWorld *world);
/* Writes up to `capacity` handles of the live agents, in ascending id; returns how many. */
JO_API uint32_t jo_world_agents(const JoWorld *world, JoAgent *out, uint32_t capacity);
/* 64-bit hash of the whole state: equal for equal input at any thread count and build. */
JO_API uint64_t jo_world_hash(const JoWorld *world);

/* ---- scenes ------------------------------------------------------------------------------ */

typedef struct JoScene JoScene;

/* Receives text for people: diagnostics with their source line, warnings, reload notices. It is
   called from within a call: of a scene that is being stepped it may ask, and to change, step or
   free it is misuse. */
typedef void JoMessage(void *context, const char *text);

typedef struct JoSceneDef {
    const char *path;             /* of the YAML file */
    const char *const *overrides; /* "PATH=VALUE", as of `jostle run --set` */
    size_t override_count;
    bool has_seed, has_dt; /* whether the two below replace the scene's */
    uint64_t seed;
    double dt;        /* s */
    uint32_t threads; /* 1 to 64; default 0: all processors that the process may use */
    JoIsa isa;
    const char *input_log; /* recorded input to play, or NULL */
    JoMessage *message;    /* NULL: to stderr */
    void *message_context;
    const char *const *mods; /* folders of mods, or names of mods that lie beside the scene or in
                                the user's data directory; one that is not there, or does not load,
                                is an error */
    size_t mod_count;
    bool named_mods_only; /* mods that the user turned on (jo_mods_enable) are not taken for that,
                             but those of `mods` and those that the scene names */
    bool needed_mods_too; /* what these depend on is taken, too, without being named */
    bool resumable;   /* keeps what it is loaded from for checkpoints, and puts bodies into Bullet
                         anew at each 128th step, so that their state can be saved exactly there; the
                         order of Bullet's contacts changes by that */
    bool no_density;  /* densities are not sampled, which takes time, until a report asks for them:
                         "density_max" of the figures is none */
    bool dry;         /* all is read and compiled, and nobody is placed: for jo_scene_free, and
                         jo_scene_try, alone */
    const char *text; /* of the scene, or NULL: it is read from `path`, which else only names it */
    size_t text_length;
    const struct JoFile *files; /* taken in place of those on the disk: scene, what it includes,
                                   behaviours and what they require, walls, inputs */
    size_t file_count;
    bool files_only;           /* nothing else is read from the disk */
    const struct JoJobs *jobs; /* as of JoWorldDef */
    uint32_t cookie;
} JoSceneDef;
JO_API JoSceneDef jo_default_scene_def(void);

/* NULL if anything is wrong: every error went to `message`, the first is in `error`. */
JO_API JoScene *jo_scene_load(const JoSceneDef *def, JoError *error);
JO_API void jo_scene_free(JoScene *scene);
/* The world, owned by the scene. It is stepped by jo_scene_step alone. What jostle_act.h does to it
   between two steps, and forces on and removals of agents, go into the input log; agents and bodies
   that are added by hand and preferred velocities do not. */
JO_API JoWorld *jo_scene_world(JoScene *scene);
JO_API double jo_scene_duration(const JoScene *scene); /* s, as the scene says */
/* One step: sources, the world's step, sinks, and whatever is recorded. False if recording or
   reporting failed; `error` says why. */
JO_API bool jo_scene_step(JoScene *scene, JoError *error);

/* What people do to a running scene; it takes effect in the next step, as an event of the scene
   does, and goes into the input log if one is written. False with `error` where there is no such
   body or wall, or a number is out of range. */
/* Throws a body by its name: x, y, z of where it is put first (m; NULL: from where it lies),
   velocity (m/s, each up to 100; NULL: none) and spin about x, y, z (rad/s, each up to 100; NULL:
   none). */
JO_API bool jo_scene_throw(JoScene *scene, const char *body, const double from[3],
                           const double velocity[3], const double spin[3], JoError *error);
/* Opens or closes the walls of a name. Who stands in a wall that closes is moved out. */
JO_API bool jo_scene_open_wall(JoScene *scene, const char *wall, bool open, JoError *error);
/* Calls a name out, which everybody hears in the next step, wherever they are. */
JO_API bool jo_scene_signal(JoScene *scene, const char *name, JoError *error);
/* Does what a line of an input log says, without its tick: "push 7 300 0" (jo_reference("inputs")
   has them all). False with `error` where it cannot be done; nothing is then logged. */
JO_API bool jo_scene_input(JoScene *scene, const char *line, JoError *error);
/* From here on writes what people do, and files that are reloaded, to a file (replaced if it is
   there), which JoSceneDef.input_log plays back to the same state. */
JO_API bool jo_scene_log_input(JoScene *scene, const char *path, JoError *error);
/* Writes trajectories to an SQLite file from here on (JuPedSim format, version 2): a frame each
   `every` seconds, which are rounded to whole steps; 0: each 0.1 s. */
JO_API bool jo_scene_record(JoScene *scene, const char *path, double every, JoError *error);
/* Of a scene that is `resumable`, before its first step: from here on writes a checkpoint into a
   directory (made if it is missing) every so many simulated seconds, at the first step behind that
   at which all can be saved exactly: latest.checkpoint, and before.checkpoint, the one before. Each
   holds all that the future depends on, with the texts of all files, and `note`, a text of the
   caller's. What was recorded and logged until then is on the disk before it is; what probes,
   reports and data files have collected is a part of it. */
JO_API bool jo_scene_checkpoint(JoScene *scene, const char *directory, double every,
                                const char *note, JoError *error);
/* The scene of a checkpoint, as it was then; a directory stands for the newest whole one in it.
   Message, threads and instruction set are those of `def`. *note is the caller's text, to be freed
   by jo_free. NULL with `error` where the file is damaged, of another version, or where what it was
   made of cannot be had. */
JO_API JoScene *jo_scene_resume(const JoSceneDef *def, const char *path, char **note,
                                JoError *error);
/* Of a resumed scene: go on writing what jo_scene_record and jo_scene_log_input wrote, behind the
   checkpoint; what the earlier run wrote after it is taken out. */
JO_API bool jo_scene_record_on(JoScene *scene, const char *path, JoError *error);
JO_API bool jo_scene_log_on(JoScene *scene, const char *path, JoError *error);
/* From here on files are watched: behaviours, what they require, patches of mods and the scene
   itself. A thread of its own loads what was edited; between two steps all of it is swapped, or
   nothing, and `message` says so. */
JO_API bool jo_scene_watch(JoScene *scene, JoError *error);
/* Sends every transition of the agent with this id, and why it fired, to `message`. */
JO_API void jo_scene_trace(JoScene *scene, uint32_t agent_id);
/* Ends recording and reporting and draws the pictures. False with `error` if something failed. */
JO_API bool jo_scene_finish(JoScene *scene, JoError *error);
/* Shows progress on stderr while stepping: a line that is rewritten on a terminal, else one line
   each tenth. `until` in simulated seconds. */
JO_API void jo_scene_show_progress(JoScene *scene, double until);
/* Times by stage, in the order of a step. */
enum { JO_STAGE_COUNT = 9 };
typedef struct JoStats {
    uint64_t steps, agent_steps;           /* since loading */
    uint32_t agents, bodies;               /* now */
    double dt, simulated_s, wall_s, cpu_s; /* stepping alone; CPU of all threads of the process */
    double stage_ns[JO_STAGE_COUNT];       /* wall time per agent-step, ns */
    double bullet_ns;                      /* of the stage "bodies", likewise: Bullet's own steps */
    double objects_ns;         /* of the stage "perceive", likewise: what agents see of bodies */
    uint64_t shifted_at_birth; /* agents who began on a free spot beside their point */
    uint64_t not_placed;       /* agents who found none, and were not made */
    uint64_t moved_out, not_moved_out; /* agents in the way of a wall that came: who were moved out
                                          of it, and for whom there was no free spot */
} JoStats;
JO_API JoStats jo_scene_stats(const JoScene *scene);
/* "perceive", "think", "prefer", "push", "solve", "move", "bodies", "infer", "observe". */
JO_API const char *jo_stage_name(int stage);
#ifdef __cplusplus
}
#endif

#include "jostle_act.h"
#include "jostle_host.h"
#include "jostle_read.h"
#include "jostle_tell.h"

#endif
