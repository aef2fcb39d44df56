/* The page of a report: what a run measured, how far half the step changes it, and what that is
   worth. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "jostle_tools.h"
#include "picture/html.h"
#include "picture/paths.h"
#include "picture/plot.h"
#include "report/page_parts.h"
#include "run/run.h"

/* The summary's figures, in an order that two runs of a scene share. */
static JoxPageFigures collect(const JoScene *scene) {
    const JoxStatistics *s = &scene->world->state.statistics;
    JoxPageFigures f = {0};
    jox_page_add(&f, "", scene->world->state.agents.count, "people at the end");
    const JoxRegions *regions = jox_run_regions(scene);
    jox_page_add(&f, "", jox_statistics_overlap_p99(s),
                 "overlap that 99 %% stay below, share of a diameter");
    jox_page_add(&f, "", s->agent_steps ? (double)s->failures / (double)s->agent_steps : NAN,
                 "share of agent-steps whose 2-D program failed");
    jox_page_add_exits(&f, &scene->world->state.exits, scene->world->state.agents.count);
    jox_page_add_danger(&f, jox_run_danger(scene));
    for (uint32_t r = 0; regions && r < regions->count; r++)
        jox_page_add(&f, "m/s",
                     regions->items[r].people ? jox_region_speed(&regions->items[r]) : NAN,
                     "mean speed in region %.60s", regions->items[r].name);
    const JoxProbe *probe;
    for (uint32_t p = 0; (probe = jox_run_probe(scene, p)); p++)
        jox_page_add_probe(&f, probe);
    return f;
}

/* ---- parts of the page ---- */

static void put_change(FILE *out, double whole, double half) {
    double change = half - whole;
    fputs("<td class=n>", out);
    if (isfinite(change) && whole != 0.0)
        fprintf(out, "%+.3g (%+.1f&nbsp;%%)", change, 100.0 * change / fabs(whole));
    else if (isfinite(change))
        fprintf(out, "%+.3g", change);
    else
        fputs("&ndash;", out);
}

static void put_figures(FILE *out, const JoScene *scene, const JoScene *half, const char *why) {
    JoxPageFigures whole = collect(scene), other = {0};
    char heads[128], text[512];
    jox_html_heading(out, "Figures");
    if (half) {
        other = collect(half);
        snprintf(text, sizeof text,
                 "The same run with the same seed was repeated at half the step, %g s. A figure is "
                 "worth no more digits than the two agree on; at another step chance falls "
                 "otherwise, too, so that single runs differ as two seeds do.",
                 half->world->model.def.dt);
        snprintf(heads, sizeof heads, "figure|step %g s|step %g s|difference",
                 scene->world->model.def.dt, half->world->model.def.dt);
    } else {
        snprintf(text, sizeof text, "The run was not repeated at half the step: %s.",
                 why ? why : "nobody asked for it");
        snprintf(heads, sizeof heads, "figure|step %g s", scene->world->model.def.dt);
    }
    jox_html_paragraph(out, text);
    jox_html_table(out, heads);
    for (uint32_t i = 0; i < whole.count; i++) {
        const JoxPageFigure *a = &whole.items[i];
        jox_html_row(out);
        jox_html_cell(out, a->name);
        jox_page_value(out, a);
        if (!half)
            continue;
        /* by name: one run may have left somebody elsewhere, the other not */
        const JoxPageFigure *b = NULL;
        for (uint32_t k = 0; k < other.count && !b; k++)
            b = strcmp(other.items[k].name, a->name) == 0 ? &other.items[k] : NULL;
        if (b)
            jox_page_value(out, b);
        else
            jox_html_cell_number(out, NAN, a->unit);
        put_change(out, a->value, b ? b->value : NAN);
    }
    jox_html_table_end(out);
    jox_page_release(&whole);
    jox_page_release(&other);
}

static void put_pictures(FILE *out, const JoScene *scene, const char *directory) {
    const JoxProbe *probe;
    jox_html_heading(out, "Pictures");
    jox_page_danger_pictures(out, directory);
    jox_page_picture(out, directory, "density", "Mean density");
    jox_page_picture(out, directory, "regions", "Mean speed of the regions");
    if (scene->world->state.agents.next_id <= JOX_MOST_PATHS)
        jox_page_picture(out, directory, "paths", "Paths");
    for (uint32_t p = 0; (probe = jox_run_probe(scene, p)); p++)
        jox_page_probe(out, directory, probe);
}

