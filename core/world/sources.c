#include "world/sources.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "geom/polygon.h"
#include "world/world.h"

enum { AT_ONCE = 256 };            /* most agents that one source makes in a step */
enum { ATTEMPTS = 64 };            /* most points that are drawn for an agent */
static const double FULL = 0.75;   /* covered share of a floor at which it has no free spots */
static const double NEARLY = 1e-9; /* s: times of steps are sums of rounded steps */

/* ---- entrances ---- */

uint32_t jox_source_count_doors(const JoWorld *world, uint32_t source) {
    const JoxPlace *place = &world->model.places[world->model.sources[source].place];
    return jox_place_is_set(place) ? place->member_count : 1;
}

uint32_t jox_source_door(const JoWorld *world, uint32_t source, uint32_t number) {
    const uint32_t of = world->model.sources[source].place;
    const JoxPlace *place = &world->model.places[of];
    return jox_place_is_set(place) ? (uint32_t)place->members[number] : of;
}

const JoxEntrance *jox_source_entrance(JoWorld *world, uint32_t source, uint32_t number) {
    return jox_entrances_get(&world->scratch.entrances, &world->model.storeys,
                             jox_world_walls(world), world->model.places, world->model.scene_places,
                             jox_source_door(world, source, number));
}

/* ---- where agents enter ---- */

/* Draws a point of a place for a source, on the floor of its entrance. */
static JoxV2 draw_point(const JoWorld *world, const JoxPlace *place, const JoxEntrance *entrance,
                        uint32_t source, uint32_t n) {
    JoxV2 low = place->centre, high = place->centre, p = place->centre;
    double u = 0.0;
    if (!jox_place_is_spot(place))
        jox_bounds(place->points, place->count, &low, &high);
    for (uint32_t attempt = 0; attempt < ATTEMPTS; attempt++) {
        const uint32_t sub = (n * ATTEMPTS + attempt) * 2;
        const uint64_t seed = world->model.def.seed, tick = world->state.tick;
        u = jox_random_unit(seed, source, tick, JOX_DRAW_SOURCE, sub);
        const double v = jox_random_unit(seed, source, tick, JOX_DRAW_SOURCE, sub + 1);
        if (jox_place_is_line(place) || jox_place_is_queue(place)) {
            p = jox_add(place->points[0],
                        jox_scale(jox_sub(place->points[1], place->points[0]), (float)u));
        } else if (jox_place_is_spot(place)) {
            const double angle = JOX_TURN * u, r = place->radius * sqrt(v);
            p = (JoxV2){place->centre.x + (float)(r * jox_cos(angle)),
                        place->centre.y + (float)(r * jox_sin(angle))};
        } else {
            p = (JoxV2){low.x + (high.x - low.x) * (float)u, low.y + (high.y - low.y) * (float)v};
            if (!jox_polygon_contains(place->points, place->count, p))
                continue;
        }
        if (jox_entrance_is_open(entrance, p))
            return p;
    }
    return entrance->cut ? jox_entrance_pick(entrance, u) : place->centre;
}

/* Returns the area of an agent's disc, m2. */
static double get_cover(const JoxAgents *a, uint32_t i) {
    const double radius = jox_param(a, JOX_PARAM_radius, i);
    return JOX_PI * radius * radius;
}

/* Returns the area that agents cover of a floor, m2. */
static double sum_cover(const JoxEntrance *entrance, const JoxAgents *a) {
    double sum = 0.0;
    for (uint32_t i = 0; i < a->count; i++)
        if (jox_entrance_holds(entrance, jox_v2(a->x[i], a->y[i])))
            sum += get_cover(a, i);
    return sum;
}

/* Draws the member of a set by which the n-th agent of a step enters; 0 if the place is no set. */
static uint32_t draw_door(const JoWorld *world, uint32_t s, uint32_t doors, uint32_t n) {
    if (doors == 1)
        return 0;
    const double u = jox_random_unit(world->model.def.seed, s, world->state.tick, JOX_DRAW_DOOR, n);
    return (uint32_t)(u * doors);
}

