/* Tells what a target is for an agent; if it is not found, which candidates there are, and why each
   of them does not match. why_words.c and why.c call it. */
#include <stdio.h>
#include <string.h>

#include "base/format/plurals.h"
#include "base/mem.h"
#include "machine/way_between.h"
#include "machine/why_words.h"

/* What a target asks of an agent or body, in the order in which it is told. */
typedef enum Need {
    NEED_PERSON, /* a filter on agents, which no body passes */
    NEED_FALLEN,
    NEED_STATE,
    NEED_MACHINE,
    NEED_GROUP,
    NEED_MEMORY,
    NEED_FLIES,
    NEED_COMES,
    NEED_WITHIN,
    NEED_AHEAD,
    NEED_PERCEPTION,
    NEED_NO_WALL,
    NEED_NO_BODY,
    NEED_NEIGHBOUR, /* in a large crowd: it is one of the nearest */
    NEEDS
} Need;

/* An agent or body that a target may mean, seen or not. */
typedef struct Candidate {
    uint32_t agent; /* index; JOX_NO_INDEX: a body, or none */
    int32_t object; /* row; -1: an agent, or none */
    JoxV2 offset;   /* m, from the agent to it */
    uint32_t lacks; /* bits of Need */
} Candidate;

/* All candidates of a target. */
typedef struct Tally {
    uint32_t count, passed;  /* in the world; that lack nothing */
    uint32_t lacking[NEEDS]; /* that lack this first */
    Candidate best;          /* one that lacks least, the nearest of these */
} Tally;

void jox_why_add_somebody(const JoxMachineRun *run, uint32_t agent, int32_t object, JoxText *out) {
    const JoxAgents *a = run->agents;
    if (agent != JOX_NO_INDEX && a->machine[agent] != JOX_NO_MACHINE)
        jox_text_printf(out, "agent %u (in %s)", a->id[agent],
                        jox_machine_of(run, agent)->states[a->state[agent]].name);
    else if (agent != JOX_NO_INDEX)
        jox_text_printf(out, "agent %u", a->id[agent]);
    else if (object >= 0 && *run->objects->rows[object].name)
        jox_text_printf(out, "body '%s'", run->objects->rows[object].name);
    else if (object >= 0)
        jox_text_printf(out, "body %u", run->objects->rows[object].id);
}

/* ---- needs ---- */

/* Returns the part of a filter that makes one need; false: the filter does not have it. */
static bool take_filter_part(const JoxAgentFilter *filter, Need need, JoxAgentFilter *part) {
    *part = (JoxAgentFilter){.state = -1, .machine = -1, .memory = -1, .group = -1};
    part->some = filter->some && need <= NEED_MEMORY;
    switch (need) {
    case NEED_FALLEN:
        return part->some && (part->fallen = filter->fallen);
    case NEED_STATE:
        return part->some && (part->state = filter->state) >= 0;
    case NEED_MACHINE:
        return part->some && (part->machine = filter->machine) >= 0;
    case NEED_GROUP:
        return part->some && (part->group = filter->group) >= 0;
    case NEED_MEMORY:
        part->memory = filter->memory;
        part->least = filter->least;
        part->greatest = filter->greatest;
        return part->some && filter->memory >= 0;
    case NEED_COMES:
        return (part->comes = filter->comes) > 0.0f;
    case NEED_WITHIN:
        return (part->within = filter->within) > 0.0f;
    case NEED_AHEAD:
        return (part->ahead = filter->ahead) > 0.0f;
    default:
        return false;
    }
}

/* Returns whether an agent is among the neighbours of agent i. */
static bool is_neighbour(const JoxMachineRun *run, uint32_t i, uint32_t j) {
    const JoxNeighbours *n = run->neighbours;
    for (uint32_t k = 0; k < n->count[i]; k++)
        if (n->index[jox_neighbour_at(n, i, k)] == j)
            return true;
    return false;
}

