#include <stdio.h>
#include <unistd.h>

#include "cli/cli.h"

static const CliOption OPTIONS[] = {
    {"quick", NULL, "smaller runs with the same bands", CLI_TO(JoReproduceDef, quick)},
    {"seeds", "A-B", "these seeds, or A alone, in place of those of each claim",
     CLI_TO(JoReproduceDef, seeds)},
    {"jobs", "N", "processes at once", "one for each processor", CLI_TO(JoReproduceDef, jobs),
     CLI_RANGE(1, 256)},
    {"out", "DIR", "for runs, pictures and index.html", "build/out/reproduce",
     CLI_TO(JoReproduceDef, out)},
    {"claims", "DIR", "folder of claim files", "scenes/claims", CLI_TO(JoReproduceDef, folder)},
    {"fresh", NULL, "do all runs anew", CLI_TO(JoReproduceDef, fresh)},
    {"list", NULL, "name the claims, run nothing", CLI_TO(JoReproduceDef, list)},
    {"quiet", NULL, "no progress", CLI_TO(JoReproduceDef, quiet)},
};

static int reproduce(JoReproduceDef *def) {
    char program[1024];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    JoError error = {0};
    size_t missed = 0;
    program[length > 0 ? length : 0] = 0;
    def->program = program;
    def->stop = &cli_signal;
    cli_catch_signals(true);
    if (!jo_reproduce(def, &missed, &error)) /* what is wrong with a file was sent as a message */
        return cli_failed(&cli_reproduce, &error, error.code == JO_INPUT);
    return missed ? JO_FAILED : JO_OK;
}

static int run(int argc, char **argv) {
    JoReproduceDef def = jo_default_reproduce_def();
    CliList claims = {0};
    int status = cli_parse(&cli_reproduce, argc, argv, &def, &claims);
    if (status == CLI_GO_ON) {
        def.claims = claims.items;
        def.claim_count = claims.count;
        status = reproduce(&def);
    }
    cli_free(&cli_reproduce, &def, &claims);
    return status;
}

const CliCommand cli_reproduce = {
    .name = "reproduce",
    .what = "run what papers and real crowds show, and compare",
    .usage = "[CLAIM...] [options]",
    .about = "Runs scenes, measures, and compares with what papers and real crowds say: all claims "
             "of scenes/claims, or those named; `paper`, `real` and `rimea` name several. Runs "
             "that are there already are not done again.",
    .notes = "exit status: 0 all in band, 1 a claim misses, 2 wrong usage, 3 a claim file is wrong",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "claim",
    .run = run,
};
