/* Odd numbers: values of parameters and actions that a machine computes or draws and that are
   invalid (NaN, infinite, a radius or mass of 0 or less, a breadth or depth below 0 or computed as
   0). The nearest valid value is taken, and the first agent is reported, once per line of source.
 */
#include <math.h>

#include "agents/torso.h"
#include "base/assert.h"
#include "base/mem.h"
#include "machine/machine_parts.h"

/* Numbers of actions; `value` is taken for NaN. */
static const JoxParameterInfo ACTION_NUMBERS[] = {
    {"impulse of the kick", "m/s", "", 0, 50, 0},     {"speed of the kick", "m/s", "", 0, 50, 0},
    {"lift of the kick", "degrees", "", 0, 90, 0},    {"speed of the throw", "m/s", "", 0, 40, 0},
    {"grip", "N", "", 0, JOX_MOST_GRIP, 0},           {"lasts", "s", "", 0, 1e6, INFINITY},
    {"value of a message", "", "", -1e300, 1e300, 0},
};

bool jox_is_odd(int parameter, JoxValueKind kind, double value) {
    if (!isfinite(value))
        return true;
    switch (parameter) {
    case JOX_PARAM_radius:
    case JOX_PARAM_mass:
        return value <= 0.0;
    case JOX_PARAM_breadth:
    case JOX_PARAM_depth: /* a plain 0 asks for what the radius gives; a computed one is an error */
        return value < 0.0 || (value == 0.0 && kind == JOX_VALUE_EXPRESSION);
    default:
        return false;
    }
}

static bool is_odd_before(const JoxOdd *a, const JoxOdd *b) {
    return a->machine != b->machine       ? a->machine < b->machine
           : a->state != b->state         ? a->state < b->state
           : a->parameter != b->parameter ? a->parameter < b->parameter
                                          : a->agent_id < b->agent_id;
}

static bool was_reported(const JoxMachineRun *run, const JoxOdd *odd) {
    const uint32_t reloads = run->set->items[odd->machine]->reloads;
    for (uint32_t n = 0; n < run->told_count; n++) {
        const JoxTold *told = &run->told[n];
        if (told->machine == odd->machine && told->reloads == reloads && told->line == odd->line &&
            told->source == odd->source && told->parameter == odd->parameter)
            return true;
    }
    return false;
}

/* Returns the line that sets a parameter, and its file's index in `source`. */
static int32_t find_source_line(const JoxMachine *machine, const JoxValue *value,
                                uint32_t *source) {
    const bool own = value->line <= 0 && value->kind == JOX_VALUE_OWN;
    *source = own ? machine->own[value->index].source : value->source;
    return own ? machine->own[value->index].line : value->line;
}

static JoxOdd describe_odd(const JoxMachineRun *run, uint32_t i, int parameter,
                           const JoxValue *from, double value) {
    const JoxAgents *a = run->agents;
    const JoxMachine *machine = jox_machine_of(run, i);
    uint32_t source;
    const int32_t line = find_source_line(machine, from, &source);
    return (JoxOdd){.found = true,
                    .agent_id = a->id[i],
                    .machine = a->machine[i],
                    .state = a->state[i],
                    .parameter = parameter,
                    .line = line,
                    .source = source,
                    .value = value};
}

void jox_odd_look(const JoxMachineRun *run, const uint32_t *agents, uint32_t count, int parameter,
                  const double *values, JoxOdd *first) {
    bool any = false;
    for (uint32_t n = 0; n < count; n++)
        any |= jox_is_odd(parameter, JOX_VALUE_EXPRESSION, values[n]);
    for (uint32_t n = 0; any && n < count; n++) {
        if (!jox_is_odd(parameter, JOX_VALUE_EXPRESSION, values[n]))
            continue;
        const JoxMachine *machine = jox_machine_of(run, agents[n]);
        const JoxState *state = &machine->states[run->agents->state[agents[n]]];
        const JoxValue *from = jox_state_parameter(machine, state, parameter);
        const JoxOdd odd = describe_odd(run, agents[n], parameter, from, values[n]);
        if (was_reported(run, &odd))
            return; /* the others of this state were reported with it */
        if (!first->found || is_odd_before(&odd, first))
            *first = odd;
    }
}

