/* Words and units for the figures of summaries, and the order in which they are shown. */
#include <stdio.h>
#include <string.h>

#include "record/danger/danger.h"
#include "sweep/compare/compare.h"

/* The first row whose path matches applies. `*` matches any characters but dots; the first one is
   %s in the words. Key figures come first, in the order of display. */
static const struct {
    const char *path, *words, *unit;
    bool is_key;
} ROWS[] = {
    {"danger.clearance_s", "time until everybody had left", "s", true},
    {"danger.leaving_s.p50", "time by which half had left", "s", true},
    {"danger.leaving_s.p95", "time by which 95 % had left", "s", true},
    {"danger.left", "people who left", "", true},
    {"danger.inside", "people still inside at the end", "", true},
    {"danger.last_left_s", "time at which the last person left", "s", true},
    {"danger.exits.*.people", "people who left by %s", "", true},
    {"danger.exits.*.last_s", "time at which the last left by %s", "s", true},
    {"density_max", "greatest density of any place and time " JOX_DENSITY_BY, "1/m2", true},
    {"danger.level_person_s.F", "time spent at level of service F, all people", "s", true},
    {"danger.load_max", "greatest load on anybody", "N", true},
    {"danger.pressure_max", "greatest crowd pressure", "1/s2", true},
    {"danger.dose_max", "greatest dose of load", "", true},
    {"stood_longest.s", "longest time that anybody stood who wanted to get on", "s", true},
    {"tally.*", "tally of %s", "", true},
    {"probes.*.flow", "flow through %s", "1/s", true},
    {"probes.*.mean", "mean of %s", "", true},
    {"probes.*.median", "median of %s", "", true},
    {"probes.*.p95", "95 % value of %s", "", true},
    {"danger.congestion.longest_s",
     "longest time that a place was above 4 per m\xc2\xb2 " JOX_DENSITY_BY, "s", true},
    {"danger.congestion.regions", "regions of significant congestion", "", true},
    {"danger.lines.*.stop_and_go.seconds", "time of stop-and-go at %s", "s", true},
    {"danger.stairs.*.flow_max", "greatest flow over the stair %s", "1/(m s)", true},
    {"danger.stairs.*.density_mean_max", "greatest mean density on the stair %s " JOX_DENSITY_BY,
     "1/m2", true},
    {"danger.stairs.*.over_limit_s", "time over the limit of density on the stair %s", "s", true},
    {"lifts.*.wait_mean_s", "mean wait for the lift %s", "s", true},
    {"lifts.*.wait_max_s", "longest wait for the lift %s", "s", true},
    {"lifts.*.queue_max", "most people before the lift %s", "", true},
    {"cannot_use_stairs.in_refuge", "people who cannot use stairs, in a refuge at the end", "",
     true},
    {"cannot_use_stairs.without_refuge",
     "people who cannot use stairs, without lift and refuge at the end", "", true},
    {"cannot_use_stairs.on_stairs", "people who cannot use stairs, on a stair or ramp at the end",
     "", true},
    {"regions.*", "mean speed in %s", "m/s", true},
    {"danger.leaving_s.first", "time at which the first left", "s", false},
    {"danger.leaving_s.p25", "time by which 25 % had left", "s", false},
    {"danger.leaving_s.p75", "time by which 75 % had left", "s", false},
    {"danger.leaving_s.last", "time at which the last left", "s", false},
    {"danger.areas.*.density_max", "greatest mean density about the people in %s " JOX_DENSITY_BY,
     "1/m2", false},
    {"danger.areas.*.density_max_s", "time of the greatest mean density in %s", "s", false},
    {"danger.areas.*.people_max", "most people in %s", "", false},
    {"danger.areas.*.level_s.*", "", "s", false},
    {"danger.density_max_s", "time of the greatest density " JOX_DENSITY_BY, "s", false},
    {"danger.pressure_max_s", "time of the greatest crowd pressure", "s", false},
    {"danger.compression_max_s", "time of the greatest compression", "s", false},
    {"danger.load_max_s", "time of the greatest load", "s", false},
    {"danger.dose_max_s", "time of the greatest dose of load", "s", false},
    {"danger.walls.load_max_s", "time of the greatest load of a wall", "s", false},
    {"danger.walls.pieces", "pieces of walls", "", false},
    {"danger.lines.*.flow_max_s", "time of the greatest flow at %s", "s", false},
    {"danger.congestion.first_s",
     "time at which a place was first above 4 per m\xc2\xb2 " JOX_DENSITY_BY, "s", false},
    {"danger.congestion.area", "area of significant congestion", "m2", false},
    {"danger.congestion.time_s", "time that congestion is judged over", "s", false},
    {"danger.lines.*.queue_growth_max", "greatest growth of the queue at %s", "1/s", false},
    {"danger.lines.*.queue_growth_max_s", "time of the greatest growth of the queue at %s", "s",
     false},
    {"danger.lines.*.stop_and_go.first_s", "time at which stop-and-go began at %s", "s", false},
    {"probes.*.people", "people in %s, mean over time", "", false},
    {"probes.*.density_max", "greatest density in %s", "1/m2", false},
    {"probes.*.density_p90", "90 % value of density over time in %s", "1/m2", false},
    {"probes.*.density_median", "median density in %s", "1/m2", false},
    {"probes.*.density_classical", "people per area of %s", "1/m2", false},
    {"probes.*.intervals", "samples of %s", "", false},
    {"probes.*.standing", "share of people who stand in %s", "", false},
    {"probes.*.speed_deviation", "deviation of the speeds at %s", "m/s", false},
    {"probes.*.flow_all", "flow through %s from the first to the last passage", "1/s", false},
    {"probes.*.forward", "passages of %s", "", false},
    {"probes.*.back", "passages back of %s", "", false},
    {"probes.*.first", "time of the first passage of %s", "s", false},
    {"probes.*.last", "time of the last passage of %s", "s", false},
    {"probes.*.duration", "time from the first to the last passage of %s", "s", false},
    {"probes.*.lapse_median", "median time between passages of %s", "s", false},
    {"probes.*.lapse_max", "longest time between passages of %s", "s", false},
    {"agents", "people at the end", "", false},
    {"events.spawned", "people who came", "", false},
    {"events.removed", "people who were taken out", "", false},
    {"events.hits", "hits by bodies", "", false},
    {"events.throws", "throws", "", false},
    {"events.kicks", "kicks", "", false},
    {"events.pickups", "bodies taken up", "", false},
    {"events.falls", "falls", "", false},
    {"events.most_fallen", "most people who lay at a time after falls", "", false},
    {"events.dropped", "bodies dropped for want of room", "", false},
    {"events.transitions", "changes of state", "", false},
    {"events.opened", "gates opened", "", false},
    {"events.closed", "gates closed", "", false},
    {"events.shifted_at_birth", "people who began beside their point", "", false},
    {"events.born_in_others", "people who came in with their torso in another", "", false},
    {"events.not_placed", "people who were not placed", "", false},
    {"events.most_without_spot", "most people who waited at a time where there was no room", "",
     false},
    {"events.most_without_way", "most people at a time whom no way led to their target", "", false},
    {"events.moved_out", "people moved out of the way of walls that came", "", false},
    {"events.not_moved_out", "people who stayed in the way of walls that came", "", false},
    {"events.people_lost", "people lost", "", false},
    {"events.bodies_lost", "bodies lost", "", false},
    {"events.script_failures", "failed calls of functions of behaviours", "", false},
    {"events.changes_lost", "lost changes of others' memory", "", false},
    {"events.messages_lost", "messages dropped because too many waited", "", false},
    {"events.messages_unasked", "messages that nobody asks for", "", false},
    {"events.messages_to_nobody", "messages to nobody", "", false},
    {"lp_failure_peak",
     "greatest share of people in a step for whom no velocity met all constraints", "", false},
    {"danger.density_max", "greatest density that was sampled " JOX_DENSITY_BY, "1/m2", false},
    {"danger.voronoi_max", "greatest Voronoi density of a person", "1/m2", false},
    {"danger.voronoi_max_s", "time of the greatest Voronoi density", "s", false},
    {"danger.compression_max", "greatest compression of anybody", "N/m", false},
    {"danger.walls.load_max", "greatest load of a wall", "N/m", false},
    {"danger.level_person_s.*", "time spent at level of service %s, all people", "s", false},
    {"danger.lines.*.flow_max", "greatest flow at %s", "1/s", false},
    {"danger.lines.*.width", "width of %s", "m", false},
    {"danger.lines.*.forward", "passages of %s", "", false},
    {"danger.lines.*.back", "passages back of %s", "", false},
    {"danger.lines.*.level_s.*", "", "s", false},
    {"danger.stairs.*.up", "people who went up the stair %s", "", false},
    {"danger.stairs.*.down", "people who went down the stair %s", "", false},
    {"danger.stairs.*.people_max", "most people at a time on the stair %s", "", false},
    {"danger.stairs.*.used_s", "time in which somebody was on the stair %s", "s", false},
    {"danger.stairs.*.first_s", "time at which the stair %s was first used", "s", false},
    {"danger.stairs.*.last_s", "time at which the stair %s was last used", "s", false},
    {"danger.stairs.*.flow_max_s", "time of the greatest flow over the stair %s", "s", false},
    {"danger.stairs.*.density_max", "greatest density where somebody stood on the stair %s", "1/m2",
     false},
    {"danger.stairs.*.density_max_s", "time of that on the stair %s", "s", false},
    {"danger.stairs.*.density_mean_max_s", "time of the greatest mean density on the stair %s", "s",
     false},
    {"danger.stairs.*.level_s.*", "", "s", false},
    {"danger.by_lift.up", "people who went up by lift", "", false},
    {"danger.by_lift.down", "people who went down by lift", "", false},
    {"cannot_use_stairs.storeys.*.in_refuge",
     "people who cannot use stairs, in a refuge on %s at the end", "", false},
    {"cannot_use_stairs.storeys.*.without_refuge",
     "people who cannot use stairs, without lift and refuge on %s at the end", "", false},
    {"cannot_use_stairs.storeys.*.on_stairs",
     "people who cannot use stairs, on a stair or ramp near %s at the end", "", false},
    {"lifts.*.carried", "people whom the lift %s carried", "", false},
    {"lifts.*.let_out", "people whom the lift %s let out", "", false},
    {"lifts.*.trips", "trips of the lift %s with people in it", "", false},
    {"lifts.*.full_trips", "trips of the lift %s with no room left", "", false},
    {"lifts.*.filled", "mean share of the room filled in the lift %s", "", false},
    {"lifts.*.wait_p90_s", "wait for the lift %s that 90 % stay below", "s", false},
    {"lifts.*.ride_mean_s", "mean time in the lift %s", "s", false},
    {"lifts.*.left_behind", "times that somebody found no room in the lift %s", "", false},
    {"lifts.*.turned_away", "times that somebody could not get into the lift %s", "", false},
    {"lifts.*.reopened", "times that the door of the lift %s opened again", "", false},
    {"lifts.*.queue_max_s", "time of the longest queue before the lift %s", "s", false},
    {"lifts.*.waiting", "people before the lift %s at the end", "", false},
    {"lifts.*.waiting_longest_s", "longest that one of them had waited for the lift %s", "s",
     false},
    {"lifts.*.door_open_max_s", "longest time for which the door of the lift %s stood open", "s",
     false},
    {"lifts.*.metres", "way of the lift %s", "m", false},
    {"probes.*.specific_flow", "flow per metre through %s", "1/(m s)", false},
    {"probes.*.passages", "passages of %s", "", false},
    {"probes.*.speed", "mean speed at %s", "m/s", false},
    {"probes.*.density", "density at %s", "1/m2", false},
    {"states.*.*", "", "", false},
    {"bodies", "bodies at the end", "", false},
    {"lp_failure_share", "share of steps of people in which no velocity met all constraints", "",
     false},
    {"turned_aside_share", "share of steps of people in which they turned aside", "", false},
    {"plans_bounded_share", "share of steps of people in which more was asked than they can do", "",
     false},
    {"trust.overlap_share",
     "share of people's time in which they overlap by more than 10 % of their depth", "", false},
    {"overlap_p99", "99 % value of overlap, share of a person's depth", "", false},
    {"depth_p99", "99 % value of overlap of those who touch", "m", false},
};
enum { ROW_COUNT = sizeof ROWS / sizeof *ROWS };

