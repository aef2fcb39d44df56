/* Warns of memory that is read while nothing changes it, of lists asked for a size that they cannot
   have, and of messages read where no condition asks for one. The machine runs all the same. Called
   by lint.c. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/read_table.h"

/* Adds a warning, unless another use of the same machine has given it. */
static void warn_at(JoxBuild *b, JoxPosition at, const char *code, const char *hint,
                    const char *text) {
    if (!jox_diag_lists(b->script->diagnostics, at, code, text))
        jox_diag_warn(b->script->diagnostics, at, code, hint, "%s", text);
}

/* ---- memory that nothing sets ---- */

static void mark_assigned(const JoxActions *actions, bool *set) {
    for (uint32_t s = 0; s < actions->set_count; s++)
        set[actions->set[s].slot] = true;
}

/* Marks the slots that entries, items or counters of a machine change. */
static void mark_set_memory(const JoxMachine *m, bool *set) {
    const JoxState *const lists[] = {m->states, m->outer};
    const uint32_t counts[] = {m->state_count, m->outer_count};
    for (int l = 0; l < 2; l++)
        for (uint32_t s = 0; s < counts[l]; s++) {
            mark_assigned(&lists[l][s].enters, set);
            for (uint32_t t = 0; t < lists[l][s].transition_count; t++)
                mark_assigned(&lists[l][s].transitions[t].does, set);
        }
    for (uint32_t c = 0; c < m->counter_count; c++)
        set[m->counters[c].value] = true;
}

/* Marks the slots that expressions and targets of a machine read. */
static void mark_read_memory(const JoxMachine *m, bool *read) {
    for (uint32_t e = 0; e < m->expression_count; e++)
        for (uint32_t k = 0; k < m->expressions[e].count; k++) {
            const JoxInstruction *in = &m->expressions[e].code[k];
            if (in->op == JOX_OP_MEMORY ||
                (in->op >= JOX_OP_LIST_HAS && in->op <= JOX_OP_LIST_LAST))
                read[in->arg] = true;
        }
    for (uint32_t t = 0; t < m->target_count; t++) {
        const JoxTarget *target = &m->targets[t];
        if (target->kind == JOX_TARGET_MEMORY || target->kind == JOX_TARGET_ITEM)
            read[target->arg] = true;
        else if (target->kind == JOX_TARGET_LAST_SEEN)
            read[m->sightings[target->arg].memory] = true;
    }
}

/* Keeps where memory is declared whose value only a scene can give. */
static void keep_unset(const JoxBuild *b, uint32_t slot) {
    JoxMemorySlot *memory = &b->machine->memory[slot];
    const JoxPosition at = b->script->memory_at[slot];
    memory->unset = true;
    memory->line = at.line;
    memory->column = at.column;
    memory->end_column = at.end_column;
    memory->source = jox_build_source(b, at.file);
}

/* Warns of memory that is read though it keeps its first value for ever. A number may come from
   the scene, which the run checks. */
static void check_unset_memory(JoxBuild *b) {
    const JoxMachine *m = b->machine;
    const JoxScript *script = b->script;
    bool *set = jox_alloc((size_t)m->memory_count + 1, sizeof *set),
         *read = jox_alloc((size_t)m->memory_count + 1, sizeof *read);
    mark_set_memory(m, set);
    mark_read_memory(m, read);
    for (uint32_t s = 0; s < script->memory_count && !script->hook_count; s++) {
        const JoxMemorySlot *slot = &m->memory[s];
        const bool list = jox_memory_is_list(slot), who = slot->kind == JOX_MEMORY_SOMEBODY;
        char text[200], hint[200];
        if (set[s] || !read[s])
            continue;
        if (!list && !who) {
            keep_unset(b, s);
            continue;
        }
        snprintf(text, sizeof text, "memory '%.60s' is read, and nothing sets it: it stays %s",
                 slot->name, list ? "empty" : "nobody");
        snprintf(hint, sizeof hint,
                 list ? "Add to it: set = { %.60s = mine.%.60s:push(...) }"
                      : "In a state or transition: set = { %.60s = nearest \"people\" }",
                 slot->name, slot->name);
        warn_at(b, script->memory_at[s], "unset-memory", hint, text);
    }
    jox_free(set);
    jox_free(read);
}

/* ---- items ---- */

