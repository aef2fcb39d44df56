/* Writes for people why agents stay in their states. */
#include <string.h>

#include "base/format/plurals.h"
#include "geom/storey_text.h"
#include "run/why/why.h"

enum { WORD_WIDTH = 34 }; /* columns of a term; longer ones get a line of their own */

static void pad_line(size_t begun, size_t width, JoxText *out) {
    while (out->length - begun < width)
        jox_text_add(out, " ");
}

/* Appends what is known of a word besides whether it holds; "" if nothing. */
static void add_details(const JoxWhyTerm *term, JoxText *out) {
    if (term->measured)
        jox_why_add_measure(term, out);
    if (term->note.length && !(term->is_infix && term->holds))
        jox_text_printf(out, "%s%s", term->measured ? "; " : "", term->note.data);
}

/* Appends one word: "  no  near(ball, 3)      7.3 m, needs < 3 m". */
static void add_word_line(const char *mark, const JoxWhyTerm *term, int indent, JoxText *out) {
    JoxText details = {0};
    const size_t begun = out->length;
    jox_text_printf(out, "%*s%s  %s", indent, "", mark, term->text.data);
    add_details(term, &details);
    if (details.length) {
        const size_t width = (size_t)indent + strlen(mark) + 2 + WORD_WIDTH;
        if (out->length - begun >= width) {
            jox_text_add(out, "\n");
            pad_line(out->length, (size_t)indent + strlen(mark) + 6, out);
        } else {
            pad_line(begun, width, out);
        }
        jox_text_append(out, details.data, details.length);
    }
    jox_text_add(out, "\n");
    jox_text_free(&details);
}

/* Shared data of printing the tree of one agent or of many. */
typedef struct Printing {
    const JoxWhyTransition *t;
    const uint32_t *holders; /* per term, for many; NULL for one agent */
    uint32_t people;
    JoxText *out;
} Printing;

/* Returns whether a term is shown before another: fewer holders, or does not hold. */
static bool comes_first(const Printing *p, uint32_t a, uint32_t b) {
    if (p->holders && p->holders[a] != p->holders[b])
        return p->holders[a] < p->holders[b];
    const JoxWhyTerm *x = &p->t->terms[a], *y = &p->t->terms[b];
    return x->holds != y->holds && !x->holds;
}

static void print_term(const Printing *p, uint32_t index, int indent);

/* Prints the inputs of a term, those that do not hold first. */
static void print_inputs(const Printing *p, uint32_t index, int indent) {
    uint32_t sorted[256], count = 0;
    for (uint32_t k = p->t->terms[index].first; k != JOX_WHY_NONE && count < 256;
         k = p->t->terms[k].next) {
        uint32_t at = count++;
        for (; at > 0 && comes_first(p, k, sorted[at - 1]); at--)
            sorted[at] = sorted[at - 1];
        sorted[at] = k;
    }
    for (uint32_t n = 0; n < count; n++)
        print_term(p, sorted[n], indent);
}

static void write_mark(const Printing *p, uint32_t index, char mark[48]) {
    if (p->holders)
        snprintf(mark, 48, "%*u of %u", (int)snprintf(NULL, 0, "%u", p->people), p->holders[index],
                 p->people);
    else
        snprintf(mark, 48, "%s", p->t->terms[index].holds ? "yes" : "no ");
}

static void print_term(const Printing *p, uint32_t index, int indent) {
    const JoxWhyTerm *term = &p->t->terms[index];
    char mark[48];
    write_mark(p, index, mark);
    if (term->kind == JOX_WHY_WORD) {
        add_word_line(mark, term, indent, p->out);
        return;
    }
    jox_text_printf(p->out, "%*s%s  %s\n", indent, "", mark,
                    term->kind == JOX_WHY_ALL ? "all of" : "one of");
    print_inputs(p, index, indent + 4);
}

/* Prints the condition of a transition; of ALL at its root, the inputs alone. */
static void print_condition(const Printing *p) {
    enum { INDENT = 5 };
    const uint32_t root = p->t->root;
    if (root == JOX_WHY_NONE)
        return;
    if (p->t->terms[root].kind == JOX_WHY_ALL)
        print_inputs(p, root, INDENT);
    else
        print_term(p, root, INDENT);
}

