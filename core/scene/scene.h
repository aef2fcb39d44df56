/* Scenes: a YAML file becomes a plain description, from which core/run builds a world.
   Metres, seconds, kilograms; angles in radians. The format itself is the table in keys.c. */
#ifndef JOX_SCENE_SCENE_H
#define JOX_SCENE_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "agents/walk_law.h"
#include "base/format/diag.h"
#include "base/format/patch.h"
#include "base/number/random.h"
#include "body/body.h"
#include "geom/place.h"
#include "geom/walls.h"
#include "world/events.h"
#include "world/exits.h"
#include "world/population.h"
#include "world/probe.h"
#include "world/sources.h"

typedef struct JoxSceneRegion {
    char *name;
    JoxV2 *points;
    uint32_t count;
} JoxSceneRegion;

typedef struct JoxSceneBody {
    JoxBodyDef def; /* tags are left 0: see `tags` */
    char **tags;
    uint32_t tag_count;
    JoxPosition position;
} JoxSceneBody;

/* What people may do to the running scene on its live page. */
#define JOX_TOOLS(X)                                                                               \
    X(THROW, "throw")                                                                              \
    X(DRAG, "drag")                                                                                \
    X(PUSH, "push")                                                                                \
    X(GATES, "gates")                                                                              \
    X(PARAMETERS, "parameters")                                                                    \
    X(SIGNALS, "signals")                                                                          \
    X(PLAYER, "player")
typedef enum JoxTool {
#define X(tool, name) JOX_TOOL_##tool,
    JOX_TOOLS(X)
#undef X
        JOX_TOOL_COUNT
} JoxTool;
extern const char *const jox_scene_tools[JOX_TOOL_COUNT]; /* names */

typedef struct JoxSceneFile {
    char *path;
    char sha256[65];
    const char *text; /* as it was read */
    size_t length;
} JoxSceneFile;

typedef struct JoxSceneCamera {
    double position[3], target[3]; /* m */
    bool given;
} JoxSceneCamera;

/* What people may be coloured by, in the order of the key's choices, which begin with "auto". */
#define JOX_SCENE_COLOURS(X)                                                                       \
    X(state) X(speed) X(force) X(compression) X(load) X(density) X(group) X(direction) X(service)

typedef struct JoxSceneView {
    uint32_t tools;         /* bit per JoxTool */
    uint32_t colour, field; /* which of the keys' choices, in their order */
} JoxSceneView;

/* What is counted of the agents: a score, or who is out. */
typedef enum JoxTallyTake {
    JOX_TALLY_SUM,
    JOX_TALLY_MEAN,
    JOX_TALLY_LEAST,
    JOX_TALLY_GREATEST
} JoxTallyTake;
typedef struct JoxTally {
    char *name;
    JoxPosition position; /* of the name */
    char *memory, *state; /* of that memory, or in that state; NULL: any */
    JoxPosition memory_at, state_at;
    int32_t group; /* -1: everyone */
    uint32_t take; /* JoxTallyTake, of memory */
    char *unit;    /* NULL: none */
} JoxTally;

/* What a script may use. */
typedef struct JoxSceneLimits {
    double instructions, step_instructions; /* of a call, of all calls in a step */
    double load_instructions;
    double memory, block; /* MB: of a behaviour, of one allocation */
    double source;        /* KB of a file */
    double print;         /* lines in a second */
} JoxSceneLimits;