/* Warns of a condition that wants more items of a list than it can hold. */
static void check_list_sizes(JoxBuild *b, const char *path, const JoxTransition *t) {
    const JoxMachine *m = b->machine;
    const JoxExpression *e = t->when < 0 ? NULL : &m->expressions[t->when];
    for (uint32_t k = 2; e && k < e->count; k++) {
        const JoxInstruction *in = &e->code[k], *wanted = in - 1, *size = in - 2;
        const bool more = in->op == JOX_OP_GT;
        if ((!more && in->op != JOX_OP_GE && in->op != JOX_OP_EQ) || wanted->op != JOX_OP_CONST ||
            size->op != JOX_OP_LIST_SIZE || size->to != in->a || wanted->to != in->b)
            continue;
        const JoxMemorySlot *list = &m->memory[size->arg];
        char text[200], full[256];
        if (wanted->number + more <= list->capacity)
            continue;
        jox_read_join(full, path, "when");
        snprintf(text, sizeof text,
                 "this never holds: list '%.60s' holds at most %u items, and %s%g are asked for",
                 list->name, list->capacity, more ? "more than " : "", wanted->number);
        warn_at(b, jox_read_at(b, full), "never-fires", "Raise the number in list(...)", text);
    }
}

static bool is_target_of_message(const JoxMachine *m, int32_t target, int16_t name) {
    return target >= 0 && m->targets[target].kind == JOX_TARGET_MESSAGE &&
           m->targets[target].arg == name;
}

/* Returns whether an expression reads a message of this name, or, if `asks`, asks for one. */
static bool has_message(const JoxMachine *m, int32_t expression, int16_t name, bool asks) {
    const JoxExpression *e = expression < 0 ? NULL : &m->expressions[expression];
    for (uint32_t k = 0; e && k < e->count; k++) {
        const JoxInstruction *in = &e->code[k];
        const bool named = in->op == JOX_OP_MESSAGE || (asks && in->op == JOX_OP_TOLD);
        if ((named && in->name == name) || is_target_of_message(m, in->target, name) ||
            is_target_of_message(m, in->place, name))
            return true;
    }
    return false;
}

/* Returns whether a value or target is of a message of this name. */
static bool is_of_message(const JoxMachine *m, const JoxValue *value, int16_t target,
                          int16_t name) {
    if (target >= 0)
        return is_target_of_message(m, target, name);
    return value->kind == JOX_VALUE_EXPRESSION && has_message(m, value->index, name, false);
}

/* Returns whether what an item sets or tells reads a message of this name. */
static bool reads_message(const JoxMachine *m, const JoxActions *does, int16_t name) {
    for (uint32_t s = 0; s < does->set_count; s++)
        if (is_of_message(m, &does->set[s].value, does->set[s].target, name))
            return true;
    const JoxTell *tell = does->tell;
    if (!tell)
        return false;
    static const JoxValue NONE;
    bool reads = tell->to >= 0 && is_of_message(m, &NONE, tell->to, name);
    for (uint32_t c = 0; c < tell->count; c++)
        reads |= is_of_message(m, &tell->carries[c].value, tell->carries[c].target, name);
    return reads;
}

/* Warns of an item that reads a message which its condition does not name. */
static void check_messages_read(JoxBuild *b, const char *path, const JoxTransition *t) {
    const JoxMachine *m = b->machine;
    for (uint32_t n = 0; n < m->name_count && (t->when_hook < 0 || t->rests >= 0); n++) {
        const JoxName *name = &m->names[n];
        char text[200], hint[120];
        if (!(name->uses & JOX_NAME_TOLD) || !reads_message(m, &t->does, (int16_t)n) ||
            has_message(m, t->rests, (int16_t)n, true))
            continue;
        snprintf(text, sizeof text,
                 "this reads message '%.60s', and is done also while none waits: its sender is "
                 "nobody then, and its values are 0",
                 name->text);
        snprintf(hint, sizeof hint, "Ask for it: when = told \"%.60s\"", name->text);
        warn_at(b, jox_read_at(b, path), "unasked-message", hint, text);
    }
}

void jox_lint_memory(JoxBuild *b) {
    const JoxMachine *m = b->machine;
    const JoxState *const lists[] = {m->states, m->outer};
    const uint32_t counts[] = {m->state_count, m->outer_count};
    check_unset_memory(b);
    for (int l = 0; l < 2; l++)
        for (uint32_t s = 0; s < counts[l]; s++)
            for (uint32_t t = 0; t < lists[l][s].transition_count; t++) {
                const JoxTransition *item = &lists[l][s].transitions[t];
                char path[256];
                if (item->level < lists[l][s].depth)
                    continue;
                jox_read_item_path(m, &lists[l][s], item, path);
                check_list_sizes(b, path, item);
                check_messages_read(b, path, item);
            }
}
