/* The section on stairs and lifts on the pages of reports, and the figures on them. */
#include <math.h>

#include "base/format/plurals.h"
#include "picture/html.h"
#include "record/danger/danger_parts.h"
#include "report/danger_outputs.h"
#include "report/page_parts.h"
#include "report/page_table.h"
#include "run/results/lift_figures.h"

/* ---- figures ---- */

void jox_page_add_stairs(JoxPageFigures *f, const JoxDanger *danger) {
    const JoxDangerStairs *s = &danger->stairs;
    f->group = "Stairs";
    for (uint32_t k = 0; k < s->count; k++) {
        const JoxDangerStair *on = &s->items[k];
        const JoxStair *stair = &s->storeys->stairs[k];
        const bool judged = jox_danger_stair_is_judged(on);
        if (!jox_stair_joins(stair))
            continue;
        jox_page_add_figure(f, "", on->up, "people who went up %.60s", stair->name);
        jox_page_add_figure(f, "", on->down, "people who went down %.60s", stair->name);
        jox_page_add_figure(f, "", on->people_most, "most people at a time on %.60s", stair->name);
        jox_page_add_figure(f, "1/(m s)", judged ? on->flow_most : NAN,
                            "greatest flow over %.60s in ten seconds", stair->name);
        jox_page_add_figure(f, "1/m2", on->mean_most, "greatest mean density on %.60s",
                            stair->name);
        jox_page_add_figure(f, "s", on->used, "time in which somebody was on %.60s", stair->name);
    }
}

void jox_page_add_lifts(JoxPageFigures *f, const JoScene *scene) {
    f->group = "Lifts";
    if (jox_has_storeys(&scene->world->model.storeys)) {
        const JoxStranded stranded = jox_world_count_stranded(scene->world, -1);
        jox_page_add_figure(f, "", stranded.in_refuge,
                            "people who cannot use stairs, in a refuge at the end");
        jox_page_add_figure(f, "", stranded.nowhere,
                            "people who cannot use stairs, without lift and refuge at the end");
        jox_page_add_figure(f, "", stranded.on_stairs,
                            "people who cannot use stairs, on a stair or ramp at the end");
    }
    for (uint32_t l = 0; l < scene->world->model.lift_count; l++) {
        const JoxLiftResult r = jox_run_lift_result(scene->world, l);
        jox_page_add_figure(f, "", (double)r.count.carried, "people whom lift %.60s carried",
                            r.name);
        jox_page_add_figure(f, "", (double)r.count.trips, "trips of lift %.60s with people in it",
                            r.name);
        jox_page_add_figure(f, "s", r.wait_mean, "mean wait for lift %.60s", r.name);
        jox_page_add_figure(f, "s", r.wait_most, "longest wait for lift %.60s", r.name);
        jox_page_add_figure(f, "", r.count.queue_most, "most people before lift %.60s", r.name);
    }
}

/* ---- stairs ---- */

static const char *name_kind(const JoxStair *stair) {
    static const char *const KINDS[] = {"stair", "ramp", "escalator"};
    return KINDS[stair->kind];
}

/* Appends the names of what is in a list, after its first words. */
static void add_to_list(JoxText *list, const char *begin, const char *name) {
    jox_text_printf(list, "%s%.60s", list->length ? ", " : begin, name);
}

static void end_list(FILE *out, JoxText *list) {
    if (list->length) {
        jox_text_add(list, ".");
        jox_html_paragraph(out, list->data);
    }
    jox_text_free(list);
}

static void put_stair_table(FILE *out, const JoxSubject *s) {
    const JoxDangerStairs *stairs = &s->danger->stairs;
    JoxPageTable table = jox_page_table(
        s, "stairs",
        "stair|kind|>width [m]|>people up|>people down|>most people on it at a time|>greatest flow "
        "[1/(m s)]|>time of the greatest flow [s]|>greatest mean density [1/m2]|>time of the "
        "greatest mean density [s]|>time over the limit of density [s]|worst level|>time at E and "
        "F [s]|>time of use [s]|>first used [s]|>last used [s]");
    for (uint32_t k = 0; k < stairs->count; k++) {
        const JoxDangerStair *on = &stairs->items[k];
        const JoxStair *stair = &stairs->storeys->stairs[k];
        const bool judged = jox_danger_stair_is_judged(on), level = judged && on->worst >= 0;
        if (!jox_stair_joins(stair))
            continue;
        jox_table_text(&table, stair->name);
        jox_table_text(&table, name_kind(stair));
        jox_table_number(&table, on->width);
        jox_table_number(&table, on->up);
        jox_table_number(&table, on->down);
        jox_table_number(&table, on->people_most);
        jox_table_number(&table, judged ? on->flow_most : NAN);
        jox_table_number(&table, judged ? on->flow_most_time : NAN);
        jox_table_number(&table, on->mean_most);
        jox_table_number(&table, on->mean_most_time);
        jox_table_number(&table, on->over);
        jox_table_text(&table, level ? jox_levels[on->worst].name : "not judged");
        jox_table_number(&table,
                         level ? on->level_s[JOX_LEVELS - 2] + on->level_s[JOX_LEVELS - 1] : NAN);
        jox_table_number(&table, on->used);
        jox_table_number(&table, on->first);
        jox_table_number(&table, on->last);
    }
    jox_table_put(out, &table);
}

/* Names the stairs on which the mean density reached the limit, and those that too few people
   passed. */
