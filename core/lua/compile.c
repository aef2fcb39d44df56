/* Adds targets, names, own values, memory and expressions to the machine. Compiles expressions for
   a register machine: operand n of an operation is computed into register `to` + n, its result into
   `to`. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/read_table.h"

void jox_build_error(JoxBuild *build, JoxPosition position, const char *code, const char *hint,
                     const char *format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (!jox_diag_lists(build->script->diagnostics, position, code, text))
        jox_diag_error(build->script->diagnostics, position, code, hint, "%s", text);
}

int32_t jox_build_own(JoxBuild *build, const char *name) {
    JOX_ASSERT(name);
    JoxMachine *m = build->machine;
    for (uint32_t i = 0; i < m->own_count; i++)
        if (*name && strcmp(m->own[i].name, name) == 0)
            return (int32_t)i;
    JOX_RESERVE(m->own, build->own_capacity, m->own_count + 1);
    m->own[m->own_count] = (JoxOwnSlot){.name = jox_strdup(name), .dist = jox_dist_constant(0.0)};
    return (int32_t)m->own_count++;
}

int32_t jox_build_own_at(JoxBuild *build, const JoxNode *node) {
    int32_t slot = jox_nest_own(build, node->name);
    slot = slot < 0 ? jox_build_own(build, node->name) : slot;
    JoxOwnSlot *own = &build->machine->own[slot];
    if (own->line == 0) { /* keeps the first place that uses it */
        own->line = node->written.at.line;
        own->column = node->written.at.column;
        own->end_column = node->written.at.end_column;
        own->source = node->written.source;
    }
    return slot;
}

int32_t jox_build_memory(JoxBuild *build, const char *name) {
    JoxMachine *m = build->machine;
    for (uint32_t i = 0; i < m->memory_count; i++)
        if (*name && strcmp(m->memory[i].name, name) == 0)
            return (int32_t)i;
    JOX_RESERVE(m->memory, build->memory_capacity, m->memory_count + 1);
    m->memory[m->memory_count] =
        (JoxMemorySlot){.name = jox_strdup(name), .kind = JOX_MEMORY_NUMBER};
    return (int32_t)m->memory_count++;
}

int32_t jox_build_hidden(JoxBuild *build, const char *role, const char *of, JoxMemoryKind kind) {
    JoxText identity = {0};
    jox_text_printf(&identity, "%s%s", role, of);
    const int32_t slot = jox_build_memory(build, "");
    build->machine->memory[slot].identity = identity.data;
    build->machine->memory[slot].kind = kind;
    return slot;
}

uint32_t jox_build_lead(JoxBuild *build, const JoxState *state, const JoxTarget *target) {
    const JoxMachine *m = build->machine;
    uint32_t number = 0;
    if (jox_target_kind_is_place(target->kind) && target->kind != JOX_TARGET_MEMORY)
        return 0;
    for (uint32_t t = 0; t < state->steer_count; t++)
        number += state->steer[t].lead > 0;
    const char name[] = {(char)('a' + number), 0}, identity[] = {*JOX_IDENTITY_LEAD, *name, 0};
    for (uint32_t slot = 0; slot < m->memory_count; slot++)
        if (!strcmp(jox_memory_identity(&m->memory[slot]), identity))
            return 1 + slot; /* a state's first, second way and so on share theirs with others' */
    const int32_t first = jox_build_hidden(build, JOX_IDENTITY_LEAD, name, JOX_MEMORY_NUMBER);
    for (char k = '1'; k < '0' + JOX_LEAD_SLOTS; k++) {
        const char other[] = {*name, k, 0};
        jox_build_hidden(build, JOX_IDENTITY_LEAD, other, JOX_MEMORY_NUMBER);
    }
    return 1 + (uint32_t)first;
}

