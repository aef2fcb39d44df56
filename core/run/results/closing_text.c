/* Writes the results of a run as one paragraph, for readers of the last lines on a terminal. Each
   function below appends the sentences of one subject, or nothing. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/plurals.h"
#include "base/guard.h"
#include "base/mem.h"
#include "geom/storey_text.h"
#include "jostle_tools.h"
#include "record/danger/trust.h"
#include "run/criteria_listener.h"
#include "run/figure_listeners.h"
#include "run/game_round.h"
#include "run/probe_listener.h"
#include "run/results/demand.h"
#include "run/results/idle_input.h"
#include "run/results/kept_people.h"
#include "run/results/lift_figures.h"
#include "run/results/lost_steering.h"
#include "run/results/unleft_states.h"
#include "run/run.h"
#include "run/standstill.h"
#include "run/tally_scores.h"

static const double SHORTEST_STAND = 10.0; /* s: shorter ones of one person are left out */

/* Appends how many people there were, how many left by each exit, and how many are inside. */
static void say_people(const JoScene *scene, JoxText *out) {
    const JoxExits *exits = &scene->world->state.exits;
    const uint32_t inside = scene->world->state.agents.count;
    jox_text_noun(out, scene->world->state.agents.next_id, "person|people");
    jox_text_add(out, " in all; ");
    if (exits->left == 0) {
        jox_text_add(out, "nobody left");
    } else {
        char number[JOX_NOUN];
        jox_text_printf(out, "%s left", jox_number_text(number, exits->left));
        for (uint32_t e = 0; e < exits->count; e++)
            jox_text_printf(out, "%s%.60s %s", e ? ", " : " (", exits->items[e].name,
                            jox_number_text(number, exits->items[e].people));
        jox_text_printf(out, "%s, the last at %.1f s", exits->count ? ")" : "", exits->last);
    }
    jox_text_add(out, inside ? ", and " : ", and nobody is inside.");
    if (inside)
        jox_text_noun(out, inside, "person is inside|people are inside");
}

/* Appends how many people of a machine are inside by state, those within an outer state in brackets
   behind it: "Guard 16 (Look 6, Walk 10), Rest 4". `before` is what comes first, and returned is
   what comes before the next state. */
static const char *say_machine_states(const JoScene *scene, uint32_t m, const char *before,
                                      JoxText *out) {
    const JoxMachineRun *machines = &scene->world->machines;
    const JoxMachine *machine = machines->set->items[m];
    uint32_t *people = jox_alloc((size_t)machine->state_count + 1, sizeof *people);
    uint16_t open[JOX_MOST_LEVELS];
    uint32_t levels = 0;
    char number[JOX_NOUN];
    jox_machines_people(machines, m, people);
    for (uint32_t s = 0; s < machine->state_count; s++) {
        const JoxState *state = &machine->states[s];
        uint32_t same = 0;
        if (people[s] == 0)
            continue;
        while (same < levels && same < state->depth && open[same] == state->around[same])
            same++;
        for (; levels > same; levels--)
            jox_text_add(out, ")");
        for (; levels <= state->depth; levels++) {
            const JoxState *on = jox_state_on_level(machine, state, levels);
            const bool outer = levels < state->depth;
            const char *dot = levels > 0 ? strrchr(on->name, '.') : NULL;
            jox_text_add(out, before);
            if (levels == 0 && machines->set->count > 1)
                jox_text_printf(out, "%.60s ", machine->name);
            jox_text_printf(
                out, "%.60s %s%s", dot ? dot + 1 : on->name,
                jox_number_text(number,
                                outer ? jox_people_within(machine, state->around[levels], people)
                                      : people[s]),
                outer ? " (" : "");
            before = outer ? "" : ", ";
            if (outer)
                open[levels] = state->around[levels];
        }
        levels = state->depth;
    }
    for (; levels > 0; levels--)
        jox_text_add(out, ")");
    jox_free(people);
    return before;
}

