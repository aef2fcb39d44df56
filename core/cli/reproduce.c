#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"

static const char HELP[] =
    "usage: jostle reproduce [CLAIM...] [options]\n\n"
    "Runs scenes, measures, and compares with what papers and real crowds say: all claims of\n"
    "scenes/claims, or those named. Runs that are there already are not done again.\n\n"
    "  --quick        smaller runs with the same bands\n"
    "  --seeds N      so many seeds in place of those that each claim asks for\n"
    "  --jobs N       processes at once (default: one for each processor)\n"
    "  --out DIR      for runs, pictures and index.html (default build/out/reproduce)\n"
    "  --claims DIR   folder of claim files (default scenes/claims)\n"
    "  --fresh        do all runs anew\n"
    "  --list         name the claims, run nothing\n"
    "  --quiet        no progress\n\n"
    "exit status: 0 all in band, 1 a claim misses, 2 wrong usage, 3 a claim file is wrong\n";

int cli_reproduce(int argc, char **argv) {
    static const char *const known[] = {"quick", "seeds", "jobs",  "out",  "claims",
                                        "fresh", "list",  "quiet", "help", NULL};
    CliArgs args = {.argc = argc, .argv = argv, .next = 1, .command = "reproduce"};
    const char **claims = calloc((size_t)argc + 1, sizeof *claims), *option, *plain;
    JoReproduceDef def = jo_default_reproduce_def();
    char program[1024];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    int status = -1;
    program[length > 0 ? length : 0] = 0;
    def.program = program;
    def.claims = claims;
    while (status < 0 && ((option = cli_next(&args, &plain)) || plain)) {
        if (plain) {
            claims[def.claim_count++] = plain;
        } else if (!strcmp(option, "quick")) {
            def.quick = true;
        } else if (!strcmp(option, "seeds")) {
            def.seeds = (uint32_t)cli_whole(&args, option, 1, 1000);
        } else if (!strcmp(option, "jobs")) {
            def.jobs = (uint32_t)cli_whole(&args, option, 1, 256);
        } else if (!strcmp(option, "out")) {
            def.out = cli_value(&args, option);
        } else if (!strcmp(option, "claims")) {
            def.folder = cli_value(&args, option);
        } else if (!strcmp(option, "fresh")) {
            def.fresh = true;
        } else if (!strcmp(option, "list")) {
            def.list = true;
        } else if (!strcmp(option, "quiet")) {
            def.quiet = true;
        } else if (!strcmp(option, "help") || !strcmp(option, "h")) {
            fputs(HELP, stdout);
            status = JO_OK;
        } else {
            status = cli_unknown(&args, option, known);
        }
    }
    if (args.failed)
        status = JO_USAGE;
    if (status < 0) {
        JoError error = {0};
        size_t missed = 0;
        bool good = jo_reproduce(&def, &missed, &error);
        if (!good && error.code != JO_INPUT)
            fprintf(stderr, "jostle reproduce: %s\n", error.text);
        status = !good ? error.code ? (int)error.code : JO_FAILED : missed ? JO_FAILED : JO_OK;
    }
    free(claims);
    return status;
}
