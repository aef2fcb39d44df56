/* Commands and their options. A command is one file, which defines a CliCommand, and one row of
   CLI_COMMANDS. Parsing, `--help` and the manual page are made from the same rows. main.c calls a
   command's `run`; the calls below are what commands share. */
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

/* All commands, in the order of `jostle --help`. */
#define CLI_COMMANDS(X)                                                                            \
    X(run)                                                                                         \
    X(resume)                                                                                      \
    X(why)                                                                                         \
    X(sweep)                                                                                       \
    X(compare)                                                                                     \
    X(report)                                                                                      \
    X(render)                                                                                      \
    X(view)                                                                                        \
    X(check)                                                                                       \
    X(graph)                                                                                       \
    X(test)                                                                                        \
    X(new)                                                                                         \
    X(mod)                                                                                         \
    X(reference)                                                                                   \
    X(reproduce)                                                                                   \
    X(bench)

/* The type that an option is stored as; CLI_TO derives it from the type of the member. */
typedef enum {
    CLI_HEADING, /* no option: a heading between options in the help */
    CLI_FLAG,    /* bool */
    CLI_TEXT,    /* const char * */
    CLI_LIST,    /* CliList: the option may be given several times */
    CLI_DOUBLE,
    CLI_INT,
    CLI_U32,
    CLI_U64,
    CLI_READ /* any type: stored by a function of the command */
} CliKind;

/* Texts in the order given. cli_parse allocates `items`, cli_free frees it. */
typedef struct CliList {
    const char **items;
    size_t count;
} CliList;

typedef struct CliOption {
    const char *name;     /* without dashes; of CLI_HEADING: the heading */
    const char *argument; /* name of its value in the help; NULL: a flag */
    const char *help;     /* NULL: an alternative spelling, not listed */
    const char *standard; /* default, as the help shows it; NULL: not shown */
    CliKind kind;
    const char
        *writes; /* output options: "folder", or allowed endings of a file, the usual one first */
    bool only_equals; /* a value is optional and follows '=', as in --view=8730 */
    size_t at, given; /* offset of the member; 1 + offset of a bool that is set if the option is
                         given, 0: none */
    double least, greatest; /* bounds of a number; both 0: none */
    /* Parses `text` into the command's options, for CLI_READ; false with the fault in `why`. */
    bool (*read)(void *options, const char *text, char why[160]);
} CliOption;

/* Sets kind and destination of a row: a member of the command's options. */
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
    const char *what;  /* its line in `jostle --help` */
    const char *usage; /* arguments after "jostle NAME"; one line per form of the command */
    /* Paragraphs before and after the options, one a line; lines that begin with a blank are
       printed as they are. May be NULL. */
    const char *about, *notes;
    const CliOption *options;
    size_t option_count;
    const char *takes;     /* name of its plain arguments in messages; NULL: takes none */
    size_t least, most;    /* number of plain arguments; most 0: any */
    const char *none_said; /* message if too few are given; NULL: "no TAKES given" */
    int (*run)(int argc, char **argv); /* returns an exit status, mostly a JoCode */
} CliCommand;

#define X(name) extern const CliCommand cli_##name;
CLI_COMMANDS(X)
#undef X
extern const CliCommand *const cli_commands[];
extern const size_t cli_command_count;

enum { CLI_GO_ON = -1 };

/* Parses arguments: options into `options`, plain ones into `plain`. Returns CLI_GO_ON, or the exit
   status if the help was printed or the arguments are wrong. Call cli_free in any case. */
int cli_parse(const CliCommand *command, int argc, char **argv, void *options, CliList *plain);
void cli_free(const CliCommand *command, void *options, CliList *plain);

/* Installs handlers of SIGINT, SIGTERM and SIGHUP. Without files to finish, they end the process at
   once. With files, the first one stores its number in cli_signal, which the command polls; the
   second one ends the process. SIGHUP stays ignored if it is ignored (nohup). */
void cli_catch_signals(bool has_files);
extern volatile int cli_signal;
/* Sets cli_signal as the first signal does, for other reasons to end; returns false if the command
   has no files to finish. */
bool cli_request_end(int number);
/* Returns the exit status of a command that may have been ended by a signal: 128 + its number, as
   shells have it; JO_FAILED if it was out of processor time or could not print its address;
   `status` if that is an error or no signal came. */
int cli_add_signal_status(int status);

/* Flushes standard output. Returns true if all was written, or if text for people goes to a pipe
   whose reader closed it, as `head` does. If false, the first errno is kept in cli_output_errno,
   and main ends the program with a message and JO_FAILED. */
bool cli_flush(void);
/* Declares the output as data, such as a summary: a closed pipe is then an error, too. */
void cli_output_is_data(void);
extern int cli_output_errno;
/* Prints the address of a page that can be opened now (a JoMessage). If that fails, sets
   cli_signal, as nobody could open or end the page. */
