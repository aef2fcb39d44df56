/* Scene specifications: a YAML file is read into a JoxSceneSpec, plain data from which run/ builds
   a world. Units are m, s and kg; angles are in radians. The format is the table in key_table.c. */
#ifndef JOX_SCENE_SCENE_H
#define JOX_SCENE_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "agents/walk_law.h"
#include "base/format/diag.h"
#include "base/format/patch.h"
#include "base/number/random.h"
#include "body/body.h"
#include "geom/lifts.h"
#include "geom/place.h"
#include "geom/storeys.h"
#include "geom/walls.h"
#include "scene/scenery.h"
#include "world/criterion.h"
#include "world/exits.h"
#include "world/population.h"
#include "world/probe.h"
#include "world/scheduled_events.h"
#include "world/sources.h"

/* A polygon in which a run measures the mean speed. */
typedef struct JoxSceneRegion {
    char *name;
    JoxV2 *points; /* m, counter-clockwise */
    uint32_t count;
} JoxSceneRegion;

typedef struct JoxSceneBody {
    JoxBodyDef def; /* its tags are 0: `tags` has their names */
    char **tags;
    uint32_t tag_count;
    JoxPosition position; /* in the scene's file */
} JoxSceneBody;

/* Tools of the live page, by which people act on the running scene: enumerator, name. */
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
extern const char *const jox_scene_tools[JOX_TOOL_COUNT]; /* their names */

/* A file that the scene was read from. */
typedef struct JoxSceneFile {
    char *path;
    char sha256[65];
    const char *text;
    size_t length;
} JoxSceneFile;

typedef struct JoxSceneCamera {
    double position[3], target[3]; /* m */
    bool given;                    /* false: the camera is chosen from the scene's extent */
} JoxSceneCamera;

/* Quantities that agents can be coloured by, in the order of the choices of the key `colour`, which
   has "auto" before them. */
#define JOX_SCENE_COLOURS(X)                                                                       \
    X(state) X(speed) X(force) X(compression) X(load) X(density) X(group) X(direction) X(service)

typedef struct JoxSceneView {
    uint32_t tools;         /* bit set of JoxTool */
    uint32_t colour, field; /* index of the choice of each key */
} JoxSceneView;
/* Names of the choices of both keys. */
extern const char *const jox_scene_colours[], *const jox_scene_fields[];
enum {
#define X(colour) +1
    JOX_SCENE_COLOUR_COUNT = 1 JOX_SCENE_COLOURS(X),
#undef X
    JOX_SCENE_NO_FIELD = 2, /* index of "none" */
    JOX_SCENE_FIELD_COUNT
};

/* A tally: a number computed from the agents that are there, as a score. It counts agents, or takes
   a statistic of a memory that behaviours write. */
typedef enum JoxTallyStatistic {
    JOX_TALLY_SUM,
    JOX_TALLY_MEAN,
    JOX_TALLY_LEAST,
    JOX_TALLY_GREATEST
} JoxTallyStatistic;
typedef struct JoxTally {
    char *name;
    JoxPosition position; /* position of the name */
    char *memory, *state; /* the memory that is evaluated; only agents in this state; NULL: any */
    JoxPosition memory_position, state_position;
    int32_t group;      /* only agents of this group; -1: all */
    uint32_t statistic; /* JoxTallyStatistic, of the memory */
    char *unit;         /* NULL: none */
} JoxTally;

/* A level of a game: values that it sets for the agents of a group. */
typedef struct JoxGameLevel {
    char *name;
    JoxPosition position; /* position of the name */
    int32_t group;        /* -1: it sets nothing */
    JoxGroupValue *set;
    uint32_t set_count;
} JoxGameLevel;

/* A game between the player and the machine, in rounds: how a round ends, and who wins it. */
typedef enum JoxGameTie { JOX_GAME_TIE_DRAW, JOX_GAME_TIE_OURS, JOX_GAME_TIE_THEIRS } JoxGameTie;
typedef struct JoxGame {
    bool given;
    int32_t ours, theirs; /* tallies: scores of the player's side and of the other */
    double points;        /* the first with so many wins; NAN: no such end */
    double time;          /* s: a round ends then; NAN: no such end */
    int32_t all;          /* it ends when the scores count all agents of this group; -1: no */
    uint32_t tie;         /* JoxGameTie */
    double rounds;        /* of a match */
    double speed;         /* m/s, that the page asks of the player's agent */
    char *how;            /* text on how to play; NULL: none */
    char *button;         /* action of the button, a word; NULL: no button */
    char *ball;           /* tag of bodies that the page marks; NULL: none */
    JoxGameLevel *levels;
    uint32_t level_count;
    char *level; /* name of the level that is played; NULL: there are none */
    JoxPosition position;
} JoxGame;

/* Limits on the Lua scripts of behaviours. */
typedef struct JoxSceneLimits {
    double instructions;      /* instructions of one call */
    double step_instructions; /* instructions of all calls of a behaviour in a step */
    double load_instructions; /* instructions for loading a behaviour */
    double memory, block;     /* MB: of a behaviour, of one allocation */
    double source;            /* KB of a file */
    double print;             /* lines printed in a second */
} JoxSceneLimits;

/* The title block of a report; NULL: not given. */
typedef struct JoxSceneReport {
    char *author, *organisation, *project, *reference;
    char *checked_by, *approved_by, *date, *notes;
} JoxSceneReport;

