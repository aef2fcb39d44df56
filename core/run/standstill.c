/* The listener that looks, each second, for people who want to get on and do not: who stood
   longest, crowds that stand still, and goals that cannot be reached. Each is said once, while
   the run goes on; results/ reads the rest at the end. */
#include <math.h>

#include "base/format/plurals.h"
#include "base/mem.h"
#include "geom/storey_text.h"
#include "run/run.h"
#include "run/standstill.h"
#include "run/wall_checks.h"
#include "world/routes/hindrance.h"

static const double LOOK_INTERVAL = 1.0;    /* s between looks at all people */
static const float MOVED = 0.5f;            /* m: an agent that moved farther does not stand */
static const double STANDSTILL_TIME = 30.0; /* s: an agent that stood longer stands still */
static const float CLUSTER_RADIUS = 5.0f;   /* m: agents within it form a cluster */
/* A crowd: CROWD people who stand still, or FEW and half of all present. CANDIDATES people are
   tried as the centre of a cluster. */
enum { CROWD = 10, FEW = 3, CANDIDATES = 64 };
/* What is known of the ways to a place. LEADS: there is one. SEEMS_SHUT: there was none at the
   last look; judged if the next agrees, as ways through gates are found a little later. CLEARED:
   judged, and there is one for people as broad as these. TOLD: judged, and reported. */
typedef enum NoWay { LEADS, SEEMS_SHUT, CLEARED, TOLD } NoWay;
/* State of a place at a look. NOBODY: it is nobody's goal. GO: people walk there. WAIT: some wait
   for a gate or body that shuts their way. */
typedef enum Waits { NOBODY, GO, WAIT } Waits;
static const float WIDEST_ROUTE_RADIUS =
    0.22f; /* m: routes are computed for people up to this radius */

typedef struct Stand {
    JoxV2 at;
    uint32_t since; /* tick; NEVER: did not want to get on at the last look */
    uint32_t id;
} Stand;
enum { NEVER = UINT32_MAX };

typedef struct Standing {
    Stand *people; /* by agent's slot */
    size_t capacity;
    uint32_t seen; /* slots that are initialised */
    JoxLongestStand longest;
    JoxStandstill still, now; /* the longest standstill, and the present one; people 0: none */
    JoxV2 *stills;            /* positions of people who stand still at this look */
    size_t still_count, still_capacity;
    uint8_t *told; /* by place: NoWay */
    size_t told_count, told_capacity;
    double *shut_since; /* by place, s: since when people wait for a shut way; NAN: nobody waits */
    size_t shut_count, shut_capacity;
    uint32_t *first; /* by place, at this look: 1 + the broadest agent without a way */
    size_t first_capacity;
    uint8_t *waits; /* by place, at this look: Waits */
    size_t waits_capacity;
    JoxKeptList kept; /* made at time kept_at */
    /* Counts by group of each item of `kept`. Reserved at looks, on the scene's heap:
       jox_run_list_kept_people may be called on the heap of a single call. */
    uint32_t *kept_groups;
    size_t kept_groups_capacity;
    double kept_at;  /* s */
    uint32_t no_way; /* places reported as TOLD */
} Standing;

/* Returns the stand of an agent's slot, reset if the slot has a new agent. */
static Stand *find_stand(Standing *s, const JoxAgents *a, uint32_t i) {
    JOX_RESERVE(s->people, s->capacity, a->slot_count);
    for (; s->seen < a->slot_count; s->seen++)
        s->people[s->seen] = (Stand){.since = NEVER};
    Stand *stand = &s->people[a->slot[i]];
    if (stand->id != a->id[i])
        *stand = (Stand){.since = NEVER, .id = a->id[i]};
    return stand;
}

static void update_stand(Standing *s, const JoWorld *world, uint32_t i) {
    const JoxAgents *a = &world->state.agents;
    const uint32_t tick = (uint32_t)world->state.tick;
    JoxV2 at = {a->x[i], a->y[i]};
    Stand *stand = find_stand(s, a, i);
    if (jox_stands(a, i)) {
        stand->since = NEVER;
        return;
    }
    JoxV2 moved = jox_wrap(a, jox_sub(at, stand->at));
    if (stand->since == NEVER || jox_length2(moved) > MOVED * MOVED) {
        stand->at = at;
        stand->since = tick;
    }
    const double now = jo_world_time(world), stood = now - stand->since * world->model.def.dt;
    if (stood > s->longest.seconds)
        s->longest = (JoxLongestStand){stood, now, stand->at, a->id[i]};
    if (stood >= STANDSTILL_TIME - 1e-9)
        s->stills[s->still_count++] = at;
}

