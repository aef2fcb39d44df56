/* Answers why agents stay in their states (jo_scene_why): finds the agents that are meant, by id,
   group or state, and explains them within one look. */
#include <string.h>

#include "base/assert.h"
#include "base/format/plurals.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/sort.h"
#include "jostle_tools.h"
#include "run/why/why.h"

static const uint32_t WHY_COOKIE = 0x4a4f5759;

JoWhyDef jo_default_why_def(void) {
    return (JoWhyDef){.cookie = WHY_COOKIE};
}

/* The agents that are asked for. */
typedef struct Asked {
    JoScene *scene;
    const JoWhyDef *def;
    JoxBehaviourLook look;
    int32_t group;      /* index; -1: all */
    uint32_t *agents;   /* their indices, by machine and state, then by time of entry and id */
    uint32_t count, of; /* `of`: agents of the group, in whatever state */
    JoxText text;
    JoxJson json;
} Asked;

enum { MOST_LISTED = 12 };

/* Reports a name that the scene does not have, with the most similar that it has, or with those
   that it has. */
static bool refuse_name(const char *what, const char *given, const char *const *names, size_t count,
                        JoError *error) {
    char hint[JOX_HINT];
    const char *near = jox_did_you_mean(given, names, count, hint);
    JoxText list = {0};
    for (size_t n = 0; !near && n < count && n < MOST_LISTED; n++)
        jox_text_printf(&list, "%s%.40s", n ? ", " : ", only ", names[n]);
    if (!near && count > MOST_LISTED)
        jox_text_add(&list, ", ...");
    jox_error(error, JO_USAGE, "the scene has no %s '%.60s'%s%s", what, given, near ? ". " : "",
              near        ? near
              : list.data ? list.data
                          : "");
    jox_text_free(&list);
    return false;
}

static bool find_group(Asked *asked, JoError *error) {
    const JoxSceneSpec *spec = asked->scene->spec;
    asked->group = -1;
    if (!asked->def->group)
        return true;
    const char **names = jox_alloc(spec->group_count + 1, sizeof *names);
    for (uint32_t g = 0; g < spec->group_count; g++) {
        names[g] = spec->groups[g].name;
        if (strcmp(names[g], asked->def->group) == 0)
            asked->group = (int32_t)g;
    }
    const bool found = asked->group >= 0 ||
                       refuse_name("group", asked->def->group, names, spec->group_count, error);
    jox_free(names);
    return found;
}

/* Checks that some machine has a state that is asked for; NULL: none is. */
static bool check_state(const Asked *asked, const char *state, JoError *error) {
    const JoxMachineSet *set = asked->scene->world->machines.set;
    const char *names[512];
    size_t count = 0;
    if (!state)
        return true;
    for (uint32_t m = 0; m < set->count; m++) {
        if (jox_machine_entry(set->items[m], state) >= 0)
            return true;
        for (uint32_t s = 0; s < set->items[m]->state_count && count < 512; s++)
            names[count++] = set->items[m]->states[s].name;
        for (uint32_t o = 0; o < set->items[m]->outer_count && count < 512; o++)
            names[count++] = set->items[m]->outer[o].name;
    }
    return refuse_name("state", state, names, count, error);
}

/* Returns the state of an agent, or NULL if it has no machine. */
static const JoxState *state_of(const JoScene *scene, uint32_t i) {
    const JoxAgents *a = &scene->world->state.agents;
    return a->machine[i] == JOX_NO_MACHINE
               ? NULL
               : &scene->world->machines.set->items[a->machine[i]]->states[a->state[i]];
}

/* Orders agents by machine, state and id. */
static int compare_states(const void *first, const void *second, const void *context) {
    const JoxAgents *a = context;
    const uint32_t i = *(const uint32_t *)first, j = *(const uint32_t *)second;
    if (a->machine[i] != a->machine[j])
        return a->machine[i] < a->machine[j] ? -1 : 1;
    if (a->state[i] != a->state[j])
        return a->state[i] < a->state[j] ? -1 : 1;
    return (a->id[i] > a->id[j]) - (a->id[i] < a->id[j]);
}

