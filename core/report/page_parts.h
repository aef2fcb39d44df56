/* Figures and sections shared by the pages of runs (run_page.c) and of recordings
 * (recording_page.c). */
#ifndef JOX_REPORT_PAGE_PARTS_H
#define JOX_REPORT_PAGE_PARTS_H

#include <stdint.h>
#include <stdio.h>

#include "base/format/path.h"
#include "jostle_tools.h"
#include "record/danger/criteria.h"
#include "report/page_table.h"
#include "report/subject.h"
#include "scene/scene.h"

/* A named figure. Figures are listed in order, those of one group next to each other. */
typedef struct JoxPageFigure {
    char *group, *name; /* owned strings */
    const char *unit;
    double value;
    const char *none; /* text in place of a missing value; NULL: a dash */
} JoxPageFigure;
/* A list of figures; jox_page_release frees it. */
typedef struct JoxPageFigures {
    JoxPageFigure *items;
    uint32_t count, capacity;
    const char *group; /* group of the figures added next */
} JoxPageFigures;

/* Append figures: one by value, unit and name (printf format); those of exits, danger and a
   probe. */
void jox_page_add_figure(JoxPageFigures *f, const char *unit, double value, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* `inside` is the number of people still there at the end. */
void jox_page_add_exits(JoxPageFigures *f, const JoxExits *exits, uint32_t inside);
void jox_page_add_danger(JoxPageFigures *f, const JoxDanger *danger);
void jox_page_add_stairs(JoxPageFigures *f, const JoxDanger *danger);
void jox_page_add_lifts(JoxPageFigures *f, const JoScene *scene);
void jox_page_add_probe(JoxPageFigures *f, const JoxProbe *probe);
/* Writes a figure's value as a table cell. */
void jox_page_put_value(FILE *out, const JoxPageFigure *figure);
void jox_page_release(JoxPageFigures *f);

/* Returns what a report states: what its caller asks for, else what the scene gives (or NULL). The
   texts are borrowed; `notes` are the scene's. */
JoxSceneReport jox_page_head(const JoxSceneReport *given, const JoReportHead *asked);
/* Writes the head of a report and opens the table of facts about it with what the scene gives
   (`given`, or NULL) and the date; jox_html_fact adds to it, jox_html_table_end ends it. `about` is
   a line below the title, `foot` the running text at the foot of printed pages. */
void jox_page_begin(FILE *out, const JoxSubject *subject, const JoxSceneReport *given,
                    const char *about, const char *foot);
/* Writes lines to sign, with the names given. */
void jox_page_put_signatures(FILE *out, const JoxSceneReport *given);
/* Writes the name of a file as pages show it: relative to the present folder, or to that of the
   scene (or NULL), or its name alone. Returns `out`. */
const char *jox_page_path(const char *path, const char *scene, char out[JOX_LONGEST_PATH]);

/* Adds a row with a file, what it is and its hash, unless the table has it: behaviours share
   modules. `scene` is as for jox_page_path. */
void jox_page_add_file(JoxPageTable *table, const char *scene, const char *what, const char *path,
                       const char *sha256);

/* Appends how many criteria are met, and names the others. */
void jox_page_say_criteria(const JoxVerdict *verdicts, uint32_t count, JoxText *out);
/* Writes the section on criteria; nothing if there are none. */
void jox_page_put_criteria(FILE *out, const JoxSubject *subject, const JoxVerdict *verdicts,
                           uint32_t count);

/* Write sections of the page. jox_page_put_crowd writes the plan, the other three, and the
   probes' figures; leaving: who left when; danger: limits, maps and moments; levels: levels of
   service, congestion, lines (of its own: lines), walls, stairs and lifts. */
void jox_page_put_crowd(FILE *out, const JoxSubject *subject);
void jox_page_put_leaving(FILE *out, const JoxSubject *subject);
void jox_page_put_danger(FILE *out, const JoxSubject *subject);
void jox_page_put_levels(FILE *out, const JoxSubject *subject);
void jox_page_put_lines(FILE *out, const JoxSubject *subject);
void jox_page_put_stairs(FILE *out, const JoxSubject *subject);
void jox_page_put_lifts(FILE *out, const JoxSubject *subject);
/* Returns an empty table of a subject's page (page_table.h). */
JoxPageTable jox_page_table(const JoxSubject *subject, const char *name, const char *heads);
/* Appends how the densities of a subject's maps are made: kernel, walls, cells, sampling. */
void jox_page_say_kernel(const JoxSubject *subject, JoxText *out);
enum { JOX_PAGE_SHOWN = 10 }; /* most rows in a table of people or wall pieces */
/* Ranks the indices 0 to `count` - 1 by value and puts those with the greatest values above 0
   into `order`, descending. Returns how many there are. */
uint32_t jox_page_rank_greatest(const JoxDanger *danger, uint32_t count,
                                double (*value)(const JoxDanger *danger, uint32_t k),
                                uint32_t order[JOX_PAGE_SHOWN]);
/* Writes a table of the figures that are not 0, with a heading row per group, and all of them as
   table-figures.csv. `heads` is as in jox_html_table. `half`, or NULL: the figures at half the
   step, which are written behind each value with the difference. */
void jox_page_put_figures(FILE *out, const JoxSubject *subject, const JoxPageFigures *figures,
                          const char *heads, const JoxPageFigures *half);
/* Writes what a published limit means, and its source. */
void jox_page_put_limit_meaning(FILE *out, int limit);
/* Writes the definitions of the danger measures. */
void jox_page_put_definitions(FILE *out, const JoxDanger *danger);
/* Writes the heading and first paragraph of the section on validation. */
void jox_page_put_validation(FILE *out);

#endif
