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

/* Checks that an open file was made from the inputs that are on the disk. False with an error:
 *unlike tells whether it can be read, but was made from others. */
static bool is_made_alike(States *s, const JoxSweepStore *store, bool *unlike, JoError *error) {
    JoxText differences = {0};
    bool good = jox_sweep_note_settings(store, s->def, &differences, error);
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
    *unlike = good && differences.length > 0;
    if (*unlike) {
        differences.data[differences.length - 1] = 0; /* the last end of line */
        jox_error(error, JO_INPUT,
                  "%.300s was made from other inputs: bring these back, remove it, or give another "
                  "--out:\n%.500s",
                  store->path, differences.data);
        good = false;
    }
    jox_text_free(&differences);
    return good;
}

/* Finds the state of a run in the file of this run alone; -1 if there is none. `reason` tells why
   the file cannot be read; false with an error if it was made from other inputs. */
static bool find_state_in_part(States *s, const char *part, const char *key, uint64_t seed,
                               int *state, JoError *reason, JoError *error) {
    JoxSweepStore store;
    bool unlike = false;
    *state = -1;
    if (!has_content(part))
        return true;
    if (!jox_sweep_open_to_read(&store, part, reason) || !jox_sweep_is_whole(&store, reason) ||
        !is_made_alike(s, &store, &unlike, reason) ||
        !jox_sweep_find_run(&store, key, seed, state, reason))
        *state = -1;
    jox_sweep_close(&store);
    if (unlike)
        *error = *reason;
    return !unlike;
}

static bool tell_state(States *s, uint32_t variant, uint32_t n, JoError *error) {
    const char *key = s->plan->variants[variant].key;
    const uint64_t seed = s->plan->first_seed + n;
    const uint32_t number = 1 + variant * s->plan->seeds + n;
    int state = -1;
    JoError unreadable = {0};
    JoxText part = {0};
    jox_text_printf(&part, "%s/run-%06u.sqlite", s->folder, number);
    const bool good =
        (!s->has_out || jox_sweep_find_run(&s->out, key, seed, &state, error)) &&
        (state >= 0 || find_state_in_part(s, part.data, key, seed, &state, &unreadable, error));
    JoSweepRunState run = {
        .number = number, .seed = seed, .variant = s->names[variant], .part = part.data};
    run.reason = *unreadable.text ? unreadable.text : NULL;
    run.state = run.reason ? "unreadable" : state < 0 ? "missing" : jox_sweep_states[state];
    if (good)
        s->each(s->context, &run);
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
        bool unlike;
        good = jox_sweep_open_to_read(&s.out, def->out, error) &&
               is_made_alike(&s, &s.out, &unlike, error);
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
