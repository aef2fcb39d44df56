/* Lists the places that set a value of a machine, from the engine's default to the last mod. For
   `jostle why` and the inspector of the live page. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "lua/infer_kinds.h"
#include "lua/loader.h"

enum { LONGEST = 400 }; /* bytes of a value that are shown */

/* A place that sets a value. */
typedef struct Setting {
    const JoxSource *source;
    uint32_t first, last; /* tokens of the value */
    const JoxToken *key;
    int32_t mod; /* index of the mod, or -1 for the behaviour itself */
    bool removes, extends;
} Setting;

/* Prints a value as written, on one line and without comments; cut after `most` bytes. */
static void print_value(const Setting *setting, size_t most, JoxText *out) {
    const JoxSource *source = setting->source;
    JOX_ASSERT(setting->first <= setting->last && setting->last <= source->token_count);
    size_t begin = out->length;
    const char *before = NULL; /* end of the last token */
    for (uint32_t t = setting->first; t < setting->last && t < source->token_count; t++) {
        const JoxToken *token = &source->tokens[t];
        bool quoted = token->kind == JOX_TOKEN_STRING;
        if (before && token->text - quoted > before)
            jox_text_add(out, " ");
        jox_text_add(out, quoted ? "\"" : "");
        for (uint32_t i = 0; i < token->length; i++)
            jox_text_append(out, (unsigned char)token->text[i] < 0x20 ? " " : token->text + i, 1);
        jox_text_add(out, quoted ? "\"" : "");
        before = token->text + token->length + quoted;
    }
    if (out->length - begin <= most)
        return;
    out->length = begin + most - 3;
    while (out->length > begin && ((unsigned char)out->data[out->length] & 0xc0) == 0x80)
        out->length--; /* never within a character */
    jox_text_add(out, "...");
}

/* A search for places: each is passed to `visit`, if given, and the last is kept. */
typedef struct Settings {
    const JoxScope *scope;
    JoxKinds *kinds; /* made on first use */
    bool follows;    /* also finds values that the file builds, not only those that its table
                        constructor has */
    JoSetVisit *visit;
    void *context;
    Setting last;
} Settings;

/* Passes a place to the visitor. */
static void visit_place(const Setting *setting, const Settings *to) {
    JoxText value = {0};
    const bool is_mod = setting->mod >= 0 && (uint32_t)setting->mod < to->scope->mod_count;
    if (!setting->removes)
        print_value(setting, LONGEST, &value);
    to->visit(to->context,
              &(JoSetting){.by = is_mod ? JO_SET_MOD : JO_SET_BEHAVIOUR,
                           .value = value.data,
                           .file = setting->source->path,
                           .line = setting->key->line,
                           .column = setting->key->column,
                           .mod = is_mod ? to->scope->mods[setting->mod].name : NULL,
                           .version = is_mod ? to->scope->mods[setting->mod].version : NULL,
                           .removes = setting->removes,
                           .extends = setting->extends});
    jox_text_free(&value);
}

/* Adds the place of a path in a source, written there by `change` of a mod, or by the behaviour
   itself, NULL; false if it is not written there. */
static bool add_written_place(const JoxScript *script, uint32_t source, const char *path,
                              const JoxPatchChange *change, Settings *to) {
    const JoxPath *found = jox_outline_find(script->vm.sources[source], path);
    if (!found || found->key >= script->vm.sources[source]->token_count)
        return false;
    const JoxToken *key = &script->vm.sources[source]->tokens[found->key];
    to->last = (Setting){.source = script->vm.sources[source],
                         .first = found->first,
                         .last = found->last,
                         .key = key,
                         .mod = change ? change->mod : -1,
                         .removes = change && change->removes,
                         .extends = change && change->extends};
    if (to->visit)
        visit_place(&to->last, to);
    return true;
}

/* Adds places of a value that the behaviour's table constructor does not have: of the part around
   it, as `A = lib.stand(2)` for the speed of A, and of what builds it. */
