#include "report/page_table.h"

#include <math.h>
#include <string.h>

#include "base/format/quote.h"
#include "base/mem.h"
#include "picture/html.h"
#include "picture/plot.h"

/* A column's head in parts. */
typedef struct TableHead {
    char name[96], unit[24];
    bool right;
} TableHead;

/* Splits the heads; returns their number. */
static uint32_t split_heads(const char *heads, TableHead out[JOX_TABLE_COLUMNS]) {
    uint32_t count = 0;
    while (*heads && count < JOX_TABLE_COLUMNS) {
        TableHead *head = &out[count++];
        size_t length = strcspn(heads, "|");
        head->right = *heads == '>';
        snprintf(head->name, sizeof head->name, "%.*s", (int)length - head->right,
                 heads + head->right);
        *head->unit = 0;
        char *unit = strstr(head->name, " [");
        if (unit) {
            snprintf(head->unit, sizeof head->unit, "%.*s", (int)strcspn(unit + 2, "]"), unit + 2);
            *unit = 0;
        }
        heads += length + (heads[length] == '|');
    }
    return count;
}

static JoxTableCell *add_table_cell(JoxPageTable *t) {
    TableHead heads[JOX_TABLE_COLUMNS];
    if (t->columns == 0)
        t->columns = split_heads(t->heads, heads);
    JOX_RESERVE(t->cells, t->capacity, t->count + 1);
    t->cells[t->count] = (JoxTableCell){0};
    return &t->cells[t->count++];
}

void jox_table_text(JoxPageTable *t, const char *text) {
    add_table_cell(t)->text = jox_strdup(text ? text : "");
}

void jox_table_unit(JoxPageTable *t, const char *unit) {
    JoxTableCell *cell = add_table_cell(t);
    cell->text = jox_strdup(unit);
    cell->is_unit = true;
}

void jox_table_number(JoxPageTable *t, double value) {
    add_table_cell(t)->value = value;
}

static bool is_empty(const JoxTableCell *cell) {
    return cell->text && !*cell->text;
}

static bool is_nothing(const JoxTableCell *cell) {
    return !cell->text && !(cell->value != 0.0 && isfinite(cell->value));
}

/* Returns whether a row has numbers, and all of them are 0 or not known. */
static bool is_zero_row(const JoxPageTable *t, uint32_t row) {
    uint32_t numbers = 0;
    for (uint32_t c = 0; c < t->columns; c++) {
        const JoxTableCell *cell = &t->cells[row * t->columns + c];
        if (!cell->text && !is_nothing(cell))
            return false;
        numbers += !cell->text;
    }
    return numbers > 0;
}

/* Returns whether all cells of a column are empty, 0 or not known. */
static bool is_zero_column(const JoxPageTable *t, uint32_t column) {
    for (uint32_t r = 0; r < t->count / t->columns; r++)
        if (!is_nothing(&t->cells[r * t->columns + column]) &&
            !is_empty(&t->cells[r * t->columns + column]))
            return false;
    return true;
}

/* ---- the page ---- */

static void put_table_cell(FILE *out, const JoxTableCell *cell, const TableHead *head) {
    if (!cell->text)
        jox_html_cell_number(out, cell->value, "");
    else if (head->right) {
        fputs("<td class=n>", out);
        jox_html_text(out, cell->text);
    } else
        jox_html_cell(out, cell->is_unit ? jox_html_unit(cell->text) : cell->text);
}

/* Writes the rows and columns that are not zero throughout. */
static void put_table_rows(FILE *out, const JoxPageTable *t, const TableHead *heads,
                           const bool *left_out) {
    JoxText shown = {0};
    for (uint32_t c = 0; c < t->columns; c++) {
        if (left_out[c])
            continue;
        jox_text_printf(&shown, "%s%s%s", shown.length ? "|" : "", heads[c].right ? ">" : "",
                        heads[c].name);
        if (*heads[c].unit)
            jox_text_printf(&shown, ",\xc2\xa0%s", jox_html_unit(heads[c].unit));
    }
    jox_html_table(out, shown.data ? shown.data : "");
    jox_text_free(&shown);
    for (uint32_t r = 0, rows = 0; r < t->count / t->columns; r++) {
        if ((t->zero_rows && is_zero_row(t, r)) || (t->most_rows && rows == t->most_rows))
            continue;
        rows++;
        jox_html_row(out);
        for (uint32_t c = 0; c < t->columns; c++)
            if (!left_out[c])
                put_table_cell(out, &t->cells[r * t->columns + c], &heads[c]);
    }
    jox_html_table_end(out);
}