/* ---- crowds ---- */

/* Returns the centre of the densest cluster of people who stand still, trying CANDIDATES of
   them. */
static JoxV2 find_cluster_centre(const Standing *s) {
    const size_t step = s->still_count / CANDIDATES + 1;
    JoxV2 best = {0, 0};
    uint32_t most = 0;
    for (size_t k = 0; k < s->still_count; k += step) {
        JoxV2 sum = {0, 0};
        uint32_t count = 0;
        for (size_t n = 0; n < s->still_count; n++)
            if (jox_length2(jox_sub(s->stills[n], s->stills[k])) <=
                CLUSTER_RADIUS * CLUSTER_RADIUS) {
                sum = jox_add(sum, s->stills[n]);
                count++;
            }
        if (count > most) {
            most = count;
            best = jox_scale(sum, 1.0f / (float)count);
        }
    }
    return best;
}

static void report_standstill(const JoScene *scene, const JoxStandstill *still) {
    JoxText text = {0};
    jox_text_printf(&text, "t = %.1f s: ", jo_world_time(scene->world));
    jox_text_noun(&text, still->people,
                  "person who wants to get on has|people who want to get on have");
    jox_text_printf(&text, " stood still for %.0f s, most of them about ", STANDSTILL_TIME);
    jox_text_position(&text, &scene->spec->storeys, still->at, 1);
    jox_place_where(scene->spec->places, scene->spec->place_count, still->at, true, &text);
    jox_text_add(&text, "\n");
    jox_run_send_text(scene, text.data);
    jox_text_free(&text);
}

static void update_standstill(Standing *s, const JoScene *scene) {
    const uint32_t there = scene->world->state.agents.count, count = (uint32_t)s->still_count;
    const bool crowd = count >= CROWD || (count >= FEW && 2 * count >= there);
    if (!crowd) {
        s->now.people = 0;
        return;
    }
    const bool new = s->now.people == 0;
    if (new)
        s->now = (JoxStandstill){.since = jo_world_time(scene->world) - STANDSTILL_TIME};
    s->now.until = jo_world_time(scene->world);
    if (count > s->now.people) {
        s->now.people = count;
        s->now.at = find_cluster_centre(s);
    }
    if (new)
        report_standstill(scene, &s->now);
    if (s->now.until - s->now.since >= s->still.until - s->still.since)
        s->still = s->now;
}

/* ---- goals that cannot be reached ---- */

static bool blocks_for_good(JoxHindranceKind kind) {
    return kind == JOX_HINDRANCE_WALL || kind == JOX_HINDRANCE_NARROW ||
           kind == JOX_HINDRANCE_FILLED || kind == JOX_HINDRANCE_STAIRS ||
           kind == JOX_HINDRANCE_NO_LIFTS;
}

static float get_radius(const JoxAgents *a, uint32_t i) {
    return jox_param(a, JOX_PARAM_radius, i);
}

/* Whether a closed gate stands on the point or line by which people leave. */
static bool has_gate_at_goal(const JoScene *scene, uint32_t place) {
    const JoxRouteStage stage = jox_world_route_stage(scene->world);
    return jox_hindrance_find_gate(&stage, place) != UINT32_MAX;
}

/* Reports people who cannot get to a place because of walls or bodies that never move. Returns
   false, and reports nothing, if agent `first` of them has a way there, or a gate on it opens
   later. */
static bool report_no_way(Standing *s, JoScene *scene, uint32_t place, uint32_t first) {
    const JoxMachineRun *machines = &scene->world->machines;
    const JoxAgents *a = &scene->world->state.agents;
    const JoxV2 at = {a->x[first], a->y[first]};
    const char *name = machines->places[place].name;
    const JoxRouteStage stage = jox_world_route_stage(scene->world);
    JoxHindrances *hindrances = jox_hindrances_create(&stage, place, NULL);
    const JoxKept one = jox_hindrance_of_agent(a, first);
    const JoxHindrance why = jox_hindrances_find(hindrances, &one);
    uint32_t count = 0;
    for (uint32_t i = 0; blocks_for_good(why.kind) && i < a->count; i++) {
        const JoxKept other = jox_hindrance_of_agent(a, i);
        count += jox_machines_field_goal(machines, i, NULL) == (int32_t)place &&
                 jox_hindrances_kind(hindrances, &other) == why.kind &&
                 !jox_run_waits_in_refuge(scene, &other, why.kind);
    }
    jox_hindrances_free(hindrances);
    if (count == 0)
        return false;
    JoxText text = {0};
    s->no_way++;
    scene->warnings++;
    jox_text_printf(&text, "t = %.1f s: warning: ", jo_world_time(scene->world));
    jox_text_noun(&text, count, "person|people");
    jox_text_printf(&text, " cannot reach %.60s: no way leads there from ",
                    name ? name : "their goal");
    jox_text_position(&text, &scene->spec->storeys, at, 1);
    jox_place_where(scene->spec->places, scene->spec->place_count, at, true, &text);
    jox_text_add(&text, ", not through gates either: ");
    jox_run_say_hindrance(scene, &why, &text);
    if (why.kind == JOX_HINDRANCE_NARROW)
        jox_text_printf(&text, "; a gap of %.2f m is twice a radius",
                        2.0 * (double)get_radius(a, first));
    jox_text_add(&text, "\n");
    jox_run_send_text(scene, text.data);
    jox_text_free(&text);
    return true;
}

