/* The command `bench`: times the steps of scenes, by stage. Each measurement loads the scene anew.
   Rounds alternate between all scenes, instruction sets and numbers of threads, so that other load
   on the machine affects all alike. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/mem.h"
#include "base/process_memory.h"
#include "cli/bench/bench.h"
#include "cli/cli.h"

enum { MOST_SETS = 5, MOST_ISAS = 4, MOST_THREADS = 64, SCALING_ROUNDS = 5 };

/* Sets the number of people of one-way.yaml, and the width of its field. */
#define FIELD(people, width)                                                                       \
    "groups.people.count=" people, "bounds.1.0=" width, "places.field.polygon.1.0=" width,         \
        "places.field.polygon.2.0=" width, "places.eastward.line.1.0=" width
#define ONE_WAY "scenes/one-way.yaml"
#define COUNTERFLOW "scenes/counterflow.yaml"

/* The named cases: a mark "*" if it is timed by default, the name, a scene, and values set in it.
   The help lists the first three. */
#define NAMES(X)                                                                                   \
    X("*", "tawaf", "scenes/tawaf.yaml", 0)                                                        \
    X(" ", "two-bottlenecks", "scenes/two-bottlenecks.yaml", 0)                                    \
    X(" ", "two-bottlenecks-full", "scenes/two-bottlenecks-full.yaml", 0)                          \
    X(" ", "wall-breaking", "scenes/wall-breaking.yaml", 0)                                        \
    X(" ", "office", "scenes/office.yaml", 0)                                                      \
    X("*", "dodgeball-500", "scenes/dodgeball-500.yaml", 0)                                        \
    X("*", "running-through", "scenes/running-through.yaml", 0)                                    \
    X("*", "circle", "scenes/circle.yaml", 0)                                                      \
    X(" ", "one-way-3", ONE_WAY, 0)                                                                \
    X(" ", "one-way-6", ONE_WAY, "groups.people.count=20400")                                      \
    X(" ", "counterflow-3", COUNTERFLOW, "groups.eastward.count=2450",                             \
      "groups.westward.count=2450", "groups.eastward.spacing=0.8", "groups.westward.spacing=0.8")  \
    X(" ", "counterflow-6", COUNTERFLOW, 0)                                                        \
    X(" ", "arena", "scenes/arena.yaml", 0)                                                        \
    X(" ", "scale-1k", ONE_WAY, FIELD("1000", "9.8"))                                              \
    X(" ", "scale-10k", ONE_WAY, FIELD("10000", "98"))                                             \
    X(" ", "scale-100k", ONE_WAY, FIELD("100000", "980"))                                          \
    X(" ", "scale-1m", ONE_WAY, FIELD("1000000", "9800"))

/* Named cases of many worlds: mark, name, number of worlds, people in each. */
#define WORLDS(X)                                                                                  \
    X(" ", "worlds-of-2", 500, 2)                                                                  \
    X(" ", "worlds-of-20", 200, 20)

typedef struct Named {
    const char *mark, *name, *path, *sets[MOST_SETS];
    BenchWorlds worlds; /* used if path is NULL */
} Named;
#define X(mark, name, path, ...) {mark, name, path, {__VA_ARGS__}, {0, 0}},
#define Y(mark, name, count, people) {mark, name, NULL, {NULL}, {count, people}},
static const Named NAMED[] = {NAMES(X) WORLDS(Y)};
#undef X
#undef Y
enum { NAMED_COUNT = sizeof NAMED / sizeof *NAMED };

typedef struct Bench {
    BenchGiven given; /* must be first; the results name it */
    JoIsa isas[MOST_ISAS];
    size_t isa_count;
    uint32_t threads[BENCH_THREADS];
    size_t thread_count;
    bool json, trusted, has_rounds;
    const char *csv, *plot;
} Bench;

/* Reads one or more instruction sets, separated by commas. */
static bool read_isas(void *options, const char *text, char why[160]) {
    Bench *bench = options;
    bench->isa_count = 0;
    for (const char *at = text; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
        if (bench->isa_count == MOST_ISAS) {
            snprintf(why, 160, "takes at most %d instruction sets", MOST_ISAS);
            return false;
        }
        char name[16];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at, ","), at);
        if (!cli_read_isa(&bench->isas[bench->isa_count++], name, why))
            return false;
    }
    return true;
}