/* Returns bits of the needs of sight that a candidate lacks. */
static uint32_t find_unseen(const JoxMachineRun *run, uint32_t i, const Candidate *c) {
    const JoxAgents *a = run->agents;
    const float reach = jox_param(a, JOX_PARAM_perception, i), d2 = jox_length2(c->offset);
    const JoxV2 from = jox_why_position(run, i), to = jox_add(from, c->offset);
    const bool person = c->agent != JOX_NO_INDEX;
    if (person ? d2 > reach * reach : !(d2 < reach * reach))
        return 1u << NEED_PERCEPTION;
    if (!person && !run->objects->rows[c->object].in_band)
        return 0;
    if (jox_is_hidden(run, from, to, false))
        return 1u << NEED_NO_WALL;
    if (jox_is_behind_body(run, from, to, c->object))
        return 1u << NEED_NO_BODY;
    return 0;
}

/* Returns bits of what a candidate lacks; `chosen`: by a target that chooses among those seen. */
static uint32_t find_lacks(const JoxMachineRun *run, uint32_t i, const JoxAgentFilter *filter,
                           const Candidate *c, bool chosen) {
    const bool person = c->agent != JOX_NO_INDEX;
    const JoxObject *body = person ? NULL : &run->objects->rows[c->object];
    const JoxV2 moves = person ? jox_v2(run->agents->vx[c->agent], run->agents->vy[c->agent])
                               : jox_v2(body->velocity.x, body->velocity.y);
    uint32_t lacks = find_unseen(run, i, c);
    JoxAgentFilter part;
    if (filter->flies && (person || !jox_object_flies(body)))
        lacks |= 1u << NEED_FLIES;
    if (filter->some && !person)
        lacks |= 1u << NEED_PERSON;
    for (Need need = 0; need < NEEDS; need++)
        if (take_filter_part(filter, need, &part) && (person || !part.some) &&
            !(part.some ? jox_passes_filter(run, &part, i, c->agent)
                        : jox_passes_view(run, &part, i, c->offset, moves)))
            lacks |= 1u << need;
    if (chosen && lacks == 0 && person && run->agents->count > JOX_SMALL_CROWD &&
        !is_neighbour(run, i, c->agent))
        lacks |= 1u << NEED_NEIGHBOUR;
    return lacks;
}

/* Appends what it means to lack a need: "not in state Hide", "behind a wall". */
static void add_lack(const JoxMachineRun *run, uint32_t i, const JoxAgentFilter *filter, Need need,
                     JoxText *out) {
    const JoxName *names = jox_machine_of(run, i)->names;
    switch (need) {
    case NEED_PERSON:
        jox_text_add(out, "no person");
        break;
    case NEED_FALLEN:
        jox_text_add(out, "not lying after a fall");
        break;
    case NEED_STATE:
        jox_text_printf(out, "not in state %s", names[filter->state].text);
        break;
    case NEED_MACHINE:
        jox_text_printf(out, "not of machine %s", names[filter->machine].text);
        break;
    case NEED_GROUP:
        jox_text_add(out, "not of the group");
        break;
    case NEED_MEMORY:
        jox_text_printf(out, "without %s %s %.6g", names[filter->memory].text,
                        filter->least == filter->greatest ? "=" : ">=", filter->least);
        if (!isinf(filter->greatest) && filter->least != filter->greatest)
            jox_text_printf(out, " and <= %.6g", filter->greatest);
        break;
    case NEED_FLIES:
        jox_text_add(out, "not in the air");
        break;
    case NEED_COMES:
        jox_text_printf(out, "not coming within %.4g m", (double)filter->comes);
        break;
    case NEED_WITHIN:
        jox_text_printf(out, "not within %.4g m", (double)filter->within);
        break;
    case NEED_AHEAD:
        jox_text_printf(out, "not within %.4g degrees of where it looks", (double)filter->ahead);
        break;
    case NEED_PERCEPTION:
        jox_text_printf(out, "beyond its perception of %.3g m",
                        (double)jox_param(run->agents, JOX_PARAM_perception, i));
        break;
    case NEED_NO_WALL:
        jox_text_add(out, "behind a wall");
        break;
    case NEED_NO_BODY:
        jox_text_add(out, "behind a body");
        break;
    case NEED_NEIGHBOUR:
        jox_text_printf(out, "not among the %u nearest people that it perceives (neighbours)",
                        (unsigned)jox_param(run->agents, JOX_PARAM_neighbours, i));
        break;
    case NEEDS:
        break;
    }
}