void cli_print_address(void *context, const char *address);

/* Files and folders that a run wrote, for its last lines; NULL: not written. */
typedef struct CliRunFiles {
    const char *report, *data, *record, *log, *checkpoints, *summary;
} CliRunFiles;
/* Files that a run on the live page and its restarts wrote, for the last lines. */
typedef struct CliPageFiles {
    struct CliPageFile {
        const char *what;
        char *path;
    } * items;
    size_t count, capacity;
} CliPageFiles;
/* Adds a file, unless `path` is NULL, and returns the copy of its path. */
const char *cli_add_page_file(CliPageFiles *files, const char *what, const char *path);
/* Prints the files that are there, unless `quiet`, to stderr, and frees the list. */
void cli_print_page_files(CliPageFiles *files, bool quiet);
/* Finishes the files of a run whose steps went well (`ok`) or ended with `error`, and prints the
   error. Removes from `files` what could not be finished; returns the exit status. */
int cli_finish_run(const CliCommand *command, JoScene *scene, bool ok, JoError *error,
                   CliRunFiles *files);
/* Prints the cost of each plain Lua function of the run's behaviours to stderr. */
void cli_print_lua_costs(const JoScene *scene);
/* Prints the last lines of a run to stderr: its results in sentences, its files, and hints on
   behaviours. */
void cli_print_closing(const JoScene *scene, const CliRunFiles *files);

/* The arguments of cli_write_report_page, which writes the page of a run that ended into the folder
   of its report, after a second run at half the time step. */
typedef struct CliReportPage {
    const char *folder;
    const JoSceneDef *def;
    const JoxOverlay *files; /* vetted files; NULL: read those of the scene again */
    JoScene *scene;
    uint64_t steps; /* steps of the whole run */
    bool no_half, quiet;
} CliReportPage;
int cli_write_report_page(const CliCommand *command, const CliReportPage *page);

/* Writes the page of runs with many seeds from a sweep's file of one variant; returns the exit
   status. */
int cli_write_runs_page(const CliCommand *command, const char *runs, const char *folder,
                        const JoReportHead *head, bool quiet);
/* Returns whether a file was written by `jostle sweep`. */
bool cli_is_sweep(const char *path);
/* Makes a folder and its parents; false with a message. */
bool cli_make_folder(const CliCommand *command, const char *path);

/* Prints the troubles of a run: failed functions of behaviours, lost people, people whom walls keep
   from their goal. Returns whether there are any. */
bool cli_print_troubles(const CliCommand *command, const JoScene *scene);

/* Prints "jostle COMMAND: why" and how to get help; returns JO_USAGE. */
int cli_report_misuse(const CliCommand *command, const char *why);
/* Prints that there is no such thing, as "page 'behavior'", with the most similar of `names`;
   returns JO_USAGE. */
int cli_report_unknown(const CliCommand *command, const char *what, const char *given,
                       const char *const *names, size_t count);
/* Returns whether the ending of an output's path fits what the option writes: not x.html for a
   folder, nor x.csv for JSON. Accepts files that exist and may be sources; cli_check_apart refuses
   those that are read. */
bool cli_ending_fits(const CliOption *option, const char *path, char why[200]);
/* Checks before a long simulation that a file can be written at its end; JO_FAILED with a
   message. */
int cli_check_writable(const CliCommand *command, const char *path);
/* Checks that no two outputs are the same file, and that no output is one of `inputs` or `files`
   (may be NULL); JO_USAGE with a message. Outputs NULL and "-" and inputs NULL are skipped. */
int cli_check_apart(const CliCommand *command, const char *const *outputs, size_t output_count,
                    const char *const *inputs, size_t input_count, const JoxOverlay *files);
/* Writes text to a file, or to standard output for "-"; JO_FAILED with a message. */
int cli_write(const CliCommand *command, const char *path, const char *text);
/* Prints text to the FILE `context`; a JoMessage for jo_check and jo_test. */
void cli_print(void *context, const char *text);
/* Prints an error, unless it was already sent as a message; returns the exit status. */
int cli_report_error(const CliCommand *command, const JoError *error, bool sent);

/* Reads a scene in a confined child process, and seals the files that it read in `files`; the
   caller then loads the scene from these (jox_overlay_use). Returns JO_OK, or the exit status with
   a message. */
int cli_vet(const CliCommand *command, const JoSceneDef *def, JoxOverlay *files, JoError *error);

/* ---- files of others, read in a confined child ---- */

/* The kinds of messages between a process and a confined child or the keeper: a CliHead, then the
   bytes of a name and of a text. */