/* Writes sentences that name the rows and columns that the page's table lacks. */
static void put_left_out(FILE *out, const JoxPageTable *t, const TableHead *heads,
                         const bool *left_out) {
    JoxText rows = {0}, columns = {0};
    for (uint32_t r = 0; t->zero_rows && r < t->count / t->columns; r++)
        if (is_zero_row(t, r) && t->cells[r * t->columns].text)
            jox_text_printf(&rows, "%s%s", rows.length ? "; " : "", t->cells[r * t->columns].text);
    for (uint32_t c = 0; c < t->columns; c++)
        if (left_out[c] && !is_empty(&t->cells[c]))
            jox_text_printf(&columns, "%s%s", columns.length ? "; " : "", heads[c].name);
    if (rows.length) {
        JoxText text = {0};
        jox_text_printf(&text, "%s: %s.", t->zero_rows, rows.data);
        jox_html_paragraph(out, text.data);
        jox_text_free(&text);
    }
    if (columns.length) {
        JoxText text = {0};
        jox_text_printf(&text, "Columns left out, as all is 0 or not known: %s.", columns.data);
        jox_html_paragraph(out, text.data);
        jox_text_free(&text);
    }
    jox_text_free(&rows);
    jox_text_free(&columns);
}

/* ---- the file ---- */

static bool write_table_csv(const JoxPageTable *t, const TableHead *heads, const char *file,
                            JoxText *error) {
    FILE *out = jox_plot_open(t->folder, file, error);
    if (!out)
        return false;
    for (uint32_t c = 0; c < t->columns; c++) {
        JoxText head = {0};
        jox_text_printf(&head, *heads[c].unit ? "%s [%s]" : "%s", heads[c].name, heads[c].unit);
        fputs(c ? "," : "", out);
        jox_quote_put(out, jox_quote_csv, head.data);
        jox_text_free(&head);
    }
    for (uint32_t k = 0; k < t->count; k++) {
        fputs(k % t->columns ? "," : "\n", out);
        if (t->cells[k].text)
            jox_quote_put(out, jox_quote_csv, t->cells[k].text);
        else if (isfinite(t->cells[k].value))
            fprintf(out, "%.9g", t->cells[k].value);
    }
    fputc('\n', out);
    return jox_plot_close(out, file, error);
}

void jox_table_put(FILE *out, JoxPageTable *t) {
    TableHead heads[JOX_TABLE_COLUMNS];
    bool left_out[JOX_TABLE_COLUMNS] = {false};
    JoxText file = {0};
    const uint32_t rows = t->columns ? t->count / t->columns : 0;
    uint32_t shown = 0;
    split_heads(t->heads, heads);
    for (uint32_t c = 0; rows && c < t->columns; c++)
        left_out[c] = is_zero_column(t, c);
    for (uint32_t r = 0; r < rows; r++)
        shown += !(t->zero_rows && is_zero_row(t, r));
    if (shown)
        put_table_rows(out, t, heads, left_out);
    else
        memset(left_out, 0, sizeof left_out);
    if (t->most_rows && shown > t->most_rows) {
        char text[80];
        snprintf(text, sizeof text, "%u more rows are in the file.", shown - t->most_rows);
        jox_html_paragraph(out, text);
    }
    if (rows) {
        jox_text_printf(&file, "table-%s.csv", t->name);
        if (write_table_csv(t, heads, file.data, t->error))
            jox_html_csv(out, file.data);
        put_left_out(out, t, heads, left_out);
    }
    jox_text_free(&file);
    for (uint32_t k = 0; k < t->count; k++)
        jox_free(t->cells[k].text);
    jox_free(t->cells);
    t->cells = NULL;
    t->count = t->capacity = 0;
}