/* Appends a candidate, its distance, and what it lacks. */
static void add_candidate(const JoxMachineRun *run, uint32_t i, const JoxAgentFilter *filter,
                          const Candidate *c, JoxText *out) {
    jox_why_add_somebody(run, c->agent, c->object, out);
    jox_text_printf(out, ", %.3g m away", (double)jox_length(c->offset));
    for (Need need = 0; need < NEEDS; need++)
        if (c->lacks >> need & 1) {
            jox_text_add(out, ", ");
            add_lack(run, i, filter, need, out);
            if (need == NEED_MEMORY) {
                const JoxName *name = &jox_machine_of(run, i)->names[filter->memory];
                const double value = jox_public_memory(run, c->agent, name->number);
                jox_text_printf(out, isnan(value) ? " (it has none)" : " (%.6g)", value);
            }
        }
}

/* ---- all candidates ---- */

/* Returns how many needs a candidate lacks; more than all for one that can never meet one. */
static uint32_t count_lacks(const Candidate *c) {
    uint32_t count = c->lacks >> NEED_PERSON & 1 ? NEEDS : 0;
    for (uint32_t bits = c->lacks; bits; bits &= bits - 1)
        count++;
    return count;
}

static void count_candidate(const JoxMachineRun *run, uint32_t i, const JoxTarget *target,
                            Candidate one, Tally *tally) {
    one.lacks = find_lacks(run, i, &target->filter, &one, true);
    const uint32_t misses = count_lacks(&one), least = count_lacks(&tally->best);
    Need first = 0;
    while (first < NEEDS && !(one.lacks >> first & 1))
        first++;
    if (first < NEEDS)
        tally->lacking[first]++;
    else
        tally->passed++;
    if (tally->count++ == 0 || misses < least ||
        (misses == least && jox_length2(one.offset) < jox_length2(tally->best.offset)))
        tally->best = one;
}

/* Counts the agents, and if `all` the bodies, of the kind that a target chooses from. */
static Tally count_candidates(const JoxMachineRun *run, uint32_t i, const JoxTarget *target,
                              bool all) {
    Tally tally = {.best = {.agent = JOX_NO_INDEX, .object = -1}};
    const JoxAgents *a = run->agents;
    for (uint32_t j = 0; j < a->count; j++)
        if (j != i && jox_is_of_kind(a, target, i, j))
            count_candidate(
                run, i, target,
                (Candidate){.agent = j, .object = -1, .offset = jox_way_between(a, i, j)}, &tally);
    const bool bodies = all && target->kind == JOX_TARGET_NEAREST;
    for (uint32_t o = 0; bodies && run->objects && o < run->objects->count; o++) {
        const JoxObject *object = &run->objects->rows[o];
        const JoxV2 at = {object->position.x, object->position.y};
        if (object->live && (object->tags >> target->arg & 1))
            count_candidate(run, i, target,
                            (Candidate){.agent = JOX_NO_INDEX,
                                        .object = (int32_t)o,
                                        .offset = jox_sub(at, jox_why_position(run, i))},
                            &tally);
    }
    return tally;
}

/* Appends that a target has no candidates. */
static void say_no_candidates(const JoxMachineRun *run, uint32_t i, const JoxTarget *target,
                              JoxText *out) {
    /* The name of one with a score is "best(ball)". */
    const char *name = target->score ? strchr(target->name, '(') + 1 : target->name;
    const int length = (int)strcspn(name, ")");
    const bool teams = target->kind == JOX_TARGET_OPPONENT || target->kind == JOX_TARGET_TEAMMATE;
    if (teams && run->agents->team[i] == 0)
        jox_text_printf(out, "it has no %.*s, as it is in no team", length, name);
    else if (teams)
        jox_text_printf(out, "it has no %.*s in the world", length, name);
    else if (target->kind == JOX_TARGET_ANYONE)
        jox_text_add(out, "there is nobody else in the world");
    else
        jox_text_printf(out, "there is no %s%.*s in the world",
                        jox_is_of_kind(run->agents, target, i, i) ? "other " : "", length, name);
}