int16_t jox_build_name(JoxBuild *build, const char *name, JoxNameUse use) {
    JOX_ASSERT(*name);
    JoxMachine *m = build->machine;
    for (uint32_t n = 0; n < m->name_count; n++)
        if (strcmp(m->names[n].text, name) == 0) {
            m->names[n].uses |= use;
            return (int16_t)n;
        }
    JOX_RESERVE(m->names, build->name_capacity, m->name_count + 1);
    m->names[m->name_count] = (JoxName){.text = jox_strdup(name), .uses = use};
    return (int16_t)m->name_count++;
}

/* Returns the number of a name, added on first use, and keeps the first place that uses it. */
static int16_t add_name_at(JoxBuild *build, const char *text, JoxNameUse use,
                           const JoxNamePlace *written) {
    const int16_t number = jox_build_name(build, text, use);
    JoxName *name = &build->machine->names[number];
    if (name->line == 0) {
        name->line = written->at.line;
        name->column = written->at.column;
        name->end_column = written->at.end_column;
        name->source = written->source;
    }
    return number;
}

uint32_t jox_build_source(const JoxBuild *build, const char *file) {
    for (uint32_t s = 0; file && s < build->script->vm.source_count; s++)
        if (strcmp(build->script->vm.sources[s]->path, file) == 0)
            return s;
    return 0;
}

int16_t jox_build_name_at(JoxBuild *build, const char *text, JoxNameUse use, JoxPosition at) {
    const JoxNamePlace written = {.at = at, .source = jox_build_source(build, at.file)};
    return add_name_at(build, text, use, &written);
}

/* Adds the memory of an agent's home; no script can use its name, which has a blank. */
static void add_home_memory(JoxBuild *build) {
    build->machine->home = (uint32_t)jox_build_memory(build, "home x") + 1;
    jox_build_memory(build, "home y");
}

/* Compiles the filter of a target. */
static JoxAgentFilter build_target_filter(JoxBuild *build, const JoxNodeFilter *filter) {
    JoxAgentFilter made = {.some = filter->state || filter->machine || filter->memory ||
                                   filter->grouped || filter->fallen,
                           .state = -1,
                           .machine = -1,
                           .memory = -1,
                           .group = filter->grouped ? filter->group : -1,
                           .least = filter->least,
                           .greatest = filter->greatest,
                           .flies = filter->flies,
                           .fallen = filter->fallen,
                           .comes = (float)filter->comes,
                           .within = (float)filter->within,
                           .ahead = (float)filter->ahead};
    if (filter->state)
        made.state = add_name_at(build, filter->state, JOX_NAME_STATE, &filter->state_at);
    if (filter->machine)
        made.machine = jox_build_name(build, filter->machine, JOX_NAME_MACHINE);
    if (filter->memory)
        made.memory = add_name_at(build, filter->memory, JOX_NAME_MEMORY, &filter->memory_at);
    return made;
}

static bool is_same_filter(const JoxAgentFilter *a, const JoxAgentFilter *b) {
    return a->some == b->some && a->state == b->state && a->machine == b->machine &&
           a->memory == b->memory && a->group == b->group && a->least == b->least &&
           a->greatest == b->greatest && a->flies == b->flies && a->fallen == b->fallen &&
           a->comes == b->comes && a->within == b->within && a->ahead == b->ahead;
}

/* Returns the sighting of a slot of memory that holds somebody, added on first use. */
static int32_t add_sighting(JoxBuild *build, int32_t memory) {
    JoxMachine *m = build->machine;
    for (uint32_t s = 0; s < m->sighting_count; s++)
        if (m->sightings[s].memory == memory)
            return (int32_t)s;
    JOX_RESERVE(m->sightings, build->sighting_capacity, m->sighting_count + 1);
    char *const name = m->memory[memory].name; /* outlives the array of slots */
    const JoxSighting sighting = {
        memory, jox_build_hidden(build, JOX_IDENTITY_SEEN, name, JOX_MEMORY_SOMEBODY),
        jox_build_hidden(build, JOX_IDENTITY_SEEN_X, name, JOX_MEMORY_NUMBER),
        jox_build_hidden(build, JOX_IDENTITY_SEEN_Y, name, JOX_MEMORY_NUMBER)};
    m->sightings[m->sighting_count] = sighting;
    return (int32_t)m->sighting_count++;
}

