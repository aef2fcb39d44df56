/* The section on danger on the pages of reports, and the figures on it. */
#include <math.h>

#include "picture/html.h"
#include "record/danger/danger_parts.h"
#include "report/danger_outputs.h"
#include "report/page_parts.h"

static const double WORTH = 0.01; /* least dose of a list of people */

/* ---- figures ---- */

/* Appends the figures of lines: flow, stop-and-go and queue growth. */
static void add_line_figures(JoxPageFigures *f, const JoxDanger *danger) {
    for (uint32_t l = 0; l < danger->lines.count; l++) {
        const JoxDangerLine *line = &danger->lines.items[l];
        const bool known = line->worst >= 0;
        jox_page_add_figure(f, "1/(m s)", line->flow_most, "greatest flow over %.60s", line->name);
        jox_page_add_figure(f, "s", known ? line->stop_and_go.seconds : NAN,
                            "time of stop-and-go at %.60s", line->name);
        jox_page_add_figure(f, "1/s", line->growth_most < 0.0 ? 0.0 : line->growth_most,
                            "greatest growth of the queue at %.60s", line->name);
    }
}

static void add_congestion_figures(JoxPageFigures *f, const JoxDanger *danger) {
    JoxCongestionFound found = jox_congestion_find(&danger->congestion, danger->local->grid);
    double area = 0.0;
    for (uint32_t r = 0; r < found.count; r++)
        area += found.regions[r].area;
    jox_page_add_figure(f, "s", found.longest,
                        "longest time that a place was above %g per m\xc2\xb2 " JOX_DENSITY_BY,
                        (double)JOX_CONGESTION_DENSITY);
    jox_page_add_figure(f, "", found.known ? found.count : NAN,
                        "regions of significant congestion");
    jox_page_add_figure(f, "m2", found.known ? area : NAN, "area of significant congestion");
    jox_congestion_found_free(&found);
}

static double greatest_wall_load(const JoxDanger *danger) {
    return danger->walls.count ? (double)danger->walls.items[danger->walls.most].most : 0.0;
}

void jox_page_add_danger(JoxPageFigures *f, const JoxDanger *danger) {
    f->group = "Danger";
    for (int m = 0; m < JOX_DANGER_MEASURES; m++)
        jox_page_add_figure(f, jox_danger_units[m],
                            jox_danger_most(danger, (JoxDangerMeasure)m).value, "greatest %s",
                            jox_danger_titles[m]);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        JoxDangerCount count = jox_danger_count(danger, l);
        const char *title = jox_danger_limits[l].title;
        bool read = jox_danger_has_measure(danger, jox_danger_limits[l].measure);
        jox_page_add_figure(f, "", read ? count.people : NAN, "people over a %s", title);
        jox_page_add_figure(f, "s", read ? count.person_s : NAN, "person-seconds over a %s", title);
        jox_page_add_figure(f, "s", read ? count.longest : NAN,
                            "longest time of one person over a %s", title);
    }
    add_congestion_figures(f, danger);
    add_line_figures(f, danger);
    jox_page_add_stairs(f, danger);
    jox_page_add_figure(f, "N", danger->walls.known ? greatest_wall_load(danger) : NAN,
                        "greatest load on a piece of a wall");
    f->group = "Levels of service";
    for (int k = 0; k < JOX_LEVELS; k++)
        jox_page_add_figure(f, "s", danger->level_s[k], "person-seconds at level %s",
                            jox_levels[k].name);
}

/* ---- parts of the page ---- */

/* Adds a cell with a place in words, if the time at which somebody was there is finite. */
static void add_place(JoxPageTable *table, const JoxSubject *s, double time, JoxV2 at) {
    JoxText text = {0};
    if (isfinite(time))
        jox_describe_point(s, at, &text);
    jox_table_text(table, text.data);
    jox_text_free(&text);
}

