/* The command `run`: simulates a scene once, with several seeds, or on the live page, and writes
   the outputs. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"

typedef struct Run {
    JoSceneDef def;
    JoViewDef live; /* settings of the live page */
    CliList sets, mods, breaks;
    const char *record, *report, *data, *summary, *log;
    const char *folder; /* folder of checkpoints */
    double seconds, every, record_every;
    uint64_t steps, seeds, trace;
    bool view, of_scene, has_seconds, has_steps, has_wait, watch, no_watch, has_trace, quiet,
        profile;
    bool no_half, trusted;
    JoxOverlay files;  /* files that were vetted */
    CliKeeper *keeper; /* vets edited files; or NULL */
    bool troubled;     /* the run reached its end, but not as it was written */
    CliPageFiles page_files;
} Run;

static bool read_run_isa(void *options, const char *text, char why[160]) {
    return cli_read_isa(&((Run *)options)->def.isa, text, why);
}

static const CliOption OPTIONS[] = {
    {"for", "S", "simulate S seconds", "the scene's duration", CLI_TO(Run, seconds),
     CLI_GIVEN(Run, has_seconds), CLI_RANGE(0, 1e7)},
    {"steps", "N", "simulate N steps instead", CLI_TO(Run, steps), CLI_GIVEN(Run, has_steps),
     CLI_RANGE(0, 1e9)},
    CLI_SCENE_OPTIONS(Run, def),
    {"seeds", "N",
     "run with N seeds in parallel, as `jostle sweep` does; the summary has mean and 5-95 % of "
     "each figure and, in \"given\", the values that are no statistics, such as seed, step and "
     "coordinates, once or as a list",
     CLI_TO(Run, seeds), CLI_RANGE(1, 1000)},
    CLI_ISA_OPTION(read_run_isa),
    {"log-input", "FILE", "write an input log (replaces FILE)", CLI_TO(Run, log),
     .writes = "log txt"},
    {"record", "FILE", "write trajectories (SQLite, JuPedSim format 2)", CLI_TO(Run, record),
     .writes = "sqlite sqlite3 db db3"},
    {"record-every", "S",
     "seconds between frames of --record, rounded to whole steps; the loads of a frame are means "
     "since the frame before",
     "0.1", CLI_TO(Run, record_every), CLI_RANGE(0.001, 1e6)},
    {"checkpoint", "S",
     "every S simulated seconds, save the whole state of the run, with the text of each file, for "
     "`jostle resume`: to latest.checkpoint, and the one before to before.checkpoint. With bodies "
     "the state is exact, and saved, at each 128th step only",
     CLI_TO(Run, every), CLI_RANGE(0.001, 1e7)},
    {"checkpoint-dir", "DIR", "folder for checkpoints", CLI_TO(Run, folder), .writes = "folder"},
    {"report", "DIR",
     "write a page to share or print (DIR/index.html), with pictures and tables: a summary in "
     "sentences, a plan, times of leaving, published limits that were exceeded, maps and moments, "
     "levels of service, results of probes, inputs and their hashes. Runs the scene again at half "
     "the step to show the difference beside each figure. With --seeds: how far the runs differ, "
     "in sentences, curves with bands, maps of the mean and the worst, and each run with its hash; "
     "the runs are kept in DIR/runs.sqlite, from which the same command continues, or makes a page "
     "of more seeds",
     CLI_TO(Run, report), .writes = "folder"},
    {"no-half-step", NULL, "do not run again at half the step", CLI_TO(Run, no_half)},
    {"data", "DIR",
     "write the CSV files of the scene's probes and of danger, and no pictures; with --seeds those "
     "of each seed into DIR/seed-N",
     CLI_TO(Run, data), .writes = "folder"},
    {"summary", "FILE",
     "write the run's figures as JSON; '-' is standard output. \"states\" has the people in each "
     "state, \"outer_states\" those in all states within one that runs a machine. \"density_max\" "
     "is the greatest "
     "density of any place and time, people per m2 by a Gaussian of R = 1 m within the walls, "
     "sampled every 0.5 s, as in all maps and tables; \"clearance_s\" is the time at which the "
     "last person left, null if anybody is still inside",
     CLI_TO(Run, summary), .writes = "json txt"},
    {"profile-lua", NULL, "list the cost of each plain Lua function, by state",
     CLI_TO(Run, profile)},
    {"trusted", NULL,
     "trust the scene: read it directly. Without it, a process that has no network, writes nothing "
     "and reads only the scene's folder, ../behaviours, ../scripts and mods reads it first, and "
     "the run loads what that process read; likewise for files that are edited while it runs",
     CLI_TO(Run, trusted)},
    {"watch", NULL, "reload behaviours and the scene when their files change",
     "if the output is a terminal", CLI_TO(Run, watch)},
    {"no-watch", NULL, "do not reload changed files", CLI_TO(Run, no_watch)},
    {"trace", "AGENT",
     "print each transition of the agent with this id, and why; and between them its reactions, "
     "and "
     "each term of the conditions that it waits for, when it begins or ceases to hold. Repetitions "
     "within a state are counted, and told ever more seldom",
     CLI_TO(Run, trace), CLI_GIVEN(Run, has_trace), CLI_RANGE(0, UINT32_MAX)},
    {"break", "WHEN",
     "end the run, or with --view pause it, in the step in which WHEN happens: 'agent 17 enters "
     "Hide', 'anybody leaves Lesson', 'GROUP calls SIGNAL'; may be given several times. With "
     "--checkpoint-dir a checkpoint is written there, to look at with `jostle why --from DIR` or "
     "go on from with `jostle resume`",
     CLI_TO(Run, breaks)},
    {"quiet", NULL, "print no progress, and no closing paragraph", CLI_TO(Run, quiet)},
    {"view", "PORT",
     "show the run on a live page, in real time, and print the page's address: port 8730, or the "
     "next that is free. On the page people can act on the run, pause, restart and inspect it. "
     "Files are watched; --for, --record, --log-input, --input, --checkpoint and --summary can be "
     "given, too. After a restart the files of --record and --log-input are NAME-2.EXT, and so on: "
     "those of the runs before stay. Requests without the address's token are refused",
     CLI_TO(Run, live.port), .only_equals = true, CLI_GIVEN(Run, view), CLI_RANGE(1, 65535)},
    {"fast", NULL, "with --view: run as fast as possible", CLI_TO(Run, live.fast)},
    {"view-wait", "S",
     "with --view: wait up to S seconds for the first page to open before the run begins (5); 0 "
     "begins at once, as --fast does",
     CLI_TO(Run, live.wait), CLI_GIVEN(Run, has_wait), CLI_RANGE(0, 3600)},
    {"view-address", "A",
     "listen at this address, not at 127.0.0.1: others can then reach the page, with its token, "
     "and act on the run; nothing is encrypted",
     CLI_TO(Run, live.address)},
    {"page", "DIR", "folder of the page's files", CLI_TO(Run, live.page)},
};

