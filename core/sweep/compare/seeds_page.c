/* Writes index.html of a sweep of one variant: the results that its runs have in common, and how
   far they differ. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/path.h"
#include "base/format/plurals.h"
#include "base/format/quote.h"
#include "picture/html.h"
#include "picture/html_sections.h"
#include "picture/plot.h"
#include "record/danger/danger.h"
#include "record/danger/levels.h"
#include "report/page_parts.h"
#include "sweep/compare/compare.h"

/* ---- figures of all runs ---- */

static const char SPREAD_HEADS[] = "figure|unit|>mean|>least|>5 %|>median|>95 %|>greatest|>runs";

/* Adds a row with the spread of a figure over the runs. */
static void add_spread_row(JoxPageTable *table, const char *title, const JoxSpread *s,
                           const char *unit) {
    const double values[] = {s->mean, s->least, s->p5, s->median, s->p95, s->most};
    char runs[16];
    jox_table_text(table, title);
    jox_table_unit(table, unit);
    for (size_t v = 0; v < sizeof values / sizeof *values; v++)
        jox_table_number(table, values[v]);
    snprintf(runs, sizeof runs, "%u", (unsigned)s->runs);
    jox_table_text(table, runs);
}

/* Adds cells with the median, and the values that 5 and 95 % of the runs stay below. */
static void add_spread_cells(JoxPageTable *table, const JoxSpread *s) {
    jox_table_number(table, s->median);
    jox_table_number(table, s->p5);
    jox_table_number(table, s->p95);
}

static void put_spread_table(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    static const struct {
        const char *path, *title, *unit;
    } ROWS[] = {{"danger.leaving_s.first", "the first left at", "s"},
                {"danger.leaving_s.p25", "25 % had left at", "s"},
                {"danger.leaving_s.p50", "half had left at", "s"},
                {"danger.leaving_s.p75", "75 % had left at", "s"},
                {"danger.leaving_s.p95", "95 % had left at", "s"},
                {"danger.last_left_s", "the last left at", "s"},
                {"danger.clearance_s", "clearance time: nobody is inside", "s"},
                {"danger.left", "people who left", ""},
                {"danger.inside", "people inside at the end", ""},
                {"density_max", "greatest density " JOX_DENSITY_BY, "1/m2"},
                {"danger.limits.density_5.person_s",
                 "time of all people over 5 per m\xc2\xb2 " JOX_DENSITY_BY, "s"},
                {"danger.load_max", "greatest load from one side", "N"},
                {"stood_longest.s", "longest time that anybody stood who wanted to get on", "s"}};
    JoxPageTable table = jox_page_table(&drawn->subject, "spread", SPREAD_HEADS);
    table.zero_rows = "0 in all runs";
    for (size_t r = 0; r < sizeof ROWS / sizeof *ROWS; r++) {
        const JoxSpread s = jox_spread_of(side, ROWS[r].path);
        if (s.runs)
            add_spread_row(&table, ROWS[r].title, &s, ROWS[r].unit);
    }
    jox_table_put(out, &table);
}

static void put_exits(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    JoxPageTable table =
        jox_page_table(&drawn->subject, "exits",
                       "exit|>people, median|>5 %|>95 %|>greatest|>last left at, median [s]|>5 % "
                       "[s]|>95 % [s]|>latest [s]|>runs");
    if (drawn->exits.count == 0)
        return;
    jox_html_heading(out, "Exits");
    table.zero_rows = "Nobody left by";
    for (uint32_t e = 0; e < drawn->exits.count; e++) {
        const char *name = drawn->exits.items[e].name;
        const JoxSpread people = jox_spread_of_path(side, "danger.exits.%s.people", name);
        const JoxSpread last = jox_spread_of_path(side, "danger.exits.%s.last_s", name);
        jox_table_text(&table, name);
        add_spread_cells(&table, &people);
        jox_table_number(&table, people.most);
        add_spread_cells(&table, &last);
        jox_table_number(&table, last.most);
        jox_table_number(&table, last.runs);
    }
    jox_table_put(out, &table);
}

