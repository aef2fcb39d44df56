/* The message "reloaded": what edited files changed, for the note that the page shows. The listener
   of live_frame.c collects it; scene_page.c sends it with the next status. */
#include "live/live_parts.h"

/* Adds the states of a machine in which anybody was. */
static void add_census(JoxJson *json, const char *key, const JoxMachine *machine,
                       const uint32_t *people) {
    jox_json_array(json, key);
    for (uint32_t s = 0; s < machine->state_count; s++) {
        jox_json_object(json, NULL);
        jox_json_string(json, "state", machine->states[s].name);
        jox_json_whole(json, "people", people[s]);
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_live_note_reload(void *self, JoScene *scene, const JoxReloadNews *news) {
    JoxLive *live = self;
    live->telling = news != NULL;
    if (!news)
        return;
    jox_text_add(&live->news, live->news.length ? ", " : "");
    JoxJson json = jox_json_begin(&live->news, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "file", news->path);
    jox_json_number(&json, "time", jo_world_time(scene->world));
    if (news->next) {
        jox_json_string(&json, "machine", news->next->name);
        add_census(&json, "before", news->old, news->before);
        add_census(&json, "after", news->next, news->after);
        jox_json_string(&json, "notes", news->notes);
    } else {
        jox_json_string(&json, "done", news->done);
        jox_json_string(&json, "later", news->later);
    }
    jox_json_end(&json);
}
