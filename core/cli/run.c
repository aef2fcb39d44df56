#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"

static const char HELP[] =
    "usage: jostle run SCENE [options]\n\n"
    "  --for S            simulate S seconds (default: the scene's duration)\n"
    "  --steps N          or N steps\n"
    "  --dt S             time step, s (0.001 to 0.2)\n"
    "  --seed N           seed of all random numbers\n"
    "  --seeds N          run with N seeds; the summary gives mean and 5-95 % of each figure\n"
    "  --threads N        threads; never changes a result (default 1)\n"
    "  --isa NAME         instruction set of the kernels: scalar\n"
    "  --set PATH=VALUE   replace a value of the scene, e.g. groups.pilgrims.count=5000\n"
    "  --input FILE       play an input log: what people did, and files that were reloaded\n"
    "  --log-input FILE   write one (replaces FILE)\n"
    "  --record FILE      write trajectories (SQLite, JuPedSim format 2)\n"
    "  --report DIR       write a page, pictures and figures into DIR (index.html): danger, "
    "density,\n"
    "                     what probes measure; runs once more at half the step to show its share\n"
    "  --no-half-step     do not run once more\n"
    "  --data DIR         write the CSV files of the scene's probes, and no pictures\n"
    "  --summary FILE     write the run's figures as JSON; '-' is standard output\n"
    "  --mod DIR          take a mod: a folder, or the name of one that lies in scenes' mods/ or "
    "in the\n"
    "                     user's data directory; may be given several times. Others are off, but "
    "those\n"
    "                     that `jostle mod enable` turned on\n"
    "  --no-mods          take no mods but those given by --mod or named by the scene\n"
    "  --profile-lua      list what each plain Lua function costs, by state\n"
    "  --watch            reload behaviours and the scene when their files change; the default "
    "where\n"
    "                     the output is a terminal\n"
    "  --no-watch         do not\n"
    "  --trace AGENT      print each transition of the agent with this id, and why\n"
    "  --quiet            no progress\n"
    "  --view[=PORT]      show the run on a live page, in real time; prints the page's address.\n"
    "                     Files are watched; --record, --log-input and --summary go with it\n"
    "  --fast             with --view: as fast as it can go\n"
    "  --view-address A   listen at this address, not at 127.0.0.1: others can then reach the "
    "page,\n"
    "                     with its token\n"
    "  --page DIR, --three DIR\n"
    "                     folders of the page's files and of three.js\n\n"
    "exit status: 0 done, 1 the run failed, or a behaviour was suspended by its own errors,\n"
    "2 wrong usage, 3 bad input\n";

typedef struct Run {
    JoSceneDef def;
    const char *record, *report, *data, *summary, *log;
    double seconds;
    uint64_t steps, seeds, trace;
    const char **mods;
    JoViewDef live; /* of the page */
    bool view;
    bool has_seconds, has_steps, watch, no_watch, has_trace, quiet, profile, no_half;
    bool suspended; /* functions of a behaviour failed so often that it did not run as written */
} Run;

static volatile sig_atomic_t interrupted;
static const double LEAST_DT = 0.001; /* s, of --dt */

static void interrupt(int number) {
    (void)number;
    interrupted = 1;
}

/* Those of the live page. */
static bool read_view_option(Run *run, CliArgs *args, const char *option) {
    if (!strcmp(option, "view")) {
        run->view = true;
        if (args->value) /* a port is given with '=' only: what follows may be the scene */
            run->live.port = (int)cli_whole(args, option, 1, 65535);
    } else if (!strcmp(option, "view-address")) {
        run->live.address = cli_value(args, option);
    } else if (!strcmp(option, "page")) {
        run->live.page = cli_value(args, option);
    } else if (!strcmp(option, "three")) {
        run->live.three = cli_value(args, option);
    } else if (!strcmp(option, "fast")) {
        run->live.fast = true;
    } else {
        return false;
    }
    return true;
}