/* Prints an error, unless the library already sent it as a message; returns the exit status. */
static int print_run_error(const JoError *error, bool already) {
    return cli_report_error(&cli_run, error, already);
}

/* Loads the scene from the files that were vetted. */
static JoScene *load_vetted_scene(const Run *run, JoError *error) {
    const JoxOverlay *before = jox_overlay_use(&run->files);
    JoScene *scene = jo_scene_load(&run->def, error);
    jox_overlay_use(before);
    return scene;
}

enum { LONGEST_NOTED = 4096 };

/* Returns whether a path fits into a line of a checkpoint's note. */
static bool fits_into_note(const char *path) {
    return !path || (!strpbrk(path, "\n\r") && strlen(path) <= LONGEST_NOTED);
}

static const double NEVER = 1e9; /* s: of checkpoints that are written at breakpoints alone */

/* Starts writing checkpoints. Their note holds what `jostle resume` needs besides the scene. */
static bool start_checkpoints(const Run *run, JoScene *scene, uint64_t steps, JoError *error) {
    const struct {
        const char *key, *value;
    } texts[] = {{"record", run->record},
                 {"log", run->log},
                 {"folder", run->folder},
                 {"report", run->report},
                 {"data", run->data}};
    char note[6 * LONGEST_NOTED];
    const double every = run->every > 0.0 ? run->every : NEVER;
    int used = snprintf(note, sizeof note, "steps %llu\nevery %.17g\n%s%s",
                        (unsigned long long)steps, every, run->no_half ? "no-half \n" : "",
                        run->has_seconds || run->has_steps ? "all-steps \n" : "");
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++)
        if (texts[t].value)
            used += snprintf(note + used, sizeof note - (size_t)used, "%s %s\n", texts[t].key,
                             texts[t].value);
    return jo_scene_checkpoint(scene, run->folder, every, note, error);
}

