/* Lines of JSON that go to pages: something that is said, and a refusal. */
#include "base/json_writer.h"
#include "live/view_parts.h"

/* Sends an object of texts: its type, and two members. */
static void send_texts(JoxView *view, uint32_t client, const char *type,
                       const char *const members[2][2]) {
    JoxText text = {0};
    JoxJson json = jox_json_begin(&text, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "type", type);
    jox_json_string(&json, members[0][0], members[0][1]);
    jox_json_string(&json, members[1][0], members[1][1]);
    jox_json_end(&json);
    jox_view_send(view, client, text.data);
    jox_text_free(&text);
}

void jox_view_say(JoxView *view, uint32_t client, const char *level, const char *text) {
    send_texts(view, client, "say", (const char *const[2][2]){{"level", level}, {"text", text}});
}

void jox_view_refuse(JoxView *view, uint32_t client, const char *verb, const char *text) {
    send_texts(view, client, "refused", (const char *const[2][2]){{"do", verb}, {"text", text}});
}
