/* The summary of a report's page: sentences on what happened, from the subject's danger
   measures. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/plurals.h"
#include "picture/html.h"
#include "record/danger/danger_parts.h"
#include "record/danger/trust.h"
#include "report/subject.h"

static void put_summary_statement(FILE *out, const char *lead, JoxText *text) {
    jox_html_statement(out, lead, text->data ? text->data : "");
    jox_text_free(text);
}

/* ---- who left ---- */

/* Appends the number of people who left by each exit, and when the last did. */
static void say_exits(const JoxSubject *s, JoxText *out) {
    const JoxExits *exits = s->exits;
    uint64_t known = 0;
    for (uint32_t e = 0; e < exits->count; e++) {
        jox_text_printf(out, "%s%.60s ", e ? "; " : " By exits: ", exits->items[e].name);
        jox_text_noun(out, exits->items[e].people, "person|people");
        if (exits->items[e].people)
            jox_text_printf(out, ", the last at %.1f s", exits->items[e].last);
        known += exits->items[e].people;
    }
    if (exits->count && exits->left > known) {
        jox_text_add(out, "; elsewhere ");
        jox_text_noun(out, exits->left - known, "person|people");
    }
    if (exits->count)
        jox_text_add(out, ".");
}

/* Writes when people left, and whether all did. */
static void put_leaving_summary(FILE *out, const JoxSubject *s) {
    const JoxLeaving *leaving = &s->danger->leaving;
    const uint64_t left = s->exits->left;
    JoxText text = {0};
    char people[JOX_NOUN];
    if (left == 0) {
        jox_text_printf(&text, "Nobody left; %s there at %.1f s, the end of what was measured.",
                        s->inside == 1
                            ? "1 person was"
                            : (jox_noun(people, s->inside, "person|people were"), people),
                        s->until);
        put_summary_statement(out, "Who left when.", &text);
        return;
    }
    if (s->inside)
        jox_text_printf(&text, "%s of ", jox_number_text(people, left));
    jox_text_printf(&text,
                    "%s%s left: the first at %.1f s, half of them by %.1f s, 95 %% by %.1f s, "
                    "the last at %.1f s.",
                    s->inside ? "" : "All ", jox_noun(people, left + s->inside, "person|people"),
                    jox_leaving_quantile(leaving, JOX_LEFT_ANYWHERE, 0.0),
                    jox_leaving_quantile(leaving, JOX_LEFT_ANYWHERE, 0.5),
                    jox_leaving_quantile(leaving, JOX_LEFT_ANYWHERE, 0.95), s->exits->last);
    say_exits(s, &text);
    put_summary_statement(out, "Who left when.", &text);
    if (s->inside)
        jox_text_printf(&text, "No. %s still inside at %.1f s, the end of what was measured.",
                        s->inside == 1 ? "1 person was"
                                       : jox_noun(people, s->inside, "person|people were"),
                        s->until);
    else
        jox_text_printf(&text, "Yes, at %.1f s: from then on nobody is inside.", s->exits->last);
    put_summary_statement(out, "Cleared?", &text);
}

/* ---- where it was dangerous ---- */

/* Returns the time in which anybody was over a limit, s. */
static double seconds_over_limit(const JoxDanger *d, int limit) {
    double seconds = 0.0;
    for (uint32_t r = 1; r < d->row_count; r++)
        if (d->rows[r].over[limit] > 0)
            seconds += d->rows[r].time - d->rows[r - 1].time;
    return seconds;
}

/* Returns the verb for a measure, as in "stood in a density of 5 per m2 or more". */
static const char *choose_verb(JoxDangerMeasure measure) {
    const bool borne =
        measure >= (int)JOX_DANGER_FIRST_BORNE && measure <= (int)JOX_DANGER_LAST_BORNE;
    return borne ? "bore a" : "stood in a";
}

/* Appends how many people were over limit l, where and when first, and for how long. */
static void say_limit(const JoxSubject *s, int l, JoxText *out) {
    const JoxDangerLimit *limit = &jox_danger_limits[l];
    const JoxDangerCount count = jox_danger_count(s->danger, l);
    const double seconds = seconds_over_limit(s->danger, l);
    jox_text_add(out, " ");
    jox_text_noun(out, count.people, "person|people");
    jox_text_printf(out, " %s %s or more (%s), first at %.1f s at ", choose_verb(limit->measure),
                    limit->title, limit->what, count.first);
    jox_describe_point(s, count.first_at, out);
    if (seconds > 0.0)
        jox_text_printf(out, "; for %.1f s in all somebody was over it", seconds);
    jox_text_printf(out, ", one person for up to %.1f s.", count.longest);
}

