#include "picture/palette.h"

#include <math.h>

#include "base/vec.h"

static const JoxInk CLASSES[] = {
#define X(name, rgb) {(rgb) >> 16 & 255, (rgb) >> 8 & 255, (rgb)&255, 1.0f},
    JOX_CLASS_COLOURS(X)
#undef X
};
enum { CLASS_COUNT = sizeof CLASSES / sizeof *CLASSES, SHADES = 3, ANCHORS = 9 };

/* From pale yellow to dark purple with falling lightness, so that the ramp can be read in grey
   and in print. The live page has the same colours (palette.js). */
static const uint8_t RAMP[ANCHORS][3] = {
    {0xfb, 0xf6, 0xd3}, {0xfd, 0xe3, 0x9a}, {0xfc, 0xc5, 0x62},
    {0xf8, 0xa1, 0x40}, {0xee, 0x76, 0x2f}, {0xd8, 0x4a, 0x2c},
    {0xb3, 0x25, 0x36}, {0x82, 0x12, 0x3f}, {0x4d, 0x0b, 0x3b},
};
enum { CALM_ANCHORS = 8, WAYS = 8 };
static const uint8_t CALM[CALM_ANCHORS][3] = {
    {0xf6, 0xf5, 0xdc}, {0xd3, 0xe8, 0xcf}, {0xa3, 0xd6, 0xcf}, {0x6b, 0xbd, 0xcf},
    {0x3c, 0x9c, 0xc4}, {0x25, 0x77, 0xad}, {0x1a, 0x52, 0x8b}, {0x14, 0x2f, 0x63},
};
/* Directions from the east counter-clockwise back to the east. Lightness differs too, for
   readers who cannot tell the hues apart. */
static const uint8_t WAY[WAYS + 1][3] = {
    {0xd5, 0x5e, 0x00}, {0xf0, 0xb9, 0x42}, {0x7f, 0xb8, 0x42},
    {0x1c, 0x9e, 0x77}, {0x37, 0xa6, 0xdd}, {0x2c, 0x5f, 0xb8},
    {0x7b, 0x4a, 0xa8}, {0xc0, 0x50, 0x8f}, {0xd5, 0x5e, 0x00},
};

static uint8_t to_byte(float share) {
    return (uint8_t)(jox_clampf(share, 0.0f, 1.0f) * 255.0f + 0.5f);
}

/* Mixes a colour with a share of grey, whose level `white` is 0 (black) to 1 (white). */
static JoxInk mix_with_grey(JoxInk ink, float white, float share) {
    return (JoxInk){to_byte((float)ink.r / 255.0f * (1.0f - share) + white * share),
                    to_byte((float)ink.g / 255.0f * (1.0f - share) + white * share),
                    to_byte((float)ink.b / 255.0f * (1.0f - share) + white * share), ink.a};
}

JoxInk jox_palette_class(uint32_t n) {
    JoxInk ink = CLASSES[n % CLASS_COUNT];
    switch (n / CLASS_COUNT % SHADES) {
    case 1:
        return mix_with_grey(ink, 1.0f, 0.45f);
    case 2:
        return mix_with_grey(ink, 0.0f, 0.45f);
    default:
        return ink;
    }
}

JoxColour jox_palette_colour(JoxInk ink) {
    return (JoxColour)(JOX_COLOUR_GIVEN | ink.r << 16 | ink.g << 8 | ink.b);
}

/* Returns the first class from `n` on whose colour was not given to any class; `n` itself if all
   were. */
static uint32_t find_free_class(const JoxColour *given, uint32_t count, uint32_t n) {
    for (uint32_t k = n; k < n + SHADES * CLASS_COUNT; k++) {
        const JoxColour colour = jox_palette_colour(jox_palette_class(k));
        uint32_t g = 0;
        while (given && g < count && given[g] != colour)
            g++;
        if (!given || g == count)
            return k;
    }
    return n;
}

void jox_palette_classes(const JoxColour *given, uint32_t count, JoxInk *out) {
    uint32_t n = 0;
    for (uint32_t k = 0; k < count; k++) {
        const JoxColour colour = given ? given[k] : 0;
        if (colour) {
            out[k] = (JoxInk){colour >> 16 & 255, colour >> 8 & 255, colour & 255, 1.0f};
            continue;
        }
        n = find_free_class(given, count, n);
        out[k] = jox_palette_class(n++);
    }
}

/* Interpolates linearly within a list of colours at a share of its length, 0 to 1. */
static JoxInk interpolate_colours(const uint8_t stops[][3], int count, float share) {
    const float at = jox_clampf(share, 0.0f, 1.0f) * (float)(count - 1);
    const int low = (int)at < count - 2 ? (int)at : count - 2;
    const float part = at - (float)low;
    uint8_t mixed[3];
    for (int c = 0; c < 3; c++)
        mixed[c] = (uint8_t)((float)stops[low][c] * (1.0f - part) +
                             (float)stops[low + 1][c] * part + 0.5f);
    return (JoxInk){mixed[0], mixed[1], mixed[2], 1.0f};
}

JoxInk jox_palette_value(float share) {
    return interpolate_colours(RAMP, ANCHORS, share);
}

JoxInk jox_palette_calm(float share) {
    return interpolate_colours(CALM, CALM_ANCHORS, share);
}

JoxInk jox_palette_way(float turn) {
    return interpolate_colours(WAY, WAYS + 1, turn - floorf(turn));
}
