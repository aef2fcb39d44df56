/* The command `sweep`: runs the variants of a scene by jo_sweep, lists a command for each run, or
   merges files. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/format/quote.h"
#include "cli/cli.h"

typedef struct Sweep {
    JoSweepDef def;
    CliList sets, mods;
    uint64_t seeds, only;
    const char *csv;
    JoxOverlay files; /* files that were vetted */
    bool of_scene, has_seconds, list, merge, trusted;
} Sweep;

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
     "beside --out, for GNU parallel, Slurm and the like",
     CLI_TO(Sweep, list)},
    {"merge", NULL, "copy the runs of such files into --out", CLI_TO(Sweep, merge)},
    {"only", "N", "do only the N-th run, as such a command does", CLI_TO(Sweep, only),
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

/* ---- a list of commands ---- */

static void print_option(const char *name, const char *value) {
    JoxText quoted = {0};
    jox_quote_shell(&quoted, value);
    printf(" --%s %s", name, quoted.data);
    jox_text_free(&quoted);
}

/* Prints the options that all runs share. */
static void print_shared_options(const Sweep *sweep, const char *program) {
    const JoSweepDef *def = &sweep->def;
    JoxText quoted = {0};
    jox_quote_shell(&quoted, program);
    jox_text_add(&quoted, " sweep ");
    jox_quote_shell(&quoted, def->scene.path);
    fputs(quoted.data, stdout);
    jox_text_free(&quoted);
    for (size_t s = 0; s < def->set_count; s++)
        print_option("set", def->sets[s]);
    for (size_t m = 0; m < def->scene.mod_count; m++)
        print_option("mod", def->scene.mods[m]);
    printf(" --seeds %u", def->seeds);
    if (def->scene.has_seed)
        printf(" --seed %llu", (unsigned long long)def->scene.seed);
    if (sweep->has_seconds)
        printf(" --for %.9g", def->seconds);
    if (def->steps)
        printf(" --steps %llu", (unsigned long long)def->steps);
    if (def->scene.has_dt)
        printf(" --dt %.9g", def->scene.dt);
    if (def->scene.threads)
        printf(" --threads %u", def->scene.threads);
    if (def->scene.input_log)
        print_option("input", def->scene.input_log);
    printf("%s%s", def->scene.named_mods_only ? " --no-mods" : "",
           sweep->trusted ? " --trusted" : "");
}

/* Prints a command for each run, which writes a file of its own; returns an exit status. */
static int print_commands(const Sweep *sweep) {
    static const char ENDING[] = ".sqlite";
    const char *out = sweep->def.out;
    const size_t n = strlen(out), e = sizeof ENDING - 1;
    const size_t stem = n > e && !strcmp(out + n - e, ENDING) ? n - e : n;
    char program[1024];
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    JoError error = {0};
    const uint32_t runs = jo_sweep_runs(&sweep->def, &error);
    if (!runs)
        return cli_report_error(&cli_sweep, &error, false);
    cli_output_is_data();
    program[length > 0 ? length : 0] = 0;
    JoxText folder = {0};
    jox_text_printf(&folder, "%.*s-parts", (int)stem, out);
    if (mkdir(folder.data, 0777) != 0 && errno != EEXIST) {
        fprintf(stderr, "jostle sweep: cannot make the folder '%s': %s\n", folder.data,
                strerror(errno));
        jox_text_free(&folder);
        return JO_FAILED;
    }
    for (uint32_t r = 1; r <= runs; r++) {
        JoxText part = {0};
        jox_text_printf(&part, "%s/run-%06u.sqlite", folder.data, r);
        print_shared_options(sweep, program);
        printf(" --only %u", r);
        print_option("out", part.data);
        puts(" --quiet");
        jox_text_free(&part);
    }
    jox_text_free(&folder);
    return JO_OK;
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
    fputs("\n", stderr);
}

/* Prints the counts and writes the CSV table; returns the exit status. */
static int finish_sweep(const Sweep *sweep, const JoSweepCounts *counts) {
    JoError error = {0};
    print_counts(sweep, counts);
    if (sweep->csv && !jo_sweep_csv(sweep->def.out, sweep->csv, &error))
        return cli_report_error(&cli_sweep, &error, false);
    return counts->failed || counts->troubled ? JO_FAILED : JO_OK;
}

static int merge_files(const Sweep *sweep, const CliList *parts) {
    JoSweepCounts counts;
    JoError error = {0};
    if (!jo_sweep_merge(sweep->def.out, parts->items, parts->count, &counts, &error))
        return cli_report_error(&cli_sweep, &error, false);
    return finish_sweep(sweep, &counts);
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
                         sweep->list;
    return !sweep->def.out                          ? "--out FILE says where the runs are kept"
           : sweep->merge && of_runs                ? "--merge goes with files and --out alone"
           : sweep->merge                           ? NULL
           : plain->count > 1                       ? "one scene at a time"
           : sweep->has_seconds && sweep->def.steps ? "--for and --steps exclude each other"
           : sweep->list && (sweep->only || sweep->csv)
               ? "--list runs nothing: it goes without --only and --csv"
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
                 : sweep.merge ? merge_files(&sweep, &plain)
                 : sweep.list  ? print_commands(&sweep)
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
             "SCENE ... --out FILE.sqlite --list\n"
             "--merge FILE... --out FILE.sqlite",
    .about = "Runs every combination of the values given with every seed, each in a process of its "
             "own, and stores the results in one SQLite file. All runs use the files as they were "
             "when the sweep began. A run that fails is stored with its reason; the others go on. "
             "`jostle compare` compares the variants.\n\nOn many machines:\n  jostle sweep SCENE "
             "--set ... --seeds 20 --out all.sqlite --list > jobs\n  parallel < jobs               "
             "             # or, in a Slurm array:\n  sed -n \"${SLURM_ARRAY_TASK_ID}p\" jobs | "
             "sh\n  jostle sweep --merge all-parts/*.sqlite --out all.sqlite\n\nThe same sweep "
             "without --list then does the runs that are missing in --out.",
    .notes =
        "exit status: 0 all runs are done, 1 some failed or did not go as written, or the file "
        "could not be written, 2 wrong usage, 3 bad input, or a file of other inputs; 129, 130 and "
        "143: SIGHUP, SIGINT or SIGTERM ended it early, and finished runs are kept",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "scene",
    .least = 1,
    .run = run_sweep_command,
};
