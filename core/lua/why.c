/* Who set what: the places of one path of a machine, from the engine's default to the last mod. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "lua/vocabulary.h"

static const JoxVm *vm_of(const JoxLua *lua, const JoxMachine *machine) {
    return machine->vm >= 0 && (uint32_t)machine->vm < lua->vm_count ? lua->vms[machine->vm] : NULL;
}

/* The text of a value as written, on one line and cut where it is long. */
static void print_value(const JoxSource *source, const JoxPath *path, JoxText *out) {
    const JoxToken *first = &source->tokens[path->first];
    const char *end = path->last < source->token_count ? source->tokens[path->last].text
                                                       : source->text + source->length;
    const char *from = first->kind == JOX_TOKEN_STRING ? first->text - 1 : first->text;
    while (end > from && (end[-1] == ' ' || end[-1] == '\n' || end[-1] == '\t' || end[-1] == '\r'))
        end--;
    size_t length = (size_t)(end - from), shown = length < 60 ? length : 57;
    for (size_t i = 0; i < shown; i++)
        jox_text_append(out, (unsigned char)from[i] < 0x20 ? " " : from + i, 1);
    if (shown < length)
        jox_text_add(out, "...");
}

/* One line: where a path stands in a source, its value, who set it. False where it does not. */
static bool print_place(const JoxVm *vm, uint32_t source, const char *path, int32_t mod,
                        bool removes, const JoxScope *scope, JoxText *out) {
    const JoxPath *found = jox_source_path_find(&vm->sources[source], path);
    if (!found || found->key >= vm->sources[source].token_count)
        return false;
    const JoxToken *key = &vm->sources[source].tokens[found->key];
    jox_text_printf(out, "  %s:%d:%d: ", vm->sources[source].path, key->line, key->column);
    if (removes)
        jox_text_add(out, "taken away");
    else
        print_value(&vm->sources[source], found, out);
    if (mod >= 0 && (uint32_t)mod < scope->mod_count)
        jox_text_printf(out, "   (mod %s %s)", scope->mods[mod].name, scope->mods[mod].version);
    jox_text_add(out, "\n");
    return true;
}

/* A transition's path in the behaviour's own file, where it stands by its number. */
static void by_number(const JoxMachine *machine, const char *canonical, char path[256]) {
    char state[128], id[128];
    const char *at = strstr(canonical, ".@");
    snprintf(path, 256, "%s", canonical);
    if (!at || strncmp(canonical, "states.", 7) != 0)
        return;
    snprintf(state, sizeof state, "%.*s", (int)(at - canonical - 7), canonical + 7);
    size_t n = strcspn(at + 2, ".");
    snprintf(id, sizeof id, "%.*s", (int)n, at + 2);
    int number = jox_machine_state(machine, state);
    for (uint32_t t = 0; number >= 0 && t < machine->states[number].transition_count; t++)
        if (strcmp(machine->states[number].transitions[t].id, id) == 0)
            snprintf(path, 256, "states.%.100s.%u%.100s", state, t + 1, at + 2 + n);
}

/* Everything that set one canonical path, in order; how many. */
static int print_all(const JoxVm *vm, const JoxMachine *machine, const char *canonical,
                     const JoxScope *scope, JoxText *out) {
    char own[256];
    int count = 0;
    bool named = false; /* the file's own place is among the origins */
    for (size_t o = 0; o < vm->origin_count; o++)
        named |= vm->origins[o].mod < 0 && strstr(canonical, vm->origins[o].path) == canonical;
    by_number(machine, canonical, own);
    if (!named)
        count += print_place(vm, 0, own, -1, false, scope, out);
    for (size_t o = 0; o < vm->origin_count; o++) {
        const JoxOrigin *origin = &vm->origins[o];
        size_t n = strlen(origin->path);
        if (strncmp(origin->path, canonical, n) != 0 || (n && canonical[n] && canonical[n] != '.'))
            continue;
        char path[512];
        const char *rest = canonical + n + (n && canonical[n] == '.');
        snprintf(path, sizeof path, "%.250s%s%.250s", origin->from,
                 *rest && *origin->from ? "." : "", rest);
        count += print_place(vm, origin->source, path, origin->mod, origin->removes, scope, out);
    }
    return count;
}

bool jox_lua_why(const JoxLua *lua, const JoxMachine *machine, const char *path,
                 const JoxScope *scope, JoxText *out) {
    const JoxVm *vm = vm_of(lua, machine);
    char canonical[256];
    const char *rest = strchr(path, '.'), *last = strrchr(path, '.');
    size_t n = rest ? (size_t)(rest - path) : strlen(path);
    if (!vm)
        return false;
    int count = print_all(vm, machine, path, scope, out);
    snprintf(canonical, sizeof canonical, "states.%.240s", path);
    if (!count)
        count = print_all(vm, machine, canonical, scope, out);
    snprintf(canonical, sizeof canonical, "states.%.*s.@%.120s", (int)(n < 100 ? n : 100), path,
             rest ? rest + 1 : "");
    if (!count && rest)
        count = print_all(vm, machine, canonical, scope, out);
    int parameter = jox_parameter_find(last ? last + 1 : path);
    if (parameter < 0)
        return count > 0;
    snprintf(canonical, sizeof canonical, "defaults.%.100s", jox_parameters[parameter].name);
    if (!count && jox_machine_state(machine, "") < 0) {
        char state[128];
        snprintf(state, sizeof state, "%.*s", (int)(n < 120 ? n : 120), path);
        if (jox_machine_state(machine, state) < 0 && strncmp(path, "defaults.", 9) != 0)
            return false;
        count = print_all(vm, machine, canonical, scope, out);
    }
    if (!count) {
        jox_text_printf(out, "  the engine's default: %g %s\n", jox_parameters[parameter].value,
                        jox_parameters[parameter].unit);
        count = 1;
    }
    return true;
}
