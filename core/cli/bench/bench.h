/* The measurements of `jostle bench` and their output. bench.c of core/cli calls these for each
   case and round. */
#ifndef JOX_CLI_BENCH_H
#define JOX_CLI_BENCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "jostle_tools.h"

enum {
    BENCH_ROUNDS = 100,   /* most rounds */
    BENCH_THREADS = 16,   /* most numbers of threads to compare */
    BENCH_CPU_NAME = 100, /* length of the name of a processor */
    BENCH_OUTSIDE = 3     /* parts of a step outside its stages: enter, leave, collect */
};

/* Settings that all cases share. */
typedef struct BenchGiven {
    uint64_t steps, warm_up, rounds;
    const char *commit;
    uint32_t processors; /* that this process may use */
} BenchGiven;

/* A case: a scene with an instruction set and a number of threads, and its figures of each
   round. */
typedef struct BenchCase {
    const char *name; /* name of the scene, or its path */
    const char *path; /* its file; NULL: many worlds */
    JoIsa isa;
    uint32_t threads;
    uint64_t hash;     /* of the state at the end */
    uint64_t resident; /* resident memory of the scene in the first round, bytes; 0: not known */
    JoStats last;      /* statistics of the last round: agents, bodies */
    uint64_t measured; /* rounds measured so far */
    double steps_per_s[BENCH_ROUNDS], times_real_time[BENCH_ROUNDS];
    double ns[BENCH_ROUNDS]; /* ns of processor time per agent-step */
    /* ns per agent-step of all that a step does, also outside its stages: wall time, and processor
       time of all threads */
    double wall[BENCH_ROUNDS], cpu[BENCH_ROUNDS];
    double stages[JO_STAGE_COUNT][BENCH_ROUNDS]; /* ns of wall time per agent-step */
    double others[BENCH_ROUNDS]; /* processors that other programs kept busy; below 0: not known */
    double outside[BENCH_OUTSIDE][BENCH_ROUNDS]; /* the same, outside the stages */
    double bullet[BENCH_ROUNDS];                 /* the same, in Bullet's own steps */
    double bodies[BENCH_ROUNDS]; /* the same, for all that moves bodies and shows them to agents */
} BenchCase;

/* Return the median, and the least, of the figures of rounds. */
double bench_find_median(const double *values, uint64_t count);
double bench_find_least(const double *values, uint64_t count);
double bench_find_bytes_per_agent(const BenchCase *c);
/* Returns the time of such a part until now, ns per agent-step, and its name. */
double bench_get_outside(const JoStats *stats, int part);
const char *bench_outside_name(int part);
/* Finds the name of the processor's model; "unknown" if there is none. */
void bench_find_cpu(char cpu[BENCH_CPU_NAME]);
/* The compiler that built this program. */
extern const char *const bench_compiler;

/* Makes freed memory go back to the system at once, so that the memory of cases can be told
   apart. */
void bench_return_memory(void);

/* Returns the processor time that all programs have used since the machine began, s; below 0 if it
   is not known. */
double bench_read_busy_time(void);

/* Adds a round to a case, from the statistics at its beginning and end, and the wall and processor
   time between these, s. */
void bench_note(BenchCase *c, const JoStats *from, const JoStats *to, double wall, double cpu);

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

/* ---- scaling.c: numbers of threads compared ---- */

/* Prints for a scene and each stage how its time falls with the number of threads. `cases` are
   those of `count` numbers of threads, of one scene and instruction set; the first is the one that
   the others are compared with. */
void bench_scaling(const BenchGiven *given, const BenchCase *cases, size_t count);
/* Appends a line for each case and stage to a CSV file, after a line of names if it is new; false
   with errno, EEXIST if the file has other columns. `threads` cases are of one scene. */
bool bench_scaling_csv(const char *path, const BenchGiven *given, const BenchCase *cases,
                       size_t count, size_t threads);

#endif