/* Returns whether a transition of the agent's state leads to a state. */
static bool leads_to(const Asked *asked, uint32_t i, const char *to) {
    const JoxAgents *a = &asked->scene->world->state.agents;
    const JoxMachine *machine = asked->scene->world->machines.set->items[a->machine[i]];
    const JoxState *state = &machine->states[a->state[i]];
    for (uint32_t k = 0; k < state->transition_count; k++)
        if (jox_why_leads_to(machine, &state->transitions[k], to))
            return true;
    return false;
}

/* Lists the agents of the group that are in a state (NULL: any) and could go to another (NULL:
   any). */
static void list_agents(Asked *asked, const char *in, const char *to) {
    const JoxAgents *a = &asked->scene->world->state.agents;
    asked->agents = jox_realloc(asked->agents, (size_t)a->count + 1, sizeof *asked->agents);
    asked->count = asked->of = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        const JoxState *state = state_of(asked->scene, i);
        if (!state || (asked->group >= 0 && a->group[i] != asked->group))
            continue;
        asked->of++;
        if ((!in || jox_state_is_in(state, in)) && (!to || leads_to(asked, i, to)))
            asked->agents[asked->count++] = i;
    }
    uint32_t *spare = jox_alloc(JOX_SORT_SPARE((size_t)a->count) + 1, sizeof *spare);
    jox_sort(asked->agents, asked->count, sizeof *asked->agents, compare_states, a, spare);
    jox_free(spare);
}

/* Returns how many of the listed agents from `first` on share a state. */
static uint32_t count_alike(const Asked *asked, uint32_t first) {
    const JoxAgents *a = &asked->scene->world->state.agents;
    const uint32_t i = asked->agents[first];
    uint32_t end = first;
    while (end < asked->count && a->machine[asked->agents[end]] == a->machine[i] &&
           a->state[asked->agents[end]] == a->state[i])
        end++;
    return end - first;
}

/* Begins the answer for many: how many there are, and whether `nobody` is in the state. */
static void begin_crowds(Asked *asked, bool nobody, const char *to) {
    const JoWhyDef *def = asked->def;
    const double now = jo_world_time(asked->scene->world);
    char people[JOX_NOUN];
    if (def->json) {
        jox_json_object(&asked->json, NULL);
        jox_json_digits(&asked->json, "time", now, 9);
        jox_json_string(&asked->json, "group", def->group);
        jox_json_string(&asked->json, "state", def->state);
        jox_json_string(&asked->json, "to", to);
        jox_json_whole(&asked->json, "people", asked->of);
        jox_json_whole(&asked->json, "in_state", nobody ? 0 : asked->count);
        jox_json_array(&asked->json, "crowds");
        return;
    }
    jox_text_printf(&asked->text, "%.2f s: %s%s%s", now,
                    jox_noun(people, asked->of, "person|people"), def->group ? " of group " : "",
                    def->group ? def->group : "");
    if (nobody)
        jox_text_printf(&asked->text, ", nobody in %s", def->state);
    if (to)
        jox_text_printf(&asked->text,
                        asked->count ? "; who could go to %s:"
                                     : "; nobody is in a "
                                       "state that leads to %s",
                        to);
    jox_text_add(&asked->text, "\n");
}

static void explain_crowds(Asked *asked, const char *to) {
    for (uint32_t first = 0, count; first < asked->count; first += count) {
        JoxWhyCrowd crowd;
        count = count_alike(asked, first);
        jox_why_crowd(asked->scene, &asked->look, asked->agents + first, count, &crowd);
        if (asked->def->json)
            jox_why_crowd_json(asked->scene, &crowd, &asked->json);
        else
            jox_why_crowd_text(asked->scene, &crowd, to, &asked->text);
        jox_why_crowd_free(&crowd);
    }
    if (asked->def->json) {
        jox_json_end(&asked->json);
        jox_json_end(&asked->json);
    }
}

static bool answer_for_many(Asked *asked, JoError *error) {
    const JoWhyDef *def = asked->def;
    const char *to = def->to;
    if (!find_group(asked, error) || !check_state(asked, def->state, error) ||
        !check_state(asked, to, error))
        return false;
    list_agents(asked, def->state, NULL);
    const bool nobody = def->state && asked->count == 0;
    to = nobody && !to ? def->state : to;
    if (to)
        list_agents(asked, nobody ? NULL : def->state, to);
    begin_crowds(asked, nobody, to);
    if (to && asked->count == 0) { /* no state leads there at once: what all of them wait for */
        to = NULL;
        list_agents(asked, nobody ? NULL : def->state, NULL);
    }
    explain_crowds(asked, to);
    jox_free(asked->agents);
    return true;
}

