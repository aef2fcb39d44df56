/* The measurements of `jostle bench` and their output. bench.c of core/cli calls these for each
   case and round. */
#ifndef JOX_CLI_BENCH_H
#define JOX_CLI_BENCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "jostle_tools.h"

enum { BENCH_ROUNDS = 100 }; /* most rounds */

/* Settings that all cases share. */
typedef struct BenchGiven {
    uint64_t steps, warm_up, rounds;
    uint32_t threads;
    const char *commit;
} BenchGiven;

/* A case: a scene with an instruction set, and its figures of each round. */
typedef struct BenchCase {
    const char *name; /* name of the scene, or its path */
    const char *path; /* its file; NULL: many worlds */
    JoIsa isa;
    JoStats last;      /* statistics of the last round: agents, bodies */
    uint64_t measured; /* rounds measured so far */
    double steps_per_s[BENCH_ROUNDS], times_real_time[BENCH_ROUNDS];
    double ns[BENCH_ROUNDS];                     /* ns of processor time per agent-step */
    double stages[JO_STAGE_COUNT][BENCH_ROUNDS]; /* ns of wall time per agent-step */
    double bullet[BENCH_ROUNDS];                 /* the same, in Bullet's own steps */
    double bodies[BENCH_ROUNDS]; /* the same, for all that moves bodies and shows them to agents */
} BenchCase;

/* Adds a round to a case, from the statistics at its beginning and end. */
void bench_note(BenchCase *c, const JoStats *from, const JoStats *to);

enum { BENCH_MOST_PEOPLE = 64 };
/* A number of small worlds, each with some people and a ball. */
typedef struct BenchWorlds {
    uint32_t worlds, people;
} BenchWorlds;
/* Measures a round of a case of many worlds: first the whole time, without clocks inside the steps,
   then the time by stage, with them, over as many steps. Returns an exit status, with `error`. */
int bench_worlds(const BenchWorlds *def, const BenchGiven *given, BenchCase *c, JoError *error);

/* Print the head of the table, and the line of a case. */
void bench_header(void);
void bench_line(const BenchCase *c);
/* Prints for each scene how many times as fast as with the first of `isas` instruction sets it is
   with the others. Cases of a scene must be adjacent. */
void bench_ratios(const BenchCase *cases, size_t count, size_t isas);
/* Prints the cases as a JSON array of objects. */
void bench_json(const BenchGiven *given, const BenchCase *cases, size_t count);
/* Appends a line for each case to a CSV file, after a line of names if it is new; false with
   errno. */
bool bench_csv(const char *path, const BenchGiven *given, const BenchCase *cases, size_t count);
/* Draws bench.svg into a folder, which is made if missing. */
bool bench_plot(const char *folder, const BenchCase *cases, size_t count, JoError *error);

#endif