/* Appends the greatest value of a measure, and its limits in ascending order up to the first
   that nobody passed. */
static void say_measure(const JoxSubject *s, JoxDangerMeasure measure, JoxText *out) {
    const JoxDangerMost most = jox_danger_most(s->danger, measure);
    char value[32];
    snprintf(value, sizeof value, measure == JOX_DANGER_LOAD ? "%.0f N" : "%.3g per m\xc2\xb2",
             most.value);
    jox_text_printf(out, "The greatest %s was %s", jox_danger_titles[measure], value);
    if (isfinite(most.time)) {
        jox_text_printf(out, ", at %.1f s at ", most.time);
        jox_describe_point(s, most.at, out);
    }
    jox_text_add(out, ".");
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        if (jox_danger_limits[l].measure != measure)
            continue;
        if (jox_danger_count(s->danger, l).people == 0) {
            jox_text_printf(out, " Nobody %s %s or more.", choose_verb(measure),
                            jox_danger_limits[l].title);
            break;
        }
        say_limit(s, l, out);
    }
}

/* Writes the greatest densities, both by the Gaussian and by Voronoi cells, as the two differ. */
static void put_density_summary(FILE *out, const JoxSubject *s) {
    const JoxDangerMost most = jox_danger_most(s->danger, JOX_DANGER_VORONOI);
    JoxText text = {0}, people = {0};
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        if (jox_danger_limits[l].measure != JOX_DANGER_VORONOI)
            continue;
        jox_text_add(&people, people.length ? ", " : "; ");
        jox_text_noun(&people, jox_danger_count(s->danger, l).people, "person|people");
        jox_text_printf(&people, " had %g or more", jox_danger_limits[l].value);
    }
    say_measure(s, JOX_DANGER_DENSITY, &text);
    jox_text_add(&text, " ");
    if (isfinite(most.value))
        jox_text_printf(&text, "The greatest %s was %.3g per m\xc2\xb2, at %.1f s%s.",
                        jox_danger_titles[JOX_DANGER_VORONOI], most.value, most.time, people.data);
    else
        jox_text_printf(&text,
                        "Voronoi densities were not measured: nobody stood in %g per m\xc2\xb2.",
                        (double)JOX_VORONOI_LEAST);
    put_summary_statement(out, "Where it was dense.", &text);
    jox_text_free(&people);
}

static void put_load_summary(FILE *out, const JoxSubject *s) {
    JoxText text = {0};
    if (!jox_danger_has_measure(s->danger, JOX_DANGER_LOAD))
        return;
    say_measure(s, JOX_DANGER_LOAD, &text);
    put_summary_statement(out, "Loads on people.", &text);
}

static void put_pressure_summary(FILE *out, const JoxSubject *s) {
    const JoxDangerMost most = jox_danger_most(s->danger, JOX_DANGER_PRESSURE);
    JoxText text = {0};
    int l = 0;
    while (jox_danger_limits[l].measure != JOX_DANGER_PRESSURE)
        l++;
    if (!jox_danger_has_measure(s->danger, JOX_DANGER_PRESSURE)) {
        jox_text_add(&text, "Not measured: the crowd was nowhere dense enough for long enough (5 "
                            "per m\xc2\xb2 or more on 12 m\xc2\xb2 for 20 s).");
    } else {
        jox_text_printf(&text, "The greatest crowd pressure was %.2g per s\xc2\xb2.", most.value);
        if (jox_danger_count(s->danger, l).people)
            say_limit(s, l, &text);
        else
            jox_text_printf(&text, " Nobody stood in a %s or more, where turbulence sets in.",
                            jox_danger_limits[l].title);
    }
    put_summary_statement(out, "Crowd turbulence.", &text);
}

/* Writes the regions of significant congestion (JOX_CONGESTION_DENSITY for JOX_CONGESTION_SHARE
   of the time). */
