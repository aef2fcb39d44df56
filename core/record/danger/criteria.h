/* Judges a run or a recording by the criteria of its scene. A run or an analysis of a recording
   creates them, gives each frame after danger has taken it, and asks for verdicts at the end. */
#ifndef JOX_RECORD_DANGER_CRITERIA_H
#define JOX_RECORD_DANGER_CRITERIA_H

#include <stdbool.h>

#include "record/danger/danger.h"
#include "record/probes/probe.h"
#include "world/criterion.h"

typedef struct JoxCriteria JoxCriteria;

/* Copies the definitions and places. */
JoxCriteria *jox_criteria_create(const JoxCriterion *defs, uint32_t count, const JoxPlace *places,
                                 uint32_t place_count);
/* Extends an area, m, so that the places of criteria of density are measured. */
void jox_criteria_extend_area(const JoxCriterion *defs, uint32_t count, const JoxPlace *places,
                              JoxV2 *low, JoxV2 *high);
/* Takes the sample of density that danger has taken since the last call, if there is one. */
void jox_criteria_sample(JoxCriteria *criteria, const JoxDanger *danger);
void jox_criteria_sections(JoxCriteria *criteria, JoxSections *sections);
void jox_criteria_free(JoxCriteria *criteria);

/* Inputs of verdicts other than the samples. */
typedef struct JoxCriterionEvidence {
    const JoxDanger *danger;
    const JoxExits *exits;
    uint32_t inside; /* people still inside at the end */
    bool to_come;    /* more people would have come in after the end */
    double until;    /* s: the end */
    const JoxProbe *const *probes;
    uint32_t probe_count;
} JoxCriterionEvidence;
typedef enum JoxVerdictKind {
    JOX_VERDICT_OPEN, /* not decided: not measured, or it ended too early */
    JOX_VERDICT_MET,
    JOX_VERDICT_FAILED
} JoxVerdictKind;
extern const char *const jox_verdict_names[]; /* "not decided", ... */
typedef struct JoxVerdict {
    const JoxCriterion *criterion;
    JoxVerdictKind kind;
    double figure, limit; /* in `unit`; figure NAN: not known */
    const char *unit;
    char how[400]; /* how the figure was measured, in words */
} JoxVerdict;
uint32_t jox_criteria_count(const JoxCriteria *criteria);
JoxVerdict jox_criteria_judge(const JoxCriteria *criteria, uint32_t number,
                              const JoxCriterionEvidence *evidence);
/* Adds "criteria": {NAME: {"figure", "limit", "unit", "met"}}, if there are any; met is 1, 0, or
   null if it is not decided, so that its mean over seeds is the share of seeds that meet it. */
void jox_criteria_json(const JoxCriteria *criteria, const JoxCriterionEvidence *evidence,
                       JoxJson *json);

#endif