static bool add_followed_places(const JoxScript *script, const char *path, Settings *to) {
    JoxPartOrigin found;
    if (to->follows && !to->kinds)
        to->kinds = jox_kinds_read(script);
    if (!to->kinds || !jox_part_find(to->kinds, path, &found))
        return false;
    char around[256];
    snprintf(around, sizeof around, "%s", path);
    for (char *dot; (dot = strrchr(around, '.'));) {
        *dot = 0;
        if ((found.source != 0 || strcmp(around, "states") != 0) &&
            add_written_place(script, 0, around, NULL, to))
            break;
    }
    const JoxSource *source = script->vm.sources[found.source];
    to->last = (Setting){.source = source,
                         .first = found.first,
                         .last = found.last,
                         .key = &source->tokens[found.key],
                         .mod = -1};
    if (to->visit)
        visit_place(&to->last, to);
    return true;
}

/* Returns the state of a name or of a path without its first part, as "Guard.runs.states.Walk";
   NULL: none. */
static const JoxState *find_state_at(const JoxMachine *machine, const char *path) {
    char whole[256];
    for (uint32_t s = 0; s < machine->state_count + machine->outer_count; s++) {
        const JoxState *state = s < machine->state_count
                                    ? &machine->states[s]
                                    : &machine->outer[s - machine->state_count];
        jox_state_path(state, whole);
        if (strcmp(whole + 7, path) == 0 || strcmp(state->name, path) == 0)
            return state;
    }
    return NULL;
}

/* Replaces the id of a transition in a path by its number, as in the behaviour's own file. */
static void use_transition_number(const JoxMachine *machine, const char *canonical,
                                  char path[256]) {
    char state[256];
    const char *at = strstr(canonical, ".@");
    snprintf(path, 256, "%s", canonical);
    if (!at || strncmp(canonical, "states.", 7) != 0)
        return;
    snprintf(state, sizeof state, "%.*s", (int)(at - canonical - 7), canonical + 7);
    size_t longest = 0; /* ids may have dots, as names of states */
    const JoxState *of = find_state_at(machine, state);
    for (uint32_t t = 0; of && t < of->transition_count; t++) {
        const char *id = of->transitions[t].id, *rest = at + 2;
        if (of->transitions[t].level < of->depth)
            continue;
        const size_t n = strlen(id);
        if (n < longest || strncmp(rest, id, n) != 0 || (rest[n] && rest[n] != '.'))
            continue;
        longest = n;
        snprintf(path, 256, "states.%.140s.%u%.80s", state, of->transitions[t].item + 1u, rest + n);
    }
}

/* Adds every place that sets a path, in the order in which they apply; returns how many. */
static int add_all_places(const JoxScript *script, const JoxMachine *machine, const char *canonical,
                          Settings *to) {
    char own[256];
    int count = 0;
    bool named = false; /* the changes of mods include the file's own place */
    for (size_t o = 0; o < script->changes.count; o++)
        named |= script->changes.items[o].mod < 0 &&
                 strstr(canonical, script->changes.items[o].path) == canonical;
    use_transition_number(machine, canonical, own);
    if (!named)
        count +=
            add_written_place(script, 0, own, NULL, to) || add_followed_places(script, own, to);
    for (size_t o = 0; o < script->changes.count; o++) {
        const JoxPatchChange *change = &script->changes.items[o];
        char path[512];
        const char *rest;
        if (!jox_patch_leads(change, canonical, &rest))
            continue;
        rest = change->removes ? "" : rest; /* the whole part was removed */
        snprintf(path, sizeof path, "%.250s%s%.250s", change->from,
                 *rest && *change->from ? "." : "", rest);
        count += add_written_place(script, change->source, path, change, to);
    }
    return count;
}

/* Returns whether a state sets a key that is no parameter. */
static bool sets_key(const JoxState *state, const char *key) {
    const struct {
        const char *key;
        bool set;
    } KEYS[] = {{"steer", state->steer_count > 0},    {"lasts", state->has_lasts},
                {"removes", state->removes},          {"face", state->face >= 0},
                {"approach", state->approach >= 0},   {"kick", state->kick >= 0},
                {"take", state->take >= 0},           {"drop", state->drop >= 0},
                {"throw", state->toss >= 0},          {"become", state->become != NULL},
                {"on_enter", state->on_enter >= 0},   {"on_exit", state->on_exit >= 0},
                {"push_when", state->push_when >= 0}, {"ignore", state->ignore != 0},
                {"push_only", state->push_only != 0}, {"push_toward", state->push_toward >= 0},
                {"stays_in", state->stays_in >= 0}};
    for (size_t k = 0; k < sizeof KEYS / sizeof *KEYS; k++)
        if (strcmp(KEYS[k].key, key) == 0)
            return KEYS[k].set;
    return false;
}

