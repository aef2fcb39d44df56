/* Public C interface of Jostle, an engine for dense crowds that push, with rigid bodies and
 * behaviours in Lua. A program that embeds the engine includes this header, which brings
 * jostle_act.h, jostle_read.h, jostle_tell.h, jostle_host.h and jostle_words.h with it.
 *
 * Order of calls. A world made by hand: jo_default_world_def, jo_world_create, jo_world_add_solid
 * and jo_world_add_agent, then jo_world_step in a loop, jo_world_free. A scene from a file:
 * jo_default_scene_def, jo_scene_load, then jo_scene_step in a loop, jo_scene_finish,
 * jo_scene_free.
 *
 * Ownership. Fill each Def struct by its jo_default function, which sets `cookie` (a number by
 * which the library knows that the struct was filled), then change fields. Texts and arrays of a
 * Def are copied; callbacks, their contexts and `jobs` must outlive what was made with them. Free a
 * result of type char * or void *, and a pointer to a struct of jostle_tell.h, with jo_free; a
 * const char * stays the library's.
 *
 * Units are SI throughout: metres, seconds, kilograms, newtons, radians; x east, y north, z up.
 * Plain C17, clean in C++. One world must not be used from two threads at once; different worlds
 * may. Misuse (a null pointer, a Def without its cookie) is reported through the assertion handler
 * and answered with a null handle, NULL, zero or false; bad files and values are answered so too,
 * with a JoError that says why. Every `error` may be NULL. The library never exits, leaves signals
 * as the program set them, and blocks them in its own threads.
 *
 * When memory is out, a call returns its error (JO_FAILED, "out of memory") or NULL, false or 0.
 * The world or scene that it was changing has then failed: later calls answer the same way,
 * jo_world_failure says why, and freeing it releases all memory that it held. Other worlds go
 * on. */
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

/* Version of the library, such as "0.1.0". */
JO_API const char *jo_version(void);
/* Folder of the files that come with the library: scenes/, behaviours/, and scripts/ for `require`.
 */
JO_API const char *jo_data_folder(void);

/* ---- errors ------------------------------------------------------------------------------ */

typedef enum JoCode {
    JO_OK = 0,
    JO_FAILED = 1, /* the run failed: a file could not be written, the disk is full */
    JO_USAGE = 2,  /* the caller's arguments make no sense */
    JO_INPUT = 3   /* a scene, behaviour or value is wrong */
} JoCode;

typedef struct JoError {
    JoCode code;
    int line, column; /* position in `file`, from 1, in characters; 0: unknown */
    char file[256];   /* file that is wrong; "" if the error is in none */
    char text[1024];  /* message, with how to correct it where that is known */
} JoError;

/* Receives each broken precondition of a call: the condition, and its place in the library's
   source. If it returns, so does the call, as said above. */
typedef void JoAssertHandler(const char *condition, const char *file, int line);
/* Sets the handler for the whole process. NULL restores the default, which prints to stderr, and in
   debug builds aborts. */
JO_API void jo_set_assert_handler(JoAssertHandler *handler);

/* Frees a result of the library: a text, or a struct with everything that it points to. NULL is
   allowed. */
JO_API void jo_free(void *result);

/* ---- worlds built by hand ---------------------------------------------------------------- */

/* A world: people, bodies and walls at one moment, and all that their future depends on. */
typedef struct JoWorld JoWorld;

/* Handles of an agent (a person) and of a body (a rigid body), passed by value. Generation 0 is the
   null handle. The handle of a removed agent or body is stale: every function then answers as for
   null. A slot is used again, with another generation. */
typedef struct JoAgent {
    uint32_t slot, generation;
} JoAgent;
typedef struct JoBody {
    uint32_t slot, generation;
} JoBody;

/* Instruction set of the kernels. It never changes a result. */
typedef enum JoIsa {
    JO_ISA_WIDEST, /* the widest that this machine supports */
    JO_ISA_SCALAR,
    JO_ISA_SSE2,
    JO_ISA_AVX2,
    JO_ISA_AVX512,
    JO_ISA_NEON,
    JO_ISA_WASM /* of WebAssembly: 128-bit vectors */
} JoIsa;
/* Writes the instruction set with a name such as "avx2" to *isa. False if there is no such set
   or this machine does not support it; `error` then lists the available ones. */
