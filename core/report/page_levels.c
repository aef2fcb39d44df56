/* Sections of the pages of reports: levels of service, congestion, lines, loads on walls, and
   who left when. */
#include <math.h>

#include "picture/html.h"
#include "record/danger/danger_parts.h"
#include "report/page_parts.h"

/* N: loads below are written as 0; they are remains, after the last contact, of a mean over a
   second */
static const float NOTHING = 0.05f;

/* Writes the person-seconds at each of Fruin's levels for queues. */
static void put_queue_levels(FILE *out, const JoxDanger *danger) {
    double all = 0.0;
    for (int k = 0; k < JOX_LEVELS; k++)
        all += danger->level_s[k];
    jox_html_table(out, "level|>each has, from|>person-seconds|>share|people in such a queue");
    for (int k = 0; k < JOX_LEVELS; k++) {
        jox_html_row(out);
        jox_html_cell(out, jox_levels[k].name);
        jox_html_cell_number(out, jox_levels[k].queue_area, "m2");
        jox_html_cell_number(out, danger->level_s[k], "s");
        jox_html_cell_number(out, all > 0.0 ? 100.0 * danger->level_s[k] / all : NAN, "%");
        jox_html_cell(out, jox_levels[k].what);
    }
    jox_html_table_end(out);
}

/* Writes a table of the areas with their time at each level of service. */
static void put_area_levels(FILE *out, const JoxDanger *danger) {
    if (danger->areas.count == 0)
        return;
    jox_html_table(out, "area|>size|>most people|>densest, mean of its people|>when|>seconds at "
                        "A|>B|>C|>D|>E|>F");
    for (uint32_t a = 0; a < danger->areas.count; a++) {
        const JoxDangerArea *area = &danger->areas.items[a];
        jox_html_row(out);
        jox_html_cell(out, area->name);
        jox_html_cell_number(out, area->surface, "m2");
        fprintf(out, "<td class=n>%u", area->most_people);
        jox_html_cell_number(out, (double)area->most, "1/m2");
        jox_html_cell_number(out, area->most_time, "s");
        for (int k = 0; k < JOX_LEVELS; k++)
            jox_html_cell_number(out, area->level_s[k], "");
    }
    jox_html_table_end(out);
}

static void put_level_section(FILE *out, const JoxSubject *s) {
    jox_html_heading(out, "Levels of service by area and time");
    jox_html_paragraph(
        out, "Levels for queues, by the area that each person has: 1 / density where they "
             "stand " JOX_DENSITY_BY ". An area "
             "is at the level of the mean density about the people in it; the maps of density have "
             "the same levels on their scales.");
    jox_html_figure(out, s->folder, "levels",
                    "Above: how many people were at each level. Below: the level of each area.",
                    true);
    put_area_levels(out, s->danger);
    put_queue_levels(out, s->danger);
    jox_html_paragraph(out, jox_levels_source);
}

/* Writes two cells: the total time of a spell, and when it first occurred. */
static void put_spell_cells(FILE *out, const JoxDanger *danger, const JoxDangerSpell *spell,
                            bool known) {
    if (!known) {
        jox_html_cell(out, "not measured");
        jox_html_cell(out, "not measured");
        return;
    }
    jox_html_cell_number(out, spell->seconds, "s");
    if (isfinite(spell->first))
        fprintf(out, "<td>%.1f&nbsp;s, %.1f&nbsp;min ago", spell->first,
                jox_danger_minutes_since(danger, spell->first));
    else
        jox_html_cell(out, "never");
}

/* Writes the section on regions of significant congestion. */
static void put_congestion_section(FILE *out, const JoxSubject *s) {
    const JoxDanger *danger = s->danger;
    JoxCongestionFound found = jox_congestion_find(&danger->congestion, danger->local->grid);
    char text[400];
    jox_html_heading(out, "Congestion");
    snprintf(text, sizeof text,
             "Regions in which the density " JOX_DENSITY_BY
             " was above %g per m\xc2\xb2, in all for longer than %.0f "
             "%% of %s, %.1f s. The time is that at the place of a region where it lasted longest; "
             "first and last are of all the region.",
             (double)JOX_CONGESTION_DENSITY, 100.0 * JOX_CONGESTION_SHARE,
             found.cleared ? "the time until nobody was inside"
                           : "the time measured so far, since people are still inside",
             found.time);
    jox_html_paragraph(out, text);
    jox_html_paragraph(out, jox_congestion_source);
    if (!found.known)
        jox_html_paragraph(out, "Not judged: too little time was measured.");
    else if (found.count == 0)
        jox_html_paragraph(out, "There were none.");
    if (found.count) {
        jox_html_table(out, "where it lasted longest|>time above|>first|>last|>area|>greatest "
                            "density");
        for (uint32_t r = 0; r < found.count && r < JOX_PAGE_SHOWN; r++) {
            const JoxCongestionRegion *region = &found.regions[r];
            JoxText where = {0};
            jox_describe_point(s, region->at, &where);
            jox_html_row(out);
            jox_html_cell(out, where.data);
            jox_html_cell_number(out, region->seconds, "s");
            jox_html_cell_number(out, region->first, "s");
            jox_html_cell_number(out, region->last, "s");
            jox_html_cell_number(out, region->area, "m2");
            jox_html_cell_number(out, region->most, "1/m2");
            jox_text_free(&where);
        }
        jox_html_table_end(out);
    }
    jox_congestion_found_free(&found);
}