/* Figures of which less is worse. */
static const char *const LOW[] = {
    "danger.left", "danger.exits.*.people",   "probes.*.flow",  "probes.*.specific_flow",
    "regions.*",   "danger.lines.*.flow_max", "lifts.*.carried"};

const char *jox_figure_unit(const char *unit) {
    static const char *const UNITS[][2] = {{"1/m2", "per m\xc2\xb2"},
                                           {"1/s2", "per s\xc2\xb2"},
                                           {"1/s", "per s"},
                                           {"1/(m s)", "per m and s"}};
    for (size_t u = 0; u < sizeof UNITS / sizeof *UNITS; u++)
        if (strcmp(UNITS[u][0], unit) == 0)
            return UNITS[u][1];
    return unit;
}

/* Returns whether a path matches a pattern; `first` is then what the first `*` matched. */
static bool match_path(const char *row, const char *path, char first[100]) {
    bool any = false;
    for (; *row; row++) {
        if (*row != '*') {
            if (*row != *path++)
                return false;
            continue;
        }
        const size_t n = strcspn(path, ".");
        if (!any)
            snprintf(first, 100, "%.*s", (int)n, path);
        any = true;
        path += n;
    }
    return *path == 0;
}

/* Returns the first row that matches a path; ROW_COUNT if none does. */
static int find_words_row(const char *path, char first[100]) {
    *first = 0;
    for (int r = 0; r < ROW_COUNT; r++)
        if (match_path(ROWS[r].path, path, first))
            return r;
    return ROW_COUNT;
}

