/* Finds all states of a behaviour's machine and of those that its states run, and adds them to the
   one machine that is built, without content: a state for each of theirs, named "Guard.Walk".
   Called by build.c. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/name.h"
#include "base/mem.h"
#include "base/sort.h"
#include "lua/read_table.h"

enum { MOST_STATES = 1000, LONGEST_NAME = 100 };

/* Finds where a machine is written: its source, and its path in the outline of that. */
static void locate_machine(JoxBuild *b, const JoxNode *node, JoxNested *nested) {
    nested->source = -1;
    if (!node->written.at.file || node->written.source >= b->script->vm.source_count)
        return;
    const JoxSource *source = b->script->vm.sources[node->written.source];
    if (jox_outline_root(source, node->written.at.line, node->written.at.column, nested->root))
        nested->source = (int32_t)node->written.source;
}

/* Returns whether a machine runs itself, by way of the states around. */
static bool runs_itself(JoxBuild *b, int table, uint32_t within) {
    lua_State *L = b->script->vm.L;
    lua_rawgeti(L, LUA_REGISTRYINDEX, table);
    const void *is = lua_topointer(L, -1);
    bool found = false;
    for (uint32_t n = within; !found; n = b->nested[n].parent) {
        lua_rawgeti(L, LUA_REGISTRYINDEX, b->nested[n].table);
        found = lua_topointer(L, -1) == is;
        lua_pop(L, 1);
        if (n == 0)
            break;
    }
    lua_pop(L, 1);
    return found;
}

/* Returns the machine that the state table on top of the stack runs, and pops nothing; NULL if it
   runs none, with an error if it should. */
static const JoxNode *find_machine(JoxBuild *b, const JoxState *state, uint32_t nested) {
    lua_State *L = b->script->vm.L;
    char path[256], full[256];
    const int top = lua_gettop(L), type = jox_read_field(L, top, "runs");
    const JoxNode *node = jox_node_get(L, -1);
    lua_settop(L, top);
    if (type == LUA_TNIL || (node && node->kind == JOX_NODE_ERROR))
        return NULL;
    jox_state_path(state, path);
    jox_read_join(full, path, "runs");
    if (!node || node->kind != JOX_NODE_MACHINE)
        jox_build_error(
            b, jox_read_at(b, full), "bad-value",
            "Write machine { ... } there, or what another file returns: require \"patrol\"",
            "`runs` needs a machine, not %s", node ? "this value" : lua_typename(L, type));
    else if (runs_itself(b, node->hook, nested))
        jox_build_error(b, jox_read_at(b, full), "runs-itself",
                        "Lead back to the state by a transition instead",
                        "state '%.100s' runs the machine that it is in", state->name);
    else if (state->depth == JOX_MOST_LEVELS)
        jox_build_error(b, jox_read_at(b, full), "too-deep",
                        "Put its states into the machine around",
                        "machines run in each other to a depth of %d", JOX_MOST_LEVELS + 1);
    else if (strchr(state->name, '.') && state->depth == 0)
        jox_build_error(b, jox_read_at(b, path), "bad-name", "Rename it",
                        "a state that runs a machine has no dot in its name");
    else
        return node;
    return NULL;
}

/* Adds an outer state, and its clock. */
static void add_outer_state(JoxBuild *b, JoxState state, uint32_t nested) {
    JoxMachine *m = b->machine;
    const uint32_t level = state.depth;
    JOX_RESERVE(m->outer, b->outer_capacity, m->outer_count + 1);
    JOX_RESERVE(b->outer_nested, b->outer_nested_capacity, m->outer_count + 1);
    b->outer_nested[m->outer_count] = nested;
    m->outer[m->outer_count++] = state;
    const char number[] = {(char)('0' + level), 0};
    if (!m->clock[level]) {
        m->clock[level] =
            1 + (uint32_t)jox_build_hidden(b, JOX_IDENTITY_CLOCK, number, JOX_MEMORY_NUMBER);
        m->lasting[level] =
            1 + (uint32_t)jox_build_hidden(b, JOX_IDENTITY_LASTS, number, JOX_MEMORY_NUMBER);
    }
}

static void add_state(JoxBuild *b, JoxState state, uint32_t nested) {
    JoxMachine *m = b->machine;
    JOX_RESERVE(m->states, b->state_capacity, m->state_count + 1);
    JOX_RESERVE(b->state_nested, b->state_nested_capacity, m->state_count + 1);
    b->state_nested[m->state_count] = nested;
    m->states[m->state_count++] = state;
}

/* Returns a blank state of a machine, named `name` there. */
static JoxState make_state(const JoxBuild *b, uint32_t nested, const char *name) {
    char whole[256];
    jox_nest_name(b, nested, name, whole);
    JoxState state = jox_state_blank(jox_strdup(whole));
    const int32_t outer = b->nested[nested].outer;
    if (outer < 0)
        return state;
    const JoxState *around = &b->machine->outer[outer];
    state.depth = (uint8_t)(around->depth + 1);
    memcpy(state.around, around->around, sizeof state.around);
    state.around[around->depth] = (uint16_t)outer;
    return state;
}

/* Returns whether the name on top of the stack but one may be that of a state, with the table on
   top; reports it if not. */