const JoxOdd *jox_odd_first(const JoxOdd *odd, uint32_t count) {
    const JoxOdd *first = odd;
    for (uint32_t n = 1; n < count; n++)
        if (odd[n].found && (!first->found || is_odd_before(&odd[n], first)))
            first = &odd[n];
    return first;
}

/* Returns the number that is taken in place of an odd one. */
static double replace_odd(const JoxParameterInfo *info, double value) {
    return isnan(value) ? info->value : fmin(fmax(value, info->least), info->greatest);
}

/* Appends what is taken in place of an odd number, and the way out. */
static void say_replacement(const JoxOdd *odd, JoxText *out) {
    if (odd->parameter >= JOX_ACTION_MEMORY) {
        jox_text_add(out, "it keeps its value");
        return;
    }
    const JoxParameter parameter = (JoxParameter)odd->parameter;
    const bool action = odd->parameter >= JOX_PARAM_COUNT;
    const JoxParameterInfo *info = action ? &ACTION_NUMBERS[odd->parameter - JOX_PARAM_COUNT]
                                          : &jox_parameters[odd->parameter];
    const double taken =
        action ? replace_odd(info, odd->value)
               : jox_parameter_value(parameter, jox_parameter_store(parameter, odd->value));
    const bool breadth = odd->parameter == JOX_PARAM_breadth;
    if (taken == 0.0 && (breadth || odd->parameter == JOX_PARAM_depth)) {
        jox_text_printf(out,
                        "%g times the radius is taken, as where none is given. Keep it above 0, as "
                        "by clamp(x, 0.1, %g)",
                        (double)(breadth ? JOX_TORSO_BREADTH : JOX_TORSO_DEPTH), info->greatest);
        return;
    }
    jox_text_printf(out, "%g %s is taken. Keep it within bounds, as by clamp(x, %g, %g)", taken,
                    info->unit, info->least, info->greatest);
}

static const char *name_odd(const JoxMachine *machine, int parameter) {
    return parameter >= JOX_ACTION_MEMORY ? machine->memory[parameter - JOX_ACTION_MEMORY].name
           : parameter >= JOX_PARAM_COUNT ? ACTION_NUMBERS[parameter - JOX_PARAM_COUNT].name
                                          : jox_parameters[parameter].name;
}

void jox_odd_tell(JoxMachineRun *run, const JoxOdd *odd) {
    if (!odd->found || was_reported(run, odd))
        return;
    const JoxMachine *machine = run->set->items[odd->machine];
    jox_text_printf(&run->notes,
                    "%s:%d: t = %.2f s: %.60s of agent %u (machine %.60s, state %.60s) came out as "
                    "%g; ",
                    jox_machine_file(machine, odd->source), odd->line > 0 ? (int)odd->line : 1,
                    run->tick * run->dt, name_odd(machine, odd->parameter), odd->agent_id,
                    machine->name, machine->states[odd->state].name, odd->value);
    say_replacement(odd, &run->notes);
    jox_text_add(&run->notes, "\n");
    JOX_RESERVE(run->told, run->told_capacity, run->told_count + 1);
    run->told[run->told_count++] =
        (JoxTold){odd->machine, machine->reloads, odd->source, odd->line, odd->parameter};
}

void jox_odd_note(JoxMachineRun *run, uint32_t i, int parameter, const JoxValue *from,
                  double value) {
    const JoxOdd odd = describe_odd(run, i, parameter, from, value);
    jox_odd_tell(run, &odd);
}

double jox_action_number(JoxMachineRun *run, const JoxMachine *machine, JoxActionNumber number,
                         const JoxValue *value, uint32_t i) {
    JOX_ASSERT(number >= JOX_ACTION_KICK && number < JOX_ACTION_MEMORY);
    const double came_out = jox_value(run, machine, value, i);
    if (!isfinite(came_out))
        jox_odd_note(run, i, number, value, came_out);
    return replace_odd(&ACTION_NUMBERS[number - JOX_ACTION_KICK], came_out);
}
