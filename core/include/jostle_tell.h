/* Part of jostle.h, which includes it: facts about a run and its files, returned as structs.
 *
 * Each struct is a snapshot, made by the call that returns it. It is one block of memory: one
 * jo_free releases it with its arrays and texts, and it may outlive the scene. A call returns
 * NULL if memory is out, and where its comment says so. Texts are UTF-8; an absent one is "" and
 * not NULL, unless a field says otherwise. Units are those of jostle.h. */
#ifndef JOSTLE_TELL_H
#define JOSTLE_TELL_H

#include "jostle.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- figures ----------------------------------------------------------------------------- */

typedef enum JoFigureKind {
    JO_FIGURE_NONE,  /* unknown, such as a density that was not sampled */
    JO_FIGURE_TRUTH, /* true or false */
    JO_FIGURE_NUMBER,
    JO_FIGURE_TEXT,
    JO_FIGURE_TABLE, /* holds the following, deeper figures, by name */
    JO_FIGURE_LIST   /* holds the following, deeper figures, in an order */
} JoFigureKind;
/* One figure of a run: a named result, input or cost. Figures form a tree, listed depth first. */
typedef struct JoFigure {
    const char *path; /* "events.hits", "probes.door.flow", "inputs.0.path" */
    const char *name; /* last part of the path; NULL for an item of a list */
    JoFigureKind kind;
    int depth;        /* nesting depth, from 1 */
    double number;    /* value of a number; 0 or 1 for a truth; else NAN */
    const char *text; /* value of a text, else NULL */
} JoFigure;
typedef struct JoFigures {
    const JoFigure *items;
    uint32_t count;
} JoFigures;
/* Returns the figures of the run so far, the same as `jostle run --summary` writes: in s, m, m/s,
   N, 1/m2, 1/s, or the unit with which their name ends. Reporting and recording may add figures,
   but do not change these. "density_max" is the greatest density at any place and time, people per
   m2 by a Gaussian of R = 1 m within the walls, sampled every 0.5 simulated s (absent with
   JoSceneDef.no_density). */
JO_API JoFigures *jo_scene_figures(const JoScene *scene);
/* Returns the number of the figure with a path; NAN if there is none. */
JO_API double jo_figure(const JoFigures *figures, const char *path);

/* ---- probes ------------------------------------------------------------------------------ */

/* Returns the name of the n-th probe of the scene (what it measures is in the scene's file), from
   0; NULL after the last. */
JO_API const char *jo_scene_probe_name(const JoScene *scene, uint32_t n);
typedef struct JoTableColumn {
    const char *name, *unit;  /* "density", "1/m2" */
    const double *numbers;    /* one per row; NAN where the cell is no number */
    const char *const *texts; /* one per row if some cells are no numbers; else NULL */
} JoTableColumn;
typedef struct JoTable {
    const JoTableColumn *columns;
    uint32_t column_count, row_count;
} JoTable;
/* Returns the measurements of the n-th probe so far, rounded as a report writes them. NULL also if
   there is no such probe. */
JO_API JoTable *jo_scene_probe_table(const JoScene *scene, uint32_t n);

/* ---- troubles and costs ------------------------------------------------------------------ */

/* Kinds of faults in a run that did not end it. */
typedef enum JoTroubleKind {
    JO_TROUBLE_SUSPENDED, /* a function of a behaviour failed too often and is no longer called */
    JO_TROUBLE_LOST,      /* people were lost (JoLost) */
    JO_TROUBLE_FAILED,    /* a function of a behaviour failed in a tenth of its calls or more */
    JO_TROUBLE_NO_WAY     /* people cannot reach their goal: walls, an immovable body or a gate that
                             nothing opens lies between, or all gaps are narrower than they */
} JoTroubleKind;
typedef struct JoTrouble {
    JoTroubleKind kind;
    uint64_t count;   /* by kind: failures within a second; people; failed calls; people */
    const char *file; /* file of the behaviour, or "" */
    const char *text; /* a sentence, without its full stop */
} JoTrouble;
typedef struct JoTroubles {
    const JoTrouble *items;
    uint32_t count; /* 0: none; else the run went on, but not as its files demand */
} JoTroubles;
JO_API JoTroubles *jo_scene_troubles(const JoScene *scene);