/* Appends how many people are inside, by machine and state. */
static void say_states(const JoScene *scene, JoxText *out) {
    const char *before = ": ";
    if (scene->world->state.agents.count == 0)
        return;
    for (uint32_t m = 0; m < scene->world->machines.set->count; m++)
        before = say_machine_states(scene, m, before, out);
    jox_text_add(out, ".");
}

/* Appends the counts of events that are not zero. */
static void say_events(const JoScene *scene, JoxText *out) {
    const JoxStatistics *s = &scene->world->state.statistics;
    const struct {
        uint64_t count;
        const char *noun;
    } events[] = {
        {s->hits, "hit by a body|hits by bodies"},
        {s->kicks, "kick"},
        {s->throws, "throw"},
        {s->falls, "fall|falls"},
        {s->most_fallen, "person who lay at the same time|people who lay at the same time"},
        {s->dropped, "body dropped for want of room|bodies dropped for want of room"},
        {s->people_lost, "person lost|people lost"},
        {s->bodies_lost, "body lost|bodies lost"},
        {s->parts_left_out,
         "agent-step in which not all parts of bodies near by were avoided|agent-steps in which "
         "not all parts of bodies near by were avoided"},
        {s->not_placed, "person not placed|people not placed"},
        {s->most_without_spot,
         "person at a time without room in the place where they waited|people at a time without "
         "room in the place where they waited"},
        {s->most_without_way,
         "person at a time whom no way led to their target|people at a time whom no way led to "
         "their target"},
        {s->moved_out,
         "person moved out of the way of a wall|people moved out of the way of a wall"},
        {s->not_moved_out, "person left in the way of a wall|people left in the way of a wall"},
        {scene->world->machines.state->hook_failures,
         "failed call of a function of a behaviour|failed calls of functions of "
         "behaviours"},
        {scene->world->machines.state->changes_lost,
         "lost change of another's memory|lost changes of others' memory"},
        {scene->world->machines.state->messages_lost,
         "message dropped because too many waited|messages dropped because too many waited"},
        {scene->world->machines.state->messages_unasked,
         "message that its receiver's machine never asks for|messages that their receivers' "
         "machines "
         "never ask for"},
        {scene->world->machines.state->messages_to_nobody, "message to nobody|messages to nobody"}};
    bool any = false;
    for (size_t e = 0; e < sizeof events / sizeof *events; e++) {
        if (events[e].count == 0)
            continue;
        jox_text_add(out, any ? ", " : events[e].count == 1 ? " There was " : " There were ");
        jox_text_noun(out, events[e].count, events[e].noun);
        any = true;
    }
    if (any)
        jox_text_add(out, ".");
}

/* Appends in how many agent-steps no velocity was permitted, and the rules acted that no equation
   of the paper prints. */
static void say_plans(const JoScene *scene, JoxText *out) {
    const JoxStatistics *s = &scene->world->state.statistics;
    if (s->failures + s->turned_aside + s->plans_bounded == 0)
        return;
    jox_text_printf(out,
                    " Of all agent-steps %.3g %% had no permitted velocity, %.3g %% were turned "
                    "aside, and the plans of %.3g %% were bounded.",
                    100.0 * jox_statistics_share(s, s->failures),
                    100.0 * jox_statistics_share(s, s->turned_aside),
                    100.0 * jox_statistics_share(s, s->plans_bounded));
}

/* Appends how often driven bodies met their force limits, and how many people are inside them. */
static void say_drives(const JoScene *scene, JoxText *out) {
    const JoxDriveStatistics *d = &scene->world->state.statistics.drives;
    if (d->held_up > 0 || d->inside > 0) {
        const JoxBodies *bodies = scene->world->state.bodies;
        const uint32_t row = jox_bodies_find(bodies, d->body);
        const char *name = row == JOX_NO_BODY ? "" : jox_bodies_name(bodies, row);
        jox_text_add(out, " Driven bodies met their force limits ");
        jox_text_noun(out, d->held_up, "time|times");
        jox_text_printf(out, "; body %u%s%.60s pressed hardest, ", d->body, *name ? ", " : "",
                        name);
        jox_text_noun(out, d->people, "person|people");
        jox_text_printf(out, " with %.0f N at %.1f s, one with %.0f N of it.", d->force, d->at_s,
                        d->hardest);
    }
    if (d->inside > 0) {
        jox_text_add(out, " Up to ");
        jox_text_noun(out, d->inside, "person was|people were");
        jox_text_add(out, " inside driven bodies at a time.");
    }
}

