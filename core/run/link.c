/* Machines of a scene: loaded, linked to those that they become, held against each other and
   against what the scene measures. */
#include <stdio.h>
#include <string.h>

#include "base/format/path.h"
#include "base/mem.h"
#include "base/overlay.h"
#include "run/run.h"

static int32_t find_machine(const JoxMachineRun *machines, const char *path) {
    for (uint32_t m = 0; m < machines->set->count; m++)
        if (strcmp(machines->set->items[m]->path, path) == 0)
            return (int32_t)m;
    return -1;
}

const char *jox_run_made(const JoxSceneSpec *spec, const char *path) {
    for (uint32_t g = 0; g < spec->group_count; g++)
        for (uint32_t m = 0; m < spec->groups[g].mix_count; m++)
            if (spec->groups[g].mix[m].text && !strcmp(spec->groups[g].mix[m].behaviour, path))
                return spec->groups[g].mix[m].text;
    return NULL;
}

int32_t jox_run_machine(JoScene *scene, const char *path, JoxDiagnostics *diagnostics) {
    JoxMachineRun *machines = &scene->world->machines;
    int32_t known = find_machine(machines, path);
    if (known >= 0)
        return known;
    if (machines->set->count == JOX_MOST_MACHINES) {
        jox_diag_error(diagnostics, ((JoxPosition){path, 0, 0, 0}), "too-many", NULL,
                       "a scene has at most %d behaviours", JOX_MOST_MACHINES);
        return -1;
    }
    const char *made = jox_run_made(scene->spec, path);
    JoxMachine *machine = jox_lua_load_text(scene->lua, path, made, made ? strlen(made) : 0,
                                            &scene->scope, diagnostics);
    if (!machine)
        return -1;
    jox_run_number_belongings(scene, machine);
    jox_run_take_kept(machine);
    return (int32_t)jox_machines_add(machines, machine);
}

/* The file of a behaviour that another one names: beside it, of the library, or of a mod. */
static bool find_behaviour(const JoScene *scene, const char *from, const char *name,
                           char path[1024]) {
    static const char *const FOLDERS[] = {"", JOX_DATADIR "/behaviours/", NULL};
    return jox_mod_find(scene->mods->items, scene->mods->count, name, path) ||
           jox_path_find(from, name, ".lua", FOLDERS, path);
}

bool jox_run_find_become(const JoScene *scene, const JoxMachine *machine, uint32_t number,
                         char path[1024], JoxDiagnostics *diagnostics) {
    const JoxState *state = &machine->states[number];
    JoxPosition at = {state->become_file, state->become_line, state->become_column, 0};
    if (number == machine->start) {
        jox_diag_error(diagnostics, at, "bad-value", "Begin in another state",
                       "the state that agents start in cannot become another machine at once");
        return false;
    }
    if (!strstr(state->become, "..") && *state->become != '/' &&
        find_behaviour(scene, machine->path, state->become, path)) {
        jox_path_clean(path);
        return true;
    }
    jox_diag_error(diagnostics, at, "missing-file",
                   "A plain name: of a file beside this one, or of the library",
                   "there is no behaviour '%.100s' to become", state->become);
    return false;
}

bool jox_run_link(JoScene *scene, JoxMachine *machine, JoxDiagnostics *diagnostics) {
    bool good = true;
    for (uint32_t s = 0; s < machine->state_count; s++) {
        char path[1024];
        if (!machine->states[s].become)
            continue;
        int32_t index = jox_run_find_become(scene, machine, s, path, diagnostics)
                            ? jox_run_machine(scene, path, diagnostics)
                            : -1;
        machine->states[s].become_machine = index;
        good = good && index >= 0;
    }
    return good;
}

/* Shows the line of an error that is in a behaviour's file. */
static void attach(const JoxLuaFile *files, uint32_t count, JoxDiagnostics *diagnostics) {
    for (uint32_t f = 0; f < count; f++) {
        size_t length;
        char *text = jox_read_file(files[f].path, 1 << 20, &length);
        if (text)
            jox_diag_attach_source(diagnostics, files[f].path, text, length);
        jox_free(text);
    }
}

