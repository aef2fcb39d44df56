/* The command `compare`: runs the scenes among its arguments, measures the recordings, and compares
   all sides by jo_compare. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "base/format/path.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/text.h"
#include "cli/cli.h"

typedef enum Kind { SCENE, SWEEP, RECORDING, FOLDER } Kind;

typedef struct Compare {
    JoCompareDef def;
    CliList labels;
    const char *json, *scene; /* scene: its probes measure recordings */
    double confidence, seconds;
    uint64_t seeds, seed, resamples; /* seed: the first */
    uint32_t jobs;
    JoxOverlay files; /* vetted files of the scene that is run */
    bool has_seconds, has_seed, quiet, trusted;
    char **sides;   /* paths: recordings, and files of sweeps */
    char **folders; /* by side: folder whose recordings form one side, or NULL */
    Kind *kinds;
    char **summaries;
    size_t count, capacity, folder_capacity, kind_capacity;
} Compare;

static bool read_compare_unit(void *options, const char *text, char why[160]) {
    return cli_read_unit(&((Compare *)options)->def.unit, text, why);
}

static const CliOption OPTIONS[] = {
    {"out", "DIR",
     "write a page, index.html, with curves, plans and all figures, and the files with the runs of "
     "scenes",
     CLI_TO(Compare, def.out), .writes = "folder"},
    {"json", "FILE",
     "write every figure of every side as JSON; '-' writes to standard output instead of the table",
     CLI_TO(Compare, json), .writes = "json txt"},
    {"base", "SIDE",
     "the side that the others are compared with: a number from 1, a name or a file", "the first",
     CLI_TO(Compare, def.base)},
    {"label", "NAME",
     "name of a side; give it once for each side, in order. In a sweep each variant is a side, and "
     "the last setting varies fastest",
     CLI_TO(Compare, labels)},
    {"percentile", "P",
     "also print the value above P % of all runs, as MSC.1/Circ.1533 defines the 95 % value, the "
     "worst case, and a bound of the true value",
     CLI_TO(Compare, def.percentile), CLI_RANGE(1, 99.9)},
    {"confidence", "P", "confidence of intervals, %", "95", CLI_TO(Compare, confidence),
     CLI_RANGE(50, 99.99)},
    {"bootstrap", "N", "compute intervals from N bootstrap samples instead of Student's t",
     CLI_TO(Compare, resamples), CLI_RANGE(100, 1000000)},
    {"all", NULL, "show all figures in the table, not only key figures", CLI_TO(Compare, def.all)},
    {"seeds", "N", "scenes only: seeds of each", "10", CLI_TO(Compare, seeds), CLI_RANGE(1, 10000)},
    {"seed", "N", "scenes only: first seed", "1", CLI_TO(Compare, seed),
     CLI_GIVEN(Compare, has_seed)},
    {"for", "S", "scenes only: simulate S seconds", "the scene's duration",
     CLI_TO(Compare, seconds), CLI_GIVEN(Compare, has_seconds), CLI_RANGE(0, 1e7)},
    {"jobs", "N", "scenes only: processes at once", "one for each processor", CLI_TO(Compare, jobs),
     CLI_RANGE(1, 1000)},
    {"scene", "SCENE", "recordings only: measure with the `probes` of this scene",
     CLI_TO(Compare, scene)},
    {"fps", "N", "recordings only: frames per second, if the file does not say",
     CLI_TO(Compare, def.fps), CLI_RANGE(0.01, 10000)},
    {"unit", "m|cm", "recordings only: unit of lengths, if the file does not say", .kind = CLI_READ,
     .read = read_compare_unit},
    CLI_TRUSTED_OPTION(Compare),
    {"quiet", NULL, "print no progress", CLI_TO(Compare, quiet)},
};

/* ---- finding the sides ---- */

/* Returns what an argument is; a path that does not exist may name a scene. */
static Kind find_side_kind(const char *path) {
    const char *dot = strrchr(path, '.');
    struct stat status;
    if (stat(path, &status) == 0 && S_ISDIR(status.st_mode))
        return FOLDER;
    if (access(path, R_OK) != 0 || (dot && (!strcmp(dot, ".yaml") || !strcmp(dot, ".yml"))))
        return SCENE;
    return cli_is_sweep(path) ? SWEEP : RECORDING;
}

static void add_side(Compare *compare, Kind kind, char *path, const char *folder) {
    const size_t n = compare->count++;
    JOX_RESERVE(compare->sides, compare->capacity, n + 1);
    JOX_RESERVE(compare->folders, compare->folder_capacity, n + 1);
    JOX_RESERVE(compare->kinds, compare->kind_capacity, n + 1);
    compare->sides[n] = path;
    compare->folders[n] = folder ? jox_strdup(folder) : NULL;
    compare->kinds[n] = kind;
}

