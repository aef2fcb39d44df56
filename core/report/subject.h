/* What a report is about: a run, or a recording. */
#ifndef JOX_REPORT_SUBJECT_H
#define JOX_REPORT_SUBJECT_H

#include "geom/place.h"
#include "record/danger/danger.h"
#include "record/probes/probe.h"
#include "report/story.h"

typedef struct JoxSubject {
    const char *title, *folder; /* of the report */
    const JoxDanger *danger;
    const JoxDensity *grid; /* of densities, with their mean over time */
    double mean_from;       /* s: from when on that mean is */
    const JoxExits *exits;
    const JoxStory *story;
    const JoxWalls *walls;
    const JoxPlace *places;
    uint32_t place_count;
    const JoxProbe *const *probes;
    uint32_t probe_count;
    const JoxDrawnBodies *bodies; /* at the start; NULL: none are known */
    uint32_t inside;              /* people who are still there at the end */
    double from, until;           /* s: what is measured */
    bool simulated;
    double overlap_p99; /* share of a diameter; NAN: not known */
} JoxSubject;

/* where.c: appends where a point is, in words: "(18.1, 0.6) m, 0.6 m from the line south, in hall".
 */
void jox_where(const JoxSubject *subject, JoxV2 at, JoxText *out);

/* summary.c: appends sentences, as HTML paragraphs, that say who got out when, where it was
   dangerous for how long, and at which levels of service people were. */
void jox_summary_crowd(FILE *out, const JoxSubject *subject);

/* maps.c: the plan and maps, into the folder; moments.c: snapshots. False with a sentence in
   `error`. */
bool jox_maps_write(const JoxSubject *subject, JoxText *error);
bool jox_moments_write(const JoxSubject *subject, JoxText *error);
/* Their figures of the page, as far as they were drawn. */
void jox_maps_plan(FILE *out, const JoxSubject *subject);
void jox_maps_fields(FILE *out, const JoxSubject *subject);
void jox_maps_moments(FILE *out, const JoxSubject *subject);

#endif
