/* Commands and their options. A command is one file, which defines a CliCommand, and one row of
   CLI_COMMANDS. Parsing, `--help` and the manual page are made of the same rows. */
#ifndef JOX_CLI_CLI_H
#define JOX_CLI_CLI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/format/path.h"
#include "base/overlay.h"
#include "base/text.h"
#include "jostle_tools.h"

/* In the order of `jostle --help`. */
#define CLI_COMMANDS(X)                                                                            \
    X(run)                                                                                         \
    X(resume)                                                                                      \
    X(sweep)                                                                                       \
    X(compare)                                                                                     \
    X(report)                                                                                      \
    X(render)                                                                                      \
    X(view)                                                                                        \
    X(check)                                                                                       \
    X(migrate)                                                                                     \
    X(test)                                                                                        \
    X(new)                                                                                         \
    X(mod)                                                                                         \
    X(reference)                                                                                   \
    X(reproduce)                                                                                   \
    X(bench)

/* What an option is stored as: chosen by CLI_TO from the type of its member. */
typedef enum {
    CLI_HEADING, /* a line between options, no option */
    CLI_FLAG,    /* bool */
    CLI_TEXT,    /* const char * */
    CLI_LIST,    /* CliList: may be given several times */
    CLI_DOUBLE,
    CLI_INT,
    CLI_U32,
    CLI_U64,
    CLI_READ /* read by a function of the command */
} CliKind;

/* Texts in the order given; `items` is made by cli_parse, freed by cli_free. */
typedef struct CliList {
    const char **items;
    size_t count;
} CliList;

typedef struct CliOption {
    const char *name;     /* without dashes; of a heading: the line */
    const char *argument; /* its name in the help; NULL of a flag */
    const char *help;     /* NULL: another spelling, which the help leaves out */
    const char *standard; /* default, as the help says it; NULL: none is said */
    CliKind kind;
    const char *writes; /* "folder", or endings of the file that it names, the usual one first */
    bool only_equals;   /* a value is given by '=' or not at all, as in --view=8730 */
    size_t at, given;   /* of the member, and 1 + that of a bool: whether it was given; 0: none */
    double least, greatest; /* of numbers; both 0: any */
    /* Of CLI_READ: stores a value in the command's options; false with what is wrong in `why`. */
    bool (*read)(void *options, const char *text, char why[160]);
} CliOption;

/* Destination of a row: a member of the command's options. */
#define CLI_TO(type, member)                                                                       \
    .kind = _Generic(((type *)0)->member, bool                                                     \
                     : CLI_FLAG, const char *                                                      \
                     : CLI_TEXT, double                                                            \
                     : CLI_DOUBLE, int                                                             \
                     : CLI_INT, uint32_t                                                           \
                     : CLI_U32, uint64_t                                                           \
                     : CLI_U64, CliList                                                            \
                     : CLI_LIST),                                                                  \
    .at = offsetof(type, member)
#define CLI_GIVEN(type, member) .given = 1 + offsetof(type, member)
#define CLI_RANGE(from, to) .least = (from), .greatest = (to)

typedef struct CliCommand {
    const char *name;
    const char *what;  /* one line of `jostle --help` */
    const char *usage; /* what follows "jostle NAME", a line each way to call it */
    /* Paragraphs before and after the options, a line each; lines that begin with a blank are
       printed as they are. May be NULL. */
    const char *about, *notes;
    const CliOption *options;
    size_t option_count;
    const char *takes;     /* name of its plain arguments in messages; NULL: it takes none */
    size_t least, most;    /* how many of them; most 0: any number */
    const char *none_said; /* what is said where none is given; NULL: "no TAKES given" */
    int (*run)(int argc, char **argv); /* returns an exit status, a JoCode */
} CliCommand;

#define X(name) extern const CliCommand cli_##name;
CLI_COMMANDS(X)
#undef X
extern const CliCommand *const cli_commands[];
extern const size_t cli_command_count;

enum { CLI_GO_ON = -1 };

/* Reads arguments: options into `options`, the rest into `plain`. Returns CLI_GO_ON, or the exit
   status: the help was printed, or what is wrong. cli_free is due in any case. */
int cli_parse(const CliCommand *command, int argc, char **argv, void *options, CliList *plain);
void cli_free(const CliCommand *command, void *options, CliList *plain);

/* From here on SIGINT, SIGTERM and SIGHUP end the process at once, or, once it has files to finish,
   leave their number in cli_signal the first time. SIGHUP stays ignored where it is (nohup). */