/* Whether the flows on the page are of people who walk by the walking law. */
static void put_advice(FILE *out, const JoScene *scene) {
    JoxDiagnostics notes = {0};
    char text[1024];
    if (jox_run_advise(scene, &notes)) {
        snprintf(text, sizeof text, "Note: %s. %s.", notes.items[0].message, notes.items[0].hint);
        jox_html_paragraph(out, text);
    }
    jox_diag_free(&notes);
}

static void put_inputs(FILE *out, const JoScene *scene) {
    const JoSceneDef *def = &scene->def;
    const JoWorld *world = scene->world;
    jox_html_heading(out, "How to repeat it");
    fputs("<p><code>jostle run ", out);
    jox_html_argument(out, def->path);
    fprintf(out, " --seed %llu --dt %g --steps %llu", (unsigned long long)world->model.def.seed,
            world->model.def.dt, (unsigned long long)world->state.statistics.steps);
    for (size_t i = 0; i < def->override_count; i++) {
        fputs(" --set ", out);
        jox_html_argument(out, def->overrides[i]);
    }
    fprintf(out, "</code>: state hash %016llx, whatever the number of threads.</p>\n",
            (unsigned long long)jox_world_hash(world));
    jox_html_table(out, "input|SHA-256");
    for (uint32_t f = 0; f < scene->spec->file_count; f++) {
        jox_html_row(out);
        jox_html_cell(out, scene->spec->files[f].path);
        jox_html_cell(out, scene->spec->files[f].sha256);
    }
    for (uint32_t m = 0; m < world->model.machines.count; m++) {
        uint32_t count;
        const JoxLuaFile *files = jox_lua_files(scene->lua, world->model.machines.items[m], &count);
        for (uint32_t f = 0; f < count; f++) {
            jox_html_row(out);
            jox_html_cell(out, files[f].path);
            jox_html_cell(out, files[f].sha256);
        }
    }
    if (scene->input_path) {
        jox_html_row(out);
        jox_html_cell(out, scene->input_path);
        jox_html_cell(out, scene->input_sha256);
    }
    jox_html_table_end(out);
    for (uint32_t m = 0; m < scene->mods->count; m++) {
        char mod[300];
        snprintf(mod, sizeof mod, "With the mod %.100s %.40s.", scene->mods->items[m].name,
                 scene->mods->items[m].version);
        jox_html_paragraph(out, mod);
    }
}

bool jo_scene_page(const JoScene *scene, const JoScene *half, const char *why,
                   const char *directory, JoError *error) {
    JOX_REQUIRE(scene && scene->finished && jox_run_danger(scene) && directory, false);
    JOX_REQUIRE(!half || (half->finished && jox_run_danger(half)), false);
    JOX_GUARD (NULL, error)
        return false;
    JoxText text = {0};
    FILE *out = jox_plot_open(directory, "index.html", &text);
    const JoWorld *world = scene->world;
    if (out) {
        char line[512];
        jox_html_begin(out, scene->spec->title ? scene->spec->title : scene->spec->path);
        snprintf(line, sizeof line,
                 "%.200s, %.1f s, seed %llu, step %g s, %u people at the end; Jostle %s.",
                 scene->spec->path, jo_world_time(world), (unsigned long long)world->model.def.seed,
                 world->model.def.dt, world->state.agents.count, jo_version());
        jox_html_paragraph(out, line);
        put_pictures(out, scene, directory);
        jox_page_danger(out, jox_run_danger(scene));
        put_figures(out, scene, half, why);
        jox_page_validation(out);
        jox_html_paragraph(
            out,
            "None of that validates this scenario. Its geometry, numbers of people, behaviours and "
            "parameters are what its author gave; nothing on this page was compared with a crowd "
            "that did this here. Load in particular is a model's: forces inside real crowds "
            "of this size have hardly been measured, the contacts are those of discs, and the "
            "limits come from single persons and from what was found after disasters. Read the "
            "limits as places and times to look at, not as a count of injured; run several seeds "
            "before comparing plans.");
        put_advice(out, scene);
        put_inputs(out, scene);
        jox_html_end(out);
    }
    bool good = out && jox_plot_close(out, "index.html", &text);
    if (good)
        jox_run_say(scene, "report: %s/index.html\n", directory);
    else
        jox_error(error, JO_FAILED, "%s", text.data ? text.data : "writing failed");
    jox_text_free(&text);
    return good;
}
