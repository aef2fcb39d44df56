/* Writes the summary of a sweep of one variant in sentences: the first section of its page. */
#include <stdio.h>

#include "base/format/plurals.h"
#include "picture/html.h"
#include "record/danger/danger.h"
#include "report/page_parts.h"
#include "sweep/compare/compare.h"

static void put_seeds_statement(FILE *out, const char *lead, JoxText *text) {
    jox_html_statement(out, lead, text->data ? text->data : "");
    jox_text_free(text);
}

static void put_what_was_run(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    const char *settings = side->settings ? side->settings : "";
    const JoxSpread people = jox_spread_of(side, "events.spawned");
    JoxText text = {0};
    char runs[JOX_NOUN], path[JOX_LONGEST_PATH];
    jox_text_printf(&text, "The scene %s (%s)", drawn->subject.title,
                    jox_page_path(jox_side_find_note(side, "scene"), NULL, path));
    if (people.runs) {
        jox_text_add(&text, ", in which ");
        if (people.least == people.most)
            jox_text_printf(&text, "%.0f people are", people.most);
        else
            jox_text_printf(&text, "%.0f to %.0f people are", people.least, people.most);
    }
    jox_text_printf(&text, ": %s with the seeds %llu to %llu",
                    jox_noun(runs, side->all_count, "run"), (unsigned long long)side->all[0].seed,
                    (unsigned long long)side->all[side->all_count - 1].seed);
    if (drawn->subject.until > 0)
        jox_text_printf(&text, ", of %.4g s each", drawn->subject.until);
    jox_text_printf(&text, ", by Jostle %s.", jox_side_find_note(side, "version"));
    if (*settings) {
        jox_text_add(&text, " Settings: ");
        for (const char *at = settings; *at; at++)
            jox_text_append(&text, *at == '\n' ? ", " : at, *at == '\n' ? 2 : 1);
        jox_text_add(&text, ".");
    }
    jox_text_add(&text, side->runs > 1 ? " Figures are medians of the runs; brackets have what "
                                         "nine in ten lie between (5 to 95 %), and the greatest "
                                         "with its seed."
                                       : "");
    put_seeds_statement(out, "What was run.", &text);
}

static void put_failures_statement(FILE *out, const JoxSide *side) {
    enum { MOST = 5 };
    JoxText text = {0};
    uint32_t told = 0;
    char runs[JOX_NOUN];
    if (side->left_out == 0)
        return;
    jox_text_printf(&text,
                    "%s failed or did not go as written, and %s left out of all that follows:",
                    jox_noun(runs, side->left_out, "run"), side->left_out == 1 ? "is" : "are");
    for (uint32_t r = 0; r < side->all_count && told < MOST; r++)
        if (side->all[r].state != JOX_SWEEP_DONE)
            jox_text_printf(&text, "%s seed %llu: %.300s", told++ ? ";" : "",
                            (unsigned long long)side->all[r].seed, side->all[r].reason);
    put_seeds_statement(out, "What went wrong.", &text);
}

