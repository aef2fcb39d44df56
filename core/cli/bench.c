/* `jostle bench`: how long steps take, by stage. Each measurement loads a scene anew; rounds go
   over all scenes and instruction sets in turn, so that what else the machine does falls on all
   alike. */
#include <stdio.h>
#include <string.h>

#include "base/format/json_writer.h"
#include "base/mem.h"
#include "base/sort.h"
#include "cli/cli.h"

enum { MOST_SETS = 5, MOST_ISAS = 4, MOST_ROUNDS = 100 };

/* What has a name: a scene, and values set in it. */
typedef struct Named {
    const char *name, *path, *sets[MOST_SETS];
} Named;

/* A field of one-way.yaml for so many people. */
#define FIELD(people, width)                                                                       \
    "groups.people.count=" people, "bounds.1.0=" width, "places.field.polygon.1.0=" width,         \
        "places.field.polygon.2.0=" width, "places.eastward.line.1.0=" width

static const Named NAMED[] = {
    {"tawaf", "scenes/tawaf.yaml", {0}},
    {"two-bottlenecks", "scenes/two-bottlenecks.yaml", {0}},
    {"wall-breaking", "scenes/wall-breaking.yaml", {0}},
    {"office", "scenes/office.yaml", {0}},
    {"dodgeball-500", "scenes/dodgeball-500.yaml", {0}},
    {"running-through", "scenes/running-through.yaml", {0}},
    {"circle", "scenes/circle.yaml", {0}},
    {"one-way-3", "scenes/one-way.yaml", {0}},
    {"one-way-6", "scenes/one-way.yaml", {"groups.people.count=20400"}},
    {"counterflow-3",
     "scenes/counterflow.yaml",
     {"groups.eastward.count=2450", "groups.westward.count=2450", "groups.eastward.spacing=0.8",
      "groups.westward.spacing=0.8"}},
    {"counterflow-6", "scenes/counterflow.yaml", {0}},
    {"arena", "scenes/arena.yaml", {0}},
    {"scale-1k", "scenes/one-way.yaml", {FIELD("1000", "9.8")}},
    {"scale-10k", "scenes/one-way.yaml", {FIELD("10000", "98")}},
    {"scale-100k", "scenes/one-way.yaml", {FIELD("100000", "980")}},
    {"scale-1m", "scenes/one-way.yaml", {FIELD("1000000", "9800")}},
};
enum { NAMED_COUNT = sizeof NAMED / sizeof *NAMED };
/* What is timed where nothing is named. */
static const char *const STANDARD[] = {"tawaf", "dodgeball-500", "running-through", "circle"};

/* An instruction set, and what the user calls it. */
typedef struct Isa {
    char name[16];
    JoIsa isa;
} Isa;

typedef struct Bench {
    uint64_t steps, warm_up, rounds;
    uint32_t threads;
    Isa isas[MOST_ISAS];
    size_t isa_count;
    bool json;
    JoxText text; /* the array that is being written */
    JoxJson array;
} Bench;

/* One or more instruction sets, with commas between. */
static bool read_isas(void *options, const char *text, char why[160]) {
    Bench *bench = options;
    bench->isa_count = 0;
    for (const char *at = text; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
        if (bench->isa_count == MOST_ISAS) {
            snprintf(why, 160, "takes at most %d instruction sets", MOST_ISAS);
            return false;
        }
        Isa *isa = &bench->isas[bench->isa_count++];
        snprintf(isa->name, sizeof isa->name, "%.*s", (int)strcspn(at, ","), at);
        if (!cli_isa(&isa->isa, isa->name, why))
            return false;
    }
    return true;
}