/* Reads one or more numbers of threads, separated by commas. */
static bool read_threads(void *options, const char *text, char why[160]) {
    Bench *bench = options;
    bench->thread_count = 0;
    for (const char *at = text;; at++) {
        char *end = NULL;
        const bool digit = *at >= '0' && *at <= '9';
        const unsigned long number = digit ? strtoul(at, &end, 10) : 0;
        if (number < 1 || number > MOST_THREADS || (*end && *end != ',')) {
            snprintf(why, 160, "takes numbers from 1 to %d, separated by commas", MOST_THREADS);
            return false;
        }
        for (size_t k = 0; k < bench->thread_count; k++)
            if (bench->threads[k] == number) {
                snprintf(why, 160, "has the number %lu twice", number);
                return false;
            }
        if (bench->thread_count == BENCH_THREADS) {
            snprintf(why, 160, "takes at most %d numbers of threads", BENCH_THREADS);
            return false;
        }
        bench->threads[bench->thread_count++] = (uint32_t)number;
        if (!*end)
            return true;
        at = end;
    }
}

static const CliOption OPTIONS[] = {
    {"steps", "N", "timed steps of each scene", "200", CLI_TO(Bench, given.steps),
     CLI_RANGE(1, 1e6)},
    {"warm-up", "N", "steps before timing begins", "100", CLI_TO(Bench, given.warm_up),
     CLI_RANGE(0, 1e6)},
    {"rounds", "N", "rounds; each round times all scenes in turn",
     "1; 5 with several numbers of threads", CLI_TO(Bench, given.rounds),
     CLI_GIVEN(Bench, has_rounds), CLI_RANGE(1, BENCH_ROUNDS)},
    {"threads", "N",
     "threads. Several numbers, as 1,2,4, are timed in turn; a table then has the times of each "
     "stage with each number, and speed-up and efficiency against the first. More threads than "
     "the machine has processors are marked, as no measure",
     "1", .kind = CLI_READ, .read = read_threads},
    {"isa", "NAMES",
     "instruction sets of the kernels, separated by commas: scalar, sse2, avx2, avx512 or neon; "
     "results never depend on them",
     "the widest that the machine runs", .kind = CLI_READ, .read = read_isas},
    {"json", NULL, "print a JSON array of objects instead of the table", CLI_TO(Bench, json)},
    {"csv", "FILE",
     "append a line for each scene and instruction set to this CSV file; with several numbers of "
     "threads a line for each number and stage",
     CLI_TO(Bench, csv), .writes = "csv txt"},
    {"commit", "NAME", "name of the timed version in these lines", "the version",
     CLI_TO(Bench, given.commit)},
    {"plot", "DIR", "draw DIR/bench.svg: the scenes as bars, those named scale-... as a curve",
     CLI_TO(Bench, plot), .writes = "folder"},
    CLI_TRUSTED_OPTION(Bench),
};

/* ---- measuring ---- */

/* Measures one round of a case; returns an exit status. */
static int measure_case(const Bench *bench, const Named *named, BenchCase *c) {
    JoError error = {0};
    if (named && !named->path) {
        const int status = bench_worlds(&named->worlds, &bench->given, c, &error);
        return status == JO_OK ? JO_OK : cli_report_error(&cli_bench, &error, false);
    }
    JoSceneDef def = jo_default_scene_def();
    def.path = c->path;
    def.threads = c->threads;
    def.isa = c->isa;
    if (named) {
        def.overrides = named->sets;
        while (def.override_count < MOST_SETS && named->sets[def.override_count])
            def.override_count++;
    }
    bench_return_memory();
    const uint64_t resident = jox_read_process_memory().resident;
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene)
        return (int)error.code;
    bool ok = true;
    for (uint64_t i = 0; ok && i < bench->given.warm_up; i++)
        ok = jo_scene_step(scene, &error);
    JoStats from = jo_scene_stats(scene);
    const double busy = bench_read_busy_time();
    const double wall = jox_clock_wall(), cpu = jox_clock_cpu();
    for (uint64_t i = 0; ok && i < bench->given.steps; i++)
        ok = jo_scene_step(scene, &error);
    const double wall_end = jox_clock_wall(), cpu_end = jox_clock_cpu();
    const double others = bench_read_busy_time() - busy - (cpu_end - cpu);
    c->others[c->measured] = busy < 0.0 ? -1.0 : fmax(0.0, others / (wall_end - wall));
    JoStats to = jo_scene_stats(scene);
    const uint64_t resident_end = jox_read_process_memory().resident;
    if (!c->measured && resident && resident_end > resident)
        c->resident = resident_end - resident;
    c->hash = ok ? jo_world_hash(jo_scene_world(scene)) : 0;
    jo_scene_free(scene);
    if (!ok)
        return cli_report_error(&cli_bench, &error, false);
    bench_note(c, &from, &to, wall_end - wall, cpu_end - cpu);
    return JO_OK;
}