static bool is_named_as_recording(const char *name) {
    static const char *const endings[] = {".sqlite", ".txt", ".csv"};
    const char *dot = strrchr(name, '.');
    for (size_t e = 0; dot && e < sizeof endings / sizeof *endings; e++)
        if (strcmp(dot, endings[e]) == 0)
            return true;
    return false;
}

/* Adds the recordings of a folder as the runs of one side. */
static int add_recordings_of_folder(Compare *compare, const char *given) {
    JoxText folder = {0};
    size_t length = strlen(given);
    while (length > 1 && given[length - 1] == '/')
        length--;
    jox_text_append(&folder, given, length);
    const size_t before = compare->count;
    char **names = jox_folder_names(folder.data, false);
    for (char **name = names; name && *name; name++) {
        JoxText path = {0};
        jox_text_printf(&path, "%s/%s", folder.data, *name);
        if (is_named_as_recording(*name) && find_side_kind(path.data) == RECORDING)
            add_side(compare, RECORDING, path.data, folder.data);
        else
            jox_text_free(&path);
    }
    jox_free(names);
    jox_text_free(&folder);
    if (compare->count > before)
        return JO_OK;
    JoError error = {0};
    jox_error(
        &error, JO_INPUT,
        "the folder '%.300s' has no recordings: files .sqlite, .txt or .csv, each of which is "
        "a run of one side",
        given);
    return cli_report_error(&cli_compare, &error, false);
}

static bool vet_compared_scene(void *context, const JoSceneDef *scene, JoError *error) {
    Compare *compare = context;
    return cli_vet(&cli_compare, scene, &compare->files, error) == JO_OK;
}

/* Runs the missing seeds of a scene, kept in a file of the output folder. Returns an exit status;
 *out is the file's path, to be freed. */
static int sweep_scene(Compare *compare, const char *given, char **out) {
    JoSweepDef sweep = jo_default_sweep_def();
    JoSweepCounts counts;
    JoError error = {0};
    const char *path = cli_scene(&cli_compare, given, NULL);
    if (!path)
        return JO_INPUT;
    const char *file = jox_path_name(path);
    JoxText keeps = {0};
    jox_text_printf(&keeps, "%s/%.*s.sqlite", compare->def.out, (int)jox_path_stem(file), file);
    sweep.scene.path = path;
    sweep.seeds = (uint32_t)compare->seeds;
    sweep.jobs = compare->jobs;
    sweep.out = keeps.data;
    sweep.quiet = compare->quiet;
    sweep.stop = &cli_signal;
    sweep.vet = compare->trusted ? NULL : vet_compared_scene;
    sweep.vet_context = compare;
    if (compare->has_seed) {
        sweep.scene.has_seed = true;
        sweep.scene.seed = compare->seed;
    }
    if (compare->has_seconds)
        sweep.seconds = compare->seconds;
    if (!compare->quiet)
        fprintf(stderr, "%s:\n", path);
    const JoxOverlay *before = jox_overlay_use(&compare->files);
    const bool good = jo_sweep(&sweep, &counts, NULL, &error);
    jox_overlay_use(before);
    jox_overlay_free(&compare->files);
    *out = keeps.data;
    return good ? JO_OK : cli_report_error(&cli_compare, &error, false);
}

/* Adds all sides; runs the scenes among them first. */
static int add_sides_of_arguments(Compare *compare, const CliList *plain) {
    int status = JO_OK;
    for (size_t s = 0; s < plain->count && status == JO_OK && !cli_signal; s++) {
        const char *given = plain->items[s];
        const Kind kind = find_side_kind(given);
        char *path = NULL;
        if (kind == FOLDER)
            status = add_recordings_of_folder(compare, given);
        else if (kind != SCENE)
            add_side(compare, kind, jox_strdup(given), NULL);
        else if (!compare->def.out)
            status =
                cli_report_misuse(&cli_compare, "--out DIR says where the runs of scenes are kept");
        else if (!cli_make_folder(&cli_compare, compare->def.out))
            status = JO_FAILED;
        else if ((status = sweep_scene(compare, given, &path)) == JO_OK)
            add_side(compare, kind, path, NULL);
        else
            jox_free(path);
    }
    return status;
}

/* ---- the comparison ---- */

