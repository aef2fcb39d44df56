/* The section on danger on the pages of reports, and its figures. */
#include <math.h>

#include "picture/html.h"
#include "record/danger/danger_parts.h"
#include "report/page_parts.h"

/* ---- figures ---- */

static void add_lines(JoxPageFigures *f, const JoxDanger *danger) {
    for (int k = 0; k < JOX_LEVELS; k++)
        jox_page_add(f, "s", danger->level_s[k], "danger: person-seconds at level of service %s",
                     jox_levels[k].name);
    for (uint32_t l = 0; l < danger->lines.count; l++) {
        const JoxDangerLine *line = &danger->lines.items[l];
        const bool known = line->worst >= 0;
        jox_page_add(f, "1/(m s)", line->flow_most, "danger: greatest flow over %.60s", line->name);
        jox_page_add(f, "s", known ? line->stop_and_go.seconds : NAN,
                     "danger: stop-and-go at %.60s", line->name);
        jox_page_add(f, "s", known ? line->congestion.seconds : NAN, "danger: congestion at %.60s",
                     line->name);
    }
}

static double walls_most(const JoxDanger *danger) {
    return danger->walls.count ? (double)danger->walls.items[danger->walls.most].most : 0.0;
}

void jox_page_add_danger(JoxPageFigures *f, const JoxDanger *danger) {
    for (int m = 0; m < JOX_DANGER_MEASURES; m++)
        jox_page_add(f, jox_danger_units[m], jox_danger_most(danger, (JoxDangerMeasure)m).value,
                     "danger: greatest %s", jox_danger_names[m]);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        JoxDangerCount count = jox_danger_count(danger, l);
        bool read = jox_danger_reads(danger, jox_danger_limits[l].measure);
        jox_page_add(f, "", read ? count.people : NAN, "danger: people ever over %s",
                     jox_danger_limits[l].key);
        jox_page_add(f, "s", read ? count.person_s : NAN, "danger: person-seconds over %s",
                     jox_danger_limits[l].key);
        jox_page_add(f, "s", read ? count.longest : NAN, "danger: longest of one person over %s",
                     jox_danger_limits[l].key);
    }
    add_lines(f, danger);
    jox_page_add(f, "N", danger->walls.known ? walls_most(danger) : NAN,
                 "danger: greatest load on a piece of a wall");
}

/* ---- parts of the page ---- */

static void put_place(FILE *out, double time, JoxV2 at) {
    if (isfinite(time))
        fprintf(out, "<td>%.1f&nbsp;s at (%.1f,&nbsp;%.1f)&nbsp;m", time, at.x, at.y);
    else
        fputs("<td>&ndash;", out);
}

static void put_texts(FILE *out, const JoxDanger *danger) {
    char text[1024];
    jox_html_paragraph(
        out, "Density is people per m2: each person is spread by a Gaussian of R = 1 m over the "
             "floor within the walls, which let nothing through. Its greatest value is that of any "
             "place; who is over a limit is told by the density where they stand.");
    snprintf(
        text, sizeof text,
        "Crowd pressure is the mean density about a place times the variance over time of the "
        "local velocity there, over %g s: how the crowd as a whole is shaken to and fro, not "
        "how people walk past each other; the mean of %g m by %g m about the place. It is read "
        "only where the crowd stood on %g m2 of these at %g per m2 or more all that time and "
        "the variance does not come from one change of the flow: a knot before a door, a queue "
        "that starts and a whole crowd that sways slower than every 15 s are not told. Its "
        "authors' 0.02 per s2 is for a section of 20 m by 14 m; recorded queues of people who "
        "were in no danger read 0.01 at most.%s",
        (double)JOX_PRESSURE_SPAN, (double)JOX_PRESSURE_SECTION, (double)JOX_PRESSURE_SECTION,
        (double)JOX_PRESSURE_FLOOR, (double)JOX_PRESSURE_LEAST,
        jox_danger_reads(danger, JOX_DANGER_PRESSURE)
            ? ""
            : " Here it was measured nowhere: its limit has dashes.");
    jox_html_paragraph(out, text);
    if (jox_danger_reads(danger, JOX_DANGER_LOAD)) {
        jox_html_paragraph(
            out, "Load is the greatest push that a person bears from any one direction: over "
                 "directions, the greatest sum of the positive parts of the contact forces along "
                 "it, in newtons, held on average for a second; a knock of one step counts little. "
                 "Limits for chests are forces of that kind.");
        jox_html_paragraph(out, jox_danger_dose_text);
    } else {
        jox_html_paragraph(out, "Load was not measured: this recording does not know the push that "
                                "people bear. Its limits, and those of dose, have dashes.");
    }
    if (jox_danger_reads(danger, JOX_DANGER_COMPRESSION))
        jox_html_paragraph(
            out, "Compression is another quantity: the sum of the magnitudes of all contact forces "
                 "over the girth 2 pi r, held likewise. It cannot be turned into a load and is "
                 "compared with no limit.");
    else
        jox_html_paragraph(out, "Compression was not measured.");
}

