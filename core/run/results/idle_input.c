/* Tells what of a played input log had no effect: entries that could not be done or that the run
   did not come to, and players whose agent never came or does not steer by `player`. */
#include "run/results/idle_input.h"

#include "base/format/plurals.h"
#include "run/run.h"

static bool expression_reads_driven(const JoxExpression *e) {
    bool reads = false;
    for (uint32_t k = 0; k < e->count; k++)
        reads |= e->code[k].op == JOX_OP_NOW && e->code[k].arg == JOX_NOW_driven;
    return reads;
}

/* Returns whether agents of a machine, or of one that they may become, can be driven. */
static bool can_be_driven(const JoxMachine *machine) {
    bool can = false;
    for (uint32_t e = 0; e < machine->expression_count; e++)
        can |= expression_reads_driven(&machine->expressions[e]);
    for (uint32_t s = 0; s < machine->state_count; s++) {
        const JoxState *state = &machine->states[s];
        can |= state->become != NULL;
        for (uint32_t t = 0; t < state->steer_count; t++)
            can |= state->steer[t].kind == JOX_STEER_PLAYER;
    }
    return can;
}

/* Appends what kept the log from driving an agent, if anything did. */
static void say_idle_player(const JoScene *scene, uint32_t id, JoxText *out) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxMachineSet *machines = scene->world->machines.set;
    const uint32_t i = jox_agents_find(a, id);
    if (id >= a->next_id) {
        jox_text_printf(out, " The input log drives agent %u, who never came: ", id);
        if (a->next_id)
            jox_text_printf(out, "ids went up to %u.", a->next_id - 1);
        else
            jox_text_add(out, "nobody did.");
    } else if (i != JOX_NO_INDEX && a->machine[i] == JOX_NO_MACHINE) {
        jox_text_printf(out, " The input log drives agent %u, who has no behaviour.", id);
    } else if (i != JOX_NO_INDEX && !can_be_driven(machines->items[a->machine[i]])) {
        jox_text_printf(out,
                        " The input log drives agent %u, whose behaviour %.60s has no `player`: it "
                        "went its own way.",
                        id, machines->items[a->machine[i]]->name);
    }
}

void jox_run_say_idle_input(const JoScene *scene, JoxText *out) {
    const JoxInputLog *log = &scene->world->state.input;
    if (!scene->input_path)
        return;
    if (log->count == 0)
        jox_text_add(out, " The input log is empty: it drove nobody.");
    for (uint32_t p = 0; p < log->present_count; p++)
        say_idle_player(scene, log->present[p].agent_id, out);
    if (scene->input_failed) {
        jox_text_add(out, " The run skipped ");
        jox_text_noun(out, scene->input_failed, "entry|entries");
        jox_text_printf(out, " of the input log: the first, in line %d, as %s.",
                        scene->input_failed_line, scene->input_failed_why);
    }
    if (log->next == log->count)
        return;
    const JoxInputEntry *first = &log->entries[log->next];
    jox_text_add(out, " The run ended before ");
    jox_text_noun(out, log->count - log->next, "entry|entries");
    jox_text_printf(out, " of the input log: the next, in line %d, was due at %.2f s.", first->line,
                    first->tick * scene->world->model.def.dt);
}
