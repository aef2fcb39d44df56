/* Writes the results of `jostle bench`: a table, JSON, lines of CSV, a plot. */
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/format/json_writer.h"
#include "base/format/quote.h"
#include "base/guard.h"
#include "base/mem.h"
#include "cli/bench/bench.h"

/* Returns the time of all that moves bodies and shows them to agents, divided by that of Bullet's
   own steps; 0 without bodies. */
static double get_bodies_ratio(const BenchCase *c) {
    double ratios[BENCH_ROUNDS] = {0.0};
    for (uint64_t i = 0; i < c->measured; i++)
        ratios[i] = c->bullet[i] > 0.0 ? c->bodies[i] / c->bullet[i] : 0.0;
    return bench_find_median(ratios, c->measured);
}

static void add_case_json(JoxJson *json, const BenchGiven *given, const BenchCase *c) {
    char cpu[BENCH_CPU_NAME];
    bench_find_cpu(cpu);
    jox_json_object(json, NULL);
    jox_json_string(json, "scene", c->name);
    jox_json_string(json, "isa", jo_isa_name(c->isa));
    jox_json_string(json, "cpu", cpu);
    jox_json_string(json, "commit", given->commit);
    jox_json_string(json, "compiler", bench_compiler);
    jox_json_whole(json, "threads", c->threads);
    jox_json_whole(json, "warm_up", given->warm_up);
    jox_json_whole(json, "steps", given->steps);
    jox_json_digits(json, "dt", c->last.dt, 6);
    jox_json_whole(json, "agents", c->last.agents);
    jox_json_whole(json, "bodies", c->last.bodies);
    if (c->resident) {
        jox_json_whole(json, "resident_bytes", c->resident);
        jox_json_digits(json, "resident_bytes_per_agent", bench_find_bytes_per_agent(c), 4);
    }
    jox_json_whole(json, "rounds", c->measured);
    jox_json_digits(json, "steps_per_s", bench_find_median(c->steps_per_s, c->measured), 6);
    jox_json_digits(json, "times_real_time", bench_find_median(c->times_real_time, c->measured), 6);
    jox_json_digits(json, "cpu_ns_per_agent_step", bench_find_median(c->ns, c->measured), 6);
    jox_json_digits(json, "least_cpu_ns_per_agent_step", bench_find_least(c->ns, c->measured), 6);
    jox_json_digits(json, "wall_ns_per_agent_step", bench_find_median(c->wall, c->measured), 6);
    jox_json_digits(json, "least_wall_ns_per_agent_step", bench_find_least(c->wall, c->measured),
                    6);
    if (bench_find_least(c->others, c->measured) >= 0.0)
        jox_json_digits(json, "processors_of_others", bench_find_median(c->others, c->measured), 3);
    jox_json_digits(json, "bullet_ns", bench_find_median(c->bullet, c->measured), 4);
    jox_json_digits(json, "bodies_ns", bench_find_median(c->bodies, c->measured), 4);
    jox_json_digits(json, "bodies_in_bullets", get_bodies_ratio(c), 4);
    jox_json_object(json, "stage_ns");
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        jox_json_digits(json, jo_stage_name(s), bench_find_median(c->stages[s], c->measured), 4);
    jox_json_end(json);
    jox_json_object(json, "outside_ns");
    for (int part = 0; part < BENCH_OUTSIDE; part++)
        jox_json_digits(json, bench_outside_name(part),
                        bench_find_median(c->outside[part], c->measured), 4);
    jox_json_end(json);
    jox_json_end(json);
}

void bench_line(const BenchCase *c) {
    char bytes[24] = "-";
    if (c->resident)
        snprintf(bytes, sizeof bytes, "%.0f", bench_find_bytes_per_agent(c));
    printf("%-30s %-6s %7u %6u %7s %10.1f %8.1f %8.0f %8.0f %9.1f %8.2f ", c->name,
           jo_isa_name(c->isa), c->last.agents, c->last.bodies, bytes,
           bench_find_median(c->steps_per_s, c->measured),
           bench_find_median(c->times_real_time, c->measured),
           bench_find_median(c->ns, c->measured), bench_find_least(c->ns, c->measured),
           bench_find_median(c->bullet, c->measured), get_bodies_ratio(c));
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        printf(" %8.1f", bench_find_median(c->stages[s], c->measured));
    puts("");
    fflush(stdout);
}