static void say_stairs(FILE *out, const JoxDangerStairs *stairs) {
    JoxText over = {0}, few = {0}, begin = {0};
    for (uint32_t k = 0; k < stairs->count; k++) {
        const JoxDangerStair *on = &stairs->items[k];
        const JoxStair *stair = &stairs->storeys->stairs[k];
        if (!jox_stair_joins(stair))
            continue;
        if (on->mean_most >= stairs->limit)
            add_to_list(&over, "The mean density reached the limit on: ", stair->name);
        if (jox_danger_stair_is_judged(on))
            continue;
        if (!few.length)
            jox_text_printf(
                &begin,
                "Flow and level are not judged where fewer than %d people passed: ", JOX_STAIR_FEW);
        add_to_list(&few, begin.length ? begin.data : "", stair->name);
    }
    if (!over.length)
        jox_html_paragraph(out, "The mean density reached the limit on no stair.");
    end_list(out, &over);
    end_list(out, &few);
    jox_text_free(&begin);
}

/* Writes the plot of stairs, and how many have no strip in it. */
static void put_stair_plot(FILE *out, const JoxSubject *s) {
    const JoxDangerStairs *stairs = &s->danger->stairs;
    const int strips = jox_danger_count_stair_strips(s->danger);
    uint32_t used = 0;
    for (uint32_t k = 0; k < stairs->count; k++)
        used += stairs->items[k].people_most > 0;
    if (strips)
        jox_html_strips(
            out, s->folder, "stairs", "Flow and mean density of each stair that people were on.",
            &(JoxStrips){
                .count = strips, .width = JOX_DANGER_STRIPS_WIDE, .height = JOX_DANGER_STRIP});
    if (used > (uint32_t)strips) {
        JoxText text = {0};
        jox_text_noun(&text, used - (uint32_t)strips, "stair|stairs");
        jox_text_add(&text, " with fewer people are in danger-stairs.csv alone.");
        jox_html_paragraph(out, text.data);
        jox_text_free(&text);
    }
}

void jox_page_put_stairs(FILE *out, const JoxSubject *s) {
    const JoxDangerStairs *stairs = &s->danger->stairs;
    if (!jox_has_storeys(s->storeys) || !jox_danger_stairs_joining(stairs))
        return;
    JoxText text = {0};
    jox_html_heading(out, "Stairs");
    jox_text_printf(
        &text,
        "A person has gone up or down who left a stair at its other end. Flow is people who did so "
        "in either direction within the ten seconds before a moment, per metre of width. The mean "
        "density is that about the people on the stair " JOX_DENSITY_BY "; from %g per m\xc2\xb2 "
        "on it can become dangerous. Levels are Fruin's for stairs, and on ramps his for walkways, "
        "by flow, but E or F where the area per person is that of E or F; escalators have none.",
        stairs->limit);
    jox_html_paragraph(out, text.data);
    jox_text_free(&text);
    put_stair_table(out, s);
    say_stairs(out, stairs);
    put_stair_plot(out, s);
    if (!s->rides && stairs->by_lift[0] + stairs->by_lift[1]) {
        jox_text_noun(&text, stairs->by_lift[1], "person|people");
        jox_text_add(&text, " went up and ");
        jox_text_noun(&text, stairs->by_lift[0], "person|people");
        jox_text_add(&text, " down without a stair, by lift. Waits are not measured: recordings do "
                            "not say who waits.");
        jox_html_paragraph(out, text.data);
        jox_text_free(&text);
    }
}

/* ---- lifts ---- */

void jox_page_put_lifts(FILE *out, const JoxSubject *s) {
    JoxText few = {0}, waiting = {0};
    if (!s->rides || !s->lift_count)
        return;
    jox_html_heading(out, "Lifts");
    jox_html_paragraph(out, "A person waits from the call, within 4 m of the door and in sight of "
                            "it, until the way in. Trips are departures with people in the car.");
    JoxPageTable table = jox_page_table(
        s, "lifts",
        "lift|room for people|>people carried|>trips|>mean share of the room filled [%]|>full "
        "trips|>mean wait [s]|>90 % waited up to [s]|>longest wait [s]|>mean time in the car "
        "[s]|>most people waiting at a time|>time of that [s]|>found no room when the door "
        "closed|>still "
        "waiting at the end|>the first of them for [s]|>longest time with an open door [s]");
    table.zero_rows = "Nobody rode in";
    for (uint32_t l = 0; l < s->lift_count; l++) {
        const JoxLiftResult *r = &s->rides[l];
        char room[32];
        snprintf(room, sizeof room, "%u", r->capacity);
        jox_table_text(&table, r->name);
        jox_table_text(&table, room);
        jox_table_number(&table, (double)r->count.carried);
        jox_table_number(&table, (double)r->count.trips);
        jox_table_number(&table, 100.0 * r->filled);
        jox_table_number(&table, (double)r->count.full_trips);
        jox_table_number(&table, r->wait_mean);
        jox_table_number(&table, r->wait_p90);
        jox_table_number(&table, r->wait_most);
        jox_table_number(&table, r->ride_mean);
        jox_table_number(&table, r->count.queue_most);
        jox_table_number(&table, r->queue_most_time);
        jox_table_number(&table, (double)r->count.left_behind);
        jox_table_number(&table, r->waiting);
        jox_table_number(&table, r->waiting ? r->waiting_longest : NAN);
        jox_table_number(&table, r->count.open_most);
        if (r->count.carried && r->count.carried < JOX_STAIR_FEW)
            add_to_list(&few, "Too few people for means, fewer than ten, rode: ", r->name);
        if (r->waiting)
            add_to_list(&waiting, "Waits of those who still wait are not in the means: ", r->name);
    }
    jox_table_put(out, &table);
    end_list(out, &few);
    end_list(out, &waiting);
    jox_html_strips(out, s->folder, "lifts", "People who wait before each lift, and in its car.",
                    &(JoxStrips){.count = (int)s->lift_count,
                                 .width = JOX_DANGER_STRIPS_WIDE,
                                 .height = JOX_DANGER_STRIP});
}