/* Returns whether a state sets a key, or has a transition, that a path begins with. */
static bool state_has_part(const JoxState *of, const char *path, int parameter) {
    char id[128];
    if (parameter >= 0 && of->param[parameter].kind != JOX_VALUE_UNSET)
        return true;
    snprintf(id, sizeof id, "%.*s", (int)strcspn(path, "."), path);
    if (sets_key(of, id))
        return true;
    for (uint32_t t = 0; t < of->transition_count; t++)
        if (strcmp(of->transitions[t].id, id) == 0)
            return true;
    return false;
}

/* Returns whether the machine has the part that a path names: a state, a transition, or a key that
   the state sets. */
static bool has_part(const JoxMachine *machine, const char *path, int parameter) {
    char state[128];
    const size_t n = strcspn(path, ".");
    snprintf(state, sizeof state, "%.*s", (int)(n < 120 ? n : 120), path);
    const int number = jox_machine_state(machine, state);
    if (number < 0)
        return false;
    return !path[n] || state_has_part(&machine->states[number], path + n + 1, parameter);
}

/* Adds the places of the nearest enclosing part that is written out, for a value that a function
   builds. */
static int add_enclosing_places(const JoxScript *script, const JoxMachine *machine,
                                const char *canonical, Settings *to) {
    char path[256];
    int count = 0;
    snprintf(path, sizeof path, "%s", canonical);
    for (char *dot; !count && (dot = strrchr(path, '.'));) {
        *dot = 0;
        count = add_all_places(script, machine, path, to);
    }
    return count;
}

/* Returns the state within an outer one, or the outer state, that a path begins with, by its whole
   name or the path of its table, and the rest of the path; NULL: none. */
static const JoxState *find_nested_state(const JoxMachine *machine, const char *path,
                                         const char **rest) {
    const JoxState *found = NULL;
    size_t longest = 0;
    bool nested = false;
    *rest = path;
    if (machine->outer_count == 0)
        return NULL;
    for (uint32_t s = 0; s < machine->state_count + machine->outer_count; s++) {
        const JoxState *state = s < machine->state_count
                                    ? &machine->states[s]
                                    : &machine->outer[s - machine->state_count];
        char whole[256], prefixed[256];
        jox_state_path(state, whole);
        snprintf(prefixed, sizeof prefixed, "states.%.200s", state->name);
        const char *const forms[] = {state->name, prefixed, whole};
        for (size_t k = 0; k < sizeof forms / sizeof *forms; k++) {
            const size_t n = strlen(forms[k]);
            if (n <= longest || strncmp(path, forms[k], n) != 0 || (path[n] && path[n] != '.'))
                continue;
            longest = n;
            found = state;
            nested = state->depth > 0 || s >= machine->state_count;
            *rest = path + n + (path[n] == '.');
        }
    }
    return nested ? found : NULL;
}

/* Visits the engine's default of a parameter. */
static void visit_engine_default(int parameter, const Settings *to) {
    char number[32];
    snprintf(number, sizeof number, "%g", jox_parameters[parameter].value);
    to->visit(to->context, &(JoSetting){.by = JO_SET_DEFAULT,
                                        .value = number,
                                        .unit = jox_parameters[parameter].unit});
}

/* Visits the places of a key or transition of a state within outer ones: its own; else those of the
   nearest outer state around it that sets it, but not for an item by its number or with the mark of
   one, which is the state's own; else those of defaults, of the machine first. */
