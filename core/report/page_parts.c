/* Figures, danger and pictures on the pages of reports. */
#include "report/page_parts.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>
#include <unistd.h>

#include "base/mem.h"
#include "picture/html.h"
#include "picture/probe_files.h"

/* ---- figures ---- */

void jox_page_add(JoxPageFigures *f, const char *unit, double value, const char *format, ...) {
    char name[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(name, sizeof name, format, arguments);
    va_end(arguments);
    JOX_RESERVE(f->items, f->capacity, f->count + 1);
    f->items[f->count++] = (JoxPageFigure){jox_strdup(name), unit, value, NULL};
}

void jox_page_value(FILE *out, const JoxPageFigure *figure) {
    if (figure->none && !isfinite(figure->value))
        fprintf(out, "<td class=n>%s", figure->none);
    else
        jox_html_cell_number(out, figure->value, figure->unit);
}

void jox_page_add_exits(JoxPageFigures *f, const JoxExits *exits, uint32_t inside) {
    uint64_t known = 0;
    jox_page_add(f, "", (double)exits->left, "people who left");
    jox_page_add(f, "", inside, "people still inside at the end");
    jox_page_add(f, "s", exits->left ? exits->last : NAN, "when the last of those who left did so");
    jox_page_add(f, "s", jox_exits_clearance(exits, inside), "clearance time: nobody is inside");
    if (inside)
        f->items[f->count - 1].none = "not cleared";
    for (uint32_t e = 0; e < exits->count; e++) {
        jox_page_add(f, "", exits->items[e].people, "people who left at %.60s",
                     exits->items[e].name);
        jox_page_add(f, "s", exits->items[e].last, "when the last of them left at %.60s",
                     exits->items[e].name);
        known += exits->items[e].people;
    }
    if (exits->count && exits->left > known)
        jox_page_add(f, "", (double)(exits->left - known), "people who left elsewhere");
}

void jox_page_add_danger(JoxPageFigures *f, const JoxDanger *danger) {
    for (int m = 0; m < JOX_DANGER_MEASURES; m++)
        jox_page_add(f, jox_danger_units[m], jox_danger_most(danger, (JoxDangerMeasure)m).value,
                     "danger: greatest %s of anyone", jox_danger_names[m]);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        JoxDangerCount count = jox_danger_count(danger, l);
        bool read = jox_danger_reads(danger, jox_danger_limits[l].measure);
        jox_page_add(f, "", read ? count.people : NAN, "danger: people ever over %s",
                     jox_danger_limits[l].key);
        jox_page_add(f, "s", read ? count.person_s : NAN, "danger: person-seconds over %s",
                     jox_danger_limits[l].key);
        jox_page_add(f, "s", read ? count.longest : NAN, "danger: longest of one person over %s",
                     jox_danger_limits[l].key);
    }
}

void jox_page_add_probe(JoxPageFigures *f, const JoxProbe *probe) {
    JoxFigures figures = jox_probe_figures(probe);
    for (uint32_t i = 0; i < figures.count; i++)
        jox_page_add(f, figures.items[i].unit, figures.items[i].value, "%.60s: %.60s",
                     jox_probe_def(probe)->name, figures.items[i].name);
}

void jox_page_release(JoxPageFigures *f) {
    for (uint32_t i = 0; i < f->count; i++)
        jox_free(f->items[i].name);
    jox_free(f->items);
}

/* ---- parts of the page ---- */

static void put_place(FILE *out, double time, JoxV2 at) {
    if (isfinite(time))
        fprintf(out, "<td>%.1f&nbsp;s at (%.1f,&nbsp;%.1f)&nbsp;m", time, at.x, at.y);
    else
        fputs("<td>&ndash;", out);
}

