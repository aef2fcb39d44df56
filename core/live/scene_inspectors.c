/* Inspection by browsers, one agent each: keeps the agent and sends its data with each status. */
#include <assert.h>

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

static void send_inspected_agent(JoxScenePage *s, JoxLiveInspector *inspector) {
    const bool there = is_still_in_slot(s->scene, inspector);
    s->page.text.length = 0;
    JoxJson json = jox_json_begin(&s->page.text, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "type", "inspect");
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
            send_inspected_agent(s, &s->inspectors[n]);
}

void jox_scene_page_inspect(void *self, const JoxLiveRequest *request) {
    JoxScenePage *s = self;
    const JoxAgents *a = &s->scene->world->state.agents;
    const double wanted = jox_command_number(request->command, "slot", -1.0);
    const uint32_t slot = wanted >= 0.0 && wanted < 4294967295.0 ? (uint32_t)wanted : UINT32_MAX;
    const uint32_t i = slot < a->slot_count ? a->slot_index[slot] : JOX_NO_INDEX;
    JoxLiveInspector *inspector = find_inspector(s, request->client);
    if (!inspector)
        inspector = find_inspector(s, 0);
    JOX_ASSERT(request->client != JOX_VIEW_ALL && inspector); /* as many rows as clients */
    *inspector =
        (JoxLiveInspector){request->client, slot, i == JOX_NO_INDEX ? UINT32_MAX : a->id[i]};
    send_inspected_agent(s, inspector);
}

void jox_scene_page_end_inspection(void *self, uint32_t client) {
    JoxLiveInspector *inspector = find_inspector(self, client);
    if (inspector)
        *inspector = (JoxLiveInspector){0};
}
