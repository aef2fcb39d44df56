/* What the pages of reports share, of runs and of recordings. */
#ifndef JOX_REPORT_PAGE_PARTS_H
#define JOX_REPORT_PAGE_PARTS_H

#include <stdint.h>
#include <stdio.h>

#include "report/subject.h"

/* Figures in order, by group and name. */
typedef struct JoxPageFigure {
    char *group, *name; /* groups follow each other */
    const char *unit;
    double value;
    const char *none; /* said where there is no value; NULL: a dash */
} JoxPageFigure;
typedef struct JoxPageFigures {
    JoxPageFigure *items;
    uint32_t count, capacity;
    const char *group; /* of those that are added next */
} JoxPageFigures;

void jox_page_add(JoxPageFigures *f, const char *unit, double value, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* `inside`: people who are still there at the end. */
void jox_page_add_exits(JoxPageFigures *f, const JoxExits *exits, uint32_t inside);
void jox_page_add_danger(JoxPageFigures *f, const JoxDanger *danger);
void jox_page_add_probe(JoxPageFigures *f, const JoxProbe *probe);
/* The cell with its value. */
void jox_page_value(FILE *out, const JoxPageFigure *figure);
void jox_page_release(JoxPageFigures *f);

/* Sections that pages of runs and of recordings share: the plan; who left; danger, with maps and
   moments; levels of service; lines; walls; what probes measured. */
void jox_page_crowd(FILE *out, const JoxSubject *subject);
void jox_page_leaving(FILE *out, const JoxSubject *subject);
void jox_page_danger(FILE *out, const JoxSubject *subject);
void jox_page_levels(FILE *out, const JoxSubject *subject);
enum { JOX_PAGE_SHOWN = 10 }; /* of people and of pieces of walls: those that bore most */
/* Of `count` numbers those of the greatest values over 0, descending; returns how many. */
uint32_t jox_page_most_of(const JoxDanger *danger, uint32_t count,
                          double (*value)(const JoxDanger *danger, uint32_t k),
                          uint32_t order[JOX_PAGE_SHOWN]);
/* A table of them, with a row of each group's name; `heads` as of jox_html_table. `beside`, or
   NULL: what stands behind each value. */
void jox_page_figures(FILE *out, const JoxPageFigures *figures, const char *heads,
                      void (*beside)(FILE *out, const JoxPageFigure *figure, void *context),
                      void *context);
/* How the measures of danger are defined. */
void jox_page_definitions(FILE *out, const JoxDanger *danger);
/* The heading and first paragraph of what a page is worth. */
void jox_page_validation(FILE *out);

#endif