/* A scene as it was read: all that a world is built from, as plain data. */
typedef struct JoxSceneSpec {
    char *path, *title;
    char *about; /* description for the live page; may be empty */
    char *input; /* path of the input log, or NULL */
    uint64_t seed;
    double step, duration, gravity; /* s, s, m/s2 */
    bool bounded;
    JoxV2 low, high;             /* m, corners of the bounds, if bounded */
    bool periodic_x, periodic_y; /* opposite bounds are joined */
    JoxStoreys storeys; /* without storeys: all members 0. Points of all else are positions on its
                           sheets */
    JoxLift *lifts;     /* not laid out; their places are the first of `places` */
    uint32_t lift_count;
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
    JoxCriterion *criteria;
    uint32_t criterion_count;
    JoxEvent *events;
    uint32_t event_count;
    JoxTally *tallies;
    uint32_t tally_count;
    JoxScenery *scenery;
    uint32_t scenery_count;
    uint32_t floor; /* index of jox_floor_names */
    JoxGame game;
    int32_t player_group;              /* -1: none */
    uint32_t player_agent;             /* index within that group */
    bool forces;                       /* false: collision avoidance alone */
    bool literal;                      /* forces act as the paper's equations are printed */
    uint32_t lost_people, lost_bodies; /* JoLost: reaction to numbers that are not finite */
    JoxSceneCamera camera;
    JoxSceneView view;
    JoxSceneLimits limits;
    JoxSceneReport report;
    JoxWalkLaw walking;
    bool heatmap;                    /* the area of the density map was given */
    JoxV2 heatmap_low, heatmap_high; /* m */
    double heatmap_from;             /* s: averages of the density map begin then */
    JoxSceneFile *files;             /* the scene, included files, patches, files of walls */
    uint32_t file_count;
    const struct JoxYaml *tree;     /* with includes, patches and values set for the run */
    const struct JoxYaml *own_tree; /* with includes alone */
    JoxPatchChanges changes;        /* made by mods */
    void *memory; /* JoxArena: owns every text and array above but `walls` and `changes` */
} JoxSceneSpec;

typedef struct JoxSceneOptions {
    const char *const *sets; /* "PATH=VALUE", as "groups.pilgrims.count=5000" */
    uint32_t set_count;
    const char *datadir; /* folder of installed behaviours/; NULL: as built */
    const JoxMod *mods;  /* in their order: the scene is patched by them, and may use their
                            behaviours */
    uint32_t mod_count;
} JoxSceneOptions;

/* Reads a scene; NULL if there are errors, all of which are in `diagnostics`. `options` may be
   NULL. Free it by jox_scene_free. */
JoxSceneSpec *jox_scene_read(const char *path, const JoxSceneOptions *options,
                             JoxDiagnostics *diagnostics);
/* Reads a scene from memory; files it names are searched in the folder of the path `name`. */
JoxSceneSpec *jox_scene_read_text(const char *name, const char *text, size_t length,
                                  const JoxSceneOptions *options, JoxDiagnostics *diagnostics);
void jox_scene_free(JoxSceneSpec *scene);
/* Whether two versions of a scene have different values of a top-level key. */
bool jox_scene_differs(const JoxSceneSpec *a, const JoxSceneSpec *b, const char *key);
/* Gives a group of a specification the behaviours of a group of another version, with their shares
   and texts. */
void jox_scene_copy_behaviours(const JoxGroup *from, JoxSceneSpec *to, uint32_t group);
/* Appends the top-level keys that differ and that a reload cannot apply, each with the reason:
   "seed (...), ...". */
void jox_scene_list_restart_keys(const JoxSceneSpec *a, const JoxSceneSpec *b, JoxText *out);
/* Appends the other top-level keys that differ, "floor, camera", but for those of `apart` (ends
   with NULL). */
void jox_scene_list_live_keys(const JoxSceneSpec *a, const JoxSceneSpec *b,
                              const char *const *apart, JoxText *out);
/* Returns the name of the quantity that agents are coloured by first: the choice of the key
   `colour`, or for 0 the most telling one for behaviours with `states` states in all and `groups`
   groups. */
const char *jox_scene_choose_colouring(uint32_t choice, uint32_t states, uint32_t groups);

/* Where the value of a path ("groups.red.count"; items of lists by name or number) comes from, for
   `jostle mod why`: in the scene's own files, set for the run, by default. Each calls `visit` with
   the value as it is written on one line; false if it is not written there. */
bool jox_scene_visit_own_value(const JoxSceneSpec *scene, const char *path, JoSetVisit *visit,
                               void *context);
bool jox_scene_visit_set_value(const JoxSceneSpec *scene, const char *path, JoSetVisit *visit,
                               void *context);
bool jox_scene_visit_default(const JoxSceneSpec *scene, const char *path, JoSetVisit *visit,
                             void *context);
/* Appends the value that a mod's change gives to `rest`, a path below the change's own, as it is
   written on one line; false if the change has no value for it. */
bool jox_scene_print_changed_value(const JoxPatchChange *change, const char *rest, JoxText *out);

/* Appends all keys with type, unit, range, default and meaning, as plain text. */
void jox_scene_print_reference(JoxText *out);
/* Appends the same as a page of Markdown, with examples. */
void jox_scene_print_markdown(JoxText *out);
/* Appends a JSON Schema (draft-07) of scenes ("scene") or of a mod's file ("mod"), for editors. */
void jox_scene_print_json_schema(const char *root_owner, JoxText *out);

/* A file that shows every key of an owner. Those that are scenes load and run in the folder
   scenes/. */
typedef struct JoxExample {
    const char *owner, *yaml;
} JoxExample;
extern const JoxExample jox_scene_examples[];
extern const size_t jox_scene_example_count;

#endif
