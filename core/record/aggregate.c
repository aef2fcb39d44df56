/* Joins summaries of several runs: reads each as a list of path and value, then writes the
   statistics of each path. */
#include "record/aggregate.h"

#include <fnmatch.h>
#include <string.h>

#include "base/format/json.h"
#include "base/format/json_writer.h"
#include "base/mem.h"
#include "base/number/statistics.h"

/* Kinds by path; the first matching row counts. `*` matches any characters. */
static const struct {
    const char *path;
    JoxSummaryKind kind;
} KINDS[] = {
    {"danger.*_person", JOX_SUMMARY_GIVEN},
    {"stood_longest.s", JOX_SUMMARY_FIGURE},
    {"danger.samples", JOX_SUMMARY_GIVEN},
    {"danger.limits.*.limit", JOX_SUMMARY_GIVEN},
    {"danger.congestion.limit", JOX_SUMMARY_GIVEN},
    {"danger.congestion.share", JOX_SUMMARY_GIVEN},
    {"danger.congestion.where.*", JOX_SUMMARY_GIVEN},
    {"danger.*_x", JOX_SUMMARY_GIVEN},
    {"danger.*_y", JOX_SUMMARY_GIVEN},
    {"danger.*_storey", JOX_SUMMARY_GIVEN},
    {"probes.*.why.*", JOX_SUMMARY_GIVEN},
    {"probes.*.from", JOX_SUMMARY_GIVEN},
    {"probes.*.until", JOX_SUMMARY_GIVEN},
    {"danger.lines.*.from_s", JOX_SUMMARY_GIVEN},
    {"trust.overlap_share", JOX_SUMMARY_FIGURE},
    {"probes.*_x", JOX_SUMMARY_GIVEN},
    {"probes.*_y", JOX_SUMMARY_GIVEN},
    {"wall_s", JOX_SUMMARY_COST},
    {"cpu_s", JOX_SUMMARY_COST},
    {"steps_per_s", JOX_SUMMARY_COST},
    {"ns_per_agent_step", JOX_SUMMARY_COST},
    {"stage_ns.*", JOX_SUMMARY_COST},
    {"lua.*", JOX_SUMMARY_COST},
    {"agents", JOX_SUMMARY_FIGURE},
    {"bodies", JOX_SUMMARY_FIGURE},
    {"lp_failure_*", JOX_SUMMARY_FIGURE},
    {"turned_aside_share", JOX_SUMMARY_FIGURE},
    {"plans_bounded_share", JOX_SUMMARY_FIGURE},
    {"density_max", JOX_SUMMARY_FIGURE},
    {"overlap_p99", JOX_SUMMARY_FIGURE},
    {"depth_p99", JOX_SUMMARY_FIGURE},
    {"states.*", JOX_SUMMARY_FIGURE},
    {"transitions.*", JOX_SUMMARY_FIGURE},
    {"regions.*", JOX_SUMMARY_FIGURE},
    {"events.*", JOX_SUMMARY_FIGURE},
    {"bonds.*", JOX_SUMMARY_FIGURE},
    {"exchange.*", JOX_SUMMARY_FIGURE},
    {"danger.stairs.*.width", JOX_SUMMARY_GIVEN},
    {"danger.*", JOX_SUMMARY_FIGURE},
    {"lifts.*", JOX_SUMMARY_FIGURE},
    {"cannot_use_stairs.*", JOX_SUMMARY_FIGURE},
    {"probes.*", JOX_SUMMARY_FIGURE},
    {"tally.*", JOX_SUMMARY_FIGURE},
    {"game.level", JOX_SUMMARY_GIVEN},
    {"game.winner", JOX_SUMMARY_GIVEN},
    {"game.over", JOX_SUMMARY_GIVEN},
    {"game.*", JOX_SUMMARY_FIGURE},
    {"criteria.*.figure", JOX_SUMMARY_FIGURE},
    {"criteria.*.met", JOX_SUMMARY_FIGURE},
};

JoxSummaryKind jox_summary_kind(const char *path) {
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; k++)
        if (fnmatch(KINDS[k].path, path, 0) == 0)
            return KINDS[k].kind;
    return JOX_SUMMARY_GIVEN;
}

typedef struct Value {
    JoxJsonKind kind;
    double number;
    char *text; /* NULL unless the value is a text */
    bool known; /* the run has this path */
} Value;

/* Values of all runs at one path: values[k] belongs to the k-th text. */
typedef struct Entry {
    char *path;
    Value *values;
    bool is_figure;
} Entry;

