/* Signals and messages in words: who gave them last, when and where, and what became of them.
   why_words.c calls it. */
#include "machine/why_words.h"

#include "geom/storey_text.h"
#include "machine/way_between.h"

/* ---- signals ---- */

/* A call of a signal, as one agent may hear it. */
typedef struct Call {
    bool found, present; /* present: it is heard in this step, if at all */
    bool then;           /* `own` is where the agent was when it was called */
    uint32_t agent_id;   /* UINT32_MAX: announced to everybody */
    double time;         /* s */
    JoxV2 at, own;       /* m */
} Call;

/* Returns whether walls hide a call's point from an agent. */
static bool is_hidden(const JoxMachineRun *run, const Call *call, JoxV2 way) {
    return jox_is_hidden(run, call->own, jox_add(call->own, way), false);
}

/* Returns whether an agent at `own` hears what is called at a point. */
static bool is_heard(const JoxMachineRun *run, const Call *call, double reach) {
    const JoxV2 way = jox_way_to(run->agents, call->own, call->at);
    return jox_length(way) <= reach && !is_hidden(run, call, way);
}

/* Finds the call that is heard in this step, else the nearest of those that are not, else the last
   one. */
static Call find_call(const JoxMachineRun *run, uint32_t i, uint32_t name, double reach) {
    const JoxMachineState *state = run->state;
    const JoxMachineScratch *heard = run->scratch;
    const JoxV2 own = jox_why_position(run, i);
    Call best = {.own = own, .present = true, .then = true, .time = run->tick * run->dt};
    for (uint32_t n = 0; n < heard->everywhere_count; n++)
        if (heard->everywhere[n] == name) {
            best.found = true;
            best.agent_id = UINT32_MAX;
            return best;
        }
    for (uint32_t n = 0; n < heard->heard_count; n++) {
        const JoxSignal *s = &heard->heard[n];
        Call one = best;
        one.found = true;
        one.agent_id = s->agent_id;
        one.at = jox_v2(s->x, s->y);
        if (s->name != name || (best.found && s->agent_id == run->agents->id[i]))
            continue;
        const bool itself = best.agent_id == run->agents->id[i];
        const bool hears = is_heard(run, &one, reach), heard_best = is_heard(run, &best, reach);
        const bool nearer = jox_length2(jox_way_to(run->agents, own, one.at)) <
                            jox_length2(jox_way_to(run->agents, own, best.at));
        if (!best.found || itself || (hears && !heard_best) || (hears == heard_best && nearer))
            best = one;
    }
    if (best.found || name >= state->call_count || state->calls[name].count == 0)
        return best;
    const JoxNameCall *last = &state->calls[name];
    best = (Call){.found = true,
                  .agent_id = last->agent_id,
                  .time = last->tick * run->dt,
                  .at = jox_v2(last->x, last->y),
                  .own = own};
    for (uint32_t w = 0; w < run->watched_count; w++)
        for (uint32_t k = 0; k < run->watched[w].overheard_count; k++) {
            const struct JoxOverheard *call = &run->watched[w].overheard[k];
            if (run->watched[w].agent_id == run->agents->id[i] && call->name == name) {
                best.agent_id = call->agent_id;
                best.at = jox_v2(call->x, call->y);
                best.own = jox_v2(call->own_x, call->own_y);
                best.then = true;
            }
        }
    return best;
}

void jox_why_add_call(const JoxMachineRun *run, uint32_t i, uint32_t name, double reach,
                      JoxText *out) {
    const double perception = (double)jox_param(run->agents, JOX_PARAM_perception, i);
    const double wide = fmin(reach, perception);
    const Call call = find_call(run, i, name, wide);
    if (!call.found) {
        jox_text_add(out, "nobody has called it so far");
        return;
    }
    if (call.agent_id == UINT32_MAX) {
        jox_text_printf(out, "called out to everybody at %.2f s", call.time);
    } else if (call.agent_id == run->agents->id[i]) {
        jox_text_printf(out, "it called it itself at %.2f s, which is not heard", call.time);
        return;
    } else {
        const JoxStoreys *storeys = run->agents->storeys;
        const JoxV2 at = jox_in_plan(storeys, call.at);
        const JoxV2 way = jox_way_to(run->agents, call.own, call.at);
        const double distance = (double)jox_length(way);
        jox_text_printf(out, "agent %u called it at %.2f s at (%.2f, %.2f)", call.agent_id,
                        call.time, (double)at.x, (double)at.y);
        jox_text_storey(out, storeys, call.at);
        if (distance >= (double)JOX_OUT_OF_SIGHT) {
            jox_text_add(out, ", out of sight on another storey");
            return;
        }
        jox_text_printf(out, ", %.3g m %s%s", distance,
                        call.present ? "away"
                        : call.then  ? "away from where it was then"
                                     : "from where it is now",
                        is_hidden(run, &call, way) ? ", behind a wall" : "");
        if (distance > wide)
            jox_text_printf(out, "; it hears as far as %.3g m (%s)", wide,
                            reach < perception ? "as asked for" : "its perception");
    }
    if (!call.present && (call.agent_id == UINT32_MAX || is_heard(run, &call, wide)))
        jox_text_add(out, "; a signal is heard in the next step alone");
}

