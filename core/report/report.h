/* A report on a recording (jo_report): report.c loads, measures and writes files, recording_page.c
   writes index.html. */
#ifndef JOX_REPORT_REPORT_H
#define JOX_REPORT_REPORT_H

#include "jostle_tools.h"
#include "record/danger/criteria.h"
#include "record/trajectories.h"
#include "report/subject.h"
#include "run/run.h"

/* State of one call. report.c owns and frees all members. */
typedef struct JoxReport {
    const JoReportDef *def;
    JoxDiagnostics diagnostics;
    JoxSceneSpec *spec;     /* the scene given with the recording, or NULL */
    JoxTrajectories *crowd; /* the recording */
    JoxProbe **probes;      /* probes of the scene, or default ones */
    uint32_t count;         /* number of probes */
    JoxDanger *danger;
    JoxCriteria *criteria;            /* the scene's; NULL: none */
    JoxExits exits;                   /* people who are in no later frame; exits have no names */
    JoxTrajectoryReader *body_reader; /* for the bodies of a recording; NULL if it has none */
    JoxStory story;
} JoxReport;

/* Returns the scene's walls if it has any and the recording has no history of its own walls,
   else the recording's walls at its start. */
const JoxWalls *jox_report_walls(const JoxReport *report);
/* Returns the scene's title, else the recording's file name. */
const char *jox_report_title(const JoxReport *report);
/* Returns the report as a subject, which is valid as long as the report. */
JoxSubject jox_report_subject(const JoxReport *report);
/* Returns what verdicts on the scene's criteria need. */
JoxCriterionEvidence jox_report_evidence(const JoxReport *report);
/* Writes index.html into the report's folder. Returns false with a sentence in `error`. */
bool jox_report_page(const JoxReport *report, JoxText *error);

#endif