JO_API bool jo_isa_find(const char *name, JoIsa *isa, JoError *error);
/* Name of an instruction set, such as "avx2"; for JO_ISA_WIDEST the name of the set that this
   machine uses. */
JO_API const char *jo_isa_name(JoIsa isa);

/* Reaction of a world to a lost agent or body. One is lost when one of its numbers is not finite
   or it is farther than 10 km from the origin; a body also when it falls through the ground or
   passes a wall. */
typedef enum JoLost {
    JO_LOST_END,    /* the world ends: jo_world_failure says why */
    JO_LOST_REMOVE, /* the agent or body is removed, and the world goes on */
    JO_LOST_STOP    /* it is put back where it was, at rest, and the world goes on */
} JoLost;

struct JoJobs; /* jostle_host.h */
struct JoFile;

typedef struct JoWorldDef {
    double dt;        /* s, 0.001 to 0.2; default 0.05 */
    uint64_t seed;    /* seed of all random numbers; default 1 */
    uint32_t threads; /* 1 to 64, default 1; 0: all processors that the process may use. Never
                         changes a result; threads start at the first step that has work for them */
    JoIsa isa;        /* default: the widest */
    bool forces;      /* default true; false: collision avoidance alone, no pushing, contact or
                         inferred force */
    bool literal;     /* use the paper's equations as printed, where the engine's default reading of
                         them differs (core/paper.md says where) */
    double gravity;   /* m/s2 downwards, for bodies; default 9.81 */
    /* defaults: JO_LOST_END for people, JO_LOST_REMOVE for bodies */
    JoLost lost_people, lost_bodies;
    const struct JoJobs *jobs; /* thread pool of the caller, which runs the loops of a step; must
                                  outlive the world. NULL: the engine's own threads */
    uint32_t cookie;           /* set by jo_default_world_def */
} JoWorldDef;
JO_API JoWorldDef jo_default_world_def(void);

/* Creates a world from a definition; free it with jo_world_free. NULL, with `error` filled (it
   may be NULL), if a field is out of range. */
JO_API JoWorld *jo_world_create(const JoWorldDef *def, JoError *error);
JO_API void jo_world_free(JoWorld *world);

/* Add a static wall of `count` points x0, y0, x1, y1, ..., m: a solid polygon of at least 3 points
   (closed by itself, in either direction, without self-crossing), or a thin polyline of at least 2.
   Only before the first step. False with `error` if the points do not form one. */
JO_API bool jo_world_add_solid(JoWorld *world, const double *xy, size_t count, JoError *error);
JO_API bool jo_world_add_line(JoWorld *world, const double *xy, size_t count, JoError *error);

typedef struct JoAgentDef {
    double x, y;             /* m, within 10 km of the origin */
    double radius;           /* m, of the disc for which it keeps room, 0.02 to 5; default 0.2; its
                                torso is 2.25 radii broad and 1.25 deep, or the disc if `literal` */
    double mass;             /* kg, 1 to 10,000; default 70 */
    double speed, max_speed; /* m/s: wanted speed, 0 to 20, and the greatest that it chooses, 0 to
                                30; defaults 1.3 and 1.8 */
    double perception;       /* m: radius within which it sees others, 0 to 100; default 3 */
    double horizon;          /* s: time ahead for which it avoids others, 0.01 to 30; default 0.5 */
    double push;             /* N: force with which it pushes agents in its way, 0 to 5,000;
                                default 0 */
    double time_gap;         /* s: time that it keeps to the back of the agent ahead, by the walking
                                law (core/walking.md), 0 to 10; default 0: collision avoidance alone
                                (ORCA) chooses velocities, which is unfit for measuring capacities */
    double haste; /* motivation: 0 calm, 0.5 normal (the default), 1 keen; read only with a time gap
                     above 0 */
    uint32_t storey; /* x and y are in plan on this storey, counted from the lowest up; default 0 */
    uint32_t cookie;
} JoAgentDef;
JO_API JoAgentDef jo_default_agent_def(void);
/* Adds an agent. A null handle, with `error` filled (JO_INPUT), if a field is out of range, if
   the point lies in a solid, or if there is no free spot. If the agent would lie nearer than
   0.99 radii to a wall, or its disc overlap that of another by more than a quarter of the smaller,
   it begins on the nearest free spot within 25 m with no wall between. Its torso may begin in
   another: its chest points to +x, and is not turned out of others as that of a scene's people is.
   Spots are tested half a radius apart: all searches between two steps test 5 million spots
   together, later searches before the next step 1,000 each. */
