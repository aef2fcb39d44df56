/* Checks the names that machines use of each other and of the scene. load_scene.c calls it once all
   machines are loaded; reload_batch.c, for the own values of one machine. */
#include <stdio.h>
#include <string.h>

#include "base/format/path.h"
#include "run/machine_names.h"
#include "run/run.h"
#include "run/scene_machines.h"
#include "run/tally_scores.h"
#include "run/wall_checks.h"

static bool has_machine_signal(const JoxMachineRun *machines, const char *text) {
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        for (uint32_t n = 0; n < machine->name_count; n++)
            if ((machine->names[n].uses & JOX_NAME_SIGNALLED) &&
                strcmp(machine->names[n].text, text) == 0)
                return true;
    }
    return false;
}

/* Whether a machine uses a name of messages or of their values in this way. */
static bool has_name_use(const JoxMachineRun *machines, const char *text, JoxNameUse use) {
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        for (uint32_t n = 0; n < machine->name_count; n++)
            if ((machine->names[n].uses & use) && strcmp(machine->names[n].text, text) == 0)
                return true;
    }
    return false;
}

static bool has_state(const JoxMachineRun *machines, const char *name) {
    for (uint32_t m = 0; m < machines->set->count; m++)
        for (uint32_t s = 0; s < machines->set->items[m]->state_count; s++)
            if (jox_state_answers(&machines->set->items[m]->states[s], name))
                return true;
    return false;
}

static void warn_of_unknown_state(const JoxMachineRun *machines, JoxPosition at, const char *name,
                                  JoxDiagnostics *diagnostics) {
    const char *names[256];
    char hint[JOX_HINT];
    size_t count = 0;
    for (uint32_t m = 0; m < machines->set->count; m++)
        for (uint32_t s = 0; s < machines->set->items[m]->state_count && count < 256; s++)
            names[count++] = machines->set->items[m]->states[s].name;
    jox_diag_warn(diagnostics, at, "unknown-state", jox_did_you_mean(name, names, count, hint),
                  "no machine of the scene has a state '%s'", name);
}

static bool has_machine_named(const JoxMachineRun *machines, const char *name) {
    for (uint32_t m = 0; m < machines->set->count; m++)
        if (strcmp(machines->set->items[m]->name, name) == 0)
            return true;
    return false;
}

static bool has_public_memory(const JoxMachineRun *machines, const char *name) {
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        for (uint32_t s = 0; s < machine->memory_count; s++)
            if (machine->memory[s].is_public && strcmp(machine->memory[s].name, name) == 0)
                return true;
    }
    return false;
}

/* Writes a suggestion into `hint`: the name most like `name` that machines use in this way. Returns
   it; NULL if none resembles it. */
static const char *suggest_name(const JoxMachineRun *machines, const char *name, JoxNameUse use,
                                char hint[JOX_HINT]) {
    const char *names[256];
    size_t count = 0;
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        for (uint32_t n = 0; n < machine->name_count && count < 256; n++)
            if ((machine->names[n].uses & use) && strcmp(machine->names[n].text, name) != 0)
                names[count++] = machine->names[n].text;
    }
    return jox_did_you_mean(name, names, count, hint);
}

/* Warns of memory of others that no machine makes public. */
static void warn_of_unknown_memory(const JoxMachineRun *machines, JoxPosition at, const char *name,
                                   JoxDiagnostics *diagnostics) {
    const char *names[256];
    char hint[JOX_HINT];
    size_t count = 0;
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        for (uint32_t s = 0; s < machine->memory_count && count < 256; s++)
            if (machine->memory[s].is_public)
                names[count++] = machine->memory[s].name;
    }
    const char *near = jox_did_you_mean(name, names, count, hint);
    for (uint32_t m = 0; m < machines->set->count; m++)
        if (jox_machine_memory(machines->set->items[m], name) >= 0)
            near = NULL; /* it is there, and not public */
    jox_diag_warn(diagnostics, at, "unknown-memory",
                  near ? near : "In the machine that remembers it: public = { ... }",
                  "no machine of the scene makes memory '%s' public", name);
}

/* Returns the present name of a state or memory that was renamed; NULL if a machine still has it
   by the old name, or none had it. */
static const char *find_new_name(const JoxMachineRun *machines, JoxPart part, const char *name) {
    const char *now = NULL;
    for (uint32_t m = 0; m < machines->set->count; m++) {
        if (jox_machine_has(machines->set->items[m], part, name))
            return NULL;
        now = now ? now : jox_machine_renamed(machines->set->items[m], part, name);
    }
    return now;
}

