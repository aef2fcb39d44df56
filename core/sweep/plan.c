/* Makes the plan of a sweep from its settings: every combination of the values that they take. Also
   names variants by the settings in which they differ. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/guard.h"
#include "base/mem.h"
#include "base/text.h"
#include "sweep/sweep.h"

/* Returns the end of the value that begins at `text`: a comma outside brackets, braces and quotes,
   or the end of the list. NULL if one of these is not closed. */
static const char *end_of_value(const char *text) {
    int depth = 0;
    char quote = 0;
    for (; *text; text++) {
        if (quote)
            quote = *text == quote ? 0 : quote;
        else if (*text == '"' || *text == '\'')
            quote = *text;
        else if (strchr("[{(", *text))
            depth++;
        else if (strchr("]})", *text))
            depth--;
        else if (*text == ',' && depth == 0)
            return text;
    }
    return quote || depth != 0 ? NULL : text;
}

static bool refuse_set(JoError *error, const char *set, const char *what) {
    jox_error(error, JO_USAGE, "--set %.120s: %s", set, what);
    return false;
}

/* Adds the value between `from` and `to`, without blanks around it. */
static bool add_axis_value(JoxSweepAxis *axis, const char *set, const char *from, const char *to,
                           JoError *error) {
    while (from < to && isspace((unsigned char)*from))
        from++;
    while (to > from && isspace((unsigned char)to[-1]))
        to--;
    if (from == to)
        return refuse_set(error, set, "a value of the list is empty: PATH=A,B,C");
    char *value = jox_strndup(from, (size_t)(to - from));
    JOX_RESERVE(axis->values, axis->capacity, axis->count + 1);
    axis->values[axis->count++] = value;
    return true;
}

