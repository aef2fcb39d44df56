/* Inspection by browsers, one agent each: keeps the agent and sends its data with each status. */
#include <assert.h>
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "live/inspect.h"
#include "live/scene_page.h"

static_assert((int)JOX_VIEW_CLIENTS <= (int)JOX_MOST_INSPECTED,
              "no page takes another's agent away");

/* Returns the row of a client (0: a free row), or NULL if there is none. */
static JoxLiveInspector *find_inspector(JoxScenePage *s, uint32_t client) {
    for (uint32_t n = 0; n < JOX_VIEW_CLIENTS; n++)
        if (s->inspectors[n].client == client)
            return &s->inspectors[n];
    return NULL;
}

/* Whether the agent is still in its slot, which a new agent may have taken. */
static bool is_still_in_slot(const JoScene *scene, const JoxLiveInspector *inspector) {
    const JoxAgents *a = &scene->world->state.agents;
    const uint32_t slot = inspector->slot;
    const uint32_t i = slot < a->slot_count ? a->slot_index[slot] : JOX_NO_INDEX;
    return i != JOX_NO_INDEX && a->id[i] == inspector->id;
}

/* Sends the agent of a browser; `found`: which the browser does not know yet. */
static void send_inspected_agent(JoxScenePage *s, JoxLiveInspector *inspector, bool found) {
    const bool there = is_still_in_slot(s->scene, inspector);
    s->page.text.length = 0;
    JoxJson json = jox_json_begin(&s->page.text, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "type", "inspect");
    jox_json_bool(&json, "found", found);
    if (there)
        jox_live_inspect(s->scene, inspector->slot, &json);
    else
        jox_json_null(&json, "agent");
    jox_json_end(&json);
    jox_view_send(s->page.server, inspector->client, s->page.text.data);
    if (!there)
        *inspector = (JoxLiveInspector){0};
}

void jox_scene_page_send_inspected(void *self) {
    JoxScenePage *s = self;
    for (uint32_t n = 0; n < JOX_VIEW_CLIENTS; n++)
        if (s->inspectors[n].client)
            send_inspected_agent(s, &s->inspectors[n], false);
}

/* Returns whether an agent is in a state, or of a group, of this name. */
static bool is_called(const JoScene *scene, uint32_t i, const char *name) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxMachineSet *set = scene->world->machines.set;
    if (a->group[i] < scene->spec->group_count &&
        strcmp(scene->spec->groups[a->group[i]].name, name) == 0)
        return true;
    return a->machine[i] != JOX_NO_MACHINE &&
           jox_state_is_in(&set->items[a->machine[i]]->states[a->state[i]], name);
}

/* Returns the slot of the agent with an id; or of a state or group, of the one that has been
   longest in its state, ties by id. UINT32_MAX: nobody is meant. */
static uint32_t find_called_slot(const JoScene *scene, const char *name) {
    const JoxAgents *a = &scene->world->state.agents;
    char *end;
    const unsigned long id = strtoul(name, &end, 10);
    uint32_t best = JOX_NO_INDEX;
    if (isdigit((unsigned char)*name) && !*end && id < a->next_id)
        best = jox_agents_find(a, (uint32_t)id);
    for (uint32_t i = 0; i < a->count && best == JOX_NO_INDEX; i++)
        best = is_called(scene, i, name) ? i : best;
    for (uint32_t i = 0; i < a->count && best != JOX_NO_INDEX; i++)
        if (is_called(scene, best, name) && is_called(scene, i, name) &&
            (a->entered[i] < a->entered[best] ||
             (a->entered[i] == a->entered[best] && a->id[i] < a->id[best])))
            best = i;
    return best == JOX_NO_INDEX ? UINT32_MAX : a->slot[best];
}

/* Makes a browser inspect the agent in a slot; `found`: it does not know the slot yet. */
static void show_slot(JoxScenePage *s, uint32_t client, uint32_t slot, bool found) {
    const JoxAgents *a = &s->scene->world->state.agents;
    const uint32_t i = slot < a->slot_count ? a->slot_index[slot] : JOX_NO_INDEX;
    JoxLiveInspector *inspector = find_inspector(s, client);
    if (!inspector)
        inspector = find_inspector(s, 0);
    JOX_ASSERT(client != JOX_VIEW_ALL && inspector); /* as many rows as clients */
    *inspector = (JoxLiveInspector){client, slot, i == JOX_NO_INDEX ? UINT32_MAX : a->id[i]};
    send_inspected_agent(s, inspector, found);
}

void jox_scene_page_inspect(void *self, const JoxLiveRequest *request) {
    JoxScenePage *s = self;
    const char *find = jox_command_text(request->command, "find", NULL);
    const double wanted = jox_command_number(request->command, "slot", -1.0);
    const uint32_t slot = find ? find_called_slot(s->scene, find)
                          : wanted >= 0.0 && wanted < 4294967295.0 ? (uint32_t)wanted
                                                                   : UINT32_MAX;
    if (find && slot == UINT32_MAX) {
        jox_live_refuse(request, "nobody here has this id, is in a state or of a group so called");
        return;
    }
    show_slot(s, request->client, slot, find != NULL);
}

void jox_scene_page_show_agent(JoxScenePage *s, uint32_t client, uint32_t id) {
    const JoxAgents *a = &s->scene->world->state.agents;
    const uint32_t i = jox_agents_find(a, id);
    if (i != JOX_NO_INDEX && client != JOX_VIEW_ALL)
        show_slot(s, client, a->slot[i], true);
    for (uint32_t n = 0; i != JOX_NO_INDEX && client == JOX_VIEW_ALL && n < JOX_VIEW_CLIENTS; n++)
        if (s->page.watchers[n].client)
            show_slot(s, s->page.watchers[n].client, a->slot[i], true);
}

void jox_scene_page_end_inspection(void *self, uint32_t client) {
    JoxLiveInspector *inspector = find_inspector(self, client);
    if (inspector)
        *inspector = (JoxLiveInspector){0};
}
