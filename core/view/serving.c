/* The serving thread's side of the server: the clients, what each is sent next, and what each may
   send. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "view/command.h"
#include "view/view_threads.h"

static JoxClient *find_client(JoxView *view, uint32_t id) {
    for (uint32_t c = 0; c < JOX_VIEW_CLIENTS; c++)
        if (view->connected[c] && view->connected[c]->id == id)
            return view->connected[c];
    return NULL;
}

/* Drops one use of a message. Without uses, a published one goes back to the stepping thread, any
   other is freed. */
static void release_message(JoxMessage *message) {
    JOX_ASSERT(!message || message->refs > 0);
    if (!message || --message->refs > 0)
        return;
    if (message->channel)
        jox_post_put(&message->channel->used, message);
    else
        jox_free(message);
}

/* Appends a message to the queue of a client, which then owns it. Too long a queue makes the client
   bad. */
static void queue_message(JoxClient *client, JoxMessage *message) {
    if (client->bad) {
        jox_free(message);
        return;
    }
    JOX_ASSERT(!message->channel); /* published messages are shared by clients, not queued */
    message->next = NULL;
    message->refs = 1;
    if (client->last)
        client->last->next = message;
    else
        client->first = message;
    client->last = message;
    client->unread += message->length;
    client->bad |= client->unread > JOX_VIEW_MOST_UNREAD;
}

static JoxMessage *copy_message(const JoxView *view, const JoxMessage *message) {
    JoxMessage *other = jox_message_create(view, message->length);
    memcpy(other->data, message->data, message->length);
    other->what = message->what;
    return other;
}

static void drop_older_epochs(JoxView *view, uint32_t epoch) {
    for (uint32_t c = 0; c < JOX_VIEW_CHANNELS; c++) {
        JoxMessage *newest = view->channels[c].newest;
        if (newest && newest->epoch < epoch) {
            release_message(newest);
            view->channels[c].newest = NULL;
        }
    }
}

static void do_request(JoxView *view, JoxMessage *message) {
    JoxClient *client = find_client(view, message->client);
    switch ((JoxRequest)message->what) {
    case JOX_REQUEST_TEXT:
        for (uint32_t c = 0; c < JOX_VIEW_CLIENTS && message->client == JOX_VIEW_ALL; c++)
            if (view->connected[c])
                queue_message(view->connected[c], copy_message(view, message));
        if (client) {
            queue_message(client, message);
            return;
        }
        break;
    case JOX_REQUEST_LISTEN:
        if (client)
            client->mask = message->mask;
        break;
    case JOX_REQUEST_FORGET:
        drop_older_epochs(view, message->epoch);
        break;
    }
    jox_free(message);
}

/* Channels are read before the queue: a text that was sent before a frame was published is then in
   the queue when the frame is seen. */
void jox_serving_fetch(JoxView *view) {
    for (uint32_t c = 0; c < JOX_VIEW_CHANNELS; c++) {
        JoxChannel *channel = &view->channels[c];
        JoxMessage *fresh = atomic_exchange(&channel->fresh, NULL);
        if (!fresh)
            continue;
        release_message(channel->newest);
        fresh->refs = 1;
        channel->newest = fresh;
        channel->number++;
    }
    JoxMessage *message = jox_post_take(&view->out);
    while (message) {
        JoxMessage *next = message->next;
        do_request(view, message);
        message = next;
    }
}

/* Returns the next channel, from client->turn on, that has something new for a client;
   JOX_VIEW_CHANNELS if none. */
static uint32_t find_new_channel(const JoxView *view, const JoxClient *client) {
    for (uint32_t i = 0; i < JOX_VIEW_CHANNELS; i++) {
        uint32_t c = (client->turn + i) % JOX_VIEW_CHANNELS;
        const JoxChannel *channel = &view->channels[c];
        if ((client->mask >> c & 1) && channel->newest && channel->number > client->seen[c])
            return c;
    }
    return JOX_VIEW_CHANNELS;
}

