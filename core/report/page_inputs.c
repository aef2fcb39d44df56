/* The section on inputs of a run's page: who, how many, with what values as given and as drawn;
   where they come in and leave; walls, gates and events. page_model.c writes the model. */
#include <math.h>
#include <string.h>

#include "base/format/plurals.h"
#include "base/mem.h"
#include "geom/lifts.h"
#include "geom/storey_text.h"
#include "picture/html.h"
#include "record/danger/danger_parts.h"
#include "report/drawn_values.h"
#include "report/page_inputs.h"
#include "report/page_parts.h"
#include "run/results/demand.h"
#include "run/run.h"

enum { MOST_ROWS = 20 }; /* rows of events and openings on the page; the files have all */

/* ---- people ---- */

/* Appends the names of places, "in hall, room". */
static void say_places(const JoxSceneSpec *spec, const uint32_t *places, uint32_t count,
                       const char *lead, JoxText *out) {
    for (uint32_t p = 0; p < count; p++)
        jox_text_printf(out, "%s%s", p ? ", " : lead, spec->places[places[p]].name);
}

/* Appends how the people of a group are placed. */
static void say_placement(const JoxSceneSpec *spec, const JoxGroup *group, JoxText *out) {
    say_places(spec, group->in, group->in_count, "in ", out);
    say_places(spec, group->outside, group->outside_count, out->length ? "; not in " : "not in ",
               out);
    if (group->start_count)
        jox_text_printf(out, "%sas recorded, until %.6g s", out->length ? "; " : "",
                        group->starts[group->start_count - 1].time);
    if (!out->length)
        jox_text_add(out, group->count ? "at given points" : "from sources");
}

/* Appends the behaviours of a group with their shares, and where it wants to go. */
static void say_behaviour(const JoxSceneSpec *spec, const JoxGroup *group, JoxText *out) {
    for (uint32_t m = 0; m < group->mix_count; m++) {
        const JoxGroupMix *mix = &group->mix[m];
        jox_text_printf(out, "%s%s", out->length ? ", " : "",
                        mix->text ? "a journey" : jox_path_name(mix->behaviour));
        if (group->mix_count > 1)
            jox_text_printf(out, " %.3g %%", 100.0 * mix->weight);
    }
    for (uint32_t v = 0; v < group->set_count; v++)
        if (group->set[v].kind == JOX_SET_PLACE && group->set[v].place >= 0)
            jox_text_printf(out, "; %s: %s", group->set[v].name,
                            spec->places[group->set[v].place].name);
}

/* Appends the kinds of people in a group with their shares. */
static void say_profiles(const JoxGroup *group, JoxText *out) {
    double sum = 0.0;
    for (uint32_t p = 0; p < group->profile_count; p++)
        sum += group->profiles[p].share;
    for (uint32_t p = 0; p < group->profile_count; p++)
        jox_text_printf(out, "%s%s %.3g %%", p ? ", " : "", group->profiles[p].name,
                        100.0 * group->profiles[p].share / sum);
    if (group->party > 1)
        jox_text_printf(out, "%sin parties of %u", out->length ? "; " : "", group->party);
}

static uint32_t count_drawn_people(const JoxDrawnValues *drawn, uint32_t group) {
    for (uint32_t k = 0; k < drawn->count; k++)
        if (drawn->items[k].group == group)
            return drawn->items[k].people;
    return 0;
}

static void put_group_table(FILE *out, const JoScene *scene, const JoxSubject *s,
                            const JoxDrawnValues *drawn) {
    const JoxSceneSpec *spec = scene->spec;
    JoxPageTable table = jox_page_table(
        s, "groups",
        "group|>people at the start|>people in all|placed|behaviour|kinds of people|basis");
    for (uint32_t g = 0; g < spec->group_count; g++) {
        const JoxGroup *group = &spec->groups[g];
        JoxText placed = {0}, behaviour = {0}, kinds = {0};
        say_placement(spec, group, &placed);
        say_behaviour(spec, group, &behaviour);
        say_profiles(group, &kinds);
        jox_table_text(&table, group->name);
        jox_table_number(&table, group->count);
        jox_table_number(&table, count_drawn_people(drawn, g));
        jox_table_text(&table, placed.data);
        jox_table_text(&table, behaviour.data);
        jox_table_text(&table, kinds.data);
        jox_table_text(&table, group->basis);
        jox_text_free(&placed);
        jox_text_free(&behaviour);
        jox_text_free(&kinds);
    }
    jox_table_put(out, &table);
}