void cli_catch_signals(bool has_files);
extern volatile int cli_signal;
/* As the first of them, by another one; false where the command has no files to finish. */
bool cli_end_soon(int number);
/* The exit status of a command that a signal ended: 128 and its number, as shells have it;
   JO_FAILED where it took all of its processor time, or its address could not be printed. */
int cli_interrupted(int status);

/* Whether all that was printed has been written to standard output, or it is text to read and its
   reader closed the pipe, as `head` does. If not, the program ends with JO_FAILED and a message,
   for which the first errno is kept. */
bool cli_flush(void);
/* What is printed is data, such as a summary: a closed pipe is an error, too. */
void cli_output_is_data(void);
extern int cli_output_errno;
/* Prints the address of a page that can be opened now (a JoMessage). Where it cannot be written,
   serving ends, by cli_signal. */
void cli_print_address(void *context, const char *address);

/* Files and folders that a run wrote, and its last lines name; NULL: none such. */
typedef struct CliRunFiles {
    const char *report, *data, *record, *log, *checkpoints, *summary;
} CliRunFiles;
/* Finishes a run whose steps went well (`ok`) or ended with an error, which it prints; takes out of
   its files what could not be finished; returns the exit status. */
int cli_end(const CliCommand *command, JoScene *scene, bool ok, JoError *error, CliRunFiles *files);
/* What each plain Lua function of the run's behaviours cost, to stderr. */
void cli_profile(const JoScene *scene);
/* The last lines of a run: what it comes to, and where its files are. */
void cli_closing(const JoScene *scene, const CliRunFiles *files);

/* The page of a run that ended, in the folder of its report. */
typedef struct CliReportPage {
    const char *folder;
    const JoSceneDef *def;
    const JoxOverlay *files; /* that were vetted; NULL: those of the scene */
    JoScene *scene;
    uint64_t steps; /* in all */
    bool no_half, quiet;
} CliReportPage;
int cli_report_page(const CliCommand *command, const CliReportPage *page);

/* The page of a sweep's file of one variant: of runs with many seeds. */
int cli_runs_page(const CliCommand *command, const char *runs, const char *folder, bool quiet);
/* Whether a file is one of `jostle sweep`. */
bool cli_is_sweep(const char *path);
/* Makes a folder, and those above it; false with a message. */
bool cli_make_folder(const CliCommand *command, const char *path);

/* Whether functions of behaviours failed, people were lost, or walls keep some from their goal,
   which it says. */
bool cli_troubled(const CliCommand *command, const JoScene *scene);

/* Prints "jostle COMMAND: why" and where help is found; returns JO_USAGE. */
int cli_misused(const CliCommand *command, const char *why);
/* Says that there is no such thing, as "page 'behavior'", and which of the names may be meant;
   returns JO_USAGE. */
int cli_unknown(const CliCommand *command, const char *what, const char *given,
                const char *const *names, size_t count);
/* Whether a path that an option names to be written does not end as another kind of file does, as
   x.html for a folder or x.csv for JSON; what is there already is judged later. */
bool cli_ending_fits(const CliOption *option, const char *path, char why[200]);
/* Whether a file can be written, found out before an hour of simulation; JO_FAILED with a message.
 */
int cli_writable(const CliCommand *command, const char *path);
/* Whether no two outputs are one file, and none is one that is read: of `inputs`, or `files`, which
   may be NULL. JO_USAGE with a message. Of outputs NULL and "-" are none, of inputs NULL. */
int cli_apart(const CliCommand *command, const char *const *outputs, size_t output_count,
              const char *const *inputs, size_t input_count, const JoxOverlay *files);
/* Writes text to a file, or to standard output for "-"; JO_FAILED with a message. */
int cli_write(const CliCommand *command, const char *path, const char *text);
/* Prints text to the FILE that `context` is: where jo_check and jo_test send theirs. */
void cli_print(void *context, const char *text);
/* Prints an error unless it was sent as a message before; returns the exit status. */
int cli_failed(const CliCommand *command, const JoError *error, bool sent);

/* Has a scene read by a child process that may do nothing else; `files` are then what it read, and
   sealed: to be loaded from (jox_overlay_use). JO_OK, or the exit status, with a message. */
int cli_vet(const CliCommand *command, const JoSceneDef *def, JoxOverlay *files, JoError *error);

/* ---- files of others, read in a confined child ---- */