/* ---- the command ---- */

static const Named *find_named_case(const char *name) {
    for (size_t k = 0; k < NAMED_COUNT; k++)
        if (strcmp(NAMED[k].name, name) == 0)
            return &NAMED[k];
    return NULL;
}

/* Finds the file of each name; NULL for cases of many worlds. Returns false with a message if there
   is none. */
static bool find_paths(const char *const *names, size_t count, const char **paths) {
    const char *all[NAMED_COUNT];
    char hint[JOX_HINT];
    for (size_t k = 0; k < NAMED_COUNT; k++)
        all[k] = NAMED[k].name;
    for (size_t n = 0; n < count; n++) {
        const Named *named = find_named_case(names[n]);
        paths[n] = named ? named->path : names[n];
        if (named && !named->path)
            continue;
        if (named && access(paths[n], F_OK) != 0) { /* not in a checkout: use the installed scene */
            char stem[64];
            const char *file = jox_path_name(paths[n]);
            snprintf(stem, sizeof stem, "%.*s", (int)jox_path_stem(file), file);
            paths[n] = cli_scene(&cli_bench, stem, NULL);
        } else if (!named && access(paths[n], F_OK) != 0 && !cli_is_scene(names[n]) &&
                   jox_did_you_mean(names[n], all, NAMED_COUNT, hint)) {
            return cli_report_unknown(&cli_bench, "scene", names[n], all, NAMED_COUNT) == JO_OK;
        } else if (!named) {
            paths[n] = cli_scene(&cli_bench, names[n], NULL);
        }
        if (!paths[n])
            return false;
    }
    return true;
}

/* Writes the results in the formats asked for, after all rounds. */
static int write_bench_results(const Bench *bench, const BenchCase *cases, size_t count) {
    if (bench->json) {
        cli_output_is_data();
        bench_json(&bench->given, cases, count);
    }
    const bool good = !bench->csv || (bench->thread_count > 1
                                          ? bench_scaling_csv(bench->csv, &bench->given, cases,
                                                              count, bench->thread_count)
                                          : bench_csv(bench->csv, &bench->given, cases, count));
    if (!good) {
        fprintf(stderr, "jostle bench: cannot write '%s': %s\n", bench->csv,
                errno == EEXIST ? "it has lines of other columns" : strerror(errno));
        return JO_FAILED;
    }
    JoError error = {0};
    if (bench->plot && !bench_plot(bench->plot, cases, count, &error))
        return cli_report_error(&cli_bench, &error, false);
    return JO_OK;
}

/* Refuses results that depend on the number of threads, which they never may. */
static int check_hashes(const BenchCase *cases, size_t count) {
    for (size_t k = 1; k < count; k++)
        if (cases[k].hash != cases->hash) {
            fprintf(stderr,
                    "jostle bench: %s ends in the state %016llx with %u threads, and in %016llx "
                    "with %u: this is a fault of the program, and the times are no measure\n",
                    cases->name, (unsigned long long)cases->hash, cases->threads,
                    (unsigned long long)cases[k].hash, cases[k].threads);
            return JO_FAILED;
        }
    return JO_OK;
}

/* Prints the table of each scene and instruction set, over all numbers of threads. */
static int print_scaling(const Bench *bench, const BenchCase *cases, size_t total) {
    int status = JO_OK;
    for (size_t k = 0; status == JO_OK && k < total; k += bench->thread_count) {
        status = check_hashes(&cases[k], bench->thread_count);
        if (status == JO_OK && !bench->json)
            bench_scaling(&bench->given, &cases[k], bench->thread_count);
    }
    return status;
}