/* Appends the distribution that a list of values gives a name; returns whether it does. */
static bool say_given(const JoxGroupValue *set, uint32_t count, const char *name, JoxText *out) {
    for (uint32_t v = 0; v < count; v++)
        if (set[v].kind == JOX_SET_NUMBER && strcmp(set[v].name, name) == 0) {
            jox_dist_print(&set[v].dist, out);
            return true;
        }
    return false;
}

/* Appends where a quantity of a group is given, and how: by the scene, by its behaviour, or by
   default. */
static void say_quantity_source(const JoScene *scene, const JoxGroup *group, const char *name,
                                JoxText *out) {
    const JoxMachineSet *machines = &scene->world->model.machines;
    const int parameter = jox_parameter_find(name);
    if (say_given(group->set, group->set_count, name, out)) {
        jox_text_add(out, " (scene)");
        for (uint32_t p = 0; p < group->profile_count; p++) {
            JoxText own = {0};
            if (say_given(group->profiles[p].set, group->profiles[p].set_count, name, &own))
                jox_text_printf(out, "; %s %s", group->profiles[p].name, own.data);
            jox_text_free(&own);
        }
        return;
    }
    for (uint32_t p = 0; p < group->profile_count; p++) {
        JoxText own = {0};
        if (say_given(group->profiles[p].set, group->profiles[p].set_count, name, &own))
            jox_text_printf(out, "%s%s %s", out->length ? "; " : "", group->profiles[p].name,
                            own.data);
        jox_text_free(&own);
    }
    for (uint32_t m = 0; !out->length && m < group->mix_count; m++) {
        const JoxMachine *machine = machines->items[group->mix[m].machine];
        for (uint32_t o = 0; o < machine->own_count; o++)
            if (strcmp(machine->own[o].name, name) == 0 && !machine->own[o].general) {
                jox_dist_print(&machine->own[o].dist, out);
                jox_text_add(out, " (behaviour)");
                break;
            }
    }
    if (!out->length && parameter >= 0)
        jox_text_add(out, "behaviour, or default");
    else if (!out->length)
        jox_text_add(out, "by the radius");
}

/* Returns whether a value is the same for all people of its group, and that of the parameter by
   default. */
static bool is_default(const JoxDrawnValue *value) {
    const int parameter = jox_parameter_find(value->name);
    return parameter >= 0 && value->least == value->greatest &&
           fabs(value->mean - jox_parameters[parameter].value) <=
               1e-6 * fabs(jox_parameters[parameter].value);
}

/* Returns whether two groups have one value of a quantity for everybody, so that one row tells
   both. */
static bool is_one_constant(const JoxDrawnValue *a, const JoxDrawnValue *b) {
    return strcmp(a->name, b->name) == 0 && a->least == a->greatest && b->least == b->greatest &&
           a->mean == b->mean;
}

/* Appends a default: "horizon 0.5 s". */
static void add_default_text(const JoxDrawnValue *value, JoxText *out) {
    const char *unit = jox_html_unit(jox_parameters[jox_parameter_find(value->name)].unit);
    jox_text_printf(out, "%s%s %.4g%s%s", out->length ? ", " : "", value->name, value->mean,
                    *unit ? " " : "", unit);
}

/* Adds the row of a quantity of some groups; `people` is their number. */
static void add_value_row(JoxPageTable *table, const JoScene *scene, const JoxDrawnValue *value,
                          const char *groups, double people) {
    const int parameter = jox_parameter_find(value->name);
    JoxText given = {0};
    say_quantity_source(scene, &scene->spec->groups[value->group], value->name, &given);
    jox_table_text(table, value->name);
    jox_table_text(table, groups);
    jox_table_text(table, given.data);
    jox_table_number(table, people);
    jox_table_number(table, value->mean);
    jox_table_number(table, jox_drawn_deviation(value));
    jox_table_number(table, value->least);
    jox_table_number(table, value->greatest);
    jox_table_unit(table, parameter >= 0                          ? jox_parameters[parameter].unit
                          : strncmp(value->name, "torso", 5) == 0 ? "m"
                                                                  : "");
    jox_text_free(&given);
}

/* Adds the rows of the quantity that value k is the first of: a row for each group, but one for all
   groups with the same constant. `told` marks what rows have told. */
static void add_quantity(JoxPageTable *table, const JoScene *scene, const JoxDrawnValues *drawn,
                         uint32_t k, uint8_t *told) {
    for (uint32_t j = k; j < drawn->count; j++) {
        const JoxDrawnValue *value = &drawn->items[j];
        JoxText groups = {0};
        double people = 0.0;
        uint32_t count = 0;
        if (told[j] || strcmp(value->name, drawn->items[k].name) != 0)
            continue;
        for (uint32_t o = j; o < drawn->count; o++) {
            const JoxDrawnValue *other = &drawn->items[o];
            if (o != j && (told[o] || !is_one_constant(value, other)))
                continue;
            told[o] = 1;
            count++;
            people += other->people;
            jox_text_printf(&groups, "%s%s", groups.length ? ", " : "",
                            scene->spec->groups[other->group].name);
        }
        add_value_row(table, scene, value,
                      count > 1 && count == scene->spec->group_count ? "all groups" : groups.data,
                      people);
        jox_text_free(&groups);
    }
}

