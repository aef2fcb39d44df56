/* Clearance time and counts of exits, for summaries. */
#include <math.h>

#include "record/danger/danger.h"

double jox_exits_clearance(const JoxExits *exits, uint32_t inside) {
    return exits->left && inside == 0 ? exits->last : NAN;
}

void jox_exits_json(const JoxExits *exits, uint32_t inside, JoxJson *json) {
    jox_json_whole(json, "left", exits->left);
    jox_json_whole(json, "inside", inside);
    jox_json_number(json, "last_left_s", exits->left ? exits->last : NAN);
    jox_json_number(json, "clearance_s", jox_exits_clearance(exits, inside));
    jox_json_object(json, "exits");
    for (uint32_t e = 0; e < exits->count; e++) {
        jox_json_object(json, exits->items[e].name);
        jox_json_whole(json, "people", exits->items[e].people);
        jox_json_number(json, "last_s", exits->items[e].last);
        jox_json_end(json);
    }
    jox_json_end(json);
}
