#include "machine/machine.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "machine/machine_parts.h"

const char *jox_machine_version(const JoxMachine *machine, char out[JOX_VERSION_TEXT]) {
    char version[40] = "", reload[20] = ""; /* both and the text between them fit into `out` */
    if (!isnan(machine->version))
        snprintf(version, sizeof version, "version %.15g", machine->version);
    if (machine->reloads > 0)
        snprintf(reload, sizeof reload, "reload %u", machine->reloads);
    if (*version && *reload)
        snprintf(out, JOX_VERSION_TEXT, "%s (%s)", version, reload);
    else
        snprintf(out, JOX_VERSION_TEXT, "%s",
                 *version  ? version
                 : *reload ? reload
                           : "the first version");
    return out;
}

int32_t jox_machine_memory(const JoxMachine *machine, const char *name) {
    for (uint32_t s = 0; *name && s < machine->memory_count; s++)
        if (strcmp(machine->memory[s].name, name) == 0)
            return (int32_t)s;
    return -1;
}

int32_t jox_machine_own_slot(const JoxMachine *machine, const char *name) {
    for (uint32_t s = 0; *name && s < machine->own_count; s++)
        if (strcmp(machine->own[s].name, name) == 0)
            return (int32_t)s;
    return -1;
}

void jox_machine_own_parameter(JoxMachine *machine, JoxParameter parameter) {
    const char *name = jox_parameters[parameter].name;
    JoxValue *value = &machine->defaults[parameter];
    int32_t slot = jox_machine_own_slot(machine, name);
    if (value->kind != JOX_VALUE_CONST)
        return;
    if (slot < 0) {
        slot = (int32_t)machine->own_count++;
        machine->own = jox_realloc(machine->own, machine->own_count, sizeof *machine->own);
        machine->own[slot] = (JoxOwnSlot){
            .name = jox_strdup(name), .dist = jox_dist_constant(value->number), .declared = true};
    }
    value->kind = JOX_VALUE_OWN;
    value->index = slot;
}

JoxState jox_state_blank(char *name) {
    return (JoxState){.name = name,
                      .lasts_expression = -1,
                      .push_when = -1,
                      .push_toward = -1,
                      .face = -1,
                      .approach = -1,
                      .stays_in = -1,
                      .kick = -1,
                      .kick_at = -1,
                      .take = -1,
                      .drop = -1,
                      .toss = -1,
                      .toss_at = -1,
                      .grasp = -1,
                      .enters = {.signal = -1},
                      .become_machine = -1,
                      .on_enter = -1,
                      .on_exit = -1};
}

JoxTransition jox_transition_blank(char *id) {
    return (JoxTransition){
        .id = id, .when = -1, .when_hook = -1, .rests = -1, .on_take = -1, .does = {.signal = -1}};
}

static void free_state(JoxState *state) {
    jox_free(state->name);
    jox_free(state->become);
    jox_free(state->become_file);
    jox_free(state->enters.set);
    jox_free(state->enters.tell);
    for (uint32_t t = 0; t < state->transition_count; t++) {
        if (state->transitions[t].level < state->depth)
            continue; /* belongs to an outer state */
        jox_free(state->transitions[t].id);
        jox_free(state->transitions[t].does.set);
        jox_free(state->transitions[t].does.tell);
    }
    jox_free(state->transitions);
}

const JoxValue *jox_state_parameter(const JoxMachine *machine, const JoxState *state, int p) {
    return state->param[p].kind != JOX_VALUE_UNSET ? &state->param[p] : &machine->defaults[p];
}

bool jox_machine_has(const JoxMachine *m, JoxPart part, const char *name) {
    return part == JOX_PART_STATE    ? jox_machine_entry(m, name) >= 0
           : part == JOX_PART_MEMORY ? jox_machine_memory(m, name) >= 0
                                     : jox_machine_own_slot(m, name) >= 0;
}

const char *jox_machine_renamed(const JoxMachine *m, JoxPart part, const char *name) {
    for (uint32_t r = 0; r < m->renamed_count; r++)
        if (strcmp(m->renamed[r].from, name) == 0 && jox_machine_has(m, part, m->renamed[r].to) &&
            !jox_machine_has(m, part, name))
            return m->renamed[r].to;
    return NULL;
}

static bool is_of_message(const JoxMachine *machine, int32_t target) {
    return target >= 0 && machine->targets[target].kind == JOX_TARGET_MESSAGE;
}

