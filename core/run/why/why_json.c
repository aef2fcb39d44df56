/* Writes as JSON why agents stay in their states. The live page reads the same members. */
#include <math.h>

#include "machine/lifts.h"
#include "run/why/why.h"

enum { DIGITS = 6 };

/* Adds the members of a term; `holders`: of many agents, per term, or NULL. */
static void add_term_members(const JoxWhyTransition *t, uint32_t index, const uint32_t *holders,
                             JoxJson *json) {
    static const char *const KINDS[] = {
        [JOX_WHY_ALL] = "all", [JOX_WHY_ANY] = "any", [JOX_WHY_WORD] = "word"};
    const JoxWhyTerm *term = &t->terms[index];
    jox_json_string(json, "kind", KINDS[term->kind]);
    jox_json_bool(json, "holds", term->holds);
    if (holders)
        jox_json_whole(json, "holders", holders[index]);
    jox_json_whole(json, "misses", term->gap.misses);
    jox_json_digits(json, "far", term->gap.far, DIGITS);
    if (term->kind != JOX_WHY_WORD) {
        jox_json_array(json, "terms");
        for (uint32_t k = term->first; k != JOX_WHY_NONE; k = t->terms[k].next) {
            jox_json_object(json, NULL);
            add_term_members(t, k, holders, json);
            jox_json_end(json);
        }
        jox_json_end(json);
        return;
    }
    jox_json_string(json, "text", term->text.data);
    if (term->measured) {
        jox_json_digits(json, "value", term->value, DIGITS);
        jox_json_string(json, "relation", term->relation);
        jox_json_digits(json, "bound", term->bound, DIGITS);
        jox_json_string(json, "unit", term->unit);
        JoxText measure = {0};
        jox_why_add_measure(term, &measure);
        jox_json_string(json, "measure", measure.data);
        jox_text_free(&measure);
    }
    if (term->note.length)
        jox_json_string(json, "note", term->note.data);
}

static void add_transition_members(const JoxMachine *machine, const JoxTransition *written,
                                   const JoxWhyTransition *t, const uint32_t *holders,
                                   JoxJson *json) {
    jox_json_string(json, "to", written->stays ? NULL : machine->states[t->to].name);
    jox_json_bool(json, "back", written->back);
    jox_json_string(json, "id", written->id);
    jox_json_string(json, "file", jox_machine_file(machine, written->source));
    jox_json_integer(json, "line", written->line);
    jox_json_whole(json, "misses", t->gap.misses);
    jox_json_digits(json, "far", t->gap.far, DIGITS);
    if (t->root != JOX_WHY_NONE) {
        jox_json_object(json, "when");
        add_term_members(t, t->root, holders, json);
        jox_json_end(json);
    }
}

/* Adds "messages": in words, those that wait for the agent. */
static void add_messages(const JoScene *scene, uint32_t agent, JoxJson *json) {
    const JoxMachineRun *machines = &scene->world->machines;
    uint32_t count;
    const JoxMessage *first = jox_messages_of(machines, agent, &count);
    jox_json_array(json, "messages");
    for (uint32_t m = 0; m < count; m++) {
        JoxText text = {0};
        if (first[m].used)
            continue;
        jox_why_add_message(machines, &first[m], &text);
        jox_json_string(json, NULL, text.data);
        jox_text_free(&text);
    }
    jox_json_end(json);
}

/* Adds "does": lines on what a state does. */
static void add_deeds(const JoxText *deeds, JoxJson *json) {
    const char *line = deeds->length ? deeds->data : "";
    jox_json_array(json, "does");
    for (; *line; line += strcspn(line, "\n") + 1) {
        JoxText text = {0};
        jox_text_append(&text, line, strcspn(line, "\n"));
        jox_json_string(json, NULL, text.data);
        jox_text_free(&text);
    }
    jox_json_end(json);
}

/* Adds "lift": how an agent uses a lift, if it does. */
static void add_ride(const JoWorld *world, uint32_t agent, JoxJson *json) {
    static const char *const WORDS[] = {
        [JOX_RIDE_APPROACH] = "approaches", [JOX_RIDE_WAIT] = "waits", [JOX_RIDE_INSIDE] = "rides"};
    const JoxRider *rider;
    const JoxRidePhase phase = jox_machines_ride(&world->machines, agent, &rider);
    if (phase == JOX_RIDE_OVER)
        return;
    const JoxLift *lift = &world->model.lifts[rider->lift];
    const JoxLiftCar *car = &world->state.lifts.cars[rider->lift];
    const JoxStorey *storeys = world->model.storeys.storeys;
    const uint32_t since = phase == JOX_RIDE_INSIDE ? rider->boarded : rider->since;
    jox_json_object(json, "lift");
    jox_json_string(json, "name", lift->name);
    jox_json_string(json, "does", WORDS[phase]);
    if (phase != JOX_RIDE_APPROACH)
        jox_json_digits(json, "since", since * world->model.def.dt, 9);
    jox_json_string(json, "from", storeys[lift->stops[rider->from].storey].name);
    jox_json_string(json, "to", storeys[lift->stops[rider->to].storey].name);
    jox_json_digits(json, "height", car->height, DIGITS);
    jox_json_whole(json, "people", car->people);
    jox_json_string(json, "mode", jox_lift_mode_names[car->mode]);
    jox_json_end(json);
}