static bool visit_nested_path(const JoxScript *script, const JoxMachine *machine,
                              const JoxState *state, const char *rest, Settings *to) {
    char path[256], full[256];
    const int parameter = jox_parameter_find(rest);
    const uint32_t most = *rest == '@' || (*rest >= '0' && *rest <= '9') ? 0 : state->depth;
    int count = 0;
    for (uint32_t up = 0; !count && up <= most; up++) {
        const JoxState *on =
            up == 0 ? state : jox_state_on_level(machine, state, state->depth - up);
        jox_state_path(on, path);
        snprintf(full, sizeof full, "%.140s%s%.100s", path, *rest ? "." : "", rest);
        count = add_all_places(script, machine, full, to);
        snprintf(full, sizeof full, "%.140s.@%.100s", path, rest);
        if (!count && *rest)
            count = add_all_places(script, machine, full, to);
    }
    snprintf(full, sizeof full, "defaults.%.120s", rest);
    if (!count && parameter >= 0)
        count = add_all_places(script, machine, full, to);
    for (uint32_t l = 0; !count && parameter >= 0 && l < state->depth; l++) {
        jox_state_path(jox_state_on_level(machine, state, l), path);
        snprintf(full, sizeof full, "%.120s.runs.defaults.%.100s", path, rest);
        count = add_all_places(script, machine, full, to);
    }
    if (!count && parameter >= 0 && to->visit) {
        visit_engine_default(parameter, to);
        count = 1;
    }
    if (!count && to->visit && (!*rest || state_has_part(state, rest, parameter))) {
        jox_state_path(state, path);
        snprintf(full, sizeof full, "%.140s.%.100s", path, rest);
        count = add_enclosing_places(script, machine, full, to);
    }
    return count > 0;
}

/* Finds the form of a path that the machine has, and visits its places. */
static bool visit_path(const JoxScript *script, const JoxMachine *machine, const char *path,
                       Settings *to) {
    char canonical[256];
    const char *within;
    const JoxState *nested = find_nested_state(machine, path, &within);
    if (nested)
        return visit_nested_path(script, machine, nested, within, to);
    const char *rest = strchr(path, '.'), *last = strrchr(path, '.');
    size_t n = rest ? (size_t)(rest - path) : strlen(path);
    int count = add_all_places(script, machine, path, to);
    snprintf(canonical, sizeof canonical, "states.%.240s", path);
    if (!count)
        count = add_all_places(script, machine, canonical, to);
    snprintf(canonical, sizeof canonical, "states.%.*s.@%.120s", (int)(n < 100 ? n : 100), path,
             rest ? rest + 1 : "");
    if (!count && rest)
        count = add_all_places(script, machine, canonical, to);
    int parameter = jox_parameter_find(last ? last + 1 : path);
    if (!count && has_part(machine, path, parameter)) {
        snprintf(canonical, sizeof canonical, "states.%.240s", path);
        count = add_enclosing_places(script, machine, canonical, to);
    }
    if (parameter < 0)
        return count > 0;
    snprintf(canonical, sizeof canonical, "defaults.%.100s", jox_parameters[parameter].name);
    if (!count && jox_machine_state(machine, "") < 0) {
        char state[128];
        snprintf(state, sizeof state, "%.*s", (int)(n < 120 ? n : 120), path);
        if (jox_machine_state(machine, state) < 0 && strncmp(path, "defaults.", 9) != 0)
            return false;
        count = add_all_places(script, machine, canonical, to);
        if (!count && machine->defaults[parameter].line > 0)
            count = add_enclosing_places(script, machine, canonical, to);
    }
    if (!count) {
        visit_engine_default(parameter, to);
        count = 1;
    }
    return true;
}

bool jox_lua_why(const JoxLua *lua, const JoxMachine *machine, const char *path,
                 const JoxScope *scope, JoSetVisit *visit, void *context) {
    const JoxScript *script = jox_lua_script(lua, machine);
    Settings to = {.scope = scope, .visit = visit, .context = context, .follows = true};
    const bool found = script && visit_path(script, machine, path, &to);
    jox_kinds_free(to.kinds);
    return found;
}

static bool find_written(const JoxLua *lua, const JoxMachine *machine, const char *path,
                         const JoxScope *scope, bool follows, JoxWritten *out) {
    const JoxScript *script = jox_lua_script(lua, machine);
    Settings to = {.scope = scope, .follows = follows};
    *out = (JoxWritten){0};
    const char *rest;
    const JoxState *nested = find_nested_state(machine, path, &rest);
    const bool found = script && (nested ? visit_nested_path(script, machine, nested, rest, &to)
                                         : add_all_places(script, machine, path, &to) > 0);
    jox_kinds_free(to.kinds);
    if (!found || to.last.removes)
        return false;
    print_value(&to.last, LONGEST, &out->text);
    out->file = to.last.source->path;
    out->line = to.last.key->line;
    out->column = to.last.key->column;
    if (to.last.mod >= 0 && (uint32_t)to.last.mod < scope->mod_count)
        out->mod = scope->mods[to.last.mod].name;
    return true;
}