static void put_leaving_statements(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    const JoxSpread half = jox_spread_of(side, "danger.leaving_s.p50");
    const JoxSpread most = jox_spread_of(side, "danger.leaving_s.p95");
    const JoxSpread last = jox_spread_of(side, "danger.last_left_s");
    const JoxSpread inside = jox_spread_of(side, "danger.inside");
    const JoxSpread clear = jox_spread_of(side, "danger.clearance_s");
    JoxText text = {0};
    if (last.runs == 0) {
        jox_text_printf(&text, "In no run did anybody leave within %.4g s.", drawn->subject.until);
        put_seeds_statement(out, "Who left when.", &text);
        return;
    }
    jox_text_add(&text, "Half of those who left had done so by ");
    jox_spread_add_text(&half, "s", false, &text);
    jox_text_add(&text, ", 95 % by ");
    jox_spread_add_text(&most, "s", false, &text);
    jox_text_add(&text, ", the last by ");
    jox_spread_add_text(&last, "s", false, &text);
    jox_text_add(&text, ".");
    for (uint32_t e = 0; e < drawn->exits.count; e++) {
        const char *name = drawn->exits.items[e].name;
        const JoxSpread people = jox_spread_of_path(side, "danger.exits.%s.people", name);
        const JoxSpread then = jox_spread_of_path(side, "danger.exits.%s.last_s", name);
        if (!people.runs)
            continue;
        jox_text_printf(&text, "%s%.60s ", e ? "; " : " By exits: ", name);
        jox_spread_add_text(&people, people.median == 1 ? "person" : "people", false, &text);
        if (then.runs)
            jox_text_printf(&text, ", the last at %.1f s", then.median);
    }
    jox_text_add(&text, drawn->exits.count ? "." : "");
    put_seeds_statement(out, "Who left when.", &text);
    if (inside.most > 0) {
        jox_text_printf(&text, "%s in %u of %u runs. At the end, %.4g s, ",
                        clear.runs ? "Not always:" : "No:", clear.runs, side->runs,
                        drawn->subject.until);
        jox_spread_add_text(&inside, inside.median == 1 ? "person" : "people", false, &text);
        jox_text_add(&text, inside.median == 1 ? " was still inside." : " were still inside.");
    } else {
        jox_text_printf(&text, "Yes, in %s: nobody is inside from ",
                        side->runs == 1 ? "the run" : "all runs");
        jox_spread_add_text(&clear, "s", false, &text);
        jox_text_add(&text, " on.");
    }
    put_seeds_statement(out, "Cleared?", &text);
}

/* Writes in how many runs people who cannot use stairs stayed, and on which storeys. */
static void put_stranded_statement(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    static const struct {
        const char *figure, *stay;
    } STAY[] = {{"in_refuge", "in a refuge, as no lift takes them"},
                {"without_refuge", "with neither a lift that takes them nor a refuge"},
                {"on_stairs", "on a stair or ramp with no way on"}};
    const JoxStoreys *storeys = drawn->subject.storeys;
    JoxText text = {0};
    for (size_t k = 0; k < sizeof STAY / sizeof *STAY; k++) {
        char path[100];
        snprintf(path, sizeof path, "cannot_use_stairs.%s", STAY[k].figure);
        const uint32_t runs = jox_spread_count_positive(side, path);
        const JoxSpread people = jox_spread_of(side, path);
        const char *join = " (";
        if (runs == 0)
            continue;
        jox_text_printf(&text, "%sIn %u of %u runs people stayed %s: ", text.length ? " " : "",
                        runs, side->runs, STAY[k].stay);
        jox_spread_add_text(&people, people.median == 1 ? "person" : "people", false, &text);
        for (uint32_t n = 0; storeys && n < storeys->storey_count; n++) {
            const JoxSpread here = jox_spread_of_path(side, "cannot_use_stairs.storeys.%s.%s",
                                                      storeys->storeys[n].name, STAY[k].figure);
            if (here.most > 0) {
                jox_text_printf(&text, "%son %.60s at most %.0f", join, storeys->storeys[n].name,
                                here.most);
                join = ", ";
            }
        }
        jox_text_add(&text, *join == ',' ? ")." : ".");
    }
    if (text.length)
        put_seeds_statement(out, "People who cannot use stairs.", &text);
}

/* Appends the place at which the greatest density, as a mean over runs, is greatest. */
static void add_densest_place(const JoxSide *side, const JoxSideDrawn *drawn, JoxText *out) {
    const JoxSweepField *f = &side->fields[JOX_FIELD_GREATEST];
    size_t most = SIZE_MAX;
    for (size_t k = 0; f->values && k < (size_t)f->columns * f->rows; k++)
        if (f->values[k] > 0 && (most == SIZE_MAX || f->values[k] > f->values[most]))
            most = k;
    if (most == SIZE_MAX)
        return;
    const JoxV2 at = {(float)(f->low_x + f->cell * ((double)(most % f->columns) + 0.5)),
                      (float)(f->low_y + f->cell * ((double)(most / f->columns) + 0.5))};
    jox_text_add(out, " It was densest, as a mean of the runs, at ");
    jox_describe_point(&drawn->subject, at, out);
    jox_text_add(out, ".");
}

/* Appends, for each limit of a measure, in how many runs anybody exceeded it; stops at the first
   limit that no run exceeded. */
