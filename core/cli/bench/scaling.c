/* Writes how the time of a scene's steps falls with the number of threads, by stage: the table and
   the CSV lines of `jostle bench --threads 1,2,...`. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/format/quote.h"
#include "cli/bench/bench.h"

/* Rows of a case: all of the step, each stage, each part outside the stages, and what is in none of
   them. */
enum { ALL = -1, OUTSIDE = JO_STAGE_COUNT, REST = OUTSIDE + BENCH_OUTSIDE };
/* Processors that other programs keep busy beyond those that the threads leave, from which times
   are marked. */
static const double BUSY = 0.1;

/* The times of a row, ns per agent-step. */
typedef struct ScalingRow {
    const char *stage;
    double wall, least_wall;
    double cpu, least_cpu; /* sums over all threads; 0 but for all stages together */
    double speed_up, efficiency;
    double lost; /* wall time beyond that of perfect scaling, ns */
} ScalingRow;

static const char *get_row_name(int row) {
    return row == ALL       ? "all"
           : row == REST    ? "rest"
           : row >= OUTSIDE ? bench_outside_name(row - OUTSIDE)
                            : jo_stage_name(row);
}

/* Returns the wall time of a row in a round. */
static double get_wall_time(const BenchCase *c, int row, uint64_t round) {
    if (row == ALL)
        return c->wall[round];
    if (row < OUTSIDE)
        return c->stages[row][round];
    if (row < REST)
        return c->outside[row - OUTSIDE][round];
    double rest = c->wall[round];
    for (int other = 0; other < REST; other++)
        rest -= get_wall_time(c, other, round);
    return rest < 0.0 ? 0.0 : rest; /* clocks resolve no less */
}

/* Finds the wall times of a row in each round. */
static void find_wall_times(const BenchCase *c, int row, double out[BENCH_ROUNDS]) {
    for (uint64_t r = 0; r < c->measured; r++)
        out[r] = get_wall_time(c, row, r);
}

/* Computes a row of a case; `first` is the case that it is compared with. */
static ScalingRow find_row(const BenchCase *c, const BenchCase *first, int stage) {
    double times[BENCH_ROUNDS], first_times[BENCH_ROUNDS];
    find_wall_times(c, stage, times);
    find_wall_times(first, stage, first_times);
    const double was = bench_find_median(first_times, first->measured);
    ScalingRow row = {.stage = get_row_name(stage),
                      .wall = bench_find_median(times, c->measured),
                      .least_wall = bench_find_least(times, c->measured)};
    const double share = (double)first->threads / (double)c->threads;
    row.speed_up = row.wall > 0.0 ? was / row.wall : 0.0;
    row.efficiency = row.speed_up * share;
    row.lost = row.wall - was * share;
    if (stage == ALL) {
        row.cpu = bench_find_median(c->cpu, c->measured);
        row.least_cpu = bench_find_least(c->cpu, c->measured);
    }
    return row;
}

static void print_row(const BenchCase *c, const ScalingRow *row, uint32_t processors) {
    printf("%-10s %7u%s %9.2f %9.2f", row->stage, c->threads, c->threads > processors ? "*" : " ",
           row->wall, row->least_wall);
    if (row->cpu > 0.0)
        printf(" %9.2f %9.2f", row->cpu, row->least_cpu);
    else
        printf(" %9s %9s", "-", "-");
    if (row->speed_up > 0.0)
        printf(" %9.2f %10.0f %% %8.2f\n", row->speed_up, 100.0 * row->efficiency, row->lost);
    else
        printf(" %9s %12s %8s\n", "-", "-", "-");
}

/* Returns how many processors other programs kept busy, a mean over the rounds; below 0: not
   known. */
static double find_others(const BenchCase *c) {
    double sum = 0.0;
    for (uint64_t r = 0; r < c->measured; r++) {
        if (c->others[r] < 0.0)
            return -1.0;
        sum += c->others[r];
    }
    return c->measured ? sum / (double)c->measured : -1.0;
}

/* Whether the threads of a case had to share processors with other programs. */
static bool was_busy(const BenchCase *c) {
    const double machine = (double)sysconf(_SC_NPROCESSORS_ONLN);
    return find_others(c) > fmax(0.0, machine - c->threads) + BUSY;
}

/* Says what other programs did meanwhile, and whether the times are a measure. */
static void print_load(const BenchCase *cases, size_t count) {
    bool busy = false;
    const long machine = sysconf(_SC_NPROCESSORS_ONLN);
    if (find_others(cases) < 0.0)
        return;
    for (size_t k = 0; k < count; k++)
        busy |= was_busy(&cases[k]);
    printf("Of the machine's %ld %s, other programs kept busy:", machine,
           machine == 1 ? "processor" : "processors");
    for (size_t k = 0; k < count; k++)
        printf("%s %.1f with %u %s%s", k ? "," : "", find_others(&cases[k]), cases[k].threads,
               cases[k].threads == 1 ? "thread" : "threads", was_busy(&cases[k]) ? " (!)" : "");
    puts(".");
    if (busy)
        puts(
            "! this machine did other work too: threads waited for processors, so that wall times, "
            "speed-ups and efficiencies are no measure of the program. Times of cpu are.");
}

