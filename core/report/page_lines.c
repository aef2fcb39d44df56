/* The section on lines that people cross, on the pages of reports: counts beside those of exits and
   probes, flows, levels of service, queues. */
#include <math.h>
#include <string.h>

#include "picture/html.h"
#include "record/danger/danger_parts.h"
#include "report/page_parts.h"
#include "report/page_table.h"

static const char TEXT[] =
    "A line is measured where walls leave it open, a line of gates over all its gates. Flow is "
    "people who pass in either direction within the ten seconds before a moment, per metre of "
    "clear width; it is unknown for the first ten seconds, as are level and queue. Density about "
    "the line " JOX_DENSITY_BY " is that of the people within 2 m of it on the side from which "
    "most people come. The queue is the people within 10 m there in sight of the middle of an "
    "opening; it grows by inflow less outflow. Levels are Fruin's for walkways, by flow, but E or "
    "F where the area per person before the line is that of E or F, since a small flow may mean "
    "that nobody can move.";

/* Returns the probe `flow` of a line; NULL: none. */
static const JoxProbe *find_line_probe(const JoxSubject *s, const JoxDangerLine *line) {
    for (uint32_t p = 0; p < s->probe_count; p++) {
        const JoxProbeDef *def = jox_probe_def(s->probes[p]);
        if (def->kind == JOX_PROBE_FLOW && strcmp(def->name, line->name) == 0)
            return s->probes[p];
    }
    return NULL;
}

/* Appends why a probe counts fewer passages than the line less those who came back; nothing if it
   counts as many. */
static void say_probe_difference(const JoxProbe *probe, const JoxDangerLine *line, JoxText *out) {
    const JoxProbeDef *def = jox_probe_def(probe);
    JoxText window = {0};
    if (jox_probe_passages(probe) + line->back == line->forward)
        return;
    jox_probe_window(probe, &window);
    if (window.length)
        jox_text_printf(out, "its probe counts %s", window.data);
    if (def->group_count)
        jox_text_printf(out, "%sits probe counts some groups only", out->length ? ", " : "");
    if (!out->length)
        jox_text_add(out, "more came back than went on, or people left on the line");
    jox_text_free(&window);
}

/* Writes how many people crossed each line, beside the count of its probe. */
static void put_line_counts(FILE *out, const JoxSubject *s) {
    const JoxDangerLines *lines = &s->danger->lines;
    JoxPageTable table = jox_page_table(
        s, "line-counts",
        "line|>clear width [m]|>crossed forward|>crossed back|>net|>counted by its probe|why these "
        "differ");
    jox_html_paragraph(
        out,
        "Crossings: each time that somebody crosses counts once, from the right of the line "
        "to its left (forward) and back, over the whole run. The net is people: those who step "
        "back cancel out. The line's probe counts the net too, within its own time window and "
        "groups. An exit counts people who are removed in its place, behind the line.");
    for (uint32_t l = 0; l < lines->count; l++) {
        const JoxDangerLine *line = &lines->items[l];
        const JoxProbe *probe = find_line_probe(s, line);
        JoxText why = {0};
        if (probe)
            say_probe_difference(probe, line, &why);
        jox_table_text(&table, line->name);
        jox_table_number(&table, line->width);
        jox_table_number(&table, line->forward);
        jox_table_number(&table, line->back);
        jox_table_number(&table, (double)line->forward - line->back);
        jox_table_number(&table, probe ? jox_probe_passages(probe) : NAN);
        jox_table_text(&table, why.data);
        jox_text_free(&why);
    }
    jox_table_put(out, &table);
}

/* Writes the greatest flow, the worst level, stop-and-go and the queue of each line. */
static void put_line_flows(FILE *out, const JoxSubject *s) {
    const JoxDangerLines *lines = &s->danger->lines;
    JoxPageTable table = jox_page_table(s, "lines",
                                        "line|>greatest flow [1/(m s)]|>at [s]|worst level|>time "
                                        "at A [s]|>time at B [s]|>time at C [s]|"
                                        ">time at D [s]|>time at E [s]|>time at F [s]|>time of "
                                        "stop-and-go [s]|>stop-and-go first at [s]|>"
                                        "fastest growth of the queue [1/s]|>growth at [s]");
    table.zero_rows = "Nobody crossed, or less than ten seconds were measured";
    for (uint32_t l = 0; l < lines->count; l++) {
        const JoxDangerLine *line = &lines->items[l];
        const bool known = line->worst >= 0;
        jox_table_text(&table, line->name);
        jox_table_number(&table, line->flow_most);
        jox_table_number(&table, line->flow_most_time);
        jox_table_text(&table, known ? jox_levels[line->worst].name : "not measured");
        for (int k = 0; k < JOX_LEVELS; k++)
            jox_table_number(&table, known ? line->level_s[k] : NAN);
        jox_table_number(&table, known ? line->stop_and_go.seconds : NAN);
        jox_table_number(&table, line->stop_and_go.first);
        jox_table_number(&table, line->growth_most > 0.0 ? line->growth_most : NAN);
        jox_table_number(&table, line->growth_most > 0.0 ? line->growth_most_time : NAN);
    }
    jox_table_put(out, &table);
}

void jox_page_put_lines(FILE *out, const JoxSubject *s) {
    jox_html_heading(out, "Doors and other lines");
    if (s->danger->lines.count == 0) {
        jox_html_paragraph(
            out, "Not measured: the scene names no line to measure (a probe of the kind flow).");
        return;
    }
    put_line_counts(out, s);
    jox_html_paragraph(out, TEXT);
    put_line_flows(out, s);
    jox_html_statement(out, "Stop-and-go:", jox_stop_and_go_source);
}
