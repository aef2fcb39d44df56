/* Whether every number of the agents that the next step reads is finite. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "world/world.h"

/* Columns that are looked at, causes before effects: an agent whose preferred velocity is no number
   spoils its neighbours' velocities in the same step. */
enum { COLUMNS = 8 };

typedef struct Column {
    const char *what;
    const float *of;
} Column;

static void list_columns(const JoxAgents *a, Column out[COLUMNS]) {
    const Column columns[COLUMNS] = {{"preferred velocity", a->pref_x},
                                     {"preferred velocity", a->pref_y},
                                     {"inferred force", a->inferred_x},
                                     {"inferred force", a->inferred_y},
                                     {"velocity", a->vx},
                                     {"velocity", a->vy},
                                     {"position", a->x},
                                     {"position", a->y}};
    memcpy(out, columns, sizeof columns);
}

/* An exponent of all ones is that of an infinity or a NaN: one more, and it carries into the sign.
   In blocks, of which compilers make vector instructions. */
static bool is_finite(const float *column, uint32_t count) {
    enum { BLOCK = 64 };
    const uint32_t exponent = 0x7f800000u, one = 0x00800000u;
    uint32_t carried = 0, i = 0;
    for (; i + BLOCK <= count; i += BLOCK) {
        uint32_t bits[BLOCK];
        memcpy(bits, column + i, sizeof bits);
        for (int k = 0; k < BLOCK; k++)
            carried |= (bits[k] & exponent) + one;
    }
    for (; i < count; i++)
        carried |= isfinite(column[i]) ? 0 : ~exponent;
    return !(carried >> 31);
}

/* The agent of the least id whose number is not finite, and who it is. */
static void blame(JoWorld *w, const Column *column) {
    const JoxAgents *a = &w->state.agents;
    uint32_t worst = JOX_NO_INDEX;
    for (uint32_t i = 0; i < a->count; i++)
        if (!isfinite(column->of[i]) && (worst == JOX_NO_INDEX || a->id[i] < a->id[worst]))
            worst = i;
    JOX_ASSERT(worst != JOX_NO_INDEX); /* is_finite found one */
    uint16_t number = a->machine[worst];
    const JoxMachine *machine = number == JOX_NO_MACHINE ? NULL : w->model.machines.items[number];
    snprintf(w->failure, sizeof w->failure,
             "step %llu: the %s of agent %u is not finite (%s%.60s%s%.60s); the run cannot go on",
             (unsigned long long)w->state.tick, column->what, a->id[worst],
             machine ? "machine " : "no machine", machine ? machine->name : "",
             machine ? ", state " : "", machine ? machine->states[a->state[worst]].name : "");
}

bool jox_world_is_finite(JoWorld *w) {
    Column columns[COLUMNS];
    list_columns(&w->state.agents, columns);
    for (int c = 0; c < COLUMNS; c++)
        if (!is_finite(columns[c].of, w->state.agents.count)) {
            blame(w, &columns[c]);
            return false;
        }
    return true;
}