JO_API JoAgent jo_world_add_agent(JoWorld *world, const JoAgentDef *def, JoError *error);
/* Removes an agent at once; a body that it carries falls. In the world of a scene the call is
   recorded in the input log, as all calls of jostle_act.h are. Does nothing for a stale handle. */
JO_API void jo_world_remove_agent(JoWorld *world, JoAgent agent);
/* Returns whether the handle is that of an agent in the world. */
JO_API bool jo_agent_is_live(const JoWorld *world, JoAgent agent);

typedef struct JoAgentState {
    uint32_t id;        /* counts up from 0, never reused */
    double x, y;        /* m */
    double vx, vy;      /* m/s */
    double fx, fy;      /* net force of the last step, N */
    double compression; /* sum of the contact forces' magnitudes over the circumference, N/m */
    double load;        /* greatest push borne from any one direction, N: over all directions d, the
                           greatest sum of the positive parts of f.d over the contact forces f */
    double radius;      /* m */
    const char *state;  /* state of the agent's behaviour, "" without a behaviour; valid until the
                           next call on the world */
    uint32_t storey; /* x and y are in plan, on this storey (jo_agent_where); 0 without storeys */
} JoAgentState;
/* Returns the state of an agent after the last step. All zero, with "" as its state, for a null or
   stale handle. */
JO_API JoAgentState jo_agent_state(const JoWorld *world, JoAgent agent);
/* Sets the velocity, m/s, that an agent without a behaviour wants to walk at; it holds until set
   again. At most 1e6 along each axis. */
JO_API void jo_agent_set_preferred(JoWorld *world, JoAgent agent, double vx, double vy);
/* Adds an external force, N, that acts during the next step. Up to 1e6 along each axis in a
   world made by hand; up to 10,000 in that of a scene, where it is recorded in the input log. */
JO_API void jo_agent_apply_force(JoWorld *world, JoAgent agent, double fx, double fy);

typedef enum JoShape { JO_SPHERE, JO_BOX, JO_CYLINDER } JoShape;
/* Action of a body at the last point of its path: it stays; it returns along the path and keeps
   going to and fro; or it goes straight to the first point and starts the next round. */
typedef enum JoPathEnd { JO_PATH_STAY, JO_PATH_BACK, JO_PATH_ROUND } JoPathEnd;
/* Path of a kinematic body: straight from its initial position through 1 to 255 points of x, y,
   z, m each. */
typedef struct JoPath {
    const double *points; /* NULL: no path */
    uint32_t count;
    JoPathEnd end;
    double speed;       /* m/s, 0.001 to 100 */
    double after, wait; /* s: time before the body starts; time that it stops at each point */
    double force_limit; /* N, in place of JoBodyDef.force_limit; 0: that one holds */
    bool reopens; /* when the force limit is reached, the body goes back to the start of its current
                     leg, waits and sets out again; else it advances as people give way, and
                     everything later on the path is delayed by as much */
} JoPath;
typedef struct JoBodyDef {
    JoShape shape;
    double size[3];     /* m: sphere radius; box lengths x, y, z; cylinder radius, height */
    double mass;        /* kg; 0 is static */
    double x, y, z;     /* centre, m */
    double turn;        /* about z, rad */
    double vx, vy, vz;  /* m/s */
    double friction;    /* coefficient of sliding friction; default 0.6 */
    double restitution; /* 0 (default) to 1: share of the normal velocity kept in a collision */
    bool kinematic; /* moves by its velocity whatever its mass, as a door or a train does: it pushes
                       people and bodies, and nothing pushes it; see jo_body_set_velocity */
    JoPath path;    /* path of a kinematic body, in place of a velocity; copied */
    double force_limit; /* N, up to 1e6: greatest total force with which a kinematic body presses
                           the people in its way. At the limit it moves only as fast as they give
                           way, or stands and keeps pressing. 0: no limit; default 6,227, the load
                           at which one person is estimated to die within 15 s (Hopkins et al. 1993,
                           in Lee and Hughes 2006) */
    bool ends_world; /* the world fails when the force limit is reached; jo_world_failure names the
                        agent that is pressed */
    uint32_t storey; /* x, y and the path are in plan on this storey, counted from the lowest up,
                        and z above its floor; default 0 */
    uint32_t cookie;
} JoBodyDef;
JO_API JoBodyDef jo_default_body_def(void);
/* Adds a body. A null handle, with `error` filled, if a field is out of range or this build has
   no Bullet. */