/* Returns the number of steps of the run. */
static uint64_t count_run_steps(const Run *run, const JoScene *scene) {
    const double seconds = run->has_seconds ? run->seconds : jo_scene_duration(scene);
    return run->has_steps ? run->steps : (uint64_t)(seconds / jo_scene_stats(scene).dt + 0.5);
}

/* Checks that the summary can be written at the end; false with a message. */
static bool check_summary_path(const Run *run) {
    return !run->summary || cli_check_writable(&cli_run, run->summary) == JO_OK;
}

/* Opens the files that are written during the run; `files` lists those that could be opened. */
static bool open_run_files(const Run *run, JoScene *scene, uint64_t steps, CliRunFiles *files,
                           JoError *error) {
    const bool begun =
        (!run->record || (jo_scene_record(scene, run->record, run->record_every, error) &&
                          (files->record = run->record))) &&
        (!run->report || jo_scene_report(scene, run->report, error)) &&
        (!run->data || (jo_scene_data(scene, run->data, error) && (files->data = run->data))) &&
        (!run->log || (jo_scene_log_input(scene, run->log, error) && (files->log = run->log))) &&
        (!run->watch || jo_scene_watch(scene, error));
    if (!begun || !run->folder)
        return begun;
    files->checkpoints = run->folder;
    return start_checkpoints(run, scene, steps, error);
}

/* Writes page and summary of a run that ended with `status`; returns the exit status. */
static int write_page_and_summary(Run *run, JoScene *scene, uint64_t steps, int status,
                                  CliRunFiles *files) {
    if (status == JO_OK && run->report) {
        status = cli_write_report_page(&cli_run, &(CliReportPage){.folder = run->report,
                                                                  .def = &run->def,
                                                                  .files = &run->files,
                                                                  .scene = scene,
                                                                  .steps = steps,
                                                                  .no_half = run->no_half,
                                                                  .quiet = run->quiet});
        files->report = status == JO_OK ? run->report : NULL;
    }
    char *summary = run->summary ? jo_scene_summary(scene) : NULL;
    if (summary) {
        const int written = cli_write(&cli_run, run->summary, summary);
        files->summary = written == JO_OK ? run->summary : NULL;
        status = status ? status : written;
    }
    jo_free(summary);
    return status;
}

/* Sets the breakpoints of the run; false with `error`. */
static bool set_breaks(const Run *run, JoScene *scene, JoError *error) {
    bool good = true;
    for (size_t b = 0; good && b < run->breaks.count; b++)
        good = jo_scene_break(scene, run->breaks.items[b], error);
    return good;
}

/* Writes a checkpoint of a run that has come to a breakpoint, after as many more steps as it takes
   until the state can be saved. */
static bool save_break(const Run *run, JoScene *scene, JoError *error) {
    bool written = false, good = jo_scene_checkpoint_now(scene, &written, error);
    while (good && !written && !cli_signal)
        good = jo_scene_step(scene, error) && jo_scene_checkpoint_now(scene, &written, error);
    if (written)
        fprintf(stderr, "the state at %.2f s is in %s\n", jo_world_time(jo_scene_world(scene)),
                run->folder);
    return good;
}

