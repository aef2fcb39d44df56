/* A run as the subject of a report: used by its page (run_page.c), its listener (run_report.c) and
   comparisons. */
#ifndef JOX_REPORT_RUN_SUBJECT_H
#define JOX_REPORT_RUN_SUBJECT_H

#include "report/drawn_values.h"
#include "report/subject.h"
#include "run/run.h"

/* Returns a run that collects danger as a subject, for a report in `folder`;
   jox_run_subject_free frees its own arrays. */
JoxSubject jox_run_subject(const JoScene *scene, const char *folder);
void jox_run_subject_free(JoxSubject *subject);
/* Returns the values of people that the run's report collected; empty without a report. */
const JoxDrawnValues *jox_run_drawn_values(const JoScene *scene);

#endif