void jox_page_danger(FILE *out, const JoxDanger *danger) {
    jox_html_heading(out, "Danger: who was over which limit");
    jox_html_paragraph(
        out,
        "Density is that of the Gaussian kernel exp(-d2/R2)/(pi R2), R = 1 m, where somebody "
        "stands; it reads low within a metre of walls. Crowd pressure is mean density times "
        "the variance over time of the local velocity, by the same kernel, means over 10 s; it "
        "is read only where the mean density is over 5 per m2, from 10 s on, and without the "
        "first 5 s, when everybody starts.");
    if (jox_danger_reads(danger, JOX_DANGER_LOAD)) {
        jox_html_paragraph(
            out, "Load is the greatest push that a person bears from any one direction: over "
                 "directions, the greatest sum of the positive parts of the contact forces along "
                 "it, in newtons, held on average for a second; a knock of one step counts little. "
                 "Limits for chests are forces of that kind.");
        jox_html_paragraph(out, jox_danger_dose_text);
    } else {
        jox_html_paragraph(out, "Load was not measured: this recording does not know the push that "
                                "people bear. Its limits, and those of dose, have dashes.");
    }
    if (jox_danger_reads(danger, JOX_DANGER_COMPRESSION))
        jox_html_paragraph(
            out, "Compression is another quantity: the sum of the magnitudes of all contact forces "
                 "over the girth 2 pi r, held likewise. It cannot be turned into a load and is "
                 "compared with no limit.");
    else
        jox_html_paragraph(out, "Compression was not measured.");
    if (!jox_danger_reads(danger, JOX_DANGER_PRESSURE))
        jox_html_paragraph(out, "Crowd pressure was not read: the time measured is too short.");
    jox_html_table(out, "limit|value|people ever over it|person-seconds|longest of one "
                        "person|first|minutes since|meaning|source");
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        const JoxDangerLimit *limit = &jox_danger_limits[l];
        JoxDangerCount count = jox_danger_count(danger, l);
        jox_html_row(out);
        jox_html_cell(out, limit->key);
        jox_html_cell_number(out, limit->value, jox_danger_units[limit->measure]);
        bool read = jox_danger_reads(danger, limit->measure);
        jox_html_cell_number(out, read ? count.people : NAN, "");
        jox_html_cell_number(out, read ? count.person_s : NAN, "s");
        jox_html_cell_number(out, read ? count.longest : NAN, "s");
        put_place(out, count.first, count.first_at);
        jox_html_cell_number(out, jox_danger_since(danger, count.first), "min");
        jox_html_cell(out, limit->what);
        jox_html_cell(out, limit->source);
    }
    jox_html_table_end(out);
    jox_html_table(out, "measure|greatest of anyone|when and where");
    for (int m = 0; m < JOX_DANGER_MEASURES; m++) {
        JoxDangerMost most = jox_danger_most(danger, (JoxDangerMeasure)m);
        jox_html_row(out);
        jox_html_cell(out, jox_danger_names[m]);
        jox_html_cell_number(out, most.value, jox_danger_units[m]);
        put_place(out, most.time, most.at);
    }
    jox_html_table_end(out);
}

static bool is_there(const char *directory, const char *file) {
    char path[1200];
    snprintf(path, sizeof path, "%s/%s", directory, file);
    return access(path, R_OK) == 0;
}

void jox_page_picture(FILE *out, const char *directory, const char *name, const char *caption) {
    char png[140], svg[140];
    snprintf(png, sizeof png, "%s.png", name);
    snprintf(svg, sizeof svg, "%s.svg", name);
    if (is_there(directory, png))
        jox_html_picture(out, png, is_there(directory, svg) ? svg : NULL, caption);
}

void jox_page_danger_pictures(FILE *out, const char *directory) {
    jox_page_picture(out, directory, "danger-map", "Where people are squeezed: mean and greatest");
    jox_page_picture(out, directory, "danger", "Danger over time, with the limits dashed");
}

void jox_page_probe(FILE *out, const char *directory, const JoxProbe *probe) {
    char caption[128], stem[JOX_PROBE_STEM];
    snprintf(caption, sizeof caption, "Probe %.60s", jox_probe_def(probe)->name);
    jox_probe_stem(probe, stem);
    jox_page_picture(out, directory, stem, caption);
}

void jox_page_validation(FILE *out) {
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