JO_API JoBody jo_world_add_body(JoWorld *world, const JoBodyDef *def, JoError *error);
typedef struct JoBodyState {
    double x, y, z;        /* centre of mass, m */
    double qx, qy, qz, qw; /* orientation as a unit quaternion */
    double vx, vy, vz;     /* m/s */
    uint32_t storey;       /* x and y are in plan, and z is above this storey; 0 without storeys */
} JoBodyState;
/* Returns the state of a body after the last step. All zero for a null or stale handle. */
JO_API JoBodyState jo_body_state(const JoWorld *world, JoBody body);

/* Advances the world by `steps` steps of dt. If a number of an agent is not finite after a step,
   the world has failed: from then on this call does nothing, and jo_world_failure says why. */
JO_API void jo_world_step(JoWorld *world, uint32_t steps);
/* Text that says why the world has failed (the agent, its behaviour and its state), or NULL
   while it has not. Valid as long as the world. */
JO_API const char *jo_world_failure(const JoWorld *world);
JO_API double jo_world_time(const JoWorld *world);   /* s */
JO_API uint64_t jo_world_tick(const JoWorld *world); /* steps done */
JO_API uint32_t jo_world_agent_count(const JoWorld *world);
JO_API uint32_t jo_world_body_count(const JoWorld *world);
/* Writes up to `capacity` handles of the live agents, in ascending id; returns how many. */
JO_API uint32_t jo_world_agents(const JoWorld *world, JoAgent *out, uint32_t capacity);
/* 64-bit hash of the whole state: equal for equal input whatever the thread count and build. */
JO_API uint64_t jo_world_hash(const JoWorld *world);

/* ---- scenes ------------------------------------------------------------------------------ */

/* A scene that runs: a world that was built from files, with sources and exits of people, events,
   recordings and measurements. */
typedef struct JoScene JoScene;

/* Receives text for people: diagnostics with their source line, warnings, reload notices. It
   runs within a call of the library: it may read the scene that is being stepped, but must not
   change, step or free it. */
typedef void JoMessage(void *context, const char *text);

typedef struct JoSceneDef {
    const char *path;             /* the scene's YAML file */
    const char *const *overrides; /* settings "PATH=VALUE", as for `jostle run --set` */
    size_t override_count;
    bool has_seed, has_dt; /* whether `seed` and `dt` replace the scene's values */
    uint64_t seed;
    double dt;             /* s */
    uint32_t threads;      /* 1 to 64; default 0: all processors that the process may use */
    JoIsa isa;             /* default: the widest */
    const char *input_log; /* file of jo_scene_log_input, whose input is played back; or NULL */
    JoMessage *message;    /* NULL: to stderr */
    void *message_context;
    /* folders of mods, or names of mods that lie in mods/ beside the scene or in the user's data
       directory; a mod that is missing or does not load is an error */
    const char *const *mods;
    size_t mod_count;
    bool named_mods_only; /* load only the mods of `mods` and those that the scene names, not those
                             that the user turned on with jo_mods_enable */
    bool needed_mods_too; /* also load the mods that these need, though they are not named */
    bool resumable; /* allow checkpoints: keep the texts of all files, and re-insert all bodies into
                       Bullet's world at each 128th step, the only steps at which their state can be
                       saved exactly; this changes the order in which Bullet solves contacts, and so
                       the run */
    bool no_density;  /* do not sample densities, which takes time, until a report needs them:
                         "density_max" is then missing from the figures */
    bool dry;         /* read and compile all files, place no agents; such a scene is good only for
                         jo_scene_try and jo_scene_free */
    const char *text; /* YAML text of the scene, with `path` as its name only; NULL: read the file
                         at `path` */
    size_t text_length;
    /* files in memory that replace those on disk: the scene, its includes, behaviours and modules
       that they require, walls, inputs */
    const struct JoFile *files;
    size_t file_count;
    bool files_only;           /* read nothing else from the disk */
    const struct JoJobs *jobs; /* as JoWorldDef.jobs */
    /* words of the program that behaviours may use (jostle_words.h); they are copied */
    const struct JoWord *words;
    size_t word_count;
    uint32_t cookie;
} JoSceneDef;
JO_API JoSceneDef jo_default_scene_def(void);

