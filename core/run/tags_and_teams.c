/* Numbers the tags and teams that behaviours name, and checks that they exist. Names that no
   group has yet get numbers too: states may set them. Writes these numbers, and what machines
   keep of earlier versions of their behaviours, into checkpoints, since the texts of a run do
   not tell them. scene_machines.c, reload_batch.c and resume/ call it. */
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "run/run.h"
#include "run/tags_and_teams.h"

/* A resumed run reads them from a text in memory under this name. */
const char jox_run_kept_names_path[] = "<tags and teams>";

void jox_run_refresh_tags_and_teams(JoScene *scene) {
    const JoxWorldModel *model = &scene->world->model;
    scene->scope.tags = (const char *const *)model->tags;
    scene->scope.tag_count = model->tag_count;
    scene->scope.set_teams = (const char *const *)model->set_teams;
    scene->scope.set_team_count = model->set_team_count;
}

void jox_run_number_tags_and_teams(JoScene *scene, JoxMachine *machine) {
    uint16_t *numbers = jox_alloc((size_t)machine->belonging_count + 1, sizeof *numbers);
    for (uint32_t n = 0; n < machine->belonging_count; n++) {
        const JoxBelonging *b = &machine->belongings[n];
        int number = b->number;
        if (!b->is_team)
            number = jox_world_add_tag(scene->world, b->name);
        else if (b->number >= JOX_FIRST_SET_TEAM)
            number = jox_world_add_team(scene->world, b->name);
        /* Several machines that join at once may have too many names: the last ones keep numbers
           that no agent has. */
        numbers[n] = (uint16_t)(number < 0 ? b->number : number);
    }
    jox_machine_renumber(machine, numbers);
    jox_free(numbers);
    jox_run_refresh_tags_and_teams(scene);
}

uint64_t jox_run_number_tags(JoScene *scene, char *const *tags, uint32_t count,
                             JoxPosition position, JoxDiagnostics *diagnostics) {
    uint64_t bits = 0;
    for (uint32_t t = 0; t < count; t++) {
        const int number = jox_world_add_tag(scene->world, tags[t]);
        if (number >= 0)
            bits |= (uint64_t)1 << number;
        else if (diagnostics)
            jox_diag_error(diagnostics, position, "too-many-tags", NULL,
                           "a scene has at most 64 different tags");
    }
    return bits;
}

/* ---- what is asked for ---- */

static bool contains_tag(char *const *tags, uint32_t count, const char *name) {
    for (uint32_t t = 0; t < count; t++)
        if (strcmp(tags[t], name) == 0)
            return true;
    return false;
}

static bool is_tag_given(const JoxSceneSpec *spec, const char *name) {
    for (uint32_t b = 0; b < spec->body_count; b++)
        if (contains_tag(spec->bodies[b].tags, spec->bodies[b].tag_count, name))
            return true;
    for (uint32_t g = 0; g < spec->group_count; g++)
        if (contains_tag(spec->groups[g].tags, spec->groups[g].tag_count, name))
            return true;
    return false;
}

/* Whether one of `machines` sets the tag (`set`), or else asks for it. */
static bool is_tag_used(const JoxMachine *const *machines, uint32_t count, const char *name,
                        bool set) {
    for (uint32_t m = 0; m < count; m++)
        for (uint32_t n = 0; n < machines[m]->belonging_count; n++) {
            const JoxBelonging *b = &machines[m]->belongings[n];
            if ((set ? b->is_set : b->is_asked) && !b->is_team && strcmp(b->name, name) == 0)
                return true;
        }
    return false;
}

enum { MOST_NAMES = 256 };

/* Collects the tags that are on bodies and groups or set by machines, or the teams of groups.
   Returns the count. */