static const CliOption OPTIONS[] = {
    {"steps", "N", "counted steps of each scene", "200", CLI_TO(Bench, steps), CLI_RANGE(1, 1e6)},
    {"warm-up", "N", "steps before counting", "100", CLI_TO(Bench, warm_up), CLI_RANGE(0, 1e6)},
    {"rounds", "N", "times that each is timed, in turn with all others", "1", CLI_TO(Bench, rounds),
     CLI_RANGE(1, MOST_ROUNDS)},
    {"threads", "N", "threads", "1", CLI_TO(Bench, threads), CLI_RANGE(1, 64)},
    {"isa", "NAMES",
     "instruction sets of the kernels, with commas between: scalar, sse2, avx2 or avx512; they "
     "never change a result",
     "the widest that the machine runs", .kind = CLI_READ, .read = read_isas},
    {"json", NULL, "one array of objects instead of the table", CLI_TO(Bench, json)},
};

/* A scene with an instruction set, and what was measured of it in each round. */
typedef struct Case {
    const char *name;
    const Named *named; /* NULL: `name` is a path */
    const Isa *isa;
    JoStats last; /* of the last round: agents, bodies */
    uint64_t measured;
    double steps_per_s[MOST_ROUNDS], times_real_time[MOST_ROUNDS];
    double ns[MOST_ROUNDS];                     /* of processor time, per agent-step */
    double stages[JO_STAGE_COUNT][MOST_ROUNDS]; /* likewise, of time */
} Case;

/* ---- measuring ---- */

static void note(Case *c, const JoStats *from, const JoStats *to) {
    const double steps = (double)(to->steps - from->steps);
    const double agent_steps = (double)(to->agent_steps - from->agent_steps);
    const double cpu = to->cpu_s - from->cpu_s, wall = to->wall_s - from->wall_s;
    const double each = agent_steps > 0 ? 1.0 / agent_steps : 0.0;
    const uint64_t round = c->measured++;
    c->last = *to;
    c->steps_per_s[round] = steps / wall;
    c->times_real_time[round] = steps * to->dt / wall;
    c->ns[round] = cpu * 1e9 * each;
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        c->stages[s][round] = (to->stage_ns[s] * (double)to->agent_steps -
                               from->stage_ns[s] * (double)from->agent_steps) *
                              each;
}

static int measure(const Bench *bench, Case *c) {
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    def.path = c->named ? c->named->path : c->name;
    def.threads = bench->threads;
    def.isa = c->isa->isa;
    if (c->named) {
        def.overrides = c->named->sets;
        while (def.override_count < MOST_SETS && c->named->sets[def.override_count])
            def.override_count++;
    }
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene)
        return (int)error.code;
    bool ok = true;
    for (uint64_t i = 0; ok && i < bench->warm_up; i++)
        ok = jo_scene_step(scene, &error);
    JoStats from = jo_scene_stats(scene);
    for (uint64_t i = 0; ok && i < bench->steps; i++)
        ok = jo_scene_step(scene, &error);
    JoStats to = jo_scene_stats(scene);
    jo_scene_free(scene);
    if (!ok)
        return cli_failed(&cli_bench, &error, false);
    note(c, &from, &to);
    return JO_OK;
}

/* ---- what came out ---- */

static double median(const double *values, uint64_t count) {
    double sorted[MOST_ROUNDS];
    memcpy(sorted, values, count * sizeof *values);
    jox_sort_doubles(sorted, count);
    return 0.5 * (sorted[(count - 1) / 2] + sorted[count / 2]);
}

static double least(const double *values, uint64_t count) {
    double result = values[0];
    for (uint64_t i = 1; i < count; i++)
        result = values[i] < result ? values[i] : result;
    return result;
}

static void add_case(JoxJson *json, const Case *c) {
    jox_json_object(json, NULL);
    jox_json_string(json, "scene", c->name);
    jox_json_string(json, "isa", c->isa->name);
    jox_json_whole(json, "agents", c->last.agents);
    jox_json_whole(json, "bodies", c->last.bodies);
    jox_json_whole(json, "rounds", c->measured);
    jox_json_digits(json, "steps_per_s", median(c->steps_per_s, c->measured), 6);
    jox_json_digits(json, "times_real_time", median(c->times_real_time, c->measured), 6);
    jox_json_digits(json, "cpu_ns_per_agent_step", median(c->ns, c->measured), 6);
    jox_json_digits(json, "least_cpu_ns_per_agent_step", least(c->ns, c->measured), 6);
    jox_json_object(json, "stage_ns");
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        jox_json_digits(json, jo_stage_name(s), median(c->stages[s], c->measured), 4);
    jox_json_end(json);
    jox_json_end(json);
}