/* Says why no breakpoint was met, which is trouble for the exit status. */
static void print_unmet(Run *run, JoScene *scene) {
    char *text = jo_scene_unmet(scene);
    fputs(text ? text : "", stderr);
    jo_free(text);
    run->troubled = true;
}

/* Makes the steps of the run, up to a breakpoint or, unless the options say how long it is, to the
   end of a game's round. */
static bool make_steps(Run *run, JoScene *scene, uint64_t steps, JoError *error) {
    bool ok = true, broke = false, over = false;
    for (uint64_t i = 0; ok && !broke && !over && i < steps && !cli_signal; i++) {
        ok = jo_scene_step(scene, error);
        broke = ok && run->breaks.count && jo_scene_broke(scene);
        over = !run->has_seconds && !run->has_steps && jo_scene_over(scene);
    }
    if (broke)
        fputs(jo_scene_broke(scene), stderr);
    else if (ok && run->breaks.count && !cli_signal)
        print_unmet(run, scene);
    return ok && (!broke || !run->folder || save_break(run, scene, error));
}

/* Loads the scene and simulates it once; returns an exit status. */
static int run_once(Run *run) {
    JoError error = {0};
    CliRunFiles files = {0};
    JoScene *scene = load_vetted_scene(run, &error);
    if (!scene)
        return print_run_error(&error, true);
    cli_catch_signals(true);
    uint64_t steps = count_run_steps(run, scene);
    jo_scene_vet(scene, cli_keeper_vetter(run->keeper));
    if (!set_breaks(run, scene, &error)) {
        jo_scene_free(scene);
        return print_run_error(&error, false);
    }
    bool ok = open_run_files(run, scene, steps, &files, &error);
    const bool begun = ok;
    if (ok && !check_summary_path(run)) { /* checked only now: a report may have made its folder */
        jo_scene_free(scene);
        return JO_FAILED;
    }
    if (run->has_trace)
        jo_scene_trace(scene, (uint32_t)run->trace);
    if (!run->quiet && ok)
        jo_scene_show_progress(scene, (double)steps * jo_scene_stats(scene).dt);
    ok = ok && make_steps(run, scene, steps, &error);
    int status = cli_finish_run(&cli_run, scene, ok, &error, &files);
    if (jo_scene_over(scene) && !run->has_seconds && !run->has_steps)
        steps = jo_world_tick(jo_scene_world(scene));
    if (begun)
        status = write_page_and_summary(run, scene, steps, status, &files);
    run->troubled |= cli_print_troubles(&cli_run, scene);
    run->troubled |= !jo_scene_meets_criteria(scene);
    if (!run->quiet && begun)
        cli_print_closing(scene, &files);
    if (run->profile)
        cli_print_lua_costs(scene);
    jo_scene_free(scene);
    return status;
}

/* Called when a run on the live page begins, and at each restart, with the files of that run, for
   its checkpoints and for the last lines. */
static void note_page_files(void *context, const char *record, const char *log) {
    Run *run = context;
    run->record = cli_add_page_file(&run->page_files, "recording", record);
    run->log = cli_add_page_file(&run->page_files, "input log", log);
}

static bool begin_page_run(void *context, JoScene *scene, JoError *error) {
    const Run *run = context;
    return !run->folder || start_checkpoints(run, scene, count_run_steps(run, scene), error);
}

