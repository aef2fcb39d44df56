/* Crowd pressure of Helbing, Johansson and Al-Abideen (Phys. Rev. E 75, 046109, 2007), 1/s2: at a
   place, P = rho Var(V), where rho is the mean over time of the local density there, V(t) the local
   velocity, the mean of people's velocities by the Gaussian of density.h (R = 1 m), and
   Var(V) = <|V(t) - <V>|2> its variance about its mean over time. It tells how the crowd as a whole
   is shaken to and fro, not how people walk past each other: 30 people and more have a part in V.

   Theirs: R, P, the variance of the local mean and not of single people, and that crowds turned
   turbulent above 0.02 per s2, which was read off a section of 20 m by 14 m of one dense stream.
   (The paper's text was not at hand for this: what is said of it is from its abstract, from
   summaries and from memory.) There the variance is that over the section at a time; in a crowd
   that is alike everywhere and at all times that is the same as over time at a place, by which they
   show where it was worst, and which does not take a bend or a funnel for turbulence. Ours:
   velocities and samples over 0.5 s (theirs are of video); means over 20 s; and the mean of P over
   a section of 7 m by 7 m about the place, since at a point it scatters by a factor of two. It is
   measured
   - where the crowd stood at no less than 5 per m2 in every quarter of that time, as theirs did:
   sparse crowds walk as they like;
   - where the variance does not come from one change of the flow, a gate that opens or a queue that
     starts: within at least three of the four quarters there is a quarter of it or more. So the
   swaying of a whole crowd in periods of more than 15 s or so is not seen, either;
   - where that holds for 12 m2 or more of the section, 60 people: not for a knot before a door.
   Elsewhere it is NAN. At single points, that last condition and the mean over a section left out,
   recorded queues of people who were in no danger read 0.010 at most (75 before a door of 0.5 m,
   348 before an opening of 3 m; Juelich archive), the engine's own before doors 0.02 to 0.06. */
#ifndef JOX_RECORD_FIELDS_PRESSURE_H
#define JOX_RECORD_FIELDS_PRESSURE_H

#include <stddef.h>
#include <stdint.h>

#include "base/sections.h"

#define JOX_PRESSURE_PACE 0.5     /* s between samples */
#define JOX_PRESSURE_SPAN 20.0    /* s over which means are taken */
#define JOX_PRESSURE_LEAST 5.0f   /* 1/m2 */
#define JOX_PRESSURE_SECTION 7.0f /* m: side of a section */
#define JOX_PRESSURE_FLOOR 12.0f  /* m2 of it that is measured at least */

typedef struct JoxPressure JoxPressure;
/* Cells row by row, of a grid whose cells are so wide, m. */
JoxPressure *jox_pressure_create(uint32_t columns, uint32_t rows, float cell);
/* Samples in ascending time, JOX_PRESSURE_PACE apart or farther; after a gap of more than
   twice that, or a step back, it begins anew. `flow_x`, `flow_y`: density times velocity. */
void jox_pressure_add(JoxPressure *pressure, double t, const float *density, const float *flow_x,
                      const float *flow_y);
/* Of each cell over the last whole span, 1/s2; NAN: not measured. Made anew every quarter of it. */
const float *jox_pressure_now(const JoxPressure *pressure);
void jox_pressure_sections(JoxPressure *pressure, JoxSections *sections);
void jox_pressure_free(JoxPressure *pressure);

#endif