static size_t collect_names(const JoxSceneSpec *spec, const JoxMachine *const *machines,
                            uint32_t count, bool teams, const char *names[MOST_NAMES]) {
    size_t n = 0;
    for (uint32_t g = 0; g < spec->group_count; g++) {
        const JoxGroup *group = &spec->groups[g];
        if (teams && group->team && n < MOST_NAMES)
            names[n++] = group->team;
        for (uint32_t t = 0; !teams && t < group->tag_count && n < MOST_NAMES; t++)
            names[n++] = group->tags[t];
    }
    for (uint32_t b = 0; b < spec->body_count && !teams; b++)
        for (uint32_t t = 0; t < spec->bodies[b].tag_count && n < MOST_NAMES; t++)
            names[n++] = spec->bodies[b].tags[t];
    for (uint32_t m = 0; m < count && !teams; m++)
        for (uint32_t k = 0; k < machines[m]->belonging_count && n < MOST_NAMES; k++)
            if (machines[m]->belongings[k].is_set && !machines[m]->belongings[k].is_team)
                names[n++] = machines[m]->belongings[k].name;
    return n;
}

/* Warns of a name that is set and used nowhere else but resembles another: it may be misspelt. */
static void warn_of_new_name(const JoxBelonging *b, JoxPosition at, const char *const *names,
                             size_t count, JoxDiagnostics *diagnostics) {
    char hint[JOX_HINT];
    const char *near = jox_did_you_mean(b->name, names, count, hint);
    if (near)
        jox_diag_warn(diagnostics, at, b->is_team ? "new-team" : "new-tag", near,
                      b->is_team ? "no group of the scene has the team '%s': it is a new one"
                                 : "nothing asks for the tag '%s', which this sets",
                      b->name);
}

void jox_run_check_tags_and_teams(const JoScene *scene, const JoxMachine *machine,
                                  const JoxLuaFile *files, uint32_t file_count,
                                  const JoxMachine *const *machines, uint32_t count,
                                  JoxDiagnostics *diagnostics) {
    const JoxSceneSpec *spec = scene->spec;
    for (uint32_t n = 0; n < machine->belonging_count; n++) {
        const JoxBelonging *b = &machine->belongings[n];
        const char *file = b->source < file_count ? files[b->source].path : machine->path;
        const JoxPosition at = {file, b->line, b->column, b->end_column};
        const char *names[MOST_NAMES], *others[MOST_NAMES];
        char hint[JOX_HINT];
        const size_t name_count = collect_names(spec, machines, count, b->is_team, names);
        size_t other_count = 0;
        for (size_t k = 0; k < name_count; k++)
            if (strcmp(names[k], b->name) != 0)
                others[other_count++] = names[k];
        if (b->is_team) {
            if (b->number >= JOX_FIRST_SET_TEAM)
                warn_of_new_name(b, at, others, other_count, diagnostics);
            continue;
        }
        if (is_tag_given(spec, b->name))
            continue;
        if (!is_tag_used(machines, count, b->name, true))
            jox_diag_error(
                diagnostics, at, "unknown-tag", jox_did_you_mean(b->name, names, name_count, hint),
                "nothing in the scene bears the tag '%s', and no state sets it", b->name);
        else if (!is_tag_used(machines, count, b->name, false))
            warn_of_new_name(b, at, others, other_count, diagnostics);
    }
}

/* ---- runs that go on ---- */

/* Writes the memory and own values that a machine keeps of earlier versions of its behaviour. */
static void write_kept_slots(const JoxMachine *machine, JoxText *out) {
    for (uint32_t s = 0; s < machine->own_count; s++) {
        const JoxOwnSlot *own = &machine->own[s];
        if (!own->kept || strpbrk(own->name, "\t\n"))
            continue;
        jox_text_printf(out, "own\t%s\t%d %d %d\t%a %a %a %a", machine->path, own->dist.kind,
                        own->dist.choices, own->is_place, own->dist.a, own->dist.b, own->dist.lo,
                        own->dist.hi);
        for (int c = 0; c < JOX_DIST_CHOICES; c++)
            jox_text_printf(out, " %a", own->dist.values[c]);
        jox_text_printf(out, "\t%s\n", own->name);
    }
    for (uint32_t s = 0; s < machine->memory_count; s++)
        if (machine->memory[s].dormant && !strpbrk(machine->memory[s].identity, "\t\n"))
            jox_text_printf(out, "memory\t%s\t%d\t%a\t%s\n", machine->path,
                            (int)machine->memory[s].kind, machine->memory[s].initial,
                            machine->memory[s].identity);
}