/* Runs the scene on the live page until a signal ends it; returns an exit status. */
static int run_on_page(Run *run, char **summary) {
    JoViewDef *live = &run->live;
    JoError error = {0};
    live->scene = run->def;
    live->watch = !run->no_watch;
    live->vetter = cli_keeper_vetter(run->keeper);
    live->record = run->record;
    live->record_every = run->record_every;
    live->log_input = run->log;
    live->stop = &cli_signal;
    live->opened = cli_print_address;
    live->writes = note_page_files;
    live->begun = begin_page_run;
    live->begun_context = run;
    live->breaks = run->breaks.items;
    live->break_count = run->breaks.count;
    live->summary = run->summary ? summary : NULL;
    live->seconds = run->has_seconds ? run->seconds : 0.0;
    const JoxOverlay *before = jox_overlay_use(&run->files);
    const bool shown = jo_view(live, &error);
    jox_overlay_use(before);
    cli_print_page_files(&run->page_files, run->quiet);
    if (shown)
        return JO_OK;
    return print_run_error(&error, error.code == JO_INPUT);
}

/* Runs the scene with several seeds, as a sweep of one variant; its file is in memory, or in the
   folder of the report. */
static int run_seeds(Run *run, char **summary) {
    JoSweepDef def = jo_default_sweep_def();
    JoSweepCounts counts;
    JoError error = {0};
    def.scene = run->def;
    def.seeds = (uint32_t)run->seeds;
    def.seconds = run->has_seconds ? run->seconds : def.seconds;
    def.steps = run->has_steps ? run->steps : 0;
    def.data = run->data;
    def.quiet = run->quiet;
    def.stop = &cli_signal;
    cli_catch_signals(true);
    JoxText kept = {0};
    if (run->report) {
        if (!cli_make_folder(&cli_run, run->report))
            return JO_FAILED;
        jox_text_printf(&kept, "%s/runs.sqlite", run->report);
        def.out = kept.data;
        def.renew = true;
    }
    const JoxOverlay *before = jox_overlay_use(&run->files);
    const bool good =
        jo_sweep(&def, &counts, run->report && !run->summary ? NULL : summary, &error);
    jox_overlay_use(before);
    int status = JO_OK; /* also after a signal, which sets the exit status later */
    if (!cli_signal) {
        run->troubled |= counts.troubled > 0;
        status = !good ? print_run_error(&error, false) : counts.failed ? JO_FAILED : JO_OK;
        if (good && run->report && counts.done + counts.failed) {
            const int page = cli_write_runs_page(&cli_run, kept.data, run->report,
                                                 &(JoReportHead){0}, run->quiet);
            status = status == JO_OK ? page : status;
        }
    }
    jox_text_free(&kept);
    return status;
}

/* Returns which options exclude each other; NULL: none. */
static const char *find_run_misuse(const Run *run) {
    const JoViewDef *live = &run->live;
    return run->has_seconds && run->has_steps ? "--for and --steps exclude each other"
           : run->seeds && (run->record || run->watch || run->log || run->has_trace || run->profile)
               ? "--seeds cannot be combined with --record, --log-input, --watch, --trace or "
                 "--profile-lua"
           : run->seeds && run->breaks.count ? "--seeds cannot be combined with --break"
           : run->seeds && run->has_steps && run->steps == 0 ? "--seeds goes with a step at least"
           : run->every > 0.0 && !run->folder ? "--checkpoint goes with --checkpoint-dir"
           : run->folder && !(run->every > 0.0) && (run->breaks.count == 0 || run->view)
               ? "--checkpoint-dir goes with --checkpoint, or with --break and without --view"
           : run->record_every > 0.0 && !run->record ? "--record-every goes with --record"
           : run->folder && run->seeds ? "--checkpoint cannot be combined with --seeds"
           : run->folder && !(fits_into_note(run->record) && fits_into_note(run->log) &&
                              fits_into_note(run->folder) && fits_into_note(run->report) &&
                              fits_into_note(run->data))
               ? "with --checkpoint, the paths of --record, --log-input, --report, --data and "
                 "--checkpoint-dir have no line breaks, and 4096 bytes at most"
           : run->view && (run->seeds || run->report || run->data || run->has_trace || run->profile)
               ? "--view cannot be combined with --seeds, --report, --data, --trace or "
                 "--profile-lua"
           : run->view && run->has_steps ? "--view goes with --for S, not with --steps"
           : !run->view && (live->address || live->page || live->fast || run->has_wait)
               ? "--fast, --view-wait, --view-address and --page go with --view"
               : NULL;
}

