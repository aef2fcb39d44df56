/* The stepping thread's side of the server: publishing, sending, and taking what browsers sent.
   Also the queues between the two threads, and creation of the view. */
#include <poll.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/mem.h"
#include "view/view_threads.h"

void jox_post_put(JoxPost *post, JoxMessage *message) {
    JoxMessage *newest = atomic_load_explicit(&post->newest, memory_order_relaxed);
    do
        message->next = newest;
    while (!atomic_compare_exchange_weak_explicit(&post->newest, &newest, message,
                                                  memory_order_release, memory_order_relaxed));
}

JoxMessage *jox_post_take(JoxPost *post) {
    JoxMessage *message = atomic_exchange_explicit(&post->newest, NULL, memory_order_acquire);
    JoxMessage *ordered = NULL;
    while (message) {
        JoxMessage *next = message->next;
        message->next = ordered;
        ordered = message;
        message = next;
    }
    return ordered;
}

JoxMessage *jox_message_create(const JoxView *view, size_t length) {
    JoxHeap *before = jox_heap_use(view->heap);
    JoxMessage *message = jox_realloc(NULL, 1, sizeof *message + length + 1);
    jox_heap_use(before);
    *message = (JoxMessage){.length = length, .capacity = length};
    message->data[length] = 0;
    return message;
}

JoxView *jox_view_create(void) {
    JoxView *view = jox_alloc(1, sizeof *view);
    view->heap = jox_heap_used();
    view->wake = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    return view;
}

static void free_messages(JoxMessage *message) {
    while (message) {
        JoxMessage *next = message->next;
        jox_free(message);
        message = next;
    }
}

/* Frees the view; the serving thread must have ended. */
void jox_view_free(JoxView *view) {
    for (uint32_t c = 0; c < JOX_VIEW_CHANNELS; c++) {
        JoxChannel *channel = &view->channels[c];
        free_messages(jox_post_take(&channel->used));
        free_messages(channel->spare);
        jox_free(channel->newest);
        jox_free(atomic_load(&channel->fresh));
    }
    free_messages(jox_post_take(&view->out));
    free_messages(jox_post_take(&view->in));
    free_messages(view->taken);
    if (view->wake >= 0)
        close(view->wake);
    jox_free(view);
}

const char *jox_view_address(const JoxView *view) {
    return view->address;
}

uint32_t jox_view_clients(const JoxView *view) {
    return atomic_load(&view->clients);
}

uint64_t jox_view_dropped(const JoxView *view) {
    return atomic_load(&view->dropped);
}

void jox_view_drop(JoxView *view) {
    atomic_fetch_add(&view->dropped, 1);
}

/* Returns a message with room for `length` bytes, reusing one of the channel if it is large enough:
   a steady stream needs three. */
static JoxMessage *reuse_message(const JoxView *view, JoxChannel *channel, size_t length) {
    JoxMessage *back = jox_post_take(&channel->used);
    while (back) {
        JoxMessage *next = back->next;
        back->next = channel->spare;
        channel->spare = back;
        back = next;
    }
    JoxMessage *message = channel->spare;
    if (message)
        channel->spare = message->next;
    if (message && message->capacity < length) {
        jox_free(message);
        message = NULL;
    }
    if (!message)
        message = jox_message_create(view, length);
    JOX_ASSERT(message->capacity >= length);
    message->length = length;
    message->channel = channel;
    return message;
}

void jox_view_publish(JoxView *view, uint32_t channel, const void *bytes, size_t length) {
    if (channel >= JOX_VIEW_CHANNELS || !jox_view_clients(view))
        return;
    JoxChannel *to = &view->channels[channel];
    JoxMessage *message = reuse_message(view, to, length);
    memcpy(message->data, bytes, length);
    message->epoch = view->epoch;
    JoxMessage *unseen = atomic_exchange(&to->fresh, message);
    if (unseen) {
        unseen->next = to->spare;
        to->spare = unseen;
    }
    view->wake_transport(view);
}

static void post_request(JoxView *view, JoxRequest request, uint32_t client, uint32_t mask,
                         const void *data, size_t length) {
    JoxMessage *message = jox_message_create(view, length);
    if (length)
        memcpy(message->data, data, length);
    message->what = request;
    message->client = client;
    message->mask = mask;
    message->epoch = view->epoch;
    jox_post_put(&view->out, message);
    view->wake_transport(view);
}

void jox_view_send(JoxView *view, uint32_t client, const char *text) {
    if (jox_view_clients(view))
        post_request(view, JOX_REQUEST_TEXT, client, 0, text, strlen(text));
}

void jox_view_listen(JoxView *view, uint32_t client, uint32_t channels) {
    JOX_ASSERT(client != JOX_VIEW_ALL && channels >> JOX_VIEW_CHANNELS == 0);
    post_request(view, JOX_REQUEST_LISTEN, client, channels, NULL, 0);
}

void jox_view_withdraw_all(JoxView *view) {
    view->epoch++;
    for (uint32_t c = 0; c < JOX_VIEW_CHANNELS; c++) {
        JoxMessage *unseen = atomic_exchange(&view->channels[c].fresh, NULL);
        if (unseen) {
            unseen->next = view->channels[c].spare;
            view->channels[c].spare = unseen;
        }
    }
    post_request(view, JOX_REQUEST_FORGET, JOX_VIEW_ALL, 0, NULL, 0);
}

void jox_view_post_event(JoxView *view, uint32_t client, JoxViewTaken what, const char *text,
                         size_t length) {
    JoxMessage *message = jox_message_create(view, length);
    if (length)
        memcpy(message->data, text, length);
    message->what = what;
    message->client = client;
    jox_post_put(&view->in, message);
    uint64_t one = 1;
    if (write(view->wake, &one, sizeof one) < 0)
        return; /* the counter is full, so the reader is awake */
}

JoxViewTaken jox_view_next_event(JoxView *view, uint32_t *client, char *text, size_t capacity) {
    if (!view->taken)
        view->taken = jox_post_take(&view->in);
    JoxMessage *message = view->taken;
    if (!message)
        return JOX_VIEW_NOTHING;
    view->taken = message->next;
    JoxViewTaken what = (JoxViewTaken)message->what;
    *client = message->client;
    JOX_ASSERT(capacity > message->length && *client > 0);
    size_t n = message->length < capacity ? message->length : capacity - 1;
    memcpy(text, message->data, n);
    text[n] = 0;
    if (what == JOX_VIEW_COMMAND)
        atomic_fetch_sub(&view->waiting, 1);
    jox_free(message);
    return what;
}

void jox_view_wait(JoxView *view, double seconds) {
    uint64_t count;
    if (view->taken || atomic_load(&view->in.newest))
        return;
    struct pollfd fd = {.fd = view->wake, .events = POLLIN};
    struct timespec wait = {.tv_sec = (time_t)seconds,
                            .tv_nsec = (long)((seconds - (double)(time_t)seconds) * 1e9)};
    if (seconds > 0.0 && ppoll(&fd, 1, &wait, NULL) > 0 &&
        read(view->wake, &count, sizeof count) < 0)
        return; /* cannot happen: no other thread reads it */
}
