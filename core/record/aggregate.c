#include "record/aggregate.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/json.h"
#include "base/mem.h"

/* Numbers by path; values[k] of the k-th text. */
typedef struct Figure {
    char *path;
    double *values;
    size_t count;
} Figure;

typedef struct Reader {
    Figure *figures;
    size_t count, capacity, texts, text; /* `text`: the one being read */
    bool bad;
} Reader;

static void add_number(void *context, const char *path, double value) {
    Reader *r = context;
    size_t f = 0;
    while (f < r->count && strcmp(r->figures[f].path, path) != 0)
        f++;
    if (f == r->count && r->text == 0) {
        JOX_RESERVE(r->figures, r->capacity, r->count + 1);
        r->figures[r->count++] = (Figure){jox_strdup(path), jox_alloc(r->texts, sizeof(double)), 0};
    }
    /* Those that an earlier text lacks, or that this one repeats, are left out. */
    if (f < r->count && r->figures[f].count == r->text)
        r->figures[f].values[r->figures[f].count++] = value;
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Between the ranks about share * (n - 1). */
static double quantile(const Figure *f, double share) {
    double at = share * (double)(f->count - 1);
    size_t low = (size_t)at, high = low + 1 < f->count ? low + 1 : low;
    return f->values[low] + (at - (double)low) * (f->values[high] - f->values[low]);
}

bool jox_aggregate(const char *const *texts, size_t count, JoxText *out) {
    Reader r = {.texts = count};
    for (size_t t = 0; t < count && !r.bad; t++) {
        r.text = t;
        r.bad = !jox_json_numbers(texts[t], add_number, &r);
    }
    jox_text_printf(out, "{\n \"runs\": %zu,\n \"figures\": {", count);
    bool first = true;
    for (size_t f = 0; f < r.count; f++) {
        Figure *figure = &r.figures[f];
        if (figure->count == count && !r.bad) {
            double sum = 0.0;
            qsort(figure->values, count, sizeof *figure->values, ascending);
            for (size_t k = 0; k < count; k++)
                sum += figure->values[k];
            jox_text_add(out, first ? "\n  " : ",\n  ");
            jox_text_json(out, figure->path);
            jox_text_printf(out, ": {\"mean\": %.9g, \"p5\": %.9g, \"p95\": %.9g}",
                            sum / (double)count, quantile(figure, 0.05), quantile(figure, 0.95));
            first = false;
        }
        jox_free(figure->path);
        jox_free(figure->values);
    }
    jox_free(r.figures);
    jox_text_add(out, "\n }\n}\n");
    return !r.bad;
}
