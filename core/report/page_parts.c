/* Lists and tables of figures on the pages of reports, and the section on validation. */
#include "report/page_parts.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "base/mem.h"
#include "picture/html.h"
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

void jox_page_put_figures(FILE *out, const JoxPageFigures *f, const char *heads,
                          void (*beside)(FILE *out, const JoxPageFigure *figure, void *context),
                          void *context) {
    const char *group = "";
    jox_html_table(out, heads);
    for (uint32_t i = 0; i < f->count; i++) {
        if (strcmp(group, f->items[i].group) != 0) {
            group = f->items[i].group;
            jox_html_row(out);
            fputs("<th colspan=9>", out);
            jox_html_text(out, group);
        }
        jox_html_row(out);
        jox_html_cell(out, f->items[i].name);
        jox_page_put_value(out, &f->items[i]);
        if (beside)
            beside(out, &f->items[i], context);
    }
    jox_html_table_end(out);
}

void jox_page_release(JoxPageFigures *f) {
    for (uint32_t i = 0; i < f->count; i++) {
        jox_free(f->items[i].group);
        jox_free(f->items[i].name);
    }
    jox_free(f->items);
}

void jox_page_put_validation(FILE *out) {
    jox_html_heading(out, "What this is worth");
    jox_html_paragraph(
        out,
        "The engine is compared with published measurements by the command `jostle reproduce`, "
        "which writes a page of its own with every figure, its source, its band and whether it is "
        "met: scenes of Kim et al. 2014 (running through a crowd, two bottlenecks, stability over "
        "the time step), doors and bottlenecks (Wuppertal 2018; Seyfried et al. 2009; Kretz et al. "
        "2006), speed against density in single file and in corridors (Juelich archive; Zhang et "
        "al. 2011), a push along a row (Feldmann and Adrian 2023), and tests of the RiMEA "
        "guideline.");
}
