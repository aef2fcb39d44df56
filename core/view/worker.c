/* Replaces the server where page and engine are in one process, as in a browser's tab: messages
   wait until the host takes them (worker.h), and the rules of what a client is sent, and what it
   may send, are those of the server (serving.c). */
#include "view/worker.h"

#include <stdio.h>

#include "base/clock.h"
#include "view/view_threads.h"

static void wake_nobody(JoxView *view) {
    (void)view; /* the host takes messages when it wants */
}

JoxView *jox_view_open(const JoxViewOptions *options, JoxText *why) {
    (void)options, (void)why;
    JoxView *view = jox_view_create();
    view->wake_transport = wake_nobody;
    snprintf(view->address, sizeof view->address, "this page");
    return view;
}

void jox_view_close(JoxView *view) {
    if (!view)
        return;
    if (view->connected[0])
        jox_serving_leave(view, view->connected[0]);
    jox_view_free(view);
}

uint32_t jox_worker_join(JoxView *view) {
    const JoxClient *client = view->connected[0] ? NULL : jox_serving_join(view, NULL);
    return client ? client->id : 0;
}

void jox_worker_receive(JoxView *view, const char *json, size_t length) {
    if (view->connected[0])
        jox_serving_receive(view, view->connected[0], json, length, true, true, jox_clock_wall());
}

bool jox_worker_next(JoxView *view, JoxWorkerMessage *message) {
    JoxClient *client = view->connected[0];
    if (!client)
        return false;
    if (client->sending) {
        client->sent = client->sending->length;
        jox_serving_finish_message(view, client);
    }
    jox_serving_fetch(view);
    if (!jox_serving_choose_message(view, client))
        return false;
    const JoxMessage *sending = client->sending;
    const int32_t channel = sending->channel ? (int32_t)(sending->channel - view->channels) : -1;
    *message = (JoxWorkerMessage){sending->data, sending->length, channel};
    return true;
}