/* Whether a group that runs the machine sets the own value. True as well if no group runs it. */
static bool is_set_by_groups(const JoScene *scene, const JoxMachine *machine, const char *name) {
    const JoxSceneSpec *spec = scene->spec;
    bool runs = false;
    for (uint32_t g = 0; g < spec->group_count; g++)
        for (uint32_t m = 0; m < spec->groups[g].mix_count; m++) {
            if (strcmp(spec->groups[g].mix[m].behaviour, machine->path) != 0)
                continue;
            runs = true;
            for (uint32_t s = 0; s < spec->groups[g].set_count; s++)
                if (strcmp(spec->groups[g].set[s].name, name) == 0)
                    return true;
        }
    return !runs; /* another machine becomes it, and brings its own values */
}

/* Whether an event of the scene gives a signal. */
static bool has_event_signal(const JoScene *scene, const char *text) {
    for (uint32_t e = 0; e < scene->spec->event_count; e++)
        if (scene->spec->events[e].kind == JOX_EVENT_SIGNAL &&
            strcmp(scene->spec->events[e].name, text) == 0)
            return true;
    return false;
}

/* Whether a Lua function of a behaviour may give a signal. */
static bool may_function_signal(const JoScene *scene, const char *text) {
    const JoxMachineSet *set = &scene->world->model.machines;
    bool may = false;
    for (uint32_t m = 0; m < set->count; m++)
        may |= set->items[m]->hook_count && jox_lua_may_signal(scene->lua, set->items[m], text);
    return may;
}

/* Returns the present name of an own value that is read by its old one; NULL: it was not
   renamed. */
static const char *find_new_own_name(const JoxMachine *machine, const char *name) {
    for (uint32_t r = 0; r < machine->renamed_count; r++)
        if (strcmp(machine->renamed[r].from, name) == 0 &&
            jox_machine_has(machine, JOX_PART_OWN, machine->renamed[r].to))
            return machine->renamed[r].to;
    return NULL;
}

void jox_run_check_own_values(const JoScene *scene, const JoxMachine *machine,
                              const JoxLuaFile *files, uint32_t count,
                              JoxDiagnostics *diagnostics) {
    size_t before = diagnostics->count;
    for (uint32_t o = 0; o < machine->own_count; o++) {
        const JoxOwnSlot *slot = &machine->own[o];
        if (!*slot->name || slot->declared || jox_parameter_find(slot->name) >= 0 ||
            is_set_by_groups(scene, machine, slot->name))
            continue;
        const char *names[JOX_PARAM_COUNT + JOX_MOST_GIVEN], *near = NULL;
        char hint[160];
        size_t known = 0;
        for (uint32_t s = 0; s < machine->own_count && known < JOX_MOST_GIVEN; s++)
            if (*machine->own[s].name && machine->own[s].declared)
                names[known++] = machine->own[s].name;
        near = jox_suggest(slot->name, names, known); /* its own first: `own.rise` is far off */
        for (int p = 0; p < JOX_PARAM_COUNT; p++)
            names[known++] = jox_parameters[p].name;
        near = near ? near : jox_suggest(slot->name, names, known);
        const char *file = slot->source < count ? files[slot->source].path : machine->path;
        const char *now = find_new_own_name(machine, slot->name);
        if (now) {
            jox_diag_renamed(diagnostics,
                             ((JoxPosition){file, slot->line, slot->column, slot->end_column}),
                             slot->name, now);
            continue;
        }
        snprintf(hint, sizeof hint,
                 jox_machine_memory(machine, slot->name) >= 0 ? "It is in memory: mine.%.60s"
                 : near                                       ? "Did you mean 'own.%.60s'?"
                        : "In the scene's group: set: {%.60s: ...}",
                 near && jox_machine_memory(machine, slot->name) < 0 ? near : slot->name);
        jox_diag_error(
            diagnostics, ((JoxPosition){file, slot->line, slot->column, slot->end_column}),
            "unknown-value", hint, "'%.60s' is no parameter, and no group that runs %s sets it",
            slot->name, machine->name);
    }
    if (diagnostics->count > before)
        jox_run_attach_sources(files, count, diagnostics);
}

static bool gives_memory(const JoxGroupValue *values, uint32_t count, const char *name) {
    for (uint32_t v = 0; v < count; v++)
        if (strcmp(values[v].name, name) == 0)
            return true;
    return false;
}

