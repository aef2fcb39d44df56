/* Where a simulation is denser than people can be: loads and densities there are not to be trusted.
   Bodies are discs that give; where they are pressed into each other, as many stand on a square
   metre as no crowd has room for. Two signs are told: how deep bodies overlap, and a density above
   that of any crowd. */
#ifndef JOX_RECORD_DANGER_TRUST_H
#define JOX_RECORD_DANGER_TRUST_H

#include <stdbool.h>

#include "base/text.h"

#define JOX_TRUST_OVERLAP 0.1 /* share of a diameter, that 99 % of people stay below */
#define JOX_TRUST_DENSITY                                                                          \
    10.0 /* 1/m2, Gaussian, R = 1 m: about that of the densest crowds known                        \
          */

/* A NAN is not known, and no sign. */
bool jox_trust_holds(double overlap_p99, double density_max);
/* Appends a sentence that says what does not hold, and nothing else. */
void jox_trust_say(double overlap_p99, double density_max, JoxText *out);

#endif