/* Returns 1 + the compiled score of a target; 0 if it has none. */
static int32_t build_score(JoxBuild *build, const JoxNode *node) {
    if (node->kind != JOX_NODE_TARGET || !node->score)
        return 0;
    if (build->scores) {
        jox_build_error(build, node->position, "too-complex", "Remember one of them with `set`",
                        "`best` cannot stand in the score of another one");
        return 0;
    }
    build->scores = true;
    build->scores_places = jox_target_kind_is_place(node->target_kind);
    const int32_t score = jox_build_expression(build, node->score, node->position);
    build->scores = false;
    return 1 + score;
}

/* Returns the text by which messages name a target; the caller frees it. */
static char *name_target(const JoxNode *node) {
    JoxText text = {0};
    if (node->kind == JOX_NODE_TARGET && node->target_kind == JOX_TARGET_MEMORY)
        jox_text_printf(&text, "mine.%s", node->name);
    else if (node->kind == JOX_NODE_TARGET && node->target_kind == JOX_TARGET_ITEM)
        jox_text_printf(&text, "mine.%s.%s", node->name, node->arg ? "last" : "first");
    else if (node->kind == JOX_NODE_TARGET && node->target_kind == JOX_TARGET_LAST_SEEN)
        jox_text_printf(&text, "last_seen(mine.%s)", node->name);
    else if (node->kind == JOX_NODE_TARGET && node->target_kind == JOX_TARGET_MESSAGE)
        jox_text_printf(&text, "told(\"%s\").%s", node->name, node->field ? node->field : "sender");
    else if (node->kind == JOX_NODE_TARGET && node->score)
        jox_text_printf(&text, "%s(%s)",
                        jox_target_kind_is_place(node->target_kind) ? "best_place" : "best",
                        node->name);
    else
        jox_text_add(&text, node->name);
    return text.data;
}

int16_t jox_build_target(JoxBuild *build, const JoxNode *node) {
    JoxMachine *m = build->machine;
    if (!node || node->kind == JOX_NODE_ERROR)
        return -1;
    static const JoxNodeFilter ANY;
    JoxTarget target = {
        .kind = node->target_kind,
        .arg = node->target_arg,
        .field = -1,
        .filter = build_target_filter(build, node->kind == JOX_NODE_TARGET ? &node->filter : &ANY)};
    if (node->kind == JOX_NODE_TARGET && node->target_kind == JOX_TARGET_HOME)
        add_home_memory(build);
    if (node->kind == JOX_NODE_TARGET && node->target_kind == JOX_TARGET_OTHER && !build->scores)
        jox_build_error(build, node->position, "bad-value",
                        "Example: best(\"people\", other.speed)",
                        "`other` is the candidate in the score of `best`, and nothing else");
    if (node->kind == JOX_NODE_TARGET && node->target_kind == JOX_TARGET_MESSAGE) {
        target.arg = add_name_at(build, node->name, JOX_NAME_TOLD, &node->written);
        if (node->field)
            target.field = add_name_at(build, node->field, JOX_NAME_READ, &node->written);
    }
    if (node->kind == JOX_NODE_TARGET && node->target_kind == JOX_TARGET_MEMORY)
        target.arg = jox_build_memory(build, node->name);
    if (node->kind == JOX_NODE_TARGET && node->target_kind == JOX_TARGET_ITEM) {
        target.arg = jox_build_memory(build, node->name);
        target.field = (int16_t)node->arg;
    }
    if (node->kind == JOX_NODE_TARGET && node->target_kind == JOX_TARGET_LAST_SEEN)
        target.arg = add_sighting(build, jox_build_memory(build, node->name));
    target.score = build_score(build, node);
    const bool of_own = target.kind == JOX_TARGET_ONE_OF_OWN || target.kind == JOX_TARGET_BEST_OWN;
    if (node->kind == JOX_NODE_OWN || of_own) {
        int32_t slot = jox_build_own_at(build, node);
        if (m->own[slot].declared && !m->own[slot].is_place)
            jox_build_error(build, node->position, "bad-value",
                            "Name a place in the machine's `own`",
                            "own.%.60s is a number, and a place is wanted here", node->name);
        if (!m->own[slot].declared) /* no place unless the scene's group names one */
            m->own[slot].dist = jox_dist_constant(-1.0);
        m->own[slot].is_place = true;
        target.kind = of_own ? target.kind : JOX_TARGET_OWN_PLACE;
        target.arg = slot;
    }
    target.name = name_target(node);
    for (uint32_t i = 0; i < m->target_count; i++)
        if (m->targets[i].kind == target.kind && m->targets[i].arg == target.arg &&
            m->targets[i].field == target.field && strcmp(m->targets[i].name, target.name) == 0 &&
            m->targets[i].score == target.score &&
            is_same_filter(&m->targets[i].filter, &target.filter)) {
            jox_free(target.name);
            return (int16_t)i;
        }
    JOX_RESERVE(m->targets, build->target_capacity, m->target_count + 1);
    m->targets[m->target_count] = target;
    return (int16_t)m->target_count++;
}