/* Warns of numbers in memory that the machine reads and that neither it nor the scene sets. */
static void check_unset_memory(const JoScene *scene, const JoxMachine *machine,
                               const JoxLuaFile *files, uint32_t count,
                               JoxDiagnostics *diagnostics) {
    const JoxSceneSpec *spec = scene->spec;
    for (uint32_t s = 0; s < machine->memory_count; s++) {
        const JoxMemorySlot *slot = &machine->memory[s];
        bool given = !slot->unset;
        char hint[160];
        for (uint32_t g = 0; g < spec->group_count; g++)
            given |= gives_memory(spec->groups[g].memory, spec->groups[g].memory_count, slot->name);
        for (uint32_t n = 0; n < spec->source_count; n++)
            given |=
                gives_memory(spec->sources[n].memory, spec->sources[n].memory_count, slot->name);
        if (given)
            continue;
        const char *file = slot->source < count ? files[slot->source].path : machine->path;
        snprintf(
            hint, sizeof hint,
            "In a transition: set = { %.40s = ... }, or in the scene's group: memory: {%.40s: 1}",
            slot->name, slot->name);
        jox_diag_warn(
            diagnostics, ((JoxPosition){file, slot->line, slot->column, slot->end_column}),
            "unset-memory", hint, "memory '%.60s' is read, and nothing sets it", slot->name);
    }
}

/* Returns where a behaviour first names a state or memory of other machines. */
static JoxPosition get_name_position(const JoxMachine *machine, const JoxName *name,
                                     const JoxLuaFile *files, uint32_t count) {
    const char *file = name->source < count ? files[name->source].path : machine->path;
    return (JoxPosition){file, name->line, name->column, name->end_column};
}

/* Finds where people wait for a signal or gate: the step of a journey, else the condition. */
static JoxPosition find_wait(const JoScene *scene, const JoxMachine *machine, const JoxName *name,
                             const JoxLuaFile *files, uint32_t count) {
    for (uint32_t g = 0; g < scene->spec->group_count; g++) {
        const JoxGroup *group = &scene->spec->groups[g];
        if (group->journey_count == 0 || strcmp(group->mix[0].behaviour, machine->path) != 0)
            continue;
        for (uint32_t s = 0; s < group->journey_count; s++) {
            const JoxJourneyStep *step = &group->journey[s];
            if ((step->until && strcmp(step->until, name->text) == 0) ||
                (step->gate && strcmp(step->gate, name->text) == 0))
                return step->position;
        }
    }
    return get_name_position(machine, name, files, count);
}

/* Whether walls of a name are closed at the start, and nothing opens them. */
static bool stays_gate_closed(const JoScene *scene, const char *gate) {
    const JoxWalls *walls = &scene->world->model.all_walls;
    bool closed = false;
    for (uint32_t r = 0; r < walls->ring_count; r++)
        closed |= walls->rings[r].name && strcmp(walls->rings[r].name, gate) == 0 &&
                  !walls->rings[r].open && !walls->rings[r].is_lift_door;
    return closed && !jox_run_has_gate_opener(scene, gate);
}

/* Whether functions of some machine may tell or ask for any message. */
static bool may_functions_tell(const JoxMachineRun *machines) {
    for (uint32_t m = 0; m < machines->set->count; m++)
        if (machines->set->items[m]->tells_functions)
            return true;
    return false;
}

/* Warns of messages that are asked for and that nobody tells, or the reverse, and of values that no
   message carries. */
static void check_message_name(const JoScene *scene, const JoxName *name, JoxPosition at,
                               JoxDiagnostics *diagnostics) {
    const JoxMachineRun *machines = &scene->world->machines;
    char hint[JOX_HINT];
    if (may_functions_tell(machines))
        return;
    if ((name->uses & JOX_NAME_TOLD) && !has_name_use(machines, name->text, JOX_NAME_SENT))
        jox_diag_warn(diagnostics, at, "untold-message",
                      suggest_name(machines, name->text, JOX_NAME_SENT, hint)
                          ? hint
                          : "Example: tell = { nearest \"people\", \"shot\" }",
                      "no machine of the scene tells a message '%s'", name->text);
    if ((name->uses & JOX_NAME_SENT) && !has_name_use(machines, name->text, JOX_NAME_TOLD))
        jox_diag_warn(diagnostics, at, "unasked-message",
                      has_name_use(machines, name->text, JOX_NAME_HEARD)
                          ? "heard() is of signals: a message is asked for by told()"
                      : suggest_name(machines, name->text, JOX_NAME_TOLD, hint)
                          ? hint
                          : "Example: when = told \"shot\"",
                      "no machine of the scene asks for the message '%s'", name->text);
    if ((name->uses & JOX_NAME_READ) && !has_name_use(machines, name->text, JOX_NAME_CARRIED))
        jox_diag_warn(diagnostics, at, "unknown-value",
                      suggest_name(machines, name->text, JOX_NAME_CARRIED, hint)
                          ? hint
                          : "In `tell`, after its name: damage = 2",
                      "no message of the scene carries a value '%s'", name->text);
}

