/* Writes index.html of a sweep of one variant: the results that its runs have in common, and how
   far they differ. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/plurals.h"
#include "picture/html.h"
#include "picture/plot.h"
#include "record/danger/danger.h"
#include "record/danger/levels.h"
#include "sweep/compare/compare.h"

/* ---- figures of all runs ---- */

/* Writes a row with the spread of a figure over the runs. */
static void put_spread_row(FILE *out, const char *title, const JoxSpread *s, const char *unit) {
    const double values[] = {s->mean, s->least, s->p5, s->median, s->p95, s->most};
    JoxText name = {0};
    jox_text_printf(&name, "%s%s%s", title, *unit ? ", " : "", jox_figure_unit(unit));
    jox_html_row(out);
    jox_html_cell(out, name.data);
    jox_text_free(&name);
    for (size_t v = 0; v < sizeof values / sizeof *values; v++)
        jox_html_cell_number(out, values[v], "");
    jox_html_cell_number(out, s->runs, "");
}

static void put_spread_table(FILE *out, const JoxSide *side) {
    static const struct {
        const char *path, *title, *unit;
    } ROWS[] = {{"danger.leaving_s.first", "the first left", "s"},
                {"danger.leaving_s.p25", "25 % had left", "s"},
                {"danger.leaving_s.p50", "half had left", "s"},
                {"danger.leaving_s.p75", "75 % had left", "s"},
                {"danger.leaving_s.p95", "95 % had left", "s"},
                {"danger.last_left_s", "the last left", "s"},
                {"danger.clearance_s", "nobody inside from then on", "s"},
                {"danger.left", "people who left", ""},
                {"danger.inside", "people inside at the end", ""},
                {"density_max", "greatest density " JOX_DENSITY_BY, "1/m2"},
                {"danger.limits.density_5.person_s",
                 "time of all people over 5 per m\xc2\xb2 " JOX_DENSITY_BY, "s"},
                {"danger.load_max", "greatest load from one side", "N"},
                {"stood_longest.s", "longest time that anybody stood who wanted to get on", "s"}};
    jox_html_table(out, "figure|>mean|>least|>5 %|>median|>95 %|>greatest|>runs");
    for (size_t r = 0; r < sizeof ROWS / sizeof *ROWS; r++) {
        const JoxSpread s = jox_spread_of(side, ROWS[r].path);
        if (s.runs)
            put_spread_row(out, ROWS[r].title, &s, ROWS[r].unit);
    }
    jox_html_table_end(out);
}

static void put_exits(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    if (drawn->exits.count == 0)
        return;
    jox_html_heading(out, "Who left where");
    jox_html_table(out,
                   "exit|>people (5 to 95 %)|>most|>the last left, s (5 to 95 %)|>latest, s|>runs");
    for (uint32_t e = 0; e < drawn->exits.count; e++) {
        const char *name = drawn->exits.items[e].name;
        const JoxSpread people = jox_spread_of_path(side, "danger.exits.%s.people", name);
        const JoxSpread last = jox_spread_of_path(side, "danger.exits.%s.last_s", name);
        jox_html_row(out);
        jox_html_cell(out, name);
        jox_spread_put_cell(out, &people);
        jox_html_cell_number(out, people.most, "");
        jox_spread_put_cell(out, &last);
        jox_html_cell_number(out, last.most, "");
        jox_html_cell_number(out, last.runs, "");
    }
    jox_html_table_end(out);
}

/* Writes how many runs meet each criterion of the scene, if it has any. */
static void put_criteria_table(FILE *out, const JoxSide *side) {
    static const char BEGIN[] = "criteria.", END[] = ".met";
    bool begun = false;
    for (uint32_t f = 0; f < side->figure_count; f++) {
        const char *path = side->figures[f].name;
        const size_t length = strlen(path);
        if (strncmp(path, BEGIN, sizeof BEGIN - 1) != 0 || length < sizeof BEGIN + sizeof END - 2 ||
            strcmp(path + length - (sizeof END - 1), END) != 0)
            continue;
        char name[128];
        snprintf(name, sizeof name, "%.*s", (int)(length - (sizeof BEGIN + sizeof END - 2)),
                 path + sizeof BEGIN - 1);
        const JoxSpread figure = jox_spread_of_path(side, "criteria.%s.figure", name);
        const uint32_t met = jox_spread_count_positive(side, path);
        if (!begun) {
            jox_html_heading(out, "Criteria");
            jox_html_table(out, "criterion|>runs that meet it|>share|>figure (5 to 95 %)");
        }
        begun = true;
        jox_html_row(out);
        jox_html_cell(out, name);
        fprintf(out, "<td class=n>%u of %u", met, side->runs);
        jox_html_cell_number(out, 100.0 * met / side->runs, "%");
        jox_spread_put_cell(out, &figure);
    }
    if (begun)
        jox_html_table_end(out);
}

/* ---- danger ---- */