static bool is_other(const JoxNode *node) {
    return node->kind == JOX_NODE_TARGET && node->target_kind == JOX_TARGET_OTHER;
}

typedef struct Code {
    JoxBuild *build;
    JoxInstruction *items;
    size_t count, capacity;
    bool too_deep, without_machine;
} Code;

enum { LONGEST = 1000, DEEPEST = 200 };

/* Makes an instruction on the clock of a state read the outer state's that is being built. */
static void use_outer_clock(Code *code, JoxInstruction *in) {
    const int32_t level = code->build->level;
    const JoxMachine *m = code->build->machine;
    code->without_machine |= in->op == JOX_OP_DONE && level < 0;
    if (in->op == JOX_OP_DONE)
        in->arg = level < 0 ? 0 : level;
    if (level < 0)
        return;
    const bool time = in->op == JOX_OP_NOW && in->arg == JOX_NOW_time_in_state;
    if (in->op != JOX_OP_AFTER && in->op != JOX_OP_LASTED && in->op != JOX_OP_EVERY && !time)
        return;
    if (in->op == JOX_OP_LASTED)
        in->number = m->lasting[level] - 1;
    in->op = in->op == JOX_OP_AFTER    ? JOX_OP_OUTER_AFTER
             : in->op == JOX_OP_LASTED ? JOX_OP_OUTER_LASTED
             : in->op == JOX_OP_EVERY  ? JOX_OP_OUTER_EVERY
                                       : JOX_OP_OUTER_TIME;
    in->arg = (int32_t)m->clock[level] - 1;
}

