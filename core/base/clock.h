/* Clocks, for what is told of a run and never for what it computes. */
#ifndef JOX_BASE_CLOCK_H
#define JOX_BASE_CLOCK_H

/* Wall clock, which no setting of the time moves; processor time of the process; and of the thread
   that asks, whom a busy machine does not hold up. s. Where the system has no clock of processor
   time, these two are the wall clock. */
double jox_clock_wall(void);
double jox_clock_cpu(void);
double jox_clock_thread(void);
/* The date: s since 1970. */
double jox_clock_date(void);

#endif
