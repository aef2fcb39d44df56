/* Who wants to get on and does not: who stood the longest, crowds that stand still, and people to
   whose goal no way leads. Said while the run goes on, once each. */
#include <math.h>

#include "base/format/noun.h"
#include "base/mem.h"
#include "run/run.h"

static const double LOOK = 1.0;   /* s between looks at each person */
static const float MOVED = 0.25f; /* m: who has come so far does not stand */
static const double STILL = 30.0; /* s: who has stood so long stands still */
static const float ABOUT = 5.0f;  /* m: about the middle of a crowd */
/* A crowd: so many of them, or fewer but half of all who are there. */
enum { CROWD = 10, FEW = 3, CANDIDATES = 64 };
/* What is known of a place: that a way leads there; that none did when last looked, which is told
   once it holds at two looks, as ways through gates are known a little later; that it was told. */
typedef enum NoWay { LEADS, SEEMS_SHUT, TOLD } NoWay;

typedef struct Stand {
    JoxV2 at;
    uint32_t since; /* tick; NEVER: did not want to get on when last seen */
    uint32_t id;
} Stand;
enum { NEVER = UINT32_MAX };

typedef struct Standing {
    Stand *people; /* by slot */
    size_t capacity;
    uint32_t seen; /* slots that were ever looked at */
    JoxStood longest;
    JoxStill still, now; /* the longest, and the present one; people 0: none */
    JoxV2 *stills;       /* where those stand who do so now */
    size_t still_count, still_capacity;
    uint8_t *told; /* by place: NoWay */
    size_t told_count, told_capacity;
    uint32_t *first; /* by place: of this look the first person with none, plus 1 */
    size_t first_capacity;
    uint32_t no_way; /* places to which none leads */
} Standing;

/* Slots are used again: who is new in one has not stood yet. */
static Stand *stand_of(Standing *s, const JoxAgents *a, uint32_t i) {
    JOX_RESERVE(s->people, s->capacity, a->slot_count);
    for (; s->seen < a->slot_count; s->seen++)
        s->people[s->seen] = (Stand){.since = NEVER};
    Stand *stand = &s->people[a->slot[i]];
    if (stand->id != a->id[i])
        *stand = (Stand){.since = NEVER, .id = a->id[i]};
    return stand;
}

static void look(Standing *s, const JoWorld *world, uint32_t i) {
    const JoxAgents *a = &world->state.agents;
    const uint32_t tick = (uint32_t)world->state.tick;
    JoxV2 at = {a->x[i], a->y[i]};
    Stand *stand = stand_of(s, a, i);
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
        s->longest = (JoxStood){stood, now, stand->at, a->id[i]};
    if (stood >= STILL - 1e-9)
        s->stills[s->still_count++] = at;
}

/* ---- crowds ---- */

/* Where most of those who stand still are: of some of them, the middle of those about the one who
   has most about. */