static void reserve_places(Standing *s, uint32_t places) {
    JOX_RESERVE(s->told, s->told_capacity, places);
    JOX_RESERVE(s->shut_since, s->shut_capacity, places);
    JOX_RESERVE(s->first, s->first_capacity, places);
    JOX_RESERVE(s->waits, s->waits_capacity, places);
    for (; s->told_count < places; s->told_count++)
        s->told[s->told_count] = LEADS;
    for (; s->shut_count < places; s->shut_count++)
        s->shut_since[s->shut_count] = NAN;
}

static void update_places(Standing *s, JoScene *scene) {
    const JoxMachineRun *machines = &scene->world->machines;
    const JoxAgents *a = &scene->world->state.agents;
    const uint32_t places = machines->place_count;
    bool shut;
    reserve_places(s, places);
    for (uint32_t p = 0; p < places; p++)
        s->first[p] = s->waits[p] = 0; /* NOBODY */
    for (uint32_t i = 0; i < a->count; i++) {
        int32_t place = jox_machines_field_goal(machines, i, &shut);
        if (place >= 0)
            s->waits[place] = shut || s->waits[place] == WAIT ? WAIT : GO;
        if (place < 0 || !(get_radius(a, i) > WIDEST_ROUTE_RADIUS))
            place = jox_machines_no_way(machines, i);
        if (place >= 0 &&
            (!s->first[place] || get_radius(a, i) > get_radius(a, s->first[place] - 1)))
            s->first[place] = i + 1;
    }
    for (uint32_t p = 0; p < places; p++) {
        const uint8_t before = s->told[p];
        const bool waits = s->waits[p] == WAIT || (s->waits[p] == GO && has_gate_at_goal(scene, p));
        s->shut_since[p] = !waits                    ? (double)NAN
                           : isnan(s->shut_since[p]) ? jo_world_time(scene->world)
                                                     : s->shut_since[p];
        if (before == TOLD)
            continue;
        if (!s->first[p] || before == LEADS)
            s->told[p] = s->first[p] ? SEEMS_SHUT : LEADS;
        else if (before == SEEMS_SHUT)
            s->told[p] = report_no_way(s, scene, p, s->first[p] - 1) ? TOLD : CLEARED;
    }
}

/* ---- the listener ---- */

static bool begin_standstills(void *self, JoScene *scene, const void *options, JoError *error) {
    Standing *s = self;
    (void)scene, (void)options, (void)error;
    s->longest.id = JOX_NO_INDEX;
    s->kept_at = -1.0;
    return true;
}

static bool watch_standstills(void *self, JoScene *scene, JoError *error) {
    Standing *s = self;
    const JoWorld *world = scene->world;
    (void)error;
    if (!jox_run_is_sample_due(scene, LOOK_INTERVAL))
        return true;
    JOX_RESERVE(s->stills, s->still_capacity, world->state.agents.count);
    JOX_RESERVE(s->kept_groups, s->kept_groups_capacity,
                (size_t)JOX_MOST_KEPT * scene->spec->group_count);
    s->still_count = 0;
    for (uint32_t i = 0; i < world->state.agents.count; i++)
        update_stand(s, world, i);
    update_standstill(s, scene);
    update_places(s, scene);
    return true;
}

static void list_standstill_sections(void *self, JoxSections *s) {
    Standing *standing = self;
    JOX_SECTION_ARRAY(s, "people", standing->people, standing->seen, standing->capacity);
    JOX_SECTION(s, "longest", standing->longest);
    JOX_SECTION(s, "still", standing->still);
    JOX_SECTION(s, "still_now", standing->now);
    JOX_SECTION_ARRAY(s, "told", standing->told, standing->told_count, standing->told_capacity);
    JOX_SECTION_ARRAY(s, "shut_since", standing->shut_since, standing->shut_count,
                      standing->shut_capacity);
    JOX_SECTION(s, "no_way", standing->no_way);
}