static void put_limits(FILE *out, const JoxDanger *danger) {
    jox_html_table(out, "limit|value|people ever over it|person-seconds|longest of one "
                        "person|first|minutes since|meaning|source");
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        const JoxDangerLimit *limit = &jox_danger_limits[l];
        JoxDangerCount count = jox_danger_count(danger, l);
        jox_html_row(out);
        jox_html_cell(out, limit->key);
        jox_html_cell_number(out, limit->value, jox_danger_units[limit->measure]);
        bool read = jox_danger_reads(danger, limit->measure);
        jox_html_cell_number(out, read ? count.people : NAN, "");
        jox_html_cell_number(out, read ? count.person_s : NAN, "s");
        jox_html_cell_number(out, read ? count.longest : NAN, "s");
        put_place(out, count.first, count.first_at);
        jox_html_cell_number(out, jox_danger_since(danger, count.first), "min");
        jox_html_cell(out, limit->what);
        jox_html_cell(out, limit->source);
    }
    jox_html_table_end(out);
}

static void put_most(FILE *out, const JoxDanger *danger) {
    jox_html_table(out, "measure|greatest|when and where");
    for (int m = 0; m < JOX_DANGER_MEASURES; m++) {
        JoxDangerMost most = jox_danger_most(danger, (JoxDangerMeasure)m);
        jox_html_row(out);
        jox_html_cell(out, jox_danger_names[m]);
        jox_html_cell_number(out, most.value, jox_danger_units[m]);
        put_place(out, most.time, most.at);
    }
    jox_html_table_end(out);
}

enum { SHOWN = 10 }; /* of people and of pieces of walls: those that bore most */

/* Those of the greatest values over 0, descending. */
static uint32_t most_of(const JoxDanger *danger, uint32_t count,
                        double (*value)(const JoxDanger *danger, uint32_t k),
                        uint32_t order[SHOWN]) {
    uint32_t shown = 0;
    for (uint32_t k = 0; k < count; k++) {
        if (!(value(danger, k) > 0.0))
            continue;
        uint32_t at = shown < SHOWN ? shown++ : SHOWN;
        for (; at > 0 && value(danger, order[at - 1]) < value(danger, k); at--)
            if (at < SHOWN)
                order[at] = order[at - 1];
        if (at < SHOWN)
            order[at] = k;
    }
    return shown;
}

static double dose_of_person(const JoxDanger *danger, uint32_t k) {
    return danger->people[k].dose;
}

static double most_of_piece(const JoxDanger *danger, uint32_t k) {
    return (double)danger->walls.items[k].most;
}

static void put_people(FILE *out, const JoxDanger *danger) {
    uint32_t order[SHOWN];
    const uint32_t shown = most_of(danger, danger->people_capacity, dose_of_person, order);
    if (shown == 0)
        return;
    jox_html_paragraph(out, "The people of the greatest doses; danger-people.csv lists all whose "
                            "dose is over 0.01 or whose load was over the first limit.");
    jox_html_table(out, "person|dose|greatest load|when and where|over 623 N|over 1112 N|over 6227 "
                        "N");
    for (uint32_t s = 0; s < shown; s++) {
        const JoxDangerPerson *person = &danger->people[order[s]];
        jox_html_row(out);
        fprintf(out, "<td class=n>%u", order[s]);
        jox_html_cell_number(out, person->dose, "");
        jox_html_cell_number(out, (double)person->most, "N");
        put_place(out, person->most_time, person->most_at);
        for (int l = 0; l < JOX_DANGER_LIMITS; l++)
            if (jox_danger_limits[l].measure == JOX_DANGER_LOAD)
                jox_html_cell_number(out, person->seconds[l], "s");
    }
    jox_html_table_end(out);
}

/* Fruin's levels: of everybody by area, and of lines by flow and area. */
static void put_levels(FILE *out, const JoxDanger *danger) {
    jox_html_heading(out, "Levels of service");
    jox_html_paragraph(
        out, "Of queues: by the area that each person has, 1 / density where they stand, "
             "in person-seconds. The maps of density have the same levels on their "
             "scales. Of walkways, at lines: by flow, but E or F where the area before the line is "
             "that of E or F, since a small flow may mean that nobody can move.");
    jox_html_table(out, "level|queue, m2 each from|person-seconds|walkway, m2 each from|walkway, "
                        "per m min to|in queues");
    for (int k = 0; k < JOX_LEVELS; k++) {
        jox_html_row(out);
        jox_html_cell(out, jox_levels[k].name);
        jox_html_cell_number(out, jox_levels[k].queue_area, "m2");
        jox_html_cell_number(out, danger->level_s[k], "s");
        jox_html_cell_number(out, jox_levels[k].walk_area, "m2");
        jox_html_cell_number(out, jox_levels[k].walk_flow, "1/(m min)");
        jox_html_cell(out, jox_levels[k].what);
    }
    jox_html_table_end(out);
    jox_html_paragraph(out, jox_levels_source);
}

