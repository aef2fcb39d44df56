/* The subject of a report, a run or a recording, in one form, so that sections, maps and
   summaries are written by the same code. */
#ifndef JOX_REPORT_SUBJECT_H
#define JOX_REPORT_SUBJECT_H

#include "geom/place.h"
#include "record/danger/danger.h"
#include "record/probes/probe.h"
#include "report/story.h"
#include "run/results/lift_figures.h"

/* All pointers are borrowed from the run or recording. */
typedef struct JoxSubject {
    const char *title, *folder; /* title and folder of the report */
    const JoxDanger *danger;
    const JoxDensity *grid; /* grid of densities, with their mean over time */
    double mean_from;       /* s: start of that mean */
    const JoxExits *exits;
    const JoxStory *story;
    const JoxWalls *walls;
    const JoxStoreys *storeys; /* NULL: one plane */
    const JoxLift *lifts;
    uint32_t lift_count;
    const JoxPlace *places;
    uint32_t place_count;
    const JoxProbe *const *probes;
    uint32_t probe_count;
    const JoxLiftResult *rides;   /* figures of each lift; NULL: not known, as of recordings */
    const JoxStranded *stranded;  /* by storey, at the end; NULL: not known, or no storeys */
    const JoxDrawnBodies *bodies; /* at the start; NULL: not known */
    uint32_t inside;              /* people still inside at the end */
    double from, until;           /* s: time range measured */
    bool simulated;
    /* Overlap that 99 % of people stay below, as a share of their depth; and 99 % of those who
       touch, m. NAN: not known. */
    double overlap_p99, depth_p99;
    JoxText *error; /* gets a sentence if a file of the page cannot be written */
} JoxSubject;

/* describe_point.c: appends a point in words, as "(18.1, 0.6) m, 0.6 m from the line south, in
 * hall". */
void jox_describe_point(const JoxSubject *subject, JoxV2 at, JoxText *out);

/* summary.c: writes sentences, as HTML paragraphs, on when people left, where it was dangerous
   and for how long, and at which levels of service people were. */
void jox_summary_crowd(FILE *out, const JoxSubject *subject);

/* Draw the plan and maps (maps.c), and snapshots (snapshots.c), into the folder. Return false with
   a sentence in `error`. */
bool jox_draw_maps(const JoxSubject *subject, JoxText *error);
bool jox_draw_snapshots(const JoxSubject *subject, JoxText *error);
/* Write the HTML that shows the plan, maps and snapshots, as far as they were drawn. */
void jox_write_plan_html(FILE *out, const JoxSubject *subject);
void jox_write_maps_html(FILE *out, const JoxSubject *subject);
void jox_write_snapshots_html(FILE *out, const JoxSubject *subject);

#endif