/* Fills the words of a figure about a published limit, such as "danger.limits.density_5.person_s";
   false for any other figure. */
static bool fill_limit_words(const char *path, JoxFigureWords *out) {
    static const char PREFIX[] = "danger.limits.";
    static const struct {
        const char *end, *words;
    } ENDS[] = {{"person_s", "time over %s, all people"},
                {"people", "people who were ever over %s"},
                {"longest_s", "longest that anybody was over %s"},
                {"first_s", "time at which anybody first was over %s"}};
    if (strncmp(path, PREFIX, sizeof PREFIX - 1) != 0)
        return false;
    const char *key = path + sizeof PREFIX - 1, *end = strchr(key, '.');
    for (int l = 0; end && l < JOX_DANGER_LIMITS; l++) {
        const JoxDangerLimit *limit = &jox_danger_limits[l];
        if (strlen(limit->key) != (size_t)(end - key) ||
            strncmp(limit->key, key, (size_t)(end - key)) != 0)
            continue;
        for (size_t e = 0; e < sizeof ENDS / sizeof *ENDS; e++) {
            char name[100];
            if (strcmp(end + 1, ENDS[e].end) != 0)
                continue;
            snprintf(name, sizeof name, "a %s", limit->title);
            const char *at = strstr(ENDS[e].words, "%s");
            snprintf(out->text, sizeof out->text, "%.*s%s%s", (int)(at - ENDS[e].words),
                     ENDS[e].words, name, at + 2);
            out->unit = strstr(ENDS[e].end, "_s") ? "s" : "";
            out->is_key = e < 2;
            return true;
        }
    }
    return false;
}

