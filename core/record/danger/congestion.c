/* Counts the time of each cell above the limit, and joins cells into congested regions at the
   end. */
#include "record/danger/congestion.h"

#include <math.h>

#include "base/mem.h"
#include "base/sort.h"
#include "record/fields/pressure.h"
#include "record/storey_figures.h"

enum { TOLD = 8 }; /* regions that summaries list */

const char jox_congestion_source[] =
    "IMO MSC.1/Circ.1533, advanced method, as its open implementations quote it: local density "
    "above 4 per m\xc2\xb2, significant where a region stays so for longer than 10 % of the time "
    "that "
    "everybody takes to leave";

JoxCongestion jox_congestion_create(const JoxDensity *grid) {
    JoxCongestion c = {.begun = NAN, .last = NAN, .emptied = NAN};
    c.count = (size_t)grid->columns * grid->rows;
    c.cells = jox_alloc(c.count, sizeof *c.cells);
    return c;
}

void jox_congestion_frame(JoxCongestion *c, uint32_t people, double time) {
    if (isnan(c->begun)) /* the first frame of a run comes one step after its beginning */
        c->begun = time > 0.0 && time <= JOX_PRESSURE_PACE ? 0.0 : time;
    c->last = time;
    if (people)
        c->emptied = NAN;
    else if (isnan(c->emptied))
        c->emptied = time;
}

void jox_congestion_sample(JoxCongestion *c, const JoxDensity *grid, double time, double duration) {
    for (size_t k = 0; k < c->count; k++) {
        if (!(grid->now[k] > JOX_CONGESTION_DENSITY))
            continue;
        JoxCongestionCell *cell = &c->cells[k];
        if (cell->most == 0.0f)
            cell->first = (float)(time - duration);
        cell->last = (float)time;
        cell->seconds += (float)duration;
        cell->most = jox_maxf(cell->most, grid->now[k]);
    }
}

/* ---- regions ---- */

/* Flood fill that collects cells into regions. `taken` marks the cells already in one. */
typedef struct Search {
    const JoxCongestion *congestion;
    const JoxDensity *grid;
    float least; /* s: cells of a region were above the density for longer than this */
    uint8_t *taken;
    size_t *queue; /* cells of the region; the neighbours of the first `seen` were visited */
    size_t count, capacity, seen;
} Search;

static void queue_cell(Search *s, size_t cell) {
    if (s->taken[cell] || !(s->congestion->cells[cell].seconds > s->least))
        return;
    s->taken[cell] = 1;
    JOX_RESERVE(s->queue, s->capacity, s->count + 1);
    s->queue[s->count++] = cell;
}

static void queue_neighbours(Search *s, size_t cell) {
    const int64_t columns = s->grid->columns, rows = s->grid->rows;
    const int64_t column = (int64_t)cell % columns, row = (int64_t)cell / columns;
    for (int64_t r = row - 1; r <= row + 1; r++)
        for (int64_t c = column - 1; c <= column + 1; c++)
            if (r >= 0 && r < rows && c >= 0 && c < columns)
                queue_cell(s, (size_t)(r * columns + c));
}

static void add_cell(JoxCongestionRegion *region, const Search *s, size_t cell) {
    const JoxCongestionCell *c = &s->congestion->cells[cell];
    const JoxV2 middle = jox_density_middle(s->grid, cell);
    const float half = 0.5f * s->grid->cell;
    const JoxV2 low = {middle.x - half, middle.y - half}, high = {middle.x + half, middle.y + half};
    if ((double)c->seconds > region->seconds) {
        region->seconds = (double)c->seconds;
        region->at = middle;
    }
    region->first = fmin(region->first, (double)c->first);
    region->last = fmax(region->last, (double)c->last);
    region->most = fmax(region->most, (double)c->most);
    region->area += (double)jox_density_area(s->grid, cell);
    region->low = (JoxV2){jox_minf(region->low.x, low.x), jox_minf(region->low.y, low.y)};
    region->high = (JoxV2){jox_maxf(region->high.x, high.x), jox_maxf(region->high.y, high.y)};
}

/* Collects the cells connected to `cell` into a region. */
static JoxCongestionRegion flood_region(Search *s, size_t cell) {
    const JoxV2 middle = jox_density_middle(s->grid, cell);
    JoxCongestionRegion region = {
        .first = INFINITY, .last = -INFINITY, .low = middle, .high = middle};
    s->count = s->seen = 0;
    queue_cell(s, cell);
    while (s->seen < s->count) {
        const size_t next = s->queue[s->seen++];
        add_cell(&region, s, next);
        queue_neighbours(s, next);
    }
    return region;
}

static int compare_regions(const void *a, const void *b, const void *context) {
    const JoxCongestionRegion *x = a, *y = b;
    (void)context;
    return (x->seconds < y->seconds) - (x->seconds > y->seconds);
}

/* Finds the cell that was above the limit longest, and the first time of any cell. */
static void find_longest(const JoxCongestion *c, const JoxDensity *grid,
                         JoxCongestionFound *found) {
    found->longest = 0.0;
    found->first = NAN;
    for (size_t k = 0; k < c->count; k++) {
        if (c->cells[k].most == 0.0f)
            continue;
        found->first = fmin(found->first, (double)c->cells[k].first);
        if ((double)c->cells[k].seconds <= found->longest)
            continue;
        found->longest = (double)c->cells[k].seconds;
        found->longest_at = jox_density_middle(grid, k);
    }
}