static bool floor_contains(const void *entrance, JoxV2 spot) {
    return jox_entrance_holds(entrance, spot);
}

/* Returns the wish for a birth at a point of an entrance's floor, within that floor. */
static JoxBirthWish make_wish(const JoxEntrance *entrance, JoxV2 at, uint32_t number) {
    const JoxPlace *floor = &entrance->floor;
    const float beside = jox_place_is_spot(floor) ? floor->radius : JOX_ENTRANCE_REACH;
    JoxBirthWish wish = {.at = at,
                         .contains = floor_contains,
                         .place = entrance,
                         .place_number = number,
                         .stays = true};
    jox_bounds(floor->points, floor->count, &wish.low, &wish.high);
    wish.low = jox_sub(wish.low, (JoxV2){beside, beside});
    wish.high = jox_add(wish.high, (JoxV2){beside, beside});
    return wish;
}

/* Makes the due agents that enter by door `number`, while it has room; returns how many. */
static uint32_t fill_door(JoWorld *world, uint32_t s, uint32_t doors, uint32_t number,
                          uint32_t due) {
    const JoxAgentSource *source = &world->model.sources[s];
    const uint32_t door = jox_source_door(world, s, number);
    const JoxEntrance *entrance = jox_source_entrance(world, s, number);
    double sum = sum_cover(entrance, &world->state.agents);
    uint32_t made = 0;
    bool full = false;
    for (uint32_t n = 0; n < due && !full && sum < FULL * entrance->area; n++) {
        if (draw_door(world, s, doors, n) != number)
            continue;
        const JoxV2 at = draw_point(world, &world->model.places[door], entrance, s, n);
        JoxBirth birth = jox_world_birth(world, source->like, at);
        if (source->memory_count > 0) {
            birth.memory = source->memory;
            birth.memory_count = source->memory_count;
        }
        birth.wish = make_wish(entrance, at, world->model.group_count + 1 + door);
        uint32_t agent = JOX_NO_INDEX;
        const JoxBirthSpot spot = jox_world_spawn(world, &birth, &agent);
        full = spot == JOX_BIRTH_NO_ROOM || spot == JOX_BIRTH_NOT_FOUND;
        if (agent == JOX_NO_INDEX)
            continue;
        sum += get_cover(&world->state.agents, agent);
        made++;
    }
    return made;
}

/* ---- how many are due ---- */

/* Integrates a curve of rates from its start to a time: expected agents. */
static double integrate_curve(const JoxAgentSource *source, double time) {
    double sum = 0.0;
    for (uint32_t k = 0; k + 1 < source->curve_count; k++) {
        const double *a = source->curve + 2 * k, *b = a + 2;
        const double end = time < b[0] ? time : b[0];
        if (end <= a[0])
            break;
        const double rate = a[1] + (b[1] - a[1]) * (end - a[0]) / (b[0] - a[0]);
        sum += 0.5 * (a[1] + rate) * (end - a[0]);
    }
    return sum;
}

/* Counts agents due at the given times of a source up to `time`, from its start to before its end.
 */
static double count_scheduled(const JoxAgentSource *source, double time) {
    double due = 0.0;
    for (uint32_t t = 0; t < source->time_count; t++)
        if (source->times[t] <= time + NEARLY && source->times[t] >= source->from &&
            source->times[t] < source->until)
            due += source->people;
    if (source->every > 0.0) {
        const double end = time < source->until ? time : source->until,
                     last = floor((end - source->from + NEARLY) / source->every);
        const bool at_end = source->from + last * source->every >= source->until - NEARLY;
        due += source->people * (last + (at_end ? 0.0 : 1.0));
    }
    return due;
}

/* Returns the agents expected by rate and curve from a source's start to a time, at most its end.
 */
static double count_expected(const JoxAgentSource *source, double time) {
    const double end = time < source->until ? time : source->until;
    return source->rate * (end - source->from) + integrate_curve(source, end) -
           integrate_curve(source, source->from);
}

