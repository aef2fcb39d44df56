/* jo_plot_times: plots of the time per step of several scenes, by stage, and over the number of
   agents. */
#include "base/assert.h"
#include "base/format/quote.h"
#include "base/guard.h"
#include "picture/plot.h"

#include "jostle_tools.h"

/* Returns whether the timings are of several instruction sets; then each bar is labelled with
   its own. */
static bool has_several_sets(const JoTiming *timings, size_t count) {
    for (size_t k = 1; k < count; k++)
        if (strcmp(timings[k].isa, timings[0].isa) != 0)
            return true;
    return false;
}

/* Writes bars.csv: label, ns per agent-step, least ns, and the share of each stage, %. */
static bool write_bar_data(const JoTiming *timings, size_t count, const char *folder,
                           JoxText *why) {
    FILE *data = jox_plot_open(folder, "bars.csv", why);
    if (!data)
        return false;
    fputs("case,ns_per_agent_step,least", data);
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        fprintf(data, ",%s", jo_stage_name(s));
    fputs("\n", data);
    const bool sets = has_several_sets(timings, count);
    for (size_t k = 0; k < count; k++) {
        const JoTiming *t = &timings[k];
        JoxText label = {0};
        jox_text_printf(&label, sets ? "%s %s" : "%s", t->scene, t->isa);
        jox_quote_put(data, jox_quote_csv, label.data);
        jox_text_free(&label);
        fprintf(data, ",%.6g,%.6g", t->ns, t->least_ns);
        double sum = 0.0;
        for (int s = 0; s < JO_STAGE_COUNT; s++)
            sum += t->stage_ns[s];
        for (int s = 0; s < JO_STAGE_COUNT; s++)
            fprintf(data, ",%.4g", sum > 0.0 ? 100.0 * t->stage_ns[s] / sum : 0.0);
        fputs("\n", data);
    }
    return jox_plot_close(data, "bars.csv", why);
}

/* Writes series.csv, a data set for each instruction set, and appends the sets' names to `sets`.
   Returns how many there are, 0 if no set has two timings of the series, -1 if it cannot be
   written. */
static int write_series_data(const JoTiming *timings, size_t count, const char *folder,
                             JoxText *sets, JoxText *why) {
    FILE *data = jox_plot_open(folder, "series.csv", why);
    if (!data)
        return -1;
    int blocks = 0, longest = 0;
    for (size_t k = 0; k < count; k++) {
        bool seen = false;
        for (size_t j = 0; j < k; j++)
            seen |= timings[j].in_series && strcmp(timings[j].isa, timings[k].isa) == 0;
        if (seen || !timings[k].in_series)
            continue;
        int points = 0;
        jox_text_printf(sets, "%s ", timings[k].isa);
        fprintf(data, "%s# agents, ns per agent-step, least\n", blocks++ ? "\n\n" : "");
        for (size_t j = k; j < count; j++)
            if (timings[j].in_series && strcmp(timings[j].isa, timings[k].isa) == 0) {
                fprintf(data, "%u,%.6g,%.6g\n", timings[j].agents, timings[j].ns,
                        timings[j].least_ns);
                points++;
            }
        longest = points > longest ? points : longest;
    }
    return !jox_plot_close(data, "series.csv", why) ? -1 : longest > 1 ? blocks : 0;
}

/* Writes bench.plt and draws bench.svg: bars, stages and, with `blocks` data sets, the series. */
static bool draw_timings(size_t count, int blocks, const char *sets, const char *folder,
                         JoxText *why) {
    FILE *script = jox_plot_open(folder, "bench.plt", why);
    if (!script)
        return false;
    const int panels = blocks ? 3 : 2, bars = 60 * (int)count + 260;
    jox_plot_begin(script, "bench", true, bars < 900 ? 900 : bars, 430 * panels);
    fprintf(
        script,
        "set datafile separator comma\nset multiplot layout %d,1\n"
        "set lmargin 11\nset rmargin 20\nset grid ytics\nset xtics noenhanced rotate by -30\n"
        "set xrange [-0.7:%zu-0.3]\nset style fill solid 0.9\nset boxwidth 0.7\n"
        "set logscale y\nset ylabel 'ns per agent and step'\n"
        "set title 'Processor time of a step (median of the rounds; line: the least)'\n"
        "plot 'bars.csv' skip 1 using 0:2:xtic(1) with boxes lc '#21918c', "
        "'' skip 1 using ($0-0.35):3:(0.7):(0) with vectors nohead lw 2 lc '#440154', "
        "'' skip 1 using 0:2:(sprintf($2 < 10 ? '%%.1f' : '%%.0f', $2)) with labels offset 0,0.6\n"
        "unset logscale\nset yrange [0:100]\nset ylabel '%% of the time of a step'\n"
        "set title 'Stages'\nset style data histograms\nset style histogram rowstacked\n"
        "set key outside right center Left reverse invert\n"
        "plot for [s=4:%d] 'bars.csv' using s:xtic(1) title columnheader(s) "
        "lc rgb word('#440154 #3b528b #21918c #5ec962 #fde725 #f98e52 #c7403e #808080 #c0c0c0',"
        " s-3)\n",
        panels, count, 3 + JO_STAGE_COUNT);
    fputs("sets = ", script);
    jox_quote_put(script, jox_quote_gnuplot, sets);
    if (blocks)
        fprintf(script,
                "\nset yrange [0:*]\nset autoscale x\nset logscale x\nset xtics norotate autofreq\n"
                "set format x '%%.0s%%c'\nset offsets 0, 0, graph 0.1, 0\n"
                "set xlabel 'agents'\nset ylabel 'ns per agent and step'\n"
                "set title 'The same crowd, from small to large'\n"
                "plot for [b=0:%d] 'series.csv' index b using 1:2 with linespoints pt 7 "
                "lw 2 title word(sets, b + 1)\n",
                blocks - 1);
    fputs("\nunset multiplot\nset output\n", script);
    return jox_plot_close(script, "bench.plt", why) && jox_plot_draw(folder, "bench.plt", why);
}

bool jo_plot_times(const JoTiming *timings, size_t count, const char *directory, JoError *error) {
    JOX_REQUIRE(timings && count > 0 && directory, false);
    JOX_GUARD (NULL, error)
        return false;
    JoxText why = {0}, sets = {0};
    jox_text_add(&sets, "");
    int blocks = 0;
    const bool good = jox_plot_folder(directory, &why) &&
                      write_bar_data(timings, count, directory, &why) &&
                      (blocks = write_series_data(timings, count, directory, &sets, &why)) >= 0 &&
                      draw_timings(count, blocks, sets.data, directory, &why);
    if (!good)
        jox_error(error, JO_FAILED, "%s", why.data ? why.data : "drawing failed");
    jox_text_free(&why);
    jox_text_free(&sets);
    return good;
}
