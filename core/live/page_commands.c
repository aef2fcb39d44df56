/* Commands of browsers: carries out those that are the same for all sources, and hands the others
   to the source. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "live/page.h"

static const double SLOWEST = 0.01, FASTEST = 1000.0; /* simulated seconds per second */

static const struct {
    const char *name, *needs;
} VERBS[JOX_LIVE_VERB_COUNT] = {
#define X(verb, needs) [JOX_LIVE_VERB_##verb] = {#verb, needs},
    JOX_LIVE_VERBS(X)
#undef X
};

void jox_live_set_channels(JoxLivePage *page, const JoxLiveWatcher *watcher) {
    JOX_ASSERT(watcher->client && watcher->colour < JOX_LIVE_COLOUR_COUNT);
    uint32_t channels = 1u << JOX_LIVE_PEOPLE_CHANNEL | 1u << JOX_VIEW_STATUS |
                        1u << JOX_LIVE_TIME_CHANNEL | 1u << (JOX_VIEW_FRAMES + watcher->colour);
    if (watcher->field < JOX_LIVE_FIELDS)
        channels |= 1u << (JOX_VIEW_FIELDS + watcher->field);
    jox_view_listen(page->server, watcher->client, channels);
}

static void handle_colour(JoxLiveWatcher *watcher, const JoxLiveRequest *request) {
    const int colour = jox_live_colour(jox_command_text(request->command, "by", ""));
    if (colour < 0) {
        jox_live_refuse(
            request,
            "by is state, speed, force, compression, load, density, group, direction or service");
        return;
    }
    watcher->colour = (JoxLiveColour)colour;
    request->page->changed = true;
    jox_live_set_channels(request->page, watcher);
}

static void handle_field(JoxLiveWatcher *watcher, const JoxLiveRequest *request) {
    const int field = jox_live_field_named(jox_command_text(request->command, "of", ""));
    if (field < 0) {
        jox_live_refuse(request, "of is density, pressure or none");
        return;
    }
    watcher->field = (JoxLiveField)field;
    request->page->last_status = 0.0;
    jox_live_set_channels(request->page, watcher);
}

static void handle_speed(JoxLiveWatcher *watcher, const JoxLiveRequest *request) {
    const double factor = jox_command_number(request->command, "factor", NAN);
    (void)watcher;
    if (factor >= SLOWEST && factor <= FASTEST)
        request->page->session.speed = factor;
    else
        jox_live_refuse(request, "factor is from 0.01 to 1,000 seconds shown in a second");
    request->page->last_status = 0.0;
}

static void handle_scale(JoxLiveWatcher *watcher, const JoxLiveRequest *request) {
    (void)watcher;
    request->page->scales = (JoxLiveScales){
        .fixed = jox_command_bool(request->command, "fixed", !request->page->scales.fixed)};
    request->page->session.fixed = request->page->scales.fixed;
    request->page->changed = true;
    request->page->last_status = 0.0;
}

/* Commands that are the same for all sources, by verb. */
static void (*const COMMON[JOX_LIVE_VERB_COUNT])(JoxLiveWatcher *, const JoxLiveRequest *) = {
    [JOX_LIVE_VERB_colour] = handle_colour,
    [JOX_LIVE_VERB_scale] = handle_scale,
    [JOX_LIVE_VERB_field] = handle_field,
    [JOX_LIVE_VERB_speed] = handle_speed,
};

void jox_live_run_command(JoxLivePage *page, JoxLiveWatcher *watcher, const char *json) {
    JoxCommand command = {0};
    if (!jox_command_read(json, &command))
        return; /* not reached: the server drops messages that are no commands */
    const JoxLiveRequest request = {page, watcher->client, &command};
    int verb = 0;
    while (verb < JOX_LIVE_VERB_COUNT && strcmp(VERBS[verb].name, command.verb) != 0)
        verb++;
    if (verb == JOX_LIVE_VERB_COUNT) {
        jox_view_drop(page->server);
        jox_live_refuse(&request, "there is no such command");
    } else if (COMMON[verb]) {
        COMMON[verb](watcher, &request);
    } else if (page->source->verbs[verb]) {
        page->source->verbs[verb](page->self, &request);
    } else {
        jox_live_refuse(&request, VERBS[verb].needs);
    }
}
