/* The tables danger.csv and danger-*.csv: over time, by cell, by limit, person, level, line,
   stair, wall and area. */
#include <math.h>
#include <stdio.h>

#include "base/format/quote.h"
#include "picture/plot.h"
#include "record/storey_figures.h"
#include "report/danger_output_parts.h"

enum { MOST_CELLS_DRAWN = 250000 };
static const double WORTH = 0.01; /* least dose that is listed */

/* Writes a comma and a number, or nothing after the comma if it is not finite (not known). */
static void put_csv_value(FILE *out, double value) {
    fputc(',', out);
    if (isfinite(value))
        fprintf(out, "%.9g", value);
}

/* Writes danger.csv: a row per sample. */
static bool write_times(const JoxDanger *d, const char *folder, JoxText *error) {
    FILE *out = jox_plot_open(folder, "danger.csv", error);
    if (!out)
        return false;
    fputs("time [s],people", out);
    for (int m = 0; m < JOX_DANGER_MEASURES; m++)
        fprintf(out, *jox_danger_units[m] ? ",%s_max [%s]" : ",%s_max", jox_danger_names[m],
                jox_danger_units[m]);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++)
        fprintf(out, ",over_%s", jox_danger_limits[l].key);
    for (int k = 0; k < JOX_LEVELS; k++)
        fprintf(out, ",level_%s", jox_levels[k].name);
    fputs(",wall_load_max [N],left", out);
    for (uint32_t e = 0; e < d->exit_count; e++) {
        JoxText head = {0};
        jox_text_printf(&head, "left_%s", d->exit_names[e]);
        fputc(',', out);
        jox_quote_put(out, jox_quote_csv, head.data);
        jox_text_free(&head);
    }
    fputc('\n', out);
    for (uint32_t r = 0; r < d->row_count; r++) {
        const JoxDangerRow *row = &d->rows[r];
        fprintf(out, "%.9g,%u", row->time, row->people);
        for (int m = 0; m < JOX_DANGER_MEASURES; m++)
            put_csv_value(out, (double)row->most[m]);
        for (int l = 0; l < JOX_DANGER_LIMITS; l++)
            fprintf(out, ",%u", row->over[l]);
        for (int k = 0; k < JOX_LEVELS; k++)
            fprintf(out, ",%u", row->levels[k]);
        fprintf(out, ",%.9g,%u", (double)row->wall_most, row->left);
        for (uint32_t e = 0; e < d->exit_count; e++)
            fprintf(out, ",%u", row->exits[e]);
        fputc('\n', out);
    }
    return jox_plot_close(out, "danger.csv", error);
}

/* Returns a measure's mean in a cell, in its unit: over all samples, or for forces on people,
   over the samples of the people who stood there. NAN where crowd pressure was never measured. */
static double compute_cell_mean(const JoxDanger *d, int measure, size_t cell) {
    double n = measure >= JOX_DANGER_FIRST_BORNE ? d->stood[cell]
               : measure == JOX_DANGER_PRESSURE  ? d->measured[cell]
                                                 : d->samples;
    if (measure == JOX_DANGER_PRESSURE && n == 0.0)
        return NAN;
    return n > 0.0 ? d->sum[measure][cell] / n : 0.0;
}

double jox_danger_cell_greatest(const JoxDanger *d, int measure, size_t cell) {
    bool missing = measure == JOX_DANGER_PRESSURE && d->measured[cell] == 0;
    return missing ? NAN : (double)d->greatest[measure][cell];
}

/* Writes the mean at a cell, and the greatest value of the block of skip * skip cells that it
   stands for. */
static void put_map_cells(const JoxDanger *d, int measure, uint32_t column, uint32_t row,
                          uint32_t skip, FILE *out) {
    const JoxDensity *g = d->local->grid;
    double most = NAN;
    for (uint32_t r = row; r < row + skip && r < g->rows; r++)
        for (uint32_t c = column; c < column + skip && c < g->columns; c++)
            most = fmax(most, jox_danger_cell_greatest(d, measure, (size_t)r * g->columns + c));
    fprintf(out, ",%.4g,%.9g", compute_cell_mean(d, measure, (size_t)row * g->columns + column),
            most);
}

