/* Listeners that collect figures of a run: speeds in its regions, local densities, danger. */
#ifndef JOX_RUN_FIGURE_LISTENERS_H
#define JOX_RUN_FIGURE_LISTENERS_H

#include "base/vec.h"
#include "jostle.h"
#include "record/danger/danger.h"
#include "record/local_samples.h"
#include "record/regions.h"

/* jox_run_collect_* attach a listener that collects from here on, unless it is there already. False
   with `error` if the checkpoint that the scene was resumed from holds unsound data of it. The
   other functions return what has been collected so far; NULL: no such listener. */

/* Mean speeds in the regions that the scene lists. */
void jox_run_collect_regions(JoScene *scene);
const JoxRegions *jox_run_regions(const JoScene *scene);
/* Local densities, sampled in each run that is not told to do without. */
bool jox_run_collect_densities(JoScene *scene, JoError *error);
const JoxLocal *jox_run_local_densities(const JoScene *scene);
/* Attaches the same listener, and has it measure crowd pressure too. */
const JoxLocal *jox_run_collect_pressure(JoScene *scene);
/* The greatest density of any place and sample, 1/m2 (the figure density_max); before the first
   step, of the people there now; NAN if densities are not collected. */
double jox_run_greatest_density(const JoScene *scene);
/* Danger to people, in the area that is shown or between two corners, m. */
bool jox_run_collect_danger(JoScene *scene, JoError *error);
void jox_run_collect_danger_in(JoScene *scene, JoxV2 low, JoxV2 high);
const JoxDanger *jox_run_danger(const JoScene *scene);

#endif
