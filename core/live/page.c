/* The live page's loop: handles commands of browsers, advances the source, and sends messages that
   are due: frames as they come, figures and fields four times a second. */
#include "live/page.h"

#include <assert.h>
#include <math.h>

#include "base/assert.h"
#include "base/format/installed.h"
#include "world/world.h"

static const double FRAME = 1.0 / 65.0; /* s, least time between frames */
static const double STATUS = 0.25;      /* s between status messages */
static const double IDLE = 0.05;        /* s, longest wait before `stop` is read again */

static_assert(JOX_VIEW_FRAMES + JOX_LIVE_COLOUR_COUNT <= JOX_VIEW_FIELDS,
              "a channel for each colour");
static_assert(JOX_VIEW_FIELDS + JOX_LIVE_FIELDS <= JOX_LIVE_PEOPLE_CHANNEL,
              "a channel for each field");

/* ---- sending ---- */

/* Sends the scene message, after which the client has nothing else: people and a frame follow. */
static void send_scene(JoxLivePage *page, uint32_t client) {
    page->text.length = 0;
    page->source->scene(page->self, &page->text);
    jox_view_send(page->server, client, page->text.data);
    if (page->source->greet)
        page->source->greet(page->self, client);
    page->people_sent = false;
    page->changed = true;
}

void jox_live_page_begin(JoxLivePage *page) {
    page->version = page->source->version(page->self);
    page->last_frame = page->last_status = 0.0;
    page->people.length = 0;
    jox_view_withdraw_all(page->server);
    if (jox_view_clients(page->server))
        send_scene(page, JOX_VIEW_ALL);
}

/* Publishes a frame for each colour that some browser has chosen. */
static void publish_frames(JoxLivePage *page) {
    bool wanted[JOX_LIVE_COLOUR_COUNT] = {false};
    for (uint32_t w = 0; w < JOX_VIEW_CLIENTS; w++)
        if (page->watchers[w].client)
            wanted[page->watchers[w].colour] = true;
    for (uint32_t c = 0; c < JOX_LIVE_COLOUR_COUNT; c++) {
        if (!wanted[c])
            continue;
        page->source->pack_frame(page->self, (JoxLiveColour)c, &page->bytes);
        jox_view_publish(page->server, JOX_VIEW_FRAMES + c, page->bytes.data, page->bytes.length);
    }
}

/* Publishes radii and groups if they have changed, or if new browsers need them. */
static void publish_people(JoxLivePage *page) {
    const bool differs = page->source->pack_people(page->self, &page->people);
    if (differs || !page->people_sent)
        jox_view_publish(page->server, JOX_LIVE_PEOPLE_CHANNEL, page->people.data,
                         page->people.length);
    page->people_sent = true;
}

static void publish_fields(JoxLivePage *page) {
    for (uint32_t f = 0; f < JOX_LIVE_FIELDS; f++) {
        bool wanted = false;
        for (uint32_t w = 0; w < JOX_VIEW_CLIENTS; w++)
            wanted |= page->watchers[w].client && page->watchers[w].field == (JoxLiveField)f;
        if (!wanted)
            continue;
        page->source->pack_field(page->self, (JoxLiveField)f, &page->bytes);
        jox_view_publish(page->server, JOX_VIEW_FIELDS + f, page->bytes.data, page->bytes.length);
    }
}

static void publish_status(JoxLivePage *page, double now) {
    page->session.dropped = jox_view_dropped(page->server);
    page->text.length = 0;
    page->source->status(page->self, now, &page->text);
    jox_view_publish(page->server, JOX_VIEW_STATUS, page->text.data, page->text.length);
}