void bench_header(void) {
    puts("Medians of the rounds. Nanoseconds are per agent and step: 'cpu ns' of processor time, "
         "stages of wall time.\n'bullet': the part of the stage 'bodies' that Bullet's own steps "
         "take; 'x bullet': the time of all that moves bodies and shows them to agents, divided by "
         "that of Bullet's own steps.\n'B/agent': resident memory of the scene, per agent.");
    printf("%-30s %-6s %7s %6s %7s %10s %8s %8s %8s %9s %8s ", "scene", "isa", "agents", "bodies",
           "B/agent", "steps/s", "x real", "cpu ns", "least", "bullet", "x bullet");
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        printf(" %8s", jo_stage_name(s));
    puts("");
}

void bench_ratios(const BenchCase *cases, size_t count, size_t isas) {
    if (isas < 2)
        return;
    printf("\nTimes as fast as %s, by least cpu ns:\n", jo_isa_name(cases->isa));
    for (size_t k = 0; k < count; k++) {
        const BenchCase *c = &cases[k], *first = c - k % isas;
        if (c != first)
            printf("%-30s %-6s %7.2f\n", c->name, jo_isa_name(c->isa),
                   bench_find_least(first->ns, first->measured) /
                       bench_find_least(c->ns, c->measured));
    }
}

void bench_json(const BenchGiven *given, const BenchCase *cases, size_t count) {
    JoxText text = {0};
    JoxJson array = jox_json_begin(&text, 1);
    jox_json_array(&array, NULL);
    for (size_t k = 0; k < count; k++)
        add_case_json(&array, given, &cases[k]);
    jox_json_end(&array);
    puts(text.data);
    jox_text_free(&text);
}

bool bench_csv(const char *path, const BenchGiven *given, const BenchCase *cases, size_t count) {
    FILE *file = jox_file_open(path, "a");
    if (!file)
        return false;
    if (fseek(file, 0, SEEK_END) == 0 && ftell(file) == 0) {
        fputs("cpu,commit,compiler,isa,threads,scene,agents,bodies,steps,rounds,"
              "cpu_ns_per_agent_step,least,steps_per_s",
              file);
        for (int s = 0; s < JO_STAGE_COUNT; s++)
            fprintf(file, ",%s_ns", jo_stage_name(s));
        fputs("\n", file);
    }
    char cpu[BENCH_CPU_NAME];
    bench_find_cpu(cpu);
    for (size_t k = 0; k < count; k++) {
        const BenchCase *c = &cases[k];
        const char *const texts[] = {cpu, given->commit, bench_compiler, jo_isa_name(c->isa)};
        for (size_t t = 0; t < sizeof texts / sizeof *texts; t++) {
            jox_quote_put(file, jox_quote_csv, texts[t]);
            fputs(",", file);
        }
        fprintf(file, "%u,", c->threads);
        jox_quote_put(file, jox_quote_csv, c->name);
        fprintf(file, ",%u,%u,%llu,%llu,%.5g,%.5g,%.6g", c->last.agents, c->last.bodies,
                (unsigned long long)given->steps, (unsigned long long)c->measured,
                bench_find_median(c->ns, c->measured), bench_find_least(c->ns, c->measured),
                bench_find_median(c->steps_per_s, c->measured));
        for (int s = 0; s < JO_STAGE_COUNT; s++)
            fprintf(file, ",%.4g", bench_find_median(c->stages[s], c->measured));
        fputs("\n", file);
    }
    return jox_file_close(file) == 0;
}

bool bench_plot(const char *folder, const BenchCase *cases, size_t count, JoError *error) {
    JoTiming *timings = jox_alloc(count, sizeof *timings);
    /* Leaves out cases without a measurable time: the clock of processor time may advance in
       milliseconds. */
    size_t told = 0;
    for (size_t k = 0; k < count; k++) {
        const BenchCase *c = &cases[k];
        if (!(bench_find_median(c->ns, c->measured) > 0.0))
            continue;
        timings[told] = (JoTiming){.scene = c->name,
                                   .isa = jo_isa_name(c->isa),
                                   .agents = c->last.agents,
                                   .in_series = strncmp(c->name, "scale-", 6) == 0,
                                   .ns = bench_find_median(c->ns, c->measured),
                                   .least_ns = bench_find_least(c->ns, c->measured)};
        for (int s = 0; s < JO_STAGE_COUNT; s++)
            timings[told].stage_ns[s] = bench_find_median(c->stages[s], c->measured);
        told++;
    }
    if (told == 0)
        jox_error(error, JO_INPUT,
                  "nothing to draw: these few steps take less processor time than its clock "
                  "resolves; give more --steps");
    const bool good = told > 0 && jo_plot_times(timings, told, folder, error);
    jox_free(timings);
    return good;
}