void bench_scaling(const BenchGiven *given, const BenchCase *cases, size_t count) {
    const uint32_t processors = given->processors;
    char cpu[BENCH_CPU_NAME];
    bool beyond = false;
    bench_find_cpu(cpu);
    printf(
        "%s: %u agents, %s, %llu steps after %llu, %llu %s in turn\n"
        "%s, of which this process may use %u %s\n"
        "Times are ns per agent and step, medians of the rounds except where least is said.\n"
        "  cpu: of all threads. lost: wall time beyond that of perfect scaling from %u %s.\n"
        "  enter: events, walls, people who come in. leave: people who leave. collect: densities "
        "and other figures of the scene.\n\n",
        cases->name, cases->last.agents, jo_isa_name(cases->isa), (unsigned long long)given->steps,
        (unsigned long long)given->warm_up, (unsigned long long)given->rounds,
        given->rounds == 1 ? "round" : "rounds", cpu, processors,
        processors == 1 ? "processor" : "processors", cases->threads,
        cases->threads == 1 ? "thread" : "threads");
    printf("%-10s %7s  %9s %9s %9s %9s %9s %12s %8s\n", "stage", "threads", "wall", "least", "cpu",
           "least", "speed-up", "efficiency", "lost");
    for (int stage = ALL; stage <= REST; stage++)
        for (size_t k = 0; k < count; k++) {
            const ScalingRow row = find_row(&cases[k], cases, stage);
            print_row(&cases[k], &row, processors);
            beyond |= cases[k].threads > processors;
        }
    print_load(cases, count);
    if (beyond)
        puts("* more threads than processors: they take turns, and this is no measure of the "
             "program");
    puts("");
    fflush(stdout);
}

static const char COLUMNS[] =
    "cpu,processors,commit,compiler,isa,scene,agents,bodies,steps,rounds,threads,stage,wall_ns,"
    "least_wall_ns,cpu_ns,least_cpu_ns,speed_up,efficiency,lost_ns,is_measure";

/* Opens a CSV file to append to, with the line of names if it is new; NULL with errno. */
static FILE *open_csv(const char *path) {
    char line[sizeof COLUMNS + 1] = "";
    FILE *there = jox_file_open(path, "r");
    const bool any = there && fgets(line, sizeof line, there);
    if (there)
        jox_file_close(there);
    line[strcspn(line, "\n")] = 0;
    if (any && strcmp(line, COLUMNS) != 0) {
        errno = EEXIST;
        return NULL;
    }
    FILE *file = jox_file_open(path, "a");
    if (file && !any)
        fprintf(file, "%s\n", COLUMNS);
    return file;
}

static void write_csv_row(FILE *file, const BenchGiven *given, const BenchCase *c,
                          const ScalingRow *row) {
    char cpu[BENCH_CPU_NAME];
    bench_find_cpu(cpu);
    jox_quote_put(file, jox_quote_csv, cpu);
    fprintf(file, ",%u,", given->processors);
    const char *const texts[] = {given->commit, bench_compiler, jo_isa_name(c->isa), c->name};
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++) {
        jox_quote_put(file, jox_quote_csv, texts[t]);
        fputs(",", file);
    }
    fprintf(file, "%u,%u,%llu,%llu,%u,%s,%.6g,%.6g,", c->last.agents, c->last.bodies,
            (unsigned long long)given->steps, (unsigned long long)c->measured, c->threads,
            row->stage, row->wall, row->least_wall);
    if (row->cpu > 0.0)
        fprintf(file, "%.6g,%.6g,", row->cpu, row->least_cpu);
    else
        fputs(",,", file);
    if (row->speed_up > 0.0)
        fprintf(file, "%.6g,%.6g,%.6g,", row->speed_up, row->efficiency, row->lost);
    else
        fputs(",,,", file);
    fprintf(file, "%s\n", c->threads > given->processors || was_busy(c) ? "no" : "yes");
}

bool bench_scaling_csv(const char *path, const BenchGiven *given, const BenchCase *cases,
                       size_t count, size_t threads) {
    FILE *file = open_csv(path);
    if (!file)
        return false;
    for (size_t k = 0; k < count; k++)
        for (int stage = ALL; stage <= REST; stage++) {
            const ScalingRow row = find_row(&cases[k], &cases[k - k % threads], stage);
            write_csv_row(file, given, &cases[k], &row);
        }
    return jox_file_close(file) == 0;
}
