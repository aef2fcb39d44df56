/* The section on danger on the pages of reports, and the figures on it. */
#include <math.h>

#include "picture/html.h"
#include "record/danger/danger_parts.h"
#include "report/page_parts.h"

/* ---- figures ---- */

/* Appends the figures of lines: flow, stop-and-go and queue growth. */
static void add_line_figures(JoxPageFigures *f, const JoxDanger *danger) {
    for (uint32_t l = 0; l < danger->lines.count; l++) {
        const JoxDangerLine *line = &danger->lines.items[l];
        const bool known = line->worst >= 0;
        jox_page_add_figure(f, "1/(m s)", line->flow_most, "greatest flow over %.60s", line->name);
        jox_page_add_figure(f, "s", known ? line->stop_and_go.seconds : NAN,
                            "time of stop-and-go at %.60s", line->name);
        jox_page_add_figure(f, "1/s", line->growth_most, "greatest growth of the queue at %.60s",
                            line->name);
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
        jox_page_add_figure(f, "", read ? count.people : NAN, "people ever over a %s", title);
        jox_page_add_figure(f, "s", read ? count.person_s : NAN, "person-seconds over a %s", title);
        jox_page_add_figure(f, "s", read ? count.longest : NAN,
                            "longest time of one person over a %s", title);
    }
    add_congestion_figures(f, danger);
    add_line_figures(f, danger);
    jox_page_add_figure(f, "N", danger->walls.known ? greatest_wall_load(danger) : NAN,
                        "greatest load on a piece of a wall");
    f->group = "Levels of service";
    for (int k = 0; k < JOX_LEVELS; k++)
        jox_page_add_figure(f, "s", danger->level_s[k], "person-seconds at level %s",
                            jox_levels[k].name);
}

/* ---- parts of the page ---- */

/* Writes a cell with a time and a place in words; a dash if the time is not finite. */
static void put_time_and_place(FILE *out, const JoxSubject *s, double time, JoxV2 at) {
    JoxText text = {0};
    if (isfinite(time)) {
        jox_text_printf(&text, "%.1f s at ", time);
        jox_describe_point(s, at, &text);
    }
    jox_html_cell(out, text.data ? text.data : "\xe2\x80\x93");
    jox_text_free(&text);
}

