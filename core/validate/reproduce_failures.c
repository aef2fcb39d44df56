/* Collects from the runs of all claims how often people had no solution, for a table by scene on
   the page and in table.md. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/json.h"
#include "base/format/quote.h"
#include "base/mem.h"
#include "base/sort.h"
#include "picture/html.h"
#include "validate/reproduce.h"

/* Shares of agent-steps that a summary has, in the order of the table's columns. */
static const char *const SHARES[] = {"lp_failure_share", "turned_aside_share",
                                     "plans_bounded_share"};
enum { SHARE_COUNT = sizeof SHARES / sizeof *SHARES };

/* The runs of a scene with one mode of forces. */
typedef struct Row {
    const char *scene; /* path, of the first job */
    char forces[16];   /* "physical", "literal", "off" */
    uint32_t runs;
    double sums[SHARE_COUNT], most_failing;
} Row;

typedef struct Rows {
    Row *items;
    uint32_t count;
    size_t capacity;
} Rows;

/* Reads a value of a summary into the row `context`. */
static bool read_share(void *context, const JoxJsonItem *item) {
    Row *run = context;
    if (item->kind == JOX_JSON_TEXT && !strcmp(item->path, "forces"))
        snprintf(run->forces, sizeof run->forces, "%s", item->text);
    for (int s = 0; item->kind == JOX_JSON_NUMBER && s < SHARE_COUNT; s++)
        if (!strcmp(item->path, SHARES[s]))
            run->sums[s] = item->number;
    return true;
}

/* Adds a run to the row of its scene and mode. */
static void add_run(Rows *rows, const Row *run) {
    Row *row = rows->items, *end = row + rows->count;
    while (row < end && (strcmp(row->scene, run->scene) || strcmp(row->forces, run->forces)))
        row++;
    if (row == end) {
        JOX_RESERVE(rows->items, rows->capacity, rows->count + 1);
        row = &rows->items[rows->count++];
        *row = (Row){.scene = run->scene};
        memcpy(row->forces, run->forces, sizeof row->forces);
    }
    row->runs++;
    for (int s = 0; s < SHARE_COUNT; s++)
        row->sums[s] += run->sums[s];
    row->most_failing = fmax(row->most_failing, run->sums[0]);
}

/* Orders rows by the share that fails, the greatest first, then by scene and mode. */
static int compare_rows(const void *left, const void *right, const void *context) {
    (void)context;
    const Row *a = left, *b = right;
    const double x = a->sums[0] / a->runs, y = b->sums[0] / b->runs;
    const int scenes = strcmp(a->scene, b->scene);
    return x > y ? -1 : x < y ? 1 : scenes ? scenes : strcmp(a->forces, b->forces);
}

/* Collects the rows of all runs that had people, for the caller to free `items`. */
static Rows collect_rows(const JoxReproduction *all) {
    Rows rows = {0};
    for (uint32_t j = 0; j < all->job_count; j++) {
        const JoxJob *job = &all->jobs[j];
        char *summary = job->state == JOX_JOB_DONE ? jox_job_read(job, "summary.json") : NULL;
        Row run = {.scene = job->run->scene, .sums = {NAN, NAN, NAN}};
        if (summary && jox_json_read(summary, jox_json_own_files, read_share, &run) &&
            isfinite(run.sums[0]))
            add_run(&rows, &run);
        jox_free(summary);
    }
    if (rows.count)
        jox_sort(rows.items, rows.count, sizeof *rows.items, compare_rows, NULL, NULL);
    return rows;
}

static const char EXPLANATION[] =
    "Share of agent-steps whose linear program has no velocity that meets all constraints, so "
    "that the least violated one is taken; whose wanted velocity was turned aside; and whose "
    "contacts or forces were lowered to what is within reach. Means over all runs of a scene "
    "above, nulls among them.";

void jox_reproduce_put_failures(const JoxReproduction *all, FILE *out) {
    Rows rows = collect_rows(all);
    jox_html_heading(out, "How often people had no solution");
    jox_html_paragraph(out, EXPLANATION);
    jox_html_table(out,
                   "scene|forces|>runs|>no solution|>greatest of a run|>turned aside|>bounded");
    for (uint32_t r = 0; r < rows.count; r++) {
        const Row *row = &rows.items[r];
        jox_html_row(out);
        jox_html_cell(out, row->scene);
        jox_html_cell(out, row->forces);
        jox_html_cell_number(out, row->runs, "");
        jox_html_cell_number(out, 100.0 * row->sums[0] / row->runs, "%");
        jox_html_cell_number(out, 100.0 * row->most_failing, "%");
        for (int s = 1; s < SHARE_COUNT; s++)
            jox_html_cell_number(out, 100.0 * row->sums[s] / row->runs, "%");
    }
    jox_html_table_end(out);
    jox_free(rows.items);
}

void jox_reproduce_write_failures(const JoxReproduction *all, FILE *out) {
    Rows rows = collect_rows(all);
    fprintf(
        out,
        "\n%s\n\n| scene | forces | runs | no solution, %% | greatest of a run | turned aside | "
        "bounded |\n|---|---|---|---|---|---|---|\n",
        EXPLANATION);
    for (uint32_t r = 0; r < rows.count; r++) {
        const Row *row = &rows.items[r];
        fputs("| ", out);
        jox_quote_put(out, jox_quote_markdown, row->scene);
        fprintf(out, " | %s | %u | %.3g | %.3g", row->forces, row->runs,
                100.0 * row->sums[0] / row->runs, 100.0 * row->most_failing);
        for (int s = 1; s < SHARE_COUNT; s++)
            fprintf(out, " | %.3g", 100.0 * row->sums[s] / row->runs);
        fputs(" |\n", out);
    }
    jox_free(rows.items);
}
