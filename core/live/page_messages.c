/* Lines of text for the people at a live page, and answers to commands that are refused. */
#include "base/format/json_writer.h"
#include "live/page.h"

/* Sends a JSON object with its type and two members, {name, value}, all strings. */
static void send_texts(JoxView *server, uint32_t client, const char *type,
                       const char *const members[2][2]) {
    JoxText text = {0};
    JoxJson json = jox_json_begin(&text, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "type", type);
    jox_json_string(&json, members[0][0], members[0][1]);
    jox_json_string(&json, members[1][0], members[1][1]);
    jox_json_end(&json);
    jox_view_send(server, client, text.data);
    jox_text_free(&text);
}

void jox_live_say(JoxLivePage *page, const char *level, const char *text) {
    send_texts(page->server, JOX_VIEW_ALL, "say",
               (const char *const[2][2]){{"level", level}, {"text", text}});
}

void jox_live_refuse(const JoxLiveRequest *request, const char *why) {
    send_texts(request->page->server, request->client, "refused",
               (const char *const[2][2]){{"do", request->command->verb}, {"text", why}});
}