static void print_case(const Case *c) {
    printf("%-30s %-6s %7u %6u %10.1f %8.1f %8.0f %8.0f ", c->name, c->isa->name, c->last.agents,
           c->last.bodies, median(c->steps_per_s, c->measured),
           median(c->times_real_time, c->measured), median(c->ns, c->measured),
           least(c->ns, c->measured));
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        printf(" %8.1f", median(c->stages[s], c->measured));
    puts("");
    fflush(stdout);
}

static void print_header(void) {
    puts("Medians of the rounds. Nanoseconds are per agent and step: cpu of processor time, stages "
         "of time.");
    printf("%-30s %-6s %7s %6s %10s %8s %8s %8s ", "scene", "isa", "agents", "bodies", "steps/s",
           "x real", "cpu ns", "least");
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        printf(" %8s", jo_stage_name(s));
    puts("");
}

static void write_json(Bench *bench, const Case *cases, size_t count) {
    bench->array = jox_json_begin(&bench->text, 1);
    jox_json_array(&bench->array, NULL);
    for (size_t k = 0; k < count; k++)
        add_case(&bench->array, &cases[k]);
    jox_json_end(&bench->array);
    puts(bench->text.data);
    jox_text_free(&bench->text);
}

/* ---- the command ---- */

static const Named *named(const char *name) {
    for (size_t k = 0; k < NAMED_COUNT; k++)
        if (strcmp(NAMED[k].name, name) == 0)
            return &NAMED[k];
    return NULL;
}

/* All cases, round by round; the table shows each when its last round is over. */
static int bench_all(Bench *bench, const char *const *names, size_t count) {
    const size_t total = count * bench->isa_count;
    Case *cases = jox_alloc(total, sizeof *cases);
    int status = JO_OK;
    for (size_t k = 0; k < total; k++) {
        const char *name = names[k / bench->isa_count];
        cases[k] = (Case){.name = name, .named = named(name)};
        cases[k].isa = &bench->isas[k % bench->isa_count];
    }
    if (!bench->json)
        print_header();
    for (uint64_t round = 0; round < bench->rounds; round++)
        for (size_t k = 0; status == JO_OK && k < total; k++) {
            status = measure(bench, &cases[k]);
            if (status == JO_OK && !bench->json && round + 1 == bench->rounds)
                print_case(&cases[k]);
        }
    if (bench->json && status == JO_OK)
        write_json(bench, cases, total);
    jox_free(cases);
    return status;
}

static int run(int argc, char **argv) {
    Bench bench = {.steps = 200, .warm_up = 100, .rounds = 1, .threads = 1};
    CliList names = {0};
    bench.isas[0] = (Isa){"widest", JO_ISA_WIDEST};
    bench.isa_count = 1;
    int status = cli_parse(&cli_bench, argc, argv, &bench, &names);
    if (status == CLI_GO_ON)
        status = names.count ? bench_all(&bench, names.items, names.count)
                             : bench_all(&bench, STANDARD, sizeof STANDARD / sizeof *STANDARD);
    cli_free(&cli_bench, &bench, &names);
    return status;
}

const CliCommand cli_bench = {
    .name = "bench",
    .what = "time scenes and stages",
    .usage = "[NAME|SCENE...] [--rounds N] [--steps N] [--isa NAMES] [--json]",
    .about = "Times scenes without drawing or recording, by stage: files, or these by name:\n"
             "  tawaf two-bottlenecks wall-breaking office dodgeball-500\n"
             "  running-through circle one-way-3 one-way-6 counterflow-3\n"
             "  counterflow-6 arena scale-1k scale-10k scale-100k scale-1m\n"
             "Without a name: tawaf, dodgeball-500, running-through and circle.",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "scene",
    .run = run,
};
