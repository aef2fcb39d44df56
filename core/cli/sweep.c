/* The command `sweep`: runs the variants of a scene by jo_sweep, or merges files. sweep_list.c
   lists the runs. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/file.h"
#include "base/mem.h"
#include "cli/cli.h"
#include "cli/sweep_list.h"

typedef CliSweep Sweep;

static bool read_sweep_isa(void *options, const char *text, char why[160]) {
    return cli_read_isa(&((Sweep *)options)->def.scene.isa, text, why);
}

static const CliOption OPTIONS[] = {
    {"set", "PATH=A,B,C",
     "one variant for each of these values; given several times, one for each combination; a "
     "single value applies to all variants. A comma within brackets or quotes does not separate. "
     "Any value of the scene: groups.pilgrims.count=500,1000, walls.3.open=true,false",
     CLI_TO(Sweep, sets), CLI_GIVEN(Sweep, of_scene)},
    {"seeds", "N", "seeds of each variant", "1", CLI_TO(Sweep, seeds), CLI_GIVEN(Sweep, of_scene),
     CLI_RANGE(1, 100000)},
    {"seed", "N", "first seed", "1", CLI_TO(Sweep, def.scene.seed),
     CLI_GIVEN(Sweep, def.scene.has_seed)},
    {"out", "FILE",
     "SQLite file for figures, curves, fields, hashes and inputs of all runs. Runs that are in it "
     "are not repeated: an interrupted sweep continues, and one of more seeds or values does only "
     "what is new. A file of other inputs is refused",
     CLI_TO(Sweep, def.out), .writes = "sqlite sqlite3 db db3"},
    {"csv", "FILE", "write a table of all runs in --out; '-' is standard output",
     CLI_TO(Sweep, csv), .writes = "csv txt"},
    {"jobs", "N", "processes at once", "one for each processor that it may use",
     CLI_TO(Sweep, def.jobs), CLI_RANGE(1, 1000)},
    {"again", NULL, "repeat runs that failed", CLI_TO(Sweep, def.again)},
    {"list", NULL,
     "run nothing; print a command for each run, which writes a file of its own into a folder "
     "beside --out, for GNU parallel, Slurm and the like. Such a file appears once the run has "
     "ended, as a whole",
     CLI_TO(Sweep, list)},
    {"missing", NULL,
     "with --list: only commands of runs that neither --out nor a file of that folder has; with "
     "--again also of runs that failed",
     CLI_TO(Sweep, missing)},
    {"status", NULL,
     "run nothing; print a line for each run: its number, its state (done, troubled, failed, "
     "missing, unreadable), settings and seed, and the file of --list, separated by tabs. The exit "
     "status is 1 if a run is missing, 3 if a file cannot be read",
     CLI_TO(Sweep, status)},
    {"merge", NULL,
     "copy the runs of such files, or of all files of a folder whose names end in .sqlite, into "
     "--out. If runs of the sweep are in none of them, these are named and nothing is copied",
     CLI_TO(Sweep, merge)},
    {"partial", NULL, "with --merge: also if runs are missing", CLI_TO(Sweep, partial)},
    {"canonical", NULL,
     "at the end write --out anew in the order of its plan, without times of computation, "
     "instruction set and number of threads: the same runs give the same bytes, on one machine "
     "or many",
     CLI_TO(Sweep, canonical)},
    {"only", "N", "do only the N-th run, as a command of --list does", CLI_TO(Sweep, only),
     CLI_RANGE(1, 100000)},
    {"for", "S", "simulate S seconds", "the scene's duration", CLI_TO(Sweep, def.seconds),
     CLI_GIVEN(Sweep, has_seconds), CLI_RANGE(0, 1e7)},
    {"steps", "N", "simulate N steps instead", CLI_TO(Sweep, def.steps), CLI_RANGE(1, 1e9)},
    {"dt", "S", "time step, s (0.001 to 0.2)", CLI_TO(Sweep, def.scene.dt),
     CLI_GIVEN(Sweep, def.scene.has_dt), CLI_RANGE(0.001, 0.2)},
    {"threads", "N", "number of threads of each run; results never depend on it", "1",
     CLI_TO(Sweep, def.scene.threads), CLI_GIVEN(Sweep, of_scene), CLI_RANGE(1, 64)},
    {"input", "FILE", "replay an input log in each run", CLI_TO(Sweep, def.scene.input_log),
     CLI_GIVEN(Sweep, of_scene)},
    CLI_ISA_OPTION(read_sweep_isa),
    CLI_MOD_OPTIONS(Sweep, def.scene),
    {"trusted", NULL, "trust the scene, as for `jostle run`", CLI_TO(Sweep, trusted)},
    {"quiet", NULL, "print no progress", CLI_TO(Sweep, def.quiet)},
};

static bool vet_variant(void *context, const JoSceneDef *scene, JoError *error) {
    Sweep *sweep = context;
    return cli_vet(&cli_sweep, scene, &sweep->files, error) == JO_OK;
}

/* ---- running and merging ---- */