/* Appends the largest crowd that stood still, and the agent that stood longest. */
static void say_standing(const JoScene *scene, JoxText *out) {
    const JoxSceneSpec *spec = scene->spec;
    const JoxLongestStand *stood = jox_run_longest_stand(scene);
    const JoxStandstill *still = jox_run_longest_standstill(scene);
    if (still) {
        jox_text_printf(out, " A crowd of ");
        jox_text_noun(out, still->people, "person|people");
        jox_text_printf(out, " stood still from %.0f to %.0f s, about ", still->since,
                        still->until);
        jox_text_position(out, &spec->storeys, still->at, 1);
        jox_place_where(spec->places, spec->place_count, still->at, true, out);
        jox_text_add(out, ".");
    }
    if (stood && stood->id != JOX_NO_INDEX && stood->seconds >= SHORTEST_STAND) {
        jox_text_printf(out,
                        " Agent %u stood longest though it wanted to get on: for %.0f s until "
                        "%.0f s, at ",
                        stood->id, stood->seconds, stood->until);
        jox_text_position(out, &spec->storeys, stood->at, 1);
        jox_place_where(spec->places, spec->place_count, stood->at, true, out);
        jox_text_add(out, ".");
    }
}

/* Appends a warning if people overlapped, or stood denser, than real people can. */
static void say_trust(const JoScene *scene, JoxText *out) {
    const JoxStatistics *s = &scene->world->state.statistics;
    const double overlap = jox_statistics_overlap_p99(s);
    const double density = jox_run_greatest_density(scene);
    if (jox_trust_holds(overlap, density))
        return;
    jox_text_add(out, " ");
    jox_trust_append_signs(overlap, jox_statistics_depth_p99(s), density, out);
}

/* Appends the flow probes whose line was crossed only against the direction that it counts: their
   ends were given in the wrong order. */
static void say_probes(const JoScene *scene, JoxText *out) {
    const JoxProbe *probe;
    for (uint32_t n = 0; (probe = jox_run_probe(scene, n)); n++) {
        const uint32_t against = jox_probe_against(probe);
        if (against == 0)
            continue;
        jox_text_printf(out, " The line of probe %.100s was crossed ", jox_probe_def(probe)->name);
        jox_text_noun(out, against, "time|times");
        jox_text_add(out, ", always against the direction that it counts: give its points in the "
                          "other order.");
    }
}

char *jo_scene_closing(const JoScene *scene) {
    JOX_REQUIRE(scene, NULL);
    JOX_GUARD (NULL, NULL)
        return NULL;
    JoxText text = {0};
    jox_text_printf(&text,
                    "%.200s, %.1f s: ", scene->spec->title ? scene->spec->title : scene->spec->path,
                    jo_world_time(scene->world));
    say_people(scene, &text);
    say_states(scene, &text);
    jox_run_say_demand(scene, &text);
    jox_run_say_criteria(scene, &text);
    jox_run_say_starts(scene, &text);
    jox_run_say_births(scene, &text);
    jox_run_say_kept(scene, &text);
    say_events(scene, &text);
    say_drives(scene, &text);
    jox_run_say_lifts(scene, &text);
    jox_run_say_tally(scene, &text);
    jox_run_say_game(scene, &text);
    say_standing(scene, &text);
    jox_run_say_unleft(scene, &text);
    jox_run_say_lost(scene, &text);
    say_probes(scene, &text);
    jox_run_say_idle_input(scene, &text);
    say_plans(scene, &text);
    say_trust(scene, &text);
    if (scene->warnings) {
        jox_text_add(&text, " ");
        jox_text_noun(&text, scene->warnings, "warning was given|warnings were given");
        jox_text_add(&text, ".");
    }
    jox_text_clean(text.data);
    return jox_disown(text.data);
}