/* Appends the code of an expression, with its result in register `to`. */
static void emit_expression(Code *code, const JoxNode *node, uint32_t to, uint32_t depth) {
    JOX_ASSERT(node->kind >= JOX_NODE_NUMBER && node->kind <= JOX_NODE_ERROR);
    if (to + 3 >= JOX_MOST_REGISTERS || code->count >= LONGEST || depth > DEEPEST) {
        code->too_deep = true;
        return;
    }
    const JoxNode *inputs[3] = {node->a, node->b, node->c};
    uint32_t used = 0;
    size_t first_input = 0; /* instruction that computes the first operand */
    for (; used < 3 && inputs[used] && !code->too_deep; used++) {
        emit_expression(code, inputs[used], to + used, depth + 1);
        first_input = used == 0 ? code->count - 1 : first_input;
    }
    JoxInstruction in = {.op = (uint8_t)(node->kind == JOX_NODE_OWN ? JOX_OP_OWN : node->op),
                         .to = (uint8_t)to,
                         .a = (uint8_t)to,
                         .b = (uint8_t)(to + 1),
                         .c = (uint8_t)(to + 2),
                         .target = -1,
                         .place = -1,
                         .name = -1,
                         .arg = node->arg,
                         .number = node->number};
    if (node->kind == JOX_NODE_OWN)
        in.arg = jox_build_own_at(code->build, node);
    else if (node->op == JOX_OP_MEMORY)
        in.arg = jox_build_memory(code->build, node->name);
    else if (node->op == JOX_OP_PROGRAM_NUMBER || node->op == JOX_OP_PROGRAM_CONDITION)
        in.name = jox_build_name(code->build, node->name, 0);
    else if (node->op == JOX_OP_THEIRS)
        in.name = add_name_at(code->build, node->name, JOX_NAME_MEMORY, &node->written);
    else if (node->op >= JOX_OP_LIST_HAS && node->op <= JOX_OP_LIST_LAST)
        in.arg = jox_build_memory(code->build, node->name);
    else if (node->op == JOX_OP_TOLD || node->op == JOX_OP_MESSAGE)
        in.name = add_name_at(code->build, node->name, JOX_NAME_TOLD, &node->written);
    else if (node->op == JOX_OP_HEARD || node->op == JOX_OP_OPEN)
        in.name =
            add_name_at(code->build, node->name,
                        node->op == JOX_OP_HEARD ? JOX_NAME_HEARD : JOX_NAME_GATE, &node->written);
    if (node->op == JOX_OP_MESSAGE && node->kind == JOX_NODE_NUMBER)
        in.arg = add_name_at(code->build, node->field, JOX_NAME_READ, &node->written);
    if (node->target)
        in.target = jox_build_target(code->build, node->target);
    if (node->place)
        in.place = jox_build_target(code->build, node->place);
    if (node->place && is_other(node->place) && !code->build->scores_places)
        jox_build_error(code->build, node->position, "bad-value",
                        "Example: best_place(\"exits\", 0 - count(other))",
                        "a place is wanted here, and `other` is a person or a body");
    use_outer_clock(code, &in);
    JOX_RESERVE(code->items, code->capacity, code->count + 1);
    if (in.op == JOX_OP_AND && !code->too_deep)
        code->items[first_input].skip = (uint16_t)(code->count - first_input);
    code->items[code->count++] = in;
}

int32_t jox_build_expression(JoxBuild *build, const JoxNode *node, JoxPosition position) {
    JoxMachine *m = build->machine;
    if (node->kind == JOX_NODE_ERROR)
        return -1;
    if (node->compiled > 0 && node->compiled_in == build->scope && !build->scores)
        return node->compiled - 1;
    Code code = {.build = build};
    emit_expression(&code, node, 0, 0);
    if (code.too_deep) {
        jox_build_error(build, position, "too-complex", "Split it over several states",
                        "this expression is too deep or too long");
        jox_free(code.items);
        return -1;
    }
    if (code.without_machine) {
        jox_build_error(
            build, position, "no-machine",
            "Give the state one: runs = machine { ... }, or ask in the state that has it",
            "`done` asks for the machine that a state runs, and this state runs none");
        jox_free(code.items);
        return -1;
    }
    JOX_RESERVE(m->expressions, build->expression_capacity, m->expression_count + 1);
    m->expressions[m->expression_count] = (JoxExpression){code.items, (uint32_t)code.count};
    if (!build->scores) { /* a score may name `other`, which has no meaning elsewhere */
        ((JoxNode *)node)->compiled = (int32_t)m->expression_count + 1;
        ((JoxNode *)node)->compiled_in = build->scope;
    }
    return (int32_t)m->expression_count++;
}
