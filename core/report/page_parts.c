/* Lists and tables of figures on the pages of reports, and the section on validation. */
#include "report/page_parts.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "base/format/quote.h"
#include "base/mem.h"
#include "picture/html.h"
#include "picture/plot.h"
#include "picture/probe_files.h"

/* ---- figures ---- */

void jox_page_add_figure(JoxPageFigures *f, const char *unit, double value, const char *format,
                         ...) {
    char name[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(name, sizeof name, format, arguments);
    va_end(arguments);
    JOX_RESERVE(f->items, f->capacity, f->count + 1);
    f->items[f->count++] =
        (JoxPageFigure){jox_strdup(f->group ? f->group : ""), jox_strdup(name), unit, value, NULL};
}

void jox_page_put_value(FILE *out, const JoxPageFigure *figure) {
    if (figure->none && !isfinite(figure->value))
        fprintf(out, "<td class=n>%s", figure->none);
    else
        jox_html_cell_number(out, figure->value, figure->unit);
}

void jox_page_add_exits(JoxPageFigures *f, const JoxExits *exits, uint32_t inside) {
    uint64_t known = 0;
    f->group = "Who left";
    jox_page_add_figure(f, "", (double)exits->left, "people who left");
    jox_page_add_figure(f, "", inside, "people still inside at the end");
    jox_page_add_figure(f, "s", exits->left ? exits->last : NAN, "time when the last person left");
    jox_page_add_figure(f, "s", jox_exits_clearance(exits, inside),
                        "clearance time: nobody is inside");
    if (inside)
        f->items[f->count - 1].none = "not cleared";
    for (uint32_t e = 0; e < exits->count; e++) {
        jox_page_add_figure(f, "", exits->items[e].people, "people who left at %.60s",
                            exits->items[e].name);
        jox_page_add_figure(f, "s", exits->items[e].last, "time when the last person left at %.60s",
                            exits->items[e].name);
        known += exits->items[e].people;
    }
    if (exits->count && exits->left > known)
        jox_page_add_figure(f, "", (double)(exits->left - known), "people who left elsewhere");
}

void jox_page_add_probe(JoxPageFigures *f, const JoxProbe *probe) {
    JoxFigures figures = jox_probe_figures(probe);
    JoxText group = {0}, window = {0};
    jox_text_printf(&group, "Probe %.60s", jox_probe_def(probe)->name);
    jox_probe_window(probe, &window);
    if (window.length)
        jox_text_printf(&group, " (%s)", window.data);
    f->group = group.data;
    for (uint32_t i = 0; i < figures.count; i++) {
        jox_page_add_figure(f, figures.items[i].unit, figures.items[i].value, "%s",
                            figures.items[i].title);
        f->items[f->count - 1].none = figures.items[i].why;
    }
    f->group = NULL;
    jox_text_free(&group);
    jox_text_free(&window);
}

/* Returns the figure of the same group and name; NULL: there is none, as nobody left there. */
static const JoxPageFigure *find_same_figure(const JoxPageFigures *in, const JoxPageFigure *a) {
    for (uint32_t k = 0; in && k < in->count; k++)
        if (strcmp(in->items[k].name, a->name) == 0 && strcmp(in->items[k].group, a->group) == 0)
            return &in->items[k];
    return NULL;
}

static bool is_nothing_figure(const JoxPageFigure *f) {
    return !f || (!f->none && !(isfinite(f->value) && f->value != 0.0));
}

/* Writes a cell with the difference between two values, also in % of the first. */
static void put_difference(FILE *out, double whole, double half) {
    const double change = half - whole;
    fputs("<td class=n>", out);
    if (change == 0.0)
        fputs("0", out);
    else if (isfinite(change) && whole != 0.0)
        fprintf(out, "%+.3g (%+.1f&nbsp;%%)", change, 100.0 * change / fabs(whole));
    else if (isfinite(change))
        fprintf(out, "%+.3g", change);
    else
        fputs("&ndash;", out);
}

/* Writes the cells of the run at half the step: the same figure, and the difference. */
static void put_half_step_cells(FILE *out, const JoxPageFigure *a, const JoxPageFigure *b) {
    if (b)
        jox_page_put_value(out, b);
    else
        jox_html_cell_number(out, NAN, a->unit);
    put_difference(out, a->value, b ? b->value : NAN);
}

/* Writes table-figures.csv: all figures, those that are 0 too. */
static bool write_figure_csv(const JoxSubject *s, const JoxPageFigures *f,
                             const JoxPageFigures *half) {
    FILE *out = jox_plot_open(s->folder, "table-figures.csv", s->error);
    if (!out)
        return false;
    fputs(half ? "group,figure,unit,value,at half the step\n" : "group,figure,unit,value\n", out);
    for (uint32_t i = 0; i < f->count; i++) {
        const JoxPageFigure *a = &f->items[i], *b = find_same_figure(half, a);
        jox_quote_put(out, jox_quote_csv, a->group);
        fputc(',', out);
        jox_quote_put(out, jox_quote_csv, a->name);
        fprintf(out, ",%s,", a->unit);
        if (isfinite(a->value))
            fprintf(out, "%.9g", a->value);
        if (half)
            fputc(',', out);
        if (b && isfinite(b->value))
            fprintf(out, "%.9g", b->value);
        fputc('\n', out);
    }
    return jox_plot_close(out, "table-figures.csv", s->error);
}

void jox_page_put_figures(FILE *out, const JoxSubject *s, const JoxPageFigures *f,
                          const char *heads, const JoxPageFigures *half) {
    const char *group = "";
    char text[160];
    uint32_t left_out = 0;
    jox_html_table(out, heads);
    for (uint32_t i = 0; i < f->count; i++) {
        const JoxPageFigure *a = &f->items[i], *b = find_same_figure(half, a);
        if (is_nothing_figure(a) && is_nothing_figure(b)) {
            left_out++;
            continue;
        }
        if (strcmp(group, a->group) != 0) {
            group = a->group;
            fputs("\n<tr class=group><th colspan=9>", out);
            jox_html_text(out, group);
        }
        jox_html_row(out);
        jox_html_cell(out, a->name);
        jox_page_put_value(out, a);
        if (half)
            put_half_step_cells(out, a, b);
    }
    jox_html_table_end(out);
    if (left_out) {
        snprintf(text, sizeof text, "%u more %s 0 or not known; table-figures.csv has them, too.",
                 left_out, left_out == 1 ? "is" : "are");
        jox_html_paragraph(out, text);
    }
    if (write_figure_csv(s, f, half))
        jox_html_csv(out, "table-figures.csv");
}

void jox_page_release(JoxPageFigures *f) {
    for (uint32_t i = 0; i < f->count; i++) {
        jox_free(f->items[i].group);
        jox_free(f->items[i].name);
    }
    jox_free(f->items);
}

void jox_page_add_file(JoxPageTable *table, const char *scene, const char *what, const char *path,
                       const char *sha256) {
    char shown[JOX_LONGEST_PATH];
    jox_page_path(path, scene, shown);
    for (uint32_t k = 0; k + 2 < table->count; k += table->columns)
        if (strcmp(table->cells[k].text, shown) == 0 &&
            strcmp(table->cells[k + 2].text, sha256) == 0)
            return;
    jox_table_text(table, shown);
    jox_table_text(table, what);
    jox_table_text(table, sha256);
}

JoxPageTable jox_page_table(const JoxSubject *s, const char *name, const char *heads) {
    return (JoxPageTable){.name = name, .folder = s->folder, .error = s->error, .heads = heads};
}

void jox_page_say_kernel(const JoxSubject *s, JoxText *out) {
    jox_text_printf(
        out,
        "Gaussian, R = 1 m (standard deviation %.2f m), bounded by walls; cells of %.3g "
        "m; a sample each %g s, no smoothing over time",
        (double)JOX_DENSITY_KERNEL, (double)s->grid->cell, 0.5);
}

void jox_page_put_validation(FILE *out) {
    jox_html_heading(out, "Validation");
    jox_html_paragraph(
        out,
        "The engine is compared with published measurements by the command jostle reproduce, "
        "which writes a page of its own with every figure, its source, its band and whether it is "
        "met: scenes of Kim et al. 2014 (running through a crowd, two bottlenecks, stability over "
        "the time step), doors and bottlenecks (Wuppertal 2018; Seyfried et al. 2009; Kretz et al. "
        "2006), speed against density in single file and in corridors (Juelich archive; Zhang et "
        "al. 2011), a push along a row (Feldmann and Adrian 2023), and tests of the RiMEA "
        "guideline.");
}