bool jox_asks_for_messages(const JoxMachine *machine, int32_t when) {
    for (uint32_t k = 0; when >= 0 && k < machine->expressions[when].count; k++) {
        const JoxInstruction *in = &machine->expressions[when].code[k];
        if (in->op == JOX_OP_TOLD || in->op == JOX_OP_MESSAGE ||
            is_of_message(machine, in->target) || is_of_message(machine, in->place))
            return true;
    }
    return false;
}

void jox_machine_free(JoxMachine *m) {
    if (!m)
        return;
    for (uint32_t s = 0; s < m->state_count; s++)
        free_state(&m->states[s]);
    for (uint32_t o = 0; o < m->outer_count; o++)
        free_state(&m->outer[o]);
    jox_free(m->outer);
    for (uint32_t p = 0; p < m->expression_count; p++)
        jox_free(m->expressions[p].code);
    for (uint32_t t = 0; t < m->target_count; t++)
        jox_free(m->targets[t].name);
    for (uint32_t o = 0; o < m->own_count; o++)
        jox_free(m->own[o].name);
    for (uint32_t n = 0; n < m->memory_count; n++) {
        jox_free(m->memory[n].name);
        jox_free(m->memory[n].identity);
    }
    for (uint32_t r = 0; r < m->renamed_count; r++) {
        jox_free(m->renamed[r].from);
        jox_free(m->renamed[r].to);
    }
    for (uint32_t n = 0; n < m->name_count; n++)
        jox_free(m->names[n].text);
    jox_free(m->names);
    for (uint32_t n = 0; n < m->belonging_count; n++)
        jox_free(m->belongings[n].name);
    jox_free(m->belongings);
    jox_free(m->states);
    jox_free(m->expressions);
    jox_free(m->targets);
    jox_free(m->own);
    jox_free(m->memory);
    jox_free(m->counters);
    jox_free(m->sightings);
    jox_free(m->renamed);
    for (uint32_t f = 0; f < m->file_count; f++)
        jox_free(m->files[f]);
    jox_free(m->files);
    jox_free(m->name);
    jox_free(m->path);
    jox_free(m);
}

/* ---- tags and teams ---- */

/* Returns the new bit of a tag. */
static uint32_t find_new_bit(const JoxMachine *m, const uint16_t *numbers, uint32_t bit) {
    for (uint32_t n = 0; n < m->belonging_count; n++)
        if (!m->belongings[n].is_team && m->belongings[n].number == bit)
            return numbers[n];
    return bit;
}

/* Replaces each bit of a set of tags by its new one. */
static void renumber_tags(const JoxMachine *m, const uint16_t *numbers, uint64_t *tags) {
    uint64_t now = 0;
    for (uint32_t bit = 0; bit < 64; bit++)
        if (*tags >> bit & 1)
            now |= (uint64_t)1 << find_new_bit(m, numbers, bit);
    *tags = now;
}

/* Renumbers the tags and the team that actions assign. */
static void renumber_actions(const JoxMachine *m, const uint16_t *numbers, JoxActions *actions) {
    renumber_tags(m, numbers, &actions->tags);
    for (uint32_t n = 0; n < m->belonging_count && actions->sets_team; n++)
        if (m->belongings[n].is_team && m->belongings[n].number == actions->team) {
            actions->team = numbers[n];
            break;
        }
}

void jox_machine_renumber(JoxMachine *m, const uint16_t *numbers) {
    bool moves = false;
    for (uint32_t n = 0; n < m->belonging_count; n++)
        moves |= m->belongings[n].number != numbers[n];
    if (!moves)
        return;
    for (uint32_t t = 0; t < m->target_count; t++)
        if (m->targets[t].kind == JOX_TARGET_NEAREST)
            m->targets[t].arg = (int32_t)find_new_bit(m, numbers, (uint32_t)m->targets[t].arg);
    for (uint32_t s = 0; s < m->state_count + m->outer_count; s++) {
        JoxState *state = s < m->state_count ? &m->states[s] : &m->outer[s - m->state_count];
        renumber_tags(m, numbers, &state->ignore);
        renumber_tags(m, numbers, &state->push_only);
        renumber_actions(m, numbers, &state->enters);
        for (uint32_t t = 0; t < state->transition_count; t++)
            renumber_actions(m, numbers, &state->transitions[t].does);
    }
    for (uint32_t n = 0; n < m->belonging_count; n++)
        m->belongings[n].number = numbers[n];
}
