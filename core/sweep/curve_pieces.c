/* Encodes the curves and fields of a run as pieces, and decodes them: a head of fixed size, the
   numbers, then name and unit. */
#include <string.h>

#include "base/format/piece_file.h"
#include "base/mem.h"
#include "sweep/sweep.h"

enum { MOST_CURVE = 1 << 20, MOST_FIELD = 1 << 22 }; /* larger counts are taken for damage */

typedef struct CurveHead {
    uint64_t count, name, unit; /* count: pairs; name, unit: bytes of the text with its zero */
} CurveHead;
typedef struct FieldHead {
    double low_x, low_y, cell;
    uint32_t columns, rows;
    uint64_t name, unit;
} FieldHead;

void jox_sweep_put_curve(JoxText *pieces, const JoxSweepCurve *curve) {
    const CurveHead head = {curve->count, strlen(curve->name) + 1, strlen(curve->unit) + 1};
    JoxText out = {0};
    jox_text_append(&out, (const char *)&head, sizeof head);
    jox_text_append(&out, (const char *)curve->points, 2 * sizeof(double) * curve->count);
    jox_text_append(&out, curve->name, head.name);
    jox_text_append(&out, curve->unit, head.unit);
    jox_pieces_add(pieces, "curve", out.data, out.length);
    jox_text_free(&out);
}

void jox_sweep_put_field(JoxText *pieces, const JoxSweepField *field) {
    const FieldHead head = {field->low_x,           field->low_y, field->cell,
                            field->columns,         field->rows,  strlen(field->name) + 1,
                            strlen(field->unit) + 1};
    JoxText out = {0};
    jox_text_append(&out, (const char *)&head, sizeof head);
    jox_text_append(&out, (const char *)field->values,
                    sizeof(float) * field->columns * field->rows);
    jox_text_append(&out, field->name, head.name);
    jox_text_append(&out, field->unit, head.unit);
    jox_pieces_add(pieces, "field", out.data, out.length);
    jox_text_free(&out);
}

/* Copies the two texts at the end, of `first` and `second` bytes; false if their sizes are
   wrong. */
static bool copy_texts(const char *data, size_t length, uint64_t first, uint64_t second,
                       char **name, char **unit) {
    if (first == 0 || second == 0 || first > length || second != length - first ||
        data[first - 1] || data[length - 1])
        return false;
    *name = jox_strdup(data);
    *unit = jox_strdup(data + first);
    return true;
}

bool jox_sweep_get_curve(const char *data, size_t length, JoxSweepCurve *out) {
    CurveHead head;
    *out = (JoxSweepCurve){0};
    if (length < sizeof head)
        return false;
    memcpy(&head, data, sizeof head);
    const size_t left = length - sizeof head;
    if (head.count > MOST_CURVE || left / (2 * sizeof(double)) < head.count)
        return false;
    const size_t numbers = 2 * sizeof(double) * head.count;
    if (!copy_texts(data + sizeof head + numbers, left - numbers, head.name, head.unit, &out->name,
                    &out->unit))
        return false;
    out->count = out->capacity = head.count;
    out->points = jox_alloc(2 * head.count + 1, sizeof(double));
    memcpy(out->points, data + sizeof head, numbers);
    return true;
}

bool jox_sweep_get_field(const char *data, size_t length, JoxSweepField *out) {
    FieldHead head;
    *out = (JoxSweepField){0};
    if (length < sizeof head)
        return false;
    memcpy(&head, data, sizeof head);
    const size_t left = length - sizeof head;
    const uint64_t cells = (uint64_t)head.columns * head.rows;
    if (cells == 0 || cells > MOST_FIELD || left / sizeof(float) < cells || !(head.cell > 0))
        return false;
    const size_t numbers = sizeof(float) * cells;
    if (!copy_texts(data + sizeof head + numbers, left - numbers, head.name, head.unit, &out->name,
                    &out->unit))
        return false;
    out->low_x = head.low_x;
    out->low_y = head.low_y;
    out->cell = head.cell;
    out->columns = head.columns;
    out->rows = head.rows;
    out->values = jox_alloc(cells, sizeof(float));
    memcpy(out->values, data + sizeof head, numbers);
    return true;
}

void jox_sweep_free_curve(JoxSweepCurve *curve) {
    jox_free(curve->name);
    jox_free(curve->unit);
    jox_free(curve->points);
    *curve = (JoxSweepCurve){0};
}

void jox_sweep_free_field(JoxSweepField *field) {
    jox_free(field->name);
    jox_free(field->unit);
    jox_free(field->values);
    *field = (JoxSweepField){0};
}
