/* Short lists in memory: the named slot holds the length, hidden slots the items, numbers or
   somebody. Who has left the world is in no list: reading skips it, and the next change drops it.
   eval.c reads them, signals.c changes them, functions do both. */
#include "base/assert.h"
#include "machine/machine_parts.h"

/* Returns the number of items in memory, also of those who have left the world. */
static uint32_t get_length(const JoxMemorySlot *slot, const double *memory, int32_t index) {
    const double size = memory[index];
    return size >= 1.0 ? (size < slot->capacity ? (uint32_t)size : slot->capacity) : 0;
}

uint32_t jox_list_read(const JoxMachineRun *run, const JoxMachine *machine, const double *memory,
                       int32_t index, double items[JOX_MOST_ITEMS]) {
    const JoxMemorySlot *slot = &machine->memory[index];
    const uint32_t length = get_length(slot, memory, index);
    uint32_t count = 0;
    for (uint32_t k = 0; k < length; k++) {
        const double item = memory[slot->items + k];
        if (slot->kind != JOX_MEMORY_PEOPLE || jox_who_exists(run, item))
            items[count++] = item;
    }
    return count;
}

double jox_list_end(const JoxMachineRun *run, const JoxMachine *machine, const double *memory,
                    int32_t index, bool last) {
    double items[JOX_MOST_ITEMS];
    const uint32_t count = jox_list_read(run, machine, memory, index, items);
    return count ? items[last ? count - 1 : 0] : 0.0;
}

bool jox_list_has(const JoxMachineRun *run, const JoxMachine *machine, const double *memory,
                  int32_t index, double item) {
    double items[JOX_MOST_ITEMS];
    const uint32_t count = jox_list_read(run, machine, memory, index, items);
    for (uint32_t k = 0; k < count; k++)
        if (items[k] == item)
            return true;
    return false;
}

/* Makes the first `size` of some items the list; the others become 0, as state is hashed. */
static void end_list(const JoxMemorySlot *slot, double *memory, int32_t index, uint32_t size) {
    JOX_ASSERT(size <= slot->capacity);
    for (uint32_t k = size; k < slot->capacity; k++)
        memory[slot->items + k] = 0.0;
    memory[index] = size;
}

void jox_list_change(const JoxMachineRun *run, const JoxMachine *machine, double *memory,
                     int32_t index, JoxListChange change, double item) {
    const JoxMemorySlot *slot = &machine->memory[index];
    double *items = memory + slot->items, before[JOX_MOST_ITEMS];
    if (change == JOX_LIST_PUSH && slot->kind == JOX_MEMORY_PEOPLE && item == JOX_NOBODY)
        return;
    const uint32_t size = jox_list_read(run, machine, memory, index, before);
    const bool full = change == JOX_LIST_PUSH && size == slot->capacity;
    uint32_t kept = 0;
    for (uint32_t k = full ? 1 : 0; change != JOX_LIST_CLEAR && k < size; k++)
        if (change == JOX_LIST_PUSH || before[k] != item)
            items[kept++] = before[k];
    if (change == JOX_LIST_PUSH)
        items[kept++] = item;
    end_list(slot, memory, index, kept);
}

void jox_list_fill(const JoxMachine *machine, double *memory, int32_t index, const double *items,
                   uint32_t count) {
    const JoxMemorySlot *slot = &machine->memory[index];
    const uint32_t kept = count < slot->capacity ? count : slot->capacity;
    for (uint32_t k = 0; k < kept; k++)
        memory[slot->items + k] = items[count - kept + k];
    end_list(slot, memory, index, kept);
}

/* Prints the items of a list. */
static void print_items(const JoxMachineRun *run, const JoxMemorySlot *slot, const double *items,
                        uint32_t count, JoxText *out) {
    for (uint32_t k = 0; k < count; k++) {
        jox_text_add(out, k ? ", " : "");
        if (slot->kind == JOX_MEMORY_PEOPLE)
            jox_who_print(run, items[k], out);
        else
            jox_text_printf(out, "%.6g", items[k]);
    }
    if (count == 0)
        jox_text_add(out, "empty");
}

void jox_memory_print(const JoxMachineRun *run, const JoxMachine *machine, const double *memory,
                      uint32_t index, JoxText *out) {
    const JoxMemorySlot *slot = &machine->memory[index];
    double items[JOX_MOST_ITEMS];
    if (jox_memory_is_list(slot))
        print_items(run, slot, items, jox_list_read(run, machine, memory, (int32_t)index, items),
                    out);
    else if (slot->kind == JOX_MEMORY_SOMEBODY)
        jox_who_print(run, memory[index], out);
    else if (slot->kind == JOX_MEMORY_BOOLEAN)
        jox_text_add(out, memory[index] != 0.0 ? "true" : "false");
    else
        jox_text_printf(out, "%.6g", memory[index]);
}
