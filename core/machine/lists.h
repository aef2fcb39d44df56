/* Short lists in the memory of agents. */
#ifndef JOX_MACHINE_LISTS_H
#define JOX_MACHINE_LISTS_H

#include "machine/run.h"

/* Write the items of a list, oldest first, without those who have left the world, and return how
   many; return its first or last item, 0 if it is empty; whether it contains an item; and change
   it. `memory` is that of one agent, `index` the slot of the list. */
uint32_t jox_list_read(const JoxMachineRun *run, const JoxMachine *machine, const double *memory,
                       int32_t index, double items[JOX_MOST_ITEMS]);
double jox_list_end(const JoxMachineRun *run, const JoxMachine *machine, const double *memory,
                    int32_t index, bool last);
bool jox_list_has(const JoxMachineRun *run, const JoxMachine *machine, const double *memory,
                  int32_t index, double item);
void jox_list_change(const JoxMachineRun *run, const JoxMachine *machine, double *memory,
                     int32_t index, JoxListChange change, double item);
/* Makes items the list, of which the newest ones are kept if there are more than it holds. */
void jox_list_fill(const JoxMachine *machine, double *memory, int32_t index, const double *items,
                   uint32_t count);

#endif