/* Draws the expected agents between arrival `number` of a source and the next. */
static double draw_gap(const JoWorld *world, uint32_t s, uint64_t number) {
    return -jox_log(1.0 - jox_random_unit(world->model.def.seed, s, number, JOX_DRAW_ARRIVAL, 0));
}

/* Counts the agents due at a source up to a time; independent of the length of the step. */
static double count_due(const JoWorld *world, const JoxAgentSource *source, uint32_t s,
                        JoxArrivals *arrivals, double time) {
    if (time < source->from)
        return 0.0;
    const double expected = count_expected(source, time), exact = count_scheduled(source, time);
    if (source->even)
        return exact + floor(expected + NEARLY);
    while (arrivals->next <= expected)
        arrivals->next += draw_gap(world, s, ++arrivals->count);
    return exact + (double)arrivals->count;
}

/* Starts the arrivals of a source that exists from a time on: before it as many as expected. */
static JoxArrivals begin_arrivals(const JoWorld *world, const JoxAgentSource *source, uint32_t s,
                                  double time) {
    if (source->even)
        return (JoxArrivals){0};
    const double before = time < source->from ? 0.0 : count_expected(source, time);
    const uint64_t count = (uint64_t)before;
    return (JoxArrivals){.next = before + draw_gap(world, s, count), .count = count};
}

/* Returns whether a source makes agents in the step that begins at a time. Its last step is the
   first that begins at its end or later, for agents due since the step before. */
static bool is_at_work(const JoWorld *world, const JoxAgentSource *source, double time) {
    return time >= source->from && time < source->until + world->model.def.dt - NEARLY;
}

/* Counts the agents missing from `keep`, once a second. */
static uint32_t count_missing(const JoWorld *world, const JoxAgentSource *source, double time) {
    const JoxAgents *a = &world->state.agents;
    const uint64_t second = (uint64_t)(1.0 / world->model.def.dt + 0.5);
    uint32_t present = 0;
    if (source->keep == 0 || world->state.tick % second != 0 || time >= source->until)
        return 0;
    for (uint32_t i = 0; i < a->count; i++)
        present += a->group[i] == source->like;
    return present < source->keep ? source->keep - present : 0;
}

static void run_source(JoWorld *world, uint32_t s) {
    const JoxAgentSource *source = &world->model.sources[s];
    JoxSourceFigures *figures = &world->state.sources.figures[s];
    double *made = &world->state.sources.made[s];
    const double time = (double)world->state.tick * world->model.def.dt;
    if (!is_at_work(world, source, time))
        return;
    figures->due = count_due(world, source, s, &world->state.sources.arrivals[s], time);
    const double scheduled = figures->due > *made ? figures->due - *made : 0.0;
    const uint32_t missing = count_missing(world, source, time);
    const double all = scheduled + missing;
    const uint32_t due = all > AT_ONCE ? AT_ONCE : (uint32_t)all,
                   doors = jox_source_count_doors(world, s);
    uint32_t entered = 0;
    for (uint32_t door = 0; due > 0 && door < doors; door++)
        entered += fill_door(world, s, doors, door, due);
    const double of_schedule = entered < scheduled ? entered : scheduled;
    *made += of_schedule;
    figures->entered += entered;
    if (missing > 0 || figures->kept > 0)
        figures->kept = missing - (uint64_t)(entered - of_schedule);
    JOX_ASSERT(*made <= figures->due || entered == 0);
}

void jox_world_run_sources(JoWorld *world) {
    if (world->model.source_count > 0)
        jox_world_apply_walls(world);
    for (uint32_t s = 0; s < world->model.source_count; s++)
        run_source(world, s);
}

double jox_source_waiting(const JoWorld *world, uint32_t s) {
    const JoxSourceFigures *figures = &world->state.sources.figures[s];
    const double late = figures->due - world->state.sources.made[s];
    return (late > 0.0 ? late : 0.0) + (double)figures->kept;
}

bool jox_source_is_over(const JoWorld *world, uint32_t s) {
    const JoxAgentSource *source = &world->model.sources[s];
    const double time = (double)world->state.tick * world->model.def.dt;
    return time >= source->from && !is_at_work(world, source, time);
}