static void add_exceeded_limits(const JoxSide *side, JoxDangerMeasure measure, JoxText *out) {
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        const JoxDangerLimit *limit = &jox_danger_limits[l];
        char name[100];
        snprintf(name, sizeof name, "danger.limits.%s.people", limit->key);
        const uint32_t runs = jox_spread_count_positive(side, name);
        const JoxSpread people = jox_spread_of(side, name);
        if (limit->measure != measure || people.runs == 0)
            continue;
        if (runs == 0) {
            jox_text_printf(out, " In no run was anybody over a %s.", limit->title);
            return;
        }
        const JoxSpread time = jox_spread_of_path(side, "danger.limits.%s.longest_s", limit->key);
        jox_text_printf(out, " In %u of %u runs somebody was over a %s (%s): ", runs, side->runs,
                        limit->title, limit->what);
        jox_spread_add_text(&people, people.median == 1 ? "person" : "people", false, out);
        if (time.runs) {
            jox_text_add(out, ", one of them for ");
            jox_spread_add_text(&time, "s", false, out);
        }
        jox_text_add(out, ".");
    }
}

static void put_danger_statements(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    const JoxSpread density = jox_spread_of(side, "density_max");
    const JoxSpread load = jox_spread_of(side, "danger.load_max");
    const JoxSpread pressure = jox_spread_of(side, "danger.pressure_max");
    JoxText text = {0};
    if (density.runs) {
        jox_text_add(&text, "The greatest density " JOX_DENSITY_BY " of any place and time was ");
        jox_spread_add_text(&density, "1/m2", false, &text);
        jox_text_add(&text, ".");
        add_densest_place(side, drawn, &text);
        add_exceeded_limits(side, JOX_DANGER_DENSITY, &text);
        add_exceeded_limits(side, JOX_DANGER_VORONOI, &text);
        put_seeds_statement(out, "Where it was dense.", &text);
    }
    if (load.runs) {
        jox_text_add(&text, "The greatest load from one side was ");
        jox_spread_add_text(&load, "N", false, &text);
        jox_text_add(&text, ".");
        add_exceeded_limits(side, JOX_DANGER_LOAD, &text);
        put_seeds_statement(out, "Loads on people.", &text);
    }
    if (pressure.runs) {
        jox_text_printf(&text, "Crowd pressure was measured in %u of %u runs; the greatest was ",
                        pressure.runs, side->runs);
        jox_spread_add_text(&pressure, "1/s2", false, &text);
        jox_text_add(&text, ".");
        add_exceeded_limits(side, JOX_DANGER_PRESSURE, &text);
    } else {
        jox_text_add(&text, "Not measured: in no run was the crowd dense enough for long enough (5 "
                            "per m\xc2\xb2 or more on 12 m\xc2\xb2 for 20 s).");
    }
    put_seeds_statement(out, "Crowd turbulence.", &text);
}

/* Writes what is validated, and what the spread of the runs does not cover. */
static void put_validity_statement(FILE *out, const JoxSide *side) {
    enum { ENOUGH = 20 };
    const size_t many = jox_rank_runs(0.95, 0.95);
    JoxText text = {0};
    jox_text_add(&text,
                 "The engine is compared with published measurements and standard tests (jostle "
                 "reproduce). This scenario is not: its plan, numbers of people, behaviours and "
                 "parameters are its author's, and nothing here was compared with a crowd that did "
                 "this here. The spread is that of chance between seeds alone: it holds nothing of "
                 "what is not known of people, places and the model.");
    if (side->runs < ENOUGH)
        jox_text_printf(&text,
                        " The seeds are few: of fewer than %d runs the values at 5 and 95 %% are "
                        "hardly more than the least and the greatest run.",
                        ENOUGH);
    if (side->runs < many)
        jox_text_printf(
            &text,
            " It takes %zu runs until the worst of them lies above the true 95 %% value "
            "with a probability of 95 %% (Wilks 1941).",
            many);
    put_seeds_statement(out, "What is validated, and what is not.", &text);
}

void jox_seeds_put_summary(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    jox_html_heading(out, "Summary");
    fputs("<div class=summary>\n", out);
    put_what_was_run(out, side, drawn);
    put_failures_statement(out, side);
    if (side->runs) {
        put_leaving_statements(out, side, drawn);
        put_stranded_statement(out, side, drawn);
        put_danger_statements(out, side, drawn);
    }
    put_validity_statement(out, side);
    fputs("</div>\n", out);
}