/* Finds the criterion of a figure `criteria.NAME.met`; false: it is no such figure. */
static bool find_criterion_name(const char *path, char name[128]) {
    static const char BEGIN[] = "criteria.", END[] = ".met";
    const size_t length = strlen(path), parts = sizeof BEGIN + sizeof END - 2;
    if (strncmp(path, BEGIN, sizeof BEGIN - 1) != 0 || length < parts ||
        strcmp(path + length - (sizeof END - 1), END) != 0)
        return false;
    snprintf(name, 128, "%.*s", (int)(length - parts), path + sizeof BEGIN - 1);
    return true;
}

/* Writes how many runs meet each criterion of the scene, if it has any. */
static void put_criteria_table(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    JoxPageTable table =
        jox_page_table(&drawn->subject, "criteria",
                       "criterion|>runs that meet it|>runs that do not|>not decided|>share that "
                       "meet it [%]|>figure, median|>5 %|>95 %");
    char name[128];
    for (uint32_t f = 0; f < side->figure_count; f++) {
        const char *path = side->figures[f].name;
        if (!find_criterion_name(path, name))
            continue;
        const JoxSpread figure = jox_spread_of_path(side, "criteria.%s.figure", name);
        const uint32_t met = jox_spread_count_positive(side, path);
        const uint32_t decided = jox_spread_of(side, path).runs;
        jox_table_text(&table, name);
        jox_table_number(&table, met);
        jox_table_number(&table, decided - met);
        jox_table_number(&table, side->runs - decided);
        jox_table_number(&table, 100.0 * met / side->runs);
        add_spread_cells(&table, &figure);
    }
    if (table.count)
        jox_html_heading(out, "Criteria");
    jox_table_put(out, &table);
}

/* Appends how many criteria all runs meet. */
static void say_criteria_met(const JoxSide *side, JoxText *out) {
    uint32_t all = 0, met = 0;
    char name[128];
    for (uint32_t f = 0; f < side->figure_count; f++) {
        const bool is = find_criterion_name(side->figures[f].name, name);
        all += is;
        met += is && jox_spread_count_positive(side, side->figures[f].name) == side->runs;
    }
    if (all)
        jox_text_printf(out, "%u of %u met in all runs", met, all);
}

/* ---- danger ---- */

static void put_limits_table(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    JoxPageTable table = jox_page_table(
        &drawn->subject, "limits",
        "limit|>runs with people over it|>people, median|>5 %|>95 %|>longest of one person, median "
        "[s]|>longest, 5 % [s]|>longest, 95 % [s]|>first at, median [s]|>first, 5 % [s]|>first, 95 "
        "% "
        "[s]");
    jox_html_subheading(out, "Published limits");
    table.zero_rows = "Limits that nobody was over in any run, or that were not measured";
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        const JoxDangerLimit *limit = &jox_danger_limits[l];
        char name[100];
        snprintf(name, sizeof name, "danger.limits.%s.people", limit->key);
        const JoxSpread people = jox_spread_of(side, name);
        const JoxSpread time = jox_spread_of_path(side, "danger.limits.%s.longest_s", limit->key);
        const JoxSpread first = jox_spread_of_path(side, "danger.limits.%s.first_s", limit->key);
        jox_table_text(&table, limit->title);
        jox_table_number(&table, people.runs ? jox_spread_count_positive(side, name) : NAN);
        add_spread_cells(&table, &people);
        add_spread_cells(&table, &time);
        add_spread_cells(&table, &first);
    }
    jox_table_put(out, &table);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++)
        if (jox_spread_of_path(side, "danger.limits.%s.people", jox_danger_limits[l].key).most > 0)
            jox_page_put_limit_meaning(out, l);
}