/* Sends the messages that are due to the browsers that are connected. */
static void send_due_messages(JoxLivePage *page) {
    const double now = jox_clock_wall();
    if (!jox_view_clients(page->server))
        return;
    const bool status = now - page->last_status >= STATUS;
    if (status && page->source->version(page->self) != page->version) {
        page->version = page->source->version(page->self);
        send_scene(page, JOX_VIEW_ALL);
    }
    if (page->changed && now - page->last_frame >= FRAME) {
        publish_frames(page);
        page->last_frame = now;
        page->changed = false;
    }
    if (!status)
        return;
    publish_people(page);
    publish_status(page, now);
    publish_fields(page);
    if (page->source->report)
        page->source->report(page->self);
    page->last_status = now;
}

/* ---- commands ---- */

/* Returns the row of a client (0: a free row), or NULL if there is none. */
static JoxLiveWatcher *find_watcher(JoxLivePage *page, uint32_t client) {
    for (uint32_t w = 0; w < JOX_VIEW_CLIENTS; w++)
        if (page->watchers[w].client == client)
            return &page->watchers[w];
    return NULL;
}

static void add_watcher(JoxLivePage *page, uint32_t client) {
    JoxLiveWatcher *watcher = find_watcher(page, 0);
    JOX_ASSERT(client && watcher); /* the server admits JOX_VIEW_CLIENTS, as many as rows */
    *watcher = (JoxLiveWatcher){.client = client,
                                .colour = page->source->colour(page->self),
                                .field = page->source->field(page->self)};
    send_scene(page, client);
    jox_live_set_channels(page, watcher);
    page->last_status = 0.0;
}

static void remove_watcher(JoxLivePage *page, JoxLiveWatcher *watcher) {
    if (page->source->left)
        page->source->left(page->self, watcher->client);
    *watcher = (JoxLiveWatcher){0};
    if (jox_view_clients(page->server) == 0)
        jox_view_withdraw_all(page->server); /* the next browser must not get stale messages */
}

/* Takes what the server has received: browsers that join or leave, and commands. */
static void take_commands(JoxLivePage *page) {
    char text[JOX_VIEW_MOST_COMMAND + 1];
    uint32_t client;
    JoxViewTaken what;
    while ((what = jox_view_next_event(page->server, &client, text, sizeof text)) !=
           JOX_VIEW_NOTHING) {
        JoxLiveWatcher *watcher = find_watcher(page, client);
        JOX_ASSERT((what == JOX_VIEW_JOINED) == !watcher);
        if (what == JOX_VIEW_JOINED)
            add_watcher(page, client);
        else if (what == JOX_VIEW_LEFT && watcher)
            remove_watcher(page, watcher);
        else if (what == JOX_VIEW_COMMAND && watcher)
            jox_live_run_command(page, watcher, text);
    }
}

/* ---- opening, closing, running ---- */

bool jox_live_page_open(JoxLivePage *page, const JoxViewOptions *given, JoError *error) {
    JoxViewOptions options = *given;
    JoxText why = {0};
    options.page = options.page ? options.page : jox_page_folder();
    page->session.speed = 1.0;
    page->server = jox_view_open(&options, &why);
    if (!page->server)
        jox_error(error, JO_FAILED, "%s", why.data);
    jox_text_free(&why);
    return page->server != NULL;
}

void jox_live_page_close(JoxLivePage *page) {
    jox_view_close(page->server);
    jox_bytes_free(&page->bytes);
    jox_bytes_free(&page->people);
    jox_text_free(&page->text);
}

double jox_live_page_turn(JoxLivePage *page) {
    take_commands(page);
    double wait = fmin(page->source->advance(page->self, jox_clock_wall()), IDLE);
    JOX_ASSERT(wait >= 0.0 && page->session.speed > 0.0);
    send_due_messages(page);
    if (page->changed && jox_view_clients(page->server)) /* a frame is still to be sent */
        wait = fmin(wait, fmax(page->last_frame + FRAME - jox_clock_wall(), 0.001));
    return wait;
}

void jox_live_page_run(JoxLivePage *page, const volatile int *stop) {
    while (!stop || !__atomic_load_n(stop, __ATOMIC_RELAXED))
        jox_view_wait(page->server, jox_live_page_turn(page));
}