static void put_limits_table(FILE *out, const JoxSide *side) {
    jox_html_subheading(out, "Published limits");
    jox_html_table(
        out, "limit|what is known of it|>runs with anybody over it|>people (5 to 95 %)|>longest "
             "of one person, s|>first, s");
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        const JoxDangerLimit *limit = &jox_danger_limits[l];
        char name[100];
        snprintf(name, sizeof name, "danger.limits.%s.people", limit->key);
        const JoxSpread people = jox_spread_of(side, name);
        const JoxSpread time = jox_spread_of_path(side, "danger.limits.%s.longest_s", limit->key);
        const JoxSpread first = jox_spread_of_path(side, "danger.limits.%s.first_s", limit->key);
        jox_html_row(out);
        jox_html_cell(out, limit->title);
        fputs("<td>", out);
        jox_html_text(out, limit->what);
        fputs(" <small>(", out);
        jox_html_text(out, limit->source);
        fputs(")</small>", out);
        if (people.runs)
            fprintf(out, "<td class=n>%u of %u", jox_spread_count_positive(side, name), side->runs);
        else
            fputs("<td class=n>not measured", out);
        jox_spread_put_cell(out, &people);
        jox_spread_put_cell(out, &time);
        jox_spread_put_cell(out, &first);
    }
    jox_html_table_end(out);
}

static void put_levels_table(FILE *out, const JoxSide *side) {
    JoxSpread levels[JOX_LEVELS];
    double all = 0;
    for (int k = 0; k < JOX_LEVELS; k++) {
        levels[k] = jox_spread_of_path(side, "danger.level_person_s.%s", jox_levels[k].name);
        all += levels[k].runs ? levels[k].mean : 0;
    }
    if (!(all > 0))
        return;
    jox_html_heading(out, "Levels of service");
    jox_html_paragraph(out, "Of queues: by the area that each person has, 1 / density where they "
                            "stand " JOX_DENSITY_BY "; time of all people together.");
    jox_html_table(
        out, "level|>each has, from|>person-seconds (5 to 95 %)|>share of the means|people in such "
             "a queue");
    for (int k = 0; k < JOX_LEVELS; k++) {
        jox_html_row(out);
        jox_html_cell(out, jox_levels[k].name);
        jox_html_cell_number(out, jox_levels[k].queue_area, "m2");
        jox_spread_put_cell(out, &levels[k]);
        jox_html_cell_number(out, 100.0 * levels[k].mean / all, "%");
        jox_html_cell(out, jox_levels[k].what);
    }
    jox_html_table_end(out);
    jox_html_paragraph(out, jox_levels_source);
}

static void put_probe_tables(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    bool begun = false;
    for (uint32_t p = 0; p < drawn->plan.probe_count; p++) {
        const JoxProbe *probe = drawn->plan.probes[p];
        const JoxFigures figures = jox_probe_figures(probe); /* only their names are used */
        const char *name = jox_probe_def(probe)->name;
        if (!begun)
            jox_html_heading(out, "What probes measured");
        begun = true;
        jox_html_subheading(out, name);
        jox_html_table(out, "figure|>mean|>least|>5 %|>median|>95 %|>greatest|>runs");
        for (uint32_t i = 0; i < figures.count; i++) {
            const JoxSpread s =
                jox_spread_of_path(side, "probes.%s.%s", name, figures.items[i].name);
            put_spread_row(out, figures.items[i].title, &s, figures.items[i].unit);
        }
        jox_html_table_end(out);
    }
}

/* ---- runs and inputs ---- */

/* Writes a row for each run, or the reason why it is left out. */
static void put_runs_table(FILE *out, const JoxSide *side) {
    static const char *const COLUMNS[] = {
        "danger.left",        "danger.inside", "danger.leaving_s.p50",
        "danger.last_left_s", "density_max",   "danger.limits.density_5.person_s"};
    jox_html_heading(out, "Each run");
    jox_html_table(out,
                   ">seed|>left|>inside at the end|>half had left, s|>the last left, s|>greatest "
                   "density " JOX_DENSITY_BY
                   ", per m\xc2\xb2|>person-seconds over 5 per m\xc2\xb2|state hash");
    for (uint32_t a = 0, r = 0; a < side->all_count; a++) {
        const JoxSideRun *run = &side->all[a];
        jox_html_row(out);
        fprintf(out, "<td class=n>%llu", (unsigned long long)run->seed);
        if (run->state != JOX_SWEEP_DONE) {
            fputs("<td colspan=6>left out: ", out);
            jox_html_text(out, run->reason);
        }
        for (size_t k = 0; run->state == JOX_SWEEP_DONE && k < sizeof COLUMNS / sizeof *COLUMNS;
             k++) {
            const JoxSideFigure *figure = jox_side_find_figure(side, COLUMNS[k]);
            jox_html_cell_number(out, figure ? figure->values[r] : NAN, "");
        }
        r += run->state == JOX_SWEEP_DONE;
        fputs("<td><code>", out);
        jox_html_text(out, run->hash);
        fputs("</code>", out);
    }
    jox_html_table_end(out);
}