JoxCongestionFound jox_congestion_find(const JoxCongestion *c, const JoxDensity *grid) {
    JoxCongestionFound found = {.cleared = isfinite(c->emptied)};
    found.time = (found.cleared ? c->emptied : c->last) - c->begun;
    found.known = found.time >= JOX_CONGESTION_LEAST || (found.cleared && found.time > 0.0);
    find_longest(c, grid, &found);
    if (!found.known)
        return found;
    Search search = {.congestion = c, .grid = grid};
    search.least = (float)(JOX_CONGESTION_SHARE * found.time);
    search.taken = jox_alloc(c->count, 1);
    uint32_t capacity = 0;
    for (size_t k = 0; k < c->count; k++) {
        if (search.taken[k] || !(c->cells[k].seconds > search.least))
            continue;
        JOX_RESERVE(found.regions, capacity, found.count + 1);
        found.regions[found.count++] = flood_region(&search, k);
    }
    jox_free(search.taken);
    jox_free(search.queue);
    jox_sort(found.regions, found.count, sizeof *found.regions, compare_regions, NULL, NULL);
    return found;
}

void jox_congestion_found_free(JoxCongestionFound *found) {
    jox_free(found->regions);
    *found = (JoxCongestionFound){.first = NAN};
}

/* ---- figures ---- */

static void write_region(JoxJson *json, const JoxStoreys *storeys,
                         const JoxCongestionRegion *region) {
    jox_json_object(json, NULL);
    jox_json_number(json, "seconds", region->seconds);
    jox_json_number(json, "first_s", region->first);
    jox_json_number(json, "last_s", region->last);
    jox_json_add_position(json, "", storeys, region->at, true);
    jox_json_number(json, "area", region->area);
    jox_json_number(json, "density_max", region->most);
    jox_json_end(json);
}

void jox_congestion_json(const JoxCongestion *congestion, const JoxDensity *grid, JoxJson *json) {
    JoxCongestionFound found = jox_congestion_find(congestion, grid);
    const JoxStoreys *storeys = jox_density_storeys_of(grid);
    const bool seen = found.longest > 0.0;
    double area = 0.0;
    for (uint32_t r = 0; r < found.count; r++)
        area += found.regions[r].area;
    jox_json_object(json, "congestion");
    jox_json_number(json, "limit", (double)JOX_CONGESTION_DENSITY);
    jox_json_number(json, "share", JOX_CONGESTION_SHARE);
    jox_json_number(json, "time_s", found.time);
    jox_json_bool(json, "cleared", found.cleared);
    jox_json_number(json, "regions", found.known ? found.count : NAN);
    jox_json_number(json, "area", found.known ? area : NAN);
    jox_json_number(json, "longest_s", found.longest);
    jox_json_add_position(json, "longest_", storeys, found.longest_at, seen);
    jox_json_number(json, "first_s", found.first);
    jox_json_array(json, "where");
    for (uint32_t r = 0; r < found.count && r < TOLD; r++)
        write_region(json, storeys, &found.regions[r]);
    jox_json_end(json);
    jox_json_end(json);
    jox_congestion_found_free(&found);
}

void jox_congestion_csv(const JoxCongestion *congestion, const JoxDensity *grid, FILE *out) {
    JoxCongestionFound found = jox_congestion_find(congestion, grid);
    const JoxStoreys *storeys = jox_density_storeys_of(grid);
    fputs("x [m],y [m],seconds [s],first [s],last [s],area [m2],density_max [1/m2],low_x [m],low_y "
          "[m],high_x [m],high_y [m]",
          out);
    jox_csv_put_storey_title(out, storeys);
    fputc('\n', out);
    for (uint32_t r = 0; r < found.count; r++) {
        const JoxCongestionRegion *g = &found.regions[r];
        const JoxV2 at = jox_in_plan(storeys, g->at), low = jox_in_plan(storeys, g->low);
        const JoxV2 high = jox_in_plan(storeys, g->high);
        fprintf(out, "%.4f,%.4f,%.9g,%.9g,%.9g,%.9g,%.9g,%.4f,%.4f,%.4f,%.4f", (double)at.x,
                (double)at.y, g->seconds, g->first, g->last, g->area, g->most, (double)low.x,
                (double)low.y, (double)high.x, (double)high.y);
        jox_csv_put_storey(out, storeys, g->at, true);
        fputc('\n', out);
    }
    jox_congestion_found_free(&found);
}

void jox_congestion_sections(JoxCongestion *congestion, JoxSections *s) {
    jox_section(s, "congestion", congestion->cells, sizeof *congestion->cells, congestion->count);
    JOX_SECTION(s, "begun", congestion->begun);
    JOX_SECTION(s, "last", congestion->last);
    JOX_SECTION(s, "emptied", congestion->emptied);
}

void jox_congestion_free(JoxCongestion *congestion) {
    jox_free(congestion->cells);
    *congestion = (JoxCongestion){0};
}