bool jox_serving_has_work(const JoxView *view, const JoxClient *client) {
    return client->bad || client->sending || client->first ||
           find_new_channel(view, client) < JOX_VIEW_CHANNELS;
}

bool jox_serving_choose_message(JoxView *view, JoxClient *client) {
    if (client->sending)
        return true;
    client->sent = 0;
    if (client->first) {
        client->sending = client->first;
        client->first = client->first->next;
        client->last = client->first ? client->last : NULL;
        client->text = client->sending->what == JOX_REQUEST_TEXT;
        return true;
    }
    uint32_t c = find_new_channel(view, client);
    if (c == JOX_VIEW_CHANNELS)
        return false;
    client->sending = view->channels[c].newest;
    client->sending->refs++;
    client->seen[c] = view->channels[c].number;
    client->turn = c + 1;
    client->text = c >= JOX_VIEW_FIRST_TEXT;
    return true;
}

void jox_serving_finish_message(JoxView *view, JoxClient *client) {
    (void)view;
    JOX_ASSERT(client->sending && client->sent <= client->sending->length);
    JOX_ASSERT(client->sending->channel || client->unread >= client->sending->length);
    if (!client->sending->channel)
        client->unread -= client->sending->length;
    release_message(client->sending);
    client->sending = NULL;
}

JoxClient *jox_serving_join(JoxView *view, struct lws *wsi) {
    for (uint32_t c = 0; c < JOX_VIEW_CLIENTS; c++) {
        if (view->connected[c])
            continue;
        JoxClient *client = jox_alloc(1, sizeof *client);
        client->wsi = wsi;
        client->id = ++view->next_id;
        client->allowance = JOX_VIEW_RATE;
        view->connected[c] = client;
        atomic_fetch_add(&view->clients, 1);
        jox_view_post_event(view, client->id, JOX_VIEW_JOINED, NULL, 0);
        return client;
    }
    return NULL;
}

void jox_serving_leave(JoxView *view, JoxClient *client) {
    for (uint32_t c = 0; c < JOX_VIEW_CLIENTS; c++)
        if (view->connected[c] == client)
            view->connected[c] = NULL;
    while (client->first) {
        JoxMessage *next = client->first->next;
        jox_free(client->first);
        client->first = next;
    }
    release_message(client->sending);
    atomic_fetch_sub(&view->clients, 1);
    jox_view_post_event(view, client->id, JOX_VIEW_LEFT, NULL, 0);
    jox_free(client);
}

/* Returns whether the client may send one more command now: JOX_VIEW_RATE a second, and as many in
   a burst. */
static bool may_send_command(JoxClient *client, double now) {
    if (client->since > 0.0)
        client->allowance += (now - client->since) * JOX_VIEW_RATE;
    client->since = now;
    if (client->allowance > JOX_VIEW_RATE)
        client->allowance = JOX_VIEW_RATE;
    if (client->allowance < 1.0)
        return false;
    client->allowance -= 1.0;
    return true;
}

void jox_serving_receive(JoxView *view, JoxClient *client, const void *data, size_t length,
                         bool last, bool text, double now) {
    if (client->length + length <= JOX_VIEW_MOST_COMMAND)
        memcpy(client->command + client->length, data, length);
    client->length += length;
    if (client->length > 1 << 20) { /* no page sends a mebibyte */
        client->bad = true;
        jox_view_drop(view);
    }
    if (!last || client->bad)
        return;
    bool fits = client->length <= JOX_VIEW_MOST_COMMAND;
    size_t n = fits ? client->length : 0;
    JOX_ASSERT(n < sizeof client->command);
    client->length = 0;
    client->command[n] = 0;
    JoxCommand command = {0};
    bool good = may_send_command(client, now) && fits && text && strlen(client->command) == n &&
                atomic_load(&view->waiting) < JOX_VIEW_MOST_WAITING &&
                jox_command_read(client->command, &command);
    if (!good) {
        jox_view_drop(view);
        return;
    }
    atomic_fetch_add(&view->waiting, 1);
    jox_view_post_event(view, client->id, JOX_VIEW_COMMAND, client->command, n);
}
