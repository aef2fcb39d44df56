/* The command `resume`: continues a run from its newest checkpoint, in the same files. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/format/path.h"
#include "base/mem.h"
#include "base/text.h"
#include "cli/cli.h"

typedef struct Resume {
    JoSceneDef def;
    const char *summary;
    double seconds;
    bool has_seconds, quiet, trusted;
} Resume;

static bool read_resume_isa(void *options, const char *text, char why[160]) {
    return cli_read_isa(&((Resume *)options)->def.isa, text, why);
}

static const CliOption OPTIONS[] = {
    {"for", "S", "simulate until S seconds from the beginning of the run", "the end of that run",
     CLI_TO(Resume, seconds), CLI_GIVEN(Resume, has_seconds), CLI_RANGE(0, 1e7)},
    {"threads", "N", "number of threads; results never depend on it", "all processors",
     CLI_TO(Resume, def.threads), CLI_RANGE(1, 64)},
    CLI_ISA_OPTION(read_resume_isa),
    {"summary", "FILE", "write the figures of the whole run as JSON; '-' is standard output",
     CLI_TO(Resume, summary), .writes = "json txt"},
    {"quiet", NULL, "print no progress, and no closing paragraph", CLI_TO(Resume, quiet)},
    {"trusted", NULL,
     "trust the checkpoint: read and write whatever it names. Without it the command reaches only "
     "the checkpoint's folder and the one above, and what lies below the working folder, and "
     "connects to nothing",
     CLI_TO(Resume, trusted)},
};

/* Confines the process to the surroundings of the checkpoint. The checkpoint names the paths of
   recording, log and checkpoints, and one of unknown origin may name anything. */
static void confine_resume(const Resume *resume, const char *path) {
    CliReach reach = {.programs = true}; /* gnuplot draws a report's pictures */
    JoxText above = {0};
    struct stat info;
    const bool folder = stat(path, &info) == 0 && S_ISDIR(info.st_mode);
    const size_t length = folder ? strlen(path) : jox_path_folder(path);
    if (length) {
        jox_text_printf(&above, "%.*s/..", (int)length, path);
        cli_reach_output(&reach, above.data);
    }
    cli_reach_output(&reach, path);
    cli_reach_output(&reach, ".");
    cli_reach_output(&reach, resume->summary);
    cli_confine_work(&reach, resume->trusted);
    jox_text_free(&above);
}

/* Returns the value of a line "key value" of the checkpoint's note, to be freed; NULL if there is
   none. */
static char *find_note_value(const char *note, const char *key) {
    const size_t n = strlen(key);
    for (const char *line = note; line && *line;) {
        const char *end = strchr(line, '\n');
        if (strncmp(line, key, n) == 0 && line[n] == ' ' && end)
            return jox_strndup(line + n + 1, (size_t)(end - line) - n - 1);
        line = end ? end + 1 : NULL;
    }
    return NULL;
}