/* Returns the present name of a state or memory that is named as it was once called; else NULL. */
static const char *find_new_name_used(const JoxMachineRun *machines, const JoxName *name) {
    const char *now = NULL;
    if (name->uses & JOX_NAME_STATE)
        now = find_new_name(machines, JOX_PART_STATE, name->text);
    if (!now && (name->uses & JOX_NAME_MEMORY))
        now = find_new_name(machines, JOX_PART_MEMORY, name->text);
    return now;
}

void jox_run_check_machine_names(const JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoxMachineRun *machines = &scene->world->machines;
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        const JoxPosition in = {machine->path, 0, 0, 0};
        char hint[JOX_HINT];
        uint32_t count;
        const JoxLuaFile *files = jox_lua_files(scene->lua, machine, &count);
        size_t before = diagnostics->count;
        jox_run_check_own_values(scene, machine, files, count, diagnostics);
        check_unset_memory(scene, machine, files, count, diagnostics);
        for (uint32_t n = 0; n < machine->name_count; n++) {
            const JoxName *name = &machine->names[n];
            const bool others = name->uses & (JOX_NAME_STATE | JOX_NAME_MEMORY);
            const JoxPosition at = others ? get_name_position(machine, name, files, count) : in;
            const char *now = find_new_name_used(machines, name);
            if (now) {
                jox_diag_renamed(diagnostics, at, name->text, now);
                continue;
            }
            bool heard = name->uses & JOX_NAME_HEARD, state = name->uses & JOX_NAME_STATE;
            if (heard && !has_machine_signal(machines, name->text) &&
                !has_event_signal(scene, name->text) && !may_function_signal(scene, name->text))
                jox_diag_warn(diagnostics, find_wait(scene, machine, name, files, count),
                              "unheard-signal",
                              has_name_use(machines, name->text, JOX_NAME_SENT)
                                  ? "It is a message: when = told \"...\""
                                  : suggest_name(machines, name->text, JOX_NAME_SIGNALLED, hint),
                              "no machine of the scene gives the signal '%s'", name->text);
            check_message_name(scene, name, get_name_position(machine, name, files, count),
                               diagnostics);
            if ((name->uses & JOX_NAME_GATE) && stays_gate_closed(scene, name->text))
                jox_diag_warn(diagnostics, find_wait(scene, machine, name, files, count),
                              "never-opened", "Add an event that opens it, or begin with it open",
                              "gate '%s' is closed, and nothing opens it", name->text);
            if (state && !has_state(machines, name->text))
                warn_of_unknown_state(machines, at, name->text, diagnostics);
            if ((name->uses & JOX_NAME_MACHINE) && !has_machine_named(machines, name->text))
                jox_diag_warn(diagnostics, in, "unknown-machine", NULL,
                              "no machine of the scene is called '%s'", name->text);
            if ((name->uses & JOX_NAME_MEMORY) && !has_public_memory(machines, name->text))
                warn_of_unknown_memory(machines, at, name->text, diagnostics);
        }
        if (diagnostics->count > before)
            jox_run_attach_sources(files, count, diagnostics);
    }
    jox_run_check_tally(scene, diagnostics);
}

/* ---- mods ---- */

void jox_run_check_mod_use(const JoScene *scene, const JoxMod *mod, JoxDiagnostics *diagnostics) {
    const JoxMachineSet *set = &scene->world->model.machines;
    bool used = false;
    for (uint32_t f = 0; f < scene->spec->file_count; f++)
        used |= jox_path_below(scene->spec->files[f].path, mod->folder);
    for (uint32_t m = 0; m < set->count; m++) {
        uint32_t count;
        const JoxLuaFile *files = jox_lua_files(scene->lua, set->items[m], &count);
        for (uint32_t f = 0; f < count; f++)
            used |= jox_path_below(files[f].path, mod->folder);
    }
    if (used)
        return;
    const JoxPosition folder = {mod->folder, 0, 0, 0};
    const JoxModPatch *patch = mod->patch_count ? &mod->patches[0] : NULL;
    if (patch && patch->target)
        jox_diag_warn(diagnostics, patch->position, "unused-mod",
                      "Patches name a scene or a behaviour that it uses",
                      "mod %s changes nothing of this scene, which has no '%.60s'", mod->name,
                      patch->target);
    else
        jox_diag_warn(diagnostics, folder, "unused-mod",
                      "Files in its patches/ change scenes and behaviours",
                      "mod %s changes nothing of this scene: it has no patches", mod->name);
}
