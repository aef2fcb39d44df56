/* Writes positions in plan, with their storey or stair. */
#include "geom/storey_text.h"

const char *jox_storey_name_at(const JoxStoreys *s, JoxV2 at) {
    if (!jox_has_storeys(s))
        return "";
    const int32_t stair = jox_stair_at(s, at);
    return stair >= 0 ? s->stairs[stair].name : s->storeys[jox_storey_at(s, at)].name;
}

void jox_text_storey(JoxText *out, const JoxStoreys *s, JoxV2 at) {
    if (!jox_has_storeys(s))
        return;
    const int32_t stair = jox_stair_at(s, at);
    if (stair >= 0)
        jox_text_printf(out, " on the stair %s", s->stairs[stair].name);
    else
        jox_text_printf(out, " on %s", s->storeys[jox_storey_at(s, at)].name);
}

void jox_text_position(JoxText *out, const JoxStoreys *s, JoxV2 at, int decimals) {
    const JoxV2 plan = jox_in_plan(s, at);
    if (decimals < 0)
        jox_text_printf(out, "(%g, %g) m", (double)plan.x, (double)plan.y);
    else
        jox_text_printf(out, "(%.*f, %.*f) m", decimals, (double)plan.x, decimals, (double)plan.y);
    jox_text_storey(out, s, at);
}
