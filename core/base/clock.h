/* Clocks, all in s. They serve reports and pacing; no simulation may depend on them. */
#ifndef JOX_BASE_CLOCK_H
#define JOX_BASE_CLOCK_H

/* Monotonic wall clock; processor time of the process; processor time of the calling thread, which
   other load on the machine does not lengthen. Without clocks of processor time, the last two are
   the wall clock. */
double jox_clock_wall(void);
double jox_clock_cpu(void);
double jox_clock_thread(void);
/* Returns how long a call of jox_clock_thread takes, s, the least of a few: to be taken off short
   times between two of them. */
double jox_clock_thread_cost(void);
/* The date: s since 1970-01-01 UTC. */
double jox_clock_date(void);

#endif
