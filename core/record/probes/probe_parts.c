/* Figures and empty plots, for the kinds of probes. */
#include "record/probes/probe_parts.h"

void jox_figure_add(JoxFigures *figures, const char *name, const char *title, const char *unit,
                    double value) {
    if (figures->count < JOX_MOST_FIGURES)
        figures->items[figures->count++] = (struct JoxFigure){name, title, unit, value, NULL};
}

void jox_figure_set_reason(JoxFigures *figures, const char *why) {
    struct JoxFigure *last = &figures->items[figures->count - 1];
    if (!isfinite(last->value))
        last->why = why;
}

void jox_plot_reason(JoxText *out, const char *why) {
    jox_text_printf(out,
                    "set label 1 '%s' at graph 0.5,0.5 center\nunset key\nplot [0:1] [0:1] -1\n"
                    "unset label 1\n",
                    why);
}
