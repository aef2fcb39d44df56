/* Slows down the floor around people who are held up, so that ways lead round a crowd where that is
   quicker. */
#include "base/mem.h"
#include "geom/field/field_sheets.h"

#define X(name, isa) [isa] = jox_field_spread_##name,
static JoxFieldSpreadKernel *const SPREAD[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

/* Returns 1 for cells that can be walked, else 0; the caller frees the array. */
static float *list_open_cells(const JoxFieldWork *w) {
    float *open = jox_alloc((size_t)w->count, sizeof *open);
    for (int i = 0; i < w->count; i++)
        open[i] = w->walled.node[i] == JOX_FIELD_BLOCKED ? 0.0f : 1.0f;
    return open;
}

void jox_field_crowd(JoxFieldWork *w, const JoxFieldCrowd *crowd) {
    if (!crowd || crowd->count == 0)
        return;
    float *open = list_open_cells(w);
    JoxFieldTwins twins = jox_field_list_twins(w, false);
    float *before = jox_alloc((size_t)twins.count + 1, sizeof *before);
    for (uint32_t t = 0; t < twins.count; t++)
        before[t] = w->slowness[twins.items[t].copy];
    SPREAD[jox_isa_resolve(crowd->isa)](w, crowd, open);
    for (uint32_t t = 0; t < twins.count; t++) /* slowness beyond a seam acts on its other side */
        before[t] = w->slowness[twins.items[t].copy] - before[t];
    for (uint32_t t = 0; t < twins.count; t++)
        w->slowness[twins.items[t].of] += before[t];
    jox_free(twins.items);
    jox_free(before);
    jox_free(open);
}