/* Writes danger-map.csv, a row per cell. Large maps are thinned to about MOST_CELLS_DRAWN rows. */
static bool write_danger_map(const JoxDanger *d, const char *folder, JoxText *error) {
    const JoxDensity *g = d->local->grid;
    uint32_t skip = 1;
    while ((g->columns / skip) * (g->rows / skip) > MOST_CELLS_DRAWN)
        skip++;
    FILE *out = jox_plot_open(folder, "danger-map.csv", error);
    if (!out)
        return false;
    const JoxStoreys *storeys = jox_density_storeys_of(g);
    fputs("x [m],y [m]", out);
    for (int m = 0; m < JOX_DANGER_MAPPED; m++)
        fprintf(out, ",%s_mean [%s],%s_max [%s]", jox_danger_names[m], jox_danger_units[m],
                jox_danger_names[m], jox_danger_units[m]);
    jox_csv_put_storey_title(out, storeys);
    fputc('\n', out);
    for (uint32_t row = 0; row < g->rows; row += skip) {
        if (isnan(jox_density_middle(g, (size_t)row * g->columns).y))
            continue; /* between the rows of two storeys */
        for (uint32_t column = 0; column < g->columns; column += skip) {
            const JoxV2 at = jox_density_middle(g, (size_t)row * g->columns + column);
            const JoxV2 plan = jox_in_plan(storeys, at);
            fprintf(out, "%.3f,%.3f", (double)plan.x, (double)plan.y);
            for (int m = 0; m < JOX_DANGER_MAPPED; m++)
                put_map_cells(d, m, column, row, skip, out);
            jox_csv_put_storey(out, storeys, at, true);
            fputc('\n', out);
        }
        fputc('\n', out);
    }
    return jox_plot_close(out, "danger-map.csv", error);
}

/* Writes danger-limits.csv: a row per published limit; empty cells where it was not measured. */
static bool write_limits(const JoxDanger *d, const char *folder, JoxText *error) {
    FILE *out = jox_plot_open(folder, "danger-limits.csv", error);
    if (!out)
        return false;
    const JoxStoreys *storeys = jox_density_storeys_of(d->local->grid);
    fputs("limit,measure,value,unit,people,person_s [s],longest [s],first [s],x [m],y [m],since "
          "[min],source",
          out);
    jox_csv_put_storey_title(out, storeys);
    fputc('\n', out);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        const JoxDangerLimit *limit = &jox_danger_limits[l];
        const JoxDangerCount count = jox_danger_count(d, l);
        const bool read = jox_danger_has_measure(d, limit->measure), seen = isfinite(count.first);
        fprintf(out, "%s,%s,%.9g,%s", limit->key, jox_danger_names[limit->measure], limit->value,
                jox_danger_units[limit->measure]);
        put_csv_value(out, read ? count.people : NAN);
        put_csv_value(out, read ? count.person_s : NAN);
        put_csv_value(out, read ? count.longest : NAN);
        put_csv_value(out, count.first);
        const JoxV2 plan = jox_in_plan(storeys, count.first_at);
        put_csv_value(out, seen ? (double)plan.x : NAN);
        put_csv_value(out, seen ? (double)plan.y : NAN);
        put_csv_value(out, jox_danger_minutes_since(d, count.first));
        fputc(',', out);
        jox_quote_put(out, jox_quote_csv, limit->source);
        jox_csv_put_storey(out, storeys, count.first_at, seen);
        fputc('\n', out);
    }
    return jox_plot_close(out, "danger-limits.csv", error);
}

/* Writes danger-people.csv: people whose load reached the lowest limit or whose dose reached
   WORTH. */
