/* Sections of a field, for saving and restoring a world's state. */
#include <math.h>

#include "base/mem.h"
#include "geom/field/field_parts.h"

/* Returns whether size, clearance and position are those of a valid grid, m. */
static bool is_valid_grid(const JoxField *f) {
    const float least = 0.01f, most = 1e7f;
    return f->size >= least && f->size <= most && f->clearance >= least && f->clearance <= most &&
           fabsf(f->low.x) <= most && fabsf(f->low.y) <= most;
}

/* Checks restored indices, so that the field can be sampled safely. */
static void check_field(const JoxField *f, JoxSections *s) {
    size_t count = (size_t)f->columns * (size_t)f->rows;
    for (size_t c = 0; c < count && !s->failed; c++)
        if (f->cells[c].patch >= (int32_t)f->patch_count || f->cells[c].patch < JOX_FIELD_PLAIN)
            jox_sections_fail(s, "field_cells", "a cell refers to a patch that does not exist");
    for (uint32_t p = 0; p < f->patch_count && !s->failed; p++)
        if (f->patches[p].first > f->ref_count ||
            f->patches[p].count > f->ref_count - f->patches[p].first)
            jox_sections_fail(s, "field_patches", "a patch refers to edges that do not exist");
    for (uint32_t r = 0; r < f->ref_count && !s->failed; r++)
        if (f->refs[r] >= f->edge_count)
            jox_sections_fail(s, "field_refs", "an edge is referred to that does not exist");
}

/* Lists the first stops of ways by lifts. */
static void list_first_stops(JoxField *f, size_t cells, JoxSections *s) {
    size_t count = cells, capacity = 0;
    JOX_SECTION_ARRAY(s, "field_stops", f->first_stops, count, capacity);
    if (s->mode == JOX_SECTIONS_RESTORE && !s->failed && count != cells)
        jox_sections_fail(s, "field_stops", "cells lack their stop of a lift");
}

void jox_field_sections(JoxField **field, bool by_lifts, JoxSections *s) {
    const bool restores = s->mode == JOX_SECTIONS_RESTORE;
    if (restores) {
        jox_field_free(*field);
        *field = jox_alloc(1, sizeof **field);
    }
    JoxField *f = *field;
    size_t columns = jox_section_count(s, "field_columns", (size_t)f->columns, 1);
    size_t rows = jox_section_count(s, "field_rows", (size_t)f->rows, 1);
    JOX_SECTION(s, "field_low", f->low);
    JOX_SECTION(s, "field_size", f->size);
    JOX_SECTION(s, "field_clearance", f->clearance);
    size_t cells = (size_t)f->columns * (size_t)f->rows, capacity = 0;
    size_t edge_capacity = 0, ref_capacity = 0, patch_capacity = f->patch_capacity;
    JOX_SECTION_ARRAY(s, "field_cells", f->cells, cells, capacity);
    JOX_SECTION_ARRAY(s, "field_patches", f->patches, f->patch_count, patch_capacity);
    JOX_SECTION_ARRAY(s, "field_edges", f->edges, f->edge_count, edge_capacity);
    JOX_SECTION_ARRAY(s, "field_refs", f->refs, f->ref_count, ref_capacity);
    if (by_lifts)
        list_first_stops(f, cells, s);
    if (!restores)
        return;
    f->columns = (int)columns;
    f->rows = (int)rows;
    f->patch_capacity = f->patch_count;
    if (columns < 1 || rows < 1 || cells / columns != rows || cells % columns || !is_valid_grid(f))
        jox_sections_fail(s, "field_columns", "the grid is invalid");
    if (!s->failed)
        check_field(f, s);
    if (s->failed) {
        jox_field_free(f);
        *field = NULL;
    }
}