/* What goes through pipes: a head, then so many bytes of a name and of a text. */
typedef enum CliSent {
    CLI_FILE,    /* its path, and its text */
    CLI_MESSAGE, /* for people */
    CLI_LOADED,  /* the end, and the two below: */
    CLI_REFUSED,
    CLI_OUT_OF_MEMORY,
    CLI_ENDED, /* of the keeper: at which file, and why */
    CLI_WHOLE, /* to the keeper: the scene is to be read; behaviours by their paths, in the text; */
    CLI_EDITED,
    CLI_STOP, /* what is under way is no longer wanted */
    CLI_SENT_COUNT
} CliSent;
typedef struct CliHead {
    uint32_t kind;
    uint64_t name, text;
} CliHead;

/* False where nobody reads any more. */
bool cli_send(int out, CliSent kind, const char *name, const char *text, size_t length);

/* Where it comes from; zero-initialise but for `stop`. */
typedef struct CliSource {
    int from, stop;    /* reading ends, too, once `stop` can be read; -1: it never can */
    double until;      /* s of the monotonic clock, when it ends, too; 0: never */
    size_t taken;      /* bytes; there is a limit */
    const char *fault; /* why it was given up before its end; NULL: it was not */
} CliSource;
typedef struct CliGot {
    char name[JOX_LONGEST_PATH];
    char *text; /* with a zero byte behind it */
    size_t length;
} CliGot;
/* A CliSent, with what came; -1 at the end, and for what is none. */
int cli_get(CliSource *source, CliGot *got);
void cli_got_free(CliGot *got);

/* What a child is to read, and what it did. */
typedef struct CliVetted {
    const JoSceneDef *def;       /* the scene, unless */
    const JoVetting *edited;     /* files of it were edited, or NULL; then */
    JoScene *scene;              /* it is there as it was, dry */
    int stop;                    /* as of CliSource */
    JoxOverlay *files;           /* that it read, sealed at the end */
    JoxText said, why;           /* messages; why it was ended, */
    char file[JOX_LONGEST_PATH]; /* and where */
} CliVetted;
/* CLI_LOADED, CLI_REFUSED, -1 where the child was ended, or -2 where there is no process for it. */
int cli_read_confined(CliVetted *what);

/* Another process, begun while this one has a single thread, that has files read in children of its
   own while the scene runs: at first of the scene that was loaded from `files`. NULL: it could not
   begin, which was said. */
typedef struct CliKeeper CliKeeper;
CliKeeper *cli_keeper_begin(const CliCommand *command, const JoSceneDef *def,
                            const JoxOverlay *files);
/* NULL of NULL. */
const JoVetter *cli_keeper_vetter(const CliKeeper *keeper);
void cli_keeper_end(CliKeeper *keeper);

/* The file of a scene: what is given, or, of a name alone such as "office", the first there is of
   NAME.yaml, scenes/NAME.yaml and that of the scenes that came with Jostle; or scenes/NAME.yaml of
   one of the `mods` named, which may be NULL. Holds until cli_free. NULL with a message, and what
   may be meant, where there is no such file or there are several. */
const char *cli_scene(const CliCommand *command, const char *given, const CliList *mods);
/* The same of each in the list that is no file and no folder. */
bool cli_scenes(const CliCommand *command, CliList *list);
void cli_scenes_free(void);
/* Whether there is such a scene by its name alone. */
bool cli_is_scene(const char *name);
/* The folder of a mod that is named by it, or by its name where it lies in mods/, scenes/mods/ or
   the user's data directory. Holds until cli_free; NULL where there is none. */
const char *cli_mod_folder(const char *mod);
/* Whether there is such a file or folder, or recording; else says what may be meant. */
bool cli_is_there(const CliCommand *command, const char *given);
bool cli_recording(const CliCommand *command, const char *given);
/* Some of those that came with Jostle, a line each. */
void cli_list_scenes(FILE *out);

/* What a command may do once it reads files of others. Zero-initialise. */
typedef struct CliPaths {
    char **items;
    size_t count, capacity;
} CliPaths;
typedef struct CliReach {
    CliPaths reads, writes;   /* besides what libraries of the system and mods need */
    size_t memory, file_size; /* bytes, and below seconds of processor time; 0: any */
    unsigned seconds, files;
    bool works, programs, serves; /* as of JoxConfines */
    const char *program;          /* the same; or NULL */
} CliReach;

/* A path may be read: a recording, with what SQLite keeps beside it; a folder or a file; a scene or
   behaviour, or folder of them, with what lies in its folder and in ../behaviours; a scene with its
   mods and input log. Of NULL, nothing. */
void cli_reach_file(CliReach *reach, const char *path);
void cli_reach_folder(CliReach *reach, const char *path);
void cli_reach_scene(CliReach *reach, const char *path);
void cli_reach_def(CliReach *reach, const JoSceneDef *def);
/* A folder, or the folder of a file, may be written. Of NULL and "-", nothing. */
void cli_reach_output(CliReach *reach, const char *path);
/* The list of mods that are on may be written. */
void cli_reach_settings(CliReach *reach);
/* From here on the process, which is to have one thread, can do no more; the paths are freed. Where
   the system cannot hold it to that, that is said. */
