/* Computes the figures of a round from the statistics of a run, or of many worlds, at its beginning
   and end, and the median and the least of all rounds. */
#include <malloc.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/sort.h"
#include "cli/bench/bench.h"

#ifdef __clang__
const char *const bench_compiler = "clang " __clang_version__;
#else
const char *const bench_compiler = "gcc " __VERSION__;
#endif

void bench_find_cpu(char cpu[BENCH_CPU_NAME]) {
    snprintf(cpu, BENCH_CPU_NAME, "unknown");
    FILE *file = jox_file_open("/proc/cpuinfo", "r");
    char line[256], name[256];
    while (file && fgets(line, sizeof line, file))
        if (sscanf(line, "model name : %255[^\n]", name) == 1) {
            snprintf(cpu, BENCH_CPU_NAME, "%.*s", BENCH_CPU_NAME - 1, name);
            break;
        }
    if (file)
        jox_file_close(file);
}

double bench_read_busy_time(void) {
    double user, nice, system, idle, wait, interrupts, soft, stolen;
    FILE *file = jox_file_open("/proc/stat", "r");
    const bool told = file && fscanf(file, "cpu %lf %lf %lf %lf %lf %lf %lf %lf", &user, &nice,
                                     &system, &idle, &wait, &interrupts, &soft, &stolen) == 8;
    if (file)
        jox_file_close(file);
    if (!told)
        return -1.0;
    return (user + nice + system + interrupts + soft + stolen) / (double)sysconf(_SC_CLK_TCK);
}

void bench_return_memory(void) {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 128 << 10); /* a fixed one: it would grow with what is freed */
    malloc_trim(0);
#endif
}

double bench_find_median(const double *values, uint64_t count) {
    double sorted[BENCH_ROUNDS];
    memcpy(sorted, values, count * sizeof *values);
    jox_sort_doubles(sorted, count);
    return 0.5 * (sorted[(count - 1) / 2] + sorted[count / 2]);
}

double bench_find_bytes_per_agent(const BenchCase *c) {
    return c->last.agents ? (double)c->resident / c->last.agents : 0.0;
}

double bench_find_least(const double *values, uint64_t count) {
    double result = values[0];
    for (uint64_t i = 1; i < count; i++)
        result = values[i] < result ? values[i] : result;
    return result;
}

double bench_get_outside(const JoStats *stats, int part) {
    const double parts[BENCH_OUTSIDE] = {stats->enter_ns, stats->leave_ns, stats->collect_ns};
    return parts[part];
}

const char *bench_outside_name(int part) {
    static const char *const NAMES[BENCH_OUTSIDE] = {"enter", "leave", "collect"};
    return NAMES[part];
}

/* Returns the mean of a figure per agent-step between two moments, given its mean from the
   beginning of the run to each. */
static double get_mean_between(const JoStats *from, const JoStats *to, double before,
                               double after) {
    const double steps = (double)(to->agent_steps - from->agent_steps);
    const double sum = after * (double)to->agent_steps - before * (double)from->agent_steps;
    return steps > 0 ? sum / steps : 0.0;
}

void bench_note(BenchCase *c, const JoStats *from, const JoStats *to, double all_wall,
                double all_cpu) {
    const double steps = (double)(to->steps - from->steps);
    const double agent_steps = (double)(to->agent_steps - from->agent_steps);
    const double cpu = to->cpu_s - from->cpu_s, wall = to->wall_s - from->wall_s;
    const double each = agent_steps > 0 ? 1.0 / agent_steps : 0.0;
    const uint64_t round = c->measured++;
    c->last = *to;
    c->steps_per_s[round] = steps / wall;
    c->times_real_time[round] = steps * to->dt / wall;
    c->ns[round] = cpu * 1e9 * each;
    c->wall[round] = all_wall * 1e9 * each;
    c->cpu[round] = all_cpu * 1e9 * each;
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        c->stages[s][round] = get_mean_between(from, to, from->stage_ns[s], to->stage_ns[s]);
    for (int part = 0; part < BENCH_OUTSIDE; part++)
        c->outside[part][round] =
            get_mean_between(from, to, bench_get_outside(from, part), bench_get_outside(to, part));
    c->bullet[round] = get_mean_between(from, to, from->bullet_ns, to->bullet_ns);
    c->bodies[round] = get_mean_between(from, to, from->objects_ns, to->objects_ns);
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        if (strcmp(jo_stage_name(s), "bodies") == 0)
            c->bodies[round] += c->stages[s][round];
}