static void put_congestion_summary(FILE *out, const JoxSubject *s) {
    enum { MOST = 2 };
    const JoxDanger *d = s->danger;
    JoxCongestionFound found = jox_congestion_find(&d->congestion, d->local->grid);
    JoxText text = {0};
    const char *time = found.cleared ? "until nobody was inside" : "so far, with people inside";
    if (!found.known)
        jox_text_printf(&text, "Not judged: only %.1f s were measured.", found.time);
    else if (found.count == 0 && found.longest > 0.0)
        jox_text_printf(
            &text,
            "None that is significant: no place was above %g per m\xc2\xb2 " JOX_DENSITY_BY
            " for longer "
            "than %.0f %% of the %.1f s %s; at most for %.1f s, at ",
            (double)JOX_CONGESTION_DENSITY, 100.0 * JOX_CONGESTION_SHARE, found.time, time,
            found.longest);
    else if (found.count == 0)
        jox_text_printf(&text, "None: no place was above %g per m\xc2\xb2 " JOX_DENSITY_BY ".",
                        (double)JOX_CONGESTION_DENSITY);
    else
        jox_text_printf(&text,
                        "Significant: above %g per m\xc2\xb2 " JOX_DENSITY_BY
                        " for more than %.0f %% of the %.1f s %s.",
                        (double)JOX_CONGESTION_DENSITY, 100.0 * JOX_CONGESTION_SHARE, found.time,
                        time);
    if (found.known && found.count == 0 && found.longest > 0.0) {
        jox_describe_point(s, found.longest_at, &text);
        jox_text_add(&text, ".");
    }
    for (uint32_t r = 0; r < found.count && r < MOST; r++) {
        const JoxCongestionRegion *region = &found.regions[r];
        jox_text_printf(&text, " %.1f m\xc2\xb2 about ", region->area);
        jox_describe_point(s, region->at, &text);
        jox_text_printf(&text, ": %.1f s in all, between %.1f and %.1f s.", region->seconds,
                        region->first, region->last);
    }
    if (found.count > MOST)
        jox_text_printf(&text, " %u more %s so for less time; danger-congestion.csv has all.",
                        found.count - MOST, found.count - MOST == 1 ? "was" : "were");
    put_summary_statement(out, "Congestion.", &text);
    jox_congestion_found_free(&found);
}

/* Appends the number of passages that a line's probe counted, if it differs from the number of
   crossings. */
static void say_probe_count(const JoxSubject *s, const JoxDangerLine *line, JoxText *out) {
    for (uint32_t p = 0; p < s->probe_count; p++) {
        const JoxProbeDef *def = jox_probe_def(s->probes[p]);
        const uint32_t passages = jox_probe_passages(s->probes[p]);
        JoxText window = {0};
        if (def->kind != JOX_PROBE_FLOW || strcmp(def->name, line->name) != 0 ||
            passages == line->forward + line->back)
            continue;
        jox_probe_window(s->probes[p], &window);
        jox_text_printf(out, " (its probe has %u: %s%sone way, net)", passages,
                        window.length ? window.data : "", window.length ? ", " : "");
        jox_text_free(&window);
        return;
    }
}

/* Writes the crossings and flows of lines, and where there was stop-and-go. */
static void put_line_summary(FILE *out, const JoxSubject *s) {
    const JoxDangerLines *lines = &s->danger->lines;
    JoxText text = {0};
    if (lines->count == 0)
        return;
    for (uint32_t l = 0; l < lines->count; l++) {
        const JoxDangerLine *line = &lines->items[l];
        if (line->worst < 0)
            continue;
        const double given = (double)jox_length(jox_sub(line->given[1], line->given[0]));
        jox_text_printf(&text, "%s%.60s (%.2f m wide", text.length ? " " : "", line->name,
                        line->width);
        if (line->width < 0.9 * given)
            jox_text_printf(&text, ": what walls leave of its %.2f m", given);
        jox_text_add(&text, "): ");
        jox_text_noun(&text, (uint64_t)line->forward + line->back, "crossing");
        jox_text_printf(&text, " from %.4g s on", s->danger->congestion.begun);
        say_probe_count(s, line, &text);
        jox_text_printf(&text, ", at most %.2f per m and s", line->flow_most);
        if (line->stop_and_go.seconds > 0.0)
            jox_text_printf(&text, ", stop-and-go for %.1f s from %.1f s on",
                            line->stop_and_go.seconds, line->stop_and_go.first);
        else
            jox_text_add(&text, ", no stop-and-go");
        if (line->growth_most > 0.0)
            jox_text_printf(&text, "; its queue grew by up to %.2g per s", line->growth_most);
        jox_text_add(&text, ".");
    }
    if (text.length)
        put_summary_statement(out, "Doors and other lines.", &text);
}