void jox_page_put_definitions(FILE *out, const JoxDanger *danger) {
    char text[1280];
    jox_html_paragraph(
        out,
        "Density is people per m\xc2\xb2: each person is spread by a Gaussian of R = 1 m over the "
        "floor within the walls, which let nothing through. Its greatest value is taken over all "
        "places; a person is over a limit if the density where they stand is. It is a mean over "
        "some 3 m\xc2\xb2. Voronoi density is one over the area of a person's Voronoi cell, which "
        "is "
        "cut off at 1 m and ends at walls, as individual densities of PedPy are: the room of "
        "one person, which scatters more, and reads higher in a dense crowd.");
    snprintf(
        text, sizeof text,
        "Crowd pressure is the mean density at a place times the variance over time of the local "
        "velocity there, over %g s, averaged over %g m by %g m around the place. It shows how "
        "the crowd as a whole is shaken to and fro, not how people walk past each other. It is "
        "measured only where the crowd stood on at least %g m\xc2\xb2 of that square at %g per "
        "m\xc2\xb2 or "
        "more all that time, and the variance does not come from a single change of the flow. "
        "So it does not show a knot of people before a door, a queue that starts to move, or a "
        "whole crowd that sways slower than every 15 s. Its authors' limit of 0.02 per s\xc2\xb2 "
        "is for "
        "a section of 20 m by 14 m; recorded queues of people in no danger read 0.01 at most.%s",
        (double)JOX_PRESSURE_SPAN, (double)JOX_PRESSURE_SECTION, (double)JOX_PRESSURE_SECTION,
        (double)JOX_PRESSURE_FLOOR, (double)JOX_PRESSURE_LEAST,
        jox_danger_has_measure(danger, JOX_DANGER_PRESSURE) ? ""
                                                            : " Here it was measured nowhere.");
    jox_html_paragraph(out, text);
    if (jox_danger_has_measure(danger, JOX_DANGER_LOAD)) {
        jox_html_paragraph(
            out, "Load is the greatest push that a person bears from any one direction: over "
                 "directions, the greatest sum of the positive parts of the contact forces along "
                 "it, in newtons, held on average for a second; a knock of one step counts little. "
                 "Limits for chests are forces of that kind.");
        jox_html_paragraph(out, jox_danger_dose_text);
    } else {
        jox_html_paragraph(
            out, "Load was not measured: this recording has no forces on people, so nobody "
                 "is held against its limits and those of dose.");
    }
    if (jox_danger_has_measure(danger, JOX_DANGER_COMPRESSION))
        jox_html_paragraph(
            out,
            "Compression is another quantity: the sum of the magnitudes of all contact forces "
            "over the circumference of the torso, held likewise. It cannot be turned into a load "
            "and is compared with no limit.");
    else
        jox_html_paragraph(out, "Compression was not measured.");
}

void jox_page_put_limit_meaning(FILE *out, int limit) {
    JoxText lead = {0}, meaning = {0};
    jox_text_printf(&lead, "Limit %s:", jox_danger_limits[limit].title);
    jox_text_printf(&meaning, "%s (%s).", jox_danger_limits[limit].what,
                    jox_danger_limits[limit].source);
    jox_html_statement(out, lead.data, meaning.data);
    jox_text_free(&lead);
    jox_text_free(&meaning);
}

/* Writes a table of the published limits that somebody was over: who, for how long, and since
   when; then what each limit means. */
static void put_limit_table(FILE *out, const JoxSubject *s) {
    const JoxDanger *danger = s->danger;
    JoxPageTable table = jox_page_table(
        s, "limits",
        "limit|>people over it|>time of all people over it [person-seconds]|>longest of one "
        "person [s]|>first at [s]|where that was");
    table.zero_rows = "Limits that nobody was over, or that were not measured";
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        const JoxDangerLimit *limit = &jox_danger_limits[l];
        const JoxDangerCount count = jox_danger_count(danger, l);
        const bool read = jox_danger_has_measure(danger, limit->measure);
        jox_table_text(&table, limit->title);
        jox_table_number(&table, read ? count.people : NAN);
        jox_table_number(&table, read ? count.person_s : NAN);
        jox_table_number(&table, read ? count.longest : NAN);
        jox_table_number(&table, count.first);
        add_place(&table, s, count.first, count.first_at);
    }
    jox_table_put(out, &table);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++)
        if (jox_danger_count(danger, l).people)
            jox_page_put_limit_meaning(out, l);
}

/* Writes a table of the greatest value of each measure, with its time and place. */
static void put_greatest_table(FILE *out, const JoxSubject *s) {
    const JoxDanger *danger = s->danger;
    JoxPageTable table = jox_page_table(s, "greatest", "measure|>greatest|unit|>at [s]|where");
    table.zero_rows = "Not measured, or 0";
    for (int m = 0; m < JOX_DANGER_MEASURES; m++) {
        const JoxDangerMost most = jox_danger_most(danger, (JoxDangerMeasure)m);
        jox_table_text(&table, jox_danger_titles[m]);
        jox_table_number(&table, most.value);
        jox_table_unit(&table, jox_danger_units[m]);
        jox_table_number(&table, most.time);
        add_place(&table, s, most.time, most.at);
    }
    jox_table_put(out, &table);
}