void jox_run_write_kept_names(const JoScene *scene, JoxText *out) {
    const JoxWorldModel *model = &scene->world->model;
    for (uint32_t t = 0; t < model->tag_count; t++)
        jox_text_printf(out, "tag %s\n", model->tags[t]);
    for (uint32_t t = 0; t < model->set_team_count; t++)
        jox_text_printf(out, "team %s\n", model->set_teams[t]);
    for (uint32_t m = 0; m < model->machines.count; m++)
        write_kept_slots(model->machines.built[m], out);
}

/* Ends a field at its tab. Returns the next field, or NULL. */
static char *next_field(char *at) {
    char *tab = at ? strchr(at, '\t') : NULL;
    if (tab)
        *tab++ = 0;
    return tab;
}

enum { DIST_NUMBERS = 4 + JOX_DIST_CHOICES, MOST_OWN = 1000 };

static void restore_own_slot(JoxMachine *machine, char *kinds, const double *n, const char *name) {
    JoxOwnSlot own = {
        .kept = true, .declared = true, .dist = {.a = n[0], .b = n[1], .lo = n[2], .hi = n[3]}};
    const long kind = strtol(kinds, &kinds, 10), choices = strtol(kinds, &kinds, 10);
    own.is_place = strtol(kinds, &kinds, 10) != 0;
    if (kind < 0 || kind >= JOX_DIST_KINDS || choices < 0 || choices > JOX_DIST_CHOICES ||
        machine->own_count >= MOST_OWN)
        return;
    own.dist.kind = (JoxDistKind)kind;
    own.dist.choices = (int)choices;
    memcpy(own.dist.values, n + 4, sizeof own.dist.values);
    own.name = jox_strdup(name);
    machine->own = jox_realloc(machine->own, machine->own_count + 1, sizeof *machine->own);
    machine->own[machine->own_count++] = own;
}

/* Adds the slot of a line to the machine, if the line is about it. */
static void restore_kept_slot(JoxMachine *machine, char *line) {
    char *path = next_field(line), *number = next_field(path), *value = next_field(number),
         *name = next_field(value);
    double numbers[DIST_NUMBERS] = {0};
    if (!name || strcmp(path, machine->path) != 0)
        return;
    for (int n = 0; n < DIST_NUMBERS && *value; n++) {
        numbers[n] = strtod(value, &value);
        value += *value == ' ';
    }
    const int kind = *number - '0';
    if (strcmp(line, "own") == 0)
        restore_own_slot(machine, number, numbers, name);
    else if (strcmp(line, "memory") == 0 && kind >= 0 && kind < JOX_MEMORY_KINDS &&
             machine->memory_count < 64 + 3 * JOX_MOST_DORMANT)
        jox_dormant_add(machine, name, (JoxMemoryKind)kind, numbers[0]);
}

void jox_run_restore_kept_slots(JoxMachine *machine) {
    const JoxOverlayFile *file = jox_overlay_file(jox_run_kept_names_path);
    char *text = file ? jox_strndup(file->text, file->length) : NULL;
    for (char *line = text; line && *line;) {
        char *end = strchr(line, '\n');
        if (!end)
            break;
        *end = 0;
        restore_kept_slot(machine, line);
        line = end + 1;
    }
    jox_free(text);
}

void jox_run_restore_tags_and_teams(JoScene *scene) {
    const JoxOverlayFile *file = jox_overlay_file(jox_run_kept_names_path);
    char name[80];
    for (const char *line = file ? file->text : NULL; line && *line;
         line = strchr(line, '\n') + 1) {
        if (!strchr(line, '\n'))
            return;
        const bool team = strncmp(line, "team ", 5) == 0;
        const char *text = line + (team ? 5 : 4);
        if (!team && strncmp(line, "tag ", 4) != 0)
            return;
        snprintf(name, sizeof name, "%.*s", (int)strcspn(text, "\n"), text);
        if (team)
            jox_world_add_team(scene->world, name);
        else
            jox_world_add_tag(scene->world, name);
    }
}