typedef struct Reader {
    Entry *entries;
    size_t count, capacity, texts, text; /* `text`: index of the text being read */
} Reader;

/* Stores a number, text or truth value of the summary being read under its path. Called for each
   item by the JSON reader. */
static bool store_summary_item(void *context, const JoxJsonItem *item) {
    Reader *r = context;
    size_t e = 0;
    if (item->kind == JOX_JSON_OBJECT || item->kind == JOX_JSON_ARRAY)
        return true;
    while (e < r->count && strcmp(r->entries[e].path, item->path) != 0)
        e++;
    if (e == r->count) {
        JOX_RESERVE(r->entries, r->capacity, r->count + 1);
        r->entries[r->count++] = (Entry){jox_strdup(item->path), jox_alloc(r->texts, sizeof(Value)),
                                         jox_summary_kind(item->path) != JOX_SUMMARY_GIVEN};
    }
    Value *value = &r->entries[e].values[r->text];
    if (!value->known) /* a repeated key: the first value counts */
        *value = (Value){item->kind, item->number, jox_strdup(item->text), true};
    return true;
}

/* ---- writing ---- */

/* Writes mean and quantiles, if all runs have a number here. */
static void write_figure_statistics(JoxJson *json, const Entry *entry, size_t count,
                                    double *numbers) {
    double sum = 0.0;
    for (size_t k = 0; k < count; k++) {
        if (entry->values[k].kind != JOX_JSON_NUMBER)
            return;
        sum += numbers[k] = entry->values[k].number;
    }
    jox_json_object(json, entry->path);
    jox_json_number(json, "mean", sum / (double)count);
    jox_json_number(json, "p5", jox_quantile(numbers, count, 0.05));
    jox_json_number(json, "p95", jox_quantile(numbers, count, 0.95));
    jox_json_end(json);
}

static bool have_equal_values(const Value *a, const Value *b) {
    return a->kind == b->kind && a->number == b->number && !a->text == !b->text &&
           (!a->text || strcmp(a->text, b->text) == 0);
}

static void write_given_value(JoxJson *json, const char *key, const Value *value) {
    if (value->kind == JOX_JSON_TEXT)
        jox_json_string(json, key, value->text);
    else if (value->kind == JOX_JSON_NUMBER)
        jox_json_digits(json, key, value->number, 15);
    else if (value->kind == JOX_JSON_BOOL)
        jox_json_bool(json, key, value->number != 0.0);
    else
        jox_json_null(json, key);
}

/* Writes one value where all runs agree, else a list by run. */
static void write_given_entry(JoxJson *json, const Entry *entry, size_t count) {
    bool equal = true;
    for (size_t k = 1; k < count; k++)
        equal = equal && have_equal_values(&entry->values[k], &entry->values[0]);
    if (equal) {
        write_given_value(json, entry->path, &entry->values[0]);
        return;
    }
    jox_json_array(json, entry->path);
    for (size_t k = 0; k < count; k++)
        write_given_value(json, NULL, &entry->values[k]);
    jox_json_end(json);
}

/* Writes "given" and "figures"; paths keep the order in which they were first read. */
static void write_joined_summary(const Reader *r, size_t count, JoxText *out) {
    double *numbers = jox_alloc(count + 1, sizeof *numbers);
    JoxJson json = jox_json_begin(out, 2);
    jox_json_object(&json, NULL);
    jox_json_whole(&json, "runs", count);
    jox_json_object(&json, "given");
    for (size_t e = 0; e < r->count; e++)
        if (!r->entries[e].is_figure)
            write_given_entry(&json, &r->entries[e], count);
    jox_json_end(&json);
    jox_json_object(&json, "figures");
    for (size_t e = 0; e < r->count; e++)
        if (r->entries[e].is_figure)
            write_figure_statistics(&json, &r->entries[e], count, numbers);
    jox_json_end(&json);
    jox_json_end(&json);
    jox_text_add(out, "\n");
    jox_free(numbers);
}

bool jox_aggregate(const char *const *texts, size_t count, JoxText *out) {
    Reader r = {.texts = count};
    bool good = true;
    for (; r.text < count && good; r.text++)
        good = jox_json_read(texts[r.text], jox_json_own_files, store_summary_item, &r);
    if (good)
        write_joined_summary(&r, count, out);
    for (size_t e = 0; e < r.count; e++) {
        for (size_t k = 0; k < count; k++)
            jox_free(r.entries[e].values[k].text);
        jox_free(r.entries[e].values);
        jox_free(r.entries[e].path);
    }
    jox_free(r.entries);
    return good;
}
