/* Tables and text measures shared by draw*.c: the quantities that colours show, inks, and
   estimated text widths. */
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "picture/draw_parts.h"

const struct JoxShown jox_shown[JOX_SHOWS] = {
    {"none", "", 0},
    {"state", "State", 0},
    {"group", "Group", 0},
    {"speed", "Speed, m/s", 2},
    {"force", "Net force, N", 500},
    {"compression", "Compression, N/m", 2000},
    {"load", "Load from one side, N", 1112},
    {"density", "Density, 1/m\xc2\xb2", 8},
    {"direction", "Way they go", 0},
    {"pressure", "Crowd pressure, 1/s\xc2\xb2", 0.04f},
};

const JoxInk jox_ink_text = {0x1f, 0x29, 0x33, 1}, jox_ink_faint = {0x52, 0x60, 0x6d, 1},
             jox_ink_wall = {0x2b, 0x34, 0x3d, 1}, jox_ink_solid = {0xa3, 0xac, 0xb5, 1},
             jox_ink_gate = {0xa4, 0x26, 0x12, 1}, jox_ink_place = {0x4c, 0x6f, 0x94, 1},
             jox_ink_body = {0xc4, 0xa4, 0x84, 1}, jox_ink_body_line = {0x5a, 0x3e, 0x2b, 1},
             jox_ink_path = {0x3a, 0x3a, 0x3a, 0.45f}, jox_ink_probe = {0x6a, 0x2c, 0x91, 1},
             jox_ink_exit = {0x0b, 0x6b, 0x3a, 1};

float jox_draw_text_width(const char *text, float size, bool bold) {
    return (float)jox_count_characters(text, strlen(text)) * size * (bold ? 0.67f : 0.6f);
}

void jox_draw_fit_text(char *out, size_t capacity, const char *text, float size, bool bold,
                       float wide) {
    snprintf(out, capacity - 4, "%s", text);
    jox_text_clean(out); /* snprintf may have cut within a character */
    if (strlen(out) == strlen(text) && jox_draw_text_width(out, size, bold) <= wide)
        return;
    size_t end = strlen(out);
    do { /* drop one character */
        while (end > 0 && ((uint8_t)out[--end] & 0xc0) == 0x80) {
        }
        out[end] = 0;
    } while (end > 0 && jox_draw_text_width(out, size, bold) > wide - size);
    strcat(out, "\xe2\x80\xa6");
}
