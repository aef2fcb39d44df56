/* Counts the scores of a scene (`tally`) over its agents, for results and their last lines.
   Warns of names in them that no behaviour has. */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "run/run.h"
#include "run/tally_scores.h"

double jox_run_count_tally(const JoScene *scene, const JoxTally *tally) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxMachineSet *set = scene->world->machines.set;
    double sum = 0, least = INFINITY, greatest = -INFINITY;
    uint32_t count = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        const JoxMachine *machine =
            a->machine[i] == JOX_NO_MACHINE ? NULL : set->items[a->machine[i]];
        if (tally->group >= 0 && a->group[i] != tally->group)
            continue;
        if (tally->state &&
            (!machine || !jox_state_is_in(&machine->states[a->state[i]], tally->state)))
            continue;
        const int32_t slot =
            machine && tally->memory ? jox_machine_memory(machine, tally->memory) : -1;
        if (tally->memory && slot < 0)
            continue;
        const double value = tally->memory ? a->memory[(size_t)i * a->memory_stride + slot] : 1;
        count++;
        sum += value;
        least = fmin(least, value);
        greatest = fmax(greatest, value);
    }
    if (tally->statistic == JOX_TALLY_SUM)
        return sum;
    if (count == 0)
        return NAN;
    return tally->statistic == JOX_TALLY_MEAN    ? sum / count
           : tally->statistic == JOX_TALLY_LEAST ? least
                                                 : greatest;
}

void jox_run_add_tally(const JoScene *scene, JoxJson *json) {
    const JoxSceneSpec *spec = scene->spec;
    if (spec->tally_count == 0)
        return;
    jox_json_object(json, "tally");
    for (uint32_t t = 0; t < spec->tally_count; t++)
        jox_json_number(json, spec->tallies[t].name, jox_run_count_tally(scene, &spec->tallies[t]));
    jox_json_end(json);
}

/* Whether two scores count the same for different groups, so that the greater is ahead. */
static bool are_rivals(const JoxTally *a, const JoxTally *b) {
    const char *texts[][2] = {{a->memory, b->memory}, {a->state, b->state}, {a->unit, b->unit}};
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++)
        if (!texts[t][0] != !texts[t][1] || (texts[t][0] && strcmp(texts[t][0], texts[t][1]) != 0))
            return false;
    return a->statistic == b->statistic && a->statistic != JOX_TALLY_LEAST && a->group != b->group;
}

static void append_leader(const JoScene *scene, JoxText *out) {
    const JoxSceneSpec *spec = scene->spec;
    const JoxTally *ahead = NULL;
    double most = -INFINITY;
    bool equal = false;
    for (uint32_t t = 0; t < spec->tally_count; t++) {
        const JoxTally *tally = &spec->tallies[t];
        const double value = jox_run_count_tally(scene, tally);
        if (!isfinite(value) || (t && !are_rivals(tally, &spec->tallies[0])))
            return;
        equal = value == most || (equal && value < most);
        if (value > most) {
            ahead = tally;
            most = value;
        }
    }
    if (spec->tally_count < 2)
        return;
    if (equal)
        jox_text_add(out, ": nobody is ahead");
    else
        jox_text_printf(out, ": %.60s is ahead", ahead->name);
}

void jox_run_say_tally(const JoScene *scene, JoxText *out) {
    const JoxSceneSpec *spec = scene->spec;
    for (uint32_t t = 0; t < spec->tally_count; t++) {
        const JoxTally *tally = &spec->tallies[t];
        const double value = jox_run_count_tally(scene, tally);
        jox_text_printf(out, "%s%.60s ", t ? ", " : " ", tally->name);
        if (isfinite(value))
            jox_text_printf(out, "%.4g%s%.20s", value, tally->unit ? " " : "",
                            tally->unit ? tally->unit : "");
        else
            jox_text_add(out, "none");
    }
    if (spec->tally_count) {
        append_leader(scene, out);
        jox_text_add(out, ".");
    }
}

/* Warns of a state or memory that no behaviour of the scene has. */
static void report_unknown_name(const JoScene *scene, const JoxTally *tally, bool state,
                                JoxDiagnostics *diagnostics) {
    const JoxMachineSet *set = scene->world->machines.set;
    const JoxPosition at = state ? tally->state_position : tally->memory_position;
    const char *name = state ? tally->state : tally->memory, *names[64], *now = NULL;
    char hint[JOX_HINT];
    size_t count = 0;
    for (uint32_t m = 0; m < set->count; m++) {
        const JoxMachine *machine = set->items[m];
        now = now ? now
                  : jox_machine_renamed(machine, state ? JOX_PART_STATE : JOX_PART_MEMORY, name);
        for (uint32_t s = 0; s < (state ? machine->state_count : machine->memory_count); s++) {
            const char *known = state ? machine->states[s].name : machine->memory[s].name;
            if (*known && count < sizeof names / sizeof *names)
                names[count++] = known;
        }
    }
    if (now)
        jox_diag_renamed(diagnostics, at, name, now);
    else
        jox_diag_warn(diagnostics, at, state ? "unknown-state" : "unknown-memory",
                      jox_did_you_mean(name, names, count, hint),
                      "no behaviour of the scene has a %s '%.60s'", state ? "state" : "memory",
                      name);
}

void jox_run_check_tally(const JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoxMachineSet *set = scene->world->machines.set;
    for (uint32_t t = 0; t < scene->spec->tally_count; t++) {
        const JoxTally *tally = &scene->spec->tallies[t];
        bool memory = !tally->memory, state = !tally->state;
        for (uint32_t m = 0; m < set->count; m++) {
            memory = memory || jox_machine_memory(set->items[m], tally->memory) >= 0;
            state = state || jox_machine_entry(set->items[m], tally->state) >= 0;
        }
        if (!memory)
            report_unknown_name(scene, tally, false, diagnostics);
        if (!state)
            report_unknown_name(scene, tally, true, diagnostics);
    }
}