static void put_levels_table(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    JoxPageTable table =
        jox_page_table(&drawn->subject, "levels",
                       "level|>each person has at least [m2]|>person-seconds, median|>5 %|>95 "
                       "%|>share of the means [%]|people in such a queue");
    JoxSpread levels[JOX_LEVELS];
    double all = 0;
    for (int k = 0; k < JOX_LEVELS; k++) {
        levels[k] = jox_spread_of_path(side, "danger.level_person_s.%s", jox_levels[k].name);
        all += levels[k].runs ? levels[k].mean : 0;
    }
    if (!(all > 0))
        return;
    jox_html_heading(out, "Levels of service");
    jox_html_paragraph(out,
                       "Levels for queues, by the area that each person has: 1 / density where "
                       "they stand " JOX_DENSITY_BY "; time of all people together.");
    table.zero_rows = "In no run was anybody at level";
    for (int k = 0; k < JOX_LEVELS; k++) {
        char area[32];
        snprintf(area, sizeof area, "%g", jox_levels[k].queue_area);
        jox_table_text(&table, jox_levels[k].name);
        jox_table_text(&table, area);
        add_spread_cells(&table, &levels[k]);
        jox_table_number(&table, 100.0 * levels[k].mean / all);
        jox_table_text(&table, jox_levels[k].what);
    }
    jox_table_put(out, &table);
    jox_html_statement(out, "Source of the levels:", jox_levels_source);
}

static void put_probe_tables(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    for (uint32_t p = 0; p < drawn->plan.probe_count; p++) {
        const JoxProbe *probe = drawn->plan.probes[p];
        const JoxFigures figures = jox_probe_figures(probe); /* only their names are used */
        const char *name = jox_probe_def(probe)->name;
        JoxText file = {0}, title = {0};
        if (p == 0)
            jox_html_heading(out, "Probes");
        jox_text_printf(&title, "%s (%s)", name, jox_probe_kind_name(probe));
        jox_html_subheading(out, title.data);
        jox_text_add(&file, "probe-");
        jox_quote_file_name(&file, name);
        JoxPageTable table = jox_page_table(&drawn->subject, file.data, SPREAD_HEADS);
        table.zero_rows = "0 in all runs, or not known";
        for (uint32_t i = 0; i < figures.count; i++) {
            const JoxSpread s =
                jox_spread_of_path(side, "probes.%s.%s", name, figures.items[i].name);
            add_spread_row(&table, figures.items[i].title, &s, figures.items[i].unit);
        }
        jox_table_put(out, &table);
        jox_text_free(&file);
        jox_text_free(&title);
    }
}

/* ---- runs and inputs ---- */

