/* The command `reproduce`: checks the claims by jo_reproduce. */
#include <unistd.h>

#include "base/text.h"
#include "cli/cli.h"

typedef struct Reproduce {
    JoReproduceDef def;
    CliList sets;
    bool trusted;
} Reproduce;

static const CliOption OPTIONS[] = {
    {"standards", NULL,
     "run the tests of RiMEA, IMO, NIST and ISO, and write a page of them for authorities, "
     "standards.html",
     CLI_TO(Reproduce, def.standards)},
    {"quick", NULL,
     "fewer and smaller runs with the same bands; their verdicts are not the published ones",
     CLI_TO(Reproduce, def.quick)},
    {"seeds", "A-B", "use these seeds, or only A, instead of those of each claim",
     CLI_TO(Reproduce, def.seeds)},
    {"set", "PATH=VALUE",
     "replace a value of every scene, such as walking.width=1.3, to see how much a claim depends "
     "on it",
     CLI_TO(Reproduce, sets)},
    {"jobs", "N", "processes at once", "one for each processor", CLI_TO(Reproduce, def.jobs),
     CLI_RANGE(1, 256)},
    {"out", "DIR", "folder for runs, pictures and index.html", "build/out/reproduce",
     CLI_TO(Reproduce, def.out), .writes = "folder"},
    {"claims", "DIR", "folder of claim files", "scenes/claims", CLI_TO(Reproduce, def.folder)},
    {"fresh", NULL, "repeat all runs", CLI_TO(Reproduce, def.fresh)},
    {"list", NULL, "list the claims; run nothing", CLI_TO(Reproduce, def.list)},
    {"quiet", NULL, "print no progress", CLI_TO(Reproduce, def.quiet)},
    {"trusted", NULL,
     "trust the claims. Without it the command reads only their folder, the one above, and "
     "../behaviours and ../scripts of that, writes only to --out, and connects to nothing",
     CLI_TO(Reproduce, trusted)},
};

/* Confines the process. The folder of claims lies in that of the scenes. The runs, in processes of
   their own, read scenes as `jostle run` does. */
static void confine_reproduce(const JoReproduceDef *def, bool trusted) {
    static const char *const SAYS_WHERE[] = {".git", "/proc/cpuinfo", "/proc/stat"};
    CliReach reach = {.programs = true, .program = def->program};
    JoxText scenes = {0};
    jox_text_printf(&scenes, "%s/..", def->folder);
    cli_reach_scene(&reach, scenes.data);
    cli_reach_folder(&reach, def->folder);
    for (size_t s = 0; s < sizeof SAYS_WHERE / sizeof *SAYS_WHERE; s++)
        cli_reach_folder(&reach, SAYS_WHERE[s]);
    cli_reach_output(&reach, def->out);
    cli_confine_work(&reach, trusted);
    jox_text_free(&scenes);
}

static int check_claims(JoReproduceDef *def, bool trusted) {
    char program[1024];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    JoError error = {0};
    size_t missed = 0;
    program[length > 0 ? length : 0] = 0;
    def->program = program;
    def->stop = &cli_signal;
    cli_catch_signals(true);
    confine_reproduce(def, trusted);
    if (!jo_reproduce(def, &missed, &error)) { /* faults of files were sent as messages */
        const int status = cli_report_error(&cli_reproduce, &error, error.code == JO_INPUT);
        return cli_signal ? cli_add_signal_status(JO_OK) : status;
    }
    return missed ? JO_FAILED : JO_OK;
}

static int run_reproduce(int argc, char **argv) {
    Reproduce run = {.def = jo_default_reproduce_def()};
    CliList claims = {0};
    int status = cli_parse(&cli_reproduce, argc, argv, &run, &claims);
    if (status == CLI_GO_ON) {
        run.def.claims = claims.items;
        run.def.claim_count = claims.count;
        run.def.sets = run.sets.items;
        run.def.set_count = run.sets.count;
        status = check_claims(&run.def, run.trusted);
    }
    cli_free(&cli_reproduce, &run, &claims);
    return status;
}

const CliCommand cli_reproduce = {
    .name = "reproduce",
    .what = "compare runs with what papers and real crowds show",
    .usage = "[CLAIM...] [options]",
    .about = "Runs scenes, measures them, and compares the results with papers and real crowds: "
             "all claims of scenes/claims, or those named. `paper`, `real`, `rimea`, `imo`, `nist` "
             "and `iso` name groups of claims, `standards` the last four groups. Runs that exist "
             "are not repeated.",
    .notes = "exit status: 0 all in band, 1 a claim misses, 2 wrong usage, 3 a claim file is "
             "wrong; 129, 130 and 143: SIGHUP, SIGINT or SIGTERM ended it early",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "claim",
    .run = run_reproduce,
};
