/* Finds the parameters that scenes and behaviours of the claims set to other values than the
   engine's defaults, for a table on the page. */
#include <stdio.h>
#include <string.h>

#include "agents/parameters.h"
#include "base/format/installed.h"
#include "base/format/path.h"
#include "base/format/quote.h"
#include "base/mem.h"
#include "picture/html.h"
#include "validate/reproduce.h"

/* A parameter's value, where it is set, and the claims that use it. */
typedef struct Deviation {
    int parameter;    /* index of the parameter; -1, -2: rows of FORCES */
    char *where;      /* file, and the state or group in it */
    char *value;      /* the value as written */
    const char *last; /* id of the claim added last */
    JoxText claims;   /* ids as links in HTML */
} Deviation;

/* A behaviour, loaded once for all claims. */
typedef struct Behaviour {
    char *path;
    JoxMachine *machine; /* NULL if it does not load */
} Behaviour;

typedef struct Deviations {
    JoxLua *lua;
    Deviation *rows;
    uint32_t row_count, row_capacity;
    Behaviour *behaviours;
    uint32_t behaviour_count, behaviour_capacity;
    const JoxClaim *claim; /* the claim being examined */
    uint32_t number;       /* its number on the page */
} Deviations;

/* Keys of scenes with the engine's defaults. */
static const char *const FORCES[][2] = {{"forces.enabled", "true"}, {"forces.mode", "physical"}};

/* Adds the current claim to the row of a parameter, value and place, which is created if needed. */
static void add_deviation(Deviations *d, int parameter, const char *where, const char *value) {
    Deviation *row = NULL;
    for (uint32_t r = 0; r < d->row_count && !row; r++)
        if (d->rows[r].parameter == parameter && !strcmp(d->rows[r].where, where) &&
            !strcmp(d->rows[r].value, value))
            row = &d->rows[r];
    if (!row) {
        JOX_RESERVE(d->rows, d->row_capacity, d->row_count + 1);
        row = &d->rows[d->row_count++];
        *row = (Deviation){
            .parameter = parameter, .where = jox_strdup(where), .value = jox_strdup(value)};
    }
    if (row->last == d->claim->id)
        return;
    jox_text_printf(&row->claims, "%s<a href=\"#c%u\">", row->last ? ", " : "", d->number);
    jox_quote_xml(&row->claims, d->claim->id);
    jox_text_add(&row->claims, "</a>");
    row->last = d->claim->id;
}

/* Writes a path without the folder of installed files, which is of no interest. */
static void shorten_path(const char *path, char out[512]) {
    char clean[1024];
    const char *data = jox_data_folder();
    size_t n = strlen(data);
    snprintf(clean, sizeof clean, "%s", path);
    jox_path_clean(clean);
    bool installed = strncmp(clean, data, n) == 0 && clean[n] == '/';
    snprintf(out, 512, "%.500s", installed ? clean + n + 1 : clean);
}

/* ---- behaviours ---- */

static void keep_last_setting(void *context, const JoSetting *setting) {
    JoxText *out = context;
    out->length = 0;
    jox_text_add(out, setting->value ? setting->value : "");
    if (setting->unit && *setting->unit)
        jox_text_printf(out, " %s", setting->unit);
}

/* Appends the value of a machine's path as it is written, in the place that sets it last. */
static void read_written_value(const Deviations *d, const JoxMachine *machine, const char *path,
                               JoxText *out) {
    static const JoxScope ANY = {0};
    jox_lua_why(d->lua, machine, path, &ANY, keep_last_setting, out);
}

/* Returns whether a value is the engine's default. Machines store defaults that they do not set
   as an own value of each agent, which is constant then. */
static bool is_engine_default(const JoxMachine *machine, int p, const JoxValue *value) {
    if (value->kind == JOX_VALUE_OWN) {
        const JoxDist *dist = &machine->own[value->index].dist;
        return dist->kind == JOX_DIST_CONSTANT && dist->a == jox_parameters[p].value;
    }
    return value->kind == JOX_VALUE_UNSET ||
           (value->kind == JOX_VALUE_CONST && value->number == jox_parameters[p].value);
}

/* Adds a deviation if a machine's value of parameter p is not the default; `owner` is the state,
   NULL for the machine's defaults. */
static void compare_value(Deviations *d, const JoxMachine *machine, const char *file,
                          const char *owner, int p, const JoxValue *value) {
    char path[200], where[700];
    JoxText text = {0};
    if (is_engine_default(machine, p, value))
        return;
    snprintf(path, sizeof path, "%.100s.%s", owner ? owner : "defaults", jox_parameters[p].name);
    snprintf(where, sizeof where, "%s%s%.100s", file, owner ? ", state " : "", owner ? owner : "");
    read_written_value(d, machine, path, &text);
    add_deviation(d, p, where, text.length ? text.data : "an expression");
    jox_text_free(&text);
}

