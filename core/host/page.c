/* The page of a report: what a run measured, how far half the step changes it, and what that is
   worth. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/mem.h"
#include "host/host.h"
#include "record/html.h"
#include "record/plot.h"

/* One figure of a run. */
typedef struct Figure {
    char *name;
    const char *unit;
    double value;
} Figure;
typedef struct Figures {
    Figure *items;
    uint32_t count, capacity;
} Figures;

static void add(Figures *f, const char *unit, double value, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
static void add(Figures *f, const char *unit, double value, const char *format, ...) {
    char name[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(name, sizeof name, format, arguments);
    va_end(arguments);
    JOX_RESERVE(f->items, f->capacity, f->count + 1);
    f->items[f->count++] = (Figure){jox_strdup(name), unit, value};
}

static void add_exits(Figures *f, const JoxExits *exits) {
    uint64_t known = 0;
    add(f, "", (double)exits->left, "people who left");
    add(f, "s", exits->left ? exits->last : NAN, "clearance: when the last of them left");
    for (uint32_t e = 0; e < exits->count; e++) {
        add(f, "", exits->items[e].people, "people who left at %.60s", exits->items[e].name);
        add(f, "s", exits->items[e].last, "when the last of them left at %.60s",
            exits->items[e].name);
        known += exits->items[e].people;
    }
    if (exits->count && exits->left > known)
        add(f, "", (double)(exits->left - known), "people who left elsewhere");
}

static void add_probes(Figures *f, const JoScene *scene) {
    const JoxProbe *probe;
    for (uint32_t p = 0; (probe = jox_host_probe(scene, p)); p++) {
        JoxFigures figures = jox_probe_figures(probe);
        for (uint32_t i = 0; i < figures.count; i++)
            add(f, figures.items[i].unit, figures.items[i].value, "%.60s: %.60s",
                jox_probe_def(probe)->name, figures.items[i].name);
    }
}

/* The summary's figures, in an order that two runs of a scene share. */
static Figures collect(const JoScene *scene) {
    const JoxStatistics *s = &scene->world->statistics;
    Figures f = {0};
    add(&f, "", scene->world->agents.count, "people at the end");
    add(&f, "1/m2", scene->density_most > 0.0f ? scene->density_most : NAN,
        "greatest density (Gaussian kernel, R = 1.5 m)");
    add(&f, "", jox_statistics_overlap_p99(s),
        "overlap that 99 %% stay below, share of a diameter");
    add(&f, "", s->agent_steps ? (double)s->failures / (double)s->agent_steps : NAN,
        "share of agent-steps whose 2-D program failed");
    add_exits(&f, &scene->exits);
    for (int m = 0; m < JOX_DANGER_MEASURES; m++)
        add(&f, jox_danger_units[m], jox_danger_most(scene->danger, (JoxDangerMeasure)m).value,
            "danger: greatest %s of anyone", jox_danger_names[m]);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        JoxDangerCount count = jox_danger_count(scene->danger, l);
        add(&f, "", count.people, "danger: people ever over %s", jox_danger_limits[l].key);
        add(&f, "s", count.person_s, "danger: person-seconds over %s", jox_danger_limits[l].key);
    }
    for (uint32_t r = 0; scene->regions && r < scene->regions->count; r++)
        add(&f, "m/s",
            scene->regions->items[r].people ? jox_region_speed(&scene->regions->items[r]) : NAN,
            "mean speed in region %.60s", scene->regions->items[r].name);
    add_probes(&f, scene);
    return f;
}

static void release(Figures *f) {
    for (uint32_t i = 0; i < f->count; i++)
        jox_free(f->items[i].name);
    jox_free(f->items);
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
    Figures whole = collect(scene), other = {0};
    char heads[128], text[512];
    jox_html_heading(out, "Figures");
    if (half) {
        other = collect(half);
        snprintf(text, sizeof text,
                 "The same run with the same seed was repeated at half the step, %g s. A figure is "
                 "worth no more digits than the two agree on; at another step chance falls "
                 "otherwise, too, so that single runs differ as two seeds do.",
                 half->world->def.dt);
        snprintf(heads, sizeof heads, "figure|step %g s|step %g s|difference", scene->world->def.dt,
                 half->world->def.dt);
    } else {
        snprintf(text, sizeof text, "The run was not repeated at half the step: %s.",
                 why ? why : "nobody asked for it");
        snprintf(heads, sizeof heads, "figure|step %g s", scene->world->def.dt);
    }
    jox_html_paragraph(out, text);
    jox_html_table(out, heads);
    for (uint32_t i = 0; i < whole.count; i++) {
        const Figure *a = &whole.items[i];
        jox_html_row(out);
        jox_html_cell(out, a->name);
        jox_html_cell_number(out, a->value, a->unit);
        if (!half)
            continue;
        /* by name: one run may have left somebody elsewhere, the other not */
        const Figure *b = NULL;
        for (uint32_t k = 0; k < other.count && !b; k++)
            b = strcmp(other.items[k].name, a->name) == 0 ? &other.items[k] : NULL;
        jox_html_cell_number(out, b ? b->value : NAN, a->unit);
        put_change(out, a->value, b ? b->value : NAN);
    }
    jox_html_table_end(out);
    release(&whole);
    release(&other);
}

static void put_place(FILE *out, double time, JoxV2 at) {
    if (isfinite(time))
        fprintf(out, "<td>%.1f&nbsp;s at (%.1f,&nbsp;%.1f)&nbsp;m", time, at.x, at.y);
    else
        fputs("<td>&ndash;", out);
}

static void put_danger(FILE *out, const JoxDanger *danger) {
    jox_html_heading(out, "Danger: who was over which limit");
    jox_html_paragraph(
        out,
        "Density is that of the Gaussian kernel exp(-d2/R2)/(pi R2), R = 1 m, where somebody "
        "stands; it reads low within a metre of walls. Crowd pressure is mean density times "
        "the variance over time of the local velocity, by the same kernel, means over 10 s; it "
        "is read only where the mean density is over 5 per m2, from 10 s on, and without the "
        "first 5 s, when everybody starts. Compression is the sum of "
        "the magnitudes of the contact forces on a person over the girth, held on average "
        "for a second: a knock of one step counts little.");
    jox_html_paragraph(out, jox_danger_conversion);
    jox_html_table(out, "limit|value|people ever over it|person-seconds|first|meaning|source");
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        const JoxDangerLimit *limit = &jox_danger_limits[l];
        JoxDangerCount count = jox_danger_count(danger, l);
        jox_html_row(out);
        jox_html_cell(out, limit->key);
        jox_html_cell_number(out, limit->value, jox_danger_units[limit->measure]);
        jox_html_cell_number(out, count.people, "");
        jox_html_cell_number(out, count.person_s, "s");
        put_place(out, count.first, count.first_at);
        jox_html_cell(out, limit->what);
        jox_html_cell(out, limit->source);
    }
    jox_html_table_end(out);
    jox_html_table(out, "measure|greatest of anyone|when and where");
    for (int m = 0; m < JOX_DANGER_MEASURES; m++) {
        JoxDangerMost most = jox_danger_most(danger, (JoxDangerMeasure)m);
        jox_html_row(out);
        jox_html_cell(out, jox_danger_names[m]);
        jox_html_cell_number(out, most.value, jox_danger_units[m]);
        put_place(out, most.time, most.at);
    }
    jox_html_table_end(out);
}

