/* Part of jostle.h, which includes it: what a program is told of a run and of its files, as
 * structs.
 *
 * Each is made by the call that returns it, holds what was so then, and is one piece of memory: one
 * jo_free releases it with its arrays and texts, and it may outlive the scene. NULL where memory is
 * out, and where a call says so. Texts are UTF-8; they are "" and not NULL, unless a field says
 * otherwise. Units are those of jostle.h. */
#ifndef JOSTLE_TELL_H
#define JOSTLE_TELL_H

#include "jostle.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- figures ----------------------------------------------------------------------------- */

typedef enum JoFigureKind {
    JO_FIGURE_NONE, /* not known, as a density that was not sampled */
    JO_FIGURE_TRUTH,
    JO_FIGURE_NUMBER,
    JO_FIGURE_TEXT,
    JO_FIGURE_TABLE, /* has figures by name, */
    JO_FIGURE_LIST   /* or in an order: those that follow and lie deeper */
} JoFigureKind;
typedef struct JoFigure {
    const char *path; /* "events.hits", "probes.door.flow", "inputs.0.path" */
    const char *name; /* its last part; NULL in a list */
    JoFigureKind kind;
    int depth;        /* from 1 */
    double number;    /* of a truth 0 or 1; NAN where it is no number */
    const char *text; /* of a text, else NULL */
} JoFigure;
typedef struct JoFigures {
    const JoFigure *items;
    uint32_t count;
} JoFigures;
/* The figures of the run so far, those that `jostle run --summary` writes: in s, m, m/s, N, 1/m2,
   1/s, or what their name ends with. They do not depend on what is reported or recorded, which may
   add some. "density_max" is the greatest density of any place and time, people per m2 by a
   Gaussian of R = 1 m within the walls, sampled every 0.5 simulated s (JoSceneDef.no_density:
   none). */
JO_API JoFigures *jo_scene_figures(const JoScene *scene);
/* The number at a path; NAN where there is none. */
JO_API double jo_figure(const JoFigures *figures, const char *path);

/* ---- probes ------------------------------------------------------------------------------ */

/* The name of the n-th probe of the scene, from 0; NULL behind the last. */
JO_API const char *jo_scene_probe_name(const JoScene *scene, uint32_t n);
typedef struct JoTableColumn {
    const char *name, *unit;  /* "density", "1/m2" */
    const double *numbers;    /* of each row; NAN where it is none */
    const char *const *texts; /* of each row, where some are no numbers; else NULL */
} JoTableColumn;
typedef struct JoTable {
    const JoTableColumn *columns;
    uint32_t column_count, row_count;
} JoTable;
/* What a probe has measured so far, to the digits that a report writes. NULL, too, where there is
   no such probe. */
JO_API JoTable *jo_scene_probe_table(const JoScene *scene, uint32_t n);

/* ---- troubles and costs ------------------------------------------------------------------ */

typedef enum JoTroubleKind {
    JO_TROUBLE_SUSPENDED, /* a function of a behaviour failed too often and is no longer called */
    JO_TROUBLE_LOST,      /* people were lost (JoLost) */
    JO_TROUBLE_FAILED,    /* a function of a behaviour failed in a tenth of its calls or more */
    JO_TROUBLE_NO_WAY     /* people cannot reach their goal: walls, a body that nothing moves or a
                             gate that nothing opens lies between, or no gap is as wide as they */
} JoTroubleKind;
typedef struct JoTrouble {
    JoTroubleKind kind;
    uint64_t count;   /* failures within a second; people; calls that failed; people */
    const char *file; /* of the behaviour, or "" */
    const char *text; /* a sentence, without its full stop */
} JoTrouble;
typedef struct JoTroubles {
    const JoTrouble *items;
    uint32_t count; /* 0: none; else the run went on, but not as it was written */
} JoTroubles;
JO_API JoTroubles *jo_scene_troubles(const JoScene *scene);

/* What a behaviour has that came to nothing in the run so far, and may be a mistake. */
typedef enum JoHintKind {
    JO_HINT_STATE,      /* nobody came into a state */
    JO_HINT_TRANSITION, /* a transition was not taken, though somebody was always in its state */
    JO_HINT_GOAL,       /* the same, of one that waits for who goes to a place to be there */
    JO_HINT_CYCLE,      /* people go round states of which each lasts a step */
    JO_HINT_SIGHT       /* a condition asks for a distance farther than anybody there saw */
} JoHintKind;
typedef struct JoHint {
    JoHintKind kind;
    const char *behaviour, *file;
    int line;            /* of the file, from 1 */
    const char *text;    /* a sentence, without its full stop */
    const char *way_out; /* likewise: what to do about it */
} JoHint;
typedef struct JoHints {
    const JoHint *items; /* by behaviour and line; one for each state, at most 20 */
    uint32_t count;
} JoHints;
/* Of states, transitions and goals only once the scene's duration is over, of behaviours that were
   not reloaded in the last of it, and where the condition is one of places, order, memory or
   measured figures: those that wait for what may or may not happen (stuck, heard, hit_by, sees, and
   the like, chances, functions) are not judged. */