static bool write_people(const JoxDanger *d, const char *folder, JoxText *error) {
    FILE *out = jox_plot_open(folder, "danger-people.csv", error);
    if (!out)
        return false;
    fputs("person,load_max [N],at [s],x [m],y [m],dose", out);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++)
        if (jox_danger_limits[l].measure == JOX_DANGER_LOAD)
            fprintf(out, ",over_%s [s]", jox_danger_limits[l].key);
    const JoxStoreys *storeys = jox_density_storeys_of(d->local->grid);
    jox_csv_put_storey_title(out, storeys);
    fputc('\n', out);
    for (uint32_t k = 0; k < d->people_capacity; k++) {
        const JoxDangerPerson *p = &d->people[k];
        if ((double)p->most < jox_danger_lowest_limit(JOX_DANGER_LOAD) && p->dose < WORTH)
            continue;
        const JoxV2 plan = jox_in_plan(storeys, p->most_at);
        fprintf(out, "%u,%.9g,%.9g,%.4f,%.4f,%.9g", k, (double)p->most, p->most_time,
                (double)plan.x, (double)plan.y, p->dose);
        for (int l = 0; l < JOX_DANGER_LIMITS; l++)
            if (jox_danger_limits[l].measure == JOX_DANGER_LOAD)
                fprintf(out, ",%.9g", p->seconds[l]);
        jox_csv_put_storey(out, storeys, p->most_at, true);
        fputc('\n', out);
    }
    return jox_plot_close(out, "danger-people.csv", error);
}

/* Writes danger-levels.csv: definitions of the levels, and the person-seconds spent at each. */
static bool write_levels(const JoxDanger *d, const char *folder, JoxText *error) {
    FILE *out = jox_plot_open(folder, "danger-levels.csv", error);
    if (!out)
        return false;
    fputs("level,queue_area_from [m2],person_s [s],walkway_area_from [m2],walkway_flow_to [1/(m "
          "min)]",
          out);
    for (uint32_t l = 0; l < d->lines.count; l++) {
        JoxText head = {0};
        jox_text_printf(&head, "at_%s [s]", d->lines.items[l].name);
        fputc(',', out);
        jox_quote_put(out, jox_quote_csv, head.data);
        jox_text_free(&head);
    }
    fputc('\n', out);
    for (int k = 0; k < JOX_LEVELS; k++) {
        const JoxLevel *level = &jox_levels[k];
        fprintf(out, "%s,%.9g,%.9g,%.9g", level->name, level->queue_area, d->level_s[k],
                level->walk_area);
        put_csv_value(out, level->walk_flow);
        for (uint32_t l = 0; l < d->lines.count; l++)
            put_csv_value(out, d->lines.items[l].worst < 0 ? NAN : d->lines.items[l].level_s[k]);
        fputc('\n', out);
    }
    return jox_plot_close(out, "danger-levels.csv", error);
}

/* Writes danger-lines.csv: a row per line and sample. */
static bool write_lines(const JoxDanger *d, const char *folder, JoxText *error) {
    FILE *out = jox_plot_open(folder, "danger-lines.csv", error);
    if (!out)
        return false;
    fputs("line,time [s],width [m],forward,back,waiting,flow [1/(m s)],density_before "
          "[1/m2],queue_growth [1/s],level,stop_and_go\n",
          out);
    for (uint32_t l = 0; l < d->lines.count; l++)
        for (uint32_t r = 0; r < d->lines.items[l].row_count; r++) {
            const JoxDangerLineRow *row = &d->lines.items[l].rows[r];
            jox_quote_put(out, jox_quote_csv, d->lines.items[l].name);
            fprintf(out, ",%.9g,%.9g,%u,%u,%u", row->time, row->width, row->forward, row->back,
                    row->waiting[row->side]);
            put_csv_value(out, row->flow);
            put_csv_value(out, row->density);
            put_csv_value(out, row->growth);
            fprintf(out, ",%s,%d\n", row->level < 0 ? "" : jox_levels[row->level].name,
                    row->stop_and_go != 0);
        }
    return jox_plot_close(out, "danger-lines.csv", error);
}