static bool is_there(const char *directory, const char *file) {
    char path[1200];
    snprintf(path, sizeof path, "%s/%s", directory, file);
    return access(path, R_OK) == 0;
}

static void put_picture(FILE *out, const char *directory, const char *name, const char *caption) {
    char png[128], svg[128];
    snprintf(png, sizeof png, "%s.png", name);
    snprintf(svg, sizeof svg, "%s.svg", name);
    if (is_there(directory, png))
        jox_html_picture(out, png, is_there(directory, svg) ? svg : NULL, caption);
}

static void put_pictures(FILE *out, const JoScene *scene, const char *directory) {
    const JoxProbe *probe;
    jox_html_heading(out, "Pictures");
    put_picture(out, directory, "danger-map", "Where people are squeezed: mean and greatest");
    put_picture(out, directory, "danger", "Danger over time, with the limits dashed");
    put_picture(out, directory, "density", "Mean density (Gaussian kernel, R = 1.5 m)");
    put_picture(out, directory, "regions", "Mean speed of the regions");
    if (scene->world->agents.next_id <= JOX_MOST_PATHS)
        put_picture(out, directory, "paths", "Paths");
    for (uint32_t p = 0; (probe = jox_host_probe(scene, p)); p++) {
        char caption[128];
        const char *name = jox_probe_def(probe)->name;
        snprintf(caption, sizeof caption, "Probe %.60s", name);
        put_picture(out, directory, name, caption);
    }
}

