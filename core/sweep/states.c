/* The states of a sweep's runs, in its file and in the files of single runs: jo_sweep_states, for
   `jostle sweep --list` and `--status`. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/hash.h"
#include "sweep/inputs.h"

enum { LARGEST_INPUT = 64 << 20 }; /* bytes */

/* The hash of an input as it is on the disk; "": it cannot be read. */
typedef struct Input {
    char *path, sha256[65];
} Input;

typedef struct States {
    const JoSweepDef *def;
    const JoxSweepPlan *plan;
    char **names;  /* by variant */
    Input *inputs; /* inputs read so far, with their hashes */
    size_t input_count, capacity;
    JoxSweepStore out; /* the sweep's file, if `has_out` */
    bool has_out;
    const char *folder;
    JoSweepEachRun *each;
    void *context;
} States;

static bool has_content(const char *path) {
    struct stat info;
    return stat(path, &info) == 0 && info.st_size > 0;
}

static const char *find_input_hash(States *s, const char *path) {
    for (size_t k = 0; k < s->input_count; k++)
        if (strcmp(s->inputs[k].path, path) == 0)
            return s->inputs[k].sha256;
    JOX_RESERVE(s->inputs, s->capacity, s->input_count + 1);
    Input *input = &s->inputs[s->input_count++];
    size_t length = 0;
    char *text = jox_read_file(path, LARGEST_INPUT, &length);
    *input = (Input){.path = jox_strdup(path)};
    if (text)
        jox_sha256_hex(text, length, input->sha256);
    jox_free(text);
    return input->sha256;
}

/* Opens a file to read, and refuses one that was made from other inputs than those on the disk.
   Close the store even then. */
static bool open_made_alike(States *s, const char *path, JoxSweepStore *store, JoError *error) {
    JoxText differences = {0};
    bool good = jox_sweep_open_to_read(store, path, error) &&
                jox_sweep_note_settings(store, s->def, &differences, error);
    sqlite3_stmt *rows =
        good ? jox_sweep_prepare(store, "SELECT path, sha256 FROM input ORDER BY path", error)
             : NULL;
    int code = SQLITE_ERROR;
    while (rows && (code = sqlite3_step(rows)) == SQLITE_ROW) {
        const char *input = (const char *)sqlite3_column_text(rows, 0);
        const char *was = (const char *)sqlite3_column_text(rows, 1);
        const char *is = input ? find_input_hash(s, input) : "";
        if (!was || strcmp(is, was) != 0)
            jox_text_printf(&differences, "  %s %s\n", input ? input : "",
                            *is ? "has changed" : "cannot be read");
    }
    good = good && rows && (code == SQLITE_DONE || jox_sweep_set_error(store, error));
    jox_sweep_finalize(store, rows);
    if (good && differences.length) {
        differences.data[differences.length - 1] = 0; /* the last end of line */
        jox_error(error, JO_INPUT,
                  "%.300s was made from other inputs: bring these back, remove it, or give another "
                  "--out:\n%.500s",
                  path, differences.data);
        good = false;
    }
    jox_text_free(&differences);
    return good;
}

/* Finds the state of a run in the file of this run alone; -1 if there is none. */
static bool find_state_in_part(States *s, const char *part, const char *key, uint64_t seed,
                               int *state, JoError *error) {
    JoxSweepStore store;
    *state = -1;
    if (!has_content(part))
        return true;
    const bool good = open_made_alike(s, part, &store, error) &&
                      jox_sweep_find_run(&store, key, seed, state, error);
    jox_sweep_close(&store);
    return good;
}

static bool tell_state(States *s, uint32_t variant, uint32_t n, JoError *error) {
    const char *key = s->plan->variants[variant].key;
    const uint64_t seed = s->plan->first_seed + n;
    const uint32_t number = 1 + variant * s->plan->seeds + n;
    int state = -1;
    JoxText part = {0};
    jox_text_printf(&part, "%s/run-%06u.sqlite", s->folder, number);
    const bool good = (!s->has_out || jox_sweep_find_run(&s->out, key, seed, &state, error)) &&
                      (state >= 0 || find_state_in_part(s, part.data, key, seed, &state, error));
    if (good)
        s->each(s->context,
                &(JoSweepRunState){.number = number,
                                   .seed = seed,
                                   .variant = s->names[variant],
                                   .state = state < 0 ? "missing" : jox_sweep_states[state],
                                   .part = part.data});
    jox_text_free(&part);
    return good;
}

bool jo_sweep_states(const JoSweepDef *def, const char *folder, JoSweepEachRun *each, void *context,
                     JoError *error) {
    JOX_REQUIRE(def && def->seeds > 0 && folder && each, false);
    JOX_GUARD (NULL, error)
        return false;
    JoxSweepPlan plan;
    States s = {.def = def, .plan = &plan, .folder = folder, .each = each, .context = context};
    bool good = jox_sweep_make_plan(&plan, def->sets, def->set_count,
                                    def->scene.has_seed ? def->scene.seed : 1, def->seeds, error);
    if (good && def->out && has_content(def->out)) {
        good = open_made_alike(&s, def->out, &s.out, error);
        s.has_out = true;
    }
    s.names = good ? jox_sweep_name_plan(&plan) : NULL;
    for (uint32_t v = 0; good && v < plan.variant_count; v++)
        for (uint32_t n = 0; good && n < plan.seeds; n++)
            good = tell_state(&s, v, n, error);
    for (uint32_t v = 0; s.names && v < plan.variant_count; v++)
        jox_free(s.names[v]);
    jox_free(s.names);
    for (size_t k = 0; k < s.input_count; k++)
        jox_free(s.inputs[k].path);
    jox_free(s.inputs);
    if (s.has_out)
        jox_sweep_close(&s.out);
    jox_sweep_free_plan(&plan);
    return good;
}
