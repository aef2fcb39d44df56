/* What pages are shown: frames as they come, figures and fields four times a second. */
#include <string.h>

#include "base/mem.h"
#include "live/view_parts.h"

static const double FRAME = 1.0 / 65.0; /* s, least time between frames */
static const double SPEECH = 0.25;      /* s between figures */
enum { PEOPLE_CHANNEL = JOX_VIEW_FIRST_TEXT - 1 };

uint32_t jox_viewing_channels(const JoxWatcher *watcher) {
    uint32_t field =
        watcher->field < JOX_LIVE_FIELDS ? (uint32_t)1 << (JOX_VIEW_FIELDS + watcher->field) : 0;
    return (uint32_t)1 << (JOX_VIEW_FRAMES + watcher->colour) | field | 1u << PEOPLE_CHANNEL |
           1u << JOX_VIEW_STATUS;
}

/* A hello describes everything; what had been sent before it is of another scene. */
static void send_hello(JoxViewing *v, uint32_t client) {
    v->text.length = 0;
    jox_live_scene(v->scene, &v->text);
    jox_view_send(v->view, client, v->text.data);
}

void jox_viewing_greet(JoxViewing *v, uint32_t client) {
    send_hello(v, client);
    jox_viewing_tell_mistakes(v, client);
    v->people_known = false;
    v->changed = true;
}

/* Frames in every colour that somebody wants. */
static void show_frames(JoxViewing *v) {
    bool wanted[JOX_LIVE_COLOUR_COUNT] = {false};
    for (uint32_t w = 0; w < JOX_VIEW_CLIENTS; w++)
        if (v->watchers[w].client)
            wanted[v->watchers[w].colour] = true;
    for (uint32_t c = 0; c < JOX_LIVE_COLOUR_COUNT; c++) {
        if (!wanted[c])
            continue;
        jox_live_frame(v->scene, (JoxLiveColour)c, &v->frame);
        jox_view_publish(v->view, JOX_VIEW_FRAMES + c, v->frame.data, v->frame.length);
    }
}

static void show_people(JoxViewing *v) {
    bool news = jox_live_people(v->scene, &v->people);
    if (news || !v->people_known)
        jox_view_publish(v->view, PEOPLE_CHANNEL, v->people.data, v->people.length);
    v->people_known = true;
}

static void show_fields(JoxViewing *v) {
    for (uint32_t f = 0; f < JOX_LIVE_FIELDS; f++) {
        bool wanted = false;
        for (uint32_t w = 0; w < JOX_VIEW_CLIENTS; w++)
            wanted |= v->watchers[w].client && v->watchers[w].field == (JoxLiveField)f;
        if (!wanted)
            continue;
        jox_live_field(v->scene, (JoxLiveField)f, &v->field);
        jox_view_publish(v->view, JOX_VIEW_FIELDS + f, v->field.data, v->field.length);
    }
}

static void show_figures(JoxViewing *v) {
    v->session.dropped = jox_view_dropped(v->view);
    v->text.length = 0;
    jox_live_status(v->scene, &v->session, &v->text);
    jox_view_publish(v->view, JOX_VIEW_STATUS, v->text.data, v->text.length);
}

void jox_viewing_inspect(JoxViewing *v) {
    if (!v->inspector)
        return;
    v->text.length = 0;
    JoxJson json = jox_json_begin(&v->text, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "type", "inspect");
    bool there = jox_run_inspect(v->scene, v->inspected, &json);
    jox_json_end(&json);
    jox_view_send(v->view, v->inspector, v->text.data);
    if (!there)
        v->inspector = 0;
}

void jox_viewing_show(JoxViewing *v, double now) {
    if (!jox_view_clients(v->view))
        return;
    bool figures = now - v->spoke >= SPEECH;
    if (figures) {
        uint64_t version = jox_live_version(v->scene);
        if (version != v->version)
            jox_viewing_greet(v, JOX_VIEW_ALL);
        v->version = version;
    }
    if (v->changed && now - v->showed >= FRAME) {
        show_frames(v);
        v->showed = now;
        v->changed = false;
    }
    if (figures) {
        show_people(v);
        show_figures(v);
        show_fields(v);
        jox_viewing_inspect(v);
        v->spoke = now;
    }
}