uint32_t jox_page_rank_greatest(const JoxDanger *danger, uint32_t count,
                                double (*value)(const JoxDanger *danger, uint32_t k),
                                uint32_t order[JOX_PAGE_SHOWN]) {
    uint32_t shown = 0;
    for (uint32_t k = 0; k < count; k++) {
        if (!(value(danger, k) > 0.0))
            continue;
        uint32_t at = shown < JOX_PAGE_SHOWN ? shown++ : JOX_PAGE_SHOWN;
        for (; at > 0 && value(danger, order[at - 1]) < value(danger, k); at--)
            if (at < JOX_PAGE_SHOWN)
                order[at] = order[at - 1];
        if (at < JOX_PAGE_SHOWN)
            order[at] = k;
    }
    return shown;
}

static double dose_of_person(const JoxDanger *danger, uint32_t k) {
    return danger->people[k].dose;
}

/* Writes a table of the people with the greatest doses; nothing if there are none. */
static void put_dose_table(FILE *out, const JoxSubject *s) {
    const JoxDanger *danger = s->danger;
    uint32_t order[JOX_PAGE_SHOWN];
    const uint32_t shown =
        jox_page_rank_greatest(danger, danger->people_capacity, dose_of_person, order);
    JoxPageTable table = jox_page_table(
        s, "doses",
        ">person|>dose|>greatest load [N]|>at [s]|where|>time over 623 N [s]|>over 1112 N "
        "[s]|>over 6227 N [s]");
    if (shown == 0)
        return;
    if (danger->people[order[0]].dose < WORTH) {
        char text[160];
        snprintf(text, sizeof text,
                 "No person's dose of load reached %g, from which on people are listed.", WORTH);
        jox_html_paragraph(out, text);
        return;
    }
    jox_html_subheading(out, "People with the greatest doses");
    jox_html_paragraph(out, "The people with the greatest doses; danger-people.csv lists all whose "
                            "dose is over 0.01 or whose load was over the first limit.");
    for (uint32_t k = 0; k < shown; k++) {
        const JoxDangerPerson *person = &danger->people[order[k]];
        char number[16];
        snprintf(number, sizeof number, "%u", order[k]);
        jox_table_text(&table, number);
        jox_table_number(&table, person->dose);
        jox_table_number(&table, (double)person->most);
        jox_table_number(&table, person->most_time);
        add_place(&table, s, person->most_time, person->most_at);
        for (int l = 0; l < JOX_DANGER_LIMITS; l++)
            if (jox_danger_limits[l].measure == JOX_DANGER_LOAD)
                jox_table_number(&table, person->seconds[l]);
    }
    jox_table_put(out, &table);
}

void jox_page_put_danger(FILE *out, const JoxSubject *s) {
    JoxText how = {0};
    jox_html_heading(out, "Density and load against published limits");
    put_limit_table(out, s);
    put_greatest_table(out, s);
    jox_html_strips(out, s->folder, "danger",
                    "Density " JOX_DENSITY_BY
                    " and crowd pressure anywhere on the floor, greatest of a sample each 0.5 s; "
                    "load of a person, mean over 1 s. Dashed lines: published limits near the "
                    "curves.",
                    &(JoxStrips){.count = jox_danger_count_strips(s->danger),
                                 .width = JOX_DANGER_STRIPS_WIDE,
                                 .height = JOX_DANGER_STRIP});
    jox_html_subheading(out, "Maps");
    jox_text_add(&how, "Densities of maps and moments: ");
    jox_page_say_kernel(s, &how);
    jox_text_add(&how, ". \"Mean\" is the mean of the samples, \"greatest\" the greatest of them. "
                       "Letters below a scale: Fruin's levels of service for "
                       "queues.");
    jox_html_paragraph(out, how.data);
    jox_text_free(&how);
    jox_write_maps_html(out, s);
    jox_html_subheading(out, "Snapshots");
    jox_write_snapshots_html(out, s);
    put_dose_table(out, s);
}