/* `to`: the state to which it leads; NULL: that differs between agents. */
static void print_transition_head(const JoxMachine *machine, const JoxTransition *t,
                                  const JoxState *to, JoxText *out) {
    if (t->stays)
        jox_text_add(out, "  reaction  (");
    else if (t->back)
        jox_text_printf(out, to ? "  -> back, to %s  (" : "  -> back  (", to ? to->name : "");
    else
        jox_text_printf(out, "  -> %s  (", machine->states[t->to].name);
    jox_why_add_place(machine, t, out);
    jox_text_add(out, ")");
}

/* ---- one agent ---- */

static void print_transition(const JoScene *scene, const JoxWhyAgent *why, uint32_t index,
                             bool fires_first, JoxText *out) {
    const JoxWhyTransition *t = &why->transitions[index];
    const JoxTransition *written = &why->state->transitions[index];
    print_transition_head(why->machine, written, &why->machine->states[t->to], out);
    if (t->fires && written->stays)
        jox_text_add(out, ": holds, and is done in the next step");
    else if (t->fires)
        jox_text_add(out, fires_first ? ": holds, and is taken in the next step"
                                      : ": holds, but one before it is taken");
    else if (t->root != JOX_WHY_NONE && !t->holds)
        jox_text_printf(out,
                        t->gap.misses == 1 ? ": one term is missing" : ": %u terms are missing",
                        t->gap.misses);
    jox_text_add(out, "\n");
    if (t->is_function) {
        jox_text_printf(out, "     %s  a function: ", t->held_before ? "yes" : "no ");
        jox_why_add_function(scene, why->machine, written->when_hook, t->held_before, out);
        jox_text_add(out, "\n");
    } else if (t->root == JOX_WHY_NONE) {
        jox_text_add(out, "     yes  it has no condition\n");
    }
    print_condition(&(Printing){.t = t, .out = out});
    if (t->chance != JOX_WHY_CERTAIN) {
        jox_text_printf(out, "     %s  ", t->chance == JOX_WHY_LOST ? "no " : "?  ");
        jox_why_add_chance(scene, why, index, out);
        jox_text_add(out, "\n");
    }
}

typedef bool AddValue(const JoScene *scene, uint32_t agent, uint32_t slot, JoxText *out);

/* Appends a line of named values, "  memory: laps 3, touched false"; nothing if there are none. */
static void print_values(const JoScene *scene, const JoxWhyAgent *why, bool memory, JoxText *out) {
    const char *before = memory ? "  memory: " : "  own: ";
    const uint32_t count = memory ? why->machine->memory_count : why->machine->own_count;
    AddValue *add = memory ? jox_why_add_memory : jox_why_add_own;
    bool any = false;
    for (uint32_t s = 0; s < count; s++) {
        JoxText value = {0};
        if (add(scene, why->agent, s, &value))
            jox_text_printf(out, "%s%s %s", any ? ", " : before,
                            memory ? why->machine->memory[s].name : why->machine->own[s].name,
                            value.data);
        any |= value.length > 0;
        jox_text_free(&value);
    }
    if (any)
        jox_text_add(out, "\n");
}

/* Appends a line for each message that waits for the agent. */
static void print_messages(const JoScene *scene, const JoxWhyAgent *why, JoxText *out) {
    const JoxMachineRun *machines = &scene->world->machines;
    uint32_t count;
    const JoxMessage *first = jox_messages_of(machines, why->agent, &count);
    for (uint32_t m = 0; m < count; m++) {
        if (first[m].used)
            continue;
        jox_text_add(out, "  message: ");
        jox_why_add_message(machines, &first[m], out);
        jox_text_add(out, "\n");
    }
}

/* Appends lines on what a state does, each behind `before`. */
static void print_deeds(const JoxText *deeds, const char *before, JoxText *out) {
    const char *line = deeds->length ? deeds->data : "";
    for (; *line; line += strcspn(line, "\n") + 1)
        jox_text_printf(out, "%s%.*s\n", before, (int)strcspn(line, "\n"), line);
}