/* A scene's file as it was read: everything that a world is built from, as plain data. */
typedef struct JoxSceneSpec {
    char *path, *title;
    char *about; /* what it shows; may be empty */
    char *input; /* path of the input log, or NULL */
    uint64_t seed;
    double step, duration, gravity; /* s, s, m/s2 */
    bool bounded;
    JoxV2 low, high; /* bounds */
    bool periodic_x, periodic_y;
    JoxPlace *places;
    uint32_t place_count;
    JoxSceneRegion *regions;
    uint32_t region_count;
    JoxWalls walls;
    JoxSceneBody *bodies;
    uint32_t body_count;
    JoxGroup *groups;
    uint32_t group_count;
    JoxAgentSource *sources;
    uint32_t source_count;
    JoxAgentSink *sinks;
    uint32_t sink_count;
    JoxProbeDef *probes;
    uint32_t probe_count;
    JoxEvent *events;
    uint32_t event_count;
    JoxTally *tallies;
    uint32_t tally_count;
    int32_t player_group;  /* -1: none */
    uint32_t player_agent; /* index within that group */
    bool forces, literal;
    uint32_t lost_people, lost_bodies; /* JoLost */
    JoxSceneCamera camera;
    JoxSceneView view;
    JoxSceneLimits limits;
    JoxWalkLaw walking;
    bool heatmap; /* the area was given */
    JoxV2 heatmap_low, heatmap_high;
    double heatmap_from; /* s; averages begin there */
    JoxSceneFile *files; /* scene and included files */
    uint32_t file_count;
    const struct JoxYaml *tree; /* as it was read, with includes and mods merged */
    const struct JoxYaml *own;  /* the same without mods and what was set for the run */
    JoxPatchChanges changes;    /* that mods made */
    void *memory;               /* owns every text and array above but `walls` and `changes` */
} JoxSceneSpec;

/* `sets` are "PATH=VALUE", as "groups.pilgrims.count=5000". */
typedef struct JoxSceneOptions {
    const char *const *sets;
    uint32_t set_count;
    const char *datadir; /* where installed behaviours/ lie; NULL: as built */
    const JoxMod
        *mods; /* in order; their patches of the scene are applied, and their behaviours found */
    uint32_t mod_count;
} JoxSceneOptions;

/* NULL when there are errors, all of them in `diagnostics`. `options` may be NULL. */
JoxSceneSpec *jox_scene_load(const char *path, const JoxSceneOptions *options,
                             JoxDiagnostics *diagnostics);
/* The same from memory; `name` stands for the path, its folder is where files are looked for. */
JoxSceneSpec *jox_scene_load_text(const char *name, const char *text, size_t length,
                                  const JoxSceneOptions *options, JoxDiagnostics *diagnostics);
void jox_scene_free(JoxSceneSpec *scene);
/* Whether two versions of a scene hold other things under one of its keys. */
bool jox_scene_differs(const JoxSceneSpec *a, const JoxSceneSpec *b, const char *key);
/* Name of what people are coloured by first: what the scene says (NULL: it says nothing), or what
   tells most where behaviours have so many states in all, and people so many groups. */
const char *jox_scene_colour(const JoxSceneSpec *scene, uint32_t states, uint32_t groups);
/* Append where the scene's own files write the value of a path ("groups.red.count"; items of lists
   by name or number), where it was set for the run, and what it is by default: false where that is
   nowhere. */
bool jox_scene_why(const JoxSceneSpec *scene, const char *path, JoSetVisit *visit, void *context);
bool jox_scene_why_set(const JoxSceneSpec *scene, const char *path, JoSetVisit *visit,
                       void *context);
bool jox_scene_why_default(const JoxSceneSpec *scene, const char *path, JoSetVisit *visit,
                           void *context);
/* Appends the value that a change of a mod gives to what follows its path, as it is written on one
   line. False where the change says nothing of that. */
bool jox_scene_why_change(const JoxPatchChange *change, const char *rest, JoxText *out);
/* Appends the keys that differ and that a run cannot take over, each with why: "seed (...), ...".
 */
void jox_scene_later(const JoxSceneSpec *a, const JoxSceneSpec *b, JoxText *out);
/* Every key with type, unit, range, default and meaning, as plain text. */
void jox_scene_print_reference(JoxText *out);
/* The same as a page of Markdown, with examples. */
void jox_scene_reference_markdown(JoxText *out);
/* A JSON Schema (draft-07) of scenes ("scene") or of a mod's file ("mod"), for editors. */
void jox_scene_json_schema(const char *root_owner, JoxText *out);

/* A file that shows every key of an owner; scenes among them load and run in the folder scenes/. */
typedef struct JoxExample {
    const char *owner, *yaml;
} JoxExample;
extern const JoxExample jox_scene_examples[];
extern const size_t jox_scene_example_count;

#endif
