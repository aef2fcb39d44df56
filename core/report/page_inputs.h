/* The section on inputs of a run's page. */
#ifndef JOX_REPORT_PAGE_INPUTS_H
#define JOX_REPORT_PAGE_INPUTS_H

#include <stdio.h>

#include "report/drawn_values.h"
#include "report/subject.h"
#include "run/run.h"

/* Writes who takes part, with values as given and as drawn, arrivals, openings, events and the
   model. */
void jox_page_put_inputs(FILE *out, const JoScene *scene, const JoxSubject *subject,
                         const JoxDrawnValues *drawn);

/* Writes the facts on the model, and on what the author or the command line set. */
void jox_page_put_model(FILE *out, const JoScene *scene);

#endif