/* ---- stairs and lifts ---- */

/* Returns the stair with the greatest of a figure; -1: none was measured. Flows are compared where
   enough people passed. */
static int32_t find_greatest_stair(const JoxDangerStairs *s, bool by_flow) {
    int32_t found = -1;
    double most = 0.0;
    for (uint32_t k = 0; k < s->count; k++) {
        const JoxDangerStair *on = &s->items[k];
        const double value = by_flow ? on->flow_most : on->mean_most;
        if (!(value > most) || (by_flow && !jox_danger_stair_is_judged(on)))
            continue;
        most = value;
        found = (int32_t)k;
    }
    return found;
}

/* Writes on which stair most people passed per metre, and on which it was densest. */
static void put_stair_summary(FILE *out, const JoxSubject *s) {
    const JoxDangerStairs *stairs = &s->danger->stairs;
    const int32_t flow = find_greatest_stair(stairs, true),
                  dense = find_greatest_stair(stairs, false);
    JoxText text = {0};
    if (!jox_danger_stairs_joining(stairs))
        return;
    if (dense < 0) {
        jox_text_add(&text, "Nobody was on a stair.");
    } else {
        const JoxDangerStair *on = &stairs->items[dense];
        jox_text_printf(&text,
                        "The densest was %.60s: %.2g per m\xc2\xb2 about each of its people on "
                        "average, at %.1f s",
                        stairs->storeys->stairs[dense].name, on->mean_most, on->mean_most_time);
        if (on->over > 0.0)
            jox_text_printf(&text, ", for %.1f s at the limit of %g or over it.", on->over,
                            stairs->limit);
        else
            jox_text_printf(&text, ", below the limit of %g.", stairs->limit);
    }
    if (flow >= 0) {
        const JoxDangerStair *on = &stairs->items[flow];
        jox_text_printf(&text, " The greatest flow was over %.60s: %.2f per m and s, at %.1f s; ",
                        stairs->storeys->stairs[flow].name, on->flow_most, on->flow_most_time);
        jox_text_noun(&text, (uint64_t)on->up + on->down, "person|people");
        jox_text_add(&text, " passed it.");
    } else if (dense >= 0) {
        jox_text_printf(&text, " Fewer than %d people passed each: flows are not judged.",
                        JOX_STAIR_FEW);
    }
    put_summary_statement(out, "Stairs.", &text);
}

/* Writes how long people waited for each lift. */
static void put_lift_summary(FILE *out, const JoxSubject *s) {
    JoxText text = {0};
    for (uint32_t l = 0; s->rides && l < s->lift_count; l++) {
        const JoxLiftResult *r = &s->rides[l];
        jox_text_printf(&text, "%s%.60s carried ", l ? " " : "", r->name);
        if (!r->count.queue_most && !r->count.carried) {
            jox_text_add(&text, "nobody.");
            continue;
        }
        jox_text_noun(&text, r->count.carried, "person|people");
        if (r->count.carried)
            jox_text_printf(&text, ", who waited %.0f s on average, at most %.0f s", r->wait_mean,
                            r->wait_most);
        jox_text_printf(&text, "; at most %u waited at a time", r->count.queue_most);
        if (r->waiting)
            jox_text_printf(&text, ", and %u still do, for up to %.0f s", r->waiting,
                            r->waiting_longest);
        if (r->count.open_most > JOX_LONG_OPEN)
            jox_text_printf(&text, "; its door stood open for up to %.0f s", r->count.open_most);
        jox_text_add(&text, ".");
    }
    if (text.length)
        put_summary_statement(out, "Lifts.", &text);
}