static void put_validation(FILE *out) {
    jox_html_heading(out, "What this is worth");
    jox_html_paragraph(
        out,
        "The engine is compared with published measurements by the command `jostle reproduce`, "
        "which writes a page of its own with every figure, its source, its band and whether it is "
        "met: scenes of Kim et al. 2014 (running through a crowd, two bottlenecks, stability over "
        "the time step), doors and bottlenecks (Wuppertal 2018; Seyfried et al. 2009; Kretz et al. "
        "2006), speed against density in single file and in corridors (Juelich archive; Zhang et "
        "al. 2011), a push along a row (Feldmann and Adrian 2023), and tests of the RiMEA "
        "guideline.");
    jox_html_paragraph(
        out,
        "None of that validates this scenario. Its geometry, numbers of people, behaviours and "
        "parameters are what its author gave; nothing on this page was compared with a crowd that "
        "did this here. Compression in particular is a model's: forces inside real crowds of this "
        "size have hardly been measured, the contacts are those of discs, and the limits come from "
        "single persons and from what was found after disasters. Read the limits as places and "
        "times to look at, not as a count of injured; run several seeds before comparing plans.");
}

static void put_inputs(FILE *out, const JoScene *scene) {
    const JoSceneDef *def = &scene->def;
    const JoWorld *world = scene->world;
    jox_html_heading(out, "How to repeat it");
    fputs("<p><code>jostle run ", out);
    jox_html_text(out, def->path);
    fprintf(out, " --seed %llu --dt %g --steps %llu", (unsigned long long)world->def.seed,
            world->def.dt, (unsigned long long)world->statistics.steps);
    for (size_t i = 0; i < def->override_count; i++) {
        fputs(" --set ", out);
        jox_html_text(out, def->overrides[i]);
    }
    fprintf(out, "</code>: state hash %016llx, whatever the number of threads.</p>\n",
            (unsigned long long)jox_world_hash(world));
    jox_html_table(out, "input|SHA-256");
    for (uint32_t f = 0; f < scene->plan->file_count; f++) {
        jox_html_row(out);
        jox_html_cell(out, scene->plan->files[f].path);
        jox_html_cell(out, scene->plan->files[f].sha256);
    }
    for (uint32_t m = 0; m < world->mind.machine_count; m++) {
        uint32_t count;
        const JoxLuaFile *files = jox_lua_files(scene->lua, world->mind.machines[m], &count);
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
    JOX_REQUIRE(scene && scene->finished && scene->danger && directory, false);
    JOX_REQUIRE(!half || (half->finished && half->danger), false);
    JoxText text = {0};
    FILE *out = jox_plot_open(directory, "index.html", &text);
    const JoWorld *world = scene->world;
    if (out) {
        char line[512];
        jox_html_begin(out, scene->plan->title ? scene->plan->title : scene->plan->path);
        snprintf(line, sizeof line,
                 "%.200s, %.1f s, seed %llu, step %g s, %u people at the end; Jostle %s.",
                 scene->plan->path, jo_world_time(world), (unsigned long long)world->def.seed,
                 world->def.dt, world->agents.count, jo_version());
        jox_html_paragraph(out, line);
        put_pictures(out, scene, directory);
        put_danger(out, scene->danger);
        put_figures(out, scene, half, why);
        put_validation(out);
        put_inputs(out, scene);
        jox_html_end(out);
    }
    bool good = out && jox_plot_close(out, "index.html", &text);
    if (good)
        jox_host_say(scene, "report: %s/index.html\n", directory);
    else
        jox_error(error, JO_FAILED, "%s", text.data ? text.data : "writing failed");
    jox_text_free(&text);
    return good;
}