/* Appends how many candidates pass, and how many lack what: "none of 3 passes: 2 behind a wall". */
static void add_tally(const JoxMachineRun *run, uint32_t i, const JoxTarget *target,
                      const Tally *tally, JoxText *out) {
    const char *before = ": ";
    if (tally->passed == 0)
        jox_text_printf(out, "none of %u passes", tally->count);
    else
        jox_text_printf(out, "%u of %u pass%s", tally->passed, tally->count,
                        tally->passed == 1 ? "es" : "");
    for (Need need = 0; need < NEEDS; need++) {
        if (tally->lacking[need] == 0)
            continue;
        jox_text_printf(out, "%s%u ", before, tally->lacking[need]);
        add_lack(run, i, &target->filter, need, out);
        before = ", ";
    }
}

/* Appends what there is in place of a target that chooses and is not found. */
static void say_absent(const JoxMachineRun *run, uint32_t i, const JoxTarget *target,
                       JoxText *out) {
    const Tally tally = count_candidates(run, i, target, true);
    if (tally.count == 0) {
        say_no_candidates(run, i, target, out);
        return;
    }
    if (tally.passed && target->score) {
        jox_text_printf(out, "%u of %u pass, and none has a score that is a number", tally.passed,
                        tally.count);
        return;
    }
    if (tally.count > 1)
        add_tally(run, i, target, &tally, out);
    jox_text_add(out, tally.count > 1 ? "; the nearest to passing is " : "the only one is ");
    Candidate best = tally.best;
    for (Need need = 0; tally.count > 1 && need < NEEDS; need++)
        if (tally.lacking[need] == tally.count && best.lacks == 1u << need && need != NEED_MEMORY)
            best.lacks = 0; /* was just said of all */
    add_candidate(run, i, &target->filter, &best, out);
}

/* ---- targets ---- */

/* Appends why a target that names somebody means nobody. */
static void say_nobody(const JoxMachineRun *run, uint32_t i, const JoxTarget *target,
                       JoxText *out) {
    const JoxAgents *a = run->agents;
    const double held = target->kind == JOX_TARGET_MEMORY
                            ? a->memory[(size_t)i * a->memory_stride + (uint32_t)target->arg]
                            : JOX_NOBODY;
    const JoxName *names = jox_machine_of(run, i)->names;
    if (held >= JOX_WHO_BODY)
        jox_text_printf(out, "%s is nobody: body %.0f is no longer in the world", target->name,
                        held - JOX_WHO_BODY);
    else if (held != JOX_NOBODY)
        jox_text_printf(out, "%s is nobody: agent %.0f has left the world", target->name,
                        held - 1.0);
    else if (target->kind == JOX_TARGET_MESSAGE &&
             !jox_message_find(run, i, names[target->arg].number))
        jox_text_printf(out, "no message '%s' waits", names[target->arg].text);
    else if (target->kind == JOX_TARGET_HOLDING)
        jox_text_add(out, "it holds nothing");
    else if (target->kind == JOX_TARGET_STRIKER)
        jox_text_add(out, "nothing hit it in the last step");
    else
        jox_text_printf(out, "%s is nobody", target->name);
}

/* Appends what there is of somebody whom a target names, and does not find. */
static void say_named(const JoxMachineRun *run, uint32_t i, const JoxTarget *target, JoxText *out) {
    const JoxSpot spot = jox_who_spot(run, i, jox_target_named_who(run, target, i));
    if (!spot.found) {
        say_nobody(run, i, target, out);
        return;
    }
    jox_text_printf(out, "%s is ", target->name);
    if (spot.place >= 0) {
        jox_text_printf(out, "place '%s'", run->places[spot.place].name);
        return;
    }
    Candidate one = {.agent = spot.agent,
                     .object = spot.object,
                     .offset = jox_sub(jox_v2(spot.x, spot.y), jox_why_position(run, i))};
    one.lacks = find_lacks(run, i, &target->filter, &one, false);
    if (target->kind == JOX_TARGET_HOLDING) /* known unseen */
        one.lacks &= (1u << NEED_PERCEPTION) - 1;
    add_candidate(run, i, &target->filter, &one, out);
}

