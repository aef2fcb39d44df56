/* What the kinds of probes share. */
#include <math.h>
#include <stdlib.h>

#include "record/probes/probe_parts.h"

#include "base/sort.h"

void jox_figure_add(JoxFigures *figures, const char *name, const char *unit, double value) {
    if (figures->count < JOX_MOST_FIGURES)
        figures->items[figures->count++] = (struct JoxFigure){name, unit, value};
}

void jox_plot_nothing(JoxText *out, const char *why) {
    jox_text_printf(out,
                    "set label 1 '%s' at graph 0.5,0.5 center\nunset key\nplot [0:1] [0:1] -1\n"
                    "unset label 1\n",
                    why);
}

double jox_quantile(double *values, size_t count, double q) {
    if (count == 0)
        return NAN;
    jox_sort_doubles(values, count);
    double rank = q * (double)(count - 1);
    size_t below = (size_t)rank;
    if (below + 1 >= count)
        return values[count - 1];
    return values[below] + (rank - (double)below) * (values[below + 1] - values[below]);
}
