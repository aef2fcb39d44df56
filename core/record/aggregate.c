#include "record/aggregate.h"

#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

enum { DEEPEST = 16, LONGEST_PATH = 256 };

/* Numbers by path; values[k] of the k-th text. */
typedef struct Figure {
    char *path;
    double *values;
    size_t count;
} Figure;

typedef struct Reader {
    const char *at;
    Figure *figures;
    size_t count, capacity, texts, text; /* `text`: the one being read */
    char path[LONGEST_PATH];
    bool bad;
} Reader;

static void skip_space(Reader *r) {
    while (isspace((unsigned char)*r->at))
        r->at++;
}

static bool take(Reader *r, char c) {
    skip_space(r);
    if (*r->at != c)
        return false;
    r->at++;
    return true;
}

/* Reads a string into `out` (escapes are kept as they are; paths need no more). */
static void read_string(Reader *r, char *out, size_t size) {
    size_t n = 0;
    if (!take(r, '"'))
        r->bad = true;
    while (!r->bad && *r->at && *r->at != '"') {
        if (*r->at == '\\' && r->at[1])
            r->at++;
        if (out && n + 1 < size)
            out[n++] = *r->at;
        r->at++;
    }
    if (out)
        out[n] = 0;
    r->bad |= *r->at != '"';
    r->at += *r->at == '"';
}

static void add_number(Reader *r, double value) {
    size_t f = 0;
    while (f < r->count && strcmp(r->figures[f].path, r->path) != 0)
        f++;
    if (f == r->count && r->text == 0) {
        JOX_RESERVE(r->figures, r->capacity, r->count + 1);
        r->figures[r->count++] =
            (Figure){jox_strdup(r->path), jox_alloc(r->texts, sizeof(double)), 0};
    }
    /* Those that an earlier text lacks, or that this one repeats, are left out. */
    if (f < r->count && r->figures[f].count == r->text)
        r->figures[f].values[r->figures[f].count++] = value;
}

static void read_value(Reader *r, int depth) {
    size_t length = strlen(r->path);
    skip_space(r);
    if (depth > DEEPEST) {
        r->bad = true;
    } else if (*r->at == '{' || *r->at == '[') {
        bool map = *r->at++ == '{';
        char close = map ? '}' : ']', key[64];
        for (int item = 0; !r->bad && !take(r, close); item++) {
            if (item && !take(r, ','))
                r->bad = true;
            if (map)
                read_string(r, key, sizeof key);
            else
                snprintf(key, sizeof key, "%d", item);
            if (map && !take(r, ':'))
                r->bad = true;
            snprintf(r->path + length, sizeof r->path - length, "%s%s", length ? "." : "", key);
            if (!r->bad)
                read_value(r, depth + 1);
            r->path[length] = 0;
        }
    } else if (*r->at == '"') {
        read_string(r, NULL, 0);
    } else if (isalpha((unsigned char)*r->at)) { /* true, false, null */
        static const char *const WORDS[] = {"true", "false", "null"};
        size_t length_of = 0;
        while (isalpha((unsigned char)r->at[length_of]))
            length_of++;
        bool known = false;
        for (int w = 0; w < 3; w++)
            known |= strlen(WORDS[w]) == length_of && !strncmp(r->at, WORDS[w], length_of);
        r->bad |= !known;
        r->at += length_of;
    } else {
        char *end;
        double value = strtod(r->at, &end);
        r->bad |=
            end == r->at || end > r->at + strspn(r->at, "+-.0123456789eE") || !isfinite(value);
        r->at = end;
        if (!r->bad)
            add_number(r, value);
    }
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
        r.at = texts[t];
        r.text = t;
        r.path[0] = 0;
        skip_space(&r);
        r.bad |= *r.at != '{';
        read_value(&r, 0);
        skip_space(&r);
        r.bad |= *r.at != 0;
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