/* Writes how many people who cannot use stairs stay at the end, and on which storeys. */
static void put_stranded_summary(FILE *out, const JoxSubject *s) {
    JoxText text = {0};
    for (uint32_t k = 0; s->storeys && s->stranded && k < s->storeys->storey_count; k++) {
        const JoxStranded *here = &s->stranded[k];
        const struct {
            uint32_t people;
            const char *stay;
        } STAY[] = {{here->in_refuge, "in a refuge, as no lift takes them"},
                    {here->nowhere, "with neither a lift that takes them nor a refuge"},
                    {here->on_stairs, "on a stair or ramp with no way on"}};
        const char *join = ": ";
        if (!jox_run_is_anybody_stranded(here))
            continue;
        jox_text_printf(&text, "%sOn %.60s", text.length ? " " : "", s->storeys->storeys[k].name);
        for (size_t n = 0; n < sizeof STAY / sizeof *STAY; n++)
            if (STAY[n].people) {
                jox_text_printf(&text, "%s%u stay %s", join, STAY[n].people, STAY[n].stay);
                join = ", ";
            }
        jox_text_add(&text, ".");
    }
    if (text.length)
        put_summary_statement(out, "People who cannot use stairs.", &text);
}

/* ---- levels of service ---- */

/* Returns the time of an area at levels E and F, s. */
static double seconds_crowded(const JoxDangerArea *area) {
    return area->level_s[JOX_LEVELS - 2] + area->level_s[JOX_LEVELS - 1];
}

/* Appends the areas that were at level E or F, in descending order of that time. */
static void say_crowded_areas(const JoxDanger *d, JoxText *out) {
    enum { MOST = 4 };
    uint32_t crowded = 0, told = 0;
    double before = INFINITY;
    for (uint32_t a = 0; a < d->areas.count; a++)
        crowded += seconds_crowded(&d->areas.items[a]) > 0.0;
    while (told < crowded && told < MOST) {
        double next = 0.0;
        for (uint32_t a = 0; a < d->areas.count; a++)
            if (seconds_crowded(&d->areas.items[a]) < before)
                next = fmax(next, seconds_crowded(&d->areas.items[a]));
        for (uint32_t a = 0; a < d->areas.count && told < MOST; a++) {
            const JoxDangerArea *area = &d->areas.items[a];
            if (seconds_crowded(area) != next)
                continue;
            told++;
            jox_text_printf(out,
                            " %.60s was at E or F for %.1f s, with at most %.2g per m\xc2\xb2 "
                            "about each of its people, at %.1f s.",
                            area->name, next, (double)area->most, area->most_time);
        }
        before = next;
    }
    if (crowded > told)
        jox_text_printf(out, " %u more %s so for less time; the table has all.", crowded - told,
                        crowded - told == 1 ? "was" : "were");
}

/* Writes the share of time at levels E and F, and the areas concerned. */
static void put_level_summary(FILE *out, const JoxSubject *s) {
    const JoxDanger *d = s->danger;
    double all = 0.0, crowded = 0.0;
    JoxText text = {0};
    for (int k = 0; k < JOX_LEVELS; k++)
        all += d->level_s[k];
    if (!(all > 0.0))
        return;
    crowded = d->level_s[JOX_LEVELS - 2] + d->level_s[JOX_LEVELS - 1];
    jox_text_printf(
        &text,
        "People spent %.1f %% of their time here at Fruin's levels E and F for queues: in more "
        "than %.1f per m\xc2\xb2 " JOX_DENSITY_BY ".",
        100.0 * crowded / all, 1.0 / jox_levels[JOX_LEVELS - 3].queue_area);
    say_crowded_areas(d, &text);
    put_summary_statement(out, "Levels of service.", &text);
}

static void put_trust_summary(FILE *out, const JoxSubject *s) {
    const double density = jox_danger_most(s->danger, JOX_DANGER_DENSITY).value;
    JoxText text = {0};
    jox_trust_append_signs(s->overlap_p99, s->depth_p99, density, &text);
    if (text.length)
        put_summary_statement(out, "Too dense to trust.", &text);
}

void jox_summary_crowd(FILE *out, const JoxSubject *s) {
    put_leaving_summary(out, s);
    put_density_summary(out, s);
    put_load_summary(out, s);
    put_pressure_summary(out, s);
    put_congestion_summary(out, s);
    put_line_summary(out, s);
    put_stair_summary(out, s);
    put_lift_summary(out, s);
    put_stranded_summary(out, s);
    put_level_summary(out, s);
    put_trust_summary(out, s);
}