static void free_standstills(void *self) {
    Standing *s = self;
    jox_free(s->people);
    jox_free(s->stills);
    jox_free(s->told);
    jox_free(s->shut_since);
    jox_free(s->waits);
    jox_free(s->kept_groups);
    jox_free(s->first);
}

static const JoxListenerKind STANDING = {.name = "who stood the longest",
                                         .size = sizeof(Standing),
                                         .begin = begin_standstills,
                                         .frame = watch_standstills,
                                         .sections = list_standstill_sections,
                                         .goes_on = true,
                                         .release = free_standstills};

void jox_run_collect_standstills(JoScene *scene) {
    if (!jox_run_find_listener(scene, &STANDING))
        jox_run_attach_listener(scene, &STANDING, NULL, NULL);
}

/* ---- people who are kept from a place at the end ---- */

static JoxKeptPeople *find_kept_people(Standing *s, const JoScene *scene, uint32_t place,
                                       const JoxHindrance *why) {
    JoxKeptList *list = &s->kept;
    const size_t groups = scene->spec->group_count;
    for (uint32_t k = 0; k < list->count; k++)
        if (list->items[k].place == place && list->items[k].why.kind == why->kind &&
            list->items[k].why.by == why->by)
            return &list->items[k];
    if (list->count == JOX_MOST_KEPT)
        return NULL;
    JoxKeptPeople *kept = &list->items[list->count];
    *kept = (JoxKeptPeople){
        .place = place, .groups = s->kept_groups + list->count * groups, .why = *why};
    memset(kept->groups, 0, groups * sizeof *kept->groups);
    list->count++;
    return kept;
}

/* Adds the people who are kept from one place to the list. */
static void add_kept_people(Standing *s, const JoScene *scene, uint32_t place,
                            const bool *opening) {
    const JoxMachineRun *machines = &scene->world->machines;
    const JoxAgents *a = &scene->world->state.agents;
    const JoxRouteStage stage = jox_world_route_stage(scene->world);
    JoxHindrances *hindrances = jox_hindrances_create(&stage, place, opening);
    for (uint32_t i = 0; i < a->count; i++) {
        if (jox_machines_field_goal(machines, i, NULL) != (int32_t)place)
            continue;
        const JoxKept one = jox_hindrance_of_agent(a, i);
        const JoxHindrance why = jox_hindrances_find(hindrances, &one);
        const bool free =
            why.kind == JOX_HINDRANCE_NONE || jox_run_waits_in_refuge(scene, &one, why.kind);
        JoxKeptPeople *kept = free ? NULL : find_kept_people(s, scene, place, &why);
        if (!kept)
            continue;
        kept->people++;
        kept->groups[a->group[i]]++;
        kept->since = blocks_for_good(why.kind) ? (double)NAN : s->shut_since[place];
        kept->stands = blocks_for_good(why.kind);
        if (why.kind == JOX_HINDRANCE_GATE || why.kind == JOX_HINDRANCE_LIFT)
            kept->stands = jox_run_is_fault(scene, &why);
    }
    jox_hindrances_free(hindrances);
}

const JoxKeptList *jox_run_list_kept_people(const JoScene *scene) {
    Standing *s = jox_run_find_listener(scene, &STANDING);
    const double now = jo_world_time(scene->world);
    if (!s || s->kept_groups_capacity < (size_t)JOX_MOST_KEPT * scene->spec->group_count)
        return NULL; /* no look yet since the scene has so many groups */
    if (s->kept_at == now)
        return &s->kept;
    s->kept_at = now;
    s->kept = (JoxKeptList){0};
    bool *opening = jox_run_list_gates_with_opener(scene);
    for (uint32_t p = 0; p < s->told_count && p < scene->world->machines.place_count; p++)
        if (s->told[p] == TOLD || !isnan(s->shut_since[p]))
            add_kept_people(s, scene, p, opening);
    jox_free(opening);
    return &s->kept;
}

const JoxLongestStand *jox_run_longest_stand(const JoScene *scene) {
    const Standing *s = jox_run_find_listener(scene, &STANDING);
    return s ? &s->longest : NULL;
}

const JoxStandstill *jox_run_longest_standstill(const JoScene *scene) {
    const Standing *s = jox_run_find_listener(scene, &STANDING);
    return s && s->still.people ? &s->still : NULL;
}
