/* Signs that a simulation is denser than people can be, so that its loads and densities cannot be
   trusted: agents are shapes that yield, and under pressure more of them fit on a square metre than
   people do. The signs are the overlap of the shapes and a density above that of any known crowd.
 */
#ifndef JOX_RECORD_DANGER_TRUST_H
#define JOX_RECORD_DANGER_TRUST_H

#include <stdbool.h>

#include "base/text.h"

/* Limit of the 99th percentile of overlaps, as a share of a person's depth: from chest to back, the
   diameter of a disc. */
#define JOX_TRUST_OVERLAP 0.1
/* 1/m2, Gaussian, R = 1 m: about that of the densest known crowds. */
#define JOX_TRUST_DENSITY 10.0

/* Returns false if a sign is present. NAN is an unknown value and no sign. */
bool jox_trust_holds(double overlap_p99, double density_max);
/* Appends a sentence that names the signs; nothing if there are none. depth_p99: overlap that 99 %
   of those who touch stay below, m. */
void jox_trust_append_signs(double overlap_p99, double depth_p99, double density_max, JoxText *out);

#endif