JO_API JoHints *jo_scene_hints(const JoScene *scene);

/* What a plain Lua function of a behaviour cost so far. */
typedef struct JoLuaCost {
    const char *behaviour, *file; /* its name; its file */
    const char *where;            /* "state Circle > on_enter" */
    uint64_t calls, failures;
    double seconds; /* of processor time, estimated from one call in 16; all together at most
                       `stepping` */
    bool suspended;
} JoLuaCost;
typedef struct JoLuaCosts {
    const JoLuaCost *items; /* by behaviour */
    uint32_t count;
    double stepping; /* s, of the world's steps in all */
} JoLuaCosts;
JO_API JoLuaCosts *jo_scene_lua_costs(const JoScene *scene);

/* ---- mods -------------------------------------------------------------------------------- */

/* What a person said of a mod (jo_mods_enable). */
typedef enum JoModSwitch {
    JO_MOD_OFF,     /* nothing: it is taken only where it is named */
    JO_MOD_CHANGED, /* it was turned on, and holds something else since: as above */
    JO_MOD_ON
} JoModSwitch;
typedef struct JoModPatch {
    const char
        *target;    /* what it changes: a behaviour's name or a scene's; "" where it says none */
    bool behaviour; /* else a scene */
    bool replaces;  /* takes the place of it */
} JoModPatch;
typedef struct JoModSetting {
    const char *name, *unit, *meaning;
    double value, least, greatest;
} JoModSetting;
typedef struct JoMod {
    const char *name, *version, *title, *folder;
    JoModSwitch on;
    bool taken;                /* a run would take it */
    const JoModPatch *patches; /* of those that are taken */
    const JoModSetting *settings;
    uint32_t patch_count, setting_count;
} JoMod;
typedef struct JoMods {
    const JoMod *items; /* those that are taken, in their order, then the others, by name */
    uint32_t count, taken;
    uint32_t errors; /* found in mods that are taken, asked for or lie there, also told */
} JoMods;
/* The mods that a run of the scene would take (path NULL: of the user's data directory alone), and
   the others that were found. What is wrong with one goes to def->message. */
JO_API JoMods *jo_mods_list(const JoSceneDef *def);
/* Turns a mod on or off for all later runs: its folder, or its name where it lies beside the scene
   of def->path or in the user's data directory (path NULL: also in mods/ or scenes/mods/). That is
   kept in the user's configuration with a hash of what the mod holds: when that changes, the mod is
   off until it is turned on again. False with `error`. */
JO_API bool jo_mods_enable(const JoSceneDef *def, const char *mod, bool on, JoError *error);

typedef enum JoSetBy {
    JO_SET_DEFAULT,   /* nobody: what holds otherwise */
    JO_SET_BEHAVIOUR, /* the file of a behaviour, or what it requires */
    JO_SET_SCENE,     /* the scene's file, or what it includes */
    JO_SET_MOD,
    JO_SET_OVERRIDE, /* JoSceneDef.overrides */
    JO_SET_FUNCTION, /* a plain function of a behaviour, in the run */
    JO_SET_PROGRAM,  /* a program, a line of an input log or the live page, in the run */
    JO_SET_UNSEEN    /* one of the last two, before the agent was first asked about */
} JoSetBy;
/* A place that sets a value. */
typedef struct JoSetting {
    JoSetBy by;
    const char *value;         /* as it is written, on one line; "" where it is taken away */
    const char *unit;          /* of a default; else "" */
    const char *file;          /* "" of a default */
    int line, column;          /* from 1; 0 of a default */
    const char *mod, *version; /* of a mod, else "" */
    bool removes;              /* takes the value away */
    const char *where; /* of jo_agent_why: "defaults", "state Go", "groups.people", "to Hit" (a
                          transition); else "" */
    double time;       /* s: when it was set in the run; NAN: before, or not known */
} JoSetting;
/* Is told of one; its texts are valid within the call, and NULL stands for "". */
typedef void JoSetVisit(void *context, const JoSetting *setting);
typedef struct JoSettings {
    const JoSetting *items; /* in their order: the last one counts */
    uint32_t count;
    const char *now; /* of jo_agent_why: the value as text: a number, true or false, or the name of
                        a place; else "" */
} JoSettings;
/* Who sets a value: "tawaf.Circle.push" of a behaviour, or "groups.red.count" of the scene. NULL
   with `error` where there is no such path. */
JO_API JoSettings *jo_mods_why(const JoSceneDef *def, const char *path, JoError *error);
/* What a value of one agent is now, and what set it, the last one being in force: a parameter
   ("speed"), a name of its memory ("hits"), or an own value ("court"; of one that is a place,
   *value is its number). Who wrote memory, and who in the run set a parameter, is known from the
   first call for this agent on, as long as it is asked for at least every 5 simulated seconds. The
   run does not change by it. NULL with `error`, and *value as it was, where the agent is gone or
   has no such value. */
JO_API JoSettings *jo_agent_why(JoScene *scene, JoAgent agent, const char *name, double *value,
                                JoError *error);

#ifdef __cplusplus
}
#endif
#endif