JoxFigureWords jox_figure_words(const char *path) {
    JoxFigureWords out = {.unit = ""};
    char first[100];
    for (size_t l = 0; l < sizeof LOW / sizeof *LOW; l++)
        out.low_is_worse |= match_path(LOW[l], path, first);
    const int r = find_words_row(path, first);
    if (fill_limit_words(path, &out))
        return out;
    if (r == ROW_COUNT) { /* unknown: shown as its path, with a unit guessed from the ending */
        const size_t n = strlen(path);
        out.unit = n > 2 && !strcmp(path + n - 2, "_s") ? "s" : "";
        snprintf(out.text, sizeof out.text, "%.180s", path);
        return out;
    }
    const char *words = ROWS[r].words, *at = strstr(words, "%s"), *last = strrchr(path, '.');
    const bool of_level = strstr(path, ".level_s.") != NULL;
    if (of_level)
        snprintf(out.text, sizeof out.text, "time at level of service %.8s of %s", last + 1, first);
    else if (!strncmp(path, "states.", 7))
        snprintf(out.text, sizeof out.text, "people of %s at the end in the state %.60s", first,
                 last + 1);
    else if (at)
        snprintf(out.text, sizeof out.text, "%.*s%s%s", (int)(at - words), words, first, at + 2);
    else
        snprintf(out.text, sizeof out.text, "%s", words);
    out.unit = ROWS[r].unit;
    out.is_key = ROWS[r].is_key;
    return out;
}

int jox_figure_compare_paths(const char *a, const char *b) {
    static const char LIMITS[] = "danger.limits.";
    char first[100];
    const JoxFigureWords x = jox_figure_words(a), y = jox_figure_words(b);
    int r = find_words_row(a, first), s = find_words_row(b, first);
    const int density = find_words_row("density_max", first); /* figures of limits follow it */
    r = strncmp(a, LIMITS, sizeof LIMITS - 1) == 0 ? density : r;
    s = strncmp(b, LIMITS, sizeof LIMITS - 1) == 0 ? density : s;
    if (x.is_key != y.is_key)
        return x.is_key ? -1 : 1;
    const bool is_a = strcmp(a, "density_max") == 0, is_b = strcmp(b, "density_max") == 0;
    return r != s ? r - s : is_a != is_b ? is_b - is_a : strcmp(a, b);
}
