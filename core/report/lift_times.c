#include "report/lift_times.h"

#include "base/format/quote.h"
#include "base/mem.h"
#include "picture/plot.h"
#include "report/danger_output_parts.h"
#include "run/figure_listeners.h"
#include "run/listener.h"
#include "world/lifts.h"

static const double PACE = 1.0; /* s between rows */

void jox_lift_times_add(JoxLiftTimes *t, const JoScene *scene) {
    const JoWorld *w = scene->world;
    if (!w->model.lift_count || !jox_run_is_sample_due(scene, PACE))
        return;
    JOX_RESERVE(t->rows, t->capacity, t->count + w->model.lift_count);
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        const JoxLiftCar *car = &w->state.lifts.cars[l];
        t->rows[t->count++] = (JoxLiftTime){.time = jo_world_time(w),
                                            .lift = l,
                                            .waiting = jox_world_lift_waiting(w, l),
                                            .riding = car->people,
                                            .storey = w->model.lifts[l].stops[car->stop].storey};
    }
}

static bool write_lift_table(const JoxLiftTimes *t, const JoWorld *w, const char *folder,
                             JoxText *error) {
    FILE *out = jox_plot_open(folder, "danger-lifts.csv", error);
    if (!out)
        return false;
    fputs("lift,time [s],waiting,riding,storey\n", out);
    for (uint32_t k = 0; k < t->count; k++) { /* lift by lift, so that each is a curve */
        const uint32_t steps = t->count / w->model.lift_count;
        const JoxLiftTime *row = &t->rows[k % steps * w->model.lift_count + k / steps];
        jox_quote_put(out, jox_quote_csv, w->model.lifts[row->lift].name);
        fprintf(out, ",%.9g,%u,%u,", row->time, row->waiting, row->riding);
        jox_quote_put(out, jox_quote_csv, w->model.storeys.storeys[row->storey].name);
        fputc('\n', out);
    }
    return jox_plot_close(out, "danger-lifts.csv", error);
}

/* Writes a strip for each lift: people who wait, and people in the car. */
static void write_lift_strips(const void *world, FILE *script) {
    static const char *const CURVES[] = {"lines lw 2 lc '#0072b2' title 'waiting, all storeys'",
                                         "steps lw 2 lc '#e69f00' title 'in the car'"};
    const JoWorld *w = world;
    fputs("set yrange [0:*]\nset ylabel 'people'\nset key at graph 1.01,1 left top Left reverse\n",
          script);
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        const JoxLift *lift = &w->model.lifts[l];
        JoxText title = {0};
        jox_text_printf(&title, "lift %.80s, for %u people", lift->name, lift->capacity);
        const uint32_t queue = w->state.lifts.figures[l].queue_most;
        const uint32_t top = queue > lift->capacity ? queue : lift->capacity;
        jox_strips_set_title(script, title.data);
        jox_text_free(&title);
        fprintf(script, "set ytics %u\nplot ", (top + 3) / 4);
        for (int c = 0; c < 2; c++) {
            fputs(c ? ", 'danger-lifts.csv' skip 1 using (strcol(1) eq "
                    : "'danger-lifts.csv' skip 1 using (strcol(1) eq ",
                  script);
            jox_quote_put(script, jox_quote_gnuplot, lift->name);
            fprintf(script, " ? $2 : NaN):%d with %s", 3 + c, CURVES[c]);
        }
        fprintf(script, ", %u with lines lc '#e69f00' dt 2 title 'room in the car'\n",
                lift->capacity);
    }
}

bool jox_lift_times_write(const JoxLiftTimes *t, const JoScene *scene, const char *folder,
                          const char *title, JoxText *error) {
    const JoWorld *w = scene->world;
    char heading[JOX_STRIP_TITLE];
    if (!w->model.lift_count || !t->count)
        return true;
    if (!write_lift_table(t, w, folder, error))
        return false;
    if (!title)
        return true;
    jox_strips_title(title, heading);
    return jox_danger_draw_strips(jox_run_danger(scene), folder,
                                  &(JoxStripPlot){"lifts", heading, (int)w->model.lift_count,
                                                  JOX_DANGER_STRIP, write_lift_strips, w},
                                  error);
}

void jox_lift_times_sections(JoxLiftTimes *t, const JoScene *scene, JoxSections *s) {
    const JoWorld *w = scene->world;
    if (!w->model.lift_count)
        return;
    JOX_SECTION_ARRAY(s, "lift_times", t->rows, t->count, t->capacity);
    for (uint32_t r = 0; r < t->count && !s->failed; r++)
        if (t->rows[r].lift >= w->model.lift_count ||
            t->rows[r].storey >= w->model.storeys.storey_count)
            jox_sections_fail(s, "lift_times", "a lift or storey does not exist");
    if (!s->failed && t->count % w->model.lift_count)
        jox_sections_fail(s, "lift_times", "a row is missing");
    if (s->failed)
        t->count = 0;
}