typedef enum CliSent {
    CLI_FILE,    /* a file that was read: its path and its text */
    CLI_MESSAGE, /* a message for people */
    CLI_LOADED,  /* the last message of a child: one of these three */
    CLI_REFUSED,
    CLI_OUT_OF_MEMORY,
    CLI_ENDED,  /* from the keeper: the child was ended, at which file and why */
    CLI_WHOLE,  /* to the keeper: read the whole scene */
    CLI_EDITED, /* to the keeper: read edited files. Name: not empty if the scene's file is one of
                   them; text: paths of behaviours, each zero-terminated */
    CLI_STOP,   /* to the keeper: give up the present request */
    CLI_SENT_COUNT
} CliSent;
typedef struct CliHead {
    uint32_t kind;       /* CliSent */
    uint64_t name, text; /* bytes */
} CliHead;

/* Sends a message; false if the other end is closed. */
bool cli_send(int out, CliSent kind, const char *name, const char *text, size_t length);

/* The receiving end of such messages; zero-initialise all but `stop`. */
typedef struct CliSource {
    int from, stop;    /* descriptors: messages come from `from`; reading is given up once `stop` is
                          readable, -1: never */
    double until;      /* s of jox_clock_wall at which reading is given up; 0: never */
    size_t taken;      /* bytes received so far; limited */
    const char *fault; /* why reading was given up; NULL: it was not */
} CliSource;
typedef struct CliReceived {
    char name[JOX_LONGEST_PATH];
    char *text; /* zero-terminated */
    size_t length;
} CliReceived;
/* Receives a message, to be freed by cli_free_received. Returns its CliSent; -1 at the end, or if
   the message is malformed or too large. */
int cli_receive(CliSource *source, CliReceived *got);
void cli_free_received(CliReceived *got);

/* A request to read files in a confined child, and its result. */
typedef struct CliVetted {
    const JoSceneDef *def;       /* the scene to read, unless `edited` */
    const JoVetting *edited;     /* its edited files, or NULL */
    JoScene *scene;              /* with `edited`: the scene before, loaded dry */
    int stop;                    /* as in CliSource */
    JoxOverlay *files;           /* result: files that the child read, sealed */
    JoxText said, why;           /* result: messages; why the child was ended, */
    char file[JOX_LONGEST_PATH]; /* and at which file */
} CliVetted;
/* Reads in a child. Returns CLI_LOADED or CLI_REFUSED; -1 if the child was ended; -2 if no process
   could be started. */
int cli_read_confined(CliVetted *what);

/* Starts the keeper: a process forked while this one has a single thread. While the scene runs with
   threads, the keeper forks the children that read edited files. It begins with the scene that was
   loaded from `files`. NULL, with a message, if it cannot be started. */
typedef struct CliKeeper CliKeeper;
CliKeeper *cli_keeper_begin(const CliCommand *command, const JoSceneDef *def,
                            const JoxOverlay *files);
/* Returns the JoVetter that asks the keeper; NULL for a NULL keeper. */
const JoVetter *cli_keeper_vetter(const CliKeeper *keeper);
void cli_keeper_end(CliKeeper *keeper);

/* Finds the file of a scene. `given` is a path, or a name alone such as "office": then the first of
   NAME.yaml, scenes/NAME.yaml and the scenes that came with Jostle, or scenes/NAME.yaml of one of
   `mods` (may be NULL). The result is valid until cli_free. NULL, with a message that suggests
   similar names, if there is none or there are several. */
const char *cli_scene(const CliCommand *command, const char *given, const CliList *mods);
/* Replaces each name in the list that is no file or folder by the file of the scene; false with a
   message. */
bool cli_scenes(const CliCommand *command, CliList *list);
void cli_scenes_free(void);
/* Returns whether there is a scene with this name. */
bool cli_is_scene(const char *name);
/* Finds the folder of a mod, given as a folder or by its name in mods/, scenes/mods/ or the user's
   data directory. The result is valid until cli_free; NULL if there is none. */
const char *cli_mod_folder(const char *mod);
/* Check that a file or folder, or a recording exists; false with a message that suggests similar
   names. */
bool cli_check_exists(const CliCommand *command, const char *given);
bool cli_check_recording(const CliCommand *command, const char *given);
/* Prints some scenes that came with Jostle, one a line. */
void cli_list_scenes(FILE *out);

/* Lists of paths, and what a command may still do when it reads files of unknown origin.
   Zero-initialise. The command fills it by cli_reach_*, then calls cli_confine or
   cli_confine_work. */
typedef struct CliPaths {
    char **items;
    size_t count, capacity;
} CliPaths;
typedef struct CliReach {
    CliPaths reads, writes;       /* besides those that system libraries and mods need */
    size_t memory, file_size;     /* bytes; 0: no limit, as below */
    unsigned seconds, files;      /* s of processor time; open files */
    bool works, programs, serves; /* as in JoxConfines */
    const char *program;          /* as in JoxConfines; or NULL */
} CliReach;

