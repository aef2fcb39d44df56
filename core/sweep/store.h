/* The file of a sweep: SQLite, one transaction a run, so that it is whole whenever the process
   ends. Its tables are for people, too:

     sweep(key, value)                    what all runs share: "scene", "version", "step", ...
     input(path, sha256, text)            every file that a run was loaded from, as it was
     variant(id, settings, plan)          settings: "PATH=VALUE" a line; plan: JSON
     run(variant, seed, state, reason, hash, steps, simulated_s, cpu_s, wall_s, summary)
     figure(variant, seed, name, value)   of runs that ended; NULL where the run has none
     curve(variant, seed, name, unit, time, value)   unit in curve_name
     field(variant, seed, name, unit, low_x, low_y, cell, columns, rows, cells)  32-bit floats */
#ifndef JOX_SWEEP_STORE_H
#define JOX_SWEEP_STORE_H

#include <stdio.h>

#include "base/database.h"
#include "sweep/sweep.h"

typedef struct JoxSweepStore {
    JoxDatabase *db;
    FILE *claim; /* one sweep writes a file at a time */
    char *path;  /* "" of one in memory */
} JoxSweepStore;

/* Opens a sweep's file, or makes one; NULL as the path is in memory. False with JO_INPUT in `error`
   of a file that is no sweep's or damaged, with JO_FAILED where it cannot be written or another
   sweep writes it. */
bool jox_sweep_open(JoxSweepStore *store, const char *path, JoError *error);
/* Opens one for reading alone. */
bool jox_sweep_open_to_read(JoxSweepStore *store, const char *path, JoError *error);
void jox_sweep_close(JoxSweepStore *store);

/* Fills `error` with what SQLite says of the file; returns false. */
bool jox_sweep_broken(const JoxSweepStore *store, JoError *error);
/* A statement, or NULL with `error`. */
sqlite3_stmt *jox_sweep_ask(const JoxSweepStore *store, const char *sql, JoError *error);
/* Ends it; NULL is fine. */
void jox_sweep_end(const JoxSweepStore *store, sqlite3_stmt *statement);
bool jox_sweep_do_sql(const JoxSweepStore *store, const char *sql, JoError *error);
/* Ends a statement that returns no rows; false with `error`. */
bool jox_sweep_finish(const JoxSweepStore *store, sqlite3_stmt *statement, JoError *error);

/* What all runs of a file share, as it was noted: the first time it is, later it has to be the
   same. Differences are told in `differences`, a sentence each. False with `error`. */
bool jox_sweep_note(const JoxSweepStore *store, const char *key, const char *value,
                    JoxText *differences, JoError *error);
bool jox_sweep_note_input(const JoxSweepStore *store, const char *path, const char *text,
                          size_t length, JoxText *differences, JoError *error);
/* The number of a variant, made where there is none. */
bool jox_sweep_variant(const JoxSweepStore *store, const char *key, int64_t *id, JoError *error);
/* The state of a run; *state is -1 where there is none. */
bool jox_sweep_state(const JoxSweepStore *store, int64_t variant, uint64_t seed, int *state,
                     JoError *error);
/* Puts what a run left, in place of what there was; `pieces` are those of jox_sweep_do. */
bool jox_sweep_put_run(const JoxSweepStore *store, int64_t variant, uint64_t seed,
                       const JoxText *pieces, JoError *error);
/* A run of which nothing is known but why it failed. */
bool jox_sweep_put_failure(const JoxSweepStore *store, int64_t variant, uint64_t seed,
                           const char *why, JoError *error);

/* Takes out all runs but those of so many seeds from `first` on. */
bool jox_sweep_keep_seeds(const JoxSweepStore *store, uint64_t first, uint32_t count,
                          JoError *error);

/* csv.c: a row for each run, with a column for each setting and figure. */
bool jox_sweep_csv(const JoxSweepStore *store, FILE *out, JoError *error);

#endif