/* Measures all cases, round by round; the table shows each case after its last round. */
static int bench_all(Bench *bench, const char *const *names, const char *const *paths,
                     size_t count) {
    const size_t each = bench->isa_count * bench->thread_count, total = count * each;
    const bool scales = bench->thread_count > 1, lines = !bench->json && !scales;
    const bool shows = scales && isatty(2);
    BenchCase *cases = jox_alloc(total, sizeof *cases);
    int status = JO_OK;
    for (size_t k = 0; k < total; k++)
        cases[k] = (BenchCase){.name = names[k / each],
                               .path = paths[k / each],
                               .isa = bench->isas[k / bench->thread_count % bench->isa_count],
                               .threads = bench->threads[k % bench->thread_count]};
    if (lines)
        bench_header();
    for (uint64_t round = 0; round < bench->given.rounds; round++)
        for (size_t k = 0; status == JO_OK && k < total; k++) {
            if (shows)
                fprintf(stderr, "\r\033[Kround %llu of %llu, %u threads",
                        (unsigned long long)round + 1, (unsigned long long)bench->given.rounds,
                        cases[k].threads);
            status = measure_case(bench, find_named_case(cases[k].name), &cases[k]);
            if (status == JO_OK && lines && round + 1 == bench->given.rounds)
                bench_line(&cases[k]);
        }
    if (shows)
        fputs("\r\033[K", stderr);
    if (status == JO_OK && scales)
        status = print_scaling(bench, cases, total);
    if (status == JO_OK && lines)
        bench_ratios(cases, total, bench->isa_count);
    if (status == JO_OK)
        status = write_bench_results(bench, cases, total);
    jox_free(cases);
    return status;
}

/* Whether several numbers of threads make sense for these scenes; false with a message. */
static bool may_scale(const Bench *bench, const char *const *names, const char *const *paths,
                      size_t count) {
    for (size_t n = 0; bench->thread_count > 1 && n < count; n++)
        if (!paths[n]) {
            fprintf(stderr, "jostle bench: the worlds of '%s' are stepped in turn, by one thread\n",
                    names[n]);
            return false;
        }
    return true;
}

static void confine_bench(const Bench *bench, const char *const *paths, size_t count) {
    CliReach reach = {.programs = bench->plot != NULL}; /* gnuplot draws the plot */
    for (size_t n = 0; n < count; n++)
        cli_reach_scene(&reach, paths[n]);
    cli_reach_output(&reach, bench->csv);
    cli_reach_output(&reach, bench->plot);
    cli_reach_folder(&reach, "/proc/cpuinfo");    /* has the processor's name */
    cli_reach_folder(&reach, "/proc/self/statm"); /* has the resident memory */
    cli_reach_folder(&reach, "/proc/stat");       /* has the load of the machine */
    cli_confine_work(&reach, bench->trusted);
}

static int run_bench(int argc, char **argv) {
    Bench bench = {.given = {200, 100, 1, jo_version(), jo_count_processors()},
                   .threads = {1},
                   .thread_count = 1};
    CliList names = {0};
    const char *marked[NAMED_COUNT];
    size_t marked_count = 0;
    for (size_t k = 0; k < NAMED_COUNT; k++)
        if (NAMED[k].mark[0] == '*')
            marked[marked_count++] = NAMED[k].name;
    bench.isas[0] = JO_ISA_WIDEST;
    bench.isa_count = 1;
    int status = cli_parse(&cli_bench, argc, argv, &bench, &names);
    if (status == CLI_GO_ON && bench.thread_count > 1 && bench.plot)
        status = cli_report_misuse(&cli_bench, "--plot goes with one number of threads");
    if (status == CLI_GO_ON) {
        static const char *const tawaf[] = {"tawaf"};
        const bool scales = bench.thread_count > 1;
        const char *const *asked = names.count ? names.items : scales ? tawaf : marked;
        const size_t count = names.count ? names.count : scales ? 1 : marked_count;
        if (scales && !bench.has_rounds)
            bench.given.rounds = SCALING_ROUNDS;
        const char **paths = jox_alloc(count, sizeof *paths);
        status = JO_INPUT;
        if (find_paths(asked, count, paths) && may_scale(&bench, asked, paths, count)) {
            confine_bench(&bench, paths, count);
            status = bench_all(&bench, asked, paths, count);
        }
        jox_free(paths);
    }
    cli_free(&cli_bench, &bench, &names);
    return status;
}

#define X(mark, name, path, ...) "  " mark " " name " (" path ")\n"
#define Y(mark, name, count, people)                                                               \
    "  " mark " " name " (" #count " worlds of " #people " people and a ball)\n"
const CliCommand cli_bench = {
    .name = "bench",
    .what = "time the steps of scenes",
    .usage = "[NAME|SCENE...] [--rounds N] [--steps N] [--isa NAMES] [--json]",
    .about = "Times the steps of scenes by stage, without drawing or recording. A scene is a file, "
             "or one of\nthese names, some of which also set values:\n" NAMES(X)
                 WORLDS(Y) "Without arguments, the names marked by a star are timed; with several "
                           "numbers of threads the Tawaf. Times of several threads need a machine "
                           "without other work: rounds alternate between the numbers, so that the "
                           "rest of the machine affects all alike.",

    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "scene",
    .run = run_bench,
};
#undef X
#undef Y
