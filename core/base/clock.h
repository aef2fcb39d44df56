/* Clocks, for what is told of a run and never for what it computes. */
#ifndef JOX_BASE_CLOCK_H
#define JOX_BASE_CLOCK_H

/* Wall clock, which no setting of the time moves; processor time of the process; and of the thread
   that asks, whom a busy machine does not hold up. s. */
double jox_clock_wall(void);
double jox_clock_cpu(void);
double jox_clock_thread(void);

#endif
