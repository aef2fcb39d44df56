/* Sections of the pages of reports: levels of service, congestion, lines, loads on walls, and
   who left when. */
#include <math.h>

#include "geom/storey_text.h"
#include "picture/html.h"
#include "record/danger/danger_parts.h"
#include "report/danger_outputs.h"
#include "report/page_parts.h"
#include "report/page_table.h"

/* N: loads below are written as 0; they are remains, after the last contact, of a mean over a
   second */
static const float NOTHING = 0.05f;

/* Writes the person-seconds at each of Fruin's levels for queues. */
static void put_queue_levels(FILE *out, const JoxSubject *s) {
    const JoxDanger *danger = s->danger;
    JoxPageTable table = jox_page_table(s, "levels",
                                        "level|>each person has at least [m2]|>time of all people "
                                        "[person-seconds]|>share of it [%]|people in such a queue");
    double all = 0.0;
    table.zero_rows = "Nobody was at level";
    for (int k = 0; k < JOX_LEVELS; k++)
        all += danger->level_s[k];
    for (int k = 0; k < JOX_LEVELS; k++) {
        char area[32];
        snprintf(area, sizeof area, "%g", jox_levels[k].queue_area);
        jox_table_text(&table, jox_levels[k].name);
        jox_table_text(&table, area);
        jox_table_number(&table, danger->level_s[k]);
        jox_table_number(&table, all > 0.0 ? 100.0 * danger->level_s[k] / all : NAN);
        jox_table_text(&table, jox_levels[k].what);
    }
    jox_table_put(out, &table);
}

/* Writes a table of the areas with their time at each level of service. */
static void put_area_levels(FILE *out, const JoxSubject *s) {
    const JoxDanger *danger = s->danger;
    JoxPageTable table = jox_page_table(
        s, "areas",
        "area|>size [m2]|>most people at a time|>greatest mean density at its people "
        "[1/m2]|>at [s]|>time at A [s]|>time at B [s]|>time at C [s]|>time at D [s]|>time at E "
        "[s]|>time at F [s]");
    table.zero_rows = "Nobody was seen in";
    for (uint32_t a = 0; a < danger->areas.count; a++) {
        const JoxDangerArea *area = &danger->areas.items[a];
        char size[32];
        snprintf(size, sizeof size, "%.4g", area->surface);
        jox_table_text(&table, area->name);
        jox_table_text(&table, size);
        jox_table_number(&table, area->most_people);
        jox_table_number(&table, (double)area->most);
        jox_table_number(&table, area->most_time);
        for (int k = 0; k < JOX_LEVELS; k++)
            jox_table_number(&table, area->level_s[k]);
    }
    jox_table_put(out, &table);
}

/* Writes the plot of people at each level and of the level of each area; a sentence in its place if
   all people were at one level all the time. */
static void put_level_plot(FILE *out, const JoxSubject *s) {
    const JoxDanger *danger = s->danger;
    const int strips = jox_danger_count_level_strips(danger);
    char text[160];
    if (strips) {
        jox_html_strips(
            out, s->folder, "levels",
            strips > 1 ? "Above: number of people at each level, by the density where they "
                         "stand " JOX_DENSITY_BY ". Below: the level of each area, by its mean."
                       : "Number of people at each level, by the density where they "
                         "stand " JOX_DENSITY_BY ".",
            &(JoxStrips){.count = strips,
                         .width = JOX_DANGER_STRIPS_WIDE,
                         .height = jox_danger_level_strip_height(danger)});
        return;
    }
    for (int k = 0; k < JOX_LEVELS; k++)
        if (danger->level_s[k] > 0.0) {
            snprintf(text, sizeof text, "All people were at level %s all the time.",
                     jox_levels[k].name);
            jox_html_paragraph(out, text);
        }
}