/* Writes the values of people as given and as drawn; parameters that all people have by default are
   named in a sentence. */
static void put_value_table(FILE *out, const JoScene *scene, const JoxSubject *s,
                            const JoxDrawnValues *drawn) {
    JoxPageTable table = jox_page_table(
        s, "values",
        "quantity|group|as given|>people|>mean as drawn|>standard deviation|>least|>greatest|unit");
    uint8_t *told = jox_alloc(drawn->count + 1, 1);
    JoxText defaults = {0};
    for (uint32_t k = 0; k < drawn->count; k++) { /* values with a default, or always 0 */
        const JoxDrawnValue *value = &drawn->items[k];
        bool plain = value->group >= scene->spec->group_count; /* of an edited scene */
        bool all = !jox_drawn_is_shown(value->name);
        for (uint32_t j = 0; j < drawn->count; j++)
            if (strcmp(drawn->items[j].name, value->name) == 0)
                all &= is_default(&drawn->items[j]);
        for (uint32_t j = 0; all && j < k; j++)
            plain |= strcmp(drawn->items[j].name, value->name) == 0;
        if (all && !plain)
            add_default_text(value, &defaults);
        told[k] = all || plain;
    }
    for (uint32_t k = 0; k < drawn->count; k++)
        if (!told[k])
            add_quantity(&table, scene, drawn, k, told);
    if (table.count)
        jox_html_paragraph(
            out, "Values of people, in the step in which they were made: as the scene or their "
                 "behaviour gives them, and as they were drawn in this run. A speed is that of the "
                 "first state; names that are no parameter, as a pre-movement time, are own values "
                 "of the behaviour, in its units.");
    jox_table_put(out, &table);
    if (defaults.length)
        jox_html_statement(out, "By default, for everybody:", defaults.data);
    jox_text_free(&defaults);
    jox_free(told);
}

/* ---- places and events ---- */

static void say_source_law(const JoxAgentSource *source, JoxText *out) {
    if (source->rate > 0.0)
        jox_text_printf(out, "%.4g per s%s", source->rate, source->even ? ", evenly" : ", Poisson");
    if (source->curve_count)
        jox_text_printf(out, "%sby a curve of %u points", out->length ? "; " : "",
                        source->curve_count);
    if (source->every > 0.0)
        jox_text_printf(out, "%s%u each %.4g s", out->length ? "; " : "", source->people,
                        source->every);
    if (source->time_count)
        jox_text_printf(out, "%s%u at each of %u times", out->length ? "; " : "", source->people,
                        source->time_count);
    if (source->keep)
        jox_text_printf(out, "%skept at %u", out->length ? "; " : "", source->keep);
}

static void put_source_table(FILE *out, const JoScene *scene, const JoxSubject *s) {
    const JoxSceneSpec *spec = scene->spec;
    JoxPageTable table = jox_page_table(
        s, "sources",
        "people come in at|group|as given|>from [s]|>until [s]|>due|>arrived|>waiting at the end|>"
        "did not arrive before it ended");
    for (uint32_t k = 0; k < spec->source_count; k++) {
        const JoxAgentSource *source = &spec->sources[k];
        const JoxDemand demand = jox_run_demand(scene, k);
        JoxText law = {0};
        say_source_law(source, &law);
        jox_table_text(&table, spec->places[source->place].name);
        jox_table_text(&table, spec->groups[source->like].name);
        jox_table_text(&table, law.data);
        jox_table_number(&table, source->from);
        jox_table_number(&table, source->until < 1e9 ? source->until : NAN);
        jox_table_number(&table, demand.due);
        jox_table_number(&table, demand.entered);
        jox_table_number(&table, demand.waiting);
        jox_table_number(&table, demand.did_not_come);
        jox_text_free(&law);
    }
    jox_table_put(out, &table);
}

