/* Values of people as they were drawn when they were made, by group: speeds, torsos, masses, and
   the own values of behaviours such as pre-movement times. The report of a run (run_report.c)
   collects them, page_inputs.c shows them beside what the scene gives. */
#ifndef JOX_REPORT_DRAWN_VALUES_H
#define JOX_REPORT_DRAWN_VALUES_H

#include <stdbool.h>
#include <stdint.h>

#include "base/sections.h"
#include "world/world.h"

/* One quantity of one group. */
typedef struct JoxDrawnValue {
    char name[48];
    uint32_t group, people;
    double mean, squares; /* squares: sum of the squared deviations from the mean */
    double least, greatest;
} JoxDrawnValue;

typedef struct JoxDrawnValues {
    JoxDrawnValue *items; /* in the order in which they were first seen */
    uint32_t count, capacity;
    uint32_t next_id; /* agents with smaller ids were added */
} JoxDrawnValues;

/* Adds the agents that were made since the last call and are still there. */
void jox_drawn_values_add(JoxDrawnValues *values, const JoWorld *world);
/* Returns the standard deviation of a quantity; 0 for a single person. */
double jox_drawn_deviation(const JoxDrawnValue *value);
/* Returns whether reports show the quantity even where everybody has its default. */
bool jox_drawn_is_shown(const char *name);
void jox_drawn_values_sections(JoxDrawnValues *values, JoxSections *sections);

#endif