static JoxV2 middle(const Standing *s) {
    const size_t step = s->still_count / CANDIDATES + 1;
    JoxV2 best = {0, 0};
    uint32_t most = 0;
    for (size_t k = 0; k < s->still_count; k += step) {
        JoxV2 sum = {0, 0};
        uint32_t count = 0;
        for (size_t n = 0; n < s->still_count; n++)
            if (jox_length2(jox_sub(s->stills[n], s->stills[k])) <= ABOUT * ABOUT) {
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

static void say_still(const JoScene *scene, const JoxStill *still) {
    JoxText text = {0};
    jox_text_printf(&text, "t = %.1f s: ", jo_world_time(scene->world));
    jox_text_noun(&text, still->people,
                  "person who wants to get on has|people who want to get on have");
    jox_text_printf(&text, " stood still for %.0f s, most of them about (%.1f, %.1f) m", STILL,
                    (double)still->at.x, (double)still->at.y);
    jox_place_where(scene->spec->places, scene->spec->place_count, still->at, true, &text);
    jox_text_add(&text, "\n");
    jox_run_tell(scene, text.data);
    jox_text_free(&text);
}

static void judge(Standing *s, const JoScene *scene) {
    const uint32_t there = scene->world->state.agents.count, count = (uint32_t)s->still_count;
    const bool crowd = count >= CROWD || (count >= FEW && 2 * count >= there);
    if (!crowd) {
        s->now.people = 0;
        return;
    }
    const bool new = s->now.people == 0;
    if (new)
        s->now = (JoxStill){.since = jo_world_time(scene->world) - STILL};
    s->now.until = jo_world_time(scene->world);
    if (count > s->now.people) {
        s->now.people = count;
        s->now.at = middle(s);
    }
    if (new)
        say_still(scene, &s->now);
    if (s->now.until - s->now.since >= s->still.until - s->still.since)
        s->still = s->now;
}

/* ---- goals that cannot be reached ---- */

static void say_no_way(Standing *s, JoScene *scene, uint32_t place, uint32_t first) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxV2 at = {a->x[first], a->y[first]};
    const char *name = scene->world->machines.places[place].name;
    uint32_t count = 0;
    JoxText text = {0};
    for (uint32_t i = first; i < a->count; i++)
        count += jox_machines_no_way(&scene->world->machines, i) == (int32_t)place;
    s->no_way++;
    scene->warnings++;
    jox_text_printf(&text, "t = %.1f s: warning: ", jo_world_time(scene->world));
    jox_text_noun(&text, count, "person|people");
    jox_text_printf(&text, " cannot reach %.60s: no way leads there from (%.1f, %.1f) m",
                    name ? name : "their goal", (double)at.x, (double)at.y);
    jox_place_where(scene->spec->places, scene->spec->place_count, at, true, &text);
    jox_text_add(&text, ", not through gates either. Is a gap narrower than people are?\n");
    jox_run_tell(scene, text.data);
    jox_text_free(&text);
}

static void look_for_ways(Standing *s, JoScene *scene) {
    const JoxMachineRun *machines = &scene->world->machines;
    JOX_RESERVE(s->told, s->told_capacity, machines->place_count);
    for (; s->told_count < machines->place_count; s->told_count++)
        s->told[s->told_count] = LEADS;
    JOX_RESERVE(s->first, s->first_capacity, machines->place_count);
    uint32_t *first = s->first;
    for (uint32_t p = 0; p < machines->place_count; p++)
        first[p] = 0;
    for (uint32_t i = 0; i < scene->world->state.agents.count; i++) {
        const int32_t place = jox_machines_no_way(machines, i);
        if (place >= 0 && !first[place])
            first[place] = i + 1;
    }
    for (uint32_t p = 0; p < machines->place_count; p++) {
        const uint8_t before = s->told[p];
        if (before == TOLD)
            continue;
        s->told[p] = !first[p] ? LEADS : before == LEADS ? SEEMS_SHUT : TOLD;
        if (s->told[p] == TOLD)
            say_no_way(s, scene, p, first[p] - 1);
    }
}

/* ---- the listener ---- */

static bool begin(void *self, JoScene *scene, const void *options, JoError *error) {
    Standing *s = self;
    (void)scene, (void)options, (void)error;
    s->longest.id = JOX_NO_INDEX;
    return true;
}

static bool frame(void *self, JoScene *scene, JoError *error) {
    Standing *s = self;
    const JoWorld *world = scene->world;
    (void)error;
    if (!jox_run_is_due(scene, LOOK))
        return true;
    JOX_RESERVE(s->stills, s->still_capacity, world->state.agents.count);
    s->still_count = 0;
    for (uint32_t i = 0; i < world->state.agents.count; i++)
        look(s, world, i);
    judge(s, scene);
    look_for_ways(s, scene);
    return true;
}

static void sections(void *self, JoxSections *s) {
    Standing *standing = self;
    JOX_SECTION_ARRAY(s, "people", standing->people, standing->seen, standing->capacity);
    JOX_SECTION(s, "longest", standing->longest);
    JOX_SECTION(s, "still", standing->still);
    JOX_SECTION(s, "still_now", standing->now);
    JOX_SECTION_ARRAY(s, "told", standing->told, standing->told_count, standing->told_capacity);
    JOX_SECTION(s, "no_way", standing->no_way);
}

static void release(void *self) {
    Standing *s = self;
    jox_free(s->people);
    jox_free(s->stills);
    jox_free(s->told);
    jox_free(s->first);
}

static const JoxListenerKind STANDING = {.name = "who stood the longest",
                                         .size = sizeof(Standing),
                                         .begin = begin,
                                         .frame = frame,
                                         .sections = sections,
                                         .goes_on = true,
                                         .release = release};

void jox_run_collect_standing(JoScene *scene) {
    if (!jox_run_listener(scene, &STANDING))
        jox_run_listen(scene, &STANDING, NULL, NULL);
}

bool jox_run_told_no_way(const JoScene *scene, uint32_t place) {
    const Standing *s = jox_run_listener(scene, &STANDING);
    return s && place < s->told_count && s->told[place] == TOLD;
}

const JoxStood *jox_run_stood_longest(const JoScene *scene) {
    const Standing *s = jox_run_listener(scene, &STANDING);
    return s ? &s->longest : NULL;
}

const JoxStill *jox_run_stood_still(const JoScene *scene) {
    const Standing *s = jox_run_listener(scene, &STANDING);
    return s && s->still.people ? &s->still : NULL;
}
