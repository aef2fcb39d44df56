/* Tags and teams that behaviours name: they get their numbers in the scene, also those that nobody
   has yet and states set, and what is asked for must be borne or set by somebody. */
#include <string.h>

#include "base/mem.h"
#include "run/run.h"

/* Text in memory by which a resumed run gets the numbers that tags and teams had. */
const char jox_run_names_path[] = "<tags and teams>";

void jox_run_refresh_names(JoScene *scene) {
    const JoxWorldModel *model = &scene->world->model;
    scene->scope.tags = (const char *const *)model->tags;
    scene->scope.tag_count = model->tag_count;
    scene->scope.set_teams = (const char *const *)model->set_teams;
    scene->scope.set_team_count = model->set_team_count;
}

void jox_run_number_belongings(JoScene *scene, JoxMachine *machine) {
    uint16_t *numbers = jox_alloc((size_t)machine->belonging_count + 1, sizeof *numbers);
    for (uint32_t n = 0; n < machine->belonging_count; n++) {
        const JoxBelonging *b = &machine->belongings[n];
        int number = b->number;
        if (!b->is_team)
            number = jox_world_tag(scene->world, b->name);
        else if (b->number >= JOX_FIRST_SET_TEAM)
            number = jox_world_set_team(scene->world, b->name);
        /* Those of several machines that are put in at once may be too many: the last are nobody's.
         */
        numbers[n] = (uint16_t)(number < 0 ? b->number : number);
    }
    jox_machine_renumber(machine, numbers);
    jox_free(numbers);
    jox_run_refresh_names(scene);
}

/* ---- what is asked for ---- */

static bool lists(char *const *tags, uint32_t count, const char *name) {
    for (uint32_t t = 0; t < count; t++)
        if (strcmp(tags[t], name) == 0)
            return true;
    return false;
}

static bool is_borne(const JoxSceneSpec *spec, const char *name) {
    for (uint32_t b = 0; b < spec->body_count; b++)
        if (lists(spec->bodies[b].tags, spec->bodies[b].tag_count, name))
            return true;
    for (uint32_t g = 0; g < spec->group_count; g++)
        if (lists(spec->groups[g].tags, spec->groups[g].tag_count, name))
            return true;
    return false;
}

static bool is_set(const JoxMachine *const *machines, uint32_t count, const char *name) {
    for (uint32_t m = 0; m < count; m++)
        for (uint32_t n = 0; n < machines[m]->belonging_count; n++) {
            const JoxBelonging *b = &machines[m]->belongings[n];
            if (b->is_set && !b->is_team && strcmp(b->name, name) == 0)
                return true;
        }
    return false;
}

enum { MOST_NAMES = 256 };

/* Tags that are borne or set, or teams that groups have; returns how many. */
static size_t list_names(const JoxSceneSpec *spec, const JoxMachine *const *machines,
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

static bool is_asked(const JoxMachine *const *machines, uint32_t count, const char *name) {
    for (uint32_t m = 0; m < count; m++)
        for (uint32_t n = 0; n < machines[m]->belonging_count; n++) {
            const JoxBelonging *b = &machines[m]->belongings[n];
            if (b->is_asked && !b->is_team && strcmp(b->name, name) == 0)
                return true;
        }
    return false;
}

/* A name that is set and that nothing else knows, and is like another: it may be misspelt. */
static void warn_of_new(const JoxBelonging *b, JoxPosition at, const char *const *names,
                        size_t count, JoxDiagnostics *diagnostics) {
    char hint[JOX_HINT];
    const char *near = jox_did_you_mean(b->name, names, count, hint);
    if (near)
        jox_diag_warn(diagnostics, at, b->is_team ? "new-team" : "new-tag", near,
                      b->is_team ? "no group of the scene has the team '%s': it is a new one"
                                 : "nothing asks for the tag '%s', which this sets",
                      b->name);
}

void jox_run_check_belongings(const JoScene *scene, const JoxMachine *machine,
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
        const size_t name_count = list_names(spec, machines, count, b->is_team, names);
        size_t other_count = 0;
        for (size_t k = 0; k < name_count; k++)
            if (strcmp(names[k], b->name) != 0)
                others[other_count++] = names[k];
        if (b->is_team) {
            if (b->number >= JOX_FIRST_SET_TEAM)
                warn_of_new(b, at, others, other_count, diagnostics);
            continue;
        }
        if (is_borne(spec, b->name))
            continue;
        if (!is_set(machines, count, b->name))
            jox_diag_error(
                diagnostics, at, "unknown-tag", jox_did_you_mean(b->name, names, name_count, hint),
                "nothing in the scene bears the tag '%s', and no state sets it", b->name);
        else if (!is_asked(machines, count, b->name))
            warn_of_new(b, at, others, other_count, diagnostics);
    }
}

/* ---- runs that go on ---- */

void jox_run_list_names(const JoScene *scene, JoxText *out) {
    const JoxWorldModel *model = &scene->world->model;
    for (uint32_t t = 0; t < model->tag_count; t++)
        jox_text_printf(out, "tag %s\n", model->tags[t]);
    for (uint32_t t = 0; t < model->set_team_count; t++)
        jox_text_printf(out, "team %s\n", model->set_teams[t]);
}

void jox_run_take_names(JoScene *scene) {
    const JoxOverlayFile *file = jox_overlay_file(jox_run_names_path);
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
            jox_world_set_team(scene->world, name);
        else
            jox_world_tag(scene->world, name);
    }
}