static void put_command_option(FILE *out, const char *name, const char *value, size_t length) {
    JoxText text = {0};
    jox_text_append(&text, value, length);
    if (length) {
        fprintf(out, " --%s ", name);
        jox_html_argument(out, text.data);
    }
    jox_text_free(&text);
}

/* Writes "--set PATH=VALUE" for each line of settings. */
static void put_sets(FILE *out, const char *lines) {
    for (const char *at = lines; *at; at += strspn(at, "\n")) {
        put_command_option(out, "set", at, strcspn(at, "\n"));
        at += strcspn(at, "\n");
    }
}

/* Writes the command line that repeats the runs. */
static void put_repeat_command(FILE *out, const JoxSide *side) {
    const char *duration = jox_side_find_note(side, "duration"),
               *step = jox_side_find_note(side, "step");
    fputs("<p><code>jostle run ", out);
    jox_html_argument(out, jox_side_find_note(side, "scene"));
    fprintf(out, " --seed %llu --seeds %llu", (unsigned long long)side->all[0].seed,
            (unsigned long long)(side->all[side->all_count - 1].seed - side->all[0].seed + 1));
    put_command_option(out, "dt", step, strcspn(step, " "));
    put_command_option(out, strstr(duration, "steps") ? "steps" : "for", duration,
                       strcspn(duration, " "));
    put_sets(out, jox_side_find_note(side, "settings of all"));
    put_sets(out, side->settings ? side->settings : "");
    put_command_option(out, "input", jox_side_find_note(side, "input log"),
                       strlen(jox_side_find_note(side, "input log")));
    fputs(" --report DIR</code></p>\n", out);
}

static void put_inputs_table(FILE *out, const JoxSide *side) {
    jox_html_heading(out, "How to repeat it");
    put_repeat_command(out, side);
    if (*jox_side_find_note(side, "mods")) {
        JoxText text = {0};
        jox_text_printf(&text, "With the mods %s.", jox_side_find_note(side, "mods"));
        jox_html_paragraph(out, text.data);
        jox_text_free(&text);
    }
    jox_html_table(out, "input|SHA-256");
    for (uint32_t f = 0; f < side->inputs.count; f++) {
        jox_html_row(out);
        jox_html_cell(out, side->inputs.items[f].key);
        fputs("<td><code>", out);
        jox_html_text(out, side->inputs.items[f].value);
        fputs("</code>", out);
    }
    jox_html_table_end(out);
    JoxText text = {0};
    jox_text_printf(&text,
                    "Every figure and curve of every run, and the texts of these files, are in %s, "
                    "an SQLite file.",
                    side->source);
    jox_html_paragraph(out, text.data);
    jox_text_free(&text);
}

/* ---- the page ---- */

static bool write_seeds_page(const JoxComparison *c, const JoxSide *side, const JoxSideDrawn *drawn,
                             JoxText *why) {
    FILE *out = jox_plot_open(drawn->subject.folder, "index.html", why);
    JoxText title = {0};
    char runs[JOX_NOUN];
    if (!out)
        return false;
    jox_text_printf(&title, "%s: %s with different seeds", drawn->subject.title,
                    jox_noun(runs, side->all_count, "run"));
    jox_html_begin(out, title.data);
    jox_text_free(&title);
    jox_seeds_put_summary(out, side, drawn);
    jox_html_heading(out, "Plan");
    jox_write_plan_html(out, &drawn->subject);
    if (side->runs) {
        jox_html_heading(out, "How far the runs differ");
        jox_seeds_put_curves(out, drawn);
        put_spread_table(out, side);
        if (c->def->percentile > 0)
            jox_compare_put_percentiles(out, c);
        put_criteria_table(out, side);
        put_exits(out, side, drawn);
        jox_html_heading(out, "Where it is dense");
        jox_seeds_put_maps(out, side, drawn);
        put_limits_table(out, side);
        put_levels_table(out, side);
        put_probe_tables(out, side, drawn);
    }
    put_runs_table(out, side);
    put_inputs_table(out, side);
    jox_html_end(out);
    return jox_plot_close(out, "index.html", why);
}

bool jox_seeds_write_page(const JoxComparison *c, JoxText *why) {
    const JoxSide *side = &c->sides.items[0];
    JoxSideDrawn drawn;
    const bool planned = jox_side_draw_begin(&drawn, side, c->def->out);
    if (!planned) /* no run reached its plan: the page gives the reasons */
        drawn.subject =
            (JoxSubject){.title = jox_side_find_note(side, "scene"), .folder = c->def->out};
    const bool good =
        (!planned || jox_seeds_draw(side, &drawn, why)) && write_seeds_page(c, side, &drawn, why);
    jox_side_draw_end(&drawn);
    return good;
}