void jox_page_put_definitions(FILE *out, const JoxDanger *danger) {
    char text[1280];
    jox_html_paragraph(
        out,
        "Density is people per m2: each person is spread by a Gaussian of R = 1 m over the "
        "floor within the walls, which let nothing through. Its greatest value is taken over all "
        "places; a person is over a limit if the density where they stand is. It is a mean over "
        "some 3 m2. Voronoi density is one over the area of a person's Voronoi cell, which is "
        "cut off at 1 m and ends at walls, as individual densities of PedPy are: the room of "
        "one person, which scatters more, and reads higher in a dense crowd.");
    snprintf(
        text, sizeof text,
        "Crowd pressure is the mean density at a place times the variance over time of the local "
        "velocity there, over %g s, averaged over %g m by %g m around the place. It shows how "
        "the crowd as a whole is shaken to and fro, not how people walk past each other. It is "
        "measured only where the crowd stood on at least %g m2 of that square at %g per m2 or "
        "more all that time, and the variance does not come from a single change of the flow. "
        "So it does not show a knot of people before a door, a queue that starts to move, or a "
        "whole crowd that sways slower than every 15 s. Its authors' limit of 0.02 per s2 is for "
        "a section of 20 m by 14 m; recorded queues of people in no danger read 0.01 at most.%s",
        (double)JOX_PRESSURE_SPAN, (double)JOX_PRESSURE_SECTION, (double)JOX_PRESSURE_SECTION,
        (double)JOX_PRESSURE_FLOOR, (double)JOX_PRESSURE_LEAST,
        jox_danger_has_measure(danger, JOX_DANGER_PRESSURE)
            ? ""
            : " Here it was measured nowhere, so its limit shows dashes.");
    jox_html_paragraph(out, text);
    if (jox_danger_has_measure(danger, JOX_DANGER_LOAD)) {
        jox_html_paragraph(
            out, "Load is the greatest push that a person bears from any one direction: over "
                 "directions, the greatest sum of the positive parts of the contact forces along "
                 "it, in newtons, held on average for a second; a knock of one step counts little. "
                 "Limits for chests are forces of that kind.");
        jox_html_paragraph(out, jox_danger_dose_text);
    } else {
        jox_html_paragraph(out,
                           "Load was not measured: this recording has no forces on people. Its "
                           "limits, and those of dose, show dashes.");
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

/* Writes a table of the published limits: who was over them, for how long, and since when. */
static void put_limit_table(FILE *out, const JoxSubject *s) {
    const JoxDanger *danger = s->danger;
    jox_html_table(out, "limit|>people ever over it|>person-seconds|>longest of one "
                        "person|first|>minutes since|meaning and source");
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        const JoxDangerLimit *limit = &jox_danger_limits[l];
        JoxDangerCount count = jox_danger_count(danger, l);
        JoxText meaning = {0};
        jox_html_row(out);
        jox_html_cell(out, limit->title);
        bool read = jox_danger_has_measure(danger, limit->measure);
        jox_html_cell_number(out, read ? count.people : NAN, "");
        jox_html_cell_number(out, read ? count.person_s : NAN, "s");
        jox_html_cell_number(out, read ? count.longest : NAN, "s");
        put_time_and_place(out, s, count.first, count.first_at);
        jox_html_cell_number(out, jox_danger_minutes_since(danger, count.first), "min");
        jox_text_printf(&meaning, "%s (%s)", limit->what, limit->source);
        jox_html_cell(out, meaning.data);
        jox_text_free(&meaning);
    }
    jox_html_table_end(out);
}

/* Writes a table of the greatest value of each measure, with its time and place. */
static void put_greatest_table(FILE *out, const JoxSubject *s) {
    const JoxDanger *danger = s->danger;
    jox_html_table(out, "measure|>greatest|when and where");
    for (int m = 0; m < JOX_DANGER_MEASURES; m++) {
        JoxDangerMost most = jox_danger_most(danger, (JoxDangerMeasure)m);
        jox_html_row(out);
        jox_html_cell(out, jox_danger_titles[m]);
        jox_html_cell_number(out, most.value, jox_danger_units[m]);
        put_time_and_place(out, s, most.time, most.at);
    }
    jox_html_table_end(out);
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
    if (shown == 0)
        return;
    jox_html_paragraph(out, "The people with the greatest doses; danger-people.csv lists all whose "
                            "dose is over 0.01 or whose load was over the first limit.");
    jox_html_table(
        out, ">person|>dose|>greatest load|when and where|>over 623 N|>over 1112 N|>over 6227 "
             "N");
    for (uint32_t k = 0; k < shown; k++) {
        const JoxDangerPerson *person = &danger->people[order[k]];
        jox_html_row(out);
        fprintf(out, "<td class=n>%u", order[k]);
        jox_html_cell_number(out, person->dose, "");
        jox_html_cell_number(out, (double)person->most, "N");
        put_time_and_place(out, s, person->most_time, person->most_at);
        for (int l = 0; l < JOX_DANGER_LIMITS; l++)
            if (jox_danger_limits[l].measure == JOX_DANGER_LOAD)
                jox_html_cell_number(out, person->seconds[l], "s");
    }
    jox_html_table_end(out);
}

void jox_page_put_danger(FILE *out, const JoxSubject *s) {
    jox_html_heading(out, "Danger: who was over which limit");
    put_limit_table(out, s);
    put_greatest_table(out, s);
    jox_html_figure(out, s->folder, "danger",
                    "Danger over time. Dashed lines: published limits near the curves.", true);
    jox_html_subheading(out, "Where");
    jox_write_maps_html(out, s);
    jox_html_subheading(out, "Telling moments");
    jox_write_snapshots_html(out, s);
    put_dose_table(out, s);
}