static void confine_compare(const Compare *compare) {
    CliReach reach = {.programs = true}; /* gnuplot draws pictures */
    for (size_t s = 0; s < compare->count; s++)
        cli_reach_file(&reach, compare->sides[s]);
    cli_reach_scene(&reach, compare->scene);
    cli_reach_output(&reach, compare->def.out);
    cli_reach_output(&reach, compare->json);
    cli_confine_work(&reach, compare->trusted);
}

/* Measures each recording by jo_report; its JSON goes to `summaries`. */
static int measure_recordings(Compare *compare) {
    compare->summaries = jox_alloc(compare->count, sizeof *compare->summaries);
    for (size_t s = 0; s < compare->count; s++) {
        JoReportDef report = jo_default_report_def();
        JoError error = {0};
        if (compare->kinds[s] != RECORDING)
            continue;
        report.recording = compare->sides[s];
        report.scene = compare->scene;
        report.fps = compare->def.fps;
        report.unit = compare->def.unit;
        compare->summaries[s] = jo_report(&report, &error);
        if (!compare->summaries[s])
            return cli_report_error(&cli_compare, &error, error.code != JO_FAILED);
    }
    return JO_OK;
}

/* Compares the sides, prints the table, and writes the outputs. */
static int print_comparison(Compare *compare) {
    JoError error = {0};
    char *json = NULL;
    compare->def.sides = (const char *const *)compare->sides;
    compare->def.side_count = compare->count;
    compare->def.folders = (const char *const *)compare->folders;
    compare->def.summaries = (const char *const *)compare->summaries;
    char *text = jo_compare(&compare->def, compare->json ? &json : NULL, &error);
    if (!text)
        return cli_report_error(&cli_compare, &error, false);
    int status = compare->json ? cli_write(&cli_compare, compare->json, json) : JO_OK;
    if (!compare->json || strcmp(compare->json, "-") != 0) {
        fputs(text, stdout);
        if (compare->def.out)
            printf("\npage: %s/index.html\n", compare->def.out);
    }
    jo_free(text);
    jo_free(json);
    return status;
}

/* Runs, measures and compares the sides. Only the runs of scenes can be interrupted and
   continued. */
static int compare_arguments(Compare *c, const CliList *plain) {
    cli_limit_work(c->trusted);
    cli_catch_signals(true);
    int status = add_sides_of_arguments(c, plain);
    cli_catch_signals(false);
    if (status == JO_OK && !cli_signal) {
        confine_compare(c);
        status = measure_recordings(c);
        if (status == JO_OK)
            status = print_comparison(c);
    }
    return cli_signal ? cli_add_signal_status(JO_OK) : status;
}

/* Finds the scene whose probes measure recordings. */
static bool find_measuring_scene(Compare *c) {
    return !c->scene || (c->scene = cli_scene(&cli_compare, c->scene, NULL));
}

static int run_compare(int argc, char **argv) {
    Compare c = {.def = jo_default_compare_def(), .confidence = 95, .seeds = 10};
    CliList plain = {0};
    int status = cli_parse(&cli_compare, argc, argv, &c, &plain);
    if (status == CLI_GO_ON) {
        c.def.share = c.confidence / 100;
        c.def.resamples = (uint32_t)c.resamples;
        c.def.labels = (const char *const *)c.labels.items;
        c.def.label_count = c.labels.count;
        status = find_measuring_scene(&c) ? compare_arguments(&c, &plain) : JO_INPUT;
    }
    for (size_t s = 0; s < c.count; s++) {
        jox_free(c.sides[s]);
        jox_free(c.folders[s]);
        jo_free(c.summaries ? c.summaries[s] : NULL);
    }
    jox_free(c.sides);
    jox_free(c.folders);
    jox_free(c.kinds);
    jox_free(c.summaries);
    cli_free(&cli_compare, &c, &plain);
    return status;
}

const CliCommand cli_compare = {
    .name = "compare",
    .what = "compare variants of scenes, sweeps or recordings",
    .usage = "SIDE SIDE... [options]",
    .about = "A side is a variant in a file of `jostle sweep`, a scene, which is run first with "
             "--seeds, a recording, or a folder of recordings, which are its runs. Each figure of "
             "each side is compared with that of the first side: the difference of the means, and "
             "an interval that contains the true difference with a probability of 95 %. Runs with "
             "the same seed are compared in pairs. If the runs do not tell two sides apart, the "
             "output says so, and about how many seeds would.\n\nA recording is a single run, so a "
             "difference from it has no interval.",
    .notes =
        "exit status: 0 done, 1 writing failed, 2 wrong usage, 3 bad input; 129, 130 and 143: "
        "SIGHUP, SIGINT or SIGTERM ended it, and the same command continues the runs of scenes",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "side",
    .least = 1,
    .run = run_compare,
};