static int compare_values(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Returns whether a value stands twice in the list. */
static bool has_twice(const JoxSweepAxis *axis) {
    char **sorted = jox_alloc(axis->count, sizeof *sorted);
    bool twice = false;
    memcpy(sorted, axis->values, axis->count * sizeof *sorted);
    qsort(sorted, axis->count, sizeof *sorted, compare_values);
    for (uint32_t v = 1; v < axis->count; v++)
        twice |= strcmp(sorted[v - 1], sorted[v]) == 0;
    jox_free(sorted);
    return twice;
}

/* Reads "PATH=A,B,C" into an axis; false with `error`. */
static bool read_axis(JoxSweepAxis *axis, const char *set, JoError *error) {
    const char *equals = strchr(set, '=');
    if (!equals || equals == set)
        return refuse_set(error, set, "is written PATH=VALUE, or PATH=A,B,C for a variant of each");
    axis->path = jox_strndup(set, (size_t)(equals - set));
    for (const char *at = equals + 1, *end;; at = end + 1) {
        end = end_of_value(at);
        if (!end)
            return refuse_set(error, set, "a bracket or quote is not closed");
        if (!add_axis_value(axis, set, at, end, error))
            return false;
        if (!*end)
            break;
    }
    return !has_twice(axis) || refuse_set(error, set, "a value stands in the list twice");
}

static bool read_axes(JoxSweepPlan *plan, const char *const *sets, size_t count, JoError *error) {
    plan->axes = jox_alloc(count + 1, sizeof *plan->axes);
    for (size_t s = 0; s < count; s++) {
        JoxSweepAxis *axis = &plan->axes[plan->axis_count++];
        if (!sets || !sets[s])
            return refuse_set(error, "NULL", "is no setting");
        if (!read_axis(axis, sets[s], error))
            return false;
        for (uint32_t a = 0; a + 1 < plan->axis_count; a++)
            if (strcmp(plan->axes[a].path, axis->path) == 0)
                return refuse_set(error, sets[s],
                                  "this path is set twice; give all of its values in one list");
    }
    return true;
}

/* Decodes the number of a variant into one value of each axis, the last axis fastest. */
static void make_variant(const JoxSweepPlan *plan, uint32_t number, JoxSweepVariant *v) {
    JoxText key = {0};
    v->sets = jox_alloc(plan->axis_count + 1, sizeof *v->sets);
    v->set_count = plan->axis_count;
    for (uint32_t a = plan->axis_count; a-- > 0;) {
        const JoxSweepAxis *axis = &plan->axes[a];
        JoxText set = {0};
        jox_text_printf(&set, "%s=%s", axis->path, axis->values[number % axis->count]);
        v->sets[a] = set.data;
        number /= axis->count;
    }
    for (uint32_t a = 0; a < plan->axis_count; a++)
        jox_text_printf(&key, "%s%s", a ? "\n" : "", v->sets[a]);
    v->key = key.data ? key.data : jox_strdup("");
}

bool jox_sweep_make_plan(JoxSweepPlan *plan, const char *const *sets, size_t count,
                         uint64_t first_seed, uint32_t seeds, JoError *error) {
    *plan = (JoxSweepPlan){.first_seed = first_seed, .seeds = seeds};
    if (!read_axes(plan, sets, count, error))
        return false;
    double variants = 1;
    for (uint32_t a = 0; a < plan->axis_count; a++)
        variants *= plan->axes[a].count;
    if (variants * seeds > JOX_SWEEP_RUNS) {
        jox_error(error, JO_USAGE, "these are %.0f variants of %u seeds; %d runs are the most",
                  variants, seeds, JOX_SWEEP_RUNS);
        return false;
    }
    if (first_seed > (uint64_t)INT64_MAX - seeds) {
        jox_error(error, JO_USAGE, "seeds of a sweep are below 2^63");
        return false;
    }
    plan->variant_count = (uint32_t)variants;
    plan->variants = jox_alloc(plan->variant_count, sizeof *plan->variants);
    for (uint32_t v = 0; v < plan->variant_count; v++)
        make_variant(plan, v, &plan->variants[v]);
    return true;
}

void jox_sweep_free_plan(JoxSweepPlan *plan) {
    for (uint32_t a = 0; plan->axes && a < plan->axis_count; a++) {
        for (uint32_t v = 0; v < plan->axes[a].count; v++)
            jox_free(plan->axes[a].values[v]);
        jox_free(plan->axes[a].values);
        jox_free(plan->axes[a].path);
    }
    for (uint32_t v = 0; plan->variants && v < plan->variant_count; v++) {
        for (uint32_t s = 0; s < plan->variants[v].set_count; s++)
            jox_free(plan->variants[v].sets[s]);
        jox_free(plan->variants[v].sets);
        jox_free(plan->variants[v].key);
    }
    jox_free(plan->axes);
    jox_free(plan->variants);
    *plan = (JoxSweepPlan){0};
}

/* ---- names ---- */

/* Returns the line of a key that sets a path, or NULL. */
static const char *find_set_line(const char *key, const char *path, size_t length) {
    for (const char *line = key; *line;) {
        if (strncmp(line, path, length) == 0 && line[length] == '=')
            return line;
        line += strcspn(line, "\n");
        line += *line == '\n';
    }
    return NULL;
}

/* Compares two lines, each of which ends at a line break or may be NULL. */
static bool are_lines_equal(const char *a, const char *b) {
    const size_t n = a ? strcspn(a, "\n") : 0, m = b ? strcspn(b, "\n") : 0;
    return !a == !b && n == m && strncmp(a ? a : "", b ? b : "", n) == 0;
}

/* The paths that the keys set, each once. A cache: with many variants, comparing all keys for each
   name would take minutes. */
typedef struct Path {
    const char *text;
    size_t length;
    bool differs; /* the keys set it to different values */
} Path;
typedef struct Paths {
    const char *const *keys;
    uint32_t key_count;
    Path *items;
    size_t count, capacity;
} Paths;

static bool do_keys_differ(const Paths *paths, const char *path, size_t length) {
    const char *first = find_set_line(paths->keys[0], path, length);
    for (uint32_t k = 1; k < paths->key_count; k++)
        if (!are_lines_equal(find_set_line(paths->keys[k], path, length), first))
            return true;
    return false;
}

/* Returns whether the variants set a path to different values; computed once per path. */
static bool is_path_varied(Paths *paths, const char *path, size_t length) {
    for (size_t p = 0; p < paths->count; p++)
        if (paths->items[p].length == length && !memcmp(paths->items[p].text, path, length))
            return paths->items[p].differs;
    JOX_RESERVE(paths->items, paths->capacity, paths->count + 1);
    Path *fresh = &paths->items[paths->count++];
    *fresh = (Path){path, length, do_keys_differ(paths, path, length)};
    return fresh->differs;
}

/* Returns where the last name of a path begins; the path ends at `end`. */
static const char *find_last_name(const char *path, const char *end) {
    while (end > path && end[-1] != '.')
        end--;
    return end;
}

/* Returns the end of a path that serves as its short name: what follows the last dot. If a number
   precedes it, as in "walls.3.open", the list and the number are included. */
static const char *find_path_tail(const char *path, size_t length) {
    const char *at = find_last_name(path, path + length);
    const char *before = at > path ? find_last_name(path, at - 1) : at;
    const bool in_list = before < at && strspn(before, "0123456789") == (size_t)(at - 1 - before);
    return !in_list ? at : before > path ? find_last_name(path, before - 1) : before;
}

/* Returns whether the key sets another path that varies and has the same short name. */
static bool is_tail_ambiguous(Paths *paths, const char *key, const char *path, size_t length) {
    const char *tail = find_path_tail(path, length);
    const size_t size = (size_t)(path + length - tail);
    for (const char *line = key; *line;) {
        const size_t n = strcspn(line, "=");
        const char *other = find_path_tail(line, n);
        if (line != path && (size_t)(line + n - other) == size && memcmp(other, tail, size) == 0 &&
            is_path_varied(paths, line, n))
            return true;
        line += strcspn(line, "\n");
        line += *line == '\n';
    }
    return false;
}

void jox_sweep_name_variants(const char *const *keys, uint32_t count, char **names) {
    Paths paths = {.keys = keys, .key_count = count};
    for (uint32_t k = 0; k < count; k++) {
        JoxText name = {0};
        for (const char *line = keys[k]; *line;) {
            const size_t n = strcspn(line, "="), all = strcspn(line, "\n");
            if (is_path_varied(&paths, line, n)) {
                const char *from =
                    is_tail_ambiguous(&paths, keys[k], line, n) ? line : find_path_tail(line, n);
                jox_text_printf(&name, "%s%.*s", name.length ? ", " : "", (int)(line + all - from),
                                from);
            }
            line += all;
            line += *line == '\n';
        }
        names[k] = name.data ? name.data : jox_strdup("");
    }
    jox_free(paths.items);
}

char **jox_sweep_name_plan(const JoxSweepPlan *plan) {
    const char **keys = jox_alloc(plan->variant_count, sizeof *keys);
    char **names = jox_alloc(plan->variant_count, sizeof *names);
    for (uint32_t v = 0; v < plan->variant_count; v++)
        keys[v] = plan->variants[v].key;
    jox_sweep_name_variants(keys, plan->variant_count, names);
    jox_free(keys);
    return names;
}