/* Reads one option into `run`; false if there is no such option. */
static bool read_option(Run *run, CliArgs *args, const char *option, const char **overrides) {
    if (!strcmp(option, "for")) {
        run->seconds = cli_number(args, option, 0, 1e7);
        run->has_seconds = true;
    } else if (!strcmp(option, "steps")) {
        run->steps = cli_whole(args, option, 0, 1000000000);
        run->has_steps = true;
    } else if (!strcmp(option, "dt")) {
        run->def.dt = cli_number(args, option, 0.001, 0.2);
        run->def.has_dt = true;
    } else if (!strcmp(option, "seed")) {
        run->def.seed = cli_whole(args, option, 0, UINT64_MAX);
        run->def.has_seed = true;
    } else if (!strcmp(option, "seeds")) {
        run->seeds = cli_whole(args, option, 1, 1000);
    } else if (!strcmp(option, "threads")) {
        run->def.threads = (uint32_t)cli_whole(args, option, 1, 64);
    } else if (!strcmp(option, "isa")) {
        const char *name = cli_value(args, option);
        if (name && strcmp(name, "scalar")) {
            fprintf(stderr, "jostle run: no kernels for '%s'; this build has: scalar\n", name);
            args->failed = true;
        }
    } else if (!strcmp(option, "set")) {
        overrides[run->def.override_count++] = cli_value(args, option);
    } else if (!strcmp(option, "input")) {
        run->def.input_log = cli_value(args, option);
    } else if (!strcmp(option, "log-input")) {
        run->log = cli_value(args, option);
    } else if (!strcmp(option, "record")) {
        run->record = cli_value(args, option);
    } else if (!strcmp(option, "report")) {
        run->report = cli_value(args, option);
    } else if (!strcmp(option, "no-half-step")) {
        run->no_half = true;
    } else if (!strcmp(option, "data")) {
        run->data = cli_value(args, option);
    } else if (!strcmp(option, "summary")) {
        run->summary = cli_value(args, option);
    } else if (!strcmp(option, "mod")) {
        run->mods[run->def.mod_count++] = cli_value(args, option);
    } else if (!strcmp(option, "no-mods")) {
        run->def.named_mods_only = true;
    } else if (!strcmp(option, "profile-lua")) {
        run->profile = true;
    } else if (!strcmp(option, "watch")) {
        run->watch = true;
    } else if (!strcmp(option, "no-watch")) {
        run->no_watch = true;
    } else if (!strcmp(option, "trace")) {
        run->trace = cli_whole(args, option, 0, UINT32_MAX);
        run->has_trace = true;
    } else if (!strcmp(option, "quiet")) {
        run->quiet = true;
    } else {
        return read_view_option(run, args, option);
    }
    return true;
}

/* Prints what went wrong unless the library has already sent it as a message. */
static int complain(const JoError *error, bool already) {
    if (!already)
        fprintf(stderr, "jostle run: %s\n", error->text);
    return error->code ? (int)error->code : JO_FAILED;
}

/* The report's page, with the same run at half the step beside it. */
static int write_page(const Run *run, const JoScene *scene, uint64_t steps) {
    JoError error = {0};
    const char *why = interrupted                               ? "the run was interrupted"
                      : run->no_half                            ? "--no-half-step was given"
                      : jo_scene_stats(scene).dt / 2 < LEAST_DT ? "it would be below 0.001 s"
                                                                : NULL;
    JoScene *half = why ? NULL : jo_scene_half_step(&run->def, scene, &error);
    if (!why && !half)
        why = error.text;
    if (half && !run->quiet) {
        fprintf(stderr, "once more at half the step, %g s:\n", jo_scene_stats(half).dt);
        jo_scene_show_progress(half, (double)(2 * steps) * jo_scene_stats(half).dt);
    }
    bool ok = true;
    for (uint64_t i = 0; half && ok && i < 2 * steps && !interrupted; i++)
        ok = jo_scene_step(half, &error);
    if (half && (!ok || interrupted || !jo_scene_finish(half, &error))) {
        why = interrupted ? "it was interrupted" : error.text;
        jo_scene_free(half);
        half = NULL;
    }
    JoError written = {0};
    ok = jo_scene_page(scene, half, why, run->report, &written);
    jo_scene_free(half);
    return ok ? JO_OK : complain(&written, false);
}

/* Whether functions of behaviours were suspended, which it says. */
static bool tell_suspended(const JoScene *scene) {
    char *which = jo_scene_suspended(scene);
    if (which)
        fprintf(stderr, "jostle run: %s\n", which);
    jo_free(which);
    return which != NULL;
}

/* Loads and simulates once; *summary receives JSON when asked for. */
static int simulate(Run *run, char **summary) {
    JoError error = {0};
    JoScene *scene = jo_scene_load(&run->def, &error);
    if (!scene)
        return complain(&error, true);
    double dt = jo_scene_stats(scene).dt;
    double seconds = run->has_seconds ? run->seconds : jo_scene_duration(scene);
    uint64_t steps = run->has_steps ? run->steps : (uint64_t)(seconds / dt + 0.5);
    bool ok = (!run->record || jo_scene_record(scene, run->record, &error)) &&
              (!run->report || jo_scene_report(scene, run->report, &error)) &&
              (!run->data || jo_scene_data(scene, run->data, &error)) &&
              (!run->log || jo_scene_log_input(scene, run->log, &error)) &&
              (!run->watch || jo_scene_watch(scene, &error));
    if (run->has_trace)
        jo_scene_trace(scene, (uint32_t)run->trace);
    if (!run->quiet)
        jo_scene_show_progress(scene, (double)steps * dt);
    for (uint64_t i = 0; ok && i < steps && !interrupted; i++)
        ok = jo_scene_step(scene, &error);
    /* What was recorded until a failure is kept: finish in any case, report the first error. */
    JoError ending = {0};
    bool ended = jo_scene_finish(scene, &ending);
    if (ok && !ended)
        error = ending;
    int status = ok && ended ? JO_OK : complain(&error, false);
    if (status == JO_OK && run->report)
        status = write_page(run, scene, steps);
    if (run->summary || run->seeds)
        *summary = jo_scene_summary(scene);
    run->suspended |= tell_suspended(scene);
    if (run->profile) {
        char *profile = jo_scene_lua_profile(scene);
        fputs(profile ? profile : "", stderr);
        jo_free(profile);
    }
    jo_scene_free(scene);
    return status;
}