static void print_counts(const Sweep *sweep, const JoSweepCounts *c) {
    if (sweep->def.quiet)
        return;
    fprintf(stderr, "%s: %u %s with figures", sweep->def.out, c->done,
            c->done == 1 ? "run" : "runs");
    if (c->troubled)
        fprintf(stderr, ", %u of them did not go as written", c->troubled);
    if (c->failed)
        fprintf(stderr, ", %u failed", c->failed);
    if (c->missing)
        fprintf(stderr, ", %u missing", c->missing);
    fputs("\n", stderr);
}

/* Prints the counts and writes the CSV table; returns the exit status. */
static int finish_sweep(const Sweep *sweep, const JoSweepCounts *counts) {
    JoError error = {0};
    print_counts(sweep, counts);
    if (sweep->canonical && !jo_sweep_make_canonical(sweep->def.out, &error))
        return cli_report_error(&cli_sweep, &error, false);
    if (sweep->csv && !jo_sweep_csv(sweep->def.out, sweep->csv, &error))
        return cli_report_error(&cli_sweep, &error, false);
    return counts->failed || counts->troubled || counts->missing ? JO_FAILED : JO_OK;
}

/* Adds a file to the parts of a merge, or all files of a folder; an exit status. */
static int add_parts(const char *path, JoxText **parts, size_t *count, size_t *capacity) {
    char **names = jox_is_folder(path) ? jox_folder_names(path, false) : NULL;
    size_t before = *count;
    if (!names) {
        JOX_RESERVE(*parts, *capacity, *count + 1);
        (*parts)[*count] = (JoxText){0};
        jox_text_add(&(*parts)[(*count)++], path);
        return JO_OK;
    }
    for (size_t n = 0; names[n]; n++) {
        const size_t length = strlen(names[n]);
        if (length < 7 || strcmp(names[n] + length - 7, ".sqlite") != 0)
            continue;
        JOX_RESERVE(*parts, *capacity, *count + 1);
        (*parts)[*count] = (JoxText){0};
        jox_text_printf(&(*parts)[(*count)++], "%s/%s", path, names[n]);
    }
    jox_free(names);
    if (*count > before)
        return JO_OK;
    fprintf(stderr, "jostle sweep: the folder '%s' has no file whose name ends in .sqlite\n", path);
    return JO_INPUT;
}

static int merge_files(const Sweep *sweep, const CliList *given) {
    JoSweepCounts counts;
    JoError error = {0};
    JoxText *parts = NULL;
    size_t count = 0, capacity = 0;
    int status = JO_OK;
    for (size_t g = 0; status == JO_OK && g < given->count; g++)
        status = add_parts(given->items[g], &parts, &count, &capacity);
    const char **paths = jox_alloc(count + 1, sizeof *paths);
    for (size_t p = 0; p < count; p++)
        paths[p] = parts[p].data;
    if (status == JO_OK) {
        JoSweepMergeDef def = jo_default_sweep_merge_def();
        def.out = sweep->def.out;
        def.parts = paths;
        def.part_count = count;
        def.partial = sweep->partial;
        status = jo_sweep_merge(&def, &counts, &error)
                     ? finish_sweep(sweep, &counts)
                     : cli_report_error(&cli_sweep, &error, false);
    }
    for (size_t p = 0; p < count; p++)
        jox_text_free(&parts[p]);
    jox_free(parts);
    jox_free((void *)(uintptr_t)paths);
    return status;
}

static int run_variants(Sweep *sweep) {
    JoSweepCounts counts;
    JoError error = {0};
    cli_limit_work(sweep->trusted);
    cli_catch_signals(true);
    sweep->def.stop = &cli_signal;
    sweep->def.vet = sweep->trusted ? NULL : vet_variant;
    sweep->def.vet_context = sweep;
    const JoxOverlay *before = jox_overlay_use(&sweep->files);
    const bool good = jo_sweep(&sweep->def, &counts, NULL, &error);
    jox_overlay_use(before);
    if (cli_signal && !good) {
        cli_report_error(&cli_sweep, &error, false);
        return cli_add_signal_status(JO_OK);
    }
    return good ? finish_sweep(sweep, &counts) : cli_report_error(&cli_sweep, &error, false);
}