/* Writes the section on lines: widths, crossings, flows, levels and stop-and-go. */
static void put_line_section(FILE *out, const JoxSubject *s) {
    const JoxDanger *danger = s->danger;
    const JoxDangerLines *lines = &danger->lines;
    jox_html_heading(out, "Doors and other lines");
    if (lines->count == 0) {
        jox_html_paragraph(out,
                           "Not measured: the scene has no probe `flow` with a line that people "
                           "cross.");
        return;
    }
    jox_html_paragraph(
        out,
        "A line is measured where walls leave it open, a line of gates over all its gates. "
        "Crossings are counted from the beginning on in both directions, also those of people who "
        "step back; the line's probe counts in its own time window, in one direction, less those "
        "who step back. All else is measured over the ten seconds before each moment and unknown "
        "for the first ten. Density " JOX_DENSITY_BY " is that of the people within 2 m of the "
        "line on the side from which most people come. The queue is the people within 10 m there "
        "in sight of the middle of an opening; it grows by inflow less outflow, people per "
        "second. Levels are Fruin's for walkways, by flow, but E or F where the area per person "
        "before the line is that of E or F, since a small flow may mean that nobody can move; the "
        "seconds are those at A / B / C / D / E / F.");
    jox_html_table(
        out, "line|>clear width|>crossed forward, back|>greatest flow|worst level|>seconds at "
             "levels|>stop-and-go|first|>greatest growth of the queue|>when");
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
        put_spell_cells(out, danger, &line->stop_and_go, known);
        jox_html_cell_number(out, line->growth_most, "1/s");
        jox_html_cell_number(out, line->growth_most_time, "s");
    }
    jox_html_table_end(out);
    jox_html_paragraph(out, jox_stop_and_go_source);
}

static double greatest_load_of_piece(const JoxDanger *danger, uint32_t k) {
    return (double)danger->walls.items[k].most;
}

/* Writes the section on loads of walls: the pieces with the greatest loads. */
static void put_wall_section(FILE *out, const JoxSubject *s) {
    const JoxDanger *danger = s->danger;
    const JoxDangerWalls *walls = &danger->walls;
    jox_html_heading(out, "Loads on walls");
    if (!walls->known) {
        jox_html_paragraph(out, "Not measured: loads on walls are not known here.");
        return;
    }
    char text[400];
    snprintf(text, sizeof text,
             "Forces of people perpendicular to each piece of a side of a wall, at most 1 m long, "
             "as a mean over a second. The limit is %g N on a rail: %s (%s). %u of %u pieces were "
             "ever over it.",
             JOX_RAIL_LIMIT, jox_rail_what, jox_rail_source, walls->over, walls->count);
    jox_html_paragraph(out, text);
    jox_html_table(out,
                   "from|to|>at the end|>greatest|>greatest, per metre|>when|>over 4500 N|>first");
    uint32_t order[JOX_PAGE_SHOWN],
        shown = jox_page_rank_greatest(danger, walls->count, greatest_load_of_piece, order);
    for (uint32_t k = 0; k < shown; k++) {
        const JoxDangerPiece *piece = &walls->items[order[k]];
        jox_html_row(out);
        fprintf(out, "<td>(%.2f,&nbsp;%.2f)<td>(%.2f,&nbsp;%.2f)", (double)piece->from.x,
                (double)piece->from.y, (double)piece->to.x, (double)piece->to.y);
        jox_html_cell_number(out, piece->load < NOTHING ? 0 : (double)piece->load, "N");
        jox_html_cell_number(out, (double)piece->most, "N");
        jox_html_cell_number(out, jox_danger_piece_line_load(piece), "N/m");
        jox_html_cell_number(out, piece->most_time, "s");
        jox_html_cell_number(out, piece->seconds, "s");
        jox_html_cell_number(out, piece->first, "s");
    }
    jox_html_table_end(out);
}

/* ---- who left ---- */

/* Writes a row of the times by which given shares of the people had left by an exit. */
static void put_leaving_times(FILE *out, const JoxLeaving *leaving, int32_t exit,
                              const char *name) {
    static const double SHARES[] = {0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0};
    jox_html_row(out);
    jox_html_cell(out, name);
    fprintf(out, "<td class=n>%llu", (unsigned long long)jox_leaving_count(leaving, exit));
    for (size_t k = 0; k < sizeof SHARES / sizeof *SHARES; k++)
        jox_html_cell_number(out, jox_leaving_quantile(leaving, exit, SHARES[k]), "s");
}

void jox_page_put_leaving(FILE *out, const JoxSubject *s) {
    const JoxLeaving *leaving = &s->danger->leaving;
    jox_html_heading(out, "Who left when and where");
    if (leaving->count == 0) {
        jox_html_paragraph(out, "Nobody left.");
        return;
    }
    jox_html_paragraph(out, "Times by which the first person, 5 %, 25 % ... of all people who left "
                            "by an exit had left.");
    jox_html_table(out, "exit|>people|>first|>5 %|>25 %|>half|>75 %|>95 %|>last");
    put_leaving_times(out, leaving, JOX_LEFT_ANYWHERE, "all");
    for (uint32_t e = 0; e < s->danger->exit_count; e++)
        put_leaving_times(out, leaving, (int32_t)e, s->danger->exit_names[e]);
    if (s->danger->exit_count && jox_leaving_count(leaving, JOX_LEFT_ELSEWHERE))
        put_leaving_times(out, leaving, JOX_LEFT_ELSEWHERE, "elsewhere");
    jox_html_table_end(out);
    jox_html_figure(out, s->folder, "leaving", "People who have left over time", true);
}

void jox_page_put_levels(FILE *out, const JoxSubject *s) {
    put_level_section(out, s);
    put_congestion_section(out, s);
    put_line_section(out, s);
    put_wall_section(out, s);
}
