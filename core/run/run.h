/* What the files of run share: a running scene. */
#ifndef JOX_RUN_RUN_H
#define JOX_RUN_RUN_H

#include <stdio.h>

#include "base/format/diag.h"
#include "base/format/json_writer.h"
#include "base/overlay.h"
#include "jostle.h"
#include "lua/loader.h"
#include "record/danger/danger.h"
#include "record/local.h"
#include "record/probes/probe.h"
#include "record/regions.h"
#include "run/listener.h"
#include "run/watch/changes.h"
#include "run/watch/watch.h"
#include "scene/mods.h"
#include "scene/scene.h"
#include "world/routes/hindrance.h"
#include "world/world.h"

/* Is told of files that were loaded: what they are parts of (NULL: of a scene that begins), and
   what is wrong; no errors where they are live. Without diagnostics: those have been said as text.
 */
typedef void JoxDiagnosed(void *context, const bool *parts, const JoxDiagnostics *diagnostics);

struct JoScene {
    JoxHeap *heap; /* that it and its world allocate from */
    bool owns_heap;
    JoxSceneSpec *spec;
    JoxMods *mods;
    JoxDiagnostics mod_problems; /* of mods that were left out, and conflicts */
    JoWorld *world;
    JoxLua *lua;
    JoxScope scope;
    JoxScopeGroup *scope_groups; /* with copies of their texts */
    JoMessage *message;
    void *message_context;

    struct JoxReload *reload;      /* NULL: files are not watched */
    const struct JoVetter *vetter; /* who reads edited files first; NULL: nobody */
    JoxDiagnosed *diagnosed;       /* NULL: nobody wants to know */
    void *diagnosed_context;
    double swap_seconds; /* the longest that a swap has held a step up */
    JoSceneDef def;      /* as it was loaded, with copies of its texts */
    char **spec_files;   /* the scene's file and what it includes */
    uint32_t spec_file_count;
    JoxListeners listeners;    /* who collects what happens */
    struct JoxRunFrame *frame; /* the present frame; NULL until it is asked for */
    bool finished;
    char *input_path; /* of the input log that is played, or NULL */
    char input_sha256[65];
    FILE *log; /* input log that is written, or NULL */
    char *log_path;
    uint64_t resumed_tick;
    uint64_t log_length; /* bytes of it that a resumed run goes on behind */
    bool log_failed;
    size_t warnings;       /* that were given, of files and of the run */
    bool acted_on;         /* by people, other than a log */
    JoxInputLog input;     /* as it was read, until there is a world */
    JoxFiles logged_files; /* whose texts stand in it */
    JoxOverlay overlay;    /* texts of the log that is played, or of a checkpoint */
    JoxText resumed; /* the checkpoint that it was resumed from, as its file has it; or empty */
    JoxOverlay tape; /* all texts that it was loaded from, where it is resumable */
};