/* Returns which arguments exclude each other; NULL: none. */
static const char *find_sweep_misuse(const Sweep *sweep, const CliList *plain) {
    const bool of_runs = sweep->of_scene || sweep->has_seconds || sweep->def.steps ||
                         sweep->def.scene.has_seed || sweep->def.scene.has_dt || sweep->only ||
                         sweep->list || sweep->status;
    const bool lists = sweep->list || sweep->status;
    return !sweep->def.out                          ? "--out FILE says where the runs are kept"
           : sweep->merge && of_runs                ? "--merge goes with files and --out alone"
           : sweep->merge                           ? NULL
           : plain->count > 1                       ? "one scene at a time"
           : sweep->has_seconds && sweep->def.steps ? "--for and --steps exclude each other"
           : sweep->list && sweep->status           ? "--list and --status exclude each other"
           : sweep->missing && !sweep->list         ? "--missing goes with --list"
           : sweep->partial                         ? "--partial goes with --merge"
           : lists && (sweep->only || sweep->csv || sweep->canonical)
               ? "--list and --status run nothing: they go without --only, --csv and --canonical"
               : NULL;
}

static int run_sweep_command(int argc, char **argv) {
    Sweep sweep = {.def = jo_default_sweep_def(), .seeds = 1};
    CliList plain = {0};
    const char *path = NULL;
    int status = cli_parse(&cli_sweep, argc, argv, &sweep, &plain);
    if (status == CLI_GO_ON) {
        const char *why = find_sweep_misuse(&sweep, &plain);
        sweep.def.sets = sweep.sets.items;
        sweep.def.set_count = sweep.sets.count;
        sweep.def.scene.mods = sweep.mods.items;
        sweep.def.scene.mod_count = sweep.mods.count;
        sweep.def.seeds = (uint32_t)sweep.seeds;
        sweep.def.only = (uint32_t)sweep.only;
        if (!sweep.merge && !why)
            sweep.def.scene.path = path = cli_scene(&cli_sweep, plain.items[0], &sweep.mods);
        const char *outputs[] = {sweep.def.out, sweep.csv}, *inputs[] = {path};
        status = why                     ? cli_report_misuse(&cli_sweep, why)
                 : !path && !sweep.merge ? JO_INPUT
                 : cli_check_apart(&cli_sweep, outputs, 2, inputs, 1, NULL) != JO_OK ? JO_USAGE
                 : sweep.merge                ? merge_files(&sweep, &plain)
                 : sweep.list || sweep.status ? cli_list_runs(&sweep)
                                              : run_variants(&sweep);
    }
    jox_overlay_free(&sweep.files);
    cli_free(&cli_sweep, &sweep, &plain);
    return status;
}

const CliCommand cli_sweep = {
    .name = "sweep",
    .what = "run variants of a scene with many seeds",
    .usage = "SCENE --set PATH=A,B,C... --seeds N --out FILE.sqlite [options]\n"
             "SCENE ... --out FILE.sqlite --list|--status\n"
             "--merge FILE|FOLDER... --out FILE.sqlite",
    .about = "Runs every combination of the values given with every seed, each in a process of its "
             "own, and stores the results in one SQLite file. All runs use the files as they were "
             "when the sweep began. A run that fails is stored with its reason; the others go on. "
             "`jostle compare` compares the variants.\n\nOn many machines:\n  jostle sweep SCENE "
             "--set ... --seeds 20 --out all.sqlite --list > jobs\n  parallel < jobs               "
             "             # or on a cluster: scripts/cluster\n"
             "  jostle sweep --merge all-parts --out all.sqlite\n\nRuns that have their file are "
             "not repeated; --list --missing prints the commands that are left. The same sweep "
             "without --list does the runs that are missing in --out here.",
    .notes =
        "exit status: 0 all runs are done, 1 some failed or did not go as written, or the file "
        "could not be written, 2 wrong usage, 3 bad input, a file of other inputs, or runs missing "
        "in a merge; 129, 130 and "
        "143: SIGHUP, SIGINT or SIGTERM ended it early, and finished runs are kept",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "scene",
    .least = 1,
    .run = run_sweep_command,
};