static void add_agent_json(Asked *asked, const JoxWhyAgent *why) {
    const JoScene *scene = asked->scene;
    const JoxAgents *a = &scene->world->state.agents;
    const uint32_t i = why->agent;
    const bool grouped = a->group[i] < scene->spec->group_count;
    JoxJson *json = &asked->json;
    jox_json_object(json, NULL);
    jox_json_digits(json, "time", why->now, 9);
    jox_json_whole(json, "agent", a->id[i]);
    jox_json_string(json, "group", grouped ? scene->spec->groups[a->group[i]].name : NULL);
    jox_json_string(json, "machine", why->machine->name);
    jox_json_string(json, "state", why->state->name);
    jox_json_digits(json, "since", why->since, 9);
    for (int memory = 0; memory < 2; memory++) {
        const uint32_t count = memory ? why->machine->memory_count : why->machine->own_count;
        jox_json_object(json, memory ? "memory" : "own");
        for (uint32_t s = 0; s < count; s++) {
            JoxText value = {0};
            const bool named = memory ? jox_why_add_memory(scene, i, s, &value)
                                      : jox_why_add_own(scene, i, s, &value);
            if (named)
                jox_json_string(json,
                                memory ? why->machine->memory[s].name : why->machine->own[s].name,
                                value.data);
            jox_text_free(&value);
        }
        jox_json_end(json);
    }
    if (why->to)
        jox_json_array(json, "way");
    for (uint32_t n = 0; n < why->way_count; n++)
        jox_json_string(json, NULL, why->machine->states[why->way[n]].name);
    if (why->to)
        jox_json_end(json);
    jox_why_agent_json(scene, why, json);
    jox_json_end(json);
}

static bool answer_for_one(Asked *asked, JoError *error) {
    const JoxAgents *a = &asked->scene->world->state.agents;
    const uint32_t id = asked->def->agent;
    const uint32_t i = id < a->next_id ? jox_agents_find(a, id) : JOX_NO_INDEX;
    const double now = jo_world_time(asked->scene->world);
    JoxWhyAgent why;
    if (i == JOX_NO_INDEX && id >= a->next_id) {
        jox_error(error, JO_USAGE,
                  "there is no agent %u at %.2f s: %u came in so far, the last is agent %u", id,
                  now, a->next_id, a->next_id ? a->next_id - 1 : 0);
        return false;
    }
    if (i == JOX_NO_INDEX || a->machine[i] == JOX_NO_MACHINE) {
        jox_error(error, JO_USAGE,
                  i == JOX_NO_INDEX ? "agent %u has left by %.2f s: ask for an earlier time"
                                    : "agent %u has no behaviour at %.2f s",
                  id, now);
        return false;
    }
    if (!check_state(asked, asked->def->to, error))
        return false;
    jox_why_agent(asked->scene, &asked->look, i, asked->def->to, &why);
    if (asked->def->json)
        add_agent_json(asked, &why);
    else
        jox_why_agent_text(asked->scene, &why, &asked->text);
    jox_why_agent_free(&why);
    return true;
}

char *jo_scene_why(JoScene *scene, const JoWhyDef *def, JoError *error) {
    JOX_REQUIRE(scene && !scene->def.dry && !scene->world->busy && def && def->cookie == WHY_COOKIE,
                NULL);
    JOX_GUARD (scene->heap, error)
        return NULL;
    Asked asked = {.scene = scene, .def = def};
    asked.json = jox_json_begin(&asked.text, 2);
    jox_world_look(scene->world, &asked.look);
    const bool good =
        def->has_agent ? answer_for_one(&asked, error) : answer_for_many(&asked, error);
    jox_world_end_look(scene->world, &asked.look);
    if (good && def->json)
        jox_text_add(&asked.text, "\n");
    if (good)
        return jox_disown(asked.text.data);
    jox_text_free(&asked.text);
    jox_free(asked.agents);
    return NULL;
}