/* Writes danger-stairs.csv: a row per stair between storeys and sample. */
static bool write_stairs(const JoxDanger *d, const char *folder, JoxText *error) {
    FILE *out = jox_plot_open(folder, "danger-stairs.csv", error);
    if (!out)
        return false;
    fputs("stair,time [s],up,down,people,flow [1/(m s)],density [1/m2],level\n", out);
    for (uint32_t k = 0; k < d->stairs.count; k++)
        for (uint32_t r = 0; r < d->stairs.items[k].row_count; r++) {
            const JoxDangerStairRow *row = &d->stairs.items[k].rows[r];
            jox_quote_put(out, jox_quote_csv, d->stairs.storeys->stairs[k].name);
            fprintf(out, ",%.9g,%u,%u,%u", row->time, row->up, row->down, row->people);
            put_csv_value(out, row->flow);
            put_csv_value(out, row->density);
            fprintf(out, ",%s\n", row->level < 0 ? "" : jox_levels[row->level].name);
        }
    return jox_plot_close(out, "danger-stairs.csv", error);
}

/* Writes danger-walls.csv: a row per piece of a side of a wall. */
static bool write_danger_walls(const JoxDanger *d, const char *folder, JoxText *error) {
    FILE *out = jox_plot_open(folder, "danger-walls.csv", error);
    if (!out)
        return false;
    const JoxStoreys *storeys = jox_density_storeys_of(d->local->grid);
    fputs("x0 [m],y0 [m],x1 [m],y1 [m],load [N],load_max [N],load_max [N/m],at [s],over_rail_4500 "
          "[s],first [s]",
          out);
    jox_csv_put_storey_title(out, storeys);
    fputc('\n', out);
    for (uint32_t p = 0; p < d->walls.count; p++) {
        const JoxDangerPiece *piece = &d->walls.items[p];
        const JoxV2 from = jox_danger_piece_in_plan(storeys, piece, piece->from),
                    to = jox_danger_piece_in_plan(storeys, piece, piece->to);
        fprintf(out, "%.4f,%.4f,%.4f,%.4f,%.9g,%.9g", (double)from.x, (double)from.y, (double)to.x,
                (double)to.y, (double)piece->load, (double)piece->most);
        put_csv_value(out, jox_danger_piece_line_load(piece));
        put_csv_value(out, piece->most_time);
        put_csv_value(out, piece->seconds);
        put_csv_value(out, piece->first);
        jox_csv_put_storey(out, storeys, jox_danger_piece_middle(piece), true);
        fputc('\n', out);
    }
    return jox_plot_close(out, "danger-walls.csv", error);
}

static bool write_congestion(const JoxDanger *d, const char *folder, JoxText *error) {
    FILE *out = jox_plot_open(folder, "danger-congestion.csv", error);
    if (!out)
        return false;
    jox_congestion_csv(&d->congestion, d->local->grid, out);
    return jox_plot_close(out, "danger-congestion.csv", error);
}

static bool write_areas(const JoxDanger *d, const char *folder, JoxText *error) {
    FILE *out = jox_plot_open(folder, "danger-areas.csv", error);
    if (!out)
        return false;
    jox_danger_areas_csv(&d->areas, out);
    return jox_plot_close(out, "danger-areas.csv", error);
}

static bool write_leaving(const JoxDanger *d, const char *folder, JoxText *error) {
    FILE *out = jox_plot_open(folder, "danger-leaving.csv", error);
    if (!out)
        return false;
    jox_leaving_csv(&d->leaving, d->exit_names, d->exit_count, out);
    return jox_plot_close(out, "danger-leaving.csv", error);
}

bool jox_danger_write_tables(const JoxDanger *d, const char *folder, JoxText *error) {
    return write_times(d, folder, error) && write_danger_map(d, folder, error) &&
           write_limits(d, folder, error) && write_levels(d, folder, error) &&
           write_congestion(d, folder, error) &&
           (d->areas.count == 0 || write_areas(d, folder, error)) &&
           (d->leaving.count == 0 || write_leaving(d, folder, error)) &&
           (d->lines.count == 0 || write_lines(d, folder, error)) &&
           (jox_danger_stairs_joining(&d->stairs) == 0 || write_stairs(d, folder, error)) &&
           (!d->walls.known || write_danger_walls(d, folder, error)) &&
           (!d->has_load || write_people(d, folder, error));
}
