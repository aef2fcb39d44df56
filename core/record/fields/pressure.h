/* Crowd pressure of Helbing, Johansson and Al-Abideen (Phys. Rev. E 75, 046109, 2007), 1/s2. At a
   place, P = rho Var(V): rho is the mean over time of the local density, V(t) the local velocity,
   the mean of people's velocities by the Gaussian of density.h (R = 1 m), and Var(V) = <|V(t) -
   <V>|2> its variance about its mean over time. P measures how the crowd as a whole is shaken to
   and fro, not how people pass each other: 30 people or more take part in V.

   From the publication: R, P, that the variance is that of the local mean and not of single people,
   and that crowds turned turbulent above 0.02 per s2, read off a section of 20 m by 14 m of one
   dense stream. (The text was not available; this follows its abstract, summaries of it, and
   memory.) There the variance is taken over the section at one time. In a crowd that is uniform in
   space and time, that equals the variance over time at a place, which the publication uses to show
   where it was worst, and which does not mistake a bend or a funnel for turbulence. Our choices:
   velocities and samples over 0.5 s (theirs are from video), means over 20 s, and the mean of P
   over a section of 7 m by 7 m about the place, since at a point P scatters by a factor of two. It
   is measured

   - where the density was at least 5 per m2 in each quarter of the 20 s, as in theirs: people in
     sparse crowds walk as they like
   - where the variance does not come from a single change of the flow, such as a gate that opens or
     a queue that starts: at least three of the four quarters must each have a quarter of it or
     more. So swaying of a whole crowd with periods above 15 s or so is missed, too
   - where both hold on 12 m2 or more of the section, 60 people: not in a knot before a door

   Elsewhere it is NAN. Without the last condition and the mean over a section, single points in
   recorded queues of people in no danger read 0.010 at most (75 people before a door of 0.5 m, 348
   before an opening of 3 m; Juelich archive), and the engine's own queues before doors 0.02 to
   0.06. */
#ifndef JOX_RECORD_FIELDS_PRESSURE_H
#define JOX_RECORD_FIELDS_PRESSURE_H

#include <stddef.h>
#include <stdint.h>

#include "base/sections.h"

#define JOX_PRESSURE_PACE 0.5     /* s between samples */
#define JOX_PRESSURE_SPAN 20.0    /* s: duration of means */
#define JOX_PRESSURE_LEAST 5.0f   /* 1/m2: least density */
#define JOX_PRESSURE_SECTION 7.0f /* m: side of a section */
#define JOX_PRESSURE_FLOOR 12.0f  /* m2: least measured area of a section */

typedef struct JoxPressure JoxPressure;
/* Creates a field of cells, row by row; `cell` is their side, m. */
JoxPressure *jox_pressure_create(uint32_t columns, uint32_t rows, float cell);
/* Keeps the means over sections within blocks of rows: row r is of the rows first[r] to end[r] - 1.
   For densities of several storeys. */
void jox_pressure_set_blocks(JoxPressure *pressure, const uint32_t *first, const uint32_t *end);
/* Adds a sample at t, s. Samples ascend in time and are JOX_PRESSURE_PACE or more apart; after a
   gap of more than twice that, or a step back, the measurement starts again. `flow_x` and `flow_y`
   are density times velocity, 1/(m s). */
void jox_pressure_add(JoxPressure *pressure, double t, const float *density, const float *flow_x,
                      const float *flow_y);
/* Returns the pressure of each cell over the last complete span, 1/s2; NAN: not measured. It is
   updated four times per span. */
const float *jox_pressure_now(const JoxPressure *pressure);
void jox_pressure_sections(JoxPressure *pressure, JoxSections *sections);
void jox_pressure_free(JoxPressure *pressure);

#endif