/* Continues the run to its end, in the files that the note names; returns an exit status. */
static int continue_run(const Resume *resume, JoScene *scene, const char *note) {
    JoError error = {0};
    char *record = find_note_value(note, "record"), *log = find_note_value(note, "log"),
         *steps = find_note_value(note, "steps");
    char *every = find_note_value(note, "every"), *folder = find_note_value(note, "folder");
    char *report = find_note_value(note, "report"), *data = find_note_value(note, "data");
    char *no_half = find_note_value(note, "no-half");
    char *all_steps = find_note_value(note, "all-steps"); /* a game goes on after its round */
    const double dt = jo_scene_stats(scene).dt;
    const uint64_t until = resume->has_seconds ? (uint64_t)(resume->seconds / dt + 0.5)
                           : steps             ? strtoull(steps, NULL, 10)
                                               : (uint64_t)(jo_scene_duration(scene) / dt + 0.5);
    bool ok = (!record || jo_scene_record_on(scene, record, &error)) &&
              (!report || jo_scene_report(scene, report, &error)) &&
              (!data || jo_scene_data(scene, data, &error)) &&
              (!log || jo_scene_log_on(scene, log, &error)) &&
              (!folder || !every ||
               jo_scene_checkpoint(scene, folder, strtod(every, NULL), note, &error));
    const bool begun = ok;
    CliRunFiles files = {.data = data, .record = record, .log = log, .checkpoints = folder};
    cli_catch_signals(true);
    if (!resume->quiet && begun) {
        fprintf(stderr, "resumed at %g s\n", jo_world_time(jo_scene_world(scene)));
        jo_scene_show_progress(scene, (double)until * dt);
    }
    while (ok && jo_world_tick(jo_scene_world(scene)) < until && !cli_signal &&
           (resume->has_seconds || all_steps || !jo_scene_over(scene)))
        ok = jo_scene_step(scene, &error);
    int status = cli_finish_run(&cli_resume, scene, ok, &error, &files);
    if (status == JO_OK && report) {
        status = cli_write_report_page(&cli_resume, &(CliReportPage){.folder = report,
                                                                     .def = &resume->def,
                                                                     .scene = scene,
                                                                     .steps = until,
                                                                     .no_half = no_half != NULL,
                                                                     .quiet = resume->quiet});
        files.report = status == JO_OK ? report : NULL;
    }
    if (!begun && !resume->trusted)
        fputs("jostle resume: if it was written neither beside its checkpoints nor below the "
              "working folder, it goes on there with --trusted\n",
              stderr);
    char *summary = begun && resume->summary ? jo_scene_summary(scene) : NULL;
    if (summary) {
        const int written = cli_write(&cli_resume, resume->summary, summary);
        files.summary = written == JO_OK ? resume->summary : NULL;
        status = status ? status : written;
    }
    jo_free(summary);
    if (cli_print_troubles(&cli_resume, scene) && status == JO_OK)
        status = JO_FAILED;
    if (begun && !resume->quiet)
        cli_print_closing(scene, &files);
    char *const taken[] = {record, log, steps, every, folder, report, data, no_half, all_steps};
    for (size_t t = 0; t < sizeof taken / sizeof *taken; t++)
        jox_free(taken[t]);
    return status;
}

static int resume_checkpoint(Resume *resume, const char *path) {
    JoError error = {0};
    char *note = NULL;
    if (resume->summary && cli_check_writable(&cli_resume, resume->summary) != JO_OK)
        return JO_FAILED;
    cli_catch_signals(false);
    confine_resume(resume, path);
    JoScene *scene = jo_scene_resume(&resume->def, path, &note, &error);
    if (!scene)
        return cli_report_error(&cli_resume, &error, false);
    int status = continue_run(resume, scene, note);
    jo_free(note);
    jo_scene_free(scene);
    return cli_add_signal_status(status);
}

static int run_resume(int argc, char **argv) {
    Resume resume = {.def = jo_default_scene_def()};
    CliList plain = {0};
    int status = cli_parse(&cli_resume, argc, argv, &resume, &plain);
    if (status == CLI_GO_ON)
        status = resume_checkpoint(&resume, plain.items[0]);
    cli_free(&cli_resume, &resume, &plain);
    return status;
}

const CliCommand cli_resume = {
    .name = "resume",
    .what = "continue a run from its checkpoint",
    .usage = "CHECKPOINT [options]",
    .about = "CHECKPOINT is a file that `jostle run --checkpoint` wrote, or the folder of such "
             "files, which means the newest whole one. The run continues bit for bit, in the same "
             "recording, input log, report and data files, and writes further checkpoints. Scene, "
             "behaviours, mods and plans are those in the checkpoint, not those on the disk now; "
             "the folder of a mod must still be there.",
    .notes =
        "exit status: as for `jostle run`; 3: the checkpoint is damaged, or of another version",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "checkpoint",
    .least = 1,
    .most = 1,
    .run = run_resume,
};