/* Compares all parameters of a behaviour, which is loaded at its first use. */
static void compare_behaviour(Deviations *d, const char *path) {
    char file[512];
    Behaviour *behaviour = NULL;
    for (uint32_t k = 0; k < d->behaviour_count && !behaviour; k++)
        behaviour = strcmp(d->behaviours[k].path, path) == 0 ? &d->behaviours[k] : NULL;
    if (!behaviour) {
        static const JoxScope ANY = {0};
        JoxDiagnostics unread = {0};
        JOX_RESERVE(d->behaviours, d->behaviour_capacity, d->behaviour_count + 1);
        behaviour = &d->behaviours[d->behaviour_count++];
        *behaviour = (Behaviour){jox_strdup(path), jox_lua_load(d->lua, path, &ANY, &unread)};
        jox_diag_free(&unread);
    }
    shorten_path(path, file);
    for (int p = 0; behaviour->machine && p < JOX_PARAM_COUNT; p++) {
        const JoxMachine *m = behaviour->machine;
        compare_value(d, m, file, NULL, p, &m->defaults[p]);
        for (uint32_t s = 0; s < m->state_count; s++)
            compare_value(d, m, file, m->states[s].name, p, &m->states[s].param[p]);
    }
}

/* ---- scenes ---- */

/* Compares the behaviours and settings of a scene's group. */
static void compare_group(Deviations *d, const char *scene, const JoxGroup *group) {
    char where[700];
    snprintf(where, sizeof where, "%s, group %.100s", scene, group->name);
    for (uint32_t m = 0; m < group->mix_count; m++)
        compare_behaviour(d, group->mix[m].behaviour);
    for (uint32_t s = 0; s < group->set_count; s++) {
        const JoxGroupValue *set = &group->set[s];
        int p = jox_parameter_find(set->name);
        JoxText text = {0};
        if (p < 0 || set->kind != JOX_SET_NUMBER ||
            (set->dist.kind == JOX_DIST_CONSTANT && set->dist.a == jox_parameters[p].value))
            continue;
        jox_dist_print(&set->dist, &text);
        add_deviation(d, p, where, text.data);
        jox_text_free(&text);
    }
}

/* Compares the scene of a run, with the run's settings. */
static void compare_claim_run(Deviations *d, const JoxClaimRun *run) {
    char file[512];
    JoxDiagnostics unread = {0}; /* a scene that does not load has already failed as a run */
    JoxSceneOptions options = {.sets = (const char *const *)run->sets, .set_count = run->set_count};
    JoxSceneSpec *spec = jox_scene_read(run->scene, &options, &unread);
    jox_diag_free(&unread);
    if (!spec)
        return;
    shorten_path(run->scene, file);
    if (!spec->forces)
        add_deviation(d, -1, file, "false");
    if (spec->literal)
        add_deviation(d, -2, file, "literal");
    for (uint32_t g = 0; g < spec->group_count; g++)
        compare_group(d, file, &spec->groups[g]);
    jox_scene_free(spec);
}

/* ---- the table ---- */

static void put_deviation_row(FILE *out, const Deviation *row) {
    jox_html_row(out);
    if (row->parameter < 0) {
        jox_html_cell(out, FORCES[-1 - row->parameter][0]);
        jox_html_cell(out, FORCES[-1 - row->parameter][1]);
    } else {
        const JoxParameterInfo *info = &jox_parameters[row->parameter];
        jox_html_cell(out, info->name);
        jox_html_cell_number(out, info->value, info->unit);
    }
    fputs("<td><code>", out);
    jox_html_text(out, row->value);
    fputs("</code>", out);
    jox_html_cell(out, row->where);
    fputs("<td>", out);
    fputs(row->claims.data, out); /* already escaped */
}

void jox_reproduce_put_deviations(const JoxReproduction *all, FILE *out) {
    Deviations d = {.lua = jox_lua_create(NULL)};
    for (uint32_t o = 0; o < all->outcome_count; o++) {
        d.claim = all->outcomes[o].claim;
        d.number = o;
        for (uint32_t r = 0; r < d.claim->run_count; r++)
            compare_claim_run(&d, &d.claim->runs[r]);
    }
    jox_html_heading(out, "Settings that differ from the defaults");
    jox_html_paragraph(out,
                       "Every parameter that a scene's group, a behaviour, or one of its states "
                       "sets to another value than the default, for the claims on this page.");
    fputs("<details><summary>All settings</summary>\n", out);
    jox_html_table(out, "parameter|default|set to|by|claims");
    for (int p = -2; p < JOX_PARAM_COUNT; p++) /* in the order of the table of defaults */
        for (uint32_t r = 0; r < d.row_count; r++)
            if (d.rows[r].parameter == p)
                put_deviation_row(out, &d.rows[r]);
    jox_html_table_end(out);
    fputs("</details>\n", out);
    for (uint32_t r = 0; r < d.row_count; r++) {
        jox_free(d.rows[r].where);
        jox_free(d.rows[r].value);
        jox_text_free(&d.rows[r].claims);
    }
    for (uint32_t k = 0; k < d.behaviour_count; k++) {
        jox_free(d.behaviours[k].path);
        jox_machine_free(d.behaviours[k].machine);
    }
    jox_free(d.rows);
    jox_free(d.behaviours);
    jox_lua_free(d.lua);
}