/* Sends formatted text to the scene's message function. */
void jox_run_say(const JoScene *scene, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Sends diagnostics as text, fills `error` from the first error, and frees them. */
void jox_run_report(JoMessage *message, void *context, JoxDiagnostics *diagnostics, JoError *error);

/* results/tell.c: what jo_scene_troubles tells, in one sentence; NULL: nothing. To be freed. */
char *jox_run_troubles(const JoScene *scene);

/* Writes to stderr, and makes room where a line of progress stands. */
void jox_run_to_stderr(void *context, const char *text);
/* Calls a `message` of the program's (NULL: to stderr); that of the scene. */
void jox_run_message(JoMessage *message, void *context, const char *text);
void jox_run_tell(const JoScene *scene, const char *text);
/* Calls `diagnosed`, unless NULL. */
void jox_run_tell_diagnosed(JoxDiagnosed *diagnosed, void *context, const bool *parts,
                            const JoxDiagnostics *diagnostics);
/* As jo_scene_load; `diagnosed` (it may be NULL) is told of mistakes, then and in all reloads. */
JoScene *jox_run_load_told(const JoSceneDef *def, JoxDiagnosed *diagnosed, void *context,
                           JoError *error);
/* As jo_scene_load, but what is wrong goes to `diagnostics`. NULL if there are errors. */
JoScene *jox_run_load(const JoSceneDef *def, JoxDiagnostics *diagnostics);
/* mods.c: finds the mods of a scene and what their files change; `without` are bits of those found
   that are left out, as is a mod with a patch that names no target. */
JoxMods *jox_run_find_mods(const JoSceneDef *def, uint64_t without, JoxDiagnostics *diagnostics);
/* Whether nothing is missing of its lists, and of the threads that it gives. */
bool jox_run_is_whole(const JoSceneDef *def);
JoxSceneSpec *jox_run_load_spec(const JoSceneDef *def, const JoxMods *mods, uint32_t mod_count,
                                JoxDiagnostics *diagnostics);
/* link.c: machines of the scene's groups, and of those that they may become; false if one does not
   load. */
bool jox_run_load_machines(JoScene *scene, JoxDiagnostics *diagnostics);
/* What machines expect of each other and of the scene: signals, states, own values. */
void jox_run_check_names(const JoScene *scene, JoxDiagnostics *diagnostics);
/* Warns where the scene was made of no file of a mod: its patches change nothing there. */
void jox_run_check_use(const JoScene *scene, const JoxMod *mod, JoxDiagnostics *diagnostics);
/* A note where flows are measured of people who do not walk by the walking law: of the
   first group that is so. False: none. */
bool jox_run_advise(const JoScene *scene, JoxDiagnostics *diagnostics);
/* Of names, the own values of one machine that is made of the files. */
void jox_run_check_own(const JoScene *scene, const JoxMachine *machine, const JoxLuaFile *files,
                       uint32_t count, JoxDiagnostics *diagnostics);
/* Index of the machine of a file, loaded where it is not there yet; -1 with diagnostics. */
/* The text of a behaviour that was made of a journey, by its path; NULL: it is a file. */
const char *jox_run_made(const JoxSceneSpec *spec, const char *path);
int32_t jox_run_machine(JoScene *scene, const char *path, JoxDiagnostics *diagnostics);
/* Finds the machines that states of machine become; false with diagnostics. */
bool jox_run_link(JoScene *scene, JoxMachine *machine, JoxDiagnostics *diagnostics);
/* belonging.c: has behaviours that are loaded from here on know the tags and teams of the world. */
void jox_run_refresh_names(JoScene *scene);
/* Gives a machine that is put in the numbers of its tags and teams in the scene. */
void jox_run_number_belongings(JoScene *scene, JoxMachine *machine);
/* Whether the tags that a machine, of these files, asks for are borne in the scene or set by one of
   `machines`, which it is among. */
void jox_run_check_belongings(const JoScene *scene, const JoxMachine *machine,
                              const JoxLuaFile *files, uint32_t file_count,
                              const JoxMachine *const *machines, uint32_t count,
                              JoxDiagnostics *diagnostics);
/* Lists tags and teams in the order of their numbers, and gives those that an overlay lists at
   jox_run_names_path the same again. */
extern const char jox_run_names_path[];
void jox_run_list_names(const JoScene *scene, JoxText *out);
void jox_run_take_names(JoScene *scene);
/* Adds to a machine that is loaded what that text says that its agents keep of earlier versions. */
void jox_run_take_kept(JoxMachine *machine);
/* populate.c: checks what groups set, and makes the agents that stand there at the start; says of
   which groups how many are shifted and how far, and how many do not fit. */
void jox_run_populate(JoScene *scene, JoxDiagnostics *diagnostics);
/* Warns of speeds and pushes for which the step is too long. */
void jox_run_check_step(const JoScene *scene, JoxDiagnostics *diagnostics);
/* wall_checks.c: sources at which walls keep some or all from coming in. */
void jox_run_check_sources(const JoScene *scene, JoxDiagnostics *diagnostics);
/* Steps of journeys whose places lie in walls. */
void jox_run_check_journeys(const JoScene *scene, JoxDiagnostics *diagnostics);
/* Goals to which no way leads people as broad as they are: walls or fixed bodies lie between, or a
   gate that nothing opens. The scene is not to be stepped from then on. */
void jox_run_check_ways(JoScene *scene, JoxDiagnostics *diagnostics);
/* Appends what keeps people from a place: "the body 'crate' fills the way at (3.0, 4.0) m". */
void jox_run_say_hindrance(const JoScene *scene, const JoxHindrance *hindrance, JoxText *out);
/* Whether an event or a line of the input log opens the walls of a name, or somebody at the page or
   a program has set them. */
bool jox_run_opens(const JoScene *scene, const char *gate);
/* The same by ring of the world's walls, to be freed by jox_free. */
bool *jox_run_opening_gates(const JoScene *scene);
/* Gives the world the spec's groups, sources, sinks and events; `anew`: sources count from now. */
void jox_run_set_schedule(JoScene *scene, bool anew);
/* input.c: what the log that is played says of the step that begins. */
void jox_run_inputs(JoScene *scene);
/* Performs an entry of an input log between two steps and logs it, as jo_scene_input does with a
   line. Returns false with the error if it cannot be performed. */
bool jox_run_input(JoScene *scene, JoxInputEntry *entry, JoError *error);
/* Notes what the program did to the world (JoWorld.record); `context` is the scene. */
void jox_run_record_act(void *context, JoxInputEntry *entry);
/* input_set.c: a parameter by the names that a line gives. `state` -1: the machine's defaults.
   False with `error` where there is none such, or the value is out of range. */
typedef struct JoxChoice {
    uint32_t machine;
    int32_t state;
    int parameter;
} JoxChoice;
bool jox_run_choose(const JoScene *scene, const char *machine, const char *state,
                    const char *parameter, double value, JoxChoice *out, JoError *error);
/* Sets it for everybody there, now and later, until the machine's file is reloaded. */
bool jox_run_set(JoScene *scene, const char *machine, const char *state, const char *parameter,
                 double value, JoError *error);
/* input_files.c: what a reload changes, noted before it goes live for the log. */
typedef struct JoxReloaded {
    JoxInputEntry before, files;
} JoxReloaded;
void jox_run_note_file(JoScene *scene, JoxReloaded *reloaded, const char *path, const char *sha256,
                       const char *text, size_t length);
/* Writes what was noted, and frees it. */
void jox_run_log_files(JoScene *scene, JoxReloaded *reloaded);
/* Whether a file is live with this very text. */
bool jox_run_is_live(const JoScene *scene, const JoxInputFile *file);
/* Writes what the run is made of. */
void jox_run_log_origin(JoScene *scene);
/* Says where the run is made of something else than the one that was logged. */
void jox_run_check_log(const JoScene *scene);
/* What files were when the run began that a log tells of. */
void jox_run_before(JoxOverlay *overlay, const JoxInputLog *log);
/* Appends to the log that is written, if one is, as of the step that comes. */
void jox_run_log(JoScene *scene, JoxInputEntry *entry);
/* False with `error` if it cannot be written. */
bool jox_run_logged(const JoScene *scene, JoError *error);
/* Ends that log. False with `error` if it could not be written. */
bool jox_run_end_log(JoScene *scene, JoError *error);
/* Names of signals get numbers; warns of those that nobody hears (`diagnostics` may be NULL). */
void jox_run_name_events(JoScene *scene, JoxDiagnostics *diagnostics);
/* The file of the machine that a state becomes; false with diagnostics. */
bool jox_run_find_become(const JoScene *scene, const JoxMachine *machine, uint32_t state,
                         char path[1024], JoxDiagnostics *diagnostics);
/* reload.c: swaps what has been loaded anew since the last step; ends the thread that loads. */
typedef struct JoxReload JoxReload;
void jox_run_reload(JoScene *scene);
/* Loads files and swaps what is made of them at once, in place of the thread that loads. */
bool jox_run_reload_now(JoScene *scene, const JoxInputEntry *files, JoError *error);
/* Keeps the thread that loads from reading machines while one of them is changed in place; what it
   compared with that one is compared anew. */
void jox_run_hold_machines(JoScene *scene, uint32_t machine, bool hold);
void jox_run_unwatch(JoScene *scene);
/* rescene.c: gives the living of a group a value that their scene sets, in one machine or (-1) in
   whichever they are. */
void jox_run_give(JoScene *scene, int32_t machine, uint32_t group, const JoxGroupValue *set);
/* Takes over from a new specification of the scene what can change while it runs, and says what
   cannot. *spec is then the old one. */
void jox_run_rescene(JoScene *scene, JoxSceneSpec **spec, double written);
/* spec.c: adds the texts of all files of a scene: as they were read, where it is resumable, or as
   they are live since. */
void jox_run_texts(const JoScene *scene, JoxOverlay *out);
/* area.c: the area that pictures and recordings show. */
void jox_run_area(const JoScene *scene, JoxV2 *low, JoxV2 *high);
/* Fills `error` with what could not be written, and frees the text. Returns false. */
bool jox_run_failed(JoError *error, JoxText *why);
/* frame.c: the frame of the present step, made once; it holds until the next. `parts`: bits of what
   is needed that the world has not in this form; what nobody needs in a step may be NULL. */
typedef struct JoxRunFrame JoxRunFrame;
enum { JOX_FRAME_VELOCITIES = 1, JOX_FRAME_FORCES = 2, JOX_FRAME_STATES = 4, JOX_FRAME_WHOLE = 7 };
const JoxFrame *jox_run_frame(JoScene *scene, uint32_t parts);
void jox_run_free_frame(JoScene *scene);
/* figures.c: whether the step that was done is one of those that come every `interval` seconds, or
   every step where that is longer. */
bool jox_run_is_due(const JoScene *scene, double interval);
/* Attaches what collects figures, if it is not there yet, from here on; and what has
   been collected so far, or NULL. Regions and probes: of scenes that have some. False with `error`
   where the checkpoint that the scene was resumed from has something of it that is not sound. */
void jox_run_collect_regions(JoScene *scene);
bool jox_run_collect_local(JoScene *scene, JoError *error);
bool jox_run_collect_danger(JoScene *scene, JoError *error);
void jox_run_collect_danger_in(JoScene *scene, JoxV2 low, JoxV2 high); /* m */
const JoxRegions *jox_run_regions(const JoScene *scene);
/* Local densities, which every run samples that is not told to do without. */
const JoxLocal *jox_run_local(const JoScene *scene);
/* The same, with crowd pressure from here on. */
const JoxLocal *jox_run_want_pressure(JoScene *scene);
/* The greatest density of any place and sample, 1/m2: the figure density_max. */
double jox_run_density_max(const JoScene *scene);
const JoxDanger *jox_run_danger(const JoScene *scene);
/* The same for who wanted to get on and yet came no farther than 0.25 m for the longest. */
typedef struct JoxStood {
    double seconds, until; /* s: how long, and when it ended or was last seen */
    JoxV2 at;              /* m */
    uint32_t id;           /* JOX_NO_INDEX while there was nobody */
} JoxStood;
/* standing.c; says, while the run goes on, where a crowd has stood still for 30 s, and to which
   place no way leads. */
void jox_run_collect_standing(JoScene *scene);
const JoxStood *jox_run_stood_longest(const JoScene *scene);
/* The longest time that a crowd stood still: 10 people and more who wanted to get on, or half of
   all, and came no farther than 0.25 m for 30 s or more. NULL: none did. */
typedef struct JoxStill {
    double since, until; /* s */
    JoxV2 at;            /* m: where most of them were */
    uint32_t people;     /* the most at a time */
} JoxStill;
const JoxStill *jox_run_stood_still(const JoScene *scene);
/* People who are kept from a place that they go to, all by the same thing. */
typedef struct JoxKept {
    uint32_t place, people;
    uint32_t *groups; /* of these, by group */
    JoxHindrance why; /* of the first of them */
    double since;     /* s: NAN unless a gate or a body that moves keeps them */
    bool stands;      /* nothing in the scene, its events and inputs takes it away */
} JoxKept;
enum { JOX_MOST_KEPT = 16 };
typedef struct JoxKeptList {
    JoxKept items[JOX_MOST_KEPT];
    uint32_t count;
} JoxKeptList;
/* Now, of places of which that was seen while the run went on; good until the next step. NULL:
   nobody looked. */
const JoxKeptList *jox_run_kept(const JoScene *scene);
/* results/kept.c: sentences of the last lines, of those whom a gate or a body that moves keeps;
   adds
   ,"kept": [{from, cause, by, people, since_s}] to a summary, where somebody is kept. */
void jox_run_say_kept(const JoScene *scene, JoxText *out);
void jox_run_add_kept(const JoScene *scene, JoxJson *json);
/* probes.c: the same for probes. The n-th, or NULL behind the last. */
void jox_run_collect_probes(JoScene *scene);
const JoxProbe *jox_run_probe(const JoScene *scene, uint32_t n);
/* Adds ,"probes": {...} to a summary. */
void jox_run_add_probes(const JoScene *scene, JoxJson *json);
/* results/demand.c: people who were due by a source so far, and of these those who came, who wait
   for room, and who did not come before the source ended; adds ,"sources": {...} to a summary,
   where there are some; the sentences of the last lines, of sources at which people are missing. */
typedef struct JoxDemand {
    double due, came, waiting, did_not_come;
} JoxDemand;
JoxDemand jox_run_demand(const JoScene *scene, uint32_t source);
void jox_run_add_demand(const JoScene *scene, JoxJson *json);
void jox_run_say_demand(const JoScene *scene, JoxText *out);
/* The same of people who begin at given times and wait, as others stand there: adds
   ,"starts_waiting": N where people begin after 0 s. */
void jox_run_add_starts(const JoScene *scene, JoxJson *json);
void jox_run_say_starts(const JoScene *scene, JoxText *out);
/* tally.c: a tally now, NAN where nobody has what is taken; adds ,"tally": {...} to a summary; the
   sentence of the last lines; warns of names that no behaviour has. */
double jox_run_tally(const JoScene *scene, const JoxTally *tally);
void jox_run_add_tally(const JoScene *scene, JoxJson *json);
void jox_run_say_tally(const JoScene *scene, JoxText *out);
void jox_run_check_tally(const JoScene *scene, JoxDiagnostics *diagnostics);

#endif
