/* Entries of an input log, and the position in it. */
#include "world/input/input_entries.h"

#include "base/assert.h"
#include "base/mem.h"

void jox_input_add(JoxInputLog *log, JoxInputEntry entry) {
    JOX_RESERVE(log->entries, log->capacity, log->count + 1);
    log->entries[log->count++] = entry;
}

const JoxInputEntry *jox_input_take_due(JoxInputLog *log, uint64_t tick) {
    JOX_ASSERT(log->next <= log->count);
    bool due = log->next < log->count && log->entries[log->next].tick <= tick;
    return due ? &log->entries[log->next++] : NULL;
}

void jox_input_set_player(JoxInputLog *log, uint32_t agent_id, float vx, float vy, bool button) {
    uint32_t i = 0;
    while (i < log->present_count && log->present[i].agent_id != agent_id)
        i++;
    if (i == log->present_count) {
        JOX_RESERVE(log->present, log->present_capacity, i + 1);
        log->present_count++;
    }
    log->present[i] = (struct JoxPlayerInput){agent_id, vx, vy, button};
}

void jox_input_entry_free(JoxInputEntry *entry) {
    for (int n = 0; n < JOX_INPUT_NAMES; n++)
        jox_free(entry->names[n]);
    for (uint32_t f = 0; entry->files && f < entry->number; f++) {
        jox_free(entry->files[f].path);
        jox_free(entry->files[f].text);
    }
    jox_free(entry->files);
    *entry = (JoxInputEntry){0};
}

void jox_input_free(JoxInputLog *log) {
    for (size_t e = 0; e < log->count; e++)
        jox_input_entry_free(&log->entries[e]);
    jox_free(log->entries);
    jox_free(log->present);
    *log = (JoxInputLog){0};
}
