/* A cache of the effect of walls, for the next field over the same walls, when only the crowd has
   changed. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/field/field_parts.h"

struct JoxFieldMarks {
    JoxV2 low;
    float size, clearance;
    int columns, rows;
    JoxFieldEdge *edges; /* key: everything else depends on them */
    uint32_t edge_count, ref_count;
    uint32_t *refs;
    float *slowness;        /* by cell, from walls alone */
    JoxFieldPatch *patches; /* without ways, except off walls and out of solids */
    uint32_t patch_count;
    int32_t *patch;        /* by cell */
    JoxFieldWalled walled; /* shared with JoxFieldWork, not copied */
};

void jox_field_marks_free(JoxFieldMarks *m) {
    if (!m)
        return;
    const JoxFieldWalled *of = &m->walled;
    void *const owned[] = {m->edges,  m->refs,     m->slowness, m->patches,  m->patch,  of->first,
                           of->solid, of->node,    of->x,       of->y,       of->links, of->corners,
                           of->even,  of->patched, of->sight,   of->columns, of->rows};
    for (size_t k = 0; k < sizeof owned / sizeof *owned; k++)
        jox_free(owned[k]);
    jox_free(m);
}

static bool matches_field(const JoxFieldMarks *m, const JoxField *f) {
    return m->low.x == f->low.x && m->low.y == f->low.y && m->size == f->size &&
           m->clearance == f->clearance && m->columns == f->columns && m->rows == f->rows &&
           m->edge_count == f->edge_count &&
           memcmp(m->edges, f->edges, f->edge_count * sizeof *f->edges) == 0;
}

bool jox_field_recall(JoxFieldWork *w, const JoxFieldMarks *m) {
    JoxField *f = w->f;
    const size_t count = (size_t)w->count;
    if (!m || !matches_field(m, f))
        return false;
    f->ref_count = m->ref_count;
    f->refs = jox_copy_array(m->refs, m->ref_count, sizeof *f->refs);
    memcpy(w->slowness, m->slowness, count * sizeof *w->slowness);
    for (size_t i = 0; i < count; i++)
        f->cells[i].patch = m->patch[i];
    f->patch_count = f->patch_capacity = m->patch_count;
    f->patches = jox_copy_array(m->patches, m->patch_count, sizeof *f->patches);
    w->walled = m->walled;
    return true;
}

void jox_field_remember(const JoxFieldWork *w, JoxFieldMarks **marks) {
    const JoxField *f = w->f;
    const size_t count = (size_t)w->count;
    JOX_ASSERT(count == (size_t)f->columns * (size_t)f->rows);
    jox_field_marks_free(*marks);
    *marks = NULL;
    JoxFieldMarks *m = jox_alloc(1, sizeof *m);
    *m = (JoxFieldMarks){.low = f->low,
                         .size = f->size,
                         .clearance = f->clearance,
                         .columns = f->columns,
                         .rows = f->rows,
                         .edge_count = f->edge_count,
                         .ref_count = f->ref_count,
                         .patch_count = f->patch_count,
                         .walled = w->walled};
    m->edges = jox_copy_array(f->edges, f->edge_count, sizeof *f->edges);
    m->refs = jox_copy_array(f->refs, f->ref_count, sizeof *f->refs);
    m->slowness = jox_copy_array(w->slowness, count, sizeof *w->slowness);
    m->patch = jox_alloc(count, sizeof *m->patch);
    for (size_t i = 0; i < count; i++)
        m->patch[i] = f->cells[i].patch;
    m->patches = jox_copy_array(f->patches, f->patch_count, sizeof *m->patches);
    *marks = m;
}
