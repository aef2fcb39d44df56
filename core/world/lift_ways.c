/* Ways that lead by lifts: how long a ride takes at present, and the lift by which an agent gets to
   a place soonest, which may lie beyond stairs, ramps and other lifts. Fields that lead by lifts
   know the ways, with usual times; the lift that comes first is chosen by who waits for it. */
#include <math.h>

#include "world/lift_parts.h"
#include "world/routes/hindrance.h"

/* Returns how many car loads of people have to be carried before an agent that takes a lift now;
   `before`: of those who wait, only those who called before this tick. */
static double count_loads_before(const JoWorld *w, uint32_t lift, uint32_t id, uint32_t before) {
    const JoxLiftState *state = &w->state.lifts;
    uint32_t people = 0;
    for (uint32_t r = 0; r < state->rider_count; r++) {
        const JoxRider *rider = &state->riders[r];
        people += rider->lift == lift && rider->id != id &&
                  (rider->phase <= JOX_RIDE_BOARD && rider->since <= before);
    }
    return (double)people / w->model.lifts[lift].capacity;
}

bool jox_lift_suits(const JoWorld *w, uint32_t agent, const JoxLift *lift, uint32_t from,
                    uint32_t to) {
    const JoxAgents *a = &w->state.agents;
    const float width = 2.0f * jox_minf(lift->stops[from].half, lift->stops[to].half);
    return jox_param(a, JOX_PARAM_mass, agent) <= lift->load &&
           width >= jox_hindrance_narrowest(jox_param(a, JOX_PARAM_radius, agent));
}

double jox_lift_estimate_ride(const JoWorld *w, uint32_t lift, uint32_t from, uint32_t stop,
                              const JoxRider *rider) {
    const JoxLift *of = &w->model.lifts[lift];
    const JoxLiftCar *car = &w->state.lifts.cars[lift];
    const double height = (double)of->stops[from].height;
    const double ride = jox_lift_travel_time(of, (double)of->stops[stop].height - height);
    const double come = jox_lift_travel_time(of, car->height - height);
    const double doors = (double)of->opening + (double)of->closing + (double)of->dwell;
    const bool waits = rider->phase == JOX_RIDE_WAIT && rider->lift == lift;
    const double loads =
        count_loads_before(w, lift, rider->id, waits ? rider->since : (uint32_t)w->state.tick);
    return ride + come + doors + 2.0 * loads * (ride + doors) +
           (car->mode == JOX_LIFT_OUT_OF_USE ? 1e6 : 0.0);
}

/* An agent that looks for its way to a place. */
typedef struct Seeker {
    const JoWorld *w;
    uint32_t agent;
    const JoxRider *rider;
    bool has;                 /* the rider has chosen a lift already */
    bool stepless;            /* it cannot use stairs */
    bool any;                 /* lifts that cannot take it count, too: it waits before one */
    double speed;             /* m/s */
    JoxV2 at;                 /* m */
    const JoxField *by_lifts; /* to its place; NULL: not known yet */
    double least;             /* s: of the quickest way found */
} Seeker;

static const JoxField *get_field(const JoWorld *w, int32_t place, JoxRouteKind kind) {
    const JoxField *const *fields = (const JoxField *const *)w->machines.fields;
    return fields ? fields[(uint32_t)place * JOX_ROUTE_KINDS + kind] : NULL;
}

/* Returns the length of the way on foot to a place, m; INFINITY: none leads there, `unknown` where
   there is no field yet. */
static double measure_walk(const Seeker *s, int32_t place, double unknown) {
    const JoxField *field =
        get_field(s->w, place, s->stepless ? JOX_ROUTE_STEPLESS : JOX_ROUTE_NOW);
    return field ? (double)jox_field_distance(field, s->at) : unknown;
}

/* Returns the way on from a stop where an agent leaves a lift, m; INFINITY if none leads on, or if
   it leads back into this lift. */
static double measure_rest(const Seeker *s, uint32_t lift, uint32_t stop) {
    const JoxLift *lifts = s->w->model.lifts;
    const JoxV2 outside = jox_lift_outside(&lifts[lift], stop, &s->w->model.storeys);
    uint32_t next, unused;
    if (jox_field_first_lift(s->by_lifts, lifts, s->w->model.lift_count, outside, &next, &unused) &&
        next == lift)
        return INFINITY;
    return (double)jox_field_distance(s->by_lifts, outside);
}

/* Tries the rides in a lift from a stop to all others; `way`: length of the way to its door, m. */
static void try_rides(Seeker *s, uint32_t l, uint32_t from, double way, JoxRider *found) {
    const JoxLift *lift = &s->w->model.lifts[l];
    const bool fetched = s->w->state.lifts.cars[l].mode == JOX_LIFT_FIREMEN;
    for (uint32_t to = 0; to < lift->stop_count; to++) {
        if (to == from || (fetched && to != lift->home) ||
            !(s->any || jox_lift_suits(s->w, s->agent, lift, from, to)))
            continue;
        const bool own = s->has && s->rider->lift == l && s->rider->to == to;
        const double time = (way + measure_rest(s, l, to)) / s->speed +
                            jox_lift_estimate_ride(s->w, l, from, to, s->rider) -
                            (own ? JOX_LIFT_LOYAL : 0.0);
        if (!(time < s->least))
            continue;
        s->least = time;
        found->lift = l;
        found->from = from;
        found->to = to;
    }
}

