/* A recording that is measured, and its page. */
#ifndef JOX_REPORT_REPORT_H
#define JOX_REPORT_REPORT_H

#include "jostle_tools.h"
#include "record/trajectories.h"
#include "report/subject.h"
#include "run/run.h"

typedef struct JoxReport {
    const JoReportDef *def;
    JoxDiagnostics diagnostics;
    JoxSceneSpec *spec; /* or NULL */
    JoxTrajectories *crowd;
    JoxProbe **probes;
    uint32_t count;
    JoxDanger *danger;
    JoxExits exits;            /* who is in no later frame; none has a name */
    JoxTrajectoryReader *reel; /* of a recording with bodies; else NULL */
    JoxStory story;
} JoxReport;

/* Of the scene, else of the recording. */
const JoxWalls *jox_report_walls(const JoxReport *report);
const char *jox_report_title(const JoxReport *report);
/* What the report is about; it holds as long as the report. */
JoxSubject jox_report_subject(const JoxReport *report);
/* index.html of the report's folder; false with a sentence in `error`. */
bool jox_report_page(const JoxReport *report, JoxText *error);

#endif