static void put_level_section(FILE *out, const JoxSubject *s) {
    jox_html_heading(out, "Levels of service");
    jox_html_paragraph(
        out, "Levels for queues, by the area that each person has: 1 / density where they "
             "stand " JOX_DENSITY_BY ". An area "
             "is at the level of the mean density about the people in it; the maps of density have "
             "the same levels on their scales.");
    put_level_plot(out, s);
    put_area_levels(out, s);
    put_queue_levels(out, s);
    jox_html_statement(out, "Source of the levels:", jox_levels_source);
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
    jox_html_statement(out, "Source:", jox_congestion_source);
    if (!found.known)
        jox_html_paragraph(out, "Not judged: too little time was measured.");
    else if (found.count == 0)
        jox_html_paragraph(out, "There were none.");
    if (found.count) {
        JoxPageTable table =
            jox_page_table(s, "congestion",
                           "place where it lasted longest|>time above [s]|>from [s]|>until "
                           "[s]|>area of the region [m2]|>greatest density in it [1/m2]");
        for (uint32_t r = 0; r < found.count && r < JOX_PAGE_SHOWN; r++) {
            const JoxCongestionRegion *region = &found.regions[r];
            JoxText where = {0};
            jox_describe_point(s, region->at, &where);
            jox_table_text(&table, where.data);
            jox_table_number(&table, region->seconds);
            jox_table_number(&table, region->first);
            jox_table_number(&table, region->last);
            jox_table_number(&table, region->area);
            jox_table_number(&table, (double)region->most);
            jox_text_free(&where);
        }
        jox_table_put(out, &table);
    }
    jox_congestion_found_free(&found);
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
        jox_html_paragraph(out, "Not measured: the recording has no forces on walls.");
        return;
    }
    char text[400];
    snprintf(text, sizeof text,
             "Forces of people perpendicular to each piece of a side of a wall, at most 1 m long, "
             "as a mean over a second. The limit is %g N on a rail: %s (%s). %u of %u pieces were "
             "over it at some time.",
             JOX_RAIL_LIMIT, jox_rail_what, jox_rail_source, walls->over, walls->count);
    jox_html_paragraph(out, text);
    JoxPageTable table = jox_page_table(s, "wall-loads",
                                        "from [m]|to [m]|>greatest load [N]|>per metre [N/m]|>at "
                                        "[s]|>load at the end [N]|>time over "
                                        "4500 N [s]|>first over it at [s]");
    uint32_t order[JOX_PAGE_SHOWN],
        shown = jox_page_rank_greatest(danger, walls->count, greatest_load_of_piece, order);
    for (uint32_t k = 0; k < shown; k++) {
        const JoxDangerPiece *piece = &walls->items[order[k]];
        const JoxV2 ends[2] = {jox_danger_piece_in_plan(s->storeys, piece, piece->from),
                               jox_danger_piece_in_plan(s->storeys, piece, piece->to)};
        for (int end = 0; end < 2; end++) {
            JoxText point = {0};
            jox_text_printf(&point, "(%.2f, %.2f)", (double)ends[end].x, (double)ends[end].y);
            if (end == 0)
                jox_text_storey(&point, s->storeys, jox_danger_piece_middle(piece));
            jox_table_text(&table, point.data);
            jox_text_free(&point);
        }
        jox_table_number(&table, (double)piece->most);
        jox_table_number(&table, jox_danger_piece_line_load(piece));
        jox_table_number(&table, piece->most_time);
        jox_table_number(&table, piece->load < NOTHING ? 0 : (double)piece->load);
        jox_table_number(&table, piece->seconds);
        jox_table_number(&table, piece->first);
    }
    if (shown == 0)
        jox_html_paragraph(out, "Nobody pressed on a wall.");
    jox_table_put(out, &table);
}

/* ---- who left ---- */

/* Adds a row of the times by which given shares of the people had left by an exit. */
static void add_leaving_times(JoxPageTable *table, const JoxLeaving *leaving, int32_t exit,
                              const char *name) {
    static const double SHARES[] = {0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0};
    jox_table_text(table, name);
    jox_table_number(table, (double)jox_leaving_count(leaving, exit));
    for (size_t k = 0; k < sizeof SHARES / sizeof *SHARES; k++)
        jox_table_number(table, jox_leaving_quantile(leaving, exit, SHARES[k]));
}

void jox_page_put_leaving(FILE *out, const JoxSubject *s) {
    const JoxLeaving *leaving = &s->danger->leaving;
    jox_html_heading(out, "Times of leaving");
    if (leaving->count == 0) {
        jox_html_paragraph(out, "Nobody left.");
        return;
    }
    jox_html_paragraph(out, "Times by which the first person, 5 %, 25 % ... of all people who left "
                            "by an exit had left. Each person is counted once, in the step in "
                            "which they are removed; danger-leaving.csv has each of these times.");
    JoxPageTable table = jox_page_table(
        s, "leaving",
        "exit|>people|>first [s]|>5 % [s]|>25 % [s]|>half [s]|>75 % [s]|>95 % [s]|>last [s]");
    table.zero_rows = "Nobody left by";
    add_leaving_times(&table, leaving, JOX_LEFT_ANYWHERE, "all");
    for (uint32_t e = 0; e < s->danger->exit_count; e++)
        add_leaving_times(&table, leaving, (int32_t)e, s->danger->exit_names[e]);
    if (s->danger->exit_count && jox_leaving_count(leaving, JOX_LEFT_ELSEWHERE))
        add_leaving_times(&table, leaving, JOX_LEFT_ELSEWHERE, "elsewhere");
    jox_table_put(out, &table);
    jox_html_figure(out, s->folder, "leaving", "People who have left over time", true);
}

void jox_page_put_levels(FILE *out, const JoxSubject *s) {
    put_level_section(out, s);
    put_congestion_section(out, s);
    jox_page_put_lines(out, s);
    jox_page_put_stairs(out, s);
    jox_page_put_lifts(out, s);
    put_wall_section(out, s);
}