bool cli_confine(CliReach *reach);
/* Of commands that read and do not simulate for long: what they may take. */
#define CLI_READING .memory = (size_t)4 << 30, .seconds = 300
/* As cli_confine, of a whole command; nothing where the user trusts the files. Without limits of
   its own it may take three quarters of the machine's memory, a day of each of its processors,
   files of 256 GB, and 1,024 of them at a time. */
void cli_confine_work(CliReach *reach, bool trusted);
/* Those limits alone, of commands that have scenes read by children; what these read is limited
   further, and the processes that a command starts have its limits each. */
void cli_limit_work(bool trusted);

/* Appends `length` bytes as lines of 80 columns; the first begins at column `at`, the others with
   `indent` blanks. */
void cli_wrap(JoxText *out, const char *text, size_t length, int at, int indent);
/* The help of a command, and the manual page of all. Freed by jo_free. */
char *cli_help(const CliCommand *command);
char *cli_manual(void);

/* ---- options that several commands have ---- */

/* "m" or "cm": metres of a unit. For a row of CLI_READ. */
bool cli_unit(double *metres, const char *text, char why[160]);

/* An instruction set that this machine runs; and its row, whose function calls this. */
bool cli_isa(JoIsa *isa, const char *text, char why[160]);
#define CLI_ISA_OPTION(function)                                                                   \
    {                                                                                              \
        "isa", "NAME",                                                                             \
            "instruction set of the kernels: scalar, sse2, avx2, avx512 or neon; never changes "   \
            "a result",                                                                            \
            "the widest that the machine runs", .kind = CLI_READ, .read = function                 \
    }

/* Of commands that cli_confine_work confines. */
#define CLI_TRUSTED_OPTION(type)                                                                   \
    {                                                                                              \
        "trusted", NULL,                                                                           \
            "the files are one's own: whatever they name is read. Else the command reads the "     \
            "folders of what it is given, ../behaviours and mods alone, writes to its output's "   \
            "folder alone and connects to nothing",                                                \
            CLI_TO(type, trusted)                                                                  \
    }

/* Of a scene: `def` is a member JoSceneDef; the options have CliLists `sets` and `mods`, and a bool
   `of_scene`: whether one of these rows was given (seed and dt: see def.has_seed, def.has_dt). */
#define CLI_SCENE_OPTIONS(type, def)                                                               \
    {"dt",                                                                                         \
     "S",                                                                                          \
     "time step, s (0.001 to 0.2)",                                                                \
     CLI_TO(type, def.dt),                                                                         \
     CLI_GIVEN(type, def.has_dt),                                                                  \
     CLI_RANGE(0.001, 0.2)},                                                                       \
        {"seed", "N", "seed of all random numbers", CLI_TO(type, def.seed),                        \
         CLI_GIVEN(type, def.has_seed)},                                                           \
        {"threads",                                                                                \
         "N",                                                                                      \
         "threads; never changes a result",                                                        \
         "all processors",                                                                         \
         CLI_TO(type, def.threads),                                                                \
         CLI_GIVEN(type, of_scene),                                                                \
         CLI_RANGE(1, 64)},                                                                        \
        {"set", "PATH=VALUE", "replace a value of the scene, as groups.pilgrims.count=5000",       \
         CLI_TO(type, sets), CLI_GIVEN(type, of_scene)},                                           \
        {"input", "FILE", "play an input log: what people did, and files that were reloaded",      \
         CLI_TO(type, def.input_log), CLI_GIVEN(type, of_scene)},                                  \
        CLI_MOD_OPTIONS(type, def)
#define CLI_MOD_OPTIONS(type, def)                                                                 \
    {"mod", "DIR",                                                                                 \
     "take a mod: a folder, or the name of one that lies in the scene's mods/ or in the user's "   \
     "data directory ($XDG_DATA_HOME/jostle/mods); may be given several times. Others are off, "   \
     "but those that `jostle mod enable` turned on, and what a mod depends on must be on or "      \
     "named, too",                                                                                 \
     CLI_TO(type, mods), CLI_GIVEN(type, of_scene)},                                               \
    {                                                                                              \
        "no-mods", NULL, "take no mods but those given by --mod or named by the scene",            \
            CLI_TO(type, def.named_mods_only), CLI_GIVEN(type, of_scene)                           \
    }

#endif
