/* The options of `jostle sweep`, and its lists of runs. sweep.c reads the options and calls the
   list. */
#ifndef JOX_CLI_SWEEP_LIST_H
#define JOX_CLI_SWEEP_LIST_H

#include "cli/cli.h"

typedef struct CliSweep {
    JoSweepDef def;
    CliList sets, mods;
    uint64_t seeds, only;
    const char *csv;
    JoxOverlay files; /* files that were vetted */
    bool of_scene, has_seconds, list, missing, status, merge, partial, canonical, trusted;
} CliSweep;

/* Prints a command or the state of each run; returns an exit status. */
int cli_list_runs(const CliSweep *sweep);

#endif
