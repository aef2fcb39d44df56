/* Queues before lifts, and people in their cars, over the time of a run. run_report.c adds a row
   each second and writes them at the end. */
#ifndef JOX_REPORT_LIFT_TIMES_H
#define JOX_REPORT_LIFT_TIMES_H

#include "base/sections.h"
#include "run/run.h"

typedef struct JoxLiftTime {
    double time;   /* s */
    uint32_t lift; /* index */
    uint32_t waiting, riding;
    uint32_t storey; /* where the car stands, or which it left */
} JoxLiftTime;

typedef struct JoxLiftTimes {
    JoxLiftTime *rows; /* in ascending order of time */
    uint32_t count, capacity;
} JoxLiftTimes;

/* Adds a row for each lift, if a second has passed. */
void jox_lift_times_add(JoxLiftTimes *times, const JoScene *scene);
/* Writes danger-lifts.csv into a folder and, with a title, draws lifts.png and lifts.svg; nothing
   without lifts. Returns false with a sentence in `error`. */
bool jox_lift_times_write(const JoxLiftTimes *times, const JoScene *scene, const char *folder,
                          const char *title, JoxText *error);
void jox_lift_times_sections(JoxLiftTimes *times, const JoScene *scene, JoxSections *sections);

#endif