static void put_spell(FILE *out, const JoxDanger *danger, const JoxDangerSpell *spell, bool known) {
    if (!known) {
        jox_html_cell(out, "not measured");
        jox_html_cell(out, "not measured");
        return;
    }
    jox_html_cell_number(out, spell->seconds, "s");
    if (isfinite(spell->first))
        fprintf(out, "<td>%.1f&nbsp;s, %.1f&nbsp;min ago", spell->first,
                jox_danger_since(danger, spell->first));
    else
        jox_html_cell(out, "never");
}

static void put_lines(FILE *out, const JoxDanger *danger) {
    const JoxDangerLines *lines = &danger->lines;
    jox_html_heading(out, "Lines: stop-and-go, congestion");
    if (lines->count == 0) {
        jox_html_paragraph(out, "Not measured: the scene has no probe `flow`, and a line is needed "
                                "over which people pass.");
        return;
    }
    jox_html_paragraph(
        out, "What lies of a line between walls about its middle is measured. Of the ten seconds "
             "before each moment; nothing is known of the first ten. Density is "
             "that of the people within 2 m of the line on the side that most come from; those "
             "who wait are the people in sight of its middle within 10 m there. Levels are the "
             "seconds that the walkway over the line was at A / B / C / D / E / F.");
    jox_html_table(out, "line|clear width|passed, back|greatest flow|worst level|seconds at "
                        "levels|stop-and-go|first|congestion|first");
    for (uint32_t l = 0; l < lines->count; l++) {
        const JoxDangerLine *line = &lines->items[l];
        const bool known = line->worst >= 0;
        jox_html_row(out);
        jox_html_cell(out, line->name);
        jox_html_cell_number(out, line->width, "m");
        fprintf(out, "<td class=n>%u, %u", line->forward, line->back);
        jox_html_cell_number(out, line->flow_most, "1/(m s)");
        jox_html_cell(out, known ? jox_levels[line->worst].name : "not measured");
        fputs("<td class=n>", out);
        for (int k = 0; k < JOX_LEVELS && known; k++)
            fprintf(out, "%s%.4g", k ? " / " : "", line->level_s[k]);
        put_spell(out, danger, &line->stop_and_go, known);
        put_spell(out, danger, &line->congestion, known);
    }
    jox_html_table_end(out);
    jox_html_paragraph(out, jox_stop_and_go_source);
    jox_html_paragraph(out, jox_congestion_source);
}

/* The pieces of walls that bore most. */
static void put_walls(FILE *out, const JoxDanger *danger) {
    const JoxDangerWalls *walls = &danger->walls;
    jox_html_heading(out, "Walls: what pieces of them bore");
    if (!walls->known) {
        jox_html_paragraph(out, "Not measured: loads on walls are not known here.");
        return;
    }
    char text[400];
    snprintf(text, sizeof text,
             "Forces of people across each piece of a side of a wall, at most 1 m long, held on "
             "average for a "
             "second. The limit is %g N on a rail: %s (%s). %u of %u pieces were ever over it.",
             JOX_RAIL_LIMIT, jox_rail_what, jox_rail_source, walls->over, walls->count);
    jox_html_paragraph(out, text);
    jox_html_table(out, "from|to|now|greatest|greatest, per metre|when|over 4500 N|first");
    uint32_t order[SHOWN], shown = most_of(danger, walls->count, most_of_piece, order);
    for (uint32_t s = 0; s < shown; s++) {
        const JoxDangerPiece *piece = &walls->items[order[s]];
        jox_html_row(out);
        fprintf(out, "<td>(%.2f,&nbsp;%.2f)<td>(%.2f,&nbsp;%.2f)", (double)piece->from.x,
                (double)piece->from.y, (double)piece->to.x, (double)piece->to.y);
        jox_html_cell_number(out, (double)piece->load, "N");
        jox_html_cell_number(out, (double)piece->most, "N");
        jox_html_cell_number(out, jox_danger_piece_line_load(piece), "N/m");
        jox_html_cell_number(out, piece->most_time, "s");
        jox_html_cell_number(out, piece->seconds, "s");
        jox_html_cell_number(out, piece->first, "s");
    }
    jox_html_table_end(out);
}

void jox_page_danger(FILE *out, const JoxDanger *danger) {
    jox_html_heading(out, "Danger: who was over which limit");
    put_texts(out, danger);
    put_limits(out, danger);
    put_most(out, danger);
    put_people(out, danger);
    put_levels(out, danger);
    put_lines(out, danger);
    put_walls(out, danger);
}