static void print_address(void *context, const char *address) {
    (void)context;
    printf("%s\n", address);
    fflush(stdout);
    fputs("Open this address in a browser; Ctrl-C ends the run.\n", stderr);
}

/* On its live page, until it is interrupted. */
static int show(Run *run, char **summary) {
    JoViewDef *live = &run->live;
    JoError error = {0};
    live->scene = run->def;
    live->watch = !run->no_watch;
    live->record = run->record;
    live->log_input = run->log;
    live->stop = &interrupted;
    live->opened = print_address;
    live->summary = run->summary ? summary : NULL;
    live->seconds = run->has_seconds ? run->seconds : 0.0;
    if (jo_view(live, &error))
        return JO_OK;
    return complain(&error, error.code == JO_INPUT);
}

static int simulate_seeds(Run *run) {
    char **summaries = calloc(run->seeds, sizeof *summaries);
    uint64_t first = run->def.has_seed ? run->def.seed : 1;
    int status = JO_OK;
    size_t done = 0;
    for (uint64_t i = 0; i < run->seeds && status == JO_OK && !interrupted; i++) {
        run->def.seed = first + i;
        run->def.has_seed = true;
        if (!run->quiet)
            fprintf(stderr, "seed %llu\n", (unsigned long long)run->def.seed);
        status = simulate(run, &summaries[i]);
        done += summaries[i] != NULL;
    }
    if (status == JO_OK) {
        JoError error = {0};
        char *all = jo_summaries_aggregate((const char *const *)summaries, done, &error);
        status = all ? cli_write("run", run->summary ? run->summary : "-", all)
                     : complain(&error, false);
        jo_free(all);
    }
    for (size_t i = 0; i < run->seeds; i++)
        jo_free(summaries[i]);
    free(summaries);
    return status;
}

static int usage_error(const Run *run, const CliArgs *args) {
    if (args->failed)
        return JO_USAGE;
    const char *why =
        !run->def.path                       ? "no scene given"
        : run->has_seconds && run->has_steps ? "--for and --steps exclude each other"
        : run->seeds && (run->record || run->report || run->watch || run->log)
            ? "--seeds cannot be combined with --record, --report, --log-input or --watch"
        : run->view && (run->seeds || run->report || run->data || run->has_trace || run->profile)
            ? "--view cannot be combined with --seeds, --report, --data, --trace or --profile-lua"
        : run->view && run->has_steps ? "--view goes with --for S, not with --steps"
        : !run->view && (run->live.address || run->live.page || run->live.three || run->live.fast)
            ? "--fast, --view-address, --page and --three go with --view"
            : NULL;
    if (why)
        fprintf(stderr, "jostle run: %s\n", why);
    return why ? JO_USAGE : JO_OK;
}

int cli_run(int argc, char **argv) {
    static const char *const known[] = {
        "for",          "steps",       "dt",       "seed",         "seeds",     "threads",
        "isa",          "set",         "input",    "record",       "report",    "data",
        "summary",      "watch",       "trace",    "quiet",        "help",      "mod",
        "no-mods",      "profile-lua", "no-watch", "no-half-step", "log-input", "view",
        "view-address", "page",        "three",    "fast",         NULL};
    CliArgs args = {.argc = argc, .argv = argv, .next = 1, .command = "run"};
    const char **overrides = calloc((size_t)argc, sizeof *overrides);
    Run run = {.def = jo_default_scene_def(), .live = jo_default_view_def()};
    run.def.overrides = overrides;
    run.mods = calloc((size_t)argc, sizeof *run.mods);
    run.def.mods = run.mods;
    const char *option, *plain;
    int status = -1;
    while (status < 0 && ((option = cli_next(&args, &plain)) || plain)) {
        if (plain && run.def.path) {
            fprintf(stderr, "jostle run: one scene at a time; what is '%s'?\n", plain);
            status = JO_USAGE;
        } else if (plain) {
            run.def.path = plain;
        } else if (!strcmp(option, "help") || !strcmp(option, "h")) {
            fputs(HELP, stdout);
            status = JO_OK;
        } else if (!read_option(&run, &args, option, overrides)) {
            status = cli_unknown(&args, option, known);
        }
    }
    if (status < 0) {
        status = usage_error(&run, &args);
        if (status != JO_OK)
            fprintf(stderr, "Try 'jostle run --help'.\n");
        else
            status = -1;
    }
    if (status < 0) {
        run.watch |= isatty(2) && !run.no_watch && !run.seeds && !run.def.input_log;
        signal(SIGINT, interrupt);
        signal(SIGTERM, interrupt);
        char *summary = NULL;
        status = run.view    ? show(&run, &summary)
                 : run.seeds ? simulate_seeds(&run)
                             : simulate(&run, &summary);
        if (summary && run.summary) {
            int written = cli_write("run", run.summary, summary);
            status = status ? status : written;
        }
        jo_free(summary);
        if (status == JO_OK && run.suspended)
            status = JO_FAILED;
    }
    free(overrides);
    free(run.mods);
    return status;
}
