/* What the pages of reports share, of runs and of recordings. */
#ifndef JOX_REPORT_PAGE_PARTS_H
#define JOX_REPORT_PAGE_PARTS_H

#include <stdint.h>
#include <stdio.h>

#include "record/danger/danger.h"
#include "record/probes/probe.h"

/* Figures in order, by name. */
typedef struct JoxPageFigure {
    char *name;
    const char *unit;
    double value;
    const char *none; /* said where there is no value; NULL: a dash */
} JoxPageFigure;
typedef struct JoxPageFigures {
    JoxPageFigure *items;
    uint32_t count, capacity;
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

/* The section on danger: how it is measured, limits, greatest values. */
void jox_page_danger(FILE *out, const JoxDanger *danger);
/* NAME.png of the directory, if it is there, with NAME.svg behind it. */
void jox_page_picture(FILE *out, const char *directory, const char *name, const char *caption);
void jox_page_danger_pictures(FILE *out, const char *directory);
void jox_page_probe(FILE *out, const char *directory, const JoxProbe *probe);
/* The heading and first paragraph of what a page is worth. */
void jox_page_validation(FILE *out);

#endif