bool jox_run_load_machines(JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoxSceneSpec *spec = scene->spec;
    JoxMachineRun *machines = &scene->world->machines;
    bool good = true;
    for (uint32_t g = 0; g < spec->group_count; g++)
        for (uint32_t m = 0; m < spec->groups[g].mix_count; m++) {
            const char *path = spec->groups[g].mix[m].behaviour;
            bool failed_before = false;
            for (uint32_t h = 0; h <= g; h++)
                for (uint32_t k = 0; k < (h == g ? m : spec->groups[h].mix_count); k++)
                    failed_before |= !strcmp(spec->groups[h].mix[k].behaviour, path);
            if (failed_before || jox_run_machine(scene, path, diagnostics) >= 0)
                continue;
            good = false;
        }
    for (uint32_t m = 0; m < machines->set->count; m++) /* grows while it goes on */
        good &= jox_run_link(scene, machines->set->built[m], diagnostics);
    for (uint32_t m = 0; good && m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->built[m];
        const size_t before = diagnostics->count;
        uint32_t count;
        const JoxLuaFile *files = jox_lua_files(scene->lua, machine, &count);
        jox_run_check_belongings(scene, machine, files, count,
                                 (const JoxMachine *const *)machines->set->built,
                                 machines->set->count, diagnostics);
        if (diagnostics->count > before)
            attach(files, count, diagnostics);
    }
    return good && diagnostics->errors == 0;
}

static bool is_signalled(const JoxMachineRun *machines, const char *text) {
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        for (uint32_t n = 0; n < machine->name_count; n++)
            if ((machine->names[n].uses & JOX_NAME_SIGNALLED) &&
                strcmp(machine->names[n].text, text) == 0)
                return true;
    }
    return false;
}

static bool is_state(const JoxMachineRun *machines, const char *name) {
    for (uint32_t m = 0; m < machines->set->count; m++)
        if (jox_machine_state(machines->set->items[m], name) >= 0)
            return true;
    return false;
}

static void warn_of_state(const JoxMachineRun *machines, JoxPosition at, const char *name,
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

static bool is_machine(const JoxMachineRun *machines, const char *name) {
    for (uint32_t m = 0; m < machines->set->count; m++)
        if (strcmp(machines->set->items[m]->name, name) == 0)
            return true;
    return false;
}

static bool is_public(const JoxMachineRun *machines, const char *name) {
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        for (uint32_t s = 0; s < machine->memory_count; s++)
            if (machine->memory[s].is_public && strcmp(machine->memory[s].name, name) == 0)
                return true;
    }
    return false;
}

/* What the machine that has a part by this name calls it now, where none has it by that name. */
static const char *renamed(const JoxMachineRun *machines, JoxPart part, const char *name) {
    const char *now = NULL;
    for (uint32_t m = 0; m < machines->set->count; m++) {
        if (jox_machine_has(machines->set->items[m], part, name))
            return NULL;
        now = now ? now : jox_machine_renamed(machines->set->items[m], part, name);
    }
    return now;
}

/* Whether a group whose agents may run the machine sets the own value. */
static bool given(const JoScene *scene, const JoxMachine *machine, const char *name) {
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
    return !runs; /* something else becomes it, and brings its own values */
}

/* Whether an event of the scene gives the signal. */
static bool announced(const JoScene *scene, const char *text) {
    for (uint32_t e = 0; e < scene->spec->event_count; e++)
        if (scene->spec->events[e].kind == JOX_EVENT_SIGNAL &&
            strcmp(scene->spec->events[e].name, text) == 0)
            return true;
    return false;
}

/* Whether a function of a behaviour may give it. */
static bool may_be_called(const JoScene *scene, const char *text) {
    const JoxMachineSet *set = &scene->world->model.machines;
    bool may = false;
    for (uint32_t m = 0; m < set->count; m++)
        may |= set->items[m]->hook_count && jox_lua_may_signal(scene->lua, set->items[m], text);
    return may;
}

/* What an own value is called now that is asked for, and so has a slot, by the name that it had. */
static const char *renamed_own(const JoxMachine *machine, const char *name) {
    for (uint32_t r = 0; r < machine->renamed_count; r++)
        if (strcmp(machine->renamed[r].from, name) == 0 &&
            jox_machine_has(machine, JOX_PART_OWN, machine->renamed[r].to))
            return machine->renamed[r].to;
    return NULL;
}