/* Appends what an event does. */
static void say_event(const JoxSceneSpec *spec, const JoxEvent *event, JoxText *out) {
    static const char *const VERBS[] = {
        [JOX_EVENT_THROW] = "throws",   [JOX_EVENT_MOVE] = "moves",
        [JOX_EVENT_OPEN] = "opens",     [JOX_EVENT_CLOSE] = "closes",
        [JOX_EVENT_SIGNAL] = "signals", [JOX_EVENT_LIFT] = "sets the mode of lift",
        [JOX_EVENT_PUSH] = "pushes"};
    jox_text_printf(out, "%s %s", VERBS[event->kind],
                    event->name         ? event->name
                    : event->place >= 0 ? spec->places[event->place].name
                                        : "");
    if (event->kind == JOX_EVENT_LIFT)
        jox_text_printf(out, " to %s", jox_lift_mode_names[event->mode]);
    if (event->kind == JOX_EVENT_PUSH)
        jox_text_printf(out, " by (%.4g, %.4g) N for %.4g s", event->force[0], event->force[1],
                        event->lasts);
    if (event->kind == JOX_EVENT_THROW || event->kind == JOX_EVENT_MOVE)
        jox_text_printf(out, " at (%.4g, %.4g, %.4g) m/s", event->velocity[0], event->velocity[1],
                        event->velocity[2]);
}

static void put_event_table(FILE *out, const JoxSceneSpec *spec, const JoxSubject *s) {
    JoxPageTable table = jox_page_table(s, "events", ">at [s]|>repeated each [s]|event");
    for (uint32_t e = 0; e < spec->event_count; e++) {
        JoxText what = {0}, at = {0};
        say_event(spec, &spec->events[e], &what);
        jox_text_printf(&at, "%.6g", spec->events[e].at);
        jox_table_text(&table, at.data);
        jox_table_number(&table, spec->events[e].every > 0.0 ? spec->events[e].every : NAN);
        jox_table_text(&table, what.data);
        jox_text_free(&what);
        jox_text_free(&at);
    }
    table.most_rows = MOST_ROWS;
    jox_table_put(out, &table);
}

/* Adds a row on a door or a gate: its ends and its width. */
static void add_opening(JoxPageTable *table, const JoxStoreys *storeys, const char *name,
                        const char *what, const JoxV2 ends[2], double width) {
    char point[48];
    JoxText of = {0};
    jox_table_text(table, name);
    jox_text_add(&of, what);
    jox_text_storey(&of, storeys, jox_scale(jox_add(ends[0], ends[1]), 0.5f));
    jox_table_text(table, of.data);
    for (int k = 0; k < 2; k++) {
        const JoxV2 at = jox_in_plan(storeys, ends[k]);
        snprintf(point, sizeof point, "(%.2f, %.2f)", (double)at.x, (double)at.y);
        jox_table_text(table, point);
    }
    jox_table_number(table, width);
    jox_text_free(&of);
}

/* Writes the lines that people cross, with what walls leave of them, and the gates. */
static void put_opening_table(FILE *out, const JoxWalls *walls, const JoxSubject *s) {
    JoxPageTable table =
        jox_page_table(s, "openings", "door, line or gate|what it is|from [m]|to [m]|>width [m]");
    for (uint32_t l = 0; l < s->danger->lines.count; l++) {
        const JoxDangerLine *line = &s->danger->lines.items[l];
        add_opening(&table, s->storeys, line->name, "line: width that walls leave, at the end",
                    (JoxV2[]){line->a, line->b}, line->width);
    }
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        if (!ring->name)
            continue;
        const JoxV2 ends[] = {walls->vertices[ring->first].point,
                              walls->vertices[walls->vertices[ring->first].next].point};
        add_opening(&table, s->storeys, ring->name,
                    ring->is_lift_door ? "door of a lift"
                    : ring->open       ? "gate, open at first"
                                       : "gate, closed at first",
                    ends, (double)jox_length(jox_sub(ends[1], ends[0])));
    }
    table.most_rows = MOST_ROWS;
    jox_table_put(out, &table);
}

static bool has_gates(const JoxWalls *walls) {
    for (uint32_t r = 0; r < walls->ring_count; r++)
        if (walls->rings[r].name)
            return true;
    return false;
}

void jox_page_put_inputs(FILE *out, const JoScene *scene, const JoxSubject *s,
                         const JoxDrawnValues *drawn) {
    const JoxSceneSpec *spec = scene->spec;
    jox_html_heading(out, "Inputs");
    jox_page_put_model(out, scene);
    if (spec->group_count) {
        jox_html_subheading(out, "People");
        put_group_table(out, scene, s, drawn);
        put_value_table(out, scene, s, drawn);
    }
    if (spec->source_count) {
        jox_html_subheading(out, "Arrivals");
        put_source_table(out, scene, s);
    }
    if (s->danger->lines.count || has_gates(s->walls)) {
        jox_html_subheading(out, "Doors and gates");
        put_opening_table(out, s->walls, s);
    }
    if (spec->event_count) {
        jox_html_subheading(out, "Events");
        put_event_table(out, spec, s);
    }
}