/* Allow reading. file: a recording, with the files that SQLite keeps beside it. folder: a folder or
   a file. scene: a scene or behaviour, or a folder of them, with their folder, ../behaviours and
   ../scripts. def: a scene with its mods and input log. NULL is ignored. */
void cli_reach_file(CliReach *reach, const char *path);
void cli_reach_folder(CliReach *reach, const char *path);
void cli_reach_scene(CliReach *reach, const char *path);
void cli_reach_def(CliReach *reach, const JoSceneDef *def);
/* Allows writing a folder, or a file and its folder. NULL and "-" are ignored. */
void cli_reach_output(CliReach *reach, const char *path);
/* Allows writing the user's list of mods that are turned on. */
void cli_reach_settings(CliReach *reach);
/* Confines the process, which must have a single thread, to what `reach` allows, and frees its
   paths. Prints a message and returns false if the system supports no confinement. */
bool cli_confine(CliReach *reach);
/* Limits of memory and time for commands that read and do not simulate for long. */
#define CLI_READING .memory = (size_t)4 << 30, .seconds = 300
/* Confines a whole command as cli_confine does, or not at all if the user trusts the files. Limits
   that `reach` leaves open become three quarters of the machine's memory, a day of each of its
   processors, files of 256 GB, and 1,024 open files. */
void cli_confine_work(CliReach *reach, bool trusted);
/* Sets only these limits, for commands whose scenes are read by confined children. Processes that
   the command starts have the same limits each. */
void cli_limit_work(bool trusted);

/* Appends `length` bytes, broken into lines of 80 columns; the first line begins at column `at`,
   the others are indented by `indent` blanks. */
void cli_wrap_text(JoxText *out, const char *text, size_t length, int at, int indent);
/* Format the help of a command, and the manual page of all commands; to be freed by jo_free. */
char *cli_format_help(const CliCommand *command);
char *cli_format_manual(void);

/* ---- options that several commands share ---- */

/* Parses "m" or "cm" into metres, for a row of CLI_READ; false with the fault in `why`. */
bool cli_read_unit(double *metres, const char *text, char why[160]);

/* Parses an instruction set that this machine runs, for the row CLI_ISA_OPTION; false with the
   fault in `why`. */
bool cli_read_isa(JoIsa *isa, const char *text, char why[160]);
#define CLI_ISA_OPTION(function)                                                                   \
    {                                                                                              \
        "isa", "NAME",                                                                             \
            "instruction set of the kernels: scalar, sse2, avx2, avx512 or neon; results never "   \
            "depend on it",                                                                        \
            "the widest that the machine runs", .kind = CLI_READ, .read = function                 \
    }

/* The option of commands that call cli_confine_work. */
#define CLI_TRUSTED_OPTION(type)                                                                   \
    {                                                                                              \
        "trusted", NULL,                                                                           \
            "trust the files: read whatever they name. Without it the command reads only the "     \
            "folders of its arguments, ../behaviours and mods, writes only to the folder of its "  \
            "output, and connects to nothing",                                                     \
            CLI_TO(type, trusted)                                                                  \
    }

/* The options of a scene: `def` is a member JoSceneDef. The options also have CliLists `sets` and
   `mods`, and a bool `of_scene` that is set if one of these rows is given (except seed and dt: see
   def.has_seed, def.has_dt). */
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
         "number of threads; results never depend on it",                                          \
         "all processors",                                                                         \
         CLI_TO(type, def.threads),                                                                \
         CLI_GIVEN(type, of_scene),                                                                \
         CLI_RANGE(1, 64)},                                                                        \
        {"set", "PATH=VALUE", "replace a value of the scene, such as groups.pilgrims.count=5000",  \
         CLI_TO(type, sets), CLI_GIVEN(type, of_scene)},                                           \
        {"input", "FILE", "replay an input log: commands of people, and reloaded files",           \
         CLI_TO(type, def.input_log), CLI_GIVEN(type, of_scene)},                                  \
        CLI_MOD_OPTIONS(type, def)
#define CLI_MOD_OPTIONS(type, def)                                                                 \
    {"mod", "DIR",                                                                                 \
     "use a mod: a folder or zip archive, or the name of one in the scene's mods/ or the user's "  \
     "data "                                                                                       \
     "directory ($XDG_DATA_HOME/jostle/mods); may be given several times. Other mods are off "     \
     "unless `jostle mod enable` turned them on; mods that a mod depends on must be on or named, " \
     "too",                                                                                        \
     CLI_TO(type, mods), CLI_GIVEN(type, of_scene)},                                               \
    {                                                                                              \
        "no-mods", NULL, "use only mods given by --mod or named by the scene",                     \
            CLI_TO(type, def.named_mods_only), CLI_GIVEN(type, of_scene)                           \
    }

#endif
