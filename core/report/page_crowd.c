/* The sections about the crowd on the pages of runs and recordings, in their order. */
#include <math.h>
#include <string.h>

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

/* Returns whether a probe has a figure that is known and not 0; else sets `why` to the reason, if
   there is one. */
static bool has_measured(const JoxProbe *probe, const char **why) {
    const JoxFigures figures = jox_probe_figures(probe);
    bool any = false;
    *why = NULL;
    for (uint32_t i = 0; i < figures.count; i++) {
        any |= isfinite(figures.items[i].value) && figures.items[i].value != 0.0;
        *why = *why ? *why : figures.items[i].why;
    }
    return any;
}

/* Writes the plot of a probe; plots of several rows may be parted at the end of a printed page. */
static void put_probe_plot(FILE *out, const char *folder, const JoxProbe *probe,
                           const char *caption) {
    enum { HEAD = 36 }; /* px: height of the title of several plots */
    const JoxProbeKind kind = jox_probe_def(probe)->kind;
    char stem[JOX_PROBE_STEM];
    int width, height;
    jox_probe_stem(probe, stem);
    jox_probe_plot_size(probe, &width, &height);
    if (kind == JOX_PROBE_MAP || kind == JOX_PROBE_MEASURE || kind == JOX_PROBE_FLOW)
        jox_html_strips(out, folder, stem, caption,
                        &(JoxStrips){.count = 2,
                                     .width = width,
                                     .height = (height - HEAD) / 2,
                                     .head = HEAD,
                                     .half = true});
    else
        jox_html_figure(out, folder, stem, caption, true);
}

static void put_probe_figure(FILE *out, const char *folder, const JoxProbe *probe) {
    static const char UNKNOWN[] = "not known: ";
    JoxText caption = {0}, window = {0};
    const char *why;
    jox_text_printf(&caption, "Probe %.60s (%.40s)", jox_probe_def(probe)->name,
                    jox_probe_kind_name(probe));
    jox_probe_window(probe, &window);
    if (window.length)
        jox_text_printf(&caption, ", %s", window.data);
    if (has_measured(probe, &why)) {
        say_probe_densities(jox_probe_def(probe), &caption);
        put_probe_plot(out, folder, probe, caption.data);
    } else {
        if (why && strncmp(why, UNKNOWN, sizeof UNKNOWN - 1) == 0)
            why += sizeof UNKNOWN - 1;
        jox_text_printf(&caption, ": nothing was measured%s%s.", why ? ", since: " : "",
                        why ? why : "");
        jox_html_paragraph(out, caption.data);
    }
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
        jox_html_heading(out, "Probes");
    for (uint32_t p = 0; p < s->probe_count; p++)
        put_probe_figure(out, s->folder, s->probes[p]);
}
