/* The file of a sweep, an SQLite database. Each run is stored in one transaction, so that the file
   is whole whenever the process ends. sweep.c writes it, compare/ reads it, and people may query
   it:

     sweep(key, value)                    what all runs share: "scene", "version", "step", ...
     planned(settings, first_seed, seeds) the plans: "PATH=A,B,C" of each axis, one a line
     input(path, sha256, text)            every file that the runs were loaded from, with its text
     variant(id, settings, plan)          settings: "PATH=VALUE", one a line; plan: JSON
     run(variant, seed, state, reason, hash, steps, simulated_s, cpu_s, wall_s, summary)
     figure(variant, seed, name, value)   of runs that ended; NULL: the run has no value
     curve_name(id, name, unit)           the curves that any run has
     curve_point(variant, seed, curve, time, value)   curve: id of its name; time: s
     field(variant, seed, name, unit, low_x, low_y, cell, columns, rows, cells)  32-bit floats */
#ifndef JOX_SWEEP_STORE_H
#define JOX_SWEEP_STORE_H

#include <stdio.h>

#include "base/database.h"
#include "sweep/sweep.h"

#define JOX_SWEEP_FORMAT "2" /* version of these tables */
#define JOX_SWEEP_PLANNED                                                                          \
    "CREATE TABLE IF NOT EXISTS planned(settings TEXT NOT NULL, first_seed INTEGER NOT NULL,"      \
    " seeds INTEGER NOT NULL, PRIMARY KEY(settings, first_seed, seeds)) WITHOUT ROWID;"

typedef struct JoxSweepStore {
    JoxDatabase *db;
    FILE *claim; /* locks the file against other sweeps; NULL: opened for reading */
    char *path;  /* "": in memory */
} JoxSweepStore;

/* Opens a sweep's file for writing, or creates it; a NULL path means in memory. Returns false with
   JO_INPUT in `error` if the file is damaged or no sweep's, with JO_FAILED if it cannot be written
   or another sweep writes it. Close the store even then. */
bool jox_sweep_open(JoxSweepStore *store, const char *path, JoError *error);
/* Opens a sweep's file for reading only. */
bool jox_sweep_open_to_read(JoxSweepStore *store, const char *path, JoError *error);
/* Creates a sweep's file in memory, which jox_sweep_write_file writes to `path` as a whole. */
bool jox_sweep_open_in_memory(JoxSweepStore *store, const char *path, JoError *error);
bool jox_sweep_write_file(const JoxSweepStore *store, JoError *error);
void jox_sweep_close(JoxSweepStore *store);
/* Returns false with an `error` that the file is damaged. */
bool jox_sweep_refuse_damaged(const JoxSweepStore *store, JoError *error);
/* Whether all pages of a file are whole; false with `error`. */
bool jox_sweep_is_whole(const JoxSweepStore *store, JoError *error);
/* Attaches the sweep's file at a path to the connection, as the database `part`. */
bool jox_sweep_attach_part(const JoxSweepStore *store, const char *path, JoError *error);

/* Describes SQLite's last error in `error`; always returns false. */
bool jox_sweep_set_error(const JoxSweepStore *store, JoError *error);
/* Prepares a statement; NULL with `error` if that fails. */
sqlite3_stmt *jox_sweep_prepare(const JoxSweepStore *store, const char *sql, JoError *error);
/* Finalizes a statement; NULL is fine. */
void jox_sweep_finalize(const JoxSweepStore *store, sqlite3_stmt *statement);
/* Executes SQL that returns no rows; false with `error`. */
bool jox_sweep_execute(const JoxSweepStore *store, const char *sql, JoError *error);
/* Steps a statement that returns no rows, and finalizes it; false with `error`. NULL fails. */
bool jox_sweep_step_once(const JoxSweepStore *store, sqlite3_stmt *statement, JoError *error);

/* Stores a value or an input file that all runs share. If the file has it already with another
   value, nothing is stored, and a line about the difference is added to `differences`. Returns
   false with `error`. */
bool jox_sweep_note_value(const JoxSweepStore *store, const char *key, const char *value,
                          JoxText *differences, JoError *error);
bool jox_sweep_note_input(const JoxSweepStore *store, const char *path, const char *text,
                          size_t length, JoxText *differences, JoError *error);
/* Finds the id of a variant by its key, and adds the variant if it is missing. */
bool jox_sweep_find_variant(const JoxSweepStore *store, const char *key, int64_t *id,
                            JoError *error);
/* Finds the JoxSweepState of a run; *state is -1 if the run is not stored. */
bool jox_sweep_find_state(const JoxSweepStore *store, int64_t variant, uint64_t seed, int *state,
                          JoError *error);
/* Finds the same by the key of a variant, which the file may lack. */
bool jox_sweep_find_run(const JoxSweepStore *store, const char *key, uint64_t seed, int *state,
                        JoError *error);
/* Stores the results of a run in place of older ones; `pieces` are those of jox_sweep_simulate. */
bool jox_sweep_put_run(const JoxSweepStore *store, int64_t variant, uint64_t seed,
                       const JoxText *pieces, JoError *error);
/* Stores a run that failed without results, such as one whose process crashed, with the reason. */
bool jox_sweep_put_failure(const JoxSweepStore *store, int64_t variant, uint64_t seed,
                           const char *why, JoError *error);

/* Deletes all plans, and all runs except those of the `count` seeds from `first` on. */
bool jox_sweep_keep_seeds(const JoxSweepStore *store, uint64_t first, uint32_t count,
                          JoError *error);

/* ---- planned.c: which runs a file is to have ---- */

/* Notes a plan: what it adds to the plans noted before is missing until it is stored. */
bool jox_sweep_note_plan(const JoxSweepStore *store, const JoxSweepPlan *plan, JoError *error);
/* Copies the plans of one file to another. */
bool jox_sweep_copy_plans(const JoxSweepStore *from, const JoxSweepStore *to, JoError *error);
/* Called for each plan of a file, in order; false with `error` ends the walk. */
typedef bool JoxSweepVisitPlan(void *context, const JoxSweepPlan *plan, JoError *error);
bool jox_sweep_visit_plans(const JoxSweepStore *store, JoxSweepVisitPlan *visit, void *context,
                           JoError *error);
/* Counts the runs that plans name and the file lacks, and appends up to 20 lines that name them,
   "  run 5: count=30, seed 2". */
bool jox_sweep_find_missing(const JoxSweepStore *store, uint32_t *missing, JoxText *lines,
                            JoError *error);

#endif
