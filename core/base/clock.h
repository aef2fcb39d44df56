/* Clocks, for what is told of a run and never for what it computes. */
#ifndef JOX_BASE_CLOCK_H
#define JOX_BASE_CLOCK_H

/* Wall clock and CPU clock of the process, s. */
double jox_clock_wall(void);
double jox_clock_cpu(void);

#endif