/* Parts of a behaviour that had no effect in the run so far, and may be mistakes. */
typedef enum JoHintKind {
    JO_HINT_STATE,      /* no agent entered a state */
    JO_HINT_TRANSITION, /* a transition was never taken, though some agent was always in its state
                         */
    JO_HINT_GOAL,       /* the same, for a transition that waits for an agent to reach its goal */
    JO_HINT_CYCLE,      /* agents cycle through states of one step each */
    JO_HINT_SIGHT /* a condition tests a distance beyond what any agent in its state perceived */
} JoHintKind;
typedef struct JoHint {
    JoHintKind kind;
    const char *behaviour, *file;
    int line;            /* line of the file, from 1 */
    const char *text;    /* a sentence, without its full stop */
    const char *way_out; /* remedy: a sentence, without its full stop */
} JoHint;
typedef struct JoHints {
    const JoHint *items; /* in order of behaviour and line; one for each state, at most 20 */
    uint32_t count;
} JoHints;
/* Finds hints in the run so far. States, transitions and goals are judged only after the scene's
   duration is over, only in behaviours that were not reloaded in the last run of that length,
   and only if the condition is one of places, order, memory or measured figures. Conditions on
   what may or may not happen (stuck, heard, hit_by, sees, and the like, chances, functions) are
   not judged. */
JO_API JoHints *jo_scene_hints(const JoScene *scene);

/* Cost of a plain Lua function of a behaviour in the run so far. */
typedef struct JoLuaCost {
    const char *behaviour, *file; /* name and file of the behaviour */
    const char *where;            /* "state Circle > on_enter" */
    uint64_t calls, failures;
    double seconds; /* s of processor time, estimated from one call in 16; the sum over all items is
                       at most `stepping` */
    bool suspended;
} JoLuaCost;
typedef struct JoLuaCosts {
    const JoLuaCost *items; /* in order of behaviour */
    uint32_t count;
    double stepping; /* s: time of all steps of the world */
} JoLuaCosts;
JO_API JoLuaCosts *jo_scene_lua_costs(const JoScene *scene);

/* ---- mods -------------------------------------------------------------------------------- */

/* The user's choice for a mod (jo_mods_enable). */
typedef enum JoModSwitch {
    JO_MOD_OFF,     /* not turned on: loaded only where it is named */
    JO_MOD_CHANGED, /* turned on, but its files have changed since: treated as JO_MOD_OFF */
    JO_MOD_ON
} JoModSwitch;
/* One change that a mod makes. */
typedef struct JoModPatch {
    const char *target; /* name of the behaviour or scene that it changes; "" if it names none */
    bool behaviour;     /* true: the target is a behaviour; false: a scene */
    bool replaces;      /* replaces the target as a whole */
} JoModPatch;
typedef enum JoModSettingKind {
    JO_SETTING_NUMBER,
    JO_SETTING_BOOL,
    JO_SETTING_CHOICE /* one of several texts */
} JoModSettingKind;
/* A value that a mod declares for users to set. */
typedef struct JoModSetting {
    const char *name, *unit, *meaning;
    double value, least, greatest; /* a bool is 0 or 1; a choice the index of its text */
    JoModSettingKind kind;
    const char *text;    /* the value as a text, "true" or "polite"; "" for a number */
    const char *choices; /* the texts of a choice, each ended by a line feed; else "" */
} JoModSetting;
/* A mod: a folder of patches to the behaviours and scenes of others, and of behaviours of its own.
 */