/* Returns the transition that an agent takes next, or the number of transitions. */
static uint32_t find_next_transition(const JoxWhyAgent *why) {
    uint32_t first = 0;
    while (first < why->state->transition_count &&
           (!why->transitions[first].fires || why->state->transitions[first].stays))
        first++;
    return first;
}

static void print_agent_head(const JoScene *scene, const JoxWhyAgent *why, JoxText *out) {
    const JoxAgents *a = &scene->world->state.agents;
    const uint32_t i = why->agent;
    jox_text_printf(out, "%.2f s: agent %u", why->now, a->id[i]);
    if (a->group[i] < scene->spec->group_count)
        jox_text_printf(out, " of group %s", scene->spec->groups[a->group[i]].name);
    jox_text_printf(out, " (machine %s) has been in state %s for %.2f s, since %.2f s\n",
                    why->machine->name, why->state->name, why->now - why->since, why->since);
    jox_text_add(out, "  at ");
    jox_text_position(out, &scene->spec->storeys, jox_v2(a->x[i], a->y[i]), 2);
    jox_text_printf(out, ", %.2f m/s\n", (double)jox_length((JoxV2){a->vx[i], a->vy[i]}));
}

/* Appends where the agent came from, and why, if it was watched then. */
static void print_last_transition(const JoScene *scene, const JoxWhyAgent *why, JoxText *out) {
    const JoxWatched *watched = why->watched;
    if (!watched || !watched->took)
        return;
    jox_text_printf(out, "  it came from %s at %.2f s", watched->from,
                    watched->tick * scene->world->model.def.dt);
    const char *when = watched->why.data ? strstr(watched->why.data, "    when ") : NULL;
    if (when)
        jox_text_printf(out, ", %.*s", (int)strcspn(when + 4, "\n"), when + 4);
    jox_text_add(out, "\n");
}

/* Appends how the agent comes to the state that is asked for. */
static void print_way(const JoxWhyAgent *why, JoxText *out) {
    if (!why->to)
        return;
    if (jox_state_is_in(why->state, why->to)) {
        jox_text_printf(out, "It is in %s already.\n", why->to);
        return;
    }
    if (why->way_count == 0) {
        jox_text_printf(out, "No transitions lead from %s to %s%s.\n", why->state->name, why->to,
                        jox_machine_entry(why->machine, why->to) < 0
                            ? ", which is a state of another behaviour"
                            : "");
        return;
    }
    if (why->way_count == 2) {
        jox_text_printf(out, "Of its transitions, those to %s:\n", why->to);
        return;
    }
    jox_text_printf(out, "The shortest way to %s is ", why->to);
    for (uint32_t n = 0; n < why->way_count; n++)
        jox_text_printf(out, "%s%s", n ? " -> " : "", why->machine->states[why->way[n]].name);
    jox_text_printf(out, "; its transitions to %s:\n", why->machine->states[why->way[1]].name);
}

void jox_why_agent_text(const JoScene *scene, const JoxWhyAgent *why, JoxText *out) {
    const uint32_t count = why->state->transition_count;
    print_agent_head(scene, why, out);
    print_last_transition(scene, why, out);
    print_values(scene, why, false, out);
    print_values(scene, why, true, out);
    print_messages(scene, why, out);
    print_deeds(&why->deeds, "  ", out);
    const uint32_t leading = jox_why_count_leading(why->state);
    const uint32_t first = find_next_transition(why);
    if (leading == 0)
        jox_text_printf(out, "State %s has no transitions: nothing leads out of it.\n",
                        why->state->name);
    else if (first < count)
        jox_text_printf(out, "It goes to %s in the next step:\n",
                        why->machine->states[why->transitions[first].to].name);
    else if (why->way_count < 2)
        jox_text_add(out, leading == 1 ? "It stays, as its transition does not fire:\n"
                                       : "It stays, as no transition fires; the nearest to firing "
                                         "comes first:\n");
    print_way(why, out);
    for (uint32_t k = 0; k < count; k++)
        if (jox_why_is_asked(why, why->order[k]))
            print_transition(scene, why, why->order[k], why->order[k] == first, out);
}

/* ---- many agents ---- */

