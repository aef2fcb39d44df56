#include "world/step_events/step_events.h"

#include "base/mem.h"

void jox_step_events_clear(JoxStepEvents *events) {
    events->hit_count = events->break_count = 0;
}

void jox_step_events_add_bodies(JoxStepEvents *h, const JoxBodiesReport *report,
                                const JoxDisc *discs) {
    JOX_RESERVE(h->hits, h->hit_capacity, h->hit_count + report->hit_count);
    for (uint32_t k = 0; k < report->hit_count; k++) {
        const JoxDiscHit *hit = &report->hits[k];
        h->hits[h->hit_count++] = (JoHitEvent){.agent = discs[hit->disc].id,
                                               .body = hit->object,
                                               .impulse = jox_length(hit->impulse),
                                               .x = hit->point.x,
                                               .y = hit->point.y,
                                               .z = hit->point.z};
    }
    JOX_RESERVE(h->breaks, h->break_capacity, h->break_count + report->break_count);
    for (uint32_t k = 0; k < report->break_count; k++)
        h->breaks[h->break_count++] = (JoBreakEvent){report->breaks[k].row, report->breaks[k].bonds,
                                                     report->breaks[k].pieces};
}

void jox_step_events_free(JoxStepEvents *h) {
    void *const owned[] = {h->hits,    h->breaks, h->transitions, h->touches,
                           h->entered, h->left,   h->said,        h->actions,
                           h->seen,    h->seeing, h->touched,     h->touching};
    for (size_t k = 0; k < sizeof owned / sizeof *owned; k++)
        jox_free(owned[k]);
    jox_field_free(h->field);
    jox_field_marks_free(h->marks);
    *h = (JoxStepEvents){0};
}