/* Loads a scene; free it with jo_scene_free. NULL if anything is wrong: every error went to
   `message`, the first is in `error`. */
JO_API JoScene *jo_scene_load(const JoSceneDef *def, JoError *error);
JO_API void jo_scene_free(JoScene *scene);
/* World of a scene, owned by the scene. Step it by jo_scene_step only. Calls of jostle_act.h
   between two steps, jo_agent_apply_force and jo_world_remove_agent go into the input log;
   agents and bodies added by hand and preferred velocities do not. */
JO_API JoWorld *jo_scene_world(JoScene *scene);
JO_API double jo_scene_duration(const JoScene *scene); /* s, as the scene says */
/* Advances the scene by one step: sources, the world's step, exits, recording. False if
   recording or reporting failed; `error` says why. */
JO_API bool jo_scene_step(JoScene *scene, JoError *error);

/* The next four calls act on a running scene. Each takes effect in the next step, as an event of
   the scene does, and goes into the input log if one is written. False with `error` if there is
   no such body or wall, or a number is out of range. */
/* Throws a body of the scene, given by name: `from` is the x, y, z, m, where it is put first
   (NULL: from where it lies), `velocity` its velocity (m/s, each up to 100; NULL: none) and
   `spin` its angular velocity about x, y, z (rad/s, each up to 100; NULL: none). */
JO_API bool jo_scene_throw(JoScene *scene, const char *body, const double from[3],
                           const double velocity[3], const double spin[3], JoError *error);
/* The same from a point in plan on a storey, counted from the lowest up. JO_INPUT if there is no
   such storey. */
JO_API bool jo_scene_throw_on(JoScene *scene, uint32_t storey, const char *body,
                              const double from[3], const double velocity[3], const double spin[3],
                              JoError *error);
/* Opens or closes the walls with a name. Agents in a wall that closes are moved out of it. */
JO_API bool jo_scene_open_wall(JoScene *scene, const char *wall, bool open, JoError *error);
/* Sends a signal, which every agent hears in the next step, wherever it is. */
JO_API bool jo_scene_signal(JoScene *scene, const char *name, JoError *error);
/* Carries out a line of an input log, given without its tick: "push 7 300 0"
   (jo_reference("inputs") lists all kinds). False with `error` if that is impossible; then
   nothing is logged. */
JO_API bool jo_scene_input(JoScene *scene, const char *line, JoError *error);
/* Starts an input log: writes all input and all reloaded files to a file (an existing one is
   replaced), which JoSceneDef.input_log plays back to the same state. */
JO_API bool jo_scene_log_input(JoScene *scene, const char *path, JoError *error);
/* Starts recording trajectories to an SQLite file (JuPedSim format, version 2): one frame every
   `every` seconds, rounded to whole steps; 0: every 0.1 s. */
JO_API bool jo_scene_record(JoScene *scene, const char *path, double every, JoError *error);
/* Starts writing checkpoints of a scene loaded as `resumable`; call it before the first step.
   One is written into `directory` (made if it is missing) every `every` simulated seconds, at
   the first step from then on at which the state can be saved exactly: latest.checkpoint, and
   before.checkpoint, the previous one. Each holds the complete state, the texts of all files,
   and `note`, a text of the caller's. Recordings and logs are flushed to the disk first; the
   data that probes, reports and data files have collected is part of the checkpoint. */