typedef struct JoMod {
    const char *name, *version, *title, *folder;
    JoModSwitch on;
    bool taken;                /* a run would load it */
    const JoModPatch *patches; /* only for a mod that is taken, else none */
    const JoModSetting *settings;
    uint32_t patch_count, setting_count;
} JoMod;
typedef struct JoMods {
    const JoMod *items; /* taken mods in the order of loading, then the others by name */
    uint32_t count, taken;
    uint32_t errors; /* errors in the mods listed or asked for; each was sent to `message` */
} JoMods;
/* Lists the mods that a run of the scene would load (path NULL: only those of the user's data
   directory), and the others that were found. Errors in them go to def->message. */
JO_API JoMods *jo_mods_list(const JoSceneDef *def);
/* Turns a mod on or off for all later runs. `mod` is its folder, or its name if it lies beside
   the scene of def->path or in the user's data directory (path NULL: also in mods/ or
   scenes/mods/). The choice is kept in the user's configuration with a hash of the mod's files:
   when these change, the mod is off until it is turned on again. False with `error`. */
JO_API bool jo_mods_enable(const JoSceneDef *def, const char *mod, bool on, JoError *error);

/* Kind of file or call that set a value. */
typedef enum JoSetBy {
    JO_SET_DEFAULT,   /* the default, set by no file */
    JO_SET_BEHAVIOUR, /* the file of a behaviour, or a module that it requires */
    JO_SET_SCENE,     /* the scene's file, or one that it includes */
    JO_SET_MOD,
    JO_SET_OVERRIDE, /* JoSceneDef.overrides */
    JO_SET_FUNCTION, /* a plain Lua function of a behaviour, during the run */
    JO_SET_PROGRAM,  /* a program, an input log or the live page, during the run */
    JO_SET_UNSEEN /* a function or a program, before jo_agent_why was first called for the agent */
} JoSetBy;
/* One assignment of a value, and its place in the files. */
typedef struct JoSetting {
    JoSetBy by;
    const char *value;         /* as written, on one line; "" if the value is removed */
    const char *unit;          /* unit of a default; else "" */
    const char *file;          /* "" for a default */
    int line, column;          /* from 1; 0 for a default */
    const char *mod, *version; /* name and version of the mod, else "" */
    bool removes;              /* removes the value */
    const char *where; /* for jo_agent_why: "defaults", "state Go", "groups.people", "to Hit" (a
                          transition); else "" */
    double time;       /* s: time in the run at which it was set; NAN: before the run, or unknown */
    bool extends;      /* a function of a mod that extends what stands before it (before, ...) */
} JoSetting;
/* Receives one setting; its texts are valid within the call, and NULL stands for "". */
typedef void JoSetVisit(void *context, const JoSetting *setting);
typedef struct JoSettings {
    const JoSetting *items; /* in order of application: the last one is in force */
    uint32_t count;
    const char *now; /* for jo_agent_why: present value as text: a number, true or false, or the
                        name of a place; else "" */
} JoSettings;
/* Lists all settings of a value of a behaviour ("tawaf.Circle.push") or of the scene
   ("groups.red.count"). NULL with `error` if there is no such path. */
JO_API JoSettings *jo_mods_why(const JoSceneDef *def, const char *path, JoError *error);
/* Lists the settings of a value of one agent, the last one being in force, and writes its
   present value to *value: a parameter ("speed"), a name of its memory ("hits"), or an own value
   ("court"; if it is a place, *value is the number of that). Changes of memory, and of
   parameters during the run, are tracked from the first call for this agent on, as long as one
   follows at least every 5 simulated seconds. The run does not change by it. NULL with `error`,
   and *value unchanged, if the agent is gone or has no such value. */
JO_API JoSettings *jo_agent_why(JoScene *scene, JoAgent agent, const char *name, double *value,
                                JoError *error);

#ifdef __cplusplus
}
#endif
#endif