void jox_run_check_own(const JoScene *scene, const JoxMachine *machine, const JoxLuaFile *files,
                       uint32_t count, JoxDiagnostics *diagnostics) {
    size_t before = diagnostics->count;
    for (uint32_t o = 0; o < machine->own_count; o++) {
        const JoxOwnSlot *slot = &machine->own[o];
        if (!*slot->name || slot->declared || jox_parameter_find(slot->name) >= 0 ||
            given(scene, machine, slot->name))
            continue;
        const char *names[JOX_PARAM_COUNT], *near;
        char hint[160];
        for (int p = 0; p < JOX_PARAM_COUNT; p++)
            names[p] = jox_parameters[p].name;
        near = jox_suggest(slot->name, names, JOX_PARAM_COUNT);
        const char *file = slot->source < count ? files[slot->source].path : machine->path;
        const char *now = renamed_own(machine, slot->name);
        if (now) {
            jox_diag_renamed(diagnostics,
                             ((JoxPosition){file, slot->line, slot->column, slot->end_column}),
                             slot->name, now);
            continue;
        }
        snprintf(hint, sizeof hint,
                 near ? "Did you mean 'own.%.60s'?" : "In the scene's group: set: {%.60s: ...}",
                 near ? near : slot->name);
        jox_diag_error(
            diagnostics, ((JoxPosition){file, slot->line, slot->column, slot->end_column}),
            "unknown-value", hint, "'%.60s' is no parameter, and no group that runs %s sets it",
            slot->name, machine->name);
    }
    if (diagnostics->count > before)
        attach(files, count, diagnostics);
}

/* Where a state or memory of others is named first. */
static JoxPosition named_at(const JoxMachine *machine, const JoxName *name, const JoxLuaFile *files,
                            uint32_t count) {
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
    return named_at(machine, name, files, count);
}

/* Whether walls of a name are closed from the start and stay so. */
static bool stays_closed(const JoScene *scene, const char *gate) {
    const JoxWalls *walls = &scene->world->model.all_walls;
    bool closed = false;
    for (uint32_t r = 0; r < walls->ring_count; r++)
        closed |= walls->rings[r].name && strcmp(walls->rings[r].name, gate) == 0 &&
                  !walls->rings[r].open;
    return closed && !jox_run_opens(scene, gate);
}

/* What a state or memory of others is called now that is named as it was called; else NULL. */
static const char *renamed_name(const JoxMachineRun *machines, const JoxName *name) {
    const char *now = NULL;
    if (name->uses & JOX_NAME_STATE)
        now = renamed(machines, JOX_PART_STATE, name->text);
    if (!now && (name->uses & JOX_NAME_MEMORY))
        now = renamed(machines, JOX_PART_MEMORY, name->text);
    return now;
}

void jox_run_check_names(const JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoxMachineRun *machines = &scene->world->machines;
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        const JoxPosition in = {machine->path, 0, 0, 0};
        uint32_t count;
        const JoxLuaFile *files = jox_lua_files(scene->lua, machine, &count);
        size_t before = diagnostics->count;
        jox_run_check_own(scene, machine, files, count, diagnostics);
        for (uint32_t n = 0; n < machine->name_count; n++) {
            const JoxName *name = &machine->names[n];
            const bool others = name->uses & (JOX_NAME_STATE | JOX_NAME_MEMORY);
            const JoxPosition at = others ? named_at(machine, name, files, count) : in;
            const char *now = renamed_name(machines, name);
            if (now) {
                jox_diag_renamed(diagnostics, at, name->text, now);
                continue;
            }
            bool heard = name->uses & JOX_NAME_HEARD, state = name->uses & JOX_NAME_STATE;
            if (heard && !is_signalled(machines, name->text) && !announced(scene, name->text) &&
                !may_be_called(scene, name->text))
                jox_diag_warn(diagnostics, find_wait(scene, machine, name, files, count),
                              "unheard-signal", NULL,
                              "no machine of the scene gives the signal '%s'", name->text);
            if ((name->uses & JOX_NAME_GATE) && stays_closed(scene, name->text))
                jox_diag_warn(diagnostics, find_wait(scene, machine, name, files, count),
                              "never-opened", "Add an event that opens it, or begin with it open",
                              "gate '%s' is closed, and nothing opens it", name->text);
            if (state && !is_state(machines, name->text))
                warn_of_state(machines, at, name->text, diagnostics);
            if ((name->uses & JOX_NAME_MACHINE) && !is_machine(machines, name->text))
                jox_diag_warn(diagnostics, in, "unknown-machine", NULL,
                              "no machine of the scene is called '%s'", name->text);
            if ((name->uses & JOX_NAME_MEMORY) && !is_public(machines, name->text))
                jox_diag_warn(diagnostics, at, "unknown-memory",
                              "In the machine that remembers it: public = { ... }",
                              "no machine of the scene makes memory '%s' public", name->text);
        }
        if (diagnostics->count > before)
            attach(files, count, diagnostics);
    }
    jox_run_check_tally(scene, diagnostics);
}

