#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"

static const char HELP[] =
    "usage: jostle bench [SCENE...] [--steps N] [--warm-up N] [--threads N] [--json]\n\n"
    "Times scenes without drawing or recording, by stage. Without a scene: scenes/tawaf.yaml,\n"
    "dodgeball.yaml, running-through.yaml and circle.yaml.\n\n"
    "  --steps N     counted steps of each scene (default 200)\n"
    "  --warm-up N   steps before counting (default 100)\n"
    "  --threads N   default 1\n"
    "  --json        one array of objects instead of the table\n";

static const char *const STANDARD[] = {"scenes/tawaf.yaml", "scenes/dodgeball.yaml",
                                       "scenes/running-through.yaml", "scenes/circle.yaml"};

typedef struct Bench {
    uint64_t steps, warm_up;
    uint32_t threads;
    bool json;
} Bench;

static void print_row(const Bench *bench, const char *path, const JoStats *from, const JoStats *to,
                      bool first) {
    double steps = (double)(to->steps - from->steps);
    double agent_steps = (double)(to->agent_steps - from->agent_steps);
    double cpu = to->cpu_s - from->cpu_s, wall = to->wall_s - from->wall_s;
    double ns = agent_steps > 0 ? cpu * 1e9 / agent_steps : 0;
    if (bench->json)
        printf("%s\n {\"scene\":\"%s\",\"agents\":%u,\"bodies\":%u,\"steps_per_s\":%.6g,"
               "\"times_real_time\":%.6g,\"cpu_ns_per_agent_step\":%.6g,\"stage_ns\":{",
               first ? "" : ",", path, to->agents, to->bodies, steps / wall, steps * to->dt / wall,
               ns);
    else
        printf("%-30s %7u %6u %10.1f %10.1f %9.0f ", path, to->agents, to->bodies, steps / wall,
               steps * to->dt / wall, ns);
    for (int s = 0; s < JO_STAGE_COUNT; s++) {
        double stage = (to->stage_ns[s] * (double)to->agent_steps -
                        from->stage_ns[s] * (double)from->agent_steps) /
                       (agent_steps > 0 ? agent_steps : 1);
        if (bench->json)
            printf("%s\"%s\":%.4g", s ? "," : "", jo_stage_name(s), stage);
        else
            printf(" %8.1f", stage);
    }
    fputs(bench->json ? "}}" : "\n", stdout);
    fflush(stdout);
}

static int bench_scene(const Bench *bench, const char *path, bool first) {
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
    if (ok)
        print_row(bench, path, &from, &to, first);
    else
        fprintf(stderr, "jostle bench: %s\n", error.text);
    return ok ? JO_OK : JO_FAILED;
}

int cli_bench(int argc, char **argv) {
    static const char *const known[] = {"steps", "warm-up", "threads", "json", "help", NULL};
    CliArgs args = {.argc = argc, .argv = argv, .next = 1, .command = "bench"};
    Bench bench = {.steps = 200, .warm_up = 100, .threads = 1};
    const char **paths = calloc((size_t)argc + 4, sizeof *paths);
    const char *option, *plain;
    size_t count = 0;
    int status = JO_OK;
    bool done = false;
    while (!done && ((option = cli_next(&args, &plain)) || plain)) {
        if (plain) {
            paths[count++] = plain;
        } else if (!strcmp(option, "steps")) {
            bench.steps = cli_whole(&args, option, 1, 1000000);
        } else if (!strcmp(option, "warm-up")) {
            bench.warm_up = cli_whole(&args, option, 0, 1000000);
        } else if (!strcmp(option, "threads")) {
            bench.threads = (uint32_t)cli_whole(&args, option, 1, 64);
        } else if (!strcmp(option, "json")) {
            bench.json = true;
        } else if (!strcmp(option, "help") || !strcmp(option, "h")) {
            fputs(HELP, stdout);
            done = true;
        } else {
            status = cli_unknown(&args, option, known);
            done = true;
        }
    }
    if (args.failed)
        status = JO_USAGE;
    if (status == JO_OK && !done) {
        for (size_t i = 0; count == 0 && i < sizeof STANDARD / sizeof *STANDARD; i++)
            paths[i] = STANDARD[i];
        count = count ? count : sizeof STANDARD / sizeof *STANDARD;
        if (bench.json) {
            fputs("[", stdout);
        } else {
            printf("%-30s %7s %6s %10s %10s %9s ", "scene", "agents", "bodies", "steps/s", "x real",
                   "cpu ns/as");
            for (int s = 0; s < JO_STAGE_COUNT; s++)
                printf(" %8s", jo_stage_name(s));
            puts("");
        }
        for (size_t i = 0; i < count && status == JO_OK; i++)
            status = bench_scene(&bench, paths[i], i == 0);
        if (bench.json)
            puts("\n]");
    }
    free(paths);
    return status;
}