JO_API bool jo_scene_checkpoint(JoScene *scene, const char *directory, double every,
                                const char *note, JoError *error);
/* Loads the scene of a checkpoint in the state that was saved; `path` is a file, or a directory,
   which stands for the newest intact checkpoint in it. Message, threads and instruction set are
   those of `def`. *note is the caller's text; free it with jo_free. NULL with `error` if the
   file is damaged or of another version, or if files that it depends on are missing. */
JO_API JoScene *jo_scene_resume(const JoSceneDef *def, const char *path, char **note,
                                JoError *error);
/* Continue, for a resumed scene, the files of jo_scene_record and jo_scene_log_input from the
   checkpoint on; what the earlier run wrote after the checkpoint is removed. */
JO_API bool jo_scene_record_on(JoScene *scene, const char *path, JoError *error);
JO_API bool jo_scene_log_on(JoScene *scene, const char *path, JoError *error);
/* Starts watching files: behaviours, modules that they require, patches of mods and the scene
   itself. A thread of its own loads edited files; between two steps either all of them replace
   the old ones or none does, and `message` says so. */
JO_API bool jo_scene_watch(JoScene *scene, JoError *error);
/* Puts texts in place of files of the scene, at once: all that belong together replace the old ones
   or none does, as by jo_scene_watch, and `message` says so. Paths are as in JoSceneDef.files; the
   last text for one counts. False with the first `error` while files are watched, and if texts are
   wrong or cannot replace what runs, which then goes on; also for a file that nothing reads: other
   texts are live, and this one is kept for a reader. Callbacks must not change the scene so. */
JO_API bool jo_scene_reload(JoScene *scene, const struct JoFile *files, size_t count,
                            JoError *error);
/* Sends every later transition of the agent with this id, and why it fired, to `message`. */
JO_API void jo_scene_trace(JoScene *scene, uint32_t agent_id);
/* Ends recording and reporting and draws the report's pictures. False with `error` if something
   failed. */
JO_API bool jo_scene_finish(JoScene *scene, JoError *error);
/* Shows progress on stderr while stepping: on a terminal one line that is rewritten, else a line
   at each tenth. `until` is the end, in simulated seconds. */
JO_API void jo_scene_show_progress(JoScene *scene, double until);
/* Number of stages of a step, in the order of jo_stage_name. */
enum { JO_STAGE_COUNT = 9 };
/* Counts and times of a run. */
typedef struct JoStats {
    uint64_t steps, agent_steps; /* since loading: steps; the sum of their numbers of agents */
    uint32_t agents, bodies;     /* present now */
    double dt, simulated_s;      /* s: time step; simulated time since loading */
    double wall_s, cpu_s; /* s that the steps took: wall time; processor time of all threads of the
                             process */
    double stage_ns[JO_STAGE_COUNT]; /* wall time per agent-step, ns */
    double bullet_ns;  /* part of the stage "bodies", ns per agent-step: Bullet's own steps */
    double objects_ns; /* part of the stage "perceive", ns per agent-step: updating the objects, the
                          bodies as agents see them */
    /* Wall time outside the stages, ns per agent-step: before them, events, changes of walls, and
       agents that come in; after them, agents that leave; and what collects figures, records,
       reports and shows a scene. */
    double enter_ns, leave_ns, collect_ns;
    uint64_t shifted_at_birth;         /* agents created on a free spot beside their point */
    uint64_t not_placed;               /* agents not created, as no spot was free */
    uint64_t moved_out, not_moved_out; /* agents in the way of a new or closing wall: moved out of
                                          it; left in it, as no spot was free */
} JoStats;
JO_API JoStats jo_scene_stats(const JoScene *scene);
/* Name of a stage by its number: "perceive", "think", "prefer", "push", "solve", "move",
   "bodies", "infer", "observe". */
JO_API const char *jo_stage_name(int stage);
#ifdef __cplusplus
}
#endif

#include "jostle_act.h"
#include "jostle_host.h"
#include "jostle_read.h"
#include "jostle_tell.h"
#include "jostle_words.h"

#endif