/* ---- messages ---- */

void jox_why_add_message(const JoxMachineRun *run, const JoxMessage *message, JoxText *out) {
    jox_text_printf(out, "'%s' of agent %u, told at %.2f s", run->set->names[message->name],
                    message->from, message->sent * run->dt);
    for (uint32_t v = 0; v < message->count; v++) {
        jox_text_printf(out, ", %s ", run->set->names[message->names[v]]);
        if (message->somebody >> v & 1)
            jox_who_print(run, message->values[v], out);
        else
            jox_text_printf(out, "%.4g", message->values[v]);
    }
}

/* Returns whether some machine tells messages of this name, or may do so by a function. */
static bool may_be_told(const JoxMachineRun *run, uint32_t name) {
    bool may = false;
    for (uint32_t m = 0; m < run->set->count; m++) {
        const JoxMachine *machine = run->set->items[m];
        may |= machine->tells_functions;
        for (uint32_t n = 0; n < machine->name_count; n++)
            may |= machine->names[n].number == name && (machine->names[n].uses & JOX_NAME_SENT);
    }
    return may;
}

/* Appends what became of the last message of a name that came to a watched agent. Returns false if
   it is not known. */
static bool say_fate(const JoxMachineRun *run, uint32_t i, uint32_t name, JoxText *out) {
    const JoxWatched *watched = NULL;
    const struct JoxCame *came = NULL;
    for (uint32_t w = 0; w < run->watched_count; w++)
        if (run->watched[w].agent_id == run->agents->id[i])
            watched = &run->watched[w];
    for (uint32_t k = 0; watched && k < watched->came_count; k++)
        if (watched->came[k].name == name)
            came = &watched->came[k];
    if (!watched)
        return false;
    if (!came) {
        jox_text_printf(out, "; none has come to it since %.2f s", watched->begun * run->dt);
        return true;
    }
    jox_text_printf(out, "; the last of %u that came was told by agent %u at %.2f s", came->count,
                    came->from, came->sent * run->dt);
    if (came->fate == JOX_CAME_USED)
        jox_text_printf(out, ", and was used at %.2f s by %s", came->tick * run->dt, came->by);
    if (came->fate == JOX_CAME_LOST)
        jox_text_printf(out, ", and was dropped at %.2f s, as more than %d waited",
                        came->tick * run->dt, JOX_MOST_WAITING);
    return true;
}

/* Appends how many messages of a name were told in the scene, and to whom. */
static void say_tally(const JoxMachineRun *run, const JoxMessageTally *tally, bool last,
                      JoxText *out) {
    jox_text_printf(out, "; in the scene %llu %s told",
                    (unsigned long long)(tally->count + tally->to_nobody + tally->unasked),
                    tally->count + tally->to_nobody + tally->unasked == 1 ? "was" : "were");
    if (last && tally->count)
        jox_text_printf(out, ", the last at %.2f s by agent %u to agent %u", tally->sent * run->dt,
                        tally->from, tally->to);
    if (tally->to_nobody)
        jox_text_printf(out, ", %llu of them to nobody", (unsigned long long)tally->to_nobody);
    if (tally->unasked)
        jox_text_printf(out, ", %llu of them to agents whose behaviour does not ask for it",
                        (unsigned long long)tally->unasked);
    if (tally->lost)
        jox_text_printf(out, ", %llu of them dropped, as too many waited",
                        (unsigned long long)tally->lost);
}

void jox_why_add_told(const JoxMachineRun *run, uint32_t i, uint32_t name, JoxText *out) {
    const JoxMessage *found = jox_message_find(run, i, name);
    const JoxMessageTally none = {0};
    const JoxMessageTally *tally =
        name < run->state->tally_count ? &run->state->tallies[name] : &none;
    uint32_t count, others = 0;
    const JoxMessage *first = jox_messages_of(run, i, &count);
    if (found) {
        jox_why_add_message(run, found, out);
        return;
    }
    jox_text_add(out, "no such message waits");
    if (tally->count + tally->to_nobody + tally->unasked == 0)
        jox_text_add(out, may_be_told(run, name) ? ": nobody has told one so far"
                                                 : ": no behaviour of the scene tells it");
    for (uint32_t m = 0; m < count; m++)
        if (!first[m].used)
            jox_text_printf(out, "%s'%s'",
                            others++ ? ", " : "; others do: ", run->set->names[first[m].name]);
    if (tally->count + tally->to_nobody + tally->unasked > 0) {
        const bool fate = say_fate(run, i, name, out);
        say_tally(run, tally, !fate, out);
    }
}