/* Tries all lifts that stop on a storey; `way`: to the point `before` on it, m. */
static void try_lifts_on(Seeker *s, uint32_t storey, double way, JoxV2 before, JoxRider *found) {
    const JoWorld *w = s->w;
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        const JoxLift *lift = &w->model.lifts[l];
        const uint32_t mode = w->state.lifts.cars[l].mode;
        const int32_t from = jox_lift_stop_at(lift, storey);
        if (from < 0 || (mode != JOX_LIFT_IN_USE && !(s->stepless && mode == JOX_LIFT_FIREMEN)))
            continue;
        const JoxV2 door = jox_lift_outside(lift, (uint32_t)from, &w->model.storeys);
        const double straight = way + (double)jox_length(jox_sub(door, before));
        try_rides(s, l, (uint32_t)from,
                  way > 0.0 ? straight : measure_walk(s, lift->stops[from].place, straight), found);
    }
}

static Seeker begin_seeking(const JoWorld *w, uint32_t i, const JoxRider *rider, bool has) {
    const JoxAgents *a = &w->state.agents;
    const bool stepless = jox_param(a, JOX_PARAM_lifts, i) > JOX_LIFTS_ONLY;
    return (Seeker){.w = w,
                    .agent = i,
                    .rider = rider,
                    .has = has,
                    .stepless = stepless,
                    .speed = fmax((double)jox_param(a, JOX_PARAM_speed, i), 0.1),
                    .at = {a->x[i], a->y[i]},
                    .by_lifts = get_field(w, rider->goal,
                                          stepless ? JOX_ROUTE_STEPLESS_LIFTS : JOX_ROUTE_LIFTS)};
}

/* Tries the lifts on the agent's storey, and those at the first lift of its way. */
static void try_lifts(Seeker *s, uint32_t sheet, JoxRider *found) {
    const JoWorld *w = s->w;
    const JoxStoreys *storeys = &w->model.storeys;
    uint32_t lift, stop;
    if (sheet < storeys->storey_count)
        try_lifts_on(s, sheet, 0.0, s->at, found);
    if (jox_field_first_lift(s->by_lifts, w->model.lifts, w->model.lift_count, s->at, &lift,
                             &stop) &&
        w->model.lifts[lift].stops[stop].storey != sheet) {
        const JoxV2 door = jox_lift_outside(&w->model.lifts[lift], stop, storeys);
        const double way = (double)jox_field_distance(s->by_lifts, s->at) -
                           (double)jox_field_distance(s->by_lifts, door);
        try_lifts_on(s, w->model.lifts[lift].stops[stop].storey, fmax(way, 0.1), door, found);
    }
}

bool jox_lift_find_on_way(const JoWorld *w, uint32_t i, const JoxRider *rider, bool has,
                          JoxRider *found) {
    const JoxStoreys *storeys = &w->model.storeys;
    Seeker s = begin_seeking(w, i, rider, has);
    const uint32_t sheet = jox_sheet_of(storeys, s.at.y);
    const double walk = s.least = measure_walk(&s, rider->goal, NAN) / s.speed;
    if (isnan(walk) || !s.by_lifts)
        return false;
    if (sheet >= storeys->storey_count && (has || walk < INFINITY))
        return has; /* nobody turns back on a stair */
    try_lifts(&s, sheet, found);
    if (isinf(s.least)) {
        s.any = true;
        try_lifts(&s, sheet, found);
    }
    return s.least < walk;
}

bool jox_lift_choose_stop(const JoWorld *w, uint32_t i, JoxRider *rider) {
    const Seeker s = begin_seeking(w, i, rider, true);
    const JoxLift *lift = &w->model.lifts[rider->lift];
    const JoxLiftCar *car = &w->state.lifts.cars[rider->lift];
    const JoxField *walk =
        get_field(w, rider->goal, s.stepless ? JOX_ROUTE_STEPLESS : JOX_ROUTE_NOW);
    const JoxField *rest = s.by_lifts ? s.by_lifts : walk;
    double least = INFINITY;
    for (uint32_t to = 0; rest && to < lift->stop_count; to++) {
        const JoxV2 outside = jox_lift_outside(lift, to, &w->model.storeys);
        const double height = (double)lift->stops[to].height - car->height;
        const double time = (double)jox_field_distance(rest, outside) / s.speed +
                            jox_lift_travel_time(lift, height);
        if (time < least) {
            least = time;
            rider->to = to;
        }
    }
    return least < INFINITY;
}
