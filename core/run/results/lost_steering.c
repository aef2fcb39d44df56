#include "run/results/lost_steering.h"

#include "base/format/plurals.h"
#include "base/mem.h"
#include "machine/machine_parts.h"
#include "machine/why.h"
#include "run/run.h"

static const double SHORTEST_STAND = 10.0; /* s without moving */
enum { MOST_STATES = 4 };                  /* named in a sentence */

/* People of a state who stand. */
typedef struct Lost {
    const JoxMachine *machine;
    const JoxState *state;
    uint32_t people;
} Lost;

/* Returns whether an agent that does not want to move would if the target of a term were found.
   Only words that stand for motion as long as they have a target count. */
static bool is_term_lost(const JoxMachineRun *run, const JoxMachine *machine,
                         const JoxSteerTerm *term, uint32_t i) {
    if ((term->kind != JOX_STEER_SEEK && term->kind != JOX_STEER_FIELD) || term->target < 0)
        return false;
    const JoxTargetKind kind = machine->targets[term->target].kind;
    if (kind == JOX_TARGET_LAST_SEEN)
        return !jox_target_find(run, i, term->target).found;
    return jox_target_kind_moves(kind) && jox_target_place(run, i, term->target) < 0;
}

/* Returns whether an agent has stood for long because its steering finds nobody. */
static bool is_lost(const JoxMachineRun *run, const JoxMachine *machine, const JoxState *state,
                    uint32_t i) {
    const JoxAgents *a = run->agents;
    if (state->steer_count == 0 || a->pref_x[i] != 0.0f || a->pref_y[i] != 0.0f ||
        (double)a->still[i] < SHORTEST_STAND || jox_time_in_state(run, i) < SHORTEST_STAND ||
        a->fallen[i] > 0.0f || jox_param(a, JOX_PARAM_speed, i) == 0.0f)
        return false;
    for (uint32_t t = 0; t < state->steer_count; t++)
        if (!is_term_lost(run, machine, &state->steer[t], i))
            return false;
    return true;
}

/* Lists the states whose steering leads somebody nowhere, most people first; the caller frees the
   list. */
static Lost *list_lost(const JoScene *scene, uint32_t *count) {
    const JoxMachineRun *run = &scene->world->machines;
    const JoxAgents *a = &scene->world->state.agents;
    Lost *list = NULL;
    size_t room = 0;
    *count = 0;
    for (uint32_t m = 0; m < run->set->count; m++) {
        const JoxMachine *machine = run->set->items[m];
        for (uint32_t s = 0; s < machine->state_count; s++) {
            Lost one = {machine, &machine->states[s], 0};
            for (uint32_t i = 0; i < a->count; i++)
                one.people +=
                    a->machine[i] == m && a->state[i] == s && is_lost(run, machine, one.state, i);
            if (one.people == 0)
                continue;
            JOX_RESERVE(list, room, *count + 1);
            uint32_t at = (*count)++;
            for (; at > 0 && list[at - 1].people < one.people; at--)
                list[at] = list[at - 1];
            list[at] = one;
        }
    }
    return list;
}

void jox_run_say_lost(const JoScene *scene, JoxText *out) {
    uint32_t count, people = 0;
    Lost *list = list_lost(scene, &count);
    for (uint32_t n = 0; n < count; n++)
        people += list[n].people;
    if (count) {
        jox_text_add(out, " ");
        jox_text_noun(out, people,
                      "person has stood for 10 s or more, as steering finds no target|"
                      "people have stood for 10 s or more, as their steering finds no target");
    }
    for (uint32_t n = 0; n < count && n < MOST_STATES; n++) {
        char number[JOX_NOUN];
        jox_text_printf(out, "%s%s in %.60s (", n ? ", " : ": ",
                        jox_number_text(number, list[n].people), list[n].state->name);
        jox_why_spell_steering(list[n].machine, list[n].state, out);
        jox_text_add(out, ")");
    }
    if (count > MOST_STATES)
        jox_text_printf(out, " and %u more states", count - MOST_STATES);
    if (count)
        jox_text_printf(out, ". `jostle why SCENE --state \"%.60s\"` says why.",
                        list[0].state->name);
    jox_free(list);
}

void jox_run_add_lost(const JoScene *scene, JoxJson *json) {
    uint32_t count;
    Lost *list = list_lost(scene, &count);
    if (count)
        jox_json_array(json, "lost_steering");
    for (uint32_t n = 0; n < count; n++) {
        JoxText steering = {0};
        jox_why_spell_steering(list[n].machine, list[n].state, &steering);
        jox_json_object(json, NULL);
        jox_json_string(json, "machine", list[n].machine->name);
        jox_json_string(json, "state", list[n].state->name);
        jox_json_whole(json, "people", list[n].people);
        jox_json_string(json, "steering", steering.data);
        jox_json_end(json);
        jox_text_free(&steering);
    }
    if (count)
        jox_json_end(json);
    jox_free(list);
}