/* Writes a row for each run, or the reason why it is left out. */
static void put_runs_table(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    static const char *const COLUMNS[] = {
        "danger.left",        "danger.inside", "danger.leaving_s.p50",
        "danger.last_left_s", "density_max",   "danger.limits.density_5.person_s"};
    JoxPageTable table = jox_page_table(
        &drawn->subject, "runs",
        ">seed|>left|>inside at the end|>half had left at [s]|>the last left at [s]|>greatest "
        "density " JOX_DENSITY_BY
        " [1/m2]|>person-seconds over 5 per m\xc2\xb2|state hash|left out, since");
    jox_html_heading(out, "Each run");
    for (uint32_t a = 0, r = 0; a < side->all_count; a++) {
        const JoxSideRun *run = &side->all[a];
        const bool done = run->state == JOX_SWEEP_DONE;
        char seed[24];
        snprintf(seed, sizeof seed, "%llu", (unsigned long long)run->seed);
        jox_table_text(&table, seed);
        for (size_t k = 0; k < sizeof COLUMNS / sizeof *COLUMNS; k++) {
            const JoxSideFigure *figure = jox_side_find_figure(side, COLUMNS[k]);
            jox_table_number(&table, figure && done ? figure->values[r] : NAN);
        }
        r += done;
        jox_table_text(&table, done ? run->hash : "");
        jox_table_text(&table, done ? "" : run->reason);
    }
    jox_table_put(out, &table);
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
    char path[JOX_LONGEST_PATH];
    jox_html_argument(out, jox_page_path(jox_side_find_note(side, "scene"), NULL, path));
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

static void put_inputs_table(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    JoxPageTable table = jox_page_table(&drawn->subject, "files", "file|SHA-256");
    JoxText text = {0};
    char path[JOX_LONGEST_PATH];
    jox_html_heading(out, "How to repeat the runs");
    put_repeat_command(out, side);
    if (*jox_side_find_note(side, "mods")) {
        jox_text_printf(&text, "With the mods %s.", jox_side_find_note(side, "mods"));
        jox_html_paragraph(out, text.data);
    }
    for (uint32_t f = 0; f < side->inputs.count; f++) {
        jox_table_text(&table, jox_page_path(side->inputs.items[f].key, NULL, path));
        jox_table_text(&table, side->inputs.items[f].value);
    }
    jox_table_put(out, &table);
    jox_text_free(&text);
    jox_text_printf(&text,
                    "All figures and curves of each run, and the texts of these files, are in %s, "
                    "an SQLite file.",
                    jox_path_name(side->source));
    jox_html_paragraph(out, text.data);
    jox_text_free(&text);
}

/* Writes the head of the page, with the facts of the runs, and lines to sign. */
static void put_seeds_title(FILE *out, const JoxComparison *c, const JoxSide *side,
                            const JoxSideDrawn *drawn) {
    const JoxSceneReport head = jox_page_head(&drawn->plan.report, &c->def->head);
    const char *scene = jox_side_find_note(side, "scene");
    JoxSubject subject = drawn->subject;
    JoxText title = {0}, run = {0}, foot = {0}, criteria = {0}, program = {0};
    char path[JOX_LONGEST_PATH], runs[JOX_NOUN], shown[JOX_LONGEST_PATH];
    const unsigned long long first = (unsigned long long)side->all[0].seed;
    const unsigned long long last = (unsigned long long)side->all[side->all_count - 1].seed;
    jox_page_path(scene, NULL, path);
    jox_text_printf(&title, "%s: %s with different seeds",
                    c->def->head.title ? c->def->head.title : subject.title,
                    jox_noun(runs, side->all_count, "run"));
    subject.title = title.data;
    jox_text_printf(&program, "Jostle %s", jox_side_find_note(side, "version"));
    jox_text_printf(&run, "%s with the seeds %llu to %llu", runs, first, last);
    if (subject.until > 0)
        jox_text_printf(&run, ", of %.6g s each", subject.until);
    jox_text_printf(&foot, "%s, %s, seeds %llu to %llu", program.data, jox_path_name(path), first,
                    last);
    jox_page_begin(out, &subject, &head, "A report on simulations of one scene.", foot.data);
    jox_html_fact(out, "Scene", path);
    for (uint32_t f = 0; f < side->inputs.count; f++)
        if (strcmp(jox_page_path(side->inputs.items[f].key, NULL, shown), path) == 0)
            jox_html_fact(out, "SHA-256 of the scene", side->inputs.items[f].value);
    jox_html_fact(out, "Simulated", run.data);
    jox_html_fact(out, "Program", program.data);
    say_criteria_met(side, &criteria);
    jox_html_fact(out, "Criteria", criteria.data);
    jox_html_table_end(out);
    jox_page_put_signatures(out, &head);
    jox_text_free(&title);
    jox_text_free(&run);
    jox_text_free(&foot);
    jox_text_free(&criteria);
    jox_text_free(&program);
}

/* ---- the page ---- */

static bool write_seeds_page(const JoxComparison *c, const JoxSide *side, JoxSideDrawn *drawn,
                             JoxText *why) {
    FILE *page = jox_plot_open(drawn->subject.folder, "index.html", why);
    JoxHtmlBody body;
    if (!page)
        return false;
    drawn->subject.error = why;
    put_seeds_title(page, c, side, drawn);
    jox_html_body_begin(&body);
    FILE *out = body.out;
    if (out) {
        jox_seeds_put_summary(out, side, drawn);
        put_criteria_table(out, side, drawn);
        jox_html_heading(out, "Plan");
        jox_write_plan_html(out, &drawn->subject);
        if (side->runs) {
            jox_html_heading(out, "How far the runs differ");
            jox_seeds_put_curves(out, side, drawn);
            put_spread_table(out, side, drawn);
            if (c->def->percentile > 0)
                jox_compare_put_percentiles(out, c);
            put_exits(out, side, drawn);
            jox_html_heading(out, "Density and load");
            jox_seeds_put_maps(out, side, drawn);
            put_limits_table(out, side, drawn);
            put_levels_table(out, side, drawn);
            put_probe_tables(out, side, drawn);
        }
        put_runs_table(out, side, drawn);
        put_inputs_table(out, side, drawn);
        jox_html_body_put(page, &body);
    }
    jox_html_end(page);
    return jox_plot_close(page, "index.html", why) && out && !why->length;
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
