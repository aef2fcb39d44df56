#include <stdio.h>

#include "base/format/json_writer.h"
#include "cli/cli.h"

static const char *const STANDARD[] = {"scenes/tawaf.yaml", "scenes/dodgeball.yaml",
                                       "scenes/running-through.yaml", "scenes/circle.yaml"};

typedef struct Bench {
    uint64_t steps, warm_up;
    uint32_t threads;
    bool json;
    JoxText text; /* the array that is being written */
    JoxJson array;
} Bench;

static const CliOption OPTIONS[] = {
    {"steps", "N", "counted steps of each scene", "200", CLI_TO(Bench, steps), CLI_RANGE(1, 1e6)},
    {"warm-up", "N", "steps before counting", "100", CLI_TO(Bench, warm_up), CLI_RANGE(0, 1e6)},
    {"threads", "N", "threads", "1", CLI_TO(Bench, threads), CLI_RANGE(1, 64)},
    {"json", NULL, "one array of objects instead of the table", CLI_TO(Bench, json)},
};

/* What was counted between two states of a run. */
typedef struct Row {
    const char *scene;
    const JoStats *to;
    double steps_per_s, times_real_time, ns, stages[JO_STAGE_COUNT]; /* ns per agent-step */
} Row;

static Row count_row(const char *path, const JoStats *from, const JoStats *to) {
    const double steps = (double)(to->steps - from->steps);
    const double agent_steps = (double)(to->agent_steps - from->agent_steps);
    const double cpu = to->cpu_s - from->cpu_s, wall = to->wall_s - from->wall_s;
    Row row = {.scene = path,
               .to = to,
               .steps_per_s = steps / wall,
               .times_real_time = steps * to->dt / wall,
               .ns = agent_steps > 0 ? cpu * 1e9 / agent_steps : 0};
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        row.stages[s] = (to->stage_ns[s] * (double)to->agent_steps -
                         from->stage_ns[s] * (double)from->agent_steps) /
                        (agent_steps > 0 ? agent_steps : 1);
    return row;
}

static void add_row(JoxJson *json, const Row *row) {
    jox_json_object(json, NULL);
    jox_json_string(json, "scene", row->scene);
    jox_json_whole(json, "agents", row->to->agents);
    jox_json_whole(json, "bodies", row->to->bodies);
    jox_json_digits(json, "steps_per_s", row->steps_per_s, 6);
    jox_json_digits(json, "times_real_time", row->times_real_time, 6);
    jox_json_digits(json, "cpu_ns_per_agent_step", row->ns, 6);
    jox_json_object(json, "stage_ns");
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        jox_json_digits(json, jo_stage_name(s), row->stages[s], 4);
    jox_json_end(json);
    jox_json_end(json);
}

static void print_row(const Row *row) {
    printf("%-30s %7u %6u %10.1f %10.1f %9.0f ", row->scene, row->to->agents, row->to->bodies,
           row->steps_per_s, row->times_real_time, row->ns);
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        printf(" %8.1f", row->stages[s]);
    puts("");
    fflush(stdout);
}

static void print_header(void) {
    printf("%-30s %7s %6s %10s %10s %9s ", "scene", "agents", "bodies", "steps/s", "x real",
           "cpu ns/as");
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        printf(" %8s", jo_stage_name(s));
    puts("");
}

static int bench_scene(Bench *bench, const char *path) {
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    def.path = path;
    def.threads = bench->threads;
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
    const Row row = count_row(path, &from, &to);
    if (bench->json)
        add_row(&bench->array, &row);
    else
        print_row(&row);
    return JO_OK;
}

static int bench_all(Bench *bench, const char *const *paths, size_t count) {
    int status = JO_OK;
    bench->array = jox_json_begin(&bench->text, 1);
    jox_json_array(&bench->array, NULL);
    if (!bench->json)
        print_header();
    for (size_t i = 0; i < count && status == JO_OK; i++)
        status = bench_scene(bench, paths[i]);
    jox_json_end(&bench->array);
    if (bench->json)
        puts(bench->text.data);
    jox_text_free(&bench->text);
    return status;
}

static int run(int argc, char **argv) {
    Bench bench = {.steps = 200, .warm_up = 100, .threads = 1};
    CliList paths = {0};
    int status = cli_parse(&cli_bench, argc, argv, &bench, &paths);
    if (status == CLI_GO_ON)
        status = paths.count ? bench_all(&bench, paths.items, paths.count)
                             : bench_all(&bench, STANDARD, sizeof STANDARD / sizeof *STANDARD);
    cli_free(&cli_bench, &bench, &paths);
    return status;
}

const CliCommand cli_bench = {
    .name = "bench",
    .what = "time scenes and stages",
    .usage = "[SCENE...] [--steps N] [--warm-up N] [--threads N] [--json]",
    .about = "Times scenes without drawing or recording, by stage. Without a scene: "
             "scenes/tawaf.yaml, dodgeball.yaml, running-through.yaml and circle.yaml.",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "scene",
    .run = run,
};