static void print_crowd_transition(const JoScene *scene, const JoxWhyCrowd *crowd, uint32_t index,
                                   JoxText *out) {
    const struct JoxWhyCrowdTransition *t = &crowd->transitions[index];
    const JoxTransition *written = &crowd->state->transitions[index];
    const JoxAgents *a = &scene->world->state.agents;
    char people[JOX_NOUN];
    print_transition_head(crowd->machine, written, NULL, out);
    if (t->fires)
        jox_text_printf(out, ": holds for %s", jox_noun(people, t->fires, "agent"));
    else
        jox_text_printf(out, ": fires for nobody; the nearest is agent %u, with these values",
                        a->id[t->nearest]);
    jox_text_add(out, "\n");
    if (t->shown.is_function) {
        jox_text_printf(out, "     %u of %u  a function: for agent %u ", t->held, crowd->people,
                        a->id[t->nearest]);
        jox_why_add_function(scene, crowd->machine, written->when_hook, t->shown.held_before, out);
        jox_text_add(out, "\n");
    }
    print_condition(
        &(Printing){.t = &t->shown, .holders = t->holders, .people = crowd->people, .out = out});
    if (t->shown.chance != JOX_WHY_CERTAIN && t->held == 0)
        jox_text_printf(out, "     chance %.4g: drawn each time the condition becomes true\n",
                        t->shown.chance_value);
    else if (t->shown.chance != JOX_WHY_CERTAIN)
        jox_text_printf(out,
                        "     chance %.4g: %u of %u for whom the condition holds drew and lost; "
                        "they draw again only after it has been false\n",
                        t->shown.chance_value, t->lost, t->held);
}

/* Appends how many use each lift: "  lift east: 12 wait before it, agent 4 since 3.20 s". */
static void print_lifts(const JoScene *scene, const JoxWhyCrowd *crowd, JoxText *out) {
    const JoWorld *world = scene->world;
    char people[JOX_NOUN];
    for (uint32_t l = 0; l < world->model.lift_count; l++) {
        const struct JoxWhyCrowdLift *lift = &crowd->lifts[l];
        const char *join = ": ";
        if (!lift->approach && !lift->wait && !lift->ride)
            continue;
        jox_text_printf(out, "  lift %.60s", world->model.lifts[l].name);
        if (lift->wait) {
            jox_text_printf(out, ": %s before it, agent %u since %.2f s",
                            jox_noun(people, lift->wait, "waits|wait"),
                            world->state.agents.id[lift->first], lift->since);
            join = "; ";
        }
        if (lift->ride) {
            jox_text_printf(out, "%s%u in its car", join, lift->ride);
            join = "; ";
        }
        if (lift->approach)
            jox_text_printf(out, "%s%u on the way to it", join, lift->approach);
        jox_text_add(out, "\n");
    }
}

void jox_why_crowd_text(const JoScene *scene, const JoxWhyCrowd *crowd, const char *only_to,
                        JoxText *out) {
    const JoxAgents *a = &scene->world->state.agents;
    char people[JOX_NOUN];
    jox_text_printf(out, "%s in %s (machine %s)",
                    jox_noun(people, crowd->people, "person is|people are"), crowd->state->name,
                    crowd->machine->name);
    if (crowd->people == 1)
        jox_text_printf(out, ": agent %u, since %.2f s\n", a->id[crowd->longest], crowd->earliest);
    else if (crowd->earliest == crowd->latest)
        jox_text_printf(out, ", all since %.2f s\n", crowd->earliest);
    else
        jox_text_printf(out, ", since %.2f s (agent %u) to %.2f s\n", crowd->earliest,
                        a->id[crowd->longest], crowd->latest);
    print_lifts(scene, crowd, out);
    char before[40];
    snprintf(before, sizeof before, "  agent %u: ", a->id[crowd->longest]);
    print_deeds(&crowd->deeds, before, out);
    if (jox_why_count_leading(crowd->state) == 0)
        jox_text_printf(out, "  State %s has no transitions: nothing leads out of it.\n",
                        crowd->state->name);
    for (uint32_t k = 0; k < crowd->state->transition_count; k++) {
        const uint32_t index = crowd->order[k];
        const JoxTransition *t = &crowd->state->transitions[index];
        if (!only_to || jox_why_leads_to(crowd->machine, t, only_to))
            print_crowd_transition(scene, crowd, index, out);
    }
}
