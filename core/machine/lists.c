/* Short lists in memory: the named slot holds the length, hidden slots the items, numbers or
   somebody. eval.c reads them, signals.c changes them, functions do both. */
#include "base/assert.h"
#include "machine/machine_parts.h"

uint32_t jox_list_size(const JoxMemorySlot *slot, const double *memory, int32_t index) {
    const double size = memory[index];
    return size >= 1.0 ? (size < slot->capacity ? (uint32_t)size : slot->capacity) : 0;
}

double jox_list_end(const JoxMachine *machine, const double *memory, int32_t index, bool last) {
    const JoxMemorySlot *slot = &machine->memory[index];
    const uint32_t size = jox_list_size(slot, memory, index);
    return size ? memory[slot->items + (last ? size - 1 : 0)] : 0.0;
}

bool jox_list_has(const JoxMachine *machine, const double *memory, int32_t index, double item) {
    const JoxMemorySlot *slot = &machine->memory[index];
    const uint32_t size = jox_list_size(slot, memory, index);
    for (uint32_t k = 0; k < size; k++)
        if (memory[slot->items + k] == item)
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

void jox_list_change(const JoxMachine *machine, double *memory, int32_t index, JoxListChange change,
                     double item) {
    const JoxMemorySlot *slot = &machine->memory[index];
    double *items = memory + slot->items;
    uint32_t size = jox_list_size(slot, memory, index), kept = 0;
    if (change == JOX_LIST_PUSH && slot->kind == JOX_MEMORY_PEOPLE && item == JOX_NOBODY)
        return;
    const bool full = change == JOX_LIST_PUSH && size == slot->capacity;
    for (uint32_t k = full ? 1 : 0; change != JOX_LIST_CLEAR && k < size; k++)
        if (change == JOX_LIST_PUSH || items[k] != item)
            items[kept++] = items[k];
    if (change == JOX_LIST_PUSH)
        items[kept++] = item;
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
    if (jox_memory_is_list(slot))
        print_items(run, slot, memory + slot->items, jox_list_size(slot, memory, (int32_t)index),
                    out);
    else if (slot->kind == JOX_MEMORY_SOMEBODY)
        jox_who_print(run, memory[index], out);
    else if (slot->kind == JOX_MEMORY_BOOLEAN)
        jox_text_add(out, memory[index] != 0.0 ? "true" : "false");
    else
        jox_text_printf(out, "%.6g", memory[index]);
}
