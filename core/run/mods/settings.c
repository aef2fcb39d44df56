#include "run/mods/settings.h"

#include <math.h>

enum { HEAD, ITEMS }; /* parts of a pack */

JoSettings *jox_settings_begin(JoxPack *pack) {
    JoSettings *head = jox_pack_add(pack, HEAD, sizeof *head);
    jox_pack_list(pack, HEAD, &head->items, ITEMS);
    return head;
}

void jox_settings_set_value(JoxPack *pack, JoSettings *head, const char *text) {
    jox_pack_text(pack, HEAD, &head->now, text);
}

JoSettings *jox_settings_end(JoxPack *pack) {
    const size_t count = jox_pack_length(pack, ITEMS) / sizeof(JoSetting);
    JoSettings *settings = jox_pack_end(pack);
    settings->count = (uint32_t)count;
    return settings;
}

void jox_settings_add(void *context, const JoSetting *from) {
    JoxPack *pack = context;
    JoSetting *to = jox_pack_add(pack, ITEMS, sizeof *to);
    *to = (JoSetting){.by = from->by,
                      .line = from->line,
                      .column = from->column,
                      .removes = from->removes,
                      .extends = from->extends,
                      .time = from->where ? from->time : (double)NAN};
    jox_pack_text(pack, ITEMS, &to->where, from->where ? from->where : "");
    jox_pack_text(pack, ITEMS, &to->value, from->value ? from->value : "");
    jox_pack_text(pack, ITEMS, &to->unit, from->unit ? from->unit : "");
    jox_pack_text(pack, ITEMS, &to->file, from->file ? from->file : "");
    jox_pack_text(pack, ITEMS, &to->mod, from->mod ? from->mod : "");
    jox_pack_text(pack, ITEMS, &to->version, from->version ? from->version : "");
}
