/* A run as the subject of a report. */
#ifndef JOX_REPORT_RUN_SUBJECT_H
#define JOX_REPORT_RUN_SUBJECT_H

#include "report/subject.h"
#include "run/run.h"

/* Of a run that collects danger; `folder` is that of its report. */
JoxSubject jox_run_subject(const JoScene *scene, const char *folder);
void jox_run_subject_free(JoxSubject *subject);

#endif