static bool check_state(JoxBuild *b, uint32_t nested) {
    lua_State *L = b->script->vm.L;
    const JoxMachine *m = b->machine;
    const bool text = lua_type(L, -2) == LUA_TSTRING;
    const char *name = text ? lua_tostring(L, -2) : "?";
    const bool plain = text && strlen(name) == lua_rawlen(L, -2) && jox_name_is_plain(name);
    char path[256], part[256], whole[256];
    jox_read_join(part, b->nested[nested].path, "states");
    jox_read_join(path, part, name);
    jox_nest_name(b, nested, name, whole);
    if (text && !plain)
        jox_build_error(b, jox_read_at(b, path), "bad-name", JOX_NAME_RULE,
                        "'%.60s' is no name for a state", name);
    else if (!text || lua_type(L, -1) != LUA_TTABLE || m->state_count >= MOST_STATES)
        jox_build_error(
            b, jox_read_at(b, path), "bad-value", "Example: Walk = { steer = seek(goal) }",
            m->state_count >= MOST_STATES && nested > 0
                ? "a machine has at most %d states, with those of machines that they run"
                : "states must be tables with names",
            MOST_STATES);
    else if (nested > 0 && strchr(name, '.'))
        jox_build_error(b, jox_read_at(b, path), "bad-name", "Rename it",
                        "a state of a machine that a state runs has no dot in its name");
    else if (nested > 0 && strlen(whole) > LONGEST_NAME)
        jox_build_error(b, jox_read_at(b, path), "bad-name", "Shorten one of the names",
                        "'%.100s...' is too long: whole names of states have at most %d bytes",
                        whole, LONGEST_NAME);
    else
        return true;
    return false;
}

static void collect_states(JoxBuild *b, uint32_t nested);

/* Adds the machine that an outer state runs, and its states. */
static void collect_nested(JoxBuild *b, const JoxNode *node, int32_t outer, uint32_t parent) {
    JOX_RESERVE(b->nested, b->nested_capacity, b->nested_count + 1);
    JoxNested *nested = &b->nested[b->nested_count];
    *nested = (JoxNested){
        .table = node->hook, .outer = outer, .parent = parent, .source = -1, .steps = node->steps};
    if (outer >= 0) {
        char path[256];
        jox_state_path(&b->machine->outer[outer], path);
        jox_read_join(nested->path, path, "runs");
    }
    if (outer >= 0 || node->steps)
        locate_machine(b, node, nested);
    collect_states(b, b->nested_count++);
}

/* Adds the states of a machine in ascending order of names, as tables have no order; those of a
   machine that a state runs in its place. */
static void collect_states(JoxBuild *b, uint32_t number) {
    lua_State *L = b->script->vm.L;
    const int top = lua_gettop(L);
    char path[256];
    luaL_checkstack(L, 20, "states");
    lua_rawgeti(L, LUA_REGISTRYINDEX, b->nested[number].table);
    jox_read_join(path, b->nested[number].path, "states");
    if (!lua_istable(L, top + 1) || jox_read_field(L, top + 1, "states") != LUA_TTABLE) {
        jox_build_error(b, jox_read_at(b, path), "missing-key", "states = { Walk = { ... } }",
                        "a machine needs `states`, a table");
        lua_settop(L, top);
        return;
    }
    const int table = top + 2;
    size_t count = 0, most = 0;
    for (lua_pushnil(L); lua_next(L, table); lua_pop(L, 1))
        most++;
    jox_vm_charge(L, 20 * most);
    const char **names = lua_newuserdatauv(L, (most + 1) * sizeof *names, 0);
    for (lua_pushnil(L); lua_next(L, table); lua_pop(L, 1))
        if (check_state(b, number))
            names[count++] = lua_tostring(L, -2); /* valid while the table lives */
    jox_sort_texts(names, count);
    if (most == 0)
        jox_build_error(b, jox_read_at(b, path), "no-states", NULL,
                        "a machine needs at least one state");
    for (size_t s = 0; s < count; s++) {
        JoxState state = make_state(b, number, names[s]);
        jox_read_field(L, table, names[s]);
        const JoxNode *node = find_machine(b, &state, number);
        lua_pop(L, 1);
        if (b->machine->state_count >= MOST_STATES || b->machine->outer_count >= MOST_STATES) {
            jox_free(state.name);
        } else if (node) {
            add_outer_state(b, state, number);
            collect_nested(b, node, (int32_t)b->machine->outer_count - 1, number);
        } else {
            add_state(b, state, number);
        }
    }
    lua_settop(L, top);
}

/* Returns the state within an outer one that has the whole name of a state; NULL if there is none.
 */
static const JoxState *find_namesake(const JoxMachine *m, const JoxState *state) {
    for (uint32_t s = 0; s < m->state_count + m->outer_count; s++) {
        const JoxState *other = s < m->state_count ? &m->states[s] : &m->outer[s - m->state_count];
        if (other->depth > 0 && strcmp(other->name, state->name) == 0)
            return other;
    }
    return NULL;
}

/* Reports states with a dot in their names that a state of a machine which another state runs has,
   too. */
static void check_dotted_names(JoxBuild *b) {
    const JoxMachine *m = b->machine;
    for (uint32_t s = 0; s < m->state_count; s++) {
        const JoxState *state = &m->states[s],
                       *other = state->depth == 0 && strchr(state->name, '.')
                                    ? find_namesake(m, state)
                                    : NULL;
        char path[256], there[256];
        if (!other)
            continue;
        jox_state_path(state, path);
        jox_state_path(other, there);
        const JoxPosition at = jox_read_at(b, there);
        jox_build_error(b, jox_read_at(b, path), "bad-name", "Rename one of them",
                        "'%.100s' is also the whole name of a state of the machine that '%.*s' "
                        "runs, at %.100s:%d:%d",
                        state->name, (int)(strrchr(other->name, '.') - other->name), other->name,
                        at.file ? at.file : "", at.line, at.column);
    }
}

void jox_nest_collect(JoxBuild *b, const JoxNode *machine) {
    collect_nested(b, machine, -1, 0);
    check_dotted_names(b);
}
