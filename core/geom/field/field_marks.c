/* What walls do to a field, kept for the next field over the same walls: only the crowd changes
   from one to the other. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/field/field_parts.h"

struct JoxFieldMarks {
    JoxV2 low;
    float size, clearance;
    int columns, rows;
    JoxFieldEdge *edges; /* of which all else follows */
    uint32_t edge_count, ref_count;
    uint32_t *refs, *first;
    uint16_t *solid;
    float *slowness; /* near walls */
    uint8_t *node, *links, *corners;
    JoxFieldPatch *patches; /* without ways, but for those out of solids */
    uint32_t patch_count;
    int32_t *patch, *patched;
    JoxFieldSight *sight;
};

void jox_field_marks_free(JoxFieldMarks *m) {
    if (!m)
        return;
    void *const owned[] = {m->edges, m->refs,    m->first,   m->solid, m->slowness, m->node,
                           m->links, m->corners, m->patches, m->patch, m->patched,  m->sight};
    for (size_t k = 0; k < sizeof owned / sizeof *owned; k++)
        jox_free(owned[k]);
    jox_free(m);
}

static void *copy(const void *from, size_t count, size_t size) {
    void *to = jox_alloc(count + 1, size);
    if (count)
        memcpy(to, from, count * size);
    return to;
}

static bool is_of(const JoxFieldMarks *m, const JoxField *f) {
    return m->low.x == f->low.x && m->low.y == f->low.y && m->size == f->size &&
           m->clearance == f->clearance && m->columns == f->columns && m->rows == f->rows &&
           m->edge_count == f->edge_count &&
           memcmp(m->edges, f->edges, f->edge_count * sizeof *f->edges) == 0;
}

bool jox_field_recall(JoxFieldWork *w, const JoxFieldMarks *m) {
    JoxField *f = w->f;
    const size_t count = (size_t)w->count;
    if (!m || !is_of(m, f))
        return false;
    f->ref_count = m->ref_count;
    f->refs = copy(m->refs, m->ref_count, sizeof *f->refs);
    memcpy(w->first, m->first, (count + 1) * sizeof *w->first);
    memcpy(w->solid, m->solid, count * sizeof *w->solid);
    memcpy(w->slowness, m->slowness, count * sizeof *w->slowness);
    memcpy(w->node, m->node, count);
    memcpy(w->links, m->links, count);
    memcpy(w->corners, m->corners, count);
    for (size_t i = 0; i < count; i++)
        f->cells[i].patch = m->patch[i];
    f->patch_count = f->patch_capacity = m->patch_count;
    f->patches = copy(m->patches, m->patch_count, sizeof *f->patches);
    w->patched = copy(m->patched, m->patch_count, sizeof *w->patched);
    w->sight = copy(m->sight, (size_t)m->patch_count * JOX_FIELD_SAMPLES, sizeof *w->sight);
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
                         .patch_count = f->patch_count};
    m->edges = copy(f->edges, f->edge_count, sizeof *f->edges);
    m->refs = copy(f->refs, f->ref_count, sizeof *f->refs);
    m->first = copy(w->first, count + 1, sizeof *w->first);
    m->solid = copy(w->solid, count, sizeof *w->solid);
    m->slowness = copy(w->slowness, count, sizeof *w->slowness);
    m->node = copy(w->node, count, 1);
    m->links = copy(w->links, count, 1);
    m->corners = copy(w->corners, count, 1);
    m->patch = jox_alloc(count, sizeof *m->patch);
    for (size_t i = 0; i < count; i++)
        m->patch[i] = f->cells[i].patch;
    m->patches = copy(f->patches, f->patch_count, sizeof *m->patches);
    m->patched = copy(w->patched, f->patch_count, sizeof *m->patched);
    m->sight = copy(w->sight, (size_t)f->patch_count * JOX_FIELD_SAMPLES, sizeof *m->sight);
    *marks = m;
}