/* Vets the scene, then runs it in the way that the options ask for; returns an exit status. */
static int vet_and_run(Run *run) {
    run->watch |= isatty(2) && !run->no_watch && !run->seeds && !run->def.input_log;
    char *summary = NULL;
    if (run->view && !check_summary_path(run))
        return JO_FAILED;
    cli_catch_signals(false);
    int status = run->trusted ? JO_OK : cli_vet(&cli_run, &run->def, &run->files, NULL);
    const char *outputs[] = {run->record, run->log, run->summary};
    const char *inputs[] = {run->def.path, run->def.input_log};
    if (status == JO_OK)
        status = cli_check_apart(&cli_run, outputs, 3, inputs, 2, &run->files);
    if (status != JO_OK)
        return status;
    if (!run->trusted && (run->watch || run->view) &&
        !(run->keeper = cli_keeper_begin(&cli_run, &run->def, &run->files)))
        return JO_FAILED;
    cli_limit_work(run->trusted);
    cli_catch_signals(run->view);
    status = run->view    ? run_on_page(run, &summary)
             : run->seeds ? run_seeds(run, &summary)
                          : run_once(run);
    if (summary && (run->summary || run->seeds)) {
        int written = cli_write(&cli_run, run->summary ? run->summary : "-", summary);
        status = status ? status : written;
    }
    jo_free(summary);
    status = status == JO_OK && run->troubled ? JO_FAILED : status;
    return cli_add_signal_status(status);
}

static int run_run(int argc, char **argv) {
    Run run = {.def = jo_default_scene_def(), .live = jo_default_view_def()};
    run.live.wait = 5.0;
    CliList plain = {0};
    int status = cli_parse(&cli_run, argc, argv, &run, &plain);
    if (status == CLI_GO_ON) {
        const char *why = find_run_misuse(&run);
        run.def.path = why ? NULL : cli_scene(&cli_run, plain.items[0], &run.mods);
        run.def.overrides = run.sets.items;
        run.def.override_count = run.sets.count;
        run.def.mods = run.mods.items;
        run.def.mod_count = run.mods.count;
        run.def.resumable = run.folder != NULL;
        run.def.no_density = !run.summary && !run.seeds && !run.view && !run.report && !run.data;
        status = why             ? cli_report_misuse(&cli_run, why)
                 : !run.def.path ? JO_INPUT
                                 : vet_and_run(&run);
    }
    cli_keeper_end(run.keeper);
    jox_overlay_free(&run.files);
    cli_free(&cli_run, &run, &plain);
    return status;
}

const CliCommand cli_run = {
    .name = "run",
    .what = "simulate a scene",
    .usage = "SCENE [options]",
    .about = "SCENE is a file, or the name of one in this folder, in scenes/, in scenes/ of a mod "
             "of --mod, or among those that came with Jostle, of which `jostle` lists some. "
             "MOD:NAME names a scene of that mod.",
    .notes = "exit status: 0 done, 1 the run failed, people were lost (`guard` of the scene), "
             "walls keep people from their goal, or a function of a behaviour failed in a tenth of "
             "its calls or more, or 100 times within a second, which suspends it, and was not "
             "corrected and reloaded, or no breakpoint was met (the run still goes on to its end), "
             "or a criterion of the scene "
             "is not met (with --seeds: the summary has the share of seeds that meet it), "
             "2 wrong usage, 3 bad "
             "input, also a mod that is asked for and is missing or does not load; 129, 130 and "
             "143: SIGHUP, SIGINT or SIGTERM ended it early, also with --view; its files and "
             "figures are whole up to there. A second signal ends it at once",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "scene",
    .least = 1,
    .most = 1,
    .run = run_run,
};