/* Adds "lifts": how many of a crowd use each lift. */
static void add_lifts(const JoWorld *world, const JoxWhyCrowd *crowd, JoxJson *json) {
    if (world->model.lift_count == 0)
        return;
    jox_json_array(json, "lifts");
    for (uint32_t l = 0; l < world->model.lift_count; l++) {
        const struct JoxWhyCrowdLift *lift = &crowd->lifts[l];
        if (!lift->approach && !lift->wait && !lift->ride)
            continue;
        jox_json_object(json, NULL);
        jox_json_string(json, "name", world->model.lifts[l].name);
        jox_json_whole(json, "approach", lift->approach);
        jox_json_whole(json, "wait", lift->wait);
        jox_json_whole(json, "ride", lift->ride);
        if (lift->wait) {
            jox_json_whole(json, "longest", world->state.agents.id[lift->first]);
            jox_json_digits(json, "since", lift->since, DIGITS);
        }
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_why_agent_json(const JoScene *scene, const JoxWhyAgent *why, JoxJson *json) {
    static const char *const CHANCES[] = {[JOX_WHY_TO_ROLL] = "to roll", [JOX_WHY_LOST] = "lost"};
    add_messages(scene, why->agent, json);
    add_deeds(&why->deeds, json);
    add_ride(scene->world, why->agent, json);
    jox_json_array(json, "transitions");
    for (uint32_t k = 0; k < why->state->transition_count; k++) {
        const uint32_t index = why->order[k];
        const JoxWhyTransition *t = &why->transitions[index];
        const JoxTransition *written = &why->state->transitions[index];
        JoxText text = {0};
        if (!jox_why_is_asked(why, index))
            continue;
        jox_json_object(json, NULL);
        add_transition_members(why->machine, written, t, NULL, json);
        jox_json_bool(json, "fires", t->fires);
        if (t->is_function) {
            jox_why_add_function(scene, why->machine, written->when_hook, t->held_before, &text);
            jox_json_bool(json, "returned", t->held_before);
            jox_json_string(json, "function", text.data);
            jox_text_free(&text);
        }
        if (t->chance != JOX_WHY_CERTAIN) {
            jox_why_add_chance(scene, why, index, &text);
            jox_json_digits(json, "chance", t->chance_value, DIGITS);
            jox_json_string(json, "roll", CHANCES[t->chance]);
            jox_json_string(json, "chance_note", text.data);
            jox_text_free(&text);
        }
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_why_crowd_json(const JoScene *scene, const JoxWhyCrowd *crowd, JoxJson *json) {
    const JoxAgents *a = &scene->world->state.agents;
    jox_json_object(json, NULL);
    jox_json_string(json, "machine", crowd->machine->name);
    jox_json_string(json, "state", crowd->state->name);
    jox_json_whole(json, "people", crowd->people);
    jox_json_digits(json, "earliest", crowd->earliest, DIGITS);
    jox_json_digits(json, "latest", crowd->latest, DIGITS);
    jox_json_whole(json, "longest", a->id[crowd->longest]);
    add_deeds(&crowd->deeds, json);
    add_lifts(scene->world, crowd, json);
    jox_json_array(json, "transitions");
    for (uint32_t k = 0; k < crowd->state->transition_count; k++) {
        const uint32_t index = crowd->order[k];
        const struct JoxWhyCrowdTransition *t = &crowd->transitions[index];
        jox_json_object(json, NULL);
        add_transition_members(crowd->machine, &crowd->state->transitions[index], &t->shown,
                               t->holders, json);
        jox_json_whole(json, "fires", t->fires);
        jox_json_whole(json, "held", t->held);
        jox_json_whole(json, "lost_chance", t->lost);
        jox_json_whole(json, "nearest", a->id[t->nearest]);
        jox_json_end(json);
    }
    jox_json_end(json);
    jox_json_end(json);
}