bool jox_lua_written(const JoxLua *lua, const JoxMachine *machine, const char *path,
                     const JoxScope *scope, JoxWritten *out) {
    return find_written(lua, machine, path, scope, false, out);
}

bool jox_lua_written_or_built(const JoxLua *lua, const JoxMachine *machine, const char *path,
                              const JoxScope *scope, JoxWritten *out) {
    return find_written(lua, machine, path, scope, true, out);
}

/* ---- local variables ---- */

/* Returns whether a value is worth showing by itself: no table, function, memory, file or machine.
 */
static bool is_shown_value(const JoxSyntax *s, int32_t tree) {
    static const char *const MAKERS[] = {"memory", "require", "machine"};
    const JoxTree *t = &s->trees[tree];
    if (t->kind == JOX_TREE_TABLE || t->kind == JOX_TREE_FUNCTION)
        return false;
    for (size_t m = 0; m < sizeof MAKERS / sizeof *MAKERS; m++)
        if (t->kind == JOX_TREE_CALL && jox_token_is(jox_syntax_token(s, t->a), MAKERS[m]))
            return false;
    return t->last > t->first;
}

void jox_lua_locals(const JoxLua *lua, const JoxMachine *machine, JoxLocalVisit *visit,
                    void *context) {
    const JoxScript *script = jox_lua_script(lua, machine);
    const JoxSyntax *s = script ? jox_outline_syntax(script->vm.sources[0]) : NULL;
    for (size_t b = 0; s && s->whole && b < s->binding_count; b++) {
        const JoxTreeBinding *bound = &s->bindings[b];
        if (bound->kind != JOX_BIND_VALUE || !bound->declares ||
            s->trees[bound->target].function != 0 || !is_shown_value(s, bound->value))
            continue;
        const JoxTree *value = &s->trees[bound->value];
        const Setting setting = {
            .source = s->source, .first = value->first, .last = value->last, .mod = -1};
        const JoxToken *name = jox_syntax_token(s, bound->target);
        JoxText called = {0}, text = {0};
        jox_text_append(&called, name->text, name->length);
        print_value(&setting, LONGEST, &text);
        visit(context, called.data, text.data ? text.data : "");
        jox_text_free(&called);
        jox_text_free(&text);
    }
}

/* ---- memory ---- */

/* Returns the token of the key in `NAME = value`, in the table that opens at token `t`; NULL if
   there is none. */
static const JoxToken *find_field(const JoxSource *source, size_t t, const char *name) {
    int depth = 0;
    for (; t + 2 < source->token_count; t++) {
        const JoxToken *token = &source->tokens[t];
        depth += jox_token_is(token, "{");
        depth -= jox_token_is(token, "}");
        if (depth == 0)
            return NULL;
        if (depth == 1 && token->kind == JOX_TOKEN_NAME && jox_token_is(token, name) &&
            jox_token_is(&source->tokens[t + 1], "="))
            return token;
    }
    return NULL;
}

bool jox_lua_memory(const JoxLua *lua, const JoxMachine *machine, const char *name,
                    JoxWritten *out) {
    const JoxScript *script = jox_lua_script(lua, machine);
    *out = (JoxWritten){0};
    for (size_t f = 0; script && f < script->vm.source_count; f++) {
        const JoxSource *source = script->vm.sources[f];
        for (size_t t = 0; t + 2 < source->token_count; t++) {
            if (!jox_token_is(&source->tokens[t], "memory"))
                continue;
            t += 1 + jox_token_is(&source->tokens[t + 1], "(");
            const JoxToken *field =
                jox_token_is(&source->tokens[t], "{") ? find_field(source, t, name) : NULL;
            if (!field)
                continue;
            jox_text_append(&out->text, field[2].text, field[2].length);
            out->file = source->path;
            out->line = field->line;
            out->column = field->column;
            return true;
        }
    }
    return false;
}