/* ---- mods ---- */

void jox_run_check_use(const JoScene *scene, const JoxMod *mod, JoxDiagnostics *diagnostics) {
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

/* ---- what is measured of those whom it does not suit ---- */

static const char WAY_OUT[] =
    "Where capacities matter: walker.lua, or time_gap = crowd.time_gap in the behaviour's defaults";

/* The first probe whose figures are those of a flow. */
static const JoxProbeDef *flow_of(const JoxSceneSpec *spec) {
    for (uint32_t p = 0; p < spec->probe_count; p++)
        if (spec->probes[p].kind == JOX_PROBE_FLOW || spec->probes[p].kind == JOX_PROBE_MEASURE)
            return &spec->probes[p];
    return NULL;
}

static bool goes_somewhere(const JoxState *state) {
    for (uint32_t t = 0; t < state->steer_count; t++)
        switch (state->steer[t].kind) {
        case JOX_STEER_SEEK:
        case JOX_STEER_ORBIT:
        case JOX_STEER_QUEUE:
        case JOX_STEER_FOLLOW:
        case JOX_STEER_FORMATION:
        case JOX_STEER_GATHER:
        case JOX_STEER_WANDER:
        case JOX_STEER_DRIFT:
        case JOX_STEER_ALONG:
        case JOX_STEER_FIELD:
            return true;
        default:
            break;
        }
    return false;
}

/* Whether who is in the state may keep a time gap, which makes them walk by the walking law. */
static bool keeps_time_gap(const JoxMachine *machine, const JoxState *state) {
    const JoxValue *gap = &state->param[JOX_PARAM_time_gap];
    if (gap->kind == JOX_VALUE_UNSET)
        gap = &machine->defaults[JOX_PARAM_time_gap];
    if (gap->kind == JOX_VALUE_OWN) {
        const JoxDist *dist = &machine->own[gap->index].dist;
        return dist->kind != JOX_DIST_CONSTANT || dist->a > 0.0;
    }
    return gap->kind == JOX_VALUE_EXPRESSION || gap->number > 0.0;
}

static bool is_given(const JoxGroup *group) {
    for (uint32_t s = 0; s < group->set_count; s++)
        if (strcmp(group->set[s].name, jox_parameters[JOX_PARAM_time_gap].name) == 0)
            return true;
    return false;
}

static const JoxMachine *machine_of(const JoScene *scene, const JoxGroupMix *mix) {
    const JoxMachineSet *set = scene->world->machines.set;
    for (uint32_t m = 0; m < set->count; m++)
        if (strcmp(set->items[m]->path, mix->behaviour) == 0)
            return set->items[m];
    return NULL;
}

static const JoxState *by_orca(const JoxMachine *machine) {
    for (uint32_t s = 0; machine && s < machine->state_count; s++)
        if (goes_somewhere(&machine->states[s]) && !keeps_time_gap(machine, &machine->states[s]))
            return &machine->states[s];
    return NULL;
}

bool jox_run_advise(const JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoxProbeDef *probe = flow_of(scene->spec);
    for (uint32_t g = 0; probe && g < scene->spec->group_count; g++) {
        const JoxGroup *group = &scene->spec->groups[g];
        for (uint32_t m = 0; m < group->mix_count && !is_given(group); m++) {
            const JoxMachine *machine = machine_of(scene, &group->mix[m]);
            const JoxState *state = by_orca(machine);
            if (!state)
                continue;
            jox_diag_add(diagnostics, JOX_SEVERITY_NOTE, group->mix[m].position, "orca-flow",
                         WAY_OUT, NULL, NULL,
                         "probe '%.60s' measures a flow, and in state %.60s of %.60s the people of "
                         "group '%.60s' choose velocities by ORCA, which is not fit for capacities",
                         probe->name, state->name, machine->name, group->name);
            return true;
        }
    }
    return false;
}
