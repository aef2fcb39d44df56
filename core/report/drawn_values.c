#include "report/drawn_values.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "agents/torso.h"
#include "base/mem.h"

/* Parameters that every report shows; others are shown if they are own values. */
static const JoxParameter SHOWN[] = {JOX_PARAM_speed, JOX_PARAM_mass, JOX_PARAM_time_gap,
                                     JOX_PARAM_haste};
enum { SHOWN_COUNT = sizeof SHOWN / sizeof *SHOWN };

static void add_value(JoxDrawnValues *v, uint32_t group, const char *name, double x) {
    uint32_t k = 0;
    while (k < v->count && (v->items[k].group != group ||
                            strncmp(v->items[k].name, name, sizeof v->items[k].name - 1) != 0))
        k++;
    if (k == v->count) {
        JOX_RESERVE(v->items, v->capacity, v->count + 1);
        memset(&v->items[k], 0, sizeof v->items[k]); /* padding too, which checkpoints hold */
        snprintf(v->items[k].name, sizeof v->items[k].name, "%s", name);
        v->items[k].group = group;
        v->items[k].least = INFINITY;
        v->items[k].greatest = -INFINITY;
        v->count++;
    }
    JoxDrawnValue *item = &v->items[k];
    const double from = x - item->mean; /* Welford's update */
    item->people++;
    item->mean += from / item->people;
    item->squares += from * (x - item->mean);
    item->least = fmin(item->least, x);
    item->greatest = fmax(item->greatest, x);
}

/* Returns whether the machine has an own value of this name, which stands for the parameter. */
static bool has_own(const JoxMachine *machine, const char *name) {
    for (uint32_t s = 0; s < machine->own_count; s++)
        if (strcmp(machine->own[s].name, name) == 0)
            return true;
    return false;
}

static void add_person(JoxDrawnValues *v, const JoWorld *world, uint32_t i) {
    const JoxAgents *a = &world->state.agents;
    const JoxMachine *machine = world->model.machines.items[a->machine[i]];
    const JoxTorso torso = jox_agent_torso(a, i, world->model.def.literal);
    const uint32_t group = a->group[i];
    for (int p = 0; p < SHOWN_COUNT; p++)
        if (!has_own(machine, jox_parameters[SHOWN[p]].name))
            add_value(v, group, jox_parameters[SHOWN[p]].name,
                      jox_parameter_value(SHOWN[p], jox_param(a, SHOWN[p], i)));
    add_value(v, group, "torso breadth", 2.0 * (double)(torso.half + torso.radius));
    add_value(v, group, "torso depth", 2.0 * (double)torso.radius);
    for (uint32_t s = 0; s < machine->own_count; s++) {
        const JoxOwnSlot *slot = &machine->own[s];
        if (*slot->name && !slot->is_place && !slot->general && !slot->kept)
            add_value(v, group, slot->name, jox_own(a, i, s));
    }
}

void jox_drawn_values_add(JoxDrawnValues *v, const JoWorld *world) {
    const JoxAgents *a = &world->state.agents;
    if (a->next_id == v->next_id)
        return;
    for (uint32_t rank = 0; rank < a->count; rank++) /* by id, so that sums have one order */
        if (a->id[a->by_rank[rank]] >= v->next_id)
            add_person(v, world, a->by_rank[rank]);
    v->next_id = a->next_id;
}

double jox_drawn_deviation(const JoxDrawnValue *value) {
    return value->people > 1 ? sqrt(value->squares / (value->people - 1)) : 0.0;
}

bool jox_drawn_is_shown(const char *name) {
    for (int p = 0; p < SHOWN_COUNT; p++)
        if (strcmp(jox_parameters[SHOWN[p]].name, name) == 0)
            return true;
    return false;
}

void jox_drawn_values_sections(JoxDrawnValues *v, JoxSections *s) {
    JOX_SECTION_ARRAY(s, "drawn", v->items, v->count, v->capacity);
    JOX_SECTION(s, "drawn_next", v->next_id);
    for (uint32_t k = 0; k < v->count; k++) /* names from a checkpoint may lack their end */
        v->items[k].name[sizeof v->items[k].name - 1] = 0;
}
