#include "world/input.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"

enum { FASTEST = 20 }; /* m/s */

void jox_input_add(JoxInputLog *log, JoxInputEntry entry) {
    JOX_RESERVE(log->entries, log->capacity, log->count + 1);
    log->entries[log->count++] = entry;
}

/* Reads one line without its comment; NULL or what is wrong with it. */
static const char *parse_line(const char *line, JoxInputEntry *entry, bool *empty) {
    char rest[2] = "", verb[16] = "";
    long long tick, id;
    double vx, vy;
    *empty = line[strspn(line, " \t\r")] == 0;
    if (*empty)
        return NULL;
    int got = sscanf(line, "%lld %15s %lld %lf %lf %1s", &tick, verb, &id, &vx, &vy, rest);
    if (got >= 2 && strcmp(verb, "player") != 0)
        return "the only kind of input is 'player'";
    if (got != 5)
        return "expected: TICK player AGENT VX VY";
    if (tick < 0 || tick >= UINT32_MAX || id < 0 || id >= UINT32_MAX)
        return "tick and agent must be whole numbers from 0";
    if (!(fabs(vx) <= FASTEST && fabs(vy) <= FASTEST))
        return "velocities must be within 20 m/s";
    *entry = (JoxInputEntry){(uint32_t)tick, (uint32_t)id, (float)vx, (float)vy};
    return NULL;
}

bool jox_input_parse(JoxInputLog *log, const char *file, const char *text, size_t length,
                     JoxDiagnostics *diagnostics) {
    const char *at = text, *end = text + length;
    uint32_t last = 0;
    size_t errors = diagnostics->errors;
    for (int number = 1; at < end; number++) {
        const char *newline = memchr(at, '\n', (size_t)(end - at));
        size_t n = (size_t)((newline ? newline : end) - at);
        char line[256];
        snprintf(line, sizeof line, "%.*s", (int)(n < 255 ? n : 255), at);
        line[strcspn(line, "#")] = 0;
        JoxInputEntry entry = {0};
        bool empty;
        const char *wrong = parse_line(line, &entry, &empty);
        if (!wrong && !empty && entry.tick < last)
            wrong = "ticks must not decrease";
        if (wrong)
            jox_diag_error(diagnostics, ((JoxPosition){file, number, 1, 1 + (int)strlen(line)}),
                           "bad-input", "Example: 40 player 0 1.5 0", "%s", wrong);
        else if (!empty) {
            jox_input_add(log, entry);
            last = entry.tick;
        }
        at = newline ? newline + 1 : end;
    }
    return diagnostics->errors == errors;
}

void jox_input_advance(JoxInputLog *log, uint32_t tick) {
    for (; log->next < log->count && log->entries[log->next].tick <= tick; log->next++) {
        JoxInputEntry *entry = &log->entries[log->next];
        uint32_t i = 0;
        while (i < log->present_count && log->present[i].agent_id != entry->agent_id)
            i++;
        if (i == log->present_count) {
            JOX_RESERVE(log->present, log->present_capacity, i + 1);
            log->present_count++;
        }
        log->present[i] = (struct JoxPlayerInput){entry->agent_id, entry->vx, entry->vy};
    }
}

void jox_input_free(JoxInputLog *log) {
    jox_free(log->entries);
    jox_free(log->present);
    *log = (JoxInputLog){0};
}