bool jox_source_can_bring(const JoWorld *world, uint32_t s) {
    const JoxAgentSource *source = &world->model.sources[s];
    const double time = (double)world->state.tick * world->model.def.dt;
    if (jox_source_is_over(world, s))
        return false;
    bool can = source->rate > 0.0 || source->every > 0.0 || source->keep > 0 ||
               jox_source_waiting(world, s) >= 1.0;
    for (uint32_t t = 0; t < source->time_count && !can; t++)
        can = source->times[t] >= time;
    if (source->curve_count > 0) /* pairs of time and rate */
        can |= source->curve[2 * (source->curve_count - 1)] > time;
    return can;
}

/* ---- model and state ---- */

void jox_source_append_name(const JoWorld *world, uint32_t s, JoxText *out) {
    const JoxWorldModel *m = &world->model;
    uint32_t shared = 0, twins = 0;
    for (uint32_t o = 0; o < m->source_count; o++) {
        const bool same = m->sources[o].place == m->sources[s].place;
        shared += same;
        twins += same && m->sources[o].like == m->sources[s].like && o < s;
    }
    jox_text_printf(out, "%.100s", m->places[m->sources[s].place].name);
    if (shared > 1)
        jox_text_printf(out, " %.100s", m->groups[m->sources[s].like].name);
    if (twins > 0)
        jox_text_printf(out, " %u", twins + 1);
}

void jox_world_set_sources(JoWorld *world, const JoxAgentSource *sources, uint32_t count,
                           bool anew) {
    JoxWorldModel *model = &world->model;
    JoxSourceState *state = &world->state.sources;
    const double time = (double)world->state.tick * model->def.dt;
    JOX_ASSERT(anew || !model->sources || count == model->source_count);
    if (anew) {
        JoxArrivals *arrivals = jox_alloc((size_t)count + 1, sizeof *arrivals);
        double *made = jox_alloc((size_t)count + 1, sizeof *made);
        JoxSourceFigures *figures = jox_alloc((size_t)count + 1, sizeof *figures);
        for (uint32_t s = 0; s < count; s++) {
            const JoxAgentSource *before = s < model->source_count ? &model->sources[s] : NULL;
            arrivals[s] = begin_arrivals(world, &sources[s], s, time);
            figures[s].due = made[s] =
                time > sources[s].from ? count_due(world, &sources[s], s, &arrivals[s], time) : 0.0;
            if (!before || before->place != sources[s].place || before->like != sources[s].like)
                continue;
            const double late = state->figures[s].due - state->made[s];
            made[s] -= late < 0.0 ? 0.0 : late < made[s] ? late : made[s];
            figures[s].entered = state->figures[s].entered;
        }
        jox_free(state->arrivals);
        jox_free(state->made);
        jox_free(state->figures);
        *state = (JoxSourceState){arrivals, made, figures};
    }
    model->sources = sources;
    model->source_count = count;
    jox_entrances_clear(&world->scratch.entrances);
}

void jox_sources_sections(JoWorld *world, JoxSections *s) {
    JoxSourceState *state = &world->state.sources;
    jox_sections_module(s, "sources");
    jox_section(s, "arrivals", state->arrivals, sizeof *state->arrivals, world->model.source_count);
    jox_section(s, "made", state->made, sizeof *state->made, world->model.source_count);
    jox_sections_unhashed(s, true);
    jox_section(s, "figures", state->figures, sizeof *state->figures, world->model.source_count);
    jox_sections_unhashed(s, false);
}

bool jox_world_expects_people(const JoWorld *world) {
    const JoxWorldModel *model = &world->model;
    const double time = (double)world->state.tick * model->def.dt;
    bool expects = false;
    for (uint32_t s = 0; s < model->start_count && !expects; s++)
        expects = model->starts[s].time >= time;
    for (uint32_t g = 0; g < model->group_count && !expects; g++)
        expects = jox_world_starts_waiting(world, g) > 0;
    for (uint32_t s = 0; s < model->source_count && !expects; s++)
        expects = jox_source_can_bring(world, s);
    return expects;
}
