/* What `jostle bench` measured, and what it writes of it. */
#ifndef JOX_CLI_BENCH_H
#define JOX_CLI_BENCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "jostle_tools.h"

enum { BENCH_ROUNDS = 100 }; /* at most */

/* What all cases were measured with. */
typedef struct BenchGiven {
    uint64_t steps, warm_up, rounds;
    uint32_t threads;
    const char *commit;
} BenchGiven;

/* A scene with an instruction set, and what was measured of it in each round. */
typedef struct BenchCase {
    const char *name; /* of the scene, or its path */
    const char *path; /* its file; NULL of many worlds */
    JoIsa isa;
    JoStats last; /* of the last round: agents, bodies */
    uint64_t measured;
    double steps_per_s[BENCH_ROUNDS], times_real_time[BENCH_ROUNDS];
    double ns[BENCH_ROUNDS];                     /* of processor time, per agent-step */
    double stages[JO_STAGE_COUNT][BENCH_ROUNDS]; /* likewise, of time */
    double bullet[BENCH_ROUNDS];                 /* likewise, of Bullet's own steps */
    double bodies[BENCH_ROUNDS]; /* likewise, of all that moves bodies and tells agents of them */
} BenchCase;

/* Takes a round of a case in: what was done between two moments of it. */
void bench_note(BenchCase *c, const JoStats *from, const JoStats *to);

enum { BENCH_MOST_PEOPLE = 64 };
/* Worlds of so many people and a ball each. */
typedef struct BenchWorlds {
    uint32_t worlds, people;
} BenchWorlds;
/* Measures a round of a case: without clocks in the steps what they take, and with them, over as
   many steps, by stage. Returns an exit status, with `error`. */
int bench_worlds(const BenchWorlds *def, const BenchGiven *given, BenchCase *c, JoError *error);

/* The table: its first lines, and the line of a case. */
void bench_header(void);
void bench_line(const BenchCase *c);
/* How many times as fast as with the first of `isas` sets of instructions each scene is with the
   others; cases of one scene stand together. */
void bench_ratios(const BenchCase *cases, size_t count, size_t isas);
/* One array of objects, to standard output. */
void bench_json(const BenchGiven *given, const BenchCase *cases, size_t count);
/* Appends a line for each case to a file, whose first line names the columns; false with errno. */
bool bench_csv(const char *path, const BenchGiven *given, const BenchCase *cases, size_t count);
/* Draws bench.svg into a folder, which is made. */
bool bench_plot(const char *folder, const BenchCase *cases, size_t count, JoError *error);

#endif
