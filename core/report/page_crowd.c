/* The sections about the crowd on the pages of runs and recordings, in their order. */
#include "picture/html.h"
#include "picture/probe_files.h"
#include "report/page_parts.h"

/* Appends how a probe measures densities, if it does. */
static void say_probe_densities(const JoxProbeDef *def, JoxText *out) {
    if (def->kind == JOX_PROBE_MEASURE)
        jox_text_printf(out,
                        ". Classical density: people over the area; Voronoi density: mean over "
                        "cells cut off at %.3g m and by walls. Means of %.3g s",
                        def->cutoff, def->every);
    if (def->kind == JOX_PROBE_MAP)
        jox_text_printf(out,
                        ". Density: Gaussian of standard deviation %.3g m%s, cells of %.3g m, a "
                        "sample each %.3g s",
                        def->kernel, def->through_walls ? " through walls" : " within walls",
                        def->cell, def->every);
}

static void put_probe_figure(FILE *out, const char *folder, const JoxProbe *probe) {
    char stem[JOX_PROBE_STEM];
    JoxText caption = {0}, window = {0};
    jox_text_printf(&caption, "Probe %.60s: %.40s", jox_probe_def(probe)->name,
                    jox_probe_kind_name(probe));
    jox_probe_window(probe, &window);
    if (window.length)
        jox_text_printf(&caption, ", %s", window.data);
    say_probe_densities(jox_probe_def(probe), &caption);
    jox_probe_stem(probe, stem);
    jox_html_figure(out, folder, stem, caption.data, false);
    jox_text_free(&caption);
    jox_text_free(&window);
}

void jox_page_put_crowd(FILE *out, const JoxSubject *s) {
    jox_html_heading(out, "Plan");
    jox_write_plan_html(out, s);
    jox_page_put_leaving(out, s);
    jox_page_put_danger(out, s);
    jox_page_put_levels(out, s);
    if (s->probe_count)
        jox_html_heading(out, "What probes measured");
    if (s->probe_count)
        jox_html_panels(out, false);
    for (uint32_t p = 0; p < s->probe_count; p++)
        put_probe_figure(out, s->folder, s->probes[p]);
    if (s->probe_count)
        jox_html_panels_end(out);
}