/* Appends that somebody whom memory holds has never been seen, and where that is. */
static void say_never_seen(const JoxMachineRun *run, uint32_t i, const JoxTarget *target,
                           JoxText *out) {
    const JoxMachine *machine = jox_machine_of(run, i);
    const int32_t slot = machine->sightings[target->arg].memory;
    char name[100];
    snprintf(name, sizeof name, "mine.%.90s", machine->memory[slot].name);
    const JoxTarget held = {.kind = JOX_TARGET_MEMORY,
                            .arg = slot,
                            .name = name,
                            .filter = {.state = -1, .machine = -1, .memory = -1, .group = -1}};
    jox_text_printf(out, "it has not seen %s; ", name);
    say_named(run, i, &held, out);
}

/* Appends what there is in place of a target that is not found. */
static void say_unfound(const JoxMachineRun *run, uint32_t i, const JoxTarget *target,
                        JoxText *out) {
    if (jox_target_kind_chooses(target->kind))
        say_absent(run, i, target, out);
    else if (target->kind == JOX_TARGET_LAST_SEEN)
        say_never_seen(run, i, target, out);
    else if (jox_target_kind_moves(target->kind))
        say_named(run, i, target, out);
    else
        jox_text_printf(out, "%s is no place yet", target->name);
}

/* Appends of how many the target is the best, and its score. */
static void say_score(const JoxMachineRun *run, uint32_t i, const JoxTarget *target,
                      const JoxSpot *best, JoxText *out) {
    static _Thread_local JoxRegisters values;
    const uint32_t passed = count_candidates(run, i, target, true).passed;
    jox_eval_scores(run, i, &jox_machine_of(run, i)->expressions[target->score - 1], best, 1,
                    values);
    if (passed > 1)
        jox_text_printf(out, ", the best of %u, with score %.4g", passed, values[0][0]);
    else
        jox_text_printf(out, ", the only one, with score %.4g", values[0][0]);
}

bool jox_why_add_target(const JoxMachineRun *run, uint32_t i, int32_t index, JoxText *out) {
    const JoxTarget *target = index < 0 ? NULL : &jox_machine_of(run, i)->targets[index];
    const JoxSpot spot = jox_target_find(run, i, index);
    if (!target)
        return true;
    if (spot.found && spot.place >= 0) {
        const char *name = run->places[spot.place].name;
        if (target->kind != JOX_TARGET_PLACE && name)
            jox_text_printf(out, "it is %s", name);
    } else if (spot.found && (spot.agent != JOX_NO_INDEX || spot.object >= 0)) {
        const Candidate found = {.agent = spot.agent,
                                 .object = spot.object,
                                 .offset =
                                     jox_sub(jox_v2(spot.x, spot.y), jox_why_position(run, i))};
        add_candidate(run, i, &target->filter, &found, out);
        if (target->score)
            say_score(run, i, target, &spot, out);
    } else if (!spot.found) {
        say_unfound(run, i, target, out);
    }
    return spot.found;
}

void jox_why_add_identity(const JoxMachineRun *run, uint32_t i, int32_t index, JoxText *out) {
    if (index < 0)
        return;
    const JoxMachine *machine = jox_machine_of(run, i);
    const JoxTarget *target = &machine->targets[index];
    const double who = jox_target_who(run, i, index);
    jox_text_add(out, out->length ? "; " : "");
    if (who == JOX_NOBODY) {
        say_unfound(run, i, target, out);
        return;
    }
    jox_spell_target(machine, target, out);
    jox_text_add(out, " is ");
    if (jox_target_kind_chooses(target->kind))
        jox_why_add_target(run, i, index, out);
    else
        jox_who_print(run, who, out);
}

void jox_why_add_count(const JoxMachineRun *run, uint32_t i, int32_t index, JoxText *out) {
    const JoxTarget *target = &jox_machine_of(run, i)->targets[index];
    const Tally tally = count_candidates(run, i, target, false);
    if (tally.count == 0)
        say_no_candidates(run, i, target, out);
    else
        add_tally(run, i, target, &tally, out);
}
