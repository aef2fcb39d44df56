/* Facts in a few words, for text and JSON alike. */
#include <math.h>
#include <string.h>

#include "base/format/plurals.h"
#include "run/why/why.h"

void jox_why_add_place(const JoxMachine *machine, const JoxTransition *t, JoxText *out) {
    jox_text_printf(out, "%s:%d", jox_machine_file(machine, t->source), t->line);
}

void jox_why_add_function(const JoScene *scene, const JoxMachine *machine, int32_t hook,
                          bool returned, JoxText *out) {
    JoLuaCost cost;
    char calls[JOX_NOUN];
    if (!jox_lua_cost(scene->lua, machine, (uint32_t)hook, &cost)) {
        jox_text_add(out, "a function that is not loaded");
        return;
    }
    const char *failure = jox_lua_last_failure(scene->lua, machine, (uint32_t)hook);
    if (cost.suspended)
        jox_text_add(out, "it failed too often and is suspended until the file is reloaded");
    else if (cost.calls == 0)
        jox_text_add(out, "it has not been called yet");
    else
        jox_text_printf(out, "it returned %s when it was last asked", returned ? "true" : "false");
    if (cost.calls)
        jox_text_printf(out, "; %s in all, %.2g us each", jox_noun(calls, cost.calls, "call"),
                        cost.seconds * 1e6 / (double)cost.calls);
    if (failure)
        jox_text_printf(out, "; it failed %s: %s", jox_noun(calls, cost.failures, "time"), failure);
}

bool jox_why_add_memory(const JoScene *scene, uint32_t agent, uint32_t slot, JoxText *out) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxMachine *machine = scene->world->machines.set->items[a->machine[agent]];
    if (!*machine->memory[slot].name)
        return false;
    jox_memory_print(&scene->world->machines, machine, a->memory + (size_t)agent * a->memory_stride,
                     slot, out);
    return true;
}

bool jox_why_add_own(const JoScene *scene, uint32_t agent, uint32_t slot, JoxText *out) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    const JoxOwnSlot *own = &world->machines.set->items[a->machine[agent]]->own[slot];
    const double value = jox_own(a, agent, slot);
    if (!*own->name || own->kept || jox_parameter_find(own->name) >= 0)
        return false;
    const bool place = own->is_place && value >= 0.0 && value < world->model.place_count;
    if (place && world->model.places[(uint32_t)value].name)
        jox_text_add(out, world->model.places[(uint32_t)value].name);
    else
        jox_text_printf(out, "%.4g", value);
    return true;
}

void jox_why_add_chance(const JoScene *scene, const JoxWhyAgent *why, uint32_t transition,
                        JoxText *out) {
    const JoxWhyTransition *t = &why->transitions[transition];
    const struct JoxRolled *roll = why->watched ? &why->watched->rolls[transition] : NULL;
    jox_text_printf(out, "chance %.4g: ", t->chance_value);
    if (roll && roll->rolled)
        jox_text_printf(out, "%.4g was drawn at %.2f s, when the condition became true; ",
                        roll->drawn, roll->tick * scene->world->model.def.dt);
    if (t->chance == JOX_WHY_LOST && roll && roll->rolled)
        jox_text_add(out, "drawn again only after the condition has been false");
    else if (t->chance == JOX_WHY_LOST)
        jox_text_add(out, "drawn when the condition became true, and lost; drawn again only "
                          "after the condition has been false");
    else if (t->holds)
        jox_text_add(out, "the condition has just become true: drawn in the next step");
    else
        jox_text_add(out, "drawn each time the condition becomes true");
}

/* Appends a number with its unit. */
static void add_quantity(double value, const char *unit, JoxText *out) {
    if (isinf(value))
        jox_text_add(out, value > 0.0 ? "endless" : "-endless");
    else
        jox_text_printf(out, "%.4g%s%s", value, *unit ? " " : "", unit);
}

void jox_why_add_measure(const JoxWhyTerm *term, JoxText *out) {
    add_quantity(term->value, term->unit, out);
    if (term->holds)
        return;
    const bool equal = strcmp(term->relation, "is") == 0;
    const bool unequal = strcmp(term->relation, "is not") == 0;
    jox_text_printf(out,
                    unequal ? ", needs anything but "
                    : equal ? ", needs "
                            : ", needs %s ",
                    term->relation);
    add_quantity(term->bound, term->unit, out);
}
